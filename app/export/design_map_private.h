// Shared by design_map.c (axes, designs) and design_map_levels.c (levels of the figures).
#pragma once

#include "app/draw/axis.h"
#include "app/draw/label.h"
#include "app/export/design_map.h"

// A map while it is drawn.
typedef struct {
  SbCanvas *c;                  // drawn to, borrowed
  const SbDesignAnswer *answer; // results, borrowed
  const SbDesignMap *map;       // answer->map
  SbAxes at;                    // plot and axes, in display units of the two parameters
  SbLabels labels;              // rectangles that labels must not cover
} SbDesignMapView;

// Adds all parts of the map that are computed to the path of the canvas.
void sb_design_map_computed(const SbDesignMapView *v);

// Draws lines of constant value of a figure (index into the study's figures) with their values.
void sb_design_map_levels(SbDesignMapView *v, size_t figure);

// Draws the borders of all limits with their names (`borders`), or shades what is beyond them.
void sb_design_map_limits(SbDesignMapView *v, bool borders);
