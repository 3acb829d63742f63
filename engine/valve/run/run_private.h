// Shared by the files of a run: its state, and the steps that sb_run_execute() takes in order.
// Private to engine/valve/run. "Way" is SB_CYCLE_IN, SB_CYCLE_OUT; "motion" is a way, or
// SB_RUN_REST. `hooks` are never NULL here.
#pragma once

#include "engine/mechanism/chamber.h"
#include "engine/mechanism/dynamics.h"
#include "engine/valve/model/model.h"
#include "engine/valve/run/cycle.h"
#include "engine/valve/run/run.h"
#include "engine/valve/run/run_work.h"
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
  SbContactProfile view;
  double *data; // owned: SB_PROFILE_ROWS rows
} SbRunProfile;

// Indices of a seal's shapes: of its steady states, over the land's edge (both ways), free.
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
  SbSealShape view;
  void *data; // owned: all its arrays
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
  double end;   // stem displacement [m]
  double layer; // thickness [m]
} SbBoreLayer;

// Layers that a seal has left on the bore by stem displacement, and the volumes that it has
// carried, per length of circumference.
typedef struct {
  double start;     // of the first layer [m]
  double out, back; // carried out, and taken back [m2]
  size_t count;
  SbBoreLayer item[SB_BORE_LAYERS];
} SbBore;

// The constrained parts of a run whose plan has `bodies` (run_bodies.c).
typedef struct SbRunBodies SbRunBodies;

// Frees them. Takes NULL.
void sb_run_bodies_destroy(SbRunBodies *bodies);

// Copies the reactions of the first `count` frames of another run to the frames of this one from
// index `at`.
void sb_run_bodies_show(SbRun *run, size_t at, const SbRun *from, size_t count);

// Friction in a band of speed, linear in speed: rise + slope times speed.
typedef struct {
  double rise, slope; // N, N s/m
} SbBandPart;

// A band of speed in which friction is linear: what it adds to the parts proportional to the
// contact's width and load, of each seal, with vented (or the chamber's only state) and filled
// chamber.
typedef struct {
  double low, high; // m/s
  SbBandPart width[SB_SEAL_COUNT][2], load[SB_SEAL_COUNT][2];
} SbValveBand;

// Capacity of bands.
enum { SB_VALVE_BANDS = 48 };

// Bands of one chamber state and way, increasing.
typedef struct {
  size_t count;
  SbValveBand item[SB_VALVE_BANDS];
} SbValveBands;

// Solved states of the seals, and their part of the summary, for a model with the same states
// (sb_run_renew_same()).
typedef struct {
  bool stand;  // they are used: nothing is solved
  bool solved; // what follows is known, and no solver has failed
  SbCycle cycle;
  double friction_error, static_error, error_film, error_load, error_width;
  SbReport lacks;
  SbCounters counters;
  SbWarnings warnings;
} SbRunSolved;

