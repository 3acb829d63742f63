// Edits of a document: values set by text, by number and by --set, and the list of edits that undo
// and redo walk along. Only the document's own layer changes; what lies below stays.
#include "app/document/document_disk.h"
#include "app/document/document_private.h"

#include <string.h>

static const SbData *first_data(const SbDocument *document) {
  return sb_document_data_count(document) > 0 ? sb_document_data(document, 0) : NULL;
}

// Puts a copy of measured data, or nothing, in place of the first group.
static void put_data(SbDocument *document, const SbData *data) {
  GPtrArray *list = document->measured;
  if (first_data(document) != NULL) {
    g_ptr_array_remove_index(list, 0);
  }
  if (data != NULL) {
    g_ptr_array_insert(list, 0, sb_data_copy(data));
  }
  document->serial++;
}

bool sb_document_data_differs(const SbDocument *document) {
  return !sb_data_same(first_data(document), document->saved_measured);
}

void sb_document_data_saved(SbDocument *document) {
  const SbData *now = first_data(document);
  sb_data_free(document->saved_measured);
  document->saved_measured = now != NULL ? sb_data_copy(now) : NULL;
}

// Puts one side of an edit in force.
static void apply(SbDocument *document, const Edit *edit, int side) {
  if (edit->id == SB_DOCUMENT_WHOLE) {
    sb_document_exchange(document, edit->whole);
    return;
  }
  if (edit->id == SB_DOCUMENT_RUBBER) {
    sb_document_put_rubber(document, &document->own_rubber,
                           sb_named_rubber_hold(edit->rubber[side]));
    return;
  }
  if (edit->id == SB_DOCUMENT_MEASURED) {
    put_data(document, edit->measured[side]);
    return;
  }
  if (edit->id == SB_DOCUMENT_SECTION || edit->id == SB_DOCUMENT_GROOVE) {
    sb_document_put_drawing(document, edit->drawing[side]);
    return;
  }
  document->own.given[edit->id] = edit->given[side];
  document->own.value[edit->id] = edit->value[side];
  document->serial++;
}

// Records a change of one key and makes it.
static void edit_key(SbDocument *document, SbParamId id, bool given, double value, bool merge) {
  SbParams *own = &document->own;
  if (own->given[id] == given && own->value[id] == value) {
    return;
  }
  g_array_set_size(document->edits, document->done);
  Edit *last =
      document->done > 0 ? &g_array_index(document->edits, Edit, document->done - 1) : NULL;
  if (merge && document->mergeable && last != NULL && last->id == (int)id) {
    last->given[1] = given;
    last->value[1] = value;
  } else {
    Edit edit = {.id = (int)id, .given = {own->given[id], given}, .value = {own->value[id], value}};
    g_array_append_val(document->edits, edit);
    document->done++;
  }
  document->mergeable = merge;
  Edit made = g_array_index(document->edits, Edit, document->done - 1);
  apply(document, &made, 1);
}

void sb_document_end_merge(SbDocument *document) {
  document->mergeable = false;
}

void sb_document_clear_edit(gpointer data) {
  Edit *edit = data;
  sb_named_rubber_release(edit->rubber[0]);
  sb_named_rubber_release(edit->rubber[1]);
  sb_document_free(edit->whole);
  for (int side = 0; side < 2; side++) {
    sb_data_free(edit->measured[side]);
    sb_named_drawing_free(edit->drawing[side]);
  }
}

// Keeps an edit that does not merge, takes its pointers over and makes it.
static void record(SbDocument *document, Edit edit) {
  g_array_set_size(document->edits, document->done);
  g_array_append_val(document->edits, edit);
  document->done++;
  document->mergeable = false;
  apply(document, &edit, 1);
}

void sb_document_become(SbDocument *document, SbDocument *other) {
  record(document, (Edit){.id = SB_DOCUMENT_WHOLE, .whole = other});
}

void sb_document_put_data(SbDocument *document, SbData *data) {
  const SbData *before = first_data(document);
  if (document->measured == NULL) {
    document->measured = g_ptr_array_new_with_free_func(sb_data_free);
  }
  if (before != NULL && data != NULL) { // under the same name
    g_free(data->name);
    data->name = g_strdup(before->name);
  }
  if (sb_data_same(before, data)) {
    sb_data_free(data);
    return;
  }
  record(document, (Edit){.id = SB_DOCUMENT_MEASURED,
                          .measured = {before != NULL ? sb_data_copy(before) : NULL, data}});
}

void sb_document_edit_rubber(SbDocument *document, SbNamedRubber *rubber) {
  if (sb_named_rubber_same(document->own_rubber, rubber)) {
    sb_named_rubber_release(rubber);
    return;
  }
  record(document, (Edit){.id = SB_DOCUMENT_RUBBER,
                          .rubber = {sb_named_rubber_hold(document->own_rubber), rubber}});
}

