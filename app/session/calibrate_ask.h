// The request for a calibration: which parameters of a document are fitted to its measured loop;
// and the study file that `sealbench calibrate` would need for the same request.
#pragma once

#include "app/study/calibrate.h"

// Number of parameters that can be fitted.
enum { SB_CALIBRATE_CHOICES = 7 };

// The request. It owns no memory; the caller may change it.
typedef struct {
  bool fitted[SB_CALIBRATE_CHOICES]; // the parameter sb_calibrate_choice() of this index is fitted
} SbCalibrateAsk;

// Returns the parameter of choice `index`, from 0.
SbParamId sb_calibrate_choice(int index);

// Sets the initial request: load coefficient, static ratio, land edge and pressure diameter.
void sb_calibrate_ask_init(SbCalibrateAsk *ask);

// Returns the measured data of a document to which its parameters are fitted: its first group
// [data]. NULL: it has none.
const SbData *sb_calibrate_data(const SbDocument *document);

// Returns the study file of the request with a copy of the document as its scene. The document must
// have sb_calibrate_data(). The priors are normal about the document's values: wide for what the
// thesis leaves open. `issues` must be empty. Returns NULL with at least one issue: the document
// does not compile, or the request is not a valid study (nothing is fitted, the data cannot be
// read). Freed by sb_study_file_free().
SbStudyFile *sb_calibrate_ask_study(const SbCalibrateAsk *ask, const SbDocument *document,
                                    GPtrArray *issues);

// Writes the estimates that a document can use to values[found->parameters] and returns their
// number: those that the data identify, alone or with another one, or without a posterior all
// values so far; not those of a single curve.
size_t sb_calibration_estimates(SbOverride *values, const SbCalibration *found);
