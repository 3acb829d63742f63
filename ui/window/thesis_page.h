// The page of the window on which the thesis' tables and figures are computed anew.
#pragma once

#include <gtk/gtk.h>

// Computes the chosen one on a thread of its own when the page is first seen and when another is
// chosen. It does not depend on the document.
GtkWidget *sb_thesis_page_new(void);
