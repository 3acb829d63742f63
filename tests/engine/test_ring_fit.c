// sb_ring_fit: its error estimate must be honest against a much finer mesh, over squeeze, pressure
// and Poisson's ratio: true error <= 3 x estimate everywhere, median estimate / true <= 10.
#include "engine/contact/ring/ring.h"
#include "tests/engine/seals.h"

#include <glib.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static int by_size(const void *a, const void *b) {
  double p = *(const double *)a, q = *(const double *)b;
  return (p > q) - (p < q);
}

static void test_honest(void) {
  static const double SQUEEZE[] = {0.1, 0.1553, 0.25, 0.4},
                      PRESSURE[] = {0.0, 0.29e6, 0.7e6, 1.5e6};
  static const double POISSON[] = {0.49, 0.4999};
  double ratio[3][16];
  int cases = 0;
  // Quick: the valve's own squeeze only.
  for (int i = g_test_slow() ? 0 : 1; i < (g_test_slow() ? 4 : 2); i++) {
    for (int j = 0; j < 4; j++) {
      SbRingBody body = {.section_diameter = 1.61e-3,
                         .inner_diameter = 2.84e-3,
                         .modulus = 2.5e6,
                         .poisson_ratio = POISSON[(i + j) % 2]};
      SbRingLoad load = SB_RING_LOAD_INIT;
      load.floor_radius = 1.64e-3;
      load.bore_radius = 1.64e-3 + 1.61e-3 * (1.0 - SQUEEZE[i]);
      load.wall_right = SQUEEZE[i] < 0.2 ? 1e-3 : 1.3e-3;
      load.wall_left = -load.wall_right;
      load.pressure_left = PRESSURE[j];
      SbRingResult r, fine;
      SbReport report = {0};
      SbWarnings warnings = {0};
      SbStatus status = sb_ring_fit(NULL, &r, &body, &load, NULL, &warnings, &report);
      if (status != SB_OK) {
        g_test_message("%s", report.text);
      }
      g_assert_cmpint(status, ==, SB_OK);
      SbRing *ring = NULL;
      SbRingOptions options = {.element_size = 0.015, .fit_mesh = true};
      g_assert_cmpint(sb_ring_create(&ring, &body, &load, &options, &report), ==, SB_OK);
      sb_ring_result(ring, &fine);
      sb_ring_destroy(ring);
      double truth[3] = {
          fabs(r.bore_force / fine.bore_force - 1.0),
          fabs(r.pressure_peak / fine.pressure_peak - 1.0),
          fabs((r.contact_right - r.contact_left) / (fine.contact_right - fine.contact_left) - 1.0),
      };
      double estimate[3] = {r.error.load, r.error.peak, r.error.width};
      g_test_message(
          "squeeze %.3f pressure %.2f MPa: %d unknowns, %d iterations; load %.1e (%.1e), "
          "peak %.1e (%.1e), width %.1e (%.1e)",
          SQUEEZE[i], 1e-6 * PRESSURE[j], r.unknowns, r.newton_iterations, truth[0], estimate[0],
          truth[1], estimate[1], truth[2], estimate[2]);
      for (int k = 0; k < 3; k++) {
        g_assert_cmpfloat(truth[k], <=, 3.0 * estimate[k]);
        ratio[k][cases] = estimate[k] / fmax(truth[k], 1e-12);
      }
      // The tolerance asked for is 1e-3 of the load; the estimate has a margin of its own.
      g_assert_cmpfloat(truth[0], <, 2.5e-3);
      cases++;
    }
  }
  for (int k = 0; k < 3; k++) {
    qsort(ratio[k], (size_t)cases, sizeof(double), by_size);
    g_test_message("median estimate / true: %.2f", ratio[k][cases / 2]);
    g_assert_cmpfloat(ratio[k][cases / 2], <=, 10.0);
  }
}

