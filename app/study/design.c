// The best design within limits; see the header.
#include "app/study/design_private.h"

#include "app/base/device.h"
#include "app/study/slopes.h"

#include <math.h>
#include <nlopt.h>
#include <stdlib.h>
#include <string.h>

// Of a breach's scale: what is active.
#define ACTIVE 1e-5

// A thread's look at the problem.
typedef struct {
  const Problem *problem;
  SbEvaluator *evaluator;
  SbReport *report;
  nlopt_opt nlopt;
  bool minimax; // the last variable is a bound of all breaches, and is minimised
  bool known, sloped;
  double v[SB_VARY_MAX]; // where value and slope were asked for last
  double value[FIGURES_MAX];
  double *slope; // [figures][free], by the variables
  Start *best;   // feasible places with the least objective; NULL: not kept
  size_t evaluations;
  SbStatus status;
} View;

// ---- Figures of the variables ----

static const SbDistribution *bounds_of(const Problem *problem, size_t k) {
  return &g_array_index(problem->study->vary, SbVary, k).distribution;
}

static void to_values(double *x, const Problem *problem, const double *v) {
  size_t j = 0;
  for (size_t k = 0; k < problem->n; k++) {
    const double share = problem->fixed[k] ? 0.5 : fmin(fmax(v[j], 0), 1);
    x[k] = sb_distribution_quantile(bounds_of(problem, k), share);
    j += !problem->fixed[k];
  }
}

static double slope_of_value(const Problem *problem, size_t k, double x) {
  const SbDistribution *of = bounds_of(problem, k);
  return of->kind == SB_DISTRIBUTION_LOGUNIFORM ? x * log(of->b / of->a) : of->b - of->a;
}

static bool has_values(const View *view) {
  for (size_t i = 0; i < view->problem->figures; i++) {
    if (!isfinite(view->value[i])) {
      return false;
    }
  }
  return true;
}

static double breach_of(const View *view, size_t side) {
  const Side *of = &view->problem->side[side];
  const double figure = view->value[of->column];
  const double beyond = of->upper ? figure - of->bound : of->bound - figure;
  return (beyond + of->shift) / of->scale + BREACH_NONE;
}

static double worst_breach(const View *view) {
  double worst = -INFINITY;
  for (size_t i = 0; i < view->problem->sides; i++) {
    worst = fmax(worst, breach_of(view, i));
  }
  return worst;
}

static double objective_of(const View *view) {
  return view->problem->sign * view->value[0] / view->problem->scale;
}

static bool solved(const SbModel *model) {
  return sb_model_fit(model)->section || !sb_device(model)->gland;
}

// The slope of a figure that has none here is that of a chord. A kink of a closed form is bridged
// by a small step. Where the figure's own slope is withheld because its value scatters with the
// mesh (solved rings and gaskets) the step must move the figure by more than that scatter: 5 % of
// the range.
static void chord(View *view, const SbSlopesAsked *asked, size_t j) {
  const double step = solved(view->problem->study->base) ? 0.05 : 1e-4;
  double end[2][FIGURES_MAX], x[SB_VARY_MAX], v[SB_VARY_MAX], place[2];
  memcpy(v, view->v, sizeof v);
  for (int side = 0; view->status == SB_OK && side < 2; side++) {
    v[j] = place[side] = fmin(fmax(view->v[j] + (side == 0 ? -step : step), 0), 1);
    to_values(x, view->problem, v);
    view->status = sb_slopes(end[side], NULL, view->evaluator, asked, x, view->report);
  }
  for (size_t i = 0; view->status == SB_OK && i < view->problem->figures; i++) {
    double *slope = &view->slope[i * view->problem->free + j];
    const double chord = (end[1][i] - end[0][i]) / (place[1] - place[0]);
    *slope = isfinite(*slope) ? *slope : isfinite(chord) ? chord : 0;
  }
}

