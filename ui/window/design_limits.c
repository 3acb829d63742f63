// The table of limits. See design_limits.h. Rows are made anew where the limited figures change;
// else their texts are.
#include "ui/window/design_limits.h"

#include "app/base/figure_text.h"
#include "app/base/translation.h"
#include "app/base/unit.h"
#include "app/export/design_text.h"
#include "ui/views/style.h"

#include <glib/gi18n.h>
#include <math.h>
#include <string.h>

enum { FIGURES_MAX = 64, BAR_WIDTH = 66, BAR_SIGMAS = 6 };

typedef struct {
  int figure;
  GtkWidget *name, *end[2], *present, *best, *bar, *sigmas;
  double margin; // in deviations of the figure; NaN: not known
  gboolean active;
} Row;

typedef struct {
  SbDesignLimitsHooks hooks;
  GtkWidget *box, *grid, *note, *add, *fails[2];
  Row row[SB_DESIGN_LIMITS];
  size_t count;
  int offered[FIGURES_MAX];
  size_t offers;
  gboolean refreshing;
} Table;

// The number alone, in the unit of the row.
static char *number_of(int figure, double value) {
  const SbFigure *of = sb_figure(figure);
  char digits[SB_NUMBER_SIZE];
  if (!isfinite(value)) {
    return g_strdup("");
  }
  return g_strdup(sb_number_round(digits, sb_quantity_to_shown(value, of->si, of->shown), 6));
}

// Bar and tick ------------------------------------------------------------------------------------

// As long as the margin is in deviations, up to six; the tick is at three.
static gboolean on_bar(GtkWidget *area, cairo_t *cr, Row *row) {
  const SbTheme *theme = sb_theme(sb_style_is_dark());
  const double y = gtk_widget_get_allocated_height(area) / 2.0, width = BAR_WIDTH;
  const SbColor ground = theme->role[SB_ROLE_HAIRLINE], ink = theme->role[SB_ROLE_INK];
  const SbRole role = row->margin >= BAR_SIGMAS ? SB_ROLE_PASS
                      : row->margin > 0         ? SB_ROLE_WARN
                                                : SB_ROLE_ERROR;
  cairo_set_line_width(cr, 5);
  cairo_set_line_cap(cr, CAIRO_LINE_CAP_ROUND);
  cairo_set_source_rgb(cr, ground.r, ground.g, ground.b);
  cairo_move_to(cr, 3, y);
  cairo_line_to(cr, width - 3, y);
  cairo_stroke(cr);
  if (isfinite(row->margin)) {
    const SbColor color = theme->role[role];
    const double share = fmin(fmax(row->margin / BAR_SIGMAS, 0), 1);
    cairo_set_source_rgb(cr, color.r, color.g, color.b);
    cairo_move_to(cr, 3, y);
    cairo_line_to(cr, 3 + share * (width - 6), y);
    cairo_stroke(cr);
  }
  cairo_set_line_cap(cr, CAIRO_LINE_CAP_BUTT);
  cairo_set_line_width(cr, 1.4);
  cairo_set_source_rgb(cr, ink.r, ink.g, ink.b);
  cairo_move_to(cr, width / 2, y - 6);
  cairo_line_to(cr, width / 2, y + 6);
  cairo_stroke(cr);
  return GDK_EVENT_STOP;
}

// Edits -------------------------------------------------------------------------------------------

// A bare number is of the unit shown; nothing: open.
static gboolean read_end(double *out, GtkEntry *entry, int figure, double open) {
  const SbFigure *of = sb_figure(figure);
  g_autofree char *text = g_strstrip(g_strdup(gtk_entry_get_text(entry)));
  g_strdelimit(text, ",", '.');
  GtkStyleContext *style = gtk_widget_get_style_context(GTK_WIDGET(entry));
  double number = 0;
  gboolean good = TRUE;
  if (*text == '\0') {
    *out = open;
  } else if (sb_number_parse(&number, text)) {
    *out = sb_quantity_from_shown(number, of->si, of->shown);
  } else {
    good = sb_quantity_parse(out, text, of->si, of->shown, NULL);
  }
  if (good) {
    gtk_style_context_remove_class(style, GTK_STYLE_CLASS_ERROR);
  } else {
    gtk_style_context_add_class(style, GTK_STYLE_CLASS_ERROR);
  }
  return good;
}

static void on_end(GtkEntry *entry, Table *table) {
  if (table->refreshing) {
    return;
  }
  for (size_t i = 0; i < table->count; i++) {
    Row *row = &table->row[i];
    double low = 0, high = 0;
    if ((row->end[0] == GTK_WIDGET(entry) || row->end[1] == GTK_WIDGET(entry)) &&
        read_end(&low, GTK_ENTRY(row->end[0]), row->figure, -INFINITY) &&
        read_end(&high, GTK_ENTRY(row->end[1]), row->figure, INFINITY)) {
      if (low < high) {
        table->hooks.limited(table->hooks.data, row->figure, low, high);
      } else {
        sb_style_class(GTK_WIDGET(entry), GTK_STYLE_CLASS_ERROR);
      }
      return;
    }
  }
}

