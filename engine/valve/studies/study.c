// The table of studies and the pieces that they are made of.
#include "engine/valve/studies/study.h"

#include "engine/valve/states/sliding.h"
#include "engine/valve/studies/hold.h"
#include "engine/valve/studies/study_private.h"

#include <assert.h>
#include <math.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

static const SbStudyDesign *find(SbStudyKind kind) {
  static const SbStudyDesign *const designs[SB_STUDY_COUNT] = {
#define SB_STUDY_ENTRY(code, function, name, title, help) [code] = &sb_study_##function,
      SB_STUDY_LIST(SB_STUDY_ENTRY)
#undef SB_STUDY_ENTRY
  };
  return (unsigned)kind < SB_STUDY_COUNT ? designs[kind] : NULL;
}

// Returns the index of one more element. A study must not add more than its struct can store.
static size_t next(size_t *count, size_t capacity) {
  assert(*count < capacity);
  return *count < capacity ? (*count)++ : capacity - 1;
}

SbStudyPanel *sb_study_panel(SbStudy *out, const SbStudyAxis *y, const char *empty) {
  SbStudyPanel *panel = &out->panel[next(&out->panel_count, SB_STUDY_PANELS)];
  panel->y = *y;
  panel->limit_low = -INFINITY;
  panel->limit_high = INFINITY;
  sb_text(panel->empty, sizeof panel->empty, "%s", empty);
  return panel;
}

// Splits "quantity [unit]" into its name, the unit, and the SI unit of that.
static void put_quantity(const char *text, char name[], size_t size, char si[16], char unit[16]) {
  static const char *const units[][2] = {
      {"N", "N"},      {"N/m", "N/m"},         {"MPa", "Pa"}, {"mm", "m"},  {"nm", "m"},
      {"mm/s", "m/s"}, {SB_LABEL("day"), "s"}, {"°C", "K"},   {"mg", "kg"}, {"\xc2\xb5l/h", "m3/s"},
      {"nl", "m3"}};
  const char *bracket = strstr(text, " [");
  const size_t length = bracket != NULL ? (size_t)(bracket - text) : strlen(text);
  sb_text(name, size, "%.*s", (int)length, text);
  sb_text(unit, 16, "%.*s", bracket != NULL ? (int)strcspn(bracket + 2, "]") : 0,
          bracket != NULL ? bracket + 2 : "");
  sb_text(si, 16, "1");
  for (size_t i = 0; i < sizeof units / sizeof units[0]; i++) {
    if (strcmp(unit, units[i][0]) == 0) {
      sb_text(si, 16, "%s", units[i][1]);
    }
  }
}

void sb_study_column(SbStudyWork *work, const char *quantity, int digits, int line, int value) {
  const size_t at = next(&work->out->column_count, SB_STUDY_COLUMNS);
  SbStudyColumn *column = &work->out->column[at];
  put_quantity(quantity, column->name, sizeof column->name, column->si, column->unit);
  column->digits = digits > 0 ? digits : 3;
  work->line[at] = line;
  work->value[at] = value;
}

// Axes, columns and texts that the scene does not change.
static void put_design(SbStudyWork *work) {
  SbStudy *out = work->out;
  const SbStudyDesign *design = work->design;
  SbStudyAxis axis = {.logarithmic = design->x_logarithmic};
  put_quantity(design->x, axis.quantity, sizeof axis.quantity, axis.si, axis.unit);
  out->x = axis;
  for (int p = 0; p < SB_STUDY_PANELS && design->panel[p] != NULL; p++) {
    put_quantity(design->panel[p], axis.quantity, sizeof axis.quantity, axis.si, axis.unit);
    axis.logarithmic = design->logarithmic[p];
    sb_study_panel(out, &axis, SB_LABEL("no value in this range"));
  }
  for (int k = 0; k < SB_STUDY_COLUMNS && design->column[k] != NULL; k++) {
    sb_study_column(work, design->column[k], design->digits[k], design->line[k], design->value[k]);
    out->column[k].difference = design->difference[k];
  }
  const char *const text[] = {design->row_heading, design->models, design->validity};
  sb_text(out->row_heading, sizeof out->row_heading, "%s", text[0] != NULL ? text[0] : "");
  sb_message(out->models, sizeof out->models, "%s", text[1] != NULL ? text[1] : "");
  sb_message(out->validity, sizeof out->validity, "%s", text[2] != NULL ? text[2] : "");
}

