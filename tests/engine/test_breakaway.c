// Break-away: the film's squeeze-out against an integration of Reynolds' equation, the law of rest
// and its table, and what cycle, motion and repeated strokes make of it.
#include "engine/contact/rough/greenwood_tripp.h"
#include "engine/film/squeeze.h"
#include "engine/valve/states/breakaway.h"
#include "engine/valve/states/sliding.h"
#include "models.h"
#include "near.h"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_odeiv2.h>

// Mean pressure [Pa] in a gap h that closes at 1 m/s: d/dx (h^3/(12 eta) dp/dx) = -1, p = 0 at +-b,
// by finite volumes; with n cells the error is of order 1/n^2.
static double mean_pressure(double h, double b, double eta, int n) {
  double dx = 2 * b / n, conductance = h * h * h / (12 * eta) / dx, flow = 0, p = 0, mean = 0;
  // By symmetry no flow through the middle: it grows from there, and the pressure from the end in.
  for (int i = n / 2; i < n; i++) {
    flow += dx;
  }
  for (int i = n - 1; i >= n / 2; i--) {
    // From the face at the end, half a cell; from cell to cell, a whole one.
    p += flow / conductance * (i == n - 1 ? 0.5 : 1);
    flow -= dx;
    mean += 2 * p / n;
  }
  return mean;
}

typedef struct {
  double b, eta, pressure;
  const SbRoughLaw *law;
} Gap;

static int closing(double t, const double h[], double rate[], void *user) {
  const Gap *gap = user;
  SbRoughPoint at = {.pressure = 0};
  if (gap->law != NULL) {
    sb_rough_law_at(&at, gap->law, sb_rough_law_of_gap(gap->law, h[0]));
  }
  rate[0] = -(gap->pressure - at.pressure) / mean_pressure(h[0], gap->b, gap->eta, 1000);
  return GSL_SUCCESS;
}

static void test_squeeze(void) {
  static const SbRoughSurface surface = {SB_ROUGH_GREENWOOD_TRIPP, 0.1, 0.2e-6, 0.1, 6e6, 0, 0};
  SbRoughLaw law;
  g_assert_cmpint(sb_rough_law_init(&law, &surface, NULL), ==, SB_OK);
  for (int rough = 0; rough < 2; rough++) {
    Gap gap = {0.3e-3, 0.3e-3, 0.2e6, rough ? &law : NULL};
    const double film = 0.8e-6;
    SbSqueeze s;
    sb_squeeze_init(&s, film, gap.pressure, gap.b, gap.eta, gap.law);
    gsl_odeiv2_system system = {closing, NULL, 1, &gap};
    gsl_odeiv2_driver *driver =
        gsl_odeiv2_driver_alloc_y_new(&system, gsl_odeiv2_step_rkf45, 1e-8, 0, 1e-10);
    double t = 0, h = film, scale = sb_squeeze_time(&s, (film + s.rest) / 2);
    for (int i = -6; i <= 6; i++) {
      double end = scale * exp2(i);
      g_assert_cmpint(gsl_odeiv2_driver_apply(driver, &t, end, &h), ==, GSL_SUCCESS);
      assert_close(sb_squeeze_film(&s, end), h, 1e-6);
      if (h > s.rest * (1 + 1e-4)) {
        assert_close(sb_squeeze_time(&s, h), end, 1e-5);
      }
    }
    gsl_odeiv2_driver_free(driver);
    assert_close(sb_squeeze_film(&s, 0), film, 1e-15);
    double last = sb_squeeze_film(&s, 1e9 * scale);
    if (rough) {
      SbRoughPoint at;
      sb_rough_law_at(&at, &law, sb_rough_law_of_gap(&law, last));
      assert_close(at.pressure, gap.pressure, 1e-9);
    } else {
      assert_close(last, sqrt(2 * gap.eta / (gap.pressure * 1e9 * scale)) * gap.b, 1e-6);
    }
  }
}

