// Writes the files under temporary names, seals them all, then renames.
#include "app/export/results_files.h"

#include "app/document/atomic.h"
#include "app/document/issue.h"
#include "app/export/csv.h"
#include "app/export/studies.h"

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

enum { RUN_FILES = 4, LIFE = 3, FILES = RUN_FILES + 2 * SB_STUDY_COUNT };

// Name of file `index` in the folder; owned by the caller.
static char *file_name(int index, const SbStudy *studies) {
  static const char *const names[RUN_FILES] = {"results.json", "cycle.csv", "profiles.csv",
                                               "life.csv"};
  if (index < RUN_FILES) {
    return g_strdup(names[index]);
  }
  const SbStudy *study = &studies[(index - RUN_FILES) / 2];
  return g_strdup_printf("study-%s%s.csv", sb_study_name(study->kind),
                         (index - RUN_FILES) % 2 == 0 ? "" : "-table");
}

static void put_file(FILE *stream, int index, const SbRun *run, const char *json,
                     const SbStudy *studies) {
  if (index == 0) {
    fputs(json, stream);
  } else if (index == 1) {
    sb_csv_cycle(stream, run);
  } else if (index == 2) {
    sb_csv_profiles(stream, run);
  } else if (index == LIFE) {
    sb_csv_life(stream, run);
  } else if ((index - RUN_FILES) % 2 == 0) {
    sb_csv_study(stream, &studies[(index - RUN_FILES) / 2]);
  } else {
    sb_csv_study_table(stream, &studies[(index - RUN_FILES) / 2]);
  }
}

bool sb_results_folder_write(const char *folder, const SbRun *run, const char *json,
                             const SbStudy *studies, size_t count, GError **error) {
  if (g_mkdir_with_parents(folder, 0777) != 0) {
    return fail(error, folder, errno);
  }
  int total = RUN_FILES + 2 * (int)MIN(count, SB_STUDY_COUNT);
  SbAtomicFile files[FILES] = {0};
  bool good = true;
  bool lived = sb_run_summary(run)->life.done > 0;
  for (int i = 0; i < total && good; i++) {
    if (i == LIFE && !lived) {
      continue;
    }
    g_autofree char *name = file_name(i, studies);
    g_autofree char *path = g_build_filename(folder, name, NULL);
    good = sb_atomic_file_begin(&files[i], path, error);
    if (good) {
      put_file(files[i].stream, i, run, json, studies);
      good = sb_atomic_file_seal(&files[i], error);
    }
  }
  for (int i = 0; i < total && good; i++) {
    good = (i == LIFE && !lived) || sb_atomic_file_commit(&files[i], error);
  }
  for (int i = 0; i < total; i++) {
    sb_atomic_file_abort(&files[i]);
  }
  return good;
}
