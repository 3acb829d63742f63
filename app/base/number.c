// Numbers as text. Digits come from the C library's correctly rounded conversions (by way of
// GLib, which takes the locale out); this file only chooses how many and where the point goes.
#include "app/base/number.h"

#include <glib.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

size_t sb_number_scan(const char *text, size_t *exponent_at) {
  const char *c = text + (*text == '+' || *text == '-');
  const char *first = c;
  while (g_ascii_isdigit(*c)) {
    c++;
  }
  bool digits = c > first;
  if (*c == '.') {
    digits = digits || g_ascii_isdigit(c[1]);
    for (c++; g_ascii_isdigit(*c); c++) {
    }
  }
  if (!digits) {
    return 0;
  }
  if (exponent_at != NULL) {
    *exponent_at = (size_t)(c - text);
  }
  if (*c == 'e' || *c == 'E') {
    const char *e = c + 1 + (c[1] == '+' || c[1] == '-');
    if (g_ascii_isdigit(*e)) {
      while (g_ascii_isdigit(*e)) {
        e++;
      }
      c = e;
    }
  }
  return (size_t)(c - text);
}

// Reads the `length` bytes of a number that one multiplication or division of exact doubles rounds
// correctly: a whole number up to 2^53 and a power of ten up to 22 (W.D. Clinger, PLDI 1990). False
// for others.
static bool read_exactly(double *out, const char *text, size_t length) {
  static const double tens[] = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                1e8,  1e9,  1e10, 1e11, 1e12, 1e13, 1e14, 1e15,
                                1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};
  guint64 whole = 0;
  long exponent = 0;
  int taken = 0;
  bool point = false, power = false;
  for (size_t i = *text == '+' || *text == '-'; i < length && !power; i++) {
    if (g_ascii_isdigit(text[i]) && taken < 18) {
      whole = whole * 10 + (guint64)(text[i] - '0');
      taken += whole > 0;
      exponent -= point;
    } else if (text[i] == '.') {
      point = true;
    } else if (g_ascii_isdigit(text[i])) {
      return false;
    } else {
      const long by = strtol(text + i + 1, NULL, 10);
      exponent += CLAMP(by, -1000, 1000);
      power = true;
    }
  }
  if (whole > G_GUINT64_CONSTANT(1) << 53 || exponent < -22 || exponent > 22) {
    return false;
  }
  *out = exponent < 0 ? (double)whole / tens[-exponent] : (double)whole * tens[exponent];
  *out = *text == '-' ? -*out : *out;
  return true;
}

size_t sb_number_read(double *out, const char *text) {
  size_t length = sb_number_scan(text, NULL);
  if (length == 0 || length > SB_NUMBER_LENGTH_MAX) {
    return 0;
  }
  if (read_exactly(out, text, length)) {
    return length;
  }
  // Only these characters: strtod would go on into "0x10".
  char digits[SB_NUMBER_LENGTH_MAX + 1];
  memcpy(digits, text, length);
  digits[length] = '\0';
  double value = g_ascii_strtod(digits, NULL);
  if (!isfinite(value)) {
    return 0;
  }
  *out = value;
  return length;
}

bool sb_number_parse(double *out, const char *text) {
  double value;
  size_t length = sb_number_read(&value, text);
  if (length == 0 || text[length] != '\0') {
    return false;
  }
  *out = value;
  return true;
}

int sb_number_compare(const void *a, const void *b) {
  const double x = *(const double *)a, y = *(const double *)b;
  return (x > y) - (x < y);
}

double sb_number_median(double *value, size_t count) {
  if (count == 0) {
    return NAN;
  }
  qsort(value, count, sizeof *value, sb_number_compare);
  return 0.5 * (value[(count - 1) / 2] + value[count / 2]);
}

// Splits "d.ddde[+-]xx" into digits without trailing zeros and the decimal exponent.
static int split(char digits[SB_NUMBER_SIZE], const char *scientific) {
  int count = 0;
  const char *c = scientific;
  for (; *c != '\0' && *c != 'e'; c++) {
    if (g_ascii_isdigit(*c)) {
      digits[count++] = *c;
    }
  }
  while (count > 1 && digits[count - 1] == '0') {
    count--;
  }
  digits[count] = '\0';
  return *c == 'e' ? atoi(c + 1) : 0;
}

// Lays digits out as plain decimals, or with an exponent where there would be many zeros.
static char *lay_out(char text[SB_NUMBER_SIZE], bool negative, const char *digits, int exponent) {
  int count = (int)strlen(digits);
  char *c = text;
  if (negative) {
    *c++ = '-';
  }
  if (exponent < -5 || exponent > 15) {
    *c++ = digits[0];
    if (count > 1) {
      *c++ = '.';
      memcpy(c, digits + 1, (size_t)count - 1);
      c += count - 1;
    }
    snprintf(c, 8, "e%+03d", exponent);
    return text;
  }
  if (exponent < 0) {
    *c++ = '0';
    *c++ = '.';
    for (int i = -1; i > exponent; i--) {
      *c++ = '0';
    }
    memcpy(c, digits, (size_t)count + 1);
    return text;
  }
  for (int i = 0; i <= exponent || i < count; i++) {
    if (i == exponent + 1) {
      *c++ = '.';
    }
    *c++ = i < count ? digits[i] : '0';
  }
  *c = '\0';
  return text;
}

static char *special(char text[SB_NUMBER_SIZE], double value) {
  const char *word = value == 0 ? "0" : isnan(value) ? "nan" : value > 0 ? "inf" : "-inf";
  return strcpy(text, word);
}

char *sb_number_format_shifted(char text[SB_NUMBER_SIZE], double value, int shift) {
  if (!isfinite(value) || value == 0) {
    return special(text, value);
  }
  // Fifteen digits hold every shorter decimal; sixteen or seventeen only where they are needed.
  static const char *const formats[] = {"%.14e", "%.15e", "%.16e"};
  char scientific[SB_NUMBER_SIZE];
  for (size_t i = 0; i < G_N_ELEMENTS(formats); i++) {
    g_ascii_formatd(scientific, sizeof scientific, formats[i], fabs(value));
    if (g_ascii_strtod(scientific, NULL) == fabs(value)) {
      break;
    }
  }
  char digits[SB_NUMBER_SIZE];
  int exponent = split(digits, scientific);
  return lay_out(text, value < 0, digits, exponent - shift);
}

char *sb_number_format(char text[SB_NUMBER_SIZE], double value) {
  return sb_number_format_shifted(text, value, 0);
}

char *sb_number_round(char text[SB_NUMBER_SIZE], double value, int digits) {
  if (!isfinite(value) || value == 0) {
    return special(text, value);
  }
  char format[8];
  snprintf(format, sizeof format, "%%.%de", CLAMP(digits, 1, 17) - 1);
  char scientific[SB_NUMBER_SIZE];
  g_ascii_formatd(scientific, sizeof scientific, format, fabs(value));
  char kept[SB_NUMBER_SIZE];
  int exponent = split(kept, scientific);
  return lay_out(text, value < 0, kept, exponent);
}
