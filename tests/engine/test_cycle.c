// The cycle A to F against a hand calculation from the printed equations, and on its hard cases.
#include "engine/film/laws.h"
#include "engine/valve/figures/figures.h"
#include "engine/valve/run/cost.h"
#include "engine/valve/sealbench.h"
#include "tests/engine/models.h"

#include <glib.h>
#include <math.h>
#include <string.h>

static SbRun *run_cycle(const Setting *settings, size_t count) {
  SbModel model;
  compile(&model, settings, count);
  return run_of(&model, SB_OK, NULL);
}

// Kinetic friction by the printed equations 5.2, 5.4, 5.11, 5.14, 7.5 alone, F_2 expanded about
// contact: F_2(l) = 1/2 - l sqrt(2/pi) + l^2/2 for small l.
static double hand_friction(double d, double p, double gt, double speed) {
  double g = 1.36e-3;
  double E = 2.5e6;
  double e = (d - g) / d;
  double a = 2 * e + 0.13;
  double width = d * (a + (0.39 / (1 - e) - 0.5 * a) * (1 - exp(-4.6 * p / E)));
  double sigma = M_PI / 6 * a * E + 0.49 / 0.51 * p;
  double w = width * sigma;
  double load = w * M_PI * (2.84e-3 + d);
  double Ep = 2 / ((1 - 0.49 * 0.49) / E + (1 - 0.35 * 0.35) / 2.6e9);
  double R = d / 2;
  double net = w - p * width / 2;
  double U = 0.211e-3 * speed / 2 / (Ep * R);
  double h = 1.492 * pow(U, 0.5434) * pow(net / (Ep * R), -0.2893) * R;
  double l = h / 1e-6;
  double F2 = 0.5 - l * sqrt(2 / M_PI) + l * l / 2;
  double area = width * M_PI * 6e-3;
  double share = M_PI * M_PI * gt * gt * F2;
  return 3.5e6 * share * area + 0.19 * load + 0.211e-3 * speed / h * (1 - share) * area;
}

// Force of the frame nearest to displacement `s` on the way in or out.
static double force_at(const SbRun *run, double s, bool in) {
  size_t count;
  const SbFrame *frames = sb_run_frames(run, &count);
  double best = INFINITY;
  double force = NAN;
  for (size_t i = 0; i < count; i++) {
    bool way_in = frames[i].stage < SB_STAGE_D;
    double miss = fabs(frames[i].displacement - s);
    if (way_in == in && miss < best) {
      best = miss;
      force = frames[i].force;
    }
  }
  return force;
}

static void check_hand(double d, double p, double gt) {
  // Without a static excess the stem slides all the way back.
  Setting settings[] = {{SB_P_SEAL_SECTION_DIAMETER, d},
                        {SB_P_CANISTER_PRESSURE, p},
                        {SB_P_SURFACE_GT_PRODUCT, gt},
                        {SB_P_FRICTION_STATIC_RATIO, 1}};
  SbRun *run = run_cycle(settings, G_N_ELEMENTS(settings));
  double speed = 20e-3 / 60;
  double Fp = p * M_PI / 4 * 5.794e-3 * 5.794e-3;
  double outer = hand_friction(d, p, gt, speed);
  double inner = hand_friction(d, 0, gt, speed);
  double cases[][2] = {{force_at(run, 1.6e-3, true), Fp + outer + inner},
                       {force_at(run, 5.5e-3, true), Fp + outer},
                       {force_at(run, 5.5e-3, false), Fp - outer},
                       {force_at(run, 1.6e-3, false), Fp - outer - inner}};
  for (size_t i = 0; i < G_N_ELEMENTS(cases); i++) {
    g_assert_cmpfloat(fabs(cases[i][0] / cases[i][1] - 1), <, 1e-3);
  }
  sb_run_destroy(run);
}

static void test_hand(void) {
  check_hand(1.61e-3, 0.55e6, 0.1289);
  check_hand(1.63e-3, 0.55e6, 0.1289);
  check_hand(1.63e-3, 0.29e6, 0.05);
}

// At p = 0.29 MPa, d = 1.63 mm and the thesis' surface pressure cannot beat both seals: sliding
// exists in B-C, C-D and E-F; in F-A the stem has stalled, the platen is free and carries nothing.
static void test_hand_acceptance(void) {
  Setting settings[] = {{SB_P_SEAL_SECTION_DIAMETER, 1.63e-3},
                        {SB_P_CANISTER_PRESSURE, 0.29e6},
                        {SB_P_FRICTION_STATIC_RATIO, 1}};
  SbRun *run = run_cycle(settings, G_N_ELEMENTS(settings));
  double speed = 20e-3 / 60;
  double Fp = 0.29e6 * M_PI / 4 * 5.794e-3 * 5.794e-3;
  double outer = hand_friction(1.63e-3, 0.29e6, 0.1289, speed);
  double inner = hand_friction(1.63e-3, 0, 0.1289, speed);
  g_assert_cmpfloat(fabs(force_at(run, 1.6e-3, true) / (Fp + outer + inner) - 1), <, 1e-3);
  g_assert_cmpfloat(fabs(force_at(run, 5.5e-3, true) / (Fp + outer) - 1), <, 1e-3);
  g_assert_cmpfloat(fabs(force_at(run, 5.5e-3, false) / (Fp - outer) - 1), <, 1e-3);
  g_assert_cmpfloat(fabs(sb_run_summary(run)->force_return_min - (Fp - outer - inner)), <,
                    1e-3 * Fp);
  sb_run_destroy(run);
}

