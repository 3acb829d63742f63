// The report of a study: the varied parameters, probabilities of the limits, statistics, a
// histogram and the sensitivities of each figure, curves of a grid; then the inputs of the scene.
#include "app/export/report.h"

#include "app/base/figure_text.h"
#include "app/base/format.h"
#include "app/base/number.h"
#include "app/export/report_study_private.h"
#include "app/export/study_results.h"
#include "engine/numeric/statistics.h"

#include <math.h>
#include <string.h>

#define DASH "\xe2\x80\x93"

enum { GRID_ROWS = 120 };

int sb_report_study_figure(const SbReportStudyParts *study, size_t k) {
  return g_array_index(study->study->figures, int, k);
}

const SbVary *sb_report_study_vary(const SbReportStudyParts *study, size_t k) {
  return &g_array_index(study->study->vary, SbVary, k);
}

char *sb_report_study_vary_label(const SbVary *vary) {
  if (vary->id == SB_VARY_VARIABLE) {
    return g_strdup(sb_vary_name(vary));
  }
  const SbParam *param = sb_param(vary->id);
  const char *of = param->seal == SB_OUTER ? ", outer" : param->seal == SB_INNER ? ", inner" : "";
  return g_strconcat(param->label, of, NULL);
}

static bool is_drawn(const SbReportStudyParts *study) {
  return study->study->method != SB_METHOD_RELIABILITY;
}

static char *shown_value(int figure, double value) {
  return isfinite(value) ? sb_figure_format(figure, value, NAN) : g_strdup(DASH);
}

SbLimit sb_report_study_limit(const SbReportStudyParts *study, int figure) {
  const SbLimits *limits = &study->study->limits;
  for (size_t i = 0; i < limits->count; i++) {
    if (limits->item[i].figure == figure) {
      return limits->item[i];
    }
  }
  return (SbLimit){figure, -INFINITY, INFINITY};
}

// ---- First page ----

// "5.2 % (4.1 to 6.5 %)", or in millionths. Owned by the caller.
static char *probability_text(const SbReportStudyParts *study, const SbLimitShare *share) {
  const bool rare = study->study->method == SB_METHOD_RELIABILITY;
  const double unit = rare ? 1e6 : 100;
  if (isnan(share->probability)) {
    return g_strdup(DASH);
  }
  char p[SB_FORMAT_MAX], low[SB_FORMAT_MAX], high[SB_FORMAT_MAX];
  sb_format_digits(p, unit * share->probability, 3);
  sb_format_digits(low, unit * share->interval[0], 3);
  sb_format_digits(high, unit * share->interval[1], 3);
  const char *name = rare ? "ppm" : "%";
  if (share->certain) {
    return g_strdup_printf("every valve fails (at least %s\xc2\xa0%s)", low, name);
  }
  return g_strdup_printf("%s\xc2\xa0%s (%s to %s)", p, name, low, high);
}

// "3 of 200", and how many have no value. Owned by the caller.
static char *beyond_text(const SbLimitShare *share) {
  g_autofree char *unknown =
      share->unknown > 0 ? g_strdup_printf("; %zu have no value", share->unknown) : g_strdup("");
  return g_strdup_printf("%zu of %zu%s", share->beyond, share->of, unknown);
}

static void draw_study_limits(SbReportPages *pages, SbReportStudyParts *study) {
  static const SbTableColumn columns[] = {
      {.label = "Limit on", .width = 4},
      {.label = "Limit", .width = 1.6},
      {.label = "Beyond", .width = 1.6},
      {.label = "Probability (95 % of sampling alone)", .width = 3},
      {.label = "\xce\xb2", .width = 0.8}};
  g_autoptr(SbTable) table = sb_table_new(columns, G_N_ELEMENTS(columns));
  const SbStudyFile *file = study->study;
  const bool independent =
      file->method == SB_METHOD_MONTE_CARLO || file->method == SB_METHOD_RELIABILITY;
  if (file->limits.count == 0) {
    return;
  }
  sb_report_heading(pages, "Limits", 80);
  for (size_t i = 0; i <= file->limits.count; i++) {
    SbLimitShare share;
    SbReport report = {0};
    const SbStatus status =
        sb_study_limit_share(&share, file, study->of->drawn, study->answers, i, &report);
    study->status = status != SB_OK ? status : study->status;
    const bool all = i == file->limits.count;
    const SbLimit *limit = &file->limits.item[all ? 0 : i];
    const bool beta = independent && isfinite(share.beta);
    sb_table_add(
        table,
        SB_CELLS(
            sb_cell_own(all ? g_strdup("any of them") : sb_figure_label(limit->figure)),
            sb_cell_shown(all ? NULL : sb_limit_format(limit->figure, limit->low, limit->high)),
            sb_cell_shown(beyond_text(&share)),
            sb_cell_shown(independent ? probability_text(study, &share) : g_strdup(DASH)),
            sb_cell_shown(beta ? g_strdup_printf("%.2f", share.beta) : g_strdup(DASH))));
    sb_table_mark(table, share.beyond > 0 ? SB_TABLE_DOUBT : SB_TABLE_PLAIN);
  }
  sb_report_table(pages, table);
  sb_report_skip(pages, 6);
  sb_report_text(pages,
                 independent ? "Fractions of the feasible samples; a sample whose solver did not "
                               "converge widens the interval."
                             : "The points are not independent draws, so they give no probability.",
                 SB_TYPE_NOTE, 400, SB_ROLE_SECOND);
}

