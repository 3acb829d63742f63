// The balance of forces on the stem: machine force = pressure force + spring force + friction of
// both seals (negative on the way back) + stop force. What is missing from it is inertia, which a
// quasi-static run lacks and the window does not draw.
#include "ui/views/force_balance.h"

#include "app/base/device.h"
#include "app/base/format.h"

#include <glib/gi18n.h>
#include <math.h>
#include <stdio.h>

// One part of the balance. Returns where the next one may start.
static double part(SbCanvas *canvas, double x, double y, double scale, SbColor color,
                   const char *name, double force) {
  const SbTheme *theme = canvas->theme;
  char number[SB_FORMAT_MAX], text[2 * SB_FORMAT_MAX];
  sb_format_text(number, SB_QUANTITY_FORCE, fabs(force), 0);
  SbTextStyle bold = {12, 600, color, 1};
  SbTextStyle plain = sb_canvas_style(canvas, 12, 400, SB_ROLE_INK);
  double name_width = sb_canvas_text_width(canvas, name, &bold);
  snprintf(text, sizeof text, " %s", number);
  double text_width = name_width + sb_canvas_text_width(canvas, text, &plain) + 16;
  double width = fabs(force) * scale;

  // A force that works against the machine is outlined, one with it filled; a bar too short for its
  // text is filled only.
  sb_canvas_color(canvas, color, force >= 0 || width < text_width ? 0.16 : 0.05);
  cairo_rectangle(canvas->cr, x, y - 15, width, 20);
  cairo_fill(canvas->cr);
  sb_canvas_color(canvas, color, 1);
  if (force < 0 && width >= text_width) {
    sb_canvas_pen(canvas, 1, NULL);
    cairo_rectangle(canvas->cr, x + 0.5, y - 14.5, fmax(width - 1, 1), 19);
    cairo_stroke(canvas->cr);
  }
  cairo_rectangle(canvas->cr, x, y - 15, 3, 20);
  cairo_fill(canvas->cr);
  bold.color = sb_theme_readable(theme, color, theme->role[SB_ROLE_PANEL]);
  sb_canvas_text(canvas, name, &bold, x + 9, y - 0.5, SB_LEFT);
  sb_canvas_text(canvas, text, &plain, x + 9 + name_width, y - 0.5, SB_LEFT);
  return x + fmax(width, text_width);
}

// A further term of the balance with its sign; nothing where the force is too small to be shown.
// Returns where the next one may start.
static double term(SbCanvas *canvas, double x, double y, double scale, SbColor color,
                   const char *name, double force) {
  if (fabs(force) <= 0.005) {
    return x;
  }
  const SbTextStyle plain = sb_canvas_style(canvas, 12, 400, SB_ROLE_SECOND);
  sb_canvas_text(canvas, force < 0 ? "\xe2\x88\x92" : "+", &plain, x + 9, y, SB_MIDDLE);
  return part(canvas, x + 18, y, scale, color, name, force);
}

void sb_force_balance_draw(cairo_t *cr, SbRect rect, const SbTheme *theme,
                           const SbChartData *data) {
  const SbFrame *frame = sb_chart_frame(data);
  if (frame == NULL) {
    return;
  }
  SbCanvas canvas;
  sb_canvas_init(&canvas, cr, theme);
  sb_canvas_clip(&canvas, (SbRect){rect.x, rect.y - 1, rect.width, rect.height + 1});
  sb_canvas_hairline(&canvas, rect.x, rect.y, rect.x + rect.width, rect.y,
                     theme->role[SB_ROLE_HAIRLINE]);
  SbTextStyle bold = sb_canvas_style(&canvas, 12, 700, SB_ROLE_INK);
  SbTextStyle plain = sb_canvas_style(&canvas, 12, 400, SB_ROLE_SECOND);
  double y = rect.y + rect.height / 2 + 5;
  char number[SB_FORMAT_MAX], text[2 * SB_FORMAT_MAX];
  sb_format_text(number, SB_QUANTITY_FORCE, frame->force, sb_chart_error_force(&data->run));
  snprintf(text, sizeof text, _("Drive %s"), number);
  sb_canvas_text(&canvas, text, &bold, rect.x, y, SB_LEFT);

  // One scale for the whole run; the thesis valve's 38 N or the run's largest sum fill the width.
  double largest = data->run.trace != NULL ? sb_trace_range(data->run.trace).force_max : 0;
  double span = fmax(38, fmax(2.6 * fabs(frame->pressure_force), 1.1 * largest));
  // Room for the word in any language, and for two digits, so that nothing moves with the force.
  snprintf(text, sizeof text, _("Drive %s"), "00.0\xc2\xa0N");
  const double lead = fmax(102, sb_canvas_text_width(&canvas, text, &bold) + 22);
  double x = rect.x + lead;
  double scale = (rect.width - lead - 60) / span;
  sb_canvas_text(&canvas, "=", &plain, x - 14, y, SB_MIDDLE);
  if (frame->pressure_force < 0) {
    x += sb_canvas_text(&canvas, "\xe2\x88\x92", &plain, x, y, SB_LEFT) + 4;
  }
  x = part(&canvas, x, y, scale, theme->role[SB_ROLE_FLUID], _("pressure"), frame->pressure_force);
  x = term(&canvas, x, y, scale, theme->role[SB_ROLE_SECOND], _("spring"), frame->spring_force);
  const SbDevice *device = sb_device(data->run.model);
  for (int i = 0; i < SB_SEAL_COUNT; i++) {
    const SbSealFrame *seal = &frame->seal[i];
    if (seal->load <= 0 || seal->land_fraction <= 0) {
      x += 14;
      x += sb_canvas_text(&canvas, _(device->off[i]), &plain, x, y, SB_LEFT);
    } else {
      x = term(&canvas, x, y, scale, sb_theme_seal(theme, i), _(device->short_name[i]),
               seal->friction);
    }
  }
  term(&canvas, x, y, scale, theme->role[SB_ROLE_THIRD], C_("label", "stop"), frame->stop_force);
  cairo_restore(cr);
  sb_canvas_finish(&canvas);
}
