// What the files of a run with inertia share: the valve as a mechanism (run_valve.c), what drives
// it (run_drive.c), and its frames and figures (run_dynamic.c). Private to this folder.
#pragma once

#include "engine/mechanism/chamber.h"
#include "engine/mechanism/dynamics.h"
#include "engine/valve/run/run_private.h"

enum { SB_REST_STOP = 0, SB_END_STOP = 1 };

// The valve as the motion sees it; the user of the callbacks of SbDynamicsModel.
typedef struct {
  SbRun *run;
  SbChamber chamber;  // passed on the way
  bool touches;       // the inner seal seals at all
  double edge_open;   // stem displacement behind which the chamber opens on the way in
  double edge_closed; // and closes on the way out
  bool varies[SB_DYNAMICS_EDGES + 1]; // regions in which the land's edge lies under the contact
  double edge[SB_DYNAMICS_EDGES];     // those of the mechanism
  bool ports;                         // the chamber's pressure is a state, the extra one
  SbChamberModel chamber_model;
  SbDoseChamber dose;
} SbValve;

// Makes the mechanism. The valve must outlive `out`. SB_ERROR_INFEASIBLE if ports contradict each
// other.
SbStatus sb_valve_set_up(SbDynamicsModel *out, SbValve *valve, SbRun *run, SbReport *report);

// Contact, load and film of a seal for a frame; `pressure` is the chamber's [Pa], used with ports.
void sb_valve_fill_seal(SbSealFrame *out, const SbValve *valve, int seal, int direction,
                        bool moving, double s, double pressure);

// Chamber pressure [Pa] in a frame, given the mechanism's extra state.
double sb_valve_chamber_pressure(const SbValve *valve, double extra);

// The sliding state of a seal that stands for the present chamber and direction.
const SbSliding *sb_valve_state(const SbValve *valve, int seal, int direction, double pressure);

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

// Sets what drives the mechanism, and where it starts.
void sb_valve_set_drive(SbDynamicsModel *out, const SbRun *run);

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
SbDriveTimes sb_drive_times(const SbRun *run);

// Corner `index`; INFINITY behind the last.
double sb_drive_corner(const SbDriveTimes *times, int index);
