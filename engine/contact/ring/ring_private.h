// The ring object and the functions shared by its files. Private to engine/contact/ring. Lengths,
// stresses and forces are in the units of the element solver (SbRing.length, stress and force)
// unless a unit is stated. A load that is passed with a body, and SbRing.load, are in SI units. A
// load that is passed without a body, and contact->is.now, are in those of the element solver
// (sb_ring_load_in()). A boundary side and its number are those of ring_contact.h.
//
// Order for a new ring: sb_ring_check(), sb_ring_set_body(), then a mesh with elements and contact
// (sb_ring_build(), or ring->mesh and sb_ring_build_on_mesh()), then sb_ring_fit_and_press() or
// sb_ring_advance(), which solve.
#pragma once

#include "engine/contact/ring/ring.h"
#include "engine/contact/ring/ring_contact.h"

// Counters of a ring.
typedef struct {
  int iterations; // Newton iterations, including rejected attempts
  int steps;      // accepted load steps
  int rejected;   // rejected attempts
} SbRingCount;

// Work memory of sb_ring_ends() (ring_pressure.c), without content between calls.
typedef struct SbRingRecovery SbRingRecovery;

// Returns work memory, or NULL. Free it with free().
SbRingRecovery *sb_ring_recovery_create(void);

// Arc-length condition of the path of steady sliding, in the plane of the section's rotation and
// friction_bore: direction . ((turn, unit * friction_bore) - base) = length.
typedef struct {
  bool free;                                  // friction_bore is an unknown; else it is given
  double direction[2], base[2], length, unit; // unit: scale of friction_bore
} SbRingArc;

// The state of largest friction on a path, saved as SB_RING_BEFORE of its mesh while the path
// continues on other meshes.
typedef struct {
  bool here; // it is on the ring's present mesh; else on the following one (owned; NULL: none)
  SbRingMesh *mesh;
  SbRingFem *fem;
  SbRingContact *contact;
} SbRingBest;

// How the pressure of a contact was recovered at the state that was linearised, so that a
// linearised state uses the same curve; not known: best fit.
typedef struct {
  bool known;
  int terms;     // number of polynomials; 0: no curve fits
  double end[2]; // ends of the contact, as initial guess
} SbRingHeld;

// The ring (SbRing of ring.h).
struct SbRing {
  SbRingBody body;
  SbRingLoad load;
  SbRingOptions options;
  double length, stress, force; // units: d [m], mu [Pa], mu d^2 [N] (plane: mu d [N/m])
  double centre;                // radius of the middle of the free section
  SbRingOutline outline;        // of the free section, around that middle
  SbRingMesh *mesh;
  SbRingFem *fem;
  SbRingContact *contact;
  SbRingCount count;
  SbRingArc arc;
  bool at_once; // a transfer to another mesh must succeed in one step, with its slip states
  bool passing; // nodes whose state oscillates stay in contact against a small tension
  bool damped;  // steps of constant contact that do not reduce the residual are shortened
  bool easy;    // path with softer friction under fluid and fewer meshes
  bool soft;    // fitted by such a path although floor and walls have friction
  double onset; // SbRingContact.onset
  SbRingBest best;
  SbRingState state;        // of the last step: rolls or jams, else slides
  double share_limit;       // friction_bore at the limit of steady sliding; 0: not reached
  double drag_limit;        // drag/load at that limit
  double fitted_size;       // element size of the mesh last fitted to the contacts; 0: none
  double fitted_end[2];     // material angles of the bore contact's ends of that mesh
  SbRingRecovery *recovery; // owned
  SbRingHeld held[SB_RING_SURFACES]; // by surface
  bool first_order;                  // a linearised state: nothing is solved from it
  double fault; // linearised state: sb_ring_contact_fault() minus that of its base
};