// The run (SbRun of run.h).
struct SbRun {
  // Reused for the next model; all from `model` on belongs to one execution.
  SbSlidingMemory *memory[SB_SEAL_COUNT]; // owned
  bool predicted;                         // rings are linearised about another run's
  // The budget of this execution: own_work, or that of the run for which this one finds a speed.
  // Each later actuation of a life has its own.
  SbWork *work, own_work;
  SbFrame *frames; // [room], owned
  size_t room;
  // Reused if the next model's seals have the same states. States by speed, owned; NULL: not used
  // yet.
  SbSpeedStates *speeds[SB_SEAL_COUNT][SB_CYCLE_CHAMBERS][SB_RUN_REST];
  SbRunSolved solved;
  const SbModel *model; // owned
  SbPlan plan;
  size_t capacity;   // largest possible number of frames
  SbCycle cycle;     // its states serve every motion model
  double speed;      // sliding speed of the cycle's states [m/s]
  double mid_speed;  // of the stem in the middle of B-C, for the seals' figures [m/s]
  double back_speed; // in the middle of F-A, > 0 [m/s]
  // Static friction of ageing contacts over the dwell, divided by their level.
  SbDwellLaw rest[SB_SEAL_COUNT][SB_CYCLE_CHAMBERS];
  double roughness;   // of the states, divided by the model's
  bool out_of_memory; // one of `speeds` could not be allocated
  double
      straight_error; // error of linear bands of friction, divided by the friction without a film
  SbValveBands bands[SB_CYCLE_CHAMBERS][SB_RUN_REST]; // computed when first needed
  SbSummary summary;
  SbFilm history_film;      // of the present frame of the film history
  SbWarnings before_states; // the summary's, before the last states of sb_run_solve_states()
  // Errors (run_errors.c): of the motion's figures, absolute; of the sliding speeds by way,
  // relative; of a cycle's leakage [m3]; of the mass that remains in the chamber [kg].
  double motion_error[SB_FIGURE_COUNT], speed_error[2], leak_error, kept_error;
  double compared_error[SB_SEAL_COUNT]; // of the film solved for comparison, relative
  SbSealState shown[SB_SEAL_COUNT][2];  // states of the seals' figures: in-stroke and return
  SbBore bore;                          // of the last motion, under the outer seal
  SbFilm film;                          // work memory for films apart from the states
  double friction_error, static_error;  // largest error of a state's friction [N]
  SbRunProfile profile[SB_RUN_PROFILE_SLOTS];
  SbRunShape shape[SB_RUN_SHAPES];
  SbRunEdge edge[2];     // of the inner ring, by way
  SbReport lacks;        // why no motion can be computed; SB_OK: it can
  double before_frames;  // fraction of the work before the first frame
  double after_frames;   // fraction after the last frame: the later actuations of a life
  SbRunBodies *bodies;   // owned; NULL: not computed
  bool follows;          // a later actuation of a life: it uses the errors of the first
  SbLifeActuation *life; // [model.life_actuations], owned; NULL without a life
  size_t count;          // complete frames
  bool hold;             // frames are not published before their film history is known
  atomic_size_t published;
};

// Starts a budget of the model's work_limit steps (run.c).
void sb_run_begin_work(SbRun *run, const SbRunHooks *hooks);

// Solves all steady sliding states that the cycle can need, and the profiles of the plan, at the
// machine's speed, or with another drive at the stem's own speed in the middle of B-C
// (run_states.c).
SbStatus sb_run_solve_states(SbRun *run, const SbRunHooks *hooks, SbReport *report);

// Stores the states just solved with `status` in run->solved (run_states.c).
void sb_run_keep_states(SbRun *run, SbStatus status);

// Uses the stored states instead of solving (run_states.c).
void sb_run_take_states(SbRun *run);

// Adds *more to *sum.
void sb_run_add_counters(SbCounters *sum, const SbCounters *more);

// Stores a seal's solved section for drawing as its shape `index` (run_shapes.c).
SbStatus sb_run_keep_shape(SbRun *run, int seal, int index, const SbRing *ring, SbReport *report);

// Solves and stores the shapes of the inner ring over the land's edge for a way in which its state
// is `from`, and its free shape (run_shapes.c).
SbStatus sb_run_solve_edge(SbRun *run, int way, const SbRing *from, SbCounters *counts,
                           const SbRingOptions *options, SbReport *report);

// Returns the shape of a seal in a frame by its chamber and motion, with its whole contact on the
// land; UINT32_MAX: none.
uint32_t sb_run_shape_index(const SbRun *run, int seal, SbChamber chamber, int motion);

// Returns the shape of the inner seal at or beyond the land's edge by way and stem displacement s
// [m]; UINT32_MAX: none.
uint32_t sb_run_shape_over_edge(const SbRun *run, int way, double s);

// Number of rows of a stored profile.
enum { SB_PROFILE_ROWS = 5 };

// Returns the view of SB_PROFILE_ROWS consecutive rows of `count` numbers: x, pressure, film,
// asperity pressure, film pressure (NaN: no film was solved). `rows` and `model` are borrowed.
SbContactProfile sb_run_profile_view(const double *rows, size_t count, const char *model);

// Returns the index of the profile of a seal in a chamber state and motion.
uint32_t sb_run_profile_slot(int seal, int chamber, int motion);

// Returns the first chamber state in which the seal has contact and the same pressures as in
// `chamber`; they share one solution (run_states.c).
int sb_run_first_alike(const SbRun *run, int seal, int chamber);

