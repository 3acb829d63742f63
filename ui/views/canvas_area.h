// A drawing area with a natural size in addition to its minimum size, so that pictures have their
// designed size in a large window and shrink in a small one. GtkDrawingArea has one size for both.
#pragma once

#include <gtk/gtk.h>

#define SB_TYPE_CANVAS_AREA (sb_canvas_area_get_type())
G_DECLARE_FINAL_TYPE(SbCanvasArea, sb_canvas_area, SB, CANVAS_AREA, GtkDrawingArea)

// Returns a new drawing area (floating reference). `least_...` are the minimum and `natural_...`
// the natural width and height [logical px]; a natural size below the minimum counts as the
// minimum.
GtkWidget *sb_canvas_area_new(int least_width, int natural_width, int least_height,
                              int natural_height);
