// Primitives on cairo and pango. Lengths in logical pixels of the context's user space; thinning
// looks at device pixels, so that a picture at scale 2 keeps twice the points. Leaves out clipping:
// callers clip to their plot.
#include "app/draw/canvas.h"

#include <glib.h>
#include <math.h>
#include <string.h>

// Large type wants the tighter drawing of the same family where there is one.
static const char families[] = "Inter, Cantarell, DejaVu Sans";
static const char large_families[] = "Inter Display, Inter, Cantarell, DejaVu Sans";
static const double large_size = 24;

void sb_canvas_init(SbCanvas *canvas, cairo_t *cr, const SbTheme *theme) {
  canvas->cr = cr;
  canvas->theme = theme;
  canvas->layout = pango_cairo_create_layout(cr);
  PangoContext *context = pango_layout_get_context(canvas->layout);

  // No hinting, grey smoothing: the same picture on every screen and in every file.
  cairo_font_options_t *options = cairo_font_options_create();
  cairo_font_options_set_hint_style(options, CAIRO_HINT_STYLE_NONE);
  cairo_font_options_set_hint_metrics(options, CAIRO_HINT_METRICS_OFF);
  cairo_font_options_set_antialias(options, CAIRO_ANTIALIAS_GRAY);
  pango_cairo_context_set_font_options(context, options);
  pango_cairo_context_set_resolution(context, 96);
  pango_context_set_round_glyph_positions(context, FALSE);
  cairo_font_options_destroy(options);
  pango_layout_context_changed(canvas->layout);
  pango_layout_set_single_paragraph_mode(canvas->layout, TRUE);

  PangoAttrList *attributes = pango_attr_list_new();
  pango_attr_list_insert(attributes, pango_attr_font_features_new("tnum=1"));
  pango_layout_set_attributes(canvas->layout, attributes);
  pango_attr_list_unref(attributes);
  cairo_save(cr);
  cairo_set_line_cap(cr, CAIRO_LINE_CAP_BUTT);
  cairo_set_line_join(cr, CAIRO_LINE_JOIN_ROUND);
}

void sb_canvas_finish(SbCanvas *canvas) {
  cairo_restore(canvas->cr);
  g_object_unref(canvas->layout);
  canvas->layout = NULL;
}

SbColor sb_canvas_role(const SbCanvas *canvas, SbRole role) {
  return canvas->theme->role[role];
}

void sb_canvas_color(SbCanvas *canvas, SbColor color, double alpha) {
  cairo_set_source_rgba(canvas->cr, color.r, color.g, color.b, alpha);
}

void sb_canvas_pen(SbCanvas *canvas, double width, const SbDash *dash) {
  cairo_set_line_width(canvas->cr, width);
  cairo_set_dash(canvas->cr, dash ? dash->length : NULL, dash ? dash->count : 0, 0);
}

void sb_canvas_stroke(SbCanvas *canvas, SbStroke stroke) {
  sb_canvas_pen(canvas, stroke.width, stroke.dash);
  sb_canvas_color(canvas, sb_canvas_role(canvas, stroke.role), 1);
}

SbTextStyle sb_canvas_style(const SbCanvas *canvas, double size, int weight, SbRole role) {
  return (SbTextStyle){size, weight, sb_canvas_role(canvas, role), 1};
}

// Puts the text into the layout.
static void shape(SbCanvas *canvas, const char *text, const SbTextStyle *style) {
  PangoFontDescription *font = pango_font_description_new();
  pango_font_description_set_family_static(font,
                                           style->size >= large_size ? large_families : families);
  pango_font_description_set_absolute_size(font, style->size * PANGO_SCALE);
  pango_font_description_set_weight(font, (PangoWeight)style->weight);
  pango_layout_set_font_description(canvas->layout, font);
  pango_font_description_free(font);
  pango_layout_set_width(canvas->layout, -1);
  pango_layout_set_ellipsize(canvas->layout, PANGO_ELLIPSIZE_NONE);
  pango_layout_set_text(canvas->layout, text, -1);
}

static double advance(SbCanvas *canvas) {
  PangoRectangle logical;
  pango_layout_get_extents(canvas->layout, NULL, &logical);
  return logical.width / (double)PANGO_SCALE;
}

static double align_offset(SbAlign align, double width) {
  return align == SB_LEFT ? 0 : align == SB_MIDDLE ? -0.5 * width : -width;
}

double sb_canvas_text_width(SbCanvas *canvas, const char *text, const SbTextStyle *style) {
  shape(canvas, text, style);
  return advance(canvas);
}

