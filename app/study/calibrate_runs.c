// Runs of the curves of a calibration, their residuals and the derivatives of these; see
// calibrate_private.h.
#include "app/study/calibrate_private.h"

#include <math.h>
#include <string.h>

typedef SbCalibrateCurve Curve;
typedef SbCalibrateWork Work;

// Force that is used if the values are infeasible or the run fails [N].
static const double no_force = 1000;

size_t sb_calibrate_overrides(SbOverride *out, const Work *work, const Curve *curve,
                              const double *z) {
  size_t count = 0;
  for (size_t i = 0; i < curve->sets; i++) {
    out[count++] = curve->set[i];
  }
  for (size_t k = 0; k < work->study->vary->len; k++) {
    out[count++] = (SbOverride){sb_calibrate_vary(work, k)->id,
                                sb_calibrate_value(work, curve->at[k], z[curve->at[k]])};
  }
  return count;
}

static bool is_cancelled(void *data) {
  const Work *work = data;
  return !work->ending && work->hooks->cancelled != NULL &&
         work->hooks->cancelled(work->hooks->data);
}

bool sb_calibrate_run_at(Work *work, Curve *curve, SbRun **run, const SbRun *base,
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

bool sb_calibrate_settle(Work *work, Curve *curve, const double *z) {
  if (curve->known && memcmp(curve->z, z, work->coordinates * sizeof *z) == 0) {
    return true;
  }
  SbOverride override[2 * SB_VARY_MAX];
  const size_t count = sb_calibrate_overrides(override, work, curve, z);
  curve->known = sb_calibrate_run_at(work, curve, &curve->run, NULL, override, count);
  memcpy(curve->z, z, work->coordinates * sizeof *z);
  return curve->known;
}

bool sb_calibrate_evaluate(void *data, double *residual, const double *z) {
  Work *work = data;
  for (size_t c = 0; c < work->curves; c++) {
    Curve *curve = &work->curve[c];
    curve->known = false; // the loop may be that of a step beside it
    if (!sb_calibrate_settle(work, curve, z)) {
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
  const size_t count = sb_calibrate_overrides(override, work, curve, z);
  const bool good = sb_calibrate_run_at(work, curve, &curve->beside, curve->run, override, count);
  if (work->status == SB_ERROR_NOT_CONVERGED) {
    (void)sb_loop_take(&curve->loop, curve->run);
  }
  residuals_of(residual, curve, z);
  return good;
}

bool sb_calibrate_differentiate(void *data, double *jacobian, const double *z,
                                const double *residual) {
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
    bool good = !work->rings || sb_calibrate_settle(work, curve, z);
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
        const size_t count = sb_calibrate_overrides(override, work, curve, moved);
        good = sb_calibrate_run_at(work, curve, &curve->beside, tangent ? curve->run : NULL,
                                   override, count);
        if (good && tangent && work->status == SB_ERROR_NOT_CONVERGED) {
          good = sb_calibrate_run_at(work, curve, &curve->beside, NULL, override,
                                     count); // no tangent there
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

bool sb_calibrate_differentiate_fit(void *data, double *jacobian, const double *z,
                                    const double *residual) {
  Work *work = data;
  work->full = true;
  const bool good = sb_calibrate_differentiate(data, jacobian, z, residual);
  work->full = false;
  return good;
}
