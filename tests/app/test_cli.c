// The program from outside: exit codes, messages, JSON keys, interrupts, full disks, locales.
#include <gio/gio.h>
#include <glib/gstdio.h>
#include <json-glib/json-glib.h>
#include <math.h>
#include <signal.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mount.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

static const char *program;
static char *valve;
static char *scene;
static char *folder;

typedef struct {
  int code; // 128 + signal if it was killed
  char *out, *err;
} Result;

static void clear(Result *result) {
  g_free(result->out);
  g_free(result->err);
}

static void limit_files(gpointer data) {
  // Writing beyond a kilobyte fails as on a full disk.
  struct rlimit limit = {1000, 1000};
  setrlimit(RLIMIT_FSIZE, &limit);
  signal(SIGXFSZ, SIG_IGN);
}

static Result run_with(const char *const *arguments, char **environment,
                       GSpawnChildSetupFunc setup) {
  GPtrArray *argv = g_ptr_array_new();
  g_ptr_array_add(argv, (gpointer)program);
  for (const char *const *a = arguments; *a != NULL; a++) {
    g_ptr_array_add(argv, (gpointer)*a);
  }
  g_ptr_array_add(argv, NULL);
  Result result = {0};
  int status = 0;
  GError *error = NULL;
  g_spawn_sync(NULL, (char **)argv->pdata, environment, 0, setup, NULL, &result.out, &result.err,
               &status, &error);
  g_assert_no_error(error);
  result.code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  g_ptr_array_unref(argv);
  return result;
}

#define RUN(...) run_with((const char *const[]){__VA_ARGS__, NULL}, NULL, NULL)

static JsonNode *parse(const char *text) {
  GError *error = NULL;
  JsonNode *node = json_from_string(text, &error);
  g_assert_no_error(error);
  g_assert_false(g_regex_match_simple("[:,\\[] *-?(nan|inf)", text, G_REGEX_CASELESS, 0));
  return node;
}

// The node at "a.b.c" (numbers index arrays); fails if there is none.
static JsonNode *at(JsonNode *node, const char *path) {
  char **parts = g_strsplit(path, ".", -1);
  for (char **part = parts; *part != NULL && node != NULL; part++) {
    if (JSON_NODE_HOLDS_ARRAY(node)) {
      node = json_array_get_element(json_node_get_array(node), (guint)atoi(*part));
    } else {
      node = json_object_get_member(json_node_get_object(node), *part);
    }
  }
  if (node == NULL) {
    g_error("no key %s", path);
  }
  g_strfreev(parts);
  return node;
}

static double number(JsonNode *root, const char *path) {
  return json_node_get_double(at(root, path));
}

static void has_keys(JsonNode *root, const char *keys) {
  char **list = g_strsplit(keys, " ", -1);
  for (char **key = list; *key != NULL; key++) {
    at(root, *key);
  }
  g_strfreev(list);
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
      {{"run"}, 1, "sealbench: something is missing: usage: sealbench run FILE.scene"},
      {{"run", "a", "b"}, 1, "too many operands"},
      {{"run", "--frob", "a"}, 1, "Unknown option --frob"},
      {{"run", "/no/such.scene"}, 1, "sealbench: /no/such.scene: No such file or directory\n"},
      {{"check", "/"}, 1, "sealbench: /: is a folder, not a file\n"},
      {{"check", "/dev/zero"}, 1, "is not a regular file\n"},
      {{"list", "colours"}, 1, "allowed params, models, views"},
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
    Result result = run_with(cases[i].arguments, NULL, NULL);
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
    clear(&result);
  }
}

static void test_bad_input(void) {
  char *out = g_build_filename(folder, "none", NULL);
  Result result = RUN("run", scene, "-o", out, "--set", "seal.modulus=3", "--set", "bore.x=1 mm");
  g_assert_cmpint(result.code, ==, 1);
  g_assert_cmpstr(result.err, ==,
                  "sealbench: --set: [seal] modulus: \"3\" has no unit, write for example \"3 "
                  "MPa\" (allowed 0.1 to 10000 MPa)\n"
                  "sealbench: --set: [bore] x: unknown key\n");
  clear(&result);
  result = RUN("run", scene, "-o", out, "--set", "bore.diameter=5 mm");
  g_assert_cmpint(result.code, ==, 1);
  g_assert_nonnull(strstr(result.err, "[bore] diameter: the bore is smaller than the stem"));
  clear(&result);
  g_assert_false(g_file_test(out, G_FILE_TEST_EXISTS));
  result = RUN("fit", valve, "--seal", "middle");
  g_assert_cmpint(result.code, ==, 1);
  clear(&result);
  result = RUN("fit", valve, "--seal", "outer", "--model", "sponge");
  g_assert_cmpint(result.code, ==, 1);
  g_assert_nonnull(strstr(result.err, "karaszkiewicz"));
  clear(&result);
  g_free(out);
}

// ---- JSON ----

