// A scene's [cases]: the verdict takes the worst of the scene and its cases and names it; what is
// wrong in a case is told with file, group, case, key and range.
#include "tests/app/cli_fixture.h"

#include <glib/gstdio.h>
#include <string.h>

static char *path; // of the scene under test

static void write_scene(const char *format, ...) G_GNUC_PRINTF(1, 2);

// The groups behind [sealbench].
static void write_scene(const char *format, ...) {
  va_list arguments;
  va_start(arguments, format);
  g_autofree char *groups = g_strdup_vprintf(format, arguments);
  va_end(arguments);
  g_autofree char *text = g_strdup_printf("[sealbench]\nformat = 1\nkind = scene\nvalve = %s\n"
                                          "[models]\nfit = karaszkiewicz\nfilm = thesis\n%s",
                                          cli.valve, groups);
  g_assert_true(g_file_set_contents(path, text, -1, NULL));
}

static JsonNode *run_json(const char *file, const char *set, const char *more) {
  CliResult run = CLI("run", file, "--json", "-", "--set", set, "--set", more);
  g_assert_cmpstr(run.err, ==, "");
  g_assert_cmpint(run.code, ==, 0);
  JsonNode *root = cli_parse(run.out);
  cli_clear(&run);
  return root;
}

static const char limits[] = "[limits]\ncycle.force_breakaway_N = <= 60 N\n"
                             "seals.outer.squeeze = 5 % .. 25 %\n";

// What is worst is what the case gives when it is run by itself, bit by bit.
static void test_worst(void) {
  const char *none = "output.frames=400";
  write_scene("%s[cases]\nrough = surface.gt_product = +10 %%\n"
              "hot day.2 = canister.pressure=0.9 MPa; fluid.viscosity=-20%%;\n"
              "wide = seal.section_diameter=1.63 mm; gland.radial_space=1.34 mm\n",
              limits);
  JsonNode *all = run_json(path, none, none);
  static const struct {
    const char *kind, *name, *figure, *set[2];
  } worst[] = {
      {"presses",
       "hot day.2",
       "cycle.force_breakaway_N",
       {"canister.pressure=0.9 MPa", "fluid.viscosity=-20%"}},
      {"fits",
       "wide",
       "seals.outer.squeeze",
       {"seal.section_diameter=1.63 mm", "gland.radial_space=1.34 mm"}},
      {"returns",
       "rough",
       "cycle.force_return_margin_N",
       {"surface.gt_product=+10%", "output.frames=400"}},
  };
  for (size_t i = 0; i < G_N_ELEMENTS(worst); i++) {
    g_autofree char *at = g_strdup_printf("cycle.verdict.%s", worst[i].kind);
    JsonNode *verdict = cli_at(all, at);
    g_assert_cmpstr(json_node_get_string(cli_at(verdict, "case")), ==, worst[i].name);
    g_assert_cmpstr(json_node_get_string(cli_at(verdict, "figure")), ==, worst[i].figure);
    CliResult alone = CLI("run", path, "--json", "-", "--set", worst[i].set[0], "--set",
                          worst[i].set[1], "--set", "models.fit=karaszkiewicz");
    JsonNode *one = cli_parse(alone.out);
    g_assert_cmpfloat(cli_number(verdict, "value"), ==, cli_number(one, worst[i].figure));
    json_node_unref(one);
    cli_clear(&alone);
  }
  // A question without a limit has no answer and no case; the figures are the scene's own.
  g_assert_true(JSON_NODE_HOLDS_NULL(cli_at(all, "cycle.verdict.leak.ok")));
  g_assert_true(JSON_NODE_HOLDS_NULL(cli_at(all, "cycle.verdict.leak.case")));
  double wide = cli_number(all, "cycle.verdict.fits.value");
  double own = cli_number(all, "seals.outer.squeeze");
  g_assert_cmpfloat(wide, >, own);
  json_node_unref(all);
  // --set changes what the cases lie upon: -10 % and the case's +10 % return again.
  all = run_json(path, "surface.gt_product=-10 %", "canister.pressure=0.56 MPa");
  g_assert_true(json_node_get_boolean(cli_at(all, "cycle.verdict.returns.ok")));
  json_node_unref(all);
  // The scene itself can be the worst.
  write_scene("%s[cases]\nnarrow = gland.radial_space=1.4 mm\n", limits);
  all = run_json(path, none, none);
  g_assert_true(JSON_NODE_HOLDS_NULL(cli_at(all, "cycle.verdict.presses.case")));
  g_assert_cmpfloat(cli_number(all, "cycle.verdict.presses.value"), ==,
                    cli_number(all, "cycle.force_breakaway_N"));
  json_node_unref(all);
}

