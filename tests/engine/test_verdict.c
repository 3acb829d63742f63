// The verdict follows the limits: the worst seal, contradictions, the return and uncertain figures.
#include "engine/contact/fit.h"
#include "engine/valve/run/contradiction.h"
#include "engine/valve/run/run_private.h"
#include "engine/valve/sealbench.h"
#include "tests/engine/models.h"
#include "tests/engine/near.h"

#include <glib.h>
#include <math.h>
#include <string.h>

static void limit(SbModel *model, const char *path, double low, double high) {
  model->limits.item[model->limits.count++] = (SbLimit){sb_figure_find(path), low, high};
}

static void test_verdict(void) {
  SbModel model;
  compile(&model, NULL, 0);
  limit(&model, "cycle.force_breakaway_N", -INFINITY, 40);
  limit(&model, "cycle.force_peak_N", -INFINITY, 34);
  limit(&model, "seals.outer.squeeze", 0.1, 0.2);
  limit(&model, "seals.inner.gland_fill", 0.1, 0.72);
  limit(&model, "cycle.force_return_min_N", 5, INFINITY);
  SbRun *run = run_of(&model, SB_OK, NULL);
  const SbVerdict *of = sb_run_summary(run)->verdict;
  // The worst decides: the peak is the reversal force, 35 N.
  g_assert_cmpint(of[SB_VERDICT_PRESSES].ok, ==, SB_ANSWER_NO);
  g_assert_cmpstr(sb_figure(of[SB_VERDICT_PRESSES].figure)->path, ==, "cycle.force_peak_N");
  g_assert_cmpfloat(of[SB_VERDICT_PRESSES].limit, ==, 34);
  // Of two that hold, the nearer to its bound.
  g_assert_cmpint(of[SB_VERDICT_FITS].ok, ==, SB_ANSWER_YES);
  g_assert_cmpstr(sb_figure(of[SB_VERDICT_FITS].figure)->path, ==, "seals.inner.gland_fill");
  g_assert_cmpfloat(of[SB_VERDICT_FITS].limit, ==, 0.72);
  // It returns, but not with the force asked for.
  g_assert_true(sb_run_summary(run)->returns);
  g_assert_cmpint(of[SB_VERDICT_RETURNS].ok, ==, SB_ANSWER_NO);
  g_assert_cmpint(of[SB_VERDICT_LEAK].ok, ==, SB_ANSWER_UNKNOWN);
  g_assert_cmpint(of[SB_VERDICT_LEAK].figure, ==, -1);
  sb_run_destroy(run);
}

// Limits on films and times judge the state of the rings, not the force of the user.
static void test_films(void) {
  SbModel model;
  compile(&model, NULL, 0);
  limit(&model, "seals.inner.film_min_m", 1, INFINITY);
  limit(&model, "cycle.duration_s", -INFINITY, 1e6);
  SbRun *run = run_of(&model, SB_OK, NULL);
  const SbVerdict *of = sb_run_summary(run)->verdict;
  g_assert_cmpint(of[SB_VERDICT_PRESSES].figure, ==, -1);
  g_assert_cmpint(of[SB_VERDICT_FITS].ok, ==, SB_ANSWER_NO);
  g_assert_cmpstr(sb_figure(of[SB_VERDICT_FITS].figure)->path, ==, "seals.inner.film_min_m");
  sb_run_destroy(run);
}