static void test_json_run(void) {
  Result result = RUN("run", scene, "--json", "-", "--quiet");
  g_assert_cmpint(result.code, ==, 0);
  g_assert_cmpstr(result.err, ==, "");
  JsonNode *root = parse(result.out);
  has_keys(root, "scene version parameters_sha256 models.fit models.film models.surface "
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
      g_assert_true(isfinite(number(root, key)));
      g_free(key);
    }
    g_free(path);
  }
  static const char *const seals[] = {"outer", "inner"};
  for (size_t i = 0; i < G_N_ELEMENTS(seals); i++) {
    JsonNode *seal = at(at(root, "seals"), seals[i]);
    has_keys(seal, "contact_width_m load_N pressure_peak_Pa film_min_m film_central_m "
                   "film_by_model.karaszkiewicz film_by_model.thesis film_by_model.reynolds "
                   "lambda friction_boundary_N friction_viscous_N friction_static_N "
                   "coefficient_of_friction leakage_per_stroke_m3 leakage_static_m3_per_s");
  }
  has_keys(at(root, "warnings.0"), "code text parameter");
  g_assert_cmpfloat(number(root, "cycle.force_breakaway_N"), >, 24.5);
  g_assert_cmpfloat(number(root, "cycle.force_breakaway_N"), <, 30.5);
  g_assert_cmpfloat(number(root, "cycle.force_return_min_N"), >, 1.0);
  g_assert_cmpfloat(number(root, "cycle.force_return_min_N"), <, 2.2);
  g_assert_cmpfloat(number(root, "cycle.energy_closure"), <=, 1e-6);
  g_assert_cmpuint(strlen(json_node_get_string(at(root, "parameters_sha256"))), ==, 64);
  json_node_unref(root);
  clear(&result);

  // +30 % roughness: the sign of the return force.
  result = RUN("run", scene, "--json", "-", "--quiet", "--set", "surface.gt_product=0.16757");
  root = parse(result.out);
  g_assert_cmpfloat(number(root, "cycle.force_return_min_N"), <, 0);
  g_assert_false(json_node_get_boolean(at(root, "cycle.returns")));
  json_node_unref(root);
  clear(&result);
}

// Plan and counters tell the same for every shipped scene.
static void test_plan_matches(void) {
  char *scenes = g_path_get_dirname(scene);
  GDir *dir = g_dir_open(scenes, 0, NULL);
  const char *name;
  while ((name = g_dir_read_name(dir)) != NULL) {
    char *path = g_build_filename(scenes, name, NULL);
    Result plan = RUN("plan", path, "--json", "-");
    Result run = RUN("run", path, "--json", "-", "--quiet");
    g_assert_cmpint(plan.code, ==, 0);
    g_assert_cmpint(run.code, ==, 0);
    JsonNode *plan_root = parse(plan.out);
    JsonNode *run_root = parse(run.out);
    bool reynolds = false;
    bool ring = false;
    bool profiles = false;
    bool interior = false;
    JsonArray *fields = json_node_get_array(at(plan_root, "fields"));
    for (guint i = 0; i < json_array_get_length(fields); i++) {
      JsonNode *field = json_array_get_element(fields, i);
      has_keys(field, "name model reason cost_s error");
      const char *model = json_node_get_string(at(field, "model"));
      const char *what = json_node_get_string(at(field, "name"));
      reynolds |= strcmp(model, "reynolds") == 0;
      ring |= strcmp(model, "ring") == 0;
      profiles |= strstr(what, "profile") != NULL;
      interior |= strstr(what, "interior") != NULL;
    }
    // A scene that shows everything skips nothing.
    if (json_array_get_length(json_node_get_array(at(plan_root, "skipped"))) > 0) {
      has_keys(plan_root, "skipped.0.name skipped.0.reason");
    }
    JsonNode *counters = at(run_root, "solver.counters");
    g_assert_cmpint(number(counters, "reynolds_solves") > 0, ==, reynolds);
    g_assert_cmpint(number(counters, "ring_solves") > 0, ==, ring);
    g_assert_cmpint(number(counters, "profile_evaluations") > 0, ==, profiles);
    g_assert_cmpint(number(counters, "field_evaluations") > 0, ==, interior);
    json_node_unref(plan_root);
    json_node_unref(run_root);
    clear(&plan);
    clear(&run);
    g_free(path);
  }
  g_dir_close(dir);
  g_free(scenes);
}

static void test_json_fit(void) {
  Result result = RUN("fit", valve, "--seal", "outer", "--model", "karaszkiewicz", "--json", "-");
  g_assert_cmpint(result.code, ==, 0);
  g_assert_cmpstr(result.err, ==, "");
  JsonNode *root = parse(result.out);
  has_keys(root, "model seal squeeze stretch_mean stretch_inner section_diameter_fitted_m "
                 "interference_m gland_fill circumference_m contact_width_m contact_left_m "
                 "contact_right_m load_N load_N_per_m pressure_peak_Pa valid warnings "
                 "solver.converged solver.unknowns solver.newton_iterations "
                 "solver.error_estimate.load solver.error_estimate.pressure_peak "
                 "solver.error_estimate.contact_width solver.wall_s profile.x_m "
                 "profile.pressure_Pa");
  g_assert_cmpfloat(fabs(number(root, "stretch_mean") - 0.0427), <, 5e-5);
  g_assert_cmpfloat(fabs(number(root, "circumference_m") - 13.98e-3), <, 5e-6);
  // Thesis, unpressurised: 0.7093 mm and 5.719 N.
  g_assert_cmpfloat(fabs(number(root, "contact_width_m") - 0.7093e-3), <, 1e-7);
  g_assert_cmpfloat(fabs(number(root, "load_N") - 5.719), <, 1e-3);
  json_node_unref(root);
  clear(&result);

  // A ring that does not touch is valid, with no load and a warning.
  result =
      RUN("fit", valve, "--seal", "inner", "--json", "-", "--set", "gland.radial_space=1.9 mm");
  g_assert_cmpint(result.code, ==, 0);
  root = parse(result.out);
  g_assert_cmpfloat(number(root, "load_N"), ==, 0);
  has_keys(at(root, "warnings.0"), "code text parameter");
  json_node_unref(root);
  clear(&result);
}

