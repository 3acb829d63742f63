// The ring through the common interface, beside the other models: reference figures, mirrored
// pressure, no contact, refusals, cancellation.
#include "engine/contact/fit.h"
#include "tests/engine/near.h"
#include "tests/engine/seals.h"

#include <glib.h>
#include <math.h>
#include <string.h>

// docs/verification.md: 4.772 N, 253.1 N/m at the bore, 0.552 mm, 0.585 MPa; 0.5 % in load, 1 % in
// peak.
static void test_reference(void) {
  const SbFitProblem in = thesis(SB_FIT_RING);
  SbFit fit;
  SbReport report = {0};
  g_assert_cmpint(sb_fit_solve(&fit, &in, &report), ==, SB_OK);
  assert_close(fit.load, 4.772, 5e-3);
  assert_close(fit.load_per_length, 253.1, 5e-3);
  assert_close(fit.circumference, M_PI * 6e-3, 1e-12);
  assert_close(fit.pressure_peak, 0.585e6, 1e-2);
  assert_close(fit.contact_width, 0.552e-3, 1e-2);
  g_assert_true(fit.valid && fit.touches && fit.solver.converged);
  g_assert_cmpuint(fit.profile_count, >, 20);
  double load = 0.0;
  for (size_t i = 1; i < fit.profile_count; i++) {
    g_assert_cmpfloat(fit.profile_x[i], >, fit.profile_x[i - 1]);
    load +=
        0.5 * (fit.profile_p[i] + fit.profile_p[i - 1]) * (fit.profile_x[i] - fit.profile_x[i - 1]);
  }
  assert_close(load, fit.load_per_length, 1e-2);
}

// Pressure on either side: mirror images; wider and moved towards the wall.
static void test_pressure(void) {
  SbFitProblem in = thesis(SB_FIT_RING);
  in.tolerance = 1e-2;
  SbFit dry;
  SbFit left;
  SbFit right;
  g_assert_cmpint(sb_fit_solve(&dry, &in, NULL), ==, SB_OK);
  in.pressure = 0.29e6;
  g_assert_cmpint(sb_fit_solve(&left, &in, NULL), ==, SB_OK);
  in.pressure = -0.29e6;
  g_assert_cmpint(sb_fit_solve(&right, &in, NULL), ==, SB_OK);
  g_assert_cmpfloat(left.contact_width, >, dry.contact_width);
  g_assert_cmpfloat(left.contact_left + left.contact_right, >, 0.0);
  assert_close(left.load, right.load, 5e-3);
  assert_close(left.contact_left, -right.contact_right, 5e-2);
  assert_close(left.profile_p[0], 0.29e6, 1e-3);
}

// What the ring tells beside its contact: the floor's load and, stretched only, that load and the
// thickness, against independent finite elements; the wall carries the pressure on the annulus.
static void test_readouts(void) {
  SbFitProblem in = thesis(SB_FIT_RING);
  SbFit fit;
  g_assert_cmpint(sb_fit_solve(&fit, &in, NULL), ==, SB_OK);
  assert_close(fit.ring.floor_load, 4.446, 1e-3);
  g_assert_cmpfloat(fit.ring.wall_load, ==, 0.0);
  g_assert_cmpuint(fit.ring.load_steps, >, 0);
  in.pressure = 0.55e6;
  in.tolerance = 1e-2;
  g_assert_cmpint(sb_fit_solve(&fit, &in, NULL), ==, SB_OK);
  double area = G_PI * (9e-6 - 1.64e-3 * 1.64e-3);
  assert_close(fit.ring.wall_load, in.pressure * area, 1e-8);
  g_assert_cmpfloat(fit.ring.axial_imbalance, <, 1e-8);
  g_assert_cmpfloat(fit.ring.volume_change, <, 0.0);
  in = thesis(SB_FIT_RING);
  in.bore_diameter += 0.6e-3;
  in.radial_space += 0.3e-3;
  g_assert_cmpint(sb_fit_solve(&fit, &in, NULL), ==, SB_OK);
  g_assert_false(fit.touches);
  assert_close(fit.ring.floor_load, 1.657, 2e-3);
  assert_close(fit.ring.thickness, 1.5e-3, 1e-3);
}

