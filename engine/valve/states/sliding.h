// A seal's steady state at one pressure and one sliding speed: fit, film, rough contact and the
// friction that follows, by the models that the scene chooses.
//
// Use: create an SbSlidingMemory for each seal, fill an SbSlidingTask, call sb_sliding_solve().
// Call sb_sliding_memory_forget() before a task of another model.
//
//   boundary  F_b = tau_0 A_a + m W    thesis eq. 5.14; m acts on the whole load W
//             F_b = tau_0 A_a          models.friction = shear, tau_0(p) = tau_0
//   viscous   F_v = tau (A - A_a)      thesis eq. 5.15 and 5.16, tau = min(eta |u|/h, tau_0)
//   static    F_s after a dwell        breakaway.h
//
// A is the contact width times the circumference pi D of the bore, for every fit model. The real
// area A_a = A (real area share) follows from Greenwood and Tripp at lambda = h_central/sigma, or
// from Persson. tau_0 is both the boundary shear strength and the Eyring limit.
//
// models.asperities = coupled: the film is solved together with the asperities (film/ehl.h). Then
// A_a is its real area (a mean over the solved contact, times A), m acts on the asperities' load
// only, F_v follows from the open part of the gap, and at rest the dry rough contact applies, with
// m W of the whole net load.
//
// The supply at the inlet is flooded (unlimited liquid), or with models.inlet = carried starved
// (the layer that the previous stroke left on the bore) or dry (layer 0). If it is dry there is no
// film, and kinetic friction is that of the dry contact.
//
// Values that were not computed are NaN: all values if the fit failed; film and all that depends on
// it if the film failed, if the fluid alone carries the load, or without contact. Without contact
// contact width, load and friction are 0.
#pragma once

#include "engine/contact/fit.h"
#include "engine/film/film.h"
#include "engine/valve/figures/summary.h"
#include "engine/valve/model/model.h"
#include "engine/valve/states/perturbed.h"

// Friction of a state as a local law: the magnitude of the shear stress that the bore exerts on a
// ring at a contact pressure p [Pa],
//   tau(p) = m p + min(tau_0 A_a/A + F_v/A, p)
// With coupled asperities m is multiplied by the asperities' fraction of the load.
typedef struct {
  double coefficient; // m [1]
  double shear;       // tau_0 A_a/A + F_v/A [Pa]
} SbSlidingLaw;

// Computes the law of a solved state.
void sb_sliding_law(SbSlidingLaw *out, const SbModel *model, const SbSealState *state);

// Returns tau(p) [Pa] of the SbSlidingLaw `law` at p = `pressure`, and writes d tau/dp to *slope.
// It is a callback for SbFitProblem.shear.
double sb_sliding_shear(double pressure, double *slope, const void *law);

// Largest magnitude of the exponent of the load in a film law (thesis eq. 7.5: -0.2893, eq. 7.6:
// -0.21; asymptotic: -0.2).
#define SB_FILM_LAW_LOAD_POWER 0.3

// Returns the kinetic friction that a solved state has with its full contact on the land, a
// magnitude [N]; the run multiplies it by the part of the contact that is on the land.
double sb_sliding_friction(const SbSealState *state);

// Work memory of one seal's evaluations, with its last solutions. Used by one thread at a time.
typedef struct SbSlidingMemory SbSlidingMemory;

// Creates a memory without solutions.
SbStatus sb_sliding_memory_create(SbSlidingMemory **out, SbReport *report);

// Frees the memory.
void sb_sliding_memory_destroy(SbSlidingMemory *memory);

// Discards the last solutions, so that later results do not depend on them. Required before a task
// in which anything but pressure, speed and supply has changed. Stored rings (below) remain.
void sb_sliding_memory_forget(SbSlidingMemory *memory);

// Starts storing: from now on the memory stores the states of the rings that it solves, in addition
// to those stored before. After sb_sliding_memory_end() other memories can start from them.
void sb_sliding_memory_store(SbSlidingMemory *memory);

