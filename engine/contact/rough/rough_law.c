// Tables of the rough-surface laws; equations and sources in rough_law.h.
//
// Greenwood and Tripp's F_1 and F_3/2 are slopes: F_n' = -n F_(n-1), (F_1(-t))' = Phi(t).
#include "engine/contact/rough/rough_law.h"

#include "engine/contact/inputs.h"
#include "engine/contact/rough/flow_factor.h"
#include "engine/contact/rough/greenwood_tripp.h"
#include "engine/contact/rough/persson.h"
#include "engine/numeric/root.h"

#include <math.h>
#include <string.h>

enum { GAP, PRESSURE, SHARE, PULL, FLOW };

static const SbRoughKind kinds[SB_ROUGH_COUNT] = {
    [SB_ROUGH_NONE] = {.name = "none"},
    [SB_ROUGH_GREENWOOD_TRIPP] = {.name = "greenwood-tripp", .asperities = true},
    [SB_ROUGH_PERSSON] = {.name = "persson", .spectrum = true},
};

const SbRoughKind *sb_rough_kind(SbRoughModel model) {
  return &kinds[(int)model >= 0 && model < SB_ROUGH_COUNT ? model : SB_ROUGH_NONE];
}

const char *sb_rough_model_name(SbRoughModel model) {
  return (int)model >= 0 && model < SB_ROUGH_COUNT ? kinds[model].name : "unknown";
}

bool sb_rough_model_from_name(SbRoughModel *out, const char *name) {
  for (int i = 0; name != NULL && i < SB_ROUGH_COUNT; i++) {
    if (strcmp(kinds[i].name, name) == 0) {
      *out = (SbRoughModel)i;
      return true;
    }
  }
  return false;
}

// ---------------------------------------------------------------- Greenwood and Tripp

SbAsperity sb_rough_tip(const SbRoughSurface *s) {
  SbAsperity tip;
  sb_asperity_init(&tip, s->sigma / s->sigma_over_beta / 2, s->modulus, s->work);
  return tip;
}

// Pairs per area and sigma of overlap: 4 pi beta sigma zeta^2.
static double pair_density(const SbRoughSurface *s) {
  return 4 * M_PI * s->product * s->product * s->sigma_over_beta / (s->sigma * s->sigma);
}

// Pressure, share and pull of tips that stick at the parameter of node i.
static void stick(SbRoughLaw *law, int i) {
  const SbRoughSurface *s = &law->surface;
  const double t = law->begin + law->step * i;
  const double unit[] = {pair_density(s) / s->modulus, pair_density(s) / s->modulus,
                         pair_density(s)};
  static const int quantity[] = {PRESSURE, PULL, SHARE};
  double pairs[3], tips[3];
  sb_asperity_sums(pairs, &law->tip, s->sigma, t, true);
  sb_asperity_sums(tips, &law->tip, s->sigma, t, false);
  for (int k = 0; k < 3; k++) {
    const double sign = quantity[k] == SHARE ? 1 : -1;
    law->value[quantity[k]][i] = sign * log(unit[k] * pairs[k]);
    law->slope[quantity[k]][i] = -sign * tips[k] / pairs[k];
  }
}

