// Text to SI and back: exact, in every unit of the catalogue, and every wrong text has its message.
#include "app/base/format.h"
#include "app/base/hardness.h"
#include "app/base/unit.h"
#include "app/document/typed.h"

#include <locale.h>
#include <math.h>
#include <string.h>
#include <udunits2.h>

static double parsed(const char *text, const char *si, const char *shown) {
  GError *error = NULL;
  double value = -1;
  g_assert_true(sb_quantity_parse(&value, text, si, shown, &error));
  g_assert_no_error(error);
  return value;
}

static void test_parse(void) {
  // Powers of ten are exact: the same double as the literal.
  static const struct {
    const char *text, *si;
    double value;
  } cases[] = {
      {"1.61mm", "m", 1.61e-3},
      {"1.61 mm", "m", 1.61e-3},
      {"  1.61   mm  ", "m", 1.61e-3},
      {"+1.61e0 mm", "m", 1.61e-3},
      {"1610 µm", "m", 1.61e-3},
      {"1610 \xce\xbcm", "m", 1.61e-3},
      {"1610um", "m", 1.61e-3},
      {"0.00161 m", "m", 1.61e-3},
      {"0.211mPa.s", "Pa.s", 0.211e-3},
      {"0.211 mPa s", "Pa.s", 0.211e-3},
      {"850.2N/m", "N/m", 850.2},
      {"20 mm/min", "m/s", 20.0 / 60000},
      {"10mm/s", "m/s", 10e-3},
      {"2.8 1/GPa", "1/Pa", 2.8e-9},
      {"2.8/GPa", "1/Pa", 2.8e-9},
      {"2.8 GPa-1", "1/Pa", 2.8e-9},
      {"1 µm", "m", 1e-6},
      {"1226 kg/m3", "kg/m3", 1226},
      {"1226 kg/m^3", "kg/m3", 1226},
      {"1.226 g/cm3", "kg/m3", 1226},
      {"3.73 g", "kg", 3.73e-3},
      {"100 N/mm", "N/m", 1e5},
      {"5.5 bar", "Pa", 5.5e5},
      {"1.35e-19 J", "J", 1.35e-19},
      {"0.49", "1", 0.49},
      {".5", "1", 0.5},
      {"12 %", "1", 0.12},
      {"2 barrer", "mol/(m.s.Pa)", 6.7e-16},
      {"6.7e-16 mol/(m.s.Pa)", "mol/(m.s.Pa)", 6.7e-16},
      {"30 deg", "rad", 30 * G_PI / 180},
      {"-30°", "rad", -30 * G_PI / 180},
      {"5 K", "K", 5},
      {"-3", "1", -3},
  };
  for (size_t i = 0; i < G_N_ELEMENTS(cases); i++) {
    double value = parsed(cases[i].text, cases[i].si, cases[i].si);
    if (value != cases[i].value) {
      g_error("\"%s\" gives %.17g, not %.17g", cases[i].text, value, cases[i].value);
    }
  }
}

static void test_refused(void) {
  static const struct {
    const char *text, *si, *shown, *says;
  } cases[] = {
      {"1.61", "m", "mm", "has no unit, write for example \"1.61 mm\""},
      {"1.61 s", "m", "mm", "unit of another kind, expected mm"},
      {"1.61 mm2", "m", "mm", "unit of another kind"},
      {"1.61 furlongz", "m", "mm", "is not a unit, expected mm"},
      {"1,61 mm", "m", "mm", "decimal comma"},
      {"", "m", "mm", "no value"},
      {"mm", "m", "mm", "is not a number with a unit such as mm"},
      {"nan mm", "m", "mm", "not a finite number"},
      {"-inf mm", "m", "mm", "not a finite number"},
      {"1e400 mm", "m", "mm", "not a finite number"},
      {"0x10 mm", "m", "mm", "is not a unit"},
      {"1 5 mm", "m", "mm", "is not a unit"},
      {"1 mm 10", "m", "mm", "is not a unit"},
      {"1 mm*10", "m", "mm", "is not a unit"},
      {"1 mm @ 5", "m", "mm", "is not a unit"},
      {"1 lg(re 1 mm)", "m", "mm", "is not a unit"},
      {"1.61 mm # nominal", "m", "mm", "line of its own"},
      {"0.3 mm", "1", "", "this value has none"},
      {"20 degC", "K", "K", "a difference"},
      {"1 1/m", "m", "mm", "another kind"},
      {"1 \x1b[31mmm", "m", "mm", "is not a unit"},
  };
  for (size_t i = 0; i < G_N_ELEMENTS(cases); i++) {
    GError *error = NULL;
    double value = 42;
    g_assert_false(sb_quantity_parse(&value, cases[i].text, cases[i].si, cases[i].shown, &error));
    g_assert_error(error, SB_APP_ERROR, SB_APP_ERROR_INPUT);
    if (strstr(error->message, cases[i].says) == NULL) {
      g_error("\"%s\": \"%s\" does not say \"%s\"", cases[i].text, error->message, cases[i].says);
    }
    g_assert_null(strchr(error->message, '\x1b'));
    g_assert_cmpfloat(value, ==, 42);
    g_error_free(error);
  }
}

