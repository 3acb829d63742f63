// The figures of run from outside: why one is null, limits on them and the verdict.
#include "tests/app/cli_fixture.h"

#include <glib/gstdio.h>
#include <string.h>

// Every null has its reason, but those of the verdict and of warnings, which stand beside them.
static void check_nulls(JsonNode *node, const char *path, JsonObject *reasons) {
  if (JSON_NODE_HOLDS_NULL(node) && !json_object_has_member(reasons, path)) {
    g_error("%s is null without a reason", path);
  }
  if (!JSON_NODE_HOLDS_OBJECT(node)) {
    return;
  }
  JsonObjectIter iter;
  const char *name;
  JsonNode *inside;
  json_object_iter_init(&iter, json_node_get_object(node));
  while (json_object_iter_next(&iter, &name, &inside)) {
    g_autofree char *whole = g_strdup_printf("%s%s%s", path, *path != '\0' ? "." : "", name);
    if (!g_str_equal(whole, "cycle.verdict") && !g_str_equal(whole, "reasons")) {
      check_nulls(inside, whole, reasons);
    }
  }
}

// Nothing that was not computed is 0: null, its reason, an empty cell, a dash.
static void test_reasons(void) {
  static const struct {
    const char *set[5];
    int code;
    const char *null; // a path that must be null
    const char *says; // its reason
  } cases[] = {
      {{"--set=models.fit=disc", "--set=gland.radial_space=1.57mm",
        "--set=seal.inner_diameter=2.476mm", "--quiet", "--quiet"},
       0,
       "cycle.leakage_per_cycle_m3",
       "has no contact"},
      {{"--set=models.fit=ring", "--set=output.work_limit=10", "--quiet", "--quiet", "--quiet"},
       2,
       "cycle.returns",
       "fitment (ring), outer seal, stages A to C, in-stroke, 0.55 MPa"},
      {{"--quiet", "--quiet", "--quiet", "--quiet", "--quiet"},
       0,
       "seals.inner.leakage_static_m3_per_s",
       "near full contact"},
      {{"--set=surface.gt_product=0.17", "--quiet", "--quiet", "--quiet", "--quiet"},
       0,
       "cycle.leakage_net_all_actuations_m3",
       "the stem is stuck at"},
  };
  for (size_t i = 0; i < G_N_ELEMENTS(cases); i++) {
    CliResult run =
        CLI("run", cli.scene, "--set=models.film=thesis", cases[i].set[0], cases[i].set[1],
            cases[i].set[2], cases[i].set[3], cases[i].set[4], "--json", "-", "--quiet");
    g_assert_cmpint(run.code, ==, cases[i].code);
    JsonNode *root = cli_parse(run.out);
    JsonObject *reasons = json_node_get_object(cli_at(root, "reasons"));
    g_assert_true(JSON_NODE_HOLDS_NULL(cli_at(root, cases[i].null)));
    g_assert_nonnull(strstr(json_object_get_string_member(reasons, cases[i].null), cases[i].says));
    check_nulls(root, "", reasons);
    json_node_unref(root);
    g_assert_true(cases[i].code == 0 || strstr(run.err, cases[i].says) != NULL);
    cli_clear(&run);
  }
  CliResult table = CLI("run", cli.scene, "--all", "--set=surface.gt_product=0.17");
  g_assert_nonnull(
      strstr(table.out, "Leakage per cycle                    - (the stem is stuck at"));
  cli_clear(&table);
}

