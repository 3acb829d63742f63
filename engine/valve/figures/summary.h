// The summary of a run: its figures, and the states, stages and verdict that they belong to. Plain
// data; a run fills it, and all other code reads it.
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
  bool reached;
  // Just before the event; NaN if not reached.
  double time;         // [s]
  double displacement; // of the stem [m]
  double force;        // of the drive [N]
  size_t frame;        // index of the frame exactly at the event
} SbStageMark;

// Motions in which a seal is solved: sliding in, sliding out, at rest.
enum { SB_RUN_MOTIONS = 3 };

// How much of a seal is solved; each level includes the earlier ones.
typedef enum {
  SB_DEPTH_SIZES,   // nothing: sizes are part of the model
  SB_DEPTH_FITMENT, // the contact under the pressures at rest
  SB_DEPTH_SLIDING, // film and friction in that contact, sliding in
  SB_DEPTH_LEAK,    // sliding in at the other chamber pressures, to detect an open seal
  SB_DEPTH_WHOLE    // all states of the cycle
} SbSealDepth;

// Points of a gasket's contact pressure.
enum { SB_SEAL_EDGE_POINTS = 33 };

// One seal in a steady state, sliding or at rest: one member for each SB_SEAL_FIGURE of figures.def
// (meaning and unit there; NaN: not computed), and what they follow from. In a run's summary it is
// the state in the middle of B-C, friction_static that at B.
typedef struct {
#define SB_SEAL_FIGURE(path, member, ...) double member;
#include "engine/valve/figures/figures.def"
  SbLeakState leak_state;
  bool touches;
  bool opened;      // by the fluid: the rubber has no contact pressure, or no film can be solved
  bool film_fitted; // film_min and film_central are solved on the fitted body
  double layer;     // thickness that it leaves on the bore: flow per length divided by speed [m]
  double load_net;  // per length, without the fluid's step: load that the film carries [N/m]
  // Relative errors of the fit [1], 0 of a closed form: load, load_net, contact width, peak
  // pressure.
  double load_error, net_error, width_error, peak_error;
  double film_error;           // of the minimum film, relative; NaN: a closed form of exact loads
  double central_error;        // of film_central, relative
  double area_error;           // of the real area while sliding, relative
  double rest_error;           // of the real area at rest, relative
  double share_error;          // of the asperities' share of the load, relative
  double boundary_area;        // tau_0 A_a, part of F_b proportional to the width [N]
  double boundary_load;        // m W, part proportional to the load [N]
  double rest_area, rest_load; // the same two at rest, when the film is squeezed out [N]
  double boundary_error;       // of boundary_area + boundary_load [N]
  double viscous_error;        // of friction_viscous [N]
  double friction_error;       // of kinetic friction, by its film and its fit [N]
  double static_error;         // of static friction, by its fit and its dry contact [N]
  // Of a ring dragged by friction, else NaN: fraction of tau_0 A_a that the pressure can transmit;
  // fraction of the friction that the section bears; rotation [degrees], > 0 as friction turns it.
  double area_cut, borne_share, rotation;
  SbRingState section;
  // Contact pressure of a gasket above the lower fluid pressure [Pa], at equal steps of the angle t
  // from its left end, x = middle - half width cos t; 0 of rings.
  double edge_pressure[SB_SEAL_EDGE_POINTS];
} SbSealState;

// A seal in a steady stroke: one member for each SB_CONTACT_FIGURE of figures.def.
typedef struct {
#define SB_CONTACT_FIGURE(path, member, ...) double member;
#include "engine/valve/figures/figures.def"
  bool known;
  SbRingState section;
} SbContact;

// In the middle of B-C and of F-A.
typedef struct {
  SbContact in_stroke, back;
} SbContacts;

// Evaluation of a signal.
typedef struct {
  double static_coefficient;     // first peak/load
  double dynamic_coefficient;    // mean of the following peaks/load; mean_coefficient without any
  double mean_coefficient;       // mean force after the first peak/load
  double first_peak, first_time; // of the first peak [N], [s]
  size_t peaks;                  // number of following peaks
  bool stick_slip;               // there are following peaks
} SbRigCoefficients;

// Result of the sliding-plate rig (rig.h).
typedef struct {
  bool found; // the force has a first peak; else the coefficients are undefined
  SbRigCoefficients of;
  double contact_coefficient; // of friction by the valve's surface model at the rig's load [1]
  double contact_load;        // load at which that model gives the sliding coefficient [N]
} SbRigSummary;

// Largest loads of a joint over the run, on the first part of its name; bodies.h.
typedef struct {
  char name[2 * SB_BODY_NAME + 8]; // "stem centre, stem top"
  char kind[16];
  double axial_min, axial_max; // force along the stroke [N]
  double transverse_max;       // [N]
  double torque_max;           // [N m]
} SbJointSummary;

// The constrained parts of a run with models.motion = bodies.
typedef struct {
  int gruebler, constraints, freedom; // SbMobility
  char text[SB_TEXT];
  double moving_mass; // effective mass of the stroke, by the joints' conditions [kg]
  // Largest difference between a part's acceleration and the stroke's, divided by the sum of all
  // forces over the mass [1].
  double acceleration_error;
  double joint_error; // largest violation of a joint after a step of the motion [m]
  size_t joints;      // 0: not computed
  SbJointSummary joint[SB_VALVE_JOINTS];
} SbBodiesSummary;

// Groups of users, each with a distribution of strength; SB_USERS is their number.
typedef enum { SB_WOMEN, SB_MEN, SB_USERS } SbUsers;

