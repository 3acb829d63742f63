// A run: one scene's cycle, computed step by step on whatever thread calls sb_run_execute().
//
// One thread executes; any thread may at the same time read what has been published:
// sb_run_frames() returns a stable array and the number of frames complete so far
// (acquire/release), so a reader never waits and a frame never changes once seen.
#pragma once

#include "engine/valve/run/frame.h"
#include "engine/valve/run/plan.h"
#include "engine/valve/run/rig.h"
#include "engine/valve/shelf/shelf.h"

#include <stdatomic.h>

typedef struct SbRun SbRun;

// Callbacks of a run at work. Both may be NULL. `progress` is called at most every few milliseconds
// with the fraction done, 0 to 1; a true answer of `cancelled` ends the run within 50 ms with
// SB_ERROR_CANCELLED, its frames so far kept.
typedef struct {
  void (*progress)(void *data, double fraction, size_t frames);
  bool (*cancelled)(void *data);
  void *data;
  bool alone; // no thread beside the caller's, which is the one that calls back in either case
} SbRunHooks;

typedef struct {
  bool reached;
  // Just before the event; NaN: not reached.
  double time;         // [s]
  double displacement; // of the stem [m]
  double force;        // of the drive [N]
  size_t frame;        // index of the frame that sits on it
} SbStageMark;

enum { SB_SEAL_EDGE_POINTS = 33 };

// One seal in a steady state, sliding or at rest, by one member for each SB_SEAL_FIGURE (meaning
// and unit there; NaN: not computed) and what they come from. A run's summary has that in the
// middle of B-C, friction_static at B.
typedef struct {
#define SB_SEAL_FIGURE(path, member, ...) double member;
#include "engine/valve/figures/figures.def"
  SbLeakState leak_state;
  bool touches;
  bool opened;      // by the fluid: the rubber does not press, or the film's ends differ too much
  bool film_fitted; // film_min and film_central are solved on the fitted body
  double layer;     // that it leaves on the bore behind it: flow over speed [m]
  double load_net;  // per length, above the ambient step: what the film carries [N/m]
  // Relative errors of the fit [1], 0 of a closed form: of the load, of load_net, of the contact's
  // width and of its peak pressure.
  double load_error, net_error, width_error, peak_error;
  double film_error;           // of the least film, relative [1]; NaN: a closed form of exact loads
  double central_error;        // of film_central alone, which friction depends on, relative [1]
  double area_error;           // of the real area while sliding, relative [1]
  double rest_error;           // of the real area at rest, relative [1]
  double share_error;          // of the asperities' share of the load, relative [1]
  double boundary_area;        // tau_0 A_a, the part of F_b in proportion to the width [N]
  double boundary_load;        // m W, the part in proportion to the load [N]
  double rest_area, rest_load; // what these two become at rest, once the film has gone [N]
  double boundary_error;       // of boundary_area + boundary_load [N]
  double viscous_error;        // of friction_viscous [N]
  double friction_error;       // of kinetic friction, by its film and its fit [N]
  double static_error;         // of static friction, by its fit and its dry contact [N]
  // Of a ring that friction drags, NaN without: what the pressure leaves of tau_0 A_a, what the
  // section bears of the whole friction, its turn [degrees], > 0 as friction turns it.
  double area_cut, borne_share, rotation;
  SbRingState section;
  // Of a gasket's contact, at equal steps of the angle t from its left end, place = middle - half
  // cos t: pressure above the lower fluid's [Pa]; 0 of rings.
  double edge_pressure[SB_SEAL_EDGE_POINTS];
} SbSealState;

// A seal in a steady stroke, by one member for each SB_CONTACT_FIGURE.
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

// What the sliding-plate rig reports (valve/run/rig.h).
typedef struct {
  bool found; // whether the force has a first peak; else the coefficients mean nothing
  SbRigCoefficients of;
  double contact_coefficient; // of friction by the valve's surface model under the rig's load [1]
  double contact_load;        // load under which that model gives the sliding coefficient [N]
} SbRigSummary;

// What a joint bears over the run, on the first part it names; compare bodies.h.
typedef struct {
  char name[2 * SB_BODY_NAME + 8]; // "stem centre, stem top"
  char kind[16];
  double axial_min, axial_max; // force along the stroke [N]
  double transverse_max;       // [N]
  double torque_max;           // [N m]
} SbJointSummary;

// The constrained parts of a run with models.motion = bodies.
typedef struct {
  int gruebler, constraints, freedom;
  char text[SB_TEXT];
  double moving_mass;        // that the stroke sees, by the joints' conditions [kg]
  double acceleration_error; // largest difference of a part's acceleration from the stroke's,
                             // relative to all forces over the mass [1]
  double joint_error;        // most that a step of the motion left a joint violated [m]
  size_t joints;             // 0: not asked for
  SbJointSummary joint[SB_VALVE_JOINTS];
} SbBodiesSummary;

