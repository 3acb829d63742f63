// A drive that goes to a place or force once and stays there.
#pragma once

#include "engine/mechanism/drive.h"

#include <math.h>

static inline SbDrive ramp(double start, double end, double rate) {
  return (SbDrive){.kind = SB_DRIVE_PRESS,
                   .start = start,
                   .end = end,
                   .rise = fabs(end - start) / rate,
                   .hold = INFINITY,
                   .fall = 1.0,
                   .cycles = 1};
}
