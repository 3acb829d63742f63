// Laws and drives of the motion: pre-sliding, dwell, Stribeck, sinusoids, chamber, refusals; and
// the numerical path against itself at a tighter tolerance.
#include "engine/mechanism/dynamics.h"
#include "tests/engine/near.h"
#include "tests/engine/ramp.h"

#include <glib.h>
#include <math.h>

typedef struct {
  double force, level;
  bool varies;
  double viscous; // friction's rise with the speed [N s/m]
} Flat;

static void flat_loads(SbDynamicsLoads *loads, double x, size_t region, const double *extra,
                       void *user) {
  const Flat *flat = user;
  loads->force = flat->force;
  loads->level[0] = flat->level;
  loads->constant = !flat->varies;
}

// Friction that rises with the speed.
static void straight_band(SbDynamicsBand *band, double x, size_t region, int direction,
                          double speed, const double *extra, void *user) {
  band->high = INFINITY;
  band->slope[0] = ((const Flat *)user)->viscous;
}

// Friction that falls and rises again: corners [m/s, N].
static const double corner[][2] = {
    {0.0, 0.0}, {1e-3, -0.5}, {2e-2, -1.5}, {0.1, -1.2}, {10.0, 5.0}};

static void bent_band(SbDynamicsBand *band, double x, size_t region, int direction, double speed,
                      const double *extra, void *user) {
  size_t i = 0;
  while (i + 2 < G_N_ELEMENTS(corner) && speed >= corner[i + 1][0]) {
    i++;
  }
  const double *a = corner[i], *b = corner[i + 1];
  // The way back rubs a little less.
  double share = direction > 0 ? 1.0 : 0.9;
  band->low = a[0];
  band->high = b[0];
  band->slope[0] = share * (b[1] - a[1]) / (b[0] - a[0]);
  band->rise[0] = share * a[1] - band->slope[0] * a[0];
}

static void advance(SbDynamics *s, double t, SbDynamicsSample *sample, SbDynamicsEnergy *energy) {
  SbReport report = {0};
  SbStatus status = sb_dynamics_advance(s, t, &report);
  g_assert_cmpstr(report.text, ==, "");
  g_assert_cmpint(status, ==, SB_OK);
  sb_dynamics_sample(s, sample, energy);
}

static void start(SbDynamics *s, const SbDynamicsModel *m) {
  SbReport report = {0};
  g_assert_cmpint(sb_dynamics_init(s, m, &report), ==, SB_OK);
  g_assert_cmpstr(report.text, ==, "");
}

typedef struct {
  double force[8], time[8];
  int count;
} Slips;

static void watch_slips(const SbMotionEvent *event, void *user) {
  Slips *slips = user;
  if (event->kind == SB_MOTION_SLIP && slips->count < 8) {
    slips->force[slips->count] = event->drive_force;
    slips->time[slips->count++] = event->time;
  }
}

// Slope A-B is machine and seal in series; the peak grows with the rest before it, and a rest on
// the way gives another, smaller peak.
static void test_presliding(void) {
  Flat flat = {.force = 0.0, .level = 10.0};
  double k = 2e4, machine = 1e5, speed = 1e-4, gain = 0.02, tau = 5.0;
  double time[] = {0.0, 40.0, 100.0, 140.0};
  double value[] = {0.0, 40.0 * speed, 40.0 * speed, 80.0 * speed};
  SbDynamicsModel m = {.mass = 1e-3,
                       .contacts = 1,
                       .contact = {{.static_ratio = 1.05,
                                    .dwell_gain = gain,
                                    .dwell_time = tau,
                                    .stiffness = k,
                                    .damping = 20.0}},
                       .loads = flat_loads,
                       .user = &flat,
                       .drive = {.kind = SB_DRIVE_TABLE, .time = time, .value = value, .count = 4},
                       .drive_stiffness = machine,
                       .drive_damping = 400.0};
  for (int rest = 0; rest < 8; rest++) {
    double dwell = rest == 0 ? 0.0 : pow(10.0, rest - 1);
    m.start_dwell = dwell;
    SbDynamics s;
    SbDynamicsSample a, b;
    SbDynamicsEnergy e;
    Slips slips = {.count = 0};
    start(&s, &m);
    sb_dynamics_listen(&s, watch_slips, &slips);
    advance(&s, 1.0, &a, NULL);
    advance(&s, 2.0, &b, NULL);
    ASSERT_NEAR((b.drive_force - a.drive_force) / speed, 1.0 / (1.0 / k + 1.0 / machine), 1e-6 * k);
    g_assert_cmpint(slips.count, ==, 0);
    advance(&s, 100.0, &a, NULL);
    // During the hold the patch rests: not a bit of creep.
    g_assert_true(a.contact[0] == SB_CONTACT_STUCK);
    double patch = a.position - a.deflection[0];
    advance(&s, 100.1, &b, NULL);
    ASSERT_NEAR(b.position - b.deflection[0], patch, 1e-17);
    advance(&s, 140.0, &b, &e);
    g_assert_cmpint(slips.count, ==, 2);
    double limit = 10.0 * (1.05 + gain * log1p((dwell + slips.time[0]) / tau));
    ASSERT_NEAR(slips.force[0], limit, 1e-6 * limit);
    limit = 10.0 * (1.05 + gain * log1p((slips.time[1] - 40.0) / tau));
    ASSERT_NEAR(slips.force[1], limit, 1e-4 * limit);
    g_assert_cmpfloat(e.closure, <, 1e-9);
  }
}

