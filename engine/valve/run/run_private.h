// Shared by the files of a run: its state, and the steps of sb_run_execute().
//
// sb_run_execute() clears the summary and begins the budget (sb_run_begin_work()), then solves the
// steady states of both seals (sb_run_solve_states()), moves the stem through the cycle with
// friction interpolated from these states (sb_run_move(), which fills frames and stages), solves
// transient films, sets the figures of the seals, computes the shelf and the actuations of a life,
// and at the end reasons, errors and the verdict. Error estimates come from repeating the motion
// with states perturbed by their errors.
//
// "Way" and `direction` are SB_CYCLE_IN or SB_CYCLE_OUT; "motion" is a way, or SB_RUN_REST;
// `chamber` is an SbChamber; `seal` SB_OUTER or SB_INNER. `hooks` are never NULL here. Functions
// that can fail return SB_ERROR_CANCELLED if the hooks cancel, SB_ERROR_NOT_CONVERGED if the budget
// is exhausted, and the status of the failing solver.
#pragma once

#include "engine/mechanism/chamber.h"
#include "engine/mechanism/dynamics.h"
#include "engine/valve/model/model.h"
#include "engine/valve/run/cycle.h"
#include "engine/valve/run/run.h"
#include "engine/valve/run/run_work.h"
#include "engine/valve/run/valve_type.h"
#include "engine/valve/states/contact_law.h"
#include "engine/valve/states/speed_states.h"

// Index of the motion "at rest"; capacities.
enum {
  SB_RUN_REST = 2,
  SB_RUN_PROFILE_SLOTS = SB_SEAL_COUNT * SB_CYCLE_CHAMBERS * SB_RUN_MOTIONS,
  // Frames at events, and frames of a motion that continues after its drive.
  SB_RUN_EVENT_FRAMES = 2 * SB_CYCLE_SEGMENTS_MAX + 800
};

// A stored profile.
typedef struct {
  SbContactProfile view; // what sb_run_profile() returns; points into `data`
  double *data;          // owned: SB_PROFILE_ROWS rows of view.count numbers; NULL: none
} SbRunProfile;

// Indices of a seal's shapes: from 0 those of its steady states (chamber x SB_RUN_MOTIONS +
// motion); from SB_RUN_SHAPE_EDGE those over the land's edge, SB_RUN_EDGES for each way; the free
// shape.
enum {
  SB_RUN_SHAPE_EDGE = SB_CYCLE_CHAMBERS * SB_RUN_MOTIONS,
  SB_RUN_SHAPE_FREE = SB_RUN_SHAPE_EDGE + 2 * SB_RUN_EDGES,
  SB_RUN_SEAL_SHAPES = SB_RUN_SHAPE_FREE + 1,
  SB_RUN_SHAPES = SB_SEAL_COUNT * SB_RUN_SEAL_SHAPES
};

_Static_assert((int)SB_RUN_SHAPES <= (int)SB_RUN_SHAPES_MAX,
               "shapes are indexed below SB_RUN_SHAPES_MAX");

// A stored shape.
typedef struct {
  SbSealShape view; // what sb_run_shape() returns; nodes = 0: none
  void *data;       // owned: all arrays of `view`
} SbRunShape;

// Range of positions of the land's edge, in the inner ring's frame [m], in which it deforms the
// ring; equal: none.
typedef struct {
  double begin, end;
} SbRunEdge;

// Capacity of layers.
enum { SB_BORE_LAYERS = 512 };

// A layer on the bore, from the end of the layer before it to `end`.
typedef struct {
  double end;   // position [m]
  double layer; // thickness [m]
} SbBoreLayer;

// Layers that a seal has left on the bore, or on the stem of a gasket valve, and the transported
// volumes per length of circumference. All positions are the stem displacement multiplied by
// sb_model_way(), so that they increase while liquid is transported out.
typedef struct {
  double start;                     // position at which the first layer begins [m]
  double out, back;                 // volume transported out and back so far, >= 0 [m2]
  size_t count;                     // number of layers
  SbBoreLayer item[SB_BORE_LAYERS]; // with increasing `end`
} SbBore;

// The constrained parts of a run whose plan has `bodies` (run_bodies.c).
typedef struct SbRunBodies SbRunBodies;

// Frees them.
void sb_run_bodies_destroy(SbRunBodies *bodies);

