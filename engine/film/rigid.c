// The rigid wedge behind the common interface of the film models: equations in wedge.h.
//
// Both bodies keep their shape, so the model holds where the film is much thicker than the
// deflection: Moes' M below about 0.5. Its distance from the solved film is then under a few per
// cent; beyond it is told from the blend of the rigid and the elastic limit.
#include "engine/film/scale.h"
#include "engine/film/wedge.h"

#include <math.h>

// Pressure and gap over the wedge, dense about its throat, in increasing x of the seal's frame.
static void wedge_profile(SbFilm *out, const SbFilmProblem *problem, const SbWedge *wedge,
                          const SbWedgeProblem *rigid) {
  enum { POINTS = 801 };
  double unit = sqrt(2 * rigid->radius * rigid->film_min);
  bool forward = problem->speed >= 0;
  for (int i = 0; i < POINTS && out->x != NULL; i++) {
    // tan runs from -30 to 2 throats: the pressure has gone to a ten-thousandth of its peak there.
    double flow = i == POINTS - 1 ? 2 * unit : unit * tan(-1.5375 + 2.6446 * i / (POINTS - 1));
    int at = forward ? i : POINTS - 1 - i;
    sb_film_put(out, (size_t)at, forward ? flow : -flow, sb_wedge_pressure(wedge, rigid, flow),
                rigid->film_min + flow * flow / (2 * rigid->radius));
  }
}

SbStatus sb_film_solve_rigid(SbFilm *out, const SbFilmProblem *problem, const SbFilmScale *scale,
                             SbReport *report) {
  bool forward = problem->speed >= 0;
  SbWedgeProblem rigid = {
      .speed = fabs(problem->speed),
      .radius = problem->radius,
      .viscosity = problem->viscosity,
      .pressure_left = forward ? problem->pressure_left : problem->pressure_right,
      .pressure_right = forward ? problem->pressure_right : problem->pressure_left,
  };
  SbWedge wedge;
  SbStatus status = sb_wedge_solve_load(&wedge, &rigid.film_min, &rigid, problem->load, report);
  if (status != SB_OK) {
    return status;
  }
  double sign = forward ? 1 : -1;
  out->film_min = rigid.film_min;
  out->film_central = rigid.film_min; // the throat lies on the cylinder's axis
  out->film_flux = wedge.film_flux;
  out->flow = wedge.film_flux * problem->speed / 2;
  out->pressure_max = wedge.pressure_max;
  out->position_rupture = sign * wedge.position_rupture;
  out->ruptured = true;
  out->friction_couette = sign * wedge.friction_couette;
  out->friction_poiseuille = sign * wedge.friction_poiseuille;
  wedge_profile(out, problem, &wedge, &rigid);

  // How far the elastic limit says the film really is.
  double elastic = 3.77334 * problem->radius * pow(scale->U, 0.6) * pow(scale->W, -0.2);
  out->expected_error =
      scale->M < 0.5 ? 0.03 : fabs(out->film_flux / fmax(elastic, out->film_flux) - 1);
  if (scale->M >= 0.5) {
    out->valid = false;
    sb_warn(
        &out->warnings, "film-rigid", "models.film",
        "rigid surfaces need M below 0.5; here M = %.3g and the bodies deform more than the film",
        scale->M);
  }
  out->solver.converged = true;
  return sb_succeed(report);
}
