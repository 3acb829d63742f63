// A seal's steady state at one pressure and one sliding speed: fit, film, rough contact and the
// friction that follows, by the models that the scene chooses.
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
// The fluid at the inlet is liquid without limit, or (models.inlet = carried) what the stroke
// before left on the bore, or nothing. With nothing there is no film, and the state is that at rest
// without the static ratio.
//
// Values that were not computed are NaN: all of a fit that failed; the film and what follows from
// it if the film failed, if the fluid alone carries the seal, or without contact. Without contact
// width, load and friction are 0.
#pragma once

#include "engine/contact/fit.h"
#include "engine/film/film.h"
#include "engine/valve/figures/summary.h"
#include "engine/valve/model/model.h"
#include "engine/valve/states/perturbed.h"

// Friction of a state as a local law: the shear stress that the bore exerts on a ring at a contact
// pressure p [Pa],
//   tau(p) = m p + min(tau_0 A_a/A + F_v/A, p).
// The second part is at most p. With coupled asperities m is multiplied by the asperities' share of
// the load.
typedef struct {
  double coefficient; // m [1]
  double shear;       // tau_0 A_a/A + F_v/A [Pa]
} SbSlidingLaw;

// Computes the law of a state.
void sb_sliding_law(SbSlidingLaw *out, const SbModel *model, const SbSealState *state);

// Returns tau(p) [Pa] of the SbSlidingLaw `law`, and writes d tau/dp to *slope; SbFitProblem.shear.
double sb_sliding_shear(double pressure, double *slope, const void *law);

// Largest magnitude of the exponent of the load in a film law (thesis eq. 7.5: -0.2893, eq. 7.6:
// -0.21; asymptotic: -0.2).
#define SB_FILM_LAW_LOAD_POWER 0.3

// Returns the kinetic friction of a whole contact, all of it on the land [N].
double sb_sliding_friction(const SbSealState *state);

// Work memory of one seal's evaluations, with its last solutions. Used by one thread at a time.
typedef struct SbSlidingMemory SbSlidingMemory;

// Creates a memory without solutions.
SbStatus sb_sliding_memory_create(SbSlidingMemory **out, SbReport *report);

// Frees the memory. Takes NULL.
void sb_sliding_memory_destroy(SbSlidingMemory *memory);

// Discards the last solutions, so that later results do not depend on them. Required when anything
// but pressure and speed has changed. Stored rings (below) remain.
void sb_sliding_memory_forget(SbSlidingMemory *memory);

// Stores the states of rings solved from now on, in addition to those stored before, so that others
// can start from them.
void sb_sliding_memory_keep(SbSlidingMemory *memory);

// Stores the rings of the last evaluations too, and ends storing. The memory must not evaluate any
// task afterwards.
void sb_sliding_memory_end(SbSlidingMemory *memory);

// Computes what the first tasks that start from the stored rings would wait for, until `stop` (not
// NULL; called with `data`) returns true. Any thread, also while others start from them.
void sb_sliding_memory_prepare(const SbSlidingMemory *memory, bool (*stop)(void *), void *data);

// Lets rings start from the stored states of `from`, borrowed: those of the same direction whose
// ratio of pressure difference to modulus is nearest. NULL: cold start. Results then depend on that
// memory and the task only. `tangent`: rings are not solved but linearised about the stored state
// (sb_ring_tangent_at()), with the friction that follows; all else is solved.
// SB_ERROR_NOT_CONVERGED of a task that has no stored state then. If profiles are not `drawn`,
// films near the first requested state are linearised too (sliding_beside.c).
void sb_sliding_memory_start(SbSlidingMemory *memory, const SbSlidingMemory *from, bool tangent,
                             bool drawn);

// Sets how rings are evaluated that are linearised and not drawn; see sb_run_rings_beside().
void sb_sliding_memory_beside(SbSlidingMemory *memory, SbRingsBeside how);

// Sets a function that is polled while a fit or film is solved, with `data`; true ends the solver
// with SB_ERROR_CANCELLED. NULL: none.
void sb_sliding_memory_poll(SbSlidingMemory *memory, bool (*cancelled)(void *), void *data);

// Returns the fit of the last evaluation; borrowed, overwritten by the next one.
const SbFit *sb_sliding_fit(const SbSlidingMemory *memory);

// Returns the ring of the last evaluation, NULL for other fit models; borrowed as above.
const SbRing *sb_sliding_ring(const SbSlidingMemory *memory);

// Returns the film of the last evaluation; borrowed as above.
const SbFilm *sb_sliding_film(const SbSlidingMemory *memory);

// Returns the speed at which that film was solved divided by the task's: below 1 if the supply
// alone determines the film.
double sb_sliding_film_share(const SbSlidingMemory *memory);

// Surface of a fitted body for films on it.
typedef struct {
  double load; // net load that belongs to it [N/m]
  SbSurfaceCompliance compliance;
} SbSlidingBody;

// Returns the body on which the film of the last evaluation was solved; NULL: on the half-plane.
// Borrowed as above.
const SbSlidingBody *sb_sliding_body(const SbSlidingMemory *memory);

// Initialises a state as not computed: its figures are NaN.
void sb_sliding_clear(SbSealState *out);

// Fluid on the bore in front of the inlet. {0}: liquid without limit.
typedef struct {
  bool limited;
  double layer; // if limited: thickness on the bore, flow per length divided by speed [m]
} SbSupply;

