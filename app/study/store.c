// The tables: `list` (parameters and figures by name), `answer` (a question's key, its list, the
// values of both as doubles of the machine's own order, which is little-endian on all that this
// program runs on), `origin` (version and CPU of each writer).
#include "app/study/store.h"

#include "app/base/error.h"

#include "engine/valve/sealbench.h"

#include <math.h>
#include <sqlite3.h>
#include <stdlib.h>
#include <string.h>
#include <sys/utsname.h>

enum { APPLICATION = 0x53624e63, FORMAT = 1 };

struct SbStore {
  sqlite3 *file;
  sqlite3_stmt *get, *put;
  char *path;
  gint64 list; // of the answers
  size_t parameters, figures;
  bool open_transaction;
};

// Type of CPU, as the kernel names it.
static char *cpu_name(void) {
  g_autofree char *text = NULL;
  if (g_file_get_contents("/proc/cpuinfo", &text, NULL, NULL)) {
    const char *line = strstr(text, "model name");
    const char *colon = line != NULL ? strchr(line, ':') : NULL;
    if (colon != NULL) {
      return g_strstrip(g_strndup(colon + 1, strcspn(colon + 1, "\n")));
    }
  }
  struct utsname name;
  return g_strdup(uname(&name) == 0 ? name.machine : "unknown");
}

static bool fail(SbStore *store, SbAppError code, GError **error) {
  const int result = sqlite3_errcode(store->file);
  if (result == SQLITE_BUSY || result == SQLITE_LOCKED) {
    g_set_error(error, SB_APP_ERROR, SB_APP_ERROR_IO, "%s is in use by another process",
                store->path);
  } else if (result == SQLITE_NOTADB || result == SQLITE_CORRUPT) {
    g_set_error(error, SB_APP_ERROR, SB_APP_ERROR_INPUT, "%s is no store, or damaged", store->path);
  } else {
    g_set_error(error, SB_APP_ERROR, code, "%s: %s", store->path, sqlite3_errmsg(store->file));
  }
  return false;
}

static bool run(SbStore *store, const char *statement, GError **error) {
  return sqlite3_exec(store->file, statement, NULL, NULL, NULL) == SQLITE_OK ||
         fail(store, SB_APP_ERROR_IO, error);
}

// A number that a statement yields.
static gint64 number(SbStore *store, const char *statement) {
  sqlite3_stmt *query = NULL;
  gint64 value = -1;
  if (sqlite3_prepare_v2(store->file, statement, -1, &query, NULL) == SQLITE_OK &&
      sqlite3_step(query) == SQLITE_ROW) {
    value = sqlite3_column_int64(query, 0);
  }
  sqlite3_finalize(query);
  return value;
}

// Opens the file with what keeps a hostile one from harm.
static bool open_file(SbStore *store, int flags, GError **error) {
  if (sqlite3_open_v2(store->path, &store->file, flags, NULL) != SQLITE_OK) {
    return fail(store, SB_APP_ERROR_IO, error);
  }
  sqlite3_db_config(store->file, SQLITE_DBCONFIG_DEFENSIVE, 1, NULL);
  sqlite3_db_config(store->file, SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0, NULL);
  sqlite3_db_config(store->file, SQLITE_DBCONFIG_ENABLE_TRIGGER, 0, NULL);
  sqlite3_db_config(store->file, SQLITE_DBCONFIG_ENABLE_VIEW, 0, NULL);
  sqlite3_limit(store->file, SQLITE_LIMIT_LENGTH, 1 << 24);
  return true;
}

// Whether it is a store of this format; with `make` an empty file becomes one.
static bool check_format(SbStore *store, bool make, GError **error) {
  const gint64 application = number(store, "PRAGMA application_id");
  const gint64 tables = number(store, "SELECT count(*) FROM sqlite_master");
  if (application < 0 || tables < 0) {
    return fail(store, SB_APP_ERROR_IO, error);
  }
  if (make && tables == 0 && application == 0) {
    g_autofree char *tables_made = g_strdup_printf(
        "PRAGMA application_id = %d; PRAGMA user_version = %d;"
        "CREATE TABLE list (id INTEGER PRIMARY KEY, parameters TEXT NOT NULL, figures TEXT NOT "
        "NULL);"
        "CREATE TABLE answer (key BLOB PRIMARY KEY, list INTEGER NOT NULL, status INTEGER NOT "
        "NULL, reason TEXT, parameters BLOB NOT NULL, figures BLOB NOT NULL) WITHOUT ROWID;"
        "CREATE TABLE origin (version TEXT, cpu TEXT, PRIMARY KEY (version, cpu))",
        APPLICATION, FORMAT);
    return run(store, tables_made, error);
  }
  if (application != APPLICATION || number(store, "PRAGMA user_version") != FORMAT) {
    g_set_error(error, SB_APP_ERROR, SB_APP_ERROR_INPUT, "%s is no store of this version",
                store->path);
    return false;
  }
  return true;
}