// Makes the view that of `v`; false with an error, which stops NLopt.
// Notes the point `v` if it is the best so far without a breach.
static void note_best(View *view, const double *v) {
  Start *best = view->best;
  if (best != NULL && has_values(view) && worst_breach(view) <= BREACH_NONE &&
      objective_of(view) < best->objective) {
    memcpy(best->v, v, view->problem->free * sizeof *v);
    best->objective = objective_of(view);
    best->breach = worst_breach(view);
    // No breach is left, which is all that was wanted.
    if (view->minimax && view->nlopt != NULL) {
      nlopt_force_stop(view->nlopt);
    }
  }
}

static bool look(View *view, const double *v, bool sloped) {
  const Problem *problem = view->problem;
  const size_t bytes = problem->free * sizeof *v;
  if (view->status != SB_OK) {
    return false;
  }
  if (view->known && (view->sloped || !sloped) && memcmp(v, view->v, bytes) == 0) {
    return true;
  }
  double x[SB_VARY_MAX];
  memcpy(view->v, v, bytes);
  to_values(x, problem, v);
  const SbSlopesAsked asked = {.base = problem->study->base,
                               .parameter = problem->parameter,
                               .fixed = problem->fixed,
                               .parameters = problem->n,
                               .figure = problem->figure,
                               .figures = problem->figures,
                               .cancelled = problem->cancelled,
                               .data = problem->data};
  double *all = sloped ? malloc(problem->figures * problem->n * sizeof *all) : NULL;
  if (sloped && all == NULL) {
    view->status = sb_fail(view->report, SB_ERROR_MEMORY, "no memory for slopes");
  } else {
    view->status = sb_slopes(view->value, all, view->evaluator, &asked, x, view->report);
  }
  view->evaluations++;
  view->known = true;
  view->sloped = sloped;
  for (size_t j = 0; view->status == SB_OK && sloped && has_values(view) && j < problem->free;
       j++) {
    const size_t k = problem->at[j];
    bool kink = false;
    for (size_t i = 0; i < problem->figures; i++) {
      const double slope = all[i * problem->n + k] * slope_of_value(problem, k, x[k]);
      view->slope[i * problem->free + j] = slope;
      kink |= !isfinite(slope);
    }
    if (kink) {
      chord(view, &asked, j);
    }
  }
  free(all);
  if (view->status != SB_OK) {
    view->known = false;
    if (view->nlopt != NULL) {
      nlopt_force_stop(view->nlopt);
    }
    return false;
  }
  note_best(view, v);
  return true;
}

// ---- What NLopt calls ----

static double give_objective(unsigned n, const double *v, double *gradient, void *data) {
  View *view = data;
  const Problem *problem = view->problem;
  if (gradient != NULL) {
    memset(gradient, 0, n * sizeof *gradient);
  }
  if (view->minimax) {
    if (gradient != NULL) {
      gradient[n - 1] = 1;
    }
    return v[n - 1];
  }
  // A step to where there is no valve is too long.
  if (!look(view, v, gradient != NULL) || !has_values(view)) {
    return 1e6;
  }
  for (size_t j = 0; gradient != NULL && j < problem->free; j++) {
    gradient[j] = problem->sign * view->slope[j] / problem->scale;
  }
  return objective_of(view);
}

static void give_breaches(unsigned m, double *result, unsigned n, const double *v, double *gradient,
                          void *data) {
  View *view = data;
  const Problem *problem = view->problem;
  const bool good = look(view, v, gradient != NULL) && has_values(view);
  if (gradient != NULL) {
    memset(gradient, 0, m * n * sizeof *gradient);
  }
  for (size_t i = 0; i < m; i++) {
    const Side *side = &problem->side[i];
    result[i] = (good ? breach_of(view, i) : 1e3) - (view->minimax ? v[n - 1] : 0);
    for (size_t j = 0; gradient != NULL && good && j < problem->free; j++) {
      gradient[i * n + j] =
          (side->upper ? 1 : -1) * view->slope[side->column * problem->free + j] / side->scale;
    }
    if (gradient != NULL && view->minimax) {
      gradient[i * n + n - 1] = -1;
    }
  }
}

