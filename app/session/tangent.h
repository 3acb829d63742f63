// Derivatives of a converged run, the base, by one real parameter p: of its frames and of the
// profiles of its contacts, for pictures of predictions (prediction.h). Derivatives of figures are
// the engine's (gradient.h).
//
//   ds/dp = (s(p0 + h) - s(p0 - h))/2h
//
// from runs whose rings are those of the base to first order (sb_run_predict_from()). At an end of
// the parameter's range it is (s(p0 + h) - s(p0))/h, with such a run without a change for s(p0); h
// is SB_TANGENT_STEP times the value. Frames of two runs correspond at the same fraction of the
// time from one event to the next; profiles correspond point by point where the contact is in the
// same state; films are differentiated by their logarithms.
//
// At a kink the derivative is the mean of both sides. There is none if events appear or disappear
// between the sides, or if the base has too many frames.
#pragma once

#include "app/session/displayed_run.h"

// Relative change of the parameter, h/p0.
#define SB_TANGENT_STEP 1e-4

// The runs from which a derivative is computed. One of `up` and `down` is NULL at an end of the
// parameter's range.
typedef struct {
  const SbDisplayedRun *level; // at p0
  const SbDisplayedRun *up;    // at p0 + h
  const SbDisplayedRun *down;  // at p0 - h
} SbTangentRuns;

// Returns the derivatives by parameter `id`; NULL: there are none. All runs must be complete; they
// are only read and not needed afterwards. Freed by sb_tangent_free().
SbTangent *sb_tangent_new(const SbDisplayedRun *base, const SbTangentRuns *runs, SbParamId id);

// Frees the derivatives.
void sb_tangent_free(SbTangent *tangent);

// Adds to *out, a copy of frame number `frame` of the base, its change if the parameter changes by
// `by` [SI].
void sb_tangent_add_frame(SbFrame *out, const SbTangent *tangent, size_t frame, double by);

// As sb_tangent_add_frame(), only for the stem's displacement [m] and the force [N].
void sb_tangent_add_loop(double *displacement, double *force, const SbTangent *tangent,
                         size_t frame, double by);

// The arrays of a profile, with as many points as that of the base. None is NULL.
typedef struct {
  double *x;        // [m]
  double *pressure; // contact pressure [Pa]
  double *film;     // film thickness [m]
  double *asperity; // pressure of the asperities [Pa]
} SbTangentProfile;

// Adds to `out`, copies of the arrays of profile number `profile` of the base, their change if the
// parameter changes by `by` [SI]. Returns false, without a change, if this profile has no
// derivatives.
bool sb_tangent_add_profile(SbTangentProfile *out, const SbTangent *tangent, uint32_t profile,
                            double by);
