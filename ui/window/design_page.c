// The page Design. See the header. The question is app/session/design_ask.h, its answer comes from
// design_job.h, pictures are those of app/chart/design.h.
#include "ui/window/design_page.h"

#include "app/base/translation.h"
#include "app/export/design_text.h"
#include "app/session/kept_store.h"
#include "app/session/worker.h"
#include "ui/views/style.h"
#include "ui/window/design_limits.h"
#include "ui/window/design_page_private.h"
#include "ui/window/verdict_strip.h"

#include <glib/gi18n.h>

enum { NARROW = 1180, SIDE_WIDTH = 540, POLL_MS = 120 };

static void compute(SbDesignPage *page, gboolean search);

// Looking -----------------------------------------------------------------------------------------

const SbDesignAnswer *sb_design_page_answer(SbDesignPage *page) {
  return page->job != NULL ? sb_design_job_lock(page->job) : page->answer;
}

void sb_design_page_release(SbDesignPage *page) {
  if (page->job != NULL) {
    sb_design_job_unlock(page->job);
  }
}

static gboolean is_former(const SbDesignPage *page) {
  if (page->job != NULL || page->answer == NULL) {
    return FALSE;
  }
  g_autofree char *now = sb_document_sha256(sb_session_document(page->session));
  return g_strcmp0(now, page->hash) != 0;
}

static void draw_design(SbDesignPage *page, SbDesignPageArea area, cairo_t *cr, double width,
                        double height) {
  const SbTheme *theme = sb_style_ground(cr, SB_ROLE_PANEL);
  const SbDesignAnswer *answer = sb_design_page_answer(page);
  const SbRect all = {0, 0, width, height};
  if (answer != NULL && area == SB_DESIGN_AREA_MAP) {
    sb_design_map_draw(cr, all, theme, answer, &page->look);
  } else if (answer != NULL && area == SB_DESIGN_AREA_TORNADO) {
    sb_design_tornado_draw(cr, all, theme, answer, page->chosen);
  } else if (answer != NULL) {
    sb_design_scatter_draw(cr, all, theme, answer);
  }
  sb_design_page_release(page);
}

static void draw_map(cairo_t *cr, double width, double height, void *data) {
  draw_design(data, SB_DESIGN_AREA_MAP, cr, width, height);
}

static void draw_tornado(cairo_t *cr, double width, double height, void *data) {
  draw_design(data, SB_DESIGN_AREA_TORNADO, cr, width, height);
}

static void draw_scatter(cairo_t *cr, double width, double height, void *data) {
  draw_design(data, SB_DESIGN_AREA_SCATTER, cr, width, height);
}

void sb_design_page_say(SbDesignPage *page, const char *text) {
  gtk_label_set_text(GTK_LABEL(page->message), text);
}

// State to widgets --------------------------------------------------------------------------------

void sb_design_page_redraw(SbDesignPage *page) {
  for (int area = 0; area < SB_DESIGN_AREAS; area++) {
    sb_draw_cache_change(page->cache[area], page->job != NULL ? 200 : 0);
  }
}