// A no before what is unknown before a yes; of two alike the one that is worse by its limit.
static void test_worse(void) {
  static const struct {
    SbVerdict worst, next;
    bool taken;
  } cases[] = {
      {{SB_ANSWER_YES, 0, 20, 40, ""}, {SB_ANSWER_YES, 1, 39, 40, ""}, true},
      {{SB_ANSWER_YES, 0, 39, 40, ""}, {SB_ANSWER_YES, 1, 20, 40, ""}, false},
      {{SB_ANSWER_YES, 0, 39, 40, ""}, {SB_ANSWER_UNKNOWN, 1, NAN, 40, ""}, true},
      {{SB_ANSWER_UNKNOWN, 0, NAN, 40, ""}, {SB_ANSWER_YES, 1, 39, 40, ""}, false},
      {{SB_ANSWER_UNKNOWN, 0, NAN, 40, ""}, {SB_ANSWER_NO, 1, 41, 40, ""}, true},
      {{SB_ANSWER_NO, 0, 41, 40, ""}, {SB_ANSWER_NO, 1, 60, 40, ""}, true},
      {{SB_ANSWER_NO, 0, 60, 40, ""}, {SB_ANSWER_NO, 1, 41, 40, ""}, false},
      {{SB_ANSWER_NO, 0, 60, 40, ""}, {SB_ANSWER_NO, 1, NAN, 40, ""}, true},
      {{SB_ANSWER_NO, 0, NAN, 40, ""}, {SB_ANSWER_NO, 1, 60, 40, ""}, false},
      {{SB_ANSWER_UNKNOWN, -1, NAN, NAN, ""}, {SB_ANSWER_YES, 1, 39, 40, ""}, true},
  };
  for (size_t i = 0; i < G_N_ELEMENTS(cases); i++) {
    SbVerdict worst = cases[i].worst;
    g_assert_cmpint(sb_verdict_take_worse(&worst, &cases[i].next), ==, cases[i].taken);
    g_assert_cmpint(worst.figure, ==, cases[i].taken ? 1 : 0);
  }
}

// A run has no contradiction, and each kind of it is found in a summary that is wrong on purpose.
static void test_contradictions(void) {
  SbModel model;
  char text[256];
  compile(&model, NULL, 0);
  limit(&model, "cycle.force_breakaway_N", -INFINITY, 40);
  SbRun *run = run_of(&model, SB_OK, NULL);
  const SbSummary *good = sb_run_summary(run);
  g_assert_false(sb_summary_contradiction(text, sizeof text, good, &model));
  g_assert_cmpstr(text, ==, "");
  SbSummary *bad = g_new(SbSummary, 1);
  enum {
    RETURNS,
    STUCK,
    NEVER,
    VERDICT,
    VALUE,
    LIMIT,
    SHARE,
    PEAK,
    PRESS,
    DWELL,
    CYCLES,
    UNKNOWN,
    OPEN,
    OPENED,
    BACK,
    TWICE,
    KINDS
  };
  for (int kind = 0; kind < KINDS; kind++) {
    *bad = *good;
    switch (kind) {
    case RETURNS: // the fault of a hand that moves nothing
      bad->outcome = SB_OUTCOME_NEVER_MOVED;
      break;
    case STUCK:
      bad->stuck_at = 1e-3;
      break;
    case NEVER:
      bad->outcome = SB_OUTCOME_NEVER_MOVED;
      bad->returns = false;
      bad->returned = NAN;
      break;
    case VERDICT:
      bad->force_return_margin = bad->verdict[SB_VERDICT_RETURNS].value = -1;
      break;
    case VALUE:
      bad->verdict[SB_VERDICT_PRESSES].value += 1;
      break;
    case LIMIT:
      bad->stage[SB_STAGE_B].force = bad->force_breakaway = bad->force_press = bad->force_peak = 41;
      bad->verdict[SB_VERDICT_PRESSES].value = 41;
      break;
    case SHARE:
      bad->seal[SB_OUTER].rest_area_share = 1.01;
      break;
    case PEAK:
      bad->stage[SB_STAGE_C].force = 1.01 * bad->force_peak;
      break;
    case PRESS:
      bad->force_press = 0.99 * bad->force_breakaway;
      break;
    case DWELL: // presses that forgot the rest at the stop
      bad->dwell = 0;
      break;
    case CYCLES: // a sum of three cycles
      bad->energy.loop *= 3;
      break;
    case UNKNOWN:
      bad->outcome = SB_OUTCOME_UNKNOWN;
      bad->returns = false;
      bad->returned = NAN;
      break;
    case OPEN:
      bad->seal[SB_OUTER].leak_state = SB_LEAK_OPEN;
      break;
    case OPENED:
      bad->seal[SB_INNER].opened = true;
      bad->seal[SB_INNER].leak_state = SB_LEAK_CLOSED;
      break;
    case BACK:
      bad->contact[SB_OUTER].back.friction = NAN;
      bad->seal[SB_OUTER].leak_state = SB_LEAK_PERCOLATING;
      break;
    default:
      bad->contact[SB_OUTER].in_stroke.load *= 1.001;
      break;
    }
    g_assert_true(sb_summary_contradiction(text, sizeof text, bad, &model));
    g_assert_cmpstr(text, !=, "");
    g_test_message("%d: %s", kind, text);
  }
  g_free(bad);
  sb_run_destroy(run);
}