static bool begin(SbStore *store, GError **error) {
  store->open_transaction = store->open_transaction || run(store, "BEGIN IMMEDIATE", error);
  return store->open_transaction;
}

static bool prepare(SbStore *store, GError **error) {
  static const char get[] = "SELECT status, reason, figures FROM answer WHERE key = ? AND list = ?";
  static const char put[] = "INSERT OR REPLACE INTO answer VALUES (?, ?, ?, ?, ?, ?)";
  return (sqlite3_prepare_v2(store->file, get, -1, &store->get, NULL) == SQLITE_OK &&
          sqlite3_prepare_v2(store->file, put, -1, &store->put, NULL) == SQLITE_OK) ||
         fail(store, SB_APP_ERROR_INPUT, error);
}

static void destroy(SbStore *store) {
  sqlite3_finalize(store->get);
  sqlite3_finalize(store->put);
  sqlite3_close(store->file);
  g_free(store->path);
  g_free(store);
}

SbStore *sb_store_open(const char *path, GError **error) {
  SbStore *store = g_new0(SbStore, 1);
  store->path = g_strdup(path != NULL ? path : ":memory:");
  // One process writes; what the kernel has is safe from a process that dies, so nothing is synced
  // but at the end of a transaction.
  if (open_file(store, SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE, error) &&
      run(store, "PRAGMA locking_mode = EXCLUSIVE; PRAGMA journal_mode = DELETE", error) &&
      begin(store, error) && check_format(store, true, error) && prepare(store, error)) {
    return store;
  }
  destroy(store);
  return NULL;
}

bool sb_store_commit(SbStore *store, GError **error) {
  if (!store->open_transaction) {
    return true;
  }
  store->open_transaction = false;
  return run(store, "COMMIT", error);
}

bool sb_store_close(SbStore *store, GError **error) {
  if (store == NULL) {
    return true;
  }
  const bool good = sb_store_commit(store, error);
  destroy(store);
  return good;
}

// A list's number: the beginning of its hash, so that stores agree on it.
static gint64 list_number(const char *parameters, const char *figures) {
  GChecksum *sum = g_checksum_new(G_CHECKSUM_SHA256);
  g_checksum_update(sum, (const guchar *)parameters, -1);
  g_checksum_update(sum, (const guchar *)"|", 1);
  g_checksum_update(sum, (const guchar *)figures, -1);
  g_autofree char *hex = g_strndup(g_checksum_get_string(sum), 15);
  g_checksum_free(sum);
  return (gint64)g_ascii_strtoull(hex, NULL, 16);
}

bool sb_store_set_list(SbStore *store, const char *const *parameters, const char *const *figures,
                       GError **error) {
  g_autofree char *names = g_strjoinv(",", (char **)parameters);
  g_autofree char *paths = g_strjoinv(",", (char **)figures);
  g_autofree char *cpu = cpu_name();
  store->list = list_number(names, paths);
  store->parameters = g_strv_length((char **)parameters);
  store->figures = g_strv_length((char **)figures);
  sqlite3_stmt *list = NULL, *origin = NULL;
  bool good = begin(store, error) &&
              ((sqlite3_prepare_v2(store->file, "INSERT OR IGNORE INTO list VALUES (?, ?, ?)", -1,
                                   &list, NULL) == SQLITE_OK &&
                sqlite3_bind_int64(list, 1, store->list) == SQLITE_OK &&
                sqlite3_bind_text(list, 2, names, -1, SQLITE_STATIC) == SQLITE_OK &&
                sqlite3_bind_text(list, 3, paths, -1, SQLITE_STATIC) == SQLITE_OK &&
                sqlite3_step(list) == SQLITE_DONE &&
                sqlite3_prepare_v2(store->file, "INSERT OR IGNORE INTO origin VALUES (?, ?)", -1,
                                   &origin, NULL) == SQLITE_OK &&
                sqlite3_bind_text(origin, 1, sb_version(), -1, SQLITE_STATIC) == SQLITE_OK &&
                sqlite3_bind_text(origin, 2, cpu, -1, SQLITE_STATIC) == SQLITE_OK &&
                sqlite3_step(origin) == SQLITE_DONE) ||
               fail(store, SB_APP_ERROR_IO, error));
  sqlite3_finalize(list);
  sqlite3_finalize(origin);
  return good;
}

