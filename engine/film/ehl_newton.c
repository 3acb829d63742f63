// Newton's method for both sets of rows; equations in ehl.h. The pressure enters every row through
// the gap. The gap itself is iterated in addition to the pressure, so an independent initial guess
// of the gap is made consistent by the first step.
//
// Smooth rows (thesis eq. 6.37-6.50): H^3 m P'/lambda - H + H* = 0 at the collocation points, with
// the flux film H* as an unknown, H = H0 + (X + c)^2/2 - (1/pi) integral P ln|X - X'| dX', the load
// integral P = pi/2, and Swift-Stieber's end p = 0, H = H* (that is p' = 0). The mesh is fixed in X
// and the axis moves by c: the rupture point is free and the kernel constant, so the whole system
// is smooth and Newton's method converges quadratically without a contact search. m contains Barus'
// viscosity and Eyring's thinning (scale.h) and is 1 without them. A film that begins at a meniscus
// or re-forms behind a cavity has another free end, where the mesh begins: ehl_continuation.c finds
// its position.
//
// Rough rows: unknowns of the linear system are the total pressures, H0 and kappa; gap, parameter,
// slope and film pressure follow from them at each node:
//
//   dh = K dq + dH0 + r          r: residual of the linear elastic equation
//   dp = dq + k dh               k = -(dp_a/dt) / (dh/dt), the asperities' stiffness
//   G ds = -(rho + (dG/dh s - lambda) dh + dG/dp s dp + dkappa)     G = h^3 m
//
// so every step keeps the elastic equation, load and flux linear. The rows are Reynolds' equation
// from node to node, or p = 0 in the cavity, the end pressures and the load. A step is shortened
// only where the gap would fall by more than the rough law's parameter can follow.
//
// Long: smooth and rough rows share the linear system and the limits of a step.
#include "engine/film/ehl.h"

#include "engine/numeric/dense.h"

#include <cblas.h>
#include <math.h>
#include <stddef.h>
#include <string.h>

enum { ITERATIONS_MAX = 24, ITERATIONS_MAX_ROUGH = 40 };

// Those after which a residual that no longer falls is rounding.
enum { STALLED = 10 };

// A residual, or a step of rough rows, this much smaller than the last lets the next step take the
// same factors: it then gains what the last one gained. A step of rough rows is to be CLOSE.
static const double REUSE = 0.02;
static const double REUSE_ROUGH = 0.1, CLOSE = 0.03;

void sb_ehl_init(SbFilmSolver *solver) {
  const struct {
    size_t at, size;
  } matrix[] = {
      {offsetof(SbFilmSolver, solution[0].mesh.element), sizeof solver->solution[0].mesh.element},
      {offsetof(SbFilmSolver, solution[0].mesh.gap), sizeof solver->solution[0].mesh.gap},
      {offsetof(SbFilmSolver, solution[0].mesh.local), sizeof solver->solution[0].mesh.local},
      {offsetof(SbFilmSolver, solution[1].mesh.element), sizeof solver->solution[1].mesh.element},
      {offsetof(SbFilmSolver, solution[1].mesh.gap), sizeof solver->solution[1].mesh.gap},
      {offsetof(SbFilmSolver, solution[1].mesh.local), sizeof solver->solution[1].mesh.local},
      {offsetof(SbFilmSolver, matrix), sizeof solver->matrix},
      {offsetof(SbFilmSolver, factors), sizeof solver->factors},
      {offsetof(SbFilmSolver, kernel), sizeof solver->kernel}};
  size_t from = 0;
  for (size_t i = 0; i < sizeof matrix / sizeof *matrix; i++) {
    memset((char *)solver + from, 0, matrix[i].at - from);
    from = matrix[i].at + matrix[i].size;
  }
  memset((char *)solver + from, 0, sizeof *solver - from);
  sb_ehl_tables_init(&solver->tables);
  for (int i = 0; i < 2; i++) {
    solver->solution[i].solver = solver;
    solver->solution[i].mesh.tables = &solver->tables;
  }
  solver->now = &solver->solution[0];
}

