// Lubricant film of a sealing contact: one problem, one result, one function for all film models.
//
// A seal slides over a wall with a fluid between them. Per unit length it is a line contact of an
// elastic half-plane (reduced modulus E', 2/E' = sum (1 - nu^2)/E) with a cylinder of radius R. The
// fluid is isoviscous and incompressible unless an option states otherwise. Each model computes
// film, pressure, friction of the film, and its range of validity:
//
//   reynolds       coupled elastohydrodynamic solution, every speed (ehl.c)
//   inverse        Blok's film of a given smooth dry pressure (inverse.c)
//   karaszkiewicz  H* = 4.4 U^0.65 W^-0.21, thesis eq. 7.6 (= 5.5)
//   thesis         H* = 1.492 U^0.5434 W^-0.2893, thesis eq. 7.5
//   rigid          analytical wedge between rigid surfaces, thesis section 6.1 (wedge.c)
//   asymptotic     exact thin-film limit, h_min = 3.00434 R U^0.6 W^-0.2, h_flux = 3.77334 ...
//   moes           interpolation between the rigid and the elastic limit, fitted to our solutions
//
// with U = eta (u/2)/(E' R) and W = load/(E' R); u is the sliding speed, u/2 the entrainment speed.
//
// x is in the seal's frame, with its origin at the cylinder's axis. A speed > 0 moves the wall to
// +x, so the inlet is on the left. Loads, flows and friction forces are per metre of circumference.
#pragma once

#include "engine/base/status.h"
#include "engine/contact/compliance.h"
#include "engine/contact/rough/rough_law.h"

#include <stdbool.h>
#include <stddef.h>

// Film model; the order is that of the choices of models.film (params.def).
typedef enum {
  SB_FILM_THESIS, // power laws and closed forms as above
  SB_FILM_KARASZKIEWICZ,
  SB_FILM_ASYMPTOTIC,
  SB_FILM_REYNOLDS, // the coupled solver
  SB_FILM_INVERSE,  // needs dry_x, dry_pressure
  SB_FILM_MOES,
  SB_FILM_RIGID,
  SB_FILM_MODEL_COUNT
} SbFilmModel;

// Capacity of a profile, in points.
enum { SB_FILM_POINTS = 7800 };

// Memory for a profile, 250 kB, provided by the caller.
typedef struct {
  double x[SB_FILM_POINTS];                 // [m]
  double pressure[SB_FILM_POINTS];          // total pressure [Pa]
  double film[SB_FILM_POINTS];              // gap [m]
  double asperity_pressure[SB_FILM_POINTS]; // part of `pressure` carried by asperities [Pa]
} SbFilmProfile;

// Ratio film_min/radius above which the parabola deviates from the cylinder by more than about 5 %
// of the film; warning "film-thick".
#define SB_FILM_THICK 0.1

// Relation of a problem to the base: the last problem that the same solver solved with
// SB_FILM_ALONE. NEAR and BESIDE use mesh and error estimate of the base. They fail with
// SB_ERROR_NOT_CONVERGED if there is no base or the problems differ too much.
typedef enum {
  SB_FILM_ALONE, // independent: own mesh and error estimate
  SB_FILM_NEAR,  // the solution of the base is the initial guess
  SB_FILM_BESIDE // as NEAR, and the factorised Jacobian of the base is reused; for perturbations of
                 // the base by finite differences
} SbFilmPlace;