static void draw_statistics(SbReportPages *pages, SbReportStudyParts *study) {
  static const SbTableColumn columns[] = {
      {.label = "Figure", .width = 3.6},    {.label = "Mean", .width = 1.3},
      {.label = "Deviation", .width = 1.3}, {.label = "Least", .width = 1.3},
      {.label = "5 %", .width = 1.3},       {.label = "Median", .width = 1.3},
      {.label = "95 %", .width = 1.3},      {.label = "Most", .width = 1.3}};
  g_autoptr(SbTable) table = sb_table_new(columns, G_N_ELEMENTS(columns));
  sb_report_heading(pages, "Figures over the samples", 80);
  for (size_t k = 0; k < study->answers->figures; k++) {
    const int figure = sb_report_study_figure(study, k);
    SbSummaryOfSamples of;
    SbReport report = {0};
    const SbStatus status = sb_samples_summary(
        &of, study->answers->value + k, study->answers->samples, study->answers->figures, &report);
    if (status != SB_OK || of.count == 0) {
      study->status = status != SB_OK ? status : study->status;
      continue;
    }
    const double value[] = {of.mean,        of.deviation,   of.min, of.quantile[1],
                            of.quantile[2], of.quantile[3], of.max};
    SbTableCell cell[G_N_ELEMENTS(columns)] = {sb_cell_own(sb_figure_label(figure))};
    for (size_t i = 0; i < G_N_ELEMENTS(value); i++) {
      const bool constant = i == 1 && of.count > 1 && !of.varies;
      cell[i + 1] = sb_cell_shown(constant ? g_strdup("does not vary")
                                           : sb_study_statistic(figure, value[i]));
    }
    sb_table_add(table, cell);
  }
  sb_report_table(pages, table);
}

// Which samples are outside the validity of their models.
static void draw_study_warnings(SbReportPages *pages, const SbReportStudyParts *study) {
  size_t count = 0;
  g_autofree SbCodeCount *codes = sb_study_warnings(&count, study->answers);
  g_autoptr(GString) text = g_string_new("Warnings of validity: ");
  for (size_t i = 0; i < count; i++) {
    g_string_append_printf(text, "%s%s in %zu", i > 0 ? ", " : "", codes[i].code, codes[i].count);
  }
  g_string_append_printf(text, " of %zu samples.", study->answers->samples);
  if (count > 0) {
    sb_report_skip(pages, 6);
    sb_report_text(pages, text->str, SB_TYPE_NOTE, 400, SB_ROLE_SECOND);
  }
}

static char *vary_value(const SbVary *vary, double value) {
  char digits[SB_NUMBER_SIZE];
  return vary->id == SB_VARY_VARIABLE ? g_strdup(sb_number_round(digits, value, 6))
                                      : sb_param_format(vary->id, value);
}

