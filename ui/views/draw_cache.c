// A drawing area whose picture is kept in an image in memory. Drawing thousands of strokes and
// glyphs there and handing over one image is several times cheaper than sending each to the display
// server, and other parts of the window can be redrawn without it. The interval between drawings
// spreads the work of several pictures over the frames while something moves.
#include "ui/views/draw_cache.h"

#include "ui/views/later.h"

struct SbDrawCache {
  GtkWidget *area;
  SbDrawCacheDraw draw;
  void *data;
  cairo_surface_t *surface;
  int width, height, scale;
  gboolean changed;
  gint64 drawn, when; // when it was, and when the timer has it drawn [us]
  SbLater timer;
};

static void make(SbDrawCache *cache, int width, int height, int scale) {
  if (cache->surface == NULL || width != cache->width || height != cache->height ||
      scale != cache->scale) {
    g_clear_pointer(&cache->surface, cairo_surface_destroy);
    cache->surface = cairo_image_surface_create(CAIRO_FORMAT_RGB24, MAX(width, 1) * scale,
                                                MAX(height, 1) * scale);
    cairo_surface_set_device_scale(cache->surface, scale, scale);
    cache->width = width;
    cache->height = height;
    cache->scale = scale;
  }
  cairo_t *cr = cairo_create(cache->surface);
  cache->draw(cr, width, height, cache->data);
  cairo_destroy(cr);
  cache->changed = FALSE;
  cache->drawn = g_get_monotonic_time();
}

static gboolean on_draw(GtkWidget *widget, cairo_t *cr, SbDrawCache *cache) {
  int width = gtk_widget_get_allocated_width(widget);
  int height = gtk_widget_get_allocated_height(widget);
  int scale = gtk_widget_get_scale_factor(widget);
  const gboolean due = cache->changed && !sb_later_is_due(&cache->timer);
  if (due || width != cache->width || height != cache->height || scale != cache->scale) {
    make(cache, width, height, scale);
  }
  cairo_set_source_surface(cr, cache->surface, 0, 0);
  cairo_paint(cr);
  if (gtk_widget_has_visible_focus(widget)) {
    gtk_render_focus(gtk_widget_get_style_context(widget), cr, 3, 3, width - 6, height - 6);
  }
  return GDK_EVENT_PROPAGATE;
}

static void on_timer(gpointer data) {
  SbDrawCache *cache = data;
  gtk_widget_queue_draw(cache->area);
}

// Draws at a time, or before if that was the case already.
static void draw_at(SbDrawCache *cache, gint64 when) {
  if (sb_later_is_due(&cache->timer) && cache->when <= when) {
    return;
  }
  cache->when = when;
  sb_later_set(&cache->timer, cache->area, (guint)MAX((when - g_get_monotonic_time()) / 1000, 1),
               on_timer, cache);
}

void sb_draw_cache_change(SbDrawCache *cache, int interval) {
  const gint64 when = cache->drawn + 1000 * (gint64)interval;
  cache->changed = TRUE;
  if (when > g_get_monotonic_time()) {
    draw_at(cache, when);
  } else {
    sb_later_cancel(&cache->timer);
    gtk_widget_queue_draw(cache->area);
  }
}

void sb_draw_cache_change_later(SbDrawCache *cache, int ms) {
  cache->changed = TRUE;
  draw_at(cache, g_get_monotonic_time() + 1000 * (gint64)ms);
}

// Another theme: the colours are not the picture's own.
static void on_style(SbDrawCache *cache) {
  sb_later_cancel(&cache->timer);
  cache->changed = TRUE;
}

static void on_destroy(GtkWidget *widget, SbDrawCache *cache) {
  g_clear_pointer(&cache->surface, cairo_surface_destroy);
  cache->width = -1;
}

SbDrawCache *sb_draw_cache_attach(GtkWidget *area, SbDrawCacheDraw draw, void *data) {
  SbDrawCache *cache = g_new0(SbDrawCache, 1);
  cache->area = area;
  cache->draw = draw;
  cache->data = data;
  cache->changed = TRUE;
  g_object_set_data_full(G_OBJECT(area), "sb-draw-cache", cache, g_free);
  g_signal_connect(area, "draw", G_CALLBACK(on_draw), cache);
  g_signal_connect_swapped(area, "style-updated", G_CALLBACK(on_style), cache);
  g_signal_connect(area, "destroy", G_CALLBACK(on_destroy), cache);
  return cache;
}
