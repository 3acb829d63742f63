// Rigid surfaces around the ring (ring_groove.c), unilateral contact (ring_contact.c) with Coulomb
// friction (ring_friction.c), and fluid pressure (ring_fluid.c).
//
// Internal to the ring; all quantities in the element solver's units. A boundary node that is held
// by a surface lies on it exactly and may only be pushed; the fluid loads every side of the
// boundary that is not closed by contact, and a node is let go when the contact pushes less than
// the fluid would. So fluid enters exactly as far as the first held node, and contact pressure
// starts there from the fluid's.
#pragma once

#include "engine/contact/ring/ring_fem.h"

typedef enum {
  SB_RING_BORE,
  SB_RING_FLOOR,
  SB_RING_WALL_RIGHT,
  SB_RING_WALL_LEFT,
  SB_RING_SURFACES
} SbRingSurface;

// Where the surfaces stand and what acts, once per load step.
typedef struct {
  double bore, floor;           // radii
  double wall_left, wall_right; // axial places, +-INFINITY: none
  double land_left, land_right; // axial ends of the bore's land, +-INFINITY: none
  double chamfer_slope;         // radial opening per axial length beyond an end of the land
  double edge_length;           // axial length over which the slope sets in
  double pressure_left, pressure_right;
  double slide;                      // axial place of the bore's surface
  double friction[SB_RING_SURFACES]; // Coulomb coefficients
  double traction;                   // given shear on the ring from the bore, replaces Coulomb if
  bool use_traction;                 // use_traction is set
} SbRingSetting;

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

typedef struct {
  SbRingFem *fem; // borrowed
  SbRingSetting now;
  int count;             // boundary nodes
  SbRingTouch *touch;    // [count][SB_RING_SURFACES]
  bool *closed;          // [count / 2] boundary sides closed by contact
  double *share;         // [2 count] force of the fluid that held nodes must exceed
  double *pressed;       // [2 count] the part of it from open sides
  double *weight;        // [count] current area of the boundary nodes
  double *fluid;         // [2 count] fluid force on the open sides' nodes
  int crest[2];          // boundary nodes of bore and floor between which the fluids change sides
  int saved_crest[2][2]; // for sb_ring_contact_save
  bool settled;          // the state stands still: its crests stay
  double *anchor;        // [2 count] place at the start of the step, for sticking
  double slide_start;    // slide at the start of the step
  SbRingTouch *saved[2]; // for sb_ring_contact_save
  double slip_excess;    // departure from Coulomb's law at nodes that could not settle
  double turn;           // of the section since it was free, from +r towards +z, unwrapped
  bool rolls;            // the last step ended because the section would roll on
  double force_scale;    // for tolerances
  int unsteady;          // touch that last changed, -1: none since the solve began
} SbRingContact;

SbStatus sb_ring_contact_create(SbRingContact **out, SbRingFem *fem, SbReport *report);
void sb_ring_contact_destroy(SbRingContact *contact);

// Gap (>= 0 outside), its gradient and its second derivative along z at a place.
double sb_ring_gap(const SbRingSetting *setting, SbRingSurface surface, const double x[2],
                   double gradient[2], double *curvature);

// Unit normal (into the free side) and tangent of a surface at a place, the gap along the normal;
// `curvature` is the normal's turn towards the tangent per axial length.
void sb_ring_frame(const SbRingSetting *setting, SbRingSurface surface, const double x[2],
                   double n[2], double t[2], double *gap, double *curvature);

// The name of a surface, for messages.
const char *sb_ring_surface_name(SbRingSurface surface);

// Deformed place (r, z) of a boundary node.
void sb_ring_contact_place(const SbRingContact *contact, int i, double x[2]);

// Adds the fluid to residual and tangent; renews `closed`, `weight`, `share`, `pressed`, `fluid`.
void sb_ring_contact_load_fluid(SbRingContact *contact);

// Whether a node is held by a surface with Coulomb friction of its own.
bool sb_ring_contact_rubs(const SbRingContact *contact, int i, SbRingSurface surface);

// Relative motion of a boundary node at `x` along t since the start of the step.
double sb_ring_contact_slipped(const SbRingContact *contact, SbRingSurface surface, int i,
                               const double x[2], const double t[2]);

// The first slip state of a node that a surface has just caught.
void sb_ring_contact_begin_friction(SbRingContact *contact, int i, SbRingSurface surface);

// Renews stick and slip, with `single` only at the worst fault; returns how many changed.
int sb_ring_contact_update_slip(SbRingContact *contact, bool single);

// Sum of what exceeds Coulomb's law at sticking nodes and of the friction that is left out.
double sb_ring_contact_slip_excess(const SbRingContact *contact);

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

// Assembles a state that was an equilibrium anew and leaves its conditions and forces, whatever
// attempts to go on from it have left behind.
void sb_ring_contact_settle(SbRingContact *contact);

// Sum of a surface's force on the ring, (r, z).
void sb_ring_contact_total(const SbRingContact *contact, SbRingSurface surface, double force[2]);

// Two places for the touches: 0 is the load stepper's, 1 the one before a walk in
// viscous steps.
void sb_ring_contact_save(SbRingContact *contact, int place);
void sb_ring_contact_restore(SbRingContact *contact, int place);
