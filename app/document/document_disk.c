// See document_disk.h.
#include "app/document/document_disk.h"

#include "app/base/reader.h"
#include "app/document/document_private.h"

#include <fcntl.h>
#include <string.h>

// What is compared before the bytes are.
static bool look(SbFileStamp *out, const char *path) {
  struct stat info;
  if (stat(path, &info) != 0) {
    return false;
  }
  out->device = info.st_dev;
  out->inode = info.st_ino;
  out->size = info.st_size;
  out->time = info.st_mtim;
  return true;
}

void sb_file_stamp_finish(SbFileStamp *stamp) {
  g_free(stamp->sha256);
  *stamp = (SbFileStamp){0};
}

void sb_file_stamp_set(SbFileStamp *stamp, const char *path, const char *text, size_t length) {
  sb_file_stamp_finish(stamp);
  stamp->sha256 = g_compute_checksum_for_data(G_CHECKSUM_SHA256, (const guchar *)text, length);
  stamp->seen = look(stamp, path);
}

static SbDiskState compare(const SbFileStamp *stamp, const char *path) {
  SbFileStamp now = {0};
  if (!look(&now, path)) {
    return SB_DISK_GONE;
  }
  if (stamp->seen && now.device == stamp->device && now.inode == stamp->inode &&
      now.size == stamp->size && now.time.tv_sec == stamp->time.tv_sec &&
      now.time.tv_nsec == stamp->time.tv_nsec) {
    return SB_DISK_SAME;
  }
  g_autoptr(GPtrArray) none = sb_issues_new();
  size_t length = 0;
  g_autofree char *text = sb_reader_load(&length, path, path, SB_DOCUMENT_BYTES_MAX, none);
  g_autofree char *sha256 =
      text != NULL ? g_compute_checksum_for_data(G_CHECKSUM_SHA256, (const guchar *)text, length)
                   : NULL;
  return g_strcmp0(sha256, stamp->sha256) == 0 ? SB_DISK_SAME : SB_DISK_CHANGED;
}

SbDiskState sb_document_disk_state(const SbDocument *document) {
  if (document->path == NULL || document->disk.sha256 == NULL) {
    return SB_DISK_SAME;
  }
  SbDiskState own = compare(&document->disk, document->path);
  if (own == SB_DISK_SAME && document->valve_disk.sha256 != NULL &&
      compare(&document->valve_disk, document->valve_path) == SB_DISK_CHANGED) {
    return SB_DISK_VALVE_CHANGED;
  }
  return own;
}

const char *sb_document_file_text(const SbDocument *document) {
  return document->text;
}

// Merging -----------------------------------------------------------------------------------------

typedef struct {
  GPtrArray *entries;
  GHashTable *value; // "group\nname" to the value, borrowed from entries
} Scan;

static Scan scan(const char *text) {
  g_autoptr(GPtrArray) none = sb_issues_new();
  Scan out = {sb_reader_scan(text, strlen(text), "", none),
              g_hash_table_new_full(g_str_hash, g_str_equal, g_free, NULL)};
  for (guint i = 0; i < out.entries->len; i++) {
    const SbEntry *entry = out.entries->pdata[i];
    if (entry->name != NULL) {
      g_hash_table_insert(out.value, g_strjoin("\n", entry->group, entry->name, NULL),
                          entry->value);
    }
  }
  return out;
}

static void scan_finish(Scan *of) {
  g_ptr_array_unref(of->entries);
  g_hash_table_unref(of->value);
}

// Adds the change of one key from base to mine, where there is one that theirs has not made.
static void add_change(GArray *changes, GPtrArray *conflicts, const SbEntry *entry,
                       const Scan *base, const Scan *mine, const Scan *theirs) {
  g_autofree char *key = g_strjoin("\n", entry->group, entry->name, NULL);
  const char *was = g_hash_table_lookup(base->value, key);
  const char *wanted = g_hash_table_lookup(mine->value, key);
  const char *there = g_hash_table_lookup(theirs->value, key);
  if (g_strcmp0(was, wanted) == 0 || g_strcmp0(there, wanted) == 0) {
    return;
  }
  const SbChange change = {entry->group, entry->name, wanted};
  g_array_append_val(changes, change);
  if (conflicts != NULL && g_strcmp0(there, was) != 0) {
    g_ptr_array_add(conflicts,
                    g_strdup_printf("%s.%s: %s (in the file: %s)", entry->group, entry->name,
                                    wanted != NULL ? wanted : "–", there != NULL ? there : "–"));
  }
}

