// What `run` prints: the summary within its lines, the same figures as in the JSON, and with --all
// the full table.
#include "tests/app/cli_fixture.h"

#include "app/cli/run_text.h"
#include "engine/valve/figures/figures.h"

#include <glib/gstdio.h>
#include <math.h>
#include <string.h>

static const char *const keys[] = {
    "cycle.force_breakaway_N",    "cycle.force_press_N", "cycle.force_return_margin_N",
    "seals.outer.load_N",         "seals.inner.load_N",  "seals.outer.pressure_peak_Pa",
    "cycle.leakage_per_cycle_m3", "cycle.energy_loss_J",
};

// Label of a figure with its seal, as the summary prints it.
static char *label_of(const char *key) {
  const SbFigure *figure = sb_figure(sb_figure_find(key));
  return g_strconcat(figure->label, *figure->where != '\0' ? ", " : "", figure->where, NULL);
}

// The line of a summary that begins with a label; NULL if there is none.
static const char *line_of(char **lines, const char *label) {
  g_autofree char *start = g_strconcat("  ", label, "  ", NULL);
  for (char **line = lines; *line != NULL; line++) {
    if (g_str_has_prefix(*line, start)) {
      return g_strchug(*line + strlen(start));
    }
  }
  return NULL;
}

// Checks the size of a summary and returns its lines.
static char **summary_lines(const char *text) {
  char **lines = g_strsplit(text, "\n", -1);
  const guint count = g_strv_length(lines) - 1;
  g_assert_cmpstr(lines[count], ==, "");
  g_assert_cmpuint(count, <=, SB_CLI_SUMMARY_LINES);
  for (guint i = 0; i < count; i++) {
    if (g_utf8_strlen(lines[i], -1) > 80) {
      g_error("\"%s\" has more than 80 columns", lines[i]);
    }
  }
  return lines;
}

// Every key figure: its number is that of the JSON within the printed digits and has its error; one
// that was not computed has a reason.
static void compare_figures(char **lines, JsonNode *root) {
  for (size_t i = 0; i < G_N_ELEMENTS(keys); i++) {
    g_autofree char *label = label_of(keys[i]);
    const char *line = line_of(lines, label);
    if (line == NULL) {
      g_error("there is no line for %s", label);
    }
    JsonNode *node = cli_at(root, keys[i]);
    if (JSON_NODE_HOLDS_NULL(node)) {
      g_assert_true(g_str_has_prefix(line, "- ("));
      continue;
    }
    char *rest = NULL;
    const double printed = g_ascii_strtod(line, &rest), value = json_node_get_double(node);
    static const struct {
      const char *unit;
      double of_si;
    } units[] = {{"N", 1}, {"MPa", 1e-6}, {"pl", 1e15}, {"nl", 1e12}, {"ul", 1e9}, {"mJ", 1e3}};
    g_auto(GStrv) words = g_strsplit(g_strchug(rest), " ", 2);
    double shown = NAN;
    for (size_t k = 0; k < G_N_ELEMENTS(units); k++) {
      shown = strcmp(words[0], units[k].unit) == 0 ? value * units[k].of_si : shown;
    }
    // The leakage of piston.scene is known to 26 % and has two digits; others have four.
    g_assert_cmpfloat(fabs(printed - shown), <=, 0.06 * fabs(shown));
    g_assert_nonnull(strstr(line, " ± "));
  }
}

static void check_summary(const char *scene, const char *const set[2]) {
  CliResult text = CLI("run", scene, "--set", set[0], "--set", set[1]);
  CliResult json = CLI("run", scene, "--set", set[0], "--set", set[1], "--json", "-");
  g_auto(GStrv) lines = summary_lines(text.out);
  g_assert_cmpint(text.code, ==, json.code);
  JsonNode *root = cli_parse(json.out);
  compare_figures(lines, root);
  const guint warnings = json_array_get_length(json_node_get_array(cli_at(root, "warnings")));
  g_autofree char *number =
      warnings > 0 ? g_strdup_printf("\n%u warning", warnings) : g_strdup("\nNo warnings");
  g_assert_nonnull(strstr(text.out, number));
  g_assert_nonnull(strstr(text.out, "--all"));
  g_assert_nonnull(strstr(text.out, "Force / N over "));
  json_node_unref(root);
  cli_clear(&json);
  cli_clear(&text);
}

