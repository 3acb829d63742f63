// See pin_bar.h. Both lists are made anew, when idle, after what they show has changed: never while
// a button of theirs is being served.
#include "ui/views/pin_bar.h"

#include "app/base/figure_text.h"
#include "app/draw/canvas.h"
#include "ui/views/later.h"
#include "ui/views/signals.h"
#include "ui/views/style.h"

#include <glib/gi18n.h>

enum { CHIP_CHARS = 11, NAME_CHARS = 26, SAMPLE = 22 };

typedef struct {
  SbSession *session;
  GtkWidget *box, *chips, *kept, *kept_label, *list;
  char *shown;   // what the lists show
  SbLater later; // refresh_pins()
} Bar;

static size_t index_of(GtkWidget *widget) {
  return GPOINTER_TO_SIZE(g_object_get_data(G_OBJECT(widget), "pin"));
}

static void set_index(GtkWidget *widget, size_t index) {
  g_object_set_data(G_OBJECT(widget), "pin", GSIZE_TO_POINTER(index));
}

static void on_pins_drop(GtkWidget *button, Bar *bar) {
  sb_session_unpin(bar->session, index_of(button));
}

static void on_use(GtkWidget *button, Bar *bar) {
  sb_session_use_pin(bar->session, index_of(button));
}

static void on_draw_toggled(GtkWidget *check, Bar *bar) {
  const size_t index = index_of(check);
  const gboolean on = gtk_toggle_button_get_active(GTK_TOGGLE_BUTTON(check));
  if (on != (sb_session_pin_slot(bar->session, index) >= 0)) {
    sb_session_draw_pin(bar->session, index, on);
  }
}

static void take_name(GtkWidget *entry, Bar *bar) {
  const size_t index = index_of(entry);
  const char *text = gtk_entry_get_text(GTK_ENTRY(entry));
  const char *given = sb_document_pin_name(sb_session_document(bar->session), index);
  if (g_strcmp0(text, given != NULL ? given : "") != 0) {
    sb_session_rename_pin(bar->session, index, text);
  }
}

static gboolean on_pins_name_left(GtkWidget *entry, GdkEvent *event, Bar *bar) {
  take_name(entry, bar);
  return GDK_EVENT_PROPAGATE;
}

// A piece of the line that it is drawn with.
static gboolean draw_sample(GtkWidget *area, cairo_t *cr, gpointer data) {
  const int slot = GPOINTER_TO_INT(data);
  const double y = floor(gtk_widget_get_allocated_height(area) / 2.0) + 0.5;
  SbCanvas canvas;
  sb_canvas_init(&canvas, cr, sb_theme(sb_style_is_dark()));
  sb_canvas_curve(&canvas, sb_chart_pin_stroke(slot), (SbPoint[]){{0, y}, {SAMPLE, y}}, 2);
  sb_canvas_finish(&canvas);
  return GDK_EVENT_PROPAGATE;
}

static GtkWidget *sample_new(int slot) {
  GtkWidget *area = gtk_drawing_area_new();
  gtk_widget_set_size_request(area, SAMPLE, 12);
  if (slot >= 0) {
    g_signal_connect(area, "draw", G_CALLBACK(draw_sample), GINT_TO_POINTER(slot));
  }
  return area;
}

static GtkWidget *drop_new(Bar *bar, size_t index) {
  GtkWidget *drop = gtk_button_new_from_icon_name("window-close-symbolic", GTK_ICON_SIZE_MENU);
  g_autofree char *name = g_strdup_printf(_("Drop %s"), sb_session_pin_name(bar->session, index));
  sb_style_name(drop, name, NULL);
  gtk_widget_set_tooltip_text(drop, name);
  gtk_button_set_relief(GTK_BUTTON(drop), GTK_RELIEF_NONE);
  set_index(drop, index);
  g_signal_connect(drop, "clicked", G_CALLBACK(on_pins_drop), bar);
  return drop;
}

