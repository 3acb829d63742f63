// The closed forms as contact models. Each form gives width and load; all other results are
// computed by common code. Equations, sources and ranges: see the header.
#include "engine/contact/closed_forms.h"

#include "engine/contact/fit_models.h"
#include "engine/numeric/root.h"

#include <math.h>

// ---- line contact

static double compliance(double modulus, double poisson) {
  return modulus > 0.0 && isfinite(modulus) ? (1.0 - poisson * poisson) / modulus : 0.0;
}

double sb_reduced_modulus(double modulus_a, double poisson_a, double modulus_b, double poisson_b) {
  double sum = compliance(modulus_a, poisson_a) + compliance(modulus_b, poisson_b);
  return sum > 0.0 ? 2.0 / sum : INFINITY;
}

double sb_hertz_half_width(double load_per_length, double radius, double reduced_modulus) {
  return load_per_length > 0.0 ? sqrt(8.0 * load_per_length * radius / (M_PI * reduced_modulus))
                               : 0.0;
}

// Approach over k R, less the one wanted, at half-width t R.
static double approach_of_width(double *slope, double t, const void *target) {
  *slope = 4.0 * t * (log(4.0 / t) - 1.0);
  return t * t * (2.0 * log(4.0 / t) - 1.0) - *(const double *)target;
}

double sb_hertz_width_of_approach(double approach, double stiffness) {
  // With t = b/R the approach is t^2 (2 ln(4/t) - 1) R E'/(4 E_d), rising up to t = 4/e and
  // meaningful below t = 1.
  const double target = stiffness * approach;
  return target < 2.0 * log(4.0) - 1.0
             ? sb_newton_bracketed(approach_of_width, &target, 0.0, 1.0, sqrt(target / 6.0))
             : 1.0;
}

double sb_interference_on_floor(const SbFitProblem *in) {
  const double nu = in->poisson_ratio, d = in->section_diameter;
  const double mean = in->bore_diameter - in->radial_space;
  const double stretch = mean / (in->inner_diameter + d) - 1.0;
  const double shrunk = d * (1.0 - nu * stretch);
  if (!(stretch > 0.0) || !(shrunk > 0.0)) {
    return shrunk - in->radial_space; // it does not press on the floor
  }
  const double area = 0.25 * M_PI * d * d * (1.0 - 2.0 * nu * stretch);
  const double load = in->modulus * stretch * fmax(area, 0.0) / (0.5 * mean);
  const double disc = in->modulus / (1.0 - nu * nu), radius = 0.5 * shrunk;
  const double half = sb_hertz_half_width(load, radius, 2.0 * disc);
  const double approach =
      half > 0.0 ? load / (M_PI * disc) * (2.0 * log(4.0 * radius / half) - 1.0) : 0.0;
  return shrunk - approach - in->radial_space;
}

// ---- contact models

// The round section that a model squeezes: its diameter d [m] and squeeze (d - g)/d.
typedef struct {
  double diameter, squeeze;
} Section;

// Full width of the contact [m] and load per length [N/m] by one model.
typedef struct {
  double width, load;
} Contact;

static void check_squeeze(SbFit *out, const Section *section, const char *code, double low,
                          double high, const char *of) {
  if (section->squeeze < low || section->squeeze > high) {
    sb_warn(&out->warnings, code, SB_CONTACT_IN_SECTION_DIAMETER,
            "squeeze %.3g %% is outside %.3g to %.3g %%, the range of %s", 100.0 * section->squeeze,
            100.0 * low, 100.0 * high, of);
  }
}

static Contact karaszkiewicz(SbFit *out, const SbFitProblem *in, const Section *section) {
  check_squeeze(out, section, "karaszkiewicz-squeeze", 0.07, 0.25, "Karaszkiewicz's formulae");
  const double p = fabs(in->pressure), s = section->squeeze, nu = in->poisson_ratio;
  const double unloaded = 2.0 * s + 0.13;
  const double growth = 0.39 / (1.0 - s) - 0.5 * unloaded;
  const double width = section->diameter * (unloaded - growth * expm1(-4.6 * p / in->modulus));
  return (Contact){width, width * (M_PI / 6.0 * unloaded * in->modulus + nu / (1.0 - nu) * p)};
}

static Contact hertz(SbFit *out, const SbFitProblem *in, const Section *section) {
  static const double WIDTH_MOST = 0.3; // of b/R: there the parabola is off the circle by 4 %
  const double nu = in->poisson_ratio, radius = 0.5 * section->diameter;
  const double modulus =
      sb_reduced_modulus(in->modulus, nu, in->housing_modulus, in->housing_poisson);
  const double t = sb_hertz_width_of_approach(2.0 * section->squeeze,
                                              4.0 * in->modulus / (1.0 - nu * nu) / modulus);
  if (t > WIDTH_MOST) {
    sb_warn(
        &out->warnings, "hertz-width", SB_CONTACT_IN_RADIAL_SPACE,
        "contact half-width is %.2g of the radius: Hertz theory requires a small value (below %g)",
        t, WIDTH_MOST);
  }
  return (Contact){2.0 * t * radius, M_PI * modulus * t * t * radius / 8.0};
}

