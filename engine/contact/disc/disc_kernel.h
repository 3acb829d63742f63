// Closed-form surface displacement of a linear plane-strain disc under boundary point forces, split
// into the half-plane's logarithm and a smooth rest.
//
// Angles are from the top of the disc, clockwise: a boundary point is R (sin t, cos t), e_r points
// outward, e_t to growing t. For a unit point force (n_r, n_t) at angle phi the displacement at
// theta, with a = theta - phi, L = -ln(2 |sin(a/2)|), H = sgn(a) (pi - |a|)/2, is C times
//
//   u_r = n_r (cos a L + e1 sin a H - 1/2 - e2 cos a) + n_t (sin a L - e1 cos a H + e2 sin a)
//   u_t = n_r (-sin a L + e1 cos a H + e2 sin a) + n_t (cos a L + e1 sin a H - kappa e2 + e2 cos a)
//
// C = 2 (1 - nu^2)/(pi E), kappa = 3 - 4 nu, e1 = (kappa - 1)/(kappa + 1), e2 = 1/(kappa + 1): the
// sum of Michell's series for a disc under boundary tractions. Net force and couple are dropped, so
// only sums over forces in equilibrium mean anything, up to a rigid motion. Two opposite vertical
// forces give the "vertical" kernel of docs/verification.md, two opposite radial ones Hertz and
// Michell's.
//
// In Cartesian components the singular part is C (m.n) L, and with x = R sin t
//   L = -ln|x - x'|/R + ln cos((theta + phi)/2),
// so that the kernel is the half-plane's plus something smooth for any contact that leaves the
// equator alone.
#pragma once

#include <stdbool.h>

// Dimensionless elastic constants of the kernel; lengths in R, C = 1.
typedef struct {
  double e1, e2, kappa_e2;
} SbDiscKernel;

// A vector in Cartesian components.
typedef struct {
  double x, y;
} SbDiscVector;

// A boundary point: its angle [rad] with sine and cosine.
typedef struct {
  double angle, sin, cos;
} SbDiscPoint;

// Poisson's ratio in [0, 0.5).
SbDiscKernel sb_disc_kernel(double poisson_ratio);

// C in displacement = C x force: 2 (1 - nu^2)/(pi E) [1/Pa].
double sb_disc_compliance(double modulus, double poisson_ratio);

// The boundary point at an angle, and the one with a given sine in (-1, 1) on the upper half.
SbDiscPoint sb_disc_point(double angle);
SbDiscPoint sb_disc_point_at(double sine);

// Displacement along m at `to` by a force n at `from`, the whole kernel; the points must differ.
double sb_disc_kernel_value(const SbDiscKernel *kernel, SbDiscPoint to, SbDiscVector m,
                            SbDiscPoint from, SbDiscVector n);

// The same for the force and its mirror image below the horizontal axis together.
double sb_disc_kernel_pair(const SbDiscKernel *kernel, SbDiscPoint to, SbDiscVector m,
                           SbDiscPoint from, SbDiscVector n);

// The mirror image below the horizontal axis alone.
double sb_disc_kernel_mirror(const SbDiscKernel *kernel, SbDiscPoint to, SbDiscVector m,
                             SbDiscPoint from, SbDiscVector n);

// The kernel without -(m.n) ln|sin theta - sin phi| and without *kink |sin theta - sin phi|; smooth
// also where the points coincide. Both lie on the upper half, angles in (-pi/2, pi/2). The
// directions are either the same at both points (`radial` = 0, no kink) or both radial, with
// product of magnitudes `radial`; a traction that turns in another way has a jump and does not
// split so.
double sb_disc_kernel_smooth(const SbDiscKernel *kernel, SbDiscPoint to, SbDiscVector m,
                             SbDiscPoint from, SbDiscVector n, double radial, double *kink);