static double bent(double t, const void *context) {
  return 10 + 5 * t / (t + 2) + 0.3 * log1p(t / *(const double *)context);
}

static void test_table(void) {
  const double ageing = 1e-4;
  SbDwellLaw law;
  sb_dwell_table(&law, bent, &ageing, ageing, 2);
  g_assert_cmpuint(law.count, <=, SB_DWELL_PIECES);
  double before = 0;
  for (double t = 1e-9; t < 1e9; t *= 1.07) {
    double now = sb_dwell_at(&law, t);
    assert_close(now, bent(t, &ageing), 3e-4);
    g_assert_cmpfloat(now, >=, before);
    before = now;
  }
  ASSERT_NEAR(sb_dwell_at(&law, 0), 10, 1e-15);
}

// Forces of the default outer seal's law after rests from far below to far above the squeeze-out.
static void test_limits(void) {
  for (int persson = 0; persson < 2; persson++) {
    SbModel model;
    const Setting settings[] = {{SB_P_FRICTION_BREAKAWAY, 1},
                                {SB_P_MODELS_SURFACE, persson},
                                {SB_P_SURFACE_SIGMA, 0.05e-6},
                                {SB_P_DRIVE_SPEED, 0.05}};
    compile(&model, settings, G_N_ELEMENTS(settings));
    SbRun *run = run_of(&model, SB_OK, NULL);
    const SbSealState *state = &sb_run_summary(run)->seal[SB_OUTER];
    SbDwellLaw law;
    double squeeze;
    g_assert_cmpint(sb_breakaway_law(&law, &squeeze, &model, SB_OUTER, state, NULL, NULL), ==,
                    SB_OK);
    assert_close(squeeze, state->squeeze_out_time, 1e-12);
    double kinetic = sb_sliding_friction(state);
    double dry = state->boundary_area;
    if (!persson) {
      // The film matters here.
      dry = model.shear_strength * sb_gt_area_share(model.gt_product, 0) *
            model.bore_circumference * (state->contact_right - state->contact_left);
      g_assert_cmpfloat(dry, >, 1.2 * state->boundary_area);
    }
    assert_close(sb_dwell_at(&law, 0), kinetic, 1e-12);
    double brief = 1e-6 * fmin(squeeze, model.ageing_time), before = 0;
    assert_close(sb_dwell_at(&law, brief), kinetic, 1e-5);
    double t = 1e6 * fmax(squeeze, model.ageing_time);
    assert_close(
        sb_dwell_at(&law, t),
        dry * (1 + model.ageing_gain * log1p(t / model.ageing_time)) + state->boundary_load, 1e-3);
    for (t = brief; t < 1e9; t *= 1.3) {
      // Independently: Reynolds' squeeze of the film, Greenwood and Tripp's area under it.
      double b = (state->contact_right - state->contact_left) / 2;
      double pressure = state->load_net / (2 * b), h0 = state->film_central;
      double h = 1 / sqrt(1 / (h0 * h0) + pressure * t / (2 * model.viscosity * b * b));
      double share =
          persson ? state->real_area_share : sb_gt_area_share(model.gt_product, h / model.sigma);
      double area = model.shear_strength * share * model.bore_circumference * 2 * b;
      double force = area * (1 + model.ageing_gain * log1p(t / model.ageing_time)) +
                     model.load_coefficient * state->load;
      assert_close(sb_dwell_at(&law, t), fmax(force, kinetic), 3e-4);
      g_assert_cmpfloat(sb_dwell_at(&law, t), >=, before);
      before = sb_dwell_at(&law, t);
    }
    sb_run_destroy(run);
  }
}

