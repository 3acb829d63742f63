// Text by Pango: widths for the placement of labels, and layouts for drawing.
//
// Sizes are in pixels of the target (logical pixels times its scale); `weight` is 400 for normal
// and 700 for bold text. The family is Inter with fallbacks, digits have equal widths. Hinting is
// off, so that widths scale and pictures do not depend on the screen's settings.
#pragma once

#include <cairo.h>
#include <pango/pango.h>

typedef struct SbText SbText;

// Returns a new object. Freed by sb_text_destroy().
SbText *sb_text_create(void);

// Frees it.
void sb_text_destroy(SbText *text);

// Returns the advance width of one line of UTF-8 text [px]. Widths are cached.
double sb_text_width(SbText *text, const char *string, double size, int weight);

// Returns a Pango layout of the line, borrowed until the next call. Writes the distance of its
// baseline from its top, and its width [px]; either pointer may be NULL.
PangoLayout *sb_text_layout(SbText *text, const char *string, double size, int weight,
                            double *baseline, double *width);
