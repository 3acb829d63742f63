// Contradictions inside the summary of a run: two statements of one run of which at least one is
// wrong, whatever the valve is. Debug and sanitizer builds (SB_ASSERT_RUNS) assert after every run
// that there is none. The campaign random-valves judges the JSON of runs by the same rules
// (tests/campaigns/contradictions.py).
#pragma once

#include "engine/valve/run/run.h"

// Writes one sentence about the first contradiction that it finds to `text` of `size` bytes and
// returns true; false and an empty text if there is none. The run has ended, in any status, and its
// verdict is filled.
bool sb_summary_contradiction(char *text, size_t size, const SbSummary *summary,
                              const SbModel *model);
