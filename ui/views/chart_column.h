// The charts of a valve's cycle beside the section: the loop, and under it the seals' curves or the
// table of the compared runs.
#pragma once

#include "ui/views/chart_view.h"

#include <gtk/gtk.h>

void sb_chart_column_fill(GtkBox *column, SbSession *session);

// A chart with a line above it that comes and goes with it; the loop has none.
void sb_chart_column_add(GtkBox *box, SbSession *session, SbChartViewKind kind, gboolean expands);
