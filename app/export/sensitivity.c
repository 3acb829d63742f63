// See the header.
#include "app/export/sensitivity.h"

#include "app/export/json.h"

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

char *sb_sensitivity_json(const SbGradient *gradient, const char *scene) {
  SbJson json;
  sb_json_document(&json);
  sb_json_string(&json, "scene", scene);
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
