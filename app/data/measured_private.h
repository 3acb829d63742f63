// Shared by measured.c, which reads and scales the rows, measured_keys.c, _find.c, _tests.c and
// compare.c.
#pragma once

#include "app/data/measured.h"

#include <math.h>
#include <string.h>

// Second half of reading a file. On entry `measured` has its columns and rows in SI as the file has
// them: count, time, displacement (crosshead reading) and force; all later fields are 0. Fills them
// and corrects the rows in place. Returns false with at least one issue; the rows may then be
// partly corrected.
bool sb_measured_find(SbMeasured *measured, const SbData *data, GPtrArray *issues);

// Returns the rows of cycle `index`, from 0, below measured->cycle->len; borrowed.
static inline const SbMeasuredCycle *sb_measured_cycle(const SbMeasured *measured, size_t index) {
  return &g_array_index(measured->cycle, SbMeasuredCycle, index);
}

enum { ROWS_MIN = 8 }; // of a loop

// Makes the forces of rows not a number that do not continue the table, and counts the tests below
// the first one. block[row]: number of its block in the table, changed.
void sb_measured_tests(SbMeasured *measured, const SbTextTable *table, double *block);

// Returns the layout (app/base/choice.h) of the columns: names of channels or, with `units`, units.
char *sb_measured_layout(const SbMeasured *measured, bool units);

// Writes the dialect that keys choose; members without a key stay 0. Returns false with an issue
// for each text that is not known, also of the key `signal`.
bool sb_measured_dialect(SbTextTableDialect *wish, const SbData *data, GPtrArray *issues);
