// Motion where friction falls with the speed, by Stribeck's law or a film's drag: where it takes
// off, where stick-slip ends, and where contacts chatter between rest and sliding.
#include "engine/mechanism/dynamics.h"

#include "tests/engine/near.h"
#include "tests/engine/ramp.h"

#include <glib.h>
#include <math.h>

static void start(SbDynamics *s, const SbDynamicsModel *m) {
  SbReport report = {0};
  SbStatus status = sb_dynamics_init(s, m, &report);
  g_assert_cmpstr(report.text, ==, "");
  g_assert_cmpint(status, ==, SB_OK);
}

static void advance(SbDynamics *s, double t, SbDynamicsSample *sample, SbDynamicsEnergy *energy) {
  SbReport report = {0};
  SbStatus status = sb_dynamics_advance(s, t, &report);
  g_assert_cmpstr(report.text, ==, "");
  g_assert_cmpint(status, ==, SB_OK);
  sb_dynamics_sample(s, sample, energy);
}

static void level_loads(SbDynamicsLoads *loads, double x, size_t region, const double *extra,
                        void *user) {
  *loads = (SbDynamicsLoads){.level = {4.0}};
}

// Drag of a film up to 1 um/s, by 0.01 N, and no more beyond.
static void bent_band(SbDynamicsBand *band, double x, size_t region, int direction, double speed,
                      const double *extra, void *user) {
  *band = speed < 1e-6 ? (SbDynamicsBand){.high = 1e-6, .slope = {1e4}}
                       : (SbDynamicsBand){.low = 1e-6, .high = INFINITY, .rise = {0.01}};
}

// A slow machine drags a stem through the film's drag, beyond which Stribeck's law alone acts and
// falls by 4000 N s/m: speed grows there a million times a second, while the stem has crept in
// steps of a ten thousandth of one. A step as long as that damps what grows: the stem would stay at
// 1 um/s, in endless changes from one band to the other.
static void test_take_off(void) {
  const double tolerances[] = {1e-8, 1e-10};
  SbDynamicsSample at[2];
  for (int i = 0; i < 2; i++) {
    // At the start the machine presses with the 4.4 N of sliding at no speed.
    SbDynamicsModel m = {.mass = 4e-3,
                         .contacts = 1,
                         .contact = {{.static_ratio = 1.1,
                                      .stribeck_speed = 1e-4,
                                      .stribeck_exponent = 1.0,
                                      .stiffness = INFINITY}},
                         .loads = level_loads,
                         .band = bent_band,
                         .drive = ramp(4.4 / 9e4, 1.0, 3e-5),
                         .drive_stiffness = 9e4,
                         .start_speed = 1e-8,
                         .tolerance = tolerances[i]};
    SbDynamics s;
    SbDynamicsEnergy energy;
    start(&s, &m);
    // Up to 1 um/s friction rises by 0.006 N, and the push by 2.7 N/s.
    advance(&s, 2e-3, &at[i], NULL);
    g_assert_cmpfloat(at[i].speed, <, 1e-6);
    advance(&s, 2.5e-3, &at[i], &energy);
    g_test_message("take-off: %.9g m/s at %.9g m, %ld events, closure %.1e", at[i].speed,
                   at[i].position, s.counters.events, energy.closure);
    g_assert_cmpfloat(energy.closure, <, 1e-5);
  }
  // All of Stribeck's 0.4 N released by the mass on the machine's spring: 0.4 N / sqrt(k m).
  g_assert_cmpfloat(at[1].speed, >, 0.01);
  ASSERT_NEAR(at[0].speed / at[1].speed, 1.0, 1e-3);
}

// The level falls with the position, and with it the slope of Stribeck's law.
static void falling_loads(SbDynamicsLoads *loads, double x, size_t region, const double *extra,
                          void *user) {
  *loads = (SbDynamicsLoads){.force = -4.0, .level = {0.2 * (1.0 - x / 3e-3)}};
}

// Where it falls no more than the machine's damper dissipates, stick-slip ends and the stem slides
// on. No group of cycles passes over that place: the balance of energies would stay open.
static void test_end(void) {
  SbDynamicsModel m = {.mass = 6.6e-6,
                       .contacts = 1,
                       .contact = {{.static_ratio = 1.4,
                                    .stribeck_speed = 2.2e-2,
                                    .stribeck_exponent = 1.0,
                                    .stiffness = INFINITY}},
                       .loads = falling_loads,
                       .drive = ramp(4.28 / 3.8e6, 1.0, 3e-3),
                       .drive_stiffness = 3.8e6,
                       .drive_damping = 0.5};
  SbDynamics s;
  SbDynamicsSample at;
  SbDynamicsEnergy energy;
  start(&s, &m);
  advance(&s, 0.93, &at, &energy);
  const long events = s.counters.events;
  g_test_message("end: %ld events, %ld cycles in groups, %.9g m/s at %.9g m, closure %.1e", events,
                 s.counters.grouped, at.speed, at.position, energy.closure);
  g_assert_cmpint(s.counters.grouped, >, 100);
  g_assert_cmpfloat(energy.closure, <, 1e-6);
  ASSERT_NEAR(at.speed, 3e-3, 1e-5);
  advance(&s, 0.95, &at, &energy);
  g_assert_cmpint(s.counters.events, ==, events);
}

