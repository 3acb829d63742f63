// Values with units by udunits-2.
//
// udunits keeps one parser and one unit system per process and reads numbers by the locale, so one
// lock and the C locale surround every call to it. Scales of unit pairs are remembered.
#include "app/base/unit.h"

#include "engine/valve/figures/figures.h"

#include <locale.h>
#include <math.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <udunits2.h>

typedef enum { SCALE_OK, SCALE_UNKNOWN, SCALE_WRONG, SCALE_NO_DATABASE } ScaleStatus;

typedef struct {
  ScaleStatus status;
  double scale; // SI value of one unit
  double zero;  // SI value of none: other than 0 for points of a scale of temperature only
} UnitScale;

static pthread_mutex_t units_lock = PTHREAD_MUTEX_INITIALIZER;

// Scales of pairs "unit|SI unit" that need no database.
static const struct {
  const char *pair;
  UnitScale scale;
} displayed[] = {
#define SB_SCALE(unit, si, scale, zero) {unit "|" si, {SCALE_OK, scale, zero}},
#include "app/base/unit_scales.def"
#undef SB_SCALE
};

// A unit may hold digits as exponents only ("m3", "s-2") or as the leading "1/" of a reciprocal;
// "mm 10" or "5 mm" inside a unit would be silent factors.
static bool unit_is_plain(const char *unit) {
  for (const char *c = unit; *c != '\0'; c++) {
    // Parentheses as in "mol/(m.s.Pa)", not those of logarithms.
    if (*c == '@' || (*c == '(' && (c == unit || c[-1] != '/')) || g_ascii_iscntrl(*c)) {
      return false;
    }
    if (g_ascii_isdigit(*c)) {
      bool reciprocal = c == unit && c[0] == '1' && c[1] == '/';
      char before = c > unit ? c[-1] : ' ';
      bool exponent = before != ' ' && before != '.' && before != '*' && before != '/';
      if (!reciprocal && !exponent) {
        return false;
      }
    }
  }
  return true;
}

// Asks udunits. The lock is held and the thread is in the C locale.
static UnitScale ask(const char *unit, const char *si) {
  static ut_system *units = NULL;
  if (units == NULL) {
    ut_set_error_message_handler(ut_ignore);
    units = ut_read_xml(NULL);
    if (units == NULL) {
      return (UnitScale){SCALE_NO_DATABASE, 0, 0};
    }
    // Of permeability: 3.35e-16 mol/(m.s.Pa).
    ut_unit *si_permeability = ut_parse(units, "mol/(m.s.Pa)", UT_UTF8);
    ut_unit *barrer = ut_scale(3.35e-16, si_permeability);
    (void)ut_map_name_to_unit("barrer", UT_UTF8, barrer);
    ut_free(barrer);
    ut_free(si_permeability);
  }
  UnitScale result = {SCALE_UNKNOWN, 0, 0};
  ut_unit *from = ut_parse(units, unit, UT_UTF8);
  ut_unit *to = ut_parse(units, si, UT_UTF8);
  if (from != NULL && to != NULL) {
    cv_converter *converter = NULL;
    if (ut_are_convertible(from, to)) {
      converter = ut_get_converter(from, to);
    }
    result.status = SCALE_WRONG;
    // Only units that are a plain multiple, and scales of temperature: no logarithms, no reciprocal
    // conversion.
    if (converter != NULL) {
      double zero = cv_convert_double(converter, 0);
      double one = cv_convert_double(converter, 1) - zero;
      double two = cv_convert_double(converter, 2) - zero;
      bool linear = isfinite(one) && one > 0 && fabs(two - 2 * one) <= 1e-12 * (two + fabs(zero));
      if (linear && (zero == 0 || strcmp(si, "K") == 0)) {
        result = (UnitScale){SCALE_OK, zero != 0 && fabs(one - 1) < 1e-12 ? 1 : one, zero};
      }
    }
    cv_free(converter);
  }
  ut_free(from);
  ut_free(to);
  return result;
}