static void test_format(void) {
  static const struct {
    double value;
    const char *si, *shown, *text;
  } cases[] = {
      {1.61e-3, "m", "mm", "1.61 mm"},
      {20.0 / 60000, "m/s", "mm/min", "20 mm/min"},
      {0.211e-3, "Pa.s", "mPa.s", "0.211 mPa.s"},
      {2.8e-9, "1/Pa", "1/GPa", "2.8 1/GPa"},
      {1e-6, "m", "µm", "1 µm"},
      {0.49, "1", "", "0.49"},
      {2e7, "1", "", "20000000"},
      {1.35e-19, "J", "J", "1.35e-19 J"},
      {0, "m", "mm", "0 mm"},
      {-0.5e-3, "m", "mm", "-0.5 mm"},
      {1.0 / 3, "1", "", "0.3333333333333333"},
  };
  for (size_t i = 0; i < G_N_ELEMENTS(cases); i++) {
    char *text = sb_quantity_format(cases[i].value, cases[i].si, cases[i].shown);
    g_assert_cmpstr(text, ==, cases[i].text);
    g_free(text);
  }
}

// Any value of any parameter comes back as the same double.
// Stepped by hand, a value stays one of few digits; so does one given in a unit of another system.
static void test_steps(void) {
  double value = 1.60e-3;
  for (int i = 1; i <= 200; i++) {
    value = sb_quantity_step(value, "m", "mm", -2, 1);
    g_autofree char *text = sb_quantity_format(value, "m", "mm");
    g_autofree char *wanted = g_strdup_printf("%g mm", (160 + i) / 100.0);
    g_assert_cmpstr(text, ==, wanted);
  }
  g_assert_cmpfloat(sb_quantity_step(0.55e6, "Pa", "MPa", -3, -1), ==, 0.549e6);
  g_assert_cmpfloat(sb_quantity_step(0, "m", "mm", -1, 0), ==, 0);
  for (int i = 1; i < 100; i++) {
    g_autofree char *inches = g_strdup_printf("%g inch", i / 10.0);
    g_assert_true(sb_quantity_parse(&value, inches, "m", "mm", NULL));
    g_autofree char *text = sb_quantity_format(value, "m", "mm");
    g_autofree char *wanted = g_strdup_printf("%g mm", i * 254 / 100.0);
    g_assert_cmpstr(text, ==, wanted);
  }
}

static void test_round_trip(void) {
  GRand *random = g_rand_new_with_seed(7);
  for (int id = 0; id < SB_PARAM_COUNT; id++) {
    const SbParam *param = sb_param((SbParamId)id);
    // The unit that people read is one that they may write.
    g_autofree char *unit_text = g_strdup_printf("1 %s", param->unit);
    double ignored;
    g_assert_true(param->kind != SB_PARAM_REAL ||
                  sb_quantity_parse(&ignored, unit_text, param->si, param->unit, NULL));
    for (int i = 0; param->kind == SB_PARAM_REAL && i < 300; i++) {
      double share = i == 0 ? 0 : i == 1 ? 1 : g_rand_double(random);
      double value = param->min + share * (param->max - param->min);
      value = CLAMP(value, param->min, param->max);
      char *text = sb_param_format((SbParamId)id, value);
      double back = 0;
      GError *error = NULL;
      g_assert_true(sb_param_parse(&back, (SbParamId)id, text, &error));
      g_assert_no_error(error);
      g_assert_cmpfloat(back, ==, value);
      // The panel's way: number and unit apart.
      double number = sb_quantity_to_shown(value, param->si, param->unit);
      double again = sb_quantity_from_shown(number, param->si, param->unit);
      // A temperature passes by that of ice.
      const double by = strcmp(param->unit, "°C") == 0 ? 273.15 : 0;
      g_assert_cmpfloat(fabs(again - value), <=, 1e-15 * fmax(fabs(value), by));
      g_free(text);
    }
  }
  g_rand_free(random);
}

