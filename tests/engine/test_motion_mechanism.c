// Constrained bodies stepped in all their coordinates: a slider-crank against its scalar equation
// of motion, and the thesis' cycle against the reduced form.
#include "engine/mechanism/bodies.h"
#include "engine/mechanism/dynamics.h"
#include "engine/valve/model/model.h"
#include "engine/valve/sealbench.h"
#include "tests/engine/assembly_step.h"

#include <glib.h>
#include <gsl/gsl_errno.h>
#include <gsl/gsl_odeiv2.h>
#include <limits.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double x_axis[3] = {1.0, 0.0, 0.0}, z_axis[3] = {0.0, 0.0, 1.0};

// Power of the applied forces per 1 m/s of the tangent's motion [N].
static double generalised_force(const SbAssembly *a, const SbAssemblyTangent *t) {
  double sum = 0.0;
  for (size_t b = 0; b < a->bodies; b++) {
    for (int k = 0; k < 3; k++) {
      sum += a->body[b].force[k] * t->velocity[b][k] + a->body[b].torque[k] * t->spin[b][k];
    }
  }
  return sum;
}

// ---- slider-crank ----

static const double radius = 0.04, length = 0.15, gravity = 9.81;
static const double crank_mass = 0.3, rod_mass = 0.2, slider_mass = 0.5;
static const double crank_inertia = 9e-5, rod_inertia = 4e-4;
static const double spring = 400.0, spring_rest = 0.12; // on the slider

enum { CRANK, ROD, SLIDER };

// Everything the crank's angle decides, and its derivatives by it.
typedef struct {
  double phi, slider;         // rod's angle below the x axis, slider's place
  double slider1, mass, half; // ds/dq, the mass M that q sees, dM/dq / 2
  double force;               // generalised, of weight and spring
} Crank;

// M q'' + M'/2 q'^2 = Q, written out by hand from the closed loop r sin q = l sin phi.
static Crank crank_at(double q) {
  double phi = asin(radius * sin(q) / length);
  double phi1 = radius * cos(q) / (length * cos(phi));
  double phi2 = (-radius * sin(q) + length * sin(phi) * phi1 * phi1) / (length * cos(phi));
  double s1 = -radius * sin(q) - length * sin(phi) * phi1;
  double s2 = -radius * cos(q) - length * (cos(phi) * phi1 * phi1 + sin(phi) * phi2);
  double x1 = -radius * sin(q) - 0.5 * length * sin(phi) * phi1;
  double x2 = -radius * cos(q) - 0.5 * length * (cos(phi) * phi1 * phi1 + sin(phi) * phi2);
  double y1 = 0.5 * radius * cos(q), y2 = -0.5 * radius * sin(q);
  double slider = radius * cos(q) + length * cos(phi);
  return (Crank){
      .phi = phi,
      .slider = slider,
      .slider1 = s1,
      .mass = crank_inertia + 0.25 * crank_mass * radius * radius + rod_mass * (x1 * x1 + y1 * y1) +
              rod_inertia * phi1 * phi1 + slider_mass * s1 * s1,
      .half = rod_mass * (x1 * x2 + y1 * y2) + rod_inertia * phi1 * phi2 + slider_mass * s1 * s2,
      .force = -gravity * 0.5 * (crank_mass + rod_mass) * radius * cos(q) -
               spring * (slider - spring_rest) * s1,
  };
}

static int crank_rates(double t, const double *y, double *dy, void *user) {
  Crank c = crank_at(y[0]);
  dy[0] = y[1];
  dy[1] = (c.force - c.half * y[1] * y[1]) / c.mass;
  return GSL_SUCCESS;
}

