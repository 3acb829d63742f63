// A display list: the items of a picture, independent of how it is drawn.
//
// The section builds one list per frame. The GL renderer and the cairo path draw the same list, so
// that window, PNG, movie, SVG and PDF show the same picture. Items are drawn in the order in which
// they were added. A list reuses its arrays: after the first frames, clearing and refilling
// allocates nothing.
//
// Coordinates are logical pixels: the origin is the top left corner, x to the right, y downwards.
#pragma once

#include "app/draw/geometry.h"
#include "app/draw/theme.h"

#include <stdbool.h>
#include <stddef.h>

// Kind of an item.
typedef enum {
  SB_DRAW_FILL,   // polygon that does not cross itself
  SB_DRAW_STROKE, // polyline
  SB_DRAW_MESH,   // triangles with a scalar per vertex, coloured by a map
  SB_DRAW_TEXT    // one line of text
} SbDrawKind;

// Hatch over a fill: the lines x * across_x + y * across_y = offset + n * pitch for all integers n.
typedef struct {
  SbColor color;
  double pitch;              // distance of the lines [px]
  double width;              // of a line [px]; 0: no hatch
  double across_x, across_y; // unit vector normal to the lines
  double offset;             // [px]
} SbDrawHatch;

// Returns a hatch with lines at 45 degrees: x + lean * y = offset + n * pitch * sqrt(2); lean is 1
// or -1.
SbDrawHatch sb_draw_hatch(SbColor color, double pitch, double width, double lean, double offset);

// A colour map. The caller keeps it unchanged as long as lists refer to it.
typedef struct {
  SbColor entry[256]; // from the minimum to the maximum
} SbDrawMap;

// Longest text [bytes].
enum { SB_DRAW_TEXT_MAX = 160 };

// An item.
typedef struct {
  SbDrawKind kind;
  SbColor color;
  int clip; // index into SbDrawList.clip
  // Its points in SbDrawList.point, or its bytes in SbDrawList.text (without the 0).
  size_t first, count;
  // Stroke.
  double width;       // of the line [px]
  const SbDash *dash; // borrowed; NULL: solid
  bool closed;        // the last point is joined to the first; false when added, except frames
  // Fill.
  SbDrawHatch hatch;
  bool feather; // smooth edges, true when added; set it to false if an outline follows
  // Mesh: `count` vertices, three per triangle, with scalars in SbDrawList.scalar.
  size_t first_scalar;
  const SbDrawMap *map;    // borrowed
  double map_min, map_max; // scalars at the ends of the map
  bool shaded;             // interpolate the vertices' colours; else look up each pixel's scalar
  double isolines;         // number of intervals between lines of equal value; 0: no lines
  SbColor line_color;      // of these lines
  // Text.
  double x, y;   // anchor on the baseline, see `align`
  double size;   // [px]
  int weight;    // 400 normal, 700 bold
  SbAlign align; // which end of the text is at x
} SbDrawItem;

// A list. Initialised by sb_draw_list_init(), freed by sb_draw_list_finish(). `_count` elements of
// each array are in use.
typedef struct {
  double width, height; // of the picture [px]
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
  SbRect *clip;     // clip[0] is the full picture
  int current_clip; // of the next items
} SbDrawList;

// Initialises an empty list. Call sb_draw_list_clear() before items are added.
void sb_draw_list_init(SbDrawList *list);

// Frees the arrays.
void sb_draw_list_finish(SbDrawList *list);

// Removes all items and starts a picture of this size [px], without a restriction to a rectangle.
void sb_draw_list_clear(SbDrawList *list, double width, double height, SbColor background);

// Restricts items that are added from now on to this rectangle (NULL: the full picture), in place
// of an earlier one.
void sb_draw_clip(SbDrawList *list, const SbRect *rect);

// Those of the functions below that return an item add this one item, so that its members can be
// changed; the pointer is valid until the next addition. Members that a function has no parameter
// for are 0 unless stated at SbDrawItem. Points are copied. Sizes and widths are in px.

// Adds a polygon with points[count].
SbDrawItem *sb_draw_fill(SbDrawList *list, const SbPoint *points, size_t count, SbColor color);

// Adds a filled rectangle with its top left corner at (x, y).
SbDrawItem *sb_draw_rect(SbDrawList *list, double x, double y, double width, double height,
                         SbColor color);

// Adds a filled rectangle with rounded corners.
SbDrawItem *sb_draw_round_rect(SbDrawList *list, double x, double y, double width, double height,
                               double radius, SbColor color);

// Adds a filled disc with its centre at (x, y).
SbDrawItem *sb_draw_disc(SbDrawList *list, double x, double y, double radius, SbColor color);

// Adds an open polyline through points[count]; set `closed` and `dash` of the result as needed.
SbDrawItem *sb_draw_stroke(SbDrawList *list, const SbPoint *points, size_t count, double width,
                           SbColor color);

// Adds a line from (x0, y0) to (x1, y1).
SbDrawItem *sb_draw_line(SbDrawList *list, double x0, double y0, double x1, double y1, double width,
                         SbColor color);

// Adds the outline, `line` wide, of a rectangle with rounded corners.
SbDrawItem *sb_draw_round_frame(SbDrawList *list, double x, double y, double width, double height,
                                double radius, double line, SbColor color);

// Adds count/3 triangles with points[count] and scalars[count]; `map` shows `min` to `max`.
SbDrawItem *sb_draw_mesh(SbDrawList *list, const SbPoint *points, const float *scalars,
                         size_t count, const SbDrawMap *map, double min, double max);

// Adds one line of UTF-8 text (copied; cut off after SB_DRAW_TEXT_MAX bytes) at the anchor (x, y).
SbDrawItem *sb_draw_text(SbDrawList *list, double x, double y, double size, int weight,
                         SbAlign align, SbColor color, const char *text);

// Adds the mirror image, about the horizontal line at `y`, of all items from index `first` on
// except texts. Hatches keep their direction, because the parts are the same.
void sb_draw_reflect(SbDrawList *list, size_t first, double y);

// Adds an arrow from (x0, y0) to its tip (x1, y1): a shaft `line` wide and a filled head. Nothing
// if both points are the same.
void sb_draw_arrow(SbDrawList *list, double x0, double y0, double x1, double y1, double line,
                   double head_length, double head_width, SbColor color);
