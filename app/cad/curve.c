// Curves as straight pieces and arcs. Also compiled into sealbench-cad.
#include "app/cad/cad_private.h"

// Depth of the division, pieces of a curve, and points at which a piece is compared with the curve.
enum { DEPTH_MAX = 12, PIECES_MAX = 20000, POINTS = 9 };

// Extent of a part that is a point, and largest distance at the points, which leaves room for a
// larger one between them; relative to the tolerance.
static const double POINT = 1e-3, BETWEEN = 0.9;

SbPiece sb_cad_arc(const double from[2], const double middle[2], const double to[2]) {
  const double ax = from[0] - middle[0], ay = from[1] - middle[1];
  const double bx = to[0] - middle[0], by = to[1] - middle[1];
  // The inscribed angle phi leaves an arc of 2 (pi - phi); it turns left where its middle lies on
  // the right of the chord.
  const double cross = ax * by - ay * bx;
  const double phi = atan2(fabs(cross), ax * bx + ay * by);
  const double chord = hypot(to[0] - from[0], to[1] - from[1]);
  const double arc = tan((M_PI - phi) / 2);
  const double bulge = phi > M_PI / 2 && arc * chord / 2 < 1e-12 ? 0 : arc;
  return (SbPiece){from[0], from[1], to[0], to[1], cross > 0 ? -bulge : bulge};
}

static bool divide(GArray *out, SbCadCurve at, const void *curve, double t0, double t1, int depth) {
  double p[POINTS][2], extent = 0;
  for (int i = 0; i < POINTS; i++) {
    at(curve, t0 + (t1 - t0) * i / (POINTS - 1), p[i]);
    if (!isfinite(p[i][0]) || !isfinite(p[i][1])) {
      return false;
    }
    extent = fmax(extent, hypot(p[i][0] - p[0][0], p[i][1] - p[0][1]));
  }
  if (extent <= POINT * SB_CAD_TOLERANCE) {
    return true; // a point
  }
  const SbPiece piece = sb_cad_arc(p[0], p[POINTS / 2], p[POINTS - 1]);
  bool good = fabs(piece.bulge) <= 1;
  for (int i = 1; good && i < POINTS - 1; i++) {
    double off;
    (void)sb_piece_place(&piece, p[i][0], p[i][1], &off);
    good = off <= BETWEEN * SB_CAD_TOLERANCE;
  }
  if (good) {
    g_array_append_val(out, piece);
    return out->len <= PIECES_MAX;
  }
  const double middle = (t0 + t1) / 2;
  return depth < DEPTH_MAX && divide(out, at, curve, t0, middle, depth + 1) &&
         divide(out, at, curve, middle, t1, depth + 1);
}

bool sb_cad_curve(GArray *pieces, SbCadCurve at, const void *curve, int steps) {
  bool good = true;
  for (int i = 0; good && i < steps; i++) {
    good = divide(pieces, at, curve, (double)i / steps, (double)(i + 1) / steps, 0);
  }
  return good;
}