// One evaluation. All pointers are borrowed during the call.
typedef struct {
  const SbModel *model;
  int seal; // SB_OUTER, SB_INNER
  SbSealPressure pressure;
  double speed; // of sliding [m/s]; > 0: the bore moves to +x (in-stroke); 0: at rest
  SbSlidingMemory *memory;
  SbCounters *counts;   // solves are added
  SbWarnings *warnings; // warnings are added; NULL: none
  SbSupply supply;
} SbSlidingTask;

// Returns the ring solved for the task's seal, pressure difference and direction, borrowed; NULL if
// the memory has none.
const SbRing *sb_sliding_ring_of(const SbSlidingTask *task);

// Evaluates a task. The fit of the last call is reused if the pressure is the same.
//
// A sliding ring (SB_FIT_RING) is dragged by its own friction: ring and film are solved in turns
// until they agree, from the ring of another speed if one is known, else cold. So a state depends
// on earlier ones by at most half the model's tolerance of its friction. A ring that rolls or jams
// is a result (`section`, with a warning); its figures are those at the greatest drag. At rest a
// ring is fitted and pressed without drag. A seal without contact has touches = false.
//
// SB_ERROR_NOT_CONVERGED: what was computed is set, all else is NaN; the report names solver and
// cause.
SbStatus sb_sliding_solve(SbSealState *out, const SbSlidingTask *task, SbReport *report);

// Solves the first ring of a task into the task's memory, which must be new, as sb_sliding_solve()
// would with the memory `like`. Does nothing if that ring depends on earlier solutions. Errors are
// not reported: the ring is then missing.
void sb_sliding_solve_ahead(const SbSlidingTask *task, const SbSlidingMemory *like);

// Lets `memory` take rings from `ahead` (borrowed; filled by sb_sliding_solve_ahead()) when it
// needs them; NULL: none.
void sb_sliding_memory_ahead(SbSlidingMemory *memory, SbSlidingMemory *ahead);

// Computes the fit only: contact, loads and peak, as sb_sliding_solve() computes them except for a
// sliding ring. All else is NaN, or 0 without contact.
SbStatus sb_sliding_fitment(SbSealState *out, const SbSlidingTask *task, SbReport *report);

// Computes the surface of a fitted body for films: compliance (of a ring by static condensation,
// ring.h; else of a disc) and the gap whose dry contact has the pressure of `fit`. If a ring's
// cannot be used the disc's replaces it, with the warning "film-disc-surface". Writes the net load
// that belongs to it to *load [N/m]. `warnings` may be NULL. SB_ERROR_INPUT: other fit models, or a
// contact that is too wide.
SbStatus sb_sliding_surface(SbSurfaceCompliance *out, double *load, const SbFit *fit,
                            const SbModel *model, int seal, SbSealPressure pressure,
                            SbWarnings *warnings, SbReport *report);

// Computes film and kinetic friction of a solved state for the speed of the task, on the `body` of
// the state's film (NULL: half-plane). The relative errors of the film are not changed, and
// warnings about it are not given. SB_ERROR_NOT_CONVERGED: no film.
SbStatus sb_sliding_respeed(SbSealState *state, const SbSlidingTask *task,
                            const SbSlidingBody *body, SbReport *report);

// Sets the film problem of `state` at the task's speed, on `body` (NULL: half-plane).
void sb_sliding_film_of(SbFilmProblem *out, const SbSealState *state, const SbSlidingTask *task,
                        const SbSlidingBody *body);

// Replaces the film of a task's state, and updates what follows from it as sb_sliding_refilm()
// does. `fitted`: `film` was solved on the fitted body.
void sb_sliding_take(SbSealState *state, const SbSlidingTask *task, const SbFilm *film, bool fitted,
                     double roughness);

// Returns the speed [m/s] above which the supply alone determines the film of a state: higher
// speeds have the film at this speed, and viscous friction in proportion to speed. INFINITY without
// a limited supply.
double sb_sliding_starved_speed(const SbSealState *state, const SbSlidingTask *task,
                                const SbSlidingBody *body);

// Divides real area share, boundary_load and friction_viscous of a rolling, jamming or
// pressure-limited section by the fractions that the section carries. The results are those of a
// section that carries all of its friction.
void sb_sliding_whole(SbSealState *state);

// Computes what follows from the films in a task's state for a surface `roughness` times as rough
// as the model's: lambda, real area, kinetic friction. With coupled asperities `roughness` must be
// 1, and the values that sb_sliding_whole() gives must be set with the films.
SbStatus sb_sliding_refilm(SbSealState *state, const SbSlidingTask *task, double roughness,
                           SbReport *report);

// Changes the surface of a task's solved state to one `roughness` times as rough as the model's.
// Solves nothing, because fit and film do not depend on it.
SbStatus sb_sliding_resurface(SbSealState *state, const SbSlidingTask *task, double roughness,
                              SbReport *report);

// Computes out[count] [Pa]: the part of the pressures p[count] (above the fluid's) that asperities
// under a gasket carry where its film is at least `film` [m] thick (sliding_gasket.c).
SbStatus sb_sliding_edge_asperities(double *out, const double *p, size_t count,
                                    const SbModel *model, int seal, double film, SbReport *report);

// Sets the film problem of a seal: net load, reduced modulus, radius, pressures (thesis sections
// 5.2 and 7.1; the entrainment speed is half the sliding speed). `model` of the problem is the
// default of sb_film_problem_init().
void sb_sliding_film_problem(SbFilmProblem *out, const SbModel *model, int seal,
                             SbSealPressure pressure, double load_net, double speed);
