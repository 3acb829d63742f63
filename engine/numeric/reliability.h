// Small probabilities: the most probable point of failure, and samples drawn about it.
//
// Everything lies in the space of independent standard normal variates u. A limit state g(u) is
// positive where the limit holds. Its most probable failure u* is the point of g = 0 nearest to 0,
// at the distance beta; Phi(-beta) is the probability of failure if g is linear (FORM). Samples
// drawn about such points, weighted by the ratio of the densities, give the probability whatever g
// is: the points only decide how many samples that takes.
//
// Sources: Zhang and Der Kiureghian, "Two improved algorithms for reliability analysis" (1995), for
// the search; Veach and Guibas (1995) for weights over a mixture of densities.
#pragma once

#include "engine/base/status.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum { SB_RELIABILITY_DIMENSIONS = 64 };

// Value and gradient [dimensions] of a limit state at u. A value of NaN: there is none here. A
// component of the gradient that is NaN: not differentiable here. An error ends the search.
typedef SbStatus (*SbLimitState)(double *value, double *gradient, const double *u, void *data);

typedef enum {
  SB_SEARCH_FOUND,
  SB_SEARCH_FLAT,     // no gradient: nothing changes the limit state here
  SB_SEARCH_FAR,      // beyond SB_SEARCH_FARTHEST
  SB_SEARCH_KINK,     // not differentiable on the way
  SB_SEARCH_NO_VALUE, // none at the median
  SB_SEARCH_STALLED   // no step lessens the merit function, or too many
} SbSearchEnd;

// Phi(-8) is 6e-16: nobody draws that.
#define SB_SEARCH_FARTHEST 8.0

// What an end means, as a part of a sentence; borrowed.
const char *sb_search_text(SbSearchEnd end);

typedef struct {
  SbSearchEnd end;
  double beta;        // distance, negative where the median fails; NaN unless found
  double value;       // of the limit state at the median; NaN: none
  double slope;       // length of its gradient there
  size_t evaluations; // of the limit state
} SbFailurePoint;

// What a search ended with, as a part of a sentence: unlike sb_search_text() it distinguishes
// limits that are never reached because they hold everywhere from those that fail everywhere.
// Static.
const char *sb_failure_text(const SbFailurePoint *found);

// Searches from the median: u[dimensions] becomes the failure point, or where the search ended.
// The tolerance is that of u, relative from 1 on.
SbStatus sb_failure_point(SbFailurePoint *out, double *u, size_t dimensions, SbLimitState state,
                          void *data, double tolerance, SbReport *report);

// Points u [samples][dimensions] of which every fifth is drawn about 0 and the others in turn about
// the `centres` [centres][dimensions]; all about 0 where there are none.
void sb_sample_importance(double *u, size_t samples, size_t dimensions, const double *centre,
                          size_t centres, uint64_t seed);

// Ratio of the standard normal density to that of those points, at u: at most 5.
double sb_importance_weight(const double *u, size_t dimensions, const double *centre,
                            size_t centres);

// LEFT_OUT is none of those that the probability is of; UNKNOWN is one of them without an answer.
typedef enum { SB_TRIAL_HOLDS, SB_TRIAL_FAILS, SB_TRIAL_UNKNOWN, SB_TRIAL_LEFT_OUT } SbTrial;

// Probability of failure among trials that have an answer, with its interval of 95 %, which covers
// the sampling alone (neither models nor distributions) and which trials without an answer widen:
// of the logarithm by the central limit theorem; of plain trials Clopper and Pearson's.
typedef struct {
  size_t failed, known;
  double probability, interval[2];
} SbWeightedShare;

// `weight` [samples]; NULL: plain trials.
void sb_weighted_share(SbWeightedShare *out, const double *weight, const uint8_t *trial,
                       size_t samples);