// A problem. Initialise with sb_film_problem_init(), then set load, speed, radius, modulus and
// viscosity, and other fields as needed. The ranges are those of sb_film_ranges().
typedef struct {
  SbFilmModel model; // initially SB_FILM_REYNOLDS
  // Integral of p - ambient [N/m], > 0; ambient is the left pressure for x < 0, else the right one.
  double load;
  double speed;          // of the wall, signed [m/s]; 0: dry contact
  double radius;         // R [m] > 0
  double modulus;        // reduced modulus E' [Pa] > 0
  double viscosity;      // eta [Pa s] > 0
  double pressure_left;  // pressure of the fluid on the left of the contact, gauge [Pa]
  double pressure_right; // pressure of the fluid on the right of the contact, gauge [Pa]
  double tolerance;      // relative error of the films, 1e-8 to 0.1; initially 1e-3

  // Options of the model reynolds; the other models ignore them.
  double pressure_viscosity; // Barus' alpha [1/Pa]: eta exp(alpha p), p gauge; 0: constant eta
  double eyring_stress;      // Eyring's stress of shear thinning [Pa]; 0: no shear thinning
  double inlet_film;         // thickness of the layer on the incoming wall [m]; 0: flooded inlet
  // Gauge pressure at which the film cavitates [Pa]: 0 is ambient, a vapour pressure may be
  // negative. The film can always cavitate; to prevent it, set a low value such as -1e6.
  double rupture_pressure;

  // Roughness in the model reynolds: asperities carry a part of the load. The pressures of result
  // and profile are then the sum of film and asperities minus attraction, the film is the mean gap.
  SbRoughModel surface;   // roughness model (rough_law.h); SB_ROUGH_NONE: smooth
  double gt_product;      // zeta beta sigma [1], > 0 if rough
  double sigma;           // combined standard deviation of heights [m], > 0 if rough
  double sigma_over_beta; // sigma divided by the tip radius of the asperities [1], > 0 if rough
  // Real contact area at which the last channel closes, 0 to 1, only with SB_ROUGH_PERSSON; 0: the
  // roughness does not obstruct the flow.
  double percolation_threshold;
  // s, distribution of the roughness: (variance of the wall - that of the seal)/(their sum), -1
  // to 1. The wall drags the flow u/2 (h + s (1 - phi_p) h) along. Only with percolation_threshold
  // > 0.
  double roughness_split;
  double hamaker; // A_H of the van der Waals attraction across the gap [J]; 0: off
  // Work of adhesion of asperity tips [J/m2]; 0: off. Only with SB_ROUGH_GREENWOOD_TRIPP and
  // `hamaker` 0.
  double work_of_adhesion;
  double shear_strength;   // tau_s, shear strength of the real contact area [Pa]
  double load_coefficient; // friction coefficient m of the asperity load [1]
  // Tables of a rough law that are reused if its surface is the same (sb_rough_law_like());
  // borrowed during the call. NULL: computed.
  const SbRoughLaw *law;

  // Compliance and shape of a fitted body, which replaces half-plane and parabola in the model
  // reynolds and in its dry contact; borrowed during the call. NULL: half-plane and parabola.
  // `modulus` must equal that of the body; `radius` then only determines the regime.
  const SbSurfaceCompliance *compliance;

  // Dry pressure of the model inverse, the other models ignore it; borrowed during the call. Its
  // slope determines the film; it must be smooth, without square-root edges. The fields
  // pressure_left and pressure_right are not added. A warning is given if the integral of
  // dry_pressure differs from `load` by more than 1 %.
  const double *dry_x;        // [dry_count] x in the frame of this header [m], increasing
  const double *dry_pressure; // [dry_count] contact pressure at dry_x, gauge [Pa]
  size_t dry_count;           // at least 9

  // Model reynolds: SB_FILM_ALONE (initially), or another value if the solver passed to
  // sb_film_solve() has solved a similar problem before.
  SbFilmPlace place;

  SbFilmProfile *profile; // memory for the profile, borrowed by the result; NULL: no profile
  size_t profile_points;  // approximate number of points (model reynolds); 0: as accuracy requires

  // Called with cancelled_data between Newton steps (model reynolds); true stops the solve with
  // SB_ERROR_CANCELLED. NULL: never stopped.
  bool (*cancelled)(void *data);
  void *cancelled_data;
} SbFilmProblem;

