// A made-up run with the thesis cycle's shape, for tests of pictures: not computed, but complete,
// deterministic and the same for every version of the engine.
#pragma once

#include "app/chart/data.h"

typedef struct {
  SbModel *model;
  SbSummary summary;
  SbFrame *frames;
  size_t count;
  SbTrace *trace;
  double x[2][201], pressure[2][201], film[2][201];
  SbContactProfile profile[2];
} Synthetic;

// `scale` multiplies friction; `frames` is approximate.
void synthetic_init(Synthetic *out, size_t frames, double scale);
void synthetic_clear(Synthetic *run);

// A finished view of it, playhead at `time` [s].
void synthetic_data(SbChartData *out, const Synthetic *run, double time);
