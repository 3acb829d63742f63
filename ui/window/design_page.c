// The page Design. See the header. The question is app/session/design_ask.h, its answer comes from
// design_job.h, pictures are those of app/chart/design.h.
#include "ui/window/design_page.h"

#include "app/base/device.h"
#include "app/base/figure_text.h"
#include "app/base/translation.h"
#include "app/export/design_map.h"
#include "app/session/design_job.h"
#include "app/session/kept_store.h"
#include "app/session/worker.h"
#include "ui/views/draw_cache.h"
#include "ui/views/later.h"
#include "ui/views/style.h"
#include "ui/views/toolbar.h"
#include "ui/window/design_limits.h"
#include "ui/window/design_ranges.h"
#include "ui/window/toast.h"
#include "ui/window/verdict_strip.h"

#include <glib/gi18n.h>
#include <math.h>
#include <string.h>

enum { NARROW = 1180, SIDE_WIDTH = 540, POLL_MS = 120, GOALS_MAX = 64 };

typedef enum { AREA_MAP, AREA_TORNADO, AREA_SCATTER, AREAS } Area;

typedef struct {
  SbSession *session; // owned reference
  SbDesignAsk ask;
  GtkWidget *box, *axis[2], *lines[SB_DESIGN_LINES], *goal, *models, *ranges, *area[AREAS], *limits,
      *side, *side_button, *progress, *pause, *stop, *map_again, *find, *message, *marks;
  GtkWidget *picked, *told, *open, *pin, *use_best;
  int kind; // of the valve
  SbDrawCache *cache[AREAS];
  SbDesignJob *job;
  SbDesignAnswer *answer; // the last one; NULL before
  SbStore *store;
  SbDesignLook look;
  int chosen; // figure of the bars
  int goals[GOALS_MAX];
  size_t goal_count;
  SbLater poll, later, room;
  char *hash;                 // of the values that the answer is of
  const SbDocument *document; // whose question it is; compared only
  gboolean narrow, refreshing;
  size_t shown_done; // of the job's map, when it was drawn last
  SbDesignPart shown_part;
} Page;

static void compute(Page *page, gboolean search);

// Looking -----------------------------------------------------------------------------------------

// The answer to draw: that under way, else the last. To be given back.
static const SbDesignAnswer *look_at(Page *page) {
  return page->job != NULL ? sb_design_job_lock(page->job) : page->answer;
}

static void look_away(Page *page) {
  if (page->job != NULL) {
    sb_design_job_unlock(page->job);
  }
}

static gboolean is_former(const Page *page) {
  if (page->job != NULL || page->answer == NULL) {
    return FALSE;
  }
  g_autofree char *now = sb_document_sha256(sb_session_document(page->session));
  return g_strcmp0(now, page->hash) != 0;
}

static void draw(Page *page, Area area, cairo_t *cr, double width, double height) {
  const SbTheme *theme = sb_style_ground(cr, SB_ROLE_PANEL);
  const SbDesignAnswer *answer = look_at(page);
  const SbRect all = {0, 0, width, height};
  if (answer != NULL && area == AREA_MAP) {
    sb_design_map_draw(cr, all, theme, answer, &page->look);
  } else if (answer != NULL && area == AREA_TORNADO) {
    sb_design_tornado_draw(cr, all, theme, answer, page->chosen);
  } else if (answer != NULL) {
    sb_design_scatter_draw(cr, all, theme, answer);
  }
  look_away(page);
}

static void draw_map(cairo_t *cr, double width, double height, void *data) {
  draw(data, AREA_MAP, cr, width, height);
}

static void draw_tornado(cairo_t *cr, double width, double height, void *data) {
  draw(data, AREA_TORNADO, cr, width, height);
}

static void draw_scatter(cairo_t *cr, double width, double height, void *data) {
  draw(data, AREA_SCATTER, cr, width, height);
}

static void say(Page *page, const char *text) {
  gtk_label_set_text(GTK_LABEL(page->message), text);
}

