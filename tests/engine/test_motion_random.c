// Random mechanisms within and beyond sense: each must run to its end with finite numbers and a
// closed balance. The seeds are fixed; a failure names its own.
#include "engine/mechanism/dynamics.h"

#include <glib.h>
#include <math.h>

enum { CASES = 200, POINTS = 50 };

typedef struct {
  double force, inner, outer, edge, end;
  bool ramp;                 // the inner level falls over the second region
  double corner, fall, rise; // of speed [m/s]; what friction loses up to it [N], and gains behind
} Valve;

static void loads(SbDynamicsLoads *out, double x, size_t region, const double *extra, void *user) {
  const Valve *v = user;
  bool falling = region == 1 && v->ramp;
  double share = region == 0 ? 1.0 : falling ? (v->end - x) / (v->end - v->edge) : 0.0;
  out->force = v->force;
  out->level[0] = v->inner * fmax(share, 0.0);
  out->level[1] = v->outer;
  out->constant = !falling;
}

// As the land's, the inner contact's share of what the speed changes stays.
static void band(SbDynamicsBand *out, double x, size_t region, int direction, double speed,
                 const double *extra, void *user) {
  const Valve *v = user;
  bool fast = speed >= v->corner;
  out->low = fast ? v->corner : 0.0;
  out->high = fast ? INFINITY : v->corner;
  for (int i = 0; i < 2; i++) {
    double level = i == 0 ? region == 0 ? v->inner : 0.0 : v->outer;
    out->slope[i] = level * (fast ? v->rise : -v->fall / v->corner);
    out->rise[i] = fast ? -level * (v->fall + v->rise * v->corner) : 0.0;
  }
}

// Evenly over the logarithm.
static double between(GRand *r, double a, double b) {
  return a * pow(b / a, g_rand_double(r));
}

static bool chance(GRand *r, double p) {
  return g_rand_double(r) < p;
}

static SbDynamicsContact random_contact(GRand *r, double mass, bool *speed_law) {
  SbDynamicsContact c = {.static_ratio = chance(r, 0.3) ? 1.0 : between(r, 1.001, 5.0),
                         .stiffness = chance(r, 0.3) ? INFINITY : between(r, 1e3, 1e6)};
  bool elastic = isfinite(c.stiffness);
  if (elastic && chance(r, 0.8)) {
    c.damping = between(r, 2e-3, 2.0) * sqrt(c.stiffness * mass);
  }
  if (chance(r, 0.3)) {
    c.dwell_gain = 0.1 * g_rand_double(r);
    c.dwell_time = 0.1;
  }
  // Almost massless with a speed law works but takes seconds: not here.
  if (chance(r, 0.3) && (!elastic || c.damping > 0.0) && mass > 1e-9) {
    c.stribeck_speed = between(r, 1e-4, 1e-1);
    c.stribeck_exponent = 0.5 + 1.5 * g_rand_double(r);
    *speed_law = true;
  }
  return c;
}

