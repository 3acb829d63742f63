// The column of parameters: a search field above groups of rows that can be opened and closed, all
// generated from the catalogue.
#pragma once

#include "app/session/session.h"

#include <gtk/gtk.h>

#define SB_TYPE_PARAM_PANEL (sb_param_panel_get_type())
G_DECLARE_FINAL_TYPE(SbParamPanel, sb_param_panel, SB, PARAM_PANEL, GtkBox)

// Returns a new panel (floating reference) that shows and edits the document of `session`, which is
// borrowed and must outlive it.
GtkWidget *sb_param_panel_new(SbSession *session);

// Opens the group of parameter `id`, scrolls to its row and moves the keyboard focus to its field.
// Empties the search; if the filter does not list the parameter, it becomes SB_PARAM_FILTER_ALL.
void sb_param_panel_reveal(SbParamPanel *panel, SbParamId id);

// As sb_param_panel_reveal(), but highlights the row for a moment in place of moving the focus.
void sb_param_panel_show(SbParamPanel *panel, SbParamId id);

// Moves the keyboard focus to the search field.
void sb_param_panel_search(SbParamPanel *panel);

// Which parameters are listed: those of a first design, those that differ from their defaults, or
// all.
typedef enum { SB_PARAM_FILTER_MAIN, SB_PARAM_FILTER_CHANGED, SB_PARAM_FILTER_ALL } SbParamFilter;

// Sets which parameters are listed; initially SB_PARAM_FILTER_ALL.
void sb_param_panel_set_filter(SbParamPanel *panel, SbParamFilter filter);

// Returns which parameters are listed.
SbParamFilter sb_param_panel_filter(SbParamPanel *panel);
