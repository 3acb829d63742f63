// Newton's method on rough rows; equations in ehl.h.
//
// Unknowns of the linear system are the total pressures, H0 and kappa; gap, parameter, slope and
// film pressure follow from them at each node:
//
//   dh = K dq + dH0 + r          r: what the linear elastic equation still lacks
//   dp = dq + k dh               k = -(dp_a/dt) / (dh/dt), the asperities' stiffness
//   G ds = -(rho + (dG/dh s - lambda) dh + dG/dp s dp + dkappa)     G = h^3 m
//
// so that every step leaves the elastic equation, load and flux linear. The rows are Reynolds'
// equation from node to node, or p = 0 in the cavity, the end pressures and the load. A step is
// shortened only where the gap would fall by more than the rough law's parameter can follow.
#include "engine/film/ehl.h"

#include "engine/numeric/dense.h"
#include "engine/numeric/root.h"

#include <cblas.h>
#include <math.h>
#include <string.h>

enum { ITERATIONS_MAX = 40 };

// A step this much shorter than the last lets the next one take the same factors.
static const double REUSE = 0.1;
static const double CLOSE = 0.03;

void sb_ehl_rough_point(SbEhlRoughPoint *out, const SbEhlCase *c, double t) {
  const SbEhlRough *rough = &c->rough;
  SbRoughPoint p = {0};
  if (rough->law != NULL) {
    sb_rough_law_at(&p, rough->law, t);
  } else { // smooth: linear above t = 1, falling exponentially to nothing below
    double unit = rough->smooth_gap * rough->film;
    p.gap = t >= 1 ? unit * t : unit * exp(t - 1);
    p.gap_slope = t >= 1 ? unit : p.gap;
  }
  double pull = 0, pull_slope = 0;
  if (rough->hamaker > 0) {
    pull = sb_rough_pull(&pull_slope, &p, rough->hamaker);
  }
  *out = (SbEhlRoughPoint){.h = p.gap / rough->film,
                           .h_t = p.gap_slope / rough->film,
                           .asperity = p.pressure / rough->pressure,
                           .solid = (p.pressure - pull) / rough->pressure,
                           .solid_t = (p.pressure_slope - pull_slope) / rough->pressure,
                           .share = p.share};
}

double sb_ehl_rough_of_gap(const SbEhlCase *c, double gap) {
  if (c->rough.law != NULL) {
    return sb_rough_law_of_gap(c->rough.law, gap * c->rough.film);
  }
  double t = gap / c->rough.smooth_gap;
  return t >= 1 ? t : 1 + log(t);
}

typedef struct {
  const SbEhlTable *rule;
  const double *slope; // at the element's nodes
} Slopes;

static double fall_at(double r, const void *context) {
  const Slopes *of = context;
  return -sb_ehl_interpolate(of->rule, of->slope, r);
}

double sb_ehl_rough_weights(double *weight, const SbEhlSolution *s, const SbEhlElement *e, int j) {
  const SbEhlTable *t = e->table;
  const double *slope = &s->state.s[e->first_dof];
  double end = t->node[j + 1];
  memcpy(weight, t->step[j], sizeof t->step[j]);
  if (s->state.cavity[e->first_dof + j + 1]) {
    end = !(slope[j] < 0)       ? t->node[j]
          : !(slope[j + 1] > 0) ? end
                                : sb_bisect(fall_at, &(Slopes){t, slope}, t->node[j], end);
    sb_ehl_partial(weight, t, j, end);
  }
  return end;
}

// Everything at the nodes.
static void localise(const SbEhlSolution *s) {
  const SbEhlState *state = &s->state;
  const SbEhlCase *c = &s->c;
  sb_ehl_elastic(s);
  for (int i = 0; i < s->mesh.dofs; i++) {
    SbEhlRoughPoint *at = &s->solver->point[i];
    sb_ehl_rough_point(at, c, state->t[i]);
    at->p = state->nodal[i] - at->solid;
    at->k = -at->solid_t / at->h_t;
    at->r = s->solver->gaps[i] - at->h;
    double m, m_h, m_p;
    sb_film_mobility(&m, &m_h, &m_p, &c->fluid, at->h, at->p);
    double h = at->h, slope = state->s[i];
    double G = h * h * h * m;
    at->s0 = -slope + (c->layers.lambda * h - state->flow) / G;
    at->s_h = (c->layers.lambda - (3 * h * h * m + h * h * h * m_h) * slope) / G;
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
  // Against the flow, as the end of the film depends on what lies behind.
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
    cavitated = cavitated && !(i == 0 && !isfinite(solution->c.supply));
    changed += cavitated != state->cavity[i];
    state->cavity[i] = cavitated;
  }
  return changed;
}

// Adds to a row (NULL: to its right-hand side only) the coefficients of dh and dp at node n.
static void add_node(double *row, double *right, const SbEhlSolution *s, int n, double by_h,
                     double by_p) {
  const SbEhlRoughPoint *at = &s->solver->point[n];
  double gap = by_h + by_p * at->k;
  *right -= gap * at->r;
  if (row != NULL) {
    row[n] += by_p;
    if (gap != 0) {
      sb_ehl_add_gap(row, s, n, gap);
    }
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
    if (row != NULL) {
      row[s->mesh.dofs + 1] -= w * point[n].s_flow;
    }
  }
}

