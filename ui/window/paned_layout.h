// The window's three columns: parameters, section, charts. Their borders can be dragged; the places
// are remembered. In a window narrower than the look's the outer columns start narrower too; in one
// too narrow for all three the charts give way to the section, and a toggle in the header brings
// them back.
#pragma once

#include <gtk/gtk.h>

// `columns` holds the left column and `views`; `views` holds the centre and the right column.
// `charts` is the toggle.
void sb_paned_layout_attach(GtkPaned *columns, GtkPaned *views, GtkWidget *charts);
