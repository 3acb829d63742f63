// Groups of measured data; see the header.
#include "app/document/data_keys.h"

#include "app/base/reader.h"

#include "engine/valve/model/valve.h"

#include <string.h>

const char *const sb_data_separators[] = {"comma", "semicolon", "tab", "bar", "blank", NULL};
const char *const sb_data_decimals[] = {"point", "comma", NULL};
const char *const sb_data_dates[] = {"day-month", "month-day", NULL};
const char *const sb_data_directions[] = {"as-is", "force", "displacement", "both", NULL};

static const char *const names[SB_DATA_KEY_COUNT] = {
#define DATA_KEY_NAME(code, name) [code] = name,
    SB_DATA_KEYS(DATA_KEY_NAME)
#undef DATA_KEY_NAME
};

const char *sb_data_key_name(SbDataKey key) {
  return names[key];
}

bool sb_data_is_group(const char *group) {
  return strcmp(group, "data") == 0 || g_str_has_prefix(group, "data ");
}

void sb_data_free(gpointer pointer) {
  SbData *data = pointer;
  if (data == NULL) {
    return;
  }
  for (int i = 0; i < SB_DATA_KEY_COUNT; i++) {
    g_free(data->text[i]);
  }
  g_free(data->name);
  g_free(data->path);
  g_free(data->shown);
  g_free(data);
}

SbData *sb_data_of_file(const char *path) {
  SbData *data = g_new0(SbData, 1);
  data->name = g_strdup("");
  data->path = g_strdup(path);
  data->text[SB_DATA_FILE] = g_strdup(path);
  return data;
}

// Returns the name of a key with its group, "data lot-2.columns". Freed by g_free().
static char *full_key(const SbData *data, SbDataKey key) {
  return g_strdup_printf("data%s%s.%s", *data->name != '\0' ? " " : "", data->name, names[key]);
}

bool sb_data_add_issue(const SbData *data, SbDataKey key, const char *allowed, GPtrArray *issues,
                       const char *format, ...) {
  va_list arguments;
  va_start(arguments, format);
  g_autofree char *text = g_strdup_vprintf(format, arguments);
  va_end(arguments);
  g_autofree char *where = full_key(data, key);
  return sb_issues_add(issues, data->shown != NULL ? data->shown : data->path, data->line, where,
                       allowed, "%s", text);
}

bool sb_data_add_choice(const SbData *data, SbDataKey key, const char *values, GPtrArray *issues,
                        const char *format, ...) {
  va_list arguments;
  va_start(arguments, format);
  g_autofree char *text = g_strdup_vprintf(format, arguments);
  va_end(arguments);
  g_autofree char *where = full_key(data, key);
  return sb_issues_add_choice(issues, data->shown != NULL ? data->shown : data->path, data->line,
                              where, values, true, "%s", text);
}

size_t sb_data_word(const SbData *data, SbDataKey key, const char *const *words,
                    GPtrArray *issues) {
  size_t index = 0;
  while (data->text[key] != NULL && words[index] != NULL &&
         strcmp(words[index], data->text[key]) != 0) {
    index++;
  }
  if (words[index] == NULL) {
    g_autofree char *allowed = g_strjoinv(", ", (char **)words);
    sb_data_add_issue(data, key, allowed, issues, "\"%s\" is not one of these", data->text[key]);
  }
  return data->text[key] != NULL && words[index] != NULL ? index + 1 : 0;
}

double sb_data_drive_speed(double kind, double speed) {
  return (int)kind == SB_MODEL_DRIVE_MACHINE ? speed : 0;
}

static SbData *find(const GPtrArray *list, const char *name) {
  for (guint i = 0; i < list->len; i++) {
    SbData *data = list->pdata[i];
    if (strcmp(data->name, name) == 0) {
      return data;
    }
  }
  return NULL;
}

