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

double sb_ehl_rough_film_end(const SbEhlTable *rule, const double *s, int j) {
  double low = rule->node[j], high = rule->node[j + 1];
  return !(s[j] < 0)       ? low
         : !(s[j + 1] > 0) ? high
                           : sb_bisect(fall_at, &(Slopes){rule, s}, low, high);
}

// The linear elastic equation's gap into solver->gaps, and everything at the nodes.
static void localise(const SbEhlSolution *s) {
  const SbEhlMesh *mesh = &s->mesh;
  const SbEhlState *state = &s->state;
  const SbEhlCase *c = &s->c;
  SbEhlRoughStep *l = &s->solver->step;
  double *gaps = s->solver->gaps;
  for (int i = 0; i < mesh->dofs; i++) {
    gaps[i] = state->H0 + mesh->gap_known[i];
  }
  cblas_dgemv(CblasRowMajor, CblasNoTrans, mesh->dofs, mesh->dofs, 1.0, mesh->gap, mesh->dofs,
              state->nodal, 1, 1.0, gaps, 1);
  for (int i = 0; i < mesh->dofs; i++) {
    SbEhlRoughPoint *at = &s->solver->point[i];
    sb_ehl_rough_point(at, c, state->t[i]);
    l->p[i] = state->nodal[i] - at->solid;
    l->k[i] = -at->solid_t / at->h_t;
    l->r[i] = gaps[i] - at->h;
    double m, m_h, m_p;
    sb_film_mobility(&m, &m_h, &m_p, &c->fluid, at->h, l->p[i]);
    double h = at->h, slope = state->s[i];
    double G = h * h * h * m;
    l->s0[i] = -slope + (c->layers.lambda * h - state->flow) / G;
    l->s_h[i] = (c->layers.lambda - (3 * h * h * m + h * h * h * m_h) * slope) / G;
    l->s_p[i] = -h * h * h * m_p * slope / G;
    l->s_kappa[i] = -1 / G;
  }
}

// What Reynolds' equation lacks from node to node.
static void residuals(SbEhlRoughStep *l, const SbEhlMesh *mesh, const SbEhlTable *rule,
                      const SbEhlState *state) {
  for (int e = 0; e < mesh->count; e++) {
    double half = mesh->element[e].h;
    for (int j = 0; j < rule->degree; j++) {
      int i = e * rule->degree + j;
      double sum = 0;
      for (int k = 0; k <= rule->degree; k++) {
        sum += rule->step[j][k] * state->s[e * rule->degree + k];
      }
      l->step[i] = l->p[i + 1] - l->p[i] - half * sum;
    }
  }
}

// Chooses between full film and cavity at every node; how many changed.
static int choose(const SbEhlRoughStep *l, const SbEhlMesh *mesh, const SbEhlTable *rule,
                  SbEhlState *state, const SbEhlRoughPoint *point, bool flooded, double doubt) {
  int changed = 0;
  // Against the flow, as the end of the film depends on what lies behind.
  state->cavity[mesh->dofs - 1] = state->cavity[mesh->dofs - 2];
  for (int i = mesh->dofs - 2; i >= 0; i--) {
    double residual = l->step[i];
    if (state->cavity[i + 1] && state->s[i] < 0 && state->s[i + 1] > 0) {
      int e = i / rule->degree, j = i % rule->degree;
      double end = sb_ehl_rough_film_end(rule, &state->s[e * rule->degree], j);
      double weight[SB_EHL_DEGREE_MAX + 1];
      sb_ehl_partial(weight, rule, j, end);
      double sum = 0;
      for (int k = 0; k <= rule->degree; k++) {
        sum += weight[k] * state->s[e * rule->degree + k];
      }
      residual = -l->p[i] - mesh->element[e].h * sum;
    }
    // Changed only where the last step leaves no doubt about the sign.
    double sign = l->p[i] + residual;
    bool cavitated = fabs(sign) < doubt * point[i].asperity ? state->cavity[i] : sign < 0;
    cavitated = cavitated && !(i == 0 && flooded);
    changed += cavitated != state->cavity[i];
    state->cavity[i] = cavitated;
  }
  return changed;
}

