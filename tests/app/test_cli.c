// The program from outside: exit codes, messages, JSON keys, locales, what is written where.
#include "app/export/results.h"
#include "tests/app/cli_fixture.h"
#include "tests/sanitized.h"

#include <glib/gstdio.h>
#include <math.h>
#include <signal.h>
#include <string.h>
#include <sys/resource.h>

static void limit_files(gpointer data) {
  // Writing beyond a kilobyte fails as on a full disk.
  struct rlimit limit = {1000, 1000};
  setrlimit(RLIMIT_FSIZE, &limit);
  signal(SIGXFSZ, SIG_IGN);
}

// ---- Exit codes and messages ----

static void test_usage(void) {
  static const struct {
    const char *arguments[8];
    int code;
    const char *says; // on standard error; NULL: nothing there
  } cases[] = {
      {{"--version"}, 0, NULL},
      {{"--help"}, 0, NULL},
      {{"run", "--help"}, 0, NULL},
      {{"film", "--help"}, 0, NULL},
      {{NULL}, 1, "Usage:"},
      {{"dance"}, 1, "sealbench: there is no command \"dance\""},
      {{"run"}, 1, "sealbench: too few operands: usage: sealbench run FILE.scene..."},
      {{"list", "models", "views"}, 1, "too many operands"},
      {{"run", "--frob", "a"}, 1, "Unknown option --frob"},
      {{"run", "/no/such.scene"}, 1, "sealbench: /no/such.scene: No such file or directory\n"},
      {{"check", "/"}, 1, "sealbench: /: is a folder, not a file\n"},
      {{"check", "/dev/zero"}, 1, "is not a regular file\n"},
      {{"list", "colours"}, 1, "allowed params, figures, models, views, fluids"},
      {{"fluid"}, 1, "too few operands: usage: sealbench fluid NAME"},
      {{"fluid", "hfa-134"}, 1, "do you mean hfa-134a?"},
      {{"fluid", "hfa-134a"}, 1, "--temperature is missing"},
      {{"fluid", "hfa-134a", "--temperature", "20"}, 1, "write for example \"20 °C\""},
      {{"fluid", "hfa-134a", "--temperature", "20 kPa"}, 1, "another kind"},
      {{"fluid", "hfa-134a", "--temperature", "-41degC"}, 1, "its figures, -40 to 80 °C\n"},
      {{"fluid", "hfa-134a", "--temperature", "393.15K"},
       1,
       "-40 to 80 °C, above its critical temperature of 101.06 °C\n"},
      {{"fluid", "custom", "--temperature", "20degC"}, 1, "custom has no properties of its own"},
      {{"fluid", "ethanol", "--temperature", "20degC", "--ethanol", "5%"}, 1, "is a cosolvent"},
      {{"fluid", "hfa-134a", "--temperature", "20degC", "--ethanol", "31%"}, 1, "0 and 0.3"},
      {{"fluid", "hfa-134a", "--temperature", "-40degC"}, 0, NULL},
      {{"asperity"}, 1, "--lambda is missing"},
      {{"asperity", "--lambda", "x"}, 1, "--lambda: \"x\" is not a number"},
      {{"asperity", "--lambda", "3 mm"}, 1, "this value has none"},
      {{"asperity", "--lambda", "-11"}, 1, "-1"},
      {{"asperity", "--lambda", "-10"}, 0, NULL},
      {{"asperity", "--lambda", "40"}, 0, NULL},
      {{"film", "--load", "850.2"},
       1,
       "--load: \"850.2\" has no unit, write for example \"850.2 N/m\""},
      {{"film", "--load", "850.2N/m"}, 1, "--speed is missing"},
      {{"film", "--load", "850.2 mm"}, 1, "another kind, expected N/m"},
      {{"film", "--load", "\xff"}, 1, "not UTF-8"},
  };
  for (size_t i = 0; i < G_N_ELEMENTS(cases); i++) {
    CliResult result = cli_run(cases[i].arguments, NULL, NULL);
    if (result.code != cases[i].code) {
      g_error("case %zu: exit %d, not %d: %s", i, result.code, cases[i].code, result.err);
    }
    if (cases[i].says == NULL) {
      g_assert_cmpstr(result.err, ==, "");
    } else if (strstr(result.err, cases[i].says) == NULL) {
      g_error("case %zu: \"%s\" lacks \"%s\"", i, result.err, cases[i].says);
    }
    if (cases[i].code != 0) {
      g_assert_cmpstr(result.out, ==, "");
    }
    cli_clear(&result);
  }
}

