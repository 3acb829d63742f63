// A window for the wall: one picture of the run in big type, with keys that step through stages and
// bookmarks, kept designs and pictures.
#pragma once

#include "app/session/session.h"

#include <gtk/gtk.h>

// Opens it over the whole screen, beside `window`, whose session it shows and steps; it goes with
// the window, by Escape or F5.
void sb_presentation_open(GtkWindow *window, SbSession *session);
