// The valve's cycle with full dynamics, the hard cases, convergence of the numerical path, and
// time.
#include "engine/mechanism/dynamics.h"

#include <glib.h>
#include <math.h>

enum { INNER, OUTER };

typedef struct {
  double pressure, inner, outer;
  bool numerical; // pretend that the loads vary
} Valve;

// Below the edge both seals touch; beyond it the inner one has left the land.
static void valve_loads(SbDynamicsLoads *loads, double x, size_t region, const double *extra,
                        void *user) {
  const Valve *valve = user;
  loads->force = -valve->pressure;
  loads->level[INNER] = region == 0 ? valve->inner : 0.0;
  loads->level[OUTER] = valve->outer;
  loads->constant = !valve->numerical;
}

typedef struct {
  double slip, edge_up, stop, slip_back, edge_down; // force just before each, N; NAN if none
  double slip_at, stop_at, edge_down_at;            // s
  int slips;
} Stages;

static void watch(const SbMotionEvent *event, void *user) {
  Stages *stages = user;
  if (event->kind == SB_MOTION_SLIP) {
    stages->slips++;
    if (isnan(stages->slip)) {
      stages->slip = event->drive_force;
      stages->slip_at = event->time;
    }
    if (event->sign < 0 && isnan(stages->slip_back) && !isnan(stages->stop)) {
      stages->slip_back = event->drive_force;
    }
  } else if (event->kind == SB_MOTION_EDGE && event->sign > 0 && isnan(stages->edge_up)) {
    stages->edge_up = event->drive_force;
  } else if (event->kind == SB_MOTION_EDGE && event->sign < 0 && isnan(stages->edge_down)) {
    stages->edge_down = event->drive_force;
    stages->edge_down_at = event->time;
  } else if (event->kind == SB_MOTION_TOUCH_STOP && event->index == 0 && isnan(stages->stop)) {
    stages->stop = event->drive_force;
    stages->stop_at = event->time;
  }
}

static SbDynamicsModel valve_model(Valve *valve) {
  double stroke = 6.6e-3, rest_stiffness = 1e7;
  SbDynamicsContact seal = {.static_ratio = 1.1, .stiffness = 3e4, .damping = 3.0};
  SbDynamicsModel m = {
      .mass = 3.73e-3,
      .contacts = 2,
      .contact = {seal, seal},
      .stops = 2,
      .stop = {{.position = stroke, .side = 1, .stiffness = 1e7, .restitution = 0.3},
               {.position = 14.5 / rest_stiffness,
                .side = -1,
                .stiffness = rest_stiffness,
                .restitution = 0.3}},
      .edges = 1,
      .edge = {3.3e-3},
      .loads = valve_loads,
      .user = valve,
      .drive = {.kind = SB_DRIVE_PRESS, .end = 6.95e-3, .rise = 20.85, .fall = 20.85, .cycles = 1},
      .drive_stiffness = 1e5,
      .drive_damping = 5.0,
  };
  return m;
}

static SbDynamicsCounters run(const SbDynamicsModel *m, double until, int frames, Stages *stages,
                              SbDynamicsSample *sample, SbDynamicsEnergy *energy) {
  SbDynamics s;
  SbReport report = {0};
  SbStatus status = sb_dynamics_init(&s, m, &report);
  g_assert_cmpstr(report.text, ==, "");
  if (stages != NULL) {
    *stages = (Stages){NAN, NAN, NAN, NAN, NAN, NAN, NAN, NAN, 0};
    sb_dynamics_listen(&s, watch, stages);
  }
  for (int i = 1; i <= frames; i++) {
    status = sb_dynamics_advance(&s, until * i / frames, &report);
    g_assert_cmpstr(report.text, ==, "");
    g_assert_cmpint(status, ==, SB_OK);
    sb_dynamics_sample(&s, sample, energy);
    g_assert_true(isfinite(sample->position) && isfinite(sample->speed));
    g_assert_true(isfinite(sample->drive_force) && isfinite(energy->closure));
  }
  return s.counters;
}

