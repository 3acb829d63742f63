// Medians of repeated solves.
#include "app/cli/timing.h"

#include <stdlib.h>

static int compare(const void *a, const void *b) {
  double x = *(const double *)a;
  double y = *(const double *)b;
  return (x > y) - (x < y);
}

double sb_timing_middle(double *times, size_t count) {
  qsort(times, count, sizeof times[0], compare);
  return (times[(count - 1) / 2] + times[count / 2]) / 2;
}

SbStatus sb_timing_median(double *wall_s, SbTimedSolve solve, void *data) {
  enum { REPEATS = 20 };
  const double budget = 0.5;
  double times[REPEATS];
  SbStatus status = solve(data, wall_s);
  double spent = *wall_s;
  int count = 0;
  while (status == SB_OK && count < REPEATS && spent + *wall_s < budget) {
    status = solve(data, &times[count]);
    spent += times[count];
    count++;
  }
  if (status == SB_OK && count > 0) {
    *wall_s = sb_timing_middle(times, (size_t)count);
  }
  return status;
}
