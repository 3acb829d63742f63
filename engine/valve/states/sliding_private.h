// Shared by the files sliding*.c, which compute a steady sliding state.
//
// sb_sliding_solve_with() computes a state in the order fit, film, rough contact, friction; each
// step reads its input from the SbSealState and adds its results to it. For a sliding ring
// sb_sliding_drag() repeats this, each time with the friction of the last film as the law that
// drags the ring, until both agree. With a `start` and linearisation (sb_sliding_memory_start(),
// tangent) sb_sliding_solve_with() first calls sb_sliding_sum(), which computes the results of the
// solvers as a linear function of their inputs, with slopes stored in SbSlidingSlopes. Then
// sb_sliding_solve_once() copies these results instead of solving, and at last
// sb_sliding_solve_with() calls sb_sliding_sum_end(), also after an error.
//
// A `way` is an index below SB_RUN_MOTIONS, SB_WAY_IN and so on.
//
// Every task has a memory that is not NULL and that this thread alone uses. Which functions need
// which part of a state: `out` of sb_sliding_fit_contact(), _solve_once(), _solve_with() and
// _drag() may be uninitialised, because they begin with sb_sliding_clear(). All others change a
// state that sb_sliding_fit_contact() has begun and the steps before them have filled. After
// SB_ERROR_NOT_CONVERGED (a solver stopped early) the state has its last values; after another
// error it is unspecified.
#pragma once

#include "engine/valve/states/contact_law.h"

// Ways: friction drags the seal (sb_sliding_drags()) with speed > 0, with speed < 0, or not at all.
enum { SB_WAY_IN, SB_WAY_OUT, SB_WAY_REST };

// A solved film, with its profile.
typedef struct {
  SbFilm film;
  SbFilmProfile profile;
  bool fitted;        // solved on the fitted body; false: on the half-plane, or by a law
  double speed;       // sliding speed of the task, with its sign [m/s]
  double share;       // speed at which it was solved divided by `speed`, <= 1
  bool fresh;         // solved since this flag was last cleared
  SbFilmSolver **own; // borrowed: solver of this film only; NULL: the memory's solver
  bool on_base;       // solve it on the mesh of the last solution of `own` if possible
} SbSlidingSolved;

// Relative changes of a fit's load, contact width and peak pressure per newton of the friction that
// drags its ring, magnitudes [1/N].
typedef struct {
  double load, width, peak;
} SbSlidingPull;

// The last fit of one way, with its ring.
typedef struct {
  SbFit fit;
  SbRing *ring;     // owned; NULL for other fit models
  bool known;       // `fit` is valid for `seal` and `pressure`
  SbReport why;     // why the fit without drag failed; status SB_OK: it did not fail
  double pressure;  // pressure difference of the fit, left minus right [Pa]
  double modulus;   // Young's modulus of the rubber in the fit [Pa]
  int seal;         // SB_OUTER, SB_INNER
  SbSlidingLaw law; // law of the friction that drags the ring in `fit`
  double jump; // relative difference between the friction of `found` and of `law`, if they cannot
               // agree because the friction jumps; else 0
  SbSlidingLaw found; // law of the friction of the film on this ring
  SbSlidingLaw guess; // law of the friction by closed forms
  SbSlidingPull pull; // how the fit depends on the friction that drags it
} SbSlidingFitment;

// Number of films of a state: on the half-plane, on the fitted body, at rest.
enum { SB_SLIDING_FILMS = 3 };

// Results of the solvers for a state, solved or linearised (sliding_beside.c).
typedef struct {
  SbFit fit;
  SbSlidingBody body;
  struct {
    bool solved, fitted; // there is such a film; SbSlidingSolved.fitted
    double share;        // SbSlidingSolved.share
    SbFilm film;         // without its profile
  } on[SB_SLIDING_FILMS];
} SbSlidingSolution;

// Parts of a solution: all, fit without its surface, or surface and films.
typedef enum { SB_SOLUTION_WHOLE, SB_SOLUTION_FITMENT, SB_SOLUTION_FILMS } SbSolutionPart;

// Adds `by` times the numbers of a part of `from` to those of *out.
void sb_solution_add(SbSlidingSolution *out, double by, const SbSlidingSolution *from,
                     SbSolutionPart part);

// Sets *out to the results of the last task of `memory`.
void sb_solution_take(SbSlidingSolution *out, SbSlidingMemory *memory);

