// The form of the page Design: axes and lines of the map, goal, models and ranges of the search.
#include "ui/window/design_page_private.h"

#include "app/base/translation.h"
#include "app/export/design_text.h"
#include "ui/views/style.h"
#include "ui/views/toolbar.h"
#include "ui/window/design_ranges.h"

#include <glib/gi18n.h>

void sb_design_page_show_form(SbDesignPage *page) {
  page->refreshing = TRUE;
  const gboolean others = sb_design_ranges_show(page->ranges, &page->ask);
  for (int axis = 0; axis < 2; axis++) {
    GtkComboBoxText *combo = GTK_COMBO_BOX_TEXT(page->axis[axis]);
    if (others) {
      gtk_combo_box_text_remove_all(combo);
    }
    for (size_t i = 0; i < page->ask.count && others; i++) {
      gtk_combo_box_text_append_text(combo, sb_translation(sb_param(page->ask.range[i].id)->label));
    }
    gtk_combo_box_set_active(GTK_COMBO_BOX(page->axis[axis]), (int)page->ask.axis[axis]);
  }
  for (size_t i = 0; i < page->goal_count; i++) {
    if (page->goals[i] == page->ask.goal) {
      gtk_combo_box_set_active(GTK_COMBO_BOX(page->goal), (int)i);
    }
  }
  gtk_combo_box_set_active(GTK_COMBO_BOX(page->models), page->ask.closed ? 0 : 1);
  page->refreshing = FALSE;
}

static void on_axis(GtkComboBox *combo, SbDesignPage *page) {
  const int axis = combo == GTK_COMBO_BOX(page->axis[1]);
  const int at = gtk_combo_box_get_active(combo);
  if (page->refreshing || at < 0 || (size_t)at >= page->ask.count) {
    return;
  }
  const size_t before = page->ask.axis[axis];
  page->ask.axis[axis] = (size_t)at;
  if (page->ask.axis[1 - axis] == (size_t)at) { // the same twice: they change places
    page->ask.axis[1 - axis] = before;
  }
  sb_design_page_show_form(page);
  sb_design_page_asked(page);
}

static void on_goal(GtkComboBox *combo, SbDesignPage *page) {
  const int at = gtk_combo_box_get_active(combo);
  if (!page->refreshing && at >= 0) {
    sb_design_ask_set_goal(&page->ask, page->goals[at]);
    sb_design_page_asked(page);
  }
}

static void on_models(GtkComboBox *combo, SbDesignPage *page) {
  if (!page->refreshing) {
    page->ask.closed = gtk_combo_box_get_active(combo) == 0;
    sb_design_page_asked(page);
  }
}

static void on_freed(void *data, size_t index, gboolean free) {
  SbDesignPage *page = data;
  page->ask.range[index].free = free;
  sb_design_page_asked(page);
}

static void on_bounded(void *data, size_t index, double low, double high) {
  SbDesignPage *page = data;
  page->ask.range[index].low = low;
  page->ask.range[index].high = high;
  sb_design_page_show_form(page);
  sb_design_page_asked(page);
}

static void on_robust(void *data, gboolean robust) {
  SbDesignPage *page = data;
  page->ask.robust = robust;
}

static void on_lines(GtkToggleButton *button, SbDesignPage *page) {
  page->look.lines = 0;
  for (unsigned i = 0; i < SB_DESIGN_LINES; i++) {
    page->look.lines |=
        gtk_toggle_button_get_active(GTK_TOGGLE_BUTTON(page->lines[i])) ? 1u << i : 0u;
  }
  sb_design_page_redraw(page);
}

static void on_use_best(GtkButton *button, SbDesignPage *page) {
  SbOverride values[SB_VARY_MAX];
  const SbDesignAnswer *answer = sb_design_page_answer(page);
  const size_t count = answer != NULL ? sb_design_best_values(values, answer) : 0;
  sb_design_page_release(page);
  sb_session_edit_values(page->session, values, count);
}

