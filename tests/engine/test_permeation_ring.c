// Permeation of solved rings on their own meshes: the conductance converges with the ring's mesh,
// its estimate is honest, and squeeze, stretch and pressure act on it as they must.
#include "engine/permeation/diffusion.h"
#include "engine/permeation/wetted_ring.h"
#include "tests/engine/near.h"
#include "tests/engine/seals.h"

static SbDiffusionConverged of_ring(const SbRing *ring) {
  SbWettedMesh *section;
  SbDiffusionConverged out;
  SbReport report;
  SbStatus status = sb_wetted_ring_create(&section, ring, false, &report);
  g_assert_cmpint(status, ==, SB_OK);
  status = sb_diffusion_converge(&out, section, &report);
  g_assert_cmpstr(report.text, ==, "");
  g_assert_cmpint(status, ==, SB_OK);
  sb_wetted_mesh_destroy(section);
  return out;
}

static SbDiffusionConverged solve(const SbRingBody *body, const SbRingLoad *load, double size) {
  SbRing *ring = fitted(body, load, size);
  const SbDiffusionConverged out = of_ring(ring);
  sb_ring_destroy(ring);
  return out;
}

// What the ring's own mesh leaves in the place of its contacts' ends, which the solve of the
// diffusion does not see: half of the error of the width that sb_ring_fit() tells at this size.
static double width_error(double size) {
  return 0.5 * 1.5e-3 * size / 0.03;
}

// Dry and pressed: elements of the contact from 0.05 to 0.006 of the section's diameter. Quadratic
// elements with quarter points at the ends of faces, on the ring's mesh and on one four times as
// fine.
static void test_converges(void) {
  for (int k = 0; k < 2; k++) {
    const SbRingLoad load = groove(k * 0.55e6);
    const double size[] = {0.05, 0.03, 0.018, 0.006};
    SbDiffusionConverged value[4];
    for (int i = 3; i >= 0; i--) {
      value[i] = solve(&BODY, &load, size[i]);
      const double off = value[i].steady.conductance / value[3].steady.conductance - 1.0;
      g_test_message("%g MPa, size %g: %.6g mm, off %.1e, estimate %.1e, balance %.1e",
                     load.pressure_left * 1e-6, size[i], 1e3 * value[i].steady.conductance, off,
                     value[i].error, value[i].flux_gap);
      g_assert_cmpfloat(value[i].flux_gap, <, 1e-10);
    }
    // At the size of a tolerance of 1e-3.
    assert_close(value[1].steady.conductance, value[3].steady.conductance, 1e-3);
    assert_close(value[2].steady.conductance, value[3].steady.conductance, 5e-4);
    for (int i = 0; i < 3; i++) {
      const double off = fabs(value[i].steady.conductance / value[3].steady.conductance - 1.0);
      g_assert_cmpfloat(off, <=, 3.0 * (value[i].error + width_error(size[i])));
    }
  }
}

// The slab that closed forms make of the ring: as high as the radial space, as wide as its volume
// leaves it. Its flanks being round, the ring lets more through.
static void test_slab(void) {
  const SbRingLoad load = groove(0.0);
  const SbDiffusionConverged value = solve(&BODY, &load, 0.03);
  const double height = load.bore_radius - load.floor_radius;
  const double width = value.steady.volume / (M_PI * (3e-3 + 1.64e-3) * height);
  const double slab = M_PI * (3e-3 + 1.64e-3) * height / width;
  g_test_message("%.4g of the slab's", value.steady.conductance / slab);
  g_assert_cmpfloat(value.steady.conductance, >, 1.1 * slab);
  g_assert_cmpfloat(value.steady.conductance, <, 1.5 * slab);
  // Its time lag lies between that of the slab and of the chord between the contacts' ends.
  g_assert_cmpfloat(value.steady.lag, <, width * width / 6.0);
  g_assert_cmpfloat(value.steady.lag, >, 0.3 * width * width / 6.0);
}

// More squeeze makes the way longer and narrower; more stretch a thinner cord, which lets more
// through.
static void test_signs(void) {
  SbRingLoad load = open_groove();
  const double base = solve(&BODY, &load, 0.05).steady.conductance;
  load.floor_radius += 0.05e-3;
  load.bore_radius -= 0.05e-3;
  const double squeezed = solve(&BODY, &load, 0.05).steady.conductance;
  g_assert_cmpfloat(squeezed, <, 0.95 * base);
  SbRingBody tight = BODY;
  tight.inner_diameter *= 0.9;
  load = open_groove();
  const double stretched = solve(&tight, &load, 0.05).steady.conductance;
  g_assert_cmpfloat(stretched, >, 1.02 * base);
}

// The same ring from the other side: what is inside does not count.
static void test_mirror(void) {
  SbRing *ring = NULL;
  SbWettedMesh *section;
  SbDiffusionConverged out;
  const SbRingLoad load = groove(0.3e6);
  ring = fitted(&BODY, &load, 0.05);
  const double there = of_ring(ring).steady.conductance;
  g_assert_cmpint(sb_wetted_ring_create(&section, ring, true, NULL), ==, SB_OK);
  g_assert_cmpint(sb_diffusion_converge(&out, section, NULL), ==, SB_OK);
  assert_close(out.steady.conductance, there, 1e-10);
  sb_wetted_mesh_destroy(section);
  sb_ring_destroy(ring);
}

// A ring that does not touch the bore has no section that anything would have to permeate.
static void test_open(void) {
  SbRing *ring = NULL;
  SbWettedMesh *section;
  SbReport report;
  SbRingLoad load = open_groove();
  load.bore_radius = load.floor_radius + 2e-3;
  ring = fitted(&BODY, &load, 0.05);
  g_assert_cmpint(sb_wetted_ring_create(&section, ring, false, &report), ==, SB_ERROR_INFEASIBLE);
  g_assert_null(section);
  sb_ring_destroy(ring);
}

int main(int argc, char **argv) {
  g_test_init(&argc, &argv, NULL);
  g_test_add_func("/permeation-ring/converges", test_converges);
  g_test_add_func("/permeation-ring/slab", test_slab);
  g_test_add_func("/permeation-ring/signs", test_signs);
  g_test_add_func("/permeation-ring/mirror", test_mirror);
  g_test_add_func("/permeation-ring/open", test_open);
  return g_test_run();
}
