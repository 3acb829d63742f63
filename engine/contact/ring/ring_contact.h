// Rigid surfaces around the ring (ring_groove.c), unilateral contact with friction
// (ring_contact.c), and fluid pressure (ring_fluid.c). Private to engine/contact/ring.
//
// All quantities, also of loads, are in the units of the element solver: lengths in section
// diameters, stresses in initial shear moduli. A boundary node in contact ("held") is exactly on
// the surface and can only be pushed. The fluid loads every side of the boundary that is not closed
// by contact; a node is released if the contact pushes less than the fluid would. So the fluid
// extends to the first node in contact, where the contact pressure equals the fluid's. Vectors and
// positions are (r, z), z = x of ring.h. Boundary nodes ("loop nodes") are those of
// SbRingMesh.loop; boundary side k, 0 to count/2 - 1, has the loop nodes 2 k, 2 k + 1 (mid-side)
// and 2 k + 2.
//
// One iteration: sb_ring_fem_assemble(), sb_ring_contact_apply(), sb_ring_fem_solve(),
// sb_ring_fem_advance(), sb_ring_contact_update(); at convergence sb_ring_contact_forces().
#pragma once

#include "engine/contact/ring/ring.h"
#include "engine/contact/ring/ring_fem.h"

// The rigid surfaces.
typedef enum {
  SB_RING_BORE,
  SB_RING_FLOOR,
  SB_RING_WALL_RIGHT,
  SB_RING_WALL_LEFT,
  SB_RING_SURFACES
} SbRingSurface;

// Geometry of a surface at a position.
typedef struct {
  double n[2], t[2]; // unit normal into the free side, unit tangent (r, z)
  double gap;        // distance along the normal, > 0 outside the surface
  double curvature;  // turn of the normal towards the tangent per length along `axis`
  int axis;          // 0 r, 1 z: direction in which the surface extends
} SbRingFrame;

// Contact pair: a boundary node and a surface.
typedef struct {
  bool held;             // in contact
  bool smooth;           // without friction in this solve
  signed char slip;      // 0: sticks; +1, -1: slides, friction force on the ring along +t, -t
  unsigned char flips;   // changes of the slip state in this solve
  unsigned char catches; // number of times that contact began in this solve
  double force;          // normal contact force on the ring, >= 0
  double tangent;        // tangential contact force on the ring along t
} SbRingTouch;

// State of the contact in addition to the displacements.
typedef struct {
  SbRingLoad now; // present load, set once per load step
  double turn;    // rotation of the section since it was free, from +r to +z, unwrapped [rad]
  int crest[2];   // boundary nodes that separate the left from the right fluid: of the bore; of the
                  // floor, or of a wall if the ring has left the floor or has none
  double excess;  // lobed section: largest bore pressure minus the fluid's at the start of the last
                  // solve; else infinite
  SbRingTouch *touch; // [count][SB_RING_SURFACES] contact pairs
} SbRingContactState;

// Places of saved states, also of sb_ring_fem_save(): the start of a load step or of a part of it,
// from which friction measures the motion; the state before an attempt of several steps.
enum { SB_RING_START = 1, SB_RING_BEFORE = 2 };

// The contact of a ring.
typedef struct {
  SbRingFem *fem;                  // borrowed
  int count;                       // boundary nodes
  SbRingContactState is, saved[3]; // present state; saved states
  bool *closed;                    // [count / 2] boundary sides closed by contact
  double *share;   // [count][2] fluid force that the contact force of a node must exceed
  double *pressed; // [count][2] part of `share` that is due to open sides
  double *fluid;   // [count][2] fluid force on nodes of open sides
  double *weight;  // [count] present area of the boundary nodes
  double *wet;     // [count / 2] fluid pressure at the sides, closed or not
  bool lobes;      // contacts may have several maxima: the fluid ends at the first node in contact
  bool settled;    // `crest` does not change
  bool fixed;      // contact pairs and slip states do not change
  bool carried;    // the state is from another mesh: the first iterations are `stuck`
  bool stuck;      // every node in contact keeps its position
  bool passed;     // oscillating nodes stay in contact against a small tension
  double onset;    // range over which friction under fluid develops, divided by the usual one
  double slid;     // distance that sliding nodes may go back before they stick
  double slip_excess; // deviation from Coulomb's law at nodes whose state oscillates
  double force_scale; // typical force, to which tolerances are relative
  double folded;      // largest depth of self-penetration
  unsigned folds;     // hash of the nodes that penetrate another part of the section
  double stress;      // unit of stress [Pa]
  int unsteady;       // contact pair that changed last; -1: none in this solve
} SbRingContact;

