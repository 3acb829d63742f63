// The ring's elements: consistent tangent, patch test, thick-walled cylinder and sphere against the
// incompressible closed forms, bending without locking.
#include "engine/contact/ring/ring_fem.h"
#include "engine/numeric/dense.h"

#include <glib.h>
#include <math.h>
#include <string.h>

enum { STEPS_MAX = 30 };

// A structured mesh of the rectangle r0..r1 x z0..z1 with nr x nz cells of two triangles each; its
// loop is left empty.
static SbStatus create_rectangle(SbRingMesh **out, double r0, double r1, double z0, double z1,
                                 int nr, int nz, SbReport *report) {
  *out = NULL;
  SbRingMesh *mesh = sb_ring_mesh_allocate((nr + 1) * (nz + 1), 2 * nr * nz, 0);
  if (mesh == NULL) {
    return sb_fail(report, SB_ERROR_MEMORY, "no memory for a mesh of %d x %d cells", nr, nz);
  }
  for (int j = 0; j <= nz; j++) {
    for (int i = 0; i <= nr; i++) {
      int v = j * (nr + 1) + i;
      mesh->x[2 * v] = r0 + (r1 - r0) * i / nr;
      mesh->x[2 * v + 1] = z0 + (z1 - z0) * j / nz;
    }
  }
  mesh->nodes = (nr + 1) * (nz + 1);
  for (int j = 0; j < nz; j++) {
    for (int i = 0; i < nr; i++) {
      int v = j * (nr + 1) + i;
      sb_ring_mesh_add(mesh, v, v + 1, v + nr + 2);
      sb_ring_mesh_add(mesh, v, v + nr + 2, v + nr + 1);
    }
  }
  SbStatus status = sb_ring_mesh_add_midsides(mesh, report);
  if (status != SB_OK) {
    sb_ring_mesh_destroy(mesh);
    return status;
  }
  *out = mesh;
  return sb_succeed(report);
}

static void make(SbRingMesh **mesh, double r0, double r1, double z0, double z1, int nr, int nz) {
  SbReport report;
  g_assert_cmpint(create_rectangle(mesh, r0, r1, z0, z1, nr, nz, &report), ==, SB_OK);
}

static SbRingFem *elements(const SbRingMesh *mesh, SbRingMaterial material, double around) {
  SbRingFem *fem = NULL;
  SbReport report;
  g_assert_cmpint(sb_ring_fem_create(&fem, mesh, material, around, &report), ==, SB_OK);
  return fem;
}

static void fix(SbRingFem *fem, int node, double ur, double uz) {
  SbRingCondition *c = &fem->condition[node];
  *c = (SbRingCondition){.count = 2,
                         .direction = {{1.0, 0.0}, {0.0, 1.0}},
                         .gap = {ur - fem->u[2 * node], uz - fem->u[2 * node + 1]}};
}

static void fix_one(SbRingFem *fem, int node, int axis, double value) {
  SbRingCondition *c = &fem->condition[node];
  *c = (SbRingCondition){.count = 1, .gap = {value - fem->u[2 * node + axis]}};
  c->direction[0][axis] = 1.0;
  c->direction[1][1 - axis] = 1.0;
}

// Newton with conditions that `hold` renews; `load` (may be NULL) is a nodal force.
static int newton(SbRingFem *fem, void (*hold)(SbRingFem *, void *), void *data,
                  const double *load) {
  SbReport report = {0};
  for (int it = 0; it < STEPS_MAX; it++) {
    g_assert_true(sb_ring_fem_assemble(fem));
    for (int i = 0; load != NULL && i < 2 * fem->mesh->nodes; i++) {
      fem->residual[i] -= load[i];
    }
    hold(fem, data);
    if (it > 0 && sb_ring_fem_free_residual(fem) < 1e-10 + 1e-14 * fem->material.bulk) {
      return it;
    }
    g_assert_cmpint(sb_ring_fem_solve(fem, &report), ==, SB_OK);
    sb_ring_fem_advance(fem, 1.0);
  }
  g_assert_not_reached();
}

static double pseudo(int i) {
  double x = sin(12.9898 * i + 4.1414) * 43758.5453;
  return x - floor(x) - 0.5;
}

