// See the header. A file is read on a thread: a STEP's takes seconds.
#include "ui/params/section_row.h"

#include "app/document/seal_file.h"
#include "ui/params/own_row.h"

#include <glib/gi18n.h>

typedef struct {
  SbSession *session; // owned reference
  GtkWidget *button;
} Row;

typedef struct {
  SbSealDrawing section;
  double height;
} Section;

static void free_row(Row *row) {
  g_object_unref(row->session);
  g_free(row);
}

static void read_section(GTask *task, gpointer source, gpointer path, GCancellable *cancellable) {
  Section *section = g_new0(Section, 1);
  GError *error = NULL;
  if (sb_seal_file_read(&section->section, &section->height, path, &error)) {
    g_task_return_pointer(task, section, g_free);
  } else {
    g_free(section);
    g_task_return_error(task, error);
  }
}

static void on_read(GObject *widget, GAsyncResult *result, gpointer ignored) {
  Row *row = g_object_get_data(widget, "row");
  GError *error = NULL;
  g_autofree Section *section = g_task_propagate_pointer(G_TASK(result), &error);
  gtk_widget_set_sensitive(row->button, TRUE);
  sb_own_row_complain(GTK_WIDGET(widget), error != NULL ? error->message : NULL);
  if (section != NULL) {
    const char *path = g_task_get_task_data(G_TASK(result));
    sb_session_set_section(row->session, path, &section->section, section->height);
  }
  g_clear_error(&error);
}

static void read_file(GtkWidget *widget, const char *path) {
  Row *row = g_object_get_data(G_OBJECT(widget), "row");
  g_autoptr(GTask) task = g_task_new(widget, NULL, on_read, NULL);
  g_task_set_task_data(task, g_strdup(path), g_free);
  gtk_widget_set_sensitive(row->button, FALSE);
  g_task_run_in_thread(task, read_section);
}

static gboolean choose(gpointer data) {
  GtkWidget *widget = data;
  GtkWindow *window = GTK_WINDOW(gtk_widget_get_toplevel(widget));
  g_autoptr(GtkFileChooserNative) chooser = gtk_file_chooser_native_new(
      _("Section of the seals"), window, GTK_FILE_CHOOSER_ACTION_OPEN, _("_Open"), _("_Cancel"));
  if (gtk_native_dialog_run(GTK_NATIVE_DIALOG(chooser)) == GTK_RESPONSE_ACCEPT) {
    g_autofree char *path = gtk_file_chooser_get_filename(GTK_FILE_CHOOSER(chooser));
    read_file(widget, path);
  }
  return G_SOURCE_REMOVE;
}

// When the button's own event is over: the dialog has a loop of its own.
static void on_choose(GtkWidget *button, GtkWidget *widget) {
  g_idle_add_full(G_PRIORITY_DEFAULT_IDLE, choose, g_object_ref(widget), g_object_unref);
}

// A file that is dropped on the row.
static void on_dropped(GtkWidget *widget, GdkDragContext *context, int x, int y,
                       GtkSelectionData *data, guint info, guint time, gpointer ignored) {
  g_auto(GStrv) uris = gtk_selection_data_get_uris(data);
  g_autofree char *path =
      uris != NULL && uris[0] != NULL ? g_filename_from_uri(uris[0], NULL, NULL) : NULL;
  if (path != NULL) {
    read_file(widget, path);
  }
  gtk_drag_finish(context, path != NULL, FALSE, time);
}

void sb_section_row_refresh(GtkWidget *widget) {
  Row *row = g_object_get_data(G_OBJECT(widget), "row");
  const char *name = sb_document_section(sb_session_document(row->session));
  g_autofree char *shown = name != NULL ? g_path_get_basename(name) : g_strdup(_("Choose…"));
  gtk_button_set_label(GTK_BUTTON(row->button), shown);
}

GtkWidget *sb_section_row_new(SbSession *session) {
  Row *row = g_new0(Row, 1);
  row->session = g_object_ref(session);
  row->button = gtk_button_new_with_label("");
  GtkWidget *box = sb_own_row_new(
      _("Drawn section"),
      _("Takes the section of both seals from points, a DXF or a STEP of the ring, scaled to their "
        "section diameter (seal.profile_file)"),
      row->button);
  g_object_set_data_full(G_OBJECT(box), "row", row, (GDestroyNotify)free_row);
  g_signal_connect(row->button, "clicked", G_CALLBACK(on_choose), box);
  gtk_drag_dest_set(box, GTK_DEST_DEFAULT_ALL, NULL, 0, GDK_ACTION_COPY);
  gtk_drag_dest_add_uri_targets(box);
  g_signal_connect(box, "drag-data-received", G_CALLBACK(on_dropped), NULL);
  sb_section_row_refresh(box);
  return box;
}
