// A widget around one chart of app/chart. The loop takes the pointer: a line follows it with the
// forces there, press or drag near the curve and the playhead goes to the nearest frame. The wheel
// (or + and -) enlarges it, a drag beside the curve the box that is drawn, the middle button moves
// it, a double click (or 0) shows all of it. Every
// chart has an accessible description that says in a sentence what it shows now, and its numbers
// can be copied as a table.
#include "ui/views/chart_view.h"

#include "app/base/device.h"
#include "app/chart/compare.h"
#include "app/chart/life.h"
#include "app/chart/rig.h"
#include "app/chart/shelf.h"
#include "app/chart/signal.h"
#include "ui/views/canvas_area.h"
#include "ui/views/chart_view_private.h"
#include "ui/views/signals.h"
#include "ui/views/style.h"

#include <glib/gi18n.h>
#include <math.h>

static const struct {
  const char *name;
  int least_height, height;
  int interval; // between drawings while something moves [ms]
} kinds[] = {
    {N_("Force and displacement"), 190, 260, 50}, {N_("Contact pressure"), 132, 178, 80},
    {N_("Film thickness"), 132, 178, 80},         {N_("Life"), 176, 230, 1000},
    {N_("Compared runs"), 140, 310, 80},          {N_("Loss on the shelf"), 300, 420, 1000},
    {N_("Why they differ"), 224, 224, 1000},
};

const char *sb_chart_view_name(SbChartViewKind kind) {
  return _(kinds[kind].name);
}

// Model of the run shown; before the first run, of the values.
static const SbModel *model_of(SbSession *session) {
  const SbModel *model = sb_session_chart(session)->run.model;
  return model != NULL ? model : sb_session_model(session);
}

static gboolean applies(const SbChartWidget *view) {
  const SbModel *model = model_of(view->session);
  gboolean rig = !sb_device(model)->stem;
  switch (view->kind) {
  case SB_CHART_VIEW_FILM:
  case SB_CHART_VIEW_COMPARE:
    return !rig;
  case SB_CHART_VIEW_LIFE:
    return !rig && model != NULL && sb_model_number(model, SB_P_LIFE_ACTUATIONS) > 1;
  case SB_CHART_VIEW_SHELF:
    return !rig && model != NULL &&
           (sb_model_number(model, SB_P_OUTPUT_VIEWS) & SB_VIEW_SHELF) != 0;
  case SB_CHART_VIEW_REASONS:
    return rig;
  default:
    return TRUE;
  }
}

// A life is known when its run has ended; until then that of the earlier run stays, dimmed.
static void draw_life(cairo_t *cr, SbRect rect, const SbTheme *theme, const SbChartData *data) {
  if (data->run.life_count > 0 || data->earlier == NULL) {
    sb_life_draw(cr, rect, theme, data);
    return;
  }
  SbChartData earlier = *data;
  earlier.run = *data->earlier;
  cairo_push_group(cr);
  sb_life_draw(cr, rect, theme, &earlier);
  cairo_pop_group_to_source(cr);
  cairo_paint_with_alpha(cr, 0.45);
}

// The widget less the column's padding.
static SbRect inside(double width, double height) {
  return (SbRect){16, 12, fmax(width - 28, 1), fmax(height - 18, 1)};
}

static SbRect whole(GtkWidget *widget) {
  return inside(gtk_widget_get_allocated_width(widget), gtk_widget_get_allocated_height(widget));
}

// What is drawn: the session's, and what of it.
static SbChartData data_of(const SbChartWidget *view) {
  SbChartData data = *sb_session_chart(view->session);
  data.zoom = view->zoomed ? &view->zoom : NULL;
  return data;
}

static void draw(cairo_t *cr, double width, double height, void *user) {
  SbChartWidget *view = user;
  const SbTheme *theme = sb_style_ground(cr, SB_ROLE_PANEL);
  const SbChartData shown = data_of(view), *data = &shown;
  SbRect rect = inside(width, height);
  bool rig = !sb_device(data->run.model)->stem;
  switch (view->kind) {
  case SB_CHART_VIEW_LOOP:
    (rig ? sb_signal_draw : sb_hysteresis_draw)(cr, rect, theme, data, SB_CHART_COMPACT);
    break;
  case SB_CHART_VIEW_PRESSURE:
    (rig ? sb_rig_scale_draw : sb_profiles_pressure_draw)(cr, rect, theme, data, SB_CHART_COMPACT);
    break;
  case SB_CHART_VIEW_FILM:
    sb_profiles_film_draw(cr, rect, theme, data, SB_CHART_COMPACT);
    break;
  case SB_CHART_VIEW_COMPARE:
    sb_compare_draw(cr, rect, theme, data, SB_CHART_COMPACT);
    break;
  case SB_CHART_VIEW_LIFE:
    draw_life(cr, rect, theme, data);
    break;
  case SB_CHART_VIEW_SHELF:
    sb_shelf_draw(cr, rect, theme, data);
    break;
  case SB_CHART_VIEW_REASONS:
    sb_rig_reasons_draw(cr, rect, theme, data, SB_CHART_COMPACT);
    break;
  }
}

