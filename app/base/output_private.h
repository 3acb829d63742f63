// Shared by output.c (one file), output_check.c (checks before the work) and output_folder.c
// (several files).
//
// Order of calls for a file: sb_output_begin_at(), write to out->stream, sb_output_seal() and
// sb_output_commit_sealed(), or sb_output_abort() (output.h). All four leave *out empty (path NULL)
// when the file is finished or the call failed; an empty *out owns nothing and may be aborted.
#pragma once

#include "app/base/output.h"

// Sets an error of `kind` with the message "PATH: TEXT". Always returns false. `text` is not NULL.
bool sb_output_fail(GError **error, SbAppError kind, const char *path, const char *text);

// Sets an SB_APP_ERROR_IO with the message of the system for `code` (errno). Always returns false.
bool sb_output_fail_errno(GError **error, const char *path, int code);

// Returns whether the regular file `path`, whose state is `info`, may be replaced; false with an
// error if it is an input, existing files are refused, or it cannot be written.
bool sb_output_may_replace(const char *path, const struct stat *info, GError **error);

// Returns the file that `path` leads to by symbolic links, which need not exist; NULL with errno
// ELOOP for a loop. Freed with g_free().
char *sb_output_follow(const char *path);

// Returns whether a path means a descriptor that is open already ("-", /dev/stdout, ...).
bool sb_output_names_descriptor(const char *path);

// Opens a new temporary file in a folder (open descriptor), locked. Returns its descriptor; −1 with
// errno. Sets *name to its name, freed with g_free(); NULL: the file has no name.
int sb_output_open_temporary(char **name, int folder);

// Returns whether existing files are refused as outputs (sb_output_keep_existing()).
bool sb_output_keeps_existing(void);

// As sb_output_begin(). `own_way`: existing files and inputs are not refused (a manifest). `sweep`:
// first calls sb_output_sweep() for the file's folder.
bool sb_output_begin_at(SbOutput *out, const char *path, bool own_way, bool sweep, GError **error);

// Gives a file its name that sb_output_seal() has flushed successfully: the second half of
// sb_output_commit(). *out is then empty, also after a failure, which removes the unfinished file.
// Returns false with SB_APP_ERROR_IO, or with SB_APP_ERROR_INPUT if the file has appeared meanwhile
// and existing files are refused.
bool sb_output_commit_sealed(SbOutput *out, GError **error);

// Removes from a folder the temporary files whose process has ended. `folder` is an open descriptor
// of it, which stays open. Errors are ignored.
void sb_output_sweep(int folder);