// Crank on a pin, rod on a ball and a sleeve, slider in a guide: 5 + 3 + 4 + 5 conditions. With
// `flat` the ball and the sleeve are pins as well: three conditions too many.
static void slider_crank(SbAssembly *a, double q, double speed, bool flat) {
  SbReport report = {0};
  Crank c = crank_at(q);
  const double small[3] = {1e-4, 1e-4, 1e-4}, origin[3] = {0};
  double crank[3] = {1e-5, crank_inertia, crank_inertia};
  double rod[3] = {1e-5, rod_inertia, rod_inertia};
  double pin[3] = {radius * cos(q), radius * sin(q), 0.0}, end[3] = {c.slider, 0.0, 0.0};
  double crank_at_[3] = {0.5 * pin[0], 0.5 * pin[1], 0.0};
  double rod_at[3] = {0.5 * (pin[0] + end[0]), 0.5 * pin[1], 0.0};
  sb_assembly_start(a);
  g_assert_cmpint(sb_assembly_add(a, "crank", crank_mass, crank, crank_at_, &report), ==, SB_OK);
  g_assert_cmpint(sb_assembly_add(a, "rod", rod_mass, rod, rod_at, &report), ==, SB_OK);
  g_assert_cmpint(sb_assembly_add(a, "slider", slider_mass, small, end, &report), ==, SB_OK);
  a->body[CRANK].orientation[0] = cos(0.5 * q);
  a->body[CRANK].orientation[3] = sin(0.5 * q);
  a->body[ROD].orientation[0] = cos(0.5 * c.phi);
  a->body[ROD].orientation[3] = -sin(0.5 * c.phi);
  g_assert_cmpint(sb_assembly_join(a, SB_JOINT_REVOLUTE, CRANK, SB_GROUND, origin, z_axis, &report),
                  ==, SB_OK);
  g_assert_cmpint(sb_assembly_join(a, flat ? SB_JOINT_REVOLUTE : SB_JOINT_SPHERICAL, ROD, CRANK,
                                   pin, z_axis, &report),
                  ==, SB_OK);
  g_assert_cmpint(sb_assembly_join(a, flat ? SB_JOINT_REVOLUTE : SB_JOINT_CYLINDRICAL, ROD, SLIDER,
                                   end, z_axis, &report),
                  ==, SB_OK);
  g_assert_cmpint(
      sb_assembly_join(a, SB_JOINT_TRANSLATIONAL, SLIDER, SB_GROUND, end, x_axis, &report), ==,
      SB_OK);
  g_assert_cmpstr(report.text, ==, "");
  // Speeds of the motion that the joints leave.
  SbAssemblyTangent t;
  if (!flat) {
    g_assert_cmpint(sb_assembly_tangent(&t, a, SLIDER, x_axis, &assembly_work, &report), ==, SB_OK);
    g_assert_cmpint(sb_assembly_slide(a, &t, 0.0, c.slider1 * speed, NULL, &assembly_work, &report),
                    ==, SB_OK);
  }
}

static void crank_loads(SbAssembly *a, double time, void *user) {
  for (size_t b = CRANK; b <= SLIDER; b++) {
    a->body[b].force[1] = -gravity * a->body[b].mass;
  }
  a->body[SLIDER].force[0] = -spring * (a->body[SLIDER].position[0] - spring_rest);
}

// Violation of the loop and of the plane, from positions and orientations alone [m].
static double drift(const SbAssembly *a) {
  const SbBody *crank = &a->body[CRANK], *rod = &a->body[ROD], *slider = &a->body[SLIDER];
  double q = 2.0 * atan2(crank->orientation[3], crank->orientation[0]);
  double p = 2.0 * atan2(rod->orientation[3], rod->orientation[0]);
  double gap[] = {crank->position[0] - 0.5 * radius * cos(q),
                  crank->position[1] - 0.5 * radius * sin(q),
                  rod->position[0] - 0.5 * length * cos(p) - radius * cos(q),
                  rod->position[1] - 0.5 * length * sin(p) - radius * sin(q),
                  slider->position[0] - rod->position[0] - 0.5 * length * cos(p),
                  slider->position[1],
                  rod->position[2],
                  length * rod->orientation[1],
                  length * slider->orientation[3]};
  double worst = 0.0;
  for (size_t i = 0; i < G_N_ELEMENTS(gap); i++) {
    worst = fmax(worst, fabs(gap[i]));
  }
  return worst;
}

