// The command film from outside: JSON keys, its options, films through a table of speeds.
#include "tests/app/cli_fixture.h"

#include "app/base/figure_text.h"

#include <glib/gstdio.h>
#include <math.h>
#include <string.h>

static void test_json_film(void) {
  CliResult result =
      CLI("film", "--load", "850.2N/m", "--speed", "20 mm/min", "--radius", "0.805mm", "--modulus",
          "6.5725MPa", "--viscosity", "0.211mPa.s", "--model", "thesis", "--json", "-");
  g_assert_cmpint(result.code, ==, 0);
  JsonNode *root = cli_parse(result.out);
  cli_has_keys(root, "model film_min_m film_central_m film_flux_m pressure_max_Pa "
                     "position_film_min_m position_rupture_m hertz_half_width_m hertz_pressure_Pa "
                     "friction_couette_N_per_m friction_poiseuille_N_per_m moes_M regime valid "
                     "warnings solver.converged solver.unknowns solver.newton_iterations "
                     "solver.continuation_steps solver.residual solver.error_estimate.film_min "
                     "solver.error_estimate.film_central solver.wall_s profile.x_m "
                     "profile.pressure_Pa profile.film_m");
  g_assert_cmpfloat(fabs(cli_number(root, "film_central_m") - 1.720e-9), <, 5e-13);
  g_assert_cmpuint(json_array_get_length(json_node_get_array(cli_at(root, "profile.x_m"))), >=,
                   400);
  json_node_unref(root);
  cli_clear(&result);
  result =
      CLI("film", "--load", "850.2N/m", "--speed", "20 mm/min", "--radius", "0.805mm", "--modulus",
          "6.5725MPa", "--viscosity", "0.211mPa.s", "--model", "karaszkiewicz", "--json", "-");
  root = cli_parse(result.out);
  g_assert_cmpfloat(fabs(cli_number(root, "film_central_m") - 0.282e-9), <, 5e-13);
  json_node_unref(root);
  cli_clear(&result);
}

// The table prints the digits that the error estimate supports, by the rule of figures.
static void test_film_digits(void) {
#define COARSE                                                                                     \
  "film", "--load", "850.2N/m", "--speed", "10mm/s", "--radius", "0.805mm", "--modulus",           \
      "6.5725MPa", "--viscosity", "0.211mPa.s", "--tolerance", "3e-2"
  CliResult json = CLI(COARSE, "--json", "-"), table = CLI(COARSE);
  g_autoptr(JsonNode) root = cli_parse(json.out);
  const double film = 1e9 * cli_number(root, "film_min_m");
  const double error = cli_number(root, "solver.error_estimate.film_min");
  char digits[SB_NUMBER_SIZE];
  sb_number_with_error(digits, film, 5, error);
  g_autofree char *line = g_strdup_printf("  Film, minimum                        %s nm\n", digits);
  if (strstr(table.out, line) == NULL) {
    g_error("%s is not in\n%s", line, table.out);
  }
  cli_clear(&json);
  cli_clear(&table);
}

// The film through a table of speeds: a row for each of the file, steady at first; files that are
// no such table are refused with their line.
static void test_film_history(void) {
#define AT_REST                                                                                    \
  "film", "--load", "850.2N/m", "--radius", "0.805mm", "--modulus", "6.5725MPa", "--viscosity",    \
      "0.211mPa.s", "--json", "-"
  char *path = g_build_filename(cli.folder, "speed.csv", NULL);
  g_assert_true(
      g_file_set_contents(path, "time [s],speed [m/s]\n0,0.1\n1e-3,0.08\n2e-3,0.08\n", -1, NULL));
  CliResult good = CLI(AT_REST, "--history", path);
  g_assert_cmpint(good.code, ==, 0);
  JsonNode *json = cli_parse(good.out);
  const char *const names[] = {"time_s",
                               "film_min_m",
                               "film_central_m",
                               "error_estimate.film_min",
                               "error_estimate.film_central",
                               "friction_N_per_m"};
  double value[G_N_ELEMENTS(names)][3];
  for (size_t k = 0; k < G_N_ELEMENTS(names); k++) {
    g_autofree char *name = g_strconcat("history.", names[k], NULL);
    JsonArray *rows = json_node_get_array(cli_at(json, name));
    g_assert_cmpuint(json_array_get_length(rows), ==, 3);
    for (guint i = 0; i < 3; i++) {
      value[k][i] = json_array_get_double_element(rows, i);
    }
  }
  g_assert_cmpfloat(value[0][1], ==, 1e-3);
  g_assert_cmpfloat_with_epsilon(value[1][0] / cli_number(json, "film_min_m"), 1, 2e-3);
  g_assert_cmpfloat_with_epsilon(value[2][0] / cli_number(json, "film_central_m"), 1, 2e-3);
  for (int i = 0; i < 3; i++) {
    g_assert_cmpfloat(value[1][i], <, value[2][i]);
    g_assert_true(value[3][i] > 0 && value[3][i] < 0.03);
    g_assert_true(value[4][i] > 0 && value[4][i] < 0.01);
    g_assert_cmpfloat(value[5][i], >, 0);
  }
  g_assert_cmpfloat(value[1][2], <, value[1][0]); // slower
  const double steady = cli_number(json, "friction_couette_N_per_m") +
                        cli_number(json, "friction_poiseuille_N_per_m");
  g_assert_cmpfloat_with_epsilon(value[5][0] / steady, 1, 1e-2);
  json_node_unref(json);
  cli_clear(&good);
  static const struct {
    const char *text, *message;
  } bad[] = {{"time [s],speed [m/s]\n0,0.1\n1e-3,0.1\n2e-3,fast\n", "line 4"},
             {"time [s],speed [m/s]\n0,0.1\n1e-3,0.1\n1e-3,0\n", "row 3"},
             {"time [s],speed [m/s]\n0,0\n1e-3,0.1\n", "begins at rest"},
             {"0,0.1\n1e-3,0\n", "column 1 has no heading"}};
  for (size_t k = 0; k < G_N_ELEMENTS(bad); k++) {
    g_assert_true(g_file_set_contents(path, bad[k].text, -1, NULL));
    CliResult refused = CLI(AT_REST, "--history", path);
    g_assert_cmpint(refused.code, ==, 1);
    g_assert_nonnull(strstr(refused.err, "speed.csv"));
    g_assert_nonnull(strstr(refused.err, bad[k].message));
    cli_clear(&refused);
  }
  CliResult both = CLI(AT_REST, "--history", path, "--speed", "1 m/s");
  g_assert_cmpint(both.code, ==, 1);
  g_assert_nonnull(strstr(both.err, "--speed"));
  cli_clear(&both);
  g_free(path);
#undef AT_REST
}

