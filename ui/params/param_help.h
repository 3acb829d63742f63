// The help page of a parameter: what it is, where on the valve it is measured, what it may be and
// why it is what it is, and the equation that it enters first.
#pragma once

#include "app/session/session.h"

#include <gtk/gtk.h>

// Shows the page of parameter `id` beside `field`; Escape or a click elsewhere closes it.
void sb_param_help_show(SbSession *session, SbParamId id, GtkWidget *field);
