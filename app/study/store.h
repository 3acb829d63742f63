// Answers of studies in one SQLite file, each stored under the hash of its question.
//
// The key of a question is the SHA-256 of the engine's identity, the values of the base, the
// parameters that replace them and the figures that are requested (answers.c). A stored answer is
// never computed again, whatever study requests it. Every row carries a checksum, and a row that
// does not match it is not an answer. Changes are committed about once a second, each of them
// completely: a process that is killed leaves what it had committed. One process at a time writes a
// store. A store that exists is opened for reading; the first change opens it for writing. Files of
// unknown origin are opened with SQLite's defences.
#pragma once

#include "engine/base/status.h"

#include <glib.h>
#include <stdbool.h>

enum { SB_STORE_KEY = 32 };

// An answer. Strings are owned by the caller of sb_store_get(): g_free().
typedef struct {
  SbStatus status;
  char *reason;   // why figures are missing, NULL where none is missing
  char *warnings; // codes of validity, separated by ";", NULL without any
  double *value;  // [number of the list's figures], NaN where there is no figure
} SbStoredAnswer;

typedef struct SbStore SbStore;

// Opens a store, or creates one. NULL path: in memory. SB_APP_ERROR_INPUT for a file that is not a
// store of this format and for the names that SQLite does not take for a file ("", ":memory:") and
// "-"; SB_APP_ERROR_IO for a file that is in use or cannot be read, or be created.
SbStore *sb_store_open(const char *path, GError **error);

// Opens a store of this format or of format 1 (Sealbench 0.1, without checksums) for reading its
// rows; sb_store_get() and all that writes fail.
SbStore *sb_store_open_rows(const char *path, GError **error);

// Whether a path names a file that can be a store; see sb_store_open().
bool sb_store_check_name(const char *path, GError **error);

// Makes sure that answers can be put; to be called before they are computed.
bool sb_store_open_for_writing(SbStore *store, GError **error);

// Commits and closes; false if that failed. Takes NULL.
bool sb_store_close(SbStore *store, GError **error);

// Closes without the changes since the last commit. Takes NULL.
void sb_store_discard(SbStore *store);

// Names the parameters and figures of the answers that follow, in their order (both
// NULL-terminated), so that the file can be read without its study.
bool sb_store_set_list(SbStore *store, const char *const *parameters, const char *const *figures,
                       GError **error);

// Fills *out with the answer to a question of the present list; false if the store has none or its
// row is damaged. `value` is the caller's array.
bool sb_store_get(SbStore *store, const guint8 key[SB_STORE_KEY], SbStoredAnswer *out);

// Adds or replaces an answer, with the values of the list's parameters.
bool sb_store_put(SbStore *store, const guint8 key[SB_STORE_KEY], const double *parameter,
                  const SbStoredAnswer *answer, GError **error);

bool sb_store_commit(SbStore *store, GError **error);

// The number of rows, and the types of CPU that computed them ("; " between; g_free()).
guint64 sb_store_count(SbStore *store);
char *sb_store_cpus(SbStore *store);

// ---- Rows ----

// What the answers of a list are. Borrowed from the store's rows.
typedef struct {
  char **parameter, **figure; // names, NULL-terminated
  char *engine;               // source hash of the engine that computed them, "" in format 1
} SbStoreList;

// A row in the order of the file. Everything is borrowed until the next row.
typedef struct {
  guint64 number; // from 1
  const guint8 *key;
  gint64 list_number;
  const SbStoreList *list; // NULL if the list's own row is damaged
  SbStatus status;
  const char *reason, *warnings; // NULL: none
  const double *parameter, *figure;
  size_t parameters, figures;
  const char *damage; // what is wrong with the row, whose other members may be wrong then; or NULL
  const guint8 *sum;  // the stored checksum, NULL without one of the right length
} SbStoreRow;

// Calls `visit` for every row until it returns false. False with SB_APP_ERROR_INPUT where the
// file's structure is damaged, so that rows cannot be read.
typedef bool (*SbStoreVisit)(void *data, const SbStoreRow *row);
bool sb_store_visit(SbStore *store, SbStoreVisit visit, void *data, GError **error);

// 2; 1 of a store of Sealbench 0.1, whose rows carry no checksums.
int sb_store_format(const SbStore *store);

// "row 3 (key 0a1b2c3d, gland.radial_space = 0.00136)". Owned by the caller: g_free().
char *sb_store_row_name(const SbStoreRow *row);

// What is wrong with a store.
typedef struct {
  guint64 rows, damaged; // `rows` that can be read
  guint64 unnamed;       // sound rows whose list of names is damaged
  char *first;           // name of the first damaged row and its damage, NULL without any
  char *structure;       // damage that keeps further rows from being read; NULL: none
} SbStoreHealth;

void sb_store_health(SbStoreHealth *out, SbStore *store);
void sb_store_health_release(SbStoreHealth *health);

// Writes all sound rows of a store to a new file, also those that can be read from the end of a
// file with a damaged structure; *saved counts them.
bool sb_store_recover(guint64 *saved, SbStore *store, const char *to, GError **error);

// Replaces the damaged file of a store that is open by one with its sound rows.
bool sb_store_repair(SbStore *store, GError **error);

// Adds the rows of another store without committing them. A damaged row, and an answer that differs
// from this store's answer to the same question, are errors (SB_APP_ERROR_INPUT) that name both.
bool sb_store_merge(SbStore *store, const char *from, GError **error);
