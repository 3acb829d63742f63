// The page of the window that recomputes the tables and figures of the thesis.
#pragma once

#include <gtk/gtk.h>

// Returns a new page (floating reference). It computes the selected item on a thread of its own,
// when the page is shown first and when another item is selected. It does not depend on a document.
GtkWidget *sb_thesis_page_new(void);