// Returns the ink rectangle of a text with its anchor on the baseline at (x, y); `align` states
// which end of the text the anchor is.
static SbRect text_box(SbCanvas *canvas, const char *text, const SbTextStyle *style, double x,
                       double y, SbAlign align) {
  double width = sb_canvas_text_width(canvas, text, style);
  // A box by the type size, not by the glyphs, so that neighbours line up.
  return (SbRect){x + align_offset(align, width), y - 0.80 * style->size, width,
                  1.03 * style->size};
}

static void place(SbCanvas *canvas, double x, double y) {
  double baseline = pango_layout_get_baseline(canvas->layout) / (double)PANGO_SCALE;
  cairo_move_to(canvas->cr, x, y - baseline);
}

static double alpha_of(const SbTextStyle *style) {
  return style->alpha > 0 ? style->alpha : 1;
}

// Draws what is laid out.
static void show(SbCanvas *canvas, const SbTextStyle *style, double x, double y) {
  sb_canvas_color(canvas, style->color, alpha_of(style));
  place(canvas, x, y);
  pango_cairo_show_layout(canvas->cr, canvas->layout);
  cairo_new_path(canvas->cr);
}

double sb_canvas_text(SbCanvas *canvas, const char *text, const SbTextStyle *style, double x,
                      double y, SbAlign align) {
  shape(canvas, text, style);
  double width = advance(canvas);
  show(canvas, style, x + align_offset(align, width), y);
  return width;
}

double sb_canvas_text_halo(SbCanvas *canvas, const char *text, const SbTextStyle *style, double x,
                           double y, SbAlign align) {
  shape(canvas, text, style);
  double width = advance(canvas), left = x + align_offset(align, width);
  cairo_save(canvas->cr);
  sb_canvas_pen(canvas, 3, NULL);
  sb_canvas_color(canvas, sb_canvas_role(canvas, SB_ROLE_PANEL), 0.92);
  place(canvas, left, y);
  // Coarse: a halo has no shape of its own, and fine ones cost a third of a page's time.
  cairo_set_tolerance(canvas->cr, 0.5);
  cairo_set_line_join(canvas->cr, CAIRO_LINE_JOIN_BEVEL);
  pango_cairo_layout_path(canvas->cr, canvas->layout);
  cairo_stroke(canvas->cr);
  cairo_restore(canvas->cr);
  show(canvas, style, left, y);
  return width;
}

double sb_canvas_text_plate(SbCanvas *canvas, const char *text, const SbTextStyle *style, double x,
                            double y, SbAlign align, SbColor ground) {
  SbRect box = text_box(canvas, text, style, x, y, align);
  sb_canvas_rounded(canvas, (SbRect){box.x - 4, box.y - 1, box.width + 8, box.height + 3}, 2);
  sb_canvas_color(canvas, ground, 1);
  cairo_fill(canvas->cr);
  return sb_canvas_text(canvas, text, style, x, y, align);
}

static double text_fit(SbCanvas *canvas, const char *text, const SbTextStyle *style, double x,
                       double y, double width, PangoEllipsizeMode where) {
  shape(canvas, text, style);
  double natural = advance(canvas);
  if (natural > width) {
    pango_layout_set_width(canvas->layout, (int)(fmax(width, 1) * PANGO_SCALE));
    pango_layout_set_ellipsize(canvas->layout, where);
    natural = width;
  }
  show(canvas, style, x, y);
  return natural;
}

double sb_canvas_text_fit(SbCanvas *canvas, const char *text, const SbTextStyle *style, double x,
                          double y, double width) {
  return text_fit(canvas, text, style, x, y, width, PANGO_ELLIPSIZE_END);
}

double sb_canvas_text_fit_ends(SbCanvas *canvas, const char *text, const SbTextStyle *style,
                               double x, double y, double width) {
  return text_fit(canvas, text, style, x, y, width, PANGO_ELLIPSIZE_MIDDLE);
}

// Lays a paragraph out; its height.
static double wrap(SbCanvas *canvas, const char *text, const SbTextStyle *style, double width) {
  shape(canvas, text, style);
  pango_layout_set_width(canvas->layout, (int)(fmax(width, 40) * PANGO_SCALE));
  pango_layout_set_wrap(canvas->layout, PANGO_WRAP_WORD_CHAR);
  PangoRectangle logical;
  pango_layout_get_extents(canvas->layout, NULL, &logical);
  return logical.height / (double)PANGO_SCALE;
}

double sb_canvas_paragraph_height(SbCanvas *canvas, const char *text, const SbTextStyle *style,
                                  double width) {
  return wrap(canvas, text, style, width);
}