static void test_json_film(void) {
  Result result =
      RUN("film", "--load", "850.2N/m", "--speed", "20 mm/min", "--radius", "0.805mm", "--modulus",
          "6.5725MPa", "--viscosity", "0.211mPa.s", "--model", "thesis", "--json", "-");
  g_assert_cmpint(result.code, ==, 0);
  JsonNode *root = parse(result.out);
  has_keys(root, "model film_min_m film_central_m film_flux_m pressure_max_Pa "
                 "position_film_min_m position_rupture_m hertz_half_width_m hertz_pressure_Pa "
                 "friction_couette_N_per_m friction_poiseuille_N_per_m moes_M regime valid "
                 "warnings solver.converged solver.unknowns solver.newton_iterations "
                 "solver.continuation_steps solver.residual solver.error_estimate.film_min "
                 "solver.error_estimate.film_central solver.wall_s profile.x_m "
                 "profile.pressure_Pa profile.film_m");
  g_assert_cmpfloat(fabs(number(root, "film_central_m") - 1.720e-9), <, 5e-13);
  g_assert_cmpuint(json_array_get_length(json_node_get_array(at(root, "profile.x_m"))), >=, 400);
  json_node_unref(root);
  clear(&result);
  result =
      RUN("film", "--load", "850.2N/m", "--speed", "20 mm/min", "--radius", "0.805mm", "--modulus",
          "6.5725MPa", "--viscosity", "0.211mPa.s", "--model", "karaszkiewicz", "--json", "-");
  root = parse(result.out);
  g_assert_cmpfloat(fabs(number(root, "film_central_m") - 0.282e-9), <, 5e-13);
  json_node_unref(root);
  clear(&result);
}

static void test_film_options(void) {
#define CONTACT                                                                                    \
  "film", "--load", "850.2N/m", "--speed", "1 m/s", "--radius", "0.805mm", "--modulus",            \
      "6.5725MPa", "--viscosity", "0.211mPa.s"
  Result flooded = RUN(CONTACT, "--json", "-");
  Result starved = RUN(CONTACT, "--json", "-", "--inlet-film", "20 nm");
  g_assert_cmpint(flooded.code, ==, 0);
  g_assert_cmpint(starved.code, ==, 0);
  JsonNode *one = parse(flooded.out);
  JsonNode *two = parse(starved.out);
  g_assert_false(json_node_get_boolean(at(one, "starved")));
  g_assert_true(json_node_get_boolean(at(two, "starved")));
  g_assert_cmpfloat(number(two, "film_central_m"), <, number(one, "film_central_m"));
  json_node_unref(one);
  json_node_unref(two);
  clear(&flooded);
  clear(&starved);

  // End pressures that all but open the contact: solved, or said with no figures but the problem's.
  Result open = RUN(CONTACT, "--pressure-left", "3.2 MPa", "--json", "-");
  one = parse(open.out);
  if (open.code == 0) {
    g_assert_cmpfloat(number(one, "film_min_m"), >, 0.0);
  } else {
    g_assert_cmpint(open.code, ==, 2);
    g_assert_true(json_node_is_null(at(one, "film_min_m")));
    g_assert_true(json_node_is_null(at(one, "solver.error_estimate.film_min")));
    g_assert_false(json_node_get_boolean(at(one, "valid")));
    g_assert_cmpfloat(number(one, "hertz_pressure_Pa"), >, 0.0);
  }
  json_node_unref(one);
  clear(&open);

  // The inverse model reads its table; a table that is none gives one line.
  char *path = g_build_filename(folder, "dry.csv", NULL);
  GString *table = g_string_new("x,p\n# smooth\n");
  for (int i = -40; i <= 40; i++) {
    double X = i / 40.0;
    char x[G_ASCII_DTOSTR_BUF_SIZE];
    char p[G_ASCII_DTOSTR_BUF_SIZE];
    g_ascii_dtostr(x, sizeof x, 0.5e-3 * X);
    g_ascii_dtostr(p, sizeof p, 1e6 * (1 - X * X) * (1 - X * X));
    g_string_append_printf(table, "%s,%s\n", x, p);
  }
  g_assert_true(g_file_set_contents(path, table->str, -1, NULL));
  g_string_free(table, TRUE);
  Result result = RUN(CONTACT, "--json", "-", "--model", "inverse", "--dry-pressure", path);
  g_assert_cmpstr(result.err, ==, "");
  g_assert_cmpint(result.code, ==, 0);
  clear(&result);
  static const char *const bad[] = {
      "",        "x,p\n0,1\n", "0,1\n0,2\n1,1\n", "0 1\n1 nan\n2 3\n", "0,1,2\n1,2,3\n2,3,4\n",
      "\xff\xfe"};
  for (size_t i = 0; i < G_N_ELEMENTS(bad); i++) {
    g_assert_true(g_file_set_contents(path, bad[i], -1, NULL));
    result = RUN(CONTACT, "--model", "inverse", "--dry-pressure", path);
    g_assert_cmpint(result.code, ==, 1);
    g_assert_true(g_str_has_prefix(result.err, "sealbench: "));
    clear(&result);
  }
  result = RUN(CONTACT, "--model", "inverse");
  g_assert_cmpint(result.code, ==, 1);
  clear(&result);
  result = RUN(CONTACT, "--model", "wet");
  g_assert_nonnull(strstr(result.err, "moes"));
  clear(&result);
  g_unlink(path);
  g_free(path);
}

