// The rubber that a document names (rubber.name): the valve's, its own in place of it, and edits of
// its own that can be undone.
#include "app/document/document_private.h"

#include "app/document/rubber_sheet.h"

#include <string.h>

static void clear_rubber(gpointer data) {
  SbNamedRubber *rubber = data;
  g_free(rubber->name);
  g_free(rubber->path);
}

void sb_named_rubber_release(SbNamedRubber *rubber) {
  if (rubber != NULL) {
    g_rc_box_release_full(rubber, clear_rubber);
  }
}

SbNamedRubber *sb_named_rubber_hold(SbNamedRubber *rubber) {
  return rubber != NULL ? g_rc_box_acquire(rubber) : NULL;
}

bool sb_named_rubber_same(const SbNamedRubber *a, const SbNamedRubber *b) {
  return a == b ||
         (a != NULL && b != NULL && strcmp(a->name, b->name) == 0 && strcmp(a->path, b->path) == 0);
}

SbNamedRubber *sb_named_rubber_read(const char *name, const char *directory, const char *shown,
                                    int line, GPtrArray *issues) {
  SbNamedRubber *out = g_rc_box_new0(SbNamedRubber);
  out->name = g_strdup(name);
  out->path = sb_rubber_sheet_read(&out->sheet, name, directory, shown, line, issues);
  if (out->path == NULL) {
    g_clear_pointer(&out, sb_named_rubber_release);
  }
  return out;
}

SbNamedRubber *sb_document_rubber_in_force(const SbDocument *document) {
  return document->own_rubber != NULL ? document->own_rubber : document->base_rubber;
}

SbModelData *sb_document_data_with(const SbDocument *document, const SbNamedRubber *rubber) {
  SbModelData *data = NULL;
  if (sb_model_data_create(&data) != SB_OK) {
    g_error("no memory for a document"); // as g_malloc() does
  }
  if (document->data != NULL) {
    data->measured = document->data->measured;
    data->shelf = document->data->shelf;
    data->profile = document->data->profile;
    data->groove = document->data->groove;
    data->outlines = document->data->outlines;
  }
  data->rubber = rubber != NULL ? rubber->sheet : (SbRubberSheet){0};
  return data;
}

void sb_document_put_rubber(SbDocument *document, SbNamedRubber **place, SbNamedRubber *rubber) {
  sb_named_rubber_release(*place);
  *place = rubber;
  // Models may hold the data before, which nobody changes.
  SbModelData *data = sb_document_data_with(document, sb_document_rubber_in_force(document));
  sb_model_data_release(document->data);
  document->data = data;
  document->serial++;
}

// The folder that names of rubbers start from: that of the file, and before it is saved none.
static char *folder_of(const SbDocument *document) {
  return document->path != NULL ? g_path_get_dirname(document->path) : NULL;
}

bool sb_document_set_rubber(SbDocument *document, const char *name, GPtrArray *issues) {
  g_autofree char *folder = folder_of(document);
  SbNamedRubber *rubber = NULL;
  if (name != NULL) {
    rubber = sb_named_rubber_read(name, folder, "rubber.name", 0, issues);
    if (rubber == NULL) {
      return false;
    }
  }
  sb_document_edit_rubber(document, rubber);
  return true;
}

const char *sb_document_rubber(const SbDocument *document) {
  const SbNamedRubber *rubber = sb_document_rubber_in_force(document);
  return rubber != NULL ? rubber->name : NULL;
}

bool sb_document_gives_rubber(const SbDocument *document) {
  return document->own_rubber != NULL;
}

char **sb_document_rubbers(const SbDocument *document) {
  g_autofree char *folder = folder_of(document);
  return sb_rubber_sheet_names(folder);
}

char *sb_document_rubber_name_at(const SbDocument *document, const char *directory) {
  const SbNamedRubber *rubber = document->own_rubber;
  if (rubber == NULL) {
    return NULL;
  }
  // The same name from there, unless it means another file there.
  g_autoptr(GPtrArray) issues = sb_issues_new();
  SbRubberSheet ignored;
  g_autofree char *there = sb_rubber_sheet_read(&ignored, rubber->name, directory, "", 0, issues);
  g_autofree char *here = g_canonicalize_filename(rubber->path, NULL);
  g_autofree char *found = there != NULL ? g_canonicalize_filename(there, NULL) : NULL;
  return g_strdup(g_strcmp0(here, found) == 0 ? rubber->name : here);
}
