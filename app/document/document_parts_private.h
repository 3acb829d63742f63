// Shared by document_parts.c (shapes) and document_sizes.c (masses and sizes of a shape).
#pragma once

#include "app/cad/cad.h"
#include "app/document/document_parts.h"

// A group [part.NAME] while it is read. Everything is borrowed.
typedef struct {
  const GPtrArray *entries;  // of SbEntry: the file
  const char *group;         // "part.NAME"
  const char *shown;         // name of the file in messages
  GPtrArray *issues, *notes; // appended to; of SbIssue
  int index;                 // the part: SB_VALVE_HOUSING, ...
  SbShapes *shapes;          // results
  SbParams *params;          // values of the file, and results
  const SbParams *base;      // values of the layer below; NULL: the file is a valve
} SbPart;

// Returns the entry of key `name` in the part's group, borrowed; NULL: there is none.
const SbEntry *sb_part_find(const SbPart *part, const char *name);

// Adds an issue (printf format) about key `name` of the part's group. `allowed` is the allowed
// range for the message; NULL: none.
void sb_part_complain(const SbPart *part, const char *name, const char *allowed, const char *format,
                      ...) G_GNUC_PRINTF(4, 5);

// Returns the quantity `text` [`si`], a number with a unit, of key `name`; `unit` is the unit that
// the message of an issue proposes. NaN with an issue if it is not a quantity, or if `text` is NULL
// (missing).
double sb_part_quantity(const SbPart *part, const char *name, const char *text, const char *si,
                        const char *unit);

// Sets parameter `id` to a value [SI] that key `source` results in; an issue if it is out of range.
void sb_part_set(const SbPart *part, SbParamId id, double value, const char *source);

// ---- Masses and sizes (document_sizes.c) ----

// Stores a mass or moment of inertia [SI] that key `source` (a shape) results in, and sets it
// unless the file gives it; then a note states a difference.
void sb_part_derive_mass(const SbPart *part, SbParamId id, double value, const char *source);

// Stores and sets the sizes that the stretches of a profile result in. A different value of the
// same file is an issue.
void sb_part_derive_sizes(const SbPart *part, const SbProfile *profile);