// Mooney and Rivlin's second invariant equals the first in plane strain without change of volume:
// there the share changes nothing (the rest is 1/D and 1 - 2 nu); in the stretched ring it does.
static void test_mooney(void) {
  double load[2][2];
  for (int wide = 0; wide < 2; wide++) {
    for (int share = 0; share < 2; share++) {
      SbFitProblem in = thesis(SB_FIT_RING);
      in.poisson_ratio = 0.4999;
      in.mooney_share = 0.4 * share;
      if (wide) {
        in.inner_diameter = 0.45;
        in.bore_diameter = in.inner_diameter + in.section_diameter + in.radial_space;
      }
      SbFit fit;
      g_assert_cmpint(sb_fit_solve(&fit, &in, NULL), ==, SB_OK);
      load[wide][share] = fit.load;
    }
  }
  g_test_message("Mooney: ring %.4f %.4f, straight %.3f %.3f N", load[0][0], load[0][1], load[1][0],
                 load[1][1]);
  assert_close(load[1][1], load[1][0], 1e-3);
  g_assert_cmpfloat(fabs(load[0][1] / load[0][0] - 1.0), >, 5e-3);
}

static void test_limits(void) {
  SbFitProblem in = thesis(SB_FIT_RING);
  in.section_diameter = 1.30e-3;
  SbFit fit;
  SbReport report = {0};
  g_assert_cmpint(sb_fit_solve(&fit, &in, &report), ==, SB_OK);
  g_assert_cmpfloat(fit.load, ==, 0.0);
  g_assert_true(fit.valid);
  g_assert_false(fit.touches);
  g_assert_cmpuint(fit.warnings.count, ==, 1);
  g_assert_cmpstr(fit.warnings.item[0].code, ==, "no-contact");

  // Nor does pressure press it on: the fluid goes past.
  in.pressure = 0.55e6;
  g_assert_cmpint(sb_fit_solve(&fit, &in, &report), ==, SB_OK);
  g_assert_cmpfloat(fit.load, ==, 0.0);
  g_assert_false(fit.touches);
  g_assert_cmpuint(fit.warnings.count, ==, 1);
  g_assert_cmpstr(fit.warnings.item[0].code, ==, "no-contact");
  g_assert_nonnull(strstr(fit.warnings.item[0].text, "lets the fluid past"));

  // One that touches by a hair seals, and the pressure adds to its load.
  in = thesis(SB_FIT_RING);
  in.bore_diameter += 2.0 * 0.13e-3; // squeeze after the stretch: none on the shrunk circle
  in.radial_space += 0.13e-3;
  in.tolerance = 1e-2;
  g_assert_cmpint(sb_fit_solve(&fit, &in, &report), ==, SB_OK);
  g_assert_true(fit.touches);
  const double alone = fit.load;
  in.pressure = 0.55e6;
  g_assert_cmpint(sb_fit_solve(&fit, &in, &report), ==, SB_OK);
  g_assert_true(fit.touches);
  g_assert_cmpfloat(fit.load, >, alone + 0.5 * in.pressure * fit.contact_width * fit.circumference);

  // A groove too narrow for the squeezed section, with and without fluid: both walls stand. The
  // second one carries load too, and what it pushes aside presses the bore: the load rises as the
  // groove narrows. In a groove that the ring cannot enter it is refused, with one reason.
  for (int wet = 0; wet < 2; wet++) {
    double before = 0.0;
    for (double width = 2.0e-3; width > 1.49e-3; width -= 0.25e-3) {
      in = thesis(SB_FIT_RING);
      in.gland_width = width;
      in.pressure = wet ? 0.2e6 : 0.0;
      in.tolerance = 1e-2;
      g_assert_cmpint(sb_fit_solve(&fit, &in, &report), ==, SB_OK);
      g_assert_true(fit.valid && fit.solver.converged);
      if (before > 0.0 && width < 1.6e-3) {
        g_assert_cmpfloat(fit.load, >, 1.3 * before);
        g_assert_cmpfloat(fit.ring.wall_load, >, 0.0);
      }
      g_assert_cmpfloat(fabs(fit.ring.axial_imbalance), <, 1e-6);
      before = fit.load;
    }
    in.gland_width = 1.38e-3; // gland fill 104 %
    g_assert_cmpint(sb_fit_solve(&fit, &in, &report), ==, SB_ERROR_INFEASIBLE);
    g_assert_cmpstr(sb_input_key(report.input), ==, "gland.axial_width");
    g_assert_nonnull(strstr(report.text, "overfilled"));
    g_assert_nonnull(strstr(report.text, "must be at least 1."));
    g_assert_false(fit.valid);
  }

  in = thesis(SB_FIT_RING);
  in.bore_diameter = 2.7e-3;
  g_assert_cmpint(sb_fit_solve(&fit, &in, &report), ==, SB_ERROR_INFEASIBLE);
}

