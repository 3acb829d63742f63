// Fit of a ring in its gland: contact width, load and pressure profile, by any of the contact
// models. One problem, one result and one function for all models.
//
// The ring (free section d, free inner diameter ID) is in a groove whose floor has the diameter D -
// 2 g, in a bore of diameter D. The fitted mean diameter is D - g. Definitions (docs/results.md):
//   squeeze (d - g)/d; stretch_mean ((D - g) - (ID + d))/(ID + d); stretch_inner (D - 2 g)/ID - 1;
//   section_diameter_fitted d (1 - nu stretch_mean); interference section_diameter_fitted - g;
//   gland_fill = free ring volume/gland volume = (pi/4) d^2 (ID + d)/(g (D - g) gland width).
// Of a gasket, squeeze is its crimp, stretch_inner that of its bore, and interference the stem's
// diameter minus the bore's; the other values are NaN.
// The load is the integral of the contact pressure (including the fluid's part) over the contact;
// load = load_per_length x circumference. The circumference is pi (ID + d) for the closed forms, pi
// (D - g) for the discs, pi D for the ring. Contact pressures are relative to the fluid of the
// lower pressure (variants of the disc with fluid on both flanks: to pressure 0, both fluids have
// |pressure|). Frictionless except for a dragged ring and the walls of a gasket. x is in the seal's
// frame.
// The functions may be called concurrently with different results, kept rings and callbacks.
#pragma once

#include "engine/base/status.h"
#include "engine/contact/compliance.h"
#include "engine/contact/ring/ring.h"

// Contact model.
typedef enum {
  SB_FIT_KARASZKIEWICZ, // closed forms (closed_forms.h)
  SB_FIT_HERTZ,
  SB_FIT_LINDLEY,
  SB_FIT_GREEN_ENGLISH,
  SB_FIT_DISC_THESIS, // the thesis' linear disc
  SB_FIT_DISC,        // linear disc
  SB_FIT_RING,        // finite-strain finite elements (ring/ring.h)
  SB_FIT_MODEL_COUNT
} SbFitModel;

// SbFitProblem.variant of SB_FIT_DISC: vertical or radial kernel; fluid on one flank with the ring
// on the opposite groove wall, or fluid on both flanks.
typedef enum {
  SB_DISC_VERTICAL,
  SB_DISC_RADIAL,
  SB_DISC_VERTICAL_BOTH,
  SB_DISC_RADIAL_BOTH,
  SB_DISC_VARIANT_COUNT
} SbDiscVariant;

// SbFitProblem.variant of SB_FIT_DISC_THESIS: direction of the contact forces (vertical, radial),
// and vertical forces with the fluid force on the projected height of the flank.
typedef enum {
  SB_DISC_THESIS_VERTICAL,
  SB_DISC_THESIS_RADIAL,
  SB_DISC_THESIS_PROJECTED
} SbDiscThesisVariant;

// What a model computes.
typedef struct {
  const char *name; // of the choice of models.fit: "disc-thesis"
  bool section;     // solves the section's deformation: any profile, groove walls, friction
  bool body;        // its pressure is that of an elastic body, on which films can be solved
  bool points;      // computes the pressure at points, within a tolerance; else by a formula
  bool fluid;       // its load includes the fluid's pressure difference
} SbFitKind;

// Returns what a model computes; static. NULL for an invalid one.
const SbFitKind *sb_fit_kind(SbFitModel model);

// Returns whether a ring that fills the fraction `gland_fill` of its groove presses on walls that
// the model does not include: only solved sections have them. Its load is then too small.
bool sb_fit_ignores_walls(SbFitModel model, double gland_fill);

// Returns the typical relative error estimate of a valid model's load at a `tolerance` above 0 and
// below 1. A result of 0 means exact up to rounding (closed forms).
double sb_fit_load_error(SbFitModel model, double tolerance);

// Finds a model by name. Returns false if there is none; *out is unchanged then.
SB_CHECKED bool sb_fit_model_from_name(SbFitModel *out, const char *name);

// How messages name the caller's choices. All strings are borrowed.
typedef struct {
  const char *profile; // "section = ": comes before the name of a profile
  const char *fitted;  // " (...)": how to choose fitted_section; comes at the end of a warning
  const char *ring;    // " (...)": how to choose SB_FIT_RING; comes at the end of a warning
} SbFitNames;

