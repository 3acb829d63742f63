// Settings of the whole process and of its threads, the same for all programs (Linux).
#pragma once

#include <stdbool.h>

// Call it once, first in main(), before any thread is started. Opens standard streams that are
// closed (exit code 3 if that fails), ignores SIGPIPE and SIGXFSZ (writing then fails with an error
// code), sets OpenBLAS to one thread, switches off the error handler of GSL, and lets malloc() keep
// freed memory.
void sb_process_set_up(void);

// Returns whether the address space has room for the 136 MiB work area of OpenBLAS, and lets
// OpenBLAS allocate it. Without this room a solve would wait forever. Call it in the main thread,
// before the first solve and before other threads are started.
bool sb_process_has_memory(void);

// Lowers the priority of the calling thread by 5 nice levels until the thread ends; each call adds
// 5. For threads that compute in the background of a window. A failure is ignored.
void sb_process_work_behind(void);