// A limit on another figure of the return judges that figure only: where it does not hold the
// answer names it, where it holds the return margin decides.
static void test_limits_of_return(void) {
  static const struct {
    const char *path;
    double low, ratio; // of static friction
    SbAnswer ok;
    const char *figure;
  } cases[] = {
      {"cycle.force_return_min_N", 1, 1.1, SB_ANSWER_YES, "cycle.force_return_margin_N"},
      {"cycle.force_return_min_N", 2, 1.1, SB_ANSWER_NO, "cycle.force_return_min_N"},
      {"cycle.force_return_min_N", 1, 1.3, SB_ANSWER_NO, "cycle.force_return_margin_N"},
      {"cycle.force_return_margin_N", 0.2, 1.1, SB_ANSWER_YES, "cycle.force_return_margin_N"},
      {"cycle.force_return_margin_N", 1, 1.1, SB_ANSWER_NO, "cycle.force_return_margin_N"},
  };
  for (size_t i = 0; i < G_N_ELEMENTS(cases); i++) {
    const Setting ratio = {SB_P_FRICTION_STATIC_RATIO, cases[i].ratio};
    SbModel model;
    compile(&model, &ratio, 1);
    limit(&model, cases[i].path, cases[i].low, INFINITY);
    SbRun *run = run_of(&model, SB_OK, NULL);
    const SbSummary *s = sb_run_summary(run);
    const SbVerdict *of = &s->verdict[SB_VERDICT_RETURNS];
    g_assert_cmpint(of->ok, ==, cases[i].ok);
    g_assert_cmpstr(sb_figure(of->figure)->path, ==, cases[i].figure);
    g_assert_cmpfloat(of->value, ==, sb_figure_value(s, of->figure));
    sb_run_destroy(run);
  }
}

