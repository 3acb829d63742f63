// The linear plane-strain disc as a contact model: squeezed between two rigid frictionless flats,
// with fluid pressure on its flanks. If the fluid is on one flank only, a flat groove wall is on
// the other side.
//
// A boundary method: the contact pressure is expanded in Chebyshev polynomials over the contact,
// the closed-form kernels of disc_kernel.h are integrated with their logarithm exactly, and the
// edges of the contacts are unknowns. The unilateral conditions have their smooth form: no
// penetration inside, and a pressure that at an edge equals the fluid's (no singularity). Newton's
// method finds the edges. Both signs are checked afterwards. Convergence is spectral.
//
// Kinematics (a linear disc at finite squeeze is an estimate and must state which): the traction
// acts per horizontally projected width and the surface moves vertically onto the flat ("vertical",
// depends on nu only through 1 - nu^2), or both are radial ("radial", Hertz and Michell). The gap
// is the circle's exactly. Against finite strain at 15.5 % squeeze: load -11 % and -1.4 %, width -9
// % and +5 %, peak -5 % and -7 % (docs/verification.md).
//
// If the pressure (from 0.57 to 0.7 of the modulus) moves the disc so far that its contacts with
// bore and wall meet, the corner is filled. There is then no arc on that side, and the uniform
// pressure at which the two contacts meet becomes an additional unknown (a uniform pressure all
// around only shrinks the disc). Both contacts end at the pressure of the other. Further fluid
// pressure is then transmitted as by a fluid, the more completely the closer nu is to 1/2.
//
// The fluid moves under the disc as its pressure increases: the contact's left edge moves inwards,
// the faster the softer the bulk. Beyond a limit point no contact can seal the fluid. The path is
// parameterised by the position of that edge instead of the pressure, and passes through the
// maximum pressure that a contact seals. A disc under a higher pressure is open (warning
// "disc-opens"), which is not an error.
//
// Fluid acts normally on the open arcs up to the contact edges of the undeformed circle. The disc
// is supported by the wall, which it contacts before the pressure is applied, and slides without
// friction. The stretch reduces the section; the load is the load per length times the fitted mean
// circumference pi (D - g). Not modelled: finite strain, housing compliance, friction, the gap next
// to the land. Takes about 0.2 ms without pressure difference, 2 ms with.
#include "engine/contact/fit_models.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "engine/base/check.h"
#include "engine/contact/closed_forms.h"
#include "engine/contact/disc/disc_system.h"
#include "engine/numeric/root.h"

// Figures of one resolution, dimensionless.
enum { LOAD, PEAK, WIDTH, FIGURES }; // load C/R, peak C, width/R

// A solution with its edges, and what is carried from one resolution to the next.
typedef struct {
  double centre, half; // of the contact over R
  size_t points, unknowns;
  double pressure;                   // of the fluid on one side over `trapped`, times C
  double trapped;                    // of a filled corner, times C
  double shift;                      // of the section's centre to the wall by that pressure, over R
  double excess[SB_DISC_POINTS_MAX]; // the system's series
  double figure[FIGURES];
} Solution;

typedef struct {
  SbDiscSystem system;
  double dry; // half-width without pressure difference
  // Right and left edge and the wall's under pressure, 0: not yet known; pressure in the corner.
  double wet[4];
  double pressure;     // of the fluid, times C
  double both, shrink; // hydrostatic displacement by the pressure on both sides, by C times one
  double free_bulge;   // of the dry flank
  SbBroyden edges[4];  // dry, under pressure, with the corner filled, for a given left edge
} Work;

// The corner filled to the pressure x[2]: the wall's contact ends where the bore's does.
static bool filled_corner(double *residual, const double *x, void *context) {
  Work *w = context;
  const double edge[] = {x[0], x[1], sqrt(fmax(0.0, (1.0 - x[0]) * (1.0 + x[0])))};
  w->system.pressure = w->pressure - x[2];
  w->system.hydrostatic = w->both + w->shrink * x[2];
  return w->system.pressure > 0.0 && sb_disc_system_solve(residual, edge, &w->system);
}

