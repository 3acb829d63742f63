// What people type into a field of a parameter, as the text that files have: a bare number is of
// the unit beside the field, a decimal comma is a point, "+5 %" changes the value in force, and
// "1.7/2 + 0.1 mm" is worked out. Units are those of files and of the command line
// (sb_param_parse()), "60 Shore A" and "60 IRHD" included.
#pragma once

#include "engine/valve/model/params.h"

#include <glib.h>

// The text for sb_param_parse(); what cannot be understood as above is returned as it was typed, so
// that the parser says what is wrong with it. `value` is the one in force [SI]. Owned by the
// caller.
char *sb_typed_text(SbParamId id, double value, const char *typed);
