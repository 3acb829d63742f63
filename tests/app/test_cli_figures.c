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
       "does not touch"},
      {{"--set=models.fit=disc", "--set=seal.modulus=1.1MPa", "--set=seal.section_diameter=2.6mm",
        "--set=seal.inner_diameter=2.2mm", "--set=gland.axial_width=8mm"},
       2,
       "cycle.returns",
       "fitment (disc), outer seal, stages A to C, in-stroke, 0.55 MPa"},
      {{"--set=surface.gt_product=0.02", "--quiet", "--quiet", "--quiet", "--quiet"},
       0,
       "seals.inner.leakage_static_m3_per_s",
       "0.025"},
      {{"--set=surface.gt_product=0.17", "--quiet", "--quiet", "--quiet", "--quiet"},
       0,
       "cycle.leakage_net_all_actuations_m3",
       "does not come back"},
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
  CliResult table = CLI("run", cli.scene, "--set=surface.gt_product=0.17");
  g_assert_nonnull(strstr(table.out, "Leakage per cycle              - (the stem does not come"));
  cli_clear(&table);
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
      {"cycle.force_peak_N = 30 N", "[limits] cycle.force_peak_N: \"30 N\" is no limit"},
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

int main(int argc, char **argv) {
  g_test_init(&argc, &argv, NULL);
  cli_set_up();
  g_test_add_func("/cli/json/reasons", test_reasons);
  g_test_add_func("/cli/limits", test_limits);
  int result = g_test_run();
  cli_tear_down();
  return result;
}
