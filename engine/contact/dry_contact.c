// The dry contact on a surface of the header's kind, and the gap that has a given dry pressure.
//
// For p = sqrt(1 - z^2) U_k(z) on a half-plane of half-width a, the displacement's slope is -C pi
// T_{k+1}(z) inside and -C pi (z -+ sqrt(z^2 - 1))^{k+1} outside (Johnson, section 2.7; the finite
// Hilbert transform of Chebyshev's polynomials), so that smooth edges need no condition of their
// own: the form of the pressure holds it. Coefficients enter linearly, both edges by Newton's
// method. Leaves out contacts in several parts, which are refused.
#include <math.h>
#include <string.h>

#include "engine/contact/compliance.h"
#include "engine/numeric/dense.h"
#include "engine/numeric/legendre.h"

enum { QUADRATURE = 48, GAP_POINTS = 16, ORDER_MAX = SB_COMPLIANCE_PRESSURES + 2 };

// Gauss' rules of moments and of gaps, made once for a contact.
typedef struct {
  double node[QUADRATURE], weight[QUADRATURE];
  double gap_node[GAP_POINTS], gap_weight[GAP_POINTS];
} Rules;

static void make_rules(Rules *r) {
  sb_legendre_gauss(r->node, r->weight, QUADRATURE);
  sb_legendre_gauss(r->gap_node, r->gap_weight, GAP_POINTS);
}

// Moments of the pressure over the window, split: of each U_k, and of the ambient pressures.
typedef struct {
  double known[SB_COMPLIANCE_MODES];
  double basis[SB_COMPLIANCE_PRESSURES][SB_COMPLIANCE_MODES];
} Moments;

// Integrals of T_l(z) over [from, to] times `factor`, added to `out`.
static void add_constant(double *out, const SbSurfaceCompliance *c, double from, double to,
                         double factor) {
  double integral[SB_COMPLIANCE_MODES];
  sb_compliance_integrals(c, from, to, integral);
  for (int l = 0; l < c->modes; l++) {
    out[l] += factor * integral[l];
  }
}

static void moments_of(Moments *out, const Rules *rules, const SbSurfaceCompliance *c, double left,
                       double right, int count, double p_left, double p_right) {
  memset(out, 0, sizeof *out);
  const double middle = 0.5 * (left + right);
  const double half = 0.5 * (right - left);
  for (int q = 0; q < QUADRATURE; q++) {
    // z = -cos(theta): everything is smooth in theta.
    const double theta = 0.5 * M_PI * (1.0 + rules->node[q]);
    const double w = 0.5 * M_PI * rules->weight[q] * half * sin(theta);
    double value[SB_COMPLIANCE_MODES];
    sb_compliance_modes(c, middle - half * cos(theta), value, NULL);
    const double step = theta / M_PI; // 1/2 + asin(z)/pi
    for (int l = 0; l < c->modes; l++) {
      out->known[l] += w * (p_left * (1.0 - step) + p_right * step) * value[l];
    }
    // sqrt(1 - z^2) U_k(z) = sin((k + 1) (pi - theta)), by its recurrence.
    double basis = w * sin(theta);
    double before = 0.0;
    for (int k = 0; k < count; k++) {
      for (int l = 0; l < c->modes; l++) {
        out->basis[k][l] += basis * value[l];
      }
      const double next = -2.0 * cos(theta) * basis - before;
      before = basis;
      basis = next;
    }
  }
  add_constant(out->known, c, c->left, left, p_left);
  add_constant(out->known, c, right, c->right, p_right);
}

// Equations of a contact between two edges, linear in the coefficients: the gap's slope at count +
// 1 points and the load. Rows are scaled by the half-plane's slope under `unit`.
typedef struct {
  double matrix[ORDER_MAX][SB_COMPLIANCE_PRESSURES];
  double known[ORDER_MAX];
} Equations;

