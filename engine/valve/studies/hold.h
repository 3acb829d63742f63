// Conditions that a study keeps constant while it varies other quantities.
#pragma once

#include "engine/valve/model/valve.h"

// X(enumerator, name in study files, text for people): all conditions.
//   machine     quasi-static cycle of the test machine; ports become a vented chamber
//   outer-seal  both seals have the scene's outer ring as it is after storage at the temperature of
//               use (sizes, modulus), without further storage or expansion; the chamber is filled;
//               not for gaskets
//   saturated   canister pressure, viscosity and density follow from fluid.name
#define SB_HOLDS(X)                                                                                \
  X(SB_HOLD_MACHINE, "machine",                                                                    \
    "the quasi-static cycle of the test machine, in place of the scene's drive")                   \
  X(SB_HOLD_OUTER, "outer-seal",                                                                   \
    "the outer ring as storage and temperature left it, from then on without any; the inner one "  \
    "like it, so that no gland suits but one of them; the chamber filled")                         \
  X(SB_HOLD_SATURATED, "saturated",                                                                \
    "pressure, viscosity and density of the named liquid, in place of the scene's values")

// A condition.
typedef enum {
#define SB_HOLD_ENUM(code, name, help) code,
  SB_HOLDS(SB_HOLD_ENUM)
#undef SB_HOLD_ENUM
      SB_HOLD_COUNT
} SbHold;

// Returns all names separated by ", ", for messages; static.
const char *sb_hold_names(void);

// Finds a condition by its name. Returns false, and leaves *out, if there is none.
SB_CHECKED bool sb_hold_from_name(SbHold *out, const char *name);

// Creates the model of `scene` under the condition `hold`; free it with sb_model_destroy().
// SB_ERROR_INPUT with the input valve.kind: SB_HOLD_OUTER of a gasket valve. SB_ERROR_RANGE,
// SB_ERROR_INPUT: the scene's values are inconsistent under the condition; the report has the
// input.
SbStatus sb_model_hold(SbModel **out, const SbModel *scene, SbHold hold, SbReport *report);
