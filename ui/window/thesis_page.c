// Tables and figures of the thesis. What is shown is the text of `sealbench thesis ITEM` and its
// chart; the earlier one stays until the next is computed.
#include "ui/window/thesis_page.h"

#include "app/base/translation.h"
#include "app/base/unit.h"
#include "app/chart/study.h"
#include "app/export/thesis_results.h"
#include "ui/views/draw_cache.h"
#include "ui/views/style.h"
#include "ui/views/toolbar.h"

#include <glib/gi18n.h>
#include <math.h>

typedef struct {
  GtkWidget *box, *item, *stop, *message, *area, *text;
  SbDrawCache *cache;
  char **items;        // name, title and so on
  SbThesisItem *shown; // NULL: none yet
  GCancellable *job;   // of what is computed; NULL: nothing
  gboolean begun;
} ThesisPage;

// What the thread is given and gives back.
typedef struct {
  char *name;
  GCancellable *job; // a reference
  GPtrArray *issues;
} Asked;

static void asked_free(gpointer data) {
  Asked *asked = data;
  g_free(asked->name);
  g_object_unref(asked->job);
  g_ptr_array_unref(asked->issues);
  g_free(asked);
}

static bool is_cancelled(void *data) {
  return g_cancellable_is_cancelled(data);
}

static void compute_thesis(GTask *task, gpointer source, gpointer data, GCancellable *cancellable) {
  Asked *asked = data;
  const int threads = MAX((int)g_get_num_processors() - 1, 1);
  SbThesisItem *item =
      sb_thesis_compute(asked->name, threads, NULL, is_cancelled, asked->job, asked->issues);
  g_task_return_pointer(task, item, (GDestroyNotify)sb_thesis_item_free);
}

// State to widgets -------------------------------------------------------------------------------

static void draw_thesis(cairo_t *cr, double width, double height, void *data) {
  const ThesisPage *page = data;
  const SbTheme *theme = sb_style_ground(cr, SB_ROLE_BACKGROUND);
  if (page->shown != NULL && page->shown->chart != NULL) {
    sb_study_draw(cr, (SbRect){12, 12, width - 24, height - 24}, theme, page->shown->chart);
  }
}

// The curves' names and ends, for people who do not see them. Owned by the caller.
static char *curves_text(const SbStudy *chart) {
  GString *out = g_string_new(NULL);
  for (size_t p = 0; p < chart->panel_count; p++) {
    for (size_t i = 0; i < chart->panel[p].series_count; i++) {
      const SbStudySeries *series = &chart->panel[p].series[i];
      char digits[2][SB_NUMBER_SIZE];
      const SbStudyAxis *axis = &chart->panel[p].y;
      const double first = series->count > 0 ? series->y[0] : NAN;
      const double last = series->count > 0 ? series->y[series->count - 1] : NAN;
      g_string_append_printf(
          out, "%s: %s %s \342\200\246 %s %s\n", series->name, axis->quantity,
          sb_number_round(digits[0], sb_quantity_to_shown(first, axis->si, axis->unit), 3),
          sb_number_round(digits[1], sb_quantity_to_shown(last, axis->si, axis->unit), 3),
          axis->unit);
    }
  }
  return g_string_free(out, FALSE);
}

static void show_thesis(ThesisPage *page, const char *message) {
  g_autofree char *table = page->shown != NULL ? sb_thesis_table(page->shown) : g_strdup("");
  gtk_label_set_text(GTK_LABEL(page->message), message);
  gtk_label_set_text(GTK_LABEL(page->text), table);
  gtk_widget_set_visible(page->area, page->shown != NULL && page->shown->chart != NULL);
  gtk_widget_set_sensitive(page->stop, page->job != NULL);
  if (page->shown != NULL && page->shown->chart != NULL) {
    g_autofree char *words = curves_text(page->shown->chart);
    sb_style_name(page->area, page->shown->title, words);
  }
  sb_draw_cache_change(page->cache, 0);
}

static void on_computed(GObject *source, GAsyncResult *result, gpointer data) {
  ThesisPage *page = data;
  const Asked *asked = g_task_get_task_data(G_TASK(result));
  SbThesisItem *item = g_task_propagate_pointer(G_TASK(result), NULL);
  if (page->job != asked->job) {
    sb_thesis_item_free(item); // another one was chosen meanwhile, or the page is gone
    return;
  }
  g_clear_object(&page->job);
  g_autofree char *message = g_strdup("");
  if (item != NULL) {
    sb_thesis_item_free(page->shown);
    page->shown = item;
  } else if (asked->issues->len > 0) {
    g_free(message);
    message = sb_issue_line(asked->issues->pdata[0]);
  }
  show_thesis(page, message);
}

// Acts --------------------------------------------------------------------------------------------

static void end_thesis_job(ThesisPage *page) {
  if (page->job != NULL) {
    g_cancellable_cancel(page->job);
    g_clear_object(&page->job);
  }
}

