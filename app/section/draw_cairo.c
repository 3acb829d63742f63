// Item by item. The hatch is drawn as lines clipped to its polygon, so that SVG and PDF stay small
// and sharp. A field is painted as a mesh pattern, a legend (a mesh that is a rectangle) as a
// linear gradient, and the shaded cells of a cutaway one by one.
#include "app/section/draw_cairo.h"

#include <glib.h>
#include <math.h>
#include <pango/pangocairo.h>
#include <string.h>

static void set_color(cairo_t *cr, SbColor color) {
  cairo_set_source_rgba(cr, color.r, color.g, color.b, color.a);
}

static void trace(cairo_t *cr, const SbPoint *points, size_t count, bool closed) {
  for (size_t i = 0; i < count; i++) {
    if (i == 0) {
      cairo_move_to(cr, points[i].x, points[i].y);
    } else {
      cairo_line_to(cr, points[i].x, points[i].y);
    }
  }
  if (closed) {
    cairo_close_path(cr);
  }
}

static void draw_hatch(cairo_t *cr, const SbDrawHatch *hatch) {
  double x0, y0, x1, y1;
  cairo_clip_extents(cr, &x0, &y0, &x1, &y1);
  double nx = hatch->across_x, ny = hatch->across_y;
  double step = hatch->pitch;
  // Across the lines and along them over the range of the corners.
  double middle = nx * (x0 + x1) / 2 + ny * (y0 + y1) / 2;
  double along = -ny * (x0 + x1) / 2 + nx * (y0 + y1) / 2;
  double half = (fabs(nx) * (x1 - x0) + fabs(ny) * (y1 - y0)) / 2;
  double reach = (fabs(ny) * (x1 - x0) + fabs(nx) * (y1 - y0)) / 2;
  double offset = hatch->offset;
  double first = offset + ceil((middle - half - offset) / step) * step;
  for (double c = first; c <= middle + half; c += step) {
    cairo_move_to(cr, nx * c - ny * (along - reach), ny * c + nx * (along - reach));
    cairo_line_to(cr, nx * c - ny * (along + reach), ny * c + nx * (along + reach));
  }
  cairo_set_dash(cr, NULL, 0, 0);
  cairo_set_line_width(cr, hatch->width);
  set_color(cr, hatch->color);
  cairo_stroke(cr);
}

static void draw_fill(cairo_t *cr, const SbDrawItem *item, const SbPoint *points) {
  trace(cr, points, item->count, true);
  set_color(cr, item->color);
  if (item->hatch.width <= 0) {
    cairo_fill(cr);
    return;
  }
  cairo_fill_preserve(cr);
  cairo_save(cr);
  cairo_clip(cr);
  draw_hatch(cr, &item->hatch);
  cairo_restore(cr);
}

static void draw_stroke(cairo_t *cr, const SbDrawItem *item, const SbPoint *points) {
  trace(cr, points, item->count, item->closed);
  cairo_set_line_width(cr, item->width);
  cairo_set_line_join(cr, CAIRO_LINE_JOIN_ROUND);
  cairo_set_line_cap(cr, CAIRO_LINE_CAP_BUTT);
  cairo_set_dash(cr, item->dash != NULL ? item->dash->length : NULL,
                 item->dash != NULL ? item->dash->count : 0, 0);
  set_color(cr, item->color);
  cairo_stroke(cr);
}

static SbColor map_color(const SbDrawItem *item, float scalar) {
  float t = (scalar - item->map_min) / fmaxf(item->map_max - item->map_min, 1e-30f);
  return item->map->entry[(int)(255.0f * CLAMP(t, 0, 1.0f) + 0.5f)];
}

// Lines of equal value: in each triangle the segment between the two sides that a level crosses.
static void draw_isolines(cairo_t *cr, const SbDrawItem *item, const SbPoint *points,
                          const float *scalars) {
  double range = (item->map_max - item->map_min) / item->isolines;
  for (size_t i = 0; i + 2 < item->count && range > 0; i += 3) {
    double v[3];
    for (int k = 0; k < 3; k++) {
      v[k] = (scalars[i + (size_t)k] - item->map_min) / range;
    }
    double low = fmin(v[0], fmin(v[1], v[2])), high = fmax(v[0], fmax(v[1], v[2]));
    for (double level = ceil(low); level < high; level += 1) {
      bool begun = false;
      for (int k = 0; k < 3; k++) {
        double a = v[k], b = v[(k + 1) % 3];
        if ((a < level) == (b < level)) {
          continue;
        }
        SbPoint p = points[i + (size_t)k], q = points[i + (size_t)((k + 1) % 3)];
        double t = (level - a) / (b - a);
        double x = p.x + t * (q.x - p.x), y = p.y + t * (q.y - p.y);
        if (begun) {
          cairo_line_to(cr, x, y);
        } else {
          cairo_move_to(cr, x, y);
        }
        begun = true;
      }
    }
  }
  cairo_set_line_width(cr, item->width);
  set_color(cr, item->line_color);
  cairo_stroke(cr);
}

