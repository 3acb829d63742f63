// Supply of the strokes: what a seal leaves on the bore, what it takes back, and the leak that is
// left, by hand and in runs.
#include "engine/valve/figures/figures.h"
#include "engine/valve/run/run_private.h"
#include "tests/engine/models.h"

#include <glib.h>
#include <math.h>

// A seal that goes in, back over less than it came, in and back again: each place once.
static void test_bore(void) {
  static SbBore bore;
  sb_bore_start(&bore, 1);
  sb_bore_move(&bore, 1, 2, 3);
  sb_bore_move(&bore, 2, 4, 5);
  g_assert_cmpfloat(bore.out, ==, 13);
  sb_bore_move(&bore, 4, 1.5, 4); // 2 of 5, half of 3
  g_assert_cmpfloat(bore.back, ==, 2 * 4 + 0.5 * 3);
  g_assert_cmpuint(bore.count, ==, 1);
  sb_bore_move(&bore, 1.5, 1.5, 7);
  sb_bore_move(&bore, 1.5, 3, 1);
  g_assert_cmpfloat(bore.out, ==, 14.5);
  sb_bore_move(&bore, 3, 0, 10); // before the start nothing lies
  g_assert_cmpfloat(bore.back, ==, 9.5 + 1.5 * 1 + 0.5 * 3);
  g_assert_cmpuint(bore.count, ==, 0);
  sb_bore_move(&bore, 0, -1, 10);
  g_assert_cmpfloat(bore.back, ==, 12.5);
  // More layers than it holds: the volume stays.
  sb_bore_start(&bore, 0);
  for (int i = 0; i < 5 * SB_BORE_LAYERS; i++) {
    sb_bore_move(&bore, i, i + 1, 1 + i % 7);
  }
  const double out = bore.out;
  sb_bore_move(&bore, 5 * SB_BORE_LAYERS, 0, 100);
  g_assert_cmpfloat(fabs(bore.back / out - 1), <, 1e-12);
  // What flows back is less than both ways' films, whatever they are.
  g_autoptr(GRand) random = g_rand_new_with_seed(3);
  sb_bore_start(&bore, 0);
  double s = 0;
  for (int i = 0; i < 10000; i++) {
    double to = g_rand_double_range(random, -0.1, 1);
    sb_bore_move(&bore, s, to, g_rand_double(random));
    s = to;
    g_assert_cmpfloat(bore.back, <=, bore.out * (1 + 1e-12));
    g_assert_cmpuint(bore.count, <=, SB_BORE_LAYERS);
  }
}

#define HAND                                                                                       \
  {SB_P_MODELS_MOTION, SB_MODEL_MOTION_DYNAMIC}, {SB_P_DRIVE_KIND, SB_MODEL_DRIVE_HAND},           \
      {SB_P_DRIVE_FINGER_DAMPING, 100}, {                                                          \
    SB_P_OUTPUT_FRAMES, 600                                                                        \
  }

// Net leak of an actuation over what is carried; NaN where the stem does not come back.
static double net_leak(const Setting *settings, size_t count, double *carried) {
  SbModel model;
  compile(&model, settings, count);
  SbRun *run = run_of(&model, SB_OK, NULL);
  const SbSummary *s = sb_run_summary(run);
  const double net = s->leakage_per_cycle;
  *carried = s->seal[SB_OUTER].leakage_per_stroke;
  if (isnan(net)) {
    g_assert_nonnull(sb_figure_reason(s, sb_figure_find("cycle.leakage_per_cycle_m3")));
  } else {
    g_assert_cmpfloat(s->leakage_net, ==, model.actuations * net);
  }
  sb_run_destroy(run);
  return net;
}

// A press by hand comes back faster than it went in: its film could carry more than lies there.
// Whatever the way, the pressure map, the roughness: nothing is drawn out of air, and a small
// change changes little. The quick mode takes each of the ways at one of two pressures.
static void test_net(void) {
  int returned = 0;
  for (int i = 0; i < 32; i++) {
    const bool even = (__builtin_popcount((unsigned)i) & 1) == 0;
    if (!even && !g_test_slow()) {
      continue;
    }
    const bool hand = i & 1, vented = i & 2, reynolds = i & 4, carried_inlet = i & 8;
    double net[2], carried[2];
    for (int k = 0; k < 2; k++) {
      const Setting settings[] = {
          {SB_P_CANISTER_PRESSURE_MAP, vented ? SB_MAP_CHAMBER_VENTED : SB_MAP_CHAMBER_FILLED},
          {SB_P_MODELS_FILM, reynolds ? SB_FILM_REYNOLDS : SB_FILM_THESIS},
          {SB_P_MODELS_INLET, carried_inlet},
          {SB_P_CANISTER_PRESSURE, (i & 16 ? 0.6e6 : 0.5e6) * (1 + 1e-7 * k)},
          {SB_P_SURFACE_GT_PRODUCT, 0.11},
          HAND,
      };
      net[k] = net_leak(settings, G_N_ELEMENTS(settings) - (hand ? 0 : 4), &carried[k]);
    }
    g_test_message("%d: net %.4g of %.4g", i, net[0], carried[0]);
    returned += isfinite(net[0]);
    if (isfinite(net[0])) {
      g_assert_cmpfloat(net[0], >=, 0);
      g_assert_true(net[0] <= 2 * carried[0] || vented); // the film there is that before C
      g_assert_cmpfloat(fabs(net[1] - net[0]), <=, 1e-4 * fmax(carried[0], net[0]));
    }
  }
  g_assert_cmpint(returned, ==, g_test_slow() ? 32 : 16);
}

