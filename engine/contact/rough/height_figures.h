// Roughness parameters of measured heights: moments, spectral moments, summits, and the asperities
// of Greenwood and Tripp's contact. The functions may be called concurrently on different heights.
//
// Sq, Sa, Ssk, Sku as ISO 25178-2 (of a profile Pq etc., ISO 21920-2), about the mean. Slopes and
// curvatures are the seven-point differences of ISO 21920-2:
//
//   z'  = (z3 - 9 z2 + 45 z1 - 45 z-1 + 9 z-2 - z-3)/(60 d)
//   z'' = (2 z3 - 27 z2 + 270 z1 - 490 z0 + 270 z-1 - 27 z-2 + 2 z-3)/(180 d^2)
//
// They find 99.3 % and 99.9 % of a wave of 6 points, 93 and 98 % of one of 4 points. Sdq^2 =
// <z_x^2> + <z_y^2>. The moments of the surface's profiles (P.R. Nayak, Trans. ASME J. Lubr.
// Technol. 93 (1971) 398) are
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
  double ssk, sku, sdq;         // skewness, kurtosis, rms slope [1]
  double moment[3];             // m0 [m2], m2 [1], m4 [1/m2]
  size_t summits;               // counted
  SbAsperityFigures neighbours; // from counted summits (surfaces with at least two)
  SbAsperityFigures moments;    // from the moments (a profile is taken as a section of a surface)
  double breadth;               // alpha; the moments need alpha > 1.5
} SbHeightFigures;

// Computes the parameters. The mean of the heights need not be 0. SB_ERROR_INFEASIBLE: fewer than
// two heights.
SbStatus sb_height_figures(SbHeightFigures *out, const SbHeights *heights, SbReport *report);

// Returns the asperities that follow from moment[3] = m0, m2, m4; NaN if alpha <= 1.5. `sigma` is
// McCool's of summits if `of_summits`, else that of all heights, as both contact laws use it
// (greenwood_tripp.h, persson.h).
SbAsperityFigures sb_asperities_of_moments(const double moment[3], bool of_summits);

// Returns part (i, j) of a surface divided into m by n parts (rows by columns). It shares the
// heights of `heights`.
SbHeights sb_heights_part(const SbHeights *heights, size_t i, size_t m, size_t j, size_t n);
