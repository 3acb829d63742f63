// One mass under forces that are linear in its state: closed-form motion, integrals, first event.
//
//   m u'' + C u' + K u = f0 + f1 tau,   u(0) = 0, u'(0) = v0,   tau = time since then
//
// All cases (oscillating, critical, overdamped, no spring, no damper) without loss of digits if a
// coefficient is small. This is the exact motion of a piecewise linear mechanism between two
// events, whatever its duration. The first event is found with bounds on the curvature, so none is
// missed. The functions have no state and may be called concurrently. Not modelled: other forcing
// than a ramp, nonlinearity (radau.h).
#pragma once

#include <stdbool.h>

// A prepared oscillator, set by sb_oscillator_init(); the fields are private. {0} is a fixed mass.
typedef struct {
  double damping, stiffness; // C/m [1/s], K/m [1/s2]
  double v0, g0, g1;         // [m/s], f0/m [m/s2], f1/m [m/s3]
  double omega;              // sqrt(K/m) [1/s]
  double slow, fast;         // decay rates if overdamped, else both C/(2m) [1/s]
  double split;              // sqrt|(C/2m)^2 - K/m| [1/s]
  bool swings, apart;        // underdamped; clearly different from critical damping
  double trend0, trend1;     // with a spring, u tends to trend0 + trend1 tau [m], [m/s]
} SbOscillator;

// Prepares an oscillator: mass > 0 [kg], stiffness >= 0 [N/m], damping [N s/m], all finite. f0 [N]
// and f1 [N/s] are the force at tau = 0 for u = 0 and u' = 0 and its rate, v0 [m/s] the initial
// velocity. With damping < 0 the motion grows and is valid up to tau = mass/-damping.
void sb_oscillator_init(SbOscillator *o, double mass, double damping, double stiffness, double f0,
                        double f1, double v0);

// State of the motion.
typedef struct {
  double tau;                // [s]
  double travel, v, a, jerk; // u and its derivatives [m], [m/s], [m/s2], [m/s3]
  double area;               // integral of u from 0 to tau [m s]
  double size_u, size_v;     // sums of the magnitudes of the terms of u and v, for rounding errors
} SbOscillatorState;

// Returns the state at tau >= 0 [s].
SbOscillatorState sb_oscillator_at(const SbOscillator *o, double tau);

// Returns the integral of u - rate tau from 0 to tau [m s]. `rate` [m/s]. `pull` is f1/m - rate K/m
// [m/s3], computed by the caller without cancellation.
double sb_oscillator_lag(const SbOscillator *o, double tau, double rate, double pull);

// Returns the integral of u'^2 from 0 to tau [m2/s].
double sb_oscillator_square(const SbOscillator *o, double tau);

// Largest number of logarithms of an event function.
enum { SB_EVENT_LOGS = 4 };

// An event function g(tau), in any unit, with u, u' of an oscillator; {0}: g = 0. The event is the
// first tau at which g becomes negative:
//   g = constant + rate tau + of_x u + of_v u' + relax exp(-relax_rate tau)
//       + sum over `logs` terms of gain ln(1 + (start + tau)/time)        (gain >= 0, time > 0)
typedef struct {
  double constant, rate, of_x, of_v;
  double relax, relax_rate; // relax_rate >= 0 [1/s]
  int logs;                 // terms in use, at most SB_EVENT_LOGS
  struct {
    double gain, start, time; // start, time in s
  } log[SB_EVENT_LOGS];
  double noise; // sum of the magnitudes of the terms that were added to `constant`, to estimate its
                // rounding error; 0: `constant` is exact
} SbEventFunction;

// Returns the first tau in [0, horizon] [s] at which g becomes negative, and sets *found; `horizon`
// >= 0 is finite. Without an event it returns `horizon` and *found is false. If g(0) = 0, the event
// is at 0 if g decreases and none if it increases.
double sb_event_first(const SbEventFunction *g, const SbOscillator *o, double horizon, bool *found);
