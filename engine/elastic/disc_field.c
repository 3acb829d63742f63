// Michell's series from the tractions of a solved disc, and the smooth compliance; see the header.
#include "engine/elastic/disc_field.h"

#include <math.h>

#include "engine/elastic/disc_kernel.h"
#include "engine/elastic/disc_system.h"

// ---- tractions

// Fourier sums while they are collected: sigma_r = sum c_n cos n alpha, tau = sum s_n sin n alpha.
typedef struct {
  double c[SB_DISC_MODES + 1];
  double s[SB_DISC_MODES + 1];
} Sums;

// Adds a force (per R, same unit as stress) at a boundary point and its mirror image below: alpha =
// angle - pi/2.
static void add_pair(Sums *sums, SbDiscPoint at, SbDiscVector force) {
  const double fr = force.x * at.sin + force.y * at.cos;
  const double ft = force.x * at.cos - force.y * at.sin;
  // cos and sin of n alpha by recurrence; cos alpha = sin(angle), sin alpha = -cos(angle).
  double cn = 1.0;
  double sn = 0.0;
  for (int n = 0; n <= SB_DISC_MODES; n++) {
    sums->c[n] += (n == 0 ? 1.0 : 2.0) / M_PI * fr * cn;
    sums->s[n] += 2.0 / M_PI * ft * sn;
    const double next = cn * at.sin + sn * at.cos;
    sn = sn * at.sin - cn * at.cos;
    cn = next;
  }
}

enum { FINE = 1024 };

static double excess_between(const double *nodal, size_t n, double tau) {
  double above = 0.0;
  double below = 0.0;
  for (size_t j = 0; j < n; j++) {
    const double node = M_PI * ((double)j + 0.5) / (double)n;
    const double difference = tau - cos(node);
    if (fabs(difference) < 1e-14) {
      return nodal[j];
    }
    const double w = (j % 2 == 0 ? 1.0 : -1.0) * sin(node) / difference;
    above += w * nodal[j];
    below += w;
  }
  return above / below;
}

static void collect(Sums *sums, const SbDisc *disc, double pressure) {
  SbDiscSystem directions = {.radial = disc->problem.variant == SB_DISC_RADIAL};
  const double centre = 0.5 * (disc->edge_left + disc->edge_right);
  const double half = 0.5 * (disc->edge_right - disc->edge_left);
  for (int i = 0; i < FINE; i++) {
    // Bore and its image, Gauss-Chebyshev with F/sqrt(1 - tau^2) as the density.
    const double eta = M_PI * (i + 0.5) / FINE;
    const double tau = cos(eta);
    const SbDiscPoint p = sb_disc_point_at(centre + half * tau);
    const double load = M_PI / FINE *
                        (excess_between(disc->excess, disc->points, tau) +
                         pressure * half * sin(eta) * sb_disc_system_step(tau));
    const SbDiscVector f = sb_disc_system_force(&directions, p);
    add_pair(sums, p, (SbDiscVector){load * f.x, load * f.y});
    if (disc->wall_points == 0) {
      continue;
    }

    // The wall is its own image: half of each point and its mirror. It is the bore turned by 90
    // degrees.
    const SbDiscPoint local = sb_disc_point_at(disc->edge_wall * tau);
    const SbDiscVector g = sb_disc_system_force(&directions, local);
    const double push =
        0.5 * M_PI / FINE * excess_between(disc->wall_excess, disc->wall_points, tau);
    const SbDiscPoint on_wall = {
        .angle = local.angle + 0.5 * M_PI, .sin = local.cos, .cos = -local.sin};
    add_pair(sums, on_wall, (SbDiscVector){push * g.y, -push * g.x});

    // Fluid on the left arc, upper half and image.
    const double arc = asin(disc->edge_left) + 0.5 * M_PI;
    const SbDiscPoint wet = sb_disc_point(-0.5 * M_PI + arc * (i + 0.5) / FINE);
    const double force = pressure * arc / FINE;
    add_pair(sums, wet, (SbDiscVector){-force * wet.sin, -force * wet.cos});
  }
}

