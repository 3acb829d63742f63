// See the header.
#include "app/export/sensitivity.h"

#include "app/export/json.h"

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

// One object a figure, with a member a parameter: its derivative, or why there is none.
static void write_cells(SbJson *json, const SbGradient *gradient, bool reasons) {
  sb_json_object(json, reasons ? "reasons" : "gradients");
  for (size_t f = 0; f < sb_gradient_figures(gradient); f++) {
    bool begun = !reasons;
    if (begun) {
      sb_json_object(json, sb_figure(sb_gradient_figure(gradient, f))->path);
    }
    for (size_t p = 0; p < sb_gradient_parameters(gradient); p++) {
      const char *key = sb_param(sb_gradient_parameter(gradient, p))->key;
      const char *reason = sb_gradient_reason(gradient, f, p);
      if (!reasons) {
        sb_json_number(json, key, sb_gradient_slope(gradient, f, p));
      } else if (reason != NULL) {
        if (!begun) {
          sb_json_object(json, sb_figure(sb_gradient_figure(gradient, f))->path);
          begun = true;
        }
        sb_json_string(json, key, reason);
      }
    }
    if (begun) {
      sb_json_object_end(json);
    }
  }
  sb_json_object_end(json);
}

char *sb_sensitivity_json(const SbGradient *gradient) {
  SbJson json;
  sb_json_init(&json);
  sb_json_object(&json, NULL);
  sb_json_object(&json, "figures");
  for (size_t f = 0; f < sb_gradient_figures(gradient); f++) {
    sb_json_number(&json, sb_figure(sb_gradient_figure(gradient, f))->path,
                   sb_gradient_value(gradient, f));
  }
  sb_json_object_end(&json);
  write_cells(&json, gradient, false);
  write_cells(&json, gradient, true);
  sb_json_object_end(&json);
  return sb_json_finish(&json);
}
