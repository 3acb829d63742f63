// The page of a calibration: measured loops with the model before and after, what is left of them,
// the fitted parameters, what the data cannot tell, the posterior in pairs.
#pragma once

#include "app/base/canvas.h"
#include "app/data/compare.h"

#include "engine/numeric/sampling.h"

typedef struct {
  const char *name, *symbol; // key; may be empty
  const char *texts[3];      // before, estimate, interval, with the unit in the first
  double before, estimate, low, high, prior_low, prior_high; // SI
  const SbDistribution *prior;
  const char *told; // "yes", "only with m", "no, as before"
  SbRole role;      // colour of that
} SbCalibrationRow;

typedef struct {
  const char *name;
  const SbLoop *before, *after;
  const SbMeasuredBand *prior, *posterior; // 95 % of the model's loops; end 0: not known
  const SbComparison *comparison;          // NULL: the fitted stem does not slide
  double before_rms;
} SbCalibrationLoop;

// Everything is borrowed.
typedef struct {
  const char *title, *subtitle, *sentence, *foot;
  bool all_told; // the sentence says nothing that is missing
  size_t rows, loops, samples;
  const SbCalibrationRow *row;
  const SbCalibrationLoop *loop;
  const double *sample;      // [samples][rows], SI
  const double *correlation; // [rows][rows]
} SbCalibrationView;

// Size that it is made for.
#define SB_CALIBRATION_WIDTH  1600.0
#define SB_CALIBRATION_HEIGHT 960.0

// Draws the page into `rect`, its ground included.
void sb_calibration_draw(cairo_t *cr, SbRect rect, const SbTheme *theme,
                         const SbCalibrationView *view);
