// A folder of results: results.json, cycle.csv, profiles.csv, figures.csv, life.csv if the run has
// a life, and two tables for each study; all or none.
#pragma once

#include "app/export/results.h"

#include "app/base/output.h"

// Returns the names of the files that a run writes, ends with NULL. `studies`: bit 1 << SbStudyKind
// for each study; `life`: the run has a life. Freed by g_strfreev().
char **sb_results_folder_names(unsigned studies, bool life);

// The files of a run.
typedef struct {
  const SbRun *run;
  const char *json;       // results.json
  const SbStudy *studies; // [count]: study-NAME.csv with the curves, study-NAME-table.csv
  size_t count;
} SbResultsFiles;

// Adds the files of a run to a folder; `files` is an SbResultsFiles. An SbOutputFill for
// sb_output_folder_write() (app/base/output.h). Returns false with SB_APP_ERROR_INPUT or
// SB_APP_ERROR_IO if a file cannot be begun; errors of writing appear when the folder is committed.
bool sb_results_folder_fill(SbOutputFolder *folder, void *files, GError **error);