// In the table, in the plan, and through a picture of the scene.
static void test_shown(void) {
  write_scene("[limits]\ncycle.force_breakaway_N = <= 30 N\n[cases]\n"
              "hot = canister.pressure=0.9 MPa\ncold = canister.pressure=0.4 MPa\n");
  CliResult table = CLI("run", path, "--all");
  g_assert_nonnull(strstr(table.out, " N of 30 N (cycle.force_breakaway_N is above its limit)\n"));
  cli_clear(&table);
  CliResult plan = CLI("plan", path);
  g_assert_nonnull(strstr(plan.out, "2 cases by the scene's models: the verdict takes the worst"));
  cli_clear(&plan);
  CliResult none = CLI("plan", cli.scene);
  g_assert_null(strstr(none.out, "cases by"));
  cli_clear(&none);
  g_autofree char *picture = g_build_filename(cli.folder, "cases.png", NULL);
  CliResult drawn = CLI("render", path, "-o", picture, "--view", "hysteresis");
  g_assert_cmpint(drawn.code, ==, 0);
  cli_clear(&drawn);
  CliResult again = CLI("run", picture, "--json", "-", "--quiet");
  JsonNode *root = cli_parse(again.out);
  g_assert_cmpstr(json_node_get_string(cli_at(root, "cycle.verdict.presses.case")), ==, "hot");
  json_node_unref(root);
  cli_clear(&again);
  g_unlink(picture);
}

// A case that a solver cannot do leaves its questions open, is named, and is flagged.
static void test_failure(void) {
  write_scene("[limits]\nseals.outer.load_N = >= 1 N\ncycle.force_breakaway_N = <= 30 N\n[cases]\n"
              "stuck = models.fit=ring; output.work_limit=10\n"
              "hot = canister.pressure=0.9 MPa\n");
  CliResult run = CLI("run", path, "--json", "-", "--quiet");
  g_assert_cmpint(run.code, ==, 2);
  g_assert_nonnull(strstr(run.err, "sealbench: case stuck: fitment (ring), outer seal"));
  JsonNode *root = cli_parse(run.out);
  g_assert_true(JSON_NODE_HOLDS_NULL(cli_at(root, "cycle.verdict.fits.ok")));
  g_assert_cmpstr(json_node_get_string(cli_at(root, "cycle.verdict.fits.case")), ==, "stuck");
  g_assert_nonnull(strstr(json_node_get_string(cli_at(root, "cycle.verdict.fits.reason")), "ring"));
  // A seal that was not computed is not open.
  g_assert_true(JSON_NODE_HOLDS_NULL(cli_at(root, "cycle.verdict.seals.ok")));
  // A no stands whatever is unknown beside it.
  g_assert_false(json_node_get_boolean(cli_at(root, "cycle.verdict.presses.ok")));
  g_assert_cmpstr(json_node_get_string(cli_at(root, "cycle.verdict.presses.case")), ==, "hot");
  json_node_unref(root);
  cli_clear(&run);
}

