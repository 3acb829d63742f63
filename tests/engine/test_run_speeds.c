// Film and friction of the instant: a frame has those of a run that slides steadily at the frame's
// speed, all of one state; over the speeds from 1 um/s to 5 m/s.
#include "engine/valve/run/run_private.h"
#include "tests/engine/motion_run.h"

enum { SAMPLES = 40 };

static void relative(const char *what, double a, double b, double tolerance) {
  if (!(fabs(a - b) <= tolerance * fabs(b))) {
    g_error("%s: %.9g against %.9g", what, a, b);
  }
}

// The steady run at a speed, with settings of its own.
static SbRun *steady_run(double speed, const Setting *settings, size_t count) {
  Setting all[8] = {{SB_P_DRIVE_SPEED, speed}, {SB_P_OUTPUT_FRAMES, 50}};
  for (size_t i = 0; i < count; i++) {
    all[2 + i] = settings[i];
  }
  return run_with(SB_MODEL_MOTION_QUASI_STATIC, all, 2 + count);
}

// What a frame says of a seal belongs together.
static void check_identities(const SbModel *model, const SbSealFrame *seal) {
  double area = (seal->contact_right - seal->contact_left) * model->bore_circumference;
  double boundary =
      model->shear_strength * seal->real_area_share * area + model->load_coefficient * seal->load;
  relative("lambda", seal->lambda, seal->film_central / model->sigma, 1e-9);
  relative("boundary friction", fabs(seal->friction_boundary), boundary, 1e-9);
  relative("friction", seal->friction, seal->friction_boundary + seal->friction_viscous, 1e-9);
}

// A press by hand: in and back at speeds that change throughout.
static void test_hand(void) {
  const Setting hand[] = {{SB_P_DRIVE_KIND, SB_MODEL_DRIVE_HAND},
                          {SB_P_DRIVE_FINGER_DAMPING, 100},
                          {SB_P_OUTPUT_FRAMES, 600}};
  SbRun *run = run_with(SB_MODEL_MOTION_DYNAMIC, hand, G_N_ELEMENTS(hand));
  const SbModel *model = sb_run_model(run);
  size_t count, moving = 0, seen = 0;
  const SbFrame *frames = sb_run_frames(run, &count);
  for (size_t i = 0; i < count; i++) {
    moving += fabs(frames[i].velocity) > 1e-6;
  }
  double worst = 0, slowest = INFINITY, fastest = 0;
  for (size_t i = 0; i < count; i++) {
    const SbFrame *frame = &frames[i];
    bool in = frame->velocity > 0 && frame->chamber == SB_CHAMBER_AT_REST;
    bool back = frame->velocity < 0 && frame->chamber == SB_CHAMBER_CLOSED;
    if (!(fabs(frame->velocity) > 1e-6)) {
      continue;
    }
    for (int k = 0; k < SB_SEAL_COUNT; k++) {
      if (frame->seal[k].land_fraction == 1) {
        check_identities(model, &frame->seal[k]);
      }
    }
    if (!(in || back) || (moving > SAMPLES && i % (moving / SAMPLES) != 0)) {
      continue;
    }
    SbRun *steady = steady_run(fabs(frame->velocity), NULL, 0);
    for (int k = 0; k < SB_SEAL_COUNT; k++) {
      const SbContact *contact = in ? &sb_run_summary(steady)->contact[k].in_stroke
                                    : &sb_run_summary(steady)->contact[k].back;
      const SbSealFrame *seal = &frame->seal[k];
      if (seal->land_fraction == 1) {
        relative("steady friction", fabs(seal->friction), contact->friction, 0.02);
        relative("steady film", seal->film_central, contact->film_central, 1e-9);
        relative("steady real area", seal->real_area_share, contact->real_area_share, 1e-9);
        worst = fmax(worst, fabs(fabs(seal->friction) / contact->friction - 1));
        slowest = fmin(slowest, fabs(frame->velocity));
        fastest = fmax(fastest, fabs(frame->velocity));
        seen++;
      }
    }
    sb_run_destroy(steady);
  }
  g_test_message("%zu seals in frames from %.2g to %.2g m/s, friction off by %.1e", seen, slowest,
                 fastest, worst);
  g_assert_cmpuint(seen, >, 20);
  g_assert_cmpfloat(fastest, >, 1);
  sb_run_destroy(run);
}

