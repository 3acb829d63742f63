// Initial states, time steps and results of the transient film; equations in transient.h.
//
// BDF2 on the fluid height m of the cells with uneven steps; the difference to the parabola
// through the last three heights gives the step's own error (of the third order), whose mean over
// the contact is held to a share of the tolerance.
#include "engine/film/transient.h"

#include <gsl/gsl_interp.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "engine/film/ehl_transient.h"
#include "engine/numeric/legendre.h"

static const double TRAVEL = 1.0; // largest way of the fluid in a step, in cells
// Of the largest local error of a step against the mean's: the least film is local.
static const double LOCAL = 0.3;

static bool cancelled(const SbFilmTransient *t) {
  const SbFilmProblem *p = &t->problem.film;
  return p->cancelled != NULL && p->cancelled(p->cancelled_data);
}

// ---------------------------------------------------------------- initial states

// Scaled film and pressure of a steady profile at X; false outside it.
static bool sample(double *film, double *pressure, const SbFilm *profile, double x) {
  if (profile->points < 2 || x < profile->x[0] || x > profile->x[profile->points - 1]) {
    return false;
  }
  const size_t i = gsl_interp_bsearch(profile->x, x, 0, profile->points - 1);
  const double span = profile->x[i + 1] - profile->x[i];
  const double s = span > 0.0 ? (x - profile->x[i]) / span : 0.0;
  *film = profile->film[i] + s * (profile->film[i + 1] - profile->film[i]);
  *pressure = profile->pressure[i] + s * (profile->pressure[i + 1] - profile->pressure[i]);
  return true;
}

// Steady state from the spectral solution at `speed` [m/s].
static SbStatus lay_steady(SbFilmTransient *t, SbTransientState *s, const SbFilm *steady,
                           double speed, SbReport *report) {
  const double flux = steady->film_flux / t->scale.film;
  const double end = speed > 0.0 ? 1.0 : -1.0;
  const double rupture = t->problem.film.rupture_pressure;
  s->speed = 0.5 * speed / t->scale.half_width;
  for (int i = 0; i < t->nodes; i++) {
    const double X = t->X[i];
    double film, pressure;
    s->cavity[i] = false;
    s->void_[i] = 0.0;
    s->P[i] = (X < 0.0 ? t->inlet : t->outlet);
    s->H[i] = flux + sb_film_dry_gap(X);
    const double x = (t->middle + X) * t->scale.half_width;
    if (sample(&film, &pressure, steady, x)) {
      s->P[i] = fmax((pressure - rupture) / t->scale.pressure, 0.0);
      s->H[i] = film / t->scale.film;
    }
    const bool beyond = (x - steady->position_rupture) * end > 0.0;
    if (steady->ruptured && beyond && i > 0 && i + 1 < t->nodes && s->P[i] <= 0.0) {
      s->cavity[i] = true;
      s->P[i] = 0.0;
      s->void_[i] = s->H[i] - flux;
    }
  }
  s->H0 = 0.0;
  const SbTransientStep none = {0};
  SbTransientTrace trace;
  const SbStatus status = sb_transient_newton(&trace, t, s, &none);
  t->info.newton_iterations += (size_t)trace.iterations;
  if (status != SB_OK) {
    return sb_fail(report, status, "transient film: no steady state on the mesh of finite volumes");
  }
  return SB_OK;
}

// Contact at rest, parted by the film `rest`: the pressure of the dry contact; the first step finds
// the mesh's own for that film.
static void lay_rest(SbFilmTransient *t, SbTransientState *s, double rest) {
  SbEhlLayers layers = sb_transient_layers(t);
  layers.inlet = t->inlet;
  layers.outlet = t->outlet;
  for (int i = 0; i < t->nodes; i++) {
    s->P[i] = sb_ehl_layers_dry_pressure(&layers, t->X[i]);
    s->void_[i] = 0.0;
    s->cavity[i] = false;
  }
  s->speed = 0.0;
  s->H0 = 0.0;
  sb_transient_gap(s->H, t, s);
  s->H0 = rest - s->H[t->nodes / 2];
  for (int i = 0; i < t->nodes; i++) {
    s->H[i] = fabs(t->X[i]) < 1.0 ? rest : fmax(s->H[i] + s->H0, rest);
  }
}

