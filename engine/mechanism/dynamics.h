// The valve's one coordinate with real dynamics: true stick, stops, a platen that only pushes.
//
//   m x'' = drive + pressure - spring - sum of seal frictions - damping x' + stop reactions
//
// (thesis ch. 4 with its one degree of freedom; friction and contact laws below are ours where the
// thesis has none.) x > 0 is the in-stroke, compression of the drive is positive.
//
// Friction. A contact carries a level L [N] given by the caller for where the stem is: its friction
// as the speed goes to 0. It sticks up to L (static_ratio + dwell_gain ln(1 + dwell/dwell_time)),
// or up to L times a law of the dwell that comes with the level (dwell.h);
// it slides at L [1 + (static_ratio - 1) exp(-(speed/stribeck_speed)^stribeck_exponent)], or at L
// from the first slip if stribeck_speed is 0. What the speed changes of it beyond that the caller
// gives as bands of the stem's speed in which it is straight, continuous from one to the next;
// rising or falling, it acts beside the tangential spring. A contact with finite `stiffness` joins
// stem and bore through the seal's tangential spring and damper (pre-sliding, thesis slope A-B):
// its patch does not move at all while it sticks. A rigid contact (stiffness INFINITY) holds the
// stem itself at rest, exactly. Contacts that the land does not reach have level 0.
//
// Stops. Spring and damper in one direction, the damper from the restitution of a free impact that
// ends when the force does (Schwager and Poeschel 2007); stiffness INFINITY is an impact law, at
// rest once a rebound would stay below 1 pm. A massless stop or platen that is left behind relaxes
// by its own damper and can be met again.
//
// Method. Between events, of which leaving a band of speed is one, the motion is linear in almost
// all models: closed form (oscillator.h), events found by bounds, resting costs nothing, nor does
// stick-slip that repeats itself. Stribeck's exponential, position-dependent loads and sinusoids go
// through Radau IIA with error control and events located by re-stepping. Each energy term is
// integrated by itself; their balance is a result, not a construction. Nothing is allocated. Leaves
// out: rotation and tilt of the stem, wave motion in the parts, a speed law evaluated at the patch
// (it uses the stem's speed).
#pragma once

#include "engine/base/status.h"
#include "engine/mechanism/drive.h"
#include "engine/mechanism/dwell.h"
#include "engine/mechanism/oscillator.h"
#include "engine/mechanism/radau.h"

enum {
  SB_DYNAMICS_CONTACTS = 4,
  SB_DYNAMICS_STOPS = 2,
  SB_DYNAMICS_EDGES = 8,
};

typedef struct {
  double static_ratio;      // >= 1
  double dwell_gain;        // >= 0, per factor e of rest
  double dwell_time;        // s, > 0 if dwell_gain > 0
  double stribeck_speed;    // m/s; 0: static_ratio is lost at the first slip
  double stribeck_exponent; // > 0 if stribeck_speed > 0
  double stiffness;         // N/m; INFINITY: rigid
  double damping;           // N s/m, of the tangential spring; 0 if rigid
} SbDynamicsContact;

typedef struct {
  double position;    // m, where the stem meets it
  int side;           // +1 stops motion to +x, -1 to -x
  double stiffness;   // N/m; INFINITY: impact law
  double restitution; // of a free impact, 0 (INFINITY only) or 0.01 .. 1
} SbDynamicsStop;

// What the valve does to the stem at one place: net force on it [N] and the contacts' levels [N].
typedef struct {
  double force;                       // N
  double level[SB_DYNAMICS_CONTACTS]; // N, of sliding to +x
  double back[SB_DYNAMICS_CONTACTS];  // N, by how much that of sliding to -x is larger
  // What holds at rest over the level, by dwell; borrowed, NULL: the contact's own constants.
  const SbDwellLaw *rest[SB_DYNAMICS_CONTACTS];
  bool constant; // neither changes before the next edge is crossed, nor does the extra state
  bool settled;  // the extra state does not change while the stem does not move
} SbDynamicsLoads;

// What the speed adds to the level of contacts that slide with the stem: rise + slope |v| [N], for
// |v| from low up to but not including high; 0 at rest.
typedef struct {
  double low, high;                   // m/s; high = INFINITY: for all above
  double rise[SB_DYNAMICS_CONTACTS];  // N
  double slope[SB_DYNAMICS_CONTACTS]; // N s/m, of either sign
} SbDynamicsBand;

