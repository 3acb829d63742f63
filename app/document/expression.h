// Values of a study's lines that hang on others: "floor + 2 * space", "gland.radial_space / 2",
// "seal.section_diameter + 0.02 mm".
//
// + - * / with their usual precedence, parentheses, min(A; B), max(A; B), pow(A; B), and
// sin, cos, tan, atan, exp and ln of (A), over names and numbers. A number with a unit is a
// quantity of the dimension that the whole has; the others have none.
#pragma once

#include <glib.h>
#include <stdbool.h>

// The value of a name [SI]; false: there is none.
typedef bool (*SbExpressionName)(double *out, const char *name, void *data);

// False with SB_APP_ERROR_INPUT and a sentence that names the place.
bool sb_expression_value(double *out, const char *text, const char *si, const char *shown,
                         SbExpressionName name, void *data, GError **error);