// The colours of a map along a rectangle, from its left to its right end: a legend.
static void draw_legend(cairo_t *cr, const SbDrawItem *item, const SbPoint *points,
                        const float *scalars) {
  cairo_pattern_t *gradient = cairo_pattern_create_linear(points[0].x, 0.0, points[1].x, 0.0);
  for (int i = 0; i <= 32; i++) {
    SbColor c = map_color(item, scalars[0] + (scalars[1] - scalars[0]) * (float)i / 32.0f);
    cairo_pattern_add_color_stop_rgb(gradient, i / 32.0, c.r, c.g, c.b);
  }
  cairo_rectangle(cr, points[0].x, points[0].y, points[2].x - points[0].x,
                  points[2].y - points[0].y);
  cairo_set_source(cr, gradient);
  cairo_fill(cr);
  cairo_pattern_destroy(gradient);
}

// Cells of one colour, with a hairline of this colour against seams.
static void draw_cells(cairo_t *cr, const SbDrawItem *item, const SbPoint *points,
                       const float *scalars) {
  cairo_set_line_width(cr, 0.4);
  cairo_set_dash(cr, NULL, 0, 0);
  cairo_set_line_join(cr, CAIRO_LINE_JOIN_ROUND);
  for (size_t i = 0; i + 2 < item->count; i += 3) {
    // Two triangles of a cell are one quadrilateral.
    bool pair = i + 5 < item->count && memcmp(points + i, points + i + 3, sizeof *points) == 0 &&
                memcmp(points + i + 2, points + i + 4, sizeof *points) == 0;
    float mean = (scalars[i] + scalars[i + 1] + scalars[i + 2]) / 3.0f;
    if (pair) {
      const SbPoint corner[4] = {points[i], points[i + 1], points[i + 2], points[i + 5]};
      mean = 0.75f * mean + 0.25f * scalars[i + 5];
      trace(cr, corner, 4, true);
      i += 3;
    } else {
      trace(cr, points + i, 3, true);
    }
    set_color(cr, map_color(item, mean));
    cairo_fill_preserve(cr);
    cairo_stroke(cr);
  }
}

// The rectangle around points.
static SbRect box_of(const SbPoint *points, size_t count) {
  SbPoint low = {INFINITY, INFINITY}, high = {-INFINITY, -INFINITY};
  for (size_t i = 0; i < count; i++) {
    low = (SbPoint){fmin(low.x, points[i].x), fmin(low.y, points[i].y)};
    high = (SbPoint){fmax(high.x, points[i].x), fmax(high.y, points[i].y)};
  }
  return (SbRect){low.x, low.y, high.x - low.x, high.y - low.y};
}

// Triangles inside of `within` with colours interpolated between those of their corners. (The
// fourth corner of a patch of three sides is its first, so that the colours are linear.)
static cairo_pattern_t *mesh_pattern(const SbDrawItem *item, const SbPoint *points,
                                     const float *scalars, const SbRect *within) {
  cairo_pattern_t *mesh = cairo_pattern_create_mesh();
  for (size_t i = 0; i + 2 < item->count; i += 3) {
    const SbRect box = box_of(points + i, 3);
    if (box.x > within->x + within->width || box.x + box.width < within->x ||
        box.y > within->y + within->height || box.y + box.height < within->y) {
      continue;
    }
    cairo_mesh_pattern_begin_patch(mesh);
    for (unsigned k = 0; k < 3; k++) {
      const SbColor c = map_color(item, scalars[i + k]);
      cairo_mesh_pattern_line_to(mesh, points[i + k].x, points[i + k].y);
      cairo_mesh_pattern_set_corner_color_rgb(mesh, k, c.r, c.g, c.b);
    }
    cairo_mesh_pattern_end_patch(mesh);
  }
  return mesh;
}

