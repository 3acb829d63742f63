// Points, rectangles and alignment on a picture, in logical pixels, y downwards.
#pragma once

typedef struct {
  double x, y;
} SbPoint;

typedef struct {
  double x, y, width, height;
} SbRect;

// Where a text lies beside the point that it is given.
typedef enum { SB_LEFT, SB_MIDDLE, SB_RIGHT } SbAlign;
