// The request for a calibration. See calibrate_ask.h.
#include "app/session/calibrate_ask.h"

#include <math.h>
#include <string.h>

// The parameters, with the deviation of their prior: a fraction of the value, or an amount.
static const struct {
  SbParamId id;
  double share, amount;
  bool first; // fitted by the initial request
} fittable[SB_CALIBRATE_CHOICES] = {
    {SB_P_FRICTION_LOAD_COEFFICIENT, 0.3, 0, true}, {SB_P_FRICTION_STATIC_RATIO, 0, 0.1, true},
    {SB_P_BORE_LAND_EDGE, 0, 3e-4, true},           {SB_P_STEM_PRESSURE_DIAMETER, 0, 5e-5, true},
    {SB_P_SURFACE_GT_PRODUCT, 0.2, 0, false},       {SB_P_SEAL_MODULUS, 0.2, 0, false},
    {SB_P_GLAND_RADIAL_SPACE, 0, 1e-5, false},
};

SbParamId sb_calibrate_choice(int index) {
  return fittable[index].id;
}

void sb_calibrate_ask_init(SbCalibrateAsk *ask) {
  for (int i = 0; i < SB_CALIBRATE_CHOICES; i++) {
    ask->fitted[i] = fittable[i].first;
  }
}

const SbData *sb_calibrate_data(const SbDocument *document) {
  return sb_document_data_count(document) > 0 ? sb_document_data(document, 0) : NULL;
}

static void append_priors(GString *text, const SbCalibrateAsk *ask, const SbDocument *document) {
  g_string_append(text, "[vary]\n");
  for (int i = 0; i < SB_CALIBRATE_CHOICES; i++) {
    if (!ask->fitted[i]) {
      continue;
    }
    const SbParam *param = sb_param(fittable[i].id);
    const double value = sb_document_value(document, fittable[i].id);
    const double wide = fittable[i].amount > 0 ? fittable[i].amount : fittable[i].share * value;
    g_autofree char *mean = sb_quantity_format(value, param->si, param->unit);
    g_autofree char *deviation = sb_quantity_format(wide, param->si, param->unit);
    g_autofree char *low =
        sb_quantity_format(fmax(param->min, value - 4 * wide), param->si, param->unit);
    g_autofree char *high =
        sb_quantity_format(fmin(param->max, value + 4 * wide), param->si, param->unit);
    g_string_append_printf(text, "%s = normal %s, %s within %s .. %s\n", param->key, mean,
                           deviation, low, high);
  }
}

static void append_data(GString *text, const SbData *data) {
  g_autofree char *path = g_canonicalize_filename(data->path, NULL);
  g_string_append_printf(text, "[data]\nfile = %s\n", path);
  for (int k = SB_DATA_FILE + 1; k < SB_DATA_KEY_COUNT; k++) {
    if (data->text[k] != NULL) {
      g_string_append_printf(text, "%s = %s\n", sb_data_key_name((SbDataKey)k), data->text[k]);
    }
  }
}

SbStudyFile *sb_calibrate_ask_study(const SbCalibrateAsk *ask, const SbDocument *document,
                                    GPtrArray *issues) {
  g_autofree char *flat = sb_document_to_flat_text(document);
  const char *title = sb_document_title(document);
  SbDocument *copy = sb_document_parse(flat, strlen(flat), title, NULL, issues);
  g_autoptr(GString) text = g_string_new("[sealbench]\nformat = 1\nkind = study\nscene = document\n"
                                         "[study]\nsamples = 2000\n");
  append_priors(text, ask, document);
  append_data(text, sb_calibrate_data(document));
  return copy != NULL ? sb_study_file_parse(text->str, text->len, title, NULL, NULL, copy, issues)
                      : NULL;
}

size_t sb_calibration_estimates(SbOverride *values, const SbCalibration *found) {
  size_t count = 0;
  for (size_t j = 0; j < found->parameters; j++) {
    const SbCalibrated *one = &found->parameter[j];
    const bool known = found->samples == 0 || one->identifiable != SB_IDENTIFIABLE_NO;
    if (known && one->curve < 0) {
      values[count++] = (SbOverride){one->id, one->estimate};
    }
  }
  return count;
}
