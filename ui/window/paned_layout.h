// The window's three columns: parameters, section, charts. The user can drag their borders, whose
// positions are remembered (preferences.h). In a narrow window the outer columns are narrower; if
// it is too narrow for all three, the charts are hidden, and a toggle in the header shows them.
#pragma once

#include <gtk/gtk.h>

// Places the borders now and whenever the width changes. `columns` has the left column and `views`
// as its children; `views` has the centre and the right column. `charts` is the toggle (a widget
// with a property "active", which is bound to the visibility of the right column). All are borrowed
// as long as `columns` lives.
void sb_paned_layout_attach(GtkPaned *columns, GtkPaned *views, GtkWidget *charts);
