// Writes all files of the programs atomically: a file appears complete or not at all.
//
// A file is written without a name in its folder (O_TMPFILE; if the file system does not support
// it, with a random hidden name that is locked while its process runs), synced, and then given its
// name. A symbolic link is followed and stays. The new file gets mode and owner of the one that it
// replaces; if that is impossible (a file with several names, another user's file, an access list),
// the complete new bytes are copied into the old file, the only case in which a crash can leave an
// incomplete file. Devices, pipes and "-" (standard output) receive the complete bytes at the end.
//
// Functions with a GError return false with an error: SB_APP_ERROR_INPUT if the path is refused (an
// input, or an existing file with sb_output_keep_existing()), else SB_APP_ERROR_IO. Different files
// may be written by several threads at the same time.
#pragma once

#include "app/base/error.h"

#include <stdbool.h>
#include <stdio.h>

struct stat;

// ---- Which files may be written; set once at the start of the program ----

// Refuses from now on to write files that sb_output_note_input() records. Without this call inputs
// may be overwritten.
void sb_output_protect_inputs(void);

// Records a file that was read, by its device and inode; `info` is the result of fstat(). Does
// nothing before sb_output_protect_inputs().
void sb_output_note_input(const struct stat *info);

// Sets whether existing files are refused as outputs; initially they are replaced.
void sb_output_keep_existing(bool keep);

// Returns whether files are being given their names at the moment, which takes very little time.
// May be called by a signal handler.
bool sb_output_is_committing(void);

// Returns whether `path` has the ending ".png" or the like, ignoring case.
bool sb_output_ends_in(const char *path, const char *ending);

// ---- One file ----

// A file that is being written. After a successful sb_output_begin() it must be committed or
// aborted.
typedef struct {
  char *path;       // as given, for messages
  char *name;       // in the folder; NULL for a device or pipe
  char *temporary;  // in the folder; NULL while it has no name
  char *written_at; // path at which other code can open the unfinished file
  FILE *stream;     // to write to; errors may be ignored until the commit; NULL when finished
  int folder;       // descriptor of the folder, or of a device or pipe
  bool own_way;     // a manifest, which is never refused
} SbOutput;

// Begins a file. Fails with SB_APP_ERROR_INPUT if it is an input or an existing file that is
// refused, or with SB_APP_ERROR_IO; *out then owns nothing.
bool sb_output_begin(SbOutput *out, const char *path, GError **error);

// Flushes and syncs, which detects a full disk before sb_output_commit() (which does both again);
// the file does not have its name yet. After a failure the unfinished file is removed and *out owns
// nothing.
bool sb_output_seal(SbOutput *out, GError **error);

// Flushes, syncs and gives the file its name. *out owns nothing afterwards. After a failure the
// unfinished file is removed and an earlier file is intact.
bool sb_output_commit(SbOutput *out, GError **error);

// Removes a file that was not committed. Does nothing for one that was, and for all zeros.
void sb_output_abort(SbOutput *out);

// Writes `length` bytes to the file `path` atomically.
bool sb_output_write(const char *path, const void *text, size_t length, GError **error);

// As sb_output_write(), with a lock (flock) on the file. *lock is the descriptor that holds the
// lock until the caller closes it or the process ends.
bool sb_output_write_locked(int *lock, const char *path, const void *text, size_t length,
                            GError **error);

// Returns whether a process holds such a lock on the file.
bool sb_output_is_locked(const char *path);

// ---- Several files of one result in a folder ----

// A folder that is being written. It is locked (flock) from opening to closing, so that its files
// come from one run. With a command's name, a hidden manifest (".sealbench-COMMAND.manifest": a
// SHA-256 and a name on each line) lists the files of that command: files of an earlier result that
// the new one does not have are removed, unless they were changed since.
typedef struct SbOutputFolder SbOutputFolder;

// Creates the folder if needed and waits up to 10 s for its lock. `command` NULL: no manifest.
// Closed by sb_output_folder_close().
bool sb_output_folder_open(SbOutputFolder **out, const char *path, const char *command,
                           GError **error);

// Begins the file `name` (without a path) in the folder. *stream is borrowed; write to it before
// the next call of a function of the folder. After a failure the folder and its other files can
// still be used.
bool sb_output_folder_add(FILE **stream, SbOutputFolder *folder, const char *name, GError **error);

// Adds a file with a text (sb_output_folder_add()).
bool sb_output_folder_add_text(SbOutputFolder *folder, const char *name, const char *text,
                               GError **error);

// Flushes and syncs all files that were added since the last commit, and then gives all their
// names. After a failure the files without a name are removed; files of earlier commits stay. The
// streams are closed in any case.
bool sb_output_folder_commit(SbOutputFolder *folder, GError **error);

// To be called once after the last commit, when the result is complete: removes the files of the
// earlier result and writes the manifest. Does nothing without a manifest, without committed files,
// or if existing files are refused. The names of files that were changed and therefore not removed
// are appended to `kept` (of char * with g_free() as its free function; NULL: not wanted).
bool sb_output_folder_finish(SbOutputFolder *folder, GPtrArray *kept, GError **error);

// Unlocks and frees the folder. Without sb_output_folder_finish() the earlier files stay and remain
// in the manifest. Takes NULL.
void sb_output_folder_close(SbOutputFolder *folder);

// Adds the files of a result to the folder. Returns false with an error.
typedef bool (*SbOutputFill)(SbOutputFolder *folder, void *data, GError **error);

// Writes a folder as one result: opens it, calls `fill` once with `data`, commits, finishes with
// `kept`, and closes it. `command` and `kept` may be NULL, as in the functions above. If a step
// fails, the remaining ones are omitted and the folder is closed.
bool sb_output_folder_write(const char *path, const char *command, SbOutputFill fill, void *data,
                            GPtrArray *kept, GError **error);

// ---- Before the work ----

// Targets of a command, checked before it computes. Initialise with zeros.
typedef struct {
  GPtrArray *targets; // identities of the targets checked so far
} SbOutputCheck;

// Returns whether `path` can be written. Fails with SB_APP_ERROR_INPUT if it is an input, a target
// that was checked before, or an existing file with sb_output_keep_existing(); with SB_APP_ERROR_IO
// if it is a folder, or if it or its folder cannot be written. `makes_folder`: missing folders will
// be created (else their absence is an error). NULL, "-", devices and pipes can always be written.
bool sb_output_check(SbOutputCheck *check, const char *path, bool makes_folder, GError **error);

// Frees what the checks own.
void sb_output_check_clear(SbOutputCheck *check);