// Contents: friction at rest and in motion, the interval of both closures, and a history that
// starts with a drained contact.
static void test_film_content(void) {
#define CLOSED                                                                                     \
  "film", "--load", "997.7344N/m", "--radius", "0.805mm", "--modulus", "6.5725154MPa",             \
      "--viscosity", "0.211mPa.s", "--surface", "persson", "--shear-strength", "0.388MPa",         \
      "--load-coefficient", "0", "--percolation-threshold", "0.42", "--json", "-"
  CliResult good = CLI(CLOSED, "--speed", "0.3333mm/s", "--sealed", "both", "--content", "57.3nm");
  g_assert_cmpint(good.code, ==, 0);
  JsonNode *json = cli_parse(good.out);
  JsonArray *friction = json_node_get_array(cli_at(json, "intervals.friction_boundary_N_per_m"));
  const double trapped = json_array_get_double_element(friction, 0);
  const double drained = json_array_get_double_element(friction, 1);
  g_assert_cmpfloat(cli_number(json, "friction_boundary_N_per_m"), ==, trapped);
  g_assert_cmpfloat_with_epsilon(drained / 423.6, 1, 5e-3);
  g_assert_cmpfloat_with_epsilon(cli_number(json, "content.closed_m"), 114.6e-9, 0.5e-9);
  const double between = cli_number(json, "content.friction_N_per_m");
  g_assert_true(trapped < between && between < drained);
  json_node_unref(json);
  cli_clear(&good);
  char *path = g_build_filename(cli.folder, "speed.csv", NULL);
  g_assert_true(
      g_file_set_contents(path, "time [s],speed [mm/s]\n0,0\n1e-3,0.3\n30,0.3\n", -1, NULL));
  CliResult started = CLI(CLOSED, "--history", path);
  g_assert_cmpint(started.code, ==, 0);
  json = cli_parse(started.out);
  JsonArray *rows = json_node_get_array(cli_at(json, "history.friction_N_per_m"));
  g_assert_cmpfloat_with_epsilon(json_array_get_double_element(rows, 0) / drained, 1, 5e-3);
  g_assert_cmpfloat_with_epsilon(json_array_get_double_element(rows, 2) / trapped, 1, 1e-2);
  json_node_unref(json);
  cli_clear(&started);
  g_free(path);
  static const struct {
    const char *option, *value, *message;
  } bad[] = {{"--sealed", "wet", "allowed drained, trapped, both"},
             {"--content", "11um", "allowed 0 nm to 10000 nm"},
             {"--content", "-1nm", "out of range"}};
  for (size_t k = 0; k < G_N_ELEMENTS(bad); k++) {
    CliResult refused = CLI(CLOSED, "--speed", "1mm/s", bad[k].option, bad[k].value);
    g_assert_cmpint(refused.code, ==, 1);
    g_assert_nonnull(strstr(refused.err, bad[k].message));
    cli_clear(&refused);
  }
#undef CLOSED
}

