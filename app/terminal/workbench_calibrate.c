// The page Calibrate of the workbench: the measured loop compared with the model, and parameters
// fitted to it. Request and job are those of the window (app/session/calibrate_ask.h,
// calibrate_job.h).
#include "app/terminal/workbench_private.h"

#include "app/base/translation.h"
#include "app/base/unit.h"
#include "app/export/calibrate_results.h"
#include "app/export/measured_results.h"
#include "app/session/worker.h"

#include <glib/gi18n.h>
#include <math.h>

// Columns of the table of parameters and of that of the stages.
enum {
  BEFORE_ROOM = 11,
  ESTIMATE_ROOM = 10,
  INTERVAL_ROOM = 20,
  IDENTIFIABLE_ROOM = 15,
  STAGES_ROOM = 40
};

// The request and the job ------------------------------------------------------------------------

static void forget_calibration(SbBenchCalibrate *calibrate) {
  if (calibrate->study != NULL) {
    sb_calibration_release(&calibrate->found);
    g_clear_pointer(&calibrate->study, sb_study_file_free);
  }
  g_clear_pointer(&calibrate->sentence, g_free);
}

void sb_bench_calibrate_follow(SbBench *bench) {
  SbBenchCalibrate *calibrate = &bench->calibrate;
  const SbData *data = sb_calibrate_data(sb_session_document(bench->session));
  if (!sb_data_same(calibrate->fitted, data)) {
    g_clear_pointer(&calibrate->job, sb_calibrate_job_free);
    forget_calibration(calibrate);
    sb_data_free(calibrate->fitted);
    calibrate->fitted = data != NULL ? sb_data_copy(data) : NULL;
  }
}

static void on_calibrated(void *user) {
  SbBench *bench = user;
  SbBenchCalibrate *calibrate = &bench->calibrate;
  SbCalibration found;
  SbStudyFile *study = NULL;
  char *why = NULL;
  if (sb_calibrate_job_take(calibrate->job, &found, &study, &why)) {
    forget_calibration(calibrate);
    calibrate->found = found;
    calibrate->study = study;
    why = found.partial      ? g_strdup(_("Interrupted: the best values so far, without intervals"))
          : !found.converged ? g_strdup(_("The fit did not converge."))
                             : NULL;
  }
  g_free(calibrate->sentence);
  calibrate->sentence = why;
  g_clear_pointer(&calibrate->job, sb_calibrate_job_free);
  if (bench->page == SB_PAGE_CALIBRATE) { // which has the result
    g_clear_pointer(&bench->message, g_free);
    sb_bench_changed(bench);
  } else {
    sb_bench_status(bench, why != NULL, "%s", why != NULL ? why : _("The parameters are fitted."));
  }
}

static void start_calibration(SbBench *bench) {
  SbBenchCalibrate *calibrate = &bench->calibrate;
  const SbDocument *document = sb_session_document(bench->session);
  if (calibrate->job != NULL) {
    sb_bench_status(bench, true, _("A calibration is running; c cancels it."));
    return;
  }
  if (sb_calibrate_data(document) == NULL) {
    sb_bench_status(bench, true, _("nothing measured"));
    return;
  }
  g_autoptr(GPtrArray) issues = sb_issues_new();
  SbStudyFile *study = sb_calibrate_ask_study(&calibrate->ask, document, issues);
  if (study == NULL) {
    g_free(calibrate->sentence);
    calibrate->sentence = sb_issue_line(issues->pdata[0]);
    return;
  }
  g_free(calibrate->hash);
  calibrate->hash = sb_document_sha256(document);
  calibrate->job = sb_calibrate_job_start(study, on_calibrated, bench);
}

bool sb_bench_calibrate_stop(SbBench *bench) {
  if (bench->calibrate.job != NULL) {
    sb_worker_cancel(bench->calibrate.job);
  }
  return bench->calibrate.job != NULL;
}

void sb_bench_calibrate_finish(SbBench *bench) {
  g_clear_pointer(&bench->calibrate.job, sb_calibrate_job_free);
  forget_calibration(&bench->calibrate);
  sb_data_free(bench->calibrate.fitted);
  g_free(bench->calibrate.hash);
}

