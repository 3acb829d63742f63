// Figures: each has a value or a reason and an error, and an open seal is reported.
#include "engine/contact/fit.h"
#include "engine/valve/run/contradiction.h"
#include "engine/valve/run/run_private.h"
#include "engine/valve/sealbench.h"
#include "engine/valve/shelf/shelf.h"
#include "tests/engine/models.h"
#include "tests/engine/near.h"

#include <glib.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

static double value_at(const SbSummary *summary, const char *path) {
  int index = sb_figure_find(path);
  g_assert_cmpint(index, >=, 0);
  return sb_figure_value(summary, index);
}

static double error_at(const SbSummary *summary, const char *path) {
  return sb_figure_error_absolute(summary, sb_figure_find(path));
}

static const char *reason_at(const SbSummary *summary, const char *path) {
  return sb_figure_reason(summary, sb_figure_find(path));
}

// A value or a reason of its own, never both, and no infinity.
static void check_reasons(const SbSummary *summary) {
  for (int i = 0; i < SB_FIGURE_COUNT; i++) {
    double value = sb_figure_value(summary, i);
    g_assert_false(isinf(value));
    if (isnan(value) && summary->reasons.of[i] == 0) {
      g_error("%s has neither value nor reason", sb_figure(i)->path);
    }
    g_assert_true((sb_figure_reason(summary, i) != NULL) == isnan(value));
  }
}

// Paths are unique, found again, and point at the member that they name.
static void test_paths(void) {
  SbSummary *summary = g_new0(SbSummary, 1);
  for (int i = 0; i < SB_FIGURE_COUNT; i++) {
    g_assert_cmpint(sb_figure_find(sb_figure(i)->path), ==, i);
  }
  summary->seal[SB_INNER].load = 3;
  summary->stage[SB_STAGE_C].force = 5;
  g_assert_cmpfloat(value_at(summary, "seals.inner.load_N"), ==, 3);
  g_assert_cmpfloat(value_at(summary, "seals.outer.load_N"), ==, 0);
  g_assert_cmpfloat(value_at(summary, "cycle.stages.C.force_N"), ==, 5);
  g_assert_cmpint(sb_figure_find("seals.outer"), ==, -1);
  for (int i = 0; i < SB_FIGURE_COUNT; i++) {
    const SbFigure *figure = sb_figure(i);
    // What a user can limit has an error.
    g_assert_true(figure->error != SB_BY_RESIDUAL || figure->verdict == SB_VERDICT_NONE);
    g_assert_true(figure->digits >= 0 && *figure->label != '\0' && *figure->help != '\0');
    // Path and unit agree: what has a unit says it in its key.
    const char *underscore = strrchr(figure->path, '_');
    g_assert_true(strcmp(figure->si, "1") == 0 || strstr(figure->path, "film_by_model") != NULL ||
                  underscore != NULL);
  }
  // Relative to the magnitude; a difference below its error has none to report.
  const int least = sb_figure_find("cycle.force_return_min_N");
  summary->force_return_min = -0.5;
  summary->error[least] = 0.1;
  g_assert_cmpfloat(sb_figure_error(summary, least), ==, 0.2);
  g_assert_null(sb_figure_error_reason(summary, least));
  summary->error[least] = 0.6;
  g_assert_cmpfloat(sb_figure_error(summary, least), ==, 1.2);
  g_assert_true(g_str_has_prefix(sb_figure_error_reason(summary, least), "uncertain"));
  g_assert_cmpfloat(sb_figure_error_absolute(summary, least), ==, 0.6);
  sb_figures_clear(summary);
  g_assert_true(isnan(summary->seal[SB_INNER].load) && isnan(summary->error_load));
  // The first reason stays, and only while there is no value.
  sb_reason(summary, "seals.inner.load_N", "one");
  sb_reason(summary, "seals.*", "two");
  g_assert_cmpstr(reason_at(summary, "seals.inner.load_N"), ==, "one");
  g_assert_cmpstr(reason_at(summary, "seals.outer.load_N"), ==, "two");
  summary->seal[SB_INNER].load = 3;
  g_assert_null(reason_at(summary, "seals.inner.load_N"));
  // More texts than there is room for still give each figure one.
  for (int i = 0; i < SB_FIGURE_COUNT; i++) {
    sb_reason(summary, sb_figure(i)->path, "reason %d", i);
  }
  for (int i = 0; i < SB_FIGURE_COUNT; i++) {
    g_assert_true(summary->reasons.of[i] > 0 && summary->reasons.of[i] <= SB_REASONS_MAX);
  }
  g_free(summary);
}

