// Rows of a measured loop that a computed one can be compared with, and the ramps of its stages C
// and F; see measured.h.
#include "app/data/measured_private.h"

#include "engine/numeric/dense.h"

#include <math.h>
#include <string.h>

enum { BINS = 160 };

// Whether a row is of a sliding stem, and in which way. A stem that jams on its return rests where
// the cycle ends, while the force falls.
static bool slides(int *way, const SbMeasured *m, const SbMeasuredCycle *cycle, size_t row) {
  const double s = m->displacement[row], stroke = m->displacement[cycle->turn];
  const double margin = 0.01 * stroke;
  *way = row >= cycle->turn;
  const double rest = *way ? fmax(m->displacement[cycle->end - 1], 0) : 0;
  const SbMeasuredStage *end = &m->stage[*way ? SB_STAGE_E : SB_STAGE_D];
  return s > rest + margin && s < (end->found ? end->displacement : stroke) - margin;
}

SbMeasuredPoint *sb_measured_points(size_t *count, const SbMeasured *m, size_t count_max) {
  int way;
  const size_t rows = sb_measured_cycle(m, m->last)->end - sb_measured_cycle(m, m->first)->begin;
  const size_t each = rows / MAX(count_max, 1) + (rows % MAX(count_max, 1) != 0);
  SbMeasuredPoint *point =
      g_new(SbMeasuredPoint, rows / MAX(each, 1) + 2 * (m->last - m->first) + 4);
  SbMeasuredPoint sum = {0};
  *count = 0;
  for (size_t c = m->first; c <= m->last; c++) {
    const SbMeasuredCycle *cycle = sb_measured_cycle(m, c);
    for (size_t i = cycle->begin; i <= cycle->end; i++) {
      const bool takes = i < cycle->end && slides(&way, m, cycle, i);
      // A mean ends with its rows, its stroke or its cycle.
      if (sum.weight > 0 &&
          (sum.weight >= (double)each || i == cycle->end || (takes && way != sum.way))) {
        point[(*count)++] = (SbMeasuredPoint){sum.displacement / sum.weight, sum.force / sum.weight,
                                              sum.weight, sum.way};
        sum = (SbMeasuredPoint){0};
      }
      if (takes) {
        sum.displacement += m->displacement[i];
        sum.force += m->force[i];
        sum.weight++;
        sum.way = way;
      }
    }
  }
  return point;
}

void sb_measured_band(SbMeasuredBand *out, const SbMeasured *m) {
  out->end = 0;
  for (size_t c = m->first; c <= m->last; c++) {
    out->end = fmax(out->end, m->displacement[sb_measured_cycle(m, c)->turn] * (1 + 1e-9));
  }
  for (int i = 0; i < 4 * SB_MEASURED_BAND; i++) {
    out->force[i / 2 / SB_MEASURED_BAND][i / 2 % SB_MEASURED_BAND][i % 2] = NAN;
  }
  for (size_t c = m->first; c <= m->last; c++) {
    const SbMeasuredCycle *cycle = sb_measured_cycle(m, c);
    for (size_t i = cycle->begin; i < cycle->end; i++) {
      int way;
      if (slides(&way, m, cycle, i)) {
        double *force = out->force[way][(int)(m->displacement[i] / out->end * SB_MEASURED_BAND)];
        force[0] = fmin(m->force[i], force[0]); // of NaN the other
        force[1] = fmax(m->force[i], force[1]);
      }
    }
  }
}

// Level, ramp, level on a common slope through means of the stroke's pieces.
typedef struct {
  double x[BINS], y[BINS], weight[BINS];
  size_t count;
} Means;

