// See the header. The picture is that of app/chart; "Choose" on a card is a button laid over it.
// The temperature is the cursor's: it follows the valve's own until it is moved.
#include "ui/window/propellants_page.h"

#include "app/base/own_model.h"
#include "app/base/translation.h"
#include "app/base/unit.h"
#include "app/chart/propellants.h"
#include "app/session/study_job.h"
#include "app/session/worker.h"
#include "engine/fluid/fluid.h"
#include "ui/views/draw_cache.h"
#include "ui/views/later.h"
#include "ui/views/style.h"
#include "ui/views/toolbar.h"

#include <glib/gi18n.h>
#include <math.h>

// How long values have to stay before the study follows [ms].
enum { DELAY = 120 };

typedef struct {
  SbSession *session; // owned reference
  GtkWidget *box, *overlay, *area, *show[SB_PROPELLANTS], *choose[SB_PROPELLANTS];
  GtkWidget *temperature, *chart, *progress, *stop, *message;
  SbDrawCache *cache;
  SbStudyJob *job;
  SbLater poll, later, room;
  SbModel *asked; // what the job computes
  SbStudy *study; // shown; NULL until the first is done
  SbModel *model; // it belongs to this
  SbPropellantsLook look;
  double own; // the valve's temperature that the cursor follows [K]
} PropellantsPage;

// A model without what the study varies itself: two alike have the same study. NULL: none.
static SbModel *essence(const SbModel *model) {
  const SbOverride varied[] = {{SB_P_FLUID_NAME, sb_propellants_fluid(0)},
                               {SB_P_CANISTER_TEMPERATURE, 293.15}};
  SbModel *out = NULL;
  if (model == NULL || sb_model_derive(&out, model, varied, G_N_ELEMENTS(varied), NULL) != SB_OK) {
    return NULL;
  }
  return out;
}

static gboolean same_study(const SbModel *a, const SbModel *b) {
  SbModel *of_a = essence(a), *of_b = essence(b);
  const gboolean same = of_a != NULL && of_b != NULL && sb_model_same(of_a, of_b);
  sb_model_destroy(of_a);
  sb_model_destroy(of_b);
  return same;
}

static gboolean is_former_propellant(PropellantsPage *page) {
  return page->study != NULL && !same_study(page->model, sb_session_model(page->session));
}

// The model to draw by: the study's own values, with the present propellant.
static const SbModel *shown_model(PropellantsPage *page) {
  const SbModel *model = sb_session_model(page->session);
  return model != NULL ? model : page->model;
}

static SbRect inside(double width, double height) {
  return (SbRect){16, 12, fmax(width - 32, 1), fmax(height - 16, 1)};
}

static void layout_of(PropellantsPage *page, SbPropellantsLayout *out) {
  const SbRect rect = inside(gtk_widget_get_allocated_width(page->overlay),
                             gtk_widget_get_allocated_height(page->overlay));
  sb_propellants_layout(out, rect, &page->look);
}

static void draw_propellants(cairo_t *cr, double width, double height, void *data) {
  PropellantsPage *page = data;
  const SbTheme *theme = sb_style_ground(cr, SB_ROLE_BACKGROUND);
  if (page->study != NULL) {
    sb_propellants_draw(cr, inside(width, height), theme, page->study, shown_model(page),
                        &page->look);
  }
}

// State to widgets -------------------------------------------------------------------------------

static void refresh_propellants(PropellantsPage *page) {
  const gboolean busy = page->job != NULL;
  const SbModel *model = shown_model(page);
  SbPropellantsLayout layout;
  layout_of(page, &layout);
  gtk_widget_set_visible(page->progress, busy);
  gtk_widget_set_visible(page->stop, busy);
  gtk_widget_set_visible(page->chart, layout.small);
  for (int k = 0; k < SB_PROPELLANTS; k++) {
    const gboolean own =
        model != NULL && sb_model_number(model, SB_P_FLUID_NAME) == sb_propellants_fluid(k);
    gtk_widget_set_visible(page->choose[k],
                           page->study != NULL && layout.card[k].width > 0 && !own);
  }
  if (!gtk_widget_has_focus(page->temperature)) {
    g_autofree char *text = sb_param_format(SB_P_CANISTER_TEMPERATURE, page->look.temperature);
    gtk_entry_set_text(GTK_ENTRY(page->temperature), text);
  }
  g_autofree char *text = page->study != NULL ? sb_propellants_text(page->study, model, &page->look)
                                              : g_strdup(_("Nothing is computed yet."));
  sb_style_name(page->area, _("Propellants over the temperature"), text);
  sb_style_former(page->area, is_former_propellant(page));
  sb_draw_cache_change(page->cache, 0);
  gtk_widget_queue_resize(page->overlay);
}

