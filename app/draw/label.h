// Placement of labels without collisions. Each label has several candidate positions; the best free
// one is used, and a label without a free position is omitted. Earlier labels take precedence:
// place the most important ones first. Coordinates are logical pixels, y downwards.
#pragma once

#include "app/draw/canvas.h"

// Largest numbers of occupied boxes and of line pieces.
enum { SB_LABELS_MAX = 96, SB_LABEL_LINES_MAX = 4096 };

// The state of one picture. Initialised by sb_labels_init(); it owns no memory.
typedef struct {
  SbRect bounds; // labels stay inside
  int box_count;
  SbRect box[SB_LABELS_MAX]; // [box_count]: occupied
  bool full;                 // there are too many boxes: no further label is placed
  double crossing;           // length of curves under the label placed last [px]; 0: no halo needed
  double crossing_max;       // largest `crossing` that is accepted [px]; initially INFINITY
  int line_count;
  struct {
    SbPoint a, b;
    double weight;
  } line[SB_LABEL_LINES_MAX]; // [line_count]: pieces of curves to be avoided
} SbLabels;

// A candidate position: anchor on the baseline, and which end of the text it is. Earlier ones are
// preferred.
typedef struct {
  double x, y;
  SbAlign align;
} SbPlace;

// Initialises without boxes and curves.
void sb_labels_init(SbLabels *labels, SbRect bounds);

// Marks a box as occupied.
void sb_labels_block(SbLabels *labels, SbRect box);

// Widens the occupied boxes from index `first` on by `by` [px] on the left and on the right.
void sb_labels_widen(SbLabels *labels, int first, double by);

// Adds the curve point[count], which labels avoid; `weight` is the cost of a covered pixel (usually
// 1). The curve is stored with few points; pieces beyond SB_LABEL_LINES_MAX are ignored.
void sb_labels_avoid(SbLabels *labels, const SbPoint *point, size_t count, double weight);

// Finds the best of place[count] for a text. Returns true and writes it to *out if one is free, and
// marks it as occupied; false: none is free.
bool sb_labels_place(SbLabels *labels, SbCanvas *canvas, const char *text, const SbTextStyle *style,
                     const SbPlace *place, int count, SbPlace *out);

// As sb_labels_place(), for a text of this width and type size [px].
bool sb_labels_place_box(SbLabels *labels, double width, double size, const SbPlace *place,
                         int count, SbPlace *out);

// Draws a text at the position from sb_labels_place(), with a halo if it covers a curve. To be
// called before the next label is placed.
void sb_labels_draw(const SbLabels *labels, SbCanvas *canvas, const char *text,
                    const SbTextStyle *style, const SbPlace *at);

// Draws a text at the best free one of place[count], as sb_labels_place() and sb_labels_draw() do.
// Returns false if none is free.
bool sb_labels_put(SbLabels *labels, SbCanvas *canvas, const char *text, const SbTextStyle *style,
                   const SbPlace *place, int count);

// Moves heights y[count], which increase, apart to distances of at least `line`, and between `top`
// and `bottom` (which may be infinite): neighbours move by equal amounts.
void sb_labels_spread(double *y, int count, double line, double top, double bottom);

// Returns whether a box would cover an occupied one or leave the bounds.
bool sb_labels_hits(const SbLabels *labels, SbRect box);

// Returns the area of the intersection of two rectangles [px2].
double sb_rect_overlap(SbRect a, SbRect b);