static gboolean on_focus_out(GtkWidget *widget, GdkEventFocus *event, Table *table) {
  on_end(GTK_ENTRY(widget), table);
  return GDK_EVENT_PROPAGATE;
}

static void on_name(GtkButton *button, Table *table) {
  for (size_t i = 0; i < table->count; i++) {
    if (table->row[i].name == GTK_WIDGET(button)) {
      table->hooks.chosen(table->hooks.data, table->row[i].figure);
      return;
    }
  }
}

// A figure that is added starts with the end at which it is bad, at what it is now or nothing.
static void on_add(GtkComboBox *combo, Table *table) {
  const int at = gtk_combo_box_get_active(combo);
  if (table->refreshing || at < 1 || at > (int)table->offers) {
    return;
  }
  const int figure = table->offered[at - 1];
  const bool more = sb_figure(figure)->better == SB_BETTER_MORE;
  table->hooks.limited(table->hooks.data, figure, more ? 0 : -INFINITY, more ? INFINITY : 0);
}

// Rows --------------------------------------------------------------------------------------------

static GtkWidget *text_at(Table *table, int column, int row, const char *class) {
  GtkWidget *label = sb_style_label(NULL, class, 1);
  gtk_grid_attach(GTK_GRID(table->grid), label, column, row, 1, 1);
  return label;
}

static void add_row(Table *table, int figure) {
  Row *row = &table->row[table->count];
  const int at = (int)table->count + 1;
  *row = (Row){.figure = figure, .margin = NAN};
  table->count++;
  g_autofree char *name = sb_design_figure_name(figure);
  row->name = gtk_button_new_with_label(name);
  gtk_button_set_relief(GTK_BUTTON(row->name), GTK_RELIEF_NONE);
  GtkWidget *label = gtk_bin_get_child(GTK_BIN(row->name));
  gtk_label_set_xalign(GTK_LABEL(label), 0);
  gtk_label_set_ellipsize(GTK_LABEL(label), PANGO_ELLIPSIZE_END);
  gtk_label_set_width_chars(GTK_LABEL(label), 12);
  gtk_widget_set_hexpand(row->name, TRUE);
  gtk_widget_set_tooltip_text(row->name, sb_translation(sb_figure(figure)->help));
  g_signal_connect(row->name, "clicked", G_CALLBACK(on_name), table);
  gtk_grid_attach(GTK_GRID(table->grid), row->name, 0, at, 1, 1);
  for (int end = 0; end < 2; end++) {
    row->end[end] = gtk_entry_new();
    gtk_entry_set_width_chars(GTK_ENTRY(row->end[end]), 5);
    gtk_entry_set_max_width_chars(GTK_ENTRY(row->end[end]), 5);
    gtk_entry_set_alignment(GTK_ENTRY(row->end[end]), 1);
    g_autofree char *what = g_strdup_printf(end == 0 ? _("Minimum %s") : _("Maximum %s"), name);
    sb_style_name(row->end[end], what, NULL);
    g_signal_connect(row->end[end], "activate", G_CALLBACK(on_end), table);
    g_signal_connect(row->end[end], "focus-out-event", G_CALLBACK(on_focus_out), table);
    gtk_grid_attach(GTK_GRID(table->grid), row->end[end], 1 + end, at, 1, 1);
  }
  GtkWidget *unit = sb_style_label(sb_figure(figure)->shown, "sb-row-range", 0);
  gtk_grid_attach(GTK_GRID(table->grid), unit, 3, at, 1, 1);
  row->present = text_at(table, 4, at, "sb-row-label");
  row->best = text_at(table, 5, at, "sb-derived-value");
  row->bar = gtk_drawing_area_new();
  gtk_widget_set_size_request(row->bar, BAR_WIDTH, 16);
  gtk_widget_set_valign(row->bar, GTK_ALIGN_CENTER);
  g_signal_connect(row->bar, "draw", G_CALLBACK(on_bar), row);
  gtk_grid_attach(GTK_GRID(table->grid), row->bar, 6, at, 1, 1);
  row->sigmas = text_at(table, 7, at, "sb-row-label");
}

static gboolean same_rows(const Table *table, const SbLimits *limits) {
  gboolean same = table->count == limits->count;
  for (size_t i = 0; same && i < limits->count; i++) {
    same = table->row[i].figure == limits->item[i].figure;
  }
  return same;
}

static void destroy(gpointer widget, gpointer data) {
  gtk_widget_destroy(widget);
}

