// Initial states, time steps and results of the transient film; equations in transient.h.
//
// BDF2 on the fluid height m of the cells with uneven steps. The difference from the parabola
// through the last three heights gives the local error of the step (third order), whose mean over
// the contact must be below a fraction of the tolerance.
//
// Long: the history of BDF2 is begun, moved to other meshes and advanced here only.
#include "engine/film/ehl_transient.h"

#include "engine/numeric/legendre.h"
#include "engine/numeric/root.h"

#include <cblas.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

// Largest local error of a step divided by that of the mean: the minimum film is local.
static const double LOCAL = 0.3;

// A smaller film pressure counts as none when a profile is transferred to the mesh.
static const double NOTHING = 1e-10;

// Distance that the fluid moves before a new mesh is due [b].
static const double AHEAD = 0.03;

static bool cancelled(const SbFilmTransient *t) {
  const SbFilmProblem *p = &t->problem.film;
  return p->cancelled != NULL && p->cancelled(p->cancelled_data);
}

// ---------------------------------------------------------------- initial states

// Solves the steady state near the present one: directly, or, if the active set of the rupture does
// not settle, by time steps of increasing length.
static SbStatus settle(SbFilmTransient *t) {
  SbTransientState *s = &t->now;
  t->next = *s;
  SbStatus status = sb_transient_newton(t, s);
  if (status != SB_OK) {
    *s = t->next;
    for (double rate = 1e5; rate > 0.5; rate *= 0.1) {
      t->c0 = rate * fabs(s->speed);
      for (int i = 0; i < t->nodes; i++) {
        t->old[i] = -t->c0 * s->m[i];
      }
      if (sb_transient_newton(t, s) != SB_OK) {
        break;
      }
    }
    t->c0 = 0.0;
    memset(t->old, 0, sizeof t->old);
    status = sb_transient_newton(t, s);
  }
  return status;
}

// A quantity of a profile at x [m] between its ends, by straight lines.
static double read_at(const SbFilm *film, const double *value, double x) {
  const size_t k = sb_interval(film->x, film->points, x);
  return value[k] + (x - film->x[k]) / (film->x[k + 1] - film->x[k]) * (value[k + 1] - value[k]);
}

// Total pressure, film pressure and gap of a profile. Beyond its ends the pressures are those of
// the surroundings, and the gap is that of the body under all these pressures, joined to the
// profile's: where a film begins at rest its fluid stays in the gaps, and in wrong gaps it would
// be squeezed.
static void lay_profile(SbFilmTransient *t, const SbFilm *film) {
  SbTransientState *s = &t->now;
  const SbFilmScale *scale = &t->scale;
  const double b = scale->half_width, *ends = film->x;
  int first = t->nodes - 1, last = 0; // nodes between the ends
  for (int i = 0; i < t->nodes; i++) {
    const double x = (scale->middle + t->X[i]) * b;
    s->P[i] = s->Q[i] = t->X[i] < 0.0 ? scale->inlet : scale->outlet;
    s->cavity[i] = false;
    if (x >= ends[0] && x <= ends[film->points - 1]) {
      const double pressure = read_at(film, film->pressure, x) - t->problem.film.rupture_pressure;
      s->Q[i] = pressure / scale->pressure;
      s->P[i] = s->Q[i] - read_at(film, film->asperity_pressure, x) / scale->pressure;
      first = i < first ? i : first;
      last = i;
    }
  }
  s->H0 = 0.0;
  sb_transient_gap(s->H, t, s);
  const double left = s->H[first], right = s->H[last];
  for (int i = 0; i < t->nodes; i++) {
    const int from = i < first ? first : i > last ? last : i;
    const double beyond = i < first ? s->H[i] - left : i > last ? s->H[i] - right : 0.0;
    const double x = (scale->middle + t->X[from]) * b;
    s->H[i] = read_at(film, film->film, x) / scale->film + beyond;
  }
}

