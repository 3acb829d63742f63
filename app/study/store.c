// The tables: `list` (parameters and figures by name, engine), `answer` (key of a question, its
// list, status, reason, warnings, values of parameters and figures as doubles in the machine's
// order, which is little-endian wherever this program runs, checksum), `origin` (each writer).
#include "app/study/store_private.h"

#include "engine/base/version.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/utsname.h>

enum { APPLICATION = 0x53624e63 };

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

bool sb_store_fail(SbStore *store, SbAppError code, GError **error) {
  const int result = sqlite3_errcode(store->file);
  if (result == SQLITE_BUSY || result == SQLITE_LOCKED) {
    g_set_error(error, SB_APP_ERROR, SB_APP_ERROR_IO, "%s is in use by another process",
                store->path);
  } else if (result == SQLITE_NOTADB || result == SQLITE_CORRUPT) {
    g_set_error(error, SB_APP_ERROR, SB_APP_ERROR_INPUT,
                "%s is not a store, or is damaged: sealbench store recover saves the rows that can "
                "be read, "
                "-o chooses another file",
                store->path);
  } else if (result == SQLITE_READONLY) {
    g_set_error(error, SB_APP_ERROR, SB_APP_ERROR_IO, "%s cannot be written", store->path);
  } else {
    g_set_error(error, SB_APP_ERROR, code, "%s: %s", store->path, sqlite3_errmsg(store->file));
  }
  return false;
}

// Executes an SQL statement without results. Returns false with SB_APP_ERROR_IO.
static bool run_sql(SbStore *store, const char *statement, GError **error) {
  return sqlite3_exec(store->file, statement, NULL, NULL, NULL) == SQLITE_OK ||
         sb_store_fail(store, SB_APP_ERROR_IO, error);
}

gint64 sb_store_number(SbStore *store, const char *statement) {
  sqlite3_stmt *query = NULL;
  gint64 value = -1;
  if (sqlite3_prepare_v2(store->file, statement, -1, &query, NULL) == SQLITE_OK &&
      sqlite3_step(query) == SQLITE_ROW) {
    value = sqlite3_column_int64(query, 0);
  }
  sqlite3_finalize(query);
  return value;
}

// ---- Checksums ----

// The length comes first, -1 for a text that is NULL.
static void add_bytes(GChecksum *sum, const void *bytes, int size) {
  const gint64 length = size;
  g_checksum_update(sum, (const guchar *)&length, sizeof length);
  if (size > 0) {
    g_checksum_update(sum, bytes, size);
  }
}

static void add_text(GChecksum *sum, const char *text) {
  add_bytes(sum, text, text != NULL ? (int)strlen(text) : -1);
}

// Against damage, not against intent: MD5 is fast.
static void write_sum(guint8 out[SB_STORE_SUM], const SbStoreRecord *record) {
  GChecksum *sum = g_checksum_new(G_CHECKSUM_MD5);
  gsize size = SB_STORE_SUM;
  add_bytes(sum, record->key, record->key_size);
  g_checksum_update(sum, (const guchar *)&record->list, sizeof record->list);
  g_checksum_update(sum, (const guchar *)&record->status, sizeof record->status);
  add_text(sum, record->reason);
  add_text(sum, record->warnings);
  add_bytes(sum, record->parameters, record->parameters_size);
  add_bytes(sum, record->figures, record->figures_size);
  g_checksum_get_digest(sum, out, &size);
  g_checksum_free(sum);
}

bool sb_store_is_sound(const SbStoreRecord *record) {
  guint8 sum[SB_STORE_SUM];
  write_sum(sum, record);
  return record->sum != NULL && record->sum_size == SB_STORE_SUM &&
         memcmp(sum, record->sum, SB_STORE_SUM) == 0;
}

void sb_store_record(SbStoreRecord *out, sqlite3_stmt *row) {
  // The bytes are counted behind the conversion that the pointer may need.
  *out = (SbStoreRecord){.key = sqlite3_column_blob(row, 0),
                         .key_size = sqlite3_column_bytes(row, 0),
                         .list = sqlite3_column_int64(row, 1),
                         .status = sqlite3_column_int64(row, 2),
                         .reason = (const char *)sqlite3_column_text(row, 3),
                         .warnings = (const char *)sqlite3_column_text(row, 4)};
  out->parameters = sqlite3_column_blob(row, 5);
  out->parameters_size = sqlite3_column_bytes(row, 5);
  out->figures = sqlite3_column_blob(row, 6);
  out->figures_size = sqlite3_column_bytes(row, 6);
  out->sum = sqlite3_column_blob(row, 7);
  out->sum_size = sqlite3_column_bytes(row, 7);
}