// The group is that of the path; error estimates of solvers are a group.
static void test_groups(void) {
  static const char *const beginnings[] = {
      [SB_GROUP_CYCLE] = "cycle.",   [SB_GROUP_STAGE] = "cycle.stages.",
      [SB_GROUP_SEAL] = "seals.",    [SB_GROUP_PEOPLE] = "people.",
      [SB_GROUP_DOSE] = "dose.",     [SB_GROUP_RIG] = "rig.",
      [SB_GROUP_LIFE] = "life.",     [SB_GROUP_SHELF] = "shelf.",
      [SB_GROUP_SOLVER] = "solver.",
  };
  for (int i = 0; i < SB_FIGURE_COUNT; i++) {
    const SbFigure *figure = sb_figure(i);
    g_assert_true(g_str_has_prefix(figure->path, beginnings[figure->group]));
    g_assert_true((figure->group == SB_GROUP_STAGE) ==
                  g_str_has_prefix(figure->path, beginnings[SB_GROUP_STAGE]));
    g_assert_true((figure->group == SB_GROUP_SEAL) == (figure->seal < SB_SEAL_COUNT));
    g_assert_true(sb_figure_is_estimate(figure) ==
                  (figure->part == SB_PART_ESTIMATE || figure->part == SB_PART_ESTIMATE_HISTORY ||
                   figure->part == SB_PART_ESTIMATE_SHELF));
    if (figure->group == SB_GROUP_SHELF) {
      g_assert_true((sb_shelf_species(i) == SB_SHELF_WATER) ==
                    (strstr(figure->path, "moisture") != NULL));
    }
  }
}

// A ring that does not reach the bore under pressure: open, and no leak of 0. The shelf's error has
// the reason of the shelf's loss.
static void test_open(void) {
  const Setting changes[] = {{SB_P_MODELS_FIT, SB_FIT_DISC},
                             {SB_P_GLAND_RADIAL_SPACE, 1.57e-3},
                             {SB_P_SEAL_INNER_DIAMETER, 2.476e-3},
                             {SB_P_OUTPUT_VIEWS, SB_VIEW_HYSTERESIS | SB_VIEW_SHELF}};
  SbModel model;
  compile(&model, changes, G_N_ELEMENTS(changes));
  SbRun *run = run_of(&model, SB_OK, NULL);
  const SbSummary *s = sb_run_summary(run);
  check_reasons(s);
  g_assert_cmpint(s->seal[SB_OUTER].leak_state, ==, SB_LEAK_OPEN);
  g_assert_true(isnan(s->leakage_per_cycle) && isnan(s->seal[SB_OUTER].leakage_static) &&
                isnan(s->seal[SB_OUTER].film_min));
  g_assert_cmpfloat(s->seal[SB_OUTER].load, ==, 0);
  g_assert_cmpfloat(s->seal[SB_OUTER].friction_boundary, ==, 0);
  g_assert_cmpint(s->verdict[SB_VERDICT_SEALS].ok, ==, SB_ANSWER_NO);
  g_assert_nonnull(strstr(s->verdict[SB_VERDICT_SEALS].reason, "open"));
  size_t count;
  const SbFrame *frames = sb_run_frames(run, &count);
  g_assert_cmpuint(count, >, 0);
  for (size_t i = 0; i < count; i++) {
    g_assert_true(isnan(frames[i].seal[SB_OUTER].film_min) &&
                  isnan(frames[i].seal[SB_OUTER].film_central));
  }
  sb_run_destroy(run);
  // A small squeeze under a pressure that the rubber cannot hold off opens the contact.
  for (int coupled = 0; coupled < 2; coupled++) {
    const Setting pressed[] = {
        {SB_P_GLAND_RADIAL_SPACE, 1.56e-3},
        {SB_P_MODELS_FIT, SB_FIT_HERTZ},
        {SB_P_MODELS_FILM, SB_FILM_REYNOLDS},
        {SB_P_CANISTER_PRESSURE, 2e6},
        {coupled ? SB_P_MODELS_ASPERITIES : -1, SB_MODEL_ASPERITIES_COUPLED}};
    compile(&model, pressed, G_N_ELEMENTS(pressed));
    run = run_of(&model, SB_OK, NULL);
    s = sb_run_summary(run);
    check_reasons(s);
    g_assert_true(s->seal[SB_OUTER].opened);
    g_assert_cmpint(s->seal[SB_OUTER].leak_state, ==, SB_LEAK_OPEN);
    g_assert_true(isnan(s->returned) && isnan(s->force_peak));
    g_assert_cmpint(s->verdict[SB_VERDICT_RETURNS].ok, ==, SB_ANSWER_UNKNOWN);
    sb_run_frames(run, &count);
    g_assert_cmpuint(count, ==, 0);
    sb_run_destroy(run);
  }
}