static void equations(Equations *out, const Rules *rules, const SbSurfaceCompliance *c, double left,
                      double right, int count, double load, double p_left, double p_right,
                      double unit) {
  const double C = sb_compliance_half_plane(c);
  const double half = 0.5 * (right - left);
  const double middle = 0.5 * (left + right);
  const double window = 0.5 * (c->right - c->left);
  const double low = fmin(p_left, p_right);
  Moments m;
  moments_of(&m, rules, c, left, right, count, p_left - low, p_right - low);
  for (int i = 0; i <= count; i++) {
    const double angle = M_PI * (i + 0.5) / (count + 1);
    const double x = middle + half * cos(angle);
    double slope;
    sb_compliance_gap(c, x, &slope);
    slope += C * (p_left - p_right) * log(half / window);
    // Slope of the smooth part at x by the moments.
    double by_moment[SB_COMPLIANCE_MODES] = {0};
    double value[SB_COMPLIANCE_MODES];
    double derivative[SB_COMPLIANCE_MODES];
    sb_compliance_modes(c, x, value, derivative);
    for (int k = 0; k < c->modes; k++) {
      for (int l = 0; l < c->modes; l++) {
        by_moment[l] += derivative[k] * c->smooth[k][l];
      }
    }
    for (int l = 0; l < c->modes; l++) {
      slope += by_moment[l] * m.known[l];
    }
    out->known[i] = slope / (C * M_PI * unit);
    for (int k = 0; k < count; k++) {
      double smooth = 0.0;
      for (int l = 0; l < c->modes; l++) {
        smooth += by_moment[l] * m.basis[k][l];
      }
      out->matrix[i][k] = -cos((k + 1) * angle) + smooth / (C * M_PI);
    }
  }
  memset(out->matrix[count + 1], 0, sizeof out->matrix[0]);
  const double scale = load / unit;
  out->matrix[count + 1][0] = 0.5 * M_PI * half / scale;
  out->known[count + 1] = ((p_left - p_right) * middle - load) / load;
}

// U_k at z = -1 and 1: (-1)^k (k + 1) and k + 1.
static void edge_factors(SbDryContact *d) {
  d->edge_left = -(d->pressure_left - d->pressure_right) / M_PI;
  d->edge_right = -d->edge_left;
  for (int k = 0; k < d->count; k++) {
    d->edge_left += (k % 2 == 0 ? 1.0 : -1.0) * (k + 1) * d->a[k];
    d->edge_right += (k + 1) * d->a[k];
  }
}

// First guess of the edges: Hertz on the parabola at the lowest point of the gap.
static bool first_edges(double *left, double *right, const SbSurfaceCompliance *c, double load) {
  enum { SAMPLES = 64 };
  double lowest = INFINITY;
  double at = 0.0;
  const double step = (c->right - c->left) / SAMPLES;
  for (int i = 1; i < SAMPLES; i++) {
    const double x = c->left + step * i;
    const double value = sb_compliance_gap(c, x, NULL);
    if (value < lowest) {
      lowest = value;
      at = x;
    }
  }
  const double here = sb_compliance_gap(c, at, NULL);
  const double curvature =
      (sb_compliance_gap(c, at - step, NULL) - 2.0 * here + sb_compliance_gap(c, at + step, NULL)) /
      (step * step);
  if (!(curvature > 0.0)) {
    return false;
  }
  double half = sqrt(8.0 * load / (M_PI * c->modulus * curvature));
  half = fmin(half, 0.45 * (c->right - c->left));
  *left = fmax(at - half, c->left + 0.02 * (c->right - c->left));
  *right = fmin(at + half, c->right - 0.02 * (c->right - c->left));
  return true;
}