void sb_document_edit_drawing(SbDocument *document, SbNamedDrawing *drawing) {
  const guint before = document->done;
  const bool section = drawing->key == SB_FILE_SECTION;
  if (section) {
    edit_key(document, SB_P_SEAL_PROFILE, true, SB_SEAL_PROFILE_FILE, false);
  }
  const bool joined = document->done > before;
  record(document, (Edit){.id = section ? SB_DOCUMENT_SECTION : SB_DOCUMENT_GROOVE,
                          .joined = joined,
                          .drawing = {sb_document_drawing_now(document, drawing->key), drawing}});
}

// Adds the allowed range to a message.
static bool fail_with_range(GError **error, SbAppError code, SbParamId id, const char *message) {
  g_autofree char *range = sb_param_range(id);
  g_set_error(error, SB_APP_ERROR, (int)code, "%s (allowed %s)", message, range);
  return false;
}

bool sb_document_set(SbDocument *document, SbParamId id, const char *text, GError **error) {
  GError *inner = NULL;
  double value = 0;
  if (!sb_param_parse(&value, id, text, &inner)) {
    fail_with_range(error, (SbAppError)inner->code, id, inner->message);
    g_error_free(inner);
    return false;
  }
  return sb_document_set_value(document, id, value, false, error);
}

bool sb_document_set_value(SbDocument *document, SbParamId id, double value, bool merge,
                           GError **error) {
  SbParams trial = document->own;
  SbReport report = {0};
  if (sb_params_set(&trial, id, value, &report) != SB_OK) {
    const bool beyond = report.status == SB_ERROR_RANGE;
    g_autofree char *shown = sb_param_format(id, value);
    g_autofree char *message = g_strdup_printf("%s is out of range", shown);
    return fail_with_range(error, beyond ? SB_APP_ERROR_RANGE : SB_APP_ERROR_INPUT, id,
                           beyond ? message : report.text);
  }
  edit_key(document, id, true, value, merge);
  return true;
}

// The factor of "+5 %" or "-0.5%": a percentage with a sign. False for any other text.
static bool is_change(double *factor, const char *text) {
  double percent;
  g_autofree char *copy = g_strstrip(g_strdup(text));
  size_t length = *copy == '+' || *copy == '-' ? sb_number_read(&percent, copy) : 0;
  if (length == 0 || strcmp(g_strchug(copy + length), "%") != 0) {
    return false;
  }
  *factor = 1 + percent / 100;
  return true;
}

bool sb_document_read_value(double *out, const SbDocument *document, SbParamId id, const char *text,
                            GError **error) {
  const SbParam *param = sb_param(id);
  double factor;
  if (param->kind != SB_PARAM_REAL || !is_change(&factor, text)) {
    return sb_param_parse(out, id, text, error);
  }
  double before = sb_document_value(document, id), after = factor * before;
  if (before == 0 || sb_quantity_is_point(param->unit)) {
    g_set_error(error, SB_APP_ERROR, SB_APP_ERROR_INPUT, "%s",
                before == 0 ? "is 0, which no percentage changes"
                            : "is a temperature, of which a percentage means nothing");
    return false;
  }
  if (!(after >= param->min && after <= param->max)) {
    g_autofree char *shown = sb_param_format(id, after);
    g_set_error(error, SB_APP_ERROR, SB_APP_ERROR_RANGE, "%s changes it to %s, out of range", text,
                shown);
    return false;
  }
  *out = after;
  return true;
}

char *sb_document_split(const char **value, const char *setting) {
  const char *equal = strchr(setting, '=');
  if (equal == NULL || equal == setting) {
    return NULL;
  }
  *value = equal + 1;
  return g_strstrip(g_strndup(setting, (gsize)(equal - setting)));
}

bool sb_document_set_option(SbDocument *document, const char *option, GPtrArray *issues) {
  const char *text;
  g_autofree char *key = sb_document_split(&text, option);
  if (!g_utf8_validate(option, -1, NULL) || key == NULL) {
    sb_issues_add(issues, "--set", 0, NULL, NULL, "\"%s\" is not KEY=VALUE", option);
    return false;
  }
  int id = sb_param_find(key);
  double value = 0;
  GError *error = NULL;
  bool good = false;
  if (strcmp(key, SB_RUBBER_KEY) == 0) {
    SbNamedRubber *rubber = sb_named_rubber_read(text, NULL, "--set", 0, issues);
    good = rubber != NULL;
    if (good) {
      sb_document_put_rubber(document, &document->own_rubber, rubber);
    }
  } else if (sb_document_find_file(key) >= 0) {
    g_autofree char *name = g_strstrip(g_strdup(text));
    good = sb_document_read_file(document, (SbFileKey)sb_document_find_file(key), name, NULL, false,
                                 "--set", 0, issues);
  } else if (id < 0) {
    g_autofree char *hint = issues->len < SB_ISSUES_MAX ? sb_document_key_hint(key) : NULL;
    sb_issues_add(issues, "--set", 0, key, NULL, "unknown key%s", hint != NULL ? hint : "");
  } else if (!sb_document_read_value(&value, document, (SbParamId)id, text, &error)) {
    char *range = sb_param_range((SbParamId)id);
    sb_issues_add(issues, "--set", 0, key, range, "%s", error->message);
    g_free(range);
    g_error_free(error);
  } else {
    good = sb_document_set_value(document, (SbParamId)id, value, false, NULL);
    document->stated[id] |= good;
    sb_document_note_override(document, (SbParamId)id, "--set");
    if (good) {
      sb_hardness_note(document->notes, "--set", 0, key, (SbParamId)id, text);
    }
  }
  return good;
}

