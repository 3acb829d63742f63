// The dry contact on a surface of the header's kind, and the gap that has a given dry pressure.
//
// For p = sqrt(1 - z^2) U_k(z) on a half-plane of half-width a, the slope of the displacement is -C
// pi T_{k+1}(z) inside and -C pi (z -+ sqrt(z^2 - 1))^{k+1} outside (Johnson, section 2.7; the
// finite Hilbert transform of Chebyshev's polynomials). Smooth edges need no condition of their
// own, because the form of the pressure satisfies it. For given edges a linear system gives the
// coefficients; Newton's method finds the edges. Contacts in several parts are refused.
#include <math.h>
#include <string.h>

#include "engine/contact/compliance.h"
#include "engine/numeric/dense.h"
#include "engine/numeric/legendre.h"
#include "engine/numeric/root.h"

// Midpoints in the angle integrate a polynomial of cos(angle) exactly up to degree 2 POINTS - 1:
// here the product of two Chebyshev polynomials.
enum { POINTS = SB_COMPLIANCE_MODES, COUNT = 16 };

// Moments of the pressure over the window, split: of each U_k, and of the ambient pressures.
typedef struct {
  double known[SB_COMPLIANCE_MODES];
  double basis[SB_COMPLIANCE_PRESSURES][SB_COMPLIANCE_MODES];
} Moments;

static void moments_of(Moments *out, const SbSurfaceCompliance *c, const SbDryContact *d) {
  memset(out, 0, sizeof *out);
  const double middle = 0.5 * (d->left + d->right), half = 0.5 * (d->right - d->left);
  const double low = fmin(d->pressure_left, d->pressure_right);
  // The step is even in the angle, so that its moments are the mean of those of sharp steps there.
  double below[SB_COMPLIANCE_MODES], above[SB_COMPLIANCE_MODES], value[SB_COMPLIANCE_MODES];
  for (int i = 0; i < POINTS; i++) {
    // z = -cos(theta): everything is smooth in theta.
    const double theta = M_PI * (i + 0.5) / POINTS, at = middle - half * cos(theta);
    sb_compliance_integrals(c, c->left, at, below);
    sb_compliance_integrals(c, at, c->right, above);
    for (int l = 0; l < c->modes; l++) {
      out->known[l] +=
          ((d->pressure_left - low) * below[l] + (d->pressure_right - low) * above[l]) / POINTS;
    }
    sb_compliance_modes(c, at, value, NULL);
    // sqrt(1 - z^2) U_k(z) = sin((k + 1) (pi - theta)), by its recurrence.
    double basis = M_PI / POINTS * half * sin(theta) * sin(theta);
    double before = 0.0;
    for (int k = 0; k < d->count; k++) {
      for (int l = 0; l < c->modes; l++) {
        out->basis[k][l] += basis * value[l];
      }
      const double next = -2.0 * cos(theta) * basis - before;
      before = basis;
      basis = next;
    }
  }
}

// A contact on the surface c under a load, with the coefficients and moments of the last edges that
// were tried. Edges are unknown as their distances from the ends of the window, over its half.
typedef struct {
  const SbSurfaceCompliance *c;
  SbDryContact dry;
} Problem;

static double window_of(const SbSurfaceCompliance *c) {
  return 0.5 * (c->right - c->left);
}

// Writes the slope of the gap at `at`: known, and by each coefficient, without that coefficient's
// own polynomial.
static void slope_row(double here[COUNT + 1], const SbSurfaceCompliance *c, const SbDryContact *d,
                      const Moments *m, double at) {
  const double half = 0.5 * (d->right - d->left);
  double slope, value[SB_COMPLIANCE_MODES], derivative[SB_COMPLIANCE_MODES];
  double by_moment[SB_COMPLIANCE_MODES] = {0.0};
  sb_compliance_gap(c, at, &slope);
  slope += sb_compliance_half_plane(c) * (d->pressure_left - d->pressure_right) *
           log(half / window_of(c));
  sb_compliance_modes(c, at, value, derivative);
  for (int k = 0; k < c->modes; k++) {
    for (int l = 0; l < c->modes; l++) {
      by_moment[l] += derivative[k] * c->smooth[k][l];
    }
  }
  here[0] = slope;
  memset(&here[1], 0, COUNT * sizeof *here);
  for (int l = 0; l < c->modes; l++) {
    here[0] += by_moment[l] * m->known[l];
    for (int k = 0; k < COUNT; k++) {
      here[k + 1] += by_moment[l] * m->basis[k][l];
    }
  }
}