static void test_json_small(void) {
  Result result = RUN("asperity", "--lambda", "-3", "--json", "-");
  JsonNode *root = parse(result.out);
  g_assert_cmpfloat(fabs(number(root, "F2") / 9.99979656491951 - 1), <, 1e-12);
  has_keys(root, "lambda F5_2");
  json_node_unref(root);
  clear(&result);

  result = RUN("list", "params", "--json", "-");
  root = parse(result.out);
  JsonArray *rows = json_node_get_array(root);
  bool found = false;
  for (guint i = 0; i < json_array_get_length(rows); i++) {
    JsonNode *row = json_array_get_element(rows, i);
    has_keys(row, "key symbol unit min max default help source tag");
    if (strcmp(json_node_get_string(at(row, "key")), "seal.section_diameter") == 0) {
      found = true;
      g_assert_cmpfloat(number(row, "default"), ==, 1.61e-3);
      g_assert_cmpstr(json_node_get_string(at(row, "unit")), ==, "m");
    }
  }
  g_assert_true(found);
  json_node_unref(root);
  clear(&result);
  static const char *const lists[] = {"models", "views"};
  for (size_t i = 0; i < G_N_ELEMENTS(lists); i++) {
    result = RUN("list", lists[i], "--json", "-");
    root = parse(result.out);
    has_keys(root, "0.name");
    json_node_unref(root);
    clear(&result);
  }
}

static void test_json_bench(void) {
  Result result = RUN("bench", "--quick", "--json", "-");
  g_assert_cmpstr(result.err, ==, "");
  g_assert_cmpint(result.code, ==, 0);
  JsonNode *root = parse(result.out);
  JsonArray *cases = json_node_get_array(at(root, "cases"));
  g_assert_cmpuint(json_array_get_length(cases), >, 10);
  for (guint i = 0; i < json_array_get_length(cases); i++) {
    JsonNode *row = json_array_get_element(cases, i);
    has_keys(row, "solver case unknowns iterations wall_s error error_estimate order");
    // Solved films keep what their tolerance promised, against independent figures.
    if (strcmp(json_node_get_string(at(row, "solver")), "reynolds") == 0) {
      g_assert_cmpfloat(number(row, "error"), <, 1e-3);
    }
  }
  json_node_unref(root);
  clear(&result);
}

// Options pass as bytes: a micro sign works in every locale.
static void test_utf8_options(void) {
  static const char *const locales[] = {"C", "C.UTF-8", "de_DE.UTF-8"};
  for (size_t i = 0; i < G_N_ELEMENTS(locales); i++) {
    char **environment = g_get_environ();
    environment = g_environ_setenv(environment, "LC_ALL", locales[i], TRUE);
    const char *const arguments[] = {
        "run", scene, "--quiet", "--json", "-", "--set", "surface.sigma=2 \xc2\xb5m", NULL};
    Result result = run_with(arguments, environment, NULL);
    g_assert_cmpstr(result.err, ==, "");
    g_assert_cmpint(result.code, ==, 0);
    JsonNode *root = parse(result.out);
    double ratio = number(root, "seals.outer.film_central_m") / number(root, "seals.outer.lambda");
    g_assert_cmpfloat(fabs(ratio - 2e-6), <, 1e-15);
    json_node_unref(root);
    clear(&result);
    g_strfreev(environment);
  }
}

// ---- Files ----

static char *contents(const char *where, const char *name) {
  char *path = g_build_filename(where, name, NULL);
  char *text = NULL;
  GError *error = NULL;
  g_file_get_contents(path, &text, NULL, &error);
  g_assert_no_error(error);
  g_free(path);
  return text;
}

static void remove_results(const char *where) {
  static const char *const names[] = {"results.json", "cycle.csv", "profiles.csv"};
  for (size_t i = 0; i < G_N_ELEMENTS(names); i++) {
    char *path = g_build_filename(where, names[i], NULL);
    g_unlink(path);
    g_free(path);
  }
  g_assert_cmpint(g_rmdir(where), ==, 0); // fails if anything else was left
}

// `text` without the lines that hold a time.
static char *without_times(const char *text) {
  GRegex *regex = g_regex_new("\"wall_s\".*", 0, 0, NULL);
  char *plain = g_regex_replace_literal(regex, text, -1, 0, "", 0, NULL);
  g_regex_unref(regex);
  return plain;
}

