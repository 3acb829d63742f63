// Scales, fluid and dry contact shared by the film models (private to engine/film).
#pragma once

#include "engine/film/film.h"

// Scales of a line contact. The scaled problem has X = x / b, P = p / p_H, H = h R / b^2 and only
// one parameter, lambda = 3 pi^2 U / (4 W^2), when nothing but Reynolds and elasticity acts.
typedef struct {
  double half_width; // b [m]
  double pressure;   // p_H [Pa]
  double film;       // b^2 / R [m]
  double U;          // eta |speed| / (2 E' R)
  double W;          // load / (E' R)
  double M;          // W / sqrt(2 U); infinite is replaced by 0 at zero speed
  double lambda;     // 3 pi^2 U / (4 W^2)
  double inlet;      // scaled gauge pressure at the inlet
  double outlet;     // scaled gauge pressure at the outlet
  double kappa; // slope factor of the dry pressure at the inlet edge, 1 - (inlet - outlet) / pi
  double kappa_outlet; // and at the outlet edge, 1 + (inlet - outlet) / pi
  // A fitted body's contact: its middle over b in the flow frame, and the rest of its dry pressure
  // over Hertz's, p_dry = ends + sqrt(1 - X^2) (1 + sum bow[k] U_k(X)). All zero on a half-plane.
  double middle;
  double bow[SB_COMPLIANCE_PRESSURES];
} SbFilmScale;

// A fitted body in place of the half-plane, in SI with the scales that make it one.
typedef struct {
  const SbSurfaceCompliance *compliance; // NULL: none
  double side;                           // seal's x over the flow frame's, 1 or -1
  double half_width, film;               // scales b and of the film
} SbFilmBody;

// Whether `problem` has asperities or adhesion.
bool sb_film_rough(const SbFilmProblem *problem);

// Scales of `problem`, which must have been checked.
SbFilmScale sb_film_scale(const SbFilmProblem *problem);

// Solves the dry contact of `problem->compliance` and gives the scales its half-width, middle and
// edge slopes: b is half its width, p_H = 2 w/(pi b), film 4 p_H b/E'. SB_ERROR_INPUT if the moduli
// differ, and what sb_dry_contact returns.
SbStatus sb_film_scale_fitted(SbFilmScale *scale, SbDryContact *dry, const SbFilmProblem *problem,
                              SbReport *report);

// Moments of the ambient pressures up to the ends of a mesh, `begin` and `end` from the axis, less
// the lower one everywhere, added to `out`; to `slope` their derivatives to the axis.
void sb_film_ambient(double *out, double *slope, const SbFilmBody *body, double inlet,
                     double outlet, double begin, double end);

// The tilt of unequal ambient pressures belongs to the window, a mesh gives it to |X| < 1: what is
// to be added to the gap, over X.
double sb_film_window_tilt(const SbFilmBody *body, double inlet, double outlet);

// Dry contact at rest of a fitted body.
void sb_film_rest_fitted(SbFilm *out, const SbFilmProblem *problem, const SbDryContact *dry);

// End pressures joined as in the dry smooth contact (docs/verification.md), at X.
double sb_film_ends(double X, double inlet, double outlet);

// Scaled dry pressure in the flow frame (inlet at X = -1), with end pressures: Hertz's plus the
// transition of the end pressures with the tilt removed so that the contact stays |X| < 1.
double sb_film_dry_pressure(double X, double inlet, double outlet);

// Fills the scales, numbers of Moes and the sign-dependent parts common to every model.
void sb_film_begin(SbFilm *out, const SbFilmProblem *problem, const SbFilmScale *scale);

// The film's fluid, scaled: viscosity under pressure and shear.
//
//   eta = eta_0 exp(alpha p)                                        Barus, p gauge
//   gamma' = (tau_0 / eta) sinh(tau / tau_0)                        Eyring
//
// Where the sliding dominates the shear, with Sigma = eta u / (tau_0 h), the stress is tau_0
// asinh(Sigma) and the pressure flow -(h^3 / 12 eta) sqrt(1 + Sigma^2) dp/dx (Ehret, Dowson and
// Taylor, Proc. R. Soc. A 454 (1998) 763). Left out: temperature, compressibility, and the share of
// the pressure flow in the shear. All zero but the rupture pressure: isoviscous.
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

// The closed-form models, Blok's inverse film and the rigid wedge (wedge.h), in the flow frame but
// for the flow; the dry contact at zero speed.
SbStatus sb_film_solve_law(SbFilm *out, const SbFilmProblem *problem, const SbFilmScale *scale,
                           SbReport *report);
SbStatus sb_film_solve_inverse(SbFilm *out, const SbFilmProblem *problem, const SbFilmScale *scale,
                               SbReport *report);
SbStatus sb_film_solve_rigid(SbFilm *out, const SbFilmProblem *problem, const SbFilmScale *scale,
                             SbReport *report);
SbStatus sb_film_solve_dry(SbFilm *out, const SbFilmScale *scale, SbReport *report);

// Point n of the profile, without asperities, where one is wanted.
static inline void sb_film_put(SbFilm *out, size_t n, double x, double pressure, double film) {
  if (out->x != NULL) {
    out->x[n] = x;
    out->pressure[n] = pressure;
    out->film[n] = film;
    out->asperity_pressure[n] = 0.0;
    out->points = n + 1 > out->points ? n + 1 : out->points;
  }
}
