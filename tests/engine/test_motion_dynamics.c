// Motion with friction and stops against closed forms: decay, stick-slip, bounces, rest, energy.
#include "engine/mechanism/dynamics.h"

#include "tests/engine/near.h"
#include "tests/engine/ramp.h"

#include <glib.h>
#include <math.h>
#include <string.h>

enum { EVENTS = 4000 };

typedef struct {
  SbMotionEvent event[EVENTS];
  int count;
} Log;

static void record(const SbMotionEvent *event, void *user) {
  Log *log = user;
  if (log->count < EVENTS) {
    log->event[log->count++] = *event;
  }
}

// The n-th event of a kind, or NULL.
static const SbMotionEvent *nth(const Log *log, SbMotionEventKind kind, int n) {
  for (int i = 0; i < log->count; i++) {
    if (log->event[i].kind == kind && n-- == 0) {
      return &log->event[i];
    }
  }
  return NULL;
}

// Loads of the tests: a force and levels that hold everywhere.
typedef struct {
  SbDynamicsLoads loads;
} Flat;

static void flat_loads(SbDynamicsLoads *loads, double x, size_t region, const double *extra,
                       void *user) {
  *loads = ((Flat *)user)->loads;
}

static void go(SbDynamics *s, const SbDynamicsModel *m, Log *log) {
  SbReport report = {0};
  SbStatus status = sb_dynamics_init(s, m, &report);
  g_assert_cmpstr(report.text, ==, "");
  g_assert_cmpint(status, ==, SB_OK);
  if (log != NULL) {
    log->count = 0;
    sb_dynamics_listen(s, record, log);
  }
}

static void advance(SbDynamics *s, double t) {
  SbReport report = {0};
  SbStatus status = sb_dynamics_advance(s, t, &report);
  g_assert_cmpstr(report.text, ==, "");
  g_assert_cmpint(status, ==, SB_OK);
}

static double closure(const SbDynamics *s) {
  SbDynamicsEnergy e;
  sb_dynamics_sample(s, NULL, &e);
  return e.closure;
}

// ---- rigid friction ----

// A mass on a spring with Coulomb friction loses 2F/k of amplitude each half period, then stays.
static void coulomb_decay(bool numerical, double tolerance) {
  double k = 100.0, mass = 0.5, level = 3.0, x0 = 0.4;
  Flat flat = {{.level = {level}, .constant = !numerical}};
  SbDynamicsModel m = {.mass = mass,
                       .spring_stiffness = k,
                       .contacts = 1,
                       .contact = {{.static_ratio = 1.0, .stiffness = INFINITY}},
                       .loads = flat_loads,
                       .user = &flat,
                       .start_position = x0,
                       .tolerance = 1e-11};
  SbDynamics s;
  Log log;
  go(&s, &m, &log);
  advance(&s, 20.0);
  double half = G_PI / sqrt(k / mass), x = x0;
  int turns = 0;
  while (fabs(x) > level / k) {
    x = x > 0.0 ? -(x - 2.0 * level / k) : -(x + 2.0 * level / k);
    turns++;
    const SbMotionEvent *e = nth(&log, SB_MOTION_STICK, turns - 1);
    g_assert_nonnull(e);
    ASSERT_NEAR(e->position, x, tolerance * x0);
    ASSERT_NEAR(e->time, turns * half, tolerance * half);
  }
  g_assert_cmpint(turns, ==, 7);
  g_assert_null(nth(&log, SB_MOTION_STICK, turns));
  SbDynamicsSample sample;
  SbDynamicsEnergy e;
  sb_dynamics_sample(&s, &sample, &e);
  g_assert_true(sample.speed == 0.0);
  ASSERT_NEAR(sample.position, x, tolerance * x0);
  ASSERT_NEAR(sample.friction[0], k * x, tolerance * k * x0);
  // All that was stored and is not any more was rubbed away. No external work: compare directly.
  ASSERT_NEAR(-e.stored, e.friction, tolerance * e.friction);
}

static void test_decay(void) {
  coulomb_decay(false, 1e-12);
  coulomb_decay(true, 1e-8);
}