double sb_canvas_paragraph_aligned(SbCanvas *canvas, const char *text, const SbTextStyle *style,
                                   double x, double y, double width, SbAlign align) {
  const double height = wrap(canvas, text, style, width);
  pango_layout_set_alignment(canvas->layout, align == SB_LEFT     ? PANGO_ALIGN_LEFT
                                             : align == SB_MIDDLE ? PANGO_ALIGN_CENTER
                                                                  : PANGO_ALIGN_RIGHT);
  sb_canvas_color(canvas, style->color, alpha_of(style));
  cairo_move_to(canvas->cr, x, y);
  pango_cairo_show_layout(canvas->cr, canvas->layout);
  cairo_new_path(canvas->cr);
  pango_layout_set_alignment(canvas->layout, PANGO_ALIGN_LEFT);
  return height;
}

double sb_canvas_paragraph(SbCanvas *canvas, const char *text, const SbTextStyle *style, double x,
                           double y, double width) {
  return sb_canvas_paragraph_aligned(canvas, text, style, x, y, width, SB_LEFT);
}

void sb_canvas_rounded(SbCanvas *canvas, SbRect rect, double radius) {
  cairo_t *cr = canvas->cr;
  double x0 = rect.x, y0 = rect.y, x1 = rect.x + rect.width, y1 = rect.y + rect.height;
  radius = fmin(radius, 0.5 * fmin(rect.width, rect.height));
  cairo_new_sub_path(cr);
  cairo_arc(cr, x1 - radius, y0 + radius, radius, -G_PI_2, 0);
  cairo_arc(cr, x1 - radius, y1 - radius, radius, 0, G_PI_2);
  cairo_arc(cr, x0 + radius, y1 - radius, radius, G_PI_2, G_PI);
  cairo_arc(cr, x0 + radius, y0 + radius, radius, G_PI, 1.5 * G_PI);
  cairo_close_path(cr);
}

void sb_canvas_panel(SbCanvas *canvas, SbRect rect) {
  sb_canvas_rounded(canvas, (SbRect){rect.x + 0.5, rect.y + 0.5, rect.width - 1, rect.height - 1},
                    SB_GRID_RADIUS);
  sb_canvas_color(canvas, sb_canvas_role(canvas, SB_ROLE_PANEL), 1);
  cairo_fill_preserve(canvas->cr);
  sb_canvas_pen(canvas, 1, NULL);
  sb_canvas_color(canvas, sb_canvas_role(canvas, SB_ROLE_HAIRLINE), 1);
  cairo_stroke(canvas->cr);
}

void sb_canvas_hairline(SbCanvas *canvas, double x0, double y0, double x1, double y1,
                        SbColor color) {
  cairo_t *cr = canvas->cr;
  sb_canvas_pen(canvas, 1, NULL);
  sb_canvas_color(canvas, color, 1);
  if (y0 == y1) {
    y0 = y1 = floor(y0) + 0.5;
  }
  if (x0 == x1) {
    x0 = x1 = floor(x0) + 0.5;
  }
  cairo_move_to(cr, x0, y0);
  cairo_line_to(cr, x1, y1);
  cairo_stroke(cr);
}

// Device pixels per user unit.
static double device_scale(cairo_t *cr) {
  double dx = 1, dy = 0, sx = 1, sy = 1;
  cairo_user_to_device_distance(cr, &dx, &dy);
  cairo_surface_get_device_scale(cairo_get_target(cr), &sx, &sy);
  double scale = hypot(dx, dy) * sx;
  return scale > 0 ? scale : 1;
}

// Walks the thinned polyline. With `stroke`, strokes every 500 points; otherwise only adds to the
// path.
static void walk(SbCanvas *canvas, const SbPoint *point, size_t count, bool stroke) {
  cairo_t *cr = canvas->cr;
  const double gap = 0.5 / device_scale(cr);
  enum { RUN = 500 };
  double dash[4], offset = 0, length = 0;
  int dashes = cairo_get_dash_count(cr);
  if (dashes > 0) {
    cairo_get_dash(cr, dash, &offset);
  }
  bool open = false;
  SbPoint last = {0, 0};
  size_t run = 0;
  for (size_t i = 0; i < count; i++) {
    SbPoint p = point[i];
    if (!isfinite(p.x) || !isfinite(p.y)) {
      open = false;
      continue;
    }
    if (!open) {
      cairo_move_to(cr, p.x, p.y);
      last = p;
      open = true;
      continue;
    }
    bool end = i + 1 == count || !isfinite(point[i + 1].x) || !isfinite(point[i + 1].y);
    double d = hypot(p.x - last.x, p.y - last.y);
    if (d < gap && !end) {
      continue;
    }
    cairo_line_to(cr, p.x, p.y);
    length += d;
    last = p;
    if (stroke && ++run >= RUN && !end) {
      cairo_stroke(cr);
      if (dashes > 0) {
        cairo_set_dash(cr, dash, dashes, offset + length);
      }
      cairo_move_to(cr, p.x, p.y);
      run = 0;
    }
  }
  if (stroke) {
    cairo_stroke(cr);
    if (dashes > 0) {
      cairo_set_dash(cr, dash, dashes, offset);
    }
  }
}