// Stores the last solved ring of each direction too, and ends storing. The memory must not evaluate
// tasks afterwards until sb_sliding_memory_forget(); it may be the `from` of other memories, in any
// number of threads.
void sb_sliding_memory_end(SbSlidingMemory *memory);

// Computes in advance what the first tasks that start from the stored rings need. Returns early if
// `stop` (not NULL; called with `data`) returns true. Any thread, also while others start from
// them.
void sb_sliding_memory_prepare(const SbSlidingMemory *memory, bool (*stop)(void *), void *data);

// Lets rings of later tasks start from the stored states of `from` (borrowed): from the one with
// the same direction and the same sign of the pressure difference whose pressure difference divided
// by modulus is closest. NULL: cold start. The results depend on `from` and the task only. With
// `tangent` (and `from`) rings are not solved but linearised about the stored state
// (sb_ring_tangent_at()), together with the friction that drags them; all else is solved. A task
// without a stored state then fails with SB_ERROR_NOT_CONVERGED. `drawn`: profiles or sections are
// needed; if it is false, films near the first requested state are linearised too
// (sliding_beside.c).
void sb_sliding_memory_start(SbSlidingMemory *memory, const SbSlidingMemory *from, bool tangent,
                             bool drawn);

// Sets how rings are evaluated with `tangent`; SB_RINGS_FOLLOW by default.
void sb_sliding_memory_rings(SbSlidingMemory *memory, SbRingsBeside how);

// Sets a function that is polled while a fit or film is solved, with `data`; true ends the solver
// with SB_ERROR_CANCELLED. NULL: none.
void sb_sliding_memory_poll(SbSlidingMemory *memory, bool (*cancelled)(void *), void *data);

// The next four functions return what the last task evaluated with this memory has left.
// sb_sliding_solve() replaces all, sb_sliding_fitment() fit and ring, sb_sliding_respeed() the
// film.

// Returns the fit of the last evaluated task; borrowed, overwritten by the next task.
const SbFit *sb_sliding_fit(const SbSlidingMemory *memory);

// Returns the ring of the last task, NULL for other fit models; borrowed until the next task.
const SbRing *sb_sliding_ring(const SbSlidingMemory *memory);

// Returns the film of the last task, meaningful if the state's film_central > 0; borrowed until the
// next task.
const SbFilm *sb_sliding_film(const SbSlidingMemory *memory);

// Returns the speed at which the film of the last task was solved divided by the task's speed: 1,
// or below 1 if the supply alone determines the film.
double sb_sliding_film_share(const SbSlidingMemory *memory);

// Surface of a fitted disc or ring, on which films are solved; sb_sliding_surface() computes it.
typedef struct {
  double load; // net load under which the dry surface has the fit's pressure [N/m]
  SbSurfaceCompliance compliance; // deflection of the surface under pressure
} SbSlidingBody;

// Returns the body on which the film of the last task was solved; NULL: on the half-plane. Borrowed
// until the next task.
const SbSlidingBody *sb_sliding_body(const SbSlidingMemory *memory);

// Initialises a state as not computed: all its figures are NaN.
void sb_sliding_clear(SbSealState *out);

// Fluid on the bore in front of the inlet. {0}: liquid without limit.
typedef struct {
  bool limited;
  double layer; // if limited: thickness on the bore, flow per length divided by speed [m]
} SbSupply;

// One evaluation. All pointers are borrowed during the call.
typedef struct {
  const SbModel *model;
  int seal;                // SB_OUTER, SB_INNER
  SbSealPressure pressure; // on both sides of the seal
  // Sliding speed [m/s]; > 0: the surface under the seal moves to +x, which is the in-stroke of a
  // ring (sb_model_way()); 0: at rest.
  double speed;
  SbSlidingMemory *memory; // of this seal
  SbCounters *counts;      // solves are added; not NULL
  SbWarnings *warnings;    // warnings are added; NULL: not wanted
  SbSupply supply;         // {0}: flooded
} SbSlidingTask;