// Copies the reactions of the first `count` frames of `from` to the frames of `run` from index
// `at`. Does nothing if one of them has no bodies.
void sb_run_bodies_show(SbRun *run, size_t at, const SbRun *from, size_t count);

// A part of the friction in a band of speed: rise + slope |speed|.
typedef struct {
  double rise, slope; // [N], [N s/m]
} SbBandPart;

// A band of speed in which friction is linear in speed.
typedef struct {
  double low, high; // range of |speed| [m/s]
  // Friction minus that of the dry contact, by seal and chamber (0: SB_CHAMBER_AT_REST, 1:
  // SB_CHAMBER_CLOSED; without ports only 0): parts proportional to the contact's width and to its
  // load.
  SbBandPart width[SB_SEAL_COUNT][2], load[SB_SEAL_COUNT][2];
} SbValveBand;

// Capacity of bands.
enum { SB_VALVE_BANDS = 48 };

// Bands of one chamber state and way, in increasing order of speed.
typedef struct {
  size_t count; // 0: not yet computed
  SbValveBand item[SB_VALVE_BANDS];
} SbValveBands;

// Solved states of the seals, and their part of the summary, for a model with the same states
// (sb_run_renew_same()).
typedef struct {
  bool stand;  // this execution uses the stored states and solves none
  bool solved; // the fields below are stored, and no solver has failed
  // Copies of SbRun.cycle, friction_error, static_error, of the summary's error_film, error_load,
  // error_width, of SbRun.lacks, and of the counters and warnings of the solves.
  SbCycle cycle;
  double friction_error[SB_SEAL_COUNT], static_error[SB_SEAL_COUNT];
  double error_film, error_load, error_width;
  SbReport lacks;
  SbCounters counters;
  SbWarnings warnings;
} SbRunSolved;

// The run (SbRun of run.h).
struct SbRun {
  // Fields before `model` are reused for the next model; `model` and all later ones are cleared
  // when the run is renewed.
  SbSlidingMemory *memory[SB_SEAL_COUNT]; // owned
  bool predicted;                         // rings are linearised (sb_run_predict_from())
  // `work` is the budget of this execution: &own_work, or that of the run for which this run finds
  // a speed. Each later actuation of a life has a budget of its own.
  SbWork *work, own_work;
  SbFrame *frames; // [room], owned; the first `count` are complete
  size_t room;     // allocated number of frames
  // Reused if the next model's seals have the same states. States by speed, owned; NULL: not used
  // yet.
  SbSpeedStates *speeds[SB_SEAL_COUNT][SB_CYCLE_CHAMBERS][SB_RUN_REST];
  SbRunSolved solved;
  const SbModel *model; // owned
  SbPlan plan;          // copy of the caller's
  size_t capacity;      // largest possible number of frames
  SbCycle cycle;        // its states are used by every motion model
  double speed;         // sliding speed at which the cycle's states are solved, > 0 [m/s]
  double mid_speed;     // stem speed in the middle of B-C, for the seals' figures, > 0 [m/s]
  double back_speed;    // stem speed in the middle of F-A, a magnitude [m/s]
  // Static friction of ageing contacts against the dwell, divided by their kinetic friction.
  SbDwellLaw rest[SB_SEAL_COUNT][SB_CYCLE_CHAMBERS];
  double roughness;   // roughness of the states divided by the model's [1]
  bool out_of_memory; // one of `speeds` could not be allocated
  // Error of the linear bands of friction, divided by the friction without a film [1].
  double straight_error;
  SbValveBands bands[SB_CYCLE_CHAMBERS][SB_RUN_REST]; // computed when first needed
  SbSummary summary;
  SbFilm history_film; // work memory: film of the present frame of the film history
  // Errors (run_errors.c): of the motion's figures, absolute in SI; of the sliding speeds by way,
  // relative; of a cycle's leakage [m3]; of the mass that remains in the chamber [kg].
  double motion_error[SB_FIGURE_COUNT], speed_error[2], leak_error, kept_error;
  double compared_error[SB_SEAL_COUNT]; // relative error of the film solved for comparison
  SbSealState shown[SB_SEAL_COUNT][2];  // states for the seals' figures, by way
  SbBore bore;   // of the last motion, outer seal; volumes at its end: mean of the actuations
  double period; // time of one actuation of a motion with several [s]; 0: the motion is one
  SbFilm film;   // work memory for films that belong to no state
  // Largest error of a state's kinetic, static friction [N].
  double friction_error[SB_SEAL_COUNT], static_error[SB_SEAL_COUNT];
  SbRunProfile profile[SB_RUN_PROFILE_SLOTS]; // by sb_run_profile_slot()
  SbRunShape shape[SB_RUN_SHAPES];            // seal x SB_RUN_SEAL_SHAPES + index
  SbRunEdge edge[2];                          // range over the inner ring, by way
  SbReport lacks;                             // why no motion can be computed; SB_OK: it can
  double before_frames;                       // fraction of the work before the first frame
  double after_frames;   // fraction after the last frame: the later actuations of a life
  SbRunBodies *bodies;   // owned; NULL: not computed
  bool follows;          // this run is a later actuation of a life: it has the errors of the first
  SbLifeActuation *life; // [model.life_actuations], owned; NULL without a life
  size_t count;          // complete frames
  bool hold;             // frames are not published before their film history is known
  atomic_size_t published; // number of frames that readers may use
};

