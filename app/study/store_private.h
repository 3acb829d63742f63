// What store.c and store_rows.c share: the open file.
#pragma once

#include "app/study/store.h"

#include "app/base/error.h"

#include <sqlite3.h>

enum { SB_STORE_FORMAT = 2, SB_STORE_SUM = 16 };

struct SbStore {
  sqlite3 *file;
  sqlite3_stmt *get, *put;
  char *path;
  int format;
  gint64 list;                        // of the answers that are put
  char *parameter_names, *figures_of; // of that list, "\n" between; NULL before it is set
  size_t parameters, figures;
  bool writable, open_transaction;
};

// A row as it is stored.
typedef struct {
  const void *key, *parameters, *figures, *sum; // sum NULL in format 1
  int key_size, parameters_size, figures_size, sum_size;
  gint64 list, status;
  const char *reason, *warnings;
} SbStoreRecord;

// Reads the columns key, list, status, reason, warnings, parameters, figures, sum of a statement's
// row; borrowed until its next step.
void sb_store_record(SbStoreRecord *out, sqlite3_stmt *row);

// Writes the checksum of a row's content.
void sb_store_sum(guint8 sum[SB_STORE_SUM], const SbStoreRecord *record);

// Whether the checksum matches.
bool sb_store_is_sound(const SbStoreRecord *record);

// The number of a list: the beginning of a hash of its content, so that stores agree on it and a
// damaged list is found.
gint64 sb_store_list_number(const char *parameters, const char *figures, const char *engine);

// Sets *error from SQLite's last error, by `code` where SQLite's own code does not decide; false.
bool sb_store_fail(SbStore *store, SbAppError code, GError **error);

bool sb_store_run(SbStore *store, const char *statement, GError **error);

// Opens the file in a transaction that locks it for other processes, and writes nothing.
bool sb_store_lock(SbStore *store, GError **error);

// Opens the file that now has the store's name, without what was not committed.
bool sb_store_reopen(SbStore *store, GError **error);

// Opens a transaction, and the file for writing, unless that was done.
bool sb_store_begin(SbStore *store, GError **error);

// Writes a row as it is.
bool sb_store_put_record(SbStore *store, const SbStoreRecord *record, GError **error);
