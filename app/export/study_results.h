// What a study's answers say: a table of all samples, statistics as JSON and for people.
#pragma once

#include "app/document/study_file.h"
#include "app/study/answers.h"
#include "app/study/reliability.h"

#include <stdio.h>

// What the method drew: points, and where `reliability` looked for failures.
typedef struct {
  const double *unit;               // of sb_study_file_points() or sb_reliability_points()
  const SbReliability *reliability; // NULL: of another method
} SbStudyDesign;

// Probability of values beyond a limit, among valves: samples that are none are left out, those of
// which a solver did not converge widen the interval. NaN where samples about failures are missing.
typedef struct {
  size_t beyond, of;
  double probability, interval[2], beta; // beta: normal quantile of the probability
  char reason[160];                      // why it is 0, or nothing
} SbLimitShare;

// `limit` of the study, or one past them: any of them. SB_ERROR_MEMORY.
SbStatus sb_study_limit_share(SbLimitShare *out, const SbStudyFile *study,
                              const SbStudyDesign *design, const SbAnswers *answers, size_t limit,
                              SbReport *report);

// Column of a figure among the answers', -1: not asked.
int sb_study_column_of(const SbStudyFile *study, int figure);

// Samples with an answer, and those of them that failed.
size_t sb_study_done(const SbAnswers *answers);
size_t sb_study_failed(const SbAnswers *answers);

// "ok", "not-converged", "infeasible", "refused", "not-computed"; borrowed.
const char *sb_study_status_name(uint8_t status);

// A row a sample: number from 1, parameters, figures (empty: none), status. The bytes hang on the
// answers alone; errors show in the stream.
void sb_study_csv(FILE *stream, const SbStudyFile *study, const double *value,
                  const SbAnswers *answers);

// The contract's JSON. Owned by the caller; NULL without memory.
char *sb_study_json(const SbStudyFile *study, const SbStudyDesign *design, const SbAnswers *answers,
                    const char *cpus, SbReport *report);
