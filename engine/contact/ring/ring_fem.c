// Assembly of the nearly incompressible finite-strain elements and the sparse solve.
//
// Principle: stationary total energy of Psi = W_iso(F) + p (J - 1) - p^2 / (2 K), with u in P2 plus
// a cubic bubble and p in discontinuous P1 (Crouzeix and Raviart 1973; mixed form as in Sussman and
// Bathe 1987). Seven-point quadrature (degree 5). The tangent is consistent and symmetric; bubble
// and pressure are eliminated in each element, so the sparse matrix holds nodal displacements only.
// Leaves out inertia, thermal strain and rate.
//
// Long: the compiler inlines the steps of an element, which have fixed sizes, into one loop.
#include "engine/contact/ring/ring_fem.h"
#include "engine/contact/ring/ring_quad.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum {
  NODES = 6,
  SHAPES = 7,                // six nodes and the bubble
  ROOM = 8,                  // for the shapes' numbers, in quads
  POINT_SIZE = 3 * ROOM + 1, // dR, dZ and N/R of the shapes; weight
  INNER = SB_RING_INNER,     // bubble and pressure
  OUTER = 2 * NODES,         // displacements of the nodes
  RIGHT = OUTER + 1,         // what the inner unknowns respond to: nodes and load
};

// Degree-5 rule: area coordinates l1, l2 of each point and its weight (sum 1).
static const double POINT[SB_RING_FEM_POINTS][3] = {
    {1.0 / 3.0, 1.0 / 3.0, 0.225},
    {0.059715871789769820, 0.470142064105115090, 0.132394152788506181},
    {0.470142064105115090, 0.059715871789769820, 0.132394152788506181},
    {0.470142064105115090, 0.470142064105115090, 0.132394152788506181},
    {0.797426985353087322, 0.101286507323456339, 0.125939180544827153},
    {0.101286507323456339, 0.797426985353087322, 0.125939180544827153},
    {0.101286507323456339, 0.101286507323456339, 0.125939180544827153},
};

// ---- material

// First and second derivatives of the energy. With no shear out of the plane it depends on three
// numbers only: a = F:F of the 2 x 2 in-plane gradient, D its determinant and f the hoop stretch
// (I1 = a + f^2, I2 = D^2 + a f^2, J = D f), so that Mooney-Rivlin needs no tensor algebra.
typedef struct {
  double a, d, f, ad, af, dd, ff, df;
} Slopes;

// Of c1 (J^(-2/3) I1 - 3) + c2 (J^(-4/3) I2 - 3) + p (J - 1) at (a, D > 0, f > 0) and the
// pressure-like multiplier p (tension positive). c2 = 0 is the neo-Hookean energy, mu/2 = c1.
SB_QUAD_INLINE void differentiate(const SbRingMaterial *material, double a, double d, double f,
                                  double p, Slopes *w) {
  double cube = cbrt(d * f);
  double v = material->c1 / (cube * cube);
  double q = material->c2 / (cube * cube * cube * cube);
  double s1 = a + f * f, s2 = d * d + a * f * f;
  // c1 (D f)^(-2/3) (a + f^2)
  w->a = v;
  w->d = -2.0 / 3.0 * v / d * s1;
  w->f = v * (-2.0 / 3.0 * s1 / f + 2.0 * f);
  w->ad = -2.0 / 3.0 * v / d;
  w->af = -2.0 / 3.0 * v / f;
  w->dd = 10.0 / 9.0 * v / (d * d) * s1;
  w->ff = v * (10.0 / 9.0 * s1 / (f * f) - 8.0 / 3.0 + 2.0);
  w->df = v * (4.0 / 9.0 * s1 / (d * f) - 4.0 / 3.0 * f / d);
  // c2 (D f)^(-4/3) (D^2 + a f^2)
  if (q != 0.0) {
    w->a += q * f * f;
    w->d += q * (-4.0 / 3.0 * s2 / d + 2.0 * d);
    w->f += q * (-4.0 / 3.0 * s2 / f + 2.0 * a * f);
    w->ad += -4.0 / 3.0 * q * f * f / d;
    w->af += 2.0 / 3.0 * q * f;
    w->dd += q * (28.0 / 9.0 * s2 / (d * d) - 16.0 / 3.0 + 2.0);
    w->ff += q * (28.0 / 9.0 * s2 / (f * f) - 16.0 / 3.0 * a + 2.0 * a);
    w->df += q * (16.0 / 9.0 * s2 / (d * f) - 8.0 / 3.0 * a * f / d - 8.0 / 3.0 * d / f);
  }
  // p (D f - 1)
  w->d += p * f;
  w->f += p * d;
  w->df += p;
}

