// sealbench design: an optimum that a grid finds too, what cannot be, and designs that hold over
// their tolerances.
#include "tests/app/cli_fixture.h"
#include "tests/engine/near.h"

#include "app/document/document.h"

#include "engine/valve/sealbench.h"

#include <glib/gstdio.h>
#include <math.h>
#include <string.h>

static char *write_study(const char *rest) {
  char *path = g_build_filename(cli.folder, "x.study", NULL);
  g_autofree char *text = g_strdup_printf("[sealbench]\nformat = 1\nkind = study\nscene = %s\n"
                                          "[vary]\nmodels.film = levels thesis\n%s",
                                          cli.scene, rest);
  g_assert_true(g_file_set_contents(path, text, -1, NULL));
  return path;
}

#define SIZES                                                                                      \
  "seal.section_diameter = uniform 1.45 mm .. 1.69 mm\n"                                           \
  "gland.radial_space = uniform 1.27 mm .. 1.45 mm\n"

static JsonNode *design(const char *rest, const char *jobs) {
  g_autofree char *study = write_study(rest);
  CliResult result = CLI("design", study, "--jobs", jobs, "--json", "-");
  g_assert_cmpint(result.code, ==, 0);
  JsonNode *root = cli_parse(result.out);
  cli_has_keys(root, "converged feasible objective parameters figures active margins evaluations "
                     "optimality");
  cli_clear(&result);
  g_unlink(study);
  return root;
}

static double member(JsonNode *root, const char *object, const char *key) {
  JsonObject *of = json_object_get_object_member(json_node_get_object(root), object);
  return json_object_get_double_member(of, key);
}

static bool is_active(JsonNode *root, const char *name) {
  JsonArray *active = json_object_get_array_member(json_node_get_object(root), "active");
  bool found = false;
  for (guint i = 0; i < json_array_get_length(active); i++) {
    found |= strcmp(json_array_get_string_element(active, i), name) == 0;
  }
  return found;
}

#define BREAKAWAY "cycle.force_breakaway_N"
#define RETURN    "cycle.force_return_min_N"
#define LOAD      "seals.outer.load_N"

// Least break-away of a grid that closes in on its best point.
static double least_of_grid(double load) {
  enum { POINTS = 9, ZOOMS = 6 };
  g_autoptr(GPtrArray) issues = sb_issues_new();
  SbDocument *scene = sb_document_load(cli.scene, issues);
  g_assert_nonnull(scene);
  SbModel *base = NULL;
  g_assert_true(sb_document_compile(scene, &base, issues));
  SbEvaluator *evaluator = NULL;
  g_assert_cmpint(sb_evaluator_create(&evaluator, NULL), ==, SB_OK);
  const int figure[] = {sb_figure_find(BREAKAWAY), sb_figure_find(RETURN), sb_figure_find(LOAD)};
  const SbParamId film = (SbParamId)sb_param_find("models.film");
  const int thesis = sb_param_choice(sb_param(film), "thesis", strlen("thesis"));
  SbOverride override[] = {{film, thesis},
                           {(SbParamId)sb_param_find("seal.section_diameter"), 0},
                           {(SbParamId)sb_param_find("gland.radial_space"), 0}};
  const SbQuestion question = {
      .base = base, .override = override, .override_count = 3, .figure = figure, .figure_count = 3};
  const double low[] = {1.45e-3, 1.27e-3}, high[] = {1.69e-3, 1.45e-3};
  double middle[] = {1.57e-3, 1.36e-3}, half[] = {0.12e-3, 0.09e-3}, best[2] = {0, 0};
  double least = INFINITY;
  for (int zoom = 0; zoom < ZOOMS; zoom++) {
    for (int i = 0; i < POINTS * POINTS; i++) {
      double value[3];
      const int at[] = {i / POINTS, i % POINTS};
      for (int k = 0; k < 2; k++) {
        const double x = middle[k] + half[k] * (2.0 * at[k] / (POINTS - 1) - 1);
        override[k + 1].value = fmin(fmax(x, low[k]), high[k]);
      }
      g_assert_cmpint(sb_evaluator_ask(value, evaluator, &question, NULL), ==, SB_OK);
      if (value[0] < least && value[1] >= 2 && value[2] >= load) {
        least = value[0];
        best[0] = override[1].value;
        best[1] = override[2].value;
      }
    }
    for (int k = 0; k < 2; k++) {
      middle[k] = best[k];
      half[k] *= 0.3;
    }
  }
  sb_evaluator_destroy(evaluator);
  sb_model_destroy(base);
  sb_document_free(scene);
  return least;
}