void sb_design_page_refresh(SbDesignPage *page) {
  const gboolean busy = page->job != NULL;
  const gboolean possible = sb_session_model(page->session) != NULL;
  page->refreshing = TRUE;
  gtk_widget_set_visible(page->progress, busy);
  gtk_widget_set_visible(page->pause, busy);
  gtk_widget_set_visible(page->stop, busy);
  gtk_widget_set_visible(page->find, !busy);
  gtk_widget_set_visible(page->map_again, !busy && !page->ask.closed);
  gtk_widget_set_sensitive(page->find, possible);
  gtk_widget_set_sensitive(page->map_again, possible);
  const SbDesignAnswer *answer = sb_design_page_answer(page);
  sb_design_limits_show(page->limits, &page->ask, answer, page->chosen);
  for (size_t i = 0; i < SB_DESIGN_LINES; i++) {
    const gboolean there = answer != NULL && i < answer->map.figures;
    gtk_widget_set_visible(page->lines[i], there);
    if (there) {
      const SbFigure *of = sb_figure(g_array_index(answer->study->figures, int, i));
      gtk_button_set_label(GTK_BUTTON(page->lines[i]), sb_translation(of->label));
    }
  }
  g_autofree char *picked = sb_design_page_picked_text(page, answer);
  gtk_label_set_text(GTK_LABEL(page->picked), picked);
  g_autofree char *told = sb_design_page_models_text(page, answer);
  gtk_label_set_text(GTK_LABEL(page->told), told);
  gtk_widget_set_tooltip_text(page->told, told);
  const gboolean best = answer != NULL && answer->place[SB_DESIGN_BEST].known;
  const gboolean picks = answer != NULL && page->look.picked;
  gtk_widget_set_sensitive(page->open, picks);
  gtk_widget_set_sensitive(page->pin, picks);
  gtk_widget_set_sensitive(page->use_best, best);
  g_autofree char *text =
      answer != NULL ? sb_design_text(answer) : g_strdup(_("Nothing is computed yet."));
  sb_style_name(page->area[SB_DESIGN_AREA_MAP], _("Map of the design"), text);
  sb_design_page_release(page);
  sb_style_former(page->area[SB_DESIGN_AREA_MAP], is_former(page));
  page->refreshing = FALSE;
  sb_design_page_redraw(page);
}

// Not of a page that nobody looks at: an edit has other things to do.
static void refresh_seen(SbDesignPage *page) {
  if (gtk_widget_get_mapped(page->box)) {
    sb_design_page_refresh(page);
  }
}

// The question ------------------------------------------------------------------------------------

static void end_design_job(SbDesignPage *page) {
  sb_later_cancel(&page->poll);
  g_clear_pointer(&page->job, sb_design_job_free);
}

static void on_design_poll(gpointer data) {
  SbDesignPage *page = data;
  gtk_progress_bar_set_fraction(GTK_PROGRESS_BAR(page->progress), sb_worker_progress(page->job));
  const SbDesignPart part = sb_design_job_part(page->job);
  sb_design_page_say(page, gtk_toggle_button_get_active(GTK_TOGGLE_BUTTON(page->pause))
                               ? _("Paused")
                               : sb_design_part_text(part));
  // What is drawn anew for nothing keeps the loop from its other work.
  const size_t done = sb_design_job_lock(page->job)->map.done;
  sb_design_job_unlock(page->job);
  if (done != page->shown_done || part != page->shown_part) {
    page->shown_done = done;
    page->shown_part = part;
    sb_design_page_refresh(page);
  }
}

// Shows what marks the best design below the sentence: bounds that it is on, and its warnings of
// validity. NULL: nothing.
static void show_marks(SbDesignPage *page, const SbDesignAnswer *answer) {
  g_autofree char *text = answer != NULL ? sb_design_marks_text(answer) : NULL;
  gtk_label_set_text(GTK_LABEL(page->marks), text != NULL ? text : "");
  gtk_widget_set_visible(page->marks, text != NULL);
}

static void on_design_done(void *data) {
  SbDesignPage *page = data;
  g_autofree char *why = NULL;
  SbDesignAnswer *answer = sb_design_job_take(page->job, &why);
  end_design_job(page);
  sb_design_answer_free(page->answer);
  page->answer = answer;
  g_autofree char *text = sb_design_end_text(answer, why);
  sb_design_page_say(page, text);
  show_marks(page, answer);
  sb_design_page_refresh(page);
}

static void compute(SbDesignPage *page, gboolean search) {
  const SbDocument *document = sb_session_document(page->session);
  g_autoptr(GPtrArray) issues = sb_issues_new();
  end_design_job(page);
  SbStudyFile *study = sb_design_ask_study(&page->ask, document, issues);
  if (study == NULL) {
    g_autofree char *line = issues->len > 0 ? sb_issue_line(issues->pdata[0]) : g_strdup("");
    sb_design_page_say(page, line);
    sb_design_page_refresh(page);
    return;
  }
  if (page->store == NULL) {
    page->store = sb_kept_store_open();
  }
  g_free(page->hash);
  page->hash = sb_document_sha256(document);
  show_marks(page, NULL);
  page->look.picked = FALSE;
  page->refreshing = TRUE;
  gtk_toggle_button_set_active(GTK_TOGGLE_BUTTON(page->pause), FALSE);
  page->refreshing = FALSE;
  gtk_progress_bar_set_fraction(GTK_PROGRESS_BAR(page->progress), 0);
  page->job = sb_design_job_start(study, &page->ask, page->store, search, on_design_done, page);
  sb_later_repeat(&page->poll, page->box, POLL_MS, on_design_poll, page);
  sb_design_page_refresh(page);
}

