// The valve as a mechanism with one coordinate: run_valve.c, its drive (run_drive.c), its chamber
// (run_ports.c). Private to engine/valve/run. One thread uses a valve; errors need nothing to be
// freed.
#pragma once

#include "engine/valve/run/run_private.h"

// Times of a drive.
typedef struct {
  double duration; // of the whole drive [s]; frames are evenly spaced over it
  double turn;     // a reverse slip after this time is the return, before it a rebound [s]
  bool ends_run;   // the run ends with the drive, without waiting for rest
  int cycles;      // actuations in `duration`
  // Instants at which the platen turns or the slope of the finger's force changes; a frame is
  // placed at each. `first` are those of the first actuation (first[1] = 0: one only); they repeat
  // with `period` until there are `corners`. A drive of one actuation may have `period` = 0.
  int corners;
  double period, first[2]; // [s]
} SbDriveTimes;

// The valve as the motion sees it; user data of the callbacks of SbDynamicsModel.
typedef struct {
  SbRun *run;
  bool both_alike;   // both ways have the same friction at speed 0
  SbChamber chamber; // state of the chamber at the present instant
  bool touches;      // the inner seal has contact
  SbChamberEdges edges;
  double middle; // stem displacement of the middle of B-C and of F-A [m]
  // Cache by chamber state: displacement last requested, and fractions of the inner contact on the
  // land.
  double land_at[SB_CYCLE_CHAMBERS];
  SbLandShare land[SB_CYCLE_CHAMBERS];
  bool varies[SB_DYNAMICS_EDGES + 1]; // regions in which the land's edge is under the contact
  double edge[SB_DYNAMICS_EDGES];     // edges of the mechanism [m]
  SbDriveTimes times;
  bool ports; // the chamber's pressure is an extra state
  SbChamberModel chamber_model;
  SbDoseChamber dose;
} SbValve;

// Sets *valve and *out, the mechanism of the run's model for dynamics.h. *valve is its user data
// and must exist, at its address, as long as *out is used. The states of run->cycle must be solved.
// SB_ERROR_INFEASIBLE: ports without resistance are open to different pressures simultaneously.
SbStatus sb_valve_set_up(SbDynamicsModel *out, SbValve *valve, SbRun *run, SbReport *report);

// Returns the states that apply to the valve's present chamber, with the stem's last `direction` of
// sliding (a way) and the chamber's pressure [Pa].
SbSolvedState sb_valve_solved(const SbValve *valve, int direction, double pressure);

// Returns the chamber pressure [Pa] from the mechanism's extra state `extra`; without ports from
// the state of the chamber.
double sb_valve_chamber_pressure(const SbValve *valve, double extra);

// Returns how close the chamber is to the state of SB_CHAMBER_CLOSED, from 0 (that of
// SB_CHAMBER_AT_REST) to 1, by its pressure [Pa]: one of both states is the full one.
double sb_valve_filling(const SbRun *run, double pressure);

// Returns the direction whose state determines where a chamber's contact meets the land's edge:
// that in which the stem passes the edge in this chamber state.
int sb_valve_passing(SbChamber chamber);

// Returns the fractions of a seal's contact on the land, with the stem at s [m], for the state of
// `chamber` in the direction sb_valve_passing(chamber).
SbLandShare sb_valve_land_share(const SbCycle *cycle, int seal, SbChamber chamber, double s);

// Inserts an edge of the mechanism at x [m] in increasing order. Does nothing if x is not finite or
// is an edge already, or if there are SB_DYNAMICS_EDGES edges.
void sb_valve_add_edge(SbDynamicsModel *out, double x);

// Sets the chamber's ports, their edges and its pressure, for canister.pressure_map = ports.
// sb_valve_set_up() calls it when drive and edges are set. Errors of sb_valve_set_up().
SbStatus sb_valve_set_ports(SbDynamicsModel *out, SbValve *valve, SbReport *report);

// Sets drive and start position in *out, whose mass must be set, and *times. The states of
// run->cycle must be solved.
void sb_valve_set_drive(SbDynamicsModel *out, SbDriveTimes *times, const SbRun *run);
