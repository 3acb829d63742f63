// The thesis' sliding-plate rig: a loaded plate on four rings pulled by a thread, and its friction
// coefficients. The functions have no state of their own.
//
// Thesis 3.3-3.4: a motor winds a thread at constant speed; a load cell is read 1000 times a
// second. Static coefficient: first peak of the force divided by the load. Dynamic coefficient:
// mean of the following stick-slip peaks divided by the load (3.4.3, fig. 3.12). Peaks exceed the
// mean force, so the dynamic value is biased upwards; the mean is also reported. The motion is that
// of dynamics.h with one contact per ring; thread, cell and glue are one spring that only pulls.
// The rig.* parameters of the catalogue have the data that the thesis does not state.
#pragma once

#include "engine/valve/figures/summary.h"

// Dynamic coefficients of thesis table 7.8: measured on the rig, predicted for the valve's seal.
#define SB_RIG_MEASURED_DYNAMIC  0.51
#define SB_RIG_PREDICTED_DYNAMIC 0.4

// Returns the number of samples of a record: floor(rig->duration rig->rate) + 1.
size_t sb_rig_samples(const SbRig *rig);

// Sets *model and *motion, which own nothing, to the plate at rest with a slack thread. Then
// advance the motion to the times i/rate by sb_dynamics_advance() (dynamics.h); in a sample
// drive_force is the signal of the load cell [N], drive_position the wound length of the thread
// [m], and position that of the plate [m]. `rig` and `model` are borrowed as long as the motion is
// used. SB_ERROR_RANGE, SB_ERROR_INPUT: a value of `rig` is out of range.
SbStatus sb_rig_start(SbDynamics *motion, SbDynamicsModel *model, const SbRig *rig,
                      SbReport *report);

// Peak search in a signal, measured or computed, sample by sample. Initialise with {.prominence =
// ...}, then call sb_rig_signal_add() for each sample, then sb_rig_coefficients(). The other fields
// are state; `first` to `peaks` may be read. A peak is a maximum from which the force falls by more
// than `prominence` before it exceeds the maximum again.
typedef struct {
  double prominence;  // smallest fall that makes a peak [N], >= 0; a few times the noise
  bool falling;       // a peak was found and the force has not yet risen by `prominence`
  double top, trough; // maximum and minimum of the samples since the last change of `falling` [N]
  double first;       // force of the first peak [N]
  double others;      // sum of the other peaks [N]
  double after;       // sum of all samples after the first peak [N]
  size_t count;       // samples so far
  size_t top_at, first_at; // sample numbers (from 0) of `top` and of the first peak
  size_t peaks;            // number of peaks, with the first
} SbRigSignal;

// Adds the next sample [N]. Returns whether it shows that an earlier sample is a peak; then the
// number (from 0) of that sample is written to *peak, else *peak is unchanged.
bool sb_rig_signal_add(SbRigSignal *signal, double force, size_t *peak);

// Computes the coefficients of a completed signal, whose samples are 1/rig->rate apart, for the
// load rig->load; other fields of `rig` are not used. SB_ERROR_INFEASIBLE: no first peak;
// SB_ERROR_RANGE: load or rate is not positive, or fewer than three samples. The coefficients are
// NaN then.
SbStatus sb_rig_coefficients(SbRigCoefficients *out, const SbRigSignal *signal, const SbRig *rig,
                             SbReport *report);

// Returns the friction coefficient tau_0 A_a/W [1] that the surface model predicts (thesis eq. 5.14
// without m) for the plate on SB_RIG_RINGS flat rings: `load` W of the plate [N], mean `diameter`
// D_m of the rings [m], section `radius` R [m], E' [Pa], `area_share` A_a/A at lambda = 0,
// `shear_strength` tau_0 [Pa]. The contact is Hertz's, w = W/(4 pi D_m), b = sqrt(8 w R/(pi E'))
// (6.33 corrected). The result is proportional to 1/sqrt(W).
double sb_rig_contact_coefficient(double load, double diameter, double radius,
                                  double reduced_modulus, double area_share, double shear_strength);
