// Solved rings in a run: each state of contact is one dragged ring, in figures, friction and
// picture; the same with one thread and with two; a ring that rolls is a result.
#include "engine/valve/answer/evaluate.h"
#include "engine/valve/run/cycle.h"
#include "engine/valve/states/sliding.h"
#include "tests/engine/models.h"

#include <glib.h>
#include <math.h>
#include <string.h>

// A ring that slides: floor and walls hold it, and its friction is less than it bears. `over` has
// more keys, up to SB_PARAM_COUNT.
static SbModel *ring_model(const SbOverride *over, size_t count) {
  SbParams params;
  sb_params_init(&params);
  const SbOverride own[] = {{SB_P_MODELS_FIT, SB_FIT_RING},      {SB_P_MODELS_FILM, SB_FILM_THESIS},
                            {SB_P_GLAND_FLOOR_FRICTION, 0.3},    {SB_P_GLAND_WALL_FRICTION, 0.1},
                            {SB_P_FRICTION_SHEAR_STRENGTH, 2e6}, {SB_P_OUTPUT_FRAMES, 60},
                            {SB_P_OUTPUT_VIEWS, SB_VIEW_SECTION}};
  for (size_t i = 0; i < G_N_ELEMENTS(own); i++) {
    g_assert_cmpint(sb_params_set(&params, own[i].id, own[i].value, NULL), ==, SB_OK);
  }
  for (size_t i = 0; i < count; i++) {
    g_assert_cmpint(sb_params_set(&params, over[i].id, over[i].value, NULL), ==, SB_OK);
  }
  SbModel *model;
  g_assert_cmpint(sb_model_create(&model, &params, NULL, NULL, NULL), ==, SB_OK);
  return model;
}

static SbRun *execute(const SbModel *model, bool alone) {
  SbPlan plan;
  SbRun *run;
  SbReport report = {0};
  const SbRunHooks hooks = {.alone = alone};
  sb_plan_make(&plan, model);
  g_assert_cmpint(sb_run_create(&run, model, &plan, &report), ==, SB_OK);
  SbStatus status = sb_run_execute(run, &hooks, &report);
  g_test_message("%.2f s: %s", sb_run_summary(run)->wall_s, report.text);
  g_assert_cmpint(status, ==, SB_OK);
  return run;
}

static bool warned(const SbSummary *summary, const char *code) {
  for (size_t i = 0; i < summary->warnings.count; i++) {
    if (strcmp(summary->warnings.item[i].code, code) == 0) {
      return true;
    }
  }
  return false;
}

// The drawn ring has the frame's contact and bears the frame's friction, in every frame.
static void test_one_state(void) {
  SbModel *model = ring_model(NULL, 0);
  SbRun *run = execute(model, false);
  const SbSummary *summary = sb_run_summary(run);
  size_t count, slides = 0, steady = 0, rests = 0, edge = 0;
  const SbFrame *frames = sb_run_frames(run, &count);
  for (size_t k = 0; k < count; k++) {
    for (int i = 0; i < SB_SEAL_COUNT; i++) {
      const SbSealFrame *seal = &frames[k].seal[i];
      const SbSealShape *ring = sb_run_shape(run, seal->shape);
      g_assert_nonnull(ring);
      if (seal->land_fraction <= 0) {
        continue;
      }
      g_assert_true(ring->contact_left == seal->contact_left);
      g_assert_true(ring->contact_right == seal->contact_right);
      if (seal->land_fraction < 1) {
        edge++;
        continue;
      }
      g_assert_true(ring->load == seal->load);
      bool moves = frames[k].velocity != 0 || fabs(ring->drag) > 1e-6; // or jumps
      // The stem's friction is the ring's drag turned over: the bore drags what holds the stem. A
      // stem that gives way slides a little faster or slower than the state: its friction is that
      // of its speed.
      double faster = fabs(fabs(frames[k].velocity) / model->speed - 1);
      if (moves) {
        const double other = frames[k].velocity != 0 ? 1e-3 * faster : 0;
        g_assert_cmpfloat_with_epsilon(ring->drag, seal->friction,
                                       (1e-9 + other) * fabs(seal->friction));
        steady += other < 1e-12;
      } else {
        g_assert_cmpfloat(fabs(ring->drag), <, 1e-9);
      }
      slides += moves;
      rests += !moves;
    }
  }
  g_test_message("%zu slide, %zu rest, %zu over the edge", slides, rests, edge);
  g_assert_cmpuint(slides, >, 20);
  g_assert_cmpuint(steady, >, 20);
  g_assert_cmpuint(rests, >, 4);
  g_assert_cmpuint(edge, >, 2);
  // Friction moves the contact with the bore and presses the outer ring to its wall on the way in.
  const SbContacts *outer = &summary->contact[SB_OUTER], *inner = &summary->contact[SB_INNER];
  g_assert_cmpfloat(outer->in_stroke.load, >, 1.5 * outer->back.load);
  g_assert_cmpfloat(outer->in_stroke.rotation, >, 3);
  g_assert_cmpint(outer->in_stroke.section, ==, SB_RING_SLIDES);
  // Without fluid both ways are mirror images.
  g_assert_cmpfloat_with_epsilon(inner->in_stroke.load, inner->back.load, 1e-4 * inner->back.load);
  g_assert_cmpfloat_with_epsilon(inner->in_stroke.left, -inner->back.right,
                                 2e-3 * inner->back.width);
  g_assert_true(summary->seal[SB_OUTER].load == outer->in_stroke.load);
  g_assert_true(outer->in_stroke.speed > 0 && outer->back.speed == -outer->in_stroke.speed);
  sb_run_destroy(run);
  sb_model_destroy(model);
}

