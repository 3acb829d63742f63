// Pictures in cells and pixels. See picture.h. A half block shows two pixels of the picture as they
// are, so nothing is left to choose there; pixel formats are chafa's.
#include "app/terminal/picture.h"

#include "app/section/draw_cairo.h"
#include "app/terminal/plot.h"

#include <chafa.h>
#include <math.h>
#include <string.h>

SbPictures sb_pictures_of_environment(SbColors colors, bool ascii) {
  // A multiplexer passes no pixels on unless it says so itself.
  const bool nested = g_getenv("TMUX") != NULL || g_getenv("STY") != NULL;
  if (!nested && colors != SB_COLORS_NONE) {
    g_auto(GStrv) environment = g_get_environ();
    ChafaTermInfo *info = chafa_term_db_detect(chafa_term_db_get_default(), environment);
    const bool kitty =
        chafa_term_info_have_seq(info, CHAFA_TERM_SEQ_BEGIN_KITTY_IMMEDIATE_IMAGE_V1);
    const bool iterm = chafa_term_info_have_seq(info, CHAFA_TERM_SEQ_BEGIN_ITERM2_IMAGE);
    const bool sixel = chafa_term_info_have_seq(info, CHAFA_TERM_SEQ_BEGIN_SIXELS);
    chafa_term_info_unref(info);
    // Many call themselves xterm, which may or may not: those are asked (screen_input.c).
    const char *term = g_getenv("TERM");
    if (kitty) {
      return SB_PICTURES_KITTY;
    }
    if (iterm) {
      return SB_PICTURES_ITERM;
    }
    if (sixel && term != NULL && !g_str_has_prefix(term, "xterm")) {
      return SB_PICTURES_SIXEL;
    }
  }
  return colors >= SB_COLORS_256 && !ascii ? SB_PICTURES_BLOCKS : SB_PICTURES_LINES;
}

// Pixels ----------------------------------------------------------------------------------------

// The list on width x height pixels, its own proportions kept if it has those of the cells.
static cairo_surface_t *rasterise(const SbDrawList *list, SbText *text, int width, int height,
                                  bool fast) {
  cairo_surface_t *surface = cairo_image_surface_create(CAIRO_FORMAT_RGB24, width, height);
  cairo_t *cr = cairo_create(surface);
  cairo_set_antialias(cr, fast ? CAIRO_ANTIALIAS_FAST : CAIRO_ANTIALIAS_DEFAULT);
  cairo_scale(cr, width / list->width, height / list->height);
  sb_draw_list_to_cairo(list, text, cr);
  cairo_destroy(cr);
  cairo_surface_flush(surface);
  return surface;
}

static ChafaCanvas *make_canvas(SbPictures pictures, int columns, int rows, int width, int height) {
  ChafaCanvasConfig *config = chafa_canvas_config_new();
  chafa_canvas_config_set_geometry(config, columns, rows);
  chafa_canvas_config_set_canvas_mode(config, CHAFA_CANVAS_MODE_TRUECOLOR);
  chafa_canvas_config_set_pixel_mode(config, pictures == SB_PICTURES_SIXEL ? CHAFA_PIXEL_MODE_SIXELS
                                             : pictures == SB_PICTURES_KITTY
                                                 ? CHAFA_PIXEL_MODE_KITTY
                                                 : CHAFA_PIXEL_MODE_ITERM2);
  chafa_canvas_config_set_cell_geometry(config, width, height);
  chafa_canvas_config_set_preprocessing_enabled(config, FALSE);
  chafa_canvas_config_set_dither_mode(config, CHAFA_DITHER_MODE_NONE);
  chafa_canvas_config_set_work_factor(config, 0.1f);
  ChafaCanvas *canvas = chafa_canvas_new(config);
  chafa_canvas_config_unref(config);
  return canvas;
}

static GString *encode(const unsigned char *pixels, int width, int height, int stride,
                       SbPictures pictures, int columns, int rows, int cell_height) {
  ChafaCanvas *canvas = make_canvas(pictures, columns, rows, MAX(width / columns, 1), cell_height);
  chafa_canvas_draw_all_pixels(canvas,
                               G_BYTE_ORDER == G_LITTLE_ENDIAN ? CHAFA_PIXEL_BGRA8_UNASSOCIATED
                                                               : CHAFA_PIXEL_ARGB8_UNASSOCIATED,
                               pixels, width, height, stride);
  ChafaTermInfo *info = chafa_term_db_get_fallback_info(chafa_term_db_get_default());
  GString *out = chafa_canvas_print(canvas, info);
  chafa_term_info_unref(info);
  chafa_canvas_unref(canvas);
  return out;
}

// Of 24 bits a pixel cairo leaves the fourth byte as it was: chafa takes it for opacity.
static void make_opaque(cairo_surface_t *surface) {
  unsigned char *data = cairo_image_surface_get_data(surface);
  const int stride = cairo_image_surface_get_stride(surface);
  for (int y = 0; y < cairo_image_surface_get_height(surface); y++) {
    uint32_t *row = (uint32_t *)(void *)(data + (size_t)y * (size_t)stride);
    for (int x = 0; x < cairo_image_surface_get_width(surface); x++) {
      row[x] |= 0xff000000u;
    }
  }
}

int sb_picture_height(SbPictures pictures, int rows, int height) {
  enum { BAND = 6 };
  const int whole = rows * height;
  return pictures == SB_PICTURES_SIXEL && whole > BAND ? whole - whole % BAND : whole;
}

GString *sb_picture_pixels(const SbDrawList *list, SbText *text, SbPictures pictures, int columns,
                           int rows, int width, int height) {
  const int high = sb_picture_height(pictures, rows, height);
  cairo_surface_t *surface = rasterise(list, text, columns * width, high, false);
  make_opaque(surface);
  GString *out = encode(cairo_image_surface_get_data(surface), columns * width, high,
                        cairo_image_surface_get_stride(surface), pictures, columns, rows, height);
  cairo_surface_destroy(surface);
  return out;
}