static void test_results_and_locale(void) {
  char *plain = g_build_filename(folder, "plain", NULL);
  char *german = g_build_filename(folder, "deep", "er", NULL);
  char *up = g_build_filename(folder, "deep", NULL);
  Result result = RUN("run", scene, "-o", plain);
  g_assert_cmpint(result.code, ==, 0);
  g_assert_nonnull(strstr(result.err, "sealbench: 10 %\n"));
  g_assert_nonnull(strstr(result.err, "sealbench: 100 %\n"));
  clear(&result);
  char **environment = g_get_environ();
  environment = g_environ_setenv(environment, "LC_ALL", "de_DE.UTF-8", TRUE);
  const char *const arguments[] = {"run", scene, "-o", german, "--quiet", NULL};
  result = run_with(arguments, environment, NULL);
  g_assert_cmpint(result.code, ==, 0);
  g_assert_cmpstr(result.out, ==, "");
  clear(&result);
  g_strfreev(environment);

  static const char *const tables[] = {"cycle.csv", "profiles.csv"};
  for (size_t i = 0; i < G_N_ELEMENTS(tables); i++) {
    char *one = contents(plain, tables[i]);
    char *two = contents(german, tables[i]);
    g_assert_cmpstr(one, ==, two);
    g_assert_nonnull(strchr(one, '.'));
    g_free(one);
    g_free(two);
  }
  char *one = contents(plain, "results.json");
  char *two = contents(german, "results.json");
  char *one_plain = without_times(one);
  char *two_plain = without_times(two);
  g_assert_cmpstr(one_plain, ==, two_plain);
  g_free(one);
  g_free(two);
  g_free(one_plain);
  g_free(two_plain);

  char *csv = contents(plain, "cycle.csv");
  g_assert_true(g_str_has_prefix(csv, "time [s],displacement [m],velocity [m/s],force [N],"
                                      "pressure_force [N],friction_inner [N],"
                                      "friction_outer [N],"));
  g_free(csv);
  remove_results(plain);
  remove_results(german);
  g_rmdir(up);
  g_free(up);
  g_free(plain);
  g_free(german);
}

static void test_io_errors(void) {
  Result result = RUN("run", scene, "--quiet", "-o", "/proc/none");
  g_assert_cmpint(result.code, ==, 3);
  clear(&result);
  char *below = g_build_filename(scene, "x", NULL);
  result = RUN("run", scene, "--quiet", "-o", below);
  g_assert_cmpint(result.code, ==, 3);
  g_assert_nonnull(strstr(result.err, "Not a directory"));
  clear(&result);
  g_free(below);
  result = RUN("asperity", "--lambda", "1", "--json", "/no/such/file.json");
  g_assert_cmpint(result.code, ==, 3);
  clear(&result);
  result = RUN("run", scene, "--quiet", "--json", "/dev/full");
  g_assert_cmpint(result.code, ==, 3);
  g_assert_nonnull(strstr(result.err, "No space left on device"));
  clear(&result);

  // A full disk leaves nothing behind.
  char *out = g_build_filename(folder, "full", NULL);
  const char *const arguments[] = {"run", scene, "--quiet", "-o", out, NULL};
  result = run_with(arguments, NULL, limit_files);
  g_assert_cmpint(result.code, ==, 3);
  g_assert_nonnull(strstr(result.err, "results.json: File too large"));
  clear(&result);
  g_assert_cmpint(g_rmdir(out), ==, 0);
  g_free(out);
}

static void test_render(void) {
  static const struct {
    const char *view, *ending, *magic;
  } cases[] = {
      {"hysteresis", "png", "\x89PNG"}, {"hysteresis", "svg", "<?xml"},
      {"profiles", "pdf", "%PDF"},      {"section", "png", "\x89PNG"},
      {"section", "svg", "<?xml"},      {"dashboard", "png", "\x89PNG"},
  };
  for (size_t i = 0; i < G_N_ELEMENTS(cases); i++) {
    char *name = g_strdup_printf("picture.%s", cases[i].ending);
    char *path = g_build_filename(folder, name, NULL);
    Result result = RUN("render", scene, "-o", path, "--view", cases[i].view, "--quiet", "--size",
                        "640x400", "--at", "C");
    g_assert_cmpstr(result.err, ==, "");
    g_assert_cmpint(result.code, ==, 0);
    char *picture = contents(folder, name);
    g_assert_true(strncmp(picture, cases[i].magic, 4) == 0);
    clear(&result);
    g_free(picture);
    g_unlink(path);
    g_free(path);
    g_free(name);
  }
  static const struct {
    const char *arguments[8];
    int code;
  } bad[] = {
      {{"-o", "x.gif"}, 1},
      {{"-o", "x.png", "--view", "clouds"}, 1},
      {{"-o", "x.png", "--size", "12"}, 1},
      {{"-o", "x.png", "--size", "1x1"}, 1},
      {{"-o", "x.png", "--at", "Q"}, 1},
      {{"-o", "x.png", "--at", "900 s"}, 1},
      {{"-o", "x.png", "--fps", "30"}, 1},
      {{"-o", "x.mp4", "--at", "C"}, 1},
      {{"-o", "x.mp4", "--fps", "0"}, 1},
      {{"-o", "x.mp4", "--duration", "3"}, 1},
      {{"-o", "x.mp4", "--backend", "vulkan"}, 1},
      {{"-o", "x.mp4", "--speed", "0"}, 1},
      {{"-o", "x.mp4", "--speed", "2", "--duration", "3 s"}, 1},
      {{"-o", "x.mp4", "--from", "C", "--to", "B"}, 1},
      {{"-o", "x.mp4", "--from", "Q"}, 1},
      {{"-o", "x.png", "--from", "B"}, 1},
      {{"-o", "x.png", "--size", "8k"}, 1},
      {{"-o", "x.png", "--field", "heat"}, 1},
      {{"-o", "x.png", "--insets", "both"}, 1},
      {{"-o", "x.png", "--zoom", "stem"}, 1},
      {{"-o", "%d/x.png"}, 1},
      {{"--view", "section"}, 1},
      {{"-o", "/no/such/x.mp4"}, 3},
      {{"-o", "/no/such/x.png"}, 3},
  };
  for (size_t i = 0; i < G_N_ELEMENTS(bad); i++) {
    const char *arguments[12] = {"render", scene, "--quiet"};
    for (size_t k = 0; bad[i].arguments[k] != NULL; k++) {
      arguments[k + 3] = bad[i].arguments[k];
    }
    Result result = run_with(arguments, NULL, NULL);
    if (result.code != bad[i].code) {
      g_error("case %zu: exit %d, not %d: %s", i, result.code, bad[i].code, result.err);
    }
    g_assert_cmpstr(result.err, !=, "");
    g_assert_false(g_file_test("x.png", G_FILE_TEST_EXISTS));
    clear(&result);
  }
}

