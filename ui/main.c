// sealbench-gtk: starts the application.
#include "ui/application.h"

#include <cblas.h>
#include <gsl/gsl_errno.h>
#include <locale.h>

int main(int argc, char **argv) {
  // Numbers look the same in every locale, as in the files.
  setlocale(LC_ALL, "");
  setlocale(LC_NUMERIC, "C");
  gtk_disable_setlocale();
  // One thread for a solve: repeatable results, and the second core is the window's.
  openblas_set_num_threads(1);
  // A special function outside its domain must not end the program; the engine checks results.
  gsl_set_error_handler_off();
  g_autoptr(SbApplication) application = sb_application_new();
  return g_application_run(G_APPLICATION(application), argc, argv);
}
