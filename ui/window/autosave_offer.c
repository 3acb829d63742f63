// Offering unsaved changes that another process left behind. See autosave_offer.h.
#include "ui/window/autosave_offer.h"

#include "ui/views/later.h"

#include <glib/gi18n.h>
#include <glib/gstdio.h>

typedef struct {
  SbSession *session;
  SbAutosave *autosave;
  GtkWindow *window;
  SbLater source; // the question
} Offer;

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
static gboolean offer_file(Offer *offer, const char *file) {
  g_autofree char *path = NULL;
  g_autofree char *text = sb_autosave_read(&path, file);
  if (text == NULL) {
    return g_unlink(file) == 0;
  }
  g_autofree char *name =
      path != NULL ? g_filename_display_basename(path) : g_strdup(_("Untitled"));
  GtkWidget *dialog = gtk_message_dialog_new(
      offer->window, GTK_DIALOG_MODAL | GTK_DIALOG_DESTROY_WITH_PARENT, GTK_MESSAGE_QUESTION,
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
    if (sb_session_restore(offer->session, path, text, issues)) {
      // The window keeps a file of its own before the old one goes.
      sb_autosave_write(offer->autosave);
      g_unlink(file);
    } else {
      show_message(offer->window, _("The changes could not be restored."), issues);
    }
    g_ptr_array_unref(issues);
  }
  return FALSE;
}

static void offer_now(gpointer data) {
  Offer *offer = data;
  if (sb_session_is_modified(offer->session)) {
    return; // what is edited already is not replaced
  }
  char *file = NULL;
  gboolean more = TRUE;
  while (more && (file = sb_autosave_find()) != NULL) {
    more = offer_file(offer, file);
    g_free(file);
  }
}

void sb_autosave_offer(SbSession *session, SbAutosave *autosave, GtkWindow *window) {
  static gboolean offered;
  if (!offered) {
    offered = TRUE;
    Offer *offer = g_new0(Offer, 1);
    *offer = (Offer){session, autosave, window, {0}};
    g_object_set_data_full(G_OBJECT(window), "autosave-offer", offer, g_free);
    sb_later_set(&offer->source, window, 300, offer_now, offer);
  }
}
