// The seal ring in its groove: axisymmetric finite-strain finite elements with exact contact.
//
// Public interface of the `ring` model. Units SI. The section's axial coordinate x has its origin
// at the section's centre before pressure, canister side left (x < 0), thrust wall right; radii are
// measured from the valve's axis. Forces are those of the whole ring (N); with `plane_strain` they
// are per metre. Pressures are gauge.
// A ring that seals inwards has every radius with a minus sign, radial displacements too: the stem
// is its bore, above it in this sense, and what holds it outside would be its floor. It has none:
// groove walls clamp it, and the fluid of the higher pressure ends at that side's wall.
//
// Material: W = c1 (J^(-2/3) I1 - 3) + c2 (J^(-4/3) I2 - 3) + K/2 (J - 1)^2 with 2 (c1 + c2) = mu =
// E / (2 (1 + nu)), K = E / (3 (1 - 2 nu)); c2 = 0 is the neo-Hookean energy.
// Surfaces are rigid and smooth; friction is Coulomb or a given shear. No time dependence here.
#pragma once

#include "engine/base/status.h"
#include "engine/contact/compliance.h"
#include "engine/contact/ring/ring_drawn_groove.h"
#include "engine/contact/ring/ring_profile.h"

#include <math.h>
#include <stdbool.h>

typedef struct SbRing SbRing;

// The free ring.
typedef struct {
  SbSealProfile profile;   // a circle if zero; of others section_diameter is the radial height
  double section_diameter; // m
  double inner_diameter;   // m; ignored with plane_strain
  double modulus;          // Young's modulus, Pa
  double poisson_ratio;    // 0.3 .. 0.49995
  double mooney_share;     // c2 / (c1 + c2), 0 .. 0.5
  bool plane_strain;       // a long straight cord instead of a ring
  bool inward;             // it seals inwards, against a stem in its bore: a gasket
} SbRingBody;

// Local friction law of the bore: shear [Pa] of sliding at a contact pressure [Pa] (the whole one,
// the fluid's share included) and its slope [-]; 0 at 0, not falling, with a finite slope. It may
// be asked at any pressure >= 0, from the thread that solves the ring.
typedef double (*SbRingShear)(double pressure, double *slope, const void *law);

// Where everything stands and what acts on the ring. Start from SB_RING_LOAD_INIT.
typedef struct {
  double floor_radius, bore_radius; // groove floor (stem) and bore, m; floor -INFINITY: none
  double wall_left, wall_right;     // axial places of the groove walls, m; +-INFINITY: none
  double wall_draft;                // rad, by which the walls lean apart from the floor outwards
  double floor_corner;              // m, radius of the corners between floor and walls
  double wall_chamfer, wall_top;    // m, 45 degrees off the walls' edges at this radius
  const SbGrooveDrawing *groove; // instead of draft, corner and chamfer; NULL: as these; borrowed
  double groove_unit, groove_share; // m, of its lengths; of its departures from a flat groove, 1
  double land_left, land_right;     // axial ends of the bore's land, m; +-INFINITY: none
  double chamfer_angle;             // rad, beyond an end of the land the bore opens so
  double edge_length;               // m, axial length over which the chamfer sets in
  double pressure_left;             // Pa, on the free surface left of bore and floor contact
  double pressure_right;            // Pa
  double bore_position;             // m, axial place of the bore's surface; its changes drag
  double friction_bore;             // share of the bore's law, 0 .. 2
  double friction_floor;            // Coulomb coefficients, 0 .. 2
  double friction_wall;
  SbRingShear shear; // the bore's law; NULL: the pressure, friction_bore is Coulomb's coefficient
  const void *law;   // borrowed as long as the ring has this load
  double bore_traction;   // Pa, shear on the ring towards +x, instead of friction_bore
  bool use_bore_traction; // if set
  bool rests_on_wall;     // before bore_slides, touching the wall it slides to; else in the middle
  int bore_slides;        // +-1: steadily to +-x under the whole contact; 0: as bore_position says
} SbRingLoad;