// A mass dragged through a spring at constant speed, which is the mass on a belt: stick and slip.
static void belt(bool numerical, double tolerance) {
  double k = 50.0, mass = 0.2, level = 2.0, ratio = 1.6, speed = 0.05;
  Flat flat = {{.level = {level}, .constant = !numerical}};
  SbDynamicsModel m = {
      .mass = mass,
      .contacts = 1,
      .contact = {{.static_ratio = ratio, .stiffness = INFINITY}},
      .loads = flat_loads,
      .user = &flat,
      .drive = ramp(0.0, 1.0, speed),
      .drive_stiffness = k,
      .drive_bonded = true,
      .tolerance = 1e-11,
  };
  SbDynamics s;
  Log log;
  go(&s, &m, &log);
  advance(&s, 15.0);
  double w = sqrt(k / mass), a = (ratio - 1.0) * level / k;
  double slip = 2.0 * (G_PI - atan(a * w / speed)) / w, stick = 2.0 * a / speed;
  double start = ratio * level / k / speed;
  for (int i = 0; i < 8; i++) {
    ASSERT_NEAR(nth(&log, SB_MOTION_SLIP, i)->time, start + i * (slip + stick), tolerance * 10.0);
    ASSERT_NEAR(nth(&log, SB_MOTION_STICK, i)->time, start + i * (slip + stick) + slip,
                tolerance * 10.0);
    ASSERT_NEAR(nth(&log, SB_MOTION_SLIP, i)->drive_force, ratio * level, tolerance * 10.0);
  }
  g_assert_cmpfloat(closure(&s), <, 1e-9);
}

static void test_belt(void) {
  belt(false, 1e-12);
  belt(true, 1e-8);
}

// A machine of 5e9 N/m without damping slips a million times in ten seconds: passed over in whole
// periods it gets where stepping through them gets (asked for so often that nothing is skipped), at
// a bounded number of events.
static void stiff_loads(SbDynamicsLoads *loads, double x, size_t region, const double *extra,
                        void *user) {
  *loads = (SbDynamicsLoads){.force = -14.5,
                             .level = {region == 0 ? 13.0 : 13.0 - 1e3 * (x - 3e-3)},
                             .constant = region == 0};
}

static void test_stiff(void) {
  SbDynamicsModel m = {.mass = 3.73e-3,
                       .contacts = 1,
                       .contact = {{.static_ratio = 1.1, .stiffness = INFINITY}},
                       .edges = 1,
                       .edge = {3e-3},
                       .loads = stiff_loads,
                       .drive = ramp(0.0, 1.0, 20e-3 / 60.0),
                       .drive_stiffness = 5e9};
  SbDynamics once, often;
  SbDynamicsSample a, b;
  SbDynamicsEnergy e, f;
  go(&once, &m, NULL);
  advance(&once, 0.05);
  go(&often, &m, NULL);
  for (int i = 1; i <= 2500; i++) {
    advance(&often, i * 2e-5);
  }
  SbDynamicsCounters c = once.counters, d = often.counters;
  sb_dynamics_sample(&once, &a, &e);
  sb_dynamics_sample(&often, &b, &f);
  g_test_message("%ld events and %ld cycles passed over, %ld events; place %.2e m, work %.2e off",
                 c.events, c.repeated, d.events, fabs(a.position - b.position),
                 fabs(e.drive / f.drive - 1.0));
  g_assert_cmpint(c.events, <, 700);
  g_assert_cmpint(c.repeated, >, 5000);
  g_assert_cmpint(d.repeated, ==, 0);
  g_assert_cmpint(d.events, >, 10000);
  ASSERT_NEAR(a.position, b.position, 1e-15);
  ASSERT_NEAR(e.drive / f.drive, 1.0, 1e-10);
  ASSERT_NEAR(e.friction / f.friction, 1.0, 1e-10);
  g_assert_cmpfloat(e.closure, <, 1e-9);
  g_assert_cmpfloat(f.closure, <, 1e-9);
  // All the way, the level rising behind the edge to twice what it was.
  advance(&once, 30.0);
  g_assert_cmpint(once.counters.events, <, 20000);
  sb_dynamics_sample(&once, &a, &e);
  g_assert_cmpfloat(a.position, >, 9e-3);
  g_assert_cmpfloat(e.closure, <, 1e-7);
}