// ---- elements

// Gradients of the seven shapes, the hoop term N/R and the weight at one point of one element.
static bool point_geometry(const SbRingFem *fem, int element, double l1, double l2, double weight,
                           double g[POINT_SIZE]) {
  double n[NODES], d1[NODES], d2[NODES];
  sb_ring_shape(l1, l2, n, d1, d2);
  const int *tri = &fem->mesh->tri[6 * element];
  double jac[2][2] = {{0.0, 0.0}, {0.0, 0.0}}, r = 0.0;
  for (int a = 0; a < NODES; a++) {
    const double *x = &fem->mesh->x[2 * tri[a]];
    r += n[a] * x[0];
    for (int k = 0; k < 2; k++) {
      jac[0][k] += d1[a] * x[k];
      jac[1][k] += d2[a] * x[k];
    }
  }
  double det = jac[0][0] * jac[1][1] - jac[0][1] * jac[1][0];
  double l0 = 1.0 - l1 - l2;
  for (int a = 0; a < SHAPES; a++) {
    double e1 = a < NODES ? d1[a] : 27.0 * l2 * (l0 - l1);
    double e2 = a < NODES ? d2[a] : 27.0 * l1 * (l0 - l2);
    double value = a < NODES ? n[a] : 27.0 * l0 * l1 * l2;
    g[a] = (jac[1][1] * e1 - jac[0][1] * e2) / det;
    g[ROOM + a] = (jac[0][0] * e2 - jac[1][0] * e1) / det;
    g[2 * ROOM + a] = fem->around != 0.0 ? value / r : 0.0;
  }
  for (int k = 0; k < 3; k++) {
    g[ROOM * k + SHAPES] = 0.0;
  }
  g[3 * ROOM] = 0.5 * det * weight * (fem->around != 0.0 ? fem->around * r : 1.0);
  return det > 0.0 && (fem->around * r > 0.0 || fem->around == 0.0);
}

SbStatus sb_ring_fem_create(SbRingFem **out, const SbRingMesh *mesh, SbRingMaterial material,
                            double around, SbReport *report) {
  *out = NULL;
  SbRingFem *fem = calloc(1, sizeof *fem);
  if (fem == NULL) {
    return sb_fail(report, SB_ERROR_MEMORY, "no memory for the ring's elements");
  }
  fem->mesh = mesh;
  fem->around = around;
  fem->material = material;
  size_t n = (size_t)mesh->nodes, m = (size_t)mesh->elements;
  size_t state = 2 * n + SB_RING_INNER * m;
  fem->u = calloc(4 * state + 11 * n, sizeof(double)); // and what follows it
  fem->condition = calloc(n, sizeof(SbRingCondition));
  fem->work_int = calloc(n, sizeof(int));
  fem->gauss = malloc(sizeof(double) * POINT_SIZE * SB_RING_FEM_POINTS * m);
  fem->condensed = calloc(INNER * RIGHT * m, sizeof(double));
  if (fem->u == NULL || fem->condition == NULL || fem->work_int == NULL || fem->gauss == NULL ||
      fem->condensed == NULL) {
    sb_ring_fem_destroy(fem);
    return sb_fail(report, SB_ERROR_MEMORY, "no memory for the ring's elements");
  }
  fem->inner = fem->u + 2 * n;
  for (size_t place = 0; place < 3; place++) {
    fem->saved[place] = fem->u + (place + 1) * state;
  }
  fem->residual = fem->u + 4 * state;
  fem->rhs = fem->residual + 2 * n;
  fem->du = fem->residual + 4 * n;
  fem->mass = fem->residual + 6 * n;
  fem->du_path = fem->residual + 7 * n;
  fem->left = fem->residual + 9 * n;
  for (int e = 0; e < mesh->elements; e++) {
    for (int q = 0; q < SB_RING_FEM_POINTS; q++) {
      if (!point_geometry(fem, e, POINT[q][0], POINT[q][1], POINT[q][2],
                          &fem->gauss[POINT_SIZE * (SB_RING_FEM_POINTS * e + q)])) {
        sb_ring_fem_destroy(fem);
        return sb_fail(report, SB_ERROR_RANGE, "the ring's mesh crosses the axis or is inverted");
      }
      for (int a = 0; a < NODES; a++) {
        fem->mass[mesh->tri[6 * e + a]] +=
            fem->gauss[POINT_SIZE * (SB_RING_FEM_POINTS * e + q) + 3 * ROOM] / NODES;
      }
    }
  }
  SbStatus status = sb_ring_sparse_create(fem, report);
  if (status != SB_OK) {
    sb_ring_fem_destroy(fem);
    return status;
  }
  *out = fem;
  return sb_succeed(report);
}