// Sets run->own_work to a new budget of output.work_limit steps, without those that the hooks name
// as used. The hooks can cancel it (run.c).
void sb_run_begin_work(SbRun *run, const SbRunHooks *hooks);

// Solves all states of the plan at run->speed, on a thread for each seal if rings are solved.
// Errors of sb_run_solve_states().
SbStatus sb_run_solve_all(SbRun *run, const SbRunHooks *hooks, SbReport *report);

// Solves all steady states that the plan needs, and its profiles and shapes: at the machine's
// speed, or with another drive at the stem's speed in the middle of B-C, which it finds first. Sets
// cycle.state, speed, mid_speed, errors and lacks (run_own_speed.c).
SbStatus sb_run_solve_states(SbRun *run, const SbRunHooks *hooks, SbReport *report);

// Stores the solved states in run->solved, if `status`, that of sb_run_solve_states(), is SB_OK and
// the plan allows their reuse (run_own_speed.c).
void sb_run_store_states(SbRun *run, SbStatus status);

// Copies the states of run->solved to the run (run_own_speed.c).
void sb_run_restore_states(SbRun *run);

// Adds *more to *sum.
void sb_run_add_counters(SbCounters *sum, const SbCounters *more);

// Stores the section of the solved `ring` of a seal, for drawing, as the seal's shape `index`
// (run_shapes.c).
SbStatus sb_run_store_shape(SbRun *run, int seal, int index, const SbRing *ring, SbReport *report);

// Solves and stores the shapes of the inner ring over the land's edge for a way, and its free
// shape. `from` is the inner ring solved for this way; solves are added to *counts. `options` is
// for the free shape; true of its poll (not NULL) ends the function with SB_ERROR_CANCELLED.
// Positions that do not converge have no shape.
SbStatus sb_run_solve_edge(SbRun *run, int way, const SbRing *from, SbCounters *counts,
                           const SbRingOptions *options, SbReport *report);

// Returns the index for sb_run_shape() of a seal's shape in a chamber state and motion, with its
// full contact on the land; UINT32_MAX: none.
uint32_t sb_run_shape_index(const SbRun *run, int seal, SbChamber chamber, int motion);

// Returns the index for sb_run_shape() of the inner seal's shape at or beyond the land's edge, by
// way and stem displacement s [m]; UINT32_MAX: none.
uint32_t sb_run_shape_over_edge(const SbRun *run, int way, double s);

// Number of rows of a stored profile.
enum { SB_PROFILE_ROWS = 5 };

// Returns the view of SB_PROFILE_ROWS consecutive rows of `count` numbers: x, pressure, film,
// asperity pressure, film pressure (NaN: no film was solved). `rows` and `model` are borrowed.
SbContactProfile sb_run_profile_view(const double *rows, size_t count, const char *model);

// Sets the profile of a state whose seal's memory has just solved it: pressure and film over its
// contact, under `pressure`.
SbStatus sb_run_make_profile(SbRun *run, int seal, int chamber, int motion, SbSealPressure pressure,
                             const SbSealState *state, SbReport *report);

// Returns the index in run->profile of the profile of a seal in a chamber state and motion.
uint32_t sb_run_profile_slot(int seal, int chamber, int motion);

// Returns the first chamber state in which the seal has contact and the same pressures as in
// `chamber`; they share one solution (run_states.c).
int sb_run_first_equal_chamber(const SbRun *run, int seal, int chamber);

