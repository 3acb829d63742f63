// Ticks and value formatting against tables, and against hostile ranges.
#include "app/base/format.h"
#include "app/chart/axis.h"

#include <glib.h>
#include <locale.h>
#include <math.h>

static void test_tick_table(void) {
  static const struct {
    double lo, hi;
    int wanted, count;
    double first, step;
    int decimals;
  } rows[] = {
      {0, 35, 8, 8, 0, 5, 0},          {0, 7.4, 8, 8, 0, 1, 0},
      {-0.6, 0.7, 3, 3, -0.5, 0.5, 1}, {0, 1, 5, 6, 0, 0.2, 1},
      {0, 1.2, 3, 3, 0, 0.5, 1},       {-3, 28, 6, 6, 0, 5, 0},
      {0, 41.2, 8, 5, 0, 10, 0},       {0.0021, 0.0032, 5, 6, 0.0022, 0.0002, 4},
      {1e6, 1.4e6, 5, 5, 1e6, 1e5, 0}, {-1e-9, 1e-9, 5, 5, -1e-9, 5e-10, 10},
  };
  for (size_t i = 0; i < G_N_ELEMENTS(rows); i++) {
    SbTicks t;
    sb_axis_ticks(&t, rows[i].lo, rows[i].hi, rows[i].wanted);
    g_test_message("[%g, %g]: %d from %g by %g, %d decimals", rows[i].lo, rows[i].hi, t.count,
                   t.value[0], t.step, t.decimals);
    g_assert_cmpint(t.count, ==, rows[i].count);
    g_assert_cmpfloat(fabs(t.step - rows[i].step), <=, 1e-9 * rows[i].step);
    g_assert_cmpfloat(fabs(t.value[0] - rows[i].first), <=, 1e-9 * rows[i].step);
    g_assert_cmpint(t.decimals, ==, rows[i].decimals);
  }
}

static void check_ticks(double lo, double hi, int wanted) {
  SbTicks t;
  sb_axis_ticks(&t, lo, hi, wanted);
  sb_axis_repair(&lo, &hi);
  g_assert_true(isfinite(lo) && isfinite(hi) && lo < hi);
  g_assert_cmpint(t.count, >=, 3);
  g_assert_cmpint(t.count, <=, 8);
  double mantissa = t.step / pow(10, floor(log10(t.step) + 1e-9));
  g_assert_true(fabs(mantissa - 1) < 1e-6 || fabs(mantissa - 2) < 1e-6 ||
                fabs(mantissa - 5) < 1e-6);
  for (int i = 0; i < t.count; i++) {
    g_assert_true(isfinite(t.value[i]));
    g_assert_cmpfloat(t.value[i], >=, lo - 1e-6 * (hi - lo));
    g_assert_cmpfloat(t.value[i], <=, hi + 1e-6 * (hi - lo));
    if (i > 0) {
      g_assert_cmpfloat(t.value[i], >, t.value[i - 1]);
    }
  }
}

static void test_ticks_always_three_to_eight(void) {
  static const double hostile[] = {0,        -0.0,         1,      -1,        NAN,
                                   INFINITY, -INFINITY,    1e-300, -1e308,    1e308,
                                   1e-12,    1.0000000001, 5e-324, 123456.789};
  for (size_t i = 0; i < G_N_ELEMENTS(hostile); i++) {
    for (size_t k = 0; k < G_N_ELEMENTS(hostile); k++) {
      for (int wanted = 0; wanted < 10; wanted += 3) {
        check_ticks(hostile[i], hostile[k], wanted);
      }
    }
  }
  GRand *rand = g_rand_new_with_seed(7);
  for (int i = 0; i < 20000; i++) {
    double mid = g_rand_double_range(rand, -1, 1) * pow(10, g_rand_int_range(rand, -9, 10));
    double span = g_rand_double_range(rand, 0, 1) * pow(10, g_rand_int_range(rand, -9, 10));
    check_ticks(mid - span, mid + span, g_rand_int_range(rand, 3, 9));
  }
  g_rand_free(rand);
}

