// What is read off a solution of the mixed film: films, loads and friction by the rule of the
// nodes, the layers that the next mesh has to follow, and the profile. Equations in ehl_rough.h,
// the convention of the broken film in ehl_rough.c.
#include "engine/film/ehl_rough.h"

#include <math.h>
#include <string.h>

static void add_interval(SbEhlRoughResults *out, const SbEhlRoughSolver *solver,
                         const SbEhlRoughState *state, const SbEhlRoughCase *c,
                         const SbEhlRoughRule *rule, int e, double half, int j) {
  int i = e * rule->degree + j;
  double full[SB_EHL_ROUGH_DEGREE_MAX + 1], film[SB_EHL_ROUGH_DEGREE_MAX + 1];
  memcpy(full, rule->step[j], sizeof full);
  memcpy(film, full, sizeof film);
  if (state->broken[i]) {
    memset(film, 0, sizeof film);
  } else if (state->broken[i + 1]) {
    sb_ehl_rough_partial(
        film, rule, j,
        sb_ehl_rough_film_end(&solver->mesh[state - solver->state], rule, state->s, e, j));
  }
  for (int k = 0; k <= rule->degree; k++) {
    int n = e * rule->degree + k;
    const SbEhlRoughPoint *at = &solver->point[n];
    double w = half * full[k], wet = half * film[k];
    double open = 1 - at->share;
    double shear = sb_film_shear(&c->fluid, at->h, state->q[n] - at->solid);
    out->couette += wet * open * shear;
    out->poiseuille += wet * open * 0.5 * at->h * state->s[n];
    if (c->lambda > 0) {
      double theta = fmin(state->kappa / c->lambda / at->h, 1);
      out->cavity += (w - wet) * open * fmax(theta, 0) * shear;
    }
    out->real_area += w * at->share;
    out->asperity_load += w * at->asperity;
  }
}

void sb_ehl_rough_results(SbEhlRoughResults *out, SbEhlRoughSolver *solver, int which,
                          const SbEhlRoughCase *c) {
  const SbEhlRoughMesh *mesh = &solver->mesh[which];
  const SbEhlRoughState *state = &solver->state[which];
  const SbEhlRoughRule *rule = sb_ehl_rough_rule(solver, mesh->degree);
  memset(out, 0, sizeof *out);
  out->film_min = INFINITY;
  out->position_rupture = mesh->edge[mesh->elements];
  for (int i = 0; i < mesh->nodes; i++) {
    sb_ehl_rough_point(&solver->point[i], c, state->t[i]);
  }
  out->load_error = fabs(sb_ehl_rough_load(mesh, state->q)) / (0.5 * M_PI);
  out->film_flux = c->lambda > 0 ? state->kappa / c->lambda : 0;
  double r;
  int axis = sb_ehl_rough_locate(mesh, 0, &r);
  SbEhlRoughPoint at;
  sb_ehl_rough_point(&at, c, sb_ehl_rough_value(mesh, rule, state->t, axis, r));
  out->film_central = at.h;
  out->central_share = at.share;

  int thinnest = 0, highest = 0;
  double p_before = 0;
  for (int e = 0; e < mesh->elements; e++) {
    double half = 0.5 * (mesh->edge[e + 1] - mesh->edge[e]);
    for (int j = 0; j < rule->degree; j++) {
      int i = e * rule->degree + j;
      add_interval(out, solver, state, c, rule, e, half, j);
      if (!out->ruptured && !state->broken[i] && state->broken[i + 1] && c->lambda > 0) {
        double end = sb_ehl_rough_film_end(mesh, rule, state->s, e, j);
        out->position_rupture = 0.5 * (mesh->edge[e] + mesh->edge[e + 1]) + half * end;
        out->ruptured = true;
      }
      thinnest = solver->point[i].h < solver->point[thinnest].h ? i : thinnest;
      highest = state->q[i] > state->q[highest] ? i : highest;
      // The flux that the profile carries, by the integrated equation.
      if (!state->broken[i] && !state->broken[i + 1]) {
        double p = state->q[i] - solver->point[i].solid;
        double next = state->q[i + 1] - solver->point[i + 1].solid;
        double sum = 0;
        for (int k = 0; k <= rule->degree; k++) {
          sum += half * rule->step[j][k] * state->s[e * rule->degree + k];
        }
        p_before = fmax(p_before, fabs(next - p - sum));
      }
    }
  }
  out->flux_error = p_before;
  // Least gap and largest pressure inside the elements about the best nodes: parabola search.
  out->film_min = solver->point[thinnest].h;
  out->position_min = mesh->x[thinnest];
  out->pressure_max = state->q[highest];
  for (int which_one = 0; which_one < 2; which_one++) {
    double X = mesh->x[which_one == 0 ? thinnest : highest];
    double low = X, high = X;
    int n = which_one == 0 ? thinnest : highest;
    low = mesh->x[n > 0 ? n - 1 : 0];
    high = mesh->x[n < mesh->nodes - 1 ? n + 1 : n];
    const double *field = which_one == 0 ? state->t : state->q;
    double sign = which_one == 0 ? 1 : -1;
    static const double RATIO = 0.6180339887498949;
    for (int k = 0; k < 40; k++) {
      double x1 = high - RATIO * (high - low), x2 = low + RATIO * (high - low);
      double r1, r2;
      int e1 = sb_ehl_rough_locate(mesh, x1, &r1), e2 = sb_ehl_rough_locate(mesh, x2, &r2);
      if (sign * sb_ehl_rough_value(mesh, rule, field, e1, r1) <
          sign * sb_ehl_rough_value(mesh, rule, field, e2, r2)) {
        high = x2;
      } else {
        low = x1;
      }
    }
    X = 0.5 * (low + high);
    int e = sb_ehl_rough_locate(mesh, X, &r);
    double value = sb_ehl_rough_value(mesh, rule, field, e, r);
    if (which_one == 0) {
      sb_ehl_rough_point(&at, c, value);
      if (at.h < out->film_min) {
        out->film_min = at.h;
        out->position_min = X;
      }
    } else {
      out->pressure_max = fmax(out->pressure_max, value);
    }
  }
}