// Largest allowed closure of the energy balance; a larger one means that the motion is not solved.
#define SB_RUN_CLOSURE 1e-6

// Computes the motion of the model, if its states are known. After an early end the frames and the
// stages reached remain; the report says where it ended (run.c).
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

// Sets outcome, figures of the return and press force in `summary`, that of the run or of a motion
// compared with it, and the reasons of missing ones. Its stages and peak force, and the states of
// the run's cycle, must be known. SB_ERROR_MEMORY (run_outcome.c).
SbStatus sb_run_conclude_motion(SbSummary *summary, SbRun *run, const SbRunEnd *end,
                                SbReport *report);

// Returns whether the actuation delivers a dose: the chamber has been filled and emptied
// (run_outcome.c).
bool sb_run_delivers(const SbRun *run);

// Computes frames, stages, energies and leakage of the quasi-static cycle (run_cycle.c).
SbStatus sb_run_quasi_static(SbRun *run, const SbRunHooks *hooks, SbReport *report);

// Does the same for the motion with inertia (run_dynamic.c).
SbStatus sb_run_dynamic(SbRun *run, const SbRunHooks *hooks, SbReport *report);

// Sets energies and step counts of a motion with inertia in the summary (run_dynamic.c).
void sb_run_fill_motion(SbSummary *summary, const SbDynamicsEnergy *energy,
                        const SbDynamicsCounters *counters);

// Computes the speed of the stem in the middle of B-C [m/s]. If it does not get there: the mean
// speed from B to D, else from E to F, else from E to rest; of a sinusoid that passes none of
// these, its mean speed. 0 if there is none. *slips: the stem slides (run_dynamic.c).
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

// Returns the layer that a seal sliding at `speed` [m/s] leaves on the bore, or can take from it
// [m].
double sb_run_layer(SbRun *run, int seal, SbChamber chamber, int direction, double speed);

// Starts an empty bore with the stem at s [m].
void sb_bore_start(SbBore *bore, double s);

// Moves the stem from `from` to `to` [m] with a film that carries `layer` [m]: it leaves layers
// when it moves in, and takes them back when it moves out.
void sb_bore_move(SbBore *bore, double from, double to, double layer);

// Sets the leakage of the motion that has left `bore`; NaN with the reason if the stem never moved,
// or does not come `back` to its start. The outcome must be known (run_figures.c).
void sb_run_leakage(SbSummary *summary, const SbModel *model, const SbBore *bore, bool back);

// Sets the reasons of figures that are missing because of the chosen models or of what happened;
// the last step of a run (run_figures.c).
void sb_run_give_reasons(SbRun *run, SbStatus status, const SbReport *report);

// Sets the figures of each seal in the middle of B-C (run_figures.c).
void sb_run_summarise_seals(SbRun *run);

// Computes the can on the shelf, as far as the plan needs it (run_shelf.c).
SbStatus sb_run_shelf(SbRun *run, const SbRunHooks *hooks, SbReport *report);

// Returns the fraction of the chamber that is filled in the time from C to F; NaN if they are not
// reached.
double sb_run_filled_share(const SbSummary *summary, const SbModel *model);

// ---- Errors (run_errors.c)

// Sets the motion's errors to 0, before a motion.
void sb_run_begin_errors(SbRun *run);

// Sets the motion's errors to NaN, after a motion whose errors are not known.
void sb_run_lose_errors(SbRun *run);

// Adds `share` times the differences between the figures of two motions to the motion's errors.
void sb_run_add_errors(SbRun *run, const SbSummary *one, const SbSummary *other, double share);

// Perturbs the cycle's states by their errors of one kind, `index` below SB_RUN_WRONG: kinetic
// friction larger, static friction larger, the ends of the inner contact off. Returns false, and
// changes nothing, if they have no error of this kind.
enum { SB_RUN_WRONG = 3 };
bool sb_run_worsen(SbRun *run, int index);

// Adds the error of the last motion's leakage that its films cause.
void sb_run_leak_error(SbRun *run);

// Sets the errors of all figures.
void sb_run_fill_errors(SbRun *run);

// Warns of errors above SB_ERROR_LARGE. Returns SB_ERROR_NOT_CONVERGED instead of SB_OK for an
// error above SB_ERROR_USELESS, else `status`.
SbStatus sb_run_judge_errors(SbRun *run, SbStatus status, SbReport *report);

