// Documents: reading them, values in layers, problems collected. Edits are document_edit.c, writing
// is document_write.c.
#include "app/base/nearest.h"
#include "app/base/output.h"
#include "app/base/reader.h"
#include "app/document/document_parts.h"
#include "app/document/document_private.h"
#include "app/document/picture.h"

#include <math.h>
#include <string.h>
#include <unistd.h>

SbDocument *sb_document_new(void) {
  SbDocument *document = g_new0(SbDocument, 1);
  document->kind = SB_DOCUMENT_VALVE;
  document->title = g_strdup("Untitled");
  document->text = g_strdup("[sealbench]\nformat = 1\nkind = valve\n");
  g_autoptr(GPtrArray) none = sb_issues_new();
  document->entries = sb_reader_scan(document->text, strlen(document->text), "", none);
  document->edits = g_array_new(FALSE, FALSE, sizeof(Edit));
  g_array_set_clear_func(document->edits, sb_document_clear_edit);
  document->notes = sb_issues_new();
  document->all_notes = sb_issues_new();
  document->faults = sb_issues_new();
  document->cases = sb_document_cases_new();
  document->pins = sb_document_pins_new();
  document->pins_broken = g_hash_table_new_full(g_str_hash, g_str_equal, g_free, NULL);
  sb_document_remarks_init(document);
  document->shapes = sb_shapes_new();
  sb_params_init(&document->base);
  sb_params_init(&document->own);
  sb_params_init(&document->saved);
  return document;
}

void sb_document_free(SbDocument *document) {
  if (document == NULL) {
    return;
  }
  g_free(document->path);
  g_free(document->name);
  g_free(document->title);
  g_free(document->valve_path);
  g_free(document->valve_name);
  g_clear_pointer(&document->measured, g_ptr_array_unref);
  sb_data_free(document->saved_measured);
  for (int i = 0; i < SB_FILE_COUNT; i++) {
    g_free(document->file[i].name);
    g_free(document->file[i].path);
    g_free(document->saved_drawing[i]);
  }
  sb_named_rubber_release(document->base_rubber);
  sb_named_rubber_release(document->own_rubber);
  sb_named_rubber_release(document->saved_rubber);
  sb_model_data_release(document->data);
  g_free(document->text);
  sb_file_stamp_finish(&document->disk);
  sb_file_stamp_finish(&document->valve_disk);
  g_ptr_array_unref(document->entries);
  g_array_unref(document->edits);
  g_ptr_array_unref(document->notes);
  g_ptr_array_unref(document->all_notes);
  g_ptr_array_unref(document->faults);
  g_ptr_array_unref(document->cases);
  g_ptr_array_unref(document->pins);
  g_hash_table_unref(document->pins_broken);
  sb_document_remarks_clear(document);
  sb_shapes_free(document->shapes);
  g_free(document);
}

// ---- Reading ----

// The value of [sealbench] NAME, or NULL.
static const char *meta_value(const GPtrArray *entries, const char *name) {
  for (guint i = 0; i < entries->len; i++) {
    const SbEntry *entry = entries->pdata[i];
    if (entry->name != NULL && strcmp(entry->group, SB_META_GROUP) == 0 &&
        strcmp(entry->name, name) == 0) {
      return entry->value;
    }
  }
  return NULL;
}

char *sb_document_key_hint(const char *key) {
  SbNearest nearest = sb_nearest(key);
  for (int i = 0; i < SB_PARAM_COUNT; i++) {
    sb_nearest_try(&nearest, sb_param((SbParamId)i)->key);
  }
  return sb_nearest_hint(&nearest);
}

static char *group_of(SbParamId id) {
  const char *key = sb_param(id)->key;
  return g_strndup(key, (gsize)(strrchr(key, '.') - key));
}

// Whether a group's names are no keys of the catalogue.
static bool has_own_names(const char *group) {
  return strcmp(group, SB_LIMITS_GROUP) == 0 || strcmp(group, SB_CASES_GROUP) == 0 ||
         strcmp(group, SB_PINS_GROUP) == 0 || sb_data_is_group(group) ||
         sb_document_is_remark_group(group);
}

