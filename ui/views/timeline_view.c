// The cycle in time, with the controls of the playhead: previous event, play, next event, looping
// and speed. Press or drag on the timeline scrubs to the nearest frame, a bookmark's flag goes to
// it. The keys (Space, arrows, Home, End) are the window's, so that they work wherever no text is
// typed.
#include "ui/views/timeline_view.h"

#include "app/chart/timeline.h"
#include "ui/views/canvas_area.h"
#include "ui/views/draw_cache.h"
#include "ui/views/later.h"
#include "ui/views/notes_button.h"
#include "ui/views/pin_bar.h"
#include "ui/views/signals.h"
#include "ui/views/style.h"
#include "ui/views/toolbar.h"

#include <glib/gi18n.h>
#include <math.h>

typedef struct {
  SbSession *session;
  GtkWidget *area, *play, *play_icon, *loop, *speed;
  SbDrawCache *cache;
  gboolean playing; // as the button shows
  gboolean scrubs;  // the button holds the playhead
  SbLater describe; // renews the description
  double cycle;     // duration that the speed texts were made for [s]
} View;

enum { TIMELINE_INTERVAL = 33 }; // between drawings while something moves [ms]

static const int durations[] = {2, 5, 10, 20, 60, 0}; // seconds per cycle; 0: real time

static SbRect inside_timeline(double width, double height) {
  return (SbRect){8, 10, fmax(width - 28, 1), fmax(height - 14, 1)};
}

static SbRect whole_timeline(GtkWidget *widget) {
  return inside_timeline(gtk_widget_get_allocated_width(widget),
                         gtk_widget_get_allocated_height(widget));
}

static void draw_timeline(cairo_t *cr, double width, double height, void *user) {
  View *view = user;
  const SbTheme *theme = sb_style_ground(cr, SB_ROLE_PANEL);
  sb_timeline_draw(cr, inside_timeline(width, height), theme, sb_session_chart(view->session),
                   SB_CHART_COMPACT);
}

static void scrub_timeline(View *view, double x) {
  size_t frame = 0;
  if (sb_timeline_hit(&frame, whole_timeline(view->area), sb_session_chart(view->session), x)) {
    sb_session_play(view->session, FALSE);
    sb_session_set_playhead(view->session, frame);
  }
}

static gboolean marker_at(View *view, double x, double y, size_t *marker) {
  return sb_timeline_marker_hit(marker, whole_timeline(view->area), sb_session_chart(view->session),
                                x, y);
}

static gboolean on_timeline_press(GtkWidget *widget, GdkEventButton *event, View *view) {
  gtk_widget_grab_focus(widget);
  size_t marker = 0;
  view->scrubs = FALSE;
  if (event->button != GDK_BUTTON_PRIMARY) {
    return GDK_EVENT_STOP;
  }
  if (marker_at(view, event->x, event->y, &marker)) {
    sb_session_show_time(view->session, sb_session_chart(view->session)->marker[marker].time);
  } else {
    view->scrubs = TRUE;
    scrub_timeline(view, event->x);
  }
  return GDK_EVENT_STOP;
}

// What a bookmark's flag says, with the note of its name.
static gboolean on_tooltip(GtkWidget *widget, int x, int y, gboolean by_keys, GtkTooltip *tip,
                           View *view) {
  size_t marker = 0;
  if (by_keys || !marker_at(view, x, y, &marker)) {
    return FALSE;
  }
  const SbDocument *document = sb_session_document(view->session);
  const char *name = sb_session_chart(view->session)->marker[marker].name;
  const char *note = sb_document_remark(document, SB_REMARK_NOTE, name);
  g_autofree char *text = note != NULL ? g_strdup_printf("%s\n%s", name, note) : g_strdup(name);
  gtk_tooltip_set_text(tip, text);
  return TRUE;
}

static gboolean on_timeline_motion(GtkWidget *widget, GdkEventMotion *event, View *view) {
  if (view->scrubs) {
    scrub_timeline(view, event->x);
  }
  return GDK_EVENT_STOP;
}

static gboolean on_timeline_scroll(GtkWidget *widget, GdkEventScroll *event, View *view) {
  if (event->direction == GDK_SCROLL_UP) {
    sb_session_step(view->session, -1);
  } else if (event->direction == GDK_SCROLL_DOWN) {
    sb_session_step(view->session, 1);
  }
  return GDK_EVENT_STOP;
}

// Speed ------------------------------------------------------------------------------------------

