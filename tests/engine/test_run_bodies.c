// The valve's constrained parts in a run: the motion of the reduced form, the joints' loads, and
// joints that leave too much or too little.
#include "tests/engine/motion_run.h"

#include <float.h>
#include <string.h>

// The thesis cycle by the constrained parts is that of the reduced form; each joint bears what lies
// beyond it: its loads less its inertia.
static void test_bodies(void) {
  SbRun *reduced = run_with(SB_MODEL_MOTION_DYNAMIC, NULL, 0);
  SbRun *full_form = run_with(SB_MODEL_MOTION_BODIES, NULL, 0);
  size_t count;
  size_t other;
  const SbFrame *a = sb_run_frames(reduced, &count);
  const SbFrame *b = sb_run_frames(full_form, &other);
  g_assert_cmpuint(count, ==, other);
  const SbModel *model = sb_run_model(reduced);
  double worst = 0;
  for (size_t i = 0; i < count; i++) {
    // The masses differ in their last digit, and each step rounds the time of its end: a frame in
    // the midst of a slip sees another part of it, as much as the stem goes in that time.
    double late = (double)sb_run_summary(reduced)->steps * DBL_EPSILON * a[i].time;
    double way = fabs(a[i].velocity) * late;
    double off = fabs(a[i].displacement - b[i].displacement) - way;
    worst = fmax(worst, off / 6.6e-3);
    off = fabs(a[i].force - b[i].force) - model->stiffness * way;
    worst = fmax(worst, off / 35);
  }
  g_test_message("bodies against one coordinate: %.2g", worst);
  g_assert_cmpfloat(worst, <, 1e-9);
  g_assert_null(sb_run_reactions(reduced, 0));
  g_assert_cmpuint(sb_run_summary(reduced)->bodies.joints, ==, 0);

  const SbBodiesSummary *bodies = &sb_run_summary(full_form)->bodies;
  const SbValvePart *part = sb_run_model(full_form)->parts.part;
  g_assert_cmpint(bodies->gruebler, ==, 1);
  g_assert_cmpint(bodies->constraints, ==, 41);
  g_assert_cmpuint(bodies->joints, ==, SB_VALVE_JOINTS);
  g_assert_cmpfloat(bodies->acceleration_error, <, 1e-12);
  assert_near(bodies->moving_mass, 3.73e-3 + 6.46e-6 + 1e-10, 1e-15);
  double least[SB_VALVE_JOINTS], most[SB_VALVE_JOINTS];
  for (int k = 0; k < SB_VALVE_JOINTS; k++) {
    least[k] = INFINITY;
    most[k] = -INFINITY;
  }
  for (size_t i = 0; i < count; i++) {
    const SbReaction *joint = sb_run_reactions(full_form, i);
    const SbFrame *f = &b[i];
    double inner = f->seal[SB_INNER].friction;
    double outer = f->seal[SB_OUTER].friction;
    // Newton for the whole stem.
    double total = f->force - f->pressure_force - f->spring_force - f->stop_force - inner - outer;
    double acceleration = total / bodies->moving_mass;
    double top = part[SB_VALVE_STEM_TOP].mass * acceleration + f->pressure_force + f->spring_force;
    double seal_in = part[SB_VALVE_INNER_SEAL].mass * acceleration + inner;
    double seal_out = part[SB_VALVE_OUTER_SEAL].mass * acceleration + outer;
    double block = f->force - part[SB_VALVE_BLOCK].mass * acceleration;
    double bottom = block - f->stop_force - part[SB_VALVE_STEM_BOTTOM].mass * acceleration;
    assert_near(joint[SB_VALVE_CENTRE_TOP].force[0], -top, 1e-9);
    assert_near(joint[SB_VALVE_INNER_CENTRE].force[0], seal_in, 1e-9);
    assert_near(joint[SB_VALVE_OUTER_CENTRE].force[0], seal_out, 1e-9);
    assert_near(joint[SB_VALVE_BLOCK_BOTTOM].force[0], -block, 1e-9);
    assert_near(joint[SB_VALVE_BOTTOM_CENTRE].force[0], -bottom, 1e-9);
    // The ground holds the housing against the machine.
    assert_near(joint[SB_VALVE_HOUSING_GROUND].force[0],
                -(f->force - bodies->moving_mass * acceleration), 1e-9);
    for (int k = 0; k < SB_VALVE_JOINTS; k++) {
      assert_near(hypot(joint[k].force[1], joint[k].force[2]), 0, 1e-12);
      assert_near(hypot(joint[k].torque[1], joint[k].torque[2]), 0, 1e-12);
      least[k] = fmin(least[k], joint[k].force[0]);
      most[k] = fmax(most[k], joint[k].force[0]);
    }
  }
  for (int k = 0; k < SB_VALVE_JOINTS; k++) {
    g_assert_cmpfloat(bodies->joint[k].axial_min, ==, least[k]);
    g_assert_cmpfloat(bodies->joint[k].axial_max, ==, most[k]);
  }
  sb_run_destroy(reduced);
  sb_run_destroy(full_form);
}

// Joints that leave too much or too little are refused, with the count and the joint's key.
static void test_joints(void) {
  const struct {
    SbParamId id;
    int kind;
    const char *key, *text;
  } cases[] = {
      {SB_P_JOINT_BLOCK_GROUND, SB_JOINT_FIXED, "joint.block_ground", "over-constrained"},
      {SB_P_JOINT_BLOCK_GROUND, SB_JOINT_REVOLUTE, "joint.block_ground", "does not move along"},
      {SB_P_JOINT_INNER_CENTRE, SB_JOINT_NONE, "joint.inner_centre", "'inner seal' is the freest"},
      {SB_P_JOINT_HOUSING_GROUND, SB_JOINT_NONE, "joint.housing_ground", "'valve housing'"},
  };
  for (size_t i = 0; i < G_N_ELEMENTS(cases); i++) {
    SbParams params;
    SbModel model;
    SbProblems problems;
    sb_params_init(&params);
    g_assert_cmpint(sb_params_set(&params, cases[i].id, cases[i].kind, NULL), ==, SB_OK);
    // Nobody asks: nothing to refuse.
    g_assert_cmpint(sb_model_compile(&model, &params, NULL, &problems), ==, SB_OK);
    g_assert_cmpint(sb_params_set(&params, SB_P_MODELS_MOTION, SB_MODEL_MOTION_BODIES, NULL), ==,
                    SB_OK);
    g_assert_cmpint(sb_model_compile(&model, &params, NULL, &problems), ==, SB_ERROR_INPUT);
    g_assert_cmpstr(problems.item[0].key, ==, cases[i].key);
    g_test_message("%s", problems.item[0].text);
    g_assert_nonnull(strstr(problems.item[0].text, cases[i].text));
  }
}

int main(int argc, char **argv) {
  g_test_init(&argc, &argv, NULL);
  g_test_add_func("/run-bodies/bodies", test_bodies);
  g_test_add_func("/run-bodies/joints", test_joints);
  return g_test_run();
}
