// A document's [cases]: NAME = KEY=VALUE; KEY=VALUE. Each is the document with some values
// replaced, those of --set and of edits included. A scene's take the place of its valve's, name by
// name. The lines of [pins] (document_pins.c) are read by the same functions.
#include "app/base/reader.h"
#include "app/document/document_private.h"

#include <string.h>

static void case_free(gpointer data) {
  SbCase *one = data;
  g_free(one->name);
  g_free(one->settings);
  g_free(one->shown);
  g_free(one);
}

GPtrArray *sb_document_cases_new(void) {
  return g_ptr_array_new_with_free_func(case_free);
}

void sb_document_read_cases(GPtrArray *cases, const char *group, const GPtrArray *entries,
                            const char *shown, GPtrArray *issues) {
  for (guint i = 0; i < entries->len; i++) {
    const SbEntry *entry = entries->pdata[i];
    if (entry->name == NULL || strcmp(entry->group, group) != 0) {
      continue;
    }
    guint at = 0;
    while (at < cases->len && strcmp(((SbCase *)cases->pdata[at])->name, entry->name) != 0) {
      at++;
    }
    if (at == SB_CASES_MAX) {
      g_autofree char *key = g_strdup_printf("%s.%s", group, entry->name);
      sb_issues_add(issues, shown, entry->line, key, NULL, "is more than the %d %s there may be",
                    SB_CASES_MAX, group);
      continue;
    }
    SbCase *one = g_new(SbCase, 1);
    *one = (SbCase){g_strdup(entry->name), g_strdup(entry->value), g_strdup(shown)};
    if (at < cases->len) {
      case_free(cases->pdata[at]);
      cases->pdata[at] = one;
    } else {
      g_ptr_array_add(cases, one);
    }
  }
}

void sb_document_append_cases(GString *text, const GPtrArray *cases) {
  for (guint i = 0; i < cases->len; i++) {
    const SbCase *one = cases->pdata[i];
    g_string_append_printf(text, "%s%s = %s\n", i == 0 ? "\n[" SB_CASES_GROUP "]\n" : "", one->name,
                           one->settings);
  }
}

size_t sb_document_case_count(const SbDocument *document) {
  return document->cases->len;
}

const char *sb_document_case_name(const SbDocument *document, size_t index) {
  return ((const SbCase *)document->cases->pdata[index])->name;
}

// Puts one "KEY=VALUE" into `params`; what is wrong becomes an issue on the case `path`.
// A rubber goes to *rubber.
static void put_setting(SbParams *params, bool *set, SbNamedRubber **rubber,
                        const SbDocument *document, const SbCase *one, const char *path,
                        const char *setting, GPtrArray *issues) {
  const char *text;
  g_autofree char *key = sb_document_split(&text, setting);
  if (key == NULL) {
    sb_issues_add(issues, one->shown, 0, path, "KEY=VALUE; KEY=VALUE", "\"%s\" is not KEY=VALUE",
                  setting);
    return;
  }
  g_autofree char *value_text = g_strstrip(g_strdup(text));
  int id = sb_param_find(key);
  if (strcmp(key, SB_RUBBER_KEY) == 0) {
    g_autofree char *folder = document->path != NULL ? g_path_get_dirname(document->path) : NULL;
    sb_named_rubber_release(*rubber);
    *rubber = sb_named_rubber_read(value_text, folder, one->shown, 0, issues);
    return;
  }
  if (id < 0) {
    g_autofree char *hint = sb_document_key_hint(key);
    sb_issues_add(issues, one->shown, 0, path, NULL, "%s: unknown key%s", key, hint);
    return;
  }
  double value = 0;
  SbReport report = {0};
  g_autoptr(GError) error = NULL;
  if (set[id]) {
    sb_issues_add(issues, one->shown, 0, path, NULL, "%s: is given twice", key);
  } else if (!sb_document_read_value(&value, document, (SbParamId)id, value_text, &error) ||
             sb_params_set(params, (SbParamId)id, value, &report) != SB_OK) {
    g_autofree char *range = sb_param_range((SbParamId)id);
    sb_issues_add(issues, one->shown, 0, path, range, "%s: %s", key,
                  error != NULL ? error->message : report.text);
  }
  set[id] = true;
}

// Appends the notes on the settings of one line.
static void note_line(GPtrArray *notes, const SbCase *one, const char *group, int line) {
  g_autofree char *path = g_strdup_printf("%s.%s", group, one->name);
  g_auto(GStrv) settings = g_strsplit(one->settings, ";", -1);
  for (char **setting = settings; *setting != NULL; setting++) {
    const char *text = NULL;
    g_autofree char *key = sb_document_split(&text, g_strstrip(*setting));
    const int id = key != NULL ? sb_param_find(key) : -1;
    if (id >= 0) {
      sb_hardness_note(notes, one->shown, line, path, (SbParamId)id, text);
    }
  }
}

