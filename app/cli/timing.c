// Medians of repeated solves.
#include "app/cli/timing.h"

#include "app/base/number.h"

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
    *wall_s = sb_number_median(times, (size_t)count);
  }
  return status;
}
