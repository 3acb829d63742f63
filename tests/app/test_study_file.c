// Study files: what is refused and where, and the points that are laid out.
#include "app/document/study_file.h"

#include "app/document/expression.h"

#include "engine/valve/sealbench.h"
#include "engine/valve/studies/study.h"

#include <glib/gstdio.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static char *folder;

static SbStudyFile *load(const char *groups, GPtrArray *issues) {
  g_autofree char *path = g_build_filename(folder, "x.study", NULL);
  g_autofree char *text = g_strdup_printf("[sealbench]\nformat = 1\nkind = study\n"
                                          "scene = %s/scenes/thesis-cycle.scene\n%s",
                                          g_getenv("SEALBENCH_ASSETS"), groups);
  g_assert_true(g_file_set_contents(path, text, -1, NULL));
  return sb_study_file_load(path, NULL, issues);
}

#define STUDY  "\n[study]\nsamples = 100\n"
#define LEVELS "gland.radial_space = levels 1.36 mm\n"

// One line each, with the place.
static void test_refused(void) {
  static const struct {
    const char *groups, *said;
  } cases[] = {
      {"[vary]\ngland.radialspace = levels 1 mm" STUDY,
       "[vary] gland.radialspace: there is no such parameter, do you mean gland.radial_space?"},
      {"[vary]\ngland.radial_space = uniform 1.3 mm .. 1.4 N" STUDY,
       "\"N\" is a unit of another kind, expected mm"},
      {"[vary]\ngland.radial_space = uniform 1.4 mm .. 1.3 mm" STUDY, "does not rise"},
      {"[vary]\ngland.radial_space = uniform 1.3 mm .. 1.3 mm" STUDY, "does not rise"},
      {"[vary]\ngland.radial_space = uniform 1.3 mm .. 9 m" STUDY,
       "9000 mm is out of range (allowed 0.1 to 20 mm)"},
      {"[vary]\ngland.radial_space = uniform 1.3 mm .. 1.4 mm # wide" STUDY, "x.study:"},
      {"[vary]\ngland.radial_space = normal 1.36 mm, -0.01 mm" STUDY,
       "the deviation \"-0.01 mm\" is not above 0"},
      {"[vary]\ngland.radial_space = normal 1.36 mm, 0.01 mm within 1.5 mm .. 1.6 mm" STUDY,
       "more than 6 deviations"},
      {"[vary]\ncanister.temperature = normal 20 °C, 2 °C" STUDY, "canister.temperature"},
      {"[vary]\ngland.radial_space = triangle 1 mm, 2 mm" STUDY,
       "\"triangle 1 mm, 2 mm\" is not a distribution (allowed uniform A .. B[, N]"},
      {"[vary]\nsurface.gt_product = loguniform 0 .. 0.2" STUDY, "surface.gt_product"},
      {"[vary]\nfluid.name = uniform custom .. hfa-134a" STUDY, "only levels suit a choice"},
      {"[vary]\nfluid.name = levels hfa-134b" STUDY, "fluid.name"},
      {"[vary]\n" LEVELS
       "\n[study]\nmethod = monte-carlo\nsamples = 100\n[leakage_test]\nmean = 5 m\n"
       "temperature = 20 °C\n",
       "[leakage_test] mean: \"5 m\" is out of range or no such number (allowed 0 to 1e+07 mg)"},
      {"[vary]\n" LEVELS "\n[study]\nmethod = monte-carlo\nsamples = 100\n[leakage_test]\n"
       "temperature = 25 °C\n",
       "the test is at 25.0 °C and the scene's canister.temperature 20.0 °C"},
      {"[vary]\n" LEVELS "\n[study]\nmethod = grid\n[leakage_test]\ntemperature = 20 °C\n",
       "a leakage test draws its cans"},
      {STUDY, "vary: nothing varies"},
      {"[vary]\n" LEVELS, "samples: is missing"},
      {"[vary]\n" LEVELS "[study]\nsamples = 0\n", "is not a number of samples"},
      {"[vary]\n" LEVELS "[study]\nsamples = 1e9\n", "is not a number of samples"},
      {"[vary]\n" LEVELS STUDY "method = guess\n",
       "there is no such method (allowed grid, monte-carlo, "},
      {"[vary]\n" LEVELS STUDY "figures = cycle.force\n", "there is no figure \"cycle.force\""},
      {"[vary]\n" LEVELS STUDY "colour = red\n", "[study] colour: unknown key"},
      {"[vary]\n" LEVELS STUDY "[limits]\ncycle.force_braekaway_N = <= 30 N\n",
       "there is no such figure, do you mean cycle.force_breakaway_N?"},
      {"[vary]\n" LEVELS STUDY "[limits]\ncycle.force_breakaway_N = <= 30 mm\n",
       "\"mm\" is a unit of another kind, expected N"},
      {"[vary]\ngland.radial_space = uniform 1.3 mm .. 1.4 mm\n[study]\nmethod = grid\n",
       "a grid needs levels, or a range with a number of points"},
      {"[vary]\n" LEVELS "bore.diameter = levels 6 mm" STUDY
       "method = monte-carlo\n[correlation]\ngland.radial_space, stem.mass = 0.2\n",
       "does not name two parameters of [vary]"},
      {"[vary]\n" LEVELS "bore.diameter = levels 6 mm" STUDY
       "[correlation]\ngland.radial_space, bore.diameter = 1.2\n",
       "is not a correlation (allowed between -1 and 1)"},
      {"[vary]\nfluid.name = levels hfa-134a, hfa-152a" STUDY
       "method = reliability\n[limits]\ncycle.force_breakaway_N = <= 30 N\n",
       "[vary] fluid.name: the method reliability accepts no levels"},
      {"[vary]\ngland.radial_space = uniform 1.3 mm .. 1.4 mm" STUDY "method = reliability\n",
       "limits: the method reliability needs limits"},
#define SPACE "[vary]\ngland.radial_space = uniform 1.3 mm .. 1.4 mm\n"
#define LEAST "[design]\nobjective = minimise cycle.force_breakaway_N\n"
      {SPACE "[design]\nobjective = minimise cycle.force\n",
       "[design] objective: there is no figure \"cycle.force\""},
      {SPACE "[design]\nobjective = least cycle.force_breakaway_N\n", "is not an objective"},
      {SPACE "[design]\nobjective = minimise cycle.returns\n", "a yes or no is not an objective"},
      {SPACE "[design]\nstarts = 3\n", "[design] objective: is missing"},
      {SPACE LEAST "colour = red\n", "[design] colour: unknown key"},
      {SPACE LEAST "robust = 1\n", "is not a probability that all limits hold"},
      {SPACE LEAST "robust = 0.99\n", "[design] robust: needs [tolerances]"},
      {SPACE LEAST "[tolerances]\ngland.radial_space = normal 0 mm, -0.01 mm\n",
       "[tolerances] gland.radial_space: the deviation \"-0.01 mm\" is not above 0"},
      {SPACE LEAST "[tolerances]\ngland.radial_space = normal 0 mm, 0.01 N\n",
       "\"N\" is a unit of another kind, expected mm"},
      {SPACE LEAST "[tolerances]\ngland.radial_space = levels 0 mm\n", "is not a tolerance"},
      {"[vary]\nseal.outer.section_diameter = uniform 1.5 mm .. 1.6 mm\n" LEAST
       "[tolerances]\nseal.section_diameter = normal 0 mm, 0.01 mm\n",
       "[tolerances] seal.section_diameter: seal.outer.section_diameter varies, which this does "
       "not"},
      {"[vary]\ngland.radial_space = normal 1.36 mm, 0.01 mm\n" LEAST,
       "[vary] gland.radial_space: a design requires bounds, or one value"},
      {"[vary]\n" LEVELS LEAST, "a design needs bounds: nothing is free"},
      {"[varied]\n" LEVELS STUDY, "unknown group [varied]"},
#define GRID "\n[study]\nmethod = grid\n"
      {"[vary]\nspace = levels 1, 2" STUDY, "[vary] space: variables, expressions and groups"},
      {"[vary rings]\n" LEVELS STUDY, "belong to a grid"},
      {"[vary]\nspace = uniform 0 .. 1" GRID, "[vary] space: a grid needs levels"},
      {"[vary]\nspace = levels 1 mm" GRID,
       "[vary] space: \"mm\" is a unit of another kind: this value has none"},
      {"[vary]\nspace = levels 1\ngland.radial_space = by 2 * spaec" GRID,
       "there is no parameter and no variable at \"spaec\""},
      {"[vary]\nspace = levels 1\ngland.radial_space = by 2 *" GRID, "there is no value at \"\""},
      {"[vary]\nspace = levels 1\ngland.radial_space = by (space" GRID, "a parenthesis is missing"},
      {"[vary]\nspace = levels 1\ngland.radial_space = by space space" GRID,
       "an operator is missing"},
      {"[vary]\nspace = levels 1\ngland.radial_space = by space - 1 N" GRID,
       "is a unit of another kind, expected mm"},
      {"[vary]\ngland.radial_space = by bore.diameter" GRID, "requires the levels of a parameter"},
      {"[vary]\ngland.radial_space = uniform 1.3 mm .. 1.4 mm and 1.5 mm" GRID,
       "has no number of points to add levels to"},
      {"[vary]\n" LEVELS GRID "hold = me\n",
       "no group of parameters can be fixed by this name (allowed machine, outer-seal, saturated)"},
  };
  for (size_t i = 0; i < G_N_ELEMENTS(cases); i++) {
    g_autoptr(GPtrArray) issues = sb_issues_new();
    g_autoptr(SbStudyFile) study = load(cases[i].groups, issues);
    if (study != NULL) {
      g_error("case %zu is read", i);
    }
    g_assert_cmpuint(issues->len, >=, 1);
    g_autofree char *line = sb_issue_line(issues->pdata[0]);
    if (strstr(line, cases[i].said) == NULL || strstr(line, "x.study") == NULL) {
      g_error("case %zu: \"%s\" lacks \"%s\"", i, line, cases[i].said);
    }
    // One complaint of a line: nothing is said twice.
    if (issues->len > 1 && strstr(cases[i].groups, "[varied]") == NULL) {
      g_autofree char *second = sb_issue_line(issues->pdata[1]);
      g_error("case %zu: \"%s\" and \"%s\"", i, line, second);
    }
  }
}

