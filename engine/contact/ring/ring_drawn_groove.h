// Grooves whose floor and walls are drawn, and outlines of grooves as solved rings meet them.
#pragma once

#include "engine/base/status.h"
#include "engine/contact/ring/ring_profile.h"

// A surface's height over a straight line: offset + slope at + what its bends add. Each turns the
// slope by `turn`, smoothly over `length` about its place.
typedef struct {
  double at, turn, length;
} SbGrooveBend;

enum { SB_GROOVE_BENDS_MAX = 64 };

typedef struct {
  double offset, slope;
  int count;
  SbGrooveBend bend[SB_GROOVE_BENDS_MAX];
} SbGrooveLine;

// A drawn groove, lengths in m. Floor: rise above its lowest place over the axial distance from the
// wall, > 0 behind it; it is flat away from the wall. Walls: recess behind where they stand nearest
// over the height above the floor's lowest place. [0] is the left side, [1] the right one.
typedef struct {
  double width, depth; // between the walls where they stand nearest; of the ends above the floor
  int count;           // points that it was made of; 0: there is none
  SbGrooveLine floor[2], wall[2];
} SbGrooveDrawing;

// Makes a groove of its outline from one edge to the other: `count` points (z axial, r radial from
// any axis, in m), bulges counter-clockwise in (z, r). The floor is what leans by 70 degrees at
// most about its lowest place, walls are what is steeper and, above that, leans by 60 at most; what
// is flatter still at the edges is left out. Arcs are divided by 7.5 degrees (0.2 % of their
// radius), corners rounded over SB_GROOVE_ROUNDING of the depth or the shorter piece beside them. A
// round transition from floor to wall is straight beyond 70 degrees at most (3 % of its radius).
// SB_ERROR_INPUT where there is no such floor or wall, or where these surfaces miss a point by more
// than 2 % of width or depth.
#define SB_GROOVE_ROUNDING 0.04
SbStatus sb_groove_draw(SbGrooveDrawing *out, const SbSealPoint *points, int count,
                        SbReport *report);

// Height above zero whose slope rises from 0 to 1 over a length (twice differentiable, so that
// Newton does not stumble where it sets in): half the length less than `x` beyond it.
double sb_groove_ramp(double x, double length, double *slope, double *curvature);

// Height, slope and curvature at a place [m].
double sb_groove_line(const SbGrooveLine *line, double at, double *slope, double *curvature);

// Points (z, r) of a drawn groove from its right edge at a height [m] above the floor's lowest
// place to the left one, walls `width` [m] apart about z = 0. At most SB_GROOVE_POINTS.
enum { SB_GROOVE_POINTS = 160 };
int sb_groove_outline(double out[SB_GROOVE_POINTS][2], const SbGrooveDrawing *groove, double width,
                      double height);

// Area of that outline below the height [m2], above the drawing as wide as its opening.
double sb_groove_drawn_area(const SbGrooveDrawing *groove, double width, double height);