// Creates the contact of a model, without contact pairs in contact. `fem` is borrowed. The caller
// then sets `stress`, `lobes` and `force_scale` (initially 0, false, 1), and is.now to the load in
// the units of the element solver.
SbStatus sb_ring_contact_create(SbRingContact **out, SbRingFem *fem, SbReport *report);

// Frees the contact.
void sb_ring_contact_destroy(SbRingContact *contact);

// Returns the loop index 0 to count - 1 of any integer i (periodic).
static inline int sb_ring_wrap(const SbRingContact *contact, int i) {
  int count = contact->count;
  return i >= 0 && i < count ? i : (i % count + count) % count;
}

// Returns the contact pair of loop node i (periodic) and a surface; borrowed.
static inline SbRingTouch *sb_ring_touch(const SbRingContact *contact, int i, int surface) {
  return &contact->is.touch[SB_RING_SURFACES * sb_ring_wrap(contact, i) + surface];
}

// Writes the deformed position (r, z) of loop node i to x[2].
static inline void sb_ring_contact_place(const SbRingContact *contact, int i, double x[2]) {
  sb_ring_fem_place(contact->fem, contact->fem->mesh->loop[sb_ring_wrap(contact, i)], x);
}

// Returns the geometry of a surface of `load` at the position x (r, z).
SbRingFrame sb_ring_frame(const SbRingLoad *load, SbRingSurface surface, const double x[2]);

// Returns the geometry of a surface at loop node i.
SbRingFrame sb_ring_frame_at(const SbRingContact *contact, int i, SbRingSurface surface);

// Returns the name of a surface, for messages; static.
const char *sb_ring_surface_name(SbRingSurface surface);

// Returns the friction coefficient of a surface (factor of the bore's law); 0 if its traction is
// prescribed.
double sb_ring_friction(const SbRingLoad *load, SbRingSurface surface);

// Returns whether any surface has friction or a prescribed traction.
bool sb_ring_has_friction(const SbRingLoad *load);

// Returns the load with lengths divided by `length` and pressures by `pressure`.
SbRingLoad sb_ring_load_in(const SbRingLoad *load, double length, double pressure);

// Returns the load reflected at x = 0.
SbRingLoad sb_ring_load_mirrored(const SbRingLoad *load);

// Position of an end of the land that touches nothing [section diameters].
#define SB_RING_REACH 1.5

// Returns the load interpolated between a (t = 0) and b (t = 1); discrete fields are those of b. A
// land end that is infinite in one of them is taken at SB_RING_REACH.
SbRingLoad sb_ring_load_between(const SbRingLoad *a, const SbRingLoad *b, double t);

// Returns whether the deformed boundary intersects itself outside its concavities, where
// self-contact is not modelled.
bool sb_ring_crosses_itself(const SbRingContact *contact);

// Adds the self-contact of concavities to residual and tangent of contact->fem, after assembly
// (called by sb_ring_contact_apply()). Returns the largest penetration.
double sb_ring_fold_apply(SbRingContact *contact);

// Critical value of sb_ring_crease() for creases of a neo-Hookean surface: Hong, Zhao and Suo,
// Appl. Phys. Lett. 95, 111901 (2009); plane: at a stretch of 0.65, also measured (Cai and others,
// Soft Matter 8, 1301, 2012). Biot's wrinkles need 3.4.
#define SB_RING_CREASE 2.4

// Returns the maximum of (lambda_1^2 lambda_3)^-1 over the free surface, with the stretches
// lambda_1 along the section's outline and lambda_3 around the ring.
double sb_ring_crease(const SbRingContact *contact);

