// What ships with the program; see the header.
#include "app/document/shipped.h"

#include <stdbool.h>
#include <string.h>

// The first of the places, from where the program lies, that has `name`; its whole path or its
// folder.
static char *find(const char *const *places, const char *name, bool whole) {
  g_autofree char *program = g_file_read_link("/proc/self/exe", NULL);
  g_autofree char *in = g_path_get_dirname(program != NULL ? program : "/");
  for (; *places != NULL; places++) {
    g_autofree char *there = g_build_filename(in, *places, NULL);
    g_autofree char *path = g_build_filename(there, name, NULL);
    if (g_file_test(path, G_FILE_TEST_EXISTS)) {
      return g_canonicalize_filename(whole ? path : there, NULL);
    }
  }
  return NULL;
}

char *sb_shipped_folder(void) {
  static const char *const places[] = {"../share/sealbench", "../assets", "../../assets", NULL};
  return find(places, "scenes", false);
}

char *sb_shipped_study(const char *name) {
  // The last is that of tests.
  static const char *const places[] = {"../share/sealbench/studies", "../assets/studies",
                                       "../../assets/studies", "../../../assets/studies", NULL};
  g_autofree char *file = g_strconcat(name, ".study", NULL);
  return find(places, file, true);
}

char *sb_shipped_thesis(void) {
  static const char *const places[] = {"../share/sealbench/thesis", "../assets/thesis",
                                       "../../assets/thesis", "../../../assets/thesis", NULL};
  return find(places, "valve.scene", false);
}

char *sb_shipped_find(const char *name) {
  g_autofree char *folder = sb_shipped_folder();
  if (folder == NULL || *name == '\0' || strchr(name, G_DIR_SEPARATOR) != NULL) {
    return NULL;
  }
  static const char *const kinds[][2] = {{"scenes", ".scene"}, {"valves", ".valve"}};
  for (size_t i = 0; i < G_N_ELEMENTS(kinds); i++) {
    g_autofree char *whole =
        g_str_has_suffix(name, kinds[i][1]) ? g_strdup(name) : g_strconcat(name, kinds[i][1], NULL);
    g_autofree char *path = g_build_filename(folder, kinds[i][0], whole, NULL);
    if (g_file_test(path, G_FILE_TEST_IS_REGULAR)) {
      return g_steal_pointer(&path);
    }
  }
  return NULL;
}

char *sb_shipped_runs(void) {
  static const char *const places[] = {"../share/sealbench/runs", ".", "..", NULL};
  return find(places, "piston.run", false);
}

static int by_name(const void *a, const void *b) {
  return strcmp(*(char *const *)a, *(char *const *)b);
}

GPtrArray *sb_shipped_scenes(void) {
  GPtrArray *out = g_ptr_array_new_with_free_func(g_free);
  g_autofree char *folder = sb_shipped_folder();
  g_autofree char *scenes = folder != NULL ? g_build_filename(folder, "scenes", NULL) : NULL;
  g_autoptr(GDir) dir = scenes != NULL ? g_dir_open(scenes, 0, NULL) : NULL;
  for (const char *name; dir != NULL && (name = g_dir_read_name(dir)) != NULL;) {
    if (g_str_has_suffix(name, ".scene")) {
      g_ptr_array_add(out, g_build_filename(scenes, name, NULL));
    }
  }
  g_ptr_array_sort(out, by_name);
  return out;
}