// Duration of the shown cycle; 0 while it is not known.
static double cycle_of(SbSession *session) {
  if (sb_session_state(session) == SB_SESSION_RUNNING) {
    return 0;
  }
  size_t count = 0;
  const SbFrame *frames = sb_session_frames(session, &count);
  return count > 1 ? frames[count - 1].time : 0;
}

// The texts hold the speed, which depends on how long the cycle lasts.
static void refresh_speeds(View *view) {
  double cycle = cycle_of(view->session);
  if (fabs(cycle - view->cycle) <= 0.005 * view->cycle &&
      gtk_combo_box_get_active(GTK_COMBO_BOX(view->speed)) >= 0) {
    return;
  }
  view->cycle = cycle;
  int active = MAX(gtk_combo_box_get_active(GTK_COMBO_BOX(view->speed)), 0);
  if (gtk_combo_box_get_active(GTK_COMBO_BOX(view->speed)) < 0) {
    active = 2;
  }
  gtk_combo_box_text_remove_all(GTK_COMBO_BOX_TEXT(view->speed));
  for (guint i = 0; i < G_N_ELEMENTS(durations); i++) {
    g_autofree char *text = NULL;
    if (durations[i] == 0) {
      text = g_strdup(_("× 1, real time"));
    } else if (cycle > 0) {
      text = g_strdup_printf(_("× %.3g, cycle in %d s"), cycle / durations[i], durations[i]);
    } else {
      text = g_strdup_printf(_("cycle in %d s"), durations[i]);
    }
    gtk_combo_box_text_append_text(GTK_COMBO_BOX_TEXT(view->speed), text);
  }
  gtk_combo_box_set_active(GTK_COMBO_BOX(view->speed), active);
}

static void on_speed(GtkComboBox *combo, View *view) {
  int active = gtk_combo_box_get_active(combo);
  if (active >= 0) {
    double seconds = durations[active] > 0 ? durations[active] : fmax(view->cycle, 1e-3);
    sb_session_set_play_duration(view->session, seconds);
  }
}

// Controls ---------------------------------------------------------------------------------------

static void on_play(GtkButton *button, View *view) {
  sb_session_play(view->session, !sb_session_is_playing(view->session));
}

static void on_loop(GtkToggleButton *button, View *view) {
  sb_session_set_loops(view->session, gtk_toggle_button_get_active(button));
}

static void show_playing(View *view, gboolean playing) {
  gtk_image_set_from_icon_name(GTK_IMAGE(view->play_icon),
                               playing ? "media-playback-pause-symbolic"
                                       : "media-playback-start-symbolic",
                               GTK_ICON_SIZE_BUTTON);
  sb_style_name(view->play, playing ? _("Pause") : _("Play"), NULL);
  gtk_widget_set_tooltip_text(view->play, playing ? _("Pause (Space)") : _("Play (Space)"));
  view->playing = playing;
}

static void describe_timeline(gpointer data) {
  View *view = data;
  g_autofree char *where = sb_session_where(view->session);
  sb_style_name(view->area, _("Timeline"), where[0] != '\0' ? where : _("No run yet"));
}

static void on_playhead(View *view) {
  if (sb_session_is_playing(view->session) != view->playing) {
    show_playing(view, !view->playing);
  }
  sb_later_ensure(&view->describe, view->area, 200, describe_timeline, view);
  sb_draw_cache_change(view->cache, sb_session_wants_ticks(view->session) ? TIMELINE_INTERVAL : 0);
}

static void on_frames(View *view) {
  refresh_speeds(view);
  sb_style_former(view->area, sb_session_shows_former(view->session));
  size_t count = 0;
  sb_session_frames(view->session, &count);
  gtk_widget_set_sensitive(view->play, count > 1);
  if (sb_session_awaits(view->session)) {
    sb_draw_cache_change_later(view->cache, SB_DRAW_LATER);
  } else {
    on_playhead(view);
  }
}

