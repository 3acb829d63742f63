// Greenwood and Tripp's rough contact: share of the area in real contact and pressure on the
// asperities.
//
// Source: Greenwood & Tripp (1970); thesis equations 5.11 to 5.13. Two rough surfaces with Gaussian
// heights of combined standard deviation sigma, asperities of tip radius beta and density zeta, at
// mean separation h = lambda sigma:
//
//   A_a/A = pi^2 (zeta beta sigma)^2 F_2(lambda)
//   p_a   = (8 sqrt 2/15) pi (zeta beta sigma)^2 sqrt(sigma/beta) E' F_5/2(lambda)
//   F_n(lambda) = 1/sqrt(2 pi) integral_lambda^inf (s - lambda)^n exp(-s^2/2) ds
//
// with E' of thesis equation 5.8 (the usual factor 16 sqrt 2/15 goes with half that modulus).
// Validity: elastic, independent asperities, so a real contact share well below one; the share is
// limited to 1.
#pragma once

#include "engine/base/status.h"

// Range in which sb_gt_integrals() is accurate to 1e-12 relative. Above it the integrals underflow.
#define SB_GT_LAMBDA_MIN (-10.0)
#define SB_GT_LAMBDA_MAX 37.0

typedef struct {
  double lambda;  // mean gap over sigma
  double F2;      // F_2(lambda)
  double F5_2;    // F_5/2(lambda)
  bool underflow; // lambda > SB_GT_LAMBDA_MAX: both integrals reported as 0
} SbGtIntegrals;

// ln F_n(lambda) for n = 1, 3/2, 2, 5/2; F_n' = -n F_(n-1).
void sb_gt_log_integrals(double out[4], double lambda);

// Integrals at `lambda` (film over height deviation, dimensionless). SB_ERROR_INPUT if it is not
// finite, SB_ERROR_RANGE below SB_GT_LAMBDA_MIN (surfaces pressed ten standard deviations into each
// other).
SbStatus sb_gt_integrals(SbGtIntegrals *out, double lambda, SbReport *report);

// Real over nominal area, at most 1, at `lambda`; NaN where sb_gt_integrals() refuses it. `product`
// is zeta beta sigma.
double sb_gt_area_share(double product, double lambda);

// The same of the asperities' pressure [Pa]. `modulus` is E' of thesis equation 5.8 [Pa].
double sb_gt_pressure(double product, double sigma_over_beta, double modulus, double lambda);