static void test_log(void) {
  SbTicks t;
  sb_axis_log_ticks(&t, 0.3e-9, 20e-6);
  g_assert_cmpint(t.count, ==, 5);
  g_assert_cmpfloat(fabs(t.value[0] / 1e-9 - 1), <, 1e-9);
  g_assert_cmpfloat(fabs(t.value[4] / 1e-5 - 1), <, 1e-9);
  static const double ends[][2] = {{0, 1},     {-1, 1},       {1, 1},       {NAN, 1},   {1, NAN},
                                   {1e-30, 1}, {5, 0.1},      {1e-9, 2e-9}, {0, 0},     {-5, -1},
                                   {1, 1e300}, {INFINITY, 1}, {1e-3, 2e-2}, {1, 999.9}, {1, 31}};
  for (size_t i = 0; i < G_N_ELEMENTS(ends); i++) {
    sb_axis_log_ticks(&t, ends[i][0], ends[i][1]);
    g_test_message("[%g, %g]: %d marks", ends[i][0], ends[i][1], t.count);
    g_assert_cmpint(t.count, >=, 2);
    g_assert_cmpint(t.count, <=, 8);
    for (int k = 0; k < t.count; k++) {
      g_assert_true(isfinite(t.value[k]));
    }
  }
  SbScale s = {1e-9, 1e-5, 100, 20, true};
  g_assert_cmpfloat(fabs(sb_axis_at(&s, 1e-7) - 60), <, 1e-9);
  g_assert_cmpfloat(fabs(sb_axis_value(&s, 60) / 1e-7 - 1), <, 1e-9);
  g_assert_true(isfinite(sb_axis_at(&s, 0)) && sb_axis_at(&s, 0) > 200);
  g_assert_true(isfinite(sb_axis_at(&s, -1)));
}

#define THIN  "\xe2\x80\x89"
#define MINUS "\xe2\x88\x92"
#define SPACE "\xc2\xa0"