static SbStatus table_greenwood_tripp(SbRoughLaw *law, SbReport *report) {
  const SbRoughSurface *s = &law->surface;
  law->begin = -8;
  law->step = 0.1;
  law->count = 201;
  if (s->work > 0) {
    law->tip = sb_rough_tip(s);
    SbAsperityPoint torn;
    sb_asperity_at(&torn, &law->tip, law->tip.least);
    const double stretch = -torn.approach / s->sigma;
    if (stretch > SB_ROUGH_STRETCH_MAX) {
      return sb_fail_input(report, SB_ERROR_RANGE, SB_CONTACT_IN_WORK_OF_ADHESION,
                           "a work of adhesion of %g J/m2 stretches the asperities' tips over "
                           "%.3g of the heights' deviation (at most %g): the surface sticks all "
                           "over",
                           s->work, stretch, SB_ROUGH_STRETCH_MAX);
    }
    law->count = (int)fmin(201 + ceil(10 * stretch), SB_ROUGH_NODES_MAX);
    law->step = (20 + stretch) / (law->count - 1);
  }
  double square = s->product * s->product;
  double pressure = log(8 * M_SQRT2 / 15 * M_PI * square * sqrt(s->sigma_over_beta));
  double area = log(M_PI * M_PI * square);
  for (int i = 0; i < law->count; i++) {
    double t = law->begin + law->step * i;
    double log_F[4], log_closed[4];
    sb_gt_log_integrals(log_F, t);
    // h/sigma = t Phi + phi, or F_1(-t) where that cancels.
    double share = 0.5 * erfc(-t / M_SQRT2);
    sb_gt_log_integrals(log_closed, fabs(t));
    law->value[GAP][i] = t > 0 ? log(t * share + exp(-t * t / 2) / sqrt(2 * M_PI)) : log_closed[0];
    law->slope[GAP][i] = exp(log(share) - law->value[GAP][i]);
    if (s->work > 0) {
      stick(law, i);
      continue;
    }
    law->value[PRESSURE][i] = -pressure - log_F[3];
    law->slope[PRESSURE][i] = 2.5 * exp(log_F[1] - log_F[3]);
    law->value[SHARE][i] = area + log_F[2];
    law->slope[SHARE][i] = -2 * exp(log_F[0] - log_F[2]);
  }
  return sb_succeed(report);
}

// ---------------------------------------------------------------- Persson

// t at which p = p_1 ln(1 + exp(-t)) is p_1 times `soft`.
static double persson_t(double soft) {
  return -log(expm1(soft));
}

// Node of Persson's law at the percolation threshold.
enum { CLOSED = 108 };

// phi_p^(1/4) from node CLOSED, the last one without flow, with slopes that keep it monotone
// (F.N. Fritsch & R.E. Carlson, SIAM J. Numer. Anal. 17 (1980) 238, sufficient limit).
static SbStatus table_flow(SbRoughLaw *law, const SbSpectrum *spectrum, SbReport *report) {
  // Beyond, 1 - phi_p decreases with the square of the gap.
  const int last = (int)fmin(law->count - 1, CLOSED + SB_FLOW_PRESSURES);
  double log_p[SB_FLOW_PRESSURES], phi[SB_FLOW_PRESSURES];
  double *value = law->value[FLOW], *slope = law->slope[FLOW];
  for (int i = CLOSED + 1; i <= last; i++) {
    log_p[i - CLOSED - 1] = M_LN2 - law->value[PRESSURE][i];
  }
  SbStatus status =
      sb_flow_factors(phi, log_p, last - CLOSED, spectrum, law->surface.threshold, report);
  if (status != SB_OK) {
    return status;
  }
  for (int i = CLOSED + 1; i < law->count; i++) {
    const double wider = exp(2 * (law->value[GAP][last] - law->value[GAP][i]));
    const double flow = i <= last ? phi[i - CLOSED - 1] : 1 - (1 - phi[last - CLOSED - 1]) * wider;
    value[i] = fmax(value[i - 1], sqrt(sqrt(flow)));
  }
  for (int i = CLOSED; i < law->count - 1; i++) {
    const double below = i > CLOSED ? value[i] - value[i - 1] : 0, above = value[i + 1] - value[i];
    slope[i] = fmin(0.5 * (below + above), 3 * fmin(below, above)) / law->step;
  }
  slope[law->count - 1] = (value[law->count - 1] - value[law->count - 2]) / law->step;
  return status;
}

