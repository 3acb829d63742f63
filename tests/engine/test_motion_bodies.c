// Constrained bodies: counts and messages, textbook motions and reactions, and the thesis' valve
// against its one-coordinate form.
#include "engine/mechanism/bodies.h"
#include "engine/mechanism/dynamics.h"
#include "engine/valve/model/model.h"
#include "engine/valve/sealbench.h"
#include "tests/engine/assembly_step.h"
#include "tests/engine/near.h"

#include <glib.h>
#include <gsl/gsl_sf_ellint.h>
#include <math.h>
#include <string.h>

static const double x_axis[3] = {1.0, 0.0, 0.0}, z_axis[3] = {0.0, 0.0, 1.0};

// The thesis' parts and joints are the catalogue's defaults.
static SbStatus thesis_valve(SbAssembly *assembly, SbReport *report) {
  SbParams params;
  SbModel model;
  sb_params_init(&params);
  g_assert_cmpint(sb_model_compile(&model, &params, NULL, NULL), ==, SB_OK);
  return sb_assembly_valve(assembly, &model.parts, report);
}

static void test_mobility(void) {
  SbAssembly a;
  SbMobility m;
  SbReport report = {0};
  g_assert_cmpint(thesis_valve(&a, &report), ==, SB_OK);
  g_assert_cmpuint(a.bodies, ==, SB_VALVE_PARTS);
  g_assert_cmpint(sb_assembly_mobility(&m, &a, 1, &assembly_work, &report), ==, SB_OK);
  g_assert_cmpint(m.gruebler, ==, 1);
  g_assert_cmpint(m.constraints, ==, 41);
  g_assert_cmpint(m.freedom, ==, 1);
  g_assert_cmpint(m.redundant, ==, 0);
  g_assert_cmpstr(m.text, ==, "8 parts, 41 constraints, 1 degree of freedom");
  // A second guide repeats what the first fixes.
  const double at[3] = {5e-3, 0.0, 0.0};
  SbAssembly over = a;
  g_assert_cmpint(sb_assembly_join(&over, SB_JOINT_TRANSLATIONAL, SB_VALVE_STEM_TOP, SB_GROUND, at,
                                   x_axis, &report),
                  ==, SB_OK);
  g_assert_cmpint(sb_assembly_mobility(&m, &over, 1, &assembly_work, &report), ==,
                  SB_ERROR_INFEASIBLE);
  g_assert_cmpint(m.gruebler, ==, -4);
  g_assert_cmpint(m.redundant, ==, 5);
  g_assert_cmpint(m.freedom, ==, 1);
  g_assert_nonnull(strstr(report.text, "over-constrained: 5 conditions are repeated"));
  g_assert_nonnull(strstr(report.text, "'stem top' and 'ground'"));
  SbAssemblyForces forces;
  g_assert_cmpint(sb_assembly_forces(&forces, &over, &assembly_work, &report), ==,
                  SB_ERROR_INFEASIBLE);
  // Without its last joint nothing guides the valve.
  SbAssembly under = a;
  under.joints--;
  g_assert_cmpint(sb_assembly_mobility(&m, &under, 1, &assembly_work, &report), ==,
                  SB_ERROR_INFEASIBLE);
  g_assert_cmpint(m.freedom, ==, 6);
  g_assert_nonnull(strstr(report.text, "under-constrained: 1 expected"));
  // A forgotten part is named.
  SbAssembly loose = a;
  const double inertia[3] = {1e-9, 1e-9, 1e-9};
  g_assert_cmpint(sb_assembly_add(&loose, "loose pin", 1e-3, inertia, at, &report), ==, SB_OK);
  g_assert_cmpint(sb_assembly_mobility(&m, &loose, 1, &assembly_work, &report), ==,
                  SB_ERROR_INFEASIBLE);
  g_assert_cmpint(m.freedom, ==, 7);
  g_assert_nonnull(strstr(report.text, "'loose pin'"));
  // Bad parts.
  const double wrong[3] = {1e-9, 1e-9, 3e-9};
  g_assert_cmpint(sb_assembly_add(&loose, "thin", 1e-3, wrong, at, &report), ==, SB_ERROR_RANGE);
  g_assert_cmpint(sb_assembly_add(&loose, "none", 0.0, inertia, at, &report), ==, SB_ERROR_RANGE);
  const size_t pairs[][2] = {{1, 1}, {1, loose.bodies}, {loose.bodies, 1}};
  for (size_t i = 0; i < G_N_ELEMENTS(pairs); i++) {
    g_assert_cmpint(
        sb_assembly_join(&loose, SB_JOINT_FIXED, pairs[i][0], pairs[i][1], at, x_axis, &report), ==,
        SB_ERROR_INPUT);
  }
}

