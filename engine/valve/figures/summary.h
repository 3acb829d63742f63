// The summary of a run: its figures (scalar results with a path, unit and help), and the states,
// stages and verdict from which they follow. Plain data; sb_run_execute() fills it, all other code
// reads it.
//
// Figures are declared by the rows of figures.def, SB_...FIGURE(path, member, SI unit, ...). A row
// declares the member `double member` of SbSummary (SB_FIGURE), SbSealState (SB_SEAL_FIGURE) or
// SbContact (SB_CONTACT_FIGURE); unit and meaning are in the row. To read a figure by its path use
// figures.h.
#pragma once

#include "engine/valve/model/valve.h"

// Stages (events) of the cycle. The frame at an event is the state just before it.
typedef enum {
  SB_STAGE_A, // start
  SB_STAGE_B, // first slip
  SB_STAGE_C, // the land's edge reaches the inner contact (gasket: the shoulder closes the chamber)
  SB_STAGE_D, // the stem reaches the end stop
  SB_STAGE_E, // first slip in the reverse direction
  SB_STAGE_F, // the inner seal contacts the land again (gasket: the neck opens the chamber)
  SB_STAGE_COUNT
} SbStage;

// Returns "A" to "F"; static.
const char *sb_stage_name(SbStage stage);

// A stage of the cycle.
typedef struct {
  bool reached; // the motion has reached this stage; if false the other fields are meaningless
  // Values just before the event.
  double time;         // from the start of the motion [s]
  double displacement; // of the stem [m]
  double force;        // of the drive on the stem, > 0 into the canister [N]
  size_t frame;        // index in sb_run_frames() of the frame exactly at the event
} SbStageMark;

// Motions in which a seal is solved: sliding in, sliding out, at rest.
enum { SB_RUN_MOTIONS = 3 };

// How much of a seal is solved; each level includes the earlier ones.
typedef enum {
  SB_DEPTH_SIZES,   // nothing: sizes are part of the model
  SB_DEPTH_FITMENT, // the contact under the pressures at rest
  SB_DEPTH_SLIDING, // film and friction in that contact, sliding in
  SB_DEPTH_LEAK,    // sliding in at all chamber pressures of the cycle, to detect an open seal
  SB_DEPTH_WHOLE    // all states of the cycle: in both directions, at all chamber pressures
} SbSealDepth;

// Points of a gasket's contact pressure.
enum { SB_SEAL_EDGE_POINTS = 33 };

// One seal in a steady state, sliding or at rest.
//
// Each SB_SEAL_FIGURE of figures.def declares a member; NaN: not computed. sb_sliding_solve() sets
//   contact_left, contact_right  ends of the contact, x from the section's centre [m]
//   load, load_per_length        contact load with the fluid's part [N], [N/m]
//   pressure_peak                largest contact pressure above the lower fluid pressure [Pa]
//   film_min, film_central       film thickness [m]; 0 at rest
//   lambda                       film_central divided by the rms roughness [1]
//   real_area_share              real contact area divided by contact area, sliding [1]
//   rest_area_share              real contact area divided by contact area, at rest [1]
//   asperity_share               fraction of the load on asperities [1]; NaN if not coupled
//   friction_viscous             friction of the film, a magnitude [N]
//   friction_static              static friction after the rest before stage A, a magnitude [N]
//   squeeze_out_time             time at rest in which half of the film is squeezed out [s]
//
// Kinetic friction is boundary_area + boundary_load + friction_viscous, sb_sliding_friction(). The
// other members of figures.def (sizes, contact_width, contact_pressure, friction_boundary, other
// film laws, leakage) are set only in SbSummary.seal, which is the state in the middle of B-C, with
// friction_static at stage B.
typedef struct {
#define SB_SEAL_FIGURE(path, member, ...) double member;
#include "engine/valve/figures/figures.def"
  SbLeakState leak_state; // leakage at rest; only in a run's summary
  bool touches;           // the seal has contact with the bore; if false load and friction are 0
  bool opened;      // the fluid carries the load alone, or opens the contact: there is no film
  bool film_fitted; // the film is solved on the fitted body; false: on a half-plane, or by a law
  double layer;     // thickness of liquid left on the bore: flow per length divided by speed [m]
  double load_net;  // load_per_length without the fluid's part: load on the film [N/m]
  // Estimated relative errors [1] of load, load_net, contact width and pressure_peak; 0 for a
  // closed form.
  double load_error, net_error, width_error, peak_error;
  double film_error;           // relative error of film_min [1]; NaN: a closed form of exact loads
  double central_error;        // relative error of film_central [1]; NaN like film_error
  double area_error;           // relative error of real_area_share [1]
  double rest_error;           // relative error of rest_area_share [1]
  double share_error;          // relative error of asperity_share [1]
  double boundary_area;        // boundary friction tau_0 A_a, proportional to the contact width [N]
  double boundary_load;        // boundary friction m W, proportional to the load [N]
  double rest_area, rest_load; // tau_0 A_a and m W at rest, when the film is squeezed out [N]
  // Absolute errors [N] of boundary_area + boundary_load, friction_viscous, kinetic friction, and
  // friction_static.
  double boundary_error;
  double viscous_error;
  double friction_error;
  double static_error;
  // Only of a solved ring that slides, else NaN: fraction of tau_0 A_a and of viscous friction that
  // the contact pressure can transmit [1]; fraction of the friction that the section carries
  // without rolling [1]; rotation of the section [degrees], > 0 in the sense in which friction
  // turns it.
  double area_cut, borne_share, rotation;
  SbRingState section; // state of a solved ring (contact/ring/ring.h); else SB_RING_SLIDES
  // Only of a gasket: contact pressure above the lower fluid pressure [Pa] at x = middle - half
  // width cos t, at equal steps of t from 0 (left end) to pi; 0 for rings.
  double edge_pressure[SB_SEAL_EDGE_POINTS];
} SbSealState;

