// Curves, their runs and what the samples say; see the header.
#include "app/study/calibrate_private.h"

#include "app/base/number.h"

#include "engine/numeric/sampling.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef SbCalibrateCurve Curve;
typedef SbCalibrateWork Work;

// Force that is used if the values are infeasible or the run fails [N].
static const double no_force = 1000;

static const SbVary *vary_of(const Work *work, size_t k) {
  return &g_array_index(work->study->vary, SbVary, k);
}

static double value_of(const Work *work, size_t coordinate, double z) {
  return sb_distribution_at_normal(&vary_of(work, work->vary[coordinate])->distribution, z);
}

// ---- Runs ----

// Overrides of a curve at z; their number.
static size_t overrides_at(SbOverride *out, const Work *work, const Curve *curve, const double *z) {
  size_t count = 0;
  for (size_t i = 0; i < curve->sets; i++) {
    out[count++] = curve->set[i];
  }
  for (size_t k = 0; k < work->study->vary->len; k++) {
    out[count++] =
        (SbOverride){vary_of(work, k)->id, value_of(work, curve->at[k], z[curve->at[k]])};
  }
  return count;
}

static bool is_cancelled(void *data) {
  const Work *work = data;
  return !work->ending && work->hooks->cancelled != NULL &&
         work->hooks->cancelled(work->hooks->data);
}

// Runs a curve's valve with overrides into `run`, which is created or replaced; if `base` is not
// NULL, the rings are linearised about those of `base`. The loop is empty if the values are
// infeasible. Returns false if cancelled or without memory.
static bool run_at(Work *work, Curve *curve, SbRun **run, const SbRun *base,
                   const SbOverride *override, size_t overrides) {
  const SbModel *model = NULL;
  SbModel *made = NULL;
  SbReport report = {0};
  g_autofree SbPlan *plan = g_new(SbPlan, 1);
  curve->loop.count[0] = curve->loop.count[1] = 0;
  SbStatus status = sb_model_derive(&made, work->study->base, override, overrides, &report);
  model = made;
  if (status == SB_OK) {
    const SbPlanWishes wishes = {.views = SB_VIEW_HYSTERESIS};
    sb_plan_wished(plan, model, &wishes);
    status = *run == NULL ? sb_run_create(run, model, plan, &report)
                          : sb_run_renew(*run, model, plan, &report);
  }
  if (status == SB_OK) {
    const SbRunHooks hooks = {
        .cancelled = is_cancelled, .data = work, .alone = work->hooks->jobs <= 1};
    if (base != NULL) {
      sb_run_predict_from(*run, base);
    } else {
      sb_run_start_from(*run, NULL);
    }
    if (work->rings && base == NULL) {
      sb_run_keep_rings(*run);
    }
    status = sb_run_execute(*run, &hooks, &report);
    if (work->rings && base == NULL) {
      sb_run_end_rings(*run);
    }
    if (status == SB_OK) {
      (void)sb_loop_take(&curve->loop, *run);
    }
  }
  sb_model_destroy(made);
  work->evaluations++;
  if (work->hooks->progress != NULL) {
    // How many runs a fit takes is not known: the fraction rises with each and reaches 1 at the
    // end.
    const double share = (double)work->evaluations / (double)work->expected;
    work->hooks->progress(work->hooks->data, 1 - exp(-2 * share));
  }
  work->status = status;
  work->report = report;
  return status != SB_ERROR_CANCELLED && status != SB_ERROR_MEMORY;
}

// Coordinate of the numerical error that a residual has; SIZE_MAX: none.
static size_t numeric_of(const Curve *curve, size_t row) {
  if (curve->numeric == SIZE_MAX || row >= curve->points) {
    return curve->numeric;
  }
  const SbMeasuredPoint *point = &curve->point[row];
  return curve->numeric + 2 * (size_t)point->way + (point->displacement > curve->edge[point->way]);
}

