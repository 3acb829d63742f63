// The rough contact's laws as a film asks them: tables against the formulas, and the pull across
// the open gap.
#include "engine/contact/rough/flow_factor.h"
#include "engine/contact/rough/greenwood_tripp.h"
#include "engine/contact/rough/persson.h"
#include "engine/contact/rough/rough_law.h"
#include "tests/engine/rough_cells.h"

#include <glib.h>
#include <math.h>

static void test_laws(void) {
  SbRoughSurface surface = {SB_ROUGH_GREENWOOD_TRIPP, 0.1289, 1e-6, 0.1, 6.5725e6, 0, 0};
  SbRoughLaw law;
  g_assert_cmpint(sb_rough_law_init(&law, &surface, NULL), ==, SB_OK);
  // Against the integrals themselves, off the table's nodes.
  for (double lambda = -4.03; lambda < 9; lambda += 0.37) {
    double h = average_gap(1e-6, lambda);
    SbRoughPoint at;
    sb_rough_law_at(&at, &law, sb_rough_law_of_gap(&law, h));
    close_to("gap", at.gap, h, 1e-9);
    close_to("pressure", at.pressure, sb_gt_pressure(0.1289, 0.1, 6.5725e6, lambda), 2e-6);
    close_to("share", at.share, sb_gt_area_share(0.1289, lambda), 2e-6);
    double t = sb_rough_law_of_pressure(&law, at.pressure);
    SbRoughPoint back;
    sb_rough_law_at(&back, &law, t);
    close_to("back from the pressure", back.gap, h, 1e-6);
  }
  // Persson's against the direct integral, and slopes against differences.
  surface.model = SB_ROUGH_PERSSON;
  g_assert_cmpint(sb_rough_law_init(&law, &surface, NULL), ==, SB_OK);
  SbSpectrum spectrum;
  g_assert_cmpint(sb_spectrum_from_asperities(&spectrum, 1e-6, 0.1, 0.1289, NULL), ==, SB_OK);
  for (double p = 1e2; p < 3e6; p *= 3) {
    SbRoughPoint at, next;
    double t = sb_rough_law_of_pressure(&law, p);
    sb_rough_law_at(&at, &law, t);
    if (at.gap < 1e-13) {
      break; // closed, and the direct integral's own Simpson rule has no digits left
    }
    close_to("Persson's gap", at.gap, sb_persson_separation(&spectrum, spectrum.q0, 6.5725e6, p),
             2e-4);
    close_to("Persson's share", at.share,
             sb_persson_area_share(&spectrum, spectrum.q1, 6.5725e6, p), 1e-5);
    sb_rough_law_at(&next, &law, t + 1e-5);
    close_to("slope of the gap", (next.gap - at.gap) / 1e-5, at.gap_slope, 1e-3);
    close_to("slope of the pressure", (next.pressure - at.pressure) / 1e-5, at.pressure_slope,
             1e-3);
  }
}

