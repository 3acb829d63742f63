// What a ring object holds. Internal to the ring.
#pragma once

#include "engine/contact/ring/ring.h"
#include "engine/contact/ring/ring_contact.h"

typedef struct {
  int iterations; // Newton iterations, rejected attempts included
  int steps;      // accepted load steps
  int rejected;   // attempts that were halved
} SbRingCount;

// Work memory of sb_ring_ends(); of no content between calls (ring_pressure.c).
typedef struct SbRingRecovery SbRingRecovery;
SbRingRecovery *sb_ring_recovery_create(void); // NULL without memory; free() ends it

// A place on the path of steady sliding, in the plane of the section's turn and the share of the
// bore's law, in units of Coulomb's coefficient: where direction . ((turn, unit share) - base) =
// length.
typedef struct {
  bool free; // the share is found from it; else it is given
  double direction[2], base[2], length, unit;
} SbRingArc;

// The state of the greatest friction on a path, saved as SB_RING_BEFORE of its mesh, while the path
// goes on over others.
typedef struct {
  bool here; // on the ring's present mesh; else on this one, owned, NULL: none
  SbRingMesh *mesh;
  SbRingFem *fem;
  SbRingContact *contact;
} SbRingBest;

// How a contact's pressure was recovered at the state beside which this one is: so it is here, too,
// that it be a smooth function of what differs. Not known: as fits best.
typedef struct {
  bool known;
  int terms;     // 0: none fits
  double end[2]; // of the contact, where to look from
} SbRingHeld;

struct SbRing {
  SbRingBody body;
  SbRingLoad load;
  SbRingOptions options;
  double length, stress, force; // units of the element solver: d, mu, mu d^2 (mu d in the plane)
  double centre;                // radius of the free section's middle, in section diameters
  SbRingOutline outline;        // of the free section, about that middle
  SbRingMesh *mesh;
  SbRingFem *fem;
  SbRingContact *contact;
  SbRingCount count;
  SbRingArc arc;
  bool at_once; // a dragged ring's other mesh takes its state with its slip or not at all
  bool passing; // single nodes may have no state: they are held against a small pull
  bool easy;    // a path of softer friction under fluid and of fewer meshes
  bool soft;    // laid by such a path beside friction on floor and walls
  double onset; // of that friction, over the usual one
  SbRingBest best;
  SbRingState state;        // how the last step ended: rolls or jams, else slides
  double share_limit;       // greatest share of the bore's law in steady sliding, 0: not met
  double drag_limit;        // drag over load there
  double fitted_size;       // elements of the mesh that was last fitted to the contacts, 0: none
  double fitted_end[2];     // material angles of the bore contact's ends that it was fitted to
  SbRingRecovery *recovery; // owned
  SbRingHeld held[SB_RING_SURFACES]; // of each surface
  bool first_order;                  // a state beside another one: nothing is solved from it
  double fault; // of a state to first order, beyond its base's (sb_ring_contact_fault())
                // of each surface
};

// One contiguous contact with a surface, in the order of the loop.
typedef struct {
  int first, last;        // loop places of the outermost held nodes (last may exceed the count)
  double angle[2];        // material angle of both ends, angle[0] < angle[1]
  double place[2];        // place of both ends along the surface (z, or r for a wall)
  double end_pressure[2]; // fluid pressure at both ends
} SbRingPatch;

// Finds a surface's contact; false if it does not touch.
SB_CHECKED bool sb_ring_patch(const SbRing *ring, SbRingSurface surface, SbRingPatch *patch);

// Contact pressure at a loop node (element solver's units), from the excess over the fluid's.
double sb_ring_node_pressure(const SbRing *ring, int i, SbRingSurface surface);

// What the bore's friction lacks of its law, as a share, since it sets in gradually as the contact
// exceeds the fluid's pressure beside it (ring_contact.c).
double sb_ring_friction_lack(const SbRing *ring);

// Whether a surface holds a node of a side of the boundary.
bool sb_ring_holds_some(const SbRing *ring, SbRingSurface surface, int side);