static void test_thesis_cycle(void) {
  SbRun *run = run_cycle(NULL, 0);
  const SbSummary *s = sb_run_summary(run);
  for (int i = 0; i < SB_STAGE_COUNT; i++) {
    g_assert_true(s->stage[i].reached);
    if (i > 0) {
      g_assert_cmpfloat(s->stage[i].time, >, s->stage[i - 1].time);
    }
  }
  g_assert_cmpfloat(fabs(s->force_breakaway - 27.5), <, 3);
  g_assert_cmpfloat(s->force_peak, >, 30);
  g_assert_cmpfloat_with_epsilon(s->stage[SB_STAGE_C].displacement, 3.3e-3, 1e-12);
  g_assert_cmpfloat_with_epsilon(s->stage[SB_STAGE_D].displacement, 6.6e-3, 1e-12);
  g_assert_cmpfloat(s->stage[SB_STAGE_C].force - s->stage[SB_STAGE_D].force, >, 4);
  g_assert_cmpfloat(force_at(run, 1e-3, false), <, force_at(run, 5.5e-3, false) - 4);
  g_assert_cmpfloat_with_epsilon(s->force_return_min, 1.6, 0.1);
  g_assert_true(s->returns);
  for (int i = 0; i < SB_SEAL_COUNT; i++) {
    double boundary = s->seal[i].friction_boundary;
    g_assert_cmpfloat(boundary / (boundary + s->seal[i].friction_viscous), >, 0.95);
  }
  g_assert_cmpfloat_with_epsilon(s->seal[SB_OUTER].friction_boundary, 8, 0.1);
  g_assert_cmpfloat_with_epsilon(s->seal[SB_INNER].friction_boundary, 5, 0.1);
  g_assert_cmpfloat(s->energy.closure, ==, 0); // its rounding is none
  g_assert_cmpfloat(s->energy.stored, <, 1e-9);
  sb_run_destroy(run);
}

// The sliding margin is that of the frames from E to A, however large the static friction is. The
// return margin is the push less the static friction, both by hand from the return's states: with
// the film models of the thesis the dry friction is what the run reports at rest.
static void test_return_of_frames(void) {
  const double ratios[] = {1, 1.1, 1.12};
  double margins[G_N_ELEMENTS(ratios)];
  for (size_t k = 0; k < G_N_ELEMENTS(ratios); k++) {
    Setting sticky = {SB_P_FRICTION_STATIC_RATIO, ratios[k]};
    SbRun *run = run_cycle(&sticky, 1);
    const SbSummary *summary = sb_run_summary(run);
    size_t count;
    const SbFrame *frames = sb_run_frames(run, &count);
    double least = INFINITY;
    for (size_t i = summary->stage[SB_STAGE_E].frame; i < count; i++) {
      if (frames[i].velocity < 0) {
        double friction = frames[i].seal[SB_INNER].friction + frames[i].seal[SB_OUTER].friction;
        least = fmin(least, frames[i].pressure_force - fabs(friction));
      }
    }
    g_assert_cmpint(summary->outcome, ==, SB_OUTCOME_RETURNED);
    g_assert_true(summary->returns && isnan(summary->stuck_at));
    g_assert_cmpfloat(fabs(summary->force_return_min - least), <, 1e-9);
    margins[k] = summary->force_return_margin;
    g_assert_cmpfloat(margins[k], >, 0);
    g_assert_cmpfloat(margins[k], <, summary->force_return_min);
    g_assert_cmpint(summary->verdict[SB_VERDICT_RETURNS].ok, ==, SB_ANSWER_YES);
    g_assert_cmpfloat(summary->verdict[SB_VERDICT_RETURNS].value, ==, margins[k]);
    sb_run_destroy(run);
  }
  // Static friction is proportional to its ratio.
  double dry = (margins[0] - margins[1]) / (ratios[1] - ratios[0]);
  g_assert_cmpfloat(fabs(margins[0] - margins[2] - dry * (ratios[2] - ratios[0])), <, 1e-9);
}

