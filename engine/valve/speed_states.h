// Steady states of one sliding contact over its speed: film, lambda, real area, boundary and
// viscous friction of any instant belong to one state, at that instant's speed.
//
// A film of a power law is that power of the speed. Solved films are tabulated over ln(speed) in
// cells, two decades wide from 10 m/s down, each solved (sliding.h) where a speed in it is first
// asked for, so that nothing is computed that no instant visits. A cell is the cubic through its
// ends, a quarter and the middle; where the parabola that leaves the quarter out misses it by more
// than SB_SPEED_TOLERANCE in film or friction the cell is halved. That miss is told as the error,
// and is larger than the cubic's. Interpolated are the logarithms of the films and, with coupled
// asperities, their real area, load and viscous friction; all else follows from them by the same
// functions as in a solved state, so that its identities hold exactly. From the speed on at which
// the supply alone shapes the film one state stands for all, but for its viscous friction.
//
// Where only speeds near the reference are asked for, as of a cycle whose machine gives way a
// little, two states a tenth to either side of it and the reference state itself make a parabola,
// whose bend is told as the error; where that is more than SB_SPEED_TOLERANCE cells stand in.
//
// Below 1 um/s and above 10 m/s the film is that at these speeds. A film that cannot be solved
// there goes on from the reference state with the power 0.6 of the speed, with a warning.
#pragma once

#include "engine/valve/sliding.h"

#define SB_SPEED_LEAST     1e-6 // m/s
#define SB_SPEED_MOST      10.0 // m/s
#define SB_SPEED_TOLERANCE 5e-4 // relative, of films and friction

enum { SB_SPEED_NODES = 80, SB_SPEED_CELLS = 40, SB_SPEED_VALUES = 7 };

typedef struct {
  int place; // on the grid of nodes
  bool solved;
  double value[SB_SPEED_VALUES];
} SbSpeedNode;

typedef struct {
  int place, width; // on the grid of nodes
  bool usable;
  double value[4][SB_SPEED_VALUES];
} SbSpeedCell;

// On the caller's memory; plain, to be copied. Fields are private, but what is to be read.
typedef struct {
  SbSlidingTask task; // its speed is the reference state's, with the direction of sliding
  SbSealState base;   // the reference state
  double roughness;   // over the model's
  bool on_body;       // `body` is that of the film
  SbSlidingBody body;
  bool near; // to be set: asked for speeds near the reference only; cells are half a decade
  bool beside_known, beside_usable;
  double beside[2][SB_SPEED_VALUES]; // below and above the reference speed
  double power;                      // of a film that is a power law, else NAN
  double starved_from; // speed from which on `starved` stands [m/s]; NAN: not yet asked
  double starved[SB_SPEED_VALUES];
  size_t solves; // to be read: nodes solved
  // To be read: largest miss of a cell in use, relative, and what the cubic leaves in friction.
  double error, friction_error;
  SbStatus
      status; // to be read: SB_ERROR_CANCELLED or _MEMORY ended it; it answers with what it has
  size_t nodes, cells;
  SbSpeedNode node[SB_SPEED_NODES];
  SbSpeedCell cell[SB_SPEED_CELLS];
} SbSpeedStates;

// `at` is the solved state of `task`, whose speed is not 0; memory, counts and warnings of the task
// are used when states are asked for. `body`: see sb_sliding_respeed(), copied.
void sb_speed_states_init(SbSpeedStates *out, const SbSlidingTask *task, const SbSealState *at,
                          const SbSlidingBody *body);

// The state at a speed [m/s] of either sign; only films and what follows from them differ from the
// reference state. One without a film is returned as it is.
void sb_speed_state(SbSealState *out, SbSpeedStates *states, double speed);