// Merges three versions of a key file: returns `theirs` with the changes from `base` to `mine`, key
// by key, with the order of lines and the comments of `theirs`. If both sides changed a key to
// different values, `mine` is used and a line "group.key: VALUE (in the file: VALUE)" is appended
// to `conflicts` (of char *; may be NULL).
static char *merge_texts(const char *base, const char *mine, const char *theirs,
                         GPtrArray *conflicts) {
  Scan was = scan(base), wanted = scan(mine), there = scan(theirs);
  g_autoptr(GArray) changes = g_array_new(FALSE, FALSE, sizeof(SbChange));
  for (guint i = 0; i < was.entries->len; i++) {
    const SbEntry *entry = was.entries->pdata[i];
    g_autofree char *key =
        entry->name != NULL ? g_strjoin("\n", entry->group, entry->name, NULL) : NULL;
    if (key != NULL && !g_hash_table_contains(wanted.value, key)) {
      add_change(changes, conflicts, entry, &was, &wanted, &there); // removed
    }
  }
  for (guint i = 0; i < wanted.entries->len; i++) {
    const SbEntry *entry = wanted.entries->pdata[i];
    if (entry->name != NULL) {
      add_change(changes, conflicts, entry, &was, &wanted, &there);
    }
  }
  char *out =
      sb_writer_apply(theirs, there.entries, (const SbChange *)(void *)changes->data, changes->len);
  scan_finish(&was);
  scan_finish(&wanted);
  scan_finish(&there);
  return out;
}

// Makes the values, rubber, data, pins and notes of `from` those of `document`, as edits.
static bool take_changes(SbDocument *document, const SbDocument *from, GPtrArray *issues) {
  const char *rubber = sb_document_gives_rubber(from) ? sb_document_rubber(from) : NULL;
  if (!sb_document_set_rubber(document, rubber, issues)) {
    return false;
  }
  for (int i = 0; i < SB_PARAM_COUNT; i++) {
    const SbParamId id = (SbParamId)i;
    const bool given = sb_document_gives(document, id);
    if (sb_document_gives(from, id)) {
      const double value = sb_document_value(from, id);
      if (!given || sb_document_value(document, id) != value) {
        // A value of one document is one of the other's.
        g_warn_if_fail(sb_document_set_value(document, id, value, false, NULL));
      }
    } else if (given) {
      sb_document_unset(document, id);
    }
  }
  for (int key = SB_FILE_SECTION; key < SB_FILE_COUNT; key++) {
    const char *own = sb_document_own_drawing(from, (SbFileKey)key);
    if (g_strcmp0(own, sb_document_own_drawing(document, (SbFileKey)key)) != 0) {
      sb_document_edit_drawing(document, sb_document_drawing_now(from, (SbFileKey)key));
    }
  }
  const SbData *data = sb_document_data_count(from) > 0 ? sb_document_data(from, 0) : NULL;
  const SbData *before =
      sb_document_data_count(document) > 0 ? sb_document_data(document, 0) : NULL;
  if (!sb_data_same(data, before)) {
    sb_document_put_data(document, data != NULL ? sb_data_copy(data) : NULL);
  }
  sb_document_take_pins(document, from);
  sb_document_take_remarks(document, from);
  return true;
}

SbDocument *sb_document_load_with(const char *path, const char *base, const char *mine,
                                  GPtrArray *conflicts, GPtrArray *issues) {
  SbDocument *document = path != NULL ? sb_document_load(path, issues) : sb_document_new();
  if (document == NULL) {
    return NULL;
  }
  g_autofree char *folder = path != NULL ? g_path_get_dirname(path) : NULL;
  g_autofree char *merged = base != NULL && path != NULL
                                ? merge_texts(base, mine, document->text, conflicts)
                                : g_strdup(mine);
  const char *name = path != NULL ? path : document->title;
  g_autoptr(SbDocument) changed = sb_document_parse(merged, strlen(merged), name, folder, issues);
  if (changed == NULL || !take_changes(document, changed, issues)) {
    g_clear_pointer(&document, sb_document_free);
  }
  return document;
}

// All but the history, which stays with the document that has it.
void sb_document_exchange(SbDocument *a, SbDocument *b) {
  g_autofree SbDocument *one = g_memdup2(a, sizeof *a); // too large for the stack
  const unsigned serial = MAX(a->serial, b->serial) + 1;
  GArray *edits = b->edits;
  const guint done = b->done;
  *a = *b;
  *b = *one;
  a->edits = one->edits;
  a->done = one->done;
  b->edits = edits;
  b->done = done;
  a->mergeable = b->mergeable = false;
  a->serial = b->serial = serial;
}

char *sb_document_free_path(const SbDocument *document) {
  const char *base = strrchr(document->path, '/');
  const char *dot = strrchr(base != NULL ? base : document->path, '.');
  const char *ending = dot != NULL ? dot : "";
  const int length = (int)(strlen(document->path) - strlen(ending));
  char *path = NULL;
  int number = 2;
  do {
    g_free(path);
    path = g_strdup_printf("%.*s (%d)%s", length, document->path, number++, ending);
  } while (g_file_test(path, G_FILE_TEST_EXISTS));
  return path;
}
