// Roughness parameters of measured heights: moments, spectral moments, summits, and the asperities
// of Greenwood and Tripp's contact. The functions may be called concurrently on different heights.
//
// Sq, Sa, Ssk, Sku as ISO 25178-2 (of a profile Pq etc., ISO 21920-2), about the mean. Slopes and
// curvatures are the seven-point differences of ISO 21920-2:
//
//   z'  = (z3 - 9 z2 + 45 z1 - 45 z-1 + 9 z-2 - z-3)/(60 d)
//   z'' = (2 z3 - 27 z2 + 270 z1 - 490 z0 + 270 z-1 - 27 z-2 + 2 z-3)/(180 d^2)
//
// Of a sine wave with 6 points per wavelength they compute 99.3 % of the slope and 99.9 % of the
// curvature; with 4 points 93 % and 98 %. Sdq^2 = <z_x^2> + <z_y^2>. The moments of the surface's
// profiles (P.R. Nayak, Trans. ASME J. Lubr. Technol. 93 (1971) 398) are
//
//   m0 = <z^2>,  m2 = (<z_x^2> + <z_y^2>)/2,  m4 = (<z_xx^2> + <z_yy^2>)/2.
//
// Summits are points above their eight neighbours. For a random isotropic Gaussian surface they
// follow from the moments (Nayak; J.I. McCool, Wear 107 (1986) 37), with alpha = m0 m4/m2^2:
//
//   zeta = m4/(6 pi sqrt 3 m2),  beta = 3 sqrt(pi/m4)/8,  sigma_s^2 = (1 - 0.8968/alpha) m0
//
// where beta is 1/(mean curvature of summits). Counted summits are 5 % too few if the shortest wave
// has about 8 points.
#pragma once

#include "engine/contact/rough/heights.h"

// Asperities of a surface. NaN: not available.
typedef struct {
  double density;         // zeta [1/m2]
  double radius;          // beta, 1/(mean curvature of summits) [m]
  double sigma;           // standard deviation of the summit heights [m]
  double product;         // density * radius * sigma
  double sigma_over_beta; // sigma/radius
} SbAsperityFigures;

// Parameters of a surface or profile. NaN: not available.
typedef struct {
  double sq, sa;                // rms and mean absolute height [m]
  double ssk, sku, sdq;         // skewness, kurtosis (3 for Gaussian heights), rms slope [1]
  double moment[3];             // m0 [m2], m2 [1], m4 [1/m2]
  size_t summits;               // number of counted summits; 0 of a profile
  SbAsperityFigures neighbours; // from counted summits; NaN with fewer than two
  SbAsperityFigures moments;    // from the moments (a profile is taken as a section of a surface);
                                // sigma is that of the summits, NaN if breadth <= 1.5
  double breadth;               // alpha = m0 m4/m2^2
} SbHeightFigures;

// Computes the parameters. The mean of the heights need not be 0; missing points are left out.
// SB_ERROR_INFEASIBLE: fewer than two heights are measured.
SbStatus sb_height_figures(SbHeightFigures *out, const SbHeights *heights, SbReport *report);

// Returns the asperities that follow from moment[3] = m0, m2, m4; NaN if alpha <= 1.5. With
// `of_summits` the field sigma is sigma_s, the standard deviation of the summits. Without, it is
// sqrt(m0), that of all heights, which greenwood_tripp.h and persson.h require.
SbAsperityFigures sb_asperities_of_moments(const double moment[3], bool of_summits);

// Divides a surface into m by n parts (rows by columns), whose sizes differ by at most one row and
// column, and returns the part (i, j), i = 0 to m - 1, j = 0 to n - 1. Its `z` points into
// heights->z, which must remain valid: changes appear in both.
SbHeights sb_heights_part(const SbHeights *heights, size_t i, size_t m, size_t j, size_t n);
