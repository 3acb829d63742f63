// Limits on figures, as a scene's [limits] gives them, and the six questions that they decide.
#pragma once

#include <stddef.h>

typedef enum {
  SB_VERDICT_SEALS,   // no seal open, its peak above the fluid's pressure
  SB_VERDICT_PRESSES, // forces within limits
  SB_VERDICT_RETURNS, // the stem comes back by itself, and with the force asked for
  SB_VERDICT_DOSES,
  SB_VERDICT_LEAK,
  SB_VERDICT_FITS,
  SB_VERDICT_COUNT,
  SB_VERDICT_NONE = SB_VERDICT_COUNT // decides nothing: no limit may be set
} SbVerdictKind;

enum { SB_LIMITS_MAX = 64 };

typedef struct {
  int figure;       // index, engine/valve/figures.h
  double low, high; // SI; -INFINITY, INFINITY: open
} SbLimit;

typedef struct {
  size_t count;
  SbLimit item[SB_LIMITS_MAX];
} SbLimits;
