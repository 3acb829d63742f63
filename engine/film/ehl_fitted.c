// Film on a fitted body: scales of its dry contact, and its kernel on the solvers' meshes.
//
// The body's gap and smooth compliance (contact/compliance.h) are polynomials in the seal's x. The
// film's mesh is fixed in the flow frame with the axis at the shift c: x = side b (X + c). The
// smooth part acts through as many moments of the pressure as it has polynomials, so it costs two
// thin products. b and p_H are those of a Hertz contact with the width and load of the dry contact,
// so the layers are at its edges. The shift of the smooth film is an unknown; the mesh of the mixed
// film is fixed on the dry contact.
#include "engine/film/ehl.h"

#include "engine/numeric/legendre.h"

#include <assert.h>
#include <cblas.h>
#include <math.h>
#include <string.h>

SbStatus sb_film_scale_fitted(SbFilmScale *scale, SbDryContact *dry, const SbFilmProblem *problem,
                              SbReport *report) {
  const SbSurfaceCompliance *c = problem->compliance;
  if (!(fabs(c->modulus / problem->modulus - 1.0) < 1e-6)) {
    return sb_fail(report, SB_ERROR_INPUT,
                   "reduced modulus %g Pa, but the fitted surface has %g Pa", problem->modulus,
                   c->modulus);
  }
  SbStatus status = sb_dry_contact(dry, c, problem->load, problem->pressure_left,
                                   problem->pressure_right, report);
  if (status != SB_OK) {
    return status;
  }
  const bool forward = problem->speed >= 0.0;
  const double half = 0.5 * (dry->right - dry->left);
  const double old = scale->pressure;
  scale->half_width = half;
  scale->pressure = 2.0 * problem->load / (M_PI * half);
  scale->film = 4.0 * scale->pressure * half / problem->modulus;
  scale->lambda = 6.0 * problem->viscosity * fabs(problem->speed) * half /
                  (scale->film * scale->film * scale->pressure);
  scale->inlet *= old / scale->pressure;
  scale->outlet *= old / scale->pressure;
  scale->middle = (forward ? 0.5 : -0.5) * (dry->left + dry->right) / half;
  memset(scale->bow, 0, sizeof scale->bow);
  for (int k = 0; k < dry->count; k++) {
    scale->bow[k] = (forward || k % 2 == 0 ? 1.0 : -1.0) * dry->a[k] / scale->pressure;
  }
  scale->bow[0] -= 1.0;
  scale->kappa = (forward ? dry->edge_left : dry->edge_right) / scale->pressure;
  scale->kappa_outlet = (forward ? dry->edge_right : dry->edge_left) / scale->pressure;
  return SB_OK;
}

void sb_film_rest_fitted(SbFilm *out, const SbFilmProblem *problem, const SbDryContact *dry) {
  enum { POINTS = 801 };
  const SbSurfaceCompliance *c = problem->compliance;
  const double half = 0.5 * (dry->right - dry->left);
  const double from = fmax(c->left, dry->left - half);
  const double to = fmin(c->right, dry->right + half);
  out->pressure_max = dry->peak;
  out->position_rupture = dry->right;
  for (size_t i = 0; i < POINTS && out->x != NULL; i++) {
    double x = from + (to - from) * (double)i / (POINTS - 1);
    sb_film_put(out, i, x, sb_dry_contact_pressure(dry, x), sb_dry_contact_gap(dry, c, x));
  }
  out->solver.converged = true;
  out->solver.residual = dry->residual;
}

enum { MODES = SB_COMPLIANCE_MODES };

