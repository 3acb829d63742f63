// Range checks of input numbers that report the input at fault.
#pragma once

#include "engine/base/status.h"

#include <float.h>

// A number and its allowed range [low, high], both inclusive. NaN is never in the range. Infinity
// is in the range only if `high` (or -`low`) is infinite.
typedef struct {
  int input;               // number of the input for the report; 0: none
  const char *what;        // subject of the sentence, with its unit: "the moving mass [kg]"
  double value, low, high; // in the unit that `what` names
} SbBound;

// Values of `low, high` in an SbBound, for finite numbers: greater than 0; at least 0; any;
// Poisson's ratio of a compressible body, 0 <= nu < 0.5.
#define SB_ABOVE_ZERO   DBL_MIN, DBL_MAX
#define SB_NOT_NEGATIVE 0.0, DBL_MAX
#define SB_FINITE       -DBL_MAX, DBL_MAX
#define SB_POISSON      0.0, 0.5 * (1.0 - DBL_EPSILON)

// Checks `count` numbers in order. Returns SB_OK, or SB_ERROR_RANGE with the input and the range of
// the first number that is outside. The strings are only read during the call.
SbStatus sb_check_bounds(const SbBound *bound, size_t count, SbReport *report);

// Calls sb_check_bounds() with the bounds given as arguments: SB_CHECK(report, {input, what, value,
// low, high}, ...).
#define SB_CHECK(report, ...)                                                                      \
  sb_check_bounds((const SbBound[]){__VA_ARGS__},                                                  \
                  sizeof((const SbBound[]){__VA_ARGS__}) / sizeof(SbBound), report)
