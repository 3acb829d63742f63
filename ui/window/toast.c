// See toast.h. The pointer over the line holds it.
#include "ui/window/toast.h"

#include "ui/views/later.h"
#include "ui/views/style.h"

#include <glib/gi18n.h>

enum {
  SHOWN_MS = 5000,
  ABOVE = 172,    // over timeline and status [px]
  WIDE_CHARS = 72 // then the text is cut in its middle
};

typedef struct {
  GtkWidget *revealer, *label, *button;
  SbLater timer; // hides it
  gboolean stays;
} Toast;

static Toast *toast_of(GtkWindow *window) {
  return g_object_get_data(G_OBJECT(window), "toast");
}

static void hide(Toast *toast) {
  sb_later_cancel(&toast->timer);
  gtk_revealer_set_reveal_child(GTK_REVEALER(toast->revealer), FALSE);
  gtk_widget_hide(toast->revealer);
}

static void on_timer(gpointer data) {
  Toast *toast = data;
  hide(toast);
}

static void wait(Toast *toast) {
  sb_later_cancel(&toast->timer);
  if (!toast->stays && gtk_widget_get_visible(toast->revealer)) {
    sb_later_set(&toast->timer, toast->revealer, SHOWN_MS, on_timer, toast);
  }
}

static gboolean on_enter(GtkWidget *widget, GdkEventCrossing *event, Toast *toast) {
  sb_later_cancel(&toast->timer);
  return GDK_EVENT_PROPAGATE;
}

static gboolean on_leave(GtkWidget *widget, GdkEventCrossing *event, Toast *toast) {
  if (event->detail != GDK_NOTIFY_INFERIOR) {
    wait(toast);
  }
  return GDK_EVENT_PROPAGATE;
}

void sb_toast_attach(GtkWindow *window) {
  Toast *toast = g_new0(Toast, 1);
  g_object_set_data_full(G_OBJECT(window), "toast", toast, g_free);
  toast->revealer = gtk_revealer_new();
  gtk_revealer_set_transition_duration(GTK_REVEALER(toast->revealer), 0);
  gtk_widget_set_halign(toast->revealer, GTK_ALIGN_CENTER);
  gtk_widget_set_valign(toast->revealer, GTK_ALIGN_END);
  gtk_widget_set_margin_bottom(toast->revealer, ABOVE);
  GtkWidget *events = gtk_event_box_new(), *box = gtk_box_new(GTK_ORIENTATION_HORIZONTAL, 12);
  gtk_widget_add_events(events, GDK_ENTER_NOTIFY_MASK | GDK_LEAVE_NOTIFY_MASK);
  g_signal_connect(events, "enter-notify-event", G_CALLBACK(on_enter), toast);
  g_signal_connect(events, "leave-notify-event", G_CALLBACK(on_leave), toast);
  sb_style_class(box, "sb-toast");
  atk_object_set_role(gtk_widget_get_accessible(box), ATK_ROLE_NOTIFICATION);
  toast->label = gtk_label_new(NULL);
  gtk_label_set_ellipsize(GTK_LABEL(toast->label), PANGO_ELLIPSIZE_MIDDLE);
  gtk_label_set_max_width_chars(GTK_LABEL(toast->label), WIDE_CHARS);
  toast->button = gtk_button_new_with_label(_("Open")); // until it is for something
  gtk_container_add(GTK_CONTAINER(box), toast->label);
  gtk_container_add(GTK_CONTAINER(box), toast->button);
  gtk_container_add(GTK_CONTAINER(events), box);
  gtk_container_add(GTK_CONTAINER(toast->revealer), events);
  gtk_widget_show_all(toast->revealer);
  gtk_widget_hide(toast->revealer);
  GtkWidget *overlay = gtk_overlay_new();
  g_autoptr(GtkWidget) content = g_object_ref(gtk_bin_get_child(GTK_BIN(window)));
  gtk_container_remove(GTK_CONTAINER(window), content);
  gtk_container_add(GTK_CONTAINER(overlay), content);
  gtk_overlay_add_overlay(GTK_OVERLAY(overlay), toast->revealer);
  gtk_container_add(GTK_CONTAINER(window), overlay);
  gtk_widget_show(overlay);
}

void sb_toast_show(GtkWindow *window, const char *text, const char *button, const char *action,
                   gboolean stays) {
  Toast *toast = toast_of(window);
  toast->stays = stays;
  gtk_label_set_text(GTK_LABEL(toast->label), text);
  gtk_widget_set_visible(toast->button, action != NULL);
  if (action != NULL) {
    gtk_button_set_label(GTK_BUTTON(toast->button), button);
  }
  gtk_actionable_set_action_name(GTK_ACTIONABLE(toast->button), action);
  gtk_widget_show(toast->revealer);
  gtk_revealer_set_reveal_child(GTK_REVEALER(toast->revealer), TRUE);
  wait(toast);
}