static void test_bad_input(void) {
  char *out = g_build_filename(cli.folder, "none", NULL);
  CliResult result =
      CLI("run", cli.scene, "-o", out, "--set", "seal.modulus=3", "--set", "bore.x=1 mm");
  g_assert_cmpint(result.code, ==, 1);
  g_assert_cmpstr(result.err, ==,
                  "sealbench: --set: [seal] modulus: \"3\" has no unit, write for example \"3 "
                  "MPa\" (allowed 0.1 to 10000 MPa)\n"
                  "sealbench: --set: [bore] x: unknown key\n");
  cli_clear(&result);
  result = CLI("run", cli.scene, "-o", out, "--set", "stem.pressure_diameter=7 mm");
  g_assert_cmpint(result.code, ==, 1);
  g_assert_nonnull(strstr(result.err, "[bore] diameter: the bore is smaller than the stem"));
  cli_clear(&result);
  g_assert_false(g_file_test(out, G_FILE_TEST_EXISTS));
  result = CLI("fit", cli.valve, "--seal", "middle");
  g_assert_cmpint(result.code, ==, 1);
  cli_clear(&result);
  result = CLI("fit", cli.valve, "--seal", "outer", "--model", "sponge");
  g_assert_cmpint(result.code, ==, 1);
  g_assert_nonnull(strstr(result.err, "karaszkiewicz"));
  cli_clear(&result);
  g_free(out);
}

// ---- JSON ----

static void test_json_run(void) {
  CliResult result = CLI("run", cli.scene, "--json", "-", "--quiet");
  g_assert_cmpint(result.code, ==, 0);
  g_assert_cmpstr(result.err, ==, "");
  JsonNode *root = cli_parse(result.out);
  cli_has_keys(root,
               "scene version parameters_sha256 models.fit models.film models.surface "
               "models.friction models.motion cycle.force_peak_N cycle.force_breakaway_N "
               "cycle.force_return_min_N cycle.returns cycle.energy_loss_J cycle.energy_closure "
               "cycle.leakage_per_cycle_m3 cycle.duration_s warnings solver.converged "
               "solver.frames solver.steps solver.rejected_steps solver.newton_iterations "
               "solver.wall_s solver.error_estimate solver.counters.reynolds_solves "
               "solver.counters.ring_solves solver.counters.field_evaluations");
  for (const char *stage = "ABCDEF"; *stage != '\0'; stage++) {
    char *path = g_strdup_printf("cycle.stages.%c.", *stage);
    static const char *const keys[] = {"time_s", "displacement_m", "force_N"};
    for (size_t i = 0; i < G_N_ELEMENTS(keys); i++) {
      char *key = g_strconcat(path, keys[i], NULL);
      g_assert_true(isfinite(cli_number(root, key)));
      g_free(key);
    }
    g_free(path);
  }
  static const char *const seals[] = {"outer", "inner"};
  for (size_t i = 0; i < G_N_ELEMENTS(seals); i++) {
    JsonNode *seal = cli_at(cli_at(root, "seals"), seals[i]);
    cli_has_keys(seal, "contact_width_m load_N pressure_peak_Pa film_min_m film_central_m "
                       "film_by_model.karaszkiewicz film_by_model.thesis film_by_model.reynolds "
                       "lambda friction_boundary_N friction_viscous_N friction_static_N "
                       "coefficient_of_friction leakage_per_stroke_m3 leakage_static_m3_per_s");
  }
  cli_has_keys(cli_at(root, "warnings.0"), "code text parameter");
  g_assert_cmpfloat(cli_number(root, "cycle.force_breakaway_N"), >, 24.5);
  g_assert_cmpfloat(cli_number(root, "cycle.force_breakaway_N"), <, 30.5);
  g_assert_cmpfloat(cli_number(root, "cycle.force_return_min_N"), >, 1.0);
  g_assert_cmpfloat(cli_number(root, "cycle.force_return_min_N"), <, 2.2);
  g_assert_cmpfloat(cli_number(root, "cycle.energy_closure"), <=, 1e-6);
  g_assert_cmpuint(strlen(json_node_get_string(cli_at(root, "parameters_sha256"))), ==, 64);
  json_node_unref(root);
  cli_clear(&result);

  // +30 % roughness: the sign of the return force.
  result = CLI("run", cli.scene, "--json", "-", "--quiet", "--set", "surface.gt_product=0.16757");
  root = cli_parse(result.out);
  g_assert_cmpfloat(cli_number(root, "cycle.force_return_min_N"), <, 0);
  g_assert_false(json_node_get_boolean(cli_at(root, "cycle.returns")));
  json_node_unref(root);
  cli_clear(&result);
}

