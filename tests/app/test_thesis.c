// Tables and figures of the thesis: printed files, what definitions are refused, and what fails.
#include "app/document/shipped.h"
#include "app/study/thesis_item.h"

#include <glib/gstdio.h>
#include <math.h>
#include <string.h>

static char *folder;

static void write_file(const char *name, const char *text) {
  g_autofree char *path = g_build_filename(folder, name, NULL);
  g_assert_true(g_file_set_contents(path, text, -1, NULL));
}

static SbPrinted *load(const char *text, GPtrArray *issues) {
  g_autofree char *path = g_build_filename(folder, "printed.csv", NULL);
  write_file("printed.csv", text);
  return sb_printed_load(path, issues);
}

static void test_printed(void) {
  g_autoptr(GPtrArray) issues = sb_issues_new();
  g_autoptr(SbPrinted) printed =
      load("# Source: a book\nname,value\n\"a, b\", 1.50E-3\nc,-\n", issues);
  g_assert_nonnull(printed);
  g_assert_cmpuint(printed->rows->len, ==, 2);
  g_assert_cmpstr(printed->comments->pdata[0], ==, "Source: a book");
  g_assert_cmpstr(sb_printed_cell(printed, 0, "name"), ==, "a, b");
  g_assert_null(sb_printed_cell(printed, 0, "nothing"));
  g_assert_null(sb_printed_cell(printed, 2, "name"));
  double value = 0, half = 0;
  g_assert_true(sb_printed_number(&value, &half, sb_printed_cell(printed, 0, "value")));
  g_assert_cmpfloat(value, ==, 1.5e-3);
  g_assert_cmpfloat_with_epsilon(half, 0.5e-5, 1e-18);
  g_assert_false(sb_printed_number(&value, &half, sb_printed_cell(printed, 1, "value")));
  g_assert_true(sb_printed_number(&value, &half, "14"));
  g_assert_cmpfloat(half, ==, 0.5);
  static const char *const bad[] = {"", "# nothing\n", "a,b\n1\n", "a,b\n\xff,1\n"};
  for (size_t i = 0; i < G_N_ELEMENTS(bad); i++) {
    g_autoptr(GPtrArray) wrong = sb_issues_new();
    g_assert_null(load(bad[i], wrong));
    g_assert_cmpuint(wrong->len, ==, 1);
  }
}

// An item whose one printed row is the squeeze, 15.53 %, of the thesis' ring.
static SbThesisItem *compute(const char *printed, const char *rows, GPtrArray *issues) {
  g_autofree char *scenes = sb_shipped_thesis();
  g_autofree char *csv = g_strdup_printf("squeeze\n%s\n", printed);
  g_autofree char *study = g_strdup_printf(
      "[sealbench]\nformat = 1\nkind = study\ntitle = Squeeze\nscene = %s/valve.scene\n"
      "[printed]\nfile = squeeze.csv\n[study]\nmethod = grid\n"
      "[vary ours]\nd = levels 1.61e-3\nseal.section_diameter = by d\n%s",
      scenes, rows);
  write_file("squeeze.csv", csv);
  write_file("squeeze.study", study);
  g_autofree char *path = g_build_filename(folder, "squeeze.study", NULL);
  return sb_thesis_compute_file(path, 1, NULL, NULL, NULL, issues);
}

#define ROWS "[rows squeeze]\nunit = 1 %\nprinted = squeeze\nthesis = ours: seals.outer.squeeze\n"