// For given edges the slope of the gap is 0 at COUNT + 1 points z = cos(angle). Its components T_1
// to T_COUNT give the coefficients; T_0 and the load are the residuals of the edges.
static bool edge_residuals(double *r, const double *x, void *context) {
  Problem *problem = context;
  const SbSurfaceCompliance *c = problem->c;
  SbDryContact *d = &problem->dry;
  const double window = window_of(c);
  d->left = c->left + x[0] * window;
  d->right = c->right - x[1] * window;
  if (!(x[0] > 0.0 && x[1] > 0.0 && d->right > d->left)) {
    return false;
  }
  const double C = sb_compliance_half_plane(c);
  const double half = 0.5 * (d->right - d->left), middle = 0.5 * (d->left + d->right);
  const double unit = 2.0 * d->load / (M_PI * half); // of pressure
  Moments m;
  moments_of(&m, c, d);
  // Rows by the polynomials of the slope: [COUNT + 1][known, coefficients], over C pi unit.
  double row[COUNT + 1][COUNT + 1] = {{0.0}};
  for (int i = 0; i <= COUNT; i++) {
    const double angle = M_PI * (i + 0.5) / (COUNT + 1), at = middle + half * cos(angle);
    double here[COUNT + 1], wave[COUNT + 1];
    for (int n = 0; n <= COUNT; n++) {
      wave[n] = cos(n * angle);
    }
    slope_row(here, c, d, &m, at);
    for (int k = 0; k <= COUNT; k++) {
      here[k] = here[k] / (C * M_PI * (k == 0 ? unit : 1.0)) - (k == 0 ? 0.0 : wave[k]);
      for (int n = 0; n <= COUNT; n++) {
        row[n][k] += (n == 0 ? 1.0 : 2.0) / (COUNT + 1) * wave[n] * here[k];
      }
    }
  }
  double matrix[COUNT * COUNT], a[COUNT];
  for (int n = 0; n < COUNT; n++) {
    a[n] = -row[n + 1][0];
    for (int k = 0; k < COUNT; k++) {
      matrix[k * COUNT + n] = row[n + 1][k + 1];
    }
  }
  if (!sb_eliminate(matrix, a, COUNT)) {
    return false;
  }
  r[0] = row[0][0];
  r[1] = a[0] + ((d->pressure_left - d->pressure_right) * middle - d->load) / d->load;
  memcpy(d->moment, m.known, sizeof d->moment);
  for (int k = 0; k < COUNT; k++) {
    r[0] += row[0][k + 1] * a[k];
    d->a[k] = a[k] * unit;
    for (int l = 0; l < c->modes; l++) {
      d->moment[l] += d->a[k] * m.basis[k][l];
    }
  }
  return isfinite(r[0]) && isfinite(r[1]);
}

// U_k at z = -1 and 1: (-1)^k (k + 1) and k + 1.
void sb_dry_contact_edges(SbDryContact *d) {
  d->edge_left = -(d->pressure_left - d->pressure_right) / M_PI;
  d->edge_right = -d->edge_left;
  for (int k = 0; k < d->count; k++) {
    d->edge_left += (k % 2 == 0 ? 1.0 : -1.0) * (k + 1) * d->a[k];
    d->edge_right += (k + 1) * d->a[k];
  }
}

static double falling_slope(double x, const void *c) {
  double slope;
  sb_compliance_gap(c, x, &slope);
  return -slope;
}