// Plan and counters tell the same for every shipped scene.
static void test_plan_matches(void) {
  char *scenes = g_path_get_dirname(cli.scene);
  GDir *dir = g_dir_open(scenes, 0, NULL);
  const char *name;
  unsigned seen = 0;
  while ((name = g_dir_read_name(dir)) != NULL) {
    char *path = g_build_filename(scenes, name, NULL);
    // Whatever the tolerance.
    CliResult plan = CLI("plan", path, "--json", "-", "--set", "output.tolerance=0.01");
    g_assert_cmpint(plan.code, ==, 0);
    JsonNode *plan_root = cli_parse(plan.out);
    bool reynolds = false;
    bool ring = false;
    bool profiles = false;
    bool interior = false;
    JsonArray *fields = json_node_get_array(cli_at(plan_root, "fields"));
    for (guint i = 0; i < json_array_get_length(fields); i++) {
      JsonNode *field = json_array_get_element(fields, i);
      cli_has_keys(field, "name model reason cost_s error");
      const char *model = json_node_get_string(cli_at(field, "model"));
      const char *what = json_node_get_string(cli_at(field, "name"));
      reynolds |= g_str_has_prefix(model, "reynolds"); // with asperities, too
      ring |= strcmp(model, "ring") == 0;
      profiles |= strstr(what, "profile") != NULL;
      interior |= strstr(what, "interior") != NULL;
    }
    // A scene that shows everything skips nothing.
    if (json_array_get_length(json_node_get_array(cli_at(plan_root, "skipped"))) > 0) {
      cli_has_keys(plan_root, "skipped.0.name skipped.0.reason");
    }
    // One scene of each plan runs; test_scenes.c runs them all.
    const unsigned planned = 1U << (reynolds + 2 * ring + 4 * profiles + 8 * interior);
    if ((seen & planned) == 0) {
      CliResult run = CLI("run", path, "--json", "-", "--quiet", "--set", "output.tolerance=0.01");
      g_assert_cmpint(run.code, ==, 0);
      JsonNode *run_root = cli_parse(run.out);
      JsonNode *counters = cli_at(run_root, "solver.counters");
      g_assert_cmpint(cli_number(counters, "reynolds_solves") > 0, ==, reynolds);
      g_assert_cmpint(cli_number(counters, "ring_solves") > 0, ==, ring);
      g_assert_cmpint(cli_number(counters, "profile_evaluations") > 0, ==, profiles);
      g_assert_cmpint(cli_number(counters, "field_evaluations") > 0, ==, interior);
      json_node_unref(run_root);
      cli_clear(&run);
    }
    seen |= planned;
    json_node_unref(plan_root);
    cli_clear(&plan);
    g_free(path);
  }
  g_dir_close(dir);
  g_free(scenes);
}

