// See surface_map.h. Heights about the mean plane in a diverging map: valleys and peaks differ in
// hue, and what is near the mean recedes. A pixel of the map is the mean of its points; where none
// is measured the panel's hairline colour stands.
#include "app/chart/surface_map.h"

#include "app/base/format.h"
#include "app/draw/axis.h"

#include <glib.h>
#include <math.h>

enum { PIXELS_MAX = 512, COLORS = 256 };

typedef struct {
  SbCanvas *canvas;
  const SbHeights *heights;
  SbRect plot;
  double full;    // heights that fill the scale [m]
  double lateral; // unit of x and y [m]
} Map;

static guint32 pixel(SbColor c) {
  return 0xff000000u | (guint32)lround(255 * c.r) << 16 | (guint32)lround(255 * c.g) << 8 |
         (guint32)lround(255 * c.b);
}

// Mean of the points under a pixel; NaN where none is measured.
static double block(const SbHeights *h, size_t top, size_t bottom, size_t left, size_t right) {
  double sum = 0, count = 0;
  for (size_t i = top; i < bottom; i++) {
    for (size_t j = left; j < right; j++) {
      const double z = h->z[i * h->stride + j];
      sum += isnan(z) ? 0 : z;
      count += !isnan(z);
    }
  }
  return count > 0 ? sum / count : NAN;
}

static void draw_image(const Map *map) {
  const SbHeights *h = map->heights;
  SbCanvas *c = map->canvas;
  const size_t width = MIN(h->columns, PIXELS_MAX), height = MIN(h->rows, PIXELS_MAX);
  cairo_surface_t *image = cairo_image_surface_create(CAIRO_FORMAT_RGB24, (int)width, (int)height);
  guint32 colors[COLORS];
  for (int k = 0; k < COLORS; k++) {
    colors[k] = pixel(sb_theme_diverging(c->theme, 2.0 * k / (COLORS - 1) - 1));
  }
  const guint32 none = pixel(sb_canvas_role(c, SB_ROLE_HAIRLINE));
  unsigned char *data = cairo_image_surface_get_data(image);
  const size_t stride = (size_t)cairo_image_surface_get_stride(image);
  for (size_t i = 0; i < height && data != NULL; i++) {
    guint32 *row = (guint32 *)(void *)(data + i * stride);
    for (size_t j = 0; j < width; j++) {
      const double z = block(h, i * h->rows / height, (i + 1) * h->rows / height,
                             j * h->columns / width, (j + 1) * h->columns / width);
      const double t = CLAMP(0.5 + z / map->full / 2, 0, 1);
      row[j] = isnan(z) ? none : colors[(int)lround(t * (COLORS - 1))];
    }
  }
  cairo_surface_mark_dirty(image);
  cairo_save(c->cr);
  cairo_translate(c->cr, map->plot.x, map->plot.y);
  cairo_scale(c->cr, map->plot.width / (double)width, map->plot.height / (double)height);
  cairo_set_source_surface(c->cr, image, 0, 0);
  // Enlarged points stay squares.
  cairo_pattern_set_filter(cairo_get_source(c->cr),
                           width < 200 ? CAIRO_FILTER_NEAREST : CAIRO_FILTER_GOOD);
  cairo_pattern_set_extend(cairo_get_source(c->cr), CAIRO_EXTEND_PAD);
  cairo_rectangle(c->cr, 0, 0, (double)width, (double)height);
  cairo_fill(c->cr);
  cairo_restore(c->cr);
  cairo_surface_destroy(image);
}

