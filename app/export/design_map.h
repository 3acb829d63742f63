// A design question drawn: the map of two parameters with lines of figures and what breaks limits
// hatched, the figure's change with each tolerance, and the scatter of valves against limits.
#pragma once

#include "app/base/canvas.h"
#include "app/session/design_answer.h"

// Figures whose lines have a look of their own.
enum { SB_DESIGN_LINES = 4 };

typedef struct {
  unsigned lines; // bit i: lines of figure i
  bool picked;    // a point is picked
  double pick[2]; // SI
} SbDesignLook;

// The plot inside the rectangle that the map is drawn into.
SbRect sb_design_map_plot(SbRect rect);
void sb_design_map_draw(cairo_t *cr, SbRect rect, const SbTheme *theme,
                        const SbDesignAnswer *answer, const SbDesignLook *look);

// How figure `figure` changes with each parameter's tolerance about a place's value.
void sb_design_tornado_draw(cairo_t *cr, SbRect rect, const SbTheme *theme,
                            const SbDesignAnswer *answer, int figure);
// The samples of figures with a limit, as many side by side as there is room for.
void sb_design_scatter_draw(cairo_t *cr, SbRect rect, const SbTheme *theme,
                            const SbDesignAnswer *answer);

// "24.8 N" of a figure of the catalogue. Owned by the caller.
char *sb_design_value_text(int figure, double value);
// All of it in words, for who does not see it. Owned by the caller.
char *sb_design_text(const SbDesignAnswer *answer);
