// Ticks and value formatting against tables, and against hostile ranges.
#include "app/base/figure_text.h"
#include "app/draw/axis.h"
#include "app/session/verdict_text.h"

#include <glib.h>
#include <locale.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

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
      {SB_QUANTITY_FORCE, 8.04, 0, "8.04" SPACE "N"},
      {SB_QUANTITY_FORCE, 9.996, 0, "10.0" SPACE "N"},
      {SB_QUANTITY_FORCE, 9.94, 0, "9.94" SPACE "N"},
      {SB_QUANTITY_FORCE, 0.0496, 0, "0.0496" SPACE "N"},
      {SB_QUANTITY_FORCE, -2.24, 0, MINUS "2.24" SPACE "N"},
      {SB_QUANTITY_FORCE, 0, 0, "0" SPACE "N"},
      {SB_QUANTITY_FORCE, -1e-9, 0, "0" SPACE "N"},
      {SB_QUANTITY_FORCE, 99.96, 0, "100" SPACE "N"},
      {SB_QUANTITY_FORCE, 27412, 0, "27" THIN "400" SPACE "N"},
      {SB_QUANTITY_FORCE, 2741, 0, "2740" SPACE "N"},
      {SB_QUANTITY_FORCE, 25.826, 0.03, "25.8" SPACE "N"},
      {SB_QUANTITY_FORCE, 6.686, 0.03, "6.69" SPACE "N"},
      {SB_QUANTITY_FORCE, 27.4321, 0.01, "27.43" SPACE "N"},
      {SB_QUANTITY_FORCE, 27.4321, 3, "30" SPACE "N"},
      {SB_QUANTITY_FORCE, NAN, 0, "\xe2\x80\x93" SPACE "N"},
      {SB_QUANTITY_LENGTH, 2.154e-3, 0, "2.15" SPACE "mm"},
      {SB_QUANTITY_LENGTH, 0.742e-3, 0.004, "0.7420" SPACE "mm"},
      {SB_QUANTITY_LENGTH, 0.742e-3, 0.005, "0.742" SPACE "mm"},
      {SB_QUANTITY_FILM, 0.8214e-9, 4e-2, "0.82" SPACE "nm"},
      {SB_QUANTITY_FILM, 0.8214e-9, 0, "0.821" SPACE "nm"},
      {SB_QUANTITY_FILM, 1.5e-6, 0, "1.50" SPACE "µm"},
      {SB_QUANTITY_FILM, 999.7e-9, 0, "1.00" SPACE "µm"},
      {SB_QUANTITY_PRESSURE, 1.1849e6, 6e-4, "1.185" SPACE "MPa"},
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
  g_assert_cmpstr(sb_format_given(text, SB_QUANTITY_FORCE, 34.25), ==, "34.25" SPACE "N");
  g_assert_cmpstr(sb_format_given(text, SB_QUANTITY_PRESSURE, 0.5503e6), ==, "0.5503" SPACE "MPa");
  g_assert_cmpstr(sb_format_trimmed(text, SB_QUANTITY_PRESSURE, 0.5503e6, 3), ==,
                  "0.55" SPACE "MPa");
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

// The place at which the rule rounds, from the decimal digits of the error as printf writes them.
static int place_of_error(double error) {
  char text[32];
  g_ascii_formatd(text, sizeof text, "%.8e", error);
  const int exponent = atoi(strchr(text, 'e') + 1);
  return text[0] < '3' ? 1 - exponent : -exponent;
}

// For any value and error: rounded at P, more coarsely only where the digits of the table end,
// never to nothing.
static void test_rounding_rule(void) {
  GRand *rand = g_rand_new_with_seed(11);
  for (int i = 0; i < 20000; i++) {
    double value = g_rand_double_range(rand, 1, 9.98) * pow(10, g_rand_int_range(rand, -3, 4));
    double error = pow(10, g_rand_double_range(rand, -6, 0.5));
    int digits = g_rand_int_range(rand, 3, 6);
    int decimals = sb_format_decimals(value, digits, error);
    int exponent = (int)floor(log10(value)), place = place_of_error(error * value);
    int expected = MAX(MIN(place, digits - 1 - exponent), -exponent);
    // A value that carries into a new digit has one decimal less.
    g_assert_cmpint(decimals, <=, expected);
    g_assert_cmpint(decimals, >=, value > 9.9 * pow(10, exponent) ? expected - 1 : expected);
  }
  g_rand_free(rand);
}