// 99.9 % of the limit: not a bit of movement, in a million steps, rigid or through a seal.
// Slow changes, each alone: a level that falls along the way, a sinusoid's speed, what holds
// growing with the rest; equal cycles that are more than a slip: elastic contacts that take turns,
// under a return spring; and cycles that throw the stem off the platen. Passed over they go where
// stepping goes (asked for too often to skip any).
static void falling_loads(SbDynamicsLoads *loads, double x, size_t region, const double *extra,
                          void *user) {
  *loads = (SbDynamicsLoads){.level = {10.0 * exp(-x / 2e-3), 4.0 * exp(-x / 2e-3)}};
}

static void two_loads(SbDynamicsLoads *loads, double x, size_t region, const double *extra,
                      void *user) {
  *loads = (SbDynamicsLoads){.level = {8.0, 2.0}, .constant = true};
}

static void test_groups(void) {
  const SbDynamicsContact rigid = {.static_ratio = 1.3, .stiffness = INFINITY};
  const SbDynamicsContact ages = {
      .static_ratio = 1.2, .dwell_gain = 0.05, .dwell_time = 1e-5, .stiffness = INFINITY};
  const SbDynamicsContact elastic = {.static_ratio = 1.5, .stiffness = 4e5, .damping = 2.0};
  // Slips by twice what it lacks, more than the platen is pressed by.
  const SbDynamicsContact springy = {.static_ratio = 3.0, .stiffness = INFINITY};
  const SbDrive straight = ramp(0.0, 1.0, 2e-3);
  const SbDrive sine = {.kind = SB_DRIVE_SINE, .amplitude = 1e-3, .frequency = 0.4};
  const struct {
    const char *name;
    SbDynamicsContact contact;
    void (*loads)(SbDynamicsLoads *, double, size_t, const double *, void *);
    SbDrive drive;
    double spring, damping, until;
    int asks;
    bool grouped;
  } cases[] = {
      {"place", rigid, falling_loads, straight, 0.0, 0.0, 0.03, 4000, true},
      {"speed", rigid, two_loads, sine, 0.0, 0.0, 0.05, 6000, true},
      {"rest", ages, falling_loads, straight, 300.0, 0.0, 0.03, 4000, true},
      {"turns", elastic, two_loads, straight, 2000.0, 3.0, 1.0, 4000, false},
      {"thrown", springy, two_loads, straight, 0.0, 0.0, 0.03, 4000, false},
      {"thrown, place", springy, falling_loads, straight, 0.0, 2.0, 0.03, 4000, true},
      {"thrown, spring", springy, two_loads, straight, 500.0, 0.0, 0.4, 50000, true},
  };
  for (size_t i = 0; i < G_N_ELEMENTS(cases); i++) {
    SbDynamicsModel m = {.mass = 1e-3,
                         .contacts = 2,
                         .contact = {cases[i].contact, cases[i].contact},
                         .loads = cases[i].loads,
                         .spring_stiffness = cases[i].spring,
                         .drive = cases[i].drive,
                         .drive_stiffness = 2e8,
                         .drive_damping = cases[i].damping};
    SbDynamics once, often;
    SbDynamicsSample a, b;
    SbDynamicsEnergy e, f;
    go(&once, &m, NULL);
    advance(&once, cases[i].until);
    go(&often, &m, NULL);
    for (int k = 1; k <= cases[i].asks; k++) {
      advance(&often, cases[i].until * k / cases[i].asks);
    }
    sb_dynamics_sample(&once, &a, &e);
    sb_dynamics_sample(&often, &b, &f);
    // A sliding rigid contact takes its level all along the way, whatever the cycles.
    double way = a.position, fall = 14.0 * 2e-3 * (1.0 - exp(-way / 2e-3));
    double rubbed = cases[i].loads == falling_loads     ? fall
                    : isinf(cases[i].contact.stiffness) ? 10.0 * way
                                                        : f.friction;
    g_test_message("%s: %ld events and %ld cycles passed over (%ld), %ld events (%ld); place %.1e "
                   "m, friction %.1e off, closure %.1e",
                   cases[i].name, once.counters.events, once.counters.repeated,
                   once.counters.grouped, often.counters.events, often.counters.repeated,
                   fabs(a.position - b.position), fabs(e.friction / rubbed - 1.0), e.closure);
    g_assert_cmpint(often.counters.repeated, ==, 0);
    g_assert_cmpint(10 * once.counters.events, <, often.counters.events);
    g_assert_cmpint(once.counters.grouped > 0, ==, cases[i].grouped);
    g_assert_cmpint(often.platens > 100, ==, cases[i].contact.static_ratio == 3.0);
    ASSERT_NEAR(e.friction / rubbed, 1.0, 1e-7);
    g_assert_cmpfloat(e.closure, <, 1e-7);
    // The phase in the cycle is free, but for equal cycles: less than a slip.
    const double slip = 2.3 * (cases[i].contact.static_ratio - 1.0) * 14.0 / m.drive_stiffness;
    ASSERT_NEAR(a.position, b.position, cases[i].grouped ? slip : 1e-15);
  }
}

