// The export dialog. While an export runs the form is locked and the dialog's first button cancels
// it; afterwards a sentence says what became of it. Closing the dialog cancels too. The file's
// ending follows the format, and an existing file is replaced only after a question.
#include "ui/export_dialog.h"

#include "app/export/render.h"
#include "ui/export_job.h"
#include "ui/preferences.h"
#include "ui/style.h"

#include <string.h>

typedef struct {
  SbSession *session; // owned reference: the dialog may outlive its window's interest
  GtkWidget *dialog, *form, *view, *format, *size, *width, *height, *theme, *at, *at_label;
  GtkWidget *film_box, *film_label, *fps, *duration, *path, *choose, *result, *progress;
  GtkWidget *cancel, *export;
  SbExportJob *job;
  guint poll;
  guint later;     // source of what the user asked for, 0 if none is due
  gboolean sizing; // the preset writes the numbers, not the user
} Dialog;

// Presets beside the view's own size.
static const struct {
  const char *name;
  int width, height;
} presets[] = {{"1280 × 720", 1280, 720},
               {"1920 × 1080", 1920, 1080},
               {"3840 × 2160", 3840, 2160},
               {"1600 × 1200", 1600, 1200}};

static const char *format_of(Dialog *dialog) {
  return gtk_combo_box_get_active_id(GTK_COMBO_BOX(dialog->format));
}

static const SbRenderView *view_of(Dialog *dialog) {
  return sb_render_view(gtk_combo_box_get_active_id(GTK_COMBO_BOX(dialog->view)));
}

static gboolean is_film(Dialog *dialog) {
  return g_strcmp0(format_of(dialog), "mp4") == 0;
}

// The form
// -----------------------------------------------------------------------------------------

// Gives the file name the ending of the format.
static void follow_format(Dialog *dialog) {
  const char *text = gtk_entry_get_text(GTK_ENTRY(dialog->path));
  const char *slash = strrchr(text, G_DIR_SEPARATOR);
  const char *dot = strrchr(text, '.');
  gsize stem = dot != NULL && (slash == NULL || dot > slash) ? (gsize)(dot - text) : strlen(text);
  g_autofree char *path = g_strdup_printf("%.*s.%s", (int)stem, text, format_of(dialog));
  if (strcmp(path, text) != 0) {
    gtk_entry_set_text(GTK_ENTRY(dialog->path), path);
  }
}

static void on_size(GtkComboBox *combo, Dialog *dialog) {
  int active = gtk_combo_box_get_active(combo);
  const SbRenderView *view = view_of(dialog);
  if (active < 0 || view == NULL || active > (int)G_N_ELEMENTS(presets)) {
    return;
  }
  dialog->sizing = TRUE;
  gtk_spin_button_set_value(GTK_SPIN_BUTTON(dialog->width),
                            active == 0 ? view->width : presets[active - 1].width);
  gtk_spin_button_set_value(GTK_SPIN_BUTTON(dialog->height),
                            active == 0 ? view->height : presets[active - 1].height);
  dialog->sizing = FALSE;
}

static void on_number(GtkSpinButton *spin, Dialog *dialog) {
  if (!dialog->sizing) {
    gtk_combo_box_set_active(GTK_COMBO_BOX(dialog->size), (int)G_N_ELEMENTS(presets) + 1);
  }
}

static void on_view(GtkComboBox *combo, Dialog *dialog) {
  on_size(GTK_COMBO_BOX(dialog->size), dialog);
}

static void on_format(GtkComboBox *combo, Dialog *dialog) {
  gboolean film = is_film(dialog);
  gtk_widget_set_visible(dialog->film_box, film);
  gtk_widget_set_visible(dialog->film_label, film);
  gtk_widget_set_visible(dialog->at, !film);
  gtk_widget_set_visible(dialog->at_label, !film);
  follow_format(dialog);
}

static gboolean choose(gpointer data) {
  Dialog *dialog = data;
  dialog->later = 0;
  GtkFileChooserNative *chooser = gtk_file_chooser_native_new(
      "Export to", GTK_WINDOW(dialog->dialog), GTK_FILE_CHOOSER_ACTION_SAVE, "_Choose", "_Cancel");
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
  return G_SOURCE_REMOVE;
}

// Questions run a loop of their own, which must not start inside a call from a screen reader.
static void later(Dialog *dialog, GSourceFunc function) {
  if (dialog->later == 0) {
    dialog->later = g_idle_add(function, dialog);
  }
}

static void on_choose(GtkButton *button, Dialog *dialog) {
  later(dialog, choose);
}

// The job
// ------------------------------------------------------------------------------------------

static void say(Dialog *dialog, const char *text, const char *style) {
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
  gtk_button_set_label(GTK_BUTTON(dialog->cancel), busy ? "Cancel" : "Close");
}

static gboolean on_poll(gpointer data) {
  Dialog *dialog = data;
  gtk_progress_bar_set_fraction(GTK_PROGRESS_BAR(dialog->progress),
                                sb_export_job_progress(dialog->job));
  return G_SOURCE_CONTINUE;
}

static void stop_polling(Dialog *dialog) {
  if (dialog->poll != 0) {
    g_source_remove(dialog->poll);
    dialog->poll = 0;
  }
}

static void on_done(void *data) {
  Dialog *dialog = data;
  gboolean good = FALSE;
  stop_polling(dialog);
  say(dialog, sb_export_job_result(dialog->job, &good), good ? "sb-pass" : "sb-error");
  if (!good) {
    gtk_style_context_remove_class(gtk_widget_get_style_context(dialog->result), "sb-pass");
  }
  g_clear_pointer(&dialog->job, sb_export_job_free);
  set_busy(dialog, FALSE);
}

