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

enum { MESH_STEPS = 10 }; // that a mesh is laid for
static const double COARSER = 2.0, GROWTH = 2.0;
// of the cells, over the wall's way in a step

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

// The steady state at `speed` [m/s] from the spectral solution.
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
  const SbStatus status = sb_transient_newton(&trace, t, s, &none);
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

// Axis of the contact in X.
static double axis_of(const SbFilmTransient *t) {
  return t->compliance.modes > 0 ? 0.0 : -t->now.middle / t->now.half;
}

typedef struct {
  double film_min, film_central; // [m]
  double place;                  // of the least film, X
} Figures;

static Figures read_figures(const SbFilmTransient *t) {
  Figures out;
  out.film_min = least_film(&out.place, t, &t->now) * t->scale.film;
  out.film_central = film_at(t, &t->now, axis_of(t)) * t->scale.film;
  return out;
}

static void remember(SbFilmTransient *t) {
  for (int k = SB_TRANSIENT_TIMES - 1; k > 0; k--) {
    memcpy(t->content[k], t->content[k - 1], (size_t)t->nodes * sizeof(double));
    t->content_time[k] = t->content_time[k - 1];
    t->content_half[k] = t->content_half[k - 1];
    t->content_middle[k] = t->content_middle[k - 1];
    t->content_travel[k] = t->content_travel[k - 1];
  }
  for (int i = 0; i < t->nodes; i++) {
    t->content[0][i] = sb_transient_content(t, &t->now, i);
  }
  t->content_time[0] = t->now.time;
  t->content_half[0] = t->now.half;
  t->content_middle[0] = t->now.middle;
  t->content_travel[0] = t->travel;
  t->known_times += t->known_times < SB_TRANSIENT_TIMES;
}

static void destroy(SbFilmTransient *t) {
  if (t != NULL) {
    destroy(t->coarse);
    free(t->kernel);
    free(t->known);
    free(t->present);
    free(t->present_known);
    free(t->moment);
    free(t->matrix);
    free(t->right);
    free(t->pivot);
    free(t);
  }
}

