// What commands print for people says the same as their JSON: tables of fits, the rig, a life, the
// bench and the lists, and the tables that runs of these leave in their folder.
#include "tests/app/cli_fixture.h"

#include <glib/gstdio.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

// The text behind `label` in a table; fails if the table has no such line.
static const char *shown(const char *table, const char *label) {
  g_autofree char *begin = g_strdup_printf("\n  %s ", label);
  const char *at = strstr(table, begin);
  if (at == NULL) {
    g_error("no line \"%s\" in:\n%s", label, table);
  }
  at += strlen(begin);
  return at + strspn(at, " ");
}

// A table says `value` to within 1e-4 or, where its error leaves fewer digits, the last one shown.
static void same(const char *table, const char *label, double value) {
  const char *text = shown(table, label);
  size_t whole = strspn(text, "-0123456789");
  size_t digits = text[whole] == '.' ? strspn(text + whole + 1, "0123456789") : 0;
  double last = pow(10, -(double)digits);
  g_assert_cmpfloat(fabs(g_ascii_strtod(text, NULL) - value), <=,
                    fmax(0.5001 * last, 1e-4 * fabs(value)));
  g_assert_cmpfloat(last, <=, fmax(1, 0.01 * fabs(value)));
}
#define SAME(table, label, root, path, factor) same(table, label, (factor)*cli_number(root, path))

static char *scene_named(const char *name) {
  g_autofree char *folder = g_path_get_dirname(cli.scene);
  return g_build_filename(folder, name, NULL);
}

static JsonNode *json_of(const char *const *arguments) {
  CliResult result = cli_run(arguments, NULL, NULL);
  g_assert_cmpint(result.code, ==, 0);
  JsonNode *root = cli_parse(result.out);
  cli_clear(&result);
  return root;
}
#define JSON(...) json_of((const char *const[]){__VA_ARGS__, "--json", "-", NULL})

static void test_fit(void) {
  static const char *const models[] = {"ring", "green-english:plane-strain-unrestrained", "disc"};
  for (size_t i = 0; i < G_N_ELEMENTS(models); i++) {
    CliResult table = CLI("fit", cli.valve, "--seal", "outer", "--model", models[i], "--pressure",
                          "0.55 MPa", "--tolerance", "1e-2");
    g_assert_cmpint(table.code, ==, 0);
    JsonNode *root = JSON("fit", cli.valve, "--seal", "outer", "--model", models[i], "--pressure",
                          "0.55 MPa", "--tolerance", "1e-2");
    SAME(table.out, "Squeeze", root, "squeeze", 100);
    SAME(table.out, "Contact width", root, "contact_width_m", 1e3);
    SAME(table.out, "Load", root, "load_N", 1);
    SAME(table.out, "Peak pressure", root, "pressure_peak_Pa", 1e-6);
    if (i == 0) {
      SAME(table.out, "Load on the groove floor", root, "ring.floor_load_N", 1);
      g_assert_nonnull(strstr(table.out, " Newton iterations\n"));
    }
    g_assert_nonnull(strstr(table.out, "Gland against customary bands\n"));
    g_assert_nonnull(strstr(table.out, ": within; Parker ORD 5700"));
    json_node_unref(root);
    cli_clear(&table);
  }
  // A section that no gland table has is not judged by another one's row.
  CliResult table = CLI("fit", cli.valve, "--seal", "outer", "--model", "lindley", "--set",
                        "seal.section_diameter=1.46mm");
  g_assert_cmpint(table.code, ==, 0);
  g_assert_nonnull(strstr(table.out, ": not judged; the gland tables of Parker ORD 5700"));
  cli_clear(&table);
  static const struct {
    const char *option, *value, *says;
  } bad[] = {
      {"--model", "karaszkiewicz:x", "do you mean karaszkiewicz?"},
      {"--pressure", "70 MPa", "--pressure: 70 MPa is out of range (allowed "},
      {"--pressure", "1 mm", "another kind"},
      {"--tolerance", "1", "--tolerance: out of range (allowed 1e-8 to 0.1)"},
  };
  for (size_t i = 0; i < G_N_ELEMENTS(bad); i++) {
    CliResult result = CLI("fit", cli.valve, "--seal", "outer", bad[i].option, bad[i].value);
    g_assert_cmpint(result.code, ==, 1);
    g_assert_nonnull(strstr(result.err, bad[i].says));
    cli_clear(&result);
  }
  CliResult none = CLI("fit", cli.valve);
  g_assert_nonnull(strstr(none.err, "--seal: is missing (allowed outer, inner)"));
  cli_clear(&none);
}

