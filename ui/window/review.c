// See review.h. The report is written beside the window: one at a time, and what became of it is
// told at the window's foot.
#include "ui/window/review.h"

#include "app/export/export_job.h"
#include "app/session/worker.h"
#include "ui/window/preferences.h"
#include "ui/window/presentation.h"
#include "ui/window/toast.h"

#include <glib/gi18n.h>
#include <string.h>

typedef struct {
  GtkWindow *window;  // owns this
  SbSession *session; // borrowed: the window's
  SbExportJob *job;   // of the report, NULL while none is written
  char *written;      // the last report, NULL: none
} Review;

static void set_enabled(Review *review, const char *name, gboolean enabled) {
  GAction *action = g_action_map_lookup_action(G_ACTION_MAP(review->window), name);
  g_simple_action_set_enabled(G_SIMPLE_ACTION(action), enabled);
}

static void refresh_review(Review *review) {
  const SbDocument *document = sb_session_document(review->session);
  set_enabled(review, "report", review->job == NULL && sb_session_may_keep(review->session));
  set_enabled(review, "cancel-report", review->job != NULL);
  set_enabled(review, "show-report", review->written != NULL);
  set_enabled(review, "bookmark", sb_session_run(review->session) != NULL);
  set_enabled(review, "clear-bookmarks",
              sb_document_remark_count(document, SB_REMARK_BOOKMARK) > 0);
}

// Report -----------------------------------------------------------------------------------------

static void on_written(void *data) {
  Review *review = data;
  gboolean good = FALSE;
  const char *text = sb_export_job_result(review->job, &good);
  if (!good) {
    g_clear_pointer(&review->written, g_free);
  }
  refresh_review(review);
  sb_toast_show(review->window, text, _("Open"), good ? "win.show-report" : NULL, !good);
  g_clear_pointer(&review->job, sb_export_job_free);
  refresh_review(review);
}

// Takes over `path`.
static void write_report(Review *review, char *path) {
  SbSession *session = review->session;
  const SbDocument *document = sb_session_document(session);
  SbRunHandle *handle = sb_session_may_keep(session) ? sb_session_handle(session) : NULL;
  if (handle == NULL || review->job != NULL) { // another run began while the name was asked
    sb_run_handle_unref(handle);
    g_free(path);
    sb_toast_show(review->window, _("No report: there is no complete run of these values yet."),
                  NULL, NULL, FALSE);
    return;
  }
  g_autofree char *folder = g_path_get_dirname(path);
  sb_preferences_set_string("export-folder", folder);
  const gboolean measured = sb_session_measured(session) != NULL;
  SbExportRequest request = {
      .path = path,
      .measured = measured ? sb_data_copy(sb_document_data(document, 0)) : NULL,
      .drive_speed = sb_session_drive_speed(session),
      .file = g_strdup(sb_document_path(document)),
      .document = sb_session_is_modified(session) ? sb_document_to_text(document, NULL) : NULL,
  };
  g_free(review->written);
  review->written = g_strdup(path);
  review->job = sb_export_job_start(handle, &request, on_written, review);
  refresh_review(review);
  sb_toast_show(review->window, _("Writing the report…"), _("Cancel"), "win.cancel-report", TRUE);
}

static void on_review_name(GtkDialog *dialog, int response, Review *review) {
  char *chosen = response == GTK_RESPONSE_ACCEPT
                     ? gtk_file_chooser_get_filename(GTK_FILE_CHOOSER(dialog))
                     : NULL;
  gtk_widget_destroy(GTK_WIDGET(dialog));
  if (chosen != NULL && !g_str_has_suffix(chosen, ".pdf")) {
    char *whole = g_strconcat(chosen, ".pdf", NULL);
    g_free(chosen);
    chosen = whole;
  }
  if (chosen != NULL) {
    write_report(review, chosen);
  }
}

static void on_report(GSimpleAction *action, GVariant *parameter, gpointer data) {
  Review *review = data;
  GtkWidget *dialog = gtk_file_chooser_dialog_new(
      _("Report to"), review->window, GTK_FILE_CHOOSER_ACTION_SAVE, _("_Cancel"),
      GTK_RESPONSE_CANCEL, _("_Save"), GTK_RESPONSE_ACCEPT, NULL);
  GtkFileChooser *chooser = GTK_FILE_CHOOSER(dialog);
  gtk_window_set_modal(GTK_WINDOW(dialog), TRUE);
  gtk_window_set_destroy_with_parent(GTK_WINDOW(dialog), TRUE);
  gtk_dialog_set_default_response(GTK_DIALOG(dialog), GTK_RESPONSE_ACCEPT);
  gtk_file_chooser_set_do_overwrite_confirmation(chooser, TRUE);
  const char *path = sb_document_path(sb_session_document(review->session));
  g_autofree char *stem = path != NULL ? g_path_get_basename(path) : g_strdup("sealbench");
  char *dot = strrchr(stem, '.');
  if (dot != NULL && dot != stem) {
    *dot = '\0';
  }
  g_autofree char *name = g_strconcat(stem, ".pdf", NULL);
  g_autofree char *folder = sb_preferences_string("export-folder", g_get_home_dir());
  gtk_file_chooser_set_current_folder(chooser, folder);
  gtk_file_chooser_set_current_name(chooser, name);
  g_signal_connect(dialog, "response", G_CALLBACK(on_review_name), review);
  gtk_window_present(GTK_WINDOW(dialog));
}

