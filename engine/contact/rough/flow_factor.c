// See flow_factor.h.
//
// The wave numbers are those at which the mean-square slope grows by equal factors; between two of
// them the contact that is lost has one gap. Separations at one wave number are computed for all
// pressures together.
#include "engine/contact/rough/flow_factor.h"

#include "engine/numeric/root.h"

#include <gsl/gsl_integration.h>

#include <math.h>
#include <stdlib.h>

enum { SHEETS = 48, SCATTER = 16, GAPS = SHEETS * SCATTER };

// Smallest fraction of the mean-square slope; the contact is complete there at all pressures at
// which the deformed surface counts.
static const double LEAST = 1e-6;

// Between these separations, over sigma, phi_p changes into that of the undeformed surface.
static const double DEFORMED = 1.4, UNDEFORMED = 2.2;

// Deviations of the roughness beyond each wave number, over sigma, and the rule of Gauss and
// Hermite for the mean over it: nodes of a standard normal variable, and weights of the sum 1.
typedef struct {
  double height[SHEETS], node[SCATTER], weight[SCATTER];
} Scatter;

static bool set_rule(Scatter *scatter) {
  gsl_integration_fixed_workspace *rule =
      gsl_integration_fixed_alloc(gsl_integration_fixed_hermite, SCATTER, 0, 0.5, 0, 0);
  if (rule == NULL) {
    return false;
  }
  for (int i = 0; i < SCATTER; i++) {
    scatter->node[i] = gsl_integration_fixed_nodes(rule)[i];
    scatter->weight[i] = gsl_integration_fixed_weights(rule)[i] / sqrt(2 * M_PI);
  }
  gsl_integration_fixed_free(rule);
  return true;
}

// Gaps with their fractions of the area; the rest is in contact.
typedef struct {
  int count;
  double cube[GAPS], area[GAPS]; // gap^3 in sigma^3; fractions
  double contact;                // fraction
  double dimension;              // n
} Gaps;

// What the flow through the medium of the conductance S = exp(log_S) lacks, over n S; increases
// with S.
static double lacking(double *slope, double log_S, const void *context) {
  const Gaps *g = context;
  const double n = g->dimension, part = (n - 1) * exp(log_S);
  double sum = 0, rise = 0;
  for (int i = 0; i < g->count; i++) {
    const double open = g->area[i] / (g->cube[i] + part);
    sum += open;
    rise += open * g->cube[i] / (g->cube[i] + part);
  }
  *slope = part * rise / (n - 1);
  return (part * sum + g->contact) / (n - 1) - 1 / n;
}

// S/u^3 of the medium with the mean gap u.
static double obstruct(const Gaps *g, double u) {
  const double n = g->dimension, smooth = log(u * u * u);
  return g->contact >= (n - 1) / n
             ? 0
             : exp(sb_newton_bracketed(lacking, g, smooth - 80, smooth + 3, smooth - 1) - smooth);
}

static double standard_density(double x) {
  return exp(-0.5 * x * x) / sqrt(2 * M_PI);
}

// Mean of max(d + x, 0), x standard normal, less the wanted one.
static double over_mean(double d, const void *wanted) {
  return d * 0.5 * erfc(-d / M_SQRT2) + standard_density(d) - *(const double *)wanted;
}

// phi_p of an undeformed Gaussian surface with the mean gap u, over sigma.
static double undeformed(Gaps *g, double u) {
  enum { PANELS = 160 };
  const double REACH = 8; // in sigma
  const double d = sb_bisect(over_mean, &u, u + 1, u - 40);
  const double low = fmax(d - REACH, 0), step = (d + REACH - low) / PANELS;
  double open = 0;
  g->count = PANELS;
  g->dimension = 2;
  g->contact = 0.5 * erfc(d / M_SQRT2);
  for (int i = 0; i < PANELS; i++) {
    const double gap = low + (i + 0.5) * step;
    g->cube[i] = gap * gap * gap;
    g->area[i] = standard_density(gap - d) * step;
    open += g->area[i];
  }
  for (int i = 0; i < PANELS; i++) {
    g->area[i] *= (1 - g->contact) / open;
  }
  return obstruct(g, u);
}

