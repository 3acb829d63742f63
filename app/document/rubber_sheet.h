// Rubbers by name: files NAME.rubber. A name is looked for next to the file that names it, in
// ../rubbers of that file, among the user's own ($XDG_DATA_HOME/sealbench/rubbers) and among the
// shipped rubbers, in this order.
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

// Reads the rubber `name` to *out, or the file if `name` has a folder or the ending. `directory` is
// the folder of the file that names it (NULL: none); `shown` and `line` are that file and line, for
// messages. Returns the path of the rubber's file; NULL with at least one issue. An SbRubberSheet
// owns nothing.
char *sb_rubber_sheet_read(SbRubberSheet *out, const char *name, const char *directory,
                           const char *shown, int line, GPtrArray *issues);

// Reads a rubber from the `length` bytes of a file; `shown` is used as its path in messages.
// Returns false with at least one issue.
bool sb_rubber_sheet_parse(SbRubberSheet *out, const char *text, size_t length, const char *shown,
                           GPtrArray *issues);

// Returns the path of the rubber that sb_rubber_sheet_read() would read; NULL if there is none.
char *sb_rubber_sheet_find(const char *name, const char *directory);

// Returns the names of all rubbers that are found from `directory` (NULL: of no file), sorted, ends
// with NULL. Freed by g_strfreev().
char **sb_rubber_sheet_names(const char *directory);