// A grid runs every combination, the last parameter fastest, ends exactly.
static void test_grid(void) {
  g_autoptr(GPtrArray) issues = sb_issues_new();
  g_autoptr(SbStudyFile) study =
      load("[vary]\ngland.radial_space = uniform 1.3 mm .. 1.4 mm, 3\n"
           "fluid.name = levels hfa-134a, hfa-152a\n[study]\nmethod = grid\n",
           issues);
  g_assert_nonnull(study);
  g_assert_cmpuint(study->samples, ==, 6);
  g_assert_cmpuint(study->figures->len, ==, SB_FIGURE_COUNT);
  double *value = NULL;
  g_assert_cmpint(sb_study_file_points(&value, NULL, study, NULL), ==, SB_OK);
  g_assert_cmpfloat(value[0], ==, 1.3e-3);
  g_assert_cmpfloat(value[2], ==, 1.3e-3);
  g_assert_cmpfloat(value[10], ==, 1.4e-3);
  g_assert_cmpfloat(value[1], ==, value[5]);
  g_assert_cmpfloat(value[1], !=, value[3]);
  free(value);
}

// Several grids in one file: what a group has not is as in the scene, what follows follows from the
// scene's values and the variables, in the order of the file.
static void test_groups(void) {
  enum { SQUEEZE, FLOOR, GAP, BORE, FIT, PRESSURE, COLUMNS };
  g_autoptr(GPtrArray) issues = sb_issues_new();
  g_autoptr(SbStudyFile) study =
      load("[study]\nmethod = grid\nhold = machine\nfigures = seals.outer.load_N\n"
           "[vary rings]\n"
           "squeeze = levels 10 %, 1 - gland.radial_space / seal.outer.section_diameter\n"
           "[vary]\n"
           "floor = by bore.diameter - 2 * gland.radial_space\n"
           "gland.radial_space = by -(squeeze - 1) * seal.outer.section_diameter + 0.02 mm\n"
           "bore.diameter = by floor + max(0; 2) * gland.radial_space * min(1; 3)\n"
           "models.fit = levels disc, models.fit\n"
           "[vary pressure]\n"
           "canister.pressure = uniform 0 Pa .. canister.pressure, 3 and 0.1 MPa\n",
           issues);
  g_assert_nonnull(study);
  g_assert_cmpuint(study->samples, ==, 2 * 2 + 2 * 4);
  g_assert_cmpuint(study->vary->len, ==, COLUMNS);
  double *value = NULL;
  g_assert_cmpint(sb_study_file_points(&value, NULL, study, NULL), ==, SB_OK);
  for (size_t i = 0; i < study->samples; i++) {
    const double *row = value + i * COLUMNS;
    const bool first = i < 4;
    const double squeeze = !first ? 0 : i % 2 == 0 ? 0.1 : 1 - 1.36 / 1.61;
    size_t line;
    double x;
    sb_study_grid_place(&line, &x, study, i);
    g_assert_cmpuint(line, ==, first ? i / 2 : 2 + (i - 4) / 4);
    g_assert_cmpfloat(x, ==, row[first ? SQUEEZE : PRESSURE]);
    g_assert_true(first ? fabs(row[SQUEEZE] - squeeze) < 1e-15 : isnan(row[SQUEEZE]));
    g_assert_true(isnan(row[PRESSURE]) == first);
    g_assert_cmpfloat(fabs(row[FLOOR] - 3.28e-3), <, 1e-15);
    g_assert_cmpfloat(fabs(row[GAP] - ((1 - squeeze) * 1.61e-3 + 0.02e-3)), <, 1e-15);
    g_assert_cmpfloat(fabs(row[BORE] - 6e-3), <, 1e-15); // a key is the scene's value
    const bool disc = first ? i < 2 : i < 8;
    g_assert_cmpfloat(row[FIT], ==, disc ? SB_FIT_DISC : SB_FIT_KARASZKIEWICZ);
  }
  g_assert_cmpfloat(value[5 * COLUMNS + PRESSURE], ==, 0.275e6);
  g_assert_cmpfloat(value[7 * COLUMNS + PRESSURE], ==, 0.1e6);
  // The row of a line again, at a place of its own.
  double row[COLUMNS];
  guint grid, column;
  sb_study_grid_row(row, &grid, &column, study, 1);
  g_assert_cmpuint(grid, ==, 1);
  g_assert_cmpuint(column, ==, SQUEEZE);
  sb_study_grid_follow(row, study, grid);
  g_assert_cmpmem(row, sizeof row, value + 2 * COLUMNS, sizeof row);
  free(value);
}

