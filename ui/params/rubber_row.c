// See the header. Names are read from the folders anew whenever the list opens, so that a file that
// somebody adds is there.
#include "ui/params/rubber_row.h"

#include "ui/params/own_row.h"

#include <glib/gi18n.h>

// What stands for no rubber of the document's own.
#define NONE ""

typedef struct {
  SbSession *session;
  GtkWidget *box, *combo;
  gboolean refreshing;
} Row;

static void fill(Row *row) {
  const SbDocument *document = sb_session_document(row->session);
  GtkComboBoxText *combo = GTK_COMBO_BOX_TEXT(row->combo);
  const char *name = sb_document_rubber(document);
  const gboolean own = sb_document_gives_rubber(document);
  g_auto(GStrv) names = sb_document_rubbers(document);
  row->refreshing = TRUE;
  gtk_combo_box_text_remove_all(combo);
  // What a valve names stays where the scene names none.
  g_autofree char *below = !own && name != NULL ? g_strdup_printf(_("%s (the valve's)"), name)
                                                : g_strdup(_("not named"));
  gtk_combo_box_text_append(combo, NONE, below);
  for (char **each = names; *each != NULL; each++) {
    gtk_combo_box_text_append(combo, *each, *each);
  }
  if (own && !g_strv_contains((const char *const *)names, name)) {
    gtk_combo_box_text_append(combo, name, name); // by its path
  }
  gtk_combo_box_set_active_id(GTK_COMBO_BOX(row->combo), own ? name : NONE);
  row->refreshing = FALSE;
}

static void on_rubber_choice(GtkComboBox *combo, Row *row) {
  const char *id = gtk_combo_box_get_active_id(combo);
  if (row->refreshing || id == NULL) {
    return;
  }
  g_autoptr(GPtrArray) issues = sb_issues_new();
  g_autofree char *name = *id != '\0' ? g_strdup(id) : NULL;
  const gboolean good = sb_session_set_rubber(row->session, name, issues);
  sb_own_row_show_error(row->box, good ? NULL : ((const SbIssue *)issues->pdata[0])->text);
}

void sb_rubber_row_refresh(GtkWidget *widget) {
  Row *row = g_object_get_data(G_OBJECT(widget), "row");
  const SbDocument *document = sb_session_document(row->session);
  const char *name = sb_document_gives_rubber(document) ? sb_document_rubber(document) : NONE;
  const char *shown = gtk_combo_box_get_active_id(GTK_COMBO_BOX(row->combo));
  if (g_strcmp0(shown, name) != 0 || *name == '\0') {
    fill(row);
  }
}

static void on_popup(Row *row) {
  gboolean shown = FALSE;
  g_object_get(row->combo, "popup-shown", &shown, NULL);
  if (!shown) {
    fill(row);
  }
}

GtkWidget *sb_rubber_row_new(SbSession *session) {
  Row *row = g_new0(Row, 1);
  row->session = session;
  row->combo = gtk_combo_box_text_new();
  GtkWidget *box = row->box =
      sb_own_row_new(_("Rubber of both rings"),
                     _("Reads modulus, glass transition, expansion and swell from a file of the "
                       "rubber; values that are set are not changed (rubber.name)"),
                     row->combo);
  g_object_set_data_full(G_OBJECT(box), "row", row, g_free);
  fill(row);
  g_signal_connect(row->combo, "changed", G_CALLBACK(on_rubber_choice), row);
  g_signal_connect_swapped(row->combo, "notify::popup-shown", G_CALLBACK(on_popup), row);
  return box;
}