static void test_cycle(void) {
  Valve valve = {14.5, 5.0, 8.0, false};
  SbDynamicsModel m = valve_model(&valve);
  Stages stages;
  SbDynamicsSample sample;
  SbDynamicsEnergy energy;
  SbDynamicsCounters c = run(&m, 45.0, 400, &stages, &sample, &energy);
  g_test_message("B %.4f C %.4f D %.4f E %.4f F %.4f N; closure %.2g; events %ld segments %ld",
                 stages.slip, stages.edge_up, stages.stop, stages.slip_back, stages.edge_down,
                 energy.closure, c.events, c.segments);
  g_test_message("work %.6g friction %.6g viscous %.6g seal %.6g stop %.6g machine %.6g",
                 energy.drive, energy.friction, energy.viscous, energy.seal, energy.stop,
                 energy.machine);
  g_assert_cmpfloat(energy.closure, <, 1e-9);
  // Back at rest, the platen gone.
  g_assert_cmpfloat_with_epsilon(sample.position, 0.0, 2e-6);
  g_assert_true(sample.drive_force == 0.0);
  g_assert_cmpfloat(stages.slip, >, 14.5 + 8.0);
  g_assert_cmpfloat(stages.slip, <, 14.5 + 13.0 * 1.1 + 0.1);
}

// ---- hard cases ----

typedef struct {
  const char *name;
  double inner, outer, ratio, stop_stiffness, mass, speed;
} Hard;

static void test_hard(void) {
  static const Hard cases[] = {
      {"nominal", 5.0, 8.0, 1.1, 1e7, 3.73e-3, 1.0 / 3e3},
      {"no friction", 0.0, 0.0, 1.0, 1e7, 3.73e-3, 1.0 / 3e3},
      {"static 5 x kinetic", 2.0, 3.0, 5.0, 1e7, 3.73e-3, 1.0 / 3e3},
      {"stop 1e9 N/m", 5.0, 8.0, 1.1, 1e9, 3.73e-3, 1.0 / 3e3},
      {"mass 1e-10 kg", 5.0, 8.0, 1.1, 1e7, 1e-10, 1.0 / 3e3},
      {"mass 1e-10 kg, no friction", 0.0, 0.0, 1.0, 1e7, 1e-10, 1.0 / 3e3},
      {"1 um/s", 5.0, 8.0, 1.1, 1e7, 3.73e-3, 1e-6},
      {"10 m/s", 5.0, 8.0, 1.1, 1e7, 3.73e-3, 10.0},
      {"friction balances pressure", 0.0, 14.5, 1.0, 1e7, 3.73e-3, 1.0 / 3e3},
      {"all at once", 2.0, 3.0, 5.0, 1e9, 1e-10, 10.0},
  };
  for (size_t i = 0; i < G_N_ELEMENTS(cases); i++) {
    for (int kind = 0; kind < 4; kind++) {
      const Hard *h = &cases[i];
      Valve valve = {14.5, h->inner, h->outer, false};
      SbDynamicsModel m = valve_model(&valve);
      m.mass = h->mass;
      m.stop[0].stiffness = h->stop_stiffness;
      m.drive.end = h->speed > 1.0 ? 16.6e-3 : 7.3e-3;
      m.drive.rise = m.drive.fall = m.drive.end / h->speed;
      m.drive_damping *= sqrt(h->mass / 3.73e-3);
      for (int k = 0; k < 2; k++) {
        m.contact[k].static_ratio = h->ratio;
        m.contact[k].damping *= sqrt(h->mass / 3.73e-3);
        if (kind == 1) {
          m.contact[k].stiffness = INFINITY;
          m.contact[k].damping = 0.0;
        } else if (kind == 2) {
          m.contact[k].damping = 0.0;
        } else if (kind == 3) {
          m.contact[k].stribeck_speed = 2e-3;
          m.contact[k].stribeck_exponent = 1.0;
        }
      }
      Stages stages;
      SbDynamicsSample sample;
      SbDynamicsEnergy energy;
      SbDynamicsCounters c = run(&m, 15e-3 / h->speed, 50, &stages, &sample, &energy);
      g_test_message("%-28s %d: closure %.1e, events %ld, segments %ld, rejected %ld, x %.3g, "
                     "stop force seen %d",
                     h->name, kind, energy.closure, c.events, c.segments, c.rejected,
                     sample.position, !isnan(stages.stop));
      g_assert_cmpfloat(energy.closure, <, 1e-6);
      g_assert_false(isnan(stages.stop));
    }
  }
}

int main(int argc, char **argv) {
  g_test_init(&argc, &argv, NULL);
  g_test_add_func("/motion/valve/cycle", test_cycle);
  g_test_add_func("/motion/valve/hard", test_hard);
  return g_test_run();
}