// Residuals of a curve from its loop; where the model does not slide, from no force at all.
static void residuals_of(double *residual, const Curve *curve, const double *z) {
  const double offset =
      curve->zero != SIZE_MAX ? z[curve->zero] * curve->measured->no_load_deviation : 0;
  for (size_t i = 0; i < curve->points; i++) {
    const SbMeasuredPoint *point = &curve->point[i];
    const double force = sb_loop_force(&curve->loop, point->way, point->displacement);
    const size_t count = curve->loop.count[point->way];
    // Beyond the model's ends its last force; nothing presses a stem that does not come back.
    const double model = !isnan(force)               ? force
                         : curve->loop.count[0] == 0 ? no_force
                         : count == 0                ? 0
                                                     : curve->loop.force[point->way][count - 1];
    residual[i] = point->force - offset - model;
  }
  if (curve->breakaway) {
    const double model = curve->loop.stage_force[SB_STAGE_B];
    residual[curve->points] = curve->measured->stage[SB_STAGE_B].force - offset -
                              (curve->loop.count[0] > 0 && isfinite(model) ? model : no_force);
  }
  for (size_t i = 0; i < curve->points + curve->breakaway && curve->numeric != SIZE_MAX; i++) {
    residual[i] -= curve->error * z[numeric_of(curve, i)];
  }
}

static bool settle_run(Work *work, Curve *curve, const double *z) {
  if (curve->known && memcmp(curve->z, z, work->coordinates * sizeof *z) == 0) {
    return true;
  }
  SbOverride override[2 * SB_VARY_MAX];
  const size_t count = overrides_at(override, work, curve, z);
  curve->known = run_at(work, curve, &curve->run, NULL, override, count);
  memcpy(curve->z, z, work->coordinates * sizeof *z);
  return curve->known;
}

bool sb_calibrate_evaluate(void *data, double *residual, const double *z) {
  Work *work = data;
  for (size_t c = 0; c < work->curves; c++) {
    Curve *curve = &work->curve[c];
    curve->known = false; // the loop may be that of a step beside it
    if (!settle_run(work, curve, z)) {
      return false;
    }
    residuals_of(residual + curve->first, curve, z);
  }
  return true;
}

// Whether a curve's loop depends on a coordinate.
static bool depends(const Work *work, const Curve *curve, size_t coordinate) {
  return coordinate < work->parameters && curve->at[work->vary[coordinate]] == coordinate;
}

// Derivative of a residual of the curve by what adds to the force alone.
static double added(const Curve *curve, size_t row, size_t coordinate) {
  return curve->zero == coordinate ? -curve->measured->no_load_deviation
         : curve->numeric != SIZE_MAX && numeric_of(curve, row) == coordinate ? -curve->error
                                                                              : 0;
}

// Differences: central ones of closed forms; where rings are solved, forward ones along their
// tangent for the fit, and central ones of full solves for the posterior (`full`), as the tangent
// fixes the places where a ring sticks, which have a history
// (engine/valve/answer/gradient_rings.c). A side that has no loop is replaced by the place itself.
// Writes the residuals that a tangent predicts of the base itself; false where it has no run.
static bool take_base(double *residual, Work *work, Curve *curve, const double *z) {
  // What is predicted of the base itself: differences of like with like.
  SbOverride override[2 * SB_VARY_MAX];
  const size_t count = overrides_at(override, work, curve, z);
  const bool good = run_at(work, curve, &curve->beside, curve->run, override, count);
  if (work->status == SB_ERROR_NOT_CONVERGED) {
    (void)sb_loop_take(&curve->loop, curve->run);
  }
  residuals_of(residual, curve, z);
  return good;
}

