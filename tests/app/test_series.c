// Measured series: read, refused with file, line and column, and followed by the engine.
#include "app/document/document.h"
#include "app/document/series.h"
#include "app/run/runner.h"

#include "engine/valve/sealbench.h"

#include "tests/executed.h"

#include <glib/gstdio.h>
#include <locale.h>
#include <math.h>
#include <string.h>

#define ASSERT_NEAR(a, b, tolerance) g_assert_cmpfloat_with_epsilon((a), (b), (tolerance))

static SbModelSeries series;

static void test_read(void) {
  const char text[] =
      "\xef\xbb\xbf# a comment\r\n time [ms] ; force [kN]\r\n\r\n100; 0\r\n 350 ;1.25e-3\r\n";
  g_autoptr(GPtrArray) issues = sb_issues_new();
  g_assert_true(sb_series_read(&series, SB_SERIES_DRIVE, text, strlen(text), "x.csv", issues));
  g_assert_cmpuint(series.count, ==, 2);
  g_assert_cmpint(series.quantity, ==, SB_DRIVE_OF_FORCE);
  g_assert_cmpfloat(series.time[0], ==, 0); // counts from the first row
  ASSERT_NEAR(series.time[1], 0.25, 1e-15);
  ASSERT_NEAR(series.value[1], 1.25, 1e-15);
}

// One complaint each, which names file, line and column.
static void test_refused(void) {
  static const struct {
    const char *text, *said;
  } cases[] = {
      {"", "x.csv: is empty"},
      {"time [s],force [N]\n0,0\n1,1\n2,1,5,1\n",
       "x.csv: line 4: \"2,1,5,1\" is not a row of the series (allowed two numbers)"},
      {"0,0\n1,1\n", "x.csv: column 1 has no heading (allowed time [s])"},
      {"time [N],force [N]\n0,0\n1,1\n", "x.csv: line 1: column 1: \"N\" is not a unit of time"},
      {"time [s],speed [m/s]\n0,0\n1,1\n",
       "x.csv: line 1: column 2: \"speed\" is an unknown quantity"},
      {"time [s],force [N]\n0,0\n1,1\n2,zwei\n", "x.csv: line 4: \"2,zwei\" is not a row"},
      {"time [s],force [N]\n0,0\n1,1\n2,0x10\n", "x.csv: line 4: \"2,0x10\" is not a row"},
      {"time [s],force [N]\n0,0\n1,1\n2,inf\n", "x.csv: row 3: column 2 is out of range"},
      {"time [s],force [N]\n0,0\n1,1\nnan,inf\n", "x.csv: line 4: \"nan,inf\" is not a row"},
      {"time [s],force [N]\n0,0\n0,1\n", "x.csv: row 2: its time does not come after"},
      {"time [s],displacement [m]\n0,0\n1,3\n",
       "x.csv: row 2: column 2 is out of range (allowed at most 200 mm in either direction)"},
      {"time [s];force [N]\n1,250;2,500\n2,750;3,125\n",
       "x.csv: is ambiguous: \"1,250\" is 1250 with a decimal point, 1.25 with a "
       "decimal comma (allowed decimal points, dates as 2026-02-03,"},
      {"time;force [N]\n03/02/2026 23:59:59;1\n04/02/2026 00:00:01;2\n",
       "x.csv: line 3: is ambiguous: the date advances by a day or by a month (allowed decimal "
       "points, dates as 2026-02-03,"},
  };
  for (size_t i = 0; i < G_N_ELEMENTS(cases); i++) {
    g_autoptr(GPtrArray) issues = sb_issues_new();
    g_assert_false(sb_series_read(&series, SB_SERIES_DRIVE, cases[i].text, strlen(cases[i].text),
                                  "x.csv", issues));
    g_assert_cmpuint(issues->len, ==, 1);
    g_autofree char *line = sb_issue_line(issues->pdata[0]);
    if (!g_str_has_prefix(line, cases[i].said)) {
      g_error("%s instead of %s", line, cases[i].said);
    }
  }
  // Too long.
  GString *text = g_string_new("time [s],force [N]\n");
  for (int i = 0; i <= SB_MODEL_SERIES_MAX; i++) {
    g_string_append_printf(text, "%d,1\n", i);
  }
  g_autoptr(GPtrArray) issues = sb_issues_new();
  g_assert_false(sb_series_read(&series, SB_SERIES_DRIVE, text->str, text->len, "x.csv", issues));
  g_string_free(text, TRUE);
}

