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
    } else {
      *work->report = *report;
    }
  }
  return work->status == SB_OK;
}

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

// A solver that failed outside a question ends the study: what it has is its result, with a gap.
static void end_early(SbStudyWork *work) {
  if (work->status == SB_ERROR_NOT_CONVERGED) {
    const SbReport *why = work->report;
    sb_study_gap(work->out, NAN, why->text);
    sb_study_miss(work->out, "end", why->input, "the study ended early", why->text);
    work->status = SB_OK;
  }
}

SbStatus sb_study_view(SbStudy *out, SbStudyKind kind, const SbModel *model,
                       const SbStudyGrid *grid, const SbStudyHooks *hooks, SbReport *report) {
  const SbStudyDesign *design = find(kind);
  SbReport own = {0};
  report = report != NULL ? report : &own;
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
  work->budget = (SbWork){.limit = (size_t)model->work_limit,
                          .cancelled = work->hooks.cancelled,
                          .data = work->hooks.data};
  work->total = sb_study_cost(kind, model);
  work->status = sb_evaluator_create(&work->evaluator, report);
  if (work->status == SB_OK) {
    work->status = sb_film_solver_create(&work->solver, report);
  }
  sb_study_step(work, 0);
  if (grid == NULL) {
    hold_base(work);
  } else if (design->asks_grid == NULL || design->asks_grid(model)) {
    sb_study_answer_rows(work, grid->value, grid->line, grid->x, grid->samples, 0,
                         design->share > 0 ? design->share : 1);
  }
  if (work->status == SB_OK) {
    design->make(work);
  }
  for (int i = 0; i < 2 && work->largest[i] > 0; i++) {
    out->error = fmax(out->error, work->error[i] / work->largest[i]);
  }
  end_early(work);
  out->work = work->budget.done;
  sb_study_step(work, 1);
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

void sb_study_miss(SbStudy *out, const char *what, int input, const char *head, const char *why) {
  char code[48];
  const size_t before = out->warnings.count;
  sb_text(code, sizeof code, "study-gap-%s", what);
  sb_warn(&out->warnings, code, input, "%s: %s", head, why);
  out->missing = out->missing > 0               ? out->missing
                 : out->warnings.count > before ? out->warnings.count
                                                : 0;
}

void sb_study_note(SbStudy *out, const char *format, ...) {
  va_list arguments;
  va_start(arguments, format);
  sb_message_v(out->note[next(&out->note_count, SB_STUDY_NOTES)], sizeof out->note[0], format,
               arguments);
  va_end(arguments);
}
