// How the ring sits: contact width, load and pressure profile of a seal in its gland, by any of the
// contact models. One problem in, one result out, whatever the model, so that `sealbench fit`, the
// cycle and the panel need not know which it is.
//
// Sizes: the ring (free section d, free inner diameter ID) lies in a groove whose floor has the
// diameter D - 2 g, in a bore of diameter D. The fitted mean diameter is D - g. Quantities follow
// the definitions of docs/results.md:
//   squeeze (d - g)/d; stretch_mean ((D - g) - (ID + d))/(ID + d); stretch_inner (D - 2 g)/ID - 1;
//   section_diameter_fitted d (1 - nu stretch_mean); interference = that - g, diametral;
// Of a gasket squeeze is its crimp, stretch_inner that of its bore and interference the stem's
// diameter less the bore's; what only a ring on a floor has is NaN.
//   gland_fill free ring volume / gland volume = (pi/4) d^2 (ID + d)/(g (D - g) gland width).
// Every model but the ring warns ("stretch-interference") where stretch moves the interference by
// more than SB_FIT_STRETCH_MAX of its unstretched value d - g.
// Load is the integral of the contact pressure over the closed contact (the fluid's share
// included); load = load_per_length x circumference, and circumference is pi (ID + d) for the
// closed forms, pi (D - g) for the discs, pi D for the ring. Frictionless; pressure acts from x <
// 0.
#pragma once

#include "engine/base/status.h"
#include "engine/contact/compliance.h"
#include "engine/contact/ring/ring.h"

typedef enum {
  SB_FIT_KARASZKIEWICZ,
  SB_FIT_HERTZ,
  SB_FIT_LINDLEY,
  SB_FIT_GREEN_ENGLISH,
  SB_FIT_DISC_THESIS,
  SB_FIT_DISC,
  SB_FIT_RING,
  SB_FIT_MODEL_COUNT
} SbFitModel;

// Variants of `disc`: its kernel, and whether the fluid is on one flank, the ring on the groove
// wall beyond, or on both flanks.
typedef enum {
  SB_DISC_VERTICAL,
  SB_DISC_RADIAL,
  SB_DISC_VERTICAL_BOTH,
  SB_DISC_RADIAL_BOTH,
  SB_DISC_VARIANT_COUNT
} SbDiscVariant;

// Variants of `disc-thesis`: along what the contact's forces act, and whether the fluid's act per
// arc outside the contact or, vertical too, per projected height of the whole flank.
typedef enum {
  SB_DISC_THESIS_VERTICAL,
  SB_DISC_THESIS_RADIAL,
  SB_DISC_THESIS_PROJECTED
} SbDiscThesisVariant;

// Name of a model ("disc-thesis"); borrowed. NULL outside the enumeration.
const char *sb_fit_model_name(SbFitModel model);

// Finds a model by name; false (and nothing written) if there is none.
SB_CHECKED bool sb_fit_model_from_name(SbFitModel *out, const char *name);

// What to solve. Zero-initialise, then fill; every size and modulus in SI.
typedef struct {
  SbFitModel model;
  int variant;             // of the model, 0 the default: see sb_fit_variant_name
  SbSealProfile profile;   // other than a circle: the ring's alone; d is then its radial height
  double section_diameter; // d, free [m]
  double inner_diameter;   // ID, free [m]
  double modulus;          // E of the rubber [Pa]
  double poisson_ratio;    // nu of the rubber [-]
  double mooney_share;     // c2/(c1 + c2) of the rubber, 0: neo-Hookean [-]; the ring's alone
  double housing_modulus;  // E of bore and stem [Pa]; 0 or infinite: rigid
  double housing_poisson;  // nu of bore and stem [-]
  double radial_space;     // g [m]
  double bore_diameter;    // D [m]
  double gland_width;      // axial, at the floor [m]
  double wall_draft, groove_corner, groove_chamfer; // of the ring alone: SbRingLoad's [rad, m, m]
  double land_diameter;                             // of the stem beside the groove [m]
  const SbGrooveDrawing *groove; // drawn, instead of those; borrowed; NULL: there is none
  // Of closed forms alone: they squeeze the section after stretch, section_diameter_fitted, not the
  // free one. The discs always do.
  bool fitted_section;
  double pressure;  // pressure difference [Pa]; positive on the left (x < 0)
  double tolerance; // relative, wanted of load, peak and width; 0: 1e-3
  // Of the ring alone: a flat gasket, clamped between plates `gland_width` apart that rub with
  // wall_friction, on a stem of bore_diameter in its free bore of inner_diameter; its section's
  // axial height is its thickness, section_diameter its radial extent. radial_space is then unused.
  bool gasket;
  // Of the ring alone: dragged by the bore, which slides steadily with friction |drag|, > 0 towards
  // the wall that the fluid presses the ring to (the right one without pressure), with friction on
  // floor and walls, from where it lies before.
  bool dragged;
  double drag, floor_friction, wall_friction; // [-]
  SbRingShear shear;   // of the bore; |drag| is then the share of this law. NULL: Coulomb
  const void *law;     // its data, borrowed
  bool start_at_wall;  // else in the middle
  bool surface_wanted; // by the film: gives `surface` too
  // A solved one near this, borrowed: the ring goes on from there where it can, with the errors
  // told of that one; NULL: cold.
  const struct SbFitStart *start;
  SbRing **kept; // takes the ring in place of what it holds (owned, NULL if none); NULL: not wanted
  bool (*cancel)(void *); // polled by models that can last; true stops. May be NULL
  void *cancel_data;
} SbFitProblem;

