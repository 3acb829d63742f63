// What a study holds of its scene while it varies the rest.
#pragma once

#include "engine/valve/model/valve.h"

// enumerator, name, what is held
#define SB_HOLDS(X)                                                                                \
  X(SB_HOLD_MACHINE, "machine",                                                                    \
    "the cycle of the test machine, quasi-static, whatever drives the scene")                      \
  X(SB_HOLD_OUTER, "outer-seal",                                                                   \
    "the outer ring as storage and temperature left it, from then on without any; the inner one "  \
    "like it, so that no gland suits but one of them; the chamber filled")                         \
  X(SB_HOLD_SATURATED, "saturated",                                                                \
    "pressure, viscosity and density those of the liquid by its name, whatever the scene gives")

typedef enum {
#define SB_HOLD_ENUM(code, name, help) code,
  SB_HOLDS(SB_HOLD_ENUM)
#undef SB_HOLD_ENUM
      SB_HOLD_COUNT
} SbHold;

// All names, for messages; borrowed.
const char *sb_hold_names(void);

SB_CHECKED bool sb_hold_from_name(SbHold *out, const char *name);

// The scene with that held; owned by the caller. As sb_model_derive() otherwise.
SbStatus sb_model_hold(SbModel **out, const SbModel *scene, SbHold hold, SbReport *report);
