// One row of the parameter panel: label and range, a field with unit, the symbol, a reset button,
// and an error line. Generated from the catalogue.
#pragma once

#include "app/session/session.h"

#include <gtk/gtk.h>

#define SB_TYPE_PARAM_ROW (sb_param_row_get_type())
G_DECLARE_FINAL_TYPE(SbParamRow, sb_param_row, SB, PARAM_ROW, GtkBox)

// A row for parameter `id` of the session's document. The label columns of all rows in `labels`
// get one width.
GtkWidget *sb_param_row_new(SbSession *session, SbParamId id, GtkSizeGroup *fields);

// Shows the value in force, the error, and what may be edited.
void sb_param_row_refresh(SbParamRow *row);

// Moves the keyboard focus into the row's field.
void sb_param_row_focus(SbParamRow *row);

// Shows the help page of the row that `widget`, which may be NULL, lies in; FALSE: in none.
gboolean sb_param_row_help(GtkWidget *widget);

// Draws what the parameter does to a figure: -1 to 1 of the largest, NaN where that is not known;
// paler where it is of `former` values. `text`, which may be NULL, tells it in words.
void sb_param_row_show_effect(SbParamRow *row, double share, gboolean former, const char *text);
