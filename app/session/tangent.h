// Slopes of a solved run, the base, by one real parameter: of its frames and its contacts'
// profiles, for pictures of predictions (prediction.h). Slopes of figures are the engine's
// (gradient.h).
//
//   ds/dp = (s(p0 + h) - s(p0 - h))/2h
//
// of runs whose rings are the base's to first order (sb_run_predict_from()); at an end of the
// parameter's range (s(p0 + h) - s(p0))/h, with such a run of no change for s(p0). Frames
// correspond where they lie at the same share of the time from one event to the next, profiles
// where the contact is in the same state, point by point; films by their logarithms. h is a
// ten-thousandth of the value.
//
// Loop and profiles have the mean of both sides at a kink. Nothing has a slope where events come or
// go between the sides, or where frames are more than are worth storing.
#pragma once

#include "app/session/displayed_run.h"

// Part of the value by which a parameter is moved.
#define SB_TANGENT_STEP 1e-4

// The runs beside a base; NULL of one side: there is no room for it.
typedef struct {
  const SbDisplayedRun *level; // of no change
  const SbDisplayedRun *up, *down;
} SbTangentRuns;

// NULL where there is none. All runs are complete and only read. Owned by the caller.
SbTangent *sb_tangent_new(const SbDisplayedRun *base, const SbTangentRuns *runs, SbParamId id);
void sb_tangent_free(SbTangent *tangent); // takes NULL

// Adds the change of a frame of the base, `by` of the parameter [SI]. Displacement and force alone
// for a loop.
void sb_tangent_add_frame(SbFrame *out, const SbTangent *tangent, size_t frame, double by);
void sb_tangent_add_loop(double *displacement, double *force, const SbTangent *tangent,
                         size_t frame, double by);

// The arrays of a profile, each of as many points as the base's.
typedef struct {
  double *x, *pressure, *film, *asperity;
} SbTangentProfile;

// The same for a profile of the base; false where that has no slopes.
bool sb_tangent_add_profile(SbTangentProfile *out, const SbTangent *tangent, uint32_t profile,
                            double by);