static SbFilmTransient *allocate(void) {
  const size_t n = SB_TRANSIENT_NODES_MAX;
  SbFilmTransient *t = calloc(1, sizeof *t);
  if (t == NULL) {
    return NULL;
  }
  t->kernel = malloc(n * n * sizeof(double));
  t->known = malloc(n * sizeof(double));
  t->present = malloc(n * n * sizeof(double));
  t->present_known = malloc(n * sizeof(double));
  t->moment = malloc(SB_COMPLIANCE_MODES * n * sizeof(double));
  t->matrix = malloc(n * n * sizeof(double));
  t->right = malloc(n * sizeof(double));
  t->pivot = malloc(n * sizeof(int));
  if (t->kernel != NULL && t->known != NULL && t->present != NULL && t->present_known != NULL &&
      t->moment != NULL && t->matrix != NULL && t->right != NULL && t->pivot != NULL) {
    return t;
  }
  destroy(t);
  return NULL;
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

// One resolution from the steady films at speed_scale and at the start (NULL at rest).
static SbStatus begin(SbFilmTransient *t, const SbFilmTransientProblem *problem, double fineness,
                      const SbFilm *largest, const SbFilm *start, SbReport *report) {
  t->problem = *problem;
  if (problem->film.compliance != NULL) {
    t->compliance = *problem->film.compliance;
    t->problem.film.compliance = &t->compliance;
  }
  SbFilmProblem at_scale = problem->film;
  at_scale.speed = copysign(problem->speed_scale, problem->film.speed);
  t->scale = sb_film_scale(&at_scale);
  SbStatus status = SB_OK;
  if (problem->film.compliance != NULL) {
    SbDryContact dry;
    status = sb_film_scale_fitted(&t->scale, &dry, &at_scale, report);
  }
  if (status != SB_OK) {
    return status;
  }
  const double rupture = problem->film.rupture_pressure;
  t->fineness = fineness * cbrt(fmin(fmax(problem->film.tolerance, 1e-4), 1e-2) / 1e-3);
  t->limit = problem->film.tolerance * fineness * fineness * fineness;
  t->inlet = (problem->film.pressure_left - rupture) / t->scale.pressure;
  t->outlet = (problem->film.pressure_right - rupture) / t->scale.pressure;
  t->diffusion = t->scale.film * t->scale.film * t->scale.pressure /
                 (12.0 * problem->film.viscosity * t->scale.half_width * t->scale.half_width);
  t->flow = 0.5 * problem->speed_scale / t->scale.half_width * largest->film_flux / t->scale.film;
  t->now.load = 0.5 * M_PI;
  t->now.half = 1.0;
  t->now.middle = copysign(t->scale.middle, problem->film.speed);
  sb_transient_mesh(t, problem->rest_film / t->scale.film);
  status = lay_steady(t, &t->now, largest, at_scale.speed, report);
  if (status != SB_OK) {
    return status;
  }
  const Figures figures = read_figures(t);
  t->info.error_film_min =
      fabs(figures.film_min / largest->film_min - 1.0) + largest->solver.error_film_min;
  t->info.error_film_central =
      fabs(figures.film_central / largest->film_central - 1.0) + largest->solver.error_film_central;
  t->steady_error[0] = t->info.error_film_min;
  t->steady_error[1] = t->info.error_film_central;
  if (start == NULL) {
    t->now.speed = 0.0;
    status = sb_transient_rest(t, &t->now, problem->rest_film / t->scale.film);
    if (status != SB_OK) {
      sb_fail(report, status, "transient film: no dry contact to start from");
    }
  } else if (start != largest) {
    status = lay_steady(t, &t->now, start, problem->film.speed, report);
  }
  t->info.speed = problem->film.speed;
  t->info.load = problem->film.load;
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
  SbFilm *steady = malloc(2 * sizeof *steady);
  SbFilmTransient *t = allocate();
  if (t != NULL) {
    t->coarse = allocate();
  }
  if (steady == NULL || t == NULL || t->coarse == NULL) {
    free(steady);
    destroy(t);
    return sb_fail(report, SB_ERROR_MEMORY, "transient film: out of memory");
  }
  // The steady film at the largest speed checks the problem, and the mesh's error by its own.
  SbFilmProblem film = problem->film;
  film.speed = copysign(problem->speed_scale, problem->film.speed);
  film.tolerance = fmin(film.tolerance, 1e-3);
  const bool same = film.speed == problem->film.speed;
  const SbFilm *start = problem->rest_film > 0.0 ? NULL : same ? steady : steady + 1;
  status = sb_film_solve(steady, &film, NULL, report);
  if (status == SB_OK && steady->moes_M < 1.0) {
    status = sb_fail_parameter(report, SB_ERROR_RANGE, "drive.speed",
                               "transient film: M = %.3g is below 1", steady->moes_M);
  }
  if (status == SB_OK && start == steady + 1) {
    film.speed = problem->film.speed;
    status = sb_film_solve(steady + 1, &film, NULL, report);
  }
  if (status == SB_OK) {
    status = begin(t, problem, 1.0, steady, start, report);
  }
  if (status == SB_OK) {
    status = begin(t->coarse, problem, COARSER, steady, start, report);
  }
  free(steady);
  if (status != SB_OK) {
    destroy(t);
    return status;
  }
  *out = t;
  return sb_succeed(report);
}

void sb_film_transient_destroy(SbFilmTransient *t) {
  destroy(t);
}

// ---------------------------------------------------------------- steps

// Of the polynomial through the value after a step h and the `count` last ones: weights c of its
// derivative there, the new value first. Of that through the last count + 1 alone: weights e of its
// value there; *share of the two's difference that is the step's own error.
static void weights(double *c, double *e, double *share, double h, const double *time, int count) {
  double ago[SB_TRANSIENT_TIMES + 1] = {0.0}; // the new time less the others
  double own = 1.0;
  c[0] = 0.0;
  for (int k = 1; k <= count + 1; k++) {
    ago[k] = time[0] + h - time[k - 1];
    c[0] += k <= count ? 1.0 / ago[k] : 0.0;
    own *= k <= count ? ago[k] : 1.0;
  }
  for (int k = 1; k <= count + 1; k++) {
    c[k] = -1.0 / ago[k];
    e[k - 1] = 1.0;
    for (int j = 1; j <= count + 1; j++) {
      if (j != k) {
        e[k - 1] *= ago[j] / (ago[j] - ago[k]);
        c[k] *= j <= count ? ago[j] / (ago[j] - ago[k]) : 1.0;
      }
    }
  }
  *share = own / c[0] / (own / c[0] + own * ago[count + 1]);
}

// Travel of the wall, over the half-width, in a step to `speed`; speeds go evenly.
static double way_of(const SbFilmTransient *t, double h, double speed) {
  return 0.5 * h * (t->now.speed + speed) / t->now.half;
}

// One implicit step of length h to the given speed and load, from `now` to `next`; *error is the
// step's own, the largest of any cell in the contact by its content, infinite while unknown.
static SbStatus advance(double *error, SbFilmTransient *t, double h, double speed, double load) {
  double c[SB_TRANSIENT_TIMES + 1], e[SB_TRANSIENT_TIMES], share = INFINITY;
  const int count = t->known_times > 1 ? t->known_times - 1 : 1;
  if (t->known_times > 1) {
    weights(c, e, &share, h, t->content_time, count);
  } else {
    c[0] = 1.0 / h;
    c[1] = -1.0 / h;
    e[0] = 1.0;
  }
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
  double *old = t->scratch[0], *guess = t->scratch[1], *content = t->scratch[5];
  memset(old, 0, sizeof t->scratch[0]);
  memset(guess, 0, sizeof t->scratch[1]);
  const double way = way_of(t, h, speed);
  SbTransientStep step = {.c0 = c[0],
                          .lag = fmax(8.0 * fabs(way), 8.0 * t->layer),
                          .old = old,
                          .half_rate = c[0] * s->half,
                          .middle_rate = c[0] * s->middle};
  for (int k = 0; k < t->known_times; k++) {
    sb_transient_depart(content, t, t->content[k], t->travel + way - t->content_travel[k],
                        step.lag);
    for (int i = 0; i < t->nodes; i++) {
      old[i] += k < count ? c[k + 1] * content[i] : 0.0;
      guess[i] += e[k] * content[i];
    }
    step.half_rate += k < count ? c[k + 1] * t->content_half[k] : 0.0;
    step.middle_rate += k < count ? c[k + 1] * t->content_middle[k] : 0.0;
  }
  for (int i = 0; i < t->nodes; i++) {
    if (fabs(t->X[i]) < 1.0 && !s->cavity[i]) {
      s->H[i] = fmax(guess[i] / (s->half * t->volume[i]), 0.3 * s->H[i]);
    }
  }
  SbTransientTrace trace;
  status = sb_transient_newton(&trace, t, s, &step);
  t->info.newton_iterations += (size_t)trace.iterations;
  t->info.factorisations += (size_t)trace.factorisations;
  if (status != SB_OK) {
    return status;
  }
  *error = isfinite(share) ? 0.0 : INFINITY;
  for (int i = 0; i < t->nodes && isfinite(share); i++) {
    if (fabs(t->X[i]) < 1.0) {
      *error = fmax(*error, share * fabs(sb_transient_content(t, s, i) / guess[i] - 1.0));
    }
  }
  t->info.load_error = fmax(t->info.load_error, trace.load_error);
  t->info.mass_error = fmax(t->info.mass_error, trace.mass_error);
  return SB_OK;
}

static void accept(SbFilmTransient *t) {
  t->travel += way_of(t, t->next.time - t->now.time, t->next.speed);
  t->mesh_steps++;
  t->before = t->now;
  t->now = t->next;
  remember(t);
  t->info.steps++;
  t->info.unknowns = (size_t)t->nodes;
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

// One resolution through `dt` with error control.
static SbStatus step_level(SbFilmTransient *t, double dt, double v1, double load1,
                           SbReport *report) {
  const double begin = t->now.time;
  const double v0 = t->now.speed, load0 = t->now.load;
  const double order = 1.0 / SB_TRANSIENT_TIMES;
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
    const double speed = v0 + share * (v1 - v0);
    const double way = way_of(t, h, speed);
    if (t->mesh_steps >= MESH_STEPS || t->travel + way < t->span[0] ||
        t->travel + way > t->span[1]) {
      sb_transient_adapt(t, fmin(fmax(MESH_STEPS * way, -0.1), 0.1));
    }
    double error;
    SbStatus status = advance(&error, t, h, speed, load0 + share * (load1 - load0));
    if (status == SB_ERROR_NOT_CONVERGED ||
        (status == SB_OK && error > t->limit && t->known_times >= 2)) {
      t->info.rejected++;
      const double shrink = status == SB_OK ? fmax(0.2, 0.85 * pow(t->limit / error, order)) : 0.3;
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
    accept(t);
    const double grow = fmin(GROWTH, 0.85 * pow(t->limit / fmax(error, 1e-300), order));
    h = isfinite(error) ? h * fmax(grow, 0.3) : h;
    if (wanted > h && grow >= 1.0) {
      h = fmax(h, fmin(wanted, GROWTH * h)); // it was cut for the end only
    }
    t->step = h;
  }
  return SB_OK;
}

static SbStatus step_even(SbFilmTransient *t, double dt, size_t count, double v1, double load1,
                          SbReport *report) {
  const double v0 = t->now.speed, load0 = t->now.load;
  for (size_t k = 1; k <= count; k++) {
    const double share = (double)k / (double)count;
    double error;
    const SbStatus status = advance(&error, t, dt / (double)count, v0 + share * (v1 - v0),
                                    load0 + share * (load1 - load0));
    if (status != SB_OK) {
      return sb_fail(report, status, "transient film: step %zu of %zu does not converge", k, count);
    }
    accept(t);
  }
  return SB_OK;
}

// Both resolutions; `count` 0 for error control.
static SbStatus step_both(SbFilmTransient *t, double dt, size_t count, double speed, double load,
                          SbReport *report) {
  SbStatus status = check_step(dt, speed, load, t, report);
  const double v = 0.5 * speed / t->scale.half_width;
  const double W = load / t->problem.film.load * 0.5 * M_PI;
  for (SbFilmTransient *level = t; status == SB_OK && level != NULL; level = level->coarse) {
    status =
        count > 0 ? step_even(level, dt, count, v, W, report) : step_level(level, dt, v, W, report);
  }
  if (status != SB_OK) {
    return status;
  }
  const Figures fine = read_figures(t), coarse = read_figures(t->coarse);
  const double kept = exp(-dt * fabs(v));
  t->past[0] = fmax(kept * t->past[0], fabs(coarse.film_min / fine.film_min - 1.0));
  t->past[1] = fmax(kept * t->past[1], fabs(coarse.film_central / fine.film_central - 1.0));
  t->info.error_film_min = t->past[0] + t->steady_error[0];
  t->info.error_film_central = t->past[1] + t->steady_error[1];
  return sb_succeed(report);
}

SbStatus sb_film_transient_step(SbFilmTransient *t, double dt, double speed, double load,
                                SbReport *report) {
  return step_both(t, dt, 0, speed, load, report);
}

SbStatus sb_film_transient_fixed(SbFilmTransient *t, double dt, size_t count, double speed,
                                 double load, SbReport *report) {
  return step_both(t, dt, count, speed, load, report);
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
  const Figures figures = read_figures(t);
  out->film_min = figures.film_min;
  out->film_central = figures.film_central;
  out->position_film_min = (s->middle + s->half * figures.place) * unit;
  const double axis = axis_of(t);
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
      .error_film_min = t->info.error_film_min,
      .error_film_central = t->info.error_film_central,
      .error_film_flux = t->info.error_film_central,
      .load_error = t->info.load_error,
      .flux_error = t->info.mass_error,
  };
  out->points = (size_t)t->nodes;
  for (int k = 0; k < t->nodes; k++) {
    out->x[k] = (s->middle + s->half * t->X[k]) * unit;
    out->pressure[k] = s->P[k] * t->scale.pressure + problem.rupture_pressure;
    out->film[k] = s->H[k] * t->scale.film;
  }
  sb_film_warn_common(out, &problem);
}