static UnitScale find_scale(const char *unit, const char *si) {
  enum { REMEMBERED_MAX = 512, UNIT_LENGTH_MAX = 40 };
  if (*unit == '\0') {
    unit = "1";
  } else if (strcmp(unit, "deg") == 0) {
    unit = "degree"; // which udunits knows by that name and as a sign only
  }
  if (strlen(unit) > UNIT_LENGTH_MAX || !unit_is_plain(strcmp(unit, "1") == 0 ? "" : unit)) {
    return (UnitScale){SCALE_UNKNOWN, 0, 0};
  }
  if (strcmp(unit, si) == 0) {
    return (UnitScale){SCALE_OK, 1, 0};
  }
  static GHashTable *remembered = NULL;
  g_autofree char *pair = g_strdup_printf("%s|%s", unit, si);
  pthread_mutex_lock(&units_lock);
  if (remembered == NULL) {
    remembered = g_hash_table_new_full(g_str_hash, g_str_equal, g_free, g_free);
    for (size_t i = 0; i < G_N_ELEMENTS(displayed); i++) {
      g_hash_table_insert(remembered, g_strdup(displayed[i].pair),
                          g_memdup2(&displayed[i].scale, sizeof displayed[i].scale));
    }
  }
  UnitScale *known = g_hash_table_lookup(remembered, pair);
  UnitScale scale;
  if (known != NULL) {
    scale = *known;
  } else {
    static locale_t plain = (locale_t)0; // kept: it is needed again
    if (plain == (locale_t)0) {
      plain = newlocale(LC_ALL_MASK, "C", (locale_t)0);
    }
    locale_t before = plain != (locale_t)0 ? uselocale(plain) : (locale_t)0;
    scale = ask(unit, si);
    if (plain != (locale_t)0) {
      uselocale(before);
    }
    if (scale.status != SCALE_NO_DATABASE && g_hash_table_size(remembered) < REMEMBERED_MAX) {
      g_hash_table_insert(remembered, g_strdup(pair), g_memdup2(&scale, sizeof scale));
    }
  }
  pthread_mutex_unlock(&units_lock);
  return scale;
}

// True and the exponent k if a unit is 10^k of the SI unit.
static bool is_power_of_ten(UnitScale scale, int *power) {
  int k = (int)lround(log10(scale.scale));
  *power = k;
  return scale.zero == 0 && fabs(scale.scale - pow(10, k)) <= 1e-13 * scale.scale;
}

bool sb_quantity_is_point(const char *shown) {
  return strcmp(shown, "°C") == 0;
}

// The zero of a scale as the decimal that it is, if it is one: -20 °C are 253.15 K, not the double
// beside it.
static long double zero_of(UnitScale scale) {
  const long double decimal = roundl(scale.zero * 1e10L) / 1e10L;
  return fabsl(decimal - scale.zero) < 1e-13L ? decimal : scale.zero;
}

// number x scale, the scale taken as a division where its inverse is whole: 20 mm/min is 20/60000.
static double apply_scale(double number, UnitScale scale) {
  double inverse = 1 / scale.scale;
  if (inverse > 1 && inverse < 1e15 && fabs(inverse - round(inverse)) <= 1e-12 * inverse) {
    return (double)(number / round(inverse) + zero_of(scale));
  }
  return (double)(number * scale.scale + zero_of(scale));
}

// The number at text[0..length) times 10^power, rounded once.
static double read_decimal(const char *text, size_t exponent_at, size_t length, int power) {
  long exponent = 0;
  if (exponent_at < length) {
    exponent = strtol(text + exponent_at + 1, NULL, 10);
  }
  exponent = CLAMP(exponent, -100000, 100000) + power;
  g_autofree char *moved = g_strdup_printf("%.*se%ld", (int)exponent_at, text, exponent);
  return g_ascii_strtod(moved, NULL);
}