// Returns whether two solutions have the same structure (contact, state of the ring, films, numbers
// of values), so that both may be terms of a sum. With `fitment` only their fits without surfaces
// are compared.
bool sb_solution_alike(const SbSlidingSolution *a, const SbSlidingSolution *b, bool fitment);

// Returns the memory's film with index `i` below SB_SLIDING_FILMS; borrowed.
SbSlidingSolved *sb_sliding_slot(SbSlidingMemory *memory, int i);

// Slopes of the solvers' results near the state of a stored ring. It is filled when slopes are
// first needed, and has a lock: several threads may use it at the same time.
typedef struct SbSlidingSlopes SbSlidingSlopes;

// Returns an object without states; NULL: no memory. Freed by sb_sliding_slopes_destroy().
SbSlidingSlopes *sb_sliding_slopes_create(void);

// Frees the object.
void sb_sliding_slopes_destroy(SbSlidingSlopes *slopes);

// Which part of a state is linearised instead of solved: nothing, the fit, or fit and films.
typedef enum { SB_SUM_NOTHING, SB_SUM_FITMENT, SB_SUM_ALL } SbSumDepth;

// State of a ring that others start from (SbSlidingMemory.stored).
typedef struct {
  SbFitStart start;        // for SbFitProblem.start
  SbRing *ring;            // owned; the ring of `start`; NULL: this state has no contact
  SbRingGuide *guide;      // owned; predictor of the ring
  SbRingTangent *tangent;  // owned; linearisation of the ring
  SbSlidingSlopes *slopes; // owned; slopes near this state
  int way;                 // index in SbSlidingMemory.fitment
  double strain;           // pressure difference (left minus right) divided by the modulus [1]
  SbSlidingLaw law, found; // as in SbSlidingFitment
  SbSlidingLaw guess;      // as in SbSlidingFitment
  SbSlidingPull pull;      // as in SbSlidingFitment
} SbSlidingStart;

// The film whose mesh the memory's solver holds. Films with nearly equal values are solved on this
// mesh.
typedef struct {
  bool known, fitted;   // there is such a film; SbSlidingSolved.fitted
  double inlet, outlet; // fluid pressures at inlet and outlet [Pa]
  double speed, load;   // magnitude of the sliding speed [m/s]; net load [N/m]
} SbSlidingBase;

// Capacity of stored states; a run has at most three chamber states in each way.
enum { SB_SLIDING_STARTS = 64 };

// The memory of sliding.h.
struct SbSlidingMemory {
  bool stores; // solved states are stored for others
  SbSlidingStart stored[SB_SLIDING_STARTS];
  int stored_count;                   // number of stored states
  const struct SbSlidingMemory *from; // rings start from its stored states, borrowed; NULL: cold
  bool tangent;                       // rings are linearised about the states of `from`
  bool summed;                        // films are linearised too
  SbRingsBeside rings;                // how linearised rings are evaluated
  bool bare;                          // surfaces of rings for films are not computed
  SbSumDepth sums;                    // part of the present state that is linearised
  SbSlidingSolution sum;              // values of this part
  SbSlidingMemory *prefetched; // may have the next ring (sb_sliding_memory_prefetched()), borrowed
  SbSlidingSlopes *lender;     // object whose film solvers the films use; NULL: own solvers

  SbSlidingFitment fitment[SB_RUN_MOTIONS]; // by way
  SbSlidingFitment *now;                    // fit of the last task, in `fitment`
  SbSlidingSolved plane, fitted;   // film on the half-plane or by a law; on the fitted body
  SbSlidingSolved rest;            // dry rough contact, only with coupled asperities
  const SbSlidingSolved *last;     // film of the last task: plane, fitted or rest
  bool rested;                     // `rest` is valid for rest_left and rest_on
  double rest_left;                // pressure on the left in `rest` [Pa]
  const SbSlidingFitment *rest_on; // fit of `rest`
  SbSlidingBody body;              // body of the last film on a fitted body
  SbFilmSolver *solver;            // NULL until a film is solved (laws need none)
  SbFilmSolver *rest_solver;       // solver of `rest`; keeps the other one's solution
  SbRoughLaw law;                  // law of the rough surface; count 0: not yet computed
  SbSlidingBase base;              // film that `solver` last solved on a mesh of its own
  bool near;                       // films close to `base` may be solved on its mesh
  bool rest_waits;                 // the values at rest of a sliding state are omitted
  SbWarnings warnings;             // work memory: warnings of one round of sb_sliding_drag()
  bool (*cancelled)(void *);       // NULL: never
  void *cancelled_data;            // argument of `cancelled`
};

