// Documents as text and files: only the lines that differ are rewritten.
#include "app/base/output.h"
#include "app/base/reader.h"
#include "app/base/writer.h"
#include "app/document/document_private.h"

#include <math.h>
#include <string.h>

// Path of `target` as seen from `directory`. Owned by the caller.
static char *relative_path(const char *target, const char *directory) {
  g_autofree char *to = g_canonicalize_filename(target, NULL);
  g_autofree char *from = g_canonicalize_filename(directory, NULL);
  g_auto(GStrv) a = g_strsplit(to, "/", -1);
  g_auto(GStrv) b = g_strsplit(from, "/", -1);
  size_t common = 0;
  while (a[common] != NULL && b[common] != NULL && strcmp(a[common], b[common]) == 0) {
    common++;
  }
  GString *path = g_string_new(NULL);
  for (size_t i = common; b[i] != NULL && *b[i] != '\0'; i++) {
    g_string_append(path, "../");
  }
  for (size_t i = common; a[i] != NULL; i++) {
    g_string_append_printf(path, "%s%s", a[i], a[i + 1] != NULL ? "/" : "");
  }
  return g_string_free(path, FALSE);
}

// What a document at `path` must call a file that it names `name` and finds at `target`; NULL if
// nothing changes. Owned by the caller.
static char *moved_name(const SbDocument *document, const char *target, const char *old_name,
                        const char *path) {
  if (target == NULL || path == NULL || g_path_is_absolute(old_name)) {
    return NULL;
  }
  g_autofree char *directory = g_path_get_dirname(path);
  char *name = relative_path(target, directory);
  g_autofree char *before =
      document->path != NULL ? g_path_get_dirname(document->path) : g_strdup(".");
  g_autofree char *same = relative_path(directory, before);
  if (*same == '\0') {
    g_clear_pointer(&name, g_free);
  }
  return name;
}

static char *moved_valve(const SbDocument *document, const char *path) {
  return moved_name(document, document->valve_path, document->valve_name, path);
}

// Splits a catalogue key at its last dot; both owned by the caller.
static void split_key(const char *key, char **group, char **name) {
  const char *dot = strrchr(key, '.');
  *group = g_strndup(key, (size_t)(dot - key));
  *name = g_strdup(dot + 1);
}

// Whether the document's text gives a key this value.
static bool stands(const SbDocument *document, const char *key, const char *value) {
  g_autofree char *group = NULL, *name = NULL;
  split_key(key, &group, &name);
  for (guint i = 0; i < document->entries->len; i++) {
    const SbEntry *entry = document->entries->pdata[i];
    if (entry->name != NULL && strcmp(entry->group, group) == 0 && strcmp(entry->name, name) == 0 &&
        strcmp(entry->value, value) == 0) {
      return true;
    }
  }
  return false;
}

// The name of a file of its own there; NULL if nothing changes. Owned by the caller.
static char *moved_file(const SbDocument *document, int key, const char *path) {
  const SbNamedFile *file = &document->file[key];
  if (file->in_valve || file->path == NULL) {
    return NULL;
  }
  // An edit taken back brings a name from before the document was saved elsewhere.
  g_autofree char *folder = document->path != NULL ? g_path_get_dirname(document->path) : NULL;
  g_autofree char *named = g_canonicalize_filename(file->name, folder);
  g_autofree char *whole = g_canonicalize_filename(file->path, NULL);
  if (strcmp(named, whole) != 0 && !g_path_is_absolute(file->name)) {
    g_autofree char *to = path != NULL ? g_path_get_dirname(path) : NULL;
    return to != NULL ? relative_path(whole, to) : g_strdup(whole);
  }
  char *moved = moved_name(document, file->path, file->name, path);
  return moved != NULL || stands(document, sb_document_file_key(key), file->name)
             ? moved
             : g_strdup(file->name);
}

static void free_changes(GArray *changes) {
  for (guint i = 0; i < changes->len; i++) {
    SbChange *change = &g_array_index(changes, SbChange, i);
    g_free((char *)change->group);
    g_free((char *)change->name);
    g_free((char *)change->value);
  }
  g_array_unref(changes);
}

// The name in the heading of a group of measured data; empty: none.
static const char *data_name(const char *group) {
  return group[4] == ' ' ? group + 5 : "";
}

static SbData *group_written_to(const SbDocument *document, const char *group) {
  for (size_t i = 0; i < sb_document_data_count(document); i++) {
    SbData *data = document->measured->pdata[i];
    if (strcmp(data->name, data_name(group)) == 0) {
      return data;
    }
  }
  return NULL;
}

