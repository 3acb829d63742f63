// See process.h.
#include "app/run/process.h"

#include <cblas.h>
#include <fcntl.h>
#include <gsl/gsl_errno.h>
#include <malloc.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <unistd.h>

bool sb_process_has_memory(void) {
  // Taken once for the first solve and kept by OpenBLAS; without room it would wait for ever.
  const size_t area = (size_t)136 << 20;
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

void sb_process_set_up(void) {
  open_standard_streams();
  // A reader that has gone, of progress or of results, is a failed write like any other.
  signal(SIGPIPE, SIG_IGN);
  // A limit on the size of files is a failed write like any other, not the program's end.
  signal(SIGXFSZ, SIG_IGN);
  // One thread for a solve: repeatable results, and the other cores are the drawing's.
  openblas_set_num_threads(1);
  // A special function outside its domain must not end the program; the engine checks results.
  gsl_set_error_handler_off();
  // A ring's factors are some 100 kB, made anew at each of its steps. By default their pages go
  // back to the system each time, which costs a fifth of a run with rings.
  mallopt(M_MMAP_THRESHOLD, 32 << 20);
  mallopt(M_TRIM_THRESHOLD, 256 << 20);
}

void sb_process_work_behind(void) {
  // On Linux a nice value belongs to the thread, and 0 names the calling one. Refused or not there:
  // no harm, only less fluent.
  (void)setpriority(PRIO_PROCESS, 0, getpriority(PRIO_PROCESS, 0) + 5);
}
