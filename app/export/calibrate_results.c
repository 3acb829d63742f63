// JSON of calibrations; see the header.
#include "app/export/calibrate_results.h"

#include "app/export/json.h"
#include "app/export/measured_results.h"

#include <math.h>

static void put_parameter(SbJson *json, const SbCalibration *of, size_t j) {
  const SbCalibrated *one = &of->parameter[j];
  sb_json_object(json, one->name);
  sb_json_number(json, "before", one->before);
  sb_json_number(json, "estimate", one->estimate);
  sb_json_number(json, "standard_deviation", one->deviation);
  sb_json_numbers(json, "interval_95", one->interval, 2);
  sb_json_numbers(json, "prior_95", one->prior, 2);
  sb_json_string(json, "identifiable", sb_told_name(one->told));
  sb_json_array(json, "with");
  for (size_t k = 0; k < of->parameters; k++) {
    if (k != j && fabs(of->correlation[j * of->parameters + k]) > SB_TOLD_CORRELATION) {
      sb_json_string(json, NULL, of->parameter[k].name);
    }
  }
  sb_json_array_end(json);
  sb_json_object_end(json);
}

static void put_curve(SbJson *json, const SbCalibratedCurve *curve) {
  sb_json_object(json, NULL);
  sb_json_string(json, "name", curve->name);
  sb_json_number(json, "rms_before_N", curve->before_rms);
  sb_json_number(json, "residual_deviation_N", curve->noise);
  sb_json_number(json, "residual_correlation_factor", curve->spread);
  sb_json_number(json, "force_zero_N", curve->offset);
  if (curve->after != NULL) {
    sb_json_comparison(json, "measured", curve->after);
  }
  sb_json_object_end(json);
}

char *sb_calibration_json(const SbCalibration *of, const SbStudyFile *study) {
  SbJson json;
  sb_json_init(&json);
  sb_json_object(&json, NULL);
  sb_json_string(&json, "study", study->title);
  sb_json_bool(&json, "converged", of->converged);
  sb_json_count(&json, "samples", of->samples);
  sb_json_number(&json, "residual_rms_N", of->rms);
  sb_json_number(&json, "chi2_reduced", of->chi2);
  sb_json_object(&json, "parameters");
  for (size_t j = 0; j < of->parameters; j++) {
    put_parameter(&json, of, j);
  }
  sb_json_object_end(&json);
  sb_json_object(&json, "correlation");
  sb_json_array(&json, "keys");
  for (size_t j = 0; j < of->parameters; j++) {
    sb_json_string(&json, NULL, of->parameter[j].name);
  }
  sb_json_array_end(&json);
  sb_json_array(&json, "matrix");
  for (size_t j = 0; j < of->parameters; j++) {
    sb_json_numbers(&json, NULL, of->correlation + j * of->parameters, of->parameters);
  }
  sb_json_array_end(&json);
  sb_json_object_end(&json);
  if (of->curves > 0 && of->curve[0].after != NULL) {
    sb_json_measured_stages(&json, of->curve[0].after);
  }
  sb_json_string(&json, "cannot_tell", of->sentence);
  sb_json_array(&json, "curves");
  for (size_t c = 0; c < of->curves; c++) {
    put_curve(&json, &of->curve[c]);
  }
  sb_json_array_end(&json);
  sb_json_object(&json, "posterior");
  sb_json_string(&json, "model", of->tangent ? "tangent" : "runs");
  sb_json_number(&json, "accepted", of->accepted);
  sb_json_number(&json, "tangent_rms_N", of->check_rms);
  sb_json_count(&json, "evaluations", of->evaluations);
  sb_json_count(&json, "seed", study->seed);
  sb_json_object_end(&json);
  sb_json_object_end(&json);
  return sb_json_finish(&json);
}

char *sb_calibration_csv(const SbCalibration *of) {
  GString *out = g_string_new("sample");
  for (size_t j = 0; j < of->parameters; j++) {
    const char *si = sb_param(of->parameter[j].id)->si;
    g_string_append_printf(out, ",%s [%s]", of->parameter[j].name, si);
  }
  g_string_append_c(out, '\n');
  for (size_t i = 0; i < of->samples; i++) {
    g_string_append_printf(out, "%zu", i);
    for (size_t j = 0; j < of->parameters; j++) {
      char digits[SB_NUMBER_SIZE];
      g_string_append_printf(out, ",%s",
                             sb_number_format(digits, of->sample[i * of->parameters + j]));
    }
    g_string_append_c(out, '\n');
  }
  return g_string_free(out, FALSE);
}