// A ring with its asperities in the film, at speeds beside its own: no step from the solved state
// to those between solved speeds, though the pressure cuts its real area.
static void test_beside(void) {
  const Setting settings[] = {{SB_P_MODELS_SET, SB_MODEL_SET_CONSISTENT},
                              {SB_P_OUTPUT_TOLERANCE, 1e-2}};
  SbModel model;
  compile(&model, settings, G_N_ELEMENTS(settings));
  SbEvaluator *evaluator;
  g_assert_cmpint(sb_evaluator_create(&evaluator, NULL), ==, SB_OK);
  const int figure = sb_figure_find("seals.inner.friction_boundary_N");
  const SbQuestion question = {.base = &model, .figure = &figure, .figure_count = 1};
  double boundary;
  g_assert_cmpint(sb_evaluator_ask(&boundary, evaluator, &question, NULL), ==, SB_OK);
  SbSealState state[2];
  for (int i = 0; i < 2; i++) {
    SbStatus status = sb_evaluator_sliding(&state[i], evaluator, SB_INNER, SB_CYCLE_IN,
                                           model.speed * (1 + 1e-4 * i), NULL);
    g_assert_cmpint(status, ==, SB_OK);
  }
  g_assert_true(state[0].boundary_area + state[0].boundary_load == boundary);
  g_assert_cmpfloat(state[0].area_cut, <, 0.995);
  g_assert_cmpfloat(fabs(state[1].real_area_share / state[0].real_area_share - 1), <, 1e-3);
  g_assert_cmpfloat(fabs(sb_sliding_friction(&state[1]) / boundary - 1), <, 1e-3);
  sb_evaluator_destroy(evaluator);
}

// A film of some nanometres between smooth faces depends on single nodes of the dragged ring, and
// the friction of its asperities jumps with them: solved within the film's error, which is at most
// three times its estimate; the friction's error covers the jump.
static void solve_jump(const SbOverride *rough, size_t count, double speed) {
  SbModel *model = ring_model(rough, count);
  SbCounters counts = {0};
  SbWarnings *warnings = g_new0(SbWarnings, 1);
  SbSlidingMemory *memory;
  g_assert_cmpint(sb_sliding_memory_create(&memory, NULL), ==, SB_OK);
  const SbSlidingTask task = {.model = model,
                              .seal = SB_OUTER,
                              .pressure =
                                  sb_model_seal_pressure(model, SB_OUTER, SB_CHAMBER_AT_REST),
                              .speed = speed,
                              .memory = memory,
                              .counts = &counts,
                              .warnings = warnings};
  SbSealState state, again;
  SbReport report = {0};
  SbStatus status = sb_sliding_solve(&state, &task, &report);
  const double friction = sb_sliding_friction(&state);
  g_test_message("%.5g N to %.2g N; %s", friction, state.friction_error, report.text);
  g_assert_cmpint(status, ==, SB_OK);
  g_assert_cmpint(state.section, ==, SB_RING_SLIDES);
  // Borne by the ring, and no further from what the film asks than its friction's error.
  g_assert_cmpfloat_with_epsilon(friction, fabs(sb_sliding_fit(memory)->ring.drag),
                                 1e-12 * friction);
  const double asked = friction / state.borne_share;
  g_assert_cmpfloat(state.friction_error, >, 0.5 * model->tolerance * friction);
  g_assert_cmpfloat(state.friction_error, >=, 0.999 * fabs(asked - friction));
  g_assert_cmpfloat(state.friction_error, <, 4 * state.central_error * friction);
  const size_t fits = counts.fit_solves;
  g_assert_cmpint(sb_sliding_solve(&again, &task, NULL), ==, SB_OK);
  g_assert_cmpuint(counts.fit_solves, ==, fits);
  g_assert_true(sb_sliding_friction(&again) == friction);
  sb_sliding_memory_destroy(memory);
  g_free(warnings);
  sb_model_destroy(model);
}