// Contact of a seal in the middle of a stroke. Each SB_CONTACT_FIGURE of figures.def declares a
// member; NaN: not computed. The members are width, left, right [m] (left and right are NaN without
// contact), load [N], pressure_peak [Pa], film_min, film_central [m], real_area_share [1], friction
// (kinetic, a magnitude) [N], speed [m/s] (> 0 on the in-stroke), rotation [degrees].
typedef struct {
#define SB_CONTACT_FIGURE(path, member, ...) double member;
#include "engine/valve/figures/figures.def"
  bool known;          // the contact was solved; false: all figures are NaN
  SbRingState section; // state of the ring; SB_RING_NO_CONTACT without contact
} SbContact;

// Contact of a seal on the in-stroke (middle of B-C) and on the return (middle of F-A).
typedef struct {
  SbContact in_stroke, back;
} SbContacts;

// Friction coefficients from the force signal of the sliding-plate rig, [1].
typedef struct {
  double static_coefficient;     // force of the first peak divided by the load
  double dynamic_coefficient;    // mean of the later peaks divided by the load; without later peaks
                                 // equal to mean_coefficient
  double mean_coefficient;       // mean force after the first peak, divided by the load
  double first_peak, first_time; // force and time of the first peak [N], [s]
  size_t peaks;                  // number of later peaks
  bool stick_slip;               // there are later peaks
} SbRigCoefficients;

// Result of the sliding-plate rig (rig.h).
typedef struct {
  bool found;                 // the force has a first peak; if false `of` is undefined
  SbRigCoefficients of;       // coefficients of the computed signal
  double contact_coefficient; // of friction by the valve's surface model at the rig's load [1]
  double contact_load;        // load at which that model gives the sliding coefficient [N]
} SbRigSummary;

// Extreme reactions of a joint over the run: forces on the first part of its name (bodies.h).
typedef struct {
  char name[2 * SB_BODY_NAME + 8]; // names of both parts, "stem centre, stem top"
  char kind[16];                   // sb_joint_kind_name(), "fixed"
  double axial_min, axial_max;     // minimum and maximum force along the stroke, > 0 along x [N]
  double transverse_max;           // maximum force across the stroke [N]
  double torque_max;               // maximum torque [N m]
} SbJointSummary;

// The constrained parts of a run with models.motion = bodies.
typedef struct {
  int gruebler;       // mobility by Gruebler's formula, 6 (n - 1) - constraints
  int constraints;    // number of conditions of all joints
  int freedom;        // degrees of freedom, from the rank of the conditions
  char text[SB_TEXT]; // one clause: these counts, and what is over- or under-constrained
  double moving_mass; // effective mass of the stroke, by the joints' conditions [kg]
  // Largest difference between a part's acceleration and the stroke's, divided by the sum of all
  // forces over the mass [1].
  double acceleration_error;
  double joint_error; // largest violation of a joint after a step of the motion [m]
  size_t joints;      // number of joints; 0: nothing of this structure was computed
  SbJointSummary joint[SB_VALVE_JOINTS];
} SbBodiesSummary;

// Groups of users, each with a distribution of strength; SB_USERS is their number.
typedef enum { SB_WOMEN, SB_MEN, SB_USERS } SbUsers;

