// Keeping unsaved changes. See autosave.h. A file's first line is a comment with the path of the
// document (nothing for one without a name), the second one the length of that file's text when it
// was read; then come that text and the document's text with the changes. It is locked
// while the process that wrote it lives, wherever that runs.
#include "app/session/autosave.h"

#include "app/base/output.h"

#include <glib/gstdio.h>
#include <string.h>
#include <unistd.h>

struct SbAutosave {
  SbSession *session;
  char *path;       // of the file
  int lock;         // on it
  unsigned written; // serial of the document in it, 0: there is none
  guint write;
};

static char *folder(void) {
  return g_build_filename(g_get_user_data_dir(), "sealbench", "unsaved", NULL);
}

static void drop_file(SbAutosave *autosave) {
  if (autosave->written != 0) {
    g_unlink(autosave->path);
    close(autosave->lock);
    autosave->written = 0;
  }
}

void sb_autosave_write(SbAutosave *autosave) {
  if (autosave->write != 0) {
    g_source_remove(autosave->write);
    autosave->write = 0;
  }
  const SbDocument *document = sb_session_document(autosave->session);
  unsigned serial = sb_document_serial(document) + 1;
  if (!sb_session_is_modified(autosave->session) || serial == autosave->written) {
    return;
  }
  const char *path = sb_document_path(document);
  g_autofree char *whole = path != NULL ? g_canonicalize_filename(path, NULL) : g_strdup("");
  g_autofree char *text = sb_document_to_text(document, NULL);
  const char *base = path != NULL ? sb_document_file_text(document) : "";
  g_autofree char *content =
      g_strdup_printf("# %s\n# base %zu\n%s%s", whole, strlen(base), base, text);
  g_autofree char *in = g_path_get_dirname(autosave->path);
  // Where this is not possible (no home, full disk) the work goes on without a net.
  g_mkdir_with_parents(in, 0700);
  int lock;
  if (strchr(whole, '\n') == NULL &&
      sb_output_write_locked(&lock, autosave->path, content, strlen(content), NULL)) {
    if (autosave->written != 0) {
      close(autosave->lock);
    }
    autosave->lock = lock;
    autosave->written = serial;
  }
}

static gboolean on_delay(gpointer data) {
  SbAutosave *autosave = data;
  autosave->write = 0;
  sb_autosave_write(autosave);
  return G_SOURCE_REMOVE;
}

static void on_params(SbAutosave *autosave) {
  if (!sb_session_is_modified(autosave->session)) {
    drop_file(autosave);
  } else if (autosave->write == 0) {
    autosave->write = g_timeout_add(SB_AUTOSAVE_DELAY, on_delay, autosave);
  }
}

char *sb_autosave_find(void) {
  g_autofree char *in = folder();
  g_autoptr(GDir) dir = g_dir_open(in, 0, NULL);
  const char *name;
  while (dir != NULL && (name = g_dir_read_name(dir)) != NULL) {
    g_autofree char *path = g_build_filename(in, name, NULL);
    if (g_str_has_suffix(name, ".unsaved") && !sb_output_is_locked(path)) {
      return g_steal_pointer(&path);
    }
  }
  return NULL;
}

gboolean sb_autosave_read(SbUnsaved *out, const char *file) {
  static const char base[] = "# base ";
  g_autofree char *content = NULL;
  char *end = NULL;
  *out = (SbUnsaved){0};
  if (!g_file_get_contents(file, &content, NULL, NULL) || !g_str_has_prefix(content, "# ") ||
      (end = strchr(content, '\n')) == NULL) {
    return FALSE;
  }
  *end++ = '\0';
  out->path = content[2] != '\0' ? g_strdup(content + 2) : NULL;
  if (g_str_has_prefix(end, base)) { // version 0.1 wrote none
    char *text = NULL;
    const guint64 length = g_ascii_strtoull(end + strlen(base), &text, 10);
    if (*text != '\n' || length > strlen(text + 1)) {
      sb_unsaved_clear(out);
      return FALSE;
    }
    out->base = length > 0 ? g_strndup(text + 1, length) : NULL;
    end = text + 1 + length;
  }
  out->text = g_strdup(end);
  return TRUE;
}

void sb_unsaved_clear(SbUnsaved *unsaved) {
  g_free(unsaved->path);
  g_free(unsaved->base);
  g_free(unsaved->text);
  *unsaved = (SbUnsaved){0};
}

gboolean sb_unsaved_is_outdated(const SbUnsaved *unsaved) {
  g_autofree char *now = NULL;
  return unsaved->path != NULL && unsaved->base != NULL &&
         (!g_file_get_contents(unsaved->path, &now, NULL, NULL) || strcmp(now, unsaved->base) != 0);
}

SbAutosave *sb_autosave_new(SbSession *session) {
  SbAutosave *autosave = g_new0(SbAutosave, 1);
  autosave->session = session;
  g_autofree char *in = folder();
  g_autofree char *number = g_uuid_string_random();
  g_autofree char *name = g_strconcat(number, ".unsaved", NULL);
  autosave->path = g_build_filename(in, name, NULL);
  g_signal_connect_swapped(session, "params-changed", G_CALLBACK(on_params), autosave);
  return autosave;
}

void sb_autosave_leave(SbAutosave *autosave) {
  sb_autosave_write(autosave);
  // The file stays; its lock goes with the process.
  autosave->written = 0;
}

void sb_autosave_free(SbAutosave *autosave) {
  if (autosave == NULL) {
    return;
  }
  g_signal_handlers_disconnect_by_data(autosave->session, autosave);
  if (autosave->write != 0) {
    g_source_remove(autosave->write);
  }
  drop_file(autosave);
  g_free(autosave->path);
  g_free(autosave);
}
