// Grooves with drawn floor and walls, and outlines of grooves. The functions have no state and may
// be called concurrently.
#pragma once

#include "engine/base/status.h"
#include "engine/contact/ring/ring_profile.h"

// A smooth bend of a line: the slope changes by `turn` over `length` around the position `at` [m].
// Its contribution to the height is turn x sb_groove_ramp(position - at + length/2, length).
typedef struct {
  double at, turn, length;
} SbGrooveBend;

// Largest number of bends.
enum { SB_GROOVE_BENDS_MAX = 64 };

// A surface as height over position [m]: offset + slope x position + contributions of the bends.
typedef struct {
  double offset, slope;
  int count;
  SbGrooveBend bend[SB_GROOVE_BENDS_MAX];
} SbGrooveLine;

// A drawn groove [m]. [0] is the left side, [1] the right one. Floor line: height above the lowest
// point of the floor against the axial distance from the narrowest position of the wall (< 0 inside
// the groove, > 0 behind the wall); constant far from the wall. The floor's height at a point is
// the sum of both floor lines there. Wall line: recess of the wall behind its narrowest position
// against the height above the lowest point of the floor.
typedef struct {
  // Distance of the walls at the narrowest position; height of the edges above the floor.
  double width, depth;
  int count; // points of the drawing; 0: empty
  SbGrooveLine floor[2], wall[2];
} SbGrooveDrawing;

// Fraction of the depth over which corners are rounded.
#define SB_GROOVE_ROUNDING 0.04

// Converts an outline from one edge to the other, in either direction, into a groove.
// points[count]: z axial, r radial from any axis [m], bulge counter-clockwise in (z, r)
// (SbSealPoint; that of the last point is ignored). The floor is what inclines by at most 70
// degrees around its lowest point. Walls are steeper, and higher up incline by at most 60 degrees
// from the radial direction; flatter parts at the edges are omitted. Arcs are divided into chords
// of 7.5 degrees (error 0.2 % of the radius). SB_ERROR_INPUT: fewer than 3 points, more than 512
// with those of the chords, no such floor or wall, too many bends, or the surfaces deviate by more
// than 2 % of width or depth from a point.
SbStatus sb_groove_draw(SbGrooveDrawing *out, const SbSealPoint *points, int count,
                        SbReport *report);

// Returns a height that is 0 for x <= 0 and x - length/2 for x >= length; its slope increases from
// 0 to 1 in between. Twice differentiable, as Newton's method requires. Writes slope and curvature.
double sb_groove_ramp(double x, double length, double *slope, double *curvature);

// Returns the height [m] of a line at the position `at` [m], and writes slope and curvature.
double sb_groove_line(const SbGrooveLine *line, double at, double *slope, double *curvature);

// Capacity of an outline.
enum { SB_GROOVE_POINTS = 160 };

// Writes the outline of a drawn groove to out[][2] (z, r) [m], from its right edge to its left
// edge, up to `height` above the lowest point of the floor (r = 0), with walls `width` apart around
// z = 0. Returns the number of points.
int sb_groove_outline(double out[SB_GROOVE_POINTS][2], const SbGrooveDrawing *groove, double width,
                      double height);

// Returns the area of that outline below `height` [m2]. Above the drawing it has the width of the
// opening.
double sb_groove_drawn_area(const SbGrooveDrawing *groove, double width, double height);