void sb_canvas_polyline(SbCanvas *canvas, const SbPoint *point, size_t count) {
  cairo_new_path(canvas->cr);
  walk(canvas, point, count, true);
}

void sb_canvas_curve(SbCanvas *canvas, SbStroke stroke, const SbPoint *point, size_t count) {
  sb_canvas_stroke(canvas, stroke);
  sb_canvas_polyline(canvas, point, count);
}

void sb_canvas_line(SbCanvas *canvas, SbStroke stroke, double x0, double y0, double x1, double y1) {
  sb_canvas_stroke(canvas, stroke);
  cairo_move_to(canvas->cr, x0, y0);
  cairo_line_to(canvas->cr, x1, y1);
  cairo_stroke(canvas->cr);
}

void sb_canvas_fill(SbCanvas *canvas, SbRect rect, SbRole role, double alpha) {
  sb_canvas_color(canvas, sb_canvas_role(canvas, role), alpha);
  cairo_rectangle(canvas->cr, rect.x, rect.y, rect.width, rect.height);
  cairo_fill(canvas->cr);
}

void sb_canvas_area(SbCanvas *canvas, const SbPoint *point, size_t count, SbRole role,
                    double alpha) {
  cairo_new_path(canvas->cr);
  sb_canvas_path(canvas, point, count);
  cairo_close_path(canvas->cr);
  sb_canvas_color(canvas, sb_canvas_role(canvas, role), alpha);
  cairo_fill(canvas->cr);
}

void sb_canvas_clip(SbCanvas *canvas, SbRect rect) {
  cairo_save(canvas->cr);
  cairo_rectangle(canvas->cr, rect.x, rect.y, rect.width, rect.height);
  cairo_clip(canvas->cr);
}

void sb_canvas_hatch(SbCanvas *canvas, SbRect rect, double pitch, bool left, SbRole role,
                     double alpha) {
  const double bottom = rect.y + rect.height;
  sb_canvas_clip(canvas, rect);
  sb_canvas_pen(canvas, 0.7, NULL);
  sb_canvas_color(canvas, sb_canvas_role(canvas, role), alpha);
  for (double x = rect.x - rect.height; x < rect.x + rect.width; x += pitch) {
    cairo_move_to(canvas->cr, x, left ? rect.y : bottom);
    cairo_line_to(canvas->cr, x + rect.height, left ? bottom : rect.y);
  }
  cairo_stroke(canvas->cr);
  cairo_restore(canvas->cr);
}

void sb_canvas_path(SbCanvas *canvas, const SbPoint *point, size_t count) {
  walk(canvas, point, count, false);
}

void sb_canvas_arrowhead(SbCanvas *canvas, double x, double y, double dx, double dy, double size) {
  cairo_t *cr = canvas->cr;
  double length = hypot(dx, dy);
  if (!(length > 0)) {
    return;
  }
  dx /= length;
  dy /= length;
  const double back = 11 * size, half = 4.5 * size, notch = 0.78 * back;
  cairo_new_path(cr);
  cairo_move_to(cr, x, y);
  cairo_line_to(cr, x - back * dx - half * dy, y - back * dy + half * dx);
  cairo_line_to(cr, x - notch * dx, y - notch * dy);
  cairo_line_to(cr, x - back * dx + half * dy, y - back * dy - half * dx);
  cairo_close_path(cr);
  cairo_fill(cr);
}

void sb_canvas_dot(SbCanvas *canvas, double x, double y, double radius, SbColor color) {
  cairo_new_path(canvas->cr);
  cairo_arc(canvas->cr, x, y, radius, 0, 2 * G_PI);
  sb_canvas_color(canvas, color, 1);
  cairo_fill(canvas->cr);
}

void sb_canvas_ringed_dot(SbCanvas *canvas, double x, double y, SbColor ring) {
  sb_canvas_dot(canvas, x, y, 5.0, ring);
  sb_canvas_dot(canvas, x, y, 3.4, sb_canvas_role(canvas, SB_ROLE_PANEL));
}
