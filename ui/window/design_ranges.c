// The bounds of a design's question. See the header.
#include "ui/window/design_ranges.h"

#include "app/base/translation.h"
#include "app/document/typed.h"
#include "ui/views/style.h"

#include <glib/gi18n.h>

typedef struct {
  SbDesignRangesHooks hooks;
  GtkWidget *popover, *free[SB_DESIGN_RANGES], *end[SB_DESIGN_RANGES][2], *robust;
  SbDesignRange range[SB_DESIGN_RANGES]; // as shown
  size_t count;
  gboolean refreshing;
} Ranges;

static void on_free(GtkToggleButton *button, Ranges *ranges) {
  for (size_t i = 0; i < ranges->count && !ranges->refreshing; i++) {
    if (ranges->free[i] == GTK_WIDGET(button)) {
      ranges->range[i].free = gtk_toggle_button_get_active(button);
      ranges->hooks.freed(ranges->hooks.data, i, ranges->range[i].free);
    }
  }
}

static void on_range_robust(GtkToggleButton *button, Ranges *ranges) {
  if (!ranges->refreshing) {
    ranges->hooks.robust(ranges->hooks.data, gtk_toggle_button_get_active(button));
  }
}

static void on_range_end(GtkEntry *entry, Ranges *ranges) {
  for (size_t i = 0; i < ranges->count && !ranges->refreshing; i++) {
    const SbDesignRange *range = &ranges->range[i];
    double end[2];
    gboolean good = TRUE;
    if (ranges->end[i][0] != GTK_WIDGET(entry) && ranges->end[i][1] != GTK_WIDGET(entry)) {
      continue;
    }
    for (int k = 0; k < 2; k++) {
      const char *typed = gtk_entry_get_text(GTK_ENTRY(ranges->end[i][k]));
      const double value = k == 0 ? range->low : range->high;
      g_autofree char *text = sb_typed_text(range->id, value, typed);
      good = sb_param_parse(&end[k], range->id, text, NULL) && good;
    }
    GtkStyleContext *style = gtk_widget_get_style_context(GTK_WIDGET(entry));
    if (!good || !(end[0] < end[1])) {
      gtk_style_context_add_class(style, GTK_STYLE_CLASS_ERROR);
      return;
    }
    gtk_style_context_remove_class(style, GTK_STYLE_CLASS_ERROR);
    if (end[0] != range->low || end[1] != range->high) {
      ranges->hooks.bounded(ranges->hooks.data, i, end[0], end[1]);
    }
  }
}

static gboolean on_range_focus_out(GtkWidget *widget, GdkEventFocus *event, Ranges *ranges) {
  on_range_end(GTK_ENTRY(widget), ranges);
  return GDK_EVENT_PROPAGATE;
}

// Every parameter with its bounds; those ticked are moved by the search.
static void make(Ranges *ranges, const SbDesignAsk *ask) {
  GtkWidget *before = gtk_bin_get_child(GTK_BIN(ranges->popover)), *grid = gtk_grid_new();
  if (before != NULL) {
    gtk_widget_destroy(before);
  }
  sb_style_class(grid, "sb-row");
  gtk_grid_set_column_spacing(GTK_GRID(grid), 8);
  gtk_grid_set_row_spacing(GTK_GRID(grid), 4);
  gtk_container_set_border_width(GTK_CONTAINER(grid), 10);
  for (size_t i = 0; i < ask->count; i++) {
    const char *label = sb_translation(sb_param(ask->range[i].id)->label);
    ranges->free[i] = gtk_check_button_new_with_label(label);
    g_autofree char *vary = g_strdup_printf(_("Vary %s"), label);
    sb_style_name(ranges->free[i], vary, NULL);
    g_signal_connect(ranges->free[i], "toggled", G_CALLBACK(on_free), ranges);
    gtk_grid_attach(GTK_GRID(grid), ranges->free[i], 0, (int)i, 1, 1);
    for (int end = 0; end < 2; end++) {
      GtkWidget *entry = ranges->end[i][end] = gtk_entry_new();
      gtk_entry_set_width_chars(GTK_ENTRY(entry), 9);
      gtk_entry_set_alignment(GTK_ENTRY(entry), 1);
      g_autofree char *name = g_strdup_printf(end == 0 ? _("%s from") : _("%s to"), label);
      sb_style_name(entry, name, NULL);
      g_signal_connect(entry, "activate", G_CALLBACK(on_range_end), ranges);
      g_signal_connect(entry, "focus-out-event", G_CALLBACK(on_range_focus_out), ranges);
      gtk_grid_attach(GTK_GRID(grid), entry, 1 + end, (int)i, 1, 1);
    }
  }
  ranges->robust = gtk_check_button_new_with_label(
      _("Meet all limits with a probability of 99.9 % over the tolerances"));
  g_signal_connect(ranges->robust, "toggled", G_CALLBACK(on_range_robust), ranges);
  gtk_grid_attach(GTK_GRID(grid), ranges->robust, 0, (int)ask->count, 3, 1);
  gtk_container_add(GTK_CONTAINER(ranges->popover), grid);
  gtk_widget_show_all(grid);
}

gboolean sb_design_ranges_show(GtkWidget *button, const SbDesignAsk *ask) {
  Ranges *ranges = g_object_get_data(G_OBJECT(button), "ranges");
  gboolean same = ranges->count == ask->count;
  for (size_t i = 0; same && i < ask->count; i++) {
    same = ranges->range[i].id == ask->range[i].id;
  }
  ranges->refreshing = TRUE;
  if (!same) {
    make(ranges, ask);
  }
  ranges->count = ask->count;
  for (size_t i = 0; i < ask->count; i++) {
    const SbDesignRange *range = &ask->range[i];
    ranges->range[i] = *range;
    gtk_toggle_button_set_active(GTK_TOGGLE_BUTTON(ranges->free[i]), range->free);
    for (int end = 0; end < 2; end++) {
      g_autofree char *text = sb_param_format(range->id, end == 0 ? range->low : range->high);
      gtk_entry_set_text(GTK_ENTRY(ranges->end[i][end]), text);
    }
  }
  gtk_toggle_button_set_active(GTK_TOGGLE_BUTTON(ranges->robust), ask->robust);
  ranges->refreshing = FALSE;
  return !same;
}

GtkWidget *sb_design_ranges_new(const SbDesignRangesHooks *hooks) {
  Ranges *ranges = g_new0(Ranges, 1);
  ranges->hooks = *hooks;
  GtkWidget *button = sb_style_menu_button();
  g_object_set_data_full(G_OBJECT(button), "ranges", ranges, g_free);
  ranges->popover = gtk_popover_new(button);
  gtk_menu_button_set_popover(GTK_MENU_BUTTON(button), ranges->popover);
  gtk_container_add(GTK_CONTAINER(button), gtk_label_new(_("Bounds")));
  gtk_widget_set_tooltip_text(button, _("Parameters that the search varies, and their bounds"));
  return button;
}
