// The method `reliability` of a study: the most probable failure of each limit, and samples about
// these points (engine/numeric/reliability.h).
//
// The searches depend only on the study, so that every shard and every process finds the same
// samples, whose results can be stored like those of any study.
#pragma once

#include "app/document/study_file.h"

#include "engine/numeric/reliability.h"

// The most probable failure of one side of a limit.
typedef struct {
  size_t limit; // index in study->limits
  bool upper;   // the side of the maximum; else of the minimum
  SbFailurePoint found;
  double *u;     // [vary]: where the search ended, in independent standard normal variates
  double *value; // [vary]: the same point in values [SI]
} SbFailureMode;

// All failures. Freed by sb_reliability_release().
typedef struct {
  size_t count;
  SbFailureMode *mode; // [count]
  size_t centres;      // failures that were found and are not at the median
  double *centre;      // [centres][vary]: their points in standard normal variates
  double *memory;      // of `u`, `value` and `centre`
} SbReliability;

// Searches the failures of all limits on `jobs` threads. `cancelled` (may be NULL) is called from
// any thread. Returns SB_OK, SB_ERROR_CANCELLED or the error of a search. Release *out in any case.
SbStatus sb_reliability_search(SbReliability *out, const SbStudyFile *study, int jobs,
                               bool (*cancelled)(void *data), void *data, SbReport *report);

// Frees what the failures own.
void sb_reliability_release(SbReliability *reliability);

// Writes the values [samples][vary] of all samples [SI] to *value, and their standard normal
// variates [samples][vary] to *u; both are freed by free(). `reliability` is the result of
// sb_reliability_search() for this study. Returns SB_OK, or SB_ERROR_MEMORY with both NULL.
SbStatus sb_reliability_points(double **value, double **u, const SbStudyFile *study,
                               const SbReliability *reliability, SbReport *report);
