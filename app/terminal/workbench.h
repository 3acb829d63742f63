// The workbench in a terminal: the same session as the window's, by keyboard and mouse.
#pragma once

#include "app/terminal/screen.h"

typedef struct {
  const char *path; // valve or scene; NULL: the one that ships
  SbScreenWishes screen;
  GPtrArray *issues; // of SbIssue: receives the errors of the file; borrowed
} SbWorkbenchOptions;

// Runs until the user leaves it, or the terminal goes. On failure either the file has errors, which
// are added to `issues`, or *error is SB_APP_ERROR_IO (no terminal; this build has no workbench) or
// SB_APP_ERROR_INPUT (a type of terminal that cannot show it).
bool sb_workbench_run(const SbWorkbenchOptions *options, GError **error);