// Sets the fractions of users who are weaker than the summary's forces (run.c).
void sb_run_weigh_users(SbSummary *summary, const SbModel *model);

// Returns the mass that the last motion delivers of a metered mass [kg]: less the part for which
// there is no time to fill, and what remains in the emptied chamber. NaN if sb_run_delivers() is
// false; 0 without canister pressure.
double sb_run_dose(const SbRun *run, double metered);

// Computes the range of stem displacements in which the dose chamber is open to the vent; returns
// false if it never is.
bool sb_run_vent(double *low, double *high, const SbRun *run);

// Publishes the first `count` frames.
void sb_run_publish(SbRun *run, size_t count);

// Stores the first time at which a stage is reached.
void sb_run_mark_stage(SbRun *run, SbStage stage, const SbFrame *frame, size_t index);

// Returns the error of the cycle's forces that the states' errors cause, of both seals, divided by
// the largest force.
double sb_run_error_friction(const SbRun *run);

// Reports progress: `fraction` of the work before the frames, or of the frames once there are any.
void sb_run_progress(const SbRun *run, const SbRunHooks *hooks, double fraction, size_t frames);

// Returns whether the hooks cancel the run, and fills the report then.
bool sb_run_cancelled(const SbRunHooks *hooks, SbReport *report);

// ---- Motion: the valve as a mechanism and its frames (run_valve.c), its drive (run_drive.c)

// Indices of stops.
enum { SB_REST_STOP = 0, SB_END_STOP = 1 };

// Times of a drive.
typedef struct {
  double duration; // of the whole drive [s]; frames are evenly spaced over it
  double turn;     // a reverse slip after this time is the return, before it a rebound [s]
  bool ends_run;   // the run ends with the drive, without waiting for rest
  // Instants at which the platen turns or the slope of the finger's force changes; a frame is
  // placed at each. `first` are those of the first period; they repeat with `period` until there
  // are `corners`.
  int corners;
  double period, first[2]; // [s]
} SbDriveTimes;

// The valve as the motion sees it; user data of the callbacks of SbDynamicsModel.
typedef struct {
  SbRun *run;
  bool both_alike;   // both ways have the same friction at speed 0
  SbChamber chamber; // at the present instant
  bool touches;      // the inner seal has contact
  // Stem displacements [m]: the chamber opens on the in-stroke beyond edge_open, and closes on the
  // return below edge_closed; a gasket valve's closes and opens.
  double edge_open;
  double edge_closed;
  double port;   // of a gasket valve: the chamber empties beyond it [m]
  double middle; // middle of B-C, and of F-A [m]
  // Fractions of the inner contact on the land at the displacement last requested.
  double land_at[SB_CYCLE_CHAMBERS];
  SbLandShare land[SB_CYCLE_CHAMBERS];
  bool varies[SB_DYNAMICS_EDGES + 1]; // regions in which the land's edge is under the contact
  double edge[SB_DYNAMICS_EDGES];     // edges of the mechanism [m]
  SbDriveTimes times;
  bool ports; // the chamber's pressure is an extra state
  SbChamberModel chamber_model;
  SbDoseChamber dose;
} SbValve;

// Creates the mechanism. The valve must exist as long as `out` is used. SB_ERROR_INFEASIBLE: ports
// contradict each other.
SbStatus sb_valve_set_up(SbDynamicsModel *out, SbValve *valve, SbRun *run, SbReport *report);

// States of contact that apply at an instant.
typedef struct {
  SbChamber chamber;
  int direction;
  int land; // way whose state determines the fraction of the inner seal on the land
} SbSolvedState;

// Computes the steady state of a sliding seal at `speed` [m/s] of either sign; solves states if
// needed. The summary gets their counts and warnings (run_speeds.c).
void sb_run_state_at(SbSealState *out, SbRun *run, int seal, int chamber, int direction,
                     double speed);

// Does the same between the vented (`filled` = 0) and the filled chamber (1), by interpolation.
void sb_run_state_between(SbSealState *out, SbRun *run, int seal, double filled, int direction,
                          double speed);