// With the inner unknowns in equilibrium the condensed matrix is the derivative of the residual.
static void test_tangent(void) {
  SbRingMesh *mesh;
  make(&mesh, 1.0, 1.5, 0.0, 0.5, 1, 1);
  SbRingFem *fem = elements(mesh, (SbRingMaterial){0.4, 0.1, 50.0}, 2.0 * M_PI);
  int n = 2 * mesh->nodes;
  for (int i = 0; i < n; i++) {
    fem->u[i] = 0.05 * pseudo(i);
  }
  double plus[64], minus[64], worst = 0.0, scale = 0.0;
  for (int column = 0; column < n; column++) {
    for (int side = 0; side < 3; side++) {
      double step = side == 0 ? 1e-5 : side == 1 ? -2e-5 : 1e-5;
      fem->u[column] += step;
      memset(fem->du, 0, sizeof(double) * (size_t)n);
      for (int k = 0; k < 8; k++) {
        g_assert_true(sb_ring_fem_assemble(fem));
        sb_ring_fem_advance(fem, 1.0);
      }
      g_assert_true(sb_ring_fem_assemble(fem));
      if (side < 2) {
        memcpy(side == 0 ? plus : minus, fem->residual, sizeof(double) * (size_t)n);
      }
    }
    for (int row = 0; row < n; row++) {
      for (int at = fem->row_start[row / 2]; at < fem->row_start[row / 2 + 1]; at++) {
        if (fem->column[at] == column / 2) {
          double value = fem->value[SB_RING_BLOCK * at + 2 * (row % 2) + column % 2];
          double difference = (plus[row] - minus[row]) / 2e-5;
          worst = fmax(worst, fabs(difference - value));
          scale = fmax(scale, fabs(value));
        }
      }
    }
  }
  // Central differences of a smooth function: 1e-10 relative truncation, 1e-9 rounding.
  g_assert_cmpfloat(worst, <, 1e-6 * scale);
  sb_ring_fem_destroy(fem);
  sb_ring_mesh_destroy(mesh);
}

// Homogeneous gradient {F_rr, F_rz, F_zr, F_zz} prescribed on the boundary of a distorted mesh.
static void hold_patch(SbRingFem *fem, void *data) {
  const double *f = data;
  for (int i = 0; i < fem->mesh->nodes; i++) {
    const double *x = &fem->mesh->x[2 * i];
    bool outside = x[0] < 1.0 + 1e-9 || x[0] > 2.0 - 1e-9 || x[1] < 1e-9 || x[1] > 1.0 - 1e-9;
    memset(&fem->condition[i], 0, sizeof(SbRingCondition));
    if (outside) {
      fix(fem, i, (f[0] - 1.0) * x[0] + f[1] * x[1], f[2] * x[0] + (f[3] - 1.0) * x[1]);
    }
  }
}

static void patch(bool axisymmetric, double *f) {
  SbRingMesh *mesh;
  make(&mesh, 1.0, 2.0, 0.0, 1.0, 3, 3);
  // Move the inner vertices, then put the mid-sides of their triangles back in the middle.
  for (int i = 0; i < 16; i++) {
    double *x = &mesh->x[2 * i];
    if (x[0] > 1.1 && x[0] < 1.9 && x[1] > 0.1 && x[1] < 0.9) {
      x[0] += 0.12 * pseudo(i);
      x[1] += 0.12 * pseudo(i + 100);
    }
  }
  for (int e = 0; e < mesh->elements; e++) {
    const int *t = &mesh->tri[6 * e];
    for (int s = 0; s < 3; s++) {
      for (int k = 0; k < 2; k++) {
        mesh->x[2 * t[3 + s] + k] = 0.5 * (mesh->x[2 * t[s] + k] + mesh->x[2 * t[(s + 1) % 3] + k]);
      }
    }
  }
  SbRingFem *fem = elements(mesh, (SbRingMaterial){0.3, 0.2, 4.0}, axisymmetric ? 2.0 * M_PI : 0.0);
  newton(fem, hold_patch, f, NULL);
  double first[4] = {0.0};
  for (int e = 0; e < mesh->elements; e++) {
    double s[4], j;
    sb_ring_fem_stress(fem, e, 0.2, 0.3, s, &j);
    for (int k = 0; k < 4; k++) {
      first[k] = e == 0 ? s[k] : first[k];
      g_assert_cmpfloat(fabs(s[k] - first[k]), <, 1e-11);
    }
  }
  for (int i = 0; i < mesh->nodes; i++) {
    const double *x = &mesh->x[2 * i];
    g_assert_cmpfloat(fabs(fem->u[2 * i] - (f[0] - 1.0) * x[0] - f[1] * x[1]), <, 1e-12);
    g_assert_cmpfloat(fabs(fem->u[2 * i + 1] - f[2] * x[0] - (f[3] - 1.0) * x[1]), <, 1e-12);
  }
  sb_ring_fem_destroy(fem);
  sb_ring_mesh_destroy(mesh);
}

