// A folder of results: results.json, cycle.csv, profiles.csv, figures.csv, life.csv if the run has
// a life, and two tables for each study; all or none.
#pragma once

#include "app/export/results.h"

#include "app/base/output.h"

// Returns the names of the files that a run writes, ends with NULL. `studies`: bit 1 << SbStudyKind
// for each study; `life`: the run has a life. Freed by g_strfreev().
char **sb_results_folder_names(unsigned studies, bool life);

// Creates the folder `path` if needed and writes `json` (results.json), the tables of `run` and of
// `count` studies (study-NAME.csv with the curves, study-NAME-table.csv). No file appears under its
// final name before all are on the disk. Files of an earlier run that this one does not have are
// deleted; the names (char *) of those that were changed since are appended to `kept` (may be NULL)
// and they stay. Returns false with SB_APP_ERROR_IO.
bool sb_results_folder_write(const char *path, const SbRun *run, const char *json,
                             const SbStudy *studies, size_t count, GPtrArray *kept, GError **error);
