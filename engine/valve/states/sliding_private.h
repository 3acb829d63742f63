// What the parts of a steady sliding state share. Internal to sliding*.c.
#pragma once

#include "engine/valve/states/sliding.h"

// A film with what is drawn of it.
typedef struct {
  SbFilm film;
  SbFilmProfile profile;
  bool fitted;        // on the fitted body, not on the half-plane
  double speed;       // [m/s]
  double share;       // of it, at which it was solved
  bool fresh;         // solved since that was last looked at
  SbFilmSolver **own; // borrowed, its solver; NULL: the memory's
  bool beside;        // next to that one's solution, where that serves
} SbSlidingSolved;

// A fitment with its ring, where it is one, for one way of sliding.
typedef struct {
  SbFit fit;
  SbRing *ring; // owned, NULL for other models
  bool known;
  SbReport why;    // NOT_CONVERGED: there is none, without friction
  double pressure; // difference for which it stands
  double modulus;  // of its rubber [Pa]
  int seal;
  SbSlidingLaw law; // of the friction that drags it
  double
      jump; // of what its film asks from that, relative, where they come no nearer; 0: they agree
  SbSlidingLaw found; // that of the film which then lies on it
  SbSlidingLaw guess; // the first one by closed forms
} SbSlidingFitment;

// What the solvers have found for a state (sliding_beside.c).
enum { SB_SLIDING_FILMS = 3 }; // on the half-plane, on the fitted body, at rest
typedef struct {
  SbFit fit;
  SbSlidingBody body;
  struct {
    bool solved, fitted;
    double share;
    SbFilm film; // its profile is not kept
  } on[SB_SLIDING_FILMS];
} SbSlidingSolution;

// States beside that of a kept ring, as sums; several threads may ask at the same time.
typedef struct SbSlidingBeside SbSlidingBeside;
SbSlidingBeside *sb_sliding_beside_create(void);         // NULL: no memory
void sb_sliding_beside_destroy(SbSlidingBeside *beside); // takes NULL

// What of a state is a sum, not solved.
typedef enum { SB_SUM_NOTHING, SB_SUM_FITMENT, SB_SUM_ALL } SbSumDepth;

// A ring's state that others start from (SbSlidingMemory.kept).
typedef struct {
  SbFitStart start;
  SbRing *ring;            // owned, that of `start`
  SbRingGuide *guide;      // owned, its
  SbRingTangent *tangent;  // owned, its
  SbSlidingBeside *beside; // owned, states beside it
  int way;                 // of sliding: index of SbSlidingMemory.fitment
  double strain;           // pressure difference over modulus
  SbSlidingLaw law, found; // that drags it, and that of its film
  SbSlidingLaw guess;      // by closed forms
} SbSlidingStart;

// A film that others are solved beside.
typedef struct {
  bool known, fitted;
  double inlet, outlet; // pressures [Pa]
  double speed, load;   // [m/s], >= 0; [N/m]
} SbSlidingBase;

enum { SB_SLIDING_STARTS = 64 }; // of a run at most three chamber states each way

struct SbSlidingMemory {
  bool keeps; // the states solved are kept for others
  SbSlidingStart kept[SB_SLIDING_STARTS];
  int kept_count;
  const struct SbSlidingMemory *from; // whose states rings start from, borrowed; NULL: cold
  bool tangent;                       // they are taken from there to first order
  bool summed;                        // the films with them
  SbRingsBeside beside;               // what these do
  bool bare;                          // their surfaces are not wanted
  SbSumDepth sums;                    // of the state in work, what is not solved
  SbSlidingSolution sum;              // but this
  SbSlidingMemory *ahead;             // where the next ring may be solved already, borrowed
  SbSlidingBeside *lender;            // whose solvers its films use, NULL: nobody's

  // By way of sliding where friction drags the seal, else at rest.
  SbSlidingFitment fitment[SB_RUN_MOTIONS];
  SbSlidingFitment *now;         // of the last evaluation
  SbSlidingSolved plane, fitted; // on the half-plane (or of a law), and on the fitted body
  SbSlidingSolved rest;          // dry rough contact, coupled asperities only
  const SbSlidingSolved *last;   // which of them the last evaluation gave
  bool rested;                   // it stands for the fit, with
  double rest_left;              // this pressure on the left
  const SbSlidingFitment *rest_on;
  SbSlidingBody body;        // of the last film on one
  SbFilmSolver *solver;      // NULL until a film is solved: laws need none
  SbFilmSolver *rest_solver; // that of `rest`, which leaves a sliding film's solution alone
  SbRoughLaw law;            // of the surface, once a film or a rest has asked for it
  SbSlidingBase base;        // what `solver` solved last from nothing
  bool near;                 // films next to that one may be solved beside it
  bool rest_waits;           // a sliding state is not asked what it is at rest
  SbWarnings warnings;       // of one round of a ring's friction
  bool (*cancelled)(void *); // NULL: nobody asks to stop
  void *cancelled_data;
};

// Moves a way's solved state to those kept, where it is one.
void sb_sliding_keep(SbSlidingMemory *memory, int way);

// Whether friction drags this seal's section: the ring's, while it slides.
bool sb_sliding_drags(const SbSlidingTask *task);

