// Power spectrum of measured heights, averaged over directions: its moments, also after filters,
// and its self-affine range. The functions may be called concurrently on different data.
//
//   C(q) = (2 pi)^-2 integral <z(0) z(r)> exp(-i q r) d2r,  <z^2> = 2 pi integral q C dq
//
// with wave numbers q = 2 pi/wavelength [rad/m]. For a profile C(q) = (2 pi)^-1 integral <z(0)
// z(x)> exp(-i q x) dx, <z^2> = 2 integral C dq. Heights are weighted by Hann's window (Jacobs,
// Junge & Pastewka, Surf. Topogr. 5 (2017) 013001) about their weighted mean. The numbers of rows
// and columns are reduced to products of 2, 3 and 5. Missing points are filled in a copy
// (heights.h).
//
// The moments are sums over all resolved waves, m2 and m4 with (qx^n + qy^n)/2 as in
// height_figures.h. Unlike differences they include short waves fully, with noise and aliasing. If
// both disagree, the spacing of the points determines the value.
//
// Self-affine range: C ~ q^-2(H+1) (profile q^-(2H+1)) between the roll-off, below which C is
// constant, and the cut-off, above which it falls more steeply. Straight lines with these two
// breaks are fitted to ln C against ln q; Schwarz's criterion (Ann. Stat. 6 (1978) 461) decides
// whether a break exists.
#pragma once

#include "engine/contact/rough/heights.h"

// Largest number of bins.
enum { SB_HEIGHT_BINS_MAX = 128 };

// A ring of wave numbers with the powers of its waves.
typedef struct {
  double waves, q;  // number of waves; their mean wave number [1/m]
  double moment[3]; // their contribution to m0, m2, m4
} SbSpectrumRing;

// A spectrum; owns `ring`.
typedef struct {
  size_t columns, rows; // points that were transformed
  size_t ring_count;
  SbSpectrumRing *ring; // [ring_count], by increasing wave number
  double moment[3];     // m0 [m2], m2 [1], m4 [1/m2]
  // Means of the rings in bins of equal ratio.
  size_t count;                 // bins in use
  double q[SB_HEIGHT_BINS_MAX]; // [1/m]
  double c[SB_HEIGHT_BINS_MAX]; // C [m4], profile [m3]
  // Hurst exponent H [1], roll-off and cut-off wave numbers [1/m]; NaN: not found, for the reasons
  // below (static).
  double hurst, roll_off, cut_off;
  const char *reason, *roll_off_reason; // of hurst and cut_off; of roll_off; NULL if found
} SbHeightSpectrum;

// Computes the spectrum. Call sb_height_spectrum_finish() also after an error. SB_ERROR_INFEASIBLE:
// too few heights are measured.
SbStatus sb_height_spectrum(SbHeightSpectrum *out, const SbHeights *heights, SbReport *report);

// Frees the rings and sets all fields to zero.
void sb_height_spectrum_finish(SbHeightSpectrum *spectrum);

// Computes m0, m2, m4 of the waves that Gaussian filters with the cut-off wavelengths [m] transmit
// (0: no filter): `cutoff_short` removes shorter waves, `cutoff_long` longer ones.
void sb_height_spectrum_moments(double out[3], const SbHeightSpectrum *spectrum,
                                double cutoff_short, double cutoff_long);