// Rows of a file of the folder, its heading first.
static char **rows_of(const char *folder, const char *name) {
  g_autofree char *text = g_strchomp(cli_contents(folder, name));
  return g_strsplit(text, "\n", -1);
}

static void test_rig(void) {
  g_autofree char *scene = scene_named("sliding-plate.scene");
  g_autofree char *out = g_build_filename(cli.folder, "rig", NULL);
  CliResult table = CLI("run", scene, "--all", "-o", out);
  g_assert_cmpint(table.code, ==, 0);
  g_autofree char *text = cli_contents(out, "results.json");
  JsonNode *root = cli_parse(text);
  SAME(table.out, "Static coefficient", root, "rig.coefficient_static", 1);
  SAME(table.out, "Dynamic coefficient", root, "rig.coefficient_dynamic", 1);
  SAME(table.out, "First peak", root, "rig.first_peak_N", 1);
  SAME(table.out, "Peaks that follow", root, "rig.following_peaks", 1);
  SAME(table.out, "Energy of the loop", root, "cycle.energy_loss_J", 1e3);
  // The table of the cycle marks the peaks that the JSON counts.
  g_auto(GStrv) rows = rows_of(out, "cycle.csv");
  g_assert_true(g_str_has_suffix(rows[0], ",peak"));
  size_t first = 0, following = 0, count = 0;
  for (char **row = rows + 1; *row != NULL; row++, count++) {
    first += g_str_has_suffix(*row, ",1");
    following += g_str_has_suffix(*row, ",2");
  }
  g_assert_cmpuint(first, ==, 1);
  g_assert_cmpfloat((double)following, ==, cli_number(root, "rig.following_peaks"));
  g_assert_cmpfloat((double)count, ==, cli_number(root, "solver.frames"));
  json_node_unref(root);
  cli_clear(&table);
  cli_remove_results(out);
}

static void test_life(void) {
  g_autofree char *scene = scene_named("life-400.scene");
  g_autofree char *out = g_build_filename(cli.folder, "life", NULL);
  CliResult table = CLI("run", scene, "--all", "-o", out, "--set", "life.actuations=5", "--set",
                        "models.film=thesis");
  g_assert_cmpint(table.code, ==, 0);
  g_assert_nonnull(strstr(table.out, "\nLife of 5 actuations\n"));
  g_autofree char *text = cli_contents(out, "results.json");
  JsonNode *root = cli_parse(text);
  SAME(table.out, "Roughness, last actuation", root, "life.roughness_last", 1);
  SAME(table.out, "Return force, last actuation", root, "life.force_return_last_N", 1);
  SAME(table.out, "Leakage carried, full life", root, "life.leakage_carried_m3", 1e15);
  g_auto(GStrv) rows = rows_of(out, "life.csv");
  g_assert_cmpuint(g_strv_length(rows), ==, 6);
  double carried = 0;
  for (int i = 1; i <= 5; i++) {
    g_auto(GStrv) cells = g_strsplit(rows[i], ",", -1);
    g_assert_cmpint(atoi(cells[0]), ==, i);
    g_autofree char *path = g_strdup_printf("life.by_actuation.roughness.%d", i - 1);
    g_assert_cmpfloat(g_ascii_strtod(cells[1], NULL), ==, cli_number(root, path));
    carried += g_ascii_strtod(cells[8], NULL);
  }
  g_assert_cmpfloat_with_epsilon(carried / cli_number(root, "life.leakage_carried_m3"), 1, 1e-12);
  json_node_unref(root);
  cli_clear(&table);
  g_autofree char *csv = g_build_filename(out, "life.csv", NULL);
  g_unlink(csv);
  cli_remove_results(out);
  // A life that ends early says at which actuation, and what it then does not know.
  table = CLI("run", scene, "--all", "--set", "life.actuations=5", "--set", "models.film=thesis",
              "--set", "surface.gt_product=0.17");
  g_assert_nonnull(strstr(table.out, "(the life ends at actuation 1: its stem does not return)\n"));
  cli_clear(&table);
  root = JSON("run", scene, "--set", "life.actuations=5", "--set", "models.film=thesis", "--set",
              "surface.gt_product=0.17");
  g_assert_cmpfloat(cli_number(root, "life.first_failure"), ==, 1);
  g_assert_true(JSON_NODE_HOLDS_NULL(cli_at(root, "life.roughness_last")));
  JsonObject *reasons = json_node_get_object(cli_at(root, "reasons"));
  g_assert_nonnull(strstr(json_object_get_string_member(reasons, "life.roughness_last"),
                          "the life ends at actuation 1"));
  json_node_unref(root);
}

