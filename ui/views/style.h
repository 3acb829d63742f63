// Appearance of the widgets: the style sheet, light or dark, and small helpers.
#pragma once

#include "app/draw/theme.h"

#include <gtk/gtk.h>

// The user's choice: as the desktop, light, or dark.
typedef enum { SB_STYLE_SYSTEM, SB_STYLE_LIGHT, SB_STYLE_DARK } SbStyleTheme;

// Loads the style sheet for the default screen with this theme. SB_STYLE_SYSTEM: the theme that the
// desktop has during the call; later changes of the desktop are not followed. May be called again
// to change the theme.
void sb_style_apply(SbStyleTheme theme);

// Returns whether the dark palette is in use.
gboolean sb_style_is_dark(void);

// Sets the accessible name of `widget`, and its accessible description unless `description` is
// NULL. The caller passes translated texts.
void sb_style_name(GtkWidget *widget, const char *name, const char *description);

// Returns a new GtkMenuButton (floating reference) whose tooltip is hidden while its popover is
// open.
GtkWidget *sb_style_menu_button(void);

// Draws the widget `picture` paler if it shows earlier values (`former`), else normally.
void sb_style_former(GtkWidget *picture, gboolean former);

// Adds a style class to `widget`.
void sb_style_class(GtkWidget *widget, const char *name);

// Returns a new label (floating reference), visible, with the style class `name`. `text` is the
// translated text (NULL: empty); `align` is its horizontal alignment, 0 left to 1 right.
GtkWidget *sb_style_label(const char *text, const char *name, float align);

// Fills the clip region of `cr` with the colour of `role`, which remains cairo's source, and
// returns the theme in use. Static.
const SbTheme *sb_style_ground(cairo_t *cr, SbRole role);

// Sets the background of a window, and its font if the desktop names none.
void sb_style_window(GtkWidget *window);
