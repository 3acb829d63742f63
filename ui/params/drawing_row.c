// See the header. A file is read on a thread: a STEP's takes seconds.
#include "ui/params/drawing_row.h"

#include "app/document/seal_file.h"
#include "ui/params/own_row.h"
#include "ui/views/later.h"
#include "ui/views/style.h"

#include <glib/gi18n.h>

typedef struct {
  SbSession *session; // owned reference
  SbDrawingKind kind;
  GtkWidget *button, *none;
  SbLater later; // the file chooser
} DrawingRow;

typedef struct {
  SbSealDrawing section;
  double height;
  SbGrooveDrawing groove;
} Drawing;

static const char *drawing_title_of(SbDrawingKind kind) {
  return kind == SB_DRAWING_SECTION ? _("Drawn section") : _("Drawn groove");
}

static void free_row(DrawingRow *row) {
  g_object_unref(row->session);
  g_free(row);
}

static void give(GTask *task, Drawing *drawing, gboolean good, GError *error) {
  if (good) {
    g_task_return_pointer(task, drawing, g_free);
  } else {
    g_free(drawing);
    g_task_return_error(task, error);
  }
}

static void read_section(GTask *task, gpointer source, gpointer path, GCancellable *cancellable) {
  Drawing *drawing = g_new0(Drawing, 1);
  GError *error = NULL;
  const gboolean good = sb_seal_file_read(&drawing->section, &drawing->height, path, &error);
  give(task, drawing, good, error);
}

static void read_groove(GTask *task, gpointer source, gpointer path, GCancellable *cancellable) {
  Drawing *drawing = g_new0(Drawing, 1);
  GError *error = NULL;
  const gboolean good = sb_groove_file_read(&drawing->groove, path, &error);
  give(task, drawing, good, error);
}

static void on_read(GObject *widget, GAsyncResult *result, gpointer ignored) {
  DrawingRow *row = g_object_get_data(widget, "row");
  GError *error = NULL;
  g_autofree Drawing *drawing = g_task_propagate_pointer(G_TASK(result), &error);
  gtk_widget_set_sensitive(row->button, TRUE);
  sb_own_row_show_error(GTK_WIDGET(widget), error != NULL ? error->message : NULL);
  const char *path = g_task_get_task_data(G_TASK(result));
  if (drawing != NULL && row->kind == SB_DRAWING_SECTION) {
    sb_session_set_section(row->session, path, &drawing->section, drawing->height);
  } else if (drawing != NULL) {
    sb_session_set_groove(row->session, path, &drawing->groove);
  }
  g_clear_error(&error);
}

static void read_file(GtkWidget *widget, const char *path) {
  DrawingRow *row = g_object_get_data(G_OBJECT(widget), "row");
  g_autoptr(GTask) task = g_task_new(widget, NULL, on_read, NULL);
  g_task_set_task_data(task, g_strdup(path), g_free);
  gtk_widget_set_sensitive(row->button, FALSE);
  g_task_run_in_thread(task, row->kind == SB_DRAWING_SECTION ? read_section : read_groove);
}

static void choose(gpointer data) {
  g_autoptr(GtkWidget) widget = g_object_ref(data); // the dialog runs a main loop
  const DrawingRow *row = g_object_get_data(G_OBJECT(widget), "row");
  GtkWindow *window = GTK_WINDOW(gtk_widget_get_toplevel(widget));
  const char *title =
      row->kind == SB_DRAWING_SECTION ? _("Section of the seals") : _("Outline of the grooves");
  g_autoptr(GtkFileChooserNative) chooser = gtk_file_chooser_native_new(
      title, window, GTK_FILE_CHOOSER_ACTION_OPEN, _("_Open"), _("_Cancel"));
  if (gtk_native_dialog_run(GTK_NATIVE_DIALOG(chooser)) == GTK_RESPONSE_ACCEPT) {
    g_autofree char *path = gtk_file_chooser_get_filename(GTK_FILE_CHOOSER(chooser));
    read_file(widget, path);
  }
}

// When the button's own event is over: the dialog has a loop of its own.
static void on_choose(GtkWidget *button, GtkWidget *widget) {
  DrawingRow *row = g_object_get_data(G_OBJECT(widget), "row");
  sb_later_ensure(&row->later, widget, 0, choose, widget);
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

static void on_none(GtkWidget *button, GtkWidget *widget) {
  DrawingRow *row = g_object_get_data(G_OBJECT(widget), "row");
  sb_session_set_groove(row->session, NULL, NULL);
}

void sb_drawing_row_refresh(GtkWidget *widget) {
  DrawingRow *row = g_object_get_data(G_OBJECT(widget), "row");
  const SbDocument *document = sb_session_document(row->session);
  const char *name = row->kind == SB_DRAWING_SECTION ? sb_document_section(document)
                                                     : sb_document_groove(document);
  g_autofree char *shown = name != NULL ? g_path_get_basename(name) : g_strdup(_("Choose…"));
  gtk_button_set_label(GTK_BUTTON(row->button), shown);
  sb_style_name(row->button, drawing_title_of(row->kind), shown);
  if (row->none != NULL) {
    gtk_widget_set_visible(row->none, sb_document_may_drop_groove(document));
  }
}

// The groove's: beside the button one that does without. Sections go by the choice of the profile.
static GtkWidget *with_none(DrawingRow *row) {
  GtkWidget *both = gtk_box_new(GTK_ORIENTATION_HORIZONTAL, 4);
  row->none = gtk_button_new_from_icon_name("edit-clear-symbolic", GTK_ICON_SIZE_BUTTON);
  gtk_widget_set_tooltip_text(row->none, _("No drawn groove"));
  sb_style_name(row->none, _("No drawn groove"), NULL);
  gtk_widget_set_no_show_all(row->none, TRUE);
  gtk_box_pack_start(GTK_BOX(both), row->button, TRUE, TRUE, 0);
  gtk_box_pack_start(GTK_BOX(both), row->none, FALSE, FALSE, 0);
  return both;
}

GtkWidget *sb_drawing_row_new(SbSession *session, SbDrawingKind kind) {
  DrawingRow *row = g_new0(DrawingRow, 1);
  row->session = g_object_ref(session);
  row->kind = kind;
  row->button = gtk_button_new_with_label("");
  const char *tip =
      kind == SB_DRAWING_SECTION
          ? _("Reads the section of both seals from points, a DXF or a STEP of the ring, scaled to "
              "their section diameter (seal.profile_file)")
          : _("Reads floor and walls of both grooves from points, a DXF or a STEP of their "
              "outline; the distance of the walls is the axial width (gland.profile_file)");
  GtkWidget *chooser = kind == SB_DRAWING_SECTION ? row->button : with_none(row);
  GtkWidget *box = sb_own_row_new(drawing_title_of(kind), tip, chooser);
  g_object_set_data_full(G_OBJECT(box), "row", row, (GDestroyNotify)free_row);
  g_signal_connect(row->button, "clicked", G_CALLBACK(on_choose), box);
  if (row->none != NULL) {
    g_signal_connect(row->none, "clicked", G_CALLBACK(on_none), box);
  }
  gtk_drag_dest_set(box, GTK_DEST_DEFAULT_ALL, NULL, 0, GDK_ACTION_COPY);
  gtk_drag_dest_add_uri_targets(box);
  g_signal_connect(box, "drag-data-received", G_CALLBACK(on_dropped), NULL);
  sb_drawing_row_refresh(box);
  return box;
}