// Result of one actuation.
typedef struct {
  double roughness;       // roughness of this actuation divided by the scene's [1]
  double lambda;          // central film of the outer seal divided by the roughness [1]
  double leakage;         // net leakage of the outer seal, out minus back [m3]
  double carried;         // volume that the outer seal's film carries out on the in-stroke [m3]
  double force_peak;      // largest force of the drive [N]
  double force_breakaway; // force of the drive at the first slip [N]; NaN if there is none
  double force_return;    // minimum of pressure force minus sliding friction on the return [N]
  double returned;        // 1: the stem returns to rest, 0: it does not
  double dose;            // delivered mass [kg]
} SbLifeActuation;

// Result of a life (many actuations).
typedef struct {
  long done;                   // number of actuations computed; 0: no life
  double leakage;              // sum of SbLifeActuation.leakage [m3]; NaN if the life ended early
  double carried;              // sum of SbLifeActuation.carried [m3]; NaN if the life ended early
  SbLifeActuation first, last; // figures of `last` are NaN if the life ended early
  double return_least;         // minimum of force_return [N]; NaN if no actuation has a value
  long failure;                // number from 1 of the actuation without return; 0: none
} SbLife;

// Energies of the cycle, each integrated separately; of a motion with several cycles their mean.
typedef struct {
  // Work of drive and canister pressure on the stem, and the largest magnitude of this work during
  // the cycle [J]; both NaN if only a spring moves the stem.
  double external, external_max;
  double friction; // energy dissipated by the friction of both seals, >= 0 [J]
  double stored;   // elastic energy of machine, return spring and stops, end minus start [J]
  double seal;     // energy released in jumps of the stem, or dissipated in the rubber [J]
  double kinetic;  // kinetic energy, end minus start [J]
  double stop;     // energy dissipated at the stops [J]
  double loop;     // area of the force-displacement loop: energy_loss_J [J]
  // |external - friction - stored - seal - kinetic - stop| divided by external_max; without
  // external work divided by the largest |stored|. 0: rounding (sb_cycle_closure()).
  double closure;
} SbEnergy;

// Number of points of a history.
enum { SB_SHELF_POINTS = 37 };

// Loss through one seal at rest. All figures are NaN and `state` is SB_LEAK_NOT_COMPUTED for the
// seal without pressure difference, which leaks nothing. For the other seal (sb_shelf_seal()) a NaN
// is a figure that was not computed; sb_figure_reason() returns why.
typedef struct {
  double conductance;      // permeation rate divided by permeability and pressure difference [m]
  double permeation;       // propellant through the rubber [kg/s]
  double interface;        // propellant along the contact [kg/s]
  double sensitivity;      // d ln interface/d ln contact pressure [1]; 0 if `interface` is 0
  double contact_pressure; // mean pressure of the rubber, without the fluid's part [Pa]
  double moisture;         // water through the rubber, into the can [kg/s]
  SbLeakState state;       // of the contact
} SbShelfSeal;

// Loss of a can on the shelf. NaN: not computed. `plastic` is also NaN if the scene has no path
// through the plastic; the plastic then adds 0 to all sums.
typedef struct {
  double temperature;                      // temperature of the rates below [K]
  double permeation;                       // propellant through rubber and plastic [kg/s]
  double interface;                        // propellant along the contact [kg/s]
  double plastic;                          // propellant through the plastic alone [kg/s]
  double loss_per_year, moisture_per_year; // propellant out, water in at these rates [kg/365 days]
  double lag;                              // time lag of the seal's permeation [s]
  double loss, moisture;                   // propellant lost, water taken up in shelf.time [kg]
  double mass_left, doses_left; // after shelf.time: propellant [kg]; number of complete doses
  double error;                 // relative error of the conductance [1]; NaN: closed form
  double pressure_error;        // relative error of the seal's contact pressure [1]
  SbShelfSeal seal[SB_SEAL_COUNT];
  bool typical;  // a permeability is a typical value of such rubbers, not measured
  size_t points; // number of points; 0: no history was computed
  struct {
    double time;        // from the start of the storage [s]
    double temperature; // mean since the previous point [K]
    // Propellant lost since the start through rubber, along the contact and through the plastic
    // (NaN: no such path); water taken up since the start [kg].
    double permeated, passed, plastic, moisture;
    double doses; // number of complete doses that remain
  } point[SB_SHELF_POINTS];
} SbShelf;

