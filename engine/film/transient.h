// Transient film: start, stop and reversal of a sliding seal with a given history of its speed.
//
//   dm/dt + d/dx (u m/2 - h^3/(12 eta) dp/dx) = 0,   int (p - ambient) dx = W
//
// with the gap h of film.h (half-plane and parabola, or a fitted body's compliance), m = h where
// the film is full and p > rupture pressure, m < h and p = rupture pressure in a cavity: mass is
// kept everywhere (Jakobsson, Floberg and Olsson; Elrod, J. Lubrication Technology 103, 1981). The
// fluid in a cavity moves at u/2, as in the full film. Liquid stands around the contact from the
// ends of the mesh on; what has left the contact as a thin layer comes back as a starved inlet
// after a reversal until the liquid has followed.
//
// An end of the mesh may be starved: gas stands there at its pressure, which the film then breaks
// at, and the wall brings a layer l. It moves with the wall, the fluid of the gap at u/2: m = 2 l.
//
// Space: finite volumes on a mesh refined at both edges of the contact, second order; pressure by
// parabolas, the elastic kernel exact for these. Time: BDF2 with steps chosen from its own
// error, Newton's method with the cavity's complementarity as an active set. Between the edges'
// layers the cells move with the fluid, at u/2: what the wall carries through the contact keeps its
// form whatever the step; nodes crowd about what the fluid carries and go along with it
// (`resolve`). A companion at twice the spacing and twice the step runs beside: the estimate of the
// least film is the largest difference between the two that the fluid still in the contact has
// seen, of the central one half of it, and the mesh's own error in steady sliding. A film that
// leaves the contact on the coarse mesh at another time makes that large for an instant: the
// history's error tells films from times.
//
// Asperities and adhesion are those of ehl.h: q = p + p_a(h) - p_v(h) deflects and bears the load,
// in a cavity too, and the fluid flows through the mean gap h. A pull that closes gaps at rest
// (film-snap-in) is refused. Range: isoviscous (Barus' and Eyring's options are refused), M >= 1 of
// the smooth film; the pressure must stay that of one contact.
#pragma once

#include "engine/film/film.h"

typedef struct {
  SbFilmProblem film;   // sizes, load and speed at the start; tolerance of the film history
  double speed_scale;   // greatest |speed| to come [m/s]: lays the mesh
  double rest_film;     // 0: start in the steady state of film.speed; else at rest, the contact
                        // parted by this film [m], or further by its asperities, and the
                        // surroundings full
  double least_film;    // thinnest film that comes to rest [m], for whose necks at the edges the
                        // mesh is made; 0: rest_film
  double inlet_film[2]; // layer [m] that the wall brings from the left and from the right; 0 floods
                        // that end. A starved end is no higher in pressure than the other one
  bool resolve;         // spacing and steps for the narrow dip that a reversal carries through the
                        // contact; else for the mean film
} SbFilmTransientProblem;

// The present film with its error estimates; counters and checks since the start.
typedef struct {
  double film_min;     // [m]
  double film_central; // at x = 0, or in the middle of a fitted body's contact [m]
  double half_width;   // of the dry contact [m]
  double friction_couette, friction_poiseuille, friction_cavity, friction_boundary; // as in SbFilm
  double asperity_load, asperity_share, real_area;                                  // the same
  double error_film_min, error_film_central; // relative; NaN: the companion failed
  // Of the whole history of the least film: it is within so much of its passage through the contact
  // as near to the true one, relative (Levy's metric); NaN as above.
  double error_history;
  double error_time; // estimate, relative, of the film in the contact by the time steps
  double error_mesh; // the same by the mesh: against the spectral steady film at speed_scale
  size_t steps;      // accepted
  size_t newton_iterations;
  double load_error; // largest |integral of p - W| / W of any step
  double mass_error; // largest |d/dt content + outflow| of any step over the flow scale
} SbFilmTransientResult;

typedef struct SbFilmTransient SbFilmTransient;

// A solver in its initial state in *out, owned by the caller. SB_ERROR_RANGE / SB_ERROR_INPUT for
// what film.h refuses and for options that the transient film does not know;
// SB_ERROR_NOT_CONVERGED if there is no initial film. About 0.1 s.
SbStatus sb_film_transient_create(SbFilmTransient **out, const SbFilmTransientProblem *problem,
                                  SbReport *report);

// Takes NULL.
void sb_film_transient_destroy(SbFilmTransient *transient);

// Advances by `dt` > 0 [s], the speed going evenly from its present value to the given one, in as
// many steps as the tolerance needs. SB_ERROR_NOT_CONVERGED: the state stands at the last good
// time. SB_ERROR_RANGE: nothing done. SB_ERROR_CANCELLED by the problem's callback.
SbStatus sb_film_transient_step(SbFilmTransient *transient, double dt, double speed,
                                SbReport *report);

SbFilmTransientResult sb_film_transient_result(const SbFilmTransient *transient);