// With an inner diameter of 2.2 mm the solved ring does not reach the bore. Models that do not
// solve the stretch cannot state that it seals, and warn; of the valve as shipped they can.
static void test_stretch(void) {
  static const double inner[] = {2.84e-3, 2.2e-3};
  static const SbFitModel fits[] = {SB_FIT_KARASZKIEWICZ, SB_FIT_DISC_THESIS};
  for (int i = 0; i < 4; i++) {
    const Setting changes[] = {{SB_P_SEAL_INNER_DIAMETER, inner[i % 2]},
                               {SB_P_MODELS_FIT, fits[i / 2]}};
    SbModel model;
    compile(&model, changes, G_N_ELEMENTS(changes));
    SbRun *run = run_of(&model, SB_OK, NULL);
    const SbVerdict *seals = &sb_run_summary(run)->verdict[SB_VERDICT_SEALS];
    const bool open = i % 2 == 1;
    g_assert_cmpint(seals->ok, ==, open ? SB_ANSWER_UNKNOWN : SB_ANSWER_YES);
    g_assert_cmpint(g_str_has_prefix(seals->reason, "uncertain: stretched"), ==, open);
    g_assert_true(warned(&sb_run_summary(run)->warnings, "stretch-interference"));
    sb_run_destroy(run);
  }
}

// A ring that overfills its groove: models that do not know the walls warn, and cannot state that
// it seals or returns.
static void test_overfilled(void) {
  for (int full = 0; full < 2; full++) {
    const Setting changes[] = {{SB_P_GLAND_AXIAL_WIDTH, full ? 1.4e-3 : 1.5e-3}};
    SbModel model;
    compile(&model, changes, G_N_ELEMENTS(changes));
    SbRun *run = run_of(&model, SB_OK, NULL);
    const SbVerdict *seals = &sb_run_summary(run)->verdict[SB_VERDICT_SEALS];
    g_assert_cmpint(seals->ok, ==, full ? SB_ANSWER_UNKNOWN : SB_ANSWER_YES);
    g_assert_cmpint(strstr(seals->reason, "overfills") != NULL, ==, full);
    const SbVerdict *returns = &sb_run_summary(run)->verdict[SB_VERDICT_RETURNS];
    g_assert_cmpint(returns->ok, ==, full ? SB_ANSWER_UNKNOWN : SB_ANSWER_YES);
    g_assert_cmpint(strstr(returns->reason, "overfills") != NULL, ==, full);
    g_assert_cmpint(warned(&sb_run_summary(run)->warnings, "gland-overfilled"), ==, full);
    sb_run_destroy(run);
  }
}

// Every state of a leak path: closed, channels, none that a surface's theory tells.
static void test_leak_states(void) {
  enum { PERSSON = 1 };
  SbModel model;
  const Setting even[] = {{SB_P_MODELS_SURFACE, PERSSON}};
  compile(&model, even, 1);
  SbRun *run = run_of(&model, SB_OK, NULL);
  check_reasons(sb_run_summary(run));
  g_assert_cmpint(sb_run_summary(run)->seal[SB_INNER].leak_state, ==, SB_LEAK_CLOSED);
  g_assert_cmpfloat(sb_run_summary(run)->seal[SB_INNER].leakage_static, ==, 0);
  sb_run_destroy(run);
  const Setting rough[] = {{SB_P_MODELS_SURFACE, PERSSON},
                           {SB_P_SURFACE_SIGMA_OVER_BETA, 1},
                           {SB_P_SURFACE_GT_PRODUCT, 0.03}};
  compile(&model, rough, G_N_ELEMENTS(rough));
  run = run_of(&model, SB_OK, NULL);
  g_assert_cmpint(sb_run_summary(run)->seal[SB_OUTER].leak_state, ==, SB_LEAK_PERCOLATING);
  g_assert_cmpfloat(sb_run_summary(run)->seal[SB_OUTER].leakage_static, >, 0);
  g_assert_cmpint(sb_run_summary(run)->verdict[SB_VERDICT_SEALS].ok, ==, SB_ANSWER_YES);
  sb_run_destroy(run);
  const Setting none[] = {{-1, 0}};
  const Setting flooded[] = {{SB_P_MODELS_ASPERITIES, SB_MODEL_ASPERITIES_COUPLED}};
  const struct {
    const Setting *settings;
    const char *why;
  } unknown[] = {{none, "near full contact"}, {flooded, "near full contact"}};
  for (size_t i = 0; i < G_N_ELEMENTS(unknown); i++) {
    compile(&model, unknown[i].settings, 1);
    run = run_of(&model, SB_OK, NULL);
    const SbSummary *s = sb_run_summary(run);
    check_reasons(s);
    g_assert_cmpint(s->seal[SB_OUTER].leak_state, ==, SB_LEAK_NOT_COMPUTED);
    g_assert_true(isnan(s->seal[SB_OUTER].leakage_static));
    g_assert_true(isnan(s->seal[SB_OUTER].leak_area_share));
    g_assert_nonnull(strstr(reason_at(s, "seals.outer.leakage_static_m3_per_s"), unknown[i].why));
    sb_run_destroy(run);
  }
}

