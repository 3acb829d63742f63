// Curves, their runs and what the samples say; see the header.
#include "app/study/calibrate_private.h"

#include "app/base/number.h"
#include "engine/numeric/sampling.h"

#include <math.h>
#include <stdlib.h>

typedef SbCalibrateCurve Curve;
typedef SbCalibrateWork Work;

const SbVary *sb_calibrate_vary(const Work *work, size_t k) {
  return &g_array_index(work->study->vary, SbVary, k);
}

double sb_calibrate_value(const Work *work, size_t coordinate, double z) {
  return sb_distribution_at_normal(&sb_calibrate_vary(work, work->vary[coordinate])->distribution,
                                   z);
}

// ---- What the samples say ----

static void keep_samples(SbCalibration *out, const Work *work, const SbInference *found) {
  const size_t p = work->parameters, count = found->samples;
  out->sample = g_new(double, count *p + 1);
  out->samples = count;
  for (size_t i = 0; i < count; i++) {
    for (size_t j = 0; j < p; j++) {
      out->sample[i * p + j] =
          sb_calibrate_value(work, j, found->sample[i * work->coordinates + j]);
    }
  }
  for (size_t j = 0; j < p; j++) {
    const SbDistribution *prior = &sb_calibrate_vary(work, work->vary[j])->distribution;
    out->parameter[j].estimate = sb_calibrate_value(work, j, found->z[j]);
    out->parameter[j].distribution = *prior;
    out->parameter[j].prior[0] = sb_distribution_quantile(prior, 0.025);
    out->parameter[j].prior[1] = sb_distribution_quantile(prior, 0.975);
  }
}

// Replaces the fit, the mode of the posterior, by the medians of the samples: the mode of a skewed
// posterior, for example of one that ends where the stem stops returning, may be beyond its 97.5 %
// quantile. Returns false if the model was not evaluated there (work->status).
static bool take_medians(SbInference *found, Work *work) {
  const size_t n = work->coordinates, count = found->samples;
  g_autofree double *column = g_new(double, count + 1);
  for (size_t j = 0; j < n; j++) {
    for (size_t i = 0; i < count; i++) {
      column[i] = found->sample[i * n + j];
    }
    qsort(column, count, sizeof *column, sb_number_compare);
    found->z[j] = column[count / 2];
  }
  return sb_calibrate_evaluate(work, found->residual, found->z);
}