// Adds coefficient times dh (and dp) of node n to a row (NULL: to the constant only).
static void add_node(double *row, double *constant, const SbEhlMesh *mesh, const SbEhlRoughStep *l,
                     int n, double by_h, double by_p) {
  double gap = by_h + by_p * l->k[n];
  *constant += gap * l->r[n];
  if (row == NULL) {
    return;
  }
  if (gap != 0) {
    cblas_daxpy(mesh->dofs, gap, mesh->gap + (size_t)n * (size_t)mesh->dofs, 1, row, 1);
  }
  row[n] += by_p;
  row[mesh->dofs] += gap; // H0
}

// Row i of the matrix, NULL without one.
static double *row_of(double *matrix, int order, int i) {
  return matrix != NULL ? matrix + (size_t)i * (size_t)order : NULL;
}

// Right-hand side and, if `matrix` is not NULL, the matrix, whose rows get one size each; without
// it the right-hand side is for the matrix of an earlier call.
static void assemble(double *matrix, double *row_scale, const SbEhlSolution *s,
                     const SbEhlTable *rule) {
  const SbEhlMesh *mesh = &s->mesh;
  const SbEhlState *state = &s->state;
  const SbEhlCase *c = &s->c;
  const SbEhlRoughStep *l = &s->solver->step;
  double *right = s->solver->right;
  int nodes = mesh->dofs;
  int order = nodes + 2;
  int d = rule->degree;
  if (matrix != NULL) {
    memset(matrix, 0, (size_t)order * (size_t)order * sizeof *matrix);
  }

  // Inlet: its pressure, or the flux supplied.
  double *row = matrix;
  if (isfinite(c->supply) || c->rough.sealed) {
    if (row != NULL) {
      row[nodes + 1] = 1;
    }
    right[0] = (c->rough.sealed ? 0 : c->layers.lambda * c->supply) - state->flow;
  } else {
    double constant = 0;
    add_node(row, &constant, mesh, l, 0, 0, 1);
    right[0] = c->layers.inlet - l->p[0] - constant;
  }
  // Steps.
  for (int i = 0; i < nodes - 1; i++) {
    row = row_of(matrix, order, i + 1);
    double constant = 0;
    if (state->cavity[i]) {
      add_node(row, &constant, mesh, l, i, 0, 1);
      right[i + 1] =
          (c->rough.sealed ? sb_film_ends(mesh->x[i], c->layers.inlet, c->layers.outlet) : 0) -
          l->p[i] - constant;
      continue;
    }
    int e = i / d, j = i % d;
    double half = mesh->element[e].h;
    double weight[SB_EHL_DEGREE_MAX + 1];
    memcpy(weight, rule->step[j], sizeof weight);
    if (state->cavity[i + 1]) {
      sb_ehl_partial(weight, rule, j, sb_ehl_rough_film_end(rule, &state->s[e * rule->degree], j));
    }
    double residual = l->p[i + 1] - l->p[i];
    for (int k = 0; k <= d; k++) {
      int n = e * d + k;
      double w = half * weight[k];
      residual -= w * (state->s[n] + l->s0[n]);
      double by_p = -w * l->s_p[n] + (k == j + 1 ? 1 : k == j ? -1 : 0);
      add_node(row, &constant, mesh, l, n, -w * l->s_h[n], by_p);
      if (row != NULL) {
        row[nodes + 1] -= w * l->s_kappa[n];
      }
    }
    right[i + 1] = -residual - constant;
  }
  // Outlet.
  row = row_of(matrix, order, nodes);
  double constant = 0;
  add_node(row, &constant, mesh, l, nodes - 1, 0, 1);
  right[nodes] = c->layers.outlet - l->p[nodes - 1] - constant;
  // Load above the ambient step.
  row = row_of(matrix, order, nodes + 1);
  if (row != NULL) {
    memcpy(row, mesh->load, (size_t)nodes * sizeof *row);
  }
  right[nodes + 1] = -sb_ehl_load(s);

  for (int i = 0; i < order; i++) {
    if (matrix != NULL) {
      row = row_of(matrix, order, i);
      double largest = fabs(row[cblas_idamax(nodes + 1, row, 1)]);
      row_scale[i] = largest > 0 ? 1 / largest : 1; // the last column has a size of its own
      cblas_dscal(order, row_scale[i], row, 1);
    }
    right[i] *= row_scale[i];
  }
}

