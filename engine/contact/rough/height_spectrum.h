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
// height_figures.h. Unlike the differences there, they include the shortest waves fully, with noise
// and aliasing. If the moments of both headers disagree, the spacing of the points determines them.
//
// Self-affine range: C ~ q^-2(H+1) (profile q^-(2H+1)) between the roll-off, below which C is
// constant, and the cut-off, above which it falls more steeply. Straight lines with these two
// breaks are fitted to ln C against ln q; Schwarz's criterion (Ann. Stat. 6 (1978) 461) decides
// whether a break exists.
#pragma once

#include "engine/contact/rough/heights.h"

// Largest number of bins.
enum { SB_HEIGHT_BINS_MAX = 128 };

// The waves within a range of wave numbers (a ring in the plane of qx and qy).
typedef struct {
  double waves;     // number of waves; may be 0
  double q;         // mean wave number of the waves [rad/m]
  double moment[3]; // contribution of the waves to m0 [m2], m2 [1], m4 [1/m2]
} SbSpectrumRing;

// A spectrum; owns `ring`.
typedef struct {
  size_t columns, rows; // size of the transformed part of the grid, its first columns and rows
  size_t ring_count;
  SbSpectrumRing *ring; // [ring_count], by increasing wave number
  double moment[3];     // m0 [m2], m2 [1], m4 [1/m2]
  // Means over bins of rings. The ratio of upper to lower wave number is equal for all bins.
  size_t count;                 // bins in use
  double q[SB_HEIGHT_BINS_MAX]; // mean wave number, increasing [rad/m]
  double c[SB_HEIGHT_BINS_MAX]; // C of the bin [m4], of a profile [m3]
  double hurst;                 // H [1]; NaN: not found
  double roll_off;              // wave number of the roll-off [rad/m]; NaN: not found
  double cut_off;     // wave number of the cut-off [rad/m]; NaN: not found, or beyond the last bin
  const char *reason; // why hurst, roll_off and cut_off are NaN, static; NULL: H was found
  const char *roll_off_reason; // why roll_off is NaN, static; NULL: the roll-off was found
} SbHeightSpectrum;

// Computes the spectrum of heights whose form was removed (sb_heights_prepare()). Call
// sb_height_spectrum_finish() also after an error. SB_ERROR_MEMORY is its only error.
SbStatus sb_height_spectrum(SbHeightSpectrum *out, const SbHeights *heights, SbReport *report);

// Frees spectrum->ring and sets all fields to zero.
void sb_height_spectrum_finish(SbHeightSpectrum *spectrum);

// Computes m0, m2, m4 of the waves that Gaussian filters with the cut-off wavelengths [m] transmit
// (0: no filter): `cutoff_short` removes shorter waves, `cutoff_long` longer ones (heights.h).
void sb_height_spectrum_moments(double out[3], const SbHeightSpectrum *spectrum,
                                double cutoff_short, double cutoff_long);