static SbStatus table_persson(SbRoughLaw *law, SbReport *report) {
  const SbRoughSurface *s = &law->surface;
  SbSpectrum spectrum;
  SbStatus status =
      sb_spectrum_from_asperities(&spectrum, s->sigma, s->sigma_over_beta, s->product, report);
  if (status != SB_OK) {
    return status;
  }
  SbPerssonGap gap;
  sb_persson_gap_init(&gap, &spectrum, spectrum.q0);
  // Pressures over E* = E'/2; p_1 is half of that at which the shortest waves close.
  double p_1 = 0.5 * spectrum.slope / M_SQRT2;
  law->step = 0.1;
  law->count = 411;
  // The threshold is a node; without one the grid is about the same.
  const double threshold = s->threshold > 0 ? s->threshold : 0.5;
  const double closing = sb_persson_pressure(&spectrum, spectrum.q1, 2, threshold);
  law->begin = s->threshold > 0 ? persson_t(closing / p_1) - CLOSED * law->step : -11;
  for (int i = 0; i < law->count; i++) {
    double t = law->begin + law->step * i;
    double soft = t > 0 ? log1p(exp(-t)) : -t + log1p(exp(t));
    double log_p = log(p_1 * soft);
    double by_t = -1 / ((1 + exp(t)) * soft); // d ln p/dt
    double slope;
    double separation = sb_persson_gap_at(&slope, &gap, log_p);
    law->value[GAP][i] = log(separation / s->sigma);
    law->slope[GAP][i] = slope / separation * by_t;
    law->value[PRESSURE][i] = M_LN2 - log_p;
    law->slope[PRESSURE][i] = -by_t;
    double z = M_SQRT2 * exp(log_p) / spectrum.slope;
    law->value[SHARE][i] = log(erf(z));
    law->slope[SHARE][i] = 2 / sqrt(M_PI) * z * exp(-z * z) / erf(z) * by_t;
  }
  return s->threshold > 0 ? table_flow(law, &spectrum, report) : sb_succeed(report);
}

// ---------------------------------------------------------------- both

SbStatus sb_rough_law_init(SbRoughLaw *law, const SbRoughSurface *surface, SbReport *report) {
  memset(law, 0, sizeof *law);
  law->surface = *surface;
  if (!(surface->product > 0 && surface->sigma > 0 && surface->sigma_over_beta > 0 &&
        surface->modulus > 0)) {
    return sb_fail(report, SB_ERROR_RANGE,
                   "sigma, sigma/beta, the asperity product and the modulus must be positive");
  }
  if (!(surface->work >= 0) || (surface->work > 0 && !sb_rough_kind(surface->model)->asperities)) {
    return sb_fail_input(report, SB_ERROR_INPUT, SB_CONTACT_IN_WORK_OF_ADHESION,
                         "tips that stick need a work of adhesion and the surface "
                         "greenwood-tripp");
  }
  if (!(surface->threshold >= 0 && surface->threshold < 1)) {
    return sb_fail(report, SB_ERROR_RANGE, "the percolation threshold is not in 0 to 1");
  }
  if (surface->threshold > 0 && !sb_rough_kind(surface->model)->spectrum) {
    return sb_fail(report, SB_ERROR_INPUT, "only the surface persson has a percolation threshold");
  }
  static SbStatus (*const table[SB_ROUGH_COUNT])(SbRoughLaw *, SbReport *) = {
      [SB_ROUGH_GREENWOOD_TRIPP] = table_greenwood_tripp, [SB_ROUGH_PERSSON] = table_persson};
  return surface->model != SB_ROUGH_NONE
             ? table[surface->model](law, report)
             : sb_fail(report, SB_ERROR_INPUT, "this surface has no asperities");
}

static bool same_heights(const SbRoughSurface *a, const SbRoughSurface *b) {
  return a->model == b->model && a->product == b->product && a->sigma == b->sigma &&
         a->sigma_over_beta == b->sigma_over_beta && a->threshold == b->threshold;
}

bool sb_rough_same_surface(const SbRoughSurface *a, const SbRoughSurface *b) {
  return same_heights(a, b) && a->modulus == b->modulus && a->work == b->work;
}

SbStatus sb_rough_law_like(SbRoughLaw *law, const SbRoughSurface *surface, const SbRoughLaw *known,
                           SbReport *report) {
  const bool serves = known != NULL && known->count > 0 && !(known->surface.work > 0) &&
                      surface->work == 0 && surface->modulus > 0 &&
                      same_heights(&known->surface, surface);
  if (!serves) {
    return sb_rough_law_init(law, surface, report);
  }
  memmove(law, known, sizeof *law);
  law->surface.modulus = surface->modulus;
  return sb_succeed(report);
}

