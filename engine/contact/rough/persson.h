// Persson's contact of a self-affine rough surface: real contact up to full contact, mean
// separation, and the gap at the critical constriction. The functions have no state and may be
// called concurrently.
//
// Sources: B.N.J. Persson, J. Chem. Phys. 115 (2001) 3840 (contact area); C. Yang & B.N.J. Persson,
// J. Phys.: Condens. Matter 20 (2008) 215214 (separation, with its gamma = 0.45); B.N.J. Persson &
// C. Yang, ibid. 315011 (leakage). Power spectrum C(q) ~ q^(-2(H+1)) between q0 and q1, H = 0.8.
//
//   A(q)/A0 = erf(sqrt 2 p/(E* h'(q))),  h'(q)^2 = 2 pi int_q0^q k^3 C dk,  1/E* = sum (1 - nu^2)/E
//   u(p) = sqrt(pi) int_q^q1 k^2 C(k) w(k) G(w(k) p/E*) dk,  w(k) = (pi int_q^k k'^3 C dk')^(-1/2)
//   G(a) = int_a^inf [gamma + 3 (1 - gamma) erf(b)^2] exp(-b^2) db/b
//
// E* = E'/2. The work int p |du| of closing the gap equals the elastic energy at full contact,
// (pi/2) E* int q^2 C dq.
//
// The spectrum follows from the parameters of Greenwood and Tripp by Nayak's moments (McCool 1986):
// tip radius beta = 3 sqrt(pi/m4)/8, density zeta = m4/(6 pi sqrt 3 m2), m0 = sigma^2. Valid for an
// elastic isotropic Gaussian surface without adhesion, also near full contact.
#pragma once

#include "engine/base/status.h"

// A self-affine power spectrum.
typedef struct {
  double sigma;     // rms height h [m]
  double slope;     // rms slope of the full surface, h'(q1) [1]
  double q0, q1;    // roll-off and cut-off wave numbers, 2 pi divided by the wavelength [1/m]
  double hurst;     // H
  double amplitude; // C(q) = amplitude q^(-2(H+1)) [m^(2-2H)]
} SbSpectrum;

// Computes the spectrum from `sigma` [m], sigma divided by beta [1] and `product` zeta beta sigma
// [1]; of two rough surfaces sigma is the combined rms height.
// SB_ERROR_RANGE: one of them is not positive. SB_ERROR_INFEASIBLE: no random surface has this
// product; it must exceed about 0.0250 (alpha > 1.5).
SbStatus sb_spectrum_from_asperities(SbSpectrum *out, double sigma, double sigma_over_beta,
                                     double product, SbReport *report);

// Returns the wave number [1/m] up to which the components have the fraction `part` (0 to 1) of the
// mean-square slope h'(q1)^2.
double sb_spectrum_wave(const SbSpectrum *spectrum, double part);

// Returns the rms height [m] of the components beyond the wave number q [1/m].
double sb_spectrum_height_beyond(const SbSpectrum *spectrum, double q);

// Returns the fraction of real contact at the mean `pressure` p [Pa] at the wave number q [1/m],
// which here and below is limited to the range from q0 to q1. `modulus` is E' with 2/E' = sum (1 -
// nu^2)/E [Pa].
double sb_persson_area_share(const SbSpectrum *spectrum, double q, double modulus, double pressure);

// Returns the mean pressure [Pa] at which sb_persson_area_share() is `share`; INFINITY for 1.
double sb_persson_pressure(const SbSpectrum *spectrum, double q, double modulus, double share);

// Returns the mean separation [m] in the area of contact at the wave number q (q0: the full area)
// due to the roughness of larger wave numbers (Yang & Persson's integral), at the mean `pressure`
// [Pa].
double sb_persson_separation(const SbSpectrum *spectrum, double q, double modulus, double pressure);

// Sizes of the tables of SbPerssonGap.
enum { SB_PERSSON_INNER = 240, SB_PERSSON_PANELS = 240 };

// The separation as a function of pressure, prepared for one wave number; plain data, read by any
// thread. a = w p/E*.
typedef struct {
  double begin, step; // first ln a and step of ln a in the table of G
  double value[SB_PERSSON_INNER], slope[SB_PERSSON_INNER];    // ln G, d ln G/d ln a
  double log_w[SB_PERSSON_PANELS], weight[SB_PERSSON_PANELS]; // u = sum weight [m] G(w p/E*); ln w
} SbPerssonGap;

// Sets all fields for the wave number q [1/m].
void sb_persson_gap_init(SbPerssonGap *gap, const SbSpectrum *spectrum, double q);

// Changes the wave number of a `gap` of the same spectrum to q; faster than the above.
void sb_persson_gap_move(SbPerssonGap *gap, const SbSpectrum *spectrum, double q);

// Returns the separation [m] at `log_p` = ln(p/E*), with the pressure p on the area that is in
// contact at q, and writes the derivative of the separation with respect to log_p to *slope.
double sb_persson_gap_at(double *slope, const SbPerssonGap *gap, double log_p);