// ---- Opening ----

// Opens the file with what keeps a hostile one from harm.
bool sb_store_open_file(SbStore *store, int flags, GError **error) {
  const sqlite3_int64 size = (sqlite3_int64)store->image_size;
  if (store->image != NULL ? sqlite3_open(":memory:", &store->file) != SQLITE_OK ||
                                 sqlite3_deserialize(store->file, "main", store->image, size, size,
                                                     SQLITE_DESERIALIZE_READONLY) != SQLITE_OK
                           : sqlite3_open_v2(store->path, &store->file, flags, NULL) != SQLITE_OK) {
    return sb_store_fail(store, SB_APP_ERROR_IO, error);
  }
  sqlite3_db_config(store->file, SQLITE_DBCONFIG_DEFENSIVE, 1, NULL);
  sqlite3_db_config(store->file, SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0, NULL);
  sqlite3_db_config(store->file, SQLITE_DBCONFIG_ENABLE_TRIGGER, 0, NULL);
  sqlite3_db_config(store->file, SQLITE_DBCONFIG_ENABLE_VIEW, 0, NULL);
  sqlite3_limit(store->file, SQLITE_LIMIT_LENGTH, 1 << 24);
  return run_sql(store, "PRAGMA cell_size_check = ON", error);
}

static bool make_tables(SbStore *store, GError **error) {
  g_autofree char *statement = g_strdup_printf(
      "PRAGMA application_id = %d; PRAGMA user_version = %d;"
      "CREATE TABLE list (id INTEGER PRIMARY KEY, parameters TEXT NOT NULL, figures TEXT NOT "
      "NULL, engine TEXT NOT NULL);"
      "CREATE TABLE answer (key BLOB PRIMARY KEY, list INTEGER NOT NULL, status INTEGER NOT "
      "NULL, reason TEXT, warnings TEXT, parameters BLOB NOT NULL, figures BLOB NOT NULL, sum "
      "BLOB NOT NULL) WITHOUT ROWID;"
      "CREATE TABLE origin (source TEXT, version TEXT, commit_of TEXT, cpu TEXT, "
      "PRIMARY KEY (source, cpu))",
      APPLICATION, SB_STORE_FORMAT);
  return run_sql(store, statement, error);
}

// Whether the file is a store of this format, or of the oldest one; *empty (not NULL): whether it
// is a file without anything, which is accepted then.
static bool check_format(SbStore *store, bool *empty, int oldest, GError **error) {
  const gint64 application = sb_store_number(store, "PRAGMA application_id");
  const gint64 tables =
      application < 0 ? -1 : sb_store_number(store, "SELECT count(*) FROM sqlite_master");
  if (application < 0 || tables < 0) {
    return sb_store_fail(store, SB_APP_ERROR_IO, error);
  }
  if (empty != NULL && tables == 0 && application == 0) {
    *empty = true;
    store->format = SB_STORE_FORMAT;
    return true;
  }
  store->format = (int)sb_store_number(store, "PRAGMA user_version");
  if (application != APPLICATION || store->format < 1 || store->format > SB_STORE_FORMAT) {
    g_set_error(error, SB_APP_ERROR, SB_APP_ERROR_INPUT, "%s is not a store of this version",
                store->path);
    return false;
  }
  if (store->format < oldest) {
    g_set_error(error, SB_APP_ERROR, SB_APP_ERROR_INPUT,
                "%s is a store of Sealbench 0.1, whose rows carry no checksums and belong to "
                "another engine: choose another file with -o; sealbench store export reads it",
                store->path);
    return false;
  }
  return true;
}

static bool prepare_store(SbStore *store, GError **error) {
  static const char get[] = "SELECT key, list, status, reason, warnings, parameters, figures, sum "
                            "FROM answer WHERE key = ? AND list = ?";
  static const char put[] = "INSERT OR REPLACE INTO answer VALUES (?, ?, ?, ?, ?, ?, ?, ?)";
  return (sqlite3_prepare_v2(store->file, get, -1, &store->get, NULL) == SQLITE_OK &&
          (!store->writable ||
           sqlite3_prepare_v2(store->file, put, -1, &store->put, NULL) == SQLITE_OK)) ||
         sb_store_fail(store, SB_APP_ERROR_INPUT, error);
}