static Means means_of(const SbMeasured *m, size_t begin, size_t end, double low, double high) {
  Means means = {0};
  for (size_t i = begin; i < end; i++) {
    const double share = (m->displacement[i] - low) / (high - low);
    if (share >= 0 && share < 1) {
      const int bin = (int)(share * BINS);
      means.x[bin] += share;
      means.y[bin] += m->force[i];
      means.weight[bin]++;
    }
  }
  for (int i = 0; i < BINS; i++) {
    const double weight = means.weight[i];
    if (weight > 0) {
      means.x[means.count] = means.x[i] / weight;
      means.y[means.count] = means.y[i] / weight;
      means.weight[means.count++] = weight;
    }
  }
  return means;
}

// Squares that y = a + b ramp + c x leaves, and the coefficients a, c, b; b = 0 where p = q.
static double ramp_squares(double coefficient[3], const Means *of, double p, double q) {
  const size_t n = q > p ? 3 : 2;
  double a[9] = {0}, right[3] = {0}, square = 0;
  for (size_t i = 0; i < of->count; i++) {
    const double ramp = q > p ? fmin(fmax((of->x[i] - p) / (q - p), 0), 1) : 0;
    const double term[3] = {1, of->x[i], ramp};
    for (size_t r = 0; r < n; r++) {
      for (size_t c = 0; c < n; c++) {
        a[r + n * c] += of->weight[i] * term[r] * term[c];
      }
      right[r] += of->weight[i] * term[r] * of->y[i];
    }
    square += of->weight[i] * of->y[i] * of->y[i];
  }
  memcpy(coefficient, right, sizeof right);
  if (!sb_eliminate(a, coefficient, n)) {
    return INFINITY;
  }
  for (size_t k = 0; k < n; k++) {
    square -= coefficient[k] * right[k];
  }
  return isfinite(square) ? fmax(square, 0) : INFINITY;
}

// The ramp of least squares; false where a straight line does nearly as well.
static bool find_ramp(double *p, double *q, double coefficient[3], const Means *of) {
  double best = INFINITY, trial[3];
  *p = *q = 0;
  for (double step = 1.0 / 40; step > 1e-4; step /= 4) {
    const double centre[2] = {*p, *q};
    const bool first = !isfinite(best);
    const double from[2] = {first ? 0.03 : centre[0] - 4 * step,
                            first ? 0.05 : centre[1] - 4 * step};
    const double to[2] = {first ? 0.95 : centre[0] + 4 * step, first ? 0.97 : centre[1] + 4 * step};
    for (double x = from[0]; x <= to[0]; x += step) {
      for (double z = fmax(from[1], x + 0.004); z <= to[1]; z += step) {
        const double square = ramp_squares(trial, of, x, z);
        if (square < best) {
          best = square;
          *p = x;
          *q = z;
        }
      }
    }
  }
  const double line = ramp_squares(trial, of, 0, 0);
  return isfinite(best) && best < 0.5 * line && isfinite(ramp_squares(coefficient, of, *p, *q));
}

void sb_measured_ramps(SbMeasured *m, const SbMeasuredCycle *cycle, double stroke) {
  static const SbStage stages[2] = {SB_STAGE_C, SB_STAGE_F};
  for (int way = 0; way < 2; way++) {
    SbMeasuredStage *stage = &m->stage[stages[way]];
    const double low = 0.02 * stroke, high = 0.98 * stroke;
    const Means means = means_of(m, way == 0 ? cycle->begin : cycle->turn,
                                 way == 0 ? cycle->turn : cycle->end, low, high);
    double p, q, coefficient[3];
    stage->reason = "the force does not fall between two levels there";
    if (means.count < 20) {
      stage->reason = "there are too few rows";
    } else if (find_ramp(&p, &q, coefficient, &means) &&
               (way == 0 ? coefficient[2] < 0 : coefficient[2] > 0)) {
      const double at = way == 0 ? p : q;
      *stage =
          (SbMeasuredStage){true, low + at * (high - low),
                            coefficient[0] + coefficient[1] * at + (way == 1 ? coefficient[2] : 0),
                            m->noise / sqrt(fmax(means.count / 4.0, 1)), NULL};
    }
  }
}