// Defaults are printed with the digits that the catalogue has: -20 °C, not the double next to it.
static void test_defaults(void) {
  for (int id = 0; id < SB_PARAM_COUNT; id++) {
    g_autofree char *text = sb_param_format((SbParamId)id, sb_param((SbParamId)id)->fallback);
    size_t digits = 0;
    for (const char *c = text; *c != '\0' && *c != ' ' && *c != 'e'; c++) {
      digits += g_ascii_isdigit(*c);
    }
    if (sb_param((SbParamId)id)->kind == SB_PARAM_REAL && digits > 10) {
      g_error("%s: %s", sb_param((SbParamId)id)->key, text);
    }
  }
  static const struct {
    double kelvin;
    const char *text;
  } rows[] = {{253.15, "-20 °C"}, {100, "-173.15 °C"}, {173.15, "-100 °C"}, {313.15, "40 °C"}};
  for (size_t i = 0; i < G_N_ELEMENTS(rows); i++) {
    double back;
    g_autofree char *text = sb_quantity_format(rows[i].kelvin, "K", "°C");
    g_assert_cmpstr(text, ==, rows[i].text);
    g_assert_true(sb_quantity_parse(&back, text, "K", "°C", NULL));
    g_assert_cmpfloat(back, ==, rows[i].kelvin);
    g_assert_cmpfloat(sb_quantity_to_shown(back, "K", "°C"), ==, g_ascii_strtod(text, NULL));
  }
}

// Points of the scale of temperature take °C, degC and K; differences K alone.
static void test_temperatures(void) {
  static const char *const same[] = {"20 °C", "20degC", "293.15 K", "+20.0 celsius", "68 degF"};
  double value = 0;
  for (size_t i = 0; i < G_N_ELEMENTS(same); i++) {
    g_assert_true(sb_param_parse(&value, SB_P_STORAGE_TEMPERATURE, same[i], NULL));
    g_assert_cmpfloat_with_epsilon(value, 293.15, 1e-12 * 293.15);
  }
  static const char *const none[] = {"20", "20 C", "20 °C/m", "20 %", "-300 °C"};
  for (size_t i = 0; i < G_N_ELEMENTS(none); i++) {
    g_assert_false(sb_param_parse(&value, SB_P_STORAGE_TEMPERATURE, none[i], NULL));
  }
  g_assert_true(sb_param_parse(&value, SB_P_RUBBER_WLF_C2, "20 K", NULL));
  g_assert_cmpfloat(value, ==, 20);
  GError *error = NULL;
  g_assert_false(sb_param_parse(&value, SB_P_RUBBER_WLF_C2, "20 °C", &error));
  g_assert_nonnull(strstr(error->message, "difference"));
  g_clear_error(&error);
  for (double t = 150; t <= 450; t += 0.37) {
    char *text = sb_param_format(SB_P_STORAGE_TEMPERATURE, t);
    g_assert_true(sb_param_parse(&value, SB_P_STORAGE_TEMPERATURE, text, NULL));
    g_assert_cmpfloat(value, ==, t);
    g_free(text);
  }
  g_assert_cmpfloat(sb_quantity_to_shown(293.15, "K", "°C"), ==, 20);
  g_assert_cmpfloat(sb_quantity_from_shown(20, "K", "°C"), ==, 293.15);
}

static void test_params(void) {
  double value = 0;
  g_assert_true(sb_param_parse(&value, SB_P_MODELS_FIT, " ring ", NULL));
  char *text = sb_param_format(SB_P_MODELS_FIT, value);
  g_assert_cmpstr(text, ==, "ring");
  g_free(text);
  g_assert_true(sb_param_parse(&value, SB_P_OUTPUT_VIEWS, "section;hysteresis;", NULL));
  text = sb_param_format(SB_P_OUTPUT_VIEWS, value);
  g_assert_cmpstr(text, ==, "hysteresis;section");
  g_free(text);
  text = sb_param_range(SB_P_SEAL_SECTION_DIAMETER);
  g_assert_cmpstr(text, ==, "0.2 to 20 mm");
  g_free(text);
  // 3.2e9 s in days: rounded into the range.
  text = sb_param_range(SB_P_STORAGE_TIME);
  g_assert_cmpstr(text, ==, "0 to 37000 day");
  g_free(text);
  text = sb_param_range(SB_P_OUTPUT_FRAMES);
  g_assert_cmpstr(text, ==, "2 to 20000000");
  g_free(text);
  static const struct {
    SbParamId id;
    const char *text;
  } bad[] = {{SB_P_MODELS_FIT, "torus"},          {SB_P_OUTPUT_VIEWS, "section;nonsense"},
             {SB_P_OUTPUT_FRAMES, "2.5"},         {SB_P_OUTPUT_FRAMES, "1"},
             {SB_P_SEAL_SECTION_DIAMETER, "9 m"}, {SB_P_OUTPUT_FRAMES, "400 mm"}};
  for (size_t i = 0; i < G_N_ELEMENTS(bad); i++) {
    g_assert_false(sb_param_parse(&value, bad[i].id, bad[i].text, NULL));
  }
}