// A static ratio that holds the stem on its way is an outcome of the cycle: the stem is stuck where
// static friction reaches the push, both motions agree, and figures of what did not happen have
// reasons. At 2.5 static friction holds the stem at the stop.
static void test_stuck(void) {
  const double ratios[] = {1.3, 1.7, 2.5};
  for (size_t k = 0; k < G_N_ELEMENTS(ratios); k++) {
    double margin[2];
    for (int motion = 0; motion < 2; motion++) {
      Setting settings[] = {{SB_P_FRICTION_STATIC_RATIO, ratios[k]},
                            {SB_P_MODELS_MOTION,
                             motion == 0 ? SB_MODEL_MOTION_QUASI_STATIC : SB_MODEL_MOTION_DYNAMIC}};
      SbRun *run = run_cycle(settings, G_N_ELEMENTS(settings));
      const SbSummary *s = sb_run_summary(run);
      const bool at_stop = s->stuck_at > 0.99 * sb_run_model(run)->stroke;
      g_test_message("ratio %g, motion %d: %s at %g mm, margin %g N", ratios[k], motion,
                     sb_outcome_name(s->outcome), 1e3 * s->stuck_at, s->force_return_margin);
      g_assert_cmpint(s->outcome, ==, SB_OUTCOME_STUCK);
      g_assert_true(at_stop == (k == 2));
      g_assert_cmpfloat(s->stuck_at, >, 0);
      g_assert_cmpfloat(s->stuck_at, <=, sb_run_model(run)->stroke * (1 + 1e-4));
      g_assert_cmpfloat(s->returned, ==, 0);
      g_assert_false(s->returns);
      g_assert_true(isnan(s->force_return_min) == at_stop);
      g_assert_true(isnan(s->dose_mass) && isnan(s->leakage_carried) && isnan(s->leakage_net));
      static const char *const missing[] = {"cycle.dose_mass_kg",
                                            "cycle.leakage_carried_all_actuations_m3"};
      for (size_t i = 0; i < G_N_ELEMENTS(missing); i++) {
        g_assert_nonnull(strstr(sb_figure_reason(s, sb_figure_find(missing[i])), "stuck at"));
      }
      g_assert_cmpint(s->verdict[SB_VERDICT_RETURNS].ok, ==, SB_ANSWER_NO);
      g_assert_cmpfloat(s->verdict[SB_VERDICT_RETURNS].value, ==, s->force_return_margin);
      margin[motion] = s->force_return_margin;
      g_assert_cmpfloat(margin[motion], <, 0);
      g_assert_cmpfloat(s->energy.closure, <, 1e-6);
      g_assert_true(s->energy.closure == 0 || s->energy.closure > 1e-10); // no rounding
      sb_run_destroy(run);
    }
    // One definition, the same states.
    g_assert_cmpfloat(fabs(margin[0] - margin[1]), <, 1e-9);
  }
}

// Static friction grows while the machine loads the stem, in both motions: they agree on the
// break-away, however slow the machine is.
static void test_dwell_while_loaded(void) {
  const double speed[] = {0.1e-3 / 60, 2e-3 / 60, 20e-3 / 60};
  double last = INFINITY;
  for (size_t k = 0; k < G_N_ELEMENTS(speed); k++) {
    double force[2];
    for (int motion = 0; motion < 2; motion++) {
      Setting settings[] = {{SB_P_FRICTION_DWELL_GAIN, 0.1},
                            {SB_P_DRIVE_SPEED, speed[k]},
                            {SB_P_MODELS_MOTION, motion}};
      SbRun *run = run_cycle(settings, G_N_ELEMENTS(settings));
      force[motion] = sb_run_summary(run)->force_breakaway;
      sb_run_destroy(run);
    }
    g_assert_cmpfloat_with_epsilon(force[1] / force[0], 1, 1e-5);
    g_assert_cmpfloat(force[0], <, last);
    last = force[0];
  }
}

// A stem that a machine moves stops at its end stop alone: there static friction counts, elsewhere
// that of sliding. Both margins have figures of their own, which do not depend on the choice.
static void test_may_stop(void) {
  SbSummary summary[2];
  for (int stop = 0; stop < 2; stop++) {
    Setting settings[] = {{SB_P_FRICTION_STATIC_RATIO, 1.7}, {SB_P_DRIVE_MAY_STOP, stop}};
    SbRun *run = run_cycle(settings, G_N_ELEMENTS(settings));
    summary[stop] = *sb_run_summary(run);
    g_assert_cmpfloat(summary[stop].energy.closure, <, 1e-6);
    sb_run_destroy(run);
  }
  const SbSummary *anywhere = &summary[0], *stop = &summary[1];
  g_assert_cmpint(anywhere->outcome, ==, SB_OUTCOME_STUCK);
  g_assert_cmpint(stop->outcome, ==, SB_OUTCOME_RETURNED);
  g_assert_cmpint(stop->verdict[SB_VERDICT_RETURNS].ok, ==, SB_ANSWER_YES);
  g_assert_cmpfloat(anywhere->force_return_margin, ==, anywhere->force_return_margin_anywhere);
  g_assert_cmpfloat(stop->force_return_margin, ==,
                    fmin(stop->force_return_margin_stop, stop->force_return_min));
  g_assert_cmpfloat(anywhere->force_return_margin_anywhere, ==, stop->force_return_margin_anywhere);
  g_assert_cmpfloat(anywhere->force_return_margin_stop, ==, stop->force_return_margin_stop);
  // At the stop only the outer ring is on the land.
  g_assert_cmpfloat(stop->force_return_margin_stop, >, stop->force_return_margin_anywhere);
}

