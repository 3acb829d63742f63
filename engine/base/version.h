// The identity of the engine that this program contains.
#pragma once

// All strings are static and NUL-terminated.
typedef struct {
  const char *version; // of the release, "0.2.0"
  const char *source;  // SHA-256 of the engine's sources and `options`, 64 hexadecimal digits
  const char *commit;  // commit of the repository; NULL if it was not compiled in a repository
  const char *options; // compiler, its version, type of CPU, options of the compilation
} SbEngineIdentity;

// Returns the identity of this program's engine; static. Programs with equal `source` compute the
// same results to the bit. A stored result with another `source` must not be used. Any thread may
// call this function.
const SbEngineIdentity *sb_engine_identity(void);

// Returns `version` of sb_engine_identity(); static.
const char *sb_version(void);