static void start_thesis(ThesisPage *page) {
  const int at = gtk_combo_box_get_active(GTK_COMBO_BOX(page->item));
  if (!page->begun || at < 0 || page->items == NULL) {
    return;
  }
  end_thesis_job(page);
  page->job = g_cancellable_new();
  Asked *asked = g_new0(Asked, 1);
  asked->name = g_strdup(page->items[2 * at]);
  asked->job = g_object_ref(page->job);
  asked->issues = sb_issues_new();
  GTask *task = g_task_new(page->box, NULL, on_computed, page); // holds the box, and so the page
  g_task_set_task_data(task, asked, asked_free);
  g_task_run_in_thread(task, compute_thesis);
  g_object_unref(task);
  show_thesis(page, _("Computing…"));
}

static void on_map(GtkWidget *widget, ThesisPage *page) {
  if (!page->begun) {
    page->begun = TRUE;
    start_thesis(page);
  }
}

static void on_thesis_stop(GtkWidget *button, ThesisPage *page) {
  end_thesis_job(page);
  show_thesis(page, "");
}

// Life --------------------------------------------------------------------------------------------

static void on_thesis_destroy(GtkWidget *widget, ThesisPage *page) {
  end_thesis_job(page);
}

static void thesis_page_free(gpointer data) {
  ThesisPage *page = data;
  sb_thesis_item_free(page->shown);
  g_strfreev(page->items);
  g_free(page);
}

static void add_thesis_toolbar(ThesisPage *page) {
  GtkWidget *bar = gtk_box_new(GTK_ORIENTATION_HORIZONTAL, 8);
  sb_style_class(bar, "sb-toolbar");
  g_autoptr(GPtrArray) titles = g_ptr_array_new();
  for (char **item = page->items; item != NULL && *item != NULL; item += 2) {
    g_ptr_array_add(titles, item[1]);
  }
  page->item =
      sb_toolbar_combo(GTK_BOX(bar), (const char *const *)titles->pdata, (int)titles->len,
                       _("Table or figure"), _("Table or figure of the thesis, recomputed"));
  // Titles are long; the page asks for no more width than others do.
  g_autoptr(GList) cells = gtk_cell_layout_get_cells(GTK_CELL_LAYOUT(page->item));
  for (GList *cell = cells; cell != NULL; cell = cell->next) {
    g_object_set(cell->data, "ellipsize", PANGO_ELLIPSIZE_END, "width-chars", 30, NULL);
  }
  gtk_combo_box_set_active(GTK_COMBO_BOX(page->item), 0);
  g_signal_connect_swapped(page->item, "changed", G_CALLBACK(start_thesis), page);
  page->message = sb_style_label(NULL, "sb-warn", 0);
  gtk_label_set_ellipsize(GTK_LABEL(page->message), PANGO_ELLIPSIZE_END);
  gtk_box_pack_start(GTK_BOX(bar), page->message, TRUE, TRUE, 0);
  page->stop = gtk_button_new_with_label(_("Cancel"));
  gtk_widget_set_tooltip_text(page->stop, _("Stop computing; the results so far remain"));
  g_signal_connect(page->stop, "clicked", G_CALLBACK(on_thesis_stop), page);
  gtk_box_pack_end(GTK_BOX(bar), page->stop, FALSE, FALSE, 0);
  gtk_box_pack_start(GTK_BOX(page->box), bar, FALSE, FALSE, 0);
  gtk_widget_show_all(bar);
}

static void add_result(ThesisPage *page) {
  page->area = gtk_drawing_area_new();
  sb_style_class(page->area, "sb-canvas");
  gtk_widget_set_size_request(page->area, 480, 260);
  atk_object_set_role(gtk_widget_get_accessible(page->area), ATK_ROLE_CHART);
  page->cache = sb_draw_cache_attach(page->area, draw_thesis, page);
  gtk_box_pack_start(GTK_BOX(page->box), page->area, TRUE, TRUE, 0);
  GtkWidget *scrolled = gtk_scrolled_window_new(NULL, NULL);
  page->text = gtk_label_new(NULL);
  gtk_label_set_selectable(GTK_LABEL(page->text), TRUE);
  gtk_label_set_xalign(GTK_LABEL(page->text), 0);
  gtk_label_set_yalign(GTK_LABEL(page->text), 0);
  gtk_style_context_add_class(gtk_widget_get_style_context(page->text), "monospace");
  sb_style_name(page->text, _("Printed and computed values"), NULL);
  gtk_container_add(GTK_CONTAINER(scrolled), page->text);
  gtk_box_pack_start(GTK_BOX(page->box), scrolled, TRUE, TRUE, 0);
  gtk_widget_show_all(scrolled);
}

GtkWidget *sb_thesis_page_new(void) {
  ThesisPage *page = g_new0(ThesisPage, 1);
  page->box = gtk_box_new(GTK_ORIENTATION_VERTICAL, 0);
  page->items = sb_thesis_items();
  g_object_set_data_full(G_OBJECT(page->box), "page", page, thesis_page_free);
  add_thesis_toolbar(page);
  add_result(page);
  g_signal_connect(page->box, "destroy", G_CALLBACK(on_thesis_destroy), page);
  g_signal_connect(page->box, "map", G_CALLBACK(on_map), page);
  gtk_widget_show(page->box);
  show_thesis(page, "");
  return page->box;
}
