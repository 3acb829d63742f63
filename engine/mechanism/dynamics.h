// Motion of the stem in one coordinate, with stick-slip friction, stops, and a drive that only
// pushes.
//
//   m x'' = drive + pressure - spring - sum of seal frictions - damping x' + stop reactions
//
// (thesis ch. 4 with one degree of freedom; friction and contact laws are ours where the thesis has
// none.) x > 0 is into the canister. A drive force > 0 pushes into the canister.
//
// Friction. The caller gives a level L [N] of each contact as a function of x: its sliding friction
// in the limit of zero speed. While it sticks, a contact carries up to L (static_ratio + dwell_gain
// ln(1 + dwell/dwell_time)), or up to L times a law of the dwell (dwell.h). While it slides, its
// friction is L [1 + (static_ratio - 1) exp(-(speed/stribeck_speed)^stribeck_exponent)], or L if
// stribeck_speed is 0. Further speed dependence is piecewise linear in |v| and continuous ("bands"
// of speed); it acts in addition to the tangential spring, while the contact slides, and may
// increase or decrease. Where a contact sticks and slips in turn because of that (in slips shorter
// than a thousandth of damping/stiffness), it carries up to 0.1 % more than stated above. A contact
// of finite `stiffness` connects stem and bore by a tangential spring and damper; its patch does
// not move while it sticks. A rigid contact (stiffness INFINITY) fixes the stem while it sticks. A
// contact with level 0 does not exist.
//
// Stops. A spring and damper that only push, with the damping of a given restitution (Schwager and
// Poeschel 2007); stiffness INFINITY is an impact law, with rest once the rebound is below 1 pm. A
// stop or platen that has lost contact relaxes by its own damper and can be met again.
//
// Method. Between two events (a segment) the motion is linear in most models and has a closed form
// (oscillator.h). Events are found with bounds, so the duration of a rest costs nothing. Periodic
// stick-slip is not stepped through. Stribeck's exponential, loads that vary with x, and sinusoids
// are integrated by Radau IIA with error control. Each energy term is integrated separately, so
// their balance checks the result. Nothing is allocated. Not modelled: rotation and tilt of the
// stem, waves in the parts, a speed law of the patch (the stem's speed is used).
//
// One SbDynamics is used by one thread at a time; different ones may run concurrently if the
// callbacks allow it.
#pragma once

#include "engine/base/status.h"
#include "engine/mechanism/drive.h"
#include "engine/mechanism/dwell.h"
#include "engine/mechanism/oscillator.h"
#include "engine/mechanism/radau.h"

// Largest numbers of contacts, stops and edges.
enum {
  SB_DYNAMICS_CONTACTS = 4,
  SB_DYNAMICS_STOPS = 2,
  SB_DYNAMICS_EDGES = 8,
};

// Friction law of a contact.
typedef struct {
  double static_ratio;      // static friction divided by L, >= 1
  double dwell_gain;        // increase of that ratio per factor e of the dwell, >= 0
  double dwell_time;        // [s], > 0 if dwell_gain > 0
  double stribeck_speed;    // [m/s]; 0: friction is L from the first slip on
  double stribeck_exponent; // > 0 if stribeck_speed > 0
  double stiffness;         // of the tangential spring, > 0 [N/m]; INFINITY: rigid
  double damping; // of the tangential spring, >= 0 [N s/m]; > 0 if stribeck_speed is used; not used
                  // if rigid
} SbDynamicsContact;

// A stop.
typedef struct {
  double position;    // x at which the stem meets it [m]
  int side;           // +1 stops motion to +x, -1 to -x
  double stiffness;   // [N/m]; INFINITY: impact law
  double restitution; // of a free impact: 0.01 to 1, or 0 to 1 if stiffness is INFINITY
} SbDynamicsStop;

