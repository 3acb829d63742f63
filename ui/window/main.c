// sealbench-gtk: finds the translations and starts the application.
#include "ui/window/application.h"

#include "app/run/process.h"

#include <glib/gi18n.h>
#include <locale.h>

// The folder of the translations: beside the program as it was installed, wherever that was moved
// to, or, while it runs from where it was built, the build's own.
static char *locale_folder(void) {
  g_autofree char *program = g_file_read_link("/proc/self/exe", NULL);
  g_autofree char *in = g_path_get_dirname(program != NULL ? program : "/");
  char *built = g_build_filename(in, "..", "po", NULL);
  if (g_file_test(built, G_FILE_TEST_IS_DIR)) {
    return built;
  }
  g_free(built);
  return g_build_filename(in, SB_LOCALE_FROM_PROGRAM, NULL);
}

int main(int argc, char **argv) {
  sb_process_set_up();
  // Numbers look the same in every locale, as in the files.
  setlocale(LC_ALL, "");
  setlocale(LC_NUMERIC, "C");
  gtk_disable_setlocale();
  g_autofree char *translations = locale_folder();
  bindtextdomain("sealbench", translations);
  bind_textdomain_codeset("sealbench", "UTF-8");
  textdomain("sealbench");
  g_autoptr(SbApplication) application = sb_application_new();
  return g_application_run(G_APPLICATION(application), argc, argv);
}
