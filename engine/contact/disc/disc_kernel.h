// Closed-form surface displacement of a linear plane-strain disc under boundary point forces, split
// into the half-plane's logarithm and a smooth remainder. The functions have no state and may be
// called concurrently.
//
// Angles are from the top of the disc, clockwise: a boundary point is R (sin t, cos t), e_r points
// outward, e_t to increasing t. For a unit point force (n_r, n_t) at the angle phi the displacement
// at theta, with a = theta - phi, L = -ln(2 |sin(a/2)|), H = sgn(a) (pi - |a|)/2, is C times
//
//   u_r = n_r (cos a L + e1 sin a H - 1/2 - e2 cos a) + n_t (sin a L - e1 cos a H + e2 sin a)
//   u_t = n_r (-sin a L + e1 cos a H + e2 sin a) + n_t (cos a L + e1 sin a H - kappa e2 + e2 cos a)
//
// C = 2 (1 - nu^2)/(pi E), kappa = 3 - 4 nu, e1 = (kappa - 1)/(kappa + 1), e2 = 1/(kappa + 1): the
// sum of Michell's series for a disc under boundary tractions. Net force and couple are omitted, so
// only sums over forces in equilibrium are defined, up to a rigid motion. Two opposite vertical
// forces give the "vertical" kernel of docs/verification.md, two opposite radial ones that of Hertz
// and Michell.
//
// In Cartesian components (x to the right, y up) the singular part is C (m.n) L, and with x = R sin
// t
//   L = -ln|x - x'|/R + ln cos((theta + phi)/2),
// so the kernel is the half-plane's plus a smooth function for contacts that exclude the equator.
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

// Returns the constants of the kernel for Poisson's ratio in [0, 0.5).
SbDiscKernel sb_disc_kernel(double poisson_ratio);

// Returns C = 2 (1 - nu^2)/(pi E) [1/Pa]: displacement [m] = C x kernel x force [N/m].
double sb_disc_compliance(double modulus, double poisson_ratio);

// Returns the boundary point at an angle [rad].
SbDiscPoint sb_disc_point(double angle);

// Returns the boundary point on the upper half with the sine `sine` in (-1, 1).
SbDiscPoint sb_disc_point_at(double sine);

// Returns the displacement at `to` in the direction m due to a force n at `from` (full kernel, C =
// 1). The points must differ.
double sb_disc_kernel_value(const SbDiscKernel *kernel, SbDiscPoint to, SbDiscVector m,
                            SbDiscPoint from, SbDiscVector n);

// Returns the displacement of sb_disc_kernel_value() due to the force n at `from` and to its mirror
// image: the force (n.x, -n.y) at the mirror image of `from` below the horizontal axis.
double sb_disc_kernel_pair(const SbDiscKernel *kernel, SbDiscPoint to, SbDiscVector m,
                           SbDiscPoint from, SbDiscVector n);

// Returns the displacement of sb_disc_kernel_pair() that is due to the mirror image only; `from`
// and n are those of the force on the upper half.
double sb_disc_kernel_mirror(const SbDiscKernel *kernel, SbDiscPoint to, SbDiscVector m,
                             SbDiscPoint from, SbDiscVector n);

// Returns the kernel without -(m.n) ln|sin theta - sin phi| and without *kink |sin theta - sin
// phi|, which is smooth also if the points coincide, and writes *kink. Both points are on the upper
// half, angles in (-pi/2, pi/2). Either m and n are the same directions at all points (`radial` =
// 0: no kink), or both are radial and `radial` is the product of their magnitudes.
double sb_disc_kernel_smooth(const SbDiscKernel *kernel, SbDiscPoint to, SbDiscVector m,
                             SbDiscPoint from, SbDiscVector n, double radial, double *kink);
