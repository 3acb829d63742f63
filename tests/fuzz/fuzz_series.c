// What any bytes must survive as a measured series: either at least two rows that an engine can
// take, or exactly one printable complaint and nothing.
#include "app/document/series.h"

#include <math.h>
#include <stdint.h>
#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  static SbModelSeries series;
  GPtrArray *issues = sb_issues_new();
  bool good = sb_series_read(&series, SB_SERIES_DRIVE, (const char *)data, size, "fuzz", issues);
  g_assert_cmpuint(issues->len, ==, good ? 0 : 1);
  if (good) {
    SbDrive drive = {.kind = SB_DRIVE_TABLE,
                     .quantity = series.quantity,
                     .time = series.time,
                     .value = series.value,
                     .count = series.count};
    g_assert_cmpint(sb_drive_check(&drive, NULL), ==, SB_OK);
    g_assert_true(series.time[0] == 0);
  } else {
    g_assert_cmpuint(series.count, ==, 0);
    char *line = sb_issue_line(issues->pdata[0]);
    g_assert_true(g_utf8_validate(line, -1, NULL) && strchr(line, '\n') == NULL);
    g_free(line);
  }
  g_ptr_array_unref(issues);
  return 0;
}