// A problem. Initialise with {0}, then set at least model, the sizes of ring and gland, modulus and
// poisson_ratio.
typedef struct {
  SbFitModel model;
  int variant;           // variant of the model, 0: default; see sb_fit_variant_name()
  SbSealProfile profile; // ring model only: section shape; if not a circle, d is its radial height
  double section_diameter; // d, free [m]
  double inner_diameter;   // ID, free [m]
  double modulus;          // E of the rubber [Pa]
  double poisson_ratio;    // nu of the rubber
  double mooney_share;     // ring model only: c2/(c1 + c2) of the rubber, 0: neo-Hookean
  double housing_modulus;  // Hertz model only: E of bore and stem [Pa]; 0 or infinite: rigid
  double housing_poisson;  // Hertz model only: nu of bore and stem
  double radial_space;     // g [m]
  double bore_diameter;    // D [m]
  double gland_width;      // axial width of the groove at its floor [m]
  // Ring model only: angle of the walls [rad], radius of the floor corners [m], chamfer of the
  // edges [m] (SbRingLoad).
  double wall_draft, groove_corner, groove_chamfer;
  double land_diameter; // ring model only, with groove_chamfer: diameter of the stem next to the
                        // groove [m]
  // Ring model only: drawn groove instead of wall_draft, groove_corner and groove_chamfer,
  // borrowed; NULL: none.
  const SbGrooveDrawing *groove;
  // Closed forms only: they squeeze section_diameter_fitted instead of the free section, as the
  // discs always do.
  bool fitted_section;
  const SbFitNames *names; // for messages, borrowed; NULL: they do not name the caller's choices
  double pressure;         // fluid pressure difference [Pa]; > 0: higher on the left (x < 0)
  double tolerance; // relative error of load, peak and width; 0: 1e-3 (closed forms ignore it)
  // Ring model only: a flat gasket, clamped between plates at the distance gland_width with
  // wall_friction, on a stem of bore_diameter. Its free bore is inner_diameter, its thickness
  // profile.axial_height (profile.kind is SB_SEAL_PROFILE_RECTANGLE), its radial extent
  // section_diameter. radial_space is not used.
  bool gasket;
  // Ring model only: the bore slides steadily over the ring with the friction coefficient |drag|.
  // drag > 0 drags the ring towards the wall onto which the fluid presses it (the right one without
  // pressure). Floor and walls have friction too.
  bool dragged;
  double drag, floor_friction, wall_friction; // coefficients
  SbRingShear shear;   // friction law of the bore, multiplied by |drag|; NULL: Coulomb with |drag|
  const void *law;     // data of `shear`, borrowed as long as the ring exists
  bool start_at_wall;  // before sliding the ring is at the wall; else in the middle of the groove
  bool surface_wanted; // ring model: also compute `surface`
  // Warm start, borrowed during the call: continue from a solved ring of a similar problem if
  // possible, with its error estimates. NULL: cold start.
  const struct SbFitStart *start;
  // Ring model: receives the solved ring (the caller frees it with sb_ring_destroy()); a ring that
  // it already has is freed. Set *kept to a ring or NULL before. NULL: not wanted.
  SbRing **kept;
  bool (*cancel)(void *); // called now and then by the ring model; true stops it. NULL: never
  void *cancel_data;
} SbFitProblem;

// A solved ring from which another fit starts.
typedef struct SbFitStart {
  double error_load, error_peak, error_width; // relative error estimates of `ring`
  const SbRing *ring;                         // the solved ring
  SbRingGuide *guide;                         // predictor of `ring`; NULL: none
  // Linearisation at `ring`, from which the fit is evaluated; NULL: solve.
  SbRingTangent *tangent;
  bool beside; // with `tangent`: solve from the linearised state (sb_ring_tangent_solve())
} SbFitStart;

// Returns the name of variant number `variant` (from 0) of a model; static. NULL after the last
// one. A model without variants has one, "default".
const char *sb_fit_variant_name(SbFitModel model, int variant);

// Returns the number of a variant by name; "default" is 0 for each model. -1 if there is none.
int sb_fit_variant_find(SbFitModel model, const char *name);

// Capacity of a pressure profile.
enum { SB_FIT_PROFILE_MAX = 512 };