// The lightest break-away whose least return is 2 N, with a seal that is pressed at least so much.
static void test_optimum(void) {
  static const char rest[] = SIZES "[design]\nobjective = minimise " BREAKAWAY "\n[limits]\n" RETURN
                                   " = >= 2 N\n" LOAD " = >= 9 N\n";
  g_autoptr(JsonNode) root = design(rest, "2");
  g_assert_true(json_node_get_boolean(cli_at(root, "feasible")));
  g_assert_true(json_node_get_boolean(cli_at(root, "converged")));
  const double best = cli_number(root, "objective");
  assert_close(best, least_of_grid(9), 1e-4);
  assert_close(member(root, "figures", LOAD), 9.0, 1e-6);
  g_assert_cmpfloat(member(root, "margins", LOAD), >=, 0);
  g_assert_true(is_active(root, LOAD));
  g_assert_false(is_active(root, RETURN));
  assert_close(member(root, "margins", RETURN), member(root, "figures", RETURN) - 2, 1e-9);
  g_assert_cmpfloat(cli_number(root, "optimality"), <, 1e-4);
  // The same from one thread, to the bit.
  g_autoptr(JsonNode) other = design(rest, "1");
  g_assert_cmpfloat(cli_number(other, "objective"), ==, best);
  g_assert_cmpfloat(cli_number(other, "evaluations"), ==, cli_number(root, "evaluations"));
}

// A limit between two others: the least that the worst is missed by, and which is missed least.
static void test_infeasible(void) {
  g_autofree char *study = write_study(SIZES "[design]\nobjective = minimise " BREAKAWAY
                                             "\n[limits]\n" RETURN " = >= 5 N\n"
                                             "seals.outer.squeeze = 20 % .. 25 %\n");
  CliResult result = CLI("design", study, "--json", "-");
  g_assert_cmpint(result.code, ==, 0);
  g_assert_nonnull(strstr(result.err, "nothing feasible was found from 8 starts"));
  g_autoptr(JsonNode) root = cli_parse(result.out);
  cli_clear(&result);
  g_assert_false(json_node_get_boolean(cli_at(root, "feasible")));
  g_assert_cmpstr(json_node_get_string(cli_at(root, "reasons.optimality")), ==,
                  "no feasible design was found");
  // Each misses the same part of its bound.
  assert_close(member(root, "margins", RETURN) / 5,
               member(root, "margins", "seals.outer.squeeze") / 0.2, 1e-3);
  g_assert_cmpfloat(member(root, "margins", RETURN), <, 0);
  g_assert_nonnull(json_node_get_string(cli_at(root, "least_violated")));
  g_unlink(study);
}

// An objective that no valve has is named with its own reason.
static void test_objective(void) {
  g_autofree char *study =
      write_study(SIZES "[design]\nobjective = minimise life.force_peak_last_N\n");
  CliResult result = CLI("design", study, "--json", "-");
  g_assert_cmpint(result.code, ==, 2);
  static const char reason[] =
      "life.force_peak_last_N: life.actuations = 1: a life has 2 actuations or more";
  g_assert_nonnull(strstr(result.err, reason));
  g_autoptr(JsonNode) root = cli_parse(result.out);
  g_assert_true(JSON_NODE_HOLDS_NULL(cli_at(root, "objective")));
  g_assert_nonnull(strstr(json_node_get_string(cli_at(root, "reasons.objective")), reason));
  cli_clear(&result);
  g_unlink(study);
}

// Sizes scatter normally and the squeeze (d - g)/d decides: its probability has a closed form,
// which the design meets and the samples' interval holds.
static void test_robust(void) {
  g_autoptr(JsonNode) root =
      design(SIZES "[design]\nobjective = minimise " BREAKAWAY "\nrobust = 0.999\n[limits]\n"
                   "seals.outer.squeeze = >= 8 %\n[tolerances]\n"
                   "seal.section_diameter = normal 0 mm, 0.01 mm\n"
                   "gland.radial_space = normal 0 mm, 0.005 mm\n",
             "2");
  const double d = 1e3 * member(root, "parameters", "seal.section_diameter"),
               g = 1e3 * member(root, "parameters", "gland.radial_space");
  const double beta = (0.92 * d - g) / sqrt(0.92 * 0.92 * 1e-4 + 0.25e-4);
  const double holds = 1 - erfc(beta / sqrt(2)) / 2;
  // The samples decide whether it is met, and a thousand of them know it to 1.3e-4.
  g_assert_cmpfloat(holds, >, 0.999 - 5e-5);
  g_assert_cmpfloat(holds, <, 0.999 + 1.3e-4);
  g_assert_cmpfloat(cli_number(root, "robust.probability"), >=, 0.999);
  g_assert_cmpfloat(cli_number(root, "robust.interval_95.0"), <, holds);
  g_assert_cmpfloat(cli_number(root, "robust.interval_95.1"), >, holds);
  g_assert_true(json_node_get_boolean(cli_at(root, "robust.met")));
}

