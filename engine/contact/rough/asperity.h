// One adhesive elastic asperity on a flat, and the mean over a rough surface. The functions have no
// state and may be called concurrently.
//
// Two tips are one paraboloid of radius R on a flat, K = 4 E*/3 with 1/E* = sum (1 - nu^2)/E, w the
// work of adhesion. At the contact radius a the load is Hertz's K a^3/R minus an attraction
// ("pull"):
//
//   JKR   pull (6 pi w K a^3)^(1/2)   approach a^2/R - (2/3) (6 pi w a/K)^(1/2)
//         Johnson, Kendall & Roberts, Proc. R. Soc. Lond. A 324 (1971) 301
//   DMT   pull 2 pi w R               approach a^2/R
//         Derjaguin, Muller & Toporov, J. Colloid Interface Sci. 53 (1975) 314, as simplified by
//         Maugis, J. Colloid Interface Sci. 150 (1992) 243
//
// A JKR contact separates at the approach -(3/4) (pi^2 w^2 R/E*^2)^(1/3), where a^3 = pi w R^2/(8
// E*). Tabor's parameter (R w^2/(E*^2 z0^3))^(1/3), z0 = SB_VDW_CUTOFF (D. Tabor, J. Colloid
// Interface Sci. 58 (1977) 2) selects the law: JKR above 0.7, else DMT. JKR is accurate above 5,
// DMT below 0.1 (Johnson & Greenwood, ibid. 192 (1997) 326); in between the pull-off force is 1.5
// to 2 pi w R.
//
// Means are taken over Gaussian heights while the surfaces separate (K.N.G. Fuller & D. Tabor,
// Proc. R. Soc. Lond. A 345 (1975) 327 with JKR; D. Maugis, J. Adhes. Sci. Technol. 10 (1996) 161
// with DMT): a contact remains until it is torn off. The weaker attraction on approach (hysteresis)
// is not modelled. Asperities are independent.
#pragma once

#include "engine/base/status.h"

// Distance of bodies in contact [m] (Israelachvili), at which the van der Waals attraction is cut
// off.
#define SB_VDW_CUTOFF 0.165e-9

// Between these values of Tabor's parameter neither law is exact.
#define SB_TABOR_DMT 0.1
#define SB_TABOR_JKR 5.0

// An asperity, set by sb_asperity_init().
typedef struct {
  double radius; // R [m]
  double K;      // 4 E*/3 [Pa]
  double work;   // w [J/m2]; 0: no adhesion (Hertz)
  double tabor;  // Tabor's parameter
  bool jkr;      // the law: JKR or DMT
  double least;  // contact radius at which the contact separates [m]
} SbAsperity;

// Sets an asperity of `radius` R [m] and `work` of adhesion w [J/m2]. `modulus` is E' with 2/E' =
// sum (1 - nu^2)/E [Pa].
void sb_asperity_init(SbAsperity *out, double radius, double modulus, double work);

// Adds a warning if Tabor's parameter is between SB_TABOR_DMT and SB_TABOR_JKR.
void sb_asperity_warn(SbWarnings *warnings, const SbAsperity *asperity);

// State at a contact radius; the load is elastic - pull.
typedef struct {
  double elastic, pull;            // [N]
  double approach, approach_slope; // [m]; derivative with respect to the contact radius [1]
} SbAsperityPoint;

// Computes the state at `contact_radius` [m].
void sb_asperity_at(SbAsperityPoint *out, const SbAsperity *asperity, double contact_radius);

// Computes the means per asperity of elastic load [N], pull [N] and contact area [m2] into out[3].
// Heights are Gaussian with standard deviation `sigma` [m]; the flat is `lambda` sigma above their
// mean plane. With `pairs` the means are those of two rough surfaces (Greenwood and Tripp): their
// integrals over the overlap lost by misalignment, divided by sigma. The negative derivative of the
// latter with respect to lambda is the former.
void sb_asperity_sums(double out[3], const SbAsperity *asperity, double sigma, double lambda,
                      bool pairs);
