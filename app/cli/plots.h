// Charts of characters below the tables of commands, on standard output. They appear on a terminal,
// or where --plot requests them; the caller calls sb_cli_plots() first.
#pragma once

#include "app/data/compare.h"

#include "engine/valve/sealbench.h"

#include <glib.h>

// Whether --plot and --no-plot were given. Initialise with zeros.
typedef struct {
  gboolean on, off;
} SbCliPlots;

// Help of --plot and --no-plot.
#define SB_CLI_PLOT_HELP                                                                           \
  "Draws a chart below the table where standard output is not a terminal, too"
#define SB_CLI_NO_PLOT_HELP "Draws none on a terminal"

// Returns whether charts are to be printed: --plot, or standard output is a terminal; not with
// --no-plot or --quiet.
bool sb_cli_plots(const SbCliPlots *plots);

// Usual number of lines of a chart with its heading; a blank line precedes them.
enum { SB_CLI_PLOT_ROWS = 18 };

// Prints the loop of a finished run (force against displacement, of the sliding plate against time)
// with the measured points (NULL: none), in `rows` lines. Prints nothing if the run has no frames.
void sb_cli_plot_run(const SbRun *run, const SbComparison *measured, int rows);

// Prints the loops of `count` runs with their names in one chart; further runs than the chart has
// room for (SB_LOOPS_MAX) are omitted.
void sb_cli_plot_runs(SbRun *const *run, const char *const *name, size_t count,
                      const SbComparison *measured);

// Prints pressure[count] [Pa] and, if it is not NULL, film[count] [m] (on a logarithmic axis;
// values that are not positive are omitted) against x[count] [m].
void sb_cli_plot_profile(const double *x, const double *pressure, const double *film, size_t count);

// Prints the histogram of a figure (index of sb_figure()) of `count` samples, whose values are
// value[i * stride] (SI; NaN: none), with the limits on it.
void sb_cli_plot_histogram(int figure, const double *value, size_t count, size_t stride,
                           const SbLimits *limits);