// Returns the ring that task->memory has solved for the task's seal, pressure difference and
// direction; NULL if there is none. Borrowed until the next task.
const SbRing *sb_sliding_ring_of(const SbSlidingTask *task);

// Evaluates a task. The fit of the last task in this direction is reused if the pressures are
// equal.
//
// The friction of a sliding ring (SB_FIT_RING) drags its section: ring and film are solved
// alternately until the friction agrees to half of output.tolerance, from the ring of the last task
// in this direction if the pressures are equal, else from a stored state or cold. So a state
// depends on earlier tasks within that tolerance. A ring that rolls or jams is a result (`section`,
// with a warning); its values are those at the largest drag that it carries. A seal without contact
// is a result, too: touches is false.
//
// SB_ERROR_NOT_CONVERGED: a solver failed; values computed before are set, all others are NaN, and
// the report names solver and cause. SB_ERROR_CANCELLED: the polled function returned true.
// SB_ERROR_RANGE, SB_ERROR_INPUT: a value is out of the range of the models of fit, film or
// surface; SB_ERROR_INFEASIBLE: fit or film has no solution. After any error other than
// SB_ERROR_NOT_CONVERGED *out is unspecified.
SbStatus sb_sliding_solve(SbSealState *out, const SbSlidingTask *task, SbReport *report);

// Prefetch: solves the ring that sb_sliding_solve() with the memory `like` would solve first for
// this task, and stores it in task->memory, which must be newly created. Does nothing if that ring
// would depend on earlier solutions of `like`. Errors are not reported; task->memory then has no
// ring. `like` is only read, so another thread may use it meanwhile if it does not change its
// start.
void sb_sliding_prefetch(const SbSlidingTask *task, const SbSlidingMemory *like);

// Lets the next task of `memory` take its first ring from `ahead` (borrowed until that task is
// evaluated), the task->memory of sb_sliding_prefetch(). NULL: it solves all rings itself.
void sb_sliding_memory_prefetched(SbSlidingMemory *memory, SbSlidingMemory *ahead);

// Computes the fit only: ends of the contact, loads and peak pressure. They equal those of
// sb_sliding_solve(), except for a sliding ring, which is computed without drag by friction. All
// other figures are NaN; friction is 0 without contact. Errors of sb_sliding_solve().
SbStatus sb_sliding_fitment(SbSealState *out, const SbSlidingTask *task, SbReport *report);

// Computes the surface of the fitted body `fit` (SB_FIT_DISC, SB_FIT_RING) for films: its
// compliance (of a ring by static condensation, ring.h) and the gap for which the dry contact has
// the pressure of `fit`. If the compliance of a ring cannot be used, that of a disc replaces it,
// with the warning "film-disc-surface". Writes the net load of this dry contact to *load [N/m].
// `pressure` is that of the fit. *out is plain data. SB_ERROR_INPUT, SB_ERROR_RANGE: other fit
// models, or a contact that is too wide; SB_ERROR_INPUT, SB_ERROR_INFEASIBLE,
// SB_ERROR_NOT_CONVERGED: no gap was found that has this dry contact.
SbStatus sb_sliding_surface(SbSurfaceCompliance *out, double *load, const SbFit *fit,
                            const SbModel *model, int seal, SbSealPressure pressure,
                            SbWarnings *warnings, SbReport *report);

// Replaces film and kinetic friction of *state, solved by sb_sliding_solve() for a task that
// differs in the magnitude of the speed only, by those at task->speed. `body` is sb_sliding_body()
// after that solve (NULL: half-plane). The relative errors of the film are not changed, and no
// warnings about it are added. SB_ERROR_NOT_CONVERGED: the film was not solved. Other errors as
// sb_sliding_solve(). *state is unspecified after an error.
SbStatus sb_sliding_respeed(SbSealState *state, const SbSlidingTask *task,
                            const SbSlidingBody *body, SbReport *report);

