// The export that the dialog starts: its request from the form, its progress and its end.
#include "ui/window/export_dialog_private.h"

#include "app/session/worker.h"
#include "ui/window/preferences.h"

#include <glib/gi18n.h>

static void set_status(SbExportDialog *dialog, const char *text, const char *style) {
  GtkStyleContext *context = gtk_widget_get_style_context(dialog->result);
  gtk_style_context_remove_class(context, "sb-pass");
  gtk_style_context_remove_class(context, "sb-error");
  gtk_style_context_add_class(context, style);
  gtk_label_set_text(GTK_LABEL(dialog->result), text);
}

static void set_busy(SbExportDialog *dialog, gboolean busy) {
  gtk_widget_set_sensitive(dialog->form, !busy);
  gtk_widget_set_sensitive(dialog->export, !busy);
  gtk_widget_set_visible(dialog->progress, busy);
  gtk_button_set_label(GTK_BUTTON(dialog->cancel), busy ? _("Cancel") : _("Close"));
}

static void on_export_job_poll(gpointer data) {
  SbExportDialog *dialog = data;
  gtk_progress_bar_set_fraction(GTK_PROGRESS_BAR(dialog->progress),
                                sb_worker_progress(dialog->job));
  double left = sb_export_job_left(dialog->job);
  g_autofree char *text = left >= 0 ? g_strdup_printf(_("%.0f s left"), left) : g_strdup("");
  gtk_progress_bar_set_text(GTK_PROGRESS_BAR(dialog->progress), text);
  gtk_progress_bar_set_show_text(GTK_PROGRESS_BAR(dialog->progress), left >= 0);
}

static void on_export_job_done(void *data) {
  SbExportDialog *dialog = data;
  gboolean good = FALSE;
  sb_later_cancel(&dialog->poll);
  set_status(dialog, sb_export_job_result(dialog->job, &good), good ? "sb-pass" : "sb-error");
  if (!good) {
    gtk_style_context_remove_class(gtk_widget_get_style_context(dialog->result), "sb-pass");
  }
  g_clear_pointer(&dialog->job, sb_export_job_free);
  set_busy(dialog, FALSE);
}

gboolean sb_export_may_replace(GtkWindow *parent, const char *path) {
  if (!g_file_test(path, G_FILE_TEST_EXISTS)) {
    return TRUE;
  }
  g_autofree char *name = g_filename_display_basename(path);
  GtkWidget *question =
      gtk_message_dialog_new(parent, GTK_DIALOG_MODAL | GTK_DIALOG_DESTROY_WITH_PARENT,
                             GTK_MESSAGE_QUESTION, GTK_BUTTONS_NONE, _("Replace “%s”?"), name);
  gtk_dialog_add_buttons(GTK_DIALOG(question), _("_Keep"), GTK_RESPONSE_CANCEL, _("_Replace"),
                         GTK_RESPONSE_ACCEPT, NULL);
  int answer = gtk_dialog_run(GTK_DIALOG(question));
  gtk_widget_destroy(question);
  return answer == GTK_RESPONSE_ACCEPT;
}

// The file to ask about; of a sequence its first picture.
static char *first_file(SbExportDialog *dialog, const char *pattern) {
  g_auto(GStrv) parts = g_strsplit(pattern, "%04d", 2);
  return sb_export_dialog_is_sequence(dialog) ? g_strjoinv("0001", parts) : g_strdup(pattern);
}

// The instant: a stage's letter, or the playhead's time.
static char *instant_of(SbExportDialog *dialog) {
  const char *at = gtk_combo_box_get_active_id(GTK_COMBO_BOX(dialog->at));
  const SbFrame *frame = sb_session_frame(dialog->session);
  if (g_strcmp0(at, "now") != 0 || frame == NULL) {
    return g_strdup(at);
  }
  char number[G_ASCII_DTOSTR_BUF_SIZE];
  return g_strdup_printf("%s s", g_ascii_dtostr(number, sizeof number, frame->time));
}

// An end of the range: a stage's letter, or NULL for the run's own end.
static char *end_of_range(SbExportDialog *dialog, GtkWidget *combo) {
  const char *id = gtk_combo_box_get_active_id(GTK_COMBO_BOX(combo));
  return id == NULL || id[0] == '\0' ? NULL : g_strdup(id);
}

