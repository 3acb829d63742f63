// Legends: a piece of a line and the name of the curve. Pixels of the picture.
#pragma once

#include "app/draw/canvas.h"

// Draws a piece of the line `stroke` and, in its colour, a name that ends at x = `right` with its
// baseline at y and is cut in the middle to fit into `room` px, the line included. Returns the
// width of line and name together [px].
double sb_legend_line(SbCanvas *c, double right, double y, double room, SbStroke stroke,
                      const char *name);

// Draws the legend of predicted curves that ends at x = `right`, with its text's baseline at `y`.
// Returns its width [px].
double sb_legend_predicted(SbCanvas *c, double right, double y);