void sb_design_page_asked(SbDesignPage *page) {
  if (page->ask.closed) {
    compute(page, FALSE);
  } else {
    end_design_job(page);
    sb_design_page_say(page, _("The inputs have changed: compute the map again."));
    sb_design_page_refresh(page);
  }
}

static void on_later(gpointer data) {
  SbDesignPage *page = data;
  if (page->answer == NULL || is_former(page)) {
    sb_design_page_asked(page);
  }
}

// Another document has its own question; other values another map.
static void follow(SbDesignPage *page) {
  const SbDocument *document = sb_session_document(page->session);
  const SbParams params = sb_document_params(document);
  const int kind = (int)sb_params_get(&params, SB_P_VALVE_KIND);
  if (document != page->document || kind != page->kind) {
    page->document = document;
    page->kind = kind;
    sb_design_ask_init(&page->ask, document);
    page->chosen = sb_figure_find("cycle.force_return_margin_N");
    end_design_job(page);
    g_clear_pointer(&page->answer, sb_design_answer_free);
    page->look.picked = FALSE;
    sb_design_page_show_form(page);
  }
  if (gtk_widget_get_mapped(page->box) && sb_session_model(page->session) != NULL &&
      page->job == NULL) {
    sb_later_ensure(&page->later, page->box, 50, on_later, page);
  }
  refresh_seen(page);
}

// Actions -----------------------------------------------------------------------------------------

static void on_limited(void *data, int figure, double low, double high) {
  SbDesignPage *page = data;
  for (size_t i = 0; i < page->ask.limits.count; i++) {
    const SbLimit *limit = &page->ask.limits.item[i];
    if (limit->figure == figure && limit->low == low && limit->high == high) {
      return; // left as it was
    }
  }
  sb_design_ask_limit(&page->ask, figure, low, high);
  sb_design_page_asked(page);
}

static void on_chosen(void *data, int figure) {
  SbDesignPage *page = data;
  page->chosen = figure;
  sb_design_page_refresh(page);
}

static void on_find(GtkButton *button, SbDesignPage *page) {
  compute(page, TRUE);
}

static void on_map_again(GtkButton *button, SbDesignPage *page) {
  compute(page, FALSE);
}

static void on_pause(GtkToggleButton *button, SbDesignPage *page) {
  if (page->job != NULL && !page->refreshing) {
    sb_design_job_pause(page->job, gtk_toggle_button_get_active(button));
  }
}

static void on_design_stop(GtkButton *button, SbDesignPage *page) {
  if (page->job != NULL) {
    sb_design_job_cancel(page->job);
  }
}

// Layout ------------------------------------------------------------------------------------------

static void on_side(GtkToggleButton *button, SbDesignPage *page) {
  gtk_widget_set_visible(page->side, gtk_toggle_button_get_active(button));
}

static void on_room(gpointer data) {
  SbDesignPage *page = data;
  gtk_widget_set_visible(page->side_button, page->narrow);
  gtk_toggle_button_set_active(GTK_TOGGLE_BUTTON(page->side_button), !page->narrow);
  gtk_widget_set_visible(page->side, !page->narrow);
}

// Where there is no room for both, limits and scatter come on request.
static void on_allocate(GtkWidget *widget, GdkRectangle *allocation, SbDesignPage *page) {
  const gboolean narrow = allocation->width < NARROW;
  if (narrow != page->narrow) {
    page->narrow = narrow;
    sb_later_ensure(&page->room, page->box, 0, on_room, page);
  }
}

GtkWidget *sb_design_page_add_button(GtkBox *bar, const char *label, const char *tip,
                                     GCallback call, SbDesignPage *page) {
  GtkWidget *button = gtk_button_new_with_label(label);
  gtk_widget_set_tooltip_text(button, tip);
  g_signal_connect(button, "clicked", call, page);
  gtk_box_pack_start(bar, button, FALSE, FALSE, 0);
  return button;
}

