// The part of the stubs that opens libraries; see the header.
#include "app/lazy/lazy.h"

#include <dlfcn.h>
#include <errno.h>
#include <stddef.h>
#include <stdio.h>
#include <unistd.h>

typedef struct {
  const char *name; // soname
  void *handle;     // NULL until it is opened; of dlopen(), never closed
} Library;

struct SbLazyGroup {
  Library *library; // in the order in which they are opened; ends with a name of NULL
  int flags;        // of dlopen()
};

typedef struct {
  const char *name;
  SbLazyGroup *group;
  Library *library; // of the group
} Function;

// Defines the groups, and `functions` in the order of sb_lazy_address.
#include "lazy_tables.h"

// Address that each stub jumps to (lazy_stubs.S): first of a part that calls sb_lazy_find().
extern void *sb_lazy_address[];
void *sb_lazy_find(size_t index);

const char *sb_lazy_missing(SbLazyGroup *group) {
  for (Library *library = group->library; library->name != NULL; library++) {
    if (__atomic_load_n(&library->handle, __ATOMIC_ACQUIRE) == NULL) {
      void *handle = dlopen(library->name, RTLD_LAZY | group->flags);
      if (handle == NULL) {
        return dlerror();
      }
      __atomic_store_n(&library->handle, handle, __ATOMIC_RELEASE);
    }
  }
  return NULL;
}

// Returns the function of a stub that is called for the first time.
void *sb_lazy_find(size_t index) {
  const int caller_errno = errno;
  const Function *function = &functions[index];
  const char *problem = sb_lazy_missing(function->group);
  void *address = problem == NULL ? dlsym(function->library->handle, function->name) : NULL;
  if (address == NULL) {
    fprintf(stderr, "sealbench: a library of the program cannot be used: %s\n",
            problem != NULL ? problem : dlerror());
    _exit(3);
  }
  __atomic_store_n(&sb_lazy_address[index], address, __ATOMIC_RELEASE);
  errno = caller_errno;
  return address;
}
