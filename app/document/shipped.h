// The files that ship with the program, found relative to the program: installed
// (../share/sealbench) or in its build folder (the sources' assets). No path is compiled in, so an
// installation may be moved.
#pragma once

#include <glib.h>
#include <stdbool.h>

// Kinds of files that ship, in the order in which a name is looked up.
typedef enum {
  SB_SHIPPED_SCENES,
  SB_SHIPPED_VALVES,
  SB_SHIPPED_STUDIES,
  SB_SHIPPED_RUBBERS,
  SB_SHIPPED_EXAMPLES, // scans, drawings, meshes and loops; named with their endings
  SB_SHIPPED_KINDS
} SbShippedKind;

// Sets of kinds, bits 1 << SbShippedKind: what a run, a study, an import or `sealbench check` may
// name.
enum {
  SB_SHIPPED_FOR_RUN = 1 << SB_SHIPPED_SCENES | 1 << SB_SHIPPED_VALVES,
  SB_SHIPPED_FOR_STUDY = 1 << SB_SHIPPED_STUDIES,
  SB_SHIPPED_FOR_IMPORT = 1 << SB_SHIPPED_EXAMPLES, // what `surface`, `cad` and --measured read
  SB_SHIPPED_ANY = (1 << SB_SHIPPED_KINDS) - 1
};

// Returns the name of a kind in the plural and of its folder ("scenes"). Static.
const char *sb_shipped_kind_name(SbShippedKind kind);

// Makes sb_shipped_folder() search relative to a shared library at `path` in place of the program,
// which is another one's (an interpreter, for example). Call it once, before the other functions.
void sb_shipped_set_library(const char *path);

// Returns the folder that holds scenes/, valves/, studies/, rubbers/, examples/ and series/; NULL
// if there is none.
char *sb_shipped_folder(void);

// Returns the path of the shipped file of one of the `wanted` kinds (bits 1 << SbShippedKind) that
// has this name without ending ("thesis-cycle"), or of the example of this name ("valve.dxf"); NULL
// if there is none.
char *sb_shipped_find(const char *name, unsigned wanted);

// Returns whether a file name has the ending of one of the `wanted` kinds. Examples have no common
// ending.
bool sb_shipped_has_ending(const char *name, unsigned wanted);

// Returns the path that an operand of a command names: a file that exists under `operand`, or "-",
// is used as it is. Otherwise the shipped file of that name (see sb_shipped_find()) is used. If
// there is neither, the result is a copy of `operand`, which cannot be opened.
char *sb_shipped_resolve(const char *operand, unsigned wanted);

// Returns the paths (char *) of all files of a kind that ship, sorted by name. Never NULL.
GPtrArray *sb_shipped_files(SbShippedKind kind);

// Returns the title of a shipped file: of a key file [sealbench] title, of an example that of
// examples/titles.ini; without one its name.
char *sb_shipped_title(const char *path);

// Returns the name by which a path of sb_shipped_files() is given to a command: without folder and
// ending (examples with their ending).
char *sb_shipped_name(const char *path, SbShippedKind kind);

// Returns the path of the study file NAME.study that ships; NULL if there is none. Unlike
// sb_shipped_find() it also works in the programs of the tests.
char *sb_shipped_study(const char *name);

// Returns the folder of the thesis' tables and figures (app/study/thesis_item.h); NULL if there is
// none.
char *sb_shipped_thesis(void);

// Returns the folder of runs that were computed when the program was built
// (app/session/stored_run.h); NULL if there is none.
char *sb_shipped_runs(void);