void sb_document_set_options(SbDocument *document, char *const *settings, GPtrArray *issues) {
  const SbParams before = sb_document_params(document);
  for (char *const *setting = settings; setting != NULL && *setting != NULL; setting++) {
    (void)sb_document_set_option(document, *setting, issues);
  }
  const SbParams now = sb_document_params(document);
  SbParams kept = now;
  sb_params_keep_fluid(&kept, &before);
  if (kept.given[SB_P_FLUID_FIGURES] && !now.given[SB_P_FLUID_FIGURES]) {
    const bool good = sb_document_set_value(document, SB_P_FLUID_FIGURES,
                                            kept.value[SB_P_FLUID_FIGURES], false, NULL);
    g_assert(good);
  }
}

void sb_document_unset(SbDocument *document, SbParamId id) {
  // A shape of the document itself gives what no key does, as it will when the file is read again.
  const SbShapeSize *shape =
      sb_shapes_own(document->shapes, id, document->kind != SB_DOCUMENT_SCENE);
  edit_key(document, id, shape != NULL, shape != NULL ? shape->value : sb_param(id)->fallback,
           false);
}

bool sb_document_gives(const SbDocument *document, SbParamId id) {
  return document->own.given[id];
}

bool sb_document_differs(const SbDocument *document, SbParamId id) {
  bool given = document->own.given[id];
  return given != document->saved.given[id] ||
         (given && document->own.value[id] != document->saved.value[id]);
}

bool sb_document_is_modified(const SbDocument *document) {
  if (document->pins_changed || document->remarks_changed || sb_document_data_differs(document) ||
      !sb_named_rubber_same(document->own_rubber, document->saved_rubber) ||
      sb_document_drawings_differ(document)) {
    return true;
  }
  for (int i = 0; i < SB_PARAM_COUNT; i++) {
    if (sb_document_differs(document, (SbParamId)i)) {
      return true;
    }
  }
  return false;
}

int sb_document_undo(SbDocument *document) {
  if (!sb_document_can_undo(document)) {
    return -1;
  }
  Edit edit;
  do {
    edit = g_array_index(document->edits, Edit, --document->done);
    apply(document, &edit, 0);
  } while (edit.joined && document->done > 0);
  document->mergeable = false;
  return edit.id;
}

int sb_document_redo(SbDocument *document) {
  if (!sb_document_can_redo(document)) {
    return -1;
  }
  const int first = g_array_index(document->edits, Edit, document->done).id;
  do {
    Edit edit = g_array_index(document->edits, Edit, document->done++);
    apply(document, &edit, 1);
  } while (document->done < document->edits->len &&
           g_array_index(document->edits, Edit, document->done).joined);
  document->mergeable = false;
  return first;
}

int sb_document_next_undo(const SbDocument *document, bool redo, double value[2]) {
  if (redo ? !sb_document_can_redo(document) : !sb_document_can_undo(document)) {
    return -1;
  }
  const Edit *edit = &g_array_index(document->edits, Edit, document->done - (redo ? 0 : 1));
  for (int side = 0; side < 2 && edit->id < SB_PARAM_COUNT; side++) {
    value[side] = edit->value[side];
    if (!edit->given[side]) {
      // Not the document's own: what lies below, or the default.
      SbParams params = sb_document_params(document);
      SbParamDefault fallback;
      params.given[edit->id] = false;
      sb_params_default(&fallback, &params, (SbParamId)edit->id);
      value[side] =
          document->base.given[edit->id] ? document->base.value[edit->id] : fallback.value;
    }
  }
  return edit->id;
}

bool sb_document_can_undo(const SbDocument *document) {
  return document->done > 0;
}

bool sb_document_can_redo(const SbDocument *document) {
  return document->done < document->edits->len;
}

unsigned sb_document_serial(const SbDocument *document) {
  return document->serial;
}