// Steady state from the spectral solution at `speed` [m/s].
static SbStatus lay_steady(SbFilmTransient *t, const SbFilm *steady, double speed,
                           SbReport *report) {
  SbTransientState *s = &t->now;
  const SbFilmScale *scale = &t->scale;
  s->speed = 0.5 * speed / scale->half_width;
  lay_profile(t, steady);
  for (int i = 0; i < t->nodes; i++) {
    const double x = (scale->middle + t->X[i]) * scale->half_width;
    const bool beyond = steady->ruptured && (x - steady->position_rupture) * speed > 0.0;
    const bool before = isfinite(t->supply[speed < 0.0]) && t->X[i] * speed < 0.0;
    s->P[i] = fmax(s->P[i], 0.0);
    s->cavity[i] = (beyond || before) && i > 0 && i + 1 < t->nodes && s->P[i] <= NOTHING;
    s->P[i] = s->cavity[i] ? 0.0 : s->P[i];
    s->m[i] = s->cavity[i] ? steady->film_flux / scale->film : s->H[i];
  }
  const SbStatus status = settle(t);
  return status == SB_OK ? status
                         : sb_fail(report, status,
                                   "transient film: no steady state on the mesh of finite volumes");
}

// Sets a contact at rest, separated by the film `rest`: the pressure of the dry contact. The first
// step finds the mesh's own pressure for that film. Asperities keep larger gaps by themselves.
static void lay_rest(SbFilmTransient *t, double rest, const SbFilm *standing) {
  SbTransientState *s = &t->now;
  s->speed = 0.0;
  if (t->rough) {
    lay_profile(t, standing);
    for (int i = 0; i < t->nodes; i++) {
      s->m[i] = s->H[i] = fmax(s->H[i], rest);
    }
    sb_transient_solids(t, s, true);
    for (int i = 0; i < t->nodes; i++) {
      s->P[i] = fmax(s->P[i], 0.0);
    }
    return;
  }
  SbEhlLayers layers = t->layers;
  layers.inlet = t->scale.inlet;
  layers.outlet = t->scale.outlet;
  for (int i = 0; i < t->nodes; i++) {
    s->P[i] = sb_ehl_layers_dry_pressure(&layers, t->X[i]);
    s->cavity[i] = false;
  }
  s->H0 = 0.0;
  sb_transient_solids(t, s, false);
  sb_transient_gap(s->H, t, s);
  s->H0 = rest - s->H[t->nodes / 2];
  for (int i = 0; i < t->nodes; i++) {
    s->m[i] = s->H[i] = fabs(t->X[i]) < 1.0 ? rest : fmax(s->H[i] + s->H0, rest);
  }
}

// Takes away at a starved end what the wall does not bring.
static void starve(SbFilmTransient *t) {
  SbTransientState *s = &t->now;
  for (int i = 0; i < t->nodes; i++) {
    const double supply = t->supply[t->X[i] > 0.0];
    if (fabs(t->X[i]) > 1.0 && s->H[i] > supply) {
      s->cavity[i] = true;
      s->m[i] = supply;
      s->P[i] = 0.0;
    }
  }
  sb_transient_solids(t, s, false);
}

// Minimum film, by a parabola through the logarithms of the lowest node and its neighbours, and the
// central film, scaled. Returns the place of the minimum. A parabola through the films themselves
// falls below zero in a dip that is not wider than the spacing.
static double read_films(double out[2], const SbFilmTransient *t) {
  const double *X = t->X, *H = t->now.H;
  int at = 1;
  for (int i = 1; i + 1 < t->nodes; i++) {
    at = H[i] < H[at] ? i : at;
  }
  const double x0 = X[at - 1] - X[at], x1 = X[at + 1] - X[at];
  const double h0 = log(H[at - 1] / H[at]), h1 = log(H[at + 1] / H[at]);
  const double a = (h1 / x1 - h0 / x0) / (x1 - x0);
  const double b = h0 / x0 - a * x0;
  const double dx = a > 0.0 ? fmin(fmax(-0.5 * b / a, x0), x1) : 0.0;
  out[0] = H[at] * exp(dx * (b + a * dx));
  const int k = (int)sb_interval(X, (size_t)t->nodes, 0.0);
  double bary[4], basis[4];
  sb_barycentric_weights(bary, &X[k - 1], 4);
  sb_barycentric_basis(basis, 0.0, &X[k - 1], bary, 4);
  out[1] = cblas_ddot(4, basis, 1, &H[k - 1], 1);
  return X[at] + dx;
}

