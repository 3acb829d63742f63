// Discrete Fourier transforms of complex vectors and of the columns of complex matrices (GSL's
// mixed radix).
//
// Forward: Z_k = sum_j z_j exp(-2 pi i j k/n), not normalised. Inverse: exponent +, divided by n. A
// length n whose prime factors are 2, 3 and 5 costs O(n log n). Complex numbers are pairs (real
// part, imaginary part) of doubles.
#pragma once

#include "engine/base/status.h"

#include <gsl/gsl_fft_complex.h>

// Returns the smallest length >= n whose only prime factors are 2, 3 and 5; n >= 1.
size_t sb_fourier_length_above(size_t n);

// Returns the largest length <= n whose only prime factors are 2, 3 and 5; n >= 1.
size_t sb_fourier_length_below(size_t n);

// Tables and work memory for transforms of n complex numbers, set by sb_fourier_init(). The
// functions below use the work memory also through a const pointer: one thread at a time.
typedef struct {
  size_t n; // complex numbers of a transform
  gsl_fft_complex_wavetable *table;
  gsl_fft_complex_workspace *work;
  double *block; // work memory of sb_fourier_columns()
} SbFourier;

// Allocates tables and work memory for length n >= 1. Call sb_fourier_finish() also after
// SB_ERROR_MEMORY.
SbStatus sb_fourier_init(SbFourier *fourier, size_t n, SbReport *report);

// Frees the memory and sets all fields to zero. A zeroed structure is allowed.
void sb_fourier_finish(SbFourier *fourier);

// Transforms line[2*n] in place, forward.
void sb_fourier_forward(const SbFourier *fourier, double *line);

// Transforms line[2*n] in place, inverse, including the division by n.
void sb_fourier_inverse(const SbFourier *fourier, double *line);

// Calls `act` once for every column of the complex matrix[rows][columns], rows <= n. `act` gets the
// column as line[2*n], padded with zeros from `rows` on. It may transform and change `line` in
// place; the first `rows` numbers that it leaves replace the column. `act` may call
// sb_fourier_forward() and sb_fourier_inverse() with the same `fourier`, but not
// sb_fourier_columns().
void sb_fourier_columns(const SbFourier *fourier, double *matrix, size_t rows, size_t columns,
                        void (*act)(const SbFourier *fourier, double *line, void *data),
                        void *data);