// One pressure: A and u [sigma] with the roughness up to each wave number.
typedef struct {
  double area[SHEETS + 1], gap[SHEETS + 1];
} Zoom;

// phi_p of the deformed surface.
static double deformed(Gaps *g, const Zoom *zoom, const Scatter *scatter, double threshold) {
  double mean = 0;
  g->count = 0;
  g->contact = zoom->area[SHEETS];
  g->dimension = 2 - (2 - 1 / (1 - threshold)) * fmin(g->contact / threshold, 1);
  for (int k = 0; k < SHEETS; k++) {
    const double lost = zoom->area[k] - zoom->area[k + 1];
    if (!(lost > 0)) {
      continue;
    }
    const double contact = 0.5 * (zoom->area[k] + zoom->area[k + 1]);
    const double u_1 = fmax(0.5 * (zoom->gap[k] + zoom->gap[k + 1]) -
                                (zoom->gap[k + 1] - zoom->gap[k]) * contact / lost,
                            0);
    for (int i = 0; i < SCATTER; i++) {
      const double gap = fabs(u_1 + scatter->height[k] * scatter->node[i]);
      g->cube[g->count] = gap * gap * gap;
      g->area[g->count] = lost * scatter->weight[i];
      mean += gap * g->area[g->count++];
    }
  }
  for (int i = 0; i < g->count; i++) {
    g->cube[i] *= pow(zoom->gap[0] / mean, 3);
  }
  return obstruct(g, zoom->gap[0]);
}

// What one call needs.
typedef struct {
  SbPerssonGap gap;
  Gaps gaps;
  Scatter scatter;
  Zoom zoom[SB_FLOW_PRESSURES];
} Work;

SbStatus sb_flow_factors(double *phi, const double *log_p, int count, const SbSpectrum *s,
                         double threshold, SbReport *report) {
  Work *work = malloc(sizeof *work);
  if (work == NULL || !set_rule(&work->scatter)) {
    free(work);
    return sb_fail(report, SB_ERROR_MEMORY, "no memory for the flow factors");
  }
  double before = s->q0;
  sb_persson_gap_init(&work->gap, s, s->q0);
  for (int k = 0; k <= SHEETS; k++) {
    const double part = k == 0 ? 0 : pow(LEAST, 1 - (double)(k - 1) / (SHEETS - 1));
    const double q = sb_spectrum_wave(s, part);
    if (k > 0) {
      sb_persson_gap_move(&work->gap, s, q);
      work->scatter.height[k - 1] = sb_spectrum_height_beyond(s, sqrt(before * q)) / s->sigma;
      before = q;
    }
    for (int i = 0; i < count; i++) {
      if (k > 0 && work->zoom[i].gap[0] >= UNDEFORMED) {
        continue;
      }
      double slope;
      const double area = sb_persson_area_share(s, q, 2, exp(log_p[i]));
      work->zoom[i].area[k] = area;
      work->zoom[i].gap[k] = sb_persson_gap_at(&slope, &work->gap, log_p[i] - log(area)) / s->sigma;
    }
  }
  for (int i = 0; i < count; i++) {
    const double u = work->zoom[i].gap[0];
    const double f = fmin(fmax((u - DEFORMED) / (UNDEFORMED - DEFORMED), 0), 1);
    const double w = f * f * (3 - 2 * f);
    phi[i] = w < 1 ? (1 - w) * deformed(&work->gaps, &work->zoom[i], &work->scatter, threshold) : 0;
    phi[i] += w > 0 ? w * undeformed(&work->gaps, u) : 0;
  }
  free(work);
  return sb_succeed(report);
}
