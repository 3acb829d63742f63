// Tables of a run as comma-separated values: a heading with units, then numbers that read back
// exactly, the same bytes in every locale. Errors show in the stream (ferror).
#pragma once

#include "engine/valve/run/run.h"

#include <stdio.h>

// Returns a text as a cell: in quotes where it has a separator, a quote or a line end, and with an
// apostrophe in front where a spreadsheet would compute it as a formula. NULL: empty. Owned by the
// caller: g_free().
char *sb_csv_cell(const char *text);

// Writes that cell.
void sb_csv_text(FILE *stream, const char *text);

// One row per frame: time, displacement, velocity, force, ...
void sb_csv_cycle(FILE *stream, const SbRun *run);

// One row per figure of the catalogue: value in SI, error estimate, or why there is none.
void sb_csv_figures(FILE *stream, const SbRun *run);

// What a life's table says of each actuation, and its JSON without what has no unit (NULL: a bool);
// the last has a name of NULL.
typedef struct {
  const char *name, *unit;
  size_t offset;
} SbLifeColumn;
extern const SbLifeColumn sb_life_columns[];
double sb_life_value(const SbLifeActuation *of, const SbLifeColumn *column);

// One row per actuation of a life: roughness, forces, leakage and its sum; the heading alone
// without a life.
void sb_csv_life(FILE *stream, const SbRun *run);

// Contact profiles: frame, seal, x, pressure of the contact, film, asperity pressure, and the
// pressure that the film's own solution has (empty where no film was solved). A seal's profile is
// written for the first frame that has it and again whenever it changes; it holds until then.
void sb_csv_profiles(FILE *stream, const SbRun *run);
