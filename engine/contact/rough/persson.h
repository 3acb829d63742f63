// Persson's contact of a self-affine rough surface: real contact up to full contact, mean
// separation, and the gap at the critical constriction.
//
// Sources: B.N.J. Persson, J. Chem. Phys. 115 (2001) 3840 (contact area); C. Yang & B.N.J. Persson,
// J. Phys.: Condens. Matter 20 (2008) 215214 (separation, with its gamma = 0.45); B.N.J. Persson &
// C. Yang, ibid. 315011 (leak through the critical constriction). Power spectrum C(q) ~ q^(-2(H+1))
// between q0 and q1, H = 0.8.
//
//   A(q)/A0 = erf(sqrt 2 p/(E* h'(q))),  h'(q)^2 = 2 pi int_q0^q k^3 C dk,  1/E* = sum (1 - nu^2)/E
//   u(p) = sqrt(pi) int q^2 C w dq int_p [gamma + 3 (1 - gamma) P^2] exp(-(w p'/E*)^2) dp'/p'
//   P = erf(w p'/E*),  w = (pi int k^3 C dk)^(-1/2): area and separation share one P, and the work
//   int p |du| of closing the gap is the elastic energy at full contact, (pi/2) E* int q^2 C dq
//
// The spectrum follows from the three figures Greenwood and Tripp use, by Nayak's moments of a
// random surface (McCool 1986): tip radius beta = 3 sqrt(pi/m4)/8, density zeta = m4/(6 pi sqrt 3
// m2), m0 = sigma^2. Thus both surface models stand on the same scan. Validity: elastic, no
// adhesion, isotropic Gaussian surface; unlike Greenwood and Tripp's it stays right towards full
// contact of a soft seal.
#pragma once

#include "engine/base/status.h"

typedef struct {
  double sigma;     // rms height h [m]
  double slope;     // rms slope |grad h| = h'(q1)
  double q0, q1;    // roll-off and cut-off wave numbers [1/m]
  double hurst;     // H
  double amplitude; // C(q) = amplitude q^(-2(H+1)) [m^(2-2H)]
} SbSpectrum;

// Spectrum of a surface from sigma [m], sigma/beta and the product zeta beta sigma.
// SB_ERROR_INFEASIBLE where no random surface has these (the product must exceed about 0.0250:
// alpha > 1.5).
SbStatus sb_spectrum_from_asperities(SbSpectrum *out, double sigma, double sigma_over_beta,
                                     double product, SbReport *report);

// Mean-square slope of the components up to wave number q [1/m].
double sb_spectrum_slope2(const SbSpectrum *spectrum, double q);

// Real over nominal contact at pressure p [Pa] seen at wave number q; `modulus` is E' with 2/E' =
// sum.
double sb_persson_area_share(const SbSpectrum *spectrum, double q, double modulus, double pressure);

// The pressure [Pa] at which it is `share`; INFINITY for 1.
double sb_persson_pressure(const SbSpectrum *spectrum, double q, double modulus, double share);

// Mean separation of the surfaces [m] in the parts in contact at wave number `q` (q0: everywhere),
// from the roughness of larger wave numbers (Yang & Persson's integral).
double sb_persson_separation(const SbSpectrum *spectrum, double q, double modulus, double pressure);

// The same as a function of the pressure, its integrals prepared for one wave number; plain data.
enum { SB_PERSSON_INNER = 240, SB_PERSSON_PANELS = 240 };
typedef struct {
  double begin, step;                                         // of ln a in the inner table
  double value[SB_PERSSON_INNER], slope[SB_PERSSON_INNER];    // ln G, d ln G/d ln a
  double log_w[SB_PERSSON_PANELS], weight[SB_PERSSON_PANELS]; // ln w; [m]
} SbPerssonGap;
void sb_persson_gap_init(SbPerssonGap *gap, const SbSpectrum *spectrum, double q);

// Separation [m] at ln(p/E*), p the pressure on the part in contact, and its slope to that.
double sb_persson_gap_at(double *slope, const SbPerssonGap *gap, double log_p);
