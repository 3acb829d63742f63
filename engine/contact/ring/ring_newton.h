// Newton's method with the contact's active set, and load steps that adapt to it.
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
  double parts_least;    // parts that a load step is taken in at least, 0: no limit
  bool (*keeps)(void *); // whether a solution is on the branch that is followed; NULL: always
  void *keeps_data;
  SbRingPoll poll;
  void *poll_data;
} SbRingNewton;

// Solves at the load `contact->is.now`; the state is left at the last iterate on failure.
SbStatus sb_ring_newton(SbRingContact *contact, const SbRingNewton *options, SbRingCount *count,
                        SbReport *report);

// Moves from the present converged load to `target`, in as many steps as it takes. Where the
// next equilibrium is not near, the ring is followed there in viscous steps. On failure the last
// converged load and state remain, and the report says where equilibrium ended.
SbStatus sb_ring_advance(SbRingContact *contact, const SbRingLoad *target,
                         const SbRingNewton *options, SbRingCount *count, SbReport *report);