// The files of the studies that are drawn are studies by themselves.
static void test_shipped(void) {
  for (int kind = 0; kind < SB_STUDY_COUNT; kind++) {
    g_autoptr(GPtrArray) issues = sb_issues_new();
    g_autofree char *name = g_strconcat(sb_study_name((SbStudyKind)kind), ".study", NULL);
    g_autofree char *path = g_build_filename(g_getenv("SEALBENCH_ASSETS"), "studies", name, NULL);
    g_assert_true(sb_study_has_grid((SbStudyKind)kind) ==
                  g_file_test(path, G_FILE_TEST_IS_REGULAR));
    if (sb_study_has_grid((SbStudyKind)kind)) {
      g_autoptr(SbStudyFile) study = sb_study_file_load(path, NULL, issues);
      g_assert_cmpuint(issues->len, ==, 0);
      g_assert_cmpuint(study->samples, >, 10);
    }
  }
}

// A deviation in points of hardness has the slope of the relation at the mean.
static void test_hardness(void) {
  static const struct {
    const char *text;
    double deviation; // by hand [Pa]; NaN: refused
  } cases[] = {
      {"[vary]\nseal.modulus = normal 70 ShoreA, 2 ShoreA", 0.510783e6},
      {"[vary]\nseal.outer.modulus = normal 5.5205 MPa, 2 shore a within 60 ShA .. 75 ShA",
       0.51078e6},
      {"[vary]\nseal.modulus = normal 50 IRHD, 3 IRHD", 0.280238e6},
      {"[vary]\nseal.modulus = normal 70 Shore A, 0.5 MPa", 0.5e6},
      {"[vary]\nseal.modulus = normal 0.5 MPa, 2 Shore A", NAN},
      {"[vary]\nhousing.modulus = normal 3 GPa, 2 Shore A", NAN},
  };
  for (size_t i = 0; i < G_N_ELEMENTS(cases); i++) {
    g_autoptr(GPtrArray) issues = sb_issues_new();
    g_autofree char *text = g_strconcat(cases[i].text, "\n[study]\nsamples = 5\n", NULL);
    g_autoptr(SbStudyFile) study = load(text, issues);
    g_assert_true((study != NULL) == !isnan(cases[i].deviation));
    if (study != NULL) {
      const SbVary *vary = &g_array_index(study->vary, SbVary, 0);
      g_assert_cmpfloat(fabs(vary->distribution.b / cases[i].deviation - 1), <, 1e-5);
    }
  }
  g_autoptr(GPtrArray) issues = sb_issues_new();
  g_assert_null(
      load("[vary]\nseal.modulus = normal 0.5 MPa, 2 Shore A\n[study]\nsamples = 5\n", issues));
  g_assert_cmpuint(issues->len, ==, 1);
  g_assert_nonnull(strstr(((SbIssue *)issues->pdata[0])->text, "give it in MPa"));
}

