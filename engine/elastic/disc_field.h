// Displacement and stress inside the linear disc, and its surface compliance for the film solver.
//
// Interior: the boundary tractions of a solved disc (contacts, fluid) are expanded in cos and sin
// of n alpha, alpha from the horizontal axis, and Michell's series gives the field (the general
// solution of plane strain in a disc; the thesis sums point loads, 6.71, instead). Only for
// drawing: it is computed where it is asked for, never in a solve. SB_DISC_MODES terms: square-root
// edges of the pressure make the stress at the very surface ripple by about 1 % of the peak beside
// a contact edge; displacements are good to 1e-4 of the interference, everything deeper to
// rounding.
//
// Compliance: the displacement of the contact surface by pressure on it, mirrored on the other
// flat, is
//   u(x) = C int p(x') [-ln(|x - x'|/R) + S(x, x')] dx',   C = 2 (1 - nu^2)/(pi E)
//   S = 2 ln cos((theta + phi)/2) + ln 2 - cos theta cos phi,   x = R sin theta, x' = R sin phi
// for the vertical kernel: the half-plane's logarithm, on which film solvers stand, plus a smooth
// difference that needs no fine mesh. Exact; it leaves out that the groove wall answers too.
#pragma once

#include <stddef.h>

#include "engine/elastic/disc.h"

enum { SB_DISC_MODES = 384 };

typedef struct {
  double radius;         // [m]
  double shear_modulus;  // mu [Pa]
  double kappa;          // 3 - 4 nu
  double uniform;        // stress on all sides besides, tension positive [Pa]
  double uniform_strain; // its radial strain
  double shift;          // of the centre to +x [m]
  bool mirrored;
  double a[SB_DISC_MODES + 1]; // Airy function sum (a_n r^n + b_n r^(n+2)) cos n alpha, r in R [Pa]
  double b[SB_DISC_MODES + 1];
} SbDiscField;

// State at a point: displacement [m] with the section's shift in it, stresses [Pa], tension
// positive.
typedef struct {
  double ux, uy;
  double sxx, syy, sxy;
} SbDiscState;

// Expands the tractions of a solved disc; a disc that does not touch gives the uniform state. About
// 0.5 ms.
void sb_disc_field_init(SbDiscField *field, const SbDisc *disc);

// State at the material point (x, y) [m] of the undeformed disc, its centre at the origin, y to the
// bore. Points outside are moved radially onto the boundary.
void sb_disc_field_at(const SbDiscField *field, double x, double y, SbDiscState *out);

// S(x, x') for |x|, |x'| < R [m].
double sb_disc_smooth_compliance(double radius, double x, double x_prime);

// Fills the n x n matrix (by rows) C S(x_i, x_j) [1/Pa per unit length of dx'], so that the disc's
// deflection is the half-plane's C int -ln(|x - x'|/R) p dx' plus sum_j matrix_ij p_j w_j with any
// quadrature weights w_j [m]. SB_ERROR_RANGE if a point is not inside the disc.
SbStatus sb_disc_smooth_matrix(double *matrix, const double *x, size_t n, double radius,
                               double modulus, double poisson_ratio, SbReport *report);
