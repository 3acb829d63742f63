// Probabilities of failure: fractions of a study's samples that violate its limits.
#pragma once

#include "app/study/answers.h"
#include "app/study/reliability.h"

// The points with which the results were computed. Borrowed.
typedef struct {
  const double *unit; // [samples][vary]: *u of sb_reliability_points(); of another method *unit of
                      // sb_study_file_points(), not read here
  const SbReliability *reliability; // NULL: another method
} SbStudyDrawn;

// Probability that a valve violates a limit, with an interval that covers only the sampling.
// Infeasible samples are omitted; `unknown` samples widen the interval: their solver did not
// converge, or they have no value of the figure, as where the stem never moves. NaN if samples
// about failures are missing.
typedef struct {
  size_t beyond, of;    // samples that violate the limit, of all samples with a value
  size_t unknown;       // samples without a value
  double unknown_share; // their share of the population, 0 to 1
  double probability;   // 0 to 1
  double interval[2];   // 95 % interval of the probability
  double beta;  // reliability index: -(normal quantile of the probability); NaN: it is 0 or 1
  bool certain; // every sample with a result violates the limit
  char reason[SB_TEXT]; // why the probability is 0 or 1, or not known of all; empty: neither
} SbLimitShare;

// Computes the probability for limit `limit` of study->limits, or for limit == study->limits.count
// the probability that any limit is violated. `answers` has the figures of study->figures for all
// samples. Returns SB_OK or SB_ERROR_MEMORY.
SbStatus sb_study_limit_share(SbLimitShare *out, const SbStudyFile *study,
                              const SbStudyDrawn *drawn, const SbAnswers *answers, size_t limit,
                              SbReport *report);

// Returns the index of a figure (of sb_figure()) in study->figures, which is its column in the
// results; -1: it is not there.
int sb_study_column_of(const SbStudyFile *study, int figure);