// Normal variates with the correlation that was asked for.
static void test_correlation(void) {
  g_autoptr(GPtrArray) issues = sb_issues_new();
  g_autoptr(SbStudyFile) study = load("[vary]\ngland.radial_space = normal 1.36 mm, 0.01 mm\n"
                                      "bore.diameter = normal 6 mm, 0.02 mm\n"
                                      "[study]\nsamples = 20000\n"
                                      "[correlation]\nbore.diameter, gland.radial_space = 0.8\n",
                                      issues);
  g_assert_nonnull(study);
  double *value = NULL, moment[5] = {0};
  g_assert_cmpint(sb_study_file_points(&value, NULL, study, NULL), ==, SB_OK);
  for (size_t i = 0; i < study->samples; i++) {
    const double x = (value[2 * i] - 1.36e-3) / 1e-5, y = (value[2 * i + 1] - 6e-3) / 2e-5;
    const double of[] = {x, y, x * x, y * y, x * y};
    for (int k = 0; k < 5; k++) {
      moment[k] += of[k] / 20000;
    }
  }
  // Four deviations of each.
  g_assert_cmpfloat(fabs(moment[0]), <, 0.03);
  g_assert_cmpfloat(fabs(moment[2] - 1), <, 0.04);
  g_assert_cmpfloat(fabs(moment[3] - 1), <, 0.04);
  g_assert_cmpfloat(fabs(moment[4] - 0.8), <, 0.04);
  free(value);
}

