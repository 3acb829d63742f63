// A drawing area whose picture is kept: drawn anew only when it has changed, and not more often
// than wanted.
#pragma once

#include <gtk/gtk.h>

typedef struct SbPicture SbPicture;

// Draws the whole picture of `width` x `height` logical pixels.
typedef void (*SbPictureDraw)(cairo_t *cr, double width, double height, void *data);

// Makes `area` (a drawing area) show what `draw` draws, with a focus ring. Lives as long as the
// widget.
SbPicture *sb_picture_attach(GtkWidget *area, SbPictureDraw draw, void *data);

// The picture has changed: draws it with the next frame, or, if it was drawn less than `interval`
// ms ago, that long after.
void sb_picture_change(SbPicture *picture, int interval);
