// Fields inside the linear disc: equilibrium, Hooke's law, boundary conditions and the unilateral
// gap by the displaced surface; the compliance against the solved contact.
#include "engine/elastic/disc_field.h"

#include <glib.h>
#include <math.h>

#define D  1.61e-3
#define E  2.5e6
#define NU 0.49

#define assert_close(value, expected, relative)                                                    \
  g_assert_cmpfloat(fabs((value) - (expected)), <=, (relative)*fabs(expected))

static SbDisc solve(SbDiscVariant variant, double left, double right) {
  const SbDiscProblem in = {.variant = variant,
                            .diameter = D,
                            .space = 0.86 * D,
                            .modulus = E,
                            .poisson_ratio = NU,
                            .pressure_left = left,
                            .pressure_right = right,
                            .tolerance = 1e-5};
  SbDisc disc;
  g_assert_cmpint(sb_disc_solve(&disc, &in, NULL, NULL), ==, SB_OK);
  return disc;
}

static const double cases[][3] = {
    {SB_DISC_VERTICAL, 0.0, 0.0},   {SB_DISC_VERTICAL, 0.4e6, 0.0},
    {SB_DISC_VERTICAL, 0.0, 0.4e6}, {SB_DISC_VERTICAL, 0.5e6, 0.3e6},
    {SB_DISC_RADIAL, 0.0, 0.0},     {SB_DISC_RADIAL, 0.4e6, 0.0},
};

// Central differences of the stresses vanish in sum, and those of the displacements give the
// stresses.
static void test_field_equations(void) {
  for (size_t c = 0; c < G_N_ELEMENTS(cases); c++) {
    const SbDisc disc = solve((SbDiscVariant)cases[c][0], cases[c][1], cases[c][2]);
    SbDiscField field;
    sb_disc_field_init(&field, &disc);
    const double h = 1e-4 * D;
    const double points[][2] = {{0.0, 0.0}, {0.2, 0.1}, {-0.3, 0.15}, {0.1, -0.3}, {-0.05, 0.35}};
    for (size_t i = 0; i < G_N_ELEMENTS(points); i++) {
      const double x = points[i][0] * D;
      const double y = points[i][1] * D;
      SbDiscState here, px, mx, py, my;
      sb_disc_field_at(&field, x, y, &here);
      sb_disc_field_at(&field, x + h, y, &px);
      sb_disc_field_at(&field, x - h, y, &mx);
      sb_disc_field_at(&field, x, y + h, &py);
      sb_disc_field_at(&field, x, y - h, &my);
      const double scale = E / D;
      g_assert_cmpfloat(fabs(px.sxx - mx.sxx + py.sxy - my.sxy) / (2 * h), <, 1e-5 * scale);
      g_assert_cmpfloat(fabs(px.sxy - mx.sxy + py.syy - my.syy) / (2 * h), <, 1e-5 * scale);
      // Plane strain.
      const double exx = (px.ux - mx.ux) / (2 * h);
      const double eyy = (py.uy - my.uy) / (2 * h);
      const double gxy = (py.ux - my.ux + px.uy - mx.uy) / (2 * h);
      const double lame = E * NU / ((1 + NU) * (1 - 2 * NU));
      const double mu = 0.5 * E / (1 + NU);
      g_assert_cmpfloat(fabs(lame * (exx + eyy) + 2 * mu * exx - here.sxx), <, 2e-5 * E);
      g_assert_cmpfloat(fabs(lame * (exx + eyy) + 2 * mu * eyy - here.syy), <, 2e-5 * E);
      g_assert_cmpfloat(fabs(mu * gxy - here.sxy), <, 2e-5 * E);
    }
  }
}

// The displaced surface lies on the flat inside the contact and below it outside; the wall
// likewise. Radial kinematics puts the radial displacement equal to the gap instead, so only the
// vertical is asked.
static void test_surface(void) {
  for (size_t c = 0; c < 4; c++) {
    const SbDisc disc = solve(SB_DISC_VERTICAL, cases[c][1], cases[c][2]);
    SbDiscField field;
    sb_disc_field_init(&field, &disc);
    const double squeeze = 0.14 * D;
    double farthest = 0.0;
    double wall = 0.0;
    for (double angle = -89.0; angle <= 89.0; angle += 0.5) {
      const double x = 0.5 * D * sin(angle * M_PI / 180.0);
      const double y = 0.5 * D * cos(angle * M_PI / 180.0);
      SbDiscState top, bottom;
      sb_disc_field_at(&field, x, y, &top);
      sb_disc_field_at(&field, x, -y, &bottom);
      g_assert_cmpfloat(fabs(top.uy + bottom.uy), <, 1e-12 * D);
      const double gap = 0.43 * D - (y + top.uy);
      const double at = x + disc.shift;
      if (at > disc.contact_left && at < disc.contact_right) {
        g_assert_cmpfloat(fabs(gap), <, 1e-3 * squeeze);
      } else {
        g_assert_cmpfloat(gap, >, -1e-3 * squeeze);
        farthest = fmax(farthest, gap);
      }
      // Distance beyond the wall, which stands on the side of the lower pressure.
      wall = fmax(wall, cases[c][2] > cases[c][1] ? -(x + top.ux) : x + top.ux);
    }
    g_assert_cmpfloat(farthest, >, 0.1 * D);
    // The wall touches the squeezed section before pressure: its place is that of the dry flank.
    const SbDisc dry = solve(SB_DISC_VERTICAL, 0.0, 0.0);
    SbDiscField dry_field;
    sb_disc_field_init(&dry_field, &dry);
    SbDiscState flank;
    sb_disc_field_at(&dry_field, 0.5 * D, 0.0, &flank);
    if (cases[c][1] != cases[c][2]) {
      SbDiscState end;
      const double side = cases[c][2] > cases[c][1] ? -1.0 : 1.0;
      sb_disc_field_at(&field, side * 0.5 * D, 0.0, &end);
      if (c < 3) {
        assert_close(side * (side * 0.5 * D + end.ux), 0.5 * D + flank.ux, 2e-4);
      }
      g_assert_cmpfloat(wall, <, side * (side * 0.5 * D + end.ux) + 1e-3 * squeeze);
    }
  }
}

