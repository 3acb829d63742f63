// Tables of the results of a run, for the text of a terminal and the pages of a report. `run` has
// ended. All tables are freed by sb_table_free().
#pragma once

#include "app/data/compare.h"
#include "app/run/cases.h"
#include "app/table/table.h"

// Returns the figures of short tables (figures.def) with their error estimates, a group after the
// other. Of a valve: cycle, dose, shelf, people, and life if there is one. Of the sliding plate:
// cycle and test rig. Figures of dose and shelf, and of the plate's cycle, that were not computed
// are omitted; the other groups list them with the reason.
SbTable *sb_run_figures(const SbRun *run);

// Returns the figures of both seals side by side.
SbTable *sb_run_seals(const SbSummary *summary);

// Returns time, displacement, force and event of each stage.
SbTable *sb_run_stages(const SbSummary *summary);

// Returns the answers to all questions, verdict[SB_VERDICT_COUNT], with what decides them. The
// answer "no" is marked as wrong.
SbTable *sb_run_verdict(const SbSummary *summary, const SbCaseVerdict *verdict);

// Returns the answer `verdict` to question `kind` (of SbVerdictKind) on one line: the deciding
// figure with its limit, the reason and the case.
char *sb_run_verdict_text(const SbSummary *summary, int kind, const SbCaseVerdict *verdict);

// Returns the warnings with their codes and parameters, serious ones marked as doubtful. `notes`,
// of SbIssue, are added to the rows; NULL: none.
SbTable *sb_run_warnings(const SbWarnings *warnings, const GPtrArray *notes);

// Returns the value of a figure (index of sb_figure()) with its unit and the digits that its error
// estimate supports; a dash if there is none.
char *sb_run_value(const SbSummary *summary, int index);

// Returns the error estimate of a figure in per cent, "rounding" if below 1e-9, "" if there is no
// estimate.
char *sb_run_error(const SbSummary *summary, int index);

// Returns the margin of a value to the nearer bound, "1.4 N (5 %)", in parentheses relative to the
// bound; negative if the limit is violated; "" if the margin is not finite or the figure is yes or
// no. `value`, `low`, `high` (may be infinite) in SI units of `figure` (index of sb_figure()),
// `error` relative.
char *sb_run_margin(int figure, double value, double error, double low, double high);
