// Answers of a study: its places, the grid's rows, and questions one by one.
#include "engine/valve/states/sliding.h"
#include "engine/valve/studies/study_private.h"

#include <assert.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

// Where the answer of a line at x is, NaN if there was none yet (*is_new).
static size_t place_of(SbStudyWork *work, int line, double x, bool *is_new) {
  *is_new = false;
  for (size_t i = 0; i < work->answers; i++) {
    if (work->answer[i].line == line && fabs(work->answer[i].x - x) <= 1e-9 * fabs(x)) {
      return i;
    }
  }
  // A study must not have more than its struct can store.
  assert(work->answers < SB_STUDY_ANSWERS);
  const size_t at = work->answers < SB_STUDY_ANSWERS ? work->answers++ : SB_STUDY_ANSWERS - 1;
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

void sb_study_step(SbStudyWork *work, double fraction) {
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

// ---- asking ----

// Cost of one answer, its errors, and the reason of its gaps.
typedef struct {
  SbStatus status;
  SbReport report;
  int fit; // index of the model, -1: the values were refused
  size_t rings, discs, films, work;
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
  out.work = summary->work;
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

// Returns SbQuestion.work_used of each of `parts` questions that share the budget that is left.
static size_t used_of_part(const SbStudyWork *work, size_t parts) {
  return work->budget.limit - sb_work_part(&work->budget, parts).limit;
}

static void account(SbStudyWork *work, const Seen *seen, int line, double x) {
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
  char head[96];
  sb_text(head, sizeof head, "%s has no value at some points", what);
  sb_study_miss(out, what, sb_input_resolve(seen->report.input), head, seen->report.text);
  const bool bridged = work->design->is_bridged != NULL && work->design->is_bridged(work, line);
  if (seen->status == SB_ERROR_NOT_CONVERGED && !bridged) {
    sb_study_gap(out, x, seen->report.text);
  } else if (seen->status == SB_ERROR_NOT_CONVERGED && work->bridged[0] == '\0') {
    work->bridged_at = x;
    sb_message(work->bridged, sizeof work->bridged, "%s", seen->report.text);
  }
}

// ---- the grid ----

// Rows that share the budget that is left in equal parts. The number is fixed, so that the result
// does not depend on the number of threads.
enum { ROWS_TOGETHER = 16 };

// Rows that are being computed.
typedef struct {
  SbStudyWork *work;
  Seen *seen;          // of the first of the rows that are computed together
  size_t before, rows; // rows that are finished; all rows
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
  (void)of;
  if (hooks->progress != NULL && !asking->cancelled) {
    hooks->progress(hooks->data, asking->from + (asking->to - asking->from) *
                                                    (double)(asking->before + done) /
                                                    (double)asking->rows);
  }
}

static bool on_cancelled(void *data) {
  Asking *asking = data;
  const SbStudyHooks *hooks = &asking->work->hooks;
  asking->cancelled =
      asking->cancelled || (hooks->cancelled != NULL && hooks->cancelled(hooks->data));
  return asking->cancelled;
}

void sb_study_answer_rows(SbStudyWork *work, const double *value, const int *line, const double *x,
                          size_t rows, double from, double to) {
  const SbStudyGrid *grid = work->grid;
  Seen *seen = calloc(rows + 1, sizeof *seen);
  double *figures = malloc((rows * grid->figures + 1) * sizeof *figures);
  if (work->status == SB_OK && (seen == NULL || figures == NULL)) {
    work->status = sb_fail(work->report, SB_ERROR_MEMORY, "no memory for a study");
  }
  for (size_t i = 0; i < rows && work->status == SB_OK; i += ROWS_TOGETHER) {
    const size_t count = rows - i < ROWS_TOGETHER ? rows - i : ROWS_TOGETHER;
    Asking asking = {work, seen + i, i, rows, from, to, false};
    const SbStudyAsk ask = {.value = value + i * grid->columns,
                            .rows = count,
                            .work_used = used_of_part(work, count),
                            .seen = on_seen,
                            .progress = on_progress,
                            .cancelled = on_cancelled,
                            .data = &asking};
    const SbStatus status = grid->answer(grid->data, figures + i * grid->figures, &ask);
    SbReport report = {0};
    (void)sb_fail(&report, status, "%s", sb_status_text(status));
    (void)sb_study_goes_on(work, status, &report);
    for (size_t k = i; k < i + count; k++) {
      work->budget.done += seen[k].work;
    }
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
    account(work, &seen[i], line[i], x[i]);
    memcpy(out, figures + i * grid->figures, grid->figures * sizeof *out);
    if (work->design->derive != NULL) {
      work->design->derive(out, work, line[i], x[i]);
    }
  }
  free(seen);
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
    sb_study_answer_rows(work, value, line, x, rows, from, to);
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
  const SbQuestion question = {.base = &work->base,
                               .override = override,
                               .override_count = overrides,
                               .figure = figure,
                               .figure_count = paths,
                               .work_used = used_of_part(work, 1),
                               .cancelled = work->hooks.cancelled,
                               .data = work->hooks.data};
  SbReport report;
  const SbStatus status = sb_evaluator_ask(value, work->evaluator, &question, &report);
  const SbSummary *summary = sb_evaluator_summary(work->evaluator);
  work->budget.done += summary != NULL ? summary->work : 0;
  if (status == SB_ERROR_CANCELLED || status == SB_ERROR_MEMORY) {
    (void)sb_study_goes_on(work, status, &report);
  }
  if (work->status != SB_OK) {
    return;
  }
  const Seen seen = look(status, &report, work->evaluator);
  account(work, &seen, -1, NAN);
  sb_study_step(work, fmin(work->spent / work->total, 1));
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

void sb_study_film_problem(SbFilmProblem *out, SbStudyWork *work, double load, double speed) {
  sb_sliding_film_problem(out, work->scene, SB_OUTER, (SbSealPressure){0, 0}, load, speed);
  out->cancelled = sb_work_step;
  out->cancelled_data = &work->budget;
}

SbStatus sb_study_film(SbStudyWork *work, const SbFilmProblem *problem, SbReport *report) {
  if (work->status != SB_OK) {
    return work->status;
  }
  SbStatus status = sb_film_solve(&work->film, problem, work->solver, report);
  SbReport cause;
  if (sb_work_status(&work->budget, status, &cause) != status) {
    status = sb_fail_input(
        report, cause.status, cause.input, "film (%s), outer seal, at %.4g N/m and %.4g mm/s: %s",
        sb_film_kind(problem->model)->name, problem->load, 1e3 * problem->speed, cause.text);
  }
  work->out->solves++;
  work->spent += SB_COST_FILM;
  if (status == SB_ERROR_CANCELLED || status == SB_ERROR_MEMORY) {
    (void)sb_study_goes_on(work, status, report);
  } else if (status == SB_OK) {
    const SbFilmSolverInfo *info = &work->film.solver;
    work->out->error = fmax(work->out->error, fmax(info->error_film_min, info->error_film_central));
  }
  sb_study_step(work, fmin(work->spent / work->total, 1));
  return status;
}