// Largest allowed closure of the energy balance; a larger one means that the motion is not solved.
#define SB_RUN_CLOSURE 1e-6

// Computes the motion of the model (quasi-static, or with inertia by the plan). If run->lacks is an
// error it only sets the reasons of missing figures and returns SB_OK. After an early end the
// complete frames and the stages reached remain, and the report names the place (run.c).
SbStatus sb_run_move(SbRun *run, const SbRunHooks *hooks, SbReport *report);

// End of a motion, for its outcome; forces in N, displacements in m.
typedef struct {
  double start, top; // stem displacement: first, largest
  double position;   // of the stem at the end
  double speed;      // of the stem at the end [m/s]
  double force;      // of the drive at the end
  bool bonded;       // the drive is bonded to the stem
  double dwell;      // time between the end of the in-stroke and the first reverse slip [s]
  double press;      // largest force of the drive before the stop
  // Minimum of pressure force minus friction on the return at its own speeds; INFINITY: only the
  // steady states' friction counts.
  double sliding_least;
} SbRunEnd;

// Sets outcome, figures of the return, press force, and reasons of missing ones in `summary`: the
// run's own, or that of a perturbed motion. Before the call stages and peak force of `summary`, and
// the states of run->cycle, must be set. SB_ERROR_MEMORY is its only error (run_outcome.c).
SbStatus sb_run_conclude_motion(SbSummary *summary, SbRun *run, const SbRunEnd *end,
                                SbReport *report);

// Returns whether the chamber has been filled and emptied (run_outcome.c).
bool sb_run_delivers(const SbRun *run);

// Computes frames, stages, energies and leakage of the quasi-static cycle (run_cycle.c).
SbStatus sb_run_quasi_static(SbRun *run, const SbRunHooks *hooks, SbReport *report);

// Computes frames, stages, energies and leakage of the motion with inertia (run_dynamic.c).
SbStatus sb_run_dynamic(SbRun *run, const SbRunHooks *hooks, SbReport *report);

// Sets the step counts of a motion with inertia in the summary, and the energies of one of its
// `cycles`: the mean of all (run_dynamic.c).
void sb_run_fill_motion(SbSummary *summary, const SbDynamicsEnergy *energy,
                        const SbDynamicsCounters *counters, int cycles);

// Returns whether the speed of the run's states is that which the motion finds; if not, it is
// drive.speed (run_own_speed.c).
bool sb_run_finds_speed(const SbRun *run);

// Computes *speed, that of the stem in the middle of B-C, a magnitude [m/s], by a motion with
// inertia; else the mean speed from B to D, else from E to F, else from E to rest; of a sinusoid
// that passes none of these its mean speed; else 0. *slips: the stem slides (run_dynamic.c).
SbStatus sb_run_dynamic_speed(double *speed, bool *slips, SbRun *run, const SbRunHooks *hooks,
                              SbReport *report);

// Computes the actuations after the first, which must have been computed (run_life.c).
SbStatus sb_run_rest_of_life(SbRun *run, const SbRunHooks *hooks, SbReport *report);

// Computes the sliding-plate rig instead of the valve (run_rig.c).
SbStatus sb_run_rig(SbRun *run, const SbRunHooks *hooks, SbReport *report);

// Computes the transient films of the first `count` frames, which must not be published yet. From
// the instant at which a seal's film fails, its frames have none (NaN), with a warning
// (run_film.c).
SbStatus sb_run_film_history(SbRun *run, size_t count, const SbRunHooks *hooks, SbReport *report);

// Returns the fluid on the bore in front of a seal's inlet in one of its states. The states before
// it, in the order of profile indices, must be solved (run_supply.c).
SbSupply sb_run_supply(const SbRun *run, int seal, SbChamber chamber, int motion);

// Returns the thickness of the layer that a seal sliding at |speed| [m/s] leaves on the sliding
// surface, or can take back, in `direction` [m]; 0 without liquid. May solve states, as
// sb_run_state_at().
double sb_run_layer(SbRun *run, int seal, SbChamber chamber, int direction, double speed);

// Initialises *bore without layers at the position s [m] (see SbBore).
void sb_bore_start(SbBore *bore, double s);

// Moves the seal from the position `from` to `to` [m] (see SbBore) with a film that carries the
// thickness `layer` [m]. If to > from it leaves layers; else it takes layers back, each at most to
// the thickness `layer`.
void sb_bore_move(SbBore *bore, double from, double to, double layer);

