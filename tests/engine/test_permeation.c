// Permeation through a meshed section against closed forms. Elements are quadratic: on smooth
// solutions the flux converges with h^4 and more (an error of 1e-6 is met by some dozen elements);
// at the end of a wetted face, where the solution goes as a root, the quarter-point elements keep
// what is left below 1e-3 on a coarse mesh.
#include "engine/permeation/diffusion.h"
#include "tests/engine/near.h"

#include <gsl/gsl_sf_ellint.h>
#include <string.h>

// A structured mesh of nx x ny cells of two triangles; `x` and `y` give places at shares 0 .. 1.
typedef struct {
  int nx, ny;
  void (*place)(double x[2], double s, double t, const void *data);
  const void *data;
  bool axisymmetric;
} Grid;

static SbWettedMesh *create_grid(const Grid *grid) {
  const int wide = 2 * grid->nx + 1, high = 2 * grid->ny + 1;
  SbWettedMesh *s;
  g_assert_cmpint(
      sb_wetted_mesh_create(&s, wide * high, 2 * grid->nx * grid->ny, grid->axisymmetric, NULL), ==,
      SB_OK);
  for (int j = 0; j < high; j++) {
    for (int i = 0; i < wide; i++) {
      grid->place(&s->place[(size_t)2 * (j * wide + i)], (double)i / (wide - 1),
                  (double)j / (high - 1), grid->data);
    }
  }
  int *tri = s->triangle;
  for (int j = 0; j < 2 * grid->ny; j += 2) {
    for (int i = 0; i < 2 * grid->nx; i += 2, tri += 12) {
      const int v = j * wide + i, up = wide;
      const int both[12] = {
          v, v + 2,          v + 2 + 2 * up, v + 1,      v + 2 + up,     v + 1 + up,
          v, v + 2 + 2 * up, v + 2 * up,     v + 1 + up, v + 1 + 2 * up, v + up};
      memcpy(tri, both, sizeof both);
    }
  }
  for (int j = 0; j < high; j++) { // wetted at s = 0 and s = 1
    s->face[j * wide] = SB_FACE_INSIDE;
    s->face[j * wide + wide - 1] = SB_FACE_OUTSIDE;
  }
  return s;
}

// Sides of a rectangle; the points gather towards s = 0 by `grading`.
typedef struct {
  double x0, x1, y1, grading;
} Rectangle;

static void in_rectangle(double x[2], double s, double t, const void *data) {
  const Rectangle *r = data;
  x[0] = r->x0 + (r->x1 - r->x0) * pow(s, r->grading);
  x[1] = r->y1 * t;
}

// A quarter of an annulus in the plane, radii x0 and x1.
static void in_quarter(double x[2], double s, double t, const void *data) {
  const Rectangle *r = data;
  const double radius = r->x0 + (r->x1 - r->x0) * s, angle = 0.5 * M_PI * t;
  x[0] = radius * cos(angle);
  x[1] = radius * sin(angle);
}

static SbDiffusionSteady solve(SbDiffusion **out, const SbWettedMesh *section) {
  SbDiffusion *d;
  SbDiffusionSteady steady;
  SbReport report;
  const SbStatus status = sb_diffusion_create(&d, section, &report);
  g_assert_cmpstr(report.text, ==, "");
  g_assert_cmpint(status, ==, SB_OK);
  sb_diffusion_steady(&steady, d);
  assert_close(steady.flux_in, steady.flux_out, 1e-10);
  if (out != NULL) {
    *out = d;
  } else {
    sb_diffusion_destroy(d);
  }
  return steady;
}

static void test_slab(void) {
  const Rectangle r = {0.3e-3, 2.3e-3, 0.7e-3, 1.0};
  SbWettedMesh *s = create_grid(&(Grid){6, 3, in_rectangle, &r, false});
  const SbDiffusionSteady steady = solve(NULL, s);
  const double length = r.x1 - r.x0;
  assert_close(steady.conductance, r.y1 / length, 1e-12);
  assert_close(steady.lag, length * length / 6.0, 1e-12);
  assert_close(steady.volume, r.y1 * length, 1e-12);
  sb_wetted_mesh_destroy(s);
}

