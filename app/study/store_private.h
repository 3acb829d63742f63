// The open file, shared by store.c and store_rows.c.
#pragma once

#include "app/study/store.h"

#include "app/base/error.h"

#include <sqlite3.h>

// Present format; length of a checksum [bytes].
enum { SB_STORE_FORMAT = 2, SB_STORE_SUM = 16 };

struct SbStore {
  sqlite3 *file;
  sqlite3_stmt *get, *put;    // prepared statements
  char *path;                 // ":memory:" in memory
  guint8 *image;              // [image_size]: content of a file that is cut; NULL: the file is read
  size_t image_size;          // [bytes]
  int format;                 // 1 or 2
  gint64 list;                // number of the present list
  char *parameter_names;      // of the present list, separated by newlines; NULL: not set
  char *figures_of;           // its figures, separated by newlines; NULL: not set
  size_t parameters, figures; // their numbers
  bool writable;              // the file is open for writing
  bool open_transaction;      // there are changes to commit
};

// A row as it is stored. `..._size` are bytes.
typedef struct {
  const void *key, *parameters, *figures; // blobs; the latter two of double
  const void *sum;                        // the checksum; NULL in format 1
  int key_size, parameters_size, figures_size, sum_size;
  gint64 list, status;
  const char *reason, *warnings; // NULL: none
} SbStoreRecord;

// Reads the columns key, list, status, reason, warnings, parameters, figures and sum, in this
// order, of the present row of a statement. Borrowed until its next step.
void sb_store_record(SbStoreRecord *out, sqlite3_stmt *row);

// Returns whether the stored checksum matches the content.
bool sb_store_is_sound(const SbStoreRecord *record);

// Returns the number of a list: the first 60 bits of a hash of its content, so that stores agree on
// it and a damaged list is detected. Names are separated by newlines.
gint64 sb_store_list_number(const char *parameters, const char *figures, const char *engine);

// Sets *error from SQLite's last error; `code` is used if that does not determine the code. Always
// returns false.
bool sb_store_fail(SbStore *store, SbAppError code, GError **error);

// Opens the file in a transaction that locks it for other processes, and writes nothing. Returns
// false with an error.
bool sb_store_lock(SbStore *store, GError **error);

// Opens the file that now has the store's path, without uncommitted changes. Returns false with an
// error.
bool sb_store_reopen(SbStore *store, GError **error);

// Opens the file for writing and begins a transaction, unless that was done. Returns false with an
// error.
bool sb_store_begin(SbStore *store, GError **error);

// Writes a row unchanged, within a transaction. Returns false with an error.
bool sb_store_put_record(SbStore *store, const SbStoreRecord *record, GError **error);

// Opens the file, or the image if there is one, with `flags` of SQLite. The caller closes
// store->file, also after an error. Returns false with an error.
bool sb_store_open_file(SbStore *store, int flags, GError **error);

// Returns the number that the SQL statement yields; −1: none.
gint64 sb_store_number(SbStore *store, const char *statement);

// ---- Damaged files (store_pages.c) ----

// Reads a file that is shorter than its header states into store->image, with zeros for what is
// missing. Returns false for any other file.
bool sb_store_load_image(SbStore *store);

// Receives a store whose only rows are those of one page. Returns whether it has rows.
typedef bool (*SbStorePageVisit)(void *data, SbStore *page);

// Calls `visit` for every page that can have rows, also for pages that the table does not lead to.
// Rows may be visited several times.
void sb_store_visit_pages(SbStore *store, SbStorePageVisit visit, void *data);