#define SB_RING_LOAD_INIT                                                                          \
  {                                                                                                \
    .wall_left = -HUGE_VAL, .wall_right = HUGE_VAL, .land_left = -HUGE_VAL,                        \
    .land_right = HUGE_VAL, .chamfer_angle = 0.5, .edge_length = 5e-5, .groove_unit = 1.0,         \
    .groove_share = 1.0                                                                            \
  }

// Elements of a ring that is wanted to 1 % only, over the section diameter.
#define SB_RING_LARGE 0.07

// How finely and how long. Zero fields take the defaults in brackets.
typedef struct {
  double element_size;      // side of the contact's elements over section diameter [0.05]
  bool fit_mesh;            // after the first solution, remesh with nodes at the contact edges
  bool drawn;               // to be drawn only: the forces balance to 1e-7 of their scale
  bool quick;               // a dragged ring's path, rather than as far as it can go
  bool alone;               // without pressure unless the ring touches the bore by itself
  double tolerance;         // of sb_ring_fit, relative on the load, 1e-5 .. 0.1 [1e-3]
  double wanted;            // estimate of that error above which it warns [tolerance]
  bool (*poll)(void *data); // returns true to cancel; called every Newton iteration
  void *poll_data;
} SbRingOptions;

typedef enum {
  SB_RING_SLIDES,     // holds its place: rests, or the bore slides over it
  SB_RING_ROLLS,      // its section would roll on: the step was refused (ring_path.c), or steady
                      // sliding has no such friction (ring_drag.c)
  SB_RING_JAMS,       // steady sliding has no such friction: the ring is wedged
  SB_RING_NO_CONTACT, // does not touch the bore
} SbRingState;

const char *sb_ring_state_name(SbRingState state); // "slides", "no-contact" ..., static

typedef struct {
  SbRingState state;
  double turn;   // of the section since it was free, rad; > 0 as the bore's motion to +x drives it
  bool touching; // the bore is touched
  double drag_limit;  // greatest drag over load of steady sliding, where it rolls or jams; else 0
  double share_limit; // the share of the bore's law at which it is met; Coulomb's: the same
  double bore_force, bore_drag;   // N, radial (compression > 0) and axial (+x on the ring)
  double floor_force, floor_drag; // N, the same at the groove floor
  double wall_right_force, wall_left_force; // N, axial, compression > 0
  double contact_left, contact_right;       // ends of the bore contact, m
  double pressure_peak;                     // of the bore contact, Pa
  double thickness;                         // radial extent of the deformed section, m
  double axial_left, axial_right;           // axial extent of the deformed section, m
  double volume_change;                     // relative to the free ring [-]
  double penetration;                       // largest over the boundary nodes, m
  double pressure_least;                    // least nodal contact pressure above the fluid's, Pa
  double friction_excess; // N of departure from Coulomb's law at nodes that cannot settle, 0
  double axial_imbalance; // sum of all axial forces over the largest one [-]
  double fault; // of a state to first order: forces that violate its active set over the bore's [-]
  double order; // polynomials of the recovered pressure for each node of the bore contact; 0: nodal
  int unknowns, newton_iterations, load_steps, rejected_steps;
  struct {
    double load, peak, width; // relative
  } error;                    // estimated by sb_ring_fit; 0 without it
  bool missed;                // by sb_ring_fit: the error of the load stays above what is wanted
} SbRingResult;

// Fits the free ring into its groove: stretched over the floor, squeezed by the bore, then pressed
// by the fluid. Owned; free with sb_ring_destroy. Errors: SB_ERROR_RANGE or SB_ERROR_INFEASIBLE
// with the catalogue key (bore smaller than the groove floor, overfilled groove, nothing that holds
// the ring against the pressure, the fluid passes it), SB_ERROR_NOT_CONVERGED, SB_ERROR_CANCELLED,
// SB_ERROR_MEMORY; *out is then NULL. Friction acts from the fitted and pressed state on. What
// steady sliding keeps of another history (thesis' outer ring, 0.55 MPa, floor 0.3, wall 0.1, m =
// +-0.2): with friction while it is squeezed and pressed, at the wall, loads 1.0 and 0.6 % lower;
// while it is pressed only, at the wall 1.8 and 1.4 %, from the middle 3.6 and 3.4 %; dragged dry,
// then pressed, 1.7 and 4.3 %. Sliding back and forth does not efface it.
// With bore_slides the ring slides steadily; if it rolls or jams before friction_bore it is that at
// the greatest friction found on its path, and the result says so.
SbStatus sb_ring_create(SbRing **out, const SbRingBody *body, const SbRingLoad *load,
                        const SbRingOptions *options, SbReport *report);