// Smooth edges at a pressure from those in `v`, with the corner filled where they would pass it;
// false leaves `v`.
static bool find_edges(Work *w, double pressure, double *v) {
  const size_t count = pressure == 0.0 ? 1 : 3;
  double trial[3];
  memcpy(trial, v, count * sizeof *v);
  w->system.pressure = w->pressure = pressure;
  w->system.hydrostatic = w->both;
  bool found = !(count > 1 && v[3] > 0.0) &&
               sb_solve_system(sb_disc_system_solve, &w->system, trial, count,
                               count == 1 ? 1e-12 : 1e-9, &w->edges[count > 1]);
  if (found) {
    memcpy(v, trial, count * sizeof *v);
  } else if (count > 1 && hypot(v[0], v[2]) > 0.97) {
    double x[] = {v[0], v[1], v[3]};
    found = sb_solve_system(filled_corner, w, x, 3, 1e-9, &w->edges[2]) && x[2] >= 0.0;
    if (found) {
      v[0] = x[0];
      v[1] = x[1];
      v[2] = sqrt((1.0 - x[0]) * (1.0 + x[0]));
      v[3] = x[2];
    }
  }
  return found;
}

// Solves at the present resolution for pressure `target`: from the edges of the coarser one, else
// from the dry disc, in smaller steps where the edges are not found. Returns the pressure that was
// reached, with the system's solution for it; negative if not even the dry disc.
static double solve_pressure(Work *w, double target) {
  if (!find_edges(w, 0.0, &w->dry)) {
    return -1.0;
  }
  w->free_bulge = sb_disc_system_bulge(&w->system);
  double done = 0.0;
  double step = target;
  // Pressures are over about the modulus: a soft disc's may be hundreds.
  while (done < target && step > fmin(target / 128.0, 2e-3)) {
    const double next = fmin(target, done + step);
    const bool coarser = w->wet[2] > 0.0 && done == 0.0;
    if (w->wet[2] == 0.0) {
      // The wall as wide as Hertz's contact under the fluid's force.
      w->wet[0] = w->dry;
      w->wet[1] = -w->dry;
      w->wet[2] = fmin(0.8, sqrt(4.0 * next * sqrt(1.0 - w->dry * w->dry)));
      w->wet[3] = 0.0;
    }
    if (find_edges(w, next, w->wet)) {
      done = next;
    } else {
      w->wet[2] = done > 0.0 ? w->wet[2] : 0.0;
      step *= coarser ? 1.0 : 0.5;
    }
  }
  if (done < target) {
    // The solution of what was reached.
    double ignored[3];
    w->system.pressure = done - (done > 0.0 ? w->wet[3] : 0.0);
    w->system.hydrostatic = w->both + (done > 0.0 ? w->shrink * w->wet[3] : 0.0);
    if (!sb_disc_system_solve(ignored, done > 0.0 ? w->wet : &w->dry, &w->system)) {
      return -1.0;
    }
  }
  return done;
}

// Right edge x[0], wall or corner x[1], and the pressure x[2] for the left edge in `wet`.
static bool given_left(double *residual, const double *x, void *context) {
  Work *w = context;
  w->pressure = x[2];
  if (w->wet[3] > 0.0) {
    return filled_corner(residual, (double[]){x[0], w->wet[1], x[1]}, w);
  }
  w->system.pressure = x[2];
  w->system.hydrostatic = w->both;
  return x[2] > 0.0 &&
         sb_disc_system_solve(residual, (double[]){x[0], w->wet[1], x[1]}, &w->system);
}

