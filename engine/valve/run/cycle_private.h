// Shared by cycle_forces.c (forces and edges, evaluation of a segment) and cycle.c (segments of the
// quasi-static cycle). Pure functions, for any thread. s is the stem's displacement [m].
#pragma once

#include "engine/valve/run/cycle.h"

// A position of the platen and the corresponding state of the cycle.
typedef struct {
  const SbCycle *cycle;
  SbChamber chamber;
  int direction;
  double platen;
} SbCyclePlace;

// Returns whether the inner seal has contact at all. While the chamber is open its state is not
// solved, so the closed states decide.
bool sb_cycle_inner_touches(const SbCycle *cycle, SbChamber chamber, int direction);

// Returns 1 for SB_CYCLE_IN, else -1.
double sb_cycle_sign(int direction);

// The following functions have the form of SbFunction; `place` is an SbCyclePlace.

// Returns the magnitude of the seals' kinetic friction at s [N].
double sb_cycle_friction_at(double s, const void *place);

// Returns the force that balances sliding at s [N]: F_p + f on the in-stroke, F_p - f on the
// return.
double sb_cycle_balance_at(double s, const void *place);

// Returns dX/ds of balanced sliding at s [1].
double sb_cycle_rate_at(double s, const void *place);

// Returns sb_cycle_reserve() at s for the chamber of the position [N].
double sb_cycle_reserve_at(double s, const void *place);

// Returns the force on a stem at s beyond the balance, in the direction of sliding [N]. The platen
// only pushes: a stem that the pressure below ambient draws in runs ahead of it.
double sb_cycle_excess_at(double s, const void *place);
