// What the page Design shows: the map is evaluate.h's answers, the best is the search's of
// `sealbench design`, and a question that is held or cancelled leaves what it has.
#include "app/session/design_job.h"

#include "app/study/answers.h"

#include <math.h>
#include <string.h>

static SbDocument *load(const char *name) {
  g_autofree char *path = g_build_filename(g_getenv("SEALBENCH_ASSETS"), "scenes", name, NULL);
  g_autoptr(GPtrArray) issues = sb_issues_new();
  SbDocument *document = sb_document_load(path, issues);
  g_assert_nonnull(document);
  return document;
}

static SbStudyFile *make(const SbDesignAsk *ask, const SbDocument *document) {
  g_autoptr(GPtrArray) issues = sb_issues_new();
  SbStudyFile *study = sb_design_ask_study(ask, document, issues);
  if (study == NULL) {
    g_autofree char *line = sb_issue_line(issues->pdata[0]);
    g_error("%s", line);
  }
  return study;
}

static void on_done(void *data) {
  *(gboolean *)data = TRUE;
}

static SbDesignAnswer *answer_of(SbStore *store, const SbDesignAsk *ask, const SbDocument *document,
                                 bool search) {
  gboolean done = FALSE;
  char *why = NULL;
  SbDesignJob *job = sb_design_job_start(make(ask, document), ask, store, search, on_done, &done);
  while (!done) {
    g_main_context_iteration(NULL, TRUE);
  }
  SbDesignAnswer *out = sb_design_job_take(job, &why);
  g_assert_cmpstr(why, ==, NULL);
  sb_design_job_free(job);
  return out;
}

static SbDesignAnswer *answer(const SbDesignAsk *ask, const SbDocument *document, bool search) {
  SbStore *store = sb_store_open(NULL, NULL);
  SbDesignAnswer *out = answer_of(store, ask, document, search);
  g_assert_true(sb_store_close(store, NULL));
  return out;
}

// A second request reads its figures from the store of the first.
static void test_stored(void) {
  g_autoptr(SbDocument) document = load("thesis-cycle.scene");
  SbDesignAsk ask;
  sb_design_ask_init(&ask, document);
  SbStore *store = sb_store_open(NULL, NULL);
  SbDesignAnswer *first = answer_of(store, &ask, document, false);
  SbDesignAnswer *second = answer_of(store, &ask, document, false);
  const SbDesignMap *a = &first->map, *b = &second->map;
  g_assert_cmpuint(a->done, ==, b->done);
  g_assert_cmpuint(a->figures, >, 0);
  size_t values = 0;
  for (size_t i = 0; i < a->n * a->n * a->figures; i++) {
    g_assert_true(a->value[i] == b->value[i] || (isnan(a->value[i]) && isnan(b->value[i])));
    values += !isnan(a->value[i]);
  }
  g_assert_cmpuint(values, >, 0);
  sb_design_answer_free(second);
  sb_design_answer_free(first);
  g_assert_true(sb_store_close(store, NULL));
}

// A scene of rings that are solved is asked by closed forms; points are those of an evaluator.
static void test_map(void) {
  g_autoptr(SbDocument) document = load("piston.scene");
  SbDesignAsk ask;
  sb_design_ask_init(&ask, document);
  g_assert_true(ask.usual && ask.closed);
  SbDesignAnswer *of = answer(&ask, document, false);
  const SbDesignMap *map = &of->map;
  g_assert_cmpuint(map->done, ==, map->n * map->n);
  g_assert_cmpint(map->axis[0], ==, SB_P_SEAL_SECTION_DIAMETER);
  g_assert_cmpint(map->axis[1], ==, SB_P_GLAND_RADIAL_SPACE);
  SbEvaluator *evaluator = NULL;
  g_assert_cmpint(sb_evaluator_create(&evaluator, NULL), ==, SB_OK);
  const size_t points[][2] = {{0, 0}, {5, 29}, {32, 17}, {16, 16}};
  for (size_t i = 0; i < G_N_ELEMENTS(points); i++) {
    SbOverride override[2];
    int figure[SB_DESIGN_FIGURES];
    double value[SB_DESIGN_FIGURES], at[2];
    for (int axis = 0; axis < 2; axis++) {
      at[axis] = map->low[axis] + (map->high[axis] - map->low[axis]) * (double)points[i][axis] / 32;
      override[axis] = (SbOverride){map->axis[axis], at[axis]};
    }
    for (size_t k = 0; k < map->figures; k++) {
      figure[k] = g_array_index(of->study->figures, int, k);
    }
    const SbQuestion question = {.base = of->study->base,
                                 .override = override,
                                 .override_count = 2,
                                 .figure = figure,
                                 .figure_count = map->figures};
    g_assert_cmpint(sb_evaluator_ask(value, evaluator, &question, NULL), ==, SB_OK);
    for (size_t k = 0; k < map->figures; k++) {
      const double there = map->value[(points[i][1] * map->n + points[i][0]) * map->figures + k];
      g_assert_cmpfloat(there, ==, value[k]);
      // Between points it is linear: at one, itself.
      g_assert_cmpfloat(fabs(sb_design_map_at(map, k, at[0], at[1]) - value[k]), <=,
                        1e-9 * fabs(value[k]));
    }
  }
  sb_evaluator_destroy(evaluator);
  g_assert_true(isnan(sb_design_map_at(map, 0, 1, 1)));
  // The present design has its tolerances, but nothing was drawn and nothing searched.
  g_assert_cmpuint(of->place[SB_DESIGN_PRESENT].effects[0], >, 3);
  g_assert_cmpuint(of->place[SB_DESIGN_PRESENT].samples, ==, 0);
  g_assert_false(of->place[SB_DESIGN_BEST].known);
  sb_design_answer_free(of);
}