static bool at_once(void *data) {
  return true;
}

static void test_cancel(void) {
  SbFitProblem in = thesis(SB_FIT_RING);
  in.cancel = at_once;
  SbFit fit;
  g_assert_cmpint(sb_fit_solve(&fit, &in, NULL), ==, SB_ERROR_CANCELLED);
  g_assert_cmpfloat(fit.load, ==, 0.0);
}

// All models on one ring, in the log: what the choice of model is worth.
static void test_side_by_side(void) {
  for (int pressure = 0; pressure < 2; pressure++) {
    double load[SB_FIT_MODEL_COUNT];
    for (int m = 0; m < SB_FIT_MODEL_COUNT; m++) {
      SbFitProblem in = thesis((SbFitModel)m);
      in.pressure = pressure ? 0.55e6 : 0.0;
      in.tolerance = 1e-2;
      SbFit fit;
      g_assert_cmpint(sb_fit_solve(&fit, &in, NULL), ==, SB_OK);
      load[m] = fit.load;
      g_test_message("%.2f MPa %-14s load %7.3f N, width %.3f mm, peak %.3f MPa%s",
                     pressure ? 0.55 : 0.0, sb_fit_kind((SbFitModel)m)->name, fit.load,
                     1e3 * fit.contact_width, 1e-6 * fit.pressure_peak,
                     fit.valid ? "" : " (outside its range)");
    }
    // The linear discs stay below the finite-strain ring, by 10 % dry and 9 and 21 % under pressure
    // (per length of their own circumferences the one with a wall is 2 % above).
    assert_close(load[SB_FIT_DISC], load[SB_FIT_RING], 0.25);
    assert_close(load[SB_FIT_DISC_THESIS], load[SB_FIT_RING], 0.15);
    g_assert_cmpfloat(load[SB_FIT_DISC], <, load[SB_FIT_RING]);
  }
}

// Where the disc hardly presses more than the fluid a stretched ring has left the bore: the disc
// says so, and of the thesis' ring, which touches, it says nothing.
static void test_disc_contact(void) {
  SbFit *disc = g_new0(SbFit, 1), *ring = g_new0(SbFit, 1);
  for (int stretched = 0; stretched < 2; stretched++) {
    SbFitProblem in = thesis(SB_FIT_DISC);
    if (stretched) { // by an eighth
      in.section_diameter = in.radial_space / (1 - 0.091);
      in.inner_diameter = (in.bore_diameter - in.radial_space) / 1.125 - in.section_diameter;
      in.pressure = 0.043 * in.modulus;
      in.poisson_ratio = 0.4563;
    }
    g_assert_cmpint(sb_fit_solve(disc, &in, NULL), ==, SB_OK);
    in.model = SB_FIT_RING;
    g_assert_cmpint(sb_fit_solve(ring, &in, NULL), ==, SB_OK);
    g_assert_true(disc->touches);
    g_assert_true(ring->touches == !stretched);
    bool told = false;
    for (size_t i = 0; i < disc->warnings.count; i++) {
      told = told || g_str_equal(disc->warnings.item[i].code, "disc-ring-contact");
    }
    g_assert_true(told == stretched);
    g_assert_true(!stretched || !disc->valid);
  }
  g_free(ring);
  g_free(disc);
}

int main(int argc, char **argv) {
  g_test_init(&argc, &argv, NULL);
  g_test_add_func("/fit/ring/reference", test_reference);
  g_test_add_func("/fit/ring/pressure", test_pressure);
  g_test_add_func("/fit/ring/readouts", test_readouts);
  g_test_add_func("/fit/ring/mooney", test_mooney);
  g_test_add_func("/fit/ring/limits", test_limits);
  g_test_add_func("/fit/ring/cancel", test_cancel);
  g_test_add_func("/fit/side-by-side", test_side_by_side);
  g_test_add_func("/fit/disc-contact", test_disc_contact);
  return g_test_run();
}
