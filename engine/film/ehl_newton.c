// The linear system of Newton's method, and the method itself on smooth rows.
//
// Scaled (thesis eq. 6.37-6.50): H^3 m P' / lambda - H + H* = 0 at the collocation points, the flux
// film H* being an unknown, with H = H0 + (X + c)^2 / 2 - (1/pi) integral P ln|X - X'| dX', the
// load integral P = pi/2, and Swift-Stieber's end p = 0, H = H* (that is p' = 0). The mesh is fixed
// in X and the axis moves by c: the rupture point is free and the kernel constant, so that the
// whole system is smooth and Newton's method converges quadratically without a contact search. m
// holds Barus' viscosity and Eyring's thinning (scale.h) and is 1 without them.
//
// The gap is iterated beside the pressure: a first guess of its own is made consistent by the first
// step. A film that begins at a meniscus or forms again behind a cavity has one more free end,
// where the mesh begins anew: ehl_continuation.c finds its place.
#include "engine/film/ehl.h"

#include "engine/numeric/dense.h"

#include <cblas.h>
#include <math.h>
#include <string.h>

enum { ITERATIONS_MAX = 10 };

// A step that leaves less than this of the residual lets the next one take the same factors.
static const double REUSE = 0.02;

bool sb_ehl_init(SbFilmSolver *solver) {
  enum { TRIAL = 64 };
  // Touches the pages and LAPACK's own buffers once, so that no solve pays for them.
  memset(solver, 0, sizeof *solver);
  sb_ehl_tables_init(&solver->tables);
  for (int i = 0; i < 2; i++) {
    solver->solution[i].solver = solver;
    solver->solution[i].mesh.tables = &solver->tables;
  }
  solver->now = &solver->solution[0];
  for (size_t i = 0; i < TRIAL; i++) {
    solver->matrix[i * TRIAL + i] = 1.0;
  }
  cblas_dgemv(CblasRowMajor, CblasNoTrans, TRIAL, TRIAL, 1.0, solver->matrix, TRIAL, solver->right,
              1, 0.0, solver->gaps, 1);
  return sb_factor_solve(solver->matrix, solver->pivot, solver->right, TRIAL, true);
}

void sb_ehl_elastic(const SbEhlSolution *s) {
  const SbEhlMesh *mesh = &s->mesh;
  const SbEhlState *state = &s->state;
  SbFilmSolver *solver = s->solver;
  double *out = solver->gaps;
  const bool fitted = s->c.body.compliance != NULL;
  solver->by_nodal = mesh->gap;
  if (fitted && !s->c.rough.rows) {
    sb_ehl_fitted(s, state->nodal, state->shift);
    solver->by_nodal = solver->kernel;
    for (int i = 0; i < mesh->targets; i++) {
      out[i] += state->H0;
    }
    return;
  }
  for (int i = 0; i < mesh->targets; i++) {
    double x = mesh->x[i] + state->shift;
    out[i] = state->H0 + (fitted ? 0.0 : 0.5 * x * x) + mesh->gap_known[i];
    solver->by_shift[i] = x;
  }
  cblas_dgemv(CblasRowMajor, CblasNoTrans, mesh->targets, mesh->dofs, 1.0, mesh->gap, mesh->dofs,
              state->nodal, 1, 1.0, out, 1);
}

// Number of unknowns.
static int order_of(const SbEhlSolution *s) {
  return s->mesh.dofs + (!s->c.rough.rows && s->c.layers.end != SB_EHL_FULL ? 3 : 2);
}

void sb_ehl_gap_step(double *change, const SbEhlSolution *s) {
  const SbFilmSolver *solver = s->solver;
  const double *step = solver->right + s->mesh.dofs;
  const bool moves = order_of(s) > s->mesh.dofs + 2;
  for (int i = 0; i < s->mesh.rows; i++) {
    change[i] += step[0] + (moves ? step[2] * solver->by_shift[i] : 0.0);
  }
  cblas_dgemv(CblasRowMajor, CblasNoTrans, s->mesh.rows, s->mesh.dofs, 1.0, solver->by_nodal,
              s->mesh.dofs, solver->right, 1, 1.0, change, 1);
}

