// What the files of a run share: its state, and the steps that sb_run_execute() takes in order.
#pragma once

#include "engine/mechanism/chamber.h"
#include "engine/mechanism/dynamics.h"
#include "engine/valve/model/model.h"
#include "engine/valve/run/cycle.h"
#include "engine/valve/run/run.h"
#include "engine/valve/run/run_work.h"
#include "engine/valve/states/speed_states.h"

enum {
  SB_RUN_REST = 2,
  SB_RUN_PROFILE_SLOTS = SB_SEAL_COUNT * SB_CYCLE_CHAMBERS * SB_RUN_MOTIONS,
  // Room for frames that sit on events, and for those of a motion that outlasts its drive.
  SB_RUN_EVENT_FRAMES = 2 * SB_CYCLE_SEGMENTS_MAX + 800
};

typedef struct {
  SbContactProfile view;
  double *data; // x, pressure, film, asperity pressure
} SbRunProfile;

// Shapes of a seal: of its steady states, over the land's edge, free.
enum {
  SB_RUN_SHAPE_EDGE = SB_CYCLE_CHAMBERS * SB_RUN_MOTIONS,
  SB_RUN_SHAPE_FREE = SB_RUN_SHAPE_EDGE + 2 * SB_RUN_EDGES, // both ways
  SB_RUN_SEAL_SHAPES = SB_RUN_SHAPE_FREE + 1,
  SB_RUN_SHAPES = SB_SEAL_COUNT * SB_RUN_SEAL_SHAPES
};
_Static_assert((int)SB_RUN_SHAPES <= (int)SB_RUN_SHAPES_MAX,
               "shapes are indexed below SB_RUN_SHAPES_MAX");

typedef struct {
  SbSealShape view;
  void *data; // all its arrays
} SbRunShape;

// Where the land's edge shapes the inner ring, in its frame [m]; equal: nowhere.
typedef struct {
  double begin, end;
} SbRunEdge;

// What lies on the bore behind a seal, by the stem's displacement, and the volumes by length of
// circumference that it carried.
enum { SB_BORE_LAYERS = 512 };
typedef struct {
  double end;   // [m]
  double layer; // from the end of the one before to there [m]
} SbBoreLayer;
typedef struct {
  double start;     // [m]
  double out, back; // [m2]
  size_t count;
  SbBoreLayer item[SB_BORE_LAYERS];
} SbBore;

// The constrained parts of a run that asks for them (run_bodies.c).
typedef struct SbRunBodies SbRunBodies;
void sb_run_bodies_destroy(SbRunBodies *bodies);

// The reactions of the first `count` frames of another run for this one's frames from `at` on.
void sb_run_bodies_show(SbRun *run, size_t at, const SbRun *from, size_t count);

// A band of speed in which friction is straight: what it adds to the parts in proportion to the
// contact's width and load, of each seal vented (or in the chamber's one state) and filled.
typedef struct {
  double rise, slope; // N, N s/m
} SbBandPart;
typedef struct {
  double low, high; // m/s
  SbBandPart width[SB_SEAL_COUNT][2], load[SB_SEAL_COUNT][2];
} SbValveBand;
enum { SB_VALVE_BANDS = 48 };
typedef struct {
  size_t count;
  SbValveBand item[SB_VALVE_BANDS];
} SbValveBands;

// The seals' states as they were solved, and what they left in the summary: for a model that has
// the same ones (sb_run_renew_same()).
typedef struct {
  bool stand;  // in force: nothing is solved
  bool solved; // what follows is known, and no solver has failed
  SbCycle cycle;
  double friction_error, static_error, error_film, error_load, error_width;
  SbReport lacks;
  SbCounters counters;
  SbWarnings warnings;
} SbRunSolved;