static void say_propellants(PropellantsPage *page, const char *text) {
  gtk_label_set_text(GTK_LABEL(page->message), text);
}

// The study --------------------------------------------------------------------------------------

static void on_propellants_poll(gpointer data) {
  PropellantsPage *page = data;
  gtk_progress_bar_set_fraction(GTK_PROGRESS_BAR(page->progress), sb_worker_progress(page->job));
}

static void end_propellants_job(PropellantsPage *page) {
  sb_later_cancel(&page->poll);
  g_clear_pointer(&page->job, sb_study_job_free);
}

static void on_propellants_done(void *data) {
  PropellantsPage *page = data;
  const char *why = NULL;
  SbStudy *study = sb_study_job_take(page->job, &why);
  g_autofree char *text = study == NULL ? g_strdup_printf(_("No study: %s."), why) : NULL;
  end_propellants_job(page);
  say_propellants(page, text != NULL ? text : "");
  if (study != NULL) {
    g_free(page->study);
    sb_model_destroy(page->model);
    page->study = study;
    page->model = g_steal_pointer(&page->asked);
  }
  refresh_propellants(page);
}

static void compute_propellants(gpointer data) {
  PropellantsPage *page = data;
  const SbModel *model = sb_session_model(page->session);
  end_propellants_job(page);
  if (model != NULL && !(page->study != NULL && !is_former_propellant(page))) {
    sb_model_destroy(page->asked);
    page->asked = sb_own_model(model);
    say_propellants(page, "");
    gtk_progress_bar_set_fraction(GTK_PROGRESS_BAR(page->progress), 0);
    page->job = sb_study_job_start(SB_STUDY_PROPELLANTS, model, on_propellants_done, page);
    sb_later_repeat(&page->poll, page->box, 50, on_propellants_poll, page);
  }
  refresh_propellants(page);
}

// Values have changed, or the page has come into view.
static void follow_propellants(PropellantsPage *page) {
  const SbModel *model = sb_session_model(page->session);
  const double own = model != NULL ? sb_model_value(model, SB_P_CANISTER_TEMPERATURE) : page->own;
  if (own != page->own) {
    page->own = page->look.temperature = own;
  }
  if (!gtk_widget_get_mapped(page->box)) {
    return;
  }
  const gboolean asked = page->job != NULL && same_study(page->asked, model);
  if (!asked && (page->study == NULL || is_former_propellant(page))) {
    sb_later_ensure(&page->later, page->box, DELAY, compute_propellants, page);
  } else if (page->job != NULL && !asked) {
    end_propellants_job(page);
  }
  refresh_propellants(page);
}

// Actions ----------------------------------------------------------------------------------------

static void set_temperature(PropellantsPage *page, double T) {
  if (isfinite(T) && T != page->look.temperature) {
    page->look.temperature = T;
    refresh_propellants(page);
  }
}

static gboolean on_pointer(PropellantsPage *page, double x, double y) {
  SbPropellantsLayout layout;
  layout_of(page, &layout);
  if (page->study != NULL) {
    const double T = sb_propellants_at(&layout, page->study, x, y);
    set_temperature(page, round(T - 273.15) + 273.15);
  }
  return GDK_EVENT_STOP;
}

static gboolean on_propellants_press(GtkWidget *widget, GdkEventButton *event,
                                     PropellantsPage *page) {
  gtk_widget_grab_focus(widget);
  return event->button == GDK_BUTTON_PRIMARY ? on_pointer(page, event->x, event->y)
                                             : GDK_EVENT_PROPAGATE;
}

static gboolean on_motion(GtkWidget *widget, GdkEventMotion *event, PropellantsPage *page) {
  return (event->state & GDK_BUTTON1_MASK) != 0 ? on_pointer(page, event->x, event->y)
                                                : GDK_EVENT_PROPAGATE;
}

static gboolean on_propellants_key(GtkWidget *widget, GdkEventKey *event, PropellantsPage *page) {
  const int step = (event->keyval == GDK_KEY_Right) - (event->keyval == GDK_KEY_Left);
  if (step == 0 || page->study == NULL) {
    return GDK_EVENT_PROPAGATE;
  }
  const SbStudySeries *series = &page->study->panel[0].series[0];
  const double lo = series->x[0], hi = series->x[series->count - 1];
  set_temperature(page, CLAMP(page->look.temperature + step, lo, hi));
  return GDK_EVENT_STOP;
}

static void on_temperature(GtkEntry *entry, PropellantsPage *page) {
  double T = NAN;
  g_autoptr(GError) error = NULL;
  if (sb_param_parse(&T, SB_P_CANISTER_TEMPERATURE, gtk_entry_get_text(entry), &error)) {
    say_propellants(page, "");
    set_temperature(page, T);
  } else {
    say_propellants(page, error->message);
  }
}