// Gap beyond an edge: the integral of its slope from there.
static double gap_outside(const SbDryContact *d, const Rules *rules, const SbSurfaceCompliance *c,
                          double x) {
  const double C = sb_compliance_half_plane(c);
  const double half = 0.5 * (d->right - d->left);
  const double middle = 0.5 * (d->left + d->right);
  const double window = 0.5 * (c->right - c->left);
  const double edge = x < d->left ? d->left : d->right;
  double sum = 0.0;
  for (int q = 0; q < GAP_POINTS; q++) {
    // From the edge, where the slope starts like a square root: s = edge + t^2 (x - edge).
    const double t = 0.5 * (1.0 + rules->gap_node[q]);
    const double s = edge + t * t * (x - edge);
    const double z = (s - middle) / half;
    const double root = sqrt((fabs(z) - 1.0) * (fabs(z) + 1.0));
    const double small = z < 0.0 ? z + root : z - root;
    double slope;
    sb_compliance_gap(c, s, &slope);
    double smooth;
    sb_compliance_smooth(c, s, d->moment, &smooth);
    slope +=
        smooth + C * (d->pressure_left - d->pressure_right) * (log(half / window) + acosh(fabs(z)));
    double power = 1.0;
    for (int k = 0; k < d->count; k++) {
      power *= small;
      slope -= C * M_PI * d->a[k] * power;
    }
    sum += 0.5 * rules->gap_weight[q] * 2.0 * t * (x - edge) * slope;
  }
  return sum;
}

// No tension inside, no penetration outside.
static SbStatus check_signs(SbDryContact *d, const Rules *rules, const SbSurfaceCompliance *c,
                            SbReport *report) {
  enum { SAMPLES = 200 };
  const double low = fmin(d->pressure_left, d->pressure_right);
  d->peak = fmax(d->pressure_left, d->pressure_right);
  for (int i = 1; i < SAMPLES; i++) {
    const double x = d->left + 0.5 * (d->right - d->left) * (1.0 - cos(M_PI * i / SAMPLES));
    const double p = sb_dry_contact_pressure(d, x);
    d->peak = fmax(d->peak, p);
    if (p < low - 1e-6 * d->load / (d->right - d->left)) {
      return sb_fail(report, SB_ERROR_INFEASIBLE, "dry contact: tension at %g m", x);
    }
  }
  const double limit = 1e-7 * (d->right - d->left);
  for (int i = 1; i <= 16; i++) {
    if (gap_outside(d, rules, c, d->left - (d->left - c->left) * i / 16.0) < -limit ||
        gap_outside(d, rules, c, d->right + (c->right - d->right) * i / 16.0) < -limit) {
      return sb_fail(report, SB_ERROR_INFEASIBLE,
                     "dry contact: the surface touches outside the contact");
    }
  }
  return sb_succeed(report);
}