struct SbRun {
  // Kept from one model to the next; what follows is one execution's.
  SbSlidingMemory *memory[SB_SEAL_COUNT];
  bool predicted; // rings are another run's to first order
  // The budget of this execution: own_work, or that of the run for which this one finds a speed.
  // Each further actuation of a life has one of its own.
  SbWork *work, own_work;
  SbFrame *frames;
  size_t room; // of the array
  // Kept where the next model's seals have the same states; speeds NULL where nobody has asked.
  SbSpeedStates *speeds[SB_SEAL_COUNT][SB_CYCLE_CHAMBERS][SB_RUN_REST]; // over the speed, owned
  SbRunSolved solved;
  const SbModel *model; // its own
  SbPlan plan;
  size_t capacity;   // frames at most
  SbCycle cycle;     // its states serve every motion model
  double speed;      // sliding speed that the cycle's states stand for [m/s]
  double mid_speed;  // of the stem at the middle of B-C, for the seals' figures [m/s]
  double back_speed; // at the middle of F-A, > 0 [m/s]
  SbDwellLaw rest[SB_SEAL_COUNT][SB_CYCLE_CHAMBERS]; // of contacts that age, over their level
  double roughness;                                  // that the states have, over the model's
  bool out_of_memory;                                // for one of them
  double straight_error; // of friction in the motion's bands of speed, over that without a film
  SbValveBands bands[SB_CYCLE_CHAMBERS][SB_RUN_REST]; // of the motion; made when first asked for
  SbSummary summary;
  SbFilm history_film;      // of the film history's present frame
  SbWarnings before_states; // the summary's, before the last states of sb_run_solve_states()
  // Errors (run_errors.c): absolute, of the motion's figures; relative, of the sliding speeds by
  // direction; absolute, of a cycle's leak [m3] and of the mass that the chamber keeps [kg];
  // relative, of the film solved for comparison.
  double motion_error[SB_FIGURE_COUNT], speed_error[2], leak_error, kept_error;
  double compared_error[SB_SEAL_COUNT];
  SbSealState shown[SB_SEAL_COUNT][2]; // states of the seals' figures: in-stroke and return
  SbBore bore;                         // of the last motion, under the outer seal
  SbFilm film;                         // of whoever solves one beside the states
  double friction_error, static_error; // of any state's frictions by its films [N]
  SbRunProfile profile[SB_RUN_PROFILE_SLOTS];
  SbRunShape shape[SB_RUN_SHAPES];
  SbRunEdge edge[2];     // of the inner ring, by way of sliding
  SbReport lacks;        // why there can be no motion; SB_OK: nothing is missing
  double before_frames;  // share of the work that lies before the first frame
  double after_frames;   // and behind the last: the rest of a life
  SbRunBodies *bodies;   // NULL: the reduced form is enough
  bool follows;          // a later actuation of a life: the first one's errors stand for all
  SbLifeActuation *life; // [model.life_actuations], NULL without a life
  size_t count;          // frames that are complete
  bool hold;             // they wait for their films' history before they are published
  atomic_size_t published;
};

// Begins a budget of the model's work_limit steps (run.c).
void sb_run_begin_work(SbRun *run, const SbRunHooks *hooks);

// Solves every steady sliding state the cycle can need, and the profiles if the plan wants them, at
// the speed of the machine or, where something else drives the stem, at the stem's own at the
// middle of B-C (run_states.c).
SbStatus sb_run_solve_states(SbRun *run, const SbRunHooks *hooks, SbReport *report);

// Remembers the states as just solved, and takes them for another model in their place
// (run_states.c).
void sb_run_keep_states(SbRun *run, SbStatus status);
void sb_run_take_states(SbRun *run);

// What else was solved for a run.
void sb_run_add_counters(SbCounters *sum, const SbCounters *more);

// Keeps a seal's solved section for drawing, as shape `index` of its own (run_shapes.c).
SbStatus sb_run_keep_shape(SbRun *run, int seal, int index, const SbRing *ring, SbReport *report);

// Solves the inner ring over the land's edge for a way of sliding, SB_CYCLE_IN or SB_CYCLE_OUT, in
// which its state is `from`; and free.
SbStatus sb_run_solve_edge(SbRun *run, int way, const SbRing *from, SbCounters *counts,
                           const SbRingOptions *options, SbReport *report);

// Shape of a seal in a frame, by its chamber and its motion (SB_CYCLE_IN, SB_CYCLE_OUT,
// SB_RUN_REST), its whole contact on the land. UINT32_MAX if none was solved.
uint32_t sb_run_shape_index(const SbRun *run, int seal, SbChamber chamber, int motion);

// The same of the inner seal while the land's edge lies under it or beyond: by the way of sliding
// and the stem's displacement s [m].
uint32_t sb_run_shape_over_edge(const SbRun *run, int way, double s);

// Rows of `count` numbers each, one after the other, in which a profile is stored.
enum { SB_PROFILE_ROWS = 5 };

// Returns the view of such rows: x, pressure, film, asperity pressure, film pressure (not a number
// where no film was solved). `model` is borrowed.
SbContactProfile sb_run_profile_view(const double *rows, size_t count, const char *model);

// Index of a profile, of a seal's states of contact in chamber and motion.
uint32_t sb_run_profile_slot(int seal, int chamber, int motion);

