// Look of the widgets: one style sheet over two palettes (assets/light.css, assets/dark.css),
// chosen by the user or by the desktop. Drawing by cairo takes its colours from app/chart, not from
// here.
#include "ui/views/style.h"

#include "app/draw/theme.h"

#include "sealbench-resources.h"

#include <string.h>

static GtkCssProvider *provider;
static gboolean dark;

// What the desktop asks for: GNOME's colour scheme, else a theme whose name says so.
static gboolean desktop_is_dark(void) {
  GSettingsSchemaSource *source = g_settings_schema_source_get_default();
  g_autoptr(GSettingsSchema) schema =
      source != NULL ? g_settings_schema_source_lookup(source, "org.gnome.desktop.interface", TRUE)
                     : NULL;
  if (schema != NULL && g_settings_schema_has_key(schema, "color-scheme")) {
    g_autoptr(GSettings) settings = g_settings_new("org.gnome.desktop.interface");
    g_autofree char *scheme = g_settings_get_string(settings, "color-scheme");
    if (strcmp(scheme, "prefer-dark") == 0) {
      return TRUE;
    }
  }
  g_autofree char *theme = NULL;
  g_object_get(gtk_settings_get_default(), "gtk-theme-name", &theme, NULL);
  return theme != NULL && g_str_has_suffix(theme, "-dark");
}

void sb_style_apply(SbStyleTheme theme) {
  dark = theme == SB_STYLE_DARK || (theme == SB_STYLE_SYSTEM && desktop_is_dark());
  g_object_set(gtk_settings_get_default(), "gtk-application-prefer-dark-theme", dark, NULL);

  // A static library's constructor is dropped by the linker, so the resources are registered here.
  g_resources_register(sealbench_get_resource());
  g_autoptr(GBytes) palette = g_resources_lookup_data(
      dark ? "/org/sealbench/dark.css" : "/org/sealbench/light.css", 0, NULL);
  g_autoptr(GBytes) sheet = g_resources_lookup_data("/org/sealbench/style.css", 0, NULL);
  g_assert(palette != NULL && sheet != NULL);
  g_autoptr(GString) text = g_string_new(NULL);
  g_string_append_len(text, g_bytes_get_data(palette, NULL), (gssize)g_bytes_get_size(palette));
  g_string_append_len(text, g_bytes_get_data(sheet, NULL), (gssize)g_bytes_get_size(sheet));

  if (provider == NULL) {
    provider = gtk_css_provider_new();
    gtk_style_context_add_provider_for_screen(gdk_screen_get_default(),
                                              GTK_STYLE_PROVIDER(provider),
                                              GTK_STYLE_PROVIDER_PRIORITY_APPLICATION);
  }
  g_autoptr(GError) error = NULL;
  if (!gtk_css_provider_load_from_data(provider, text->str, (gssize)text->len, &error)) {
    g_warning("style sheet: %s", error->message);
  }
}

gboolean sb_style_is_dark(void) {
  return dark;
}

void sb_style_name(GtkWidget *widget, const char *name, const char *description) {
  AtkObject *accessible = gtk_widget_get_accessible(widget);
  atk_object_set_name(accessible, name);
  if (description != NULL) {
    atk_object_set_description(accessible, description);
  }
}

GtkWidget *sb_style_menu_button(void) {
  GtkWidget *button = gtk_menu_button_new();
  g_object_bind_property(button, "active", button, "has-tooltip", G_BINDING_INVERT_BOOLEAN);
  return button;
}

void sb_style_former(GtkWidget *picture, gboolean former) {
  gtk_widget_set_opacity(picture, former ? SB_OPACITY_EARLIER : 1);
}

void sb_style_class(GtkWidget *widget, const char *name) {
  gtk_style_context_add_class(gtk_widget_get_style_context(widget), name);
}

GtkWidget *sb_style_label(const char *text, const char *name, float align) {
  GtkWidget *label = gtk_label_new(text);
  gtk_label_set_xalign(GTK_LABEL(label), align);
  sb_style_class(label, name);
  gtk_widget_show(label);
  return label;
}

const SbTheme *sb_style_ground(cairo_t *cr, SbRole role) {
  const SbTheme *theme = sb_theme(sb_style_is_dark());
  const SbColor ground = theme->role[role];
  cairo_set_source_rgb(cr, ground.r, ground.g, ground.b);
  cairo_paint(cr);
  return theme;
}

void sb_style_window(GtkWidget *window) {
  g_autofree char *font = NULL;
  g_object_get(gtk_settings_get_default(), "gtk-font-name", &font, NULL);
  sb_style_class(window, "sb-window");
  if (font == NULL || g_str_has_prefix(font, "Sans ")) {
    sb_style_class(window, "sb-builtin-font");
  }
}
