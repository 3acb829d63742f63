// Time that the program needs to start, compared with a program that does nothing.
#pragma once

#include "app/table/json.h"

// Number of commands that are measured: --version, --help, run --help and list params.
enum { SB_START_UP_COMMANDS = 4 };

typedef struct {
  // Median of the processor times, user and system, of each command [s].
  double processor_s[SB_START_UP_COMMANDS];
  double empty_s;     // of /bin/true, an empty program that is linked dynamically [s]
  double limit_s;     // 15 ms, or 4 * empty_s if that is larger [s]
  int shared_objects; // libraries that the dynamic linker loads at the start; 0: not known
} SbStartUp;

// Starts this program (the file of the running process) `repeats` > 0 times with each command, and
// /bin/true as often, after one warm-up; waits for all of them. Returns false if one of them cannot
// be started.
bool sb_start_up_measure(SbStartUp *out, int repeats);

// Adds the member "start_up" to the object that is open in `json`.
void sb_start_up_put(SbJson *json, const SbStartUp *of);

// Prints the times as a table on standard output.
void sb_start_up_print(const SbStartUp *of);