// SLSQP from v, which becomes where it ends; whether it stopped by its tolerances.
static bool descend(View *view, double *v, bool minimax) {
  enum { EVALUATIONS = 400 };
  const Problem *problem = view->problem;
  const unsigned n = (unsigned)(problem->free + minimax), m = (unsigned)problem->sides;
  double low[SB_VARY_MAX + 1] = {0}, high[SB_VARY_MAX + 1], tolerance[SIDES_MAX];
  nlopt_opt nlopt = nlopt_create(NLOPT_LD_SLSQP, n);
  if (nlopt == NULL) {
    view->status = sb_fail(view->report, SB_ERROR_MEMORY, "no memory for a search");
    return false;
  }
  for (size_t j = 0; j <= problem->free; j++) {
    high[j] = 1;
  }
  for (size_t i = 0; i < m; i++) {
    tolerance[i] = BREACH_NONE / 10;
  }
  if (minimax) {
    low[n - 1] = -1;
    high[n - 1] = INFINITY;
    nlopt_set_stopval(nlopt, 0);
  }
  view->nlopt = nlopt;
  view->minimax = minimax;
  nlopt_set_lower_bounds(nlopt, low);
  nlopt_set_upper_bounds(nlopt, high);
  nlopt_set_min_objective(nlopt, give_objective, view);
  if (m > 0) {
    nlopt_add_inequality_mconstraint(nlopt, m, give_breaches, view, tolerance);
  }
  nlopt_set_xtol_rel(nlopt, 1e-9);
  // The bound of all breaches may stay while their places move.
  nlopt_set_ftol_rel(nlopt, minimax ? 0 : 1e-12);
  nlopt_set_maxeval(nlopt, EVALUATIONS);
  double least;
  const nlopt_result result = nlopt_optimize(nlopt, v, &least);
  nlopt_destroy(nlopt);
  view->nlopt = NULL;
  view->minimax = false;
  return (result > 0 && result != NLOPT_MAXEVAL_REACHED) || result == NLOPT_ROUNDOFF_LIMITED;
}

// ---- Starts ----

typedef struct {
  const Problem *problem;
  Start *start;
} Starts;

static bool note_place(Start *start, View *view, const double *v) {
  if (!look(view, v, false) || !has_values(view)) {
    return false;
  }
  memcpy(start->v, v, view->problem->free * sizeof *v);
  start->objective = objective_of(view);
  start->breach = worst_breach(view);
  return true;
}

static SbStatus run_start(void *data, SbEvaluator *evaluator, size_t index, SbReport *report) {
  const Problem *problem = ((Starts *)data)->problem;
  Start *start = &((Starts *)data)->start[index];
  View view = {.problem = problem, .evaluator = evaluator, .report = report};
  double v[SB_VARY_MAX + 1];
  view.slope = malloc(problem->figures * problem->free * sizeof *view.slope);
  if (view.slope == NULL) {
    return sb_fail(report, SB_ERROR_MEMORY, "no memory for slopes");
  }
  memcpy(v, start->v, sizeof start->v);
  start->found = note_place(start, &view, v);
  if (start->found && start->breach > 0) {
    Start end = *start, clean = {.objective = INFINITY, .breach = INFINITY};
    v[problem->free] = start->breach;
    view.best = &clean;
    end.stopped = descend(&view, v, true);
    view.best = NULL;
    if (clean.breach <= BREACH_NONE) {
      memcpy(v, clean.v, sizeof clean.v);
    }
    if (note_place(&end, &view, v) && end.breach < start->breach) {
      *start = end;
    }
  }
  if (start->found && start->breach <= BREACH_NONE) {
    memcpy(v, start->v, sizeof start->v);
    view.best = start;
    start->stopped = descend(&view, v, false);
    view.best = NULL;
  }
  start->evaluations = view.evaluations;
  free(view.slope);
  return view.status;
}

