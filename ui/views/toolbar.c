// See the header.
#include "ui/views/toolbar.h"

#include "app/base/translation.h"
#include "ui/views/style.h"

GtkWidget *sb_toolbar_linked(void) {
  GtkWidget *box = gtk_box_new(GTK_ORIENTATION_HORIZONTAL, 0);
  sb_style_class(box, "linked");
  return box;
}

void sb_toolbar_button(GtkBox *box, const char *icon, const char *name, const char *tip,
                       const char *action) {
  GtkWidget *button = gtk_button_new_from_icon_name(icon, GTK_ICON_SIZE_BUTTON);
  gtk_actionable_set_action_name(GTK_ACTIONABLE(button), action);
  gtk_widget_set_tooltip_text(button, tip);
  sb_style_name(button, name, NULL);
  gtk_box_pack_start(box, button, FALSE, FALSE, 0);
}

GtkWidget *sb_toolbar_combo(GtkBox *box, const char *const *items, int count, const char *name,
                            const char *tip) {
  GtkWidget *combo = gtk_combo_box_text_new();
  for (int i = 0; i < count; i++) {
    gtk_combo_box_text_append_text(GTK_COMBO_BOX_TEXT(combo), sb_translation(items[i]));
  }
  gtk_combo_box_set_active(GTK_COMBO_BOX(combo), 0);
  g_autoptr(GList) cells = gtk_cell_layout_get_cells(GTK_CELL_LAYOUT(combo));
  if (cells != NULL) {
    g_object_set(cells->data, "ellipsize", PANGO_ELLIPSIZE_END, "width-chars", 9, NULL);
  }
  sb_style_name(combo, name, tip);
  gtk_box_pack_start(box, combo, FALSE, TRUE, 0);
  return combo;
}