// First guess of the edges: Hertz on the parabola at the lowest point of the gap; false without
// one.
static bool first_edges(double x[2], const SbSurfaceCompliance *c, double load) {
  const double window = window_of(c), step = window / 32.0;
  const double at = sb_bisect(falling_slope, c, c->left, c->right);
  const double curvature =
      (falling_slope(at - step, c) - falling_slope(at + step, c)) / (2.0 * step);
  const double half = fmin(sqrt(8.0 * load / (M_PI * c->modulus * curvature)), 0.9 * window);
  x[0] = fmax((at - half - c->left) / window, 0.04);
  x[1] = fmax((c->right - at - half) / window, 0.04);
  return curvature > 0.0;
}

// The integral of the slope from the edge on, with z = +-cosh(u) there: z -+ sqrt(z^2 - 1) is
// +-exp(-u).
double sb_dry_contact_gap(const SbDryContact *d, const SbSurfaceCompliance *c, double x) {
  if (x >= d->left && x <= d->right) {
    return 0.0;
  }
  const double C = sb_compliance_half_plane(c), half = 0.5 * (d->right - d->left);
  const double side = x < d->left ? -1.0 : 1.0, edge = x < d->left ? d->left : d->right;
  const double t = fabs(x - edge) / half, root = sqrt(t * (2.0 + t)), u = log1p(t + root);
  double tails = 0.0;
  for (int k = 0; k < d->count; k++) {
    const double integral =
        0.5 * ((k == 0 ? u : -expm1(-k * u) / k) + expm1(-(k + 2) * u) / (k + 2));
    tails += (side > 0.0 || k % 2 == 0 ? 1.0 : -1.0) * d->a[k] * integral;
  }
  const double tilt = log(half / window_of(c)) * (x - edge) + side * half * ((1.0 + t) * u - root);
  const double gap = sb_compliance_gap(c, x, NULL) - sb_compliance_gap(c, edge, NULL) +
                     sb_compliance_smooth(c, x, d->moment, NULL) -
                     sb_compliance_smooth(c, edge, d->moment, NULL) +
                     C * ((d->pressure_left - d->pressure_right) * tilt - M_PI * half * tails);
  return fabs(gap) > 1e-14 * half ? gap : 0.0; // less is the sum's rounding
}

// No tension inside, no penetration outside nor beyond the window.
static SbStatus check_signs(SbDryContact *d, const SbSurfaceCompliance *c, SbReport *report) {
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
    if (sb_dry_contact_gap(d, c, d->left - (d->left - c->left) * i / 16.0) < -limit ||
        sb_dry_contact_gap(d, c, d->right + (c->right - d->right) * i / 16.0) < -limit) {
      return sb_fail(report, SB_ERROR_INFEASIBLE,
                     "dry contact: the surface touches outside the contact");
    }
  }
  // Nor may the gap that goes on beyond the window close there: a film's mesh does not end with it.
  double left = 0.0, right = 0.0;
  for (double beyond = 0.0; beyond < 4.0; beyond = 2.0 * beyond + 0.05) {
    const double reach = beyond * (c->right - c->left);
    const double gap_left = sb_dry_contact_gap(d, c, c->left - reach);
    const double gap_right = sb_dry_contact_gap(d, c, c->right + reach);
    if (!(gap_left > left && gap_right > right)) {
      return sb_fail(report, SB_ERROR_INFEASIBLE,
                     "dry contact: the surface closes again beyond its window");
    }
    left = gap_left;
    right = gap_right;
  }
  return sb_succeed(report);
}

