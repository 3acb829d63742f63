// One row of the parameter panel. Enter or leaving the field commits; any unit is taken and the
// field then shows the catalogue's. The wheel and the arrow keys step the value only while the
// field has the focus, so that scrolling the panel never edits. A refused text stays, in red, with
// one sentence below, until it is mended, reset or left by Escape.
#include "ui/params/param_row.h"

#include "app/base/translation.h"
#include "app/session/param_list.h"
#include "ui/params/param_help.h"
#include "ui/views/style.h"

#include <glib/gi18n.h>
#include <math.h>
#include <string.h>

struct _SbParamRow {
  GtkBox parent_instance;
  SbSession *session; // borrowed; the window keeps it alive longer than its rows
  SbParamId id;
  GtkWidget *label, *range, *field, *reset, *error, *symbol, *effect;
  double share; // of the effect's bar
  gboolean former;
  GtkWidget **flags; // check buttons of a flags parameter
  int flag_count;
  gboolean refreshing; // changes come from the session, not from the user
};

G_DEFINE_TYPE(SbParamRow, sb_param_row, GTK_TYPE_BOX)

static void commit(SbParamRow *row) {
  if (row->refreshing || sb_param(row->id)->kind == SB_PARAM_CHOICE) {
    return;
  }
  const char *text = gtk_entry_get_text(GTK_ENTRY(row->field));
  const char *rejected = sb_session_rejected(row->session, row->id);
  g_autofree char *shown = sb_document_text(sb_session_document(row->session), row->id);
  if (rejected != NULL ? strcmp(text, rejected) == 0 : strcmp(text, shown) == 0) {
    return;
  }
  sb_session_edit(row->session, row->id, text);
}

static void on_activate(GtkEntry *entry, SbParamRow *row) {
  commit(row);
  gtk_editable_select_region(GTK_EDITABLE(entry), 0, -1);
}

static gboolean on_focus_out(GtkWidget *widget, GdkEventFocus *event, SbParamRow *row) {
  commit(row);
  gtk_editable_select_region(GTK_EDITABLE(widget), 0, 0);
  return GDK_EVENT_PROPAGATE;
}

static gboolean on_focus_in(GtkWidget *widget, GdkEventFocus *event, SbParamRow *row) {
  sb_session_prepare(row->session, row->id);
  return GDK_EVENT_PROPAGATE;
}

static void step(SbParamRow *row, double count) {
  commit(row);
  sb_param_step(row->session, row->id, count);
}

static gboolean on_scroll(GtkWidget *widget, GdkEventScroll *event, SbParamRow *row) {
  if (!gtk_widget_has_focus(widget)) {
    return GDK_EVENT_PROPAGATE;
  }
  double dx = 0;
  double dy = 0;
  if (event->direction == GDK_SCROLL_UP) {
    step(row, 1);
  } else if (event->direction == GDK_SCROLL_DOWN) {
    step(row, -1);
  } else if (gdk_event_get_scroll_deltas((GdkEvent *)event, &dx, &dy) && dy != 0) {
    step(row, dy < 0 ? 1 : -1);
  }
  return GDK_EVENT_STOP;
}

static gboolean on_key(GtkWidget *widget, GdkEventKey *event, SbParamRow *row) {
  switch (event->keyval) {
  case GDK_KEY_Up:
    step(row, 1);
    return GDK_EVENT_STOP;
  case GDK_KEY_Down:
    step(row, -1);
    return GDK_EVENT_STOP;
  case GDK_KEY_Page_Up:
    step(row, 10);
    return GDK_EVENT_STOP;
  case GDK_KEY_Page_Down:
    step(row, -10);
    return GDK_EVENT_STOP;
  case GDK_KEY_Escape:
    sb_session_clear_error(row->session, row->id);
    sb_param_row_refresh(row);
    gtk_editable_select_region(GTK_EDITABLE(widget), 0, -1);
    return GDK_EVENT_STOP;
  default:
    return GDK_EVENT_PROPAGATE;
  }
}