// Order 4 and 1e-9 over some turns, the loop closed to rounding throughout.
static void test_slider_crank(void) {
  const double until = 0.5, start = 0.3, speed = 25.0;
  double y[2] = {start, speed}, t = 0.0, previous = 0.0, error = 0.0, open = 0.0;
  gsl_odeiv2_system system = {crank_rates, NULL, 2, NULL};
  gsl_odeiv2_driver *driver =
      gsl_odeiv2_driver_alloc_y_new(&system, gsl_odeiv2_step_rk8pd, 1e-5, 1e-13, 1e-13);
  g_assert_cmpint(gsl_odeiv2_driver_apply(driver, &t, until, y), ==, GSL_SUCCESS);
  gsl_odeiv2_driver_free(driver);
  g_assert_cmpfloat(y[0], >, 2.0 * G_PI); // went all the way round
  Crank exact = crank_at(y[0]);
  for (int n = 1000; n <= 4000; n *= 2) {
    SbAssembly a;
    SbReport report = {0};
    slider_crank(&a, start, speed, false);
    for (int i = 0; i < n; i++) {
      g_assert_cmpint(assembly_step(&a, i * until / n, until / n, crank_loads, NULL, &report), ==,
                      SB_OK);
      g_assert_cmpstr(report.text, ==, "");
      open = fmax(open, drift(&a));
    }
    const SbBody *crank = &a.body[CRANK];
    double q = 2.0 * atan2(crank->orientation[3], crank->orientation[0]);
    error = fmax(fabs(remainder(q - y[0], 2.0 * G_PI)), fabs(crank->spin[2] / y[1] - 1.0));
    error = fmax(error, fabs(a.body[SLIDER].position[0] - exact.slider) / exact.slider);
    if (previous > 0.0) {
      double order = log2(previous / error);
      g_test_message("slider-crank: %d steps, error %.2e, order %.2f, joints open by %.1e m", n,
                     error, order, open);
      g_assert_cmpfloat(order, >, 3.5);
    }
    previous = error;
  }
  g_assert_cmpfloat(error, <, 1e-9);
  g_assert_cmpfloat(open, <, 1e-15);
}

// The null vector's mass and force are those of the scalar equation, wherever the crank stands, and
// travel along it closes the loop.
static void test_tangent(void) {
  SbAssembly a;
  SbAssemblyTangent t;
  SbReport report = {0};
  slider_crank(&a, 0.4, 0.0, false);
  g_assert_cmpint(sb_assembly_tangent(&t, &a, SLIDER, x_axis, &assembly_work, &report), ==, SB_OK);
  for (double q = 0.4; q < 2.8; q += 0.1) {
    Crank c = crank_at(q);
    double error;
    g_assert_cmpint(sb_assembly_slide(&a, &t, c.slider - a.body[SLIDER].position[0], 1.5, &error,
                                      &assembly_work, &report),
                    ==, SB_OK);
    g_assert_cmpfloat(drift(&a), <, 1e-15);
    double now = 2.0 * atan2(a.body[CRANK].orientation[3], a.body[CRANK].orientation[0]);
    g_assert_cmpfloat_with_epsilon(now, q, 1e-12);
    g_assert_cmpfloat_with_epsilon(a.body[CRANK].spin[2] * c.slider1, 1.5, 1e-12);
    double mass = c.mass / (c.slider1 * c.slider1);
    g_assert_cmpfloat_with_epsilon(t.mass / mass, 1.0, 1e-11);
    sb_assembly_clear_forces(&a);
    crank_loads(&a, 0.0, NULL);
    double force = c.force / c.slider1;
    g_assert_cmpfloat_with_epsilon(generalised_force(&a, &t), force,
                                   1e-11 * fmax(10.0, fabs(force)));
    // The multipliers' system accelerates the slider as mass and force say.
    SbAssemblyForces f;
    g_assert_cmpint(sb_assembly_forces(&f, &a, &assembly_work, &report), ==, SB_OK);
    double speed = 1.5 / c.slider1, spin_rate = (c.force - c.half * speed * speed) / c.mass;
    g_assert_cmpfloat_with_epsilon(f.spin_rate[CRANK][2] / spin_rate, 1.0, 1e-9);
  }
  // Past the dead centre there is nowhere to go.
  g_assert_cmpint(sb_assembly_slide(&a, &t, -1.0, 0.0, NULL, &assembly_work, &report), !=, SB_OK);
}

