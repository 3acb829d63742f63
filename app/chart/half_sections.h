// The bodies of a drawing next to each other on one axis: half-sections to scale with their names
// and the diameters of lands, bores and grooves.
#pragma once

#include "app/document/cad_parts.h"
#include "app/draw/geometry.h"
#include "app/draw/theme.h"

#include <cairo.h>

// Draws the bodies of `cad` into `rect` [px]. part[i] is the index of the body that is part i of
// the valve (sb_cad_parts(); -1: none); these bodies have the colours of the parts.
void sb_half_sections_draw(cairo_t *cr, SbRect rect, const SbTheme *theme, const SbCad *cad,
                           const int part[SB_CAD_PART_COUNT]);
