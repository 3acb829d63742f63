// Shared by the parts of a steady sliding state. Private to sliding*.c. "Way" is an index of
// SB_RUN_MOTIONS: SB_CYCLE_IN and SB_CYCLE_OUT if friction drags the seal, else at rest.
#pragma once

#include "engine/valve/states/sliding.h"

// A solved film, with its profile.
typedef struct {
  SbFilm film;
  SbFilmProfile profile;
  bool fitted;        // on the fitted body, not on the half-plane
  double speed;       // [m/s]
  double share;       // fraction of that speed at which it was solved
  bool fresh;         // solved since this flag was last cleared
  SbFilmSolver **own; // borrowed: its own solver; NULL: the memory's
  bool beside;        // solve it next to the solution of `own` if possible
} SbSlidingSolved;

// A fit, with its ring, in one way of sliding.
typedef struct {
  SbFit fit;
  SbRing *ring; // owned; NULL for other models
  bool known;
  SbReport why;    // status SB_ERROR_NOT_CONVERGED: there is no fit without friction
  double pressure; // pressure difference of the fit [Pa]
  double modulus;  // of its rubber [Pa]
  int seal;
  SbSlidingLaw law; // of the friction that drags it
  double jump; // relative difference between its film's friction and that law's, if they cannot
               // agree; else 0
  SbSlidingLaw found; // law of the film on the dragged ring
  SbSlidingLaw guess; // law of the closed forms
} SbSlidingFitment;

// Number of films of a state: on the half-plane, on the fitted body, at rest.
enum { SB_SLIDING_FILMS = 3 }; // on the half-plane, on the fitted body, at rest

// Results of the solvers for a state (sliding_beside.c).
typedef struct {
  SbFit fit;
  SbSlidingBody body;
  struct {
    bool solved, fitted;
    double share;
    SbFilm film; // without its profile
  } on[SB_SLIDING_FILMS];
} SbSlidingSolution;

// Linearised states near that of a stored ring. Several threads may use it at the same time.
typedef struct SbSlidingBeside SbSlidingBeside;

// Returns an object without states; NULL: no memory.
SbSlidingBeside *sb_sliding_beside_create(void);

// Frees the object. Takes NULL.
void sb_sliding_beside_destroy(SbSlidingBeside *beside);

// Which part of a state is linearised, not solved: nothing, the fit, or fit and films.
typedef enum { SB_SUM_NOTHING, SB_SUM_FITMENT, SB_SUM_ALL } SbSumDepth;

// State of a ring that others start from (SbSlidingMemory.kept).
typedef struct {
  SbFitStart start;
  SbRing *ring;            // owned; the ring of `start`
  SbRingGuide *guide;      // owned; of the ring
  SbRingTangent *tangent;  // owned; of the ring
  SbSlidingBeside *beside; // owned; states near it
  int way;                 // index of SbSlidingMemory.fitment
  double strain;           // pressure difference divided by modulus
  SbSlidingLaw law, found; // that drags it; of its film
  SbSlidingLaw guess;      // of the closed forms
} SbSlidingStart;

// A solved film, next to which others may be solved.
typedef struct {
  bool known, fitted;
  double inlet, outlet; // pressures [Pa]
  double speed, load;   // [m/s], >= 0; [N/m]
} SbSlidingBase;

// Capacity of stored states; a run has at most three chamber states in each way.
enum { SB_SLIDING_STARTS = 64 }; // of a run at most three chamber states each way

// The memory of sliding.h.
struct SbSlidingMemory {
  bool keeps; // solved states are stored for others
  SbSlidingStart kept[SB_SLIDING_STARTS];
  int kept_count;
  const struct SbSlidingMemory *from; // rings start from its states, borrowed; NULL: cold
  bool tangent;                       // rings are linearised about these states
  bool summed;                        // films too
  SbRingsBeside beside;               // how these rings are evaluated
  bool bare;                          // surfaces of rings are not needed
  SbSumDepth sums;                    // linearised part of the present state
  SbSlidingSolution sum;              // its values
  SbSlidingMemory *ahead;             // may have the next ring, borrowed
  SbSlidingBeside *lender;            // owner of the solvers that its films use; NULL: none

  SbSlidingFitment fitment[SB_RUN_MOTIONS]; // by way
  SbSlidingFitment *now;                    // of the last evaluation
  SbSlidingSolved plane, fitted;            // on the half-plane (or of a law); on the fitted body
  SbSlidingSolved rest;                     // dry rough contact, coupled asperities only
  const SbSlidingSolved *last;              // result of the last evaluation, one of these
  bool rested;                              // `rest` is valid, for
  double rest_left;                         // this pressure on the left [Pa]
  const SbSlidingFitment *rest_on;          // and this fit
  SbSlidingBody body;                       // of the last film on one
  SbFilmSolver *solver;                     // NULL until a film is solved (laws need none)
  SbFilmSolver *rest_solver;                // of `rest`, apart from a sliding film's solution
  SbRoughLaw law;                           // of the surface; count 0: not yet needed
  SbSlidingBase base;                       // film that `solver` last solved without another
  bool near;                                // films near that one may be solved next to it
  bool rest_waits;                          // values at rest of a sliding state are left out
  SbWarnings warnings;                      // of one round of a ring's friction
  bool (*cancelled)(void *);                // NULL: never
  void *cancelled_data;
};

// Moves the solved ring of a way to the stored ones, if the memory stores rings and there is one.
void sb_sliding_keep(SbSlidingMemory *memory, int way);