// Makes the source of `cr` a picture of it inside of `within`, of three pixels per unit: SVG has no
// mesh patterns, and cairo would turn everything near them into pixels.
static void rasterise_source(cairo_t *cr, const SbRect *within) {
  const double scale = 3;
  cairo_surface_t *image = cairo_image_surface_create(
      CAIRO_FORMAT_ARGB32, (int)ceil(scale * within->width), (int)ceil(scale * within->height));
  cairo_surface_set_device_scale(image, scale, scale);
  cairo_surface_set_device_offset(image, -scale * within->x, -scale * within->y);
  cairo_t *pixels = cairo_create(image);
  cairo_set_source(pixels, cairo_get_source(cr));
  cairo_paint(pixels);
  cairo_destroy(pixels);
  cairo_set_source_surface(cr, image, 0, 0);
  cairo_surface_destroy(image);
}

static void draw_field(cairo_t *cr, const SbDrawItem *item, const SbPoint *points,
                       const float *scalars) {
  SbRect box = box_of(points, item->count);
  double x0, y0, x1, y1;
  cairo_save(cr);
  cairo_rectangle(cr, box.x, box.y, box.width, box.height);
  cairo_clip(cr);
  cairo_clip_extents(cr, &x0, &y0, &x1, &y1);
  box = (SbRect){x0, y0, x1 - x0, y1 - y0};
  cairo_pattern_t *mesh = mesh_pattern(item, points, scalars, &box);
  cairo_set_source(cr, mesh);
  if (cairo_surface_get_type(cairo_get_target(cr)) == CAIRO_SURFACE_TYPE_SVG) {
    rasterise_source(cr, &box);
  }
  cairo_paint(cr);
  cairo_pattern_destroy(mesh);
  cairo_restore(cr);
}

static void draw_mesh(cairo_t *cr, const SbDrawItem *item, const SbPoint *points,
                      const float *scalars) {
  if (item->shaded) {
    draw_cells(cr, item, points, scalars);
  } else if (item->count == 6) {
    draw_legend(cr, item, points, scalars);
  } else {
    draw_field(cr, item, points, scalars);
  }
  if (item->isolines > 0) {
    draw_isolines(cr, item, points, scalars);
  }
}

static void draw_text(cairo_t *cr, const SbDrawItem *item, const char *string, SbText *text) {
  double baseline, width;
  PangoLayout *layout = sb_text_layout(text, string, item->size, item->weight, &baseline, &width);
  double x = item->x;
  if (item->align == SB_MIDDLE) {
    x -= width / 2;
  } else if (item->align == SB_RIGHT) {
    x -= width;
  }
  cairo_move_to(cr, x, item->y - baseline);
  set_color(cr, item->color);
  // Pixels: outlines, since cairo puts cached glyphs on whole pixels. SVG and PDF: text.
  if (cairo_surface_get_type(cairo_get_target(cr)) == CAIRO_SURFACE_TYPE_IMAGE) {
    pango_cairo_layout_path(cr, layout);
    cairo_fill(cr);
  } else {
    pango_cairo_show_layout(cr, layout);
  }
}

void sb_draw_list_to_cairo(const SbDrawList *list, SbText *text, cairo_t *cr) {
  cairo_save(cr);
  cairo_rectangle(cr, 0, 0, list->width, list->height);
  set_color(cr, list->background);
  cairo_fill(cr);
  for (size_t i = 0; i < list->item_count; i++) {
    const SbDrawItem *item = &list->item[i];
    const SbRect *clip = &list->clip[item->clip];
    bool clipped = item->clip != 0;
    if (clipped) {
      cairo_save(cr);
      cairo_rectangle(cr, clip->x, clip->y, clip->width, clip->height);
      cairo_clip(cr);
    }
    const SbPoint *points = list->point + item->first;
    switch (item->kind) {
    case SB_DRAW_FILL:
      draw_fill(cr, item, points);
      break;
    case SB_DRAW_STROKE:
      draw_stroke(cr, item, points);
      break;
    case SB_DRAW_MESH:
      draw_mesh(cr, item, points, list->scalar + item->first_scalar);
      break;
    case SB_DRAW_TEXT:
      draw_text(cr, item, list->text + item->first, text);
      break;
    }
    if (clipped) {
      cairo_restore(cr);
    }
  }
  cairo_restore(cr);
}
