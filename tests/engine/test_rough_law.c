// The rough contact's laws as a film asks them: tables against the formulas, and the pull across
// the open gap.
#include "engine/contact/rough/greenwood_tripp.h"
#include "engine/contact/rough/persson.h"
#include "engine/contact/rough/rough_law.h"
#include "tests/engine/rough_cells.h"

#include <glib.h>
#include <math.h>

static void test_laws(void) {
  SbRoughSurface surface = {SB_ROUGH_GREENWOOD_TRIPP, 0.1289, 1e-6, 0.1, 6.5725e6};
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

// Pull at a point of the law: its slope against differences, nil where no gap is open, and the
// cut-off on the open gap.
static void test_pull(void) {
  const double hamaker = 1.35e-19;
  for (int model = SB_ROUGH_GREENWOOD_TRIPP; model <= SB_ROUGH_PERSSON; model++) {
    SbRoughSurface surface = {(SbRoughModel)model, 0.1289, 1e-7, 0.1, 6.5725e6};
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

int main(int argc, char **argv) {
  g_test_init(&argc, &argv, NULL);
  g_test_add_func("/rough-law/tables", test_laws);
  g_test_add_func("/rough-law/pull", test_pull);
  return g_test_run();
}
