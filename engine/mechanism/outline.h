// Half-sections of parts as polygons, and their inner and outer surface as functions of x. The
// functions have no state and may be called concurrently.
#pragma once

#include "engine/mechanism/solid.h"

// Largest number of points of an outline.
enum { SB_OUTLINE_MAX = 512 };

// A point of an outline.
typedef struct {
  double x, r; // axial, radial [m]
} SbOutlinePoint;

// A polygon, counter-clockwise in (x, r). The last point is connected to the first. count 0: empty.
typedef struct {
  size_t count;
  SbOutlinePoint point[SB_OUTLINE_MAX];
} SbOutline;

// Converts a half-section to a polygon. Arcs are divided so that they deviate from their chords by
// at most `sagitta` [m] > 0, or by more if SB_OUTLINE_MAX points are not enough. SB_ERROR_INPUT:
// the half-section does not bound a body (sb_profile_check()); *out is empty then.
SbStatus sb_outline_of_profile(SbOutline *out, const SbProfile *profile, double sagitta,
                               SbReport *report);

// Inner and outer radius as piecewise linear functions of x. Between x[i] and x[i + 1] the inner
// radius goes from low_right[i] to low_left[i + 1], the outer from high_right[i] to high_left[i +
// 1]. A step has different left and right values.
typedef struct {
  size_t count;             // number of x
  double x[SB_OUTLINE_MAX]; // increasing [m]
  // Inner radius [m]; 0 if the part is solid, -1 if there is no part on this side of x.
  double low_left[SB_OUTLINE_MAX], low_right[SB_OUTLINE_MAX];
  // Outer radius [m]; -1 if there is no part on this side of x.
  double high_left[SB_OUTLINE_MAX], high_right[SB_OUTLINE_MAX];
} SbOutlineSurface;

// Computes the surfaces of an outline, which must not cross itself.
void sb_outline_surface(SbOutlineSurface *out, const SbOutline *outline);

// Writes the inner and the outer radius at x [m] to *low and *high; at a step the values to the
// right of x, at the right end of the part those to the left. Returns false if there is no part at
// x.
SB_CHECKED bool sb_outline_radii(double *low, double *high, const SbOutlineSurface *surface,
                                 double x);

// Returns the volume [m3] between the outer surface and the cylinder of radius `radius` [m], from
// x0 to x1 [m]. Where the surface is outside the cylinder or there is no part, 0 is added.
double sb_outline_room(const SbOutlineSurface *surface, double radius, double x0, double x1);
