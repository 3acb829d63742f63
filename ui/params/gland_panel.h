// Design read-outs of both glands against customary bands, for the foot of the parameter column.
#pragma once

#include "app/session/session.h"

#include <gtk/gtk.h>

// A new expander, folded; follows the session's values.
GtkWidget *sb_gland_panel_new(SbSession *session);