// Whether any key stands in `group`; else an issue.
static bool check_group(const SbEntry *entry, const char *shown, GPtrArray *issues) {
  SbNearest nearest = sb_nearest(entry->group);
  g_autoptr(GPtrArray) groups = g_ptr_array_new_with_free_func(g_free); // for as long as `nearest`
  for (int i = 0; i < SB_PARAM_COUNT; i++) {
    char *group = group_of((SbParamId)i);
    g_ptr_array_add(groups, group);
    if (strcmp(group, entry->group) == 0) {
      return true;
    }
    sb_nearest_try(&nearest, group);
  }
  sb_nearest_try(&nearest, SB_LIMITS_GROUP);
  sb_nearest_try(&nearest, SB_CASES_GROUP);
  sb_nearest_try(&nearest, SB_PINS_GROUP);
  g_autofree char *hint = sb_nearest_hint(&nearest);
  sb_issues_add(issues, shown, entry->line, NULL, NULL, "unknown group [%s]%s", entry->group, hint);
  return false;
}

static SbModelData *data_of(SbDocument *document) {
  if (document->data == NULL && sb_model_data_create(&document->data) != SB_OK) {
    g_error("no memory for a document"); // as g_malloc() does
  }
  return document->data;
}

// Moves the values of a scanned file into `params`, which lie upon `base` (NULL: on nothing).
static void read_values(SbDocument *document, SbParams *params, const SbParams *base,
                        const GPtrArray *entries, const char *shown, const char *directory,
                        GPtrArray *issues) {
  bool known_group = true;
  for (guint i = 0; i < entries->len; i++) {
    const SbEntry *entry = entries->pdata[i];
    if (strcmp(entry->group, SB_META_GROUP) == 0) {
      continue;
    }
    if (entry->name == NULL) {
      known_group = has_own_names(entry->group) || check_group(entry, shown, issues);
      continue;
    }
    if (!known_group || has_own_names(entry->group) ||
        sb_parts_is_shape_key(entry->group, entry->name)) {
      continue;
    }
    g_autofree char *key = g_strdup_printf("%s.%s", entry->group, entry->name);
    int id = sb_param_find(key);
    if (strcmp(key, SB_RUBBER_KEY) == 0) {
      SbNamedRubber *rubber =
          sb_named_rubber_read(entry->value, directory, shown, entry->line, issues);
      if (rubber != NULL) {
        sb_document_put_rubber(
            document, params == &document->base ? &document->base_rubber : &document->own_rubber,
            rubber);
      }
    } else if (sb_document_find_file(key) >= 0) {
      // A file's name, no value: read_files.
    } else if (id < 0) {
      g_autofree char *hint = issues->len < SB_ISSUES_MAX ? sb_document_key_hint(key) : NULL;
      sb_issues_add(issues, shown, entry->line, key, NULL, "unknown key%s",
                    hint != NULL ? hint : "");
    } else {
      GError *error = NULL;
      double value = 0;
      SbReport report;
      if (!sb_param_parse(&value, (SbParamId)id, entry->value, &error)) {
        g_autofree char *range = sb_param_range((SbParamId)id);
        sb_issues_add(issues, shown, entry->line, key, range, "%s", error->message);
        g_error_free(error);
      } else if (sb_params_set(params, (SbParamId)id, value, &report) != SB_OK) {
        sb_issues_add(issues, shown, entry->line, key, NULL, "%s", report.text);
      } else {
        sb_hardness_note(document->notes, shown, entry->line, key, (SbParamId)id, entry->value);
      }
    }
  }
  sb_document_read_limits(&document->limits, entries, shown, issues);
  sb_document_read_cases(document->cases, SB_CASES_GROUP, entries, shown, issues);
  sb_parts_read(document->shapes, params, base, entries, shown, directory, issues, document->notes);
}

