// The ring's sparse equations: pattern, conditions of nodes, factorisation.
//
// Stored by blocks of node pairs, in rows; the ordering and the factors' pattern are determined
// once per mesh. The residual of each solution is checked, and refined if necessary. A condition
// replaces the two rows of its node (Dirichlet along a normal, balance with friction along the
// tangent). The original rows are stored, because their residual is the reaction.
#include "engine/contact/ring/ring_fem.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

// Largest residual of a solution, relative to the terms it is the sum of, that is left; refinements
// until then.
static const double RESIDUAL_MOST = 1e-11;
enum { REFINEMENTS = 3 };

// Returns the number of blocks to allocate: each element has its own in its rows, although
// neighbours share theirs, and nodes in one hollow, which may have contact, have one for each pair.
static size_t count_blocks(const SbRingFem *fem) {
  const SbRingMesh *mesh = fem->mesh;
  size_t most = 36 * (size_t)mesh->elements;
  for (int i = 0; i < mesh->loop_count; i++) {
    for (int k = 0; k < mesh->loop_count && fem->hollow[i] != 0; k++) {
      most += fem->hollow[k] == fem->hollow[i] ? 1 : 0;
    }
  }
  return most;
}

// Work memory of a pattern: the elements' corners at each node, as lists; of a row's neighbours,
// which row last had each and where; the place of a node on the boundary, -1: inside.
typedef struct {
  int *next, *first, *seen, *place, *by; // next: owned, with the memory of the others
} Lists;

static bool create_lists(Lists *l, const SbRingMesh *mesh) {
  const size_t nodes = (size_t)mesh->nodes, corners = 6 * (size_t)mesh->elements;
  l->next = malloc(sizeof(int) * (corners + 4 * nodes));
  if (l->next == NULL) {
    return false;
  }
  l->first = l->next + corners;
  l->seen = l->first + nodes;
  l->place = l->seen + nodes;
  l->by = l->place + nodes;
  memset(l->first, -1, sizeof(int) * 2 * nodes);
  memset(l->by, -1, sizeof(int) * nodes);
  for (int i = 0; i < mesh->loop_count; i++) {
    l->by[mesh->loop[i]] = i;
  }
  for (int i = (int)corners - 1; i >= 0; i--) {
    l->next[i] = l->first[mesh->tri[i]];
    l->first[mesh->tri[i]] = i;
  }
  return true;
}

// Writes the pattern's rows: node neighbours, where each element's blocks go, where the diagonal
// blocks are. Returns the number of blocks.
static int write_rows(SbRingFem *fem, const Lists *l) {
  const SbRingMesh *mesh = fem->mesh;
  int at = 0;
  for (int i = 0; i < mesh->nodes; i++) {
    fem->row_start[i] = at;
    for (int c = l->first[i]; c >= 0; c = l->next[c]) {
      for (int b = 0; b < 6; b++) {
        int other = mesh->tri[c / 6 * 6 + b];
        if (l->seen[other] != i) {
          l->seen[other] = i;
          l->place[other] = at;
          fem->column[at++] = other;
        }
        fem->scatter[6 * c + b] = l->place[other];
      }
    }
    const int by = l->by[i];
    for (int k = 0; by >= 0 && fem->hollow[by] != 0 && k < mesh->loop_count; k++) {
      const int other = mesh->loop[k];
      if (fem->hollow[k] == fem->hollow[by] && l->seen[other] != i) {
        l->seen[other] = i;
        fem->column[at++] = other;
      }
    }
    fem->diagonal[i] = l->place[i];
  }
  fem->row_start[mesh->nodes] = at;
  return at;
}