static void close_file(SbStore *store) {
  sqlite3_finalize(store->get);
  sqlite3_finalize(store->put);
  sqlite3_close(store->file);
  store->get = store->put = NULL;
  store->file = NULL;
  store->writable = store->open_transaction = false;
}

static void destroy(SbStore *store) {
  close_file(store);
  g_free(store->path);
  g_free(store->image);
  g_free(store->parameter_names);
  g_free(store->figures_of);
  g_free(store);
}

// One process writes. What the kernel has is safe from a process that dies, so nothing is synced
// but at the end of a transaction.
static bool open_writable(SbStore *store, GError **error) {
  bool empty = false;
  close_file(store);
  store->writable = true;
  store->open_transaction =
      sb_store_open_file(store, SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE, error) &&
      run_sql(store, "PRAGMA locking_mode = EXCLUSIVE; PRAGMA journal_mode = DELETE", error) &&
      run_sql(store, "BEGIN IMMEDIATE", error);
  return store->open_transaction && check_format(store, &empty, SB_STORE_FORMAT, error) &&
         (!empty || make_tables(store, error)) && prepare_store(store, error);
}

// False without an error where only opening for writing can help: an empty file, or one that a
// process left in the middle of a transaction, which SQLite reverts.
static bool open_readable(SbStore *store, int flags, int oldest, GError **error) {
  bool empty = false;
  g_autoptr(GError) found = NULL;
  close_file(store);
  if (sb_store_open_file(store, flags, &found) && check_format(store, &empty, oldest, &found) &&
      !empty && (store->format < SB_STORE_FORMAT || prepare_store(store, &found))) {
    return true;
  }
  const int result = sqlite3_errcode(store->file);
  if (!empty && result != SQLITE_READONLY && result != SQLITE_CANTOPEN && found != NULL) {
    g_propagate_error(error, g_steal_pointer(&found));
  }
  return false;
}

bool sb_store_check_name(const char *path, GError **error) {
  // SQLite reads "file:..." as a URI, which may name a database in memory.
  static const char *const names[] = {"", "-", ":memory:"};
  bool allowed = !g_str_has_prefix(path, "file:");
  for (size_t i = 0; i < G_N_ELEMENTS(names); i++) {
    allowed = allowed && strcmp(path, names[i]) != 0;
  }
  if (!allowed) {
    g_set_error(error, SB_APP_ERROR, SB_APP_ERROR_INPUT,
                "\"%s\" cannot be a store: a store is a file, write for example -o NAME.store",
                path);
    return false;
  }
  if (g_file_test(path, G_FILE_TEST_IS_DIR)) {
    g_set_error(error, SB_APP_ERROR, SB_APP_ERROR_INPUT,
                "%s is a folder: a store is a file, write for example -o %s%sNAME.store", path,
                path, g_str_has_suffix(path, "/") ? "" : "/");
    return false;
  }
  return true;
}

SbStore *sb_store_open(const char *path, GError **error) {
  if (path != NULL && !sb_store_check_name(path, error)) {
    return NULL;
  }
  SbStore *store = g_new0(SbStore, 1);
  store->path = g_strdup(path != NULL ? path : ":memory:");
  GError *found = NULL;
  if ((path != NULL && g_file_test(path, G_FILE_TEST_EXISTS) &&
       open_readable(store, SQLITE_OPEN_READONLY, SB_STORE_FORMAT, &found)) ||
      (found == NULL && open_writable(store, &found))) {
    return store;
  }
  g_propagate_error(error, found);
  destroy(store);
  return NULL;
}

SbStore *sb_store_open_rows(const char *path, GError **error) {
  if (!sb_store_check_name(path, error)) {
    return NULL;
  }
  SbStore *store = g_new0(SbStore, 1);
  store->path = g_strdup(path);
  GError *found = NULL;
  if (open_readable(store, SQLITE_OPEN_READONLY, 1, &found) ||
      (found == NULL && open_readable(store, SQLITE_OPEN_READWRITE, 1, &found))) {
    return store;
  }
  const int result = sqlite3_errcode(store->file);
  if (result == SQLITE_CORRUPT && sb_store_load_image(store)) {
    g_clear_error(&found);
    if (open_readable(store, SQLITE_OPEN_READONLY, 1, &found)) {
      return store;
    }
  }
  if (result == SQLITE_CORRUPT || result == SQLITE_NOTADB) {
    g_clear_error(&found);
    g_set_error(&found, SB_APP_ERROR, SB_APP_ERROR_INPUT,
                "%s is not a store, or its beginning is damaged: no row can be found in it", path);
  }
  if (found == NULL) {
    g_set_error(&found, SB_APP_ERROR, SB_APP_ERROR_INPUT, "%s is empty, or cannot be read", path);
  }
  g_propagate_error(error, found);
  destroy(store);
  return NULL;
}