// Starts the program, interrupts it at its first byte of progress that starts with `word`, and
// returns its exit code.
static int interrupted_run(const char *const *argv, const char *word) {
  GPid pid;
  int err = -1;
  GError *error = NULL;
  g_spawn_async_with_pipes(NULL, (char **)argv, NULL,
                           G_SPAWN_DO_NOT_REAP_CHILD | G_SPAWN_STDOUT_TO_DEV_NULL, NULL, NULL, &pid,
                           NULL, NULL, &err, &error);
  g_assert_no_error(error);
  GString *seen = g_string_new(NULL);
  bool sent = false;
  char c;
  while (read(err, &c, 1) == 1) {
    g_string_append_c(seen, c);
    if (!sent && strstr(seen->str, word) != NULL) {
      kill(pid, SIGINT);
      sent = true;
    }
  }
  g_assert_true(sent);
  g_string_free(seen, TRUE);
  close(err);
  int status = 0;
  waitpid(pid, &status, 0);
  g_assert_true(WIFEXITED(status));
  return WEXITSTATUS(status);
}

// Film: whole with its pictures, or partial but under its name after Ctrl-C.
// Studies: pictures without a run, tables and JSON where the scene asks, films refused.
static void test_studies(void) {
  char *picture = g_build_filename(folder, "storage.svg", NULL);
  char *film = g_build_filename(folder, "storage.mp4", NULL);
  char *tables = g_build_filename(folder, "studied", NULL);
  Result result = RUN("render", scene, "-o", film, "--view", "storage");
  g_assert_cmpint(result.code, ==, 1);
  g_assert_nonnull(strstr(result.err, "--view storage is a study, which does not move"));
  clear(&result);
  result = RUN("render", scene, "-o", picture, "--view", "storage", "--at", "C");
  g_assert_cmpint(result.code, ==, 1);
  clear(&result);
  result = RUN("render", scene, "-o", picture, "--view", "storage", "--quiet");
  g_assert_cmpint(result.code, ==, 0);
  g_assert_cmpstr(result.err, ==, "");
  clear(&result);
  char *text = NULL;
  g_assert_true(g_file_get_contents(picture, &text, NULL, NULL));
  g_assert_nonnull(strstr(text, "<svg"));
  g_free(text);
  result = RUN("list", "views");
  g_assert_nonnull(strstr(result.out, "\nstorage "));
  clear(&result);

  // Only what is asked for is computed and planned.
  result = RUN("plan", scene, "--set", "output.studies=storage");
  g_assert_nonnull(strstr(result.out, "study storage"));
  g_assert_null(strstr(result.out, "study squeeze"));
  clear(&result);
  result = RUN("run", scene, "--json", "-", "--quiet");
  JsonNode *root = parse(result.out);
  g_assert_false(json_object_has_member(json_node_get_object(root), "studies"));
  json_node_unref(root);
  clear(&result);
  result =
      RUN("run", scene, "--set", "output.studies=storage", "-o", tables, "--json", "-", "--quiet");
  g_assert_cmpint(result.code, ==, 0);
  root = parse(result.out);
  has_keys(root, "studies.0.name studies.0.x.quantity studies.0.panels.0.series.0.y "
                 "studies.0.table.columns.0.unit studies.0.table.rows.0.values studies.0.warnings");
  g_assert_cmpstr(json_node_get_string(at(root, "studies.0.name")), ==, "storage");
  json_node_unref(root);
  clear(&result);
  static const char *const names[] = {"results.json", "cycle.csv", "profiles.csv",
                                      "study-storage.csv", "study-storage-table.csv"};
  for (size_t i = 0; i < G_N_ELEMENTS(names); i++) {
    char *path = g_build_filename(tables, names[i], NULL);
    g_assert_cmpint(g_remove(path), ==, 0);
    g_free(path);
  }
  g_assert_cmpint(g_rmdir(tables), ==, 0);
  g_assert_cmpint(g_remove(picture), ==, 0);
  g_free(picture);
  g_free(film);
  g_free(tables);
}

