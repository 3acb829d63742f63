// The linear disc in contact: Newton on the contact edges, pressure steps where Newton fails,
// resolution until the estimated error meets the tolerance; see the header and disc_system.h.
#include "engine/contact/disc/disc.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "engine/base/check.h"
#include "engine/contact/closed/hertz.h"
#include "engine/contact/disc/disc_system.h"
#include "engine/numeric/dense.h"

enum { NEWTON_MAX = 40 };

// ---- edges

// Unknown edges as a vector: the right one alone (symmetric), or left, right, wall.
static SbDiscEdges unpack(const double *v, size_t count) {
  return count == 1 ? (SbDiscEdges){-v[0], v[0], 0.0} : (SbDiscEdges){v[0], v[1], v[2]};
}

static double edge_residuals(SbDiscSystem *s, const double *v, size_t count, double *r, bool *ok) {
  double all[3];
  *ok = sb_disc_system_solve(s, unpack(v, count), all);
  if (!*ok) {
    return INFINITY;
  }
  double norm = 0.0;
  for (size_t i = 0; i < count; i++) {
    r[i] = count == 1 ? all[1] : all[i];
    norm = fmax(norm, fabs(r[i]));
  }
  return norm;
}

// Derivatives of the residuals by the edges, by columns, carried from one solve to the next.
typedef struct {
  double a[9];
  bool known;
} Jacobian;

static bool differentiate(SbDiscSystem *s, const double *v, const double *r, size_t count,
                          Jacobian *jacobian) {
  for (size_t j = 0; j < count; j++) {
    double shifted[3] = {0.0};
    memcpy(shifted, v, count * sizeof(double));
    const double h = 1e-6 * fabs(v[j]) + 1e-12;
    shifted[j] += h;
    double rj[3];
    bool ok;
    edge_residuals(s, shifted, count, rj, &ok);
    if (!ok) {
      return false;
    }
    for (size_t i = 0; i < count; i++) {
      jacobian->a[i + j * count] = (rj[i] - r[i]) / h;
    }
  }
  jacobian->known = true;
  return true;
}

// Broyden's correction after a step from residual `before` to `after`.
static void correct(Jacobian *jacobian, const double *step, const double *before,
                    const double *after, size_t count) {
  double square = 0.0;
  for (size_t j = 0; j < count; j++) {
    square += step[j] * step[j];
  }
  for (size_t i = 0; i < count && square > 0.0; i++) {
    double miss = after[i] - before[i];
    for (size_t j = 0; j < count; j++) {
      miss -= jacobian->a[i + j * count] * step[j];
    }
    for (size_t j = 0; j < count; j++) {
      jacobian->a[i + j * count] += miss * step[j] / square;
    }
  }
}

// Newton on the edges from `v`. The Jacobian comes from an earlier solve or from differences and is
// corrected by Broyden's formula while each step at least halves the residual; with a fresh one
// steps are shortened until the residual falls. On success `v` and the system's solution belong
// together.
static bool newton(SbDiscSystem *s, double *v, size_t count, double tolerance, Jacobian *jacobian,
                   size_t *iterations, double *last) {
  bool ok;
  bool fresh = false;
  double r[3];
  double norm = edge_residuals(s, v, count, r, &ok);
  for (int it = 0; ok && it < NEWTON_MAX; it++) {
    *last = norm;
    if (norm <= tolerance) {
      return true;
    }
    if (!jacobian->known) {
      if (!differentiate(s, v, r, count, jacobian)) {
        return false;
      }
      fresh = true;
    }
    double step[3], a[9];
    memcpy(step, r, count * sizeof(double));
    memcpy(a, jacobian->a, sizeof a);
    if (!sb_eliminate(a, step, count)) {
      jacobian->known = false;
      if (fresh) {
        return false;
      }
      continue;
    }
    (*iterations)++;

    double scale = -1.0;
    bool better = false;
    for (int k = 0; k < (fresh ? 12 : 1) && !better; k++, scale *= 0.5) {
      double next[3] = {0.0};
      double moved[3] = {0.0};
      for (size_t i = 0; i < count; i++) {
        moved[i] = scale * step[i];
        next[i] = v[i] + moved[i];
      }
      double rn[3];
      const double trial = edge_residuals(s, next, count, rn, &ok);
      if (ok && trial < (fresh ? norm : 0.5 * norm)) {
        correct(jacobian, moved, r, rn, count);
        memcpy(v, next, count * sizeof(double));
        memcpy(r, rn, count * sizeof(double));
        norm = trial;
        better = true;
      }
    }
    if (better) {
      fresh = false;
    } else if (fresh) {
      // A residual at rounding level cannot be bettered.
      jacobian->known = false;
      norm = edge_residuals(s, v, count, r, &ok);
      *last = norm;
      return ok && norm <= 1e3 * tolerance;
    } else {
      jacobian->known = false;
      ok = true;
    }
  }
  return false;
}

