// The switch in the header that selects how the seals are fitted: by closed forms or by the solved
// ring. It sets models.fit of the document and nothing else.
#pragma once

#include "app/session/session.h"

#include <gtk/gtk.h>

// Returns a new switch (floating reference). `session` is borrowed and must outlive it.
GtkWidget *sb_model_switch_new(SbSession *session);

// Shortens the labels of a widget of sb_model_switch_new(), for a narrow window, or restores them.
void sb_model_switch_set_short(GtkWidget *widget, gboolean on);
