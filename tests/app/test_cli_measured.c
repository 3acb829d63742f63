// Measured loops from outside: beside runs, runs beside each other, what is refused. The loop that
// is "measured" is the program's own table of another run, so that every difference is known.
#include "tests/app/cli_fixture.h"

#include <glib/gstdio.h>
#include <math.h>
#include <string.h>

static char *quick;  // quick-look.scene
static char *table;  // cycle.csv of it
static char *scene;  // the same with the table as [data]
static char *folder; // that has them

static void write_text(const char *path, const char *text) {
  g_assert_true(g_file_set_contents(path, text, -1, NULL));
}

static void set_up(void) {
  quick = g_build_filename(g_getenv("SEALBENCH_ASSETS"), "scenes", "quick-look.scene", NULL);
  folder = g_build_filename(cli.folder, "bench", NULL);
  table = g_build_filename(folder, "cycle.csv", NULL);
  scene = g_build_filename(folder, "x.scene", NULL);
  CliResult result = CLI("run", quick, "-o", folder, "-q");
  g_assert_cmpint(result.code, ==, 0);
  cli_clear(&result);
  g_autofree char *text =
      g_strdup_printf("[sealbench]\nformat = 1\nkind = scene\nvalve = %s\n[models]\n"
                      "fit = karaszkiewicz\nfilm = thesis\n[output]\nframes = 400\n"
                      "[data]\nfile = cycle.csv\ncolumns = time, displacement, -, force\n"
                      "zero = as-is\ncompliance = none\n",
                      cli.valve);
  write_text(scene, text);
}

// The very run: no difference; what was specified is reported.
static void test_same(void) {
  CliResult result = CLI("run", scene, "--json", "-");
  g_assert_cmpint(result.code, ==, 0);
  JsonNode *root = cli_parse(result.out);
  cli_has_keys(root, "measured.file measured.rms_N measured.stages.B.measured_N "
                     "measured.stages.F.model_N measured.recognised.separator "
                     "measured.recognised.columns.force.unit measured.recognised.zero.force_how "
                     "measured.recognised.compliance.m_per_N measured.recognised.cycles "
                     "measured.recognised.direction.how measured.noise_N");
  g_assert_cmpfloat(cli_number(root, "measured.rms_N"), <, 1e-9);
  g_assert_cmpfloat(cli_number(root, "measured.outside"), ==, 0);
  g_assert_cmpfloat(cli_number(root, "measured.points"), >, 300);
  static const char stages[] = "BCDEF";
  for (const char *stage = stages; *stage != '\0'; stage++) {
    g_autofree char *less = g_strdup_printf("measured.stages.%c.difference_N", *stage);
    g_autofree char *deviation = g_strdup_printf("measured.stages.%c.measured_deviation_N", *stage);
    g_assert_cmpfloat(fabs(cli_number(root, less)), <=,
                      fmax(2 * cli_number(root, deviation), 0.01));
  }
  json_node_unref(root);
  cli_clear(&result);
}

