// Values with units: text to SI and back.
//
// "1.61mm", "1.61 mm", "0.211mPa.s", "20 mm/min", "2.8 1/GPa" and "1 µm" are read by udunits-2; a
// value whose unit is a power of ten of the SI unit is scaled in decimal, so that "1.61 mm" is
// exactly the double 1.61e-3. A bare number is an error unless the quantity has no unit. A quantity
// with the display unit °C is a point on the temperature scale and accepts °C, degC and K; one with
// K is a difference. Independent of the locale. Any thread.
//
// Parameters: `si` is the SI unit of a quantity ("m", "Pa.s", "1"), `shown` its display unit ("mm";
// "" if it has none).
#pragma once

#include "app/base/error.h"
#include "app/base/number.h"

#include "engine/valve/model/params.h"

#include <glib.h>

// Reads `text` as a quantity of the dimension of `si` to *out [si]. Returns false with
// SB_APP_ERROR_INPUT and a sentence that proposes the unit `shown`; *out is then not changed.
SB_CHECKED bool sb_quantity_parse(double *out, const char *text, const char *si, const char *shown,
                                  GError **error);

// Writes the size of one `unit` [si]. Returns false with SB_APP_ERROR_INPUT if it is not a unit of
// the dimension of `si`, or not above 0.
SB_CHECKED bool sb_unit_scale(double *out, const char *unit, const char *si, const char *shown,
                              GError **error);

// Returns whether the display unit makes a quantity a point on a scale (°C), not a difference.
bool sb_quantity_is_point(const char *shown);

// Returns `value` [si] in the unit `shown` with the fewest digits that read back to the same
// double, and the unit. In the SI unit if `shown` cannot express the value exactly.
char *sb_quantity_format(double value, const char *si, const char *shown);

// Returns `value` [si] in the unit `shown` with at most `digits` significant digits, and the unit;
// "-" if it is not finite.
char *sb_quantity_round(double value, const char *si, const char *shown, int digits);

// Returns the number that `value` [si] has in the unit `shown`.
double sb_quantity_to_shown(double value, const char *si, const char *shown);

// Returns the value [si] of a number in the unit `shown`.
double sb_quantity_from_shown(double number, const char *si, const char *shown);

// Returns the value [si] that is `count` steps of 10^power in the unit `shown` from the multiple of
// the step that is nearest to `value` [si]; exactly the double of its short decimal text.
double sb_quantity_step(double value, const char *si, const char *shown, int power, double count);

// Returns a value of parameter `id` [SI] as text of a file: with its unit, or the name of a choice,
// the names of flags with ';', or an integer.
char *sb_param_format(SbParamId id, double value);

// Reads text of a file as a value of parameter `id` to *out [SI; index of a choice; bits of flags]
// and checks kind, unit and range; a modulus of rubber can be a hardness (app/base/hardness.h).
// Returns false with SB_APP_ERROR_RANGE (outside the range) or SB_APP_ERROR_INPUT, whose sentence
// does not contain the key or the range; *out is then not changed.
SB_CHECKED bool sb_param_parse(double *out, SbParamId id, const char *text, GError **error);

// Returns the allowed range of a parameter: "0.2 to 20 mm", "thesis, reynolds".
char *sb_param_range(SbParamId id);

// Writes the ends of the range of a number: "0.2", "20 mm". Each is freed by g_free().
void sb_param_range_ends(SbParamId id, char *end[2]);
