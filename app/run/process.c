// See process.h.
#include "app/run/process.h"

#include "app/lazy/lazy.h"

#include <cblas.h>
#include <dlfcn.h>
#include <fcntl.h>
#include <gsl/gsl_errno.h>
#include <malloc.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <unistd.h>

bool sb_process_has_memory(void) {
  // Taken once for the first solve and kept by OpenBLAS; without room it would wait for ever.
  const size_t area = (size_t)136 << 20;
  // The libraries take address space as well.
  struct rlimit limit;
  if (getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY &&
      sb_lazy_missing(&sb_lazy_algebra) != NULL) {
    return false;
  }
  void *room =
      mmap(NULL, area, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (room == MAP_FAILED) {
    return false;
  }
  munmap(room, area);
  // A product of matrices makes it take its area now, before anything else does.
  enum { N = 64 };
  static double a[N * N], b[N * N], c[N * N];
  cblas_dgemm(CblasColMajor, CblasNoTrans, CblasNoTrans, N, N, N, 1.0, a, N, b, N, 0.0, c, N);
  return true;
}

// Descriptors 0 to 2 that were closed at the start: the next file to be opened would become one,
// and messages would go into it. They lead nowhere from now on, the wrong way round, so that using
// them still fails.
static void open_standard_streams(void) {
  for (int fd = 0; fd <= 2; fd++) {
    if (fcntl(fd, F_GETFD) < 0 && open("/dev/null", fd == 0 ? O_WRONLY : O_RDONLY) != fd) {
      _exit(3);
    }
  }
}

// One thread for a solve: repeatable results, and the other cores are the drawing's. OpenBLAS reads
// the variable when it is loaded, which is at its first use (app/lazy) unless the program is linked
// with it.
static void use_one_thread(void) {
  setenv("OPENBLAS_NUM_THREADS", "1", 1);
  void (*set)(int) = NULL;
  void *address = dlsym(RTLD_DEFAULT, "openblas_set_num_threads");
  memcpy(&set, &address, sizeof set);
  if (set != NULL) {
    set(1);
  }
}

void sb_process_set_up(void) {
  open_standard_streams();
  // A reader that has gone, of progress or of results, is a failed write like any other.
  signal(SIGPIPE, SIG_IGN);
  // A limit on the size of files is a failed write like any other, not the program's end.
  signal(SIGXFSZ, SIG_IGN);
  use_one_thread();
  // A special function outside its domain must not end the program; the engine checks results.
  gsl_set_error_handler_off();
  // The factors of a ring take about 100 kB and are allocated at each of its steps. By default
  // their pages are returned to the system each time, which costs a fifth of a run with rings.
  mallopt(M_MMAP_THRESHOLD, 32 << 20);
  mallopt(M_TRIM_THRESHOLD, 256 << 20);
}

void sb_process_work_behind(void) {
  // On Linux a nice value belongs to the thread, and 0 names the calling one. Refused or not there:
  // no harm, only less fluent.
  (void)setpriority(PRIO_PROCESS, 0, getpriority(PRIO_PROCESS, 0) + 5);
}