SbStatus sb_ehl_rough_newton(SbEhlSolution *s) {
  SbFilmSolver *solver = s->solver;
  const SbEhlCase *c = &s->c;
  const SbEhlMesh *mesh = &s->mesh;
  SbEhlState *state = &s->state;
  const SbEhlTable *rule = mesh->element[0].table;
  int nodes = mesh->dofs;
  SbEhlRoughStep *local = &solver->step;
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
    residuals(local, mesh, rule, state);
    int changed = 0;
    if (c->layers.lambda > 0 && before < 0.3) {
      changed = choose(local, mesh, rule, state, solver->point, !isfinite(c->supply), before);
    }
    // Converged where no node wants to change sides after a last step that was small; one at the
    // very end of the film may go to and fro without any effect.
    if (small && (changed == 0 || settled > 6)) {
      return SB_OK;
    }
    factored = factored && changed == 0;
    assemble(factored ? NULL : solver->matrix, row_scale, s, rule);
    if (!sb_factor_solve(solver->matrix, solver->pivot, solver->right, nodes + 2, !factored)) {
      return SB_ERROR_NOT_CONVERGED;
    }
    solver->info->newton_iterations++;
    const double *dq = solver->right;
    double dH0 = dq[nodes], dkappa = dq[nodes + 1];

    // Changes of the gap, in `gap`, and how far they may go.
    for (int i = 0; i < nodes; i++) {
      solver->gaps[i] = dH0 + local->r[i];
    }
    cblas_dgemv(CblasRowMajor, CblasNoTrans, nodes, nodes, 1.0, mesh->gap, nodes, dq, 1, 1.0,
                solver->gaps, 1);
    // An opening gap takes its change as it is, a closing one by the parameter, which it cannot
    // outrun: so neither overshoots on the exponential between film and contact.
    double largest = 0, least = INFINITY;
    bool cut = false;
    for (int i = 0; i < nodes; i++) {
      const SbEhlRoughPoint *at = &solver->point[i];
      double dh = solver->gaps[i];
      double dt = dh / at->h_t;
      if (!isfinite(dt)) {
        return SB_ERROR_NOT_CONVERGED;
      }
      double dp = dq[i] + local->k[i] * dh;
      state->s[i] +=
          local->s0[i] + local->s_h[i] * dh + local->s_p[i] * dp + local->s_kappa[i] * dkappa;
      // With pull the solids' pressure can have a near-plateau, half a unit of t wide.
      double down = fmax(c->rough.hamaker > 0 ? 0.3 : 1.5, 0.8 * state->t[i]);
      cut = cut || ((dt < -down || dt > 0.5) && fmax(at->h, dh) > SB_EHL_CLOSED);
      state->t[i] = dt > 0.5 ? sb_ehl_rough_of_gap(c, at->h + dh) : state->t[i] + fmax(dt, -down);
      state->nodal[i] += dq[i];
      largest = fmax(largest, fmax(fabs(dh) / (at->h + SB_EHL_CLOSED), fabs(dq[i])));
      least = fmin(least, at->h);
    }
    state->H0 += dH0;
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
