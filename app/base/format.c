// Value formatting. Digits come from the value's magnitude after rounding (9.996 N is "10.0 N") and
// from the error estimate: sb_format_decimals() holds the rounding rule of the whole program. The
// locale is never read. Leaves out exponents: quantities here stay within six orders of magnitude
// of their unit; other values are written with fixed decimals.
#include "app/base/format.h"

#include <glib.h>
#include <math.h>
#include <stdbool.h>
#include <string.h>

#define MINUS      "\xe2\x88\x92" // U+2212
#define THIN_SPACE "\xe2\x80\x89" // U+2009
#define NO_BREAK   "\xc2\xa0"     // U+00A0
#define EN_DASH    "\xe2\x80\x93"

int sb_format_decimals(double shown, int digits, double relative_error) {
  double size = fabs(shown);
  if (!(size > 0) || !isfinite(size)) {
    return 0;
  }
  int exponent = (int)floor(log10(size));
  int decimals = digits - 1 - exponent;
  // Rounding may carry into a new digit: 9.996 is 10.0 with three digits.
  double unit = pow(10, -decimals);
  if (round(size / unit) * unit >= pow(10, exponent + 1) * (1 - 1e-12)) {
    decimals--;
  }
  if (relative_error > 0 && isfinite(relative_error)) {
    // An error of 0.3 that is stored as 0.29999999 has the first digit 3.
    double error = relative_error * size * (1 + 1e-9);
    int place = -(int)floor(log10(error));
    if (error * pow(10, place) < 3) {
      place++;
    }
    // The first digit is always written: an error above 100 % does not make a value zero.
    decimals = MAX(MIN(decimals, place), -exponent);
  }
  return decimals;
}

// Fixed notation; `decimals` < 0 rounds to tens, hundreds...
static void write_number(char *out, size_t size, double value, int decimals) {
  char digits[SB_FORMAT_MAX + 16], pattern[16];
  if (decimals < 0) {
    double unit = pow(10, -decimals);
    value = round(value / unit) * unit;
    decimals = 0;
  }
  decimals = MIN(decimals, 12);
  g_snprintf(pattern, sizeof pattern, "%%.%df", decimals);
  g_ascii_formatd(digits, sizeof digits, pattern, fabs(CLAMP(value, -1e15, 1e15)));
  // Zero has no sign and no decimals.
  if (strspn(digits, "0.") == strlen(digits)) {
    g_strlcpy(out, "0", size);
    return;
  }
  g_strlcpy(out, value < 0 ? MINUS : "", size);
  size_t whole = strcspn(digits, ".");
  for (size_t i = 0; i < whole; i++) {
    char one[2] = {digits[i], 0};
    // From five digits on; four stay together.
    if (whole >= 5 && i > 0 && (whole - i) % 3 == 0) {
      g_strlcat(out, THIN_SPACE, size);
    }
    g_strlcat(out, one, size);
  }
  g_strlcat(out, digits + whole, size);
}

char *sb_format_fixed(char *out, double value, int decimals) {
  if (!isfinite(value)) {
    g_strlcpy(out, EN_DASH, SB_FORMAT_MAX);
  } else {
    write_number(out, SB_FORMAT_MAX, value, decimals);
  }
  return out;
}

char *sb_format_digits(char *out, double value, int digits) {
  return sb_format_fixed(out, value, sb_format_decimals(value, digits, 0));
}

typedef struct {
  double scale; // units per SI
  const char *unit;
} Unit;

static Unit choose_unit(SbQuantity quantity, double value) {
  double size = fabs(value);
  switch (quantity) {
  case SB_QUANTITY_FORCE:
    return (Unit){1, "N"};
  case SB_QUANTITY_LENGTH:
    return (Unit){1e3, "mm"};
  case SB_QUANTITY_FILM:
    return size >= 0.9995e-6 ? (Unit){1e6, "µm"} : (Unit){1e9, "nm"};
  case SB_QUANTITY_PRESSURE:
    return (Unit){1e-6, "MPa"};
  case SB_QUANTITY_ENERGY:
    return (Unit){1e3, "mJ"};
  case SB_QUANTITY_TIME:
    return (Unit){1, "s"};
  case SB_QUANTITY_SPEED:
    return (Unit){1e3, "mm/s"};
  case SB_QUANTITY_VOLUME:
    // 1 pl = 1e-15 m3
    return size >= 0.9995e-9    ? (Unit){1e9, "µl"}
           : size >= 0.9995e-12 ? (Unit){1e12, "nl"}
                                : (Unit){1e15, "pl"};
  case SB_QUANTITY_FRACTION:
    return (Unit){100, "%"};
  default:
    return (Unit){1, ""};
  }
}