// A limit that is nearer to a figure than its error, or than the computed film models differ by, is
// judged neither yes nor no; one that is farther is judged.
static void test_uncertain(void) {
  SbParams params;
  sb_params_init(&params);
  g_assert_cmpint(sb_params_set(&params, SB_P_MODELS_FIT, SB_FIT_DISC, NULL), ==, SB_OK);
  g_assert_cmpint(sb_params_set(&params, SB_P_OUTPUT_TOLERANCE, 0.05, NULL), ==, SB_OK);
  SbModel model;
  SbPlan plan;
  SbRun *run;
  g_assert_cmpint(sb_model_compile(&model, &params, NULL, NULL), ==, SB_OK);
  sb_plan_make(&plan, &model);
  g_assert_cmpint(sb_run_create(&run, &model, &plan, NULL), ==, SB_OK);
  g_assert_cmpint(sb_run_execute(run, NULL, NULL), ==, SB_OK);
  SbSummary *summary = g_new(SbSummary, 1);
  *summary = *sb_run_summary(run);
  static const struct {
    const char *figure;
    double margin; // of the limit, over the error
    SbAnswer ok;
  } row[] = {{"cycle.force_return_margin_N", 0.5, SB_ANSWER_UNKNOWN},
             {"cycle.force_return_margin_N", 2, SB_ANSWER_YES},
             {"cycle.force_return_margin_N", -0.5, SB_ANSWER_UNKNOWN},
             {"cycle.force_return_margin_N", -2, SB_ANSWER_NO},
             {"seals.outer.load_N", 0.5, SB_ANSWER_UNKNOWN},
             {"seals.outer.load_N", 2, SB_ANSWER_YES}};
  for (size_t i = 0; i < G_N_ELEMENTS(row); i++) {
    const int figure = sb_figure_find(row[i].figure);
    const double error = sb_figure_error_absolute(summary, figure);
    const double limit = sb_figure_value(summary, figure) - row[i].margin * error;
    g_assert_cmpfloat(error, >, 0);
    model.limits = (SbLimits){.count = 1, .item = {{figure, limit, INFINITY}}};
    sb_verdict_fill(summary, &model);
    const SbVerdict *of = &summary->verdict[sb_figure(figure)->verdict];
    g_assert_cmpint(of->ok, ==, row[i].ok);
    g_assert_true(g_str_has_prefix(of->reason, "uncertain") == (row[i].ok == SB_ANSWER_UNKNOWN));
  }
  // The same holds for a stem that is stuck.
  const int margin = sb_figure_find("cycle.force_return_margin_N");
  const double known = sb_figure_error_absolute(summary, margin),
               found = summary->force_return_margin;
  model.limits.count = 0;
  summary->outcome = SB_OUTCOME_STUCK;
  for (int k = 0; k < 2; k++) {
    summary->force_return_margin = k == 0 ? -0.5 * known : -2 * known;
    sb_verdict_fill(summary, &model);
    g_assert_cmpint(summary->verdict[SB_VERDICT_RETURNS].ok, ==,
                    k == 0 ? SB_ANSWER_UNKNOWN : SB_ANSWER_NO);
  }
  summary->outcome = SB_OUTCOME_RETURNED;
  summary->force_return_margin = found;
  // And for models that were computed in addition.
  const int load = sb_figure_find("seals.outer.load_N");
  double spread[SB_FIGURE_COUNT] = {0};
  SbVerdict judged[SB_VERDICT_COUNT];
  model.limits =
      (SbLimits){.count = 1, .item = {{load, sb_figure_value(summary, load) - 0.8, INFINITY}}};
  for (int k = 0; k < 2; k++) {
    spread[load] = k;
    sb_verdict_judge(judged, summary, &model, spread);
    g_assert_cmpint(judged[sb_figure(load)->verdict].ok, ==,
                    k == 0 ? SB_ANSWER_YES : SB_ANSWER_UNKNOWN);
  }
  // Karaszkiewicz' film is a fraction of the thesis': a limit between them is judged by neither.
  const int film = sb_figure_find("seals.outer.film_central_m");
  const double apart =
      fabs(summary->seal[SB_OUTER].film_karaszkiewicz - summary->seal[SB_OUTER].film_thesis);
  model.limits = (SbLimits){
      .count = 1, .item = {{film, summary->seal[SB_OUTER].film_central - 0.5 * apart, INFINITY}}};
  sb_verdict_fill(summary, &model);
  g_assert_cmpint(summary->verdict[sb_figure(film)->verdict].ok, ==, SB_ANSWER_UNKNOWN);
  g_free(summary);
  sb_run_destroy(run);
}

int main(int argc, char **argv) {
  g_test_init(&argc, &argv, NULL);
  g_test_add_func("/figures/verdict", test_verdict);
  g_test_add_func("/figures/films", test_films);
  g_test_add_func("/figures/worse", test_worse);
  g_test_add_func("/figures/contradictions", test_contradictions);
  g_test_add_func("/figures/limits-of-return", test_limits_of_return);
  g_test_add_func("/figures/uncertain", test_uncertain);
  return g_test_run();
}