bool sb_study_goes_on(SbStudyWork *work, SbStatus status, const SbReport *report) {
  if (work->status == SB_OK && status != SB_OK) {
    work->status = status;
    if (status == SB_ERROR_CANCELLED) {
      // The same sentence wherever the study was cancelled.
      (void)sb_fail(work->report, status, "the study was cancelled");
    } else if (work->report != NULL) {
      *work->report = *report;
    }
  }
  return work->status == SB_OK;
}

// Reports progress and polls for a cancel.
static void step(SbStudyWork *work, double fraction) {
  const SbStudyHooks *hooks = &work->hooks;
  if (work->status != SB_OK) {
    return;
  }
  if (hooks->progress != NULL) {
    hooks->progress(hooks->data, fraction);
  }
  if (hooks->cancelled != NULL && hooks->cancelled(hooks->data)) {
    (void)sb_study_goes_on(work, SB_ERROR_CANCELLED, NULL);
  }
}

static void answer_rows(SbStudyWork *work, const double *value, const int *line, const double *x,
                        size_t rows, double from, double to);

// Sets the base of studies without a grid.
static void hold_base(SbStudyWork *work) {
  SbReport report;
  SbModel *held = NULL;
  const SbStatus status = sb_model_hold(&held, work->scene, SB_HOLD_MACHINE, &report);
  if (sb_study_goes_on(work, status, &report)) {
    work->base = *held;
  }
  sb_model_destroy(held); // of a study that was cancelled before, too
}

bool sb_study_has_grid(SbStudyKind kind) {
  return find(kind) != NULL && find(kind)->grid;
}

size_t sb_study_extra(const SbParamId **out, SbStudyKind kind) {
  *out = find(kind)->extra;
  return find(kind)->extras;
}

SbStatus sb_study_view(SbStudy *out, SbStudyKind kind, const SbModel *model,
                       const SbStudyGrid *grid, const SbStudyHooks *hooks, SbReport *report) {
  const SbStudyDesign *design = find(kind);
  memset(out, 0, sizeof *out);
  if (design == NULL) {
    return sb_fail(report, SB_ERROR_INPUT, "there is no study %d", (int)kind);
  }
  SbStudyWork *work = calloc(1, sizeof *work);
  if (work == NULL) {
    return sb_fail(report, SB_ERROR_MEMORY, "no memory for a study");
  }
  out->kind = kind;
  out->complete = true;
  const double *range = (const double *)((const char *)&model->study + design->range);
  work->out = out;
  work->design = design;
  work->scene = model;
  work->base = grid != NULL ? *grid->base : *model;
  work->grid = grid;
  put_design(work);
  work->report = report;
  work->lo = range[0];
  work->hi = range[1];
  work->hooks = hooks != NULL ? *hooks : (SbStudyHooks){0};
  work->total = sb_study_cost(kind, model);
  work->status = sb_evaluator_create(&work->evaluator, report);
  if (work->status == SB_OK) {
    work->status = sb_film_solver_create(&work->solver, report);
  }
  step(work, 0);
  if (grid == NULL) {
    hold_base(work);
  } else if (design->asks_grid == NULL || design->asks_grid(model)) {
    answer_rows(work, grid->value, grid->line, grid->x, grid->samples, 0,
                design->share > 0 ? design->share : 1);
  }
  if (work->status == SB_OK) {
    design->make(work);
  }
  for (int i = 0; i < 2 && work->largest[i] > 0; i++) {
    out->error = fmax(out->error, work->error[i] / work->largest[i]);
  }
  step(work, 1);
  sb_evaluator_destroy(work->evaluator);
  sb_film_solver_destroy(work->solver);
  SbStatus status = work->status;
  free(work);
  return status == SB_OK ? sb_succeed(report) : status;
}

// ---- building blocks ----

SbStudySeries *sb_study_series(SbStudyPanel *panel, SbStudyStyle style, const char *name) {
  SbStudySeries *series = &panel->series[next(&panel->series_count, SB_STUDY_SERIES)];
  series->style = style;
  sb_text(series->name, sizeof series->name, "%s", name);
  return series;
}

void sb_study_point(SbStudySeries *series, double x, double y) {
  size_t at = next(&series->count, SB_STUDY_POINTS);
  series->x[at] = x;
  series->y[at] = y;
}

SbStudyRow *sb_study_row(SbStudy *out, const char *format, ...) {
  SbStudyRow *row = &out->row[next(&out->row_count, SB_STUDY_ROWS)];
  va_list arguments;
  va_start(arguments, format);
  sb_text_v(row->name, sizeof row->name, format, arguments);
  va_end(arguments);
  for (size_t i = 0; i < SB_STUDY_COLUMNS; i++) {
    row->value[i] = NAN;
  }
  return row;
}