// Checks group [sealbench] and finds the kind. False if this is no document at all.
static bool read_meta(SbDocumentKind *kind, const GPtrArray *entries, const char *shown,
                      GPtrArray *issues) {
  const SbEntry *first = entries->len > 0 ? entries->pdata[0] : NULL;
  if (first == NULL || strcmp(first->group, SB_META_GROUP) != 0) {
    sb_issues_add(issues, shown, 0, NULL, NULL,
                  "is not a valve or scene: the first group must be [sealbench]");
    return false;
  }
  const char *format = meta_value(entries, "format");
  if (format == NULL || strcmp(format, "1") != 0) {
    sb_issues_add(issues, shown, 0, "sealbench.format", "1", "%s",
                  format == NULL ? "is missing" : "is a format that this version cannot read");
  }
  const char *name = meta_value(entries, "kind");
  if (name != NULL && strcmp(name, "valve") == 0) {
    *kind = SB_DOCUMENT_VALVE;
  } else if (name != NULL && (strcmp(name, "scene") == 0 || strcmp(name, "project") == 0)) {
    *kind = SB_DOCUMENT_SCENE;
  } else {
    sb_issues_add(issues, shown, 0, "sealbench.kind", "valve, scene, project", "%s",
                  name == NULL ? "is missing" : "is unknown");
    return false;
  }
  for (guint i = 0; i < entries->len; i++) {
    const SbEntry *entry = entries->pdata[i];
    if (entry->name == NULL || strcmp(entry->group, SB_META_GROUP) != 0) {
      continue;
    }
    static const char *const names[] = {"format", "kind", "title", "valve", NULL};
    if (!g_strv_contains(names, entry->name)) {
      g_autofree char *key = g_strdup_printf("%s.%s", SB_META_GROUP, entry->name);
      sb_issues_add(issues, shown, entry->line, key, "format, kind, title, valve", "unknown key");
    }
  }
  return true;
}

// Reads the files that keys name.
static void read_files(SbDocument *document, const GPtrArray *entries, const char *shown,
                       const char *directory, bool in_valve, GPtrArray *issues) {
  for (guint i = 0; i < entries->len; i++) {
    const SbEntry *entry = entries->pdata[i];
    if (entry->name != NULL) {
      g_autofree char *key = g_strdup_printf("%s.%s", entry->group, entry->name);
      const int file = sb_document_find_file(key);
      if (file >= 0) {
        (void)sb_document_read_file(document, (SbFileKey)file, entry->value, directory, in_valve,
                                    shown, entry->line, issues);
      }
    }
  }
}

// Reads a scene's valve into document->base.
static void read_valve(SbDocument *document, const char *directory, const char *shown,
                       GPtrArray *issues) {
  if (document->valve_name == NULL || *document->valve_name == '\0') {
    sb_issues_add(issues, shown, 0, "sealbench.valve", NULL,
                  "is missing: a scene names its valve's file");
    return;
  }
  document->valve_path = g_path_is_absolute(document->valve_name) || directory == NULL
                             ? g_strdup(document->valve_name)
                             : g_build_filename(directory, document->valve_name, NULL);
  guint before = issues->len;
  size_t length = 0;
  char *text = sb_reader_load(&length, document->valve_path, document->valve_path,
                              SB_DOCUMENT_BYTES_MAX, issues);
  if (text == NULL) {
    // Name the key of the scene as well: that is the line to mend.
    SbIssue *last = issues->pdata[issues->len - 1];
    if (issues->len > before && last->key == NULL && issues->len <= SB_ISSUES_MAX) {
      char *reason = g_strdup_printf("the valve's file %s: %s", last->file, last->text);
      g_free(last->file);
      g_free(last->text);
      last->file = sb_printable(shown, strlen(shown));
      last->key = g_strdup("sealbench.valve");
      last->text = reason;
    }
    return;
  }
  sb_file_stamp_set(&document->valve_disk, document->valve_path, text, length);
  g_autoptr(GPtrArray) entries = sb_reader_scan(text, length, document->valve_path, issues);
  SbDocumentKind kind = SB_DOCUMENT_VALVE;
  if (issues->len == before && read_meta(&kind, entries, document->valve_path, issues) &&
      kind != SB_DOCUMENT_VALVE) {
    sb_issues_add(issues, document->valve_path, 0, "sealbench.kind", "valve",
                  "a scene needs a valve here");
  }
  g_autofree char *beside = g_path_get_dirname(document->valve_path);
  read_values(document, &document->base, NULL, entries, document->valve_path, beside, issues);
  read_files(document, entries, document->valve_path, beside, true, issues);
  g_free(text);
}

