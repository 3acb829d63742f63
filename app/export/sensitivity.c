// See the header.
#include "app/export/sensitivity.h"

#include "app/table/json.h"

typedef enum { GRADIENTS, ERRORS, REASONS } Block;

static void write_cell(SbJson *json, const SbGradient *gradient, Block block, size_t f, size_t p) {
  const char *key = sb_param(sb_gradient_parameter(gradient, p))->key;
  if (block == REASONS) {
    sb_json_string(json, key, sb_gradient_reason(gradient, f, p));
  } else {
    sb_json_number(json, key,
                   block == ERRORS ? sb_gradient_error(gradient, f, p)
                                   : sb_gradient_slope(gradient, f, p));
  }
}

// Writes one object for each figure with one member for each parameter: the derivative, its
// absolute error, or the reason where there is no derivative. Figures without reasons are left out
// of the reasons.
static void write_cells(SbJson *json, const SbGradient *gradient, Block block) {
  static const char *const names[] = {"gradients", "errors", "reasons"};
  sb_json_object(json, names[block]);
  for (size_t f = 0; f < sb_gradient_figures(gradient); f++) {
    const char *path = sb_figure(sb_gradient_figure(gradient, f))->path;
    bool begun = block != REASONS;
    if (begun) {
      sb_json_object(json, path);
    }
    for (size_t p = 0; p < sb_gradient_parameters(gradient); p++) {
      if (block == REASONS && sb_gradient_reason(gradient, f, p) == NULL) {
        continue;
      }
      if (!begun) {
        sb_json_object(json, path);
        begun = true;
      }
      write_cell(json, gradient, block, f, p);
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
  write_cells(&json, gradient, GRADIENTS);
  write_cells(&json, gradient, ERRORS);
  write_cells(&json, gradient, REASONS);
  sb_json_object_end(&json);
  return sb_json_finish(&json);
}
