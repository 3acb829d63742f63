// The quasi-static cycle A to F of a valve in a test machine, as a list of segments between events.
//
// The platen moves at constant speed, against the end stop up to the reversal force, and back;
// machine and stem are coupled by a spring k that pushes but does not pull. At every instant the
// forces on the stem balance (thesis section 5.2; inertia is nil at 20 mm/min):
//
//   in-stroke  k (X - s) = F_p + f(s)      return  k (X - s) = F_p - f(s) >= 0
//
// with F_p = F_canister + F_0 + k_r s where a return spring acts, X the platen, s the stem, and f
// the seals' friction, which changes while the inner seal passes the edge of the bore land: its
// contact [l, r] then only reaches over x > x_e, x_e = l_in + (s - s_C), l_in that of the
// in-stroke; the width-bound part of its friction falls linearly, the load-bound part as an
// elliptic pressure integrates. Stuck means no motion until the limit is passed: the static
// friction after the rest before A, the kinetic one where the stem stops on the way, for without
// dwell the contact keeps its film (the thesis sees the peak on the first motion only).
//
// On the return the stem sticks for good at the first place where the static friction after the
// dwell at the end stop reaches F_p: a motion this slow can rest at every place, and a stem that
// rests there is not released. The force on the platen while the stem slides back remains
// F_p - f with kinetic friction, which the thesis measures. Where the
// resistance falls faster than the spring relaxes the stem jumps to the next balance at constant X,
// and the energy set free is counted as lost in the seal. End stop and rest stop are rigid.
//
// Everything is located exactly: slip onset, edge, stop, reversal, jumps. Nothing here steps in
// time.
#pragma once

#include "engine/valve/frame.h"
#include "engine/valve/sliding.h"

// Directions of sliding, as indices: the in-stroke (speed > 0), the return.
enum { SB_CYCLE_IN = 0, SB_CYCLE_OUT = 1 };
enum { SB_CYCLE_CHAMBERS = 3, SB_CYCLE_SEGMENTS_MAX = 96 };

typedef enum {
  SB_CYCLE_STICK, // the stem does not move; s0 = s1
  SB_CYCLE_SLIP,  // the stem slides in balance
  SB_CYCLE_JUMP   // the stem jumps at constant X
} SbCycleMode;

typedef struct {
  SbCycleMode mode;
  int direction;     // of sliding, SB_CYCLE_IN or SB_CYCLE_OUT; for STICK that of the last sliding
  int platen;        // +1 advancing, -1 returning
  SbChamber chamber; // throughout the segment
  SbStage stage;     // last event passed
  double platen0, platen1; // X at start and end [m]
  double stem0, stem1;     // s at start and end [m]
  double friction0;        // STICK: friction on the stem at its start [N]
  int event;               // SbStage of the event at its end, -1 if none
} SbCycleSegment;

typedef struct {
  const SbModel *model;
  // Steady states that it is made of.
  SbSealState state[SB_SEAL_COUNT][SB_CYCLE_CHAMBERS][SB_RUN_MOTIONS];
  size_t count;
  SbCycleSegment segment[SB_CYCLE_SEGMENTS_MAX];
  // Static friction on the return of a full contact, after the dwell at the end stop [N];
  // sb_cycle_rest() sets it.
  double hold[SB_SEAL_COUNT][SB_CYCLE_CHAMBERS];
  double platen_top; // X at reversal [m]
  double stem_top;   // largest displacement of the stem [m]
  double stem_end;   // displacement of the stem at the end of the cycle [m]
  double dwell;      // time between the end of the in-stroke and the first reverse slip [s]
} SbCycle;

// Plans the segments for `model` and `state` (filled by the caller for every entry that can be
// needed).
// SB_ERROR_NOT_CONVERGED if the events do not end within SB_CYCLE_SEGMENTS_MAX.
SbStatus sb_cycle_build(SbCycle *cycle, SbReport *report);

// Share of a seal's contact width and of its load that lie on the land, at stem displacement s.
typedef struct {
  double width, load; // [1]
} SbLandShare;
SbLandShare sb_cycle_land_share(const SbCycle *cycle, int seal, SbChamber chamber, int direction,
                                double s);

// Kinetic friction of one seal and of both, magnitude [N].
double sb_cycle_seal_friction(const SbCycle *cycle, int seal, SbChamber chamber, int direction,
                              double s);
double sb_cycle_friction(const SbCycle *cycle, SbChamber chamber, int direction, double s);

// Stem displacement of `segment` at platen position X (inside the segment).
double sb_cycle_stem(const SbCycle *cycle, const SbCycleSegment *segment, double X);

// ds/dX at stem displacement s of `segment`: how much of the platen's motion the stem makes.
double sb_cycle_stem_rate(const SbCycle *cycle, const SbCycleSegment *segment, double s);

// Force k (X - s) on the stem, not below zero.
double sb_cycle_force(const SbCycle *cycle, double X, double s);

// Friction force on the stem at a point of a segment, positive against the in-stroke [N]; in STICK
// what balance needs within the limits, the rest being carried by a stop: `stop_force`, positive
// pushes out.
double sb_cycle_balance(const SbCycle *cycle, const SbCycleSegment *segment, double X, double s,
                        double *stop_force);

// Static limit of one seal at a place [N].
double sb_cycle_static_friction(const SbCycle *cycle, int seal, SbChamber chamber, int direction,
                                double s);

// Stem displacements at which the land's edge reaches the left end of the inner contact, and at
// which that contact has left the land on the way in (chamber at rest) or meets it on the way out
// (chamber closed).
double sb_cycle_edge_begin(const SbCycle *cycle, SbChamber chamber, int direction);
double sb_cycle_edge_end(const SbCycle *cycle, SbChamber chamber, int direction);

// Sets `hold` for a dwell [s]. The states of both seals must be solved. SB_ERROR_MEMORY.
SbStatus sb_cycle_rest(SbCycle *cycle, double dwell, SbReport *report);

// Returns what the push exceeds the friction by that a stem at rest at s must overcome to slide
// back [N]: the static friction of sb_cycle_rest(), or the kinetic one where that is larger.
double sb_cycle_reserve(const SbCycle *cycle, SbChamber chamber, double s);

// Returns the same at the begin of the return, from displacement `top` [N].
double sb_cycle_first_reserve(const SbCycle *cycle, double top);

// Returns the minimum of F_p - f with kinetic friction over the return path from displacement `top`
// to 0 [N], whatever moves the stem.
double sb_cycle_sliding_margin(const SbCycle *cycle, double top);

// Returns the minimum of sb_cycle_reserve() over the same path [N]: the return margin of every
// motion. Both chamber states count where ports decide on the chamber's pressure.
double sb_cycle_return_margin(const SbCycle *cycle, double top);

// Energy of the whole cycle, every term by its own quadrature; fills all fields but kinetic (0).
void sb_cycle_energy(const SbCycle *cycle, SbEnergy *out);
