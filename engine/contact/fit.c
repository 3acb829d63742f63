// One entrance to the contact models: checks the problem, derives the sizes that all models share
// (docs/results.md, Definitions), calls the model and fills the common result; see the header.
#include "engine/contact/fit.h"

#include <math.h>
#include <string.h>

#include "engine/base/check.h"
#include "engine/base/clock.h"
#include "engine/contact/closed_forms.h"
#include "engine/contact/fit_models.h"

// Typical estimates. At small tolerances the error of the positions of the contact's ends remains.
static double ring_load_error(double tolerance) {
  return fmax(0.3 * fmin(tolerance, 3e-3), 2.7e-4);
}

// Does not depend on the tolerance: its nodes are always a degree apart.
static double thesis_load_error(double tolerance) {
  return 4e-3;
}

static double disc_load_error(double tolerance) {
  return 0.01 * tolerance;
}

static double no_load_error(double tolerance) {
  return 0.0;
}

static const struct {
  SbFitKind kind; // name; section, body, points, fluid
  SbStatus (*solve)(SbFit *, const SbFitProblem *, SbReport *);
  double (*load_error)(double tolerance);
  const char *variant[8]; // up to the first NULL, in the order of their enumeration
} models[SB_FIT_MODEL_COUNT] = {
    [SB_FIT_KARASZKIEWICZ] = {{.name = "karaszkiewicz", .fluid = true},
                              sb_fit_closed,
                              no_load_error,
                              {"default"}},
    [SB_FIT_HERTZ] = {{.name = "hertz"}, sb_fit_closed, no_load_error, {"default"}},
    [SB_FIT_LINDLEY] = {{.name = "lindley"},
                        sb_fit_closed,
                        no_load_error,
                        {"extended", "initial", "simple-width", "kuran"}},
    [SB_FIT_GREEN_ENGLISH] = {{.name = "green-english"},
                              sb_fit_closed,
                              no_load_error,
                              {"radial-unrestrained", "plane-strain-unrestrained",
                               "axial-unrestrained-lubricated", "axial-unrestrained-unlubricated",
                               "axial-restrained", "radial-restrained", "plane-strain-restrained"}},
    [SB_FIT_DISC_THESIS] = {{.name = "disc-thesis", .points = true, .fluid = true},
                            sb_fit_disc,
                            thesis_load_error,
                            {"vertical", "radial", "projected"}},
    [SB_FIT_DISC] = {{.name = "disc", .body = true, .points = true, .fluid = true},
                     sb_fit_disc,
                     disc_load_error,
                     {"vertical", "radial", "vertical-both-flanks", "radial-both-flanks"}},
    [SB_FIT_RING] = {{.name = "ring", .section = true, .body = true, .points = true, .fluid = true},
                     sb_fit_ring,
                     ring_load_error,
                     {"default"}},
};

const SbFitKind *sb_fit_kind(SbFitModel model) {
  return (unsigned)model < SB_FIT_MODEL_COUNT ? &models[model].kind : NULL;
}

double sb_fit_load_error(SbFitModel model, double tolerance) {
  return models[model].load_error(tolerance);
}

bool sb_fit_model_from_name(SbFitModel *out, const char *name) {
  for (int i = 0; i < SB_FIT_MODEL_COUNT; i++) {
    if (strcmp(name, models[i].kind.name) == 0) {
      *out = (SbFitModel)i;
      return true;
    }
  }
  return false;
}

const char *sb_fit_variant_name(SbFitModel model, int variant) {
  if ((unsigned)model >= SB_FIT_MODEL_COUNT || variant < 0) {
    return NULL;
  }
  const char *const *names = models[model].variant;
  for (; *names != NULL && variant > 0; variant--) {
    names++;
  }
  return *names;
}

int sb_fit_variant_find(SbFitModel model, const char *name) {
  int i = 0;
  for (const char *own; (own = sb_fit_variant_name(model, i)) != NULL; i++) {
    if (strcmp(own, name) == 0) {
      return i;
    }
  }
  return strcmp(name, "default") == 0 ? 0 : -1;
}

// ---- input

