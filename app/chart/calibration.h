// The page of a calibration: measured loops with the model before and after the fit, residuals, the
// fitted parameters, what the data identify, and the posterior in pairs of parameters.
#pragma once

#include "app/data/compare.h"
#include "app/draw/canvas.h"

#include "engine/numeric/sampling.h"

// A fitted parameter. Values are [SI].
typedef struct {
  const char *name, *symbol;    // key; symbol, may be empty
  const char *texts[3];         // before, estimate and interval as text; the first has the unit
  double before, estimate;      // value of the scene; fitted value
  double low, high;             // 95 % interval of the posterior
  double prior_low, prior_high; // 95 % interval of the prior
  const SbDistribution *prior;
  const char *identifiable; // "yes", "only with m", "no, as before"
  SbRole role;              // colour of `identifiable`
} SbCalibrationRow;

// A curve.
typedef struct {
  const char *name;
  const SbLoop *before, *after; // of the model with the scene's and the fitted values; empty: none
  const SbMeasuredBand *prior, *posterior; // contain 95 % of the model's loops; end 0: none
  const SbComparison *comparison; // with the fitted model; NULL: the fitted stem does not slide
  double before_rms; // root mean square difference before the fit [N]; NaN: the stem does not slide
} SbCalibrationLoop;

// The page; everything is borrowed. Texts: title and subtitle of the header (each may be NULL),
// what the data identify, and the line at the foot.
typedef struct {
  const char *title, *subtitle, *sentence, *foot;
  bool all_identifiable; // all parameters are identifiable: `sentence` is good news
  size_t rows, loops, samples;
  const SbCalibrationRow *row;   // [rows]
  const SbCalibrationLoop *loop; // [loops]
  // Of the posterior; not read if `samples` is below 10, may then be NULL.
  const double *sample;      // [samples][rows] [SI]
  const double *correlation; // [rows][rows]
} SbCalibrationView;

// Size for which the page is designed [px].
#define SB_CALIBRATION_WIDTH  1600.0
#define SB_CALIBRATION_HEIGHT 960.0

// Draws the page with its background into `rect` [px].
void sb_calibration_draw(cairo_t *cr, SbRect rect, const SbTheme *theme,
                         const SbCalibrationView *view);
