// Expressions in a study file's values: "floor + 2 * space", "gland.radial_space / 2",
// "seal.section_diameter + 0.02 mm".
//
// + - * / with their usual precedence, parentheses and functions, over names and numbers. A number
// with a unit must have the dimension of the result; a number without a unit has no dimension.
// Semicolons separate the arguments of functions:
//   min(A; B) max(A; B) pow(A; B) sin cos tan asin atan (angles in rad) exp ln round(A),
//   single(A): A rounded to single precision; and closed forms of the engine:
//   column(pressure; height; modulus; poisson) half_space(x; half-width; radius)
//   panel(distance; width) flamant(x; load; datum; modulus; poisson)
//   disc(load; half-width; radius; modulus; poisson)           engine/contact/deflection.h
//   full_sommerfeld(t; reach) half_sommerfeld(t; reach) reynolds(t; reach), each also _load(reach),
//   reynolds_end(reach)                                        engine/film/wedge.h
//   viscous_border(g_E) elastic_border(g_V)                    engine/film/laws.h
#pragma once

#include <glib.h>
#include <stdbool.h>

// Writes the value of a name [SI] to *out. Returns false if there is no such name.
typedef bool (*SbExpressionName)(double *out, const char *name, void *data);

// Computes the expression `text` whose result has the SI unit `si` ("m", "1"); `shown` is the usual
// unit, for messages. `name` is called with `data` for each name and writes its value. Returns
// false with SB_APP_ERROR_INPUT, or SB_APP_ERROR_RANGE if the result is not finite (a division by
// 0), and a sentence that names the place; *out is then not changed.
bool sb_expression_value(double *out, const char *text, const char *si, const char *shown,
                         SbExpressionName name, void *data, GError **error);
