// Reads study files and lays out their points; see the header.
#include "app/document/study_file_private.h"

#include "app/base/own_model.h"
#include "app/base/reader.h"

#include <string.h>
#include <unistd.h>

static const char *const methods[SB_METHOD_COUNT] = {
#define METHOD_NAME(code, name) [code] = name,
    SB_STUDY_METHODS(METHOD_NAME)
#undef METHOD_NAME
};

const char *sb_study_method_name(SbStudyMethod method) {
  return (unsigned)method < SB_METHOD_COUNT ? methods[method] : "";
}

static char *full_study_key(const SbEntry *entry) {
  return g_strdup_printf("%s.%s", entry->group, entry->name);
}

void sb_study_add_issue(const SbStudyReader *reader, const SbEntry *entry, const char *allowed,
                        const char *text) {
  g_autofree char *key = full_study_key(entry);
  sb_issues_add(reader->issues, reader->shown, entry->line, key, allowed, "%s", text);
}

// ---- [correlation] ----

int sb_study_vary_index(const SbStudyFile *study, const char *key) {
  for (guint i = 0; i < study->vary->len; i++) {
    if (strcmp(sb_vary_name(&g_array_index(study->vary, SbVary, i)), key) == 0) {
      return (int)i;
    }
  }
  return -1;
}

SbStudyFile *sb_study_file_read(const char *path, const char *text, size_t length, char **settings,
                                GPtrArray *issues) {
  const char *shown = strcmp(path, "-") == 0 ? "standard input" : path;
  g_autofree char *directory = sb_reader_folder(path);
  SbStudyFile *study = sb_study_file_parse(text, length, shown, directory, settings, NULL, issues);
  if (study != NULL && directory != NULL) {
    study->path = g_strdup(path);
  }
  return study;
}

SbStudyFile *sb_study_file_load(const char *path, char **settings, GPtrArray *issues) {
  size_t length = 0;
  g_autofree char *text = sb_document_load_text(&length, path, issues);
  return text != NULL ? sb_study_file_read(path, text, length, settings, issues) : NULL;
}

void sb_study_file_free(SbStudyFile *study) {
  if (study == NULL) {
    return;
  }
  for (guint i = 0; i < study->vary->len && study->lines == NULL; i++) {
    g_free(g_array_index(study->vary, SbVary, i).levels);
  }
  for (guint i = 0; study->lines != NULL && i < study->lines->len; i++) {
    const SbVary *line = &g_array_index(study->lines, SbVary, i);
    g_free(line->levels);
    g_free(line->name);
    g_free(line->by);
  }
  g_clear_pointer(&study->lines, g_array_unref);
  g_array_unref(study->vary);
  g_array_unref(study->figures);
  if (study->design.tolerances != NULL) {
    g_array_unref(study->design.tolerances);
  }
  if (study->borrowed) {
    g_free(study);
    return;
  }
  sb_document_free(study->scene);
  sb_model_destroy(study->base);
  g_clear_pointer(&study->data, g_ptr_array_unref);
  g_ptr_array_unref(study->notes);
  g_free(study->base_sha256);
  g_free(study->root);
  g_free(study->path);
  g_free(study->title);
  g_free(study);
}
