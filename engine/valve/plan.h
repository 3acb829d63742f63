// The plan: the smallest set of fields that a scene's views and outputs need, each by the cheapest
// model that meets the tolerance, with predicted cost and error.
#pragma once

#include "engine/valve/valve.h"

enum {
  SB_PLAN_ITEMS_MAX = 24,
  SB_RUN_MOTIONS = 3, // in which a seal is solved: sliding in, sliding out, at rest
  SB_RUN_EDGES = 24   // places of the land's edge over the inner ring, if it is drawn
};

typedef struct {
  char name[40];    // "outer contact pressure profile"
  char model[40];   // "karaszkiewicz"; empty for a skipped one
  char reason[160]; // who needs it, or why nobody does
  double cost_s;    // predicted seconds for the whole run
  double error;     // predicted relative error of discretisation; 0 for a closed form
} SbPlanItem;

typedef struct {
  size_t field_count, skipped_count;
  SbPlanItem field[SB_PLAN_ITEMS_MAX];
  SbPlanItem skipped[SB_PLAN_ITEMS_MAX];
  bool profiles;       // contact pressure and film over x are kept
  bool section_fields; // interior fields at drawn frames
  bool reynolds;       // the film is solved
  bool film_history;   // and its history over the frames
  bool ring;           // the ring is solved
  bool bodies;         // the parts' accelerations and the joints' reactions are solved
  unsigned studies;    // bit mask, 1 << SbStudyKind: computed beside the cycle
} SbPlan;

// Plans `model` for its own views. Always succeeds.
void sb_plan_make(SbPlan *out, const SbModel *model);