void sb_rough_law_at(SbRoughPoint *out, const SbRoughLaw *law, double t) {
  double f = (t - law->begin) / law->step;
  double v[SB_ROUGH_QUANTITIES], by[SB_ROUGH_QUANTITIES];
  const int quantities = law->surface.work > 0 ? PULL + 1 : PULL;
  int last = law->count - 1;
  int i = (int)fmin(fmax(f, 0), last - 1);
  double beyond = law->step * (f - fmin(fmax(f, 0), last));
  for (int k = 0; k < quantities; k++) {
    v[k] = sb_hermite(&by[k], fmin(fmax(f - i, 0), 1), law->step, &law->value[k][i],
                      &law->slope[k][i]);
  }
  out->gap = law->surface.sigma * exp(v[GAP] + fmin(beyond, 0) * by[GAP]);
  out->gap_slope = out->gap * by[GAP];
  out->gap += out->gap_slope * fmax(beyond, 0);
  out->pressure = law->surface.modulus * exp(-v[PRESSURE] - beyond * by[PRESSURE]);
  out->pressure_slope = -out->pressure * by[PRESSURE];
  out->pull = out->pull_slope = 0;
  if (quantities > PULL) {
    out->pull = law->surface.modulus * exp(-v[PULL] - beyond * by[PULL]);
    out->pull_slope = -out->pull * by[PULL];
  }
  out->flow = 1;
  out->flow_slope = 0;
  if (law->surface.threshold > 0) {
    double root = sb_hermite(&by[FLOW], fmin(fmax(f - i, 0), 1), law->step, &law->value[FLOW][i],
                             &law->slope[FLOW][i]);
    out->flow = root * root * root * root;
    out->flow_slope = beyond < 0 ? 0 : 4 * root * root * root * by[FLOW];
    if (beyond > 0) { // as of thick films, 1 - phi_p decreases with the square of the gap
      double rest = (1 - out->flow) * pow(law->surface.sigma * exp(v[GAP]) / out->gap, 2);
      out->flow = 1 - rest;
      out->flow_slope = 2 * rest * out->gap_slope / out->gap;
    }
  }
  // Beyond the closed end the share stays.
  double log_share = v[SHARE] + fmax(beyond, 0) * by[SHARE];
  out->share = exp(fmin(log_share, 0));
  out->share_slope = log_share < 0 && f > 0 ? out->share * by[SHARE] : 0;
}

// Parameter where a tabled quantity that rises has the value wanted.
static double invert(const SbRoughLaw *law, int quantity, double wanted) {
  const double *value = law->value[quantity], *slope = law->slope[quantity];
  size_t i = sb_interval(value, (size_t)law->count, wanted);
  double f = (wanted - value[i]) / (value[i + 1] - value[i]), by;
  if (f < 0 || f > 1) {
    size_t end = f < 0 ? i : i + 1;
    return law->begin + law->step * (double)end + (wanted - value[end]) / slope[end];
  }
  for (int k = 0; k < 6; k++) {
    double now = sb_hermite(&by, f, law->step, &value[i], &slope[i]);
    f = fmin(fmax(f + (wanted - now) / (by * law->step), 0), 1);
  }
  return law->begin + law->step * ((double)i + f);
}

double sb_rough_law_closed_gap(const SbRoughLaw *law) {
  return law->surface.threshold > 0 ? law->surface.sigma * exp(law->value[GAP][CLOSED]) : NAN;
}

double sb_rough_law_of_gap(const SbRoughLaw *law, double gap) {
  int last = law->count - 1;
  double most = law->surface.sigma * exp(law->value[GAP][last]);
  if (gap >= most) { // straight in the gap itself there
    return law->begin + law->step * last + (gap - most) / (most * law->slope[GAP][last]);
  }
  return invert(law, GAP, log(gap / law->surface.sigma));
}

