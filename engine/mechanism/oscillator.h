// One mass under forces that are linear in its state: exact motion, exact integrals, first event.
//
//   m u'' + C u' + K u = f0 + f1 tau,   u(0) = 0, u'(0) = v0,   tau = time since then
//
// Elementary mechanics. Oscillating, overdamped, critical, without a spring, a damper or both: one
// set of functions, written so that no digits are lost when a coefficient is small. Between two
// events of a piecewise linear mechanism this is its whole motion, so that a rest of an hour costs
// as much as a microsecond. The first event is found with bounds, not by sampling: none can be
// stepped over. SI units. Leaves out: forcing other than a ramp; any nonlinearity (see radau.h).
#pragma once

#include <stdbool.h>

// One that is zero throughout is a mass that is held.
typedef struct {
  double damping, stiffness; // C/m [1/s], K/m [1/s2]
  double v0, g0, g1;         // m/s, and f0 and f1 over m [m/s2, m/s3]
  double omega;              // sqrt(K/m) [1/s]
  double slow, fast;         // decay rates if overdamped, else C/(2m) [1/s]
  double split;              // sqrt|(C/2m)^2 - K/m| [1/s]
  bool swings, apart;        // underdamped; not near critical damping
  // With a spring u follows trend0 + trend1 tau once the transient is gone [m, m/s].
  double trend0, trend1;
} SbOscillator;

// mass > 0, stiffness >= 0, all finite; f0 is the force at x0 and rest. Under a damping below 0
// what swings grows: the motion is known up to tau = mass / -damping.
void sb_oscillator_init(SbOscillator *o, double mass, double damping, double stiffness, double f0,
                        double f1, double v0);

typedef struct {
  double tau;                // s
  double travel, v, a, jerk; // u and its rates [m, m/s, m/s2, m/s3]
  double area;               // integral of u from 0 on [m s]
  double size_u, size_v;     // sums of the magnitudes in u and v: their rounding
} SbOscillatorState;

// The motion at tau >= 0.
SbOscillatorState sb_oscillator_at(const SbOscillator *o, double tau);

// Integral of u - rate tau over (0, tau) [m s]; `pull` is g1 - rate K/m [m/s3] without the rounding
// of its terms.
double sb_oscillator_lag(const SbOscillator *o, double tau, double rate, double pull);

// Integral of v^2 over (0, tau) [m^2/s].
double sb_oscillator_square(const SbOscillator *o, double tau);

// A quantity that must stay >= 0; the event is where it first turns negative:
//   g = constant + rate tau + of_x u + of_v v + relax exp(-relax_rate tau)
//       + sum of logs, gain ln(1 + (start + tau)/time)             (gain >= 0, time > 0)
enum { SB_EVENT_LOGS = 4 };
typedef struct {
  double constant, rate, of_x, of_v; // of g's unit, tau in s, u in m, v in m/s
  double relax, relax_rate;
  int logs;
  struct {
    double gain, start, time;
  } log[SB_EVENT_LOGS];
  double noise; // size of terms that have cancelled in the coefficients: sets the rounding error
} SbEventFunction;

// First tau in [0, horizon] at which g turns negative; `horizon` if none (then *found = false).
// A g that is zero at 0 and rises is not an event; one that is zero and falls is one, at 0.
// Bounds on the curvature make the march safe: between its steps g provably keeps its sign.
double sb_event_first(const SbEventFunction *g, const SbOscillator *o, double horizon, bool *found);
