// The Gaussian filter of a surface, rows and then columns; see heights.h. The weights extend to the
// cut-off, where they are 7e-7 of the first. The real part is the height where it is measured (else
// 0), the imaginary part is 1 where it is measured (else 0). Both are filtered together, and their
// ratio is the mean over the existing points.
#include "engine/contact/rough/heights.h"

#include "engine/numeric/fourier.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct {
  SbFourier fourier;
  double *gain; // of the filter at each frequency, real
} Filter;

static void filter_finish(Filter *filter) {
  sb_fourier_finish(&filter->fourier);
  free(filter->gain);
}

static SbStatus filter_init(Filter *filter, size_t count, double distance, double cutoff,
                            SbReport *report) {
  const double reach = floor(cutoff / distance);
  const size_t half = (size_t)fmin(reach, (double)(count - 1));
  SbStatus status =
      sb_fourier_init(&filter->fourier, sb_fourier_length_above(count + half), report);
  const size_t n = filter->fourier.n;
  filter->gain = malloc(n * sizeof *filter->gain);
  double *weights = calloc(2 * n, sizeof *weights);
  if (status == SB_OK && (filter->gain == NULL || weights == NULL)) {
    status = sb_fail(report, SB_ERROR_MEMORY, "no memory for a filter of %zu points", n);
  }
  if (status == SB_OK) {
    double sum = 1;
    weights[0] = 1;
    for (size_t k = 1; k <= half; k++) {
      // exp(-pi (r/(alpha L))^2) with alpha^2 = ln 2/pi
      const double r = (double)k * distance / cutoff;
      const double weight = exp(-M_PI * M_PI / M_LN2 * r * r);
      weights[2 * k] = weights[2 * (n - k)] = weight;
      sum += 2 * weight;
    }
    sb_fourier_forward(&filter->fourier, weights);
    for (size_t k = 0; k < n; k++) {
      filter->gain[k] = weights[2 * k] / sum;
    }
  }
  free(weights);
  return status;
}

static void apply(const SbFourier *fourier, double *line, void *data) {
  const Filter *filter = data;
  sb_fourier_forward(fourier, line);
  for (size_t k = 0; k < fourier->n; k++) {
    line[2 * k] *= filter->gain[k];
    line[2 * k + 1] *= filter->gain[k];
  }
  sb_fourier_inverse(fourier, line);
}

SbStatus sb_heights_filter(SbHeights *h, double cutoff, bool keep, SbReport *report) {
  Filter along = {0}, across = {0};
  double *pairs = malloc(2 * h->rows * h->columns * sizeof *pairs), *line = NULL;
  SbStatus status = filter_init(&along, h->columns, h->dx, cutoff, report);
  if (status == SB_OK && h->rows > 1) {
    status = filter_init(&across, h->rows, h->dy, cutoff, report);
  }
  line = calloc(2 * along.fourier.n, sizeof *line);
  if (status == SB_OK && (pairs == NULL || line == NULL)) {
    status =
        sb_fail(report, SB_ERROR_MEMORY, "no memory to filter %zu points", h->rows * h->columns);
  }
  for (size_t i = 0; i < h->rows && status == SB_OK; i++) {
    memset(line, 0, 2 * along.fourier.n * sizeof *line);
    for (size_t j = 0; j < h->columns; j++) {
      const double z = h->z[i * h->stride + j];
      line[2 * j] = isnan(z) ? 0 : z;
      line[2 * j + 1] = !isnan(z);
    }
    apply(&along.fourier, line, &along);
    memcpy(pairs + 2 * i * h->columns, line, 2 * h->columns * sizeof *line);
  }
  if (status == SB_OK && h->rows > 1) {
    sb_fourier_columns(&across.fourier, pairs, h->rows, h->columns, apply, &across);
  }
  for (size_t i = 0; i < h->rows && status == SB_OK; i++) {
    for (size_t j = 0; j < h->columns; j++) {
      const double *pair = pairs + 2 * (i * h->columns + j);
      double *z = &h->z[i * h->stride + j];
      const double mean = pair[0] / pair[1];
      *z = isnan(*z) ? NAN : keep ? mean : *z - mean;
    }
  }
  filter_finish(&along);
  filter_finish(&across);
  free(pairs);
  free(line);
  return status;
}
