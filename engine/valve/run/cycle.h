// The quasi-static cycle A to F of a valve in a test machine, as segments between events.
//
// The platen moves at constant speed against the end stop up to the reversal force, and back. A
// spring k that only pushes couples platen and stem. The forces on the stem balance at every
// instant (thesis section 5.2; inertia is negligible at 20 mm/min):
//
//   in-stroke  k (X - s) = F_p + f(s)      return  k (X - s) = F_p - f(s) >= 0
//
// Use: set SbCycle.model and state, sb_cycle_build(), then the functions that evaluate. X is the
// platen's position (> 0 into the canister, 0 at the start), s the stem's displacement, f the
// seals' friction (a magnitude), F_p the force that pushes the stem out: canister pressure, and F_0
// + k_r s of a return spring with preload F_0 and stiffness k_r. f changes while the inner seal
// passes the edge of the bore land: its contact [l, r] then extends over x > x_e only, x_e = l_in +
// (s - s_C), with the left edge l_in of the contact on the in-stroke and the displacement s_C of
// stage C. The part of friction proportional to the width falls linearly, that proportional to the
// load as the integral of an elliptic pressure. The stem sticks up to the static friction after the
// rest before A, and up to the kinetic friction where it stops during a stroke (without dwell the
// contact keeps its film).
//
// On the return the stem sticks permanently at the first position where the static friction after
// the dwell at the end stop reaches F_p, because so slow a motion can come to rest anywhere. While
// the stem slides back the force on the platen is F_p - f with kinetic friction. If the resistance
// falls faster than the spring relaxes, the stem jumps to the next balance at constant X, and the
// released energy counts as dissipated in the seal. Both stops are rigid. All events are located
// exactly; there are no time steps.
//
// A cycle is used by one thread while it is built, and may then be read by several.
#pragma once

#include "engine/valve/run/frame.h"
#include "engine/valve/states/sliding.h"

// Directions of sliding, as indices: in-stroke (speed > 0), return.
enum { SB_CYCLE_IN = 0, SB_CYCLE_OUT = 1 };

// Number of chamber states (SbChamber), and capacity of segments.
enum { SB_CYCLE_CHAMBERS = 3, SB_CYCLE_SEGMENTS_MAX = 96 };

// Motion in a segment.
typedef enum {
  SB_CYCLE_STICK, // the stem does not move
  SB_CYCLE_SLIP,  // the stem slides in balance
  SB_CYCLE_JUMP   // the stem jumps at constant X
} SbCycleMode;

// A segment between two events.
typedef struct {
  SbCycleMode mode;
  int direction;           // of sliding, SB_CYCLE_IN or SB_CYCLE_OUT; STICK: of the last sliding
  int platen;              // +1: the platen advances, -1: it returns
  SbChamber chamber;       // during the segment
  SbStage stage;           // last event passed
  double platen0, platen1; // X at start and end [m]
  double stem0, stem1;     // s at start and end [m]
  double friction0; // STICK: friction on the stem at the start, > 0 against the in-stroke [N]
  int event;        // SbStage of the event at its end, -1: none
} SbCycleSegment;

// A cycle. The caller sets `model` and `state` before sb_cycle_build(), which sets all other
// fields.
typedef struct {
  const SbModel *model; // borrowed
  // Steady states by seal, SbChamber and motion (SB_CYCLE_IN, SB_CYCLE_OUT, 2 at rest). A cycle
  // needs those of sliding, in all chamber states that it can reach, except of the inner seal in
  // SB_CHAMBER_OPEN.
  SbSealState state[SB_SEAL_COUNT][SB_CYCLE_CHAMBERS][SB_RUN_MOTIONS];
  // Their kinetic friction includes its error, and so must that of states at other speeds.
  bool kinetic_error_added;
  size_t count; // number of segments
  SbCycleSegment segment[SB_CYCLE_SEGMENTS_MAX];
  // Static friction of a full contact on the return, after the dwell at the end stop [N]; set by
  // sb_cycle_rest().
  double hold[SB_SEAL_COUNT][SB_CYCLE_CHAMBERS];
  double platen_top; // X at reversal [m]
  double stem_top;   // largest displacement of the stem [m]
  double stem_end;   // displacement of the stem at the end of the cycle [m]
  double dwell;      // time between the end of the in-stroke and the first reverse slip [s]
} SbCycle;

