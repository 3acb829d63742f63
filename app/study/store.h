// Results of samples in one SQLite file, each stored under the hash of its request.
//
// The key is the SHA-256 of the engine's identity, the values of the base, the parameters that
// replace them and the requested figures (answers.c). A stored result is never computed again,
// whatever study requests it. Every row has a checksum; a row that does not match it is ignored.
// Changes are committed about once a second, each commit completely: a process that is killed
// leaves what it had committed. One process at a time can write a store. An existing store is
// opened for reading; the first change opens it for writing. Files of unknown origin are opened
// with SQLite's defences.
//
// Functions that return bool and take a GError fail with SB_APP_ERROR_IO (in use, not writable,
// disk full) or SB_APP_ERROR_INPUT (not a store, or damaged).
#pragma once

#include "engine/base/status.h"

#include <glib.h>
#include <stdbool.h>

// Length of a key [bytes].
enum { SB_STORE_KEY = 32 };

// A result.
typedef struct {
  SbStatus status;
  char *reason;   // why figures are missing; NULL: none is missing
  char *warnings; // validity codes, separated by ";"; NULL: none
  double *value;  // [figures of the list] [SI]; NaN: no value
} SbStoredAnswer;

typedef struct SbStore SbStore;

// ---- Opening and closing ----

// Opens a store, or creates one; `path` NULL: in memory. Returns NULL with SB_APP_ERROR_INPUT for a
// file that is not a store of this format and for a name that sb_store_check_name() refuses, or
// with SB_APP_ERROR_IO for a file that is in use or cannot be read or created. Closed by
// sb_store_close() or sb_store_discard().
SbStore *sb_store_open(const char *path, GError **error);

// Opens an existing store of this format or of format 1 (Sealbench 0.1, without checksums) only for
// reading its rows: sb_store_visit(), sb_store_health(), sb_store_count(), sb_store_recover().
// sb_store_get() and all functions that write must not be called. Errors and closing as
// sb_store_open().
SbStore *sb_store_open_rows(const char *path, GError **error);

// Returns whether `path` can be the name of a store; false with SB_APP_ERROR_INPUT for "", "-",
// ":memory:", a URI of SQLite ("file:...") and a folder.
bool sb_store_check_name(const char *path, GError **error);

// Opens the file for writing, so that a failure appears before results are computed.
bool sb_store_open_for_writing(SbStore *store, GError **error);

// Commits and closes; frees the store in any case. Returns false if the commit failed. `store` may
// be NULL.
bool sb_store_close(SbStore *store, GError **error);

// Closes without the changes since the last commit, and frees the store. `store` may be NULL.
void sb_store_discard(SbStore *store);

// ---- Results ----

// Sets the names of the parameters and figures (each ends with NULL) of the results that are read
// and written from now on, in their order. They are stored, so that the file can be read without
// its study. To be called before sb_store_get() and sb_store_put(); again for another list.
bool sb_store_set_list(SbStore *store, const char *const *parameters, const char *const *figures,
                       GError **error);

// Reads the result with this key: writes the figures to out->value, an array of the caller, and
// sets the other members; the caller frees the strings by g_free(). Returns false, with *out not
// changed, if the store has no such row for the present list or the row is damaged.
bool sb_store_get(SbStore *store, const guint8 key[SB_STORE_KEY], SbStoredAnswer *out);

// Adds a result, or replaces that with the same key. parameter[parameters of the list] are values
// [SI]; answer->value has a value for each figure of the list. `answer` is only read. The change is
// visible to sb_store_get() immediately, and in the file after sb_store_commit().
bool sb_store_put(SbStore *store, const guint8 key[SB_STORE_KEY], const double *parameter,
                  const SbStoredAnswer *answer, GError **error);

// Commits the changes since the last commit; true if there are none. After an error they are lost.
bool sb_store_commit(SbStore *store, GError **error);

// Returns the number of rows.
guint64 sb_store_count(SbStore *store);

// Returns the types of CPU that computed the rows, separated by "; ".
char *sb_store_cpus(SbStore *store);

// ---- Rows ----

// Names of the parameters and figures of a row.
typedef struct {
  char **parameter, **figure; // each ends with NULL
  char *engine; // hash of the sources of the engine that computed them; "" in format 1
} SbStoreList;

// A row. Everything is borrowed until the callback returns.
typedef struct {
  guint64 number;          // position in the file, from 1
  const guint8 *key;       // [SB_STORE_KEY]
  gint64 list_number;      // identifies the list
  const SbStoreList *list; // NULL: the row of the list is damaged
  SbStatus status;
  const char *reason, *warnings; // NULL: none
  const double *parameter;       // [parameters] [SI]
  const double *figure;          // [figures] [SI]
  size_t parameters, figures;
  const char *damage; // problem of the row, whose other members may then be wrong; NULL: sound
  const guint8 *sum;  // stored checksum; NULL: none of the right length
} SbStoreRow;

// Receives a row; returns false to end.
typedef bool (*SbStoreVisit)(void *data, const SbStoreRow *row);

// Calls `visit` for every row, in the order of the file, until it returns false (which is not an
// error). `visit` calls no function of the store except sb_store_row_name(). Returns false with
// SB_APP_ERROR_INPUT if the file is damaged so that further rows cannot be read, or may be missing.
bool sb_store_visit(SbStore *store, SbStoreVisit visit, void *data, GError **error);

// Returns the format: 2; 1 for a store of Sealbench 0.1, whose rows have no checksums.
int sb_store_format(const SbStore *store);

// Returns a name of a row for messages: "row 3 (key 0a1b2c3d, gland.radial_space = 0.00136)".
char *sb_store_row_name(const SbStoreRow *row);

// State of a store. Freed by sb_store_health_release().
typedef struct {
  guint64 rows;    // rows that can be read
  guint64 damaged; // of these, rows whose checksum does not match
  guint64 unnamed; // sound rows whose list of names is damaged
  char *first;     // name of the first damaged row and its damage; NULL: none
  char *structure; // damage of the file because of which rows are missing; NULL: none
} SbStoreHealth;

// Reads all rows and writes their state to *out.
void sb_store_health(SbStoreHealth *out, SbStore *store);

// Frees the strings.
void sb_store_health_release(SbStoreHealth *health);

// Copies all sound rows to the new store `to`, also those of pages of a damaged file that its table
// does not lead to; *saved is their number. There must be no file `to`. Fails with
// SB_APP_ERROR_INPUT for a store of format 1. After an error the file `to` does not exist; `store`
// is unchanged in any case.
bool sb_store_recover(guint64 *saved, SbStore *store, const char *to, GError **error);

// Replaces the damaged file of an open store by one with its sound rows. Changes since the last
// commit are lost. Afterwards the store is open and its list is still set. After an error only
// sb_store_discard() may be called; the file is then the damaged one or the complete new one.
bool sb_store_repair(SbStore *store, GError **error);

// Adds the rows of the existing store `from` without a commit. A damaged row, and a result that
// differs from this store's result for the same request, are errors (SB_APP_ERROR_INPUT) that name
// both. After an error the rows added so far are uncommitted changes: call sb_store_discard(), so
// that nothing is merged.
bool sb_store_merge(SbStore *store, const char *from, GError **error);
