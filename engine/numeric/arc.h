// A circular arc given by its end points and its bulge, as in DXF drawings.
#pragma once

#include <math.h>

// An arc in a plane with the coordinates (x[0], x[1]). Lengths have the unit of the caller's
// points.
typedef struct {
  double centre[2], radius;
  double start; // angle of the start point, seen from the centre, atan2(x[1], x[0]) [rad]
  double sweep; // angle from start to end [rad], > 0 counter-clockwise, -2 pi to 2 pi
} SbArc;

// Returns the arc from the point `from` to the point `to`. `bulge` is tan(sweep/4), > 0
// counter-clockwise; it must not be 0. The two points must differ.
static inline SbArc sb_arc_of(const double from[2], const double to[2], double bulge) {
  const double d[2] = {to[0] - from[0], to[1] - from[1]};
  const double off = (1.0 - bulge * bulge) / (4.0 * bulge);
  SbArc arc = {
      .centre = {0.5 * (from[0] + to[0]) - off * d[1], 0.5 * (from[1] + to[1]) + off * d[0]},
      .radius = hypot(d[0], d[1]) * (1.0 + bulge * bulge) / (4.0 * fabs(bulge)),
      .sweep = 4.0 * atan(bulge)};
  arc.start = atan2(from[1] - arc.centre[1], from[0] - arc.centre[0]);
  return arc;
}

// Writes to x[2] the point at the fraction `part` of the arc, from 0 (its start) to 1 (its end).
static inline void sb_arc_place(const SbArc *arc, double part, double x[2]) {
  x[0] = arc->centre[0] + arc->radius * cos(arc->start + part * arc->sweep);
  x[1] = arc->centre[1] + arc->radius * sin(arc->start + part * arc->sweep);
}
