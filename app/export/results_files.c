// Writes the files of a run into its folder, all or none.
#include "app/export/results_files.h"

#include "app/export/csv.h"
#include "app/export/studies.h"

enum { LIFE = 4, RUN_FILES = 5 };

// Name of file `index`; NULL for one that there is not. Owned by the caller.
static char *file_name(int index, unsigned studies, bool life) {
  static const char *const names[RUN_FILES] = {"results.json", "cycle.csv", "profiles.csv",
                                               "figures.csv", "life.csv"};
  if (index < RUN_FILES) {
    return index != LIFE || life ? g_strdup(names[index]) : NULL;
  }
  SbStudyKind kind = (SbStudyKind)((index - RUN_FILES) / 2);
  return (studies & 1u << kind) != 0 ? g_strdup_printf("study-%s%s.csv", sb_study_name(kind),
                                                       (index - RUN_FILES) % 2 == 0 ? "" : "-table")
                                     : NULL;
}

char **sb_results_folder_names(unsigned studies, bool life) {
  GPtrArray *names = g_ptr_array_new();
  for (int i = 0; i < RUN_FILES + 2 * SB_STUDY_COUNT; i++) {
    char *name = file_name(i, studies, life);
    if (name != NULL) {
      g_ptr_array_add(names, name);
    }
  }
  g_ptr_array_add(names, NULL);
  return (char **)g_ptr_array_free(names, FALSE);
}

static void put_file(FILE *stream, int index, const SbResultsFiles *of) {
  const SbStudy *study = of->studies;
  if (index == 0) {
    fputs(of->json, stream);
  } else if (index == 1) {
    sb_csv_cycle(stream, of->run);
  } else if (index == 2) {
    sb_csv_profiles(stream, of->run);
  } else if (index == 3) {
    sb_csv_figures(stream, of->run);
  } else if (index == LIFE) {
    sb_csv_life(stream, of->run);
  } else {
    while ((int)study->kind != (index - RUN_FILES) / 2) {
      study++;
    }
    ((index - RUN_FILES) % 2 == 0 ? sb_csv_study : sb_csv_study_table)(stream, study);
  }
}

bool sb_results_folder_fill(SbOutputFolder *folder, void *files, GError **error) {
  const SbResultsFiles *of = files;
  unsigned made = 0;
  for (size_t i = 0; i < of->count; i++) {
    made |= 1u << of->studies[i].kind;
  }
  bool good = true;
  for (int i = 0; i < RUN_FILES + 2 * SB_STUDY_COUNT && good; i++) {
    g_autofree char *name = file_name(i, made, sb_run_summary(of->run)->life.done > 0);
    FILE *stream;
    if (name != NULL && (good = sb_output_folder_add(&stream, folder, name, error))) {
      put_file(stream, i, of);
    }
  }
  return good;
}
