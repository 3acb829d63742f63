// What the files of dynamics share: _check (input), _forces (forces, energies, event functions),
// _path (motion between events), and dynamics.c (what events do). Private to this folder.
#pragma once

#include "engine/mechanism/dynamics.h"

#include <float.h>
#include <math.h>

// Everything that can end a segment; of those at one time the first counts. Stops and contacts
// follow each other by index.
enum {
  EVENT_NONE = -1,
  EVENT_BREAK, // the drive's next piece
  EVENT_EDGE_UP,
  EVENT_EDGE_DOWN,
  EVENT_PLATEN,   // platen or finger touches or is left
  EVENT_RIGID_UP, // rigid contacts: slip forward, or come to rest
  EVENT_RIGID_DOWN,
  EVENT_SPEED_UP, // the stem's speed leaves its band
  EVENT_SPEED_DOWN,
  EVENT_STOP,
  EVENT_CONTACT_UP = EVENT_STOP + SB_DYNAMICS_STOPS,
  EVENT_CONTACT_DOWN = EVENT_CONTACT_UP + SB_DYNAMICS_CONTACTS,
  EVENT_COUNT = EVENT_CONTACT_DOWN + SB_DYNAMICS_CONTACTS,
};

// Force on the stem about a point of its motion: f0 + f1 tau - k (x - x0) - c v, tau since then.
typedef struct {
  double f0, f1, k, c; // N, N/s, N/m, N s/m
} Force;

// A point of the motion, and what acts on the stem there: the one description of forces, which the
// closed form takes as coefficients and the numerical path as numbers.
typedef struct {
  double t;                 // s
  const SbDynamicsState *z; // borrowed
  double v;                 // speed, 0 if held [m/s]
  SbDynamicsLoads loads;
  Force wall[SB_DYNAMICS_WALLS], contact[SB_DYNAMICS_CONTACTS]; // 0 where nothing acts
  Force beside[SB_DYNAMICS_CONTACTS]; // of a contact that slides: what the speed adds
  Force sum;                          // of these, the loads, the return spring and what is viscous
  double rigid; // of sum.f0, rigid contacts that slide [N]; at rest they, like rigid stops, are 0
} Point;

// Integrals over a stretch of the motion, or, with a time of 1, their rates at its start.
typedef struct {
  double time, travel; // of 1 and v [s, m]
  double square, ramp; // of v^2 and tau v [m2/s, m s]
  double lag;          // of the way less that of the platen, which goes steadily [m s]
  double shift[SB_DYNAMICS_CONTACTS], fade[SB_DYNAMICS_CONTACTS]; // of d' and d'^2 [m, m2/s]
} Stretch;

// After so many segments a motion is given up: two to four minutes of a processor.
enum { SEGMENTS_MAX = 40000000 };

// Positions closer than rounding of this are the same [m].
static const double length_noise = 1e-6;

// Stiffness INFINITY.
static inline bool rigid(double stiffness) {
  return stiffness > 1e300;
}

static inline bool is_rigid(const SbDynamicsModel *m, size_t i) {
  return rigid(m->contact[i].stiffness);
}

static inline double sb_motion_rest_speed(const SbDynamicsModel *m) {
  return m->rest_speed > 0.0 ? m->rest_speed : 1e-9;
}

// The drive prescribes a force on the stem, not a place.
static inline bool sb_motion_by_force(const SbDynamicsModel *m) {
  return m->drive.quantity == SB_DRIVE_OF_FORCE;
}

// A force that stays at zero: the finger has been taken away, damper and all.
static inline bool sb_motion_finger_gone(const SbDynamics *s) {
  return s->model->drive.kind != SB_DRIVE_NONE && sb_motion_by_force(s->model) &&
         !s->model->drive_bonded && !s->piece.curved && s->piece.value == 0.0 &&
         s->piece.rate == 0.0;
}

// Place of a wall's or the drive's moving end [m], or the finger's force [N], and its rate.
typedef struct {
  double value, rate;
} Moving;

