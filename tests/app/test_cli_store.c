// sealbench store, what a study makes of a damaged store, where stores are written, and the
// validity codes that travel with answers.
#define _GNU_SOURCE // memmem
#include "tests/app/cli_fixture.h"

#include <glib/gstdio.h>
#include <math.h>
#include <string.h>

static char *path_of(const char *name) {
  return g_build_filename(cli.folder, name, NULL);
}

static void remove_named(const char *name) {
  g_autofree char *path = path_of(name);
  g_unlink(path);
}

// Radial spaces of which the last two are out of the validity of the fit, 7 to 25 % squeeze.
static char *write_study(void) {
  g_autofree char *folder = g_path_get_dirname(cli.scene);
  char *path = path_of("x.study");
  g_autofree char *text = g_strdup_printf(
      "[sealbench]\nformat = 1\nkind = study\nscene = %s/quick-look.scene\n\n[vary]\n"
      "gland.radial_space = levels 1.36 mm, 1.58 mm, 1.60 mm\n\n[study]\nmethod = grid\n"
      "figures = cycle.force_breakaway_N, seals.outer.load_N\n",
      folder);
  g_assert_true(g_file_set_contents(path, text, -1, NULL));
  return path;
}

static char *csv_of(const char *study, int code, const char *says) {
  g_autofree char *csv = path_of("x.csv");
  CliResult result = CLI("study", study, "--csv", csv, "-q");
  g_assert_cmpint(result.code, ==, code);
  g_assert_true(says == NULL ? result.err[0] == '\0' : strstr(result.err, says) != NULL);
  cli_clear(&result);
  char *text = cli_contents(cli.folder, "x.csv");
  g_unlink(csv);
  return text;
}

// The codes are in CSV, JSON and below the table, and a store returns them with the figures.
static void test_warnings(void) {
  g_autofree char *study = write_study();
  for (int i = 0; i < 2; i++) { // computed, and from the store
    g_autofree char *csv = csv_of(study, 0, NULL);
    g_auto(GStrv) lines = g_strsplit(csv, "\n", -1);
    g_assert_true(g_str_has_suffix(lines[0], ",status,warnings"));
    for (int k = 1; k <= 3; k++) {
      g_auto(GStrv) cells = g_strsplit(lines[k], ",", -1);
      g_assert_cmpuint(g_strv_length(cells), ==, 6);
      g_assert_cmpstr(cells[4], ==, "ok");
      g_auto(GStrv) codes = g_strsplit(cells[5], ";", -1);
      g_assert_cmpint(g_strv_contains((const char *const *)codes, "karaszkiewicz-squeeze"), ==,
                      k > 1);
    }
    CliResult result = CLI("study", study, "--json", "-");
    g_autoptr(JsonNode) root = cli_parse(result.out);
    g_assert_cmpfloat(cli_number(root, "warnings.karaszkiewicz-squeeze"), ==, 2);
    cli_clear(&result);
    result = CLI("study", study);
    g_assert_nonnull(strstr(result.out, "karaszkiewicz-squeeze in 2"));
    g_assert_nonnull(strstr(result.out, "of 3 samples"));
    g_assert_nonnull(strstr(result.out, "x.store (-o"));
    cli_clear(&result);
  }
  remove_named("x.store");
  g_unlink(study);
}

