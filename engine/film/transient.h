// Transient film: start, stop and reversal of a sliding seal with a prescribed speed history.
//
//   dm/dt + d/dx (u m/2 - h^3/(12 eta) dp/dx) = 0,   int (p - ambient) dx = W = film.load
//
// with the gap h of film.h (half-plane and parabola, or the compliance of a fitted body). A
// positive speed u moves the wall to +x, from left to right. m = h where the film is full and p >
// rupture pressure; m < h and p = rupture pressure in a cavity. Mass is conserved (Jakobsson,
// Floberg and Olsson; Elrod, J. Lubrication Technology 103, 1981). The fluid in a cavity moves at
// u/2, as in the full film. Liquid surrounds the contact beyond the ends of the mesh. After a
// reversal, a thin layer that has left the contact returns as a starved inlet.
//
// An end of the mesh may be starved: gas is there, at whose pressure the film cavitates, and the
// wall transports a layer l at its full speed, so m = 2 l.
//
// Space: finite volumes of second order, refined at both edges of the contact; the elastic kernel
// is exact for parabolic pressures. Time: BDF2 with error control; Newton's method with the cavity
// as an active set. Between the edge layers the cells move with the fluid at u/2, so transported
// films keep their shape; with `resolve` the nodes follow them. A companion with twice the spacing
// and time step estimates the errors. The error of the minimum film is the largest difference of
// both since the fluid now in the contact entered it, plus the mesh error in steady sliding; that
// of the central film has half of the difference. If a film leaves the contact of the companion at
// another time, that estimate is large for an instant; error_history separates errors of film from
// errors of time.
//
// Asperities and adhesion are those of film.h: q = p + p_a(h) - p_v(h) deforms the body and carries
// the load, also in a cavity. Refused: adhesion that closes gaps at rest (film-snap-in), models
// other than reynolds, and the options pressure_viscosity, eyring_stress and inlet_film of
// SbFilmProblem. Range: M >= 1 of the smooth film; the body has one contact, not two.
#pragma once

#include "engine/film/film.h"

// A problem. Initialise `film` with sb_film_problem_init(). Set film.load, radius, modulus,
// viscosity, speed (at the start), tolerance (of the film history), and other fields as needed;
// model, place and profile stay as initialised.
typedef struct {
  SbFilmProblem film;
  double speed_scale; // largest |speed| that will occur [m/s] > 0; determines the mesh
  // Start at rest: film.speed is 0 and rest_film > 0 is the initial gap [m], or the gap at which
  // asperities carry the load if that is larger. Start in motion: film.speed is not 0, rest_film is
  // 0, and the initial state is the steady film.
  double rest_film;
  double least_film; // thinnest film that will come to rest [m]; determines the mesh; 0: rest_film
  // Layer on the wall that comes from the left and from the right [m]; 0: flooded. The pressure at
  // a starved end must not exceed that at the other one.
  double inlet_film[2];
  bool resolve; // resolve the narrow dip that a reversal transports; false: the mean film only
} SbFilmTransientProblem;

// Film at the present time, with error estimates; counters and checks since the start.
typedef struct {
  double film_min;     // minimum film [m]
  double film_central; // at x = 0, or in the middle of a fitted body's contact [m]
  double half_width;   // of the dry contact [m]
  // Friction on the wall as in SbFilm, positive if it resists motion to +x; the sum is the total
  // [N/m].
  double friction_couette, friction_poiseuille, friction_cavity, friction_boundary;
  // Integral of the asperity pressure [N/m]; asperity_load divided by the load of film and
  // asperities [1]; integral over x of the fraction of real contact area [m].
  double asperity_load, asperity_share, real_area;
  double error_film_min, error_film_central; // relative estimates; NAN: the companion failed
  // Relative error of the history of the minimum film: film and passage through the contact are
  // both within it of the true ones (Levy's metric); NAN: the companion failed.
  double error_history;
  double error_time; // relative estimate, due to time steps
  double error_mesh; // relative, compared with the steady spectral solution at speed_scale
  size_t steps;      // accepted time steps
  size_t newton_iterations;
  double load_error; // largest |integral of p - W|/W of a step
  double mass_error; // largest violation of the mass balance of a step, divided by the flow scale
} SbFilmTransientResult;

// A transient film with its history.
typedef struct SbFilmTransient SbFilmTransient;

// Creates a film in its initial state; takes about 0.1 s. What problem->film borrows, and the data
// of its callback, must stay valid until sb_film_transient_destroy(). Its profile is not used.
// SB_ERROR_RANGE: a value is out of range, or M < 1. SB_ERROR_INPUT: an option that is refused,
// options that exclude each other, or an invalid body. SB_ERROR_INFEASIBLE: adhesion closes gaps at
// rest, or the steady film at speed_scale or at the start does not exist (sb_film_solve()).
// SB_ERROR_NOT_CONVERGED: no initial film was found. SB_ERROR_CANCELLED.
SbStatus sb_film_transient_create(SbFilmTransient **out, const SbFilmTransientProblem *problem,
                                  SbReport *report);

// Frees the film.
void sb_film_transient_destroy(SbFilmTransient *transient);

// Advances by `dt` [s] > 0 while the speed changes linearly from its present value to `speed`
// [m/s], |speed| <= speed_scale, in as many steps as the tolerance needs. SB_ERROR_RANGE: `dt` or
// `speed` is out of range; nothing is done. SB_ERROR_NOT_CONVERGED, SB_ERROR_CANCELLED: the state
// is at the last completed step.
SbStatus sb_film_transient_step(SbFilmTransient *transient, double dt, double speed,
                                SbReport *report);

// Returns the film at the present time.
SbFilmTransientResult sb_film_transient_result(const SbFilmTransient *transient);
