// The disc's linear system for given edges; see the header.
#include "engine/contact/disc/disc_system.h"

#include <math.h>
#include <string.h>

#include "engine/numeric/dense.h"
#include "engine/numeric/legendre.h"

// ---- rules

// Integral over [0, pi] of |cos e - cos f| cos(k f) df, the kink applied to T_k/sqrt(1 - tau^2).
static double kink_moment(int k, double e) {
  const double c = cos(e);
  double part = 0.5 * sin((k + 1) * e) / (k + 1);
  part += k == 1 ? 0.5 * e : 0.5 * sin((k - 1) * e) / (k - 1);
  part -= c * (k == 0 ? e : sin(k * e) / k);
  double whole = k == 1 ? 0.5 * M_PI : 0.0;
  whole -= k == 0 ? M_PI * c : 0.0;
  return 2.0 * part - whole;
}

void sb_disc_system_points(SbDiscSystem *system, size_t n) {
  system->n = n;
  sb_legendre_gauss(system->gauss_x, system->gauss_w, SB_DISC_GAUSS);
  for (int i = 0; i < SB_DISC_GAUSS; i++) {
    system->gauss_x[i] = 0.5 * (1.0 + system->gauss_x[i]);
    system->gauss_w[i] *= 0.5;
  }
  // cos(k eta) at all points.
  double circle[4 * SB_DISC_POINTS_MAX]; // cos(m pi/2n), eta = (2 j + 1) pi/2n
  for (size_t m = 0; m < 4 * n; m++) {
    circle[m] = cos(M_PI * (double)m / (2.0 * (double)n));
  }
  for (size_t j = 0; j < n; j++) {
    system->tau[j] = circle[2 * j + 1];
  }
  // F = sum c_k T_k with c_k = (2 - [k = 0])/n sum_j F_j cos(k eta_j); the logarithm turns
  // T_k/sqrt(1 - tau^2) into pi/k T_k, or pi ln 2 for k = 0.
  memset(system->log_weight, 0, sizeof system->log_weight);
  memset(system->kink_weight, 0, sizeof system->kink_weight);
  for (size_t i = 0; i < n; i++) {
    for (size_t k = 0; k < n; k++) {
      double scale = (k == 0 ? 1.0 : 2.0) / (double)n;
      double log_part =
          scale * (k == 0 ? M_PI * log(2.0) : M_PI / (double)k) * circle[k * (2 * i + 1) % (4 * n)];
      double kink_part = scale * kink_moment((int)k, M_PI * ((double)i + 0.5) / (double)n);
      for (size_t j = 0; j < n; j++) {
        system->log_weight[i * n + j] += log_part * circle[k * (2 * j + 1) % (4 * n)];
        system->kink_weight[i * n + j] += kink_part * circle[k * (2 * j + 1) % (4 * n)];
      }
    }
  }
}

// ---- directions: of the contact force per unit projected length (vertical or radial, inward), and
// of the measured displacement

static SbDiscVector force_at(const SbDiscSystem *system, SbDiscPoint point) {
  return system->radial ? (SbDiscVector){-point.sin / point.cos, -1.0} : (SbDiscVector){0.0, -1.0};
}

static SbDiscVector measure_at(const SbDiscSystem *system, SbDiscPoint point) {
  return system->radial ? (SbDiscVector){-point.sin, -point.cos} : (SbDiscVector){0.0, -1.0};
}

// The wall is the bore turned by 90 degrees: psi from the horizontal, down.
static SbDiscPoint turn_point(SbDiscPoint p) {
  return (SbDiscPoint){.angle = p.angle + 0.5 * M_PI, .sin = p.cos, .cos = -p.sin};
}

static SbDiscVector turn(SbDiscVector v) {
  return (SbDiscVector){v.y, -v.x};
}

double sb_disc_system_step(double tau) {
  const double u = 0.5 * (1.0 + tau);
  return 1.0 - u * u * u * u * (35.0 + u * (-84.0 + u * (70.0 - 20.0 * u)));
}

// ---- known loads