typedef struct {
  double mass;                             // kg, > 0
  double damping;                          // N s/m, of the stem against ground
  double spring_preload, spring_stiffness; // N, N/m; return spring: -(preload + stiffness x)
  size_t contacts, stops, edges;
  SbDynamicsContact contact[SB_DYNAMICS_CONTACTS];
  SbDynamicsStop stop[SB_DYNAMICS_STOPS];
  double edge[SB_DYNAMICS_EDGES]; // m, increasing; region r lies between edge[r-1] and edge[r]
  // Loads in a region; called once a region if constant. NULL: none.
  void (*loads)(SbDynamicsLoads *loads, double x, size_t region, const double *extra, void *user);
  // The band of speed |v| in direction +1 or -1; asked for once a band where the loads are
  // constant, else like them, for any speed in it. NULL: friction does not depend on speed.
  void (*band)(SbDynamicsBand *band, double x, size_t region, int direction, double speed,
               const double *extra, void *user);
  // The stem crosses edge[i] in direction +1 or -1: the caller may change `extra` or its own state.
  void (*cross)(size_t edge, int direction, double *extra, void *user);
  // Rate of the extra state (a chamber pressure), asked for while loads vary; NULL: there is none.
  void (*extra_rate)(double *rate, double x, double v, size_t region, const double *extra,
                     void *user);
  double extra_start, extra_scale; // in the unit of that state; scale > 0: its size
  // Polled once a segment; true ends the motion there with SB_ERROR_CANCELLED. NULL: never.
  bool (*poll)(void *data);
  void *poll_data;
  // The mass that the stroke sees at (x, v) [kg], asked for at the start of every segment; NULL:
  // always `mass`.
  SbStatus (*mass_at)(double *mass, double x, double v, void *user, SbReport *report);
  void *user;
  SbDrive drive;
  // N/m, N s/m. A force drive has no stiffness; its push falls by drive_damping times the speed, as
  // a finger's does, and ends with the force.
  double drive_stiffness, drive_damping;
  bool drive_bonded;                  // pulls as well as pushes
  double start_position, start_speed; // m, m/s
  double start_dwell;                 // s of rest before the start
  double tolerance;                   // relative, of the numerical path, <= 1e-5; 0: 1e-9
  double rest_speed; // m/s below which a slowing contact rests, a rigid stop keeps; 0: 1e-9
} SbDynamicsModel;

typedef enum {
  SB_MOTION_SLIP,       // contact `index` starts to slide (index < 0: all rigid ones)
  SB_MOTION_STICK,      // ... comes to rest
  SB_MOTION_TOUCH_STOP, // stop `index`
  SB_MOTION_LEAVE_STOP,
  SB_MOTION_TOUCH_DRIVE, // platen or finger
  SB_MOTION_LEAVE_DRIVE,
  SB_MOTION_EDGE, // edge `index`, direction `sign`
} SbMotionEventKind;

// State just before the event.
typedef struct {
  SbMotionEventKind kind;
  int index, sign;
  double time, position, speed, drive_force; // s, m, m/s, N
} SbMotionEvent;

enum { SB_DYNAMICS_TERMS = 7 };

// Energies [J].
typedef struct {
  union {
    struct {
      double drive;    // work done by the drive at its moving end
      double pressure; // work of the loads' force
      double friction; // sliding contacts
      double viscous;  // `damping`
      double seal;     // dampers of the tangential springs
      double stop;     // stops
      double machine;  // damper of the drive
    };
    double term[SB_DYNAMICS_TERMS]; // these, which are integrated, in a row
  };
  double kinetic;        // present kinetic energy less that at the start
  double stored;         // in seals, stops, spring and drive, less that at the start
  double largest;        // largest |drive + pressure| so far
  double largest_stored; // largest |stored| so far
  double closure; // |drive + pressure - all the rest| / largest, or / largest_stored where neither
                  // drive nor pressure does work (0 if both are 0)
} SbDynamicsEnergy;

typedef enum { SB_CONTACT_OFF, SB_CONTACT_STUCK, SB_CONTACT_SLIP } SbContactState;

typedef struct {
  double time, position, speed, acceleration;    // s, m, m/s, m/s2
  double drive_position;                         // m
  double drive_force, loads_force, spring_force; // on the stem, N
  double stop_force[SB_DYNAMICS_STOPS];          // reaction, >= 0, N
  double friction[SB_DYNAMICS_CONTACTS];         // force on the stem, N
  double deflection[SB_DYNAMICS_CONTACTS];       // of the tangential spring, m
  SbContactState contact[SB_DYNAMICS_CONTACTS];
  double extra; // the caller's
  size_t region;
} SbDynamicsSample;

typedef struct {
  long events, segments, steps, rejected, newton_iterations;
  long repeated;      // cycles of stick-slip that were not stepped through
  long grouped;       // of these, those that differ a little from one to the next
  double local_error; // sum of the numerical path's local errors of position, over |x| + 1 mm
} SbDynamicsCounters;

// The unknowns of the motion, for the numerical path in a row.
typedef union {
  struct {
    double x, v;                    // m, m/s
    double extra;                   // the caller's
    double d[SB_DYNAMICS_CONTACTS]; // deflections of the tangential springs, m; 0 if rigid
  };
  double z[3 + SB_DYNAMICS_CONTACTS];
} SbDynamicsState;

// What pushes the stem in one direction by a spring and damper: a stop or, with a place that moves,
// the platen. A finger has no spring.
typedef struct {
  bool on;
  int push;                  // direction of its force, +1 or -1
  double stiffness, damping; // N/m (INFINITY: rigid), N s/m
  double residual, since;    // deflection [m] left when it was last left [s]
} SbDynamicsWall;
enum { SB_DYNAMICS_PLATEN = SB_DYNAMICS_STOPS, SB_DYNAMICS_WALLS };

