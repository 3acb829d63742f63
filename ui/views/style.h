// Look of the widgets: the style sheet, and light or dark.
#pragma once

#include "app/base/theme.h"

#include <gtk/gtk.h>

typedef enum { SB_STYLE_SYSTEM, SB_STYLE_LIGHT, SB_STYLE_DARK } SbStyleTheme;

// Loads the style sheet for the whole display and follows `theme`. Call again to change it.
void sb_style_apply(SbStyleTheme theme);

// True if the dark palette is on (of a theme of its own or because the desktop asks for it).
gboolean sb_style_is_dark(void);

// Gives `widget` an accessible name; `description` may be NULL.
void sb_style_name(GtkWidget *widget, const char *name, const char *description);

// A menu button whose tooltip does not lie over its popover.
GtkWidget *sb_style_menu_button(void);

// Shows a picture of former values paler than one of the present values.
void sb_style_former(GtkWidget *picture, gboolean former);

// Adds a style class.
void sb_style_class(GtkWidget *widget, const char *name);

// A visible label with a style class, its text at `align` (0 left, 1 right).
GtkWidget *sb_style_label(const char *text, const char *name, float align);

// Fills with the panels' ground; the theme in force.
const SbTheme *sb_style_ground(cairo_t *cr);

// The look of a window: its ground, and its font where the desktop names none of its own.
void sb_style_window(GtkWidget *window);
