// How long the program takes to start, compared with a program that does nothing.
#pragma once

#include "app/export/json.h"

enum { SB_START_UP_COMMANDS = 4 };

typedef struct {
  // Median of the processor times, user and system [s], of each command.
  double processor_s[SB_START_UP_COMMANDS];
  double empty_s;     // of /bin/true, an empty program that is linked dynamically [s]
  double limit_s;     // 15 ms, or 4 * empty_s if that is larger [s]
  int shared_objects; // that the program is linked with, those of its libraries included
} SbStartUp;

// Starts this program `repeats` times with each command, and /bin/true, after one warm-up. Returns
// false if one of them cannot be started.
bool sb_start_up_measure(SbStartUp *out, int repeats);

// Adds the member "start_up" to the object that is open.
void sb_start_up_put(SbJson *json, const SbStartUp *of);

void sb_start_up_print(const SbStartUp *of);