void sb_ring_fem_destroy(SbRingFem *fem) {
  if (fem == NULL) {
    return;
  }
  sb_ring_factor_destroy(fem->factor);
  void *owned[] = {fem->u,         fem->condition, fem->work_int, fem->gauss,
                   fem->condensed, fem->row_start, fem->column,   fem->value,
                   fem->raw,       fem->scatter,   fem->diagonal, fem->hollow};
  for (size_t i = 0; i < sizeof owned / sizeof owned[0]; i++) {
    free(owned[i]);
  }
  free(fem);
}

// In-plane gradient, hoop stretch and pressure at a point from local displacements.
SB_QUAD_INLINE void point_strain(const double g[POINT_SIZE], const double local[2 * SHAPES],
                                 double f[5]) {
  f[0] = f[3] = f[4] = 1.0;
  f[1] = f[2] = 0.0;
  for (int a = 0; a < SHAPES; a++) {
    f[0] += g[a] * local[2 * a];
    f[1] += g[ROOM + a] * local[2 * a];
    f[2] += g[a] * local[2 * a + 1];
    f[3] += g[ROOM + a] * local[2 * a + 1];
    f[4] += g[2 * ROOM + a] * local[2 * a];
  }
}

SB_QUAD_INLINE void gather(const SbRingFem *fem, int element, double local[2 * SHAPES]) {
  const int *tri = &fem->mesh->tri[6 * element];
  for (int a = 0; a < NODES; a++) {
    local[2 * a] = fem->u[2 * tri[a]];
    local[2 * a + 1] = fem->u[2 * tri[a] + 1];
  }
  local[2 * NODES] = fem->inner[SB_RING_INNER * element];
  local[2 * NODES + 1] = fem->inner[SB_RING_INNER * element + 1];
}

// Turns A X = B, A the inner system, into X in the place of B, by Gauss and Jordan with row
// pivoting.
enum { QUADS = 4 }; // of a row of B: the nodes, the load, nothing
SB_QUAD_INLINE void solve_inner(double a[INNER][INNER], SbQuad b[INNER][QUADS]) {
  for (int k = 0; k < INNER; k++) {
    int pivot = k;
    for (int i = k + 1; i < INNER; i++) {
      pivot = fabs(a[i][k]) > fabs(a[pivot][k]) ? i : pivot;
    }
    const double inverse = a[pivot][k] != 0.0 ? 1.0 / a[pivot][k] : 0.0;
    for (int j = k; j < INNER; j++) {
      const double top = inverse * a[pivot][j];
      a[pivot][j] = a[k][j];
      a[k][j] = top;
    }
    for (int n = 0; n < QUADS; n++) {
      const SbQuad top = inverse * b[pivot][n];
      b[pivot][n] = b[k][n];
      b[k][n] = top;
    }
    for (int i = 0; i < INNER; i++) {
      if (i == k) {
        continue;
      }
      const double factor = a[i][k];
      for (int j = k; j < INNER; j++) {
        a[i][j] -= factor * a[k][j];
      }
      for (int n = 0; n < QUADS; n++) {
        b[i][n] -= factor * b[k][n];
      }
    }
  }
}

// First Piola stress rr, rz, zr, zz, hoop of a gradient and a pressure, with the derivatives and
// the cofactors of the gradient that it comes from.
SB_QUAD_INLINE void piola(const SbRingFem *fem, const double f[5], double p, Slopes *w,
                          double cof[4], double stress[5]) {
  double square = f[0] * f[0] + f[1] * f[1] + f[2] * f[2] + f[3] * f[3];
  differentiate(&fem->material, square, f[0] * f[3] - f[1] * f[2], f[4], p, w);
  cof[0] = f[3];
  cof[1] = -f[2];
  cof[2] = -f[1];
  cof[3] = f[0];
  for (int i = 0; i < 4; i++) {
    stress[i] = 2.0 * w->a * f[i] + w->d * cof[i];
  }
  stress[4] = w->f;
}