// Sets leakage_per_cycle from the volumes of `bore`; sb_run_leave_out() removes it later if there
// is no full cycle (run_figures.c).
void sb_run_leakage(SbSummary *summary, const SbModel *model, const SbBore *bore);

// Sets leakages and dose to NaN, with reasons, that belong to parts of the cycle that did not
// happen, or to a seal that is open: by the outcome and by the outer seal's state (run_outcome.c).
void sb_run_leave_out(SbRun *run);

// Where a computation ended, for a report.
typedef struct {
  const char *solver; // and its seals: "motion (dynamic), both seals"
  const char *mover;  // "stem" or "plate"
  SbStage stage;
  double position, time; // of the mover [m], [s]
  const char *available; // results: "the films before"
} SbRunPlace;

// Returns `status` with a report on it that adds the place to `cause` (run_frames.c).
SbStatus sb_run_fail_at(SbReport *report, SbStatus status, const SbRunPlace *place,
                        const SbReport *cause);

// Sets the reasons of all other missing figures, by the chosen models, and the `status` and
// `report` of the run. All figures must be set before (run_figures.c).
void sb_run_set_reasons(SbRun *run, SbStatus status, const SbReport *report);

// Sets the figures of each seal in the middle of B-C (run_figures.c).
void sb_run_summarise_seals(SbRun *run);

// Computes the can on the shelf, as far as the plan needs it (run_shelf.c).
SbStatus sb_run_shelf(SbRun *run, const SbRunHooks *hooks, SbReport *report);

// Returns the fraction of the chamber that fills in the time from C to F, 0 to 1; NaN if C or F is
// not reached, if the model has no filling_time, and in a gasket valve.
double sb_run_filled_share(const SbSummary *summary, const SbModel *model);

// Sets the fractions of users who are weaker than the summary's forces (run.c).
void sb_run_set_user_fractions(SbSummary *summary, const SbModel *model);

// Returns the mass that the last motion delivers [kg], >= 0: the `metered` mass [kg] multiplied by
// sb_run_filled_share() (by 1 if that is NaN), minus the mass that remains in the vented chamber; 0
// if the canister's pressure is not above ambient; NaN if sb_run_delivers() is false.
double sb_run_dose(const SbRun *run, double metered);

// Sets run->count, and publishes the first `count` frames to readers unless run->hold is true.
void sb_run_publish(SbRun *run, size_t count);

// Stores the stage in the summary, from the frame `index`, unless it was reached before.
void sb_run_mark_stage(SbRun *run, SbStage stage, const SbFrame *frame, size_t index);

// Returns the error of the cycle's forces by both frictions over the peak force [1]; 0 without one,
// and of a stem that never moves. After the outcome is known.
double sb_run_error_friction(const SbRun *run);

// Calls hooks->progress. `fraction` is 0 to 1 of the work before the first frame if frames = 0,
// else of the frames; `frames` is the number of published frames.
void sb_run_progress(const SbRun *run, const SbRunHooks *hooks, double fraction, size_t frames);

// Returns whether the hooks cancel the run, and fills the report then.
bool sb_run_cancelled(const SbRunHooks *hooks, SbReport *report);

// ---- Motion: frames (run_frames.c), states by speed (run_speeds.c), parts (run_bodies.c)

// Indices of stops.
enum { SB_REST_STOP = 0, SB_END_STOP = 1 };

// Which steady states apply at an instant, as indices of SbCycle.state.
typedef struct {
  SbChamber chamber;
  int direction; // a way
  int land;      // way whose state determines the fraction of the inner seal on the land
} SbSolvedState;

// Computes the steady state of a sliding seal at |speed| [m/s] in `direction`; the sign of `speed`
// is ignored. Interpolates between states by speed and solves missing ones; their counts and
// warnings are added to the summary. Failures are reported by sb_run_close_speeds() (run_speeds.c).
void sb_run_state_at(SbSealState *out, SbRun *run, int seal, int chamber, int direction,
                     double speed);

// Computes the state as sb_run_state_at() for a chamber of ports, by linear interpolation between
// its states in SB_CHAMBER_AT_REST (`filled` = 0) and SB_CHAMBER_CLOSED (1): `filled` is
// sb_valve_filling().
void sb_run_state_between(SbSealState *out, SbRun *run, int seal, double filled, int direction,
                          double speed);

