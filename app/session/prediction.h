// What the loop will be at other values, to first order: from a solved run, the base, and
// neighbours that differ from it in one real parameter each.
//
//   s(p) = s_0 + sum_i (p_i - p_i0) (s_i - s_0)/(p_i1 - p_i0),   s: displacement and force of an
//   instant
//
// Instants of two runs correspond where they lie at the same share of the time from one event to
// the next. Foretold is nothing where a changed value has no neighbour, where it lies further from
// the base than both its neighbour and a tenth of itself, or where events come or go.
#pragma once

#include "app/session/displayed_run.h"

typedef struct SbPrediction SbPrediction;

SbPrediction *sb_prediction_new(void);
void sb_prediction_free(SbPrediction *prediction); // takes NULL

// Gives it another base, NULL: none. Neighbours of the one before are forgotten; that one itself
// becomes a neighbour where it is one.
void sb_prediction_set_base(SbPrediction *prediction, SbDisplayedRun *base);

// Takes a complete run as a neighbour if it is one; the latest of a parameter counts.
void sb_prediction_take(SbPrediction *prediction, SbDisplayedRun *run);

// Whether a parameter has a neighbour.
bool sb_prediction_knows(const SbPrediction *prediction, SbParamId id);

// Predicts the loop at `params`; false where it cannot, or where there is nothing to predict.
bool sb_prediction_make(SbPrediction *prediction, const SbParams *params);

// What was made last; borrowed until the next call, empty if nothing was.
const SbChartCurve *sb_prediction_curve(const SbPrediction *prediction);

// The one real parameter in which two sets of values differ; -1 if there is none, another kind, or
// more than one.
int sb_prediction_difference(const SbParams *a, const SbParams *b);
