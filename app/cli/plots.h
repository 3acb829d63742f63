// Charts in characters below the tables of commands: on a terminal, or where --plot asks for them.
#pragma once

#include "app/data/compare.h"

#include "engine/valve/sealbench.h"

#include <glib.h>

// --plot and --no-plot.
typedef struct {
  gboolean on, off;
} SbCliPlots;

#define SB_CLI_PLOT_HELP                                                                           \
  "Draws a chart below the table where standard output is not a terminal, too"
#define SB_CLI_NO_PLOT_HELP "Draws none on a terminal"

// Whether a chart is to follow the table.
bool sb_cli_plots(const SbCliPlots *plots);

// Lines of a chart with its heading; a blank line precedes them.
enum { SB_CLI_PLOT_ROWS = 18 };

// Draws the loop of a run, with the measured points (NULL: none), in `rows` lines.
void sb_cli_plot_run(const SbRun *run, const SbComparison *measured, int rows);

// Several, named. As many as have a place.
void sb_cli_plot_runs(SbRun *const *run, const char *const *name, size_t count,
                      const SbComparison *measured);

// Pressure [Pa], and film [m] where it is not NULL, over `count` places x [m].
void sb_cli_plot_profile(const double *x, const double *pressure, const double *film, size_t count);

// How often a figure of a study has which value [SI, NaN: none], of samples `stride` apart.
void sb_cli_plot_histogram(int figure, const double *value, size_t count, size_t stride,
                           const SbLimits *limits);
