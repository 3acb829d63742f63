// Small failure probabilities: search of the most probable failure point, and importance sampling
// around it.
//
// All points u are in the space of independent standard normal variates. A limit state g(u) is
// positive where the limit is met and negative where it is violated. The most probable failure
// point u* is the point of g = 0 with the smallest distance beta from the origin (the median of all
// inputs). If g is linear, the failure probability is Phi(-beta) (FORM). Samples around failure
// points, weighted by the ratio of the densities, give an unbiased probability for any g. The
// points only determine how many samples are needed.
//
// Sources: Zhang and Der Kiureghian, "Two improved algorithms for reliability analysis" (1995), for
// the search; Veach and Guibas (1995) for the weights of a mixture of densities. The functions have
// no state and may be called concurrently.
#pragma once

#include "engine/base/status.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

// Largest number of dimensions.
enum { SB_RELIABILITY_DIMENSIONS = 64 };

// Computes *value = g(u) and gradient[dimensions] = dg/du at u[dimensions]. *value is NaN if g is
// not defined at u. A component of `gradient` is NaN if g is not differentiable there. `dimensions`
// and `data` are arguments of sb_failure_point(). A status other than SB_OK ends the search.
typedef SbStatus (*SbLimitState)(double *value, double *gradient, const double *u, void *data);

// How a search ended.
typedef enum {
  SB_SEARCH_FOUND,    // the failure point was found
  SB_SEARCH_FLAT,     // the gradient is 0: no variate changes g at the last point
  SB_SEARCH_FAR,      // no failure point within the distance SB_SEARCH_FARTHEST
  SB_SEARCH_KINK,     // the gradient is NaN at the last point
  SB_SEARCH_NO_VALUE, // g is NaN at the median
  SB_SEARCH_STALLED   // no step reduces the merit function, or 60 steps were not enough
} SbSearchEnd;

// Largest distance of a failure point that is searched: Phi(-8) = 6e-16.
#define SB_SEARCH_FARTHEST 8.0

// Result of a search.
typedef struct {
  SbSearchEnd end;
  double beta;  // distance of the failure point from the median, negative if the median fails; NaN
                // unless SB_SEARCH_FOUND
  double value; // g at the median; NaN: not defined
  double slope; // length of the gradient of g at the median
  size_t evaluations; // number of evaluations of g
} SbFailurePoint;

// Returns the meaning of a result as a clause, without a full stop; static. It
// distinguishes a limit that is met within the whole searched range from one that is violated
// there.
const char *sb_failure_text(const SbFailurePoint *found);

// Searches the most probable failure point from the median u = 0. Writes to u[dimensions] the
// failure point, or the last point if none was found. `tolerance` is that of u, absolute for |u| <
// 1, else relative. Returns SB_OK for every SbSearchEnd. SB_ERROR_RANGE: `dimensions` is not 1 to
// SB_RELIABILITY_DIMENSIONS. An error of `state` is returned unchanged, without a report.
SbStatus sb_failure_point(SbFailurePoint *out, double *u, size_t dimensions, SbLimitState state,
                          void *data, double tolerance, SbReport *report);

// Writes `samples` random points to u[samples][dimensions]. Points 0, 5, 10 ... are drawn around 0,
// the other ones in turn around the points centre[centres][dimensions], each with unit variance. If
// `centres` is 0, all points are drawn around 0, and `centre` may be NULL. Equal seeds give equal
// points.
void sb_sample_importance(double *u, size_t samples, size_t dimensions, const double *centre,
                          size_t centres, uint64_t seed);

// Returns the weight of a point u[dimensions] of sb_sample_importance() with the same
// centre[centres][dimensions]: the standard normal density divided by the sampling density, 0 to 5.
// If `centres` is 0 the weight is 1, and `centre` may be NULL.
double sb_importance_weight(const double *u, size_t dimensions, const double *centre,
                            size_t centres);

// Outcome of one sample.
typedef enum {
  SB_TRIAL_HOLDS,   // the limit is met
  SB_TRIAL_FAILS,   // the limit is violated
  SB_TRIAL_UNKNOWN, // belongs to the population, but has no result
  SB_TRIAL_LEFT_OUT // does not belong to the population
} SbTrial;

// Estimated failure probability of the population.
typedef struct {
  size_t failed;      // number of trials that failed
  size_t known;       // number of trials that failed or held
  double unknown;     // share of the population that has no result, 0 to 1
  double probability; // among known trials; NaN if `known` is 0
  double interval[2]; // 95 % interval, lower and upper end; NaN if `known` is 0. It covers the
                      // sampling error only and is widened by the unknown trials
} SbWeightedShare;

// Estimates the failure probability from the outcomes trial[samples] (values of SbTrial). `weight`
// [samples] is that of sb_importance_weight(); the interval then follows from the central limit
// theorem for the logarithm. NULL: unweighted trials, with the interval of Clopper and Pearson.
void sb_weighted_share(SbWeightedShare *out, const double *weight, const uint8_t *trial,
                       size_t samples);
