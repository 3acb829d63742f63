// A calibration as JSON and as a table.
#pragma once

#include "app/chart/calibration.h"
#include "app/study/calibrate.h"

#include <stdio.h>

// Owned by the caller.
char *sb_calibration_json(const SbCalibration *calibration, const SbStudyFile *study);

// The samples, a row each: "key [SI unit]" in the header. Owned by the caller.
char *sb_calibration_csv(const SbCalibration *calibration);

// Draws the page of a calibration into `rect`.
void sb_calibration_page_draw(cairo_t *cr, SbRect rect, const SbCalibration *calibration,
                              const SbStudyFile *study, bool dark);

// The same into a stream, as `ending` says (still.h).
bool sb_calibration_put(FILE *stream, const SbCalibration *calibration, const SbStudyFile *study,
                        const char *ending, GError **error);