// Result; owns no memory, may be copied (40 kB).
typedef struct {
  SbFitModel model;
  int variant;
  double squeeze;                 // defined at the top of this header, like the next five [1]
  double stretch_mean;            // [1]
  double stretch_inner;           // [1]
  double section_diameter_fitted; // [m]
  double interference;            // of the section diameter; gasket: of the bore diameter [m]
  double gland_fill;              // [1]
  double circumference;           // [m]
  double contact_width;           // [m]
  double contact_left;            // x of the left edge [m]
  double contact_right;           // x of the right edge [m]
  double load;                    // radial force on the bore [N]
  double load_per_length;         // [N/m]
  double pressure_peak;           // [Pa]
  bool touches;                   // false: no contact; width and load are 0
  bool valid;                     // no warning except "no-contact": inside the range of the model
  SbWarnings warnings;
  // Further results of the ring model; zero for other models.
  struct {
    double floor_load;      // radial force on the groove floor [N]
    double wall_load;       // axial force on the groove wall, the larger one [N]
    double thickness;       // radial extent of the fitted section [m]
    double volume_change;   // change of the ring's volume divided by its free volume
    double axial_imbalance; // sum of all axial forces divided by the largest one
    double drag;            // axial force of the bore on the ring, signed as SbFitProblem.drag [N]
    double drag_limit; // largest drag/load of steady sliding if the ring rolls or jams; else NAN
    double fault;      // SbRingResult.fault
    double order;      // SbRingResult.order
    double turn;       // rotation of the section, > 0 as drag > 0 drives it [rad]
    SbRingState state;
    size_t load_steps, rejected_steps;
  } ring;
  struct {
    bool converged;
    size_t unknowns;
    size_t newton_iterations;
    struct {
      double load, pressure_peak, contact_width; // relative
    } error_estimate;
    double wall_s; // elapsed time [s]
  } solver;
  // Contact pressure at increasing positions from contact_left to contact_right; 0 points without
  // contact.
  size_t profile_count;
  double profile_x[SB_FIT_PROFILE_MAX]; // [m]
  double profile_p[SB_FIT_PROFILE_MAX]; // [Pa]
  // Surface of the fitted body for film solvers: of the ring model, if `surface_wanted` was set and
  // the surface was found. Else modes is 0; that of SB_FIT_DISC is sb_compliance_disc().
  SbSurfaceCompliance surface;
} SbFit;

// Largest |drag|.
#define SB_FIT_DRAG_MAX 2.0

// The warning "stretch-interference" is given if stretch changes the interference by more than this
// fraction of d - g (closed forms and discs).
#define SB_FIT_STRETCH_MAX 0.03

// Solves the problem. After an error *problem->kept is unchanged. Errors:
// SB_ERROR_RANGE, SB_ERROR_INPUT: a value is out of range; the report has its input
// (SB_CONTACT_IN_... of inputs.h).
// SB_ERROR_INFEASIBLE: the groove floor has no diameter, or the model has no solution.
// SB_ERROR_NOT_CONVERGED: solver.converged is false; only the sizes are defined.
// SB_ERROR_CANCELLED.
// A ring without contact is a valid result: load 0 and the warning "no-contact".
SbStatus sb_fit_solve(SbFit *out, const SbFitProblem *problem, SbReport *report);

// Solves a dragged ring for another friction law or pressure with the same direction of sliding. It
// continues from the present state of *problem->kept (not NULL), which sb_fit_solve() stored. *out
// must be the result of that solve; its error estimates remain. After an error *out is unchanged;
// after SB_ERROR_NOT_CONVERGED solve the problem with sb_fit_solve().
SbStatus sb_fit_again(SbFit *out, const SbFitProblem *problem, SbReport *report);

// Sets *out and *problem->kept (not NULL; a ring that it already has is freed) to the ring that
// slides in the opposite direction, by reflecting `ring` and its result `fit`; nothing is solved.
// Only without fluid pressure. `problem` is that of the new direction. SB_ERROR_NOT_CONVERGED:
// section or groove is not symmetric.
SbStatus sb_fit_mirror(SbFit *out, const SbFitProblem *problem, const SbFit *fit,
                       const SbRing *ring, SbReport *report);

// Converts a problem that sb_fit_solve() accepts into the body and load of the ring model (ring.h).
// The load has the wall on the side of the lower pressure only (none without pressure), or both
// walls for a gasket, a dragged ring or a drawn groove.
void sb_fit_ring_problem(SbRingBody *body, SbRingLoad *load, const SbFitProblem *problem);
