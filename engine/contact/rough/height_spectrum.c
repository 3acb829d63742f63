// See height_spectrum.h.
#include "engine/contact/rough/height_spectrum.h"

#include "engine/numeric/dense.h"
#include "engine/numeric/fourier.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

void sb_height_spectrum_finish(SbHeightSpectrum *spectrum) {
  free(spectrum->ring);
  *spectrum = (SbHeightSpectrum){0};
}

// ---- Powers of waves ----

static double hann(size_t i, size_t n) {
  return 0.5 - 0.5 * cos(2 * M_PI * ((double)i + 0.5) / (double)n);
}

// Weights of columns and of rows; those of a profile's only row are 1.
typedef struct {
  double *x, *y;
} Window;

static bool window_init(Window *window, const SbHeights *h) {
  window->x = malloc(h->columns * sizeof *window->x);
  window->y = malloc(h->rows * sizeof *window->y);
  if (window->x == NULL || window->y == NULL) {
    return false;
  }
  for (size_t j = 0; j < h->columns; j++) {
    window->x[j] = hann(j, h->columns);
  }
  for (size_t i = 0; i < h->rows; i++) {
    window->y[i] = h->rows > 1 ? hann(i, h->rows) : 1;
  }
  return true;
}

static double weighted_mean(const SbHeights *h, const Window *window) {
  double sum = 0, weights = 0;
  for (size_t i = 0; i < h->rows; i++) {
    for (size_t j = 0; j < h->columns; j++) {
      const double w = window->y[i] * window->x[j];
      sum += w * h->z[i * h->stride + j];
      weights += w;
    }
  }
  return sum / weights;
}

// Two real rows are the real and imaginary part of one complex row, separated by symmetry. The
// waves 0 .. n/2 of each are stored.
static void transform_rows(double *half, const SbHeights *h, const Window *window,
                           const SbFourier *fourier, double *line, double mean) {
  const size_t n = h->columns, kept = n / 2 + 1;
  for (size_t i = 0; i < h->rows; i += 2) {
    const bool pair = i + 1 < h->rows;
    for (size_t j = 0; j < n; j++) {
      const double *z = h->z + i * h->stride + j;
      line[2 * j] = window->y[i] * window->x[j] * (z[0] - mean);
      line[2 * j + 1] = pair ? window->y[i + 1] * window->x[j] * (z[h->stride] - mean) : 0;
    }
    sb_fourier_forward(fourier, line);
    for (size_t k = 0; k < kept; k++) {
      const double *a = line + 2 * k, *b = line + 2 * ((n - k) % n);
      double *to = half + 2 * (i * kept + k);
      to[0] = 0.5 * (a[0] + b[0]);
      to[1] = 0.5 * (a[1] - b[1]);
      if (pair) {
        to[2 * kept] = 0.5 * (a[1] + b[1]);
        to[2 * kept + 1] = 0.5 * (b[0] - a[0]);
      }
    }
  }
}

static void forward(const SbFourier *fourier, double *line, void *data) {
  sb_fourier_forward(fourier, line);
}

static void add_rings(SbHeightSpectrum *out, const double *half, const SbHeights *h, double scale) {
  const size_t n = h->columns, kept = n / 2 + 1;
  const double step_x = 2 * M_PI / ((double)n * h->dx);
  const double step_y = h->rows > 1 ? 2 * M_PI / ((double)h->rows * h->dy) : 0;
  const double step = fmax(step_x, step_y);
  for (size_t i = 0; i < h->rows; i++) {
    const double q_y = step_y * (double)(i <= h->rows / 2 ? i : h->rows - i);
    for (size_t k = 0; k < kept; k++) {
      const double q_x = step_x * (double)k, q = hypot(q_x, q_y);
      // A wave and its mirror image, but for those that are their own.
      const double waves = k == 0 || 2 * k == n ? 1 : 2;
      const double *z = half + 2 * (i * kept + k);
      const double power = scale * waves * (z[0] * z[0] + z[1] * z[1]);
      if (q == 0) {
        continue;
      }
      const size_t at = (size_t)(q / step + 0.5);
      SbSpectrumRing *ring = &out->ring[at < out->ring_count ? at : out->ring_count - 1];
      const double x2 = q_x * q_x, y2 = q_y * q_y, parts = h->rows > 1 ? 2 : 1;
      ring->waves += waves;
      ring->q += waves * q;
      ring->moment[0] += power;
      ring->moment[1] += power * (x2 + y2) / parts;
      ring->moment[2] += power * (x2 * x2 + y2 * y2) / parts;
    }
  }
  for (size_t r = 0; r < out->ring_count; r++) {
    SbSpectrumRing *ring = &out->ring[r];
    ring->q /= ring->waves > 0 ? ring->waves : 1;
    for (int m = 0; m < 3; m++) {
      out->moment[m] += ring->moment[m];
    }
  }
}