static void test_film_options(void) {
#define CONTACT                                                                                    \
  "film", "--load", "850.2N/m", "--speed", "1 m/s", "--radius", "0.805mm", "--modulus",            \
      "6.5725MPa", "--viscosity", "0.211mPa.s"
  CliResult flooded = CLI(CONTACT, "--json", "-");
  CliResult starved = CLI(CONTACT, "--json", "-", "--inlet-film", "20 nm");
  g_assert_cmpint(flooded.code, ==, 0);
  g_assert_cmpint(starved.code, ==, 0);
  JsonNode *one = cli_parse(flooded.out);
  JsonNode *two = cli_parse(starved.out);
  // No roughness, no ratio to it: null with its reason.
  g_assert_true(json_node_is_null(cli_at(one, "film_ratio")));
  g_assert_nonnull(strstr(json_node_get_string(cli_at(one, "reasons.film_ratio")), "smooth"));
  g_assert_false(json_node_get_boolean(cli_at(one, "starved")));
  g_assert_true(json_node_get_boolean(cli_at(two, "starved")));
  g_assert_cmpfloat(cli_number(two, "film_central_m"), <, cli_number(one, "film_central_m"));
  json_node_unref(one);
  json_node_unref(two);
  cli_clear(&flooded);
  cli_clear(&starved);

  // The table's chart and pull take the options given: both are proportional to them.
  double chart[2], pull[2];
  for (int i = 0; i < 2; i++) {
    CliResult table = CLI(CONTACT, "--pressure-viscosity", i == 0 ? "1/GPa" : "3/GPa", "--hamaker",
                          i == 0 ? "1e-21J" : "3e-21J");
    g_assert_cmpint(table.code, ==, 0);
    g_assert_nonnull(strstr(table.out, i == 0 ? "alpha 1/GPa" : "alpha 3/GPa"));
    chart[i] = g_ascii_strtod(strstr(table.out, "g_V ") + 4, NULL);
    pull[i] = g_ascii_strtod(strstr(table.out, "pull (5.17)") + 11, NULL);
    cli_clear(&table);
  }
  g_assert_cmpfloat_with_epsilon(chart[1] / chart[0], 3, 2e-3);
  g_assert_cmpfloat_with_epsilon(pull[1] / pull[0], 3, 2e-3);

  // End pressures that all but open the contact: solved, or said to be not, with the figures of the
  // last solution and their error or with none but the problem's.
  CliResult open = CLI(CONTACT, "--pressure-left", "3.2 MPa", "--json", "-");
  one = cli_parse(open.out);
  if (open.code == 0) {
    g_assert_cmpfloat(cli_number(one, "film_min_m"), >, 0.0);
  } else {
    g_assert_cmpint(open.code, ==, 2);
    bool none = json_node_is_null(cli_at(one, "film_min_m"));
    g_assert_cmpint(json_node_is_null(cli_at(one, "solver.error_estimate.film_min")), ==, none);
    g_assert_cmpint(
        json_object_has_member(json_node_get_object(cli_at(one, "reasons")), "film_min_m"), ==,
        none);
    g_assert_true(none || cli_number(one, "solver.error_estimate.film_min") > 1e-4);
    g_assert_false(json_node_get_boolean(cli_at(one, "valid")));
    g_assert_false(json_node_get_boolean(cli_at(one, "solver.converged")));
    g_assert_cmpfloat(cli_number(one, "hertz_pressure_Pa"), >, 0.0);
  }
  json_node_unref(one);
  cli_clear(&open);

  // The inverse model reads its table; a table that is none gives one line.
  char *path = g_build_filename(cli.folder, "dry.csv", NULL);
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
  CliResult result = CLI(CONTACT, "--json", "-", "--model", "inverse", "--dry-pressure", path);
  g_assert_cmpstr(result.err, ==, "");
  g_assert_cmpint(result.code, ==, 0);
  cli_clear(&result);
  static const char *const bad[] = {"",
                                    "x,p\n0,1\n",
                                    "0,1\n0,2\n1,1\n",
                                    "0 1\n1 nan\n2 3\n",
                                    "0,1,2\n1,2,3\n2,3,4\n",
                                    "0,1\n0x1,2\n2,1\n",
                                    "0,1\n1-2\n2,1\n",
                                    "\xff\xfe"};
  for (size_t i = 0; i < G_N_ELEMENTS(bad); i++) {
    g_assert_true(g_file_set_contents(path, bad[i], -1, NULL));
    result = CLI(CONTACT, "--model", "inverse", "--dry-pressure", path);
    g_assert_cmpint(result.code, ==, 1);
    g_assert_true(g_str_has_prefix(result.err, "sealbench: "));
    cli_clear(&result);
  }
  result = CLI(CONTACT, "--model", "inverse");
  g_assert_cmpint(result.code, ==, 1);
  cli_clear(&result);
  result = CLI(CONTACT, "--model", "wet");
  g_assert_nonnull(strstr(result.err, "moes"));
  cli_clear(&result);
  g_unlink(path);
  g_free(path);
}

int main(int argc, char **argv) {
  g_test_init(&argc, &argv, NULL);
  cli_set_up();
  g_test_add_func("/cli/json/film", test_json_film);
  g_test_add_func("/cli/film-digits", test_film_digits);
  g_test_add_func("/cli/film-options", test_film_options);
  g_test_add_func("/cli/film-history", test_film_history);
  g_test_add_func("/cli/film-content", test_film_content);
  int result = g_test_run();
  cli_tear_down();
  return result;
}