// Steady sliding follows the Stribeck curve and what rises with the speed.
static void test_stribeck(void) {
  for (int elastic = 0; elastic < 2; elastic++) {
    for (int i = 0; i < 4; i++) {
      double speed = (double[]){1e-3, 5e-3, 2e-2, 0.1}[i];
      Flat flat = {.level = 4.0, .viscous = 3.0};
      SbDynamicsModel m = {.mass = 4e-3,
                           .contacts = 1,
                           .contact = {{.static_ratio = 1.5,
                                        .stribeck_speed = 1e-2,
                                        .stribeck_exponent = 0.8,
                                        .stiffness = elastic ? 3e4 : INFINITY,
                                        .damping = elastic ? 10.0 : 0.0}},
                           .loads = flat_loads,
                           .band = straight_band,
                           .user = &flat,
                           .drive = ramp(0.0, 10.0, speed),
                           .drive_stiffness = 1e5,
                           .drive_damping = 800.0};
      SbDynamics s;
      SbDynamicsSample sample;
      SbDynamicsEnergy e;
      start(&s, &m);
      advance(&s, 1e-3 / speed + 2.0, &sample, &e);
      ASSERT_NEAR(sample.speed, speed, 1e-7 * speed);
      double friction = 4.0 * (1.0 + 0.5 * exp(-pow(speed / 1e-2, 0.8))) + 3.0 * speed;
      ASSERT_NEAR(-sample.friction[0], friction, 1e-7 * friction);
      ASSERT_NEAR(sample.drive_force, friction, 1e-6 * friction);
      g_assert_cmpfloat(e.closure, <, 1e-6);
    }
  }
}

// Bands of speed: the closed form goes through them as the numerical path does, growing swings of a
// falling friction included, and in steady sliding the friction is the law's.
static void test_bands(void) {
  for (int kind = 0; kind < 8; kind++) {
    const double speed = (double[]){2e-3, 0.05, 0.5, 5.0}[kind % 4];
    bool elastic = kind >= 4;
    const double every = speed < 0.1 ? 2e-2 : 2e-3;
    double place[2][64], force[2];
    for (int numerical = 0; numerical < 2; numerical++) {
      Flat flat = {.force = -3.0, .level = 4.0, .varies = numerical};
      SbDynamicsModel m = {.mass = 4e-3,
                           .contacts = 1,
                           .contact = {{.static_ratio = 1.2,
                                        .stiffness = elastic ? 3e4 : INFINITY,
                                        .damping = elastic ? 10.0 : 0.0}},
                           .loads = flat_loads,
                           .band = bent_band,
                           .user = &flat,
                           // A bare drive: the stem sticks and slips where friction falls.
                           .drive = ramp(0.0, 10.0, speed),
                           .drive_stiffness = 2e4,
                           .drive_damping = speed < 0.1 ? 1.0 : 20.0,
                           .rest_speed = 1e-12,
                           .tolerance = 1e-11};
      SbDynamics s;
      SbDynamicsSample sample;
      SbDynamicsEnergy e;
      start(&s, &m);
      for (int i = 0; i < 64; i++) {
        advance(&s, (i + 1) * every, &sample, &e);
        place[numerical][i] = sample.position;
      }
      g_assert_cmpfloat(e.closure, <, numerical ? 1e-8 : 1e-12);
      g_assert_true((s.counters.steps > 0) == (numerical > 0));
      if (speed > 0.1) {
        SbDynamicsBand law = {0};
        bent_band(&law, 0, 0, 1, sample.speed, NULL, NULL);
        double wanted = 4.0 + law.rise[0] + law.slope[0] * sample.speed;
        ASSERT_NEAR(-sample.friction[0], wanted, elastic ? 1e-4 : 1e-12);
      }
      force[numerical] = s.force_peak;
    }
    double worst = 0;
    for (int i = 0; i < 64; i++) {
      worst = fmax(worst, fabs(place[0][i] - place[1][i]) / fmax(place[0][i], 1e-4));
    }
    g_test_message("%g m/s%s: closed against numerical %.2g", speed, elastic ? ", elastic" : "",
                   worst);
    g_assert_cmpfloat(worst, <, 1e-6);
    ASSERT_NEAR(force[0], force[1], 1e-6 * force[0]);
  }
}