// Scenes that return, are stuck, never move, have no valve, and a run that does not converge.
static void test_summary(void) {
  g_autofree char *folder = g_path_get_dirname(cli.scene);
  static const struct {
    const char *scene, *set[2];
  } cases[] = {
      {"quick-look.scene", {"output.frames=50", "output.frames=50"}},
      {"thesis-cycle.scene", {"surface.gt_product=0.17", "models.film=thesis"}},
      {"quick-look.scene", {"drive.reversal_force=5 N", "output.frames=50"}},
      {"sliding-plate.scene", {"output.frames=500", "output.frames=500"}},
      {"hand-press.scene", {"output.frames=50", "output.frames=50"}},
      {"life-400.scene", {"life.actuations=3", "models.film=thesis"}},
      {"thesis-cycle.scene", {"output.work_limit=1000", "models.film=reynolds"}},
  };
  for (size_t i = 0; i < G_N_ELEMENTS(cases); i++) {
    g_test_message("%s %s %s", cases[i].scene, cases[i].set[0], cases[i].set[1]);
    g_autofree char *scene = g_build_filename(folder, cases[i].scene, NULL);
    check_summary(scene, cases[i].set);
  }
}

// Long reasons in all six answers, long names of cases and a long title: cut, not longer.
static void test_long(void) {
  g_autofree char *path = g_build_filename(cli.folder, "long.scene", NULL);
  g_autofree char *title = g_strnfill(150, 't');
  g_autofree char *name = g_strnfill(120, 'n');
  g_autoptr(GString) text = g_string_new(NULL);
  g_string_append_printf(text,
                         "[sealbench]\nformat = 1\nkind = scene\nvalve = %s\ntitle = %s ähm\n"
                         "[models]\nfilm = thesis\n[output]\nframes = 50\n"
                         "[limits]\ncycle.force_breakaway_N = <= 20 N\n"
                         "cycle.force_return_margin_N = >= 3 N\ncycle.dose_mass_kg = >= 1 kg\n"
                         "seals.outer.leakage_static_m3_per_s = <= 1 pl/s\n"
                         "seals.outer.squeeze = <= 1 %%\nseals.outer.load_N = >= 900 N\n"
                         "[cases]\n%s = canister.pressure=0.9 MPa; surface.gt_product=0.3\n",
                         cli.valve, title, name);
  g_assert_true(g_file_set_contents(path, text->str, -1, NULL));
  CliResult result = CLI("run", path);
  g_assert_cmpint(result.code, ==, 0);
  g_auto(GStrv) lines = summary_lines(result.out);
  static const char *const words[] = {"Seals", "Presses", "Returns", "Doses", "Leak", "Fits"};
  for (size_t i = 0; i < G_N_ELEMENTS(words); i++) {
    g_assert_nonnull(line_of(lines, words[i]));
  }
  cli_clear(&result);
  // The full table cuts nothing.
  result = CLI("run", path, "--all");
  g_autofree char *end = g_strdup_printf(", case %s: ", name);
  g_assert_nonnull(strstr(result.out, end));
  cli_clear(&result);
  g_unlink(path);
}

// A case that its budget of work stops: exit code, stderr, solver.converged and a warning agree.
static void test_failed_case(void) {
  g_autofree char *path = g_build_filename(cli.folder, "failed.scene", NULL);
  g_autofree char *text =
      g_strdup_printf("[sealbench]\nformat = 1\nkind = scene\nvalve = %s\n[limits]\n"
                      "cycle.force_breakaway_N = <= 20 N\n[cases]\n"
                      "spent = models.fit=ring; output.work_limit=10\n",
                      cli.valve);
  g_assert_true(g_file_set_contents(path, text, -1, NULL));
  CliResult result = CLI("run", path, "--json", "-");
  g_assert_cmpint(result.code, ==, 2);
  g_assert_nonnull(strstr(result.err, "case spent: "));
  JsonNode *json = cli_parse(result.out);
  g_assert_false(json_node_get_boolean(cli_at(json, "solver.converged")));
  JsonArray *warnings = json_node_get_array(cli_at(json, "warnings"));
  bool found = false;
  for (guint i = 0; i < json_array_get_length(warnings); i++) {
    JsonObject *warning = json_array_get_object_element(warnings, i);
    found = found || g_str_equal(json_object_get_string_member(warning, "code"), "case-failed");
  }
  g_assert_true(found);
  json_node_unref(json);
  cli_clear(&result);
  g_unlink(path);
}

