// Film models of the sealing contact: one problem, one result, one call for all of them.
//
// A seal slides over a wall with a fluid between them. Per unit length it is a line contact: an
// elastic half-plane (reduced modulus E', 2/E' = sum (1 - nu^2)/E) with a cylinder of radius R,
// isoviscous and incompressible unless an option says otherwise. Every model gives the film, the
// pressure, the friction of the film and the range where it may be used:
//
//   reynolds       coupled elastohydrodynamic solution, every speed (ehl.c)
//   inverse        Blok's film of a given smooth dry pressure (inverse.c)
//   karaszkiewicz  H* = 4.4 U^0.65 W^-0.21, thesis eq. 7.6 (= 5.5)
//   thesis         H* = 1.492 U^0.5434 W^-0.2893, thesis eq. 7.5
//   rigid          analytical wedge between rigid surfaces, thesis section 6.1 (wedge.c)
//   asymptotic     exact thin-film limit, h_min = 3.00434 R U^0.6 W^-0.2, h_flux = 3.77334 ...
//   moes           blend of the rigid and the elastic limit, fitted to our own solutions
//
// with U = eta (u/2) / (E' R) and W = load / (E' R): u is the sliding speed, u/2 the entrainment.
//
// Axes: x in the seal's frame, 0 at the cylinder's axis; speed > 0 moves the wall to +x, so that
// the inlet is on the left. Pressures are gauge. SI units throughout, per metre of circumference.
#pragma once

#include "engine/base/status.h"
#include "engine/contact/compliance.h"
#include "engine/contact/rough/rough_law.h"

#include <stdbool.h>
#include <stddef.h>

// Those of models.film (params.def) first, in its order.
typedef enum {
  SB_FILM_THESIS,
  SB_FILM_KARASZKIEWICZ,
  SB_FILM_ASYMPTOTIC,
  SB_FILM_REYNOLDS,
  SB_FILM_INVERSE,
  SB_FILM_MOES,
  SB_FILM_RIGID,
  SB_FILM_MODEL_COUNT
} SbFilmModel;

enum { SB_FILM_POINTS = 7800 }; // capacity of a profile

// Room for a profile, the caller's; 250 kB.
typedef struct {
  double x[SB_FILM_POINTS];                 // [m]
  double pressure[SB_FILM_POINTS];          // gauge [Pa]
  double film[SB_FILM_POINTS];              // [m]
  double asperity_pressure[SB_FILM_POINTS]; // [Pa]
} SbFilmProfile;

// Least film over radius from which on the parabola misses the cylinder by more than some 5 % of
// the film; a warning says so.
#define SB_FILM_THICK 0.1

// Next to another problem a film is solved on that one's mesh, with its error;
// SB_ERROR_NOT_CONVERGED where that does not serve.
typedef enum {
  SB_FILM_ALONE,
  SB_FILM_NEAR,  // from its solution
  SB_FILM_BESIDE // so near that its factors serve as well
} SbFilmPlace;

// What to solve. Start from sb_film_problem_init(): every option off.
typedef struct {
  SbFilmModel model;
  double load;    // W [N/m] > 0: integral of (p - ambient), left ambient for x < 0, right for x > 0
  double speed;   // sliding speed [m/s], signed; 0 gives the dry contact
  double radius;  // R [m] > 0
  double modulus; // reduced modulus E' [Pa] > 0
  double viscosity;      // eta [Pa s] > 0
  double pressure_left;  // gauge [Pa] >= 0
  double pressure_right; // gauge [Pa] >= 0
  double tolerance;      // relative error wanted in the films, 1e-8 .. 0.1

  // Options of the reynolds model, zero when off.
  double pressure_viscosity; // Barus' alpha [1/Pa]: eta exp(alpha p), p gauge
  double eyring_stress;      // tau_0 [Pa] of Eyring's shear thinning
  double inlet_film;         // layer [m] that the moving wall brings; 0 floods the inlet
  double rupture_pressure;   // gauge [Pa] at which the film breaks, a vapour pressure for instance

  // Asperities inside the same solve (ehl.h), off by default: the surface model, its figures
  // and what friction takes. The film, the pressure and the profile are then those of the total.
  SbRoughModel surface;    // rough_law.h
  double gt_product;       // zeta beta sigma
  double sigma;            // combined standard deviation of heights [m]
  double sigma_over_beta;  // sigma over the asperities' tip radius
  double hamaker;          // A_H [J] of van der Waals' pull across the open gap; 0 = off. Where the
                           // pull closes the film: the film without it, "film-snap-in"
  double work_of_adhesion; // [J/m2] of asperities' tips that stick, greenwood-tripp only; 0 = off.
                           // In place of van der Waals' pull; closes the film as that does
  double shear_strength;   // tau_0 [Pa] of the real contact
  double load_coefficient; // m on the asperities' load
  // A law whose tables serve if the surface has its heights (sb_rough_law_like()), to save making
  // them; NULL: none. Borrowed during the call.
  const SbRoughLaw *law;

  // Surface of a fitted body in place of the half-plane and the parabola, for the reynolds model
  // and its dry contact; the others ignore it. NULL for none; borrowed during the call. Radius and
  // modulus then only name the regime.
  const SbSurfaceCompliance *compliance;

  // Dry pressure of the inverse model: `dry_count` pairs, x increasing; borrowed during the call.
  const double *dry_x;        // [m]
  const double *dry_pressure; // [Pa]
  size_t dry_count;

  // Where in relation to the solver's last problem that stood alone and converged.
  SbFilmPlace place;

  SbFilmProfile *profile; // lent to the result for its profile; NULL: none is made
  size_t profile_points; // of the coupled solver's profile, about; 0: as many as serve its accuracy

  // Polled between Newton steps; true stops the solve with SB_ERROR_CANCELLED. May be NULL.
  bool (*cancelled)(void *data);
  void *cancelled_data;
} SbFilmProblem;

