// See the header. Files are read on a thread as they are chosen and again with each choice; the
// choices not made are filled with what was found. What was read is drawn as it will be seen.
#include "ui/window/import_dialog.h"

#include "app/base/error.h"
#include "ui/views/style.h"
#include "ui/window/import_private.h"

#include <glib/gi18n.h>
#include <string.h>

// The form ---------------------------------------------------------------------------------------

static const char *choice_text(const SbImportDialog *dialog, int i) {
  GtkWidget *widget = dialog->choice[i];
  return GTK_IS_ENTRY(widget) ? gtk_entry_get_text(GTK_ENTRY(widget))
                              : gtk_combo_box_get_active_id(GTK_COMBO_BOX(widget));
}

void sb_import_set_choice(SbImportDialog *dialog, int i, const char *text) {
  GtkWidget *widget = dialog->choice[i];
  dialog->filling = TRUE;
  if (GTK_IS_ENTRY(widget)) {
    gtk_entry_set_text(GTK_ENTRY(widget), text);
  } else {
    gtk_combo_box_set_active_id(GTK_COMBO_BOX(widget), text);
  }
  dialog->filling = FALSE;
}

char *sb_import_keys(const SbImportDialog *dialog) {
  GString *keys = g_string_new(NULL);
  for (int i = 0; dialog->kind->row[i].key != NULL; i++) {
    const char *text = choice_text(dialog, i);
    if (dialog->said[i] && text != NULL && *text != '\0') {
      g_string_append_printf(keys, "%s = %s\n", dialog->kind->row[i].key, text);
    }
  }
  return g_string_free(keys, FALSE);
}

void sb_import_fill(SbImportDialog *dialog, const char *keys, gboolean said) {
  g_auto(GStrv) lines = g_strsplit(keys, "\n", -1);
  for (char **line = lines; *line != NULL; line++) {
    char *equal = strstr(*line, " = ");
    for (int i = 0; equal != NULL && dialog->kind->row[i].key != NULL; i++) {
      const char *key = dialog->kind->row[i].key;
      const gboolean fits =
          strlen(key) == (gsize)(equal - *line) && strncmp(key, *line, strlen(key)) == 0;
      if (fits && (said || !dialog->said[i])) {
        sb_import_set_choice(dialog, i, equal + 3);
        dialog->said[i] = said;
      }
    }
  }
}

static void busy(SbImportDialog *dialog, gboolean on) {
  (on ? gtk_spinner_start : gtk_spinner_stop)(GTK_SPINNER(dialog->spinner));
  gtk_dialog_set_response_sensitive(GTK_DIALOG(dialog->dialog), GTK_RESPONSE_ACCEPT, FALSE);
}

static void read_file(SbImportDialog *dialog) {
  busy(dialog, TRUE);
  dialog->kind->start(dialog);
}

// Refusals ---------------------------------------------------------------------------------------

static void remove_offer(GtkWidget *widget, gpointer data) {
  gtk_widget_destroy(widget);
}

void sb_import_problem(SbImportDialog *dialog, const char *why) {
  gtk_label_set_text(GTK_LABEL(dialog->message), why != NULL ? why : "");
  gtk_container_foreach(GTK_CONTAINER(dialog->offers), remove_offer, NULL);
}

// Sets the row of the form, as if the user had typed the value, and reads the file again.
static void on_offer(GtkWidget *button, SbImportDialog *dialog) {
  const int i = GPOINTER_TO_INT(g_object_get_data(G_OBJECT(button), "row"));
  const char *value = g_object_get_data(G_OBJECT(button), "value");
  sb_import_set_choice(dialog, i, value);
  dialog->said[i] = *value != '\0';
  read_file(dialog);
}