// The groups of measured data where they are not the file's: the keys of the first group if an edit
// removed it, then all groups in force. The lines of groups that could not be read stay.
static void change_data(GArray *changes, const SbDocument *document, const char *path) {
  const SbData *first = document->saved_measured;
  for (guint i = 0; first != NULL && i < document->entries->len; i++) {
    const SbEntry *entry = document->entries->pdata[i];
    if (entry->name != NULL && sb_data_is_group(entry->group) &&
        strcmp(data_name(entry->group), first->name) == 0 &&
        group_written_to(document, entry->group) == NULL) {
      const SbChange change = {g_strdup(entry->group), g_strdup(entry->name), NULL};
      g_array_append_val(changes, change);
    }
  }
  for (size_t i = 0; i < sb_document_data_count(document); i++) {
    const SbData *data = sb_document_data(document, i);
    const char *gap = *data->name != '\0' ? " " : "";
    g_autofree char *folder = path != NULL ? g_path_get_dirname(path) : NULL;
    for (int key = 0; key < SB_DATA_KEY_COUNT; key++) {
      const bool near = key == SB_DATA_FILE && folder != NULL;
      SbChange change = {g_strconcat("data", gap, data->name, NULL),
                         g_strdup(sb_data_key_name((SbDataKey)key)),
                         near ? relative_path(data->path, folder) : g_strdup(data->text[key])};
      g_array_append_val(changes, change);
    }
  }
}

char *sb_document_to_text(const SbDocument *document, const char *path) {
  GArray *changes = g_array_new(FALSE, FALSE, sizeof(SbChange));
  char *valve = moved_valve(document, path);
  if (valve != NULL) {
    SbChange change = {g_strdup(SB_META_GROUP), g_strdup("valve"), valve};
    g_array_append_val(changes, change);
  }
  for (int i = 0; i < SB_FILE_COUNT; i++) {
    char *name = moved_file(document, i, path);
    const bool taken_back =
        document->saved_drawing[i] != NULL && sb_document_own_drawing(document, i) == NULL;
    if (name != NULL || taken_back) {
      SbChange change = {.value = name};
      split_key(sb_document_file_key(i), (char **)&change.group, (char **)&change.name);
      g_array_append_val(changes, change);
    }
  }
  const bool data_differs = sb_document_data_differs(document);
  if (data_differs) {
    change_data(changes, document, path);
  }
  for (size_t i = 0; i < sb_document_data_count(document) && !data_differs; i++) {
    const SbData *data = sb_document_data(document, i);
    char *file = moved_name(document, data->path, data->text[SB_DATA_FILE], path);
    if (file != NULL) {
      const char *gap = *data->name != '\0' ? " " : "";
      SbChange change = {g_strconcat("data", gap, data->name, NULL), g_strdup("file"), file};
      g_array_append_val(changes, change);
    }
  }
  sb_document_change_remarks(changes, document);
  g_autofree char *folder = path != NULL ? g_path_get_dirname(path) : NULL;
  char *rubber = sb_document_rubber_name_at(document, folder);
  const bool was = document->saved_rubber != NULL;
  if (g_strcmp0(rubber, was ? document->saved_rubber->name : NULL) != 0) {
    SbChange change = {g_strdup("rubber"), g_strdup("name"), rubber};
    g_array_append_val(changes, change);
  } else {
    g_free(rubber);
  }
  for (int i = 0; i < SB_PARAM_COUNT; i++) {
    if (sb_document_differs(document, (SbParamId)i)) {
      char *group = NULL;
      char *name = NULL;
      split_key(sb_param((SbParamId)i)->key, &group, &name);
      char *value =
          document->own.given[i] ? sb_param_format((SbParamId)i, document->own.value[i]) : NULL;
      SbChange change = {group, name, value};
      g_array_append_val(changes, change);
    }
  }
  sb_document_change_pins(changes, document);
  char *text = sb_writer_apply(document->text, document->entries, (const SbChange *)changes->data,
                               changes->len);
  free_changes(changes);
  return text;
}

// Appends the values of the `length` bytes long group at `group`, and its heading if there are any.
static void append_group(GString *text, const SbParams *params, const char *group, size_t length) {
  bool heading = false;
  for (int i = 0; i < SB_PARAM_COUNT; i++) {
    const SbParam *param = sb_param((SbParamId)i);
    // What nobody gave and follows from another parameter needs no line; the stem's mass follows
    // its parts'.
    SbParamDefault derived;
    bool follows = i == SB_P_STEM_MASS || sb_param_follows((SbParamId)i);
    // A rubber's file may not be there when the text is read again: its figures become values.
    sb_params_default(&derived, params, (SbParamId)i);
    bool needed = params->given[i] || !follows || derived.name != NULL;
    const char *dot = strrchr(param->key, '.');
    if (needed && (size_t)(dot - param->key) == length && strncmp(param->key, group, length) == 0) {
      if (!heading) {
        g_string_append_printf(text, "\n[%.*s]\n", (int)length, group);
        heading = true;
      }
      g_autofree char *value = sb_param_format((SbParamId)i, sb_params_get(params, (SbParamId)i));
      g_string_append_printf(text, "%s = %s\n", dot + 1, value);
    }
  }
}