// Law of a surface that percolates, against table A7 of the reference page: p/p*, phi_p, S/sigma^3.
static void test_flow(void) {
  static const struct {
    double load, share, gap, flow, conductance;
  } rows[] = {
      {0.02, 0.0088, 1.957, 0.794, 5.94},   {0.05, 0.0221, 1.507, 0.668, 2.29},
      {0.1, 0.0441, 1.154, 0.526, 0.809},   {0.2, 0.0882, 0.793, 0.329, 0.164},
      {0.3, 0.1319, 0.586, 0.180, 0.0361},  {0.4, 0.1752, 0.447, 0.105, 9.3e-3},
      {0.5, 0.2180, 0.347, 0.070, 3.0e-3},  {0.6, 0.2602, 0.274, 0.038, 7.8e-4},
      {0.7, 0.3016, 0.218, 0.012, 1.3e-4},  {0.8, 0.3421, 0.175, 1.8e-3, 9.9e-6},
      {0.9, 0.3816, 0.141, 1.8e-4, 5.1e-7}, {1, 0.42, 0.1146, 0, 0},
  };
  static const double thick[][2] = {{5, 0.948}, {4, 0.925}, {3, 0.885}, {2, 0.801}};
  const SbRoughSurface surface = {.model = SB_ROUGH_PERSSON,
                                  .product = 0.1289,
                                  .sigma = 1e-6,
                                  .sigma_over_beta = 0.1,
                                  .modulus = 6.5725154e6,
                                  .threshold = 0.42};
  SbRoughLaw law;
  SbRoughPoint at, next;
  SbSpectrum spectrum;
  g_assert_cmpint(sb_rough_law_init(&law, &surface, NULL), ==, SB_OK);
  g_assert_cmpint(sb_spectrum_from_asperities(&spectrum, 1e-6, 0.1, 0.1289, NULL), ==, SB_OK);
  const double closing = sb_persson_pressure(&spectrum, spectrum.q1, surface.modulus, 0.42);
  close_to("closing pressure", closing, 131753.65, 1e-7);
  for (size_t i = 0; i < G_N_ELEMENTS(rows); i++) {
    const double p = rows[i].load * closing, u = rows[i].gap;
    const double t = sb_rough_law_of_pressure(&law, p);
    sb_rough_law_at(&at, &law, t);
    close_to("share", at.share, rows[i].share, 5e-3);
    close_to("gap", at.gap / 1e-6, u, 5e-3);
    double direct;
    SbStatus found =
        sb_flow_factors(&direct, &(double){log(2 * p / surface.modulus)}, 1, &spectrum, 0.42, NULL);
    g_assert_cmpint(found, ==, SB_OK);
    g_test_message("p/p* %g: phi %.4g, direct %.4g, page %g; S %.3g", rows[i].load, at.flow, direct,
                   rows[i].flow, at.flow * pow(at.gap * 1e6, 3));
    if (rows[i].load == 1) {
      g_assert_cmpfloat(at.flow, <, 1e-12);
    } else {
      close_to("table", at.flow, direct, rows[i].load > 0.85 ? 0.15 : 0.01);
      // Above 0.7 p* the page's phi_p depends on its own grid of wave numbers by a third and more.
      close_to("flow factor", at.flow, rows[i].flow, rows[i].load <= 0.7 ? 0.1 : 0.5);
      close_to("conductance", at.flow * pow(at.gap * 1e6, 3), rows[i].conductance,
               rows[i].load <= 0.7 ? 0.1 : 0.5);
      sb_rough_law_at(&next, &law, t + 1e-5);
      close_to("its slope", (next.flow - at.flow) / 1e-5, at.flow_slope, 1e-3);
    }
  }
  for (size_t i = 0; i < G_N_ELEMENTS(thick); i++) {
    sb_rough_law_at(&at, &law, sb_rough_law_of_gap(&law, thick[i][0] * 1e-6));
    close_to("thick film", at.flow, thick[i][1], 5e-3);
  }
  sb_rough_law_at(&at, &law, sb_rough_law_of_pressure(&law, 1.01 * closing));
  g_assert_cmpfloat(at.flow, ==, 0);
  g_assert_cmpfloat(at.flow_slope, ==, 0);
  SbRoughSurface wrong = surface;
  wrong.model = SB_ROUGH_GREENWOOD_TRIPP;
  g_assert_cmpint(sb_rough_law_init(&law, &wrong, NULL), ==, SB_ERROR_INPUT);
  wrong.model = SB_ROUGH_PERSSON;
  wrong.threshold = 1;
  g_assert_cmpint(sb_rough_law_init(&law, &wrong, NULL), ==, SB_ERROR_RANGE);
}

