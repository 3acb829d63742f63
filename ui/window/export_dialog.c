// The export dialog. While an export runs the form is locked and the dialog's first button cancels
// it; afterwards a sentence says what became of it. Closing the dialog cancels too. The file's
// ending follows the format, and an existing file is replaced only after a question.
#include "ui/window/export_dialog.h"

#include "app/base/translation.h"
#include "app/export/export_job.h"
#include "app/export/formats.h"
#include "app/export/render.h"
#include "app/session/worker.h"
#include "ui/views/later.h"
#include "ui/views/style.h"
#include "ui/window/preferences.h"

#include <glib/gi18n.h>
#include <string.h>

typedef struct {
  SbSession *session; // owned reference: the dialog may outlive its window's interest
  GtkWidget *dialog, *form, *view, *format, *size, *width, *height, *theme, *at, *at_label;
  GtkWidget *range_label, *range_box, *from, *to;
  GtkWidget *film_box, *film_label, *fps, *pace, *duration, *duration_unit, *speed, *speed_unit;
  GtkWidget *section_label, *section_box, *halves, *insets, *undeformed;
  GtkWidget *field_label, *field_box, *field, *field_max;
  GtkWidget *path, *choose, *result, *progress;
  GtkWidget *cancel, *export;
  SbExportJob *job;
  SbLater poll;
  SbLater later;   // what the user requested
  gboolean sizing; // the preset writes the numbers, not the user
} Dialog;

// The chosen row of the table of formats; NULL: a sequence, which the table does not have, or none.
static const SbExportFormat *format_of(Dialog *dialog) {
  const char *ending = gtk_combo_box_get_active_id(GTK_COMBO_BOX(dialog->format));
  return ending != NULL ? sb_export_format(ending) : NULL;
}

static const SbRenderView *view_of(Dialog *dialog) {
  return sb_render_view(gtk_combo_box_get_active_id(GTK_COMBO_BOX(dialog->view)));
}

static gboolean is_sequence(Dialog *dialog) {
  const char *id = gtk_combo_box_get_active_id(GTK_COMBO_BOX(dialog->format));
  return g_strcmp0(id, "sequence") == 0;
}

static gboolean is_film(Dialog *dialog) {
  const SbExportFormat *format = format_of(dialog);
  return is_sequence(dialog) || (format != NULL && format->kind == SB_FORMAT_FILM);
}

static gboolean by_speed(Dialog *dialog) {
  return g_strcmp0(gtk_combo_box_get_active_id(GTK_COMBO_BOX(dialog->pace)), "speed") == 0;
}

// The run has rings with fields to show.
static gboolean has_fields(Dialog *dialog) {
  const SbRun *run = sb_session_run(dialog->session);
  return run != NULL && sb_run_plan(run)->section_fields;
}

// The form
// -----------------------------------------------------------------------------------------

// Gives the file name the ending of the format; a sequence a number too.
static void follow_format(Dialog *dialog) {
  if (format_of(dialog) == NULL && !is_sequence(dialog)) {
    return;
  }
  const char *text = gtk_entry_get_text(GTK_ENTRY(dialog->path));
  const char *slash = strrchr(text, G_DIR_SEPARATOR);
  const char *dot = strrchr(text, '.');
  gsize stem = dot != NULL && (slash == NULL || dot > slash) ? (gsize)(dot - text) : strlen(text);
  static const char number[] = "-%04d";
  gsize tail = strlen(number);
  if (stem > tail && strncmp(text + stem - tail, number, tail) == 0) {
    stem -= tail;
  }
  g_autofree char *path =
      g_strdup_printf("%.*s%s%s", (int)stem, text, is_sequence(dialog) ? number : "",
                      is_sequence(dialog) ? ".png" : format_of(dialog)->ending);
  if (strcmp(path, text) != 0) {
    gtk_entry_set_text(GTK_ENTRY(dialog->path), path);
  }
}

static void on_size(GtkComboBox *combo, Dialog *dialog) {
  int active = gtk_combo_box_get_active(combo);
  const SbRenderView *view = view_of(dialog);
  size_t count = 0;
  const SbRenderSize *sizes = sb_render_sizes(&count);
  if (active < 0 || view == NULL || active > (int)count) {
    return;
  }
  dialog->sizing = TRUE;
  gtk_spin_button_set_value(GTK_SPIN_BUTTON(dialog->width),
                            active == 0 ? view->width : sizes[active - 1].width);
  gtk_spin_button_set_value(GTK_SPIN_BUTTON(dialog->height),
                            active == 0 ? view->height : sizes[active - 1].height);
  dialog->sizing = FALSE;
}