// Adds the fluid pressure to residual and tangent of contact->fem (called by
// sb_ring_contact_apply()); recomputes is.crest (unless `settled`), `closed`, `wet`, `weight`,
// `share`, `pressed`, `fluid`.
void sb_ring_contact_load_fluid(SbRingContact *contact);

// Returns whether the right fluid is at a boundary side, according to `crest`.
bool sb_ring_contact_on_right(const SbRingContact *contact, int side);

// Pressure on a boundary side: p = value + slope (z - z0), z0 the axial position of the side's
// first node.
typedef struct {
  double value, slope; // pressure; pressure/length
  bool fixed; // fixed in space (force per axial length is constant); else it follows the surface
} SbRingSidePressure;

// Computes the forces of a pressure on the three nodes of side `side`, force[node][(r, z)]; minus
// their derivatives with respect to the nodes' positions, tangent[node][component of the
// force][node][component of the position]; and the nodes' parts of the side's area.
void sb_ring_side_load(const SbRingContact *contact, int side, SbRingSidePressure pressure,
                       double force[3][2], double tangent[3][2][3][2], double area[3]);

// Computes the derivative of the area of node `a` of a side with respect to the positions of its
// nodes.
void sb_ring_side_area_slope(const SbRingContact *contact, int side, int a, double slope[3][2]);

// Friction force of a node by the full law of a surface (Coulomb with coefficient 1), and its
// derivatives with respect to normal force, area and fluid force of the node.
typedef struct {
  double force, by_normal, by_area, by_fluid;
} SbRingGrip;

// Returns the friction at loop node i for a total `normal` force, of which the fluid has the part
// `fluid`.
SbRingGrip sb_ring_grip(const SbRingContact *contact, int i, SbRingSurface surface, double normal,
                        double fluid);

// Returns the fluid force on loop node i along the normal n, which its contact force must exceed.
double sb_ring_fluid_at(const SbRingContact *contact, int i, const double n[2]);

// Returns whether loop node i sticks on a surface by Coulomb friction.
bool sb_ring_contact_sticks(const SbRingContact *contact, int i, SbRingSurface surface);

// Sets `held` of every contact pair to whether the node is on or inside the surface, and its slip
// state to 0.
void sb_ring_contact_detect(SbRingContact *contact);

// Resets the counters of slip changes before a solve.
void sb_ring_contact_begin(SbRingContact *contact);

// Adds fluid and self-contact to residual and tangent of contact->fem and sets the nodes'
// conditions, after assembly. Returns the largest gap or penetration of a node in contact.
double sb_ring_contact_apply(SbRingContact *contact);

// Returns the largest factor, at most 1, by which the correction fem->du may be applied: nodes in
// contact with curved surfaces must not move too far for the linear model. Call it after
// sb_ring_fem_solve().
double sb_ring_contact_limit(const SbRingContact *contact);

// Updates contact pairs and slip states from the reactions of the linear model, after
// sb_ring_fem_solve() and sb_ring_fem_advance(). Returns the number of changes. With `single` only
// the worst pair of each kind changes.
int sb_ring_contact_update(SbRingContact *contact, bool single);

// Computes the forces of all contact pairs from the residual, at convergence. Call it once after
// sb_ring_contact_apply(): it moves `pressed` from `share` to `fluid`.
void sb_ring_contact_forces(SbRingContact *contact);

// Returns the sum of forces by which a state violates its active set: tension of nodes in contact,
// penetration of others, friction beyond the limit of sticking nodes, reversed motion of sliding
// nodes. Lengths count with a stiffness of one.
double sb_ring_contact_fault(const SbRingContact *contact);

// Assembles a state in equilibrium again, so that conditions and forces are those of the state,
// after failed attempts to continue from it. Saves it as SB_RING_START.
void sb_ring_contact_settle(SbRingContact *contact);

// Saves the full state (`is` and the displacements) in the place SB_RING_START or SB_RING_BEFORE.
void sb_ring_save(SbRingContact *contact, int place);

// Restores the full state from the place SB_RING_START or SB_RING_BEFORE.
void sb_ring_restore(SbRingContact *contact, int place);
