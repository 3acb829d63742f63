// Closed-form films and the dry contact at zero speed; laws, regimes and other formulas of laws.h.
//
//   karaszkiewicz  H = 4.4 U^0.65 W^-0.21        thesis eq. 7.6 (= 5.5): a fitted O-ring
//   thesis         H = 1.492 U^0.5434 W^-0.2893  thesis eq. 7.5, central film of tables 7.9, 7.10
//   asymptotic     h_min = 3.00434 R U^0.6 W^-0.2, h_flux = 3.77334 R U^0.6 W^-0.2, exact as M
//                  grows (docs/verification.md), with the end pressures' factor kappa^-0.8
//   moes           blend of that limit and the rigid wedge's, for every M
//
// The two power laws have one film, reported as minimum, central and flux film. The profile is
// Hertz's dry pressure and gap plus the film; friction is that of the flat film. Not modelled:
// layers at the edges, so the profile is not a solution of Reynolds' equation. The expected error
// is the distance from a blend of the rigid and the elastic limit.
#include "engine/film/laws.h"

#include "engine/film/scale.h"

#include <math.h>

// Blend of the rigid and the elastic limit: (rigid^s + elastic^s)^(1/s).
static double blend(double rigid, double elastic, double s) {
  return pow(pow(rigid, s) + pow(elastic, s), 1.0 / s);
}

// Moes-type blend with exponents fitted to our own solutions from M = 0.1 to 1e6: minimum and flux
// within 2 %, centre within 5 % (checked by the tests). Films over R.
static void blended(double *minimum, double *central, double *flux, const SbFilmScale *scale) {
  double M = scale->M;
  double rigid = 4.894968 * scale->U / scale->W;
  double elastic = pow(scale->U, 0.6) * pow(scale->W, -0.2);
  double s = 1.25 + 1.35 / (1.0 + 0.52 * M);
  double kappa = pow(scale->kappa, -0.8);
  *minimum = kappa * blend(rigid, 3.00434 * elastic, s);
  *flux = kappa * blend(1.225748 * rigid, 3.77334 * elastic, s);
  *central = kappa * blend(rigid, 3.77334 * elastic, 1.2 + 1.9 / (1.0 + 0.55 * pow(M, 1.6)));
}

// Dry pressure and gap on points dense at both edges, the gap raised by `film`.
static void dry_profile(SbFilm *out, const SbFilmScale *scale, double film) {
  enum { POINTS = 601 };
  for (int i = 0; i < POINTS; i++) {
    // A sine in three periods: |X| <= 1 in the middle half, up to 3 outside, dense at +-1.
    double s = -2.0 + 4.0 * i / (POINTS - 1);
    double X =
        fabs(s) <= 1.0 ? sin(s * M_PI / 2.0) : copysign(1.0 + 2.0 * pow(fabs(s) - 1.0, 2), s);
    double p = scale->pressure * sb_film_dry_pressure(X, scale->inlet, scale->outlet);
    sb_film_put(out, (size_t)i, X * scale->half_width, p, scale->film * sb_film_dry_gap(X) + film);
    out->pressure_max = fmax(out->pressure_max, p);
  }
}

SbStatus sb_film_solve_dry(SbFilm *out, const SbFilmScale *scale, SbReport *report) {
  dry_profile(out, scale, 0.0);
  out->position_rupture = scale->half_width;
  out->solver.converged = true;
  sb_warn(&out->warnings, "film-zero-speed", SB_FILM_IN_SPEED,
          "at zero speed there is no film: dry contact");
  return sb_succeed(report);
}

// Films over R by k U^a W^b of the models, times the end pressures' factor.
static const struct Law {
  double least, flux; // k
  double a, b, kappa;
} laws[SB_FILM_MODEL_COUNT] = {
    [SB_FILM_THESIS] = {1.492, 1.492, 0.5434, -0.2893, 0.0},
    [SB_FILM_KARASZKIEWICZ] = {4.4, 4.4, 0.65, -0.21, 0.0},
    [SB_FILM_ASYMPTOTIC] = {3.00434, 3.77334, 0.6, -0.2, -0.8},
};