// Flux and time lag of a long annulus: 2 pi H/ln b, and Crank's (5.72) l = (a^2 - b^2 + (a^2 + b^2)
// ln(b/a))/(4 ln(b/a)). By order: 16 times less for half of the side.
static void test_annulus(void) {
  const Rectangle r = {1.5e-3, 3.0e-3, 1.0e-3, 1.0};
  const double a = r.x0, b = r.x1, ln = log(b / a);
  const double conductance = 2.0 * M_PI * r.y1 / ln;
  const double lag = (a * a - b * b + (a * a + b * b) * ln) / (4.0 * ln);
  double error[3];
  for (int k = 0; k < 3; k++) {
    SbWettedMesh *s = create_grid(&(Grid){4 << k, 2, in_rectangle, &r, true});
    const SbDiffusionSteady steady = solve(NULL, s);
    error[k] = fabs(steady.conductance / conductance - 1.0);
    if (k == 2) {
      assert_close(steady.conductance, conductance, 1e-6);
      assert_close(steady.lag, lag, 1e-6);
      assert_close(steady.volume, M_PI * (b * b - a * a) * r.y1, 1e-9);
    }
    sb_wetted_mesh_destroy(s);
  }
  const double order = log2(error[0] / error[1]);
  g_test_message("errors %.2e %.2e %.2e, order %.2f, %.2f", error[0], error[1], error[2], order,
                 log2(error[1] / error[2]));
  g_assert_cmpfloat(order, >, 3.7);
}

// The same across a curved mesh in the plane.
static void test_curved(void) {
  const Rectangle r = {1.0, 2.0, 0.0, 1.0};
  SbWettedMesh *s = create_grid(&(Grid){24, 24, in_quarter, &r, false});
  assert_close(solve(NULL, s).conductance, 0.5 * M_PI / log(2.0), 1e-6);
  SbWettedMesh *fine;
  g_assert_cmpint(sb_wetted_mesh_split(&fine, s, NULL), ==, SB_OK);
  g_assert_cmpint(fine->elements, ==, 4 * s->elements);
  g_assert_cmpint(fine->nodes, ==, 97 * 97);
  assert_close(solve(NULL, fine).conductance, 0.5 * M_PI / log(2.0), 1e-6);
  sb_wetted_mesh_destroy(s);
  sb_wetted_mesh_destroy(fine);
}

// A disc between two arcs of half-angle alpha opposite each other: 2 K(k)/K'(k), k = tan^2(alpha/2)
// (the upper half-plane onto a rectangle, tan(angle/2)/tan(alpha/2) = sn); at 45 degrees a square.
// Four ends of wetted faces, as a ring has.
static void in_disc(double x[2], double s, double t, const void *data) {
  // The square of +-1 onto the disc: rays from the centre (concentric map).
  (void)data;
  const double u = 2.0 * s - 1.0, v = 2.0 * t - 1.0, most = fmax(fabs(u), fabs(v));
  const double angle =
      most > 0.0 ? (fabs(u) >= fabs(v) ? 0.25 * M_PI * v / u : 0.5 * M_PI - 0.25 * M_PI * u / v)
                 : 0.0;
  const double turn = fabs(u) >= fabs(v) ? (u < 0.0 ? M_PI : 0.0) : (v < 0.0 ? M_PI : 0.0);
  x[0] = most * cos(angle + turn);
  x[1] = most * sin(angle + turn);
}

// The disc with its faces among the mesh's sides: arcs of `halves` sides to both sides of 0 and pi.
static SbWettedMesh *create_disc(int n, int halves) {
  SbWettedMesh *s = create_grid(&(Grid){n, n, in_disc, NULL, false});
  memset(s->face, 0, (size_t)s->nodes);
  const double alpha = 0.25 * M_PI * halves / (0.5 * n), slack = 1e-9;
  for (int i = 0; i < s->nodes; i++) {
    const double *x = &s->place[(size_t)2 * i];
    if (hypot(x[0], x[1]) > 1.0 - slack) {
      const double angle = atan2(x[1], fabs(x[0]));
      if (fabs(angle) < alpha + slack) {
        s->face[i] = x[0] < 0.0 ? SB_FACE_INSIDE : SB_FACE_OUTSIDE;
        s->end[i] = fabs(fabs(angle) - alpha) < slack;
      }
    }
  }
  return s;
}