double sb_disc_system_arc(const SbDiscSystem *s, SbDiscPoint to, SbDiscVector m, double from,
                          double length, SbDiscAction action) {
  double sum = 0.0;
  for (int i = 0; i < SB_DISC_GAUSS; i++) {
    const double x = s->gauss_x[i];
    const SbDiscPoint p = sb_disc_point(from + length * x * x * x);
    const SbDiscVector inward = action == SB_DISC_NORMAL ? (SbDiscVector){-p.sin, -p.cos}
                                : action == SB_DISC_HEIGHT
                                    ? (SbDiscVector){-p.sin, 0.0}
                                    : (SbDiscVector){copysign(1.0, -p.sin), 0.0};
    sum += 3.0 * x * x * s->gauss_w[i] * fabs(length) *
           sb_disc_kernel_pair(&s->kernel, to, m, p, inward);
  }
  return sum;
}

// Inward displacement at `to` along m by the fluid on the left arc and by the known step over the
// contact. The logarithm at tau_to (inside the contact if |tau_to| < 1) and the near one at the
// left edge are met by cubic grading.
static double known_displacement(const SbDiscSystem *s, SbDiscPoint to, SbDiscVector m,
                                 double tau_to) {
  const double split = fmax(-1.0, fmin(1.0, tau_to)), theta_left = asin(s->centre - s->half);
  double sum = sb_disc_system_arc(s, to, m, theta_left, -(theta_left + 0.5 * M_PI), SB_DISC_NORMAL);
  // The step, left and right of the target.
  for (int i = 0; i < 2 * SB_DISC_GAUSS; i++) {
    const double x = s->gauss_x[i / 2], length = i % 2 == 0 ? -1.0 - split : 1.0 - split;
    const double tau = split + length * x * x * x;
    const SbDiscPoint on_flat = sb_disc_point_at(s->centre + s->half * tau);
    sum += 3.0 * x * x * s->gauss_w[i / 2] * fabs(length) * s->half * sb_disc_system_step(tau) *
           sb_disc_kernel_pair(&s->kernel, to, m, on_flat, force_at(s, on_flat));
  }
  return s->pressure * sum;
}

// ---- the system

// A contact with itself: n x n block at (row, row) of the matrix. The bore is its own upper half
// and has an image below; the wall is its own image.
static void add_self(SbDiscSystem *s, const SbDiscPoint *point, double half, size_t row,
                     size_t rows, bool image) {
  const size_t n = s->n;
  const double log_half = log(half);
  for (size_t i = 0; i < n; i++) {
    const SbDiscVector m = measure_at(s, point[i]);
    for (size_t j = 0; j < n; j++) {
      const SbDiscVector f = force_at(s, point[j]);
      const double dot = m.x * f.x + m.y * f.y;
      double kink;
      double smooth = sb_disc_kernel_smooth(&s->kernel, point[i], m, point[j], f,
                                            s->radial ? 1.0 / point[j].cos : 0.0, &kink) -
                      dot * log_half;
      if (image) {
        smooth += sb_disc_kernel_mirror(&s->kernel, point[i], m, point[j], f);
      }
      s->matrix[row + i + (row + j) * rows] = dot * s->log_weight[i * n + j] +
                                              kink * half * s->kink_weight[i * n + j] +
                                              M_PI / (double)n * smooth;
    }
  }
}

// Sets the wall's part of the system, at the points `side`. Wall at depth X: inward displacement X
// - (1 - cos psi), and its balance with the fluid.
static void add_wall(SbDiscSystem *s, const SbDiscPoint *bore, const SbDiscPoint *side,
                     double width, double left) {
  const size_t n = s->n, rows = 2 * n + 1;
  const double centre = s->centre, half = s->half;
  add_self(s, side, width, n, rows, false);
  for (size_t i = 0; i < n; i++) {
    const SbDiscPoint to = turn_point(side[i]);
    const SbDiscVector m_wall = turn(measure_at(s, side[i]));
    const SbDiscVector m_bore = measure_at(s, bore[i]);
    for (size_t j = 0; j < n; j++) {
      s->matrix[n + i + j * rows] =
          M_PI / (double)n *
          sb_disc_kernel_pair(&s->kernel, to, m_wall, bore[j], force_at(s, bore[j]));
      s->matrix[i + (n + j) * rows] =
          M_PI / (double)n *
          sb_disc_kernel_value(&s->kernel, bore[i], m_bore, turn_point(side[j]),
                               turn(force_at(s, side[j])));
    }
    s->matrix[i + 2 * n * rows] = 0.0;
    s->matrix[n + i + 2 * n * rows] = -1.0;
    s->solution[i] -= known_displacement(s, bore[i], m_bore, s->tau[i]);
    s->solution[n + i] = side[i].cos - 1.0 - known_displacement(s, to, m_wall, 2.0) -
                         s->hydrostatic * (s->radial ? 1.0 : side[i].cos);
    // Equilibrium along x: wall load = fluid on the height between the left edges, less what
    // radial contact forces carry.
    s->matrix[2 * n + i * rows] = -2.0 * M_PI / (double)n * force_at(s, bore[i]).x;
    s->matrix[2 * n + (n + i) * rows] = M_PI / (double)n;
  }
  s->matrix[2 * n + 2 * n * rows] = 0.0;
  s->solution[2 * n] = 2.0 * s->pressure * sqrt(1.0 - left * left);
  for (int i = 0; i < SB_DISC_GAUSS; i++) {
    const double tau = 2.0 * s->gauss_x[i] - 1.0;
    const SbDiscVector force = force_at(s, sb_disc_point_at(centre + half * tau));
    s->solution[2 * n] +=
        4.0 * s->gauss_w[i] * half * s->pressure * sb_disc_system_step(tau) * force.x;
  }
}

