// A seal's steady sliding state: fitment, film, rough contact and the friction that follows, at one
// pressure and one sliding velocity, by the models that the scene chose.
//
//   boundary  F_b = tau_0 A_a + m W    thesis eq. 5.14, A_a = A (real share), m on the TOTAL load
//             F_b = tau_0 A_a          models.friction = shear; tau_0(p) = tau_0
//   viscous   F_v = tau (A - A_a)      thesis eq. 5.15 and 5.16, tau = min(eta |u|/h, tau_0)
//   static    F_s after a rest, breakaway.h        break-away, as the film goes
//
// With models.asperities = coupled the film is solved with the asperities in it (film/ehl.h), and
// what the solution says takes the place of these: A_a its real area (mean over the contact
// solved, on A), m on the asperities' load alone, the viscous part from the gap that is open, and
// at rest the dry rough contact, m W on the whole net load.
//
// What the inlet finds: liquid, as much as the contact takes; or on the bore, beside air, what the
// stroke before left there, and no more (models.inlet = carried); or nothing: then there is no film
// and the state is that at rest without the static ratio.
//
// A = contact width x pi D (bore), for every fitment model. The real share A_a/A comes from
// Greenwood and Tripp at lambda = h_central/sigma. tau_0 is both the boundary shear strength and
// the Eyring limit.
//
// What was not computed is NaN: all of a fitment that failed; the film and what follows from it
// where the film failed, where the fluid alone carries the seal, or where there is no contact.
// Without contact, width, load and friction are 0.
#pragma once

#include "engine/contact/fit.h"
#include "engine/film/film.h"
#include "engine/valve/model/model.h"
#include "engine/valve/run/run.h"

// The friction of a state as a local law of the bore's shear on a ring at a contact pressure:
//   tau(p) = m p + min(tau_0 A_a/A + F_v/A, p)
// No surface transmits more by its area than the pressure there. Coupled, m acts on the share of
// the pressure that asperities bear.
typedef struct {
  double coefficient; // m [1]
  double shear;       // [Pa]
} SbSlidingLaw;
void sb_sliding_law(SbSlidingLaw *out, const SbModel *model, const SbSealState *state);
double sb_sliding_shear(double pressure, double *slope, const void *law);

// A film is proportional to the load to the power of -0.3 at most (thesis eq. 7.5: -0.2893,
// eq. 7.6: -0.21; asymptotic: -0.2).
#define SB_FILM_LAW_LOAD_POWER 0.3

// Kinetic friction of a whole contact [N].
double sb_sliding_friction(const SbSealState *state);

// Workspaces that one seal's evaluations share; plain create and destroy (NULL allowed).
typedef struct SbSlidingMemory SbSlidingMemory;
SbStatus sb_sliding_memory_create(SbSlidingMemory **out, SbReport *report);
void sb_sliding_memory_destroy(SbSlidingMemory *memory);

// Forgets what was solved, because something else than pressure and speed has changed: what comes
// next does not depend on what came before. Keeps the memory.
void sb_sliding_memory_forget(SbSlidingMemory *memory);

// Keeps the rings' states that are solved from now on beside those kept before, for others to start
// from; those of the last
// evaluations with `sb_sliding_memory_end`, after which it must be asked nothing more.
void sb_sliding_memory_keep(SbSlidingMemory *memory);
void sb_sliding_memory_end(SbSlidingMemory *memory);

// Prepares what others that slide would first wait for, until `stop`.
void sb_sliding_memory_prepare(const SbSlidingMemory *memory, bool (*stop)(void *), void *data);

// Lets rings start from the kept state of `from`, borrowed, that slides alike at the pressure
// over modulus nearest to theirs; NULL: cold. What is solved then hangs on that memory and the task
// alone. `tangent`: rings are not solved but taken from there to first order in all that is changed
// (sb_ring_tangent_at()), with the friction that goes with them; what follows from them is solved.
// SB_ERROR_NOT_CONVERGED where there is no such state. Unless they are `drawn`, so are the films
// near the first state that was asked for beside the kept one (sliding_beside.c).
void sb_sliding_memory_start(SbSlidingMemory *memory, const SbSlidingMemory *from, bool tangent,
                             bool drawn);

// What rings beside a kept state do, not drawn: sb_run_rings_beside().
void sb_sliding_memory_beside(SbSlidingMemory *memory, SbRingsBeside how);

// Polled while a fitment or a film is solved; true ends it with SB_ERROR_CANCELLED. NULL: nobody.
void sb_sliding_memory_poll(SbSlidingMemory *memory, bool (*cancelled)(void *), void *data);

// What the last evaluation solved, for profiles; borrowed, overwritten by the next call.
const SbFit *sb_sliding_fit(const SbSlidingMemory *memory);
const SbRing *sb_sliding_ring(const SbSlidingMemory *memory); // NULL for other fitment models
const SbFilm *sb_sliding_film(const SbSlidingMemory *memory);

// Share of its speed at which that film was solved: less than 1 where the supply alone shapes it.
double sb_sliding_film_share(const SbSlidingMemory *memory);

// Surface of a fitted body for films on it.
typedef struct {
  double load; // net, that goes with it [N/m]
  SbSurfaceCompliance compliance;
} SbSlidingBody;

// That on which the last evaluation's film lies; NULL: on the half-plane. Borrowed like it.
const SbSlidingBody *sb_sliding_body(const SbSlidingMemory *memory);

