// Consistency check of a run's summary: finds two results that exclude each other, such as a finite
// return margin of a stem that never moved. Builds with SB_ASSERT_RUNS assert after each run that
// there is none; tests/campaigns/contradictions.py applies the same rules to JSON.
#pragma once

#include "engine/valve/run/run.h"

// Returns whether the summary contradicts itself, and writes one sentence about the first
// contradiction to text[size] ("" if there is none). `summary` is that of an ended sb_run_execute()
// (any status), `model` the run's model.
bool sb_summary_contradiction(char *text, size_t size, const SbSummary *summary,
                              const SbModel *model);
