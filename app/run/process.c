// See process.h.
#include "app/run/process.h"

#include <cblas.h>
#include <gsl/gsl_errno.h>
#include <malloc.h>
#include <signal.h>
#include <sys/resource.h>

void sb_process_set_up(void) {
  // A limit on the size of files is a failed write like any other, not the program's end.
  signal(SIGXFSZ, SIG_IGN);
  // One thread for a solve: repeatable results, and the other cores are the drawing's.
  openblas_set_num_threads(1);
  // A special function outside its domain must not end the program; the engine checks results.
  gsl_set_error_handler_off();
  // A ring's factors are some 100 kB, made anew at each of its steps. By default their pages go
  // back to the system each time, which costs a fifth of a run with rings.
  mallopt(M_MMAP_THRESHOLD, 32 << 20);
  mallopt(M_TRIM_THRESHOLD, 32 << 20);
}

void sb_process_work_behind(void) {
  // On Linux a nice value belongs to the thread, and 0 names the calling one. Refused or not there:
  // no harm, only less fluent.
  (void)setpriority(PRIO_PROCESS, 0, getpriority(PRIO_PROCESS, 0) + 5);
}