// Another pressure: the residuals are what the runs differ by.
static void test_differences(void) {
  CliResult result = CLI("compare", scene, "--set", "canister.pressure=0.5MPa", "--json", "-");
  g_assert_cmpint(result.code, ==, 0);
  JsonNode *root = cli_parse(result.out);
  cli_has_keys(
      root,
      "runs.0.name runs.0.figures runs.0.reasons differences measured.rms_N measured.stages.B");
  json_node_unref(root);
  cli_clear(&result);
  result = CLI("compare", quick, scene, "--set", "canister.pressure=0.5MPa", "--measured", table,
               "--json", "-");
  // The table of a run has several forces: quick-look's scene does not say which.
  g_assert_cmpint(result.code, ==, 1);
  g_assert_nonnull(strstr(result.err, "may both be the"));
  root = cli_parse(result.out);
  const double moved = cli_number(root, "measured.stages.C.difference_N");
  json_node_unref(root);
  cli_clear(&result);
  // From the figures of both pressures.
  g_autofree char *other = g_build_filename(folder, "y.scene", NULL);
  g_autofree char *text =
      g_strdup_printf("[sealbench]\nformat = 1\nkind = scene\nvalve = %s\n[canister]\n"
                      "pressure = 0.5 MPa\n[models]\nfit = karaszkiewicz\nfilm = thesis\n"
                      "[output]\nframes = 400\n",
                      cli.valve);
  write_text(other, text);
  result = CLI("compare", other, quick, "--json", "-");
  g_assert_cmpint(result.code, ==, 0);
  root = cli_parse(result.out);
  JsonObject *differences =
      json_object_get_object_member(json_node_get_object(root), "differences");
  JsonArray *c = json_object_get_array_member(differences, "cycle.stages.C.force_N");
  g_assert_cmpuint(json_array_get_length(c), ==, 2);
  g_assert_cmpfloat(json_array_get_double_element(c, 0), ==, 0);
  g_assert_cmpfloat(fabs(moved), >, 0.5);
  g_assert_cmpfloat_with_epsilon(json_array_get_double_element(c, 1), moved, 0.06);
  json_node_unref(root);
  cli_clear(&result);
  g_unlink(other);
}

// The table that people read, and the loop's picture with what was measured.
static void test_shown(void) {
  CliResult result = CLI("compare", scene);
  g_assert_cmpint(result.code, ==, 0);
  static const char *const lines[] = {"separator comma, decimal point, utf-8",
                                      "displacement: column 2 \"displacement\" in m (as specified)",
                                      "Stage B", "Difference, root mean square"};
  for (size_t i = 0; i < G_N_ELEMENTS(lines); i++) {
    g_assert_nonnull(strstr(result.out, lines[i]));
  }
  cli_clear(&result);
  g_autofree char *with = g_build_filename(folder, "with.svg", NULL);
  g_autofree char *without = g_build_filename(folder, "without.svg", NULL);
  result = CLI("render", scene, "--view", "hysteresis", "-o", with);
  g_assert_cmpint(result.code, ==, 0);
  cli_clear(&result);
  result = CLI("render", quick, "--view", "hysteresis", "-o", without);
  g_assert_cmpint(result.code, ==, 0);
  cli_clear(&result);
  g_autofree char *more = cli_contents(folder, "with.svg");
  g_autofree char *less = cli_contents(folder, "without.svg");
  g_assert_cmpuint(strlen(more), >, strlen(less) + 20000);
  g_unlink(with);
  g_unlink(without);
}

// What is wrong with the data is told before the run, with the key that would say.
static void test_refused(void) {
  g_autofree char *bad = g_build_filename(folder, "bad.csv", NULL);
  write_text(bad, "Weg [mm];Kraft [N]\n1,234;5,678\n1,235;5,679\n");
  static const char *const commands[] = {"run", "compare"};
  for (size_t i = 0; i < G_N_ELEMENTS(commands); i++) {
    CliResult result = CLI(commands[i], quick, "--measured", bad);
    g_assert_cmpint(result.code, ==, 1);
    g_assert_nonnull(strstr(result.err, "1234 with a decimal point, 1.234 with a decimal comma"));
    cli_clear(&result);
  }
  CliResult result = CLI("run", quick, "--measured", "/no/such.csv");
  g_assert_cmpint(result.code, ==, 1);
  cli_clear(&result);
  g_autofree char *text = cli_contents(folder, "x.scene");
  g_autofree char *unknown = g_strconcat(text, "wheel = 3\n", NULL);
  g_autofree char *path = g_build_filename(folder, "unknown.scene", NULL);
  write_text(path, unknown);
  result = CLI("check", path);
  g_assert_cmpint(result.code, ==, 1);
  g_assert_nonnull(strstr(result.err, "wheel"));
  cli_clear(&result);
  // check reads the data too.
  g_autofree char *wrong = g_strconcat(text, "direction = up\n", NULL);
  write_text(path, wrong);
  result = CLI("check", path);
  g_assert_cmpint(result.code, ==, 1);
  g_assert_nonnull(strstr(result.err, "[data] direction: \"up\" is not one of these"));
  cli_clear(&result);
  result = CLI("check", scene);
  g_assert_cmpint(result.code, ==, 0);
  g_assert_nonnull(
      strstr(result.out, "displacement: column 2 \"displacement\" in m (as specified)"));
  cli_clear(&result);
  g_unlink(path);
  g_unlink(bad);
}