void sb_ring_destroy(SbRing *ring);

// Moves on from the present equilibrium to another load (warm start). A ring that slides steadily
// goes to another law, share, pressure or place of the same direction of sliding so: at once from
// the present state where it is near, floor and wall friction seeing the difference; else anew as
// by sb_ring_create, rolling and jamming included. Its mesh is fitted anew as the contact moves.
// Another ring's friction sees the motion from one load to the next as monotonic. On failure the
// last equilibrium found on the way is kept, sb_ring_load tells at which load that is, and the
// report at which share of the step. Such a ring that would roll fails (SB_ERROR_NOT_CONVERGED):
// the result's state says so.
SbStatus sb_ring_step(SbRing *ring, const SbRingLoad *load, SbReport *report);

// The present state of a ring in a groove without fluid, mirrored in the section's plane x = 0: the
// ring that slides the other way. Owned; `law` is the data of its friction. SB_ERROR_NOT_CONVERGED
// where the section's mirror image is another one, or the groove is drawn.
SbStatus sb_ring_mirror(SbRing **out, const SbRing *ring, const void *law, SbReport *report);

// A coarse copy of a ring that slides or rests, by way of which states near it are found; may be
// asked by several threads. The ring outlives it. SB_ERROR_MEMORY; `destroy` takes NULL.
typedef struct SbRingGuide SbRingGuide;
SbStatus sb_ring_guide_create(SbRingGuide **out, const SbRing *ring, SbReport *report);
void sb_ring_guide_destroy(SbRingGuide *guide);

// Makes the coarse copy now; else whoever asks first waits for it. Any thread.
void sb_ring_guide_make(SbRingGuide *guide);

// The state of another body at another load, solved from that of `ring` near it: by way of its
// guide, on a mesh that follows the contacts; where that fails, or without one (NULL), from its
// state on its mesh, moved. A ring that slides steadily goes on sliding the same way; friction on
// floor and walls sees the difference. Owned. SB_ERROR_NOT_CONVERGED where it is too far, or rolls
// or jams.
SbStatus sb_ring_near(SbRing **out, const SbRing *ring, SbRingGuide *guide, const SbRingBody *body,
                      const SbRingLoad *load, const SbRingOptions *options, SbReport *report);

// States beside that of a ring that slides or rests, to first order in all that is changed, without
// solving: its active set (contact, stick and slip, wetted faces) is held (ring_tangent.c). `ring`
// is borrowed and must stay as it is; so is `law`, the data of its friction on the bore as it was
// solved. Factorised at the first question; several threads may ask at the same time.
typedef struct SbRingTangent SbRingTangent;
SbStatus sb_ring_tangent_create(SbRingTangent **out, const SbRing *ring, const void *law,
                                SbReport *report);
void sb_ring_tangent_destroy(SbRingTangent *tangent); // takes NULL

// The state of another body at another load that slides alike; owned. Its mesh follows its contacts
// (ring_ends.c). It has no equilibrium but to first order: nothing can be solved from it.
// SB_ERROR_NOT_CONVERGED where there is none.
SbStatus sb_ring_tangent_at(SbRing **out, SbRingTangent *tangent, const SbRingBody *body,
                            const SbRingLoad *load, const SbRingOptions *options, SbReport *report);

// The same, solved from there on that mesh. Its result's fault is 0 where it has the active set of
// the tangent's ring, else infinite.
SbStatus sb_ring_tangent_solve(SbRing **out, SbRingTangent *tangent, const SbRingBody *body,
                               const SbRingLoad *load, const SbRingOptions *options,
                               SbReport *report);

