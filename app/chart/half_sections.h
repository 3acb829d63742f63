// The bodies of a drawing beside each other on one axis: half-sections to scale with their names
// and the diameters of lands, bores and grooves.
#pragma once

#include "app/base/geometry.h"
#include "app/base/theme.h"
#include "app/document/cad_parts.h"

#include <cairo.h>

// `part`: which body stands for each part of the valve, as in parts.h; those are in its colours.
void sb_half_sections_draw(cairo_t *cr, SbRect rect, const SbTheme *theme, const SbCad *cad,
                           const int part[SB_CAD_PART_COUNT]);