// A set of models brings defaults: check tells them, JSON names the models in force, given ones
// win.
static void test_set(void) {
  g_autofree char *path = g_build_filename(cli.folder, "set.scene", NULL);
  g_autofree char *text = g_strdup_printf("[sealbench]\nformat = 1\nkind = scene\nvalve = %s\n"
                                          "[models]\nset = consistent\nfit = hertz\n",
                                          cli.valve);
  g_assert_true(g_file_set_contents(path, text, -1, NULL));
  CliResult check = CLI("check", path);
  g_assert_cmpint(check.code, ==, 0);
  g_assert_nonnull(strstr(check.out, "models.friction = shear (models.set = consistent"));
  g_assert_nonnull(strstr(check.out, "friction.shear_strength = "));
  g_assert_null(strstr(check.out, "models.fit ="));
  cli_clear(&check);
  CliResult run = CLI("run", path, "--json", "-", "--quiet", "--set", "models.inlet=flooded");
  g_assert_cmpint(run.code, ==, 0);
  JsonNode *root = cli_parse(run.out);
  static const char *const models[][2] = {{"set", "consistent"},     {"fit", "hertz"},
                                          {"film", "reynolds"},      {"surface", "persson"},
                                          {"asperities", "coupled"}, {"friction", "shear"},
                                          {"inlet", "flooded"}};
  for (size_t i = 0; i < G_N_ELEMENTS(models); i++) {
    g_autofree char *at = g_strconcat("models.", models[i][0], NULL);
    g_assert_cmpstr(json_node_get_string(cli_at(root, at)), ==, models[i][1]);
  }
  const double area = G_PI * 6e-3 * cli_number(root, "seals.outer.contact_width_m");
  g_assert_cmpfloat(cli_number(root, "seals.outer.friction_static_real_area_share"), ==,
                    cli_number(root, "seals.outer.leakage_static_real_area_share"));
  g_assert_cmpfloat(cli_number(root, "seals.outer.friction_boundary_N"), >, 0);
  g_assert_cmpfloat(area, >, 0);
  json_node_unref(root);
  cli_clear(&run);
  g_remove(path);
}

// A scene's limits, from its file to the verdict, and what is refused in them.
static void test_limits(void) {
  g_autofree char *path = g_build_filename(cli.folder, "limits.scene", NULL);
  static const char head[] = "[sealbench]\nformat = 1\nkind = scene\nvalve = ";
  g_autofree char *good = g_strdup_printf("%s%s\n[limits]\n"
                                          "cycle.force_breakaway_N = <= 40 N\n"
                                          "cycle.force_return_min_N = >= 0.002 kN\n"
                                          "cycle.dose_mass_kg = 60 mg .. 90 mg\n"
                                          "seals.outer.squeeze = >= 20 %%\n",
                                          head, cli.valve);
  g_assert_true(g_file_set_contents(path, good, -1, NULL));
  CliResult run = CLI("run", path, "--json", "-", "--quiet");
  g_assert_cmpint(run.code, ==, 0);
  JsonNode *root = cli_parse(run.out);
  g_assert_true(json_node_get_boolean(cli_at(root, "cycle.verdict.seals.ok")));
  g_assert_true(json_node_get_boolean(cli_at(root, "cycle.verdict.presses.ok")));
  g_assert_true(json_node_get_boolean(cli_at(root, "cycle.verdict.doses.ok")));
  g_assert_false(json_node_get_boolean(cli_at(root, "cycle.verdict.returns.ok")));
  g_assert_cmpfloat(cli_number(root, "cycle.verdict.returns.limit"), ==, 2);
  g_assert_false(json_node_get_boolean(cli_at(root, "cycle.verdict.fits.ok")));
  g_assert_cmpstr(json_node_get_string(cli_at(root, "cycle.verdict.fits.figure")), ==,
                  "seals.outer.squeeze");
  g_assert_true(JSON_NODE_HOLDS_NULL(cli_at(root, "cycle.verdict.leak.ok")));
  json_node_unref(root);
  cli_clear(&run);
  static const char *const bad[][2] = {
      {"cycle.force_return_min = >= 2 N", "do you mean cycle.force_return_min_N?"},
      {"cycle.force_peak_N = 30 N", "[limits] cycle.force_peak_N: \"30 N\" is not a limit"},
      {"cycle.force_peak_N = 3 N .. 2 N", "does not rise"},
      {"cycle.force_peak_N = <= 30", "has no unit"},
      {"cycle.force_peak_N = <= 30 mm", "another kind"},
      {"cycle.returns = >= 1", "no limit can be set"},
  };
  for (size_t i = 0; i < G_N_ELEMENTS(bad); i++) {
    g_autofree char *text = g_strdup_printf("%s%s\n[limits]\n%s\n", head, cli.valve, bad[i][0]);
    g_assert_true(g_file_set_contents(path, text, -1, NULL));
    CliResult check = CLI("check", path);
    g_assert_cmpint(check.code, ==, 1);
    if (strstr(check.err, bad[i][1]) == NULL) {
      g_error("\"%s\": %s", bad[i][0], check.err);
    }
    cli_clear(&check);
  }
  // Geometry that is hardly meant is told, and no error.
  g_autofree char *ports = g_strdup_printf("%s%s\n[canister]\npressure_map = ports\n[models]\n"
                                           "motion = dynamic\n",
                                           head, cli.valve);
  g_assert_true(g_file_set_contents(path, ports, -1, NULL));
  CliResult check = CLI("check", path);
  g_assert_cmpint(check.code, ==, 0);
  g_assert_nonnull(strstr(check.out, "[bore] vent_position: the dose chamber never"));
  g_assert_nonnull(strstr(check.out, "(allowed 0 to 9.75 mm)"));
  cli_clear(&check);
  g_remove(path);
}