static bool differentiate(void *data, double *jacobian, const double *z, const double *residual) {
  Work *work = data;
  const size_t n = work->coordinates;
  const bool tangent = work->rings && !work->full;
  const double step = tangent ? 0.02 : work->rings ? 0.2 : 1e-3;
  double moved[SB_INFERENCE_COORDINATES];
  memcpy(moved, z, n * sizeof *z);
  for (size_t c = 0; c < work->curves; c++) {
    Curve *curve = &work->curve[c];
    const size_t rows = curve->points + curve->breakaway;
    double *side[2] = {g_new(double, rows + 1), g_new(double, rows + 1)};
    bool good = !work->rings || settle_run(work, curve, z);
    if (good && tangent) {
      good = take_base(side[0], work, curve, z);
    }
    for (size_t j = 0; j < n && good; j++) {
      for (size_t i = 0; i < rows && !depends(work, curve, j); i++) {
        jacobian[(curve->first + i) * n + j] = added(curve, i, j);
      }
      if (!depends(work, curve, j)) {
        continue;
      }
      bool loops[2] = {true, true};
      for (int s = tangent; s < 2 && good; s++) {
        SbOverride override[2 * SB_VARY_MAX];
        moved[j] = z[j] + (s == 0 ? -step : step);
        const size_t count = overrides_at(override, work, curve, moved);
        good = run_at(work, curve, &curve->beside, tangent ? curve->run : NULL, override, count);
        if (good && tangent && work->status == SB_ERROR_NOT_CONVERGED) {
          good = run_at(work, curve, &curve->beside, NULL, override, count); // no tangent there
        }
        residuals_of(side[s], curve, moved);
        loops[s] = curve->loop.count[0] > 0;
        if (!loops[s]) {
          memcpy(side[s], tangent ? side[0] : residual + curve->first, rows * sizeof *residual);
        }
      }
      moved[j] = z[j];
      const double width = tangent || !loops[0] || !loops[1] ? step : 2 * step;
      for (size_t i = 0; i < rows; i++) {
        jacobian[(curve->first + i) * n + j] = (side[1][i] - side[0][i]) / width;
      }
    }
    curve->known = curve->known && work->rings; // the loop is another's, the run is not
    g_free(side[0]);
    g_free(side[1]);
    if (!good) {
      return false;
    }
    if (work->rings) {
      (void)sb_loop_take(&curve->loop, curve->run);
    }
  }
  return true;
}

static bool differentiate_fit(void *data, double *jacobian, const double *z,
                              const double *residual) {
  Work *work = data;
  work->full = true;
  const bool good = differentiate(data, jacobian, z, residual);
  work->full = false;
  return good;
}

// ---- What the file says ----

static bool has_word(const char *list, const char *word) {
  g_auto(GStrv) words = g_strsplit_set(list != NULL ? list : "", ",;", -1);
  for (char **one = words; *one != NULL; one++) {
    if (strcmp(g_strstrip(*one), word) == 0) {
      return true;
    }
  }
  return false;
}

static bool read_set(Curve *curve, GPtrArray *issues) {
  const char *text = curve->data->text[SB_DATA_SET];
  g_auto(GStrv) words = g_strsplit(text != NULL ? text : "", ";", -1);
  for (char **word = words; *word != NULL; word++) {
    if (*g_strstrip(*word) == '\0') {
      continue;
    }
    g_auto(GStrv) parts = g_strsplit(*word, "=", 2);
    const int id = sb_param_find(g_strstrip(parts[0]));
    double value = 0;
    g_autoptr(GError) error = NULL;
    if (id < 0 || parts[1] == NULL || curve->sets == SB_VARY_MAX) {
      sb_data_add_issue(curve->data, SB_DATA_SET, "KEY=VALUE; KEY=VALUE", issues,
                        "\"%s\" sets no parameter", *word);
      return false;
    }
    if (!sb_param_parse(&value, (SbParamId)id, g_strstrip(parts[1]), &error)) {
      sb_data_add_issue(curve->data, SB_DATA_SET, NULL, issues, "%s: %s", parts[0], error->message);
      return false;
    }
    curve->set[curve->sets++] = (SbOverride){(SbParamId)id, value};
  }
  return true;
}

static double set_value(const Curve *curve, const Work *work, SbParamId id) {
  for (size_t i = 0; i < curve->sets; i++) {
    if (curve->set[i].id == id) {
      return curve->set[i].value;
    }
  }
  return sb_model_value(work->study->base, id);
}