// Least film: a parabola through the lowest node and its neighbours, in units of the film.
static double least_film(double *place, const SbFilmTransient *t, const SbTransientState *s) {
  int at = 1;
  for (int i = 1; i + 1 < t->nodes; i++) {
    if (s->H[i] < s->H[at]) {
      at = i;
    }
  }
  const double x0 = t->X[at - 1] - t->X[at], x1 = t->X[at + 1] - t->X[at];
  const double h0 = s->H[at - 1] - s->H[at], h1 = s->H[at + 1] - s->H[at];
  const double a = (h1 / x1 - h0 / x0) / (x1 - x0);
  const double b = h0 / x0 - a * x0;
  const double dx = a > 0.0 ? fmin(fmax(-0.5 * b / a, x0), x1) : 0.0;
  *place = t->X[at] + dx;
  return s->H[at] + dx * (b + a * dx);
}

// Least and central film, scaled; X = 0 is the node in the middle.
static void read_figures(double out[2], double *place, const SbFilmTransient *t) {
  out[0] = least_film(place, t, &t->now);
  out[1] = t->now.H[t->nodes / 2];
}

static void remember(SbFilmTransient *t) {
  const SbTransientState *s = &t->now;
  SbTransientPast *past = t->past;
  memmove(&past[1], &past[0], 2 * sizeof *past);
  past[0].time = s->time, past[0].travel = s->travel;
  for (int i = 0; i < t->nodes; i++) {
    past[0].height[i] = sb_transient_height(s, i);
  }
  t->known_times = t->known_times < 3 ? t->known_times + 1 : 3;
}

void sb_film_transient_destroy(SbFilmTransient *t) {
  if (t != NULL) {
    sb_film_transient_destroy(t->companion);
    free(t->kernel);
    free(t->matrix);
    free(t);
  }
}

static bool allocate(SbFilmTransient *t) {
  const size_t size = (size_t)SB_TRANSIENT_NODES_MAX * SB_TRANSIENT_NODES_MAX * sizeof(double);
  t->kernel = malloc(size);
  t->matrix = malloc(size);
  return t->kernel != NULL && t->matrix != NULL;
}

static SbStatus check(const SbFilmTransientProblem *problem, SbReport *report) {
  const SbFilmProblem *film = &problem->film;
  if (film->model != SB_FILM_REYNOLDS || film->pressure_viscosity != 0.0 ||
      film->eyring_stress != 0.0 || film->inlet_film != 0.0 || film->surface != SB_ROUGH_NONE ||
      film->hamaker != 0.0) {
    return sb_fail(report, SB_ERROR_INPUT,
                   "transient film: only the isoviscous, flooded, smooth reynolds model");
  }
  if (!(problem->speed_scale >= fabs(film->speed) && problem->speed_scale > 0.0)) {
    return sb_fail_parameter(report, SB_ERROR_RANGE, "drive.speed",
                             "transient film: speed scale %g m/s is below the speed %g m/s",
                             problem->speed_scale, film->speed);
  }
  const bool rest = problem->rest_film > 0.0;
  if (!(problem->rest_film >= 0.0 && problem->rest_film < film->radius) ||
      rest != (film->speed == 0.0)) {
    return sb_fail(report, SB_ERROR_RANGE,
                   "transient film: it starts at rest with a film between the surfaces, or steady");
  }
  return SB_OK;
}