static void pressed_back(SbDynamicsLoads *loads, double x, size_t region, const double *extra,
                         void *user) {
  *loads = (SbDynamicsLoads){.force = -14.5, .level = {8.0, 2.0}, .constant = true};
}

// A group of slips ends before an edge, also where the drive becomes faster on the way there, as a
// sinusoid does behind its turn. From behind the edge the stem would be set back to it, hundreds of
// newtons off the platen, and thrown onto the platen.
static void test_group_edges(void) {
  const SbDynamicsContact rigid = {.static_ratio = 1.3, .stiffness = INFINITY};
  const SbDynamicsModel m = {
      .mass = 1e-3,
      .contacts = 2,
      .contact = {rigid, rigid},
      .loads = pressed_back,
      .edges = 5,
      .edge = {1.0e-3, 1.4e-3, 1.7e-3, 1.9e-3, 1.98e-3},
      .drive = {.kind = SB_DRIVE_SINE, .amplitude = 2e-3, .frequency = 0.4},
      .drive_stiffness = 2e8,
      .tolerance = 1e-6,
  };
  SbDynamics d;
  SbDynamicsSample at;
  SbDynamicsEnergy e;
  go(&d, &m, NULL);
  advance(&d, 0.625);
  sb_dynamics_sample(&d, &at, &e);
  const double top = at.position, peak = sb_dynamics_force_peak(&d);
  const long before = d.counters.grouped, lifted = d.platens;
  advance(&d, 1.1);
  sb_dynamics_sample(&d, &at, &e);
  g_test_message("%ld events, %ld cycles in groups; from %.4g to %.4g m, %ld times off the platen, "
                 "peak %.9g N, before %.9g N, closure %.1e",
                 d.counters.events, d.counters.grouped - before, top, at.position,
                 d.platens - lifted, sb_dynamics_force_peak(&d), peak, e.closure);
  g_assert_cmpfloat(top, >, m.edge[4]);
  g_assert_cmpfloat(at.position, <, m.edge[0]);
  g_assert_cmpint(d.counters.grouped - before, >, d.counters.events);
  g_assert_cmpint(d.platens, ==, lifted);
  g_assert_cmpfloat(sb_dynamics_force_peak(&d), ==, peak);
  g_assert_cmpfloat(e.closure, <, 5e-7); // a group's force is off its parabola by as much
}

