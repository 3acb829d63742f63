// A drawing area whose picture is kept: drawn anew only when it has changed, and not more often
// than wanted.
#pragma once

#include <gtk/gtk.h>

typedef struct SbDrawCache SbDrawCache;

// Draws the whole picture of `width` x `height` logical pixels.
typedef void (*SbDrawCacheDraw)(cairo_t *cr, double width, double height, void *data);

// Makes `area` (a drawing area) show what `draw` draws, with a focus ring. Lives as long as the
// widget.
SbDrawCache *sb_draw_cache_attach(GtkWidget *area, SbDrawCacheDraw draw, void *data);

// The picture has changed: draws it with the next frame, or, if it was drawn less than `interval`
// ms ago, that long after.
void sb_draw_cache_change(SbDrawCache *cache, int interval);

// The picture has changed by little, and more is to come: draws it `ms` from now, unless it changes
// at once before; meanwhile the area shows the picture of before.
void sb_draw_cache_change_later(SbDrawCache *cache, int ms);

// For the picture of a former run while one of the present values is on its way [ms].
enum { SB_DRAW_LATER = 250 };