// Two contacts, the second of which ends: friction there falls along the way.
static double end_share(size_t i, double x) {
  return i == 0 ? 1.0 : exp(-x / 1e-3);
}

static void ending_loads(SbDynamicsLoads *loads, double x, size_t region, const double *extra,
                         void *user) {
  for (size_t i = 0; i < 2; i++) {
    loads->level[i] = 100.0 * end_share(i, x);
  }
}

// Friction falls by three tenths up to 5 mm/s.
static void falling_band(SbDynamicsBand *band, double x, size_t region, int direction, double speed,
                         const double *extra, void *user) {
  const double fall = 30.0, end = 5e-3;
  const bool slow = speed < end;
  band->low = slow ? 0.0 : end;
  band->high = slow ? end : INFINITY;
  for (size_t i = 0; i < 2; i++) {
    band->slope[i] = slow ? -fall / end * end_share(i, x) : 0.0;
    band->rise[i] = slow ? 0.0 : -fall * end_share(i, x);
  }
}

// Elastic contacts on a very stiff machine vibrate, by cycles that change with the place. Where
// they are too many to be stepped through they are followed by groups, and go as stepping goes
// (asked for too often to skip any).
static void test_groups(void) {
  enum { ASKS = 4000 };
  const SbDynamicsContact elastic = {.static_ratio = 1.0,
                                     .dwell_gain = 0.05,
                                     .dwell_time = 0.3,
                                     .stiffness = 8e5,
                                     .damping = 50.0};
  const double until = 0.13;
  SbDynamicsModel m = {.mass = 1.7e-3,
                       .spring_preload = 2000.0,
                       .contacts = 2,
                       .contact = {elastic, elastic},
                       .loads = ending_loads,
                       .band = falling_band,
                       .drive = ramp(0.0, 1.0, 1.2e-3),
                       .drive_stiffness = 7.5e9,
                       .drive_damping = 5e3,
                       .tolerance = 1e-8};
  SbDynamics once, often;
  SbDynamicsSample a, b;
  SbDynamicsEnergy e, f;
  start(&once, &m);
  advance(&once, until, &a, &e);
  start(&often, &m);
  for (int k = 1; k <= ASKS; k++) {
    advance(&often, until * k / ASKS, &b, &f);
  }
  g_test_message(
      "%ld of %ld segments, %ld slips in groups; place %.1e m, deflections %.1e and %.1e m "
      "apart; drive %.1e, friction %.1e, seal %.1e off; closure %.1e",
      once.counters.segments, often.counters.segments, once.counters.grouped,
      fabs(a.position - b.position), fabs(a.deflection[0] - b.deflection[0]),
      fabs(a.deflection[1] - b.deflection[1]), fabs(e.drive / f.drive - 1.0),
      fabs(e.friction / f.friction - 1.0), fabs(e.seal / f.seal - 1.0), e.closure);
  g_assert_cmpint(often.counters.grouped, ==, 0);
  g_assert_cmpint(once.counters.grouped, >, 100);
  g_assert_cmpint(4 * once.counters.segments, <, 3 * often.counters.segments);
  // The phase in the cycle is free, and a cycle takes 50 us; contacts slide from 0.104 s on.
  const double cycle = 1e-4, slides = until - 0.104;
  ASSERT_NEAR(a.position, b.position, 1.2e-3 * cycle);
  ASSERT_NEAR(a.deflection[0], b.deflection[0], 1.2e-3 * cycle);
  ASSERT_NEAR(a.deflection[1], b.deflection[1], 1.2e-3 * cycle);
  ASSERT_NEAR(e.drive / f.drive, 1.0, cycle / until);
  ASSERT_NEAR(e.friction / f.friction, 1.0, cycle / slides);
  ASSERT_NEAR(e.seal / f.seal, 1.0, cycle / slides);
  g_assert_cmpfloat(e.closure, <, 2e-7);
}

