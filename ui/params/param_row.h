// One row of the parameter panel: label and range, a field with its unit, the symbol, a button that
// resets the value, and a line for an error. Generated from the catalogue.
#pragma once

#include "app/session/session.h"

#include <gtk/gtk.h>

#define SB_TYPE_PARAM_ROW (sb_param_row_get_type())
G_DECLARE_FINAL_TYPE(SbParamRow, sb_param_row, SB, PARAM_ROW, GtkBox)

// Returns a new row (floating reference) that edits parameter `id` of the document of `session`,
// which is borrowed and must outlive the row. The field is added to the size group `fields`, so
// that all fields of the group have one width.
GtkWidget *sb_param_row_new(SbSession *session, SbParamId id, GtkSizeGroup *fields);

// Shows the value in force, the error, and whether it can be edited. To be called after
// "params-changed".
void sb_param_row_refresh(SbParamRow *row);

// Moves the keyboard focus to the row's field.
void sb_param_row_focus(SbParamRow *row);

// Shows the help page of the row that contains `widget` (NULL: none). Returns FALSE if no row
// contains it.
gboolean sb_param_row_help(GtkWidget *widget);

// Draws the effect of the parameter on a figure: `share` is the effect divided by the largest
// effect of any parameter, -1 to 1; NaN: not known. `former`: the effect belongs to earlier values
// and is drawn paler. `text` (a translated text of the caller, copied; NULL: none) is the effect in
// words, for the tooltip.
void sb_param_row_show_effect(SbParamRow *row, double share, gboolean former, const char *text);
