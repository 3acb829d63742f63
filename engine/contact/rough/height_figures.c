// See height_figures.h. One pass computes the mean, a second one all other parameters.
#include "engine/contact/rough/height_figures.h"

#include <math.h>

enum { REACH = 3 }; // of the differences, on either side

SbHeights sb_heights_part(const SbHeights *h, size_t i, size_t m, size_t j, size_t n) {
  const size_t top = i * h->rows / m, bottom = (i + 1) * h->rows / m;
  const size_t left = j * h->columns / n, right = (j + 1) * h->columns / n;
  SbHeights part = *h;
  part.rows = bottom - top;
  part.columns = right - left;
  part.z = h->z + top * h->stride + left;
  return part;
}

SbAsperityFigures sb_asperities_of_moments(const double moment[3], bool of_summits) {
  const double alpha = moment[0] * moment[2] / (moment[1] * moment[1]);
  SbAsperityFigures out = {NAN, NAN, NAN, NAN, NAN};
  if (alpha > 1.5) {
    out.density = moment[2] / (6 * M_PI * sqrt(3) * moment[1]);
    out.radius = 3 * sqrt(M_PI / moment[2]) / 8;
    out.sigma = sqrt(moment[0] * (of_summits ? 1 - 0.8968 / alpha : 1));
    out.product = out.density * out.radius * out.sigma;
    out.sigma_over_beta = out.sigma / out.radius;
  }
  return out;
}

static double slope(const double *z, ptrdiff_t step) {
  return (45 * (z[step] - z[-step]) - 9 * (z[2 * step] - z[-2 * step]) + z[3 * step] -
          z[-3 * step]) /
         60;
}

static double curvature(const double *z, ptrdiff_t step) {
  return (270 * (z[step] + z[-step]) - 27 * (z[2 * step] + z[-2 * step]) +
          2 * (z[3 * step] + z[-3 * step]) - 490 * z[0]) /
         180;
}

// Above its eight neighbours; of equal ones the first in reading order counts. False where one is
// missing.
static bool is_summit(const double *z, ptrdiff_t row) {
  return z[0] > z[-row - 1] && z[0] > z[-row] && z[0] > z[-row + 1] && z[0] > z[-1] &&
         z[0] >= z[1] && z[0] >= z[row - 1] && z[0] >= z[row] && z[0] >= z[row + 1];
}

// A sum of numbers that there are.
typedef struct {
  double sum, count;
} Mean;

static void add(Mean *mean, double value) {
  if (!isnan(value)) {
    mean->sum += value;
    mean->count++;
  }
}

static double of(const Mean *mean) {
  return mean->count > 0 ? mean->sum / mean->count : NAN;
}

typedef struct {
  Mean magnitude, square, cube, fourth; // of heights about the mean
  Mean slope[2], curvature[2];          // squares, along x and y
  double tested;                        // points that could be summits
  double summits, bend, height, height_square;
} Sums;

// Along a row: slopes and curvatures by x and y where all seven points are, and summits.
static void add_row(Sums *s, const SbHeights *h, size_t i, double mean) {
  const double *row = h->z + i * h->stride;
  const ptrdiff_t down = (ptrdiff_t)h->stride;
  const bool inside = i >= REACH && i + REACH < h->rows;
  for (size_t j = 0; j < h->columns; j++) {
    const double *z = row + j, d = *z - mean, d2 = d * d;
    const bool between = j >= REACH && j + REACH < h->columns;
    double bend_x = NAN, bend_y = NAN;
    if (isnan(d)) {
      continue;
    }
    s->magnitude.sum += fabs(d);
    s->square.sum += d2;
    s->cube.sum += d2 * d;
    s->fourth.sum += d2 * d2;
    s->square.count++;
    if (between) {
      const double along = slope(z, 1) / h->dx;
      bend_x = curvature(z, 1) / (h->dx * h->dx);
      add(&s->slope[0], along * along);
      add(&s->curvature[0], bend_x * bend_x);
    }
    if (inside) {
      const double along = slope(z, down) / h->dy;
      bend_y = curvature(z, down) / (h->dy * h->dy);
      add(&s->slope[1], along * along);
      add(&s->curvature[1], bend_y * bend_y);
    }
    const double bend = bend_x + bend_y;
    if (between && inside &&
        !isnan(bend + z[-down - 1] + z[-down + 1] + z[down - 1] + z[down + 1])) {
      s->tested++;
      if (is_summit(z, down)) {
        s->summits++;
        s->bend -= bend / 2;
        s->height += d;
        s->height_square += d2;
      }
    }
  }
}

static SbAsperityFigures of_summits(const Sums *s, const SbHeights *h) {
  SbAsperityFigures out = {NAN, NAN, NAN, NAN, NAN};
  if (s->summits >= 2) {
    const double mean = s->height / s->summits;
    out.density = s->summits / (s->tested * h->dx * h->dy);
    out.radius = s->summits / s->bend;
    out.sigma = sqrt(fmax(s->height_square / s->summits - mean * mean, 0));
    out.product = out.density * out.radius * out.sigma;
    out.sigma_over_beta = out.sigma / out.radius;
  }
  return out;
}

SbStatus sb_height_figures(SbHeightFigures *out, const SbHeights *h, SbReport *report) {
  Mean mean = {0};
  for (size_t i = 0; i < h->rows; i++) {
    for (size_t j = 0; j < h->columns; j++) {
      add(&mean, h->z[i * h->stride + j]);
    }
  }
  if (mean.count < 2) {
    return sb_fail(report, SB_ERROR_INFEASIBLE, "there are no heights");
  }
  Sums s = {0};
  for (size_t i = 0; i < h->rows; i++) {
    add_row(&s, h, i, of(&mean));
  }
  s.magnitude.count = s.cube.count = s.fourth.count = s.square.count;
  const bool surface = h->rows > 1;
  const double square = of(&s.square), slope_x = of(&s.slope[0]);
  const double slopes = surface ? slope_x + of(&s.slope[1]) : slope_x;
  const double curvatures = of(&s.curvature[0]) + (surface ? of(&s.curvature[1]) : 0);
  *out = (SbHeightFigures){
      .sq = sqrt(square),
      .sa = of(&s.magnitude),
      .ssk = of(&s.cube) / pow(square, 1.5),
      .sku = of(&s.fourth) / (square * square),
      .sdq = sqrt(slopes),
      .moment = {square, slopes / (surface ? 2 : 1), curvatures / (surface ? 2 : 1)},
      .summits = (size_t)s.summits};
  out->breadth = out->moment[0] * out->moment[2] / (out->moment[1] * out->moment[1]);
  out->moments = sb_asperities_of_moments(out->moment, true);
  out->neighbours = of_summits(&s, h);
  return SB_OK;
}