static void test_jump(void) {
  const SbOverride nanometres[] = {{SB_P_MODELS_FILM, SB_FILM_REYNOLDS},
                                   {SB_P_MODELS_ASPERITIES, SB_MODEL_ASPERITIES_COUPLED},
                                   {SB_P_MODELS_ADHESION, SB_MODEL_ADHESION_ON},
                                   {SB_P_SURFACE_SIGMA, 1.3e-8}};
  solve_jump(nanometres, G_N_ELEMENTS(nanometres), 20.0 / 60000);
  // Valve 850 of the campaign random-valves, seed 1: 5.5 %, the film known to 2.3 %.
  const SbOverride soft[] = {{SB_P_MODELS_FILM, SB_FILM_KARASZKIEWICZ},
                             {SB_P_MODELS_ASPERITIES, SB_MODEL_ASPERITIES_COUPLED},
                             {SB_P_MODELS_ADHESION, SB_MODEL_ADHESION_ON},
                             {SB_P_MODELS_SURFACE, 1},
                             {SB_P_BORE_DIAMETER, 0.0034398339133535423},
                             {SB_P_BORE_LAND_EDGE, 0.0023579157363824974},
                             {SB_P_GLAND_RADIAL_SPACE, 0.0009501966309772595},
                             {SB_P_GLAND_AXIAL_WIDTH, 0.0022743559586116645},
                             {SB_P_GLAND_FLOOR_FRICTION, 0.0004138799902632439},
                             {SB_P_GLAND_WALL_FRICTION, 0},
                             {SB_P_SEAL_SECTION_DIAMETER, 0.0012150565860262429},
                             {SB_P_SEAL_INNER_DIAMETER, 0.0014112204238974008},
                             {SB_P_SEAL_MODULUS, 1233164.6996042493},
                             {SB_P_SEAL_POISSON_RATIO, 0.4715101645676013},
                             {SB_P_STEM_PRESSURE_DIAMETER, 0.0029790662862817486},
                             {SB_P_STEM_SEAL_SPACING, 0.0053820426208711775},
                             {SB_P_DRIVE_STROKE, 0.0029262038074983824},
                             {SB_P_CANISTER_PRESSURE, 757296.2587915391},
                             {SB_P_FLUID_VISCOSITY, 0.00011822609607504347},
                             {SB_P_SURFACE_SIGMA, 1.2658735705977926e-07},
                             {SB_P_SURFACE_SIGMA_OVER_BETA, 0.24952428303943552},
                             {SB_P_SURFACE_GT_PRODUCT, 0.05841299659698933},
                             {SB_P_SURFACE_HAMAKER_CONSTANT, 8.238883844215237e-20},
                             {SB_P_FRICTION_SHEAR_STRENGTH, 531090.4268466848},
                             {SB_P_FRICTION_LOAD_COEFFICIENT, 0.09992941152743007},
                             {SB_P_OUTPUT_TOLERANCE, 1e-2}};
  solve_jump(soft, G_N_ELEMENTS(soft), 1.7061087901631977);
}