// "normal, mean 1.36 mm, deviation 0.01 mm"; owned by the caller.
static char *distribution_text(const SbVary *vary) {
  const SbDistribution *of = &vary->distribution;
  if (vary->by != NULL) {
    return g_strdup_printf("follows: %s", vary->by);
  }
  g_autofree char *a = vary_value(vary, of->a), *b = vary_value(vary, of->b);
  switch (of->kind) {
  case SB_DISTRIBUTION_UNIFORM:
    return g_strdup_printf("uniform, %s to %s", a, b);
  case SB_DISTRIBUTION_LOGUNIFORM:
    return g_strdup_printf("uniform in the logarithm, %s to %s", a, b);
  case SB_DISTRIBUTION_NORMAL: {
    g_autofree char *low = isfinite(of->low) ? sb_param_format(vary->id, of->low) : NULL;
    g_autofree char *high = isfinite(of->high) ? sb_param_format(vary->id, of->high) : NULL;
    return low != NULL && high != NULL
               ? g_strdup_printf("normal, mean %s, deviation %s, within %s to %s", a, b, low, high)
               : g_strdup_printf("normal, mean %s, deviation %s", a, b);
  }
  default: {
    GString *text = g_string_new("levels");
    for (size_t i = 0; i < of->count && i < 12; i++) {
      g_autofree char *level = vary_value(vary, of->level[i]);
      g_string_append_printf(text, "%s %s", i > 0 ? "," : "", level);
    }
    g_string_append(text, of->count > 12 ? ", \xe2\x80\xa6" : "");
    return g_string_free(text, FALSE);
  }
  }
}

static void draw_varied(SbReportPages *pages, const SbReportStudyParts *study) {
  static const SbTableColumn columns[] = {{.label = "Varied parameters", .width = 3.4},
                                          {.label = "In the scene", .width = 1.6},
                                          {.label = "How", .width = 5}};
  g_autoptr(SbTable) table = sb_table_new(columns, G_N_ELEMENTS(columns));
  const SbStudyFile *file = study->study;
  sb_report_heading(pages, "Varied parameters", 60);
  // A grid of several lines may have several lines of one parameter.
  guint grid = 0;
  for (guint k = 0; k < (file->lines != NULL ? file->lines->len : file->vary->len); k++) {
    const SbVary *vary = file->lines != NULL ? &g_array_index(file->lines, SbVary, k)
                                             : sb_report_study_vary(study, k);
    if (file->lines != NULL && vary->grid != grid) {
      sb_table_note(table, "Grid %u, %zu samples", vary->grid,
                    sb_study_grid_samples(file, vary->grid));
      grid = vary->grid;
    }
    const bool is_param = vary->id != SB_VARY_VARIABLE;
    sb_table_add(
        table, SB_CELLS(sb_cell_text(sb_vary_name(vary)),
                        sb_cell_shown(is_param ? sb_param_format(
                                                     vary->id, sb_model_value(file->base, vary->id))
                                               : NULL),
                        sb_cell_own(distribution_text(vary))));
  }
  sb_report_table(pages, table);
}

static void draw_leakage(SbReportPages *pages, SbReportStudyParts *study) {
  SbLeakageOdds odds;
  SbReport report = {0};
  if (study->study->leakage_tests == 0) {
    return;
  }
  const SbStatus status = sb_study_leakage(&odds, study->study, study->answers, &report);
  study->status = status != SB_OK ? status : study->status;
  sb_report_heading(pages, study->study->leakage.edition, 40);
  char p[SB_FORMAT_MAX], low[SB_FORMAT_MAX], high[SB_FORMAT_MAX];
  g_autofree char *text =
      isnan(odds.probability)
          ? g_strdup("No sample has a loss on the shelf.")
          : g_strdup_printf("%zu of %zu simulated tests pass, %s\xc2\xa0%% (95\xc2\xa0%%: %s to "
                            "%s\xc2\xa0%%), %zu of them in the second stage.",
                            odds.passed, odds.tests, sb_format_digits(p, 100 * odds.probability, 3),
                            sb_format_digits(low, 100 * odds.interval[0], 3),
                            sb_format_digits(high, 100 * odds.interval[1], 3), odds.second);
  sb_report_text(pages, text, SB_TYPE_LABEL, 400, SB_ROLE_INK);
}

// ---- Grids ----

