// A draw list drawn by GL without a window.
#pragma once

#include "app/section/gl_renderer.h"

#include <glib.h>
#include <math.h>

// A new surface in `format`; takes the context.
static inline cairo_surface_t *gl_picture(SbGlContext *context, const SbDrawList *list,
                                          cairo_format_t format, double scale) {
  SbReport report = {0};
  SbGlRenderer *renderer;
  g_assert_cmpint(sb_gl_renderer_create(&renderer, context, &report), ==, SB_OK);
  int width = (int)lround((double)list->width * scale);
  int height = (int)lround((double)list->height * scale);
  cairo_surface_t *surface = cairo_image_surface_create(format, width, height);
  g_assert_cmpint(sb_gl_renderer_draw(renderer, list, width, height, scale, &report), ==, SB_OK);
  cairo_surface_flush(surface);
  sb_gl_renderer_read(renderer, cairo_image_surface_get_data(surface),
                      (size_t)cairo_image_surface_get_stride(surface));
  cairo_surface_mark_dirty(surface);
  sb_gl_renderer_destroy(renderer);
  sb_gl_context_destroy(context);
  return surface;
}
