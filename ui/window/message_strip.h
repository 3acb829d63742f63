// The strip above the section: what is wrong with the values or the run with the one button that
// mends it, which former run the pictures show, or what the run found that nobody may miss.
#pragma once

#include "app/session/session.h"

#include <gtk/gtk.h>

GtkWidget *sb_message_strip_new(SbSession *session);