// Which actuation of the valve the cycle in use is, as life.first_actuation of its runs.
static bool read_actuation(Curve *curve, GPtrArray *issues) {
  const char *text = curve->data->text[SB_DATA_ACTUATION];
  const SbMeasured *m = curve->measured;
  const double most = sb_param(SB_P_LIFE_FIRST_ACTUATION)->max;
  double first = 0;
  if (text == NULL) {
    return true;
  }
  if (!sb_number_parse(&first, text) || first != floor(first) || first < 1 ||
      !(first + (double)m->first <= most)) {
    g_autofree char *allowed = g_strdup_printf("1 to %.0f", most);
    sb_data_add_issue(curve->data, SB_DATA_ACTUATION, allowed, issues,
                      "\"%s\" is not a number of an actuation since new", text);
    return false;
  }
  if (m->first != m->last) {
    sb_data_add_issue(
        curve->data, SB_DATA_CYCLE, NULL, issues,
        "treats %zu cycles as one, but each is an actuation of its own: name some, as "
        "in cycle = 1, 10, %u",
        m->last - m->first + 1, m->cycle->len);
    return false;
  }
  if (curve->sets == SB_VARY_MAX) {
    sb_data_add_issue(curve->data, SB_DATA_SET, NULL, issues, "sets more than %d parameters",
                      SB_VARY_MAX - 1);
    return false;
  }
  curve->set[curve->sets++] = (SbOverride){SB_P_LIFE_FIRST_ACTUATION, first + (double)m->first};
  return true;
}

static bool read_curve(Curve *curve, const Work *work, GPtrArray *issues) {
  bool ratio = false;
  for (size_t k = 0; k < work->study->vary->len; k++) {
    ratio |= vary_of(work, k)->id == SB_P_FRICTION_STATIC_RATIO;
  }
  if (!read_set(curve, issues)) {
    return false;
  }
  const double speed = sb_measured_speed(set_value(curve, work, SB_P_DRIVE_KIND),
                                         set_value(curve, work, SB_P_DRIVE_SPEED));
  curve->measured = sb_measured_load(curve->data, speed, issues);
  if (curve->measured == NULL || !read_actuation(curve, issues)) {
    return false;
  }
  curve->point = sb_measured_points(&curve->points, curve->measured, SB_CALIBRATION_POINTS);
  curve->breakaway = ratio && curve->measured->stage[SB_STAGE_B].found;
  if (curve->points < 10) {
    sb_data_add_issue(curve->data, SB_DATA_FILE, "at least 10", issues,
                      "has %zu rows of a sliding stem", curve->points);
    return false;
  }
  if (ratio && !curve->breakaway) {
    sb_data_add_issue(curve->data, SB_DATA_FILE, NULL, issues,
                      "has no break-away to fit friction.static_ratio to: %s",
                      curve->measured->stage[SB_STAGE_B].reason);
    return false;
  }
  return true;
}

static bool check_vary(const Work *work, GPtrArray *issues) {
  for (size_t k = 0; k < work->study->vary->len; k++) {
    const SbVary *vary = vary_of(work, k);
    const bool real = vary->id != SB_VARY_VARIABLE && sb_param(vary->id)->kind == SB_PARAM_REAL;
    if (!real || vary->by != NULL || vary->distribution.kind == SB_DISTRIBUTION_LEVELS) {
      g_autofree char *key = g_strconcat("vary.", sb_vary_name(vary), NULL);
      sb_issues_add(issues, work->study->path, vary->line, key, "uniform, loguniform, normal",
                    "has no prior: bounds or a distribution of a real parameter");
      return false;
    }
  }
  return true;
}

// The coordinate of the zero that an earlier curve has from the same rows of its file; SIZE_MAX:
// there is none.
static size_t zero_before(const Work *work, size_t c) {
  const Curve *curve = &work->curve[c];
  for (size_t k = 0; k < c; k++) {
    const SbMeasured *one = work->curve[k].measured;
    if (strcmp(work->curve[k].data->path, curve->data->path) == 0 &&
        one->no_load_row == curve->measured->no_load_row) {
      return work->curve[k].zero;
    }
  }
  return SIZE_MAX;
}