// The parts' joints: as many columns as reactions, whose largest are the JSON's.
static void test_bodies(void) {
  g_autofree char *out = g_build_filename(cli.folder, "bodies", NULL);
  CliResult run = CLI("run", cli.scene, "-o", out, "--set", "models.motion=bodies", "--set",
                      "models.film=thesis", "--set", "output.frames=60", "--quiet");
  g_assert_cmpint(run.code, ==, 0);
  cli_clear(&run);
  g_autofree char *text = cli_contents(out, "results.json");
  JsonNode *root = cli_parse(text);
  JsonArray *joints = json_node_get_array(cli_at(root, "bodies.joints"));
  g_auto(GStrv) rows = rows_of(out, "cycle.csv");
  g_auto(GStrv) heading = g_strsplit(rows[0], ",", -1);
  guint first = g_strv_length(heading) - json_array_get_length(joints);
  for (guint k = 0; k < json_array_get_length(joints); k++) {
    g_assert_true(g_str_has_prefix(heading[first + k], "reaction_"));
    double most = -HUGE_VAL;
    for (char **row = rows + 1; *row != NULL; row++) {
      g_auto(GStrv) cells = g_strsplit(*row, ",", -1);
      most = fmax(most, g_ascii_strtod(cells[first + k], NULL));
    }
    g_autofree char *path = g_strdup_printf("bodies.joints.%u.force_axial_max_N", k);
    double all = cli_number(root, path);
    g_assert_cmpfloat(fabs(most - all), <=, 1e-9 * fabs(all));
  }
  json_node_unref(root);
  cli_remove_results(out);
}

// One run of the bench for its table, its folder and its picture.
static void test_bench(void) {
  g_autofree char *out = g_build_filename(cli.folder, "bench", NULL);
  CliResult table = CLI("bench", "--quick", "-o", out);
  g_assert_cmpstr(table.err, ==, "");
  g_assert_cmpint(table.code, ==, 0);
  g_autofree char *text = cli_contents(out, "bench.json");
  JsonNode *root = cli_parse(text);
  JsonArray *cases = json_node_get_array(cli_at(root, "cases"));
  g_auto(GStrv) lines = g_strsplit(g_strchomp(table.out), "\n", -1);
  // An empty line and the head of the start-up are between the cases and its commands.
  JsonNode *start_up = cli_at(root, "start_up");
  JsonArray *commands = json_node_get_array(cli_at(start_up, "commands"));
  cli_has_keys(start_up, "empty_program_s limit_s shared_objects commands");
  g_assert_cmpfloat(cli_number(start_up, "limit_s"), >=, 15e-3);
  g_assert_cmpfloat(cli_number(start_up, "shared_objects"), >, 0);
  g_assert_cmpuint(g_strv_length(lines), ==,
                   json_array_get_length(cases) + 3 + json_array_get_length(commands));
  for (guint i = 0; i < json_array_get_length(commands); i++) {
    JsonNode *row = json_array_get_element(commands, i);
    cli_has_keys(row, "command processor_s");
    g_assert_cmpfloat(cli_number(row, "processor_s"), >, 0);
  }
  for (guint i = 0; i < json_array_get_length(cases); i++) {
    JsonNode *row = json_array_get_element(cases, i);
    g_assert_true(g_str_has_prefix(lines[i + 1], json_node_get_string(cli_at(row, "solver"))));
    g_assert_nonnull(strstr(lines[i + 1], json_node_get_string(cli_at(row, "case"))));
    cli_has_keys(row, "solver case unknowns iterations wall_s error error_estimate order");
    // Solved films keep what their tolerance promised, against independent figures.
    if (strcmp(json_node_get_string(cli_at(row, "solver")), "reynolds") == 0) {
      g_assert_cmpfloat(cli_number(row, "error"), <, 1e-3);
    }
  }
  json_node_unref(root);
  cli_clear(&table);
  static const char *const names[] = {"bench.json", "bench.png", ".sealbench-bench.manifest"};
  for (size_t i = 0; i < G_N_ELEMENTS(names); i++) {
    g_autofree char *path = g_build_filename(out, names[i], NULL);
    if (i == 1) {
      g_autofree char *bytes = NULL;
      gsize length = 0;
      g_assert_true(g_file_get_contents(path, &bytes, &length, NULL));
      g_assert_cmpint(memcmp(bytes, "\x89PNG", 4), ==, 0);
      g_assert_cmpuint(length, >, 10000);
    }
    g_assert_cmpint(g_unlink(path), ==, 0);
  }
  g_assert_cmpint(g_rmdir(out), ==, 0);
}