void sb_film_transient_destroy(SbFilmTransient *t) {
  if (t != NULL) {
    sb_film_transient_destroy(t->companion);
    if (t->coarseness == 1.0) { // the companion borrows it
      sb_film_solver_destroy(t->solver);
    }
    free(t);
  }
}

static SbStatus check(const SbFilmTransientProblem *problem, SbReport *report) {
  const SbFilmProblem *film = &problem->film;
  if (film->model != SB_FILM_REYNOLDS || film->pressure_viscosity != 0.0 ||
      film->eyring_stress != 0.0 || film->inlet_film != 0.0) {
    return sb_fail(report, SB_ERROR_INPUT, "transient film: only the isoviscous reynolds model");
  }
  if (!(problem->speed_scale >= fabs(film->speed) && problem->speed_scale > 0.0)) {
    return sb_fail_input(report, SB_ERROR_RANGE, SB_FILM_IN_SPEED,
                         "transient film: speed scale %g m/s is below the speed %g m/s",
                         problem->speed_scale, film->speed);
  }
  const double ends[] = {film->pressure_left, film->pressure_right};
  for (int k = 0; k < 2; k++) {
    const double layer = problem->inlet_film[k];
    if (!(layer >= 0.0) || (layer > 0.0 && ends[k] > ends[1 - k])) {
      return sb_fail(report, SB_ERROR_INPUT,
                     "transient film: layer of %g m at the end of higher pressure", layer);
    }
  }
  const bool rest = problem->rest_film > 0.0;
  if (!(problem->rest_film >= 0.0 && problem->rest_film < film->radius) ||
      rest != (film->speed == 0.0)) {
    return sb_fail(report, SB_ERROR_RANGE,
                   "transient film: it starts at rest with a film between the surfaces, or steady");
  }
  return SB_OK;
}

// Solves the steady films at speed_scale, flooded, and at the start, unless that is at rest without
// asperities.
typedef struct {
  double speed[2];
  bool same; // there is no second one
  SbFilm film[2];
  SbFilmProfile profile[2];
} Steady;

static SbStatus solve_steady(Steady *out, const SbFilmTransientProblem *problem,
                             SbFilmSolver *solver, SbReport *report) {
  out->speed[0] = (problem->film.speed < 0.0 ? -1.0 : 1.0) * problem->speed_scale;
  out->speed[1] = problem->film.speed;
  SbStatus status = SB_OK;
  const double supply = problem->inlet_film[out->speed[1] < 0.0];
  out->same = out->speed[1] == 0.0 ? !sb_film_rough(&problem->film)
                                   : out->speed[1] == out->speed[0] && !(supply > 0.0);
  for (int k = 0; k < (out->same ? 1 : 2) && status == SB_OK; k++) {
    SbFilmProblem film = problem->film;
    film.speed = out->speed[k];
    film.profile = &out->profile[k];
    film.inlet_film = k > 0 && film.speed != 0.0 ? supply : 0.0;
    status = sb_film_solve(&out->film[k], &film, solver, report);
    if (status == SB_OK && k == 0 && out->film[0].moes_M < 1.0) {
      status = sb_fail_input(report, SB_ERROR_RANGE, SB_FILM_IN_SPEED,
                             "transient film: M = %.3g is below 1", out->film[0].moes_M);
    }
  }
  return status;
}

// Scale of the steady film at speed_scale, which everything goes by.
static SbStatus find_scale(SbFilmScale *scale, const SbFilmTransientProblem *problem,
                           SbReport *report) {
  SbFilmProblem scaled = problem->film;
  SbDryContact dry;
  scaled.speed = problem->speed_scale;
  *scale = sb_film_scale(&scaled);
  return scaled.compliance != NULL ? sb_film_scale_fitted(scale, &dry, &scaled, report) : SB_OK;
}