// Loads on the stem at one position.
typedef struct {
  double force;                       // net force other than drive, spring, friction and stops [N]
  double level[SB_DYNAMICS_CONTACTS]; // L for sliding to +x [N]; 0: no contact
  double back[SB_DYNAMICS_CONTACTS];  // L for sliding to -x minus L for sliding to +x [N]
  // Static friction divided by L as a function of the dwell, borrowed; NULL: the constants of
  // SbDynamicsContact.
  const SbDwellLaw *rest[SB_DYNAMICS_CONTACTS];
  bool constant; // loads and extra state do not change until the next edge is crossed
  bool settled;  // the extra state does not change while the stem is at rest
} SbDynamicsLoads;

// Speed dependence of the friction of sliding contacts in a band of speed low <= |v| < high: rise +
// slope |v| is added to L [N].
typedef struct {
  double low, high;                   // [m/s]; high INFINITY: no upper end
  double rise[SB_DYNAMICS_CONTACTS];  // [N]
  double slope[SB_DYNAMICS_CONTACTS]; // [N s/m], of either sign
} SbDynamicsBand;

// A mechanism. Start with {0} and set what is needed; `mass` must be > 0. Callbacks get `user` and
// must not call functions with the SbDynamics that calls them. `extra` is one additional state of
// the caller, such as the pressure of the dose chamber.
typedef struct {
  double mass;    // [kg], > 0
  double damping; // of the stem against ground [N s/m]
  // Force of the return spring on the stem: -(preload + stiffness x) [N], [N/m].
  double spring_preload, spring_stiffness;
  size_t contacts, stops, edges; // numbers in use
  SbDynamicsContact contact[SB_DYNAMICS_CONTACTS];
  SbDynamicsStop stop[SB_DYNAMICS_STOPS];
  // Positions at which the loads change [m], increasing. Region r is from edge[r-1] to edge[r];
  // region 0 is x < edge[0], region `edges` is x > edge[edges - 1]. A stem that starts on edge[i]
  // is in region i + 1.
  double edge[SB_DYNAMICS_EDGES];
  // Writes the loads at x in a region; *loads is zeroed before. If they are constant it is called
  // once for each visit of a region. NULL: no loads.
  void (*loads)(SbDynamicsLoads *loads, double x, size_t region, const double *extra, void *user);
  // Writes the band that contains `speed` = |v|, for motion in `direction` (+1 or -1); *band is
  // zeroed before. Where the loads are constant it is called once for each band, else as often as
  // `loads`. NULL: no speed dependence.
  void (*band)(SbDynamicsBand *band, double x, size_t region, int direction, double speed,
               const double *extra, void *user);
  // Called when the stem crosses edge[i] in `direction` (+1 or -1), i = `edge`; may change *extra
  // and the caller's own state. NULL: not wanted.
  void (*cross)(size_t edge, int direction, double *extra, void *user);
  // Writes the time derivative of the extra state; called while the loads are not constant. NULL:
  // no extra state.
  void (*extra_rate)(double *rate, double x, double v, size_t region, const double *extra,
                     void *user);
  double extra_start, extra_scale; // `extra` at the start; its typical size, for the tolerance, > 0
                                   // if extra_rate is set
  // Called once in each segment; true ends the motion with SB_ERROR_CANCELLED. NULL: never.
  bool (*poll)(void *data);
  void *poll_data;
  // Writes the effective mass at (x, v) [kg]; called at the start of each segment. An error ends
  // the motion. NULL: `mass`.
  SbStatus (*mass_at)(double *mass, double x, double v, void *user, SbReport *report);
  void *user;
  SbDrive drive; // {0}: no drive; its arrays are borrowed
  // Spring and damper between the platen and the stem [N/m] > 0, finite; [N s/m] >= 0. A drive of
  // force ignores the stiffness; its force is reduced by drive_damping times the speed and ends
  // when the drive's force is 0.
  double drive_stiffness, drive_damping;
  bool drive_bonded;                  // the drive also pulls
  double start_position, start_speed; // [m], [m/s]
  double start_dwell;                 // time at rest before the start [s]
  double tolerance;  // relative tolerance of the numerical integration, <= 1e-5; 0: 1e-9
  double rest_speed; // speed [m/s] below which a decelerating contact comes to rest; 0: 1e-9
} SbDynamicsModel;

