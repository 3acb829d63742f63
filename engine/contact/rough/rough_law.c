// Tables of the rough-surface laws; equations and sources in rough_law.h.
//
// Greenwood and Tripp's F_1 and F_3/2 are slopes: F_n' = -n F_(n-1), (F_1(-t))' = Phi(t). For
// Persson the outer integral over wave number runs over the panels of persson.c; the inner one
// depends on one number only, a = w p / E*, and is tabled: G(a) = integral_a^inf [0.45 + 1.65
// erf(x)^2] exp(-x^2)/x dx.
#include "engine/contact/rough/rough_law.h"

#include "engine/contact/rough/greenwood_tripp.h"
#include "engine/contact/rough/persson.h"
#include "engine/contact/rough/van_der_waals.h"

#include <math.h>
#include <string.h>

static const char *const names[SB_ROUGH_COUNT] = {"none", "greenwood-tripp", "persson"};

const char *sb_rough_model_name(SbRoughModel model) {
  return (int)model >= 0 && model < SB_ROUGH_COUNT ? names[model] : "unknown";
}

bool sb_rough_model_from_name(SbRoughModel *out, const char *name) {
  for (int i = 0; name != NULL && i < SB_ROUGH_COUNT; i++) {
    if (strcmp(names[i], name) == 0) {
      *out = (SbRoughModel)i;
      return true;
    }
  }
  return false;
}

// ---------------------------------------------------------------- Greenwood and Tripp

static void table_greenwood_tripp(SbRoughLaw *law) {
  const SbRoughSurface *s = &law->surface;
  law->begin = -8;
  law->step = 0.1;
  law->count = 201;
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
    law->gap[i] = t > 0 ? log(t * share + exp(-t * t / 2) / sqrt(2 * M_PI)) : log_closed[0];
    law->gap_slope[i] = exp(log(share) - law->gap[i]);
    law->pressure[i] = pressure + log_F[3];
    law->pressure_slope[i] = -2.5 * exp(log_F[1] - log_F[3]);
    law->share[i] = area + log_F[2];
    law->share_slope[i] = -2 * exp(log_F[0] - log_F[2]);
  }
}

// ---------------------------------------------------------------- Persson

enum { INNER = 240 };

// ln G over ln a with its slope; G in the header of this file.
typedef struct {
  double begin, step;
  double value[INNER], slope[INNER];
} InnerTable;

static double inner_integrand(double a) {
  double e = erf(a);
  return (0.45 + 1.65 * e * e) * exp(-a * a); // times d ln a
}

static void table_inner(InnerTable *table) {
  // Summed downwards from a = 6.2, where G is 1e-18, by Simpson's rule in ln a.
  enum { SUB = 4 };
  table->begin = log(1e-4);
  table->step = (log(6.2) - table->begin) / (INNER - 1);
  double G = inner_integrand(6.2) / (2 * 6.2 * 6.2);
  for (int i = INNER - 1; i >= 0; i--) {
    double x = table->begin + table->step * i;
    if (i < INNER - 1) {
      double h = table->step / SUB;
      for (int k = 0; k < SUB; k += 2) {
        G += h / 3 *
             (inner_integrand(exp(x + h * k)) + 4 * inner_integrand(exp(x + h * (k + 1))) +
              inner_integrand(exp(x + h * (k + 2))));
      }
    }
    table->value[i] = log(G);
    table->slope[i] = -inner_integrand(exp(x)) / G;
  }
}

// Cubic of values and slopes at both ends of an interval of width h, at its fraction f.
static double hermite(double *slope, double f, double h, const double *value, const double *end) {
  double d = value[1] - value[0];
  double a = h * end[0], b = h * end[1];
  double c2 = 3 * d - 2 * a - b;
  double c3 = a + b - 2 * d;
  *slope = (a + f * (2 * c2 + 3 * f * c3)) / h;
  return value[0] + f * (a + f * (c2 + f * c3));
}

