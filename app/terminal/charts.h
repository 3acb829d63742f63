// The program's charts in character cells: the loop, the profiles of a contact, curves of a study,
// a histogram. The workbench in a terminal and the commands use them. All functions draw into the
// rectangle `rect` of a grid and read their data during the call only.
#pragma once

#include "app/chart/data.h"
#include "app/terminal/plot.h"

#include "engine/valve/studies/study.h"

// Colours of a theme for cells.
typedef struct {
  uint32_t role[SB_ROLE_COUNT]; // 0xRRGGBB or SB_CELL_OWN, by SbRole
  uint32_t ground;              // background; SB_CELL_OWN: the terminal's
} SbCellTheme;

// Sets the colours of the dark theme. `own`: for a background of unknown colour; text and
// background then have the terminal's own colours.
void sb_cell_theme(SbCellTheme *out, bool own);

// Draws the loop with axes, force [N] against displacement [mm]: the live run; dimmed the earlier,
// pinned and predicted ones; measured points; the line of the pressure force; stages with their
// forces; and the playhead. A run of the sliding plate is drawn as force against time. `flags` is 0
// or SB_CHART_WHOLE (no playhead; app/chart/data.h).
void sb_chart_loop(SbCells *cells, SbCellRect rect, const SbCellTheme *theme,
                   const SbChartData *data, unsigned flags);

// A run with its name in the legend.
typedef struct {
  const char *name;
  const SbChartRun *run;
} SbNamedRun;

// Largest number of loops in one chart.
enum { SB_LOOPS_MAX = 6 };

// Draws the loops of runs[count] in one chart, each with its own colour and dashes, with a legend
// below. Runs after the first SB_LOOPS_MAX are omitted. `measured` NULL: no measured points.
void sb_chart_loops(SbCells *cells, SbCellRect rect, const SbCellTheme *theme,
                    const SbNamedRun *runs, size_t count, const SbComparison *measured);

// A curve y[count] against x[count], in display units; NaN leaves a gap.
typedef struct {
  const char *name; // in the legend; empty: none
  const double *x, *y;
  size_t count;
  SbRole role; // of its colour
  bool dots;   // points in place of a line
} SbCellCurve;

// Draws curve[count] with axes below the line `heading`. log_x and log_y: logarithmic axes, on
// which values that are not positive are gaps.
void sb_chart_curves(SbCells *cells, SbCellRect rect, const SbCellTheme *theme, const char *heading,
                     const SbCellCurve *curve, size_t count, bool log_x, bool log_y);

// Draws panel `panel`, below study->panel_count, of a study.
void sb_chart_study(SbCells *cells, SbCellRect rect, const SbCellTheme *theme, const SbStudy *study,
                    size_t panel);

// Draws the histogram of value[count], in display units; values that are not finite are omitted and
// their number is stated. `low` and `high` are limits in the same unit (infinite: none); bars
// beyond them have the colour of errors.
void sb_chart_histogram(SbCells *cells, SbCellRect rect, const SbCellTheme *theme,
                        const char *heading, const double *value, size_t count, double low,
                        double high);
