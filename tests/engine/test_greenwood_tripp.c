// Greenwood and Tripp's integrals against adaptive quadrature, recurrences and printed values.
#include "engine/contact/rough/greenwood_tripp.h"

#include <glib.h>
#include <gsl/gsl_errno.h>
#include <gsl/gsl_integration.h>
#include <gsl/gsl_sf_erf.h>
#include <math.h>

typedef struct {
  double lambda, n;
} Integrand;

// F_n / phi(lambda) in t = v^2, which makes both orders smooth at 0.
static double integrand(double v, void *data) {
  const Integrand *p = data;
  double t = v * v;
  return 2 * v * pow(t, p->n) * exp(-p->lambda * t - t * t / 2);
}

static double quadrature(double lambda, double n) {
  gsl_integration_workspace *work = gsl_integration_workspace_alloc(2000);
  Integrand data = {lambda, n};
  gsl_function function = {integrand, &data};
  // Split at the peak; past `end` nothing is left.
  double peak = sqrt((-lambda + sqrt(lambda * lambda + 4 * n + 2)) / 2);
  double end = sqrt(-fmin(lambda, 0) + fmin(14, 60 / fmax(lambda, 1e-9)) + 1);
  double a = 0;
  double b = 0;
  double error = 0;
  gsl_integration_qag(&function, 0, peak, 0, 1e-13, 2000, GSL_INTEG_GAUSS61, work, &a, &error);
  gsl_integration_qag(&function, peak, end, 0, 1e-13, 2000, GSL_INTEG_GAUSS61, work, &b, &error);
  gsl_integration_workspace_free(work);
  return (a + b) * exp(-lambda * lambda / 2) / sqrt(2 * M_PI);
}

static void test_quadrature(void) {
  gsl_set_error_handler_off();
  for (double lambda = -10; lambda <= 37; lambda += 0.25) {
    SbGtIntegrals out;
    SbReport report = {0};
    g_assert_cmpint(sb_gt_integrals(&out, lambda, &report), ==, SB_OK);
    g_assert_false(out.underflow);
    double f2 = quadrature(lambda, 2);
    double f5_2 = quadrature(lambda, 2.5);
    g_assert_cmpfloat(fabs(out.F2 / f2 - 1), <, 1e-12);
    g_assert_cmpfloat(fabs(out.F5_2 / f5_2 - 1), <, 1e-12);
  }
}

// Where it does not cancel, F_2 has the closed form (1 + l^2) Q - l phi.
static void test_closed_form(void) {
  for (double lambda = -10; lambda <= 0; lambda += 0.125) {
    SbGtIntegrals out;
    g_assert_cmpint(sb_gt_integrals(&out, lambda, NULL), ==, SB_OK);
    double exact = (1 + lambda * lambda) * gsl_sf_erf_Q(lambda) - lambda * gsl_sf_erf_Z(lambda);
    g_assert_cmpfloat(fabs(out.F2 / exact - 1), <, 1e-12);
  }
}

// The values printed beside thesis equation 5.13.
static void test_printed(void) {
  const double rows[][3] = {{0, 0.5, 0.61664},
                            {0.5, 0.2096, 0.2404},
                            {1, 0.0753, 0.0806},
                            {2, 5.77e-3, 5.42e-3},
                            {3, 2.03e-4, 1.71e-4}};
  for (size_t i = 0; i < G_N_ELEMENTS(rows); i++) {
    SbGtIntegrals out;
    g_assert_cmpint(sb_gt_integrals(&out, rows[i][0], NULL), ==, SB_OK);
    g_assert_cmpfloat(fabs(out.F2 / rows[i][1] - 1), <, 3e-3);
    g_assert_cmpfloat(fabs(out.F5_2 / rows[i][2] - 1), <, 3e-3);
  }
}

static void test_limits(void) {
  SbGtIntegrals out;
  SbReport report = {0};
  g_assert_cmpint(sb_gt_integrals(&out, 37.0001, &report), ==, SB_OK);
  g_assert_true(out.underflow);
  g_assert_cmpfloat(out.F2, ==, 0);
  g_assert_cmpint(sb_gt_integrals(&out, 37, &report), ==, SB_OK);
  g_assert_false(out.underflow);
  g_assert_cmpfloat(out.F2, >, 0);
  g_assert_cmpint(sb_gt_integrals(&out, -10.5, &report), ==, SB_ERROR_RANGE);
  g_assert_cmpint(sb_gt_integrals(&out, NAN, &report), ==, SB_ERROR_INPUT);
}

// Audit section 1: A_a/A = 0.0820 at contact and 160 kPa sqrt(sigma/beta) of asperity pressure.
static void test_surface(void) {
  g_assert_cmpfloat_with_epsilon(sb_gt_area_share(0.1289, 0), 0.0820, 5e-5);
  g_assert_cmpfloat_with_epsilon(sb_gt_pressure(0.1289, 1, 6.5725e6, 0), 160e3, 1e3);
  g_assert_cmpfloat(sb_gt_area_share(0.1289, -9), ==, 1);
  g_assert_true(isnan(sb_gt_area_share(0.1289, -11)));
}

int main(int argc, char **argv) {
  g_test_init(&argc, &argv, NULL);
  g_test_add_func("/greenwood-tripp/quadrature", test_quadrature);
  g_test_add_func("/greenwood-tripp/closed-form", test_closed_form);
  g_test_add_func("/greenwood-tripp/printed", test_printed);
  g_test_add_func("/greenwood-tripp/limits", test_limits);
  g_test_add_func("/greenwood-tripp/surface", test_surface);
  return g_test_run();
}