static void test_patch(void) {
  double plane[4] = {1.1, 0.15, -0.1, 0.93}, axial[4] = {1.1, 0.0, 0.0, 0.85};
  patch(false, plane);
  patch(true, axial);
}

// Incompressible neo-Hookean tube between fixed ends: r^2 = R^2 + c, and the pressure inside is
// mu times the integral of (l^2 - l^-2) dr/r, l = r/R; sphere: r^3 = R^3 + c, 2 (l^2 - l^-4).
static double closed_pressure(double a, double b, double inner, bool sphere) {
  double power = sphere ? 3.0 : 2.0, c = pow(inner, power) - pow(a, power);
  double outer = pow(pow(b, power) + c, 1.0 / power), sum = 0.0;
  int n = 2000;
  for (int i = 0; i <= n; i++) {
    double r = inner + (outer - inner) * i / n;
    double l = r / pow(pow(r, power) - c, 1.0 / power);
    double value = sphere ? 2.0 * (l * l - pow(l, -4.0)) / r : (l * l - 1.0 / (l * l)) / r;
    sum += value * (i == 0 || i == n ? 1.0 : i % 2 == 1 ? 4.0 : 2.0);
  }
  return sum * (outer - inner) / (3.0 * n);
}

static void hold_tube(SbRingFem *fem, void *data) {
  double inner = *(const double *)data;
  for (int i = 0; i < fem->mesh->nodes; i++) {
    const double *x = &fem->mesh->x[2 * i];
    memset(&fem->condition[i], 0, sizeof(SbRingCondition));
    bool end = x[1] < 1e-9 || x[1] > 0.5 - 1e-9;
    if (x[0] < 1.0 + 1e-9) {
      fix(fem, i, inner - 1.0, 0.0);
    } else if (end) {
      fix_one(fem, i, 1, 0.0);
    }
  }
}

// Pressure error of the tube with n cells through the wall, inner radius 1 -> 1.4.
static double tube_error(int n) {
  SbRingMesh *mesh;
  make(&mesh, 1.0, 2.0, 0.0, 0.5, n, n / 2 > 0 ? n / 2 : 1);
  SbRingFem *fem = elements(mesh, (SbRingMaterial){0.5, 0.0, 1e6}, 2.0 * M_PI);
  double inner = 1.0;
  for (int step = 0; step < 4; step++) {
    inner += 0.1;
    newton(fem, hold_tube, &inner, NULL);
  }
  double force = 0.0;
  for (int i = 0; i < mesh->nodes; i++) {
    force += mesh->x[2 * i] < 1.0 + 1e-9 ? fem->residual[2 * i] : 0.0;
  }
  double pressure = force / (2.0 * G_PI * inner * 0.5);
  sb_ring_fem_destroy(fem);
  sb_ring_mesh_destroy(mesh);
  return fabs(pressure / closed_pressure(1.0, 2.0, inner, false) - 1.0);
}

static void test_tube(void) {
  double coarse = tube_error(2), fine = tube_error(4);
  g_test_message("tube: error %.3g, %.3g, order %.2f", coarse, fine, log2(coarse / fine));
  // The force is a mean of the stress: about the fourth power of the size for quadratic elements.
  g_assert_cmpfloat(fine, <, 2e-4);
  g_assert_cmpfloat(log2(coarse / fine), >, 2.5);
}

