// A recursive descent over the text, each rule a function.
#include "app/document/expression.h"

#include "app/document/unit.h"

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

static bool fail(Reader *reader, const char *what) {
  g_set_error(reader->error, SB_APP_ERROR, SB_APP_ERROR_INPUT, "%s at \"%.30s\"", what, reader->at);
  return false;
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

static const struct {
  const char *name;
  double (*one)(double);
  double (*two)(double, double);
} functions[] = {{"min", NULL, fmin},  {"max", NULL, fmax}, {"pow", NULL, pow},
                 {"sin", sin, NULL},   {"cos", cos, NULL},  {"tan", tan, NULL},
                 {"atan", atan, NULL}, {"exp", exp, NULL},  {"ln", log, NULL}};

static bool is_function(const char *name) {
  size_t i = 0;
  while (i < G_N_ELEMENTS(functions) && strcmp(functions[i].name, name) != 0) {
    i++;
  }
  return i < G_N_ELEMENTS(functions);
}

// What stands behind "NAME(".
static bool read_function(double *out, Reader *reader, const char *name) {
  size_t i = 0;
  while (strcmp(functions[i].name, name) != 0) {
    i++;
  }
  double other = 0;
  const bool two = functions[i].two != NULL;
  if (!read_sum(out, reader) ||
      (two &&
       (!expect(reader, ';', "min, max and pow take (A; B)") || !read_sum(&other, reader))) ||
      !expect(reader, ')', "a parenthesis is missing")) {
    return false;
  }
  *out = two ? functions[i].two(*out, other) : functions[i].one(*out);
  return true;
}

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
    if (reader->at[length] == '(' && is_function(name)) {
      reader->at += length + 1;
      good = read_function(out, reader, name);
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
    return fail(&reader, "the value is not finite");
  }
  *out = value;
  return true;
}
