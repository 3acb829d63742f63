// Rubbers by name: files NAME.rubber.
//
// A name is looked for in these folders, in this order: `directory`, the folder of the file that
// names the rubber (NULL: the working directory); its ../rubbers (NULL: not searched); the user's
// own ($XDG_DATA_HOME/sealbench/rubbers); the shipped rubbers. A name that contains a '/' or ends
// in ".rubber" is a path, relative to `directory` (NULL: to the working directory).
//
//   [sealbench]    format, kind = rubber, title
//   [seal]         modulus, poisson_ratio, mooney_share
//   [rubber]       every key of that group
//   [swell]        FLUID = absorbed mass divided by the dry mass
//   [permeability] FLUID = permeability by partial pressure
//   [source]       origin of each of them, by its key ("seal.modulus", "swell.hfa-134a");
//                  a text that begins with "typical" marks a typical value, not a measurement
//
// A value without a source is an error. The values of a rubber are defaults: a value that a valve,
// a scene or --set gives takes precedence.
#pragma once

#include "app/base/issue.h"

#include "engine/valve/model/params.h"

#include <stdbool.h>

// Largest size of a file [bytes].
enum { SB_RUBBER_BYTES_MAX = 1 << 16 };

// Reads the rubber `name` to *out, which owns nothing. Returns the path of the rubber's file; NULL
// with at least one issue. `shown` (a path) and `line` (0: none) are the place of the name, used in
// the message if there is no such rubber; issues of the rubber's file name that file.
char *sb_rubber_sheet_read(SbRubberSheet *out, const char *name, const char *directory,
                           const char *shown, int line, GPtrArray *issues);

// Reads a rubber from the `length` bytes of a file to *out; out->name stays empty. `shown` is the
// path of the file in messages. Returns false with at least one issue.
bool sb_rubber_sheet_parse(SbRubberSheet *out, const char *text, size_t length, const char *shown,
                           GPtrArray *issues);

// Returns the path of the file that sb_rubber_sheet_read() would read, which may not exist if
// `name` is a path; NULL if a plain name is found nowhere.
char *sb_rubber_sheet_find(const char *name, const char *directory);

// Returns the names, each once, of all rubbers in the folders that are searched (`directory` NULL:
// the user's and the shipped ones only), sorted, ends with NULL. Freed by g_strfreev().
char **sb_rubber_sheet_names(const char *directory);
