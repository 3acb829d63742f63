// Random surfaces with known moments: waves of given power and random phase, summed by a transform.
#pragma once

#include "engine/contact/rough/heights.h"
#include "engine/numeric/fourier.h"
#include "engine/numeric/sampling.h"

#include <glib.h>
#include <math.h>

// A square of side n, periodic: C is level up to wave number `first` (in waves a side), falls as
// q^-2(H+1) up to `last`, and is 0 beyond.
typedef struct {
  size_t n;
  double step, sigma; // [m]
  double first, last, hurst;
  guint64 seed;
} RandomSurface;

static inline double random_surface_power(const RandomSurface *s, double waves) {
  return waves <= 0 || waves > s->last ? 0
                                       : pow(fmax(waves, s->first) / s->first, -2 * (s->hurst + 1));
}

static inline void random_surface_inverse(const SbFourier *fourier, double *line, void *data) {
  sb_fourier_inverse(fourier, line);
}

// Heights owned by the caller (g_free); moment[3]: m0, m2, m4 of the whole period, exact but for
// rounding.
static inline SbHeights random_surface(double moment[3], const RandomSurface *s) {
  const size_t n = s->n;
  double *field = g_new0(double, 2 * n * n);
  double sum[3] = {0};
  const double unit = 2 * M_PI / ((double)n * s->step);
  for (size_t i = 0; i < n; i++) {
    for (size_t j = 0; j < n; j++) {
      const size_t mirror_i = (n - i) % n, mirror_j = (n - j) % n;
      const double y = (double)i - (i > n / 2 ? (double)n : 0);
      const double x = (double)j - (j > n / 2 ? (double)n : 0);
      const double power = random_surface_power(s, hypot(x, y));
      sum[0] += power;
      sum[1] += power * (x * x + y * y) / 2 * unit * unit;
      sum[2] += power * (pow(x, 4) + pow(y, 4)) / 2 * pow(unit, 4);
      if (i * n + j <= mirror_i * n + mirror_j) {
        const double phase = 2 * M_PI * sb_random(s->seed, i * n + j, 0);
        double *z = field + 2 * (i * n + j), *mirror = field + 2 * (mirror_i * n + mirror_j);
        mirror[0] = z[0] = sqrt(power) * cos(phase);
        z[1] = sqrt(power) * sin(phase);
        mirror[1] = -z[1];
      }
    }
  }
  SbFourier fourier;
  g_assert_cmpint(sb_fourier_init(&fourier, n, NULL), ==, SB_OK);
  for (size_t i = 0; i < n; i++) {
    sb_fourier_inverse(&fourier, field + 2 * i * n);
  }
  sb_fourier_columns(&fourier, field, n, n, random_surface_inverse, NULL);
  sb_fourier_finish(&fourier);
  SbHeights out = {n, n, n, s->step, s->step, g_new(double, n *n)};
  const double scale = s->sigma * (double)(n * n) / sqrt(sum[0]);
  for (size_t k = 0; k < n * n; k++) {
    out.z[k] = scale * field[2 * k];
  }
  for (int m = 0; m < 3; m++) {
    moment[m] = sum[m] / sum[0] * s->sigma * s->sigma;
  }
  g_free(field);
  return out;
}
