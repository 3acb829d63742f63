// The application: one process, any number of windows; a file that is opened goes into a fresh
// window or into a new one. The theme choice is kept in the user's configuration.
#include "ui/window/application.h"

#include "engine/valve/sealbench.h"
#include "ui/params/actions.h"
#include "ui/views/style.h"
#include "ui/window/latency.h"
#include "ui/window/preferences.h"
#include "ui/window/window.h"

#include <glib/gi18n.h>
#include <stdlib.h>

struct _SbApplication {
  GtkApplication parent_instance;
};

G_DEFINE_TYPE(SbApplication, sb_application, GTK_TYPE_APPLICATION)

static const char *const theme_names[] = {"system", "light", "dark"};

static void on_quit(GSimpleAction *action, GVariant *parameter, gpointer data) {
  // Each window asks about its unsaved changes; the application ends with the last of them.
  GList *windows = g_list_copy(gtk_application_get_windows(data));
  for (GList *item = windows; item != NULL; item = item->next) {
    gtk_window_close(item->data);
  }
  g_list_free(windows);
}

static void on_about(GSimpleAction *action, GVariant *parameter, gpointer data) {
  GtkWindow *parent = gtk_application_get_active_window(data);
  const SbEngineIdentity *engine = sb_engine_identity();
  g_autofree char *version = g_strdup_printf("%s (engine %.12s%s%.12s)", engine->version,
                                             engine->source, engine->commit != NULL ? ", " : "",
                                             engine->commit != NULL ? engine->commit : "");
  gtk_show_about_dialog(parent, "program-name", "Sealbench", "version", version, "comments",
                        _("Workbench for the seals of inhaler valves: fitment, film, friction, "
                          "leakage and motion."),
                        "license-type", GTK_LICENSE_GPL_3_0, "logo-icon-name",
                        "org.sealbench.Sealbench", NULL);
}

static void on_theme(GSimpleAction *action, GVariant *value, gpointer data) {
  const char *name = g_variant_get_string(value, NULL);
  for (guint i = 0; i < G_N_ELEMENTS(theme_names); i++) {
    if (g_strcmp0(theme_names[i], name) == 0) {
      sb_style_apply((SbStyleTheme)i);
      sb_preferences_set_string("theme", name);
      g_simple_action_set_state(action, value);
    }
  }
  for (GList *item = gtk_application_get_windows(data); item != NULL; item = item->next) {
    gtk_widget_queue_draw(item->data);
  }
}

// Writes what the latency probe has seen so far; the probe runs if SEALBENCH_LATENCY names a file.
static void on_write_latency(GSimpleAction *action, GVariant *parameter, gpointer data) {
  const char *path = g_getenv("SEALBENCH_LATENCY");
  g_autoptr(GError) error = NULL;
  if (path != NULL && !sb_latency_write(path, &error)) {
    g_warning("%s", error->message);
  }
}

static void on_reset_latency(GSimpleAction *action, GVariant *parameter, gpointer data) {
  sb_latency_reset();
}

static void set_accels(GtkApplication *application) {
  size_t count;
  const SbAction *action = sb_actions(&count);
  for (size_t i = 0; i < count; i++) {
    const char *const *accels = action[i].accels;
    gtk_application_set_accels_for_action(application, action[i].name,
                                          (const char *[]){accels[0], accels[1], accels[2], NULL});
  }
}

static void startup(GApplication *application) {
  G_APPLICATION_CLASS(sb_application_parent_class)->startup(application);
  static const GActionEntry entries[] = {
      {.name = "quit", .activate = on_quit},
      {.name = "about", .activate = on_about},
      {.name = "write-latency", .activate = on_write_latency},
      {.name = "reset-latency", .activate = on_reset_latency},
  };
  g_action_map_add_action_entries(G_ACTION_MAP(application), entries, G_N_ELEMENTS(entries),
                                  application);

  g_autofree char *name = sb_preferences_string("theme", "system");
  SbStyleTheme theme = SB_STYLE_SYSTEM;
  for (guint i = 0; i < G_N_ELEMENTS(theme_names); i++) {
    if (g_strcmp0(theme_names[i], name) == 0) {
      theme = (SbStyleTheme)i;
    }
  }
  g_autoptr(GSimpleAction) action = g_simple_action_new_stateful(
      "theme", G_VARIANT_TYPE_STRING, g_variant_new_string(theme_names[theme]));
  g_signal_connect(action, "change-state", G_CALLBACK(on_theme), application);
  g_action_map_add_action(G_ACTION_MAP(application), G_ACTION(action));
  sb_style_apply(theme);
  set_accels(GTK_APPLICATION(application));
  gtk_window_set_default_icon_name("org.sealbench.Sealbench");
  if (g_getenv("SEALBENCH_LATENCY") != NULL) {
    sb_latency_start();
  }
}

static SbWindow *fresh_window(SbApplication *application) {
  GList *windows = gtk_application_get_windows(GTK_APPLICATION(application));
  for (GList *item = windows; item != NULL; item = item->next) {
    if (SB_IS_WINDOW(item->data) && sb_window_is_fresh(item->data)) {
      return item->data;
    }
  }
  return SB_WINDOW(sb_window_new(application));
}

// Returns the window whose document is that file, by whatever path; NULL: none.
static SbWindow *window_of(SbApplication *application, GFile *file) {
  g_autofree char *wanted = g_file_get_path(file);
  g_autofree char *real = wanted != NULL ? realpath(wanted, NULL) : NULL;
  for (GList *item = gtk_application_get_windows(GTK_APPLICATION(application));
       item != NULL && real != NULL; item = item->next) {
    const char *path = SB_IS_WINDOW(item->data)
                           ? sb_document_path(sb_session_document(sb_window_session(item->data)))
                           : NULL;
    g_autofree char *own = path != NULL ? realpath(path, NULL) : NULL;
    if (g_strcmp0(own, real) == 0) {
      return item->data;
    }
  }
  return NULL;
}

static void activate(GApplication *application) {
  GtkWindow *window = gtk_application_get_active_window(GTK_APPLICATION(application));
  if (window == NULL) {
    window = GTK_WINDOW(sb_window_new(SB_APPLICATION(application)));
  }
  gtk_window_present(window);
}

static void open_files(GApplication *application, GFile **files, int count, const char *hint) {
  for (int i = 0; i < count; i++) {
    // A file that has a window is raised, not opened twice.
    SbWindow *window = window_of(SB_APPLICATION(application), files[i]);
    if (window == NULL) {
      window = fresh_window(SB_APPLICATION(application));
      sb_window_open(window, files[i]);
    }
    gtk_window_present(GTK_WINDOW(window));
  }
}

static void shut_down(GApplication *application) {
  const char *path = g_getenv("SEALBENCH_LATENCY");
  if (path != NULL) {
    sb_latency_write(path, NULL);
  }
  G_APPLICATION_CLASS(sb_application_parent_class)->shutdown(application);
}

static void sb_application_class_init(SbApplicationClass *class) {
  GApplicationClass *application = G_APPLICATION_CLASS(class);
  application->startup = startup;
  application->activate = activate;
  application->open = open_files;
  application->shutdown = shut_down;
}

static void sb_application_init(SbApplication *application) {}

SbApplication *sb_application_new(void) {
  return g_object_new(SB_TYPE_APPLICATION, "application-id", "org.sealbench.Sealbench", "flags",
                      G_APPLICATION_HANDLES_OPEN, NULL);
}
