// The column of parameters: a search box over collapsible groups of rows, all from the catalogue.
#pragma once

#include "app/session/session.h"

#include <gtk/gtk.h>

#define SB_TYPE_PARAM_PANEL (sb_param_panel_get_type())
G_DECLARE_FINAL_TYPE(SbParamPanel, sb_param_panel, SB, PARAM_PANEL, GtkBox)

GtkWidget *sb_param_panel_new(SbSession *session);

// Unfolds the group of parameter `id`, scrolls to its row and puts the focus there.
void sb_param_panel_reveal(SbParamPanel *panel, SbParamId id);

// The same without the focus: the row is marked for a moment.
void sb_param_panel_show(SbParamPanel *panel, SbParamId id);

// Puts the focus into the search box.
void sb_param_panel_search(SbParamPanel *panel);

// Which parameters are listed: those that a design begins with, those that differ from their
// defaults, all.
typedef enum { SB_PARAM_FILTER_MAIN, SB_PARAM_FILTER_CHANGED, SB_PARAM_FILTER_ALL } SbParamFilter;
void sb_param_panel_set_filter(SbParamPanel *panel, SbParamFilter filter);
SbParamFilter sb_param_panel_filter(SbParamPanel *panel);