static void gravity(SbAssembly *a, double time, void *user) {
  for (size_t i = 0; i < a->bodies; i++) {
    a->body[i].force[1] = -9.81 * a->body[i].mass;
  }
}

// A rod on a pin swings through a large angle: the period of the elliptic integral, order 4; the
// pin's reaction from energy.
static void test_pendulum(void) {
  double length = 0.3, mass = 0.4, angle = 2.0;
  double inertia[3] = {1e-5, mass * length * length / 12.0, mass * length * length / 12.0};
  double arm = 0.5 * length, about = inertia[2] + mass * arm * arm;
  double w0 = sqrt(mass * 9.81 * arm / about);
  double period = 4.0 / w0 * gsl_sf_ellint_Kcomp(sin(0.5 * angle), GSL_PREC_DOUBLE);
  double previous = 0.0;
  for (int n = 200; n <= 800; n *= 2) {
    SbAssembly a;
    SbReport report = {0};
    enum { ROD };
    const double origin[3] = {0};
    // Hangs along -y at angle 0; x axis of the rod along its length.
    double at[3] = {arm, 0.0, 0.0};
    sb_assembly_start(&a);
    g_assert_cmpint(sb_assembly_add(&a, "rod", mass, inertia, at, &report), ==, SB_OK);
    // Turned by angle - 90 degrees about z.
    double turn = angle - G_PI_2;
    SbBody *b = &a.body[ROD];
    b->orientation[0] = cos(0.5 * turn);
    b->orientation[3] = sin(0.5 * turn);
    b->position[0] = arm * sin(angle);
    b->position[1] = -arm * cos(angle);
    g_assert_cmpint(
        sb_assembly_join(&a, SB_JOINT_REVOLUTE, ROD, SB_GROUND, origin, z_axis, &report), ==,
        SB_OK);
    g_assert_cmpstr(report.text, ==, "");
    for (int i = 0; i < n; i++) {
      g_assert_cmpint(assembly_step(&a, 0.0, period / n, gravity, NULL, &report), ==, SB_OK);
      g_assert_cmpstr(report.text, ==, "");
    }
    double error = hypot(b->position[0] - arm * sin(angle), b->position[1] + arm * cos(angle));
    error = fmax(error, fabs(b->spin[2]) / w0 * arm);
    ASSERT_NEAR(hypot(b->position[0], b->position[1]), arm, 1e-12);
    if (previous > 0.0) {
      double order = log2(previous / error);
      g_test_message("pendulum: %d steps, error %.3g m, order %.2f", n, error, order);
      g_assert_cmpfloat(order, >, 3.8);
    }
    previous = error;
    // A quarter on the reaction: at any state F = m (a_c + g).
    for (int i = 0; i < n / 4; i++) {
      g_assert_cmpint(assembly_step(&a, 0.0, period / n, gravity, NULL, &report), ==, SB_OK);
    }
    SbAssemblyForces f;
    sb_assembly_clear_forces(&a);
    gravity(&a, 0.0, NULL);
    g_assert_cmpint(sb_assembly_forces(&f, &a, &assembly_work, &report), ==, SB_OK);
    double now = atan2(b->position[0], -b->position[1]), w = b->spin[2];
    double radial = mass * (w * w * arm + 9.81 * cos(now));
    double tangential = mass * (9.81 * sin(now) - 9.81 * sin(now) * mass * arm * arm / about);
    double fx = -radial * sin(now) + tangential * cos(now);
    double fy = radial * cos(now) + tangential * sin(now);
    ASSERT_NEAR(f.reaction[0].force[0], fx, 1e-9);
    ASSERT_NEAR(f.reaction[0].force[1], fy, 1e-9);
    ASSERT_NEAR(f.reaction[0].torque[2], 0.0, 1e-12);
  }
}

