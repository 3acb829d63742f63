// A run: the cycle of one scene, computed by the thread that calls sb_run_execute().
//
// Use: sb_run_create(), sb_run_execute(), then the functions that read; sb_run_destroy() at the
// end. One thread executes. Any other thread may at the same time read published frames, and
// profiles and shapes that they refer to: sb_run_frames() returns a constant array and the number
// of complete frames (acquire/release). A reader never waits, and a published frame does not change
// until the run is executed or renewed again.
#pragma once

#include "engine/valve/run/frame.h"
#include "engine/valve/run/plan.h"
#include "engine/valve/run/rig.h"
#include "engine/valve/shelf/shelf.h"

#include <stdatomic.h>

// A run.
typedef struct SbRun SbRun;

// Callbacks of sb_run_execute(), called in its thread.
typedef struct {
  // Completed fraction, 0 to 1, and the number of published frames; at most every few milliseconds.
  // NULL: none.
  void (*progress)(void *data, double fraction, size_t frames);
  // True ends the run within 50 ms with SB_ERROR_CANCELLED; its frames so far remain. NULL: never.
  bool (*cancelled)(void *data);
  void *data;
  bool alone; // the run starts no thread of its own; false: it may solve the two seals at a time
} SbRunHooks;

// A stage of the cycle.
typedef struct {
  bool reached;
  // Just before the event; NaN if not reached.
  double time;         // [s]
  double displacement; // of the stem [m]
  double force;        // of the drive [N]
  size_t frame;        // index of the frame exactly at the event
} SbStageMark;

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

// Creates a run of `model` by `plan` (both are copied). SB_ERROR_MEMORY.
SbStatus sb_run_create(SbRun **out, const SbModel *model, const SbPlan *plan, SbReport *report);

// Turns a run that no thread executes into one for another model and plan (both are copied). Only
// its memory is reused; whatever was borrowed from it becomes invalid. After SB_ERROR_MEMORY it can
// only be renewed again or destroyed.
SbStatus sb_run_renew(SbRun *run, const SbModel *model, const SbPlan *plan, SbReport *report);

// Does the same with the present plan, for a model of the same kind whose steady states of the
// seals are equal to the bit: solved ones are reused.
SbStatus sb_run_renew_same(SbRun *run, const SbModel *model, SbReport *report);

// Frees a run that no thread executes. Takes NULL.
void sb_run_destroy(SbRun *run);

// Computes the whole cycle. `hooks` may be NULL. SB_ERROR_CANCELLED; SB_ERROR_NOT_CONVERGED or
// another status of a solver, with what was computed before. The summary is valid after any of
// them, with a reason for each figure that has no value. Executing again repeats the computation.
SbStatus sb_run_execute(SbRun *run, const SbRunHooks *hooks, SbReport *report);

// Stores the states of the rings of the next sb_run_execute(), so that other runs can start from
// them.
void sb_run_keep_rings(SbRun *run);

// Ends the storing, after sb_run_execute(). The run must be executed again before it can be used
// for anything else than a base.
void sb_run_end_rings(SbRun *run);

// Computes what the first run that starts from the stored rings would wait for, until `stop` (not
// NULL; called with `data`) returns true. Any thread, also while others start from them.
void sb_run_prepare_rings(const SbRun *run, bool (*stop)(void *data), void *data);

// Lets the rings of this run start from those stored by `base`, borrowed until the next call; NULL:
// cold start (the default). The results then depend only on that base and the run's own model.
// After sb_run_renew(), before sb_run_execute().
void sb_run_start_from(SbRun *run, const SbRun *base);

// Does the same, but rings are not solved: they are linearised about the base with respect to all
// differences of the models (ring_tangent.c), with the friction that follows. Film, motion and
// frames are then computed as usual. The prediction takes milliseconds for each state; it is exact
// at the base and has errors of second order near it. It does not see changes of the contact's
// active set. Rings that roll or jam at the base cannot be predicted:
// SB_ERROR_NOT_CONVERGED from sb_run_execute(). After sb_run_renew(), before sb_run_execute().
void sb_run_predict_from(SbRun *run, const SbRun *base);

// How the rings of a prediction are evaluated.
typedef enum {
  SB_RINGS_FOLLOW, // linearised
  SB_RINGS_STAY,   // constant, as in the first state predicted from the base; only films follow
  // Solved from the linearised state on its meshes, and films next to the base's films: reference
  // for predictions. SbSummary.ring_fault is then 0 if all rings have the base's active set, else
  // infinite.
  SB_RINGS_SOLVED
} SbRingsBeside;

// Sets how the rings of predictions are evaluated; SB_RINGS_FOLLOW by default.
void sb_run_rings_beside(SbRun *run, SbRingsBeside how);

// Returns the published frames, oldest first, and writes their number to *count; borrowed until the
// run is renewed or destroyed. Any thread.
const SbFrame *sb_run_frames(const SbRun *run, size_t *count);

// Returns the reactions of the joints at a published frame: as many as the summary has joints, in
// the order of thesis table 4.3. NULL if not computed. Borrowed; any thread.
const SbReaction *sb_run_reactions(const SbRun *run, size_t frame);

// Writes a converged run to bytes *out of *size, owned by the caller: free(). They are valid for
// this build only. SB_ERROR_INPUT: not converged, or with reactions of joints (not stored);
// SB_ERROR_MEMORY; *out is NULL then.
SbStatus sb_run_pack(void **out, size_t *size, const SbRun *run, SbReport *report);

// Creates a run from such bytes, for the model and plan of the packed run. It can be read, but
// others cannot start from it. SB_ERROR_INPUT: bytes of another build, or damaged; SB_ERROR_MEMORY.
SbStatus sb_run_unpack(SbRun **out, const SbModel *model, const SbPlan *plan, const void *bytes,
                       size_t size, SbReport *report);

// Returns the largest possible number of frames, for progress. Any thread.
size_t sb_run_capacity(const SbRun *run);

// Returns profile `index`, NULL if there is none; borrowed. Any thread, for an index of a published
// frame.
const SbContactProfile *sb_run_profile(const SbRun *run, uint32_t index);

// Indices of shapes are smaller than this.
enum { SB_RUN_SHAPES_MAX = 96 };

// Returns the solved ring shape `index`, NULL if there is none; borrowed. Any thread, for an index
// of a published frame.
const SbSealShape *sb_run_shape(const SbRun *run, uint32_t index);

// Returns the actuations of a life, oldest first, and writes their number to *count (0 without a
// life). Only after sb_run_execute(); borrowed.
const SbLifeActuation *sb_run_life(const SbRun *run, size_t *count);

// Computes, after sb_run_execute(), the steady state of a seal at `speed` [m/s] > 0 in direction
// `way`, SB_CYCLE_IN or SB_CYCLE_OUT (cycle.h), under the pressures in the middle of B-C or F-A:
// the states from which the motion's friction is interpolated (speed_states.h). More are solved if
// needed; their errors, counts and warnings are added to the summary. SB_ERROR_CANCELLED,
// SB_ERROR_MEMORY; SB_ERROR_NOT_CONVERGED if output.work_limit is exhausted.
SbStatus sb_run_sliding(SbSealState *out, SbRun *run, int seal, int way, double speed,
                        SbReport *report);

// Returns the summary; borrowed. Only after sb_run_execute().
const SbSummary *sb_run_summary(const SbRun *run);

// Returns the run's copy of its model; borrowed. Any thread.
const SbModel *sb_run_model(const SbRun *run);

// Returns the run's copy of its plan; borrowed. Any thread.
const SbPlan *sb_run_plan(const SbRun *run);
