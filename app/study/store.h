// Where answers of studies are kept: one SQLite file, each answer under the hash of its question.
//
// A question's key is the SHA-256 of the program's version, the base's values, the parameters in
// place of them and the figures asked for; an answer that is there is never computed again,
// whatever study asks. Changes are committed about once a second, each whole: a process that is
// killed leaves what it had committed. A store belongs to one process at a time. Stores that others
// made are opened with SQLite's defences, and every row is checked for its length.
#pragma once

#include "engine/base/status.h"

#include <glib.h>
#include <stdbool.h>

enum { SB_STORE_KEY = 32 };

typedef struct {
  SbStatus status;
  char *reason;  // NULL, or why figures are missing; owned by who asked for it
  double *value; // [count of the list's figures], NaN: none
} SbStoredAnswer;

typedef struct SbStore SbStore;

// Opens a store, or makes one. NULL path: in memory. SB_APP_ERROR_INPUT for a file that is none,
// SB_APP_ERROR_IO for one that is in use or cannot be written.
SbStore *sb_store_open(const char *path, GError **error);

// Commits and closes; false if that failed. Takes NULL.
bool sb_store_close(SbStore *store, GError **error);

// Names the parameters and figures of the answers that follow, in their order (both
// NULL-terminated), so that the file can be read without its study.
bool sb_store_set_list(SbStore *store, const char *const *parameters, const char *const *figures,
                       GError **error);

// The answer to a question, of the present list; false where there is none. `value` is filled.
bool sb_store_get(SbStore *store, const guint8 key[SB_STORE_KEY], SbStoredAnswer *out);

// Adds one, with the values of the list's parameters.
bool sb_store_put(SbStore *store, const guint8 key[SB_STORE_KEY], const double *parameter,
                  const SbStoredAnswer *answer, GError **error);

bool sb_store_commit(SbStore *store, GError **error);

// Answers kept, and the types of CPU that computed them ("; " between; owned by the caller).
guint64 sb_store_count(SbStore *store);
char *sb_store_cpus(SbStore *store);

// Adds what another store has and this one has not.
bool sb_store_merge(SbStore *store, const char *from, GError **error);