// How a result was found. Errors are relative. 0 where a model does not set a field.
typedef struct {
  bool converged;
  size_t unknowns;           // number of unknowns of the last solve
  int newton_iterations;     // sum over all continuation steps
  int continuation_steps;    // number of solves by Newton's method: continuation, then refinement
  double residual;           // residual of the last Newton step, scaled, maximum norm
  double error_film_min;     // estimated error of film_min: discretisation and iteration
  double error_film_central; // estimated error of film_central
  double error_film_flux;    // estimated error of film_flux
  double error_contact;      // estimated error of real area and asperity load; 0 if smooth
  double load_error;         // |integral of p - load|/load
  // Largest |flow(x) - flow| in the full film, divided by the larger one of flow and gap times
  // speed/2; with asperities or adhesion the largest error of the film pressure between two nodes,
  // divided by p_H.
  double flux_error;
  double wall_s; // elapsed time of the solve [s]
} SbFilmSolverInfo;

// Result. Owns nothing: the profile is in the buffer of the problem, so a copy is valid until that
// buffer is freed or used by another solve. At speed 0 the film thicknesses of smooth surfaces are
// 0.
typedef struct {
  SbFilmModel model;
  double film_min;          // minimum film [m]
  double film_central;      // film at x = 0, or in the middle of a fitted body's contact [m]
  double film_flux;         // flow-rate film thickness: flow/(speed/2) [m]
  double flow;              // volume flow per circumference, signed as the speed [m2/s]
  double pressure_max;      // maximum of the total pressure, gauge [Pa]
  double position_film_min; // x of the minimum film [m]
  double position_rupture;  // x at which the film cavitates [m]; edge of the contact if it does not
  bool ruptured;            // the film cavitates
  bool starved;             // less fluid is supplied than a flooded contact transports
  double hertz_half_width;  // b = R sqrt(8 W/pi) [m]
  double hertz_pressure;    // p_H = 2 load/(pi b) [Pa]
  // Friction on the wall, positive if it resists motion to +x. The total is the sum of the four.
  double friction_couette;    // integral of eta speed/h over the full film [N/m]
  double friction_poiseuille; // integral of (h/2) dp/dx over the full film [N/m]
  double friction_cavity;     // shear of the cavitated film, see ehl.c [N/m]
  double friction_boundary;   // tau_s real_area + m asperity_load [N/m]
  double asperity_load;       // integral of the asperity pressure [N/m]
  double asperity_share;      // asperity_load divided by the load of film and asperities [1]
  double real_area;           // integral over x of the fraction of real contact area [m]
  double real_area_share;     // fraction of real contact area at x = 0
  double film_ratio;          // film_central/sigma; NAN if smooth
  double moes_M;              // W/sqrt(2 U)
  double moes_U;              // U = eta |speed|/(2 E' R)
  double moes_W;              // W = load/(E' R)
  double lambda;              // 3 pi^2 U/(4 W^2) = (3 pi^2/8)/M^2
  double expected_error; // expected relative error of the model in film_flux; 0: no model error
  char regime[48]; // "dry", "isoviscous-rigid", "transition", "isoviscous-elastic", "boundary"
  bool valid;      // false: outside the range of the model, see `warnings`
  SbWarnings warnings;
  SbFilmSolverInfo solver;

  // Profile; NULL and 0 points without a buffer. x increases, with small steps in the inlet and
  // outlet layers; at least 400 points unless fewer were requested. Central differences of a
  // profile of the coupled solver reproduce the flow to 1e-4.
  size_t points;
  double *x;                 // [points] [m]
  double *pressure;          // [points] total pressure [Pa]
  double *film;              // [points] gap between the surfaces [m]
  double *asperity_pressure; // [points] part of `pressure` carried by asperities [Pa]
} SbFilm;

// Work memory of the model reynolds (20 MB reserved), and its last solution, from which later
// solves start. Use one for each thread and each seal.
typedef struct SbFilmSolver SbFilmSolver;

