// An atlas of text lines: one single-channel texture with the coverage of each line at the device's
// resolution. When it is full it is emptied and filled again with what is still in use.
#pragma once

#include "app/section/gl_api.h"
#include "app/section/text.h"

#include <stdbool.h>

typedef struct SbGlAtlas SbGlAtlas;

typedef struct {
  int u, v, width, height; // texels
  int left, ascent;        // from the anchor (left end, baseline) to the upper left texel
  double advance;          // [px]
} SbGlLine;

SbGlAtlas *sb_gl_atlas_create(const SbGlApi *gl);
void sb_gl_atlas_destroy(SbGlAtlas *atlas);

// Finds or draws a line; size in device pixels. False if the atlas is full:
// then sb_gl_atlas_clear() and start the picture again.
bool sb_gl_atlas_line(SbGlAtlas *atlas, const char *text, double size, int weight, SbGlLine *line);

// Empties the atlas; doubled if `grow`.
void sb_gl_atlas_clear(SbGlAtlas *atlas, bool grow);

GLuint sb_gl_atlas_texture(const SbGlAtlas *atlas);
