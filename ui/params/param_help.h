// The help page of a parameter: meaning, position on the valve, allowed range, default with its
// source, and the equation in which it is first used.
#pragma once

#include "app/session/session.h"

#include <gtk/gtk.h>

// Shows the page of parameter `id` as a popover next to the widget `field`. Escape or a click
// outside closes and destroys it. Values are those of `session` now.
void sb_param_help_show(SbSession *session, SbParamId id, GtkWidget *field);