// Computes the segments, the static friction after the dwell (`hold`), and the positions. They do
// not depend on the fields that it sets. SB_ERROR_NOT_CONVERGED: more than SB_CYCLE_SEGMENTS_MAX
// segments, or a contact ages as fast as the machine loads it; the first `count` segments are then
// valid.
SbStatus sb_cycle_build(SbCycle *cycle, SbReport *report);

// The part of a seal's contact that is on the land: fractions of its width and of its load.
typedef struct {
  double width, load; // 0 (off the land, or no contact) to 1 (all of it)
} SbLandShare;

// Returns these fractions of `seal` at the stem displacement s [m], for the state of `chamber` and
// `direction` (SB_CYCLE_IN, SB_CYCLE_OUT).
SbLandShare sb_cycle_land_share(const SbCycle *cycle, int seal, SbChamber chamber, int direction,
                                double s);

// Returns the magnitude of the kinetic friction of one seal at the stem displacement s [m], for the
// state of `chamber` and `direction` [N].
double sb_cycle_seal_friction(const SbCycle *cycle, int seal, SbChamber chamber, int direction,
                              double s);

// Returns the sum of sb_cycle_seal_friction() of both seals [N].
double sb_cycle_friction(const SbCycle *cycle, SbChamber chamber, int direction, double s);

// Returns the stem displacement [m] at the platen position X [m] in `segment`.
double sb_cycle_stem(const SbCycle *cycle, const SbCycleSegment *segment, double X);

// Returns ds/dX at the stem displacement s [m] in `segment`; 0 in STICK and JUMP; at most 1000.
double sb_cycle_stem_rate(const SbCycle *cycle, const SbCycleSegment *segment, double s);

// Returns the force of the platen on the stem, k (X - s), at least 0 [N].
double sb_cycle_force(const SbCycle *cycle, double X, double s);

// Returns the friction force on the stem at the platen position X [m] and the stem displacement s
// [m] in `segment`, > 0 against the in-stroke [N]. In a STICK segment it is the value that balances
// the other forces; at a stop it remains friction0, and the stop carries the remaining force,
// written to *stop_force, > 0 if it pushes the stem out [N], else 0.
double sb_cycle_balance(const SbCycle *cycle, const SbCycleSegment *segment, double X, double s,
                        double *stop_force);

// Returns the static friction limit of one seal at the stem displacement s [m] after the rest
// before A, a magnitude [N].
double sb_cycle_static_friction(const SbCycle *cycle, int seal, SbChamber chamber, int direction,
                                double s);

// Returns the stem displacement at which the land's edge reaches the left end of the inner contact
// (gasket: the shoulder reaches its right end) [m].
double sb_cycle_edge_begin(const SbCycle *cycle, SbChamber chamber, int direction);

// Returns the stem displacement at which the inner contact has left the land on the in-stroke
// (chamber at rest), or reaches it on the return (chamber closed); in a gasket valve, at which the
// full contact is on the shoulder [m].
double sb_cycle_edge_end(const SbCycle *cycle, SbChamber chamber, int direction);

// Sets cycle->hold for a `dwell` [s] at the end stop, for motions other than sb_cycle_build(),
// which calls it itself. `model` and `state` must be set. SB_ERROR_MEMORY is its only error.
SbStatus sb_cycle_rest(SbCycle *cycle, double dwell, SbReport *report);

// Returns F_p minus the friction that a stem at rest at s [m] must overcome to slide back [N]; < 0:
// it sticks. The friction is the larger one of static friction (cycle->hold, set by
// sb_cycle_rest()) and kinetic friction, for each seal.
double sb_cycle_reserve(const SbCycle *cycle, SbChamber chamber, double s);

// Returns sb_cycle_reserve() at the beginning of the return from the displacement `top` [m], for
// the chamber state there [N].
double sb_cycle_first_reserve(const SbCycle *cycle, double top);

// Returns the minimum of F_p - f with kinetic friction over the return from `top` [m] to 0 [N].
double sb_cycle_sliding_margin(const SbCycle *cycle, double top);

// Returns the minimum of sb_cycle_reserve() over the return from `top` [m] to 0 [N]: the return
// margin of a stem that may stop anywhere. With ports both the vented and the full chamber are
// considered.
double sb_cycle_static_margin(const SbCycle *cycle, double top);

// Returns the closure of an energy balance, relative to its largest work: `residual`, or 0 if it is
// rounding, at most 1e-10 of a sum of some thousand products.
double sb_cycle_closure(double residual);

// Computes the energies of a built cycle, each by its own quadrature, so that `closure` checks the
// motion; `kinetic` and `stop` are 0.
void sb_cycle_energy(const SbCycle *cycle, SbEnergy *out);