// A film that comes to rest passes every gap: attraction must close none of them.
static SbStatus refuse_closing(const SbFilmTransientProblem *problem, SbFilmSolver *solver,
                               SbReport *report) {
  const SbFilmProblem *film = &problem->film;
  const bool tips = film->work_of_adhesion > 0.0;
  if (!(film->hamaker > 0.0) && !tips) {
    return SB_OK;
  }
  SbFilmScale scale;
  const SbRoughLaw *law = NULL;
  SbStatus status = find_scale(&scale, problem, report);
  if (status == SB_OK && film->surface != SB_ROUGH_NONE) {
    status = sb_ehl_rough_law(&law, solver, film, report);
  }
  if (status != SB_OK) {
    return status;
  }
  const SbSnapContact contact = {.hamaker = film->hamaker,
                                 .modulus = film->modulus,
                                 .width = 2.0 * scale.half_width,
                                 .viscosity = film->viscosity};
  const double closed = sb_rough_snap_in(law, &contact).high;
  const int input = tips ? SB_FILM_IN_WORK_OF_ADHESION : SB_FILM_IN_HAMAKER;
  return !(closed > 0.0)
             ? SB_OK
             : sb_fail_input(report, SB_ERROR_INFEASIBLE, input,
                             "transient film: at rest adhesion closes gaps below %.3g nm; "
                             "follow the film without it",
                             1e9 * closed);
}

// The mesh's own error, by the present state and its spectral solution; the largest stays.
static void compare_steady(SbFilmTransient *t, const SbFilm *steady) {
  double film[2];
  SbFilmTransientResult *result = &t->result;
  (void)read_films(film, t);
  const double apart = fmax(fabs(film[0] * t->scale.film / steady->film_min - 1.0),
                            fabs(film[1] * t->scale.film / steady->film_central - 1.0));
  const double own = fmax(steady->solver.error_film_min, steady->solver.error_film_central);
  result->error_mesh = fmax(result->error_mesh, apart + own);
  result->error_film_min = result->error_film_central = result->error_mesh;
}

// Sets the state at the start: at rest with this scaled film, or steady.
static SbStatus lay_start(SbFilmTransient *t, const Steady *steady, double rest, SbReport *report) {
  SbStatus status = SB_OK;
  double supply[2];
  for (int k = 0; k < 2; k++) {
    const double layer = 2.0 * t->problem.inlet_film[k] / t->scale.film;
    supply[k] = layer > 0.0 ? layer : INFINITY;
  }
  if (rest > 0.0) {
    memcpy(t->supply, supply, sizeof supply);
    lay_rest(t, rest, &steady->film[1]);
    starve(t);
  } else if (!steady->same) {
    // What it does not take gathers before it; without that there is no steady state.
    const int inlet = steady->speed[1] < 0.0;
    const bool takes = steady->film[1].film_flux / t->scale.film > 0.999 * supply[inlet];
    t->supply[inlet] = takes ? supply[inlet] : INFINITY;
    status = lay_steady(t, &steady->film[1], steady->speed[1], report);
    compare_steady(t, &steady->film[1]);
  }
  memcpy(t->supply, supply, sizeof supply);
  return status;
}

// One resolution from the steady films.
static SbStatus begin(SbFilmTransient **out, const SbFilmTransientProblem *problem,
                      double coarseness, const Steady *steady, SbFilmSolver *solver,
                      SbReport *report) {
  const SbFilm *largest = &steady->film[0];
  SbFilmTransient *t = *out = calloc(1, sizeof *t);
  if (t == NULL) {
    return sb_fail(report, SB_ERROR_MEMORY, "transient film: out of memory");
  }
  t->problem = *problem;
  t->coarseness = coarseness;
  t->solver = solver;
  SbFilmScale *scale = &t->scale;
  SbStatus status = find_scale(scale, problem, report);
  if (status != SB_OK) {
    return status;
  }
  t->layers = (SbEhlLayers){.lambda = scale->lambda, .starvation = 1.0};
  memcpy(t->layers.bow, scale->bow, sizeof t->layers.bow);
  if (sb_film_rough(&problem->film)) {
    t->surface = (SbEhlCase){.layers = t->layers};
    solver->problem = &t->problem.film;
    status = sb_ehl_rough_case(&t->surface, solver, scale, report);
    if (status != SB_OK) {
      return status;
    }
    t->rough = true;
  }
  const double standing = t->rough ? steady->film[1].film_central : 0.0;
  const double rest =
      problem->rest_film > 0.0 ? fmax(problem->rest_film, standing) / scale->film : 0.0;
  const double length = scale->film / scale->half_width;
  t->diffusion = length * length * scale->pressure / (12.0 * problem->film.viscosity);
  t->flow = 0.5 * problem->speed_scale / scale->half_width * largest->film_flux / scale->film;
  sb_transient_mesh(t, rest, problem->least_film > 0.0 ? problem->least_film / scale->film : rest);
  t->supply[0] = t->supply[1] = INFINITY;
  status = lay_steady(t, largest, steady->speed[0], report);
  if (status != SB_OK) {
    return status;
  }
  compare_steady(t, largest);
  t->known_times = 1;
  return lay_start(t, steady, rest, report);
}

