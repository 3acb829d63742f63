// A widget around one chart of app/chart: draws it, moves the playhead, says what it shows.
#pragma once

#include "ui/session.h"

#include <gtk/gtk.h>

typedef enum { SB_CHART_VIEW_LOOP, SB_CHART_VIEW_PRESSURE, SB_CHART_VIEW_FILM } SbChartViewKind;

GtkWidget *sb_chart_view_new(SbSession *session, SbChartViewKind kind);

// The chart's numbers as tab-separated text with a heading line. Owned by the caller.
char *sb_chart_view_table(SbSession *session);