// Friction and leak take the same real contact, and boundary friction is its shear, in every state
// that a run keeps: bare law, asperities coupled, any surface.
static void test_one_contact(void) {
  for (int i = 0; i < 16; i++) {
    const bool persson = i & 1, coupled = i & 2, shear = i & 4, disc = i & 8;
    const Setting settings[] = {
        {SB_P_MODELS_SURFACE, persson},
        {SB_P_MODELS_ASPERITIES, coupled},
        {SB_P_MODELS_FRICTION, shear},
        {shear ? -1 : SB_P_FRICTION_LOAD_COEFFICIENT, 0},
        {SB_P_MODELS_FIT, disc ? SB_FIT_DISC : SB_FIT_KARASZKIEWICZ},
        {SB_P_FRICTION_SHEAR_STRENGTH, persson ? 0.1e6 : 3.5e6},
    };
    SbModel model;
    compile(&model, settings, G_N_ELEMENTS(settings));
    SbRun *run = run_of(&model, SB_OK, NULL);
    const SbSummary *s = sb_run_summary(run);
    for (int seal = 0; seal < SB_SEAL_COUNT; seal++) {
      const SbSealState *of = &s->seal[seal];
      const double area = of->contact_width * model.bore_circumference;
      const double law = model.shear_strength * of->real_area_share * area;
      g_assert_cmpfloat(of->real_area_share, >, 0);
      g_assert_cmpfloat(fabs(of->friction_boundary / law - 1), <, 1e-9);
      const double rest = model.static_ratio * model.shear_strength * of->rest_area_share * area;
      g_assert_cmpfloat(fabs(of->friction_static / rest - 1), <, 1e-9);
      if (persson) {
        g_assert_cmpfloat(of->leak_area_share, ==, of->rest_area_share);
        g_assert_cmpint(of->leak_state, ==, SB_LEAK_CLOSED);
      } else {
        g_assert_cmpint(of->leak_state, ==, SB_LEAK_NOT_COMPUTED);
      }
    }
    sb_run_destroy(run);
  }
}

// A ring that its friction drags: the real area that is told is the one that is sheared, both ways.
static void test_dragged_contact(void) {
  const Setting settings[] = {
      {SB_P_MODELS_FIT, SB_FIT_RING},      {SB_P_MODELS_FRICTION, SB_MODEL_FRICTION_SHEAR},
      {SB_P_GLAND_FLOOR_FRICTION, 0.3},    {SB_P_GLAND_WALL_FRICTION, 0.1},
      {SB_P_FRICTION_SHEAR_STRENGTH, 2e6}, {SB_P_OUTPUT_TOLERANCE, 1e-2}};
  SbModel model;
  compile(&model, settings, G_N_ELEMENTS(settings));
  SbRun *run = run_of(&model, SB_OK, NULL);
  for (int i = 0; i < SB_RUN_MOTIONS * SB_CYCLE_CHAMBERS * SB_SEAL_COUNT; i++) {
    const SbSealState *of = &run->cycle.state[0][0][0] + i;
    if (i % SB_RUN_MOTIONS == SB_RUN_REST || !(of->load > 0) || of->section != SB_RING_SLIDES) {
      continue;
    }
    const double area = (of->contact_right - of->contact_left) * model.bore_circumference;
    const double law = model.shear_strength * of->real_area_share * area;
    g_assert_cmpfloat(fabs(of->boundary_area / law - 1), <, 1e-9);
    g_assert_cmpfloat(of->boundary_load, ==, 0);
    g_assert_cmpfloat(fabs(of->rest_area / (model.shear_strength * of->rest_area_share * area) - 1),
                      <, 1e-9);
  }
  g_assert_cmpint(run->cycle.state[SB_OUTER][SB_CHAMBER_AT_REST][SB_CYCLE_IN].section, ==,
                  SB_RING_SLIDES);
  sb_run_destroy(run);
}