// `list figures` is the catalogue: each key once, with all that a person needs, and a path in the
// JSON of a run that has its block; a table gives no more digits than the error estimate supports.
static void test_list(void) {
  CliResult list = CLI("list", "figures", "--json", "-");
  g_assert_cmpint(list.code, ==, 0);
  JsonNode *figures = cli_parse(list.out);
  static const char *const scenes[] = {"quick-look", "sliding-plate", "life-400"};
  JsonNode *runs[G_N_ELEMENTS(scenes)];
  g_autofree char *folder = g_path_get_dirname(cli.scene);
  for (size_t i = 0; i < G_N_ELEMENTS(scenes); i++) {
    g_autofree char *path = g_strdup_printf("%s/%s.scene", folder, scenes[i]);
    CliResult run = CLI("run", path, "--json", "-", "--quiet", "--set=life.actuations=2",
                        i == 2 ? "--quiet" : "--set=life.actuations=1");
    g_assert_cmpint(run.code, ==, 0);
    runs[i] = cli_parse(run.out);
    cli_clear(&run);
  }
  g_autoptr(GHashTable) seen = g_hash_table_new_full(g_str_hash, g_str_equal, g_free, NULL);
  JsonArray *rows = json_node_get_array(figures);
  for (guint i = 0; i < json_array_get_length(rows); i++) {
    JsonObject *row = json_array_get_object_element(rows, i);
    const char *key = json_object_get_string_member(row, "key");
    const char *label = json_object_get_string_member(row, "label");
    const char *better = json_object_get_string_member(row, "better");
    g_assert_true(g_hash_table_add(seen, g_strdup(key)));
    g_assert_true(g_hash_table_add(seen, g_strdup(label)));
    g_assert_cmpuint(strlen(json_object_get_string_member(row, "help")), >, 10);
    g_assert_cmpuint(strlen(json_object_get_string_member(row, "unit")), >, 0);
    g_assert_nonnull(strstr("none less more", better));
    bool found = false;
    for (size_t k = 0; k < G_N_ELEMENTS(scenes) && !found; k++) {
      JsonNode *at = runs[k];
      g_auto(GStrv) names = g_strsplit(key, ".", -1);
      for (char **name = names; at != NULL && *name != NULL; name++) {
        at = json_object_get_member(json_node_get_object(at), *name);
      }
      found = at != NULL;
    }
    if (!found) {
      g_error("no run has %s", key);
    }
  }
  static const char *const some[] = {"cycle.force_return_min_N", "seals.inner.gland_fill",
                                     "cycle.stages.C.force_N",   "dose.metered_volume_m3",
                                     "rig.coefficient_dynamic",  "life.force_return_least_N"};
  for (size_t i = 0; i < G_N_ELEMENTS(some); i++) {
    g_assert_true(g_hash_table_contains(seen, some[i]));
  }
  json_node_unref(figures);
  for (size_t i = 0; i < G_N_ELEMENTS(scenes); i++) {
    json_node_unref(runs[i]);
  }
  cli_clear(&list);
  // The plate's force is sampled: the error of 5e-4 supports the fourth decimal.
  g_autofree char *plate = g_strdup_printf("%s/sliding-plate.scene", folder);
  CliResult table = CLI("run", plate, "--all");
  g_assert_nonnull(strstr(table.out, " 0.5394\n"));
  cli_clear(&table);
  table = CLI("list", "figures");
  g_assert_nonnull(strstr(table.out, "\nseals.outer.load_N "));
  cli_clear(&table);
}

