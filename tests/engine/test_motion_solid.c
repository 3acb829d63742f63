// Mass, centre and inertia of revolved profiles and meshes against closed forms; what is refused.
#include "engine/mechanism/solid.h"
#include "tests/engine/near.h"

#include <glib.h>
#include <gsl/gsl_eigen.h>
#include <gsl/gsl_sort_vector.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double rho = 1090.0;

static void compare(const SbSolid *s, double mass, double x, double axial, double across,
                    double tolerance) {
  ASSERT_NEAR(s->mass, mass, tolerance * mass);
  ASSERT_NEAR(s->volume, mass / rho, tolerance * mass / rho);
  ASSERT_NEAR(s->centre[0], x, tolerance * 0.1);
  ASSERT_NEAR(s->inertia[0][0], axial, tolerance * axial);
  ASSERT_NEAR(s->inertia[1][1], across, tolerance * across);
  ASSERT_NEAR(s->inertia[2][2], across, tolerance * across);
}

static SbSolid revolve(const SbProfilePoint *point, size_t count, bool closed) {
  SbProfile p = {point, count, closed};
  SbSolid s;
  SbReport report = {0};
  SbStatus status = sb_solid_revolve(&s, &p, rho, &report);
  g_assert_cmpstr(report.text, ==, "");
  g_assert_cmpint(status, ==, SB_OK);
  return s;
}

static void test_profiles(void) {
  double r = 2.9e-3, l = 14e-3, x = 0.04;
  // Cylinder: closed by the axis. Counter-clockwise: along the right face up, back along the top.
  SbProfilePoint cylinder[] = {{x + l, 0, 0}, {x + l, r, 0}, {x, r, 0}, {x, 0, 0}};
  SbSolid s = revolve(cylinder, 4, false);
  double m = rho * G_PI * r * r * l;
  compare(&s, m, x + 0.5 * l, 0.5 * m * r * r, m * (3.0 * r * r + l * l) / 12.0, 1e-12);
  // The same, closed with its axis as a piece.
  s = revolve(cylinder, 4, true);
  compare(&s, m, x + 0.5 * l, 0.5 * m * r * r, m * (3.0 * r * r + l * l) / 12.0, 1e-12);
  // Hollow stem.
  double in = 1.1e-3;
  SbProfilePoint tube[] = {{x, in, 0}, {x + l, in, 0}, {x + l, r, 0}, {x, r, 0}};
  s = revolve(tube, 4, true);
  m = rho * G_PI * (r * r - in * in) * l;
  compare(&s, m, x + 0.5 * l, 0.5 * m * (r * r + in * in),
          m * (3.0 * (r * r + in * in) + l * l) / 12.0, 1e-12);
  // Cone, tip at x.
  SbProfilePoint cone[] = {{x + l, 0, 0}, {x + l, r, 0}, {x, 0, 0}};
  s = revolve(cone, 3, false);
  m = rho * G_PI * r * r * l / 3.0;
  compare(&s, m, x + 0.75 * l, 0.3 * m * r * r, 0.15 * m * r * r + 0.0375 * m * l * l, 1e-12);
  // Torus: the fitted seal of table 4.1 (two half circles).
  double big = 2.32e-3, a = 0.805e-3;
  SbProfilePoint torus[] = {{-a, big, 1.0}, {a, big, 1.0}};
  s = revolve(torus, 2, true);
  m = rho * 2.0 * G_PI * G_PI * big * a * a;
  compare(&s, m, 0.0, m * (big * big + 0.75 * a * a), m * (0.5 * big * big + 0.625 * a * a), 1e-12);
  ASSERT_NEAR(s.inertia[0][0] / s.mass, 1.8955e-11 / 3.23e-6, 2e-4 * s.inertia[0][0] / s.mass);
  // Ball: half a circle from axis to axis.
  SbProfilePoint ball[] = {{r, 0, 1.0}, {-r, 0, 0}};
  s = revolve(ball, 2, false);
  m = rho * 4.0 / 3.0 * G_PI * r * r * r;
  compare(&s, m, 0.0, 0.4 * m * r * r, 0.4 * m * r * r, 1e-12);
  // Round ends on a pin: tangent arcs do not count as crossing.
  SbProfilePoint pin[] = {{l + r, 0, tan(G_PI / 8)}, {l, r, 0}, {0, r, tan(G_PI / 8)}, {-r, 0, 0}};
  s = revolve(pin, 4, false);
  ASSERT_NEAR(s.mass, rho * G_PI * r * r * (l + 4.0 / 3.0 * r), 1e-12 * s.mass);
}