int sb_store_format(const SbStore *store) {
  return store->format;
}

// ---- Lists ----

gint64 sb_store_list_number(const char *parameters, const char *figures, const char *engine) {
  GChecksum *sum = g_checksum_new(G_CHECKSUM_SHA256);
  add_text(sum, parameters);
  add_text(sum, figures);
  add_text(sum, engine);
  g_autofree char *hex = g_strndup(g_checksum_get_string(sum), 15);
  g_checksum_free(sum);
  return (gint64)g_ascii_strtoull(hex, NULL, 16);
}

static bool write_list(SbStore *store, GError **error) {
  const SbEngineIdentity *engine = sb_engine_identity();
  g_autofree char *cpu = cpu_name();
  sqlite3_stmt *list = NULL, *origin = NULL;
  const bool good =
      (sqlite3_prepare_v2(store->file, "INSERT OR REPLACE INTO list VALUES (?, ?, ?, ?)", -1, &list,
                          NULL) == SQLITE_OK &&
       sqlite3_bind_int64(list, 1, store->list) == SQLITE_OK &&
       sqlite3_bind_text(list, 2, store->parameter_names, -1, SQLITE_STATIC) == SQLITE_OK &&
       sqlite3_bind_text(list, 3, store->figures_of, -1, SQLITE_STATIC) == SQLITE_OK &&
       sqlite3_bind_text(list, 4, engine->source, -1, SQLITE_STATIC) == SQLITE_OK &&
       sqlite3_step(list) == SQLITE_DONE &&
       sqlite3_prepare_v2(store->file, "INSERT OR REPLACE INTO origin VALUES (?, ?, ?, ?)", -1,
                          &origin, NULL) == SQLITE_OK &&
       sqlite3_bind_text(origin, 1, engine->source, -1, SQLITE_STATIC) == SQLITE_OK &&
       sqlite3_bind_text(origin, 2, engine->version, -1, SQLITE_STATIC) == SQLITE_OK &&
       sqlite3_bind_text(origin, 3, engine->commit, -1, SQLITE_STATIC) == SQLITE_OK &&
       sqlite3_bind_text(origin, 4, cpu, -1, SQLITE_STATIC) == SQLITE_OK &&
       sqlite3_step(origin) == SQLITE_DONE) ||
      sb_store_fail(store, SB_APP_ERROR_IO, error);
  sqlite3_finalize(list);
  sqlite3_finalize(origin);
  return good;
}

bool sb_store_set_list(SbStore *store, const char *const *parameters, const char *const *figures,
                       GError **error) {
  g_autofree char *names = g_strjoinv("\n", (char **)parameters),
                  *of = g_strjoinv("\n", (char **)figures);
  if (store->writable && g_strcmp0(names, store->parameter_names) == 0 &&
      g_strcmp0(of, store->figures_of) == 0) {
    return true; // it has this list
  }
  g_free(store->parameter_names);
  g_free(store->figures_of);
  store->parameter_names = g_steal_pointer(&names);
  store->figures_of = g_steal_pointer(&of);
  store->list =
      sb_store_list_number(store->parameter_names, store->figures_of, sb_engine_identity()->source);
  store->parameters = g_strv_length((char **)parameters);
  store->figures = g_strv_length((char **)figures);
  // A store that is only read receives the list when it is written.
  if (store->writable && !(sb_store_begin(store, error) && write_list(store, error))) {
    g_clear_pointer(&store->parameter_names, g_free); // the next call writes it
    return false;
  }
  return true;
}

// ---- Changes ----

bool sb_store_open_for_writing(SbStore *store, GError **error) {
  return store->writable || (open_writable(store, error) &&
                             (store->parameter_names == NULL || write_list(store, error)));
}

bool sb_store_lock(SbStore *store, GError **error) {
  return open_writable(store, error);
}

bool sb_store_reopen(SbStore *store, GError **error) {
  return open_readable(store, SQLITE_OPEN_READONLY, SB_STORE_FORMAT, error);
}