// "1.47 × 1.32 mm: break-away force 24.8 N, ..." of the picked point.
static char *picked_text(const Page *page, const SbDesignAnswer *answer) {
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
    g_autofree char *shown = sb_design_value_text(figure, value);
    g_string_append_printf(text, "%s%s %s", i > 0 ? ", " : "", label, shown);
  }
  return g_string_free(text, FALSE);
}

// By which models the map is, and how far they are from the shown run at the present design.
static char *told_text(Page *page, const SbDesignAnswer *answer) {
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
    g_autofree char *here =
        sb_design_value_text(figure, answer->place[SB_DESIGN_PRESENT].figure[i]);
    char there[SB_FORMAT_MAX];
    sb_format_figure(there, summary, figure);
    g_string_append_printf(text, "%s %s %s, %s", i > 0 ? ";" : "", label, here, there);
  }
  return g_string_free(text, FALSE);
}

// State to widgets --------------------------------------------------------------------------------

static void redraw(Page *page) {
  for (int area = 0; area < AREAS; area++) {
    sb_draw_cache_change(page->cache[area], page->job != NULL ? 200 : 0);
  }
}

static void refresh(Page *page) {
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
  const SbDesignAnswer *answer = look_at(page);
  sb_design_limits_show(page->limits, &page->ask, answer, page->chosen);
  for (size_t i = 0; i < SB_DESIGN_LINES; i++) {
    const gboolean there = answer != NULL && i < answer->map.figures;
    gtk_widget_set_visible(page->lines[i], there);
    if (there) {
      const SbFigure *of = sb_figure(g_array_index(answer->study->figures, int, i));
      gtk_button_set_label(GTK_BUTTON(page->lines[i]), sb_translation(of->label));
    }
  }
  g_autofree char *picked = picked_text(page, answer);
  gtk_label_set_text(GTK_LABEL(page->picked), picked);
  g_autofree char *told = told_text(page, answer);
  gtk_label_set_text(GTK_LABEL(page->told), told);
  gtk_widget_set_tooltip_text(page->told, told);
  const gboolean best = answer != NULL && answer->place[SB_DESIGN_BEST].known;
  const gboolean picks = answer != NULL && page->look.picked;
  gtk_widget_set_sensitive(page->open, picks);
  gtk_widget_set_sensitive(page->pin, picks);
  gtk_widget_set_sensitive(page->use_best, best);
  g_autofree char *text =
      answer != NULL ? sb_design_text(answer) : g_strdup(_("Nothing is computed yet."));
  sb_style_name(page->area[AREA_MAP], _("Map of the design"), text);
  look_away(page);
  sb_style_former(page->area[AREA_MAP], is_former(page));
  page->refreshing = FALSE;
  redraw(page);
}

// Not of a page that nobody looks at: an edit has other things to do.
static void refresh_seen(Page *page) {
  if (gtk_widget_get_mapped(page->box)) {
    refresh(page);
  }
}

