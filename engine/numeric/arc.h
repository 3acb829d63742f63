// Circular arcs given by their end points and their bulge, as in DXF drawings, and pieces of
// outlines that are straight or such arcs.
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

// A straight piece or an arc from (x0, y0) to (x1, y1); `bulge` as for sb_arc_of(), 0: straight.
typedef struct {
  double x0, y0, x1, y1, bulge;
} SbPiece;

// Returns the arc of a piece with a bulge.
static inline SbArc sb_piece_arc(const SbPiece *piece) {
  const double from[2] = {piece->x0, piece->y0}, to[2] = {piece->x1, piece->y1};
  return sb_arc_of(from, to, piece->bulge);
}

// Returns the length of a piece.
static inline double sb_piece_length(const SbPiece *piece) {
  const double chord = hypot(piece->x1 - piece->x0, piece->y1 - piece->y0);
  const double half = 2.0 * atan(fabs(piece->bulge));
  return half > 0.0 ? chord * half / sin(half) : chord;
}

// Writes the point of a piece at a fraction of its length.
static inline void sb_piece_point(const SbPiece *piece, double part, double at[2]) {
  at[0] = piece->x0 + part * (piece->x1 - piece->x0);
  at[1] = piece->y0 + part * (piece->y1 - piece->y0);
  if (piece->bulge != 0.0) {
    const SbArc arc = sb_piece_arc(piece);
    sb_arc_place(&arc, part, at);
  }
}

// Returns the position along a piece of the point on its line or circle that is nearest to (x, y):
// 0 at its start, 1 at its end. On a circle, of the positions that differ by full turns, the one
// nearest to 0.5: slightly before the start it is slightly negative. Writes the distance of (x, y)
// from the line or circle, never negative, to *off.
static inline double sb_piece_place(const SbPiece *piece, double x, double y, double *off) {
  const double dx = piece->x1 - piece->x0, dy = piece->y1 - piece->y0, chord = hypot(dx, dy);
  if (piece->bulge == 0.0) {
    const double u = x - piece->x0, v = y - piece->y0;
    *off = chord > 0.0 ? fabs(v * dx - u * dy) / chord : hypot(u, v);
    return (u * dx + v * dy) / (chord * chord);
  }
  const SbArc arc = sb_piece_arc(piece);
  const double u = x - arc.centre[0], v = y - arc.centre[1], once = 2.0 * M_PI / fabs(arc.sweep);
  const double part = fmod((atan2(v, u) - arc.start) / arc.sweep, once);
  *off = fabs(hypot(u, v) - arc.radius);
  return part < 0.5 - 0.5 * once ? part + once : part > 0.5 + 0.5 * once ? part - once : part;
}

// Returns the area between a piece and the straight lines from its ends to (x, 0); positive if that
// point is on the left of the piece. Those of a closed outline add up to its area.
static inline double sb_piece_area(const SbPiece *piece, double x) {
  const SbArc arc = piece->bulge != 0.0 ? sb_piece_arc(piece) : (SbArc){0};
  return 0.5 * ((piece->x0 - x) * piece->y1 - (piece->x1 - x) * piece->y0 +
                arc.radius * arc.radius * (arc.sweep - sin(arc.sweep)));
}
