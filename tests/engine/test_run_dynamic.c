// The valve's motion with inertia: it agrees with the quasi-static cycle where it should, every
// drive ends with its energy in balance, and the keys of friction do what they say.
#include "engine/valve/figures/figures.h"
#include "tests/engine/motion_run.h"
#include "tests/engine/near.h"

// Without a static peak, in a machine whose damper outdoes the fall of friction with the speed, the
// slow stroke is a string of balances. What differs: the stop gives a little, and the damper adds
// c v = 0.013 N.
static void test_against_quasi_static(void) {
  Setting smooth[] = {{SB_P_FRICTION_STATIC_RATIO, 1}, {SB_P_DRIVE_DAMPING_RATIO, 1}};
  SbRun *slow = run_with(SB_MODEL_MOTION_QUASI_STATIC, smooth, 2);
  SbRun *fast = run_with(SB_MODEL_MOTION_DYNAMIC, smooth, 2);
  for (int in = 0; in < 2; in++) {
    for (double s = 0.5e-3; s < 6.4e-3; s += 0.25e-3) {
      // Beside the edge, where forces change with s and frames do not sit at the same places.
      if (s > 3.2e-3 && s < 4.1e-3) {
        continue;
      }
      double a = force_at(slow, s, in);
      double b = force_at(fast, s, in);
      g_assert_cmpfloat(fabs(a - b), <, 0.04);
    }
  }
  const SbSummary *a = sb_run_summary(slow);
  const SbSummary *b = sb_run_summary(fast);
  for (int stage = SB_STAGE_B; stage < SB_STAGE_COUNT; stage++) {
    g_assert_true(b->stage[stage].reached);
  }
  g_assert_cmpfloat(fabs(a->stage[SB_STAGE_C].displacement - b->stage[SB_STAGE_C].displacement), <,
                    1e-9);
  g_assert_cmpfloat(fabs(a->stage[SB_STAGE_F].displacement - b->stage[SB_STAGE_F].displacement), <,
                    1e-9);
  // Both start back from the stop at the same force, once it is unloaded.
  g_assert_cmpfloat(fabs(a->stage[SB_STAGE_E].displacement - b->stage[SB_STAGE_E].displacement), <,
                    1e-8);
  g_assert_cmpfloat(fabs(a->stage[SB_STAGE_E].force - b->stage[SB_STAGE_E].force), <, 0.04);
  g_assert_cmpfloat(fabs(a->energy.loop / b->energy.loop - 1), <, 2e-3);
  g_assert_cmpfloat(fabs(a->force_breakaway / b->force_breakaway - 1), <, 1e-3);
  sb_run_destroy(slow);
  sb_run_destroy(fast);
}

// The motion takes friction as straight bands over the speed, a frame as it is: at a steady speed
// the forces are out of balance by the difference, which the error of force covers and is not far
// above.
static void test_straight_bands(void) {
  Setting smooth[] = {{SB_P_FRICTION_STATIC_RATIO, 1}, {SB_P_DRIVE_DAMPING_RATIO, 1}};
  SbRun *run = run_with(SB_MODEL_MOTION_DYNAMIC, smooth, 2);
  const SbSummary *summary = sb_run_summary(run);
  const double speed = sb_run_model(run)->speed;
  double worst = 0;
  size_t count, steady = 0;
  const SbFrame *frames = sb_run_frames(run, &count);
  for (size_t i = 0; i < count; i++) {
    const SbFrame *frame = &frames[i];
    if (fabs(fabs(frame->velocity) / speed - 1) < 1e-6) {
      double off = frame->force - frame->pressure_force - frame->stop_force - frame->spring_force;
      for (int seal = 0; seal < SB_SEAL_COUNT; seal++) {
        off -= frame->seal[seal].friction;
      }
      worst = fmax(worst, fabs(off) / summary->force_peak);
      steady++;
    }
  }
  g_test_message("%zu frames out of balance by %.2e, told %.2e", steady, worst,
                 summary->error_force);
  g_assert_cmpuint(steady, >, 100);
  g_assert_cmpfloat(worst, >, 1e-6);
  g_assert_cmpfloat(worst, <=, summary->error_force);
  g_assert_cmpfloat(summary->error_force, <=, 10 * worst);
  sb_run_destroy(run);
}

