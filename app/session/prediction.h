// Prediction of loop, contacts and figures at other values, to first order, from a converged run
// (the base) and its derivatives by the parameters that differ (tangent.h):
//
//   s(p) = s_0 + sum_i (p_i - p_i0) ds/dp_i
//
// Figures use the derivatives of `sealbench sensitivity` (gradient.h) with their acceptance test.
// A prediction takes microseconds for each parameter; nothing is solved. There is no prediction if
// a changed value has no derivatives (it is not a real number, or they are not computed yet), or
// differs from the base by more than a tenth. A figure without an accepted derivative is NaN, with
// the reason. What follows from the sizes alone is computed at the new values; the verdict is
// computed from the predicted figures. Events, slips and contact nodes that appear or disappear
// between the base and the new values are not predicted.
#pragma once

#include "app/session/tangent.h"

typedef struct SbPrediction SbPrediction;

// Returns an empty prediction. Freed by sb_prediction_free().
SbPrediction *sb_prediction_new(void);

// Frees a prediction.
void sb_prediction_free(SbPrediction *prediction);

// Predicts the run of the values `params`, whose model is `model`, from `base`, a complete run.
// `base` and `model` are borrowed as long as the prediction is used. Returns false if it cannot be
// predicted, or if the values do not differ; the earlier prediction is then lost.
bool sb_prediction_make(SbPrediction *prediction, const SbDisplayedRun *base,
                        const SbParams *params, const SbModel *model);

// Returns whether parameter `id` differs between two sets of values; false if it has a value of its
// own in neither (seal.outer.modulus that follows seal.modulus).
bool sb_prediction_differs(const SbParams *a, const SbParams *b, int id);

// Predicts the frame and the contacts at index `frame` of the base for sb_prediction_chart(); a
// larger index is its last frame. sb_prediction_make() does so for frame 0. Only after it returned
// true.
void sb_prediction_show(SbPrediction *prediction, size_t frame);

// Returns the prediction for charts. Borrowed; its content changes with the next call of
// sb_prediction_make() or sb_prediction_show(). Only after sb_prediction_make() returned true.
const SbChartPredicted *sb_prediction_chart(const SbPrediction *prediction);
