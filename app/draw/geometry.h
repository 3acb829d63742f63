// Points, rectangles and alignment on a picture, in logical pixels, y downwards.
#pragma once

// A point.
typedef struct {
  double x, y;
} SbPoint;

// A rectangle; (x, y) is its top left corner.
typedef struct {
  double x, y, width, height;
} SbRect;

// Alignment of a text: its left end, middle or right end is at the given point.
typedef enum { SB_LEFT, SB_MIDDLE, SB_RIGHT } SbAlign;
