// A folder of results: results.json, cycle.csv, profiles.csv, figures.csv, life.csv where there is
// a life, and two tables for each study; all or none.
#pragma once

#include "app/export/results.h"

#include "app/base/output.h"

// Names of the files that a run with these studies (a bit mask) writes. Free with g_strfreev().
char **sb_results_folder_names(unsigned studies, bool life);

// Makes the folder if needed and writes `json`, the tables of `run` and of `count` studies
// (study-NAME.csv with the curves, study-NAME-table.csv). Nothing of it appears under its final
// name unless all of it is on the disk; files of an earlier run that this one does not have go,
// `kept` (of char *) gets the names of those that were changed since. SB_APP_ERROR_IO.
bool sb_results_folder_write(const char *path, const SbRun *run, const char *json,
                             const SbStudy *studies, size_t count, GPtrArray *kept, GError **error);