gboolean sb_chart_view_read_contact(const SbChartWidget *view, SbProfileReading *out) {
  const SbChartData *data = sb_session_chart(view->session);
  const gboolean film = view->kind == SB_CHART_VIEW_FILM;
  return (film || view->kind == SB_CHART_VIEW_PRESSURE) && !isnan(view->point_x) &&
         sb_device(data->run.model)->stem &&
         sb_profiles_read(out, whole(view->area), data, SB_CHART_COMPACT, film, view->point_x,
                          view->point_y);
}

// Pointer ----------------------------------------------------------------------------------------

static gboolean scrub(SbChartWidget *view, double x, double y, double reach) {
  size_t frame = 0;
  const SbChartData shown = data_of(view), *data = &shown;
  gboolean hit =
      sb_device(data->run.model)->stem
          ? sb_hysteresis_hit(&frame, whole(view->area), data, SB_CHART_COMPACT, x, y, reach)
          : sb_signal_hit(&frame, whole(view->area), data, SB_CHART_COMPACT, x, y);
  if (!hit) {
    return FALSE;
  }
  sb_session_play(view->session, FALSE);
  sb_session_set_playhead(view->session, frame);
  return TRUE;
}

// Only a valve's loop is enlarged.
static gboolean may_zoom(const SbChartWidget *view) {
  const SbChartRun *run = &sb_session_chart(view->session)->run;
  return view->kind == SB_CHART_VIEW_LOOP && sb_device(run->model)->stem && run->count > 0;
}

// Enlarges about a point; a factor of 0 shows all.
static void zoom_at(SbChartWidget *view, double factor, double x, double y) {
  const SbChartData data = data_of(view);
  SbChartZoom zoom = view->zoom;
  view->zoomed = factor > 0 && sb_hysteresis_zoom(&zoom, whole(view->area), &data, SB_CHART_COMPACT,
                                                  factor, x, y);
  view->zoom = zoom;
  sb_draw_cache_change(view->cache, 0);
  sb_later_ensure(&view->describe, view->area, 200, sb_chart_view_describe, view);
}

static gboolean on_scroll(GtkWidget *widget, GdkEventScroll *event, SbChartWidget *view) {
  double dx = 0;
  double dy = event->direction == GDK_SCROLL_UP ? -1 : event->direction == GDK_SCROLL_DOWN ? 1 : 0;
  if (event->direction == GDK_SCROLL_SMOOTH) {
    gdk_event_get_scroll_deltas((GdkEvent *)event, &dx, &dy);
  }
  if (!may_zoom(view)) {
    return GDK_EVENT_PROPAGATE;
  }
  zoom_at(view, pow(1.2, -dy), event->x, event->y);
  return GDK_EVENT_STOP;
}

// With the focus: + and - enlarge about the playhead, 0 shows all.
static gboolean on_key(GtkWidget *widget, GdkEventKey *event, SbChartWidget *view) {
  const gboolean in = event->keyval == GDK_KEY_plus || event->keyval == GDK_KEY_KP_Add;
  const gboolean out = event->keyval == GDK_KEY_minus || event->keyval == GDK_KEY_KP_Subtract;
  const gboolean all = event->keyval == GDK_KEY_0 || event->keyval == GDK_KEY_KP_0;
  const SbFrame *frame = sb_session_frame(view->session);
  if (!may_zoom(view) || frame == NULL || !(in || out || all)) {
    return GDK_EVENT_PROPAGATE;
  }
  const SbChartData data = data_of(view);
  SbAxes at;
  sb_hysteresis_layout(&at, whole(widget), &data, SB_CHART_COMPACT);
  zoom_at(view,
          all  ? 0
          : in ? 1.5
               : 1 / 1.5,
          sb_axis_at(&at.x, 1e3 * frame->displacement), sb_axis_at(&at.y, frame->force));
  return GDK_EVENT_STOP;
}

static gboolean on_press(GtkWidget *widget, GdkEventButton *event, SbChartWidget *view) {
  gtk_widget_grab_focus(widget);
  if (view->kind != SB_CHART_VIEW_LOOP) {
    return GDK_EVENT_PROPAGATE;
  }
  view->press_x = view->x = event->x;
  view->press_y = view->y = event->y;
  if (event->type == GDK_2BUTTON_PRESS && may_zoom(view)) {
    zoom_at(view, 0, 0, 0);
  } else if (event->type == GDK_BUTTON_PRESS && event->button == GDK_BUTTON_MIDDLE) {
    view->hand = SB_CHART_HAND_MOVES;
  } else if (event->type == GDK_BUTTON_PRESS && event->button == GDK_BUTTON_PRIMARY) {
    view->hand = scrub(view, event->x, event->y, 24) || !may_zoom(view) ? SB_CHART_HAND_SCRUBS
                                                                        : SB_CHART_HAND_BOXES;
  }
  return event->button == GDK_BUTTON_SECONDARY ? GDK_EVENT_PROPAGATE : GDK_EVENT_STOP;
}