// The tables of another modulus are the same to the bit; those of other heights, or of tips that
// stick, serve nobody.
static void test_like(void) {
  for (int model = SB_ROUGH_GREENWOOD_TRIPP; model <= SB_ROUGH_PERSSON; model++) {
    SbRoughSurface surface = {(SbRoughModel)model, 0.1289, 1e-6, 0.1, 6.5725e6, 0, 0};
    SbRoughLaw known, anew, like;
    g_assert_cmpint(sb_rough_law_init(&known, &surface, NULL), ==, SB_OK);
    for (int k = 0; k < 3; k++) {
      surface.modulus = k == 0 ? 3.1e6 : surface.modulus;
      surface.sigma = k == 1 ? 2e-6 : surface.sigma;
      surface.product = k == 2 ? 0.05 : surface.product;
      g_assert_cmpint(sb_rough_law_init(&anew, &surface, NULL), ==, SB_OK);
      g_assert_cmpint(sb_rough_law_like(&like, &surface, &known, NULL), ==, SB_OK);
      g_assert_cmpmem(&like, sizeof like, &anew, sizeof anew);
      g_assert_true(sb_rough_same_surface(&like.surface, &surface));
    }
    g_assert_cmpint(sb_rough_law_like(&like, &surface, NULL, NULL), ==, SB_OK);
    g_assert_cmpmem(&like, sizeof like, &anew, sizeof anew);
    surface.modulus = 0;
    g_assert_cmpint(sb_rough_law_like(&like, &surface, &anew, NULL), ==, SB_ERROR_RANGE);
  }
  SbRoughSurface sticks = {SB_ROUGH_GREENWOOD_TRIPP, 0.1289, 1e-6, 0.1, 6.5725e6, 0.05, 0};
  SbRoughLaw known, anew, like;
  g_assert_cmpint(sb_rough_law_init(&known, &sticks, NULL), ==, SB_OK);
  sticks.modulus = 3.1e6;
  g_assert_cmpint(sb_rough_law_init(&anew, &sticks, NULL), ==, SB_OK);
  g_assert_cmpint(sb_rough_law_like(&like, &sticks, &known, NULL), ==, SB_OK);
  g_assert_cmpmem(&like, sizeof like, &anew, sizeof anew);
}

// Pull at a point of the law: its slope against differences, nil where no gap is open, and the
// cut-off on the open gap.
static void test_pull(void) {
  const double hamaker = 1.35e-19;
  for (int model = SB_ROUGH_GREENWOOD_TRIPP; model <= SB_ROUGH_PERSSON; model++) {
    SbRoughSurface surface = {(SbRoughModel)model, 0.1289, 1e-7, 0.1, 6.5725e6, 0, 0};
    SbRoughLaw law;
    g_assert_cmpint(sb_rough_law_init(&law, &surface, NULL), ==, SB_OK);
    for (double gap = 3e-9; gap < 4e-7; gap *= 1.7) {
      SbRoughPoint at[3];
      double pull[3], slope[3], t = sb_rough_law_of_gap(&law, gap);
      for (int i = 0; i < 3; i++) {
        sb_rough_law_at(&at[i], &law, t + 1e-4 * (i - 1));
        pull[i] = sb_rough_pull(&slope[i], &at[i], hamaker);
      }
      double open = 1 - at[1].share;
      close_to("pull", pull[1], open * sb_vdw_attraction(hamaker, at[1].gap / open), 1e-12);
      close_to("its slope", (pull[2] - pull[0]) / 2e-4, slope[1], 1e-4);
    }
  }
  double slope;
  SbRoughPoint closed = {.gap = 1e-12, .gap_slope = 1, .share = 1};
  g_assert_cmpfloat(sb_rough_pull(&slope, &closed, hamaker), ==, 0);
  g_assert_cmpfloat(slope, ==, 0);
  SbRoughPoint half = {.gap = 1e-10, .gap_slope = 1, .share = 0.5}; // 0.2 nm where it is open
  close_to("cut-off", sb_rough_pull(&slope, &half, hamaker),
           0.5 * sb_vdw_attraction(hamaker, 2e-10), 1e-12);
}

// ---------------------------------------------------------------- tips that stick

