// A display list: what a picture consists of, in logical pixels, before anyone draws it.
//
// The section builds one list per frame; the GL renderer and the cairo path draw the same list, so
// that window, PNG, movie, SVG and PDF show the same thing. Items are drawn in the order in which
// they were added. A list owns its arrays and reuses them: after the first frames, clearing and
// refilling allocates nothing.
#pragma once

#include "app/base/geometry.h"
#include "app/base/theme.h"

#include <stdbool.h>
#include <stddef.h>

typedef enum {
  SB_DRAW_FILL,   // simple polygon
  SB_DRAW_STROKE, // polyline
  SB_DRAW_MESH,   // triangles with a scalar per vertex, coloured by a map
  SB_DRAW_TEXT
} SbDrawKind;

// Hatch over a fill. The lines are x * across_x + y * across_y = offset + n * pitch, where across
// is a unit vector. width 0: no hatch.
typedef struct {
  SbColor color;
  double pitch, width, across_x, across_y, offset;
} SbDrawHatch;

// Lines of 45 degrees: x + lean * y = offset + n * pitch * sqrt(2); lean is +1 or -1.
SbDrawHatch sb_draw_hatch(SbColor color, double pitch, double width, double lean, double offset);

// A colour map of 256 entries; the caller keeps it alive and unchanged as long as lists refer to
// it.
typedef struct {
  SbColor entry[256];
} SbDrawMap;

enum { SB_DRAW_TEXT_MAX = 160 };

typedef struct {
  SbDrawKind kind;
  SbColor color;
  int clip;            // index into SbDrawList.clip
  size_t first, count; // points (fill, stroke, mesh) or bytes (text, without the final zero)
  // Stroke.
  double width;
  const SbDash *dash; // NULL: solid
  bool closed;
  // Fill.
  SbDrawHatch hatch;
  bool feather; // edges get analytic coverage; false where an outline follows
  // Mesh: `count` vertices, three per triangle, with scalars from `first_scalar`.
  size_t first_scalar;
  const SbDrawMap *map;
  double map_min, map_max;
  bool shaded;     // vertices take the map's colour, and colours run straight between them
  double isolines; // how many steps the map's range has for lines of equal value, 0 for none
  SbColor line_color;
  // Text: anchored at the baseline.
  double x, y, size;
  int weight;
  SbAlign align;
} SbDrawItem;

typedef struct {
  double width, height; // of the picture, logical pixels
  SbColor background;
  size_t item_count, item_capacity;
  SbDrawItem *item;
  size_t point_count, point_capacity;
  SbPoint *point;
  size_t scalar_count, scalar_capacity;
  float *scalar;
  size_t text_count, text_capacity;
  char *text;
  size_t clip_count, clip_capacity;
  SbRect *clip; // clip[0] is the whole picture
  int current_clip;
} SbDrawList;

void sb_draw_list_init(SbDrawList *list);
void sb_draw_list_finish(SbDrawList *list);

// Empties the list and starts a picture of this size.
void sb_draw_list_clear(SbDrawList *list, double width, double height, SbColor background);

// Items added from now on show only inside this rectangle (NULL: the whole picture). Clips do not
// nest.
void sb_draw_clip(SbDrawList *list, const SbRect *rect);

// Each of these adds one item and returns it; the pointer holds until the next addition. Points
// are copied.
SbDrawItem *sb_draw_fill(SbDrawList *list, const SbPoint *points, size_t count, SbColor color);
SbDrawItem *sb_draw_rect(SbDrawList *list, double x, double y, double width, double height,
                         SbColor color);
SbDrawItem *sb_draw_round_rect(SbDrawList *list, double x, double y, double width, double height,
                               double radius, SbColor color);
SbDrawItem *sb_draw_disc(SbDrawList *list, double x, double y, double radius, SbColor color);
SbDrawItem *sb_draw_stroke(SbDrawList *list, const SbPoint *points, size_t count, double width,
                           SbColor color);
SbDrawItem *sb_draw_line(SbDrawList *list, double x0, double y0, double x1, double y1, double width,
                         SbColor color);
SbDrawItem *sb_draw_round_frame(SbDrawList *list, double x, double y, double width, double height,
                                double radius, double line, SbColor color);
SbDrawItem *sb_draw_mesh(SbDrawList *list, const SbPoint *points, const float *scalars,
                         size_t count, const SbDrawMap *map, double min, double max);
SbDrawItem *sb_draw_text(SbDrawList *list, double x, double y, double size, int weight,
                         SbAlign align, SbColor color, const char *text);

// Adds the mirror image, about the horizontal line at `y`, of all items from number `first` on that
// hold no text. Hatches keep their direction: the parts are the same ones.
void sb_draw_reflect(SbDrawList *list, size_t first, double y);

// An arrow from (x0, y0) to its point (x1, y1): a shaft and a head of length x width.
void sb_draw_arrow(SbDrawList *list, double x0, double y0, double x1, double y1, double line,
                   double head_length, double head_width, SbColor color);
