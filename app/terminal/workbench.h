// The workbench in a terminal: the same session as the window's, by keyboard and mouse.
#pragma once

#include "app/terminal/screen.h"

typedef struct {
  const char *path; // valve or scene; NULL: the one that ships
  SbScreenWishes screen;
} SbWorkbenchOptions;

// Runs until the user leaves it, or the terminal goes. SB_APP_ERROR_INPUT (the file),
// SB_APP_ERROR_IO (no terminal; this build has no workbench).
bool sb_workbench_run(const SbWorkbenchOptions *options, GError **error);
