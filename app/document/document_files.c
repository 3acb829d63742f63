// Files that keys of a document name: what they hold goes into the data of its models.
#include "app/document/document_private.h"

#include "app/document/seal_file.h"
#include "app/document/series.h"

#include <math.h>
#include <string.h>

// Those of files come first, by SbFileKey.
static const SbTextKey text_keys[] = {
    [SB_FILE_DRIVE] = {"drive.file", "CSV file of the measured series (drive.kind = measured)"},
    [SB_FILE_SHELF] = {"shelf.file", "CSV file of temperatures over time (shelf.history = file)"},
    [SB_FILE_SECTION] = {"seal.profile_file", "Drawing of the free section (seal.profile = file)"},
    [SB_FILE_GROOVE] = {"gland.profile_file", "Drawing of the outline of the groove"},
    [SB_FILE_COUNT] = {SB_RUBBER_KEY,
                       "Rubber of the seals: a name of `list rubbers`, or a file NAME.rubber"},
    {0}};

const SbTextKey *sb_document_text_keys(void) {
  return text_keys;
}

const char *sb_document_file_key(int key) {
  return text_keys[key].key;
}

int sb_document_find_file(const char *key) {
  for (int i = 0; i < SB_FILE_COUNT; i++) {
    if (strcmp(key, sb_document_file_key(i)) == 0) {
      return i;
    }
  }
  return -1;
}

void sb_document_note_drawings(SbDocument *document) {
  static const SbParamId section[] = {SB_P_SEAL_OUTER_SECTION_DIAMETER,
                                      SB_P_SEAL_INNER_SECTION_DIAMETER};
  const double height = document->section_height;
  for (int i = 0; i < 2 && document->data != NULL && document->data->profile.count > 0; i++) {
    const double is = sb_document_value(document, section[i]);
    if (fabs(height - is) > 1e-3 * is) {
      sb_issues_add(document->notes, NULL, 0, "seal.profile_file", NULL,
                    "seal.profile_file: the section of %s is %.4g mm high; %s = %.4g mm applies, "
                    "and the section is scaled to it",
                    document->file[SB_FILE_SECTION].name, 1e3 * height, sb_param(section[i])->key,
                    1e3 * is);
    }
  }
  if (document->data != NULL && document->data->groove.count > 0) {
    const double drawn = document->data->groove.width;
    const double is = sb_document_value(document, SB_P_GLAND_AXIAL_WIDTH);
    if (fabs(drawn - is) > 1e-3 * is) {
      sb_issues_add(document->notes, NULL, 0, "gland.profile_file", NULL,
                    "gland.profile_file: the walls of %s are %.4g mm apart; gland.axial_width = "
                    "%.4g mm applies, and the walls are moved to it",
                    document->file[SB_FILE_GROOVE].name, 1e3 * drawn, 1e3 * is);
    }
  }
}

const char *sb_document_section(const SbDocument *document) {
  return document->file[SB_FILE_SECTION].name;
}

const char *sb_document_groove(const SbDocument *document) {
  return document->file[SB_FILE_GROOVE].name;
}

bool sb_document_may_drop_groove(const SbDocument *document) {
  return document->file[SB_FILE_GROOVE].name != NULL && !document->valve_draws;
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
static void put_files_data(SbDocument *document, SbModelData *data) {
  sb_model_data_release(document->data);
  document->data = data;
  document->serial++;
}

static SbNamedDrawing *drawing_new(SbFileKey key, const SbNamedFile *file) {
  SbNamedDrawing *drawing = g_new0(SbNamedDrawing, 1);
  drawing->key = key;
  drawing->file = (SbNamedFile){g_strdup(file->name), g_strdup(file->path), file->in_valve};
  return drawing;
}

SbNamedDrawing *sb_document_drawing_now(const SbDocument *document, SbFileKey key) {
  SbNamedDrawing *drawing = drawing_new(key, &document->file[key]);
  if (document->data != NULL) {
    drawing->section = document->data->profile;
    drawing->groove = document->data->groove;
  }
  drawing->height = document->section_height;
  return drawing;
}

void sb_named_drawing_free(SbNamedDrawing *drawing) {
  if (drawing != NULL) {
    g_free(drawing->file.name);
    g_free(drawing->file.path);
    g_free(drawing);
  }
}

void sb_document_put_drawing(SbDocument *document, const SbNamedDrawing *drawing) {
  SbModelData *data = sb_document_data_with(document, sb_document_rubber_in_force(document));
  if (drawing->key == SB_FILE_SECTION) {
    data->profile = drawing->section;
    document->section_height = drawing->height;
  } else {
    data->groove = drawing->groove;
  }
  name_file(document, drawing->key, drawing->file.name, g_strdup(drawing->file.path),
            drawing->file.in_valve);
  put_files_data(document, data);
}

const char *sb_document_own_drawing(const SbDocument *document, SbFileKey key) {
  const SbNamedFile *file = &document->file[key];
  return file->in_valve ? NULL : file->path;
}

void sb_document_drawings_saved(SbDocument *document) {
  for (SbFileKey key = SB_FILE_SECTION; key < SB_FILE_COUNT; key++) {
    g_free(document->saved_drawing[key]);
    document->saved_drawing[key] = g_strdup(sb_document_own_drawing(document, key));
  }
}

bool sb_document_drawings_differ(const SbDocument *document) {
  for (SbFileKey key = SB_FILE_SECTION; key < SB_FILE_COUNT; key++) {
    if (g_strcmp0(sb_document_own_drawing(document, key), document->saved_drawing[key]) != 0) {
      return true;
    }
  }
  return false;
}

void sb_document_set_section(SbDocument *document, const char *path, const SbSealDrawing *section,
                             double height) {
  g_autofree char *whole = g_canonicalize_filename(path, NULL);
  const SbNamedFile file = {whole, whole, false};
  SbNamedDrawing *drawing = drawing_new(SB_FILE_SECTION, &file);
  drawing->section = *section;
  drawing->height = height;
  sb_document_edit_drawing(document, drawing);
}

void sb_document_set_groove(SbDocument *document, const char *path, const SbGrooveDrawing *groove) {
  g_autofree char *whole = path != NULL ? g_canonicalize_filename(path, NULL) : NULL;
  const SbNamedFile file = {whole, whole, false};
  SbNamedDrawing *drawing = drawing_new(SB_FILE_GROOVE, &file);
  if (path != NULL) {
    drawing->groove = *groove;
  }
  sb_document_edit_drawing(document, drawing);
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
    good = sb_series_read(&data->measured, SB_SERIES_DRIVE, NULL, 0, path, issues);
    break;
  case SB_FILE_SHELF:
    good = sb_series_read(&data->shelf, SB_SERIES_TEMPERATURE, NULL, 0, path, issues);
    break;
  default: {
    GError *error = NULL;
    good = key == SB_FILE_GROOVE
               ? sb_groove_file_read(&data->groove, path, &error)
               : sb_seal_file_read(&data->profile, &document->section_height, path, &error);
    if (!good) {
      sb_issues_add(issues, shown, line, sb_document_file_key(key), NULL, "%s", error->message);
      g_error_free(error);
    }
    break;
  }
  }
  if (!good) {
    sb_model_data_release(data);
    return false;
  }
  document->valve_draws = document->valve_draws || (key == SB_FILE_GROOVE && in_valve);
  put_files_data(document, data);
  return true;
}