// Returns the maximum pressure that a contact seals, on the path from the edges in `wet` at
// `pressure`; INFINITY if no maximum is passed. The first point is one step before these edges,
// which may be at the maximum.
static double find_limit(Work *w, double pressure) {
  double x[] = {w->wet[0], w->wet[3] > 0.0 ? w->wet[3] : w->wet[2], pressure};
  double left[3] = {0.0}, found[3] = {0.0}; // the last three points
  double step = 0.05 * (w->wet[0] - w->wet[1]);
  int points = 0;
  for (int i = 0; i < 60 && step > 1e-4; i++) {
    double trial[3];
    const double from = w->wet[1];
    memcpy(trial, x, sizeof trial);
    w->wet[1] += points > 0 ? step : -step;
    if (!sb_solve_system(given_left, w, trial, 3, 1e-9, &w->edges[3])) {
      w->wet[1] = from;
      step *= 0.5;
      continue;
    }
    memcpy(x, trial, sizeof trial);
    memmove(left, left + 1, 2 * sizeof *left);
    memmove(found, found + 1, 2 * sizeof *found);
    left[2] = w->wet[1];
    found[2] = x[2];
    if (++points > 2 && found[1] > found[0] && found[1] > found[2]) {
      // Top of the parabola.
      const double a = (found[1] - found[0]) / (left[1] - left[0]);
      const double b = (found[2] - found[1]) / (left[2] - left[1]);
      return found[1] + 0.25 * a * a * (left[2] - left[0]) / (a - b);
    }
  }
  return INFINITY;
}

// ---- results of one resolution

// Total pressure times C over that on both sides at tau = cos(angle), the edges regular.
static double total_at(const Solution *s, double angle) {
  double sum = 0.0;
  for (size_t k = 0; k < s->points; k++) {
    sum += s->excess[k] * cos((double)k * (M_PI - angle));
  }
  return (sin(angle) < 1e-6 ? 0.0 : sum / (s->half * sin(angle))) +
         s->pressure * sb_disc_system_step(cos(angle)) + s->trapped;
}

static double negative_at(double angle, const void *solution) {
  return -total_at(solution, angle);
}

// Largest pressure: in the middle, or around the greatest of some samples.
static double peak_of(const Solution *s) {
  enum { SCAN = 32 };
  int best = SCAN / 2;
  for (int i = 1; i < SCAN && s->pressure != 0.0; i++) {
    best = total_at(s, M_PI * i / SCAN) > total_at(s, M_PI * best / SCAN) ? i : best;
  }
  return total_at(s, s->pressure == 0.0 ? 0.5 * M_PI
                                        : sb_minimum(negative_at, s, M_PI * (best - 1) / SCAN,
                                                     M_PI * (best + 1) / SCAN, 1e-8));
}

static void keep(Solution *out, const Work *w) {
  const SbDiscSystem *s = &w->system;
  const bool wet = s->pressure != 0.0;
  *out = (Solution){.centre = s->centre,
                    .half = s->half,
                    .points = s->n,
                    .unknowns = wet ? 2 * s->n + 4 : s->n + 1,
                    .pressure = s->pressure,
                    .trapped = wet ? w->wet[3] : 0.0,
                    .shift = wet ? s->solution[2 * s->n] + w->free_bulge : 0.0};
  memcpy(out->excess, s->series[0], s->n * sizeof out->excess[0]);
  // The step's mean over the contact is one half: p half x 2 x 1/2.
  out->figure[WIDTH] = 2.0 * s->half;
  out->figure[LOAD] =
      (0.5 * s->pressure + out->trapped) * out->figure[WIDTH] + M_PI * out->excess[0];
  out->figure[PEAK] = peak_of(out);
}