// Who presses the valve, each with a distribution of strength.
typedef enum { SB_WOMEN, SB_MEN, SB_USERS } SbUsers;

// What one actuation yields.
typedef struct {
  double roughness;       // over the given one [1]
  double lambda;          // film over roughness [1]
  double leakage;         // net [m3]
  double carried;         // out under the film on the way in [m3]
  double force_peak;      // [N]
  double force_breakaway; // at the first slip [N]; NaN if there was none
  double force_return;    // least [N]
  double returned;        // [1] 1: the stem comes back to rest, 0: it does not
  double dose;            // delivered [kg]
} SbLifeActuation;

typedef struct {
  long done;                   // actuations computed
  double leakage;              // sum [m3]; NaN like `carried` for a life that ended before its time
  double carried;              // sum [m3]
  SbLifeActuation first, last; // figures of the last NaN for such a life
  double return_least;         // over the life [N]; NaN if no actuation has one
  long failure;                // number from 1 of the actuation without return, 0 if none
} SbLife;

// One figure for each row of figures.def, the seals' twice.
enum {
  SB_FIGURE_COUNT =
#define SB_FIGURE(...)         +1
#define SB_FIGURE_AT(...)      +1
#define SB_SEAL_FIGURE(...)    +SB_SEAL_COUNT
#define SB_CONTACT_FIGURE(...) +2 * SB_SEAL_COUNT
#include "engine/valve/figures/figures.def"
};

// Why figures were not computed (engine/valve/figures/figures.h): 0 for no reason, else text[of -
// 1].
enum { SB_REASONS_MAX = 48 };
typedef struct {
  size_t count;
  char text[SB_REASONS_MAX][SB_TEXT];
  unsigned char of[SB_FIGURE_COUNT];
} SbReasons;

// How the motion of the stem ends.
typedef enum {
  SB_OUTCOME_UNKNOWN,     // no motion was computed, it failed, or the stem still moves at its end
  SB_OUTCOME_NEVER_MOVED, // the drive does not overcome the static friction
  SB_OUTCOME_STUCK,       // at rest away from its rest stop, without a push of the drive
  SB_OUTCOME_RETURNED,    // at rest on its rest stop, released by the drive
  SB_OUTCOME_HELD         // the drive still pushes the stem, or is bonded to it
} SbOutcome;

typedef enum { SB_ANSWER_UNKNOWN, SB_ANSWER_NO, SB_ANSWER_YES } SbAnswer;

// One question of the verdict: the answer, and the figure that decides it.
typedef struct {
  SbAnswer ok;
  int figure;           // index, -1: none
  double value, limit;  // in the figure's SI unit; NaN: none
  char reason[SB_TEXT]; // one sentence; empty where there is nothing to say
} SbVerdict;

// What a run found: one member for each SB_FIGURE (meaning and unit there; NaN: not computed), and
// what is no figure or stands in a struct of its own.
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
  // Shares of users who are weaker than the peak and the break-away force [1].
  double below_peak[SB_USERS], below_breakaway[SB_USERS];
  SbRigSummary rig; // motion RIG
  SbLife life;      // done = 0: no life was asked for
  SbShelf shelf;    // points = 0: nobody asked for its history
  SbWarnings warnings;
  SbReasons reasons;
  SbVerdict verdict[SB_VERDICT_COUNT];
  bool converged;
  size_t frames, steps, rejected_steps;
  size_t work;   // solver steps counted against output.work_limit, in all actuations of a life
  double wall_s; // elapsed time of the computation [s]
  double error[SB_FIGURE_COUNT];    // of each figure, absolute in its SI unit; NaN: not known
  double ring_fault[SB_SEAL_COUNT]; // of a predicted run's rings: forces that violate their active
                                    // sets, over the bore's [1]
  double ring_order;  // most polynomials of a ring's recovered pressure for each node [1]
  double error_width; // of contact widths, relative as error_load [1]; NaN: does not apply
  SbCounters counters;
} SbSummary;

// Allocates a run for `model` by `plan` (both copied). *out is owned by the caller.
SbStatus sb_run_create(SbRun **out, const SbModel *model, const SbPlan *plan, SbReport *report);

// Makes `run`, which no thread executes, one for another model and plan; it keeps its memory and
// nothing else. What was borrowed from it is gone. On SB_ERROR_MEMORY it can only be renewed again
// or destroyed.
SbStatus sb_run_renew(SbRun *run, const SbModel *model, const SbPlan *plan, SbReport *report);

