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
// with DMT): a contact remains until it is torn off. Not modelled: approaching surfaces, which
// attract each other less (hysteresis). Asperities are independent.
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
  double radius; // R of the paraboloid that replaces the two tips [m]
  double K;      // 4 E*/3 [Pa]
  double work;   // w [J/m2]; 0: no adhesion (Hertz)
  double tabor;  // Tabor's parameter
  bool jkr;      // the law: JKR or DMT
  double least;  // contact radius a at which the contact separates [m]; 0 with DMT or Hertz
} SbAsperity;

// Sets all fields of an asperity. `radius` is R [m] > 0: the tip radius against a flat, half of it
// for two equal tips. `modulus` is E' with 2/E' = sum (1 - nu^2)/E [Pa] > 0. `work` is the work of
// adhesion w [J/m2] >= 0.
void sb_asperity_init(SbAsperity *out, double radius, double modulus, double work);

// Adds the warning "adhesion-transition" if Tabor's parameter is between SB_TABOR_DMT and
// SB_TABOR_JKR.
void sb_asperity_warn(SbWarnings *warnings, const SbAsperity *asperity);

// State at a contact radius. The load on the asperity is elastic - pull.
typedef struct {
  double elastic;                  // Hertz's load K a^3/R [N]
  double pull;                     // attraction [N], >= 0
  double approach, approach_slope; // approach [m], < 0 of a stretched tip; d(approach)/da [1]
} SbAsperityPoint;

// Computes the state at `contact_radius` a [m], which must be >= asperity->least; with JKR > 0.
void sb_asperity_at(SbAsperityPoint *out, const SbAsperity *asperity, double contact_radius);

// Computes means over Gaussian heights: out[0] elastic load [N], out[1] pull [N], out[2] contact
// area [m2]. `sigma` [m] > 0 is the standard deviation of the heights, `lambda` sigma the distance
// of the undeformed mean planes.
//
// `pairs` false: one rough surface and a flat; the means are per asperity. `pairs` true: two rough
// surfaces (Greenwood and Tripp), `sigma` is the combined standard deviation of both, and
// `asperity` has R = beta/2 of two tips of radius beta. Each value, multiplied by 4 pi zeta^2 beta
// sigma (zeta: asperities per area of one surface), is then a load or contact area per nominal
// area. The derivative of these values with respect to lambda is the negative of the values without
// `pairs`.
void sb_asperity_sums(double out[3], const SbAsperity *asperity, double sigma, double lambda,
                      bool pairs);