static void use_estimates(SbBench *bench) {
  const SbBenchCalibrate *calibrate = &bench->calibrate;
  const size_t most = calibrate->study != NULL ? calibrate->found.parameters : 0;
  g_autofree SbOverride *values = g_new(SbOverride, most + 1);
  const size_t count = most > 0 ? sb_calibration_estimates(values, &calibrate->found) : 0;
  if (count == 0) {
    sb_bench_status(bench, true, _("There are no estimates that the data identify."));
  } else if (sb_session_edit_values(bench->session, values, count)) {
    sb_bench_status(bench, false, _("The valve has the estimates; u undoes it."));
  } else {
    sb_bench_status(bench, true, _("A value is out of range."));
  }
}

void sb_bench_calibrate_key(SbBench *bench, const SbKey *key) {
  SbBenchCalibrate *calibrate = &bench->calibrate;
  switch (key->kind) {
  case SB_KEY_ENTER:
    start_calibration(bench);
    break;
  case SB_KEY_UP:
    calibrate->row = MAX(calibrate->row - 1, 0);
    break;
  case SB_KEY_DOWN:
    calibrate->row = MIN(calibrate->row + 1, SB_CALIBRATE_CHOICES - 1);
    break;
  case SB_KEY_LEFT:
  case SB_KEY_RIGHT:
    calibrate->ask.fitted[calibrate->row] = !calibrate->ask.fitted[calibrate->row];
    break;
  case SB_KEY_CHARACTER:
    if (key->character == 'a' && !key->control) {
      use_estimates(bench);
    }
    break;
  default:
    break;
  }
}

// Parameters -------------------------------------------------------------------------------------

// Returns the index of a parameter among the fitted ones; -1: it is none.
static int fitted_index(const SbBenchCalibrate *calibrate, SbParamId id) {
  const size_t count = calibrate->study != NULL ? calibrate->found.parameters : 0;
  for (size_t j = 0; j < count; j++) {
    if (calibrate->found.parameter[j].id == id) {
      return (int)j;
    }
  }
  return -1;
}

// The texts of the table of `sealbench calibrate`: before, estimate, interval, identifiable.
static void draw_fitted(SbBench *bench, const SbTable *table, int j, int x, int y, SbPen pen) {
  SbCells *cells = &bench->cells;
  const SbCalibration *found = &bench->calibrate.found;
  const SbTableCell *cell = sb_table_row(table, (size_t)j)->cell + 1;
  const SbIdentifiable identifiable = found->parameter[j].identifiable;
  const SbRole role = identifiable == SB_IDENTIFIABLE_YES          ? SB_ROLE_PASS
                      : identifiable == SB_IDENTIFIABLE_WITH_OTHER ? SB_ROLE_WARN
                                                                   : SB_ROLE_SECOND;
  sb_cells_text_right(cells, x, y, BEFORE_ROOM, cell[0].shown, pen);
  x += BEFORE_ROOM;
  SbPen strong = pen;
  strong.style |= SB_CELL_BOLD;
  sb_cells_text_right(cells, x, y, ESTIMATE_ROOM, cell[1].shown, strong);
  x += ESTIMATE_ROOM;
  sb_cells_text_right(cells, x, y, INTERVAL_ROOM, cell[2].shown, pen);
  pen.ink = bench->theme.role[found->samples > 0 ? role : SB_ROLE_SECOND];
  sb_cells_text(cells, x + INTERVAL_ROOM + 2, y, IDENTIFIABLE_ROOM - 2, cell[3].shown, pen);
}

static void draw_parameter(SbBench *bench, const SbTable *table, int index, int y, int width) {
  SbBenchCalibrate *calibrate = &bench->calibrate;
  SbCells *cells = &bench->cells;
  const SbParamId id = sb_calibrate_choice(index);
  const bool fitted = calibrate->ask.fitted[index];
  SbPen pen = sb_bench_row(bench, 0, y, width, calibrate->row == index);
  if (!fitted) {
    pen.ink = bench->theme.role[SB_ROLE_THIRD];
  }
  const int x = width - BEFORE_ROOM - ESTIMATE_ROOM - INTERVAL_ROOM - IDENTIFIABLE_ROOM;
  sb_cells_text(cells, 1, y, 1, fitted ? "✓" : "·", pen);
  sb_cells_text(cells, 3, y, x - 3, sb_translation(sb_param(id)->label), pen);
  const int j = fitted_index(calibrate, id);
  if (table != NULL && j >= 0) {
    draw_fitted(bench, table, j, x, y, pen);
  } else {
    g_autofree char *own =
        sb_param_format(id, sb_document_value(sb_session_document(bench->session), id));
    sb_cells_text_right(cells, x, y, BEFORE_ROOM, own, pen);
  }
}

