// Scales, fluid and dry contact shared by the film models. Private to engine/film.
#pragma once

#include "engine/film/film.h"

// Scales of a line contact: X = x/b, P = p/p_H, H = h R/b^2. The isoviscous half-plane problem then
// depends on lambda = 3 pi^2 U/(4 W^2) only. The flow frame has the inlet on the left (X < 0) for
// either sign of the speed.
typedef struct {
  double half_width; // b [m]
  double pressure;   // p_H [Pa]
  double film;       // b^2/R [m]
  double U;          // eta |speed|/(2 E' R)
  double W;          // load/(E' R)
  double M;          // W/sqrt(2 U); 0 at zero speed
  double lambda;     // 3 pi^2 U/(4 W^2)
  double inlet;      // pressure at the inlet minus the rupture pressure, divided by p_H
  double outlet;     // the same at the outlet
  double kappa;      // slope factor of the dry pressure at the inlet edge, 1 - (inlet - outlet)/pi
  double kappa_outlet; // the same at the outlet edge, 1 + (inlet - outlet)/pi
  // Contact of a fitted body, 0 on a half-plane: its middle divided by b in the flow frame;
  // deviation of its dry pressure from Hertz's, p_dry = ends + sqrt(1 - X^2) (1 + sum bow[k]
  // U_k(X)).
  double middle;
  double bow[SB_COMPLIANCE_PRESSURES];
} SbFilmScale;

// A fitted body that replaces the half-plane, with its scales.
typedef struct {
  const SbSurfaceCompliance *compliance; // borrowed; NULL: half-plane
  double side;                           // seal's x = side times flow frame's x, 1 or -1
  double half_width, film;               // b and the film scale [m]
} SbFilmBody;

// Returns whether `problem` has asperities or adhesion.
bool sb_film_rough(const SbFilmProblem *problem);

// Returns the half-plane scales of a checked problem.
SbFilmScale sb_film_scale(const SbFilmProblem *problem);

// Solves the dry contact of problem->compliance into *dry and sets half-width, middle and edge
// slopes of *scale: b is half its width, p_H = 2 w/(pi b), film = 4 p_H b/E'. SB_ERROR_INPUT: the
// moduli of problem and body differ; else the errors of sb_dry_contact().
SbStatus sb_film_scale_fitted(SbFilmScale *scale, SbDryContact *dry, const SbFilmProblem *problem,
                              SbReport *report);

// Adds to out[modes] the moments of the ambient pressures outside a mesh from `begin` to `end`
// (scaled, from the axis), minus those of the lower ambient pressure everywhere. Adds their
// derivatives with respect to the axis position to slope[modes]. `inlet`, `outlet`: scaled
// pressures.
void sb_film_ambient(double *out, double *slope, const SbFilmBody *body, double inlet,
                     double outlet, double begin, double end);

// Returns the correction to the slope of the gap that moves the tilt of unequal ambient pressures
// from |X| < 1 to the window of the body; multiply it by X.
double sb_film_window_tilt(const SbFilmBody *body, double inlet, double outlet);

// Fills *out with the dry contact of a fitted body at rest.
void sb_film_rest_fitted(SbFilm *out, const SbFilmProblem *problem, const SbDryContact *dry);

// Returns the ambient pressure at X, between `inlet` and `outlet` as in the dry smooth contact
// (docs/verification.md).
double sb_film_ends(double X, double inlet, double outlet);

// Returns the scaled dry pressure at X in the flow frame: Hertz's plus the end pressures, without
// the tilt that they cause, so that the contact is |X| < 1.
double sb_film_dry_pressure(double X, double inlet, double outlet);

// Zeroes *out and sets its profile buffer, scales, Moes' numbers, regime and valid = true.
void sb_film_begin(SbFilm *out, const SbFilmProblem *problem, const SbFilmScale *scale);

// Fluid of the film, scaled: viscosity under pressure and shear.
//
//   eta = eta_0 exp(alpha p)                                        Barus, p gauge
//   gamma' = (tau_0/eta) sinh(tau/tau_0)                            Eyring
//
// Where sliding dominates the shear, with Sigma = eta u/(tau_0 h), the shear stress is tau_0
// asinh(Sigma) and the pressure flow -(h^3/12 eta) sqrt(1 + Sigma^2) dp/dx (Ehret, Dowson and
// Taylor, Proc. R. Soc. A 454 (1998) 763). Not modelled: temperature, compressibility, shear by the
// pressure flow. All zero except `rupture`: isoviscous.
typedef struct {
  double rupture; // rupture pressure divided by p_H; pressures of the solvers are relative to it
  double barus;   // alpha p_H
  double eyring;  // eta |speed|/(tau_0 b^2/R): Sigma at unit film; 0: off
} SbFilmFluid;

// Returns the fluid of `problem` for pressures in units of `pressure` [Pa] and films in units of
// `film` [m].
SbFilmFluid sb_film_fluid(const SbFilmProblem *problem, double pressure, double film);

// Writes the mobility factor m of the pressure flow h^3 m p'/lambda, and its derivatives with
// respect to film and pressure; 1, 0, 0 for an isoviscous fluid.
void sb_film_mobility(double *m, double *m_film, double *m_pressure, const SbFilmFluid *fluid,
                      double film, double pressure);

// Returns the mean shear stress of sliding divided by eta_0 speed; 1/film for an isoviscous fluid.
double sb_film_shear(const SbFilmFluid *fluid, double film, double pressure);

// Solves a power law, the asymptotic or the Moes model in the flow frame. *out must have been
// prepared by sb_film_begin().
SbStatus sb_film_solve_law(SbFilm *out, const SbFilmProblem *problem, const SbFilmScale *scale,
                           SbReport *report);

// Solves Blok's inverse film of problem->dry_pressure in the flow frame, likewise. SB_ERROR_INPUT:
// the table has fewer than 9 points or is not increasing. SB_ERROR_INFEASIBLE: the dry pressure
// never rises, or is not smooth.
SbStatus sb_film_solve_inverse(SbFilm *out, const SbFilmProblem *problem, const SbFilmScale *scale,
                               SbReport *report);

// Solves the rigid wedge (wedge.h) in the flow frame, likewise. SB_ERROR_INFEASIBLE: the outlet
// pressure drives the film back.
SbStatus sb_film_solve_rigid(SbFilm *out, const SbFilmProblem *problem, const SbFilmScale *scale,
                             SbReport *report);

// Fills *out with the dry contact of the half-plane at zero speed, with a warning. Does not fail.
SbStatus sb_film_solve_dry(SbFilm *out, const SbFilmScale *scale, SbReport *report);

// Sets point n of the profile, without asperities, if the problem provides a buffer.
static inline void sb_film_put(SbFilm *out, size_t n, double x, double pressure, double film) {
  if (out->x != NULL) {
    out->x[n] = x;
    out->pressure[n] = pressure;
    out->film[n] = film;
    out->asperity_pressure[n] = 0.0;
    out->points = n + 1 > out->points ? n + 1 : out->points;
  }
}