// Curves of a grid of real parameters: the last one along the axis, a line for each combination of
// the others; what does not fit is left to the table.
static void make_curves(SbReportStudyParts *study) {
  const SbStudyFile *file = study->study;
  const size_t n = file->vary->len, samples = study->answers->samples;
  if (file->method != SB_METHOD_GRID || file->lines != NULL || n == 0) {
    return;
  }
  const SbParam *last = sb_param(sb_report_study_vary(study, n - 1)->id);
  size_t length = 1; // of a line: until the first parameter comes back to where it began
  while (length < samples &&
         memcmp(&study->of->value[length * n], study->of->value, (n - 1) * sizeof(double)) == 0) {
    length++;
  }
  if (last->kind != SB_PARAM_REAL || length < 2 || length > SB_STUDY_POINTS ||
      samples / length > SB_STUDY_SERIES || samples % length != 0) {
    return;
  }
  SbStudy *out = g_new0(SbStudy, 1);
  g_strlcpy(out->x.quantity, last->label, sizeof out->x.quantity);
  g_strlcpy(out->x.si, last->si, sizeof out->x.si);
  g_strlcpy(out->x.unit, last->unit, sizeof out->x.unit);
  out->complete = true;
  for (size_t k = 0; k < study->answers->figures && out->panel_count < SB_STUDY_PANELS; k++) {
    const int index = sb_report_study_figure(study, k);
    const SbFigure *figure = sb_figure(index);
    const SbLimit limit = sb_report_study_limit(study, index);
    g_autofree char *label = sb_figure_label(index);
    SbStudyAxis axis = {.logarithmic = false};
    g_strlcpy(axis.quantity, label, sizeof axis.quantity);
    g_strlcpy(axis.si, figure->si, sizeof axis.si);
    g_strlcpy(axis.unit, figure->shown, sizeof axis.unit);
    SbStudyPanel *panel = sb_study_panel(out, &axis, "not computed");
    panel->limit_low = limit.low;
    panel->limit_high = limit.high;
    for (size_t line = 0; line < samples / length; line++) {
      g_autoptr(GString) name = g_string_new(NULL);
      for (size_t p = 0; p + 1 < n; p++) {
        g_autofree char *value = sb_param_format(sb_report_study_vary(study, p)->id,
                                                 study->of->value[line * length * n + p]);
        g_string_append_printf(name, "%s%s", p > 0 ? ", " : "", value);
      }
      SbStudySeries *series =
          sb_study_series(panel, SB_STUDY_CURVE, name->len > 0 ? name->str : label);
      for (size_t i = 0; i < length; i++) {
        const size_t sample = line * length + i;
        sb_study_point(series, study->of->value[sample * n + n - 1],
                       study->answers->value[sample * study->answers->figures + k]);
      }
    }
  }
  study->curves = out;
}

static void draw_study_page(cairo_t *cr, SbRect rect, const SbTheme *theme, const void *of) {
  sb_study_draw(cr, rect, theme, of);
}

// Returns the parameters of a sample with their values.
static char *point_text(const SbReportStudyParts *study, size_t sample) {
  GString *out = g_string_new(NULL);
  for (size_t p = 0; p < study->study->vary->len; p++) {
    const SbVary *vary = sb_report_study_vary(study, p);
    const double at = study->of->value[sample * study->study->vary->len + p];
    if (vary->id != SB_VARY_VARIABLE && isfinite(at)) {
      const char *symbol = sb_param(vary->id)->symbol;
      g_autofree char *value = sb_param_format(vary->id, at);
      g_string_append_printf(out, "%s%s %s", out->len > 0 ? ", " : "",
                             symbol != NULL ? symbol : sb_vary_name(vary), value);
    }
  }
  return g_string_free(out, FALSE);
}

// Draws one row for each sample of a grid: its parameters in one cell, then the first figures.
static void draw_samples(SbReportPages *pages, const SbReportStudyParts *study) {
  enum { FIGURES = 4 };
  const SbAnswers *answers = study->answers;
  SbTableColumn columns[2 + FIGURES] = {{.label = "", .width = 0.6},
                                        {.label = "Sample", .width = 4}};
  const size_t figures = MIN(answers->figures, FIGURES);
  g_autoptr(GPtrArray) heads = g_ptr_array_new_with_free_func(g_free);
  if (study->study->method != SB_METHOD_GRID || answers->samples > GRID_ROWS) {
    return;
  }
  for (size_t k = 0; k < figures; k++) {
    g_ptr_array_add(heads, sb_figure_label(sb_report_study_figure(study, k)));
    columns[2 + k] = (SbTableColumn){.label = heads->pdata[k], .width = 1.8};
  }
  g_autoptr(SbTable) table = sb_table_new(columns, 2 + figures);
  sb_report_heading(pages, "Samples", 80);
  for (size_t i = 0; i < answers->samples; i++) {
    SbTableCell cell[2 + FIGURES] = {sb_cell_shown(g_strdup_printf("%zu", i + 1)),
                                     sb_cell_own(point_text(study, i))};
    for (size_t k = 0; k < figures; k++) {
      cell[2 + k] = sb_cell_own(
          shown_value(sb_report_study_figure(study, k), answers->value[i * answers->figures + k]));
    }
    sb_table_add(table, cell);
    sb_table_mark(table, answers->status[i] == SB_OK ? SB_TABLE_PLAIN : SB_TABLE_DOUBT);
  }
  sb_report_table(pages, table);
}

// ---- The whole ----