// G at ln a, and dG/d ln a.
static double inner(double *slope, const InnerTable *table, double log_a) {
  double f = (log_a - table->begin) / table->step;
  if (f <= 0) {
    // E1 and the constant rest: the integrand is 0.45 below.
    *slope = -0.45;
    return exp(table->value[0]) + 0.45 * (table->begin - log_a);
  }
  if (f >= INNER - 1) {
    // Steeper than any power; the straight line of the last node suffices at 1e-18.
    double G = exp(table->value[INNER - 1] +
                   table->slope[INNER - 1] * (log_a - table->begin - table->step * (INNER - 1)));
    *slope = G * table->slope[INNER - 1];
    return G;
  }
  int i = (int)f;
  double by;
  double G = exp(hermite(&by, f - i, table->step, &table->value[i], &table->slope[i]));
  *slope = G * by;
  return G;
}

static SbStatus table_persson(SbRoughLaw *law, SbReport *report) {
  const SbRoughSurface *s = &law->surface;
  SbSpectrum spectrum;
  SbStatus status =
      sb_spectrum_from_asperities(&spectrum, s->sigma, s->sigma_over_beta, s->product, report);
  if (status != SB_OK) {
    return status;
  }
  InnerTable table;
  table_inner(&table);
  // Panels of the outer integral: ln w and weight, as in sb_persson_separation().
  enum { PANELS = 240 };
  double log_w[PANELS], weight[PANELS];
  double length = log(spectrum.q1 / spectrum.q0);
  for (int k = 0; k < PANELS; k++) {
    double v = (k + 0.5) / PANELS;
    double q = spectrum.q0 * exp(length * v * v);
    double w = sqrt(2 / sb_spectrum_slope2(&spectrum, q));
    log_w[k] = log(w);
    weight[k] = sqrt(M_PI) * q * q * q * spectrum.amplitude * pow(q, -2 * (spectrum.hurst + 1)) *
                w * 2 * v * length / PANELS / s->sigma;
  }
  // Pressures over E* = E'/2; p_1 is half of that at which the shortest waves close.
  double p_1 = 0.5 * spectrum.slope / M_SQRT2;
  law->begin = -11;
  law->step = 0.1;
  law->count = 411;
  for (int i = 0; i < law->count; i++) {
    double t = law->begin + law->step * i;
    double soft = t > 0 ? log1p(exp(-t)) : -t + log1p(exp(t));
    double log_p = log(p_1 * soft);
    double by_t = -1 / ((1 + exp(t)) * soft); // d ln p/dt
    double sum = 0, slope = 0;
    for (int k = 0; k < PANELS; k++) {
      double by;
      sum += weight[k] * inner(&by, &table, log_w[k] + log_p);
      slope += weight[k] * by;
    }
    law->gap[i] = log(sum);
    law->gap_slope[i] = slope / sum * by_t;
    law->pressure[i] = log_p - M_LN2;
    law->pressure_slope[i] = by_t;
    double z = M_SQRT2 * exp(log_p) / spectrum.slope;
    law->share[i] = log(erf(z));
    law->share_slope[i] = 2 / sqrt(M_PI) * z * exp(-z * z) / erf(z) * by_t;
  }
  return SB_OK;
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
  switch (surface->model) {
  case SB_ROUGH_GREENWOOD_TRIPP:
    table_greenwood_tripp(law);
    break;
  case SB_ROUGH_PERSSON: {
    SbStatus status = table_persson(law, report);
    if (status != SB_OK) {
      return status;
    }
    break;
  }
  default:
    return sb_fail(report, SB_ERROR_INPUT, "this surface has no asperities");
  }
  return sb_succeed(report);
}

void sb_rough_law_at(SbRoughPoint *out, const SbRoughLaw *law, double t) {
  double sigma = law->surface.sigma;
  double modulus = law->surface.modulus;
  double f = (t - law->begin) / law->step;
  int last = law->count - 1;
  if (f >= last) {
    double beyond = t - law->begin - law->step * last;
    double gap = sigma * exp(law->gap[last]);
    out->gap_slope = gap * law->gap_slope[last];
    out->gap = gap + out->gap_slope * beyond;
    out->pressure = modulus * exp(law->pressure[last] + law->pressure_slope[last] * beyond);
    out->pressure_slope = out->pressure * law->pressure_slope[last];
    out->share = exp(law->share[last] + law->share_slope[last] * beyond);
    out->share_slope = out->share * law->share_slope[last];
    return;
  }
  double log_gap, log_p, log_share, gap_by, p_by, share_by;
  if (f <= 0) {
    double beyond = t - law->begin;
    gap_by = law->gap_slope[0];
    p_by = law->pressure_slope[0];
    log_gap = law->gap[0] + gap_by * beyond;
    log_p = law->pressure[0] + p_by * beyond;
    log_share = law->share[0];
    share_by = 0;
  } else {
    int i = (int)f;
    f -= i;
    log_gap = hermite(&gap_by, f, law->step, &law->gap[i], &law->gap_slope[i]);
    log_p = hermite(&p_by, f, law->step, &law->pressure[i], &law->pressure_slope[i]);
    log_share = hermite(&share_by, f, law->step, &law->share[i], &law->share_slope[i]);
  }
  out->gap = sigma * exp(log_gap);
  out->gap_slope = out->gap * gap_by;
  out->pressure = modulus * exp(log_p);
  out->pressure_slope = out->pressure * p_by;
  out->share = exp(fmin(log_share, 0));
  out->share_slope = log_share < 0 ? out->share * share_by : 0;
}