// A canister below ambient draws the stem in by itself where friction falls below that pull, over
// the land's edge: the stem leaves the platen, and the pull's work beyond the friction is lost.
static void test_drawn_in(void) {
  const double pull[] = {-0.4e5, -0.6e5, -0.9e5};
  for (int i = 0; i < 3; i++) {
    const Setting set[] = {{SB_P_CANISTER_PRESSURE, pull[i]},
                           {SB_P_FRICTION_SHEAR_STRENGTH, 0.2e6}};
    SbRun *run = run_cycle(set, G_N_ELEMENTS(set));
    const SbSummary *s = sb_run_summary(run);
    const SbEnergy *energy = &s->energy;
    g_test_message("%.0f Pa: closure %.1e, lost %.3g of %.3g J", pull[i], energy->closure,
                   energy->seal, energy->external);
    g_assert_cmpfloat(energy->closure, <, 1e-8);
    g_assert_cmpint(energy->seal > 0.01 * energy->external, ==, i > 0);
    g_assert_cmpint(s->outcome, ==, SB_OUTCOME_STUCK);
    sb_run_destroy(run);
  }
}

// The force on a stem that never moves is the drive's: the error of friction that could hold much
// more is none of it.
static void test_held(void) {
  const Setting held[] = {{SB_P_MODELS_MOTION, SB_MODEL_MOTION_DYNAMIC},
                          {SB_P_DRIVE_KIND, SB_MODEL_DRIVE_HAND},
                          {SB_P_DRIVE_PEAK_FORCE, 1e-3},
                          {SB_P_MODELS_FILM, SB_FILM_REYNOLDS},
                          {SB_P_MODELS_ASPERITIES, SB_MODEL_ASPERITIES_COUPLED}};
  SbRun *run = run_cycle(held, G_N_ELEMENTS(held));
  const SbSummary *s = sb_run_summary(run);
  g_assert_cmpint(s->outcome, ==, SB_OUTCOME_NEVER_MOVED);
  g_test_message("error of the force %.2g, of the load %.2g", s->error_force, s->error_load);
  g_assert_cmpfloat(s->error_force, <, 1e-9);
  sb_run_destroy(run);
}

// A drive that does not overcome the static friction moves nothing, and a ramp holds the stem.
static void test_drives(void) {
  Setting weak[] = {{SB_P_MODELS_MOTION, SB_MODEL_MOTION_DYNAMIC},
                    {SB_P_DRIVE_KIND, SB_MODEL_DRIVE_HAND},
                    {SB_P_DRIVE_PEAK_FORCE, 28}};
  SbRun *run = run_cycle(weak, G_N_ELEMENTS(weak));
  const SbSummary *s = sb_run_summary(run);
  g_assert_cmpint(s->outcome, ==, SB_OUTCOME_NEVER_MOVED);
  static const char *const missing[] = {"cycle.returns",
                                        "cycle.force_return_margin_N",
                                        "cycle.force_return_min_N",
                                        "cycle.force_press_N",
                                        "cycle.leakage_per_cycle_m3",
                                        "cycle.dose_mass_kg",
                                        "cycle.stages.B.force_N",
                                        "cycle.leakage_net_all_actuations_m3",
                                        "cycle.leakage_carried_all_actuations_m3"};
  for (size_t i = 0; i < G_N_ELEMENTS(missing); i++) {
    const int figure = sb_figure_find(missing[i]);
    g_assert_true(isnan(sb_figure_value(s, figure)));
    if (strstr(missing[i], "stages") == NULL) {
      g_assert_nonnull(strstr(sb_figure_reason(s, figure), "never moved"));
    }
  }
  g_assert_cmpint(s->verdict[SB_VERDICT_RETURNS].ok, ==, SB_ANSWER_UNKNOWN);
  g_assert_cmpint(s->verdict[SB_VERDICT_PRESSES].ok, ==, SB_ANSWER_NO);
  sb_run_destroy(run);
  Setting ramp[] = {{SB_P_MODELS_MOTION, SB_MODEL_MOTION_DYNAMIC},
                    {SB_P_DRIVE_KIND, SB_MODEL_DRIVE_RAMP}};
  run = run_cycle(ramp, G_N_ELEMENTS(ramp));
  s = sb_run_summary(run);
  g_assert_cmpint(s->outcome, ==, SB_OUTCOME_HELD);
  g_assert_cmpfloat(s->returned, ==, 0);
  g_assert_cmpint(s->verdict[SB_VERDICT_RETURNS].ok, ==, SB_ANSWER_UNKNOWN);
  g_assert_cmpint(s->verdict[SB_VERDICT_RETURNS].reason[0], !=, 0);
  sb_run_destroy(run);
}