const char *sb_picture_removal(SbPictures pictures) {
  return pictures == SB_PICTURES_KITTY ? "\033_Ga=d\033\\" : "";
}

// The list for so few pixels, a shallow copy: without its text, which stands in characters over the
// cells, and without hatches, of which dirt would be left.
static SbDrawList coarse(const SbDrawList *list) {
  SbDrawList out = *list;
  out.item = g_new(SbDrawItem, list->item_count + 1);
  out.item_count = 0;
  for (size_t i = 0; i < list->item_count; i++) {
    if (list->item[i].kind != SB_DRAW_TEXT) {
      out.item[out.item_count] = list->item[i];
      out.item[out.item_count++].hatch.width = 0;
    }
  }
  return out;
}

// Cells -----------------------------------------------------------------------------------------

static void draw_labels(SbCells *cells, SbCellRect rect, const SbDrawList *list) {
  g_autofree bool *taken = g_new0(bool, (size_t)rect.width *(size_t)rect.height);
  for (size_t i = 0; i < list->item_count; i++) {
    const SbDrawItem *item = &list->item[i];
    if (item->kind != SB_DRAW_TEXT) {
      continue;
    }
    const char *label = list->text + item->first;
    const int width = sb_cells_width(cells, label);
    const int anchor = (int)floor(item->x / list->width * rect.width);
    const int row = (int)floor((item->y - 0.35 * item->size) / list->height * rect.height);
    int column = item->align == SB_LEFT     ? anchor
                 : item->align == SB_MIDDLE ? anchor - width / 2
                                            : anchor - width;
    column = CLAMP(column, 0, MAX(rect.width - width, 0));
    bool room = row >= 0 && row < rect.height && width <= rect.width;
    for (int x = MAX(column - 1, 0); room && x < MIN(column + width + 1, rect.width); x++) {
      room = !taken[(size_t)row * (size_t)rect.width + (size_t)x];
    }
    if (!room) {
      continue;
    }
    for (int x = 0; x < width; x++) {
      taken[(size_t)row * (size_t)rect.width + (size_t)(column + x)] = true;
    }
    // Of a cell of two colours one ground remains, the same along the text.
    for (int x = 0; x < width; x++) {
      const int at = rect.x + column + x, y = rect.y + row;
      const SbCell *cell = &cells->cell[(size_t)y * (size_t)cells->columns + (size_t)at];
      const uint32_t ground = cell->pen.ground;
      sb_cells_put(cells, at, y, ' ', (SbPen){ground, ground, 0});
    }
    sb_cells_text(
        cells, rect.x + column, rect.y + row, width, label,
        (SbPen){sb_cell_color(item->color), SB_CELL_OWN, item->weight >= 600 ? SB_CELL_BOLD : 0});
  }
}

void sb_picture_blocks(SbCells *cells, SbCellRect rect, const SbDrawList *list, SbText *text) {
  SbDrawList bare = coarse(list);
  cairo_surface_t *surface = rasterise(&bare, text, rect.width, 2 * rect.height, true);
  const unsigned char *data = cairo_image_surface_get_data(surface);
  const size_t stride = (size_t)cairo_image_surface_get_stride(surface);
  for (int y = 0; y < rect.height; y++) {
    const uint32_t *upper = (const uint32_t *)(const void *)(data + (size_t)(2 * y) * stride);
    const uint32_t *lower = (const uint32_t *)(const void *)(data + (size_t)(2 * y + 1) * stride);
    for (int x = 0; x < rect.width; x++) {
      sb_cells_put(cells, rect.x + x, rect.y + y, 0x2580,
                   (SbPen){upper[x] & 0xffffffu, lower[x] & 0xffffffu, 0});
    }
  }
  cairo_surface_destroy(surface);
  g_free(bare.item);
  draw_labels(cells, rect, list);
}

void sb_picture_lines(SbCells *cells, SbCellRect rect, const SbDrawList *list) {
  enum { FAINT = 40 }; // per cent of opacity below which a line is left out
  const SbScale x = {.lo = 0, .hi = list->width}, y = {.lo = 0, .hi = list->height};
  SbPlot plot;
  sb_plot_init(&plot, cells, rect, &x, &y);
  g_autoptr(GArray) line = g_array_new(FALSE, FALSE, sizeof(double));
  for (size_t i = 0; i < list->item_count; i++) {
    const SbDrawItem *item = &list->item[i];
    if (item->kind != SB_DRAW_STROKE || item->color.a < 0.01 * FAINT || item->count == 0) {
      continue;
    }
    const SbRect *clip = &list->clip[item->clip];
    const size_t count = item->count + (item->closed ? 1 : 0);
    g_array_set_size(line, (guint)(2 * count));
    double *px = (double *)(void *)line->data, *py = px + count;
    for (size_t k = 0; k < count; k++) {
      const SbPoint *point = &list->point[item->first + k % item->count];
      const bool in = point->x >= clip->x - 1 && point->x <= clip->x + clip->width + 1 &&
                      point->y >= clip->y - 1 && point->y <= clip->y + clip->height + 1;
      px[k] = in ? point->x : NAN;
      py[k] = list->height - point->y;
    }
    const SbPlotLine look = {.ink = sb_cell_color(item->color),
                             .rank = 1,
                             .on = item->dash != NULL ? 3 : 0,
                             .off = item->dash != NULL ? 2 : 0};
    sb_plot_curve(&plot, px, py, count, &look);
  }
  sb_plot_finish(&plot);
  draw_labels(cells, rect, list);
}
