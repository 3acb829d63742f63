// Squeeze film between surfaces at rest, in closed form. The functions have no state of their own;
// an initialised SbSqueeze may be read by several threads.
//
// A gap h, uniform over a strip of width 2 b >> h with ambient pressure at its ends, closes at the
// rate -h':
//
//   d/dx (h^3/(12 eta) dp/dx) = h'      p = -6 eta h'/h^3 (b^2 - x^2)      mean -4 eta b^2 h'/h^3
//
// The mean pressure P on the strip is carried by fluid and asperities, P = p_f + p_a(h):
//
//   d(1/h^2)/dt = p_f/(2 eta b^2)
//   1/h^2 - 1/h_0^2 = P t/(2 eta b^2) without asperities
//
// With asperities the film approaches the gap at which p_a(h) = P; p_a is that of a rough law
// (contact/rough). Sources: Reynolds (1886); with p_a Persson and Scaraggi, J. Phys.: Condens.
// Matter 21 (2009) 185002, without flow factors. Adhesion of the law is subtracted from p_a. Valid
// for an isoviscous fluid. Not modelled: the fluid pocket in the middle of a soft body (its film
// closes later), fluid pressure at the ends.
#pragma once

#include "engine/contact/rough/rough_law.h"

// Number of tabulated gaps.
enum { SB_SQUEEZE_NODES = 129 };

// A squeeze film, set by sb_squeeze_init().
typedef struct {
  double film, rest;             // initial gap; final gap (0 without a law) [m]
  double pressure;               // P [Pa]
  double drag;                   // 4 eta b^2 [Pa s m2]
  const SbRoughLaw *law;         // p_a(h), borrowed; NULL: smooth
  double time[SB_SQUEEZE_NODES]; // with a law: time at which gap[i] is reached [s]
  double gap[SB_SQUEEZE_NODES];  // with a law: decreasing [m]
} SbSqueeze;

// Prepares a film of initial gap `film` [m] between rough surfaces of `law` (borrowed; NULL:
// smooth), with the mean `pressure` P [Pa] > 0 on a strip of half-width `half_width` b [m] > 0 and
// the `viscosity` [Pa s] > 0. The pressure is relative to the ambient pressure at the ends. A film
// that is not thicker than the final gap of the asperities remains constant.
void sb_squeeze_init(SbSqueeze *out, double film, double pressure, double half_width,
                     double viscosity, const SbRoughLaw *law);

// Returns the gap [m] after `time` [s] >= 0.
double sb_squeeze_film(const SbSqueeze *squeeze, double time);

// Returns the time [s] after which the gap is `film` [m], between the final gap (excluded) and the
// initial gap. Returns 0 for a film that remains constant.
double sb_squeeze_time(const SbSqueeze *squeeze, double film);