void sb_design_page_add_axes(SbDesignPage *page, GtkBox *bar) {
  gtk_box_pack_start(bar, sb_style_label(_("Map"), "sb-heading", 0), FALSE, FALSE, 0);
  const char *label[SB_DESIGN_RANGES];
  for (size_t i = 0; i < page->ask.count; i++) {
    label[i] = sb_param(page->ask.range[i].id)->label;
  }
  for (int axis = 0; axis < 2; axis++) {
    if (axis == 1) {
      gtk_box_pack_start(bar, gtk_label_new("×"), FALSE, FALSE, 0);
    }
    page->axis[axis] = sb_toolbar_combo(bar, label, (int)page->ask.count,
                                        axis == 0 ? _("Parameter across") : _("Parameter up"),
                                        _("Which two parameters the map is of"));
    g_signal_connect(page->axis[axis], "changed", G_CALLBACK(on_axis), page);
  }
  gtk_box_pack_start(bar, sb_style_label(_("lines"), "sb-row-range", 0), FALSE, FALSE, 0);
  GtkWidget *linked = sb_toolbar_linked();
  for (int i = 0; i < SB_DESIGN_LINES; i++) {
    page->lines[i] = gtk_toggle_button_new_with_label("");
    gtk_toggle_button_set_active(GTK_TOGGLE_BUTTON(page->lines[i]), i < 2);
    GtkWidget *text = gtk_bin_get_child(GTK_BIN(page->lines[i]));
    gtk_label_set_ellipsize(GTK_LABEL(text), PANGO_ELLIPSIZE_END);
    g_signal_connect(page->lines[i], "toggled", G_CALLBACK(on_lines), page);
    gtk_box_pack_start(GTK_BOX(linked), page->lines[i], FALSE, FALSE, 0);
  }
  page->look.lines = 3;
  gtk_box_pack_start(bar, linked, FALSE, FALSE, 0);
}

void sb_design_page_add_question(SbDesignPage *page, GtkBox *to) {
  GtkBox *bar = GTK_BOX(gtk_box_new(GTK_ORIENTATION_HORIZONTAL, 8));
  gtk_box_pack_start(bar, sb_style_label(_("Goal"), "sb-heading", 0), FALSE, FALSE, 0);
  const char *label[SB_DESIGN_PAGE_GOALS];
  g_autoptr(GPtrArray) names = g_ptr_array_new_with_free_func(g_free);
  page->goal_count = sb_design_ask_goals(page->goals, SB_DESIGN_PAGE_GOALS);
  for (size_t i = 0; i < page->goal_count; i++) {
    char *name = sb_design_goal_text(page->goals[i]);
    g_ptr_array_add(names, name);
    label[i] = name;
  }
  page->goal = sb_toolbar_combo(bar, label, (int)page->goal_count, _("Goal"),
                                _("Figure that the search minimises or maximises"));
  gtk_widget_set_hexpand(page->goal, TRUE);
  g_signal_connect(page->goal, "changed", G_CALLBACK(on_goal), page);
  const SbDesignRangesHooks hooks = {on_freed, on_bounded, on_robust, page};
  page->ranges = sb_design_ranges_new(&hooks);
  gtk_box_pack_start(bar, page->ranges, FALSE, FALSE, 0);
  static const char *const models[] = {N_("Closed forms"), N_("The valve's own")};
  page->models = sb_toolbar_combo(bar, models, 2, _("Models of the map"),
                                  _("Closed forms of the thesis: milliseconds a valve; or the "
                                    "models that the valve has, seconds where rings are solved"));
  g_signal_connect(page->models, "changed", G_CALLBACK(on_models), page);
  page->use_best = sb_design_page_add_button(
      bar, _("Use best"), _("Sets the values of the best design found in the valve"),
      G_CALLBACK(on_use_best), page);
  sb_style_class(GTK_WIDGET(bar), "sb-picked");
  gtk_box_pack_start(to, GTK_WIDGET(bar), FALSE, FALSE, 0);
}
