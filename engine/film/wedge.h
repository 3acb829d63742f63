// Rigid, isoviscous film between a parabola and a plane: the analytical solution of Reynolds'
// equation.
//
// Source: thesis section 6.1 (equations 6.11 to 6.25 signs as in docs/thesis.md, 7); Martin (1916),
// Purday. With h = h0 + x^2/(2R) = h0 sec^2(t), tan t = x/sqrt(2 R h0), U = u1 + u2 (one surface
// sliding: U = u) and P* = h0^2 p/(6 U eta sqrt(2 R h0)):
//
//   dP*/dt = cos^2 t - sec^2(te) cos^4 t
//   P*(t)  = P*_in + t/2 + pi/4 + sin 2t/4 - sec^2(te) (3t/8 + 3 pi/16 + sin 2t/4 + sin 4t/32)
//
// The film model "rigid" (sb_film_solve_rigid): the inlet is flooded at pressure p_in; the film
// ends at te, where it reaches p_out with zero gradient (Reynolds' condition at the outlet's own
// pressure). Load is net of the ambient step (p_in for x < 0, p_out for x > 0): w = 3 eta U R
// cos^2(te)/h0, which is 4.894968 eta u_m R/h0 without pressures (u_m = U/2). Validity: both bodies
// keep their shape, so the film must be much thicker than the deflection: Moes' M below about 0.5,
// where the solved film is within a few per cent; beyond, the distance is told from the elastic
// limit. P*_out - P*_in < pi/16: beyond, the outlet's pressure drives the film back and no such end
// exists (SB_ERROR_INFEASIBLE).
#pragma once

#include <stdbool.h>

// How the film of a wedge between pools at zero pressure ends (thesis figures 6.5 to 6.7): at zero
// pressure as far behind the throat as it begins before it, the pressure odd about the throat
// (full); the same with what lies below zero cut off, which loses the flow there (half); at zero
// pressure with zero gradient (Reynolds).
typedef enum {
  SB_WEDGE_FULL_SOMMERFELD,
  SB_WEDGE_HALF_SOMMERFELD,
  SB_WEDGE_REYNOLDS,
} SbWedgeEnds;

// Pressure P* at the angle t of a wedge that begins at tan t = -reach; reach > 0, INFINITY: flooded
// from afar. 0 outside the film.
double sb_wedge_pressure(SbWedgeEnds ends, double t, double reach);

// Load w h0/(eta u_m R) of that wedge, u_m = U/2: 24 times the integral of P* sec^2 t, by parts. 0,
// 4 and 4.894968 (Martin) for an infinite reach.
double sb_wedge_load(SbWedgeEnds ends, double reach);

// Where Reynolds' film ends [rad]: 25.41 degrees for an infinite reach.
double sb_wedge_end(double reach);

// The wedge between two pools of liquid, scaled: h = film + x^2/2, h^3 p' = lambda (h - flux). The
// end pressures are above the rupture pressure; the film breaks with zero gradient where it would
// fall below that, carries its flux through a cavity and forms again where the outlet's pressure
// reaches. A film that is full everywhere bears no load by itself, its pressure being odd about
// the middle: it is thin enough for the deflection by that pressure to turn it into load, to first
// order int p' v' dx with v' the deflection's slope (Hilbert's transform of the pressure), which
// for equal end pressures is lambda^2 pi/(48 film^3): film = (lambda^2/24)^(1/3), and the pressure
// goes 0.75 above and below that of the ends.
typedef struct {
  double lambda, inlet, outlet;
  double film, stretch, length; // least film, flux film over it, sqrt(2 film)
  double end, reform;           // angles where it breaks and forms again, pi/2 if not
  bool full;                    // does not break; `end` is where the pressure is least
} SbWedgePools;

// The wedge of load pi/2.
SbWedgePools sb_wedge_pools(double lambda, double inlet, double outlet);

// Its pressure at x.
double sb_wedge_pools_pressure(const SbWedgePools *wedge, double x);
