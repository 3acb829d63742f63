// Tables of a study; see the header.
#include "app/export/study_results.h"

#include "app/base/figure_text.h"
#include "app/base/unit.h"
#include "engine/numeric/statistics.h"
#include "engine/valve/shelf/shelf.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

char *sb_study_statistic(int figure, double value) {
  return sb_figure(figure)->digits == 0 && isfinite(value) ? sb_quantity_round(value, "1", "", 4)
                                                           : sb_figure_format(figure, value, NAN);
}

size_t sb_study_done(const SbAnswers *answers) {
  size_t done = 0;
  for (size_t i = 0; i < answers->samples; i++) {
    done += answers->status[i] != SB_ANSWER_MISSING;
  }
  return done;
}

size_t sb_study_failed(const SbAnswers *answers) {
  size_t failed = 0;
  for (size_t i = 0; i < answers->samples; i++) {
    failed += answers->status[i] != SB_ANSWER_MISSING && answers->status[i] != SB_OK;
  }
  return failed;
}

const char *sb_study_status_name(uint8_t status) {
  switch (status) {
  case SB_OK:
    return "ok";
  case SB_ERROR_NOT_CONVERGED:
    return "not-converged";
  case SB_ERROR_INFEASIBLE:
    return "infeasible";
  case SB_ANSWER_MISSING:
    return "not-computed";
  default:
    return "refused";
  }
}

// Losses of the samples that are valves, an open one's without bound; how many.
static size_t gather_losses(double *loss, const SbStudyFile *study, const SbAnswers *answers) {
  const int wanted = sb_figure_find("shelf.loss_kg_per_year");
  size_t column = 0, count = 0;
  bool any = false;
  while (g_array_index(study->figures, int, column) != wanted) {
    column++;
  }
  for (size_t i = 0; i < answers->samples; i++) {
    const double value = answers->value[i * answers->figures + column];
    if (answers->status[i] == SB_OK) {
      any = any || isfinite(value);
      loss[count++] = isnan(value) ? INFINITY : value;
    }
  }
  return any ? count : 0;
}

SbStatus sb_study_leakage(SbLeakageOdds *out, const SbStudyFile *study, const SbAnswers *answers,
                          SbReport *report) {
  const double fill = sb_model_value(study->base, SB_P_CANISTER_FILL) *
                      sb_model_value(study->base, SB_P_FLUID_DENSITY);
  *out = (SbLeakageOdds){.probability = NAN, .interval = {NAN, NAN}};
  double *loss = malloc((answers->samples + 1) * sizeof *loss);
  if (loss == NULL) {
    return sb_fail(report, SB_ERROR_MEMORY, "no memory for the cans of a leakage test");
  }
  const size_t count = gather_losses(loss, study, answers);
  const SbStatus status = count > 0 ? sb_leakage_odds(out, &study->leakage, loss, count, fill,
                                                      study->leakage_tests, study->seed, report)
                                    : sb_succeed(report);
  free(loss);
  return status;
}

// ---- CSV ----

SbTableCell sb_study_cell(char name[64], const SbParam *param, double value) {
  if (param == NULL || param->kind != SB_PARAM_CHOICE || isnan(value)) {
    return sb_cell_number(value);
  }
  sb_param_choice_name(param, (int)value, name, 64);
  return sb_cell_text(name);
}

void sb_study_csv(FILE *stream, const SbStudyFile *study, const double *value,
                  const SbAnswers *answers) {
  const size_t n = study->vary->len;
  fputs("sample", stream);
  for (size_t k = 0; k < n; k++) {
    const SbVary *vary = &g_array_index(study->vary, SbVary, k);
    g_autofree char *name = g_strdup_printf("%s [%s]", sb_vary_name(vary), sb_vary_si(vary));
    sb_csv_put(stream, sb_cell_text(name));
  }
  for (guint k = 0; k < study->figures->len; k++) {
    fprintf(stream, ",%s", sb_figure(g_array_index(study->figures, int, k))->path);
  }
  fputs(",status,warnings\n", stream);
  for (size_t i = 0; i < answers->samples && ferror(stream) == 0; i++) {
    fprintf(stream, "%zu", i + 1);
    for (size_t k = 0; k < n; k++) {
      char name[64];
      const SbParamId id = g_array_index(study->vary, SbVary, k).id;
      const SbParam *param = id != SB_VARY_VARIABLE ? sb_param(id) : NULL;
      sb_csv_put(stream, sb_study_cell(name, param, value[i * n + k]));
    }
    for (size_t k = 0; k < answers->figures; k++) {
      sb_csv_put(stream, sb_cell_number(answers->value[i * answers->figures + k]));
    }
    const char *codes = g_hash_table_lookup(answers->warnings, GSIZE_TO_POINTER(i));
    fprintf(stream, ",%s,%s\n", sb_study_status_name(answers->status[i]),
            codes != NULL ? codes : "");
  }
}

