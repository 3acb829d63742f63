// The rows of a store in the order of the file: what is damaged, and what can be saved.
#include "app/study/store_private.h"

#include "engine/base/version.h"

#include <glib/gstdio.h>
#include <math.h>
#include <string.h>

static const char SELECT_ROWS[] =
    "SELECT key, list, status, reason, warnings, parameters, figures, sum FROM answer ORDER BY key";
static const char SELECT_ROWS_1[] =
    "SELECT key, list, status, reason, NULL, parameters, figures, NULL FROM answer ORDER BY key";

// ---- Lists ----

static void free_list(void *data) {
  SbStoreList *list = data;
  g_strfreev(list->parameter);
  g_strfreev(list->figure);
  g_free(list->engine);
  g_free(list);
}

static const char *text_of(sqlite3_stmt *row, int column) {
  const char *text = (const char *)sqlite3_column_text(row, column);
  return text != NULL ? text : "";
}

// Lists by number; damaged ones are left out.
static GHashTable *read_lists(SbStore *store) {
  GHashTable *lists = g_hash_table_new_full(g_int64_hash, g_int64_equal, g_free, free_list);
  sqlite3_stmt *query = NULL;
  const bool old = store->format < 2;
  const char *text = old ? "SELECT id, parameters, figures, '' FROM list"
                         : "SELECT id, parameters, figures, engine FROM list";
  if (sqlite3_prepare_v2(store->file, text, -1, &query, NULL) == SQLITE_OK) {
    while (sqlite3_step(query) == SQLITE_ROW) {
      const gint64 id = sqlite3_column_int64(query, 0);
      const char *parameters = text_of(query, 1), *figures = text_of(query, 2);
      if (old || sb_store_list_number(parameters, figures, text_of(query, 3)) == id) {
        SbStoreList *list = g_new0(SbStoreList, 1);
        list->parameter = g_strsplit(parameters, old ? "," : "\n", -1);
        list->figure = g_strsplit(figures, old ? "," : "\n", -1);
        list->engine = g_strdup(text_of(query, 3));
        g_hash_table_replace(lists, g_memdup2(&id, sizeof id), list);
      }
    }
  }
  sqlite3_finalize(query);
  return lists;
}

// ---- Rows ----

static const char *damage_of(const SbStoreRecord *record, const SbStoreList *list, int format,
                             const guint8 *before) {
  const size_t size = sizeof(double);
  if (record->key_size != SB_STORE_KEY) {
    return "its key is cut";
  }
  if (format >= 2 && !sb_store_is_sound(record)) {
    return "its checksum does not match its content";
  }
  if (before != NULL && memcmp(before, record->key, SB_STORE_KEY) >= 0) {
    return memcmp(before, record->key, SB_STORE_KEY) == 0 ? "it repeats the row before"
                                                          : "it is out of order";
  }
  if (record->status < 0 || record->status > SB_ERROR_IO) {
    return "its status does not exist";
  }
  if (list != NULL && ((size_t)record->parameters_size != size * g_strv_length(list->parameter) ||
                       (size_t)record->figures_size != size * g_strv_length(list->figure))) {
    return "its values are not those of its list";
  }
  return NULL;
}

typedef struct {
  SbStore *store;
  GHashTable *lists;
  SbStoreVisit visit;
  void *data;
} Visit;

// Calls the visitor with the row of a statement. `before`: key of the row before, or NULL.
static bool visit_row(const Visit *of, const SbStoreRecord *record, guint64 number,
                      const guint8 *before) {
  static const guint8 no_key[SB_STORE_KEY];
  const SbStoreList *list = g_hash_table_lookup(of->lists, &record->list);
  // The bytes of a row have no alignment.
  g_autofree double *parameter = g_memdup2(record->parameters, (gsize)record->parameters_size);
  g_autofree double *figure = g_memdup2(record->figures, (gsize)record->figures_size);
  const SbStoreRow row = {.number = number,
                          .key = record->key_size == SB_STORE_KEY ? record->key : no_key,
                          .list_number = record->list,
                          .list = list,
                          .status = (SbStatus)record->status,
                          .reason = record->reason,
                          .warnings = record->warnings,
                          .parameter = parameter,
                          .figure = figure,
                          .parameters = (size_t)record->parameters_size / sizeof(double),
                          .figures = (size_t)record->figures_size / sizeof(double),
                          .damage = damage_of(record, list, of->store->format, before),
                          .sum = record->sum_size == SB_STORE_SUM ? record->sum : NULL};
  return of->visit(of->data, &row);
}

