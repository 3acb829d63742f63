// See document_fixture.h.
#include "tests/app/document_fixture.h"

#include <glib/gstdio.h>

char *document_asset(const char *name) {
  return g_build_filename(g_getenv("SEALBENCH_ASSETS"), name, NULL);
}

SbDocument *document_load(const char *path) {
  GPtrArray *issues = sb_issues_new();
  SbDocument *document = sb_document_load(path, issues);
  for (guint i = 0; i < issues->len; i++) {
    char *line = sb_issue_line(issues->pdata[i]);
    g_error("%s", line);
  }
  g_ptr_array_unref(issues);
  g_assert_nonnull(document);
  return document;
}

char *document_folder(void) {
  GError *error = NULL;
  char *folder = g_dir_make_tmp("sealbench-test-XXXXXX", &error);
  g_assert_no_error(error);
  return folder;
}

void document_remove_folder(char *folder) {
  GDir *dir = g_dir_open(folder, 0, NULL);
  const char *name;
  while ((name = g_dir_read_name(dir)) != NULL) {
    char *path = g_build_filename(folder, name, NULL);
    g_remove(path);
    g_free(path);
  }
  g_dir_close(dir);
  g_assert_cmpint(g_rmdir(folder), ==, 0);
  g_free(folder);
}
