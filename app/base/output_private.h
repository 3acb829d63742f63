// Shared by output.c (one file) and output_folder.c (several files).
#pragma once

#include "app/base/output.h"

// Sets an error with the path and `text`, or if that is NULL the text of errno. Always returns
// false.
bool sb_output_fail(GError **error, SbAppError kind, const char *path, const char *text);

// Returns whether existing files are refused as outputs (sb_output_keep_existing()).
bool sb_output_keeps_existing(void);

// As sb_output_begin(). `own_way`: existing files and inputs are not refused (a manifest). `sweep`:
// first removes temporary files of killed processes from the folder.
bool sb_output_begin_at(SbOutput *out, const char *path, bool own_way, bool sweep, GError **error);

// Gives a sealed file its name: the second half of sb_output_commit(). Returns false with
// SB_APP_ERROR_IO.
bool sb_output_commit_sealed(SbOutput *out, GError **error);

// Removes from the folder (a descriptor) temporary files whose process does not exist any more.
void sb_output_sweep(int folder);

// Returns a random hidden file name.
char *sb_output_temporary_name(void);