// With a base's factors any descent will do.
static double reuse(const SbEhlSolution *s, double gain) {
  return s->solver->base.in_use ? 0.5 : gain;
}

// How the iteration goes.
typedef struct {
  int iteration;
  double before; // the last residual, or step of rough rows
  bool factored; // the factors of an earlier step may serve again
  bool small;    // rough rows: the last step
  bool cut;      // rough rows: the last step was shortened
  int settled;   // small steps so far
  double moved;  // smooth rows: the film by the last step, relative; infinite: a part of it
} Progress;

// Gap by the state's pressure, with its derivatives, in the solver.
static void deflect(const SbEhlSolution *s) {
  const SbEhlMesh *mesh = &s->mesh;
  const SbEhlState *state = &s->state;
  SbFilmSolver *solver = s->solver;
  double *out = solver->gaps;
  solver->by_nodal = mesh->gap;
  for (int i = 0; i < mesh->targets; i++) {
    double x = mesh->x[i] + state->shift;
    out[i] = state->H0 + 0.5 * x * x + mesh->gap_known[i];
    solver->by_shift[i] = x;
  }
  if (s->c.body.compliance != NULL) {
    sb_ehl_fitted(s);
    solver->by_nodal = solver->kernel;
  }
  cblas_dgemv(CblasRowMajor, CblasNoTrans, mesh->targets, mesh->dofs, 1.0, mesh->gap, mesh->dofs,
              state->nodal, 1, 1.0, out, 1);
}

// Number of unknowns.
static int order_of(const SbEhlSolution *s) {
  return s->mesh.dofs + (!s->c.rough.rows && s->c.layers.end != SB_EHL_FULL ? 3 : 2);
}

// Adds the gaps' changes by the step in solver->right.
static void add_gap_step(double *change, const SbEhlSolution *s) {
  const SbFilmSolver *solver = s->solver;
  const double *step = solver->right + s->mesh.dofs;
  const bool moves = order_of(s) > s->mesh.dofs + 2;
  for (int i = 0; i < s->mesh.rows; i++) {
    change[i] += step[0] + (moves ? step[2] * solver->by_shift[i] : 0.0);
  }
  cblas_dgemv(CblasRowMajor, CblasNoTrans, s->mesh.rows, s->mesh.dofs, 1.0, solver->by_nodal,
              s->mesh.dofs, solver->right, 1, 1.0, change, 1);
}

