// Typical processor time of one solve [s] on one core of 2 to 3 GHz, for predictions of plan,
// studies and progress; accurate to a factor of two or three. Measured with `sealbench bench` and
// on runs of the shipped scenes.
#pragma once

#include "engine/contact/fit.h"
#include "engine/valve/states/contact_law.h"

#include <math.h>

// Processor times [s].
#define SB_COST_CLOSED       2e-6   // a closed form
#define SB_COST_DISC         0.8e-3 // a disc
#define SB_COST_RING         50e-3  // at rest, without pressure; slightly more with pressure
#define SB_COST_RING_DRAGGED 0.13   // sliding: squeezed, pressed and dragged, with error estimate
#define SB_COST_RING_SHAPE   11e-3  // one shape over the land's edge, from a solved state
#define SB_COST_FILM         4e-3   // coupled film on the half-plane
#define SB_COST_FILM_FITTED  8e-3   // on the surface of a disc or ring
#define SB_COST_FILM_MIXED   12e-3  // with asperities in it
#define SB_COST_FILM_PROFILE 1e-3   // 1500 points of the profile of a solved film
#define SB_COST_FILM_STEP    2.5e-3 // one time step of a transient film
#define SB_COST_ROUGH        1e-5   // real area of a rough contact under a film
#define SB_COST_LEAK         0.2e-3 // leakage at rest by percolation
#define SB_COST_FRAME        3e-7   // one frame of a cycle
#define SB_COST_SAMPLE       2e-6   // one sample of the sliding plate
#define SB_COST_ACTUATION    0.5e-3 // a quasi-static actuation with its rough contacts
#define SB_COST_DYNAMICS     8e-3   // a stroke in and out with inertia
#define SB_COST_DYNAMICS_OWN 2e-3   // a stroke with a drive that prescribes no speed

// Returns the time of one solve of a fit model [s].
static inline double sb_cost_fit(SbFitModel model) {
  const SbFitKind *kind = sb_fit_kind(model);
  return kind->section ? SB_COST_RING : kind->points ? SB_COST_DISC : SB_COST_CLOSED;
}

// Returns the time of a ring's fit at the relative `tolerance` (output.tolerance) divided by its
// time at 1e-3.
static inline double sb_cost_ring_share(double tolerance) {
  return pow(1e-3 / tolerance, tolerance < 1e-3 ? 0.27 : 0.1);
}

// Returns the time of one film by a film model, on the half-plane [s].
static inline double sb_cost_film(SbFilmModel model) {
  return sb_film_kind(model)->coupled ? SB_COST_FILM : SB_COST_CLOSED;
}

// Returns the time of one film of a model's state at another speed [s].
static inline double sb_cost_speed_state(const SbModel *model) {
  const bool coupled = sb_contact_law(model)->shares;
  const bool body = sb_fit_kind(model->fit)->body;
  return coupled                                      ? SB_COST_FILM_MIXED
         : sb_film_kind(model->film)->coupled && body ? SB_COST_FILM_FITTED
                                                      : sb_cost_film(model->film);
}
