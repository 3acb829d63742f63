// The coefficients of the sliding-plate rig.
#include "engine/valve/run/rig.h"
#include "tests/engine/near.h"

#include <glib.h>
#include <math.h>

// ---- coefficients of a signal ----

static SbStatus coefficients(SbRigCoefficients *out, const double *force, size_t count, double rate,
                             double load, double prominence, SbReport *report) {
  SbRigSignal signal = {.prominence = prominence};
  for (size_t i = 0, peak; i < count; i++) {
    if (sb_rig_signal_add(&signal, force[i], &peak)) {
      g_assert_cmpfloat(force[peak] - force[i], >, prominence);
    }
  }
  return sb_rig_coefficients(out, &signal, &(SbRig){.load = load, .rate = rate}, report);
}

static void test_signal(void) {
  // First peak 1.02, then peaks 0.8, 0.84, 0.82 over troughs of 0.7; ripple of 0.01 is no peak.
  double corner[][2] = {{0, 0},      {200, 1.02}, {220, 0.70}, {300, 0.80}, {310, 0.70},
                        {400, 0.84}, {410, 0.70}, {500, 0.82}, {510, 0.70}, {600, 0.75}};
  double force[601];
  size_t k = 0;
  for (int i = 0; i <= 600; i++) {
    while (i > corner[k + 1][0]) {
      k++;
    }
    double f = (i - corner[k][0]) / (corner[k + 1][0] - corner[k][0]);
    force[i] = corner[k][1] + f * (corner[k + 1][1] - corner[k][1]);
    bool at_corner = i == corner[k][0] || i == corner[k + 1][0];
    force[i] += at_corner ? 0.0 : (i % 2 ? -0.005 : -0.0002);
  }
  SbRigCoefficients c;
  SbReport report = {0};
  g_assert_cmpint(coefficients(&c, force, 601, 1000.0, 2.0, 0.03, &report), ==, SB_OK);
  ASSERT_NEAR(c.static_coefficient, 0.51, 1e-12);
  ASSERT_NEAR(c.dynamic_coefficient, (0.80 + 0.84 + 0.82) / 6.0, 1e-12);
  ASSERT_NEAR(c.first_time, 0.2, 1e-12);
  g_assert_cmpuint(c.peaks, ==, 3);
  g_assert_true(c.stick_slip);
  g_assert_cmpfloat(c.mean_coefficient, <, c.dynamic_coefficient);
  // Never broke away.
  g_assert_cmpint(coefficients(&c, force, 150, 1000.0, 2.0, 0.03, &report), ==,
                  SB_ERROR_INFEASIBLE);
  g_assert_cmpint(coefficients(&c, force, 601, 1000.0, 0.0, 0.03, &report), ==, SB_ERROR_RANGE);
}

// The rig of sliding-plate.scene.
static SbRig rig_defaults(void) {
  return (SbRig){.load = 2.0,
                 .mass = 0.204,
                 .coefficient = 0.4,
                 .contact = {.static_ratio = 1.0,
                             .dwell_gain = 0.04,
                             .dwell_time = 0.01,
                             .stiffness = 5e3,
                             .damping = 1.0},
                 .speed = 1e-3,
                 .thread_stiffness = 2e3,
                 .thread_damping = 1.0,
                 .rest = 60.0,
                 .duration = 5.0,
                 .rate = 1000.0};
}

static SbStatus run_rig(const SbRig *rig, double *force, SbDynamicsEnergy *energy,
                        SbReport *report) {
  SbDynamics motion;
  SbDynamicsModel model;
  SbStatus status = sb_rig_start(&motion, &model, rig, report);
  for (size_t i = 0; status == SB_OK && i < sb_rig_samples(rig); i++) {
    SbDynamicsSample sample;
    status = sb_dynamics_advance(&motion, (double)i / rig->rate, report);
    sb_dynamics_sample(&motion, &sample, energy);
    force[i] = sample.drive_force;
  }
  return status;
}

