// Steady states of one sliding contact as a function of speed: film, lambda, real area and friction
// at any speed, from few solved states.
//
// Use: sb_speed_states_init() with a solved state, then sb_speed_state() for each speed.
//
// A film of a power law is scaled by its power of the speed. Solved films are tabulated over
// ln(speed) in cells, two decades wide from 10 m/s down. A cell is solved (sliding.h) when a speed
// in it is first requested. A cell is the cubic through both ends, a quarter and the middle. If the
// parabola without the quarter point deviates from it by more than SB_SPEED_TOLERANCE in film or
// friction, the cell is halved; the deviation is the error estimate. The interpolated values
// are the logarithms of film_min, film_central and layer and, with coupled asperities, real area,
// boundary_load and viscous friction; sb_sliding_refilm() computes all else. Above the speed at
// which the supply alone determines the film, one state applies, with viscous friction proportional
// to speed.
//
// If only speeds near the reference speed are requested (`near`), two states at 10 % lower and
// higher speed and the reference state form a parabola. Its deviation from a straight line, in
// proportion to the largest distance from the reference that was requested, is the error estimate;
// where it deviates by more than SB_SPEED_TOLERANCE, cells are used.
//
// Below 1 um/s and above 10 m/s the film is that at these speeds. A film that cannot be solved is
// extrapolated from the reference state with the power 0.6 of the speed, with a warning.
#pragma once

#include "engine/valve/states/sliding.h"

// Range of tabulated speeds [m/s].
#define SB_SPEED_LEAST 1e-6
#define SB_SPEED_MOST  10.0

// Relative interpolation tolerance of films and friction.
#define SB_SPEED_TOLERANCE 5e-4

// Capacities of nodes and cells, and number of interpolated values.
enum { SB_SPEED_NODES = 80, SB_SPEED_CELLS = 40, SB_SPEED_VALUES = 7 };

// A solved state (private).
typedef struct {
  int place; // position on the grid
  bool solved;
  double value[SB_SPEED_VALUES];
} SbSpeedNode;

// A cell (private).
typedef struct {
  int place, width; // position and width on the grid
  bool usable;      // its nodes were solved
  double value[4][SB_SPEED_VALUES];
} SbSpeedCell;

// The states of a contact, in memory of the caller; owns nothing. sb_speed_states_init() sets all
// fields. After it the caller may set `near` and `roughness`, and reads solves, error,
// friction_error and status; all other fields are private.
typedef struct {
  SbSlidingTask task; // of the reference state, with its speed and direction
  SbSealState base;   // the reference state
  double roughness;   // roughness divided by the model's; 1 after the initialisation, and
                      // always with coupled asperities
  bool on_body;       // the film is on `body`
  SbSlidingBody body;
  bool near; // only speeds near the reference will be requested; cells are half a decade wide
  bool beside_known, beside_usable;           // the two neighbouring states were tried; are usable
  double beside[2][SB_SPEED_VALUES];          // at lower and higher speed
  double beside_error, beside_friction_error; // the parabola's relative errors: film, friction
  double power;                               // exponent of a power law film, else NAN
  double starved_from; // speed from which on `starved` applies [m/s]; NAN: not yet known
  double starved[SB_SPEED_VALUES];
  size_t solves;         // number of states solved
  double error;          // relative error of the films: their largest deviation in a used cell, or
                         // that of the parabola
  double friction_error; // relative error of the friction that remains with cubic or parabola
  // SB_OK; or SB_ERROR_CANCELLED, _MEMORY: a solve ended early; later results use what is
  // available.
  SbStatus status;
  size_t nodes, cells;
  SbSpeedNode node[SB_SPEED_NODES];
  SbSpeedCell cell[SB_SPEED_CELLS];
} SbSpeedStates;

// Initialises the states. `task` is a sliding task (speed not 0; copied) and `at` its state, solved
// by sb_sliding_solve(). The pointers in the task are borrowed as long as states are requested;
// solves and warnings are added to its counters and warnings. `body` is sb_sliding_body() after
// that solve (NULL: half-plane); it is copied.
void sb_speed_states_init(SbSpeedStates *out, const SbSlidingTask *task, const SbSealState *at,
                          const SbSlidingBody *body);

// Computes the state at the speed |speed| [m/s] in the direction of the reference state; the sign
// of `speed` is ignored. Solves states if needed. Only film, real area and friction differ from the
// reference state; a reference without a film is returned unchanged. A failed solve is not reported
// here: see `status`, and the extrapolation at the top.
void sb_speed_state(SbSealState *out, SbSpeedStates *states, double speed);