// Recovers the pressure of the contact that sb_ring_patch has found, a smooth curve with the load
// of the nodal forces, and replaces the places of its ends by the recovered ones. The curve (edges,
// ambient pressures, coefficients and peak, element solver's units) runs over the place along the
// surface, its negative where that falls along the loop. False, with the ends as they are, where no
// smooth curve fits it.
bool sb_ring_ends(const SbRing *ring, SbRingSurface surface, SbRingPatch *patch,
                  SbDryContact *pressure);

// Points of a smooth profile, from its left to its right end: dense at both, where the pressure
// rises with the root of the distance.
enum { SB_RING_PROFILE = 321 };
double sb_ring_profile_place(const SbDryContact *pressure, int i);

// Whether the section is a circle, whose nodes go round its middle.
bool sb_ring_is_circle(const SbRing *ring);

// A mesh without zones yet; mesh, elements and contact by a plan; the end of these, which the ring
// is then without.
SbRingMeshPlan sb_ring_empty_plan(const SbRing *ring, double size_max, double size);
SbStatus sb_ring_build(SbRing *ring, const SbRingMeshPlan *plan, SbReport *report);
void sb_ring_drop(SbRing *ring);

// Fails for a state whose section lies in itself or has elements that are turned over.
SbStatus sb_ring_check_apart(const SbRing *ring, SbReport *report);

// Replaces the mesh by one fitted to the present contacts and solves on it; the state before is
// kept if that fails.
SbStatus sb_ring_refit(SbRing *ring, double element_size, SbReport *report);
SbStatus sb_ring_refit_once(SbRing *ring, double element_size, SbReport *report); // of one size

// A sliding ring that stumbles over single nodes of one mesh is taken over to others, of these
// shares of the size, in turn.
enum { SB_RING_TRIES = 3 };
extern const double sb_ring_try[SB_RING_TRIES];

// Whether a body and its load are within what is solved; else SB_ERROR_RANGE or
// SB_ERROR_INFEASIBLE with the parameter.
SbStatus sb_ring_check(const SbRingBody *body, const SbRingLoad *load, SbReport *report);

// A body with its units, and the load that it bears.
void sb_ring_set_body(SbRing *ring, const SbRingBody *body, const SbRingLoad *load);

// A ring beside another of the same body, owned, without a mesh yet; elements and contact on its
// mesh once it has one. SB_ERROR_MEMORY.
SbStatus sb_ring_beside(SbRing **out, const SbRing *ring, SbReport *report);
SbStatus sb_ring_build_on_mesh(SbRing *ring, SbReport *report);

// Whether the bore contact's ends have left the short elements that its mesh has for them: moved by
// more than `most` of the size of the others.
bool sb_ring_outgrown(const SbRing *ring, double most);

// The ring's state on a mesh fitted to its contacts, in `fresh`, which has no mesh of its own yet
// and keeps none where that fails. `edge`: size of the elements at the contacts' ends over that of
// the others; 0 as friction asks for.
SbStatus sb_ring_remesh(SbRing *fresh, const SbRing *ring, double element_size, double edge,
                        SbReport *report);

// How the nodes of a ring's mesh are shifted along the section's surface as its contacts are
// (ring_ends.c).
typedef struct {
  bool held[SB_RING_SURFACES]; // contacts, in the order of the angle,
  SbRingPatch patch[SB_RING_SURFACES];
  double moment[SB_RING_SURFACES][2]; // with mean and deviation of their pressures
  int count;                          // ends of contacts; 0: the mesh stays
  double end[2 * SB_RING_SURFACES];   // their material angles, rising
  double by[2 * SB_RING_SURFACES];    // what is added to them
  int side[2 * SB_RING_SURFACES];     // boundary sides that they lie on
  double *gradient;                   // [4 nodes] deformation gradient, owned
} SbRingShift;

// Finds a ring's contacts, for shifts by nothing; shifts as those of another ring on its mesh are
// displaced. False: there are none to follow.
void sb_ring_shift_begin(SbRingShift *shift, const SbRing *ring);
bool sb_ring_shift_follow(SbRingShift *shift, const SbRing *other);

// Shifts the same contacts on another mesh as those are. False: not the same contacts.
bool sb_ring_shift_like(SbRingShift *shift, const SbRingShift *other);

