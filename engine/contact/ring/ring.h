// The seal ring in its groove: axisymmetric finite-strain finite elements with unilateral contact
// and friction (public interface of the ring model).
//
// x is axial, with its origin at the centre of the free section; radii are measured from the
// valve's axis. Forces are those of the full ring; with `plane_strain` they are per metre. A ring
// that seals inwards (`inward`) has negative radii and radial displacements, except in SbRingFields
// and SbRingSection: the stem is its bore. It has no floor; the groove walls clamp it, and the
// fluid of the higher pressure ends at the wall of its side.
//
// Material: W = c1 (J^(-2/3) I1 - 3) + c2 (J^(-4/3) I2 - 3) + K/2 (J - 1)^2 with 2 (c1 + c2) = mu =
// E/(2 (1 + nu)), K = E/(3 (1 - 2 nu)); c2 = 0 is the neo-Hookean energy. Surfaces are rigid and
// smooth. No time dependence.
//
// One ring is used by one thread at a time, except as stated for SbRingGuide and SbRingTangent,
// which only read their ring.
#pragma once

#include "engine/base/status.h"
#include "engine/contact/compliance.h"
#include "engine/contact/ring/ring_drawn_groove.h"
#include "engine/contact/ring/ring_profile.h"

#include <math.h>
#include <stdbool.h>

// A ring with its mesh, state and options.
typedef struct SbRing SbRing;

// The free ring.
typedef struct {
  SbSealProfile profile;   // {0}: a circle; otherwise section_diameter is the radial height
  double section_diameter; // [m]
  double inner_diameter;   // [m]; not used with plane_strain
  double modulus;          // Young's modulus [Pa]
  double poisson_ratio;    // 0.3 to 0.49995
  double mooney_share;     // c2/(c1 + c2), 0 to 0.5
  bool plane_strain;       // a long straight cord instead of a ring
  bool inward;             // seals inwards against a stem in its bore: a gasket
} SbRingBody;

// Friction law of the bore: returns the shear stress of sliding [Pa] at a total contact pressure
// [Pa] >= 0 (fluid part included), and writes its derivative to *slope. It is 0 at 0, does not
// decrease, and has a finite slope. Called by the thread that solves the ring.
typedef double (*SbRingShear)(double pressure, double *slope, const void *law);

// Positions of the rigid surfaces, and loads. Initialise with SB_RING_LOAD_INIT, then set at least
// floor_radius and bore_radius.
typedef struct {
  double floor_radius, bore_radius; // radii of groove floor (stem) and bore [m]; floor -INFINITY:
                                    // no floor. Inward ring: bore_radius is minus the stem's radius
  double wall_left, wall_right;     // x of the groove walls at the floor [m]; +-INFINITY: none
  double wall_draft;                // angle by which each wall opens away from the floor [rad]
  double floor_corner;              // radius of the corners between floor and walls [m]
  double wall_chamfer;              // size of 45 degree chamfers at the walls' edges [m]
  double wall_top; // radius (from the valve's axis) of the walls' edges [m]; used with wall_chamfer
  // Drawn groove instead of draft, corner, chamfer, borrowed as long as the ring has this load;
  // NULL: none.
  const SbGrooveDrawing *groove;
  double groove_unit;  // unit of the lengths of `groove` [m], normally 1
  double groove_share; // factor of the deviations of `groove` from a flat groove, normally 1
  double land_left, land_right; // x of the ends of the bore's land [m]; +-INFINITY: none
  double chamfer_angle;         // angle at which the bore opens beyond an end of the land [rad]
  double edge_length;           // axial length of the transition to the chamfer [m]
  double pressure_left;         // of the fluid left of the contacts with bore and floor [Pa], >= 0
  double pressure_right;        // of the fluid right of these contacts [Pa], >= 0
  double bore_position;         // x of a material point of the bore [m]; with bore_slides 0 its
                                // changes drag the ring by friction
  double friction_bore;         // factor of the bore's law, or Coulomb coefficient, 0 to 2
  double friction_floor;        // Coulomb coefficient, 0 to 2
  double friction_wall;         // Coulomb coefficient, 0 to 2
  SbRingShear shear;            // friction law of the bore; NULL: Coulomb
  const void *law;              // data of `shear`, borrowed as long as the ring has this load
  double bore_traction;         // prescribed shear stress on the ring towards +x [Pa]
  bool use_bore_traction;       // use it instead of the bore's friction
  bool rests_on_wall; // with bore_slides: before sliding the ring is at the wall to which it is
                      // dragged; else in the middle
  int bore_slides; // +1, -1: the bore slides steadily to +x, -x; 0: friction follows bore_position
} SbRingLoad;

