// Chart coordinates and names; sources in regime.h.
#include "engine/film/regime.h"

#include <math.h>

SbChartPoint sb_regime_chart(double load, double entrainment, double radius, double modulus,
                             double viscosity, double pressure_viscosity) {
  SbChartPoint point = {
      .U = viscosity * entrainment / (modulus * radius),
      .W = load / (modulus * radius),
      .G = pressure_viscosity * modulus,
  };
  point.g_E = point.W / sqrt(point.U);
  point.g_V = point.G * pow(point.W, 1.5) / sqrt(point.U);

  // Film parameter h W/(R U) of each corner.
  double film[] = {
      [SB_REGIME_RIGID_ISOVISCOUS] = 4.894968,
      [SB_REGIME_ELASTIC_ISOVISCOUS] = 3.00434 * pow(point.g_E, 0.8),
      [SB_REGIME_RIGID_PIEZOVISCOUS] = 1.05 * pow(point.g_V, 2.0 / 3),
      [SB_REGIME_ELASTIC_PIEZOVISCOUS] = 2.05 * pow(point.g_V, 0.54) * pow(point.g_E, 0.06),
  };
  for (int i = 1; i < 4; i++) {
    if (film[i] > film[point.regime]) {
      point.regime = (SbRegime)i;
    }
  }
  return point;
}

const char *sb_regime_name(SbRegime regime) {
  static const char *const names[] = {"isoviscous-rigid", "isoviscous-elastic",
                                      "piezoviscous-rigid", "piezoviscous-elastic"};
  return names[regime];
}

const char *sb_regime_of_lambda(double lambda) {
  return lambda < 1 ? "boundary" : lambda < 3 ? "mixed" : "full film";
}