// With the static peak the stem of an undamped seal sticks and slips between the same bounds.
static void test_stick_slip(void) {
  SbRun *run = run_with(SB_MODEL_MOTION_DYNAMIC, NULL, 0);
  const SbSummary *summary = sb_run_summary(run);
  g_assert_cmpfloat_with_epsilon(summary->force_breakaway, 28.7, 0.05);
  g_assert_true(summary->returns);
  double least = INFINITY;
  double most = 0;
  size_t count;
  const SbFrame *frames = sb_run_frames(run, &count);
  for (size_t i = 0; i < count; i++) {
    if (frames[i].stage == SB_STAGE_B && frames[i].displacement < 3e-3 && frames[i].time > 2) {
      least = fmin(least, frames[i].force);
      most = fmax(most, frames[i].force);
    }
  }
  g_assert_cmpfloat(most, <=, summary->force_breakaway * 1.001);
  // The stem swings as far below the friction of its slip, at 0.06 m/s, as it starts above.
  Setting quick = {SB_P_DRIVE_SPEED, 0.06};
  SbRun *slip = run_with(SB_MODEL_MOTION_QUASI_STATIC, &quick, 1);
  double slides = sb_run_model(slip)->pressure_force;
  for (int seal = 0; seal < SB_SEAL_COUNT; seal++) {
    const SbSealState *state = &sb_run_summary(slip)->seal[seal];
    slides += state->friction_boundary + state->friction_viscous;
  }
  sb_run_destroy(slip);
  g_assert_cmpfloat(slides, <, 27.3);
  g_assert_cmpfloat(least, >, 2 * slides - 28.7 - 0.1);
  sb_run_destroy(run);
}

static void test_drives(void) {
  const Setting cases[][3] = {
      {{SB_P_DRIVE_KIND, SB_MODEL_DRIVE_HAND}, {SB_P_DRIVE_CYCLES, 2}, {SB_P_OUTPUT_FRAMES, 300}},
      {{SB_P_DRIVE_KIND, SB_MODEL_DRIVE_FREE_RETURN},
       {SB_P_OUTPUT_FRAMES, 300},
       {SB_P_DRIVE_CYCLES, 1}},
      {{SB_P_DRIVE_KIND, SB_MODEL_DRIVE_SINUSOID},
       {SB_P_DRIVE_CYCLES, 2},
       {SB_P_OUTPUT_FRAMES, 300}},
      {{SB_P_STEM_SPRING_STIFFNESS, 2e3}, {SB_P_STEM_SPRING_PRELOAD, 5}, {SB_P_OUTPUT_FRAMES, 300}},
      {{SB_P_BORE_LAND_EDGE, 0}, {SB_P_OUTPUT_FRAMES, 300}, {SB_P_DRIVE_CYCLES, 1}},
      {{SB_P_FRICTION_STATIC_RATIO, 5},
       {SB_P_OUTPUT_FRAMES, 300},
       {SB_P_DRIVE_REVERSAL_FORCE, 100}},
      {{SB_P_CANISTER_PRESSURE_MAP, 1}, {SB_P_OUTPUT_FRAMES, 300}, {SB_P_DRIVE_CYCLES, 1}},
      {{SB_P_DRIVE_SPEED, 1}, {SB_P_OUTPUT_FRAMES, 300}, {SB_P_DRIVE_CYCLES, 1}},
  };
  for (size_t i = 0; i < G_N_ELEMENTS(cases); i++) {
    SbRun *run = run_with(SB_MODEL_MOTION_DYNAMIC, cases[i], 3);
    const SbSummary *summary = sb_run_summary(run);
    g_test_message("case %zu: %.3g s, peak %.3g N, returns %d, closure %.2g, %zu steps, %.1f ms", i,
                   summary->duration, summary->force_peak, summary->returns,
                   summary->energy.closure, summary->steps, 1e3 * summary->wall_s);
    g_assert_cmpfloat(summary->duration, >, 0);
    sb_run_destroy(run);
  }
}

// A spring alone returns the stem: no external work is the scale of the other terms. It is not a
// figure, and the balance is judged by the stored energies.
static void test_spring_alone(void) {
  const Setting spring[] = {{SB_P_DRIVE_KIND, SB_MODEL_DRIVE_FREE_RETURN},
                            {SB_P_CANISTER_PRESSURE, 0},
                            {SB_P_STEM_SPRING_STIFFNESS, 1e3},
                            {SB_P_STEM_SPRING_PRELOAD, 15},
                            {SB_P_OUTPUT_FRAMES, 50}};
  SbRun *run = run_with(SB_MODEL_MOTION_DYNAMIC, spring, G_N_ELEMENTS(spring));
  const SbSummary *summary = sb_run_summary(run);
  g_assert_true(summary->returns);
  g_assert_true(isnan(summary->energy.external) && isnan(summary->energy.external_max));
  g_assert_cmpfloat(summary->energy.stored, <, -1e-3);
  g_assert_cmpfloat(summary->energy.closure, >=, 0);
  g_assert_cmpfloat(summary->energy.closure, <, 1e-6);
  g_assert_nonnull(sb_figure_reason(summary, sb_figure_find("cycle.energy.external_J")));
  sb_run_destroy(run);
}