void sb_ehl_add_gap(double *row, const SbEhlSolution *s, int target, double by) {
  const SbFilmSolver *solver = s->solver;
  const int dofs = s->mesh.dofs;
  cblas_daxpy(dofs, by, solver->by_nodal + (size_t)target * (size_t)dofs, 1, row, 1);
  row[dofs] += by;
  if (order_of(s) > dofs + 2) {
    row[dofs + 2] += by * solver->by_shift[target];
  }
}

double sb_ehl_load(const SbEhlSolution *s) {
  const SbEhlMesh *mesh = &s->mesh;
  return mesh->load_known - 0.5 * M_PI + cblas_ddot(mesh->dofs, mesh->load, 1, s->state.nodal, 1) +
         mesh->inlet_pressure * (mesh->left_end + s->state.shift) -
         mesh->outlet_pressure * (mesh->right_end + s->state.shift);
}

// Residuals into `right` and, unless NULL, the Jacobian into `matrix`, linearised about the gap of
// the state. Returns the largest scaled residual, a NaN counting as infinite.
static double assemble(double *matrix, const SbEhlSolution *s) {
  const SbEhlMesh *mesh = &s->mesh;
  const SbEhlState *state = &s->state;
  const double *gaps = s->solver->gaps;
  double *right = s->solver->right;
  const int dofs = mesh->dofs;
  const int order = order_of(s);
  const double lambda = s->c.layers.lambda;
  if (matrix != NULL) {
    memset(matrix, 0, (size_t)order * (size_t)order * sizeof *matrix);
  }

  // Reynolds' equation at the collocation points, divided by the film.
  for (int i = 0; i < mesh->rows; i++) {
    double H = state->gap[i];
    double slope;
    const SbEhlElement *e = &mesh->element[mesh->owner[i]];
    const SbEhlLocal *local = &mesh->local[i];
    double pressure = sb_ehl_sum(&slope, local, e, state->nodal);
    double m, m_film, m_pressure;
    sb_film_mobility(&m, &m_film, &m_pressure, &s->c.fluid, H, pressure);
    double G = H * H * H * m / lambda;
    double by_film = (3.0 * H * H * m + H * H * H * m_film) / lambda * slope - 1.0;
    double by_pressure = H * H * H * m_pressure / lambda * slope;
    double scale = 1.0 / fmax(fabs(H), state->flux);
    right[i] = scale * (G * slope - H + state->flux + by_film * (gaps[i] - H));
    if (matrix == NULL) {
      continue;
    }
    double *row = matrix + (size_t)i * (size_t)order;
    sb_ehl_add_gap(row, s, i, scale * by_film);
    for (int j = 0; j <= e->degree; j++) {
      row[e->first_dof + j] += scale * (G * local->slope[j] + by_pressure * local->value[j]);
    }
    row[dofs + 1] = scale;
  }
  int next = mesh->rows;
  double *row = matrix != NULL ? matrix + (size_t)next * (size_t)order : NULL;

  // Rupture at the end of an element: H = H* and p = 0.
  if (s->c.layers.end != SB_EHL_FULL) {
    const SbEhlElement *e = &mesh->element[mesh->film_end];
    double scale = 1.0 / state->flux;
    right[next++] = scale * (gaps[e->gap_target[e->degree + 1]] - state->flux);
    right[next++] = state->nodal[e->first_dof + e->degree];
    if (matrix != NULL) {
      sb_ehl_add_gap(row, s, e->gap_target[e->degree + 1], scale);
      row[dofs + 1] = -scale;
      row += order;
      row[e->first_dof + e->degree] = 1.0;
      row += order;
    }
  }
  // Meniscus: the flux supplied, or the pressure before it.
  if (isfinite(s->c.layers.meniscus)) {
    const bool supplied = isfinite(s->c.supply);
    right[next++] =
        supplied ? state->flux / s->c.supply - 1.0 : state->nodal[0] - s->c.layers.inlet;
    if (matrix != NULL) {
      row[supplied ? dofs + 1 : 0] = supplied ? 1.0 / s->c.supply : 1.0;
      row += order;
    }
  }
  // Load.
  right[next] = sb_ehl_load(s);
  if (matrix != NULL) {
    memcpy(row, mesh->load, (size_t)dofs * sizeof *row);
    if (order > dofs + 2) {
      row[dofs + 2] = mesh->inlet_pressure - mesh->outlet_pressure;
    }
  }
  double largest = 0.0;
  for (int i = 0; i < order; i++) {
    largest = isfinite(right[i]) ? fmax(largest, fabs(right[i])) : INFINITY;
  }
  return largest;
}

