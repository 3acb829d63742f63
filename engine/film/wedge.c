// The analytical wedge; equations and validity in wedge.h.
#include "engine/film/wedge.h"

#include "engine/numeric/root.h"

#include <math.h>

double sb_wedge_shape(double t, double stretch) {
  return t / 2 + M_PI / 4 + sin(2 * t) / 4 -
         stretch * (3 * t / 8 + 3 * M_PI / 16 + sin(2 * t) / 4 + sin(4 * t) / 32);
}

static double sec2(double t) {
  return 1 / (cos(t) * cos(t));
}

// Pressure at an end te above `context` P*, negative, with its slope.
static double fall(double *slope, double te, const void *context) {
  double stretch = sec2(te);
  *slope =
      2 * stretch * tan(te) * (3 * te / 8 + 3 * M_PI / 16 + sin(2 * te) / 4 + sin(4 * te) / 32);
  return *(const double *)context - sb_wedge_shape(te, stretch);
}

// Where the film ends at `step` P* above the inlet: sb_wedge_shape(te, te) falls from pi/16 at 0
// without bound towards pi/2.
static double end_at(double step) {
  return sb_newton_bracketed(fall, &step, 0, 0.5 * M_PI, 0.5);
}

// Rise from the cavity's end t to the outlet, less what the outlet has.
typedef struct {
  double stretch, outlet;
} Rise;

static double rise(double *slope, double t, const void *context) {
  const Rise *r = context;
  double c2 = cos(t) * cos(t);
  *slope = c2 * (1 - r->stretch * c2);
  return r->outlet - sb_wedge_shape(0.5 * M_PI, r->stretch) + sb_wedge_shape(t, r->stretch);
}

// The state of a film, and its load.
static double pools_load(SbWedgePools *w, double film) {
  double length = sqrt(2 * film);
  double unit = w->lambda * length / (film * film); // of P*
  double inlet = w->inlet / unit, outlet = w->outlet / unit;
  double d = outlet - inlet;
  double s = 8 / (3 * M_PI) * (0.5 * M_PI - d);
  w->film = film;
  w->length = length;
  w->full = true;
  w->end = w->reform = s > 1 ? acos(sqrt(1 / s)) : 0;
  if (inlet + sb_wedge_shape(w->end, s) < 0) {
    double end = end_at(-inlet);
    double most = inlet + sb_wedge_shape(0.5 * M_PI, sec2(end));
    if (outlet < most) {
      Rise r = {sec2(end), outlet};
      w->full = false;
      w->end = end;
      w->reform =
          outlet > 0 ? sb_newton_bracketed(rise, &r, end, 0.5 * M_PI, end + 0.1) : 0.5 * M_PI;
      s = r.stretch;
    }
  }
  w->stretch = s;
  // -int x dp over the full film; and the integral of the deflection's slope, its tilt by unequal
  // ends taken out as in docs/verification.md.
  double begin = cos(w->end) * cos(w->end), again = cos(w->reform) * cos(w->reform);
  double rigid =
      -0.5 * again + 0.25 * s * again * again - (-0.5 * begin + 0.25 * s * begin * begin);
  double elastic = d / 4 * (1 - log(4) - s / 8 * (7 - 12 * log(2))) +
                   (1 - s) / 2 * M_PI * (3.0 / 8 - 5.0 / 16 * s) +
                   s / 4 * M_PI / 16 * (1 - 5.0 / 8 * s) - d * d / M_PI * log(2 * length);
  return unit * length * rigid + unit * unit * elastic;
}

static double pools_excess(double log_film, const void *context) {
  SbWedgePools w = *(const SbWedgePools *)context;
  return pools_load(&w, exp(log_film)) - 0.5 * M_PI;
}

SbWedgePools sb_wedge_pools(double lambda, double inlet, double outlet) {
  SbWedgePools out = {.lambda = lambda, .inlet = inlet, .outlet = outlet};
  double film = 4.894968 * lambda / (6 * M_PI); // without end pressures, nor any deflection
  if (inlet != 0 || outlet != 0) {
    film = exp(sb_bisect(pools_excess, &out, log(film) - 60, log(film) + 10));
  }
  pools_load(&out, film);
  return out;
}

double sb_wedge_pools_pressure(const SbWedgePools *w, double x) {
  double t = atan(x / w->length), s = w->stretch;
  double unit = w->lambda * w->length / (w->film * w->film);
  if (w->full || t < w->end) {
    return w->inlet + unit * sb_wedge_shape(t, s);
  }
  double rise = sb_wedge_shape(0.5 * M_PI, s) - sb_wedge_shape(t, s);
  return t < w->reform ? 0 : w->outlet - unit * rise;
}

