// Inside of the writer, shared by output.c (one file) and output_folder.c (several).
#pragma once

#include "app/base/output.h"

bool sb_output_fail(GError **error, SbAppError kind, const char *path, const char *text);

bool sb_output_keeps_existing(void);

// As sb_output_begin(); `own_way` is free of the policy, `sweep` looks for what killed processes
// left in the folder.
bool sb_output_begin_at(SbOutput *out, const char *path, bool own_way, bool sweep, GError **error);

// The second half of sb_output_commit().
bool sb_output_commit_sealed(SbOutput *out, GError **error);

// Removes temporary files whose writer does not live any more.
void sb_output_sweep(int folder);

// A random one. Owned by the caller.
char *sb_output_temporary_name(void);