// Computes the tangent and residual of one element. Columns of `k` are those of the shapes, radial
// and axial side by side, of which only the upper half is used; the remainder is ordered by shapes,
// radial ones first.
typedef struct {
  union {
    SbQuad quad[2 * SHAPES][QUADS];
    double k[2 * SHAPES][4 * QUADS];
  };
  union {
    SbQuad force[2][2];
    double r[2][ROOM];
  };
  union {
    SbQuad swell[3][2][2]; // by each term of the pressure
    double by_pressure[3][2][ROOM];
  };
  double compressed[3][3], r_pressure[3]; // the pressure's own equations, upper half
} System;

// Tangent of the displacements from the stress' derivatives at a point, by the shapes of the quads
// from `from` on.
SB_QUAD_INLINE void add_stiffness(System *s, const double a[5][5], const SbQuad *g, int from) {
  SbQuad v[5][QUADS]; // of the stress by each shape's radial and axial displacement
  for (int m = from; m < QUADS; m++) {
    const SbQuad *dr = &g[m / 2], *dz = &g[2 + m / 2], *hoop = &g[4 + m / 2];
    const int low = 2 * (m % 2), high = low + 1;
    const SbQuad r = {(*dr)[low], (*dr)[low], (*dr)[high], (*dr)[high]};
    const SbQuad z = {(*dz)[low], (*dz)[low], (*dz)[high], (*dz)[high]};
    const SbQuad h = {(*hoop)[low], 0.0, (*hoop)[high], 0.0};
    for (int i = 0; i < 5; i++) {
      const SbQuad by_r = {a[i][0], a[i][2], a[i][0], a[i][2]};
      const SbQuad by_z = {a[i][1], a[i][3], a[i][1], a[i][3]};
      v[i][m] = by_r * r + by_z * z + a[i][4] * h;
    }
  }
  const double *at = (const double *)g;
  for (int c = 0; c < SHAPES; c++) {
    const double r = at[c], z = at[ROOM + c], hoop = at[2 * ROOM + c];
    for (int m = from > c / 2 ? from : c / 2; m < QUADS; m++) {
      s->quad[2 * c][m] += v[0][m] * r + v[1][m] * z + v[4][m] * hoop;
      s->quad[2 * c + 1][m] += v[2][m] * r + v[3][m] * z;
    }
  }
}

// Derivative of the stress with respect to the gradient and the hoop stretch, times a weight.
SB_QUAD_INLINE void stress_slopes(double a[5][5], const Slopes *w, const double f[5],
                                  const double cof[4], double weight) {
  for (int i = 0; i < 4; i++) {
    for (int j = 0; j < 4; j++) {
      a[i][j] = weight * (2.0 * w->ad * (f[i] * cof[j] + cof[i] * f[j]) + w->dd * cof[i] * cof[j]);
    }
    a[i][i] += weight * 2.0 * w->a;
    a[i][4] = a[4][i] = weight * (2.0 * w->af * f[i] + w->df * cof[i]);
  }
  a[4][4] = weight * w->ff;
  a[0][3] += weight * w->d;
  a[3][0] += weight * w->d;
  a[1][2] -= weight * w->d;
  a[2][1] -= weight * w->d;
}