// Estimates the errors of the last of three sets of figures at resolutions n[0] < n[1] < n[2]. The
// error decreases like rho^n, so |f1 - f0| is about the error at n[0] and |f2 - f1| that at n[1];
// the remaining error is the remainder of the geometric series. A factor 2 covers uneven rates. The
// radial kernel's kink leaves a tail like n^-4 (n^-7 with fluid) below that, so the rate is never
// assumed to be better. An unsymmetric contact passes through accidental zeros of the error: there
// the slowest rate of the three figures applies to all. The minimum covers quadrature and rounding.
static void estimate(double error[FIGURES], const Solution *s, bool kink) {
  const bool unsymmetric = s[2].pressure != 0.0;
  const double floor = unsymmetric ? 2e-7 : 1e-12;
  const double ratio = (double)(s[2].points - s[1].points) / (double)(s[1].points - s[0].points);
  const double finer = (double)s[1].points / (double)s[2].points;
  double d1[FIGURES];
  double d2[FIGURES];
  double slowest = 0.0;
  for (int i = 0; i < FIGURES; i++) {
    d1[i] = fabs(s[1].figure[i] - s[0].figure[i]);
    d2[i] = fabs(s[2].figure[i] - s[1].figure[i]);
    slowest = fmax(slowest, d1[i] > 0.0 ? fmin(1.0, d2[i] / d1[i]) : 1.0);
  }
  for (int i = 0; i < FIGURES; i++) {
    double rate = d1[i] > 0.0 ? fmin(1.0, d2[i] / d1[i]) : 1.0;
    if (unsymmetric) {
      rate = slowest;
      d2[i] = fmax(d2[i], slowest * d1[i]);
    }
    rate = pow(rate, ratio);
    if (kink && !(unsymmetric && i == PEAK)) {
      rate = fmax(rate, pow(finer, unsymmetric ? 7.0 : i == PEAK ? 6.0 : 4.0));
    }
    error[i] =
        fmax(floor, 2.0 * d2[i] * fmin(1.5, rate / fmax(1.0 - rate, 1e-3)) / fabs(s[2].figure[i]));
  }
}

// ---- solve

// Fills the result. The fluid is on the left (on the right if `mirrored`), with the pressure `both`
// on both sides.
static void fill(SbFit *out, const Solution *s, double compliance, double both, bool mirrored) {
  const double radius = 0.5 * out->section_diameter_fitted;
  const double left = radius * (s->centre - s->half + s->shift);
  const double right = radius * (s->centre + s->half + s->shift);
  out->load_per_length = radius * (s->figure[LOAD] / compliance + both * s->figure[WIDTH]);
  out->pressure_peak = s->figure[PEAK] / compliance + both;
  out->solver.unknowns = s->unknowns;
  sb_fit_contact(out, mirrored ? -right : left, mirrored ? -left : right);
  for (size_t i = 0; i < out->profile_count; i++) {
    const double tau =
        (2.0 * out->profile_x[i] - out->contact_left - out->contact_right) / out->contact_width;
    const double angle = acos(fmin(1.0, fmax(-1.0, mirrored ? -tau : tau)));
    out->profile_p[i] = both + total_at(s, angle) / compliance;
  }
}

// Uniform pressure p shrinks the disc: u_r/R = -p (1 + nu)(1 - 2 nu)/E.
static double hydrostatic_of(const SbFitProblem *in, double p) {
  return p * (1.0 + in->poisson_ratio) * (1.0 - 2.0 * in->poisson_ratio) / in->modulus;
}

// Numbers of points of the resolutions.
static const size_t points[] = {4, 6, 8, 10, 12, 16, 20, 24, 32, 40, 48};
enum { LEVELS = sizeof points / sizeof points[0] };

// Solutions of rising resolution.
typedef struct {
  double target;  // wanted pressure on one side, over that on both, times C
  double wanted;  // error to be reached
  double reached; // pressure that was solved; negative: none
  double error[FIGURES], worst;
  double limit; // pressure that no contact seals, at the last resolution
  bool opens;   // the target is above it
  size_t count;
  Solution found[LEVELS];
} Ladder;

// Solves resolutions until the estimate is as wanted; each starts from the last.
static void climb(Ladder *out, Work *w) {
  enum { COARSE = 4 };
  static const double SAME = 2e-4;
  const double target = out->target;
  for (size_t level = 0; level < LEVELS && out->worst > out->wanted && !out->opens &&
                         (out->reached == target || out->count == 0);
       level++) {
    sb_disc_system_points(&w->system, points[level]);
    const double reached = out->reached = solve_pressure(w, target);
    if (reached < target) {
      const double last = out->limit;
      const double limit = reached > 0.0 && level > 0 ? find_limit(w, reached) : INFINITY;
      out->limit = limit;
      // The resolutions agree on the maximum to a hundredth of the distance from the wanted
      // pressure, or to SAME of it (found by trial): nearer than that the first cannot be met.
      out->opens = isfinite(limit) &&
                   fabs(limit - last) < fmax(SAME * limit, 0.01 * fmin(limit, target - limit));
      if (reached >= 0.0 && (level < COARSE || isfinite(limit))) {
        // So few points cannot represent a filled corner of a narrow contact.
        w->wet[2] = 0.0;
        out->count = 0;
        continue;
      }
      if (reached < 0.0 || out->count > 0) {
        break; // nothing, or nothing better than the coarser resolution
      }
    }
    keep(&out->found[out->count++], w);
    if (out->count >= 3 && reached == target) {
      estimate(out->error, &out->found[out->count - 3], w->system.radial);
      out->worst = fmax(out->error[LOAD], fmax(out->error[PEAK], out->error[WIDTH]));
    }
  }
}

