// What a surface's heights say: roughness parameters, spectral moments, summits, and the asperities
// that Greenwood and Tripp's contact takes.
//
// Sq, Sa, Ssk, Sku as ISO 25178-2 (of a profile Pq and so on, ISO 21920-2), about the mean. Slopes
// and curvatures are the seven-point differences of ISO 21920-2, exact to order 6:
//
//   z'  = (z3 - 9 z2 + 45 z1 - 45 z-1 + 9 z-2 - z-3)/(60 d)
//   z'' = (2 z3 - 27 z2 + 270 z1 - 490 z0 + 270 z-1 - 27 z-2 + 2 z-3)/(180 d^2)
//
// Of a wave of 6 points they find 99.3 % and 99.9 %, of one of 4 points 93 and 98 %; shorter ones
// are lost, and the moments with them. Sdq^2 = <z_x^2> + <z_y^2>; the moments of the surface's
// profiles, P.R. Nayak, Trans. ASME J. Lubr. Technol. 93 (1971) 398, are
//
//   m0 = <z^2>,  m2 = (<z_x^2> + <z_y^2>)/2,  m4 = (<z_xx^2> + <z_yy^2>)/2.
//
// Summits are points above their eight neighbours. Of a random isotropic Gaussian surface they
// follow from the moments (Nayak; J.I. McCool, Wear 107 (1986) 37), with alpha = m0 m4/m2^2:
//
//   zeta = m4/(6 pi sqrt 3 m2),  beta = 3 sqrt(pi/m4)/8,  sigma_s^2 = (1 - 0.8968/alpha) m0
//
// with beta one over the mean curvature of summits. Differences and neighbours miss what lies
// between the points: summits by neighbours are 5 % too few where the shortest wave is some 8
// points.
#pragma once

#include "engine/contact/rough/heights.h"

typedef struct {
  double density;         // zeta [1/m2]
  double radius;          // beta, one over the mean curvature [m]
  double sigma;           // of the summits' heights [m]
  double product;         // density times radius times sigma
  double sigma_over_beta; // sigma over radius
} SbAsperityFigures;

// What could not be found is NaN.
typedef struct {
  double sq, sa;        // [m]
  double ssk, sku, sdq; //
  double moment[3];     // m0 [m2], m2, m4 [1/m2]
  size_t summits;
  SbAsperityFigures neighbours; // of a surface; NaN without two summits
  SbAsperityFigures moments;    // the closed forms; those of a profile as a cut through a surface
  double breadth;               // alpha; the closed forms need alpha > 1.5
} SbHeightFigures;

// The mean need not be 0. SB_ERROR_INFEASIBLE without two points.
SbStatus sb_height_figures(SbHeightFigures *out, const SbHeights *heights, SbReport *report);

// The closed forms, of heights whose standard deviation is `sigma`: McCool's of summits, or that of
// the heights, which both contact laws here take for sigma (greenwood_tripp.h, persson.h).
SbAsperityFigures sb_asperities_of_moments(const double moment[3], bool of_summits);

// The part of a surface in row i of m and column j of n; shares its heights.
SbHeights sb_heights_part(const SbHeights *heights, size_t i, size_t m, size_t j, size_t n);