static void test_locale(void) {
  if (setlocale(LC_ALL, "de_DE.UTF-8") == NULL) {
    g_test_skip("no German locale");
    return;
  }
  g_assert_cmpint(localeconv()->decimal_point[0], ==, ',');
  test_parse();
  test_refused();
  test_format();
  setlocale(LC_ALL, "C");
}

static void test_numbers(void) {
  char text[SB_NUMBER_SIZE];
  GRand *random = g_rand_new_with_seed(3);
  for (int i = 0; i < 20000; i++) {
    guint64 bits = (guint64)g_rand_int(random) << 32 | g_rand_int(random);
    double value;
    memcpy(&value, &bits, sizeof value);
    if (isfinite(value)) {
      sb_number_format(text, value);
      g_assert_cmpfloat(g_ascii_strtod(text, NULL), ==, value);
    }
  }
  g_rand_free(random);
  double odd[] = {3, -1, 2}, even[] = {4, 1, 3, 2};
  g_assert_cmpfloat(sb_number_median(odd, 3), ==, 2);
  g_assert_cmpfloat(sb_number_median(even, 4), ==, 2.5);
  g_assert_true(isnan(sb_number_median(even, 0)));
  g_assert_cmpstr(sb_number_round(text, 27.4567, 3), ==, "27.5");
  g_assert_cmpstr(sb_number_round(text, 1.7204e-9, 3), ==, "1.72e-09");
  g_assert_cmpstr(sb_number_round(text, -1234567, 2), ==, "-1200000");
  g_assert_cmpstr(sb_number_format(text, 123456.789), ==, "123456.789");
  g_assert_cmpstr(sb_number_format(text, 0.00012), ==, "0.00012");
}