// S acts on the window only: an affine element that extends beyond it counts for the part inside.
// Moments of the element's basis, and of the state's pressure with its derivative with respect to
// the shift.
static void add_element(double *state, double *state_slope, const SbEhlSolution *s,
                        const SbEhlElement *e) {
  const SbFilmBody *body = &s->c.body;
  const double shift = s->state.shift;
  const SbSurfaceCompliance *c = body->compliance;
  const double unit = body->side * body->half_width;
  const double ends[] = {c->left / unit - shift, c->right / unit - shift};
  const double from = fmax((fmin(ends[0], ends[1]) - e->m) / e->h, -1.0);
  const double to = fmin((fmax(ends[0], ends[1]) - e->m) / e->h, 1.0);
  const bool cut = e->map == SB_EHL_AFFINE && (from > -1.0 || to < 1.0);
  if (cut && to <= from) {
    return;
  }
  enum { N = SB_COMPLIANCE_TOGETHER };
  const int count = e->degree + 1;
  static_assert(SB_EHL_QUAD % N == 0, "the fine rule's points in rows");
  for (int first = 0; first < SB_EHL_QUAD; first += N) {
    double weight[N][SB_EHL_DEGREE_MAX + 1], place[N], pressure[N];
    double value[MODES][N], slope[MODES][N];
    for (int i = 0; i < N; i++) {
      const int q = first + i;
      const double at = e->fine_x[q];
      double X = e->side != 0 ? e->A + e->side * e->B / (at * at) : at;
      memcpy(weight[i], e->fine_wb[q], sizeof weight[i]);
      if (cut) {
        const SbEhlTable *t = e->table;
        const double r = 0.5 * (from + to) + 0.5 * (to - from) * s->mesh.tables->fine[q];
        X = e->m + e->h * r;
        sb_barycentric_basis(weight[i], r, t->node, t->bary, count);
        cblas_dscal(count, 0.5 * (to - from) * e->h * s->mesh.tables->fine_weight[q], weight[i], 1);
      }
      place[i] = unit * (X + shift);
      pressure[i] = -e->far_pressure * weight[i][sb_ehl_touching(e)];
      for (int j = 0; j < count; j++) {
        pressure[i] += weight[i][j] * s->state.nodal[e->first_dof + j];
      }
    }
    sb_compliance_modes_together(c, place, value, slope);
    for (int k = 0; k < c->modes; k++) {
      for (int i = 0; i < N; i++) {
        state[k] += pressure[i] * value[k][i];
        state_slope[k] += pressure[i] * slope[k][i] * unit;
      }
    }
    for (int k = 0; k < c->modes && !s->solver->base.in_use; k++) {
      double sum[SB_EHL_DEGREE_MAX + 1] = {0.0};
      double *moment = &s->solver->fitted.moment[k][e->first_dof];
      memcpy(sum, moment, sizeof *sum * (size_t)count);
      for (int i = 0; i < N; i++) {
        for (int j = 0; j < count; j++) {
          sum[j] += weight[i][j] * value[k][i];
        }
      }
      memcpy(moment, sum, sizeof *sum * (size_t)count);
    }
  }
}

void sb_film_ambient(double *out, double *slope, const SbFilmBody *body, double inlet,
                     double outlet, double begin, double end) {
  const SbSurfaceCompliance *c = body->compliance;
  const double unit = body->side * body->half_width;
  const double low = fmin(inlet, outlet);
  const double left = unit * begin;
  const double right = unit * end;
  double before[MODES], after[MODES], whole[MODES];
  sb_compliance_integrals(c, unit > 0.0 ? c->left : left, unit > 0.0 ? left : c->right, before);
  sb_compliance_integrals(c, unit > 0.0 ? right : c->left, unit > 0.0 ? c->right : right, after);
  sb_compliance_integrals(c, c->left, c->right, whole);
  double at_left[MODES], at_right[MODES];
  sb_compliance_modes(c, left, at_left, NULL);
  sb_compliance_modes(c, right, at_right, NULL);
  for (int k = 0; k < c->modes; k++) {
    out[k] += (inlet * before[k] + outlet * after[k] - low * whole[k]) / body->half_width;
    slope[k] += inlet * at_left[k] - outlet * at_right[k];
  }
}

double sb_film_window_tilt(const SbFilmBody *body, double inlet, double outlet) {
  const SbSurfaceCompliance *c = body->compliance;
  return -(inlet - outlet) / M_PI * log(0.5 * (c->right - c->left) / body->half_width);
}