// ---- JSON ----

static void put_interval(SbJson *json, const char *key, double low, double high) {
  const double ends[] = {low, high};
  sb_json_numbers(json, key, ends, 2);
}

static SbStatus put_study_figures(SbJson *json, const SbStudyFile *study, const SbAnswers *answers,
                                  SbReport *report) {
  static const char *const shares[SB_QUANTILES] = {"0.001", "0.05", "0.5", "0.95", "0.999"};
  SbStatus status = SB_OK;
  sb_json_object(json, "figures");
  for (size_t k = 0; status == SB_OK && k < answers->figures; k++) {
    SbSummaryOfSamples of;
    status =
        sb_samples_summary(&of, answers->value + k, answers->samples, answers->figures, report);
    sb_json_object(json, sb_figure(g_array_index(study->figures, int, k))->path);
    sb_json_count(json, "samples", of.count);
    sb_json_bool(json, "varies", of.varies);
    sb_json_number(json, "mean", of.mean);
    sb_json_number(json, "standard_deviation", of.deviation);
    sb_json_number(json, "min", of.min);
    sb_json_number(json, "max", of.max);
    sb_json_object(json, "quantiles");
    for (int q = 0; q < SB_QUANTILES; q++) {
      sb_json_number(json, shares[q], of.quantile[q]);
    }
    sb_json_object_end(json);
    sb_json_object_end(json);
  }
  sb_json_object_end(json);
  return status;
}

static const char *vary_key(const SbStudyFile *study, size_t k) {
  return sb_vary_name(&g_array_index(study->vary, SbVary, k));
}

// Where a side of a limit is most probably reached.
static void put_mode(SbJson *json, const SbStudyFile *study, const SbFailureMode *mode) {
  const bool found = mode->found.end == SB_SEARCH_FOUND;
  sb_json_object(json, NULL);
  sb_json_string(json, "relation", mode->upper ? "<=" : ">=");
  sb_json_bool(json, "found", found);
  sb_json_string(json, "reason", found ? NULL : sb_failure_text(&mode->found));
  sb_json_number(json, "beta", mode->found.beta);
  sb_json_number(json, "probability", sb_normal_share(-mode->found.beta));
  sb_json_count(json, "evaluations", mode->found.evaluations);
  sb_json_object(json, "parameters");
  for (size_t k = 0; k < study->vary->len; k++) {
    if (sb_param(g_array_index(study->vary, SbVary, k).id)->kind == SB_PARAM_REAL) {
      sb_json_number(json, vary_key(study, k), found ? mode->value[k] : NAN);
    }
  }
  sb_json_object_end(json);
  // Shares of the squared distance, where the variates are those of the parameters.
  if (study->root == NULL) {
    sb_json_object(json, "importance");
    for (size_t k = 0; k < study->vary->len; k++) {
      const double part = mode->u[k] / mode->found.beta;
      sb_json_number(json, vary_key(study, k), part * part);
    }
    sb_json_object_end(json);
  } else {
    sb_json_string(json, "importance", NULL);
    sb_json_string(
        json, "importance_reason",
        "the parameters are correlated: the squared distance is not a sum of their contributions");
  }
  sb_json_object_end(json);
}

