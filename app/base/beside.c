// See beside.h.
#include "app/base/beside.h"

#include <glib.h>

char *sb_beside_program(const char *const *places, const char *name) {
  g_autofree char *program = g_file_read_link("/proc/self/exe", NULL);
  g_autofree char *in = g_path_get_dirname(program != NULL ? program : "/");
  for (; *places != NULL; places++) {
    g_autofree char *path = g_build_filename(in, *places, name, NULL);
    if (g_file_test(path, G_FILE_TEST_EXISTS)) {
      return g_steal_pointer(&path);
    }
  }
  return NULL;
}