// A stem without friction rebounds from the end stop while the machine turns, and goes back past
// the land's edge: its return begins there at the latest, not in the next cycle.
static void test_free_rebound(void) {
  Setting without[] = {{SB_P_GLAND_RADIAL_SPACE, 0.74716e-3},
                       {SB_P_SEAL_SECTION_DIAMETER, 0.75529e-3},
                       {SB_P_SEAL_OUTER_SECTION_DIAMETER, 0.74477e-3},
                       {SB_P_STEM_MASS, 9.3161e-3},
                       {SB_P_STEM_SPRING_PRELOAD, 6.6789},
                       {SB_P_DRIVE_SPEED, 24.657e-3},
                       {SB_P_DRIVE_REVERSAL_FORCE, 5.1571},
                       {SB_P_FRICTION_SHEAR_STRENGTH, 0.44178e6},
                       {SB_P_HOUSING_STOP_RESTITUTION, 0.91097}};
  SbRun *run = run_with(SB_MODEL_MOTION_DYNAMIC, without, G_N_ELEMENTS(without));
  const SbSummary *summary = sb_run_summary(run);
  g_assert_true(summary->stage[SB_STAGE_F].reached);
  g_assert_true(summary->stage[SB_STAGE_E].reached);
  g_assert_cmpfloat(summary->stage[SB_STAGE_E].time, <=, summary->stage[SB_STAGE_F].time);
  sb_run_destroy(run);
}

// Summary of a run of the default valve in any status.
static SbSummary limited(double work_limit) {
  const Setting set[] = {{SB_P_MODELS_MOTION, SB_MODEL_MOTION_DYNAMIC},
                         {SB_P_FRICTION_STRIBECK_SPEED, 1e-3},
                         {SB_P_OUTPUT_FRAMES, 50},
                         {SB_P_OUTPUT_WORK_LIMIT, work_limit}};
  SbParams params;
  SbModel model;
  SbPlan plan;
  SbRun *run;
  sb_params_init(&params);
  for (size_t i = 0; i < G_N_ELEMENTS(set); i++) {
    g_assert_cmpint(sb_params_set(&params, (SbParamId)set[i].id, set[i].value, NULL), ==, SB_OK);
  }
  g_assert_cmpint(sb_model_compile(&model, &params, NULL, NULL), ==, SB_OK);
  sb_plan_make(&plan, &model);
  g_assert_cmpint(sb_run_create(&run, &model, &plan, NULL), ==, SB_OK);
  g_assert_cmpint(sb_run_execute(run, NULL, NULL), !=, SB_ERROR_INPUT);
  const SbSummary out = *sb_run_summary(run);
  sb_run_destroy(run);
  return out;
}

// A budget of work that lasts for the motion, but not for a second one that measures its error,
// leaves a converged run whose errors are not known; one that does not last for the motion does
// not converge. Neither is exceeded.
static void test_budget(void) {
  const SbSummary whole = limited(1e6);
  const double all = (double)whole.work;
  int known = 0, unknown = 0, unfinished = 0;
  g_assert_true(whole.converged);
  for (int tenths = 1; tenths <= 20; tenths++) {
    const double limit = ceil(0.1 * tenths * all);
    const SbSummary summary = limited(limit);
    g_assert_cmpfloat((double)summary.work, <=, limit);
    known += summary.converged && isfinite(summary.error_force);
    unknown += summary.converged && isnan(summary.error_force);
    unfinished += !summary.converged;
  }
  g_test_message("%g steps; known %d, unknown %d, unfinished %d", all, known, unknown, unfinished);
  g_assert_cmpint(known, >, 0);
  g_assert_cmpint(unknown, >, 0);
  g_assert_cmpint(unfinished, >, 0);
}

// A stem flung back over the land's edge by a hard stop has not returned: the stages keep their
// order.
static void test_rebound(void) {
  const Setting fling[] = {{SB_P_DRIVE_KIND, SB_MODEL_DRIVE_HAND},
                           {SB_P_DRIVE_PEAK_FORCE, 210},
                           {SB_P_DRIVE_RISE_TIME, 2.16e-3},
                           {SB_P_HOUSING_STOP_RESTITUTION, 0.9}};
  SbRun *run = run_with(SB_MODEL_MOTION_DYNAMIC, fling, G_N_ELEMENTS(fling));
  const SbSummary *summary = sb_run_summary(run);
  for (int stage = SB_STAGE_B; stage < SB_STAGE_COUNT; stage++) {
    g_assert_true(summary->stage[stage].reached);
    g_assert_cmpfloat(summary->stage[stage].time, >, summary->stage[stage - 1].time);
  }
  size_t count;
  const SbFrame *frames = sb_run_frames(run, &count);
  double least = INFINITY;
  for (size_t i = 0; i < count; i++) {
    bool before = frames[i].time > summary->stage[SB_STAGE_D].time &&
                  frames[i].time < summary->stage[SB_STAGE_E].time;
    least = before ? fmin(least, frames[i].displacement) : least;
  }
  g_assert_cmpfloat(least, <, 6.5e-3);
  sb_run_destroy(run);
}

