// The comparison of measured loops with runs, as JSON.
#pragma once

#include "app/data/compare.h"
#include "app/table/table.h"

#include "engine/valve/figures/figures.h"

// Writes the object `key`: differences between measurement and run, how the file was read, stages.
void sb_json_comparison(SbJson *json, const char *key, const SbComparison *comparison);

// Writes with units, in ASCII, the measured force of a stage, the model's and their difference,
// each with the digits that its error supports; "-" where there is none. Each text is freed with
// g_free().
void sb_measured_stage_texts(char *out[3], const SbComparison *comparison, SbStage stage);

// Returns a difference of forces [N] (rms, mean, most of a comparison) with unit, in ASCII; "-" if
// it is NaN.
char *sb_measured_difference(double force);

// Returns the table of the stages B to F, measured and computed; in JSON each stage is a member
// named by its letter. Freed by sb_table_free().
SbTable *sb_measured_stages(const SbComparison *comparison);

// Writes the object "stages": for the stages B to F the measured and computed force and
// displacement and their difference.
void sb_json_measured_stages(SbJson *json, const SbComparison *comparison);

// A run that is compared.
typedef struct {
  const char *name, *scene;       // title, and full path of the file ("-": standard input)
  double figure[SB_FIGURE_COUNT]; // SI; NaN: none
  char *reason[SB_FIGURE_COUNT];  // why a figure has no value; NULL: it has one
  const SbComparison *comparison; // with its measured loop; NULL: there is none
} SbComparedRun;

// Returns the JSON document of `sealbench compare` for run[runs]: the figures of each run with the
// reasons of missing ones, their differences from the first run, and the comparison of the first
// run with its measurement.
char *sb_results_compare(const SbComparedRun *const *run, size_t runs);
