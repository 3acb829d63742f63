// Writes the three files under temporary names, seals them all, then renames.
#include "app/export/results_files.h"

#include "app/document/atomic.h"
#include "app/document/issue.h"
#include "app/export/csv.h"

#include <errno.h>
#include <glib/gstdio.h>
#include <string.h>
#include <unistd.h>

static bool fail(GError **error, const char *path, int code) {
  char *shown = sb_printable(path, strlen(path));
  g_set_error(error, SB_APP_ERROR, SB_APP_ERROR_IO, "%s: %s", shown, g_strerror(code));
  g_free(shown);
  return false;
}

bool sb_results_folder_check(const char *folder, GError **error) {
  // The nearest part of the path that exists must be a writable folder.
  char *part = g_strdup(folder);
  while (!g_file_test(part, G_FILE_TEST_EXISTS)) {
    char *up = g_path_get_dirname(part);
    bool top = strcmp(up, part) == 0;
    g_free(part);
    part = up;
    if (top) {
      break;
    }
  }
  bool good = true;
  if (!g_file_test(part, G_FILE_TEST_IS_DIR)) {
    good = fail(error, part, ENOTDIR);
  } else if (access(part, W_OK | X_OK) != 0) {
    good = fail(error, part, errno);
  }
  g_free(part);
  return good;
}

bool sb_results_folder_write(const char *folder, const SbRun *run, const char *json,
                             GError **error) {
  if (g_mkdir_with_parents(folder, 0777) != 0) {
    return fail(error, folder, errno);
  }
  static const char *const names[] = {"results.json", "cycle.csv", "profiles.csv"};
  enum { COUNT = G_N_ELEMENTS(names) };
  SbAtomicFile files[COUNT] = {0};
  bool good = true;
  for (int i = 0; i < COUNT && good; i++) {
    char *path = g_build_filename(folder, names[i], NULL);
    good = sb_atomic_file_begin(&files[i], path, error);
    g_free(path);
    if (!good) {
      break;
    }
    if (i == 0) {
      fputs(json, files[i].stream);
    } else if (i == 1) {
      sb_csv_cycle(files[i].stream, run);
    } else {
      sb_csv_profiles(files[i].stream, run);
    }
    good = sb_atomic_file_seal(&files[i], error);
  }
  for (int i = 0; i < COUNT && good; i++) {
    good = sb_atomic_file_commit(&files[i], error);
  }
  for (int i = 0; i < COUNT; i++) {
    sb_atomic_file_abort(&files[i]);
  }
  return good;
}