// A free body spins: energy and angular momentum stay, though its axis tumbles.
static void test_free_spin(void) {
  SbAssembly a;
  SbReport report = {0};
  const double inertia[3] = {1.0e-3, 2.0e-3, 2.5e-3}, at[3] = {0};
  sb_assembly_start(&a);
  g_assert_cmpint(sb_assembly_add(&a, "body", 1.0, inertia, at, &report), ==, SB_OK);
  SbBody *b = &a.body[0];
  double spin[3] = {0.01, 5.0, 0.02};
  memcpy(b->spin, spin, sizeof spin);
  double momentum = inertia[1] * 5.0;
  bool tumbled = false;
  for (int i = 0; i < 8000; i++) {
    g_assert_cmpint(assembly_step(&a, 0.0, 1e-3, NULL, NULL, &report), ==, SB_OK);
    tumbled = tumbled || fabs(b->orientation[1]) > 0.3 || fabs(b->orientation[3]) > 0.3;
  }
  g_assert_cmpstr(report.text, ==, "");
  g_assert_true(tumbled); // the middle axis is unstable
  double r[9], w = b->orientation[0], x = b->orientation[1], y = b->orientation[2],
               z = b->orientation[3];
  double m[9] = {1 - 2 * (y * y + z * z), 2 * (x * y - w * z),     2 * (x * z + w * y),
                 2 * (x * y + w * z),     1 - 2 * (x * x + z * z), 2 * (y * z - w * x),
                 2 * (x * z - w * y),     2 * (y * z + w * x),     1 - 2 * (x * x + y * y)};
  memcpy(r, m, sizeof m);
  double total[3] = {0}, energy = 0.0;
  for (int k = 0; k < 3; k++) {
    double local = r[k] * b->spin[0] + r[3 + k] * b->spin[1] + r[6 + k] * b->spin[2];
    energy += 0.5 * inertia[k] * local * local;
    for (int l = 0; l < 3; l++) {
      total[l] += r[3 * l + k] * inertia[k] * local;
    }
  }
  double energy0 = 0.5 * (1.0e-3 * 1e-4 + 2.0e-3 * 25.0 + 2.5e-3 * 4e-4);
  ASSERT_NEAR(energy, energy0, 1e-9 * energy0);
  ASSERT_NEAR(total[0], inertia[0] * 0.01, 1e-9 * momentum);
  ASSERT_NEAR(total[1], momentum, 1e-9 * momentum);
  ASSERT_NEAR(total[2], inertia[2] * 0.02, 1e-9 * momentum);
}

// A block on an inclined guide, its weight off the guide's point: acceleration, normal force,
// torque.
static void test_slider(void) {
  SbAssembly a;
  SbReport report = {0};
  const double inertia[3] = {1e-4, 1e-4, 1e-4}, at[3] = {0.02, 0.05, 0.0},
               point[3] = {0.0, 0.0, 0.0};
  double slope = 0.4;
  const double axis[3] = {cos(slope), sin(slope), 0.0};
  enum { BLOCK };
  sb_assembly_start(&a);
  g_assert_cmpint(sb_assembly_add(&a, "block", 0.7, inertia, at, &report), ==, SB_OK);
  g_assert_cmpint(
      sb_assembly_join(&a, SB_JOINT_TRANSLATIONAL, BLOCK, SB_GROUND, point, axis, &report), ==,
      SB_OK);
  gravity(&a, 0.0, NULL);
  SbAssemblyForces f;
  g_assert_cmpint(sb_assembly_forces(&f, &a, &assembly_work, &report), ==, SB_OK);
  double along = -9.81 * sin(slope), normal = 0.7 * 9.81 * cos(slope);
  ASSERT_NEAR(f.acceleration[BLOCK][0], along * cos(slope), 1e-12);
  ASSERT_NEAR(f.acceleration[BLOCK][1], along * sin(slope), 1e-12);
  ASSERT_NEAR(f.reaction[0].force[0], -normal * sin(slope), 1e-12);
  ASSERT_NEAR(f.reaction[0].force[1], normal * cos(slope), 1e-12);
  // The torque at the point balances the normal force that must pass through the centre.
  double torque = at[0] * normal * cos(slope) + at[1] * normal * sin(slope);
  ASSERT_NEAR(f.reaction[0].torque[2], torque, 1e-12);
  ASSERT_NEAR(f.spin_rate[BLOCK][2], 0.0, 1e-12);
}