// A contiguous contact with a surface, in the order of the loop.
typedef struct {
  int first, last; // loop indices of the outermost nodes in contact (last may exceed the count)
  double angle[2]; // material angles of the ends, angle[0] < angle[1]
  double place[2]; // positions of the ends along the surface (z; r for a wall)
  double end_pressure[2]; // fluid pressure at the ends
} SbRingPatch;

// Finds the contact with a surface. Returns false if there is none.
SB_CHECKED bool sb_ring_patch(const SbRing *ring, SbRingSurface surface, SbRingPatch *patch);

// Returns the contact pressure with a surface at loop node i, from the nodal force; 0 without
// contact.
double sb_ring_node_pressure(const SbRing *ring, int i, SbRingSurface surface);

// Returns the fraction of the bore's friction that is missing because friction develops gradually
// with the contact pressure above the adjacent fluid's (ring_contact.c).
double sb_ring_friction_lack(const SbRing *ring);

// Returns whether a surface has contact with a node of boundary side `side`.
bool sb_ring_side_touches(const SbRing *ring, SbRingSurface surface, int side);

// Recovers a smooth pressure of a contact from its nodal forces, with their load, and replaces the
// positions of its ends (`patch` is that of sb_ring_patch()). *pressure is a function of the
// position along the surface, or of its negative if that decreases along the loop. Returns false,
// with the ends unchanged, if no smooth curve fits.
bool sb_ring_ends(const SbRing *ring, SbRingSurface surface, SbRingPatch *patch,
                  SbDryContact *pressure);

// Number of points of a profile.
enum { SB_RING_PROFILE = 321 };

// Returns the position of profile point i from the left to the right end, denser near both.
double sb_ring_profile_place(const SbDryContact *pressure, int i);

// Returns whether the section is a circle.
bool sb_ring_is_circle(const SbRing *ring);

// Returns a mesh plan without zones: element size `size_max`, and `size` at the surface.
SbRingMeshPlan sb_ring_empty_plan(const SbRing *ring, double size_max, double size);

// Builds mesh, elements and contact of a ring without a mesh by a plan. What was built before an
// error remains; sb_ring_drop() frees it.
SbStatus sb_ring_build(SbRing *ring, const SbRingMeshPlan *plan, SbReport *report);

// Frees mesh, elements and contact of a ring and sets them to NULL.
void sb_ring_drop(SbRing *ring);

// Returns SB_ERROR_NOT_CONVERGED or SB_ERROR_INFEASIBLE if the section penetrates itself or has
// inverted elements, else SB_OK.
SbStatus sb_ring_check_apart(const SbRing *ring, SbReport *report);

// Replaces the mesh by one fitted to the present contacts and solves on it; if that fails and the
// bore slides, with other sizes (sb_ring_try). After an error the state before remains.
SbStatus sb_ring_refit(SbRing *ring, double element_size, SbReport *report);

// Does the same as sb_ring_refit(), but with one element size only.
SbStatus sb_ring_refit_once(SbRing *ring, double element_size, SbReport *report);

// Factors of the element size that are tried in turn when a solve fails on one mesh.
enum { SB_RING_TRIES = 3 };
extern const double sb_ring_try[SB_RING_TRIES];

// Checks a body and a load. SB_ERROR_RANGE, SB_ERROR_INFEASIBLE, with the input.
SbStatus sb_ring_check(const SbRingBody *body, const SbRingLoad *load, SbReport *report);

// Sets body, load, units and outline of a ring; both must have passed sb_ring_check().
void sb_ring_set_body(SbRing *ring, const SbRingBody *body, const SbRingLoad *load);

// Creates a ring with the body, load and options of another one, without a mesh.
SbStatus sb_ring_create_like(SbRing **out, const SbRing *ring, SbReport *report);

// Builds elements and contact on ring->mesh, which the caller has set. What was built before an
// error remains; sb_ring_drop() frees it.
SbStatus sb_ring_build_on_mesh(SbRing *ring, SbReport *report);

// Returns whether the ends of the bore contact have left the small elements of the mesh: moved by
// more than `most` times the size of the other elements.
bool sb_ring_outgrown(const SbRing *ring, double most);