static void on_number(GtkSpinButton *spin, Dialog *dialog) {
  if (!dialog->sizing) {
    size_t count = 0;
    sb_render_sizes(&count);
    gtk_combo_box_set_active(GTK_COMBO_BOX(dialog->size), (int)count + 1);
  }
}

// Shows the rows that view and format need.
static void show_rows(Dialog *dialog) {
  gboolean film = is_film(dialog);
  const SbRenderView *view = view_of(dialog);
  gboolean section = view != NULL && view->section;
  gboolean cutaway = view != NULL && view->cutaway;
  const struct {
    GtkWidget *widget;
    gboolean shown;
  } rows[] = {
      {dialog->film_box, film},
      {dialog->film_label, film},
      {dialog->range_box, film},
      {dialog->range_label, film},
      {dialog->at, !film},
      {dialog->at_label, !film},
      {dialog->section_box, section},
      {dialog->halves, !cutaway},
      {dialog->insets, !cutaway},
      {dialog->section_label, section},
      {dialog->field_box, section && has_fields(dialog)},
      {dialog->field_label, section && has_fields(dialog)},
      {dialog->duration, !by_speed(dialog)},
      {dialog->duration_unit, !by_speed(dialog)},
      {dialog->speed, by_speed(dialog)},
      {dialog->speed_unit, by_speed(dialog)},
  };
  for (guint i = 0; i < G_N_ELEMENTS(rows); i++) {
    gtk_widget_set_visible(rows[i].widget, rows[i].shown);
  }
}

static void on_view(GtkComboBox *combo, Dialog *dialog) {
  on_size(GTK_COMBO_BOX(dialog->size), dialog);
  show_rows(dialog);
}

static void on_format(GtkComboBox *combo, Dialog *dialog) {
  show_rows(dialog);
  follow_format(dialog);
}

// Zero is a word: the range of the run.
static gboolean on_range_output(GtkSpinButton *spin, gpointer data) {
  if (gtk_spin_button_get_value(spin) > 0) {
    return FALSE;
  }
  gtk_entry_set_text(GTK_ENTRY(spin), _("auto"));
  return TRUE;
}

static int on_range_input(GtkSpinButton *spin, double *value, gpointer data) {
  if (strcmp(gtk_entry_get_text(GTK_ENTRY(spin)), _("auto")) != 0) {
    return FALSE;
  }
  *value = 0;
  return TRUE;
}

static void on_pace(GtkComboBox *combo, Dialog *dialog) {
  show_rows(dialog);
}

static void choose(gpointer data) {
  Dialog *dialog = data;
  GtkFileChooserNative *chooser =
      gtk_file_chooser_native_new(_("Export to"), GTK_WINDOW(dialog->dialog),
                                  GTK_FILE_CHOOSER_ACTION_SAVE, _("_Choose"), _("_Cancel"));
  gtk_file_chooser_set_filename(GTK_FILE_CHOOSER(chooser),
                                gtk_entry_get_text(GTK_ENTRY(dialog->path)));
  g_autofree char *name = g_path_get_basename(gtk_entry_get_text(GTK_ENTRY(dialog->path)));
  gtk_file_chooser_set_current_name(GTK_FILE_CHOOSER(chooser), name);
  if (gtk_native_dialog_run(GTK_NATIVE_DIALOG(chooser)) == GTK_RESPONSE_ACCEPT) {
    g_autofree char *path = gtk_file_chooser_get_filename(GTK_FILE_CHOOSER(chooser));
    gtk_entry_set_text(GTK_ENTRY(dialog->path), path);
    follow_format(dialog);
  }
  g_object_unref(chooser);
}

// Questions run a loop of their own, which must not start inside a call from a screen reader.
static void later(Dialog *dialog, void (*call)(gpointer data)) {
  sb_later_ensure(&dialog->later, dialog->dialog, 0, call, dialog);
}

static void on_choose(GtkButton *button, Dialog *dialog) {
  later(dialog, choose);
}

// The job
// ------------------------------------------------------------------------------------------

