// A strict JSON writer: UTF-8, shortest digits that read back exactly, null for what is not a
// number, the same bytes in every locale. Two spaces of indentation; arrays of numbers on one line.
#pragma once

#include "engine/valve/run/run.h"

#include <glib.h>
#include <stdbool.h>

typedef struct {
  GString *text;
  int depth;
  bool first; // nothing yet in the open object or array
} SbJson;

void sb_json_init(SbJson *json);

// Begins a document that is an object, opens it and writes its member "engine". Replaces
// sb_json_init() and sb_json_object(); every JSON document of a file or of standard output begins
// with it.
void sb_json_document(SbJson *json);

// Writes the member "engine", the identity of the program (engine/base/version.h), into the open
// object: for objects that are elements of an array of documents.
void sb_json_engine(SbJson *json);

// The finished text with a final line end; owned by the caller. The writer is empty afterwards.
char *sb_json_finish(SbJson *json);

// `key` is NULL inside arrays and for the outermost value.
void sb_json_object(SbJson *json, const char *key);
void sb_json_object_end(SbJson *json);
void sb_json_array(SbJson *json, const char *key);
void sb_json_array_end(SbJson *json);
void sb_json_number(SbJson *json, const char *key, double value);
void sb_json_count(SbJson *json, const char *key, guint64 value);
void sb_json_bool(SbJson *json, const char *key, bool value);
void sb_json_answer(SbJson *json, const char *key, SbAnswer value); // null where unknown

// NULL becomes null; what is not UTF-8 is replaced.
void sb_json_string(SbJson *json, const char *key, const char *value);

// An array of `count` numbers on one line.
void sb_json_numbers(SbJson *json, const char *key, const double *values, size_t count);

// A number of a result struct: key in JSON, and label and unit in the table that people read (NULL:
// in the JSON alone).
typedef struct {
  const char *key, *label, *si, *shown;
  size_t offset;
  size_t error; // offset of the estimate of its relative error; 0: none
} SbResultRow;

double sb_result_value(const SbResultRow *row, const void *of);

// The rows of the struct `of` up to a key of NULL; null where nothing was `found`.
void sb_json_rows(SbJson *json, const SbResultRow *row, const void *of, bool found);

// The array "warnings": code, text, parameter (null without one).
void sb_json_warnings(SbJson *json, const SbWarnings *warnings);