// Contacts of a twentieth and a fifth of the section, and one that the fluid widens: the profile is
// the smooth one that has the load, and the estimate holds against a finer mesh.
static void test_narrow(void) {
  static const struct {
    double squeeze, stretch, poisson, pressure;
  } CASE[] = {{0.02, 0.03, 0.4999, 0.0}, {0.1, 0.155, 0.49, 0.0}, {0.12, 0.18, 0.49, 0.13e6}};
  for (size_t i = 0; i < G_N_ELEMENTS(CASE); i++) {
    SbRingBody body = BODY;
    body.poisson_ratio = CASE[i].poisson;
    SbRingLoad load = SB_RING_LOAD_INIT;
    load.floor_radius = 1.42e-3 * (1.0 + CASE[i].stretch);
    load.bore_radius = load.floor_radius + 1.61e-3 * (1.0 - CASE[i].squeeze);
    load.wall_right = 1e-3;
    load.pressure_left = CASE[i].pressure;
    SbRing *ring = NULL;
    SbRingResult r, fine;
    SbReport report = {0};
    SbWarnings warnings = {0};
    g_assert_cmpint(sb_ring_fit(&ring, &r, &body, &load, NULL, &warnings, &report), ==, SB_OK);
    g_assert_cmpuint(warnings.count, ==, 0);
    double x[512], p[512], sum = 0.0;
    int n = sb_ring_profile(ring, x, p, 512);
    for (int k = 1; k < n; k++) {
      sum += 0.5 * (p[k] + p[k - 1]) * (x[k] - x[k - 1]);
    }
    sb_ring_destroy(ring);
    double whole = 2.0 * G_PI * load.bore_radius * sum;
    g_assert_cmpfloat(fabs(whole / r.bore_force - 1.0), <, 1e-3);
    SbRingOptions options = {.element_size = 0.012, .fit_mesh = true};
    g_assert_cmpint(sb_ring_create(&ring, &body, &load, &options, &report), ==, SB_OK);
    sb_ring_result(ring, &fine);
    sb_ring_destroy(ring);
    double off = fabs(r.bore_force / fine.bore_force - 1.0);
    g_test_message("%.4f N, profile %+.1e, error %.1e (%.1e)", r.bore_force,
                   whole / r.bore_force - 1.0, off, r.error.load);
    g_assert_cmpfloat(off, <=, 3.0 * r.error.load);
  }
}

static void test_no_contact(void) {
  SbRingBody body = BODY;
  SbRingLoad load = open_groove();
  load.bore_radius = 3.3e-3;
  SbRingResult r;
  SbReport report;
  SbWarnings warnings = {0};
  g_assert_cmpint(sb_ring_fit(NULL, &r, &body, &load, NULL, &warnings, &report), ==, SB_OK);
  g_assert_false(r.touching);
  g_assert_cmpfloat(r.bore_force, ==, 0.0);
  g_assert_cmpuint(warnings.count, ==, 1);
  g_assert_cmpstr(warnings.item[0].code, ==, "no-contact");
}

// A rectangle that stretching makes thinner than its gap. Its flat contact with the floor, which
// hardly rubs, does not settle on any other mesh than that of its path; a ring without load needs
// none (campaign random-valves, seed 1, number 88).
static void test_no_contact_dragged(void) {
  const SbRingBody body = {.profile = {.kind = SB_SEAL_PROFILE_RECTANGLE,
                                       .axial_height = 1.597824e-3,
                                       .corner_radius = 0.3212062e-3},
                           .section_diameter = 2.3775124e-3,
                           .inner_diameter = 3.0707549e-3,
                           .modulus = 6.2376222e6,
                           .poisson_ratio = 0.49780776,
                           .mooney_share = 0.1635967};
  SbRingLoad load = SB_RING_LOAD_INIT;
  load.bore_radius = 3.9945088e-3;
  load.floor_radius = 1.6488521e-3;
  load.wall_right = 1.8238159e-3;
  load.wall_left = -load.wall_right;
  load.friction_bore = 1.0;
  load.friction_floor = 5.0290816e-4;
  load.bore_slides = 1;
  SbRingResult r;
  SbReport report;
  SbWarnings warnings = {0};
  const SbRingOptions options = {.tolerance = 3.5e-3};
  const SbStatus status = sb_ring_fit(NULL, &r, &body, &load, &options, &warnings, &report);
  g_test_message("%s", report.text);
  g_assert_cmpint(status, ==, SB_OK);
  g_assert_false(r.touching);
  g_assert_cmpfloat(r.bore_force, ==, 0.0);
  g_assert_cmpuint(warnings.count, ==, 1);
  g_assert_cmpstr(warnings.item[0].code, ==, "no-contact");
}