static void test_diameters(void) {
  // A stem with a groove of 3.28 mm floor and a fillet, a land of 5.8 mm.
  double land = 2.9e-3, floor_r = 1.64e-3, fillet = 0.2e-3;
  SbProfilePoint stem[] = {{10e-3, 0, 0},
                           {10e-3, land, 0},
                           {6e-3, land, 0},
                           {6e-3, floor_r + fillet, -tan(G_PI / 8)},
                           {6e-3 - fillet, floor_r, 0},
                           {4e-3, floor_r, 0},
                           {4e-3, land, 0},
                           {0, land, 0},
                           {0, 0, 0}};
  SbProfile p = {stem, G_N_ELEMENTS(stem), false};
  SbReport report = {0};
  SbProfileDiameters d;
  g_assert_cmpint(sb_profile_diameters(&d, &p, 0.0, 10e-3, &report), ==, SB_OK);
  ASSERT_NEAR(d.smallest, 3.28e-3, 1e-12);
  ASSERT_NEAR(d.largest, 5.8e-3, 1e-12);
  g_assert_cmpint(sb_profile_diameters(&d, &p, 7e-3, 9e-3, &report), ==, SB_OK);
  ASSERT_NEAR(d.smallest, 5.8e-3, 1e-12);
  g_assert_cmpint(sb_profile_diameters(&d, &p, 4.5e-3, 5e-3, &report), ==, SB_OK);
  ASSERT_NEAR(d.largest, 3.28e-3, 1e-12);
  g_assert_cmpint(sb_profile_diameters(&d, &p, 0.02, 0.03, &report), ==, SB_ERROR_RANGE);
}

static void refuse(const SbProfilePoint *point, size_t count, bool closed, const char *why) {
  SbProfile p = {point, count, closed};
  SbSolid s;
  SbReport report = {0};
  g_assert_cmpint(sb_solid_revolve(&s, &p, rho, &report), !=, SB_OK);
  if (strstr(report.text, why) == NULL) {
    g_error("'%s' does not say '%s'", report.text, why);
  }
}

static void test_refused_profiles(void) {
  SbProfilePoint open[] = {{0, 1, 0}, {2, 1, 0}, {2, 2, 0}, {0, 2, 0}};
  refuse(open, 4, false, "open");
  SbProfilePoint hand[] = {{0, 1, 0}, {0, 2, 0}, {2, 2, 0}, {2, 1, 0}};
  refuse(hand, 4, true, "handedness");
  SbProfilePoint bow[] = {{0, 1, 0}, {2, 2, 0}, {2, 1, 0}, {0, 2, 0}};
  refuse(bow, 4, true, "crosses itself");
  // An arc that bulges through the opposite side.
  SbProfilePoint arc[] = {{0, 1, -1.0}, {2, 1, 0}, {2, 1.5, 0}, {0, 1.5, 0}};
  refuse(arc, 4, true, "crosses itself");
  SbProfilePoint below[] = {{0, -1, 0}, {2, 1, 0}, {2, 2, 0}};
  refuse(below, 3, true, "below the axis");
  SbProfilePoint dip[] = {{0, 0.5, 1.0}, {2, 0.5, 0}, {2, 2, 0}, {0, 2, 0}};
  refuse(dip, 4, true, "dips below the axis");
  SbProfilePoint twice[] = {{0, 1, 0}, {2, 1, 0}, {2, 1, 0}, {2, 2, 0}};
  refuse(twice, 4, true, "no length");
  // Back along itself.
  SbProfilePoint spike[] = {{0, 1, 0}, {3, 1, 0}, {2, 1, 0}, {2, 2, 0}, {0, 2, 0}};
  refuse(spike, 5, true, "crosses itself");
  SbProfilePoint nan[] = {{0, 1, 0}, {NAN, 1, 0}, {2, 2, 0}};
  refuse(nan, 3, true, "not a number");
  SbProfile good = {(SbProfilePoint[]){{1, 0, 0}, {1, 1, 0}, {0, 0, 0}}, 3, false};
  SbSolid s;
  g_assert_cmpint(sb_solid_revolve(&s, &good, -1.0, NULL), ==, SB_ERROR_RANGE);
}