// Parameter where the tabled logarithm, rising (sign +1) or falling (-1), has the value wanted.
static double invert(const SbRoughLaw *law, const double *value, const double *slope, double wanted,
                     double sign) {
  int low = 0, high = law->count - 1;
  if (sign * (wanted - value[0]) <= 0) {
    return law->begin + (wanted - value[0]) / slope[0];
  }
  if (sign * (wanted - value[high]) >= 0) {
    return law->begin + law->step * high + (wanted - value[high]) / slope[high];
  }
  while (high - low > 1) {
    int middle = (low + high) / 2;
    if (sign * (wanted - value[middle]) >= 0) {
      low = middle;
    } else {
      high = middle;
    }
  }
  double f = (wanted - value[low]) / (value[high] - value[low]);
  for (int k = 0; k < 6; k++) {
    double by;
    double now = hermite(&by, f, law->step, &value[low], &slope[low]);
    f = fmin(fmax(f + (wanted - now) / (by * law->step), 0), 1);
  }
  return law->begin + law->step * (low + f);
}

double sb_rough_law_of_gap(const SbRoughLaw *law, double gap) {
  int last = law->count - 1;
  double most = law->surface.sigma * exp(law->gap[last]);
  if (gap >= most) { // straight in the gap itself there
    return law->begin + law->step * last + (gap - most) / (most * law->gap_slope[last]);
  }
  return invert(law, law->gap, law->gap_slope, log(gap / law->surface.sigma), 1);
}

double sb_rough_law_of_pressure(const SbRoughLaw *law, double pressure) {
  return invert(law, law->pressure, law->pressure_slope, log(pressure / law->surface.modulus), -1);
}

// ---------------------------------------------------------------- adhesion

double sb_rough_pull(double *slope, const SbRoughPoint *at, double hamaker) {
  double open = 1 - at->share;
  if (open <= 0) {
    *slope = 0;
    return 0;
  }
  double gap = at->gap / open;
  double gap_slope = (at->gap_slope + gap * at->share_slope) / open;
  double pull = sb_vdw_attraction(hamaker, gap);
  *slope = open * sb_vdw_slope(hamaker, gap) * gap_slope - at->share_slope * pull;
  return open * pull;
}

double sb_rough_snap_in(const SbRoughLaw *law, const SbSnapContact *c) {
  static const double GROWTH = 10;
  // Least slope that lets half a wave of the contact grow, and that from which h^3 s^3 suffices.
  double held = c->modulus * M_PI / (4 * c->width);
  double passage = 2 * c->width / fabs(c->speed);
  double grown = cbrt(GROWTH * 12 * c->viscosity * 27 / 64 * c->modulus * c->modulus / passage);
  // Without asperities s = A_H/(2 pi h^4) outside the cut-off; they only ever take from it.
  double alone = c->hamaker / (2 * M_PI);
  double top = fmin(pow(alone / held, 0.25), cbrt(alone / grown));
  top = top > SB_VDW_CUTOFF ? top : 0;
  if (law == NULL || top == 0) {
    return top;
  }
  SbRoughPoint at;
  for (double t = sb_rough_law_of_gap(law, top); t > law->begin; t -= 0.25 * law->step) {
    sb_rough_law_at(&at, law, t);
    double pull_slope;
    sb_rough_pull(&pull_slope, &at, c->hamaker);
    double s = (at.pressure_slope - pull_slope) / at.gap_slope;
    if (s > held && at.gap * s > grown) {
      return at.gap;
    }
  }
  return 0;
}
