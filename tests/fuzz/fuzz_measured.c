// What any bytes must survive as a measured file: either a loop of finite numbers with at least one
// cycle whose points slide, or printable complaints and nothing.
#include "app/data/measured.h"

#include <math.h>
#include <stdint.h>
#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  g_autoptr(GPtrArray) issues = sb_issues_new();
  SbData *group = sb_data_of_file("fuzz");
  g_autoptr(SbMeasured) measured =
      sb_measured_read(group, size % 3 == 0 ? 1e-3 : 0, data, size, issues);
  g_assert_true((measured != NULL) == (issues->len == 0));
  for (guint i = 0; i < issues->len; i++) {
    g_autofree char *line = sb_issue_line(issues->pdata[i]);
    g_assert_true(g_utf8_validate(line, -1, NULL) && strchr(line, '\n') == NULL);
  }
  if (measured != NULL) {
    g_assert_cmpuint(measured->cycle->len, >, 0);
    for (size_t i = 0; i < measured->count; i++) {
      g_assert_true(isfinite(measured->displacement[i]) && isfinite(measured->force[i]));
    }
    size_t count;
    g_autofree SbMeasuredPoint *point = sb_measured_points(&count, measured, 7);
    for (size_t i = 0; i < count; i++) {
      g_assert_true(isfinite(point[i].displacement) && isfinite(point[i].force));
    }
    g_autofree char *text = sb_measured_text(measured);
    g_autofree char *keys = sb_measured_keys(measured);
    g_assert_true(g_utf8_validate(text, -1, NULL) && g_utf8_validate(keys, -1, NULL));
  }
  sb_data_free(group);
  return 0;
}