static void add_chip(Bar *bar, size_t index) {
  const char *name = sb_session_pin_name(bar->session, index);
  GtkWidget *chip = gtk_box_new(GTK_ORIENTATION_HORIZONTAL, 5);
  sb_style_class(chip, "sb-chip");
  gtk_box_pack_start(GTK_BOX(chip), sample_new(sb_session_pin_slot(bar->session, index)), FALSE,
                     FALSE, 0);
  GtkWidget *label = gtk_label_new(name);
  gtk_label_set_ellipsize(GTK_LABEL(label), PANGO_ELLIPSIZE_START); // the value is at the end
  gtk_label_set_width_chars(GTK_LABEL(label), 4);
  gtk_label_set_max_width_chars(GTK_LABEL(label), CHIP_CHARS);
  gtk_widget_set_tooltip_text(label, name);
  gtk_box_pack_start(GTK_BOX(chip), label, TRUE, TRUE, 0);
  gtk_box_pack_start(GTK_BOX(chip), drop_new(bar, index), FALSE, FALSE, 0);
  gtk_box_pack_start(GTK_BOX(bar->chips), chip, FALSE, TRUE, 0);
}

// What is known of it by now.
static GtkWidget *result_new(Bar *bar, size_t index) {
  const SbSummary *summary = sb_session_pin_summary(bar->session, index);
  g_autofree char *text = NULL;
  if (summary != NULL) {
    char force[SB_FORMAT_MAX];
    sb_format_figure(force, summary, sb_figure_find("cycle.force_breakaway_N"));
    text = g_strdup_printf(_("break-away %s"), force);
  } else {
    text = g_strdup(sb_session_pin_failed(bar->session, index) ? _("its run has failed")
                                                               : _("being computed"));
  }
  return sb_style_label(text, "sb-note", 0);
}

static void add_row(Bar *bar, size_t index) {
  const char *name = sb_session_pin_name(bar->session, index);
  const char *given = sb_document_pin_name(sb_session_document(bar->session), index);
  const int slot = sb_session_pin_slot(bar->session, index), row = (int)index;
  GtkGrid *grid = GTK_GRID(bar->list);
  GtkWidget *check = gtk_check_button_new();
  g_autofree char *draw = g_strdup_printf(_("Draw %s"), name);
  sb_style_name(check, draw, NULL);
  gtk_widget_set_tooltip_text(check, draw);
  gtk_toggle_button_set_active(GTK_TOGGLE_BUTTON(check), slot >= 0);
  set_index(check, index);
  g_signal_connect(check, "toggled", G_CALLBACK(on_draw_toggled), bar);
  gtk_grid_attach(grid, check, 0, row, 1, 1);
  gtk_grid_attach(grid, sample_new(slot), 1, row, 1, 1);
  GtkWidget *entry = gtk_entry_new();
  gtk_entry_set_text(GTK_ENTRY(entry), given != NULL ? given : "");
  gtk_entry_set_placeholder_text(GTK_ENTRY(entry), name);
  gtk_entry_set_width_chars(GTK_ENTRY(entry), NAME_CHARS);
  g_autofree char *spoken = g_strdup_printf(_("Name of %s"), name);
  sb_style_name(entry, spoken, NULL);
  set_index(entry, index);
  g_signal_connect(entry, "activate", G_CALLBACK(take_name), bar);
  g_signal_connect(entry, "focus-out-event", G_CALLBACK(on_pins_name_left), bar);
  gtk_grid_attach(grid, entry, 2, row, 1, 1);
  gtk_grid_attach(grid, result_new(bar, index), 3, row, 1, 1);
  GtkWidget *use = gtk_button_new_with_label(_("Use"));
  g_autofree char *using = g_strdup_printf(_("Use %s"), name);
  sb_style_name(use, using, NULL);
  gtk_widget_set_tooltip_text(
      use, _("Make these the present values; one undo restores the earlier ones"));
  set_index(use, index);
  g_signal_connect(use, "clicked", G_CALLBACK(on_use), bar);
  gtk_grid_attach(grid, use, 4, row, 1, 1);
  gtk_grid_attach(grid, drop_new(bar, index), 5, row, 1, 1);
}

static void destroy_pins(GtkWidget *widget, gpointer data) {
  gtk_widget_destroy(widget);
}

static void clear(GtkWidget *container) {
  gtk_container_foreach(GTK_CONTAINER(container), destroy_pins, NULL);
}

// All that is shown, to see whether it has changed.
static char *shown_pin_text(SbSession *session) {
  GString *text = g_string_new(NULL);
  const size_t count = sb_session_pin_count(session);
  for (size_t i = 0; i < count; i++) {
    const char *given = sb_document_pin_name(sb_session_document(session), i);
    g_string_append_printf(text, "%s|%s|%d|%d|%d\n", sb_session_pin_name(session, i),
                           given != NULL ? given : "", sb_session_pin_slot(session, i),
                           sb_session_pin_summary(session, i) != NULL,
                           sb_session_pin_failed(session, i));
  }
  return g_string_free(text, FALSE);
}