static void test_film_file(void) {
  char *path = g_build_filename(folder, "film.mp4", NULL);
  Result result = RUN("render", scene, "-o", path, "--view", "hysteresis", "--quiet", "--size",
                      "320x180", "--fps", "5", "--duration", "1 s");
  g_assert_cmpstr(result.err, ==, "");
  g_assert_cmpint(result.code, ==, 0);
  clear(&result);
  char *bytes = NULL;
  gsize length = 0;
  g_assert_true(g_file_get_contents(path, &bytes, &length, NULL));
  g_assert_cmpuint(length, >, 1000);
  g_assert_cmpint(memcmp(bytes + 4, "ftyp", 4), ==, 0);
  g_free(bytes);
  g_unlink(path);
  const char *const argv[] = {program,      "render", scene,     "-o",         path,   "--view",
                              "hysteresis", "--size", "320x180", "--duration", "20 s", NULL};
  g_assert_cmpint(interrupted_run(argv, "drawing 10"), ==, 130);
  g_assert_true(g_file_get_contents(path, &bytes, &length, NULL));
  g_assert_cmpuint(length, >, 1000);
  g_free(bytes);
  g_unlink(path);
  g_free(path);
}

static gint by_name(gconstpointer a, gconstpointer b) {
  return strcmp(*(char *const *)a, *(char *const *)b);
}

// Names in a folder, sorted, in one line.
static char *listing(const char *path) {
  GPtrArray *names = g_ptr_array_new_with_free_func(g_free);
  GDir *dir = g_dir_open(path, 0, NULL);
  g_assert_nonnull(dir);
  for (const char *name; (name = g_dir_read_name(dir)) != NULL;) {
    g_ptr_array_add(names, g_strdup(name));
  }
  g_dir_close(dir);
  g_ptr_array_sort(names, by_name);
  g_ptr_array_add(names, NULL);
  char *line = g_strjoinv(" ", (char **)names->pdata);
  g_ptr_array_unref(names);
  return line;
}

static void remove_pictures(const char *path) {
  char *line = listing(path);
  char **names = g_strsplit(line, " ", 0);
  for (char **name = names; *name != NULL; name++) {
    char *file = g_build_filename(path, *name, NULL);
    g_unlink(file);
    g_free(file);
  }
  g_strfreev(names);
  g_free(line);
  g_rmdir(path);
}

// A sequence: as many files as range, speed and rate make, each with the scene and its look; a
// folder gets names of its own; Ctrl-C keeps what was finished.
static void test_sequence(void) {
  char *pictures = g_build_filename(folder, "frames", NULL);
  char *pattern = g_build_filename(pictures, "p%03d.png", NULL);
  // B to C lasts 9.9 s of the run: 4.97 s at twice the speed, five pictures at one a second.
  Result result = RUN("render", scene, "-o", pattern, "--quiet", "--size", "320x180", "--fps", "1",
                      "--from", "B", "--to", "C", "--speed", "2", "--field", "shear", "--full");
  g_assert_cmpstr(result.err, ==, "");
  g_assert_cmpint(result.code, ==, 0);
  clear(&result);
  char *names = listing(pictures);
  g_assert_cmpstr(names, ==, "p001.png p002.png p003.png p004.png p005.png");
  g_free(names);
  // Any of them is a scene again, which remembers the look.
  char *third = g_build_filename(pictures, "p003.png", NULL);
  result = RUN("plan", third, "--json", "-");
  g_assert_cmpint(result.code, ==, 0);
  clear(&result);
  char *again = g_build_filename(folder, "again.png", NULL);
  result = RUN("render", third, "-o", again, "--quiet", "--size", "320x180", "--at", "C");
  g_assert_cmpint(result.code, ==, 0);
  clear(&result);
  // That picture holds the scene again, with the options of the first.
  char *restored = g_build_filename(folder, "restored.json", NULL);
  result = RUN("run", again, "--json", restored, "--quiet");
  g_assert_cmpint(result.code, ==, 0);
  clear(&result);
  result = RUN("run", scene, "--json", "-", "--quiet", "--set", "output.field=shear", "--set",
               "output.section=full");
  char *from_picture = contents(folder, "restored.json");
  JsonNode *one = parse(from_picture);
  JsonNode *two = parse(result.out);
  g_assert_cmpstr(json_node_get_string(at(one, "parameters_sha256")), ==,
                  json_node_get_string(at(two, "parameters_sha256")));
  json_node_unref(one);
  json_node_unref(two);
  g_free(from_picture);
  clear(&result);
  g_unlink(restored);
  g_free(restored);
  g_unlink(again);
  g_free(again);
  g_free(third);
  remove_pictures(pictures);

  g_assert_cmpint(g_mkdir(pictures, 0777), ==, 0);
  const char *const argv[] = {program,   "render",     scene,  "-o",    pictures, "--size",
                              "320x180", "--duration", "20 s", "--fps", "30",     NULL};
  g_assert_cmpint(interrupted_run(argv, "drawing 10"), ==, 130);
  names = listing(pictures);
  g_assert_true(g_str_has_prefix(names, "frame-0001.png frame-0002.png "));
  g_assert_null(strstr(names, "frame-0600.png"));
  g_assert_null(strstr(names, "tmp"));
  g_free(names);
  remove_pictures(pictures);
  g_free(pattern);
  g_free(pictures);
}

