// A strict JSON writer: UTF-8, shortest digits that read back exactly, null for numbers that are
// not finite, the same bytes in every locale. Two spaces of indentation; arrays of numbers on one
// line. The caller opens and closes objects and arrays in pairs; this is not checked.
//
// Every function with a `key` writes one member of the open object; `key` is NULL for an element
// of the open array and for the outermost value.
#pragma once

#include "engine/valve/run/run.h"

#include <glib.h>
#include <stdbool.h>

// The state of a writer; initialised by sb_json_init() or sb_json_document().
typedef struct {
  GString *text;
  int depth;  // of open objects and arrays
  bool first; // the open object or array is empty so far
} SbJson;

// Initialises a writer without text; its memory is freed by sb_json_finish().
void sb_json_init(SbJson *json);

// Initialises a writer, opens an object and writes its member "engine". Every JSON document of a
// file or of standard output begins with this call; the caller closes the object.
void sb_json_document(SbJson *json);

// Writes the member "engine", the identity of the program (engine/base/version.h), into the open
// object: for objects that are elements of an array of documents.
void sb_json_engine(SbJson *json);

// Ends the writer and returns its text with a final line end.
char *sb_json_finish(SbJson *json);

// Opens an object.
void sb_json_object(SbJson *json, const char *key);

// Closes the open object.
void sb_json_object_end(SbJson *json);

// Opens an array.
void sb_json_array(SbJson *json, const char *key);

// Closes the open array.
void sb_json_array_end(SbJson *json);

// Writes a number; null if it is NaN or infinite.
void sb_json_number(SbJson *json, const char *key, double value);

// Writes an integer.
void sb_json_count(SbJson *json, const char *key, guint64 value);

// Writes true or false.
void sb_json_bool(SbJson *json, const char *key, bool value);

// Writes true, false, or null for an unknown answer.
void sb_json_answer(SbJson *json, const char *key, SbAnswer value);

// Writes a string; null for NULL. Bytes that are not UTF-8 are replaced.
void sb_json_string(SbJson *json, const char *key, const char *value);

// Writes an array of numbers on one line; null for those that are not finite.
void sb_json_numbers(SbJson *json, const char *key, const double *values, size_t count);

// A number in a struct of results, for JSON and tables.
typedef struct {
  const char *key;   // in JSON; NULL ends a list of rows
  const char *label; // in the table; NULL: in JSON only
  const char *si;    // unit of the value
  const char *shown; // display unit in the table
  size_t offset;     // of a double in the struct [bytes]
  size_t error;      // offset of its relative error estimate, a double; 0: none
} SbResultRow;

// Returns the value of a row [si] in the struct `of`, whose type the row is made for.
double sb_result_value(const SbResultRow *row, const void *of);

// Writes the value of each row of the list from `row` to a key of NULL, from the struct `of`; null
// for all if `found` is false. Error estimates are rows of their own.
void sb_json_rows(SbJson *json, const SbResultRow *row, const void *of, bool found);

// Writes the array "warnings" of objects with code, text and parameter (null: none).
void sb_json_warnings(SbJson *json, const SbWarnings *warnings);