static void run_case(guint32 seed, double *worst, double *slowest) {
  GRand *r = g_rand_new_with_seed(seed);
  Valve v = {.force = -between(r, 0.1, 50.0),
             .inner = chance(r, 0.1) ? 0.0 : between(r, 0.01, 30.0),
             .outer = chance(r, 0.1) ? 0.0 : between(r, 0.01, 30.0),
             .edge = 3.3e-3,
             .ramp = chance(r, 0.3)};
  v.end = v.edge + between(r, 1e-5, 1e-3);
  if (chance(r, 0.1)) {
    v.outer = -v.force;
  }
  SbDynamicsModel m = {.mass = chance(r, 0.2) ? 1e-10 : between(r, 1e-5, 1.0),
                       .contacts = 2,
                       .stops = 2,
                       .edges = 2,
                       .edge = {v.edge, v.end},
                       .loads = loads,
                       .user = &v};
  v.ramp = v.ramp && m.mass > 1e-9; // as slow as a speed law
  if (chance(r, 0.4) && m.mass > 1e-9) {
    m.band = band;
    v.corner = between(r, 1e-4, 1.0);
    v.fall = chance(r, 0.7) ? 0.9 * g_rand_double(r) : 0.0;
    v.rise = between(r, 1e-3, 1.0);
  }
  bool speed_law = false;
  for (int i = 0; i < 2; i++) {
    m.contact[i] = random_contact(r, m.mass, &speed_law);
    m.stop[i] = (SbDynamicsStop){.position = i == 0 ? 6.6e-3 : 0.0,
                                 .side = i == 0 ? 1 : -1,
                                 .stiffness = chance(r, 0.2) ? INFINITY : between(r, 1e5, 1e9),
                                 .restitution = 0.05 + 0.9 * g_rand_double(r)};
  }
  // At rest on the lower stop under the force.
  m.start_position = v.force < 0.0 ? v.force / m.stop[1].stiffness : 0.0;
  m.drive_stiffness = between(r, 1e3, 1e6);
  m.drive_damping = chance(r, 0.3) ? 0.0 : between(r, 1e-3, 2.0) * sqrt(m.drive_stiffness * m.mass);
  double time[POINTS], value[POINTS], until, speed = between(r, speed_law ? 1e-3 : 1e-4, 10.0);
  switch (g_rand_int_range(r, 0, 4)) {
  case 0:
    // Up to the stop's place and as far on as a force strains the machine.
    m.drive = (SbDrive){.kind = SB_DRIVE_PRESS,
                        .end = fmin(8e-3, 6.6e-3 + between(r, 10.0, 200.0) / m.drive_stiffness),
                        .cycles = chance(r, 0.3) ? 2 : 1};
    m.drive.rise = m.drive.fall = m.drive.end / speed;
    until = 20e-3 / speed * m.drive.cycles;
    break;
  case 1:
    m.drive = (SbDrive){.kind = SB_DRIVE_PRESS,
                        .quantity = SB_DRIVE_OF_FORCE,
                        .end = between(r, 1.0, 100.0),
                        .rise = between(r, 1e-3, 1.0),
                        .hold = between(r, 1e-3, 1.0),
                        .fall = between(r, 1e-3, 1.0),
                        .cycles = 2,
                        .pause = 0.1};
    m.drive_damping = chance(r, 0.3) ? 0.0 : between(r, 1.0, 1e3);
    until = 4.0;
    break;
  case 2:
    m.drive = (SbDrive){.kind = SB_DRIVE_SINE,
                        .start = 3e-3,
                        .amplitude = between(r, 1e-5, 4e-3),
                        .frequency = between(r, 50.0, 500.0)};
    m.drive_bonded = chance(r, 0.5);
    m.drive.start = m.drive_bonded ? 0.0 : m.drive.start;
    until = 3.0 / m.drive.frequency;
    m.mass = fmax(m.mass, 1e-3); // resolved throughout: not with a nanosecond's oscillation
    break;
  default:
    for (int i = 0; i < POINTS; i++) {
      time[i] = i * 1e-3;
      value[i] = i == 0 ? 0.0 : 4e-3 * g_rand_double(r);
    }
    m.drive = (SbDrive){.kind = SB_DRIVE_TABLE, .time = time, .value = value, .count = POINTS};
    until = 0.06;
    break;
  }
  SbDynamics s;
  SbReport report = {0};
  gint64 start = g_get_monotonic_time();
  SbStatus status = sb_dynamics_init(&s, &m, &report);
  SbDynamicsEnergy e = {0};
  for (int i = 1; i <= 20 && status == SB_OK; i++) {
    SbDynamicsSample x;
    status = sb_dynamics_advance(&s, until * i / 20, &report);
    sb_dynamics_sample(&s, &x, &e);
    if (!isfinite(x.position) || !isfinite(x.speed) || !isfinite(x.drive_force) ||
        !isfinite(e.closure)) {
      g_error("seed %u: not a number at %g s", seed, x.time);
    }
  }
  if (status != SB_OK) {
    g_error("seed %u: %s", seed, report.text);
  }
  // Against the energy turned over: a drive that starts strained brings its own.
  double turned = e.largest + e.friction + e.viscous + e.seal + e.stop + e.machine;
  double imbalance = e.closure * e.largest / fmax(turned, 0.01);
  if (!(imbalance < 1e-6)) {
    g_error("seed %u: balance open by %g, %d bands", seed, imbalance, m.band != NULL);
  }
  *worst = fmax(*worst, imbalance);
  *slowest = fmax(*slowest, (double)(g_get_monotonic_time() - start) * 1e-3);
  g_rand_free(r);
}

static void test_random(void) {
  double worst = 0.0, slowest = 0.0;
  for (guint32 seed = 0; seed < CASES; seed++) {
    run_case(seed, &worst, &slowest);
  }
  g_test_message("%d mechanisms: worst balance %.2g, slowest %.0f ms", CASES, worst, slowest);
}

int main(int argc, char **argv) {
  g_test_init(&argc, &argv, NULL);
  g_test_add_func("/motion/random", test_random);
  return g_test_run();
}
