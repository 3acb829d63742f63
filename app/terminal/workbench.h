// The workbench in a terminal: the same session as the window's, by keyboard and mouse.
#pragma once

#include "app/terminal/screen.h"

// What to open, and how.
typedef struct {
  const char *path;      // valve or scene; NULL: the shipped start scene
  SbScreenWishes screen; // requests to the terminal (screen.h)
  GPtrArray *issues;     // of SbIssue, borrowed: the errors of the file are appended
} SbWorkbenchOptions;

// Runs the workbench in the main thread and returns when the user leaves it or the terminal is
// closed; then true. Returns false if it cannot start: either the file has errors, which are
// appended to options->issues (*error is not set), or *error is SB_APP_ERROR_IO (no terminal, or
// this build has no workbench) or SB_APP_ERROR_INPUT (a type of terminal that cannot show it).
bool sb_workbench_run(const SbWorkbenchOptions *options, GError **error);