// ---- results of one resolution

typedef struct {
  double load, peak, width; // dimensionless: load C/R, peak C, width/R
} Figures;

// Excess pressure times C at tau from nodal values (Clenshaw for F, edges regular).
static double excess_at(const double *nodal, size_t n, double half, double tau) {
  const double eta = acos(fmax(-1.0, fmin(1.0, tau)));
  const double sine = sin(eta);
  if (sine < 1e-6) {
    return 0.0;
  }
  // F(tau) by barycentric interpolation at Chebyshev points of the first kind.
  double above = 0.0;
  double below = 0.0;
  for (size_t j = 0; j < n; j++) {
    const double node = M_PI * ((double)j + 0.5) / (double)n;
    const double difference = tau - cos(node);
    if (fabs(difference) < 1e-14) {
      return nodal[j] / (half * sine);
    }
    const double w = (j % 2 == 0 ? 1.0 : -1.0) * sin(node) / difference;
    above += w * nodal[j];
    below += w;
  }
  return above / below / (half * sine);
}

static double total_at(const SbDiscSystem *s, double half, double tau) {
  return excess_at(s->solution, s->n, half, tau) + s->pressure * sb_disc_system_step(tau);
}

static Figures figures(const SbDiscSystem *s, SbDiscEdges edges) {
  const double half = 0.5 * (edges.right - edges.left);
  Figures out = {.width = 2.0 * half, .load = s->pressure * half};
  for (size_t j = 0; j < s->n; j++) {
    out.load += M_PI / (double)s->n * s->solution[j];
  }
  // The step's mean over the contact is one half: p half x 2 x 1/2. Peak by golden section in the
  // angle.
  double low = 0.0;
  double high = M_PI;
  if (s->pressure != 0.0) {
    enum { SCAN = 32 };
    int best = 1;
    for (int i = 1; i < SCAN; i++) {
      if (total_at(s, half, cos(M_PI * i / SCAN)) > total_at(s, half, cos(M_PI * best / SCAN))) {
        best = i;
      }
    }
    low = M_PI * (best - 1) / SCAN;
    high = M_PI * (best + 1) / SCAN;
    const double golden = 0.5 * (sqrt(5.0) - 1.0);
    for (int i = 0; i < 40; i++) {
      const double a = high - golden * (high - low);
      const double b = low + golden * (high - low);
      if (total_at(s, half, cos(a)) > total_at(s, half, cos(b))) {
        high = b;
      } else {
        low = a;
      }
    }
  }
  out.peak = total_at(s, half, cos(0.5 * (low + high)));
  return out;
}

// ---- solve

static SbStatus check(const SbDiscProblem *in, SbReport *report) {
  SbStatus status =
      SB_CHECK(report, {"seal.section_diameter", "the diameter [m]", in->diameter, SB_ABOVE_ZERO},
               {"seal.section_diameter", "the space [m]", in->space, SB_ABOVE_ZERO},
               {"seal.modulus", "the modulus [Pa]", in->modulus, SB_ABOVE_ZERO},
               {"seal.poisson_ratio", "Poisson's ratio", in->poisson_ratio, SB_POISSON},
               {"canister.pressure", "the pressure [Pa]", in->pressure_left, SB_NOT_NEGATIVE},
               {"canister.pressure", "the pressure [Pa]", in->pressure_right, SB_NOT_NEGATIVE});
  if (status != SB_OK) {
    return status;
  }
  if ((unsigned)in->variant >= SB_DISC_VARIANT_COUNT ||
      !(in->tolerance >= 0.0 && in->tolerance < 1.0)) {
    return sb_fail(report, SB_ERROR_INPUT, "no such variant (%d) or tolerance (%g)",
                   (int)in->variant, in->tolerance);
  }
  return SB_OK;
}

