// The film's fluid, scaled: viscosity under pressure and shear (private to engine/film).
//
//   eta = eta_0 exp(alpha p)                                        Barus, p gauge
//   gamma' = (tau_0 / eta) sinh(tau / tau_0)                        Eyring
//
// Where the sliding dominates the shear, with Sigma = eta u / (tau_0 h), the stress is tau_0
// asinh(Sigma) and the pressure flow -(h^3 / 12 eta) sqrt(1 + Sigma^2) dp/dx (Ehret, Dowson and
// Taylor, Proc. R. Soc. A 454 (1998) 763). Left out: temperature, compressibility, and the share of
// the pressure flow in the shear.
#pragma once

#include "engine/film/film.h"

// All zero but the rupture pressure: isoviscous.
typedef struct {
  double rupture; // rupture pressure: the solvers' pressures are above it
  double barus;   // alpha p_H
  double eyring;  // eta |speed| / (tau_0 b^2 / R): Sigma at unit film; 0 = off
} SbFilmFluid;

// Fluid of `problem` for pressures in units of `pressure` [Pa] and films in units of `film` [m].
SbFilmFluid sb_film_fluid(const SbFilmProblem *problem, double pressure, double film);

// Mobility factor m of the pressure flow, h^3 m p' / lambda, and its derivatives to film and
// pressure; 1, 0, 0 without options.
void sb_film_mobility(double *m, double *m_film, double *m_pressure, const SbFilmFluid *fluid,
                      double film, double pressure);

// Mean shear stress of the sliding over eta_0 speed: 1 / film without options.
double sb_film_shear(const SbFilmFluid *fluid, double film, double pressure);
