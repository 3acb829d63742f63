// Drawings of the results of a search for a design: a map over two parameters with contour lines of
// figures and hatching where limits are violated, the effects of tolerances as bars, and samples of
// valves with the limits. Rectangles are in pixels of the drawing; texts are translated.
#pragma once

#include "app/draw/canvas.h"
#include "app/session/design_answer.h"

// Number of styles of contour lines; column i has style i % SB_DESIGN_LINES.
enum { SB_DESIGN_LINES = 4 };

// What the map shows.
typedef struct {
  unsigned lines; // bit i: contour lines of column i of answer->study->figures
  bool picked;    // mark a point
  double pick[2]; // if `picked`: that point, across and up [SI]
} SbDesignLook;

// Returns the plot area (the map without titles and axis texts) for the same `rect` as
// sb_design_map_draw().
SbRect sb_design_map_plot(SbRect rect);

// Draws the map, also while it is being computed.
void sb_design_map_draw(cairo_t *cr, SbRect rect, const SbTheme *theme,
                        const SbDesignAnswer *answer, const SbDesignLook *look);

// Draws how a figure (index of sb_figure()) changes with the tolerance of each parameter, at the
// best design if it is known, else at the present design. Without effects it writes why there are
// none.
void sb_design_tornado_draw(cairo_t *cr, SbRect rect, const SbTheme *theme,
                            const SbDesignAnswer *answer, int figure);

// Draws the samples of the figures that have a limit, those nearest to their limit on the left, as
// many as `rect` has room for.
void sb_design_scatter_draw(cairo_t *cr, SbRect rect, const SbTheme *theme,
                            const SbDesignAnswer *answer);

// Returns "24.8 N": a value [SI] of a figure (index of sb_figure()) with its relative error (NaN:
// not known) in its display unit.
char *sb_design_value_text(int figure, double value, double error);

// Returns the content of the drawings as text, for screen readers.
char *sb_design_text(const SbDesignAnswer *answer);