// Takes the step in solver->right, cut where the film would vanish; of an independent gap the first
// step stands as it is.
static bool apply(SbEhlSolution *s, bool first) {
  SbFilmSolver *solver = s->solver;
  SbEhlState *state = &s->state;
  const int dofs = s->mesh.dofs;
  const double *step = solver->right;
  double *change = solver->change;
  for (int i = 0; i < s->mesh.rows; i++) {
    change[i] = state->gap[i] - solver->gaps[i];
  }
  sb_ehl_gap_step(change, s);
  double factor = 1.0;
  for (int i = 0; i <= s->mesh.rows && !first; i++) {
    double old = i < s->mesh.rows ? state->gap[i] : state->flux;
    double fall = i < s->mesh.rows ? change[i] : step[dofs + 1];
    while (!(old - factor * fall >= 0.1 * old) && factor > 1e-3) {
      factor *= 0.5;
    }
  }
  cblas_daxpy(dofs, -factor, step, 1, state->nodal, 1);
  state->H0 -= factor * step[dofs];
  state->flux -= factor * step[dofs + 1];
  state->shift -= order_of(s) > dofs + 2 ? factor * step[dofs + 2] : 0.0;
  return factor > 1e-3 && state->flux > 0.0;
}

SbStatus sb_ehl_newton(SbEhlSolution *s) {
  SbFilmSolver *solver = s->solver;
  SbFilmSolverInfo *info = solver->info;
  SbEhlState *state = &s->state;
  double before = INFINITY;
  bool factored = false; // the matrix holds the factors of an earlier step
  const double tolerance = sb_ehl_tolerance(s);
  for (int iteration = 0;; iteration++) {
    if (sb_ehl_cancelled(solver)) {
      return SB_ERROR_CANCELLED;
    }
    bool first = iteration == 0;
    sb_ehl_elastic(s);
    if (!first) {
      memcpy(state->gap, solver->gaps, (size_t)s->mesh.targets * sizeof(double));
    }
    double residual = assemble(NULL, s);
    info->residual = residual;
    // Done at the tolerance, or where rounding stops the descent not far above it.
    bool last = residual > 0.3 * before || iteration == ITERATIONS_MAX;
    if (!first && (residual <= tolerance || (last && residual <= 10.0 * tolerance))) {
      break;
    }
    if (!isfinite(residual) || iteration == ITERATIONS_MAX) {
      return SB_ERROR_NOT_CONVERGED;
    }
    // Close to the solution the last factors serve again: each step then gains what they gained.
    factored = factored && residual < REUSE * before;
    before = residual;
    if (!factored) {
      assemble(solver->matrix, s);
    }
    if (!sb_factor_solve(solver->matrix, solver->pivot, solver->right, order_of(s), !factored)) {
      return SB_ERROR_NOT_CONVERGED;
    }
    factored = true;
    info->newton_iterations++;
    if (!apply(s, first)) {
      return SB_ERROR_NOT_CONVERGED;
    }
  }

  // A film that is not positive everywhere is no solution.
  for (int i = 0; i < s->mesh.rows; i++) {
    if (!(state->gap[i] > 0.0)) {
      return SB_ERROR_NOT_CONVERGED;
    }
  }
  return SB_OK;
}
