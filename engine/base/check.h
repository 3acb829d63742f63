// Checks of numbers against their ranges, with the error that names the parameter.
#pragma once

#include "engine/base/status.h"

#include <float.h>

// A number, in the unit of its name, that must lie in [low, high]. Not a number lies nowhere;
// infinity only where `high` is.
typedef struct {
  const char *key;  // of the parameter at fault; "": none
  const char *what; // "the moving mass [kg]"
  double value, low, high;
} SbBound;

// low and high of finite numbers: above 0; not below it; any.
#define SB_ABOVE_ZERO   DBL_MIN, DBL_MAX
#define SB_NOT_NEGATIVE 0.0, DBL_MAX
#define SB_FINITE       -DBL_MAX, DBL_MAX
#define SB_POISSON      0.0, 0.5 * (1.0 - DBL_EPSILON) // of a compressible body

// SB_ERROR_RANGE with the key of the first of `count` numbers that is outside its range.
SbStatus sb_check_bounds(const SbBound *bound, size_t count, SbReport *report);

// The same of bounds written out as its arguments.
#define SB_CHECK(report, ...)                                                                      \
  sb_check_bounds((const SbBound[]){__VA_ARGS__},                                                  \
                  sizeof((const SbBound[]){__VA_ARGS__}) / sizeof(SbBound), report)