// Ascending, or from the end of the file. SQLite's last code: SQLITE_DONE after all rows.
static int visit_rows(const Visit *of, bool descending, guint64 *number) {
  sqlite3_stmt *query = NULL;
  g_autofree char *text = g_strconcat(of->store->format < 2 ? SELECT_ROWS_1 : SELECT_ROWS,
                                      descending ? " DESC" : "", NULL);
  int code = sqlite3_prepare_v2(of->store->file, text, -1, &query, NULL);
  guint8 before[SB_STORE_KEY];
  bool any = false, goes_on = true;
  while (code == SQLITE_OK && goes_on && (code = sqlite3_step(query)) == SQLITE_ROW) {
    SbStoreRecord record;
    sb_store_record(&record, query);
    // Only the ascending visit names rows out of order.
    goes_on = visit_row(of, &record, ++*number, any && !descending ? before : NULL);
    if (record.key_size == SB_STORE_KEY) {
      memcpy(before, record.key, SB_STORE_KEY);
      any = true;
    }
    code = goes_on ? SQLITE_OK : SQLITE_DONE;
  }
  sqlite3_finalize(query);
  return code;
}

// What is wrong with the pages of the file; NULL: nothing. Owned by the caller.
static char *structure_of(SbStore *store) {
  sqlite3_stmt *query = NULL;
  char *text = NULL;
  if (sqlite3_prepare_v2(store->file, "PRAGMA quick_check(1)", -1, &query, NULL) != SQLITE_OK ||
      sqlite3_step(query) != SQLITE_ROW) {
    text = g_strdup(sqlite3_errmsg(store->file));
  } else if (strcmp(text_of(query, 0), "ok") != 0) {
    text = g_strdelimit(g_strdup(text_of(query, 0)), "\n", ' ');
  }
  sqlite3_finalize(query);
  return text;
}

bool sb_store_visit(SbStore *store, SbStoreVisit visit, void *data, GError **error) {
  const Visit of = {store, read_lists(store), visit, data};
  guint64 number = 0;
  const int code = visit_rows(&of, false, &number);
  g_hash_table_unref(of.lists);
  if (code != SQLITE_DONE) {
    g_set_error(error, SB_APP_ERROR, SB_APP_ERROR_INPUT,
                "%s is damaged: after %" G_GUINT64_FORMAT " rows no more can be read (%s)",
                store->path, number, sqlite3_errstr(code));
    return false;
  }
  g_autofree char *structure = structure_of(store);
  if (structure != NULL) {
    g_set_error(error, SB_APP_ERROR, SB_APP_ERROR_INPUT,
                "%s is damaged: %" G_GUINT64_FORMAT " rows can be read, others may be missing (%s)",
                store->path, number, structure);
  }
  return structure == NULL;
}

char *sb_store_row_name(const SbStoreRow *row) {
  GString *text = g_string_new(NULL);
  g_string_printf(text, "row %" G_GUINT64_FORMAT " (key %02x%02x%02x%02x", row->number, row->key[0],
                  row->key[1], row->key[2], row->key[3]);
  for (size_t i = 0; row->list != NULL && i < row->parameters && row->list->parameter[i] != NULL;
       i++) {
    g_string_append_printf(text, ", %s = %.9g", row->list->parameter[i], row->parameter[i]);
  }
  g_string_append_c(text, ')');
  return g_string_free(text, FALSE);
}

// ---- Health ----

static bool see_health(void *data, const SbStoreRow *row) {
  SbStoreHealth *health = data;
  health->rows++;
  health->unnamed += row->damage == NULL && row->list == NULL;
  if (row->damage != NULL) {
    health->damaged++;
    if (health->first == NULL) {
      g_autofree char *name = sb_store_row_name(row);
      health->first = g_strdup_printf("%s: %s", name, row->damage);
    }
  }
  return true;
}

void sb_store_health(SbStoreHealth *out, SbStore *store) {
  g_autoptr(GError) error = NULL;
  *out = (SbStoreHealth){0};
  if (!sb_store_visit(store, see_health, out, &error)) {
    out->structure = g_strdup(error->message);
  }
}