// Every key, model and view of the JSON stands in the list for people.
static void test_lists(void) {
  static const struct {
    const char *list, *member;
  } lists[] = {{"params", "key"}, {"models", "name"}, {"views", "name"}, {"fluids", "key"}};
  for (size_t i = 0; i < G_N_ELEMENTS(lists); i++) {
    CliResult table = CLI("list", lists[i].list);
    g_assert_cmpint(table.code, ==, 0);
    JsonNode *root = JSON("list", lists[i].list);
    JsonArray *rows = json_node_get_array(root);
    g_assert_cmpuint(json_array_get_length(rows), >, 8);
    for (guint k = 0; k < json_array_get_length(rows); k++) {
      const char *name =
          json_node_get_string(cli_at(json_array_get_element(rows, k), lists[i].member));
      bool one_seal =
          g_str_has_prefix(name, "seal.outer.") || g_str_has_prefix(name, "seal.inner.");
      if (!one_seal && strstr(table.out, name) == NULL) {
        g_error("list %s lacks %s", lists[i].list, name);
      }
    }
    json_node_unref(root);
    cli_clear(&table);
  }
  CliResult table = CLI("asperity", "--lambda", "3");
  JsonNode *root = JSON("asperity", "--lambda", "3");
  g_assert_cmpfloat(g_ascii_strtod(shown(table.out, "F2"), NULL), ==, cli_number(root, "F2"));
  g_assert_cmpfloat(g_ascii_strtod(shown(table.out, "F5/2"), NULL), ==, cli_number(root, "F5_2"));
  json_node_unref(root);
  cli_clear(&table);
  table = CLI("asperity", "--lambda", "60");
  g_assert_nonnull(strstr(table.out, "Warnings\n  asperity-underflow"));
  cli_clear(&table);
  root = JSON("asperity", "--lambda", "60");
  g_assert_cmpstr(json_node_get_string(cli_at(root, "warnings.0.code")), ==, "asperity-underflow");
  json_node_unref(root);
}