static void add_design_toolbar(SbDesignPage *page, GtkBox *to) {
  GtkBox *bar = GTK_BOX(gtk_box_new(GTK_ORIENTATION_HORIZONTAL, 8));
  sb_style_class(GTK_WIDGET(bar), "sb-toolbar");
  sb_design_page_add_axes(page, bar);
  gtk_box_pack_start(bar, gtk_label_new(NULL), TRUE, TRUE, 0);
  page->progress = gtk_progress_bar_new();
  gtk_widget_set_valign(page->progress, GTK_ALIGN_CENTER);
  sb_style_name(page->progress, _("Progress of the design"), NULL);
  gtk_box_pack_start(bar, page->progress, FALSE, FALSE, 0);
  page->pause = gtk_toggle_button_new_with_label(_("Pause"));
  g_signal_connect(page->pause, "toggled", G_CALLBACK(on_pause), page);
  gtk_box_pack_start(bar, page->pause, FALSE, FALSE, 0);
  page->stop = sb_design_page_add_button(bar, _("Cancel"), _("Stop and keep the results so far"),
                                         G_CALLBACK(on_design_stop), page);
  page->map_again =
      sb_design_page_add_button(bar, _("Compute map"), _("Uses the valve's own models: slower"),
                                G_CALLBACK(on_map_again), page);
  page->find = sb_design_page_add_button(
      bar, _("Find best"),
      _("The best valve within bounds and limits, from eight starts; then "
        "tolerances and valves drawn from them"),
      G_CALLBACK(on_find), page);
  // Where the bar is cut, what the page is for stays.
  gtk_box_reorder_child(bar, page->find, 0);
  page->side_button = gtk_toggle_button_new_with_label(_("Limits"));
  g_signal_connect(page->side_button, "toggled", G_CALLBACK(on_side), page);
  gtk_box_pack_start(bar, page->side_button, FALSE, FALSE, 0);
  GtkWidget *room = gtk_scrolled_window_new(NULL, NULL);
  gtk_scrolled_window_set_policy(GTK_SCROLLED_WINDOW(room), GTK_POLICY_AUTOMATIC, GTK_POLICY_NEVER);
  gtk_container_add(GTK_CONTAINER(room), GTK_WIDGET(bar));
  gtk_box_pack_start(to, room, FALSE, FALSE, 0);
}

static GtkWidget *add_area(SbDesignPage *page, SbDesignPageArea area, GtkBox *to,
                           SbDrawCacheDraw call, int height, const char *name) {
  GtkWidget *widget = page->area[area] = gtk_drawing_area_new();
  sb_style_class(widget, "sb-canvas");
  gtk_widget_set_size_request(widget, 300, height);
  sb_style_name(widget, name, NULL);
  atk_object_set_role(gtk_widget_get_accessible(widget), ATK_ROLE_CHART);
  page->cache[area] = sb_draw_cache_attach(widget, call, page);
  gtk_box_pack_start(to, widget, TRUE, TRUE, 0);
  return widget;
}

