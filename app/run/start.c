// What happens before a program's libraries are set up: of the programs alone, never of a library.
#include <sys/resource.h>
#include <unistd.h>

#define THREADS "OPENBLAS_NUM_THREADS"

// OpenBLAS starts its threads while it is loaded, and each of them waits for ever for a work area
// of 128 MiB where a limit on the address space leaves no room for it. Their number is read from
// the environment, so under such a limit the program starts once more with one. This runs before
// the libraries are set up: nothing but system calls, and nothing for a sanitizer to look at.
__attribute__((no_sanitize("address", "undefined", "thread"))) static void
start_with_one_thread(int argc, char **argv, char **environment) {
  enum { VARIABLES_MAX = 4096 };
  static char *with[VARIABLES_MAX + 2];
  static char one[] = THREADS "=1";
  struct rlimit limit;
  if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) {
    return;
  }
  int count = 0;
  for (; environment[count] != NULL; count++) {
    const char *name = THREADS "=", *c = environment[count];
    while (*name != '\0' && *name == *c) {
      name++;
      c++;
    }
    if (*name == '\0' || count == VARIABLES_MAX) {
      return;
    }
    with[count] = environment[count];
  }
  with[count] = one;
  execve("/proc/self/exe", argv, with);
}

typedef void Start(int argc, char **argv, char **environment);
__attribute__((section(".preinit_array"), used)) static Start *const start = start_with_one_thread;