// Shear strength scales boundary friction and nothing that leaks.
static void test_shear_strength(void) {
  double friction[2], leak[2], share[2];
  for (int i = 0; i < 2; i++) {
    const Setting settings[] = {{SB_P_MODELS_SURFACE, 1},
                                {SB_P_FRICTION_LOAD_COEFFICIENT, 0},
                                {SB_P_SURFACE_SIGMA_OVER_BETA, 1},
                                {SB_P_SURFACE_GT_PRODUCT, 0.03},
                                {SB_P_FRICTION_SHEAR_STRENGTH, (i + 1) * 0.1e6}};
    SbModel model;
    compile(&model, settings, G_N_ELEMENTS(settings));
    SbRun *run = run_of(&model, SB_OK, NULL);
    const SbSealState *of = &sb_run_summary(run)->seal[SB_OUTER];
    friction[i] = of->friction_boundary;
    leak[i] = of->leakage_static;
    share[i] = of->leak_area_share;
    g_assert_cmpfloat(sb_run_summary(run)->seal[SB_INNER].leak_area_share, <, share[i]);
    sb_run_destroy(run);
  }
  g_assert_cmpfloat(fabs(friction[1] / friction[0] - 2), <, 1e-12);
  g_assert_cmpfloat(leak[0], >, 0);
  g_assert_cmpfloat(leak[1], ==, leak[0]);
  g_assert_cmpfloat(share[1], ==, share[0]);
}

// What is carried one way by a stem that stays in is no loss of a cycle.
static void test_one_way(void) {
  for (int motion = 0; motion < 2; motion++) {
    const Setting changes[] = {{SB_P_SURFACE_GT_PRODUCT, 0.1289 * 1.3},
                               {SB_P_MODELS_MOTION, motion}};
    SbModel model;
    compile(&model, changes, G_N_ELEMENTS(changes));
    SbRun *run = run_of(&model, SB_OK, NULL);
    const SbSummary *s = sb_run_summary(run);
    check_reasons(s);
    g_assert_cmpfloat(s->returned, ==, 0);
    g_assert_true(isnan(s->leakage_per_cycle) && isnan(s->leakage_net));
    g_assert_true(isnan(s->leakage_carried)); // there is no second actuation
    g_assert_nonnull(strstr(reason_at(s, "cycle.leakage_per_cycle_m3"), "in one direction"));
    g_assert_cmpint(s->verdict[SB_VERDICT_RETURNS].ok, ==, SB_ANSWER_NO);
    sb_run_destroy(run);
  }
}

// Figures of a cycle that did not happen are missing with its outcome as the reason: of a stem that
// sticks where its motion begins, and of one that delivers nothing.
static void test_stuck_without_cycle(void) {
  const Setting cases[][3] = {
      {{SB_P_CANISTER_PRESSURE, -0.05e6}, {SB_P_OUTPUT_FRAMES, 60}, {SB_P_OUTPUT_FRAMES, 60}},
      {{SB_P_CANISTER_PRESSURE, 0.2e6},
       {SB_P_MODELS_MOTION, SB_MODEL_MOTION_DYNAMIC},
       {SB_P_DRIVE_KIND, SB_MODEL_DRIVE_FREE_RETURN}}};
  static const char *const missing[] = {
      "cycle.leakage_per_cycle_m3", "cycle.leakage_net_all_actuations_m3",
      "cycle.leakage_carried_all_actuations_m3", "cycle.dose_mass_kg"};
  for (size_t i = 0; i < G_N_ELEMENTS(cases); i++) {
    SbModel model;
    compile(&model, cases[i], 3);
    SbRun *run = run_of(&model, SB_OK, NULL);
    const SbSummary *s = sb_run_summary(run);
    check_reasons(s);
    g_assert_cmpint(s->outcome, ==, SB_OUTCOME_STUCK);
    for (size_t k = 0; k < G_N_ELEMENTS(missing); k++) {
      g_assert_true(isnan(value_at(s, missing[k])));
      g_assert_nonnull(strstr(reason_at(s, missing[k]), "stuck at"));
    }
    sb_run_destroy(run);
  }
}

// Nothing is known of the films' leakage through a seal without contact: least of all that it is 0.
static void test_open_leakage(void) {
  const Setting changes[] = {{SB_P_VALVE_KIND, SB_VALVE_GASKET},
                             {SB_P_GASKET_CRIMP, 0},
                             // Nearly as wide as the stem: its first contact takes few steps.
                             {SB_P_GASKET_BORE_DIAMETER, 3.25e-3},
                             {SB_P_MODELS_MOTION, SB_MODEL_MOTION_DYNAMIC}};
  SbModel model;
  compile(&model, changes, G_N_ELEMENTS(changes));
  SbRun *run = run_of(&model, SB_OK, NULL);
  const SbSummary *s = sb_run_summary(run);
  check_reasons(s);
  g_assert_cmpint(s->seal[SB_OUTER].leak_state, ==, SB_LEAK_OPEN);
  g_assert_true(isnan(s->leakage_per_cycle) && isnan(s->leakage_net) && isnan(s->leakage_carried));
  g_assert_nonnull(strstr(reason_at(s, "cycle.leakage_per_cycle_m3"), "the outer seal is open"));
  sb_run_destroy(run);
}