// Adds to a row of the matrix `by` times the derivatives of the gap at a target.
static void add_gap(double *row, const SbEhlSolution *s, int target, double by) {
  const SbFilmSolver *solver = s->solver;
  if (solver->base.in_use) { // by the factors at hand
    return;
  }
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

// The load above the ambient step.
static void give_load(double *row, double *right, const SbEhlSolution *s) {
  const SbEhlMesh *mesh = &s->mesh;
  *right = -sb_ehl_load(s);
  memcpy(row, mesh->load, (size_t)mesh->dofs * sizeof *row);
  if (order_of(s) > mesh->dofs + 2) {
    row[mesh->dofs + 2] = mesh->inlet_pressure - mesh->outlet_pressure;
  }
}

// ---------------------------------------------------------------- smooth rows

// The system, linearised about the gap of the state. The largest scaled residual, a NaN counting as
// infinite.
static double assemble_smooth(const SbEhlSolution *s) {
  const SbEhlMesh *mesh = &s->mesh;
  const SbEhlState *state = &s->state;
  const double *gaps = s->solver->gaps;
  const int dofs = mesh->dofs, order = order_of(s);
  const double lambda = s->c.layers.lambda;
  double *row = s->solver->matrix, *right = s->solver->right;

  // Reynolds' equation at the collocation points, divided by the film.
  for (int i = 0; i < mesh->rows; i++, row += order) {
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
    *right++ = -scale * (G * slope - H + state->flux + by_film * (gaps[i] - H));
    add_gap(row, s, i, scale * by_film);
    for (int j = 0; j <= e->degree; j++) {
      row[e->first_dof + j] += scale * (G * local->slope[j] + by_pressure * local->value[j]);
    }
    row[dofs + 1] = scale;
  }
  // Rupture at the end of an element: H = H* and p = 0.
  if (s->c.layers.end != SB_EHL_FULL) {
    const SbEhlElement *e = &mesh->element[mesh->film_end];
    const int target = e->gap_target[e->degree + 1], last = e->first_dof + e->degree;
    double scale = 1.0 / state->flux;
    *right++ = scale * (state->flux - gaps[target]);
    add_gap(row, s, target, scale);
    row[dofs + 1] = -scale;
    row += order;
    *right++ = -state->nodal[last];
    row[last] = 1.0;
    row += order;
  }
  // Meniscus: the flux supplied, or the pressure before it.
  if (isfinite(s->c.layers.meniscus)) {
    const bool supplied = isfinite(s->c.supply);
    *right++ = supplied ? 1.0 - state->flux / s->c.supply : s->c.layers.inlet - state->nodal[0];
    row[supplied ? dofs + 1 : 0] = supplied ? 1.0 / s->c.supply : 1.0;
    row += order;
  }
  give_load(row, right, s);
  double largest = 0.0;
  for (int i = 0; i < order; i++) {
    double size = fabs(s->solver->right[i]);
    largest = isfinite(size) ? fmax(largest, size) : INFINITY;
  }
  return largest;
}

static bool ready_smooth(Progress *p, SbEhlSolution *s) {
  SbEhlState *state = &s->state;
  const bool first = p->iteration == 0;
  const double tolerance = sb_ehl_tolerance(s);
  if (!first) {
    memcpy(state->gap, s->solver->gaps, (size_t)s->mesh.targets * sizeof(double));
  }
  double residual = assemble_smooth(s);
  s->solver->info->residual = residual;
  // Converged at the tolerance, or where rounding stops the decrease slightly above it. End
  // pressures that nearly open the contact amplify rounding. Then the remaining change of the film
  // per step decides, a fraction of its tolerance so small that the error estimate remains that of
  // the mesh. The reported error includes it instead of the residual.
  static const double LEFT = 0.01;
  const bool stalls = residual > 0.3 * p->before, given = s->solver->base.in_use;
  bool done = !first && residual <= (stalls ? 10.0 : 1.0) * tolerance;
  if (given) { // whose steps gain less: as far as they descend
    done = !first &&
           (stalls ? residual <= fmax(10.0 * tolerance, 1e-8) : residual <= 0.01 * tolerance);
  }
  if (!done && p->iteration >= STALLED && stalls &&
      p->moved <= LEFT * s->solver->problem->tolerance) {
    s->solver->info->residual = fmax(residual, p->moved);
    done = true;
  }
  for (int i = 0; i < s->mesh.rows; i++) {
    done = done && state->gap[i] > 0.0; // no film otherwise
  }
  p->factored = p->factored && residual < reuse(s, REUSE) * p->before;
  p->before = residual;
  return done;
}

// Takes the step, shortened if the film would decrease by more than half: the flow is proportional
// to its cube, and with a smaller limit the iteration oscillates in the outlet's layer. With an
// independent gap the first step is taken fully.
static bool step_smooth(Progress *p, SbEhlSolution *s) {
  SbFilmSolver *solver = s->solver;
  SbEhlState *state = &s->state;
  const int dofs = s->mesh.dofs, rows = s->mesh.rows;
  const double *step = solver->right;
  double *change = solver->change;
  for (int i = 0; i < rows; i++) {
    change[i] = solver->gaps[i] - state->gap[i];
  }
  add_gap_step(change, s);
  double factor = 1.0;
  for (int i = 0; i <= rows && p->iteration > 0; i++) {
    double old = i < rows ? state->gap[i] : state->flux;
    double rise = i < rows ? change[i] : step[dofs + 1];
    while (!(factor * rise >= -0.5 * old) && factor > 1e-3) {
      factor *= 0.5;
    }
  }
  p->moved = factor < 1.0 ? INFINITY : fabs(step[dofs + 1]) / state->flux;
  for (int i = 0; i < rows && factor == 1.0; i++) {
    p->moved = fmax(p->moved, fabs(change[i]) / state->gap[i]);
  }
  cblas_daxpy(dofs, factor, step, 1, state->nodal, 1);
  state->H0 += factor * step[dofs];
  state->flux += factor * step[dofs + 1];
  state->shift += order_of(s) > dofs + 2 ? factor * step[dofs + 2] : 0.0;
  // A start that is none shows soon.
  const bool hopeless = p->iteration > 9 && p->before > 1.0;
  return factor > 1e-3 && state->flux > 0.0 && !hopeless;
}

// ---------------------------------------------------------------- rough rows

// Everything at the nodes.
static void localise(const SbEhlSolution *s) {
  const SbEhlState *state = &s->state;
  const SbEhlCase *c = &s->c;
  for (int i = 0; i < s->mesh.dofs; i++) {
    SbEhlRoughPoint *at = &s->solver->point[i];
    sb_ehl_rough_point(at, c, state->t[i]);
    at->p = state->nodal[i] - at->solid;
    at->k = -at->solid_t / at->h_t;
    at->r = s->solver->gaps[i] - at->h;
    double m, m_h, m_p;
    sb_film_mobility(&m, &m_h, &m_p, &c->fluid, at->h, at->p);
    double h = at->h, slope = state->s[i];
    m_h = m_h * at->flow + m * at->flow_h;
    m_p *= at->flow;
    m *= at->flow;
    double G = h * h * h * m;
    at->s0 = -slope + (c->layers.lambda * at->drag - state->flow) / G;
    at->s_h = (c->layers.lambda * at->drag_h - (3 * h * h * m + h * h * h * m_h) * slope) / G;
    at->s_p = -h * h * h * m_p * slope / G;
    at->s_flow = -1 / G;
  }
}

// Chooses between full film and cavity at every node; how many changed.
static int choose(SbEhlSolution *solution, double doubt) {
  const SbEhlMesh *mesh = &solution->mesh;
  const SbEhlRoughPoint *point = solution->solver->point;
  SbEhlState *state = &solution->state;
  int changed = 0;
  // Driven back by the outlet the pressure rises all along: nothing breaks.
  const bool back = state->flow < 0 && solution->c.layers.outlet > 0;
  // Against the flow, because the end of the film depends on the positions downstream.
  state->cavity[mesh->dofs - 1] = state->cavity[mesh->dofs - 2];
  for (int i = mesh->dofs - 2; i >= 0; i--) {
    const SbEhlElement *e = &mesh->element[mesh->owner[i]];
    int j = i - e->first_dof;
    bool ends = state->cavity[i + 1] && state->s[i] < 0 && state->s[i + 1] > 0;
    double part[SB_EHL_DEGREE_MAX + 1];
    if (ends) {
      sb_ehl_rough_weights(part, solution, e, j);
    }
    const double *weight = ends ? part : e->table->step[j];
    double sign = ends ? 0 : point[i + 1].p; // pressure at the node by what follows
    for (int k = 0; k <= e->degree; k++) {
      sign -= e->h * weight[k] * state->s[e->first_dof + k];
    }
    // Changed only where the last step leaves no doubt about the sign.
    bool cavitated = fabs(sign) < doubt * point[i].asperity ? state->cavity[i] : sign < 0;
    cavitated = cavitated && !(i == 0 && !isfinite(solution->c.supply)) && !back;
    changed += cavitated != state->cavity[i];
    state->cavity[i] = cavitated;
  }
  return changed;
}

// Adds to a row the coefficients of dh and dp at node n.
static void add_node(double *row, double *right, const SbEhlSolution *s, int n, double by_h,
                     double by_p) {
  const SbEhlRoughPoint *at = &s->solver->point[n];
  double gap = by_h + by_p * at->k;
  *right -= gap * at->r;
  row[n] += by_p;
  if (gap != 0) {
    add_gap(row, s, n, gap);
  }
}

// The row that gives the film pressure at node n.
static void give_pressure(double *row, double *right, const SbEhlSolution *s, int n, double p) {
  *right = p - s->solver->point[n].p;
  add_node(row, right, s, n, 0, 1);
}

// Reynolds' equation from node i to the next, or to the end of the film between them.
static void give_step(double *row, double *right, const SbEhlSolution *s, int i) {
  const SbEhlElement *e = &s->mesh.element[s->mesh.owner[i]];
  const SbEhlRoughPoint *point = s->solver->point;
  double weight[SB_EHL_DEGREE_MAX + 1];
  sb_ehl_rough_weights(weight, s, e, i - e->first_dof);
  *right = point[i].p - point[i + 1].p;
  for (int k = 0; k <= e->degree; k++) {
    int n = e->first_dof + k;
    double w = e->h * weight[k];
    *right += w * (s->state.s[n] + point[n].s0);
    add_node(row, right, s, n, -w * point[n].s_h, -w * point[n].s_p + (n == i + 1) - (n == i));
    row[s->mesh.dofs + 1] -= w * point[n].s_flow;
  }
}

// The system, whose rows get one size each.
static void assemble_rough(const SbEhlSolution *s) {
  const SbEhlState *state = &s->state;
  const SbEhlCase *c = &s->c;
  const int nodes = s->mesh.dofs, order = nodes + 2;
  double *row = s->solver->matrix, *right = s->solver->right;
  for (int i = 0; i < order; i++, row += order, right++) {
    if (i == 0 && (isfinite(c->supply) || c->rough.sealed)) { // flux supplied
      *right = (c->rough.sealed ? 0 : c->layers.lambda * c->supply) - state->flow;
      row[nodes + 1] = 1;
    } else if (i == 0) {
      give_pressure(row, right, s, 0, c->layers.inlet);
    } else if (i == nodes) {
      give_pressure(row, right, s, nodes - 1, c->layers.outlet);
    } else if (i == nodes + 1) {
      give_load(row, right, s);
    } else if (state->cavity[i - 1]) {
      give_pressure(row, right, s, i - 1, c->rough.sealed ? state->given[i - 1] : 0);
    } else {
      give_step(row, right, s, i - 1);
    }
    double largest = fabs(row[cblas_idamax(nodes + 1, row, 1)]);
    double scale = largest > 0 ? 1 / largest : 1; // the last column has a size of its own
    cblas_dscal(order, scale, row, 1);
    *right *= scale;
  }
}

static bool ready_rough(Progress *p, SbEhlSolution *s) {
  localise(s);
  // A shortened step leaves film pressures with an error of the total pressure. Where the
  // asperities carry little, that error is larger than the doubt that choose() assumes, and a
  // cautious case keeps its cavity after such a step.
  const bool chooses = s->c.layers.lambda > 0 && p->before < 0.3 && !s->c.rough.sealed &&
                       !(s->c.rough.cautious && p->cut);
  int changed = chooses ? choose(s, p->before) : 0;
  p->factored = p->factored && changed == 0;
  assemble_rough(s);
  // Converged where no node wants to change sides after a last step that was small; one at the very
  // end of the film may go to and fro without any effect.
  return p->small && (changed == 0 || p->settled > 6);
}

static bool step_rough(Progress *p, SbEhlSolution *s) {
  SbFilmSolver *solver = s->solver;
  const SbEhlCase *c = &s->c;
  SbEhlState *state = &s->state;
  const int nodes = s->mesh.dofs;
  const double *dq = solver->right;
  const double dkappa = dq[nodes + 1];
  for (int i = 0; i < nodes; i++) {
    solver->change[i] = solver->point[i].r;
  }
  add_gap_step(solver->change, s);
  // An opening gap takes its change as it is, a closing one by the parameter, which it cannot
  // outrun: so neither overshoots on the exponential between film and contact.
  double largest = 0, least = INFINITY;
  bool cut = false;
  for (int i = 0; i < nodes; i++) {
    const SbEhlRoughPoint *at = &solver->point[i];
    double dh = solver->change[i];
    double dt = dh / at->h_t;
    if (!isfinite(dt)) {
      return false;
    }
    double dp = dq[i] + at->k * dh;
    state->s[i] += at->s0 + at->s_h * dh + at->s_p * dp + at->s_flow * dkappa;
    // With pull the solids' pressure can have a near-plateau, half a unit of t wide.
    double down = fmax(c->rough.hamaker > 0 ? 0.3 : 1.5, 0.5 * state->t[i]);
    cut = cut || ((dt < -down || dt > 0.5) && fmax(at->h, dh) > SB_EHL_CLOSED);
    state->t[i] = dt > 0.5 ? sb_ehl_rough_of_gap(c, at->h + dh) : state->t[i] + fmax(dt, -down);
    state->nodal[i] += dq[i];
    largest = fmax(largest, fmax(fabs(dh) / (at->h + SB_EHL_CLOSED), fabs(dq[i])));
    least = fmin(least, at->h);
  }
  state->H0 += dq[nodes];
  state->flow += dkappa;
  solver->info->residual = largest;

  // Steps shrink quadratically; what is left at last is rounding: deflections of size one
  // against the gap.
  double rounding = 1e-14 / (least + SB_EHL_CLOSED);
  bool stalled = largest < 100 * rounding && largest > 0.2 * p->before;
  p->cut = cut;
  p->small = !cut && (largest < fmax(1e-8, rounding) || stalled);
  p->settled += p->small ? 1 : 0;
  // Close to the solution the last factors serve again.
  p->factored = !cut && largest < reuse(s, REUSE_ROUGH) * p->before && largest < CLOSE;
  p->before = largest;
  // A start that does not converge is detected early: a good one is below 1 after five steps. Only
  // a meniscus needs time to find its node, but it never returns from far away. At rest a good
  // start moves by at most 0.65 after four steps (250 solves), with adhering tips by more than 10.
  // Where no flow can pass, steps grow without limit, to 1e7 and beyond. A sealed contact is one at
  // rest, whatever the speed of its film.
  const bool rest = c->rough.sealed || !(c->layers.lambda > 0);
  const bool hopeless = rest                  ? p->iteration > 5 && largest > 1e4
                        : isfinite(c->supply) ? p->iteration > 2 && largest > 1e3
                                              : (p->iteration > 7 && largest > 3) ||
                                                    (p->iteration > 20 && largest > 0.1);
  return !hopeless;
}

SbStatus sb_ehl_newton(SbEhlSolution *s) {
  SbFilmSolver *solver = s->solver;
  const bool rough = s->c.rough.rows;
  const int order = order_of(s), most = rough ? ITERATIONS_MAX_ROUGH : ITERATIONS_MAX;
  const size_t size = (size_t)order * (size_t)order * sizeof(double);
  const bool given = solver->base.in_use;
  Progress p = {.before = INFINITY, .moved = INFINITY, .factored = given};
  for (; p.iteration <= most; p.iteration++) {
    if (sb_ehl_cancelled(solver)) {
      return SB_ERROR_CANCELLED;
    }
    deflect(s);
    if (!given || rough) {
      memset(solver->matrix, 0, size);
    }
    if ((rough ? ready_rough : ready_smooth)(&p, s)) {
      return SB_OK;
    }
    if (!p.factored && given) {
      return SB_ERROR_NOT_CONVERGED;
    }
    if (!p.factored) {
      memcpy(solver->factors, solver->matrix, size);
    }
    if (!sb_factor_solve(solver->factors, solver->pivot, solver->right, order, !p.factored)) {
      return SB_ERROR_NOT_CONVERGED;
    }
    solver->info->newton_iterations++;
    p.factored = true;
    if (!(rough ? step_rough : step_smooth)(&p, s)) {
      return SB_ERROR_NOT_CONVERGED;
    }
  }
  return SB_ERROR_NOT_CONVERGED;
}

SbStatus sb_ehl_factor(SbEhlSolution *s) {
  SbFilmSolver *solver = s->solver;
  const int order = order_of(s);
  const size_t size = (size_t)order * (size_t)order * sizeof(double);
  deflect(s);
  memset(solver->matrix, 0, size);
  if (s->c.rough.rows) {
    localise(s);
    assemble_rough(s);
  } else {
    (void)assemble_smooth(s);
  }
  memcpy(solver->factors, solver->matrix, size);
  return sb_factor_solve(solver->factors, solver->pivot, solver->right, order, true)
             ? SB_OK
             : SB_ERROR_NOT_CONVERGED;
}
