// A recursive descent over the text, each rule a function.
#include "app/document/expression.h"

#include "app/base/unit.h"

#include "engine/contact/deflection.h"
#include "engine/film/laws.h"
#include "engine/film/wedge.h"

#include <math.h>
#include <string.h>

enum { DEPTH = 32 };

typedef struct {
  const char *at, *si, *shown;
  SbExpressionName name;
  void *data;
  int depth;
  GError **error;
} Reader;

static bool fail_by(Reader *reader, SbAppError code, const char *what) {
  g_set_error(reader->error, SB_APP_ERROR, (int)code, "%s at \"%s\"", what, reader->at);
  return false;
}

static bool fail(Reader *reader, const char *what) {
  return fail_by(reader, SB_APP_ERROR_INPUT, what);
}

// The next character that is no space.
static char next(Reader *reader) {
  reader->at += strspn(reader->at, " \t");
  return *reader->at;
}

// Reads over a character.
static bool expect(Reader *reader, char character, const char *otherwise) {
  if (next(reader) != character) {
    return fail(reader, otherwise);
  }
  reader->at++;
  return true;
}

static bool read_sum(double *out, Reader *reader);

// "0.02 mm", "2".
static bool read_number(double *out, Reader *reader) {
  char *end = NULL;
  *out = g_ascii_strtod(reader->at, &end);
  if (end == reader->at) {
    return fail(reader, "there is no value");
  }
  const char *unit = end + strspn(end, " \t");
  const size_t length = strcspn(unit, " \t+-*();,");
  if (length > 0 && *unit != '/') {
    g_autofree char *whole = g_strndup(reader->at, (gsize)(unit - reader->at) + length);
    if (!sb_quantity_parse(out, whole, reader->si, reader->shown, reader->error)) {
      return false;
    }
    end = (char *)unit + length;
  }
  reader->at = end;
  return true;
}

// ---- Functions ----

enum { ARGUMENTS = 5 };

typedef double (*One)(double);
typedef double (*Two)(double, double);
typedef double (*Three)(double, double, double);
typedef double (*Four)(double, double, double, double);
typedef double (*Five)(double, double, double, double, double);

static double single(double a) {
  return (float)a;
}

static double full_pressure(double t, double reach) {
  return sb_wedge_pressure(SB_WEDGE_FULL_SOMMERFELD, t, reach);
}

static double half_pressure(double t, double reach) {
  return sb_wedge_pressure(SB_WEDGE_HALF_SOMMERFELD, t, reach);
}

static double reynolds_pressure(double t, double reach) {
  return sb_wedge_pressure(SB_WEDGE_REYNOLDS, t, reach);
}

static double full_load(double reach) {
  return sb_wedge_load(SB_WEDGE_FULL_SOMMERFELD, reach);
}

static double half_load(double reach) {
  return sb_wedge_load(SB_WEDGE_HALF_SOMMERFELD, reach);
}

static double reynolds_load(double reach) {
  return sb_wedge_load(SB_WEDGE_REYNOLDS, reach);
}

// By the number of their arguments.
static const struct {
  const char *name;
  One one;
  Two two;
  Three three;
  Four four;
  Five five;
} functions[] = {
    {"min", .two = fmin},
    {"max", .two = fmax},
    {"pow", .two = pow},
    {"sin", .one = sin},
    {"cos", .one = cos},
    {"tan", .one = tan},
    {"asin", .one = asin},
    {"atan", .one = atan},
    {"exp", .one = exp},
    {"ln", .one = log},
    {"round", .one = round},
    {"single", .one = single},
    {"column", .four = sb_deflection_column},
    {"half_space", .three = sb_deflection_half_space},
    {"panel", .two = sb_deflection_panel},
    {"flamant", .five = sb_deflection_flamant},
    {"disc", .five = sb_deflection_disc},
    {"full_sommerfeld", .two = full_pressure},
    {"half_sommerfeld", .two = half_pressure},
    {"reynolds", .two = reynolds_pressure},
    {"full_sommerfeld_load", .one = full_load},
    {"half_sommerfeld_load", .one = half_load},
    {"reynolds_load", .one = reynolds_load},
    {"reynolds_end", .one = sb_wedge_end},
    {"viscous_border", .one = sb_regime_viscous_border},
    {"elastic_border", .one = sb_regime_elastic_border},
};

