// The table of studies and the pieces that they are made of.
#include "engine/valve/studies/study.h"

#include "engine/valve/plan.h"
#include "engine/valve/sliding.h"
#include "engine/valve/studies/study_private.h"

#include <assert.h>
#include <math.h>
#include <pthread.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

typedef struct {
  const char *name, *title, *help;
  const SbStudyDesign *design;
} Entry;

static const Entry entries[SB_STUDY_COUNT] = {
#define SB_STUDY_ENTRY(code, function, name, title, help)                                          \
  [code] = {name, title, help, &sb_study_##function},
    SB_STUDY_LIST(SB_STUDY_ENTRY)
#undef SB_STUDY_ENTRY
};

static const Entry *find(SbStudyKind kind) {
  static const Entry none;
  return (unsigned)kind < SB_STUDY_COUNT ? &entries[kind] : &none;
}

const char *sb_study_name(SbStudyKind kind) {
  return find(kind)->name;
}

const char *sb_study_title(SbStudyKind kind) {
  return find(kind)->title;
}

const char *sb_study_help(SbStudyKind kind) {
  return find(kind)->help;
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
  const SbStudyDesign *design = find(kind)->design;
  const SbStudySolves none = {0}, *solves = design != NULL ? &design->solves : &none;
  double runs = 0;
  if (solves->runs > 0) {
    SbPlan plan;
    sb_plan_wished(&plan, model, &(SbPlanWishes){0});
    for (size_t i = 0; i < plan.field_count; i++) {
      runs += solves->runs * plan.field[i].cost_s;
    }
  }
  return runs + solves->speeds * sb_cost_speed_state(model) + solves->rings * SB_COST_RING +
         solves->discs * SB_COST_DISC + solves->fits * sb_cost_fit(model->fit) +
         solves->films * sb_cost_film(model->film) + solves->reynolds * SB_COST_FILM +
         solves->cycles * SB_COST_ACTUATION;
}

// Index for one more. A study that asks for more than its struct holds is wrong.
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
      {"N", "N"},   {"N/m", "N/m"},          {"MPa", "Pa"}, {"mm", "m"},
      {"nm", "m"},  {"mm/s", "m/s"},         {"day", "s"},  {"°C", "K"},
      {"mg", "kg"}, {"\xc2\xb5l/h", "m3/s"}, {"nl", "m3"}};
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
    sb_study_panel(out, &axis, "no value in this range");
  }
  for (int k = 0; k < SB_STUDY_COLUMNS && design->column[k] != NULL; k++) {
    sb_study_column(work, design->column[k], design->digits[k], design->line[k], design->value[k]);
  }
  const char *const text[] = {design->row_heading, design->models, design->validity};
  sb_text(out->row_heading, sizeof out->row_heading, "%s", text[0] != NULL ? text[0] : "");
  sb_text(out->models, sizeof out->models, "%s", text[1] != NULL ? text[1] : "");
  sb_text(out->validity, sizeof out->validity, "%s", text[2] != NULL ? text[2] : "");
}

bool sb_study_goes_on(SbStudyWork *work, SbStatus status, const SbReport *report) {
  if (work->status == SB_OK && status != SB_OK) {
    work->status = status;
    if (status == SB_ERROR_CANCELLED) {
      // Said alike wherever it struck.
      (void)sb_fail(work->report, status, "the study was cancelled");
    } else if (work->report != NULL) {
      *work->report = *report;
    }
  }
  return work->status == SB_OK;
}

// Tells the progress and looks for a cancel.
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

static void fix(SbStudyWork *work, const SbOverride *override, size_t count) {
  SbReport report;
  if (work->status == SB_OK) {
    (void)sb_study_goes_on(
        work, sb_model_override(&work->base, &work->base, override, count, &report), &report);
  }
}

