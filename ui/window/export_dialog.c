// The export dialog. While an export runs the form is locked and the dialog's first button cancels
// it; afterwards a sentence says what became of it. Closing the dialog cancels too. The file's
// ending follows the format, and an existing file is replaced only after a question.
#include "ui/window/export_dialog.h"

#include "app/base/translation.h"
#include "app/export/formats.h"
#include "ui/views/style.h"
#include "ui/window/export_dialog_private.h"
#include "ui/window/preferences.h"

#include <glib/gi18n.h>
#include <string.h>

// The chosen row of the table of formats; NULL: a sequence, which the table does not have, or none.
static const SbExportFormat *format_of(SbExportDialog *dialog) {
  const char *ending = gtk_combo_box_get_active_id(GTK_COMBO_BOX(dialog->format));
  return ending != NULL ? sb_export_format(ending) : NULL;
}

const SbRenderView *sb_export_dialog_view(SbExportDialog *dialog) {
  return sb_render_view(gtk_combo_box_get_active_id(GTK_COMBO_BOX(dialog->view)));
}

gboolean sb_export_dialog_is_sequence(SbExportDialog *dialog) {
  const char *id = gtk_combo_box_get_active_id(GTK_COMBO_BOX(dialog->format));
  return g_strcmp0(id, "sequence") == 0;
}

static gboolean is_film(SbExportDialog *dialog) {
  const SbExportFormat *format = format_of(dialog);
  return sb_export_dialog_is_sequence(dialog) || (format != NULL && format->kind == SB_FORMAT_FILM);
}

gboolean sb_export_dialog_by_speed(SbExportDialog *dialog) {
  return g_strcmp0(gtk_combo_box_get_active_id(GTK_COMBO_BOX(dialog->pace)), "speed") == 0;
}

gboolean sb_export_dialog_has_fields(SbExportDialog *dialog) {
  const SbRun *run = sb_session_run(dialog->session);
  return run != NULL && sb_run_plan(run)->section_fields;
}

// The form ----------------------------------------------------------------------------------------

void sb_export_dialog_follow_format(SbExportDialog *dialog) {
  if (format_of(dialog) == NULL && !sb_export_dialog_is_sequence(dialog)) {
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
  g_autofree char *path = g_strdup_printf(
      "%.*s%s%s", (int)stem, text, sb_export_dialog_is_sequence(dialog) ? number : "",
      sb_export_dialog_is_sequence(dialog) ? ".png" : format_of(dialog)->ending);
  if (strcmp(path, text) != 0) {
    gtk_entry_set_text(GTK_ENTRY(dialog->path), path);
  }
}

static void on_size(GtkComboBox *combo, SbExportDialog *dialog) {
  int active = gtk_combo_box_get_active(combo);
  const SbRenderView *view = sb_export_dialog_view(dialog);
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

static void on_number(GtkSpinButton *spin, SbExportDialog *dialog) {
  if (!dialog->sizing) {
    size_t count = 0;
    sb_render_sizes(&count);
    gtk_combo_box_set_active(GTK_COMBO_BOX(dialog->size), (int)count + 1);
  }
}

// Shows the rows that view and format need.
static void show_rows(SbExportDialog *dialog) {
  gboolean film = is_film(dialog);
  const SbRenderView *view = sb_export_dialog_view(dialog);
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
      {dialog->field_box, section && sb_export_dialog_has_fields(dialog)},
      {dialog->field_label, section && sb_export_dialog_has_fields(dialog)},
      {dialog->duration, !sb_export_dialog_by_speed(dialog)},
      {dialog->duration_unit, !sb_export_dialog_by_speed(dialog)},
      {dialog->speed, sb_export_dialog_by_speed(dialog)},
      {dialog->speed_unit, sb_export_dialog_by_speed(dialog)},
  };
  for (guint i = 0; i < G_N_ELEMENTS(rows); i++) {
    gtk_widget_set_visible(rows[i].widget, rows[i].shown);
  }
}

static void on_view(GtkComboBox *combo, SbExportDialog *dialog) {
  on_size(GTK_COMBO_BOX(dialog->size), dialog);
  show_rows(dialog);
}

static void on_format(GtkComboBox *combo, SbExportDialog *dialog) {
  show_rows(dialog);
  sb_export_dialog_follow_format(dialog);
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

static void on_pace(GtkComboBox *combo, SbExportDialog *dialog) {
  show_rows(dialog);
}

static void choose(gpointer data) {
  SbExportDialog *dialog = data;
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
    sb_export_dialog_follow_format(dialog);
  }
  g_object_unref(chooser);
}

void sb_export_dialog_later(SbExportDialog *dialog, void (*call)(gpointer data)) {
  sb_later_ensure(&dialog->later, dialog->dialog, 0, call, dialog);
}

static void on_choose(GtkButton *button, SbExportDialog *dialog) {
  sb_export_dialog_later(dialog, choose);
}

static void on_export_destroy(GtkWidget *widget, SbExportDialog *dialog) {
  g_clear_pointer(&dialog->job, sb_export_job_free);
  g_object_unref(dialog->session);
  g_free(dialog);
}

// Opening -----------------------------------------------------------------------------------------

// All formats of the table, before the sequence of pictures that the form has.
static void fill_formats(SbExportDialog *dialog) {
  size_t count;
  const SbExportFormat *format = sb_export_formats(&count);
  for (size_t i = 0; i < count; i++) {
    gtk_combo_box_text_insert(GTK_COMBO_BOX_TEXT(dialog->format), (int)i, format[i].ending,
                              sb_translation(format[i].label));
  }
  gtk_combo_box_set_active(GTK_COMBO_BOX(dialog->format), 0);
}

// The section as the scene wants it.
static void fill_section(SbExportDialog *dialog) {
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

static void fill(SbExportDialog *dialog) {
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

static void connect_parts(SbExportDialog *dialog) {
  g_signal_connect(dialog->dialog, "response", G_CALLBACK(sb_export_dialog_on_response), dialog);
  g_signal_connect(dialog->dialog, "destroy", G_CALLBACK(on_export_destroy), dialog);
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
  SbExportDialog *dialog = g_new0(SbExportDialog, 1);
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
