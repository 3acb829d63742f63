// The column of parameters: a search box over collapsible groups of rows, all from the catalogue.
#pragma once

#include "app/session/session.h"

#include <gtk/gtk.h>

#define SB_TYPE_PARAM_PANEL (sb_param_panel_get_type())
G_DECLARE_FINAL_TYPE(SbParamPanel, sb_param_panel, SB, PARAM_PANEL, GtkBox)

GtkWidget *sb_param_panel_new(SbSession *session);

// Unfolds the group of parameter `id`, scrolls to its row and puts the focus there.
void sb_param_panel_reveal(SbParamPanel *panel, SbParamId id);

// Puts the focus into the search box.
void sb_param_panel_search(SbParamPanel *panel);