// Stick-slip of a rigid plate on a spring: peaks and period of the closed form, within what a
// thousand samples a second can see.
static void test_rig(void) {
  SbRig rig = rig_defaults();
  rig.contact = (SbDynamicsContact){.static_ratio = 1.4, .stiffness = INFINITY};
  rig.thread_damping = 0.0;
  static double force[100001];
  SbDynamicsEnergy energy;
  SbReport report = {0};
  size_t n = sb_rig_samples(&rig);
  g_assert_cmpuint(n, ==, 5001);
  g_assert_cmpint(run_rig(&rig, force, &energy, &report), ==, SB_OK);
  g_assert_cmpfloat(energy.closure, <, 1e-9);
  SbRigCoefficients c;
  g_assert_cmpint(coefficients(&c, force, n, rig.rate, rig.load, 0.02, &report), ==, SB_OK);
  // The force goes on rising after the slip has begun until the plate is as fast as the thread.
  double level = rig.coefficient * rig.load, k = rig.thread_stiffness;
  double w = sqrt(k / rig.mass), a = 0.4 * level / k;
  double peak = (level + k * hypot(a, rig.speed / w)) / rig.load;
  double sample = k * rig.speed / rig.rate; // rise between two samples, N
  ASSERT_NEAR(c.static_coefficient, peak, sample / rig.load);
  ASSERT_NEAR(c.dynamic_coefficient, peak, sample / rig.load);
  double stick = 2.0 * 0.4 * level / k / rig.speed;
  double slip = 2.0 * (G_PI - atan(a * w / rig.speed)) / w;
  double expected = (5.0 - 1.4 * level / k / rig.speed) / (stick + slip);
  ASSERT_NEAR((double)c.peaks, floor(expected), 1.0);
  g_test_message("rigid: static %.4f dynamic %.4f mean %.4f, %zu peaks", c.static_coefficient,
                 c.dynamic_coefficient, c.mean_coefficient, c.peaks);
  // At ten times the rate the sampled peaks come closer.
  rig.rate = 1e4;
  n = sb_rig_samples(&rig);
  g_assert_cmpint(run_rig(&rig, force, NULL, &report), ==, SB_OK);
  g_assert_cmpint(coefficients(&c, force, n, rig.rate, rig.load, 0.02, &report), ==, SB_OK);
  ASSERT_NEAR(c.dynamic_coefficient, peak, 0.1 * sample / rig.load);
  // The default rig: strength that grows with rest makes the first peak the highest.
  rig = rig_defaults();
  n = sb_rig_samples(&rig);
  g_assert_cmpint(run_rig(&rig, force, &energy, &report), ==, SB_OK);
  g_assert_cmpfloat(energy.closure, <, 1e-9);
  g_assert_cmpint(coefficients(&c, force, n, rig.rate, rig.load, 0.01, &report), ==, SB_OK);
  g_test_message("default: static %.4f dynamic %.4f mean %.4f, %zu peaks", c.static_coefficient,
                 c.dynamic_coefficient, c.mean_coefficient, c.peaks);
  g_assert_true(c.stick_slip);
  g_assert_cmpfloat(c.static_coefficient, >, c.dynamic_coefficient + 0.02);
  g_assert_cmpfloat(c.dynamic_coefficient, >, c.mean_coefficient);
  g_assert_cmpfloat(c.mean_coefficient, >, 0.9 * rig.coefficient);
  // Slips that differ are told ahead by the time that is looked at, not by a drive without end.
  rig = rig_defaults();
  rig.contact = (SbDynamicsContact){
      .static_ratio = 1.4, .stribeck_speed = 1e-2, .stribeck_exponent = 1.0, .stiffness = INFINITY};
  rig.duration = 1.0;
  g_assert_cmpint(run_rig(&rig, force, &energy, &report), ==, SB_OK);
  rig.load = -1.0;
  g_assert_cmpint(run_rig(&rig, force, NULL, &report), ==, SB_ERROR_RANGE);
}

int main(int argc, char **argv) {
  g_test_init(&argc, &argv, NULL);
  g_test_add_func("/motion/rig/signal", test_signal);
  g_test_add_func("/motion/rig/plate", test_rig);
  return g_test_run();
}
