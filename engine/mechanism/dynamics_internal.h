// What the files of dynamics share: _check (input), _forces (forces, event functions), _path
// (motion between events), _energy, and dynamics.c (what events do). Private to this folder.
#pragma once

#include "engine/mechanism/dynamics.h"

// Everything that can end a segment. Contacts and stops follow each other by index.
enum {
  EVENT_NONE = -1,
  EVENT_BREAK, // the drive's next piece
  EVENT_EDGE_UP,
  EVENT_EDGE_DOWN,
  EVENT_DRIVE,    // platen or finger touches or is left
  EVENT_RIGID_UP, // rigid contacts: slip forward, or come to rest
  EVENT_RIGID_DOWN,
  EVENT_STOP,
  EVENT_CONTACT_UP = EVENT_STOP + SB_DYNAMICS_STOPS,
  EVENT_CONTACT_DOWN = EVENT_CONTACT_UP + SB_DYNAMICS_CONTACTS,
  EVENT_COUNT = EVENT_CONTACT_DOWN + SB_DYNAMICS_CONTACTS,
};

// Forces on the stem that are linear in its state: f0 + f1 tau - k (x - x0) - c v, sliding contacts
// included at their level, rigid sticking ones and the rigid stop that holds it left out.
typedef struct {
  double f0, f1, k, c;
  double size; // sum of the magnitudes in f0: its rounding
} Linear;

// Positions closer than rounding of this are the same [m].
static const double length_noise = 1e-6;

// Stiffness INFINITY.
static inline bool is_rigid(const SbDynamicsModel *m, size_t i) {
  return m->contact[i].stiffness > 1e300;
}

// Deflections among the states of the numerical path: none if every contact is rigid.
static inline size_t sb_motion_patches(const SbDynamicsModel *m) {
  for (size_t i = 0; i < m->contacts; i++) {
    if (!is_rigid(m, i)) {
      return m->contacts;
    }
  }
  return 0;
}

static inline double sb_motion_rest_speed(const SbDynamicsModel *m) {
  return m->rest_speed > 0.0 ? m->rest_speed : 1e-9;
}

// A force that stays at zero: the finger has been taken away, damper and all.
static inline bool sb_motion_finger_gone(const SbDynamics *s) {
  return s->model->drive.kind != SB_DRIVE_NONE && s->model->drive.quantity == SB_DRIVE_OF_FORCE &&
         !s->model->drive_bonded && !s->piece.curved && s->piece.value == 0.0 &&
         s->piece.rate == 0.0;
}

// Position of the drive's moving end, and its rate, or its force and rate, at time t.
void sb_motion_drive_at(const SbDynamics *s, double t, double *value, double *rate);

// Deflection a released stop or platen still has at time t, and the rate at which it fades.
double sb_motion_touch_residual(const SbDynamicsTouch *touch, double stiffness, double damping,
                                double t, double *fading);

// Force of the drive on the stem (it pushes or is bonded and on), for a stem at (x, v) at t.
double sb_motion_drive_force(const SbDynamics *s, double t, double x, double v);

// Reaction of stop i, >= 0; a rigid one reacts to what presses it.
double sb_motion_stop_force(const SbDynamics *s, size_t i, double t, double x, double v);

// Force that a sticking or sliding elastic contact, or a sliding rigid one, exerts on the stem.
double sb_motion_contact_force(const SbDynamics *s, size_t i, double x, double v, double deflection,
                               double level);

// Level times the factor of the sliding speed.
double sb_motion_sliding_level(const SbDynamics *s, size_t i, double level, double speed);

// Largest force that contact i holds after resting until t.
double sb_motion_holding_level(const SbDynamics *s, size_t i, double level, double t);

// Whether the law of contact i depends on the speed.
bool sb_motion_speed_dependent(const SbDynamicsModel *m, size_t i);

// Linear forces of the present mode about the anchor (tau = 0 at s->t).
void sb_motion_linear_forces(const SbDynamics *s, Linear *linear);

// All forces on a stem at rest at x save rigid friction and rigid stops [N].
double sb_motion_demand(const SbDynamics *s, double t, double x, const double *deflection,
                        const SbDynamicsLoads *loads);

// Tangential deflection of contact i at tau and `travel` after the anchor in the closed-form path,
// and how fast it relaxes if it slides.
double sb_motion_deflection_at(const SbDynamics *s, size_t i, double tau, double travel,
                               double *rate);

// Speed of the sliding patch of contact i over the bore, at the anchor.
double sb_motion_patch_speed(const SbDynamics *s, size_t i);

// Function of an event in the closed-form path; false if it cannot happen in this mode.
bool sb_motion_event_function(const SbDynamics *s, int event, const Linear *linear,
                              SbEventFunction *function);

// Numerical path: a copy of the state anchored at z (x, v, deflections, extra states) at time t,
// and the linear forces there; for a held stem what it must bear.
void sb_motion_anchor_at(SbDynamics *at, Linear *linear, const SbDynamics *s, double t,
                         const double *z);

// The function's value at an anchor, and a size below which its sign means nothing; false as above.
bool sb_motion_event_value(const SbDynamics *at, int event, const Linear *linear, double *value,
                           double *noise);

// Rates and integrands at z; `user` is the SbDynamics.
void sb_motion_numerical_rates(double *dz, double *power, double t, const double *z, void *user);

// Loads at a place (those of the segment if constant there).
void sb_motion_loads_at(const SbDynamics *s, double x, const double *extra, SbDynamicsLoads *loads);

// Finds the motion from the anchor and the event that ends it (s->t_end, s->event).
SbStatus sb_motion_find_path(SbDynamics *s, SbReport *report);

// After rigid contacts broke away at the anchor: goes on by whole cycles of stick-slip if they are
// equal (dynamics_repeat.c). SB_ERROR_NOT_CONVERGED if too many unequal ones lie ahead.
SbStatus sb_motion_repeat(SbDynamics *s, int direction, SbReport *report);

// Position, speed, deflections and extra states at time t of the present segment.
void sb_motion_state_at(const SbDynamics *s, double t, double *x, double *v, double *d,
                        double *extra);

// Largest force of the drive over the present segment [N], no less than `known`.
double sb_motion_force_peak(const SbDynamics *s, double known);

// Energy in seals, stops, return spring and drive [J].
double sb_motion_stored_energy(const SbDynamics *s, double t, double x, const double *d);

// What the dampers of stops that were left take from t0 to t1 [J].
double sb_motion_stops_relax(const SbDynamics *s, double t0, double t1);

// Energies up to time t of the present segment, whose state is given.
void sb_motion_energy_at(const SbDynamics *s, double t, double x, double v, const double *d,
                         SbDynamicsEnergy *e);
