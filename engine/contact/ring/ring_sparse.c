// The ring's sparse equations: pattern, conditions of nodes, factorisation.
//
// Rows are stored by node pairs and handed to KLU (Davis and Palamadai Natarajan 2010) as the
// transpose. Ordering is found once per mesh and pivots with the first matrix; later ones are
// factorised along the same pivots, without allocation, in less than half the time that a
// multifrontal code takes with so few unknowns. Each solution's residual is checked, and the pivots
// are chosen anew where they no longer serve. A condition replaces the two rows of its node
// (Dirichlet along a normal, balance with friction along the tangent); the raw rows are kept, since
// their residual is the reaction.
#include "engine/contact/ring/ring_fem.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <suitesparse/klu.h>

// Largest residual of a solution, relative to the terms it is the sum of, that pivots may leave.
static const double RESIDUAL_MOST = 1e-11;

// What KLU holds for one matrix. `numeric` NULL: no pivots yet.
struct SbRingFactor {
  klu_common common;
  klu_symbolic *symbolic;
  klu_numeric *numeric;
};

// Sparse rows: node neighbours, where each element block goes, where the diagonal blocks are.
SbStatus sb_ring_sparse_create(SbRingFem *fem, SbReport *report) {
  const SbRingMesh *mesh = fem->mesh;
  size_t nodes = (size_t)mesh->nodes, corners = 6 * (size_t)mesh->elements;
  // Room for rows in which each element has its own entries, though neighbours share theirs.
  size_t most = 24 * corners;
  fem->row_start = malloc(sizeof(int) * (2 * nodes + 1));
  fem->scatter = malloc(sizeof(int) * 6 * corners);
  fem->diagonal = malloc(sizeof(int) * nodes);
  fem->column = malloc(sizeof(int) * most);
  fem->value = malloc(sizeof(double) * most);
  fem->raw = malloc(sizeof(double) * most);
  fem->factor = calloc(1, sizeof *fem->factor);
  // The elements' corners at each node, as lists; of a row's neighbours, which row last had each
  // and where.
  int *next = malloc(sizeof(int) * (corners + 3 * nodes));
  int *first = next + corners, *seen = first + nodes, *place = seen + nodes, at = 0;
  if (fem->row_start == NULL || fem->scatter == NULL || fem->diagonal == NULL ||
      fem->column == NULL || fem->value == NULL || fem->raw == NULL || fem->factor == NULL ||
      next == NULL) {
    free(next);
    return sb_fail(report, SB_ERROR_MEMORY, "no memory for the ring's matrix");
  }
  memset(first, -1, sizeof(int) * 2 * nodes);
  for (int i = (int)corners - 1; i >= 0; i--) {
    next[i] = first[mesh->tri[i]];
    first[mesh->tri[i]] = i;
  }
  for (int i = 0; i < mesh->nodes; i++) {
    int width = 0;
    for (int c = first[i]; c >= 0; c = next[c]) {
      for (int b = 0; b < 6; b++) {
        int other = mesh->tri[c / 6 * 6 + b];
        if (seen[other] != i) {
          seen[other] = i;
          place[other] = width;
          fem->column[at + width++] = 2 * other;
          fem->column[at + width++] = 2 * other + 1;
        }
        fem->scatter[6 * c + b] = place[other];
      }
    }
    fem->diagonal[i] = place[i];
    fem->row_start[2 * i] = at;
    fem->row_start[2 * i + 1] = at + width;
    memcpy(&fem->column[at + width], &fem->column[at], sizeof(int) * (size_t)width);
    at += 2 * width;
  }
  fem->row_start[2 * nodes] = at;
  free(next);
  SbRingFactor *factor = fem->factor;
  klu_defaults(&factor->common);
  factor->common.btf = 0;   // the pattern is that of one connected body
  factor->common.scale = 0; // conditions are scaled to their rows
  factor->symbolic = klu_analyze(2 * mesh->nodes, fem->row_start, fem->column, &factor->common);
  return factor->symbolic != NULL
             ? SB_OK
             : sb_fail(report, SB_ERROR_MEMORY, "no memory for the ring's matrix");
}