bool sb_store_begin(SbStore *store, GError **error) {
  if (!sb_store_open_for_writing(store, error)) {
    return false;
  }
  store->open_transaction = store->open_transaction || run_sql(store, "BEGIN IMMEDIATE", error);
  return store->open_transaction;
}

bool sb_store_commit(SbStore *store, GError **error) {
  if (!store->open_transaction) {
    return true;
  }
  store->open_transaction = false;
  return run_sql(store, "COMMIT", error);
}

bool sb_store_close(SbStore *store, GError **error) {
  if (store == NULL) {
    return true;
  }
  const bool good = sb_store_commit(store, error);
  destroy(store);
  return good;
}

void sb_store_discard(SbStore *store) {
  if (store != NULL) {
    if (store->open_transaction) {
      (void)run_sql(store, "ROLLBACK", NULL);
    }
    destroy(store);
  }
}

bool sb_store_get(SbStore *store, const guint8 key[SB_STORE_KEY], SbStoredAnswer *out) {
  SbStoreRecord record = {0};
  sqlite3_reset(store->get);
  bool found = sqlite3_bind_blob(store->get, 1, key, SB_STORE_KEY, SQLITE_STATIC) == SQLITE_OK &&
               sqlite3_bind_int64(store->get, 2, store->list) == SQLITE_OK &&
               sqlite3_step(store->get) == SQLITE_ROW;
  if (found) {
    sb_store_record(&record, store->get);
    found = sb_store_is_sound(&record) && record.status >= 0 && record.status <= SB_ERROR_IO &&
            (size_t)record.figures_size == store->figures * sizeof(double);
  }
  if (found) {
    if (record.figures_size > 0) {
      memcpy(out->value, record.figures, (size_t)record.figures_size);
    }
    out->status = (SbStatus)record.status;
    out->reason = g_strdup(record.reason);
    out->warnings = g_strdup(record.warnings);
  }
  sqlite3_reset(store->get);
  return found;
}

bool sb_store_put_record(SbStore *store, const SbStoreRecord *record, GError **error) {
  sqlite3_stmt *put = store->put;
  sqlite3_reset(put);
  const bool good =
      (sqlite3_bind_blob(put, 1, record->key, record->key_size, SQLITE_STATIC) == SQLITE_OK &&
       sqlite3_bind_int64(put, 2, record->list) == SQLITE_OK &&
       sqlite3_bind_int64(put, 3, record->status) == SQLITE_OK &&
       sqlite3_bind_text(put, 4, record->reason, -1, SQLITE_STATIC) == SQLITE_OK &&
       sqlite3_bind_text(put, 5, record->warnings, -1, SQLITE_STATIC) == SQLITE_OK &&
       sqlite3_bind_blob(put, 6, record->parameters, record->parameters_size, SQLITE_STATIC) ==
           SQLITE_OK &&
       sqlite3_bind_blob(put, 7, record->figures, record->figures_size, SQLITE_STATIC) ==
           SQLITE_OK &&
       sqlite3_bind_blob(put, 8, record->sum, record->sum_size, SQLITE_STATIC) == SQLITE_OK &&
       sqlite3_step(put) == SQLITE_DONE) ||
      sb_store_fail(store, SB_APP_ERROR_IO, error);
  sqlite3_reset(put);
  return good;
}

bool sb_store_put(SbStore *store, const guint8 key[SB_STORE_KEY], const double *parameter,
                  const SbStoredAnswer *answer, GError **error) {
  guint8 sum[SB_STORE_SUM];
  if (!sb_store_begin(store, error)) {
    return false;
  }
  SbStoreRecord record = {.key = key,
                          .key_size = SB_STORE_KEY,
                          .list = store->list,
                          .status = answer->status,
                          .reason = answer->reason,
                          .warnings = answer->warnings,
                          // SQLite stores NULL for a pointer that is NULL.
                          .parameters = store->parameters > 0 ? (const void *)parameter : "",
                          .parameters_size = (int)(store->parameters * sizeof(double)),
                          .figures = store->figures > 0 ? (const void *)answer->value : "",
                          .figures_size = (int)(store->figures * sizeof(double)),
                          .sum = sum,
                          .sum_size = SB_STORE_SUM};
  write_sum(sum, &record);
  return sb_store_put_record(store, &record, error);
}

guint64 sb_store_count(SbStore *store) {
  return (guint64)MAX(sb_store_number(store, "SELECT count(*) FROM answer"), 0);
}
