// See the header.
#include "app/draw/legend.h"

#include <glib/gi18n.h>
#include <math.h>

double sb_legend_line(SbCanvas *c, double right, double y, double room, SbStroke stroke,
                      const char *name) {
  enum { LINE = 24, GAP = 8 };
  const SbTextStyle style = sb_canvas_style(c, SB_TYPE_LABEL, 600, stroke.role);
  const double width = fmin(sb_canvas_text_width(c, name, &style), room - LINE - GAP);
  const double left = right - width - GAP;
  sb_canvas_curve(c, stroke, (SbPoint[]){{left - LINE, y - 5}, {left, y - 5}}, 2);
  sb_canvas_text_fit_ends(c, name, &style, right - width, y, width + 1);
  return width + GAP + LINE;
}

double sb_legend_predicted(SbCanvas *c, double right, double y) {
  return sb_legend_line(c, right, y, INFINITY,
                        (SbStroke){SB_ROLE_INK, SB_LINE_SEAL, &sb_dash_predicted}, _("predicted"));
}