// How the numbers were found.
typedef struct {
  bool converged;
  size_t unknowns;
  int newton_iterations;     // over all continuation steps
  int continuation_steps;    // solves by Newton's method: ways to the start, then levels of degree
  double residual;           // scaled, largest over all equations, at the end
  double error_film_min;     // relative, discretisation and iteration
  double error_film_central; // relative
  double error_film_flux;    // relative
  double error_contact;      // relative, of the real area and the asperities' load; 0 without
  double load_error;         // |integral of p - load| / load
  double flux_error;         // largest |flux(x) / flux - 1| over the full film
  double wall_s;             // time of the solve, cold or warm, without any output
} SbFilmSolverInfo;

// What came out. Plain data but for the profile, which stands in the buffer that the problem lent:
// a copy shares it and is good as long as the buffer is neither freed nor lent to another solve.
typedef struct {
  SbFilmModel model;
  double film_min;          // [m]
  double film_central;      // film at x = 0, or in the middle of a fitted body's contact [m]
  double film_flux;         // flow / (speed/2) [m]
  double flow;              // [m^2/s], signed as the speed
  double pressure_max;      // [Pa], gauge
  double position_film_min; // x [m]
  double position_rupture;  // x where the film breaks [m]; the end of the contact if it does not
  bool ruptured;            // the film breaks
  bool starved;             // less film is supplied than the contact would take
  double hertz_half_width;  // b = R sqrt(8 W / pi) [m]
  double hertz_pressure;    // p_H = 2 w / (pi b) [Pa]
  double
      friction_couette; // integral of eta speed / h over the full film [N/m], signed as the speed
  double friction_poiseuille; // integral of (h/2) dp/dx over the full film [N/m]
  double friction_cavity;     // of the cavitated film, see ehl.c [N/m]
  double friction_boundary;   // tau_0 real area + m asperity load [N/m], signed as the speed
  double asperity_load;       // integral of the asperities' pressure [N/m]
  double asperity_share;      // asperity_load divided by the load that film and asperities carry
  double real_area;           // integral of the real contact's share over x [m]
  double real_area_share;     // real contact over nominal at the axis
  double film_ratio;          // film_central / sigma; NAN without roughness
  double moes_M;              // W / sqrt(2 U)
  double moes_U;              // U = eta |speed| / (2 E' R)
  double moes_W;              // W = load / (E' R)
  double lambda;              // 3 pi^2 U / (4 W^2) = (3 pi^2 / 8) / M^2
  double expected_error;      // relative error of the model itself in the flux film, 0 = exact
  char regime[48]; // "dry", "isoviscous-rigid", "transition", "isoviscous-elastic", "boundary"
  bool valid;      // false: outside the model's range, see warnings
  SbWarnings warnings;
  SbFilmSolverInfo solver;

  // Profile, none and NULL unless the problem lends room for it: x increasing, dense in the inlet
  // and outlet layers; at least 400 points unless fewer were asked for. Central differences of the
  // coupled solver's give its flux to 1e-4 of the larger of film and flux film.
  size_t points;
  double *x;                 // [m]
  double *pressure;          // gauge [Pa]
  double *film;              // gap between the surfaces [m]
  double *asperity_pressure; // [Pa], a part of `pressure`; 0 without roughness
} SbFilm;

// Workspace of the film solver and its last solution: later solves start from it and allocate
// nothing. One per thread and per seal.
typedef struct SbFilmSolver SbFilmSolver;

// A new solver in *out (owned by the caller). SB_ERROR_MEMORY.
SbStatus sb_film_solver_create(SbFilmSolver **out, SbReport *report);

// Takes NULL.
void sb_film_solver_destroy(SbFilmSolver *solver);

// Forgets the last solution, so that the next solve is cold; keeps the memory.
void sb_film_solver_forget(SbFilmSolver *solver);

// What sb_film_solve() takes for one double of a problem, in SI.
typedef struct {
  const char *name; // "reduced modulus"
  const char *key;  // of the catalogue, "" if it has none
  const char *unit;
  size_t offset; // of the double in SbFilmProblem
  double min, max;
} SbFilmRange;

// All of them, *count.
const SbFilmRange *sb_film_ranges(size_t *count);

// Every option off, tolerance 1e-3, model reynolds, no pressures; sizes are zero and must be set.
void sb_film_problem_init(SbFilmProblem *problem);

// Solves `problem` with its model. `memory` may be NULL (then a workspace lives for the call only).
// SB_ERROR_RANGE / SB_ERROR_INPUT: nothing solved, *out is zero. SB_ERROR_NOT_CONVERGED: *out holds
// the best state found, solver.converged is false; if there is none, the films and pressures are 0.
//  SB_ERROR_CANCELLED, SB_ERROR_MEMORY.
SbStatus sb_film_solve(SbFilm *out, const SbFilmProblem *problem, SbFilmSolver *memory,
                       SbReport *report);

// Gap of the dry Hertz line contact at X half-widths from its middle, in units of b^2/R; 0 inside
// (Johnson, Contact Mechanics, section 4.2).
double sb_film_dry_gap(double X);

// Name on the command line; borrowed, never NULL.
const char *sb_film_model_name(SbFilmModel model);

// One line of help; borrowed, never NULL.
const char *sb_film_model_help(SbFilmModel model);

// The model of that name; false if there is none.
SB_CHECKED bool sb_film_model_from_name(SbFilmModel *out, const char *name);
