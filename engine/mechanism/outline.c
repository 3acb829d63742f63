// Surfaces of outlines. See outline.h; solid.c divides profiles into them.
#include "engine/mechanism/outline.h"

#include "engine/numeric/root.h"

#include <math.h>
#include <stdlib.h>

static int ascending(const void *a, const void *b) {
  double x = *(const double *)a, y = *(const double *)b;
  return (x > y) - (x < y);
}

void sb_outline_surface(SbOutlineSurface *out, const SbOutline *outline) {
  size_t n = 0;
  for (size_t i = 0; i < outline->count; i++) {
    out->x[i] = outline->point[i].x;
  }
  qsort(out->x, outline->count, sizeof *out->x, ascending);
  for (size_t i = 0; i < outline->count; i++) {
    if (n == 0 || out->x[i] > out->x[n - 1]) {
      out->x[n++] = out->x[i];
    }
  }
  out->count = n;
  for (size_t i = 0; i < n; i++) {
    out->low_left[i] = out->low_right[i] = out->high_left[i] = out->high_right[i] = -1.0;
  }
  // Pieces do not cross, so that between neighbouring points one is lowest and one is highest.
  for (size_t k = 0; k + 1 < n; k++) {
    double x0 = out->x[k], x1 = out->x[k + 1], middle = 0.5 * (x0 + x1);
    double low = INFINITY, high = -1.0;
    for (size_t i = 0; i < outline->count; i++) {
      const SbOutlinePoint *a = &outline->point[i], *b = &outline->point[(i + 1) % outline->count];
      if (fmin(a->x, b->x) > x0 || fmax(a->x, b->x) < x1) {
        continue;
      }
      double slope = (b->r - a->r) / (b->x - a->x), r = a->r + slope * (middle - a->x);
      double left = a->r + slope * (x0 - a->x), right = a->r + slope * (x1 - a->x);
      if (r < low) {
        low = r;
        out->low_right[k] = left;
        out->low_left[k + 1] = right;
      }
      if (r > high) {
        high = r;
        out->high_right[k] = left;
        out->high_left[k + 1] = right;
      }
    }
  }
}

bool sb_outline_radii(double *low, double *high, const SbOutlineSurface *s, double x) {
  if (s->count < 2 || !(x >= s->x[0] && x <= s->x[s->count - 1])) {
    return false;
  }
  size_t k = sb_interval(s->x, s->count, x);
  double f = (x - s->x[k]) / (s->x[k + 1] - s->x[k]);
  *low = s->low_right[k] + f * (s->low_left[k + 1] - s->low_right[k]);
  *high = s->high_right[k] + f * (s->high_left[k + 1] - s->high_right[k]);
  return *high >= 0.0;
}

double sb_outline_room(const SbOutlineSurface *s, double radius, double x0, double x1) {
  double volume = 0.0;
  for (size_t k = 0; k + 1 < s->count; k++) {
    double from = fmax(x0, s->x[k]), to = fmin(x1, s->x[k + 1]);
    if (!(to > from)) {
      continue;
    }
    double length = s->x[k + 1] - s->x[k], rise = s->high_left[k + 1] - s->high_right[k];
    double a = fmin(radius, s->high_right[k] + rise * (from - s->x[k]) / length);
    double b = fmin(radius, s->high_right[k] + rise * (to - s->x[k]) / length);
    // A cone frustum out of the cylinder; exact where the surface does not cross the cylinder.
    volume += M_PI * (to - from) * (radius * radius - (a * a + a * b + b * b) / 3.0);
  }
  return volume;
}
