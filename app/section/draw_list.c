// Filling of the display list. Growth doubles the arrays; GLib's allocator ends the program when
// memory is gone, as everywhere in app.
#include "app/section/draw_list.h"

#include <glib.h>
#include <math.h>
#include <string.h>

SbDrawHatch sb_draw_hatch(SbColor color, double pitch, double width, double lean, double offset) {
  return (SbDrawHatch){color, pitch, width, M_SQRT1_2, (lean * M_SQRT1_2), (offset * M_SQRT1_2)};
}

void sb_draw_list_init(SbDrawList *list) {
  *list = (SbDrawList){0};
}

void sb_draw_list_finish(SbDrawList *list) {
  g_free(list->item);
  g_free(list->point);
  g_free(list->scalar);
  g_free(list->text);
  g_free(list->clip);
  *list = (SbDrawList){0};
}

// Room for `more` elements behind `count`.
static void *reserve(void *array, size_t *capacity, size_t count, size_t more, size_t size) {
  if (count + more <= *capacity) {
    return array;
  }
  *capacity = MAX(MAX(2 * *capacity, count + more), (size_t)64);
  return g_realloc_n(array, *capacity, size);
}

static int add_clip(SbDrawList *list, SbRect rect) {
  list->clip = reserve(list->clip, &list->clip_capacity, list->clip_count, 1, sizeof *list->clip);
  list->clip[list->clip_count] = rect;
  return (int)list->clip_count++;
}

void sb_draw_list_clear(SbDrawList *list, double width, double height, SbColor background) {
  list->width = width;
  list->height = height;
  list->background = background;
  list->item_count = list->point_count = list->scalar_count = 0;
  list->text_count = list->clip_count = 0;
  list->current_clip = add_clip(list, (SbRect){0, 0, list->width, list->height});
}

void sb_draw_clip(SbDrawList *list, const SbRect *rect) {
  list->current_clip = rect == NULL ? 0 : add_clip(list, *rect);
}

static SbDrawItem *add_item(SbDrawList *list, SbDrawKind kind, SbColor color) {
  list->item = reserve(list->item, &list->item_capacity, list->item_count, 1, sizeof *list->item);
  SbDrawItem *item = &list->item[list->item_count++];
  *item = (SbDrawItem){.kind = kind, .color = color, .clip = list->current_clip};
  return item;
}

static SbPoint *add_points(SbDrawList *list, size_t count) {
  list->point =
      reserve(list->point, &list->point_capacity, list->point_count, count, sizeof *list->point);
  SbPoint *points = list->point + list->point_count;
  list->point_count += count;
  return points;
}

static SbDrawItem *add_shape(SbDrawList *list, SbDrawKind kind, const SbPoint *points, size_t count,
                             SbColor color) {
  SbDrawItem *item = add_item(list, kind, color);
  item->first = list->point_count;
  item->count = count;
  memcpy(add_points(list, count), points, count * sizeof *points);
  return item;
}

SbDrawItem *sb_draw_fill(SbDrawList *list, const SbPoint *points, size_t count, SbColor color) {
  SbDrawItem *item = add_shape(list, SB_DRAW_FILL, points, count, color);
  item->feather = true;
  return item;
}

