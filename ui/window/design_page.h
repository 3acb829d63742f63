// The page of the window on which a better design is looked for: a map of two parameters, limits,
// what tolerances do, and the search of `sealbench design`.
#pragma once

#include "app/session/session.h"

#include <gtk/gtk.h>

// By closed forms the map follows edits; by the document's own models, whose valves take long, it
// is computed on request. A point of the map, or the best design, is put into the document or kept
// as a pin.
GtkWidget *sb_design_page_new(SbSession *session);
