// Delayed calls by the main loop for a widget, which end with the widget.
//
// A call never runs after its owner was destroyed, even if something else has a reference to the
// owner: destroying a widget removes its pending calls. All of ui/ adds its idle and timeout
// sources here; tests/layers.py refuses others (g_idle_add(), g_timeout_add()). `owner` is a
// GtkWidget.
#pragma once

#include <gtk/gtk.h>

// One pending call. All zero: none is pending. The memory may be freed without a cancel once the
// owner is destroyed.
typedef struct {
  guint source;
} SbLater;

// Schedules call(data), once: after `ms` milliseconds, or for 0 when the main loop is idle. A call
// that is pending in `later` is replaced. `data` is borrowed and must live as long as `owner` is
// not destroyed.
void sb_later_set(SbLater *later, gpointer owner, guint ms, void (*call)(gpointer data),
                  gpointer data);

// As sb_later_set(), but a pending call stays and keeps its time.
void sb_later_ensure(SbLater *later, gpointer owner, guint ms, void (*call)(gpointer data),
                     gpointer data);

// Schedules call(data) every `ms` milliseconds until sb_later_cancel() or the end of `owner`. A
// call that is pending in `later` is replaced.
void sb_later_repeat(SbLater *later, gpointer owner, guint ms, void (*call)(gpointer data),
                     gpointer data);

// Returns whether a call is pending; FALSE while the call of sb_later_set() runs, which may
// schedule the next one.
gboolean sb_later_is_due(const SbLater *later);

// Removes the pending call, if there is one.
void sb_later_cancel(SbLater *later);