// ---- meshes ----

typedef struct {
  double *vertex;
  unsigned *triangle;
  size_t vertices, triangles;
} Mesh;

static void mesh_free(Mesh *m) {
  g_free(m->vertex);
  g_free(m->triangle);
}

// A torus of n x n quadrilaterals about the x axis.
static Mesh torus_mesh(unsigned n, double big, double a) {
  Mesh m = {g_new(double, 3 * n * n), g_new(unsigned, 6 * n * n), n * n, 2 * n * n};
  unsigned *t = m.triangle;
  for (unsigned i = 0; i < n; i++) {
    for (unsigned k = 0; k < n; k++) {
      double u = 2.0 * G_PI * i / n, v = 2.0 * G_PI * k / n, r = big + a * cos(v);
      double *p = m.vertex + 3 * (i * n + k);
      p[0] = 0.05 + a * sin(v);
      p[1] = r * cos(u);
      p[2] = r * sin(u);
      unsigned i1 = (i + 1) % n, k1 = (k + 1) % n;
      unsigned q[4] = {i * n + k, i1 * n + k, i1 * n + k1, i * n + k1};
      unsigned two[6] = {q[0], q[1], q[2], q[0], q[2], q[3]};
      memcpy(t, two, sizeof two);
      t += 6;
    }
  }
  return m;
}

static void test_mesh(void) {
  double big = 2.32e-3, a = 0.805e-3, mass = rho * 2.0 * G_PI * G_PI * big * a * a;
  double previous = 0.0;
  for (unsigned n = 24; n <= 192; n *= 2) {
    Mesh m = torus_mesh(n, big, a);
    SbSolid s;
    SbReport report = {0};
    gint64 start = g_get_monotonic_time();
    SbStatus status =
        sb_solid_mesh(&s, m.vertex, m.vertices, m.triangle, m.triangles, rho, &report);
    double took = (double)(g_get_monotonic_time() - start) * 1e-3;
    g_assert_cmpstr(report.text, ==, "");
    g_assert_cmpint(status, ==, SB_OK);
    double axial = mass * (big * big + 0.75 * a * a),
           across = mass * (0.5 * big * big + 0.625 * a * a);
    double error = fmax(fabs(s.mass / mass - 1.0), fabs(s.inertia[0][0] / axial - 1.0));
    error = fmax(error, fabs(s.inertia[1][1] / across - 1.0));
    ASSERT_NEAR(s.centre[0], 0.05, 1e-12);
    if (previous > 0.0) {
      g_test_message("torus %u: error %.3g, order %.3f, %.1f ms", n, error, log2(previous / error),
                     took);
      ASSERT_NEAR(log2(previous / error), 2.0, 0.05);
    }
    previous = error;
    mesh_free(&m);
  }
}

static const double cube_vertex[24] = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0,
                                       0, 0, 1, 1, 0, 1, 1, 1, 1, 0, 1, 1};
static const unsigned cube[36] = {0, 2, 1, 0, 3, 2, 4, 5, 6, 4, 6, 7, 0, 1, 5, 0, 5, 4,
                                  1, 2, 6, 1, 6, 5, 2, 3, 7, 2, 7, 6, 3, 0, 4, 3, 4, 7};

static void test_box(void) {
  double vertex[24];
  double size[3] = {2e-3, 3e-3, 5e-3};
  // Turned about z by 0.3: the principal moments stay.
  for (int i = 0; i < 8; i++) {
    double x = size[0] * cube_vertex[3 * i] + 0.1, y = size[1] * cube_vertex[3 * i + 1];
    vertex[3 * i] = x * cos(0.3) - y * sin(0.3);
    vertex[3 * i + 1] = x * sin(0.3) + y * cos(0.3);
    vertex[3 * i + 2] = size[2] * cube_vertex[3 * i + 2];
  }
  SbSolid s;
  SbReport report = {0};
  g_assert_cmpint(sb_solid_mesh(&s, vertex, 8, cube, 12, rho, &report), ==, SB_OK);
  double m = rho * 30e-9;
  ASSERT_NEAR(s.mass, m, 1e-12 * m);
  double want[3] = {m * (4e-6 + 9e-6) / 12, m * (4e-6 + 25e-6) / 12, m * (9e-6 + 25e-6) / 12};
  double a[9], got[3], vectors[9];
  memcpy(a, s.inertia, sizeof a);
  gsl_matrix_view matrix = gsl_matrix_view_array(a, 3, 3);
  gsl_matrix_view turned = gsl_matrix_view_array(vectors, 3, 3);
  gsl_vector_view values = gsl_vector_view_array(got, 3);
  unsigned rotations;
  gsl_eigen_jacobi(&matrix.matrix, &values.vector, &turned.matrix, 60, &rotations);
  gsl_sort_vector(&values.vector);
  for (int k = 0; k < 3; k++) {
    ASSERT_NEAR(got[k], want[k], 1e-10 * want[k]);
  }
}