// Half-width over radius of Hertz's contact at the approach; the start of Newton.
static double hertz_start(double approach) {
  SbHertz hertz;
  // As of a disc that is as stiff as the flat is not: 2/E' = 1/E_disc.
  SbStatus status = sb_hertz_from_approach(&hertz, approach, 1.0, 2.0, 1.0, NULL, NULL);
  return status == SB_OK ? fmin(hertz.half_width, 0.9) : 0.9;
}

// Unknowns of one resolution after the next: the dry half-width, and the edges under pressure.
typedef struct {
  double dry;
  double wet[3];
  bool has_wet;
  size_t iterations;
  double residual;   // of the last Newton
  double free_bulge; // of the dry flank
  Jacobian dry_jacobian, wet_jacobian;
} Progress;

// Solves at the present resolution for pressure `target`, in smaller steps if Newton fails. Returns
// the pressure that was reached, with the system's solution for it; negative if not even the dry
// disc.
static double solve_pressure(SbDiscSystem *s, double target, Progress *at) {
  s->pressure = 0.0;
  if (!newton(s, &at->dry, 1, 1e-12, &at->dry_jacobian, &at->iterations, &at->residual)) {
    return -1.0;
  }
  at->free_bulge = sb_disc_system_bulge(s, unpack(&at->dry, 1));
  if (target == 0.0) {
    return 0.0;
  }

  // From the coarser resolution's state if there is one.
  if (at->has_wet) {
    double trial[3] = {at->wet[0], at->wet[1], at->wet[2]};
    s->pressure = target;
    if (newton(s, trial, 3, 1e-9, &at->wet_jacobian, &at->iterations, &at->residual)) {
      for (int k = 0; k < 3; k++) {
        at->wet[k] = trial[k];
      }
      return target;
    }
  }

  // From the dry disc, the wall as wide as Hertz's contact under the fluid's force.
  double done = 0.0;
  double step = target;
  at->has_wet = false;
  while (done < target && step > target / 128.0) {
    double trial[3] = {at->wet[0], at->wet[1], at->wet[2]};
    s->pressure = fmin(target, done + step);
    if (!at->has_wet) {
      trial[0] = -at->dry;
      trial[1] = at->dry;
      trial[2] = fmin(0.8, sqrt(4.0 * s->pressure * sqrt(1.0 - at->dry * at->dry)));
    }
    if (newton(s, trial, 3, 1e-9, &at->wet_jacobian, &at->iterations, &at->residual)) {
      done = s->pressure;
      for (int k = 0; k < 3; k++) {
        at->wet[k] = trial[k];
      }
      at->has_wet = true;
    } else {
      step *= 0.5;
    }
  }
  if (done < target) {
    // The solution of what was reached.
    double ignored[3];
    s->pressure = done;
    const double *edges = at->has_wet ? at->wet : &at->dry;
    if (!sb_disc_system_solve(s, unpack(edges, at->has_wet ? 3 : 1), ignored)) {
      return -1.0;
    }
  }
  return done;
}

static void keep(SbDisc *out, const SbDiscSystem *s, SbDiscEdges edges, Figures f,
                 double free_bulge) {
  const SbDiscProblem *in = &out->problem;
  const double radius = 0.5 * in->diameter;
  const double compliance = sb_disc_compliance(in->modulus, in->poisson_ratio);
  const double both = fmin(in->pressure_left, in->pressure_right);
  const double sign = out->mirrored ? -1.0 : 1.0;
  out->points = s->n;
  out->edge_left = edges.left;
  out->edge_right = edges.right;
  out->edge_wall = edges.wall;
  out->wall_points = s->pressure != 0.0 ? s->n : 0;
  for (size_t j = 0; j < s->n; j++) {
    out->excess[j] = s->solution[j];
    out->wall_excess[j] = out->wall_points > 0 ? s->solution[s->n + j] : 0.0;
  }
  out->unknowns = s->n + out->wall_points + (out->wall_points > 0 ? 4 : 1);
  const double shift = out->wall_points > 0 ? radius * (s->solution[2 * s->n] + free_bulge) : 0.0;
  out->shift = sign * shift;
  const double left = radius * edges.left + shift;
  const double right = radius * edges.right + shift;
  out->contact_left = out->mirrored ? -right : left;
  out->contact_right = out->mirrored ? -left : right;
  out->contact_width = radius * f.width;
  out->load_per_length = radius / compliance * f.load + both * out->contact_width;
  out->pressure_peak = f.peak / compliance + both;
  out->wall_half_width = radius * edges.wall;
  out->wall_load = 0.0;
  for (size_t j = 0; j < out->wall_points; j++) {
    out->wall_load += M_PI / (double)s->n * out->wall_excess[j] * radius / compliance;
  }
}

