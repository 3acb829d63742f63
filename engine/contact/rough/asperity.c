// Sums of asperities; equations and sources in asperity.h.
//
// With W the density phi of heights, or its integral Q for pairs, a sum is
//
//   integral f(a) W(lambda + delta(a)/sigma) delta'(a)/sigma da      from where a contact tears
//
// integrated over b with a = (sqrt(a_0) + (R sigma)^(1/4) b)^2. In b everything is smooth, from
// Hertz's limit to asperities that adhere at distances much larger than sigma.
#include "engine/contact/rough/asperity.h"

#include "engine/contact/inputs.h"
#include "engine/numeric/legendre.h"
#include "engine/numeric/root.h"

#include <math.h>

void sb_asperity_init(SbAsperity *out, double radius, double modulus, double work) {
  static const double DIVIDE = 0.7; // geometric mean of SB_TABOR_DMT and SB_TABOR_JKR
  double stretch = work / (modulus / 2);
  *out = (SbAsperity){.radius = radius, .K = 2 * modulus / 3, .work = work};
  out->tabor = cbrt(radius * stretch * stretch) / SB_VDW_CUTOFF;
  out->jkr = out->tabor > DIVIDE;
  out->least = out->jkr ? cbrt(M_PI * work * radius * radius / (6 * out->K)) : 0;
}

void sb_asperity_warn(SbWarnings *warnings, const SbAsperity *asperity) {
  const double tabor = asperity->tabor;
  if (tabor > SB_TABOR_DMT && tabor < SB_TABOR_JKR) {
    sb_warn(warnings, "adhesion-transition", SB_CONTACT_IN_WORK_OF_ADHESION,
            "Tabor's parameter of the asperities is %.3g, between DMT (below %g) and JKR (above "
            "%g): %s is used, its pull-off is wrong by up to a third",
            tabor, SB_TABOR_DMT, SB_TABOR_JKR, asperity->jkr ? "JKR" : "DMT");
  }
}

void sb_asperity_at(SbAsperityPoint *out, const SbAsperity *asperity, double a) {
  const double K = asperity->K, R = asperity->radius;
  *out = (SbAsperityPoint){.elastic = K * a * a * a / R,
                           .pull = 2 * M_PI * asperity->work * R,
                           .approach = a * a / R,
                           .approach_slope = 2 * a / R};
  if (asperity->jkr) {
    double neck = sqrt(6 * M_PI * asperity->work * a / K);
    out->pull = K * a * neck;
    out->approach -= 2.0 / 3 * neck;
    out->approach_slope -= neck / (3 * a);
  }
}

typedef struct {
  const SbAsperity *asperity;
  double sigma, end; // end: approach [m]
} Range;

static double contact_radius(const SbAsperity *asperity, double sigma, double b) {
  double root = sqrt(asperity->least) + sqrt(sqrt(asperity->radius * sigma)) * b;
  return root * root;
}

static double before_end(double b, const void *context) {
  const Range *range = context;
  SbAsperityPoint at;
  sb_asperity_at(&at, range->asperity, contact_radius(range->asperity, range->sigma, b));
  return range->end - at.approach;
}

void sb_asperity_sums(double out[3], const SbAsperity *asperity, double sigma, double lambda,
                      bool pairs) {
  enum { PANELS = 40, POINTS = 8 };
  double node[POINTS], weight[POINTS];
  sb_legendre_gauss(node, weight, POINTS);
  SbAsperityPoint at;
  sb_asperity_at(&at, asperity, asperity->least);
  // Heights with a probability below e^-40 of the most probable contact are neglected.
  const double first = fmax(lambda + at.approach / sigma, 0);
  const Range range = {asperity, sigma, sigma * (sqrt(first * first + 80) - lambda)};
  double last = 1;
  while (before_end(last, &range) > 0) {
    last *= 2;
  }
  last = sb_bisect(before_end, &range, 0, last);
  const double step = last / PANELS;
  out[0] = out[1] = out[2] = 0;
  for (int i = 0; i < PANELS; i++) {
    for (int k = 0; k < POINTS; k++) {
      double b = step * (i + (1 + node[k]) / 2);
      double a = contact_radius(asperity, sigma, b);
      sb_asperity_at(&at, asperity, a);
      double z = lambda + at.approach / sigma;
      double heights = pairs ? erfc(z / M_SQRT2) / 2 : exp(-z * z / 2) / sqrt(2 * M_PI);
      double by_b = 2 * sqrt(a) * sqrt(sqrt(asperity->radius * sigma));
      double w = weight[k] * step / 2 * heights * at.approach_slope / sigma * by_b;
      out[0] += w * at.elastic;
      out[1] += w * at.pull;
      out[2] += w * M_PI * a * a;
    }
  }
}
