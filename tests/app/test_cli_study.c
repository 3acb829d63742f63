// sealbench study and merge: bytes that hang on the study alone, the JSON, and what is told.
#include "tests/app/cli_fixture.h"

#include <glib/gstdio.h>
#include <math.h>
#include <signal.h>
#include <string.h>
#include <sys/wait.h>

static char *path_of(const char *name) {
  return g_build_filename(cli.folder, name, NULL);
}

static char *write_study(const char *method, const char *rest) {
  char *path = path_of("x.study");
  g_autofree char *text = g_strdup_printf(
      "[sealbench]\nformat = 1\nkind = study\ntitle = Two sizes\nscene = %s\n\n[vary]\n"
      "seal.section_diameter = uniform 1.59 mm .. 1.63 mm\n"
      "gland.radial_space = normal 1.36 mm, 0.01 mm within 1.33 mm .. 1.39 mm\n\n"
      "[study]\nmethod = %s\nfigures = cycle.force_return_min_N, seals.outer.load_N\n%s",
      cli.scene, method, rest);
  g_assert_true(g_file_set_contents(path, text, -1, NULL));
  return path;
}

static void remove_named(const char *name) {
  g_autofree char *path = path_of(name);
  g_unlink(path);
}

#define CLOSED "--set", "models.film=thesis"

static void test_json(void) {
  g_autofree char *study =
      write_study("monte-carlo", "samples = 64\n[limits]\ncycle.force_breakaway_N = <= 28 N\n");
  CliResult result = CLI("study", study, CLOSED, "--json", "-");
  g_assert_cmpint(result.code, ==, 0);
  g_autoptr(JsonNode) root = cli_parse(result.out);
  cli_has_keys(root, "study method samples done failed figures limits");
  g_assert_cmpfloat(cli_number(root, "done"), ==, 64);
  cli_has_keys(cli_at(root, "limits.0"), "figure relation limit probability_of_failure interval_95 "
                                         "beta");
  const double share = cli_number(root, "limits.0.probability_of_failure");
  g_assert_cmpfloat(share, >, cli_number(root, "limits.0.interval_95.0"));
  g_assert_cmpfloat(share, <, cli_number(root, "limits.0.interval_95.1"));
  cli_clear(&result);
  // The store is beside the study, as the document states: a second time nothing is computed.
  g_autofree char *store = path_of("x.store");
  JsonObject *document = json_node_get_object(root);
  g_assert_cmpstr(json_object_get_string_member(document, "store"), ==, store);
  g_assert_true(g_file_test(store, G_FILE_TEST_EXISTS));
  result = CLI("study", study, CLOSED, "--progress", "lines", "-q");
  g_assert_cmpint(result.code, ==, 0);
  g_assert_null(strstr(result.err, "a second"));
  cli_clear(&result);
  g_unlink(store);
  g_unlink(study);
}

static void test_indices(void) {
  g_autofree char *study = write_study("sobol-indices", "samples = 256\n");
  CliResult result = CLI("study", study, CLOSED, "--json", "-");
  g_assert_cmpint(result.code, ==, 0);
  g_autoptr(JsonNode) root = cli_parse(result.out);
  JsonNode *load =
      json_object_get_member(json_node_get_object(cli_at(root, "indices")), "seals.outer.load_N");
  JsonObject *of = json_node_get_object(load);
  JsonObject *space = json_object_get_object_member(of, "gland.radial_space");
  JsonObject *section = json_object_get_object_member(of, "seal.section_diameter");
  // The load hangs on d - g: uniform over 40 um against a deviation of 10 um cut off at 3.
  const double expected = 40.0 * 40 / 12 / (40.0 * 40 / 12 + 10.0 * 10 * 0.973);
  g_assert_cmpfloat(fabs(json_object_get_double_member(section, "first") - expected), <, 0.12);
  g_assert_cmpfloat(fabs(json_object_get_double_member(space, "total") + expected - 1), <, 0.12);
  cli_clear(&result);
  g_unlink(study);
  remove_named("x.store");
}

