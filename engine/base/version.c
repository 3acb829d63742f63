// The version, as the build system knows it.
#include "engine/valve/sealbench.h"

const char *sb_version(void) {
  return SB_VERSION;
}