static void test_verdicts(void) {
  // The squeeze is 0.25/1.61 = 0.155280.
  static const struct {
    const char *printed, *rows;
    SbThesisVerdict verdict;
    double remains;
  } cases[] = {
      {"0.1553", ROWS, SB_THESIS_AGREES, 0.15528 - 0.1553},
      {"0.1552", ROWS, SB_THESIS_FAILS, 0.15528 - 0.1552},
      {"0.1863", ROWS "reason.1 = a fifth more | sealbench thesis table-7.1 | 1.2 * ours\n",
       SB_THESIS_EXPLAINED, 1.2 * 0.15528 - 0.1863},
      {"0.1900", ROWS "reason.1 = a fifth more | sealbench thesis table-7.1 | 1.2 * ours\n",
       SB_THESIS_FAILS, 1.2 * 0.15528 - 0.19},
      {"0.1900",
       ROWS "reason.1 = a fifth more | sealbench thesis table-7.1 | 1.2 * ours\nremains = 5 %\n",
       SB_THESIS_EXPLAINED, 1.2 * 0.15528 - 0.19},
      {"0.3000",
       ROWS "reason.1 = a fifth | meson test engine-disc | 1.2 * ours\nremains = unknown\n",
       SB_THESIS_PARTLY, 1.2 * 0.15528 - 0.3},
      {"0.1900", ROWS "reason.1 = up to | meson test engine-disc | within 2 * ours\n",
       SB_THESIS_BOUNDED, 0},
      {"0.1900", ROWS "reason.1 = either way | meson test engine-disc | about 0.1\n",
       SB_THESIS_BOUNDED, 0},
      {"0.1900", ROWS "reason.1 = up to | meson test engine-disc | within 1.1 * ours\n",
       SB_THESIS_FAILS, 1.1 * 0.15528 - 0.19},
      // Half of the last printed digit's unit, a hundred times.
      {"0.1600",
       ROWS "reason.1 = its digits | meson test engine-disc | ours + 100 * squeeze.rounding\n",
       SB_THESIS_FAILS, 0.15528 + 0.005 - 0.16},
      {"-", ROWS, SB_THESIS_NOT_PRINTED, NAN},
      // What the consistent set makes of it needs a reason, too.
      {"0.1553", ROWS "consistent = ours: 2 * seals.outer.squeeze\n", SB_THESIS_FAILS,
       0.15528 - 0.1553},
      {"0.1553",
       ROWS
       "consistent = ours: 2 * seals.outer.squeeze\nmodel.1 = twice | meson test engine-disc\n",
       SB_THESIS_AGREES, 0.15528 - 0.1553},
      {"0.1553", "[rows squeeze]\nprinted = squeeze\n", SB_THESIS_FAILS, NAN},
      {"0.1553", "[rows squeeze]\nprinted = squeeze\nthesis = none elsewhere\n",
       SB_THESIS_NOT_COMPUTED, NAN},
  };
  for (size_t i = 0; i < G_N_ELEMENTS(cases); i++) {
    g_autoptr(GPtrArray) issues = sb_issues_new();
    g_autoptr(SbThesisItem) item = compute(cases[i].printed, cases[i].rows, issues);
    g_test_message("case %zu", i);
    g_assert_nonnull(item);
    g_assert_cmpuint(item->rows->len, ==, 1);
    const SbThesisRow *row = item->rows->pdata[0];
    g_assert_cmpint(row->verdict, ==, cases[i].verdict);
    g_assert_cmpuint(item->fails, ==, cases[i].verdict == SB_THESIS_FAILS);
    g_assert_true((row->fault != NULL) == (cases[i].verdict == SB_THESIS_FAILS));
    if (!isnan(cases[i].remains)) {
      g_assert_cmpfloat_with_epsilon(row->remains, cases[i].remains, 1e-6);
    }
  }
}

// A step tells what it explains; the last one to the consistent set takes the rest.
static void test_parts(void) {
  g_autoptr(GPtrArray) issues = sb_issues_new();
  g_autoptr(SbThesisItem) item =
      compute("0.3",
              ROWS "reason.1 = once | meson test x | ours: seals.outer.squeeze + 0.1\n"
                   "reason.2 = again | meson test x | ours + 0.04\n"
                   "consistent = ours: 3 * seals.outer.squeeze\n"
                   "model.1 = one | meson test x | 2 * thesis\nmodel.2 = two | meson test x\n"
                   "remains = 2 %\n",
              issues);
  g_assert_nonnull(item);
  const SbThesisRow *row = item->rows->pdata[0];
  g_assert_cmpuint(row->reasons->len, ==, 2);
  g_assert_cmpuint(row->models->len, ==, 2);
  g_assert_cmpfloat_with_epsilon(g_array_index(row->reasons, SbThesisPart, 0).explains, 0.1, 1e-12);
  g_assert_cmpfloat_with_epsilon(g_array_index(row->reasons, SbThesisPart, 1).explains, 0.04,
                                 1e-12);
  g_assert_cmpfloat_with_epsilon(row->remains, row->thesis + 0.14 - 0.3, 1e-12);
  for (guint k = 0; k < 2; k++) {
    g_assert_cmpfloat_with_epsilon(g_array_index(row->models, SbThesisPart, k).explains,
                                   row->thesis, 1e-12);
  }
}