// How much of the shelf is computed.
typedef enum {
  SB_SHELF_NOTHING,
  SB_SHELF_RATES,    // rates at the model's temperature
  SB_SHELF_OVER_TIME // rates, and sums over the temperature history
} SbShelfDepth;

// Number of figures: one for each row of figures.def, two for each row of a seal, four for each row
// of a seal's contact.
enum {
  SB_FIGURE_COUNT =
#define SB_FIGURE(...)         +1
#define SB_FIGURE_AT(...)      +1
#define SB_SEAL_FIGURE(...)    +SB_SEAL_COUNT
#define SB_CONTACT_FIGURE(...) +2 * SB_SEAL_COUNT
#include "engine/valve/figures/figures.def"
};

// Capacity of different reasons.
enum { SB_REASONS_MAX = 48 };

// Why figures were not computed; read it by sb_figure_reason(). of[index] is 0 if the figure has no
// reason, else the reason is text[of[index] - 1].
typedef struct {
  size_t count; // number of texts
  char text[SB_REASONS_MAX][SB_TEXT];
  unsigned char of[SB_FIGURE_COUNT];
} SbReasons;

// How the motion of the stem ends.
typedef enum {
  SB_OUTCOME_UNKNOWN,     // no motion was computed, it failed, or the stem still moves at its end
  SB_OUTCOME_NEVER_MOVED, // the drive does not overcome the static friction
  SB_OUTCOME_STUCK,       // at rest away from its rest stop, not pushed by the drive
  SB_OUTCOME_RETURNED,    // at rest on its rest stop, released by the drive
  SB_OUTCOME_HELD         // the drive still pushes the stem, or is bonded to it
} SbOutcome;

// Answer of a criterion; UNKNOWN: not computed, no limit is set, or the error exceeds the margin.
typedef enum { SB_ANSWER_UNKNOWN, SB_ANSWER_NO, SB_ANSWER_YES } SbAnswer;

// One criterion of the verdict: the answer, and the figure that decides it.
typedef struct {
  SbAnswer ok; // YES: the criterion is met
  int figure;  // index for sb_figure(); -1: no figure decides
  // Value of this figure (NaN: not computed) and the limit that it is compared with (NaN: none), in
  // the figure's SI unit.
  double value, limit;
  char reason[SB_TEXT]; // one sentence about the answer, or ""
} SbVerdict;

// Results of a run. Each SB_FIGURE of figures.def declares a member (force_peak, force_breakaway,
// leakage_per_cycle, dose_mass, ...; NaN: not computed). Read them by name, or by path with
// sb_figure_value().
typedef struct {
#define SB_FIGURE(path, member, ...) double member;
#include "engine/valve/figures/figures.def"
  SbStatus status; // what sb_run_execute() returned
  SbOutcome outcome;
  bool returns; // the outcome is SB_OUTCOME_RETURNED
  bool closes;  // the motion ends where it began: a full cycle
  double dwell; // rest before the return whose static friction the return margin has [s]
  SbStageMark stage[SB_STAGE_COUNT]; // by SbStage
  SbSealState seal[SB_SEAL_COUNT];   // by SB_OUTER, SB_INNER: state in the middle of B-C
  SbContacts contact[SB_SEAL_COUNT]; // by SB_OUTER, SB_INNER
  SbBodiesSummary bodies;            // joints = 0: not computed
  SbEnergy energy;
  // Fraction of users whose strength is below the peak force, and below the break-away force [1],
  // by SbUsers.
  double below_peak[SB_USERS], below_breakaway[SB_USERS];
  SbRigSummary rig; // defined if models.motion = rig
  SbLife life;      // done = 0: no life
  SbShelf shelf;    // points = 0: without history
  SbWarnings warnings;
  SbReasons reasons;
  SbVerdict verdict[SB_VERDICT_COUNT]; // by SbVerdictKind
  bool converged;                      // status is SB_OK
  // Number of frames; of segments and time steps of the motion; of rejected time steps.
  size_t frames, steps, rejected_steps;
  size_t work;                   // solver steps counted against output.work_limit
  double wall_s;                 // elapsed time of the computation [s]
  double error[SB_FIGURE_COUNT]; // estimated absolute error of figure [index], SI; NaN: not known
  // Of a predicted run (sb_run_predict_from()), by seal: sum of the forces that violate the ring's
  // active set, divided by the load on the bore [1]; else 0.
  double ring_fault[SB_SEAL_COUNT];
  double ring_order;   // largest number of polynomials of a ring's recovered pressure per node [1]
  double error_width;  // largest relative error of the contact widths [1]; NaN: does not apply
  SbCounters counters; // number of solves
} SbSummary;
