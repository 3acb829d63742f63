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
  // Pressures at inlet and outlet divided by p_H: above the rupture pressure in the model reynolds,
  // else above ambient. At rest, smooth surfaces count from ambient, rough ones from the lower one
  // of ambient and rupture pressure.
  double inlet;
  double outlet;
  double kappa; // slope factor of the dry pressure at the inlet edge, 1 - (inlet - outlet)/pi
  double kappa_outlet; // slope factor at the outlet edge, 1 + (inlet - outlet)/pi
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

// Solves the dry contact of problem->compliance (not NULL) into *dry and converts *scale, the
// result of sb_film_scale(), to this contact: b is half of its width, p_H = 2 w/(pi b), film =
// 4 p_H b/E'; all fields except U, W and M change. SB_ERROR_INPUT: the moduli of problem and body
// differ, or the gap of the body is not convex. SB_ERROR_INFEASIBLE: the contact leaves the body's
// window, needs tension or has two parts. SB_ERROR_NOT_CONVERGED.
SbStatus sb_film_scale_fitted(SbFilmScale *scale, SbDryContact *dry, const SbFilmProblem *problem,
                              SbReport *report);

// Adds to out[modes] the moments int p T_k dX (compliance.h, modes = body->compliance->modes) of
// the ambient pressures outside a mesh from `begin` to `end` (X, from the axis), minus the moments
// of the lower ambient pressure over the full window. Adds their derivatives with respect to the
// axis position to slope[modes]. `inlet` and `outlet` are SbFilmScale.inlet and outlet. Requires a
// fitted body, not a half-plane.
void sb_film_ambient(double *out, double *slope, const SbFilmBody *body, double inlet,
                     double outlet, double begin, double end);

// Returns the correction of the slope dH/dX of the gap: with it, unequal ambient pressures leave
// the surface flat over the window of the body (compliance.h) instead of over |X| < 1. Add the
// slope times X to the gap. `inlet` and `outlet` are SbFilmScale.inlet and outlet. Requires a
// fitted body, not a half-plane.
double sb_film_window_tilt(const SbFilmBody *body, double inlet, double outlet);

// Fills *out with the dry contact of a fitted body at rest. *out must have been prepared by
// sb_film_begin(), *dry by sb_film_scale_fitted().
void sb_film_rest_fitted(SbFilm *out, const SbFilmProblem *problem, const SbDryContact *dry);

// Returns the ambient pressure at X: `inlet` for X <= -1, `outlet` for X >= 1, and in between inlet
// (1/2 - asin(X)/pi) + outlet (1/2 + asin(X)/pi), as in the dry smooth contact.
double sb_film_ends(double X, double inlet, double outlet);

// Returns the scaled dry pressure at X in the flow frame: Hertz's, sqrt(1 - X^2), plus
// sb_film_ends(). The contact is |X| < 1; the tilt that unequal end pressures cause is left out.
double sb_film_dry_pressure(double X, double inlet, double outlet);

// Zeroes *out and sets its profile buffer, scales, Moes' numbers, regime and valid = true.
void sb_film_begin(SbFilm *out, const SbFilmProblem *problem, const SbFilmScale *scale);

// Fluid of the film, scaled: viscosity under pressure and shear, with Eyring's stress tau_E.
//
//   eta = eta_0 exp(alpha p)                                        Barus, p gauge
//   gamma' = (tau_E/eta) sinh(tau/tau_E)                            Eyring
//
// Where sliding dominates the shear, with Sigma = eta u/(tau_E h), the shear stress is tau_E
// asinh(Sigma) and the pressure flow -(h^3/12 eta) sqrt(1 + Sigma^2) dp/dx (Ehret, Dowson and
// Taylor, Proc. R. Soc. A 454 (1998) 763). Not modelled: temperature, compressibility, shear by the
// pressure flow. All zero except `rupture`: isoviscous.
typedef struct {
  double rupture; // rupture pressure divided by p_H; `pressure` below is relative to it
  double barus;   // alpha p_H
  double eyring;  // eta_0 |speed|/(tau_E b^2/R): Sigma at film 1; 0: no shear thinning
} SbFilmFluid;

// Returns the fluid of `problem` for pressures in units of `pressure` [Pa] (p_H) and films in units
// of `film` [m] (b^2/R).
SbFilmFluid sb_film_fluid(const SbFilmProblem *problem, double pressure, double film);

// Writes the mobility factor m of the pressure flow h^3 m p'/lambda, and its derivatives with
// respect to film and pressure; 1, 0, 0 for an isoviscous fluid.
void sb_film_mobility(double *m, double *m_film, double *m_pressure, const SbFilmFluid *fluid,
                      double film, double pressure);

// Returns the scaled shear stress of sliding, tau b^2/(R eta_0 |speed|), at the scaled film and
// pressure; 1/film for an isoviscous fluid.
double sb_film_shear(const SbFilmFluid *fluid, double film, double pressure);

// Solves a power law, the asymptotic or the Moes model in the flow frame, at a speed other than 0.
// *out must have been prepared by sb_film_begin(). Does not fail.
SbStatus sb_film_solve_law(SbFilm *out, const SbFilmProblem *problem, const SbFilmScale *scale,
                           SbReport *report);

// Solves Blok's inverse film of problem->dry_pressure in the flow frame, after sb_film_begin(), at
// a speed other than 0. SB_ERROR_INPUT: the table has fewer than 9 points or is not increasing.
// SB_ERROR_INFEASIBLE: the dry pressure never rises, or is not smooth.
SbStatus sb_film_solve_inverse(SbFilm *out, const SbFilmProblem *problem, const SbFilmScale *scale,
                               SbReport *report);

// Solves the rigid wedge (wedge.h) in the flow frame, after sb_film_begin(), at a speed other than
// 0. SB_ERROR_INFEASIBLE: the outlet pressure drives the film back.
SbStatus sb_film_solve_rigid(SbFilm *out, const SbFilmProblem *problem, const SbFilmScale *scale,
                             SbReport *report);

// Fills *out with the dry contact of the half-plane at zero speed, with a warning, after
// sb_film_begin(). Does not fail.
SbStatus sb_film_solve_dry(SbFilm *out, const SbFilmScale *scale, SbReport *report);

// Sets point n of the profile (n from 0, each point once and in order of increasing x) with
// asperity pressure 0, in the units of SbFilm; does nothing if the problem provides no buffer.
static inline void sb_film_put(SbFilm *out, size_t n, double x, double pressure, double film) {
  if (out->x != NULL) {
    out->x[n] = x;
    out->pressure[n] = pressure;
    out->film[n] = film;
    out->asperity_pressure[n] = 0.0;
    out->points = n + 1 > out->points ? n + 1 : out->points;
  }
}
