// One mass under forces that are linear in its state: exact motion, exact integrals, first event.
//
//   m u'' + C u' + K u = f0 + f1 tau,   u = x - x0,  u(0) = 0, u'(0) = v0,  tau = time since then
//
// Elementary mechanics; every branch (oscillating, overdamped, critical, no spring, no damper,
// held) is written so that no digits are lost when a coefficient is small. Between two events of a
// piecewise linear mechanism this is its whole motion, so a rest of an hour costs as much as a
// microsecond. The first event is found with bounds, not by sampling: none can be stepped over.
// SI units. Leaves out: forcing other than a ramp; any nonlinearity (see radau.h).
#pragma once

#include <stdbool.h>

typedef enum {
  SB_OSCILLATOR_HELD,  // u = 0 for ever
  SB_OSCILLATOR_DRIFT, // K = 0
  SB_OSCILLATOR_UNDER, // oscillates
  SB_OSCILLATOR_OVER,  // overdamped or critical
} SbOscillatorKind;

typedef struct {
  SbOscillatorKind kind;
  double mass, damping, stiffness; // kg, N s/m, N/m
  double f0, f1, v0;               // N, N/s, m/s
  double trend0,
      trend1;    // u follows trend0 + trend1 tau once the transient z is gone (K > 0) [m, m/s]
  double z0, w0; // transient and its rate at the start [m, m/s]
  double beta, omega0;   // C/(2m), sqrt(K/m) [1/s]
  double split;          // sqrt|beta^2 - omega0^2| [1/s]
  double slow, fast;     // decay rates of the overdamped transient [1/s]
  double c_slow, c_fast; // z = c_slow exp(-slow tau) + c_fast exp(-fast tau) [m]; only if `apart`
  bool apart;
} SbOscillator;

// mass > 0, damping >= 0, stiffness >= 0, all finite; f0 is the force at x0 and rest.
void sb_oscillator_init(SbOscillator *o, double mass, double damping, double stiffness, double f0,
                        double f1, double v0);

// A mass that is held (stuck, or on a rigid stop).
void sb_oscillator_hold(SbOscillator *o);

// Travel u [m]; velocity [m/s] and acceleration [m/s^2] at tau >=
// 0; any may be NULL.
void sb_oscillator_at(const SbOscillator *o, double tau, double *travel, double *v, double *a);

// Integral of u [m s] and of v^2 [m^2/s] over (0, tau).
double sb_oscillator_integral_u(const SbOscillator *o, double tau);
double sb_oscillator_integral_v2(const SbOscillator *o, double tau);

// A quantity that must stay >= 0; the event is where it first turns negative:
//   g = constant + rate tau + of_x u + of_v v + relax exp(-relax_rate tau)
//       + log_gain ln(1 + (log_start + tau)/log_time)          (log_gain >= 0, log_time > 0)
typedef struct {
  double constant, rate, of_x, of_v;
  double relax, relax_rate;
  double log_gain, log_start, log_time;
  double noise; // size of terms that have cancelled in the coefficients: sets the rounding error
} SbEventFunction;

// Value at tau, and its rate (may be NULL).
double sb_event_at(const SbEventFunction *g, const SbOscillator *o, double tau, double *rate);

// First tau in [0, horizon] at which g turns negative; `horizon` if none (then *found = false).
// A g that is zero at 0 and rises is not an event; one that is zero and falls is one, at 0.
// Bounds on the curvature make the march safe: between its steps g provably keeps its sign.
double sb_event_first(const SbEventFunction *g, const SbOscillator *o, double horizon, bool *found);