SbStatus sb_dry_contact(SbDryContact *out, const SbSurfaceCompliance *c, double load,
                        double pressure_left, double pressure_right, SbReport *report) {
  memset(out, 0, sizeof *out);
  enum { COUNT = 16, ITERATIONS_MAX = 40 };
  double left, right;
  if (c->modes < 3 || !(load > 0.0) || !first_edges(&left, &right, c, load)) {
    return sb_fail(report, SB_ERROR_INPUT, "dry contact: no convex gap or no load");
  }
  SbDryContact d = {.pressure_left = pressure_left,
                    .pressure_right = pressure_right,
                    .load = load,
                    .count = COUNT,
                    .residual = INFINITY};
  Rules rules;
  make_rules(&rules);
  const double unit = 2.0 * load / (M_PI * 0.5 * (right - left));
  double a[SB_COMPLIANCE_PRESSURES] = {1.0};
  const double width = c->right - c->left;
  double last = INFINITY;
  for (; d.iterations < ITERATIONS_MAX; d.iterations++) {
    enum { ORDER = COUNT + 2 };
    Equations here, there;
    const double step = 1e-5 * (right - left);
    equations(&here, &rules, c, left, right, COUNT, load, pressure_left, pressure_right, unit);
    double matrix[ORDER * ORDER];
    double b[ORDER];
    d.residual = 0.0;
    for (int i = 0; i < ORDER; i++) {
      b[i] = -here.known[i];
      for (int k = 0; k < COUNT; k++) {
        b[i] -= here.matrix[i][k] * a[k];
        matrix[k * ORDER + i] = here.matrix[i][k];
      }
      d.residual = fmax(d.residual, fabs(b[i]));
    }
    if (d.residual < 1e-13 || (d.residual < 1e-10 && d.residual > 0.5 * last)) {
      break;
    }
    last = d.residual;
    for (int edge = 0; edge < 2; edge++) {
      double *column = &matrix[(COUNT + edge) * ORDER];
      memset(column, 0, ORDER * sizeof *column);
      for (int side = -1; side <= 1; side += 2) {
        equations(&there, &rules, c, left + (edge == 0 ? side * step : 0.0),
                  right + (edge == 1 ? side * step : 0.0), COUNT, load, pressure_left,
                  pressure_right, unit);
        for (int i = 0; i < ORDER; i++) {
          double row = there.known[i];
          for (int k = 0; k < COUNT; k++) {
            row += there.matrix[i][k] * a[k];
          }
          column[i] += side * row / (2.0 * step) * width;
        }
      }
    }
    if (!sb_eliminate(matrix, b, ORDER)) {
      return sb_fail(report, SB_ERROR_NOT_CONVERGED, "dry contact: singular equations");
    }
    // The edges stay in the window and move by at most a third of the contact.
    const double moved = fmax(fabs(b[COUNT]), fabs(b[COUNT + 1])) * width;
    double factor = fmin(1.0, (right - left) / (3.0 * fmax(moved, 1e-300)));
    while (factor > 1e-4 && (left + factor * b[COUNT] * width <= c->left ||
                             right + factor * b[COUNT + 1] * width >= c->right)) {
      factor *= 0.5;
    }
    if (factor <= 1e-4) {
      return sb_fail(report, SB_ERROR_INFEASIBLE, "dry contact: it leaves its window");
    }
    for (int k = 0; k < COUNT; k++) {
      a[k] += factor * b[k];
    }
    left += factor * b[COUNT] * width;
    right += factor * b[COUNT + 1] * width;
  }
  d.left = left;
  d.right = right;
  const double low = fmin(pressure_left, pressure_right);
  Moments m;
  moments_of(&m, &rules, c, left, right, COUNT, pressure_left - low, pressure_right - low);
  memcpy(d.moment, m.known, sizeof d.moment);
  for (int k = 0; k < COUNT; k++) {
    d.a[k] = a[k] * unit;
    for (int l = 0; l < c->modes; l++) {
      d.moment[l] += d.a[k] * m.basis[k][l];
    }
  }
  edge_factors(&d);
  *out = d;
  if (!(d.residual < 1e-9)) {
    return sb_fail(report, SB_ERROR_NOT_CONVERGED, "dry contact: residual %.2g", d.residual);
  }
  return check_signs(out, &rules, c, report);
}

double sb_dry_contact_pressure(const SbDryContact *d, double x) {
  if (x <= d->left) {
    return d->pressure_left;
  }
  if (x >= d->right) {
    return d->pressure_right;
  }
  const double z = (2.0 * x - d->left - d->right) / (d->right - d->left);
  const double angle = acos(fmin(fmax(z, -1.0), 1.0));
  const double step = 1.0 - angle / M_PI;
  double p = d->pressure_left * (1.0 - step) + d->pressure_right * step;
  for (int k = 0; k < d->count; k++) {
    p += d->a[k] * sin((k + 1) * angle);
  }
  return p;
}

double sb_dry_contact_gap(const SbDryContact *d, const SbSurfaceCompliance *c, double x) {
  if (x >= d->left && x <= d->right) {
    return 0.0;
  }
  Rules rules;
  sb_legendre_gauss(rules.gap_node, rules.gap_weight, GAP_POINTS);
  return gap_outside(d, &rules, c, x);
}

