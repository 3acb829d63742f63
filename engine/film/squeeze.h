// Film between surfaces that rest on each other: squeezed out by Reynolds' equation, in closed
// form.
//
// A gap h, the same all over a strip of width 2 b >> h, whose fluid has ambient pressure at the
// strip's ends, closes evenly at the rate -h':
//
//   d/dx (h^3/(12 eta) dp/dx) = h'      p = -6 eta h'/h^3 (b^2 - x^2)      mean -4 eta b^2 h'/h^3
//
// The mean pressure P on the strip is the fluid's and the solids', P = p_f + p_a(h), so that
//
//   d(1/h^2)/dt = k p_f/(eta b^2), k = 1/2      1/h^2 - 1/h_0^2 = k P t/(eta b^2) without solids
//
// With asperities the film ends where they carry all of it, p_a(h) = P; p_a is that of a rough law
// (contact/rough). Source: Reynolds (1886); the mean-field form with p_a is that of squeeze between
// rough elastic solids (Persson and Scaraggi, J. Phys.: Condens. Matter 21 (2009) 185002) without
// flow factors. Valid for an isoviscous fluid. Leaves out the pocket that a soft body keeps in its
// middle (its film goes later than this) and fluid pressure at the ends.
#pragma once

#include "engine/contact/rough/rough_law.h"

enum { SB_SQUEEZE_NODES = 129 };

typedef struct {
  double film, rest;             // at the start, and that the solids leave in the end [m]
  double pressure;               // P [Pa]
  double drag;                   // 4 eta b^2 [Pa s m2]
  const SbRoughLaw *law;         // p_a; borrowed, NULL: none
  double time[SB_SQUEEZE_NODES]; // at which `gap` is reached; with a law only
  double gap[SB_SQUEEZE_NODES];
} SbSqueeze;

// A film of thickness `film` [m] between rough surfaces of `law` (NULL: smooth) that are pressed by
// `pressure` [Pa] > 0 over a strip of half width b [m] > 0. A film that is none above what the
// solids leave stays as it is. `viscosity` > 0 [Pa s].
void sb_squeeze_init(SbSqueeze *out, double film, double pressure, double half_width,
                     double viscosity, const SbRoughLaw *law);

// Its thickness after a rest [m]; `time` >= 0 [s].
double sb_squeeze_film(const SbSqueeze *squeeze, double time);

// The rest after which it is `film` thick, between the end's (excluded) and the start's [s].
double sb_squeeze_time(const SbSqueeze *squeeze, double film);
