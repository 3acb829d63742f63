// How film and asperities share the load of a seal: one row for each kind of valve (valve.kind) and
// choice of models.asperities. Code that depends on these choices calls a function of the row, or
// reads one of its properties.
//
// Steps of a state: sb_sliding_solve() fits the contact, then solve() of the row computes film,
// rough contact and friction. The other functions change a state that has been solved. Each takes a
// task with a memory that this thread alone uses. The state must have contact. `roughness` is the
// roughness of the surface divided by the model's. After SB_ERROR_NOT_CONVERGED (a solver stopped
// early) the state has its last values; after another error it is unspecified.
#pragma once

#include "engine/valve/states/sliding.h"

typedef struct {
  // Asperities carry a part of the load, the film the remainder. Else the film carries all of it,
  // and the asperities are evaluated in it.
  bool shares;
  // The film is a closed form of the contact pressure: models.film has no effect.
  bool closed_film;
  // Real area, asperities' load and viscous friction at a speed do not follow from the film's
  // thickness alone: states over the speed have values of all of them.
  bool friction_over_speed;
  // The seal is clamped around the stem. Else it is in a groove of the stem.
  bool around_stem;
  // Relative error of the friction of a section that carries less than its friction; 0: not known.
  double detached_scatter;
  const char *film;   // name of the film's model; NULL: models.film
  const char *reason; // why this film is computed; NULL: none of its own

  // Computes film, rough contact and friction of a state whose contact and loads are set.
  SbStatus (*solve)(SbSealState *out, const SbSlidingTask *task, SbReport *report);
  // Computes the values at rest of a sliding state that solve() has omitted; NULL: solve() never
  // omits them.
  SbStatus (*rest)(SbSealState *out, const SbSlidingTask *task, SbReport *report);
  // Sets lambda, real area, asperities' fraction of the load and kinetic friction from `film`,
  // which was solved with asperities in it, on the fitted body if `fitted`, else on the half-plane.
  // NULL: films of this row have no asperities in them.
  void (*take)(SbSealState *out, const SbModel *model, const SbFilm *film, bool fitted);
  // Replaces film and kinetic friction by those at task->speed, which differs from the state's in
  // its magnitude only (sb_sliding_respeed()). `body`: body of the state's film; NULL: half-plane.
  SbStatus (*respeed)(SbSealState *state, const SbSlidingTask *task, const SbSlidingBody *body,
                      SbReport *report);
  // Computes lambda, real area and kinetic friction from film_central, which the caller has set. If
  // `shares` and the film is not a closed form, `roughness` is 1 and the caller has set
  // real_area_share, boundary_load and friction_viscous too. Friction is the full one, of which a
  // dragged section may carry only a part. May change the values at rest.
  SbStatus (*refilm)(SbSealState *state, const SbSlidingTask *task, double roughness,
                     SbReport *report);
  // Does the same as refilm(), and computes the values at rest and static friction.
  SbStatus (*resurface)(SbSealState *state, const SbSlidingTask *task, double roughness,
                        SbReport *report);
  // Computes the errors of film, asperities and friction from those of the contact: load_error,
  // net_error, width_error and peak_error. The memory has fit and film of the state.
  SbStatus (*update_errors)(SbSealState *out, const SbSlidingTask *task, SbReport *report);
  // Warns that the section of a solved state, which rolls or jams (`section`), carries less than
  // its friction.
  void (*warn_limit)(SbWarnings *warnings, const SbSlidingTask *task, const SbSealState *state);
  // Returns the gap [m] next to a dry contact of the half-width `half` [m], at the distance `over`
  // times `half` from the middle of the contact; over >= 1.
  double (*dry_gap)(const SbModel *model, int seal, double over, double half);
} SbContactLaw;

// Returns the row of the model's kind of valve and asperities; static.
const SbContactLaw *sb_contact_law(const SbModel *model);

// Returns the row for a state: that of the model, or if the net load is not above 0 that of a film
// without asperities in it. Static.
const SbContactLaw *sb_contact_law_of(const SbModel *model, const SbSealState *state);

// Returns whether films of the model are solutions of Reynolds' equation; else they are closed
// forms.
bool sb_contact_solves_film(const SbModel *model);