static void refuse_mesh(const double *v, size_t nv, const unsigned *t, size_t nt, const char *why) {
  SbSolid s;
  SbReport report = {0};
  g_assert_cmpint(sb_solid_mesh(&s, v, nv, t, nt, rho, &report), !=, SB_OK);
  if (strstr(report.text, why) == NULL) {
    g_error("'%s' does not say '%s'", report.text, why);
  }
}

// Of a body of revolution with the moments 1 and 3 the axis is found in any direction; of one that
// is not turned, and of a box, it is a coordinate axis.
static void test_axis(void) {
  double axis[3];
  for (int i = 0; i < 50; i++) {
    const double a = 0.2 + 0.02 * i, b = 0.4 * i;
    const double d[3] = {sin(a) * cos(b), sin(a) * sin(b), cos(a)};
    double inertia[3][3];
    for (int k = 0; k < 9; k++) {
      inertia[k / 3][k % 3] = (k % 4 == 0 ? 3 : 0) - 2 * d[k / 3] * d[k % 3];
    }
    inertia[0][0] += i % 2 * 0.01; // not quite round, as with ports
    g_assert_true(sb_solid_axis(axis, (const double(*)[3])inertia));
    ASSERT_NEAR(fabs(axis[0] * d[0] + axis[1] * d[1] + axis[2] * d[2]), 1,
                i % 2 == 0 ? 1e-14 : 1e-4);
    g_assert_cmpfloat(fmax(axis[0], fmax(axis[1], axis[2])), >, 0.57);
  }
  const double plain[2][3][3] = {{{3, 0, 0.01}, {0, 1, 0}, {0.01, 0, 3}},
                                 {{2, 0, 0}, {0, 3.9, 0}, {0, 0, 4}}};
  for (int i = 0; i < 2; i++) {
    g_assert_true(sb_solid_axis(axis, plain[i]));
    for (int k = 0; k < 3; k++) {
      g_assert_cmpfloat(axis[k], ==, k == 1 - i);
    }
  }
  // Nearly equal moments: about the line between x and y, and about none.
  const double close[2][3][3] = {{{3, 0.01, 0}, {0.01, 3, 0}, {0, 0, 2.99}},
                                 {{3, 0, 0}, {0, 3.02, 0}, {0, 0, 3.03}}};
  g_assert_true(sb_solid_axis(axis, close[0]));
  ASSERT_NEAR(axis[0], sqrt(0.5), 1e-12);
  ASSERT_NEAR(axis[1], sqrt(0.5), 1e-12);
  g_assert_false(sb_solid_axis(axis, close[1]));
}

