// Parameters from residuals: the robust least-squares fit, the noise, and the posterior.
//
// Each coordinate z is standard normal a priori; the caller maps coordinates to values. The
// variance of a residual is sigma^2/weight, with the sigma of its group, which is estimated, or
// 1/weight in the group SB_NOISE_KNOWN. The loss is Huber's (1964) with the transition at 2.5
// deviations: so close to squares that the posterior of normal noise is that of squares (its
// variance is 2 % too large), and bounded in the influence of an outlier. The noise is Huber's
// proposal 2 with the same transition.
//
// Successive residuals are correlated where the model cannot follow the data or the record is
// filtered. The deviation sigma then contains this discrepancy, and the loss of a group is divided
// by `spread`: n rows count as n/tau independent ones, with the integrated autocorrelation tau = 1
// + 2 sum rho_k along the loop (the variance of a mean of correlated rows; Geyer 1992). This is an
// upper bound of a parameter's variance if the discrepancy is smooth. With few independent
// differences their deviation is uncertain: with nu = n/tau - coordinates the variance is larger by
// (n/tau)/nu and by that of Student's t, nu/(nu - 2).
//
// The fit is the mode of the posterior in z: GSL's nonlinear least squares (Levenberg and
// Marquardt), with the weights of the loss updated until they converge. The posterior is sampled
// from there by Metropolis' algorithm. Every other proposal is a step of a random walk with the
// fit's covariance (Roberts, Gelman and Gilks 1997); the others are independent draws of Student's
// t about the fit (Tierney 1994). The noise is constant while sampling. Scale and covariance adapt
// only in the first part, which is discarded. Equal seeds give equal chains.
#pragma once

#include "engine/base/status.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

// Group of residuals with known variance; largest number of coordinates.
enum { SB_NOISE_KNOWN = 255, SB_INFERENCE_COORDINATES = 64 };

// The problem. Everything is borrowed for the call.
typedef struct {
  size_t coordinates; // at most SB_INFERENCE_COORDINATES
  size_t residuals;
  size_t groups;        // at most 64
  const uint8_t *group; // [residuals]: 0 to groups - 1, or SB_NOISE_KNOWN
  const double *weight; // [residuals], positive
  const double *start;  // [coordinates]: initial guess; NULL: all 0, the median of the prior
  // Writes residual[residuals] at z[coordinates]; large residuals if there is no model at z.
  // Returns false to end with SB_ERROR_CANCELLED.
  bool (*evaluate)(void *data, double *residual, const double *z);
  // Writes jacobian[residuals][coordinates], the derivatives of the residuals at z, for which
  // `residual` was just computed. Returns as `evaluate`. NULL: finite differences.
  bool (*differentiate)(void *data, double *jacobian, const double *z, const double *residual);
  // As `differentiate`, at the fit, for covariance and posterior; NULL: `differentiate`.
  bool (*differentiate_fit)(void *data, double *jacobian, const double *z, const double *residual);
  void *data;
  uint64_t seed;
  size_t samples; // of the posterior; 0: none
  bool linear;    // sample the model linearised about the fit, without evaluations
} SbInferenceAsked;

// The result. Freed by sb_inference_release().
typedef struct {
  bool converged;     // the steps of the fit fell below their tolerance
  size_t evaluations; // calls of `evaluate`
  double *z;          // [coordinates] of the fit
  double *residual;   // [residuals] at the fit
  double *jacobian;   // [residuals][coordinates] at the fit
  double *covariance; // [coordinates][coordinates] of z, of the linearised model
  double sigma[64];   // [groups]: estimated deviation of a residual of weight 1
  double spread[64];  // [groups]: divides the loss; 1: independent rows
  size_t samples;
  double *sample;  // [samples][coordinates]
  double accepted; // fraction of the proposals that were accepted
} SbInference;

// Fits and samples. Call sb_inference_release() in any case. Returns SB_OK; SB_ERROR_CANCELLED (`z`
// is the best point so far; fewer samples than requested, or none); SB_ERROR_NOT_CONVERGED (the fit
// has not converged, but the result is complete, except that samples are missing if the covariance
// is not positive definite).
SbStatus sb_inference(SbInference *out, const SbInferenceAsked *asked, SbReport *report);

// Frees the arrays.
void sb_inference_release(SbInference *inference);