// Members of a limit, or of all together.
static SbStatus put_share(SbJson *json, const SbStudyFile *study, const SbStudyDrawn *drawn,
                          const SbAnswers *answers, size_t limit, SbReport *report) {
  // Points of a grid or of a screening are no draws; those of a sequence no independent ones.
  const bool independent =
      study->method == SB_METHOD_MONTE_CARLO || study->method == SB_METHOD_RELIABILITY;
  SbLimitShare share;
  const SbStatus status = sb_study_limit_share(&share, study, drawn, answers, limit, report);
  sb_json_count(json, "samples", share.of);
  sb_json_count(json, "beyond", share.beyond);
  sb_json_number(json, "probability_of_failure",
                 independent || study->method == SB_METHOD_SOBOL_SEQUENCE ? share.probability
                                                                          : NAN);
  put_interval(json, "interval_95", independent ? share.interval[0] : NAN,
               independent ? share.interval[1] : NAN);
  sb_json_string(json, "interval_covers", independent ? SB_INTERVAL_COVERS : NULL);
  sb_json_number(json, "beta", independent ? share.beta : NAN);
  if (independent && share.reason[0] != '\0') {
    sb_json_string(json, "reason", share.reason);
  }
  return status;
}

static SbStatus put_limits(SbJson *json, const SbStudyFile *study, const SbStudyDrawn *drawn,
                           const SbAnswers *answers, SbReport *report) {
  SbStatus status = SB_OK;
  sb_json_array(json, "limits");
  for (size_t limit = 0; status == SB_OK && limit < study->limits.count; limit++) {
    const SbLimit *of = &study->limits.item[limit];
    const bool low = isfinite(of->low), high = isfinite(of->high);
    sb_json_object(json, NULL);
    sb_json_string(json, "figure", sb_figure(of->figure)->path);
    sb_json_string(json, "relation", low && high ? ".." : low ? ">=" : "<=");
    if (low && high) {
      put_interval(json, "limit", of->low, of->high);
    } else {
      sb_json_number(json, "limit", low ? of->low : of->high);
    }
    status = put_share(json, study, drawn, answers, limit, report);
    if (drawn->reliability != NULL) {
      sb_json_array(json, "failure_points");
      for (size_t i = 0; i < drawn->reliability->count; i++) {
        if (drawn->reliability->mode[i].limit == limit) {
          put_mode(json, study, &drawn->reliability->mode[i]);
        }
      }
      sb_json_array_end(json);
    }
    sb_json_object_end(json);
  }
  sb_json_array_end(json);
  if (status == SB_OK) {
    sb_json_object(json, "any_limit");
    status = put_share(json, study, drawn, answers, study->limits.count, report);
    sb_json_object_end(json);
  }
  return status;
}

static SbStatus put_sobol(SbJson *json, const SbStudyFile *study, const double *column,
                          SbReport *report) {
  const size_t n = study->vary->len;
  SbIndex first[SB_VARY_MAX], total[SB_VARY_MAX];
  SbStatus status =
      sb_sobol_indices(first, total, column, study->samples / (n + 2), n, study->seed, report);
  for (size_t k = 0; status == SB_OK && k < n; k++) {
    sb_json_object(json, vary_key(study, k));
    sb_json_number(json, "first", first[k].value);
    sb_json_number(json, "total", total[k].value);
    put_interval(json, "interval_95", first[k].low, first[k].high);
    put_interval(json, "total_interval_95", total[k].low, total[k].high);
    sb_json_object_end(json);
  }
  return status;
}

static void put_morris(SbJson *json, const SbStudyFile *study, const double *column,
                       const double *unit) {
  const size_t n = study->vary->len;
  SbElementaryEffects effect[SB_VARY_MAX];
  sb_morris_effects(effect, column, unit, study->samples, n);
  for (size_t k = 0; k < n; k++) {
    sb_json_object(json, vary_key(study, k));
    sb_json_number(json, "mean", effect[k].mean);
    sb_json_number(json, "mean_magnitude", effect[k].magnitude);
    sb_json_number(json, "standard_deviation", effect[k].deviation);
    sb_json_count(json, "effects", effect[k].count);
    sb_json_object_end(json);
  }
}