// States between the solved ones against solved ones: thesis' law, solved films, with asperities.
static void test_sweep(void) {
  const Setting kinds[][3] = {
      {{SB_P_OUTPUT_FRAMES, 50}, {SB_P_OUTPUT_FRAMES, 50}, {SB_P_OUTPUT_FRAMES, 50}},
      {{SB_P_MODELS_FILM, SB_FILM_REYNOLDS},
       {SB_P_MODELS_FIT, SB_FIT_DISC},
       {SB_P_OUTPUT_FRAMES, 50}},
      {{SB_P_MODELS_FILM, SB_FILM_REYNOLDS},
       {SB_P_MODELS_ASPERITIES, SB_MODEL_ASPERITIES_COUPLED},
       {SB_P_SURFACE_SIGMA, 0.2e-6}}};
  // Solved films take a second each, with asperities more: the ends and one between.
  const double speeds[] = {1e-6, 1.7e-3, 5, 3.7e-5, 2.3e-4, 4.1e-2, 0.39, 2.3};
  for (size_t kind = 0; kind < G_N_ELEMENTS(kinds); kind++) {
    SbRun *run = steady_run(1e-3, kinds[kind], 3);
    double worst = 0;
    for (size_t i = 0; i < (kind < 1 ? G_N_ELEMENTS(speeds) : 3); i++) {
      SbRun *steady = steady_run(speeds[i], kinds[kind], 3);
      for (int in = 0; in < 2; in++) {
        const SbContact *contact = in ? &sb_run_summary(steady)->contact[SB_OUTER].in_stroke
                                      : &sb_run_summary(steady)->contact[SB_OUTER].back;
        SbSealState state;
        sb_run_state_at(&state, run, SB_OUTER, in ? SB_CHAMBER_AT_REST : SB_CHAMBER_CLOSED,
                        in ? SB_CYCLE_IN : SB_CYCLE_OUT, speeds[i]);
        double friction = sb_sliding_friction(&state);
        relative("film", state.film_central, contact->film_central, 2e-3);
        relative("least film", state.film_min, contact->film_min, 2e-3);
        relative("friction", friction, contact->friction, 2e-3);
        relative("lambda", state.lambda, state.film_central / sb_run_model(run)->sigma, 1e-12);
        worst = fmax(worst, fabs(state.film_central / contact->film_central - 1));
        worst = fmax(worst, fabs(friction / contact->friction - 1));
      }
      sb_run_destroy(steady);
    }
    const SbSpeedStates *table = run->speeds[SB_OUTER][SB_CHAMBER_AT_REST][SB_CYCLE_IN];
    g_assert_nonnull(table);
    g_test_message("kind %zu: off by %.1e, told %.1e, %zu nodes", kind, worst, table->error,
                   table->nodes);
    // What is told covers what it is off by; the narrowest cell may miss by more than the
    // tolerance.
    g_assert_true(kind == 0 ? table->nodes == 0 : worst <= table->error && table->error <= 1e-3);
    sb_run_destroy(run);
  }
}

// Below 1 um/s the table's end holds, which is the friction without a film.
static void test_slowest(void) {
  SbRun *run = steady_run(1e-3, NULL, 0);
  for (int seal = 0; seal < SB_SEAL_COUNT; seal++) {
    SbSealState slow, slower;
    sb_run_state_at(&slow, run, seal, SB_CHAMBER_AT_REST, SB_CYCLE_IN, 1e-6);
    sb_run_state_at(&slower, run, seal, SB_CHAMBER_AT_REST, SB_CYCLE_IN, 1e-9);
    g_assert_cmpfloat(slow.film_central, ==, slower.film_central);
    relative("boundary limit", sb_sliding_friction(&slow), slow.rest_area + slow.rest_load, 1e-3);
  }
  sb_run_destroy(run);
}

// Films in time: what a frame says of its film goes with it.
static void test_history(void) {
  const Setting settings[] = {
      {SB_P_MODELS_FILM, SB_FILM_REYNOLDS}, {SB_P_MODELS_FILM_TIME, 1}, {SB_P_OUTPUT_FRAMES, 40}};
  SbRun *run = run_with(SB_MODEL_MOTION_QUASI_STATIC, settings, G_N_ELEMENTS(settings));
  size_t count, seen = 0, off = 0;
  const SbFrame *frames = sb_run_frames(run, &count);
  for (size_t i = 0; i < count; i++) {
    const SbSealFrame *seal = &frames[i].seal[SB_OUTER];
    if (frames[i].velocity != 0 && isfinite(seal->film_central)) {
      check_identities(sb_run_model(run), seal);
      seen++;
      off += fabs(seal->film_central / sb_run_summary(run)->seal[SB_OUTER].film_central - 1) > 0.05;
    }
  }
  g_assert_cmpuint(seen, >, 20);
  g_assert_cmpuint(off, >, 0);
  sb_run_destroy(run);
}

int main(int argc, char **argv) {
  g_test_init(&argc, &argv, NULL);
  g_test_add_func("/run-speeds/hand", test_hand);
  g_test_add_func("/run-speeds/sweep", test_sweep);
  g_test_add_func("/run-speeds/slowest", test_slowest);
  g_test_add_func("/run-speeds/history", test_history);
  return g_test_run();
}