static void check_formats(void) {
  static const struct {
    SbQuantity quantity;
    double value, error;
    const char *text;
  } rows[] = {
      {SB_QUANTITY_FORCE, 27.4321, 0, "27.4" SPACE "N"},
      {SB_QUANTITY_FORCE, 8.04, 0, "8.0" SPACE "N"},
      {SB_QUANTITY_FORCE, 1.63, 0, "1.6" SPACE "N"},
      {SB_QUANTITY_FORCE, 9.96, 0, "10.0" SPACE "N"},
      {SB_QUANTITY_FORCE, 9.94, 0, "9.9" SPACE "N"},
      {SB_QUANTITY_FORCE, 0.0496, 0, "0.050" SPACE "N"},
      {SB_QUANTITY_FORCE, -2.24, 0, MINUS "2.2" SPACE "N"},
      {SB_QUANTITY_FORCE, 0, 0, "0" SPACE "N"},
      {SB_QUANTITY_FORCE, -1e-9, 0, "0" SPACE "N"},
      {SB_QUANTITY_FORCE, 99.96, 0, "100" SPACE "N"},
      {SB_QUANTITY_FORCE, 27412, 0, "27" THIN "400" SPACE "N"},
      {SB_QUANTITY_FORCE, 2741, 0, "2740" SPACE "N"},
      {SB_QUANTITY_FORCE, 27.4321, 0.01, "27" SPACE "N"},
      {SB_QUANTITY_FORCE, 27.4321, 3, "30" SPACE "N"},
      {SB_QUANTITY_FORCE, NAN, 0, "\xe2\x80\x93" SPACE "N"},
      {SB_QUANTITY_LENGTH, 2.154e-3, 0, "2.15" SPACE "mm"},
      {SB_QUANTITY_LENGTH, 0.742e-3, 0.004, "0.74" SPACE "mm"},
      {SB_QUANTITY_FILM, 0.8214e-9, 3e-3, "0.82" SPACE "nm"},
      {SB_QUANTITY_FILM, 0.8214e-9, 0, "0.821" SPACE "nm"},
      {SB_QUANTITY_FILM, 1.5e-6, 0, "1.50" SPACE "µm"},
      {SB_QUANTITY_FILM, 999.7e-9, 0, "1.00" SPACE "µm"},
      {SB_QUANTITY_PRESSURE, 1.1849e6, 6e-4, "1.18" SPACE "MPa"},
      {SB_QUANTITY_PRESSURE, 0.55e6, 0, "0.550" SPACE "MPa"},
      {SB_QUANTITY_ENERGY, 0.1384, 0, "138" SPACE "mJ"},
      {SB_QUANTITY_TIME, 7.268, 0, "7.27" SPACE "s"},
      {SB_QUANTITY_SPEED, 1e-3 / 3, 0, "0.333" SPACE "mm/s"},
      {SB_QUANTITY_FRACTION, 0.155, 0, "15.5" SPACE "%"},
      {SB_QUANTITY_NUMBER, 180000, 0, "180" THIN "000"},
      {SB_QUANTITY_NUMBER, -1234567, 0, MINUS "1" THIN "230" THIN "000"},
      {SB_QUANTITY_VOLUME, 3.2e-12, 0, "3.20" SPACE "nl"},
      {SB_QUANTITY_NUMBER, INFINITY, 0, "\xe2\x80\x93"},
  };
  for (size_t i = 0; i < G_N_ELEMENTS(rows); i++) {
    char text[SB_FORMAT_MAX];
    sb_format_text(text, rows[i].quantity, rows[i].value, rows[i].error);
    g_assert_cmpstr(text, ==, rows[i].text);
  }
  char text[SB_FORMAT_MAX];
  g_assert_cmpstr(sb_format_given(text, SB_QUANTITY_PRESSURE, 0.55e6), ==, "0.55" SPACE "MPa");
  g_assert_cmpstr(sb_format_given(text, SB_QUANTITY_FILM, 1e-6), ==, "1" SPACE "µm");
  g_assert_cmpstr(sb_format_given(text, SB_QUANTITY_PRESSURE, 0), ==, "0" SPACE "MPa");
  g_assert_cmpstr(sb_format_given(text, SB_QUANTITY_FORCE, 40), ==, "40" SPACE "N");
  g_assert_cmpstr(sb_format_fixed(text, 0.5, 1), ==, "0.5");
  g_assert_cmpstr(sb_format_fixed(text, 0, 1), ==, "0");
  g_assert_cmpstr(sb_format_fixed(text, -0.04, 1), ==, "0");
  g_assert_cmpstr(sb_format_fixed(text, -0.5, 1), ==, MINUS "0.5");
  g_assert_cmpstr(sb_format_fixed(text, 12345.6, 1), ==, "12" THIN "345.6");
  g_assert_cmpstr(sb_format_film_tick(text, 1e-9), ==, "1" SPACE "nm");
  g_assert_cmpstr(sb_format_film_tick(text, 1e-7), ==, "100" SPACE "nm");
  g_assert_cmpstr(sb_format_film_tick(text, 1e-5), ==, "10" SPACE "µm");
  g_assert_cmpstr(sb_format_film_tick(text, 1e-6), ==, "1" SPACE "µm");
}

static void test_formats(void) {
  check_formats();
  // A decimal comma in the environment changes nothing.
  if (setlocale(LC_ALL, "de_DE.UTF-8")) {
    check_formats();
    setlocale(LC_ALL, "C");
  }
}

// Whatever the value, one unit of its last digit is not below the error.
static void test_digits_supported(void) {
  GRand *rand = g_rand_new_with_seed(11);
  for (int i = 0; i < 20000; i++) {
    double value = g_rand_double_range(rand, 1, 10) * pow(10, g_rand_int_range(rand, -3, 4));
    double error = pow(10, g_rand_double_range(rand, -6, -0.01));
    int decimals = sb_format_decimals(value, 3, error);
    int exponent = (int)floor(log10(value));
    if (decimals > -exponent) {
      g_assert_cmpfloat(pow(10, -decimals), >=, error * value * (1 - 1e-6));
    }
  }
  g_rand_free(rand);
}

int main(int argc, char **argv) {
  g_test_init(&argc, &argv, NULL);
  g_test_add_func("/axis/tick-table", test_tick_table);
  g_test_add_func("/axis/three-to-eight", test_ticks_always_three_to_eight);
  g_test_add_func("/axis/logarithmic", test_log);
  g_test_add_func("/format/table", test_formats);
  g_test_add_func("/format/digits-supported", test_digits_supported);
  return g_test_run();
}