static char *csv_of(const char *study, const char *store) {
  g_autofree char *csv = path_of("x.csv");
  CliResult result = CLI("study", study, CLOSED, "-o", store, "--csv", csv, "-q");
  g_assert_cmpint(result.code, ==, 0);
  cli_clear(&result);
  char *text = cli_contents(cli.folder, "x.csv");
  g_unlink(csv);
  return text;
}

// Killed at ten moments, then finished: the bytes of a study that nobody touched. Shards alike.
static void test_killed(void) {
  g_autofree char *study = write_study("sobol-sequence", "samples = 1500\n");
  g_autofree char *whole = path_of("whole.store"), *torn = path_of("torn.store");
  g_autofree char *expected = csv_of(study, whole);
  g_assert_true(g_str_has_prefix(expected, "sample,seal.section_diameter [m],gland.radial_space "
                                           "[m],cycle.force_return_min_N,seals.outer.load_N,"
                                           "status,warnings\n1,"));
  int killed = 0;
  for (int i = 0; i < 10; i++) {
    const char *const arguments[] = {cli.program, "study", study,    CLOSED, "-o",
                                     torn,        "-q",    "--jobs", "2",    NULL};
    GPid child = 0;
    g_assert_true(g_spawn_async(NULL, (char **)arguments, NULL,
                                G_SPAWN_DO_NOT_REAP_CHILD | G_SPAWN_STDOUT_TO_DEV_NULL, NULL, NULL,
                                &child, NULL));
    g_usleep((gulong)(3000 + 25000 * i));
    kill(child, SIGKILL);
    int status = 0;
    g_assert_cmpint(waitpid(child, &status, 0), ==, child);
    killed += WIFSIGNALED(status);
    g_spawn_close_pid(child);
  }
  g_assert_cmpint(killed, >, 0);
  g_autofree char *resumed = csv_of(study, torn);
  g_assert_cmpstr(resumed, ==, expected);
  char *parts[] = {path_of("1.store"), path_of("2.store"), path_of("3.store")};
  static const char *const shard[] = {"1/3", "2/3", "3/3"};
  for (int i = 0; i < 3; i++) {
    CliResult result = CLI("study", study, CLOSED, "-o", parts[i], "--shard", shard[i], "-q");
    g_assert_cmpint(result.code, ==, 0);
    cli_clear(&result);
  }
  g_autofree char *joined = path_of("joined.store");
  CliResult result = CLI("merge", joined, parts[2], parts[0], parts[1]);
  g_assert_cmpint(result.code, ==, 0);
  g_assert_nonnull(strstr(result.out, "1500 answers"));
  cli_clear(&result);
  g_autofree char *merged = csv_of(study, joined);
  g_assert_cmpstr(merged, ==, expected);
  for (int i = 0; i < 3; i++) {
    g_unlink(parts[i]);
    g_free(parts[i]);
  }
  g_unlink(joined);
  g_unlink(whole);
  g_unlink(torn);
  g_autofree char *journal = g_strconcat(torn, "-journal", NULL);
  g_unlink(journal);
  g_unlink(study);
}

static void test_told(void) {
  g_autofree char *study = write_study("monte-carlo", "samples = 0\n");
  CliResult result = CLI("study", study);
  g_assert_cmpint(result.code, ==, 1);
  g_assert_nonnull(strstr(result.err, "x.study: [study] samples: is not a number of samples"));
  cli_clear(&result);
  g_autofree char *store = path_of("x.store");
  g_assert_false(g_file_test(store, G_FILE_TEST_EXISTS)); // nothing was begun
  g_free(write_study("grid", ""));
  result = CLI("study", study, "--shard", "3/2");
  g_assert_cmpint(result.code, ==, 1);
  g_assert_nonnull(strstr(result.err, "--shard: \"3/2\" is not of the form I/N"));
  cli_clear(&result);
  result = CLI("merge", store, study);
  g_assert_cmpint(result.code, ==, 1);
  g_assert_nonnull(strstr(result.err, "is not a store, or is damaged"));
  cli_clear(&result);
  g_unlink(store);
  g_unlink(study);
}

