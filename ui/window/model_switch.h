// The switch in the header that chooses how the rings are fitted: by closed forms or solved. It
// sets models.fit and nothing else.
#pragma once

#include "app/session/session.h"

#include <gtk/gtk.h>

GtkWidget *sb_model_switch_new(SbSession *session);

// With short words, for a narrow window.
void sb_model_switch_set_short(GtkWidget *widget, gboolean on);