GPtrArray *sb_data_read(const GPtrArray *entries, const char *directory, const char *shown,
                        GPtrArray *issues) {
  GPtrArray *list = g_ptr_array_new_with_free_func(sb_data_free);
  for (guint i = 0; i < entries->len; i++) {
    const SbEntry *entry = entries->pdata[i];
    if (!sb_data_is_group(entry->group)) {
      continue;
    }
    const char *name = entry->group[4] == ' ' ? entry->group + 5 : "";
    SbData *data = find(list, name);
    if (data == NULL && list->len == SB_DATA_MAX) {
      sb_issues_add(issues, shown, entry->line, NULL, NULL,
                    "has more than the %d groups of data there may be", SB_DATA_MAX);
      break;
    }
    if (data == NULL) {
      data = g_new0(SbData, 1);
      data->name = g_strdup(name);
      data->shown = g_strdup(shown);
      data->line = entry->line;
      g_ptr_array_add(list, data);
    }
    if (entry->name == NULL) {
      continue;
    }
    int key = 0;
    while (key < SB_DATA_KEY_COUNT && strcmp(names[key], entry->name) != 0) {
      key++;
    }
    if (key == SB_DATA_KEY_COUNT) {
      sb_issues_add(issues, shown, entry->line, NULL, NULL, "[%s] %s: unknown key", entry->group,
                    entry->name);
    } else {
      g_free(data->text[key]);
      data->text[key] = g_strdup(entry->value);
    }
  }
  for (guint i = 0; i < list->len; i++) {
    SbData *data = list->pdata[i];
    const char *file = data->text[SB_DATA_FILE];
    if (file == NULL || *file == '\0') {
      sb_data_add_issue(data, SB_DATA_FILE, "a file of numbers", issues, "is missing");
    } else {
      data->path = g_path_is_absolute(file) || directory == NULL
                       ? g_strdup(file)
                       : g_build_filename(directory, file, NULL);
    }
  }
  return list;
}

SbData *sb_data_copy(const SbData *data) {
  SbData *copy = g_new0(SbData, 1);
  for (int i = 0; i < SB_DATA_KEY_COUNT; i++) {
    copy->text[i] = g_strdup(data->text[i]);
  }
  copy->name = g_strdup(data->name);
  copy->path = g_strdup(data->path);
  copy->shown = g_strdup(data->shown);
  copy->line = data->line;
  return copy;
}

bool sb_data_same(const SbData *a, const SbData *b) {
  bool same = (a == NULL) == (b == NULL);
  for (int key = 0; key < SB_DATA_KEY_COUNT && same && a != NULL; key++) {
    same = key == SB_DATA_FILE ? g_strcmp0(a->path, b->path) == 0
                               : g_strcmp0(a->text[key], b->text[key]) == 0;
  }
  return same;
}

void sb_data_set_keys(SbData *data, const char *text) {
  g_auto(GStrv) lines = g_strsplit(text, "\n", -1);
  for (char **line = lines; *line != NULL; line++) {
    char *equal = strchr(*line, '=');
    for (int key = 0; equal != NULL && key < SB_DATA_KEY_COUNT; key++) {
      g_autofree char *name = g_strstrip(g_strndup(*line, (size_t)(equal - *line)));
      if (key != SB_DATA_FILE && strcmp(names[key], name) == 0) {
        g_free(data->text[key]);
        data->text[key] = g_strstrip(g_strdup(equal + 1));
      }
    }
  }
}

static SbData *copy_with_cycle(const SbData *data, const char *cycle) {
  SbData *copy = sb_data_copy(data);
  g_free(copy->text[SB_DATA_CYCLE]);
  copy->text[SB_DATA_CYCLE] = g_strdup(cycle);
  g_free(copy->name);
  copy->name = *data->name != '\0' ? g_strconcat(data->name, " ", cycle, NULL) : g_strdup(cycle);
  return copy;
}

void sb_data_split(GPtrArray *list, GPtrArray *issues) {
  for (guint i = 0; i < list->len; i++) {
    const SbData *data = list->pdata[i];
    const char *cycle = data->text[SB_DATA_CYCLE];
    if (cycle == NULL || strchr(cycle, ',') == NULL) {
      continue;
    }
    g_auto(GStrv) words = g_strsplit(cycle, ",", -1);
    const guint count = g_strv_length(words);
    if (list->len - 1 + count > SB_DATA_MAX) {
      sb_data_add_issue(data, SB_DATA_CYCLE, NULL, issues,
                        "exceeds the maximum of %d groups of data", SB_DATA_MAX);
      return;
    }
    for (guint k = 0; k < count; k++) {
      g_ptr_array_insert(list, (gint)(i + 1 + k), copy_with_cycle(data, g_strstrip(words[k])));
    }
    g_ptr_array_remove_index(list, i);
    i += count - 1;
  }
}
