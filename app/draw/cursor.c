// See the header.
#include "app/draw/cursor.h"

#include <math.h>

void sb_cursor_drop(SbCanvas *c, SbPoint now, double bottom) {
  sb_canvas_line(c, (SbStroke){SB_ROLE_NOW, 1, &sb_dash_now}, now.x, now.y, now.x, bottom);
}

void sb_cursor_now(SbCanvas *c, SbPoint now) {
  sb_canvas_dot(c, now.x, now.y, 8, sb_canvas_role(c, SB_ROLE_PANEL));
  sb_canvas_dot(c, now.x, now.y, 6, sb_canvas_role(c, SB_ROLE_NOW));
}

void sb_cursor_draw(cairo_t *cr, const SbTheme *theme, SbRect plot, SbRect bounds, double x,
                    const double *dot, int dots, const char *text) {
  SbCanvas canvas, *c = &canvas;
  sb_canvas_init(c, cr, theme);
  const double line = floor(x) + 0.5;
  sb_canvas_hairline(c, line, plot.y, line, plot.y + plot.height,
                     sb_canvas_role(c, SB_ROLE_SECOND));
  for (int i = 0; i < dots; i++) {
    if (!isnan(dot[i])) {
      sb_canvas_dot(c, line, dot[i], 4, sb_canvas_role(c, SB_ROLE_INK));
    }
  }
  // Beside the line where there is room; the plate may lie over a label.
  const SbTextStyle style = sb_canvas_style(c, SB_TYPE_LABEL, 600, SB_ROLE_INK);
  const double width = sb_canvas_text_width(c, text, &style);
  const bool right = line + width + 16 < bounds.x + bounds.width;
  const double left = fmax(right ? line + 8 : line - 8 - width, bounds.x + 4);
  sb_canvas_fill(c, (SbRect){left - 4, plot.y - 2, width + 8, 18}, SB_ROLE_PANEL, 0.9);
  sb_canvas_text(c, text, &style, left, plot.y + 11, SB_LEFT);
  sb_canvas_finish(c);
}