static void on_cancel_report(GSimpleAction *action, GVariant *parameter, gpointer data) {
  Review *review = data;
  if (review->job != NULL) {
    sb_worker_cancel(review->job);
  }
}

static void on_show_report(GSimpleAction *action, GVariant *parameter, gpointer data) {
  Review *review = data;
  g_autoptr(GError) error = NULL;
  g_autofree char *uri = g_filename_to_uri(review->written, NULL, &error);
  if (uri == NULL || !gtk_show_uri_on_window(review->window, uri, GDK_CURRENT_TIME, &error)) {
    sb_toast_show(review->window, error->message, NULL, NULL, FALSE);
  }
}

// Bookmarks --------------------------------------------------------------------------------------

// One at the playhead, named by what stands there; one of that name moves.
static void on_bookmark(GSimpleAction *action, GVariant *parameter, gpointer data) {
  Review *review = data;
  const SbFrame *frame = sb_session_frame(review->session);
  if (frame == NULL) {
    return;
  }
  g_autoptr(GError) error = NULL;
  g_autofree char *name = g_strdup_printf("%s %.2f mm", sb_stage_name((SbStage)frame->stage),
                                          1e3 * frame->displacement);
  const gboolean good = sb_session_put_bookmark(review->session, name, &error);
  g_autofree char *text = good ? g_strdup_printf(_("Bookmark at %s"), name)
                               : g_strdup_printf(_("No bookmark: it %s"), error->message);
  sb_toast_show(review->window, text, NULL, NULL, FALSE);
}

static void on_clear_bookmarks(GSimpleAction *action, GVariant *parameter, gpointer data) {
  Review *review = data;
  const SbDocument *document = sb_session_document(review->session);
  while (sb_document_remark_count(document, SB_REMARK_BOOKMARK) > 0) {
    g_autofree char *name = g_strdup(sb_document_remark_name(document, SB_REMARK_BOOKMARK, 0));
    sb_session_put_remark(review->session, SB_REMARK_BOOKMARK, name, NULL, NULL);
  }
}

// Full screen ------------------------------------------------------------------------------------

static void on_full_screen(GSimpleAction *action, GVariant *state, gpointer data) {
  Review *review = data;
  if (g_variant_get_boolean(state)) {
    gtk_window_fullscreen(review->window);
  } else {
    gtk_window_unfullscreen(review->window);
  }
}

// The desktop may refuse it, or do it by itself: the action says what is.
static gboolean on_window_state(GtkWidget *widget, GdkEventWindowState *event, Review *review) {
  if ((event->changed_mask & GDK_WINDOW_STATE_FULLSCREEN) != 0) {
    GAction *action = g_action_map_lookup_action(G_ACTION_MAP(review->window), "full-screen");
    const gboolean full = (event->new_window_state & GDK_WINDOW_STATE_FULLSCREEN) != 0;
    g_simple_action_set_state(G_SIMPLE_ACTION(action), g_variant_new_boolean(full));
  }
  return GDK_EVENT_PROPAGATE;
}

static void on_present(GSimpleAction *action, GVariant *parameter, gpointer data) {
  Review *review = data;
  sb_presentation_open(review->window, review->session);
}

// Life -------------------------------------------------------------------------------------------

static void review_free(gpointer data) {
  Review *review = data;
  g_free(review->written);
  g_free(review);
}

static void on_review_destroy(GtkWidget *widget, Review *review) {
  g_signal_handlers_disconnect_by_data(review->session, review);
  g_clear_pointer(&review->job, sb_export_job_free);
}

void sb_review_attach(GtkApplicationWindow *window, SbSession *session) {
  Review *review = g_new0(Review, 1);
  review->window = GTK_WINDOW(window);
  review->session = session;
  g_object_set_data_full(G_OBJECT(window), "review", review, review_free);
  static const GActionEntry entries[] = {
      {.name = "report", .activate = on_report},
      {.name = "cancel-report", .activate = on_cancel_report},
      {.name = "show-report", .activate = on_show_report},
      {.name = "bookmark", .activate = on_bookmark},
      {.name = "clear-bookmarks", .activate = on_clear_bookmarks},
      {.name = "present", .activate = on_present},
      {.name = "full-screen", .state = "false", .change_state = on_full_screen},
  };
  g_action_map_add_action_entries(G_ACTION_MAP(window), entries, G_N_ELEMENTS(entries), review);
  g_signal_connect(window, "window-state-event", G_CALLBACK(on_window_state), review);
  g_signal_connect(window, "destroy", G_CALLBACK(on_review_destroy), review);
  g_signal_connect_swapped(session, "params-changed", G_CALLBACK(refresh_review), review);
  g_signal_connect_swapped(session, "run-changed", G_CALLBACK(refresh_review), review);
  refresh_review(review);
}
