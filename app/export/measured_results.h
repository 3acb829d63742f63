// Measured loops as JSON: what was recognised, what they differ by from a run, the stages.
#pragma once

#include "app/data/compare.h"
#include "app/export/json.h"

// The object `key` of a comparison.
void sb_json_comparison(SbJson *json, const char *key, const SbComparison *comparison);

// The object "stages" of it alone.
void sb_json_measured_stages(SbJson *json, const SbComparison *comparison);

// Runs side by side; `scene` is [runs] full paths of their files ("-": standard input), `figure` is
// [runs][SB_FIGURE_COUNT], the first measured one's `comparison` may be NULL. Owned by the caller.
char *sb_results_compare(size_t runs, const char *const *name, const char *const *scene,
                         double *const *figure, SbComparison *const *comparison);
