// Newton's method for Reynolds' equation coupled with the half-plane.
//
// Scaled (thesis eq. 6.37-6.50): H^3 m P' / lambda - H + H* = 0 at the collocation points, the flux
// film H* being an unknown, with H = H0 + (X + c)^2 / 2 - (1/pi) integral P ln|X - X'| dX', the
// load integral P = pi/2, and Swift-Stieber's end p = 0, H = H* (that is p' = 0). The mesh is fixed
// in X and the axis moves by c: the rupture point is free and the kernel constant, so that the
// whole system is smooth and Newton's method converges quadratically without a contact search. m
// holds Barus' viscosity and Eyring's thinning (fluid.h) and is 1 without them.
//
// A film that begins at a meniscus or forms again behind a cavity has one more free end, which
// moves the mesh; its column of the Jacobian is a difference quotient.
#include "engine/film/ehl.h"

#include "engine/numeric/dense.h"

#include <cblas.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { STRIDE = SB_EHL_DEGREE_MAX + 1, ITERATIONS_MAX = 10 };

// A step that leaves less than this of the residual lets the next one take the same factors.
static const double REUSE = 0.02;

bool sb_ehl_init(SbFilmSolver *solver) {
  enum { TRIAL = 64 };
  sb_ehl_tables_init(&solver->tables);
  const size_t size = (size_t)SB_EHL_ORDER_MAX * SB_EHL_ORDER_MAX * sizeof(double);
  solver->matrix = malloc(size);
  solver->kernel = malloc((size_t)SB_EHL_TARGETS_MAX * SB_EHL_DOFS_MAX * sizeof(double));
  if (!sb_ehl_mesh_init(&solver->mesh[0]) || !sb_ehl_mesh_init(&solver->mesh[1]) ||
      solver->matrix == NULL || solver->kernel == NULL) {
    return false;
  }
  // Touches the pages and LAPACK's own buffers once, so that no solve pays for them.
  memset(solver->matrix, 0, size);
  for (size_t i = 0; i < TRIAL; i++) {
    solver->matrix[i * TRIAL + i] = 1.0;
  }
  cblas_dgemv(CblasRowMajor, CblasNoTrans, TRIAL, TRIAL, 1.0, solver->matrix, TRIAL, solver->right,
              1, 0.0, solver->gaps, 1);
  return sb_factor_solve(solver->matrix, solver->pivot, solver->right, TRIAL, true);
}

void sb_ehl_finish(SbFilmSolver *solver) {
  sb_ehl_mesh_finish(&solver->mesh[0]);
  sb_ehl_mesh_finish(&solver->mesh[1]);
  free(solver->matrix);
  free(solver->kernel);
}

// Gap from the pressure at all targets into solver->gaps, with its derivatives to the nodal
// pressures (returned, borrowed) and to the shift behind the gaps.
static const double *elastic_gaps(SbFilmSolver *solver, const SbEhlMesh *mesh,
                                  const SbEhlState *state, const SbEhlCase *problem) {
  double *out = solver->gaps;
  double *slope = out + mesh->targets;
  if (problem->body.compliance != NULL) {
    sb_ehl_fitted(solver->kernel, out, slope, &solver->tables, mesh, state->nodal, state->shift,
                  &problem->body);
    for (int i = 0; i < mesh->targets; i++) {
      out[i] += state->H0;
    }
    return solver->kernel;
  }
  for (int i = 0; i < mesh->targets; i++) {
    double x = mesh->x[i] + state->shift;
    out[i] = state->H0 + 0.5 * x * x + mesh->gap_known[i];
    slope[i] = x;
  }
  cblas_dgemv(CblasRowMajor, CblasNoTrans, mesh->targets, mesh->dofs, 1.0, mesh->gap, mesh->dofs,
              state->nodal, 1, 1.0, out, 1);
  return mesh->gap;
}

// Where the conditions beside the collocation rows act.
typedef struct {
  bool rupture;              // p = 0 and H = H* at the end of element `last`
  int last;                  // element that ends at the rupture
  bool meniscus;             // p given at the first node, H* given, the meniscus free
  bool reform;               // p = 0 at the first node of element last + 1, its place free
  int shift, flux, free_end; // columns, -1 if not an unknown
  int order;
} Layout;