static GtkWidget *make_side(SbDesignPage *page) {
  GtkBox *side = GTK_BOX(gtk_box_new(GTK_ORIENTATION_VERTICAL, 6));
  sb_design_page_add_question(page, side);
  page->message = sb_style_label(NULL, "sb-row-label", 0);
  gtk_label_set_ellipsize(GTK_LABEL(page->message), PANGO_ELLIPSIZE_END);
  gtk_box_pack_start(side, page->message, FALSE, FALSE, 0);
  page->marks = sb_style_label(NULL, "sb-row-label", 0);
  gtk_label_set_line_wrap(GTK_LABEL(page->marks), TRUE);
  gtk_label_set_line_wrap_mode(GTK_LABEL(page->marks), PANGO_WRAP_WORD_CHAR);
  gtk_widget_set_no_show_all(page->marks, TRUE);
  gtk_box_pack_start(side, page->marks, FALSE, FALSE, 0);
  const SbDesignLimitsHooks hooks = {on_limited, on_chosen, page};
  page->limits = sb_design_limits_new(&hooks);
  gtk_box_pack_start(side, page->limits, FALSE, FALSE, 0);
  gtk_box_pack_start(side, gtk_separator_new(GTK_ORIENTATION_HORIZONTAL), FALSE, FALSE, 0);
  add_area(page, SB_DESIGN_AREA_TORNADO, side, draw_tornado, 150, _("Which tolerance matters"));
  gtk_box_pack_start(side, gtk_separator_new(GTK_ORIENTATION_HORIZONTAL), FALSE, FALSE, 0);
  add_area(page, SB_DESIGN_AREA_SCATTER, side, draw_scatter, 150,
           _("Valves drawn from the tolerances"));
  sb_style_class(GTK_WIDGET(side), "sb-design-side");
  GtkWidget *room = gtk_scrolled_window_new(NULL, NULL);
  gtk_scrolled_window_set_policy(GTK_SCROLLED_WINDOW(room), GTK_POLICY_NEVER, GTK_POLICY_AUTOMATIC);
  gtk_container_add(GTK_CONTAINER(room), GTK_WIDGET(side));
  gtk_widget_set_size_request(room, SIDE_WIDTH, -1);
  gtk_widget_set_hexpand(room, FALSE); // its names would have it
  return room;
}

// Life --------------------------------------------------------------------------------------------

static void on_design_destroy(GtkWidget *widget, SbDesignPage *page) {
  end_design_job(page);
  if (page->session != NULL) {
    g_signal_handlers_disconnect_by_data(page->session, page);
    g_clear_object(&page->session);
  }
}

static void design_page_free(gpointer data) {
  SbDesignPage *page = data;
  sb_design_answer_free(page->answer);
  sb_store_close(page->store, NULL);
  g_free(page->hash);
  g_free(page);
}

GtkWidget *sb_design_page_new(SbSession *session) {
  SbDesignPage *page = g_new0(SbDesignPage, 1);
  page->session = g_object_ref(session);
  page->box = gtk_box_new(GTK_ORIENTATION_VERTICAL, 0);
  g_object_set_data_full(G_OBJECT(page->box), "page", page, design_page_free);
  sb_design_ask_init(&page->ask, sb_session_document(session));
  page->chosen = page->ask.goal;
  GtkBox *main = GTK_BOX(gtk_box_new(GTK_ORIENTATION_VERTICAL, 0));
  page->side = make_side(page);
  add_design_toolbar(page, main);
  GtkWidget *map = add_area(page, SB_DESIGN_AREA_MAP, main, draw_map, 320, _("Map of the design"));
  gtk_widget_set_can_focus(map, TRUE);
  gtk_widget_add_events(map, GDK_BUTTON_PRESS_MASK | GDK_KEY_PRESS_MASK);
  sb_design_page_listen(page, map);
  sb_design_page_add_picked(page, main);
  // The window may be narrower than both need.
  GtkWidget *columns = gtk_paned_new(GTK_ORIENTATION_HORIZONTAL);
  gtk_paned_pack1(GTK_PANED(columns), GTK_WIDGET(main), TRUE, FALSE);
  gtk_paned_pack2(GTK_PANED(columns), page->side, FALSE, TRUE);
  gtk_box_pack_start(GTK_BOX(page->box), sb_verdict_strip_new(session), FALSE, FALSE, 0);
  gtk_box_pack_start(GTK_BOX(page->box), columns, TRUE, TRUE, 0);
  gtk_widget_show_all(page->box);
  gtk_widget_set_visible(page->side_button, FALSE);
  g_signal_connect(page->box, "size-allocate", G_CALLBACK(on_allocate), page);
  g_signal_connect(page->box, "destroy", G_CALLBACK(on_design_destroy), page);
  g_signal_connect_swapped(page->box, "map", G_CALLBACK(follow), page);
  g_signal_connect_swapped(session, "params-changed", G_CALLBACK(follow), page);
  g_signal_connect_swapped(session, "run-changed", G_CALLBACK(refresh_seen), page);
  sb_design_page_show_form(page);
  sb_design_page_refresh(page);
  return page->box;
}