// What is typed into a field: the text that the parser is given.
static void test_typed(void) {
  static const struct {
    SbParamId id;
    const char *typed, *meant;
  } cases[] = {
      {SB_P_SEAL_SECTION_DIAMETER, "1.65", "1.65 mm"},
      {SB_P_SEAL_SECTION_DIAMETER, " 1,65 ", "1.65 mm"},
      {SB_P_SEAL_SECTION_DIAMETER, "1,65 mm", "1.65 mm"},
      {SB_P_SEAL_SECTION_DIAMETER, "1650 um", "1650 um"},
      {SB_P_SEAL_SECTION_DIAMETER, "+5 %", "1.6905 mm"},
      {SB_P_SEAL_SECTION_DIAMETER, "-2,5%", "1.56975 mm"},
      {SB_P_SEAL_SECTION_DIAMETER, "1.6 + 0.1/2", "1.65 mm"},
      {SB_P_SEAL_SECTION_DIAMETER, "99m", "99 m"},
      {SB_P_SEAL_SECTION_DIAMETER, "2*(0.8+0,02) mm", "1.64 mm"},
      {SB_P_SEAL_SECTION_DIAMETER, "0.1+0.2 cm", "0.3 cm"},
      {SB_P_HOUSING_MODULUS, "60 ShA", "60 ShA"},
      {SB_P_CANISTER_TEMPERATURE, "25", "25 °C"},
      {SB_P_CANISTER_TEMPERATURE, "25 degC", "25 degC"},
      {SB_P_CANISTER_TEMPERATURE, "+5 %", "+5 %"}, // of which zero? The parser refuses it
      {SB_P_FLUID_PRESSURE_VISCOSITY, "2.8 1/GPa", "2.8 1/GPa"},
      {SB_P_FRICTION_STATIC_RATIO, "1.1", "1.1"},
      {SB_P_FRICTION_STATIC_RATIO, "11/10", "1.1"},
      {SB_P_OUTPUT_FRAMES, "2*150", "300"},
      {SB_P_MODELS_FIT, "ring", "ring"},
      // These stay, for the parser to refuse.
      {SB_P_SEAL_SECTION_DIAMETER, "1,2,3 mm", "1,2,3 mm"},
      {SB_P_SEAL_SECTION_DIAMETER, "1,234.5", "1,234.5"},
      {SB_P_SEAL_SECTION_DIAMETER, "rubbish", "rubbish"},
      {SB_P_SEAL_SECTION_DIAMETER, "1/0", "1/0"},
      {SB_P_SEAL_SECTION_DIAMETER, "(1.6", "(1.6"},
      {SB_P_SEAL_SECTION_DIAMETER, "1.6 ; 2", "1.6 ; 2"},
      {SB_P_SEAL_SECTION_DIAMETER, "0x10", "0 x10"},
      {SB_P_SEAL_SECTION_DIAMETER, "nan", "nan"},
      {SB_P_SEAL_SECTION_DIAMETER, "", ""},
  };
  SbParams params;
  sb_params_init(&params);
  for (gsize i = 0; i < G_N_ELEMENTS(cases); i++) {
    g_autofree char *meant =
        sb_typed_text(cases[i].id, sb_params_get(&params, cases[i].id), cases[i].typed);
    g_assert_cmpstr(meant, ==, cases[i].meant);
  }
  // By hand: 0.0981 x 513.4016 / (0.137505 x 101.6) = 50.3647 / 13.9705 MPa.
  for (int i = 0; i < 2; i++) {
    g_autofree char *meant =
        sb_typed_text(SB_P_SEAL_MODULUS, 1e6, i == 0 ? "60 Shore A" : "60 shA");
    double modulus = 0;
    g_assert_true(sb_param_parse(&modulus, SB_P_SEAL_MODULUS, meant, NULL));
    g_assert_cmpfloat(fabs(modulus - 3.60507e6), <, 10);
  }
  // Files and --set accept the same units of hardness.
  static const struct {
    const char *text;
    double modulus; // NAN: refused
  } hardness[] = {
      {"60 Shore A", 3.60507e6},
      {"60ShA", 3.60507e6},
      // ISO 48: the middle of the curve, and one width (0.7 decades) above and below it.
      {"50 IRHD", 2.31206e6},
      {"84.134474606854 irhd", 2.31206e6 * 5.011872},
      {"85.1 IRHD", NAN},
      {"19 Shore A", NAN},
      {"60 Shore D", NAN},
  };
  for (gsize i = 0; i < G_N_ELEMENTS(hardness); i++) {
    double modulus = NAN;
    g_autoptr(GError) error = NULL;
    const bool read = sb_param_parse(&modulus, SB_P_SEAL_OUTER_MODULUS, hardness[i].text, &error);
    g_assert_true(read == !isnan(hardness[i].modulus) && read == (error == NULL));
    g_assert_true(!read || fabs(modulus / hardness[i].modulus - 1) < 3e-6);
    // Only a seal's rubber has a hardness.
    g_assert_false(sb_param_parse(&modulus, SB_P_HOUSING_MODULUS, hardness[i].text, NULL));
  }
  g_autoptr(GPtrArray) notes = sb_issues_new();
  sb_hardness_note(notes, NULL, 0, "seal.modulus", SB_P_SEAL_MODULUS, "3.6 MPa");
  sb_hardness_note(notes, NULL, 0, "housing.modulus", SB_P_HOUSING_MODULUS, "60 Shore A");
  g_assert_cmpuint(notes->len, ==, 0);
  sb_hardness_note(notes, NULL, 0, "seal.modulus", SB_P_SEAL_MODULUS, "60 Shore A");
  const char *note = ((const SbIssue *)notes->pdata[0])->text;
  g_assert_nonnull(strstr(note, "60 Shore A is a modulus of 3.61 MPa"));
  g_assert_nonnull(strstr(note, "changes it by 12 %"));
  // Brackets without end, and a long line, end too.
  g_autofree char *deep = g_strnfill(150, '('), *same = sb_typed_text(SB_P_SEAL_MODULUS, 1, deep);
  g_assert_cmpstr(same, ==, deep);
  // Any value comes back from its own shortest text, also bare.
  GRand *random = g_rand_new_with_seed(7);
  for (int i = 0; i < 2000; i++) {
    const SbParam *param = sb_param(SB_P_SEAL_SECTION_DIAMETER);
    const double value = 1e-6 * g_rand_int_range(random, 200, 20000);
    g_autofree char *text = sb_quantity_format(value, param->si, param->unit);
    g_autofree char *bare = g_strndup(text, strcspn(text, " "));
    g_autofree char *meant = sb_typed_text(SB_P_SEAL_SECTION_DIAMETER, 1e-3, bare);
    double back = 0;
    g_assert_true(sb_param_parse(&back, SB_P_SEAL_SECTION_DIAMETER, meant, NULL));
    double from = 0;
    g_assert_true(sb_param_parse(&from, SB_P_SEAL_SECTION_DIAMETER, text, NULL));
    g_assert_cmpfloat(back, ==, from);
  }
  g_rand_free(random);
}

