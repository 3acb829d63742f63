// One elastic asperity that sticks to a flat, and the sum over a surface of them.
//
// Two tips are one paraboloid of radius R on a flat, K = 4 E*/3 with 1/E* = sum (1 - nu^2)/E, w the
// work of adhesion. At a contact radius a the load is Hertz's K a^3/R less a pull:
//
//   JKR   pull (6 pi w K a^3)^(1/2)   approach a^2/R - (2/3) (6 pi w a/K)^(1/2)
//         Johnson, Kendall & Roberts, Proc. R. Soc. Lond. A 324 (1971) 301
//   DMT   pull 2 pi w R               approach a^2/R
//         Derjaguin, Muller & Toporov, J. Colloid Interface Sci. 53 (1975) 314, as simplified by
//         Maugis, J. Colloid Interface Sci. 150 (1992) 243
//
// JKR's contact tears at the approach -(3/4) (pi^2 w^2 R/E*^2)^(1/3), where a^3 = pi w R^2/(8 E*).
// Tabor's parameter (R w^2/(E*^2 z0^3))^(1/3) (D. Tabor, J. Colloid Interface Sci. 58 (1977) 2),
// z0 = SB_VDW_CUTOFF, says which holds: JKR above some 5, DMT below 0.1 (Johnson & Greenwood, ibid.
// 192 (1997) 326); between them neither is exact, pull-off from 1.5 to 2 pi w R, and the nearer one
// is taken: the divide is at 0.7.
//
// Sums are taken over Gaussian heights as the surfaces separate (K.N.G. Fuller & D. Tabor, Proc. R.
// Soc. Lond. A 345 (1975) 327 with JKR; D. Maugis, J. Adhes. Sci. Technol. 10 (1996) 161 with DMT):
// a contact once made lasts until it tears. Approaching, a contact begins at no overlap and the
// pull is less; the difference is the hysteresis, left out here. Validity: as Greenwood and Tripp,
// independent asperities.
#pragma once

#include "engine/base/status.h"

// Distance of bodies in contact [m] (Israelachvili), as far as attraction between them is cut off.
#define SB_VDW_CUTOFF 0.165e-9

// Where Tabor's parameter is between these neither law is exact.
#define SB_TABOR_DMT 0.1
#define SB_TABOR_JKR 5.0

typedef struct {
  double radius; // R [m]
  double K;      // 4 E*/3 [Pa]
  double work;   // w [J/m2]; 0: Hertz
  double tabor;  // Tabor's parameter
  bool jkr;      // else DMT
  double least;  // contact radius below which it tears [m]
} SbAsperity;

// `modulus` is E' with 2/E' = sum (1 - nu^2)/E.
void sb_asperity_init(SbAsperity *out, double radius, double modulus, double work);

// Says where Tabor's parameter is between the two laws.
void sb_asperity_warn(SbWarnings *warnings, const SbAsperity *asperity);

// At a contact radius [m], load = elastic - pull.
typedef struct {
  double elastic, pull;            // [N]
  double approach, approach_slope; // [m], to the contact radius
} SbAsperityPoint;
void sb_asperity_at(SbAsperityPoint *out, const SbAsperity *asperity, double contact_radius);

// Means over asperities whose heights have the standard deviation `sigma` [m] about a plane
// `lambda` sigma below the other's: elastic load [N], pull [N], contact area [m2], in this order;
// of every asperity, opposite a smooth surface, or, `pairs`, their integrals over the overlap that
// is lost to misalignment, over sigma (Greenwood and Tripp's two rough surfaces). The derivatives
// of the latter to lambda are the former, negative.
void sb_asperity_sums(double out[3], const SbAsperity *asperity, double sigma, double lambda,
                      bool pairs);