static void test_incline(void) {
  Flat flat = {{.force = 0.999 * 5.0, .level = {5.0}, .constant = true}};
  SbDynamicsModel m = {.mass = 1.0,
                       .contacts = 1,
                       .contact = {{.static_ratio = 1.0, .stiffness = INFINITY}},
                       .loads = flat_loads,
                       .user = &flat,
                       .start_position = 0.123456789};
  SbDynamics s;
  SbDynamicsSample sample;
  go(&s, &m, NULL);
  for (int i = 1; i <= 1000000; i++) {
    advance(&s, i * 1e-3);
  }
  sb_dynamics_sample(&s, &sample, NULL);
  g_assert_true(sample.position == 0.123456789);
  g_assert_true(sample.speed == 0.0);
  ASSERT_NEAR(sample.friction[0], -0.999 * 5.0, 1e-15);
  g_assert_cmpint(s.counters.events, ==, 0);
  // Through an elastic seal that was never overloaded the patch stays where it is, exactly.
  flat.loads.force = 0.0;
  m.drive = ramp(0.0, 0.999 * 5.0, 0.1);
  m.drive.quantity = SB_DRIVE_OF_FORCE;
  m.contact[0].stiffness = 1e4;
  m.contact[0].damping = 20.0;
  go(&s, &m, NULL);
  advance(&s, 60.0);
  sb_dynamics_sample(&s, &sample, NULL);
  double patch = sample.position - sample.deflection[0], at = sample.position;
  for (int i = 1; i <= 100000; i++) {
    advance(&s, 60.0 + i * 1e-3);
  }
  sb_dynamics_sample(&s, &sample, NULL);
  g_assert_true(sample.position == at);
  g_assert_true(sample.position - sample.deflection[0] == patch);
  ASSERT_NEAR(patch, 0.123456789, 1e-16);
  ASSERT_NEAR(sample.deflection[0], 0.999 * 5.0 / 1e4, 1e-15);
  g_assert_cmpint(s.counters.events, <=, 1);
}

// ---- stops ----

// A mass thrown at a rigid floor: every bounce at its time, then rest with its weight on the floor.
static void test_bounce(void) {
  double g = 9.81, mass = 0.3, height = 0.7, e = 0.8;
  Flat flat = {{.force = -mass * g, .constant = true}};
  SbDynamicsModel m = {.mass = mass,
                       .stops = 1,
                       .stop = {{.side = -1, .stiffness = INFINITY, .restitution = e}},
                       .loads = flat_loads,
                       .user = &flat,
                       .start_position = height};
  SbDynamics s;
  Log log;
  go(&s, &m, &log);
  advance(&s, 10.0);
  double t = sqrt(2.0 * height / g), v = g * t;
  for (int i = 0; i < 40; i++) {
    const SbMotionEvent *event = nth(&log, SB_MOTION_TOUCH_STOP, i);
    ASSERT_NEAR(event->time, t, 1e-12);
    ASSERT_NEAR(-event->speed, v, 1e-10 * v);
    v *= e;
    t += 2.0 * v / g;
  }
  SbDynamicsSample sample;
  SbDynamicsEnergy energy;
  sb_dynamics_sample(&s, &sample, &energy);
  g_assert_true(sample.position == 0.0);
  g_assert_true(sample.speed == 0.0);
  ASSERT_NEAR(sample.stop_force[0], mass * g, 1e-12);
  ASSERT_NEAR(energy.stop, mass * g * height, 1e-10 * energy.stop);
  g_assert_cmpfloat(energy.closure, <, 1e-12);
  g_assert_true(sb_dynamics_at_rest(&s));
}

// Between two springy walls the speed falls by the restitution at each, whatever the stiffness.
static void test_walls(void) {
  double mass = 3.73e-3;
  for (int stiff = 4; stiff <= 9; stiff++) {
    for (int i = 0; i < 4; i++) {
      double e = (double[]){0.05, 0.3, 0.7, 0.95}[i], k = pow(10.0, stiff), v = 0.5;
      SbDynamicsModel m = {
          .mass = mass,
          .stops = 2,
          .stop = {{.position = 0.0, .side = -1, .stiffness = k, .restitution = e},
                   {.position = 0.01, .side = 1, .stiffness = k, .restitution = e}},
          .start_position = 0.005,
          .start_speed = v};
      SbDynamics s;
      Log log;
      go(&s, &m, &log);
      advance(&s, 2.0);
      for (int n = 0; n < 5; n++) {
        const SbMotionEvent *touch = nth(&log, SB_MOTION_TOUCH_STOP, n);
        if (touch == NULL) {
          break;
        }
        ASSERT_NEAR(fabs(touch->speed), v * pow(e, n), 1e-9 * v * pow(e, n));
      }
      SbDynamicsEnergy energy;
      sb_dynamics_sample(&s, NULL, &energy);
      ASSERT_NEAR(energy.stop + energy.kinetic + energy.stored, 0.0, 1e-12 * mass * v * v);
    }
  }
}