const char *sb_quantity_unit(SbQuantity quantity, double value) {
  return choose_unit(quantity, value).unit;
}

static void format(SbFormatted *out, SbQuantity quantity, double value, int digits,
                   double relative_error) {
  Unit unit = choose_unit(quantity, isfinite(value) ? value : 0);
  g_strlcpy(out->unit, unit.unit, sizeof out->unit);
  if (!isfinite(value)) {
    g_strlcpy(out->number, EN_DASH, sizeof out->number);
    return;
  }
  double shown = value * unit.scale;
  // Below what any figure here means, a value is zero: rounding noise of a sum of forces is no
  // result.
  if (quantity == SB_QUANTITY_FORCE && fabs(shown) < 5e-4) {
    shown = 0;
  }
  int decimals = sb_format_decimals(shown, digits, relative_error);
  write_number(out->number, sizeof out->number, shown, decimals);
}

void sb_format(SbFormatted *out, SbQuantity quantity, double value, double relative_error) {
  format(out, quantity, value, relative_error > 0 ? 4 : 3, relative_error);
}

static char *joined(char *out, const SbFormatted *parts) {
  g_strlcpy(out, parts->number, SB_FORMAT_MAX);
  if (parts->unit[0]) {
    g_strlcat(out, NO_BREAK, SB_FORMAT_MAX);
    g_strlcat(out, parts->unit, SB_FORMAT_MAX);
  }
  return out;
}

char *sb_format_text(char *out, SbQuantity quantity, double value, double relative_error) {
  SbFormatted parts;
  sb_format(&parts, quantity, value, relative_error);
  return joined(out, &parts);
}

char *sb_format_trimmed(char *out, SbQuantity quantity, double value, int digits) {
  SbFormatted parts;
  format(&parts, quantity, value, digits, 0);
  if (strchr(parts.number, '.')) {
    size_t end = strlen(parts.number);
    while (parts.number[end - 1] == '0') {
      end--;
    }
    parts.number[parts.number[end - 1] == '.' ? end - 1 : end] = 0;
  }
  return joined(out, &parts);
}

char *sb_format_given(char *out, SbQuantity quantity, double value) {
  return sb_format_trimmed(out, quantity, value, 6);
}

char *sb_format_film_tick(char *out, double length) {
  const char *unit = "nm";
  double shown = length * 1e9;
  if (shown >= 999.5e3) {
    shown *= 1e-6;
    unit = "mm";
  } else if (shown >= 999.5) {
    shown *= 1e-3;
    unit = "µm";
  }
  char number[SB_FORMAT_MAX];
  sb_format_digits(number, shown, 1);
  g_snprintf(out, SB_FORMAT_MAX, "%s" NO_BREAK "%s", number, unit);
  return out;
}

char *sb_format_power(char *out, int exponent) {
  static const char *const raised[] = {
      "\xe2\x81\xb0", "\xc2\xb9",     "\xc2\xb2",     "\xc2\xb3",     "\xe2\x81\xb4",
      "\xe2\x81\xb5", "\xe2\x81\xb6", "\xe2\x81\xb7", "\xe2\x81\xb8", "\xe2\x81\xb9"};
  char digits[16];
  g_snprintf(digits, sizeof digits, "%d", ABS(exponent));
  g_strlcpy(out, exponent < 0 ? "10\xe2\x81\xbb" : "10", SB_FORMAT_MAX);
  for (const char *digit = digits; *digit != '\0'; digit++) {
    g_strlcat(out, raised[*digit - '0'], SB_FORMAT_MAX);
  }
  return out;
}

char *sb_sentence_case(const char *text) {
  char *out = g_strdup(text);
  const gsize word = strcspn(out, " ");
  const bool key = word > 0 && memchr(out, '.', word - 1) != NULL;
  out[0] = key ? out[0] : g_ascii_toupper(out[0]);
  return out;
}
