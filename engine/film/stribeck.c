// A Stribeck curve by repeated mixed solutions; what each takes and leaves out is in ehl.h.
#include "engine/film/stribeck.h"

#include <math.h>
#include <stdlib.h>

SbStatus sb_film_stribeck(SbStribeckPoint *out, size_t count, const SbFilmProblem *problem,
                          double slowest, double fastest, SbReport *report) {
  if (problem->surface == SB_ROUGH_NONE) {
    return sb_fail(report, SB_ERROR_INPUT, "a Stribeck curve needs a rough surface");
  }
  if (count < 2 || !(slowest > 0 && fastest > slowest)) {
    return sb_fail(report, SB_ERROR_RANGE,
                   "a Stribeck curve needs two rising speeds and two points");
  }
  SbFilm *film = malloc(sizeof *film);
  SbFilmSolver *solver = NULL;
  SbStatus status = film != NULL ? sb_film_solver_create(&solver, report)
                                 : sb_fail(report, SB_ERROR_MEMORY, "film: out of memory");
  size_t converged = 0;
  for (size_t i = 0; i < count && status == SB_OK; i++) {
    SbFilmProblem at = *problem;
    at.speed = slowest * pow(fastest / slowest, (double)i / (double)(count - 1));
    status = sb_film_solve(film, &at, solver, report);
    if (status == SB_ERROR_NOT_CONVERGED) {
      out[i] = (SbStribeckPoint){at.speed, NAN, NAN, NAN, NAN, NAN, NAN, NAN, NAN, NAN, NAN, false};
      status = SB_OK;
      continue;
    }
    if (status != SB_OK) {
      break;
    }
    converged++;
    double viscous = film->friction_couette + film->friction_cavity;
    out[i] = (SbStribeckPoint){
        .speed = at.speed,
        .film_ratio = film->film_ratio,
        .film_central = film->film_central,
        .film_min = film->film_min,
        .boundary = film->friction_boundary,
        .viscous = viscous,
        .coefficient = (film->friction_boundary + viscous) / at.load,
        .asperity_share = film->asperity_share,
        .real_area_share = film->real_area_share,
        .load_error = film->solver.load_error,
        .error = fmax(film->solver.error_film_min, film->solver.error_film_central),
        .converged = true,
    };
  }
  if (status == SB_OK && converged == 0) {
    status = sb_fail(report, SB_ERROR_NOT_CONVERGED, "no point of the Stribeck curve converged");
  } else if (status == SB_OK) {
    status = sb_succeed(report);
  }
  free(film);
  sb_film_solver_destroy(solver);
  return status;
}
