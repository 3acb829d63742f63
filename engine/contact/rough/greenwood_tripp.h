// Greenwood and Tripp's rough contact: fraction of real contact area, and pressure on the
// asperities. The functions have no state and may be called concurrently.
//
// Source: Greenwood & Tripp (1970); thesis equations 5.11 to 5.13. Two rough surfaces have Gaussian
// heights of combined standard deviation sigma, asperities of tip radius beta and density zeta, and
// the mean separation h = lambda sigma:
//
//   A_a/A = pi^2 (zeta beta sigma)^2 F_2(lambda)
//   p_a   = (8 sqrt 2/15) pi (zeta beta sigma)^2 sqrt(sigma/beta) E' F_5/2(lambda)
//   F_n(lambda) = 1/sqrt(2 pi) integral_lambda^inf (s - lambda)^n exp(-s^2/2) ds
//
// with E' of thesis equation 5.8 (the usual factor 16 sqrt 2/15 is for half that modulus). Valid
// for elastic, independent asperities: a fraction of real contact well below 1. The fraction is
// limited to 1.
#pragma once

#include "engine/base/status.h"

// Range in which sb_gt_integrals() has a relative error of 1e-12. Above it the integrals underflow.
#define SB_GT_LAMBDA_MIN (-10.0)
#define SB_GT_LAMBDA_MAX 37.0

// The integrals at one lambda.
typedef struct {
  double lambda;  // h/sigma
  double F2;      // F_2(lambda)
  double F5_2;    // F_5/2(lambda)
  bool underflow; // lambda > SB_GT_LAMBDA_MAX: both integrals are 0
} SbGtIntegrals;

// Writes ln F_n(lambda) for n = 1, 3/2, 2, 5/2 to out[4]; `lambda` >= SB_GT_LAMBDA_MIN. F_n' = -n
// F_(n-1).
void sb_gt_log_integrals(double out[4], double lambda);

// Computes the integrals at `lambda`. SB_ERROR_INPUT: it is not finite. SB_ERROR_RANGE: it is below
// SB_GT_LAMBDA_MIN.
SbStatus sb_gt_integrals(SbGtIntegrals *out, double lambda, SbReport *report);

// Returns the fraction of real contact area at `lambda`, at most 1; NaN where sb_gt_integrals()
// fails. `product` is zeta beta sigma [1].
double sb_gt_area_share(double product, double lambda);

// Returns p_a [Pa] at `lambda`; NaN where sb_gt_integrals() fails. `product` is zeta beta sigma
// [1], `modulus` is E' of thesis equation 5.8 [Pa], 2/E' = sum (1 - nu^2)/E.
double sb_gt_pressure(double product, double sigma_over_beta, double modulus, double lambda);
