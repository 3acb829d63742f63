// How parameters are listed for people, the same in every front end: groups with headings, which
// ones are changed, what a search finds, and a step of a value.
#pragma once

#include "app/session/session.h"

// A group of keys that begin alike. Strings are static, to be translated.
typedef struct {
  const char *prefix, *title, *note; // note: NULL for none
  gboolean unfolded;                 // at first
} SbParamHeading;

// The group that a key belongs to; borrowed.
const SbParamHeading *sb_param_heading(const char *key);

// Whether a value in force is another than the default, which may follow from other values.
gboolean sb_param_is_changed(const SbParams *params, SbParamId id);

// "Outer seal: " of a parameter of one part among several alike; "" for most. Borrowed.
const char *sb_param_owner(const SbParam *param);

// The allowed range as sb_param_range() has it, in the language of the window. Owned by the caller.
char *sb_param_range_shown(SbParamId id);

// Whether name, key, symbol, help, choices or other words of a parameter hold a text (casefolded).
gboolean sb_param_matches(SbParamId id, const char *needle);

// Moves a value by `count` steps: a hundredth of it, rounded down to a power of ten in the shown
// unit; at least 1 for whole numbers; choices one after the other. One undo step with the next.
void sb_param_step(SbSession *session, SbParamId id, double count);
