// A power law of the film, h/R = k U^a W^b, regressed on our own coupled solutions.
//
// The thesis fitted such laws to its solver (eq. 7.2-7.5, Tables 7.9 to 7.11). This does the same
// with solutions that are converged in the mesh, over any range of U = eta (u/2) / (E' R) and W =
// load / (E' R), so that the law can stand beside eq. 7.5 and 7.6 with its residuals.
#pragma once

#include "engine/film/film.h"

enum { SB_FILM_LAW_POINTS = 400 };

typedef enum { SB_FILM_LAW_MIN, SB_FILM_LAW_CENTRAL, SB_FILM_LAW_FLUX } SbFilmLawFilm;

// Where to solve: a grid, even in ln U and ln W.
typedef struct {
  SbFilmLawFilm film;
  double U_min, U_max;
  double W_min, W_max;
  size_t U_count, W_count; // at least 2 each, at most SB_FILM_LAW_POINTS together
  double tolerance;        // of every solve
  // Asked and told after every solve; both may be NULL.
  bool (*cancelled)(void *data);
  void (*progress)(void *data, double fraction);
  void *data;
} SbFilmLawRange;

// The law and how well it holds. Plain data.
typedef struct {
  double k, a, b;
  // Half-widths of the 95 % confidence intervals: relative for k, absolute for the exponents. The
  // residuals are the law's lack of fit, not noise: the intervals describe this range only.
  double k_confidence, a_confidence, b_confidence;
  double rms_residual, largest_residual; // relative
  double error; // largest estimate of the solves' own error in the film, relative
  size_t count;
  double U[SB_FILM_LAW_POINTS], W[SB_FILM_LAW_POINTS];
  double H[SB_FILM_LAW_POINTS];        // h / R solved
  double residual[SB_FILM_LAW_POINTS]; // solved / law - 1
} SbFilmLaw;

// Solves the grid and fits the law. SB_ERROR_RANGE for an empty or too large
// grid, SB_ERROR_NOT_CONVERGED if any solve fails, SB_ERROR_CANCELLED,
// SB_ERROR_MEMORY.
SbStatus sb_film_law_fit(SbFilmLaw *out, const SbFilmLawRange *range, SbReport *report);
