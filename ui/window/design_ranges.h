// The button Bounds on the page Design: which parameters the search moves, and between what.
#pragma once

#include "app/session/design_ask.h"

#include <gtk/gtk.h>

typedef struct {
  // The question's range `index` became free or not, or got other bounds (SI); what the page asks
  // for the tolerances.
  void (*freed)(void *data, size_t index, gboolean free);
  void (*bounded)(void *data, size_t index, double low, double high);
  void (*robust)(void *data, gboolean robust);
  void *data;
} SbDesignRangesHooks;

GtkWidget *sb_design_ranges_new(const SbDesignRangesHooks *hooks);

// Shows the question's ranges; whether they are of other parameters than those shown before.
gboolean sb_design_ranges_show(GtkWidget *ranges, const SbDesignAsk *ask);
