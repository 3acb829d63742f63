// A file that appears whole or not at all: written beside its final place, synced, then renamed.
#pragma once

#include "app/document/unit.h"

#include <stdio.h>

typedef struct {
  char *path;      // final path
  char *temporary; // where it is written now; NULL for a device or pipe, written directly
  FILE *stream;    // to write to; NULL when finished. Writers may ignore errors until commit
} SbAtomicFile;

// Opens a temporary file beside `path` and removes what a killed process left there for the same
// path. False with SB_APP_ERROR_IO if that is not possible; *out needs no clean-up then.
bool sb_atomic_file_begin(SbAtomicFile *out, const char *path, GError **error);

// Flushes, syncs and closes, but leaves the file under its temporary name: the step that finds a
// full disk. On failure everything is removed.
bool sb_atomic_file_seal(SbAtomicFile *file, GError **error);

// Seals if that was not done, then renames. On failure nothing of it remains and an earlier file
// is intact.
bool sb_atomic_file_commit(SbAtomicFile *file, GError **error);

// Removes the temporary file. Does nothing after commit.
void sb_atomic_file_abort(SbAtomicFile *file);

// All of that for a text in memory.
bool sb_atomic_write(const char *path, const char *text, size_t length, GError **error);