static gboolean on_propellants_focus_out(GtkWidget *widget, GdkEventFocus *event,
                                         PropellantsPage *page) {
  on_temperature(GTK_ENTRY(widget), page);
  refresh_propellants(page);
  return GDK_EVENT_PROPAGATE;
}

static void on_show(GtkToggleButton *button, PropellantsPage *page) {
  page->look.hidden = 0;
  for (int k = 0; k < SB_PROPELLANTS; k++) {
    const gboolean on = gtk_toggle_button_get_active(GTK_TOGGLE_BUTTON(page->show[k]));
    page->look.hidden |= on ? 0u : 1u << k;
  }
  refresh_propellants(page);
}

static void on_chart(PropellantsPage *page) {
  page->look.chart = gtk_combo_box_get_active(GTK_COMBO_BOX(page->chart));
  refresh_propellants(page);
}

static void on_propellants_choose(GtkButton *button, PropellantsPage *page) {
  for (int k = 0; k < SB_PROPELLANTS; k++) {
    if (page->choose[k] == GTK_WIDGET(button)) {
      sb_session_edit(page->session, SB_P_FLUID_NAME, sb_fluids[sb_propellants_fluid(k)].name);
    }
  }
}

static void on_propellants_stop(GtkButton *button, PropellantsPage *page) {
  if (page->job != NULL) {
    sb_worker_cancel(page->job);
  }
}

// Where the buttons of the cards lie.
static gboolean on_position(GtkOverlay *overlay, GtkWidget *child, GdkRectangle *out,
                            PropellantsPage *page) {
  SbPropellantsLayout layout;
  layout_of(page, &layout);
  for (int k = 0; k < SB_PROPELLANTS; k++) {
    if (page->choose[k] == child) {
      const SbRect r = layout.button[k];
      GtkRequisition least;
      gtk_widget_get_preferred_size(child, &least, NULL);
      const int width = MAX((int)r.width, least.width), height = MAX((int)r.height, least.height);
      *out = (GdkRectangle){(int)(r.x + r.width) - width, (int)r.y, width, height};
      return TRUE;
    }
  }
  return FALSE;
}

// Not inside an allocation: what is shown depends on the room.
static void on_propellants_room(gpointer data) {
  refresh_propellants(data);
}

static void on_propellants_allocate(GtkWidget *overlay, GdkRectangle *allocation,
                                    PropellantsPage *page) {
  SbPropellantsLayout layout;
  layout_of(page, &layout);
  if (layout.small != gtk_widget_get_visible(page->chart)) {
    sb_later_ensure(&page->room, page->box, 0, on_propellants_room, page);
  }
}

// Life -------------------------------------------------------------------------------------------

static void on_propellants_destroy(GtkWidget *widget, PropellantsPage *page) {
  end_propellants_job(page);
  if (page->session != NULL) {
    g_signal_handlers_disconnect_by_data(page->session, page);
    g_clear_object(&page->session);
  }
}

static void propellants_page_free(gpointer data) {
  PropellantsPage *page = data;
  g_free(page->study);
  sb_model_destroy(page->model);
  sb_model_destroy(page->asked);
  g_free(page);
}

