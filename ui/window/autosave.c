// Keeping and offering unsaved changes. See autosave.h. A file's first line is a comment with the
// path of the document (nothing for one without a name), the rest is its text with the changes. It
// is locked while the process that wrote it lives, wherever that runs.
#include "ui/window/autosave.h"

#include "app/base/output.h"

#include <glib/gi18n.h>
#include <glib/gstdio.h>
#include <string.h>
#include <unistd.h>

struct SbAutosave {
  SbSession *session;
  GtkWindow *window;
  char *path;       // of the file
  int lock;         // on it
  unsigned written; // serial of the document in it, 0: there is none
  guint write, offer;
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

static gboolean write_now(gpointer data) {
  SbAutosave *autosave = data;
  autosave->write = 0;
  const SbDocument *document = sb_session_document(autosave->session);
  unsigned serial = sb_document_serial(document) + 1;
  if (!sb_session_is_modified(autosave->session) || serial == autosave->written) {
    return G_SOURCE_REMOVE;
  }
  const char *path = sb_document_path(document);
  g_autofree char *whole = path != NULL ? g_canonicalize_filename(path, NULL) : g_strdup("");
  g_autofree char *text = sb_document_to_text(document, NULL);
  g_autofree char *content = g_strdup_printf("# %s\n%s", whole, text);
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
  return G_SOURCE_REMOVE;
}

static void on_params(SbAutosave *autosave) {
  if (!sb_session_is_modified(autosave->session)) {
    drop_file(autosave);
  } else if (autosave->write == 0) {
    autosave->write = g_timeout_add(SB_AUTOSAVE_DELAY, write_now, autosave);
  }
}

// A file that was left behind, or NULL. Owned by the caller.
static char *find_orphan(void) {
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

static void show_message(GtkWindow *window, const char *title, const GPtrArray *issues) {
  GtkWidget *dialog =
      gtk_message_dialog_new(window, GTK_DIALOG_MODAL | GTK_DIALOG_DESTROY_WITH_PARENT,
                             GTK_MESSAGE_ERROR, GTK_BUTTONS_CLOSE, "%s", title);
  if (issues->len > 0) {
    g_autofree char *line = sb_issue_line(issues->pdata[0]);
    gtk_message_dialog_format_secondary_text(GTK_MESSAGE_DIALOG(dialog), "%s", line);
  }
  gtk_dialog_run(GTK_DIALOG(dialog));
  gtk_widget_destroy(dialog);
}

// Asks what to do with one file. TRUE: it is dealt with, there may be another.
static gboolean offer_file(SbAutosave *autosave, const char *file) {
  g_autofree char *content = NULL;
  char *end = NULL;
  if (!g_file_get_contents(file, &content, NULL, NULL) || !g_str_has_prefix(content, "# ") ||
      (end = strchr(content, '\n')) == NULL) {
    return g_unlink(file) == 0;
  }
  *end = '\0';
  const char *path = content[2] != '\0' ? content + 2 : NULL;
  g_autofree char *name =
      path != NULL ? g_filename_display_basename(path) : g_strdup(_("Untitled"));
  GtkWidget *dialog = gtk_message_dialog_new(
      autosave->window, GTK_DIALOG_MODAL | GTK_DIALOG_DESTROY_WITH_PARENT, GTK_MESSAGE_QUESTION,
      GTK_BUTTONS_NONE, _("Restore the unsaved changes of “%s”?"), name);
  gtk_message_dialog_format_secondary_text(
      GTK_MESSAGE_DIALOG(dialog), _("Sealbench ended before they were saved. Restored, they "
                                    "wait to be saved; the file stays as it "
                                    "is until then."));
  gtk_dialog_add_buttons(GTK_DIALOG(dialog), _("_Discard"), GTK_RESPONSE_NO, _("_Later"),
                         GTK_RESPONSE_CANCEL, _("_Restore"), GTK_RESPONSE_YES, NULL);
  gtk_dialog_set_default_response(GTK_DIALOG(dialog), GTK_RESPONSE_YES);
  int answer = gtk_dialog_run(GTK_DIALOG(dialog));
  gtk_widget_destroy(dialog);
  if (answer == GTK_RESPONSE_NO) {
    return g_unlink(file) == 0;
  }
  if (answer == GTK_RESPONSE_YES) {
    GPtrArray *issues = sb_issues_new();
    if (sb_session_restore(autosave->session, path, end + 1, issues)) {
      // The window keeps a file of its own before the old one goes.
      write_now(autosave);
      g_unlink(file);
    } else {
      show_message(autosave->window, _("The changes could not be restored."), issues);
    }
    g_ptr_array_unref(issues);
  }
  return FALSE;
}

static gboolean offer_now(gpointer data) {
  SbAutosave *autosave = data;
  autosave->offer = 0;
  if (sb_session_is_modified(autosave->session)) {
    return G_SOURCE_REMOVE; // what is edited already is not replaced
  }
  char *file = NULL;
  gboolean more = TRUE;
  while (more && (file = find_orphan()) != NULL) {
    more = offer_file(autosave, file);
    g_free(file);
  }
  return G_SOURCE_REMOVE;
}

SbAutosave *sb_autosave_new(SbSession *session, GtkWindow *window) {
  static gboolean offered;
  SbAutosave *autosave = g_new0(SbAutosave, 1);
  autosave->session = session;
  autosave->window = window;
  g_autofree char *in = folder();
  g_autofree char *number = g_uuid_string_random();
  g_autofree char *name = g_strconcat(number, ".unsaved", NULL);
  autosave->path = g_build_filename(in, name, NULL);
  g_signal_connect_swapped(session, "params-changed", G_CALLBACK(on_params), autosave);
  if (!offered) {
    offered = TRUE;
    // Once the window stands.
    autosave->offer = g_timeout_add(300, offer_now, autosave);
  }
  return autosave;
}

void sb_autosave_free(SbAutosave *autosave) {
  if (autosave == NULL) {
    return;
  }
  g_signal_handlers_disconnect_by_data(autosave->session, autosave);
  if (autosave->write != 0) {
    g_source_remove(autosave->write);
  }
  if (autosave->offer != 0) {
    g_source_remove(autosave->offer);
  }
  drop_file(autosave);
  g_free(autosave->path);
  g_free(autosave);
}