// figures.csv: a row a figure, SI, its estimate, or why it is missing.
static void test_table(void) {
  g_autofree char *out = g_build_filename(cli.folder, "figures", NULL);
  CliResult run = CLI("run", cli.scene, "--set=surface.gt_product=0.17", "-o", out, "--quiet");
  g_assert_cmpint(run.code, ==, 0);
  cli_clear(&run);
  g_autofree char *text = cli_contents(out, "figures.csv");
  g_assert_true(g_str_has_prefix(text, "figure,value,unit,error_estimate [1],label,reason\n"
                                       "cycle.force_peak_N,36.0"));
  g_assert_nonnull(strstr(text, "\ncycle.leakage_per_cycle_m3,,m3,,Leakage per cycle,the stem"));
  g_assert_nonnull(strstr(text, ",\"Load, outer seal\",\n"));
  cli_remove_results(out);
  // An error that the JSON withholds is not in the table, which has the JSON's reason.
  run = CLI("run", "sliding-plate", "-o", out, "--quiet");
  g_assert_cmpint(run.code, ==, 0);
  cli_clear(&run);
  g_autofree char *plate = cli_contents(out, "figures.csv");
  g_autofree char *json = cli_contents(out, "results.json");
  g_autoptr(JsonNode) root = cli_parse(json);
  JsonObject *object = json_node_get_object(root);
  JsonObject *reasons = json_object_get_object_member(object, "reasons");
  const char *reason =
      json_object_get_string_member(reasons, "error_estimates.cycle.energy.stop_J");
  g_autofree char *row =
      g_strdup_printf("\ncycle.energy.stop_J,0,J,,Energy lost at the stops,%s\n", reason);
  g_assert_nonnull(strstr(plate, row));
  g_assert_null(strstr(plate, ",inf,"));
  cli_remove_results(out);
}

// Derivatives by name in SI, the table, and what is told.
static void test_sensitivity(void) {
  CliResult result = CLI("sensitivity", cli.scene, cli.scene, "--set", "models.film=thesis",
                         "--parameters", "gland.radial_space, bore.entry_length,fluid.ethanol",
                         "--figures", "cycle.force_breakaway_N,rig.first_peak_N", "--json", "-");
  g_assert_cmpint(result.code, ==, 0);
  g_autoptr(JsonNode) root = cli_parse(result.out);
  const JsonNode *first = cli_at(root, "0");
  g_assert_cmpuint(json_array_get_length(json_node_get_array(root)), ==, 2);
  cli_has_keys((JsonNode *)first, "figures gradients errors reasons");
  JsonObject *object = json_node_get_object((JsonNode *)first);
  JsonObject *gradients = json_object_get_object_member(object, "gradients");
  JsonObject *by = json_object_get_object_member(gradients, "cycle.force_breakaway_N");
  g_assert_cmpfloat(json_object_get_double_member(by, "gland.radial_space"), <, -1e4);
  g_assert_cmpfloat(json_object_get_double_member(by, "bore.entry_length"), ==, 0);
  g_assert_true(json_object_get_null_member(by, "fluid.ethanol"));
  JsonObject *errors = json_object_get_object_member(object, "errors");
  JsonObject *of = json_object_get_object_member(errors, "cycle.force_breakaway_N");
  g_assert_cmpfloat(json_object_get_double_member(of, "gland.radial_space"), >, 0);
  g_assert_cmpfloat(json_object_get_double_member(of, "gland.radial_space"), <, 1);
  g_assert_cmpfloat(json_object_get_double_member(of, "bore.entry_length"), ==, 0);
  g_assert_true(json_object_get_null_member(of, "fluid.ethanol"));
  JsonObject *reasons = json_object_get_object_member(object, "reasons");
  g_assert_nonnull(strstr(
      json_object_get_string_member(
          json_object_get_object_member(reasons, "cycle.force_breakaway_N"), "fluid.ethanol"),
      "needs a propellant by name"));
  g_assert_true(json_object_get_null_member(json_object_get_object_member(object, "figures"),
                                            "rig.first_peak_N"));
  cli_clear(&result);
  result = CLI("sensitivity", cli.scene, "--set", "models.film=thesis", "--parameters",
               "gland.radial_space,seal.modulus", "--figures", "seals.outer.load_N");
  g_assert_cmpint(result.code, ==, 0);
  g_assert_nonnull(strstr(result.out, "per 0.02 mm"));
  g_assert_nonnull(strstr(result.out, "per 5 %"));
  cli_clear(&result);
  static const struct {
    const char *option, *value, *says;
  } wrong[] = {{"--figures", "cycle.force_braekaway_N", "do you mean cycle.force_breakaway_N?"},
               {"--parameters", "gland.radial_spce", "do you mean gland.radial_space?"},
               {"--parameters", "models.film", "models.film is not a real number"}};
  for (size_t i = 0; i < G_N_ELEMENTS(wrong); i++) {
    result = CLI("sensitivity", cli.scene, wrong[i].option, wrong[i].value);
    g_assert_cmpint(result.code, ==, 1);
    g_assert_nonnull(strstr(result.err, wrong[i].says));
    cli_clear(&result);
  }
}

