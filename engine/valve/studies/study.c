// The table of studies and the pieces that they are made of.
#include "engine/valve/studies/study.h"

#include "engine/valve/studies/study_private.h"

#include <assert.h>
#include <math.h>
#include <stdarg.h>
#include <string.h>

typedef struct {
  const char *name, *title, *help;
  SbStatus (*make)(SbStudy *out, const SbModel *model, const SbStudyHooks *hooks, SbReport *report);
  double (*cost)(const SbModel *model);
} Entry;

static const Entry entries[SB_STUDY_COUNT] = {
#define SB_STUDY_ENTRY(code, function, name, title, help)                                          \
  [code] = {name, title, help, sb_study_##function, sb_study_##function##_cost},
    SB_STUDY_LIST(SB_STUDY_ENTRY)
#undef SB_STUDY_ENTRY
};

static const Entry *find(SbStudyKind kind) {
  return (unsigned)kind < SB_STUDY_COUNT ? &entries[kind] : NULL;
}

const char *sb_study_name(SbStudyKind kind) {
  const Entry *entry = find(kind);
  return entry != NULL ? entry->name : NULL;
}

const char *sb_study_title(SbStudyKind kind) {
  const Entry *entry = find(kind);
  return entry != NULL ? entry->title : NULL;
}

const char *sb_study_help(SbStudyKind kind) {
  const Entry *entry = find(kind);
  return entry != NULL ? entry->help : NULL;
}

bool sb_study_from_name(SbStudyKind *out, const char *name) {
  for (int i = 0; i < SB_STUDY_COUNT; i++) {
    if (strcmp(entries[i].name, name) == 0) {
      *out = (SbStudyKind)i;
      return true;
    }
  }
  return false;
}

double sb_study_cost(SbStudyKind kind, const SbModel *model) {
  const Entry *entry = find(kind);
  return entry != NULL ? entry->cost(model) : 0;
}

SbStatus sb_study_make(SbStudy *out, SbStudyKind kind, const SbModel *model,
                       const SbStudyHooks *hooks, SbReport *report) {
  const Entry *entry = find(kind);
  memset(out, 0, sizeof *out);
  if (entry == NULL) {
    return sb_fail(report, SB_ERROR_INPUT, "there is no study %d", (int)kind);
  }
  out->kind = kind;
  out->complete = true;
  SbStatus status = sb_study_step(hooks, 0, report);
  if (status == SB_OK) {
    status = entry->make(out, model, hooks, report);
  }
  if (out->load_largest > 0) {
    out->error = fmax(out->error, out->load_error / out->load_largest);
    out->error = fmax(out->error, out->width_error / out->width_largest);
  }
  if (status == SB_OK) {
    status = sb_study_step(hooks, 1, report);
  }
  return status;
}

// ---- building blocks ----

// Index for one more. A study that asks for more than its struct holds is wrong.
static size_t next(size_t *count, size_t capacity) {
  assert(*count < capacity);
  return *count < capacity ? (*count)++ : capacity - 1;
}

void sb_study_axis(SbStudyAxis *out, const char *quantity, const char *si, const char *unit,
                   bool logarithmic) {
  sb_text(out->quantity, sizeof out->quantity, "%s", quantity);
  sb_text(out->si, sizeof out->si, "%s", si);
  sb_text(out->unit, sizeof out->unit, "%s", unit);
  out->logarithmic = logarithmic;
}

SbStudyPanel *sb_study_panel(SbStudy *out, const char *quantity, const char *si, const char *unit,
                             bool logarithmic) {
  SbStudyPanel *panel = &out->panel[next(&out->panel_count, SB_STUDY_PANELS)];
  sb_study_axis(&panel->y, quantity, si, unit, logarithmic);
  sb_text(panel->empty, sizeof panel->empty, "no value in this range");
  return panel;
}

SbStudySeries *sb_study_series(SbStudyPanel *panel, SbStudyStyle style, const char *format, ...) {
  SbStudySeries *series = &panel->series[next(&panel->series_count, SB_STUDY_SERIES)];
  series->style = style;
  va_list arguments;
  va_start(arguments, format);
  sb_text_v(series->name, sizeof series->name, format, arguments);
  va_end(arguments);
  return series;
}

SbStudyColumn *sb_study_column(SbStudy *out, const char *name, const char *si, const char *unit) {
  SbStudyColumn *column = &out->column[next(&out->column_count, SB_STUDY_COLUMNS)];
  sb_text(column->name, sizeof column->name, "%s", name);
  sb_text(column->si, sizeof column->si, "%s", si);
  sb_text(column->unit, sizeof column->unit, "%s", unit);
  column->digits = 3;
  return column;
}

SbStudyRow *sb_study_row(SbStudy *out, const char *si, const char *unit, const char *format, ...) {
  SbStudyRow *row = &out->row[next(&out->row_count, SB_STUDY_ROWS)];
  va_list arguments;
  va_start(arguments, format);
  sb_text_v(row->name, sizeof row->name, format, arguments);
  va_end(arguments);
  sb_text(row->si, sizeof row->si, "%s", si != NULL ? si : "");
  sb_text(row->unit, sizeof row->unit, "%s", si != NULL ? unit : "");
  for (size_t i = 0; i < SB_STUDY_COLUMNS; i++) {
    row->value[i] = NAN;
  }
  return row;
}

void sb_study_point(SbStudySeries *series, double x, double y) {
  size_t at = next(&series->count, SB_STUDY_POINTS);
  series->x[at] = x;
  series->y[at] = y;
}

void sb_study_mark(SbStudy *out, double x, const char *format, ...) {
  SbStudyMark *mark = &out->mark[next(&out->mark_count, SB_STUDY_MARKS)];
  mark->x = x;
  va_list arguments;
  va_start(arguments, format);
  sb_text_v(mark->text, sizeof mark->text, format, arguments);
  va_end(arguments);
}

void sb_study_note(SbStudy *out, const char *format, ...) {
  va_list arguments;
  va_start(arguments, format);
  sb_text_v(out->note[next(&out->note_count, SB_STUDY_NOTES)], sizeof out->note[0], format,
            arguments);
  va_end(arguments);
}

SbStatus sb_study_step(const SbStudyHooks *hooks, double fraction, SbReport *report) {
  if (hooks != NULL && hooks->progress != NULL) {
    hooks->progress(hooks->data, fraction);
  }
  if (hooks != NULL && hooks->cancelled != NULL && hooks->cancelled(hooks->data)) {
    return sb_fail(report, SB_ERROR_CANCELLED, "the study was cancelled");
  }
  return sb_succeed(report);
}

static void add_load_error(SbStudy *out, const SbFit *fit) {
  out->load_error = fmax(out->load_error, fit->solver.error_estimate.load * fit->load);
  out->width_error =
      fmax(out->width_error, fit->solver.error_estimate.contact_width * fit->contact_width);
  out->width_largest = fmax(out->width_largest, fit->contact_width);
  out->load_largest = fmax(out->load_largest, fit->load);
}

SbStatus sb_study_fit(SbStudy *out, SbFit *fit, const SbFitProblem *problem,
                      const SbStudyHooks *hooks, SbReport *report) {
  SbFitProblem copy = *problem;
  if (hooks != NULL) {
    copy.cancel = hooks->cancelled;
    copy.cancel_data = hooks->data;
  }
  SbReport local = {0};
  SbStatus status = sb_fit_solve(fit, &copy, &local);
  bool solver =
      copy.model == SB_FIT_RING || copy.model == SB_FIT_DISC || copy.model == SB_FIT_DISC_THESIS;
  out->solves += solver ? 1 : 0;
  if (status == SB_ERROR_CANCELLED || status == SB_ERROR_MEMORY) {
    if (report != NULL) {
      *report = local;
    }
    return status;
  }
  if (status != SB_OK) {
    fit->load = fit->load_per_length = fit->pressure_peak = fit->contact_width = NAN;
    char code[48];
    sb_text(code, sizeof code, "study-gap-%s", sb_fit_model_name(copy.model));
    sb_warn(&out->warnings, code, local.parameter, "%s has no value at some points: %s",
            sb_fit_model_name(copy.model), local.text);
    out->complete = out->complete && status != SB_ERROR_NOT_CONVERGED;
  } else if (solver) {
    add_load_error(out, fit);
  }
  return sb_succeed(report);
}

SbStatus sb_study_sliding(SbStudy *out, SbSliding *state, const SbModel *model, int seal,
                          SbSealPressure pressure, double speed, SbSlidingMemory *memory,
                          SbReport *report) {
  SbSlidingCounts counts = {0};
  SbReport local = {0};
  SbStatus status =
      sb_sliding_solve(state, model, seal, pressure, speed, memory, &counts, NULL, &local);
  out->solves += counts.disc_solves + counts.ring_solves + counts.reynolds_solves;
  if (status == SB_ERROR_CANCELLED || status == SB_ERROR_MEMORY) {
    if (report != NULL) {
      *report = local;
    }
    return status;
  }
  if (status != SB_OK) {
    *state = (SbSliding){.load = NAN,
                         .load_per_length = NAN,
                         .load_net = NAN,
                         .contact_right = NAN,
                         .film_min = NAN,
                         .film_central = NAN,
                         .boundary_area = NAN,
                         .boundary_load = NAN,
                         .viscous = NAN,
                         .friction_static = NAN};
    sb_warn(&out->warnings, "study-gap-sliding", local.parameter, "some points have no value: %s",
            local.text);
    out->complete = out->complete && status != SB_ERROR_NOT_CONVERGED;
    return sb_succeed(report);
  }
  const SbFit *fit = sb_sliding_fit(memory);
  if (counts.disc_solves + counts.ring_solves > 0) {
    add_load_error(out, fit);
  }
  if (isfinite(state->film_error)) {
    out->error = fmax(out->error, state->film_error);
  }
  return sb_succeed(report);
}
