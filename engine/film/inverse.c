// Inverse film of Blok (1963): the film that a given smooth dry pressure forces through the
// contact.
//
// Reynolds' equation p' h^3 = 12 eta u_m (h - h*) is a cubic for h where p' is known. A film that
// passes the steepest point of the inlet, p'' = 0, must have there h_a^2 = 4 eta u_m / p'_max,
// hence h* = 2 h_a / 3. Upstream the larger root is taken, downstream the
// smaller. SI.
//
// Validity: lambda below 1e-5 (error under 1 %); -10 % at 1e-2, 4 % from 1e-3 to 3e-5. The pressure
// must be smooth: at a square-root edge like Hertz's the steepest slope grows without bound as the
// table is refined, so such tables are refused. Left out: elasticity beyond the dry pressure, hence
// the constriction of the outlet at small M.
#include "engine/film/scale.h"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_poly.h>
#include <gsl/gsl_spline.h>
#include <math.h>

enum { TABLE_LEAST = 9, SAMPLES = 1101 };

// Every `stride`-th point of the problem's table as a spline in the flow frame, turned round for
// reversed flow; NULL when out of memory.
static gsl_spline *table(const SbFilmProblem *problem, size_t stride) {
  bool forward = problem->speed >= 0.0;
  size_t count = (problem->dry_count - 1) / stride + 1;
  gsl_spline *t = gsl_spline_alloc(gsl_interp_cspline, count);
  for (size_t i = 0; i < count && t != NULL; i++) {
    size_t from = (forward ? i : count - 1 - i) * stride;
    t->x[i] = forward ? problem->dry_x[from] : -problem->dry_x[from];
    t->y[i] = problem->dry_pressure[from];
  }
  if (t != NULL && gsl_interp_init(t->interp, t->x, t->y, count) != GSL_SUCCESS) {
    gsl_spline_free(t);
    return NULL;
  }
  return t;
}

// Steepest rise and its place: at a knot, or where p'', straight between knots, turns negative.
static double steepest(double *place, const gsl_spline *t) {
  double best = 0.0, before = 0.0;
  *place = t->x[0];
  for (size_t i = 0; i < t->size; i++) {
    double x = t->x[i], bend = gsl_spline_eval_deriv2(t, x, NULL);
    if (i > 0 && before > 0.0 && bend < 0.0) {
      x = t->x[i - 1] + (x - t->x[i - 1]) * before / (before - bend);
    }
    double slope = gsl_spline_eval_deriv(t, x, NULL);
    if (slope > best) {
      best = slope;
      *place = x;
    }
    before = bend;
  }
  return best;
}

// h / h* at x with k = p' h*^2 / (12 eta u_m) <= 4/27, p' times `unit`: root of k y^3 - y + 1, from
// z^3 - z^2 + k with z = 1/y, whose two positive roots meet at 2/3. Infinite where the pressure
// does not rise upstream.
static double root(const gsl_spline *t, double x, double unit, bool upstream) {
  double k = gsl_spline_eval_deriv(t, x, NULL) * unit;
  if (k <= 0.0 && upstream) {
    return INFINITY;
  }
  if (k > 4.0 / 27.0 * (1.0 - 1e-14)) {
    return 1.5;
  }
  double z[3];
  int count = gsl_poly_solve_cubic(-1.0, 0.0, k, &z[0], &z[1], &z[2]);
  return 1.0 / (upstream ? z[1] : z[count - 1]);
}

static SbStatus check(const SbFilmProblem *problem, SbReport *report) {
  if (problem->dry_count < TABLE_LEAST || problem->dry_x == NULL || problem->dry_pressure == NULL) {
    return sb_fail(report, SB_ERROR_INPUT,
                   "the inverse model needs a dry pressure of at least %d points", TABLE_LEAST);
  }
  for (size_t i = 0; i < problem->dry_count; i++) {
    if (!isfinite(problem->dry_x[i]) || !isfinite(problem->dry_pressure[i]) ||
        (i > 0 && !(problem->dry_x[i] > problem->dry_x[i - 1]))) {
      return sb_fail(report, SB_ERROR_INPUT,
                     "dry pressure, point %zu: x must increase and numbers be finite", i + 1);
    }
  }
  return SB_OK;
}