// Estimated errors of the last of three sets of figures at resolutions n[0] < n[1] < n[2]. The
// error falls like rho^n, so that |f1 - f0| is about the error at n[0] and |f2 - f1| that at n[1];
// what is left is the rest of the geometric series. A factor 2 covers uneven rates. The radial
// kernel's kink leaves a tail like n^-4 (n^-7 seen with fluid) under that, so its rate is never
// taken to be better. An unsymmetric contact passes through accidental zeros of the error: there
// the slowest rate of the three figures stands for all. The floor is quadrature and rounding.
static void estimate(SbDisc *out, const Figures f[3], const size_t n[3], bool kink,
                     bool unsymmetric) {
  const double value[3][3] = {{f[0].load, f[1].load, f[2].load},
                              {f[0].peak, f[1].peak, f[2].peak},
                              {f[0].width, f[1].width, f[2].width}};
  const double floor = unsymmetric ? 2e-7 : 1e-12;
  double d1[3];
  double d2[3];
  double rate[3];
  double slowest = 0.0;
  for (int i = 0; i < 3; i++) {
    d1[i] = fabs(value[i][1] - value[i][0]);
    d2[i] = fabs(value[i][2] - value[i][1]);
    rate[i] = d1[i] > 0.0 ? fmin(1.0, d2[i] / d1[i]) : 1.0;
    slowest = fmax(slowest, rate[i]);
  }
  double error[3];
  for (int i = 0; i < 3; i++) {
    if (unsymmetric) {
      rate[i] = slowest;
      d2[i] = fmax(d2[i], fmin(1.0, slowest) * d1[i]);
    }
    rate[i] = pow(rate[i], (double)(n[2] - n[1]) / (double)(n[1] - n[0]));
    if (kink && !(unsymmetric && i == 1)) {
      rate[i] = fmax(rate[i], pow((double)n[1] / (double)n[2], unsymmetric ? 7.0
                                                               : i == 1    ? 6.0
                                                                           : 4.0));
    }
    error[i] = fmax(floor, 2.0 * d2[i] * fmin(1.5, rate[i] / fmax(1.0 - rate[i], 1e-3)) /
                               fabs(value[i][2]));
  }
  out->error_estimate.load = error[0];
  out->error_estimate.pressure_peak = error[1];
  out->error_estimate.contact_width = error[2];
}

