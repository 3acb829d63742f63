// The dose chamber: both readings of the thesis (docs/thesis.md) from ports, venting against its
// closed form, and the chamber as a state of the moving valve.
#include "engine/mechanism/chamber.h"
#include "engine/mechanism/dynamics.h"
#include "tests/engine/near.h"

#include <glib.h>
#include <math.h>

enum { EDGES = 2 * SB_CHAMBER_PORTS };

static const double pc = 0.55e6;

// The thesis' two readings with all ports of one area: the chamber opens to the canister where the
// inner seal leaves the land, at 3.3 mm, and the dose leaves on the return at 1 mm. Reading 1:
// vented whenever the stem is below that. Reading 2: vented on the return between a half of it and
// it, refilled through a port at rest below that.
static SbChamberModel reading_of(int reading, double area) {
  const double opens = 3.3e-3, release = 1e-3;
  SbChamberModel m = {.canister = pc, .volume = 50e-9, .stiffness = 1e7, .density = 1226.0};
  m.port[m.ports++] = (SbChamberPort){opens, INFINITY, SB_PORT_BOTH_WAYS, pc, area};
  if (reading == 1) {
    m.port[m.ports++] = (SbChamberPort){-INFINITY, release, SB_PORT_BOTH_WAYS, 0.0, area};
  } else {
    m.port[m.ports++] = (SbChamberPort){release / 2, release, SB_PORT_ON_RETURN, 0.0, area};
    m.port[m.ports++] = (SbChamberPort){-INFINITY, release / 2, SB_PORT_BOTH_WAYS, pc, area};
  }
  SbReport report = {0};
  g_assert_cmpint(sb_chamber_check(&m, &report), ==, SB_OK);
  return m;
}

// Where these ports open or close, increasing.
static size_t edges_of(int reading, double edge[EDGES]) {
  size_t n = 0;
  if (reading == 2) {
    edge[n++] = 0.5e-3;
  }
  edge[n++] = 1e-3;
  edge[n++] = 3.3e-3;
  return n;
}

// Differences over the seals, canister side less outside; a seal off the land has none.
static void differences(double pressure, bool inner_touches, double *inner, double *outer) {
  *inner = inner_touches ? pc - pressure : 0.0;
  *outer = pressure;
}

// Walks a stem through a cycle with ports that act at once; differences at each stage of the table.
static void test_readings(void) {
  for (int reading = 1; reading <= 2; reading++) {
    SbChamberModel m = reading_of(reading, INFINITY);
    double edges[EDGES], inner, outer, p = reading == 1 ? 0.0 : pc;
    size_t n = edges_of(reading, edges);
    SbDoseChamber c;
    sb_chamber_start(&c, &m, 0.0, &p);
    // In-stroke: A-C, then C-F.
    for (size_t i = 0; i < n; i++) {
      differences(p, true, &inner, &outer);
      ASSERT_NEAR(inner, reading == 1 ? pc : 0.0, 1e-6);
      ASSERT_NEAR(outer, reading == 1 ? 0.0 : pc, 1e-6);
      sb_chamber_cross(&c, edges[i], 1, &p);
    }
    g_assert_true(c.open[0] && !c.open[1]);
    differences(p, false, &inner, &outer);
    g_assert_true(inner == 0.0 && outer == pc);
    // Return: F to release, then after release.
    sb_chamber_cross(&c, 3.3e-3, -1, &p);
    g_assert_true(!c.open[0] && !c.open[1]);
    differences(p, true, &inner, &outer);
    g_assert_true(inner == 0.0 && outer == pc);
    sb_chamber_cross(&c, 1.0e-3, -1, &p);
    g_assert_true(!c.open[0] && c.open[1]);
    differences(p, true, &inner, &outer);
    g_assert_true(inner == pc && outer == 0.0);
    if (reading == 2) {
      sb_chamber_cross(&c, 0.5e-3, -1, &p);
      g_assert_true(p == pc); // refilled at rest
    }
  }
}

// Orifice outflow: the root of the pressure falls linearly in time.
static void test_vent(void) {
  double area = 1e-8;
  SbChamberModel m = reading_of(1, area);
  SbDoseChamber c;
  double p = pc, t = 0.0, h = 1e-6;
  sb_chamber_start(&c, &m, 0.0, &p);
  double slope = 0.5 * m.stiffness / m.volume * area * sqrt(2.0 / m.density);
  while (p > 0.01 * pc) {
    // Classical Runge-Kutta, independent of the engine's integrators.
    double k1 = sb_chamber_rate(&c, p), k2 = sb_chamber_rate(&c, p + 0.5 * h * k1);
    double k3 = sb_chamber_rate(&c, p + 0.5 * h * k2), k4 = sb_chamber_rate(&c, p + h * k3);
    p += h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
    t += h;
    ASSERT_NEAR(sqrt(p), sqrt(pc) - slope * t, 1e-9 * sqrt(pc));
  }
  g_assert_false(sb_chamber_settled(&c, p));
  g_assert_true(sb_chamber_settled(&c, 0.0));
}

// ---- in the valve ----