// Friction is the law's over the pressure that is drawn, and forces balance: both seals, both ways.
static void test_balance(void) {
  SbModel *model = ring_model(NULL, 0);
  SbCounters counts = {0};
  SbWarnings *warnings = g_new0(SbWarnings, 1);
  for (int seal = 0; seal < SB_SEAL_COUNT; seal++) {
    for (int way = -1; way <= 1; way += 2) {
      SbSlidingMemory *memory;
      g_assert_cmpint(sb_sliding_memory_create(&memory, NULL), ==, SB_OK);
      SbSealPressure pressure = sb_model_seal_pressure(model, seal, SB_CHAMBER_AT_REST);
      const SbSlidingTask task = {.model = model,
                                  .seal = seal,
                                  .pressure = pressure,
                                  .speed = way * model->speed,
                                  .memory = memory,
                                  .counts = &counts,
                                  .warnings = warnings};
      SbSealState state;
      g_assert_cmpint(sb_sliding_solve(&state, &task, NULL), ==, SB_OK);
      const SbFit *fit = sb_sliding_fit(memory);
      g_assert_cmpint(state.section, ==, SB_RING_SLIDES);
      g_assert_cmpfloat(fit->ring.axial_imbalance, <, 1e-8);
      double friction = sb_sliding_friction(&state);
      g_assert_cmpfloat_with_epsilon(friction, fabs(fit->ring.drag), 1e-12 * friction);
      // The law of the state as it is told.
      double shear = (state.boundary_area + state.friction_viscous) / state.area_cut /
                     (fit->contact_width * fit->circumference);
      double sum = 0;
      for (size_t i = 1; i < fit->profile_count; i++) {
        double p = 0.5 * (fit->profile_p[i] + fit->profile_p[i - 1]);
        sum += (model->load_coefficient * p + fmin(shear, p)) *
               (fit->profile_x[i] - fit->profile_x[i - 1]);
      }
      g_test_message("%s %d: %.6g N of %.6g N, imbalance %.1e", sb_seal_name(seal), way, friction,
                     sum * fit->circumference, fit->ring.axial_imbalance);
      g_assert_cmpfloat_with_epsilon(sum * fit->circumference, friction, 3e-3 * friction);
      g_assert_cmpfloat_with_epsilon(state.boundary_load, model->load_coefficient * fit->load,
                                     3e-3 * friction);
      // Once more from there: the same ring, nothing solved again.
      SbSealState again;
      size_t fits = counts.fit_solves;
      g_assert_cmpint(sb_sliding_solve(&again, &task, NULL), ==, SB_OK);
      g_assert_cmpuint(counts.fit_solves, ==, fits);
      g_assert_cmpfloat_with_epsilon(sb_sliding_friction(&again), friction, 1e-6 * friction);
      sb_sliding_memory_destroy(memory);
    }
  }
  g_free(warnings);
  sb_model_destroy(model);
}

// Solves the state of one seal on the in-stroke.
static void solve_state(SbSealState *out, const SbModel *model, int seal, double speed) {
  SbCounters counts = {0};
  SbSlidingMemory *memory;
  g_assert_cmpint(sb_sliding_memory_create(&memory, NULL), ==, SB_OK);
  const SbSlidingTask task = {.model = model,
                              .seal = seal,
                              .pressure = sb_model_seal_pressure(model, seal, SB_CHAMBER_AT_REST),
                              .speed = speed,
                              .memory = memory,
                              .counts = &counts};
  g_assert_cmpint(sb_sliding_solve(out, &task, NULL), ==, SB_OK);
  sb_sliding_memory_destroy(memory);
}

static bool within(double one, double other, double error) {
  return fabs(one / other - 1) <= 3 * error;
}