double sb_study_place(const SbStudyWork *work, int index, int count) {
  double lo = work->lo, hi = work->hi, t = index / (count - 1.0);
  return work->out->x.logarithmic ? lo * pow(hi / lo, t) : lo + (hi - lo) * index / (count - 1);
}

// Where the answer of a line at x is, NaN if there was none yet (*is_new).
static size_t place_of(SbStudyWork *work, int line, double x, bool *is_new) {
  *is_new = false;
  for (size_t i = 0; i < work->answers; i++) {
    if (work->answer[i].line == line && fabs(work->answer[i].x - x) <= 1e-9 * fabs(x)) {
      return i;
    }
  }
  size_t at = next(&work->answers, SB_STUDY_ANSWERS);
  work->answer[at].line = line;
  work->answer[at].x = x;
  for (int i = 0; i < SB_STUDY_VALUES; i++) {
    work->answer[at].value[i] = NAN;
  }
  *is_new = true;
  return at;
}

static double *answer_at(SbStudyWork *work, int line, double x, bool *is_new) {
  return work->answer[place_of(work, line, x, is_new)].value;
}

double *sb_study_put(SbStudyWork *work, int line, double x) {
  bool is_new;
  return answer_at(work, line, x, &is_new);
}

const double *sb_study_at(SbStudyWork *work, int line, double x) {
  const size_t before = work->answers;
  bool is_new;
  double *value = answer_at(work, line, x, &is_new);
  if (is_new && work->design->solve != NULL) {
    work->design->solve(value, work, line, x);
  } else if (is_new) {
    work->answers = before; // no answer yet
  }
  return value;
}

void sb_study_cells(double *value, SbStudyWork *work, double x, int shift) {
  for (size_t k = 0; k < work->out->column_count; k++) {
    value[k] = sb_study_at(work, work->line[k] + shift, x)[work->value[k]];
  }
}

void sb_study_curves(SbStudyWork *work, SbStudyStyle style, const char *name, int line,
                     const double *at, int count) {
  for (size_t p = 0; p < work->out->panel_count; p++) {
    SbStudySeries *series = sb_study_series(&work->out->panel[p], style, name);
    for (int i = 0; i < count; i++) {
      double x = at != NULL ? at[i] : sb_study_place(work, i, count);
      sb_study_point(series, x, sb_study_at(work, line, x)[p]);
    }
  }
}

void sb_study_level(SbStudyWork *work, SbStudyPanel *panel, const char *name, double y) {
  SbStudySeries *series = sb_study_series(panel, SB_STUDY_REFERENCE, name);
  sb_study_point(series, work->lo, y);
  sb_study_point(series, work->hi, y);
}

void sb_study_mark(SbStudyWork *work, double x, const char *format, ...) {
  if (!(x >= work->lo && x <= work->hi)) {
    return;
  }
  SbStudyMark *mark = &work->out->mark[next(&work->out->mark_count, SB_STUDY_MARKS)];
  mark->x = x;
  va_list arguments;
  va_start(arguments, format);
  sb_text_v(mark->text, sizeof mark->text, format, arguments);
  va_end(arguments);
}

void sb_study_gap(SbStudy *out, double x, const char *why) {
  if (out->complete) {
    out->gap_at = x;
    sb_message(out->gap, sizeof out->gap, "%s", why);
  }
  out->complete = false;
}

void sb_study_note(SbStudy *out, const char *format, ...) {
  va_list arguments;
  va_start(arguments, format);
  sb_message_v(out->note[next(&out->note_count, SB_STUDY_NOTES)], sizeof out->note[0], format,
               arguments);
  va_end(arguments);
}

// ---- asking ----

// Cost of one answer, its errors, and the reason of its gaps.
typedef struct {
  SbStatus status;
  SbReport report;
  int fit; // index of the model, -1: the values were refused
  size_t rings, discs, films;
  double size[SB_SEAL_COUNT][2], error[2]; // loads and contact widths
  double film, force;                      // errors
} Seen;