static void draw_parameters(SbBench *bench, int y, int width) {
  SbCells *cells = &bench->cells;
  const SbBenchCalibrate *calibrate = &bench->calibrate;
  const SbPen quiet = sb_bench_pen(bench, SB_ROLE_SECOND, 0);
  g_autoptr(SbTable) table =
      calibrate->study != NULL ? sb_calibration_table(&calibrate->found) : NULL;
  int x = width - BEFORE_ROOM - ESTIMATE_ROOM - INTERVAL_ROOM - IDENTIFIABLE_ROOM;
  sb_cells_text(cells, 1, y, x - 2, _("Fitted parameters"),
                sb_bench_pen(bench, SB_ROLE_INK, SB_CELL_BOLD));
  sb_cells_text_right(cells, x, y, BEFORE_ROOM, _("before"), quiet);
  x += BEFORE_ROOM;
  sb_cells_text_right(cells, x, y, ESTIMATE_ROOM, _("estimate"), quiet);
  x += ESTIMATE_ROOM;
  sb_cells_text_right(cells, x, y, INTERVAL_ROOM, _("95 % interval"), quiet);
  sb_cells_text(cells, x + INTERVAL_ROOM + 2, y, IDENTIFIABLE_ROOM - 2, _("identifiable"), quiet);
  for (int i = 0; i < SB_CALIBRATE_CHOICES; i++) {
    draw_parameter(bench, table, i, y + 1 + i, width);
  }
}

static int draw_line(SbBench *bench, SbCellRect rect, int y, const char *text, SbRole role) {
  return text == NULL || *text == '\0' || y >= rect.y + rect.height
             ? y
             : y + sb_cells_paragraph(&bench->cells,
                                      (SbCellRect){rect.x, y, rect.width, rect.y + rect.height - y},
                                      text, sb_bench_pen(bench, role, 0));
}

// What is being computed, or what the last fit left.
static void draw_calibrate_foot(SbBench *bench, SbCellRect rect) {
  const SbBenchCalibrate *calibrate = &bench->calibrate;
  if (calibrate->job != NULL) {
    sb_bench_draw_progress(bench, rect.x, rect.y, rect.width, _("Fitting"),
                           sb_worker_progress(calibrate->job));
    return;
  }
  int y = draw_line(bench, rect, rect.y, calibrate->sentence, SB_ROLE_WARN);
  if (calibrate->study == NULL) {
    (void)draw_line(bench, rect, y,
                    _("Enter fits the marked parameters to the measured loop, c cancels, a uses "
                      "the estimates. ← → mark the selected row."),
                    SB_ROLE_SECOND);
    return;
  }
  const SbCalibration *found = &calibrate->found;
  g_autofree char *now = sb_document_sha256(sb_session_document(bench->session));
  const bool former = g_strcmp0(now, calibrate->hash) != 0;
  y = draw_line(bench, rect, y, former ? _("of earlier values") : NULL, SB_ROLE_WARN);
  g_autofree char *notes = sb_calibration_notes(found);
  g_auto(GStrv) line = g_strsplit(notes, "\n", 0);
  // Short of room, one paragraph.
  g_autofree char *all = g_strjoinv("; ", line);
  if (rect.height < (int)g_strv_length(line) + 2) {
    (void)draw_line(bench, rect, y, all, SB_ROLE_INK);
    return;
  }
  for (int i = 0; line[i] != NULL; i++) {
    y = draw_line(bench, rect, y, line[i], SB_ROLE_INK);
  }
}

// The measured loop ------------------------------------------------------------------------------

