// Texts that the user types into the field of a parameter. They become texts of a file: a bare
// number has the unit shown next to the field, a decimal comma is a point, "+5 %" changes the value
// in force, and "1.7/2 + 0.1 mm" is computed. Units are those of files and of the command line
// (sb_param_parse()), including "60 Shore A" and "60 IRHD".
#pragma once

#include "engine/valve/model/params.h"

#include <glib.h>

// Returns the text for sb_param_parse(); `value` is the value in force [SI]. A text that is none of
// the forms above is returned unchanged, so that sb_param_parse() reports what is wrong. Never
// NULL.
char *sb_typed_text(SbParamId id, double value, const char *typed);
