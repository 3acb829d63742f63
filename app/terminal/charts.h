// The program's charts in character cells: the loop, profiles of a contact, curves of a study, a
// histogram. The workbench in a terminal and the plain commands draw by these.
#pragma once

#include "app/chart/data.h"
#include "app/terminal/plot.h"

#include "engine/valve/studies/study.h"

// A theme's colours as cells have them.
typedef struct {
  uint32_t role[SB_ROLE_COUNT];
  uint32_t ground; // under everything; SB_CELL_OWN: the terminal's
} SbCellTheme;

// The dark theme; `own`: on whatever the terminal's ground is, ink in its own colour.
void sb_cell_theme(SbCellTheme *out, bool own);

// Cuts the unit off a formatted number: it stands in the heading.
void sb_chart_drop_unit(char *text);

// The loop with axes in `rect`: live, behind it earlier, pinned and predicted ones, dots of what
// was measured, the line of the pressure force, stages with their forces, *now*. Of a rig its force
// over time. SB_CHART_WHOLE: without *now*.
void sb_chart_loop(SbCells *cells, SbCellRect rect, const SbCellTheme *theme,
                   const SbChartData *data, unsigned flags);

// One more loop over a chart's axes, as `compare` sets them beside each other.
typedef struct {
  const char *name;
  const SbChartRun *run;
} SbNamedRun;
enum { SB_LOOPS_MAX = 6 };

// Up to SB_LOOPS_MAX runs in one chart, each in its own colour and dashes, named below.
void sb_chart_loops(SbCells *cells, SbCellRect rect, const SbCellTheme *theme,
                    const SbNamedRun *runs, size_t count, const SbComparison *measured);

// A curve y over x in units that people read; NaN leaves gaps. `name` heads it.
typedef struct {
  const char *name;
  const double *x, *y;
  size_t count;
  SbRole role;
  bool dots;
} SbCellCurve;

// Curves with axes; `heading` stands above. A logarithmic axis where it is asked for.
void sb_chart_curves(SbCells *cells, SbCellRect rect, const SbCellTheme *theme, const char *heading,
                     const SbCellCurve *curve, size_t count, bool log_x, bool log_y);

// A panel of a study.
void sb_chart_study(SbCells *cells, SbCellRect rect, const SbCellTheme *theme, const SbStudy *study,
                    size_t panel);

// How often values fall where; NaN are left out and counted. `low` and `high` are limits (infinite:
// none), beyond which bars are in the colour of errors.
void sb_chart_histogram(SbCells *cells, SbCellRect rect, const SbCellTheme *theme,
                        const char *heading, const double *value, size_t count, double low,
                        double high);

// Pressure and film of a contact at the playhead, beside each other or below.
void sb_chart_profiles(SbCells *cells, SbCellRect rect, const SbCellTheme *theme,
                       const SbChartData *data);
