// sealbench-gtk: starts the application.
#include "ui/application.h"

#include <glib/gi18n.h>

int main(int argc, char **argv) {
  bindtextdomain("sealbench", SB_LOCALE_DIR);
  bind_textdomain_codeset("sealbench", "UTF-8");
  textdomain("sealbench");
  g_autoptr(SbApplication) application = sb_application_new();
  return g_application_run(G_APPLICATION(application), argc, argv);
}
