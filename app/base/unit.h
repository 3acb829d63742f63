// Values with units: text to SI and back.
//
// "1.61mm", "1.61 mm", "0.211mPa.s", "20 mm/min", "2.8 1/GPa" and "1 µm" are read by udunits-2; a
// value whose unit is a power of ten of the SI unit is scaled in decimal, so that "1.61 mm" is
// exactly the double 1.61e-3. A bare number is an error unless the quantity has no unit. A quantity
// that people read in °C is a point of the scale of temperature and takes °C, degC, K and the like;
// one in K is a difference. No locale plays a role. Safe to call from any thread.
#pragma once

#include "app/base/error.h"
#include "app/base/number.h"

#include "engine/valve/model/params.h"

#include <glib.h>

// Reads `text` as a quantity of the dimension of `si` ("m", "Pa.s", "1"). `shown` is the unit that
// error messages propose. Returns false with SB_APP_ERROR_INPUT and one sentence that names the
// expected unit; *out is untouched then.
SB_CHECKED bool sb_quantity_parse(double *out, const char *text, const char *si, const char *shown,
                                  GError **error);

// Whether the unit that people read makes a quantity a point of a scale, not a difference.
bool sb_quantity_is_point(const char *shown);

// `value` [SI] in unit `shown` with the fewest digits that read back to the same double; the number
// alone if `shown` is empty. Falls back to the SI unit where `shown` cannot express the value
// exactly. Owned by the caller.
char *sb_quantity_format(double value, const char *si, const char *shown);

// The number alone, for a spin button or a table whose heading has the unit: value / (shown in SI).
double sb_quantity_to_shown(double value, const char *si, const char *shown);
double sb_quantity_from_shown(double number, const char *si, const char *shown);

// The value that lies `count` steps of 10^power in unit `shown` from the step nearest to `value`:
// exactly what its short decimal text reads as.
double sb_quantity_step(double value, const char *si, const char *shown, int power, double count);

// A catalogue value as text: with its unit, or the name of a choice, the names of flags with ';',
// or a whole number. Owned by the caller.
char *sb_param_format(SbParamId id, double value);

// Text of a catalogue value, checked for kind, unit and range. On failure the sentence does not
// repeat the key or the range.
SB_CHECKED bool sb_param_parse(double *out, SbParamId id, const char *text, GError **error);

// Allowed range of a parameter for people: "0.2 to 20 mm", "thesis, reynolds". Owned by the caller.
char *sb_param_range(SbParamId id);

// Its ends, of a number: "0.2", "20 mm". Both owned by the caller.
void sb_param_range_ends(SbParamId id, char *end[2]);
