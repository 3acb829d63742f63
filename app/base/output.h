// The one writer of everything that the programs write: a file appears whole or not at all.
//
// It is written without a name in its target's folder (O_TMPFILE; where the file system has none,
// under a random hidden name that is locked while its writer lives), synced, then given its name. A
// symbolic link is followed and stays. What is replaced passes on its mode and ownership; where
// that cannot be (a file with several names, another's file, an access list) the complete new bytes
// are copied into the old file, which is the one case that a crash or a failing disk can tear.
// Devices, pipes and "-" (standard output) get the complete bytes at the end.
#pragma once

#include "app/base/error.h"

#include <stdbool.h>
#include <stdio.h>

struct stat;

// ---- What a program may write to; set once at its start ----

// From now on files that were read (sb_output_note_input) are refused as outputs.
void sb_output_protect_inputs(void);
void sb_output_note_input(const struct stat *info);

// Whether files that exist are refused as outputs.
void sb_output_keep_existing(bool keep);

// True while files get their names, which takes no time to speak of; a signal handler may ask.
bool sb_output_is_committing(void);

// In capitals or not, as all writers take them.
bool sb_output_ends_in(const char *path, const char *ending);

// ---- One file ----

typedef struct {
  char *path;       // as given, for messages
  char *name;       // in the folder; NULL for a device or pipe
  char *temporary;  // in the folder; NULL while it has no name
  char *written_at; // a path at which others can open the bytes now
  FILE *stream;     // to write to; NULL when finished. Writers may ignore errors until commit
  int folder;       // descriptor, or that of a device or pipe
  bool own_way;     // a manifest, which no policy forbids
} SbOutput;

// Begins a file. SB_APP_ERROR_INPUT for an input or, if those are kept, a file that exists;
// SB_APP_ERROR_IO for what cannot be written. *out needs no clean-up then.
bool sb_output_begin(SbOutput *out, const char *path, GError **error);

// Flushes and syncs: the step that finds a full disk. On failure everything is removed.
bool sb_output_seal(SbOutput *out, GError **error);

// Seals, then gives the file its name. On failure nothing of it remains and an earlier file is
// intact.
bool sb_output_commit(SbOutput *out, GError **error);

// Removes what was not committed. Does nothing afterwards, nor to a zeroed struct.
void sb_output_abort(SbOutput *out);

// All of that for a text in memory.
bool sb_output_write(const char *path, const void *text, size_t length, GError **error);

// The same for a file that others can tell is in use: *lock is a descriptor that keeps it locked
// (flock) until it is closed, by the process' end at the latest.
bool sb_output_write_locked(int *lock, const char *path, const void *text, size_t length,
                            GError **error);
bool sb_output_is_locked(const char *path);

// ---- Several files of one result in a folder ----

// The folder is locked (flock, which ends with its process) from opening to closing, so that its
// files come from one run. With a command's name a hidden manifest (".sealbench-COMMAND.manifest":
// a SHA-256 and a name a line) says which files are that command's: those of an earlier result that
// the new one does not have are removed, unless they were changed since.
typedef struct SbOutputFolder SbOutputFolder;

// Makes the folder if needed, and waits up to 10 s for its lock. SB_APP_ERROR_IO. `command` may be
// NULL: no manifest.
bool sb_output_folder_open(SbOutputFolder **out, const char *path, const char *command,
                           GError **error);

// Begins a file of the folder; the stream is borrowed and written to before the next call.
bool sb_output_folder_add(FILE **stream, SbOutputFolder *folder, const char *name, GError **error);

// Seals all that were added, then gives all their names.
bool sb_output_folder_commit(SbOutputFolder *folder, GError **error);

// The result is complete: removes files of the former one. Names of those kept because they were
// changed are added to `kept` (char *; NULL: nobody asks).
bool sb_output_folder_finish(SbOutputFolder *folder, GPtrArray *kept, GError **error);

// Unlocks; without a finish the former files stay and are remembered. Takes NULL.
void sb_output_folder_close(SbOutputFolder *folder);

// ---- Before the work ----

// Targets of a command, tested before it computes. A zeroed struct is empty.
typedef struct {
  GPtrArray *targets; // identities seen
} SbOutputCheck;

// Whether `path` can be written: not an input (SB_APP_ERROR_INPUT), not the same as one checked
// before, its folder writable (SB_APP_ERROR_IO). `makes_folder`: missing folders will be made. NULL
// and "-" are fine.
bool sb_output_check(SbOutputCheck *check, const char *path, bool makes_folder, GError **error);
void sb_output_check_clear(SbOutputCheck *check);