// Initial values of SbRingLoad: no walls, unlimited land, no fluid, no friction.
#define SB_RING_LOAD_INIT                                                                          \
  {                                                                                                \
    .wall_left = -HUGE_VAL, .wall_right = HUGE_VAL, .land_left = -HUGE_VAL,                        \
    .land_right = HUGE_VAL, .chamfer_angle = 0.5, .edge_length = 5e-5, .groove_unit = 1.0,         \
    .groove_share = 1.0                                                                            \
  }

// Largest allowed area of the stretched ring's section divided by that of the groove between two
// walls [1]; a fuller groove is SB_ERROR_INFEASIBLE.
#define SB_RING_FILL_MOST 0.985

// Element size (SbRingOptions.element_size) for an accuracy of 1 %.
#define SB_RING_LARGE 0.07

// Numerical options; 0 or false selects the default in brackets.
typedef struct {
  double element_size;      // element side in the contact divided by the section diameter [0.05]
  bool fit_mesh;            // after the first solution, remesh with nodes at the contact edges
  bool drawn;               // for drawing only: residual forces 1e-7 of their scale
  bool quick;               // dragged ring: a faster, less accurate continuation path
  bool alone;               // no fluid pressure unless the ring touches the bore without it
  double tolerance;         // sb_ring_fit(): relative error of the load, 1e-5 to 0.1 [1e-3]
  double wanted;            // sb_ring_fit(): error estimate above which `missed` is set [tolerance]
  bool (*poll)(void *data); // true cancels; called in each Newton iteration
  void *poll_data;
} SbRingOptions;

// State of a ring.
typedef enum {
  SB_RING_SLIDES,     // in equilibrium: at rest, or the bore slides over it steadily
  SB_RING_ROLLS,      // its section would roll: the step was refused, or steady sliding with this
                      // friction does not exist
  SB_RING_JAMS,       // wedged: steady sliding with this friction does not exist
  SB_RING_NO_CONTACT, // no contact with the bore
} SbRingState;

// Returns the name of a state ("slides", "rolls", "jams", "no-contact"); static.
const char *sb_ring_state_name(SbRingState state);

// Results of the present state. Without contact with the bore, the values of this contact are 0.
typedef struct {
  SbRingState state;
  // Rotation of the section since it was free [rad]; > 0 as a bore moving to +x drives it.
  double turn;
  bool touching;      // contact with the bore
  double drag_limit;  // drag/load of the limit of steady sliding, if it rolls or jams; else 0
  double share_limit; // friction_bore at that limit; else 0
  double bore_force, bore_drag;   // radial (compression > 0); axial on the ring, > 0 to +x [N]
  double floor_force, floor_drag; // forces of the groove floor, signed like those of the bore [N]
  double wall_right_force, wall_left_force; // axial, compression > 0 [N]
  double contact_left, contact_right;       // x of the ends of the bore contact [m]
  double pressure_peak;                     // largest pressure of the bore contact [Pa]
  double thickness;                         // radial extent of the deformed section [m]
  double axial_left, axial_right;           // axial extent of the deformed section [m]
  double volume_change;   // change of the ring's volume divided by its free volume
  double penetration;     // largest penetration of a boundary node [m]
  double pressure_least;  // smallest nodal contact pressure minus the fluid's [Pa]
  double friction_excess; // deviation from Coulomb's law at nodes whose state oscillates [N]
  double axial_imbalance; // sum of all axial forces divided by the largest one
  double fault; // linearised state: forces that violate the active set, divided by the bore force
  // Number of polynomials of the recovered pressure per contact node; 0: nodal pressure.
  double order;
  int unknowns, newton_iterations, load_steps, rejected_steps;
  struct {
    double load, peak, width; // relative
  } error;                    // estimates of sb_ring_fit(); 0 otherwise
  bool missed;                // sb_ring_fit(): the error of the load is above SbRingOptions.wanted
} SbRingResult;

// Fits the free ring into its groove: stretched over the floor, squeezed by the bore, then loaded
// by the fluid. Friction acts from then on. `options` may be NULL. With `bore_slides` the ring
// slides steadily; if it rolls or jams at a smaller friction than friction_bore, the state is that
// of the largest friction found, and the result's `state` reports it. Errors:
// SB_ERROR_RANGE, SB_ERROR_INFEASIBLE: with the input (bore smaller than the groove floor,
//   overfilled groove, no wall against the pressure, the fluid passes the ring, creased surface).
// SB_ERROR_NOT_CONVERGED, SB_ERROR_CANCELLED.
SbStatus sb_ring_create(SbRing **out, const SbRingBody *body, const SbRingLoad *load,
                        const SbRingOptions *options, SbReport *report);