// Friction that differs with the direction: a stem pushed to and fro against it slows down as each
// way says.
static void back_loads(SbDynamicsLoads *loads, double x, size_t region, const double *extra,
                       void *user) {
  loads->level[0] = 2.0;
  loads->back[0] = 1.0;
  loads->constant = true;
}

static void test_back(void) {
  for (int way = -1; way < 2; way += 2) {
    SbDynamicsModel m = {.mass = 4e-3,
                         .contacts = 1,
                         .contact = {{.static_ratio = 1.0, .stiffness = INFINITY}},
                         .loads = back_loads,
                         .start_speed = way * 0.5};
    SbDynamics s;
    SbDynamicsSample sample;
    start(&s, &m);
    advance(&s, 1.0, &sample, NULL);
    double friction = way > 0 ? 2.0 : 3.0;
    ASSERT_NEAR(way * sample.position, 0.5 * 4e-3 * 0.25 / friction, 1e-12);
  }
}

// A bonded sinusoid drives a damped oscillator: amplitude and phase of the textbook.
static void test_sinusoid(void) {
  double mass = 5e-3, k = 800.0, c = 1.2, amplitude = 1e-3, frequency = 35.0;
  for (int force = 0; force < 2; force++) {
    Flat flat = {0};
    SbDynamicsModel m = {.mass = mass,
                         .loads = flat_loads,
                         .user = &flat,
                         .drive = {.kind = SB_DRIVE_SINE,
                                   .quantity = force ? SB_DRIVE_OF_FORCE : SB_DRIVE_OF_POSITION,
                                   .amplitude = force ? k * amplitude : amplitude,
                                   .frequency = frequency},
                         .drive_stiffness = force ? 0.0 : k,
                         .drive_damping = 0.0,
                         .spring_stiffness = force ? k : 0.0,
                         .damping = c,
                         .drive_bonded = true,
                         .tolerance = 1e-11};
    double w = 2.0 * G_PI * frequency;
    double re = k - mass * w * w, im = c * w, size = k * amplitude / hypot(re, im);
    double lag = atan2(im, re);
    SbDynamics s;
    SbDynamicsSample sample;
    SbDynamicsEnergy e;
    start(&s, &m);
    for (int i = 0; i < 20; i++) {
      double t = 0.5 + i * 1.7e-3;
      advance(&s, t, &sample, &e);
      ASSERT_NEAR(sample.position, size * sin(w * t - lag), 1e-8 * size);
      ASSERT_NEAR(sample.speed, size * w * cos(w * t - lag), 1e-8 * size * w);
    }
    g_assert_cmpfloat(e.closure, <, 1e-8);
  }
}

// Reversal every millisecond, by a measured series and by a sinusoid.
static void test_shaking(void) {
  enum { POINTS = 201 };
  double time[POINTS], value[POINTS];
  for (int i = 0; i < POINTS; i++) {
    time[i] = i * 1e-3;
    value[i] = i % 2 ? 2e-4 : 0.0;
  }
  for (int kind = 0; kind < 4; kind++) {
    Flat flat = {.force = 0.0, .level = 2.0};
    bool rigid = kind % 2;
    SbDynamicsModel m = {
        .mass = 3.73e-3,
        .contacts = 1,
        .contact = {{.static_ratio = 1.3,
                     .stiffness = rigid ? INFINITY : 3e4,
                     .damping = rigid ? 0.0 : 3.0}},
        .loads = flat_loads,
        .user = &flat,
        .drive = {.kind = SB_DRIVE_TABLE, .time = time, .value = value, .count = POINTS},
        .drive_stiffness = 1e5,
        .drive_damping = 5.0,
        .drive_bonded = true};
    if (kind >= 2) {
      m.drive = (SbDrive){.kind = SB_DRIVE_SINE, .amplitude = 1e-4, .frequency = 500.0};
    }
    SbDynamics s;
    SbDynamicsSample sample;
    SbDynamicsEnergy e;
    start(&s, &m);
    advance(&s, 0.2, &sample, &e);
    g_test_message("shaking %d: closure %.2g, events %ld, friction work %.4g J", kind, e.closure,
                   s.counters.events, e.friction);
    g_assert_cmpfloat(e.closure, <, 1e-6);
    g_assert_cmpfloat(e.friction, >, 0.0);
  }
}