static void test_no_return(void) {
  Setting rough = {SB_P_SURFACE_GT_PRODUCT, 1.3 * 0.1289};
  SbRun *run = run_with(SB_MODEL_MOTION_DYNAMIC, &rough, 1);
  g_assert_false(sb_run_summary(run)->returns);
  g_assert_cmpfloat(sb_run_summary(run)->force_return_min, <, 0);
  sb_run_destroy(run);
}

// ---- friction's keys ----

// A stem that is stuck has no speed at all; its seals' friction is what balance needs.
static void test_stuck(void) {
  SbRun *run = run_with(SB_MODEL_MOTION_DYNAMIC, NULL, 0);
  size_t count;
  const SbFrame *frames = sb_run_frames(run, &count);
  for (size_t i = 0; frames[i].stage < SB_STAGE_B; i++) {
    g_assert_true(frames[i].velocity == 0);
    g_assert_true(frames[i].displacement == 0);
  }
  sb_run_destroy(run);
}

// friction.tangential_stiffness: between the lifting off the rest stop and B the slope A-B is
// machine and both seals in series. friction.dwell_gain: the peak grows with the logarithm of
// drive.rest. friction.stribeck_speed: sliding at that speed has lost all but 1/e of the peak.
static void test_friction_keys(void) {
  const double kt = 2e4;
  const Setting elastic[] = {{SB_P_FRICTION_TANGENTIAL_STIFFNESS, kt}, {SB_P_OUTPUT_FRAMES, 20000}};
  SbRun *run = run_with(SB_MODEL_MOTION_DYNAMIC, elastic, 2);
  size_t count;
  const SbFrame *frames = sb_run_frames(run, &count);
  const SbFrame *from = NULL;
  const SbFrame *to = NULL;
  for (size_t i = 0; i < count && frames[i].stage == SB_STAGE_A; i++) {
    from = frames[i].force < 15 ? &frames[i] : from;
    to = frames[i].force < 19 ? &frames[i] : to;
  }
  double slope = (to->force - from->force) / (to->platen - from->platen);
  assert_near(slope, 1 / (1 / 1e5 + 1 / (2 * kt)), 2e-3 * slope);
  sb_run_destroy(run);

  run = run_with(SB_MODEL_MOTION_DYNAMIC, NULL, 0);
  double peak = sb_run_summary(run)->force_breakaway;
  double level = 0;
  frames = sb_run_frames(run, &count);
  for (int seal = 0; seal < SB_SEAL_COUNT; seal++) {
    level += frames[sb_run_summary(run)->stage[SB_STAGE_C].frame].seal[seal].friction;
  }
  sb_run_destroy(run);
  const double rest = 604800;
  const Setting dwell[] = {
      {SB_P_FRICTION_DWELL_GAIN, 0.02}, {SB_P_FRICTION_DWELL_TIME, 1}, {SB_P_DRIVE_REST, rest}};
  run = run_with(SB_MODEL_MOTION_DYNAMIC, dwell, 3);
  // The rest lasts until break-away; friction in C is that of sliding, or of rest between slips.
  double grown = sb_run_summary(run)->force_breakaway - peak;
  g_assert_cmpfloat_with_epsilon(grown / (0.02 * log1p(rest) * level), 1, 0.1);
  sb_run_destroy(run);

  // The curve at its own speed and at twice that, in a stroke without stick-slip.
  double force[2], expected[2];
  for (int i = 0; i < 2; i++) {
    const Setting law[] = {{SB_P_FRICTION_STRIBECK_SPEED, 0.1 / (i + 1)},
                           {SB_P_DRIVE_SPEED, 0.1},
                           {SB_P_DRIVE_DAMPING_RATIO, 1},
                           {SB_P_FRICTION_STATIC_RATIO, 1.1}};
    run = run_with(SB_MODEL_MOTION_DYNAMIC, law, 4);
    frames = sb_run_frames(run, &count);
    const SbFrame *late = &frames[sb_run_summary(run)->stage[SB_STAGE_D].frame];
    assert_near(late->velocity, 0.1, 1e-3);
    force[i] = late->seal[SB_OUTER].friction_boundary;
    // The key acts on the friction without a film; the film takes its part off beside it.
    const SbSealState *outer = &sb_run_summary(run)->seal[SB_OUTER];
    const double dry = outer->friction_static / 1.1;
    expected[i] = outer->friction_boundary + 0.1 * dry * exp(-(i + 1));
    sb_run_destroy(run);
  }
  assert_near(force[0] / force[1], expected[0] / expected[1], 1e-3);
  assert_near(force[0] / expected[0], 1, 2e-3);
}