SbDrawItem *sb_draw_rect(SbDrawList *list, double x, double y, double width, double height,
                         SbColor color) {
  double x0 = x, y0 = y, x1 = (x + width), y1 = (y + height);
  const SbPoint points[4] = {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
  return sb_draw_fill(list, points, 4, color);
}

enum { CORNER = 6 };

// A rectangle with four quarter circles of CORNER + 1 points each.
static void round_points(SbPoint points[4 * (CORNER + 1)], double x, double y, double width,
                         double height, double radius) {
  double r = MIN(radius, MIN(width, height) / 2);
  const double cx[4] = {x + width - r, x + r, x + r, x + width - r};
  const double cy[4] = {y + height - r, y + height - r, y + r, y + r};
  for (int corner = 0; corner < 4; corner++) {
    for (int i = 0; i <= CORNER; i++) {
      double angle = M_PI / 2 * (corner + (double)i / CORNER);
      points[corner * (CORNER + 1) + i] =
          (SbPoint){(cx[corner] + r * cos(angle)), (cy[corner] + r * sin(angle))};
    }
  }
}

SbDrawItem *sb_draw_round_rect(SbDrawList *list, double x, double y, double width, double height,
                               double radius, SbColor color) {
  SbPoint points[4 * (CORNER + 1)];
  round_points(points, x, y, width, height, radius);
  return sb_draw_fill(list, points, G_N_ELEMENTS(points), color);
}

SbDrawItem *sb_draw_disc(SbDrawList *list, double x, double y, double radius, SbColor color) {
  enum { SIDES = 24 };
  SbPoint points[SIDES];
  for (int i = 0; i < SIDES; i++) {
    double angle = 2 * M_PI * i / SIDES;
    points[i] = (SbPoint){(x + radius * cos(angle)), (y + radius * sin(angle))};
  }
  return sb_draw_fill(list, points, SIDES, color);
}

SbDrawItem *sb_draw_stroke(SbDrawList *list, const SbPoint *points, size_t count, double width,
                           SbColor color) {
  SbDrawItem *item = add_shape(list, SB_DRAW_STROKE, points, count, color);
  item->width = width;
  return item;
}

SbDrawItem *sb_draw_line(SbDrawList *list, double x0, double y0, double x1, double y1, double width,
                         SbColor color) {
  const SbPoint points[2] = {{x0, y0}, {x1, y1}};
  return sb_draw_stroke(list, points, 2, width, color);
}

SbDrawItem *sb_draw_round_frame(SbDrawList *list, double x, double y, double width, double height,
                                double radius, double line, SbColor color) {
  SbPoint points[4 * (CORNER + 1)];
  round_points(points, x, y, width, height, radius);
  SbDrawItem *item = sb_draw_stroke(list, points, G_N_ELEMENTS(points), line, color);
  item->closed = true;
  return item;
}

SbDrawItem *sb_draw_mesh(SbDrawList *list, const SbPoint *points, const float *scalars,
                         size_t count, const SbDrawMap *map, double min, double max) {
  SbDrawItem *item = add_shape(list, SB_DRAW_MESH, points, count, (SbColor){1.0, 1.0, 1.0, 1.0});
  list->scalar = reserve(list->scalar, &list->scalar_capacity, list->scalar_count, count,
                         sizeof *list->scalar);
  memcpy(list->scalar + list->scalar_count, scalars, count * sizeof *scalars);
  item->first_scalar = list->scalar_count;
  list->scalar_count += count;
  item->map = map;
  item->map_min = min;
  item->map_max = max;
  return item;
}

SbDrawItem *sb_draw_text(SbDrawList *list, double x, double y, double size, int weight,
                         SbAlign align, SbColor color, const char *text) {
  SbDrawItem *item = add_item(list, SB_DRAW_TEXT, color);
  size_t length = MIN(strlen(text), (size_t)SB_DRAW_TEXT_MAX);
  while (length > 0 && ((unsigned char)text[length] & 0xC0) == 0x80) {
    length--; // not inside a character
  }
  list->text =
      reserve(list->text, &list->text_capacity, list->text_count, length + 1, sizeof *list->text);
  memcpy(list->text + list->text_count, text, length);
  list->text[list->text_count + length] = '\0';
  item->first = list->text_count;
  item->count = length;
  list->text_count += length + 1;
  item->x = x;
  item->y = y;
  item->size = size;
  item->weight = weight;
  item->align = align;
  return item;
}

void sb_draw_arrow(SbDrawList *list, double x0, double y0, double x1, double y1, double line,
                   double head_length, double head_width, SbColor color) {
  double length = hypot(x1 - x0, y1 - y0);
  if (length < 1e-6) {
    return;
  }
  double ux = (x1 - x0) / length;
  double uy = (y1 - y0) / length;
  double head = MIN(head_length, length);
  double wide = head_width / 2 * head / head_length;
  double notch = 0.78 * head;
  if (length > notch) {
    sb_draw_line(list, x0, y0, x1 - ux * (notch - 0.5), y1 - uy * (notch - 0.5), line, color);
  }
  const SbPoint points[4] = {
      {x1, y1},
      {(x1 - ux * head - uy * wide), (y1 - uy * head + ux * wide)},
      {(x1 - ux * notch), (y1 - uy * notch)},
      {(x1 - ux * head + uy * wide), (y1 - uy * head - ux * wide)},
  };
  sb_draw_fill(list, points, 4, color);
}

void sb_draw_reflect(SbDrawList *list, size_t first, double y) {
  size_t end = list->item_count;
  for (size_t i = first; i < end; i++) {
    if (list->item[i].kind == SB_DRAW_TEXT) {
      continue;
    }
    SbDrawItem *item = add_item(list, list->item[i].kind, list->item[i].color);
    *item = list->item[i]; // scalars are shared
    size_t from = item->first;
    size_t count = item->count;
    item->first = list->point_count;
    SbPoint *to = add_points(list, count);
    for (size_t k = 0; k < count; k++) {
      SbPoint point = list->point[from + k];
      to[k] = (SbPoint){point.x, (2 * y) - point.y};
    }
  }
}