// Texts have computed values in them; a sample that no row asks for is not computed.
static void test_texts(void) {
  g_autoptr(GPtrArray) issues = sb_issues_new();
  g_autoptr(SbThesisItem) item =
      compute("0.2000",
              ROWS "label = Squeeze {squeeze:1:%} %\n"
                   "reason.1 = of {= ours: seal.section_diameter, m mm} | meson test x | printed\n"
                   "[notes]\nnote.1 = It is {= ours: seals.outer.squeeze, 1 %}.\n",
              issues);
  g_assert_nonnull(item);
  const SbThesisRow *row = item->rows->pdata[0];
  g_assert_cmpstr(row->label, ==, "Squeeze 20 %");
  g_assert_cmpstr(g_array_index(row->reasons, SbThesisPart, 0).text, ==, "of 1.61 mm");
  g_assert_cmpstr(item->notes->pdata[0], ==, "It is 15.5 %.");
}

static void test_refused(void) {
  static const struct {
    const char *rows, *said;
  } cases[] = {
      {"[rows squeeze]\nprinted = squeeze\nthesis = theirs: seals.outer.squeeze\n",
       "there is no grid [vary theirs]"},
      {"[rows squeeze]\nprinted = squeeze\nthesis = ours: seals.outer.squeezed\n",
       "there is no parameter and no variable"},
      {ROWS "at = d = squeeze\n", "no sample of [vary ours] is the printed row 1"},
      {ROWS "where = squeeze = 7\n", "means no printed row"},
      {ROWS "reason.1 = who knows\n", "names no command or test"},
      {ROWS "reason.1 = who knows | meson test engine-disc\n", "does not compute what it explains"},
      {ROWS "remains = a lot\n", "[rows squeeze] remains: "},
      {ROWS "[notes]\nnote.1 = {= theirs: seal.modulus}\n", "there is no grid [vary theirs]"},
  };
  for (size_t i = 0; i < G_N_ELEMENTS(cases); i++) {
    g_autoptr(GPtrArray) issues = sb_issues_new();
    g_autoptr(SbThesisItem) item = compute("0.2000", cases[i].rows, issues);
    g_assert_null(item);
    g_assert_cmpuint(issues->len, >, 0);
    g_autofree char *line = sb_issue_line(issues->pdata[0]);
    g_test_message("%s", line);
    g_assert_nonnull(strstr(line, cases[i].said));
  }
}

// Closed forms: every printed value of these is met or explained, and comes from the file.
static void test_items(void) {
  g_auto(GStrv) items = sb_thesis_items();
  g_assert_cmpstr(items[0], ==, "table-2.1");
  static const char *const names[] = {"table-2.1", "table-4.1", "table-4.3", "table-4.4",
                                      "table-5.1", "table-7.1", "table-7.6", "table-7.11"};
  for (size_t i = 0; i < G_N_ELEMENTS(names); i++) {
    g_assert_true(g_strv_contains((const char *const *)items, names[i]));
    g_autoptr(GPtrArray) issues = sb_issues_new();
    g_autoptr(SbThesisItem) item = sb_thesis_compute(names[i], 1, NULL, NULL, NULL, issues);
    g_assert_nonnull(item);
    g_assert_cmpuint(item->rows->len, >, 2);
    g_assert_cmpuint(item->fails, ==, 0);
    g_assert_nonnull(strstr(item->source, "Grimble"));
  }
}

static const SbStudySeries *series_of(const SbThesisItem *item, const char *name) {
  for (size_t i = 0; i < item->chart->panel[0].series_count; i++) {
    if (strcmp(item->chart->panel[0].series[i].name, name) == 0) {
      return &item->chart->panel[0].series[i];
    }
  }
  g_assert_not_reached();
}

// w over eta u R/h0: 24 times the integral of P* sec^2 t.
static double wedge_load(const SbStudySeries *of) {
  double sum = 0;
  for (size_t i = 1; i + 1 < of->count; i++) {
    const double t = of->x[i] * G_PI / 180, step = (of->x[i + 1] - of->x[i - 1]) / 2 * G_PI / 180;
    sum += of->y[i] / (cos(t) * cos(t)) * step;
  }
  return 24 * sum;
}