// Films along the table into the profile and the scalars; the steepest slope is known.
static void evaluate(SbFilm *out, const SbFilmProblem *problem, const gsl_spline *t, double place,
                     double steep) {
  double eta_u = 0.5 * problem->viscosity * fabs(problem->speed);
  double flux = 2.0 / 3.0 * sqrt(4.0 * eta_u / steep);
  double begin = t->x[0];
  double end = t->x[t->size - 1];
  double axis = 0.0 > begin && 0.0 < end ? 0.0 : 0.5 * (begin + end);
  double unit = flux * flux / (12.0 * eta_u);
  out->film_flux = flux;
  out->film_min = INFINITY;
  out->film_central = flux * root(t, axis, unit, axis < place);
  out->position_rupture = end;
  out->ruptured = true;
  double before_x = 0.0, before_p = 0.0, before_h = INFINITY;
  size_t n = 0;
  for (int i = 0; i < SAMPLES; i++) {
    double x = i == SAMPLES - 1 ? end : begin + (end - begin) * i / (SAMPLES - 1);
    double p = gsl_spline_eval(t, x, NULL), h = flux * root(t, x, unit, x < place);
    if (isfinite(h) && isfinite(before_h)) {
      double shear = 2.0 * eta_u * (1.0 / h + 1.0 / before_h);
      out->friction_couette += 0.5 * shear * (x - before_x);
      out->friction_poiseuille += 0.25 * (h + before_h) * (p - before_p);
    }
    if (h < out->film_min) {
      out->film_min = h;
      out->position_film_min = x;
    }
    if (isfinite(h)) { // not flat upstream, where no film that fills the gap is defined
      out->pressure_max = fmax(out->pressure_max, p);
      sb_film_put(out, n++, x, p, h);
    }
    before_x = x;
    before_p = p;
    before_h = h;
  }
  double load = gsl_spline_eval_integ(t, begin, end, NULL);
  if (fabs(load / problem->load - 1.0) > 0.01) {
    sb_warn(&out->warnings, "film-dry-load", 0,
            "the dry pressure carries %.4g N/m, the load is %.4g", load, problem->load);
  }
}

SbStatus sb_film_solve_inverse(SbFilm *out, const SbFilmProblem *problem, const SbFilmScale *scale,
                               SbReport *report) {
  SbStatus status = check(problem, report);
  if (status != SB_OK) {
    return status;
  }
  gsl_spline *fine = table(problem, 1);
  gsl_spline *coarse = table(problem, 2);
  if (fine == NULL || coarse == NULL) {
    status = sb_fail(report, SB_ERROR_MEMORY, "out of memory");
  } else {
    double place, coarse_place;
    double steep = steepest(&place, fine);
    double coarse_steep = steepest(&coarse_place, coarse);
    // A smooth slope does not care for every second point; a square-root edge gives sqrt(2).
    double change = coarse_steep > 0.0 ? fabs(sqrt(steep / coarse_steep) - 1.0) : 1.0;
    if (!(steep > 0.0)) {
      status = sb_fail(report, SB_ERROR_INFEASIBLE, "the dry pressure never rises");
    } else if (change > 0.1) {
      status = sb_fail(report, SB_ERROR_INFEASIBLE,
                       "the steepest slope of the dry pressure changes by %.0f %% with every "
                       "second point left out: a square-root edge or too coarse a table",
                       200.0 * change);
    } else {
      evaluate(out, problem, fine, place, steep);
      out->solver.unknowns = fine->size;
      // The spline's slope has at least third order: with half the points the error is 8 times as
      // large.
      double estimate = 0.25 * change + 1e-12;
      out->solver.error_film_min = out->solver.error_film_central = out->solver.error_film_flux =
          estimate;
      if (estimate > problem->tolerance) {
        sb_warn(&out->warnings, "film-dry-coarse", 0,
                "the table of the dry pressure is coarse: films are uncertain by %.2g %%",
                100.0 * estimate);
      }
      // Errors against full solutions for smooth pressures, docs/verification.md.
      double lambda = scale->lambda;
      out->expected_error = lambda < 1e-5 ? 0.01 : lambda < 1e-3 ? 0.04 : lambda < 1e-2 ? 0.1 : 1.0;
      if (lambda > 1e-2) {
        out->valid = false;
        sb_warn(&out->warnings, "film-inverse-range", SB_FILM_IN_MODEL,
                "the inverse film is valid for lambda below 1e-2, here %.2g: the film changes the "
                "pressure",
                lambda);
      }
      status = sb_succeed(report);
    }
  }
  gsl_spline_free(fine);
  gsl_spline_free(coarse);
  return status;
}
