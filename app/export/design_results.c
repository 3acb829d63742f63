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

int sb_design_lacking(const SbDesign *design) {
  size_t i = 0;
  while (i < design->figures && design->reason[i] == NULL) {
    i++;
  }
  return i < design->figures ? (int)i : -1;
}

char *sb_design_lacking_text(const SbStudyFile *study, const SbDesign *design) {
  const int at = sb_design_lacking(design);
  return at < 0 ? g_strdup("the figures could not be computed at any start")
                : g_strdup_printf("no start has a value of each figure; the first one has none of "
                                  "%s: %s",
                                  sb_figure(g_array_index(study->figures, int, at))->path,
                                  design->reason[at]);
}

static void put_parameters(SbJson *json, const SbStudyFile *study, const SbDesign *design) {
  sb_json_object(json, "parameters");
  for (guint k = 0; k < study->vary->len; k++) {
    const SbParam *param = sb_param(g_array_index(study->vary, SbVary, k).id);
    if (param->kind == SB_PARAM_CHOICE && design->found) {
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

// The reasons of all nulls, by their paths in the document.
static void put_design_reasons(SbJson *json, const SbStudyFile *study, const SbDesign *design) {
  const int lacking = sb_design_lacking(design);
  sb_json_object(json, "reasons");
  for (guint i = 0; i < study->figures->len; i++) {
    if (design->reason[i] != NULL) {
      const char *path = sb_figure(g_array_index(study->figures, int, i))->path;
      g_autofree char *key = g_strconcat("figures.", path, NULL);
      sb_json_string(json, key, design->reason[i]);
    }
  }
  if (!design->feasible) {
    static const char none[] = "no feasible design was found";
    sb_json_string(json, "optimality", none);
    if (design->found && sb_design_least_missed(design, study) < 0) {
      sb_json_string(json, "least_violated",
                     "the limits are met, but not with the required probability");
    }
    if (isfinite(study->design.robust) && !design->checked) {
      sb_json_string(json, "robust", none);
    }
  }
  if (!design->found && lacking >= 0) {
    g_autofree char *text = sb_design_lacking_text(study, design);
    static const char *const members[] = {"objective", "parameters", "figures", "margins",
                                          "least_violated"};
    for (size_t i = 0; i < G_N_ELEMENTS(members); i++) {
      sb_json_string(json, members[i], text);
    }
  }
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
  put_design_reasons(&json, study, design);
  sb_json_count(&json, "starts", design->starts);
  sb_json_count(&json, "starts_feasible", design->starts_feasible);
  if (design->checked || isfinite(study->design.robust)) {
    put_robust(&json, study, design);
  }
  sb_json_object_end(&json);
  return sb_json_finish(&json);
}