// A contact that the fluid opens in any state of the cycle does not seal: in either direction, and
// of either seal.
static void test_opened(void) {
  SbModel model;
  compile(&model, NULL, 0);
  for (int i = 0; i < 4; i++) {
    const int seal = i % 2, motion = i / 2;
    SbRun *run = run_of(&model, SB_OK, NULL);
    const SbSummary *s = sb_run_summary(run);
    g_assert_cmpint(s->verdict[SB_VERDICT_SEALS].ok, ==, SB_ANSWER_YES);
    run->cycle.state[seal][SB_CHAMBER_CLOSED][motion].opened = true;
    memset(&run->summary.reasons, 0, sizeof run->summary.reasons);
    sb_run_summarise_seals(run);
    sb_run_leave_out(run);
    sb_verdict_fill(&run->summary, &model);
    g_assert_cmpint(s->seal[seal].leak_state, ==, SB_LEAK_OPEN);
    g_assert_cmpint(s->verdict[SB_VERDICT_SEALS].ok, ==, SB_ANSWER_NO);
    g_assert_nonnull(strstr(s->verdict[SB_VERDICT_SEALS].reason, "the fluid opens the contact"));
    g_assert_cmpint(isnan(s->leakage_per_cycle), ==, seal == SB_OUTER);
    bool told = false;
    for (size_t k = 0; k < s->warnings.count; k++) {
      told = told || strcmp(s->warnings.item[k].code, "seal-open") == 0;
    }
    g_assert_true(told);
    sb_run_destroy(run);
  }
}

// Shares of people by the normal distribution function; of a plate that nobody presses, none.
static void test_people(void) {
  const Setting changes[] = {{SB_P_PEOPLE_MEN_STRENGTH, 30},
                             {SB_P_MODELS_MOTION, SB_MODEL_MOTION_RIG},
                             {SB_P_RIG_DURATION, 0.2}};
  SbModel model;
  compile(&model, changes, 1);
  SbRun *run = run_of(&model, SB_OK, NULL);
  const SbSummary *s = sb_run_summary(run);
  const double forces[] = {value_at(s, "cycle.force_peak_N"),
                           value_at(s, "cycle.force_breakaway_N")};
  static const char *const of[] = {"peak", "breakaway"};
  check_reasons(s);
  for (int i = 0; i < 2; i++) {
    char women[64], men[64];
    snprintf(women, sizeof women, "people.women_below_%s", of[i]);
    snprintf(men, sizeof men, "people.men_below_%s", of[i]);
    assert_close(value_at(s, women), erfc((31.34 - forces[i]) / 9.94 / M_SQRT2) / 2, 1e-12);
    assert_close(value_at(s, men), erfc((30 - forces[i]) / 5.80 / M_SQRT2) / 2, 1e-12);
  }
  sb_run_destroy(run);
  compile(&model, changes, G_N_ELEMENTS(changes));
  run = run_of(&model, SB_OK, NULL);
  check_reasons(sb_run_summary(run));
  g_assert_nonnull(
      strstr(reason_at(sb_run_summary(run), "people.men_below_peak"), "not pressed by a person"));
  sb_run_destroy(run);
}

// A solver that fails names itself and its place; nothing after it is computed, least of all 0.
static void test_failure(void) {
  // Ten steps are too few for a ring.
  const Setting changes[] = {{SB_P_MODELS_FIT, SB_FIT_RING}, {SB_P_OUTPUT_WORK_LIMIT, 10}};
  SbModel model;
  compile(&model, changes, G_N_ELEMENTS(changes));
  SbReport report = {0};
  SbRun *run = run_of(&model, SB_ERROR_NOT_CONVERGED, &report);
  const SbSummary *s = sb_run_summary(run);
  check_reasons(s);
  static const char *const words[] = {"fitment (ring)", "outer seal", "stages A to C", "MPa",
                                      "available:"};
  for (size_t i = 0; i < G_N_ELEMENTS(words); i++) {
    g_assert_nonnull(strstr(report.text, words[i]));
  }
  g_assert_true(isnan(s->returned) && isnan(s->force_peak) && isnan(s->seal[SB_OUTER].load));
  g_assert_true(isnan(s->seal[SB_OUTER].friction_boundary) && isnan(s->leakage_per_cycle));
  g_assert_false(s->returns);
  g_assert_cmpint(s->seal[SB_OUTER].leak_state, ==, SB_LEAK_NOT_COMPUTED);
  g_assert_cmpint(s->verdict[SB_VERDICT_SEALS].ok, ==, SB_ANSWER_UNKNOWN);
  g_assert_cmpint(s->verdict[SB_VERDICT_RETURNS].ok, ==, SB_ANSWER_UNKNOWN);
  for (size_t i = 0; i < s->warnings.count; i++) {
    g_assert_cmpstr(s->warnings.item[i].code, !=, "no-return");
  }
  sb_run_destroy(run);
}

