// What the program remembers between sessions. The file is small and read once; each change is
// written at once, by way of a temporary file (g_file_set_contents).
#include "ui/window/preferences.h"

static GKeyFile *store;

static char *path(void) {
  return g_build_filename(g_get_user_config_dir(), "sealbench", "window.ini", NULL);
}

static GKeyFile *load(void) {
  if (store == NULL) {
    store = g_key_file_new();
    g_autofree char *file = path();
    g_key_file_load_from_file(store, file, G_KEY_FILE_KEEP_COMMENTS, NULL);
  }
  return store;
}

static void save(void) {
  g_autofree char *file = path();
  g_autofree char *folder = g_path_get_dirname(file);
  g_mkdir_with_parents(folder, 0700);
  g_key_file_save_to_file(store, file, NULL);
}

char *sb_preferences_string(const char *key, const char *fallback) {
  char *value = g_key_file_get_string(load(), "window", key, NULL);
  return value != NULL ? value : g_strdup(fallback);
}

void sb_preferences_set_string(const char *key, const char *value) {
  g_key_file_set_string(load(), "window", key, value);
  save();
}

int sb_preferences_int(const char *key, int fallback) {
  g_autoptr(GError) error = NULL;
  int value = g_key_file_get_integer(load(), "window", key, &error);
  return error == NULL ? value : fallback;
}

void sb_preferences_set_int(const char *key, int value) {
  g_key_file_set_integer(load(), "window", key, value);
  save();
}
