// See version.h. The build writes identity.h (engine/identity.py); no other file includes it.
#include "engine/base/version.h"

#include "engine/base/identity.h"

#include <stddef.h>

const SbEngineIdentity *sb_engine_identity(void) {
  static const SbEngineIdentity identity = {
      .version = SB_VERSION, .source = SB_SOURCE_HASH, .commit = SB_COMMIT, .options = SB_OPTIONS};
  return &identity;
}

const char *sb_version(void) {
  return SB_VERSION;
}
