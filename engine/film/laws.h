// Formulas about films: power laws, regimes of lubrication, drag and leakage.
#pragma once

#include "engine/base/status.h"

#include <math.h>

// A power law of the film, h/R = k U^a W^b with U = eta (u/2) / (E' R) and W = load / (E' R), of a
// source or regressed on solved films. The thesis fitted such laws to its solver (eq. 7.2-7.5,
// Tables 7.9 to 7.11); with solutions that are converged in the mesh one can stand beside eq. 7.5
// and 7.6.
typedef struct {
  double k, a, b;
  // Half-widths of the 95 % confidence intervals: relative for k, absolute for the exponents. The
  // residuals are the law's lack of fit, not noise: the intervals describe this range only.
  double k_confidence, a_confidence, b_confidence;
} SbFilmLaw;

// h/R of a law.
double sb_film_law(const SbFilmLaw *law, double U, double W);

// Greenwood's chart (1969; Johnson 1970; thesis figure 7.10) has g_E = W/sqrt(U) and g_V = G
// W^(3/2)/sqrt(U) with G = alpha E', and film h W/(R U) in its four corners; the corner that gives
// the thickest film names the regime. The coefficients are Johnson's line-contact ones except the
// isoviscous-elastic one, which is this program's exact limit, 3.00434 g_E^0.8 (commonly 3.10).
typedef struct {
  double g_E, g_V;
  const char *regime; // "isoviscous-elastic" and so on; borrowed
} SbChartPoint;

// Chart coordinates and regime. `entrainment` is u_m = u/2 [m/s], load per length [N/m], `modulus`
// E' [Pa], `pressure_viscosity` alpha [1/Pa]. All but alpha positive.
SbChartPoint sb_regime_chart(double load, double entrainment, double radius, double modulus,
                             double viscosity, double pressure_viscosity);

// The chart's borders: g_V from which on the film is that of rising viscosity, at g_E > 0, and g_E
// from which on it is that of elastic bodies, at g_V > 0.
double sb_regime_viscous_border(double g_E);
double sb_regime_elastic_border(double g_V);

// "boundary", "mixed" or "full film" by lambda = h/sigma below 1, 1 to 3, from 3 (thesis equation
// 2.1); borrowed.
const char *sb_regime_of_lambda(double lambda);

// Viscous drag factor beta of a plane tapered film (thesis equation 5.9): F = A eta u/h_min
// beta(xi) with xi = h_inlet/h_min >= 1, beta = [4 ln xi - 6 (xi - 1)/(xi + 1)]/(xi - 1); beta(1)
// = 1.
double sb_taper_factor(double ratio);

// Volume [m3] that a signed stroke `length` L [m] drags through the contact. Source: thesis
// equations 5.19 to 5.21: a film of central thickness h under a sliding seal carries half of it
// along, q = (1/2) pi D h L, D being the bore's diameter; the net loss of a cycle is what the
// out-stroke carries less what the return brings back. Validity: flooded inlet; a film, not a rough
// gap.
static inline double sb_leak_stroke(double diameter, double film, double length) {
  return M_PI * diameter * film * length / 2;
}
