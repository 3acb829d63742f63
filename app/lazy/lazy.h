// Libraries that a program opens at the first call of one of their functions instead of at its
// start.
//
// Sources include the headers of such a library and call its functions as usual. In place of the
// library a program is linked with one stub per function (stubs.py generates them from the
// undefined symbols of engine and app). A stub jumps through a table; at its first call it opens
// the library and stores the function's address there. If the library or the function is missing,
// the stub prints that to standard error and ends the program with exit code 3. A feature that a
// program can be without therefore calls sb_lazy_missing() before its first call of the library.
//
// All functions here and all stubs may be called from any thread at any time.
#pragma once

// A set of libraries that depend on each other; they are opened together and never closed. The
// groups are named in meson.build.
typedef struct SbLazyGroup SbLazyGroup;

// Opens a group if it is not open yet. Returns NULL if the group is open, so that its functions can
// be called. Otherwise returns the reason as a sentence of the dynamic linker; the text belongs to
// the calling thread and is valid until this thread's next call of sb_lazy_missing() or dlerror().
const char *sb_lazy_missing(SbLazyGroup *group);

extern SbLazyGroup sb_lazy_algebra; // OpenBLAS and LAPACKE
extern SbLazyGroup sb_lazy_video;   // libav