static void test_refused(void) {
  static const struct {
    const char *line, *says; // behind "PATH: [cases] a.b: "
  } cases[] = {
      {"gland.radialspace=1 mm", "gland.radialspace: unknown key, do you mean gland.radial_space?"},
      {"gland.radial_space=9 m",
       "gland.radial_space: 9000 mm is out of range (allowed 0.1 to 20 mm)"},
      {"seal.modulus=3 MPa; gland.radial_space=3",
       "gland.radial_space: \"3\" has no unit, write for example \"3 mm\" (allowed 0.1 to 20 mm)"},
      {"stem.pressure_diameter=7 mm", "bore.diameter: the bore is smaller than the stem "
                                      "(stem.pressure_diameter 7 mm) (allowed at least 7 mm)"},
      {"seal.modulus", "\"seal.modulus\" is not KEY=VALUE (allowed KEY=VALUE; KEY=VALUE)"},
      {"", "\"\" is not KEY=VALUE (allowed KEY=VALUE; KEY=VALUE)"},
      {"seal.modulus=3 MPa; seal.modulus=4 MPa", "seal.modulus: is given twice"},
      {"models.fit=rnig", "models.fit: \"rnig\" is not one of the names, do you mean ring?"},
  };
  g_autofree char *out = g_build_filename(cli.folder, "none", NULL);
  for (size_t i = 0; i < G_N_ELEMENTS(cases); i++) {
    write_scene("[cases]\ngood = seal.modulus=3 MPa\na.b = %s\n", cases[i].line);
    g_autofree char *says = g_strdup_printf("sealbench: %s: [cases] a.b: %s", path, cases[i].says);
    CliResult check = CLI("check", path);
    CliResult run = CLI("run", path, "-o", out);
    g_assert_cmpint(check.code, ==, 1);
    g_assert_cmpint(run.code, ==, 1);
    if (!g_str_has_prefix(check.err, says)) {
      g_error("\"%s\" is not \"%s\"", check.err, says);
    }
    g_assert_cmpstr(run.err, ==, check.err);
    cli_clear(&check);
    cli_clear(&run);
  }
  g_assert_false(g_file_test(out, G_FILE_TEST_EXISTS));
  // What --set changes can make a case impossible.
  write_scene("[cases]\ntight = bore.diameter=6 mm\n");
  CliResult run =
      CLI("run", path, "--set", "stem.pressure_diameter=6.2 mm", "--set", "bore.diameter=6.4 mm");
  g_assert_cmpint(run.code, ==, 1);
  g_assert_nonnull(strstr(run.err, "[cases] tight: "));
  cli_clear(&run);
  // A mistyped group is known.
  write_scene("[case]\na = seal.modulus=3 MPa\n");
  CliResult check = CLI("check", path);
  g_assert_nonnull(strstr(check.err, "unknown group [case], do you mean cases?"));
  cli_clear(&check);
}

// A size that a drawing changes with another one follows it, or a note states that it stays.
static void test_kept(void) {
  write_scene("[bore]\ndiameter = 6.2 mm\n");
  CliResult run = CLI("run", path, "--json", "-");
  JsonNode *root = cli_parse(run.out);
  JsonObject *follows = json_node_get_object(cli_at(root, "follows"));
  JsonObject *stem = json_object_get_object_member(follows, "stem.pressure_diameter");
  g_assert_cmpfloat(json_object_get_double_member(stem, "value"), ==, 5.994e-3);
  g_assert_cmpstr(json_object_get_string_member(stem, "from"), ==, "bore.diameter");
  json_node_unref(root);
  cli_clear(&run);
  // The document's own file gives it, and --set changes the other one; unless --set has both.
  write_scene("[stem]\npressure_diameter = 5.7 mm\n");
  static const char note[] = "note: stem.pressure_diameter stays at 5.7 mm while bore.diameter "
                             "changes from 6 mm to 6.2 mm";
  CliResult plan = CLI("plan", path, "--set", "bore.diameter=6.2 mm");
  g_assert_nonnull(strstr(plan.err, note));
  cli_clear(&plan);
  plan = CLI("plan", path, "--set", "bore.diameter=6.2 mm", "--set",
             "stem.pressure_diameter = 5.7 mm");
  g_assert_cmpstr(plan.err, ==, "");
  cli_clear(&plan);
  static const char *const commands[] = {"check", "run", "plan"};
  for (size_t i = 0; i < G_N_ELEMENTS(commands); i++) {
    g_autofree char *valve =
        g_build_filename(g_getenv("SEALBENCH_ASSETS"), "scenes", "spring-return.scene", NULL);
    CliResult stays = CLI(commands[i], valve, "--set", "bore.diameter=3.5 mm");
    g_assert_nonnull(strstr(stays.err, "note: stem.pressure_diameter stays at 3.2 mm while "
                                       "bore.diameter changes from 3.4 mm to 3.5 mm"));
    cli_clear(&stays);
    stays = CLI(commands[i], valve, "--set", "bore.diameter=3.5 mm", "--set",
                "bore.entry_diameter=4.2 mm", "--set", "stem.pressure_diameter=3.3 mm");
    g_assert_null(strstr(stays.err, "stays at"));
    cli_clear(&stays);
  }
}

