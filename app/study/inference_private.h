// Shared by inference.c (fit) and inference_chain.c (sampling of the posterior).
#pragma once

#include "app/study/inference.h"

// An inference under way. The caller of sb_inference() owns `asked` and `out`.
typedef struct {
  const SbInferenceAsked *asked;
  SbInference *out;
  double *known_z;                        // [coordinates]: coordinates of the last evaluation
  double *known_residual;                 // [residuals]: its residuals
  bool known;                             // both are valid
  bool cancelled;                         // the caller cancelled
  bool at_fit;                            // derivatives are those of the posterior
  double place[SB_INFERENCE_COORDINATES]; // coordinates of the last derivatives of the fit
} SbInferenceWork;

// Writes residual[residuals] at z[coordinates], from the last call if z is the same. Returns false
// if the caller cancelled.
bool sb_inference_evaluate(SbInferenceWork *work, double *residual, const double *z);

// Returns the logarithm of the posterior's density at z[coordinates] with residual[residuals]
// there, without a constant.
double sb_inference_log_density(const SbInferenceWork *work, const double *residual,
                                const double *z);

// Samples the posterior from the fit in work->out. Writes to out->sample, which the caller has
// allocated, counts out->samples, which is 0 before, and sets out->accepted. Returns false if
// cancelled, or if the covariance is not positive definite.
bool sb_inference_sample(SbInferenceWork *work);
