// Newton's method with the contact's active set, and load steps that adapt to it (ring_advance.c).
//
// Internal to the ring.
#pragma once

#include "engine/contact/ring/ring_contact.h"

// Polled between iterations; returns true to stop. NULL: never.
typedef bool (*SbRingPoll)(void *data);

typedef struct {
  int iterations; // Newton iterations, rejected attempts included
  int steps;      // accepted load steps
  int rejected;   // attempts that were halved
  double residual;
} SbRingCount;

typedef struct {
  int iterations_max;    // per load step
  double step_least;     // smallest share of a load step before giving up
  int stumbles_max;      // much shortened corrections before giving up, 0: no limit
  bool walks;            // whether load steps may follow the ring in viscous steps
  double correction_max; // largest nodal correction of one iteration (length)
  SbRingPoll poll;
  void *poll_data;
} SbRingNewton;

// Solves for the setting `contact->now`; the state is left at the last iterate on failure.
SbStatus sb_ring_newton(SbRingContact *contact, const SbRingNewton *options, SbRingCount *count,
                        SbReport *report);

// Moves from the present converged setting to `target`, in as many steps as it takes. Where the
// next equilibrium is not near, the ring is followed there in viscous steps. On failure the last
// converged setting and state remain, and the report says where equilibrium ended.
SbStatus sb_ring_advance(SbRingContact *contact, const SbRingSetting *target,
                         const SbRingNewton *options, SbRingCount *count, SbReport *report);
