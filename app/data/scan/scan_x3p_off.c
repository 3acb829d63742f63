// In place of scan_x3p.c where libzip was not there at the build.
#include "app/data/scan/scan_private.h"

bool sb_scan_parse_x3p(SbScan *out, SbScanBytes file, const SbScanChoices *wish, GError **error) {
  return sb_app_error_input(error, "is a zip (X3P), and this build of Sealbench does not read "
                                   "those (Meson's option `x3p`: libzip)");
}
