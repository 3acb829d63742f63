// See the header.
#include "app/draw/frame.h"

SbRect sb_frame_inner(SbRect rect, bool panel) {
  const double pad = panel ? SB_GRID_PADDING : 0;
  return (SbRect){rect.x + pad, rect.y + pad, rect.width - 2 * pad, rect.height - 2 * pad};
}

SbRect sb_frame_begin(SbCanvas *c, SbRect rect, bool panel) {
  if (panel) {
    sb_canvas_panel(c, rect);
  }
  return sb_frame_inner(rect, panel);
}

void sb_frame_title(SbCanvas *c, SbRect in, double size, const char *title, const char *note) {
  const SbTextStyle bold = sb_canvas_style(c, size, 700, SB_ROLE_INK);
  const SbTextStyle plain = sb_canvas_style(
      c, size < SB_TYPE_PANEL_WINDOW ? SB_TYPE_NOTE : SB_TYPE_LABEL, 400, SB_ROLE_SECOND);
  const double used = sb_canvas_text(c, title, &bold, in.x, in.y + 14, SB_LEFT) + 12;
  if (note != NULL) {
    sb_canvas_text_fit(c, note, &plain, in.x + used, in.y + 14, in.width - used);
  }
}

double sb_frame_head(SbCanvas *c, SbRect in, bool compact, const char *title, const char *note,
                     const char *y_name) {
  const SbTextStyle bold =
      sb_canvas_style(c, compact ? SB_TYPE_PANEL_WINDOW : SB_TYPE_PANEL, 700, SB_ROLE_INK);
  const SbTextStyle plain = sb_canvas_style(c, SB_TYPE_LABEL, 400, SB_ROLE_SECOND);
  const double base = in.y + (compact ? 34 : 64);
  sb_canvas_text_fit(c, title, &bold, in.x, in.y + 14, in.width);
  if (!compact) {
    sb_canvas_text_fit(c, note, &plain, in.x, in.y + 34, in.width);
  }
  sb_canvas_text(c, y_name, &plain, in.x, base, SB_LEFT);
  return base;
}