// A constant push onto a stop for 10 s: few events, no creep, the right reaction.
static void test_push(void) {
  for (int rigid = 0; rigid < 2; rigid++) {
    Flat flat = {{.force = 20.0, .level = {3.0}, .constant = true}};
    SbDynamicsModel m = {
        .mass = 3.73e-3,
        .contacts = 1,
        .contact = {{.static_ratio = 1.1,
                     .stiffness = rigid ? INFINITY : 2e4,
                     .damping = rigid ? 0.0 : 2.0}},
        .stops = 1,
        .stop = {{.position = 6.6e-3, .side = 1, .stiffness = 1e7, .restitution = 0.3}},
        .loads = flat_loads,
        .user = &flat,
        .start_position = 6.1e-3};
    SbDynamics s;
    go(&s, &m, NULL);
    advance(&s, 10.0);
    SbDynamicsSample sample;
    SbDynamicsEnergy energy;
    sb_dynamics_sample(&s, &sample, &energy);
    g_test_message("push: %ld events, %ld segments, stop force %.12g N, friction %.12g N",
                   s.counters.events, s.counters.segments, sample.stop_force[0],
                   sample.friction[0]);
    g_assert_cmpint(s.counters.events, <=, 10);
    // Force balance at rest, and the stop's own law.
    ASSERT_NEAR(sample.stop_force[0], 20.0 + sample.friction[0], 1e-9);
    ASSERT_NEAR(sample.stop_force[0], 1e7 * (sample.position - 6.6e-3), 1e-9);
    g_assert_cmpfloat(fabs(sample.friction[0]), <=, 3.3);
    g_assert_cmpfloat(energy.closure, <, 1e-9);
    // Without friction the reaction is the push.
    flat.loads.level[0] = 0.0;
    go(&s, &m, NULL);
    advance(&s, 10.0);
    sb_dynamics_sample(&s, &sample, &energy);
    g_assert_cmpint(s.counters.events, <=, 10);
    ASSERT_NEAR(sample.stop_force[0], 20.0, 1e-9);
    g_assert_cmpfloat(energy.closure, <, 1e-9);
  }
}

// A stop that is left still deflected comes back to a stem that friction holds meanwhile within
// that deflection, and bears what it must: k times the deflection. The stem is thrown onto it
// against a level that just lets it go.
static void test_stop_comes_back(void) {
  Flat flat = {{.force = 3.5, .level = {3.0}, .constant = true}};
  SbDynamicsModel m = {.mass = 1e-3,
                       .contacts = 1,
                       .contact = {{.static_ratio = 1.5, .stiffness = INFINITY}},
                       .stops = 1,
                       .stop = {{.position = 1e-3, .side = 1, .stiffness = 1e6}},
                       .loads = flat_loads,
                       .user = &flat,
                       .start_position = 1e-3};
  int left = 0;
  for (int i = 0; i < 400; i++) {
    m.start_speed = 0.1 * (i % 20 + 1);
    m.stop[0].restitution = 0.05 + 0.04 * (i / 20);
    SbDynamics s;
    Log log;
    go(&s, &m, &log);
    advance(&s, 1.0);
    SbDynamicsSample sample;
    SbDynamicsEnergy energy;
    sb_dynamics_sample(&s, &sample, &energy);
    ASSERT_NEAR(sample.stop_force[0], 1e6 * fmax(sample.position - 1e-3, 0.0), 1e-9);
    ASSERT_NEAR(energy.pressure - energy.friction - energy.stop - energy.stored - energy.kinetic,
                0.0, 1e-11 * 0.5e-3 * m.start_speed * m.start_speed);
    left += nth(&log, SB_MOTION_LEAVE_STOP, 0) != NULL && sample.position > 1e-3;
  }
  g_assert_cmpint(left, >, 5);
}