// Shifts on the mesh of `ring`, of nothing yet; NULL: no memory. `destroy` takes NULL.
SbRingShift *sb_ring_shift_create(const SbRing *ring);
void sb_ring_shift_destroy(SbRingShift *shift);

// What is added to a node's reference and deformed place; to the angle of one on the boundary.
void sb_ring_shift_node(const SbRingShift *shift, const SbRing *ring, int node, double x[2],
                        double place[2]);
double sb_ring_shift_angle(const SbRingShift *shift, double angle);

// Size of the elements that sb_ring_fit() takes for a tolerance.
double sb_ring_fit_size(const SbRingBody *body, const SbRingLoad *load, double tolerance);

// Leaves the meshes of a tangent's states with the material, as that of sb_ring_near() is.
void sb_ring_tangent_stay(SbRingTangent *tangent);

// A ring of another body at another load, not solved: on the mesh of `ring`, moved, and shifted
// unless `shift` is NULL, in its place on the floor, with its contact. Owned.
// SB_ERROR_NOT_CONVERGED where that one does not slide alike.
SbStatus sb_ring_lay(SbRing **out, const SbRing *ring, const SbRingBody *body,
                     const SbRingLoad *load, const SbRingOptions *options, const SbRingShift *shift,
                     SbReport *report);

// What floor friction could change by where friction has dragged a ring to a wall that another load
// displaces, by the share of its travel that this is; 0 where it was laid there.
double sb_ring_travel_fault(const SbRing *ring, const SbRingLoad *target);

// How load steps are taken: followed in viscous steps where the next equilibrium is not near, never
// so, or as long as the bore is touched.
typedef enum { SB_RING_FOLLOW, SB_RING_DIRECT, SB_RING_SEALED } SbRingPath;

// Newton's method with the contact's active set at the load `contact->is.now`; the state is left at
// the last iterate on failure.
SbStatus sb_ring_newton(SbRing *ring, SbRingPath path, SbReport *report);

// Solves at the present load, unless the section turns too far at once; back to the state of
// SB_RING_START where that fails.
SbStatus sb_ring_attempt(SbRing *ring, SbRingPath path, SbReport *report);

// Moves from the present converged load to `target`, in as many steps as it takes. On failure the
// last converged load and state remain, and the report says where equilibrium ended.
SbStatus sb_ring_advance(SbRing *ring, const SbRingLoad *target, SbRingPath path, SbReport *report);

// Fits the ring anew without friction, but for that of clamping walls, at a load, fluid last, on
// its present mesh. Errors as sb_ring_create.
SbStatus sb_ring_fit_and_press(SbRing *ring, const SbRingLoad *smooth, SbReport *report);

// Shifts a ring that neither wall holds to the one that the bore slides to.
void sb_ring_rest_on_wall(SbRing *ring);

// From the present state to another load, leaning on the wall first where the fluid wants it.
SbStatus sb_ring_press(SbRing *ring, const SbRingLoad *target, SbReport *report);

// The turn of the section since it was free, that of all which look the same that is nearest to the
// last one known, and what it changes by a displacement du; NULL: none. Its mean axial place.
double sb_ring_turn(const SbRingContact *contact, const double *du, double *change, double *place);

// How much more softly than usual friction under fluid sets in along an easy path, and along one
// beside friction on floor and walls.
#define SB_RING_EASY 7.0
#define SB_RING_SOFT 3.5

// Follows steady sliding from a state without friction on the bore to a share `aim` of its law, or
// beyond the greatest one that the ring bears: then it rolls or jams, which `state` and
// `share_limit` tell, and the state is that of the greatest. SB_ERROR_NOT_CONVERGED where neither
// is reached.
SbStatus sb_ring_drag(SbRing *ring, double aim, SbReport *report);

// Ends the memory of the state of the greatest friction; `take`: the ring goes back to it.
void sb_ring_end_best(SbRing *ring, bool take);

// From here on the present turn is held, with the share that belongs to it.
void sb_ring_hold_turn(SbRing *ring);

// Tangent of the present state with the bore's nodes set free, factorised; sb_ring_contact_settle
// must follow. SB_ERROR_NOT_CONVERGED.
SbStatus sb_ring_free_bore(SbRing *ring, SbReport *report);
