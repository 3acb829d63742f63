// A circular arc by its ends and its bulge, as drawings have it.
#pragma once

#include <math.h>

// Counter-clockwise in its two coordinates for sweep > 0.
typedef struct {
  double centre[2], radius; // [L]
  double start, sweep;      // [rad]
} SbArc;

// `bulge` is tan of a quarter of the arc's angle, > 0 counter-clockwise, not 0. The centre lies on
// the chord's bisector, on the left for an arc that turns left by less than half a turn.
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

// A place on it, 0 .. 1 from its start.
static inline void sb_arc_place(const SbArc *arc, double part, double x[2]) {
  x[0] = arc->centre[0] + arc->radius * cos(arc->start + part * arc->sweep);
  x[1] = arc->centre[1] + arc->radius * sin(arc->start + part * arc->sweep);
}