// What only inertia can do is refused without it, by name; and a speed law through an undamped
// seal.
static void test_refused(void) {
  SbParams params;
  sb_params_init(&params);
  g_assert_cmpint(sb_params_set(&params, SB_P_DRIVE_KIND, SB_MODEL_DRIVE_HAND, NULL), ==, SB_OK);
  SbModel model;
  SbProblems problems;
  g_assert_cmpint(sb_model_compile(&model, &params, NULL, &problems), ==, SB_ERROR_INPUT);
  g_assert_cmpstr(problems.item[0].key, ==, "drive.kind");
  sb_params_init(&params);
  problems.count = 0;
  g_assert_cmpint(sb_params_set(&params, SB_P_MODELS_MOTION, SB_MODEL_MOTION_DYNAMIC, NULL), ==,
                  SB_OK);
  g_assert_cmpint(sb_params_set(&params, SB_P_FRICTION_STRIBECK_SPEED, 1e-3, NULL), ==, SB_OK);
  g_assert_cmpint(sb_params_set(&params, SB_P_FRICTION_TANGENTIAL_STIFFNESS, 1e4, NULL), ==, SB_OK);
  g_assert_cmpint(sb_model_compile(&model, &params, NULL, &problems), ==, SB_OK);
  g_assert_cmpint(sb_params_set(&params, SB_P_DRIVE_DAMPING_RATIO, 0, NULL), ==, SB_OK);
  g_assert_cmpint(sb_model_compile(&model, &params, NULL, &problems), ==, SB_ERROR_INPUT);
  g_assert_cmpstr(problems.item[0].key, ==, "drive.damping_ratio");
}

// Without friction the stem slips where it leaves its stops, at the pressure's force; a finger that
// cannot move it says so.
static void test_first_slip(void) {
  Setting smooth[] = {{SB_P_DRIVE_KIND, SB_MODEL_DRIVE_HAND},
                      {SB_P_FRICTION_SHEAR_STRENGTH, 0},
                      {SB_P_FRICTION_LOAD_COEFFICIENT, 0}};
  SbRun *run = run_with(SB_MODEL_MOTION_DYNAMIC, smooth, 3);
  const SbSummary *summary = sb_run_summary(run);
  for (int stage = SB_STAGE_A; stage < SB_STAGE_COUNT; stage++) {
    g_assert_true(summary->stage[stage].reached);
  }
  double pressure = sb_run_model(run)->pressure_force;
  g_assert_cmpfloat(fabs(summary->stage[SB_STAGE_B].force / pressure - 1), <, 1e-9);
  g_assert_cmpfloat(fabs(summary->stage[SB_STAGE_E].force / pressure - 1), <, 1e-6);
  g_assert_false(warned(&sb_run_summary(run)->warnings, "no-slip"));
  sb_run_destroy(run);
  Setting weak[] = {{SB_P_DRIVE_KIND, SB_MODEL_DRIVE_HAND}, {SB_P_DRIVE_PEAK_FORCE, 28}};
  run = run_with(SB_MODEL_MOTION_DYNAMIC, weak, 2);
  g_assert_false(sb_run_summary(run)->stage[SB_STAGE_B].reached);
  g_assert_true(warned(&sb_run_summary(run)->warnings, "no-slip"));
  sb_run_destroy(run);
}

// A finger that gives way moves the stem at the speed at which its force, the pressure's and the
// seals' balance, after the 37 us that mass over damping take: c v = F(t) - F_p - f.
static void test_finger(void) {
  const double damping = 100;
  Setting settings[] = {{SB_P_DRIVE_KIND, SB_MODEL_DRIVE_HAND},
                        {SB_P_DRIVE_FINGER_DAMPING, damping},
                        {SB_P_OUTPUT_FRAMES, 4000}};
  SbRun *run = run_with(SB_MODEL_MOTION_DYNAMIC, settings, G_N_ELEMENTS(settings));
  const SbModel *model = sb_run_model(run);
  size_t count, seen = 0;
  const SbFrame *frames = sb_run_frames(run, &count);
  double slip = sb_run_summary(run)->stage[SB_STAGE_B].time;
  for (size_t i = 0; i < count; i++) {
    const SbFrame *f = &frames[i];
    if (f->stage != SB_STAGE_B || f->time < slip + 1e-3 || f->on_event) {
      continue;
    }
    double finger = model->peak_force * f->time / model->rise_time;
    double rubs = f->seal[SB_INNER].friction + f->seal[SB_OUTER].friction;
    double speed = (finger - model->pressure_force - rubs) / damping;
    // Ramp and mass: v lags by m/c of its rate, 1.1 m/s2. The motion's friction is straight to a
    // thousandth in its bands of speed, the frame's is the state's own.
    g_assert_cmpfloat(fabs(f->velocity - speed), <, 2e-3 * speed + 5e-5 + 1e-3 * rubs / damping);
    g_assert_cmpfloat(fabs(f->force - (finger - damping * f->velocity)), <, 1e-9 * finger);
    seen++;
  }
  g_assert_cmpuint(seen, >, 50);
  g_assert_true(sb_run_summary(run)->returns);
  sb_run_destroy(run);
}

