// Comparison of a measured loop with a computed one: force against stem displacement, on the
// in-stroke and on the return, and the differences at equal displacement.
#pragma once

#include "app/data/measured.h"

#include "engine/valve/run/run.h"

// The first cycle of a run while the stem slides: index 0 is the in-stroke from stage B to D, index
// 1 the return from E to the end. Initialise it with zeros, which is an empty loop.
typedef struct {
  size_t count[2]; // number of points
  // [count], in the order of time: strictly increasing on the in-stroke, decreasing on the return.
  double *displacement[2];                   // of the stem [m], from rest
  double *force[2];                          // of the drive on the stem [N]
  double stage_displacement[SB_STAGE_COUNT]; // just before the event [m]; NaN: not reached
  double stage_force[SB_STAGE_COUNT];        // [N]
  double stage_error[SB_STAGE_COUNT];        // of the force, as sb_figure_error()
} SbLoop;

// Replaces the content of `loop` with the loop of a finished run, and reuses its memory. Returns
// false if the in-stroke has fewer than two points: such a loop can only be cleared.
bool sb_loop_take(SbLoop *loop, const SbRun *run);

// Frees the arrays; the loop is empty afterwards.
void sb_loop_clear(SbLoop *loop);

// Returns the force of the loop [N] at a displacement [m], linear between points, on the in-stroke
// (`way` 0) or on the return (1). Up to 1 % of their range outside the points it is the force of
// the nearest one; further outside, and without two points, NaN.
double sb_loop_force(const SbLoop *loop, int way, double displacement);

// Largest number of points of a comparison.
enum { SB_COMPARISON_POINTS = 200000 };

// Scatter of several cycles: the stroke from 0 to `end` [m] is divided into equal pieces.
enum { SB_MEASURED_BAND = 200 };
typedef struct {
  double end; // [m]
  // [way][piece][0 minimum, 1 maximum] of the force in the cycles in use [N]; NaN: no row there
  double force[2][SB_MEASURED_BAND][2];
} SbMeasuredBand;

// Differences between a measured and a computed loop.
typedef struct {
  const SbMeasured *measured; // borrowed
  size_t count;               // points
  size_t outside;             // of these, points at displacements where the loop has no force
  SbMeasuredPoint *point;     // [count]: measured rows, or means of neighbouring rows
  double *residual;           // [count]: measured minus computed force [N]; NaN: outside
  double rms, mean;           // of the residuals, weighted by rows [N]; NaN without a residual
  double most;                // largest magnitude of a residual [N]; NaN without a residual
  double model_displacement[SB_STAGE_COUNT]; // of the loop, just before the event [m]
  double model_force[SB_STAGE_COUNT];        // [N]; NaN: stage not reached
  double model_error[SB_STAGE_COUNT];        // of the force, as sb_figure_error()
  SbMeasuredBand band; // scatter of the measured cycles; `end` is 0 if only one cycle is used
} SbComparison;

// Compares `measured` with the loop of a run, for which sb_loop_take() returned true; the loop is
// only read. `measured` is borrowed: it must outlive the result. Never NULL; without common
// displacements all residuals are NaN. Freed by sb_comparison_free().
SbComparison *sb_comparison_create(const SbMeasured *measured, const SbLoop *loop);

// Frees a comparison, not the measured loop.
void sb_comparison_free(SbComparison *comparison);
G_DEFINE_AUTOPTR_CLEANUP_FUNC(SbComparison, sb_comparison_free)