// A ring's fitment from which another one can start.
typedef struct SbFitStart {
  double error_load, error_peak, error_width; // relative, told of it
  const SbRing *ring;
  SbRingGuide *guide;     // of that ring; NULL: none
  SbRingTangent *tangent; // of that ring, to take it from to first order; NULL: it is solved
  bool beside;            // where that leads it is solved: sb_ring_tangent_solve()
} SbFitStart;

// Name of a model's variant (Green & English's rows, the kernel of the disc, ...), counted from 0;
// NULL beyond the last. Borrowed. A model without variants has the one name "default".
const char *sb_fit_variant_name(SbFitModel model, int variant);

// Finds a model's variant by name, "default" being the first of every model; -1 if it has none.
int sb_fit_variant_find(SbFitModel model, const char *name);

enum { SB_FIT_PROFILE_MAX = 512 };

typedef struct {
  SbFitModel model;
  int variant;
  double squeeze;                 // [-]
  double stretch_mean;            // [-]
  double stretch_inner;           // [-]
  double section_diameter_fitted; // [m]
  double interference;            // [m], diametral
  double gland_fill;              // [-]
  double circumference;           // [m]
  double contact_width;           // [m]
  double contact_left;            // [m], x of the left edge
  double contact_right;           // [m]
  double load;                    // [N]
  double load_per_length;         // [N/m]
  double pressure_peak;           // [Pa]
  bool touches;                   // false: no contact, width and load are 0
  bool valid;                     // inside the validity of the model (see warnings if not)
  SbWarnings warnings;
  // What the finite-element ring knows beside; zero for other models.
  struct {
    double floor_load;      // on the groove floor [N]
    double wall_load;       // on the groove wall that the fluid presses it on [N], axial
    double thickness;       // radial extent of the fitted section [m]
    double volume_change;   // of the whole ring, relative to the free one [-]
    double axial_imbalance; // sum of all axial forces over the largest force [-]
    double drag;            // of the bore on the ring, > 0 as the problem's [N]
    double drag_limit;      // greatest drag over load where the ring rolls or jams; NAN: not met
    double fault;           // of one taken from another to first order (ring.h)
    double order;           // of its recovered pressure over its nodes (ring.h)
    double turn;            // of the section, > 0 as the drag turns it [rad]
    SbRingState state;
    size_t load_steps, rejected_steps;
  } ring;
  struct {
    bool converged;
    size_t unknowns;
    size_t newton_iterations;
    struct {
      double load, pressure_peak, contact_width; // relative, discretisation and iteration
    } error_estimate;
    double wall_s; // time of the solve [s]
  } solver;
  // Contact pressure p [Pa] at `profile_count` abscissae x [m], increasing from contact_left to
  // contact_right; none without contact.
  size_t profile_count;
  double profile_x[SB_FIT_PROFILE_MAX];
  double profile_p[SB_FIT_PROFILE_MAX];
  // Surface of the fitted body for films, pressure on its side; modes 0 where the model has none of
  // its own. The ring's, by static condensation of its equilibrium; only where `surface_wanted`.
  SbSurfaceCompliance surface;
} SbFit;

// Largest friction of a drag.
#define SB_FIT_DRAG_MAX 2.0

// Change of the interference by stretch, relative, that closed forms and discs leave without a
// warning.
#define SB_FIT_STRETCH_MAX 0.03

// Solves the problem. SB_ERROR_RANGE or SB_ERROR_INPUT with the catalogue key
// (seal.section_diameter, gland.radial_space, bore.diameter ...) for input that is not physical;
// SB_ERROR_INFEASIBLE if the groove floor would have no diameter or the model has no solution
// there; SB_ERROR_NOT_CONVERGED leaves the last good state in `out` with solver.converged false. A
// ring that does not touch is valid: SB_OK, load 0, warning "no-contact". `out` is about 30 kB,
// owned by the caller, and holds no pointers. `report` may be NULL.
SbStatus sb_fit_solve(SbFit *out, const SbFitProblem *problem, SbReport *report);

// Solves a dragged ring for another law of friction or pressure of the same direction, on the ring
// that sb_fit_solve() has kept, from its present state; `out` is that one's result, whose estimates
// of errors stay. Where it fails it is to be solved anew.
SbStatus sb_fit_again(SbFit *out, const SbFitProblem *problem, SbReport *report);

// A dragged ring without fluid from the one that slides the other way, `fit` with its kept `ring`:
// nothing is solved. `problem` is this one's, and keeps the ring.
SbStatus sb_fit_mirror(SbFit *out, const SbFitProblem *problem, const SbFit *fit,
                       const SbRing *ring, SbReport *report);

// The free ring and its groove as the ring model takes them (ring.h): the wall of the lower
// pressure only.
void sb_fit_ring_problem(SbRingBody *body, SbRingLoad *load, const SbFitProblem *problem);