// Gives the base what the study holds fixed.
static void fix_base(SbStudyWork *work) {
  const SbModel *scene = work->scene;
  const SbSealModel *ring = &scene->seal[SB_OUTER];
  const SbOverride machine[] = {
      {SB_P_MODELS_MOTION, SB_MODEL_MOTION_QUASI_STATIC},
      {SB_P_DRIVE_KIND, SB_MODEL_DRIVE_MACHINE},
      // What only the motion with inertia knows, and this cycle has not.
      {SB_P_DRIVE_CYCLES, 1},
      {SB_P_FRICTION_DWELL_GAIN, 0},
      {SB_P_FRICTION_STRIBECK_SPEED, 0},
      {SB_P_FRICTION_TANGENTIAL_STIFFNESS, 0},
      {SB_P_STEM_SPRING_STIFFNESS, 0},
      {SB_P_STEM_SPRING_PRELOAD, 0},
      {SB_P_CANISTER_PRESSURE_MAP,
       scene->pressure_map == SB_MAP_PORTS ? SB_MAP_CHAMBER_VENTED : scene->pressure_map},
  };
  const SbOverride outer[] = {
      {SB_P_STORAGE_TIME, 0},
      {SB_P_STORAGE_TEMPERATURE, scene->rubber.reference_temperature},
      // What the temperature has made of the rest.
      {SB_P_CANISTER_TEMPERATURE, SB_SIZES_TEMPERATURE},
      {SB_P_GLAND_RADIAL_SPACE, scene->radial_space},
      {SB_P_BORE_DIAMETER, scene->bore_diameter},
      {SB_P_CANISTER_PRESSURE, scene->canister_pressure},
      {SB_P_FLUID_VISCOSITY, scene->viscosity},
      {SB_P_FLUID_DENSITY, scene->density},
      {SB_P_SEAL_OUTER_SECTION_DIAMETER, ring->section_diameter},
      {SB_P_SEAL_OUTER_INNER_DIAMETER, ring->inner_diameter},
      {SB_P_SEAL_OUTER_MODULUS, ring->modulus},
      {SB_P_SEAL_INNER_SECTION_DIAMETER, ring->section_diameter},
      {SB_P_SEAL_INNER_INNER_DIAMETER, ring->inner_diameter},
      {SB_P_SEAL_INNER_MODULUS, ring->modulus},
      {SB_P_CANISTER_PRESSURE_MAP, SB_MAP_CHAMBER_FILLED},
  };
  const SbOverride smooth[] = {{SB_P_MODELS_FILM, SB_FILM_THESIS},
                               {SB_P_MODELS_ASPERITIES, SB_MODEL_ASPERITIES_BESIDE}};
  fix(work, machine, sizeof machine / sizeof machine[0]);
  fix(work, outer, work->design->outer ? sizeof outer / sizeof outer[0] : 0);
  fix(work, smooth, work->design->smooth ? sizeof smooth / sizeof smooth[0] : 0);
}