// A tolerance of 2 % lets the friction that drags a ring and that of its film differ by up to 1 %.
// Load, width, peak and friction have errors that cover this: they are within three times their
// errors of the values at a tolerance of 1e-3, whose difference is 20 times as small.
static void test_difference(void) {
  const Setting settings[] = {{SB_P_MODELS_SET, SB_MODEL_SET_CONSISTENT},
                              {SB_P_SEAL_PROFILE, SB_SEAL_PROFILE_D},
                              {SB_P_SEAL_AXIAL_HEIGHT, 1.4e-3},
                              {SB_P_SEAL_CORNER_RADIUS, 0.15e-3},
                              {SB_P_GLAND_RADIAL_SPACE, 1.36117e-3},
                              {SB_P_SEAL_MODULUS, 5.60603e6},
                              {SB_P_CANISTER_PRESSURE, 0.573201e6},
                              {SB_P_DRIVE_SPEED, 0.02 / 60},
                              {SB_P_OUTPUT_TOLERANCE, 2e-2}};
  Setting finer[G_N_ELEMENTS(settings)];
  memcpy(finer, settings, sizeof settings);
  finer[G_N_ELEMENTS(settings) - 1].value = 1e-3;
  SbModel rough, fine;
  compile(&rough, settings, G_N_ELEMENTS(settings));
  compile(&fine, finer, G_N_ELEMENTS(settings));
  for (int seal = 0; seal < SB_SEAL_COUNT; seal++) {
    SbSealState one, other;
    solve_state(&one, &rough, seal, rough.speed);
    solve_state(&other, &fine, seal, fine.speed);
    const double friction = sb_sliding_friction(&one);
    g_test_message("load %.6g N (%.2g), %.6g N (%.2g); friction %.6g N (%.2g), %.6g N (%.2g)",
                   one.load, one.load_error, other.load, other.load_error, friction,
                   one.friction_error / friction, sb_sliding_friction(&other),
                   other.friction_error / sb_sliding_friction(&other));
    g_assert_true(within(one.load, other.load, one.load_error));
    g_assert_true(within(one.load_net, other.load_net, one.net_error));
    g_assert_true(within(one.pressure_peak, other.pressure_peak, one.peak_error));
    g_assert_true(within(one.contact_right - one.contact_left,
                         other.contact_right - other.contact_left, one.width_error));
    g_assert_true(within(friction, sb_sliding_friction(&other), one.friction_error / friction));
    // The difference decreases with the tolerance, and so does what it adds to the errors.
    g_assert_cmpfloat(fabs(one.borne_share - 1), >, 1e-3);
    g_assert_cmpfloat(other.load_error, <, one.load_error);
    g_assert_cmpfloat(one.friction_error, >=, 0.999 * fabs(friction / one.borne_share - friction));
  }
}

// Where the pressure is below the shear of a film that is thicker than the asperities, real area
// and viscous friction are limited in proportion: neither is negative, and both together with the
// boundary friction are what drags the ring.
static void test_thick_film(void) {
  const SbOverride thick[] = {{SB_P_SURFACE_SIGMA, 1e-8}, {SB_P_FRICTION_LOAD_COEFFICIENT, 0}};
  SbModel *model = ring_model(thick, G_N_ELEMENTS(thick));
  for (int seal = 0; seal < SB_SEAL_COUNT; seal++) {
    SbSealState state;
    solve_state(&state, model, seal, 0.6);
    g_test_message("real area %.3g, viscous %.4g N, limited to %.6g", state.real_area_share,
                   state.friction_viscous, state.area_cut);
    g_assert_cmpfloat(state.friction_viscous, >, 0);
    g_assert_cmpfloat(state.real_area_share, <, 1e-6);
    g_assert_cmpfloat(state.real_area_share, >=, 0);
    g_assert_cmpfloat(state.rest_area_share, >=, 0);
    g_assert_cmpfloat(state.boundary_area, >=, 0);
    g_assert_true(state.area_cut > 0 && state.area_cut < 1);
  }
  sb_model_destroy(model);
}

