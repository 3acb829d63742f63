// Draws display lists with cairo: as vectors for SVG and PDF, and as pixels where OpenGL is not
// available.
#pragma once

#include "app/section/draw_list.h"
#include "app/section/text.h"

#include <cairo.h>

// Draws the list at the origin and scale of `cr`, one logical pixel per user unit. `text` lays out
// its texts. On a vector surface, meshes become triangles with their mean colour each.
void sb_draw_list_to_cairo(const SbDrawList *list, SbText *text, cairo_t *cr);