// Moves the solved ring of `way` to memory->stored, if memory->stores and there is one in contact
// and sliding. Does nothing if no place is free or memory cannot be allocated.
void sb_sliding_store(SbSlidingMemory *memory, int way);

// Returns whether friction drags this seal's section: that of a ring while it slides.
bool sb_sliding_drags(const SbSlidingTask *task);

// Returns the law of a task's surface with coupled asperities, computed once for all films of the
// seal; borrowed. NULL if there is none.
const SbRoughLaw *sb_sliding_rough_law(const SbSlidingTask *task);

// Returns whether the results of a solver with this status are used: SB_OK, or
// SB_ERROR_NOT_CONVERGED (its last solution, with its error estimate).
bool sb_sliding_usable(SbStatus status);

// Clears *out and sets contact and loads from the fit. A ring is dragged by `law`; NULL: reuse the
// fit of the memory if seal and pressure are equal, else fit without drag. *known: there is a
// contact; if false there is nothing to add to the state (no contact, or an error).
SbStatus sb_sliding_fit_contact(const SbSlidingTask *task, const SbSlidingLaw *law,
                                SbSealState *out, bool *known, SbReport *report);

// Determines which part of the task is linearised about the stored state of `slopes`, a ring
// dragged by `law` (NULL: none), and computes its values: sets memory->sums and memory->sum.
// Missing slopes are solved. May lock `slopes` until sb_sliding_sum_end(), which the caller must
// call in any case, before another sb_sliding_sum(). SB_ERROR_CANCELLED.
SbStatus sb_sliding_sum(const SbSlidingTask *task, const SbSlidingLaw *law,
                        SbSlidingSlopes *slopes);

// Resets memory->sums and unlocks what sb_sliding_sum() has locked. Does nothing without it.
void sb_sliding_sum_end(SbSlidingMemory *memory);

// Returns whether the film `which` (plane, fitted or rest of the memory), on the fitted body if
// `fitted`, is available from memory->sum.
bool sb_sliding_film_summed(const SbSlidingMemory *memory, const SbSlidingSolved *which,
                            bool fitted);

// Copies to *out, which is plane, fitted or rest of the memory, its film from memory->sum;
// required: sb_sliding_film_summed().
void sb_sliding_copy_film(SbSlidingSolved *out, SbSlidingMemory *memory);

// Returns the state of memory->from from which the task's ring starts (sb_sliding_memory_start());
// NULL: none. Borrowed from memory->from.
const SbSlidingStart *sb_sliding_start_of(const SbSlidingTask *task);

// Returns the way of a task.
int sb_sliding_way(const SbSlidingTask *task);

// Sets *problem to the fit problem of a task, dragged by `law` (NULL: not), whose copy is on->law.
// It borrows from task->memory and `on`.
void sb_sliding_fit_problem(SbFitProblem *problem, const SbSlidingTask *task, SbSlidingFitment *on,
                            const SbSlidingLaw *law);

// Computes the law of a ring's friction by closed forms, 0 where they have none; changes the fit of
// `on` and the memory's film.
void sb_sliding_guess(SbSlidingLaw *law, const SbSlidingTask *task, SbSlidingFitment *on);

// Returns the law to drag a ring with first: by closed forms, or that of `start` (NULL: none) as
// these change from there. Sets on->guess.
SbSlidingLaw sb_sliding_first_law(const SbSlidingTask *task, SbSlidingFitment *on,
                                  const SbSlidingStart *start);

// Clears the fit and returns SB_ERROR_NOT_CONVERGED: memory->from has no stored state for the
// task's ring.
SbStatus sb_sliding_no_tangent(const SbSlidingTask *task, SbSlidingFitment *on, SbReport *report);

// Discards the memory's fit of the task's way and its values at rest.
void sb_sliding_forget_fitment(const SbSlidingTask *task);

// Computes fit, film and friction of a task; solves what memory->sums does not have. `law` as for
// sb_sliding_fit_contact().
SbStatus sb_sliding_solve_once(const SbSlidingTask *task, const SbSlidingLaw *law, SbSealState *out,
                               SbReport *report);

// Calls sb_sliding_sum() if the task can be linearised, then sb_sliding_solve_once() with `law`.
SbStatus sb_sliding_solve_with(const SbSlidingTask *task, const SbSlidingLaw *law, SbSealState *out,
                               SbReport *report);

// Sets net_error from load_error and width_error, for the fit of the state.
void sb_sliding_net_error(SbSealState *out, const SbSlidingTask *task, const SbFit *fit);

