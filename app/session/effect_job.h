// Effects of the main parameters on the figures that a design is about, computed in a thread of its
// own.
#pragma once

#include "engine/valve/sealbench.h"

#include <stdbool.h>

typedef struct SbEffectJob SbEffectJob;

// Number of goals: figures whose effects are computed.
enum { SB_EFFECT_GOALS = 5 };

// Returns the figure of goal `index`, 0 to SB_EFFECT_GOALS - 1, as an index of sb_figure().
int sb_effect_goal(int index);

// Returns the short name of goal `index`, translated.
const char *sb_effect_goal_name(int index);

// Change of each goal if a parameter increases by its tolerance, or by 5 % if it has none.
typedef struct {
  // [goal][SbParamId]: signed change [SI of the figure]; NaN: not known, or not a main parameter.
  double change[SB_EFFECT_GOALS][SB_PARAM_COUNT];
  double step[SB_PARAM_COUNT]; // [SbParamId]: change of the parameter [SI]; NaN: not known
} SbEffects;

// Starts the computation for a copy of `model`. done(data) is called once in the main thread at the
// end, unless the job was freed before. Freed by sb_effect_job_free().
SbEffectJob *sb_effect_job_start(const SbModel *model, void (*done)(void *data), void *data);

// To be called only after `done`: copies the effects to *out. Returns false if the job was
// cancelled or failed; *out is then not valid.
bool sb_effect_job_take(const SbEffectJob *job, SbEffects *out);

// Cancels, waits for the thread and frees the job.
void sb_effect_job_free(SbEffectJob *job);
