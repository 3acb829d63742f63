// See the header.
#include "ui/params/own_row.h"

#include "ui/views/style.h"

static const char ERROR[] = "own-error";

GtkWidget *sb_own_row_new(const char *title, const char *tip, GtkWidget *chooser) {
  GtkWidget *box = gtk_box_new(GTK_ORIENTATION_VERTICAL, 0);
  GtkWidget *line = gtk_box_new(GTK_ORIENTATION_HORIZONTAL, 6);
  sb_style_class(box, "sb-row");
  sb_style_name(chooser, title, NULL);
  gtk_widget_set_tooltip_text(box, tip);
  GtkWidget *label = sb_style_label(title, "sb-row-label", 0);
  gtk_label_set_mnemonic_widget(GTK_LABEL(label), chooser);
  gtk_box_pack_start(GTK_BOX(line), label, TRUE, TRUE, 0);
  gtk_box_pack_start(GTK_BOX(line), chooser, FALSE, FALSE, 0);
  gtk_widget_set_margin_end(chooser, 36); // where the other rows have their symbols
  gtk_box_pack_start(GTK_BOX(box), line, FALSE, FALSE, 0);
  GtkWidget *error = sb_style_label(NULL, "sb-row-error", 0);
  gtk_label_set_line_wrap(GTK_LABEL(error), TRUE);
  gtk_widget_set_no_show_all(error, TRUE);
  gtk_widget_set_visible(error, FALSE);
  gtk_box_pack_start(GTK_BOX(box), error, FALSE, FALSE, 0);
  g_object_set_data(G_OBJECT(box), ERROR, error);
  return box;
}

void sb_own_row_show_error(GtkWidget *row, const char *text) {
  GtkWidget *error = g_object_get_data(G_OBJECT(row), ERROR);
  gtk_label_set_text(GTK_LABEL(error), text != NULL ? text : "");
  gtk_widget_set_visible(error, text != NULL);
}
