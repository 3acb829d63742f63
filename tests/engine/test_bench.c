// Every bench case meets what its tolerance promises, and its estimate is honest.
#include "engine/valve/answer/bench.h"

#include <glib.h>
#include <math.h>
#include <string.h>

static void test_cases(void) {
  SbBenchCase before;
  for (size_t i = 0; i < sb_bench_count(); i++) {
    SbBenchCase out;
    SbReport report = {0};
    SbStatus status = sb_bench_run(&out, i, 1, i > 0 ? &before : NULL, &report);
    g_test_message("%-16s %-36s %5zu unknowns %3zu it %9.3f ms error %.2g estimate %.2g order %.1f",
                   out.solver, out.name, out.unknowns, out.iterations, 1e3 * out.wall_s, out.error,
                   out.error_estimate, out.order);
    if (status != SB_OK) {
      g_test_message("%s", report.text);
    }
    g_assert_cmpint(status, ==, SB_OK);
    // The references have five (disc) or six digits and more; closed forms and balances are at
    // rounding.
    double allowed = strcmp(out.solver, "reynolds") == 0 ? 1e-2
                     : strcmp(out.solver, "ring") == 0   ? 1e-2
                     : strcmp(out.solver, "disc") == 0   ? 1e-2
                                                         : 1e-6;
    // A film solved on the finest mesh has no error to show.
    bool finest = strcmp(out.solver, "reynolds") == 0 && out.error_estimate < 1e-8;
    g_assert_true(out.error < allowed || (isnan(out.error) && finest));
    // Honest as far as the ring's reference has digits, and an order that is one.
    double digits = strcmp(out.solver, "ring") == 0 ? 1e-4 : 1e-15;
    if (isfinite(out.error_estimate) && isfinite(out.error)) {
      g_assert_cmpfloat(out.error, <=, 3 * out.error_estimate + digits);
    }
    g_assert_true(isnan(out.order) || out.order > 1);
    before = out;
  }
}

int main(int argc, char **argv) {
  g_test_init(&argc, &argv, NULL);
  g_test_add_func("/bench/cases", test_cases);
  return g_test_run();
}
