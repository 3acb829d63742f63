// A power law of the film, h/R = k U^a W^b, regressed on solved films (thesis eq. 7.2-7.4).
//
// The thesis fitted such laws to its solver (eq. 7.5, Tables 7.9 to 7.11). With solutions that are
// converged in the mesh, over any range of U = eta (u/2) / (E' R) and W = load / (E' R), the law
// can stand beside eq. 7.5 and 7.6.
#pragma once

#include "engine/base/status.h"

enum { SB_FILM_LAW_POINTS = 400 };

typedef struct {
  double k, a, b;
  // Half-widths of the 95 % confidence intervals: relative for k, absolute for the exponents. The
  // residuals are the law's lack of fit, not noise: the intervals describe this range only.
  double k_confidence, a_confidence, b_confidence;
} SbFilmLaw;

// h/R of a law.
double sb_film_law(const SbFilmLaw *law, double U, double W);

// Fits the law to films H = h/R, all > 0, 3 to SB_FILM_LAW_POINTS of them, by least squares of the
// logarithms. SB_ERROR_RANGE otherwise, SB_ERROR_MEMORY.
SbStatus sb_film_law_fit(SbFilmLaw *out, const double *U, const double *W, const double *H,
                         size_t count, SbReport *report);
