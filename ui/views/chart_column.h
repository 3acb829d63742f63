// The column of charts next to the section: the loop, and below it the curves of the seals or the
// table of the compared runs.
#pragma once

#include "ui/views/chart_view.h"

#include <gtk/gtk.h>

// Adds the charts to `column`, an empty vertical box. `session` is borrowed and must outlive them.
void sb_chart_column_fill(GtkBox *column, SbSession *session);

// Adds one chart to `box`, with a separator above it that is visible when the chart is (none for
// the loop). `expands`: the chart takes additional height.
void sb_chart_column_add(GtkBox *box, SbSession *session, SbChartViewKind kind, gboolean expands);