static SbSectionStyle style_of(SbExportDialog *dialog) {
  const char *insets = gtk_combo_box_get_active_id(GTK_COMBO_BOX(dialog->insets));
  const char *halves = gtk_combo_box_get_active_id(GTK_COMBO_BOX(dialog->halves));
  double azimuth, elevation; // as the window shows it
  sb_session_camera(dialog->session, &azimuth, &elevation);
  return (SbSectionStyle){
      .cutaway = g_strcmp0(halves, "cutaway") == 0 || sb_export_dialog_view(dialog)->cutaway,
      .azimuth = azimuth,
      .elevation = elevation,
      .inset_seal = g_strcmp0(insets, "inner") == 0 ? SB_INNER : SB_OUTER,
      .hide_insets = g_strcmp0(insets, "none") == 0,
      .full = g_strcmp0(halves, "full") == 0,
      .undeformed = gtk_toggle_button_get_active(GTK_TOGGLE_BUTTON(dialog->undeformed)),
      .field = (SbField)MAX(gtk_combo_box_get_active(GTK_COMBO_BOX(dialog->field)), 0),
      .field_max = 1e6 * gtk_spin_button_get_value(GTK_SPIN_BUTTON(dialog->field_max))};
}

static void start(gpointer data) {
  SbExportDialog *dialog = data;
  sb_export_dialog_follow_format(dialog);
  const char *path = gtk_entry_get_text(GTK_ENTRY(dialog->path));
  SbRunHandle *handle = sb_session_handle(dialog->session);
  if (handle == NULL) {
    set_status(dialog, _("The run has not ended yet."), "sb-error");
    return;
  }
  g_autofree char *first = first_file(dialog, path);
  if (!g_path_is_absolute(path) || !sb_export_may_replace(GTK_WINDOW(dialog->dialog), first)) {
    sb_run_handle_unref(handle);
    if (!g_path_is_absolute(path)) {
      set_status(dialog, _("The file needs its folder: an absolute path."), "sb-error");
    }
    return;
  }
  const SbRun *run = sb_run_handle_run(handle);
  if (sb_export_dialog_has_fields(dialog) && sb_export_dialog_view(dialog)->section &&
      gtk_combo_box_get_active(GTK_COMBO_BOX(dialog->field)) == SB_FIELD_PERMEATION &&
      !sb_run_plan(run)->permeation) {
    sb_run_handle_unref(handle);
    set_status(dialog, _("This run has no permeation: set Field (output.field) to permeation."),
               "sb-error");
    return;
  }
  g_autofree char *folder = g_path_get_dirname(path);
  sb_preferences_set_string("export-folder", folder);
  const SbDocument *document = sb_session_document(dialog->session);
  SbExportRequest request = {
      .path = g_strdup(path),
      .view = g_strdup(sb_export_dialog_view(dialog)->name),
      .width = gtk_spin_button_get_value(GTK_SPIN_BUTTON(dialog->width)),
      .height = gtk_spin_button_get_value(GTK_SPIN_BUTTON(dialog->height)),
      .dark = g_strcmp0(gtk_combo_box_get_active_id(GTK_COMBO_BOX(dialog->theme)), "dark") == 0,
      .style = style_of(dialog),
      .measured = sb_session_measured(dialog->session) != NULL
                      ? sb_data_copy(sb_document_data(sb_session_document(dialog->session), 0))
                      : NULL,
      .drive_speed = sb_session_drive_speed(dialog->session),
      .at = instant_of(dialog),
      .from = end_of_range(dialog, dialog->from),
      .to = end_of_range(dialog, dialog->to),
      .speed = sb_export_dialog_by_speed(dialog)
                   ? gtk_spin_button_get_value(GTK_SPIN_BUTTON(dialog->speed))
                   : 0,
      .fps = gtk_spin_button_get_value_as_int(GTK_SPIN_BUTTON(dialog->fps)),
      .duration = gtk_spin_button_get_value(GTK_SPIN_BUTTON(dialog->duration)),
      .title = g_strdup(sb_document_title(document)),
      .hash = sb_document_sha256(document),
      .scene = sb_document_to_flat_text(document),
      .stale = sb_session_stale_text(dialog->session),
  };
  sb_export_request_add_compared(&request, dialog->session);
  set_status(dialog, _("Exporting…"), "sb-pass");
  gtk_style_context_remove_class(gtk_widget_get_style_context(dialog->result), "sb-pass");
  set_busy(dialog, TRUE);
  dialog->job = sb_export_job_start(handle, &request, on_export_job_done, dialog);
  sb_later_repeat(&dialog->poll, dialog->dialog, 50, on_export_job_poll, dialog);
}

void sb_export_dialog_on_response(GtkDialog *widget, int response, SbExportDialog *dialog) {
  if (response == GTK_RESPONSE_ACCEPT && dialog->job == NULL) {
    sb_export_dialog_later(dialog, start);
  } else if (response == GTK_RESPONSE_CANCEL && dialog->job != NULL) {
    sb_worker_cancel(dialog->job);
  } else if (response != GTK_RESPONSE_ACCEPT) {
    gtk_widget_destroy(dialog->dialog);
  }
}