// Gruebler's count decides: pins all round repeat three conditions, a missing guide leaves five too
// many freedoms.
static void test_refused(void) {
  SbAssembly a;
  SbMobility m;
  SbAssemblyTangent t;
  SbReport report = {0};
  slider_crank(&a, 0.3, 0.0, false);
  g_assert_cmpint(sb_assembly_mobility(&m, &a, 1, &assembly_work, &report), ==, SB_OK);
  g_assert_cmpint(m.gruebler, ==, 1);
  g_assert_cmpint(m.constraints, ==, 17);
  g_assert_cmpint(sb_assembly_tangent(&t, &a, CRANK, z_axis, &assembly_work, &report), ==,
                  SB_ERROR_INFEASIBLE);
  g_assert_nonnull(strstr(report.text, "'crank' does not move along the axis"));
  a.joints--;
  g_assert_cmpint(sb_assembly_tangent(&t, &a, SLIDER, x_axis, &assembly_work, &report), ==,
                  SB_ERROR_INFEASIBLE);
  g_assert_nonnull(strstr(report.text, "4 parts, 12 constraints, 6 degrees of freedom"));
  g_assert_nonnull(strstr(report.text, "under-constrained: 1 expected"));
  slider_crank(&a, 0.3, 0.0, true);
  g_assert_cmpint(sb_assembly_tangent(&t, &a, SLIDER, x_axis, &assembly_work, &report), ==,
                  SB_ERROR_INFEASIBLE);
  g_assert_nonnull(strstr(report.text, "over-constrained: 3 conditions are repeated"));
}

// ---- the thesis' cycle ----

static long count = LONG_MAX, first; // segments of motion that are looked at

static void valve_loads(SbDynamicsLoads *loads, double x, size_t region, const double *extra,
                        void *user) {
  *loads =
      (SbDynamicsLoads){.force = -14.5, .level = {region == 0 ? 5.0 : 0.0, 8.0}, .constant = true};
}

// What acts on the parts, each from its own place and speed, in one mode of the reduced form.
typedef struct {
  const SbDynamics *mode;
  double block, bottom; // places of these parts with the stem at 0 [m]
} Loads;

static void part_loads(SbAssembly *a, double time, void *user) {
  const Loads *l = user;
  const SbDynamics *s = l->mode;
  const SbDynamicsModel *m = s->model;
  SbBody *b = a->body;
  double drive = 0.0, stop = 0.0;
  if (s->wall[SB_DYNAMICS_PLATEN].on) {
    double y = s->piece.value + s->piece.rate * (time - s->piece.at);
    drive = m->drive_stiffness * (y - (b[SB_VALVE_BLOCK].position[0] - l->block)) +
            m->drive_damping * (s->piece.rate - b[SB_VALVE_BLOCK].velocity[0]);
  }
  if (s->wall[0].on) {
    double into = b[SB_VALVE_STEM_BOTTOM].position[0] - l->bottom - m->stop[0].position;
    stop = -m->stop[0].stiffness * into - s->wall[0].damping * b[SB_VALVE_STEM_BOTTOM].velocity[0];
  }
  double back = 0.0;
  const int seal[2] = {SB_VALVE_INNER_SEAL, SB_VALVE_OUTER_SEAL};
  for (int i = 0; i < 2; i++) {
    double friction = s->state[i] == SB_CONTACT_SLIP ? -s->sign[i] * s->loads.level[i] : 0.0;
    b[seal[i]].force[0] = friction;
    back -= friction;
  }
  b[SB_VALVE_BLOCK].force[0] = drive;
  b[SB_VALVE_STEM_TOP].force[0] = -14.5;
  b[SB_VALVE_STEM_BOTTOM].force[0] = stop;
  b[SB_VALVE_HOUSING].force[0] = back + 14.5 - stop;
}