static SbStatus put_indices(SbJson *json, const SbStudyFile *study, const double *unit,
                            const SbAnswers *answers, SbReport *report) {
  if (study->method != SB_METHOD_SOBOL_INDICES && study->method != SB_METHOD_MORRIS) {
    return SB_OK;
  }
  double *column = malloc((answers->samples + 1) * sizeof *column);
  SbStatus status = column != NULL ? SB_OK : sb_fail(report, SB_ERROR_MEMORY, "no memory");
  sb_json_object(json, "indices");
  for (size_t k = 0; status == SB_OK && k < answers->figures; k++) {
    for (size_t i = 0; i < answers->samples; i++) {
      column[i] = answers->value[i * answers->figures + k];
    }
    sb_json_object(json, sb_figure(g_array_index(study->figures, int, k))->path);
    if (study->method == SB_METHOD_MORRIS) {
      put_morris(json, study, column, unit);
    } else {
      status = put_sobol(json, study, column, report);
    }
    sb_json_object_end(json);
  }
  sb_json_object_end(json);
  free(column);
  return status;
}

static SbStatus put_leakage(SbJson *json, const SbStudyFile *study, const SbAnswers *answers,
                            SbReport *report) {
  const SbLeakageTest *test = &study->leakage;
  SbLeakageOdds odds;
  const SbStatus status = sb_study_leakage(&odds, study, answers, report);
  sb_json_object(json, "leakage_test");
  sb_json_string(json, "edition", test->edition);
  sb_json_count(json, "tests", odds.tests);
  sb_json_count(json, "passed", odds.passed);
  sb_json_count(json, "second_stage", odds.second);
  sb_json_number(json, "probability_to_pass", odds.probability);
  put_interval(json, "interval_95", odds.interval[0], odds.interval[1]);
  sb_json_string(json, "interval_covers", SB_INTERVAL_COVERS);
  sb_json_string(json, "cans", odds.dealt ? "each another sample" : "drawn from the samples");
  if (isnan(odds.probability)) {
    sb_json_string(json, "reason", "no sample has a loss on the shelf");
  }
  sb_json_number(json, "temperature_K", test->temperature);
  sb_json_number(json, "duration_s", test->duration);
  sb_json_number(json, "balance_kg", test->balance);
  sb_json_number(json, "mean_kg_per_year", test->mean);
  sb_json_number(json, "single_kg_per_year", test->single);
  sb_json_number(json, "most_kg_per_year", test->most);
  sb_json_object_end(json);
  return status;
}

char *sb_study_typical(const SbStudyFile *study, SbShelfSpecies species) {
  char text[SB_TEXT];
  int id = -1;
  for (guint k = 0; k < study->figures->len && id < 0; k++) {
    const int figure = g_array_index(study->figures, int, k);
    if (sb_figure(figure)->group == SB_GROUP_SHELF && sb_shelf_species(figure) == species) {
      id = sb_shelf_typical(text, sizeof text, study->base, species);
    }
  }
  for (guint k = 0; k < study->vary->len && id >= 0; k++) {
    if ((int)g_array_index(study->vary, SbVary, k).id == id) {
      return NULL; // the samples have their own
    }
  }
  return id >= 0 ? g_strdup(text) : NULL;
}

// What the figures rest on that nobody measured; nothing where there is none.
static void put_typical(SbJson *json, const SbStudyFile *study) {
  g_autofree char *loss = sb_study_typical(study, SB_SHELF_PROPELLANT);
  g_autofree char *water = sb_study_typical(study, SB_SHELF_WATER);
  if (loss == NULL && water == NULL) {
    return;
  }
  sb_json_array(json, "typical");
  for (int i = 0; i < SB_SHELF_SPECIES; i++) {
    const char *text = i == SB_SHELF_PROPELLANT ? loss : water;
    if (text != NULL) {
      sb_json_string(json, NULL, text);
    }
  }
  sb_json_array_end(json);
}

// Why samples failed, the first hundred of them.
static int by_code(const void *a, const void *b) {
  return strcmp(((const SbCodeCount *)a)->code, ((const SbCodeCount *)b)->code);
}