static void test_disc(void) {
  const int n = 16, halves[3] = {8, 4, 2};
  for (int k = 0; k < 3; k++) {
    SbWettedMesh *s = create_disc(n, halves[k]);
    const double alpha = 0.25 * M_PI * halves[k] / (0.5 * n);
    const double m = pow(tan(0.5 * alpha), 2.0);
    const double exact = 2.0 * gsl_sf_ellint_Kcomp(m, GSL_PREC_DOUBLE) /
                         gsl_sf_ellint_Kcomp(sqrt(1.0 - m * m), GSL_PREC_DOUBLE);
    SbDiffusionConverged value;
    g_assert_cmpint(sb_diffusion_converge(&value, s, NULL), ==, SB_OK);
    g_assert_cmpfloat(value.flux_gap, <, 1e-10);
    const double plain = solve(NULL, s).conductance / exact - 1.0;
    sb_wetted_mesh_quarter(s);
    const double coarse = solve(NULL, s).conductance / exact - 1.0;
    const double off = value.steady.conductance / exact - 1.0;
    g_test_message("exact %.8f plain %.1e quarter points %.1e, converged %.1e, estimate %.1e",
                   exact, plain, coarse, off, value.error);
    // Without the quarter points it would be ten times as much.
    g_assert_cmpfloat(fabs(plain), >, 5e-3);
    g_assert_cmpfloat(fabs(coarse), <, 2e-3);
    g_assert_cmpfloat(fabs(off), <, 1e-3);
    g_assert_cmpfloat(fabs(off), <, 3.0 * value.error);
    sb_wetted_mesh_destroy(s);
  }
}

// The mean of the gradient over the slab is its steepness everywhere.
static void test_gradient(void) {
  const Rectangle r = {0.0, 2.0, 1.0, 1.0};
  SbWettedMesh *s = create_grid(&(Grid){4, 4, in_rectangle, &r, false});
  SbDiffusion *d;
  solve(&d, s);
  double *slope = g_new0(double, s->nodes);
  s->end[0] = 1; // takes its neighbours'
  g_assert_cmpint(sb_diffusion_gradient(slope, d, NULL), ==, SB_OK);
  for (int i = 0; i < s->nodes; i++) {
    assert_close(slope[i], 0.5, 1e-12);
  }
  g_free(slope);
  sb_diffusion_destroy(d);
  sb_wetted_mesh_destroy(s);
}

static void test_refused(void) {
  const Rectangle r = {0.0, 1.0, 1.0, 1.0};
  SbWettedMesh *s = create_grid(&(Grid){2, 2, in_rectangle, &r, false});
  SbDiffusion *d;
  SbReport report;
  memset(s->face, SB_FACE_INSIDE, 1);
  for (int i = 0; i < s->nodes; i++) {
    s->face[i] = s->face[i] == SB_FACE_OUTSIDE ? SB_FACE_DRY : s->face[i];
  }
  g_assert_cmpint(sb_diffusion_create(&d, s, &report), ==, SB_ERROR_INPUT);
  g_assert_nonnull(strstr(report.text, "outside"));
  s->face[s->nodes - 1] = SB_FACE_OUTSIDE;
  const int corner = s->triangle[1];
  s->triangle[1] = s->triangle[2];
  s->triangle[2] = corner;
  g_assert_cmpint(sb_diffusion_create(&d, s, &report), ==, SB_ERROR_INPUT);
  g_assert_nonnull(strstr(report.text, "inside out"));
  s->triangle[0] = s->nodes;
  g_assert_cmpint(sb_diffusion_create(&d, s, &report), ==, SB_ERROR_INPUT);
  g_assert_null(d);
  sb_wetted_mesh_destroy(s);
}

int main(int argc, char **argv) {
  g_test_init(&argc, &argv, NULL);
  g_test_add_func("/permeation/slab", test_slab);
  g_test_add_func("/permeation/annulus", test_annulus);
  g_test_add_func("/permeation/curved", test_curved);
  g_test_add_func("/permeation/disc", test_disc);
  g_test_add_func("/permeation/gradient", test_gradient);
  g_test_add_func("/permeation/refused", test_refused);
  return g_test_run();
}