// Parts that slide as one keep their tangent: it is not factored again, and is that found anew
// there.
static void test_as_one(void) {
  SbParams params;
  SbModel valve;
  SbAssembly a;
  SbAssemblyTangent t, anew;
  SbReport report = {0};
  sb_params_init(&params);
  g_assert_cmpint(sb_model_compile(&valve, &params, NULL, NULL), ==, SB_OK);
  g_assert_cmpint(sb_assembly_valve(&a, &valve.parts, &report), ==, SB_OK);
  g_assert_cmpint(
      sb_assembly_tangent(&t, &a, SB_VALVE_STEM_CENTRE, x_axis, &assembly_work, &report), ==,
      SB_OK);
  double error = 1.0, worst = 0.0;
  int factored = 0;
  for (int i = 0; i < 1000; i++) {
    assembly_work.matrix[0] = 123.0;
    SbStatus status =
        sb_assembly_slide(&a, &t, i % 2 == 0 ? 6e-6 : -4e-6, 0.1, &error, &assembly_work, &report);
    g_assert_cmpint(status, ==, SB_OK);
    factored += assembly_work.matrix[0] != 123.0;
    worst = fmax(worst, error);
  }
  g_test_message("%d of 1000 factored anew, joints open by %.1e m", factored, worst);
  g_assert_cmpint(factored, <, 50); // once rounding has added up
  g_assert_cmpfloat(worst, <, 5e-15);
  g_assert_cmpfloat_with_epsilon(a.body[SB_VALVE_STEM_CENTRE].position[0], 1e-3, 1e-15);
  g_assert_cmpfloat_with_epsilon(a.body[SB_VALVE_STEM_TOP].velocity[0], 0.1, 1e-15);
  g_assert_cmpint(
      sb_assembly_tangent(&anew, &a, SB_VALVE_STEM_CENTRE, x_axis, &assembly_work, &report), ==,
      SB_OK);
  g_assert_cmpfloat_with_epsilon(anew.mass / t.mass, 1.0, 1e-13);
}

