// The table of limits on the page Design: what a figure may be, what it is now and at the best
// design found, and how far that is from the limit over its scatter.
#pragma once

#include "app/export/design_map.h"
#include "app/session/design_ask.h"

#include <gtk/gtk.h>

typedef struct {
  // A limit was set or taken away (both ends open).
  void (*limited)(void *data, int figure, double low, double high);
  // A figure's row was chosen.
  void (*chosen)(void *data, int figure);
  void *data;
} SbDesignLimitsHooks;

GtkWidget *sb_design_limits_new(const SbDesignLimitsHooks *hooks);

// Shows the question's limits with what is known of them; `answer` may be NULL.
void sb_design_limits_show(GtkWidget *limits, const SbDesignAsk *ask, const SbDesignAnswer *answer,
                           int chosen);
