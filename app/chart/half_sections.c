// See half_sections.h.
#include "app/chart/half_sections.h"

#include "app/base/number.h"
#include "app/draw/canvas.h"

#include <glib/gi18n.h>
#include <math.h>

// Room for the axis' line below and for diameters above [px].
static const double BELOW = 40, ABOVE = 30, SIDE = 12;

typedef struct {
  SbCanvas *canvas;
  double x, y, scale; // of the origin, px per m
} Frame;

// One arc or straight piece of an outline, as cairo draws it (y down, so angles turn round).
static void add_piece(const Frame *frame, const SbProfilePoint *p, const SbProfilePoint *q) {
  cairo_t *cr = frame->canvas->cr;
  const double b = p->bulge;
  if (b == 0) {
    cairo_line_to(cr, frame->x + frame->scale * q->x, frame->y - frame->scale * q->r);
    return;
  }
  const double dx = q->x - p->x, dr = q->r - p->r, c = (1 - b * b) / (4 * b);
  const double cx = (p->x + q->x) / 2 - dr * c, cy = (p->r + q->r) / 2 + dx * c;
  const double radius = hypot(dx, dr) * (1 + b * b) / (4 * fabs(b));
  const double from = atan2(p->r - cy, p->x - cx), to = atan2(q->r - cy, q->x - cx);
  (b > 0 ? cairo_arc_negative : cairo_arc)(cr, frame->x + frame->scale * cx,
                                           frame->y - frame->scale * cy, frame->scale * radius,
                                           -from, -to);
}

static void draw_body(const Frame *frame, const SbCadBody *body, SbRole ground) {
  cairo_t *cr = frame->canvas->cr;
  const guint n = body->profile->len;
  const SbProfilePoint *point = (const SbProfilePoint *)(void *)body->profile->data;
  cairo_move_to(cr, frame->x + frame->scale * point[0].x, frame->y - frame->scale * point[0].r);
  for (guint i = 0; i + !body->closed < n; i++) {
    add_piece(frame, &point[i], &point[(i + 1) % n]);
  }
  cairo_close_path(cr);
  sb_canvas_color(frame->canvas, sb_canvas_role(frame->canvas, ground), 1);
  cairo_fill_preserve(cr);
  sb_canvas_color(frame->canvas, sb_canvas_role(frame->canvas, SB_ROLE_OUTLINE), 1);
  sb_canvas_pen(frame->canvas, SB_LINE_FRAME, NULL);
  cairo_stroke(cr);
}

// Diameters, inside the material; where there is room.
static void draw_features(const Frame *frame, const SbCadBody *body) {
  SbCanvas *canvas = frame->canvas;
  const SbTextStyle style = sb_canvas_style(canvas, SB_TYPE_NOTE, 400, SB_ROLE_INK);
  for (guint i = 0; i < body->features->len; i++) {
    const SbCadFeature *f = &g_array_index(body->features, SbCadFeature, i);
    char number[SB_NUMBER_SIZE];
    g_autofree char *text = g_strdup_printf("⌀ %s", sb_number_round(number, 1e3 * f->diameter, 4));
    const double middle = frame->x + frame->scale * (f->x0 + f->x1) / 2;
    const double y = frame->y - frame->scale * f->diameter / 2;
    if (sb_canvas_text_width(canvas, text, &style) < frame->scale * (f->x1 - f->x0)) {
      sb_canvas_text_halo(canvas, text, &style, middle, f->kind == SB_CAD_BORE ? y - 5 : y + 14,
                          SB_MIDDLE);
    }
  }
}

static SbRole ground_of(int body, const int part[SB_CAD_PART_COUNT]) {
  for (int i = 0; i < SB_CAD_PART_COUNT; i++) {
    if (part[i] == body) {
      return i == SB_VALVE_HOUSING ? SB_ROLE_HOUSING : SB_ROLE_STEM;
    }
  }
  return SB_ROLE_PANEL;
}

void sb_half_sections_draw(cairo_t *cr, SbRect rect, const SbTheme *theme, const SbCad *cad,
                           const int part[SB_CAD_PART_COUNT]) {
  double low = INFINITY, high = -INFINITY, top = 0;
  for (guint i = 0; i < cad->bodies->len; i++) {
    const SbCadBody *body = cad->bodies->pdata[i];
    for (guint k = 0; k < body->profile->len; k++) {
      const SbProfilePoint *p = &g_array_index(body->profile, SbProfilePoint, k);
      low = fmin(low, p->x);
      high = fmax(high, p->x);
      top = fmax(top, p->r);
    }
  }
  SbCanvas canvas;
  sb_canvas_init(&canvas, cr, theme);
  const SbTextStyle note = sb_canvas_style(&canvas, SB_TYPE_NOTE, 400, SB_ROLE_SECOND);
  if (!(high > low) || !(top > 0)) {
    sb_canvas_text(&canvas, _("no half-section"), &note, rect.x + rect.width / 2,
                   rect.y + rect.height / 2, SB_MIDDLE);
    sb_canvas_finish(&canvas);
    return;
  }
  const double scale =
      fmin((rect.width - 2 * SIDE) / (high - low), (rect.height - BELOW - ABOVE) / top);
  const Frame frame = {&canvas, rect.x + rect.width / 2 - scale * (low + high) / 2,
                       rect.y + (rect.height - BELOW + ABOVE + scale * top) / 2, scale};
  for (guint i = 0; i < cad->bodies->len; i++) {
    const SbCadBody *body = cad->bodies->pdata[i];
    if (body->profile->len > 0) {
      draw_body(&frame, body, ground_of((int)i, part));
    }
  }
  for (guint i = 0; i < cad->bodies->len; i++) {
    const SbCadBody *body = cad->bodies->pdata[i];
    if (body->profile->len > 0) {
      draw_features(&frame, body);
    }
  }
  const SbColor axis = sb_canvas_role(&canvas, SB_ROLE_AXIS);
  sb_canvas_color(&canvas, axis, 1);
  sb_canvas_pen(&canvas, 1, &sb_dash_centre);
  cairo_move_to(cr, rect.x, frame.y);
  cairo_line_to(cr, rect.x + rect.width, frame.y);
  cairo_stroke(cr);
  // A round length as the scale.
  const double room = 0.3 * rect.width / scale, decade = pow(10, floor(log10(room)));
  const double length = room >= 5 * decade ? 5 * decade : room >= 2 * decade ? 2 * decade : decade;
  char number[SB_NUMBER_SIZE];
  g_autofree char *text = g_strdup_printf("%s mm", sb_number_round(number, 1e3 * length, 3));
  const double y = frame.y + 22, right = rect.x + rect.width - SIDE;
  sb_canvas_hairline(&canvas, right - scale * length, y, right, y,
                     sb_canvas_role(&canvas, SB_ROLE_INK));
  sb_canvas_text(&canvas, text, &note, right - scale * length - 8, y + 4, SB_RIGHT);
  sb_canvas_text(&canvas, _("canister side"), &note, rect.x + SIDE, y + 4, SB_LEFT);
  sb_canvas_finish(&canvas);
}