// Checks that `check` has this note at this place of a file.
static void has_note(const char *file, const char *group, const char *key, const char *text) {
  CliResult check = CLI("check", file, "--json", "-");
  JsonNode *root = cli_parse(check.out);
  JsonArray *issues = json_node_get_array(cli_at(root, "files.0.issues"));
  bool found = false;
  for (guint i = 0; i < json_array_get_length(issues); i++) {
    JsonObject *issue = json_array_get_object_element(issues, i);
    found = found || (g_strcmp0(json_object_get_string_member(issue, "severity"), "note") == 0 &&
                      g_strcmp0(json_object_get_string_member(issue, "group"), group) == 0 &&
                      g_strcmp0(json_object_get_string_member(issue, "key"), key) == 0 &&
                      strstr(json_object_get_string_member(issue, "text"), text) != NULL);
  }
  if (!found) {
    g_error("%s: no note on [%s] %s: %s", file, group, key, check.out);
  }
  json_node_unref(root);
  cli_clear(&check);
}

// A size that stays is a warning of the run and of each row of a study, and the reason of a verdict
// that depends on it.
static void test_kept_results(void) {
  g_autofree char *valve =
      g_build_filename(g_getenv("SEALBENCH_ASSETS"), "valves", "spring-return.valve", NULL);
  g_autofree char *text = g_strdup_printf("[sealbench]\nformat = 1\nkind = scene\nvalve = %s\n"
                                          "[models]\nfit = karaszkiewicz\nfilm = thesis\n"
                                          "[bore]\ndiameter = 3.5 mm\nentry_diameter = 4.2 mm\n",
                                          valve);
  g_assert_true(g_file_set_contents(path, text, -1, NULL));
  static const char stays[] = "stem.pressure_diameter stays at 3.2 mm while bore.diameter changes "
                              "from 3.4 mm to 3.5 mm";
  has_note(path, "stem", "pressure_diameter", stays);
  CliResult run = CLI("run", path, "--json", "-");
  JsonNode *root = cli_parse(run.out);
  JsonArray *warnings = json_node_get_array(cli_at(root, "warnings"));
  int found = 0;
  for (guint i = 0; i < json_array_get_length(warnings); i++) {
    JsonObject *of = json_array_get_object_element(warnings, i);
    found += strcmp(json_object_get_string_member(of, "code"), "size-kept") == 0 &&
             strcmp(json_object_get_string_member(of, "parameter"), "stem.pressure_diameter") == 0;
  }
  g_assert_cmpint(found, ==, 1);
  const char *reason = json_node_get_string(cli_at(root, "cycle.verdict.returns.reason"));
  g_assert_nonnull(strstr(reason, stays));
  json_node_unref(root);
  cli_clear(&run);
  // Rows beyond the tolerance of the bore, 0.02 mm, have the warning; rows that have both sizes
  // not.
  g_autofree char *study = g_build_filename(cli.folder, "kept.study", NULL);
  g_autofree char *store = g_build_filename(cli.folder, "kept.store", NULL);
  g_autofree char *rows = g_strdup_printf(
      "[sealbench]\nformat = 1\nkind = study\nscene = %s\n[vary]\n"
      "bore.diameter = levels 3.4 mm, 3.41 mm, 3.5 mm\nbore.entry_diameter = levels 4.2 mm\n"
      "[study]\nmethod = grid\nfigures = cycle.force_press_N\n",
      path);
  g_assert_true(g_file_set_contents(study, rows, -1, NULL));
  has_note(study, "vary", "bore.diameter", "stem.pressure_diameter stays at 3.2 mm");
  CliResult made = CLI("study", study, "--json", "-");
  root = cli_parse(made.out);
  g_assert_cmpfloat(cli_number(root, "warnings.size-kept"), ==, 1);
  json_node_unref(root);
  cli_clear(&made);
  g_remove(store);
  g_remove(study);
}