static double share_beyond(double z) {
  return erfc(z / sqrt(2)) / 2;
}

// Of two sizes with normal scatter and a correlation of 0.3: the squeeze (d - g)/d is below s where
// (1 - s) d < g, which is linear in them.
static double below_squeeze(double s) {
  const double d = 1 - s, spread = 0.0067 * sqrt(d * d + 1 - 0.6 * d);
  return share_beyond((d * 1.61 - 1.36) / spread);
}

// One in a million in its interval; limits that are never met and never missed are told; shards
// have the same points.
static void test_reliability(void) {
  const double truth = below_squeeze(0.132);
  g_assert_cmpfloat(truth, <, 1e-6);
  g_autofree char *study = path_of("x.study");
  g_autofree char *text = g_strdup_printf(
      "[sealbench]\nformat = 1\nkind = study\nscene = %s\n[vary]\n"
      "seal.section_diameter = normal 1.61 mm, 0.0067 mm\n"
      "gland.radial_space = normal 1.36 mm, 0.0067 mm\n"
      "[correlation]\nseal.section_diameter, gland.radial_space = 0.3\n"
      "[study]\nmethod = reliability\nsamples = 2000\n[limits]\nseals.outer.squeeze = >= 13.2 %%\n"
      "seals.inner.squeeze = 16 %% .. 60 %%\ncycle.dose_mass_kg = >= 1 mg\n",
      cli.scene);
  g_assert_true(g_file_set_contents(study, text, -1, NULL));
  g_autofree char *one = path_of("1.store"), *other = path_of("2.store");
  CliResult result = CLI("study", study, CLOSED, "-o", one, "--shard", "1/2", "--json", "-");
  g_assert_cmpint(result.code, ==, 0);
  g_autoptr(JsonNode) half = cli_parse(result.out);
  g_assert_true(json_node_is_null(cli_at(half, "limits.0.probability_of_failure")));
  cli_clear(&result);
  result = CLI("study", study, CLOSED, "-o", other, "--shard", "2/2", "--jobs", "1", "-q");
  g_assert_cmpint(result.code, ==, 0);
  cli_clear(&result);
  result = CLI("merge", one, other);
  cli_clear(&result);
  result = CLI("study", study, CLOSED, "-o", one, "--progress", "lines", "--json", "-");
  g_assert_cmpint(result.code, ==, 0);
  g_assert_null(strstr(result.err, "a second")); // the shards had all points
  g_autoptr(JsonNode) root = cli_parse(result.out);
  cli_clear(&result);
  const double low = cli_number(root, "limits.0.interval_95.0"),
               high = cli_number(root, "limits.0.interval_95.1");
  g_assert_true(low < truth && truth < high && high < 1.4 * low);
  g_assert_cmpfloat(
      fabs(share_beyond(cli_number(root, "limits.0.failure_points.0.beta")) / truth - 1), <, 2e-3);
  // Shares of correlated parameters do not add up: null, with the reason.
  g_assert_true(json_node_is_null(cli_at(root, "limits.0.failure_points.0.importance")));
  g_assert_nonnull(
      json_node_get_string(cli_at(root, "limits.0.failure_points.0.importance_reason")));
  // The second is missed by most, and on its upper side never.
  const double most = below_squeeze(0.16);
  g_assert_cmpfloat(most, >, 0.5);
  g_assert_cmpfloat(cli_number(root, "limits.1.interval_95.0"), <, most);
  g_assert_cmpfloat(cli_number(root, "limits.1.interval_95.1"), >, most);
  g_assert_cmpfloat(cli_number(root, "limits.2.probability_of_failure"), ==, 0);
  g_assert_cmpfloat(cli_number(root, "limits.2.interval_95.1"), >, 0);
  const char *reason = json_node_get_string(cli_at(root, "limits.2.reason"));
  // Valves that stick have no dose.
  g_assert_true(g_str_has_prefix(reason, "none of "));
  g_assert_nonnull(strstr(reason, " samples is beyond it"));
  // Of any limit no less than of the worst.
  g_assert_cmpfloat(cli_number(root, "any_limit.probability_of_failure"), >=,
                    cli_number(root, "limits.1.probability_of_failure"));
  g_unlink(one);
  g_unlink(other);
  g_unlink(study);
}