static void test_json_fit(void) {
  CliResult result =
      CLI("fit", cli.valve, "--seal", "outer", "--model", "karaszkiewicz", "--json", "-");
  g_assert_cmpint(result.code, ==, 0);
  g_assert_cmpstr(result.err, ==, "");
  JsonNode *root = cli_parse(result.out);
  cli_has_keys(root, "model seal squeeze stretch_mean stretch_inner section_diameter_fitted_m "
                     "interference_m gland_fill circumference_m contact_width_m contact_left_m "
                     "contact_right_m load_N load_N_per_m pressure_peak_Pa valid warnings "
                     "solver.converged solver.unknowns solver.newton_iterations "
                     "solver.error_estimate.load solver.error_estimate.pressure_peak "
                     "solver.error_estimate.contact_width solver.wall_s profile.x_m "
                     "profile.pressure_Pa");
  g_assert_cmpfloat(fabs(cli_number(root, "stretch_mean") - 0.0427), <, 5e-5);
  g_assert_cmpfloat(fabs(cli_number(root, "circumference_m") - 13.98e-3), <, 5e-6);
  // Thesis, unpressurised: 0.7093 mm and 5.719 N.
  g_assert_cmpfloat(fabs(cli_number(root, "contact_width_m") - 0.7093e-3), <, 1e-7);
  g_assert_cmpfloat(fabs(cli_number(root, "load_N") - 5.719), <, 1e-3);
  json_node_unref(root);
  cli_clear(&result);

  // A ring that does not touch is valid, with no load and a warning.
  result =
      CLI("fit", cli.valve, "--seal", "inner", "--json", "-", "--set", "gland.radial_space=1.9 mm");
  g_assert_cmpint(result.code, ==, 0);
  root = cli_parse(result.out);
  g_assert_cmpfloat(cli_number(root, "load_N"), ==, 0);
  cli_has_keys(cli_at(root, "warnings.0"), "code text parameter");
  json_node_unref(root);
  cli_clear(&result);

  // Dragged: by the ring model, whatever the file's; the greatest drag only where it is asked for.
  result = CLI("fit", cli.valve, "--seal", "outer", "--drag", "0.3", "--json", "-");
  g_assert_cmpint(result.code, ==, 0);
  root = cli_parse(result.out);
  cli_has_keys(root, "drag_N wall_load_N floor_load_N state drag_limit reasons.drag_limit");
  g_assert_cmpstr(json_node_get_string(cli_at(root, "state")), ==, "slides");
  g_assert_true(json_node_is_null(cli_at(root, "drag_limit")));
  g_assert_cmpfloat(fabs(cli_number(root, "drag_N") / 1.740 - 1), <, 5e-3);
  json_node_unref(root);
  cli_clear(&result);
}

static void test_json_drag_limit(void) {
  CliResult result = CLI("fit", cli.valve, "--seal", "outer", "--drag", "-limit", "--json", "-");
  g_assert_cmpint(result.code, ==, 0);
  JsonNode *root = cli_parse(result.out);
  g_assert_cmpstr(json_node_get_string(cli_at(root, "state")), ==, "rolls");
  g_assert_cmpfloat(fabs(cli_number(root, "drag_limit") / 0.470 - 1), <, 4e-2);
  g_assert_cmpfloat(cli_number(root, "drag_N"), <, 0);
  json_node_unref(root);
  cli_clear(&result);
}

// Of a state that was not found there are no figures, but reasons.
static void test_json_not_found(void) {
  static const char *const none[] = {"load_N", "pressure_peak_Pa", "contact_width_m", "drag_N",
                                     "state"};
  const SbFit fit = {.model = SB_FIT_RING, .squeeze = 0.15};
  const SbFitProblem problem = {.model = SB_FIT_RING, .dragged = true};
  const SbRubberState storage = {0};
  char *text = sb_results_fit(&fit, &problem, false, "outer", NULL, &storage, "-");
  JsonNode *root = cli_parse(text);
  g_assert_cmpfloat(cli_number(root, "squeeze"), ==, 0.15);
  for (size_t i = 0; i < G_N_ELEMENTS(none); i++) {
    g_autofree char *reason = g_strdup_printf("reasons.%s", none[i]);
    g_assert_true(json_node_is_null(cli_at(root, none[i])));
    g_assert_cmpstr(json_node_get_string(cli_at(root, reason)), ==,
                    "the solver found no such state");
  }
  g_assert_true(json_node_is_null(cli_at(root, "solver.error_estimate.load")));
  g_assert_true(json_node_is_null(cli_at(root, "ring.floor_load_N")));
  json_node_unref(root);
  g_free(text);
}

static void test_json_small(void) {
  CliResult result = CLI("asperity", "--lambda", "-3", "--json", "-");
  JsonNode *root = cli_parse(result.out);
  g_assert_cmpfloat(fabs(cli_number(root, "F2") / 9.99979656491951 - 1), <, 1e-12);
  cli_has_keys(root, "lambda F5_2");
  json_node_unref(root);
  cli_clear(&result);

  result = CLI("list", "params", "--json", "-");
  root = cli_parse(result.out);
  JsonArray *rows = json_node_get_array(root);
  bool found = false;
  for (guint i = 0; i < json_array_get_length(rows); i++) {
    JsonNode *row = json_array_get_element(rows, i);
    cli_has_keys(row, "key symbol unit min max default help source tag");
    if (strcmp(json_node_get_string(cli_at(row, "key")), "seal.section_diameter") == 0) {
      found = true;
      g_assert_cmpfloat(cli_number(row, "default"), ==, 1.61e-3);
      g_assert_cmpstr(json_node_get_string(cli_at(row, "unit")), ==, "m");
    }
  }
  g_assert_true(found);
  json_node_unref(root);
  cli_clear(&result);
  static const char *const lists[] = {"models", "views"};
  for (size_t i = 0; i < G_N_ELEMENTS(lists); i++) {
    result = CLI("list", lists[i], "--json", "-");
    root = cli_parse(result.out);
    cli_has_keys(root, "0.name");
    json_node_unref(root);
    cli_clear(&result);
  }
}

