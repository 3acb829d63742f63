// Discrete Fourier transforms of lines and of the columns of matrices, by GSL's mixed radix.
//
// forward: Z_k = sum_j z_j exp(-2 pi i j k/n); the inverse divides by n. Lengths whose factors are
// 2, 3 and 5 take O(n log n).
#pragma once

#include "engine/base/status.h"

#include <gsl/gsl_fft_complex.h>

// Such a length: the least not below n, the greatest not above it (n >= 1).
size_t sb_fourier_length_above(size_t n);
size_t sb_fourier_length_below(size_t n);

// What transforms of one length need; zeroed it is empty.
typedef struct {
  size_t n;
  gsl_fft_complex_wavetable *table;
  gsl_fft_complex_workspace *work;
  double *block; // some columns, side by side
} SbFourier;

// SB_ERROR_MEMORY; to be finished in any case.
SbStatus sb_fourier_init(SbFourier *fourier, size_t n, SbReport *report);
void sb_fourier_finish(SbFourier *fourier);

// In place, of n pairs of real and imaginary part.
void sb_fourier_forward(const SbFourier *fourier, double *line);
void sb_fourier_inverse(const SbFourier *fourier, double *line);

// Calls `act` with every column of a complex matrix of at most n rows, continued by zeros to n
// pairs, and takes back what it leaves in the first rows.
void sb_fourier_columns(const SbFourier *fourier, double *matrix, size_t rows, size_t columns,
                        void (*act)(const SbFourier *fourier, double *line, void *data),
                        void *data);
