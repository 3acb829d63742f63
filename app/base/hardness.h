// Young's modulus of rubber from its hardness, for values such as "60 Shore A" and "60 IRHD".
//
//   Shore A (20 to 80):  E = 0.0981 (56 + 7.62336 S) / (0.137505 (254 - 2.54 S)) MPa
//                        A.N. Gent, Rubber Chem. Technol. 31 (1958) 896
//   IRHD    (30 to 85):  E = 10^(0.364 + 0.7 z) MPa, z the quantile of the normal distribution at
//                        IRHD/100: the curve that defines the scale (ISO 48, method N), a normal
//                        distribution over log10 E with its middle at 2.31 MPa and a largest slope
//                        of 57 IRHD per decade
//
// Both hold at small strain for elastic rubber. A reading scatters by about 3 points, which is 12 %
// of E at 60; filled rubbers differ from the relations by up to about 20 %.
#pragma once

#include "app/base/issue.h"
#include "engine/valve/model/params.h"

#include <glib.h>
#include <stdbool.h>

// Returns whether parameter `id` is a modulus of a seal's rubber, which can be given as a hardness.
bool sb_hardness_applies(SbParamId id);

// Reads "60 Shore A" and writes Young's modulus [Pa]. Returns false without setting *error if the
// text has no unit of hardness; false with SB_APP_ERROR_INPUT if the hardness is out of range.
bool sb_hardness_parse(double *modulus, const char *text, GError **error);

// Reads "2 Shore A" as a small difference and writes the difference of Young's modulus [Pa] by the
// slope of the relation at the modulus `at` [Pa]. Returns false without setting *error if the text
// has no unit of hardness; false with SB_APP_ERROR_INPUT if the relation does not hold at `at`.
bool sb_hardness_difference(double *out, double at, const char *text, GError **error);

// Appends a note to `notes` (of SbIssue) with the modulus of such a text, the relation and its
// scatter. Does nothing for any other text, or if `id` is not such a modulus. `shown`, `line` and
// `key` are the file, line and key of the value (app/base/issue.h).
void sb_hardness_note(GPtrArray *notes, const char *shown, int line, const char *key, SbParamId id,
                      const char *text);
