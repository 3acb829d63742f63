// Drawing on a cairo context in the style of the theme: text by Pango, thinned polylines,
// arrowheads, dots, panels. Coordinates are logical pixels, y downwards. An SbCanvas is used for
// one drawing call.
#pragma once

#include "app/draw/geometry.h"
#include "app/draw/theme.h"

#include <pango/pangocairo.h>
#include <stddef.h>

// A canvas. Initialised by sb_canvas_init(), freed by sb_canvas_finish().
typedef struct {
  cairo_t *cr;          // borrowed
  const SbTheme *theme; // borrowed
  PangoLayout *layout;  // owned, reused for every text
} SbCanvas;

// Style of a text.
typedef struct {
  double size; // [px]
  int weight;  // 400 normal, 600 semibold, 700 bold
  SbColor color;
  double alpha; // opacity, 0 to 1; 0 counts as 1
} SbTextStyle;

// Starts drawing: saves the state of `cr` (cairo_save()) and sets caps and joins. `cr` and `theme`
// are borrowed until sb_canvas_finish(). Text is laid out without hinting, so that a picture has
// the same shape at every scale and on every surface.
void sb_canvas_init(SbCanvas *canvas, cairo_t *cr, const SbTheme *theme);

// Restores the state of the context (cairo_restore()) and frees the layout.
void sb_canvas_finish(SbCanvas *canvas);

// Returns the theme's colour for a role.
SbColor sb_canvas_role(const SbCanvas *canvas, SbRole role);

// Sets the colour of cairo's source, with the opacity `alpha` in place of the colour's own.
void sb_canvas_color(SbCanvas *canvas, SbColor color, double alpha);

// Sets the line width [px] and the dash (NULL: solid).
void sb_canvas_pen(SbCanvas *canvas, double width, const SbDash *dash);

// Sets colour, width and dash of the lines that follow.
void sb_canvas_stroke(SbCanvas *canvas, SbStroke stroke);

// Returns a style with the theme's colour for a role.
SbTextStyle sb_canvas_style(const SbCanvas *canvas, double size, int weight, SbRole role);

// Returns the advance width of one line of text [px].
double sb_canvas_text_width(SbCanvas *canvas, const char *text, const SbTextStyle *style);

// Draws one line of text with its anchor on the baseline at (x, y). Returns its advance width [px].
// Digits have equal widths.
double sb_canvas_text(SbCanvas *canvas, const char *text, const SbTextStyle *style, double x,
                      double y, SbAlign align);

// As sb_canvas_text(), over a halo of 3 px in the panel colour.
double sb_canvas_text_halo(SbCanvas *canvas, const char *text, const SbTextStyle *style, double x,
                           double y, SbAlign align);

// As sb_canvas_text(), on a plate of colour `ground`, for text on a hatch.
double sb_canvas_text_plate(SbCanvas *canvas, const char *text, const SbTextStyle *style, double x,
                            double y, SbAlign align, SbColor ground);

// As sb_canvas_text() with SB_LEFT, shortened with an ellipsis at the end to fit `width`.
double sb_canvas_text_fit(SbCanvas *canvas, const char *text, const SbTextStyle *style, double x,
                          double y, double width);

// As sb_canvas_text_fit(), with the ellipsis in the middle, so that both ends of a name are
// visible.
double sb_canvas_text_fit_ends(SbCanvas *canvas, const char *text, const SbTextStyle *style,
                               double x, double y, double width);

// Draws text broken at words to lines of `width` (at least 40 px), its top left corner at (x, y).
// Returns its height.
double sb_canvas_paragraph(SbCanvas *canvas, const char *text, const SbTextStyle *style, double x,
                           double y, double width);

// As sb_canvas_paragraph(), with lines aligned to a side.
double sb_canvas_paragraph_aligned(SbCanvas *canvas, const char *text, const SbTextStyle *style,
                                   double x, double y, double width, SbAlign align);

// Returns the height of such a paragraph without drawing it.
double sb_canvas_paragraph_height(SbCanvas *canvas, const char *text, const SbTextStyle *style,
                                  double width);

// Draws the background of a panel: a rounded rectangle with a hairline.
void sb_canvas_panel(SbCanvas *canvas, SbRect rect);

// Adds a rounded rectangle to cairo's current path.
void sb_canvas_rounded(SbCanvas *canvas, SbRect rect, double radius);

// Draws a horizontal or vertical line one logical pixel wide, aligned with the pixel grid.
void sb_canvas_hairline(SbCanvas *canvas, double x0, double y0, double x1, double y1,
                        SbColor color);

// Strokes the polyline point[count] with the present pen and colour. Omits points within half a
// device pixel of the last one drawn, except the first and last. Points that are not finite
// interrupt the line.
void sb_canvas_polyline(SbCanvas *canvas, const SbPoint *point, size_t count);

// Strokes such a polyline in a style, which stays set.
void sb_canvas_curve(SbCanvas *canvas, SbStroke stroke, const SbPoint *point, size_t count);

// Strokes the straight line from (x0, y0) to (x1, y1) in a style, which stays set.
void sb_canvas_line(SbCanvas *canvas, SbStroke stroke, double x0, double y0, double x1, double y1);

// Fills a rectangle with the theme's colour for a role and the opacity `alpha`.
void sb_canvas_fill(SbCanvas *canvas, SbRect rect, SbRole role, double alpha);

// Fills the polygon point[count], thinned as a polyline.
void sb_canvas_area(SbCanvas *canvas, const SbPoint *point, size_t count, SbRole role,
                    double alpha);

// Saves cairo's state and restricts drawing to a rectangle, until cairo_restore().
void sb_canvas_clip(SbCanvas *canvas, SbRect rect);

// Hatches a rectangle with lines at 45 degrees, `pitch` apart along its bottom [px]; they lean to
// the right, or to the left if `left`.
void sb_canvas_hatch(SbCanvas *canvas, SbRect rect, double pitch, bool left, SbRole role,
                     double alpha);

// Adds the thinned polyline to cairo's current path without stroking it.
void sb_canvas_path(SbCanvas *canvas, const SbPoint *point, size_t count);

// Fills an arrowhead of 11 x 9 px (times `size`) in the present colour (sb_canvas_color()), with
// its tip at (x, y) and the direction (dx, dy) of any length; draws nothing for the length 0.
void sb_canvas_arrowhead(SbCanvas *canvas, double x, double y, double dx, double dy, double size);

// Draws a dot of radius 3.4 px in the panel colour inside a ring of colour `ring`, whose outer
// radius is 5 px.
void sb_canvas_ringed_dot(SbCanvas *canvas, double x, double y, SbColor ring);

// Fills a dot of this radius [px] with its centre at (x, y).
void sb_canvas_dot(SbCanvas *canvas, double x, double y, double radius, SbColor color);
