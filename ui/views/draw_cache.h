// A drawing area with a stored picture: it is drawn again only when it has changed, and not more
// often than requested.
#pragma once

#include <gtk/gtk.h>

// The stored picture of one area.
typedef struct SbDrawCache SbDrawCache;

// Draws the full picture, with its background, of `width` x `height` logical pixels; the origin is
// its top left corner.
typedef void (*SbDrawCacheDraw)(cairo_t *cr, double width, double height, void *data);

// Makes `area`, a GtkDrawingArea, show what draw(cr, width, height, data) draws, with a focus ring.
// A change of size, scale or theme causes a new drawing, too. To be called once for an area. The
// result belongs to the widget and must not be used after its destruction; `data` must live as
// long.
SbDrawCache *sb_draw_cache_attach(GtkWidget *area, SbDrawCacheDraw draw, void *data);

// States that the picture has changed. It is drawn with the next frame, or, if it was drawn less
// than `interval` ms ago, when `interval` ms have passed since then.
void sb_draw_cache_change(SbDrawCache *cache, int interval);

// States that the picture has changed slightly and will change again soon. It is drawn `ms` ms from
// now, unless sb_draw_cache_change() causes it to be drawn earlier; until then the area shows the
// earlier picture.
void sb_draw_cache_change_later(SbDrawCache *cache, int ms);

// Value of `ms` for the picture of an earlier run while a run of the present values is computed
// [ms].
enum { SB_DRAW_LATER = 250 };
