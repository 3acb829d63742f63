// The chart that is being drawn, shared by hysteresis.c (curves), hysteresis_labels.c (labels) and
// hysteresis_measured.c.
#pragma once

#include "app/chart/hysteresis.h"
#include "app/draw/label.h"

// The chart; sb_hysteresis_draw() fills it before it calls the functions below.
typedef struct {
  SbCanvas canvas;
  SbAxes at;
  SbLabels *labels;        // occupied by the labels so far
  const SbChartData *data; // borrowed
  unsigned flags;          // SB_CHART_PANEL, ...
} SbHysteresisView;

// Returns the pixel of a displacement [m] and a force [N].
SbPoint sb_hysteresis_pixel(const SbAxes *at, double displacement, double force);

// Draws dots and letters of the stages that were reached. Requires a trace.
void sb_hysteresis_marks(SbHysteresisView *v);

// Draws the playhead: its dashed line down to the axis (`line`), or its dot. This function and the
// next one require a frame (sb_chart_frame()).
void sb_hysteresis_now(SbHysteresisView *v, bool line);

// Draws the label of the playhead.
void sb_hysteresis_label_now(SbHysteresisView *v);

// Draws the labels of the lines: stop, pressure force, loss, minimum return, directions, pinned
// run. Requires a trace.
void sb_hysteresis_notes(SbHysteresisView *v);

// Height of the strip below the plot for measured residuals, normal and SB_CHART_COMPACT [px].
#define SB_HYSTERESIS_STRIP         136.0
#define SB_HYSTERESIS_STRIP_COMPACT 104.0

// Extends the range of the plot, which the caller has set, to the measured points: *x1 is the
// largest displacement [mm], *y0 and *y1 are the smallest and the largest force [N].
void sb_hysteresis_measured_range(const SbComparison *measured, double *x1, double *y0, double *y1);

// Draws measured points and their band into the plot, and the strip of residuals below it. `in` is
// the inside of the panel [px], which has the legend at its top right. data->measured is not NULL.
void sb_hysteresis_measured(SbHysteresisView *v, SbRect in);