SbStatus sb_disc_solve(SbDisc *out, const SbDiscProblem *problem, SbWarnings *warnings,
                       SbReport *report) {
  *out = (SbDisc){.problem = *problem};
  SbStatus status = check(problem, report);
  if (status != SB_OK) {
    return status;
  }
  const double approach = 2.0 * (1.0 - problem->space / problem->diameter); // over the radius
  const double compliance = sb_disc_compliance(problem->modulus, problem->poisson_ratio);
  const double both = fmin(problem->pressure_left, problem->pressure_right);
  const double difference = fabs(problem->pressure_left - problem->pressure_right);
  const double nu = problem->poisson_ratio;
  // Uniform pressure shrinks the disc: u_r = -p R (1 + nu)(1 - 2 nu)/E.
  const double hydrostatic = both * (1.0 + nu) * (1.0 - 2.0 * nu) / problem->modulus;
  if (!(approach - 2.0 * hydrostatic > 0.0)) {
    sb_warn(warnings, "no-contact", "seal.section_diameter",
            "the disc does not touch the flats (squeeze %.3g %%): load 0", 50.0 * approach);
    out->converged = true;
    return sb_succeed(report);
  }
  if (approach > 0.2) {
    sb_warn(warnings, "disc-strain", "seal.section_diameter",
            "squeeze %.3g %% is beyond 10 %%: linear elasticity is an estimate", 50.0 * approach);
  }
  if (difference > 0.25 * problem->modulus) {
    sb_warn(warnings, "disc-pressure", "canister.pressure",
            "pressure difference is %.2g of the modulus: linear elasticity is an estimate",
            difference / problem->modulus);
  }

  SbDiscSystem *s = malloc(sizeof *s);
  if (s == NULL) {
    return sb_fail(report, SB_ERROR_MEMORY, "no memory for the disc");
  }
  s->kernel = sb_disc_kernel(nu);
  s->radial = problem->variant == SB_DISC_RADIAL;
  s->half_space = problem->space / problem->diameter;
  s->hydrostatic = hydrostatic;
  out->mirrored = problem->pressure_right > problem->pressure_left;

  // Resolutions until the estimate is a tenth of the tolerance; each starts from the last.
  const double wanted = 0.1 * (problem->tolerance > 0.0 ? problem->tolerance : 1e-3);
  static const size_t points[] = {4, 6, 8, 10, 12, 16, 20, 24, 32, 40, 48};
  enum { LEVELS = sizeof points / sizeof points[0] };
  Figures f[LEVELS];
  const double target = difference * compliance;
  Progress at = {.dry = hertz_start(approach)};
  double reached = target;
  double worst = 1.0;
  for (size_t level = 0; level < LEVELS && !out->converged && reached == target; level++) {
    sb_disc_system_points(s, points[level]);
    reached = solve_pressure(s, target, &at);
    if (reached < 0.0 || (reached < target && out->touches)) {
      break; // nothing, or nothing better than the coarser resolution
    }
    if (reached < target) {
      // The last good state is that of a smaller pressure, and says so.
      out->problem.pressure_left = both + (out->mirrored ? 0.0 : reached / compliance);
      out->problem.pressure_right = both + (out->mirrored ? reached / compliance : 0.0);
    }
    const SbDiscEdges edges = s->pressure != 0.0 ? unpack(at.wet, 3) : unpack(&at.dry, 1);
    f[level] = figures(s, edges);
    keep(out, s, edges, f[level], at.free_bulge);
    out->touches = true;
    if (level >= 2 && reached == target) {
      estimate(out, &f[level - 2], &points[level - 2], s->radial, s->pressure != 0.0);
      worst = fmax(out->error_estimate.load,
                   fmax(out->error_estimate.pressure_peak, out->error_estimate.contact_width));
      out->converged = worst <= wanted;
    }
  }
  free(s);
  out->newton_iterations = at.iterations;
  if (out->converged) {
    return sb_succeed(report);
  }
  if (reached == target) {
    status = sb_fail(report, SB_ERROR_NOT_CONVERGED,
                     "the linear disc's error estimate %.2g stays above %.2g", worst, wanted);
  } else {
    out->error_estimate.load = 1.0;
    out->error_estimate.pressure_peak = 1.0;
    out->error_estimate.contact_width = 1.0;
    status = sb_fail_parameter(
        report, SB_ERROR_NOT_CONVERGED, reached < 0.0 ? "gland.radial_space" : "canister.pressure",
        "the linear disc found no contact state beyond %.3g MPa (edge residual %.2g)",
        1e-6 * fmax(0.0, reached) / compliance, at.residual);
  }
  if (report != NULL) {
    report->residual = at.residual;
    report->iteration = (int)at.iterations;
  }
  return status;
}

double sb_disc_pressure(const SbDisc *disc, double x) {
  const SbDiscProblem *in = &disc->problem;
  const double own = disc->mirrored ? -x : x;
  const double shift = disc->mirrored ? -disc->shift : disc->shift;
  const double both = fmin(in->pressure_left, in->pressure_right);
  const double difference = fabs(in->pressure_left - in->pressure_right);
  const double centre = 0.5 * (disc->edge_left + disc->edge_right);
  const double half = 0.5 * (disc->edge_right - disc->edge_left);
  if (!disc->touches) {
    return x < 0.0 ? in->pressure_left : in->pressure_right;
  }
  const double tau = ((own - shift) / (0.5 * in->diameter) - centre) / half;
  if (tau <= -1.0) {
    return both + difference;
  }
  if (tau >= 1.0) {
    return both;
  }
  return both + difference * sb_disc_system_step(tau) +
         excess_at(disc->excess, disc->points, half, tau) /
             sb_disc_compliance(in->modulus, in->poisson_ratio);
}