// Whether one is the better: less objective without a breach, else less breach.
static bool is_better(const Start *one, const Start *other) {
  const bool clean = one->breach <= BREACH_NONE, other_clean = other->breach <= BREACH_NONE;
  if (one->found != other->found || !one->found) {
    return one->found && !other->found;
  }
  return clean != other_clean ? clean
         : clean              ? one->objective < other->objective
                              : one->breach < other->breach;
}

SbStatus sb_design_run_starts(Start *best, SbDesign *out, const Problem *problem, Start *start,
                              size_t count, int jobs, SbReport *report) {
  Starts starts = {problem, start};
  const SbStatus status = sb_tasks(run_start, &starts, count, jobs, report);
  *best = start[0];
  size_t feasible = 0;
  for (size_t i = 0; status == SB_OK && i < count; i++) {
    out->evaluations += start[i].evaluations;
    feasible += start[i].found && start[i].breach <= BREACH_NONE;
    if (is_better(&start[i], best)) {
      *best = start[i];
    }
  }
  out->starts_feasible = count == out->starts ? feasible : out->starts_feasible;
  return status;
}

SbStatus sb_design_make_starts(Start *start, const Problem *problem, SbReport *report) {
  const SbStudyFile *study = problem->study;
  const size_t count = study->design.starts, free_count = problem->free;
  double *point = malloc((count + 1) * free_count * sizeof *point);
  if (point == NULL) {
    return sb_fail(report, SB_ERROR_MEMORY, "no memory for %zu starts", count);
  }
  SbStatus status = SB_OK;
  if (free_count <= SB_SOBOL_DIMENSIONS) {
    status = sb_sample_sobol(point, count, free_count, study->seed, report);
  } else {
    sb_sample_random(point, count, free_count, study->seed);
  }
  bool inside = true;
  for (size_t j = 0; status == SB_OK && j < free_count; j++) {
    const size_t k = problem->at[j];
    const SbDistribution *of = bounds_of(problem, k);
    const double x = sb_model_value(study->base, problem->parameter[k]);
    for (size_t i = 0; i < count; i++) {
      start[i].v[j] = point[i * free_count + j];
    }
    inside &= x >= of->a && x <= of->b;
    point[j] = of->kind == SB_DISTRIBUTION_LOGUNIFORM ? log(x / of->a) / log(of->b / of->a)
                                                      : (x - of->a) / (of->b - of->a);
  }
  for (size_t j = 0; status == SB_OK && inside && j < free_count; j++) {
    start[0].v[j] = point[j];
  }
  free(point);
  return status;
}

// ---- The optimum ----

// Least length of g + sum of multipliers (>= 0) x the rows [rows][n], by Gauss and Seidel's method.
static double residual(double *g, const double *row, size_t rows, size_t n) {
  double multiplier[SIDES_MAX + 2 * SB_VARY_MAX] = {0}, square = 0;
  for (int sweep = 0; sweep < 2000; sweep++) {
    double moved = 0;
    for (size_t i = 0; i < rows; i++) {
      const double *a = row + i * n;
      double along = 0, length = 0;
      for (size_t j = 0; j < n; j++) {
        along += a[j] * g[j];
        length += a[j] * a[j];
      }
      const double next = length > 0 ? fmax(multiplier[i] - along / length, 0) : 0;
      for (size_t j = 0; j < n; j++) {
        g[j] += (next - multiplier[i]) * a[j];
      }
      moved = fmax(moved, fabs(next - multiplier[i]) * sqrt(length));
      multiplier[i] = next;
    }
    if (moved < 1e-14) {
      break;
    }
  }
  for (size_t j = 0; j < n; j++) {
    square += g[j] * g[j];
  }
  return sqrt(square);
}