void sb_store_health_release(SbStoreHealth *health) {
  g_free(health->first);
  g_free(health->structure);
  *health = (SbStoreHealth){0};
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

// ---- Copies ----

static SbStoreRecord record_of(const SbStoreRow *row) {
  return (SbStoreRecord){.key = row->key,
                         .key_size = SB_STORE_KEY,
                         .list = row->list_number,
                         .status = row->status,
                         .reason = row->reason,
                         .warnings = row->warnings,
                         .parameters = row->parameters > 0 ? (const void *)row->parameter : "",
                         .parameters_size = (int)(row->parameters * sizeof(double)),
                         .figures = row->figures > 0 ? (const void *)row->figure : "",
                         .figures_size = (int)(row->figures * sizeof(double)),
                         .sum = row->sum,
                         .sum_size = row->sum != NULL ? SB_STORE_SUM : 0};
}

typedef struct {
  SbStore *to;
  const char *from; // path
  sqlite3_stmt *find;
  guint64 saved;
  bool strict; // a damaged row is an error, and so is another answer to the same question
  GError *error;
} Copy;

static bool copy_list(const SbStoreRow *row, Copy *copy) {
  g_autofree char *parameters = g_strjoinv("\n", row->list->parameter);
  g_autofree char *figures = g_strjoinv("\n", row->list->figure);
  sqlite3_stmt *put = NULL;
  const bool good =
      (sqlite3_prepare_v2(copy->to->file, "INSERT OR REPLACE INTO list VALUES (?, ?, ?, ?)", -1,
                          &put, NULL) == SQLITE_OK &&
       sqlite3_bind_int64(put, 1, row->list_number) == SQLITE_OK &&
       sqlite3_bind_text(put, 2, parameters, -1, SQLITE_STATIC) == SQLITE_OK &&
       sqlite3_bind_text(put, 3, figures, -1, SQLITE_STATIC) == SQLITE_OK &&
       sqlite3_bind_text(put, 4, row->list->engine, -1, SQLITE_STATIC) == SQLITE_OK &&
       sqlite3_step(put) == SQLITE_DONE) ||
      sb_store_fail(copy->to, SB_APP_ERROR_IO, &copy->error);
  sqlite3_finalize(put);
  return good;
}

static bool is_same(const SbStoreRecord *a, const SbStoreRecord *b) {
  return a->sum_size == b->sum_size && memcmp(a->sum, b->sum, (size_t)a->sum_size) == 0;
}

// Names two answers to one question by the first figure that differs.
static void report_difference(Copy *copy, const SbStoreRow *row, const SbStoreRecord *other) {
  g_autofree char *name = sb_store_row_name(row);
  g_autoptr(GString) text = g_string_new(NULL);
  for (size_t i = 0; i < row->figures && row->list != NULL && text->len == 0; i++) {
    double value = NAN;
    if ((i + 1) * sizeof value <= (size_t)other->figures_size) {
      memcpy(&value, (const char *)other->figures + i * sizeof value, sizeof value);
    }
    if (memcmp(&value, row->figure + i, sizeof value) != 0) {
      g_string_printf(text, ": %s is %.17g and %.17g", row->list->figure[i], value, row->figure[i]);
    }
  }
  g_set_error(&copy->error, SB_APP_ERROR, SB_APP_ERROR_INPUT,
              "%s and %s have different results for one request%s, %s; nothing was merged",
              copy->to->path, copy->from, text->str, name);
}

// Whether the target has no row of this key; an equal one is no error.
static bool is_new(bool *good, Copy *copy, const SbStoreRow *row, const SbStoreRecord *record) {
  sqlite3_reset(copy->find);
  *good = true;
  if (sqlite3_bind_blob(copy->find, 1, row->key, SB_STORE_KEY, SQLITE_STATIC) != SQLITE_OK ||
      sqlite3_step(copy->find) != SQLITE_ROW) {
    return true;
  }
  SbStoreRecord other;
  sb_store_record(&other, copy->find);
  if (copy->strict && sb_store_is_sound(&other) && !is_same(&other, record)) {
    report_difference(copy, row, &other);
    *good = false;
  }
  // A damaged row of the target is replaced.
  const bool replace = *good && !sb_store_is_sound(&other);
  sqlite3_reset(copy->find);
  return replace;
}

static bool copy_row(void *data, const SbStoreRow *row) {
  Copy *copy = data;
  if (copy->error != NULL) {
    return false;
  }
  if (row->damage != NULL) {
    if (copy->strict) {
      g_autofree char *name = sb_store_row_name(row);
      g_set_error(&copy->error, SB_APP_ERROR, SB_APP_ERROR_INPUT,
                  "%s: %s: %s; nothing was merged: sealbench store recover saves the sound rows",
                  copy->from, name, row->damage);
      return false;
    }
    // Out of order is damage of the tree, not of the row.
    const SbStoreRecord record = record_of(row);
    if (!sb_store_is_sound(&record)) {
      return true;
    }
  }
  const SbStoreRecord record = record_of(row);
  bool good = true;
  if (is_new(&good, copy, row, &record)) {
    good = (row->list == NULL || copy_list(row, copy)) &&
           sb_store_put_record(copy->to, &record, &copy->error);
    copy->saved += good;
  }
  return good;
}

static bool copy_origins(SbStore *to, SbStore *from, GError **error) {
  sqlite3_stmt *get = NULL, *put = NULL;
  bool good = sqlite3_prepare_v2(to->file, "INSERT OR REPLACE INTO origin VALUES (?, ?, ?, ?)", -1,
                                 &put, NULL) == SQLITE_OK ||
              sb_store_fail(to, SB_APP_ERROR_IO, error);
  // Who wrote a damaged store matters less than its rows: what cannot be read is left out.
  if (good && sqlite3_prepare_v2(from->file, "SELECT source, version, commit_of, cpu FROM origin",
                                 -1, &get, NULL) == SQLITE_OK) {
    while (good && sqlite3_step(get) == SQLITE_ROW) {
      for (int i = 0; i < 4; i++) {
        sqlite3_bind_value(put, i + 1, sqlite3_column_value(get, i));
      }
      good = sqlite3_step(put) == SQLITE_DONE || sb_store_fail(to, SB_APP_ERROR_IO, error);
      sqlite3_reset(put);
    }
  }
  sqlite3_finalize(get);
  sqlite3_finalize(put);
  return good;
}

static bool visit_page(void *data, SbStore *page) {
  const Visit *all = data;
  const Visit visit = {page, all->lists, all->visit, all->data};
  guint64 number = 0;
  (void)visit_rows(&visit, false, &number);
  return number > 0;
}

// Copies rows and origins; of a damaged store that is not `strict` also the rows of pages that the
// table does not lead to.
static bool copy_rows(Copy *copy, SbStore *from, GError **error) {
  static const char find[] = "SELECT key, list, status, reason, warnings, parameters, figures, sum "
                             "FROM answer WHERE key = ?";
  bool good = sb_store_begin(copy->to, error) && copy_origins(copy->to, from, error);
  if (good && sqlite3_prepare_v2(copy->to->file, find, -1, &copy->find, NULL) != SQLITE_OK) {
    good = sb_store_fail(copy->to, SB_APP_ERROR_IO, error);
  }
  if (good) {
    Visit visit = {from, read_lists(from), copy_row, copy};
    guint64 number = 0;
    const int code = visit_rows(&visit, false, &number);
    g_autofree char *structure = code == SQLITE_DONE ? structure_of(from) : NULL;
    const bool whole = code == SQLITE_DONE && structure == NULL;
    if (!whole && copy->strict && copy->error == NULL) {
      g_set_error(&copy->error, SB_APP_ERROR, SB_APP_ERROR_INPUT,
                  "%s is damaged (%s); nothing was merged: sealbench store recover saves the sound "
                  "rows",
                  copy->from, structure != NULL ? structure : sqlite3_errstr(code));
    } else if (!whole && copy->error == NULL) {
      sb_store_visit_pages(from, visit_page, &visit);
    }
    g_hash_table_unref(visit.lists);
  }
  sqlite3_finalize(copy->find);
  if (copy->error != NULL) {
    g_propagate_error(error, copy->error);
    return false;
  }
  return good;
}

bool sb_store_merge(SbStore *store, const char *from, GError **error) {
  SbStore *other = sb_store_open(from, error);
  if (other == NULL) {
    return false;
  }
  Copy copy = {.to = store, .from = from, .strict = true};
  const bool good = copy_rows(&copy, other, error);
  sb_store_discard(other);
  return good;
}

bool sb_store_recover(guint64 *saved, SbStore *store, const char *to, GError **error) {
  *saved = 0;
  if (store->format < 2) {
    g_set_error(error, SB_APP_ERROR, SB_APP_ERROR_INPUT,
                "%s is a store of Sealbench 0.1, whose rows carry no checksums: no row can be "
                "verified; sealbench store export writes the rows that can be read",
                store->path);
    return false;
  }
  SbStore *target = sb_store_open(to, error);
  if (target == NULL) {
    return false;
  }
  Copy copy = {.to = target, .from = store->path};
  const bool good = copy_rows(&copy, store, error);
  *saved = copy.saved;
  if (!good) {
    sb_store_discard(target);
    g_unlink(to);
    return false;
  }
  return sb_store_close(target, error);
}

bool sb_store_repair(SbStore *store, GError **error) {
  g_autofree char *fresh = g_strconcat(store->path, ".new", NULL);
  guint64 saved;
  g_unlink(fresh);
  // The file is this process' alone until the new one has its name.
  if (!sb_store_lock(store, error) || !sb_store_recover(&saved, store, fresh, error)) {
    return false;
  }
  if (g_rename(fresh, store->path) != 0) {
    g_set_error(error, SB_APP_ERROR, SB_APP_ERROR_IO, "%s cannot be replaced", store->path);
    g_unlink(fresh);
    return false;
  }
  return sb_store_reopen(store, error);
}
