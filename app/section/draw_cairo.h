// The display list on a cairo context: the vector path for SVG and PDF, and a picture where no GL
// is to be had.
#pragma once

#include "app/section/draw_list.h"
#include "app/section/text.h"

#include <cairo.h>

// Draws the list at the context's current origin and scale, one logical pixel per user unit.
// Meshes become flat triangles of their mean colour on a vector surface.
void sb_draw_list_to_cairo(const SbDrawList *list, SbText *text, cairo_t *cr);
