// The window's three columns: parameters, section, charts. Their borders can be dragged; the places
// are remembered. In a window narrower than the look's the outer columns start narrower too.
#pragma once

#include <gtk/gtk.h>

// `columns` holds the left column and `views`; `views` holds the centre and the right column.
void sb_columns_attach(GtkPaned *columns, GtkPaned *views);