// Transfers the state of `ring` to a mesh fitted to its contacts in `fresh`, which has no mesh, and
// solves there. `edge`: size of the elements at the contacts' ends divided by that of the others;
// 0: chosen by the friction. After an error `fresh` has no mesh.
SbStatus sb_ring_remesh(SbRing *fresh, const SbRing *ring, double element_size, double edge,
                        SbReport *report);

// Displacement of a mesh's nodes along the section's surface that follows the contacts
// (ring_ends.c). Order: sb_ring_shift_create(), sb_ring_shift_begin(), then sb_ring_shift_follow()
// or sb_ring_shift_like(), which may be repeated.
typedef struct {
  bool held[SB_RING_SURFACES]; // there is a contact
  SbRingPatch patch[SB_RING_SURFACES];
  double moment[SB_RING_SURFACES][2]; // mean and deviation of the contact pressure's position
  int count;                          // ends of contacts; 0: no displacement
  double end[2 * SB_RING_SURFACES];   // their material angles, increasing
  double by[2 * SB_RING_SURFACES];    // displacements of these angles
  int side[2 * SB_RING_SURFACES];     // boundary sides that contain them
  double *gradient;                   // [nodes][4] deformation gradient, owned
} SbRingShift;

// Finds the contacts of a ring and sets zero displacements.
void sb_ring_shift_begin(SbRingShift *shift, const SbRing *ring);

// Sets the displacements so that the contacts move to those of `other`, a ring on the same mesh.
// Returns false if there is no contact to follow.
bool sb_ring_shift_follow(SbRingShift *shift, const SbRing *other);

// Applies the displacements of `other` to the same contacts on another mesh. Returns false if the
// contacts differ.
bool sb_ring_shift_like(SbRingShift *shift, const SbRingShift *other);

// Returns a displacement for the mesh of `ring` with its deformation gradient, for
// sb_ring_shift_begin() with the same ring; NULL: no memory. Freed by sb_ring_shift_destroy().
SbRingShift *sb_ring_shift_create(const SbRing *ring);

// Frees a displacement.
void sb_ring_shift_destroy(SbRingShift *shift);

// Writes the changes of a node's reference position to x and of its deformed position to `place`,
// both (r, z).
void sb_ring_shift_node(const SbRingShift *shift, const SbRing *ring, int node, double x[2],
                        double place[2]);

// Returns the change of the material angle of the boundary point at `angle` [rad].
double sb_ring_shift_angle(const SbRingShift *shift, double angle);

// Returns the element size that sb_ring_fit() uses for a tolerance.
double sb_ring_fit_size(const SbRingBody *body, const SbRingLoad *load, double tolerance);

// Makes the meshes of a linearisation's states fixed to the material, as sb_ring_near() uses them.
void sb_ring_tangent_fix_meshes(SbRingTangent *tangent);

// Creates a ring of another body and load that is not solved: on the moved mesh of `ring`, with the
// displacement `shift` (NULL: none), at its position on the floor, with its contact.
// SB_ERROR_NOT_CONVERGED: `ring` does not slide in the same direction.
SbStatus sb_ring_create_moved(SbRing **out, const SbRing *ring, const SbRingBody *body,
                              const SbRingLoad *load, const SbRingOptions *options,
                              const SbRingShift *shift, SbReport *report);

// Returns an estimate of the change of the floor's friction force if the load `target` (in the
// units of the element solver) moves the wall to which friction has dragged the ring; 0 if the ring
// was at that wall before it slid.
double sb_ring_travel_fault(const SbRing *ring, const SbRingLoad *target);

// Method of load steps.
typedef enum {
  SB_RING_FOLLOW, // pseudo-transient continuation if the next equilibrium is not close
  SB_RING_DIRECT, // Newton's method only
  SB_RING_SEALED  // as FOLLOW, while there is contact with the bore
} SbRingPath;

