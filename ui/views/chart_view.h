// A widget around one chart of app/chart: draws it, moves the playhead, says what it shows.
#pragma once

#include "app/session/session.h"

#include <gtk/gtk.h>

typedef enum {
  SB_CHART_VIEW_LOOP,     // of the sliding-plate rig: the thread's force over time
  SB_CHART_VIEW_PRESSURE, // of the rig: its coefficients
  SB_CHART_VIEW_FILM,     // not of the rig
  SB_CHART_VIEW_COMPARE,  // not of the rig
  SB_CHART_VIEW_LIFE,     // only where a scene has more than one actuation
  SB_CHART_VIEW_SHELF,    // only where a scene shows it
  SB_CHART_VIEW_REASONS   // only of the rig
} SbChartViewKind;

// A chart; it hides itself while the session's run has nothing of its kind.
GtkWidget *sb_chart_view_new(SbSession *session, SbChartViewKind kind);

// The chart's numbers as tab-separated text with a heading line. Owned by the caller.
char *sb_chart_view_table(SbSession *session);
