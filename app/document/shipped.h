// The valves and scenes that ship with the program, found from where the program lies: installed
// (../share/sealbench) or in its build folder (the sources' assets). Nothing is compiled in, so an
// installation may be moved.
#pragma once

#include <glib.h>

// Folder that holds valves/, scenes/ and series/; NULL if there is none. Owned by the caller.
char *sb_shipped_folder(void);

// Path of what ships as `name`, with or without its ending ("thesis-cycle", "piston.valve"); NULL
// if nothing does, or if `name` holds a folder. Owned by the caller.
char *sb_shipped_find(const char *name);

// Path of the study file NAME.study that ships; NULL if there is none. Owned by the caller.
char *sb_shipped_study(const char *name);

// Folder of the thesis' tables and figures (app/study/thesis_item.h); NULL if there is none. Owned
// by the caller.
char *sb_shipped_thesis(void);

// Folder of runs that were solved when the program was built (app/session/stored_run.h); NULL if
// there is none. Owned by the caller.
char *sb_shipped_runs(void);

// Paths of all scenes that ship, sorted by name. Owned by the caller; never NULL.
GPtrArray *sb_shipped_scenes(void);