// ---- the valve ----

enum { INNER, OUTER };

static void valve_loads(SbDynamicsLoads *loads, double x, size_t region, const double *extra,
                        void *user) {
  *loads =
      (SbDynamicsLoads){.force = -14.5, .level = {region == 0 ? 5.0 : 0.0, 8.0}, .constant = true};
}

// Every frame of the cycle, forces put on the parts that feel them: all moving parts accelerate as
// the one coordinate says, and each joint carries what it passes on.
static void test_valve(void) {
  SbAssembly a;
  SbReport report = {0};
  SbAssemblyTangent tangent;
  g_assert_cmpint(thesis_valve(&a, &report), ==, SB_OK);
  g_assert_cmpint(
      sb_assembly_tangent(&tangent, &a, SB_VALVE_STEM_CENTRE, x_axis, &assembly_work, &report), ==,
      SB_OK);
  double mass = tangent.mass;
  ASSERT_NEAR(mass, 3.73e-3 + 6.46e-6 + 1e-10, 1e-12 * mass);
  SbDynamicsContact seal = {.static_ratio = 1.1, .stiffness = 3e4, .damping = 3.0};
  SbDynamicsModel m = {
      .mass = mass,
      .contacts = 2,
      .contact = {seal, seal},
      .stops = 2,
      .stop = {{.position = 6.6e-3, .side = 1, .stiffness = 1e7, .restitution = 0.3},
               {.position = 1.45e-6, .side = -1, .stiffness = 1e7, .restitution = 0.3}},
      .edges = 1,
      .edge = {3.3e-3},
      .loads = valve_loads,
      .drive = {.kind = SB_DRIVE_PRESS, .end = 6.95e-3, .rise = 0.695, .fall = 0.695, .cycles = 1},
      .drive_stiffness = 1e5,
      .drive_damping = 5.0};
  SbDynamics s;
  g_assert_cmpint(sb_dynamics_init(&s, &m, &report), ==, SB_OK);
  double worst = 0.0;
  for (int i = 1; i <= 1500; i++) {
    SbDynamicsSample sample;
    g_assert_cmpint(sb_dynamics_advance(&s, i * 1e-3, &report), ==, SB_OK);
    sb_dynamics_sample(&s, &sample, NULL);
    sb_assembly_clear_forces(&a);
    SbBody *b = a.body;
    double stop = sample.stop_force[1] - sample.stop_force[0];
    b[SB_VALVE_BLOCK].force[0] = sample.drive_force;
    b[SB_VALVE_STEM_CENTRE].force[0] = sample.friction[INNER] + sample.friction[OUTER];
    b[SB_VALVE_STEM_TOP].force[0] = sample.loads_force;
    b[SB_VALVE_STEM_BOTTOM].force[0] = stop;
    SbAssemblyForces f;
    g_assert_cmpint(sb_assembly_forces(&f, &a, &assembly_work, &report), ==, SB_OK);
    double size = (14.5 + fabs(sample.drive_force)) / mass;
    for (size_t k = SB_VALVE_STEM_CENTRE; k <= SB_VALVE_BLOCK; k++) {
      worst = fmax(worst, fabs(f.acceleration[k][0] - sample.acceleration) / size);
    }
    ASSERT_NEAR(f.acceleration[SB_VALVE_HOUSING][0], 0.0, 1e-9 * size);
    // Reactions on body i of table 4.3: what is beyond the joint, less its inertia.
    double acc = sample.acceleration;
    double top = 1.47e-3 * acc - sample.loads_force; // on the stem top, so on the centre: minus
    ASSERT_NEAR(f.reaction[1].force[0], -top, 1e-9 * 50.0);
    double bottom = sample.drive_force + stop - (1.14e-3 + 1e-10) * acc;
    ASSERT_NEAR(f.reaction[2].force[0], -bottom, 1e-9 * 50.0);
    ASSERT_NEAR(f.reaction[3].force[0], 3.23e-6 * acc, 1e-9 * 50.0);
    ASSERT_NEAR(f.reaction[5].force[0], -(sample.drive_force - 1e-10 * acc), 1e-9 * 50.0);
    for (int k = 1; k < 3; k++) {
      ASSERT_NEAR(f.reaction[6].force[k], 0.0, 1e-9);
    }
  }
  g_test_message("bodies against one coordinate: %.2g of the largest acceleration", worst);
  g_assert_cmpfloat(worst, <, 1e-9);
}

