// See the header.
#include "app/study/effects.h"

#include <math.h>
#include <stdlib.h>

static const double USUAL = 0.05;

// Half-width of a parameter's tolerance band: the value of KEY_tolerance, 0 without one.
static double tolerance_of(const SbModel *model, SbParamId id) {
  const int band = sb_param_tolerance(id);
  return band >= 0 ? sb_model_value(model, (SbParamId)band) : 0;
}

static int by_change(const void *a, const void *b) {
  const double first = fabs(((const SbEffect *)a)->change);
  const double second = fabs(((const SbEffect *)b)->change);
  return (first < second) - (first > second);
}

size_t sb_effects(SbEffect *out, const SbGradient *gradient, size_t figure, const SbModel *model) {
  size_t count = 0;
  for (size_t i = 0; i < sb_gradient_parameters(gradient); i++) {
    const SbParamId id = sb_gradient_parameter(gradient, i);
    const double slope = sb_gradient_slope(gradient, figure, i);
    const double band = tolerance_of(model, id);
    const double step = band > 0 ? band : USUAL * fabs(sb_gradient_at(gradient, i));
    if (step > 0 && isfinite(slope) && slope != 0) {
      out[count++] = (SbEffect){.parameter = i,
                                .step = step,
                                .tolerance = band > 0,
                                .change = slope * step,
                                .error = sb_gradient_error(gradient, figure, i) * step};
    }
  }
  qsort(out, count, sizeof *out, by_change);
  return count;
}