// The scale of heights beside the map.
static void draw_surface_map_scale(const Map *map) {
  enum { STEPS = 64, WIDTH = 14 };
  SbCanvas *c = map->canvas;
  const double x = map->plot.x + map->plot.width + 14;
  const double bottom = map->plot.y + map->plot.height, step = map->plot.height / STEPS;
  for (int k = 0; k < STEPS; k++) {
    sb_canvas_color(c, sb_theme_diverging(c->theme, 2.0 * k / (STEPS - 1) - 1), 1);
    cairo_rectangle(c->cr, x, bottom - (k + 1) * step, WIDTH, step + 0.5);
    cairo_fill(c->cr);
  }
  const double full = map->full * 1e6;
  const SbScale scale = {-full, full, bottom, map->plot.y, false};
  const SbTextStyle style = sb_canvas_style(c, SB_TYPE_LABEL, 400, SB_ROLE_SECOND);
  SbTicks ticks;
  sb_axis_ticks(&ticks, -full, full, 5);
  for (int i = 0; i < ticks.count; i++) {
    char text[SB_FORMAT_MAX];
    const double y = sb_axis_at(&scale, ticks.value[i]);
    sb_format_fixed(text, ticks.value[i], ticks.decimals);
    sb_canvas_hairline(c, x + WIDTH, y, x + WIDTH + 4, y, sb_canvas_role(c, SB_ROLE_AXIS));
    sb_canvas_text(c, text, &style, x + WIDTH + 8, y + 4.3, SB_LEFT);
  }
  sb_canvas_text(c, "z / \xc2\xb5m", &style, x, map->plot.y - 10, SB_LEFT);
}

// A profile's heights; no more points than pixels can show.
static void draw_line(const Map *map, const SbAxes *at) {
  const SbHeights *h = map->heights;
  SbCanvas *c = map->canvas;
  const size_t step = h->columns / 8192 + 1;
  g_autofree SbPoint *point = g_new(SbPoint, h->columns / step + 1);
  size_t count = 0;
  for (size_t j = 0; j < h->columns; j += step) {
    point[count++] = sb_axes_at(at, (double)j * h->dx / map->lateral, h->z[j] * 1e6);
  }
  sb_canvas_clip(c, map->plot);
  sb_canvas_curve(c, (SbStroke){SB_ROLE_INK, 1.2, NULL}, point, count);
  cairo_restore(c->cr);
}

void sb_surface_map_draw(cairo_t *cr, SbRect rect, const SbTheme *theme, const SbHeights *h,
                         double sq) {
  SbCanvas canvas;
  sb_canvas_init(&canvas, cr, theme);
  sb_canvas_panel(&canvas, rect);
  const bool surface = h->rows > 1;
  const double width = (double)h->columns * h->dx, height = surface ? (double)h->rows * h->dy : 0;
  const bool large = fmax(width, height) >= 2e-3;
  Map map = {.canvas = &canvas, .heights = h, .full = 3 * sq, .lateral = large ? 1e-3 : 1e-6};
  const char *length = large ? "mm" : "\xc2\xb5m";
  SbRect room = {rect.x + 62, rect.y + 50, rect.width - 62 - (surface ? 84 : 24),
                 rect.height - 50 - 52};
  room.width = fmax(room.width, 20);
  room.height = fmax(room.height, 20);
  if (surface) {
    // The shape of the scan, in the middle of its room.
    const double scale = fmin(room.width / width, room.height / height);
    const double w = fmax(scale * width, 4), v = fmax(scale * height, 4);
    room = (SbRect){room.x + (room.width - w) / 2, room.y + (room.height - v) / 2, w, v};
  }
  map.plot = room;
  const double top = surface ? height / map.lateral : 3.5 * sq * 1e6;
  g_autofree char *name = g_strdup_printf(surface ? "x, y / %s" : "x / %s", length);
  SbAxes at = {.x_name = name};
  // Rows are counted downwards, as pictures are.
  sb_axes_linear(&at, room, 0, width / map.lateral, surface ? top : -top, surface ? 0 : top);
  sb_axes_ticks(&at, room.width > 300 ? 6 : 3, room.height > 300 ? 6 : 3);
  sb_axes_draw(&canvas, &at, NULL);
  if (surface) {
    draw_image(&map);
    draw_surface_map_scale(&map);
  } else {
    draw_line(&map, &at);
  }
  if (!surface) {
    const SbTextStyle style = sb_canvas_style(&canvas, SB_TYPE_LABEL, 400, SB_ROLE_SECOND);
    sb_canvas_text(&canvas, "z / \xc2\xb5m", &style, rect.x + 14, rect.y + 30, SB_LEFT);
  }
  sb_canvas_finish(&canvas);
}