// False if the element is turned inside out. `balance`: of its tangent only what the bubble enters.
SB_QUAD_INLINE bool element_system(SbRingFem *fem, int e, System *s, bool balance) {
  double local[2 * SHAPES];
  gather(fem, e, local);
  const double *pressure = &fem->inner[INNER * e + 2];
  memset(s, 0, sizeof *s);
  for (int q = 0; q < SB_RING_FEM_POINTS; q++) {
    const double *point = &fem->gauss[POINT_SIZE * (SB_RING_FEM_POINTS * e + q)];
    double weight = point[3 * ROOM];
    double phi[3] = {1.0, POINT[q][0] - 1.0 / 3.0, POINT[q][1] - 1.0 / 3.0};
    double p = pressure[0] + phi[1] * pressure[1] + phi[2] * pressure[2];
    double f[5];
    point_strain(point, local, f);
    double d = f[0] * f[3] - f[1] * f[2];
    fem->volume += weight * d * f[4];
    fem->det_min = d < fem->det_min ? d : fem->det_min;
    fem->det_min = f[4] < fem->det_min ? f[4] : fem->det_min;
    if (!(d > 0.0 && f[4] > 0.0)) {
      return false;
    }
    // Stress and its derivative.
    Slopes w;
    double cof[4], stress[5], a[5][5];
    piola(fem, f, p, &w, cof, stress);
    stress_slopes(a, &w, f, cof, weight);
    SbQuad g[6];
    for (int m = 0; m < 6; m++) {
      g[m] = *(const SbQuadAt *)&point[4 * m];
    }
    add_stiffness(s, (const double(*)[5])a, g, balance ? NODES / 2 : 0);
    for (int m = 0; m < 2; m++) {
      const SbQuad dr = g[m], dz = g[2 + m], hoop = g[4 + m];
      s->force[0][m] += weight * (stress[0] * dr + stress[1] * dz + stress[4] * hoop);
      s->force[1][m] += weight * (stress[2] * dr + stress[3] * dz);
      const SbQuad radial = weight * (f[4] * (cof[0] * dr + cof[1] * dz) + d * hoop);
      const SbQuad axial = weight * f[4] * (cof[2] * dr + cof[3] * dz);
      for (int i = 0; i < 3; i++) {
        s->swell[i][0][m] += phi[i] * radial;
        s->swell[i][1][m] += phi[i] * axial;
      }
    }
    double inverse_bulk = weight / fem->material.bulk;
    for (int i = 0; i < 3; i++) {
      s->r_pressure[i] += phi[i] * (weight * (d * f[4] - 1.0) - p * inverse_bulk);
      for (int j = i; j < 3; j++) {
        s->compressed[i][j] -= phi[i] * phi[j] * inverse_bulk;
      }
    }
  }
  return true;
}

// Eliminates bubble and pressure, and stores their response. `x` [INNER][RIGHT].
SB_QUAD_INLINE void condense(SbRingFem *fem, System *s, double *x, bool balance) {
  enum { BUBBLE = NODES };
  double inner[INNER][INNER];
  union {
    SbQuad quad[INNER][QUADS];
    double at[INNER][4 * QUADS];
  } right, solved;
  memset(&right, 0, sizeof right);
  for (int i = 0; i < 2; i++) {
    for (int j = 0; j < 2; j++) {
      inner[i][j] = s->k[OUTER + (i < j ? i : j)][OUTER + (i < j ? j : i)];
    }
    for (int j = 0; j < 3; j++) {
      inner[i][2 + j] = inner[2 + j][i] = s->by_pressure[j][i][BUBBLE];
    }
    for (int j = 0; j < OUTER; j++) {
      right.at[i][j] = s->k[j][OUTER + i];
    }
    right.at[i][OUTER] = s->r[i][BUBBLE];
  }
  for (int i = 0; i < 3; i++) {
    for (int j = 0; j < 3; j++) {
      inner[2 + i][2 + j] = s->compressed[i < j ? i : j][i < j ? j : i];
    }
    for (int a = 0; a < NODES; a++) {
      right.at[2 + i][2 * a] = s->by_pressure[i][0][a];
      right.at[2 + i][2 * a + 1] = s->by_pressure[i][1][a];
    }
    right.at[2 + i][OUTER] = s->r_pressure[i];
  }
  for (int i = 0; i < INNER; i++) {
    const double size = fabs(right.at[i][OUTER]);
    fem->residual_inner = size > fem->residual_inner ? size : fem->residual_inner;
  }
  solved = right;
  solve_inner(inner, solved.quad);
  for (int m = 0; m < INNER; m++) {
    memcpy(&x[RIGHT * m], solved.at[m], sizeof(double[RIGHT]));
  }
  for (int i = 0; i < OUTER; i++) {
    for (int m = 0; m < INNER; m++) {
      const double factor = right.at[m][i];
      s->r[i % 2][i / 2] -= factor * solved.at[m][OUTER];
      for (int n = i / 4; n < OUTER / 4 && !balance; n++) {
        s->quad[i][n] -= factor * solved.quad[m][n];
      }
    }
  }
}