static void hold_sphere(SbRingFem *fem, void *data) {
  double inner = *(const double *)data;
  for (int i = 0; i < fem->mesh->nodes; i++) {
    const double *x = &fem->mesh->x[2 * i];
    double radius = hypot(x[0], x[1]);
    memset(&fem->condition[i], 0, sizeof(SbRingCondition));
    if (radius < 1.0 + 1e-9) {
      fix(fem, i, (inner - 1.0) * x[0], (inner - 1.0) * x[1]);
    } else if (x[1] < 1e-9) {
      fix_one(fem, i, 1, 0.0);
    } else if (x[0] < 1e-9) {
      fix_one(fem, i, 0, 0.0);
    }
  }
}

static double sphere_error(int n) {
  SbRingMesh *mesh;
  // A rectangle of radius and latitude, bent into half a shell; r is the distance from the axis.
  make(&mesh, 1.0, 1.5, 0.0, 0.5 * G_PI, n, 3 * n);
  for (int i = 0; i < mesh->nodes; i++) {
    double radius = mesh->x[2 * i], angle = mesh->x[2 * i + 1];
    mesh->x[2 * i] = angle > 0.5 * G_PI - 1e-12 ? 0.0 : radius * cos(angle);
    mesh->x[2 * i + 1] = radius * sin(angle);
  }
  SbRingFem *fem = elements(mesh, (SbRingMaterial){0.5, 0.0, 1e5}, 2.0 * M_PI);
  double inner = 1.0;
  for (int step = 0; step < 4; step++) {
    inner += 0.1;
    newton(fem, hold_sphere, &inner, NULL);
  }
  double force = 0.0;
  for (int i = 0; i < mesh->nodes; i++) {
    // Upper half: the axial force on the inside is the pressure on the open circle.
    force += hypot(mesh->x[2 * i], mesh->x[2 * i + 1]) < 1.0 + 1e-9 && mesh->x[2 * i + 1] > 1e-9
                 ? fem->residual[2 * i + 1]
                 : 0.0;
  }
  double pressure = force / (G_PI * inner * inner);
  sb_ring_fem_destroy(fem);
  sb_ring_mesh_destroy(mesh);
  return fabs(pressure / closed_pressure(1.0, 1.5, inner, true) - 1.0);
}

static void test_sphere(void) {
  double coarse = sphere_error(2), fine = sphere_error(4);
  g_test_message("sphere: error %.3g, %.3g, order %.2f", coarse, fine, log2(coarse / fine));
  g_assert_cmpfloat(fine, <, 2e-3);
  g_assert_cmpfloat(log2(coarse / fine), >, 1.5);
}

static void hold_cook(SbRingFem *fem, void *data) {
  for (int i = 0; i < fem->mesh->nodes; i++) {
    memset(&fem->condition[i], 0, sizeof(SbRingCondition));
    if (fem->mesh->x[2 * i] < 1e-9) {
      fix(fem, i, 0.0, 0.0);
    }
  }
}

// Deflection of the upper right corner of Cook's panel (48 x 44 to 16), sheared by 0.2 mu on its
// end, plane strain, n x n cells.
static double cook(int n, double poisson) {
  SbRingMesh *mesh;
  make(&mesh, 0.0, 48.0, 0.0, 1.0, n, n);
  for (int i = 0; i < mesh->nodes; i++) {
    double s = mesh->x[2 * i] / 48.0, t = mesh->x[2 * i + 1];
    mesh->x[2 * i + 1] = (1.0 - t) * 44.0 * s + t * (44.0 + 16.0 * s);
  }
  double bulk = 2.0 * (1.0 + poisson) / (3.0 * (1.0 - 2.0 * poisson));
  SbRingFem *fem = elements(mesh, (SbRingMaterial){0.5, 0.0, bulk}, 0.0);
  double *load = g_new0(double, 2 * mesh->nodes);
  double side = 16.0 / n;
  for (int i = 0; i < mesh->nodes; i++) {
    if (mesh->x[2 * i] > 48.0 - 1e-9) {
      // Simpson shares of a uniform traction: vertices of two sides, mid-sides, corners.
      double place = (mesh->x[2 * i + 1] - 44.0) / side, part = place - floor(place + 1e-6);
      bool corner = place < 0.1 || place > n - 0.1;
      load[2 * i + 1] = 0.2 * side * (part > 0.25 ? 4.0 / 6.0 : corner ? 1.0 / 6.0 : 2.0 / 6.0);
    }
  }
  for (int step = 1; step <= 4; step++) {
    double *now = g_new0(double, 2 * mesh->nodes);
    for (int i = 0; i < 2 * mesh->nodes; i++) {
      now[i] = load[i] * step / 4.0;
    }
    newton(fem, hold_cook, NULL, now);
    g_free(now);
  }
  double tip = 0.0;
  for (int i = 0; i < mesh->nodes; i++) {
    bool corner = mesh->x[2 * i] > 48.0 - 1e-9 && mesh->x[2 * i + 1] > 60.0 - 1e-9;
    tip = corner ? fem->u[2 * i + 1] : tip;
  }
  g_free(load);
  sb_ring_fem_destroy(fem);
  sb_ring_mesh_destroy(mesh);
  return tip;
}