void sb_disc_field_init(SbDiscField *field, const SbDisc *disc) {
  const SbDiscProblem *in = &disc->problem;
  const double nu = in->poisson_ratio;
  const double both = fmin(in->pressure_left, in->pressure_right);
  *field = (SbDiscField){
      .radius = 0.5 * in->diameter,
      .shear_modulus = 0.5 * in->modulus / (1.0 + nu),
      .kappa = 3.0 - 4.0 * nu,
      .uniform = -both,
      .uniform_strain = -both * (1.0 + nu) * (1.0 - 2.0 * nu) / in->modulus,
      .shift = disc->shift,
      .mirrored = disc->mirrored,
  };
  if (!disc->touches) {
    return;
  }
  Sums sums = {{0.0}, {0.0}};
  const double compliance = sb_disc_compliance(in->modulus, nu);
  collect(&sums, disc, fabs(in->pressure_left - in->pressure_right) * compliance);

  // n (1 - n) a + (n + 2 - n^2) b = c and n (n - 1) a + n (n + 1) b = s; for n = 1 the part that is
  // in equilibrium, for n = 0 a uniform stress.
  field->b[0] = 0.5 * sums.c[0] / compliance;
  field->b[1] = 0.25 * (sums.c[1] + sums.s[1]) / compliance;
  for (int n = 2; n <= SB_DISC_MODES; n++) {
    const double b = (sums.c[n] + sums.s[n]) / (2.0 * n + 2.0);
    field->a[n] = (sums.s[n] - n * (n + 1.0) * b) / (n * (n - 1.0)) / compliance;
    field->b[n] = b / compliance;
  }
}

void sb_disc_field_at(const SbDiscField *field, double x, double y, SbDiscState *out) {
  // The series knows fluid on the left.
  const double sign = field->mirrored ? -1.0 : 1.0;
  const double own_x = sign * x / field->radius;
  const double own_y = y / field->radius;
  const double r = fmin(1.0, hypot(own_x, own_y));
  const double alpha = r > 0.0 ? atan2(-own_y, own_x) : 0.0; // clockwise from the right
  const double ca = cos(alpha);
  const double sa = sin(alpha);

  // n = 0 and 1, then the powers r^(n-2), r^n by recurrence.
  const double kappa = field->kappa;
  const double *a = field->a;
  const double *b = field->b;
  double ur = (kappa - 1.0) * b[0] * r + (kappa - 2.0) * b[1] * r * r * ca;
  double ut = (kappa + 2.0) * b[1] * r * r * sa;
  double sr = 2.0 * b[0] + 2.0 * b[1] * r * ca;
  double st = 2.0 * b[0] + 6.0 * b[1] * r * ca;
  double tau = 2.0 * b[1] * r * sa;
  double cn = ca;
  double sn = sa;
  double power = 1.0; // r^(n-2)
  for (int n = 2; n <= SB_DISC_MODES; n++) {
    const double next = cn * ca - sn * sa;
    sn = sn * ca + cn * sa;
    cn = next;
    const double an = a[n] * power;
    const double bn = b[n] * power * r * r;
    ur += (-n * an + (kappa - n - 1.0) * bn) * r * cn;
    ut += (n * an + (kappa + n + 1.0) * bn) * r * sn;
    sr += (n * (1.0 - n) * an + (n + 2.0 - (double)n * n) * bn) * cn;
    st += (n * (n - 1.0) * an + (n + 2.0) * (n + 1.0) * bn) * cn;
    tau += (n * (n - 1.0) * an + n * (n + 1.0) * bn) * sn;
    power *= r;
  }
  const double scale = field->radius / (2.0 * field->shear_modulus);
  ur = ur * scale + field->uniform_strain * field->radius * r;
  ut *= scale;
  sr += field->uniform;
  st += field->uniform;

  // e_r = (cos alpha, -sin alpha), e_alpha = (-sin alpha, -cos alpha) in x, y.
  out->ux = sign * (ur * ca - ut * sa) + field->shift;
  out->uy = -ur * sa - ut * ca;
  out->sxx = sr * ca * ca + st * sa * sa - 2.0 * tau * sa * ca;
  out->syy = sr * sa * sa + st * ca * ca + 2.0 * tau * sa * ca;
  out->sxy = sign * (-sr * sa * ca + st * sa * ca - tau * (ca * ca - sa * sa));
}

// ---- compliance

double sb_disc_smooth_compliance(double radius, double x, double x_prime) {
  const SbDiscPoint to = sb_disc_point_at(x / radius);
  const SbDiscPoint from = sb_disc_point_at(x_prime / radius);
  // 2 ln cos((theta + phi)/2) = ln((1 + cos(theta + phi))/2).
  return log(1.0 + to.cos * from.cos - to.sin * from.sin) - to.cos * from.cos;
}

SbStatus sb_disc_smooth_matrix(double *matrix, const double *x, size_t n, double radius,
                               double modulus, double poisson_ratio, SbReport *report) {
  for (size_t i = 0; i < n; i++) {
    if (!(fabs(x[i]) < radius)) {
      return sb_fail(report, SB_ERROR_RANGE, "point %g m is not inside the disc of radius %g m",
                     x[i], radius);
    }
  }
  const double compliance = sb_disc_compliance(modulus, poisson_ratio);
  for (size_t i = 0; i < n; i++) {
    for (size_t j = 0; j < n; j++) {
      matrix[i * n + j] = compliance * sb_disc_smooth_compliance(radius, x[i], x[j]);
    }
  }
  return sb_succeed(report);
}
