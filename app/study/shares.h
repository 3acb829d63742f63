// How many of a study's valves are beyond its limits.
#pragma once

#include "app/study/answers.h"
#include "app/study/reliability.h"

// What the method drew: points, and where `reliability` looked for failures.
typedef struct {
  const double *unit;               // of sb_study_file_points() or sb_reliability_points()
  const SbReliability *reliability; // NULL: of another method
} SbStudyDrawn;

// Probability of values beyond a limit, among valves, with an interval that covers the sampling
// alone: samples that are none are left out, those of which a solver did not converge widen the
// interval. NaN where samples about failures are missing.
typedef struct {
  size_t beyond, of;
  double probability, interval[2], beta; // beta: normal quantile of the probability
  bool certain;                          // every sample with an answer is beyond the limit
  char reason[SB_TEXT];                  // why it is 0 or certain, or nothing
} SbLimitShare;

// `limit` of the study, or one past them: any of them. SB_ERROR_MEMORY.
SbStatus sb_study_limit_share(SbLimitShare *out, const SbStudyFile *study,
                              const SbStudyDrawn *drawn, const SbAnswers *answers, size_t limit,
                              SbReport *report);

// Column of a figure among the answers', -1: not asked.
int sb_study_column_of(const SbStudyFile *study, int figure);
