// What residuals say about parameters: the robust least-squares fit, the noise, and the posterior.
//
// Coordinates z are such that each is standard normal a priori; whoever asks maps them to values.
// A residual's variance is sigma^2/weight with the sigma of its group, which is estimated, or
// 1/weight in the group SB_NOISE_KNOWN. Loss: Huber's (1964) with the bend at 2.5 deviations, near
// enough to squares that the posterior of normal noise is that of squares (variance too large by
// 2 %), bounded in what an outlier pulls. Noise: Huber's proposal 2 with the same bend.
//
// Residuals that follow each other are correlated where the model cannot follow the data, or the
// record is filtered. The deviation sigma then has this discrepancy, and the loss of a group is
// divided by `spread`: n rows count as n/tau independent ones, with the integrated autocorrelation
// tau = 1 + 2 sum rho_k along the loop (the variance of a mean of correlated rows; Geyer 1992). It
// is an upper bound of the variance of a parameter where the discrepancy is smooth. Few independent
// differences know their own deviation badly: with nu = n/tau - coordinates the variance is larger
// by (n/tau)/nu and by that of Student's t, nu/(nu - 2).
//
// The fit is the posterior's mode in z: GSL's nonlinear least squares (Levenberg and Marquardt)
// with the weights of the loss renewed until they stand. The posterior is sampled from there by
// Metropolis' algorithm, every other proposal a step of the random walk with the fit's covariance
// (Roberts, Gelman and Gilks 1997), the others independent draws of Student's t about the fit
// (Tierney 1994); the noise is held. Scale and covariance adapt in the first part alone, which is
// dropped. Equal seeds give equal chains.
#pragma once

#include "engine/base/status.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum { SB_NOISE_KNOWN = 255, SB_INFERENCE_COORDINATES = 64 };

typedef struct {
  size_t coordinates, residuals, groups;
  const uint8_t *group; // [residuals], < groups <= 64 or SB_NOISE_KNOWN
  const double *weight; // [residuals]
  const double *start;  // [coordinates]; NULL: 0
  // residual[residuals] at z. False ends the work (SB_ERROR_CANCELLED). Where there is no model,
  // large residuals.
  bool (*evaluate)(void *data, double *residual, const double *z);
  // jacobian[residuals][coordinates] at z, where `residual` has been found. NULL: differences.
  bool (*differentiate)(void *data, double *jacobian, const double *z, const double *residual);
  // The same at the fit, for covariance and posterior; NULL: `differentiate`.
  bool (*differentiate_fit)(void *data, double *jacobian, const double *z, const double *residual);
  void *data;
  uint64_t seed;
  size_t samples; // of the posterior, 0: none
  bool linear;    // the chain takes the fit's tangent in the model's place
} SbInferenceAsked;

typedef struct {
  bool converged;
  size_t evaluations;
  double *z;          // [coordinates] of the fit
  double *residual;   // [residuals] there
  double *jacobian;   // [residuals][coordinates] there
  double *covariance; // [coordinates][coordinates] of z by the tangent
  double sigma[64];   // of the groups
  double spread[64];  // divides the loss of a group, 1 where rows are independent
  size_t samples;
  double *sample;  // [samples][coordinates]
  double accepted; // share of the proposals
} SbInference;

// *out is to be released in any case. SB_ERROR_CANCELLED: `z` is the best place so far, without
// samples; SB_ERROR_MEMORY; SB_ERROR_NOT_CONVERGED with a fit whose steps did not end.
SbStatus sb_inference(SbInference *out, const SbInferenceAsked *asked, SbReport *report);
void sb_inference_release(SbInference *inference);