static void refresh_pins(gpointer data) {
  Bar *bar = data;
  char *text = shown_pin_text(bar->session);
  if (g_strcmp0(text, bar->shown) == 0) {
    g_free(text);
    return;
  }
  g_free(bar->shown);
  bar->shown = text;
  clear(bar->chips);
  clear(bar->list);
  const size_t count = sb_session_pin_count(bar->session);
  for (size_t i = 0; i < count; i++) {
    add_row(bar, i);
    if (sb_session_pin_slot(bar->session, i) >= 0) {
      add_chip(bar, i);
    }
  }
  gtk_widget_show_all(bar->chips);
  gtk_widget_show_all(bar->list);
  g_autofree char *label = g_strdup_printf(_("Saved %zu"), count);
  gtk_label_set_text(GTK_LABEL(bar->kept_label), label);
  gtk_widget_set_visible(bar->kept, count > 0);
  if (count == 0) {
    gtk_toggle_button_set_active(GTK_TOGGLE_BUTTON(bar->kept), FALSE);
  }
}

static void on_pins_change(Bar *bar) {
  sb_later_ensure(&bar->later, bar->box, 0, refresh_pins, bar);
}

static void bar_free(gpointer data) {
  Bar *bar = data;
  g_free(bar->shown);
  g_free(bar);
}

GtkWidget *sb_pin_bar_new(SbSession *session) {
  Bar *bar = g_new0(Bar, 1);
  bar->session = session;
  bar->box = gtk_box_new(GTK_ORIENTATION_HORIZONTAL, 6);
  g_object_set_data_full(G_OBJECT(bar->box), "bar", bar, bar_free);
  bar->chips = gtk_box_new(GTK_ORIENTATION_HORIZONTAL, 6);
  gtk_box_pack_start(GTK_BOX(bar->box), bar->chips, FALSE, FALSE, 0);
  bar->kept = sb_style_menu_button();
  bar->kept_label = gtk_label_new("");
  gtk_container_add(GTK_CONTAINER(bar->kept), bar->kept_label);
  sb_style_name(bar->kept, _("Saved designs"), NULL);
  gtk_widget_set_tooltip_text(bar->kept, _("All designs that are saved for comparison"));
  gtk_menu_button_set_direction(GTK_MENU_BUTTON(bar->kept), GTK_ARROW_UP);
  GtkWidget *popover = gtk_popover_new(bar->kept);
  bar->list = gtk_grid_new();
  gtk_grid_set_row_spacing(GTK_GRID(bar->list), 4);
  gtk_grid_set_column_spacing(GTK_GRID(bar->list), 8);
  GtkWidget *scroller = gtk_scrolled_window_new(NULL, NULL);
  gtk_scrolled_window_set_policy(GTK_SCROLLED_WINDOW(scroller), GTK_POLICY_NEVER,
                                 GTK_POLICY_AUTOMATIC);
  gtk_scrolled_window_set_max_content_height(GTK_SCROLLED_WINDOW(scroller), 320);
  gtk_scrolled_window_set_propagate_natural_height(GTK_SCROLLED_WINDOW(scroller), TRUE);
  gtk_container_add(GTK_CONTAINER(scroller), bar->list);
  gtk_container_set_border_width(GTK_CONTAINER(popover), 10);
  gtk_container_add(GTK_CONTAINER(popover), scroller);
  gtk_widget_show_all(scroller);
  gtk_menu_button_set_popover(GTK_MENU_BUTTON(bar->kept), popover);
  gtk_box_pack_end(GTK_BOX(bar->box), bar->kept, FALSE, FALSE, 0);
  gtk_widget_show_all(bar->box);
  gtk_widget_set_no_show_all(bar->kept, TRUE);
  gtk_widget_hide(bar->kept);
  sb_signals_end_with(bar->box, bar->session, bar);
  g_signal_connect_swapped(session, "run-changed", G_CALLBACK(on_pins_change), bar);
  g_signal_connect_swapped(session, "params-changed", G_CALLBACK(on_pins_change), bar);
  refresh_pins(bar);
  return bar->box;
}