static bool never(void *data) {
  return false;
}

// The best is what the search finds, its bar of deviations its margin over the samples' scatter.
static void test_best(void) {
  g_autoptr(SbDocument) document = load("thesis-cycle.scene");
  SbDesignAsk ask;
  sb_design_ask_init(&ask, document);
  SbDesignAnswer *of = answer(&ask, document, true);
  g_autoptr(SbStudyFile) study = make(&ask, document);
  SbDesign design;
  g_assert_cmpint(sb_design_search(&design, study, 1, never, NULL, NULL), ==, SB_OK);
  const SbDesignPlace *best = &of->place[SB_DESIGN_BEST];
  g_assert_true(of->searched && best->known && design.feasible);
  for (guint k = 0; k < study->vary->len; k++) {
    g_assert_cmpfloat(best->value[k], ==, design.value[k]);
  }
  g_assert_true(sb_design_on_map(of, SB_DESIGN_BEST));
  for (size_t i = 0; i < of->map.figures; i++) { // all have one: closed forms have the error 0
    g_assert_cmpfloat(best->error[i], ==, design.error[i]);
    g_assert_false(isnan(of->place[SB_DESIGN_PRESENT].error[i]));
  }
  for (size_t i = 0; i < study->limits.count; i++) {
    const size_t column = (size_t)sb_design_answer_figure(of, study->limits.item[i].figure);
    double sum = 0, squares = 0;
    for (size_t k = 0; k < best->samples; k++) {
      const double off = best->sample[k * of->map.figures + column] - best->figure[column];
      sum += off;
      squares += off * off;
    }
    const double count = (double)best->samples, mean = sum / count;
    const double sigma = sqrt(squares / count - mean * mean);
    // 2000 samples know a deviation to 1.6 %; first order is better than 5 % here.
    g_assert_cmpfloat(fabs(sqrt(best->variance[column]) / sigma - 1), <, 0.08);
    const double margin = sb_design_margin(&design, study, i);
    g_assert_cmpfloat(
        fabs(sb_design_sigmas(of, SB_DESIGN_BEST, i) * sqrt(best->variance[column]) - margin), <,
        1e-9 + 1e-6 * fabs(margin));
  }
  sb_design_release(&design);
  // Robust: of its valves hardly one in a thousand is beyond a limit, where about half was.
  g_assert_cmpfloat(best->fails, >, 0.2);
  sb_design_answer_free(of);
  ask.robust = true;
  of = answer(&ask, document, true);
  g_assert_cmpfloat(of->place[SB_DESIGN_BEST].fails, <, 0.004);
  sb_design_answer_free(of);
}

// A limit that is taken away, one in place of another, and no more than there is room for.
static void test_limits(void) {
  g_autoptr(SbDocument) document = load("thesis-cycle.scene");
  SbDesignAsk ask;
  sb_design_ask_init(&ask, document);
  const size_t count = ask.limits.count;
  const int figure = ask.limits.item[1].figure;
  sb_design_ask_limit(&ask, figure, 3, INFINITY);
  g_assert_cmpuint(ask.limits.count, ==, count);
  g_assert_cmpfloat(ask.limits.item[1].low, ==, 3);
  g_assert_false(ask.usual);
  sb_design_ask_limit(&ask, figure, -INFINITY, INFINITY);
  g_assert_cmpuint(ask.limits.count, ==, count - 1);
  int all[64];
  const size_t figures = sb_design_ask_figures(all, 64);
  for (size_t i = 0; i < figures; i++) {
    sb_design_ask_limit(&ask, all[i], 0, INFINITY);
  }
  g_assert_cmpuint(ask.limits.count, ==, SB_DESIGN_LIMITS);
}

static gboolean on_cancel(gpointer data) {
  sb_design_job_cancel(data);
  return G_SOURCE_REMOVE;
}

static size_t points_done(SbDesignJob *job) {
  const size_t done = sb_design_job_lock(job)->map.done;
  sb_design_job_unlock(job);
  return done;
}

static void test_held(void) {
  g_autoptr(SbDocument) document = load("thesis-cycle.scene");
  SbDesignAsk ask;
  sb_design_ask_init(&ask, document);
  gboolean done = FALSE;
  char *why = NULL;
  SbStore *store = sb_store_open(NULL, NULL);
  SbDesignJob *job = sb_design_job_start(make(&ask, document), &ask, store, false, on_done, &done);
  sb_design_job_pause(job, true);
  g_usleep(100000); // what was begun ends
  const size_t held = points_done(job);
  g_usleep(100000);
  g_assert_cmpuint(points_done(job), ==, held);
  g_assert_cmpuint(held, <, 33 * 33);
  g_idle_add(on_cancel, job);
  while (!done) {
    g_main_context_iteration(NULL, TRUE);
  }
  SbDesignAnswer *of = sb_design_job_take(job, &why);
  g_assert_cmpstr(why, ==, "");
  size_t there = 0;
  for (size_t i = 0; i < of->map.n * of->map.n; i++) {
    const bool missing = of->map.status[i] == SB_ANSWER_MISSING;
    g_assert_true(!missing || isnan(of->map.value[i * of->map.figures]));
    there += !missing;
  }
  g_assert_cmpuint(there, ==, of->map.done);
  g_free(why);
  sb_design_answer_free(of);
  sb_design_job_free(job);
  g_assert_true(sb_store_close(store, NULL));
}

int main(int argc, char **argv) {
  g_test_init(&argc, &argv, NULL);
  g_test_add_func("/design-page/map", test_map);
  g_test_add_func("/design-page/best", test_best);
  g_test_add_func("/design-page/limits", test_limits);
  g_test_add_func("/design-page/held", test_held);
  g_test_add_func("/design-page/stored", test_stored);
  return g_test_run();
}