static SbStatus check(const SbFitProblem *in, SbReport *report) {
  if ((unsigned)in->model >= SB_FIT_MODEL_COUNT ||
      sb_fit_variant_name(in->model, in->variant) == NULL) {
    return sb_fail_input(report, SB_ERROR_INPUT, SB_CONTACT_IN_MODEL,
                         "there is no contact model %d, variant %d", (int)in->model, in->variant);
  }
  SbStatus status = SB_CHECK(
      report,
      {SB_CONTACT_IN_SECTION_DIAMETER, "the section diameter [m]", in->section_diameter,
       SB_ABOVE_ZERO},
      {SB_CONTACT_IN_INNER_DIAMETER, "the inner diameter [m]", in->inner_diameter, SB_ABOVE_ZERO},
      {SB_CONTACT_IN_MODULUS, "the rubber's modulus [Pa]", in->modulus, SB_ABOVE_ZERO},
      {SB_CONTACT_IN_RADIAL_SPACE, "the radial space [m]", in->gasket ? 1.0 : in->radial_space,
       SB_ABOVE_ZERO},
      {SB_CONTACT_IN_GLAND_WIDTH, "the gland's width [m]", in->gland_width, SB_ABOVE_ZERO},
      {SB_CONTACT_IN_BORE_DIAMETER, "the bore's diameter [m]", in->bore_diameter, SB_ABOVE_ZERO},
      {SB_CONTACT_IN_POISSON_RATIO, "the rubber's Poisson's ratio", in->poisson_ratio, SB_POISSON},
      {SB_CONTACT_IN_MOONEY_SHARE, "the Mooney fraction", in->mooney_share, 0.0, 0.5},
      {SB_CONTACT_IN_HOUSING_MODULUS, "the housing's modulus [Pa]", in->housing_modulus, 0.0,
       INFINITY},
      {SB_CONTACT_IN_HOUSING_POISSON, "the housing's Poisson's ratio", in->housing_poisson, 0.0,
       0.5},
      {SB_CONTACT_IN_PRESSURE, "the pressure [Pa]", in->pressure, SB_FINITE},
      {SB_CONTACT_IN_DRAG, "the friction of the drag", in->drag, -SB_FIT_DRAG_MAX, SB_FIT_DRAG_MAX},
      {SB_CONTACT_IN_FLOOR_FRICTION, "the floor's friction", in->floor_friction, 0.0, 1.0},
      {SB_CONTACT_IN_WALL_FRICTION, "the walls' friction", in->wall_friction, 0.0, 1.0},
      {0, "the tolerance", in->tolerance, 0.0, 1.0 - DBL_EPSILON});
  if (status != SB_OK) {
    return status;
  }
  if (in->profile.kind != SB_SEAL_PROFILE_CIRCLE && !models[in->model].kind.section) {
    return sb_fail_input(
        report, SB_ERROR_INPUT, SB_CONTACT_IN_MODEL,
        "only the ring model supports a section that is not a circle (%s%s), not %s",
        in->names != NULL ? in->names->profile : "", sb_seal_profile_name(in->profile.kind),
        models[in->model].kind.name);
  }
  if (in->dragged && !models[in->model].kind.section) {
    return sb_fail_input(report, SB_ERROR_INPUT, SB_CONTACT_IN_MODEL,
                         "only the ring model computes a dragged ring, not %s",
                         models[in->model].kind.name);
  }
  if (!in->gasket && !(in->bore_diameter > 2.0 * in->radial_space)) {
    return sb_fail_input(report, SB_ERROR_INFEASIBLE, SB_CONTACT_IN_BORE_DIAMETER,
                         "bore %.4g mm leaves no stem inside a radial space of %.4g mm",
                         1e3 * in->bore_diameter, 1e3 * in->radial_space);
  }
  return SB_OK;
}

// ---- what all models share

