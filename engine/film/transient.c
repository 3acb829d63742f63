// Initial states, time steps and results of the transient film; equations in transient.h.
//
// BDF2 on the content half m of the cells with uneven steps; the difference to the parabola
// through the last three contents gives the step's own error (of the third order), whose mean over
// the contact is held to a share of the tolerance.
#include "engine/film/transient.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "engine/film/transient_internal.h"

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
  size_t low = 0;
  size_t high = profile->points - 1;
  while (high - low > 1) {
    const size_t middle = (low + high) / 2;
    if (profile->x[middle] <= x) {
      low = middle;
    } else {
      high = middle;
    }
  }
  const double span = profile->x[high] - profile->x[low];
  const double s = span > 0.0 ? (x - profile->x[low]) / span : 0.0;
  *film = profile->film[low] + s * (profile->film[high] - profile->film[low]);
  *pressure = profile->pressure[low] + s * (profile->pressure[high] - profile->pressure[low]);
  return true;
}

// Steady state at `speed` [m/s] from the spectral solution, which is left in `steady`.
static SbStatus solve_steady(SbFilm *steady, SbFilmTransient *t, SbTransientState *s, double speed,
                             SbReport *report) {
  SbFilmProblem problem = t->problem.film;
  problem.speed = speed;
  problem.tolerance = fmin(problem.tolerance, 1e-3);
  SbStatus status = sb_film_solve(steady, &problem, NULL, report);
  if (status != SB_OK) {
    return status;
  }
  const double flux = steady->film_flux / t->scale.film;
  const double end = speed > 0.0 ? 1.0 : -1.0;
  const double rupture = problem.rupture_pressure;
  s->speed = 0.5 * speed / t->scale.half_width;
  for (int i = 0; i < t->nodes; i++) {
    const double X = t->X[i];
    double film, pressure;
    s->cavity[i] = false;
    s->void_[i] = 0.0;
    s->P[i] = (X < 0.0 ? t->inlet : t->outlet);
    s->H[i] = flux + sb_film_dry_gap(X);
    const double x = (s->middle + s->half * X) * t->scale.half_width;
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
  status = sb_transient_newton(&trace, t, s, &none);
  t->info.newton_iterations += (size_t)trace.iterations;
  t->info.factorisations += (size_t)trace.factorisations;
  if (status != SB_OK) {
    return sb_fail(report, status, "transient film: no steady state on the mesh of finite volumes");
  }
  return SB_OK;
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

// Film at X by the cubic through four nodes.
static double film_at(const SbFilmTransient *t, const SbTransientState *s, double X) {
  int i = 1;
  while (i + 3 < t->nodes && t->X[i + 1] < X) {
    i++;
  }
  double sum = 0.0;
  for (int j = i - 1; j <= i + 2; j++) {
    double basis = 1.0;
    for (int k = i - 1; k <= i + 2; k++) {
      basis *= k == j ? 1.0 : (X - t->X[k]) / (t->X[j] - t->X[k]);
    }
    sum += basis * s->H[j];
  }
  return sum;
}

static void remember(SbFilmTransient *t) {
  memmove(t->content[1], t->content[0], 2 * sizeof t->content[0]);
  memmove(&t->content_time[1], &t->content_time[0], 2 * sizeof(double));
  memmove(&t->content_half[1], &t->content_half[0], 2 * sizeof(double));
  memmove(&t->content_middle[1], &t->content_middle[0], 2 * sizeof(double));
  for (int i = 0; i < t->nodes; i++) {
    t->content[0][i] = t->now.half * sb_transient_height(&t->now, i);
  }
  t->content_time[0] = t->now.time;
  t->content_half[0] = t->now.half;
  t->content_middle[0] = t->now.middle;
  t->known_times = t->known_times < 3 ? t->known_times + 1 : 3;
}

static bool allocate(SbFilmTransient *t) {
  const size_t n = SB_TRANSIENT_NODES_MAX;
  t->kernel = malloc(n * n * sizeof(double));
  t->known = malloc(n * sizeof(double));
  t->present = malloc(n * n * sizeof(double));
  t->present_known = malloc(n * sizeof(double));
  t->matrix = malloc(n * n * sizeof(double));
  t->right = malloc(n * sizeof(double));
  t->pivot = malloc(n * sizeof(int));
  return t->kernel != NULL && t->known != NULL && t->present != NULL && t->present_known != NULL &&
         t->matrix != NULL && t->right != NULL && t->pivot != NULL;
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

SbStatus sb_film_transient_create(SbFilmTransient **out, const SbFilmTransientProblem *problem,
                                  SbReport *report) {
  *out = NULL;
  SbStatus status = check(problem, report);
  if (status != SB_OK) {
    return status;
  }
  // The steady film at the largest speed checks the problem, and the mesh's error by its own.
  const double sign = problem->film.speed < 0.0 ? -1.0 : 1.0;
  SbFilm *steady = malloc(sizeof *steady);
  SbFilmProfile *profile = malloc(sizeof *profile); // of `steady`
  SbFilmTransient *t = calloc(1, sizeof *t);
  if (t == NULL || steady == NULL || profile == NULL || !allocate(t)) {
    free(steady);
    free(profile);
    sb_film_transient_destroy(t);
    return sb_fail(report, SB_ERROR_MEMORY, "transient film: out of memory");
  }
  t->problem = *problem;
  t->problem.film.profile = profile;
  if (problem->film.compliance != NULL) {
    t->compliance = *problem->film.compliance;
    t->problem.film.compliance = &t->compliance;
  }
  SbFilmProblem largest = problem->film;
  largest.speed = sign * problem->speed_scale;
  status = sb_film_solve(steady, &largest, NULL, report);
  if (status == SB_OK && steady->moes_M < 1.0) {
    status = sb_fail_parameter(report, SB_ERROR_RANGE, "drive.speed",
                               "transient film: M = %.3g is below 1", steady->moes_M);
  }
  if (status == SB_OK) {
    t->scale = sb_film_scale(&largest);
    SbDryContact dry;
    if (problem->film.compliance != NULL) {
      status = sb_film_scale_fitted(&t->scale, &dry, &largest, report);
    }
  }
  if (status == SB_OK) {
    const double rupture = problem->film.rupture_pressure;
    t->inlet = (problem->film.pressure_left - rupture) / t->scale.pressure;
    t->outlet = (problem->film.pressure_right - rupture) / t->scale.pressure;
    t->diffusion = t->scale.film * t->scale.film * t->scale.pressure /
                   (12.0 * problem->film.viscosity * t->scale.half_width * t->scale.half_width);
    t->flow = 0.5 * problem->speed_scale / t->scale.half_width * steady->film_flux / t->scale.film;
    t->now.load = 0.5 * M_PI;
    t->now.half = 1.0;
    t->now.middle = sign * t->scale.middle;
    sb_transient_mesh(t, problem->rest_film / t->scale.film);
    status = solve_steady(steady, t, &t->now, largest.speed, report);
  }
  if (status == SB_OK) {
    double place;
    const double least = least_film(&place, t, &t->now) * t->scale.film;
    const double central = film_at(t, &t->now, 0.0) * t->scale.film;
    t->steady_error =
        fmax(fabs(least / steady->film_min - 1.0), fabs(central / steady->film_central - 1.0)) +
        fmax(steady->solver.error_film_min, steady->solver.error_film_central);
    t->info.error_mesh = t->steady_error;
    if (problem->rest_film > 0.0) {
      t->now.speed = 0.0;
      status = sb_transient_rest(t, &t->now, problem->rest_film / t->scale.film);
      if (status != SB_OK) {
        status = sb_fail(report, status, "transient film: no dry contact to start from");
      }
    } else if (problem->film.speed != largest.speed) {
      status = solve_steady(steady, t, &t->now, problem->film.speed, report);
    }
  }
  free(steady);
  free(profile);
  t->problem.film.profile = problem->film.profile;
  if (status != SB_OK) {
    sb_film_transient_destroy(t);
    return status;
  }
  t->info.unknowns = (size_t)t->nodes - 1;
  t->info.speed = problem->film.speed;
  t->info.load = problem->film.load;
  remember(t);
  *out = t;
  return sb_succeed(report);
}

void sb_film_transient_destroy(SbFilmTransient *t) {
  if (t != NULL) {
    free(t->kernel);
    free(t->known);
    free(t->present);
    free(t->present_known);
    free(t->matrix);
    free(t->right);
    free(t->pivot);
    free(t);
  }
}

// ---------------------------------------------------------------- steps

// Weights of the derivative at the new time by the new and the `count` last values, newest first.
static void derivative(double c[3], double h, const double *time, int count) {
  if (count < 2) {
    c[0] = 1.0 / h;
    c[1] = -1.0 / h;
    c[2] = 0.0;
    return;
  }
  const double before = time[0] - time[1];
  c[0] = (2.0 * h + before) / (h * (h + before));
  c[1] = -(h + before) / (h * before);
  c[2] = h / (before * (h + before));
}

// Value at the new time of the polynomial through the `count` last ones.
static void extrapolation(double e[3], double h, const double *time, int count) {
  const double now = time[0] + h;
  for (int k = 0; k < 3; k++) {
    e[k] = k < count ? 1.0 : 0.0;
    for (int j = 0; j < count && k < count; j++) {
      e[k] *= j == k ? 1.0 : (now - time[j]) / (time[k] - time[j]);
    }
  }
}

// One implicit step of length h to the given speed and load, from `now` to `next`; *error is the
// step's own, the mean over the contact against the mean film, infinite while unknown.
static SbStatus advance(double *error, SbFilmTransient *t, double h, double speed, double load) {
  double c[3], e[3];
  derivative(c, h, t->content_time, t->known_times);
  extrapolation(e, h, t->content_time, t->known_times);
  SbTransientState *s = &t->next;
  *s = t->now;
  s->time = t->now.time + h;
  s->speed = speed;
  s->load = load;
  SbStatus status = SB_OK;
  if (load != t->now.load) { // else the contact stays where it is
    status = sb_transient_place(&s->half, &s->middle, t, load, NULL);
  }
  if (status != SB_OK) {
    return status;
  }
  // First guess: straight on from the last two states.
  const double ratio = t->known_times >= 2 && t->now.time > t->before.time
                           ? h / (t->now.time - t->before.time)
                           : 0.0;
  for (int i = 0; i < t->nodes && ratio > 0.0; i++) {
    if (s->cavity[i] == t->before.cavity[i]) {
      s->P[i] = fmax(s->P[i] + ratio * (s->P[i] - t->before.P[i]), s->cavity[i] ? 0.0 : 1e-300);
      s->H[i] = fmax(s->H[i] + ratio * (s->H[i] - t->before.H[i]), 0.3 * s->H[i]);
      s->void_[i] = fmax(s->void_[i] + ratio * (s->void_[i] - t->before.void_[i]), 0.0);
      s->void_[i] = fmin(s->void_[i], 0.999 * s->H[i]);
    }
  }
  s->H0 += ratio * (s->H0 - t->before.H0);
  double old[SB_TRANSIENT_NODES_MAX];
  double guess[SB_TRANSIENT_NODES_MAX];
  for (int i = 0; i < t->nodes; i++) {
    old[i] = c[1] * t->content[0][i] + c[2] * t->content[1][i];
    guess[i] = e[0] * t->content[0][i] + e[1] * t->content[1][i] + e[2] * t->content[2][i];
  }
  const SbTransientStep step = {
      .c0 = c[0],
      .old = old,
      .half_rate = c[0] * s->half + c[1] * t->content_half[0] + c[2] * t->content_half[1],
      .middle_rate = c[0] * s->middle + c[1] * t->content_middle[0] + c[2] * t->content_middle[1],
  };
  SbTransientTrace trace;
  status = sb_transient_newton(&trace, t, s, &step);
  t->info.newton_iterations += (size_t)trace.iterations;
  t->info.factorisations += (size_t)trace.factorisations;
  if (status != SB_OK) {
    return status;
  }
  // Local error over the distance to the extrapolation: for BDF1 y'' h^2/2 against y'' h (h +
  // h1)/2, for BDF2 y'''/6 times the two products.
  double share = INFINITY;
  if (t->known_times >= 3) {
    const double h1 = t->content_time[0] - t->content_time[1];
    const double h2 = t->content_time[1] - t->content_time[2];
    const double own = h * h * (h + h1) * (h + h1) / (2.0 * h + h1);
    const double other = h * (h + h1) * (h + h1 + h2);
    share = own / (own + other);
  } else if (t->known_times == 2) {
    // The parabola is not known yet: the straight line's error bounds the step's.
    share = 0.5;
  }
  double sum = 0.0;
  double whole = 0.0;
  for (int i = 0; i < t->nodes; i++) {
    if (fabs(t->X[i]) < 1.0) {
      const double content = s->half * sb_transient_height(s, i);
      sum += t->volume[i] * fabs(content - guess[i]);
      whole += t->volume[i] * content;
    }
  }
  *error = t->known_times >= 2 ? share * sum / whole : INFINITY;
  t->info.load_error = fmax(t->info.load_error, trace.load_error);
  t->info.mass_error = fmax(t->info.mass_error, trace.mass_error);
  return SB_OK;
}

static void accept(SbFilmTransient *t, double error) {
  // Fluid that leaves the contact takes its error with it.
  const double h = t->next.time - t->now.time;
  const double left = fmin(1.0, 0.5 * h * fabs(t->next.speed) / t->next.half);
  t->info.error_time = t->info.error_time * (1.0 - left) + (isfinite(error) ? error : 0.0);
  t->transport = t->transport * (1.0 - left) + h * sb_transient_smear(t, &t->next);
  t->info.error_mesh = t->steady_error + t->transport;
  t->before = t->now;
  t->now = t->next;
  remember(t);
  t->info.steps++;
  t->info.time = t->now.time;
  t->info.speed = 2.0 * t->now.speed * t->scale.half_width;
  t->info.load = t->now.load / (0.5 * M_PI) * t->problem.film.load;
}

static SbStatus check_step(double dt, double speed, double load, const SbFilmTransient *t,
                           SbReport *report) {
  if (!(dt > 0.0) || !(fabs(speed) <= 1.0001 * t->problem.speed_scale) ||
      !(load > 0.05 * t->problem.film.load && load < 20.0 * t->problem.film.load)) {
    return sb_fail(report, SB_ERROR_RANGE,
                   "transient film: step %g s to %g m/s (scale %g) and %g N/m (start %g)", dt,
                   speed, t->problem.speed_scale, load, t->problem.film.load);
  }
  return SB_OK;
}

SbStatus sb_film_transient_step(SbFilmTransient *t, double dt, double speed, double load,
                                SbReport *report) {
  SbStatus status = check_step(dt, speed, load, t, report);
  if (status != SB_OK) {
    return status;
  }
  const double begin = t->now.time;
  const double v0 = t->now.speed, v1 = 0.5 * speed / t->scale.half_width;
  const double load0 = t->now.load, load1 = load / t->problem.film.load * 0.5 * M_PI;
  // The history's slope breaks here: start small.
  const double limit = 0.1 * t->problem.film.tolerance;
  const double transit = 2.0 * t->scale.half_width / (0.5 * t->problem.speed_scale);
  double h = fmin(t->step > 0.0 ? t->step : 1e-5 * transit, dt);
  while (t->now.time < begin + dt * (1.0 - 1e-12)) {
    if (cancelled(t)) {
      return sb_fail(report, SB_ERROR_CANCELLED, "transient film: cancelled");
    }
    const double rest = begin + dt - t->now.time;
    const double wanted = h;
    // The last two steps share what is left.
    h = h >= rest ? rest : h > 0.5 * rest ? 0.5 * rest : h;
    const double share = (t->now.time + h - begin) / dt;
    double error;
    status = advance(&error, t, h, v0 + share * (v1 - v0), load0 + share * (load1 - load0));
    if (status == SB_ERROR_NOT_CONVERGED ||
        (status == SB_OK && error > limit && t->known_times >= 2)) {
      t->info.rejected++;
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
    accept(t, error);
    const double grow = fmin(2.0, 0.85 * cbrt(limit / fmax(error, 1e-300)));
    h = isfinite(error) ? h * fmax(grow, 0.3) : h;
    if (wanted > h && grow >= 1.0) {
      h = fmax(h, fmin(wanted, 2.0 * h)); // it was cut for the end only
    }
    t->step = h;
  }
  return sb_succeed(report);
}

SbStatus sb_film_transient_fixed(SbFilmTransient *t, double dt, size_t count, double speed,
                                 double load, SbReport *report) {
  SbStatus status = check_step(dt, speed, load, t, report);
  const double v0 = t->now.speed, v1 = 0.5 * speed / t->scale.half_width;
  const double load0 = t->now.load, load1 = load / t->problem.film.load * 0.5 * M_PI;
  for (size_t k = 1; k <= count && status == SB_OK; k++) {
    const double share = (double)k / (double)count;
    double error;
    status = advance(&error, t, dt / (double)count, v0 + share * (v1 - v0),
                     load0 + share * (load1 - load0));
    if (status == SB_OK) {
      accept(t, error);
    } else {
      status =
          sb_fail(report, status, "transient film: step %zu of %zu does not converge", k, count);
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
  problem.speed = t->info.speed;
  problem.load = t->info.load;
  const SbFilmScale scale = sb_film_scale(&problem);
  sb_film_begin(out, &problem, &scale);
  const double unit = t->scale.half_width;
  double place;
  out->film_min = least_film(&place, t, s) * t->scale.film;
  out->position_film_min = (s->middle + s->half * place) * unit;
  const double axis = t->compliance.modes > 0 ? 0.0 : -s->middle / s->half;
  out->film_central = film_at(t, s, axis) * t->scale.film;
  int at_axis = 1;
  int highest = 0;
  double couette = 0.0;
  double poiseuille = 0.0;
  for (int i = 0; i + 1 < t->nodes; i++) {
    const double dx = s->half * (t->X[i + 1] - t->X[i]);
    at_axis = t->X[i] <= axis ? i : at_axis;
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
  out->position_rupture =
      out->ruptured ? (s->middle + s->half * (t->X[i] - 0.5 * (t->X[i] - t->X[i - step]))) * unit
                    : (s->middle + step * s->half) * unit;
  out->solver = (SbFilmSolverInfo){
      .converged = true,
      .unknowns = t->info.unknowns,
      .newton_iterations = (int)t->info.newton_iterations,
      .continuation_steps = (int)t->info.steps,
      .error_film_min = t->info.error_mesh + t->info.error_time,
      .error_film_central = t->info.error_mesh + t->info.error_time,
      .error_film_flux = t->info.error_mesh + t->info.error_time,
      .load_error = t->info.load_error,
      .flux_error = t->info.mass_error,
  };
  for (int k = 0; k < t->nodes; k++) {
    sb_film_put(out, (size_t)k, (s->middle + s->half * t->X[k]) * unit,
                s->P[k] * t->scale.pressure + problem.rupture_pressure, s->H[k] * t->scale.film);
  }
  sb_film_warn_common(out, &problem);
}