// Frees the ring.
void sb_ring_destroy(SbRing *ring);

// Changes the load of a ring (warm start from its present equilibrium).
// A ring that slides steadily changes directly if the new state is close (same direction of
// sliding), else it is fitted again as by sb_ring_create(). A ring at rest moves in load steps;
// friction sees a monotonic motion in each. The mesh follows the contact.
// After an error the ring is at the last equilibrium that was found, whose load sb_ring_load()
// returns. SB_ERROR_NOT_CONVERGED also if the section would roll; the result's `state` reports it.
// Other errors as for sb_ring_create().
SbStatus sb_ring_step(SbRing *ring, const SbRingLoad *load, SbReport *report);

// Creates the reflection at x = 0 of a ring without fluid pressure: the ring that slides in the
// opposite direction. `law` is the data of its friction law, borrowed; NULL if the law has none.
// SB_ERROR_NOT_CONVERGED: the section is not symmetric, or the groove is drawn.
SbStatus sb_ring_mirror(SbRing **out, const SbRing *ring, const void *law, SbReport *report);

// Predictor for solutions near a solved ring, by a coarse copy of it. It borrows the ring, which
// must not change. Several threads may use one predictor.
typedef struct SbRingGuide SbRingGuide;

// Creates a predictor of `ring`; the coarse copy is solved later.
SbStatus sb_ring_guide_create(SbRingGuide **out, const SbRing *ring, SbReport *report);

// Frees the predictor.
void sb_ring_guide_destroy(SbRingGuide *guide);

// Solves the coarse copy now, so that the first sb_ring_near() does not wait for it. Any thread.
void sb_ring_guide_make(SbRingGuide *guide);

// Solves another body or load from the state of `ring`, with the predictor `guide` of `ring` on a
// mesh that follows the contacts; if that fails, or without one (NULL), directly on a moved mesh. A
// ring that slides steadily keeps its direction. Friction on floor and walls sees the difference of
// the two states. `ring` is only read. `options` must not be NULL; its element_size is ignored.
// With a predictor, elements larger than those of `ring` are used if they suffice for
// options->tolerance (0: never). SB_ERROR_NOT_CONVERGED: the difference is too large, or the ring
// rolls or jams. Other errors as for sb_ring_create().
SbStatus sb_ring_near(SbRing **out, const SbRing *ring, SbRingGuide *guide, const SbRingBody *body,
                      const SbRingLoad *load, const SbRingOptions *options, SbReport *report);

// Linearisation at a solved ring: states with a perturbed body, load or law, to first order, with a
// constant active set (contact, stick and slip, wetted faces). It borrows the ring, which must not
// change, and `law`, the data of its friction law when it was solved. Several threads may use one
// linearisation.
typedef struct SbRingTangent SbRingTangent;

// Creates a linearisation; its matrix is factorised when it is first used.
SbStatus sb_ring_tangent_create(SbRingTangent **out, const SbRing *ring, const void *law,
                                SbReport *report);

// Frees the linearisation.
void sb_ring_tangent_destroy(SbRingTangent *tangent);

// Creates the linearised state of another body at another load with the same direction of sliding.
// Its mesh follows its contacts. `options` must not be NULL; its element_size is ignored.
// SbRingResult.fault reports how far the state violates the active set. The state is not in
// equilibrium, so other functions must not solve from it. SB_ERROR_NOT_CONVERGED: there is no such
// state. Other errors as for sb_ring_create().
SbStatus sb_ring_tangent_at(SbRing **out, SbRingTangent *tangent, const SbRingBody *body,
                            const SbRingLoad *load, const SbRingOptions *options, SbReport *report);

// Creates a state by sb_ring_tangent_at() and solves it to equilibrium on that mesh.
// SbRingResult.fault is 0 if it has the active set of the linearisation's ring, else INFINITY.
// Errors as for sb_ring_near().
SbStatus sb_ring_tangent_solve(SbRing **out, SbRingTangent *tangent, const SbRingBody *body,
                               const SbRingLoad *load, const SbRingOptions *options,
                               SbReport *report);

// Creates a copy of the present state on another mesh, with options->element_size (> 0) in all
// contacts, in equilibrium. SB_ERROR_NOT_CONVERGED: no equilibrium was found on that mesh.
SbStatus sb_ring_copy(SbRing **out, const SbRing *ring, const SbRingOptions *options,
                      SbReport *report);