// "Presses" is the force before the stop, whatever force the machine reverses at.
static void test_press(void) {
  double press[2];
  for (int k = 0; k < 2; k++) {
    Setting reversal = {SB_P_DRIVE_REVERSAL_FORCE, k == 0 ? 35 : 60};
    SbRun *run = run_cycle(&reversal, 1);
    const SbSummary *s = sb_run_summary(run);
    press[k] = s->force_press;
    g_assert_cmpfloat(fabs(s->force_peak - reversal.value), <, 1e-9);
    g_assert_cmpfloat(press[k], ==, s->force_breakaway);
    sb_run_destroy(run);
  }
  g_assert_cmpfloat(press[0], ==, press[1]);
}

// Section 7.6: +30 % roughness nearly or fully stops the return, -30 % eases it.
static void test_roughness(void) {
  Setting rough = {SB_P_SURFACE_GT_PRODUCT, 1.3 * 0.1289};
  Setting smooth = {SB_P_SURFACE_GT_PRODUCT, 0.7 * 0.1289};
  SbRun *run = run_cycle(&rough, 1);
  const SbSummary *summary = sb_run_summary(run);
  g_assert_cmpfloat(summary->force_return_min, <, 0);
  g_assert_false(summary->returns);
  g_assert_cmpfloat(summary->energy.closure, <, 1e-6);
  sb_run_destroy(run);
  run = run_cycle(&smooth, 1);
  g_assert_cmpfloat_with_epsilon(sb_run_summary(run)->force_return_min, 6.2, 0.2);
  sb_run_destroy(run);
}

// Twice the frames, the same figures; the least return force of the frames is the reported one.
static void test_frames(void) {
  Setting coarse = {SB_P_OUTPUT_FRAMES, 200};
  Setting fine = {SB_P_OUTPUT_FRAMES, 400};
  SbRun *a = run_cycle(&coarse, 1);
  SbRun *b = run_cycle(&fine, 1);
  g_assert_cmpfloat(sb_run_summary(a)->force_peak, ==, sb_run_summary(b)->force_peak);
  g_assert_cmpfloat(sb_run_summary(a)->energy.loop, ==, sb_run_summary(b)->energy.loop);

  // The loop's area from the frames alone, by trapezoids, agrees with the engine's own.
  size_t count;
  const SbFrame *frames = sb_run_frames(b, &count);
  double area = 0;
  for (size_t i = 1; i < count; i++) {
    area += (frames[i].force + frames[i - 1].force) / 2 *
            (frames[i].displacement - frames[i - 1].displacement);
  }
  g_assert_cmpfloat(fabs(area / sb_run_summary(b)->energy.loop - 1), <, 1e-3);
  int edge = 0;
  for (size_t i = 1; i < count; i++) {
    g_assert_cmpfloat(frames[i].time, >=, frames[i - 1].time);
    double balance = frames[i].force - frames[i].pressure_force - frames[i].stop_force -
                     frames[i].seal[0].friction - frames[i].seal[1].friction;
    // The balance is that of friction at the machine's speed; over the land's edge the stem is a
    // little faster, and the frame's friction is its own.
    bool own = frames[i].velocity != 0 && fabs(fabs(frames[i].velocity) * 3000 - 1) > 1e-9;
    g_assert_cmpfloat(fabs(balance), <, own ? 2e-3 : 1e-9);
    edge += own;
  }
  g_assert_cmpint(edge, >, 10);
  sb_run_destroy(a);
  sb_run_destroy(b);
}

