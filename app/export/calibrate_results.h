// The results of a calibration as JSON, as a table of samples, and as a page.
#pragma once

#include "app/chart/calibration.h"
#include "app/study/calibrate.h"
#include "app/table/table.h"

#include <stdio.h>

// Returns the JSON document of `sealbench calibrate`. `study` is the file that `calibration` was
// made from.
char *sb_calibration_json(const SbCalibration *calibration, const SbStudyFile *study);

// Returns the parameters with their values before and after the fit, intervals and whether the data
// identify them, for people. Freed by sb_table_free().
SbTable *sb_calibration_table(const SbCalibration *calibration);

// Returns what the fit left, for people, in lines: differences of each curve, chi square, warnings
// of validity, and what the data do and do not identify. Freed by g_free().
char *sb_calibration_notes(const SbCalibration *calibration);

// Writes the samples of the posterior as comma-separated values: `sample` (number from 0), then a
// column "key [SI unit]" for each parameter. The heading alone if nothing was sampled. Errors of
// writing are left in the stream (ferror()).
void sb_calibration_csv(FILE *stream, const SbCalibration *calibration);

// Draws the page of a calibration into `rect` [pixels]; made for SB_CALIBRATION_WIDTH by
// SB_CALIBRATION_HEIGHT (app/chart/calibration.h). `dark`: theme. Texts are in the language of the
// calling thread.
void sb_calibration_page_draw(cairo_t *cr, SbRect rect, const SbCalibration *calibration,
                              const SbStudyFile *study, bool dark);

// Writes the page in the light theme into `stream` in the format of `ending` (".png", ".svg",
// ".pdf"). Returns false with SB_APP_ERROR_INPUT for another ending, SB_APP_ERROR_IO if it could
// not be drawn; errors of writing are left in the stream (ferror()).
bool sb_calibration_put(FILE *stream, const SbCalibration *calibration, const SbStudyFile *study,
                        const char *ending, GError **error);