// The bodies stepped by themselves under a platen's spring and pressure follow the closed form.
static void valve_push(SbAssembly *a, double time, void *user) {
  SbBody *b = a->body;
  double x = b[SB_VALVE_BLOCK].position[0] + 20e-3, v = b[SB_VALVE_BLOCK].velocity[0];
  b[SB_VALVE_BLOCK].force[0] = 1e5 * (2.8e-4 + 0.02 * time - x) + 5.0 * (0.02 - v);
  b[SB_VALVE_STEM_TOP].force[0] = -14.5;
  b[SB_VALVE_STEM_CENTRE].force[0] = -13.0;
}

static void test_valve_motion(void) {
  SbAssembly a;
  SbReport report = {0};
  SbAssemblyTangent tangent;
  double previous = 0.0, worst = 0.0;
  for (int n = 250; n <= 1000; n *= 2) {
    g_assert_cmpint(thesis_valve(&a, &report), ==, SB_OK);
    g_assert_cmpint(
        sb_assembly_tangent(&tangent, &a, SB_VALVE_STEM_CENTRE, x_axis, &assembly_work, &report),
        ==, SB_OK);
    SbOscillator o;
    sb_oscillator_init(&o, tangent.mass, 5.0, 1e5, 1e5 * 2.8e-4 + 5.0 * 0.02 - 27.5, 1e5 * 0.02,
                       0.0);
    double h = 2e-3 / n, travel;
    worst = 0.0;
    for (int i = 0; i < n; i++) {
      g_assert_cmpint(assembly_step(&a, i * h, h, valve_push, NULL, &report), ==, SB_OK);
      g_assert_cmpstr(report.text, ==, "");
      travel = sb_oscillator_at(&o, (i + 1) * h).travel;
      worst = fmax(worst, fabs(a.body[SB_VALVE_STEM_TOP].position[0] - 10e-3 - travel));
    }
    if (previous > 0.0) {
      g_test_message("valve by steps: %d, error %.3g m, order %.2f", n, worst,
                     log2(previous / worst));
    }
    previous = worst;
  }
  g_assert_cmpfloat(worst, <, 1e-9 * 4e-5);
}

int main(int argc, char **argv) {
  g_test_init(&argc, &argv, NULL);
  g_test_add_func("/motion/bodies/mobility", test_mobility);
  g_test_add_func("/motion/bodies/pendulum", test_pendulum);
  g_test_add_func("/motion/bodies/free-spin", test_free_spin);
  g_test_add_func("/motion/bodies/slider", test_slider);
  g_test_add_func("/motion/bodies/valve", test_valve);
  g_test_add_func("/motion/bodies/valve-motion", test_valve_motion);
  return g_test_run();
}