static void add_offer(SbImportDialog *dialog, int i, const char *value) {
  const char *label = *value != '\0' ? value : _("as in the file");
  GtkWidget *button = gtk_button_new_with_label(label);
  g_object_set_data(G_OBJECT(button), "row", GINT_TO_POINTER(i));
  g_object_set_data_full(G_OBJECT(button), "value", g_strdup(value), g_free);
  g_signal_connect(button, "clicked", G_CALLBACK(on_offer), dialog);
  g_autofree char *name = g_strdup_printf("%s: %s", _(dialog->kind->row[i].label), label);
  sb_style_name(button, name, NULL);
  gtk_container_add(GTK_CONTAINER(dialog->offers), button);
  gtk_widget_set_can_focus(gtk_widget_get_parent(button), FALSE);
}

void sb_import_refuse(SbImportDialog *dialog, char *problem, const SbChoice *choice) {
  const SbImportRow *row = dialog->kind->row;
  int i = 0;
  while (row[i].key != NULL && (choice == NULL || g_strcmp0(row[i].key, choice->key) != 0)) {
    i++;
  }
  g_autofree char *text = row[i].key != NULL
                              ? g_strdup_printf(_("%s: choose \"%s\""), problem, _(row[i].label))
                              : g_strdup(problem);
  sb_import_problem(dialog, text);
  for (char **value = row[i].key != NULL ? choice->value : NULL; value != NULL && *value != NULL;
       value++) {
    add_offer(dialog, i, *value);
  }
  gtk_widget_show_all(dialog->offers);
  g_free(problem);
}

void sb_import_refuse_error(SbImportDialog *dialog, const GError *error) {
  const SbChoice *choice = sb_app_error_choice(error);
  sb_import_refuse(
      dialog, choice != NULL ? sb_choice_problem(choice, error->message) : g_strdup(error->message),
      choice);
}

void sb_import_on_read(void *data) {
  SbImportDialog *dialog = data;
  g_autofree char *text = dialog->kind->take(dialog);
  busy(dialog, FALSE);
  gtk_dialog_set_response_sensitive(GTK_DIALOG(dialog->dialog), GTK_RESPONSE_ACCEPT, text != NULL);
  if (text != NULL) {
    sb_import_problem(dialog, NULL);
    gtk_label_set_text(GTK_LABEL(dialog->text), text);
  }
  sb_style_name(dialog->area, dialog->kind->picture, text);
  sb_draw_cache_change(dialog->cache, 0);
}

static void on_import_later(gpointer data) {
  SbImportDialog *dialog = data;
  read_file(dialog);
}

static void on_choice(GtkWidget *widget, SbImportDialog *dialog) {
  if (dialog->filling) {
    return;
  }
  for (int i = 0; dialog->kind->row[i].key != NULL; i++) {
    const char *text = choice_text(dialog, i);
    if (dialog->choice[i] == widget) {
      dialog->said[i] = text != NULL && *text != '\0';
    }
  }
  enum { TYPING = 300 };
  sb_later_set(&dialog->later, dialog->dialog, TYPING, on_import_later, dialog);
}

static void on_as_found(GtkWidget *button, SbImportDialog *dialog) {
  memset(dialog->said, 0, sizeof dialog->said);
  for (int i = 0; dialog->kind->row[i].key != NULL; i++) {
    sb_import_set_choice(dialog, i, "");
  }
  read_file(dialog);
}

// Life -------------------------------------------------------------------------------------------

static void on_response(GtkDialog *widget, int response, SbImportDialog *dialog) {
  if (response == GTK_RESPONSE_ACCEPT && !dialog->kind->use(dialog)) {
    return;
  }
  gtk_widget_destroy(dialog->dialog);
}

static void on_import_destroy(GtkWidget *widget, SbImportDialog *dialog) {
  sb_measure_job_free(dialog->measuring);
  sb_import_forget_measured(dialog);
  sb_read_job_free(dialog->reading);
  g_object_unref(dialog->session);
  g_free(dialog->path);
  g_free(dialog);
}