// One resolution from the steady films at speed_scale and, unless it is at rest, at the start.
static SbStatus begin(SbFilmTransient **out, const SbFilmTransientProblem *problem,
                      double coarseness, const SbFilm steady[2], SbFilmSolver *solver,
                      SbReport *report) {
  const SbFilm *largest = &steady[0];
  SbFilmTransient *t = *out = calloc(1, sizeof *t);
  if (t == NULL || !allocate(t)) {
    return sb_fail(report, SB_ERROR_MEMORY, "transient film: out of memory");
  }
  t->problem = *problem;
  t->coarseness = coarseness;
  SbFilmProblem scaled = problem->film;
  scaled.speed = (problem->film.speed < 0.0 ? -1.0 : 1.0) * problem->speed_scale;
  t->scale = sb_film_scale(&scaled);
  if (problem->film.compliance != NULL) {
    t->compliance = *problem->film.compliance;
    t->problem.film.compliance = &t->compliance;
    SbDryContact dry;
    const SbStatus status = sb_film_scale_fitted(&t->scale, &dry, &scaled, report);
    if (status != SB_OK) {
      return status;
    }
  }
  const double rupture = problem->film.rupture_pressure;
  t->inlet = (problem->film.pressure_left - rupture) / t->scale.pressure;
  t->outlet = (problem->film.pressure_right - rupture) / t->scale.pressure;
  t->diffusion = t->scale.film * t->scale.film * t->scale.pressure /
                 (12.0 * problem->film.viscosity * t->scale.half_width * t->scale.half_width);
  t->flow = 0.5 * problem->speed_scale / t->scale.half_width * largest->film_flux / t->scale.film;
  t->middle = scaled.speed < 0.0 ? -t->scale.middle : t->scale.middle;
  sb_transient_mesh(t, solver, problem->rest_film / t->scale.film);
  SbStatus status = lay_steady(t, &t->now, largest, scaled.speed, report);
  if (status != SB_OK) {
    return status;
  }
  double place, figure[2];
  read_figures(figure, &place, t);
  t->info.error_mesh = fmax(fabs(figure[0] * t->scale.film / largest->film_min - 1.0),
                            fabs(figure[1] * t->scale.film / largest->film_central - 1.0)) +
                       fmax(largest->solver.error_film_min, largest->solver.error_film_central);
  t->info.error_film_min = t->info.error_film_central = t->info.error_mesh;
  if (problem->rest_film > 0.0) {
    lay_rest(t, &t->now, problem->rest_film / t->scale.film);
  } else if (problem->film.speed != scaled.speed) {
    status = lay_steady(t, &t->now, &steady[1], problem->film.speed, report);
  }
  remember(t);
  return status;
}

SbStatus sb_film_transient_create(SbFilmTransient **out, const SbFilmTransientProblem *problem,
                                  SbReport *report) {
  *out = NULL;
  SbStatus status = check(problem, report);
  if (status != SB_OK) {
    return status;
  }
  struct {
    SbFilm film[2];
    SbFilmProfile profile[2];
  } *steady = malloc(sizeof *steady);
  SbFilmSolver *solver = NULL;
  status = steady != NULL ? sb_film_solver_create(&solver, report)
                          : sb_fail(report, SB_ERROR_MEMORY, "transient film: out of memory");
  // The steady film at the largest speed checks the problem, and the mesh's error by its own.
  SbFilmProblem film = problem->film;
  film.speed = (film.speed < 0.0 ? -1.0 : 1.0) * problem->speed_scale;
  if (status == SB_OK) {
    film.profile = &steady->profile[0];
    status = sb_film_solve(&steady->film[0], &film, solver, report);
  }
  if (status == SB_OK && steady->film[0].moes_M < 1.0) {
    status = sb_fail_parameter(report, SB_ERROR_RANGE, "drive.speed",
                               "transient film: M = %.3g is below 1", steady->film[0].moes_M);
  }
  if (status == SB_OK && problem->rest_film == 0.0 && problem->film.speed != film.speed) {
    film.speed = problem->film.speed;
    film.profile = &steady->profile[1];
    film.tolerance = fmin(film.tolerance, 1e-3);
    sb_film_solver_forget(solver);
    status = sb_film_solve(&steady->film[1], &film, solver, report);
  }
  SbFilmTransient *t = NULL;
  if (status == SB_OK) {
    status = begin(&t, problem, 1.0, steady->film, solver, report);
  }
  if (status == SB_OK) {
    status = begin(&t->companion, problem, 2.0, steady->film, solver, report);
    if (status == SB_ERROR_NOT_CONVERGED) {
      sb_film_transient_destroy(t->companion);
      t->companion = NULL;
      t->info.error_film_min = t->info.error_film_central = NAN;
      status = SB_OK;
    }
  }
  sb_film_solver_destroy(solver);
  free(steady);
  if (status != SB_OK) {
    sb_film_transient_destroy(t);
    return status;
  }
  *out = t;
  return sb_succeed(report);
}

// ---------------------------------------------------------------- steps

// Weights of the derivative at the new time by the new and the `count` last values, newest first.
static void derivative(double c[3], double h, const SbTransientPast *past, int count) {
  if (count < 2) {
    c[0] = 1.0 / h;
    c[1] = -1.0 / h;
    c[2] = 0.0;
    return;
  }
  const double before = past[0].time - past[1].time;
  c[0] = (2.0 * h + before) / (h * (h + before));
  c[1] = -(h + before) / (h * before);
  c[2] = h / (before * (h + before));
}