// Asperities that share the load: between their own sliding and dry contact, in the film's time.
static void test_coupled(void) {
  SbModel model;
  const Setting settings[] = {
      {SB_P_FRICTION_BREAKAWAY, 1},         {SB_P_FRICTION_AGEING, 0},
      {SB_P_MODELS_FILM, SB_FILM_REYNOLDS}, {SB_P_MODELS_ASPERITIES, SB_MODEL_ASPERITIES_COUPLED},
      {SB_P_SURFACE_SIGMA, 0.2e-6},         {SB_P_DRIVE_SPEED, 0.05}};
  compile(&model, settings, G_N_ELEMENTS(settings));
  SbRun *run = run_of(&model, SB_OK, NULL);
  const SbSealState *state = &sb_run_summary(run)->seal[SB_OUTER];
  SbDwellLaw law;
  double squeeze;
  g_assert_cmpint(sb_breakaway_law(&law, &squeeze, &model, SB_OUTER, state, NULL, NULL), ==, SB_OK);
  double dry = state->rest_area + state->rest_load;
  g_assert_cmpfloat(squeeze, >, 0);
  g_assert_cmpfloat(dry, >, 1.01 * sb_sliding_friction(state));
  assert_close(sb_dwell_at(&law, 0), sb_sliding_friction(state), 1e-12);
  assert_close(sb_dwell_at(&law, 1e6 * squeeze), dry, 1e-6);
  double half = (sb_dwell_at(&law, squeeze) - sb_sliding_friction(state)) /
                (dry - sb_sliding_friction(state));
  // Real contact grows fastest at the end of the film.
  g_assert_cmpfloat(half, >, 0.05);
  g_assert_cmpfloat(half, <, 0.5);
  sb_run_destroy(run);
}

static double time_of(const SbModel *model, const SbSealState *state) {
  SbDwellLaw law;
  double time;
  g_assert_cmpint(sb_breakaway_law(&law, &time, model, SB_OUTER, state, NULL, NULL), ==, SB_OK);
  return time;
}

static double error_of(const SbModel *model, const SbSealState *state) {
  double error;
  g_assert_cmpint(sb_breakaway_squeeze_error(&error, model, SB_OUTER, state, NULL, NULL), ==,
                  SB_OK);
  return error;
}

// The error of the squeeze-out's time is what the time itself changes with each error of the state.
// The asperities' fraction of the load has many times its own error's effect.
static void test_error(void) {
  SbModel model;
  const Setting settings[] = {{SB_P_MODELS_FILM, SB_FILM_REYNOLDS},
                              {SB_P_MODELS_ASPERITIES, SB_MODEL_ASPERITIES_COUPLED},
                              {SB_P_SURFACE_SIGMA, 1e-6},
                              {SB_P_DRIVE_SPEED, 3e-4}};
  compile(&model, settings, G_N_ELEMENTS(settings));
  SbRun *run = run_of(&model, SB_OK, NULL);
  SbSealState state = sb_run_summary(run)->seal[SB_OUTER];
  state.central_error = state.net_error = state.width_error = state.share_error = 0;
  g_assert_cmpfloat(error_of(&model, &state), ==, 0);
  state.central_error = NAN; // a closed form
  g_assert_cmpfloat(error_of(&model, &state), ==, 0);
  state.central_error = 0;
  const double time = time_of(&model, &state), error = 0.01;
  SbSealState more = state, less = state;
  more.asperity_share *= 1 + error;
  less.asperity_share *= 1 - error;
  const double share = fabs(time_of(&model, &more) - time_of(&model, &less)) / 2;
  state.share_error = error;
  assert_close(error_of(&model, &state), share / time, 1e-6);
  g_test_message("%.4g s, %.3g for a share off by %.2g", time, share / time, error);
  g_assert_cmpfloat(share, >, 2 * error * time);
  // Those of load and width are part of the share's, and are added by themselves.
  state.share_error = error + 0.004;
  state.net_error = 0.003;
  state.width_error = 0.001;
  g_assert_cmpfloat(error_of(&model, &state), >, share / time);
  state.share_error = 0.004;
  g_assert_cmpfloat(error_of(&model, &state), <, 0.03);
  sb_run_destroy(run);
}