// Appends a part's shape to the group whose first parameter is `first`, unless a size that is in
// force differs from it: a file with both would be refused, and the numbers take precedence.
static void append_shape(GString *text, const SbDocument *document, SbParamId first) {
  const SbShapes *shapes = document->shapes;
  for (guint i = 0; i < shapes->sizes->len; i++) {
    SbParamId id = ((const SbShapeSize *)shapes->sizes->pdata[i])->id;
    double shape = sb_shapes_size(shapes, id)->value, value = sb_document_value(document, id);
    if (fabs(shape - value) > SB_SHAPE_ROUNDING * fabs(value)) {
      return;
    }
  }
  for (size_t i = 0; i < G_N_ELEMENTS(sb_shape_parts); i++) {
    if (shapes->text[i] != NULL && first == sb_parts_mass((int)i)) {
      g_string_append(text, shapes->text[i]);
    }
  }
}

// Appends the files that keys of a group name, from the root.
static void append_files(GString *text, const SbDocument *document, const char *group,
                         size_t length) {
  for (int i = 0; i < SB_FILE_COUNT; i++) {
    const char *key = sb_document_file_key(i), *dot = strrchr(key, '.');
    if (document->file[i].path != NULL && (size_t)(dot - key) == length &&
        strncmp(key, group, length) == 0) {
      g_autofree char *whole = g_canonicalize_filename(document->file[i].path, NULL);
      g_string_append_printf(text, "%s = %s\n", dot + 1, whole);
    }
  }
}

char *sb_document_to_flat_text(const SbDocument *document) {
  SbParams params = sb_document_params(document);
  GString *text = g_string_new("[" SB_META_GROUP "]\nformat = 1\nkind = valve\n");
  g_string_append_printf(text, "title = %s\n", document->title);
  // Each group once, in the catalogue's order.
  g_autoptr(GHashTable) seen = g_hash_table_new_full(g_str_hash, g_str_equal, g_free, NULL);
  for (int i = 0; i < SB_PARAM_COUNT; i++) {
    const char *key = sb_param((SbParamId)i)->key;
    size_t length = (size_t)(strrchr(key, '.') - key);
    if (g_hash_table_add(seen, g_strndup(key, length))) {
      append_group(text, &params, key, length);
      append_shape(text, document, (SbParamId)i);
      append_files(text, document, key, length);
    }
  }
  sb_document_append_limits(text, &document->limits);
  sb_document_append_cases(text, document->cases);
  return g_string_free(text, FALSE);
}

bool sb_document_save(SbDocument *document, const char *path, GError **error) {
  char *text = sb_document_to_text(document, path);
  if (!sb_output_write(path, text, strlen(text), error)) {
    g_free(text);
    return false;
  }
  // Now the file says what the document says.
  char *valve = moved_valve(document, path);
  if (valve != NULL) {
    g_free(document->valve_name);
    document->valve_name = valve;
    g_autofree char *directory = g_path_get_dirname(path);
    g_free(document->valve_path);
    document->valve_path = g_build_filename(directory, valve, NULL);
  }
  for (int i = 0; i < SB_FILE_COUNT; i++) {
    char *name = moved_file(document, i, path);
    if (name != NULL) {
      g_autofree char *directory = g_path_get_dirname(path);
      SbNamedFile *file = &document->file[i];
      g_free(file->name);
      g_free(file->path);
      const bool whole = g_path_is_absolute(name);
      *file = (SbNamedFile){name, whole ? g_strdup(name) : g_build_filename(directory, name, NULL),
                            false};
    }
  }
  g_free(document->text);
  document->text = text;
  sb_file_stamp_set(&document->disk, path, text, strlen(text));
  g_autoptr(GPtrArray) none = sb_issues_new();
  g_ptr_array_unref(document->entries);
  document->entries = sb_reader_scan(text, strlen(text), path, none);
  if (document->measured != NULL) {
    g_autofree char *directory = g_path_get_dirname(path);
    g_ptr_array_unref(document->measured);
    document->measured = sb_data_read(document->entries, directory, path, none);
  }
  sb_document_data_saved(document);
  document->pins_changed = false;
  document->remarks_changed = false;
  char *kept = g_strdup(path);
  g_free(document->path);
  document->path = kept;
  sb_document_faults_saved(document);
  document->saved = document->own;
  if (document->own_rubber != NULL) {
    g_autofree char *folder = g_path_get_dirname(path);
    char *name = sb_document_rubber_name_at(document, folder);
    g_free(document->own_rubber->name);
    document->own_rubber->name = name;
  }
  sb_named_rubber_release(document->saved_rubber);
  document->saved_rubber = sb_named_rubber_hold(document->own_rubber);
  sb_document_drawings_saved(document);
  document->mergeable = false;
  sb_document_refresh_title(document);
  return true;
}
