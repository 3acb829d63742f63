#include "ui/params/param_help.h"

#include "app/base/translation.h"
#include "engine/valve/model/param_equation.h"
#include "ui/params/param_sketch.h"
#include "ui/views/style.h"

#include <glib/gi18n.h>

enum { WIDTH = 52 }; // characters

static GtkWidget *wrapped(const char *text, const char *name) {
  GtkWidget *label = sb_style_label(text, name, 0);
  gtk_label_set_line_wrap(GTK_LABEL(label), TRUE);
  gtk_label_set_max_width_chars(GTK_LABEL(label), WIDTH);
  gtk_label_set_selectable(GTK_LABEL(label), TRUE);
  gtk_widget_set_can_focus(label, FALSE);
  return label;
}

static void add(GtkGrid *grid, int *line, const char *name, const char *text) {
  if (text == NULL || text[0] == '\0') {
    return;
  }
  GtkWidget *head = sb_style_label(name, "sb-note", 0);
  gtk_widget_set_valign(head, GTK_ALIGN_START);
  gtk_grid_attach(grid, head, 0, *line, 1, 1);
  gtk_grid_attach(grid, wrapped(text, "sb-derived-name"), 1, *line, 1, 1);
  ++*line;
}

static char *range_of(const SbParam *param, SbParamId id) {
  if (param->choices != NULL) {
    g_auto(GStrv) all = g_strsplit(param->choices, "|", -1);
    return g_strjoinv(", ", all);
  }
  g_autofree char *least = sb_param_format(id, param->min);
  g_autofree char *most = sb_param_format(id, param->max);
  return g_strdup_printf(_("%s to %s"), least, most);
}

void sb_param_help_show(SbSession *session, SbParamId id, GtkWidget *field) {
  const SbParam *param = sb_param(id);
  const SbDocument *document = sb_session_document(session);
  const SbParams params = sb_document_params(document);
  SbParamDefault derived;
  sb_params_default(&derived, &params, id);
  g_autofree char *now = sb_param_format(id, sb_params_get(&params, id));
  g_autofree char *fallback = sb_param_format(id, derived.value);
  g_autofree char *from = derived.from != NULL
                              ? g_strdup_printf(_("%s, from %s"), fallback, derived.from)
                              : g_strdup(fallback);
  g_autofree char *source = g_strdup_printf("%s (%s)", derived.source, derived.tag);
  g_autofree char *range = range_of(param, id);
  g_autofree char *key = g_strdup_printf("%s, %s", param->key, param->symbol);
  const SbParamEquation *equation = sb_param_equation(id);

  GtkWidget *popover = gtk_popover_new(field);
  gtk_popover_set_position(GTK_POPOVER(popover), GTK_POS_RIGHT);
  sb_style_name(popover, _("Help"), sb_translation(param->label));
  GtkWidget *box = gtk_box_new(GTK_ORIENTATION_VERTICAL, 8);
  g_object_set(box, "margin", 16, NULL);
  gtk_container_add(GTK_CONTAINER(popover), box);
  gtk_container_add(GTK_CONTAINER(box),
                    sb_style_label(sb_translation(param->label), "sb-heading", 0));
  gtk_container_add(GTK_CONTAINER(box), wrapped(sb_translation(param->help), "sb-derived-name"));
  const SbModel *model = sb_session_model(session);
  GtkWidget *sketch = model != NULL ? sb_param_sketch_new(model, id) : NULL;
  if (sketch != NULL) {
    sb_style_name(sketch, _("Sketch"), sb_translation(param->label));
    gtk_container_add(GTK_CONTAINER(box), sketch);
  }
  GtkWidget *grid = gtk_grid_new();
  gtk_grid_set_column_spacing(GTK_GRID(grid), 14);
  gtk_grid_set_row_spacing(GTK_GRID(grid), 6);
  gtk_container_add(GTK_CONTAINER(box), grid);
  int line = 0;
  add(GTK_GRID(grid), &line, _("Key"), param->symbol[0] != '\0' ? key : param->key);
  add(GTK_GRID(grid), &line, _("Value"), now);
  add(GTK_GRID(grid), &line, _("Default"), from);
  add(GTK_GRID(grid), &line, _("Source"), source);
  add(GTK_GRID(grid), &line, _("Range"), range);
  if (equation != NULL) {
    add(GTK_GRID(grid), &line, _("Equation"), equation->equation);
    add(GTK_GRID(grid), &line, _("From"), equation->source);
    add(GTK_GRID(grid), &line, _("Code"), equation->room);
  }
  g_signal_connect(popover, "closed", G_CALLBACK(gtk_widget_destroy), NULL);
  gtk_widget_show_all(box);
  gtk_popover_popup(GTK_POPOVER(popover));
}