// Pressure in Pa per unit of P*.
static double pressure_scale(const SbWedgeProblem *problem) {
  double h0 = problem->film_min;
  return 6 * problem->speed * problem->viscosity * sqrt(2 * problem->radius * h0) / (h0 * h0);
}

SbStatus sb_wedge_solve(SbWedge *out, const SbWedgeProblem *problem, SbReport *report) {
  *out = (SbWedge){0};
  double h0 = problem->film_min;
  double R = problem->radius;
  if (!(h0 > 0 && problem->speed > 0 && R > 0 && problem->viscosity > 0)) {
    return sb_fail(report, SB_ERROR_RANGE, "film, speed, radius and viscosity must be positive");
  }
  double scale = pressure_scale(problem);
  double step = (problem->pressure_right - problem->pressure_left) / scale;
  if (!(step < M_PI / 16)) {
    return sb_fail(report, SB_ERROR_INFEASIBLE,
                   "the outlet pressure drives the film back: no end with zero gradient");
  }

  double te = end_at(step);
  double c2 = cos(te) * cos(te);
  double root = sqrt(2 * R / h0);
  out->rupture_angle = te;
  out->position_rupture = sqrt(2 * R * h0) * tan(te);
  out->film_flux = h0 / c2;

  // Net load by parts: integral of (P* - ambient) sec^2 t dt = cos^2(te)/4, whatever the pressures.
  out->load = scale * sqrt(2 * R * h0) * c2 / 4;

  // The pressure gradient vanishes at -te as well: there the pressure is greatest.
  out->pressure_max = problem->pressure_left + scale * sb_wedge_shape(-te, 1 / c2);
  double eta_u = problem->viscosity * problem->speed;
  double span = te + M_PI / 2;
  out->friction_couette = eta_u * root * span;
  out->friction_poiseuille = 3 * eta_u * root * (span - (span / 2 + sin(2 * te) / 4) / c2);
  return sb_succeed(report);
}

// What a film of that logarithm carries beyond a load; where the outlet's pressure drives it back
// it carries too little.
typedef struct {
  SbWedgeProblem problem;
  double load;
} LoadProblem;

static double load_excess(double log_film, const void *context) {
  LoadProblem at = *(const LoadProblem *)context;
  at.problem.film_min = exp(log_film);
  SbWedge wedge;
  return sb_wedge_solve(&wedge, &at.problem, NULL) == SB_OK ? wedge.load - at.load : -at.load;
}

SbStatus sb_wedge_solve_load(SbWedge *out, double *film_min, const SbWedgeProblem *problem,
                             double load, SbReport *report) {
  *out = (SbWedge){0};
  if (!(load > 0)) {
    return sb_fail(report, SB_ERROR_RANGE, "the load must be positive");
  }
  // w = 3 eta u R cos^2(te)/h0 with cos^2 between 0 and 1 brackets h0 from above.
  LoadProblem at = {*problem, load};
  double top = log(3 * problem->viscosity * problem->speed * problem->radius / load);
  *film_min = at.problem.film_min = exp(sb_bisect(load_excess, &at, top - 60, top));
  SbStatus status = sb_wedge_solve(out, &at.problem, report);
  if (status == SB_OK && fabs(out->load / load - 1) > 1e-9) {
    return sb_fail(report, SB_ERROR_INFEASIBLE, "no rigid film carries %g N/m at these pressures",
                   load);
  }
  return status;
}

double sb_wedge_pressure(const SbWedge *wedge, const SbWedgeProblem *problem, double x) {
  double t = atan(x / sqrt(2 * problem->radius * problem->film_min));
  if (t >= wedge->rupture_angle) {
    return problem->pressure_right;
  }
  return problem->pressure_left +
         pressure_scale(problem) * sb_wedge_shape(t, sec2(wedge->rupture_angle));
}

double sb_taper_factor(double ratio) {
  double e = ratio - 1;
  if (fabs(e) < 1e-3) {
    // Series about a parallel film, where the closed form cancels; the next term is 0.61 e^4.
    return 1 - e / 2 + 7 * e * e / 12 - 5 * e * e * e / 8;
  }
  return (4 * log(ratio) - 6 * e / (ratio + 1)) / e;
}
