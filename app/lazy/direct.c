// lazy.h where the program is linked with all libraries: Meson's option `lazy`.
#include "app/lazy/lazy.h"

#include <stddef.h>

struct SbLazyGroup {
  int unused;
};

SbLazyGroup sb_lazy_algebra, sb_lazy_video;

const char *sb_lazy_missing(SbLazyGroup *group) {
  return NULL;
}