// The JSON has what the table shows, each figure with its source and uncertainty or a reason.
static void test_fluid(void) {
  CliResult table = CLI("fluid", "HFO-1234ze(E)", "--temperature", "20 °C");
  JsonNode *root = JSON("fluid", "hfo-1234ze(e)", "--temperature", "293.15K");
  cli_has_keys(root, "fluid temperature_K pressure_saturation_Pa density_liquid_kg_per_m3 "
                     "density_vapour_kg_per_m3 viscosity_liquid_Pa_s surface_tension_N_per_m "
                     "enthalpy_vaporisation_J_per_kg molar_mass_kg_per_mol gwp100 "
                     "sources.viscosity_liquid uncertainty.density_vapour");
  g_assert_cmpstr(json_node_get_string(cli_at(root, "fluid")), ==, "hfo-1234ze(e)");
  g_assert_cmpfloat_with_epsilon(cli_number(root, "pressure_saturation_Pa"), 427343, 4);
  SAME(table.out, "Saturation pressure", root, "pressure_saturation_Pa", 1e-3);
  SAME(table.out, "Viscosity, liquid", root, "viscosity_liquid_Pa_s", 1e3);
  g_assert_cmpfloat(cli_number(root, "uncertainty.viscosity_liquid"), ==, 0.02);
  g_assert_cmpstr(json_node_get_string(cli_at(root, "uncertainty_by.viscosity_liquid")), ==,
                  "source");
  g_assert_cmpfloat(cli_number(root, "uncertainty.surface_tension"), ==, 0.03);
  g_assert_cmpstr(json_node_get_string(cli_at(root, "uncertainty_by.surface_tension")), ==,
                  "estimated here");
  json_node_unref(root);
  cli_clear(&table);
  root = JSON("fluid", "silicone-350", "--temperature", "25degC");
  g_assert_true(json_node_is_null(cli_at(root, "pressure_saturation_Pa")));
  cli_has_keys(root, "reasons.pressure_saturation_Pa sources.density_liquid");
  json_node_unref(root);
  root = JSON("fluid", "hfa-152a", "--temperature", "20degC", "--ethanol", "10%");
  g_assert_true(json_node_get_boolean(cli_at(root, "estimate")));
  g_assert_cmpfloat(cli_number(root, "ethanol_mass_share"), ==, 0.1);
  g_assert_cmpstr(json_node_get_string(cli_at(root, "warnings.0.code")), ==, "mixture-estimate");
  cli_has_keys(root, "reasons.surface_tension_N_per_m");
  json_node_unref(root);
}

// Results say which values follow from a named fluid, and from where; one that is set does not.
static void test_follows(void) {
  JsonNode *root = JSON("run", cli.scene, "--quiet", "--set", "fluid.name=hfa-134a", "--set",
                        "canister.temperature=24.3degC", "--set", "fluid.density=1200 kg/m3");
  JsonObject *follows = json_node_get_object(cli_at(root, "follows"));
  // And the two sizes of the stem and the entry, which follow the bore, and the chamber's length,
  // which follows the grooves.
  g_assert_cmpuint(json_object_get_size(follows), ==, 5);
  JsonNode *pressure = json_object_get_member(follows, "canister.pressure");
  cli_has_keys(pressure, "source tag");
  g_assert_cmpfloat_with_epsilon(cli_number(pressure, "value"), 0.55e6, 0.55e6 * 3e-3);
  g_assert_cmpstr(json_node_get_string(cli_at(pressure, "unit")), ==, "Pa");
  g_assert_cmpstr(json_node_get_string(cli_at(pressure, "from")), ==, "fluid.name");
  g_assert_cmpstr(json_node_get_string(cli_at(pressure, "name")), ==, "hfa-134a");
  g_assert_true(json_object_has_member(follows, "fluid.viscosity"));
  json_node_unref(root);
}

static void test_thesis(void) {
  JsonNode *list = JSON("thesis");
  g_assert_cmpuint(json_array_get_length(json_node_get_array(list)), >, 40);
  g_assert_cmpstr(json_node_get_string(cli_at(list, "0.item")), ==, "table-2.1");
  json_node_unref(list);
  JsonNode *root = JSON("thesis", "table-7.6");
  g_assert_cmpstr(json_node_get_string(cli_at(root, "item")), ==, "table-7.6");
  cli_has_keys(root,
               "rows.0.label rows.0.printed rows.0.thesis_model rows.0.consistent rows.0.unit "
               "rows.0.difference rows.0.reason rows.0.remains rows.0.reasons");
  // The misprint of the exponent, which its reason explains whole.
  g_assert_cmpfloat_with_epsilon(cli_number(root, "rows.2.printed"), 2.8e-7, 1e-18);
  g_assert_cmpfloat_with_epsilon(cli_number(root, "rows.2.thesis_model"), 2.8e-9, 1e-18);
  g_assert_cmpfloat_with_epsilon(cli_number(root, "rows.2.reasons.0.explains"), 2.772e-7, 1e-18);
  g_assert_cmpfloat_with_epsilon(cli_number(root, "rows.2.remains"), 0, 1e-18);
  json_node_unref(root);

  g_autofree char *folder = g_build_filename(cli.folder, "thesis", NULL);
  CliResult result = CLI("thesis", "figure-6.5", "-o", folder, "--quiet");
  g_assert_cmpint(result.code, ==, 0);
  cli_clear(&result);
  static const char *const names[] = {"figure-6.5.csv", "figure-6.5.json",
                                      "figure-6.5.svg", "index.html",
                                      "thesis.md",      ".sealbench-thesis.manifest"};
  for (size_t i = 0; i < G_N_ELEMENTS(names); i++) {
    g_autofree char *text = cli_contents(folder, names[i]);
    g_assert_cmpuint(strlen(text), >, 0);
    g_autofree char *path = g_build_filename(folder, names[i], NULL);
    g_assert_cmpint(g_unlink(path), ==, 0);
  }
  g_assert_cmpint(g_rmdir(folder), ==, 0);
  static const struct {
    const char *argument[3], *said;
  } wrong[] = {{{"table-7.55"}, "there is no table or figure"},
               {{"--all", "table-7.5"}, "one or the other"},
               {{"-o", "out"}, "needs an item"}};
  for (size_t i = 0; i < G_N_ELEMENTS(wrong); i++) {
    result = CLI("thesis", wrong[i].argument[0], wrong[i].argument[1]);
    g_assert_cmpint(result.code, ==, 1);
    g_assert_nonnull(strstr(result.err, wrong[i].said));
    cli_clear(&result);
  }
}

