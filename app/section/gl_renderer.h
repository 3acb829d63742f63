// Draws display lists with OpenGL 3.3: into a framebuffer of its own that is read back, or into the
// framebuffer that a window has bound.
//
// Everything is analytic coverage in the shaders: no multisampling. Text is drawn from an atlas of
// lines that Pango laid out at the device's resolution, on whole pixels. A renderer belongs to its
// context's thread.
#pragma once

#include "app/section/draw_list.h"
#include "app/section/gl_context.h"

#include <stddef.h>
#include <stdint.h>

typedef struct SbGlRenderer SbGlRenderer;

// Compiles the shaders in the context, which must be current and outlive the renderer.
SbStatus sb_gl_renderer_create(SbGlRenderer **out, SbGlContext *context, SbReport *report);

// Frees it with its context current. NULL is allowed.
void sb_gl_renderer_destroy(SbGlRenderer *renderer);

// Draws a list into the own framebuffer of width x height device pixels; `scale` is device pixels
// per logical pixel. SB_ERROR_RANGE if the size is more than the GL can do.
SbStatus sb_gl_renderer_draw(SbGlRenderer *renderer, const SbDrawList *list, int width, int height,
                             double scale, SbReport *report);

// Copies the picture of the last draw: rows top down, 4 bytes a pixel in cairo's order (B, G, R, A
// on little-endian machines; CAIRO_FORMAT_ARGB32, premultiplied), `stride` bytes a row (a multiple
// of 4).
void sb_gl_renderer_read(SbGlRenderer *renderer, uint8_t *pixels, size_t stride);

// Draws a list into the framebuffer that is bound now (a window's, with its origin at the bottom).
void sb_gl_renderer_draw_bound(SbGlRenderer *renderer, const SbDrawList *list, int width,
                               int height, double scale);