static void lay_rows(Table *table, const SbLimits *limits) {
  g_autoptr(GList) former = gtk_container_get_children(GTK_CONTAINER(table->grid));
  g_list_foreach(former, destroy, NULL);
  static const char *const heads[] = {NULL,
                                      N_("minimum"),
                                      N_("maximum"),
                                      NULL,
                                      N_("present"),
                                      N_("best found"),
                                      N_("margin / σ, tick at 3")};
  table->count = 0;
  for (int k = 1; k < (int)G_N_ELEMENTS(heads); k++) {
    if (heads[k] != NULL) {
      GtkWidget *head = sb_style_label(_(heads[k]), "sb-row-range", 1);
      gtk_grid_attach(GTK_GRID(table->grid), head, k, 0, k == 6 ? 2 : 1, 1);
    }
  }
  for (size_t i = 0; i < MIN(limits->count, SB_DESIGN_LIMITS); i++) {
    add_row(table, limits->item[i].figure);
  }
  const int last = (int)table->count + 1;
  GtkWidget *label = sb_style_label(_("Beyond any limit"), "sb-title", 0);
  g_object_set(label, "margin-start", 6, NULL);
  gtk_widget_set_tooltip_text(label, _("Of the valves drawn from the tolerances"));
  gtk_grid_attach(GTK_GRID(table->grid), label, 0, last, 1, 1);
  for (int place = 0; place < SB_DESIGN_PLACES; place++) {
    table->fails[place] = text_at(table, 4 + place, last, "sb-derived-value");
  }
  gtk_widget_show_all(table->grid);
}

static void set_end(GtkWidget *entry, int figure, double value) {
  g_autofree char *text = number_of(figure, value);
  if (!gtk_widget_has_focus(entry) || *gtk_entry_get_text(GTK_ENTRY(entry)) == '\0') {
    gtk_entry_set_text(GTK_ENTRY(entry), text);
    gtk_style_context_remove_class(gtk_widget_get_style_context(entry), GTK_STYLE_CLASS_ERROR);
  }
}

static void set_value(GtkWidget *label, int figure, double value, double error, bool violates) {
  // The unit of the figure has a column of its own.
  SbFormatted parts;
  sb_figure_parts(&parts, figure, value, error);
  const bool own = strcmp(parts.unit, sb_figure(figure)->shown) == 0;
  g_autofree char *text = own ? g_strdup(parts.number) : sb_design_value_text(figure, value, error);
  gtk_label_set_text(GTK_LABEL(label), text);
  GtkStyleContext *style = gtk_widget_get_style_context(label);
  if (violates) {
    gtk_style_context_add_class(style, "sb-error");
  } else {
    gtk_style_context_remove_class(style, "sb-error");
  }
}

static void show_row(Row *row, const SbLimit *limit, size_t index, const SbDesignAnswer *answer,
                     gboolean chosen) {
  const int column = answer != NULL ? sb_design_answer_figure(answer, limit->figure) : -1;
  double value[SB_DESIGN_PLACES] = {NAN, NAN}, error[SB_DESIGN_PLACES] = {NAN, NAN};
  bool violates[SB_DESIGN_PLACES] = {false, false};
  row->margin = NAN;
  row->active = FALSE;
  // The answer may be of other limits for a moment.
  const gboolean same = column >= 0 && column < SB_DESIGN_FIGURES &&
                        index < answer->study->limits.count &&
                        answer->study->limits.item[index].figure == limit->figure;
  for (int place = 0; same && place < SB_DESIGN_PLACES; place++) {
    if (answer->place[place].known) {
      value[place] = answer->place[place].figure[column];
      error[place] = answer->place[place].error[column];
      violates[place] = sb_design_violates(answer, place, index);
      row->margin = sb_design_sigmas(answer, place, index);
      row->active = place == SB_DESIGN_BEST && (answer->found.limit_active[2 * index] ||
                                                answer->found.limit_active[2 * index + 1]);
    }
  }
  set_end(row->end[0], limit->figure, limit->low);
  set_end(row->end[1], limit->figure, limit->high);
  set_value(row->present, limit->figure, value[SB_DESIGN_PRESENT], error[SB_DESIGN_PRESENT],
            violates[SB_DESIGN_PRESENT]);
  set_value(row->best, limit->figure, value[SB_DESIGN_BEST], error[SB_DESIGN_BEST],
            violates[SB_DESIGN_BEST]);
  g_autofree char *sigmas = isnan(row->margin)         ? g_strdup("–")
                            : row->margin > BAR_SIGMAS ? g_strdup_printf("> %d", BAR_SIGMAS)
                                                       : g_strdup_printf("%.1f", row->margin);
  gtk_label_set_text(GTK_LABEL(row->sigmas), sigmas);
  g_autofree char *name = sb_design_figure_name(limit->figure);
  g_autofree char *told = row->active ? g_strdup_printf(_("%s, active"), name) : g_strdup(name);
  gtk_button_set_label(GTK_BUTTON(row->name), told);
  GtkWidget *label = gtk_bin_get_child(GTK_BIN(row->name));
  gtk_label_set_xalign(GTK_LABEL(label), 0);
  gtk_label_set_ellipsize(GTK_LABEL(label), PANGO_ELLIPSIZE_END);
  GtkStyleContext *style = gtk_widget_get_style_context(row->name);
  static const char *const classes[] = {"sb-active", "sb-chosen"};
  const gboolean on[] = {row->active, chosen};
  for (int k = 0; k < 2; k++) {
    if (on[k]) {
      gtk_style_context_add_class(style, classes[k]);
    } else {
      gtk_style_context_remove_class(style, classes[k]);
    }
  }
  gtk_widget_queue_draw(row->bar);
}

