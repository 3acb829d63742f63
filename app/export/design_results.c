// Designs as JSON; see the header.
#include "app/export/design_results.h"

#include "app/export/study_results.h"
#include "app/table/json.h"

#include <math.h>

int sb_design_least_missed(const SbDesign *design, const SbStudyFile *study) {
  int least = -1;
  double part = INFINITY;
  for (size_t i = 0; i < study->limits.count; i++) {
    const SbLimit *limit = &study->limits.item[i];
    const double margin = sb_design_margin(design, study, i);
    const double figure = design->figure[sb_study_column_of(study, limit->figure)];
    const double bound = figure < limit->low ? limit->low : limit->high;
    const double scale = fmax(fabs(bound), fabs(figure));
    if (margin < 0 && -margin / scale < part) {
      part = -margin / scale;
      least = (int)i;
    }
  }
  return least;
}

static void put_parameters(SbJson *json, const SbStudyFile *study, const SbDesign *design) {
  sb_json_object(json, "parameters");
  for (guint k = 0; k < study->vary->len; k++) {
    const SbParam *param = sb_param(g_array_index(study->vary, SbVary, k).id);
    if (param->kind == SB_PARAM_CHOICE) {
      char name[64];
      sb_param_choice_name(param, (int)design->value[k], name, sizeof name);
      sb_json_string(json, param->key, name);
    } else {
      sb_json_number(json, param->key, design->found ? design->value[k] : NAN);
    }
  }
  sb_json_object_end(json);
}

static void put_active(SbJson *json, const SbStudyFile *study, const SbDesign *design) {
  sb_json_array(json, "active");
  for (size_t i = 0; i < study->limits.count; i++) {
    if (design->limit_active[2 * i] || design->limit_active[2 * i + 1]) {
      sb_json_string(json, NULL, sb_figure(study->limits.item[i].figure)->path);
    }
  }
  for (guint k = 0; k < study->vary->len; k++) {
    if (design->bound_active[k] != 0) {
      sb_json_string(json, NULL, sb_param(g_array_index(study->vary, SbVary, k).id)->key);
    }
  }
  sb_json_array_end(json);
}

static void put_bounds(SbJson *json, const SbStudyFile *study, const SbDesign *design) {
  sb_json_array(json, "bounds_active");
  for (guint k = 0; k < study->vary->len; k++) {
    if (design->bound_active[k] != 0) {
      sb_json_string(json, NULL, sb_param(g_array_index(study->vary, SbVary, k).id)->key);
    }
  }
  sb_json_array_end(json);
}

static void put_robust(SbJson *json, const SbStudyFile *study, const SbDesign *design) {
  sb_json_object(json, "robust");
  sb_json_number(json, "target", study->design.robust);
  sb_json_number(json, "probability", design->holds);
  sb_json_numbers(json, "interval_95", design->interval, 2);
  sb_json_string(json, "interval_covers", SB_INTERVAL_COVERS);
  sb_json_number(json, "probability_by_form", design->by_form);
  sb_json_count(json, "samples", design->samples);
  sb_json_bool(json, "met", design->met);
  sb_json_object_end(json);
}

char *sb_design_json(const SbStudyFile *study, const SbDesign *design) {
  SbJson json;
  sb_json_document(&json);
  sb_json_study_files(&json, study);
  sb_json_string(&json, "version", sb_version());
  sb_json_bool(&json, "converged", design->converged);
  sb_json_bool(&json, "feasible", design->feasible);
  const int column = sb_study_column_of(study, study->design.figure);
  sb_json_number(&json, "objective", design->found ? design->figure[column] : NAN);
  sb_json_string(&json, "objective_figure", sb_figure(study->design.figure)->path);
  sb_json_string(&json, "sense", study->design.maximise ? "maximise" : "minimise");
  put_parameters(&json, study, design);
  sb_json_object(&json, "figures");
  for (guint i = 0; i < study->figures->len; i++) {
    sb_json_number(&json, sb_figure(g_array_index(study->figures, int, i))->path,
                   design->found ? design->figure[i] : NAN);
  }
  sb_json_object_end(&json);
  put_active(&json, study, design);
  put_bounds(&json, study, design);
  static const SbWarnings none = {0};
  sb_json_warnings(&json, design->warnings != NULL ? design->warnings : &none);
  sb_json_object(&json, "margins");
  for (size_t i = 0; i < study->limits.count; i++) {
    sb_json_number(&json, sb_figure(study->limits.item[i].figure)->path,
                   design->found ? sb_design_margin(design, study, i) : NAN);
  }
  sb_json_object_end(&json);
  const int least = design->found ? sb_design_least_missed(design, study) : -1;
  if (!design->feasible) {
    sb_json_string(&json, "least_violated",
                   least >= 0 ? sb_figure(study->limits.item[least].figure)->path : NULL);
  }
  sb_json_count(&json, "evaluations", design->evaluations);
  sb_json_number(&json, "optimality", design->optimality);
  sb_json_count(&json, "starts", design->starts);
  sb_json_count(&json, "starts_feasible", design->starts_feasible);
  if (design->checked || isfinite(study->design.robust)) {
    put_robust(&json, study, design);
  }
  sb_json_object_end(&json);
  return sb_json_finish(&json);
}