// A combo box takes the wheel even without the focus: hand it to the panel instead.
static gboolean on_combo_scroll(GtkWidget *widget, GdkEventScroll *event, SbParamRow *row) {
  if (gtk_widget_has_focus(widget) ||
      (gtk_container_get_focus_child(GTK_CONTAINER(widget)) != NULL)) {
    return GDK_EVENT_PROPAGATE;
  }
  GtkWidget *scroller = gtk_widget_get_ancestor(widget, GTK_TYPE_SCROLLED_WINDOW);
  if (scroller != NULL) {
    gtk_widget_event(scroller, (GdkEvent *)event);
  }
  return GDK_EVENT_STOP;
}

static void on_choice(GtkComboBox *combo, SbParamRow *row) {
  if (!row->refreshing && gtk_combo_box_get_active(combo) >= 0) {
    sb_session_edit(row->session, row->id, gtk_combo_box_get_active_id(combo));
  }
}

static void on_flag(GtkToggleButton *button, SbParamRow *row) {
  if (row->refreshing) {
    return;
  }
  unsigned mask = 0;
  for (int i = 0; i < row->flag_count; i++) {
    if (gtk_toggle_button_get_active(GTK_TOGGLE_BUTTON(row->flags[i]))) {
      mask |= 1u << i;
    }
  }
  sb_session_edit_value(row->session, row->id, mask);
}

static void on_reset(GtkButton *button, SbParamRow *row) {
  sb_session_unset(row->session, row->id);
}

// From the middle to the side that the figure goes as the parameter rises.
static gboolean on_draw_effect(GtkWidget *widget, cairo_t *cr, SbParamRow *row) {
  const SbTheme *theme = sb_theme(sb_style_is_dark());
  const double width = gtk_widget_get_allocated_width(widget), middle = floor(0.5 * width) + 0.5;
  const SbColor axis = theme->role[SB_ROLE_AXIS];
  const SbColor bar = sb_theme_diverging(theme, row->share < 0 ? -0.95 : 0.95);
  cairo_set_source_rgb(cr, axis.r, axis.g, axis.b);
  cairo_rectangle(cr, middle - 0.5, 0, 1, 8);
  cairo_fill(cr);
  const double length = row->share * (middle - 1);
  cairo_set_source_rgba(cr, bar.r, bar.g, bar.b, row->former ? 0.4 : 1);
  cairo_rectangle(cr, middle + fmin(length, 0), 2, fabs(length), 4);
  cairo_fill(cr);
  return GDK_EVENT_STOP;
}

static void add_entry(SbParamRow *row, GtkBox *line, const char *name, const char *range) {
  const SbParam *param = sb_param(row->id);
  row->field = gtk_entry_new();
  gtk_entry_set_alignment(GTK_ENTRY(row->field), 1);
  gtk_entry_set_width_chars(GTK_ENTRY(row->field), 11);
  gtk_entry_set_max_width_chars(GTK_ENTRY(row->field), 11);
  sb_style_name(row->field, name, range);
  gtk_widget_add_events(row->field, GDK_SCROLL_MASK | GDK_SMOOTH_SCROLL_MASK);
  g_signal_connect(row->field, "activate", G_CALLBACK(on_activate), row);
  g_signal_connect(row->field, "focus-in-event", G_CALLBACK(on_focus_in), row);
  g_signal_connect(row->field, "focus-out-event", G_CALLBACK(on_focus_out), row);
  g_signal_connect(row->field, "scroll-event", G_CALLBACK(on_scroll), row);
  g_signal_connect(row->field, "key-press-event", G_CALLBACK(on_key), row);
  gtk_box_pack_start(line, row->field, FALSE, FALSE, 0);
  row->symbol = sb_style_label(param->symbol, "sb-row-symbol", 0);
  gtk_widget_set_size_request(row->symbol, 42, -1);
  GtkWidget *column = gtk_box_new(GTK_ORIENTATION_VERTICAL, 0);
  gtk_widget_set_valign(column, GTK_ALIGN_CENTER);
  gtk_container_add(GTK_CONTAINER(column), row->symbol);
  row->effect = gtk_drawing_area_new();
  gtk_widget_set_size_request(row->effect, 42, 8);
  gtk_widget_set_no_show_all(row->effect, TRUE);
  g_signal_connect(row->effect, "draw", G_CALLBACK(on_draw_effect), row);
  gtk_container_add(GTK_CONTAINER(column), row->effect);
  gtk_box_pack_start(line, column, FALSE, FALSE, 0);
}

