// Shared by the files of dynamics.h: dynamics_check.c (input), dynamics_forces.c (forces, energies,
// event functions), dynamics_path.c (motion between events), dynamics_states.c (state and
// energies there), dynamics.c (effects of events),
// dynamics_repeat.c and dynamics_envelope.c (stick-slip cycles). Private to engine/mechanism.
//
// sb_dynamics_advance() works segment by segment: sb_motion_find_path() finds the motion from s->t
// and s->at, the end s->t_end of the segment and the event s->event. The functions that take a time
// or tau evaluate this segment. At its end dynamics.c sets s->t and s->at, applies the event to the
// contact states, and calls sb_motion_repeat() after a break-away. Directions are +1 (to +x, into
// the canister) or -1.
#pragma once

#include "engine/mechanism/dynamics.h"

#include <float.h>
#include <math.h>

// Events that end a segment; if several have the same time, the first of this list is processed
// first. Events of stops and contacts are followed by those of the next index.
enum {
  EVENT_NONE = -1,
  EVENT_BREAK,                                       // the drive's next piece begins
  EVENT_EDGE_UP,                                     // an edge is crossed to +x
  EVENT_EDGE_DOWN,                                   // an edge is crossed to -x
  EVENT_PLATEN,                                      // platen or finger gains or loses contact
  EVENT_RIGID_UP,                                    // rigid contacts slip to +x, or come to rest
  EVENT_RIGID_DOWN,                                  // rigid contacts slip to -x
  EVENT_SPEED_UP,                                    // the speed leaves its band upwards
  EVENT_SPEED_DOWN,                                  // the speed leaves its band downwards
  EVENT_STOP,                                        // a stop gains or loses contact
  EVENT_CONTACT_UP = EVENT_STOP + SB_DYNAMICS_STOPS, // an elastic contact slips to +x, or sticks
  EVENT_CONTACT_DOWN = EVENT_CONTACT_UP + SB_DYNAMICS_CONTACTS, // an elastic contact slips to -x
  EVENT_COUNT = EVENT_CONTACT_DOWN + SB_DYNAMICS_CONTACTS,
};

// Force on the stem, positive to +x, near a point of its motion where the stem is at x0, with tau
// the time since that point and v the speed:
//
//   f0 + f1 tau - k (x - x0) - c v
typedef struct {
  double f0, f1, k, c; // [N], [N/s], [N/m], [N s/m]
} Force;

// A point of the motion, and the forces on the stem there, for both the closed form and the
// numerical path.
typedef struct {
  double t;                 // [s]
  const SbDynamicsState *z; // borrowed
  double v;                 // speed, 0 if the stem is fixed [m/s]
  SbDynamicsLoads loads;
  Force wall[SB_DYNAMICS_WALLS], contact[SB_DYNAMICS_CONTACTS]; // 0 without contact
  Force beside[SB_DYNAMICS_CONTACTS]; // speed-dependent part of a sliding contact's friction
  Force sum;    // sum of wall, contact and beside, loads, return spring and damping
  double rigid; // part of sum.f0 due to sliding rigid contacts [N]; rigid walls and contacts at
                // rest count 0
} Point;

// Integrals over a stretch of the motion, x and v of the stem, d of SbDynamicsState. If `time` is 1
// and the other fields are rates, all are time derivatives at the start of the stretch.
typedef struct {
  double time, travel; // integrals of 1 [s] and v [m]
  double square, ramp; // integrals of v^2 [m2/s] and tau v [m s]
  double lag;          // integral of x - x0 minus the travel of the platen since the start [m s]
  // By contact: integrals of d' [m] and d'^2 [m2/s], d' the rate of the deflection.
  double shift[SB_DYNAMICS_CONTACTS], fade[SB_DYNAMICS_CONTACTS];
} Stretch;

// Largest number of segments: two to four minutes of processor time.
enum { SEGMENTS_MAX = 40000000 };

// Positions that differ by less than rounding of this are equal [m].
static const double length_noise = 1e-6;