// A machine pulls the stem off a stop by stick-slip, so quick that the stop still fades while
// cycles are passed over: what it fades by is no part of each cycle.
static void test_repeat_beside_stop(void) {
  Flat flat = {{.level = {1.0}, .constant = true}};
  SbDynamicsModel m = {
      .mass = 1e-3,
      .contacts = 1,
      .contact = {{.static_ratio = 2.0, .stiffness = INFINITY}},
      .stops = 1,
      .stop = {{.position = 0.0, .side = 1, .stiffness = 1e4, .restitution = 0.02}},
      .loads = flat_loads,
      .user = &flat,
      .start_position = 1e-6,
      .drive = ramp(1e-6, -1e-2, 2e-3),
      .drive_stiffness = 1e6,
      .drive_bonded = true,
  };
  SbDynamics s;
  go(&s, &m, NULL);
  advance(&s, 0.9);
  g_assert_cmpint(s.counters.repeated, >, 500);
  g_assert_cmpfloat(closure(&s), <, 1e-10);
}

// Friction that rises over the first um/s, steeply by any other force on the stem, and falls
// beyond.
static void peaked_band(SbDynamicsBand *band, double x, size_t region, int direction, double speed,
                        const double *extra, void *user) {
  const SbDynamicsBand part[] = {
      {.high = 1e-6, .slope = {2.5e6}},
      {.low = 1e-6, .high = 1e-2, .rise = {2.5}, .slope = {-200.0}},
      {.low = 1e-2, .high = INFINITY, .rise = {0.5}},
  };
  *band = part[speed < 1e-6 ? 0 : speed < 1e-2 ? 1 : 2];
}

// A slowly rising push drags a stem up to the peak of its friction, where it takes off: by the
// numerical path as in closed form. It creeps in steps ten thousand times as long as the take-off
// takes, which therefore must not outlast its begin.
static void test_take_off(void) {
  SbDynamicsSample at[2];
  for (int numerical = 0; numerical < 2; numerical++) {
    Flat flat = {{.level = {4.0}, .constant = !numerical}};
    SbDynamicsModel m = {.mass = 6e-3,
                         .contacts = 1,
                         .contact = {{.static_ratio = 1.4, .stiffness = 5e5, .damping = 50.0}},
                         .loads = flat_loads,
                         .band = peaked_band,
                         .user = &flat,
                         .drive = ramp(0.0, 10.0, 8.0),
                         .tolerance = 3.6e-7};
    m.drive.quantity = SB_DRIVE_OF_FORCE;
    SbDynamics s;
    go(&s, &m, NULL);
    // At the peak the push is 6.5 N, and the stem creeps still.
    advance(&s, 6.49 / 8.0);
    sb_dynamics_sample(&s, &at[numerical], NULL);
    g_assert_cmpfloat(at[numerical].speed, <, 1e-6);
    advance(&s, 6.49 / 8.0 + 0.01);
    sb_dynamics_sample(&s, &at[numerical], NULL);
    g_assert_cmpint(s.counters.events, <, 20);
    g_assert_cmpfloat(closure(&s), <, 10.0 * m.tolerance);
  }
  g_test_message("%.9g and %.9g m/s at %.9g and %.9g m", at[0].speed, at[1].speed, at[0].position,
                 at[1].position);
  g_assert_cmpfloat(at[0].speed, >, 0.1);
  ASSERT_NEAR(at[1].speed / at[0].speed, 1.0, 1e-2);
}