// A bit of a figure: named by check, left out by recover and export, computed again by a study.
static void test_damage(void) {
  g_autofree char *study = write_study(), *store = path_of("x.store"), *saved = path_of("s.store");
  g_autofree char *expected = csv_of(study, 0, NULL);
  CliResult result = CLI("store", "check", store);
  g_assert_cmpint(result.code, ==, 0);
  g_assert_nonnull(strstr(result.out, "3 rows, 0 damaged"));
  cli_clear(&result);
  // The radial space is in the file as a double; a bit of the row's next double.
  char *bytes = NULL;
  gsize length = 0;
  const double space = 1.58e-3;
  g_assert_true(g_file_get_contents(store, &bytes, &length, NULL));
  char *at = memmem(bytes, length, &space, sizeof space);
  g_assert_nonnull(at);
  at[sizeof space] ^= 1;
  g_assert_true(g_file_set_contents(store, bytes, (gssize)length, NULL));
  result = CLI("store", "check", store);
  g_assert_cmpint(result.code, ==, 1);
  g_assert_nonnull(
      strstr(result.err, "gland.radial_space = 0.00158): its checksum does not match"));
  cli_clear(&result);
  result = CLI("store", "check", store, "--json", "-", "-q");
  g_assert_cmpint(result.code, ==, 1);
  g_autoptr(JsonNode) check = cli_parse(result.out);
  g_assert_cmpfloat(cli_number(check, "damaged"), ==, 1);
  g_assert_false(json_node_get_boolean(cli_at(check, "sound")));
  cli_clear(&result);
  result = CLI("store", "recover", store, "-o", saved);
  g_assert_cmpint(result.code, ==, 0);
  g_assert_nonnull(strstr(result.out, "2 sound rows"));
  cli_clear(&result);
  result = CLI("store", "export", saved);
  g_assert_cmpint(result.code, ==, 0);
  g_assert_true(g_str_has_prefix(result.out, "row,gland.radial_space [m],cycle.force_breakaway_N,"
                                             "seals.outer.load_N,status,reason,engine,warnings\n"));
  g_auto(GStrv) lines = g_strsplit(result.out, "\n", -1);
  g_assert_cmpuint(g_strv_length(lines), ==, 4); // heading, two rows, the end
  cli_clear(&result);
  result = CLI("store", "export", store, "--json", "-");
  g_assert_cmpint(result.code, ==, 0);
  g_assert_nonnull(strstr(result.err, "1 damaged rows are left out"));
  g_autoptr(JsonNode) root = cli_parse(result.out);
  g_assert_cmpuint(json_array_get_length(json_node_get_array(cli_at(root, "rows"))), ==, 2);
  cli_clear(&result);
  g_autofree char *resumed = csv_of(study, 0, "1 of 3 rows are damaged");
  g_assert_cmpstr(resumed, ==, expected);
  result = CLI("store", "check", store, "-q");
  g_assert_cmpint(result.code, ==, 0);
  cli_clear(&result);
  g_free(bytes);
  g_unlink(store);
  g_unlink(saved);
  g_unlink(study);
}

// Names of figures that are damaged: reported by check, and written again by the study.
static void test_names(void) {
  g_autofree char *study = write_study(), *store = path_of("x.store");
  g_autofree char *expected = csv_of(study, 0, NULL);
  char *bytes = NULL;
  gsize length = 0;
  g_assert_true(g_file_get_contents(store, &bytes, &length, NULL));
  char *at = memmem(bytes, length, "seals.outer.load_N", 18);
  g_assert_nonnull(at);
  at[6] ^= 1;
  g_assert_true(g_file_set_contents(store, bytes, (gssize)length, NULL));
  CliResult result = CLI("store", "check", store);
  g_assert_cmpint(result.code, ==, 1);
  g_assert_nonnull(strstr(result.err, "of 3 sound rows are damaged"));
  cli_clear(&result);
  g_autofree char *again = csv_of(study, 0, NULL);
  g_assert_cmpstr(again, ==, expected);
  result = CLI("store", "check", store, "-q");
  g_assert_cmpint(result.code, ==, 0);
  cli_clear(&result);
  g_free(bytes);
  g_unlink(store);
  g_unlink(study);
}

