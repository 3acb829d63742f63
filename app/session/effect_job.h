// What the main parameters do to the figures that a design is about, computed on a thread beside
// what the user does.
#pragma once

#include "engine/valve/sealbench.h"

#include <stdbool.h>

typedef struct SbEffectJob SbEffectJob;

enum { SB_EFFECT_GOALS = 5 };

// Goal `index`, a figure of figures.def, and its short name; borrowed.
int sb_effect_goal(int index);
const char *sb_effect_goal_name(int index);

// By how much each goal changes as a parameter moves by its tolerance, or by 5 % where it has none;
// NaN: not known, or no main real parameter.
typedef struct {
  double change[SB_EFFECT_GOALS][SB_PARAM_COUNT]; // SI of the figure
  double step[SB_PARAM_COUNT];                    // SI of the parameter
} SbEffects;

// Starts it on a copy of `model`. `done` is called once on the main thread unless the job was freed
// before. Owned by the caller.
SbEffectJob *sb_effect_job_start(const SbModel *model, void (*done)(void *data), void *data);

// Only after `done`; false where it was cancelled or failed.
bool sb_effect_job_take(const SbEffectJob *job, SbEffects *out);

// Cancels, waits, frees. Takes NULL.
void sb_effect_job_free(SbEffectJob *job);
