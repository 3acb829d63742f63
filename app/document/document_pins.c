// A document's [pins]: designs that are kept beside it to compare with, NAME = KEY=VALUE; KEY=VALUE
// as [cases] are written. A pin stores all its values, whatever is edited afterwards: only the file
// writes it as the difference from the document, recomputed when the document is saved. Lines that
// cannot be read as a design stay in the file as they are.
#include "app/base/reader.h"
#include "app/base/writer.h"
#include "app/document/document_private.h"

#include <string.h>

// Names that are nobody's own: "pin 1".
#define UNNAMED "pin "

typedef struct {
  char *name;            // NULL: it goes by what it differs in
  SbParams params;       // its rubber is `rubber`'s
  SbNamedRubber *rubber; // held; NULL: none
} Pin;

static void pin_free(gpointer data) {
  Pin *pin = data;
  g_free(pin->name);
  sb_named_rubber_release(pin->rubber);
  g_free(pin);
}

GPtrArray *sb_document_pins_new(void) {
  return g_ptr_array_new_with_free_func(pin_free);
}

static Pin *pin_at(const SbDocument *document, size_t index) {
  return document->pins->pdata[index];
}

// Takes the rubber over.
static void add(SbDocument *document, const char *name, const SbParams *params,
                SbNamedRubber *rubber) {
  Pin *pin = g_new(Pin, 1);
  *pin = (Pin){g_strdup(name), *params, rubber};
  pin->params.rubber = rubber != NULL ? &rubber->sheet : NULL;
  g_ptr_array_add(document->pins, pin);
}

static void pins_changed(SbDocument *document) {
  document->pins_changed = true;
  document->serial++; // there is something else to save
}

static bool is_unnamed(const char *name) {
  const size_t head = strlen(UNNAMED);
  return strncmp(name, UNNAMED, head) == 0 && name[head] != '\0' &&
         strspn(name + head, "0123456789") == strlen(name + head);
}

static bool has_line(const GPtrArray *lines, const char *name) {
  for (guint i = 0; i < lines->len; i++) {
    if (strcmp(((const SbCase *)lines->pdata[i])->name, name) == 0) {
      return true;
    }
  }
  return false;
}

// Keeps the lines of [pins] that are not among `lines`: they were not read.
static void keep_lines(SbDocument *document, const GPtrArray *entries, const GPtrArray *lines) {
  for (guint i = 0; i < entries->len; i++) {
    const SbEntry *entry = entries->pdata[i];
    if (entry->name != NULL && strcmp(entry->group, SB_PINS_GROUP) == 0 &&
        !has_line(lines, entry->name)) {
      g_hash_table_add(document->pins_broken, g_strdup(entry->name));
    }
  }
}

void sb_document_read_pins(SbDocument *document, const GPtrArray *entries, const char *shown,
                           GPtrArray *issues) {
  g_autoptr(GPtrArray) lines = sb_document_cases_new();
  sb_document_read_cases(lines, SB_PINS_GROUP, entries, shown, issues);
  for (guint i = 0; i < lines->len; i++) {
    SbCase *line = lines->pdata[i];
    g_autofree char *path = g_strdup_printf("%s.%s", SB_PINS_GROUP, line->name);
    SbParams params = sb_document_params(document);
    SbNamedRubber *rubber = NULL;
    // A design that is the document itself has nothing to say.
    bool good = *line->settings == '\0' ||
                sb_document_case_params(document, line, path, &params, &rubber, issues);
    g_autoptr(SbModel) model = NULL;
    good = good && sb_document_case_model(document, params, rubber, shown, path, &model, issues);
    if (!good) {
      sb_named_rubber_release(rubber);
      g_hash_table_add(document->pins_broken, g_strdup(line->name));
      continue;
    }
    add(document, is_unnamed(line->name) ? NULL : line->name, &params,
        rubber != NULL ? rubber : sb_named_rubber_hold(sb_document_rubber_in_force(document)));
  }
  keep_lines(document, entries, lines);
  document->pins_changed = false;
}

void sb_document_keep_pins(SbDocument *document, const GPtrArray *entries) {
  g_autoptr(GPtrArray) none = sb_document_cases_new();
  keep_lines(document, entries, none);
}

// What makes the document's values a pin's: ids in the order to set them in. A value that follows
// from another one is left to follow where that gives it.
static GArray *differences(const SbDocument *document, const Pin *pin) {
  GArray *ids = g_array_new(FALSE, FALSE, sizeof(int));
  SbParams params = sb_document_params(document);
  params.rubber = pin->params.rubber;
  for (int pass = 0; pass < 2; pass++) {
    for (int id = 0; id < SB_PARAM_COUNT; id++) {
      const double value = sb_params_get(&pin->params, (SbParamId)id);
      if ((pass == 1 || pin->params.given[id]) && sb_params_get(&params, (SbParamId)id) != value) {
        params.given[id] = true;
        params.value[id] = value;
        g_array_append_val(ids, id);
      }
    }
  }
  return ids;
}