static void test_refused(void) {
  g_autofree char *study = write_study(), *store = path_of("x.store");
  static const char *const names[] = {":memory:", "-", "file:zz?mode=memory", "file:zz.store"};
  for (size_t i = 0; i < G_N_ELEMENTS(names); i++) {
    CliResult result = CLI("study", study, "-o", names[i], "-q");
    g_assert_cmpint(result.code, ==, 1);
    g_assert_nonnull(strstr(result.err, "cannot be a store"));
    cli_clear(&result);
    result = CLI("merge", names[i], study);
    g_assert_cmpint(result.code, ==, 1);
    g_assert_nonnull(strstr(result.err, "cannot be a store"));
    cli_clear(&result);
  }
  CliResult result = CLI("store", "check", study);
  g_assert_cmpint(result.code, ==, 1);
  g_assert_nonnull(strstr(result.err, "is not a store"));
  cli_clear(&result);
  result = CLI("store", "chek", study);
  g_assert_cmpint(result.code, ==, 1);
  g_assert_nonnull(strstr(result.err, "do you mean check?"));
  cli_clear(&result);
  result = CLI("store", "check", store);
  g_assert_cmpint(result.code, ==, 1);
  g_assert_nonnull(strstr(result.err, "x.store: is not a file"));
  cli_clear(&result);
  g_unlink(study);
}

// A study of the installed program leaves its store in the current folder and names it.
static void test_installed(void) {
  g_autofree char *scenes = g_path_get_dirname(cli.scene), *assets = g_path_get_dirname(scenes);
  g_autofree char *study = g_build_filename(assets, "studies", "tolerance.study", NULL);
  g_autofree char *beside = g_build_filename(assets, "studies", "tolerance.store", NULL);
  const char *const arguments[] = {"study", study, "--shard", "1/500", NULL};
  CliResult result = cli_run_in(cli.folder, arguments, NULL, G_SPAWN_DEFAULT, NULL);
  g_assert_cmpint(result.code, ==, 0);
  g_assert_nonnull(strstr(result.out, "answers in tolerance.store (-o STORE"));
  g_assert_false(g_file_test(beside, G_FILE_TEST_EXISTS));
  g_autofree char *store = path_of("tolerance.store");
  g_assert_true(g_file_test(store, G_FILE_TEST_EXISTS));
  g_unlink(store);
  cli_clear(&result);
}

// Names of variables are quoted, and are no formulas for a spreadsheet.
static void test_header(void) {
  g_autofree char *folder = g_path_get_dirname(cli.scene), *study = path_of("x.study");
  g_autofree char *text = g_strdup_printf(
      "[sealbench]\nformat = 1\nkind = study\nscene = %s/quick-look.scene\n\n[study]\nmethod = "
      "grid\n"
      "figures = cycle.force_breakaway_N\n\n[vary]\n@SUM(A1),\"x = levels 1, 2\n-2+3 = levels 1\n",
      folder);
  g_assert_true(g_file_set_contents(study, text, -1, NULL));
  g_autofree char *csv = csv_of(study, 0, NULL);
  g_auto(GStrv) lines = g_strsplit(csv, "\n", 2);
  g_assert_cmpstr(lines[0], ==,
                  "sample,\"'@SUM(A1),\"\"x [1]\",'-2+3 [1],cycle.force_breakaway_N,status,"
                  "warnings");
  remove_named("x.store");
  g_unlink(study);
}

