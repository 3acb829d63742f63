// What loop, contacts and figures will be at other values, to first order, from a solved run, the
// base, and its slopes by the parameters that differ (tangent.h):
//
//   s(p) = s_0 + sum_i (p_i - p_i0) ds/dp_i
//
// Figures have the derivatives of `sealbench sensitivity` (gradient.h), with their acceptance test.
// Microseconds for each parameter; nothing is solved. Not predicted is anything where a changed
// value has no slopes (it is no real number, or they are not there yet), or lies further from the
// base than a tenth of itself; a figure without an accepted slope is NaN with the reason. What
// follows from the sizes alone is computed at the new values, and so is the verdict, from the
// predicted figures. Blind to what happens between: slips, nodes of the contact and events that
// come and go.
#pragma once

#include "app/session/tangent.h"

typedef struct SbPrediction SbPrediction;

SbPrediction *sb_prediction_new(void);
void sb_prediction_free(SbPrediction *prediction); // takes NULL

// Predicts the run of `params`, whose model is `model`, from a base that stays as long as the
// prediction is shown; false where it cannot, or where there is nothing to predict.
bool sb_prediction_make(SbPrediction *prediction, const SbDisplayedRun *base,
                        const SbParams *params, const SbModel *model);

// Whether a real parameter of two sets of values differs by itself; one that only follows its
// parent does not.
bool sb_prediction_differs(const SbParams *a, const SbParams *b, int id);

// Turns the frame that it shows, with its contacts, to that of a frame of the base.
void sb_prediction_show(SbPrediction *prediction, size_t frame);

// What was made last; borrowed, its contents until the next call. Only after it was made.
const SbChartPredicted *sb_prediction_chart(const SbPrediction *prediction);