// Result of one actuation.
typedef struct {
  double roughness;       // divided by the scene's [1]
  double lambda;          // film divided by roughness [1]
  double leakage;         // net [m3]
  double carried;         // out under the film on the in-stroke [m3]
  double force_peak;      // [N]
  double force_breakaway; // at the first slip [N]; NaN if there is none
  double force_return;    // minimum [N]
  double returned;        // 1: the stem returns to rest, 0: it does not
  double dose;            // delivered [kg]
} SbLifeActuation;

// Result of a life (many actuations).
typedef struct {
  long done;                   // actuations computed
  double leakage;              // sum [m3]; NaN if the life ended early
  double carried;              // sum [m3]; NaN if the life ended early
  SbLifeActuation first, last; // figures of `last` are NaN if the life ended early
  double return_least;         // minimum over the life [N]; NaN if no actuation has one
  long failure;                // number from 1 of the actuation without return; 0: none
} SbLife;

// Energies of the cycle, each integrated separately.
typedef struct {
  // Work of platen and canister pressure on the stem, and its largest magnitude during the cycle
  // [J]; NaN if only a spring moves the stem.
  double external, external_max;
  double friction; // dissipated by both seals [J]
  double stored;   // change of elastic energy in machine and stops [J]
  double seal;    // released in jumps of the stem (slip, land edge) or dissipated in the rubber [J]
  double kinetic; // change [J]
  double stop;    // dissipated at the stops [J]
  double loop;    // area of the force-displacement loop: energy_loss_J [J]
  // |external - friction - stored - seal - kinetic - stop| divided by external_max, or by the
  // largest |stored| without external work.
  double closure;
} SbEnergy;

// Number of points of a history.
enum { SB_SHELF_POINTS = 37 };

// One seal at rest; NaN: not computed. All values of a seal without pressure difference are NaN; it
// leaks nothing.
typedef struct {
  double conductance;      // S_g [m]
  double permeation;       // [kg/s]
  double interface;        // along the contact [kg/s]
  double sensitivity;      // d ln interface/d ln contact pressure
  double contact_pressure; // mean, of the rubber only [Pa]
  double moisture;         // water inwards [kg/s]
  SbLeakState state;
} SbShelfSeal;

// A can. Without a path through the plastic `plastic` is NaN and the sums are the seals'. NaN: not
// computed.
typedef struct {
  double temperature;                      // of the rates below [K]
  double permeation;                       // propellant through seals and plastic [kg/s]
  double interface;                        // propellant along the contacts [kg/s]
  double plastic;                          // part of `permeation` through the plastic [kg/s]
  double loss_per_year, moisture_per_year; // at these rates [kg per 365 days]
  double lag;                              // time lag of the seal's permeation [s]
  double loss, moisture;                   // propellant lost, water taken up in shelf.time [kg]
  double mass_left, doses_left;            // remaining propellant [kg], complete doses
  double error;                            // relative, of S_g; NaN: closed form
  double pressure_error;                   // relative, of the seal's contact pressure
  SbShelfSeal seal[SB_SEAL_COUNT];
  bool typical;  // a value that is typical of such rubbers was used
  size_t points; // of the history; 0: not computed
  struct {
    double time;        // [s]
    double temperature; // mean since the previous point [K]
    // Sums since the start through rubber, contact, plastic; water taken up [kg].
    double permeated, passed, plastic, moisture;
    double doses; // remaining complete doses
  } point[SB_SHELF_POINTS];
} SbShelf;

// How much of the shelf is computed.
typedef enum {
  SB_SHELF_NOTHING,
  SB_SHELF_RATES,    // rates at the model's temperature
  SB_SHELF_OVER_TIME // and the history
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

// Why figures were not computed (figures.h): of[index] is 0 for no reason, else text[of - 1].
typedef struct {
  size_t count;
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

// Answer of a criterion.
typedef enum { SB_ANSWER_UNKNOWN, SB_ANSWER_NO, SB_ANSWER_YES } SbAnswer;

// One criterion of the verdict: the answer, and the figure that decides it.
typedef struct {
  SbAnswer ok;
  int figure;           // index; -1: none
  double value, limit;  // in the figure's SI unit; NaN: none
  char reason[SB_TEXT]; // one sentence, or ""
} SbVerdict;

// Results of a run: one member for each SB_FIGURE of figures.def (meaning and unit there; NaN: not
// computed), and further data.
typedef struct {
#define SB_FIGURE(path, member, ...) double member;
#include "engine/valve/figures/figures.def"
  SbStatus status;
  SbOutcome outcome;
  bool returns; // the outcome is SB_OUTCOME_RETURNED
  SbStageMark stage[SB_STAGE_COUNT];
  SbSealState seal[SB_SEAL_COUNT];
  SbContacts contact[SB_SEAL_COUNT];
  SbBodiesSummary bodies;
  SbEnergy energy;
  // Fraction of users who are weaker than the peak force, and than the break-away force [1].
  double below_peak[SB_USERS], below_breakaway[SB_USERS];
  SbRigSummary rig; // models.motion = rig
  SbLife life;      // done = 0: no life
  SbShelf shelf;    // points = 0: without history
  SbWarnings warnings;
  SbReasons reasons;
  SbVerdict verdict[SB_VERDICT_COUNT];
  bool converged; // status is SB_OK
  size_t frames, steps, rejected_steps;
  size_t work;   // solver steps counted against output.work_limit, in all actuations of a life
  double wall_s; // elapsed time of the computation [s]
  double error[SB_FIGURE_COUNT]; // of each figure, absolute in its SI unit; NaN: not known
  // Of the rings of a predicted run: forces that violate their active sets, divided by the bore's
  // [1].
  double ring_fault[SB_SEAL_COUNT];
  double ring_order;  // largest number of polynomials of a ring's recovered pressure per node [1]
  double error_width; // of contact widths, relative like error_load [1]; NaN: does not apply
  SbCounters counters;
} SbSummary;