// Sets *out to the film problem of the solved `state` at task->speed, on `body` (NULL: half-plane),
// with asperities if they are coupled. It borrows from body and task->memory.
void sb_sliding_film_of(SbFilmProblem *out, const SbSealState *state, const SbSlidingTask *task,
                        const SbSlidingBody *body);

// Replaces the film of the solved `state` of `task` by `film`, and updates lambda, real area and
// kinetic friction by sb_sliding_refilm() with `roughness` (with coupled asperities 1; the values
// that sb_sliding_refilm() then requires are taken from `film`). `layer` and the errors of the film
// are not changed. `fitted`: the film was solved on the fitted body. If the friction of this film
// cannot be computed, lambda, real area and kinetic friction are NaN.
void sb_sliding_set_film(SbSealState *state, const SbSlidingTask *task, const SbFilm *film,
                         bool fitted, double roughness);

// Returns the speed [m/s], > 0, above which the supply alone determines the film of a solved state:
// at higher speeds the film is that at this speed, and viscous friction is proportional to the
// speed. INFINITY if the supply is not limited. `body` is that of the state's film (NULL:
// half-plane).
double sb_sliding_starved_speed(const SbSealState *state, const SbSlidingTask *task,
                                const SbSlidingBody *body);

// Converts real_area_share, boundary_load and friction_viscous of a state from the part that the
// section carries to the full friction, by dividing them by area_cut and borne_share. No effect
// where these are 1 or NaN.
void sb_sliding_full_friction(SbSealState *state);

// Computes lambda, real area and kinetic friction of a state from its film_central, which the
// caller has set, for a surface `roughness` times as rough as the model's. With coupled asperities
// `roughness` must be 1, and the caller sets real_area_share, boundary_load and friction_viscous
// too, in the full form that sb_sliding_full_friction() gives. Values at rest are not changed.
// SB_ERROR_RANGE: the model of the surface is not valid at this lambda or roughness. After an error
// lambda, real area and kinetic friction are NaN.
SbStatus sb_sliding_refilm(SbSealState *state, const SbSlidingTask *task, double roughness,
                           SbReport *report);

// Changes a solved state to a surface `roughness` times as rough as the model's: real area, kinetic
// and static friction. Solves nothing, because fit and film do not depend on roughness; not for
// coupled asperities, whose film does. memory and counts of the task may be NULL. Errors as
// sb_sliding_refilm(); the state is then unspecified. A state without contact is not changed.
SbStatus sb_sliding_resurface(SbSealState *state, const SbSlidingTask *task, double roughness,
                              SbReport *report);

// Returns the relative error of squeeze_out_time [1] of a state of the task's seal
// (sb_breakaway_squeeze_error()). Only model, seal and memory of the task are used. NaN if memory
// cannot be allocated.
double sb_sliding_squeeze_error(const SbSealState *state, const SbSlidingTask *task);

// Computes out[count] [Pa]: the part of the contact pressures p[count] [Pa] (above the fluid
// pressure) that asperities under a gasket carry, where the film is at least `film` [m] thick
// (sliding_gasket.c). `out` may be `p`.
SbStatus sb_sliding_edge_asperities(double *out, const double *p, size_t count,
                                    const SbModel *model, int seal, double film, SbReport *report);

// Sets *out to the film problem of a seal on the half-plane without asperities (thesis sections 5.2
// and 7.1): from the net load `load_net` [N/m], the sliding speed `speed` [m/s] (sign as
// SbSlidingTask; the entrainment speed is half of it), the pressures, and the model's reduced
// modulus, radius and fluid. out->model, the film model, is reynolds; the caller may change it.
void sb_sliding_film_problem(SbFilmProblem *out, const SbModel *model, int seal,
                             SbSealPressure pressure, double load_net, double speed);
