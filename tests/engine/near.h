// How tests say that two numbers agree, and look a warning up.
#pragma once

#include "engine/base/status.h"
#include "engine/valve/model/params.h"

#include <glib.h>
#include <math.h>

#define ASSERT_NEAR(a, b, tolerance) g_assert_cmpfloat_with_epsilon((a), (b), (tolerance))

#define assert_close(value, expected, relative)                                                    \
  g_assert_cmpfloat(fabs((value) - (expected)), <=, (relative)*fabs(expected))

static inline bool warned(const SbWarnings *list, const char *code) {
  for (size_t i = 0; i < list->count; i++) {
    if (g_str_equal(list->item[i].code, code)) {
      return true;
    }
  }
  return false;
}
