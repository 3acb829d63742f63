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

// Gap from the pressure at all targets into solver->gaps, with its derivatives to the nodal
// pressures (returned, borrowed) and to the shift behind the gaps.
static const double *elastic_gaps(const SbEhlSolution *s) {
  const SbEhlMesh *mesh = &s->mesh;
  const SbEhlState *state = &s->state;
  double *out = s->solver->gaps;
  if (s->c.body.compliance != NULL) {
    sb_ehl_fitted(s, state->nodal, state->shift);
    for (int i = 0; i < mesh->targets; i++) {
      out[i] += state->H0;
    }
    return s->solver->kernel;
  }
  for (int i = 0; i < mesh->targets; i++) {
    double x = mesh->x[i] + state->shift;
    out[i] = state->H0 + 0.5 * x * x + mesh->gap_known[i];
    out[mesh->targets + i] = x;
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

static Layout lay_out(const SbEhlSolution *s) {
  const SbEhlMesh *mesh = &s->mesh;
  const SbEhlCase *c = &s->c;
  Layout l = {.last = mesh->count - 1, .shift = -1, .flux = -1, .free_end = -1};
  l.rupture = c->layers.end != SB_EHL_FULL;
  l.meniscus = isfinite(c->layers.meniscus);
  l.reform = c->layers.end == SB_EHL_REFORM && !c->hold;
  for (int i = 1; i < mesh->count; i++) {
    if (mesh->element[i].apart) {
      l.last = i - 1;
    }
  }
  l.order = mesh->dofs + 1;
  if (l.rupture) {
    l.shift = l.order++;
  }
  if (!l.meniscus || c->hold) {
    l.flux = l.order++;
  }
  if ((l.meniscus && !c->hold) || l.reform) {
    l.free_end = l.order++;
  }
  return l;
}

double sb_ehl_load(const SbEhlSolution *s) {
  const SbEhlMesh *mesh = &s->mesh;
  return mesh->load_known - 0.5 * M_PI + cblas_ddot(mesh->dofs, mesh->load, 1, s->state.nodal, 1) +
         mesh->inlet_pressure * (mesh->left_end + s->state.shift) -
         mesh->outlet_pressure * (mesh->right_end + s->state.shift);
}

// The larger size, a NaN counting as infinite.
static double larger(double largest, double value) {
  return isfinite(value) ? fmax(largest, fabs(value)) : INFINITY;
}

// Residuals into `right` and, unless NULL, the Jacobian without the free end's column into
// `matrix`, for the gaps in solver->gaps with the derivatives `kernel`. Returns the largest scaled
// residual. A gap guess is linearised about when `independent`.
static double assemble(double *right, double *matrix, const double *kernel, const SbEhlSolution *s,
                       const Layout *layout, bool independent) {
  const SbEhlMesh *mesh = &s->mesh;
  const SbEhlState *state = &s->state;
  const double *gaps = s->solver->gaps;
  const double *gap_slope = gaps + mesh->targets;
  int dofs = mesh->dofs;
  size_t order = (size_t)layout->order;
  double lambda = s->c.layers.lambda;
  double largest = 0.0;
  if (matrix != NULL) {
    memset(matrix, 0, order * order * sizeof *matrix);
  }

  // Reynolds' equation at the collocation points, divided by the film.
  for (int i = 0; i < mesh->rows; i++) {
    double elastic = gaps[i];
    double H = independent ? state->gap[i] : elastic;
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
    for (int j = 0; j <= e->degree; j++) {
      row[e->first_dof + j] += scale * (G * local->slope[j] + by_pressure * local->value[j]);
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
    right[next] = state->nodal[node] - (layout->reform ? 0.0 : s->c.layers.inlet);
    largest = larger(largest, right[next]);
    if (matrix != NULL) {
      matrix[(size_t)next * order + (size_t)node] = 1.0;
    }
    next++;
  }
  // Load.
  right[next] = sb_ehl_load(s);
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

static double *free_end(SbEhlLayers *layers) {
  return layers->end == SB_EHL_REFORM ? &layers->reform : &layers->meniscus;
}

// Moves the free end to `place` and rebuilds the mesh. A film cannot form again before it breaks,
// nor begin behind the middle of the contact.
static bool move_free_end(SbEhlSolution *s, const Layout *layout, double place) {
  SbEhlLayers *layers = &s->c.layers;
  bool allowed = layers->end == SB_EHL_REFORM ? place > s->mesh.element[layout->last].x1 +
                                                            1e-4 * sb_ehl_layers_length(layers)
                                              : place < -0.5;
  if (allowed) {
    *free_end(layers) = place;
  }
  return allowed && sb_ehl_layers_mesh(s);
}

// Derivative of the residuals to the free end: the mesh is moved a little and put back.
static bool difference_column(SbEhlSolution *s, const Layout *layout) {
  SbFilmSolver *solver = s->solver;
  double place = *free_end(&s->c.layers);
  double step = 1e-6 * sb_ehl_layers_length(&s->c.layers);
  if (!move_free_end(s, layout, place + step)) {
    return false;
  }
  assemble(solver->column, NULL, elastic_gaps(s), s, layout, false);
  for (int i = 0; i < layout->order; i++) {
    double rise = (solver->column[i] - solver->right[i]) / step;
    solver->matrix[(size_t)i * (size_t)layout->order + (size_t)layout->free_end] = rise;
  }
  return move_free_end(s, layout, place);
}

// Takes the step in solver->right, cut to parts where the film would vanish; of an independent gap
// the first step stands as it is.
static bool apply(SbEhlSolution *s, const Layout *layout, bool first) {
  SbEhlState *state = &s->state;
  const double *step = s->solver->right;
  const double H0 = state->H0, shift = state->shift, flux = state->flux;
  const double place = layout->free_end >= 0 ? *free_end(&s->c.layers) : 0.0;
  double applied = 0.0;
  double factor = 1.0;
  for (int cut = 0; cut <= 8; cut++, factor *= 0.5) {
    cblas_daxpy(s->mesh.dofs, applied - factor, step, 1, state->nodal, 1);
    applied = factor;
    state->H0 = H0 - factor * step[s->mesh.dofs];
    state->shift = shift - (layout->shift >= 0 ? factor * step[layout->shift] : 0.0);
    state->flux = flux - (layout->flux >= 0 ? factor * step[layout->flux] : 0.0);
    bool thin = state->flux < 0.1 * flux;
    if (layout->free_end >= 0 && !thin) {
      thin = !move_free_end(s, layout, place - factor * step[layout->free_end]);
    }
    elastic_gaps(s);
    for (int i = 0; !first && !thin && i < s->mesh.rows; i++) {
      thin = s->solver->gaps[i] < 0.1 * state->gap[i];
    }
    if (!thin || first) {
      return state->flux > 0.0;
    }
  }
  return false;
}

SbStatus sb_ehl_newton(SbEhlSolution *s, bool independent) {
  SbFilmSolver *solver = s->solver;
  SbFilmSolverInfo *info = solver->info;
  SbEhlState *state = &s->state;
  const Layout layout = lay_out(s);
  independent = independent && layout.free_end < 0; // a difference quotient needs a consistent gap
  double before = INFINITY;
  bool factored = false; // the matrix holds the factors of an earlier step
  // Rounding of deflections of size one against the film: no residual is smaller. A fitted body's
  // have more terms.
  double tolerance =
      fmax(solver->tolerance, (s->c.body.compliance != NULL ? 8e-16 : 1.1e-16) / state->flux);
  for (int iteration = 0;; iteration++) {
    if (sb_ehl_cancelled(solver)) {
      return SB_ERROR_CANCELLED;
    }
    bool first = independent && iteration == 0;
    const double *kernel = elastic_gaps(s);
    double residual = assemble(solver->right, NULL, kernel, s, &layout, first);
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
      assemble(solver->right, solver->matrix, kernel, s, &layout, first);
      if (layout.free_end >= 0 && !difference_column(s, &layout)) {
        return SB_ERROR_NOT_CONVERGED;
      }
    }
    if (!sb_factor_solve(solver->matrix, solver->pivot, solver->right, layout.order, !factored)) {
      return SB_ERROR_NOT_CONVERGED;
    }
    factored = true;
    info->newton_iterations++;
    if (!apply(s, &layout, first)) {
      return SB_ERROR_NOT_CONVERGED;
    }
    memcpy(state->gap, solver->gaps, (size_t)s->mesh.targets * sizeof(double));
  }

  // A film that is not positive everywhere is no solution.
  memcpy(state->gap, solver->gaps, (size_t)s->mesh.targets * sizeof(double));
  for (int i = 0; i < s->mesh.rows; i++) {
    if (!(state->gap[i] > 0.0)) {
      return SB_ERROR_NOT_CONVERGED;
    }
  }
  return SB_OK;
}