static void constant_loads(SbDynamicsLoads *loads, double x, size_t region, const double *extra,
                           void *user) {
  *loads = (SbDynamicsLoads){
      .force = -((double *)user)[0], .level = {((double *)user)[1]}, .constant = true};
}

// Static friction equal to sliding friction: just where the stem breaks away, from a stop that it
// was pressed onto, rounding decides whether it moves. It does, or stays for a while that time has
// digits for.
static void test_equal(void) {
  GRand *random = g_rand_new_with_seed(31);
  for (int i = 0; i < 2000; i++) {
    double force[2] = {g_rand_double_range(random, 0.0, 2.0),
                       g_rand_double_range(random, 0.01, 1.0)};
    SbDynamicsModel m = {
        .mass = g_rand_double_range(random, 1e-3, 2e-2),
        .contacts = 1,
        .contact = {{.static_ratio = 1.0, .stiffness = INFINITY}},
        .stops = 1,
        .stop = {{.position = 5e-3, .side = 1, .stiffness = 4e5, .restitution = 0.5}},
        .loads = constant_loads,
        .user = force,
        .drive = {.kind = SB_DRIVE_PRESS,
                  .start = 5e-3,
                  .end = 5e-3 + g_rand_double_range(random, 1e-6, 1e-4),
                  .rise = 0.1,
                  .hold = 0.1,
                  .fall = g_rand_double_range(random, 0.1, 1.0),
                  .cycles = 1},
        .drive_stiffness = 1e7,
        .drive_damping = 10.0,
        .start_position = 5e-3};
    SbDynamics s;
    SbDynamicsSample at;
    SbDynamicsEnergy energy;
    start(&s, &m);
    advance(&s, 2.0, &at, &energy);
    g_assert_cmpfloat(energy.closure, <, 1e-6);
  }
  g_rand_free(random);
}

// Drag of a film that rises steeply to 1 um/s and falls to nothing at 2 mm/s.
static void peaked_band(SbDynamicsBand *band, double x, size_t region, int direction, double speed,
                        const double *extra, void *user) {
  const SbDynamicsBand part[] = {{.high = 1e-6, .slope = {1e4}},
                                 {.low = 1e-6, .high = 2e-3, .rise = {0.01}, .slope = {-5.0}},
                                 {.low = 2e-3, .high = INFINITY}};
  *band = part[speed < 1e-6 ? 0 : speed < 2e-3 ? 1 : 2];
}

// Drag acts by the stem's speed while the contact slides, and not while it holds. A stem that
// creeps below the peak of its drag sticks and slips in turn, until the contact's spring has
// relaxed: within a few milliseconds, some hundred times.
static void test_chatter(void) {
  double force[2] = {0.0, 0.384};
  SbDynamicsModel m = {.mass = 8.66e-3,
                       .contacts = 1,
                       .contact = {{.static_ratio = 1.0, .stiffness = 39264.0, .damping = 1.84}},
                       .loads = constant_loads,
                       .user = force,
                       .band = peaked_band,
                       .drive = ramp(0.0, 1.0, 1.29e-4),
                       .drive_stiffness = 3659.0,
                       .drive_damping = 0.6};
  SbDynamics s;
  SbDynamicsSample at;
  SbDynamicsEnergy energy;
  start(&s, &m);
  advance(&s, 3.0, &at, &energy);
  g_test_message("chatter: %ld segments, %ld events, %ld cycles passed over, at %.9g m, closure "
                 "%.1e",
                 s.counters.segments, s.counters.events, s.counters.repeated, at.position,
                 energy.closure);
  g_assert_cmpint(s.counters.segments, <, 100000);
  g_assert_cmpfloat(energy.closure, <, 1e-6);
  ASSERT_NEAR(at.position, 3.0 * 1.29e-4 - 0.384 / 3659.0, 5e-6);
}

int main(int argc, char **argv) {
  g_test_init(&argc, &argv, NULL);
  g_test_add_func("/motion/stribeck/take-off", test_take_off);
  g_test_add_func("/motion/stribeck/end", test_end);
  g_test_add_func("/motion/stribeck/equal", test_equal);
  g_test_add_func("/motion/stribeck/chatter", test_chatter);
  return g_test_run();
}
