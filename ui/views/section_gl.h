// The section drawn by the window's own OpenGL: a GtkGLArea that shows a display list.
//
// Whether that works is known only when the widget is realized. Without GLX (EGL on Wayland) or
// with an OpenGL before 3.3 the widget draws nothing, and the caller shows a picture that a context
// without a window draws. It does the same if the window's OpenGL is a software renderer, because
// then every part of the window would be drawn by it (half of the time of a playing frame). The
// environment variable SEALBENCH_SECTION=window or =picture overrides this decision.
#pragma once

#include "app/section/draw_list.h"

#include <gtk/gtk.h>

// Returns a new widget (floating reference) that draws `list`, which is borrowed and must outlive
// it. decided(data) is called when the widget is realized and the decision is made; it may call the
// functions below. If the widget draws, it is a GtkGLArea: after a change of `list` the caller
// calls gtk_gl_area_queue_render().
GtkWidget *sb_section_gl_new(const SbDrawList *list, void (*decided)(void *data), void *data);

// Returns whether the widget draws; FALSE before it is realized.
gboolean sb_section_gl_works(GtkWidget *widget);

// Returns a sentence on the decision and its reason; valid until the widget is realized or
// destroyed.
const char *sb_section_gl_reason(GtkWidget *widget);