// Returns whether the disc is squeezed so much that the edges of its dry contact, which move
// outwards while the pressure's singularity there is a compressive one, would meet no smooth state
// up to nearly its diameter: the linear disc has no state then.
static bool too_wide(Work *w) {
  static const double WIDEST = 0.98; // of the radius
  double residual;
  w->system.pressure = 0.0;
  w->system.hydrostatic = w->both;
  return sb_disc_system_solve(&residual, &WIDEST, &w->system) && residual > 0.0;
}

// Sets the errors of the last solution, and returns why it is not the wanted one.
static SbStatus judge(SbFit *out, const SbFitProblem *in, const Ladder *ladder, double both,
                      double residual, SbReport *report) {
  const double compliance = sb_disc_compliance(in->modulus, in->poisson_ratio);
  const double reached = ladder->reached, *error = ladder->error;
  if (ladder->opens) {
    const double most = ladder->limit / compliance + both;
    sb_warn(&out->warnings, "disc-opens", SB_CONTACT_IN_PRESSURE,
            "the fluid penetrates under the disc: no contact resists more than %.3g MPa (linear, "
            "%.2g of "
            "the modulus)",
            1e-6 * most, most / in->modulus);
    return SB_OK;
  }
  sb_fit_errors(out, error[LOAD], error[PEAK], error[WIDTH]);
  if (reached != ladder->target) {
    sb_fit_errors(out, 1.0, 1.0, 1.0);
    return sb_fail_input(
        report, SB_ERROR_NOT_CONVERGED,
        reached < 0.0 ? SB_CONTACT_IN_RADIAL_SPACE : SB_CONTACT_IN_PRESSURE,
        "the linear disc found no contact state beyond %.3g MPa (edge residual %.2g)",
        1e-6 * fmax(0.0, reached) / compliance, residual);
  }
  return out->solver.converged ? SB_OK
                               : sb_fail(report, SB_ERROR_NOT_CONVERGED,
                                         "the linear disc's error estimate %.2g stays above %.2g",
                                         ladder->worst, ladder->wanted);
}

static SbStatus solve_spectral(SbFit *out, const SbFitProblem *in, double both, SbReport *report) {
  const double diameter = out->section_diameter_fitted, nu = in->poisson_ratio;
  const double compliance = sb_disc_compliance(in->modulus, nu);
  Work *w = calloc(1, sizeof *w);
  if (w == NULL) {
    return sb_fail(report, SB_ERROR_MEMORY, "no memory for the disc");
  }
  w->system.kernel = sb_disc_kernel(nu);
  w->system.radial = in->variant == SB_DISC_RADIAL || in->variant == SB_DISC_RADIAL_BOTH;
  w->system.half_space = in->radial_space / diameter;
  w->both = hydrostatic_of(in, both);
  w->shrink = hydrostatic_of(in, 1.0 / compliance);
  w->dry = fmin(0.9, sb_hertz_width_of_approach(2.0 * (1.0 - w->system.half_space), 2.0));
  const double target = (fabs(in->pressure) - both) * compliance;
  Ladder ladder = {.target = target,
                   .wanted = 0.1 * (in->tolerance > 0.0 ? in->tolerance : 1e-3),
                   .reached = target,
                   .error = {1.0, 1.0, 1.0},
                   .worst = 1.0,
                   .limit = INFINITY};
  climb(&ladder, w);
  const size_t iterations =
      w->edges[0].iterations + w->edges[1].iterations + w->edges[2].iterations;
  const double residual = w->edges[!(ladder.reached >= 0.0 && target > 0.0) ? 0
                                   : w->wet[3] > 0.0                        ? 2
                                                                            : 1]
                              .residual;
  out->solver.newton_iterations = iterations;
  out->solver.converged = ladder.opens || ladder.worst <= ladder.wanted;
  if (ladder.count > 0) {
    fill(out, &ladder.found[ladder.count - 1], compliance, both, in->pressure < 0.0);
  }
  SbStatus status =
      ladder.reached < 0.0 && too_wide(w)
          ? sb_fail_input(report, SB_ERROR_INFEASIBLE, SB_CONTACT_IN_RADIAL_SPACE,
                          "the contact of the linear disc would be as wide as the disc, which is "
                          "squeezed by %.0f %% of its diameter: this model has no such state",
                          100.0 * (1.0 - w->system.half_space))
          : judge(out, in, &ladder, both, residual, report);
  if (status != SB_OK && report != NULL) {
    report->residual = residual;
    report->iteration = (int)iterations;
  }
  free(w);
  return status == SB_OK ? sb_succeed(report) : status;
}