// The estimates of a calibration lie within three deviations of what its data were made with.
typedef struct {
  const char *key;
  double value;
} Made;

static void assert_recovered(JsonNode *root, const Made *made, size_t count) {
  JsonObject *parameters = json_object_get_object_member(json_node_get_object(root), "parameters");
  for (size_t i = 0; i < count; i++) {
    JsonObject *one = json_object_get_object_member(parameters, made[i].key);
    g_assert_cmpfloat_with_epsilon(json_object_get_double_member(one, "estimate"), made[i].value,
                                   3 * json_object_get_double_member(one, "standard_deviation"));
    g_assert_cmpuint(json_array_get_length(json_object_get_array_member(one, "interval_95")), ==,
                     2);
    g_assert_nonnull(json_object_get_string_member(one, "identifiable"));
    g_assert_nonnull(json_object_get_array_member(one, "with"));
  }
}

// The shipped strokes of a valve that runs in.
static void test_running_in(void) {
  g_autofree char *study =
      g_build_filename(g_getenv("SEALBENCH_ASSETS"), "studies", "running-in.study", NULL);
  CliResult result = CLI("calibrate", study, "--json", "-");
  g_assert_cmpint(result.code, ==, 0);
  JsonNode *root = cli_parse(result.out);
  cli_has_keys(root, "curves.3.measured.recognised");
  static const Made made[] = {
      {"life.roughness_new", 1.15}, {"life.roughness_run_in", 0.78}, {"life.running_in", 3}};
  assert_recovered(root, made, G_N_ELEMENTS(made));
  g_assert_cmpfloat(cli_number(root, "residual_rms_N"), <, 0.14);
  cli_clear(&result);
  json_node_unref(root);
}

// The fitted valve reads by itself, has the fitted values and not the conditions of the
// measurement, and a scene of its own meets the data as the fit does.
static void assert_fitted_valve(const char *out, double rms) {
  g_autofree char *path = g_build_filename(out, "fitted.valve", NULL);
  CliResult result = CLI("check", path);
  g_assert_cmpint(result.code, ==, 0);
  cli_clear(&result);
  g_autofree char *valve = cli_contents(out, "fitted.valve");
  g_assert_nonnull(strstr(valve, "\nkind = valve\n"));
  g_assert_nonnull(strstr(valve, "\n# Calibrated with bench.study from "));
  g_assert_nonnull(strstr(valve, "\nland_edge = "));
  g_assert_nonnull(strstr(valve, "\nload_coefficient = "));
  g_assert_null(strstr(valve, "\n[data]"));
  // The fitted scene with every value of the fit taken out and the fitted valve put in.
  g_autofree char *scene_text = cli_contents(out, "fitted.scene");
  g_auto(GStrv) lines = g_strsplit(scene_text, "\n", -1);
  GString *text = g_string_new(NULL);
  for (char **line = lines; *line != NULL; line++) {
    static const char *const fitted[] = {"land_edge", "load_coefficient", "static_ratio",
                                         "pressure_diameter"};
    bool drops = false;
    for (size_t i = 0; i < G_N_ELEMENTS(fitted); i++) {
      drops |= g_str_has_prefix(*line, fitted[i]);
    }
    if (!drops) {
      const bool names = g_str_has_prefix(*line, "valve = ");
      g_string_append_printf(text, "%s\n", names ? "valve = fitted.valve" : *line);
    }
  }
  g_autofree char *named = g_build_filename(out, "named.scene", NULL);
  write_text(named, text->str);
  g_string_free(text, TRUE);
  result = CLI("compare", named, "--json", "-");
  g_assert_cmpint(result.code, ==, 0);
  JsonNode *root = cli_parse(result.out);
  g_assert_cmpfloat_with_epsilon(cli_number(root, "measured.rms_N"), rms, 1e-9);
  json_node_unref(root);
  cli_clear(&result);
  g_unlink(named);
}