// Adds an element to the balance, both halves of its symmetric tangent.
SB_QUAD_INLINE void scatter_element(SbRingFem *fem, int e, const System *s, bool balance) {
  const int *tri = &fem->mesh->tri[6 * e], *scatter = &fem->scatter[36 * e];
  for (int a = 0; a < NODES; a++) {
    fem->residual[2 * tri[a]] += s->r[0][a];
    fem->residual[2 * tri[a] + 1] += s->r[1][a];
    for (int b = a; b < NODES && !balance; b++) {
      const double *top = &s->k[2 * a][2 * b], *low = &s->k[2 * a + 1][2 * b];
      const SbQuad block = {top[0], top[1], b > a ? low[0] : top[1], low[1]};
      *(SbQuadAt *)&fem->value[SB_RING_BLOCK * scatter[6 * a + b]] += block;
      if (b > a) {
        const SbQuad mirror = {top[0], low[0], top[1], low[1]};
        *(SbQuadAt *)&fem->value[SB_RING_BLOCK * scatter[6 * b + a]] += mirror;
      }
    }
  }
}

SB_QUAD_INLINE bool add_all(SbRingFem *fem, bool balance) {
  for (int e = 0; e < fem->mesh->elements; e++) {
    System s;
    if (!element_system(fem, e, &s, balance)) {
      return false;
    }
    condense(fem, &s, &fem->condensed[INNER * RIGHT * e], balance);
    scatter_element(fem, e, &s, balance);
  }
  return true;
}

SB_QUAD_WIDE static bool add_elements_wide(SbRingFem *fem) {
  return fem->balance_only ? add_all(fem, true) : add_all(fem, false);
}

static bool add_elements(SbRingFem *fem) {
  return fem->balance_only ? add_all(fem, true) : add_all(fem, false);
}

bool sb_ring_fem_assemble(SbRingFem *fem) {
  const SbRingMesh *mesh = fem->mesh;
  memset(fem->value, 0, sizeof(double) * SB_RING_BLOCK * (size_t)fem->row_start[mesh->nodes]);
  memset(fem->residual, 0, sizeof(double) * 2 * (size_t)mesh->nodes);
  fem->residual_inner = fem->volume = 0.0;
  fem->det_min = INFINITY;
  if (!(sb_quad_wide() ? add_elements_wide(fem) : add_elements(fem))) {
    return false;
  }
  double stiffness = fem->axial_spring + fem->axial_damping;
  for (int i = 0; i < mesh->nodes && stiffness > 0.0; i++) {
    double drift = fem->u[2 * i + 1] - fem->saved[1][2 * i + 1] - fem->axial_rest;
    fem->residual[2 * i + 1] += fem->axial_spring * drift;
    fem->value[SB_RING_BLOCK * fem->diagonal[i] + 3] += stiffness;
  }
  for (int i = 0; i < 2 * mesh->nodes && fem->viscosity > 0.0; i++) {
    double resistance = fem->viscosity * fem->mass[i / 2];
    fem->residual[i] += resistance * (fem->u[i] - fem->saved[1][i]);
    fem->value[SB_RING_BLOCK * fem->diagonal[i / 2] + 3 * (i % 2)] += resistance;
  }
  return true;
}

void sb_ring_fem_advance(SbRingFem *fem, double step) {
  const SbRingMesh *mesh = fem->mesh;
  for (int e = 0; e < mesh->elements; e++) {
    const double *x = &fem->condensed[INNER * RIGHT * e];
    for (int m = 0; m < SB_RING_INNER; m++) {
      double change = x[RIGHT * m + OUTER];
      for (int j = 0; j < OUTER; j++) {
        change += x[RIGHT * m + j] * fem->du[2 * mesh->tri[6 * e + j / 2] + j % 2];
      }
      fem->inner[SB_RING_INNER * e + m] -= step * change;
    }
  }
  for (int i = 0; i < 2 * mesh->nodes; i++) {
    fem->u[i] += step * fem->du[i];
  }
}

// Bytes of displacement and inner unknowns, which follow each other.
static size_t state_size(const SbRingFem *fem) {
  return sizeof(double) *
         (2 * (size_t)fem->mesh->nodes + SB_RING_INNER * (size_t)fem->mesh->elements);
}

