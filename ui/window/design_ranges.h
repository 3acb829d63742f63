// The button Bounds on the page Design: which parameters the search varies, and their bounds.
#pragma once

#include "app/session/design_ask.h"

#include <gtk/gtk.h>

// What the user changes. `index`: of ask->range. All functions must be set and may call
// sb_design_ranges_show().
typedef struct {
  void (*freed)(void *data, size_t index, gboolean free); // the search varies it, or no longer
  void (*bounded)(void *data, size_t index, double low, double high); // new bounds [SI]
  void (*robust)(void *data, gboolean robust); // the limits must be met over the tolerances
  void *data;
} SbDesignRangesHooks;

// Returns the button (floating reference) without ranges. `hooks` is copied.
GtkWidget *sb_design_ranges_new(const SbDesignRangesHooks *hooks);

// Shows the ranges of `ask` in `ranges`, a widget of sb_design_ranges_new(). Returns whether they
// are of other parameters than those shown before. The hooks are not called.
gboolean sb_design_ranges_show(GtkWidget *ranges, const SbDesignAsk *ask);
