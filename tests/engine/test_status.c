// Reports and warnings: formatting, de-duplication, bounds.
#include "engine/status.h"

#include <glib.h>

static void test_report(void) {
  SbReport report = {0};
  SbStatus status = sb_fail_parameter(&report, SB_ERROR_RANGE, "drive.speed", "speed %g m/s", -1.0);
  g_assert_cmpint(status, ==, SB_ERROR_RANGE);
  g_assert_cmpint(report.status, ==, SB_ERROR_RANGE);
  g_assert_cmpstr(report.text, ==, "speed -1 m/s");
  g_assert_cmpstr(report.parameter, ==, "drive.speed");
  g_assert_cmpint(sb_succeed(&report), ==, SB_OK);
  g_assert_cmpstr(report.text, ==, "");
  g_assert_cmpint(sb_fail(NULL, SB_ERROR_INPUT, "no report"), ==, SB_ERROR_INPUT);
}

static void test_warnings(void) {
  SbWarnings list = {0};
  sb_warn(&list, "a", "k", "first");
  sb_warn(&list, "a", "k", "again");
  sb_warn(&list, "a", "other", "second");
  g_assert_cmpuint(list.count, ==, 2);
  for (int i = 0; i < 2 * SB_WARNINGS_MAX; i++) {
    char code[16];
    g_snprintf(code, sizeof code, "c%d", i);
    sb_warn(&list, code, "", "text");
  }
  g_assert_cmpuint(list.count, ==, SB_WARNINGS_MAX);
  g_assert_cmpuint(list.dropped, ==, SB_WARNINGS_MAX + 2);
}

int main(int argc, char **argv) {
  g_test_init(&argc, &argv, NULL);
  g_test_add_func("/status/report", test_report);
  g_test_add_func("/status/warnings", test_warnings);
  return g_test_run();
}