SbStatus sb_film_transient_create(SbFilmTransient **out, const SbFilmTransientProblem *wanted,
                                  SbReport *report) {
  *out = NULL;
  SbStatus status = check(wanted, report);
  if (status != SB_OK) {
    return status;
  }
  SbFilmTransientProblem own = *wanted;
  const SbFilmTransientProblem *problem = &own;
  const double ends[] = {own.film.pressure_left, own.film.pressure_right};
  for (int k = 0; k < 2; k++) {
    if (own.inlet_film[k] > 0.0) { // the gas' pressure fills all cavities
      own.film.rupture_pressure = fmax(own.film.rupture_pressure, ends[k]);
    }
  }
  Steady *steady = malloc(sizeof *steady);
  SbFilmSolver *solver = NULL;
  SbFilmTransient *t = NULL;
  status = steady != NULL ? sb_film_solver_create(&solver, report)
                          : sb_fail(report, SB_ERROR_MEMORY, "transient film: out of memory");
  if (status == SB_OK) {
    status = refuse_closing(problem, solver, report);
  }
  if (status == SB_OK) {
    status = solve_steady(steady, problem, solver, report);
  }
  if (status == SB_OK) {
    status = begin(&t, problem, 1.0, steady, solver, report);
  }
  if (status == SB_OK) {
    status = begin(&t->companion, problem, 2.0, steady, solver, report);
    if (status == SB_ERROR_NOT_CONVERGED) {
      sb_film_transient_destroy(t->companion);
      t->companion = NULL;
      t->result.error_film_min = t->result.error_film_central = t->result.error_history = NAN;
      status = SB_OK;
    }
  }
  free(steady);
  if (status != SB_OK) {
    if (t == NULL) {
      sb_film_solver_destroy(solver);
    }
    sb_film_transient_destroy(t);
    return status;
  }
  *out = t;
  return sb_succeed(report);
}

// ---------------------------------------------------------------- steps

// First guess of the next state: straight on from the last two.
static void go_on(SbFilmTransient *t, double h) {
  SbTransientState *s = &t->next;
  const SbTransientState *before = &t->before;
  const double ratio = t->known_times >= 2 ? h / (t->now.time - before->time) : 0.0;
  for (int i = 0; i < t->nodes && ratio > 0.0; i++) {
    if (s->cavity[i] == before->cavity[i]) {
      const double m = fmax(s->m[i] + ratio * (s->m[i] - before->m[i]), 0.3 * s->m[i]);
      s->P[i] = fmax(s->P[i] + ratio * (s->P[i] - before->P[i]), s->cavity[i] ? 0.0 : 1e-300);
      s->H[i] = fmax(s->H[i] + ratio * (s->H[i] - before->H[i]), 0.3 * s->H[i]);
      s->m[i] = s->cavity[i] ? fmin(m, s->H[i]) : s->H[i];
    }
  }
  s->H0 += ratio * (s->H0 - before->H0);
}

// The end of a film moves from node to node: its error there is not of third order and does not
// describe the step. It counts in the mean.
static bool near_cavity(const SbTransientState *s, int i) {
  return s->cavity[i - 2] || s->cavity[i - 1] || s->cavity[i] || s->cavity[i + 1] ||
         s->cavity[i + 2];
}

// The step's own error by the distance of the new heights from those guessed.
static double step_error(const SbFilmTransient *t, const double *time) {
  if (t->known_times < 2) {
    return INFINITY;
  }
  // Local error over the distance to the extrapolation: for BDF1 y'' h^2/2 against y'' h (h +
  // h1)/2, for BDF2 y'''/6 times the two products. While the parabola is not known the straight
  // line's error bounds the step's.
  double share = 0.5;
  if (t->known_times > 2) {
    const double h = time[0] - time[1], h1 = time[1] - time[2], h2 = time[2] - time[3];
    const double own = h * h * (h + h1) * (h + h1) / (2.0 * h + h1);
    share = own / (own + h * (h + h1) * (h + h1 + h2));
  }
  double sum = 0.0;
  double whole = 0.0;
  double largest = 0.0;
  for (int i = 0; i < t->nodes; i++) {
    if (fabs(t->X[i]) < 1.0) {
      const double height = t->next.m[i], off = fabs(height - t->guess[i]);
      sum += t->volume[i] * off;
      whole += t->volume[i] * height;
      largest = near_cavity(&t->next, i) ? largest : fmax(largest, off / height);
    }
  }
  return share * fmax(sum / whole, t->problem.resolve ? LOCAL * largest : 0.0);
}

