// The plan: the smallest set of fields that a scene's views and outputs, or the figures that
// somebody wants, need; each by the cheapest model that meets the tolerance, with predicted cost
// and error.
#pragma once

#include "engine/valve/shelf.h"
#include "engine/valve/valve.h"

enum {
  SB_PLAN_ITEMS_MAX = 24,
  SB_RUN_MOTIONS = 3, // in which a seal is solved: sliding in, sliding out, at rest
  SB_RUN_EDGES = 16   // places of the land's edge over the inner ring each way, if it is drawn
};

typedef struct {
  char name[40];    // "outer contact pressure profile"
  char model[40];   // "karaszkiewicz"; empty for a skipped one
  char reason[160]; // who needs it, or why nobody does
  double cost_s;    // predicted seconds for the whole run
  double error;     // predicted relative error of discretisation; 0 for a closed form
} SbPlanItem;

// How much of a seal is solved; each has all that stands before it.
typedef enum {
  SB_DEPTH_SIZES,   // nothing: its sizes are the model's
  SB_DEPTH_FITMENT, // its contact under the pressures at rest
  SB_DEPTH_SLIDING, // the film and the friction there, sliding in
  SB_DEPTH_LEAK,    // sliding in at the chamber's other pressures too: is it open at one?
  SB_DEPTH_WHOLE    // every state of the cycle
} SbSealDepth;

typedef struct {
  size_t field_count, skipped_count;
  SbPlanItem field[SB_PLAN_ITEMS_MAX];
  SbPlanItem skipped[SB_PLAN_ITEMS_MAX];
  SbCounters expected; // what the run will count, within a factor of two; newton_iterations is 0
  bool profiles;       // contact pressure and film over x are kept
  bool section_fields; // interior fields at drawn frames
  bool over_edge;      // and those of the inner ring over the land's edge
  bool reynolds;       // the film is solved
  bool film_history;   // and its history over the frames
  bool ring;           // the ring is solved
  bool bodies;         // the parts' accelerations and the joints' reactions are solved
  unsigned studies;    // bit mask, 1 << SbStudyKind: computed beside the cycle
  SbSealDepth seal[SB_SEAL_COUNT];
  bool film_laws;   // films by the laws that are not the model's own, too
  bool motion;      // the cycle is run; needs both seals' whole depth
  bool inertia;     // with it; else by the balance of forces at every instant
  int frames;       // evenly spaced over the cycle
  bool frame_films; // they show films at their own speeds, in whose errors these count
  bool life;        // and the actuations after the first
  SbShelfDepth shelf;
  bool permeation; // the section's fields have it
} SbPlan;

// What somebody wants of a run beside its figures.
typedef struct {
  unsigned views, studies; // bit masks of SbView and 1 << SbStudyKind
  bool life;               // the actuations after the first, where the model has any
  bool resting;            // a picture at rest will do: the balance of forces, few frames
  bool coarse;             // a first look will do: no rings over the land's edge
} SbPlanWishes;

// Plans `model` for all figures and what is wished; sb_plan_make(): what its own parameters ask
// for. Always succeeds.
void sb_plan_wished(SbPlan *out, const SbModel *model, const SbPlanWishes *wishes);
void sb_plan_make(SbPlan *out, const SbModel *model);

// Predicted processor time of all that it computes [s].
double sb_plan_cost(const SbPlan *plan);

// Plans `model` for `count` figures (indices, engine/valve/figures.h) and nothing to look at;
// without the lists of fields. A run by this plan leaves figures that nobody wants uncomputed;
// those it has are the same to the bit as a whole run's. as_run: the shelf's only as far as
// the views or limits of that model ask for them; NULL: as figures do.
void sb_plan_figures(SbPlan *out, const SbModel *model, const int *figures, size_t count,
                     const SbModel *as_run);
