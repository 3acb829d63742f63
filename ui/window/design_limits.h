// The table of limits on the page Design: for each figure its range, its present value, that of the
// best design, and their margins in standard deviations.
#pragma once

#include "app/export/design_map.h"
#include "app/session/design_ask.h"

#include <gtk/gtk.h>

// What the user does in the table. `figure`: index of sb_figure(). Both functions must be set and
// may call sb_design_limits_show().
typedef struct {
  // The limit of a figure is now low .. high [SI]; infinite ends are open, both open: removed.
  void (*limited)(void *data, int figure, double low, double high);
  // The row of a figure was selected.
  void (*chosen)(void *data, int figure);
  void *data;
} SbDesignLimitsHooks;

// Returns an empty table (floating reference). `hooks` is copied.
GtkWidget *sb_design_limits_new(const SbDesignLimitsHooks *hooks);

// Shows the limits of `ask` in `limits`, a widget of sb_design_limits_new(), with the results
// `answer` (NULL: none yet), and selects the row of the figure `chosen` (index of sb_figure(); -1:
// no row). Both are only read; the hooks are not called.
void sb_design_limits_show(GtkWidget *limits, const SbDesignAsk *ask, const SbDesignAnswer *answer,
                           int chosen);
