// Rigid surfaces around the ring (ring_groove.c), unilateral contact with Coulomb friction
// (ring_contact.c), and fluid pressure (ring_fluid.c).
//
// Internal to the ring; all quantities, those of a load too, in the element solver's units: lengths
// in section diameters, stresses in initial shear moduli. A boundary node that is held by a surface
// lies on it exactly and may only be pushed; the fluid loads every side of the boundary that is not
// closed by contact, and a node is let go when the contact pushes less than the fluid would. So
// fluid enters exactly as far as the first held node, and contact pressure starts there from the
// fluid's.
#pragma once

#include "engine/contact/ring/ring.h"
#include "engine/contact/ring/ring_fem.h"

typedef enum {
  SB_RING_BORE,
  SB_RING_FLOOR,
  SB_RING_WALL_RIGHT,
  SB_RING_WALL_LEFT,
  SB_RING_SURFACES
} SbRingSurface;

// A surface at a place.
typedef struct {
  double n[2], t[2]; // unit normal into the free side, tangent (r, z)
  double gap;        // along the normal, > 0 outside
  double curvature;  // the normal's turn towards the tangent per length along `axis`
  int axis;          // of r, z: the one that the surface runs along
} SbRingFrame;

// One boundary node against one surface.
typedef struct {
  bool held;
  bool smooth;           // its friction is left out in this solve
  signed char slip;      // 0 sticks; +-1 slides with the friction force on the ring along +-t
  unsigned char flips;   // changes of the slip state in this solve
  unsigned char catches; // times this node was caught in this solve
  double force;          // normal contact force on the ring, >= 0 when held
  double tangent;        // tangential contact force along t
} SbRingTouch;

// What a state of the contact is beside its displacements.
typedef struct {
  SbRingLoad now;     // where the surfaces stand and what acts, once per load step
  double turn;        // of the section since it was free, from +r towards +z, unwrapped, rad
  int crest[2];       // boundary nodes of bore and floor between which the fluids change sides
  double excess;      // of the bore's greatest pressure over the fluid, in shear moduli, where the
                      // last solve of a lobed section began; else infinite
  SbRingTouch *touch; // [count][SB_RING_SURFACES]
} SbRingContactState;

// Places of saved states, those of sb_ring_fem_save: the start of a load step or of a part of it,
// from which friction counts its motion, and the state before an attempt of several of them.
enum { SB_RING_START = 1, SB_RING_BEFORE = 2 };

typedef struct {
  SbRingFem *fem; // borrowed
  int count;      // boundary nodes
  SbRingContactState is, saved[3];
  bool *closed;       // [count / 2] boundary sides closed by contact
  double *share;      // [2 count] force of the fluid that held nodes must exceed
  double *pressed;    // [2 count] the part of it from open sides
  double *fluid;      // [2 count] fluid force on the open sides' nodes
  double *weight;     // [count] current area of the boundary nodes
  double *wet;        // [count / 2] the fluid's pressure on the sides, closed or not
  bool lobes;         // contacts may have several crests: fluid ends at the first that holds it
  bool settled;       // the state stands still: its crests stay
  bool fixed;         // the held set and the slip states stay
  bool carried;       // from another mesh: while they do, the first iterations are stuck,
  bool stuck;         // that is, every held node stays at its place
  bool passed;        // nodes that come and go stay held against a small pull
  double onset;       // of friction under fluid, over the usual one
  double slid;        // how far sliding nodes may go back before they stick: what they came
  double slip_excess; // departure from Coulomb's law at nodes that could not settle
  double force_scale; // for tolerances
  double folded;      // how deep the section is in itself at most
  unsigned folds;     // which nodes are behind which pieces, as a number
  double stress;      // unit of stress, Pa
  int unsteady;       // touch that last changed, -1: none since the solve began
} SbRingContact;

SbStatus sb_ring_contact_create(SbRingContact **out, SbRingFem *fem, SbReport *report);
void sb_ring_contact_destroy(SbRingContact *contact);

// A boundary node in the order of the loop, by any whole number.
static inline int sb_ring_wrap(const SbRingContact *contact, int i) {
  int count = contact->count;
  return i >= 0 && i < count ? i : (i % count + count) % count;
}

static inline SbRingTouch *sb_ring_touch(const SbRingContact *contact, int i, int surface) {
  return &contact->is.touch[SB_RING_SURFACES * sb_ring_wrap(contact, i) + surface];
}

// Deformed place (r, z) of a boundary node.
static inline void sb_ring_contact_place(const SbRingContact *contact, int i, double x[2]) {
  sb_ring_fem_place(contact->fem, contact->fem->mesh->loop[sb_ring_wrap(contact, i)], x);
}

// A surface at a place, and at that of a boundary node.
SbRingFrame sb_ring_frame(const SbRingLoad *load, SbRingSurface surface, const double x[2]);
SbRingFrame sb_ring_frame_at(const SbRingContact *contact, int i, SbRingSurface surface);

// The name of a surface, for messages.
const char *sb_ring_surface_name(SbRingSurface surface);

