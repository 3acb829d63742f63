// What tests of the window's own widgets share: an application of their own, and widgets by name.
#pragma once

#include "ui/window/application.h"

#include <gtk/gtk.h>

// An application that no other process answers for and that lives without a window until it is
// released (g_application_release()).
static inline SbApplication *start_application(void) {
  SbApplication *application = sb_application_new();
  g_application_set_flags(G_APPLICATION(application),
                          G_APPLICATION_NON_UNIQUE | G_APPLICATION_HANDLES_OPEN);
  g_autoptr(GError) error = NULL;
  if (!g_application_register(G_APPLICATION(application), NULL, &error)) {
    g_error("%s", error->message);
  }
  g_application_hold(G_APPLICATION(application));
  return application;
}

typedef struct {
  const char *name;
  GType type;
  GtkWidget *found;
} Wanted;

static inline void find_wanted(GtkWidget *widget, gpointer data) {
  Wanted *wanted = data;
  const char *name = atk_object_get_name(gtk_widget_get_accessible(widget));
  if (g_strcmp0(name, wanted->name) == 0 && !GTK_IS_LABEL(widget) &&
      G_TYPE_CHECK_INSTANCE_TYPE(widget, wanted->type)) {
    wanted->found = widget;
  } else if (GTK_IS_CONTAINER(widget)) {
    gtk_container_forall(GTK_CONTAINER(widget), find_wanted, data);
  }
}

// The last widget of a type inside another with this accessible name, but no label; there must be
// one.
static inline GtkWidget *named(gpointer inside, const char *name, GType type) {
  Wanted wanted = {name, type, NULL};
  find_wanted(GTK_WIDGET(inside), &wanted);
  if (wanted.found == NULL) {
    g_error("no widget is named \"%s\"", name);
  }
  return wanted.found;
}

// The dialog that is open; NULL: none.
static inline GtkDialog *open_dialog(void) {
  g_autoptr(GList) all = gtk_window_list_toplevels();
  for (GList *one = all; one != NULL; one = one->next) {
    if (GTK_IS_DIALOG(one->data)) {
      return one->data;
    }
  }
  return NULL;
}
