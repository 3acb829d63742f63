// Surface of a fitted ring or disc for the film solvers, and its dry contact. The functions have no
// state and may be called concurrently.
//
// The gap is that of a half-plane (the logarithm) plus a smooth part due to the finite size of the
// body, and the undeformed gap g is the body's own instead of a parabola:
//
//   h(x) = h0 + g(x) - C int p(s) ln|x - s| ds + int S(x, s) p(s) ds,   C = 4/(pi E')
//
// over a window that contains the contact and its surroundings. g and S are sums of Chebyshev
// polynomials over the window, z = -1 to 1. In this equation p is relative to the lower ambient
// pressure; pressures in structures and parameters are gauge. In the logarithm the ambient
// pressures extend to infinity; their tilt is fixed so that the step p_left (1/2 - asin(z)/pi) +
// p_right (1/2 + asin(z)/pi) over the window leaves the surface flat. S acts inside the window
// only.
//
// Source: Johnson, Contact Mechanics, sections 2.7 and 5.6. Linear about the fitted state: valid
// for pressures close to the dry contact's, as under a thin film.
#pragma once

#include <stddef.h>

#include "engine/base/status.h"

// Capacities.
enum {
  SB_COMPLIANCE_MODES = 24,    // Chebyshev polynomials of the gap and of either side of S, at most
  SB_COMPLIANCE_PRESSURES = 20 // coefficients of a dry pressure
};

// A surface. Plain data, may be copied; 5 kB.
typedef struct {
  int modes;                       // polynomials in use; 0: the structure is empty
  double left, right;              // window, x in the seal's frame [m]
  double modulus;                  // reduced modulus E' of the half-plane part [Pa]
  double gap[SB_COMPLIANCE_MODES]; // g(x) = sum gap[k] T_k(z), up to a constant [m]
  double beyond[2];                // slope of the gap at the left and right end of the window [1]
  // S(x, s) = sum smooth[k][l] T_k(z(x)) T_l(z(s)) [1/Pa], symmetric in k and l.
  double smooth[SB_COMPLIANCE_MODES][SB_COMPLIANCE_MODES];
} SbSurfaceCompliance;

// Computes the surface of a linear disc between two flats (vertical kernel) of `radius` [m],
// Young's `modulus` [Pa] and `poisson_ratio`, in the window -reach to reach [m]. Accurate to 12
// digits for reach up to radius/2. SB_ERROR_RANGE: `reach` is not between 0 and 0.95 radius, or the
// modulus is not positive.
SbStatus sb_compliance_disc(SbSurfaceCompliance *out, double radius, double modulus,
                            double poisson_ratio, double reach, SbReport *report);

// Returns C = 4/(pi E') of the half-plane part [1/Pa].
double sb_compliance_half_plane(const SbSurfaceCompliance *c);

// Returns g(x) [m] and writes its slope to *slope (NULL: not wanted). Outside the window g
// continues as a parabola with the slope `beyond`.
double sb_compliance_gap(const SbSurfaceCompliance *c, double x, double *slope);

// Returns the contribution of S to the gap at x [m], int S p ds, for a pressure with the moments
// moment[modes], m_l = int p T_l(z) ds [N/m], p relative to the lower ambient pressure. Writes its
// slope to *slope (NULL: not wanted).
double sb_compliance_smooth(const SbSurfaceCompliance *c, double x, const double *moment,
                            double *slope);

// Writes T_k(z(x)) to value[modes] and d/dx to slope[modes] (NULL: not wanted). Outside the window
// the values are those at its end and the slopes 0.
void sb_compliance_modes(const SbSurfaceCompliance *c, double x, double *value, double *slope);

// Number of points of sb_compliance_modes_together().
enum { SB_COMPLIANCE_TOGETHER = 8 };

// Does the same as sb_compliance_modes() for x[SB_COMPLIANCE_TOGETHER], with bit-identical results
// and faster: value[k][i] = T_k at x[i], slope[k][i] = dT_k/dx at x[i], k < modes (`slope` NULL:
// not wanted).
void sb_compliance_modes_together(const SbSurfaceCompliance *c, const double *x,
                                  double (*value)[SB_COMPLIANCE_TOGETHER],
                                  double (*slope)[SB_COMPLIANCE_TOGETHER]);

// Writes to out[modes] the integrals of T_k(z(x)) over x from `from` to `to`, clipped to the window
// [m].
void sb_compliance_integrals(const SbSurfaceCompliance *c, double from, double to, double *out);

// A dry frictionless contact: p = p_left (1/2 - asin(z)/pi) + p_right (1/2 + asin(z)/pi) + sqrt(1 -
// z^2) sum a_k U_k(z), with z = -1 to 1 over the contact (not the window), U_k Chebyshev
// polynomials of the second kind.
typedef struct {
  double left, right;                   // edges of the contact, x [m]
  double pressure_left, pressure_right; // ambient pressures [Pa]
  double load;                          // int (p - ambient), ambient = left one for x < 0 [N/m]
  double peak;                          // largest pressure [Pa]
  int count;                            // coefficients in use
  double a[SB_COMPLIANCE_PRESSURES];    // [Pa]
  double moment[SB_COMPLIANCE_MODES];   // m_l of sb_compliance_smooth() [N/m]
  // Edge coefficients: p - ambient tends to edge sqrt(1 - z^2) at the left and right edge [Pa].
  double edge_left, edge_right;
  double residual; // last residual of Newton's method, scaled
} SbDryContact;

// Solves the unilateral contact with unknown edges: zero gap inside, no tension, no penetration
// outside. `load` [N/m] > 0 is SbDryContact.load. Spectral method; Newton's method for coefficients
// and edges; about 0.1 ms. SB_ERROR_INPUT: the gap is not convex or the load not positive.
// SB_ERROR_INFEASIBLE: the contact leaves the window, needs tension, or would have two parts.
// SB_ERROR_NOT_CONVERGED.
SbStatus sb_dry_contact(SbDryContact *out, const SbSurfaceCompliance *c, double load,
                        double pressure_left, double pressure_right, SbReport *report);

// Returns the pressure [Pa] at x; ambient outside the contact.
double sb_dry_contact_pressure(const SbDryContact *dry, double x);

// Returns the gap [m] at x; 0 in the contact. `c` is the surface that was solved.
double sb_dry_contact_gap(const SbDryContact *dry, const SbSurfaceCompliance *c, double x);

// Sets dry->edge_left and edge_right from the ambient pressures and a[count].
void sb_dry_contact_edges(SbDryContact *dry);

// Replaces c->gap and c->beyond by those of the surface whose dry contact has the given pressure:
// of *pressure the fields left, right, pressure_left, pressure_right, count (at most modes - 2) and
// a are used. modes, window, modulus and S of `c` must be set.
void sb_compliance_of_pressure(SbSurfaceCompliance *c, const SbDryContact *pressure);

// Sets c->gap and c->beyond so that the dry contact has the pressure profile p[n] at x[n]: from the
// left edge of the contact to the right one, relative to the lower ambient pressure. `order`
// coefficients (1 to 12, at most modes - 2) smooth the profile. modes, window (wider than the
// contact) and modulus of `c` must be set, and S, which is 0 for fit models without a gap of their
// own. SB_ERROR_INPUT: fewer than order + 2 points, the contact is not inside the window, or
// `order` or modes do not match.
SbStatus sb_compliance_match(SbSurfaceCompliance *c, int order, size_t n, const double *x,
                             const double *p, double pressure_left, double pressure_right,
                             SbReport *report);