// Options pass as bytes: a micro sign works in every locale.
static void test_utf8_options(void) {
  static const char *const locales[] = {"C", "C.UTF-8", "de_DE.UTF-8"};
  for (size_t i = 0; i < G_N_ELEMENTS(locales); i++) {
    char **environment = g_get_environ();
    environment = g_environ_setenv(environment, "LC_ALL", locales[i], TRUE);
    const char *const arguments[] = {
        "run", cli.scene, "--quiet", "--json", "-", "--set", "surface.sigma=2 \xc2\xb5m", NULL};
    CliResult result = cli_run(arguments, environment, NULL);
    g_assert_cmpstr(result.err, ==, "");
    g_assert_cmpint(result.code, ==, 0);
    JsonNode *root = cli_parse(result.out);
    double ratio =
        cli_number(root, "seals.outer.film_central_m") / cli_number(root, "seals.outer.lambda");
    g_assert_cmpfloat(fabs(ratio - 2e-6), <, 1e-15);
    json_node_unref(root);
    cli_clear(&result);
    g_strfreev(environment);
  }
}

// ---- Files ----

// `text` without the lines that hold a time.
static char *without_times(const char *text) {
  GRegex *regex = g_regex_new("\"wall_s\".*", 0, 0, NULL);
  char *plain = g_regex_replace_literal(regex, text, -1, 0, "", 0, NULL);
  g_regex_unref(regex);
  return plain;
}

// Column of a heading, which must be there.
static int column_of(char **names, const char *name) {
  int at = 0;
  while (names[at] != NULL && strcmp(names[at], name) != 0) {
    at++;
  }
  g_assert_nonnull(names[at]);
  return at;
}

// Boundary and viscous friction add up in every frame, and both are there while it slides.
static void check_split(const char *csv) {
  g_auto(GStrv) lines = g_strsplit(csv, "\n", -1);
  g_auto(GStrv) names = g_strsplit(lines[0], ",", -1);
  static const char *const seals[] = {"inner", "outer"};
  for (int seal = 0; seal < 2; seal++) {
    int column[3];
    static const char *const parts[] = {"friction", "friction_boundary", "friction_viscous"};
    for (int i = 0; i < 3; i++) {
      g_autofree char *name = g_strdup_printf("%s_%s [N]", parts[i], seals[seal]);
      column[i] = column_of(names, name);
    }
    int viscous = 0;
    for (int k = 1; lines[k] != NULL && *lines[k] != '\0'; k++) {
      g_auto(GStrv) cells = g_strsplit(lines[k], ",", -1);
      double value[3];
      for (int i = 0; i < 3; i++) {
        value[i] = g_ascii_strtod(cells[column[i]], NULL);
      }
      g_assert_cmpfloat_with_epsilon(value[0], value[1] + value[2], 1e-12 + 1e-12 * fabs(value[0]));
      viscous += fabs(value[2]) > 0;
    }
    g_assert_cmpint(viscous, >, 10);
  }
}