// Energy closes and the run ends for every odd valve.
static void test_hard_cases(void) {
  const Setting cases[][3] = {
      {{SB_P_DRIVE_STIFFNESS, 2e3}, {SB_P_OUTPUT_FRAMES, 50}, {SB_P_BORE_LAND_EDGE, 3.3e-3}},
      {{SB_P_DRIVE_STIFFNESS, 1e10}, {SB_P_OUTPUT_FRAMES, 50}, {SB_P_BORE_LAND_EDGE, 3.3e-3}},
      {{SB_P_CANISTER_PRESSURE_MAP, 1}, {SB_P_OUTPUT_FRAMES, 50}, {SB_P_BORE_LAND_EDGE, 3.3e-3}},
      {{SB_P_CANISTER_PRESSURE_MAP, 1}, {SB_P_DRIVE_STIFFNESS, 2e3}, {SB_P_OUTPUT_FRAMES, 50}},
      {{SB_P_BORE_LAND_EDGE, 0}, {SB_P_OUTPUT_FRAMES, 50}, {SB_P_DRIVE_SPEED, 1e-6}},
      {{SB_P_BORE_LAND_EDGE, 6.2e-3}, {SB_P_OUTPUT_FRAMES, 50}, {SB_P_DRIVE_SPEED, 10}},
      {{SB_P_BORE_LAND_EDGE, 20e-3}, {SB_P_OUTPUT_FRAMES, 50}, {SB_P_DRIVE_SPEED, 1}},
      {{SB_P_DRIVE_REVERSAL_FORCE, 20}, {SB_P_OUTPUT_FRAMES, 50}, {SB_P_DRIVE_SPEED, 1}},
      {{SB_P_DRIVE_REVERSAL_FORCE, 0}, {SB_P_OUTPUT_FRAMES, 50}, {SB_P_DRIVE_SPEED, 1}},
      {{SB_P_CANISTER_PRESSURE, 0}, {SB_P_OUTPUT_FRAMES, 50}, {SB_P_DRIVE_SPEED, 1}},
      {{SB_P_SEAL_SECTION_DIAMETER, 1.3e-3}, {SB_P_OUTPUT_FRAMES, 2}, {SB_P_DRIVE_SPEED, 1e-3}},
      {{SB_P_SEAL_INNER_SECTION_DIAMETER, 1.3e-3},
       {SB_P_OUTPUT_FRAMES, 9},
       {SB_P_DRIVE_SPEED, 1e-3}},
      {{SB_P_FRICTION_STATIC_RATIO, 5}, {SB_P_DRIVE_REVERSAL_FORCE, 200}, {SB_P_OUTPUT_FRAMES, 50}},
      {{SB_P_SURFACE_GT_PRODUCT, 0.5}, {SB_P_DRIVE_STIFFNESS, 1.35e5}, {SB_P_OUTPUT_FRAMES, 50}},
      {{SB_P_FRICTION_SHEAR_STRENGTH, 0},
       {SB_P_FRICTION_LOAD_COEFFICIENT, 0},
       {SB_P_OUTPUT_FRAMES, 9}},
  };
  for (size_t i = 0; i < G_N_ELEMENTS(cases); i++) {
    SbRun *run = run_cycle(cases[i], 3);
    const SbSummary *summary = sb_run_summary(run);
    g_test_message("case %zu: %zu segments, closure %g, peak %g N, returns %d", i, summary->steps,
                   summary->energy.closure, summary->force_peak, summary->returns);
    g_assert_cmpfloat(summary->energy.closure, <, 1e-6);
    g_assert_cmpuint(summary->frames, >, 0);
    size_t count;
    const SbFrame *frames = sb_run_frames(run, &count);
    for (size_t f = 0; f < count; f++) {
      g_assert_true(isfinite(frames[f].force) && isfinite(frames[f].velocity));
      g_assert_cmpfloat(frames[f].force, >=, 0);
    }
    sb_run_destroy(run);
  }
}

// Where the land ends the contact does: rounding leaves no load there, and no film under it.
static void test_land_end(void) {
  for (int i = 0; i < 100; i++) {
    Setting settings[] = {{SB_P_SEAL_SECTION_DIAMETER, 1.58e-3 + 5e-7 * i},
                          {SB_P_OUTPUT_FRAMES, 9}};
    SbRun *run = run_cycle(settings, 2);
    size_t count;
    const SbFrame *frames = sb_run_frames(run, &count);
    for (size_t f = 0; f < count; f++) {
      const SbSealFrame *inner = &frames[f].seal[SB_INNER];
      g_assert_cmpfloat(inner->load, >=, 0);
      g_assert_true(inner->load > 1e-9 || !(inner->film_central > 0));
    }
    sb_run_destroy(run);
  }
}

// A ring that does not touch: load 0, a warning, and the other seal still works.
static void test_no_contact(void) {
  Setting settings[] = {{SB_P_SEAL_INNER_SECTION_DIAMETER, 1.3e-3}};
  SbRun *run = run_cycle(settings, 1);
  const SbSummary *summary = sb_run_summary(run);
  g_assert_cmpfloat(summary->seal[SB_INNER].load, ==, 0);
  g_assert_cmpfloat(summary->seal[SB_OUTER].load, >, 10);
  bool warned = false;
  for (size_t i = 0; i < summary->warnings.count; i++) {
    warned = warned || g_str_equal(summary->warnings.item[i].code, "no-contact");
  }
  g_assert_true(warned);
  g_assert_false(summary->stage[SB_STAGE_C].reached);
  sb_run_destroy(run);
}

static bool always(void *data) {
  return true;
}

static void test_cancel(void) {
  Setting many = {SB_P_OUTPUT_FRAMES, 2000000};
  SbModel model;
  compile(&model, &many, 1);
  SbPlan plan;
  sb_plan_make(&plan, &model);
  SbRun *run = NULL;
  g_assert_cmpint(sb_run_create(&run, &model, &plan, NULL), ==, SB_OK);
  SbRunHooks hooks = {.cancelled = always};
  g_assert_cmpint(sb_run_execute(run, &hooks, NULL), ==, SB_ERROR_CANCELLED);
  sb_run_destroy(run);
}