// A stem of a fifth of a milligram breaks away late: its speed settles quicker than its time has
// digits.
static void test_light(void) {
  Flat flat = {{.level = {58.8}, .constant = true}};
  SbDynamicsModel m = {.mass = 2e-7,
                       .contacts = 1,
                       .contact = {{.static_ratio = 1.4,
                                    .stribeck_speed = 0.035,
                                    .stribeck_exponent = 1.0,
                                    .stiffness = INFINITY}},
                       .loads = flat_loads,
                       .band = peaked_band,
                       .user = &flat,
                       .drive = ramp(0.0, 1.0, 1.3e-4),
                       .drive_stiffness = 4e3};
  SbDynamics s;
  Log log;
  go(&s, &m, &log);
  const double start = 1.4 * 58.8 / 4e3 / 1.3e-4;
  advance(&s, start + 1.0);
  g_assert_nonnull(nth(&log, SB_MOTION_SLIP, 0));
  ASSERT_NEAR(nth(&log, SB_MOTION_SLIP, 0)->time, start, 1e-9 * start);
  // It creeps: the push rises by 0.52 N a second, friction by 2.5 N over a um/s.
  SbDynamicsSample sample;
  sb_dynamics_sample(&s, &sample, NULL);
  ASSERT_NEAR(sample.speed, 0.52 / 2.5e6, 0.02 * 0.52 / 2.5e6);
  g_assert_cmpfloat(closure(&s), <, 1e-6);
}

// A stem at rest on a stop whose spring turns the rounding of the position into more than a
// thousandth of the tolerance, pressed slowly by a machine, with loads that have no closed form:
// Newton's iteration ends at that rounding, so steps grow until the tolerance limits them.
// Otherwise each step is limited to a quarter of the stem's period, 286000 steps in all (valve 657
// of the campaign random-valves, seed 1).
static void test_creep(void) {
  Flat flat = {{.level = {20.0}}};
  SbDynamicsModel m = {
      .mass = 2.24e-3,
      .contacts = 1,
      .contact = {{.static_ratio = 1.1, .stiffness = 1.2e5, .damping = 1.6}},
      .stops = 1,
      .stop = {{.position = 6.98e-3, .side = 1, .stiffness = 2.57e6, .restitution = 0.57}},
      .loads = flat_loads,
      .user = &flat,
      .drive = ramp(0.0, 100.0, 6.3e-4),
      .drive_stiffness = 1863.0,
      .drive_damping = 0.2,
      .start_position = 6.9801e-3,
      .tolerance = 1e-8};
  SbDynamics s;
  SbDynamicsSample sample;
  SbDynamicsEnergy energy;
  go(&s, &m, NULL);
  advance(&s, 24.0); // the machine meets the stem at 11 s
  sb_dynamics_sample(&s, &sample, &energy);
  g_test_message("creep: %ld steps, %ld rejected, closure %.2e, at %.9g mm", s.counters.steps,
                 s.counters.rejected, energy.closure, 1e3 * sample.position);
  g_assert_cmpint(s.counters.steps, <, 2000);
  g_assert_cmpfloat(energy.closure, <, 1e-7);
}

int main(int argc, char **argv) {
  g_test_init(&argc, &argv, NULL);
  g_test_add_func("/motion/dynamics/decay", test_decay);
  g_test_add_func("/motion/dynamics/belt", test_belt);
  g_test_add_func("/motion/dynamics/stiff", test_stiff);
  g_test_add_func("/motion/dynamics/groups", test_groups);
  g_test_add_func("/motion/dynamics/group-edges", test_group_edges);
  g_test_add_func("/motion/dynamics/incline", test_incline);
  g_test_add_func("/motion/dynamics/bounce", test_bounce);
  g_test_add_func("/motion/dynamics/walls", test_walls);
  g_test_add_func("/motion/dynamics/push", test_push);
  g_test_add_func("/motion/dynamics/stop-comes-back", test_stop_comes_back);
  g_test_add_func("/motion/dynamics/repeat-beside-stop", test_repeat_beside_stop);
  g_test_add_func("/motion/dynamics/take-off", test_take_off);
  g_test_add_func("/motion/dynamics/creep", test_creep);
  g_test_add_func("/motion/dynamics/light", test_light);
  return g_test_run();
}
