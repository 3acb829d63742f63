// The analytical wedge; equations and validity in wedge.h.
#include "engine/film/wedge.h"

#include "engine/film/scale.h"
#include "engine/numeric/root.h"

#include <math.h>

// Returns P* - P*_in at the angle t for a flux film of `stretch` minimum films: sec^2(te) if the
// film ends at te.
static double shape(double t, double stretch) {
  return t / 2 + M_PI / 4 + sin(2 * t) / 4 -
         stretch * (3 * t / 8 + 3 * M_PI / 16 + sin(2 * t) / 4 + sin(4 * t) / 32);
}

static double sec2(double t) {
  return 1 / (cos(t) * cos(t));
}

// Pressure at an end te above `context` P*, negative, with its slope: shape(te, sec^2(te)) falls
// from pi/16 at 0 without bound towards pi/2.
static double fall(double *slope, double te, const void *context) {
  double stretch = sec2(te);
  *slope =
      2 * stretch * tan(te) * (3 * te / 8 + 3 * M_PI / 16 + sin(2 * te) / 4 + sin(4 * te) / 32);
  return *(const double *)context - shape(te, stretch);
}

// Rise from the cavity's end t to the outlet, less what the outlet has.
typedef struct {
  double stretch, outlet;
} Rise;

static double rise(double *slope, double t, const void *context) {
  const Rise *r = context;
  double c2 = cos(t) * cos(t);
  *slope = c2 * (1 - r->stretch * c2);
  return r->outlet - shape(0.5 * M_PI, r->stretch) + shape(t, r->stretch);
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
  if (inlet + shape(w->end, s) < 0) {
    double step = -inlet, end = sb_newton_bracketed(fall, &step, 0, 0.5 * M_PI, 0.5);
    double most = inlet + shape(0.5 * M_PI, sec2(end));
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
    return w->inlet + unit * shape(t, s);
  }
  double rise = shape(0.5 * M_PI, s) - shape(t, s);
  return t < w->reform ? 0 : w->outlet - unit * rise;
}

// ---------------------------------------------------------------- ends by name

// Integral of cos^2 t - stretch cos^4 t from one angle to another.
static double between(double from, double to, double stretch) {
  return shape(to, stretch) - shape(from, stretch);
}

// Pressure at a Reynolds end of a wedge that begins at `context`: falls through 0.
static double end_pressure(double te, const void *context) {
  return between(*(const double *)context, te, sec2(te));
}

double sb_wedge_end(double reach) {
  double begin = -atan(reach);
  return sb_bisect(end_pressure, &begin, 0, -begin);
}

// Computes the flux film divided by the minimum one, and the end of the film.
static double stretch_of(double *end, SbWedgeEnds ends, double reach) {
  if (ends == SB_WEDGE_REYNOLDS) {
    *end = sb_wedge_end(reach);
    return sec2(*end);
  }
  // The pressure is odd about the throat: no rise from there to the end.
  double last = atan(reach);
  *end = ends == SB_WEDGE_FULL_SOMMERFELD ? last : 0;
  return between(0, last, 0) / (between(0, last, 0) - between(0, last, 1));
}

double sb_wedge_pressure(SbWedgeEnds ends, double t, double reach) {
  double end, stretch = stretch_of(&end, ends, reach), begin = -atan(reach);
  return t > begin && t < end ? between(begin, t, stretch) : 0;
}

double sb_wedge_load(SbWedgeEnds ends, double reach) {
  double end, stretch = stretch_of(&end, ends, reach);
  double far = 1 / (1 + reach * reach),
         near = ends == SB_WEDGE_FULL_SOMMERFELD ? far : 1 / sec2(end);
  return 12 * (near - far) - 6 * stretch * (near * near - far * far);
}

// ---------------------------------------------------------------- the model "rigid"

// Returns the outlet pressure minus the inlet pressure with which a film of given load ends at te,
// minus `context`: its minimum film is proportional to cos^2(te), and the unit is its P* at te = 0.
static double step_of_end(double te, const void *context) {
  return shape(te, sec2(te)) / pow(cos(te), 3) - *(const double *)context;
}

// Pressure and gap over the wedge, dense about its throat; lengths in units of `length`, P* in
// `unit`.
static void wedge_profile(SbFilm *out, double te, double length, double unit, double inlet,
                          double outlet) {
  enum { POINTS = 801 };
  for (size_t i = 0; i < POINTS && out->x != NULL; i++) {
    // tan runs from -30 to 2 throats: the pressure has gone to a ten-thousandth of its peak there.
    double x = i == POINTS - 1 ? 2 : tan(-1.5375 + 2.6446 * (double)i / (POINTS - 1));
    double t = atan(x);
    double p = t < te ? inlet + unit * shape(t, sec2(te)) : outlet;
    sb_film_put(out, i, x * length, p, out->film_min * (1 + x * x));
  }
}

SbStatus sb_film_solve_rigid(SbFilm *out, const SbFilmProblem *problem, const SbFilmScale *scale,
                             SbReport *report) {
  double inlet = scale->inlet * scale->pressure, outlet = scale->outlet * scale->pressure;
  double R = problem->radius;
  double eta_u = problem->viscosity * fabs(problem->speed);
  // Net load by parts: integral of (P* - ambient) sec^2 t dt = cos^2(te)/4, whatever the pressures.
  double top = 3 * eta_u * R / problem->load;
  double step = (outlet - inlet) / (6 * eta_u * sqrt(2 * R / top) / top);
  if (!(step < M_PI / 16)) {
    return sb_fail(report, SB_ERROR_INFEASIBLE,
                   "no rigid film carries %g N/m at these pressures: the outlet's drives it back",
                   problem->load);
  }
  double te = sb_bisect(step_of_end, &step, 0, 0.5 * M_PI);
  double c2 = cos(te) * cos(te);
  double h0 = out->film_min = out->film_central = top * c2; // the throat is on the axis
  double root = sqrt(2 * R / h0), unit = 6 * eta_u * root / h0;
  out->film_flux = top;
  out->position_rupture = root * h0 * tan(te);
  out->ruptured = true;
  // The pressure gradient vanishes at -te as well: there the pressure is greatest.
  out->pressure_max = inlet + unit * shape(-te, 1 / c2);
  double span = te + M_PI / 2;
  out->friction_couette = eta_u * root * span;
  out->friction_poiseuille = 3 * eta_u * root * (span - (span / 2 + sin(2 * te) / 4) / c2);
  wedge_profile(out, te, root * h0, unit, inlet, outlet);

  // Deviation of the film by the elastic limit.
  double elastic = 3.77334 * R * pow(scale->U, 0.6) * pow(scale->W, -0.2);
  out->expected_error =
      scale->M < 0.5 ? 0.03 : fabs(out->film_flux / fmax(elastic, out->film_flux) - 1);
  if (scale->M >= 0.5) {
    out->valid = false;
    sb_warn(
        &out->warnings, "film-rigid", SB_FILM_IN_MODEL,
        "rigid surfaces need M below 0.5; here M = %.3g and the bodies deform more than the film",
        scale->M);
  }
  return sb_succeed(report);
}
