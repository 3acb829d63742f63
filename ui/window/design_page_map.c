// The map of the page Design: its picked point, which pointer and keys move, and the two lines of
// text below it.
#include "ui/window/design_page_private.h"

#include "app/base/figure_text.h"
#include "app/base/translation.h"
#include "ui/views/style.h"
#include "ui/window/toast.h"

#include <glib/gi18n.h>
#include <math.h>
#include <string.h>

char *sb_design_page_picked_text(const SbDesignPage *page, const SbDesignAnswer *answer) {
  if (answer == NULL || !page->look.picked) {
    return g_strdup(_("Click a point of the map to read it, to open it or to save it."));
  }
  GString *text = g_string_new(NULL);
  for (int axis = 0; axis < 2; axis++) {
    const SbParamId id = answer->map.axis[axis];
    g_autofree char *label = sb_translation_inside(sb_param(id)->label);
    g_autofree char *value = sb_param_format(id, page->look.pick[axis]);
    g_string_append_printf(text, "%s%s %s", axis > 0 ? ", " : "", label, value);
  }
  g_string_append(text, ": ");
  for (size_t i = 0; i < answer->map.figures; i++) {
    const int figure = g_array_index(answer->study->figures, int, i);
    const double value = sb_design_map_at(&answer->map, i, page->look.pick[0], page->look.pick[1]);
    g_autofree char *label = sb_translation_inside(sb_figure(figure)->label);
    g_autofree char *shown = sb_design_value_text(figure, value, NAN);
    g_string_append_printf(text, "%s%s %s", i > 0 ? ", " : "", label, shown);
  }
  return g_string_free(text, FALSE);
}

char *sb_design_page_models_text(SbDesignPage *page, const SbDesignAnswer *answer) {
  const SbSummary *summary = sb_session_summary(page->session);
  const char *models = page->ask.closed ? _("closed forms of the thesis") : _("the valve's own");
  if (answer == NULL || summary == NULL || !answer->place[SB_DESIGN_PRESENT].known) {
    return g_strdup_printf(_("Models: %s"), models);
  }
  GString *text = g_string_new(NULL);
  g_string_append_printf(text, _("Models: %s. At present, here and in the displayed run:"), models);
  for (size_t i = 0; i < answer->map.figures; i++) {
    const int figure = g_array_index(answer->study->figures, int, i);
    g_autofree char *label = sb_translation_inside(sb_figure(figure)->label);
    const SbDesignPlace *present = &answer->place[SB_DESIGN_PRESENT];
    g_autofree char *here = sb_design_value_text(figure, present->figure[i], present->error[i]);
    char there[SB_FORMAT_MAX];
    sb_format_figure(there, summary, figure);
    g_string_append_printf(text, "%s %s %s, %s", i > 0 ? ";" : "", label, here, there);
  }
  return g_string_free(text, FALSE);
}

// Short values: a hundredth of a step of the axis.
static double rounded(SbParamId id, double low, double high, double value) {
  const SbParam *param = sb_param(id);
  const double wide = sb_quantity_to_shown(high, param->si, param->unit) -
                      sb_quantity_to_shown(low, param->si, param->unit);
  return sb_quantity_step(value, param->si, param->unit, (int)floor(log10(wide / 100)), 0);
}

static void pick(SbDesignPage *page, double across, double up) {
  const SbDesignAnswer *answer = sb_design_page_answer(page);
  if (answer != NULL) {
    const SbDesignMap *map = &answer->map;
    const double at[2] = {across, up};
    page->look.picked = TRUE;
    for (int axis = 0; axis < 2; axis++) {
      const double value = fmin(fmax(at[axis], map->low[axis]), map->high[axis]);
      page->look.pick[axis] = rounded(map->axis[axis], map->low[axis], map->high[axis], value);
    }
  }
  sb_design_page_release(page);
  sb_design_page_refresh(page);
}

// The picked point's two values; FALSE: none is picked.
static gboolean overrides(SbDesignPage *page, SbOverride out[2]) {
  const SbDesignAnswer *answer = sb_design_page_answer(page);
  const gboolean picked = answer != NULL && page->look.picked;
  for (int axis = 0; picked && axis < 2; axis++) {
    out[axis] = (SbOverride){answer->map.axis[axis], page->look.pick[axis]};
  }
  sb_design_page_release(page);
  return picked;
}

static void on_open(SbDesignPage *page) {
  SbOverride override[2];
  if (overrides(page, override) && !sb_session_edit_values(page->session, override, 2)) {
    sb_design_page_say(page, _("A value is out of range."));
  }
}

static void on_pin(SbDesignPage *page) {
  SbOverride override[2];
  if (overrides(page, override)) {
    const gboolean kept = sb_session_pin_values(page->session, override, 2);
    sb_toast_show(
        GTK_WINDOW(gtk_widget_get_toplevel(page->box)),
        kept ? _("The design is saved: its run is being computed, and appears on the page Valve.")
             : _("No more designs can be saved."),
        NULL, NULL, FALSE);
  }
}