// Kind of an event.
typedef enum {
  SB_MOTION_SLIP,        // contact `index` begins to slide in direction `sign`; index -1: all rigid
                         // contacts
  SB_MOTION_STICK,       // contact `index` comes to rest; index -1: all rigid contacts
  SB_MOTION_TOUCH_STOP,  // the stem meets stop `index`
  SB_MOTION_LEAVE_STOP,  // the stem leaves stop `index`
  SB_MOTION_TOUCH_DRIVE, // platen or finger meets the stem
  SB_MOTION_LEAVE_DRIVE, // platen or finger leaves the stem
  SB_MOTION_EDGE,        // the stem crosses edge `index` in direction `sign`
} SbMotionEventKind;

// An event, with the state just before it.
typedef struct {
  SbMotionEventKind kind;
  int index, sign;                           // see SbMotionEventKind; sign 0 if not used
  double time, position, speed, drive_force; // [s], [m], [m/s], [N]
} SbMotionEvent;

// Number of integrated energy terms.
enum { SB_DYNAMICS_TERMS = 7 };

// Energies since the start [J].
typedef struct {
  union {
    struct {
      double drive;    // work done by the drive at its moving end
      double pressure; // work of SbDynamicsLoads.force
      double friction; // dissipated by sliding contacts
      double viscous;  // dissipated by `damping`
      double seal;     // dissipated by the dampers of the tangential springs
      double stop;     // dissipated by the stops
      double machine;  // dissipated by drive_damping
    };
    double term[SB_DYNAMICS_TERMS]; // the same as an array
  };
  double kinetic; // kinetic energy minus that at the start
  double stored;  // in tangential springs, stops, return spring and drive, minus that at the start
  double largest; // largest |drive + pressure| so far
  double largest_stored; // largest |stored| so far
  // |drive + pressure - all other terms| divided by `largest`, or by largest_stored if that is 0; 0
  // if both are 0.
  double closure;
} SbDynamicsEnergy;

// State of a contact.
typedef enum {
  SB_CONTACT_OFF,   // no contact: level 0
  SB_CONTACT_STUCK, // at rest on the bore
  SB_CONTACT_SLIP   // sliding
} SbContactState;

// State and forces at one time. Forces on the stem are positive into the canister.
typedef struct {
  double time, position, speed, acceleration; // [s], [m], [m/s], [m/s2]
  // Position of the platen [m]; of the stem with a drive of force; 0 without a drive.
  double drive_position;
  double drive_force, loads_force, spring_force; // forces of drive, SbDynamicsLoads.force and
                                                 // return spring on the stem [N]
  double stop_force[SB_DYNAMICS_STOPS];          // magnitude of the reaction, >= 0 [N]
  double friction[SB_DYNAMICS_CONTACTS];         // friction force on the stem [N]
  double deflection[SB_DYNAMICS_CONTACTS]; // of the tangential spring [m], > 0 if the stem has
                                           // moved to +x relative to the patch
  SbContactState contact[SB_DYNAMICS_CONTACTS];
  double extra; // extra state of the caller
  size_t region;
} SbDynamicsSample;

// Cost of a motion so far.
typedef struct {
  long events, segments, steps, rejected, newton_iterations;
  long repeated;      // cycles of stick-slip that were not stepped through
  long grouped;       // those of them that change slowly from cycle to cycle
  double local_error; // sum of the estimated errors of position divided by (|x| + 1 mm), numerical
                      // path
} SbDynamicsCounters;

// Unknowns of the motion, by name and as an array.
typedef union {
  struct {
    double x, v;                    // [m], [m/s]
    double extra;                   // extra state of the caller
    double d[SB_DYNAMICS_CONTACTS]; // deflections of the tangential springs [m]; 0 if rigid
  };
  double z[3 + SB_DYNAMICS_CONTACTS];
} SbDynamicsState;

// A spring and damper that push the stem in one direction: a stop, or the platen. A drive of force
// has no spring.
typedef struct {
  bool on;                   // in contact
  int push;                  // direction of its force, +1 or -1
  double stiffness, damping; // [N/m] (INFINITY: rigid), [N s/m]
  double residual, since;    // deflection [m] when contact was lost, and that time [s]
} SbDynamicsWall;