static bool at_once(void *data) {
  return true;
}

static void test_cancelled(void) {
  SbModel model;
  compile(&model, NULL, 0);
  SbPlan plan;
  SbRun *run;
  SbRunHooks hooks = {.cancelled = at_once};
  sb_plan_make(&plan, &model);
  g_assert_cmpint(sb_run_create(&run, &model, &plan, NULL), ==, SB_OK);
  g_assert_cmpint(sb_run_execute(run, &hooks, NULL), ==, SB_ERROR_CANCELLED);
  check_reasons(sb_run_summary(run));
  g_assert_true(isnan(sb_run_summary(run)->force_peak));
  sb_run_destroy(run);
}

// A stem that a finger pushes against its spring and that moves by rounding alone: no work was
// done, and none of it is missing.
static void test_no_work(void) {
  static const struct {
    const char *key;
    double value;
  } given[] = {
      {"bore.diameter", 0.0060850067221859148},
      {"gland.radial_space", 0.0014541649783573285},
      {"seal.section_diameter", 0.0016389222469116867},
      {"seal.inner_diameter", 0.0031048101495473848},
      {"gland.axial_width", 0.0024515357650272841},
      {"stem.pressure_diameter", 0.0056695482412264415},
      {"stem.seal_spacing", 0.0079632467755437492},
      {"stem.mass", 0.0014954990978140856},
      {"drive.stroke", 0.0091100483299035827},
      {"bore.land_edge", 0.0028934116219645656},
      {"seal.modulus", 9348628.373423053},
      {"seal.poisson_ratio", 0.47864702077699733},
      {"canister.pressure", 203714.15350229875},
      {"fluid.viscosity", 0.001564476962023591},
      {"fluid.density", 1225.4390932914043},
      {"surface.sigma", 2.1101547329588119e-07},
      {"surface.sigma_over_beta", 0.10495317228036885},
      {"surface.gt_product", 0.12402744874086596},
      {"friction.shear_strength", 520712.56170646619},
      {"friction.load_coefficient", 0.086104200606190825},
      {"friction.static_ratio", 1.2833337546709993},
      {"drive.speed", 0.0021669299471111874},
      {"drive.stiffness", 69418.230367370488},
      {"drive.reversal_force", 10.629082351675589},
      {"output.frames", 50},
      {"models.fit", 0},
      {"models.film", 1},
      {"models.surface", 1},
      {"models.asperities", 0},
      {"models.motion", 1},
      {"canister.pressure_map", 2},
      {"drive.kind", 1},
      {"drive.peak_force", 30.12494939825007},
      {"drive.rise_time", 0.17781384485451798},
      {"drive.finger_damping", 2.2458712868076258},
      {"drive.amplitude", 0.0037682224307920729},
      {"drive.frequency", 0.17493126260815928},
      {"housing.stop_restitution", 0.39236492844735427},
      {"housing.stop_stiffness", 1566544.4565088691},
      {"drive.damping_ratio", 0.050000000000000003},
      {"stem.spring_stiffness", 231.58337111241585},
      {"stem.spring_preload", 19.234077115145674},
      {"friction.stribeck_speed", 0.0003006498678997551},
  };
  SbParams params;
  SbModel model;
  sb_params_init(&params);
  for (size_t i = 0; i < G_N_ELEMENTS(given); i++) {
    SbParamId id = (SbParamId)sb_param_find(given[i].key);
    g_assert_cmpint(sb_params_set(&params, id, given[i].value, NULL), ==, SB_OK);
  }
  g_assert_cmpint(sb_model_compile(&model, &params, NULL, NULL), ==, SB_OK);
  SbRun *run = run_of(&model, SB_OK, NULL);
  g_assert_cmpfloat(sb_run_summary(run)->energy.closure, ==, 0);
  g_assert_cmpfloat(sb_run_summary(run)->energy.external_max, <, 1e-12);
  sb_run_destroy(run);
}

