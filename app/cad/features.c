// Lands, bores and grooves: what is cylindrical on a half-section.
#include "app/cad/cad_private.h"

#include <math.h>

// Two radii that are one [m]; and the shortest cylinder that counts for more than a rounded corner.
static const double SAME = 1e-7, SHORTEST = 50e-6;

static bool is_level(const SbCadPiece *piece) {
  return piece->bulge == 0 && fabs(piece->y1 - piece->y0) <= SAME &&
         fabs(piece->x1 - piece->x0) > SAME;
}

// The wall beside an outer cylinder: follows the outline from piece `from` by `step` while it
// rises. The straight radial piece of most height gives its place, else the middle of the rise.
static double wall(double *height, const SbCadPiece *pieces, int count, int from, int step) {
  const SbCadPiece *floor = &pieces[from];
  const double radius = floor->y0, start = step > 0 ? floor->x1 : floor->x0;
  double at = NAN, tallest = 0, end = start;
  *height = 0;
  for (int n = 1; n < count; n++) {
    const SbCadPiece *piece = &pieces[((from + step * n) % count + count) % count];
    const double r0 = step > 0 ? piece->y0 : piece->y1, r1 = step > 0 ? piece->y1 : piece->y0;
    if (r1 < r0 - SAME || (is_level(piece) && fabs(piece->x1 - piece->x0) > SHORTEST)) {
      break;
    }
    if (piece->bulge == 0 && fabs(piece->x1 - piece->x0) <= SAME && r1 - r0 > tallest) {
      tallest = r1 - r0;
      at = piece->x0;
    }
    end = step > 0 ? piece->x1 : piece->x0;
    *height = r1 - radius;
  }
  return isnan(at) ? (start + end) / 2 : at;
}

static gint by_place(gconstpointer a, gconstpointer b) {
  const SbCadFeature *one = a, *other = b;
  return one->x0 < other->x0 ? -1 : one->x0 > other->x0;
}

void sb_cad_features(SbCadBody *body) {
  const int points = (int)body->profile->len;
  const int count = body->closed ? points : points - 1;
  g_autofree SbCadPiece *pieces = g_new(SbCadPiece, MAX(count, 1));
  for (int i = 0; i < count; i++) {
    const SbProfilePoint *p = &g_array_index(body->profile, SbProfilePoint, i);
    const SbProfilePoint *q = &g_array_index(body->profile, SbProfilePoint, (i + 1) % points);
    pieces[i] = (SbCadPiece){p->x, p->r, q->x, q->r, p->bulge};
  }
  for (int i = 0; i < count; i++) {
    const SbCadPiece *piece = &pieces[i];
    const double length = fabs(piece->x1 - piece->x0);
    if (!is_level(piece) || piece->y0 <= SAME || length < SHORTEST) {
      continue;
    }
    // Counter-clockwise: material is on the left, so an outer surface runs towards -x.
    const bool outer = piece->x1 < piece->x0;
    SbCadFeature feature = {outer ? SB_CAD_LAND : SB_CAD_BORE, fmin(piece->x0, piece->x1),
                            fmax(piece->x0, piece->x1), 2 * piece->y0, 0};
    if (outer) {
      double left, right;
      const double x0 = wall(&left, pieces, count, i, 1);
      const double x1 = wall(&right, pieces, count, i, -1);
      if (fmin(left, right) > SHORTEST) {
        feature = (SbCadFeature){SB_CAD_GROOVE, x0, x1, 2 * piece->y0, fmin(left, right)};
      }
    }
    g_array_append_val(body->features, feature);
  }
  g_array_sort(body->features, by_place);
}