// The first chamber state with the pressures of this one on a seal that touches then: one solution
// serves both (run_states.c).
int sb_run_first_alike(const SbRun *run, int seal, int chamber);

// By how much a motion's balance of energies may be open: a check of the motion, which is not
// solved beyond it.
#define SB_RUN_CLOSURE 1e-6

// The motion by the model's choice, if there is all that it needs. One that ends early keeps its
// frames and the stages it reached; the report says where it ended (run.c).
SbStatus sb_run_move(SbRun *run, const SbRunHooks *hooks, SbReport *report);

// What a motion leaves behind for its outcome; forces in N, places in m.
typedef struct {
  double start, top;    // displacement of the stem: at first, largest
  double position;      // at the end
  double speed;         // at the end [m/s]
  double force;         // of the drive at the end
  bool bonded;          // the drive is bonded to the stem
  double dwell;         // rest between the end of the in-stroke and the first reverse slip [s]
  double press;         // largest force of the drive before the stop
  double sliding_least; // minimum of pressure force less friction of the slide back at its own
                        // speeds; INFINITY: the steady states' friction alone counts
} SbRunEnd;

// Sets the outcome, the return's figures and the press force in `summary`, that of the run or of a
// motion compared with it, with reasons for those that are null. The summary's stages and its peak
// force must be known; the seals' states are those of the run's cycle. SB_ERROR_MEMORY
// (run_outcome.c).
SbStatus sb_run_conclude_motion(SbSummary *summary, SbRun *run, const SbRunEnd *end,
                                SbReport *report);

// Whether the actuation delivers a dose: the stages in which the chamber fills and empties have
// happened (run_outcome.c).
bool sb_run_delivers(const SbRun *run);

// Frames, stages, energy and leakage of the quasi-static cycle (run_cycle.c) and of the motion with
// inertia (run_dynamic.c).
SbStatus sb_run_quasi_static(SbRun *run, const SbRunHooks *hooks, SbReport *report);
SbStatus sb_run_dynamic(SbRun *run, const SbRunHooks *hooks, SbReport *report);

// Energies and counts of a motion with inertia into the summary (run_dynamic.c).
void sb_run_fill_motion(SbSummary *summary, const SbDynamicsEnergy *energy,
                        const SbDynamicsCounters *counters);

// Speed of the stem at the middle of B-C [m/s]; where it does not get there its mean speed from B
// to D, or from E to F, or home, whichever it passes first; of a sinusoid that passes none, its
// own. 0 if there is none. *slips tells whether the stem slides at all (run_dynamic.c).
SbStatus sb_run_dynamic_speed(double *speed, bool *slips, SbRun *run, const SbRunHooks *hooks,
                              SbReport *report);

// The actuations after the first, once that one has run (run_life.c).
SbStatus sb_run_rest_of_life(SbRun *run, const SbRunHooks *hooks, SbReport *report);

// The sliding-plate rig in place of the valve (run_rig.c).
SbStatus sb_run_rig(SbRun *run, const SbRunHooks *hooks, SbReport *report);

// Films of the first `count` frames, which nobody else may see yet, by the transient film
// (run_film.c). From where a seal's film fails its frames have none (NaN), with a warning.
SbStatus sb_run_film_history(SbRun *run, size_t count, const SbRunHooks *hooks, SbReport *report);

// What the bore brings to a seal's inlet in one of its states (run_supply.c). Those that come
// before it, in the order of the profiles' indices, are solved.
SbSupply sb_run_supply(const SbRun *run, int seal, SbChamber chamber, int motion);

// Layer that a seal sliding at a speed [m/s] leaves on the bore, or can take from it [m].
double sb_run_layer(SbRun *run, int seal, SbChamber chamber, int direction, double speed);

// The stem starts at s. Then it slides, with a film that carries `layer` [m] there.
void sb_bore_start(SbBore *bore, double s);
void sb_bore_move(SbBore *bore, double from, double to, double layer);

// The leak of the motion of which these volumes are left; none, with the reason, where the stem
// does not move, or does not come `back` to where it began. The outcome must be known
// (run_figures.c).
void sb_run_leakage(SbSummary *summary, const SbModel *model, const SbBore *bore, bool back);

// Gives the figures that are missing by the choice of models or by what happened their reasons
// (run_figures.c). The last step of a run.
void sb_run_give_reasons(SbRun *run, SbStatus status, const SbReport *report);

// Figures of each seal at the middle of B-C (run_figures.c).
void sb_run_summarise_seals(SbRun *run);

// What the can loses on the shelf, as far as the plan asks for it (run_shelf.c).
SbStatus sb_run_shelf(SbRun *run, const SbRunHooks *hooks, SbReport *report);

