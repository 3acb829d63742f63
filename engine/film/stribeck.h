// Friction of one contact against the sliding speed, from dry contact to the full film.
#pragma once

#include "engine/film/film.h"

// One point of a Stribeck curve. Forces per length of seal [N/m], positive for a positive speed.
typedef struct {
  double speed;           // [m/s]
  double film_ratio;      // lambda = central film / sigma
  double film_central;    // [m]
  double film_min;        // [m]
  double boundary;        // tau_0 real area + m asperity load
  double viscous;         // Couette over the full film and the broken one
  double coefficient;     // (boundary + viscous) / net load
  double asperity_share;  // of the net load
  double real_area_share; // at the axis
  double load_error;      // |integral of the total pressure - load| / load
  double error;           // estimate of the films' own error, relative
  bool converged;
} SbStribeckPoint;

// Solves `problem` (surface model, shear_strength and load_coefficient set; its speed is not used)
// at `count` >= 2 speeds spaced evenly in the logarithm from `slowest` to `fastest` [m/s] > 0, in
// out[0 .. count - 1]. Each point takes some 10 ms. A point that does not
// converge is flagged and skipped over; SB_ERROR_NOT_CONVERGED if none did. SB_ERROR_INPUT for a
// problem without a surface, SB_ERROR_RANGE for speeds or count, else as sb_film_solve().
SbStatus sb_film_stribeck(SbStribeckPoint *out, size_t count, const SbFilmProblem *problem,
                          double slowest, double fastest, SbReport *report);
