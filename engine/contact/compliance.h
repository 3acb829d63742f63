// Surface compliance of a fitted ring or disc as the film solvers take it, and its dry contact.
//
// The displacement of the contact surface is the half-plane's logarithm plus a smooth rest that the
// body's finite size adds, and the undeformed gap is the body's own instead of a parabola:
//
//   h(x) = h0 + g(x) - C int p(s) ln|x - s| ds + int S(x, s) p(s) ds,   C = 4/(pi E')
//
// over a window that holds the contact and its surroundings; g and S are sums of Chebyshev
// polynomials over the window, so that films far thinner than any finite-element mesh stay
// resolved by the logarithm. Pressures are above the lower one of the two ambient pressures; in the
// logarithm these reach to infinity, and its tilt, infinite on a half-plane, is fixed so that the
// smooth step p_left (1/2 - asin(z)/pi) + p_right (1/2 + asin(z)/pi) over the window (z = -1 .. 1)
// leaves the surface flat. S acts on the window only.
//
// Source: Johnson, Contact Mechanics, sections 2.7 and 5.6 (half-plane and finite bodies); the
// disc's rest is closed. It leaves out whatever is not linear about the fitted
// state: small changes of pressure against the dry contact's, as under a thin film.
#pragma once

#include <stddef.h>

#include "engine/base/status.h"

enum {
  SB_COMPLIANCE_MODES = 24,    // Chebyshev polynomials of the gap and of either side of S, at most
  SB_COMPLIANCE_PRESSURES = 20 // coefficients of a dry pressure
};

// Plain data, may be copied; 5 kB.
typedef struct {
  int modes;                       // in use; 0: none of this is set
  double left, right;              // window [m], x in the seal's frame
  double modulus;                  // reduced, E' of the half-plane's part [Pa]
  double gap[SB_COMPLIANCE_MODES]; // g(x) = sum gap[k] T_k(z), up to a constant [m]
  double beyond[2]; // slope with which the gap goes on beyond its left, right end [-]
  // S(x, s) = sum smooth[k][l] T_k(z(x)) T_l(z(s)) [1/Pa], symmetric in k and l.
  double smooth[SB_COMPLIANCE_MODES][SB_COMPLIANCE_MODES];
} SbSurfaceCompliance;

// The linear disc between two flats (vertical kernel, exact circle), with a window of +-`reach` in
// which the contact must lie; 12 digits up to a reach of half the radius. SB_ERROR_RANGE.
SbStatus sb_compliance_disc(SbSurfaceCompliance *out, double radius, double modulus,
                            double poisson_ratio, double reach, SbReport *report);

// C = 4/(pi E') of the half-plane's part [1/Pa].
double sb_compliance_half_plane(const SbSurfaceCompliance *c);

// g(x) and its slope; outside the window, where S acts no more, the parabola about its centre that
// goes on from its end with the slope `beyond`.
double sb_compliance_gap(const SbSurfaceCompliance *c, double x, double *slope);

// Displacement by S and its slope at x of a pressure with the moments m_l = int p T_l(z) ds
// [N/m], `modes` of them. `slope` may be NULL.
double sb_compliance_smooth(const SbSurfaceCompliance *c, double x, const double *moment,
                            double *slope);

// T_k(z(x)) and their derivatives d/dx for k < modes; outside the window as at its end, slope 0.
// `slope` may be NULL.
void sb_compliance_modes(const SbSurfaceCompliance *c, double x, double *value, double *slope);

// The same at SB_COMPLIANCE_TOGETHER places, T_k at x[i] in value[k][i]: to the bit, and quicker.
enum { SB_COMPLIANCE_TOGETHER = 8 };
void sb_compliance_modes_together(const SbSurfaceCompliance *c, const double *x,
                                  double (*value)[SB_COMPLIANCE_TOGETHER],
                                  double (*slope)[SB_COMPLIANCE_TOGETHER]);

// Integrals of T_k(z(x)) dx over [from, to], clipped to the window, for k < modes [m].
void sb_compliance_integrals(const SbSurfaceCompliance *c, double from, double to, double *out);

// A dry frictionless contact: p = ambient step + sqrt(1 - z^2) sum a_k U_k(z), z over the contact.
typedef struct {
  double left, right;                   // edges [m]
  double pressure_left, pressure_right; // ambient, gauge [Pa]
  double load;                          // int (p - ambient), left ambient for x < 0 [N/m]
  double peak;                          // largest pressure, gauge [Pa]
  int count;
  double a[SB_COMPLIANCE_PRESSURES];  // [Pa]
  double moment[SB_COMPLIANCE_MODES]; // int p T_l(z) ds over the window [N/m]
  // Slope of the pressure at the edges: p - ambient -> edge sqrt(1 - z^2) there [Pa].
  double edge_left, edge_right;
  double residual; // largest slope of the gap inside the contact over the contact's own
} SbDryContact;

// Solves the unilateral contact: pressure above ambient between its edges, which are unknown, no
// gap there, no tension and no penetration outside. Spectral; Newton's method on coefficients and
// edges. SB_ERROR_NOT_CONVERGED; SB_ERROR_INFEASIBLE if the contact leaves the window, tears or
// would have to be in two parts. About 0.1 ms.
SbStatus sb_dry_contact(SbDryContact *out, const SbSurfaceCompliance *c, double load,
                        double pressure_left, double pressure_right, SbReport *report);

// Pressure [Pa] at x, ambient outside the contact.
double sb_dry_contact_pressure(const SbDryContact *dry, double x);

// Gap [m] at x, 0 inside the contact.
double sb_dry_contact_gap(const SbDryContact *dry, const SbSurfaceCompliance *c, double x);

// Fills the pressure's slopes at the edges from its coefficients.
void sb_dry_contact_edges(SbDryContact *dry);

// Replaces the gap by the one whose dry contact has that pressure: edges, ambient pressures and
// coefficients, at most two less than the surface's modes.
void sb_compliance_of_pressure(SbSurfaceCompliance *c, const SbDryContact *pressure);

// The same for a given profile of pressure: `n` pairs x [m] and p [Pa]
// from one edge of the contact to the other, above the lower ambient pressure, between the ambient
// pressures. `order` coefficients (1 to 12) smooth the pressure. For fitments that know no gap of
// their own; with S = 0 the film's layers still see the right edges and slopes. SB_ERROR_INPUT.
SbStatus sb_compliance_match(SbSurfaceCompliance *c, int order, size_t n, const double *x,
                             const double *p, double pressure_left, double pressure_right,
                             SbReport *report);