// Returns whether a stiffness is INFINITY.
static inline bool rigid(double stiffness) {
  return stiffness > 1e300;
}

// Returns whether contact i has no tangential spring.
static inline bool is_rigid(const SbDynamicsModel *m, size_t i) {
  return rigid(m->contact[i].stiffness);
}

// Returns the speed below which a contact comes to rest [m/s].
static inline double sb_motion_rest_speed(const SbDynamicsModel *m) {
  return m->rest_speed > 0.0 ? m->rest_speed : 1e-9;
}

// Returns whether the drive prescribes a force, not a position.
static inline bool sb_motion_by_force(const SbDynamicsModel *m) {
  return m->drive.quantity == SB_DRIVE_OF_FORCE;
}

// Returns whether the force of a finger has become 0 for the rest of the piece: the finger is
// removed, with its damper.
static inline bool sb_motion_finger_gone(const SbDynamics *s) {
  return s->model->drive.kind != SB_DRIVE_NONE && sb_motion_by_force(s->model) &&
         !s->model->drive_bonded && !s->piece.curved && s->piece.value == 0.0 &&
         s->piece.rate == 0.0;
}

// Position [m] of a wall or of the drive, or force [N] of a finger, and its time derivative.
typedef struct {
  double value, rate;
} Moving;

// Returns the drive at time t [s].
Moving sb_motion_drive_at(const SbDynamics *s, double t);

// Returns the position of wall w at time t [s]; for SB_DYNAMICS_PLATEN the drive
// (sb_motion_drive_at()).
Moving sb_motion_wall_at(const SbDynamics *s, size_t w, double t);

// Returns the deflection [m] of wall w at time t for a stem at x: position of the wall minus x.
// After contact was lost it is the remaining deflection, which relaxes. 0 without a spring.
double sb_motion_deflection(const SbDynamics *s, size_t w, double t, double x);

// Returns the level L [N] of contact i for sliding in `direction`.
static inline double sb_motion_level(const SbDynamicsLoads *loads, size_t i, int direction) {
  return loads->level[i] + (direction < 0 ? loads->back[i] : 0.0);
}

// Returns `level` times the Stribeck factor of contact i at `speed` [m/s].
double sb_motion_sliding_level(const SbDynamics *s, size_t i, double level, double speed);

// Returns whether contact i has a Stribeck factor, so that its law is not linear within a band.
bool sb_motion_speed_dependent(const SbDynamicsModel *m, size_t i);

// Writes the force of wall w at time t as if it had contact with a stem at x.
void sb_motion_wall_force(Force *force, const SbDynamics *s, size_t w, double t, double x);

// Computes the point at time t with the state z, in the present contact states. `z` is borrowed by
// *p.
void sb_motion_point(Point *p, const SbDynamics *s, double t, const SbDynamicsState *z);

// Returns a force at the speed of the point [N].
static inline double force_of(const Force *force, const Point *p) {
  return force->f0 - force->c * p->v;
}

// Returns the rounding error of time t [s]: events closer than that are simultaneous.
static inline double sb_motion_time_noise(double t) {
  return 8.0 * DBL_EPSILON * fabs(t);
}

// Returns the time [s] from p until the first of the resting contacts reaches the next piece of its
// dwell law; INFINITY if none does.
double sb_motion_rest_ends(const SbDynamics *s, const Point *p);

// Returns the largest static friction [N] >= 0 of contact i at p against motion of the stem in
// `direction` (+1 or -1).
double sb_motion_holding(const SbDynamics *s, const Point *p, size_t i, int direction);

// Returns the time derivative of the deflection of contact i at p [m/s]: the speed of the stem
// minus that of the patch.
double sb_motion_deflection_rate(const SbDynamics *s, const Point *p, size_t i);

// Returns the deflection [m] of contact i at `tau` and `travel` after the start of the segment, in
// the closed form. *rate receives its relaxation rate [m/s] if the contact slides, else 0.
double sb_motion_deflection_at(const SbDynamics *s, size_t i, double tau, double travel,
                               double *rate);