// The box that was drawn, if it is more than a click, fills the plot.
static gboolean on_release(GtkWidget *widget, GdkEventButton *event, SbChartWidget *view) {
  enum { LEAST = 8 }; // [px]
  if (view->hand == SB_CHART_HAND_BOXES && fabs(view->x - view->press_x) >= LEAST &&
      fabs(view->y - view->press_y) >= LEAST && may_zoom(view)) {
    const SbChartData data = data_of(view);
    SbAxes at;
    sb_hysteresis_layout(&at, whole(widget), &data, SB_CHART_COMPACT);
    view->zoom = (SbChartZoom){sb_axis_value(&at.x, fmin(view->x, view->press_x)),
                               sb_axis_value(&at.x, fmax(view->x, view->press_x)),
                               sb_axis_value(&at.y, fmax(view->y, view->press_y)),
                               sb_axis_value(&at.y, fmin(view->y, view->press_y))};
    view->zoomed = TRUE;
    zoom_at(view, 1, view->x, view->y); // within the whole plot
  }
  view->hand = SB_CHART_HAND_FREE;
  gtk_widget_queue_draw(widget);
  return GDK_EVENT_STOP;
}

// Moves what is shown by pixels.
static void move(SbChartWidget *view, double dx, double dy) {
  if (!view->zoomed) {
    return;
  }
  const SbChartData data = data_of(view);
  SbAxes at;
  sb_hysteresis_layout(&at, whole(view->area), &data, SB_CHART_COMPACT);
  const double x = sb_axis_value(&at.x, 0) - sb_axis_value(&at.x, dx);
  const double y = sb_axis_value(&at.y, 0) - sb_axis_value(&at.y, dy);
  view->zoom =
      (SbChartZoom){view->zoom.x0 + x, view->zoom.x1 + x, view->zoom.y0 + y, view->zoom.y1 + y};
  zoom_at(view, 1, at.plot.x, at.plot.y);
}

static void set_cursor(SbChartWidget *view, double cursor, double x, double y) {
  const gboolean contact = view->kind == SB_CHART_VIEW_FILM || view->kind == SB_CHART_VIEW_PRESSURE;
  const gboolean moved = contact && (!isnan(x) || !isnan(view->point_x));
  view->point_x = contact ? x : NAN;
  view->point_y = y;
  if (moved || (cursor != view->cursor && !(isnan(cursor) && isnan(view->cursor)))) {
    view->cursor = cursor;
    gtk_widget_queue_draw(view->area);
    sb_later_ensure(&view->describe, view->area, 200, sb_chart_view_describe, view);
  }
}

// Over the kept picture.
static gboolean on_draw_cursor(GtkWidget *widget, cairo_t *cr, SbChartWidget *view) {
  const SbChartData shown = data_of(view), *data = &shown;
  if (view->hand == SB_CHART_HAND_BOXES) {
    const SbColor ink = sb_theme(sb_style_is_dark())->role[SB_ROLE_INK];
    cairo_set_source_rgba(cr, ink.r, ink.g, ink.b, 0.6);
    cairo_set_line_width(cr, 1);
    cairo_rectangle(cr, floor(fmin(view->x, view->press_x)) + 0.5,
                    floor(fmin(view->y, view->press_y)) + 0.5, fabs(view->x - view->press_x),
                    fabs(view->y - view->press_y));
    cairo_stroke(cr);
    return GDK_EVENT_PROPAGATE;
  }
  SbProfileReading reading;
  if (sb_chart_view_read_contact(view, &reading)) {
    sb_profiles_cursor_draw(cr, sb_theme(sb_style_is_dark()), data, &reading,
                            view->kind == SB_CHART_VIEW_FILM);
  }
  if (!isnan(view->cursor) && data->run.count > 0) {
    sb_hysteresis_cursor_draw(cr, whole(widget), sb_theme(sb_style_is_dark()), data,
                              SB_CHART_COMPACT, view->cursor);
  }
  return GDK_EVENT_PROPAGATE;
}

static gboolean on_leave(GtkWidget *widget, GdkEventCrossing *event, SbChartWidget *view) {
  set_cursor(view, NAN, NAN, NAN);
  return GDK_EVENT_PROPAGATE;
}