// Share of the chamber that there is time to fill between C and F; NaN where they are not reached.
double sb_run_filled_share(const SbSummary *summary, const SbModel *model);

// Errors (run_errors.c). Before a motion: no error; after one whose error is not known: NaN.
void sb_run_begin_errors(SbRun *run);
void sb_run_lose_errors(SbRun *run);

// Adds `share` of what the figures of two motions differ by to the motion's errors.
void sb_run_add_errors(SbRun *run, const SbSummary *one, const SbSummary *other, double share);

// Makes the cycle's states wrong by their errors: frictions larger, the inner contact wider. False:
// they have none, and nothing has changed.
bool sb_run_worsen_friction(SbRun *run);
bool sb_run_widen_contact(SbRun *run);

// Adds the error of the last motion's leak by its films.
void sb_run_leak_error(SbRun *run);

// Fills the errors of all figures, which are known.
void sb_run_fill_errors(SbRun *run);

// Warns of errors above SB_ERROR_LARGE. SB_ERROR_NOT_CONVERGED for one above SB_ERROR_USELESS in
// place of SB_OK, else `status`.
SbStatus sb_run_judge_errors(SbRun *run, SbStatus status, SbReport *report);

// Shares of the users who are weaker than a summary's forces (run.c).
void sb_run_weigh_users(SbSummary *summary, const SbModel *model);

// What of a metered mass [kg] the last motion delivers: less what there is no time to fill, and
// what the emptied chamber keeps. NaN where sb_run_delivers() is false.
double sb_run_dose(const SbRun *run, double metered);

// Stem positions between which the dose chamber is open to the vent; false: nowhere in the stroke.
bool sb_run_vent(double *low, double *high, const SbRun *run);

// Makes the first `count` frames visible to other threads.
void sb_run_publish(SbRun *run, size_t count);

// Remembers the first time a stage is reached.
void sb_run_mark_stage(SbRun *run, SbStage stage, const SbFrame *frame, size_t index);

// What the films' error leaves in the cycle's forces, over the largest of them; both seals.
double sb_run_error_friction(const SbRun *run);

// Tells how far the run is: `fraction` of the work before the frames, or of the frames once there
// are any.
void sb_run_progress(const SbRun *run, const SbRunHooks *hooks, double fraction, size_t frames);

// Whether the hooks ask to stop; fills the report then.
bool sb_run_cancelled(const SbRunHooks *hooks, SbReport *report);

// ---- Motion: the valve as a mechanism and its frames (run_valve.c), what drives it (run_drive.c)

enum { SB_REST_STOP = 0, SB_END_STOP = 1 };

// When the drive does what; all in s.
typedef struct {
  double duration; // of the whole drive [s]: frames are evenly spaced over it
  double turn;     // from then on a reverse slip is the return, before it a rebound
  bool ends_run;   // the run ends with the drive, without waiting for rest
  // Where the platen turns or the finger's force bends, so that a frame sits on every extreme
  // whatever the frames' spacing: in the first period, and so on in all of them.
  int corners;
  double period, first[2]; // s
} SbDriveTimes;

// The valve as the motion sees it; the user of the callbacks of SbDynamicsModel.
typedef struct {
  SbRun *run;
  bool both_alike;    // either direction has the same friction at speed 0
  SbChamber chamber;  // passed on the way
  bool touches;       // the inner seal seals at all
  double edge_open;   // stem displacement behind which the chamber opens on the way in
  double edge_closed; // and closes on the way out; of a gasket valve closes and opens
  double port;        // of a gasket valve, from which on the chamber empties
  double middle;      // of B-C, and of F-A [m]
  // What the land carries of the inner contact where it was last asked for.
  double land_at[SB_CYCLE_CHAMBERS];
  SbLandShare land[SB_CYCLE_CHAMBERS];
  bool varies[SB_DYNAMICS_EDGES + 1]; // regions in which the land's edge lies under the contact
  double edge[SB_DYNAMICS_EDGES];     // those of the mechanism [m]
  SbDriveTimes times;
  bool ports; // the chamber's pressure is a state, the extra one
  SbChamberModel chamber_model;
  SbDoseChamber dose;
} SbValve;

// Makes the mechanism. The valve must outlive `out`. SB_ERROR_INFEASIBLE if ports contradict each
// other.
SbStatus sb_valve_set_up(SbDynamicsModel *out, SbValve *valve, SbRun *run, SbReport *report);