// G_N_ELEMENTS(functions): there is none.
static size_t find_function(const char *name) {
  size_t i = 0;
  while (i < G_N_ELEMENTS(functions) && strcmp(functions[i].name, name) != 0) {
    i++;
  }
  return i;
}

static size_t arguments_of(size_t i) {
  return functions[i].one != NULL     ? 1
         : functions[i].two != NULL   ? 2
         : functions[i].three != NULL ? 3
         : functions[i].four != NULL  ? 4
                                      : 5;
}

// What stands behind "NAME(".
static bool read_function(double *out, Reader *reader, size_t i) {
  const size_t count = arguments_of(i);
  double a[ARGUMENTS] = {0};
  for (size_t k = 0; k < count; k++) {
    g_autofree char *otherwise =
        g_strdup_printf("%s takes %zu values, (A; B ...)", functions[i].name, count);
    if ((k > 0 && !expect(reader, ';', otherwise)) || !read_sum(&a[k], reader)) {
      return false;
    }
  }
  if (!expect(reader, ')', "a parenthesis is missing")) {
    return false;
  }
  *out = count == 1   ? functions[i].one(a[0])
         : count == 2 ? functions[i].two(a[0], a[1])
         : count == 3 ? functions[i].three(a[0], a[1], a[2])
         : count == 4 ? functions[i].four(a[0], a[1], a[2], a[3])
                      : functions[i].five(a[0], a[1], a[2], a[3], a[4]);
  return true;
}

// ---- Terms ----

// "-A", "(A)", a name or a number.
static bool read_operand(double *out, Reader *reader) {
  const char first = next(reader);
  bool good = ++reader->depth <= DEPTH || fail(reader, "there are too many parentheses");
  if (good && (first == '-' || first == '(')) {
    reader->at++;
    good = first == '-' ? read_operand(out, reader) : read_sum(out, reader);
    if (good && first == '-') {
      *out = -*out;
    } else if (good) {
      good = expect(reader, ')', "a parenthesis is missing");
    }
  } else if (good && g_ascii_isalpha(first)) {
    size_t length = 1;
    while (g_ascii_isalnum(reader->at[length]) || reader->at[length] == '.' ||
           reader->at[length] == '_') {
      length++;
    }
    g_autofree char *name = g_strndup(reader->at, length);
    const size_t function = find_function(name);
    if (reader->at[length] == '(' && function < G_N_ELEMENTS(functions)) {
      reader->at += length + 1;
      good = read_function(out, reader, function);
    } else {
      good = reader->name(out, name, reader->data) ||
             fail(reader, "there is no parameter and no variable");
      reader->at += good ? length : 0;
    }
  } else if (good) {
    good = read_number(out, reader);
  }
  reader->depth--;
  return good;
}

static bool read_product(double *out, Reader *reader) {
  bool good = read_operand(out, reader);
  for (char sign; good && ((sign = next(reader)) == '*' || sign == '/');) {
    double by = 1;
    reader->at++;
    good = read_operand(&by, reader);
    *out = sign == '*' ? *out * by : *out / by;
  }
  return good;
}

static bool read_sum(double *out, Reader *reader) {
  bool good = read_product(out, reader);
  for (char sign; good && ((sign = next(reader)) == '+' || sign == '-');) {
    double other = 0;
    reader->at++;
    good = read_product(&other, reader);
    *out = sign == '+' ? *out + other : *out - other;
  }
  return good;
}

bool sb_expression_value(double *out, const char *text, const char *si, const char *shown,
                         SbExpressionName name, void *data, GError **error) {
  Reader reader = {
      .at = text, .si = si, .shown = shown, .name = name, .data = data, .error = error};
  double value = 0;
  if (!read_sum(&value, &reader)) {
    return false;
  }
  if (next(&reader) != '\0') {
    return fail(&reader, "an operator is missing");
  }
  if (!isfinite(value)) {
    return fail_by(&reader, SB_APP_ERROR_RANGE, "the value is not finite");
  }
  *out = value;
  return true;
}