// A figure is the same number in plain text and typeset; its limit has all its digits; zeros at the
// end stand where the error supports them.
static void test_figures(void) {
  static const struct {
    const char *path, *plain, *typeset;
    double value, error;
  } rows[] = {
      {"cycle.force_breakaway_N", "25.8 N", "25.8" SPACE "N", 25.826, 0.03},
      {"cycle.force_return_min_N", "6.69 N", "6.69" SPACE "N", 6.686, 0.03},
      {"cycle.force_return_min_N", "-2.24 N", MINUS "2.24" SPACE "N", -2.241, 0.02},
      {"cycle.force_peak_N", "35 N", "35" SPACE "N", 35, 0},
      {"cycle.force_peak_N", "35.0 N", "35.0" SPACE "N", 35, 0.03},
      {"cycle.force_peak_N", "25.83 N", "25.83" SPACE "N", 25.826, NAN},
      {"cycle.force_peak_N", "27410 N", "27" THIN "410" SPACE "N", 27412, NAN},
      {"cycle.force_peak_N", "30 N", "30" SPACE "N", 27.4, 3},
      {"cycle.force_peak_N", "0 N", "0" SPACE "N", 1e-15, 0.03},
      {"seals.outer.film_min_m", "1.500 µm", "1.500" SPACE "µm", 1.5e-6, 1e-3},
      {"seals.outer.film_min_m", "0.82 nm", "0.82" SPACE "nm", 0.8214e-9, 4e-2},
      {"cycle.leakage_per_cycle_m3", "19 pl", "19" SPACE "pl", 19e-15, NAN},
      {"cycle.energy_closure", "1.1e-15",
       "1.1\xc2\xb7"
       "10\xe2\x81\xbb\xc2\xb9\xe2\x81\xb5",
       1.1e-15, NAN},
      {"cycle.returns", "yes", "yes", 1, NAN},
      {"shelf.temperature_K", "20.0 °C", "20.0" SPACE "°C", 293.15, 2e-3},
  };
  for (size_t i = 0; i < G_N_ELEMENTS(rows); i++) {
    const int figure = sb_figure_find(rows[i].path);
    char text[SB_FORMAT_MAX];
    g_autofree char *plain = sb_figure_format(figure, rows[i].value, rows[i].error);
    g_assert_cmpstr(plain, ==, rows[i].plain);
    g_assert_cmpstr(sb_figure_text(text, figure, rows[i].value, rows[i].error), ==,
                    rows[i].typeset);
  }
  g_autofree char *limit = sb_figure_given(sb_figure_find("cycle.force_peak_N"), 34.9995);
  g_assert_cmpstr(limit, ==, "34.9995 N");
}

// A value that fails its limit by more than its error is never printed as the limit itself.
static void test_beyond_limit(void) {
  const int figure = sb_figure_find("cycle.force_breakaway_N");
  GRand *rand = g_rand_new_with_seed(5);
  for (int i = 0; i < 5000; i++) {
    const double limit = g_rand_double_range(rand, 1, 99);
    const double error = pow(10, g_rand_double_range(rand, -3, -0.5));
    const double value = limit / (1 - error * g_rand_double_range(rand, 1.02, 2));
    g_autofree char *plain = sb_figure_format(figure, value, error);
    g_assert_cmpfloat(g_ascii_strtod(plain, NULL), >, limit);
  }
  g_rand_free(rand);
}

// Two designs with the same methods: their difference is known better than their values.
static void test_compared(void) {
  const int figure = sb_figure_find("cycle.force_breakaway_N");
  const SbFigureCompared same[] = {{25.826, 0.03, 7}, {23.984, 0.03, 7}};
  const SbFigureCompared other[] = {{25.826, 0.03, 7}, {23.984, 0.03, 8}};
  const SbFigureCompared exact[] = {{35, 0, 7}, {30, 0, 7}};
  const SbFigureCompared lacking[] = {{25.826, 0.03, 7}, {NAN, NAN, 7}};
  const SbFigureCompared second[] = {{NAN, NAN, 7}, {1.0789, 3e-4, 8}};
  const SbFigureCompared nil[] = {{0, 0, 7}, {1.0789, 3e-4, 8}};
  static const struct {
    const char *first, *second, *change;
  } texts[] = {{"25.83", "23.98", "-1.84"}, {"25.8", "24.0", "-1.8"}, {"35", "30", "-5"},
               {"25.8", "-", ""},           {"-", "1.079", ""},       {"0", "1.079", "+1.079"}};
  const SbFigureCompared *const designs[] = {same, other, exact, lacking, second, nil};
  for (size_t i = 0; i < G_N_ELEMENTS(designs); i++) {
    char value[SB_FORMAT_MAX], change[SB_FORMAT_MAX];
    const char *unit = isfinite(designs[i][0].value) ? "N" : "";
    g_assert_cmpstr(sb_figure_compared(value, change, figure, designs[i], 2, 0), ==, unit);
    g_assert_cmpstr(value, ==, texts[i].first);
    g_assert_cmpstr(change, ==, "");
    sb_figure_compared(value, change, figure, designs[i], 2, 1);
    g_assert_cmpstr(value, ==, texts[i].second);
    g_assert_cmpstr(change, ==, texts[i].change);
  }
}

// A failure without a value has its reason; it is not "not known".
static void test_verdict_text(void) {
  static const SbAnswer answers[] = {SB_ANSWER_NO, SB_ANSWER_UNKNOWN};
  for (int i = 0; i < 2; i++) {
    const SbVerdict verdict = {answers[i], sb_figure_find("cycle.force_press_N"), NAN, NAN,
                               "the stem never moved"};
    g_autofree SbSummary *summary = g_new0(SbSummary, 1);
    g_autofree char *text = sb_verdict_figure_text(summary, SB_VERDICT_PRESSES, &verdict);
    g_assert_cmpstr(text, ==, i == 0 ? "" : "not known");
  }
}

int main(int argc, char **argv) {
  g_test_init(&argc, &argv, NULL);
  g_test_add_func("/axis/tick-table", test_tick_table);
  g_test_add_func("/axis/three-to-eight", test_ticks_always_three_to_eight);
  g_test_add_func("/axis/logarithmic", test_log);
  g_test_add_func("/format/table", test_formats);
  g_test_add_func("/format/rounding-rule", test_rounding_rule);
  g_test_add_func("/format/figures", test_figures);
  g_test_add_func("/format/beyond-limit", test_beyond_limit);
  g_test_add_func("/format/compared", test_compared);
  g_test_add_func("/format/verdict-text", test_verdict_text);
  return g_test_run();
}
