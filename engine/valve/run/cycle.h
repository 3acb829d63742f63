// The quasi-static cycle A to F of a valve in a test machine, as segments between events.
//
// The platen moves at constant speed against the end stop up to the reversal force, and back. A
// spring k that only pushes couples platen and stem. The forces on the stem balance at every
// instant (thesis section 5.2; inertia is negligible at 20 mm/min):
//
//   in-stroke  k (X - s) = F_p + f(s)      return  k (X - s) = F_p - f(s) >= 0
//
// X is the platen's position, s the stem's displacement, f the seals' friction, F_p the force that
// pushes the stem out: canister pressure, and F_0 + k_r s of a return spring with preload F_0 and
// stiffness k_r. f changes while the inner seal passes the edge of the bore land: its contact
// [l, r] then extends over x > x_e only, x_e = l_in + (s - s_C), with the left edge l_in of the
// contact on the in-stroke and the displacement s_C of stage C. The part of friction proportional
// to the width falls linearly, that proportional to the load as the integral of an elliptic
// pressure. The stem sticks up to the static friction after the rest before A, and up to the
// kinetic friction where it stops during a stroke (without dwell the contact keeps its film).
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
  int platen;              // +1 advancing, -1 returning
  SbChamber chamber;       // during the segment
  SbStage stage;           // last event passed
  double platen0, platen1; // X at start and end [m]
  double stem0, stem1;     // s at start and end [m]
  double friction0;        // STICK: friction on the stem at the start [N]
  int event;               // SbStage of the event at its end, -1: none
} SbCycleSegment;

// A cycle. The caller sets `model` and `state` before sb_cycle_build().
typedef struct {
  const SbModel *model; // borrowed
  // Steady states of the seals by chamber and motion (SB_CYCLE_IN, SB_CYCLE_OUT, at rest).
  SbSealState state[SB_SEAL_COUNT][SB_CYCLE_CHAMBERS][SB_RUN_MOTIONS];
  size_t count;
  SbCycleSegment segment[SB_CYCLE_SEGMENTS_MAX];
  // Static friction of a full contact on the return, after the dwell at the end stop [N]; set by
  // sb_cycle_rest().
  double hold[SB_SEAL_COUNT][SB_CYCLE_CHAMBERS];
  double platen_top; // X at reversal [m]
  double stem_top;   // largest displacement of the stem [m]
  double stem_end;   // displacement of the stem at the end of the cycle [m]
  double dwell;      // time between the end of the in-stroke and the first reverse slip [s]
} SbCycle;

// Computes the segments from `model` and the states that the cycle needs. SB_ERROR_NOT_CONVERGED:
// more than SB_CYCLE_SEGMENTS_MAX segments.
SbStatus sb_cycle_build(SbCycle *cycle, SbReport *report);

// Fractions of a seal's contact width and load on the land.
typedef struct {
  double width, load; // 0 to 1
} SbLandShare;

// Returns these fractions at the stem displacement s [m], for sliding in `direction`.
SbLandShare sb_cycle_land_share(const SbCycle *cycle, int seal, SbChamber chamber, int direction,
                                double s);

// Returns the magnitude of the kinetic friction of one seal at s [N].
double sb_cycle_seal_friction(const SbCycle *cycle, int seal, SbChamber chamber, int direction,
                              double s);

// Returns the magnitude of the kinetic friction of both seals at s [N].
double sb_cycle_friction(const SbCycle *cycle, SbChamber chamber, int direction, double s);

// Returns the stem displacement [m] at the platen position X [m] in `segment`.
double sb_cycle_stem(const SbCycle *cycle, const SbCycleSegment *segment, double X);

// Returns ds/dX at the stem displacement s in `segment`.
double sb_cycle_stem_rate(const SbCycle *cycle, const SbCycleSegment *segment, double s);

// Returns the force of the platen on the stem, k (X - s), at least 0 [N].
double sb_cycle_force(const SbCycle *cycle, double X, double s);

// Returns the friction force on the stem at a point of a segment, > 0 against the in-stroke [N]. In
// a STICK segment it is what the balance needs within the static limits; a stop carries the
// remainder, *stop_force, > 0 if it pushes the stem out.
double sb_cycle_balance(const SbCycle *cycle, const SbCycleSegment *segment, double X, double s,
                        double *stop_force);

// Returns the static friction limit of one seal at s [N].
double sb_cycle_static_friction(const SbCycle *cycle, int seal, SbChamber chamber, int direction,
                                double s);

// Returns the stem displacement at which the land's edge reaches the left end of the inner contact
// [m].
double sb_cycle_edge_begin(const SbCycle *cycle, SbChamber chamber, int direction);

// Returns the stem displacement at which the inner contact has left the land on the in-stroke
// (chamber at rest), or reaches it on the return (chamber closed) [m].
double sb_cycle_edge_end(const SbCycle *cycle, SbChamber chamber, int direction);

// Sets `hold` for a `dwell` [s] at the end stop. The states of both seals must be set.
SbStatus sb_cycle_rest(SbCycle *cycle, double dwell, SbReport *report);

// Returns F_p minus the friction that a stem at rest at s must overcome to slide back [N]: the
// larger one of sb_cycle_rest()'s static and the kinetic friction.
double sb_cycle_reserve(const SbCycle *cycle, SbChamber chamber, double s);

// Returns the same at the beginning of the return from the displacement `top` [N].
double sb_cycle_first_reserve(const SbCycle *cycle, double top);

// Returns the minimum of F_p - f with kinetic friction over the return from `top` to 0 [N].
double sb_cycle_sliding_margin(const SbCycle *cycle, double top);

// Returns the minimum of sb_cycle_reserve() over that path [N], the return margin of every motion.
// With ports the chamber states of both vented and full count.
double sb_cycle_return_margin(const SbCycle *cycle, double top);

// Computes the energies of the cycle, each by its own quadrature; `kinetic` is 0.
void sb_cycle_energy(const SbCycle *cycle, SbEnergy *out);