// Samples are whole trajectories and blocks; settings reach the scene and its hash.
static void test_blocks(void) {
  g_autoptr(GPtrArray) issues = sb_issues_new();
  g_autoptr(SbStudyFile) study = load("[vary]\ngland.radial_space = uniform 1.3 mm .. 1.4 mm\n"
                                      "bore.diameter = uniform 5.9 mm .. 6 mm\n"
                                      "[study]\nmethod = sobol-indices\nsamples = 103\n",
                                      issues);
  g_assert_nonnull(study);
  g_assert_cmpuint(study->samples, ==, 100);
  char *settings[] = {(char *)"friction.shear_strength=2MPa", NULL};
  g_autofree char *path = g_build_filename(folder, "x.study", NULL);
  g_autoptr(SbStudyFile) other = sb_study_file_load(path, settings, issues);
  g_assert_nonnull(other);
  g_assert_cmpstr(other->base_sha256, !=, study->base_sha256);
}

// A figure of the rubber that only another propellant brings into force tells bases apart.
static void test_rubber(void) {
  static const char *const swell[] = {"hfa-134a = 17 %", "hfa-134a = 16 %"};
  g_autofree char *source =
      g_build_filename(g_getenv("SEALBENCH_ASSETS"), "rubbers", "nitrile.rubber", NULL);
  g_autofree char *path = g_build_filename(folder, "x.study", NULL);
  g_autofree char *rubber = g_build_filename(folder, "own.rubber", NULL);
  g_autofree char *shipped = NULL;
  char *hash[2];
  g_assert_true(g_file_get_contents(source, &shipped, NULL, NULL));
  for (int i = 0; i < 2; i++) {
    g_auto(GStrv) parts = g_strsplit(shipped, swell[0], 2);
    g_assert_cmpuint(g_strv_length(parts), ==, 2);
    g_autofree char *text = g_strjoin(swell[i], parts[0], parts[1], NULL);
    g_autofree char *setting = g_strconcat("rubber.name=", rubber, NULL);
    char *settings[] = {setting, NULL};
    g_autoptr(GPtrArray) issues = sb_issues_new();
    g_assert_true(g_file_set_contents(rubber, text, -1, NULL));
    sb_study_file_free(
        load("[vary]\nfluid.name = levels custom, hfa-134a\n[study]\nmethod = grid\n", issues));
    g_autoptr(SbStudyFile) study = sb_study_file_load(path, settings, issues);
    g_assert_cmpuint(issues->len, ==, 0);
    hash[i] = g_strdup(study->base_sha256);
  }
  g_assert_cmpstr(hash[0], !=, hash[1]);
  g_free(hash[0]);
  g_free(hash[1]);
  g_unlink(rubber);
}