// Loads of the rigid wedge: 0 by symmetry, 4 (half Sommerfeld), 4.895 (Martin;
// engine/film/wedge.h).
static void test_wedge(void) {
  g_autoptr(GPtrArray) issues = sb_issues_new();
  g_autoptr(SbThesisItem) item = sb_thesis_compute("figure-6.7", 1, NULL, NULL, NULL, issues);
  g_assert_nonnull(item);
  g_assert_cmpfloat(fabs(wedge_load(series_of(item, "Full Sommerfeld"))), <, 1e-9);
  g_assert_cmpfloat_with_epsilon(wedge_load(series_of(item, "Half Sommerfeld")), 4, 0.01);
  g_assert_cmpfloat_with_epsilon(wedge_load(series_of(item, "Reynolds")), 4.894968, 0.01);
}

// A Hertz pressure on the half-space: x^2/2R within the contact, and outside what leaves the gap
// (b^2/2R) (X sqrt(X^2 - 1) - arcosh X), Johnson (1985), 4.3; columns end at the edge.
static void test_deflection(void) {
  g_autoptr(GPtrArray) issues = sb_issues_new();
  g_autoptr(SbThesisItem) item = sb_thesis_compute("figure-6.18", 1, NULL, NULL, NULL, issues);
  g_assert_nonnull(item);
  const SbStudySeries *half = series_of(item, "half-space"), *columns = series_of(item, "columns");
  const SbStudySeries *parabola = series_of(item, "parabola, within the contact");
  const double edge = parabola->y[0]; // at X = -1
  g_assert_cmpfloat_with_epsilon(parabola->x[0], -1, 1e-12);
  for (size_t i = 0; i < half->count; i++) {
    const double X = fabs(half->x[i]);
    const double gap = X > 1 ? X * sqrt(X * X - 1) - acosh(X) : 0;
    g_assert_cmpfloat_with_epsilon(half->y[i], edge * (X * X - gap), 1e-6 * edge);
    g_assert_true(X < 1 || fabs(columns->y[i] / columns->y[0] - 1) < 1e-12);
  }
}

// A loop in two parts, each in the order of the displacement.
static void test_loop(void) {
  g_autoptr(GPtrArray) issues = sb_issues_new();
  g_autoptr(SbThesisItem) item = sb_thesis_compute("figure-5.4", 1, NULL, NULL, NULL, issues);
  g_assert_nonnull(item);
  g_assert_cmpuint(item->chart->panel[0].series_count, ==, 2);
  const SbStudySeries *in = series_of(item, "thesis' model, in");
  g_assert_cmpuint(in->count, >, 50);
  for (size_t i = 1; i < in->count; i++) {
    g_assert_cmpfloat(in->x[i], >=, in->x[i - 1]);
  }
}

static bool always(void *data) {
  return true;
}

static void test_cancelled(void) {
  g_autoptr(GPtrArray) issues = sb_issues_new();
  g_assert_null(sb_thesis_compute("table-7.10", 1, NULL, always, NULL, issues));
  g_assert_cmpuint(issues->len, ==, 0);
  g_assert_null(sb_thesis_compute("table-99.1", 1, NULL, NULL, NULL, issues));
  g_assert_cmpuint(issues->len, >, 0);
}

int main(int argc, char **argv) {
  g_test_init(&argc, &argv, NULL);
  folder = g_dir_make_tmp("sealbench-thesis-XXXXXX", NULL);
  g_test_add_func("/thesis/printed", test_printed);
  g_test_add_func("/thesis/verdicts", test_verdicts);
  g_test_add_func("/thesis/parts", test_parts);
  g_test_add_func("/thesis/texts", test_texts);
  g_test_add_func("/thesis/refused", test_refused);
  g_test_add_func("/thesis/items", test_items);
  g_test_add_func("/thesis/wedge", test_wedge);
  g_test_add_func("/thesis/deflection", test_deflection);
  g_test_add_func("/thesis/loop", test_loop);
  g_test_add_func("/thesis/cancelled", test_cancelled);
  const int code = g_test_run();
  static const char *const names[] = {"printed.csv", "squeeze.csv", "squeeze.study"};
  for (size_t i = 0; i < G_N_ELEMENTS(names); i++) {
    g_autofree char *path = g_build_filename(folder, names[i], NULL);
    (void)g_remove(path);
  }
  (void)g_rmdir(folder);
  g_free(folder);
  return code;
}