static double value_of(const char *csv, int row, int column) {
  g_auto(GStrv) lines = g_strsplit(csv, "\n", -1), cells = g_strsplit(lines[row], ",", -1);
  return g_ascii_strtod(cells[column], NULL);
}

// A row has the figures of a run, solved rings far from the study's base too.
static void test_row_is_run(void) {
  g_autofree char *scene =
      g_build_filename(g_getenv("SEALBENCH_ASSETS"), "scenes", "piston.scene", NULL);
  g_autofree char *study = path_of("row.study"), *store = path_of("row.store");
  g_autofree char *text =
      g_strdup_printf("[sealbench]\nformat = 1\nkind = study\nscene = %s\n[vary]\n"
                      "seal.modulus = levels 2.7 MPa, 5.2 MPa\noutput.tolerance = levels 0.01\n"
                      "[study]\nmethod = grid\n"
                      "figures = seals.inner.load_N, cycle.force_return_margin_N\n",
                      scene);
  g_assert_true(g_file_set_contents(study, text, -1, NULL));
  CliResult rows = CLI("study", study, "-o", store, "-q", "--csv", "-");
  g_assert_cmpint(rows.code, ==, 0);
  CliResult run = CLI("run", scene, "-q", "--set", "seal.modulus=5.2MPa", "--set",
                      "output.tolerance=0.01", "--json", "-");
  g_assert_cmpint(run.code, ==, 0);
  g_autoptr(JsonNode) root = cli_parse(run.out);
  g_assert_cmpfloat(value_of(rows.out, 2, 3), ==, cli_number(root, "seals.inner.load_N"));
  g_assert_cmpfloat(value_of(rows.out, 2, 4), ==, cli_number(root, "cycle.force_return_margin_N"));
  cli_clear(&rows);
  cli_clear(&run);
  g_unlink(store);
  g_unlink(study);
}

// Valves whose stem never moves have no press force, and are not left out.
static void test_never_moves(void) {
  g_autofree char *scene = path_of("hand.scene"), *study = path_of("hand.study"),
                  *store = path_of("hand.store");
  g_autofree char *text =
      g_strdup_printf("[sealbench]\nformat = 1\nkind = scene\nvalve = %s\n[drive]\nkind = hand\n"
                      "peak_force = 28.7 N\n[models]\nmotion = dynamic\n",
                      cli.valve);
  g_assert_true(g_file_set_contents(scene, text, -1, NULL));
  static const char rest[] = "[sealbench]\nformat = 1\nkind = study\nscene = hand.scene\n[vary]\n"
                             "gland.radial_space = normal 1.36 mm, 0.005 mm\n"
                             "[study]\nmethod = monte-carlo\nsamples = 100\n"
                             "[limits]\ncycle.force_press_N = <= 40 N\n";
  g_assert_true(g_file_set_contents(study, rest, -1, NULL));
  CliResult result = CLI("study", study, "-o", store, "--json", "-");
  g_assert_cmpint(result.code, ==, 0);
  g_autoptr(JsonNode) root = cli_parse(result.out);
  const double known = cli_number(root, "limits.0.samples");
  g_assert_true(known > 20 && known < 80);
  g_assert_cmpfloat(cli_number(root, "limits.0.interval_95.1"), >, 1 - known / 100);
  g_assert_nonnull(strstr(json_node_get_string(cli_at(root, "limits.0.reason")),
                          " samples have no value of it"));
  cli_clear(&result);
  result = CLI("study", study, "-o", store);
  g_assert_nonnull(strstr(result.out, " without a value: 0 %"));
  cli_clear(&result);
  g_unlink(store);
  g_unlink(study);
  g_unlink(scene);
}