// Johnson, Kendall and Roberts by the load they give it: a^3 = R/K (P + 3 pi w R + sqrt(6 pi w R P
// + (3 pi w R)^2)), pull-off 3/2 pi w R; torn in fixed grips at 5/6 pi w R and the approach
// -(3/4) (pi^2 w^2 R/E*^2)^(1/3). DMT: 2 pi w R at no contact at all.
static void test_tip(void) {
  const double R = 5e-6, w = 0.05, soft = 6.5725e6, stiff = 300e9;
  SbAsperity tip;
  SbAsperityPoint at;
  sb_asperity_init(&tip, R, soft, w);
  g_assert_true(tip.jkr);
  const double unit = M_PI * w * R, K = 4.0 / 3 * soft / 2;
  for (double P = -1.49; P < 50; P += 0.7) {
    double a = cbrt(R / K * unit * (P + 3 + sqrt(6 * P + 9)));
    sb_asperity_at(&at, &tip, a);
    close_to("load", at.elastic - at.pull, P * unit, 1e-10 + 1e-12 / fabs(P));
  }
  double least = 0;
  for (double a = 1; a < 4; a += 1e-4) {
    sb_asperity_at(&at, &tip, a * tip.least);
    least = fmin(least, at.elastic - at.pull);
  }
  close_to("pull-off", least, -1.5 * unit, 1e-7);
  sb_asperity_at(&at, &tip, tip.least);
  close_to("pull when torn", at.elastic - at.pull, -5.0 / 6 * unit, 1e-12);
  close_to("stretch", at.approach, -0.75 * cbrt(M_PI * M_PI * w * w * R / (soft / 2 * soft / 2)),
           1e-12);
  g_assert_cmpfloat(fabs(at.approach_slope), <, 1e-12);
  close_to("Tabor", tip.tabor, cbrt(R * w * w / (soft * soft / 4)) / 0.165e-9, 1e-12);

  sb_asperity_init(&tip, 1e-8, stiff, 1e-3);
  g_assert_false(tip.jkr);
  sb_asperity_at(&at, &tip, 0);
  close_to("pull-off of DMT", at.elastic - at.pull, -2 * M_PI * 1e-3 * 1e-8, 1e-12);
  SbWarnings warnings = {0};
  sb_asperity_warn(&warnings, &tip);
  g_assert_cmpuint(warnings.count, ==, 0);
  sb_asperity_init(&tip, 1e-7, 1e9, 1e-2); // between the two
  sb_asperity_warn(&warnings, &tip);
  g_assert_cmpstr(warnings.item[0].code, ==, "adhesion-transition");
}

// Load of one of Fuller and Tabor's asperities over pi w R at an overlap over the stretch, JKR's
// equations solved by bisection for the contact radius.
static double stuck_load(double overlap) {
  // With A = a/(pi w R^2/K)^(1/3): approach A^2 - (2/3) sqrt(6 A), torn at -3/6^(2/3).
  double low = pow(6, -1.0 / 3), high = 1e4, wanted = overlap * 3 * pow(6, -2.0 / 3);
  for (int i = 0; i < 60; i++) {
    double A = (low + high) / 2;
    *(A * A - 2.0 / 3 * sqrt(6 * A) < wanted ? &low : &high) = A;
  }
  return low * low * low - low * sqrt(6 * low);
}

// Pull-off of Fuller and Tabor's surface over that of all its asperities at one height, against
// their parameter 1/Delta = sigma over the stretch: by trapezoids over the heights.
static void test_fuller_tabor(void) {
  const double R = 5e-6, w = 0.05, modulus = 6.5725e6;
  SbAsperity tip;
  SbAsperityPoint torn;
  sb_asperity_init(&tip, R, modulus, w);
  sb_asperity_at(&torn, &tip, tip.least);
  double before = 1;
  for (double ratio = 0.1; ratio < 5; ratio *= 1.6) { // sigma over stretch
    const double sigma = -ratio * torn.approach;
    double found = 0, direct = 0;
    for (double lambda = -1; lambda < 4 + 1 / ratio; lambda += 0.1) {
      double sums[3], sum = 0;
      sb_asperity_sums(sums, &tip, sigma, lambda, false);
      found = fmin(found, (sums[0] - sums[1]) / (1.5 * M_PI * w * R));
      const double step = 8e-3; // z = lambda - 1/ratio + v^2: the load has a root where it tears
      for (int i = 0; i < 800; i++) {
        double v = step * (i + 0.5), z = lambda - 1 / ratio + v * v;
        sum += 2 * v * step * stuck_load((z - lambda) * ratio) * exp(-z * z / 2);
      }
      direct = fmin(direct, sum / sqrt(2 * M_PI) / 1.5);
    }
    double theta = modulus / 2 * sigma * sqrt(sigma / R) / w;
    g_test_message("1/Delta %.2f theta %.2f pull-off %.6f direct %.6f", ratio, theta, found,
                   direct);
    close_to("Fuller and Tabor's pull-off", found, direct, 1e-4);
    g_assert_cmpfloat(-found, <, before);
    before = -found;
  }
  // Roughness of three times the stretch leaves less than a hundredth (their figure 6).
  g_assert_cmpfloat(before, <, 0.01);
}

