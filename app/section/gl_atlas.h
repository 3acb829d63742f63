// An atlas of text lines: one texture with a single channel that contains the coverage of each line
// at the device's resolution. A full atlas is emptied and filled with the lines of the present
// picture.
#pragma once

#include "app/section/gl_api.h"
#include "app/section/text.h"

#include <stdbool.h>

typedef struct SbGlAtlas SbGlAtlas;

// A line in the atlas.
typedef struct {
  int u, v, width, height; // its rectangle in the texture [texels], (u, v) is the upper left texel
  int left, ascent; // from the anchor (left end, baseline) to that texel, right and up [device px]
  double advance;   // width for layout [device px]
} SbGlLine;

// Returns an empty atlas in the context of `gl`, which is current and must outlive it. Freed by
// sb_gl_atlas_destroy().
SbGlAtlas *sb_gl_atlas_create(const SbGlApi *gl);

// Frees the atlas and its texture, with its context current.
void sb_gl_atlas_destroy(SbGlAtlas *atlas);

// Finds a line of text, or draws it into the atlas. `size` is in device pixels. Returns false if
// the atlas is full: then call sb_gl_atlas_clear() and start the picture again.
bool sb_gl_atlas_line(SbGlAtlas *atlas, const char *text, double size, int weight, SbGlLine *line);

// Removes all lines; with `grow` the texture becomes twice as large, up to 8192 x 8192 texels. The
// first clear of a picture is without `grow`, further ones are with it; after four of them a
// picture that still has no room is drawn without the lines that have none.
void sb_gl_atlas_clear(SbGlAtlas *atlas, bool grow);

// Returns the texture, valid until the next change of the atlas.
GLuint sb_gl_atlas_texture(const SbGlAtlas *atlas);