void sb_ring_fem_save(SbRingFem *fem, int place) {
  memcpy(fem->saved[place], fem->u, state_size(fem));
}

void sb_ring_fem_restore(SbRingFem *fem, int place) {
  memcpy(fem->u, fem->saved[place], state_size(fem));
}

void sb_ring_fem_stress(const SbRingFem *fem, int element, double l1, double l2, double cauchy[4],
                        double *jacobian) {
  double g[POINT_SIZE], local[2 * SHAPES], f[5];
  point_geometry(fem, element, l1, l2, 0.0, g);
  gather(fem, element, local);
  point_strain(g, local, f);
  f[4] = fmax(1e-12, f[4]);
  const double *inner = &fem->inner[INNER * element];
  double p = inner[2] + (l1 - 1.0 / 3.0) * inner[3] + (l2 - 1.0 / 3.0) * inner[4];
  Slopes w;
  double cof[4], stress[5];
  piola(fem, f, p, &w, cof, stress);
  // Cauchy = P F^T / J.
  *jacobian = (f[0] * f[3] - f[1] * f[2]) * f[4];
  cauchy[0] = (stress[0] * f[0] + stress[1] * f[1]) / *jacobian;
  cauchy[1] = (stress[2] * f[2] + stress[3] * f[3]) / *jacobian;
  cauchy[2] = (stress[0] * f[2] + stress[1] * f[3]) / *jacobian;
  cauchy[3] = stress[4] * f[4] / *jacobian;
}

void sb_ring_fem_interpolate(double *out, const SbRingMesh *mesh, const double *field,
                             const SbRingMesh *from) {
  double l1 = 0.0, l2 = 0.0;
  int e = 0;
  for (int i = 0; i < mesh->nodes; i++) {
    e = sb_ring_mesh_locate(from, &mesh->x[2 * i], e, &l1, &l2);
    double n[6], d1[6], d2[6];
    sb_ring_shape(l1, l2, n, d1, d2);
    out[2 * i] = out[2 * i + 1] = 0.0;
    for (int a = 0; a < 6; a++) {
      out[2 * i] += n[a] * field[2 * from->tri[6 * e + a]];
      out[2 * i + 1] += n[a] * field[2 * from->tri[6 * e + a] + 1];
    }
  }
}

void sb_ring_fem_transfer(SbRingFem *to, const SbRingFem *from) {
  const SbRingMesh *mesh = to->mesh;
  double l1 = 0.0, l2 = 0.0;
  int e, old = 0;
  sb_ring_fem_interpolate(to->u, mesh, from->u, from->mesh);
  for (e = 0; e < mesh->elements; e++) {
    const int *tri = &mesh->tri[6 * e];
    double *inner = &to->inner[SB_RING_INNER * e], p[3];
    for (int k = 0; k < 3; k++) {
      // Pressure a little inside each corner, so that the old element is the right one.
      double x[2] = {0.0, 0.0};
      for (int a = 0; a < 3; a++) {
        double share = a == k ? 2.0 / 3.0 : 1.0 / 6.0;
        x[0] += share * mesh->x[2 * tri[a]];
        x[1] += share * mesh->x[2 * tri[a] + 1];
      }
      old = sb_ring_mesh_locate(from->mesh, x, old, &l1, &l2);
      const double *q = &from->inner[SB_RING_INNER * old];
      p[k] = q[2] + (l1 - 1.0 / 3.0) * q[3] + (l2 - 1.0 / 3.0) * q[4];
    }
    inner[0] = inner[1] = 0.0;
    inner[2] = (p[0] + p[1] + p[2]) / 3.0;
    inner[3] = 2.0 * (p[1] - p[0]);
    inner[4] = 2.0 * (p[2] - p[0]);
  }
}

void sb_ring_fem_mirror(SbRingFem *to, const SbRingFem *from) {
  for (int i = 0; i < to->mesh->nodes; i++) {
    to->u[2 * i] = from->u[2 * i];
    to->u[2 * i + 1] = -from->u[2 * i + 1];
  }
  for (int e = 0; e < to->mesh->elements; e++) {
    const double *was = &from->inner[SB_RING_INNER * e];
    const double mirrored[SB_RING_INNER] = {was[0], -was[1], was[2], was[4], was[3]};
    memcpy(&to->inner[SB_RING_INNER * e], mirrored, sizeof mirrored);
  }
}