// The last moment of a finger whose force falls to 0 is known to the rounding of the time: it
// leaves the stem once, where friction depends on speed too.
static void test_finger_leaves(void) {
  Setting settings[] = {{SB_P_DRIVE_KIND, SB_MODEL_DRIVE_HAND},
                        {SB_P_DRIVE_PEAK_FORCE, 58.798170439287645},
                        {SB_P_DRIVE_RISE_TIME, 0.0840600806026059},
                        {SB_P_DRIVE_STIFFNESS, 20126.07849234182},
                        {SB_P_DRIVE_DAMPING_RATIO, 0.2001909473491302},
                        {SB_P_FRICTION_STATIC_RATIO, 1.48},
                        {SB_P_FRICTION_STRIBECK_SPEED, 0.004973802219665759},
                        {SB_P_HOUSING_STOP_RESTITUTION, 0.5774017734051939},
                        {SB_P_MODELS_FILM, 1},
                        {SB_P_STEM_MASS, 0.03811766630825119},
                        {SB_P_SURFACE_GT_PRODUCT, 0.1062033815929603},
                        {SB_P_OUTPUT_FRAMES, 50}};
  SbRun *run = run_with(SB_MODEL_MOTION_DYNAMIC, settings, G_N_ELEMENTS(settings));
  g_assert_true(sb_run_summary(run)->returns);
  sb_run_destroy(run);
}

// A sinusoid's stroke does not pass the middle of the valve's: its films are those of its mean
// speed, whose error they have.
static void test_error_of_mean_speed(void) {
  const int film = sb_figure_find("seals.outer.film_central_m");
  double value[2], error = 0;
  for (int fine = 0; fine < 2; fine++) {
    Setting set[] = {{SB_P_DRIVE_KIND, SB_MODEL_DRIVE_SINUSOID},
                     {SB_P_OUTPUT_MOTION_TOLERANCE, fine ? 1e-10 : 1e-8}};
    SbRun *run = run_with(SB_MODEL_MOTION_DYNAMIC, set, 2);
    value[fine] = sb_figure_value(sb_run_summary(run), film);
    error = fine ? error : sb_figure_error_absolute(sb_run_summary(run), film);
    sb_run_destroy(run);
  }
  g_assert_cmpfloat(fabs(value[1] - value[0]), >, 0);
  g_assert_cmpfloat(fabs(value[1] - value[0]), <=, 3 * error);
  g_assert_cmpfloat(error, <, 1e-6 * value[0]);
}

