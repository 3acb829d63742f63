// Draws display lists with OpenGL 3.3: into a framebuffer of its own that can be read, or into the
// framebuffer that a window has bound.
//
// Edges are smoothed by analytic coverage in the shaders, without multisampling. Text is drawn at
// whole pixels from an atlas of lines that Pango laid out at the device's resolution. A renderer is
// used in the thread of its context, which must be current for every call. It does not restore the
// GL state that it changes.
#pragma once

#include "app/section/draw_list.h"
#include "app/section/gl_context.h"

#include <stddef.h>
#include <stdint.h>

typedef struct SbGlRenderer SbGlRenderer;

// Compiles the shaders in `context`, which must outlive the renderer. Returns SB_ERROR_IO if the GL
// refuses them. Freed by sb_gl_renderer_destroy().
SbStatus sb_gl_renderer_create(SbGlRenderer **out, SbGlContext *context, SbReport *report);

// Frees the renderer.
void sb_gl_renderer_destroy(SbGlRenderer *renderer);

// Draws a list into the renderer's framebuffer of width x height device pixels; `scale` is device
// pixels per logical pixel. Returns SB_ERROR_RANGE if the GL does not support this size.
SbStatus sb_gl_renderer_draw(SbGlRenderer *renderer, const SbDrawList *list, int width, int height,
                             double scale, SbReport *report);

// Copies the picture of the last sb_gl_renderer_draw(), which must have succeeded, to
// pixels[height][stride] with the height given there: rows from the top, 4 bytes a pixel in the
// order of CAIRO_FORMAT_ARGB32 (B, G, R, A on little-endian machines, premultiplied). `stride` is
// the number of bytes of a row, a multiple of 4 and at least 4 times the width.
void sb_gl_renderer_read(SbGlRenderer *renderer, uint8_t *pixels, size_t stride);

// Draws a list into the framebuffer that is bound now, of width x height device pixels with its
// origin at the bottom left (a window's); `scale` is device pixels per logical pixel.
void sb_gl_renderer_draw_bound(SbGlRenderer *renderer, const SbDrawList *list, int width,
                               int height, double scale);