// Replaces the borrowed data of the friction law and of `poll` of a ring, when another owner takes
// it over.
void sb_ring_set_data(SbRing *ring, const void *law, void *poll_data);

// Returns the load of the present state; borrowed until the ring changes.
const SbRingLoad *sb_ring_load(const SbRing *ring);

// Computes the results of the present state.
void sb_ring_result(const SbRing *ring, SbRingResult *out);

// Writes the pressure of the bore contact to x[capacity] [m] and pressure[capacity] [Pa], from the
// left to the right end of the contact; at the ends it equals the fluid's pressure. Returns the
// number of points of the full profile (0 without contact); the first `capacity` of them are
// written.
int sb_ring_profile(const SbRing *ring, double *x, double *pressure, int capacity);

// Returns sizes for SbRingFields: number of nodes, triangles, and outline points.
void sb_ring_sizes(const SbRing *ring, int *nodes, int *triangles, int *outline);

// Fields for drawing; the caller provides all arrays with the sizes of sb_ring_sizes().
typedef struct {
  double *place;        // [nodes][2] deformed position (x axial, r) [m]
  double *displacement; // [nodes][2] (axial, radial) from the free ring [m]
  double *mises;        // [nodes] von Mises stress [Pa]
  double *hydrostatic;  // [nodes] mean stress, tension > 0 [Pa]
  double *shear;        // [nodes] axial-radial shear stress [Pa]
  double *contact;      // [nodes] contact or fluid pressure on the boundary, 0 inside [Pa]
  int *triangle;        // [triangles][3] node numbers of the corners
  int *outline;         // [outline] node numbers of the boundary in order, not repeated at the end
} SbRingFields;

// Fills the arrays of *out (all must be set).
void sb_ring_fields(const SbRing *ring, const SbRingFields *out);

// Boundary condition of a side of the deformed section.
typedef enum {
  SB_RING_SIDE_CLOSED, // in contact
  SB_RING_SIDE_LEFT,   // open to the left fluid
  SB_RING_SIDE_RIGHT   // open to the right fluid
} SbRingSide;

// The deformed section with its six-node triangles: vertices 0-2, mid-sides 3 = 0-1, 4 = 1-2, 5 =
// 2-0, counter-clockwise in (r, x). The caller provides all arrays with the sizes of
// sb_ring_section_sizes(). Boundary side k has the nodes loop[2 k], loop[2 k + 1] (mid-side),
// loop[2 k + 2].
typedef struct {
  double *place;       // [nodes][2] position (r, x) [m]
  int *triangle;       // [elements][6] node numbers
  int *loop;           // [2 sides] boundary nodes in order, vertices at even places
  unsigned char *side; // [sides] SbRingSide
} SbRingSection;

// Returns sizes for SbRingSection.
void sb_ring_section_sizes(const SbRing *ring, int *nodes, int *elements, int *sides);

// Fills the arrays of *out. Open sides left of the pressure maxima of bore and floor contact belong
// to the left fluid (of bore and wall contact if the ring has left the floor under pressure).
// Contacts end where their recovered pressures end; the nearest vertices are moved there.
void sb_ring_section(const SbRing *ring, const SbRingSection *out);

// Writes the bore contact's surface for film solvers (compliance.h) to *out: the half-plane with
// the modulus of the squeezed rubber, a smooth part that is exact for the discrete ring, and the
// gap whose dry contact has the present pressure, in a window of 1.4 contact widths (1.24 or 1.14
// if that fails). Loads are per length of the bore's circumference. Linearised at the present
// state, frictionless on the bore. The state of `ring` does not change, but its factors and work
// memory do. SB_ERROR_INFEASIBLE: no contact, or the surface is too steep or turns away within the
// window. SB_ERROR_NOT_CONVERGED: no smooth gap gives the contact pressure.
SbStatus sb_ring_surface(SbRing *ring, SbSurfaceCompliance *out, SbReport *report);

// Solves one fit to the tolerance of `options` (NULL: defaults): on a coarse and on finer meshes
// with nodes at the contact edges, from whose differences the errors of load, peak and width
// follow. element_size is only used for the path of a sliding ring. `out` may be NULL: then the
// ring is freed. `result` is filled in both cases. Errors as for sb_ring_create().
// Warnings: "no-contact" (load 0; also if the ring under pressure has no contact without it),
// "surface-creases" (sb_ring_crease()), "section-rolled".
SbStatus sb_ring_fit(SbRing **out, SbRingResult *result, const SbRingBody *body,
                     const SbRingLoad *load, const SbRingOptions *options, SbWarnings *warnings,
                     SbReport *report);
