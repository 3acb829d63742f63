// The version of the program, as the build system knows it.
#pragma once

// "0.1.0"; borrowed.
const char *sb_version(void);