// Table 7.13: 400 strokes, D = 6 mm, L_s = 6.60 mm.
static void test_leakage(void) {
  const double rows[][2] = {{0.00050636, 1.010e-8}, {0.00046489, 9.31e-9},  {0.00034522, 6.92e-9},
                            {0.00023650, 4.74e-9},  {0.00010849, 2.17e-9},  {0.00009062, 1.82e-9},
                            {0.00007475, 1.50e-9},  {0.00006366, 1.28e-9},  {0.00004539, 9.09e-10},
                            {0.00003851, 7.71e-10}, {0.00003332, 6.67e-10}, {0.00002567, 5.14e-10},
                            {0.00046118, 9.24e-9},  {0.00050303, 1.010e-8}, {0.00056226, 1.13e-8},
                            {0.00061808, 1.24e-8},  {0.00065734, 1.32e-8}};
  for (size_t i = 0; i < G_N_ELEMENTS(rows); i++) {
    double leak = 400 * sb_leak_stroke(6e-3, rows[i][0] * 0.805e-3, 6.60e-3);
    g_assert_cmpfloat(fabs(leak / rows[i][1] - 1), <, 0.01);
  }
  // Equation 5.19 over the time of a stroke is equation 5.20.
  double speed = 1e-2;
  double over_time = G_PI * 6e-3 * 1e-9 * speed / 2 * (6.60e-3 / speed);
  g_assert_cmpfloat(fabs(over_time / sb_leak_stroke(6e-3, 1e-9, 6.60e-3) - 1), <, 1e-12);
}

// The thesis valve is tight at rest with a wide margin; a bare touch leaks, and the user is told.
static void test_static_leak(void) {
  Setting even[] = {{SB_P_MODELS_SURFACE, 1}};
  SbRun *run = run_cycle(even, 1);
  const SbSealState *outer = &sb_run_summary(run)->seal[SB_OUTER];
  g_assert_cmpfloat(outer->leakage_static, ==, 0);
  g_assert_cmpfloat(outer->closing_pressure, <, 0.5e6);
  sb_run_destroy(run);

  Setting rough[] = {{SB_P_SURFACE_SIGMA_OVER_BETA, 1},
                     {SB_P_SURFACE_GT_PRODUCT, 0.026},
                     {SB_P_MODELS_SURFACE, 1}};
  run = run_cycle(rough, 3);
  outer = &sb_run_summary(run)->seal[SB_OUTER];
  g_assert_cmpfloat(outer->leakage_static, >, 0);
  g_assert_cmpfloat(outer->leak_sensitivity, <, 0);
  sb_run_destroy(run);
}

// The predicted cost is the sum of what is asked for: it follows the counts of solves.
static double planned(const SbRun *run, const char *field) {
  const SbPlan *plan = sb_run_plan(run);
  for (size_t i = 0; i < plan->field_count; i++) {
    if (strcmp(plan->field[i].name, field) == 0) {
      return plan->field[i].cost_s;
    }
  }
  return 0;
}

// What a run solves is what its plan reckoned with, also where it goes round for its own speed.
static void test_plan_counts(void) {
  Setting disc[] = {{SB_P_MODELS_FIT, SB_FIT_DISC}, {SB_P_MODELS_FILM, SB_FILM_REYNOLDS}};
  SbRun *run = run_cycle(disc, 2);
  const SbCounters *counters = &sb_run_summary(run)->counters;
  g_assert_cmpuint(counters->disc_solves, ==, 2);
  g_assert_cmpuint(counters->speed_nodes, <=, 16);
  // Half-plane and disc; the disc alone over the speed.
  g_assert_cmpuint(counters->reynolds_solves, ==, 8 + counters->speed_nodes);
  g_assert_cmpfloat(planned(run, "contact load and width"), ==, 2 * SB_COST_DISC);
  g_assert_cmpfloat(planned(run, "film"), ==, 4 * (SB_COST_FILM + SB_COST_FILM_FITTED));
  sb_run_destroy(run);

  Setting hand[] = {{SB_P_MODELS_MOTION, SB_MODEL_MOTION_DYNAMIC},
                    {SB_P_DRIVE_KIND, SB_MODEL_DRIVE_HAND},
                    {SB_P_MODELS_FILM, SB_FILM_REYNOLDS}};
  run = run_cycle(hand, 3);
  counters = &sb_run_summary(run)->counters;
  g_assert_cmpuint(counters->fit_solves, >=, 2);
  g_assert_cmpuint(counters->reynolds_solves, >=, 8); // two rounds at least
  double solves = (planned(run, "film") + planned(run, "film over speed")) / SB_COST_FILM;
  g_assert_cmpfloat(fabs(solves - (double)counters->reynolds_solves), <=, 20);
  sb_run_destroy(run);
}

