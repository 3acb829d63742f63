// Numbers of the inputs of the mechanics: drive, contacts, chamber, for SbReport.input and
// SbWarning.input.
#pragma once

#include "engine/base/status.h"

// PRESSURE: SbChamberModel.canister; STATIC_RATIO: SbDynamicsContact.static_ratio; DRIVE: spring
// and damper of the drive.
enum {
  SB_MECHANISM_IN_PRESSURE = SB_MECHANISM_INPUTS,
  SB_MECHANISM_IN_STATIC_RATIO,
  SB_MECHANISM_IN_DRIVE,
  SB_MECHANISM_IN_END
};
