// A widget around one chart of app/chart: it draws the chart, moves the playhead, and describes the
// chart in its accessible description.
#pragma once

#include "app/session/session.h"

#include <gtk/gtk.h>

// Which chart.
typedef enum {
  SB_CHART_VIEW_LOOP,     // force against displacement; of the sliding plate force against time
  SB_CHART_VIEW_PRESSURE, // contact pressure of both seals; of the sliding plate its coefficients
  SB_CHART_VIEW_FILM,     // film thickness of both seals; hidden for the sliding plate
  SB_CHART_VIEW_COMPARE,  // table of the pinned runs; hidden for the sliding plate
  SB_CHART_VIEW_LIFE,     // results over the actuations; hidden with a single actuation
  SB_CHART_VIEW_SHELF,    // losses on the shelf; hidden unless the scene requests it
  SB_CHART_VIEW_REASONS   // why coefficients differ; only for the sliding plate
} SbChartViewKind;

// Returns a new chart (floating reference) of the displayed run of `session`, which is borrowed and
// must outlive it. The chart is hidden while the run has nothing of its kind.
GtkWidget *sb_chart_view_new(SbSession *session, SbChartViewKind kind);

// Returns the stages of the displayed run of `session` (time [s], displacement [m], force [N]) as
// tab-separated text with a heading line, followed by the comparison with pinned runs and measured
// data if there is one. A stage that was not reached has no line; without a run there is only the
// heading. Numbers have a decimal point.
char *sb_chart_view_stage_table(SbSession *session);