static bool other_rubber(const SbDocument *document, const Pin *pin) {
  return !sb_named_rubber_same(pin->rubber, sb_document_rubber_in_force(document));
}

// What the file states for the pin of this name; NULL: nothing.
static const char *line_of(const SbDocument *document, const char *name) {
  for (guint i = 0; i < document->entries->len; i++) {
    const SbEntry *entry = document->entries->pdata[i];
    if (entry->name != NULL && strcmp(entry->group, SB_PINS_GROUP) == 0 &&
        strcmp(entry->name, name) == 0) {
      return entry->value;
    }
  }
  return NULL;
}

static void append_setting(GString *text, const char *key, const char *value) {
  g_string_append_printf(text, "%s%s = %s", text->len > 0 ? "; " : "", key, value);
}

// Appends those settings of `line` that still make the pin's values, with their text, and adds
// their keys to `kept`.
static void keep_settings(GString *text, GHashTable *kept, const SbDocument *document,
                          const Pin *pin, const char *line) {
  g_auto(GStrv) settings = g_strsplit(line, ";", -1);
  for (char **setting = settings; *setting != NULL; setting++) {
    const char *rest = NULL;
    g_autofree char *key = sb_document_split(&rest, g_strstrip(*setting));
    const int id = key != NULL ? sb_param_find(key) : -1;
    g_autofree char *shown = key != NULL ? g_strstrip(g_strdup(rest)) : NULL;
    double value = 0;
    const bool rubber = key != NULL && strcmp(key, SB_RUBBER_KEY) == 0 && pin->rubber != NULL &&
                        strcmp(pin->rubber->name, shown) == 0;
    if (rubber ||
        (id >= 0 && sb_document_read_value(&value, document, (SbParamId)id, shown, NULL) &&
         value == sb_params_get(&pin->params, (SbParamId)id))) {
      append_setting(text, key, shown);
      g_hash_table_add(kept, g_steal_pointer(&key));
    }
  }
}

// "KEY = VALUE; KEY = VALUE", with the text that `line` (NULL: none) has for a value. Owned by the
// caller.
static char *settings_of(const SbDocument *document, const Pin *pin, const char *line) {
  g_autoptr(GArray) ids = differences(document, pin);
  g_autoptr(GString) text = g_string_new(NULL);
  g_autoptr(GHashTable) kept = g_hash_table_new_full(g_str_hash, g_str_equal, g_free, NULL);
  if (line != NULL) {
    keep_settings(text, kept, document, pin, line);
  }
  if (pin->rubber != NULL && other_rubber(document, pin) &&
      !g_hash_table_contains(kept, SB_RUBBER_KEY)) {
    append_setting(text, SB_RUBBER_KEY, pin->rubber->name);
  }
  for (guint i = 0; i < ids->len; i++) {
    const SbParamId id = (SbParamId)g_array_index(ids, int, i);
    if (!g_hash_table_contains(kept, sb_param(id)->key)) {
      g_autofree char *value = sb_param_format(id, sb_params_get(&pin->params, id));
      append_setting(text, sb_param(id)->key, value);
    }
  }
  return g_string_free(g_steal_pointer(&text), FALSE);
}

static char *line_name(const SbDocument *document, size_t index) {
  const char *own = pin_at(document, index)->name;
  char *name = own != NULL ? g_strdup(own) : NULL;
  // Numbers of lines that cannot be read are taken.
  for (size_t number = index + 1; name == NULL; number += document->pins->len) {
    name = g_strdup_printf(UNNAMED "%zu", number);
    if (g_hash_table_contains(document->pins_broken, name)) {
      g_clear_pointer(&name, g_free);
    }
  }
  return name;
}

void sb_document_change_pins(GArray *changes, const SbDocument *document) {
  if (!document->pins_changed && !sb_document_is_modified(document)) {
    return;
  }
  g_autoptr(GHashTable) names = g_hash_table_new_full(g_str_hash, g_str_equal, g_free, NULL);
  for (size_t i = 0; i < document->pins->len; i++) {
    g_autofree char *name = line_name(document, i);
    const char *line = line_of(document, name);
    g_autofree char *settings = settings_of(document, pin_at(document, i), line);
    // A line that states the pin already keeps its text.
    if (g_strcmp0(line, settings) != 0) {
      const SbChange change = {g_strdup(SB_PINS_GROUP), g_strdup(name), g_steal_pointer(&settings)};
      g_array_append_val(changes, change);
    }
    g_hash_table_add(names, g_steal_pointer(&name));
  }
  for (guint i = 0; i < document->entries->len; i++) {
    const SbEntry *entry = document->entries->pdata[i];
    if (entry->name != NULL && strcmp(entry->group, SB_PINS_GROUP) == 0 &&
        !g_hash_table_contains(names, entry->name) &&
        !g_hash_table_contains(document->pins_broken, entry->name)) {
      SbChange change = {g_strdup(SB_PINS_GROUP), g_strdup(entry->name), NULL};
      g_array_append_val(changes, change);
    }
  }
}