SbStatus sb_transient_advance(double *error, SbFilmTransient *t, double h, double speed) {
  enum { ORDER = 2, TIMES = 4 };
  SbTransientState *s = &t->next;
  *s = t->now;
  s->time = t->now.time + h;
  s->travel = t->now.travel + 0.5 * h * (t->now.speed + speed);
  s->speed = speed;
  go_on(t, h);
  const SbTransientState *past[] = {s, &t->now, &t->before, &t->earlier};
  const int known = t->known_times, order = known < ORDER ? known : ORDER;
  double time[TIMES], bary[TIMES], rate[TIMES] = {0}, ahead[TIMES];
  for (int k = 0; k < TIMES; k++) {
    time[k] = past[k]->time;
  }
  // Weights of the derivative at the new time, and of the polynomial through the last heights.
  sb_barycentric_weights(bary, time, order + 1);
  sb_barycentric_slope(rate, time[0], time, bary, order + 1);
  sb_barycentric_weights(bary, time + 1, known);
  sb_barycentric_basis(ahead, time[0], time + 1, bary, known);
  const bool carry = fabs(s->travel - t->now.travel) < t->reach;
  memset(t->old, 0, sizeof t->old);
  memset(t->guess, 0, sizeof t->guess);
  t->c0 = rate[0];
  t->carried_rate = 0.0;
  for (int k = 1; k <= known; k++) {
    const double travel = carry ? s->travel - past[k]->travel : 0.0;
    sb_transient_transport(t->work[0], t, past[k]->m, travel);
    t->carried_rate -= rate[k] * travel;
    cblas_daxpy(t->nodes, rate[k], t->work[0], 1, t->old, 1);
    cblas_daxpy(t->nodes, ahead[k - 1], t->work[0], 1, t->guess, 1);
  }
  const SbStatus status = sb_transient_newton(t, s);
  if (status == SB_OK) {
    *error = step_error(t, time);
  }
  return status;
}

void sb_transient_accept(SbFilmTransient *t, double error) {
  // Fluid that leaves the contact takes its error with it.
  const double h = t->next.time - t->now.time;
  const double left = fmin(1.0, 0.5 * h * fabs(t->next.speed));
  SbFilmTransientResult *result = &t->result;
  result->error_time = result->error_time * (1.0 - left) + (isfinite(error) ? error : 0.0);
  result->steps++;
  t->earlier = t->before;
  t->before = t->now;
  t->now = t->next;
  t->known_times = t->known_times < 3 ? t->known_times + 1 : 3;
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
    // The last two steps share what is left.
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
    (void)sb_transient_adapt(t, v1 != 0.0 ? copysign(AHEAD, v1) : 0.0);
    const double grow = fmin(2.0, 0.85 * cbrt(limit / fmax(error, 1e-300)));
    h = isfinite(error) ? h * fmax(grow, 0.3) : h;
    if (wanted > h && grow >= 1.0) {
      h = fmax(h, fmin(wanted, 2.0 * h)); // it was cut for the end only
    }
    t->step = h;
  }
  return sb_succeed(report);
}

// Adds the minimum films at the present distance. At rest nothing moves: earlier films are no
// longer compared.
static void trace(SbFilmTransient *t, double travel, double fine, double coarse) {
  enum { LAST = SB_TRANSIENT_TRACE - 1 };
  if (t->traced > LAST || !(travel > 0.0)) {
    const int kept = travel > 0.0 ? LAST : 0;
    memmove(t->trace, t->trace + t->traced - kept, (size_t)kept * sizeof *t->trace);
    t->traced = kept;
  }
  t->trace[t->traced++] = (SbTransientTrace){t->travel, {fine, coarse}};
}