// Computes S times the moments, without the constant that H0 takes up anyway: it would only cost
// digits of thin films. Of the state's pressure, of its derivative, and, if `basis`, of the basis.
static void apply_smooth(double of_state[MODES], double of_slope[MODES], const SbEhlSolution *s,
                         const double *state, const double *state_slope, bool basis) {
  const SbSurfaceCompliance *c = s->c.body.compliance;
  const int modes = c->modes;
  const double factor = 0.25 * c->modulus; // p_H b over the film's scale
  SbFilmSolver *solver = s->solver;
  if (basis) {
    memset(solver->fitted.smooth[0], 0, sizeof solver->fitted.smooth[0]);
    cblas_dgemm(CblasRowMajor, CblasNoTrans, CblasNoTrans, modes - 1, s->mesh.dofs, modes, factor,
                &c->smooth[1][0], MODES, &solver->fitted.moment[0][0], SB_EHL_DOFS_MAX, 0.0,
                &solver->fitted.smooth[1][0], SB_EHL_DOFS_MAX);
  }
  cblas_dgemv(CblasRowMajor, CblasNoTrans, modes - 1, modes, factor, c->smooth[1], MODES, state, 1,
              0.0, of_state + 1, 1);
  cblas_dgemv(CblasRowMajor, CblasNoTrans, modes - 1, modes, factor, c->smooth[1], MODES,
              state_slope, 1, 0.0, of_slope + 1, 1);
}

// Computes the gaps at all targets, with their derivatives with respect to the shift, and the
// body's polynomials there.
static void fitted_gaps(const SbEhlSolution *s, const double of_state[MODES],
                        const double of_slope[MODES]) {
  const SbEhlMesh *mesh = &s->mesh;
  const SbFilmBody *body = &s->c.body;
  const SbSurfaceCompliance *c = body->compliance;
  SbFilmSolver *solver = s->solver;
  const double unit = body->side * body->half_width, shift = s->state.shift;
  const double tilt = sb_film_window_tilt(body, mesh->inlet_pressure, mesh->outlet_pressure);
  double place[SB_COMPLIANCE_TOGETHER] = {0.0};
  double values[MODES][SB_COMPLIANCE_TOGETHER], slopes[MODES][SB_COMPLIANCE_TOGETHER];
  for (int i = 0; i < mesh->targets; i++) {
    const int own = i % SB_COMPLIANCE_TOGETHER;
    for (int k = 0; own == 0 && k < SB_COMPLIANCE_TOGETHER && i + k < mesh->targets; k++) {
      place[k] = unit * (mesh->x[i + k] + shift);
    }
    if (own == 0) {
      sb_compliance_modes_together(c, place, values, slopes);
    }
    const double x = place[own];
    double *value = solver->fitted.value[i];
    double gap_slope;
    double sum = sb_compliance_gap(c, x, &gap_slope) / body->film;
    double sum_slope = gap_slope / body->film * unit;
    for (int k = 0; k < c->modes; k++) {
      value[k] = values[k][own];
      sum += value[k] * of_state[k];
      sum_slope += slopes[k][own] * unit * of_state[k] + value[k] * of_slope[k];
    }
    solver->gaps[i] = s->state.H0 + sum + mesh->gap_known[i] + tilt * mesh->x[i];
    solver->by_shift[i] = sum_slope;
  }
}

void sb_ehl_fitted(const SbEhlSolution *s) {
  const SbEhlMesh *mesh = &s->mesh;
  const double shift = s->state.shift;
  SbFilmSolver *solver = s->solver;
  const bool basis = !solver->base.in_use; // the kernel of a base stays
  if (basis) {
    memset(solver->fitted.moment, 0, sizeof solver->fitted.moment);
  }
  double state[MODES] = {0}, state_slope[MODES] = {0};
  for (int i = 0; i < mesh->count; i++) {
    add_element(state, state_slope, s, &mesh->element[i]);
  }
  sb_film_ambient(state, state_slope, &s->c.body, mesh->inlet_pressure, mesh->outlet_pressure,
                  mesh->left_end + shift, mesh->right_end + shift);
  double of_state[MODES] = {0}, of_slope[MODES] = {0};
  apply_smooth(of_state, of_slope, s, state, state_slope, basis);
  fitted_gaps(s, of_state, of_slope);
  if (basis) {
    memcpy(solver->kernel, mesh->gap, (size_t)mesh->targets * (size_t)mesh->dofs * sizeof(double));
    cblas_dgemm(CblasRowMajor, CblasNoTrans, CblasNoTrans, mesh->targets, mesh->dofs,
                s->c.body.compliance->modes, 1.0, &solver->fitted.value[0][0], MODES,
                &solver->fitted.smooth[0][0], SB_EHL_DOFS_MAX, 1.0, solver->kernel, mesh->dofs);
  }
}