// The platen is where straight lines between the rows put it.
static void test_followed(void) {
  g_autofree char *path =
      g_build_filename(g_getenv("SEALBENCH_ASSETS"), "scenes", "measured-drive.scene", NULL);
  g_autofree char *csv =
      g_build_filename(g_getenv("SEALBENCH_ASSETS"), "series", "press.csv", NULL);
  g_autoptr(GPtrArray) issues = sb_issues_new();
  g_autoptr(SbDocument) document = sb_document_load(path, issues);
  g_assert_cmpuint(issues->len, ==, 0);
  g_autoptr(SbModel) model = NULL;
  g_assert_true(sb_document_compile(document, &model, issues));
  g_assert_true(sb_series_read(&series, SB_SERIES_DRIVE, NULL, 0, csv, issues));
  SbRun *run = executed_run(model);
  size_t count, row = 0;
  const SbFrame *frame = sb_run_frames(run, &count);
  for (size_t i = 0; i < count; i++) {
    while (row + 2 < series.count && series.time[row + 1] < frame[i].time) {
      row++;
    }
    double t = (frame[i].time - series.time[row]) / (series.time[row + 1] - series.time[row]);
    double x = series.value[row] + t * (series.value[row + 1] - series.value[row]);
    if (frame[i].force > 0 && !frame[i].on_event) {
      ASSERT_NEAR(frame[i].platen, x, 1e-9);
    }
  }
  g_assert_true(sb_run_summary(run)->stage[SB_STAGE_D].reached);
  g_assert_true(sb_run_summary(run)->returns);
  sb_run_destroy(run);
}

static void ignore(void *data) {}

// What the engine's thread is asked for, and the run that it makes, outlive the document.
static void test_outlives(void) {
  g_autofree char *path =
      g_build_filename(g_getenv("SEALBENCH_ASSETS"), "scenes", "measured-drive.scene", NULL);
  g_autoptr(GPtrArray) issues = sb_issues_new();
  SbDocument *document = sb_document_load(path, issues);
  g_autoptr(SbModel) model = NULL;
  g_assert_true(sb_document_compile(document, &model, issues));
  SbRun *alone = executed_run(model);
  SbRunner *runner = sb_runner_create(ignore, NULL, false);
  sb_runner_submit(runner,
                   &(SbRunRequest){.model = model, .wishes = {.views = SB_VIEW_HYSTERESIS}});
  sb_document_free(document);
  while (sb_runner_is_busy(runner)) {
    g_usleep(1000);
  }
  SbRunHandle *handle = sb_runner_latest(runner);
  sb_runner_destroy(runner);
  const SbRun *run = sb_run_handle_run(handle);
  g_assert_cmpfloat(sb_run_summary(run)->force_peak, ==, sb_run_summary(alone)->force_peak);
  const SbModelSeries *kept = sb_model_measured(sb_run_model(run));
  g_assert_true(kept == sb_model_measured(sb_run_model(alone)));
  g_assert_cmpfloat(kept->time[kept->count - 1], >, 0);
  sb_run_handle_unref(handle);
  sb_run_destroy(alone);
}

