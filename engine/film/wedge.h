// Analytical film between a rigid parabola and a plane (isoviscous Reynolds equation). The
// functions have no state and may be called concurrently.
//
// Source: thesis section 6.1 (equations 6.11 to 6.25, signs as in docs/thesis.md, 7); Martin
// (1916), Purday. With h = h0 + x^2/(2R) = h0 sec^2(t), tan t = x/sqrt(2 R h0), U = u1 + u2 (one
// sliding surface: U = u) and P* = h0^2 p/(6 U eta sqrt(2 R h0)):
//
//   dP*/dt = cos^2 t - sec^2(te) cos^4 t
//   P*(t)  = P*_in + t/2 + pi/4 + sin 2t/4 - sec^2(te) (3t/8 + 3 pi/16 + sin 2t/4 + sin 4t/32)
//
// Film model "rigid" (sb_film_solve_rigid): the inlet is flooded at the pressure p_in. The film
// ends at te, where p = p_out with zero gradient. The load is net of the ambient step (p_in for x <
// 0, p_out for x > 0): w = 3 eta U R cos^2(te)/h0, which is 4.894968 eta u_m R/h0 without pressures
// (u_m = U/2). Valid if the film is much thicker than the deflection: Moes' M below about 0.5,
// where it agrees with the solved film within a few per cent. It requires P*_out - P*_in < pi/16;
// otherwise the outlet pressure drives the film back and the end te does not exist
// (SB_ERROR_INFEASIBLE).
#pragma once

#include <stdbool.h>

// Boundary condition at the end of a wedge between pools at zero pressure (thesis figures 6.5
// to 6.7).
typedef enum {
  SB_WEDGE_FULL_SOMMERFELD, // p = 0 as far behind the minimum gap as it begins before it; p is odd
  SB_WEDGE_HALF_SOMMERFELD, // as FULL_SOMMERFELD, with negative pressures set to zero
  SB_WEDGE_REYNOLDS,        // p = 0 with zero gradient
} SbWedgeEnds;

// Returns P* at the angle t [rad] of a wedge that begins at tan t = -reach; reach > 0, INFINITY:
// flooded. 0 outside the film.
double sb_wedge_pressure(SbWedgeEnds ends, double t, double reach);

// Returns the dimensionless load w h0/(eta u_m R), u_m = U/2, of a wedge that begins at tan t =
// -reach. For an infinite reach: 0, 4 and 4.894968 (Martin), in the order of SbWedgeEnds.
double sb_wedge_load(SbWedgeEnds ends, double reach);

// Returns the angle te at which the film of SB_WEDGE_REYNOLDS ends [rad]; 25.41 degrees for an
// infinite reach.
double sb_wedge_end(double reach);

// A wedge between two pools of liquid, scaled as in scale.h (x by b, p by p_H, h by b^2/R):
//
//   h = film + x^2/2,  h^3 p' = lambda (h - flux),  tan t = x/length
//
// flux is stretch times film. End pressures are relative to the rupture pressure, so p >= 0. Where
// p would become negative, the film cavitates with zero gradient; it re-forms where the liquid of
// the outlet, under its pressure, fills the gap. On an undeformed contact the pressure of a full
// film is odd in x and carries no load. The deflection that it causes makes it carry, to first
// order, int p' v' dx with the slope v' of the elastic deflection. For equal end pressures it
// carries lambda^2 pi/(48 film^3), so film = (lambda^2/24)^(1/3).
typedef struct {
  double lambda;  // 3 pi^2 U/(4 W^2) of scale.h
  double inlet;   // pressure at x = -infinity
  double outlet;  // pressure at x = +infinity
  double film;    // minimum film, at x = 0
  double stretch; // flux film divided by the minimum film
  double length;  // sqrt(2 film)
  double end;     // angle t of rupture [rad]; of the minimum pressure if `full`
  double reform;  // angle t of re-formation [rad]; pi/2: none
  bool full;      // the film does not cavitate
} SbWedgePools;

// Returns the wedge that carries the load pi/2 above the end pressures, for `lambda` > 0 and the
// scaled end pressures `inlet` >= 0 and `outlet` >= 0.
SbWedgePools sb_wedge_pools(double lambda, double inlet, double outlet);

// Returns the scaled pressure of the wedge at the scaled x.
double sb_wedge_pools_pressure(const SbWedgePools *wedge, double x);