SbStatus sb_compliance_match(SbSurfaceCompliance *c, int order, size_t n, const double *x,
                             const double *p, double pressure_left, double pressure_right,
                             SbReport *report) {
  enum { ORDER = 12 };
  if (order < 1 || order > ORDER || n < (size_t)order + 2 || !(x[n - 1] > x[0]) ||
      !(x[0] > c->left && x[n - 1] < c->right) || c->modes < order + 2) {
    return sb_fail(report, SB_ERROR_INPUT, "compliance: a pressure of %zu points cannot be matched",
                   n);
  }
  const double left = x[0];
  const double right = x[n - 1];
  const double half = 0.5 * (right - left);
  const double middle = 0.5 * (left + right);
  const size_t m = (size_t)order;
  // Least squares over the angle, by straight lines between the points.
  double normal[ORDER * ORDER] = {0};
  double a[ORDER] = {0};
  const double low = fmin(pressure_left, pressure_right);
  const double p_left = pressure_left - low;
  const double p_right = pressure_right - low;
  enum { ANGLES = 400 };
  size_t at = 0;
  for (int i = 0; i < ANGLES; i++) {
    const double theta = M_PI * (i + 0.5) / ANGLES;
    const double s = middle - half * cos(theta);
    while (at + 2 < n && x[at + 1] < s) {
      at++;
    }
    const double t = (s - x[at]) / (x[at + 1] - x[at]);
    const double step = theta / M_PI;
    const double rest = p[at] + t * (p[at + 1] - p[at]) - p_left * (1.0 - step) - p_right * step;
    for (size_t k = 0; k < m; k++) {
      const double f = sin((double)(k + 1) * (M_PI - theta));
      a[k] += f * rest;
      for (size_t l = 0; l < m; l++) {
        normal[l * m + k] += f * sin((double)(l + 1) * (M_PI - theta));
      }
    }
  }
  if (!sb_eliminate(normal, a, m)) {
    return sb_fail(report, SB_ERROR_INPUT, "compliance: a pressure that cannot be matched");
  }
  Moments split;
  Rules rules;
  make_rules(&rules);
  moments_of(&split, &rules, c, left, right, order, p_left, p_right);
  double moment[SB_COMPLIANCE_MODES];
  memcpy(moment, split.known, sizeof moment);
  for (int k = 0; k < order; k++) {
    for (int l = 0; l < c->modes; l++) {
      moment[l] += a[k] * split.basis[k][l];
    }
  }
  // The gap whose slope under these pressures is zero, a polynomial up to the smooth part: gap =
  // C pi sum a_k int T_{k+1} - tilt - S p, at Chebyshev's points of the window.
  const double C = sb_compliance_half_plane(c);
  const double window = 0.5 * (c->right - c->left);
  const double centre = 0.5 * (c->right + c->left);
  double value[SB_COMPLIANCE_MODES];
  for (int i = 0; i < c->modes; i++) {
    const double s = centre - window * cos(M_PI * (i + 0.5) / c->modes);
    const double z = (s - middle) / half;
    double t[ORDER + 3] = {1.0, z};
    for (int k = 2; k < order + 2; k++) {
      t[k] = 2.0 * z * t[k - 1] - t[k - 2];
    }
    double sum = -C * (p_left - p_right) * log(half / window) * s;
    for (int k = 0; k < order; k++) {
      // int T_1 = T_2/4, int T_n = T_{n+1}/(2 (n + 1)) - T_{n-1}/(2 (n - 1)).
      const double integral = k == 0 ? 0.25 * t[2] : t[k + 2] / (2.0 * (k + 2)) - t[k] / (2.0 * k);
      sum += C * M_PI * half * a[k] * integral;
    }
    value[i] = sum - sb_compliance_smooth(c, s, moment, NULL);
  }
  sb_chebyshev_coefficients(c->gap, value, c->modes);
  // Beyond the window S has no slope: the gap goes on with that of both.
  for (int end = 0; end < 2; end++) {
    double slope;
    sb_compliance_gap(c, end == 0 ? c->left : c->right, &c->beyond[end]);
    sb_compliance_smooth(c, end == 0 ? c->left : c->right, moment, &slope);
    c->beyond[end] += slope;
  }
  return sb_succeed(report);
}
