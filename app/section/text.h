// Text by Pango: measuring for the layout of labels, and layouts for whoever draws them.
//
// One SbText belongs to one thread. Sizes are in pixels of the target (logical pixels times the
// scale), the family is Inter with the look's fallbacks, figures are tabular. Hinting is off, so
// that widths scale and pictures do not depend on the screen's settings.
#pragma once

#include <cairo.h>
#include <pango/pango.h>

typedef struct SbText SbText;

SbText *sb_text_create(void);
void sb_text_destroy(SbText *text);

// Advance width of a line [px]; remembered, so that asking every frame costs a look-up.
double sb_text_width(SbText *text, const char *string, double size, int weight);

// A layout of the line, borrowed until the next call. *baseline and *width [px] may be NULL.
PangoLayout *sb_text_layout(SbText *text, const char *string, double size, int weight,
                            double *baseline, double *width);