void sb_ring_sparse_finish(SbRingFem *fem) {
  SbRingFactor *factor = fem->factor;
  if (factor != NULL) {
    klu_free_numeric(&factor->numeric, &factor->common);
    klu_free_symbolic(&factor->symbolic, &factor->common);
    free(factor);
    fem->factor = NULL;
  }
}

static void add(SbRingFem *fem, int row, int column, double k) {
  // Short rows: a linear search is quicker than a map and only boundary terms come here.
  for (int at = fem->row_start[row]; at < fem->row_start[row + 1]; at++) {
    if (fem->column[at] == column) {
      fem->value[at] += k;
      return;
    }
  }
}

void sb_ring_fem_add(SbRingFem *fem, int a, int i, int b, int j, double k) {
  add(fem, 2 * a + i, 2 * b + j, k);
}

// Replaces the two rows of a conditioned node; the raw rows are kept for its reaction.
static void apply_condition(SbRingFem *fem, int node) {
  const SbRingCondition *c = &fem->condition[node];
  int start = fem->row_start[2 * node], width = fem->row_start[2 * node + 1] - start;
  double *row[2] = {&fem->value[start], &fem->value[start + width]};
  memcpy(&fem->raw[start], row[0], sizeof(double) * 2 * (size_t)width);
  int diagonal = fem->diagonal[node];
  double scale = fmax(fabs(row[0][diagonal]), fabs(row[1][diagonal + 1]));
  double r0 = fem->residual[2 * node], r1 = fem->residual[2 * node + 1];
  double *rhs = &fem->rhs[2 * node];
  // The constraint takes the row of its larger component, so that no pivot vanishes, the tangential
  // balance or the other constraint that of the other.
  const double *n = c->direction[0], *t = c->direction[1];
  int fixed = fabs(n[0]) >= fabs(n[1]) ? 0 : 1, other = 1 - fixed;
  double w0 = c->count == 1 ? t[0] + c->mix * n[0] : 0.0;
  double w1 = c->count == 1 ? t[1] + c->mix * n[1] : 0.0;
  for (int k = 0; k < width; k++) {
    double balance = w0 * row[0][k] + w1 * row[1][k];
    row[fixed][k] = 0.0;
    row[other][k] = balance;
  }
  row[fixed][diagonal] = scale * n[0];
  row[fixed][diagonal + 1] = scale * n[1];
  rhs[fixed] = scale * c->gap[0];
  if (c->count == 2) {
    row[other][diagonal] = scale * t[0];
    row[other][diagonal + 1] = scale * t[1];
    rhs[other] = scale * c->gap[1];
  } else {
    row[other][diagonal + 1] +=
        c->curve * (c->mix * (t[0] * r0 + t[1] * r1) - (n[0] * r0 + n[1] * r1));
    rhs[other] = c->drive - (w0 * r0 + w1 * r1);
    for (int b = 0; b < c->beside_count; b++) {
      for (int k = 0; k < 2; k++) {
        add(fem, 2 * node + other, 2 * c->beside[b] + k, -c->drive_slope[b][k]);
      }
    }
  }
}

// Factorises with new pivots.
static SbStatus choose_pivots(SbRingFem *fem, SbReport *report) {
  SbRingFactor *factor = fem->factor;
  klu_free_numeric(&factor->numeric, &factor->common);
  factor->numeric =
      klu_factor(fem->row_start, fem->column, fem->value, factor->symbolic, &factor->common);
  if (factor->numeric != NULL && factor->common.status == KLU_OK) {
    return SB_OK;
  }
  klu_free_numeric(&factor->numeric, &factor->common);
  return factor->common.status == KLU_OUT_OF_MEMORY
             ? sb_fail(report, SB_ERROR_MEMORY, "no memory to factorise the ring's matrix")
             : sb_fail(report, SB_ERROR_NOT_CONVERGED, "the ring's stiffness is singular");
}