// Tractions: fluid on the wet flank, nothing on a dry one, the contact's pressure, and the load
// through the horizontal diameter.
static void test_tractions(void) {
  const SbDisc disc = solve(SB_DISC_VERTICAL, 0.4e6, 0.0);
  SbDiscField field;
  sb_disc_field_init(&field, &disc);
  SbDiscState state;
  sb_disc_field_at(&field, -0.5 * D, 0.0, &state);
  assert_close(state.sxx, -0.4e6, 0.02);
  sb_disc_field_at(&field, 0.5 * D * sin(0.95), 0.5 * D * cos(0.95), &state);
  const double normal = state.sxx * pow(sin(0.95), 2) + state.syy * pow(cos(0.95), 2) +
                        2 * state.sxy * sin(0.95) * cos(0.95);
  g_assert_cmpfloat(fabs(normal), <, 0.02 * disc.pressure_peak);
  const double xc = 0.5 * D * 0.5 * (disc.edge_left + disc.edge_right);
  sb_disc_field_at(&field, xc, sqrt(0.25 * D * D - xc * xc), &state);
  assert_close(state.syy, -sb_disc_pressure(&disc, xc + disc.shift), 0.03);

  // Vertical force through y = 0: contact and the fluid's vertical share on the upper left arc.
  enum { POINTS = 400 };
  double force = 0.0;
  for (int i = 0; i < POINTS; i++) {
    const double x = 0.5 * D * cos(M_PI * (i + 0.5) / POINTS);
    sb_disc_field_at(&field, x, 0.0, &state);
    force -= state.syy * 0.5 * D * sin(M_PI * (i + 0.5) / POINTS) * M_PI / POINTS;
  }
  const double fluid = 0.4e6 * 0.5 * D * (1.0 + disc.edge_left);
  assert_close(force, disc.load_per_length + fluid, 1e-3);

  // Without contact: the uniform pressure.
  const SbDiscProblem loose = {.diameter = D,
                               .space = 1.1 * D,
                               .modulus = E,
                               .poisson_ratio = NU,
                               .pressure_left = 0.2e6,
                               .pressure_right = 0.2e6};
  SbDisc free_disc;
  g_assert_cmpint(sb_disc_solve(&free_disc, &loose, NULL, NULL), ==, SB_OK);
  sb_disc_field_init(&field, &free_disc);
  sb_disc_field_at(&field, 0.1 * D, 0.2 * D, &state);
  assert_close(state.sxx, -0.2e6, 1e-12);
  assert_close(state.syy, -0.2e6, 1e-12);
  g_assert_cmpfloat(fabs(state.sxy), <, 1e-6);
}

// Half-plane plus smooth difference, integrated over the solved pressure, lifts the surface onto
// the flat.
static void test_compliance(void) {
  const SbDisc disc = solve(SB_DISC_VERTICAL, 0.0, 0.0);
  enum { POINTS = 400 };
  const double half = 0.5 * disc.contact_width;
  const double c = 2.0 * (1.0 - NU * NU) / (M_PI * E);
  const double radius = 0.5 * D;
  for (double at = -0.83; at < 0.9; at += 0.31) {
    const double x = at * half;
    // p = sqrt(1 - t^2) f, Gauss-Chebyshev for the smooth part; for the logarithm the same rule
    // with the density at x taken out, whose integral is known: int -ln|t - t'|/sqrt(1 - t'^2) dt'
    // = pi ln 2.
    double u = 0.0;
    const double here = sb_disc_pressure(&disc, x) * sqrt(1.0 - at * at);
    for (int i = 0; i < POINTS; i++) {
      const double t = cos(M_PI * (i + 0.5) / POINTS);
      const double density = sb_disc_pressure(&disc, t * half) * sqrt(1.0 - t * t);
      const double weight = M_PI / POINTS * half;
      u += weight * density * (sb_disc_smooth_compliance(radius, x, t * half) - log(half / radius));
      u += weight * (density - here) * -log(fabs(at - t));
    }
    u += half * here * M_PI * log(2.0);
    assert_close(c * u, sqrt(radius * radius - x * x) - 0.43 * D, 1e-4);
  }

  const double x[3] = {-0.2e-3, 0.0, 0.3e-3};
  double matrix[9];
  g_assert_cmpint(sb_disc_smooth_matrix(matrix, x, 3, radius, E, NU, NULL), ==, SB_OK);
  assert_close(matrix[2], c * sb_disc_smooth_compliance(radius, x[0], x[2]), 1e-15);
  assert_close(matrix[2], matrix[6], 1e-12);
  const double outside = 0.9e-3;
  SbReport report = {0};
  g_assert_cmpint(sb_disc_smooth_matrix(matrix, &outside, 1, radius, E, NU, &report), ==,
                  SB_ERROR_RANGE);
}

int main(int argc, char **argv) {
  g_test_init(&argc, &argv, NULL);
  g_test_add_func("/disc/field/equations", test_field_equations);
  g_test_add_func("/disc/field/surface", test_surface);
  g_test_add_func("/disc/field/tractions", test_tractions);
  g_test_add_func("/disc/field/compliance", test_compliance);
  return g_test_run();
}