static void show_ranges(Page *page) {
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

// The question ------------------------------------------------------------------------------------

static void end_job(Page *page) {
  sb_later_cancel(&page->poll);
  g_clear_pointer(&page->job, sb_design_job_free);
}

static void on_poll(gpointer data) {
  Page *page = data;
  static const char *const parts[] = {N_("Computing the map"), N_("Searching for the best"),
                                      N_("Tolerances"), N_("Drawing valves")};
  gtk_progress_bar_set_fraction(GTK_PROGRESS_BAR(page->progress), sb_worker_progress(page->job));
  const SbDesignPart part = sb_design_job_part(page->job);
  say(page,
      gtk_toggle_button_get_active(GTK_TOGGLE_BUTTON(page->pause)) ? _("Paused") : _(parts[part]));
  // What is drawn anew for nothing keeps the loop from its other work.
  const size_t done = sb_design_job_lock(page->job)->map.done;
  sb_design_job_unlock(page->job);
  if (done != page->shown_done || part != page->shown_part) {
    page->shown_done = done;
    page->shown_part = part;
    refresh(page);
  }
}

// What a search found, in a sentence.
static char *found_text(const SbDesignAnswer *answer) {
  const SbDesign *found = &answer->found;
  if (!answer->searched) {
    return g_strdup("");
  }
  return found->found && !found->feasible
             ? g_strdup(
                   _("No start meets all limits: the valve with the smallest violation is shown."))
         : !found->found
             ? g_strdup(_("The figures could not be computed at any start (inconsistent values)."))
             : g_strdup_printf(_("%zu of %zu starts meet all limits, %zu evaluations."),
                               found->starts_feasible, found->starts, found->evaluations);
}

// Shows what marks the best design below the sentence: bounds that it is on, and its warnings of
// validity. NULL: nothing.
static void show_marks(Page *page, const SbDesignAnswer *answer) {
  g_autoptr(GString) text = g_string_new(NULL);
  if (answer != NULL && answer->searched && answer->found.found) {
    g_autofree char *bounds = sb_design_bounds(&answer->found, answer->study);
    g_autofree char *codes = sb_warning_codes(answer->found.warnings, ", ");
    if (bounds != NULL) {
      g_string_append_printf(text, _("On a bound of the search: %s."), bounds);
    }
    if (codes != NULL) {
      g_string_append(text, text->len > 0 ? "\n" : "");
      g_string_append_printf(text, _("Warnings of validity: %s."), codes);
    }
  }
  gtk_label_set_text(GTK_LABEL(page->marks), text->str);
  gtk_widget_set_visible(page->marks, text->len > 0);
}

static void on_done(void *data) {
  Page *page = data;
  g_autofree char *why = NULL;
  SbDesignAnswer *answer = sb_design_job_take(page->job, &why);
  end_job(page);
  sb_design_answer_free(page->answer);
  page->answer = answer;
  g_autofree char *text =
      why == NULL    ? found_text(answer)
      : *why == '\0' ? g_strdup_printf(_("Cancelled: %zu of %zu points of the map are there."),
                                       answer->map.done, answer->map.n * answer->map.n)
                     : g_strdup_printf(_("Not finished: %s."), why);
  say(page, text);
  show_marks(page, answer);
  refresh(page);
}

static void compute(Page *page, gboolean search) {
  const SbDocument *document = sb_session_document(page->session);
  g_autoptr(GPtrArray) issues = sb_issues_new();
  end_job(page);
  SbStudyFile *study = sb_design_ask_study(&page->ask, document, issues);
  if (study == NULL) {
    g_autofree char *line = issues->len > 0 ? sb_issue_line(issues->pdata[0]) : g_strdup("");
    say(page, line);
    refresh(page);
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
  page->job = sb_design_job_start(study, &page->ask, page->store, search, on_done, page);
  sb_later_repeat(&page->poll, page->box, POLL_MS, on_poll, page);
  refresh(page);
}

// The question has changed: closed forms answer at once, others when somebody asks.
static void asked(Page *page) {
  if (page->ask.closed) {
    compute(page, FALSE);
  } else {
    end_job(page);
    say(page, _("The inputs have changed: compute the map again."));
    refresh(page);
  }
}

static void on_later(gpointer data) {
  Page *page = data;
  if (page->answer == NULL || is_former(page)) {
    asked(page);
  }
}

// Another document has its own question; other values another map.
static void follow(Page *page) {
  const SbDocument *document = sb_session_document(page->session);
  const SbParams params = sb_document_params(document);
  const int kind = (int)sb_params_get(&params, SB_P_VALVE_KIND);
  if (document != page->document || kind != page->kind) {
    page->document = document;
    page->kind = kind;
    sb_design_ask_init(&page->ask, document);
    page->chosen = sb_figure_find("cycle.force_return_margin_N");
    const SbModel *model = sb_session_model(page->session);
    if (!sb_device_of_kind(kind)->gland ||
        (model != NULL && sb_model_number(model, SB_P_SEAL_PROFILE) != 0)) {
      page->ask.closed = FALSE; // no closed form knows such a section
    }
    end_job(page);
    g_clear_pointer(&page->answer, sb_design_answer_free);
    page->look.picked = FALSE;
    show_ranges(page);
  }
  if (gtk_widget_get_mapped(page->box) && sb_session_model(page->session) != NULL &&
      page->job == NULL) {
    sb_later_ensure(&page->later, page->box, 50, on_later, page);
  }
  refresh_seen(page);
}

// Actions -----------------------------------------------------------------------------------------

static void on_limited(void *data, int figure, double low, double high) {
  Page *page = data;
  for (size_t i = 0; i < page->ask.limits.count; i++) {
    const SbLimit *limit = &page->ask.limits.item[i];
    if (limit->figure == figure && limit->low == low && limit->high == high) {
      return; // left as it was
    }
  }
  sb_design_ask_limit(&page->ask, figure, low, high);
  asked(page);
}

static void on_chosen(void *data, int figure) {
  Page *page = data;
  page->chosen = figure;
  refresh(page);
}

static void on_axis(GtkComboBox *combo, Page *page) {
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
  show_ranges(page);
  asked(page);
}

static void on_goal(GtkComboBox *combo, Page *page) {
  const int at = gtk_combo_box_get_active(combo);
  if (!page->refreshing && at >= 0) {
    page->ask.goal = page->goals[at];
    page->ask.maximise = sb_figure(page->ask.goal)->better == SB_BETTER_MORE;
    asked(page);
  }
}

static void on_models(GtkComboBox *combo, Page *page) {
  if (!page->refreshing) {
    page->ask.closed = gtk_combo_box_get_active(combo) == 0;
    asked(page);
  }
}

static void on_freed(void *data, size_t index, gboolean free) {
  Page *page = data;
  page->ask.range[index].free = free;
  asked(page);
}

static void on_bounded(void *data, size_t index, double low, double high) {
  Page *page = data;
  page->ask.range[index].low = low;
  page->ask.range[index].high = high;
  show_ranges(page);
  asked(page);
}

static void on_robust(void *data, gboolean robust) {
  Page *page = data;
  page->ask.robust = robust;
}

static void on_lines(GtkToggleButton *button, Page *page) {
  page->look.lines = 0;
  for (unsigned i = 0; i < SB_DESIGN_LINES; i++) {
    page->look.lines |=
        gtk_toggle_button_get_active(GTK_TOGGLE_BUTTON(page->lines[i])) ? 1u << i : 0u;
  }
  redraw(page);
}

static void on_find(GtkButton *button, Page *page) {
  compute(page, TRUE);
}

static void on_map_again(GtkButton *button, Page *page) {
  compute(page, FALSE);
}

static void on_pause(GtkToggleButton *button, Page *page) {
  if (page->job != NULL && !page->refreshing) {
    sb_design_job_pause(page->job, gtk_toggle_button_get_active(button));
  }
}

static void on_stop(GtkButton *button, Page *page) {
  if (page->job != NULL) {
    sb_design_job_cancel(page->job);
  }
}

// The map -----------------------------------------------------------------------------------------

// Short values: a hundredth of a step of the axis.
static double rounded(SbParamId id, double low, double high, double value) {
  const SbParam *param = sb_param(id);
  const double wide = sb_quantity_to_shown(high, param->si, param->unit) -
                      sb_quantity_to_shown(low, param->si, param->unit);
  return sb_quantity_step(value, param->si, param->unit, (int)floor(log10(wide / 100)), 0);
}

static void pick(Page *page, double across, double up) {
  const SbDesignAnswer *answer = look_at(page);
  if (answer != NULL) {
    const SbDesignMap *map = &answer->map;
    const double at[2] = {across, up};
    page->look.picked = TRUE;
    for (int axis = 0; axis < 2; axis++) {
      const double value = fmin(fmax(at[axis], map->low[axis]), map->high[axis]);
      page->look.pick[axis] = rounded(map->axis[axis], map->low[axis], map->high[axis], value);
    }
  }
  look_away(page);
  refresh(page);
}

// The picked point's two values; FALSE: none is picked.
static gboolean overrides(Page *page, SbOverride out[2]) {
  const SbDesignAnswer *answer = look_at(page);
  const gboolean picked = answer != NULL && page->look.picked;
  for (int axis = 0; picked && axis < 2; axis++) {
    out[axis] = (SbOverride){answer->map.axis[axis], page->look.pick[axis]};
  }
  look_away(page);
  return picked;
}

static void on_open(Page *page) {
  SbOverride override[2];
  if (overrides(page, override) && !sb_session_edit_values(page->session, override, 2)) {
    say(page, _("A value is out of range."));
  }
}

static void on_pin(Page *page) {
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

// The best design's values go into the document, to five digits.
static void on_use_best(GtkButton *button, Page *page) {
  SbOverride override[SB_VARY_MAX];
  size_t count = 0;
  const SbDesignAnswer *answer = look_at(page);
  for (guint k = 0; answer != NULL && k < answer->study->vary->len; k++) {
    const SbVary *vary = &g_array_index(answer->study->vary, SbVary, k);
    const SbDistribution *of = &vary->distribution;
    const SbParam *param = sb_param(vary->id);
    const double wide = sb_quantity_to_shown(of->b, param->si, param->unit) -
                        sb_quantity_to_shown(of->a, param->si, param->unit);
    const double value = answer->place[SB_DESIGN_BEST].value[k];
    override[count++] =
        (SbOverride){vary->id, sb_quantity_step(value, param->si, param->unit,
                                                (int)floor(log10(fabs(wide) / 1000)), 0)};
  }
  look_away(page);
  sb_session_edit_values(page->session, override, count);
}

static gboolean on_press(GtkWidget *widget, GdkEventButton *event, Page *page) {
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
  const SbDesignAnswer *answer = look_at(page);
  double at[2] = {NAN, NAN};
  if (answer != NULL && event->x >= plot.x && event->x <= plot.x + plot.width &&
      event->y >= plot.y && event->y <= plot.y + plot.height) {
    const SbDesignMap *map = &answer->map;
    at[0] = map->low[0] + (map->high[0] - map->low[0]) * (event->x - plot.x) / plot.width;
    at[1] = map->high[1] - (map->high[1] - map->low[1]) * (event->y - plot.y) / plot.height;
  }
  look_away(page);
  if (isfinite(at[0])) {
    pick(page, at[0], at[1]);
  }
  return GDK_EVENT_STOP;
}

// Arrows move the picked point, from the present design at first; Enter opens it.
static gboolean on_key(GtkWidget *widget, GdkEventKey *event, Page *page) {
  const int across = (event->keyval == GDK_KEY_Right) - (event->keyval == GDK_KEY_Left);
  const int up = (event->keyval == GDK_KEY_Up) - (event->keyval == GDK_KEY_Down);
  if (event->keyval == GDK_KEY_Return || event->keyval == GDK_KEY_KP_Enter) {
    on_open(page);
    return GDK_EVENT_STOP;
  }
  if (across == 0 && up == 0) {
    return GDK_EVENT_PROPAGATE;
  }
  const SbDesignAnswer *answer = look_at(page);
  double at[2] = {NAN, NAN};
  for (int axis = 0; answer != NULL && axis < 2; axis++) {
    const double from =
        page->look.picked ? page->look.pick[axis] : answer->place[SB_DESIGN_PRESENT].axis[axis];
    const double step = (answer->map.high[axis] - answer->map.low[axis]) / 32;
    at[axis] = from + step * (axis == 0 ? across : up);
  }
  look_away(page);
  if (isfinite(at[0])) {
    pick(page, at[0], at[1]);
  }
  return GDK_EVENT_STOP;
}

// Layout ------------------------------------------------------------------------------------------

static void on_side(GtkToggleButton *button, Page *page) {
  gtk_widget_set_visible(page->side, gtk_toggle_button_get_active(button));
}

static void on_room(gpointer data) {
  Page *page = data;
  gtk_widget_set_visible(page->side_button, page->narrow);
  gtk_toggle_button_set_active(GTK_TOGGLE_BUTTON(page->side_button), !page->narrow);
  gtk_widget_set_visible(page->side, !page->narrow);
}

// Where there is no room for both, limits and scatter come on request.
static void on_allocate(GtkWidget *widget, GdkRectangle *allocation, Page *page) {
  const gboolean narrow = allocation->width < NARROW;
  if (narrow != page->narrow) {
    page->narrow = narrow;
    sb_later_ensure(&page->room, page->box, 0, on_room, page);
  }
}

static GtkWidget *add_button(GtkBox *bar, const char *label, const char *tip, GCallback call,
                             Page *page) {
  GtkWidget *button = gtk_button_new_with_label(label);
  gtk_widget_set_tooltip_text(button, tip);
  g_signal_connect(button, "clicked", call, page);
  gtk_box_pack_start(bar, button, FALSE, FALSE, 0);
  return button;
}

static void add_axes(Page *page, GtkBox *bar) {
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

static void add_toolbar(Page *page, GtkBox *to) {
  GtkBox *bar = GTK_BOX(gtk_box_new(GTK_ORIENTATION_HORIZONTAL, 8));
  sb_style_class(GTK_WIDGET(bar), "sb-toolbar");
  add_axes(page, bar);
  gtk_box_pack_start(bar, gtk_label_new(NULL), TRUE, TRUE, 0);
  page->progress = gtk_progress_bar_new();
  gtk_widget_set_valign(page->progress, GTK_ALIGN_CENTER);
  sb_style_name(page->progress, _("Progress of the design"), NULL);
  gtk_box_pack_start(bar, page->progress, FALSE, FALSE, 0);
  page->pause = gtk_toggle_button_new_with_label(_("Pause"));
  g_signal_connect(page->pause, "toggled", G_CALLBACK(on_pause), page);
  gtk_box_pack_start(bar, page->pause, FALSE, FALSE, 0);
  page->stop = add_button(bar, _("Cancel"), _("Stop and keep the results so far"),
                          G_CALLBACK(on_stop), page);
  page->map_again = add_button(bar, _("Compute map"), _("Uses the valve's own models: slower"),
                               G_CALLBACK(on_map_again), page);
  page->find = add_button(bar, _("Find best"),
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

static GtkWidget *add_area(Page *page, Area area, GtkBox *to, SbDrawCacheDraw call, int height,
                           const char *name) {
  GtkWidget *widget = page->area[area] = gtk_drawing_area_new();
  sb_style_class(widget, "sb-canvas");
  gtk_widget_set_size_request(widget, 300, height);
  sb_style_name(widget, name, NULL);
  atk_object_set_role(gtk_widget_get_accessible(widget), ATK_ROLE_CHART);
  page->cache[area] = sb_draw_cache_attach(widget, call, page);
  gtk_box_pack_start(to, widget, TRUE, TRUE, 0);
  return widget;
}

static void add_picked(Page *page, GtkBox *to) {
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

static void add_question(Page *page, GtkBox *to) {
  GtkBox *bar = GTK_BOX(gtk_box_new(GTK_ORIENTATION_HORIZONTAL, 8));
  gtk_box_pack_start(bar, sb_style_label(_("Goal"), "sb-heading", 0), FALSE, FALSE, 0);
  const char *label[GOALS_MAX];
  g_autoptr(GPtrArray) names = g_ptr_array_new_with_free_func(g_free);
  int figure[GOALS_MAX];
  const size_t count = sb_design_ask_figures(figure, GOALS_MAX);
  for (size_t i = 0; i < count; i++) {
    const SbFigure *of = sb_figure(figure[i]);
    if (of->better != SB_BETTER_NONE) {
      g_autofree char *inside = sb_translation_inside(of->label);
      g_autofree char *named = *of->where != '\0'
                                   ? g_strdup_printf("%s, %s", inside, sb_translation(of->where))
                                   : g_strdup(inside);
      char *name =
          g_strdup_printf(of->better == SB_BETTER_MORE ? _("maximum %s") : _("minimum %s"), named);
      g_ptr_array_add(names, name);
      label[page->goal_count] = name;
      page->goals[page->goal_count++] = figure[i];
    }
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
  page->use_best =
      add_button(bar, _("Use best"), _("Sets the values of the best design found in the valve"),
                 G_CALLBACK(on_use_best), page);
  sb_style_class(GTK_WIDGET(bar), "sb-picked");
  gtk_box_pack_start(to, GTK_WIDGET(bar), FALSE, FALSE, 0);
}

static GtkWidget *make_side(Page *page) {
  GtkBox *side = GTK_BOX(gtk_box_new(GTK_ORIENTATION_VERTICAL, 6));
  add_question(page, side);
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
  add_area(page, AREA_TORNADO, side, draw_tornado, 150, _("Which tolerance matters"));
  gtk_box_pack_start(side, gtk_separator_new(GTK_ORIENTATION_HORIZONTAL), FALSE, FALSE, 0);
  add_area(page, AREA_SCATTER, side, draw_scatter, 150, _("Valves drawn from the tolerances"));
  sb_style_class(GTK_WIDGET(side), "sb-design-side");
  GtkWidget *room = gtk_scrolled_window_new(NULL, NULL);
  gtk_scrolled_window_set_policy(GTK_SCROLLED_WINDOW(room), GTK_POLICY_NEVER, GTK_POLICY_AUTOMATIC);
  gtk_container_add(GTK_CONTAINER(room), GTK_WIDGET(side));
  gtk_widget_set_size_request(room, SIDE_WIDTH, -1);
  gtk_widget_set_hexpand(room, FALSE); // its names would have it
  return room;
}

// Life --------------------------------------------------------------------------------------------

static void on_destroy(GtkWidget *widget, Page *page) {
  end_job(page);
  if (page->session != NULL) {
    g_signal_handlers_disconnect_by_data(page->session, page);
    g_clear_object(&page->session);
  }
}

static void page_free(gpointer data) {
  Page *page = data;
  sb_design_answer_free(page->answer);
  sb_store_close(page->store, NULL);
  g_free(page->hash);
  g_free(page);
}

GtkWidget *sb_design_page_new(SbSession *session) {
  Page *page = g_new0(Page, 1);
  page->session = g_object_ref(session);
  page->box = gtk_box_new(GTK_ORIENTATION_VERTICAL, 0);
  g_object_set_data_full(G_OBJECT(page->box), "page", page, page_free);
  sb_design_ask_init(&page->ask, sb_session_document(session));
  page->chosen = page->ask.goal;
  GtkBox *main = GTK_BOX(gtk_box_new(GTK_ORIENTATION_VERTICAL, 0));
  page->side = make_side(page);
  add_toolbar(page, main);
  GtkWidget *map = add_area(page, AREA_MAP, main, draw_map, 320, _("Map of the design"));
  gtk_widget_set_can_focus(map, TRUE);
  gtk_widget_add_events(map, GDK_BUTTON_PRESS_MASK | GDK_KEY_PRESS_MASK);
  g_signal_connect(map, "button-press-event", G_CALLBACK(on_press), page);
  g_signal_connect(map, "key-press-event", G_CALLBACK(on_key), page);
  add_picked(page, main);
  // The window may be narrower than both need.
  GtkWidget *columns = gtk_paned_new(GTK_ORIENTATION_HORIZONTAL);
  gtk_paned_pack1(GTK_PANED(columns), GTK_WIDGET(main), TRUE, FALSE);
  gtk_paned_pack2(GTK_PANED(columns), page->side, FALSE, TRUE);
  gtk_box_pack_start(GTK_BOX(page->box), sb_verdict_strip_new(session), FALSE, FALSE, 0);
  gtk_box_pack_start(GTK_BOX(page->box), columns, TRUE, TRUE, 0);
  gtk_widget_show_all(page->box);
  gtk_widget_set_visible(page->side_button, FALSE);
  g_signal_connect(page->box, "size-allocate", G_CALLBACK(on_allocate), page);
  g_signal_connect(page->box, "destroy", G_CALLBACK(on_destroy), page);
  g_signal_connect_swapped(page->box, "map", G_CALLBACK(follow), page);
  g_signal_connect_swapped(session, "params-changed", G_CALLBACK(follow), page);
  g_signal_connect_swapped(session, "run-changed", G_CALLBACK(refresh_seen), page);
  show_ranges(page);
  refresh(page);
  return page->box;
}
