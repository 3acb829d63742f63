// Where labels go: a collision rule. Each label offers several places; the best free one is taken,
// and a label that finds none is left out rather than drawn over another. Whoever is placed first
// wins: *now* first, then marks, then notes.
#pragma once

#include "app/base/canvas.h"

enum { SB_LABELS_MAX = 96, SB_LABEL_LINES_MAX = 4096 };

typedef struct {
  SbRect bounds; // labels stay inside
  int box_count;
  SbRect box[SB_LABELS_MAX]; // taken
  bool full;                 // more was to be taken than fits: nothing is placed any more
  double crossing;     // of the label placed last: 0 if it stands on nothing and needs no halo
  double crossing_max; // places that cover more of a curve [px] are refused; INFINITY at first
  int line_count;
  struct {
    SbPoint a, b;
    double weight;
  } line[SB_LABEL_LINES_MAX]; // curves, better not crossed
} SbLabels;

// One place on offer: baseline origin and alignment. Earlier ones are preferred.
typedef struct {
  double x, y;
  SbAlign align;
} SbPlace;

void sb_labels_init(SbLabels *labels, SbRect bounds);

// Takes a box: nothing is placed over it any more.
void sb_labels_block(SbLabels *labels, SbRect box);

// Keeps `by` [px] free on both sides of the boxes from number `first` on, for what comes after.
void sb_labels_widen(SbLabels *labels, int first, double by);

// Asks labels to keep off a curve; `weight` is the cost of a pixel crossed (1 is usual). The line
// is kept coarsely; what does not fit is ignored.
void sb_labels_avoid(SbLabels *labels, const SbPoint *point, size_t count, double weight);

// Finds the best place for a box of the text. True and *out if one is free; it is then taken.
bool sb_labels_place(SbLabels *labels, SbCanvas *canvas, const char *text, const SbTextStyle *style,
                     const SbPlace *place, int count, SbPlace *out);

// The same for a box of `width` whose type size is `size`.
bool sb_labels_place_box(SbLabels *labels, double width, double size, const SbPlace *place,
                         int count, SbPlace *out);

// Draws a label at its place, over a halo if it was placed over something. Right after placing.
void sb_labels_draw(const SbLabels *labels, SbCanvas *canvas, const char *text,
                    const SbTextStyle *style, const SbPlace *at);

// True if the box would cover one that is taken or leave the bounds.
bool sb_labels_hits(const SbLabels *labels, SbRect box);

// Area shared by two rectangles.
double sb_rect_overlap(SbRect a, SbRect b);
