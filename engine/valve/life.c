// See life.h.
#include "engine/valve/life.h"

#include <math.h>

double sb_life_roughness(const SbRunningIn *law, long n) {
  return law->end + (law->start - law->end) * exp(-(double)n / law->actuations);
}

// Kahan's sum: `lost` is what rounding took from it.
static void add_to(double *sum, double *lost, double value) {
  double add = value - *lost, next = *sum + add;
  *lost = (next - *sum) - add;
  *sum = next;
}

SbStatus sb_life_run(SbLife *life, SbLifeActuation *each, const SbRunningIn *law, long count,
                     SbStatus (*actuate)(SbLifeActuation *out, long n, double roughness, void *user,
                                         SbReport *report),
                     bool (*cancelled)(void *user), void *user, SbReport *report) {
  *life = (SbLife){.peak_first = NAN, .peak_last = NAN, .return_least = NAN};
  if (count < 1 || !(law->start >= 0.0) || !(law->end >= 0.0) || !(law->actuations > 0.0) ||
      !isfinite(law->start) || !isfinite(law->end)) {
    return sb_fail(report, SB_ERROR_RANGE,
                   "a life needs at least one actuation and a running-in above 0");
  }
  SbStatus status = sb_succeed(report);
  double lost[2] = {0.0, 0.0}; // rounding of the sums
  bool goes_on = true;
  for (long n = 0; n < count && status == SB_OK && goes_on; n++) {
    SbLifeActuation one = {0};
    status = cancelled != NULL && cancelled(user)
                 ? sb_fail(report, SB_ERROR_CANCELLED, "cancelled after %ld actuations", n)
                 : actuate(&one, n, sb_life_roughness(law, n), user, report);
    if (status != SB_OK) {
      break;
    }
    one.roughness = sb_life_roughness(law, n);
    add_to(&life->leakage, &lost[0], one.leakage);
    add_to(&life->carried, &lost[1], one.carried);
    if (n == 0) {
      life->peak_first = one.force_peak;
    }
    life->peak_last = one.force_peak;
    life->return_least = fmin(life->return_least, one.force_return); // without NaN
    life->failure = one.returned == 0 ? n + 1 : 0;
    goes_on = one.returned > 0;
    if (each != NULL) {
      each[n] = one;
    }
    life->done = n + 1;
  }
  if (life->done < count) {
    life->leakage = life->carried = life->peak_last = NAN;
  }
  return status;
}