static Seen look(SbStatus status, const SbReport *report, const SbEvaluator *evaluator) {
  const SbSummary *summary = sb_evaluator_summary(evaluator);
  Seen out = {.status = status, .report = *report, .fit = -1};
  if (summary == NULL) {
    return out;
  }
  out.fit = (int)sb_evaluator_model(evaluator)->fit;
  out.rings = summary->counters.ring_solves;
  out.discs = summary->counters.disc_solves;
  out.films = summary->counters.reynolds_solves;
  for (int seal = 0; seal < SB_SEAL_COUNT; seal++) {
    out.size[seal][0] = summary->seal[seal].load;
    out.size[seal][1] = summary->seal[seal].contact_width;
  }
  out.error[0] = summary->error_load;
  out.error[1] = summary->error_width;
  out.film = summary->error_film;
  out.force = summary->error_force;
  return out;
}

static void account(SbStudyWork *work, const Seen *seen, double x) {
  SbStudy *out = work->out;
  const size_t fits = seen->discs + seen->rings;
  work->spent += (double)seen->rings * SB_COST_RING + (double)seen->discs * SB_COST_DISC +
                 (double)seen->films * SB_COST_FILM;
  out->solves += fits + seen->films;
  for (int seal = 0; seen->status == SB_OK && fits > 0 && seal < SB_SEAL_COUNT; seal++) {
    for (int i = 0; i < 2; i++) { // fmax() ignores a seal without results
      work->error[i] = fmax(work->error[i], seen->error[i] * seen->size[seal][i]);
      work->largest[i] = fmax(work->largest[i], seen->size[seal][i]);
    }
  }
  if (seen->status == SB_OK) {
    out->error = fmax(out->error, seen->film);
    out->error = work->design->forces ? fmax(out->error, seen->force) : out->error;
    return;
  }
  const char *what = seen->fit >= 0 ? sb_fit_kind((SbFitModel)seen->fit)->name : "study";
  char code[48];
  sb_text(code, sizeof code, "study-gap-%s", what);
  sb_warn(&out->warnings, code, sb_input_resolve(seen->report.input),
          "%s has no value at some points: %s", what, seen->report.text);
  if (seen->status == SB_ERROR_NOT_CONVERGED) {
    sb_study_gap(out, x, seen->report.text);
  }
}

// ---- the grid ----

// Rows that are being computed.
typedef struct {
  SbStudyWork *work;
  Seen *seen;
  double from, to;
  bool cancelled;
} Asking;

static void on_seen(void *data, size_t row, SbStatus status, const SbReport *report,
                    const SbEvaluator *evaluator) {
  Asking *asking = data;
  asking->seen[row] = look(status, report, evaluator);
}

static void on_progress(void *data, size_t done, size_t of) {
  const Asking *asking = data;
  const SbStudyHooks *hooks = &asking->work->hooks;
  if (hooks->progress != NULL && !asking->cancelled && of > 0) {
    hooks->progress(hooks->data,
                    asking->from + (asking->to - asking->from) * (double)done / (double)of);
  }
}

static bool on_cancelled(void *data) {
  Asking *asking = data;
  const SbStudyHooks *hooks = &asking->work->hooks;
  asking->cancelled =
      asking->cancelled || (hooks->cancelled != NULL && hooks->cancelled(hooks->data));
  return asking->cancelled;
}

static void answer_rows(SbStudyWork *work, const double *value, const int *line, const double *x,
                        size_t rows, double from, double to) {
  const SbStudyGrid *grid = work->grid;
  Asking asking = {work, calloc(rows + 1, sizeof(Seen)), from, to, false};
  double *figures = malloc((rows * grid->figures + 1) * sizeof *figures);
  SbReport report = {0};
  if (work->status == SB_OK && (asking.seen == NULL || figures == NULL)) {
    work->status = sb_fail(work->report, SB_ERROR_MEMORY, "no memory for a study");
  }
  if (work->status == SB_OK) {
    const SbStudyAsk ask = {value, rows, work->start, on_seen, on_progress, on_cancelled, &asking};
    const SbStatus status = grid->answer(grid->data, figures, &ask);
    (void)sb_fail(&report, status, "%s", sb_status_text(status));
    (void)sb_study_goes_on(work, status, &report);
  }
  for (size_t i = 0; i < rows && work->status == SB_OK; i++) {
    bool is_new;
    const size_t at = place_of(work, line[i], x[i], &is_new);
    double *out = work->answer[at].value;
    if (work->answer[at].answered) {
      continue; // almost the same place
    }
    work->answer[at].answered = true;
    if (work->design->is_no_case != NULL && work->design->is_no_case(work, line[i], x[i])) {
      continue;
    }
    account(work, &asking.seen[i], x[i]);
    memcpy(out, figures + i * grid->figures, grid->figures * sizeof *out);
    if (work->design->derive != NULL) {
      work->design->derive(out, work, line[i], x[i]);
    }
  }
  free(asking.seen);
  free(figures);
}