static void test_results_and_locale(void) {
  char *plain = g_build_filename(cli.folder, "plain", NULL);
  char *german = g_build_filename(cli.folder, "deep", "er", NULL);
  char *up = g_build_filename(cli.folder, "deep", NULL);
  CliResult result = CLI("run", cli.scene, "-o", plain);
  g_assert_cmpint(result.code, ==, 0);
  g_assert_cmpstr(result.err, ==, "");
  cli_clear(&result);
  char **environment = g_get_environ();
  environment = g_environ_setenv(environment, "LC_ALL", "de_DE.UTF-8", TRUE);
  const char *const arguments[] = {"run", cli.scene, "-o", german, "--quiet", NULL};
  result = cli_run(arguments, environment, NULL);
  g_assert_cmpint(result.code, ==, 0);
  g_assert_cmpstr(result.out, ==, "");
  cli_clear(&result);
  g_strfreev(environment);

  static const char *const tables[] = {"cycle.csv", "profiles.csv"};
  for (size_t i = 0; i < G_N_ELEMENTS(tables); i++) {
    char *one = cli_contents(plain, tables[i]);
    char *two = cli_contents(german, tables[i]);
    g_assert_cmpstr(one, ==, two);
    g_assert_nonnull(strchr(one, '.'));
    g_free(one);
    g_free(two);
  }
  char *one = cli_contents(plain, "results.json");
  char *two = cli_contents(german, "results.json");
  char *one_plain = without_times(one);
  char *two_plain = without_times(two);
  g_assert_cmpstr(one_plain, ==, two_plain);
  g_free(one);
  g_free(two);
  g_free(one_plain);
  g_free(two_plain);

  char *csv = cli_contents(plain, "cycle.csv");
  g_assert_true(g_str_has_prefix(csv, "time [s],displacement [m],velocity [m/s],force [N],"
                                      "pressure_force [N],friction_inner [N],"
                                      "friction_outer [N],"));
  check_split(csv);
  g_free(csv);
  cli_remove_results(plain);
  cli_remove_results(german);
  g_rmdir(up);
  g_free(up);
  g_free(plain);
  g_free(german);
}

static void test_io_errors(void) {
  CliResult result = CLI("run", cli.scene, "--quiet", "-o", "/proc/none");
  g_assert_cmpint(result.code, ==, 3);
  cli_clear(&result);
  char *below = g_build_filename(cli.scene, "x", NULL);
  result = CLI("run", cli.scene, "--quiet", "-o", below);
  g_assert_cmpint(result.code, ==, 3);
  g_assert_nonnull(strstr(result.err, "Not a directory"));
  cli_clear(&result);
  g_free(below);
  result = CLI("asperity", "--lambda", "1", "--json", "/no/such/file.json");
  g_assert_cmpint(result.code, ==, 3);
  cli_clear(&result);
  result = CLI("run", cli.scene, "--quiet", "--json", "/dev/full");
  g_assert_cmpint(result.code, ==, 3);
  g_assert_nonnull(strstr(result.err, "No space left on device"));
  cli_clear(&result);

  // A full disk leaves nothing behind.
  char *out = g_build_filename(cli.folder, "full", NULL);
  const char *const arguments[] = {"run", cli.scene, "--quiet", "-o", out, NULL};
  result = cli_run(arguments, NULL, limit_files);
  g_assert_cmpint(result.code, ==, 3);
  g_assert_nonnull(strstr(result.err, "results.json: File too large"));
  cli_clear(&result);
  g_assert_cmpint(g_rmdir(out), ==, 0);
  g_free(out);
}

static void limit_stack(gpointer data) {
  struct rlimit limit = {256 << 10, 256 << 10};
  setrlimit(RLIMIT_STACK, &limit);
}

// Nothing needs more of a stack than a quarter of a megabyte: no large buffer lies there.
static void test_small_stack(void) {
  if (SB_SANITIZED) {
    return; // whose frames are larger
  }
  const char *const run[] = {"run", cli.scene, "--quiet", NULL};
  const char *const fit[] = {"fit", cli.valve, "--seal", "outer", "--quiet", NULL};
  const char *const *const all[] = {run, fit};
  for (size_t i = 0; i < G_N_ELEMENTS(all); i++) {
    CliResult result = cli_run(all[i], NULL, limit_stack);
    g_assert_cmpint(result.code, ==, 0);
    cli_clear(&result);
  }
}

int main(int argc, char **argv) {
  g_test_init(&argc, &argv, NULL);
  cli_set_up();
  g_test_add_func("/cli/usage", test_usage);
  g_test_add_func("/cli/bad-input", test_bad_input);
  g_test_add_func("/cli/json/run", test_json_run);
  if (g_test_slow()) {
    g_test_add_func("/cli/json/plan", test_plan_matches);
  }
  g_test_add_func("/cli/json/fit", test_json_fit);
  g_test_add_func("/cli/json/drag-limit", test_json_drag_limit);
  g_test_add_func("/cli/json/not-found", test_json_not_found);
  g_test_add_func("/cli/json/small", test_json_small);
  g_test_add_func("/cli/utf8-options", test_utf8_options);
  g_test_add_func("/cli/results-and-locale", test_results_and_locale);
  g_test_add_func("/cli/io-errors", test_io_errors);
  g_test_add_func("/cli/small-stack", test_small_stack);
  int result = g_test_run();
  cli_tear_down();
  return result;
}