// Share of a surface's friction law, 0 where its shear is given; whether anything drags the ring.
double sb_ring_friction(const SbRingLoad *load, SbRingSurface surface);
bool sb_ring_rubs(const SbRingLoad *load);

// A load in units of a length and a pressure.
SbRingLoad sb_ring_load_in(const SbRingLoad *load, double length, double pressure);

// The load of the ring that is mirrored in x = 0.
SbRingLoad sb_ring_load_mirrored(const SbRingLoad *load);

// The load at a share t of the way; discrete choices are b's. An end of the land that is set or
// removed comes from or goes to SB_RING_REACH, where it touches nothing.
#define SB_RING_REACH 1.5
SbRingLoad sb_ring_load_between(const SbRingLoad *a, const SbRingLoad *b, double t);

// Whether the deformed boundary crosses itself: contact of the section with itself beside its
// hollows, which nothing here stops.
bool sb_ring_crosses_itself(const SbRingContact *contact);

// After assembly: adds what the sides of a hollow press on each other to residual and tangent.
// Returns how deep a node is behind the other side at most.
double sb_ring_fold_apply(SbRingContact *contact);

// How much more the free surface is stretched across than along, at most, (lambda_1^2 lambda_3)^-1
// with the stretches along the section's outline and around the ring. Rubber that is pressed along
// its surface creases from SB_RING_CREASE on: Hong, Zhao and Suo, Appl. Phys. Lett. 95, 111901
// (2009), flat and neo-Hookean; in the plane at a stretch of 0.65, so measured (Cai and others,
// Soft Matter 8, 1301, 2012). Ripples of every length grow from 3.4 on (Biot).
#define SB_RING_CREASE 2.4
double sb_ring_crease(const SbRingContact *contact);

// Adds the fluid to residual and tangent; renews `closed`, `wet`, `weight`, `share`, `pressed`,
// `fluid`.
void sb_ring_contact_load_fluid(SbRingContact *contact);

// Whether the right fluid stands at a boundary side, beyond the crests over the right flank.
bool sb_ring_contact_on_right(const SbRingContact *contact, int side);

// A pressure on one boundary side, that begins at an even boundary node: p = value + slope (z - z0)
// with z0 the axial place of the side's first node.
typedef struct {
  double value, slope; // Pa, Pa/m
  bool fixed; // in space, its force per length of the axis kept; else it follows the surface
} SbRingSidePressure;

// Forces of the pressure on a side's three nodes, force[node][(r, z)], what they change with the
// nodes' places (subtracted, the tangent's entries), and the nodes' shares of the side's area.
void sb_ring_side_load(const SbRingContact *contact, int side, SbRingSidePressure pressure,
                       double force[3][2], double tangent[3][2][3][2], double area[3]);

// What the share of a side's node `a` of its area changes with the places of its nodes.
void sb_ring_side_area_slope(const SbRingContact *contact, int side, int a, double slope[3][2]);

// Friction force of the whole law of a surface at a boundary node (of Coulomb's with a coefficient
// of 1) under a normal force, of which the fluid has a part, and what it changes with both and with
// the node's area.
typedef struct {
  double force, by_normal, by_area, by_fluid;
} SbRingGrip;
SbRingGrip sb_ring_grip(const SbRingContact *contact, int i, SbRingSurface surface, double normal,
                        double fluid);

// The fluid's force on a node along a normal, which its contact has to exceed.
double sb_ring_fluid_at(const SbRingContact *contact, int i, const double n[2]);

// Whether a node sticks by Coulomb friction of its own.
bool sb_ring_contact_sticks(const SbRingContact *contact, int i, SbRingSurface surface);

// Marks every node that is on or inside a surface as held.
void sb_ring_contact_detect(SbRingContact *contact);

// Before a solve: forgets how often slip states have changed.
void sb_ring_contact_begin(SbRingContact *contact);

// After assembly: adds fluid to residual and tangent, writes the nodes' conditions. Returns the
// largest penetration or gap of a held node.
double sb_ring_contact_apply(SbRingContact *contact);

// After the solve: the share of the correction that held nodes may take where the surface is
// curved, since the linear model ends there.
double sb_ring_contact_limit(const SbRingContact *contact);

// After the solve and the step: new held set and slip states from the linear model's reactions.
// Returns how many changed. With `single` only the worst offender of each kind changes.
int sb_ring_contact_update(SbRingContact *contact, bool single);

// At convergence: forces of all touches from the residual.
void sb_ring_contact_forces(SbRingContact *contact);

// Sum of the forces by which a state violates its active set: held nodes that are pulled, open ones
// inside a surface, stuck ones beyond their friction, sliding ones that go back; the lengths among
// these by a stiffness of one.
double sb_ring_contact_fault(const SbRingContact *contact);

// Assembles a state that was an equilibrium anew and leaves its conditions and forces, whatever
// attempts to go on from it have left behind.
void sb_ring_contact_settle(SbRingContact *contact);

// The whole state, displacements too, to and from one of the places above.
void sb_ring_save(SbRingContact *contact, int place);
void sb_ring_restore(SbRingContact *contact, int place);