// A small disk that runs full: exit 3, one line that says so, an earlier file as it was, and of a
// sequence only whole pictures.
static void test_full_disk(void) {
  char *disk = g_build_filename(folder, "disk", NULL);
  g_mkdir(disk, 0700);
  if (mount("none", disk, "tmpfs", 0, "size=192k") != 0) {
    g_test_skip("mounting a tmpfs is not permitted here");
    g_rmdir(disk);
    g_free(disk);
    return;
  }
  char *film = g_build_filename(disk, "film.mp4", NULL);
  g_assert_true(g_file_set_contents(film, "earlier", -1, NULL));
  const char *const outputs[] = {film, disk};
  for (size_t i = 0; i < G_N_ELEMENTS(outputs); i++) {
    Result result = RUN("render", scene, "-o", outputs[i], "--view", "dashboard", "--quiet",
                        "--size", "960x540", "--fps", "10", "--duration", "6 s");
    char *earlier = contents(disk, "film.mp4");
    char *names = listing(disk);
    bool whole = true;
    for (int k = 1; i == 1 && strstr(names, "frame-") != NULL && k < 60; k++) {
      char *name = g_strdup_printf("frame-%04d.png", k);
      if (strstr(names, name) != NULL) {
        char *bytes = NULL;
        gsize length = 0;
        char *path = g_build_filename(disk, name, NULL);
        g_file_get_contents(path, &bytes, &length, NULL);
        whole = whole && length > 20 && memcmp(bytes + length - 8, "IEND", 4) == 0;
        g_free(path);
        g_free(bytes);
      }
      g_free(name);
    }
    if (i == G_N_ELEMENTS(outputs) - 1) {
      umount(disk);
    }
    g_assert_cmpint(result.code, ==, 3);
    g_assert_true(strstr(result.err, "disk is full") != NULL ||
                  strstr(result.err, "No space left") != NULL);
    g_assert_nonnull(strstr(result.err, disk));
    g_assert_cmpstr(strchr(result.err, '\n'), ==, "\n");
    g_assert_cmpstr(earlier, ==, "earlier");
    g_assert_true(whole);
    g_assert_null(strstr(names, "tmp"));
    clear(&result);
    g_free(earlier);
    g_free(names);
  }
  g_rmdir(disk);
  g_free(film);
  g_free(disk);
}

static void test_interrupt(void) {
  char *out = g_build_filename(folder, "part", NULL);
  const char *const argv[] = {program, "run", scene, "-o", out, "--set", "output.frames=1000000",
                              NULL};
  g_assert_cmpint(interrupted_run(argv, "s"), ==, 130);
  char *json = contents(out, "results.json");
  JsonNode *root = parse(json);
  g_assert_true(json_node_get_boolean(at(root, "partial")));
  g_assert_cmpfloat(number(root, "solver.frames"), >, 1000);
  g_assert_cmpfloat(number(root, "solver.frames"), <, 1000000);
  json_node_unref(root);
  g_free(json);
  remove_results(out);
  g_free(out);
}

int main(int argc, char **argv) {
  g_test_init(&argc, &argv, NULL);
  program = g_getenv("SEALBENCH_PROGRAM");
  g_assert_nonnull(program);
  valve = g_build_filename(g_getenv("SEALBENCH_ASSETS"), "valves", "piston.valve", NULL);
  scene = g_build_filename(g_getenv("SEALBENCH_ASSETS"), "scenes", "thesis-cycle.scene", NULL);
  folder = g_dir_make_tmp("sealbench-test-XXXXXX", NULL);
  g_test_add_func("/cli/usage", test_usage);
  g_test_add_func("/cli/bad-input", test_bad_input);
  g_test_add_func("/cli/json/run", test_json_run);
  g_test_add_func("/cli/json/plan", test_plan_matches);
  g_test_add_func("/cli/json/fit", test_json_fit);
  g_test_add_func("/cli/json/film", test_json_film);
  g_test_add_func("/cli/film-options", test_film_options);
  g_test_add_func("/cli/json/small", test_json_small);
  g_test_add_func("/cli/json/bench", test_json_bench);
  g_test_add_func("/cli/utf8-options", test_utf8_options);
  g_test_add_func("/cli/results-and-locale", test_results_and_locale);
  g_test_add_func("/cli/io-errors", test_io_errors);
  g_test_add_func("/cli/render", test_render);
  g_test_add_func("/cli/studies", test_studies);
  g_test_add_func("/cli/film-file", test_film_file);
  g_test_add_func("/cli/sequence", test_sequence);
  g_test_add_func("/cli/full-disk", test_full_disk);
  g_test_add_func("/cli/interrupt", test_interrupt);
  int result = g_test_run();
  g_rmdir(folder);
  g_free(folder);
  g_free(scene);
  g_free(valve);
  return result;
}
