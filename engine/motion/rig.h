// The thesis' sliding-plate rig: a loaded plate on four rings pulled by a thread, and the friction
// coefficients it reports.
//
// Thesis 3.3-3.4: a motor winds an inelastic thread at constant speed; a load cell in it is read
// 1000 times a second. Static coefficient = the first peak of the force over the load; dynamic
// coefficient = the mean of the stick-slip peaks that follow over the load (3.4.3, fig. 3.12).
// Peaks lie above the mean force, so that the dynamic value is biased upwards: the mean force is
// given beside it. The motion is dynamics.h with one contact a ring; thread, cell and glue are one
// spring that pulls only. SI units. Load, speed and stiffness are not in the thesis: ours, in
// sb_rig_defaults.
#pragma once

#include "engine/motion/dynamics.h"

enum { SB_RIG_RINGS = 4 };

typedef struct {
  double load;               // normal load of the whole plate, N
  double mass;               // moved mass, kg
  double coefficient;        // sliding friction over load, before speed and rest act on it
  SbDynamicsContact contact; // law of one ring; stiffness and damping are those of one ring
  double speed;              // of winding, m/s
  double thread_stiffness, thread_damping; // N/m, N s/m
  double rest;                             // s before the motor starts
  double duration;                         // s
  double rate;                             // samples per second
} SbRig;

typedef struct {
  double static_coefficient;  // first peak over load
  double dynamic_coefficient; // mean of the following peaks over load; without any, the mean force
  double mean_coefficient;    // mean force after the first peak over load
  double first_peak, first_time;
  size_t peaks;     // that followed
  bool stick_slip;  // whether any did
  bool found_first; // whether the plate moved at all
} SbRigCoefficients;

// 2 N on 0.204 kg, 1 mm/s, 2 N/mm, 0.4 sliding, 1000 Hz for 5 s.
SbRig sb_rig_defaults(void);

// Samples that a run delivers: floor(duration x rate) + 1.
size_t sb_rig_samples(const SbRig *rig);

// Pulls the plate; force[samples] is the cell's signal [N], position[samples] the plate's (either
// may be NULL); `energy` (may be NULL) the balance at the end.
SbStatus sb_rig_run(const SbRig *rig, double *force, double *position, SbDynamicsEnergy *energy,
                    SbReport *report);

// Coefficients of a signal, computed or measured. A peak is a highest sample from which the force
// falls by more than `prominence` [N] before it rises above it again; take a few times the noise.
// SB_ERROR_INFEASIBLE if the signal has no first peak.
SbStatus sb_rig_coefficients(SbRigCoefficients *out, const double *force, size_t count, double rate,
                             double load, double prominence, SbReport *report);
