// Curves in character cells, as Braille characters of 2 x 4 dots a cell, with axes on the left and
// below.
//
// Usage: sb_plot_init() or sb_plot_axes(), any number of curves, sb_plot_finish(), and then points
// and labels in the cells. A cell has one colour: that of its curve with the highest rank.
#pragma once

#include "app/draw/axis.h"
#include "app/terminal/cells.h"

// A plot in progress. Its members are for plot.c; `x`, `y` and `rect` may be read.
typedef struct {
  SbCells *cells;    // borrowed
  SbCellRect rect;   // of the dots
  SbScale x, y;      // values to dots, from the left and from the top
  uint8_t *dots;     // [rect.height][rect.width]: bits of the Braille character
  uint32_t *ink;     // [height][width]: colour of the curve with the highest rank
  uint8_t *rank;     // [height][width]: its rank
  uint8_t *boldness; // [height][width]: its style
} SbPlot;

// How a curve is drawn.
typedef struct {
  uint32_t ink;  // colour, 0xRRGGBB or SB_CELL_OWN
  uint8_t rank;  // of curves that share a cell, the highest one colours it (the later of equals)
  uint8_t style; // SB_CELL_BOLD or 0
  int on, off;   // dash: dots drawn and dots omitted; off 0: solid
} SbPlotLine;

// Begins a plot whose dots fill `rect` of `cells`. Of the scales only the range (lo, hi) and
// `logarithmic` are used; ranges that are empty or not finite are repaired (sb_axis_repair()).
// Freed by sb_plot_finish().
void sb_plot_init(SbPlot *plot, SbCells *cells, SbCellRect rect, const SbScale *x,
                  const SbScale *y);

// As sb_plot_init(), with the numbers of the axes, in the colour `ink`, in the left columns and the
// bottom row of `rect`; the dots fill the rest of it.
void sb_plot_axes(SbPlot *plot, SbCells *cells, SbCellRect rect, const SbScale *x, const SbScale *y,
                  uint32_t ink);

// Draws a polyline through x[count], y[count], in the units of the scales. A value that is not
// finite, or not positive on a logarithmic axis, interrupts it. Points outside are clipped.
void sb_plot_curve(SbPlot *plot, const double *x, const double *y, size_t count,
                   const SbPlotLine *line);

// Writes the cell of the point (x, y), in the units of the scales, to *column and *row, in the
// coordinates of the grid. Returns false if the point is not in the plot.
bool sb_plot_cell(const SbPlot *plot, double x, double y, int *column, int *row);

// Writes the dots to the cells and frees the memory of the plot; sb_plot_cell() still works.
void sb_plot_finish(SbPlot *plot);

// Writes a label next to the cell (column, row), inside of the rectangle `within`, where it hides
// the fewest dots and texts. Writes nothing if it would hide too much. Call it after
// sb_plot_finish().
void sb_plot_label(SbCells *cells, SbCellRect within, int column, int row, const char *text,
                   SbPen pen);