// So are sizes that cannot be built together: a chamber longer than the space between its grooves.
static void test_overlap_results(void) {
  static const char overlaps[] = "the dose chamber does not fit between the grooves: "
                                 "stem.chamber_length is 6 mm";
  CliResult run = CLI("run", "quick-look", "--set", "stem.chamber_length=6mm", "--json", "-");
  g_assert_nonnull(strstr(run.err, overlaps));
  g_autoptr(JsonNode) root = cli_parse(run.out);
  g_assert_nonnull(strstr(run.out, "\"size-overlap\""));
  const char *reason = json_node_get_string(cli_at(root, "cycle.verdict.returns.reason"));
  g_assert_nonnull(strstr(reason, overlaps));
  cli_clear(&run);
  CliResult check = CLI("check", "quick-look", "--set", "stem.chamber_length=6mm", "--json", "-");
  g_assert_nonnull(strstr(check.out, overlaps));
  cli_clear(&check);
}

// A hardness states its modulus wherever a value may be written.
static void test_hardness(void) {
  write_scene("[seal]\nmodulus = 70 IRHD\n[cases]\nsoft = seal.modulus = 40 Shore A\n"
              "[pins]\nold = seal.modulus = 55 Shore A\n");
  has_note(path, "seal", "modulus", "70 IRHD is a modulus of 5.38 MPa");
  has_note(path, "cases", "soft", "40 Shore A is a modulus of 1.69 MPa");
  has_note(path, "pins", "old", "55 Shore A is a modulus of 2.97 MPa");
  g_autofree char *study = g_build_filename(cli.folder, "hardness.study", NULL);
  g_autofree char *text =
      g_strdup_printf("[sealbench]\nformat = 1\nkind = study\nscene = %s\n[vary]\nseal.modulus = "
                      "normal 60 Shore A, "
                      "2 Shore A within 50 Shore A .. 75 IRHD\n[study]\nsamples = 2\n"
                      "figures = seals.outer.modulus_Pa\n",
                      path);
  g_assert_true(g_file_set_contents(study, text, -1, NULL));
  static const char *const moduli[] = {"60 Shore A is a modulus of 3.61 MPa", "50 Shore A is a",
                                       "75 IRHD is a modulus of"};
  CliResult run = CLI("study", study, "--csv", "-");
  for (size_t i = 0; i < G_N_ELEMENTS(moduli); i++) {
    has_note(study, "vary", "seal.modulus", moduli[i]);
    g_assert_nonnull(strstr(run.err, moduli[i]));
  }
  g_assert_nonnull(strstr(run.err, "note: cases.soft: 40 Shore A"));
  cli_clear(&run);
  g_autofree char *store = g_build_filename(cli.folder, "hardness.store", NULL);
  g_remove(store);
  g_remove(study);
}

int main(int argc, char **argv) {
  g_test_init(&argc, &argv, NULL);
  cli_set_up();
  path = g_build_filename(cli.folder, "cases.scene", NULL);
  g_test_add_func("/cases/worst", test_worst);
  g_test_add_func("/cases/kept", test_kept);
  g_test_add_func("/cases/kept-results", test_kept_results);
  g_test_add_func("/cases/overlap-results", test_overlap_results);
  g_test_add_func("/cases/hardness", test_hardness);
  g_test_add_func("/cases/shown", test_shown);
  g_test_add_func("/cases/failure", test_failure);
  g_test_add_func("/cases/refused", test_refused);
  int result = g_test_run();
  g_unlink(path);
  g_free(path);
  cli_tear_down();
  return result;
}
