// Problems of films that several tests solve, and how they are solved and compared.
#pragma once

#include "engine/film/film.h"

#include <glib.h>
#include <math.h>

// The outer seal of the thesis' valve, with smooth surfaces.
static inline SbFilmProblem outer_seal(double speed) {
  SbFilmProblem problem;
  sb_film_problem_init(&problem);
  problem.load = 850.2;
  problem.radius = 0.805e-3;
  problem.modulus = 6.5725e6;
  problem.viscosity = 0.211e-3;
  problem.speed = speed;
  return problem;
}

// The same with its asperities.
static inline SbFilmProblem rough_seal(double speed, SbRoughModel surface) {
  SbFilmProblem problem = outer_seal(speed);
  problem.surface = surface;
  problem.gt_product = 0.1289;
  problem.sigma = 1e-6;
  problem.sigma_over_beta = 0.1;
  problem.shear_strength = 3.5e6;
  problem.load_coefficient = 0.19;
  return problem;
}

// Solves without what `solver` remembers, NULL: it has none; says why it fails.
static inline SbStatus solve_cold(SbFilm *out, const SbFilmProblem *problem, SbFilmProfile *profile,
                                  SbFilmSolver *solver) {
  SbReport report;
  SbFilmProblem lent = *problem;
  lent.profile = profile;
  if (solver != NULL) {
    sb_film_solver_forget(solver);
  }
  SbStatus status = sb_film_solve(out, &lent, solver, &report);
  if (status != SB_OK) {
    g_test_message("speed %g, M %g: %s", problem->speed, out->moes_M, report.text);
  }
  return status;
}

static inline void close_to(const char *what, double got, double want, double relative) {
  if (!(fabs(got - want) <= relative * fabs(want))) {
    g_test_message("%s: got %.9g, want %.9g within %g", what, got, want, relative);
    g_test_fail();
  }
}