// Solves for equilibrium at contact->is.now by Newton's method with an active set. Friction
// measures the motion from the state SB_RING_START, which the caller has saved. After an error the
// state is the last iterate. SB_ERROR_NOT_CONVERGED, SB_ERROR_CANCELLED.
SbStatus sb_ring_newton(SbRing *ring, SbRingPath path, SbReport *report);

// Solves by sb_ring_newton(). The caller has saved the state by sb_ring_save() as SB_RING_START,
// then set contact->is.now to the new load. SB_ERROR_NOT_CONVERGED also if the section has rotated
// too far for one step, or if a SEALED path loses the bore. After an error the state of
// SB_RING_START is restored.
SbStatus sb_ring_attempt(SbRing *ring, SbRingPath path, SbReport *report);

// Changes the load to `target` in as many steps as needed. After an error the last converged load
// and state remain, and the report states the fraction that was reached.
SbStatus sb_ring_advance(SbRing *ring, const SbRingLoad *target, SbRingPath path, SbReport *report);

// Follows the viscous motion of the ring at its present load to an equilibrium, or until it has no
// contact with the bore, which is then reported by *off. SB_ERROR_NOT_CONVERGED: neither was found.
SbStatus sb_ring_moves_off(SbRing *ring, bool *off, SbReport *report);

// Fits the ring from the free state without friction (except clamping walls) at the load `smooth`,
// the fluid last, on its present mesh. Errors as for sb_ring_create().
SbStatus sb_ring_fit_and_press(SbRing *ring, const SbRingLoad *smooth, SbReport *report);

// Moves a ring that no wall supports to the wall to which the bore drags it: without contact with a
// wall, or pressed onto the opposite one by a small part of the drag. Returns whether it moved it.
bool sb_ring_rest_on_wall(SbRing *ring);

// Changes the load to `target`; first moves the ring to the wall if the fluid pushes it there.
SbStatus sb_ring_press(SbRing *ring, const SbRingLoad *target, SbReport *report);

// Reports, for a path of sliding that ended with `report`, that the fluid passes a clamped ring:
// the first crest on the stem hardly exceeds the fluid's pressure, and the fluid that has passed
// it, up to the last one, lifts the ring off the stem, so that the path has no further state.
// Returns SB_ERROR_INFEASIBLE, or SB_ERROR_NOT_CONVERGED if that is not so. The state is unchanged.
SbStatus sb_ring_let_past(SbRing *ring, SbReport *report);

// Returns the rotation of the section since it was free [rad] (the equivalent value nearest to the
// last known one). If `du` is not NULL, writes its change by the displacement du[nodes][2], to
// first order, to *change; without `du`, `change` may be NULL. Writes the mean axial position to
// *place (NULL: not wanted).
double sb_ring_turn(const SbRingContact *contact, const double *du, double *change, double *place);

// SbRingContact.onset on an easy path, and on one with friction on floor and walls.
#define SB_RING_EASY 7.0
#define SB_RING_SOFT 3.5

// Follows steady sliding from zero friction on the bore to friction_bore = `aim`, or past the
// largest one that the ring can carry. Then `state` (rolls or jams) and `share_limit` are set and
// the state is that of the largest friction. Before the call the ring is in equilibrium under the
// fluid, and contact->is.now has bore_slides and the full friction but friction_bore = 0.
// SB_ERROR_NOT_CONVERGED: neither was reached.
SbStatus sb_ring_drag(SbRing *ring, double aim, SbReport *report);

// Frees ring->best; with `take` the ring returns to that state.
void sb_ring_end_best(SbRing *ring, bool take);

// Fixes the present rotation of the section, so that friction_bore becomes an unknown.
void sb_ring_fix_turn(SbRing *ring);

// Factorises the tangent of the present state with free nodes at the bore; sb_ring_contact_settle()
// must follow. SB_ERROR_NOT_CONVERGED: singular.
SbStatus sb_ring_free_bore(SbRing *ring, SbReport *report);