// --all has every brief figure and the text of each warning; without it there is neither.
static void test_all(void) {
  CliResult all = CLI("run", "quick-look", "--all");
  for (int i = 0; i < SB_FIGURE_COUNT; i++) {
    const SbFigure *figure = sb_figure(i);
    if (figure->brief && g_str_has_prefix(figure->path, "seals.")) {
      g_autofree char *line = g_strdup_printf("\n  %s ", figure->label);
      g_assert_nonnull(strstr(all.out, line));
    }
  }
  g_assert_nonnull(strstr(all.out, "\nWarnings\n  "));
  g_assert_nonnull(strstr(all.out, "\n  Stage B "));
  // The tables of the report, with its groups and all questions of the verdict.
  g_assert_nonnull(strstr(all.out, "\nWho can press it\n  "));
  g_assert_nonnull(strstr(all.out, " N  first slip, the force at its peak\n"));
  g_assert_nonnull(strstr(all.out, "\n  Presses                              no limit is set\n"));
  g_assert_null(strstr(all.out, "Force / N over")); // off a terminal only with --plot
  cli_clear(&all);
  all = CLI("run", "quick-look", "--all", "--plot");
  g_assert_nonnull(strstr(all.out, "Force / N over"));
  cli_clear(&all);
  CliResult plain = CLI("run", "quick-look", "--no-plot");
  g_assert_null(strstr(plain.out, "Force / N over"));
  g_assert_null(strstr(plain.out, "Stage B"));
  g_assert_cmpstr(plain.err, ==, "");
  cli_clear(&plain);
  plain = CLI("run", "quick-look", "--quiet");
  g_assert_cmpstr(plain.out, ==, "");
  cli_clear(&plain);
}

// The line of the folder is one of the lines of the summary.
static void test_folder(void) {
  g_autofree char *out = g_build_filename(cli.folder, "summary", NULL);
  CliResult result = CLI("run", "quick-look", "-o", out);
  g_auto(GStrv) lines = summary_lines(result.out);
  g_autofree char *last = g_strdup_printf("Results are in %s", out);
  g_assert_cmpstr(lines[g_strv_length(lines) - 2], ==, last);
  cli_clear(&result);
  // A measured loop is one line.
  g_autofree char *scene = g_build_filename(out, "measured.scene", NULL);
  g_autofree char *text =
      g_strdup_printf("[sealbench]\nformat = 1\nkind = scene\nvalve = %s\n[models]\n"
                      "fit = karaszkiewicz\nfilm = thesis\n[data]\nfile = cycle.csv\n"
                      "columns = time, displacement, -, force\n",
                      cli.valve);
  g_assert_true(g_file_set_contents(scene, text, -1, NULL));
  result = CLI("run", scene);
  g_assert_cmpint(result.code, ==, 0);
  g_strfreev(summary_lines(result.out));
  g_assert_nonnull(strstr(result.out, "\nMeasured: cycle.csv, difference "));
  cli_clear(&result);
  g_unlink(scene);
  cli_remove_results(out);
}

// Of six long verdicts none loses the case's name or the end of its reason: the loop gives way.
static void test_long_verdicts(void) {
  g_autofree char *valve =
      g_build_filename(g_getenv("SEALBENCH_ASSETS"), "valves", "piston.valve", NULL);
  g_autofree char *scene = g_build_filename(g_get_tmp_dir(), "sealbench-long.scene", NULL);
  g_autofree char *text = g_strconcat(
      "[sealbench]\nformat = 1\nkind = scene\nvalve = ", valve,
      "\n[models]\nfilm = thesis\n[limits]\ncycle.force_press_N = <= 25 N\n"
      "cycle.force_return_margin_N = >= 1 N\ndose.metered_volume_m3 = >= 50 µl\n"
      "seals.outer.leakage_static_m3_per_s = <= 1 nl/min\nseals.outer.squeeze = >= 10 %\n"
      "[cases]\ncold and thick at the tropical corner = seal.section_diameter = 1.63 mm; "
      "gland.radial_space = 1.2 mm\nhard at the least temperature of use = seal.modulus = 60 MPa\n",
      NULL);
  g_assert_true(g_file_set_contents(scene, text, -1, NULL));
  CliResult result = CLI("run", scene);
  g_auto(GStrv) lines = summary_lines(result.out);
  g_assert_null(strstr(result.out, "…"));
  const char *presses = line_of(lines, "Presses");
  g_assert_nonnull(presses);
  g_assert_true(g_str_has_prefix(presses, "no, case hard at the least temperature of use: "));
  cli_clear(&result);
  g_unlink(scene);
}

int main(int argc, char **argv) {
  g_test_init(&argc, &argv, NULL);
  cli_set_up();
  g_test_add_func("/cli-run/summary", test_summary);
  g_test_add_func("/cli-run/long", test_long);
  g_test_add_func("/cli-run/failed-case", test_failed_case);
  g_test_add_func("/cli-run/all", test_all);
  g_test_add_func("/cli-run/long-verdicts", test_long_verdicts);
  g_test_add_func("/cli-run/folder", test_folder);
  int failures = g_test_run();
  cli_tear_down();
  return failures;
}