// Which fields a scene computes follows from its views.
static void test_plan(void) {
  Setting loop = {SB_P_OUTPUT_VIEWS, SB_VIEW_HYSTERESIS};
  Setting profiles = {SB_P_OUTPUT_VIEWS, SB_VIEW_HYSTERESIS | SB_VIEW_PROFILES};
  SbRun *run = run_cycle(&loop, 1);
  const SbSummary *summary = sb_run_summary(run);
  g_assert_cmpfloat(summary->wall_s, >, 0);
  g_assert_cmpuint(summary->counters.field_evaluations, ==, 0);
  g_assert_cmpuint(summary->counters.reynolds_solves, ==, 0);
  g_assert_cmpuint(summary->counters.profile_evaluations, ==, 0);
  sb_run_destroy(run);
  run = run_cycle(&profiles, 1);
  g_assert_cmpuint(sb_run_summary(run)->counters.profile_evaluations, >, 0);
  size_t count;
  const SbFrame *frames = sb_run_frames(run, &count);
  const SbContactProfile *profile = sb_run_profile(run, frames[count / 4].seal[SB_OUTER].profile);
  g_assert_nonnull(profile);
  g_assert_cmpuint(profile->count, >, 100);
  // docs/thesis.md, 10: asperities bear 160 kPa sqrt(sigma/beta) in contact, here with 0.1.
  g_assert_cmpfloat_with_epsilon(profile->asperity_pressure[profile->count / 2], 160e3 * sqrt(0.1),
                                 1e3);
  // Nowhere below the fluid on its side: outer seals have it on the left, ambient on the right.
  size_t last = profile->count - 1;
  g_assert_cmpfloat(profile->pressure[0], >, 0.5e6);
  g_assert_cmpfloat(profile->pressure[last], ==, 0);
  double middle = (profile->x[0] + profile->x[last]) / 2;
  for (size_t i = 0; i < profile->count; i++) {
    double fluid = profile->pressure[profile->x[i] < middle ? 0 : last];
    g_assert_cmpfloat(profile->pressure[i], >=, fluid);
  }
  for (size_t i = 1; i < profile->count; i++) {
    g_assert_cmpfloat(profile->x[i], >=, profile->x[i - 1]);
  }
  sb_run_destroy(run);
}

// A jump at first slip ends where the machine, relaxed by it, is in balance with kinetic friction:
// its length times the stiffness is what the force falls by, and the force is the one that the slow
// stroke goes on with, whatever the stiffness.
static void test_jump(void) {
  static const double stiffness[] = {2e3, 2e4, 1e5, 1e7};
  for (size_t i = 0; i < G_N_ELEMENTS(stiffness); i++) {
    Setting machine = {SB_P_DRIVE_STIFFNESS, stiffness[i]};
    SbRun *run = run_cycle(&machine, 1);
    size_t count;
    const SbFrame *frames = sb_run_frames(run, &count);
    const SbStageMark *mark = &sb_run_summary(run)->stage[SB_STAGE_B];
    g_assert_true(mark->reached && mark->frame + 2 < count);
    const SbFrame *before = &frames[mark->frame], *after = before + 1;
    double fall = before->force - after->force;
    g_assert_cmpfloat(fall, >, 0.1);
    g_assert_cmpfloat_with_epsilon(after->displacement - before->displacement, fall / stiffness[i],
                                   1e-6 * fall / stiffness[i]);
    g_assert_cmpfloat_with_epsilon(after[1].force, after->force, 1e-6 * after->force);
    g_assert_cmpfloat_with_epsilon(force_at(run, 2e-3, true), after->force, 1e-6 * after->force);
    sb_run_destroy(run);
  }
}

int main(int argc, char **argv) {
  g_test_init(&argc, &argv, NULL);
  g_test_add_func("/cycle/hand", test_hand);
  g_test_add_func("/cycle/hand-acceptance", test_hand_acceptance);
  g_test_add_func("/cycle/thesis", test_thesis_cycle);
  g_test_add_func("/cycle/roughness", test_roughness);
  g_test_add_func("/cycle/return-of-frames", test_return_of_frames);
  g_test_add_func("/cycle/stuck", test_stuck);
  g_test_add_func("/cycle/may-stop", test_may_stop);
  g_test_add_func("/cycle/dwell-while-loaded", test_dwell_while_loaded);
  g_test_add_func("/cycle/drawn-in", test_drawn_in);
  g_test_add_func("/cycle/held", test_held);
  g_test_add_func("/cycle/drives", test_drives);
  g_test_add_func("/cycle/press", test_press);
  g_test_add_func("/cycle/frames", test_frames);
  g_test_add_func("/cycle/hard-cases", test_hard_cases);
  g_test_add_func("/cycle/land-end", test_land_end);
  g_test_add_func("/cycle/no-contact", test_no_contact);
  g_test_add_func("/cycle/cancel", test_cancel);
  g_test_add_func("/cycle/leakage", test_leakage);
  g_test_add_func("/cycle/static-leak", test_static_leak);
  g_test_add_func("/cycle/plan", test_plan);
  g_test_add_func("/cycle/jump", test_jump);
  g_test_add_func("/cycle/plan-counts", test_plan_counts);
  return g_test_run();
}