// The first peak grows with the rest before it, alike in the cycle and in the motion with inertia,
// and each later one with the pause before it: start, stop, start.
static void test_start_stop(void) {
  const double rest[] = {0, 0.01, 1, 100, 1e5};
  double before = 0, peak[2];
  for (size_t i = 0; i < G_N_ELEMENTS(rest); i++) {
    for (int dynamic = 0; dynamic < 2; dynamic++) {
      SbModel model;
      const Setting settings[] = {{SB_P_FRICTION_BREAKAWAY, 1},
                                  {SB_P_SURFACE_SIGMA, 0.05e-6},
                                  {SB_P_FRICTION_LOAD_COEFFICIENT, 0},
                                  {SB_P_DRIVE_REST, rest[i]},
                                  {SB_P_MODELS_MOTION, dynamic}};
      compile(&model, settings, G_N_ELEMENTS(settings));
      SbRun *run = run_of(&model, SB_OK, NULL);
      const SbSummary *summary = sb_run_summary(run);
      peak[dynamic] = summary->force_breakaway;
      g_assert_cmpfloat(summary->energy.closure, <, 1e-6);
      sb_run_destroy(run);
    }
    assert_close(peak[1], peak[0], 1e-4);
    g_assert_cmpfloat(peak[0], >, before);
    before = peak[0];
  }
}

// A stem on two rigid contacts with laws of their own, pulled, stopped for ever longer, and pulled:
// each peak is what both hold after that stop.
typedef struct {
  SbDwellLaw law[2];
  double force[16], time[16];
  int slips;
} Bench;

static const double level[2] = {3, 5};

static void bench_loads(SbDynamicsLoads *loads, double x, size_t region, const double *extra,
                        void *user) {
  Bench *bench = user;
  for (int i = 0; i < 2; i++) {
    loads->level[i] = level[i];
    loads->rest[i] = &bench->law[i];
  }
  loads->constant = true;
}

static void bench_event(const SbMotionEvent *event, void *user) {
  Bench *bench = user;
  if (event->kind == SB_MOTION_SLIP && bench->slips < 16) {
    bench->force[bench->slips] = event->drive_force;
    bench->time[bench->slips++] = event->time;
  }
}

static double light(double t, const void *context) {
  return 1 + *(const double *)context * t / (t + 0.3) + 0.02 * log1p(t / 1e-3);
}

static void test_stops(void) {
  Bench bench = {.slips = 0};
  const double rise[2] = {0.5, 1.5};
  for (int i = 0; i < 2; i++) {
    sb_dwell_table(&bench.law[i], light, &rise[i], 1e-3, 0.3);
  }
  enum { STOPS = 6 };
  // The platen goes back a little, so that the stem rests at once, and waits.
  double time[2 + 3 * STOPS] = {0, 1}, value[2 + 3 * STOPS] = {0, 1e-2};
  for (int i = 0; i < STOPS; i++) {
    double *t = &time[2 + 3 * i], *y = &value[2 + 3 * i], wait = 1e-3 * pow(10, i);
    t[0] = t[-1] + 1e-4;
    y[0] = y[-1] - 1e-3;
    t[1] = t[0] + wait;
    y[1] = y[0];
    t[2] = t[1] + 1;
    y[2] = y[1] + 1e-2;
  }
  SbDynamicsModel m = {
      .mass = 1e-3,
      .contacts = 2,
      .contact = {{.static_ratio = 1, .stiffness = INFINITY},
                  {.static_ratio = 1, .stiffness = INFINITY}},
      .loads = bench_loads,
      .user = &bench,
      .drive = {.kind = SB_DRIVE_TABLE, .time = time, .value = value, .count = G_N_ELEMENTS(time)},
      .drive_stiffness = 1e5,
      .drive_damping = 20};
  SbDynamics s;
  SbReport report = {0};
  SbDynamicsEnergy energy;
  g_assert_cmpint(sb_dynamics_init(&s, &m, &report), ==, SB_OK);
  sb_dynamics_listen(&s, bench_event, &bench);
  g_assert_cmpint(sb_dynamics_advance(&s, time[1 + 3 * STOPS], &report), ==, SB_OK);
  sb_dynamics_sample(&s, NULL, &energy);
  g_assert_cmpfloat(energy.closure, <, 1e-9);
  g_assert_cmpint(bench.slips, >=, 1 + STOPS);
  double peak = 0;
  for (int i = 0; i < STOPS; i++) {
    // The last slip before the next stop.
    int slip = bench.slips - 1;
    while (slip > 0 && bench.time[slip] > time[4 + 3 * i]) {
      slip--;
    }
    double dwell = bench.time[slip] - time[1 + 3 * i], holds = 0;
    for (int k = 0; k < 2; k++) {
      holds += level[k] * light(dwell, &rise[k]);
    }
    // The stem comes to rest a little behind the platen's turn.
    assert_close(bench.force[slip], holds, 5e-3);
    g_assert_cmpfloat(bench.force[slip], >, peak);
    peak = bench.force[slip];
  }
  g_assert_cmpfloat(peak, >, 2 * (level[0] + level[1]));
  g_assert_cmpint(s.counters.segments, <, 2000);
}