static Layout lay_out(const SbEhlMesh *mesh, const SbEhlCase *problem) {
  Layout l = {.last = mesh->count - 1, .shift = -1, .flux = -1, .free_end = -1};
  l.rupture = problem->layers.end != SB_EHL_FULL;
  l.meniscus = isfinite(problem->layers.meniscus);
  l.reform = problem->layers.end == SB_EHL_REFORM && !problem->hold;
  for (int i = 1; i < mesh->count; i++) {
    if (mesh->element[i].apart) {
      l.last = i - 1;
    }
  }
  l.order = mesh->dofs + 1;
  if (l.rupture) {
    l.shift = l.order++;
  }
  if (!l.meniscus || problem->hold) {
    l.flux = l.order++;
  }
  if ((l.meniscus && !problem->hold) || l.reform) {
    l.free_end = l.order++;
  }
  return l;
}

double sb_ehl_load(const SbEhlMesh *mesh, const SbEhlState *state) {
  double sum = mesh->load_known - 0.5 * M_PI;
  for (int j = 0; j < mesh->dofs; j++) {
    sum += mesh->load[j] * state->nodal[j];
  }
  sum += mesh->inlet_pressure * (mesh->left_end + state->shift);
  return sum - mesh->outlet_pressure * (mesh->right_end + state->shift);
}

// The larger size, a NaN counting as infinite.
static double larger(double largest, double value) {
  return isfinite(value) ? fmax(largest, fabs(value)) : INFINITY;
}

// Residuals into `right` and, if `matrix` is given, the Jacobian without the free end's column.
// `gaps` and `kernel` are those of elastic_gaps. Returns the largest scaled residual. A gap guess
// is linearised about when `independent`.
static double assemble(double *right, double *matrix, const double *gaps, const double *kernel,
                       const SbEhlMesh *mesh, const SbEhlState *state, const SbEhlCase *problem,
                       const Layout *layout, bool independent) {
  int dofs = mesh->dofs;
  size_t order = (size_t)layout->order;
  const double *gap_slope = gaps + mesh->targets;
  double lambda = problem->layers.lambda;
  double largest = 0.0;
  if (matrix != NULL) {
    memset(matrix, 0, order * order * sizeof *matrix);
  }

  // Reynolds' equation at the collocation points, divided by the film.
  for (int i = 0; i < mesh->rows; i++) {
    double elastic = gaps[i];
    double H = independent ? state->gap[i] : elastic;
    double slope;
    double pressure = sb_ehl_local(&slope, mesh, state->nodal, i);
    double m, m_film, m_pressure;
    sb_film_mobility(&m, &m_film, &m_pressure, &problem->fluid, H, pressure);
    double G = H * H * H * m / lambda;
    double by_film = (3.0 * H * H * m + H * H * H * m_film) / lambda * slope - 1.0;
    double by_pressure = H * H * H * m_pressure / lambda * slope;
    double scale = 1.0 / fmax(fabs(H), state->flux);
    double residual = G * slope - H + state->flux + by_film * (elastic - H);
    right[i] = scale * residual;
    largest = larger(largest, right[i]);
    if (matrix == NULL) {
      continue;
    }
    double *row = matrix + (size_t)i * order;
    const double *gap = kernel + (size_t)i * (size_t)dofs;
    for (int j = 0; j < dofs; j++) {
      row[j] = scale * by_film * gap[j];
    }
    const SbEhlElement *e = &mesh->element[mesh->owner[i]];
    for (int j = 0; j <= e->degree; j++) {
      row[e->first_dof + j] += scale * (G * mesh->slope[(size_t)i * STRIDE + (size_t)j] +
                                        by_pressure * mesh->value[(size_t)i * STRIDE + (size_t)j]);
    }
    row[dofs] = scale * by_film;
    if (layout->shift >= 0) {
      row[layout->shift] = scale * by_film * gap_slope[i];
    }
    if (layout->flux >= 0) {
      row[layout->flux] = scale;
    }
  }
  int next = mesh->rows;

  // Rupture: p = 0 and H = H*.
  if (layout->rupture) {
    const SbEhlElement *e = &mesh->element[layout->last];
    int node = e->first_dof + e->degree;
    int target = e->right_target;
    right[next] = state->nodal[node];
    double scale = 1.0 / state->flux;
    right[next + 1] = scale * (gaps[target] - state->flux);
    largest = larger(larger(largest, right[next]), right[next + 1]);
    if (matrix != NULL) {
      matrix[(size_t)next * order + (size_t)node] = 1.0;
      double *row = matrix + (size_t)(next + 1) * order;
      for (int j = 0; j < dofs; j++) {
        row[j] = scale * kernel[(size_t)target * (size_t)dofs + (size_t)j];
      }
      row[dofs] = scale;
      row[layout->shift] = scale * gap_slope[target];
      if (layout->flux >= 0) {
        row[layout->flux] = -scale;
      }
    }
    next += 2;
  }
  // Pressure where the film begins or forms again.
  if (layout->meniscus || layout->reform) {
    int node = layout->reform ? mesh->element[layout->last + 1].first_dof : 0;
    right[next] = state->nodal[node] - (layout->reform ? 0.0 : problem->layers.inlet);
    largest = larger(largest, right[next]);
    if (matrix != NULL) {
      matrix[(size_t)next * order + (size_t)node] = 1.0;
    }
    next++;
  }
  // Load.
  right[next] = sb_ehl_load(mesh, state);
  largest = larger(largest, right[next]);
  if (matrix != NULL) {
    double *row = matrix + (size_t)next * order;
    memcpy(row, mesh->load, (size_t)dofs * sizeof *row);
    if (layout->shift >= 0) {
      row[layout->shift] = mesh->inlet_pressure - mesh->outlet_pressure;
    }
  }
  return largest;
}