// Writes to *g the function of `event` (EVENT_...), whose argument is the time since p; the event
// occurs when g becomes negative (oscillator.h). Returns false if the event is impossible in the
// present contact states; *g is unspecified then.
bool sb_motion_event_function(const SbDynamics *s, const Point *p, int event, SbEventFunction *g);

// Returns g(0) of a function g of sb_motion_event_function(), at whose point the speed is v. *noise
// receives the magnitude below which the sign is not significant in the numerical path.
double sb_motion_event_value(const SbDynamics *s, int event, const SbEventFunction *g, double v,
                             double *noise);

// Finds the motion in the segment that begins at s->t with the state s->at, and sets its end
// s->t_end and the event s->event that ends it. SB_ERROR_NOT_CONVERGED: no step of the numerical
// path converges.
SbStatus sb_motion_find_path(SbDynamics *s, SbReport *report);

// Called after `event`, a break-away at the start of the segment. If cycles of stick-slip repeat,
// advances by a number of full cycles; if they change slowly, by a group of cycles.
void sb_motion_repeat(SbDynamics *s, int event);

// Limits of a group of stick-slip cycles from the present state.
typedef struct {
  // time: until the drive's piece ends [s]; INFINITY: it does not end. way: distance to the next
  // edge or stop minus the stretch of the drive's spring [m]; INFINITY: there is none; negative:
  // too close for further cycles.
  double time, way;
} SbMotionAhead;

// Returns the limits for a stem that moves in `direction` (+1 or -1), within whose cycles it is
// nowhere farther from its mean position than the stretch of the drive's spring. `time` is not
// limited by the target of sb_dynamics_advance().
SbMotionAhead sb_motion_ahead(const SbDynamics *s, int direction);

// Returns whether since `was` there were only slips, sticks, bands of speed and contacts lost and
// made by the platen, and the machine pushes. False if was->event is EVENT_NONE.
bool sb_motion_undisturbed(const SbDynamics *s, const SbDynamicsBreak *was);

// Advances time to `until` [s], and the stem to x [m], over a number of cycles, which are added to
// counters.repeated. The caller adds the energies of the cycles, except those of relaxing stops.
// All else remains; the times of contacts (since, slipped) are shifted.
void sb_motion_pass(SbDynamics *s, double until, double x, double cycles);

// Sets s->broke to the present state just after `event`, a break-away.
void sb_motion_note(SbDynamics *s, int event);

// Returns the integral from a to b of the parabola through three points.
double sb_motion_under_parabola(const double x[3], const double y[3], double a, double b);

// Called after a break-away that ended no cycle of sb_motion_repeat(), with s->broke: if cycles of
// elastic contacts change slowly and are too many to be stepped through, advances by a group of
// them.
void sb_motion_envelope(SbDynamics *s);

// Writes to *z the state at `tau` [s] after the start of the segment, 0 <= tau <= t_end - t, after
// sb_motion_find_path().
void sb_motion_state_at(const SbDynamics *s, double tau, SbDynamicsState *z);

// Returns the largest force of the drive in the present segment, or `known` if that is larger [N].
double sb_motion_force_peak(const SbDynamics *s, double known);

// Returns the energy in tangential springs, stops, return spring and drive [J] at time t and state
// z.
double sb_motion_stored_energy(const SbDynamics *s, double t, const SbDynamicsState *z);

// Returns the energy [J] dissipated by the damper of wall w from the time t0 to t1 [s] after
// contact was lost; 0 while the wall has contact.
double sb_motion_relaxed(const SbDynamics *s, size_t w, double t0, double t1);

// Adds to term[SB_DYNAMICS_TERMS] (SbDynamicsEnergy.term) the work of the forces at p over the
// stretch `over`, which begins at p.
void sb_motion_add_energy(double *term, const SbDynamics *s, const Point *p, const Stretch *over);

// Computes all energies from the start of the motion to `tau` [s] after the start of the segment,
// where the state is z.
void sb_motion_energy_at(const SbDynamics *s, double tau, const SbDynamicsState *z,
                         SbDynamicsEnergy *e);
