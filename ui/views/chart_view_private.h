// Shared by chart_view.c (drawing, pointer) and chart_view_text.c (description).
#pragma once

#include "app/chart/hysteresis.h"
#include "app/chart/profiles.h"
#include "ui/views/chart_view.h"
#include "ui/views/draw_cache.h"
#include "ui/views/later.h"

// The widget, freed with `area`.
typedef struct {
  SbSession *session; // borrowed
  SbChartViewKind kind;
  GtkWidget *area;         // the drawing area
  SbDrawCache *cache;      // its last picture, owned by `area`
  SbLater describe;        // delayed sb_chart_view_describe()
  double cursor;           // displacement under the pointer [m]; NaN: none
  double point_x, point_y; // pointer over a contact's panel [px]; NaN: it is elsewhere
  SbChartZoom zoom;        // displayed range if `zoomed`
  gboolean zoomed;
  // What a pressed pointer does: nothing, moves the playhead, draws a box to enlarge, or moves the
  // enlarged range.
  enum { SB_CHART_HAND_FREE, SB_CHART_HAND_SCRUBS, SB_CHART_HAND_BOXES, SB_CHART_HAND_MOVES } hand;
  double press_x, press_y, x, y; // where the pointer was pressed, and its last position [px]
} SbChartWidget;

// Returns the translated title of a chart. Static.
const char *sb_chart_view_name(SbChartViewKind kind);

// Writes to *out the pressure or the film under the pointer, read from the curve of a contact's
// panel. Returns FALSE if the pointer is not over a panel, there is no curve, or the chart is not
// one of pressures or films.
gboolean sb_chart_view_read_contact(const SbChartWidget *view, SbProfileReading *out);

// Returns the prediction for the present values that the chart draws over the run of earlier ones;
// NULL: none. Borrowed from the session.
const SbChartPredicted *sb_chart_view_prediction(const SbChartWidget *view);

// Updates the accessible name and description of the chart; `data` is the SbChartWidget. A callback
// of ui/views/later.h.
void sb_chart_view_describe(gpointer data);