// A stretched ring that flattens away from the bore, and that 0.55 MPa holds on it once something
// has closed the gap: the load of that state falls ever faster with the squeeze to the fold where
// it ends, each in a moderate number of iterations; beyond, it is refused with the radial space up
// to which the fluid is held.
static void test_open(void) {
  static const double SQUEEZE[] = {0.06, 0.05, 0.04, 0.035, 0.03, 0.028};
  enum { N = sizeof SQUEEZE / sizeof SQUEEZE[0] };
  const SbRingBody body = {.section_diameter = 1.61e-3,
                           .inner_diameter = 2.84e-3,
                           .modulus = 2.5e6,
                           .poisson_ratio = 0.49};
  const SbRingOptions options = {.element_size = 0.03, .fit_mesh = true};
  SbRingLoad load = SB_RING_LOAD_INIT;
  load.floor_radius = 1.64e-3;
  load.wall_right = 1e-3;
  load.pressure_left = 0.55e6;
  double before = HUGE_VAL, steepest = 0.0;
  SbRingResult r;
  SbReport report = {0};
  SbRing *ring = NULL;
  for (int i = 0; i < N; i++) {
    load.bore_radius = load.floor_radius + (1.0 - SQUEEZE[i]) * body.section_diameter;
    g_assert_cmpint(sb_ring_create(&ring, &body, &load, &options, &report), ==, SB_OK);
    sb_ring_result(ring, &r);
    sb_ring_destroy(ring);
    g_test_message("squeeze %.3f: %.4f N, %d iterations", SQUEEZE[i], r.bore_force,
                   r.newton_iterations);
    g_assert_cmpfloat(r.bore_force, <, before);
    g_assert_cmpfloat(r.bore_force, >, 0.0);
    g_assert_cmpint(r.newton_iterations, <, 200);
    if (i > 0) {
      double slope = (before - r.bore_force) / (SQUEEZE[i - 1] - SQUEEZE[i]);
      g_assert_cmpfloat(slope, >, 0.95 * steepest);
      steepest = fmax(steepest, slope);
    }
    before = r.bore_force;
  }
  load.bore_radius = load.floor_radius + 0.98 * body.section_diameter;
  g_assert_cmpint(sb_ring_create(&ring, &body, &load, &options, &report), ==, SB_ERROR_INFEASIBLE);
  g_test_message("%s", report.text);
  g_assert_null(ring);
  g_assert_cmpstr(sb_input_key(report.input), ==, "gland.radial_space");
  const char *held = strstr(report.text, "up to a radial space of ");
  g_assert_nonnull(held);
  double space = g_ascii_strtod(held + strlen("up to a radial space of "), NULL);
  g_assert_cmpfloat(space, >, 1.54);
  g_assert_cmpfloat(space, <, 1.578);
}

// A flat T that is stretched by 22 % and squeezed by a fifth. On meshes of 0.045 of its height
// every guess fails: the path from the free ring finds the state of another mesh, whose load
// differs by 2e-4 at most between sizes of 0.03 and 0.1. An iterate that failed was judged as a
// state and refused for its creases.
static void test_every_mesh(void) {
  static const double SIZE[] = {0.035, 0.045};
  const SbRingBody body = {.profile = {.kind = SB_SEAL_PROFILE_T,
                                       .axial_height = 2.1806201426652783e-3,
                                       .corner_radius = 0.14738191433908942e-3,
                                       .web_width = 1.2664248631860428e-3,
                                       .flange_height = 0.9642033730951285e-3},
                           .section_diameter = 3.1330087351673285e-3,
                           .inner_diameter = 5.4307448698354315e-3,
                           .modulus = 4785544.283602095,
                           .poisson_ratio = 0.492439067826361};
  SbRingLoad load = SB_RING_LOAD_INIT;
  load.bore_radius = 0.5 * 11.608784355040522e-3;
  load.floor_radius = load.bore_radius - 2.4914879284059764e-3;
  load.wall_right = 0.5 * 5.321320700840547e-3;
  double force[2];
  for (int i = 0; i < 2; i++) {
    const SbRingOptions options = {.element_size = SIZE[i]};
    SbRing *ring = NULL;
    SbRingResult r;
    SbReport report = {0};
    SbStatus status = sb_ring_create(&ring, &body, &load, &options, &report);
    g_test_message("size %.3f: %s", SIZE[i], report.text);
    g_assert_cmpint(status, ==, SB_OK);
    sb_ring_result(ring, &r);
    sb_ring_destroy(ring);
    g_test_message("%.4f N, %d iterations", r.bore_force, r.newton_iterations);
    force[i] = r.bore_force;
  }
  g_assert_cmpfloat(fabs(force[1] / force[0] - 1.0), <, 1e-3);
}

int main(int argc, char **argv) {
  g_test_init(&argc, &argv, NULL);
  g_test_add_func("/ring-fit/honest", test_honest);
  g_test_add_func("/ring-fit/narrow", test_narrow);
  g_test_add_func("/ring-fit/no-contact", test_no_contact);
  g_test_add_func("/ring-fit/no-contact-dragged", test_no_contact_dragged);
  g_test_add_func("/ring-fit/open", test_open);
  g_test_add_func("/ring-fit/every-mesh", test_every_mesh);
  return g_test_run();
}