// ---- chamber: an extra state ----

typedef struct {
  double area, time, other; // m2, s, N
} Chamber;

static void chamber_loads(SbDynamicsLoads *loads, double x, size_t region, const double *extra,
                          void *user) {
  const Chamber *c = user;
  loads->force = c->area * extra[0] + c->other;
}

static void chamber_rates(double *rate, double x, double v, size_t region, const double *extra,
                          void *user) {
  const Chamber *c = user;
  rate[0] = -extra[0] / c->time;
}

static void chamber_cross(size_t edge, int direction, double *extra, void *user) {
  if (edge == 0 && direction > 0) {
    extra[0] = 0.0; // vented in one step
  }
}

// A pressure that decays pushes a free mass: exact to the tolerance; then vented at an edge.
static void test_chamber(void) {
  Chamber chamber = {28.3e-6, 3e-3, 0.0};
  double p0 = 0.55e6, mass = 3.73e-3;
  SbDynamicsModel m = {.mass = mass,
                       .edges = 1,
                       .edge = {5.0e-2},
                       .extra_start = p0,
                       .extra_scale = 1e5,
                       .loads = chamber_loads,
                       .extra_rate = chamber_rates,
                       .cross = chamber_cross,
                       .user = &chamber,
                       .tolerance = 1e-11};
  SbDynamics s;
  SbDynamicsSample a;
  SbDynamicsEnergy e;
  start(&s, &m);
  double push = chamber.area * p0 / mass, tau = chamber.time, t = 4e-3, fade = exp(-t / tau);
  advance(&s, t, &a, &e);
  ASSERT_NEAR(a.extra, p0 * fade, 1e-8 * p0);
  ASSERT_NEAR(a.speed, push * tau * (1.0 - fade), 1e-8 * a.speed);
  ASSERT_NEAR(a.position, push * tau * (t - tau * (1.0 - fade)), 1e-8 * a.position);
  g_assert_cmpfloat(e.closure, <, 1e-8);
  advance(&s, 0.2, &a, &e);
  g_assert_true(a.extra == 0.0);
  g_assert_true(a.region == 1);
  g_assert_cmpfloat(e.closure, <, 1e-8);
}

// ---- seal exactly on the land edge at rest ----

static void edge_loads(SbDynamicsLoads *loads, double x, size_t region, const double *extra,
                       void *user) {
  loads->force = ((const Flat *)user)->force;
  loads->level[0] = region == 0 ? 5.0 : 0.0;
  loads->level[1] = 3.0;
  loads->constant = true;
}

static void test_edge_at_rest(void) {
  for (int elastic = 0; elastic < 2; elastic++) {
    for (int sign = -1; sign <= 1; sign++) {
      Flat flat = {.force = sign * 4.0};
      SbDynamicsContact c = {.static_ratio = 1.0,
                             .stiffness = elastic ? 1e4 : INFINITY,
                             .damping = elastic ? 5.0 : 0.0};
      SbDynamicsModel m = {.mass = 3.73e-3,
                           .contacts = 2,
                           .contact = {c, c},
                           .edges = 1,
                           .edge = {3.3e-3},
                           .loads = edge_loads,
                           .user = &flat,
                           .start_position = 3.3e-3};
      SbDynamics s;
      SbDynamicsSample a;
      SbDynamicsEnergy e;
      start(&s, &m);
      advance(&s, 5e-3, &a, &e);
      if (sign > 0) {
        // The outer seal alone (3 N) does not hold 4 N.
        g_assert_cmpfloat(a.position, >, 3.3e-3);
        g_assert_cmpuint(a.region, ==, 1);
      } else if (sign == 0) {
        g_assert_true(a.position == 3.3e-3);
        g_assert_true(a.speed == 0.0);
      } else {
        // Slides back until both hold it, at once if they are rigid.
        advance(&s, 1.0, &a, &e);
        g_assert_cmpuint(a.region, ==, 0);
        g_assert_cmpfloat(fabs(a.speed), <, 1e-12);
        g_assert_cmpfloat(a.position, >, 3.3e-3 - 2e-3);
      }
      g_assert_cmpfloat(e.closure, <, 1e-9);
    }
  }
}