// A cube around a cubic cavity. Wherever facets, or all of them, are reversed, they are turned
// back.
static void test_oriented(void) {
  double v[48];
  unsigned t[72];
  for (int i = 0; i < 24; i++) {
    v[i] = cube_vertex[i];
    v[24 + i] = 0.4 + 0.25 * cube_vertex[i];
  }
  for (unsigned mask = 0; mask < 256; mask++) { // bit k of it: facets k, k + 8 and k + 16
    size_t reversed = 0, turned, again;
    for (unsigned i = 0; i < 24; i++) {
      const bool cavity = i >= 12, all = mask >= 128, one = (mask >> i % 8 & 1) != 0 && i < 5;
      const unsigned *from = cube + 3 * (i % 12), first = cavity ? 8 : 0;
      const bool back = all != one;
      reversed += back;
      t[3 * i] = first + from[0];
      t[3 * i + 1] = first + from[back != cavity ? 2 : 1];
      t[3 * i + 2] = first + from[back != cavity ? 1 : 2];
    }
    SbSolid s;
    SbReport report = {0};
    g_assert_cmpint(sb_mesh_orient(&turned, NULL, t, 24, v, &report), ==, SB_OK);
    g_assert_cmpuint(turned, ==, reversed);
    g_assert_cmpint(sb_solid_mesh(&s, v, 16, t, 24, rho, &report), ==, SB_OK);
    ASSERT_NEAR(s.volume, 1 - 1.0 / 64, 1e-14);
    g_assert_cmpint(sb_mesh_orient(&again, NULL, t, 24, v, &report), ==, SB_OK);
    g_assert_cmpuint(again, ==, 0);
  }
  // As some exporters write it, the cavity outwards too; and two cubes that share a vertex.
  SbReport report = {0};
  size_t turned, body[24];
  for (int kind = 0; kind < 2; kind++) {
    for (unsigned i = 0; i < 72; i++) {
      t[i] = cube[i % 36] + (i < 36 ? 0 : 8);
      v[24 + i % 24] = kind == 0 ? 0.4 + 0.25 * cube_vertex[i % 24] : 1 + cube_vertex[i % 24];
    }
    for (unsigned i = 36; i < 72 && kind == 1; i++) {
      const double *at = v + 3 * t[i];
      for (unsigned k = 0; k < 8; k++) {
        t[i] = memcmp(at, v + 3 * k, 3 * sizeof *at) == 0 ? k : t[i];
      }
    }
    g_assert_cmpint(sb_mesh_orient(&turned, body, t, 24, v, &report), ==, SB_OK);
    g_assert_cmpuint(turned, ==, kind == 0 ? 12 : 0);
    g_assert_true((body[0] == body[12]) == (kind == 0));
  }
  g_assert_cmpint(sb_mesh_orient(&turned, NULL, t, 0, v, &report), ==, SB_ERROR_INPUT);
}

static void test_refused_meshes(void) {
  refuse_mesh(cube_vertex, 8, cube, 11, "open");
  unsigned t[72];
  memcpy(t, cube, sizeof cube);
  t[0] = 1;
  t[2] = 0;
  t[1] = 2; // one triangle turned over
  refuse_mesh(cube_vertex, 8, t, 12, "handedness");
  for (int i = 0; i < 12; i++) {
    t[3 * i] = cube[3 * i];
    t[3 * i + 1] = cube[3 * i + 2];
    t[3 * i + 2] = cube[3 * i + 1];
  }
  refuse_mesh(cube_vertex, 8, t, 12, "inside out");
  memcpy(t, cube, sizeof cube);
  t[5] = 99;
  refuse_mesh(cube_vertex, 8, t, 12, "not there");
  // Two cubes that overlap, as one mesh.
  double v[48];
  memcpy(v, cube_vertex, sizeof cube_vertex);
  memcpy(t, cube, sizeof cube);
  for (int i = 0; i < 24; i++) {
    v[24 + i] = cube_vertex[i] + (i % 3 == 0 ? 0.5 : i % 3 == 1 ? 0.41 : 0.37);
  }
  for (int i = 0; i < 36; i++) {
    t[36 + i] = cube[i] + 8;
  }
  refuse_mesh(v, 16, t, 24, "crosses itself");
  for (int i = 0; i < 24; i++) {
    v[24 + i] = cube_vertex[i] + 5.0;
  }
  SbSolid s;
  g_assert_cmpint(sb_solid_mesh(&s, v, 16, t, 24, rho, NULL), ==, SB_OK);
  ASSERT_NEAR(s.volume, 2.0, 1e-12);
}

int main(int argc, char **argv) {
  g_test_init(&argc, &argv, NULL);
  g_test_add_func("/motion/solid/profiles", test_profiles);
  g_test_add_func("/motion/solid/diameters", test_diameters);
  g_test_add_func("/motion/solid/refused-profiles", test_refused_profiles);
  g_test_add_func("/motion/solid/mesh", test_mesh);
  g_test_add_func("/motion/solid/box", test_box);
  g_test_add_func("/motion/solid/axis", test_axis);
  g_test_add_func("/motion/solid/oriented", test_oriented);
  g_test_add_func("/motion/solid/refused-meshes", test_refused_meshes);
  return g_test_run();
}