// A scene that moves keeps its series; a missing one is one complaint about the key's file.
static void test_document(void) {
  g_autofree char *path =
      g_build_filename(g_getenv("SEALBENCH_ASSETS"), "scenes", "measured-drive.scene", NULL);
  g_autoptr(GPtrArray) issues = sb_issues_new();
  g_autoptr(SbDocument) document = sb_document_load(path, issues);
  g_autofree char *before = sb_document_sha256(document);
  g_autofree char *folder = g_dir_make_tmp("sealbench-XXXXXX", NULL);
  g_autofree char *moved = g_build_filename(folder, "moved.scene", NULL);
  g_assert_true(sb_document_save(document, moved, NULL));
  g_autoptr(SbDocument) again = sb_document_load(moved, issues);
  g_assert_cmpuint(issues->len, ==, 0);
  g_autofree char *after = sb_document_sha256(again);
  g_assert_cmpstr(before, ==, after);
  // The text that stands alone restores it too.
  g_autofree char *flat = sb_document_to_flat_text(again);
  g_autoptr(SbDocument) alone = sb_document_parse(flat, strlen(flat), "flat", "/", issues);
  g_assert_cmpuint(issues->len, ==, 0);
  g_autofree char *hash = sb_document_sha256(alone);
  g_assert_cmpstr(before, ==, hash);
  const char broken[] = "[sealbench]\nformat = 1\nkind = valve\n[drive]\nkind = measured\n"
                        "file = /no/such.csv\n[models]\nmotion = dynamic\n";
  sb_document_free(sb_document_parse(broken, strlen(broken), "x.valve", NULL, issues));
  g_assert_cmpuint(issues->len, ==, 1);
  g_autofree char *line = sb_issue_line(issues->pdata[0]);
  g_assert_nonnull(strstr(line, "/no/such.csv"));
  g_remove(moved);
  g_rmdir(folder);
}

// Temperatures of a shelf: degrees of either scale, in a document that names them and moves.
static void test_shelf(void) {
  g_autoptr(GPtrArray) issues = sb_issues_new();
  g_autofree char *folder = g_dir_make_tmp("shelf-XXXXXX", NULL);
  g_autofree char *csv = g_build_filename(folder, "t.csv", NULL);
  g_autofree char *valve = g_build_filename(folder, "a.valve", NULL);
  g_assert_true(g_file_set_contents(csv, "time [day],temperature [degC]\n0,5\n100,40\n", -1, NULL));
  g_assert_true(sb_series_read(&series, SB_SERIES_TEMPERATURE, NULL, 0, csv, issues));
  g_assert_cmpuint(series.count, ==, 2);
  ASSERT_NEAR(series.time[1], 100 * 86400.0, 1e-6);
  ASSERT_NEAR(series.value[1], 313.15, 1e-9);
  g_assert_true(g_file_set_contents(csv, "time [h],temperature [K]\n0,280\n9,600\n", -1, NULL));
  g_assert_false(sb_series_read(&series, SB_SERIES_TEMPERATURE, NULL, 0, csv, issues));
  g_assert_cmpuint(issues->len, ==, 1);
  g_assert_true(g_file_set_contents(csv, "time [day],temperature [degC]\n0,5\n100,40\n", -1, NULL));
  static const char text[] = "[sealbench]\nformat = 1\nkind = valve\n[shelf]\nhistory = file\n%s";
  for (int named = 0; named < 2; named++) {
    g_autofree char *content = g_strdup_printf(text, named ? "file = t.csv\n" : "");
    g_assert_true(g_file_set_contents(valve, content, -1, NULL));
    g_autoptr(GPtrArray) found = sb_issues_new();
    SbDocument *document = sb_document_load(valve, found);
    g_assert_cmpuint(found->len, ==, named ? 0 : 1);
    if (!named) {
      g_autofree char *line = sb_issue_line(found->pdata[0]);
      g_assert_nonnull(strstr(line, "[shelf] file"));
    }
    sb_document_free(document);
  }
  g_remove(csv);
  g_remove(valve);
  g_rmdir(folder);
}

int main(int argc, char **argv) {
  g_test_init(&argc, &argv, NULL);
  g_test_add_func("/series/read", test_read);
  g_test_add_func("/series/refused", test_refused);
  g_test_add_func("/series/followed", test_followed);
  g_test_add_func("/series/outlives", test_outlives);
  g_test_add_func("/series/document", test_document);
  g_test_add_func("/series/shelf", test_shelf);
  return g_test_run();
}
