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
  double first_peak, first_time; // N, s
  size_t peaks;                  // that followed
  bool stick_slip;               // whether any did
} SbRigCoefficients;

// Samples that a run delivers: floor(duration x rate) + 1.
size_t sb_rig_samples(const SbRig *rig);

// Makes the plate at rest, its thread slack. A sample of the motion at i/rate has the cell's signal
// as drive_force [N], the thread wound up as drive_position and the plate's place as position [m].
// `rig` and `model` must outlive the motion.
SbStatus sb_rig_start(SbDynamics *motion, SbDynamicsModel *model, const SbRig *rig,
                      SbReport *report);

// A signal, computed or measured, as it comes in. A peak is a highest sample from which the force
// falls by more than `prominence` [N] before it rises above it again; take a few times the noise.
// Zero-initialise the rest.
typedef struct {
  double prominence;
  bool falling;                // from a peak to the trough behind it
  double top, trough;          // since then [N]
  double first, others, after; // first peak, sums of the others and of all samples behind it [N]
  size_t count, top_at, first_at, peaks;
} SbRigSignal;

// Takes the next sample; whether it shows that an earlier one, *peak, was a peak.
bool sb_rig_signal_add(SbRigSignal *signal, double force, size_t *peak);

// SB_ERROR_INFEASIBLE if the signal has no first peak; the coefficients are then NaN.
SbStatus sb_rig_coefficients(SbRigCoefficients *out, const SbRigSignal *signal, const SbRig *rig,
                             SbReport *report);

// tau_0 A_a/W as thesis table 7.8 predicts its coefficient (5.14 without m), but under a load on
// flat rings like these: real area at lambda = 0 and the width of a Hertz line contact around each
// ring, w = W/(4 pi D_m), b = sqrt(8 w R/(pi E')) (6.33 corrected). A_a grows with the root of the
// load only, so that the value falls as 1/sqrt(W): it does not carry over from one load to another.
// SI units; `diameter` is the rings' mean diameter.
double sb_rig_contact_coefficient(double load, double diameter, double radius,
                                  double reduced_modulus, double area_share, double shear_strength);