// Every estimate is inside of its interval, also that of the break-away, which fits best where the
// stem hardly returns: the posterior ends there.
static void assert_estimates_inside(JsonNode *root) {
  JsonObject *parameters = json_object_get_object_member(json_node_get_object(root), "parameters");
  g_autoptr(GList) keys = json_object_get_members(parameters);
  g_assert_true(json_object_has_member(parameters, "friction.static_ratio"));
  for (GList *key = keys; key != NULL; key = key->next) {
    JsonObject *one = json_object_get_object_member(parameters, key->data);
    JsonArray *interval = json_object_get_array_member(one, "interval_95");
    const double estimate = json_object_get_double_member(one, "estimate");
    g_assert_cmpfloat(estimate, >, json_array_get_double_element(interval, 0));
    g_assert_cmpfloat(estimate, <, json_array_get_double_element(interval, 1));
  }
}

// The shipped bench: the keys of the contract, the values that it was made with, a folder.
static void test_calibrate(void) {
  g_autofree char *study =
      g_build_filename(g_getenv("SEALBENCH_ASSETS"), "studies", "bench.study", NULL);
  g_autofree char *out = g_build_filename(folder, "fit", NULL);
  CliResult result = CLI("calibrate", study, "-o", out);
  g_assert_cmpint(result.code, ==, 0);
  g_autofree char *text = cli_contents(out, "results.json");
  JsonNode *root = cli_parse(text);
  assert_estimates_inside(root);
  cli_has_keys(root, "converged samples residual_rms_N chi2_reduced parameters correlation.keys "
                     "correlation.matrix.3 stages.B.measured_N stages.F.model_N cannot_tell "
                     "curves.0.measured.recognised posterior.model engine.source warnings.0.code "
                     "bounds_active");
  static const Made made[] = {{"friction.load_coefficient", 0.174},
                              {"friction.static_ratio", 1.14},
                              {"bore.land_edge", 3.42e-3},
                              {"stem.pressure_diameter", 5.8e-3}};
  assert_recovered(root, made, G_N_ELEMENTS(made));
  g_assert_cmpfloat(cli_number(root, "residual_rms_N"), <, 0.2);
  cli_clear(&result);
  // The fitted scene meets its data as the fit does, by itself.
  g_autofree char *fitted = g_build_filename(out, "fitted.scene", NULL);
  result = CLI("compare", fitted, "--json", "-");
  g_assert_cmpint(result.code, ==, 0);
  JsonNode *again = cli_parse(result.out);
  g_assert_cmpfloat_with_epsilon(cli_number(again, "measured.rms_N"),
                                 cli_number(root, "curves.0.measured.rms_N"), 1e-9);
  cli_clear(&result);
  json_node_unref(again);
  assert_fitted_valve(out, cli_number(root, "curves.0.measured.rms_N"));
  json_node_unref(root);
  static const char *const own[] = {"posterior.csv", "fitted.scene", "fitted.valve",
                                    "calibration.svg", ".sealbench-calibrate.manifest"};
  for (size_t i = 0; i < G_N_ELEMENTS(own); i++) {
    g_autofree char *path = g_build_filename(out, own[i], NULL);
    g_assert_cmpint(g_unlink(path), ==, 0);
  }
  cli_remove_results(out);
  // Nothing measured, nothing to fit.
  g_autofree char *gland =
      g_build_filename(g_getenv("SEALBENCH_ASSETS"), "studies", "gland.study", NULL);
  result = CLI("calibrate", gland);
  g_assert_cmpint(result.code, ==, 1);
  g_assert_nonnull(strstr(result.err, "[data] file: is missing"));
  cli_clear(&result);
}