// Complete rings in bins of a twentieth of a decade; a bin has at least one ring, or more if there
// would be too many bins.
static void make_bins(SbHeightSpectrum *out, const SbHeights *h) {
  const double nyquist = M_PI / fmax(h->dx, h->rows > 1 ? h->dy : 0);
  const double decades = log10((double)out->ring_count);
  const double ratio = pow(10, fmax(0.05, decades / (SB_HEIGHT_BINS_MAX - 8)));
  double wave_area = 2 * M_PI / ((double)h->columns * h->dx);
  wave_area *= h->rows > 1 ? 2 * M_PI / ((double)h->rows * h->dy) : 1;
  for (size_t r = 1; r < out->ring_count && out->count < SB_HEIGHT_BINS_MAX;) {
    double waves = 0, q = 0, power = 0;
    const double end = out->ring[r].q * ratio;
    for (; r < out->ring_count && (waves == 0 || out->ring[r].q < end); r++) {
      waves += out->ring[r].waves;
      q += out->ring[r].waves * out->ring[r].q;
      power += out->ring[r].moment[0];
    }
    if (waves > 0 && power > 0 && q / waves < nyquist) {
      out->q[out->count] = q / waves;
      out->c[out->count++] = power / (waves * wave_area);
    }
  }
}

// ---- The self-affine range ----

enum { PARTS = 3 }; // level, slope in the middle, slope beyond

typedef struct {
  double squares, value[PARTS];
} Lines;

// Fits y = level - middle max(0, min(x, b) - a) - beyond max(0, x - b) by least squares. The sum of
// squares is infinite unless 0 < middle.
static Lines fit_lines(const double *x, const double *y, size_t n, double a, double b) {
  double normal[PARTS * PARTS] = {0}, right[PARTS] = {0}, sum = 0;
  for (size_t i = 0; i < n; i++) {
    const double row[PARTS] = {1, -fmax(0, fmin(x[i], b) - a), -fmax(0, x[i] - b)};
    for (int k = 0; k < PARTS; k++) {
      right[k] += row[k] * y[i];
      for (int m = 0; m < PARTS; m++) {
        normal[k * PARTS + m] += row[k] * row[m];
      }
    }
    sum += y[i] * y[i];
  }
  const bool falls = b < x[n - 1];
  if (!falls) {
    normal[PARTS * PARTS - 1] = 1;
  }
  double value[PARTS] = {right[0], right[1], right[2]};
  if (!sb_eliminate(normal, value, PARTS)) {
    return (Lines){.squares = INFINITY};
  }
  const double squares = sum - value[0] * right[0] - value[1] * right[1] - value[2] * right[2];
  const bool sound = value[1] > 0;
  return (Lines){sound ? fmax(squares, 1e-12) : INFINITY, {value[0], value[1], value[2]}};
}

static void find_self_affine(SbHeightSpectrum *out, bool surface) {
  // The window widens the longest waves, the form takes some of them.
  enum { SKIP = 2, LEAST = 8 };
  // A spectrum that falls by this factor from one bin to the next was cut off there.
  const double CLIFF = 10;
  double x[SB_HEIGHT_BINS_MAX], y[SB_HEIGHT_BINS_MAX];
  out->hurst = out->roll_off = out->cut_off = NAN;
  if (out->count < SKIP + LEAST) {
    out->reason = out->roll_off_reason = "too few waves";
    return;
  }
  size_t n = 0;
  for (; n < out->count - SKIP; n++) {
    x[n] = log(out->q[n + SKIP]);
    y[n] = log(out->c[n + SKIP]);
    if (n > 0 && y[n] < y[n - 1] - log(CLIFF)) {
      break;
    }
  }
  const bool cliff = n < out->count - SKIP;
  double best = INFINITY;
  size_t from = 0, to = 0;
  Lines lines = {.squares = INFINITY};
  for (size_t a = 0; a + LEAST / 2 < n; a++) {
    for (size_t b = a + LEAST / 2; b < n; b++) {
      // A level stretch, or a fall, of one bin is none.
      if (a == 1 || b == n - 2) {
        continue;
      }
      const Lines each = fit_lines(x, y, n, x[a], x[b]);
      const double parameters = 2 + (a > 0 ? 1 : 0) + (b < n - 1 ? 2 : 0);
      const double criterion =
          (double)n * log(each.squares / (double)n) + parameters * log((double)n);
      if (criterion < best) {
        best = criterion;
        lines = each;
        from = a;
        to = b;
      }
    }
  }
  const double hurst = surface ? lines.value[1] / 2 - 1 : (lines.value[1] - 1) / 2;
  if (!isfinite(best) || exp(x[to] - x[from]) < 4) {
    out->reason = "no straight range spans a factor of four in wave number";
  } else if (lines.squares / (double)n > 0.5 * 0.5) {
    out->reason = "the spectrum is not a sequence of straight lines";
  } else if (!(hurst > 0 && hurst <= 1)) {
    out->reason = "its slope gives no Hurst exponent between 0 and 1";
  }
  if (out->reason == NULL) {
    out->hurst = hurst;
    out->cut_off = to < n - 1 || cliff ? exp(x[to]) : NAN;
    out->roll_off = from > 0 ? exp(x[from]) : NAN;
  }
  out->roll_off_reason = out->reason != NULL ? out->reason
                         : from == 0         ? "the spectrum has no level part within the scan"
                                             : NULL;
}