// Column `name` of a row of a table with its heading; NAN: the cell is empty.
static double cell_of(char **rows, size_t row, const char *name) {
  g_auto(GStrv) heads = g_strsplit(rows[0], ",", -1);
  g_auto(GStrv) cells = g_strsplit(rows[row], ",", -1);
  for (size_t i = 0; heads[i] != NULL; i++) {
    if (strcmp(heads[i], name) == 0) {
      return *cells[i] != '\0' ? g_ascii_strtod(cells[i], NULL) : NAN;
    }
  }
  g_error("no column %s", name);
}

// A state of contact has one peak pressure: that of the JSON and the table is the maximum of the
// profile to rounding. The film that is solved on a half-plane has a pressure of its own.
static void test_peak(void) {
  g_autofree char *out = g_build_filename(cli.folder, "peak", NULL);
  g_autofree char *scene = scene_named("thesis-cycle.scene");
  CliResult table = CLI("run", scene, "--all", "-o", out);
  g_assert_cmpint(table.code, ==, 0);
  g_autofree char *text = cli_contents(out, "results.json");
  JsonNode *root = cli_parse(text);
  const double reported = cli_number(root, "seals.outer.pressure_peak_Pa");
  g_auto(GStrv) rows = rows_of(out, "profiles.csv");
  double frame = NAN, peak = 0, film = 0;
  for (size_t i = 1; rows[i] != NULL; i++) {
    const bool sliding = !isnan(cell_of(rows, i, "film_pressure [Pa]"));
    if (strstr(rows[i], ",outer,") == NULL || !sliding) {
      continue;
    }
    frame = isnan(frame) ? cell_of(rows, i, "frame") : frame;
    if (cell_of(rows, i, "frame") == frame) {
      peak = fmax(peak, cell_of(rows, i, "pressure [Pa]"));
      film = fmax(film, cell_of(rows, i, "film_pressure [Pa]"));
    }
  }
  g_assert_cmpfloat_with_epsilon(peak / reported, 1, 1e-12);
  g_assert_cmpfloat(film, <, 0.95 * reported);
  g_assert_nonnull(strstr(table.out, "Peak pressure                        1.407 MPa"));
  json_node_unref(root);
  cli_clear(&table);
}

int main(int argc, char **argv) {
  g_test_init(&argc, &argv, NULL);
  cli_set_up();
  g_test_add_func("/cli-tables/fit", test_fit);
  g_test_add_func("/cli-tables/peak", test_peak);
  g_test_add_func("/cli-tables/rig", test_rig);
  g_test_add_func("/cli-tables/life", test_life);
  g_test_add_func("/cli-tables/bodies", test_bodies);
  g_test_add_func("/cli-tables/bench", test_bench);
  g_test_add_func("/cli-tables/lists", test_lists);
  g_test_add_func("/cli-tables/fluid", test_fluid);
  g_test_add_func("/cli-tables/follows", test_follows);
  g_test_add_func("/cli-tables/thesis", test_thesis);
  int result = g_test_run();
  cli_tear_down();
  return result;
}
