// See chart_column.h. The switch is there as long as something is compared with, and goes to the
// table when the first design is kept.
#include "ui/views/chart_column.h"

#include "ui/views/chart_view.h"
#include "ui/views/signals.h"
#include "ui/views/style.h"

#include <glib/gi18n.h>

typedef struct {
  SbSession *session;
  GtkWidget *stack, *row;
  size_t pins; // when it was last looked at
} Column;

static void on_change(Column *column) {
  const size_t pins = sb_session_pin_count(column->session);
  const gboolean compares = pins > 0 || sb_session_chart(column->session)->measured != NULL;
  gtk_widget_set_visible(column->row, compares);
  if (pins > 0 && column->pins == 0) {
    gtk_stack_set_visible_child_name(GTK_STACK(column->stack), "table");
  } else if (!compares) {
    gtk_stack_set_visible_child_name(GTK_STACK(column->stack), "curves");
  }
  column->pins = pins;
}

void sb_chart_column_add(GtkBox *box, SbSession *session, SbChartViewKind kind, gboolean expands) {
  GtkWidget *chart = sb_chart_view_new(session, kind);
  if (kind != SB_CHART_VIEW_LOOP) {
    GtkWidget *line = gtk_separator_new(GTK_ORIENTATION_HORIZONTAL);
    g_object_bind_property(chart, "visible", line, "visible", G_BINDING_SYNC_CREATE);
    gtk_box_pack_start(box, line, FALSE, FALSE, 0);
  }
  gtk_box_pack_start(box, chart, expands, TRUE, 0);
}

void sb_chart_column_fill(GtkBox *box, SbSession *session) {
  Column *column = g_new0(Column, 1);
  column->session = session;
  sb_chart_column_add(box, session, SB_CHART_VIEW_LOOP, TRUE);
  column->stack = gtk_stack_new();
  gtk_stack_set_vhomogeneous(GTK_STACK(column->stack), FALSE);
  GtkWidget *curves = gtk_box_new(GTK_ORIENTATION_VERTICAL, 0);
  sb_chart_column_add(GTK_BOX(curves), session, SB_CHART_VIEW_PRESSURE, FALSE);
  sb_chart_column_add(GTK_BOX(curves), session, SB_CHART_VIEW_FILM, FALSE);
  GtkWidget *table = gtk_box_new(GTK_ORIENTATION_VERTICAL, 0);
  sb_chart_column_add(GTK_BOX(table), session, SB_CHART_VIEW_COMPARE, TRUE);
  gtk_widget_show(curves);
  gtk_widget_show(table);
  gtk_stack_add_titled(GTK_STACK(column->stack), curves, "curves", _("Contacts"));
  gtk_stack_add_titled(GTK_STACK(column->stack), table, "table", _("Compare"));
  GtkWidget *switcher = gtk_stack_switcher_new();
  gtk_stack_switcher_set_stack(GTK_STACK_SWITCHER(switcher), GTK_STACK(column->stack));
  gtk_widget_set_halign(switcher, GTK_ALIGN_END);
  column->row = gtk_box_new(GTK_ORIENTATION_VERTICAL, 0);
  sb_style_class(column->row, "sb-switch");
  gtk_box_pack_start(GTK_BOX(column->row), switcher, FALSE, FALSE, 0);
  gtk_widget_show_all(column->row);
  gtk_widget_show(column->stack);
  gtk_box_pack_start(box, column->row, FALSE, FALSE, 0);
  gtk_box_pack_start(box, column->stack, FALSE, TRUE, 0);
  g_object_set_data_full(G_OBJECT(column->stack), "column", column, g_free);
  sb_signals_end_with(column->stack, column->session, column);
  g_signal_connect_swapped(session, "run-changed", G_CALLBACK(on_change), column);
  on_change(column);
}
