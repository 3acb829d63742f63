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

static void show_message(GtkWindow *window, const char *title, const char *text) {
  GtkWidget *dialog =
      gtk_message_dialog_new(window, GTK_DIALOG_MODAL | GTK_DIALOG_DESTROY_WITH_PARENT,
                             GTK_MESSAGE_ERROR, GTK_BUTTONS_CLOSE, "%s", title);
  if (text != NULL) {
    gtk_message_dialog_format_secondary_text(GTK_MESSAGE_DIALOG(dialog), "%s", text);
  }
  gtk_dialog_run(GTK_DIALOG(dialog));
  gtk_widget_destroy(dialog);
}

enum { DISCARD = 1, KEEP_BOTH, RESTORE };

static int ask(GtkWindow *window, const SbUnsaved *unsaved) {
  const gboolean outdated = sb_unsaved_is_outdated(unsaved);
  g_autofree char *name =
      unsaved->path != NULL ? g_filename_display_basename(unsaved->path) : g_strdup(_("Untitled"));
  GtkWidget *dialog = gtk_message_dialog_new(
      window, GTK_DIALOG_MODAL | GTK_DIALOG_DESTROY_WITH_PARENT, GTK_MESSAGE_QUESTION,
      GTK_BUTTONS_NONE, _("Restore the unsaved changes of “%s”?"), name);
  gtk_message_dialog_format_secondary_text(
      GTK_MESSAGE_DIALOG(dialog), "%s",
      outdated ? _("Sealbench ended before they were saved, and another program has changed the "
                   "file since. Restore merges both, value by value; Keep Both writes your "
                   "version to a new file next to it; Discard leaves the file's version.")
               : _("Sealbench ended before they were saved. Restored, they "
                   "wait to be saved; the file stays as it "
                   "is until then."));
  gtk_dialog_add_buttons(GTK_DIALOG(dialog), _("_Discard"), DISCARD, _("_Later"),
                         GTK_RESPONSE_CANCEL, NULL);
  if (outdated) {
    gtk_dialog_add_button(GTK_DIALOG(dialog), _("_Keep Both"), KEEP_BOTH);
  }
  gtk_dialog_add_button(GTK_DIALOG(dialog), _("_Restore"), RESTORE);
  gtk_dialog_set_default_response(GTK_DIALOG(dialog), RESTORE);
  const int answer = gtk_dialog_run(GTK_DIALOG(dialog));
  gtk_widget_destroy(dialog);
  return answer;
}

// Restores one file of unsaved changes, merged into what the document's file says now or (`apart`)
// as they were, in a file of their own.
static void restore(Offer *offer, const char *file, const SbUnsaved *unsaved, gboolean apart) {
  g_autoptr(GPtrArray) issues = sb_issues_new();
  g_autoptr(GPtrArray) conflicts = g_ptr_array_new_with_free_func(g_free);
  g_autoptr(GError) error = NULL;
  if (!sb_session_restore(offer->session, unsaved->path, apart ? NULL : unsaved->base,
                          unsaved->text, conflicts, issues)) {
    g_autofree char *line = issues->len > 0 ? sb_issue_line(issues->pdata[0]) : NULL;
    show_message(offer->window, _("The changes could not be restored."), line);
    return;
  }
  if (apart && !sb_session_keep_both(offer->session, &error)) {
    show_message(offer->window, _("Your version could not be written."), error->message);
  }
  // The window keeps a file of its own before the old one goes.
  sb_autosave_write(offer->autosave);
  g_unlink(file);
  if (conflicts->len > 0) {
    g_ptr_array_add(conflicts, NULL);
    g_autofree char *text = g_strjoinv("\n", (char **)conflicts->pdata);
    show_message(offer->window, _("Both versions changed these values; yours are in force."), text);
  }
}

// Asks what to do with one file. TRUE: it is dealt with, there may be another.
static gboolean offer_file(Offer *offer, const char *file) {
  g_auto(SbUnsaved) unsaved = {0};
  if (!sb_autosave_read(&unsaved, file)) {
    return g_unlink(file) == 0;
  }
  const int answer = ask(offer->window, &unsaved);
  if (answer == DISCARD) {
    return g_unlink(file) == 0;
  }
  if (answer == RESTORE || answer == KEEP_BOTH) {
    restore(offer, file, &unsaved, answer == KEEP_BOTH);
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