void sb_study_more(SbStudyWork *work, const SbStudyPlace *place, size_t count, double from,
                   double to) {
  const SbStudyGrid *grid = work->grid;
  double *value = malloc((count * grid->columns + 1) * sizeof *value);
  int *line = malloc((count + 1) * sizeof *line);
  double *x = malloc((count + 1) * sizeof *x);
  size_t rows = 0;
  if (work->status == SB_OK && (value == NULL || line == NULL || x == NULL)) {
    work->status = sb_fail(work->report, SB_ERROR_MEMORY, "no memory for a study");
  }
  for (size_t i = 0; i < count && work->status == SB_OK; i++) {
    bool is_new;
    (void)answer_at(work, place[i].line, place[i].x, &is_new);
    double *row = value + rows * grid->columns;
    if (!is_new) {
      continue;
    }
    if (place[i].fill != NULL) {
      for (size_t k = 0; k < grid->columns; k++) {
        row[k] = NAN;
      }
      place[i].fill(row, work, place[i].line, place[i].x);
    }
    grid->place(grid->data, row, place[i].fill != NULL ? -1 : place[i].line, place[i].x);
    line[rows] = place[i].line;
    x[rows++] = place[i].x;
  }
  if (rows > 0) {
    answer_rows(work, value, line, x, rows, from, to);
  }
  free(value);
  free(line);
  free(x);
}

int sb_study_grid_column(const SbStudyWork *work, const char *name) {
  for (size_t k = 0; k < work->grid->columns; k++) {
    if (strcmp(work->grid->column[k], name) == 0) {
      return (int)k;
    }
  }
  assert(false); // the study's file has not what its view needs
  return 0;
}

// ---- questions ----

void sb_study_ask(SbStudyWork *work, double *value, const char *const *path, size_t paths,
                  const SbOverride *override, size_t overrides) {
  enum { PATHS = 8 };
  assert(paths <= PATHS);
  int figure[PATHS];
  for (size_t i = 0; i < paths; i++) {
    figure[i] = sb_figure_find(path[i]);
    assert(figure[i] >= 0);
    value[i] = NAN;
  }
  if (work->status != SB_OK) {
    return;
  }
  SbQuestion question = {.base = &work->base,
                         .override = override,
                         .override_count = overrides,
                         .figure = figure,
                         .figure_count = paths,
                         .cancelled = work->hooks.cancelled,
                         .data = work->hooks.data};
  SbReport report;
  SbStatus status = sb_evaluator_ask(value, work->evaluator, &question, &report);
  if (status == SB_ERROR_CANCELLED || status == SB_ERROR_MEMORY) {
    (void)sb_study_goes_on(work, status, &report);
    return;
  }
  const Seen seen = look(status, &report, work->evaluator);
  account(work, &seen, NAN);
  step(work, fmin(work->spent / work->total, 1));
}

double sb_study_net_load(SbStudyWork *work) {
  static const char *const paths[] = {"seals.outer.contact_pressure_Pa",
                                      "seals.outer.contact_width_m"};
  // As fitted: nothing drags it.
  static const SbOverride smooth[] = {{SB_P_FRICTION_SHEAR_STRENGTH, 0},
                                      {SB_P_FRICTION_LOAD_COEFFICIENT, 0}};
  double value[2];
  sb_study_ask(work, value, paths, 2, smooth, 2);
  return value[0] * value[1];
}

void sb_study_film_problem(SbFilmProblem *out, const SbStudyWork *work, double load, double speed) {
  sb_sliding_film_problem(out, work->scene, SB_OUTER, (SbSealPressure){0, 0}, load, speed);
  out->cancelled = work->hooks.cancelled;
  out->cancelled_data = work->hooks.data;
}

SbStatus sb_study_film(SbStudyWork *work, const SbFilmProblem *problem, SbReport *report) {
  if (work->status != SB_OK) {
    return work->status;
  }
  SbStatus status = sb_film_solve(&work->film, problem, work->solver, report);
  work->out->solves++;
  work->spent += SB_COST_FILM;
  if (status == SB_ERROR_CANCELLED || status == SB_ERROR_MEMORY) {
    (void)sb_study_goes_on(work, status, report);
  } else if (status == SB_OK) {
    const SbFilmSolverInfo *info = &work->film.solver;
    work->out->error = fmax(work->out->error, fmax(info->error_film_min, info->error_film_central));
  }
  step(work, fmin(work->spent / work->total, 1));
  return status;
}