// Computes again, without warnings, the errors that follow from load_error, width_error and
// peak_error of a state that sb_sliding_solve_with() has computed and the caller has changed: those
// of net load, film, asperities, and friction. The task's memory must hold fit and film of the
// state.
SbStatus sb_sliding_update_errors(SbSealState *out, const SbSlidingTask *task, SbReport *report);

// Computes the values at rest of a sliding state with coupled asperities, for which they were
// omitted (rest_waits).
SbStatus sb_sliding_rest(const SbSlidingTask *task, SbSealState *out, SbReport *report);

// ---- The film (sliding_film.c)

// Returns whether a task has a film: speed is not 0, and there is liquid at the inlet.
bool sb_sliding_has_film(const SbSlidingTask *task);

// Computes the film of a state whose contact and loads are set, without coupled asperities.
SbStatus sb_sliding_solve_film(const SbSlidingTask *task, SbSealState *out, SbReport *report);

// Computes the film with asperities in it under a net load [N/m] at a speed [m/s] (0: dry contact),
// on the fitted body, or on the half-plane if that fails. `out` is plane, fitted or rest of the
// task's memory.
SbStatus sb_sliding_solve_rough(const SbSlidingTask *task, SbSlidingSolved *out, double load_net,
                                double speed, SbReport *report);

// Sets film_fitted, film_min, film_central, layer, and the errors of both films in *out from
// `solved`, whose solver returned `status`. Returns false, and changes nothing, if the solver has
// no solution.
bool sb_sliding_read_film(SbSealState *out, const SbSlidingSolved *solved, SbStatus status,
                          const SbFit *fit);

// Returns the relative error of a solved film that the errors of the surface cause on which it was
// solved: those of the fit's peak and width, or of the net load on the half-plane.
double sb_sliding_surface_error(const SbSealState *state, const SbSlidingSolved *solved,
                                const SbFit *fit);

// Sets film_error and central_error of a solved film from the errors of its solver and its surface.
void sb_sliding_film_errors(SbSealState *out, const SbSlidingSolved *solved, const SbFit *fit);

// Sets film_error and central_error of a film by a law from net_error; NaN if the load is exact.
void sb_sliding_law_errors(SbSealState *out);

// For a film by a law: sets `layer` to half of film_central (thesis eq. 5.20), but at most the
// supply's layer, and reduces film_min and film_central accordingly.
void sb_sliding_limit_law(SbSealState *out, const SbSlidingTask *task);

// Sets boundary_error, viscous_error and friction_error from the errors of real area, width, load
// and film. `borne`: relative error of the asperities' fraction of the load, 0 if they carry all of
// it.
void sb_sliding_kinetic_errors(SbSealState *out, double borne);

// Solves `problem` into *out, which is plane, fitted or rest of the task's memory: from
// memory->sum, on the mesh of memory->base, or on a mesh of its own.
SbStatus sb_sliding_solve_on(const SbSlidingTask *task, SbSlidingSolved *out,
                             const SbFilmProblem *problem, SbReport *report);

// Multiplies real area, friction and their errors of a dragged ring by the fractions that its
// section carries, borne_share and area_cut, which must be set. Computes static friction again.
// Does nothing if borne_share is NaN.
SbStatus sb_sliding_share_out(SbSealState *out, const SbSlidingTask *task, SbReport *report);

// Computes the state of a task with sb_sliding_drags(): ring and film in turns, until the friction
// that drags the ring is that of its own film.
SbStatus sb_sliding_drag(const SbSlidingTask *task, SbSealState *out, SbReport *report);

// ---- Steps of several rows

// Sets squeeze_out_time and friction_static (NaN after an error) after the dwell before the first
// stroke, of a state whose values at rest are set.
SbStatus sb_sliding_set_static(SbSealState *out, const SbSlidingTask *task, SbReport *report);

// Sets static_error from the errors of real area at rest, width and load.
void sb_sliding_set_static_error(SbSealState *out);

// Warns, if the surface is Persson's and friction.shear_strength is the default of the set thesis,
// that this default was determined with another model of the surface, which has a smaller real area
// than `share`.
void sb_sliding_warn_strength(const SbSlidingTask *task, double share);

// Handles the `status` of a film, with its report `own`. A film that cannot exist because the fluid
// opens the contact is a result: sets out->opened, warns and returns SB_OK. Otherwise returns
// `status`, after an error with *report = *own.
SbStatus sb_sliding_opened_by_fluid(SbSealState *out, SbStatus status, const SbReport *own,
                                    int seal, SbWarnings *warnings, SbReport *report);

