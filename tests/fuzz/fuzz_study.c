// What any bytes must survive as a study file: reading never crashes, hangs or says nothing, and
// the points of a study that was read lie where its distributions do.
#include "app/document/study_file.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  // A scene in memory: what the text names is replaced by the defaults.
  g_autoptr(GPtrArray) issues = sb_issues_new();
  g_autoptr(SbStudyFile) study =
      sb_study_file_parse((const char *)data, size, "fuzz", NULL, NULL, sb_document_new(), issues);
  g_assert_true(study != NULL || issues->len > 0);
  for (guint i = 0; i < issues->len; i++) {
    char *line = sb_issue_line(issues->pdata[i]);
    g_assert_true(g_utf8_validate(line, -1, NULL) && strchr(line, '\n') == NULL);
    g_free(line);
  }
  if (study != NULL && study->samples <= 10000) {
    double *value = NULL;
    g_assert_cmpint(sb_study_file_points(&value, NULL, study, NULL), ==, SB_OK);
    for (size_t i = 0; i < study->samples * study->vary->len; i++) {
      g_assert_true(isfinite(value[i]) || (study->lines != NULL && isnan(value[i])));
    }
    free(value);
  }
  return 0;
}