// Warns of a disc that hardly has contact: its pressure above the fluid's is small against the
// section's other strains, so a ring stretched over its stem, or pressed against its wall, may have
// no contact.
static void judge_margin(SbFit *out, const SbFitProblem *in, double both) {
  static const double LEAST = 0.16; // of the modulus: rings part from discs up to 0.157 (measured)
  const double margin = out->pressure_peak - fmax(fabs(in->pressure), both);
  if (margin < LEAST * in->modulus) {
    sb_warn(&out->warnings, "disc-ring-contact", SB_CONTACT_IN_MODEL,
            "the disc presses %.3g MPa more than the fluid, %.2g of the modulus: below %.2g a "
            "solved ring may have no contact%s",
            1e-6 * margin, margin / in->modulus, LEAST, in->names != NULL ? in->names->ring : "");
  }
}

SbStatus sb_fit_disc(SbFit *out, const SbFitProblem *in, SbReport *report) {
  const double diameter = out->section_diameter_fitted;
  SbStatus status = SB_CHECK(
      report, {SB_CONTACT_IN_SECTION_DIAMETER, "the fitted section [m]", diameter, SB_ABOVE_ZERO});
  if (status != SB_OK) {
    return status;
  }
  const bool thesis = in->model == SB_FIT_DISC_THESIS;
  const bool both_flanks =
      !thesis && (in->variant == SB_DISC_VERTICAL_BOTH || in->variant == SB_DISC_RADIAL_BOTH);
  const double both = both_flanks ? fabs(in->pressure) : 0.0;
  const double difference = fabs(in->pressure) - both;
  const double squeeze = 1.0 - in->radial_space / diameter;
  out->circumference = M_PI * (in->bore_diameter - in->radial_space);
  if (!(squeeze > hydrostatic_of(in, both))) {
    sb_warn_serious(&out->warnings, "no-contact", SB_CONTACT_IN_SECTION_DIAMETER,
                    "the disc has no contact with the flats (squeeze %.3g %%): load 0",
                    100.0 * squeeze);
    out->solver.converged = true;
    return sb_succeed(report);
  }
  if (squeeze > 0.1) {
    sb_warn(&out->warnings, "disc-strain", SB_CONTACT_IN_SECTION_DIAMETER,
            "squeeze %.3g %% is beyond 10 %%: linear elasticity is an estimate", 100.0 * squeeze);
  }
  if (difference > 0.25 * in->modulus && !thesis) {
    sb_warn(&out->warnings, "disc-pressure", SB_CONTACT_IN_PRESSURE,
            "pressure difference is %.2g of the modulus: linear elasticity is an estimate",
            difference / in->modulus);
  }
  status = thesis ? sb_disc_thesis(out, in, report) : solve_spectral(out, in, both, report);
  if (status == SB_OK && out->touches) {
    judge_margin(out, in, both);
  }
  return status;
}