SbStatus sb_ring_fem_factor(SbRingFem *fem, SbReport *report) {
  SbRingFactor *factor = fem->factor;
  int nodes = fem->mesh->nodes;
  for (int i = 0; i < 2 * nodes; i++) {
    fem->rhs[i] = -fem->residual[i];
  }
  for (int i = 0; i < nodes; i++) {
    if (fem->condition[i].count > 0) {
      apply_condition(fem, i);
    }
  }
  bool good =
      factor->numeric != NULL && klu_refactor(fem->row_start, fem->column, fem->value,
                                              factor->symbolic, factor->numeric, &factor->common);
  return good ? SB_OK : choose_pivots(fem, report);
}

// Solves for du with the present factors; the largest residual over the largest sum of its terms'
// sizes, infinite where the solution is not finite.
static double solve(SbRingFem *fem) {
  SbRingFactor *factor = fem->factor;
  int n = 2 * fem->mesh->nodes;
  memcpy(fem->du, fem->rhs, sizeof(double) * (size_t)n);
  if (!klu_tsolve(factor->symbolic, factor->numeric, n, 1, fem->du, &factor->common)) {
    return INFINITY;
  }
  double most = 0.0, scale = 0.0;
  for (int i = 0; i < n; i++) {
    double sum = -fem->rhs[i], size = fabs(sum);
    for (int k = fem->row_start[i]; k < fem->row_start[i + 1]; k++) {
      double term = fem->value[k] * fem->du[fem->column[k]];
      sum += term;
      size += fabs(term);
    }
    if (!isfinite(sum)) {
      return INFINITY;
    }
    most = fmax(most, fabs(sum));
    scale = fmax(scale, size);
  }
  return scale > 0.0 ? most / scale : 0.0;
}

SbStatus sb_ring_fem_apply_factor(SbRingFem *fem, SbReport *report) {
  double residual = solve(fem);
  if (!(residual <= RESIDUAL_MOST)) {
    SbStatus status = choose_pivots(fem, report);
    if (status != SB_OK) {
      return status;
    }
    residual = solve(fem);
  }
  return isfinite(residual)
             ? SB_OK
             : sb_fail(report, SB_ERROR_NOT_CONVERGED, "the ring's stiffness is singular");
}

SbStatus sb_ring_fem_solve(SbRingFem *fem, SbReport *report) {
  SbStatus status = sb_ring_fem_factor(fem, report);
  return status == SB_OK ? sb_ring_fem_apply_factor(fem, report) : status;
}

void sb_ring_fem_reaction(const SbRingFem *fem, int node, double force[2]) {
  int start = fem->row_start[2 * node], width = fem->row_start[2 * node + 1] - start;
  const double *raw = &fem->raw[start];
  for (int c = 0; c < 2; c++) {
    double sum = fem->residual[2 * node + c];
    for (int k = 0; k < width; k++) {
      sum += raw[c * width + k] * fem->du[fem->column[start + k]];
    }
    force[c] = sum;
  }
}

double sb_ring_fem_free_residual(const SbRingFem *fem) {
  double largest = fem->residual_inner;
  for (int i = 0; i < fem->mesh->nodes; i++) {
    const SbRingCondition *c = &fem->condition[i];
    double r0 = fem->residual[2 * i], r1 = fem->residual[2 * i + 1];
    if (c->count == 0) {
      largest = fmax(largest, fmax(fabs(r0), fabs(r1)));
    } else if (c->count == 1) {
      const double *n = c->direction[0], *t = c->direction[1];
      double balance = (t[0] + c->mix * n[0]) * r0 + (t[1] + c->mix * n[1]) * r1 - c->drive;
      largest = fmax(largest, fabs(balance));
    }
  }
  return largest;
}