double sb_rough_law_of_pressure(const SbRoughLaw *law, double pressure) {
  return invert(law, PRESSURE, -log(pressure / law->surface.modulus));
}

typedef struct {
  const SbRoughLaw *law;
  double load;
} Lacking;

static double over(double t, const void *context) {
  const Lacking *lacking = context;
  SbRoughPoint at;
  sb_rough_law_at(&at, lacking->law, t);
  return at.pressure - at.pull - lacking->load;
}

double sb_rough_law_of_load(const SbRoughLaw *law, double load) {
  const double open = sb_rough_law_of_pressure(law, load);
  if (!(law->surface.work > 0)) {
    return open;
  }
  // The elastic part rises faster towards full contact, and once above the pull stays there.
  const Lacking lacking = {law, load};
  double closed = open - 1;
  while (over(closed, &lacking) < 0 && closed > open - 200) {
    closed -= 1;
  }
  return sb_bisect(over, &lacking, closed, open);
}

double sb_rough_area_share(const SbRoughSurface *s, double lambda) {
  if (!(s->work > 0) || !(lambda >= SB_GT_LAMBDA_MIN)) {
    return sb_gt_area_share(s->product, lambda);
  }
  const SbAsperity tip = sb_rough_tip(s);
  double sums[3];
  sb_asperity_sums(sums, &tip, s->sigma, lambda, true);
  return fmin(1, pair_density(s) * sums[2]);
}

// ---------------------------------------------------------------- adhesion

double sb_vdw_attraction(double hamaker, double gap) {
  double h = fmax(gap, SB_VDW_CUTOFF);
  return hamaker / (6 * M_PI * h * h * h);
}

double sb_vdw_work(double hamaker) {
  return hamaker / (12 * M_PI * SB_VDW_CUTOFF * SB_VDW_CUTOFF);
}

double sb_rough_pull(double *slope, const SbRoughPoint *at, double hamaker) {
  double open = 1 - at->share;
  *slope = at->pull_slope;
  if (open <= 0 || !(hamaker > 0)) {
    return at->pull;
  }
  double gap = at->gap / open;
  double gap_slope = (at->gap_slope + gap * at->share_slope) / open;
  double pull = sb_vdw_attraction(hamaker, gap);
  double pull_slope = gap > SB_VDW_CUTOFF ? -3 * pull / gap : 0; // to the gap
  *slope += open * pull_slope * gap_slope - at->share_slope * pull;
  return at->pull + open * pull;
}

SbSnapWindow sb_rough_snap_in(const SbRoughLaw *law, const SbSnapContact *c) {
  static const double GROWTH = 10;
  // Smallest slope at which half a wave of the contact grows, and that from which h^3 s^3 suffices.
  double held = c->modulus * M_PI / (4 * c->width);
  double passage = 2 * c->width / fabs(c->speed);
  double grown = cbrt(GROWTH * 12 * c->viscosity * 27 / 64 * c->modulus * c->modulus / passage);
  // Without asperities s = A_H/(2 pi h^4) outside the cut-off; they only ever take from it.
  double alone = c->hamaker / (2 * M_PI);
  double top = fmin(pow(alone / held, 0.25), cbrt(alone / grown));
  top = top > SB_VDW_CUTOFF ? top : 0;
  if (law != NULL && law->surface.work > 0) {
    top = law->surface.sigma * exp(law->value[GAP][law->count - 1]);
  }
  SbSnapWindow window = {0, top};
  if (law == NULL || top == 0) {
    return window;
  }
  window.high = 0;
  SbRoughPoint at;
  for (double t = sb_rough_law_of_gap(law, top); t > law->begin; t -= 0.25 * law->step) {
    sb_rough_law_at(&at, law, t);
    double pull_slope;
    sb_rough_pull(&pull_slope, &at, c->hamaker);
    double s = (at.pressure_slope - pull_slope) / at.gap_slope;
    if (s > held && at.gap * s > grown) {
      window.high = fmax(window.high, at.gap);
      window.low = at.gap;
    }
  }
  return window;
}