// Width and load of F/(pi d D E), by Lindley's 2.9.
static Contact of_load_factor(SbFit *out, const SbFitProblem *in, const Section *section,
                              double factor) {
  if (in->poisson_ratio < 0.45) {
    sb_warn(&out->warnings, "incompressible-assumed", SB_CONTACT_IN_POISSON_RATIO,
            "the formula is for incompressible rubber, not Poisson's ratio %.3g",
            in->poisson_ratio);
  }
  const double d = section->diameter;
  return (Contact){d * sqrt(6.0 / M_PI * factor), factor * d * in->modulus};
}

static Contact lindley(SbFit *out, const SbFitProblem *in, const Section *section) {
  const bool initial = in->variant == SB_LINDLEY_INITIAL;
  const double s = section->squeeze;
  check_squeeze(out, section, "lindley-squeeze", 0.0, initial ? 0.15 : 0.25, "Lindley's formula");
  Contact c =
      of_load_factor(out, in, section, 1.25 * s * sqrt(s) + (initial ? 0.0 : 50.0 * pow(s, 6.0)));
  c.width = in->variant == SB_LINDLEY_SIMPLE_WIDTH ? 2.4 * s * section->diameter
            : in->variant == SB_LINDLEY_KURAN      ? 2.5 * s * section->diameter
                                                   : c.width;
  return c;
}

static Contact green_english(SbFit *out, const SbFitProblem *in, const Section *section) {
  static const struct {
    double a, b, c, n, s_max;
  } rows[SB_GREEN_ENGLISH_COUNT] = {
      [SB_GREEN_ENGLISH_RADIAL] = {1.03792, 1.2871, 7.77994, 3.534, 0.32},
      [SB_GREEN_ENGLISH_PLANE] = {0.97184, 1.29093, 7.1014, 3.55262, 0.32},
      [SB_GREEN_ENGLISH_AXIAL_LUBRICATED] = {0.74602, 1.25282, 3.09259, 3.38757, 0.32},
      [SB_GREEN_ENGLISH_AXIAL] = {0.97275, 1.29292, 6.93373, 3.55385, 0.32},
      [SB_GREEN_ENGLISH_AXIAL_RESTRAINED] = {1.63328, 1.38463, 683.984, 5.1869, 0.10},
      [SB_GREEN_ENGLISH_RADIAL_RESTRAINED] = {1.7673, 1.38755, 948.475, 5.32269, 0.10},
      [SB_GREEN_ENGLISH_PLANE_RESTRAINED] = {1.55365, 1.38072, 530.577, 5.13163, 0.10},
  };
  const double s = section->squeeze;
  const double s_max = rows[in->variant].s_max;
  check_squeeze(out, section, "green-english-squeeze", 0.0, s_max, "this row of Green and English");
  return of_load_factor(out, in, section,
                        rows[in->variant].a * pow(s, rows[in->variant].b) +
                            rows[in->variant].c * pow(s, rows[in->variant].n));
}

SbStatus sb_fit_closed(SbFit *out, const SbFitProblem *in, SbReport *report) {
  static Contact (*const model[])(SbFit *, const SbFitProblem *, const Section *) = {
      [SB_FIT_KARASZKIEWICZ] = karaszkiewicz,
      [SB_FIT_HERTZ] = hertz,
      [SB_FIT_LINDLEY] = lindley,
      [SB_FIT_GREEN_ENGLISH] = green_english,
  };
  out->circumference = M_PI * (in->inner_diameter + in->section_diameter);
  // Closed forms are exact to rounding and have no unknowns.
  out->solver.converged = true;
  sb_fit_errors(out, 0.0, 0.0, 0.0);
  const double diameter = in->fitted_section ? out->section_diameter_fitted : in->section_diameter;
  const Section section = {diameter, (diameter - in->radial_space) / diameter};
  if (!(diameter > in->radial_space)) {
    sb_warn_serious(&out->warnings, "no-contact", SB_CONTACT_IN_SECTION_DIAMETER,
                    "the ring has no contact with the bore (squeeze %.3g %%): load 0",
                    100.0 * section.squeeze);
    return sb_succeed(report);
  }
  const Contact c = model[in->model](out, in, &section);
  if (c.width >= diameter && in->model == SB_FIT_HERTZ) {
    return sb_fail_input(report, SB_ERROR_INFEASIBLE, SB_CONTACT_IN_RADIAL_SPACE,
                         "at a squeeze of %.3g %% Hertz's contact is wider than the disc",
                         100.0 * section.squeeze);
  }
  if (in->pressure != 0.0 && !sb_fit_kind(in->model)->fluid) {
    sb_warn(&out->warnings, "pressure-ignored", SB_CONTACT_IN_PRESSURE,
            "the model %s has no fluid pressure: %.3g MPa ignored", sb_fit_kind(in->model)->name,
            1e-6 * in->pressure);
  }
  out->load_per_length = c.load;
  out->pressure_peak = 4.0 * c.load / (M_PI * c.width);
  sb_fit_contact(out, -0.5 * c.width, 0.5 * c.width);
  for (size_t i = 1; i + 1 < out->profile_count; i++) {
    const double t = out->profile_x[i] / out->contact_right;
    out->profile_p[i] = out->pressure_peak * sqrt((1.0 - t) * (1.0 + t));
  }
  return sb_succeed(report);
}