static void draw_failures(SbReportPages *pages, const SbReportStudyParts *study) {
  enum { MOST = 12 };
  size_t shown = 0;
  if (sb_study_failed(study->answers) == 0) {
    return;
  }
  static const SbTableColumn columns[] = {{.label = "Sample", .width = 0.8},
                                          {.label = "Status", .width = 1.4},
                                          {.label = "Reason", .width = 7}};
  g_autoptr(SbTable) table = sb_table_new(columns, G_N_ELEMENTS(columns));
  sb_report_heading(pages, "Samples without an answer", 60);
  for (size_t i = 0; i < study->answers->samples && shown < MOST; i++) {
    const uint8_t status = study->answers->status[i];
    if (status != SB_OK && status != SB_ANSWER_MISSING) {
      sb_table_add(table, SB_CELLS(sb_cell_shown(g_strdup_printf("%zu", i + 1)),
                                   sb_cell_text(sb_study_status_name(status)),
                                   sb_cell_text(g_hash_table_lookup(study->answers->reason,
                                                                    GSIZE_TO_POINTER(i)))));
      sb_table_mark(table, SB_TABLE_DOUBT);
      shown++;
    }
  }
  sb_report_table(pages, table);
}

static void draw_pages(SbReportPages *pages, const void *of) {
  SbReportStudyParts *study = (SbReportStudyParts *)of;
  const SbStudyFile *file = study->study;
  const size_t done = sb_study_done(study->answers), failed = sb_study_failed(study->answers);
  g_autofree char *line =
      g_strdup_printf("%s  \xc2\xb7  %s, %zu samples, seed %" G_GUINT64_FORMAT, study->files,
                      sb_study_method_name(file->method), file->samples, file->seed);
  sb_report_title(pages, file->title, line);
  sb_report_skip(pages, 8);
  if (done < study->answers->samples) {
    g_autofree char *text = g_strdup_printf("The study is not complete: %zu of %zu samples are "
                                            "there.",
                                            done, study->answers->samples);
    sb_report_notice(pages, text, true);
  }
  if (failed > 0) {
    g_autofree char *text =
        g_strdup_printf("%zu of %zu samples have no answer: no valve, or a solver did not "
                        "converge; they are listed below.",
                        failed, done);
    sb_report_notice(pages, text, false);
  }
  for (int i = 0; i < SB_SHELF_SPECIES; i++) {
    g_autofree char *typical = sb_study_typical(file, (SbShelfSpecies)i);
    if (typical != NULL) {
      sb_report_notice(pages, typical, false);
    }
  }
  draw_study_limits(pages, study);
  draw_leakage(pages, study);
  if (is_drawn(study)) {
    draw_statistics(pages, study);
  }
  draw_study_warnings(pages, study);
  draw_varied(pages, study);
  if (is_drawn(study) && file->method != SB_METHOD_GRID) {
    sb_report_study_histograms(pages, study);
  }
  sb_report_study_tornados(pages, study);
  if (study->curves != NULL) {
    sb_report_heading(pages, "Over the grid", 420);
    sb_report_picture(pages, study->curves->panel_count > 1 ? 620 : 400, draw_study_page,
                      study->curves);
  }
  draw_samples(pages, study);
  draw_failures(pages, study);
  sb_report_page(pages, false);
  sb_report_inputs(pages, file->scene, file->base);
}

bool sb_report_study(FILE *stream, const SbReportStudy *of, const SbReportHooks *hooks,
                     GError **error) {
  SbReportStudyParts study = {.of = of, .study = of->study, .answers = of->answers};
  g_autofree char *scene = sb_report_files(of->study->scene);
  g_autofree char *own = of->study->path != NULL ? g_path_get_basename(of->study->path) : NULL;
  study.files = own != NULL ? g_strconcat(own, "  \xc2\xb7  ", scene, NULL) : g_strdup(scene);
  g_autofree char *foot = sb_report_foot(study.files, of->study->base_sha256);
  const SbReportTexts texts = {.title = of->study->title,
                               .foot = foot,
                               .hash = of->study->base_sha256,
                               .bookmark = "Summary"};
  sb_report_study_make_tornados(&study);
  make_curves(&study);
  bool good = sb_report_pages_write(stream, &texts, draw_pages, &study, hooks, error);
  if (good && study.status != SB_OK) {
    g_set_error(error, SB_APP_ERROR, SB_APP_ERROR_IO, "%s", sb_status_text(study.status));
    good = false;
  }
  g_ptr_array_unref(study.names);
  g_free(study.tornado);
  g_free(study.curves);
  g_free(study.files);
  return good;
}