// What is active at the view, and how far it is from an optimum.
static void judge(SbDesign *out, const View *view) {
  const Problem *problem = view->problem;
  const size_t n = problem->free;
  double *row = calloc((problem->sides + n) * n + 1, sizeof *row), gradient[SB_VARY_MAX];
  size_t rows = 0;
  double length = 0;
  const double least = fmax(out->breach, 0); // where nothing is feasible, what is missed most
  memset(out->limit_active, 0, sizeof out->limit_active);
  for (size_t i = 0; i < problem->sides; i++) {
    const Side *side = &problem->side[i];
    if (fabs(breach_of(view, i)) > ACTIVE && breach_of(view, i) < least - ACTIVE) {
      continue;
    }
    out->limit_active[2 * side->limit + side->upper] = true;
    for (size_t j = 0; row != NULL && j < n; j++) {
      row[rows * n + j] = (side->upper ? 1 : -1) * view->slope[side->column * n + j] / side->scale;
    }
    rows++;
  }
  for (size_t j = 0; j < n; j++) {
    const double v = view->v[j];
    const int end = v < 1e-7 ? -1 : v > 1 - 1e-7 ? 1 : 0;
    out->bound_active[problem->at[j]] = end;
    if (end != 0 && row != NULL) {
      row[rows++ * n + j] = end;
    }
    gradient[j] = problem->sign * view->slope[j] / problem->scale;
    length += gradient[j] * gradient[j];
  }
  const double rest = row != NULL ? residual(gradient, row, rows, n) : NAN;
  out->optimality = length > 0 ? rest / sqrt(length) : 0;
  free(row);
}

static void take_validity(SbDesign *out, const SbStudyFile *study, const SbEvaluator *evaluator) {
  const SbSummary *summary = sb_evaluator_summary(evaluator);
  for (guint i = 0; i < study->figures->len; i++) {
    const int figure = g_array_index(study->figures, int, i);
    out->error[i] = summary != NULL ? sb_figure_error(summary, figure) : NAN;
    g_free(out->reason[i]);
    out->reason[i] =
        isfinite(out->figure[i]) ? NULL : g_strdup(sb_evaluator_reason(evaluator, figure));
  }
  g_free(out->warnings);
  out->warnings = summary != NULL ? g_memdup2(&summary->warnings, sizeof summary->warnings) : NULL;
}

SbStatus sb_design_take_optimum(SbDesign *out, const Problem *problem, const Start *best,
                                SbReport *report) {
  const SbStudyFile *study = problem->study;
  SbEvaluator *evaluator = NULL;
  View view = {.problem = problem, .report = report};
  view.slope = calloc(problem->figures * problem->free + 1, sizeof *view.slope);
  SbStatus status = view.slope != NULL ? sb_evaluator_create(&evaluator, report)
                                       : sb_fail(report, SB_ERROR_MEMORY, "no memory for slopes");
  view.evaluator = evaluator;
  to_values(out->value, problem, best->v);
  out->found = best->found;
  out->feasible = best->found && best->breach <= BREACH_NONE;
  out->breach = best->breach;
  if (status == SB_OK && look(&view, best->v, true) && has_values(&view)) {
    judge(out, &view);
    out->optimality = out->feasible ? out->optimality : NAN;
    out->converged = out->feasible ? out->optimality <= 1e-3 : best->stopped;
  }
  status = status == SB_OK ? view.status : status;
  if (status == SB_OK) {
    const SbSlopesAsked asked = {.base = study->base,
                                 .parameter = problem->parameter,
                                 .fixed = problem->fixed,
                                 .parameters = problem->n,
                                 .figure = (const int *)(const void *)study->figures->data,
                                 .figures = study->figures->len,
                                 .cancelled = problem->cancelled,
                                 .data = problem->data};
    status = sb_slopes(out->figure, NULL, evaluator, &asked, out->value, report);
    take_validity(out, study, evaluator);
  }
  sb_evaluator_destroy(evaluator);
  free(view.slope);
  return status;
}
