// What `sealbench run` prints of a finished run: the summary, or with --all the full table.
#pragma once

#include "app/cli/plots.h"
#include "app/run/cases.h"

// The run to print; all pointers are borrowed for the call.
typedef struct {
  const char *title;            // of the scene
  const SbRun *run;             // finished
  bool converged;               // sb_results_converged() of the run
  const SbCaseVerdict *verdict; // [SB_VERDICT_COUNT], of sb_cases_judge()
  const SbComparison *measured; // NULL: no measured loop
  const char *folder;           // that the results were written to; NULL: none
  const SbCliPlots *plots;      // whether the loop is drawn
} SbCliRunText;

// Largest number of lines of a summary on a terminal with 80 columns or more.
enum { SB_CLI_SUMMARY_LINES = 24 };

// Prints the verdict with its reasons, the eight key figures with the absolute estimates of their
// errors, the number of warnings and the loop, in at most SB_CLI_SUMMARY_LINES lines that fit the
// terminal (80 columns elsewhere). Long reasons are wrapped; the loop takes the remaining lines, if
// enough remain. Only reasons for which SB_CLI_SUMMARY_LINES are too few end with an ellipsis. A
// terminal with fewer than 80 columns gets more lines instead. --no-plot omits the loop.
void sb_cli_run_summary(const SbCliRunText *of);

// Prints the tables of app/export/run_tables.h (figures, stages, verdict, warnings) and the state
// of the solvers, then the comparison with a measured loop and, if charts are drawn, the loop.
void sb_cli_run_table(const SbCliRunText *of);
