// Rubbers by name; the format is in the header.
#include "app/document/rubber_sheet.h"

#include "app/base/reader.h"
#include "app/base/unit.h"
#include "app/document/shipped.h"

#include <math.h>
#include <string.h>

#define ENDING ".rubber"

// The folders of rubbers: beside that of valves and scenes, the user's, and of those that ship.
// Owned by the caller.
static GPtrArray *folders(const char *directory) {
  GPtrArray *out = g_ptr_array_new_with_free_func(g_free);
  g_autofree char *shipped = sb_shipped_folder();
  if (directory != NULL) {
    g_ptr_array_add(out, g_build_filename(directory, "..", "rubbers", NULL));
  }
  g_ptr_array_add(out, g_build_filename(g_get_user_data_dir(), "sealbench", "rubbers", NULL));
  if (shipped != NULL) {
    g_ptr_array_add(out, g_build_filename(shipped, "rubbers", NULL));
  }
  return out;
}

char **sb_rubber_sheet_names(const char *directory) {
  g_autoptr(GPtrArray) places = folders(directory);
  if (directory != NULL) {
    g_ptr_array_add(places, g_strdup(directory));
  }
  GPtrArray *names = g_ptr_array_new();
  for (guint i = 0; i < places->len; i++) {
    g_autoptr(GDir) dir = g_dir_open(places->pdata[i], 0, NULL);
    for (const char *file; dir != NULL && (file = g_dir_read_name(dir)) != NULL;) {
      g_autofree char *name =
          g_str_has_suffix(file, ENDING) ? g_strndup(file, strlen(file) - strlen(ENDING)) : NULL;
      if (name != NULL && !g_ptr_array_find_with_equal_func(names, name, g_str_equal, NULL)) {
        g_ptr_array_add(names, g_steal_pointer(&name));
      }
    }
  }
  g_ptr_array_sort(names, sb_note_compare);
  g_ptr_array_add(names, NULL);
  return (char **)g_ptr_array_free(names, FALSE);
}

// Owned by the caller; NULL: there is none.
static char *find_sheet(const char *name, const char *directory, GPtrArray *places) {
  const bool file = strchr(name, G_DIR_SEPARATOR) != NULL || g_str_has_suffix(name, ENDING);
  if (g_path_is_absolute(name)) {
    return g_strdup(name);
  }
  g_autofree char *whole = file ? g_strdup(name) : g_strconcat(name, ENDING, NULL);
  g_autofree char *beside =
      directory != NULL ? g_build_filename(directory, whole, NULL) : g_strdup(whole);
  if (file || g_file_test(beside, G_FILE_TEST_IS_REGULAR)) {
    return g_steal_pointer(&beside);
  }
  for (guint i = 0; i < places->len; i++) {
    g_autofree char *path = g_build_filename(places->pdata[i], whole, NULL);
    if (g_file_test(path, G_FILE_TEST_IS_REGULAR)) {
      return g_steal_pointer(&path);
    }
  }
  return NULL;
}

// The value of GROUP NAME, or NULL.
static const char *text_of(const GPtrArray *entries, const char *group, const char *name) {
  for (guint i = 0; i < entries->len; i++) {
    const SbEntry *entry = entries->pdata[i];
    if (entry->name != NULL && strcmp(entry->group, group) == 0 && strcmp(entry->name, name) == 0) {
      return entry->value;
    }
  }
  return NULL;
}

