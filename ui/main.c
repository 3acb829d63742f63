// sealbench-gtk: starts the application.
#include "ui/application.h"

int main(int argc, char **argv) {
  g_autoptr(SbApplication) application = sb_application_new();
  return g_application_run(G_APPLICATION(application), argc, argv);
}