// Fails for a text that does not begin with a number; `copy` is stripped.
static bool fail_number(GError **error, const char *copy, bool plain, const char *shown) {
  const char *word = copy + (*copy == '-' || *copy == '+');
  if (*copy == '\0') {
    return sb_app_error_input(error, "no value");
  }
  if (g_ascii_strncasecmp(word, "nan", 3) == 0 || g_ascii_strncasecmp(word, "inf", 3) == 0) {
    return sb_app_error_input(error, "\"%s\" is not a finite number", copy);
  }
  return sb_app_error_input(error, "\"%s\" is not a number%s%s", copy,
                            plain ? "" : " with a unit such as ", plain ? "" : shown);
}

// Finds the scale of a unit in `si`; false with a sentence.
static bool take_scale(UnitScale *scale, const char *unit, const char *si, const char *shown,
                       GError **error) {
  // "2.8/GPa" for "2.8 1/GPa".
  g_autofree char *reciprocal = *unit == '/' ? g_strconcat("1", unit, NULL) : NULL;
  *scale = find_scale(reciprocal != NULL ? reciprocal : unit, si);
  if (scale->status == SCALE_NO_DATABASE) {
    return sb_app_error_input(error, "the units database of udunits-2 is missing");
  }
  if (scale->status == SCALE_OK && scale->zero != 0 && !sb_quantity_is_point(shown)) {
    return sb_app_error_input(
        error, "\"%s\" is a point of a scale, this is a difference, expected K", unit);
  }
  const char *what = scale->status == SCALE_UNKNOWN ? "is not a unit" : "is a unit of another kind";
  if (scale->status != SCALE_OK && strcmp(si, "1") == 0) {
    return sb_app_error_input(error, "\"%s\" %s: this value has none", unit, what);
  }
  return scale->status == SCALE_OK ||
         sb_app_error_input(error, "\"%s\" %s, expected %s or another unit of that kind", unit,
                            what, shown);
}

bool sb_quantity_parse(double *out, const char *text, const char *si, const char *shown,
                       GError **error) {
  const bool plain = strcmp(si, "1") == 0;
  if (strlen(text) > SB_NUMBER_LENGTH_MAX) {
    return sb_app_error_input(error, "\"%.20s...\" is too long for a value", text);
  }
  g_autofree char *copy = g_strstrip(g_strdup(text));
  size_t exponent_at = 0;
  const size_t length = sb_number_scan(copy, &exponent_at);
  if (length == 0) {
    return fail_number(error, copy, plain, shown);
  }
  const char *unit = copy + length;
  while (g_ascii_isspace(*unit)) {
    unit++;
  }
  if (*unit == ',' && g_ascii_isdigit(unit[1])) {
    return sb_app_error_input(error, "\"%s\" has a decimal comma, write a point", copy);
  }
  if (strpbrk(unit, "#") != NULL) {
    return sb_app_error_input(error, "\"%s\": a comment must be on a line of its own", copy);
  }
  if (*unit == '\0' && !plain) {
    return sb_app_error_input(error, "\"%.*s\" has no unit, write for example \"%.*s %s\"",
                              (int)length, copy, (int)length, copy, shown);
  }
  UnitScale scale;
  if (!take_scale(&scale, unit, si, shown, error)) {
    return false;
  }
  int power = 0;
  double value = is_power_of_ten(scale, &power)
                     ? read_decimal(copy, exponent_at, length, power)
                     : apply_scale(read_decimal(copy, exponent_at, length, 0), scale);
  if (strcmp(unit, shown) != 0 && !is_power_of_ten(scale, &power)) {
    // 0.3 inch is 7.62 mm, not the double beside it: noise in the last digits goes.
    char near[SB_NUMBER_SIZE];
    sb_number_round(near, sb_quantity_to_shown(value, si, shown), 15);
    if (strlen(near) < 14) {
      value = sb_quantity_from_shown(g_ascii_strtod(near, NULL), si, shown);
    }
  }
  if (!isfinite(value)) {
    return sb_app_error_input(error, "\"%s\" is not a finite number", copy);
  }
  *out = value;
  return true;
}