// Gives every coordinate its place; false with an issue.
static bool lay_out(Work *work, GPtrArray *issues) {
  const size_t varied = work->study->vary->len;
  size_t shared[SB_VARY_MAX];
  for (size_t k = 0; k < varied; k++) {
    shared[k] = SIZE_MAX;
  }
  for (size_t c = 0; c < work->curves; c++) {
    Curve *curve = &work->curve[c];
    for (size_t k = 0; k < varied; k++) {
      const bool own = has_word(curve->data->text[SB_DATA_OWN], sb_vary_name(vary_of(work, k)));
      if (own || shared[k] == SIZE_MAX) {
        if (work->coordinates + (1 + SB_CALIBRATE_NUMERIC) * work->curves >=
            SB_INFERENCE_COORDINATES) {
          sb_data_add_issue(curve->data, SB_DATA_OWN, NULL, issues,
                            "there are more than the %d parameters that can be fitted",
                            SB_INFERENCE_COORDINATES);
          return false;
        }
        work->vary[work->coordinates] = k;
        work->owner[work->coordinates] = own ? (int)c : -1;
        curve->at[k] = work->coordinates++;
        shared[k] = own ? shared[k] : curve->at[k];
      } else {
        curve->at[k] = shared[k];
      }
    }
  }
  work->parameters = work->coordinates;
  for (size_t c = 0; c < work->curves; c++) {
    Curve *curve = &work->curve[c];
    curve->zero = SIZE_MAX;
    if (curve->measured->no_load_deviation > 0) {
      const size_t before = zero_before(work, c);
      curve->zero = before != SIZE_MAX ? before : work->coordinates++;
    }
    curve->numeric = SIZE_MAX;
    if (work->tangent) {
      curve->numeric = work->coordinates;
      work->coordinates += SB_CALIBRATE_NUMERIC;
    }
    curve->first = work->residuals;
    work->residuals += curve->points + curve->breakaway;
  }
  return true;
}

// Standard normal variate of a value under its prior; 0 where it lies outside.
static double variate_of(const SbDistribution *of, double value) {
  if (of->kind == SB_DISTRIBUTION_NORMAL) {
    return fmin(fmax((value - of->a) / of->b, -3), 3);
  }
  const double p = of->kind == SB_DISTRIBUTION_UNIFORM ? (value - of->a) / (of->b - of->a)
                                                       : log(value / of->a) / log(of->b / of->a);
  return p > 0.001 && p < 0.999 ? sb_normal_quantile(p) : 0;
}

// ---- What the samples say ----

static void keep_samples(SbCalibration *out, const Work *work, const SbInference *found) {
  const size_t p = work->parameters, count = found->samples;
  out->sample = g_new(double, count *p + 1);
  out->samples = count;
  for (size_t i = 0; i < count; i++) {
    for (size_t j = 0; j < p; j++) {
      out->sample[i * p + j] = value_of(work, j, found->sample[i * work->coordinates + j]);
    }
  }
  for (size_t j = 0; j < p; j++) {
    const SbDistribution *prior = &vary_of(work, work->vary[j])->distribution;
    out->parameter[j].estimate = value_of(work, j, found->z[j]);
    out->parameter[j].distribution = *prior;
    out->parameter[j].prior[0] = sb_distribution_quantile(prior, 0.025);
    out->parameter[j].prior[1] = sb_distribution_quantile(prior, 0.975);
  }
}

// Runs at the scene's values and at the fit; false: cancelled.
static bool compare_curves(SbCalibration *out, Work *work, const SbInference *found) {
  double square = 0, rows = 0, noise = 0;
  for (size_t c = 0; c < work->curves; c++) {
    Curve *curve = &work->curve[c];
    SbCalibratedCurve *to = &out->curve[c];
    if (!run_at(work, curve, &curve->beside, NULL, curve->set, curve->sets)) {
      return false;
    }
    SbComparison *before = sb_comparison_create(curve->measured, &curve->loop);
    to->before_rms = before->rms;
    sb_comparison_free(before);
    to->before_loop = curve->loop;
    curve->loop = (SbLoop){0};
    to->value = g_new(SbOverride, 2 * SB_VARY_MAX);
    to->values = overrides_at(to->value, work, curve, found->z);
    if (!run_at(work, curve, &curve->beside, NULL, to->value, to->values)) {
      return false;
    }
    if (out->warnings == NULL) {
      out->warnings = g_new0(SbWarnings, 1);
    }
    sb_warnings_merge(out->warnings, &sb_run_summary(curve->beside)->warnings);
    to->offset =
        curve->zero != SIZE_MAX ? found->z[curve->zero] * curve->measured->no_load_deviation : 0;
    to->noise = found->sigma[c];
    to->spread = found->spread[c];
    to->after =
        curve->loop.count[0] > 1 ? sb_comparison_create(curve->measured, &curve->loop) : NULL;
    to->after_loop = curve->loop;
    curve->loop = (SbLoop){0};
    out->points += curve->points;
    for (size_t i = 0; i < curve->points; i++) {
      const double r = found->residual[curve->first + i], weight = curve->point[i].weight;
      square += weight * r * r;
      rows += weight;
      noise += weight * r * r / pow(curve->measured->noise, 2);
    }
    to->name = g_strdup(*curve->data->name != '\0' ? curve->data->name : curve->measured->name);
    to->measured = g_steal_pointer(&curve->measured);
  }
  out->rms = sqrt(square / rows);
  out->chi2 = noise / fmax((double)out->points - (double)work->coordinates, 1);
  return true;
}