bool sb_store_get(SbStore *store, const guint8 key[SB_STORE_KEY], SbStoredAnswer *out) {
  const size_t bytes = store->figures * sizeof(double);
  sqlite3_reset(store->get);
  bool found = sqlite3_bind_blob(store->get, 1, key, SB_STORE_KEY, SQLITE_STATIC) == SQLITE_OK &&
               sqlite3_bind_int64(store->get, 2, store->list) == SQLITE_OK &&
               sqlite3_step(store->get) == SQLITE_ROW;
  const void *value = found ? sqlite3_column_blob(store->get, 2) : NULL;
  const int status = found ? sqlite3_column_int(store->get, 0) : -1;
  // A row of another length, or of a status that there is not, is as good as none.
  found = value != NULL && (size_t)sqlite3_column_bytes(store->get, 2) == bytes && status >= 0 &&
          status <= SB_ERROR_IO;
  if (found) {
    memcpy(out->value, value, bytes);
    out->status = (SbStatus)status;
    out->reason = g_strdup((const char *)sqlite3_column_text(store->get, 1));
  }
  sqlite3_reset(store->get);
  return found;
}

bool sb_store_put(SbStore *store, const guint8 key[SB_STORE_KEY], const double *parameter,
                  const SbStoredAnswer *answer, GError **error) {
  sqlite3_stmt *put = store->put;
  const size_t size = sizeof(double);
  sqlite3_reset(put);
  const bool good = begin(store, error) &&
                    ((sqlite3_bind_blob(put, 1, key, SB_STORE_KEY, SQLITE_STATIC) == SQLITE_OK &&
                      sqlite3_bind_int64(put, 2, store->list) == SQLITE_OK &&
                      sqlite3_bind_int(put, 3, (int)answer->status) == SQLITE_OK &&
                      sqlite3_bind_text(put, 4, answer->reason, -1, SQLITE_STATIC) == SQLITE_OK &&
                      sqlite3_bind_blob(put, 5, parameter, (int)(store->parameters * size),
                                        SQLITE_STATIC) == SQLITE_OK &&
                      sqlite3_bind_blob(put, 6, answer->value, (int)(store->figures * size),
                                        SQLITE_STATIC) == SQLITE_OK &&
                      sqlite3_step(put) == SQLITE_DONE) ||
                     fail(store, SB_APP_ERROR_IO, error));
  sqlite3_reset(put);
  return good;
}

guint64 sb_store_count(SbStore *store) {
  return (guint64)MAX(number(store, "SELECT count(*) FROM answer"), 0);
}

char *sb_store_cpus(SbStore *store) {
  GString *text = g_string_new(NULL);
  sqlite3_stmt *query = NULL;
  if (sqlite3_prepare_v2(store->file, "SELECT DISTINCT cpu FROM origin ORDER BY cpu", -1, &query,
                         NULL) == SQLITE_OK) {
    while (sqlite3_step(query) == SQLITE_ROW) {
      const char *cpu = (const char *)sqlite3_column_text(query, 0);
      g_string_append_printf(text, "%s%s", text->len > 0 ? "; " : "", cpu != NULL ? cpu : "");
    }
  }
  sqlite3_finalize(query);
  return g_string_free(text, FALSE);
}

bool sb_store_merge(SbStore *store, const char *from, GError **error) {
  // The other one is opened on its own first: whether it is a store, and nothing is made of it.
  SbStore other = {.path = (char *)from};
  bool good = open_file(&other, SQLITE_OPEN_READWRITE, error) && check_format(&other, false, error);
  sqlite3_close(other.file);
  if (!good || !sb_store_commit(store, error)) {
    return false;
  }
  sqlite3_stmt *attach = NULL;
  good = (sqlite3_prepare_v2(store->file, "ATTACH ? AS other", -1, &attach, NULL) == SQLITE_OK &&
          sqlite3_bind_text(attach, 1, from, -1, SQLITE_STATIC) == SQLITE_OK &&
          sqlite3_step(attach) == SQLITE_DONE) ||
         fail(store, SB_APP_ERROR_IO, error);
  sqlite3_finalize(attach);
  if (!good) {
    return false;
  }
  // Of two answers to one question the lesser stays, so that the order does not matter: on one type
  // of CPU they are equal.
  good = begin(store, error) &&
         run(store,
             "INSERT OR IGNORE INTO list SELECT * FROM other.list;"
             "INSERT OR IGNORE INTO origin SELECT * FROM other.origin;"
             "INSERT INTO answer SELECT * FROM other.answer WHERE true ON CONFLICT (key) DO UPDATE "
             "SET list = excluded.list, status = excluded.status, reason = excluded.reason, "
             "parameters = excluded.parameters, figures = excluded.figures "
             "WHERE (excluded.status, excluded.figures) < (status, figures)",
             error) &&
         sb_store_commit(store, error);
  if (store->open_transaction) {
    store->open_transaction = false;
    (void)run(store, "ROLLBACK", NULL);
  }
  return run(store, "DETACH other", good ? error : NULL) && good;
}
