// What the files of a run's motion share: the valve as a mechanism and its frames (run_valve.c),
// what drives it (run_drive.c), and its figures (run_dynamic.c, run_cycle.c). Private to this
// folder.
#pragma once

#include "engine/mechanism/chamber.h"
#include "engine/mechanism/dynamics.h"
#include "engine/valve/run/run_private.h"

enum { SB_REST_STOP = 0, SB_END_STOP = 1 };

// When the drive does what; all in s.
typedef struct {
  double duration; // of the whole drive: frames are evenly spaced over it
  double turn;     // from then on a reverse slip is the return, before it a rebound
  bool ends_run;   // the run ends with the drive, without waiting for rest
  // Where the platen turns or the finger's force bends, so that a frame sits on every extreme
  // whatever the frames' spacing: in the first period, and so on in all of them.
  int corners;
  double period, first[2];
} SbDriveTimes;

// The valve as the motion sees it; the user of the callbacks of SbDynamicsModel.
typedef struct {
  SbRun *run;
  SbChamber chamber;  // passed on the way
  bool touches;       // the inner seal seals at all
  double edge_open;   // stem displacement behind which the chamber opens on the way in
  double edge_closed; // and closes on the way out
  bool varies[SB_DYNAMICS_EDGES + 1]; // regions in which the land's edge lies under the contact
  double edge[SB_DYNAMICS_EDGES];     // those of the mechanism [m]
  SbDriveTimes times;
  bool ports; // the chamber's pressure is a state, the extra one
  SbChamberModel chamber_model;
  SbDoseChamber dose;
} SbValve;

// Makes the mechanism. The valve must outlive `out`. SB_ERROR_INFEASIBLE if ports contradict each
// other.
SbStatus sb_valve_set_up(SbDynamicsModel *out, SbValve *valve, SbRun *run, SbReport *report);

// The states of contact that stand for an instant.
typedef struct {
  SbChamber chamber;
  int direction;
} SbSolvedState;

// Those of the valve as it is, with the stem's last `direction` of sliding and the chamber's
// pressure [Pa].
SbSolvedState sb_valve_solved(const SbValve *valve, int direction, double pressure);

// Chamber pressure [Pa] in a frame, given the mechanism's extra state.
double sb_valve_chamber_pressure(const SbValve *valve, double extra);

// What a motion says of one instant.
typedef struct {
  SbDynamicsSample sample; // acceleration, deflections and region need not be known
  SbStage stage;           // last passed
  SbChamber chamber;
  SbSolvedState solved;
  bool moving;     // the stem slides
  double pressure; // in the chamber [Pa]
} SbInstant;

// Its frame: forces are the sample's, contact, load and film those of the solved states, the film
// at the sample's speed; with ports between those of the vented and of the filled chamber.
void sb_run_fill_frame(SbFrame *out, const SbRun *run, const SbInstant *at);

// Film at a speed [m/s] over that of the states, by the law's exponent about it.
double sb_run_film_at(const SbRun *run, double speed);

// Makes the first `count` frames visible and tells the progress every now and then; true: stop.
bool sb_run_poll(SbRun *run, const SbRunHooks *hooks, size_t count, double fraction,
                 SbReport *report);

// The constrained parts (run_bodies.c). Assembles them, counts their freedom, and makes room for
// the frames' reactions.
SbStatus sb_run_bodies_create(SbRun *run, SbReport *report);

// Mass that the stroke sees as assembled [kg].
double sb_run_bodies_mass(const SbRunBodies *bodies);

// Moves the parts to displacement x [m] with the stem at speed v [m/s]; the mass that the stroke
// sees there [kg]. SB_ERROR_INFEASIBLE where the parts do not move as one.
SbStatus sb_run_bodies_move(double *mass, SbRun *run, double x, double v, SbReport *report);

// Reactions of the joints for the frame at `index`; adds to the summary. Moves the parts there.
SbStatus sb_run_bodies_frame(SbRun *run, size_t index, const SbDynamicsSample *sample,
                             SbReport *report);

// Sets what drives the mechanism, where it starts, and the drive's times.
void sb_valve_set_drive(SbDynamicsModel *out, SbDriveTimes *times, const SbRun *run);

// Corner `index`; INFINITY behind the last.
double sb_drive_corner(const SbDriveTimes *times, int index);
