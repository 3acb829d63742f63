// Regimes of lubrication: by the film against the roughness, and by Greenwood's chart.
//
// lambda = h/sigma: below 1 boundary, 1 to 3 mixed, from 3 full film (thesis equation 2.1). The
// chart (Greenwood 1969; Johnson 1970; thesis figure 7.10) has g_E = W/sqrt(U) and g_V = G
// W^(3/2)/sqrt(U) with G = alpha E', and film h W/(R U) in its four corners; the corner that gives
// the thickest film names the regime. The coefficients are Johnson's line-contact ones except the
// isoviscous-elastic one, which is this program's exact limit, 3.00434 g_E^0.8 (commonly 3.10).
#pragma once

typedef struct {
  double U, W, G;     // Dowson's groups: eta u_m/(E'R), w/(E'R), alpha E'
  double g_E, g_V;    // chart coordinates
  const char *regime; // "isoviscous-elastic" and so on; borrowed
} SbChartPoint;

// Chart coordinates and regime. `entrainment` is u_m = u/2 [m/s], load per length [N/m], `modulus`
// E' [Pa], `pressure_viscosity` alpha [1/Pa]. All but alpha positive.
SbChartPoint sb_regime_chart(double load, double entrainment, double radius, double modulus,
                             double viscosity, double pressure_viscosity);

// "boundary", "mixed" or "full film"; borrowed.
const char *sb_regime_of_lambda(double lambda);
