// Libraries that a program opens at the first call of one of their functions instead of at its
// start.
//
// Sources include the headers of such a library and call its functions as usual. In place of the
// library a program is linked with one stub per function (stubs.py generates them from the
// undefined symbols of engine and app). A stub jumps through a table; at its first call it opens
// the library and stores the function's address there. If the library or the function is missing,
// the program prints that and ends with exit code 3, as it would otherwise not start at all. Safe
// in all threads.
#pragma once

// Libraries that depend on each other; they are opened together. The groups are named in
// meson.build.
typedef struct SbLazyGroup SbLazyGroup;

// Opens a group without a call, for a feature that a program can be without. Returns NULL, or why
// the group cannot be opened: a text of the calling thread until its next call.
const char *sb_lazy_missing(SbLazyGroup *group);

extern SbLazyGroup sb_lazy_algebra; // OpenBLAS and LAPACKE
extern SbLazyGroup sb_lazy_video;   // libav
