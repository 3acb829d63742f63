// Curves and points in character cells: Braille, eight dots a cell, under an axis and over one.
//
// A cell has one colour: that of its most important curve. Text stays clear of the dots where it
// can.
#pragma once

#include "app/chart/axis.h"
#include "app/terminal/cells.h"

typedef struct {
  SbCells *cells;
  SbCellRect rect;   // of the dots
  SbScale x, y;      // to dots from the left and from the top
  uint8_t *dots;     // [height][width], as Braille counts them
  uint32_t *ink;     // of the most important curve there
  uint8_t *rank;     // its rank
  uint8_t *boldness; // whether its dots are bold
} SbPlot;

// How a curve is drawn.
typedef struct {
  uint32_t ink;
  uint8_t rank;  // the higher one colours a cell
  uint8_t style; // SB_CELL_BOLD
  int on, off;   // dots drawn and left out, 0: solid
} SbPlotLine;

// Plots into `rect` of cells; the ranges may be of any kind (sb_axis_repair()).
void sb_plot_init(SbPlot *plot, SbCells *cells, SbCellRect rect, const SbScale *x,
                  const SbScale *y);

// The same with axes: numbers on the left and below, in `rect`, with the dots in what is left.
void sb_plot_axes(SbPlot *plot, SbCells *cells, SbCellRect rect, const SbScale *x, const SbScale *y,
                  uint32_t ink);

// A polyline; what is not finite breaks it. In the units of the scales.
void sb_plot_curve(SbPlot *plot, const double *x, const double *y, size_t count,
                   const SbPlotLine *line);

// The cell of a point; false where it is not in the plot.
bool sb_plot_cell(const SbPlot *plot, double x, double y, int *column, int *row);

// Puts the dots into the cells and frees the plot's memory. Text and points come behind it.
void sb_plot_finish(SbPlot *plot);

// A text beside a point, where it hides least: right or left of it, above or below. `away` keeps it
// at least as many columns off. Nothing where there is no room.
void sb_plot_label(SbCells *cells, SbCellRect within, int column, int row, const char *text,
                   SbPen pen);