static void test_cook(void) {
  double fine = cook(16, 0.4999), middle = cook(8, 0.4999), coarse = cook(4, 0.4999);
  double soft = cook(16, 0.49), soft_coarse = cook(4, 0.49);
  g_test_message("Cook: %.5f %.5f %.5f; nu 0.49: %.5f %.5f", coarse, middle, fine, soft_coarse,
                 soft);
  // Locking would leave the coarse mesh far too stiff (tens of percent) and ever more so towards
  // incompressibility; here its error does not depend on Poisson's ratio.
  double error = fabs(coarse / fine - 1.0), soft_error = fabs(soft_coarse / soft - 1.0);
  g_assert_cmpfloat(error, <, 0.03);
  g_assert_cmpfloat(error, <, 1.5 * soft_error + 0.002);
  g_assert_cmpfloat(fabs(middle / fine - 1.0), <, error);
}

// Factors of an unsymmetric matrix with blocks at random against elimination with all its pivots.
static void test_factor(void) {
  enum { NODES = 40, N = 2 * NODES };
  int start[NODES + 1], column[NODES * NODES], count = 0;
  double value[SB_RING_BLOCK * NODES * NODES], *dense = g_new0(double, N *N), b[N], x[N], y[N];
  for (int i = 0; i < NODES; i++) {
    start[i] = count;
    for (int j = 0; j < NODES; j++) {
      if (i != j && pseudo(i < j ? i * NODES + j : j * NODES + i) < 0.4) {
        continue;
      }
      column[count] = j;
      for (int k = 0; k < SB_RING_BLOCK; k++) {
        // A node's own block with a first entry of nil: its rows are exchanged.
        const double entry = i != j ? pseudo(3 * count + k) : k == 0 ? 0.0 : k < 3 ? 30.0 : 1.0;
        value[SB_RING_BLOCK * count + k] = entry;
        dense[2 * i + k / 2 + N * (2 * j + k % 2)] = entry;
      }
      count++;
    }
  }
  start[NODES] = count;
  for (int i = 0; i < N; i++) {
    b[i] = y[i] = pseudo(7 * i);
  }
  SbRingFactor *factor = sb_ring_factor_create(NODES, start, column);
  g_assert_nonnull(factor);
  for (int twice = 0; twice < 2; twice++) {
    g_assert_true(sb_ring_factor_compute(factor, value));
  }
  sb_ring_factor_solve(factor, x, b);
  g_assert_true(sb_eliminate(dense, y, N));
  for (int i = 0; i < N; i++) {
    g_assert_cmpfloat(fabs(x[i] - y[i]), <, 1e-12);
  }
  // A node without any stiffness.
  for (int k = 0; k < count; k++) {
    memset(&value[SB_RING_BLOCK * k], 0, sizeof(double) * SB_RING_BLOCK);
  }
  g_assert_false(sb_ring_factor_compute(factor, value));
  sb_ring_factor_destroy(factor);
  g_free(dense);
}

int main(int argc, char **argv) {
  g_test_init(&argc, &argv, NULL);
  g_test_add_func("/ring-fem/tangent", test_tangent);
  g_test_add_func("/ring-fem/factor", test_factor);
  g_test_add_func("/ring-fem/patch", test_patch);
  g_test_add_func("/ring-fem/tube", test_tube);
  g_test_add_func("/ring-fem/sphere", test_sphere);
  g_test_add_func("/ring-fem/cook", test_cook);
  return g_test_run();
}
