// Charts of characters below the tables of commands. The functions sb_cli_plot_...() print on
// standard output, a blank line first. They print unconditionally: the caller calls sb_cli_plots()
// first.
#pragma once

#include "app/data/compare.h"

#include "engine/valve/sealbench.h"

#include <glib.h>

// Whether the options --plot (`on`) and --no-plot (`off`) were given. Initialise with zeros.
typedef struct {
  gboolean on, off;
} SbCliPlots;

// Help of --plot and --no-plot.
#define SB_CLI_PLOT_HELP                                                                           \
  "Draws a chart below the table where standard output is not a terminal, too"
#define SB_CLI_NO_PLOT_HELP "Draws none on a terminal"

// Returns whether charts are to be printed: --plot was given or standard output is a terminal, and
// neither --no-plot nor --quiet was given.
bool sb_cli_plots(const SbCliPlots *plots);

// Usual value of `rows`: lines of a chart with its heading, without the blank line.
enum { SB_CLI_PLOT_ROWS = 18 };

// Prints the loop of a finished run (force against displacement, of the sliding plate against time)
// in `rows` lines, with the points of `measured` (NULL: none). Prints nothing if the run has no
// frames.
void sb_cli_plot_run(const SbRun *run, const SbComparison *measured, int rows);

// Prints the loops of the finished runs run[count] with their names name[count] in one chart, with
// the points of `measured` (NULL: none). Runs after the first SB_LOOPS_MAX
// (app/terminal/charts.h) are omitted.
void sb_cli_plot_runs(SbRun *const *run, const char *const *name, size_t count,
                      const SbComparison *measured);

// Prints pressure[count] [Pa] and, if it is not NULL, film[count] [m] (on a logarithmic axis;
// values that are not positive are omitted) against x[count] [m].
void sb_cli_plot_profile(const double *x, const double *pressure, const double *film, size_t count);

// Prints the histogram of a figure (index of sb_figure()) of `count` samples. value[i * stride] is
// the value of sample i (SI; NaN: the sample has none and is omitted). The limit on this figure
// among `limits`, if there is one, is shown.
void sb_cli_plot_histogram(int figure, const double *value, size_t count, size_t stride,
                           const SbLimits *limits);
