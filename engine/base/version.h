// The identity of the engine: which answers are its own.
#pragma once

// All strings are static.
typedef struct {
  const char *version; // of the release, "0.2.0"
  const char *source;  // SHA-256 of the engine's sources and of `options`, 64 hexadecimal digits
  const char *commit;  // of the repository that was compiled, NULL outside of a repository
  const char *options; // compiler, its version, type of CPU, options of the compilation
} SbEngineIdentity;

// Returns the identity of this program's engine. Programs with equal `source` compute the same
// answers; a stored answer of another source is never used.
const SbEngineIdentity *sb_engine_identity(void);

// Returns the version of that identity.
const char *sb_version(void);
