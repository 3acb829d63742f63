// The section drawn by the window's own GL: a GtkGLArea that shows a display list.
//
// Whether that works is known only when the widget is realized. Elsewhere (no GLX, a GL before 3.3)
// it hides itself, and the window shows the picture of a context without a window. So it does by
// choice where the window's GL is a software one: that is no faster, and every part of the window
// would have to go through it (half of the time of a playing frame, measured).
// SEALBENCH_SECTION=window or =picture overrides the choice.
#pragma once

#include "app/section/draw_list.h"

#include <gtk/gtk.h>

// A widget that draws `list`, which is borrowed and outlives it. `decided` is called once, when the
// choice is made.
GtkWidget *sb_section_gl_new(const SbDrawList *list, void (*decided)(void *data), void *data);

// Whether the widget draws. False before it is realized.
gboolean sb_section_gl_works(GtkWidget *widget);

// One sentence on the choice and why; borrowed.
const char *sb_section_gl_reason(GtkWidget *widget);