// ---- All of it ----

SbStatus sb_height_spectrum(SbHeightSpectrum *out, const SbHeights *heights, SbReport *report) {
  *out = (SbHeightSpectrum){0};
  SbHeights h = *heights;
  h.columns = sb_fourier_length_below(heights->columns);
  h.rows = sb_fourier_length_below(heights->rows);
  out->columns = h.columns;
  out->rows = h.rows;
  const size_t longest = h.columns > h.rows ? h.columns : h.rows, kept = h.columns / 2 + 1;
  out->ring_count = (size_t)(0.7072 * (double)longest) + 2; // to the corners
  out->ring = calloc(out->ring_count, sizeof *out->ring);
  double *filled = NULL, *half = malloc(2 * h.rows * kept * sizeof *half);
  double *line = malloc(2 * h.columns * sizeof *line);
  SbFourier along = {0}, across = {0};
  Window window = {0};
  SbStatus status = sb_fourier_init(&along, h.columns, report);
  if (status == SB_OK && h.rows > 1) {
    status = sb_fourier_init(&across, h.rows, report);
  }
  if (status == SB_OK &&
      (out->ring == NULL || half == NULL || line == NULL || !window_init(&window, &h))) {
    status = sb_fail(report, SB_ERROR_MEMORY, "no memory for the spectrum of %zu x %zu points",
                     h.columns, h.rows);
  }
  double mean = status == SB_OK ? weighted_mean(&h, &window) : 0;
  if (isnan(mean)) {
    // Points are missing.
    filled = malloc(h.rows * h.columns * sizeof *filled);
    if (filled == NULL) {
      status = sb_fail(report, SB_ERROR_MEMORY, "no memory to fill missing points");
    }
    for (size_t i = 0; i < h.rows && filled != NULL; i++) {
      memcpy(filled + i * h.columns, h.z + i * h.stride, h.columns * sizeof *filled);
    }
    h.z = filled;
    h.stride = h.columns;
    status = status == SB_OK ? sb_heights_fill(&h, report) : status;
    mean = status == SB_OK ? weighted_mean(&h, &window) : 0;
  }
  if (status == SB_OK) {
    transform_rows(half, &h, &window, &along, line, mean);
    if (h.rows > 1) {
      sb_fourier_columns(&across, half, h.rows, kept, forward, NULL);
    }
    // <z^2> = sum |Z|^2/(n sum w^2); the squares of Hann's window have the mean 3/8.
    const double n = (double)h.columns * (double)h.rows;
    add_rings(out, half, &h, 1 / (n * n * (h.rows > 1 ? 9.0 / 64 : 3.0 / 8)));
    make_bins(out, &h);
    find_self_affine(out, h.rows > 1);
  }
  sb_fourier_finish(&along);
  sb_fourier_finish(&across);
  free(window.x);
  free(window.y);
  free(filled);
  free(half);
  free(line);
  return status;
}

void sb_height_spectrum_moments(double out[3], const SbHeightSpectrum *spectrum,
                                double cutoff_short, double cutoff_long) {
  memset(out, 0, 3 * sizeof *out);
  for (size_t r = 0; r < spectrum->ring_count; r++) {
    const SbSpectrumRing *ring = &spectrum->ring[r];
    // The Gaussian's transmission exp(-pi (alpha L q/2 pi)^2) of heights, alpha^2 = ln 2/pi.
    const double a = ring->q * cutoff_short / (2 * M_PI), b = ring->q * cutoff_long / (2 * M_PI);
    const double passed = exp(-M_LN2 * a * a) * (cutoff_long > 0 ? -expm1(-M_LN2 * b * b) : 1);
    for (int m = 0; m < 3; m++) {
      out[m] += passed * passed * ring->moment[m];
    }
  }
}