static GtkWidget *make_choice(SbImportDialog *dialog, const SbImportRow *row) {
  GtkWidget *widget;
  if (row->words == NULL) {
    widget = gtk_entry_new();
  } else {
    widget = gtk_combo_box_text_new();
    for (const char *const *word = row->words; *word != NULL; word++) {
      gtk_combo_box_text_append(GTK_COMBO_BOX_TEXT(widget), *word, *word);
    }
  }
  g_signal_connect(widget, "changed", G_CALLBACK(on_choice), dialog);
  sb_style_name(widget, _(row->label), NULL);
  return widget;
}

static void add_form(SbImportDialog *dialog, GtkBox *box) {
  GtkGrid *grid = GTK_GRID(gtk_grid_new());
  gtk_grid_set_row_spacing(grid, 6);
  gtk_grid_set_column_spacing(grid, 10);
  int rows = 0;
  for (const SbImportRow *row = dialog->kind->row; row->key != NULL; row++, rows++) {
    dialog->choice[rows] = make_choice(dialog, row);
    gtk_widget_set_hexpand(dialog->choice[rows], TRUE);
    gtk_grid_attach(grid, sb_style_label(_(row->label), "sb-row-label", 0), 0, rows, 1, 1);
    gtk_grid_attach(grid, dialog->choice[rows], 1, rows, 1, 1);
  }
  GtkWidget *found = gtk_button_new_with_label(_("As found"));
  gtk_widget_set_tooltip_text(found, _("Resets all choices"));
  g_signal_connect(found, "clicked", G_CALLBACK(on_as_found), dialog);
  gtk_grid_attach(grid, found, 1, rows, 1, 1);
  dialog->text = gtk_label_new(NULL);
  gtk_label_set_xalign(GTK_LABEL(dialog->text), 0);
  gtk_label_set_line_wrap(GTK_LABEL(dialog->text), TRUE);
  gtk_label_set_max_width_chars(GTK_LABEL(dialog->text), 48);
  gtk_label_set_selectable(GTK_LABEL(dialog->text), TRUE);
  sb_style_name(dialog->text, _("Recognised"), NULL);
  gtk_grid_attach(grid, dialog->text, 0, rows + 1, 2, 1);
  gtk_box_pack_start(box, GTK_WIDGET(grid), FALSE, FALSE, 0);
}