// As cairo writes the dashes of the first pin (sb_chart_pin_dash()).
#define PIN_DASHES "stroke-dasharray:7,3"

// A project's pins stand beside its scene.
static void test_project(void) {
  g_autofree char *path = g_build_filename(folder, "x.project", NULL);
  g_autofree char *text = g_strdup_printf(
      "[sealbench]\nformat = 1\nkind = project\nvalve = %s\n[models]\n"
      "fit = karaszkiewicz\nfilm = thesis\n[pins]\nwide = gland.radial_space = 1.38 mm\n"
      "[notes]\nwide = loose\n",
      cli.valve);
  write_text(path, text);
  CliResult result = CLI("compare", path, "--json", "-");
  g_assert_cmpint(result.code, ==, 0);
  JsonNode *root = cli_parse(result.out);
  g_assert_cmpstr(json_node_get_string(cli_at(root, "runs.1.name")), ==, "wide");
  CliResult set = CLI("run", path, "--set", "gland.radial_space=1.38 mm", "--json", "-");
  JsonNode *same = cli_parse(set.out);
  const double force = cli_number(same, "cycle.force_breakaway_N");
  JsonObject *figures = json_node_get_object(cli_at(root, "runs.1.figures"));
  g_assert_cmpfloat(json_object_get_double_member(figures, "cycle.force_breakaway_N"), ==, force);
  json_node_unref(root);
  json_node_unref(same);
  cli_clear(&result);
  cli_clear(&set);
  // In pictures, too: its loop has the first pin's dashes; in each picture of a film its contact.
  g_autofree char *picture = g_build_filename(folder, "pins.svg", NULL);
  for (int without = 0; without < 2; without++) {
    result = CLI("render", path, "--view", "hysteresis", "-o", picture,
                 without ? "--no-pins" : "--quiet");
    g_assert_cmpint(result.code, ==, 0);
    cli_clear(&result);
    g_autofree char *drawn = cli_contents(folder, "pins.svg");
    g_assert_cmpint(strstr(drawn, PIN_DASHES) != NULL, ==, !without);
  }
  g_unlink(picture);
  guchar *film[2];
  gsize size[2];
  for (int without = 0; without < 2; without++) {
    g_autofree char *pattern = g_build_filename(folder, "pins%d.png", NULL);
    g_autofree char *second = g_build_filename(folder, "pins2.png", NULL);
    result = CLI("render", path, "--view", "profiles", "-o", pattern, "--size", "640x360", "--fps",
                 "2", "--duration", "1 s", without ? "--no-pins" : "--quiet");
    g_assert_cmpint(result.code, ==, 0);
    cli_clear(&result);
    g_assert_true(g_file_get_contents(second, (char **)&film[without], &size[without], NULL));
  }
  g_assert_false(size[0] == size[1] && memcmp(film[0], film[1], size[0]) == 0);
  g_free(film[0]);
  g_free(film[1]);
  for (int i = 1; i <= 2; i++) {
    g_autofree char *name = g_strdup_printf("pins%d.png", i);
    g_autofree char *each = g_build_filename(folder, name, NULL);
    g_assert_cmpint(g_unlink(each), ==, 0);
  }
  g_unlink(path);
}

