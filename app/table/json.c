// The JSON writer.
#include "app/table/json.h"

#include "app/base/number.h"

#include "engine/base/version.h"

#include <math.h>

void sb_json_init(SbJson *json) {
  *json = (SbJson){g_string_new(NULL), 0, true};
}

char *sb_json_finish(SbJson *json) {
  g_string_append_c(json->text, '\n');
  char *text = g_string_free(json->text, FALSE);
  *json = (SbJson){NULL, 0, true};
  return text;
}

static void indent(SbJson *json) {
  g_string_append_c(json->text, '\n');
  for (int i = 0; i < json->depth; i++) {
    g_string_append(json->text, "  ");
  }
}

static void quote(SbJson *json, const char *value) {
  g_autofree char *valid = g_utf8_make_valid(value, -1);
  g_string_append_c(json->text, '"');
  for (const char *c = valid; *c != '\0'; c++) {
    if (*c == '"' || *c == '\\') {
      g_string_append_c(json->text, '\\');
      g_string_append_c(json->text, *c);
    } else if ((unsigned char)*c < 0x20) {
      g_string_append_printf(json->text, "\\u%04x", (unsigned)*c);
    } else {
      g_string_append_c(json->text, *c);
    }
  }
  g_string_append_c(json->text, '"');
}

// Comma, new line and key before a value.
static void begin(SbJson *json, const char *key) {
  if (!json->first) {
    g_string_append_c(json->text, ',');
  }
  if (json->depth > 0) {
    indent(json);
  }
  json->first = false;
  if (key != NULL) {
    quote(json, key);
    g_string_append(json->text, ": ");
  }
}

static void open(SbJson *json, const char *key, char bracket) {
  begin(json, key);
  g_string_append_c(json->text, bracket);
  json->depth++;
  json->first = true;
}

static void close_with(SbJson *json, char bracket) {
  json->depth--;
  if (!json->first) {
    indent(json);
  }
  g_string_append_c(json->text, bracket);
  json->first = false;
}

void sb_json_object(SbJson *json, const char *key) {
  open(json, key, '{');
}

void sb_json_object_end(SbJson *json) {
  close_with(json, '}');
}

void sb_json_array(SbJson *json, const char *key) {
  open(json, key, '[');
}

void sb_json_array_end(SbJson *json) {
  close_with(json, ']');
}

static void number(SbJson *json, double value) {
  char digits[SB_NUMBER_SIZE];
  g_string_append(json->text, isfinite(value) ? sb_number_format(digits, value) : "null");
}

void sb_json_number(SbJson *json, const char *key, double value) {
  begin(json, key);
  number(json, value);
}

void sb_json_count(SbJson *json, const char *key, guint64 value) {
  begin(json, key);
  g_string_append_printf(json->text, "%" G_GUINT64_FORMAT, value);
}

void sb_json_bool(SbJson *json, const char *key, bool value) {
  begin(json, key);
  g_string_append(json->text, value ? "true" : "false");
}

void sb_json_answer(SbJson *json, const char *key, SbAnswer value) {
  static const char *const names[] = {"null", "false", "true"};
  begin(json, key);
  g_string_append(json->text, names[value]);
}

void sb_json_string(SbJson *json, const char *key, const char *value) {
  begin(json, key);
  if (value != NULL) {
    quote(json, value);
  } else {
    g_string_append(json->text, "null");
  }
}

void sb_json_numbers(SbJson *json, const char *key, const double *values, size_t count) {
  begin(json, key);
  g_string_append_c(json->text, '[');
  for (size_t i = 0; i < count; i++) {
    if (i > 0) {
      g_string_append(json->text, ", ");
    }
    number(json, values[i]);
  }
  g_string_append_c(json->text, ']');
}

void sb_json_document(SbJson *json) {
  sb_json_init(json);
  sb_json_object(json, NULL);
  sb_json_engine(json);
}

void sb_json_engine(SbJson *json) {
  const SbEngineIdentity *engine = sb_engine_identity();
  sb_json_object(json, "engine");
  sb_json_string(json, "version", engine->version);
  sb_json_string(json, "source", engine->source);
  sb_json_string(json, "commit", engine->commit);
  sb_json_string(json, "options", engine->options);
  sb_json_object_end(json);
}

void sb_json_warnings(SbJson *json, const SbWarnings *warnings) {
  sb_json_array(json, "warnings");
  for (size_t i = 0; i < warnings->count; i++) {
    const SbWarning *warning = &warnings->item[i];
    sb_json_object(json, NULL);
    sb_json_string(json, "code", warning->code);
    sb_json_string(json, "text", warning->text);
    sb_json_string(json, "parameter", warning->input != 0 ? sb_input_key(warning->input) : NULL);
    sb_json_object_end(json);
  }
  sb_json_array_end(json);
}

double sb_result_value(const SbResultRow *row, const void *of) {
  return *(const double *)((const char *)of + row->offset);
}

void sb_json_rows(SbJson *json, const SbResultRow *row, const void *of, bool found) {
  for (; row->key != NULL; row++) {
    sb_json_number(json, row->key, found ? sb_result_value(row, of) : NAN);
  }
}
