// How film and asperities share the load of a seal: one row for each kind of valve (valve.kind) and
// choice of models.asperities. Code that depends on these choices calls a function of the row, or
// reads one of its properties.
//
// Steps of a state: sb_sliding_solve() fits the contact, then solve() of the row computes film,
// rough contact and friction. The other functions change a state that has been solved. Each takes a
// task with a memory that this thread alone uses. After SB_ERROR_NOT_CONVERGED (a solver stopped
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
  // Computes the values at rest of a sliding state that solve() has omitted; NULL: it never does.
  SbStatus (*rest)(SbSealState *out, const SbSlidingTask *task, SbReport *report);
  // Takes the asperities' results from a film that was solved with asperities in it, on the fitted
  // body if `fitted`; NULL: no film has any.
  void (*take)(SbSealState *out, const SbModel *model, const SbFilm *film, bool fitted);
  // sb_sliding_respeed().
  SbStatus (*respeed)(SbSealState *state, const SbSlidingTask *task, const SbSlidingBody *body,
                      SbReport *report);
  // Computes lambda, real area and kinetic friction from film_central, in the full form; may change
  // the values at rest. See sb_sliding_refilm().
  SbStatus (*refilm)(SbSealState *state, const SbSlidingTask *task, double roughness,
                     SbReport *report);
  // The same, with the values at rest and static friction. See sb_sliding_resurface().
  SbStatus (*resurface)(SbSealState *state, const SbSlidingTask *task, double roughness,
                        SbReport *report);
  // sb_sliding_update_errors(), after the error of the net load.
  SbStatus (*update_errors)(SbSealState *out, const SbSlidingTask *task, SbReport *report);
  // Warns that the section of a solved state bears less than its friction.
  void (*warn_limit)(SbWarnings *warnings, const SbSlidingTask *task, const SbSealState *state);
  // Returns the gap [m] outside a dry contact of the half-width `half` [m], at the distance
  // x >= half from its middle, x = `over` times half.
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