// The present state on another mesh, of `element_size` throughout its contacts. Owned.
// SB_ERROR_NOT_CONVERGED where that mesh has no such state.
SbStatus sb_ring_copy(SbRing **out, const SbRing *ring, const SbRingOptions *options,
                      SbReport *report);

// Hands a ring over to another owner, who has the data of its friction's law and of its `poll`.
void sb_ring_hand_over(SbRing *ring, const void *law, void *poll_data);

// The load of the present state; borrowed.
const SbRingLoad *sb_ring_load(const SbRing *ring);

void sb_ring_result(const SbRing *ring, SbRingResult *out);

// Contact pressure p [Pa] at x [m] of the bore contact from its left to its right end,
// where it equals the fluid's. Returns the number of points; writes at most `capacity`.
int sb_ring_profile(const SbRing *ring, double *x, double *pressure, int capacity);

// Sizes for drawing: nodes, triangles, points of the outline.
void sb_ring_sizes(const SbRing *ring, int *nodes, int *triangles, int *outline);

// For drawing, on request only.
typedef struct {
  double *place;        // [2 nodes] deformed (x axial, r), m
  double *displacement; // [2 nodes] (axial, radial) from the free ring, m
  double *mises;        // [nodes] von Mises stress, Pa
  double *hydrostatic;  // [nodes] mean stress, tension > 0, Pa
  double *shear;        // [nodes] axial-radial shear stress, Pa
  double *contact;      // [nodes] contact or fluid pressure on the boundary, 0 inside, Pa
  int *triangle;        // [3 triangles] corners
  int *outline;         // [outline] boundary nodes in order, closed by the first
} SbRingFields;
void sb_ring_fields(const SbRing *ring, const SbRingFields *out);

// What stands at a side of the deformed section's boundary.
typedef enum { SB_RING_SIDE_CLOSED, SB_RING_SIDE_LEFT, SB_RING_SIDE_RIGHT } SbRingSide;

// The deformed section with its own elements, of six nodes: vertices 0-2, mid-sides 3 = 0-1, 4 =
// 1-2, 5 = 2-0, counter-clockwise in (r, z). Boundary side k runs from loop[2 k] over loop[2 k + 1]
// to the next.
typedef struct {
  double *place;       // [2 nodes] (r, axial), m
  int *triangle;       // [6 elements]
  int *loop;           // [2 sides] nodes in order, every second one a vertex
  unsigned char *side; // [sides] SbRingSide: closed by a contact, or open to the fluid of a side
} SbRingSection;

// Its sizes, and the arrays of these sizes filled. Open sides left of the crests of bore and floor
// contact are those of the left fluid, as the ring's balance has them; contacts end where their
// recovered pressures do, onto which the nearest vertices are moved.
void sb_ring_section_sizes(const SbRing *ring, int *nodes, int *elements, int *sides);
void sb_ring_section(const SbRing *ring, const SbRingSection *out);

// The bore's surface as film solvers take it (engine/contact/compliance.h): the half-plane with the
// squeezed rubber's own modulus, a smooth rest that is exact for the discrete ring, and the gap
// whose dry contact has the present pressure, over a window of 1.4 contact widths. Loads are per
// length of the bore's circumference. To first order about the present state, frictionless along
// the bore. Errors: SB_ERROR_INFEASIBLE without contact or where the surface turns away within the
// window.
SbStatus sb_ring_surface(SbRing *ring, SbSurfaceCompliance *out, SbReport *report);

// One fitment to the options' tolerance: solves on a coarse and on a finer mesh with nodes at the
// contact edges, and estimates the error of load, peak and width from the two; element_size is that
// of a sliding ring's path, else unused. `out` may be NULL if only the figures are wanted.
// Warnings: "no-contact" (loads are then 0; also for a ring under pressure that does not touch
// without it: the fluid goes past it), "surface-creases" (sb_ring_crease in ring_contact.h).
SbStatus sb_ring_fit(SbRing **out, SbRingResult *result, const SbRingBody *body,
                     const SbRingLoad *load, const SbRingOptions *options, SbWarnings *warnings,
                     SbReport *report);