void sb_document_refresh_title(SbDocument *document) {
  g_free(document->title);
  const char *title = meta_value(document->entries, "title");
  if (title != NULL && *title != '\0') {
    document->title = sb_printable(title, strlen(title));
  } else if (document->path != NULL) {
    g_autofree char *name = g_path_get_basename(document->path);
    document->title = sb_printable(name, strlen(name));
  } else {
    document->title = g_strdup("Untitled");
  }
}

// Adds the note on a value in force that is not what a shape under it makes.
void sb_document_note_override(SbDocument *document, SbParamId id, const char *shown) {
  g_autofree char *note = sb_document_shape_note(document, id);
  if (note != NULL) {
    sb_issues_add(document->notes, shown, 0, sb_param(id)->key, NULL, "%s: %s", shown, note);
  }
}

SbDocument *sb_document_parse(const char *text, size_t length, const char *name,
                              const char *directory, GPtrArray *issues) {
  guint before = issues->len;
  GPtrArray *entries = sb_reader_scan(text, length, name, issues);
  SbDocumentKind kind = SB_DOCUMENT_VALVE;
  // Without a single line that means something there is only one thing to say.
  bool readable = entries->len > 0 || issues->len == before;
  if (!readable || !read_meta(&kind, entries, name, issues)) {
    g_ptr_array_unref(entries);
    return NULL;
  }
  SbDocument *document = sb_document_new();
  document->kind = kind;
  g_free(document->text);
  document->text = g_strndup(text, length);
  g_ptr_array_unref(document->entries);
  document->entries = entries;
  if (kind == SB_DOCUMENT_SCENE) {
    document->valve_name = g_strdup(meta_value(entries, "valve"));
    read_valve(document, directory, name, issues);
  } else if (meta_value(entries, "valve") != NULL) {
    sb_issues_add(issues, name, 0, "sealbench.valve", NULL, "only a scene names a valve");
  }
  read_values(document, &document->own, kind == SB_DOCUMENT_SCENE ? &document->base : NULL, entries,
              name, directory, issues);
  for (guint i = 0; i < document->shapes->sizes->len; i++) {
    const SbShapeSize *size = document->shapes->sizes->pdata[i];
    sb_document_note_override(document, size->id, name);
  }
  sb_shapes_settle(document->shapes, name, document->notes);
  read_files(document, entries, name, directory, false, issues);
  sb_document_note_drawings(document);
  document->measured = sb_data_read(entries, directory, name, issues);
  sb_document_data_saved(document);
  sb_document_remarks_read(document, name, issues);
  const SbValveOutlines *outlines = &document->shapes->outlines;
  if (outlines->housing || outlines->stem) {
    data_of(document)->outlines = *outlines;
  }
  document->saved = document->own;
  document->saved_rubber = sb_named_rubber_hold(document->own_rubber);
  sb_document_drawings_saved(document);
  sb_document_refresh_title(document);
  document->name = g_strdup(name);
  sb_document_add_faults(document, issues, before);
  // Cases and pins are read with the file's values, as far as these are sound; edits can correct
  // what makes a document not compile.
  const bool sound = issues->len == before;
  g_autoptr(SbModel) model = NULL;
  const bool compiles = sound && sb_document_compile(document, &model, issues);
  const guint compiled = issues->len;
  (void)(compiles ? sb_document_check_cases : sb_document_check_case_lines)(document, issues);
  if (sound) {
    sb_document_read_pins(document, entries, name, issues);
  } else {
    sb_document_keep_pins(document, entries);
  }
  sb_document_add_faults(document, issues, compiled);
  return document;
}

