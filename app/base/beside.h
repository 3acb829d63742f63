// Files at fixed places relative to the running program, where it is installed or was built.
#pragma once

// Returns the path of the file or folder `name` in the first of the folders `places` (relative to
// that of the running program, ended by NULL) that has it; NULL: none has. Freed by g_free().
char *sb_beside_program(const char *const *places, const char *name);
