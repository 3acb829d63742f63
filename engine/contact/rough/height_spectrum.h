// The power spectrum of a surface, averaged over directions: its moments, those of the surface as a
// filter would leave it, and the self-affine range.
//
//   C(q) = (2 pi)^-2 integral <z(0) z(r)> exp(-i q r) d2r,  <z^2> = 2 pi integral q C dq
//
// in wave numbers q = 2 pi/wave length [rad/m], as persson.h; of a profile C(q) = (2 pi)^-1
// integral <z(0) z(x)> exp(-i q x) dx, <z^2> = 2 integral C dq. Heights are weighted by Hann's
// window, so that the edges do not count as steps (Jacobs, Junge & Pastewka, Surf. Topogr. 5 (2017)
// 013001), about the mean so weighted, and by rows and columns whose number is a product of 2, 3
// and 5. Missing points are filled for this alone (heights.h).
//
// The moments are sums over all waves that the points resolve, m2 and m4 with (qx^n + qy^n)/2 as
// height_figures.h. Differences pass waves of few points in part only, the spectrum wholly, noise
// and what is folded back from beyond included: where the two part, the distance of the points
// decides the figure.
//
// Self-affine: C ~ q^-2(H+1) (of a profile q^-(2H+1)) between the roll-off, below which C is level,
// and a cut-off, above which it falls more steeply. Straight lines with these two breaks are fitted
// to ln C over ln q by least squares; a break stays where Schwarz's criterion (Ann. Stat. 6 (1978)
// 461) asks for it.
#pragma once

#include "engine/contact/rough/heights.h"

enum { SB_HEIGHT_BINS_MAX = 128 };

// A ring of wave numbers: the powers of its waves.
typedef struct {
  double waves, q; // how many; their mean wave number [1/m]
  double moment[3];
} SbSpectrumRing;

typedef struct {
  size_t columns, rows; // that were transformed
  size_t ring_count;
  SbSpectrumRing *ring; // by wave number
  double moment[3];     // m0 [m2], m2, m4 [1/m2]
  // The ring averages in bins of equal ratio.
  size_t count;
  double q[SB_HEIGHT_BINS_MAX]; // [1/m]
  double c[SB_HEIGHT_BINS_MAX]; // C [m4], of a profile [m3]
  // NaN where there is none: `reason`.
  double hurst, roll_off, cut_off; // H; [1/m]
  const char *reason, *roll_off_reason;
} SbHeightSpectrum;

// SB_ERROR_MEMORY, SB_ERROR_INFEASIBLE; to be finished in any case.
SbStatus sb_height_spectrum(SbHeightSpectrum *out, const SbHeights *heights, SbReport *report);
void sb_height_spectrum_finish(SbHeightSpectrum *spectrum);

// Moments of the waves that Gaussian filters with these cut-offs [m] pass (0: none).
void sb_height_spectrum_moments(double out[3], const SbHeightSpectrum *spectrum,
                                double cutoff_short, double cutoff_long);