// Updates what follows from the films of such a state; sb_sliding_refilm().
void sb_run_refilm(SbSealState *state, SbRun *run, int seal, int chamber, int direction,
                   double speed);

// Sets the problem of the film of a sliding state, and returns the body of that film; NULL:
// half-plane.
const SbSlidingBody *sb_run_film_of(SbFilmProblem *out, SbRun *run, int seal, int chamber,
                                    int direction);

// Replaces the film of a state; sb_sliding_take().
void sb_run_take(SbSealState *state, SbRun *run, int seal, int chamber, int direction, double speed,
                 const SbFilm *film, bool fitted);

// Stores the body of the film of a state just solved, for films at other speeds; NULL: half-plane.
// SB_ERROR_MEMORY.
SbStatus sb_run_keep_body(SbRun *run, int seal, int chamber, int direction,
                          const SbSlidingBody *body, SbReport *report);

// Gives `one` those states by speed of `run` that it lacks, and gives all of them the surface and
// states of `one`. Solved states remain, because films do not depend on roughness. SB_ERROR_MEMORY.
SbStatus sb_run_copy_speeds(SbRun *one, const SbRun *run, SbReport *report);

// Returns the chamber state whose pressures apply in the middle of a way.
int sb_run_asked_chamber(int way);

// Solves what a state will need at speeds near the run's, in the thread of its seal. Best directly
// after that state, while the film solver has its film.
void sb_run_ask_beside(SbRun *run, int seal, int chamber, int way, SbCounters *counters,
                       SbWarnings *warnings);

// Adds the errors of interpolation by speed to the run's errors. SB_ERROR_CANCELLED,
// SB_ERROR_MEMORY, SB_ERROR_NOT_CONVERGED (budget) if it was ended early.
SbStatus sb_run_close_speeds(SbRun *run, SbReport *report);

// Frees the states by speed.
void sb_run_free_speeds(SbRun *run);

// Returns the states that apply to the valve's present chamber, with the stem's last `direction` of
// sliding (a way) and the chamber's pressure [Pa].
SbSolvedState sb_valve_solved(const SbValve *valve, int direction, double pressure);

// Returns the chamber pressure [Pa] in a frame from the mechanism's extra state.
double sb_valve_chamber_pressure(const SbValve *valve, double extra);

// One instant of a motion.
typedef struct {
  SbDynamicsSample sample; // acceleration, deflections and region may be unknown
  SbStage stage;           // last one passed
  SbChamber chamber;
  SbSolvedState solved;
  bool moving;     // the stem slides
  double pressure; // in the chamber [Pa]
} SbInstant;

// Sets the frame of an instant. Forces of the drive are those of the sample; contact, load, film
// and friction of a sliding seal are those of one steady state at the sample's speed and the
// chamber's pressure.
void sb_run_fill_frame(SbFrame *out, SbRun *run, const SbInstant *at);

// Replaces the film of a seal in a frame, and updates what follows from it. `fitted`: solved on the
// fitted body.
void sb_run_frame_film(SbFrame *frame, SbRun *run, int seal, const SbFilm *film, bool fitted);

// Publishes the first `count` frames and reports progress from time to time; returns true if the
// run is cancelled.
bool sb_run_poll(SbRun *run, const SbRunHooks *hooks, size_t count, double fraction,
                 SbReport *report);

// Assembles the constrained parts, counts their degrees of freedom, and allocates the reactions of
// all frames (run_bodies.c).
SbStatus sb_run_bodies_create(SbRun *run, SbReport *report);

// Returns the effective mass of the stroke as assembled [kg].
double sb_run_bodies_mass(const SbRunBodies *bodies);

// Moves the parts to the stem displacement x [m] at the stem speed v [m/s], and computes the
// effective mass there [kg]. SB_ERROR_INFEASIBLE: the parts do not move together.
SbStatus sb_run_bodies_move(double *mass, SbRun *run, double x, double v, SbReport *report);

// Computes the reactions of the joints for the frame `index`, and adds to the summary. Moves the
// parts there.
SbStatus sb_run_bodies_frame(SbRun *run, size_t index, const SbDynamicsSample *sample,
                             SbReport *report);

// Sets drive, start position and the drive's times.
void sb_valve_set_drive(SbDynamicsModel *out, SbDriveTimes *times, const SbRun *run);