// Without fluid the return is the in-stroke mirrored: no ring is solved for it, and it is that of a
// return solved for itself.
static void test_mirrored(void) {
  const SbOverride quick[] = {{SB_P_OUTPUT_TOLERANCE, 1e-2}};
  SbModel *model = ring_model(quick, 1);
  SbCounters counts = {0};
  SbWarnings *warnings = g_new0(SbWarnings, 1);
  SbSealState state[2][2];
  for (int both = 0; both < 2; both++) {
    SbSlidingMemory *memory;
    g_assert_cmpint(sb_sliding_memory_create(&memory, NULL), ==, SB_OK);
    for (int way = both ? 1 : -1; way >= -1; way -= 2) {
      const SbSlidingTask task = {.model = model,
                                  .seal = SB_INNER,
                                  .pressure =
                                      sb_model_seal_pressure(model, SB_INNER, SB_CHAMBER_AT_REST),
                                  .speed = way * model->speed,
                                  .memory = memory,
                                  .counts = &counts,
                                  .warnings = warnings};
      const size_t before = counts.ring_solves;
      g_assert_cmpint(sb_sliding_solve(&state[both][way < 0], &task, NULL), ==, SB_OK);
      g_assert_true((counts.ring_solves == before) == (both && way < 0));
    }
    sb_sliding_memory_destroy(memory);
  }
  const SbSealState *in = &state[1][0], *back = &state[1][1], *alone = &state[0][1];
  g_assert_cmpfloat_with_epsilon(back->contact_left, -in->contact_right, 1e-9);
  g_assert_cmpfloat_with_epsilon(back->rotation, in->rotation, 1e-6);
  g_assert_cmpfloat_with_epsilon(back->load, alone->load, 1e-4 * alone->load);
  g_assert_cmpfloat_with_epsilon(back->contact_left, alone->contact_left, 1e-7);
  g_assert_cmpfloat_with_epsilon(sb_sliding_friction(back), sb_sliding_friction(alone),
                                 1e-3 * sb_sliding_friction(alone));
  g_free(warnings);
  sb_model_destroy(model);
}

// No film lies on a ring at rest beside asperities: its surface is not made, nor its mesh for it.
static void test_rest(void) {
  const SbOverride film[] = {{SB_P_MODELS_FILM, SB_FILM_REYNOLDS}};
  SbModel *model = ring_model(film, 1);
  SbCounters counts = {0};
  SbSlidingMemory *memory;
  g_assert_cmpint(sb_sliding_memory_create(&memory, NULL), ==, SB_OK);
  const SbSlidingTask task = {.model = model,
                              .seal = SB_INNER,
                              .pressure =
                                  sb_model_seal_pressure(model, SB_INNER, SB_CHAMBER_AT_REST),
                              .memory = memory,
                              .counts = &counts};
  SbSealState state;
  g_assert_cmpint(sb_sliding_solve(&state, &task, NULL), ==, SB_OK);
  const SbFit *fit = sb_sliding_fit(memory);
  g_assert_cmpint(fit->surface.modes, ==, 0);
  g_assert_cmpfloat(fit->solver.error_estimate.load, <=, model->tolerance);
  g_test_message("%zu unknowns", fit->solver.unknowns);
  g_assert_cmpuint(fit->solver.unknowns, <, 4500);
  sb_sliding_memory_destroy(memory);
  sb_model_destroy(model);
}

// Two threads for the thread sanitizer to watch; the bits are the affair of `threads`.
static void test_races(void) {
  const SbOverride few[] = {{SB_P_OUTPUT_TOLERANCE, 1e-2},
                            {SB_P_FRICTION_SHEAR_STRENGTH, 1e6},
                            {SB_P_OUTPUT_FRAMES, 4},
                            {SB_P_OUTPUT_VIEWS, 0}};
  SbModel *model = ring_model(few, G_N_ELEMENTS(few));
  SbRun *run = execute(model, false);
  g_assert_true(
      isfinite(sb_figure_value(sb_run_summary(run), sb_figure_find("cycle.force_peak_N"))));
  sb_run_destroy(run);
  sb_model_destroy(model);
}

// One thread or two: the same bits.
static void test_threads(void) {
  const SbOverride quick[] = {{SB_P_OUTPUT_TOLERANCE, 1e-2}, {SB_P_FRICTION_SHEAR_STRENGTH, 1e6}};
  SbModel *model = ring_model(quick, G_N_ELEMENTS(quick));
  SbRun *one = execute(model, true), *two = execute(model, false);
  for (int i = 0; i < SB_FIGURE_COUNT; i++) {
    double a = sb_figure_value(sb_run_summary(one), i), b = sb_figure_value(sb_run_summary(two), i);
    if (memcmp(&a, &b, sizeof a) != 0) {
      g_error("%s: %.17g and %.17g", sb_figure(i)->path, a, b);
    }
  }
  g_assert_cmpuint(sb_run_summary(one)->work, ==, sb_run_summary(two)->work);
  size_t count, other;
  const SbFrame *frames = sb_run_frames(one, &count), *others = sb_run_frames(two, &other);
  g_assert_cmpuint(count, ==, other);
  for (size_t k = 0; k < count; k++) {
    g_assert_true(frames[k].time == others[k].time && frames[k].force == others[k].force);
    for (int i = 0; i < SB_SEAL_COUNT; i++) {
      const SbSealFrame *a = &frames[k].seal[i], *b = &others[k].seal[i];
      g_assert_true(a->contact_left == b->contact_left && a->contact_right == b->contact_right);
      g_assert_true(a->load == b->load && a->friction == b->friction && a->shape == b->shape);
    }
  }
  for (uint32_t i = 0; i < SB_RUN_SHAPES_MAX; i++) {
    const SbSealShape *a = sb_run_shape(one, i), *b = sb_run_shape(two, i);
    g_assert_true((a == NULL) == (b == NULL));
    if (a != NULL) {
      g_assert_cmpuint(a->nodes, ==, b->nodes);
      g_assert_cmpint(memcmp(a->place, b->place, 2 * a->nodes * sizeof *a->place), ==, 0);
    }
  }
  sb_run_destroy(one);
  sb_run_destroy(two);
  sb_model_destroy(model);
}

