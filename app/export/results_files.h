// A folder of results: results.json, cycle.csv, profiles.csv, life.csv where there is a life, and
// two tables for each study; all or none.
#pragma once

#include "app/export/results.h"

#include "app/document/unit.h"

// True if `folder` is a writable folder or can be made one. SB_APP_ERROR_IO otherwise.
bool sb_results_folder_check(const char *folder, GError **error);

// Makes the folder if needed and writes `json`, the tables of `run` and of `count` studies
// (study-NAME.csv with the curves, study-NAME-table.csv). Nothing of it appears under
// its final name unless all of it is on the disk. SB_APP_ERROR_IO.
bool sb_results_folder_write(const char *folder, const SbRun *run, const char *json,
                             const SbStudy *studies, size_t count, GError **error);
