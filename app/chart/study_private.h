// Shared by study.c (panels) and study_names.c (names of the curves).
#pragma once

#include "app/chart/study.h"
#include "app/draw/axis.h"
#include "app/draw/label.h"

// A panel while it is drawn.
typedef struct {
  SbCanvas *canvas;          // drawn to, borrowed
  const SbStudy *study;      // borrowed
  const SbStudyPanel *panel; // a panel of `study`
  SbLabels *labels;          // rectangles that labels must not cover, borrowed
  SbAxes at;                 // plot and axes, in display units
  double x_unit, x_zero;     // abscissa in its display unit: x_unit x + x_zero, for x in SI
  double y_unit;             // ordinate in its display unit: y_unit y, for y in SI
  bool empty;                // the panel has no value
} SbStudyPlot;

// Returns the stroke of a curve.
SbStroke sb_study_series_look(const SbStudy *study, const SbStudySeries *series);

// Returns whether a point [px] is finite and within the height of the plot.
bool sb_study_inside(const SbStudyPlot *plot, SbPoint p);

// Writes the names of the panel's curves, in the gutter on the right of the plot, `gutter` px wide,
// or, if it is 0, in the plot. points[s][i] is the pixel of point i of curve s. Returns the number
// of curves that are visible.
int sb_study_name_series(SbStudyPlot *plot, SbPoint **points, double gutter);