// Impossible geometry is refused, and what is hardly meant is told.
static void test_geometry(void) {
  SbParams params;
  SbModel model;
  SbProblems problems;
  sb_params_init(&params);
  g_assert_cmpint(sb_params_set(&params, SB_P_STEM_PRESSURE_DIAMETER, 3.2e-3, NULL), ==, SB_OK);
  g_assert_cmpint(sb_model_compile(&model, &params, NULL, &problems), ==, SB_ERROR_INPUT);
  g_assert_cmpstr(problems.item[0].key, ==, "stem.pressure_diameter");
  g_assert_cmpfloat_with_epsilon(problems.item[0].min, 3.28e-3, 1e-12);
  const Setting changes[] = {{SB_P_CANISTER_PRESSURE_MAP, SB_MAP_PORTS},
                             {SB_P_MODELS_MOTION, SB_MODEL_MOTION_DYNAMIC}};
  compile(&model, changes, G_N_ELEMENTS(changes));
  sb_model_remarks(&model, &problems);
  g_assert_cmpuint(problems.count, ==, 1);
  g_assert_cmpstr(problems.item[0].key, ==, "bore.vent_position");
  SbRun *run = run_of(&model, SB_OK, NULL);
  bool told = false;
  const SbWarnings *warnings = &sb_run_summary(run)->warnings;
  for (size_t i = 0; i < warnings->count; i++) {
    told = told || strcmp(warnings->item[i].code, "ports-no-vent") == 0;
  }
  g_assert_true(told);
  sb_run_destroy(run);
  // Inside the range there is nothing to say.
  model.shape.vent_position = 0.99 * problems.item[0].max;
  sb_model_remarks(&model, &problems);
  g_assert_cmpuint(problems.count, ==, 0);
}

// Every figure of a run has an error or a reason; inputs and closed forms have the error 0, a peak
// that the drive's reversal sets too; a difference has the sum of its terms' errors.
static void test_errors(void) {
  SbModel model;
  SbParams params;
  sb_params_init(&params);
  for (int disc = 0; disc < 2; disc++) {
    g_assert_cmpint(sb_params_set(&params, SB_P_MODELS_FIT,
                                  disc > 0 ? SB_FIT_DISC : SB_FIT_KARASZKIEWICZ, NULL),
                    ==, SB_OK);
    g_assert_cmpint(sb_params_set(&params, SB_P_OUTPUT_TOLERANCE, 0.05, NULL), ==, SB_OK);
    g_assert_cmpint(sb_model_compile(&model, &params, NULL, NULL), ==, SB_OK);
    SbPlan plan;
    SbRun *run;
    sb_plan_make(&plan, &model);
    g_assert_cmpint(sb_run_create(&run, &model, &plan, NULL), ==, SB_OK);
    g_assert_cmpint(sb_run_execute(run, NULL, NULL), ==, SB_OK);
    const SbSummary *summary = sb_run_summary(run);
    for (int i = 0; i < SB_FIGURE_COUNT; i++) {
      const double error = sb_figure_error(summary, i);
      g_assert_true(sb_figure_error_reason(summary, i) != NULL || error >= 0);
      g_assert_true(disc > 0 || !(sb_figure_value(summary, i) > 0) || error == 0 || isnan(error));
    }
    const double of_return = error_at(summary, "cycle.force_return_min_N");
    const double terms = error_at(summary, "seals.outer.contact.return.friction_N") +
                         error_at(summary, "seals.inner.contact.return.friction_N");
    g_assert_cmpfloat(error_at(summary, "cycle.force_peak_N"), ==, 0);
    g_assert_cmpfloat(error_at(summary, "cycle.pressure_force_N"), ==, 0);
    g_assert_cmpfloat(fabs(of_return - terms), <=, 1e-6 * terms);
    g_assert_true((terms > 0) == (disc > 0));
    sb_run_destroy(run);
  }
}

int main(int argc, char **argv) {
  g_test_init(&argc, &argv, NULL);
  g_test_add_func("/figures/paths", test_paths);
  g_test_add_func("/figures/groups", test_groups);
  g_test_add_func("/figures/open", test_open);
  g_test_add_func("/figures/stretch", test_stretch);
  g_test_add_func("/figures/overfilled", test_overfilled);
  g_test_add_func("/figures/leak-states", test_leak_states);
  g_test_add_func("/figures/one-contact", test_one_contact);
  g_test_add_func("/figures/dragged-contact", test_dragged_contact);
  g_test_add_func("/figures/shear-strength", test_shear_strength);
  g_test_add_func("/figures/one-way", test_one_way);
  g_test_add_func("/figures/stuck-without-cycle", test_stuck_without_cycle);
  g_test_add_func("/figures/open-leakage", test_open_leakage);
  g_test_add_func("/figures/opened", test_opened);
  g_test_add_func("/figures/people", test_people);
  g_test_add_func("/figures/failure", test_failure);
  g_test_add_func("/figures/cancelled", test_cancelled);
  g_test_add_func("/figures/no-work", test_no_work);
  g_test_add_func("/figures/geometry", test_geometry);
  g_test_add_func("/figures/errors", test_errors);
  return g_test_run();
}