static GtkWidget *make_controls(View *view) {
  GtkWidget *rows = gtk_box_new(GTK_ORIENTATION_VERTICAL, 10);
  gtk_widget_set_valign(rows, GTK_ALIGN_CENTER);
  GtkWidget *row = gtk_box_new(GTK_ORIENTATION_HORIZONTAL, 8);
  gtk_container_add(GTK_CONTAINER(rows), row);

  GtkWidget *linked = sb_toolbar_linked();
  sb_toolbar_button(GTK_BOX(linked), "media-skip-backward-symbolic", _("Previous event"),
                    _("Previous event (Ctrl+Left)"), "win.previous-event");
  view->play = gtk_button_new();
  view->play_icon = gtk_image_new();
  gtk_container_add(GTK_CONTAINER(view->play), view->play_icon);
  g_signal_connect(view->play, "clicked", G_CALLBACK(on_play), view);
  gtk_container_add(GTK_CONTAINER(linked), view->play);
  sb_toolbar_button(GTK_BOX(linked), "media-skip-forward-symbolic", _("Next event"),
                    _("Next event (Ctrl+Right)"), "win.next-event");
  gtk_container_add(GTK_CONTAINER(row), linked);

  view->loop = gtk_toggle_button_new();
  gtk_container_add(
      GTK_CONTAINER(view->loop),
      gtk_image_new_from_icon_name("media-playlist-repeat-symbolic", GTK_ICON_SIZE_BUTTON));
  gtk_toggle_button_set_active(GTK_TOGGLE_BUTTON(view->loop), sb_session_loops(view->session));
  gtk_widget_set_tooltip_text(view->loop, _("Start again at the end"));
  sb_style_name(view->loop, _("Loop"), NULL);
  g_signal_connect(view->loop, "toggled", G_CALLBACK(on_loop), view);
  gtk_container_add(GTK_CONTAINER(row), view->loop);

  GtkWidget *pin = gtk_button_new();
  gtk_container_add(GTK_CONTAINER(pin),
                    gtk_image_new_from_icon_name("view-pin-symbolic", GTK_ICON_SIZE_BUTTON));
  gtk_actionable_set_action_name(GTK_ACTIONABLE(pin), "win.pin");
  gtk_widget_set_tooltip_text(pin, _("Pin this run for comparison with later runs (Ctrl+P)"));
  sb_style_name(pin, _("Pin this run"), NULL);
  gtk_container_add(GTK_CONTAINER(row), pin);
  gtk_container_add(GTK_CONTAINER(row), sb_notes_button_new(view->session));

  view->speed = sb_toolbar_combo(GTK_BOX(row), NULL, 0, _("Speed"), _("How fast the cycle plays"));
  gtk_widget_set_tooltip_text(view->speed, _("How fast the cycle plays"));
  g_signal_connect(view->speed, "changed", G_CALLBACK(on_speed), view);
  gtk_container_add(GTK_CONTAINER(rows), sb_pin_bar_new(view->session));
  return rows;
}

GtkWidget *sb_timeline_view_new(SbSession *session) {
  View *view = g_new0(View, 1);
  view->session = session;
  GtkWidget *box = gtk_box_new(GTK_ORIENTATION_HORIZONTAL, 16);
  g_object_set_data_full(G_OBJECT(box), "view", view, g_free);
  sb_style_class(box, "sb-timeline");
  GtkWidget *controls = make_controls(view);
  gtk_widget_set_margin_start(controls, 16);
  gtk_widget_set_size_request(controls, 300, -1);
  gtk_box_pack_start(GTK_BOX(box), controls, FALSE, FALSE, 0);

  view->area = sb_canvas_area_new(300, 300, 104, 131);
  sb_style_class(view->area, "sb-canvas");
  gtk_widget_set_can_focus(view->area, TRUE);
  gtk_widget_add_events(view->area,
                        GDK_BUTTON_PRESS_MASK | GDK_BUTTON1_MOTION_MASK | GDK_SCROLL_MASK);
  atk_object_set_role(gtk_widget_get_accessible(view->area), ATK_ROLE_SLIDER);
  view->cache = sb_draw_cache_attach(view->area, draw_timeline, view);
  g_signal_connect(view->area, "button-press-event", G_CALLBACK(on_timeline_press), view);
  g_signal_connect(view->area, "motion-notify-event", G_CALLBACK(on_timeline_motion), view);
  g_signal_connect(view->area, "scroll-event", G_CALLBACK(on_timeline_scroll), view);
  gtk_widget_set_has_tooltip(view->area, TRUE);
  g_signal_connect(view->area, "query-tooltip", G_CALLBACK(on_tooltip), view);
  gtk_box_pack_start(GTK_BOX(box), view->area, TRUE, TRUE, 0);

  sb_signals_end_with(box, view->session, view);
  g_signal_connect_swapped(session, "run-changed", G_CALLBACK(on_frames), view);
  g_signal_connect_swapped(session, "params-changed", G_CALLBACK(on_frames), view);
  g_signal_connect_swapped(session, "frames-changed", G_CALLBACK(on_frames), view);
  g_signal_connect_swapped(session, "playhead-changed", G_CALLBACK(on_playhead), view);
  gtk_widget_show_all(box);
  show_playing(view, FALSE);
  on_frames(view);
  return box;
}