// One figure; what is wrong with it becomes an issue.
static void take(SbRubberSheet *out, const GPtrArray *entries, const SbEntry *entry,
                 const char *path, GPtrArray *issues) {
  static const struct {
    const char *group;
    SbParamId id;
  } by_fluid[] = {{"swell", SB_P_RUBBER_SWELL_MASS}, {"permeability", SB_P_RUBBER_PERMEABILITY}};
  g_autofree char *key = g_strdup_printf("%s.%s", entry->group, entry->name);
  int id = sb_param_find(key), fluid = -1;
  bool named = false;
  for (size_t i = 0; i < G_N_ELEMENTS(by_fluid); i++) {
    if (strcmp(entry->group, by_fluid[i].group) == 0) {
      named = true;
      id = by_fluid[i].id;
      fluid = sb_param_choice(sb_param(SB_P_FLUID_NAME), entry->name, strlen(entry->name));
    }
  }
  if (id < 0 || !sb_param_of_rubber((SbParamId)id) || (named && fluid < 0)) {
    sb_issues_add(issues, path, entry->line, key, NULL,
                  named ? "names no fluid" : "is not a figure of a rubber");
    return;
  }
  double value = 0;
  g_autoptr(GError) error = NULL;
  SbParams trial;
  SbReport report;
  sb_params_init(&trial);
  if (!sb_param_parse(&value, (SbParamId)id, entry->value, &error) ||
      sb_params_set(&trial, (SbParamId)id, value, &report) != SB_OK) {
    g_autofree char *range = sb_param_range((SbParamId)id);
    sb_issues_add(issues, path, entry->line, key, range, "%s",
                  error != NULL ? error->message : report.text);
    return;
  }
  const char *source = text_of(entries, "source", key);
  if (source == NULL || *source == '\0') {
    sb_issues_add(issues, path, entry->line, key, NULL,
                  "has no source: [source] must name its origin, or be \"typical\"");
    return;
  }
  if (strlen(source) >= SB_SOURCE_MAX) {
    g_autofree char *range = g_strdup_printf("at most %d bytes", SB_SOURCE_MAX - 1);
    sb_issues_add(issues, path, entry->line, key, range, "has a source of %zu bytes in [source]",
                  strlen(source));
    return;
  }
  if (out->count == SB_RUBBER_FIGURES_MAX) {
    sb_issues_add(issues, path, entry->line, key, NULL, "is more than the %d figures there may be",
                  SB_RUBBER_FIGURES_MAX);
    return;
  }
  const size_t at = out->count++;
  out->figure[at].id = (SbParamId)id;
  out->figure[at].fluid = fluid;
  out->figure[at].value = value;
  out->figure[at].typical = g_str_has_prefix(source, "typical");
  g_strlcpy(out->figure[at].source, source, sizeof out->figure[at].source);
}

static void read_entries(SbRubberSheet *out, const GPtrArray *entries, const char *path,
                         GPtrArray *issues) {
  if (g_strcmp0(text_of(entries, "sealbench", "kind"), "rubber") != 0 ||
      g_strcmp0(text_of(entries, "sealbench", "format"), "1") != 0) {
    sb_issues_add(issues, path, 0, "sealbench.kind", "rubber",
                  "is not a rubber: [sealbench] must have format = 1 and kind = rubber");
    return;
  }
  for (guint i = 0; i < entries->len; i++) {
    const SbEntry *entry = entries->pdata[i];
    if (entry->name == NULL || strcmp(entry->group, "sealbench") == 0) {
      continue;
    }
    if (strcmp(entry->group, "source") != 0) {
      take(out, entries, entry, path, issues);
      continue;
    }
    g_auto(GStrv) parts = g_strsplit(entry->name, ".", 2);
    if (g_strv_length(parts) != 2 || text_of(entries, parts[0], parts[1]) == NULL) {
      sb_issues_add(issues, path, entry->line, "source", NULL, "%s is not a figure of this file",
                    entry->name);
    }
  }
}

bool sb_rubber_sheet_parse(SbRubberSheet *out, const char *text, size_t length, const char *shown,
                           GPtrArray *issues) {
  const guint before = issues->len;
  *out = (SbRubberSheet){0};
  g_autoptr(GPtrArray) entries = sb_reader_scan(text, length, shown, issues);
  read_entries(out, entries, shown, issues);
  return issues->len == before;
}

char *sb_rubber_sheet_find(const char *name, const char *directory) {
  g_autoptr(GPtrArray) places = folders(directory);
  return find_sheet(name, directory, places);
}

char *sb_rubber_sheet_read(SbRubberSheet *out, const char *name, const char *directory,
                           const char *shown, int line, GPtrArray *issues) {
  const guint before = issues->len;
  g_autofree char *path = sb_rubber_sheet_find(name, directory);
  *out = (SbRubberSheet){0};
  if (path == NULL) {
    g_auto(GStrv) list = sb_rubber_sheet_names(directory);
    g_autofree char *names = g_strjoinv(", ", list);
    sb_issues_add(issues, shown, line, "rubber.name", names, "there is no rubber \"%s\"", name);
    return NULL;
  }
  size_t length = 0;
  g_autofree char *text = sb_reader_load(&length, path, path, SB_RUBBER_BYTES_MAX, issues);
  if (text != NULL) {
    (void)sb_rubber_sheet_parse(out, text, length, path, issues);
    g_autofree char *base = g_path_get_basename(path);
    const size_t ending = g_str_has_suffix(base, ENDING) ? strlen(ENDING) : 0;
    g_strlcpy(out->name, base, MIN(sizeof out->name, strlen(base) - ending + 1));
  }
  return issues->len == before ? g_steal_pointer(&path) : NULL;
}
