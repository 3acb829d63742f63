// See check.h.
#include "engine/base/check.h"

SbStatus sb_check_bounds(const SbBound *bound, size_t count, SbReport *report) {
  for (const SbBound *b = bound; b < bound + count; b++) {
    if (b->value >= b->low && b->value <= b->high) {
      continue;
    }
    char range[64];
    if (b->low == -DBL_MAX) {
      sb_text(range, sizeof range, "be finite");
    } else if (b->high >= DBL_MAX) {
      sb_text(range, sizeof range, b->low == DBL_MIN ? "be above 0" : "not be below %g", b->low);
    } else {
      sb_text(range, sizeof range, "be between %g and %g", b->low == DBL_MIN ? 0.0 : b->low,
              b->high);
    }
    return sb_fail_input(report, SB_ERROR_RANGE, b->input, "%s must %s, not %g", b->what, range,
                         b->value);
  }
  return SB_OK;
}