SbStatus sb_transient_advance(double *error, SbFilmTransient *t, double h, double speed) {
  double c[3];
  const SbTransientPast *past = t->past;
  const double time[] = {past[0].time, past[1].time, past[2].time};
  derivative(c, h, past, t->known_times);
  // Of the polynomial through the last heights, at the new time.
  double bary[3], ahead[3];
  sb_barycentric_weights(bary, time, t->known_times);
  sb_barycentric_basis(ahead, time[0] + h, time, bary, t->known_times);
  SbTransientState *s = &t->next;
  *s = t->now;
  s->time = t->now.time + h;
  s->travel = t->now.travel + 0.5 * h * (t->now.speed + speed);
  s->speed = speed;
  // First guess: straight on from the last two states.
  const double ratio = t->known_times >= 2 && t->now.time > t->before.time
                           ? h / (t->now.time - t->before.time)
                           : 0.0;
  for (int i = 0; i < t->nodes && ratio > 0.0; i++) {
    if (s->cavity[i] == t->before.cavity[i]) {
      const double m = sb_transient_height(s, i), rise = m - sb_transient_height(&t->before, i);
      s->P[i] = fmax(s->P[i] + ratio * (s->P[i] - t->before.P[i]), s->cavity[i] ? 0.0 : 1e-300);
      s->H[i] = fmax(s->H[i] + ratio * (s->H[i] - t->before.H[i]), 0.3 * s->H[i]);
      s->void_[i] = s->cavity[i] ? fmax(s->H[i] - fmax(m + ratio * rise, 0.3 * m), 0.0) : 0.0;
    }
  }
  s->H0 += ratio * (s->H0 - t->before.H0);
  double *old = t->work[0], *guess = t->work[1], *earlier = t->work[2];
  memset(t->work, 0, sizeof t->work);
  double carried_rate = 0.0;
  const bool carry = fabs(s->travel - t->now.travel) < t->reach;
  for (int k = 0; k < t->known_times; k++) {
    const double way = carry ? s->travel - past[k].travel : 0.0;
    sb_transient_carry(earlier, t, past[k].height, way);
    const double weight = k < 2 ? c[k + 1] : 0.0;
    carried_rate -= weight * way;
    for (int i = 0; i < t->nodes; i++) {
      old[i] += weight * earlier[i];
      guess[i] += ahead[k] * earlier[i];
    }
  }
  const SbTransientStep step = {
      .c0 = c[0],
      .old = old,
      .carried_rate = carried_rate,
  };
  SbTransientTrace trace;
  const SbStatus status = sb_transient_newton(&trace, t, s, &step);
  t->info.newton_iterations += (size_t)trace.iterations;
  if (status != SB_OK) {
    return status;
  }
  // Local error over the distance to the extrapolation: for BDF1 y'' h^2/2 against y'' h (h +
  // h1)/2, for BDF2 y'''/6 times the two products.
  double share = INFINITY;
  if (t->known_times >= 3) {
    const double h1 = past[0].time - past[1].time;
    const double h2 = past[1].time - past[2].time;
    const double own = h * h * (h + h1) * (h + h1) / (2.0 * h + h1);
    const double other = h * (h + h1) * (h + h1 + h2);
    share = own / (own + other);
  } else if (t->known_times == 2) {
    // The parabola is not known yet: the straight line's error bounds the step's.
    share = 0.5;
  }
  double sum = 0.0;
  double whole = 0.0;
  double largest = 0.0;
  for (int i = 0; i < t->nodes; i++) {
    if (fabs(t->X[i]) < 1.0) {
      const double height = sb_transient_height(s, i);
      sum += t->volume[i] * fabs(height - guess[i]);
      whole += t->volume[i] * height;
      largest = fmax(largest, fabs(height - guess[i]) / height);
    }
  }
  *error = t->known_times >= 2
               ? share * fmax(sum / whole, t->problem.resolve ? LOCAL * largest : 0.0)
               : INFINITY;
  t->info.load_error = fmax(t->info.load_error, trace.load_error);
  t->info.mass_error = fmax(t->info.mass_error, trace.mass_error);
  return SB_OK;
}