// Returns the distance of the two histories of the minimum film at the present instant: the
// smallest e for which one history was within e of the other's present film at most e of the
// passage through the contact ago (Levy's metric). Where a front leaves the contact, only its
// position is uncertain; a comparison at one instant would take the films before it for errors of
// the films behind it.
static double trace_apart(const SbFilmTransient *t) {
  const SbTransientTrace *now = &t->trace[t->traced - 1];
  double best = fabs(now->film[1] / now->film[0] - 1.0);
  for (const SbTransientTrace *at = now - 1; at >= t->trace; at--) {
    const double lag = 0.5 * (now->travel - at->travel), next = 0.5 * (now->travel - at[1].travel);
    for (int k = 0; k < 2; k++) {
      const double film = now->film[1 - k], a = at->film[k], b = at[1].film[k];
      best = fmin(best, fmax(lag, fabs((k == 1 ? a / film : film / a) - 1.0)));
      if ((a - film) * (b - film) < 0.0) { // passed in between
        best = fmin(best, next + (lag - next) * (b - film) / (b - a));
      }
    }
  }
  return best;
}

// Advances the companion to the end of a piece in which the fluid moved by `travel`, and takes the
// difference of the films, or what remains in the contact of the largest earlier one. For the
// minimum film the full difference is the error of a first-order method: fronts and cavities are
// between first and second order, for which it would be a third. For the central film it is half.
static SbStatus compare(SbFilmTransient *t, double travel) {
  SbFilmTransient *other = t->companion;
  double *error[2] = {&t->result.error_film_min, &t->result.error_film_central};
  if (other == NULL) {
    return SB_OK;
  }
  const SbStatus status = follow(other, t->now.time, t->now.speed, NULL);
  if (status != SB_OK) {
    sb_film_transient_destroy(other);
    t->companion = NULL;
    *error[0] = *error[1] = t->result.error_history = NAN;
    return status == SB_ERROR_CANCELLED ? status : SB_OK;
  }
  double fine[2], coarse[2];
  (void)read_films(coarse, other);
  const double place = read_films(fine, t);
  // A dip that the coarse spacing does not resolve may be deeper than both meshes show: in
  // proportion as much again as the minimum is below the next nodes but one, twice. The film stays
  // above zero, so that this part of the estimate stays below 1.
  int at = 1;
  while (t->X[at] < place) {
    at++;
  }
  const double *H = t->now.H;
  const bool unknown = !t->problem.resolve && t->face[at].carried > 0.0;
  const double share = 2.0 * fine[0] / (H[at - 2] + H[at + 1]);
  const double bend = unknown ? fabs(1.0 - share * share) : 0.0;
  t->travel += travel;
  trace(t, travel, fine[0], coarse[0]);
  const double history = t->result.error_mesh + trace_apart(t);
  t->result.error_history =
      fmax(t->result.error_history, history + bend * fmax(0.0, 1.0 - history));
  for (int k = 0; k < 2; k++) {
    const double part = k == 0 ? 1.0 : 0.5;
    const double apart = part * fabs(coarse[k] / fine[k] - 1.0) + (k == 0 ? bend : 0.0);
    if (apart > t->apart[k] || t->travel - t->apart_travel[k] > 2.0) {
      t->apart[k] = apart;
      t->apart_travel[k] = t->travel;
    }
    *error[k] = t->result.error_mesh + t->apart[k];
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
  const double travel = 0.5 * dt * (fabs(v0) + fabs(v1));
  const int pieces = (int)ceil(fmin(fmax(travel / 0.1, 1.0), PIECES_MAX));
  for (int k = 1; k <= pieces && status == SB_OK; k++) {
    const double share = (double)k / pieces;
    status = follow(t, begin + share * dt, v0 + share * (v1 - v0), report);
    if (status == SB_OK) {
      status = compare(t, travel / pieces);
    }
  }
  return status;
}

SbFilmTransientResult sb_film_transient_result(const SbFilmTransient *t) {
  SbFilmTransientResult result = t->result;
  double film[2];
  (void)read_films(film, t);
  result.film_min = film[0] * t->scale.film;
  result.film_central = film[1] * t->scale.film;
  result.half_width = t->scale.half_width;
  sb_transient_friction(&result, t);
  return result;
}
