// Numbers of the inputs of the mechanics: drive, contacts, chamber, for SbReport.input and
// SbWarning.input.
#pragma once

#include "engine/base/status.h"

enum {
  SB_MECHANISM_IN_PRESSURE = SB_MECHANISM_INPUTS,
  SB_MECHANISM_IN_STATIC_RATIO,
  SB_MECHANISM_IN_DRIVE,
  SB_MECHANISM_IN_END
};