void sb_transient_accept(SbFilmTransient *t, double error) {
  // Fluid that leaves the contact takes its error with it.
  const double h = t->next.time - t->now.time;
  const double left = fmin(1.0, 0.5 * h * fabs(t->next.speed));
  t->info.error_time = t->info.error_time * (1.0 - left) + (isfinite(error) ? error : 0.0);
  t->before = t->now;
  t->now = t->next;
  remember(t);
  t->info.steps++;
}

// On to `end` with the speed going evenly to v1.
static SbStatus follow(SbFilmTransient *t, double end, double v1, SbReport *report) {
  const double begin = t->now.time, dt = end - begin;
  const double v0 = t->now.speed;
  const double limit = 0.1 * t->problem.film.tolerance * pow(t->coarseness, 3.0);
  const double transit = 2.0 * t->scale.half_width / (0.5 * t->problem.speed_scale);
  double h = t->step > 0.0 ? t->step : 1e-5 * transit;
  while (t->now.time < end - 1e-12 * dt) {
    if (cancelled(t)) {
      return sb_fail(report, SB_ERROR_CANCELLED, "transient film: cancelled");
    }
    const double rest = end - t->now.time;
    const double wanted = h;
    // A step goes one cell at most; the last two share what is left.
    const double v = t->now.speed, rate = (v1 - v0) / dt;
    const double way = TRAVEL * t->cell;
    if (t->problem.resolve) {
      h = fmin(h, 2.0 * way / (fabs(v) + sqrt(v * v + 2.0 * fabs(rate) * way)));
    }
    h = h >= rest ? rest : h > 0.5 * rest ? 0.5 * rest : h;
    const double share = (t->now.time + h - begin) / dt;
    double error;
    const SbStatus status = sb_transient_advance(&error, t, h, v0 + share * (v1 - v0));
    if (status == SB_ERROR_NOT_CONVERGED ||
        (status == SB_OK && error > limit && t->known_times >= 2)) {
      const double shrink = status == SB_OK ? fmax(0.2, 0.85 * cbrt(limit / error)) : 0.3;
      h *= shrink;
      if (h < 1e-12 * transit) {
        return sb_fail(report, SB_ERROR_NOT_CONVERGED,
                       "transient film: no step converges at %.6g s", t->now.time);
      }
      continue;
    }
    if (status != SB_OK) {
      return status;
    }
    sb_transient_accept(t, error);
    const double grow = fmin(2.0, 0.85 * cbrt(limit / fmax(error, 1e-300)));
    h = isfinite(error) ? h * fmax(grow, 0.3) : h;
    if (wanted > h && grow >= 1.0) {
      h = fmax(h, fmin(wanted, 2.0 * h)); // it was cut for the end only
    }
    t->step = h;
  }
  return sb_succeed(report);
}

// Takes the companion along, to the end of a piece that the fluid went `way` in; the difference of
// the films, or what is left in the contact of the largest before. Half of the difference: all of
// it is the error of a method of first order, a third of second order; fronts lie between.
static SbStatus compare(SbFilmTransient *t, double way) {
  SbFilmTransient *other = t->companion;
  double *error[2] = {&t->info.error_film_min, &t->info.error_film_central};
  if (other != NULL) {
    const SbStatus status = follow(other, t->now.time, t->now.speed, NULL);
    if (status == SB_ERROR_CANCELLED) {
      return status;
    }
    double fine[2], coarse[2], place;
    read_figures(coarse, &place, other);
    read_figures(fine, &place, t);
    // A dip that the coarse spacing does not know may go twice as deep again as its node lies below
    // the neighbours, for all that the two know.
    int at = 1;
    while (t->X[at] < place) {
      at++;
    }
    const double *H = t->now.H;
    const bool unknown = !t->problem.resolve && t->carried[at] > 0.0;
    const double bend = unknown ? fabs((H[at - 2] + H[at + 1]) / fine[0] - 2.0) : 0.0;
    t->way += way;
    for (int k = 0; k < 2; k++) {
      // A spacing for the mean film alone finds the least one with the first order.
      const double share = k == 0 && !t->problem.resolve ? 1.0 : 0.5;
      const double apart = share * fabs(coarse[k] / fine[k] - 1.0) + (k == 0 ? bend : 0.0);
      if (apart > t->apart[k] || t->way - t->apart_way[k] > 2.0) {
        t->apart[k] = apart;
        t->apart_way[k] = t->way;
      }
      *error[k] = status == SB_OK ? t->info.error_mesh + t->apart[k] : NAN;
    }
    if (status != SB_OK) {
      sb_film_transient_destroy(other);
      t->companion = NULL;
    }
  }
  return SB_OK;
}