bool sb_unit_scale(double *out, const char *unit, const char *si, const char *shown,
                   GError **error) {
  g_autofree char *one = g_strdup_printf("1 %s", unit);
  const bool valid = g_utf8_validate(one, -1, NULL);
  double scale;
  if (valid && !sb_quantity_parse(&scale, one, si, shown, error)) {
    return false;
  }
  if (!valid || !(scale > 0)) {
    return sb_app_error_input(error, "\"%s\" is not a unit of %s", unit, si);
  }
  *out = scale;
  return true;
}

double sb_quantity_to_shown(double value, const char *si, const char *shown) {
  UnitScale scale = find_scale(shown, si);
  if (scale.status != SCALE_OK) {
    return value;
  }
  if (scale.zero != 0) { // to 1e-13 K, below which the difference is noise
    value = round((double)(value - zero_of(scale)) * 1e13) / 1e13;
  }
  double inverse = 1 / scale.scale;
  if (inverse > 1 && fabs(inverse - round(inverse)) <= 1e-12 * inverse) {
    return value * round(inverse);
  }
  return value / scale.scale;
}

double sb_quantity_step(double value, const char *si, const char *shown, int power, double count) {
  double steps = round(sb_quantity_to_shown(value, si, shown) / pow(10, power)) + count;
  // By way of decimals: 163 steps of 0.01 mm are 1.63 mm, not 163 times the double next to 0.01.
  char text[SB_NUMBER_SIZE];
  sb_number_format_shifted(text, steps, -power);
  return sb_quantity_from_shown(g_ascii_strtod(text, NULL), si, shown);
}

double sb_quantity_from_shown(double number, const char *si, const char *shown) {
  UnitScale scale = find_scale(shown, si);
  if (scale.status != SCALE_OK) {
    return number;
  }
  int power = 0;
  if (is_power_of_ten(scale, &power)) {
    char digits[SB_NUMBER_SIZE];
    return g_ascii_strtod(sb_number_format_shifted(digits, number, -power), NULL);
  }
  return apply_scale(number, scale);
}

// Fewest digits of value / scale that come back as `value`; false if no 17 digits do.
static bool format_scaled(char text[SB_NUMBER_SIZE], double value, UnitScale scale) {
  double near = (double)((value - zero_of(scale)) / scale.scale);
  for (int digits = 1; digits <= 17; digits++) {
    sb_number_round(text, near, digits);
    if (apply_scale(g_ascii_strtod(text, NULL), scale) == value) {
      return true;
    }
  }
  // The nearest doubles beside it.
  const double side[] = {nextafter(near, INFINITY), nextafter(near, -INFINITY)};
  for (size_t i = 0; i < G_N_ELEMENTS(side); i++) {
    sb_number_format(text, side[i]);
    if (apply_scale(side[i], scale) == value) {
      return true;
    }
  }
  return false;
}

char *sb_quantity_format(double value, const char *si, const char *shown) {
  char text[SB_NUMBER_SIZE];
  UnitScale scale = find_scale(shown, si);
  int power = 0;
  if (!isfinite(value) || scale.status != SCALE_OK) {
    sb_number_format(text, value);
    shown = si;
  } else if (is_power_of_ten(scale, &power)) {
    sb_number_format_shifted(text, value, power);
  } else if (!format_scaled(text, value, scale)) {
    sb_number_format(text, value);
    shown = si;
  }
  bool bare = *shown == '\0' || strcmp(shown, "1") == 0;
  return bare ? g_strdup(text) : g_strconcat(text, " ", shown, NULL);
}

char *sb_quantity_round(double value, const char *si, const char *shown, int digits) {
  char text[SB_NUMBER_SIZE];
  return isfinite(value)
             ? g_strconcat(sb_number_round(text, sb_quantity_to_shown(value, si, shown), digits),
                           *shown != '\0' ? " " : "", shown, NULL)
             : g_strdup("-");
}
