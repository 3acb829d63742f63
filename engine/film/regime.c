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
  const struct {
    const char *name;
    double film;
  } corner[] = {
      {"isoviscous-rigid", 4.894968},
      {"isoviscous-elastic", 3.00434 * pow(point.g_E, 0.8)},
      {"piezoviscous-rigid", 1.05 * pow(point.g_V, 2.0 / 3)},
      {"piezoviscous-elastic", 2.05 * pow(point.g_V, 0.54) * pow(point.g_E, 0.06)},
  };
  int thickest = 0;
  for (int i = 1; i < 4; i++) {
    thickest = corner[i].film > corner[thickest].film ? i : thickest;
  }
  point.regime = corner[thickest].name;
  return point;
}

const char *sb_regime_of_lambda(double lambda) {
  return lambda < 1 ? "boundary" : lambda < 3 ? "mixed" : "full film";
}