// Creates a solver.
SbStatus sb_film_solver_create(SbFilmSolver **out, SbReport *report);

// Frees the solver.
void sb_film_solver_destroy(SbFilmSolver *solver);

// Discards the last solution, so that the next solve is a cold start. The memory is reused.
void sb_film_solver_forget(SbFilmSolver *solver);

// Numbers of the inputs of a film, for SbReport.input and SbWarning.input.
enum {
  SB_FILM_IN_SPEED = SB_FILM_INPUTS,
  SB_FILM_IN_RADIUS,
  SB_FILM_IN_MODULUS,
  SB_FILM_IN_VISCOSITY,
  SB_FILM_IN_PRESSURE,
  SB_FILM_IN_PRESSURE_VISCOSITY,
  SB_FILM_IN_EYRING_STRESS,
  SB_FILM_IN_RUPTURE_PRESSURE,
  SB_FILM_IN_ASPERITY_PRODUCT,
  SB_FILM_IN_SIGMA,
  SB_FILM_IN_SIGMA_OVER_BETA,
  SB_FILM_IN_HAMAKER,
  SB_FILM_IN_WORK_OF_ADHESION,
  SB_FILM_IN_SHEAR_STRENGTH,
  SB_FILM_IN_LOAD_COEFFICIENT,
  SB_FILM_IN_INLET,
  SB_FILM_IN_MODEL,
  SB_FILM_IN_END
};

// Allowed range of one number of SbFilmProblem.
typedef struct {
  const char *name; // "reduced modulus"
  int input;        // number for reports, 0 if none
  const char *unit; // SI, "" if none
  size_t offset;    // of the double in SbFilmProblem
  double min, max;  // inclusive
} SbFilmRange;

// Returns the allowed ranges, an array of *count; static.
const SbFilmRange *sb_film_ranges(size_t *count);

// Sets the model reynolds, tolerance 1e-3, and 0 or NULL for all other fields: options off, ambient
// pressure on both sides, cavitation at ambient pressure, sizes still to be set.
void sb_film_problem_init(SbFilmProblem *problem);

// Solves `problem` with its model. `memory` is used by the model reynolds; NULL: allocated for the
// call. Warnings are in out->warnings. Errors:
// SB_ERROR_RANGE: a field is outside sb_film_ranges() or not positive where it must be, or the film
// is so thin that it is lost in rounding. SB_ERROR_INPUT: options that exclude each other, a rough
// surface with a model other than reynolds, or an invalid table or body. SB_ERROR_INFEASIBLE: the
// pressures open the contact, the inlet is below the rupture pressure, or starved while the outlet
// cavitates and re-forms, the fitted body has no single contact, or no surface has this gt_product.
// After these errors films and pressures are 0.
// SB_ERROR_NOT_CONVERGED: *out is the best state found (films 0 if there is none).
// SB_ERROR_CANCELLED, SB_ERROR_MEMORY: *out must not be used.
SbStatus sb_film_solve(SbFilm *out, const SbFilmProblem *problem, SbFilmSolver *memory,
                       SbReport *report);

// Returns the gap of the dry Hertz line contact at the distance X b from its middle, divided by
// b^2/R; 0 for |X| <= 1 (Johnson, Contact Mechanics, section 4.2).
double sb_film_dry_gap(double X);

// What a model computes.
typedef struct {
  const char *name; // of the choice of models.film: "thesis"
  const char *help; // one line
  bool coupled;     // solves film, pressure and deformation together
  bool power_law;   // a power law that was fitted to solutions
  bool from_dry;    // computes the film from a dry pressure, which the problem must have
} SbFilmKind;

// Returns what a model computes; static. NULL for an invalid one.
const SbFilmKind *sb_film_kind(SbFilmModel model);

// Finds the model with this name, such as "reynolds". Returns false if there is none or `name` is
// NULL; *out is unchanged then.
SB_CHECKED bool sb_film_model_from_name(SbFilmModel *out, const char *name);
