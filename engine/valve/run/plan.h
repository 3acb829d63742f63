// The plan of a run: which quantities (fields) a run computes and by which model. It has the
// minimum that the scene's views and outputs, or the requested figures, need, with predicted cost
// and error. The functions have no state and may be called concurrently.
#pragma once

#include "engine/valve/figures/summary.h"

// Capacities and counts.
enum {
  SB_PLAN_ITEMS_MAX = 24,
  SB_RUN_EDGES = 16 // drawn positions of the land's edge over the inner ring in each direction
};

// A computed or skipped field.
typedef struct {
  char name[40];    // "outer contact pressure profile"
  char model[40];   // "karaszkiewicz"; "" if skipped
  char reason[160]; // which output needs it, or why it is skipped
  double cost_s;    // predicted processor time [s]; 0 if skipped
  double error;     // predicted relative discretisation error; 0 for a closed form or if skipped
} SbPlanItem;

// A plan. Set by the functions below; a caller may change single fields before a run.
typedef struct {
  size_t field_count, skipped_count;     // elements in use
  SbPlanItem field[SB_PLAN_ITEMS_MAX];   // computed fields, for display
  SbPlanItem skipped[SB_PLAN_ITEMS_MAX]; // skipped fields, for display
  SbCounters expected; // predicted counters, within a factor of two; newton_iterations is 0
  bool profiles;       // contact profiles (pressure and film over x)
  bool section_fields; // section fields of drawn frames
  bool over_edge;      // section fields of the inner ring over the land's edge
  bool reynolds;       // the film is solved
  bool film_history;   // the transient film over the frames is solved
  bool ring;           // the ring is solved
  bool bodies;         // accelerations of the parts and joint reactions
  unsigned studies;    // studies to compute with the cycle, bits 1 << SbStudyKind
  SbSealDepth seal[SB_SEAL_COUNT]; // how much of each seal is solved
  bool film_laws;                  // films by the other film laws, for comparison
  bool motion;                     // the cycle is computed; needs SB_DEPTH_WHOLE of both seals
  bool inertia;                    // the motion has inertia; else balance of forces at each instant
  int frames;         // number of evenly spaced frames; frames at events come in addition
  bool frame_films;   // films at the speed of each frame are solved; they contribute to the errors
  bool life;          // the actuations after the first are computed
  SbShelfDepth shelf; // how much of the shelf is computed
  bool permeation;    // the section field SB_FIELD_PERMEATION is computed
} SbPlan;

// What a caller requests in addition to the figures; {0}: only the figures.
typedef struct {
  unsigned views, studies; // bit masks of SbView and 1 << SbStudyKind
  bool life;               // the actuations after the first, if the model has any
  bool resting;            // a picture at rest is enough: balance of forces, few frames
  bool coarse;             // a preview is enough: no rings over the land's edge
} SbPlanWishes;

// Plans `model` for all figures and the given wishes. Does not fail.
void sb_plan_wished(SbPlan *out, const SbModel *model, const SbPlanWishes *wishes);

// Plans `model` for all figures and what its own output.* parameters request. Does not fail.
void sb_plan_make(SbPlan *out, const SbModel *model);

// Returns the predicted processor time of a plan [s].
double sb_plan_cost(const SbPlan *plan);

// Plans `model` for figures[count] (indices from sb_figure_find()) only, without the lists of
// fields. A run by this plan need not compute other figures; the requested figures equal those of a
// full run to the bit. `as_run`: a model whose views and limits decide how much of the shelf is
// computed, as in a full run of it; NULL: all requested shelf figures are computed.
void sb_plan_figures(SbPlan *out, const SbModel *model, const int *figures, size_t count,
                     const SbModel *as_run);