SbStatus sb_study_make(SbStudy *out, SbStudyKind kind, const SbModel *model,
                       const SbStudyHooks *hooks, SbReport *report) {
  const SbStudyDesign *design = find(kind)->design;
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
  work->base = *model;
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
  fix_base(work);
  if (work->status == SB_OK) {
    design->make(work);
  }
  for (int i = 0; i < 2 && work->largest[i] > 0; i++) {
    out->error = fmax(out->error, work->error[i] / work->largest[i]);
  }
  step(work, 1);
  sb_evaluator_destroy(work->evaluator);
  sb_evaluator_destroy(work->start);
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

// The answer of a line at x, NaN if there was none yet (*is_new).
static double *answer_at(SbStudyWork *work, int line, double x, bool *is_new) {
  *is_new = false;
  for (size_t i = 0; i < work->answers; i++) {
    if (work->answer[i].line == line && fabs(work->answer[i].x - x) <= 1e-9 * fabs(x)) {
      return work->answer[i].value;
    }
  }
  size_t at = next(&work->answers, SB_STUDY_ANSWERS);
  work->answer[at].line = line;
  work->answer[at].x = x;
  for (int i = 0; i < SB_STUDY_VALUES; i++) {
    work->answer[at].value[i] = NAN;
  }
  *is_new = true;
  return work->answer[at].value;
}

const double *sb_study_at(SbStudyWork *work, int line, double x) {
  bool is_new;
  double *value = answer_at(work, line, x, &is_new);
  if (is_new) {
    work->design->solve(value, work, line, x);
  }
  return value;
}

// ---- places side by side ----

enum { LANES = 2 };

typedef struct Team Team;

// One thread's places: every LANES-th, so that who solves what does not depend on the time it
// takes. It works on a study of its own, whose findings are added in order at the end.
typedef struct {
  Team *team;
  int index;
  SbStudyWork *work;
} Lane;

struct Team {
  SbStudyWork *work;
  const SbStudyPlace *place;
  double **value;
  size_t count, done;
  double from, to;
  pthread_mutex_t lock; // of the hooks and `done`
  Lane lane[LANES];
};

static bool team_cancelled(void *data) {
  Team *team = data;
  const SbStudyHooks *hooks = &team->work->hooks;
  if (hooks->cancelled == NULL) {
    return false;
  }
  pthread_mutex_lock(&team->lock);
  const bool yes = hooks->cancelled(hooks->data);
  pthread_mutex_unlock(&team->lock);
  return yes;
}

static void *solve_lane(void *data) {
  Lane *lane = data;
  Team *team = lane->team;
  const SbStudyHooks *hooks = &team->work->hooks;
  for (size_t i = (size_t)lane->index; i < team->count; i += LANES) {
    const SbStudyPlace *place = &team->place[i];
    if (team->value[i] == NULL) {
      continue; // there already
    }
    lane->work->design->solve(team->value[i], lane->work, place->line, place->x);
    pthread_mutex_lock(&team->lock);
    team->done++;
    if (hooks->progress != NULL && lane->work->status == SB_OK) {
      hooks->progress(hooks->data, team->from + (team->to - team->from) * (double)team->done /
                                                    (double)team->count);
    }
    pthread_mutex_unlock(&team->lock);
  }
  return NULL;
}

static Lane *lane_create(Team *team, int index) {
  const SbStudyWork *work = team->work;
  Lane *lane = &team->lane[index];
  *lane = (Lane){team, index, malloc(sizeof *lane->work)};
  SbStudy *out = calloc(1, sizeof *out);
  SbReport *report = calloc(1, sizeof *report);
  if (lane->work == NULL || out == NULL || report == NULL) {
    free(lane->work);
    free(out);
    free(report);
    lane->work = NULL;
    return NULL;
  }
  *lane->work = *work;
  lane->work->out = out;
  lane->work->report = report;
  lane->work->evaluator = NULL;
  lane->work->solver = NULL;
  lane->work->spent = 0;
  lane->work->hooks = (SbStudyHooks){.cancelled = team_cancelled, .data = team};
  out->complete = true;
  lane->work->status = sb_evaluator_create(&lane->work->evaluator, report);
  return lane;
}

static void lane_merge(SbStudyWork *work, Lane *lane) {
  SbStudyWork *own = lane->work;
  (void)sb_study_goes_on(work, own->status, own->report);
  work->spent += own->spent;
  for (int i = 0; i < 2; i++) {
    work->error[i] = fmax(work->error[i], own->error[i]);
    work->largest[i] = fmax(work->largest[i], own->largest[i]);
  }
  work->out->error = fmax(work->out->error, own->out->error);
  work->out->solves += own->out->solves;
  work->out->complete = work->out->complete && own->out->complete;
  sb_warnings_merge(&work->out->warnings, &own->out->warnings);
  sb_evaluator_destroy(own->evaluator);
  free(own->report);
  free(own->out);
  free(own);
}

void sb_study_solve(SbStudyWork *work, const SbStudyPlace *place, size_t count, double from,
                    double to) {
  double *value[SB_STUDY_ANSWERS];
  assert(count <= SB_STUDY_ANSWERS);
  if (work->status != SB_OK) {
    return;
  }
  for (size_t i = 0; i < count; i++) {
    bool is_new;
    value[i] = answer_at(work, place[i].line, place[i].x, &is_new);
    value[i] = is_new ? value[i] : NULL;
  }
  Team team = {.work = work,
               .place = place,
               .value = value,
               .count = count,
               .from = from,
               .to = to,
               .lock = PTHREAD_MUTEX_INITIALIZER};
  Lane *lane[LANES];
  pthread_t thread[LANES];
  bool runs[LANES] = {false};
  for (int i = 0; i < LANES; i++) {
    lane[i] = lane_create(&team, i);
  }
  for (int i = 0; i < LANES; i++) {
    if (lane[i] == NULL) {
      work->status = sb_fail(work->report, SB_ERROR_MEMORY, "no memory for a study");
    }
  }
  for (int i = 1; i < LANES && work->status == SB_OK; i++) {
    runs[i] = pthread_create(&thread[i], NULL, solve_lane, lane[i]) == 0;
  }
  for (int i = 0; i < LANES && work->status == SB_OK; i++) {
    if (!runs[i]) {
      (void)solve_lane(lane[i]);
    }
  }
  for (int i = 0; i < LANES; i++) {
    if (runs[i]) {
      pthread_join(thread[i], NULL);
    }
    if (lane[i] != NULL) {
      lane_merge(work, lane[i]);
    }
  }
  pthread_mutex_destroy(&team.lock);
  step(work, to);
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

void sb_study_note(SbStudy *out, const char *format, ...) {
  va_list arguments;
  va_start(arguments, format);
  sb_text_v(out->note[next(&out->note_count, SB_STUDY_NOTES)], sizeof out->note[0], format,
            arguments);
  va_end(arguments);
}

// ---- asking ----

void sb_study_squeezed(SbOverride out[SB_STUDY_SQUEEZED], const SbStudyWork *work, double squeeze) {
  const SbModel *scene = work->scene;
  double space = scene->seal[SB_OUTER].section_diameter * (1 - squeeze);
  double floor = scene->bore_diameter - 2 * scene->radial_space;
  double land = (scene->stem_diameter - floor) / (2 * scene->radial_space);
  out[0] = (SbOverride){SB_P_GLAND_RADIAL_SPACE, space};
  out[1] = (SbOverride){SB_P_BORE_DIAMETER, floor + 2 * space};
  out[2] = (SbOverride){SB_P_STEM_PRESSURE_DIAMETER, floor + land * 2 * space};
}

// What one answer cost and how far it is off.
static void account(SbStudyWork *work, SbStatus status) {
  SbStudy *out = work->out;
  const SbSummary *summary = sb_evaluator_summary(work->evaluator);
  if (summary == NULL) {
    return;
  }
  const SbCounters *counters = &summary->counters;
  size_t fits = counters->disc_solves + counters->ring_solves;
  work->spent += (double)counters->ring_solves * SB_COST_RING +
                 (double)counters->disc_solves * SB_COST_DISC +
                 (double)counters->reynolds_solves * SB_COST_FILM;
  out->solves += fits + counters->reynolds_solves;
  if (status != SB_OK) {
    return;
  }
  for (int seal = 0; fits > 0 && seal < SB_SEAL_COUNT; seal++) {
    const double size[] = {summary->seal[seal].load, summary->seal[seal].contact_width};
    const double error[] = {summary->error_load, summary->error_width};
    for (int i = 0; i < 2; i++) { // fmax() leaves out the seal that was not asked for
      work->error[i] = fmax(work->error[i], error[i] * size[i]);
      work->largest[i] = fmax(work->largest[i], size[i]);
    }
  }
  out->error = fmax(out->error, summary->error_film);
}

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
  question.keep = work->keeps;
  question.start = work->keeps ? NULL : work->start;
  SbReport report;
  SbEvaluator *evaluator = work->keeps ? work->start : work->evaluator;
  SbStatus status = sb_evaluator_ask(value, evaluator, &question, &report);
  account(work, status);
  if (status == SB_ERROR_CANCELLED || status == SB_ERROR_MEMORY) {
    (void)sb_study_goes_on(work, status, &report);
    return;
  }
  const SbModel *model = sb_evaluator_model(evaluator); // NULL: the values were refused
  if (status != SB_OK) {
    const char *what = model != NULL ? sb_fit_model_name((SbFitModel)model->fit) : "study";
    char code[48];
    sb_text(code, sizeof code, "study-gap-%s", what);
    sb_warn(&work->out->warnings, code, report.parameter, "%s has no value at some points: %s",
            what, report.text);
    work->out->complete = work->out->complete && status != SB_ERROR_NOT_CONVERGED;
  }
  step(work, fmin(work->spent / work->total, 1));
}

void sb_study_contact(double value[SB_STUDY_CONTACT], SbStudyWork *work, const SbOverride *override,
                      size_t overrides) {
  static const char *const paths[] = {"seals.outer.load_N", "seals.outer.pressure_peak_Pa",
                                      "seals.outer.contact_width_m"};
  enum { MOST = 12 };
  // Nothing drags it.
  SbOverride all[2 + MOST] = {{SB_P_FRICTION_SHEAR_STRENGTH, 0},
                              {SB_P_FRICTION_LOAD_COEFFICIENT, 0}};
  overrides = overrides < MOST ? overrides : MOST;
  for (size_t i = 0; i < overrides; i++) {
    all[2 + i] = override[i];
  }
  sb_study_ask(work, value, paths, SB_STUDY_CONTACT, all, 2 + overrides);
}

double sb_study_net_load(SbStudyWork *work) {
  double contact[SB_STUDY_CONTACT];
  sb_study_contact(contact, work, NULL, 0);
  const SbSummary *summary = sb_evaluator_summary(work->evaluator);
  return summary != NULL ? summary->seal[SB_OUTER].contact_pressure * contact[2] : NAN;
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