// Draws the table of forces at the stages from row `y`. Returns its last row.
static int draw_stage_table(SbBench *bench, const SbComparison *measured, int y) {
  SbCells *cells = &bench->cells;
  const SbPen plain = sb_bench_pen(bench, SB_ROLE_INK, 0);
  const SbPen quiet = sb_bench_pen(bench, SB_ROLE_SECOND, 0);
  static const char *const heads[] = {N_("stage"), N_("measured"), N_("model"), N_("difference")};
  for (int i = 0; i < 4; i++) {
    sb_cells_text_right(cells, 1 + (i > 0 ? 6 + 11 * (i - 1) : 0), y, i > 0 ? 11 : 6, _(heads[i]),
                        quiet);
  }
  for (int s = SB_STAGE_B; s < SB_STAGE_COUNT; s++) {
    const SbMeasuredStage *stage = &measured->measured->stage[s];
    const double has = stage->found ? stage->force : NAN, model = measured->model_force[s];
    if (isnan(has) && isnan(model)) {
      continue;
    }
    char *value[3];
    sb_measured_stage_texts(value, measured, (SbStage)s);
    y++;
    sb_cells_text(cells, 5, y, 2, sb_stage_name((SbStage)s), plain);
    for (int i = 0; i < 3; i++) {
      sb_cells_text_right(cells, 7 + 11 * i, y, 11, value[i], plain);
      g_free(value[i]);
    }
  }
  return y;
}

static void draw_comparison(SbBench *bench, const SbComparison *measured, SbCellRect rect) {
  SbCells *cells = &bench->cells;
  enum { WITH_RESIDUALS = 15 };
  g_autofree char *rms = sb_measured_difference(measured->rms);
  g_autofree char *most = sb_measured_difference(measured->most);
  g_autofree char *text =
      g_strdup_printf(_("rms %s, at most %s, %zu rows"), rms, most, measured->count);
  sb_cells_text_right(cells, STAGES_ROOM, rect.y, rect.width - STAGES_ROOM - 1, text,
                      sb_bench_pen(bench, SB_ROLE_SECOND, 0));
  (void)draw_stage_table(bench, measured, rect.y + 1);
  const bool both = rect.height >= WITH_RESIDUALS;
  const int high = rect.height - 1;
  const SbCellRect loop = {STAGES_ROOM + 2, rect.y + 1, rect.width - STAGES_ROOM - 4,
                           both ? high * 2 / 3 : high};
  sb_chart_loop(cells, loop, &bench->theme, sb_session_chart(bench->session), 0);
  if (!both) {
    return;
  }
  g_autofree double *x = g_new(double, measured->count + 1);
  for (size_t i = 0; i < measured->count; i++) {
    x[i] = 1e3 * measured->point[i].displacement;
  }
  const SbCellCurve residual = {.name = "",
                                .x = x,
                                .y = measured->residual,
                                .count = measured->count,
                                .role = SB_ROLE_OCHRE,
                                .dots = true};
  sb_chart_curves(cells, (SbCellRect){loop.x, loop.y + loop.height, loop.width, high - loop.height},
                  &bench->theme, _("measured less model / N over mm"), &residual, 1, false, false);
}

// The page ---------------------------------------------------------------------------------------

void sb_bench_draw_calibrate(SbBench *bench, SbCellRect rect) {
  SbCells *cells = &bench->cells;
  const SbComparison *measured = sb_session_chart(bench->session)->measured;
  const char *failure = sb_session_measured_failure(bench->session);
  sb_cells_text(cells, 1, rect.y, rect.width - 2, _("Measured and computed"),
                sb_bench_pen(bench, SB_ROLE_INK, SB_CELL_BOLD));
  if (sb_calibrate_data(sb_session_document(bench->session)) == NULL || failure != NULL) {
    sb_cells_paragraph(
        cells, (SbCellRect){1, rect.y + 2, rect.width - 2, 4},
        failure != NULL ? failure
                        : _("No loop was measured, so nothing can be fitted: a group [data] in the "
                            "scene names its file, as in `file = machine-export.csv`."),
        sb_bench_pen(bench, failure != NULL ? SB_ROLE_ERROR : SB_ROLE_SECOND, 0));
    return;
  }
  const int foot = rect.height >= 24 ? 7 : 4, table = 1 + SB_CALIBRATE_CHOICES;
  const int high = rect.height - table - foot;
  if (measured != NULL && high > 1) {
    draw_comparison(bench, measured, (SbCellRect){0, rect.y, rect.width, high});
  }
  draw_parameters(bench, rect.y + high, rect.width);
  draw_calibrate_foot(bench, (SbCellRect){1, rect.y + high + table, rect.width - 2, foot});
}