SbStatus sb_ring_sparse_create(SbRingFem *fem, SbReport *report) {
  const SbRingMesh *mesh = fem->mesh;
  const size_t nodes = (size_t)mesh->nodes;
  Lists lists = {0};
  fem->hollow = malloc(sizeof(int) * ((size_t)mesh->loop_count + 1));
  if (fem->hollow != NULL) {
    sb_ring_hollows(fem->hollow, mesh);
    const size_t most = count_blocks(fem);
    fem->row_start = malloc(sizeof(int) * (nodes + 1));
    fem->scatter = malloc(sizeof(int) * most);
    fem->diagonal = malloc(sizeof(int) * nodes);
    fem->column = malloc(sizeof(int) * most);
  }
  if (fem->row_start != NULL && fem->scatter != NULL && fem->diagonal != NULL &&
      fem->column != NULL && create_lists(&lists, mesh)) {
    const size_t blocks = (size_t)write_rows(fem, &lists);
    fem->value = malloc(sizeof(double) * SB_RING_BLOCK * blocks); // cleared where it is assembled
    fem->raw = calloc(SB_RING_BLOCK * blocks, sizeof(double));
  }
  free(lists.next);
  return fem->value != NULL && fem->raw != NULL
             ? SB_OK
             : sb_fail(report, SB_ERROR_MEMORY, "no memory for the ring's matrix");
}

static void add(SbRingFem *fem, int row, int column, int entry, double k) {
  // Short rows: a linear search is quicker than a map and only boundary terms come here.
  for (int at = fem->row_start[row]; at < fem->row_start[row + 1]; at++) {
    if (fem->column[at] == column) {
      fem->value[SB_RING_BLOCK * at + entry] += k;
      return;
    }
  }
}

void sb_ring_fem_add(SbRingFem *fem, int a, int i, int b, int j, double k) {
  add(fem, a, b, 2 * i + j, k);
}

// Replaces the two rows of a conditioned node; the original rows are stored for its reaction.
static void apply_condition(SbRingFem *fem, int node) {
  const SbRingCondition *c = &fem->condition[node];
  const int start = fem->row_start[node], width = fem->row_start[node + 1] - start;
  double *row = &fem->value[SB_RING_BLOCK * start];
  memcpy(&fem->raw[SB_RING_BLOCK * start], row, sizeof(double) * SB_RING_BLOCK * (size_t)width);
  double *diagonal = &fem->value[SB_RING_BLOCK * fem->diagonal[node]];
  double scale = fmax(fabs(diagonal[0]), fabs(diagonal[3]));
  double r0 = fem->residual[2 * node], r1 = fem->residual[2 * node + 1];
  double *rhs = &fem->rhs[2 * node];
  // The constraint takes the row of its larger component, so that no pivot vanishes, the tangential
  // balance or the other constraint that of the other.
  const double *n = c->direction[0], *t = c->direction[1];
  int fixed = fabs(n[0]) >= fabs(n[1]) ? 0 : 1, other = 1 - fixed;
  double w0 = c->count == 1 ? t[0] + c->mix * n[0] : 0.0;
  double w1 = c->count == 1 ? t[1] + c->mix * n[1] : 0.0;
  for (int k = 0; k < width; k++, row += SB_RING_BLOCK) {
    for (int j = 0; j < 2; j++) {
      double balance = w0 * row[j] + w1 * row[2 + j];
      row[2 * fixed + j] = 0.0;
      row[2 * other + j] = balance;
    }
  }
  diagonal[2 * fixed] = scale * n[0];
  diagonal[2 * fixed + 1] = scale * n[1];
  rhs[fixed] = scale * c->gap[0];
  if (c->count == 2) {
    diagonal[2 * other] = scale * t[0];
    diagonal[2 * other + 1] = scale * t[1];
    rhs[other] = scale * c->gap[1];
  } else {
    diagonal[2 * other + c->axis] +=
        c->curve * (c->mix * (t[0] * r0 + t[1] * r1) - (n[0] * r0 + n[1] * r1));
    rhs[other] = c->drive - (w0 * r0 + w1 * r1);
    for (int b = 0; b < c->beside_count; b++) {
      for (int k = 0; k < 2; k++) {
        add(fem, node, c->beside[b], 2 * other + k, -c->drive_slope[b][k]);
      }
    }
  }
}

