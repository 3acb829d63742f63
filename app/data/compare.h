// A measured loop beside a computed one: the run's force over the stem's displacement, both ways,
// and what the measurement differs by at equal displacement.
#pragma once

#include "app/data/measured.h"

#include "engine/valve/run/run.h"

// A run's first cycle while the stem slides: from B to D, and from E to the end. Zeroed is empty;
// memory is kept from one run to the next.
typedef struct {
  size_t count[2], room[2];                  // in-stroke, return
  double *displacement[2], *force[2];        // in the order of time: growing, falling
  double stage_displacement[SB_STAGE_COUNT]; // NaN where it was not reached
  double stage_force[SB_STAGE_COUNT];
} SbLoop;

// Takes the loop of a run that has ended; false where it has no stroke.
bool sb_loop_take(SbLoop *loop, const SbRun *run);
void sb_loop_clear(SbLoop *loop);

// Force at a displacement, straight lines between frames, the first and last one's force up to a
// hundredth of the stroke beyond; NaN elsewhere.
double sb_loop_force(const SbLoop *loop, int way, double displacement);

enum { SB_COMPARISON_POINTS = 200000 };

typedef struct {
  const SbMeasured *measured; // borrowed
  size_t count, outside;      // outside: where the run has no force
  SbMeasuredPoint *point;     // rows, or means of them where there are more
  double *residual;           // measured less model [N]; NaN outside
  double rms, mean, most;     // of the residuals [N]; NaN without any; most: greatest magnitude
  double model_displacement[SB_STAGE_COUNT], model_force[SB_STAGE_COUNT]; // NaN: not reached
  SbMeasuredBand band; // of several cycles; end 0: there is one
} SbComparison;

// Compares with a run's loop. Owned by the caller.
SbComparison *sb_comparison_create(const SbMeasured *measured, const SbLoop *loop);

// Takes NULL.
void sb_comparison_free(SbComparison *comparison);
G_DEFINE_AUTOPTR_CLEANUP_FUNC(SbComparison, sb_comparison_free)
