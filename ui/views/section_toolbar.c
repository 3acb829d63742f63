// The toolbar above the section's picture: field, insets, what is drawn, zoom.
#include "ui/views/section_private.h"

#include "ui/views/style.h"
#include "ui/views/toolbar.h"

#include <glib/gi18n.h>

static GtkWidget *toggle_new(SbSectionWidget *view, const char *label, const char *tip,
                             gboolean active, GtkBox *box) {
  GtkWidget *toggle = gtk_toggle_button_new_with_label(label);
  gtk_toggle_button_set_active(GTK_TOGGLE_BUTTON(toggle), active);
  gtk_widget_set_tooltip_text(toggle, tip);
  g_signal_connect_swapped(toggle, "toggled", G_CALLBACK(sb_section_on_change), view);
  gtk_box_pack_start(box, toggle, FALSE, FALSE, 0);
  return toggle;
}

static void on_field(SbSectionWidget *view) {
  gtk_widget_set_visible(view->no_field,
                         sb_section_lacks_field(view) && !sb_section_asks_field(view));
  sb_section_on_change(view);
}

// Insets belong to the section. The zoom starts anew: it means another thing.
static void on_cutaway(SbSectionWidget *view) {
  gtk_widget_set_sensitive(view->inset_combo, !sb_section_is_cutaway(view));
  view->zoom = 1;
  view->pan_x = view->pan_y = 0;
  gtk_widget_queue_resize(view->gl);
}

// The zoom buttons, which wheel and keys do as well, give way where the toolbar has no room.
static void on_fit(gpointer data) {
  SbSectionWidget *view = data;
  const gboolean shown = gtk_widget_get_visible(view->zooms);
  const int room = gtk_widget_get_allocated_width(gtk_widget_get_parent(view->bar));
  int least = 0;
  gtk_widget_get_preferred_width(view->bar, &least, NULL);
  if (shown) {
    enum { GAP = 8 };
    view->zooms_width = gtk_widget_get_allocated_width(view->zooms) + GAP;
  }
  const gboolean fits = room >= least + (shown ? 0 : view->zooms_width);
  if (fits != shown) {
    gtk_widget_set_visible(view->zooms, fits);
  }
}

// Not inside an allocation, where nothing may come or go.
static void on_toolbar_allocate(SbSectionWidget *view) {
  sb_later_ensure(&view->fit, view->box, 0, on_fit, view);
}

GtkWidget *sb_section_toolbar_new(SbSectionWidget *view) {
  GtkWidget *bar = gtk_box_new(GTK_ORIENTATION_HORIZONTAL, 8);
  sb_style_class(bar, "sb-toolbar");
  GtkWidget *heading = gtk_label_new(_("Section"));
  sb_style_class(heading, "sb-heading");
  gtk_widget_set_margin_end(heading, 4);
  view->heading = heading;
  gtk_box_pack_start(GTK_BOX(bar), heading, FALSE, FALSE, 0);

  const char *fields[SB_FIELD_COUNT];
  for (int i = 0; i < SB_FIELD_COUNT; i++) {
    fields[i] = sb_section_field_name((SbField)i);
  }
  view->field_combo = sb_toolbar_combo(GTK_BOX(bar), fields, SB_FIELD_COUNT, _("Field"),
                                       _("Quantity that the colours of solved rings show"));
  gtk_widget_set_no_show_all(view->field_combo, TRUE);
  g_signal_connect_swapped(view->field_combo, "changed", G_CALLBACK(on_field), view);
  static const char *const insets[] = {N_("Insets: outer seal"), N_("Insets: inner seal"),
                                       N_("No insets")};
  view->inset_combo = sb_toolbar_combo(GTK_BOX(bar), insets, G_N_ELEMENTS(insets), _("Insets"),
                                       _("Which seal's contact the insets enlarge"));
  g_signal_connect_swapped(view->inset_combo, "changed", G_CALLBACK(sb_section_on_change), view);

  GtkWidget *toggles = sb_toolbar_linked();
  view->forces = toggle_new(view, _("Forces"), _("Force arrows"), TRUE, GTK_BOX(toggles));
  view->labels =
      toggle_new(view, _("Labels"), _("Names and values of the parts"), TRUE, GTK_BOX(toggles));
  view->cutaway =
      toggle_new(view, _("Cutaway"),
                 _("The valve in three dimensions, a quarter cut away (Ctrl+D). Drag or "
                   "Alt+arrows turn it, a double click turns it back"),
                 FALSE, GTK_BOX(toggles));
  g_signal_connect_swapped(view->cutaway, "toggled", G_CALLBACK(on_cutaway), view);
  view->mesh = toggle_new(view, _("Mesh"), _("Elements of solved rings"), FALSE, GTK_BOX(toggles));
  gtk_widget_set_no_show_all(view->mesh, TRUE);
  gtk_box_pack_start(GTK_BOX(bar), toggles, FALSE, FALSE, 0);
  view->toggles = toggles;

  GtkWidget *zooms = sb_toolbar_linked();
  sb_toolbar_button(GTK_BOX(zooms), "zoom-out-symbolic", _("Zoom out"), _("Zoom out"),
                    "win.zoom-out");
  sb_toolbar_button(GTK_BOX(zooms), "zoom-fit-best-symbolic", _("Full valve"), _("Full valve"),
                    "win.zoom-fit");
  sb_toolbar_button(GTK_BOX(zooms), "zoom-in-symbolic", _("Zoom in"), _("Zoom in"), "win.zoom-in");
  gtk_box_pack_end(GTK_BOX(bar), zooms, FALSE, FALSE, 0);
  view->bar = bar;
  view->zooms = zooms;
  g_signal_connect_swapped(bar, "size-allocate", G_CALLBACK(on_toolbar_allocate), view);

  // In a narrow window the toolbar scrolls, so that it does not decide how narrow that can be.
  GtkWidget *scroller = gtk_scrolled_window_new(NULL, NULL);
  gtk_scrolled_window_set_policy(GTK_SCROLLED_WINDOW(scroller), GTK_POLICY_AUTOMATIC,
                                 GTK_POLICY_NEVER);
  gtk_container_add(GTK_CONTAINER(scroller), bar);
  return scroller;
}
