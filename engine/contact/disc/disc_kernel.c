// Green's function of the disc's boundary; derivation and split in the header.
#include "engine/contact/disc/disc_kernel.h"

#include <math.h>

SbDiscKernel sb_disc_kernel(double poisson_ratio) {
  const double kappa = 3.0 - 4.0 * poisson_ratio;
  return (SbDiscKernel){
      .e1 = (kappa - 1.0) / (kappa + 1.0),
      .e2 = 1.0 / (kappa + 1.0),
      .kappa_e2 = kappa / (kappa + 1.0),
  };
}

double sb_disc_compliance(double modulus, double poisson_ratio) {
  return 2.0 * (1.0 - poisson_ratio * poisson_ratio) / (M_PI * modulus);
}

SbDiscPoint sb_disc_point(double angle) {
  return (SbDiscPoint){.angle = angle, .sin = sin(angle), .cos = cos(angle)};
}

SbDiscPoint sb_disc_point_at(double sine) {
  return (SbDiscPoint){.angle = asin(sine), .sin = sine, .cos = sqrt((1.0 - sine) * (1.0 + sine))};
}

// Terms without the logarithm and the jump: cosine and sine of a, and the regular part.
typedef struct {
  double cos_a, sin_a; // of a = theta - phi
  double cross;        // factor of e1 H: m_x n_y - m_y n_x
  double dot;          // factor of L: m.n
  double regular;
} Parts;

static Parts split(const SbDiscKernel *k, SbDiscPoint to, SbDiscVector m, SbDiscPoint from,
                   SbDiscVector n) {
  const double mr = m.x * to.sin + m.y * to.cos;
  const double mt = m.x * to.cos - m.y * to.sin;
  const double nr = n.x * from.sin + n.y * from.cos;
  const double nt = n.x * from.cos - n.y * from.sin;
  Parts out;
  out.cos_a = to.cos * from.cos + to.sin * from.sin;
  out.sin_a = to.sin * from.cos - to.cos * from.sin;
  out.dot = m.x * n.x + m.y * n.y;
  out.cross = m.x * n.y - m.y * n.x;
  out.regular = -0.5 * mr * nr - k->kappa_e2 * mt * nt +
                k->e2 * (out.cos_a * (mt * nt - mr * nr) + out.sin_a * (mt * nr + mr * nt));
  return out;
}

double sb_disc_kernel_value(const SbDiscKernel *kernel, SbDiscPoint to, SbDiscVector m,
                            SbDiscPoint from, SbDiscVector n) {
  const Parts part = split(kernel, to, m, from, n);
  // a brought into [-pi, pi]; 2 - 2 cos a without cancellation where the points are close.
  double a = to.angle - from.angle;
  a -= 2.0 * M_PI * rint(a * (0.5 / M_PI));
  const double ds = to.sin - from.sin;
  const double dc = to.cos - from.cos;
  const double log_part = -0.5 * log(ds * ds + dc * dc);
  const double h = 0.5 * (a > 0.0 ? M_PI - a : -M_PI - a);
  return part.dot * log_part + kernel->e1 * part.cross * h + part.regular;
}

double sb_disc_kernel_mirror(const SbDiscKernel *kernel, SbDiscPoint to, SbDiscVector m,
                             SbDiscPoint from, SbDiscVector n) {
  const SbDiscPoint below = {.angle = M_PI - from.angle, .sin = from.sin, .cos = -from.cos};
  return sb_disc_kernel_value(kernel, to, m, below, (SbDiscVector){n.x, -n.y});
}

double sb_disc_kernel_pair(const SbDiscKernel *kernel, SbDiscPoint to, SbDiscVector m,
                           SbDiscPoint from, SbDiscVector n) {
  return sb_disc_kernel_value(kernel, to, m, from, n) +
         sb_disc_kernel_mirror(kernel, to, m, from, n);
}

double sb_disc_kernel_smooth(const SbDiscKernel *kernel, SbDiscPoint to, SbDiscVector m,
                             SbDiscPoint from, SbDiscVector n, double radial, double *kink) {
  const Parts part = split(kernel, to, m, from, n);
  const double a = to.angle - from.angle;
  // cos((theta + phi)/2) and cos(a/2), both positive on the upper half.
  const double cos_mean = sqrt(0.5 * (1.0 + to.cos * from.cos - to.sin * from.sin));
  const double cos_half = sqrt(0.5 * (1.0 + part.cos_a));
  // For radial directions the cross product is sin a, so that e1 cross H = e1 (pi/2 |sin a| - a/2
  // sin a), and |sin a| = |sin theta - sin phi| cos(a/2)/cos((theta + phi)/2).
  *kink = kernel->e1 * 0.5 * M_PI * radial * cos_half / cos_mean;
  return part.dot * log(cos_mean) - 0.5 * kernel->e1 * part.cross * a + part.regular;
}