void sb_document_note_cases(const SbDocument *document, GPtrArray *notes) {
  for (guint i = 0; i < document->cases->len; i++) {
    note_line(notes, document->cases->pdata[i], SB_CASES_GROUP, 0);
  }
  for (guint i = 0; i < document->entries->len; i++) {
    const SbEntry *entry = document->entries->pdata[i];
    if (entry->name != NULL && strcmp(entry->group, SB_PINS_GROUP) == 0) {
      const SbCase pin = {entry->name, entry->value, document->name};
      note_line(notes, &pin, SB_PINS_GROUP, entry->line);
    }
  }
}

bool sb_document_case_params(const SbDocument *document, const SbCase *one, const char *path,
                             SbParams *params, SbNamedRubber **rubber, GPtrArray *issues) {
  guint before = issues->len;
  bool set[SB_PARAM_COUNT] = {false};
  *params = sb_document_params(document);
  *rubber = NULL;
  g_auto(GStrv) settings = g_strsplit(one->settings, ";", -1);
  char **setting = settings;
  do {
    put_setting(params, set, rubber, document, one, path,
                *setting != NULL ? g_strstrip(*setting) : "", issues);
    setting += *setting != NULL;
  } while (*setting != NULL && *g_strstrip(*setting) != '\0'); // a last semicolon is fine
  if (issues->len > before) {
    g_clear_pointer(rubber, sb_named_rubber_release);
    return false;
  }
  return true;
}

bool sb_document_case_model(const SbDocument *document, SbParams params, SbNamedRubber *rubber,
                            const char *shown, const char *path, SbModel **out, GPtrArray *issues) {
  SbModelData *data = rubber != NULL ? sb_document_data_with(document, rubber) : document->data;
  if (rubber != NULL) {
    params.rubber = &data->rubber;
  }
  g_autofree SbProblems *problems = g_new0(SbProblems, 1);
  SbStatus status = sb_model_create(out, &params, data, &document->limits, problems);
  if (rubber != NULL) {
    sb_model_data_release(data); // the model has its own hold
  }
  if (status != SB_OK && problems->count == 0) {
    sb_issues_add(issues, shown, 0, path, NULL, "%s", sb_status_text(status));
  }
  for (size_t i = 0; status != SB_OK && i < problems->count; i++) {
    const SbProblem *problem = &problems->item[i];
    int id = sb_param_find(problem->key);
    g_autofree char *range =
        id >= 0 ? sb_document_problem_range(problem, sb_param((SbParamId)id)) : NULL;
    sb_issues_add(issues, shown, 0, path, range, "%s: %s", problem->key, problem->text);
  }
  return status == SB_OK;
}

bool sb_document_compile_case(const SbDocument *document, size_t index, SbModel **out,
                              GPtrArray *issues) {
  *out = NULL;
  const SbCase *one = document->cases->pdata[index];
  g_autofree char *path = g_strdup_printf("%s.%s", SB_CASES_GROUP, one->name);
  SbParams params;
  SbNamedRubber *rubber = NULL;
  const bool good = sb_document_case_params(document, one, path, &params, &rubber, issues) &&
                    sb_document_case_model(document, params, rubber, one->shown, path, out, issues);
  sb_named_rubber_release(rubber);
  return good;
}

bool sb_document_check_case_lines(const SbDocument *document, GPtrArray *issues) {
  bool good = true;
  for (guint i = 0; i < document->cases->len; i++) {
    const SbCase *one = document->cases->pdata[i];
    g_autofree char *path = g_strdup_printf("%s.%s", SB_CASES_GROUP, one->name);
    SbParams params;
    SbNamedRubber *rubber = NULL;
    good = sb_document_case_params(document, one, path, &params, &rubber, issues) && good;
    sb_named_rubber_release(rubber);
  }
  return good;
}

bool sb_document_case_is_good(const SbDocument *document, const char *name) {
  for (size_t i = 0; i < document->cases->len; i++) {
    if (strcmp(sb_document_case_name(document, i), name) == 0) {
      g_autoptr(GPtrArray) issues = sb_issues_new();
      g_autoptr(SbModel) model = NULL;
      return sb_document_compile_case(document, i, &model, issues);
    }
  }
  return false;
}

bool sb_document_check_cases(const SbDocument *document, GPtrArray *issues) {
  bool good = true;
  for (size_t i = 0; i < document->cases->len; i++) {
    g_autoptr(SbModel) model = NULL;
    good = sb_document_compile_case(document, i, &model, issues) && good;
  }
  return good;
}
