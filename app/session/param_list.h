// How parameters are listed for the user, the same in every front end: groups with headings,
// changed parameters, search, and steps of a value.
#pragma once

#include "app/session/session.h"

// A group of parameters. Strings are static and untranslated (sb_translation()).
typedef struct {
  const char *title; // heading
  const char *note;  // sentence below the heading; NULL: none
  gboolean unfolded; // the group is open at first
} SbParamHeading;

// Returns the group to which a parameter belongs. Static.
const SbParamHeading *sb_param_heading(SbParamId id);

// Returns whether the value in force differs from the default, which may follow from other values.
gboolean sb_param_is_changed(const SbParams *params, SbParamId id);

// Returns a translated prefix for a parameter that several parts have, such as "Outer seal: "; ""
// for others. Static.
const char *sb_param_owner(SbParamId id);

// Returns the edit that undo (or redo) would change: "Outer seal: section diameter 1.7 → 1.58 mm",
// always with the value before it first; of an edit that is not of one parameter only what it
// concerns, "Rubber". NULL: there is none. Translated.
char *sb_param_undo_text(const SbDocument *document, bool redo);

// Returns the allowed range, "0.2 to 20 mm" (translated), or the names of the choices.
char *sb_param_range_shown(SbParamId id);

// Returns whether name, key, symbol, help, choices or synonyms of a parameter contain `needle`,
// which must be folded by g_utf8_casefold().
gboolean sb_param_matches(SbParamId id, const char *needle);

// Changes a value by `count` steps, within its range, as an edit of the session that joins an
// immediately following one. A step of a real number is a hundredth of it, rounded down to a power
// of ten in the display unit (|count| < 1: a tenth of that); of an integer 1; of a choice the next
// one, whatever |count| is. `count` is not 0; a negative one steps down. A parameter of kind
// SB_PARAM_FLAGS does not change.
void sb_param_step(SbSession *session, SbParamId id, double count);