static void add_combo(SbParamRow *row, GtkBox *line, const char *name) {
  const SbParam *param = sb_param(row->id);
  row->field = gtk_combo_box_text_new();
  for (int i = 0; i < sb_param_choice_count(param); i++) {
    char choice[64];
    sb_param_choice_name(param, i, choice, sizeof choice);
    gtk_combo_box_text_append(GTK_COMBO_BOX_TEXT(row->field), choice, choice);
  }
  sb_style_name(row->field, name, NULL);
  gtk_widget_add_events(row->field, GDK_SCROLL_MASK | GDK_SMOOTH_SCROLL_MASK);
  g_signal_connect(row->field, "changed", G_CALLBACK(on_choice), row);
  g_signal_connect(row->field, "scroll-event", G_CALLBACK(on_combo_scroll), row);
  gtk_box_pack_start(line, row->field, FALSE, FALSE, 0);
  // Where the other rows have their symbols.
  GtkWidget *blank = gtk_label_new(NULL);
  gtk_widget_set_size_request(blank, 42, -1);
  gtk_box_pack_start(line, blank, FALSE, FALSE, 0);
}

static void add_flags(SbParamRow *row, const char *name) {
  const SbParam *param = sb_param(row->id);
  row->flag_count = sb_param_choice_count(param);
  row->flags = g_new0(GtkWidget *, (gsize)row->flag_count);
  GtkWidget *grid = gtk_grid_new();
  gtk_grid_set_column_spacing(GTK_GRID(grid), 12);
  for (int i = 0; i < row->flag_count; i++) {
    char choice[64];
    sb_param_choice_name(param, i, choice, sizeof choice);
    row->flags[i] = gtk_check_button_new_with_label(choice);
    g_autofree char *full = g_strdup_printf("%s: %s", name, choice);
    sb_style_name(row->flags[i], full, NULL);
    sb_style_class(row->flags[i], "sb-row-label");
    g_signal_connect(row->flags[i], "toggled", G_CALLBACK(on_flag), row);
    gtk_grid_attach(GTK_GRID(grid), row->flags[i], i % 2, i / 2, 1, 1);
  }
  gtk_box_pack_start(GTK_BOX(row), grid, FALSE, FALSE, 0);
}

GtkWidget *sb_param_row_new(SbSession *session, SbParamId id, GtkSizeGroup *fields) {
  SbParamRow *row = g_object_new(SB_TYPE_PARAM_ROW, "orientation", GTK_ORIENTATION_VERTICAL, NULL);
  const SbParam *param = sb_param(id);
  row->session = session;
  row->id = id;
  g_autofree char *name = g_strconcat(sb_param_owner(id), sb_translation(param->label), NULL);
  g_autofree char *range = sb_param_range_shown(id);
  sb_style_class(GTK_WIDGET(row), "sb-row");

  // Label over range at the left, the reset button and the field at the right.
  GtkWidget *line = gtk_box_new(GTK_ORIENTATION_HORIZONTAL, 6);
  GtkWidget *texts = gtk_box_new(GTK_ORIENTATION_VERTICAL, 0);
  gtk_widget_set_valign(texts, GTK_ALIGN_CENTER);
  row->label = sb_style_label(sb_translation(param->label), "sb-row-label", 0);
  gtk_label_set_ellipsize(GTK_LABEL(row->label), PANGO_ELLIPSIZE_END);
  gtk_box_pack_start(GTK_BOX(texts), row->label, FALSE, FALSE, 0);
  if (param->kind == SB_PARAM_REAL || param->kind == SB_PARAM_INT) {
    row->range = sb_style_label(range, "sb-row-range", 0);
    gtk_label_set_ellipsize(GTK_LABEL(row->range), PANGO_ELLIPSIZE_END);
    gtk_box_pack_start(GTK_BOX(texts), row->range, FALSE, FALSE, 0);
  }
  gtk_box_pack_start(GTK_BOX(line), texts, TRUE, TRUE, 0);

  row->reset = gtk_button_new_from_icon_name("edit-clear-symbolic", GTK_ICON_SIZE_MENU);
  g_autofree char *reset_name = g_strdup_printf(_("Reset %s"), name);
  sb_style_name(row->reset, reset_name, NULL);
  sb_style_class(row->reset, "sb-reset");
  gtk_widget_set_valign(row->reset, GTK_ALIGN_CENTER);
  gtk_widget_set_no_show_all(row->reset, TRUE);
  g_signal_connect(row->reset, "clicked", G_CALLBACK(on_reset), row);
  gtk_box_pack_start(GTK_BOX(line), row->reset, FALSE, FALSE, 0);
  gtk_box_pack_start(GTK_BOX(row), line, FALSE, FALSE, 0);

  if (param->kind == SB_PARAM_CHOICE) {
    add_combo(row, GTK_BOX(line), name);
  } else if (param->kind == SB_PARAM_FLAGS) {
    add_flags(row, name);
  } else {
    add_entry(row, GTK_BOX(line), name, range);
    gtk_size_group_add_widget(fields, row->field);
  }
  if (row->field != NULL) {
    gtk_label_set_mnemonic_widget(GTK_LABEL(row->label), row->field);
    gtk_widget_set_valign(row->field, GTK_ALIGN_CENTER);
  }

  row->error = sb_style_label(NULL, "sb-row-error", 0);
  gtk_label_set_line_wrap(GTK_LABEL(row->error), TRUE);
  gtk_label_set_max_width_chars(GTK_LABEL(row->error), 10);
  gtk_widget_set_hexpand(row->error, TRUE);
  gtk_widget_set_no_show_all(row->error, TRUE);
  gtk_box_pack_start(GTK_BOX(row), row->error, FALSE, FALSE, 0);

  sb_param_row_refresh(row);
  return GTK_WIDGET(row);
}