// Asks before a file is replaced.
static gboolean may_replace(Dialog *dialog, const char *path) {
  if (!g_file_test(path, G_FILE_TEST_EXISTS)) {
    return TRUE;
  }
  g_autofree char *name = g_filename_display_basename(path);
  GtkWidget *question = gtk_message_dialog_new(
      GTK_WINDOW(dialog->dialog), GTK_DIALOG_MODAL | GTK_DIALOG_DESTROY_WITH_PARENT,
      GTK_MESSAGE_QUESTION, GTK_BUTTONS_NONE, "Replace “%s”?", name);
  gtk_dialog_add_buttons(GTK_DIALOG(question), "_Keep", GTK_RESPONSE_CANCEL, "_Replace",
                         GTK_RESPONSE_ACCEPT, NULL);
  int answer = gtk_dialog_run(GTK_DIALOG(question));
  gtk_widget_destroy(question);
  return answer == GTK_RESPONSE_ACCEPT;
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

static gboolean start(gpointer data) {
  Dialog *dialog = data;
  dialog->later = 0;
  follow_format(dialog);
  const char *path = gtk_entry_get_text(GTK_ENTRY(dialog->path));
  SbRunHandle *handle = sb_session_handle(dialog->session);
  if (handle == NULL) {
    say(dialog, "The run has not ended yet.", "sb-error");
    return G_SOURCE_REMOVE;
  }
  if (!g_path_is_absolute(path) || !may_replace(dialog, path)) {
    sb_run_handle_unref(handle);
    if (!g_path_is_absolute(path)) {
      say(dialog, "The file needs its folder: an absolute path.", "sb-error");
    }
    return G_SOURCE_REMOVE;
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
      .at = instant_of(dialog),
      .fps = gtk_spin_button_get_value_as_int(GTK_SPIN_BUTTON(dialog->fps)),
      .duration = gtk_spin_button_get_value(GTK_SPIN_BUTTON(dialog->duration)),
      .title = g_strdup(sb_document_title(document)),
      .hash = sb_document_sha256(document),
      .scene = sb_document_to_flat_text(document),
  };
  say(dialog, "Exporting…", "sb-pass");
  gtk_style_context_remove_class(gtk_widget_get_style_context(dialog->result), "sb-pass");
  set_busy(dialog, TRUE);
  dialog->job = sb_export_job_start(handle, &request, on_done, dialog);
  dialog->poll = g_timeout_add(50, on_poll, dialog);
  return G_SOURCE_REMOVE;
}

static void on_response(GtkDialog *widget, int response, Dialog *dialog) {
  if (response == GTK_RESPONSE_ACCEPT && dialog->job == NULL) {
    later(dialog, start);
  } else if (response == GTK_RESPONSE_CANCEL && dialog->job != NULL) {
    sb_export_job_cancel(dialog->job);
  } else if (response != GTK_RESPONSE_ACCEPT) {
    gtk_widget_destroy(dialog->dialog);
  }
}

static void on_destroy(GtkWidget *widget, Dialog *dialog) {
  stop_polling(dialog);
  if (dialog->later != 0) {
    g_source_remove(dialog->later);
  }
  g_clear_pointer(&dialog->job, sb_export_job_free);
  g_object_unref(dialog->session);
  g_free(dialog);
}

// Opening
// ------------------------------------------------------------------------------------------

static void fill(Dialog *dialog) {
  size_t count = 0;
  const SbRenderView *views = sb_render_views(&count);
  for (size_t i = 0; i < count; i++) {
    gtk_combo_box_text_append(GTK_COMBO_BOX_TEXT(dialog->view), views[i].name, views[i].label);
  }
  gtk_combo_box_text_append_text(GTK_COMBO_BOX_TEXT(dialog->size), "As made");
  for (guint i = 0; i < G_N_ELEMENTS(presets); i++) {
    gtk_combo_box_text_append_text(GTK_COMBO_BOX_TEXT(dialog->size), presets[i].name);
  }
  gtk_combo_box_text_append_text(GTK_COMBO_BOX_TEXT(dialog->size), "Own size");
  gtk_combo_box_text_append(GTK_COMBO_BOX_TEXT(dialog->at), "now", "At the playhead");
  const SbSummary *summary = sb_session_summary(dialog->session);
  for (int i = 0; i < SB_STAGE_COUNT; i++) {
    if (summary != NULL && summary->stage[i].reached) {
      const char *name = sb_stage_name((SbStage)i);
      g_autofree char *text = g_strdup_printf("Stage %s", name);
      gtk_combo_box_text_append(GTK_COMBO_BOX_TEXT(dialog->at), name, text);
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
  gtk_combo_box_set_active_id(GTK_COMBO_BOX(dialog->theme), sb_style_is_dark() ? "dark" : "light");
  gtk_combo_box_set_active_id(GTK_COMBO_BOX(dialog->format), "png");
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
      {"fps", &dialog->fps},
      {"duration", &dialog->duration},
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
  g_signal_connect(dialog->dialog, "response", G_CALLBACK(on_response), dialog);
  g_signal_connect(dialog->dialog, "destroy", G_CALLBACK(on_destroy), dialog);
  g_signal_connect(dialog->size, "changed", G_CALLBACK(on_size), dialog);
  g_signal_connect(dialog->view, "changed", G_CALLBACK(on_view), dialog);
  g_signal_connect(dialog->format, "changed", G_CALLBACK(on_format), dialog);
  g_signal_connect(dialog->width, "value-changed", G_CALLBACK(on_number), dialog);
  g_signal_connect(dialog->height, "value-changed", G_CALLBACK(on_number), dialog);
  g_signal_connect(dialog->choose, "clicked", G_CALLBACK(on_choose), dialog);
  fill(dialog);
  gtk_window_present(GTK_WINDOW(dialog->dialog));
}
