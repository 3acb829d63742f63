// Consistency check of a run's summary: finds two statements of which at least one must be wrong.
// Builds with SB_ASSERT_RUNS assert after each run that there is none;
// tests/campaigns/contradictions.py applies the same rules to JSON.
#pragma once

#include "engine/valve/run/run.h"

// Returns whether the summary contradicts itself, and writes one sentence about the first
// contradiction to text[size] ("" if there is none). The run must have ended (any status) with its
// verdict filled.
bool sb_summary_contradiction(char *text, size_t size, const SbSummary *summary,
                              const SbModel *model);