// Moves the free end to `place` and rebuilds the mesh.
static bool move_free_end(SbFilmSolver *solver, int which, SbEhlCase *problem, double place) {
  if (problem->layers.end == SB_EHL_REFORM) {
    problem->layers.reform = place;
  } else {
    problem->layers.meniscus = place;
  }
  return sb_ehl_layers_mesh(&solver->mesh[which], &solver->tables, &problem->layers);
}

static double free_end(const SbEhlCase *problem) {
  return problem->layers.end == SB_EHL_REFORM ? problem->layers.reform : problem->layers.meniscus;
}

// A film cannot form again before it breaks, nor begin behind the middle of the contact.
static bool allowed(const SbEhlMesh *mesh, const SbEhlCase *problem, const Layout *layout,
                    double place) {
  double least = 1e-4 * sb_ehl_layers_length(&problem->layers);
  return problem->layers.end == SB_EHL_REFORM ? place > mesh->element[layout->last].x1 + least
                                              : place < -0.5;
}

// Derivative of the residuals to the free end: the mesh is moved a little and put back.
static bool difference_column(SbFilmSolver *solver, int which, SbEhlCase *problem,
                              const Layout *layout) {
  SbEhlMesh *mesh = &solver->mesh[which];
  SbEhlState *state = &solver->state[which];
  double place = free_end(problem);
  double step = 1e-6 * sb_ehl_layers_length(&problem->layers);
  if (!move_free_end(solver, which, problem, place + step)) {
    return false;
  }
  const double *kernel = elastic_gaps(solver, mesh, state, problem);
  assemble(solver->column, NULL, solver->gaps, kernel, mesh, state, problem, layout, false);
  if (!move_free_end(solver, which, problem, place)) {
    return false;
  }
  for (int i = 0; i < layout->order; i++) {
    solver->column[i] = (solver->column[i] - solver->right[i]) / step;
  }
  return true;
}

