// See version.h.
#include "engine/base/version.h"

const char *sb_version(void) {
  return SB_VERSION;
}