// Indices of the walls: the stops, then the platen.
enum { SB_DYNAMICS_PLATEN = SB_DYNAMICS_STOPS, SB_DYNAMICS_WALLS };

// The state at a break-away, where a cycle of stick-slip begins and ends (private).
typedef struct {
  int event; // event that began the slip; -1: none yet
  size_t region;
  // Counted so far: all events; contacts made and lost by the platen; events that no cycle has;
  // segments.
  long events, platens, others, segments;
  double t, until; // time; end of the drive's piece [s]
  double stretch;  // position of the platen minus x [m]
  SbDynamicsState at;
  SbContactState state[SB_DYNAMICS_CONTACTS];
  double rest[SB_DYNAMICS_CONTACTS]; // time since the contact came to rest [s]
  SbDynamicsEnergy energy;
} SbDynamicsBreak;

// A group of slowly changing cycles that was passed over (private). Energies of a group follow from
// the power of each term [W] in cycles before, between and after the groups.
typedef struct {
  bool open;       // the energies of the last group are extrapolated so far
  double from, to; // the last group [s]
  double span;     // its duration [s]
  double rest[SB_DYNAMICS_CONTACTS], longer[SB_DYNAMICS_CONTACTS]; // last dwell, its change [s]
  // Dwell before the group [s], its rate of change [1].
  double rested[SB_DYNAMICS_CONTACTS], slower[SB_DYNAMICS_CONTACTS];
  double middle[2], power[2][SB_DYNAMICS_TERMS], taken[SB_DYNAMICS_TERMS]; // [s], [W], [J]
} SbDynamicsGroup;

// What a cycle of stick-slip changes per unit of time (private): the energies, the stretch, the
// speed, deflections and dwells at its break-away.
enum {
  SB_DYNAMICS_OF_STRETCH = SB_DYNAMICS_TERMS,
  SB_DYNAMICS_OF_SPEED,
  SB_DYNAMICS_OF_DEFLECTION,
  SB_DYNAMICS_OF_REST = SB_DYNAMICS_OF_DEFLECTION + SB_DYNAMICS_CONTACTS,
  SB_DYNAMICS_RATES = SB_DYNAMICS_OF_REST + SB_DYNAMICS_CONTACTS
};
typedef struct {
  double middle;                  // of the cycle [s]; 0: not known
  double rate[SB_DYNAMICS_RATES]; // [W], [1], [m/s2], [m/s], [1]
} SbDynamicsRates;

// Cycles of elastic contacts that change slowly, and groups of them that are passed over (private).
typedef struct {
  bool on;                  // groups are passed over until something else happens
  SbDynamicsBreak mark;     // where the present cycle began
  long since, after;        // break-aways since then, and the number after which `mark` is replaced
  long slips;               // break-aways of the last cycle
  long window;              // segments of a cycle at least; shorter ones are taken together
  int waited;               // cycles since the last group; negative: cycles to step through
  double span;              // largest duration of the next group [s]
  SbDynamicsRates cycle;    // of the last cycle
  SbDynamicsRates known[2]; // [1] of the cycle before the last group, [0] of one before that cycle
  bool open;                // the energies of the last group are extrapolated so far
  double from, to;          // the last group [s]
  double taken[SB_DYNAMICS_TERMS]; // its energies [J]
  double stored;                   // by how much its ends differ in stored and kinetic energy [J]
} SbDynamicsEnvelope;

