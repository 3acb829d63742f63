// The comparison of measured loops with runs, as JSON.
#pragma once

#include "app/data/compare.h"
#include "app/table/table.h"

// Writes the object `key`: differences between measurement and run, how the file was read, stages.
void sb_json_comparison(SbJson *json, const char *key, const SbComparison *comparison);

// Returns the stages B to F of the measured loop and of the model, for people and as members by
// their names. Freed by sb_table_free().
SbTable *sb_measured_stages(const SbComparison *comparison);

// Writes the object "stages": for the stages B to F the measured and computed force and
// displacement and their difference.
void sb_json_measured_stages(SbJson *json, const SbComparison *comparison);

// Returns the JSON document of `sealbench compare`: the figures of each run, their differences from
// the first run, and the comparison of the first run with its measurement. All arrays have `runs`
// elements: `name` of the runs, `scene` the full paths of their files ("-": standard input),
// `figure[i]` is [SB_FIGURE_COUNT] [SI], `comparison[i]` is NULL for a run without a measurement.
char *sb_results_compare(size_t runs, const char *const *name, const char *const *scene,
                         double *const *figure, SbComparison *const *comparison);