SbStatus sb_film_solve_law(SbFilm *out, const SbFilmProblem *problem, const SbFilmScale *scale,
                           SbReport *report) {
  const SbFilmModel model = problem->model;
  const struct Law *law = &laws[model];
  double U = scale->U;
  double W = scale->W;
  double R = problem->radius;
  double width = scale->half_width;
  double minimum, central, flux; // of the blend, over R
  blended(&minimum, &central, &flux, scale);
  out->position_rupture = width;
  if (model == SB_FILM_MOES) {
    out->film_min = R * minimum;
    out->film_central = R * central;
    out->film_flux = R * flux;
  } else {
    double unit = R * pow(U, law->a) * pow(W, law->b) * pow(scale->kappa, law->kappa);
    out->film_min = law->least * unit;
    out->film_central = out->film_flux = law->flux * unit;
  }
  if (model == SB_FILM_ASYMPTOTIC) {
    double layer = pow(scale->lambda, 0.4);
    out->position_film_min = width * (1.0 - 0.17041 * layer);
    out->position_rupture = width * (1.0 + 0.16406 * layer);
    out->ruptured = scale->outlet <= 0.0;
  }
  // The data behind eq. 7.5: Tables 7.9 and 7.10.
  if (model == SB_FILM_THESIS && (U < 5.9e-10 || U > 1.6e-7 || W < 0.0566 || W > 0.1906)) {
    out->valid = false;
    sb_warn(&out->warnings, "film-law-range", SB_FILM_IN_MODEL,
            "eq. 7.5 was fitted for U 5.9e-10 ... 1.6e-7, W 0.057 ... 0.191; here %.3g, %.3g", U,
            W);
  }

  // How far the law is from the blend, which is good to a few per cent: its expected error.
  double expected = fabs(out->film_flux / R / flux - 1.0) + 0.02;
  out->expected_error = expected;
  if (expected > 0.1) {
    out->valid = false;
    sb_warn(&out->warnings, "film-law-error", SB_FILM_IN_MODEL,
            "model %s is about %.0f %% from the solved film here", sb_film_kind(model)->name,
            100.0 * expected);
  }
  if ((model == SB_FILM_THESIS || model == SB_FILM_KARASZKIEWICZ) &&
      (scale->inlet > 0.0 || scale->outlet > 0.0)) {
    sb_warn(&out->warnings, "film-law-pressure", SB_FILM_IN_MODEL,
            "in the power law end pressures act only through the load");
  }

  dry_profile(out, scale, out->film_flux);
  out->friction_couette = problem->viscosity * fabs(problem->speed) * 2.0 * width / out->film_flux;
  out->friction_poiseuille =
      0.5 * out->film_flux * (scale->outlet - scale->inlet) * scale->pressure;
  return sb_succeed(report);
}

// ---------------------------------------------------------------- formulas

double sb_film_law(const SbFilmLaw *law, double U, double W) {
  return law->k * pow(U, law->a) * pow(W, law->b);
}

// Coefficients of the chart's four corners.
static const double RIGID = 4.894968, ELASTIC = 3.00434, VISCOUS = 1.05, BOTH = 2.05;

double sb_regime_viscous_border(double g_E) {
  double film = fmax(RIGID, ELASTIC * pow(g_E, 0.8));
  return fmin(pow(film / VISCOUS, 1.5), pow(film / (BOTH * pow(g_E, 0.06)), 1 / 0.54));
}

double sb_regime_elastic_border(double g_V) {
  double film = fmax(RIGID, VISCOUS * pow(g_V, 2.0 / 3));
  return fmin(pow(film / ELASTIC, 1.25), pow(film / (BOTH * pow(g_V, 0.54)), 1 / 0.06));
}

SbChartPoint sb_regime_chart(double load, double entrainment, double radius, double modulus,
                             double viscosity, double pressure_viscosity) {
  // Dowson's groups; the third one is alpha E'.
  const double U = viscosity * entrainment / (modulus * radius), W = load / (modulus * radius);
  SbChartPoint point = {.g_E = W / sqrt(U),
                        .g_V = pressure_viscosity * modulus * pow(W, 1.5) / sqrt(U)};

  // Film parameter h W/(R U) of each corner.
  const struct {
    const char *name;
    double film;
  } corner[] = {
      {"isoviscous-rigid", RIGID},
      {"isoviscous-elastic", ELASTIC * pow(point.g_E, 0.8)},
      {"piezoviscous-rigid", VISCOUS * pow(point.g_V, 2.0 / 3)},
      {"piezoviscous-elastic", BOTH * pow(point.g_V, 0.54) * pow(point.g_E, 0.06)},
  };
  int thickest = 0;
  for (int i = 1; i < 4; i++) {
    thickest = corner[i].film > corner[thickest].film ? i : thickest;
  }
  point.regime = corner[thickest].name;
  return point;
}

const char *sb_regime_of_lambda(double lambda) {
  return lambda < 1 ? "boundary" : lambda < 3 ? "mixed" : "full film";
}

double sb_taper_factor(double ratio) {
  double e = ratio - 1;
  if (fabs(e) < 1e-3) {
    // Series about a parallel film, where the closed form cancels; the next term is 0.61 e^4.
    return 1 - e / 2 + 7 * e * e / 12 - 5 * e * e * e / 8;
  }
  return (4 * log(ratio) - 6 * e / (ratio + 1)) / e;
}