// Tables of tips that stick: to Greenwood and Tripp's without work; against the sums between nodes,
// slopes against differences; the law turns to a pull that grows with the work of adhesion.
static void test_sticking_law(void) {
  SbRoughSurface surface = {SB_ROUGH_GREENWOOD_TRIPP, 0.1289, 2e-7, 0.1, 6.5725e6, 0, 0};
  SbRoughLaw bare, law;
  SbRoughPoint at, was, next;
  g_assert_cmpint(sb_rough_law_init(&bare, &surface, NULL), ==, SB_OK);
  surface.work = 1e-12;
  g_assert_cmpint(sb_rough_law_init(&law, &surface, NULL), ==, SB_OK);
  for (double gap = 1e-9; gap < 1e-6; gap *= 1.3) {
    sb_rough_law_at(&at, &law, sb_rough_law_of_gap(&law, gap));
    sb_rough_law_at(&was, &bare, sb_rough_law_of_gap(&bare, gap));
    close_to("pressure without work", at.pressure - at.pull, was.pressure, 1e-4);
    close_to("area without work", at.share, was.share, 1e-4);
  }
  double pulled = 0;
  const double works[] = {1e-2, 5e-2, 0.1315};
  for (size_t k = 0; k < G_N_ELEMENTS(works); k++) {
    surface.work = works[k];
    g_assert_cmpint(sb_rough_law_init(&law, &surface, NULL), ==, SB_OK);
    double least = 0;
    const double density = 4 * M_PI * 0.1289 * 0.1289 * 0.1 / (2e-7 * 2e-7);
    for (double t = -5.03; t < 10; t += 0.13) {
      double sums[3];
      sb_rough_law_at(&at, &law, t);
      sb_rough_law_at(&next, &law, t + 1e-6);
      sb_asperity_sums(sums, &law.tip, 2e-7, t, true);
      close_to("elastic", at.pressure, density * sums[0], 1e-5);
      close_to("pull", at.pull, density * sums[1], 1e-5);
      close_to("area", at.share, fmin(density * sums[2], 1), 1e-5);
      close_to("area by itself", sb_rough_area_share(&surface, t), fmin(density * sums[2], 1),
               1e-12);
      close_to("slope", next.pull - at.pull, 1e-6 * at.pull_slope, 1e-4);
      sb_rough_law_at(&was, &bare, t);
      g_assert_cmpfloat(at.share, >=, was.share);
      least = fmin(least, at.pressure - at.pull);
    }
    g_test_message("w %g: Tabor %.3g, pull-off %.4g Pa", works[k], law.tip.tabor, -least);
    g_assert_cmpfloat(-least, >, 2 * pulled);
    pulled = -least;
    for (double load = 1; load < 1e8; load *= 30) {
      sb_rough_law_at(&at, &law, sb_rough_law_of_load(&law, load));
      close_to("load", at.pressure - at.pull, load, 1e-6 + 1e-9 * at.pull / load);
    }
  }
  surface.model = SB_ROUGH_PERSSON;
  g_assert_cmpint(sb_rough_law_init(&law, &surface, NULL), ==, SB_ERROR_INPUT);
  surface.model = SB_ROUGH_GREENWOOD_TRIPP;
  surface.sigma = 1e-9;
  surface.work = 1;
  g_assert_cmpint(sb_rough_law_init(&law, &surface, NULL), ==, SB_ERROR_RANGE);
}

int main(int argc, char **argv) {
  g_test_init(&argc, &argv, NULL);
  g_test_add_func("/rough-law/tables", test_laws);
  g_test_add_func("/rough-law/flow", test_flow);
  g_test_add_func("/rough-law/like", test_like);
  g_test_add_func("/rough-law/pull", test_pull);
  g_test_add_func("/rough-law/tip", test_tip);
  g_test_add_func("/rough-law/fuller-tabor", test_fuller_tabor);
  g_test_add_func("/rough-law/sticking", test_sticking_law);
  return g_test_run();
}