// A finger has no speed of its own: the films are those at which the stem slides, whatever
// drive.speed says, each frame's at its own speed, and the work of friction follows.
static void test_own_speed(void) {
  Setting slow[] = {{SB_P_DRIVE_KIND, SB_MODEL_DRIVE_HAND}, {SB_P_DRIVE_SPEED, 1e-6}};
  Setting quick[] = {{SB_P_DRIVE_KIND, SB_MODEL_DRIVE_HAND}, {SB_P_DRIVE_SPEED, 1}};
  SbRun *a = run_with(SB_MODEL_MOTION_DYNAMIC, slow, 2);
  SbRun *b = run_with(SB_MODEL_MOTION_DYNAMIC, quick, 2);
  const SbSummary *summary = sb_run_summary(a);
  const SbStageMark *B = &summary->stage[SB_STAGE_B], *C = &summary->stage[SB_STAGE_C];
  const double middle = (B->displacement + C->displacement) / 2;
  size_t all;
  const SbFrame *from = sb_run_frames(a, &all);
  while (from[1].displacement < middle) {
    from++;
  }
  // Evenly accelerated between two frames.
  double share = (middle - from[0].displacement) / (from[1].displacement - from[0].displacement);
  double speed = sqrt((1 - share) * pow(from[0].velocity, 2) + share * pow(from[1].velocity, 2));
  g_assert_cmpfloat(speed, >, 0.1);
  const SbModel *model = sb_run_model(a);
  for (int seal = 0; seal < SB_SEAL_COUNT; seal++) {
    const SbSealState *own = &summary->seal[seal];
    const SbSealModel *ring = &model->seal[seal];
    // Thesis equation 7.5 at half the sliding speed, and the net load: the fluid's share, pressure
    // difference times half the width, is off.
    double fluid = seal == SB_OUTER ? 0.55e6 * own->contact_width / 2 : 0;
    double U = model->viscosity * speed / 2 / (ring->reduced_modulus * ring->radius);
    double W = (own->load_per_length - fluid) / (ring->reduced_modulus * ring->radius);
    double film = 1.492 * pow(U, 0.5434) * pow(W, -0.2893) * ring->radius;
    g_assert_cmpfloat(fabs(own->film_central / film - 1), <, 0.01);
    g_assert_cmpfloat(fabs(own->film_central / sb_run_summary(b)->seal[seal].film_central - 1), <,
                      0.02);
    size_t count;
    const SbFrame *frames = sb_run_frames(a, &count);
    size_t seen = 0;
    for (size_t i = 0; i < count; i++) {
      const SbSealFrame *at = &frames[i].seal[seal];
      if (at->film_central > 0 && frames[i].stage == SB_STAGE_B) {
        double expected = film * pow(fabs(frames[i].velocity) / speed, 0.5434);
        g_assert_cmpfloat(fabs(at->film_central / expected - 1), <, 0.01);
        g_assert_cmpfloat(fabs(at->lambda / (at->film_central / model->sigma) - 1), <, 1e-9);
        seen++;
      }
    }
    g_assert_cmpuint(seen, >, 0);
  }
  g_assert_cmpfloat(fabs(summary->energy.friction / sb_run_summary(b)->energy.friction - 1), <,
                    0.01);
  sb_run_destroy(a);
  sb_run_destroy(b);
}

// A machine of 1e10 N/m and a stem of a microgram: critically damped it does not slip, few steps
// lead it over the land's edge, and the forces are the quasi-static ones. Hardly damped it slips
// millions of times, over the edge each in another way, and is followed by groups of its slips.
static void test_stiff(void) {
  Setting stiff[] = {{SB_P_DRIVE_STIFFNESS, 1e10},
                     {SB_P_STEM_MASS, 1e-9},
                     {SB_P_DRIVE_DAMPING_RATIO, 1},
                     {SB_P_CANISTER_PRESSURE_MAP, SB_MAP_CHAMBER_FILLED}};
  SbRun *slow = run_with(SB_MODEL_MOTION_QUASI_STATIC, stiff, G_N_ELEMENTS(stiff));
  for (int ports = 0; ports < 2; ports++) {
    stiff[3].value = ports ? SB_MAP_PORTS : SB_MAP_CHAMBER_FILLED;
    SbRun *run = run_with(SB_MODEL_MOTION_DYNAMIC, stiff, G_N_ELEMENTS(stiff));
    const SbSummary *summary = sb_run_summary(run), *quasi = sb_run_summary(slow);
    g_test_message("%zu steps, closure %.1e, break-away %.3g N, return %.3g N, loop %.2g off",
                   summary->steps, summary->energy.closure,
                   summary->force_breakaway - quasi->force_breakaway,
                   summary->force_return_min - quasi->force_return_min,
                   summary->energy.loop / quasi->energy.loop - 1);
    g_assert_cmpuint(summary->steps, <, 100000);
    assert_near(summary->force_breakaway, quasi->force_breakaway, 0.01);
    assert_near(summary->force_return_min, quasi->force_return_min, 0.01);
    // Ports fill and vent the chamber on the way; the quasi-static one is filled throughout.
    assert_near(summary->energy.loop, quasi->energy.loop,
                (ports ? 1e-2 : 2e-3) * quasi->energy.loop);
    sb_run_destroy(run);
  }
  sb_run_destroy(slow);

  static const int motions[] = {SB_MODEL_MOTION_DYNAMIC, SB_MODEL_MOTION_BODIES};
  for (size_t i = 0; i < G_N_ELEMENTS(motions); i++) {
    const Setting slips[] = {stiff[0], stiff[1]};
    SbRun *run = run_with(motions[i], slips, G_N_ELEMENTS(slips));
    const SbSummary *summary = sb_run_summary(run);
    g_test_message("slips: %zu steps, closure %.1e, %.2f s", summary->steps,
                   summary->energy.closure, summary->wall_s);
    g_assert_cmpuint(summary->steps, <, 100000);
    bool told = false;
    for (size_t k = 0; k < summary->warnings.count; k++) {
      told = told || strcmp(summary->warnings.item[k].code, "stick-slip-groups") == 0;
    }
    g_assert_true(told);
    sb_run_destroy(run);
  }
}

