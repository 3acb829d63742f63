// Loading of the function table.
#include "app/section/gl_api.h"

#include <string.h>

bool sb_gl_api_load(SbGlApi *api, SbGlGetProc get_proc, void *data, const char **missing) {
  // A data pointer becomes a function pointer by copying: POSIX allows it, ISO C has no cast.
#define SB_GL_LOAD(type, name)                                                                     \
  {                                                                                                \
    void *address = get_proc(data, "gl" #name);                                                    \
    if (address == NULL) {                                                                         \
      *missing = "gl" #name;                                                                       \
      return false;                                                                                \
    }                                                                                              \
    memcpy(&api->name, &address, sizeof address);                                                  \
  }
  SB_GL_FUNCTIONS(SB_GL_LOAD)
#undef SB_GL_LOAD
  *missing = NULL;
  return true;
}