static void set_status(Dialog *dialog, const char *text, const char *style) {
  GtkStyleContext *context = gtk_widget_get_style_context(dialog->result);
  gtk_style_context_remove_class(context, "sb-pass");
  gtk_style_context_remove_class(context, "sb-error");
  gtk_style_context_add_class(context, style);
  gtk_label_set_text(GTK_LABEL(dialog->result), text);
}

static void set_busy(Dialog *dialog, gboolean busy) {
  gtk_widget_set_sensitive(dialog->form, !busy);
  gtk_widget_set_sensitive(dialog->export, !busy);
  gtk_widget_set_visible(dialog->progress, busy);
  gtk_button_set_label(GTK_BUTTON(dialog->cancel), busy ? _("Cancel") : _("Close"));
}

static void on_poll(gpointer data) {
  Dialog *dialog = data;
  gtk_progress_bar_set_fraction(GTK_PROGRESS_BAR(dialog->progress),
                                sb_worker_progress(dialog->job));
  double left = sb_export_job_left(dialog->job);
  g_autofree char *text = left >= 0 ? g_strdup_printf(_("%.0f s left"), left) : g_strdup("");
  gtk_progress_bar_set_text(GTK_PROGRESS_BAR(dialog->progress), text);
  gtk_progress_bar_set_show_text(GTK_PROGRESS_BAR(dialog->progress), left >= 0);
}