// `check` reads a table of measurements by itself, prints what it recognises and few lines about a
// file that is none.
static void test_check(void) {
  g_autofree char *plain = g_build_filename(folder, "plain.csv", NULL);
  g_autoptr(GString) rows = g_string_new("Time (s),Displacement (mm),Force (N)\n");
  for (int i = 0; i <= 400; i++) {
    const double x = i <= 200 ? 0.033 * i : 0.033 * (400 - i);
    const double force = x == 0 ? 0 : i <= 200 ? fmin(27, 270 * x) : 5;
    char cell[3][G_ASCII_DTOSTR_BUF_SIZE];
    g_string_append_printf(rows, "%s,%s,%s\n", g_ascii_formatd(cell[0], 30, "%.2f", 0.1 * i),
                           g_ascii_formatd(cell[1], 30, "%.4f", x),
                           g_ascii_formatd(cell[2], 30, "%.4f", force));
  }
  write_text(plain, rows->str);
  CliResult result = CLI("check", plain);
  g_assert_cmpint(result.code, ==, 0);
  g_assert_cmpstr(result.err, ==, "");
  g_assert_nonnull(strstr(result.out, "separator"));
  g_assert_nonnull(strstr(result.out, "plain.csv: a measured table without problems\n"));
  cli_clear(&result);
  result = CLI("check", plain, "--json", "-");
  JsonNode *root = cli_parse(result.out);
  JsonArray *files = json_object_get_array_member(json_node_get_object(root), "files");
  JsonObject *file = json_array_get_object_element(files, 0);
  g_assert_cmpstr(json_object_get_string_member(file, "kind"), ==, "measured table");
  json_node_unref(root);
  cli_clear(&result);
  g_autofree char *none = g_build_filename(folder, "none.csv", NULL);
  g_autoptr(GString) text = g_string_new(NULL);
  for (int i = 0; i < 500; i++) {
    g_string_append_printf(text, "word %d\n", i);
  }
  write_text(none, text->str);
  result = CLI("check", none);
  g_assert_cmpint(result.code, ==, 1);
  g_auto(GStrv) lines = g_strsplit(result.err, "\n", -1);
  g_assert_cmpint(g_strv_length(lines), <=, 3);
  g_assert_nonnull(strstr(result.err, "is not a table of measurements"));
  cli_clear(&result);
  // --set counts for the check as for a run, and is refused where nothing can be set.
  result = CLI("check", quick, "--set", "seal.section_diameter=99 mm");
  g_assert_cmpint(result.code, ==, 1);
  g_assert_nonnull(strstr(result.err, "--set: [seal] section_diameter: 99 mm is out of range"));
  cli_clear(&result);
  result = CLI("check", quick, "--set", "seal.modulus=60 Shore A");
  g_assert_cmpint(result.code, ==, 0);
  g_assert_nonnull(strstr(result.err, "60 Shore A is a modulus of 3.61 MPa"));
  cli_clear(&result);
  // Notes are not printed with --quiet.
  result = CLI("plan", quick, "--set", "seal.modulus=60 Shore A");
  g_assert_nonnull(strstr(result.err, "note: seal.modulus: 60 Shore A is a modulus"));
  cli_clear(&result);
  result = CLI("plan", quick, "--set", "seal.modulus=60 Shore A", "-q");
  g_assert_cmpint(result.code, ==, 0);
  g_assert_cmpstr(result.err, ==, "");
  cli_clear(&result);
  result = CLI("check", plain, "--set", "seal.modulus=60 Shore A");
  g_assert_cmpint(result.code, ==, 1);
  cli_clear(&result);
  g_unlink(plain);
  g_unlink(none);
}

int main(int argc, char **argv) {
  g_test_init(&argc, &argv, NULL);
  cli_set_up();
  set_up();
  g_test_add_func("/cli-measured/same", test_same);
  g_test_add_func("/cli-measured/check", test_check);
  g_test_add_func("/cli-measured/differences", test_differences);
  g_test_add_func("/cli-measured/shown", test_shown);
  g_test_add_func("/cli-measured/refused", test_refused);
  g_test_add_func("/cli-measured/project", test_project);
  g_test_add_func("/cli-measured/calibrate", test_calibrate);
  g_test_add_func("/cli-measured/running-in", test_running_in);
  const int result = g_test_run();
  g_unlink(scene);
  cli_remove_results(folder);
  cli_tear_down();
  return result;
}
