// Formulas about films: power laws, regimes of lubrication, drag and leakage. The functions have no
// state and may be called concurrently.
#pragma once

#include "engine/base/status.h"

#include <math.h>

// A power law of the film, h/R = k U^a W^b with U = eta (u/2)/(E' R) and W = load/(E' R), from the
// literature or fitted to solved films (thesis eq. 7.2-7.5, tables 7.9 to 7.11).
typedef struct {
  double k, a, b;
  // Half-widths of the 95 % confidence intervals: relative for k, absolute for a and b. They
  // describe the lack of fit in the fitted range.
  double k_confidence, a_confidence, b_confidence;
} SbFilmLaw;

// Returns h/R by a law, with U > 0 and W > 0 as above.
double sb_film_law(const SbFilmLaw *law, double U, double W);

// A point of Greenwood's chart of regimes (1969; Johnson 1970; thesis figure 7.10): g_E =
// W/sqrt(U), g_V = G W^(3/2)/sqrt(U), G = alpha E'. Its four corners have formulas for h W/(R U);
// the corner with the thickest film determines the regime. Coefficients are Johnson's for line
// contacts, except the isoviscous-elastic one, which is our exact limit 3.00434 g_E^0.8
// (usually 3.10).
typedef struct {
  double g_E, g_V; // elasticity and viscosity parameters [1]
  // "isoviscous-rigid", "isoviscous-elastic", "piezoviscous-rigid" or "piezoviscous-elastic";
  // static.
  const char *regime;
} SbChartPoint;

// Returns the chart point of a contact. `load` per length [N/m], `entrainment` u/2 [m/s], `radius`
// [m], `modulus` E' [Pa], `viscosity` [Pa s], `pressure_viscosity` alpha [1/Pa] >= 0. All others
// are positive.
SbChartPoint sb_regime_chart(double load, double entrainment, double radius, double modulus,
                             double viscosity, double pressure_viscosity);

// Returns the g_V above which the regime is piezoviscous, at g_E > 0: a border line of the chart.
double sb_regime_viscous_border(double g_E);

// Returns the g_E above which the regime is elastic, at g_V > 0: a border line of the chart.
double sb_regime_elastic_border(double g_V);

// Returns the regime by lambda = h/sigma: "boundary" below 1, "mixed" below 3, else "full film"
// (thesis equation 2.1); static.
const char *sb_regime_of_lambda(double lambda);

// Returns the drag factor beta of a plane tapered film (thesis equation 5.9), F = A eta u/h_min
// beta. `ratio` xi = h_inlet/h_min >= 1; beta = [4 ln xi - 6 (xi - 1)/(xi + 1)]/(xi - 1), beta(1)
// = 1.
double sb_taper_factor(double ratio);

// Returns the volume [m3] that a stroke transports through the contact, with the sign of `length`
// [m] of the stroke (thesis equations 5.19 to 5.21): q = (1/2) pi D h L, with the `diameter` D of
// the bore [m] and the central `film` thickness h [m]. The net leakage of a cycle is the volume
// that one stroke carries out minus the volume that the other one brings back. Valid for a flooded
// inlet and a full film.
static inline double sb_leak_stroke(double diameter, double film, double length) {
  return M_PI * diameter * film * length / 2;
}
