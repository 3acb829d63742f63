// What the two halves of the hysteresis chart share: curves (hysteresis.c), labels
// (hysteresis_labels.c).
#pragma once

#include "app/base/label.h"
#include "app/chart/hysteresis.h"

typedef struct {
  SbCanvas canvas;
  SbHysteresisLayout at;
  SbLabels *labels;
  const SbChartData *data;
  unsigned flags;
} SbHysteresisView;

// Pixel of a displacement [m] and a force [N].
SbPoint sb_hysteresis_pixel(const SbHysteresisLayout *at, double displacement, double force);

// Dots and letters of the stages reached.
void sb_hysteresis_marks(SbHysteresisView *v);

// *Now*: its dashed line down to the axis (`line`), or its dot.
void sb_hysteresis_now(SbHysteresisView *v, bool line);
void sb_hysteresis_label_now(SbHysteresisView *v);

// What the lines are: stop, pressure force, loss, least return, directions, pinned run.
void sb_hysteresis_notes(SbHysteresisView *v);

// What was measured: ranges to show; dots, band and the strip below the plot, whose height the
// layout leaves free [px].
#define SB_HYSTERESIS_STRIP         136.0
#define SB_HYSTERESIS_STRIP_COMPACT 104.0
void sb_hysteresis_measured_range(const SbComparison *measured, double *x1, double *y0, double *y1);
void sb_hysteresis_measured(SbHysteresisView *v, SbRect in);