// A press by hand and the return: the stem comes back if, and only if, pressure exceeds friction.
static void test_press(void) {
  for (int sticky = 0; sticky < 2; sticky++) {
    Flat flat = {.force = -14.5, .level = sticky ? 15.0 : 9.0};
    SbDynamicsModel m = {
        .mass = 3.73e-3,
        .contacts = 1,
        .contact = {{.static_ratio = 1.1, .stiffness = 3e4, .damping = 3.0}},
        .stops = 2,
        .stop = {{.position = 6.6e-3, .side = 1, .stiffness = 1e7, .restitution = 0.3},
                 {.position = 1.45e-6, .side = -1, .stiffness = 1e7, .restitution = 0.3}},
        .loads = flat_loads,
        .user = &flat,
        .drive = {.kind = SB_DRIVE_PRESS,
                  .quantity = SB_DRIVE_OF_FORCE,
                  .end = 40.0,
                  .rise = 0.2,
                  .hold = 0.5,
                  .fall = 0.2,
                  .cycles = 2,
                  .pause = 0.5},
        .drive_damping = 500.0};
    SbDynamics s;
    SbDynamicsSample a;
    SbDynamicsEnergy e;
    start(&s, &m);
    advance(&s, 0.6, &a, &e);
    g_assert_cmpfloat(a.position, >, 6.6e-3);
    ASSERT_NEAR(a.stop_force[0], 40.0 - 14.5 + a.friction[0], 1e-6);
    advance(&s, 1.39, &a, &e);
    ASSERT_NEAR(a.drive_force, 0.0, 1e-9);
    if (sticky) {
      g_assert_cmpfloat(a.position, >, 5e-3);
    } else {
      ASSERT_NEAR(a.position, 0.0, 2e-6);
    }
    advance(&s, 5.0, &a, &e);
    g_assert_true(sb_dynamics_at_rest(&s));
    g_assert_cmpfloat(e.closure, <, 1e-9);
  }
}

// Stick-slip with a Stribeck curve: half of the difference to a run at ten times the
// tolerance is an honest estimate of the error, also where break-away magnifies small differences.
// Not less than the tolerance itself: the coarser run may be right by chance.
static void test_tolerance(void) {
  Flat flat = {.force = -14.5, .level = 8.0, .viscous = 0.5};
  SbDynamicsModel m = {.mass = 3.73e-3,
                       .contacts = 1,
                       .band = straight_band,
                       .contact = {{.static_ratio = 1.3,
                                    .stribeck_speed = 5e-3,
                                    .stribeck_exponent = 1.0,
                                    .stiffness = 3e4,
                                    .damping = 3.0}},
                       .loads = flat_loads,
                       .user = &flat,
                       .drive = ramp(0.0, 1.0, 5e-3),
                       .drive_stiffness = 2e4,
                       .drive_damping = 5.0,
                       .rest_speed = 1e-12};
  double ratio[64];
  int count = 0;
  for (int kind = 0; kind < 8; kind++) {
    enum { TIGHT = 13, LOOSE = 5 };
    double at[TIGHT + 1][16];
    m.drive = ramp(0.0, 1.0, kind % 2 ? 5e-3 : 1.3e-3);
    m.contact[0].static_ratio = kind & 2 ? 1.3 : 1.8;
    m.contact[0].stiffness = kind & 4 ? INFINITY : 3e4;
    m.contact[0].damping = kind & 4 ? 0.0 : 3.0;
    for (int power = LOOSE; power <= TIGHT; power++) {
      m.tolerance = pow(10.0, -power);
      SbDynamics s;
      SbDynamicsSample a;
      SbDynamicsEnergy e;
      start(&s, &m);
      for (int i = 0; i < 16; i++) {
        advance(&s, (1.0 + 0.1 * i) * 6e-3 * m.drive.rise, &a, &e);
        at[power][i] = a.position;
      }
      g_assert_cmpfloat(e.closure, <, 1e-5 * pow(10.0, LOOSE - power + 1));
    }
    for (int power = LOOSE + 1; power < TIGHT - 1; power++) {
      double error = 0.0, estimate = 0.0;
      for (int i = 0; i < 16; i++) {
        error = fmax(error, fabs(at[power][i] - at[TIGHT][i]));
        estimate = fmax(estimate, 0.5 * fabs(at[power][i] - at[power - 1][i]));
        estimate = fmax(estimate, pow(10.0, -power) * fabs(at[power][i]));
      }
      g_test_message("%d, tolerance 1e-%d: error %.2e m, estimate %.2e m", kind, power, error,
                     estimate);
      g_assert_cmpfloat(error, <=, 3.0 * estimate);
      ratio[count++] = estimate / error;
    }
  }
  for (int i = 1; i < count; i++) {
    for (int k = i; k > 0 && ratio[k] < ratio[k - 1]; k--) {
      double swap = ratio[k];
      ratio[k] = ratio[k - 1];
      ratio[k - 1] = swap;
    }
  }
  g_test_message("estimate over error: %.3g to %.3g, median %.3g", ratio[0], ratio[count - 1],
                 ratio[count / 2]);
  g_assert_cmpfloat(ratio[count / 2], <=, 10.0);
}