// Returns "on the in-stroke" or "on the return", by the task's speed; static.
const char *sb_sliding_stroke(const SbSlidingTask *task);

// ---- Functions of rows (contact_law.h). sb_ring_...: both rows of rings; sb_separate_...
// (sliding_separate.c) and sb_coupled_... (sliding_coupled.c): one of them; sb_edge_...: gaskets
// (sliding_gasket.c).
//   solve          film, rough contact and friction of a state whose contact and loads are set
//   rest           the values at rest that solve() has omitted
//   take           asperities' results and kinetic friction from a film with asperities in it
//   respeed        replaces film and kinetic friction of a state by those at task->speed
//   refilm         lambda, real area and kinetic friction from film_central
//   resurface      as refilm, with the values at rest and static friction
//   update_errors  errors of film, asperities and friction from those of the contact
//   warn_limit     warns that a section which rolls or jams carries less than its friction
//   dry_gap        gap [m] next to a dry contact, at `over` times `half` from its middle

// SbContactLaw.respeed.
SbStatus sb_ring_respeed(SbSealState *state, const SbSlidingTask *task, const SbSlidingBody *body,
                         SbReport *report);

// SbContactLaw.warn_limit.
void sb_ring_warn_limit(SbWarnings *warnings, const SbSlidingTask *task, const SbSealState *state);

// SbContactLaw.dry_gap.
double sb_ring_dry_gap(const SbModel *model, int seal, double over, double half);

// SbContactLaw.solve.
SbStatus sb_separate_solve(SbSealState *out, const SbSlidingTask *task, SbReport *report);

// SbContactLaw.update_errors.
SbStatus sb_separate_update_errors(SbSealState *out, const SbSlidingTask *task, SbReport *report);

// SbContactLaw.refilm. Computes lambda, real area and kinetic friction of a state whose load, width
// and film are set, for a surface `roughness` times as rough as the model's.
SbStatus sb_sliding_rub(SbSealState *out, const SbSlidingTask *task, double roughness,
                        SbReport *report);

// SbContactLaw.resurface. Does the same as sb_sliding_rub(), and computes the values at rest and
// static friction.
SbStatus sb_sliding_rough_contact(SbSealState *out, const SbSlidingTask *task, double roughness,
                                  SbReport *report);

// SbContactLaw.solve.
SbStatus sb_coupled_solve(SbSealState *out, const SbSlidingTask *task, SbReport *report);

// SbContactLaw.rest.
SbStatus sb_coupled_rest(SbSealState *out, const SbSlidingTask *task, SbReport *report);

// SbContactLaw.take.
void sb_coupled_take(SbSealState *out, const SbModel *model, const SbFilm *film, bool fitted);

// SbContactLaw.refilm; `roughness` must be 1.
SbStatus sb_coupled_refilm(SbSealState *state, const SbSlidingTask *task, double roughness,
                           SbReport *report);

// SbContactLaw.update_errors.
SbStatus sb_coupled_update_errors(SbSealState *out, const SbSlidingTask *task, SbReport *report);

// SbContactLaw.detached_scatter, of the friction at which a gasket detaches: its path ends at 0.50
// to 0.66 of the pressure, depending on the mesh (the default gasket with a shear strength of 5.85
// MPa).
#define SB_EDGE_DETACHED_SCATTER 0.25

// SbContactLaw.solve.
SbStatus sb_edge_solve(SbSealState *out, const SbSlidingTask *task, SbReport *report);

// SbContactLaw.respeed.
SbStatus sb_edge_respeed(SbSealState *state, const SbSlidingTask *task, const SbSlidingBody *body,
                         SbReport *report);

// SbContactLaw.refilm. Computes real area, kinetic friction and the dry contact (without static
// friction) under the state's film.
SbStatus sb_edge_contact(SbSealState *out, const SbSlidingTask *task, double roughness,
                         SbReport *report);

// SbContactLaw.resurface.
SbStatus sb_edge_resurface(SbSealState *state, const SbSlidingTask *task, double roughness,
                           SbReport *report);

// SbContactLaw.update_errors.
SbStatus sb_edge_update_errors(SbSealState *out, const SbSlidingTask *task, SbReport *report);

// SbContactLaw.warn_limit.
void sb_edge_warn_limit(SbWarnings *warnings, const SbSlidingTask *task, const SbSealState *state);

// SbContactLaw.dry_gap.
double sb_edge_dry_gap(const SbModel *model, int seal, double over, double half);