// A slow, soft machine that has jumped over the land's edge: the platen stands ahead of the place
// at which the stem, resting, would slip, which it does at once. Places behind it were sought for
// ever, and the platen could be led back there.
static void test_ahead(void) {
  static const Setting slow[] = {{SB_P_FRICTION_BREAKAWAY, 1},
                                 {SB_P_FRICTION_AGEING, 0.1},
                                 {SB_P_FRICTION_AGEING_TIME, 0.165},
                                 {SB_P_FRICTION_LOAD_COEFFICIENT, 0.24},
                                 {SB_P_FRICTION_SHEAR_STRENGTH, 702670},
                                 {SB_P_CANISTER_PRESSURE, 454e3},
                                 {SB_P_STEM_PRESSURE_DIAMETER, 4.4e-3},
                                 {SB_P_BORE_LAND_EDGE, 5.8e-3},
                                 {SB_P_DRIVE_STROKE, 6.024e-3},
                                 {SB_P_DRIVE_SPEED, 1e-4},
                                 {SB_P_DRIVE_STIFFNESS, 2711},
                                 {SB_P_MODELS_FIT, SB_FIT_LINDLEY},
                                 {SB_P_MODELS_FILM, SB_FILM_THESIS},
                                 {SB_P_DRIVE_REST, 0},
                                 {SB_P_MODELS_MOTION, SB_MODEL_MOTION_QUASI_STATIC}};
  SbModel model;
  compile(&model, slow, G_N_ELEMENTS(slow));
  SbRun *run = run_of(&model, SB_OK, NULL);
  g_assert_cmpfloat(sb_run_summary(run)->energy.closure, <, 1e-9);
  size_t count;
  const SbFrame *frames = sb_run_frames(run, &count);
  bool back = false;
  for (size_t i = 1; i < count; i++) {
    back = back || frames[i].platen < frames[i - 1].platen - 1e-12;
    g_assert_true(!back || frames[i].platen <= frames[i - 1].platen + 1e-12);
  }
  g_assert_true(back);
  sb_run_destroy(run);
}

int main(int argc, char **argv) {
  g_test_init(&argc, &argv, NULL);
  g_test_add_func("/breakaway/squeeze", test_squeeze);
  g_test_add_func("/breakaway/table", test_table);
  g_test_add_func("/breakaway/limits", test_limits);
  g_test_add_func("/breakaway/coupled", test_coupled);
  g_test_add_func("/breakaway/error", test_error);
  g_test_add_func("/breakaway/start-stop", test_start_stop);
  g_test_add_func("/breakaway/stops", test_stops);
  g_test_add_func("/breakaway/ahead", test_ahead);
  return g_test_run();
}