static void open_dialog(GtkWindow *parent, SbSession *session, const SbImportKind *kind,
                        const char *path) {
  SbImportDialog *dialog = g_new0(SbImportDialog, 1);
  dialog->kind = kind;
  dialog->session = g_object_ref(session);
  dialog->path = g_canonicalize_filename(path, NULL);
  g_autofree char *name = g_path_get_basename(path);
  g_autofree char *shown = g_filename_display_name(name);
  g_autofree char *title = g_strdup_printf("%s: %s", _(kind->title), shown);
  dialog->dialog = gtk_dialog_new_with_buttons(
      title, parent, GTK_DIALOG_MODAL | GTK_DIALOG_DESTROY_WITH_PARENT, _("_Cancel"),
      GTK_RESPONSE_CANCEL, _("_Import"), GTK_RESPONSE_ACCEPT, NULL);
  gtk_dialog_set_default_response(GTK_DIALOG(dialog->dialog), GTK_RESPONSE_ACCEPT);
  gtk_window_set_default_size(GTK_WINDOW(dialog->dialog), kind->width, kind->height);
  g_signal_connect(dialog->dialog, "response", G_CALLBACK(on_response), dialog);
  g_signal_connect(dialog->dialog, "destroy", G_CALLBACK(on_import_destroy), dialog);
  GtkWidget *content = gtk_dialog_get_content_area(GTK_DIALOG(dialog->dialog));
  GtkWidget *columns = gtk_box_new(GTK_ORIENTATION_HORIZONTAL, 16);
  gtk_container_set_border_width(GTK_CONTAINER(columns), 12);
  add_form(dialog, GTK_BOX(columns));
  dialog->area = gtk_drawing_area_new();
  sb_style_class(dialog->area, "sb-canvas");
  gtk_widget_set_size_request(dialog->area, 420, 320);
  atk_object_set_role(gtk_widget_get_accessible(dialog->area), ATK_ROLE_CHART);
  dialog->cache = sb_draw_cache_attach(dialog->area, kind->draw, dialog);
  gtk_box_pack_start(GTK_BOX(columns), dialog->area, TRUE, TRUE, 0);
  gtk_box_pack_start(GTK_BOX(content), columns, TRUE, TRUE, 0);
  GtkWidget *foot = gtk_box_new(GTK_ORIENTATION_HORIZONTAL, 8);
  gtk_container_set_border_width(GTK_CONTAINER(foot), 12);
  dialog->spinner = gtk_spinner_new();
  dialog->message = sb_style_label(NULL, "sb-warn", 0);
  gtk_label_set_line_wrap(GTK_LABEL(dialog->message), TRUE);
  gtk_box_pack_start(GTK_BOX(foot), dialog->spinner, FALSE, FALSE, 0);
  gtk_box_pack_start(GTK_BOX(foot), dialog->message, TRUE, TRUE, 0);
  gtk_box_pack_start(GTK_BOX(content), foot, FALSE, FALSE, 0);
  // Below the message, in as many lines as they need.
  dialog->offers = gtk_flow_box_new();
  gtk_flow_box_set_selection_mode(GTK_FLOW_BOX(dialog->offers), GTK_SELECTION_NONE);
  gtk_flow_box_set_max_children_per_line(GTK_FLOW_BOX(dialog->offers), 12);
  gtk_container_set_border_width(GTK_CONTAINER(dialog->offers), 12);
  gtk_widget_set_halign(dialog->offers, GTK_ALIGN_START);
  gtk_box_pack_start(GTK_BOX(content), dialog->offers, FALSE, FALSE, 0);
  sb_style_window(dialog->dialog);
  gtk_widget_show_all(dialog->dialog);
  const SbDocument *document = sb_session_document(session);
  const SbData *own = sb_document_data_count(document) > 0 ? sb_document_data(document, 0) : NULL;
  g_autofree char *its = own != NULL ? g_canonicalize_filename(own->path, NULL) : NULL;
  if (kind == &sb_import_measured_kind && g_strcmp0(its, dialog->path) == 0) {
    g_autoptr(GString) keys = g_string_new(NULL);
    for (int key = 0; key < SB_DATA_KEY_COUNT; key++) {
      if (own->text[key] != NULL) {
        g_string_append_printf(keys, "%s = %s\n", sb_data_key_name((SbDataKey)key), own->text[key]);
      }
    }
    sb_import_fill(dialog, keys->str, TRUE);
  }
  read_file(dialog);
}

static void import(GtkWindow *parent, SbSession *session, const SbImportKind *kind,
                   const char *path) {
  if (path != NULL) {
    open_dialog(parent, session, kind, path);
    return;
  }
  GtkFileChooserNative *chooser = gtk_file_chooser_native_new(
      _(kind->title), parent, GTK_FILE_CHOOSER_ACTION_OPEN, _("_Open"), _("_Cancel"));
  if (gtk_native_dialog_run(GTK_NATIVE_DIALOG(chooser)) == GTK_RESPONSE_ACCEPT) {
    g_autofree char *file = gtk_file_chooser_get_filename(GTK_FILE_CHOOSER(chooser));
    open_dialog(parent, session, kind, file);
  }
  g_object_unref(chooser);
}

void sb_import_measured(GtkWindow *parent, SbSession *session, const char *path) {
  import(parent, session, &sb_import_measured_kind, path);
}

void sb_import_scan(GtkWindow *parent, SbSession *session, const char *path) {
  import(parent, session, &sb_import_scan_kind, path);
}

void sb_import_drawing(GtkWindow *parent, SbSession *session, const char *path) {
  import(parent, session, &sb_import_drawing_kind, path);
}