// Returns whether friction drags this seal's section: that of a ring while it slides.
bool sb_sliding_drags(const SbSlidingTask *task);

// Returns the law of a task's surface with coupled asperities, computed once for all films of the
// seal; borrowed. NULL if there is none.
const SbRoughLaw *sb_sliding_rough_law(const SbSlidingTask *task);

// Returns whether a solver's figures count: SB_OK, or SB_ERROR_NOT_CONVERGED (its last solution,
// with its error).
bool sb_sliding_usable(SbStatus status);

// Computes contact and loads of a task, of a ring dragged by `law` (NULL: as it is known). *known:
// there is a contact.
SbStatus sb_sliding_fit_contact(const SbSlidingTask *task, const SbSlidingLaw *law,
                                SbSealState *out, bool *known, SbReport *report);

// Finds which part of a task is linearised about a stored state, and its values: memory->sums and
// memory->sum. SB_ERROR_CANCELLED, SB_ERROR_MEMORY.
SbStatus sb_sliding_sum(const SbSlidingTask *task, const SbSlidingLaw *law,
                        SbSlidingBeside *beside);

// Ends the use of these values, after the state.
void sb_sliding_sum_end(SbSlidingMemory *memory);

// Returns whether a film, on the fitted body or not, is linearised.
bool sb_sliding_film_summed(const SbSlidingMemory *memory, const SbSlidingSolved *which,
                            bool fitted);

// Copies a linearised film.
void sb_sliding_take_film(SbSlidingSolved *out, SbSlidingMemory *memory);

// Returns the stored state that a task's ring starts from; NULL: none.
const SbSlidingStart *sb_sliding_start_of(const SbSlidingTask *task);

// Discards the fit of the task's way.
void sb_sliding_forget_fitment(const SbSlidingTask *task);

// Computes fit, film and friction of a task whose linearised part is set; a ring is dragged by
// `law` (NULL: as it is known).
SbStatus sb_sliding_solve_once(const SbSlidingTask *task, const SbSlidingLaw *law, SbSealState *out,
                               SbReport *report);

// Does the same for any task, including the linearised part.
SbStatus sb_sliding_solve_with(const SbSlidingTask *task, const SbSlidingLaw *law, SbSealState *out,
                               SbReport *report);

// Computes the values at rest of a coupled state for which they were left out (rest_waits).
SbStatus sb_sliding_rest(const SbSlidingTask *task, SbSealState *out, SbReport *report);

// ---- The film (sliding_film.c)

// Returns whether a task has a film: speed is not 0, and there is liquid at the inlet.
bool sb_sliding_has_film(const SbSlidingTask *task);

// Computes the film of a state whose contact is known, without asperities in it.
SbStatus sb_sliding_solve_film(const SbSlidingTask *task, SbSealState *out, SbReport *report);

// Computes the film with asperities in it under a net load [N/m] at a speed [m/s] (0: dry contact),
// on the fitted body, or on the half-plane if that fails.
SbStatus sb_sliding_solve_rough(const SbSlidingTask *task, SbSlidingSolved *out, double load_net,
                                double speed, SbReport *report);

// Sets the film figures of a state from a solved film on a fit. Returns false, and leaves them NaN,
// if the solver stopped before its first solution.
bool sb_sliding_read_film(SbSealState *out, const SbSlidingSolved *solved, SbStatus status,
                          const SbFit *fit);

// Sets the layer of a film law to half the film (thesis eq. 5.20), at most the supply's, and limits
// the film accordingly.
void sb_sliding_limit_law(SbSealState *out, const SbSlidingTask *task);

// Sets the errors of a film by a law, from the error of the load; NaN if the load is exact.
void sb_sliding_law_error(SbSealState *out);

// Sets static_error: the parts of the dry contact by the errors of real area, width and load.
void sb_sliding_static_error(SbSealState *out);

// Sets the errors of kinetic friction: its parts by the errors of real area, width, load and film.
// `borne`: relative error of the asperities' share of the load, 0 if they carry all of it.
void sb_sliding_kinetic_errors(SbSealState *out, double borne);

// Solves a film problem into *out: by linearisation, next to an earlier film, or alone.
SbStatus sb_sliding_solve_on(const SbSlidingTask *task, SbSlidingSolved *out,
                             const SbFilmProblem *problem, SbReport *report);

// Computes real area and friction (kinetic and static) of a contact whose load, width and film are
// known.
SbStatus sb_sliding_rough_contact(SbSealState *out, const SbSlidingTask *task, double roughness,
                                  SbReport *report);

// Reduces the friction of a law to what the section bears, by borne_share and area_cut.
SbStatus sb_sliding_share_out(SbSealState *out, const SbSlidingTask *task, SbReport *report);

// Computes the state of a sliding ring: ring and film in turns, until the friction that drags the
// ring is that of its own film.
SbStatus sb_sliding_drag(const SbSlidingTask *task, SbSealState *out, SbReport *report);

// ---- A gasket (sliding_gasket.c)

// Sets the pressures of a state from its fit.
void sb_sliding_take_edges(SbSealState *out, const SbFit *fit);

// Computes the film of a gasket's state with known pressures, at the task's speed.
void sb_sliding_edge_film(SbSealState *out, const SbSlidingTask *task);

// Computes real area, kinetic friction and the dry contact (without static friction) of a gasket's
// state under its film, for a surface `roughness` times as rough as the model's.
SbStatus sb_sliding_edge_contact(SbSealState *out, const SbSlidingTask *task, double roughness,
                                 SbReport *report);