static gboolean on_press(GtkWidget *widget, GdkEventButton *event, SbDesignPage *page) {
  gtk_widget_grab_focus(widget);
  if (event->button != GDK_BUTTON_PRIMARY) {
    return GDK_EVENT_PROPAGATE;
  }
  if (event->type == GDK_2BUTTON_PRESS) {
    on_open(page);
    return GDK_EVENT_STOP;
  }
  const SbRect plot = sb_design_map_plot((SbRect){0, 0, gtk_widget_get_allocated_width(widget),
                                                  gtk_widget_get_allocated_height(widget)});
  const SbDesignAnswer *answer = sb_design_page_answer(page);
  double at[2] = {NAN, NAN};
  if (answer != NULL && event->x >= plot.x && event->x <= plot.x + plot.width &&
      event->y >= plot.y && event->y <= plot.y + plot.height) {
    const SbDesignMap *map = &answer->map;
    at[0] = map->low[0] + (map->high[0] - map->low[0]) * (event->x - plot.x) / plot.width;
    at[1] = map->high[1] - (map->high[1] - map->low[1]) * (event->y - plot.y) / plot.height;
  }
  sb_design_page_release(page);
  if (isfinite(at[0])) {
    pick(page, at[0], at[1]);
  }
  return GDK_EVENT_STOP;
}

// Arrows move the picked point, from the present design at first; Enter opens it.
static gboolean on_key(GtkWidget *widget, GdkEventKey *event, SbDesignPage *page) {
  const int across = (event->keyval == GDK_KEY_Right) - (event->keyval == GDK_KEY_Left);
  const int up = (event->keyval == GDK_KEY_Up) - (event->keyval == GDK_KEY_Down);
  if (event->keyval == GDK_KEY_Return || event->keyval == GDK_KEY_KP_Enter) {
    on_open(page);
    return GDK_EVENT_STOP;
  }
  if (across == 0 && up == 0) {
    return GDK_EVENT_PROPAGATE;
  }
  const SbDesignAnswer *answer = sb_design_page_answer(page);
  double at[2] = {NAN, NAN};
  for (int axis = 0; answer != NULL && axis < 2; axis++) {
    const double from =
        page->look.picked ? page->look.pick[axis] : answer->place[SB_DESIGN_PRESENT].axis[axis];
    const double step = (answer->map.high[axis] - answer->map.low[axis]) / 32;
    at[axis] = from + step * (axis == 0 ? across : up);
  }
  sb_design_page_release(page);
  if (isfinite(at[0])) {
    pick(page, at[0], at[1]);
  }
  return GDK_EVENT_STOP;
}

void sb_design_page_listen(SbDesignPage *page, GtkWidget *map) {
  g_signal_connect(map, "button-press-event", G_CALLBACK(on_press), page);
  g_signal_connect(map, "key-press-event", G_CALLBACK(on_key), page);
}

void sb_design_page_add_picked(SbDesignPage *page, GtkBox *to) {
  GtkWidget *bar = gtk_box_new(GTK_ORIENTATION_HORIZONTAL, 8);
  sb_style_class(bar, "sb-picked");
  page->picked = sb_style_label(NULL, "sb-row-label", 0);
  gtk_label_set_ellipsize(GTK_LABEL(page->picked), PANGO_ELLIPSIZE_END);
  gtk_box_pack_start(GTK_BOX(bar), page->picked, TRUE, TRUE, 0);
  const struct {
    GtkWidget **button;
    const char *label, *tip;
    GCallback call;
  } buttons[] = {{&page->open, _("Open design"),
                  _("Sets the point's two values in the valve (double click, Enter)"),
                  G_CALLBACK(on_open)},
                 {&page->pin, _("Save design"), _("Saves the point as a pin for comparison"),
                  G_CALLBACK(on_pin)}};
  for (guint i = 0; i < G_N_ELEMENTS(buttons); i++) {
    *buttons[i].button = gtk_button_new_with_label(buttons[i].label);
    gtk_widget_set_tooltip_text(*buttons[i].button, buttons[i].tip);
    g_signal_connect_swapped(*buttons[i].button, "clicked", buttons[i].call, page);
    gtk_box_pack_start(GTK_BOX(bar), *buttons[i].button, FALSE, FALSE, 0);
  }
  gtk_box_pack_start(to, bar, FALSE, FALSE, 0);
  bar = gtk_box_new(GTK_ORIENTATION_HORIZONTAL, 8);
  sb_style_class(bar, "sb-status");
  page->told = sb_style_label(NULL, "sb-note", 0);
  gtk_label_set_ellipsize(GTK_LABEL(page->told), PANGO_ELLIPSIZE_END);
  gtk_box_pack_start(GTK_BOX(bar), page->told, TRUE, TRUE, 0);
  gtk_box_pack_start(to, bar, FALSE, FALSE, 0);
}