// ---- All of it ----

// Whether the scene's own values run: there is nothing to begin from otherwise.
static SbStatus check_start(Work *work, const double *start, SbReport *report) {
  for (size_t c = 0; c < work->curves; c++) {
    Curve *curve = &work->curve[c];
    (void)settle_run(work, curve, start);
    if (work->status == SB_OK && curve->loop.count[0] < 2) {
      return sb_fail(report, SB_ERROR_INPUT, "the stem does not slide in the scene as it is");
    }
    for (int way = 0; way < 2; way++) {
      const SbStage stage = way == 0 ? SB_STAGE_C : SB_STAGE_F;
      const SbMeasuredStage *seen = &curve->measured->stage[stage];
      const double model = curve->loop.stage_displacement[stage];
      curve->edge[way] = seen->found ? seen->displacement : isfinite(model) ? model : INFINITY;
    }
    const double relative = sb_run_summary(curve->run)->error_force;
    curve->error = isfinite(relative) ? relative * curve->loop.stage_force[SB_STAGE_B] : 0;
    if (work->status != SB_OK) {
      if (report != NULL) {
        *report = work->report;
      }
      return work->status;
    }
  }
  return SB_OK;
}

// What an interrupted fit has: the best place so far, without a posterior, and its loops.
static void take_best(SbCalibration *out, Work *work, SbInference *found) {
  work->ending = true;
  found->samples = 0;
  keep_samples(out, work, found);
  sb_calibration_identify(out);
  out->partial =
      sb_calibrate_evaluate(work, found->residual, found->z) && compare_curves(out, work, found);
}

// Writes the group of noise and the weight of each residual, and the variates to start from.
static void group_residuals(const Work *work, uint8_t *group, double *weight, double *start) {
  for (size_t c = 0; c < work->curves; c++) {
    const Curve *curve = &work->curve[c];
    for (size_t i = 0; i < curve->points; i++) {
      group[curve->first + i] = (uint8_t)c;
      weight[curve->first + i] = curve->point[i].weight;
    }
    if (curve->breakaway) {
      group[curve->first + curve->points] = SB_NOISE_KNOWN;
      weight[curve->first + curve->points] =
          1 / fmax(pow(curve->measured->stage[SB_STAGE_B].deviation, 2), 1e-12);
    }
  }
  for (size_t j = 0; j < work->parameters; j++) {
    const SbVary *vary = vary_of(work, work->vary[j]);
    start[j] = variate_of(&vary->distribution, sb_model_value(work->study->base, vary->id));
  }
}