// A name with a line end would put a command into the script; all names of the script are refused
// so.
static void test_slurm(void) {
  g_autofree char *study = write_study(), *script = path_of("job.sh");
  g_autofree char *named = path_of("x\necho pwned #.study"), *store = path_of("y\ntouch z #.store");
  g_autofree char *text = cli_contents(cli.folder, "x.study");
  g_assert_true(g_file_set_contents(named, text, -1, NULL));
  CliResult result = CLI("study", named, "--shard", "1/3", "--emit-slurm", script);
  g_assert_cmpint(result.code, ==, 1);
  g_assert_nonnull(strstr(result.err, "control character"));
  cli_clear(&result);
  result = CLI("study", study, "--shard", "1/3", "--emit-slurm", script, "-o", store);
  g_assert_cmpint(result.code, ==, 1);
  g_assert_nonnull(strstr(result.err, "control character"));
  cli_clear(&result);
  const char *ignored[] = {"--csv", "--json"};
  for (size_t i = 0; i < G_N_ELEMENTS(ignored); i++) {
    result = CLI("study", study, "--shard", "1/3", "--emit-slurm", script, ignored[i], "-");
    g_assert_cmpint(result.code, ==, 1);
    g_assert_nonnull(strstr(result.err, ignored[i]));
    cli_clear(&result);
  }
  g_assert_false(g_file_test(script, G_FILE_TEST_EXISTS));
  result = CLI("study", study, "--shard", "1/3", "--emit-slurm", script);
  g_assert_cmpint(result.code, ==, 0);
  g_assert_true(g_file_test(script, G_FILE_TEST_EXISTS));
  cli_clear(&result);
  g_unlink(script);
  g_unlink(named);
  g_unlink(study);
}

// Limits that every valve misses: "every valve fails", and what the interval covers.
static void test_certain(void) {
  g_autofree char *folder = g_path_get_dirname(cli.scene), *study = path_of("x.study");
  g_autofree char *text = g_strdup_printf(
      "[sealbench]\nformat = 1\nkind = study\nscene = %s/quick-look.scene\n\n[vary]\n"
      "gland.radial_space = normal 1.36 mm, 0.005 mm\n\n[study]\nmethod = reliability\n"
      "samples = 200\n\n[limits]\nseals.outer.squeeze = <= 1 %%\nseals.inner.squeeze = >= 14.5 "
      "%%\n",
      folder);
  g_assert_true(g_file_set_contents(study, text, -1, NULL));
  CliResult result = CLI("study", study);
  g_assert_cmpint(result.code, ==, 0);
  g_assert_nonnull(strstr(result.out, "every valve fails: all of 200 samples are beyond the limit "
                                      "(sampling alone, 95 %: at least "));
  g_assert_null(strstr(result.out, "is not reached"));
  g_assert_null(strstr(result.out, "e+0")); // 982 000 ppm
  g_assert_nonnull(strstr(result.out, "ppm (sampling alone, 95 %: "));
  cli_clear(&result);
  result = CLI("study", study, "--json", "-");
  g_autoptr(JsonNode) root = cli_parse(result.out);
  g_assert_cmpfloat(cli_number(root, "limits.0.probability_of_failure"), ==, 1);
  g_assert_cmpfloat(cli_number(root, "limits.0.interval_95.1"), ==, 1);
  g_assert_cmpfloat(cli_number(root, "limits.0.interval_95.0"), >, 0.9);
  g_assert_cmpstr(json_node_get_string(cli_at(root, "limits.1.interval_covers")), ==,
                  "sampling alone");
  g_assert_nonnull(
      strstr(json_node_get_string(cli_at(root, "limits.0.reason")), "every valve fails"));
  g_assert_nonnull(strstr(json_node_get_string(cli_at(root, "limits.0.failure_points.0.reason")),
                          "the median fails"));
  cli_clear(&result);
  remove_named("x.store");
  g_unlink(study);
}

int main(int argc, char **argv) {
  g_test_init(&argc, &argv, NULL);
  cli_set_up();
  g_test_add_func("/cli-store/warnings", test_warnings);
  g_test_add_func("/cli-store/damage", test_damage);
  g_test_add_func("/cli-store/names", test_names);
  g_test_add_func("/cli-store/refused", test_refused);
  g_test_add_func("/cli-store/installed", test_installed);
  g_test_add_func("/cli-store/header", test_header);
  g_test_add_func("/cli-store/slurm", test_slurm);
  g_test_add_func("/cli-store/certain", test_certain);
  const int failed = g_test_run();
  cli_tear_down();
  return failed;
}