// Reads the loop there.
static void read_at(SbChartWidget *view, GtkWidget *widget, double x, double y) {
  const SbChartData data = data_of(view);
  double cursor = NAN;
  const gboolean inside =
      may_zoom(view) && view->hand != SB_CHART_HAND_BOXES &&
      sb_hysteresis_cursor(&cursor, whole(widget), &data, SB_CHART_COMPACT, x, y);
  set_cursor(view, inside ? cursor : NAN, x, y);
}

// A pointer that comes in at one stroke and rests moves no more.
static gboolean on_enter(GtkWidget *widget, GdkEventCrossing *event, SbChartWidget *view) {
  read_at(view, widget, event->x, event->y);
  return GDK_EVENT_PROPAGATE;
}

static gboolean on_motion(GtkWidget *widget, GdkEventMotion *event, SbChartWidget *view) {
  read_at(view, widget, event->x, event->y);
  if (view->hand == SB_CHART_HAND_SCRUBS) {
    scrub(view, event->x, event->y, 80);
  } else if (view->hand == SB_CHART_HAND_MOVES) {
    move(view, event->x - view->x, event->y - view->y);
  } else if (view->hand == SB_CHART_HAND_BOXES) {
    gtk_widget_queue_draw(widget);
  }
  view->x = event->x;
  view->y = event->y;
  return GDK_EVENT_STOP;
}

// Life -------------------------------------------------------------------------------------------

static void show_change(SbChartWidget *view, gboolean later) {
  gtk_widget_set_visible(view->area, applies(view));
  sb_style_former(view->area,
                  sb_session_shows_former(view->session) && sb_chart_view_prediction(view) == NULL);
  if (later) {
    sb_draw_cache_change_later(view->cache, SB_DRAW_LATER);
  } else {
    sb_draw_cache_change(view->cache,
                         sb_session_wants_ticks(view->session) ? kinds[view->kind].interval : 0);
  }
  // Screen readers need no more than a few sentences a second.
  sb_later_ensure(&view->describe, view->area, 200, sb_chart_view_describe, view);
}

static void on_chart_change(SbChartWidget *view) {
  show_change(view, FALSE);
}

static void on_run(SbChartWidget *view) {
  show_change(view, sb_session_awaits(view->session));
}

static void on_params(SbChartWidget *view) {
  show_change(view, sb_session_awaits(view->session) && sb_chart_view_prediction(view) == NULL);
}

GtkWidget *sb_chart_view_new(SbSession *session, SbChartViewKind kind) {
  SbChartWidget *view = g_new0(SbChartWidget, 1);
  view->session = session;
  view->kind = kind;
  view->cursor = view->point_x = NAN;
  view->area = sb_canvas_area_new(280, 300, kinds[kind].least_height, kinds[kind].height);
  g_object_set_data_full(G_OBJECT(view->area), "view", view, g_free);
  sb_style_class(view->area, "sb-canvas");
  gtk_widget_set_can_focus(view->area, TRUE);
  gtk_widget_add_events(
      view->area, GDK_BUTTON_PRESS_MASK | GDK_BUTTON_RELEASE_MASK | GDK_SCROLL_MASK |
                      GDK_SMOOTH_SCROLL_MASK | GDK_POINTER_MOTION_MASK | GDK_ENTER_NOTIFY_MASK |
                      GDK_LEAVE_NOTIFY_MASK | GDK_KEY_PRESS_MASK | GDK_FOCUS_CHANGE_MASK);
  atk_object_set_role(gtk_widget_get_accessible(view->area), ATK_ROLE_CHART);
  view->cache = sb_draw_cache_attach(view->area, draw, view);
  g_signal_connect_after(view->area, "draw", G_CALLBACK(on_draw_cursor), view);
  g_signal_connect(view->area, "enter-notify-event", G_CALLBACK(on_enter), view);
  g_signal_connect(view->area, "leave-notify-event", G_CALLBACK(on_leave), view);
  g_signal_connect(view->area, "button-press-event", G_CALLBACK(on_press), view);
  g_signal_connect(view->area, "button-release-event", G_CALLBACK(on_release), view);
  g_signal_connect(view->area, "scroll-event", G_CALLBACK(on_scroll), view);
  g_signal_connect(view->area, "key-press-event", G_CALLBACK(on_key), view);
  g_signal_connect(view->area, "motion-notify-event", G_CALLBACK(on_motion), view);
  sb_signals_end_with(view->area, view->session, view);
  g_signal_connect_swapped(session, "run-changed", G_CALLBACK(on_run), view);
  g_signal_connect_swapped(session, "frames-changed", G_CALLBACK(on_run), view);
  g_signal_connect_swapped(session, "playhead-changed", G_CALLBACK(on_chart_change), view);
  g_signal_connect_swapped(session, "params-changed", G_CALLBACK(on_params), view);
  sb_chart_view_describe(view);
  gtk_widget_set_visible(view->area, applies(view));
  return view->area;
}