SbStatus sb_dry_contact(SbDryContact *out, const SbSurfaceCompliance *c, double load,
                        double pressure_left, double pressure_right, SbReport *report) {
  memset(out, 0, sizeof *out);
  double x[2];
  if (c->modes < 3 || !(load > 0.0) || !first_edges(x, c, load)) {
    return sb_fail(report, SB_ERROR_INPUT, "dry contact: no convex gap or no load");
  }
  Problem problem = {.c = c,
                     .dry = {.pressure_left = pressure_left,
                             .pressure_right = pressure_right,
                             .load = load,
                             .count = COUNT}};
  SbBroyden broyden = {0};
  const bool solved = sb_solve_system(edge_residuals, &problem, x, 2, 1e-13, &broyden);
  *out = problem.dry;
  out->residual = broyden.residual;
  sb_dry_contact_edges(out);
  if (!solved) {
    return fmin(x[0], x[1]) < 1e-3
               ? sb_fail(report, SB_ERROR_INFEASIBLE, "dry contact: it leaves its window")
               : sb_fail(report, SB_ERROR_NOT_CONVERGED, "dry contact: residual %.2g",
                         out->residual);
  }
  return check_signs(out, c, report);
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
  // sin((k + 1) angle) by its recurrence.
  const double twice = 2.0 * cos(angle);
  double now = sin(angle), before = 0.0;
  for (int k = 0; k < d->count; k++) {
    p += d->a[k] * now;
    const double next = twice * now - before;
    before = now;
    now = next;
  }
  return p;
}

void sb_compliance_of_pressure(SbSurfaceCompliance *c, const SbDryContact *d) {
  const double half = 0.5 * (d->right - d->left);
  const double middle = 0.5 * (d->left + d->right);
  Moments split;
  moments_of(&split, c, d);
  double *moment = split.known;
  for (int k = 0; k < d->count; k++) {
    for (int l = 0; l < c->modes; l++) {
      moment[l] += d->a[k] * split.basis[k][l];
    }
  }
  // The gap whose slope under these pressures is zero, a polynomial up to the smooth part: gap =
  // C pi sum a_k int T_{k+1} - tilt - S p, at Chebyshev's points of the window.
  const double C = sb_compliance_half_plane(c);
  const double window = window_of(c), centre = 0.5 * (c->right + c->left);
  double value[SB_COMPLIANCE_MODES];
  for (int i = 0; i < c->modes; i++) {
    const double s = centre - window * cos(M_PI * (i + 0.5) / c->modes);
    const double z = (s - middle) / half;
    double integral[SB_COMPLIANCE_MODES]; // of T_k
    sb_chebyshev_integrals(integral, z, d->count + 1);
    double sum = -C * (d->pressure_left - d->pressure_right) * log(half / window) * s;
    for (int k = 0; k < d->count; k++) {
      sum += C * M_PI * half * d->a[k] * integral[k + 1];
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
}

SbStatus sb_compliance_match(SbSurfaceCompliance *c, int order, size_t n, const double *x,
                             const double *p, double pressure_left, double pressure_right,
                             SbReport *report) {
  enum { ORDER = 12, ANGLES = 400 };
  if (order < 1 || order > ORDER || n < (size_t)order + 2 || !(x[n - 1] > x[0]) ||
      !(x[0] > c->left && x[n - 1] < c->right) || c->modes < order + 2) {
    return sb_fail(report, SB_ERROR_INPUT, "compliance: a pressure of %zu points cannot be matched",
                   n);
  }
  SbDryContact d = {.left = x[0],
                    .right = x[n - 1],
                    .pressure_left = pressure_left,
                    .pressure_right = pressure_right,
                    .count = order};
  // Least squares over equal steps of the angle, where the sines are orthogonal, by straight lines
  // between the points.
  const double low = fmin(pressure_left, pressure_right);
  for (int i = 0; i < ANGLES; i++) {
    const double angle = M_PI * (i + 0.5) / ANGLES, step = 1.0 - angle / M_PI;
    const double s = 0.5 * (d.left + d.right + (d.right - d.left) * cos(angle));
    const size_t at = sb_interval(x, n, s);
    const double t = (s - x[at]) / (x[at + 1] - x[at]);
    const double rest = p[at] + t * (p[at + 1] - p[at]) + low - pressure_left * (1.0 - step) -
                        pressure_right * step;
    for (int k = 0; k < order; k++) {
      d.a[k] += 2.0 / ANGLES * rest * sin((k + 1) * angle);
    }
  }
  sb_compliance_of_pressure(c, &d);
  return sb_succeed(report);
}