SbCodeCount *sb_study_warnings(size_t *count, const SbAnswers *answers) {
  GArray *codes = g_array_new(FALSE, FALSE, sizeof(SbCodeCount));
  for (size_t i = 0; i < answers->samples; i++) {
    const char *of = g_hash_table_lookup(answers->warnings, GSIZE_TO_POINTER(i));
    g_auto(GStrv) parts = g_strsplit(of != NULL ? of : "", ";", -1);
    for (char **code = parts; *code != NULL; code++) {
      guint at = 0;
      while (at < codes->len && strcmp(g_array_index(codes, SbCodeCount, at).code, *code) != 0) {
        at++;
      }
      if (at == codes->len) {
        SbCodeCount fresh = {0};
        g_strlcpy(fresh.code, *code, sizeof fresh.code);
        g_array_append_val(codes, fresh);
      }
      g_array_index(codes, SbCodeCount, at).count++;
    }
  }
  g_array_sort(codes, by_code);
  *count = codes->len;
  return (SbCodeCount *)(void *)g_array_free(codes, FALSE);
}

static void put_warnings(SbJson *json, const SbAnswers *answers) {
  size_t count = 0;
  g_autofree SbCodeCount *codes = sb_study_warnings(&count, answers);
  sb_json_object(json, "warnings");
  for (size_t i = 0; i < count; i++) {
    sb_json_count(json, codes[i].code, codes[i].count);
  }
  sb_json_object_end(json);
}

static void put_failures(SbJson *json, const SbAnswers *answers) {
  enum { MOST = 100 };
  sb_json_array(json, "failures");
  int shown = 0;
  for (size_t i = 0; shown < MOST && i < answers->samples; i++) {
    const uint8_t status = answers->status[i];
    if (status == SB_OK || status == SB_ANSWER_MISSING) {
      continue;
    }
    sb_json_object(json, NULL);
    sb_json_count(json, "sample", i + 1);
    sb_json_string(json, "status", sb_study_status_name(status));
    sb_json_string(json, "reason", g_hash_table_lookup(answers->reason, GSIZE_TO_POINTER(i)));
    sb_json_object_end(json);
    shown++;
  }
  sb_json_array_end(json);
}

static void put_study_path(SbJson *json, const char *key, const char *path) {
  g_autofree char *full = path != NULL ? g_canonicalize_filename(path, NULL) : g_strdup("-");
  sb_json_string(json, key, full);
}

void sb_json_study_files(SbJson *json, const SbStudyFile *study) {
  sb_json_string(json, "study", study->title);
  put_study_path(json, "file", study->path);
  put_study_path(json, "scene", study->scene != NULL ? sb_document_path(study->scene) : NULL);
}

char *sb_study_json(const SbStudyFile *study, const SbStudyDrawn *drawn, const SbAnswers *answers,
                    const char *cpus, const char *store, SbReport *report) {
  SbJson json;
  sb_json_document(&json);
  sb_json_study_files(&json, study);
  sb_json_string(&json, "version", sb_version());
  sb_json_string(&json, "method", sb_study_method_name(study->method));
  sb_json_count(&json, "seed", study->seed);
  sb_json_count(&json, "samples", study->samples);
  sb_json_count(&json, "done", sb_study_done(answers));
  sb_json_count(&json, "failed", sb_study_failed(answers));
  sb_json_string(&json, "cpu", cpus);
  g_autofree char *full = store != NULL ? g_canonicalize_filename(store, NULL) : NULL;
  sb_json_string(&json, "store", full);
  // Of samples about failures no statistics of figures.
  SbStatus status =
      drawn->reliability == NULL ? put_study_figures(&json, study, answers, report) : SB_OK;
  if (status == SB_OK && study->limits.count > 0) {
    status = put_limits(&json, study, drawn, answers, report);
  }
  if (status == SB_OK) {
    status = put_indices(&json, study, drawn->unit, answers, report);
  }
  if (status == SB_OK && study->leakage_tests > 0) {
    status = put_leakage(&json, study, answers, report);
  }
  put_typical(&json, study);
  put_warnings(&json, answers);
  put_failures(&json, answers);
  sb_json_object_end(&json);
  char *text = sb_json_finish(&json);
  if (status != SB_OK) {
    g_free(text);
    return NULL;
  }
  return text;
}
