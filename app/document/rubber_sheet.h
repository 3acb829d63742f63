// Rubbers by name: files NAME.rubber of kind `rubber`, beside the file that names one, in
// ../rubbers of it, among the user's own ($XDG_DATA_HOME/sealbench/rubbers) or among what ships.
//
//   [sealbench]    format, kind = rubber, title
//   [seal]         modulus, poisson_ratio, mooney_share
//   [rubber]       every key of that group
//   [swell]        FLUID = mass taken up over the dry mass
//   [permeability] FLUID = permeability by partial pressure
//   [source]       of each of them, by its key ("seal.modulus", "swell.hfa-134a"): where it comes
//   from.
//                  One that begins with "typical" is usual of such rubbers and no measurement.
//
// A figure without a source is a problem. What a rubber gives are defaults: a value that a valve, a
// scene or --set gives stays.
#pragma once

#include "app/base/issue.h"

#include "engine/valve/model/params.h"

#include <stdbool.h>

enum { SB_RUBBER_BYTES_MAX = 1 << 16 };

// Reads the rubber `name`, or the file of a name with a folder or the ending; `shown` and `line`
// say where it is named. The path, owned by the caller; NULL with at least one issue.
char *sb_rubber_sheet_read(SbRubberSheet *out, const char *name, const char *directory,
                           const char *shown, int line, GPtrArray *issues);

// Reads a rubber from memory; `shown` names it in issues. False with at least one issue.
bool sb_rubber_sheet_parse(SbRubberSheet *out, const char *text, size_t length, const char *shown,
                           GPtrArray *issues);

// Path of the rubber `name` as sb_rubber_sheet_read() finds it; NULL if there is none. Owned by the
// caller (g_free).
char *sb_rubber_sheet_find(const char *name, const char *directory);

// Names of those that are found from `directory` (NULL: of no file), sorted. By the caller
// (g_strfreev).
char **sb_rubber_sheet_names(const char *directory);