// A search that ends on its bound, outside the range of the fit, is marked in JSON and table.
static void test_marked(void) {
  static const char rest[] = "gland.radial_space = uniform 1.3 mm .. 1.6 mm\n"
                             "[design]\nobjective = minimise " BREAKAWAY "\n";
  g_autoptr(JsonNode) root = design(rest, "1");
  g_assert_cmpstr(json_node_get_string(cli_at(root, "bounds_active.0")), ==, "gland.radial_space");
  JsonArray *warnings = json_node_get_array(cli_at(root, "warnings"));
  bool marked = false;
  for (guint i = 0; i < json_array_get_length(warnings); i++) {
    JsonObject *of = json_array_get_object_element(warnings, i);
    marked |= strcmp(json_object_get_string_member(of, "code"), "karaszkiewicz-squeeze") == 0;
  }
  g_assert_true(marked);
  g_autofree char *study = write_study(rest);
  CliResult result = CLI("design", study);
  g_assert_nonnull(strstr(result.out, "on a bound of the search: gland.radial_space (upper)"));
  g_assert_nonnull(strstr(result.out, "warnings of validity: karaszkiewicz-squeeze"));
  cli_clear(&result);
  g_unlink(study);
}

static void test_told(void) {
  g_autofree char *study = write_study(SIZES "[study]\nsamples = 10\n");
  CliResult result = CLI("design", study);
  g_assert_cmpint(result.code, ==, 1);
  g_assert_nonnull(strstr(result.err, "x.study: design: is missing"));
  cli_clear(&result);
  g_free(write_study(SIZES "[design]\nobjective = maximise " LOAD "\n[limits]\n" RETURN
                           " = >= -100 N\n"));
  result = CLI("study", study);
  g_assert_cmpint(result.code, ==, 1);
  g_assert_nonnull(strstr(result.err, "study.samples: is missing"));
  cli_clear(&result);
  g_autofree char *folder = g_build_filename(cli.folder, "best", NULL);
  result = CLI("design", study, "-o", folder);
  g_assert_cmpint(result.code, ==, 0);
  g_assert_nonnull(strstr(result.out, "at its upper bound"));
  cli_clear(&result);
  g_autofree char *written = cli_contents(folder, "results.json");
  g_autoptr(JsonNode) root = cli_parse(written);
  g_assert_true(is_active(root, "seal.section_diameter") && is_active(root, "gland.radial_space"));
  g_assert_false(is_active(root, RETURN)); // far within it
  g_unlink(study);
}

// Returns the number and the unit that follow a name in a table; freed by g_free().
static char *shown(const char *out, const char *name) {
  char number[32], unit[8];
  const char *at = strstr(out, name);
  g_assert_nonnull(at);
  g_assert_cmpint(sscanf(at + strlen(name), "%*[: ]%31s %7s", number, unit), ==, 2);
  return g_strconcat(number, " ", unit, NULL);
}

// A figure has one rounding: its error of 2 % leaves three digits in every table.
static void test_digits(void) {
  const char *leak = "cycle.leakage_per_cycle_m3";
  g_autofree char *path = g_build_filename(cli.folder, "x.study", NULL);
  g_autofree char *text =
      g_strdup_printf("[sealbench]\nformat = 1\nkind = study\nscene = %s\n[vary]\n"
                      "models.fit = levels disc\noutput.tolerance = levels 0.1\n"
                      "stem.pressure_diameter = uniform 5.7 mm .. 5.8 mm\n[design]\nstarts = 1\n"
                      "objective = maximise " RETURN "\n[limits]\n%s = <= 30 pl\n",
                      cli.scene, leak);
  g_assert_true(g_file_set_contents(path, text, -1, NULL));
  CliResult ran =
      CLI("run", cli.scene, "--set", "models.fit=disc", "--set", "output.tolerance=0.1");
  CliResult slopes =
      CLI("sensitivity", cli.scene, "--set", "models.fit=disc", "--set", "output.tolerance=0.1",
          "--figures", leak, "--parameters", "stem.pressure_diameter");
  CliResult designed = CLI("design", path);
  g_autofree char *one = shown(ran.out, "Leakage per cycle");
  g_autofree char *other = shown(slopes.out, leak), *third = shown(designed.out, leak);
  g_assert_cmpstr(one, ==, "22.0 pl");
  g_assert_cmpstr(other, ==, one);
  g_assert_cmpstr(third, ==, one);
  cli_clear(&ran);
  cli_clear(&slopes);
  cli_clear(&designed);
  g_unlink(path);
}

int main(int argc, char **argv) {
  g_test_init(&argc, &argv, NULL);
  cli_set_up();
  g_test_add_func("/cli-design/optimum", test_optimum);
  g_test_add_func("/cli-design/infeasible", test_infeasible);
  g_test_add_func("/cli-design/objective", test_objective);
  g_test_add_func("/cli-design/robust", test_robust);
  g_test_add_func("/cli-design/marked", test_marked);
  g_test_add_func("/cli-design/told", test_told);
  g_test_add_func("/cli-design/digits", test_digits);
  const int failed = g_test_run();
  cli_tear_down();
  return failed;
}