// A picture that this program wrote holds its scene.
static SbDocument *parse_picture(const char *data, size_t length, const char *name,
                                 GPtrArray *issues) {
  GError *error = NULL;
  char *text = sb_picture_find_scene(data, length, &error);
  if (text == NULL) {
    sb_issues_add(issues, name, 0, NULL, NULL, "%s", error->message);
    g_error_free(error);
    return NULL;
  }
  SbDocument *document = sb_document_parse(text, strlen(text), name, NULL, issues);
  g_free(text);
  return document;
}

// Name of a path in messages.
static const char *shown_path(const char *path) {
  return strcmp(path, "-") == 0 ? "standard input" : path;
}

char *sb_document_load_text(size_t *length, const char *path, GPtrArray *issues) {
  const size_t most =
      sb_output_ends_in(path, ".png") ? SB_PICTURE_BYTES_MAX : SB_DOCUMENT_BYTES_MAX;
  return strcmp(path, "-") == 0
             ? sb_reader_load_stream(length, STDIN_FILENO, shown_path(path), most, issues)
             : sb_reader_load(length, path, path, most, issues);
}

SbDocument *sb_document_read(const char *path, const char *text, size_t length, GPtrArray *issues) {
  static const char signature[] = "\x89PNG";
  if (sb_output_ends_in(path, ".png") || (length > 4 && memcmp(text, signature, 4) == 0)) {
    return parse_picture(text, length, shown_path(path), issues);
  }
  g_autofree char *directory = sb_reader_folder(path);
  SbDocument *document = sb_document_parse(text, length, shown_path(path), directory, issues);
  if (document != NULL && directory != NULL) {
    document->path = g_strdup(path);
    sb_file_stamp_set(&document->disk, path, text, length);
    sb_document_refresh_title(document);
  }
  return document;
}

SbDocument *sb_document_load(const char *path, GPtrArray *issues) {
  size_t length = 0;
  g_autofree char *text = sb_document_load_text(&length, path, issues);
  return text != NULL ? sb_document_read(path, text, length, issues) : NULL;
}

// ---- Asking ----

size_t sb_document_data_count(const SbDocument *document) {
  return document->measured != NULL ? document->measured->len : 0;
}

const SbData *sb_document_data(const SbDocument *document, size_t index) {
  return document->measured->pdata[index];
}

const GPtrArray *sb_document_notes(const SbDocument *document) {
  GPtrArray *all = document->all_notes;
  g_ptr_array_set_size(all, 0);
  for (guint i = 0; i < document->notes->len; i++) {
    sb_issues_add_copy(all, document->notes->pdata[i]);
  }
  sb_document_note_cases(document, all);
  return all;
}

const char *sb_document_shape_source(const SbDocument *document, SbParamId id) {
  const SbShapeSize *size = sb_shapes_size(document->shapes, id);
  bool own = size != NULL && (document->kind == SB_DOCUMENT_VALVE || !size->in_valve);
  return own ? size->source : NULL;
}

char *sb_document_shape_note(const SbDocument *document, SbParamId id) {
  const SbShapeSize *size = sb_shapes_size(document->shapes, id);
  double value = sb_document_value(document, id);
  if (size == NULL || fabs(value - size->value) <= SB_SHAPE_ROUNDING * fabs(value)) {
    return NULL;
  }
  const SbParam *param = sb_param(id);
  g_autofree char *says = sb_quantity_format(value, param->si, param->unit);
  g_autofree char *other = sb_quantity_round(size->value, param->si, param->unit, 5);
  return g_strdup_printf("%s = %s applies; %s has %s, and the shape is scaled to it", param->key,
                         says, size->source, other);
}

SbDocumentKind sb_document_kind(const SbDocument *document) {
  return document->kind;
}

bool sb_document_is_project(const SbDocument *document) {
  return g_strcmp0(meta_value(document->entries, "kind"), "project") == 0;
}