// ---- Scales that need no database ----

static const struct {
  const char *unit, *si;
  double scale, zero;
} displayed[] = {
#define SB_SCALE(unit, si, scale, zero) {unit, si, scale, zero},
#include "app/base/unit_scales.def"
#undef SB_SCALE
};

// They are those of udunits, within the rounding of its versions.
static void test_scales(void) {
  ut_set_error_message_handler(ut_ignore);
  ut_system *units = ut_read_xml(NULL);
  g_assert_nonnull(units);
  for (size_t i = 0; i < G_N_ELEMENTS(displayed); i++) {
    // The catalogue's own unit (unit.c): 1e-10 cm3 (STP) cm / (cm2 s cmHg).
    const bool own = strcmp(displayed[i].unit, "barrer") == 0;
    ut_unit *from = ut_parse(units, own ? "3.35e-16 mol/(m.s.Pa)" : displayed[i].unit, UT_UTF8);
    ut_unit *to = ut_parse(units, displayed[i].si, UT_UTF8);
    cv_converter *converter = ut_get_converter(from, to);
    const double zero = cv_convert_double(converter, 0);
    const double scale = cv_convert_double(converter, 1) - zero;
    g_assert_cmpfloat(fabs(displayed[i].zero - zero), <=, 1e-13 * zero);
    // The difference of two temperatures loses digits.
    g_assert_cmpfloat(fabs(displayed[i].scale - scale), <=, (zero != 0 ? 1e-12 : 1e-15) * scale);
    cv_free(converter);
    ut_free(from);
    ut_free(to);
  }
  ut_free_system(units);
}

// All parameters are displayed without the database.
static void test_displayed(void) {
  for (int i = 0; i < SB_PARAM_COUNT; i++) {
    const SbParam *param = sb_param((SbParamId)i);
    bool found = *param->unit == '\0' || strcmp(param->unit, param->si) == 0 ||
                 strcmp(param->unit, "deg") == 0;
    for (size_t k = 0; k < G_N_ELEMENTS(displayed) && !found; k++) {
      found =
          strcmp(displayed[k].unit, param->unit) == 0 && strcmp(displayed[k].si, param->si) == 0;
    }
    if (!found) {
      g_test_message("app/base/unit_scales.def has no scale of %s in %s", param->unit, param->si);
      g_test_fail();
    }
  }
}

// A sentence begins with a capital, unless it begins with a key.
static void test_sentences(void) {
  static const char *const texts[][2] = {
      {"the stem is stuck", "The stem is stuck"},
      {"cycle.force_peak_N is above its limit", "cycle.force_peak_N is above its limit"},
      {"stuck.", "Stuck."},
      {"", ""}};
  for (size_t i = 0; i < G_N_ELEMENTS(texts); i++) {
    g_autofree char *text = sb_sentence_case(texts[i][0]);
    g_assert_cmpstr(text, ==, texts[i][1]);
  }
}

int main(int argc, char **argv) {
  g_test_init(&argc, &argv, NULL);
  g_test_add_func("/units/parse", test_parse);
  g_test_add_func("/units/refused", test_refused);
  g_test_add_func("/units/format", test_format);
  g_test_add_func("/units/steps", test_steps);
  g_test_add_func("/units/round-trip", test_round_trip);
  g_test_add_func("/units/defaults", test_defaults);
  g_test_add_func("/units/temperatures", test_temperatures);
  g_test_add_func("/units/params", test_params);
  g_test_add_func("/units/numbers", test_numbers);
  // Last: it changes the process' locale.
  g_test_add_func("/units/locale", test_locale);
  g_test_add_func("/units/typed", test_typed);
  g_test_add_func("/units/scales", test_scales);
  g_test_add_func("/units/displayed", test_displayed);
  g_test_add_func("/units/sentences", test_sentences);
  return g_test_run();
}
