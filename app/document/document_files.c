// Files that keys of a document name: what they hold goes into the data of its models.
#include "app/document/document_private.h"

#include "app/document/seal_file.h"
#include "app/document/series.h"

#include <math.h>
#include <string.h>

const char *const sb_document_file_key[SB_FILE_COUNT] = {[SB_FILE_DRIVE] = "drive.file",
                                                         [SB_FILE_SHELF] = "shelf.file",
                                                         [SB_FILE_SECTION] = "seal.profile_file"};

int sb_document_find_file(const char *key) {
  for (int i = 0; i < SB_FILE_COUNT; i++) {
    if (strcmp(key, sb_document_file_key[i]) == 0) {
      return i;
    }
  }
  return -1;
}

void sb_document_note_section(SbDocument *document) {
  static const SbParamId section[] = {SB_P_SEAL_OUTER_SECTION_DIAMETER,
                                      SB_P_SEAL_INNER_SECTION_DIAMETER};
  const double height = document->section_height;
  for (int i = 0; i < 2 && document->data != NULL && document->data->profile.count > 0; i++) {
    const double is = sb_document_value(document, section[i]);
    if (fabs(height - is) > 1e-3 * is) {
      g_ptr_array_add(document->notes,
                      g_strdup_printf("seal.profile_file: the section of %s is %.4g mm high; %s = "
                                      "%.4g mm is in force, to which it is scaled",
                                      document->file[SB_FILE_SECTION].name, 1e3 * height,
                                      sb_param(section[i])->key, 1e3 * is));
    }
  }
}

const char *sb_document_section(const SbDocument *document) {
  return document->file[SB_FILE_SECTION].name;
}

// Names a file; takes `path`.
static void name_file(SbDocument *document, SbFileKey key, const char *name, char *path,
                      bool in_valve) {
  SbNamedFile *file = &document->file[key];
  g_free(file->name);
  g_free(file->path);
  *file = (SbNamedFile){g_strdup(name), path, in_valve};
}

// Models may hold the data before, which nobody changes.
static void put_data(SbDocument *document, SbModelData *data) {
  sb_model_data_release(document->data);
  document->data = data;
  document->serial++;
}

static SbNamedSection *section_new(const SbNamedFile *file, const SbSealDrawing *drawing,
                                   double height) {
  SbNamedSection *section = g_new0(SbNamedSection, 1);
  section->file = (SbNamedFile){g_strdup(file->name), g_strdup(file->path), file->in_valve};
  section->drawing = *drawing;
  section->height = height;
  return section;
}

SbNamedSection *sb_document_section_now(const SbDocument *document) {
  static const SbSealDrawing none;
  return section_new(&document->file[SB_FILE_SECTION],
                     document->data != NULL ? &document->data->profile : &none,
                     document->section_height);
}

void sb_named_section_free(SbNamedSection *section) {
  if (section != NULL) {
    g_free(section->file.name);
    g_free(section->file.path);
    g_free(section);
  }
}

void sb_document_put_section(SbDocument *document, const SbNamedSection *section) {
  SbModelData *data = sb_document_data_with(document, sb_document_rubber_in_force(document));
  data->profile = section->drawing;
  document->section_height = section->height;
  name_file(document, SB_FILE_SECTION, section->file.name, g_strdup(section->file.path),
            section->file.in_valve);
  put_data(document, data);
}

const char *sb_document_own_section(const SbDocument *document) {
  const SbNamedFile *file = &document->file[SB_FILE_SECTION];
  return file->in_valve ? NULL : file->path;
}

void sb_document_set_section(SbDocument *document, const char *path, const SbSealDrawing *section,
                             double height) {
  g_autofree char *whole = g_canonicalize_filename(path, NULL);
  const SbNamedFile file = {whole, whole, false};
  sb_document_edit_section(document, section_new(&file, section, height));
}

bool sb_document_read_file(SbDocument *document, SbFileKey key, const char *name,
                           const char *directory, bool in_valve, const char *shown, int line,
                           GPtrArray *issues) {
  char *path = g_path_is_absolute(name) || directory == NULL
                   ? g_strdup(name)
                   : g_build_filename(directory, name, NULL);
  name_file(document, key, name, path, in_valve);
  SbModelData *data = sb_document_data_with(document, sb_document_rubber_in_force(document));
  bool good = false;
  switch (key) {
  case SB_FILE_DRIVE:
    good = sb_series_read(&data->measured, path, issues);
    break;
  case SB_FILE_SHELF:
    good = sb_series_read_temperature(&data->shelf, path, issues);
    break;
  default: {
    GError *error = NULL;
    good = sb_seal_file_read(&data->profile, &document->section_height, path, &error);
    if (!good) {
      sb_issues_add(issues, shown, line, sb_document_file_key[key], NULL, "%s", error->message);
      g_error_free(error);
    }
    break;
  }
  }
  if (!good) {
    sb_model_data_release(data);
    return false;
  }
  put_data(document, data);
  return true;
}