static const char *reason_at(JsonNode *root, const char *path) {
  JsonObject *reasons = json_node_get_object(cli_at(root, "reasons"));
  g_assert_true(json_object_has_member(reasons, path));
  return json_object_get_string_member(reasons, path);
}

// Each null of a study has its reason: a figure of a row, statistics, a probability of a grid.
static void test_reasons(void) {
  g_autofree char *scene = path_of("hand.scene"), *study = path_of("hand.study"),
                  *store = path_of("hand.store");
  g_autofree char *text =
      g_strdup_printf("[sealbench]\nformat = 1\nkind = scene\nvalve = %s\n[drive]\nkind = hand\n"
                      "peak_force = 45 N\n[models]\nmotion = dynamic\n",
                      cli.valve);
  g_assert_true(g_file_set_contents(scene, text, -1, NULL));
  static const char rest[] = "[sealbench]\nformat = 1\nkind = study\nscene = hand.scene\n[vary]\n"
                             "friction.static_ratio = levels 1.1, 3\n[study]\nmethod = grid\n"
                             "figures = cycle.dose_mass_kg\n"
                             "[limits]\ncycle.force_press_N = <= 40 N\n";
  g_assert_true(g_file_set_contents(study, rest, -1, NULL));
  CliResult result = CLI("study", study, "-o", store, "--json", "-");
  g_assert_cmpint(result.code, ==, 0);
  g_autoptr(JsonNode) root = cli_parse(result.out);
  static const char never[] = "cycle.dose_mass_kg: the stem never moved";
  g_assert_cmpfloat(cli_number(root, "missing.0.sample"), ==, 2);
  g_assert_nonnull(strstr(json_node_get_string(cli_at(root, "missing.0.reason")), never));
  g_assert_nonnull(strstr(reason_at(root, "figures.cycle.dose_mass_kg"), "1 of 2 samples"));
  g_assert_nonnull(strstr(reason_at(root, "limits[0]"), "no probability"));
  g_assert_nonnull(strstr(reason_at(root, "any_limit"), "no probability"));
  cli_clear(&result);
  // The store has it too, and from the store it is the same.
  CliResult export = CLI("store", "export", store, "--json", "-");
  g_autoptr(JsonNode) rows = cli_parse(export.out);
  int found = 0;
  for (int i = 0; i < 2; i++) {
    g_autofree char *path = g_strdup_printf("rows.%d.reason", i);
    JsonNode *reason = cli_at(rows, path);
    found += !JSON_NODE_HOLDS_NULL(reason) && strstr(json_node_get_string(reason), never) != NULL;
  }
  g_assert_cmpint(found, ==, 1);
  cli_clear(&export);
  result = CLI("study", study, "-o", store, "--json", "-");
  g_autoptr(JsonNode) again = cli_parse(result.out);
  g_assert_nonnull(strstr(json_node_get_string(cli_at(again, "missing.0.reason")), never));
  cli_clear(&result);
  g_unlink(store);
  g_unlink(study);
  g_unlink(scene);
}

int main(int argc, char **argv) {
  g_test_init(&argc, &argv, NULL);
  cli_set_up();
  g_test_add_func("/cli-study/json", test_json);
  g_test_add_func("/cli-study/indices", test_indices);
  g_test_add_func("/cli-study/killed", test_killed);
  g_test_add_func("/cli-study/reliability", test_reliability);
  g_test_add_func("/cli-study/told", test_told);
  g_test_add_func("/cli-study/row-is-run", test_row_is_run);
  g_test_add_func("/cli-study/never-moves", test_never_moves);
  g_test_add_func("/cli-study/reasons", test_reasons);
  const int failed = g_test_run();
  cli_tear_down();
  return failed;
}
