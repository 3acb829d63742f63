// The thesis' sliding-plate rig: a loaded plate on four rings pulled by a thread, and the friction
// coefficients it reports.
//
// Thesis 3.3-3.4: a motor winds an inelastic thread at constant speed; a load cell in it is read
// 1000 times a second. Static coefficient = the first peak of the force over the load; dynamic
// coefficient = the mean of the stick-slip peaks that follow over the load (3.4.3, fig. 3.12).
// Peaks lie above the mean force, so that the dynamic value is biased upwards: the mean force is
// given beside it. The motion is dynamics.h with one contact a ring; thread, cell and glue are one
// spring that pulls only. SI units. Load, speed and stiffness are not in the thesis: the
// catalogue's rig.* keys say where their defaults come from.
#pragma once

#include "engine/mechanism/dynamics.h"

enum { SB_RIG_RINGS = 4 };

// Dynamic coefficients of thesis table 7.8: measured on the rig, predicted for the valve's seal.
#define SB_RIG_MEASURED_DYNAMIC  0.51
#define SB_RIG_PREDICTED_DYNAMIC 0.4

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

// Samples that a run delivers: floor(duration x rate) + 1.
size_t sb_rig_samples(const SbRig *rig);

// What a sample says to the caller; false stops the rig with SB_ERROR_CANCELLED.
typedef bool (*SbRigEach)(size_t index, const SbDynamicsSample *sample, void *user);

// Pulls the plate and hands every sample to `each` in order: drive_force is the cell's signal [N],
// drive_position the thread wound up, position the plate's [m]. `slip` (may be NULL) gets the first
// slip, kept as it is if there was none; `energy` (may be NULL) the balance at the end.
SbStatus sb_rig_run(const SbRig *rig, SbRigEach each, void *user, SbMotionEvent *slip,
                    SbDynamicsEnergy *energy, SbDynamicsCounters *counters, SbReport *report);

// Coefficients of a signal, computed or measured. A peak is a highest sample from which the force
// falls by more than `prominence` [N] before it rises above it again; take a few times the noise.
// `peak` (may be NULL) gets the samples of the first `peak_max` peaks, the first one included.
// SB_ERROR_INFEASIBLE if the signal has no first peak; the coefficients are then NaN.
SbStatus sb_rig_coefficients(SbRigCoefficients *out, const double *force, size_t count, double rate,
                             double load, double prominence, size_t *peak, size_t peak_max,
                             SbReport *report);

// tau_0 A_a/W as thesis table 7.8 predicts its coefficient (5.14 without m), but under a load on
// flat rings like these: real area at lambda = 0 and the width of a Hertz line contact around each
// ring, w = W/(4 pi D_m), b = sqrt(8 w R/(pi E')) (6.33 corrected). A_a grows with the root of the
// load only, so that the value falls as 1/sqrt(W): it does not carry over from one load to another.
// SI units; `diameter` is the rings' mean diameter.
double sb_rig_contact_coefficient(double load, double diameter, double radius,
                                  double reduced_modulus, double area_share, double shear_strength);
