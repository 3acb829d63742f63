// The method `reliability` of a study: the most probable failure of each limit, and points about
// them (engine/numeric/reliability.h).
//
// The searches hang on the study alone: every shard and every process repeats them and has the same
// points, whose answers go through the store like any study's.
#pragma once

#include "app/document/study_file.h"

#include "engine/numeric/reliability.h"

// Of one side of one limit.
typedef struct {
  size_t limit; // of the study
  bool upper;   // its highest value, else its lowest
  SbFailurePoint found;
  double *u, *value; // [vary]: where the search ended, in normal variates and in SI
} SbFailureMode;

typedef struct {
  size_t count;
  SbFailureMode *mode; // [count]
  size_t centres;
  double *centre; // [centres][vary]: of those that were found and are no failures at the median
  double *memory;
} SbReliability;

// Searches, on `jobs` threads. *out is to be released in any case. `cancelled` is called from any
// thread.
SbStatus sb_reliability_search(SbReliability *out, const SbStudyFile *study, int jobs,
                               bool (*cancelled)(void *data), void *data, SbReport *report);
void sb_reliability_release(SbReliability *reliability);

// Values [samples][vary] in SI and the normal variates behind them. Owned by the caller.
SbStatus sb_reliability_points(double **value, double **u, const SbStudyFile *study,
                               const SbReliability *reliability, SbReport *report);