Moving sb_motion_drive_at(const SbDynamics *s, double t);

// Of wall w at time t.
Moving sb_motion_wall_at(const SbDynamics *s, size_t w, double t);

// Deflection that wall w has at (t, x); of one that was left what remains of it [m].
double sb_motion_deflection(const SbDynamics *s, size_t w, double t, double x);

// Level of contact i in a direction [N].
static inline double sb_motion_level(const SbDynamicsLoads *loads, size_t i, int direction) {
  return loads->level[i] + (direction < 0 ? loads->back[i] : 0.0);
}

// Level times the factor of the sliding speed.
double sb_motion_sliding_level(const SbDynamics *s, size_t i, double level, double speed);

// Whether the law of contact i is no straight line in a band of speed.
bool sb_motion_speed_dependent(const SbDynamicsModel *m, size_t i);

// Force of wall w, as if it touched a stem at x.
void sb_motion_wall_force(Force *force, const SbDynamics *s, size_t w, double t, double x);

// The point at time t and state z, in the present mode.
void sb_motion_point(Point *p, const SbDynamics *s, double t, const SbDynamicsState *z);

// A force at the point's own speed [N].
static inline double force_of(const Force *force, const Point *p) {
  return force->f0 - force->c * p->v;
}

// Size of the rounding of time t [s]: of two times closer than that neither comes first.
static inline double sb_motion_time_noise(double t) {
  return 8.0 * DBL_EPSILON * fabs(t);
}

// How long the pieces of their laws hold for contacts that rest at p [s], maybe INFINITY.
double sb_motion_rest_ends(const SbDynamics *s, const Point *p);

// Largest force that contact i can hold at p against the stem's going in `direction`.
double sb_motion_holding(const SbDynamics *s, const Point *p, size_t i, int direction);

// Rate of the deflection of contact i at p [m/s]; the rest of the stem's speed is its patch's.
double sb_motion_deflection_rate(const SbDynamics *s, const Point *p, size_t i);

// Tangential deflection of contact i at tau and `travel` after the anchor in the closed-form path,
// and how fast it relaxes if it slides.
double sb_motion_deflection_at(const SbDynamics *s, size_t i, double tau, double travel,
                               double *rate);

// Function of an event about a point; false if it cannot happen in this mode.
bool sb_motion_event_function(const SbDynamics *s, const Point *p, int event, SbEventFunction *g);

// Its value at that point, where the speed is v, and a size below which its sign means nothing in
// the numerical path.
double sb_motion_event_value(const SbDynamics *s, int event, const SbEventFunction *g, double v,
                             double *noise);

// Finds the motion from the anchor and the event that ends it (s->t_end, s->event).
SbStatus sb_motion_find_path(SbDynamics *s, SbReport *report);

// After `event`, by which contacts broke away at the anchor: goes on by whole cycles of stick-slip
// if they are equal, or by a group of them if they change slowly.
void sb_motion_repeat(SbDynamics *s, int event);

// The state at tau after the anchor, within the segment.
void sb_motion_state_at(const SbDynamics *s, double tau, SbDynamicsState *z);

// Largest force of the drive over the present segment [N], no less than `known`.
double sb_motion_force_peak(const SbDynamics *s, double known);

// Energy in seals, stops, return spring and drive [J].
double sb_motion_stored_energy(const SbDynamics *s, double t, const SbDynamicsState *z);

// What the damper of wall w takes from t0 to t1 once it was left [J].
double sb_motion_relaxed(const SbDynamics *s, size_t w, double t0, double t1);

// Adds to the terms of SbDynamicsEnergy what the forces at p do over a stretch from there on.
void sb_motion_add_energy(double *term, const SbDynamics *s, const Point *p, const Stretch *over);

// Energies up to tau after the anchor, where the state is z.
void sb_motion_energy_at(const SbDynamics *s, double tau, const SbDynamicsState *z,
                         SbDynamicsEnergy *e);