// Runs at the scene's values and at the fit; false: cancelled.
static bool compare_curves(SbCalibration *out, Work *work, const SbInference *found) {
  double square = 0, rows = 0, noise = 0;
  for (size_t c = 0; c < work->curves; c++) {
    Curve *curve = &work->curve[c];
    SbCalibratedCurve *to = &out->curve[c];
    if (!sb_calibrate_run_at(work, curve, &curve->beside, NULL, curve->set, curve->sets)) {
      return false;
    }
    SbComparison *before = sb_comparison_create(curve->measured, &curve->loop);
    to->before_rms = before->rms;
    sb_comparison_free(before);
    to->before_loop = curve->loop;
    curve->loop = (SbLoop){0};
    to->value = g_new(SbOverride, 2 * SB_VARY_MAX);
    to->values = sb_calibrate_overrides(to->value, work, curve, found->z);
    if (!sb_calibrate_run_at(work, curve, &curve->beside, NULL, to->value, to->values)) {
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
    (void)sb_calibrate_settle(work, curve, start);
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
    const SbVary *vary = sb_calibrate_vary(work, work->vary[j]);
    start[j] =
        sb_calibrate_variate(&vary->distribution, sb_model_value(work->study->base, vary->id));
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
  const SbInferenceAsked asked = {
      .coordinates = n,
      .residuals = m,
      .groups = work->curves,
      .group = group,
      .weight = weight,
      .start = start,
      .evaluate = sb_calibrate_evaluate,
      .differentiate = sb_calibrate_differentiate,
      .differentiate_fit = work->rings ? sb_calibrate_differentiate_fit : NULL,
      .data = work,
      .seed = work->study->seed,
      .samples = work->study->samples > 0 ? work->study->samples : SB_CALIBRATION_SAMPLES,
      .linear = out->tangent};
  const double each = out->tangent ? 0 : 1.25;
  work->expected = work->curves * (size_t)(each * (double)asked.samples + 20 * (double)n + 40);
  SbInference found;
  status = sb_inference(&found, &asked, report);
  out->check_rms = NAN;
  if (status == SB_OK || status == SB_ERROR_NOT_CONVERGED) {
    out->converged = found.converged;
    out->accepted = found.accepted;
    // Samples of the tangent are normal about the fit: it is their median.
    const bool placed = out->tangent || found.samples == 0 || take_medians(&found, work);
    keep_samples(out, work, &found);
    sb_calibration_identify(out);
    // Priors of what is solved hold valves that no ring fits into, and take long.
    const bool runs = placed && (out->tangent || sb_calibrate_draws(out, work, &found, true)) &&
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

// Begins the work on a study: reads its priors and all of its curves. Returns false with issues.
// Ended by end_work() in any case.
static bool begin_work(Work *work, const SbStudyFile *study, const SbCalibrateHooks *hooks,
                       GPtrArray *issues) {
  *work = (Work){.study = study, .hooks = hooks, .curves = study->data->len};
  work->curve = g_new0(Curve, work->curves);
  g_autofree SbPlan *plan = g_new(SbPlan, 1);
  const SbPlanWishes wishes = {.views = SB_VIEW_HYSTERESIS};
  sb_plan_wished(plan, study->base, &wishes);
  work->rings = plan->ring;
  work->tangent = sb_plan_cost(plan) > 0.02;
  bool good = sb_calibrate_check_vary(work, issues);
  for (size_t c = 0; c < work->curves; c++) {
    work->curve[c].data = study->data->pdata[c];
    good = sb_calibrate_read_curve(&work->curve[c], work, issues) && good;
  }
  return good && sb_calibrate_lay_out(work, issues);
}

static void end_work(Work *work) {
  for (size_t c = 0; c < work->curves; c++) {
    Curve *curve = &work->curve[c];
    sb_measured_free(curve->measured);
    g_free(curve->point);
    sb_run_destroy(curve->beside);
    sb_run_destroy(curve->run);
    sb_loop_clear(&curve->loop);
  }
  g_free(work->curve);
}

void sb_calibrate_check(const SbStudyFile *study, GPtrArray *issues) {
  Work work;
  (void)begin_work(&work, study, NULL, issues);
  end_work(&work);
}

SbStatus sb_calibrate(SbCalibration *out, const SbStudyFile *study, const SbCalibrateHooks *hooks,
                      GPtrArray *issues, SbReport *report) {
  *out = (SbCalibration){.curves = study->data->len, .rms = NAN, .chi2 = NAN};
  out->curve = g_new0(SbCalibratedCurve, out->curves);
  SbStatus status = SB_ERROR_INPUT;
  Work work;
  if (begin_work(&work, study, hooks, issues)) {
    out->tangent = work.tangent;
    out->parameters = work.parameters;
    out->parameter = g_new0(SbCalibrated, work.parameters);
    for (size_t j = 0; j < work.parameters; j++) {
      SbCalibrated *of = &out->parameter[j];
      const SbData *owner = work.owner[j] >= 0 ? work.curve[work.owner[j]].data : NULL;
      of->id = sb_calibrate_vary(&work, work.vary[j])->id;
      of->curve = work.owner[j];
      of->before = sb_model_value(study->base, of->id);
      of->name = owner != NULL ? g_strdup_printf("%s@%s", sb_param(of->id)->key, owner->name)
                               : g_strdup(sb_param(of->id)->key);
    }
    status = infer(out, &work, report);
  }
  end_work(&work);
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
