// What holds for the whole process, whichever program it is.
#pragma once

#include <stdbool.h>

// Settings of the libraries below the engine. Once, first thing in main().
void sb_process_set_up(void);

// Whether the address space has room for the work area of dense solvers, which is then taken: later
// solves of this thread need no more of it. To be asked before them; without it they never end.
bool sb_process_has_memory(void);

// Gives the calling thread a lower priority for the rest of its life, so that where processors are
// short the thread that answers the user goes first. For threads that compute behind a window.
void sb_process_work_behind(void);