// The outcome in the JSON, with reasons for what did not happen; the verdict follows from it.
static void test_outcome(void) {
  static const struct {
    const char *set, *outcome;
  } cases[] = {{"drive.peak_force=20 N", "never-moved"},
               {"surface.gt_product=0.17", "stuck"},
               {"friction.static_ratio=1.1", "returned"},
               {"friction.static_ratio=1.3", "returned"}, // by its momentum: the margin is negative
               {"drive.kind=ramp", "held"}};
  for (size_t i = 0; i < G_N_ELEMENTS(cases); i++) {
    CliResult run = CLI("run", cli.scene, "--json", "-", "--quiet", "--set",
                        "models.motion=dynamic", "--set", "drive.kind=hand", "--set", cases[i].set);
    g_autoptr(JsonNode) root = cli_parse(run.out);
    cli_clear(&run);
    g_assert_cmpstr(json_node_get_string(cli_at(root, "cycle.outcome")), ==, cases[i].outcome);
    JsonObject *cycle = json_node_get_object(cli_at(root, "cycle"));
    JsonObject *reasons = json_node_get_object(cli_at(root, "reasons"));
    static const char *const figures[] = {
        "returns",       "stuck_at_m",   "force_return_margin_N",
        "force_press_N", "dose_mass_kg", "leakage_carried_all_actuations_m3"};
    for (size_t k = 0; k < G_N_ELEMENTS(figures); k++) {
      g_autofree char *path = g_strconcat("cycle.", figures[k], NULL);
      const bool null = JSON_NODE_HOLDS_NULL(json_object_get_member(cycle, figures[k]));
      g_assert_true(json_object_has_member(reasons, path) == null);
      // Of a stem that never moved nothing is known, of one that returned all but where it is
      // stuck.
      g_assert_true(i != 0 || null);
      g_assert_true((i != 2 && i != 3) || null == (k == 1));
    }
    const bool yes = i == 2;
    JsonNode *ok = cli_at(root, "cycle.verdict.returns.ok");
    g_assert_true((!JSON_NODE_HOLDS_NULL(ok) && json_node_get_boolean(ok)) == yes);
  }
}

int main(int argc, char **argv) {
  g_test_init(&argc, &argv, NULL);
  cli_set_up();
  g_test_add_func("/cli/json/reasons", test_reasons);
  g_test_add_func("/cli/limits", test_limits);
  g_test_add_func("/cli/set", test_set);
  g_test_add_func("/cli/list-figures", test_list);
  g_test_add_func("/cli/figures-table", test_table);
  g_test_add_func("/cli/sensitivity", test_sensitivity);
  g_test_add_func("/cli/outcome", test_outcome);
  int result = g_test_run();
  cli_tear_down();
  return result;
}