typedef struct {
  SbChamberModel model;
  SbDoseChamber chamber;
  double edge[EDGES];
  size_t edges, land;
  double lowest, highest; // chamber pressure seen
} Valve;

static void loads(SbDynamicsLoads *out, double x, size_t region, const double *extra, void *user) {
  Valve *v = user;
  double inner, outer;
  bool touches = region <= v->land;
  differences(extra[0], touches, &inner, &outer);
  out->force = -14.5; // on equal bores whatever the chamber holds
  out->level[0] = touches ? 5.0 + 3.0 * inner / pc : 0.0;
  out->level[1] = 5.0 + 3.0 * outer / pc;
  out->constant = sb_chamber_settled(&v->chamber, extra[0]);
  v->lowest = fmin(v->lowest, extra[0]);
  v->highest = fmax(v->highest, extra[0]);
}

static void rates(double *rate, double x, double speed, size_t region, const double *extra,
                  void *user) {
  rate[0] = sb_chamber_rate(&((Valve *)user)->chamber, extra[0]);
}

static void crossed(size_t edge, int direction, double *extra, void *user) {
  Valve *v = user;
  sb_chamber_cross(&v->chamber, v->edge[edge], direction, extra);
}

static void test_valve(void) {
  for (int reading = 1; reading <= 2; reading++) {
    for (int at_once = 0; at_once < 2; at_once++) {
      Valve v = {.lowest = INFINITY, .highest = -INFINITY};
      SbReport report = {0};
      double start = reading == 1 ? 0.0 : pc;
      v.model = reading_of(reading, at_once ? INFINITY : 8e-9);
      v.edges = edges_of(reading, v.edge);
      v.land = v.edges - 1;
      sb_chamber_start(&v.chamber, &v.model, 0.0, &start);
      SbDynamicsContact seal = {.static_ratio = 1.1, .stiffness = 3e4, .damping = 3.0};
      SbDynamicsModel m = {
          .mass = 3.73e-3,
          .contacts = 2,
          .contact = {seal, seal},
          .stops = 2,
          .stop = {{.position = 6.6e-3, .side = 1, .stiffness = 1e7, .restitution = 0.3},
                   {.position = 1.45e-6, .side = -1, .stiffness = 1e7, .restitution = 0.3}},
          .extra_start = start,
          .extra_scale = 1e5,
          .edges = v.edges,
          .loads = loads,
          .extra_rate = rates,
          .cross = crossed,
          .user = &v,
          .drive =
              {.kind = SB_DRIVE_PRESS, .end = 6.95e-3, .rise = 0.695, .fall = 0.695, .cycles = 1},
          .drive_stiffness = 1e5,
          .drive_damping = 5.0};
      for (size_t i = 0; i < v.edges; i++) {
        m.edge[i] = v.edge[i];
      }
      SbDynamics s;
      SbDynamicsSample sample;
      SbDynamicsEnergy e;
      g_assert_cmpint(sb_dynamics_init(&s, &m, &report), ==, SB_OK);
      double in_force = 0.0, open_pressure = 0.0;
      for (int i = 1; i <= 200; i++) {
        g_assert_cmpint(sb_dynamics_advance(&s, i * 1e-2, &report), ==, SB_OK);
        sb_dynamics_sample(&s, &sample, &e);
        g_assert_cmpfloat(sample.extra, >=, -1.0);
        g_assert_cmpfloat(sample.extra, <=, pc + 1.0);
        if (i == 30) {
          in_force = sample.drive_force;
        }
        if (i == 65) {
          open_pressure = sample.extra;
        }
      }
      ASSERT_NEAR(open_pressure, pc, 1e-3 * pc);
      ASSERT_NEAR(sample.position, 0.0, 1e-5);
      ASSERT_NEAR(sample.extra, start, 1e-3 * pc);
      g_assert_cmpfloat(v.lowest, <, 1.0);
      g_assert_cmpfloat(e.closure, <, 1e-6);
      g_assert_cmpint(s.counters.steps, <, 5000);
      g_test_message("reading %d, %s: force at 3 mm %.2f N, closure %.1e, events %ld, steps %ld",
                     reading, at_once ? "at once" : "orifices", in_force, e.closure,
                     s.counters.events, s.counters.steps);
    }
  }
}

