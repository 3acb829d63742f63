// The frame of a chart: background, title, note, name of the upright axis. Pixels of the picture.
#pragma once

#include "app/draw/canvas.h"

// Returns the room inside of a chart's rectangle: all of it, or without the padding of a panel.
SbRect sb_frame_inner(SbRect rect, bool panel);

// Draws the background of a chart if it is a panel. Returns its room.
SbRect sb_frame_begin(SbCanvas *c, SbRect rect, bool panel);

// Draws a bold title of `size` px with its baseline 14 px below the upper end of `in`, and after
// it, on the same line, a note (NULL: none), which is cut to the width of `in`.
void sb_frame_title(SbCanvas *c, SbRect in, double size, const char *title, const char *note);

// Draws in lines one below the other: the title, the note (not if `compact`), and the name of the
// upright axis, above the plot. Returns the baseline of the name.
double sb_frame_head(SbCanvas *c, SbRect in, bool compact, const char *title, const char *note,
                     const char *y_name);