SbStatus sb_film_transient_step(SbFilmTransient *t, double dt, double speed, SbReport *report) {
  enum { PIECES_MAX = 20 };
  if (!(dt > 0.0) || !(fabs(speed) <= 1.0001 * t->problem.speed_scale)) {
    return sb_fail(report, SB_ERROR_RANGE, "transient film: step %g s to %g m/s (scale %g)", dt,
                   speed, t->problem.speed_scale);
  }
  SbStatus status = SB_OK;
  const double begin = t->now.time;
  const double v0 = t->now.speed, v1 = 0.5 * speed / t->scale.half_width;
  const double way = 0.5 * dt * (fabs(v0) + fabs(v1));
  const int pieces = (int)ceil(fmin(fmax(way / 0.1, 1.0), PIECES_MAX));
  for (int k = 1; k <= pieces && status == SB_OK; k++) {
    const double share = (double)k / pieces;
    status = follow(t, begin + share * dt, v0 + share * (v1 - v0), report);
    if (status == SB_OK) {
      status = compare(t, way / pieces);
    }
  }
  return status;
}

// ---------------------------------------------------------------- results

SbFilmTransientInfo sb_film_transient_info(const SbFilmTransient *t) {
  return t->info;
}

void sb_film_transient_result(SbFilm *out, const SbFilmTransient *t) {
  const SbTransientState *s = &t->now;
  SbFilmProblem problem = t->problem.film;
  problem.speed = 2.0 * t->now.speed * t->scale.half_width;
  const SbFilmScale scale = sb_film_scale(&problem);
  sb_film_begin(out, &problem, &scale);
  const double unit = t->scale.half_width;
  double place, figure[2];
  read_figures(figure, &place, t);
  out->film_min = figure[0] * t->scale.film;
  out->film_central = figure[1] * t->scale.film;
  out->position_film_min = (t->middle + place) * unit;
  const int at_axis = t->nodes / 2;
  int highest = 0;
  double couette = 0.0;
  double poiseuille = 0.0;
  for (int i = 0; i + 1 < t->nodes; i++) {
    const double dx = t->X[i + 1] - t->X[i];
    highest = s->P[i] > s->P[highest] ? i : highest;
    if (!s->cavity[i] && !s->cavity[i + 1]) {
      couette += dx * 0.5 * (1.0 / s->H[i] + 1.0 / s->H[i + 1]);
      poiseuille += 0.25 * (s->H[i] + s->H[i + 1]) * (s->P[i + 1] - s->P[i]);
    }
  }
  out->film_flux = s->H[highest] * t->scale.film;
  out->flow = sb_transient_flow(t, s, at_axis) * unit * t->scale.film;
  out->pressure_max = s->P[highest] * t->scale.pressure + problem.rupture_pressure;
  out->friction_couette = problem.viscosity * problem.speed * couette * unit / t->scale.film;
  out->friction_poiseuille = poiseuille * t->scale.film * t->scale.pressure;
  // Where the film ends downstream: the first node in a cavity from the middle on.
  const int step = problem.speed >= 0.0 ? 1 : -1;
  int i = at_axis;
  while (i > 0 && i + 1 < t->nodes && !s->cavity[i]) {
    i += step;
  }
  out->ruptured = i > 0 && i + 1 < t->nodes;
  out->position_rupture = out->ruptured ? (t->middle + 0.5 * (t->X[i] + t->X[i - step])) * unit
                                        : (t->middle + step) * unit;
  out->solver = (SbFilmSolverInfo){
      .converged = true,
      .unknowns = (size_t)t->nodes - 1,
      .newton_iterations = (int)t->info.newton_iterations,
      .continuation_steps = (int)t->info.steps,
      .error_film_min = t->info.error_film_min,
      .error_film_central = t->info.error_film_central,
      .error_film_flux = t->info.error_film_central,
      .load_error = t->info.load_error,
      .flux_error = t->info.mass_error,
  };
  for (int k = 0; k < t->nodes; k++) {
    sb_film_put(out, (size_t)k, (t->middle + t->X[k]) * unit,
                s->P[k] * t->scale.pressure + problem.rupture_pressure, s->H[k] * t->scale.film);
  }
  sb_film_warn_common(out, &problem);
}