static SbStatus infer(SbCalibration *out, Work *work, SbReport *report) {
  const size_t n = work->coordinates, m = work->residuals;
  g_autofree uint8_t *group = g_new(uint8_t, m);
  g_autofree double *weight = g_new(double, m);
  double start[SB_INFERENCE_COORDINATES] = {0};
  group_residuals(work, group, weight, start);
  SbStatus status = check_start(work, start, report);
  if (status != SB_OK) {
    return status;
  }
  const SbInferenceAsked asked = {.coordinates = n,
                                  .residuals = m,
                                  .groups = work->curves,
                                  .group = group,
                                  .weight = weight,
                                  .start = start,
                                  .evaluate = sb_calibrate_evaluate,
                                  .differentiate = differentiate,
                                  .differentiate_fit = work->rings ? differentiate_fit : NULL,
                                  .data = work,
                                  .seed = work->study->seed,
                                  .samples = work->study->samples > 0 ? work->study->samples
                                                                      : SB_CALIBRATION_SAMPLES,
                                  .linear = out->tangent};
  const double each = out->tangent ? 0 : 1.25;
  work->expected = work->curves * (size_t)(each * (double)asked.samples + 20 * (double)n + 40);
  SbInference found;
  status = sb_inference(&found, &asked, report);
  out->check_rms = NAN;
  if (status == SB_OK || status == SB_ERROR_NOT_CONVERGED) {
    out->converged = found.converged;
    out->accepted = found.accepted;
    keep_samples(out, work, &found);
    sb_calibration_identify(out);
    // Priors of what is solved hold valves that no ring fits into, and take long.
    const bool runs = (out->tangent || sb_calibrate_draws(out, work, &found, true)) &&
                      (found.samples == 0 || sb_calibrate_draws(out, work, &found, false));
    const bool stopped = !runs && work->status == SB_ERROR_CANCELLED;
    work->ending |= stopped;
    if ((!runs && !stopped) || !compare_curves(out, work, &found)) {
      status = work->status;
    } else if (stopped) {
      out->partial = true;
      status = SB_ERROR_CANCELLED;
    }
  } else if (status == SB_ERROR_CANCELLED) {
    status = work->status == SB_OK ? SB_ERROR_CANCELLED : work->status;
    if (status == SB_ERROR_CANCELLED) {
      take_best(out, work, &found);
    }
  }
  out->evaluations = work->evaluations;
  if (work->hooks->progress != NULL) {
    work->hooks->progress(work->hooks->data, 1);
  }
  sb_inference_release(&found);
  return status;
}

SbStatus sb_calibrate(SbCalibration *out, const SbStudyFile *study, const SbCalibrateHooks *hooks,
                      GPtrArray *issues, SbReport *report) {
  *out = (SbCalibration){.curves = study->data->len, .rms = NAN, .chi2 = NAN};
  Work work = {.study = study, .hooks = hooks, .curves = study->data->len};
  work.curve = g_new0(Curve, work.curves);
  out->curve = g_new0(SbCalibratedCurve, work.curves);
  bool good = check_vary(&work, issues);
  for (size_t c = 0; c < work.curves && good; c++) {
    work.curve[c].data = study->data->pdata[c];
    good = read_curve(&work.curve[c], &work, issues);
  }
  SbStatus status = SB_ERROR_INPUT;
  g_autofree SbPlan *plan = g_new(SbPlan, 1);
  const SbPlanWishes wishes = {.views = SB_VIEW_HYSTERESIS};
  sb_plan_wished(plan, study->base, &wishes);
  work.rings = plan->ring;
  work.tangent = out->tangent = sb_plan_cost(plan) > 0.02;
  if (good && lay_out(&work, issues)) {
    out->parameters = work.parameters;
    out->parameter = g_new0(SbCalibrated, work.parameters);
    for (size_t j = 0; j < work.parameters; j++) {
      SbCalibrated *of = &out->parameter[j];
      const SbData *owner = work.owner[j] >= 0 ? work.curve[work.owner[j]].data : NULL;
      of->id = vary_of(&work, work.vary[j])->id;
      of->curve = work.owner[j];
      of->before = sb_model_value(study->base, of->id);
      of->name = owner != NULL ? g_strdup_printf("%s@%s", sb_param(of->id)->key, owner->name)
                               : g_strdup(sb_param(of->id)->key);
    }
    status = infer(out, &work, report);
  }
  for (size_t c = 0; c < work.curves; c++) {
    Curve *curve = &work.curve[c];
    sb_measured_free(curve->measured);
    g_free(curve->point);
    sb_run_destroy(curve->beside);
    sb_run_destroy(curve->run);
    sb_loop_clear(&curve->loop);
  }
  g_free(work.curve);
  return status;
}

void sb_calibration_release(SbCalibration *out) {
  for (size_t j = 0; j < out->parameters; j++) {
    g_free(out->parameter[j].name);
  }
  for (size_t c = 0; c < out->curves; c++) {
    g_free(out->curve[c].name);
    g_free(out->curve[c].value);
    sb_comparison_free(out->curve[c].after);
    sb_loop_clear(&out->curve[c].before_loop);
    sb_loop_clear(&out->curve[c].after_loop);
    sb_measured_free(out->curve[c].measured);
  }
  g_free(out->parameter);
  g_free(out->curve);
  g_free(out->correlation);
  g_free(out->sample);
  g_free(out->sentence);
  g_free(out->warnings);
  *out = (SbCalibration){0};
}