static void fill_sizes(SbFit *out, const SbFitProblem *in) {
  const double d = in->section_diameter;
  const double g = in->radial_space;
  const double mean_free = in->inner_diameter + d;
  const double mean_fitted = in->bore_diameter - g;
  out->model = in->model;
  out->variant = in->variant;
  if (in->gasket) {
    out->squeeze = 1.0 - in->gland_width / in->profile.axial_height;
    out->stretch_inner = in->bore_diameter / in->inner_diameter - 1.0;
    out->interference = in->bore_diameter - in->inner_diameter;
    out->stretch_mean = out->section_diameter_fitted = out->gland_fill = NAN;
    return;
  }
  out->squeeze = (d - g) / d;
  out->stretch_mean = (mean_fitted - mean_free) / mean_free;
  out->stretch_inner = (in->bore_diameter - 2.0 * g - in->inner_diameter) / in->inner_diameter;
  out->section_diameter_fitted = d * (1.0 - in->poisson_ratio * out->stretch_mean);
  out->interference = out->section_diameter_fitted - g;
  double area, centroid;
  sb_seal_profile_area(&area, &centroid, &in->profile, d);
  out->gland_fill =
      area * d * d * (mean_free + 2.0 * centroid * d) / (g * mean_fitted * in->gland_width);
}

void sb_fit_contact(SbFit *out, double left, double right) {
  out->touches = true;
  out->contact_left = left;
  out->contact_right = right;
  out->contact_width = right - left;
  out->load = out->load_per_length * out->circumference;
  out->profile_count = SB_FIT_POINTS;
  for (size_t i = 0; i < SB_FIT_POINTS; i++) {
    const double t = sin(M_PI * ((double)i / (SB_FIT_POINTS - 1) - 0.5));
    out->profile_x[i] = 0.5 * ((1.0 - t) * left + (1.0 + t) * right);
  }
}

void sb_fit_errors(SbFit *out, double load, double peak, double width) {
  out->solver.error_estimate.load = load;
  out->solver.error_estimate.pressure_peak = peak;
  out->solver.error_estimate.contact_width = width;
}

// Closed forms and discs know the stretch on the groove floor as a shrunk section at most; the ring
// solves it. Without contact there is no figure to warn of.
static void judge_stretch(SbFit *out, const SbFitProblem *in) {
  const double unstretched = in->section_diameter - in->radial_space;
  const double moved = in->section_diameter - out->section_diameter_fitted;
  const SbFitKind *kind = &models[in->model].kind;
  if (kind->section || in->gasket || !out->touches ||
      !(fabs(moved) > SB_FIT_STRETCH_MAX * fabs(unstretched))) {
    return;
  }
  const bool round = kind->points || in->fitted_section;
  sb_warn(&out->warnings, "stretch-interference", SB_CONTACT_IN_INNER_DIAMETER,
          "stretch moves the interference from %.3g to %.3g mm (%+.3g %%): %s %s%s",
          1e3 * unstretched, 1e3 * out->interference, -100.0 * moved / fabs(unstretched),
          models[in->model].kind.name,
          round ? "requires a section that shrinks and remains round" : "ignores it",
          round || in->names == NULL ? "" : in->names->fitted);
}

bool sb_fit_ignores_walls(SbFitModel model, double gland_fill) {
  return !models[model].kind.section && gland_fill >= 1.0;
}

static void judge_walls(SbFit *out, const SbFitProblem *in) {
  if (!in->gasket && out->touches && sb_fit_ignores_walls(in->model, out->gland_fill)) {
    sb_warn(
        &out->warnings, "gland-overfilled", SB_CONTACT_IN_GLAND_WIDTH,
        "the ring overfills its groove (gland fill %.3g %%): %s does not include the walls, and "
        "its load is too small",
        100.0 * out->gland_fill, models[in->model].kind.name);
  }
}

SbStatus sb_fit_solve(SbFit *out, const SbFitProblem *problem, SbReport *report) {
  const double start = sb_clock_seconds();
  memset(out, 0, sizeof *out);
  SbStatus status = check(problem, report);
  if (status != SB_OK) {
    return status;
  }
  fill_sizes(out, problem);
  status = models[problem->model].solve(out, problem, report);
  judge_stretch(out, problem);
  judge_walls(out, problem);
  // A warning means that a model is outside its range, except that which states "no contact".
  out->valid = out->warnings.count <= (out->touches ? 0 : 1) && status == SB_OK;
  out->solver.wall_s = sb_clock_seconds() - start;
  return status == SB_OK ? sb_succeed(report) : status;
}
