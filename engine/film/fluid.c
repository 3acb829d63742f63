// Mobility and shear of the scaled fluid; equations in fluid.h.
#include "engine/film/fluid.h"

#include <math.h>

SbFilmFluid sb_film_fluid(const SbFilmProblem *problem, double pressure, double film) {
  SbFilmFluid fluid = {
      .rupture = problem->rupture_pressure / pressure,
      .barus = problem->pressure_viscosity * pressure,
  };
  if (problem->eyring_stress > 0.0) {
    fluid.eyring = problem->viscosity * fabs(problem->speed) / (problem->eyring_stress * film);
  }
  return fluid;
}

// exp(-alpha p).
static double fluidity(const SbFilmFluid *fluid, double pressure) {
  return fluid->barus > 0.0 ? exp(-fluid->barus * (pressure + fluid->rupture)) : 1.0;
}

void sb_film_mobility(double *m, double *m_film, double *m_pressure, const SbFilmFluid *fluid,
                      double film, double pressure) {
  double thin = fluidity(fluid, pressure);
  *m = thin;
  *m_film = 0.0;
  *m_pressure = -fluid->barus * thin;
  if (fluid->eyring > 0.0) {
    double shear = fluid->eyring / (thin * film);
    double root = sqrt(1.0 + shear * shear);
    *m = thin * root;
    *m_film = -thin * shear * shear / (root * film);
    *m_pressure = fluid->barus * thin * (shear * shear / root - root);
  }
}

double sb_film_shear(const SbFilmFluid *fluid, double film, double pressure) {
  double thin = fluidity(fluid, pressure);
  double shear = fluid->eyring / (thin * film);
  return (shear > 0.0 ? asinh(shear) / shear : 1.0) / (thin * film);
}
