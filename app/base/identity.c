// See identity.h.
#include "app/base/identity.h"

#include "engine/base/version.h"

#include <glib.h>
#include <stdbool.h>

char *sb_identity_text(void) {
  const SbEngineIdentity *engine = sb_engine_identity();
  const bool known = engine->commit != NULL;
  return g_strdup_printf("Sealbench %s, engine %s%s%s", engine->version, engine->source,
                         known ? ", commit " : "", known ? engine->commit : "");
}