// A state of which nothing is known: its figures are NaN.
void sb_sliding_clear(SbSealState *out);

// What the bore brings to the inlet; zero: liquid without limit.
typedef struct {
  bool limited;
  double layer; // where limited, what lies on the bore, flow over speed [m]
} SbSupply;

// One evaluation: what is asked for, with what memory, and where counts and warnings go.
typedef struct {
  const SbModel *model;
  int seal;
  SbSealPressure pressure;
  double speed; // of sliding; > 0: bore moves to +x, the in-stroke; 0: at rest [m/s]
  SbSlidingMemory *memory;
  SbCounters *counts;
  SbWarnings *warnings;
  SbSupply supply;
} SbSlidingTask;

// The ring of a task's way of sliding as it stands, borrowed; NULL where it is that of another.
const SbRing *sb_sliding_ring_of(const SbSlidingTask *task);

// Evaluates a task. The fitment is reused from the last call when the pressure has not changed. A
// ring (SB_FIT_RING) that slides is dragged by the friction found, of its direction: where it is
// known from another speed it goes on from there, else cold, so that a state hangs on what was
// solved before no more than by half the model's tolerance of its friction. One that rolls or jams
// before is a result, `section` and a warning tell; its figures are those of the greatest drag. At
// rest it is fitted and pressed without drag. A seal that does not touch has touches = false.
// SB_ERROR_NOT_CONVERGED with what was computed, the rest NaN; the report names solver and cause.
SbStatus sb_sliding_solve(SbSealState *out, const SbSlidingTask *task, SbReport *report);

// Solves the first ring of a task into its memory, which is of nothing else, as sb_sliding_solve()
// would with the memory `like`; nothing where that ring hangs on what is solved before it.
void sb_sliding_solve_ahead(const SbSlidingTask *task, const SbSlidingMemory *like);

// What was so solved, borrowed, is taken where it is asked for; NULL: nothing.
void sb_sliding_memory_ahead(SbSlidingMemory *memory, SbSlidingMemory *ahead);

// The fitment alone, as sb_sliding_solve() has it for all but a ring that slides: contact, loads
// and peak; the rest stays NaN, or 0 where the seal does not touch.
SbStatus sb_sliding_fitment(SbSealState *out, const SbSlidingTask *task, SbReport *report);

// Surface of a fitted body for the film: the ring's own by static condensation (ring.h), with its
// own modulus, or the disc's, and the gap whose dry contact has the pressure of `fit`. Where the
// ring has none the disc's compliance stands in for it, with the warning "film-disc-surface".
// *load is the net load that goes with it [N/m]. `warnings` may be NULL. SB_ERROR_INPUT for the
// other fitment models and where the contact is too wide.
SbStatus sb_sliding_surface(SbSurfaceCompliance *out, double *load, const SbFit *fit,
                            const SbModel *model, int seal, SbSealPressure pressure,
                            SbWarnings *warnings, SbReport *report);

// The solved state of a contact at the task's own speed: film and kinetic friction anew, on the
// `body` that the state's film lies on, NULL on the half-plane. Its errors stay, its film's
// warnings are not told. SB_ERROR_NOT_CONVERGED without a film.
SbStatus sb_sliding_respeed(SbSealState *state, const SbSlidingTask *task,
                            const SbSlidingBody *body, SbReport *report);

// The problem of a film at the task's speed under `state`, on `body` or, NULL, the half-plane.
void sb_sliding_film_of(SbFilmProblem *out, const SbSealState *state, const SbSlidingTask *task,
                        const SbSlidingBody *body);

// Gives a task's state another film, on the fitted body or not, and what follows from it.
void sb_sliding_take(SbSealState *state, const SbSlidingTask *task, const SbFilm *film, bool fitted,
                     double roughness);

// The speed [m/s] from which on nothing but the supply shapes the film of a state: higher ones have
// that film, and viscous friction in proportion to the speed; infinite without such a supply.
double sb_sliding_starved_speed(const SbSealState *state, const SbSlidingTask *task,
                                const SbSlidingBody *body);

// Gives a state the real area, boundary_load and friction_viscous of a section that bears all.
void sb_sliding_whole(SbSealState *state);

// What follows from the films in a task's state, with a surface `roughness` times as rough as the
// model's: lambda, real area, kinetic friction. With coupled asperities roughness must be 1; what a
// section that bears all has (sb_sliding_whole()) is then given beside the films.
SbStatus sb_sliding_refilm(SbSealState *state, const SbSlidingTask *task, double roughness,
                           SbReport *report);

// Gives the solved state of a task a surface `roughness` times as rough as the model's: neither
// fitment nor film depend on it, so that nothing is solved again.
SbStatus sb_sliding_resurface(SbSealState *state, const SbSlidingTask *task, double roughness,
                              SbReport *report);

// What the asperities under a gasket bear of `count` pressures above the fluid's where its film is
// no thinner than `film` [Pa, m] (sliding_gasket.c).
SbStatus sb_sliding_edge_asperities(double *out, const double *p, size_t count,
                                    const SbModel *model, int seal, double film, SbReport *report);

// The film problem of a seal in a run: net load, reduced modulus, radius, pressures (thesis
// sections 5.2 and 7.1; entrainment is half the sliding speed). `model` of the problem is left at
// its default.
void sb_sliding_film_problem(SbFilmProblem *out, const SbModel *model, int seal,
                             SbSealPressure pressure, double load_net, double speed);
