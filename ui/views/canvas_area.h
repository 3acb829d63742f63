// A drawing area with a natural size beside its least one, so that pictures have the look's sizes
// in a large window and give way in a small one. GtkDrawingArea knows one size for both.
#pragma once

#include <gtk/gtk.h>

#define SB_TYPE_CANVAS_AREA (sb_canvas_area_get_type())
G_DECLARE_FINAL_TYPE(SbCanvasArea, sb_canvas_area, SB, CANVAS_AREA, GtkDrawingArea)

// Sizes in logical pixels; a natural size below the least one counts as the least.
GtkWidget *sb_canvas_area_new(int least_width, int natural_width, int least_height,
                              int natural_height);