// Help, key, source and tag; why the field is locked, or what a shape says against it.
static void refresh_tooltip(SbParamRow *row, const SbParamDefault *derived, const char *lock,
                            const char *note) {
  const SbParam *param = sb_param(row->id);
  g_autofree char *value = sb_param_format(row->id, derived->value);
  g_autofree char *fallback =
      derived->from != NULL ? g_strdup_printf("%s (%s)", value, derived->from) : g_strdup(value);
  g_autofree char *text =
      g_markup_printf_escaped(_("%s%s%s.\n<small>%s, default %s (%s: %s)</small>"),
                              lock != NULL   ? lock
                              : note != NULL ? note
                                             : "",
                              lock != NULL || note != NULL ? ".\n" : "", param->help, param->key,
                              fallback, derived->tag, derived->source);
  gtk_widget_set_tooltip_markup(GTK_WIDGET(row), text);
}

static void refresh_entry(SbParamRow *row, gboolean inherited, const char *lock, const char *note) {
  GtkEntry *entry = GTK_ENTRY(row->field);
  const char *error = sb_session_error(row->session, row->id);
  const char *rejected = sb_session_rejected(row->session, row->id);
  GtkStyleContext *style = gtk_widget_get_style_context(row->field);
  g_autofree char *shown = sb_document_text(sb_session_document(row->session), row->id);
  const char *text = rejected != NULL ? rejected : shown;
  if (strcmp(gtk_entry_get_text(entry), text) != 0) {
    gtk_entry_set_text(entry, text);
  }
  if (inherited && error == NULL) {
    gtk_style_context_add_class(style, "sb-inherited");
  } else {
    gtk_style_context_remove_class(style, "sb-inherited");
  }
  if (error != NULL) {
    gtk_style_context_add_class(style, GTK_STYLE_CLASS_ERROR);
    gtk_entry_set_icon_from_icon_name(entry, GTK_ENTRY_ICON_PRIMARY, "dialog-error-symbolic");
    gtk_entry_set_icon_tooltip_text(entry, GTK_ENTRY_ICON_PRIMARY, error);
  } else {
    gtk_style_context_remove_class(style, GTK_STYLE_CLASS_ERROR);
    gtk_entry_set_icon_from_icon_name(entry, GTK_ENTRY_ICON_PRIMARY,
                                      lock != NULL   ? "changes-prevent-symbolic"
                                      : note != NULL ? "dialog-information-symbolic"
                                                     : NULL);
    gtk_entry_set_icon_tooltip_text(entry, GTK_ENTRY_ICON_PRIMARY, lock != NULL ? lock : note);
  }
}