// The law of a task's surface with coupled asperities, made once for all of a seal's films and
// rests; borrowed, NULL where there is none.
const SbRoughLaw *sb_sliding_rough_law(const SbSlidingTask *task);

// A solver that stopped above the tolerance has the figures of its last solution, with their error.
bool sb_sliding_usable(SbStatus status);

// Fitment: contact and loads; a ring dragged by `law`, NULL: as it is known. *known tells whether
// there is a contact to go on with.
SbStatus sb_sliding_fit_contact(const SbSlidingTask *task, const SbSlidingLaw *law,
                                SbSealState *out, bool *known, SbReport *report);

// Finds what of a task is a sum beside a kept state, and the sum, in memory->sums and memory->sum.
// SB_ERROR_CANCELLED, SB_ERROR_MEMORY.
SbStatus sb_sliding_sum(const SbSlidingTask *task, const SbSlidingLaw *law,
                        SbSlidingBeside *beside);
void sb_sliding_sum_end(SbSlidingMemory *memory); // after that state

// Whether a film, on the fitted body or not, is in the sum; takes it from there.
bool sb_sliding_film_summed(const SbSlidingMemory *memory, const SbSlidingSolved *which,
                            bool fitted);
void sb_sliding_take_film(SbSlidingSolved *out, SbSlidingMemory *memory);

// The kept state that a task's ring starts from; NULL: none.
const SbSlidingStart *sb_sliding_start_of(const SbSlidingTask *task);

// The next evaluation of a task finds no fitment in its memory.
void sb_sliding_forget_fitment(const SbSlidingTask *task);

// Fitment, film and friction of a task whose sums are set; a ring dragged by `law`, NULL: as it is
// known. And the same of any task.
SbStatus sb_sliding_solve_once(const SbSlidingTask *task, const SbSlidingLaw *law, SbSealState *out,
                               SbReport *report);
SbStatus sb_sliding_solve_with(const SbSlidingTask *task, const SbSlidingLaw *law, SbSealState *out,
                               SbReport *report);

// What a coupled state whose rest has waited (SbSlidingMemory.rest_waits) is at rest.
SbStatus sb_sliding_rest(const SbSlidingTask *task, SbSealState *out, SbReport *report);

// ---- The film (sliding_film.c)

// Whether there is one: something moves, and the inlet finds liquid.
bool sb_sliding_has_film(const SbSlidingTask *task);

// The film of a state whose contact is known, asperities beside it.
SbStatus sb_sliding_solve_film(const SbSlidingTask *task, SbSealState *out, SbReport *report);

// The film with asperities in it, under a net load [N/m] at a speed [m/s], 0: the dry contact; on
// the fitted body, or on the half-plane where that cannot be.
SbStatus sb_sliding_solve_rough(const SbSlidingTask *task, SbSlidingSolved *out, double load_net,
                                double speed, SbReport *report);

// A state's film figures from a solved one on a fitment; false: the solver stopped before its first
// solution, and they stay NaN.
bool sb_sliding_read_film(SbSealState *out, const SbSlidingSolved *solved, SbStatus status,
                          const SbFit *fit);

// A law's film carries half of itself along (thesis eq. 5.20), and no more than the supply.
void sb_sliding_limit_law(SbSealState *out, const SbSlidingTask *task);

// Error of a film by a closed form under a load with an error; NaN under an exact one.
void sb_sliding_law_error(SbSealState *out);

// Fills static_error: the dry contact's parts by the errors of real area, width and load.
void sb_sliding_static_error(SbSealState *out);

// Fills the errors of kinetic friction: of its parts by the errors of real area, width, load and
// film. `borne`: relative error of the asperities' share of the load, 0 where they carry all of it.
void sb_sliding_kinetic_errors(SbSealState *out, double borne);

// A film.
SbStatus sb_sliding_solve_on(const SbSlidingTask *task, SbSlidingSolved *out,
                             const SbFilmProblem *problem, SbReport *report);

// What the surfaces make of a contact whose load, width and film are known: real area, friction.
SbStatus sb_sliding_rough_contact(SbSealState *out, const SbSlidingTask *task, double roughness,
                                  SbReport *report);

// Leaves of a law's friction what the section bears, borne_share and area_cut.
SbStatus sb_sliding_share_out(SbSealState *out, const SbSlidingTask *task, SbReport *report);

// A ring's state: friction drags it, and hangs on the film that lies on the dragged ring.
SbStatus sb_sliding_drag(const SbSlidingTask *task, SbSealState *out, SbReport *report);

// ---- A gasket (sliding_gasket.c)

// Gives a state the pressure of its fitment.
void sb_sliding_take_edges(SbSealState *out, const SbFit *fit);

// Film of a gasket's state, whose pressure is known, at the task's speed.
void sb_sliding_edge_film(SbSealState *out, const SbSlidingTask *task);

// Real area and kinetic friction of a gasket's state under its film at the task's speed, of a
// surface `roughness` times as rough as the model's; what rest makes of them, but for the static
// friction.
SbStatus sb_sliding_edge_contact(SbSealState *out, const SbSlidingTask *task, double roughness,
                                 SbReport *report);