// ---- several cycles ----

// The return margin has the static friction after the rest of one press, however many follow.
static void test_dwell_of_presses(void) {
  double margin[2];
  for (int cycles = 1; cycles <= 2; cycles++) {
    const Setting settings[] = {{SB_P_DRIVE_KIND, SB_MODEL_DRIVE_HAND},
                                {SB_P_DRIVE_HOLD_TIME, 10},
                                {SB_P_FRICTION_DWELL_GAIN, 0.2},
                                {SB_P_DRIVE_CYCLES, cycles}};
    SbRun *run = run_with(SB_MODEL_MOTION_DYNAMIC, settings, G_N_ELEMENTS(settings));
    const SbSummary *summary = sb_run_summary(run);
    margin[cycles - 1] = summary->force_return_margin;
    g_assert_cmpint(summary->verdict[SB_VERDICT_RETURNS].ok, ==, SB_ANSWER_NO);
    sb_run_destroy(run);
  }
  g_assert_cmpfloat(margin[0], <, 0);
  assert_near(margin[1], margin[0], 1e-6 * fabs(margin[0]));
}

// Energies and leakage are those of one cycle, however many the motion has, and do not depend on
// the number of frames within their errors.
static void test_figures_per_cycle(void) {
  const int net = sb_figure_find("cycle.leakage_net_all_actuations_m3");
  const int loop = sb_figure_find("cycle.energy_loss_J");
  SbSummary one = {0};
  for (int i = 0; i < 4; i++) {
    const int cycles = i == 0 ? 1 : i;
    const Setting settings[] = {{SB_P_DRIVE_KIND, SB_MODEL_DRIVE_HAND},
                                {SB_P_DRIVE_CYCLES, cycles},
                                {SB_P_OUTPUT_FRAMES, i == 3 ? 600 : 60}};
    SbRun *run = run_with(SB_MODEL_MOTION_DYNAMIC, settings, G_N_ELEMENTS(settings));
    const SbSummary *summary = sb_run_summary(run);
    one = i == 0 ? *summary : one;
    g_test_message("%d cycles: %.9g J, %.9g m3", cycles, summary->energy.loop,
                   summary->leakage_per_cycle);
    assert_near(summary->energy.loop, one.energy.loop,
                3 * one.error[loop] + 1e-8 * one.energy.loop);
    assert_near(summary->energy.friction, one.energy.friction, 1e-6 * one.energy.friction);
    assert_near(summary->energy.external_max, one.energy.external_max,
                1e-6 * one.energy.external_max);
    assert_near(summary->leakage_net, one.leakage_net, 3 * one.error[net]);
    g_assert_cmpfloat(one.error[net], <, 1e-5 * one.leakage_net);
    assert_near(summary->dose_mass, one.dose_mass, 1e-9 * one.dose_mass);
    sb_run_destroy(run);
  }
}

int main(int argc, char **argv) {
  g_test_init(&argc, &argv, NULL);
  g_test_add_func("/run-dynamic/straight-bands", test_straight_bands);
  g_test_add_func("/run-dynamic/against-quasi-static", test_against_quasi_static);
  g_test_add_func("/run-dynamic/stick-slip", test_stick_slip);
  g_test_add_func("/run-dynamic/drives", test_drives);
  g_test_add_func("/run-dynamic/spring-alone", test_spring_alone);
  g_test_add_func("/run-dynamic/budget", test_budget);
  g_test_add_func("/run-dynamic/rebound", test_rebound);
  g_test_add_func("/run-dynamic/no-return", test_no_return);
  g_test_add_func("/run-dynamic/stuck", test_stuck);
  g_test_add_func("/run-dynamic/friction-keys", test_friction_keys);
  g_test_add_func("/run-dynamic/error-of-mean-speed", test_error_of_mean_speed);
  g_test_add_func("/run-dynamic/own-speed", test_own_speed);
  g_test_add_func("/run-dynamic/first-slip", test_first_slip);
  g_test_add_func("/run-dynamic/finger", test_finger);
  g_test_add_func("/run-dynamic/finger-leaves", test_finger_leaves);
  g_test_add_func("/run-dynamic/refused", test_refused);
  g_test_add_func("/run-dynamic/stiff", test_stiff);
  g_test_add_func("/run-dynamic/dwell-of-presses", test_dwell_of_presses);
  g_test_add_func("/run-dynamic/free-rebound", test_free_rebound);
  g_test_add_func("/run-dynamic/figures-per-cycle", test_figures_per_cycle);
  return g_test_run();
}