// Sets *out to the problem of the film of the state in run->cycle at run->speed, and returns the
// body of that film, borrowed from the run; NULL: half-plane.
const SbSlidingBody *sb_run_film_of(SbFilmProblem *out, SbRun *run, int seal, int chamber,
                                    int direction);

// Replaces the film of `state` at |speed| [m/s] by `film` with sb_sliding_set_film().
void sb_run_set_film(SbSealState *state, SbRun *run, int seal, int chamber, int direction,
                     double speed, const SbFilm *film, bool fitted);

// Creates the states by speed of the state just solved in run->cycle, with a copy of `body`, that
// of its film (NULL: half-plane). SB_ERROR_MEMORY is its only error.
SbStatus sb_run_create_speeds(SbRun *run, int seal, int chamber, int direction,
                              const SbSlidingBody *body, SbReport *report);

// Copies the states by speed that `one` lacks from `run`, and sets roughness and reference state of
// all of them to those of `one`. Solved films remain valid, because without coupled asperities they
// do not depend on roughness. SB_ERROR_MEMORY is its only error.
SbStatus sb_run_copy_speeds(SbRun *one, const SbRun *run, SbReport *report);

// Returns the chamber state (an SbChamber) whose pressures apply in the middle of a stroke in this
// way.
int sb_run_mid_stroke_chamber(int way);

// Prefetch: solves the states at speeds near run->speed for a state just solved, in the thread of
// its seal, because the film solver still has that film. Counts and warnings are added to *counters
// and *warnings.
void sb_run_prefetch_speeds(SbRun *run, int seal, int chamber, int way, SbCounters *counters,
                            SbWarnings *warnings);

// Adds the errors of the interpolation by speed, and its counts, to the run. SB_ERROR_CANCELLED,
// SB_ERROR_MEMORY, SB_ERROR_NOT_CONVERGED (budget): a solve of a state by speed was ended early.
SbStatus sb_run_close_speeds(SbRun *run, SbReport *report);

// Frees all states by speed.
void sb_run_free_speeds(SbRun *run);

// One instant of a motion.
typedef struct {
  SbDynamicsSample sample; // acceleration, deflections and region may be unset
  SbStage stage;           // last stage passed
  SbChamber chamber;       // state of the chamber
  SbSolvedState solved;    // steady states that apply
  bool moving;             // the stem slides
  double pressure;         // pressure in the chamber [Pa]
} SbInstant;

// Sets the frame of an instant. Forces of the drive are those of the sample; contact, load, film
// and friction of a sliding seal are those of one steady state at the sample's speed and the
// chamber's pressure.
void sb_run_fill_frame(SbFrame *out, SbRun *run, const SbInstant *at);

// Replaces the film of a seal in a frame by `film`, and updates lambda, real area and friction
// there. `fitted`: it was solved on the fitted body.
void sb_run_frame_film(SbFrame *frame, SbRun *run, int seal, const SbFilm *film, bool fitted);

// To be called after each frame: every 64 frames it publishes the first `count` frames, and reports
// progress (`fraction` 0 to 1 of the frames) less often. Returns true if the run is cancelled, with
// the report set.
bool sb_run_poll(SbRun *run, const SbRunHooks *hooks, size_t count, double fraction,
                 SbReport *report);

// Creates run->bodies: assembles the constrained parts, counts their degrees of freedom, allocates
// the reactions of all frames, and initialises summary.bodies. run->bodies must be NULL
// (run_bodies.c).
SbStatus sb_run_bodies_create(SbRun *run, SbReport *report);

// Returns the effective mass of the stroke at the assembly [kg].
double sb_run_bodies_mass(const SbRunBodies *bodies);

// Moves the parts to the stem displacement x [m] at the stem speed v [m/s], and computes the
// effective mass there [kg]. SB_ERROR_INFEASIBLE: the parts do not move together.
SbStatus sb_run_bodies_move(double *mass, SbRun *run, double x, double v, SbReport *report);

// Moves the parts to `sample`, the instant of the frame `index`, computes the reactions of the
// joints there for sb_run_reactions(), and updates the extremes in summary.bodies. Errors of
// sb_run_bodies_move() and sb_assembly_forces().
SbStatus sb_run_bodies_frame(SbRun *run, size_t index, const SbDynamicsSample *sample,
                             SbReport *report);