SbStatus sb_ehl_newton(SbEhlTrace *trace, SbFilmSolver *solver, int which, SbEhlCase *problem,
                       bool independent, double tolerance, const SbFilmProblem *callback) {
  SbEhlMesh *mesh = &solver->mesh[which];
  SbEhlState *state = &solver->state[which];
  Layout layout = lay_out(mesh, problem);
  if (layout.free_end >= 0 && independent) {
    independent = false; // the difference quotient needs a consistent gap
  }
  int order = layout.order;
  double *matrix = solver->matrix;
  double *right = solver->right;
  double before_residual = INFINITY;
  bool factored = false; // `matrix` holds the factors of an earlier step
  // Rounding of deflections of size one against the film: no residual is smaller. A fitted body's
  // have more terms.
  tolerance = fmax(tolerance, (problem->body.compliance != NULL ? 8e-16 : 1.1e-16) / state->flux);
  *trace = (SbEhlTrace){.residual = INFINITY};

  for (int iteration = 0; iteration <= ITERATIONS_MAX; iteration++) {
    if (callback->cancelled != NULL && callback->cancelled(callback->cancelled_data)) {
      return SB_ERROR_CANCELLED;
    }
    bool first = independent && iteration == 0;
    const double *kernel = elastic_gaps(solver, mesh, state, problem);
    trace->residual =
        assemble(right, NULL, solver->gaps, kernel, mesh, state, problem, &layout, first);
    if (!isfinite(trace->residual)) {
      return SB_ERROR_NOT_CONVERGED;
    }
    // Done at the tolerance, or where rounding stops the descent not far above it.
    bool stalled = trace->residual <= 10.0 * tolerance && trace->residual > 0.3 * before_residual;
    if (!first && (trace->residual <= tolerance || stalled)) {
      break;
    }
    // Close to the solution the last factors serve again: each step then gains what they gained.
    factored = factored && trace->residual < REUSE * before_residual;
    before_residual = trace->residual;
    if (iteration == ITERATIONS_MAX) {
      if (trace->residual <= 10.0 * tolerance) {
        break;
      }
      return SB_ERROR_NOT_CONVERGED;
    }
    if (!factored) {
      assemble(right, matrix, solver->gaps, kernel, mesh, state, problem, &layout, first);
      if (layout.free_end >= 0) {
        if (!difference_column(solver, which, problem, &layout)) {
          return SB_ERROR_NOT_CONVERGED;
        }
        for (int i = 0; i < order; i++) {
          matrix[(size_t)i * (size_t)order + (size_t)layout.free_end] = solver->column[i];
        }
      }
    }
    if (!sb_factor_solve(matrix, solver->pivot, right, order, !factored)) {
      return SB_ERROR_NOT_CONVERGED;
    }
    factored = true;
    trace->iterations++;

    // Full steps unless the film would vanish.
    double flux_change = layout.flux >= 0 ? right[layout.flux] : 0.0;
    double factor = 1.0;
    const double before_H0 = state->H0, before_shift = state->shift, before_flux = state->flux;
    double place = layout.free_end >= 0 ? free_end(problem) : 0.0;
    double applied = 0.0;
    for (int cut = 0;; cut++) {
      for (int j = 0; j < mesh->dofs; j++) {
        state->nodal[j] -= (factor - applied) * right[j];
      }
      applied = factor;
      state->H0 = before_H0 - factor * right[mesh->dofs];
      if (layout.shift >= 0) {
        state->shift = before_shift - factor * right[layout.shift];
      }
      state->flux = before_flux - factor * flux_change;
      bool thin = state->flux < 0.1 * before_flux;
      if (layout.free_end >= 0) {
        double moved = place - factor * right[layout.free_end];
        thin = thin || !allowed(mesh, problem, &layout, moved);
        if (!thin && !move_free_end(solver, which, problem, moved)) {
          return SB_ERROR_NOT_CONVERGED;
        }
      }
      elastic_gaps(solver, mesh, state, problem);
      for (int i = 0; !first && !thin && i < mesh->rows; i++) {
        thin = solver->gaps[i] < 0.1 * state->gap[i];
      }
      if (!thin || first) {
        break;
      }
      if (cut >= 8) {
        return SB_ERROR_NOT_CONVERGED;
      }
      factor *= 0.5;
    }
    if (state->flux <= 0.0) {
      return SB_ERROR_NOT_CONVERGED;
    }
    memcpy(state->gap, solver->gaps, (size_t)mesh->targets * sizeof(double));
  }

  // A film that is not positive everywhere is no solution.
  memcpy(state->gap, solver->gaps, (size_t)mesh->targets * sizeof(double));
  for (int i = 0; i < mesh->rows; i++) {
    if (!(state->gap[i] > 0.0)) {
      return SB_ERROR_NOT_CONVERGED;
    }
  }
  return SB_OK;
}