void sb_ehl_rough_profile(SbFilm *out, SbEhlRoughSolver *solver, int which, const SbEhlRoughCase *c,
                          const SbFilmScale *scale, bool forward) {
  const SbEhlRoughMesh *mesh = &solver->mesh[which];
  const SbEhlRoughState *state = &solver->state[which];
  const SbEhlRoughRule *rule = sb_ehl_rough_rule(solver, mesh->degree);
  enum { POINTS = 5200 }; // about
  int per = POINTS / mesh->elements;
  size_t n = 0;
  for (int e = 0; e < mesh->elements; e++) {
    double middle = 0.5 * (mesh->edge[e] + mesh->edge[e + 1]);
    double half = 0.5 * (mesh->edge[e + 1] - mesh->edge[e]);
    for (int k = e > 0 ? 1 : 0; k <= per; k++) {
      double r = -1 + 2.0 * k / per;
      SbEhlRoughPoint at;
      sb_ehl_rough_point(&at, c, sb_ehl_rough_value(mesh, rule, state->t, e, r));
      double q = sb_ehl_rough_value(mesh, rule, state->q, e, r);
      out->x[n] = (middle + half * r + mesh->shift) * scale->half_width;
      out->pressure[n] = (q + c->fluid.rupture) * scale->pressure;
      out->film[n] = at.h * scale->film;
      out->asperity_pressure[n] = at.asperity * scale->pressure;
      n++;
    }
  }
  out->points = n;
  for (size_t i = 0, j = n - 1; !forward && i <= j; i++, j--) {
    double *const column[] = {out->x, out->pressure, out->film, out->asperity_pressure};
    for (size_t k = 0; k < sizeof column / sizeof column[0]; k++) {
      double value = column[k][i];
      column[k][i] = column[k][j];
      column[k][j] = value;
    }
    out->x[i] = -out->x[i];
    if (i != j) {
      out->x[j] = -out->x[j];
    }
  }
}

// Where the film takes the load over from the asperities and hands it back, and how sharply: there
// Reynolds' equation and q = p + p_a(h) leave a layer of length k h^3 / lambda, k the asperities'
// stiffness.
bool sb_ehl_rough_fronts(SbEhlRoughCase *c, const SbEhlRoughSolver *solver, int which,
                         const SbEhlRoughResults *r) {
  c->front[0].X = c->front[1].X = INFINITY;
  if (c->law == NULL || !(c->lambda > 0)) {
    return false;
  }
  const SbEhlRoughMesh *mesh = &solver->mesh[which];
  const SbEhlRoughState *state = &solver->state[which];
  double place[2] = {0, r->ruptured ? r->position_rupture : INFINITY};
  double steepest = 0, steepest_end = 0;
  bool follow = false;
  for (int i = 0; i < mesh->nodes; i++) {
    if (!state->broken[i] && state->s[i] > steepest) {
      steepest = state->s[i];
      place[0] = mesh->x[i];
    }
    if (!r->ruptured && -state->s[i] > steepest_end) {
      steepest_end = -state->s[i];
      place[1] = mesh->x[i];
    }
  }
  for (int k = 0; k < 2; k++) {
    double coordinate;
    int n = sb_ehl_rough_locate(mesh, fmin(place[k], mesh->edge[mesh->elements]), &coordinate);
    const SbEhlRoughPoint *at = &solver->point[n * mesh->degree + mesh->degree / 2];
    double layer = -at->solid_t / at->h_t * at->h * at->h * at->h / c->lambda;
    double inside = fabs(1 - fabs(place[k]));
    bool sharp = layer < 0.5 * inside && at->asperity > 1e-3;
    if (sharp || (k == 1 && r->ruptured && at->asperity > 1e-3)) {
      c->front[k].X = place[k];
      c->front[k].width = fmin(fmax(layer, 1e-3 * inside), 0.5 * inside);
    }
    follow = follow || sharp;
  }
  return follow;
}
