// The verdict on the valve in one line above the views: seals, presses, returns, doses, leak, fits;
// each with its sign and the figure that decides it. A click shows why, and the instant it is of.
#pragma once

#include "app/session/session.h"

#include <gtk/gtk.h>

GtkWidget *sb_verdict_strip_new(SbSession *session);
