// Without libtickit and libchafa there is no workbench in a terminal. See workbench.h.
#include "app/terminal/workbench.h"

bool sb_workbench_run(const SbWorkbenchOptions *options, GError **error) {
  g_set_error(error, SB_APP_ERROR, SB_APP_ERROR_IO,
              "this build of Sealbench has no workbench in a terminal: Meson's option `terminal`, "
              "which needs libtickit-dev and libchafa-dev");
  return false;
}
