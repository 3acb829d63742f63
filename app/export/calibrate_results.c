// JSON of calibrations; see the header.
#include "app/export/calibrate_results.h"

#include "app/base/format.h"
#include "app/export/measured_results.h"
#include "app/export/still.h"
#include "app/export/study_results.h"
#include "app/study/answers.h"
#include "app/table/table.h"

#include "engine/base/version.h"

#include <math.h>

static void put_parameter(SbJson *json, const SbCalibration *of, size_t j) {
  const SbCalibrated *one = &of->parameter[j];
  sb_json_object(json, one->name);
  sb_json_number(json, "before", one->before);
  sb_json_number(json, "estimate", one->estimate);
  sb_json_number(json, "standard_deviation", one->deviation);
  sb_json_numbers(json, "interval_95", one->interval, 2);
  sb_json_numbers(json, "prior_95", one->prior, 2);
  sb_json_string(json, "identifiable",
                 of->samples > 0 ? sb_identifiable_name(one->identifiable) : NULL);
  sb_json_array(json, "with");
  for (size_t k = 0; k < of->parameters; k++) {
    if (k != j && fabs(of->correlation[j * of->parameters + k]) > SB_IDENTIFIABLE_CORRELATION) {
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

// Parameters that the fit moved to an end of their bounds: within a thousandth of their range.
static void put_calibration_bounds(SbJson *json, const SbCalibration *of) {
  const double near = 1e-3;
  sb_json_array(json, "bounds_active");
  for (size_t j = 0; j < of->parameters; j++) {
    const SbCalibrated *parameter = &of->parameter[j];
    const SbDistribution *bounds = &parameter->distribution;
    const bool bounded =
        bounds->kind == SB_DISTRIBUTION_UNIFORM || bounds->kind == SB_DISTRIBUTION_LOGUNIFORM;
    const double low = sb_distribution_quantile(bounds, near);
    const double high = sb_distribution_quantile(bounds, 1 - near);
    if (bounded && (parameter->estimate < low || parameter->estimate > high)) {
      sb_json_string(json, NULL, parameter->name);
    }
  }
  sb_json_array_end(json);
}

static void put_reason(SbJson *json, const char *path, double value, const char *why) {
  if (!isfinite(value)) {
    sb_json_string(json, path, why);
  }
}

// Why numbers are null, by their paths.
static void put_reasons(SbJson *json, const SbCalibration *of) {
  const char *posterior =
      of->partial ? "interrupted: the posterior was not sampled" : "the posterior was not sampled";
  sb_json_object(json, "reasons");
  put_reason(json, "residual_rms_N", of->rms, "no loop was computed at the estimates");
  put_reason(json, "chi2_reduced", of->chi2,
             of->partial ? "interrupted: not computed for the best values so far"
                         : "there are no degrees of freedom");
  for (size_t j = 0; j < of->parameters; j++) {
    const SbCalibrated *one = &of->parameter[j];
    static const char *const names[] = {"standard_deviation", "interval_95", "identifiable"};
    const double values[] = {one->deviation, one->interval[0], of->samples > 0 ? 0 : NAN};
    for (size_t i = 0; i < G_N_ELEMENTS(names); i++) {
      g_autofree char *path = g_strdup_printf("parameters.%s.%s", one->name, names[i]);
      put_reason(json, path, values[i], posterior);
    }
  }
  put_reason(json, "correlation.matrix", of->samples > 0 ? 0 : NAN, posterior);
  put_reason(json, "posterior.accepted", of->accepted, posterior);
  put_reason(json, "posterior.tangent_rms_N", of->check_rms,
             of->partial ? "interrupted: not compared with full runs"
                         : "the posterior is not that of a tangent");
  sb_json_object_end(json);
}

char *sb_calibration_json(const SbCalibration *of, const SbStudyFile *study) {
  SbJson json;
  sb_json_document(&json);
  sb_json_study_files(&json, study);
  sb_json_bool(&json, "converged", of->converged);
  sb_json_bool(&json, "partial", of->partial);
  sb_json_count(&json, "samples", of->samples);
  sb_json_number(&json, "residual_rms_N", of->rms);
  sb_json_number(&json, "chi2_reduced", of->chi2);
  sb_json_object(&json, "parameters");
  for (size_t j = 0; j < of->parameters; j++) {
    put_parameter(&json, of, j);
  }
  sb_json_object_end(&json);
  put_calibration_bounds(&json, of);
  static const SbWarnings none = {0};
  sb_json_warnings(&json, of->warnings != NULL ? of->warnings : &none);
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
  put_reasons(&json, of);
  sb_json_object_end(&json);
  return sb_json_finish(&json);
}

void sb_calibration_csv(FILE *stream, const SbCalibration *of) {
  fputs("sample", stream);
  for (size_t j = 0; j < of->parameters; j++) {
    const char *si = sb_param(of->parameter[j].id)->si;
    g_autofree char *name = g_strdup_printf("%s [%s]", of->parameter[j].name, si);
    sb_csv_put(stream, sb_cell_text(name));
  }
  for (size_t i = 0; i < of->samples; i++) {
    fprintf(stream, "\n%zu", i);
    for (size_t j = 0; j < of->parameters; j++) {
      sb_csv_put(stream, sb_cell_number(of->sample[i * of->parameters + j]));
    }
  }
  fputc('\n', stream);
}

// ---- The page ----

// A value in the unit that people read, to what its deviation supports.
static char *value_text(const SbCalibrated *of, double value, bool unit) {
  const SbParam *param = sb_param(of->id);
  if (!isfinite(value)) {
    return g_strdup("-");
  }
  const double shown = sb_quantity_to_shown(value, param->si, param->unit);
  const double width = sb_quantity_to_shown(of->interval[1], param->si, param->unit) -
                       sb_quantity_to_shown(of->interval[0], param->si, param->unit);
  const int digits =
      width > 0 && shown != 0 ? (int)fmin(fmax(1 + ceil(log10(fabs(shown) / width)), 4), 7) : 5;
  char text[SB_NUMBER_SIZE];
  sb_number_round(text, shown, digits);
  return g_strconcat(text, unit && *param->unit != '\0' ? " " : "", unit ? param->unit : "", NULL);
}

static char *identifiable_text(const SbCalibration *of, size_t j) {
  const SbCalibrated *one = &of->parameter[j];
  if (of->samples == 0) {
    return g_strdup("-");
  }
  if (one->identifiable != SB_IDENTIFIABLE_WITH_OTHER) {
    return g_strdup(one->identifiable == SB_IDENTIFIABLE_YES ? "yes" : "no, as before");
  }
  size_t most = j == 0 ? 1 : 0;
  for (size_t k = 0; k < of->parameters; k++) {
    const double *rho = of->correlation + j * of->parameters;
    most = k != j && fabs(rho[k]) > fabs(rho[most]) ? k : most;
  }
  const char *symbol = sb_param(of->parameter[most].id)->symbol;
  return g_strdup_printf("only with %s", *symbol != '\0' ? symbol : of->parameter[most].name);
}

enum { BEFORE = 1, ESTIMATE, INTERVAL, IDENTIFIABLE };

SbTable *sb_calibration_table(const SbCalibration *of) {
  static const SbTableColumn columns[] = {{.layout = "  %-36s"},
                                          {.layout = "%18s", .head = "before"},
                                          {.layout = "%11s", .head = "estimate"},
                                          {.layout = "  %-24s", .head = "95 % interval"},
                                          {.layout = "%s", .head = "identifiable"}};
  SbTable *table = sb_table_new(columns, G_N_ELEMENTS(columns));
  for (size_t j = 0; j < of->parameters; j++) {
    const SbCalibrated *one = &of->parameter[j];
    g_autofree char *low = value_text(one, one->interval[0], false);
    g_autofree char *high = value_text(one, one->interval[1], false);
    sb_table_add(table, SB_CELLS(sb_cell_text(one->name),
                                 sb_cell_shown(value_text(one, one->before, true)),
                                 sb_cell_shown(value_text(one, one->estimate, false)),
                                 sb_cell_own(g_strdup_printf("%s to %s", low, high)),
                                 sb_cell_own(identifiable_text(of, j))));
  }
  return table;
}

char *sb_calibration_notes(const SbCalibration *of) {
  GString *text = g_string_new(NULL);
  char digits[2][SB_FORMAT_MAX];
  for (size_t c = 0; c < of->curves; c++) {
    const SbCalibratedCurve *curve = &of->curve[c];
    const double after = curve->after != NULL ? curve->after->rms : NAN;
    g_string_append_printf(text, "%s: differences %s N before, %s N after%s\n", curve->name,
                           sb_format_digits(digits[0], curve->before_rms, 3),
                           sb_format_digits(digits[1], after, 3),
                           curve->spread > 1 ? "; they are correlated, and counted for less" : "");
    if (curve->measured->force_zero == SB_HOW_ASSUMED) {
      g_string_append_printf(text,
                             "%s: the force's zero is not in the data and is used unchanged: an "
                             "offset is fitted as pressure\n",
                             curve->name);
    }
  }
  if (isfinite(of->chi2)) {
    g_string_append_printf(
        text, "chi2 per degree of freedom %s%s\n", sb_format_digits(digits[0], of->chi2, 3),
        of->chi2 > 1.5 ? ": more than noise is left, which the model cannot follow" : "");
  }
  if (of->tangent) {
    g_string_append_printf(
        text, "posterior of the tangent at the fit; %d solved loops differ from it by %s N\n",
        SB_CALIBRATION_CHECKS, sb_format_digits(digits[0], of->check_rms, 3));
  }
  g_autofree char *codes = sb_warning_codes(of->warnings, ", ");
  if (codes != NULL) {
    g_string_append_printf(text, "warnings of validity: %s\n", codes);
  }
  g_string_append(text, of->sentence);
  return g_string_free(text, FALSE);
}

// Fills the row of a parameter with the texts of the table, borrowed.
static void fill_row(SbCalibrationRow *row, const SbTable *table, const SbCalibration *of,
                     size_t j) {
  const SbCalibrated *one = &of->parameter[j];
  const SbTableCell *cell = sb_table_row(table, j)->cell;
  *row = (SbCalibrationRow){
      .name = one->name,
      .symbol = sb_param(one->id)->symbol,
      .before = one->before,
      .estimate = one->estimate,
      .low = one->interval[0],
      .high = one->interval[1],
      .prior_low = one->prior[0],
      .prior_high = one->prior[1],
      .prior = &one->distribution,
      .texts = {cell[BEFORE].shown, cell[ESTIMATE].shown, cell[INTERVAL].shown},
      .identifiable = cell[IDENTIFIABLE].shown,
      .role = one->identifiable == SB_IDENTIFIABLE_YES          ? SB_ROLE_PASS
              : one->identifiable == SB_IDENTIFIABLE_WITH_OTHER ? SB_ROLE_WARN
                                                                : SB_ROLE_SECOND};
}

void sb_calibration_page_draw(cairo_t *cr, SbRect rect, const SbCalibration *of,
                              const SbStudyFile *study, bool dark) {
  g_autoptr(SbTable) table = sb_calibration_table(of);
  SbCalibrationRow *row = g_new0(SbCalibrationRow, of->parameters + 1);
  SbCalibrationLoop *loop = g_new0(SbCalibrationLoop, of->curves + 1);
  bool all_identifiable = true;
  for (size_t j = 0; j < of->parameters; j++) {
    fill_row(&row[j], table, of, j);
    all_identifiable = all_identifiable && of->parameter[j].identifiable == SB_IDENTIFIABLE_YES;
  }
  for (size_t c = 0; c < of->curves; c++) {
    const SbCalibratedCurve *curve = &of->curve[c];
    loop[c] = (SbCalibrationLoop){.name = curve->name,
                                  .before = &curve->before_loop,
                                  .after = &curve->after_loop,
                                  .prior = &curve->prior,
                                  .posterior = &curve->posterior,
                                  .comparison = curve->after,
                                  .before_rms = curve->before_rms};
  }
  g_autofree char *foot = g_strdup_printf(
      "Sampled %zu points, one chain%s.  Fit of %zu parameters to %zu points, %zu "
      "runs.  chi\xc2\xb2 "
      "per degree of freedom %.2f.  Sealbench %s, engine %.12s",
      of->samples, of->tangent ? " on the tangent at the fit" : "", of->parameters, of->points,
      of->evaluations, of->chi2, sb_version(), sb_engine_identity()->source);
  const SbCalibrationView view = {.title = study->title,
                                  .subtitle = sb_document_title(study->scene),
                                  .sentence = of->sentence,
                                  .foot = foot,
                                  .all_identifiable = all_identifiable,
                                  .rows = of->parameters,
                                  .loops = of->curves,
                                  .samples = of->samples,
                                  .row = row,
                                  .loop = loop,
                                  .sample = of->sample,
                                  .correlation = of->correlation};
  sb_calibration_draw(cr, rect, sb_theme(dark), &view);
  g_free(row);
  g_free(loop);
}

typedef struct {
  const SbCalibration *calibration;
  const SbStudyFile *study;
} Page;

static void draw_page(cairo_t *cr, double width, double height, void *user) {
  const Page *page = user;
  sb_calibration_page_draw(cr, (SbRect){0, 0, width, height}, page->calibration, page->study,
                           false);
}

bool sb_calibration_put(FILE *stream, const SbCalibration *calibration, const SbStudyFile *study,
                        const char *ending, GError **error) {
  Page page = {calibration, study};
  const SbStill still = {.width = SB_CALIBRATION_WIDTH,
                         .height = SB_CALIBRATION_HEIGHT,
                         .title = study->title,
                         .comment = calibration->sentence,
                         .draw = draw_page,
                         .user = &page};
  return sb_still_put(stream, &still, ending, error);
}