size_t sb_document_pin_count(const SbDocument *document) {
  return document->pins->len;
}

const char *sb_document_pin_name(const SbDocument *document, size_t index) {
  return pin_at(document, index)->name;
}

const SbParams *sb_document_pin_params(const SbDocument *document, size_t index) {
  return &pin_at(document, index)->params;
}

bool sb_document_add_pin(SbDocument *document, const SbOverride *override, size_t count) {
  SbParams params = sb_document_params(document);
  bool good = document->pins->len < SB_CASES_MAX;
  for (size_t i = 0; good && i < count; i++) {
    good = sb_params_set(&params, override[i].id, override[i].value, NULL) == SB_OK;
  }
  if (!good) {
    return false;
  }
  add(document, NULL, &params, sb_named_rubber_hold(sb_document_rubber_in_force(document)));
  pins_changed(document);
  return true;
}

void sb_document_remove_pin(SbDocument *document, size_t index) {
  g_ptr_array_remove_index(document->pins, (guint)index);
  pins_changed(document);
}

void sb_document_name_pin(SbDocument *document, size_t index, const char *name) {
  // What a key file's line cannot begin with or hold.
  g_autofree char *clean = g_strstrip(g_strdelimit(g_strdup(name), "=#[]\n\r\t", ' '));
  Pin *pin = pin_at(document, index);
  bool taken =
      *clean == '\0' || is_unnamed(clean) || g_hash_table_contains(document->pins_broken, clean);
  for (size_t i = 0; i < document->pins->len; i++) {
    taken = taken || (i != index && g_strcmp0(pin_at(document, i)->name, clean) == 0);
  }
  g_free(pin->name);
  pin->name = taken ? NULL : g_strdup(clean);
  pins_changed(document);
}

static bool same_pin(const Pin *a, const Pin *b) {
  bool same = g_strcmp0(a->name, b->name) == 0 && sb_named_rubber_same(a->rubber, b->rubber);
  for (int id = 0; id < SB_PARAM_COUNT && same; id++) {
    same = sb_params_get(&a->params, (SbParamId)id) == sb_params_get(&b->params, (SbParamId)id);
  }
  return same;
}

void sb_document_take_pins(SbDocument *document, const SbDocument *other) {
  GHashTableIter unread;
  void *name;
  g_hash_table_iter_init(&unread, other->pins_broken);
  while (g_hash_table_iter_next(&unread, &name, NULL)) {
    g_hash_table_add(document->pins_broken, g_strdup(name));
  }
  bool same = document->pins->len == other->pins->len;
  for (size_t i = 0; same && i < other->pins->len; i++) {
    same = same_pin(pin_at(document, i), pin_at(other, i));
  }
  if (same) {
    return;
  }
  g_ptr_array_set_size(document->pins, 0);
  for (size_t i = 0; i < other->pins->len; i++) {
    const Pin *pin = pin_at(other, i);
    add(document, pin->name, &pin->params, sb_named_rubber_hold(pin->rubber));
  }
  pins_changed(document);
}

bool sb_document_compile_pin(const SbDocument *document, size_t index, SbModel **out,
                             GPtrArray *issues) {
  const Pin *pin = pin_at(document, index);
  g_autofree char *path = line_name(document, index);
  const char *shown = document->path != NULL ? document->path : document->name;
  *out = NULL;
  return sb_document_case_model(document, pin->params, pin->rubber, shown, path, out, issues);
}

// Makes the edits since `before` one step.
static void join(SbDocument *document, guint before) {
  for (guint i = before + 1; i < document->done; i++) {
    g_array_index(document->edits, Edit, i).joined = true;
  }
}

void sb_document_use_pin(SbDocument *document, size_t index) {
  const Pin *pin = pin_at(document, index);
  const guint before = document->done;
  // A document that undid something has edits to come, which the first new one drops.
  if (other_rubber(document, pin)) {
    sb_document_edit_rubber(document, sb_named_rubber_hold(pin->rubber));
  }
  g_autoptr(GArray) ids = differences(document, pin);
  for (guint i = 0; i < ids->len; i++) {
    const SbParamId id = (SbParamId)g_array_index(ids, int, i);
    g_warn_if_fail(
        sb_document_set_value(document, id, sb_params_get(&pin->params, id), false, NULL));
  }
  join(document, before);
}

bool sb_document_set_values(SbDocument *document, const SbOverride *override, size_t count) {
  const guint before = document->done;
  bool good = true;
  for (size_t i = 0; i < count; i++) {
    good &= sb_document_set_value(document, override[i].id, override[i].value, false, NULL);
  }
  join(document, before);
  return good;
}