void sb_design_limits_show(GtkWidget *limits, const SbDesignAsk *ask, const SbDesignAnswer *answer,
                           int chosen) {
  Table *table = g_object_get_data(G_OBJECT(limits), "table");
  table->refreshing = TRUE;
  if (!same_rows(table, &ask->limits) || table->fails[0] == NULL) {
    lay_rows(table, &ask->limits);
  }
  for (size_t i = 0; i < table->count; i++) {
    show_row(&table->row[i], &ask->limits.item[i], i, answer, table->row[i].figure == chosen);
  }
  for (int place = 0; place < SB_DESIGN_PLACES; place++) {
    g_autofree char *text =
        answer != NULL ? sb_design_fails_text(&answer->place[place]) : g_strdup("–");
    gtk_label_set_text(GTK_LABEL(table->fails[place]), text);
  }
  g_autofree char *more =
      ask->left_out > 0
          ? g_strdup_printf(ngettext("%zu limit of the file cannot be shown here",
                                     "%zu limits of the file cannot be shown here", ask->left_out),
                            ask->left_out)
          : NULL;
  gtk_label_set_text(GTK_LABEL(table->note), more != NULL ? more
                                             : ask->usual ? _("usual ones: the file sets none")
                                                          : _("barred: active at the best found"));
  gtk_widget_set_sensitive(table->add, ask->limits.count < SB_DESIGN_LIMITS);
  gtk_combo_box_set_active(GTK_COMBO_BOX(table->add), 0);
  table->refreshing = FALSE;
}

GtkWidget *sb_design_limits_new(const SbDesignLimitsHooks *hooks) {
  Table *table = g_new0(Table, 1);
  table->hooks = *hooks;
  table->box = gtk_box_new(GTK_ORIENTATION_VERTICAL, 4);
  g_object_set_data_full(G_OBJECT(table->box), "table", table, g_free);
  GtkWidget *head = gtk_box_new(GTK_ORIENTATION_HORIZONTAL, 10);
  gtk_box_pack_start(GTK_BOX(head), sb_style_label(_("Limits"), "sb-heading", 0), FALSE, FALSE, 0);
  table->note = sb_style_label(NULL, "sb-row-range", 0);
  gtk_label_set_ellipsize(GTK_LABEL(table->note), PANGO_ELLIPSIZE_END);
  gtk_box_pack_start(GTK_BOX(head), table->note, TRUE, TRUE, 0);
  table->add = gtk_combo_box_text_new();
  gtk_combo_box_text_append_text(GTK_COMBO_BOX_TEXT(table->add), _("Add a limit…"));
  table->offers = sb_design_ask_figures(table->offered, FIGURES_MAX);
  for (size_t i = 0; i < table->offers; i++) {
    g_autofree char *name = sb_design_figure_name(table->offered[i]);
    gtk_combo_box_text_append_text(GTK_COMBO_BOX_TEXT(table->add), name);
  }
  gtk_combo_box_set_active(GTK_COMBO_BOX(table->add), 0);
  sb_style_name(table->add, _("Add a limit"), NULL);
  g_signal_connect(table->add, "changed", G_CALLBACK(on_add), table);
  gtk_box_pack_end(GTK_BOX(head), table->add, FALSE, FALSE, 0);
  gtk_box_pack_start(GTK_BOX(table->box), head, FALSE, FALSE, 0);
  table->grid = gtk_grid_new();
  sb_style_class(table->grid, "sb-row");
  sb_style_class(table->grid, "sb-limits");
  gtk_grid_set_column_spacing(GTK_GRID(table->grid), 8);
  gtk_grid_set_row_spacing(GTK_GRID(table->grid), 3);
  gtk_box_pack_start(GTK_BOX(table->box), table->grid, FALSE, FALSE, 0);
  gtk_widget_show_all(table->box);
  return table->box;
}
