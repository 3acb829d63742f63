// Half-sections of parts as polygons: a profile with its arcs divided, its inner and outer surface
// along the axis, and the room that a recess leaves. For drawing the part and for sizes that follow
// from its shape. SI units.
#pragma once

#include "engine/mechanism/solid.h"

enum { SB_OUTLINE_MAX = 512 };

typedef struct {
  double x, r; // axial, radial [m]
} SbOutlinePoint;

// Closed by the piece from its last point to the first; counter-clockwise. count 0: none.
typedef struct {
  size_t count;
  SbOutlinePoint point[SB_OUTLINE_MAX];
} SbOutline;

// Divides a profile's arcs so that none is further than `sagitta` [m] from its chords, or as finely
// as SB_OUTLINE_MAX points allow. The enclosed area differs by less than 2/3 of the chords' length
// times the sagitta. Refuses what sb_profile_check() refuses.
SbStatus sb_outline_of_profile(SbOutline *out, const SbProfile *profile, double sagitta,
                               SbReport *report);

// Inner and outer surface by x: between x[i] and x[i + 1] both are straight, from `right` of i to
// `left` of i + 1. Where the part is solid the inner one is 0.
typedef struct {
  size_t count;
  double x[SB_OUTLINE_MAX];                                     // m, as the radii
  double low_left[SB_OUTLINE_MAX], low_right[SB_OUTLINE_MAX];   // inner, -1 where there is nothing
  double high_left[SB_OUTLINE_MAX], high_right[SB_OUTLINE_MAX]; // outer
} SbOutlineSurface;

void sb_outline_surface(SbOutlineSurface *out, const SbOutline *outline);

// Radii of both surfaces at x [m]. False beside the part.
SB_CHECKED bool sb_outline_radii(double *low, double *high, const SbOutlineSurface *surface,
                                 double x);

// Volume between the outer surface and the cylinder of radius `radius` from x0 to x1, where the
// surface lies inside it [m3].
double sb_outline_room(const SbOutlineSurface *surface, double radius, double x0, double x1);