// Working state, in memory of the caller; owns nothing, so it need not be freed.
// Read `counters` and `force_peak`; all other fields are private.
typedef struct {
  SbDynamicsCounters counters;  // cost so far
  double force_peak;            // largest force of the drive up to the last event [N]
  const SbDynamicsModel *model; // borrowed
  double t, t_end;              // start and end of the segment [s]
  SbDynamicsState at;           // at the start of the segment
  double now;                   // time last advanced to [s]
  double mass;                  // effective mass in the segment [kg]
  SbContactState state[SB_DYNAMICS_CONTACTS];
  int sign[SB_DYNAMICS_CONTACTS];     // direction of sliding
  double since[SB_DYNAMICS_CONTACTS]; // time at which the rest began [s]
  // Time of the last slip [s]; addition to the static friction because that slip had hardly any
  // duration [N].
  double slipped[SB_DYNAMICS_CONTACTS], margin[SB_DYNAMICS_CONTACTS];
  bool fresh[SB_DYNAMICS_CONTACTS]; // newly loaded: static friction is that of sliding
  size_t region;
  SbDynamicsLoads loads;
  SbDynamicsBand band; // of the segment, if `banded`
  int direction;       // of the motion, +1 or -1
  bool banded, fell;   // a contact slides with a band; the speed left its band downwards
  SbDynamicsWall wall[SB_DYNAMICS_WALLS]; // the stops, and the platen
  SbDriveState drive;
  SbDrivePiece piece;
  SbDynamicsEnergy energy;     // at the start of the segment
  SbDynamicsBreak broke, mark; // last break-away, and the one with which later ones are compared
  // Break-aways since `mark`, and the number after which it is replaced.
  long since_mark, mark_after;
  double least_stretch; // smallest |platen - x| at events since `mark` [m]
  long platens, others; // see SbDynamicsBreak
  SbDynamicsGroup group;
  SbDynamicsEnvelope envelope;
  double asked;                       // target of sb_dynamics_advance() [s]
  double stored_start, kinetic_start; // [J]
  bool ready, linear, held;           // the segment is known; has a closed form; the stem is fixed
  bool brisk[SB_DYNAMICS_CONTACTS];   // the patch began the segment clearly faster than rest_speed
  int event;                          // that ends the segment, or -1
  SbOscillator motion;                // closed form
  SbRadauSystem system;               // numerical path
  size_t unknown[SB_RADAU_MAX];       // indices of its unknowns in SbDynamicsState.z
  double speed_size;                  // speed to which its tolerance refers [m/s]
  SbRadauStep step[2];
  double h;              // next step size [s]
  double accumulated_at; // time of the last event [s]
  int accumulated;       // number of events at that time
  void (*listener)(const SbMotionEvent *event, void *user);
  void *listener_user;
} SbDynamics;

// Checks a model. SB_ERROR_RANGE or SB_ERROR_INPUT, with the quantity and its range.
SbStatus sb_dynamics_check(const SbDynamicsModel *model, SbReport *report);

// Checks the model and sets the state at time 0. `model` is borrowed while *dynamics is used; it
// must not change. Errors as for sb_dynamics_check().
SbStatus sb_dynamics_init(SbDynamics *dynamics, const SbDynamicsModel *model, SbReport *report);

// Sets a function that is called at each event, with `user`; NULL: none. To be called after
// sb_dynamics_init(), which removes the function. Events of cycles that are passed over
// (counters.repeated) are not reported.
void sb_dynamics_listen(SbDynamics *dynamics,
                        void (*listener)(const SbMotionEvent *event, void *user), void *user);

// Advances the motion to `time` [s], which must not be before the present time (SB_ERROR_RANGE).
// SB_ERROR_CANCELLED: `poll` returned true. SB_ERROR_NOT_CONVERGED: too many segments, accumulating
// events, or a step that cannot be solved. An error of `mass_at` is returned. After an error the
// motion is at the last good state, which sb_dynamics_sample() returns.
SbStatus sb_dynamics_advance(SbDynamics *dynamics, double time, SbReport *report);

// Writes state and forces to *sample and the energies to *energy, at the present time; either may
// be NULL. Requires one sb_dynamics_advance() before.
void sb_dynamics_sample(const SbDynamics *dynamics, SbDynamicsSample *sample,
                        SbDynamicsEnergy *energy);

// Returns the largest force of the drive up to the present time [N], including times between
// samples.
double sb_dynamics_force_peak(const SbDynamics *dynamics);

// Returns whether the drive has ended and the stem is at rest, so that nothing can happen any more.
bool sb_dynamics_at_rest(const SbDynamics *dynamics);