static void add_propellants_toolbar(PropellantsPage *page) {
  GtkWidget *bar = gtk_box_new(GTK_ORIENTATION_HORIZONTAL, 8);
  sb_style_class(bar, "sb-toolbar");
  gtk_box_pack_start(GTK_BOX(bar), sb_style_label(_("Show"), "sb-heading", 0), FALSE, FALSE, 0);
  for (int k = 0; k < SB_PROPELLANTS; k++) {
    page->show[k] = gtk_toggle_button_new_with_label(sb_propellants_name(k));
    gtk_toggle_button_set_active(GTK_TOGGLE_BUTTON(page->show[k]), TRUE);
    gtk_box_pack_start(GTK_BOX(bar), page->show[k], FALSE, FALSE, 0);
    g_signal_connect(page->show[k], "toggled", G_CALLBACK(on_show), page);
  }
  static const char *const charts[] = {N_("Pressure force"), N_("Break-away"), N_("Return margin")};
  page->chart = sb_toolbar_combo(GTK_BOX(bar), charts, SB_PROPELLANTS_CHARTS, _("Chart"),
                                 _("Which of the three charts is shown"));
  gtk_combo_box_set_active(GTK_COMBO_BOX(page->chart), SB_PROPELLANTS_RETURN);
  g_signal_connect_swapped(page->chart, "changed", G_CALLBACK(on_chart), page);
  page->message = sb_style_label(NULL, "sb-warn", 0);
  gtk_label_set_ellipsize(GTK_LABEL(page->message), PANGO_ELLIPSIZE_END);
  gtk_box_pack_start(GTK_BOX(bar), page->message, TRUE, TRUE, 0);
  page->temperature = gtk_entry_new();
  gtk_entry_set_width_chars(GTK_ENTRY(page->temperature), 8);
  gtk_entry_set_alignment(GTK_ENTRY(page->temperature), 1);
  sb_style_name(page->temperature, _("Temperature of the cursor"), NULL);
  g_signal_connect(page->temperature, "activate", G_CALLBACK(on_temperature), page);
  g_signal_connect(page->temperature, "focus-out-event", G_CALLBACK(on_propellants_focus_out),
                   page);
  gtk_box_pack_end(GTK_BOX(bar), page->temperature, FALSE, FALSE, 0);
  gtk_box_pack_end(GTK_BOX(bar), sb_style_label(_("Temperature"), "sb-row-label", 1), FALSE, FALSE,
                   0);
  page->stop = gtk_button_new_with_label(_("Cancel"));
  gtk_widget_set_tooltip_text(page->stop, _("Stop computing; the study shown stays"));
  g_signal_connect(page->stop, "clicked", G_CALLBACK(on_propellants_stop), page);
  page->progress = gtk_progress_bar_new();
  gtk_widget_set_valign(page->progress, GTK_ALIGN_CENTER);
  sb_style_name(page->progress, _("Progress of the study"), NULL);
  gtk_box_pack_end(GTK_BOX(bar), page->stop, FALSE, FALSE, 0);
  gtk_box_pack_end(GTK_BOX(bar), page->progress, FALSE, FALSE, 0);
  gtk_box_pack_start(GTK_BOX(page->box), bar, FALSE, FALSE, 0);
  gtk_widget_show_all(bar);
}

static void add_picture(PropellantsPage *page) {
  page->overlay = gtk_overlay_new();
  page->area = gtk_drawing_area_new();
  sb_style_class(page->area, "sb-canvas");
  gtk_widget_set_can_focus(page->area, TRUE);
  gtk_widget_set_size_request(page->area, 640, 320);
  gtk_widget_add_events(page->area,
                        GDK_BUTTON_PRESS_MASK | GDK_BUTTON1_MOTION_MASK | GDK_KEY_PRESS_MASK);
  atk_object_set_role(gtk_widget_get_accessible(page->area), ATK_ROLE_CHART);
  page->cache = sb_draw_cache_attach(page->area, draw_propellants, page);
  g_signal_connect(page->area, "button-press-event", G_CALLBACK(on_propellants_press), page);
  g_signal_connect(page->area, "motion-notify-event", G_CALLBACK(on_motion), page);
  g_signal_connect(page->area, "key-press-event", G_CALLBACK(on_propellants_key), page);
  gtk_container_add(GTK_CONTAINER(page->overlay), page->area);
  g_signal_connect(page->overlay, "get-child-position", G_CALLBACK(on_position), page);
  g_signal_connect(page->overlay, "size-allocate", G_CALLBACK(on_propellants_allocate), page);
  for (int k = 0; k < SB_PROPELLANTS; k++) {
    page->choose[k] = gtk_button_new_with_label(_("Choose"));
    g_autofree char *name = g_strdup_printf(_("Choose %s"), sb_propellants_name(k));
    sb_style_name(page->choose[k], name, NULL);
    sb_style_class(page->choose[k], "sb-choose");
    gtk_overlay_add_overlay(GTK_OVERLAY(page->overlay), page->choose[k]);
    g_signal_connect(page->choose[k], "clicked", G_CALLBACK(on_propellants_choose), page);
  }
  gtk_box_pack_start(GTK_BOX(page->box), page->overlay, TRUE, TRUE, 0);
  gtk_widget_show(page->area);
  gtk_widget_show(page->overlay);
}

GtkWidget *sb_propellants_page_new(SbSession *session) {
  PropellantsPage *page = g_new0(PropellantsPage, 1);
  page->session = g_object_ref(session);
  page->box = gtk_box_new(GTK_ORIENTATION_VERTICAL, 0);
  page->look = (SbPropellantsLook){.temperature = 293.15, .chart = SB_PROPELLANTS_RETURN};
  page->own = NAN;
  g_object_set_data_full(G_OBJECT(page->box), "page", page, propellants_page_free);
  add_propellants_toolbar(page);
  add_picture(page);
  g_signal_connect(page->box, "destroy", G_CALLBACK(on_propellants_destroy), page);
  g_signal_connect_swapped(page->box, "map", G_CALLBACK(follow_propellants), page);
  g_signal_connect_swapped(session, "params-changed", G_CALLBACK(follow_propellants), page);
  gtk_widget_show(page->box);
  return page->box;
}
