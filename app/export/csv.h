// Tables of a run as comma-separated values: a heading with units, then numbers that read back
// exactly, the same bytes in every locale. Numbers that are not known (NaN) are empty cells. Errors
// of writing are left in the stream (ferror()). `run` has ended.
#pragma once

#include "engine/valve/run/run.h"

#include <stdio.h>

// Writes one row per frame: time, displacement, velocity, forces, films, pressures, reactions [SI].
void sb_csv_cycle(FILE *stream, const SbRun *run);

// Writes one row per figure of the catalogue: path, value in SI, unit, relative error estimate,
// label, and the reason if there is no value.
void sb_csv_figures(FILE *stream, const SbRun *run);

// A column of the table of a life.
typedef struct {
  const char *name;
  const char *unit; // SI; NULL: the value is 1 (yes), 0 (no)
  size_t offset;    // of a double in SbLifeActuation
} SbLifeColumn;

// The columns in their order; the last element has a name of NULL. The table of sb_csv_life() and
// the JSON of a run use the same.
extern const SbLifeColumn sb_life_columns[];

// Returns the value of one column for one actuation [unit of the column]; NaN: not known.
double sb_life_value(const SbLifeActuation *of, const SbLifeColumn *column);

// Writes one row per actuation of a life, numbered from 1: the columns above, then the sums of
// leakage and carried leakage so far. The heading alone if the run has no life.
void sb_csv_life(FILE *stream, const SbRun *run);

// Writes contact profiles: frame (from 0), seal, x, contact pressure, film thickness, asperity
// pressure, and the pressure of the film's own solution (empty where no film was solved). A seal's
// profile is written for the first frame that has it and again whenever it changes; it is valid
// until then.
void sb_csv_profiles(FILE *stream, const SbRun *run);