// Writes the residuals: the solved pressures' values at the edges over their means. Returns whether
// they are finite.
static bool edge_values(double *residual, SbDiscSystem *s, bool wall) {
  const size_t n = s->n;
  bool finite = true;
  for (int contact = 0; contact < (wall ? 2 : 1); contact++) {
    const double *F = &s->solution[contact == 0 ? 0 : n];
    double mean = 0.0, at_left = 0.0, at_right = 0.0;
    sb_chebyshev_coefficients(s->series[contact], F, (int)n);
    for (size_t j = 0; j < n; j++) {
      mean += fabs(F[j]) / (double)n;
      at_left += s->series[contact][j];
      at_right += (j % 2 == 0 ? 1.0 : -1.0) * s->series[contact][j];
    }
    residual[2 * contact] = at_right / mean;
    if (wall && contact == 0) {
      residual[1] = at_left / mean;
    }
    finite = finite && isfinite(at_left / mean) && isfinite(at_right / mean);
  }
  return finite;
}

bool sb_disc_system_solve(double *residual, const double *edges, void *system) {
  SbDiscSystem *s = system;
  const size_t n = s->n;
  const bool wall = s->pressure != 0.0;
  const size_t rows = wall ? 2 * n + 1 : n;
  const double right = edges[0], left = wall ? edges[1] : -right, width = wall ? edges[2] : 0.0;
  const double centre = s->centre = 0.5 * (left + right), half = s->half = 0.5 * (right - left);
  // Bore and wall may meet in the corner, no further.
  if (!(left > -1.0 && right < 1.0 && half > 0.0) ||
      (wall && !(width > 0.0 && width < 1.0 && width * width + right * right < 1.0 + 1e-12))) {
    return false;
  }
  SbDiscPoint bore[SB_DISC_POINTS_MAX] = {{0}};
  SbDiscPoint side[SB_DISC_POINTS_MAX] = {{0}}; // of the wall, turned to the top
  for (size_t i = 0; i < n; i++) {
    bore[i] = sb_disc_point_at(centre + half * s->tau[i]);
    side[i] = sb_disc_point_at(width * s->tau[i]);
  }

  // Bore: the flat is met where the inward displacement is the circle's height over it.
  add_self(s, bore, half, 0, rows, true);
  for (size_t i = 0; i < n; i++) {
    const double c = bore[i].cos;
    s->solution[i] = c - s->half_space - s->hydrostatic * (s->radial ? 1.0 : c);
  }

  if (wall) {
    add_wall(s, bore, side, width, left);
  }

  if (!sb_eliminate(s->matrix, s->solution, rows)) {
    return false;
  }

  return edge_values(residual, s, wall);
}

double sb_disc_system_bulge(const SbDiscSystem *s) {
  const SbDiscPoint end = {.angle = 0.5 * M_PI, .sin = 1.0, .cos = 0.0};
  double sum = 0.0;
  for (size_t j = 0; j < s->n; j++) {
    const SbDiscPoint p = sb_disc_point_at(s->centre + s->half * s->tau[j]);
    sum += M_PI / (double)s->n * s->solution[j] *
           sb_disc_kernel_pair(&s->kernel, end, (SbDiscVector){1.0, 0.0}, p, force_at(s, p));
  }
  return sum;
}
