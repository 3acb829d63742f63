// See the header. Digits beyond the twelfth of what was worked out are rounding, and left out.
#include "app/document/typed.h"

#include "app/base/number.h"
#include "app/base/unit.h"

#include <math.h>
#include <stdbool.h>
#include <string.h>

enum { DEPTH_MAX = 32 }; // of brackets

typedef struct {
  const char *at;
  int depth;
  bool good;
} TypedReader;

static void skip_typed(TypedReader *reader) {
  while (g_ascii_isspace(*reader->at)) {
    reader->at++;
  }
}

static bool accept(TypedReader *reader, char sign) {
  skip_typed(reader);
  const bool there = *reader->at == sign;
  reader->at += there;
  return there;
}

static double read_typed_sum(TypedReader *reader);

static double read_factor(TypedReader *reader) {
  if (++reader->depth > DEPTH_MAX) {
    reader->good = false;
  }
  double value = 0;
  if (!reader->good) {
    return 0;
  }
  if (accept(reader, '-')) {
    value = -read_factor(reader);
  } else if (accept(reader, '(')) {
    value = read_typed_sum(reader);
    reader->good = reader->good && accept(reader, ')');
  } else {
    skip_typed(reader);
    const size_t length = *reader->at == '+' ? 0 : sb_number_read(&value, reader->at);
    reader->good = length > 0;
    reader->at += length;
  }
  reader->depth--;
  return value;
}

static double read_typed_product(TypedReader *reader) {
  double value = read_factor(reader);
  while (reader->good) {
    if (accept(reader, '*')) {
      value *= read_factor(reader);
    } else if (accept(reader, '/')) {
      value /= read_factor(reader);
    } else {
      break;
    }
  }
  return value;
}

static double read_typed_sum(TypedReader *reader) {
  double value = read_typed_product(reader);
  while (reader->good) {
    if (accept(reader, '+')) {
      value += read_typed_product(reader);
    } else if (accept(reader, '-')) {
      value -= read_typed_product(reader);
    } else {
      break;
    }
  }
  return value;
}

// Works out what the text begins with; the rest is what stands behind it. False if nothing can be.
static bool work_out(double *value, const char **rest, const char *text) {
  TypedReader reader = {.at = text, .good = true};
  *value = read_typed_sum(&reader);
  skip_typed(&reader);
  *rest = reader.at;
  return reader.good && isfinite(*value);
}

// Commas in numbers that have one comma and no point. "1,234.5" and "1,2,3" stay: they may mean
// anything.
static void replace_commas(char *text) {
  for (char *c = text; *c != '\0';) {
    const size_t length = strspn(c, "0123456789.,");
    char *comma = memchr(c, ',', length);
    if (comma != NULL && comma > c && g_ascii_isdigit(comma[1]) && memchr(c, '.', length) == NULL &&
        memchr(comma + 1, ',', length - (size_t)(comma + 1 - c)) == NULL) {
      *comma = '.';
    }
    c += length > 0 ? length : 1;
  }
}

static char *with_unit(double number, const char *unit) {
  char digits[G_ASCII_DTOSTR_BUF_SIZE];
  g_ascii_formatd(digits, sizeof digits, "%.12g", number);
  return g_strconcat(digits, *unit != '\0' ? " " : "", unit, NULL);
}

char *sb_typed_text(SbParamId id, double value, const char *typed) {
  const SbParam *param = sb_param(id);
  g_autofree char *text = g_strstrip(g_strdup(typed));
  if ((param->kind != SB_PARAM_REAL && param->kind != SB_PARAM_INT) ||
      strlen(text) > SB_NUMBER_LENGTH_MAX) {
    return g_strdup(typed);
  }
  replace_commas(text);
  const bool change = *text == '+' || *text == '-';
  double number, direct;
  const char *rest;
  const bool worked = work_out(&number, &rest, text + (*text == '+'));
  // A share of the value in force; of a temperature it would mean nothing.
  if (change && worked && strcmp(rest, "%") == 0 && !sb_quantity_is_point(param->unit)) {
    const double shown = sb_quantity_to_shown(value, param->si, param->unit);
    return with_unit(shown * (1 + number / 100), param->unit);
  }
  if (sb_param_parse(&direct, id, text, NULL)) {
    return g_steal_pointer(&text);
  }
  if (!worked) {
    return g_strdup(typed);
  }
  // A unit is a word of its own; anything else is a mistake in what was to be worked out.
  if (*rest != '\0' && !g_ascii_isalpha(*rest) && (*rest & 0x80) == 0 && *rest != '%') {
    return g_strdup(typed);
  }
  const char *meant = *rest != '\0' ? rest : param->unit;
  // A number alone keeps all of its digits.
  const size_t length = sb_number_scan(text, NULL);
  if (length > 0 && text + length + strspn(text + length, " \t") == rest) {
    g_autofree char *digits = g_strndup(text, length);
    return g_strconcat(digits, *meant != '\0' ? " " : "", meant, NULL);
  }
  return with_unit(number, meant);
}
