// The analytical wedge; equations and validity in wedge.h.
#include "engine/film/wedge.h"

#include <math.h>

double sb_wedge_shape(double t, double te) {
  double sec2 = 1 / (cos(te) * cos(te));
  return t / 2 + M_PI / 4 + sin(2 * t) / 4 -
         sec2 * (3 * t / 8 + 3 * M_PI / 16 + sin(2 * t) / 4 + sin(4 * t) / 32);
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

  // sb_wedge_shape(te, te) falls from pi/16 at 0 without bound towards pi/2, so one root lies
  // between.
  double low = 0;
  double high = M_PI / 2;
  for (int i = 0; i < 200 && high - low > 1e-16; i++) {
    double te = (low + high) / 2;
    if (sb_wedge_shape(te, te) > step) {
      low = te;
    } else {
      high = te;
    }
  }
  double te = (low + high) / 2;
  double c2 = cos(te) * cos(te);
  double root = sqrt(2 * R / h0);
  out->rupture_angle = te;
  out->position_rupture = sqrt(2 * R * h0) * tan(te);
  out->film_flux = h0 / c2;

  // Net load by parts: integral of (P* - ambient) sec^2 t dt = cos^2(te)/4, whatever the pressures.
  out->load = scale * sqrt(2 * R * h0) * c2 / 4;

  // The pressure gradient vanishes at -te as well: there the pressure is greatest.
  out->pressure_max = problem->pressure_left + scale * sb_wedge_shape(-te, te);
  double eta_u = problem->viscosity * problem->speed;
  double span = te + M_PI / 2;
  out->friction_couette = eta_u * root * span;
  out->friction_poiseuille = 3 * eta_u * root * (span - (span / 2 + sin(2 * te) / 4) / c2);
  return sb_succeed(report);
}

SbStatus sb_wedge_solve_load(SbWedge *out, double *film_min, const SbWedgeProblem *problem,
                             double load, SbReport *report) {
  *out = (SbWedge){0};
  if (!(load > 0)) {
    return sb_fail(report, SB_ERROR_RANGE, "the load must be positive");
  }

  // w = 3 eta u R cos^2(te)/h0 with cos^2 between 0 and 1 brackets h0 from above.
  SbWedgeProblem trial = *problem;
  double top = 6 * problem->viscosity * problem->speed * 2 * problem->radius / (4 * load);
  double low = log(top) - 60;
  double high = log(top);
  for (int i = 0; i < 200 && high - low > 1e-15 * fabs(high); i++) {
    double middle = (low + high) / 2;
    trial.film_min = exp(middle);
    SbStatus status = sb_wedge_solve(out, &trial, report);
    if (status == SB_ERROR_RANGE) {
      return status;
    }
    // A thicker film carries less; where the outlet's pressure drives it back it carries too
    // little.
    if (status == SB_OK && out->load > load) {
      low = middle;
    } else {
      high = middle;
    }
  }
  trial.film_min = exp(low);
  *film_min = trial.film_min;
  SbStatus status = sb_wedge_solve(out, &trial, report);
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
  return problem->pressure_left + pressure_scale(problem) * sb_wedge_shape(t, wedge->rupture_angle);
}

double sb_taper_factor(double ratio) {
  double e = ratio - 1;
  if (fabs(e) < 1e-3) {
    // Series about a parallel film, where the closed form cancels; the next term is 0.61 e^4.
    return 1 - e / 2 + 7 * e * e / 12 - 5 * e * e * e / 8;
  }
  return (4 * log(ratio) - 6 * e / (ratio + 1)) / e;
}