// The states of contact that stand for an instant.
typedef struct {
  SbChamber chamber;
  int direction;
  int land; // direction whose state tells what the land carries of the inner seal
} SbSolvedState;

// The steady state of a sliding seal at a speed of either sign [m/s]; what it is interpolated from
// is solved when first asked for (run_speeds.c).
void sb_run_state_at(SbSealState *out, SbRun *run, int seal, int chamber, int direction,
                     double speed);

// The same between the vented chamber and, filled = 1, the filled one.
void sb_run_state_between(SbSealState *out, SbRun *run, int seal, double filled, int direction,
                          double speed);

// What follows from the films of such a state, see sb_sliding_refilm().
void sb_run_refilm(SbSealState *state, SbRun *run, int seal, int chamber, int direction,
                   double speed);

// The problem of the film of a sliding state, and the body that it lies on; NULL: the half-plane.
const SbSlidingBody *sb_run_film_of(SbFilmProblem *out, SbRun *run, int seal, int chamber,
                                    int direction);

// Gives a state another film, see sb_sliding_take().
void sb_run_take(SbSealState *state, SbRun *run, int seal, int chamber, int direction, double speed,
                 const SbFilm *film, bool fitted);

// Keeps the body under the film of a state just solved, for films at other speeds on it; NULL: it
// lies on the half-plane.
SbStatus sb_run_keep_body(SbRun *run, int seal, int chamber, int direction,
                          const SbSlidingBody *body, SbReport *report);

// Gives `one` the speeds' states of `run` where it has none, and all of them its surface and
// states. What it solved before stays: films know no roughness.
SbStatus sb_run_copy_speeds(SbRun *one, const SbRun *run, SbReport *report);

// The chamber whose state is asked for when the stem slides that way.
int sb_run_asked_chamber(int way);

// Solves what a state of a seal at speeds beside the run's will ask for, on the thread of its
// states: soonest right after that state, whose film is then the solver's last.
void sb_run_ask_beside(SbRun *run, int seal, int chamber, int way, SbCounters *counters,
                       SbWarnings *warnings);

// Adds what interpolation over the speed leaves in the errors. SB_ERROR_CANCELLED or _MEMORY if
// that ended it.
SbStatus sb_run_close_speeds(SbRun *run, SbReport *report);

void sb_run_free_speeds(SbRun *run);

// Those of the valve as it is, with the stem's last `direction` of sliding and the chamber's
// pressure [Pa].
SbSolvedState sb_valve_solved(const SbValve *valve, int direction, double pressure);

// Chamber pressure [Pa] in a frame, given the mechanism's extra state.
double sb_valve_chamber_pressure(const SbValve *valve, double extra);

// What a motion says of one instant.
typedef struct {
  SbDynamicsSample sample; // acceleration, deflections and region need not be known
  SbStage stage;           // last passed
  SbChamber chamber;
  SbSolvedState solved;
  bool moving;     // the stem slides
  double pressure; // in the chamber [Pa]
} SbInstant;

// Its frame: the drive's forces are the sample's; contact, load, film and friction of a seal that
// slides are those of one steady state, at the sample's speed and the chamber's pressure.
void sb_run_fill_frame(SbFrame *out, SbRun *run, const SbInstant *at);

// Gives a seal in a frame another film, on the fitted body or not, and what follows from it there.
void sb_run_frame_film(SbFrame *frame, SbRun *run, int seal, const SbFilm *film, bool fitted);

// Makes the first `count` frames visible and tells the progress every now and then; true: stop.
bool sb_run_poll(SbRun *run, const SbRunHooks *hooks, size_t count, double fraction,
                 SbReport *report);

// The constrained parts (run_bodies.c). Assembles them, counts their freedom, and makes room for
// the frames' reactions.
SbStatus sb_run_bodies_create(SbRun *run, SbReport *report);

// Mass that the stroke sees as assembled [kg].
double sb_run_bodies_mass(const SbRunBodies *bodies);

// Moves the parts to displacement x [m] with the stem at speed v [m/s]; the mass that the stroke
// sees there [kg]. SB_ERROR_INFEASIBLE where the parts do not move as one.
SbStatus sb_run_bodies_move(double *mass, SbRun *run, double x, double v, SbReport *report);

// Reactions of the joints for the frame at `index`; adds to the summary. Moves the parts there.
SbStatus sb_run_bodies_frame(SbRun *run, size_t index, const SbDynamicsSample *sample,
                             SbReport *report);

// Sets what drives the mechanism, where it starts, and the drive's times.
void sb_valve_set_drive(SbDynamicsModel *out, SbDriveTimes *times, const SbRun *run);