// Right-hand side and, if `matrix` is not NULL, the matrix, whose rows get one size each; without
// it the right-hand side is for the matrix of an earlier call.
static void assemble(double *matrix, double *row_scale, const SbEhlSolution *s) {
  const SbEhlState *state = &s->state;
  const SbEhlCase *c = &s->c;
  const int nodes = s->mesh.dofs, order = nodes + 2;
  if (matrix != NULL) {
    memset(matrix, 0, (size_t)order * (size_t)order * sizeof *matrix);
  }
  for (int i = 0; i < order; i++) {
    double *row = matrix != NULL ? matrix + (size_t)i * (size_t)order : NULL;
    double *right = &s->solver->right[i];
    if (i == 0 && (isfinite(c->supply) || c->rough.sealed)) { // flux supplied
      *right = (c->rough.sealed ? 0 : c->layers.lambda * c->supply) - state->flow;
      if (row != NULL) {
        row[nodes + 1] = 1;
      }
    } else if (i == 0) {
      give_pressure(row, right, s, 0, c->layers.inlet);
    } else if (i == nodes) {
      give_pressure(row, right, s, nodes - 1, c->layers.outlet);
    } else if (i == nodes + 1) { // load above the ambient step
      *right = -sb_ehl_load(s);
      if (row != NULL) {
        memcpy(row, s->mesh.load, (size_t)nodes * sizeof *row);
      }
    } else if (state->cavity[i - 1]) {
      give_pressure(
          row, right, s, i - 1,
          c->rough.sealed ? sb_film_ends(s->mesh.x[i - 1], c->layers.inlet, c->layers.outlet) : 0);
    } else {
      give_step(row, right, s, i - 1);
    }
    if (row != NULL) {
      double largest = fabs(row[cblas_idamax(nodes + 1, row, 1)]);
      row_scale[i] = largest > 0 ? 1 / largest : 1; // the last column has a size of its own
      cblas_dscal(order, row_scale[i], row, 1);
    }
    *right *= row_scale[i];
  }
}

SbStatus sb_ehl_rough_newton(SbEhlSolution *s) {
  SbFilmSolver *solver = s->solver;
  const SbEhlCase *c = &s->c;
  const SbEhlMesh *mesh = &s->mesh;
  SbEhlState *state = &s->state;
  const int nodes = mesh->dofs;
  double before = INFINITY;
  int settled = 0;       // small steps so far
  bool small = false;    // the last one
  bool factored = false; // the matrix holds factors that may serve again
  double row_scale[SB_EHL_DOFS_MAX + 2];
  for (int iteration = 0; iteration < ITERATIONS_MAX; iteration++) {
    if (sb_ehl_cancelled(solver)) {
      return SB_ERROR_CANCELLED;
    }
    localise(s);
    int changed = 0;
    if (c->layers.lambda > 0 && before < 0.3) {
      changed = choose(s, before);
    }
    // Converged where no node wants to change sides after a last step that was small; one at the
    // very end of the film may go to and fro without any effect.
    if (small && (changed == 0 || settled > 6)) {
      return SB_OK;
    }
    factored = factored && changed == 0;
    assemble(factored ? NULL : solver->matrix, row_scale, s);
    if (!sb_factor_solve(solver->matrix, solver->pivot, solver->right, nodes + 2, !factored)) {
      return SB_ERROR_NOT_CONVERGED;
    }
    solver->info->newton_iterations++;
    const double *dq = solver->right;
    double dkappa = dq[nodes + 1];

    for (int i = 0; i < nodes; i++) {
      solver->change[i] = solver->point[i].r;
    }
    sb_ehl_gap_step(solver->change, s);
    // An opening gap takes its change as it is, a closing one by the parameter, which it cannot
    // outrun: so neither overshoots on the exponential between film and contact.
    double largest = 0, least = INFINITY;
    bool cut = false;
    for (int i = 0; i < nodes; i++) {
      const SbEhlRoughPoint *at = &solver->point[i];
      double dh = solver->change[i];
      double dt = dh / at->h_t;
      if (!isfinite(dt)) {
        return SB_ERROR_NOT_CONVERGED;
      }
      double dp = dq[i] + at->k * dh;
      state->s[i] += at->s0 + at->s_h * dh + at->s_p * dp + at->s_flow * dkappa;
      // With pull the solids' pressure can have a near-plateau, half a unit of t wide.
      double down = fmax(c->rough.hamaker > 0 ? 0.3 : 1.5, 0.8 * state->t[i]);
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
    bool stalled = largest < 100 * rounding && largest > 0.2 * before;
    small = !cut && (largest < fmax(1e-8, rounding) || stalled);
    settled += small ? 1 : 0;
    // A start that is none shows soon: a good one is below 1 after five steps. Only a meniscus
    // takes its time to find its node.
    bool hopeless = (iteration > 7 && largest > 3) || (iteration > 20 && largest > 0.1);
    if (c->layers.lambda > 0 && !isfinite(c->supply) && hopeless) {
      return SB_ERROR_NOT_CONVERGED;
    }
    // Close to the solution each step with the same factors gains what the last one gained.
    factored = !cut && largest < REUSE * before && largest < CLOSE;
    before = largest;
  }
  return SB_ERROR_NOT_CONVERGED;
}
