// A calibration as JSON and as a table.
#pragma once

#include "app/study/calibrate.h"

// Owned by the caller.
char *sb_calibration_json(const SbCalibration *calibration, const SbStudyFile *study);

// The samples, a row each: "key [SI unit]" in the header. Owned by the caller.
char *sb_calibration_csv(const SbCalibration *calibration);