// Where a contact broke away: what a cycle of stick-slip begins and ends with.
typedef struct {
  int event; // that began the slip; -1: none yet
  size_t region;
  // So far; platens: touched or left; others: that no cycle has.
  long events, platens, others, segments;
  double t, until; // s; end of the drive's piece
  double stretch;  // of the drive's spring [m]
  SbDynamicsState at;
  SbContactState state[SB_DYNAMICS_CONTACTS];
  double rest[SB_DYNAMICS_CONTACTS]; // since it came to rest, if it did [s]
  SbDynamicsEnergy energy;
} SbDynamicsBreak;

// Cycles passed over that change slowly: power of each term of energy [W] in the middle [s] of the
// cycles before the last two groups.
typedef struct {
  bool open;       // the last group's energies are extrapolated from its begin
  double from, to; // the last group [s]
  double span;     // of the last [s]
  double rest[SB_DYNAMICS_CONTACTS], longer[SB_DYNAMICS_CONTACTS];   // last, and by how much [s]
  double rested[SB_DYNAMICS_CONTACTS], slower[SB_DYNAMICS_CONTACTS]; // s; its rate since
  double middle[2], power[2][SB_DYNAMICS_TERMS], taken[SB_DYNAMICS_TERMS];
} SbDynamicsGroup;

// Working state; on the caller's memory, no pointers owned. Fields are private, but what is to be
// read.
typedef struct {
  SbDynamicsCounters counters; // to be read: what the run cost so far
  double force_peak;           // to be read: of the drive, up to the last event [N]
  const SbDynamicsModel *model;
  double t, t_end;    // anchor of the segment, and its end [s]
  SbDynamicsState at; // at the anchor
  double now;         // time last advanced to, within the segment [s]
  double mass;        // kg
  SbContactState state[SB_DYNAMICS_CONTACTS];
  int sign[SB_DYNAMICS_CONTACTS];
  double since[SB_DYNAMICS_CONTACTS]; // start of the rest
  // Last slip, and what a contact holds beyond its limit because that slip had no duration, N.
  double slipped[SB_DYNAMICS_CONTACTS], margin[SB_DYNAMICS_CONTACTS];
  bool fresh[SB_DYNAMICS_CONTACTS]; // newly loaded: sticks up to the sliding level only
  size_t region;
  SbDynamicsLoads loads;
  // Of the speed in the present segment, if a contact slides; which way; it fell out of the last.
  SbDynamicsBand band;
  int direction;
  bool banded, fell;
  SbDynamicsWall wall[SB_DYNAMICS_WALLS]; // the stops, and the platen
  SbDriveState drive;
  SbDrivePiece piece;
  SbDynamicsEnergy energy;
  SbDynamicsBreak broke, mark; // the last, and the one that later ones are compared with
  long since_mark, mark_after; // break-aways since it was set, and after how many it is set again
  double least_stretch;        // of the drive's spring at events since then, in size [m]
  long platens, others;        // events of the platen; of kinds that no cycle has: stops and edges
  SbDynamicsGroup group;
  double asked;                       // time that is being advanced to
  double stored_start, kinetic_start; // J
  bool ready, linear, held;
  // The patch started the segment clearly faster than rest_speed: falling below it is coming to
  // rest.
  bool brisk[SB_DYNAMICS_CONTACTS];
  int event; // that ends the segment, or -1
  SbOscillator motion;
  SbRadauSystem system;
  size_t unknown[SB_RADAU_MAX]; // its unknowns' places in SbDynamicsState.z
  double speed_size;            // of its tolerance [m/s]
  SbRadauStep step[2];
  double h; // next step size [s]
  double accumulated_at;
  int accumulated;
  void (*listener)(const SbMotionEvent *event, void *user);
  void *listener_user;
} SbDynamics;

// Refuses a model that makes no sense, naming what is wrong.
SbStatus sb_dynamics_check(const SbDynamicsModel *model, SbReport *report);

// State at time 0. The model is borrowed for the life of the state.
SbStatus sb_dynamics_init(SbDynamics *dynamics, const SbDynamicsModel *model, SbReport *report);

// Reports every event as it happens, save those of cycles passed over (counters.repeated); NULL to
// stop.
void sb_dynamics_listen(SbDynamics *dynamics,
                        void (*listener)(const SbMotionEvent *event, void *user), void *user);

// Moves on to `time` (not before the present). SB_ERROR_NOT_CONVERGED (too many events, a step that
// cannot be solved) leaves the last good state, which can still be sampled at its time.
SbStatus sb_dynamics_advance(SbDynamics *dynamics, double time, SbReport *report);

// State, forces and energies at the time last advanced to; either may be NULL.
void sb_dynamics_sample(const SbDynamics *dynamics, SbDynamicsSample *sample,
                        SbDynamicsEnergy *energy);

// Returns the largest force of the drive up to the time last advanced to [N], within the steps too.
double sb_dynamics_force_peak(const SbDynamics *dynamics);

// Whether the drive has ended and the stem rests: nothing more can happen.
bool sb_dynamics_at_rest(const SbDynamics *dynamics);
