// See fourier.h.
#include "engine/numeric/fourier.h"

#include <stdlib.h>
#include <string.h>

enum { BLOCK = 8 }; // columns that are copied together: a line of the cache

static bool is_smooth(size_t n) {
  static const size_t primes[] = {2, 3, 5};
  for (size_t i = 0; i < sizeof primes / sizeof *primes; i++) {
    while (n % primes[i] == 0) {
      n /= primes[i];
    }
  }
  return n == 1;
}

size_t sb_fourier_length_above(size_t n) {
  while (!is_smooth(n)) {
    n++;
  }
  return n;
}

size_t sb_fourier_length_below(size_t n) {
  while (!is_smooth(n)) {
    n--;
  }
  return n;
}

SbStatus sb_fourier_init(SbFourier *fourier, size_t n, SbReport *report) {
  *fourier = (SbFourier){n, gsl_fft_complex_wavetable_alloc(n), gsl_fft_complex_workspace_alloc(n),
                         malloc(2 * BLOCK * n * sizeof(double))};
  if (fourier->table == NULL || fourier->work == NULL || fourier->block == NULL) {
    return sb_fail(report, SB_ERROR_MEMORY, "no memory for transforms of %zu numbers", n);
  }
  return SB_OK;
}

void sb_fourier_finish(SbFourier *fourier) {
  if (fourier->table != NULL) {
    gsl_fft_complex_wavetable_free(fourier->table);
  }
  if (fourier->work != NULL) {
    gsl_fft_complex_workspace_free(fourier->work);
  }
  free(fourier->block);
  *fourier = (SbFourier){0};
}

void sb_fourier_forward(const SbFourier *fourier, double *line) {
  gsl_fft_complex_forward(line, 1, fourier->n, fourier->table, fourier->work);
}

void sb_fourier_inverse(const SbFourier *fourier, double *line) {
  gsl_fft_complex_inverse(line, 1, fourier->n, fourier->table, fourier->work);
}

void sb_fourier_columns(const SbFourier *fourier, double *matrix, size_t rows, size_t columns,
                        void (*act)(const SbFourier *fourier, double *line, void *data),
                        void *data) {
  const size_t length = 2 * fourier->n;
  for (size_t first = 0; first < columns; first += BLOCK) {
    const size_t count = columns - first < BLOCK ? columns - first : BLOCK;
    for (size_t i = 0; i < rows; i++) {
      for (size_t k = 0; k < count; k++) {
        memcpy(fourier->block + k * length + 2 * i, matrix + 2 * (i * columns + first + k),
               2 * sizeof(double));
      }
    }
    for (size_t k = 0; k < count; k++) {
      double *line = fourier->block + k * length;
      memset(line + 2 * rows, 0, (length - 2 * rows) * sizeof *line);
      act(fourier, line, data);
    }
    for (size_t i = 0; i < rows; i++) {
      for (size_t k = 0; k < count; k++) {
        memcpy(matrix + 2 * (i * columns + first + k), fourier->block + k * length + 2 * i,
               2 * sizeof(double));
      }
    }
  }
}