// The shipped press: 400 actuations leaked -2 ul.
static void test_hand_press(void) {
  const Setting settings[] = {HAND};
  double carried;
  const double net = net_leak(settings, G_N_ELEMENTS(settings), &carried);
  g_assert_cmpfloat(net, >=, 0);
  g_assert_cmpfloat(net, <, carried);
}

// A return that takes a few milliseconds: less than a frame of 100, ten of 5000. The film follows
// the motion, not the frames. Within a segment the speed is taken as even: 2 %.
static void test_frames(void) {
  double net[2];
  for (int i = 0; i < 2; i++) {
    const Setting settings[] = {HAND,
                                {SB_P_GLAND_RADIAL_SPACE, 1.3453e-3},
                                {SB_P_SEAL_MODULUS, 4.99087e6},
                                {SB_P_CANISTER_PRESSURE, 0.462373e6},
                                {SB_P_OUTPUT_FRAMES, i > 0 ? 5000 : 100}};
    double carried;
    net[i] = net_leak(settings, G_N_ELEMENTS(settings), &carried);
  }
  g_test_message("net %.4g, with more frames %.4g", net[0], net[1]);
  g_assert_cmpfloat(fabs(net[0] / net[1] - 1), <, 0.02);
}

// Liquid where there is liquid: the inner seal returns against a full chamber, the outer one
// against air, and with a vented chamber it leaves nothing before the chamber opens.
static void test_inlets(void) {
  for (int vented = 0; vented < 2; vented++) {
    const Setting settings[] = {{SB_P_MODELS_INLET, 1}, {SB_P_CANISTER_PRESSURE_MAP, vented}};
    SbModel model;
    compile(&model, settings, 2);
    SbRun *run = run_of(&model, SB_OK, NULL);
    const SbSealState *rest = run->cycle.state[SB_OUTER][SB_CHAMBER_AT_REST],
                      *open = run->cycle.state[SB_OUTER][SB_CHAMBER_OPEN];
    g_assert_false(sb_run_supply(run, SB_INNER, SB_CHAMBER_AT_REST, SB_CYCLE_IN).limited);
    g_assert_false(sb_run_supply(run, SB_INNER, SB_CHAMBER_CLOSED, SB_CYCLE_OUT).limited);
    g_assert_cmpint(sb_run_supply(run, SB_INNER, SB_CHAMBER_AT_REST, SB_CYCLE_OUT).limited, ==,
                    vented);
    g_assert_cmpint(sb_run_supply(run, SB_OUTER, SB_CHAMBER_AT_REST, SB_CYCLE_IN).limited, ==,
                    vented);
    g_assert_false(sb_run_supply(run, SB_OUTER, SB_CHAMBER_OPEN, SB_CYCLE_IN).limited);
    SbSupply back = sb_run_supply(run, SB_OUTER, SB_CHAMBER_OPEN, SB_CYCLE_OUT);
    g_assert_true(back.limited);
    g_assert_cmpfloat(back.layer, ==, open[SB_CYCLE_IN].layer);
    back = sb_run_supply(run, SB_OUTER, SB_CHAMBER_CLOSED, SB_CYCLE_OUT);
    g_assert_true(back.limited);
    g_assert_cmpfloat(back.layer, ==, vented ? 0 : rest[SB_CYCLE_IN].layer);
    if (vented) {
      g_assert_cmpfloat(rest[SB_CYCLE_IN].friction_viscous, ==, 0);
      g_assert_cmpfloat(open[SB_CYCLE_IN].friction_viscous, >, 0);
    }
    sb_run_destroy(run);
  }
}

int main(int argc, char **argv) {
  g_test_init(&argc, &argv, NULL);
  g_test_add_func("/run-supply/bore", test_bore);
  g_test_add_func("/run-supply/net", test_net);
  g_test_add_func("/run-supply/hand-press", test_hand_press);
  g_test_add_func("/run-supply/frames", test_frames);
  g_test_add_func("/run-supply/inlets", test_inlets);
  return g_test_run();
}