// The same, for a model of the last one's kind whose seals' steady states are those of the last one
// to the bit, at the same plan: where they were solved they stand and are not solved again.
SbStatus sb_run_renew_same(SbRun *run, const SbModel *model, SbReport *report);

// Frees a run that no thread executes any more; NULL is allowed.
void sb_run_destroy(SbRun *run);

// Computes the whole cycle once. SB_OK, SB_ERROR_CANCELLED, or a solver's status with the last good
// state kept; the summary is valid after any of them.
SbStatus sb_run_execute(SbRun *run, const SbRunHooks *hooks, SbReport *report);

// Before sb_run_execute(): keeps the rings' states for other runs to start from; after it they are
// there, and the run must be executed anew for anything else.
void sb_run_keep_rings(SbRun *run);
void sb_run_end_rings(SbRun *run);

// Prepares what the first run from kept rings would wait for, until `stop`. Any thread, also while
// others start from them.
void sb_run_prepare_rings(const SbRun *run, bool (*stop)(void *data), void *data);

// Lets this run's rings start from those that `base` kept, borrowed until it is told otherwise;
// NULL: cold, as at first. Its answers then hang on that base and its own model alone.
void sb_run_start_from(SbRun *run, const SbRun *base);

// The same, but rings are not solved: they are the base's to first order in all that the models
// differ by (ring_tangent.c), with the friction that goes with them; film, motion and frames are
// then computed as ever. A prediction of the whole run, milliseconds each state: exact at the
// base, second order beside it, blind to nodes and slips of the contact that come and go. Rings
// that the base has not (they roll, jam, do not touch) have none: SB_ERROR_NOT_CONVERGED.
void sb_run_predict_from(SbRun *run, const SbRun *base);

// What the rings of such a prediction do: follow to first order; stay as they are at the first
// state that was predicted beside the base, so that only what lies on them follows; or be solved
// where the first order leads them, on its meshes, films next to the base's on theirs: what a
// prediction is measured by. SbSummary.ring_fault is then 0 where all have the base's active set,
// else infinite.
typedef enum { SB_RINGS_FOLLOW, SB_RINGS_STAY, SB_RINGS_SOLVED } SbRingsBeside;
void sb_run_rings_beside(SbRun *run, SbRingsBeside how);

// Frames published so far, oldest first; borrowed, valid until sb_run_destroy(). Any thread.
const SbFrame *sb_run_frames(const SbRun *run, size_t *count);

// Reactions of the joints at a published frame, as many as the summary has joints, in the order of
// thesis table 4.3; NULL if nobody asked. Borrowed; any thread.
const SbReaction *sb_run_reactions(const SbRun *run, size_t frame);

// A run that has ended well as bytes of this build, *out owned by the caller (free()), and back,
// for the model and the plan that it was made by: to be looked at, not to start others from.
// SB_ERROR_INPUT: reactions of joints are not kept; not such bytes.
SbStatus sb_run_pack(void **out, size_t *size, const SbRun *run, SbReport *report);
SbStatus sb_run_unpack(SbRun **out, const SbModel *model, const SbPlan *plan, const void *bytes,
                       size_t size, SbReport *report);

// Number of frames a complete run will have at most (for progress). Any thread.
size_t sb_run_capacity(const SbRun *run);

// Profile `index` of the run; borrowed. Any thread, for an index found in a published frame.
const SbContactProfile *sb_run_profile(const SbRun *run, uint32_t index);

// No shape has an index as large as this.
enum { SB_RUN_SHAPES_MAX = 96 };

// Solved ring shape `index`, NULL if there is none; borrowed. Any thread, for an index found in a
// published frame.
const SbSealShape *sb_run_shape(const SbRun *run, uint32_t index);

// What each actuation of a life yielded, oldest first; *count is 0 without a life. Only after
// sb_run_execute() returned; borrowed.
const SbLifeActuation *sb_run_life(const SbRun *run, size_t *count);

// After sb_run_execute(): the steady state of a seal at a speed [m/s] > 0 by way of sliding,
// SB_CYCLE_IN or SB_CYCLE_OUT (cycle.h), under the pressures at the middle of B-C or of F-A: those
// states that the motion's friction is taken from (speed_states.h), more of which are solved where
// need be. Their errors, counts and warnings go to the summary. SB_ERROR_CANCELLED, _MEMORY.
SbStatus sb_run_sliding(SbSealState *out, SbRun *run, int seal, int way, double speed,
                        SbReport *report);

// Only after sb_run_execute() returned; borrowed.
const SbSummary *sb_run_summary(const SbRun *run);

// What the run was made for; any time, any thread; borrowed.
const SbModel *sb_run_model(const SbRun *run);
const SbPlan *sb_run_plan(const SbRun *run);