// Beside a value that has a tolerance: that, in the unit of the field; else the symbol.
static void refresh_tolerance(SbParamRow *row, const SbParams *params) {
  const int id = row->symbol != NULL ? sb_param_tolerance(row->id) : -1;
  const double tolerance = id >= 0 ? sb_params_get(params, (SbParamId)id) : 0;
  if (tolerance > 0) {
    const SbParam *param = sb_param(row->id);
    g_autofree char *text = sb_quantity_format(tolerance, param->si, param->unit);
    g_autofree char *number = g_strndup(text, strcspn(text, " "));
    g_autofree char *shown = g_strdup_printf("± %s", number);
    gtk_label_set_text(GTK_LABEL(row->symbol), shown);
    gtk_widget_set_tooltip_text(row->symbol, sb_translation(sb_param((SbParamId)id)->label));
  } else if (id >= 0) {
    gtk_label_set_text(GTK_LABEL(row->symbol), sb_param(row->id)->symbol);
  }
}

void sb_param_row_refresh(SbParamRow *row) {
  const SbParam *param = sb_param(row->id);
  const SbDocument *document = sb_session_document(row->session);
  const char *error = sb_session_error(row->session, row->id);
  const char *lock = sb_session_lock(row->session, row->id);
  g_autofree char *note = sb_document_shape_note(document, row->id);
  const SbParams params = sb_document_params(document);
  SbParamDefault derived;
  sb_params_default(&derived, &params, row->id);
  row->refreshing = TRUE;
  if (param->kind == SB_PARAM_CHOICE) {
    g_autofree char *text = sb_document_text(document, row->id);
    gtk_combo_box_set_active_id(GTK_COMBO_BOX(row->field), text);
  } else if (param->kind == SB_PARAM_FLAGS) {
    unsigned mask = (unsigned)sb_document_value(document, row->id);
    for (int i = 0; i < row->flag_count; i++) {
      gtk_toggle_button_set_active(GTK_TOGGLE_BUTTON(row->flags[i]), (mask >> i & 1u) != 0);
    }
  } else {
    refresh_entry(row, derived.from != NULL && !params.given[row->id], lock, note);
  }
  if (row->field != NULL) {
    gtk_widget_set_sensitive(row->field, lock == NULL);
  }
  refresh_tolerance(row, &params);
  gtk_label_set_text(GTK_LABEL(row->error), error != NULL ? error : "");
  gtk_widget_set_visible(row->error, error != NULL);
  gboolean own =
      sb_document_gives(document, row->id) && sb_document_shape_source(document, row->id) == NULL;
  gtk_widget_set_visible(row->reset, own || error != NULL);
  g_autofree char *fallback = sb_param_format(row->id, derived.value);
  g_autofree char *tip = param->parent >= 0 ? g_strdup(_("As for both seals"))
                         : sb_document_kind(document) == SB_DOCUMENT_SCENE
                             ? g_strdup(_("Back to the value of the valve"))
                             : g_strdup_printf(_("Back to the default, %s"), fallback);
  gtk_widget_set_tooltip_text(row->reset, tip);
  refresh_tooltip(row, &derived, lock, note);
  row->refreshing = FALSE;
}

void sb_param_row_show_effect(SbParamRow *row, double share, gboolean former, const char *text) {
  if (row->effect == NULL) {
    return;
  }
  row->share = share;
  row->former = former;
  gtk_widget_set_visible(row->effect, isfinite(share));
  gtk_widget_set_tooltip_text(row->effect, text);
  sb_style_name(row->effect, _("Effect"), text);
  gtk_widget_queue_draw(row->effect);
}

void sb_param_row_focus(SbParamRow *row) {
  GtkWidget *field = row->field != NULL ? row->field : row->flags[0];
  gtk_widget_grab_focus(field);
}

gboolean sb_param_row_help(GtkWidget *widget) {
  GtkWidget *row = widget != NULL ? gtk_widget_get_ancestor(widget, SB_TYPE_PARAM_ROW) : NULL;
  if (row != NULL) {
    sb_param_help_show(SB_PARAM_ROW(row)->session, SB_PARAM_ROW(row)->id, widget);
  }
  return row != NULL;
}

static void finalize_param_row(GObject *object) {
  g_free(SB_PARAM_ROW(object)->flags);
  G_OBJECT_CLASS(sb_param_row_parent_class)->finalize(object);
}

static void sb_param_row_class_init(SbParamRowClass *class) {
  G_OBJECT_CLASS(class)->finalize = finalize_param_row;
}

static void sb_param_row_init(SbParamRow *row) {}
