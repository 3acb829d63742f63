// Drawing on a cairo context in the look's terms: text by pango, thinned polylines, arrowheads,
// dots, panels. One SbCanvas serves one drawing call.
#pragma once

#include "app/base/geometry.h"
#include "app/base/theme.h"

#include <pango/pangocairo.h>
#include <stddef.h>

typedef struct {
  cairo_t *cr;
  const SbTheme *theme;
  PangoLayout *layout; // owned, reused for every text
} SbCanvas;

typedef struct {
  double size;   // [px]
  int weight;    // 400, 600, 700
  SbColor color; //
  double alpha;  // 0 counts as 1
} SbTextStyle;

// Starts drawing; sb_canvas_finish() frees what it made. Text is laid out without hinting, so that
// a picture has the same shape at every scale and on every surface.
void sb_canvas_init(SbCanvas *canvas, cairo_t *cr, const SbTheme *theme);
void sb_canvas_finish(SbCanvas *canvas);

SbColor sb_canvas_role(const SbCanvas *canvas, SbRole role);
void sb_canvas_color(SbCanvas *canvas, SbColor color, double alpha);

// Sets width, dash (NULL: solid), butt caps and round joins.
void sb_canvas_pen(SbCanvas *canvas, double width, const SbDash *dash);

// A style in one expression.
SbTextStyle sb_canvas_style(const SbCanvas *canvas, double size, int weight, SbRole role);

// Width of a text; ink box around it when drawn with its baseline at (x, y).
double sb_canvas_text_width(SbCanvas *canvas, const char *text, const SbTextStyle *style);
SbRect sb_canvas_text_box(SbCanvas *canvas, const char *text, const SbTextStyle *style, double x,
                          double y, SbAlign align);

// Draws a text with its baseline at y. Returns its advance width. Tabular figures.
double sb_canvas_text(SbCanvas *canvas, const char *text, const SbTextStyle *style, double x,
                      double y, SbAlign align);

// The same over a halo of 3 px in the panel colour.
double sb_canvas_text_halo(SbCanvas *canvas, const char *text, const SbTextStyle *style, double x,
                           double y, SbAlign align);

// The same on a plate of `ground`, for text on a hatch.
double sb_canvas_text_plate(SbCanvas *canvas, const char *text, const SbTextStyle *style, double x,
                            double y, SbAlign align, SbColor ground);

// As sb_canvas_text(), shortened with an ellipsis at the end to fit `width`.
double sb_canvas_text_fit(SbCanvas *canvas, const char *text, const SbTextStyle *style, double x,
                          double y, double width);

// The same, cut in the middle: both ends tell one name from another.
double sb_canvas_text_fit_ends(SbCanvas *canvas, const char *text, const SbTextStyle *style,
                               double x, double y, double width);

// A paragraph broken at words to fit `width`, its top at y. Returns its height.
double sb_canvas_paragraph(SbCanvas *canvas, const char *text, const SbTextStyle *style, double x,
                           double y, double width);

// The same with its lines set to a side.
double sb_canvas_paragraph_aligned(SbCanvas *canvas, const char *text, const SbTextStyle *style,
                                   double x, double y, double width, SbAlign align);

// That height without drawing it.
double sb_canvas_paragraph_height(SbCanvas *canvas, const char *text, const SbTextStyle *style,
                                  double width);

// Background of a panel: rounded, hairline.
void sb_canvas_panel(SbCanvas *canvas, SbRect rect);
void sb_canvas_rounded(SbCanvas *canvas, SbRect rect, double radius);

// Horizontal or vertical line of one logical pixel, on the pixel grid.
void sb_canvas_hairline(SbCanvas *canvas, double x0, double y0, double x1, double y1,
                        SbColor color);

// Strokes a polyline, dropping points within half a device pixel of the last one kept (first and
// last always stay), in runs of about 500. Points that are not finite break the line. The line
// width and dash are those set; dashes go on from run to run.
void sb_canvas_polyline(SbCanvas *canvas, const SbPoint *point, size_t count);

// The name of predicted curves behind a piece of one, up to `right` on the line y. Returns its
// width.
double sb_canvas_predicted(SbCanvas *canvas, double right, double y);

// Adds the thinned polyline to the current path without stroking.
void sb_canvas_path(SbCanvas *canvas, const SbPoint *point, size_t count);

// An arrowhead of 11 x 9 (times `size`) whose tip is at (x, y), pointing along (dx, dy).
void sb_canvas_arrowhead(SbCanvas *canvas, double x, double y, double dx, double dy, double size);

// A ringed dot: 3.4 px in the panel colour inside a ring of `ring`.
void sb_canvas_ringed_dot(SbCanvas *canvas, double x, double y, SbColor ring);
void sb_canvas_dot(SbCanvas *canvas, double x, double y, double radius, SbColor color);