static void test_volume(void) {
  // The same solid of revolution by adding up slices: clearance, recess, half grooves, half rings
  // as half tori about their own mean radius.
  SbDoseGeometry g = {.bore = 6e-3,
                      .land = 5.8e-3,
                      .floor = 3.28e-3,
                      .spacing = 6.2e-3,
                      .groove = 2e-3,
                      .recess_depth = 0.85e-3,
                      .recess_length = 2.9e-3,
                      .rings = {{1.61e-3, 2.84e-3}, {1.5e-3, 2.84e-3}}};
  double sum = 0.0, h = g.spacing / 62000.0;
  for (int i = 0; i < 62000; i++) {
    double x = (i + 0.5) * h, inner = g.land;
    if (x < 0.5 * g.groove || x > g.spacing - 0.5 * g.groove) {
      inner = g.floor;
    } else if (fabs(x - 0.5 * g.spacing) < 0.5 * g.recess_length) {
      inner = g.land - 2.0 * g.recess_depth;
    }
    sum += G_PI / 4.0 * (g.bore * g.bore - inner * inner) * h;
    for (int ring = 0; ring < 2; ring++) {
      double d = g.rings[ring].section, from = ring == 0 ? x : g.spacing - x;
      double half = from < 0.5 * d ? sqrt(0.25 * d * d - from * from) : 0.0;
      sum -= G_PI * (g.rings[ring].inner + d) * 2.0 * half * h;
    }
  }
  ASSERT_NEAR(sb_chamber_metered_volume(&g), sum, 1e-5 * sum);
  SbDoseSupply supply = {.volume = 50e-9, .density = 1200, .liquid = 10e-6};
  g_assert_cmpint(sb_chamber_doses(&supply), ==, 200);
  supply.residue = 1e-6;
  g_assert_cmpint(sb_chamber_doses(&supply), ==, 180);
  supply.volume = 0;
  g_assert_cmpint(sb_chamber_doses(&supply), ==, 0);
  // A port needs a stretch, an area and a pressure; the chamber a volume.
  SbReport report = {0};
  SbChamberModel bad = reading_of(1, 1e-9);
  bad.port[1].high = bad.port[1].low = 1e-3;
  g_assert_cmpint(sb_chamber_check(&bad, &report), ==, SB_ERROR_RANGE);
  bad = reading_of(1, 1e-9);
  bad.port[0].area = 0.0;
  g_assert_cmpint(sb_chamber_check(&bad, &report), ==, SB_ERROR_RANGE);
  bad = reading_of(1, 1e-9);
  bad.volume = 0.0;
  g_assert_cmpint(sb_chamber_check(&bad, &report), ==, SB_ERROR_RANGE);
}

// A can's life: liquid and vapour at saturation share a fixed room, and doses take liquid; followed
// dose by dose until no liquid is left. The chamber that was empty gives its first dose with the
// second actuation.
static void test_supply(void) {
  const SbDoseSupply supply = {
      .volume = 58e-9, .density = 1225, .vapour = 27.8, .liquid = 10.01e-6};
  const double room = 14e-6, dose = 58e-9 * 1225;
  double mass = 1225 * 10.01e-6 + 27.8 * (room - 10.01e-6);
  long n = 1;
  for (double liquid = 1; liquid > 0; n++) {
    liquid = (mass - 27.8 * room) / (1225 - 27.8); // before actuation n
    const double gives = sb_chamber_dose(&supply, n);
    if (liquid * (1225 - 27.8) >= dose) {
      ASSERT_NEAR(gives, dose, 1e-9 * dose);
    } else {
      ASSERT_NEAR(gives, fmax(liquid, 0) * (1225 - 27.8), 1e-6 * dose);
      g_assert_cmpint(sb_chamber_doses(&supply), ==, liquid > 0 ? n - 1 : n - 2);
    }
    mass -= gives;
  }
  g_assert_cmpfloat(sb_chamber_dose(&supply, n), ==, 0);
  g_assert_cmpfloat(sb_chamber_dose(&supply, n - 2), >, 0);
  SbDoseSupply empty = supply;
  empty.empty = true;
  g_assert_cmpfloat(sb_chamber_dose(&empty, 1), ==, 0);
  for (long k = 2; k < n + 2; k++) {
    g_assert_cmpfloat(sb_chamber_dose(&empty, k), ==, sb_chamber_dose(&supply, k - 1));
  }
  // As long as the jet of a full stream takes.
  ASSERT_NEAR(sb_chamber_filling(58e-9, 1e-6, 0.55e6, 1225), 58e-9 / (1e-6 * 29.966), 1e-6);
  g_assert_true(isnan(sb_chamber_filling(58e-9, 1e-6, -1, 1225)));
  // What a vented chamber keeps: all, half of the liquid under vapour, vapour alone, vapour of a
  // third of the density, that at ambient pressure.
  const SbDoseSupply vented = {
      .volume = 58e-9, .density = 1225, .vapour = 28, .gas = 4.2, .pressure = 0.57e6};
  const double drains = 58e-9 / (1e-7 * 29.966);
  const double third = drains + log(3) * 58e-9 / (0.63e-7 * sqrt(0.57e6 / 28));
  const double kept[][2] = {{0, 1225},    {drains / 2, (1225 + 28) / 2.0},
                            {drains, 28}, {third, 28 / 3.0},
                            {1, 4.2},     {INFINITY, 4.2}};
  for (size_t i = 0; i < G_N_ELEMENTS(kept); i++) {
    assert_close(sb_chamber_remaining(&vented, 1e-7, 0.55e6, kept[i][0]), 58e-9 * kept[i][1], 1e-4);
  }
}

int main(int argc, char **argv) {
  g_test_init(&argc, &argv, NULL);
  g_test_add_func("/motion/chamber/readings", test_readings);
  g_test_add_func("/motion/chamber/vent", test_vent);
  g_test_add_func("/motion/chamber/valve", test_valve);
  g_test_add_func("/motion/chamber/volume", test_volume);
  g_test_add_func("/motion/chamber/supply", test_supply);
  return g_test_run();
}