static void on_done(void *data) {
  Dialog *dialog = data;
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
static char *first_file(Dialog *dialog, const char *pattern) {
  g_auto(GStrv) parts = g_strsplit(pattern, "%04d", 2);
  return is_sequence(dialog) ? g_strjoinv("0001", parts) : g_strdup(pattern);
}

// The instant: a stage's letter, or the playhead's time.
static char *instant_of(Dialog *dialog) {
  const char *at = gtk_combo_box_get_active_id(GTK_COMBO_BOX(dialog->at));
  const SbFrame *frame = sb_session_frame(dialog->session);
  if (g_strcmp0(at, "now") != 0 || frame == NULL) {
    return g_strdup(at);
  }
  char number[G_ASCII_DTOSTR_BUF_SIZE];
  return g_strdup_printf("%s s", g_ascii_dtostr(number, sizeof number, frame->time));
}

// An end of the range: a stage's letter, or NULL for the run's own end.
static char *end_of_range(Dialog *dialog, GtkWidget *combo) {
  const char *id = gtk_combo_box_get_active_id(GTK_COMBO_BOX(combo));
  return id == NULL || id[0] == '\0' ? NULL : g_strdup(id);
}

static SbSectionStyle style_of(Dialog *dialog) {
  const char *insets = gtk_combo_box_get_active_id(GTK_COMBO_BOX(dialog->insets));
  const char *halves = gtk_combo_box_get_active_id(GTK_COMBO_BOX(dialog->halves));
  double azimuth, elevation; // as the window shows it
  sb_session_camera(dialog->session, &azimuth, &elevation);
  return (SbSectionStyle){
      .cutaway = g_strcmp0(halves, "cutaway") == 0 || view_of(dialog)->cutaway,
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
  Dialog *dialog = data;
  follow_format(dialog);
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
  if (has_fields(dialog) && view_of(dialog)->section &&
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
      .view = g_strdup(view_of(dialog)->name),
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
      .speed = by_speed(dialog) ? gtk_spin_button_get_value(GTK_SPIN_BUTTON(dialog->speed)) : 0,
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
  dialog->job = sb_export_job_start(handle, &request, on_done, dialog);
  sb_later_repeat(&dialog->poll, dialog->dialog, 50, on_poll, dialog);
}

static void on_response(GtkDialog *widget, int response, Dialog *dialog) {
  if (response == GTK_RESPONSE_ACCEPT && dialog->job == NULL) {
    later(dialog, start);
  } else if (response == GTK_RESPONSE_CANCEL && dialog->job != NULL) {
    sb_worker_cancel(dialog->job);
  } else if (response != GTK_RESPONSE_ACCEPT) {
    gtk_widget_destroy(dialog->dialog);
  }
}

static void on_destroy(GtkWidget *widget, Dialog *dialog) {
  g_clear_pointer(&dialog->job, sb_export_job_free);
  g_object_unref(dialog->session);
  g_free(dialog);
}

// Opening
// ------------------------------------------------------------------------------------------

// All formats of the table, before the sequence of pictures that the form has.
static void fill_formats(Dialog *dialog) {
  size_t count;
  const SbExportFormat *format = sb_export_formats(&count);
  for (size_t i = 0; i < count; i++) {
    gtk_combo_box_text_insert(GTK_COMBO_BOX_TEXT(dialog->format), (int)i, format[i].ending,
                              sb_translation(format[i].label));
  }
  gtk_combo_box_set_active(GTK_COMBO_BOX(dialog->format), 0);
}

// The section as the scene wants it.
static void fill_section(Dialog *dialog) {
  for (int i = 0; i < SB_FIELD_COUNT; i++) {
    gtk_combo_box_text_append_text(GTK_COMBO_BOX_TEXT(dialog->field),
                                   sb_translation(sb_section_field_name((SbField)i)));
  }
  const SbRun *run = sb_session_run(dialog->session);
  SbSectionStyle style = run != NULL ? sb_section_style_of(sb_run_model(run)) : (SbSectionStyle){0};
  gtk_combo_box_set_active(GTK_COMBO_BOX(dialog->field), (int)style.field);
  gtk_spin_button_set_value(GTK_SPIN_BUTTON(dialog->field_max), 1e-6 * style.field_max);
  gtk_combo_box_set_active_id(GTK_COMBO_BOX(dialog->halves), style.cutaway ? "cutaway"
                                                             : style.full  ? "full"
                                                                           : "half");
  gtk_combo_box_set_active_id(GTK_COMBO_BOX(dialog->insets), style.hide_insets ? "none"
                                                             : style.inset_seal == SB_INNER
                                                                 ? "inner"
                                                                 : "outer");
  gtk_toggle_button_set_active(GTK_TOGGLE_BUTTON(dialog->undeformed), style.undeformed);
}

static void fill(Dialog *dialog) {
  size_t count = 0;
  const SbRenderView *views = sb_render_views(&count);
  const SbRun *run = sb_session_run(dialog->session);
  for (size_t i = 0; i < count; i++) {
    if (run != NULL && !sb_render_view_fits(&views[i], run, NULL)) {
      continue;
    }
    gtk_combo_box_text_append(GTK_COMBO_BOX_TEXT(dialog->view), views[i].name,
                              sb_translation(views[i].label));
  }
  gtk_combo_box_text_append_text(GTK_COMBO_BOX_TEXT(dialog->size), _("As made"));
  const SbRenderSize *sizes = sb_render_sizes(&count);
  for (size_t i = 0; i < count; i++) {
    gtk_combo_box_text_append_text(GTK_COMBO_BOX_TEXT(dialog->size),
                                   sb_translation(sizes[i].label));
  }
  gtk_combo_box_text_append_text(GTK_COMBO_BOX_TEXT(dialog->size), _("Own size"));
  gtk_combo_box_text_append(GTK_COMBO_BOX_TEXT(dialog->at), "now", _("At the playhead"));
  gtk_combo_box_text_append(GTK_COMBO_BOX_TEXT(dialog->from), "", _("The start"));
  gtk_combo_box_text_append(GTK_COMBO_BOX_TEXT(dialog->to), "", _("the end"));
  const SbSummary *summary = sb_session_summary(dialog->session);
  for (int i = 0; i < SB_STAGE_COUNT; i++) {
    if (summary != NULL && summary->stage[i].reached) {
      const char *name = sb_stage_name((SbStage)i);
      g_autofree char *text = g_strdup_printf(_("Stage %s"), name);
      gtk_combo_box_text_append(GTK_COMBO_BOX_TEXT(dialog->at), name, text);
      gtk_combo_box_text_append(GTK_COMBO_BOX_TEXT(dialog->from), name, text);
      gtk_combo_box_text_append(GTK_COMBO_BOX_TEXT(dialog->to), name, text);
    }
  }

  g_autofree char *folder = sb_preferences_string("export-folder", g_get_home_dir());
  const char *file = sb_document_path(sb_session_document(dialog->session));
  g_autofree char *stem = file != NULL ? g_path_get_basename(file) : g_strdup("sealbench");
  char *dot = strrchr(stem, '.');
  if (dot != NULL && dot != stem) {
    *dot = '\0';
  }
  g_autofree char *name = g_strconcat(stem, ".png", NULL);
  g_autofree char *path = g_build_filename(folder, name, NULL);
  gtk_entry_set_text(GTK_ENTRY(dialog->path), path);
  gtk_combo_box_set_active_id(GTK_COMBO_BOX(dialog->view), "dashboard");
  gtk_combo_box_set_active(GTK_COMBO_BOX(dialog->size), 0);
  gtk_combo_box_set_active_id(GTK_COMBO_BOX(dialog->at), "now");
  gtk_combo_box_set_active(GTK_COMBO_BOX(dialog->from), 0);
  gtk_combo_box_set_active(GTK_COMBO_BOX(dialog->to), 0);
  gtk_combo_box_set_active(GTK_COMBO_BOX(dialog->pace), 0);
  fill_section(dialog);
  gtk_combo_box_set_active_id(GTK_COMBO_BOX(dialog->theme), sb_style_is_dark() ? "dark" : "light");
  fill_formats(dialog);
}

static void connect_parts(Dialog *dialog) {
  g_signal_connect(dialog->dialog, "response", G_CALLBACK(on_response), dialog);
  g_signal_connect(dialog->dialog, "destroy", G_CALLBACK(on_destroy), dialog);
  g_signal_connect(dialog->size, "changed", G_CALLBACK(on_size), dialog);
  g_signal_connect(dialog->view, "changed", G_CALLBACK(on_view), dialog);
  g_signal_connect(dialog->format, "changed", G_CALLBACK(on_format), dialog);
  g_signal_connect(dialog->field_max, "output", G_CALLBACK(on_range_output), NULL);
  g_signal_connect(dialog->field_max, "input", G_CALLBACK(on_range_input), NULL);
  g_signal_connect(dialog->pace, "changed", G_CALLBACK(on_pace), dialog);
  g_signal_connect(dialog->width, "value-changed", G_CALLBACK(on_number), dialog);
  g_signal_connect(dialog->height, "value-changed", G_CALLBACK(on_number), dialog);
  g_signal_connect(dialog->choose, "clicked", G_CALLBACK(on_choose), dialog);
}

void sb_export_dialog_open(GtkWindow *parent, SbSession *session) {
  Dialog *dialog = g_new0(Dialog, 1);
  dialog->session = g_object_ref(session);
  g_autoptr(GtkBuilder) builder = gtk_builder_new_from_resource("/org/sealbench/ui/export.ui");
  const struct {
    const char *id;
    GtkWidget **widget;
  } parts[] = {
      {"dialog", &dialog->dialog},
      {"form", &dialog->form},
      {"view", &dialog->view},
      {"format", &dialog->format},
      {"size", &dialog->size},
      {"width", &dialog->width},
      {"height", &dialog->height},
      {"theme", &dialog->theme},
      {"at", &dialog->at},
      {"at_label", &dialog->at_label},
      {"film_box", &dialog->film_box},
      {"film_label", &dialog->film_label},
      {"range_label", &dialog->range_label},
      {"range_box", &dialog->range_box},
      {"from", &dialog->from},
      {"to", &dialog->to},
      {"fps", &dialog->fps},
      {"pace", &dialog->pace},
      {"duration", &dialog->duration},
      {"duration_unit", &dialog->duration_unit},
      {"speed", &dialog->speed},
      {"speed_unit", &dialog->speed_unit},
      {"section_label", &dialog->section_label},
      {"section_box", &dialog->section_box},
      {"halves", &dialog->halves},
      {"insets", &dialog->insets},
      {"undeformed", &dialog->undeformed},
      {"field_label", &dialog->field_label},
      {"field_box", &dialog->field_box},
      {"field", &dialog->field},
      {"field_max", &dialog->field_max},
      {"path", &dialog->path},
      {"choose", &dialog->choose},
      {"result", &dialog->result},
      {"progress", &dialog->progress},
      {"cancel", &dialog->cancel},
      {"export", &dialog->export},
  };
  for (guint i = 0; i < G_N_ELEMENTS(parts); i++) {
    *parts[i].widget = GTK_WIDGET(gtk_builder_get_object(builder, parts[i].id));
  }
  gtk_window_set_transient_for(GTK_WINDOW(dialog->dialog), parent);
  gtk_window_set_destroy_with_parent(GTK_WINDOW(dialog->dialog), TRUE);
  connect_parts(dialog);
  fill(dialog);
  gtk_window_present(GTK_WINDOW(dialog->dialog));
}
