// Values of a study's lines that hang on others: "floor + 2 * space", "gland.radial_space / 2",
// "seal.section_diameter + 0.02 mm".
//
// + - * / with their usual precedence, parentheses and functions over names and numbers. A number
// with a unit is a quantity of the dimension that the whole has; the others have none. Functions,
// whose arguments semicolons part:
//   min(A; B) max(A; B) pow(A; B) sin cos tan asin atan exp ln round(A), single(A): A in single
//   precision; and closed forms of the engine:
//   column(pressure; height; modulus; poisson) half_space(x; half-width; radius)
//   panel(distance; width) flamant(x; load; datum; modulus; poisson)
//   disc(load; half-width; radius; modulus; poisson)           engine/contact/deflection.h
//   full_sommerfeld(t; reach) half_sommerfeld(t; reach) reynolds(t; reach), each also _load(reach),
//   reynolds_end(reach)                                        engine/film/wedge.h
//   viscous_border(g_E) elastic_border(g_V)                    engine/film/laws.h
#pragma once

#include <glib.h>
#include <stdbool.h>

// The value of a name [SI]; false: there is none.
typedef bool (*SbExpressionName)(double *out, const char *name, void *data);

// False with SB_APP_ERROR_INPUT and a sentence that names the place.
bool sb_expression_value(double *out, const char *text, const char *si, const char *shown,
                         SbExpressionName name, void *data, GError **error);
