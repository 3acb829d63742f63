// sealbench-gtk: starts the application.
#include "ui/window/application.h"

#include "app/base/translation.h"
#include "app/run/process.h"

#include <locale.h>

int main(int argc, char **argv) {
  sb_process_set_up();
  // Numbers look the same in every locale, as in the files.
  setlocale(LC_ALL, "");
  setlocale(LC_NUMERIC, "C");
  gtk_disable_setlocale();
  sb_translation_begin();
  g_autoptr(SbApplication) application = sb_application_new();
  return g_application_run(G_APPLICATION(application), argc, argv);
}