static void test_refusals(void) {
  Flat flat = {.force = 0.0, .level = 1.0};
  SbDynamicsModel good = {.mass = 1e-3,
                          .contacts = 1,
                          .contact = {{.static_ratio = 1.0, .stiffness = 1e4}},
                          .stops = 1,
                          .stop = {{.side = 1, .stiffness = 1e6, .restitution = 0.5}},
                          .loads = flat_loads,
                          .user = &flat};
  SbReport report = {0};
  g_assert_cmpint(sb_dynamics_check(&good, &report), ==, SB_OK);
  for (int i = 0; i < 10; i++) {
    SbDynamicsModel bad = good;
    switch (i) {
    case 0:
      bad.mass = 0.0;
      break;
    case 1:
      bad.contact[0].static_ratio = 0.9;
      break;
    case 2:
      bad.contact[0].stiffness = -1.0;
      break;
    case 3:
      bad.stop[0].side = 0;
      break;
    case 4:
      bad.stop[0].restitution = 1.5;
      break;
    case 5:
      bad.contact[0].stribeck_speed = 1e-3; // no exponent
      break;
    case 6:
      bad.contacts = 99;
      break;
    case 7:
      bad.drive = (SbDrive){.kind = SB_DRIVE_PRESS, .rise = -1.0, .fall = 1.0, .end = 1.0};
      bad.drive_stiffness = 1e5;
      break;
    case 8:
      bad.drive = ramp(0.0, 1.0, 1.0);
      bad.drive_stiffness = INFINITY;
      break;
    default:
      bad.contact[0].static_ratio = 1.2;
      bad.contact[0].stribeck_speed = 1e-3;
      bad.contact[0].stribeck_exponent = 1.0; // elastic without damping
      break;
    }
    g_assert_cmpint(sb_dynamics_check(&bad, &report), !=, SB_OK);
    g_assert_cmpstr(report.text, !=, "");
    SbDynamics s;
    g_assert_cmpint(sb_dynamics_init(&s, &bad, NULL), !=, SB_OK);
  }
}

int main(int argc, char **argv) {
  g_test_init(&argc, &argv, NULL);
  g_test_add_func("/motion/laws/presliding", test_presliding);
  g_test_add_func("/motion/laws/stribeck", test_stribeck);
  g_test_add_func("/motion/laws/bands", test_bands);
  g_test_add_func("/motion/laws/groups", test_groups);
  g_test_add_func("/motion/laws/back", test_back);
  g_test_add_func("/motion/laws/sinusoid", test_sinusoid);
  g_test_add_func("/motion/laws/shaking", test_shaking);
  g_test_add_func("/motion/laws/chamber", test_chamber);
  g_test_add_func("/motion/laws/edge-at-rest", test_edge_at_rest);
  g_test_add_func("/motion/laws/press", test_press);
  g_test_add_func("/motion/laws/tolerance", test_tolerance);
  g_test_add_func("/motion/laws/refusals", test_refusals);
  return g_test_run();
}