SbStatus sb_ring_fem_factor(SbRingFem *fem, SbReport *report) {
  int nodes = fem->mesh->nodes;
  if (fem->factor == NULL) { // many linearised states are never factorised
    fem->factor = sb_ring_factor_create(nodes, fem->row_start, fem->column);
  }
  if (fem->factor == NULL) {
    return sb_fail(report, SB_ERROR_MEMORY, "no memory for the ring's matrix");
  }
  for (int i = 0; i < 2 * nodes; i++) {
    fem->rhs[i] = -fem->residual[i];
  }
  for (int i = 0; i < nodes; i++) {
    if (fem->condition[i].count > 0) {
      apply_condition(fem, i);
    }
  }
  return sb_ring_factor_compute(fem->factor, fem->value)
             ? SB_OK
             : sb_fail(report, SB_ERROR_NOT_CONVERGED, "the ring's stiffness is singular");
}

// Computes the residual of rhs for the present du, in `left`. Returns its largest value divided by
// the largest sum of the magnitudes of its terms; infinite if it is not finite.
static double leaves(const SbRingFem *fem, double *left) {
  double most = 0.0, scale = 0.0;
  for (int i = 0; i < fem->mesh->nodes; i++) {
    double sum[2] = {fem->rhs[2 * i], fem->rhs[2 * i + 1]};
    double size[2] = {fabs(sum[0]), fabs(sum[1])};
    for (int k = fem->row_start[i]; k < fem->row_start[i + 1]; k++) {
      const double *a = &fem->value[SB_RING_BLOCK * k], *u = &fem->du[2 * fem->column[k]];
      for (int r = 0; r < 2; r++) {
        sum[r] -= a[2 * r] * u[0] + a[2 * r + 1] * u[1];
        size[r] += fabs(a[2 * r] * u[0]) + fabs(a[2 * r + 1] * u[1]);
      }
    }
    for (int r = 0; r < 2; r++) {
      if (!isfinite(sum[r])) {
        return INFINITY;
      }
      left[2 * i + r] = sum[r];
      most = fmax(most, fabs(sum[r]));
      scale = fmax(scale, size[r]);
    }
  }
  return scale > 0.0 ? most / scale : 0.0;
}

SbStatus sb_ring_fem_apply_factor(SbRingFem *fem, SbReport *report) {
  double *left = fem->left;
  sb_ring_factor_solve(fem->factor, fem->du, fem->rhs);
  double size = leaves(fem, left);
  for (int i = 0; i < REFINEMENTS && size > RESIDUAL_MOST && isfinite(size); i++) {
    sb_ring_factor_solve(fem->factor, left, left);
    for (int k = 0; k < 2 * fem->mesh->nodes; k++) {
      fem->du[k] += left[k];
    }
    size = leaves(fem, left);
  }
  return size <= RESIDUAL_MOST
             ? SB_OK
             : sb_fail(report, SB_ERROR_NOT_CONVERGED, "the ring's stiffness is singular");
}

SbStatus sb_ring_fem_solve(SbRingFem *fem, SbReport *report) {
  SbStatus status = sb_ring_fem_factor(fem, report);
  return status == SB_OK ? sb_ring_fem_apply_factor(fem, report) : status;
}

void sb_ring_fem_reaction(const SbRingFem *fem, int node, double force[2]) {
  force[0] = fem->residual[2 * node];
  force[1] = fem->residual[2 * node + 1];
  for (int k = fem->row_start[node]; k < fem->row_start[node + 1]; k++) {
    const double *a = &fem->raw[SB_RING_BLOCK * k], *u = &fem->du[2 * fem->column[k]];
    force[0] += a[0] * u[0] + a[1] * u[1];
    force[1] += a[2] * u[0] + a[3] * u[1];
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