static bool no_name(double *out, const char *name, void *data) {
  *out = strcmp(name, "x") == 0 ? 0.5 : NAN;
  return strcmp(name, "x") == 0;
}

static void test_functions(void) {
  static const struct {
    const char *text;
    double value; // NaN: refused
    const char *said;
  } cases[] = {{"pow(2; 3) + max(1; x) - min(1; x)", 8.5, NULL},
               {"sin(x) * sin(x) + cos(x) * cos(x)", 1, NULL},
               {"tan(x) / (sin(x) / cos(x))", 1, NULL},
               {"atan(tan(x))", 0.5, NULL},
               {"ln(exp(2 * x))", 1, NULL},
               {"pow(pow(x; 2); x)", 0.5, NULL},
               {"ln(0)", NAN, "not finite"},
               {"pow(x - 1; x)", NAN, "not finite"},
               {"round(2.4) + single(x)", 2.5, NULL},
               {"half_sommerfeld(0; 1)", 0, NULL},
               {"panel(x; 1) - panel(0 - x; 1)", 0, NULL},
               {"pow(2)", NAN, "pow takes 2 values"},
               {"sin(x; 2)", NAN, "a parenthesis is missing"},
               {"sin x", NAN, "no parameter and no variable"},
               {"sinh(x)", NAN, "no parameter and no variable"}};
  for (size_t i = 0; i < G_N_ELEMENTS(cases); i++) {
    g_autoptr(GError) error = NULL;
    double value = NAN;
    const bool good = sb_expression_value(&value, cases[i].text, "1", "", no_name, NULL, &error);
    g_test_message("%s", cases[i].text);
    g_assert_true(good == !isnan(cases[i].value));
    if (good) {
      g_assert_cmpfloat_with_epsilon(value, cases[i].value, 1e-15);
    } else {
      g_assert_nonnull(strstr(error->message, cases[i].said));
    }
  }
}

int main(int argc, char **argv) {
  g_test_init(&argc, &argv, NULL);
  folder = g_dir_make_tmp("sealbench-study-XXXXXX", NULL);
  g_test_add_func("/study-file/refused", test_refused);
  g_test_add_func("/study-file/functions", test_functions);
  g_test_add_func("/study-file/grid", test_grid);
  g_test_add_func("/study-file/groups", test_groups);
  g_test_add_func("/study-file/shipped", test_shipped);
  g_test_add_func("/study-file/hardness", test_hardness);
  g_test_add_func("/study-file/correlation", test_correlation);
  g_test_add_func("/study-file/blocks", test_blocks);
  g_test_add_func("/study-file/rubber", test_rubber);
  const int failed = g_test_run();
  g_autofree char *path = g_build_filename(folder, "x.study", NULL);
  g_unlink(path);
  g_rmdir(folder);
  g_free(folder);
  return failed;
}