static bool at_once(void *data) {
  ++*(int *)data;
  return *(int *)data > 3;
}

// Asked on the caller's thread, both stop.
static void test_cancelled(void) {
  SbModel *model = ring_model(NULL, 0);
  SbPlan plan;
  SbRun *run;
  int asked = 0;
  const SbRunHooks hooks = {.cancelled = at_once, .data = &asked};
  sb_plan_make(&plan, model);
  g_assert_cmpint(sb_run_create(&run, model, &plan, NULL), ==, SB_OK);
  g_assert_cmpint(sb_run_execute(run, &hooks, NULL), ==, SB_ERROR_CANCELLED);
  sb_run_destroy(run);
  sb_model_destroy(model);
}

// More friction than the sections bear is a result: state, share and turn are told.
static void test_rolls(void) {
  const SbOverride rough[] = {{SB_P_GLAND_FLOOR_FRICTION, 0},
                              {SB_P_GLAND_WALL_FRICTION, 0},
                              {SB_P_FRICTION_SHEAR_STRENGTH, 3.5e6},
                              {SB_P_OUTPUT_TOLERANCE, 1e-2},
                              {SB_P_OUTPUT_VIEWS, 0}};
  SbModel *model = ring_model(rough, G_N_ELEMENTS(rough));
  SbRun *run = execute(model, false);
  const SbSummary *summary = sb_run_summary(run);
  for (int seal = 0; seal < SB_SEAL_COUNT; seal++) {
    const SbContact *in = &summary->contact[seal].in_stroke;
    g_assert_cmpint(in->section, ==, SB_RING_ROLLS);
    g_assert_cmpfloat(in->rotation, >, 30);
    // ring-friction.md: greatest steady drag over load, Coulomb's law, to 4 % there; this one acts
    // more evenly over the contact.
    double limit = seal == SB_OUTER ? 0.203 : 0.470;
    g_assert_cmpfloat_with_epsilon(in->friction / in->load, limit, 0.06 * limit);
    g_assert_cmpfloat_with_epsilon(summary->seal[seal].friction_static, in->friction,
                                   1e-9 * in->friction);
  }
  g_assert_true(warned(summary, "ring-rolls"));
  const SbVerdict *seals = &summary->verdict[SB_VERDICT_SEALS];
  g_assert_cmpint(seals->ok, ==, SB_ANSWER_YES);
  g_assert_nonnull(strstr(seals->reason, "rolls"));
  sb_run_destroy(run);
  sb_model_destroy(model);
}

int main(int argc, char **argv) {
  g_test_init(&argc, &argv, NULL);
  g_test_add_func("/run-ring/one-state", test_one_state);
  g_test_add_func("/run-ring/beside", test_beside);
  g_test_add_func("/run-ring/balance", test_balance);
  g_test_add_func("/run-ring/difference", test_difference);
  g_test_add_func("/run-ring/thick-film", test_thick_film);
  g_test_add_func("/run-ring/jump", test_jump);
  g_test_add_func("/run-ring/mirrored", test_mirrored);
  g_test_add_func("/run-ring/rest", test_rest);
  g_test_add_func("/run-ring/races", test_races);
  g_test_add_func("/run-ring/threads", test_threads);
  g_test_add_func("/run-ring/cancelled", test_cancelled);
  g_test_add_func("/run-ring/rolls", test_rolls);
  return g_test_run();
}