// From event to event of the reduced form, stick-slip and all. The bodies go on from where they
// were, in all coordinates with the multipliers' accelerations at every stage; the reduced form
// only tells which contact slides. Every 40th segment, from the reduced state; with -m slow all, or
// those that the arguments name: test-engine-motion-mechanism -m slow [COUNT FIRST].
static void test_cycle(void) {
  const int every = g_test_slow() ? 1 : 40;
  SbParams params;
  SbModel valve;
  SbAssembly a;
  SbAssemblyTangent t;
  SbReport report = {0};
  sb_params_init(&params);
  g_assert_cmpint(sb_model_compile(&valve, &params, NULL, NULL), ==, SB_OK);
  g_assert_cmpint(sb_assembly_valve(&a, &valve.parts, &report), ==, SB_OK);
  g_assert_cmpint(
      sb_assembly_tangent(&t, &a, SB_VALVE_STEM_CENTRE, x_axis, &assembly_work, &report), ==,
      SB_OK);
  double home[SB_BODIES_MAX];
  for (size_t b = 0; b < a.bodies; b++) {
    home[b] = a.body[b].position[0];
  }
  SbDynamicsContact seal = {.static_ratio = 1.1, .stiffness = INFINITY};
  SbDynamicsModel m = {
      .mass = valve.moving_mass,
      .contacts = 2,
      .contact = {seal, seal},
      .stops = 2,
      .stop = {{6.6e-3, 1, 1e6, 0.3}, {0.0, -1, INFINITY, 0.0}},
      .edges = 1,
      .edge = {3.3e-3},
      .loads = valve_loads,
      .drive = {.kind = SB_DRIVE_PRESS, .end = 6.9e-3, .rise = 20.7, .fall = 20.7, .cycles = 1},
      .drive_stiffness = 1e5,
      .drive_damping = 5.0};
  SbDynamics s;
  g_assert_cmpint(sb_dynamics_init(&s, &m, &report), ==, SB_OK);
  g_assert_cmpint(sb_dynamics_advance(&s, 0.0, &report), ==, SB_OK);
  Loads loads = {&s, home[SB_VALVE_BLOCK], home[SB_VALVE_STEM_BOTTOM]};
  double place = 0.0, force = 0.0, furthest = 0.0, at = 0.0;
  long stepped = 0, segments = 0;
  while (!sb_dynamics_at_rest(&s)) {
    bool chosen = segments >= first && segments < first + count;
    bool taken = !s.held && chosen && segments % every == 0;
    bool sample = every > 1 || segments <= first || !chosen;
    if (s.held || sample) {
      // At rest, or a sample: where the reduced form is.
      double speed = s.held ? 0.0 : s.at.v, x = sample ? s.at.x : at;
      g_assert_cmpint(sb_assembly_slide(&a, &t, x - at, speed, NULL, &assembly_work, &report), ==,
                      SB_OK);
      at = x;
    }
    segments += !s.held;
    double until = s.t_end, span = until - s.t;
    if (taken) {
      double k = (s.wall[SB_DYNAMICS_PLATEN].on ? 1e5 : 0.0) + (s.wall[0].on ? 1e6 : 0.0);
      double w = sqrt(k / m.mass) + 1.0, time = s.t;
      double ringing = fmin(span, 60.0 / w);
      int fine = (int)ceil(ringing * w / 0.025), coarse = (int)ceil((span - ringing) * w / 0.3);
      fine = fine > 50 ? fine : 50;
      for (int i = 0; i < fine + coarse; i++) {
        double h = i < fine ? ringing / fine : (span - ringing) / coarse;
        g_assert_cmpint(assembly_step(&a, time, h, part_loads, &loads, &report), ==, SB_OK);
        g_assert_cmpstr(report.text, ==, "");
        time = i + 1 == fine ? s.t + ringing : time + h;
        stepped++;
      }
      // Against the reduced form just before the event.
      SbOscillatorState end = sb_oscillator_at(&s.motion, span);
      double x = s.at.x + end.travel;
      double block = a.body[SB_VALVE_BLOCK].position[0] - home[SB_VALVE_BLOCK];
      at = a.body[SB_VALVE_STEM_CENTRE].position[0] - home[SB_VALVE_STEM_CENTRE];
      for (size_t b = SB_VALVE_STEM_CENTRE; b <= SB_VALVE_BLOCK; b++) {
        place = fmax(place, fabs(a.body[b].position[0] - home[b] - x));
        place = fmax(place, hypot(a.body[b].position[1], a.body[b].position[2]));
      }
      place = fmax(place, fabs(a.body[SB_VALVE_HOUSING].position[0]));
      force = fmax(force, s.wall[SB_DYNAMICS_PLATEN].on ? 1e5 * fabs(block - x) : 0.0);
      furthest = fmax(furthest, x);
      g_assert_cmpint(
          sb_assembly_tangent(&t, &a, SB_VALVE_STEM_CENTRE, x_axis, &assembly_work, &report), ==,
          SB_OK);
    }
    g_assert_cmpint(sb_dynamics_advance(&s, until, &report), ==, SB_OK);
  }
  g_test_message("%ld segments of motion, %ld steps: %.1e m, %.1e N off", segments, stepped, place,
                 force);
  g_assert_cmpint(segments, >, 400);
  g_assert_cmpint(stepped, >, 0);
  g_assert_true(count < LONG_MAX || furthest > 6.5e-3);
  g_assert_cmpfloat(place, <, 1e-9 * 6.6e-3);
  g_assert_cmpfloat(force, <, 1e-9 * 30.0);
}

int main(int argc, char **argv) {
  g_test_init(&argc, &argv, NULL);
  if (argc > 2) {
    count = atol(argv[1]);
    first = atol(argv[2]);
  }
  g_test_add_func("/motion/mechanism/slider-crank", test_slider_crank);
  g_test_add_func("/motion/mechanism/tangent", test_tangent);
  g_test_add_func("/motion/mechanism/refused", test_refused);
  g_test_add_func("/motion/mechanism/as-one", test_as_one);
  g_test_add_func("/motion/mechanism/cycle", test_cycle);
  return g_test_run();
}
