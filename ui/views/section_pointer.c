// Zoom, pan and camera of the section's picture, by pointer, wheel and keys.
#include "ui/views/section_private.h"

#include <math.h>

void sb_section_clamp_pan(SbSectionWidget *view) {
  double width = gtk_widget_get_allocated_width(view->area);
  double height = gtk_widget_get_allocated_height(view->area);
  view->pan_x = fmin(fmax(view->pan_x, 0), width * (view->zoom - 1));
  view->pan_y = fmin(fmax(view->pan_y, 0), height * (view->zoom - 1));
}

// Zooms so that the point (x, y) of the widget stays where it is.
static void zoom_pointer_at(SbSectionWidget *view, double factor, double x, double y) {
  double zoom = fmin(fmax(view->zoom * factor, 1), 6);
  view->pan_x = (view->pan_x + x) * zoom / view->zoom - x;
  view->pan_y = (view->pan_y + y) * zoom / view->zoom - y;
  view->zoom = zoom;
  gtk_widget_queue_resize(view->gl);
  sb_section_clamp_pan(view);
  sb_section_redraw(view);
}

void sb_section_view_zoom(GtkWidget *widget, int direction) {
  SbSectionWidget *view = g_object_get_data(G_OBJECT(widget), "view");
  double factor = direction > 0 ? 1.5 : direction < 0 ? 1 / 1.5 : 1e-9;
  zoom_pointer_at(view, factor, gtk_widget_get_allocated_width(view->area) / 2.0,
                  gtk_widget_get_allocated_height(view->area) * 0.75);
}

// The camera moves by angles from where it was; it goes round the valve, but not over it.
static void turn(SbSectionWidget *view, double azimuth, double elevation) {
  sb_session_set_camera(view->session, remainder(azimuth, 2 * G_PI),
                        fmin(fmax(elevation, -G_PI / 2), G_PI / 2));
  sb_section_on_change(view);
}

void sb_section_view_toggle_cutaway(GtkWidget *widget) {
  SbSectionWidget *view = g_object_get_data(G_OBJECT(widget), "view");
  gtk_toggle_button_set_active(GTK_TOGGLE_BUTTON(view->cutaway), !sb_section_is_cutaway(view));
}

void sb_section_view_turn(GtkWidget *widget, int right, int up) {
  SbSectionWidget *view = g_object_get_data(G_OBJECT(widget), "view");
  const double step = 5 * G_PI / 180;
  double azimuth, elevation;
  sb_session_camera(view->session, &azimuth, &elevation);
  if (sb_section_is_cutaway(view)) {
    turn(view, azimuth + right * step, elevation + up * step);
  }
}

static gboolean on_pointer_scroll(GtkWidget *widget, GdkEventScroll *event, SbSectionWidget *view) {
  double dx = 0;
  double dy = 0;
  if (event->direction == GDK_SCROLL_UP) {
    dy = -1;
  } else if (event->direction == GDK_SCROLL_DOWN) {
    dy = 1;
  } else {
    gdk_event_get_scroll_deltas((GdkEvent *)event, &dx, &dy);
  }
  zoom_pointer_at(view, pow(1.2, -dy), event->x, event->y);
  return GDK_EVENT_STOP;
}

// On the window's GL, which lies over the area.
static gboolean on_gl_scroll(GtkWidget *widget, GdkEventScroll *event, SbSectionWidget *view) {
  int x = 0;
  int y = 0;
  gtk_widget_translate_coordinates(widget, view->area, 0, 0, &x, &y);
  event->x += x;
  event->y += y;
  return on_pointer_scroll(view->area, event, view);
}

// A point of a widget over the picture in the picture's own pixels.
static SbPoint in_area(GtkWidget *widget, double x, double y, SbSectionWidget *view) {
  int dx = 0, dy = 0;
  gtk_widget_translate_coordinates(widget, view->area, 0, 0, &dx, &dy);
  return (SbPoint){x + dx, y + dy};
}

static gboolean on_pointer_press(GtkWidget *widget, GdkEventButton *event, SbSectionWidget *view) {
  gtk_widget_grab_focus(view->area);
  const SbPoint at = in_area(widget, event->x, event->y, view);
  view->pans = FALSE;
  if (event->button != GDK_BUTTON_PRIMARY || sb_section_handles_press(view->handles, at.x, at.y)) {
    return GDK_EVENT_STOP;
  }
  view->pans = TRUE;
  if (sb_section_is_cutaway(view)) {
    if (event->type == GDK_2BUTTON_PRESS) {
      turn(view, view->look.azimuth, view->look.elevation);
    }
    view->press_x = event->x;
    view->press_y = event->y;
    sb_session_camera(view->session, &view->press_azimuth, &view->press_elevation);
    return GDK_EVENT_STOP;
  }
  view->press_x = event->x + view->pan_x;
  view->press_y = event->y + view->pan_y;
  return GDK_EVENT_STOP;
}

static gboolean on_pointer_release(GtkWidget *widget, GdkEventButton *event,
                                   SbSectionWidget *view) {
  view->pans = FALSE;
  sb_section_handles_release(view->handles);
  return GDK_EVENT_STOP;
}

// A new layout under a pointer at rest leaves one widget for another without any motion.
static gboolean on_pointer_enter(GtkWidget *widget, GdkEventCrossing *event,
                                 SbSectionWidget *view) {
  sb_section_handles_enter(view->handles);
  return GDK_EVENT_PROPAGATE;
}

static gboolean on_pointer_leave(GtkWidget *widget, GdkEventCrossing *event,
                                 SbSectionWidget *view) {
  sb_section_handles_leave(view->handles);
  return GDK_EVENT_PROPAGATE;
}

static gboolean on_pointer_motion(GtkWidget *widget, GdkEventMotion *event, SbSectionWidget *view) {
  const SbPoint at = in_area(widget, event->x, event->y, view);
  if (sb_section_handles_motion(view->handles, at.x, at.y, event->state) || !view->pans) {
    return GDK_EVENT_STOP;
  }
  if (sb_section_is_cutaway(view)) {
    // The valve follows the hand: half a turn over 500 pixels.
    const double rate = G_PI / 500;
    turn(view, view->press_azimuth - rate * (event->x - view->press_x),
         view->press_elevation + rate * (event->y - view->press_y));
    return GDK_EVENT_STOP;
  }
  view->pan_x = view->press_x - event->x;
  view->pan_y = view->press_y - event->y;
  sb_section_clamp_pan(view);
  sb_section_redraw(view);
  return GDK_EVENT_STOP;
}

static void take_pointer(GtkWidget *widget, GCallback scrolled, SbSectionWidget *view) {
  gtk_widget_add_events(widget, GDK_BUTTON_PRESS_MASK | GDK_BUTTON_RELEASE_MASK |
                                    GDK_POINTER_MOTION_MASK | GDK_ENTER_NOTIFY_MASK |
                                    GDK_LEAVE_NOTIFY_MASK | GDK_SCROLL_MASK |
                                    GDK_SMOOTH_SCROLL_MASK);
  g_signal_connect(widget, "button-release-event", G_CALLBACK(on_pointer_release), view);
  g_signal_connect(widget, "enter-notify-event", G_CALLBACK(on_pointer_enter), view);
  g_signal_connect(widget, "leave-notify-event", G_CALLBACK(on_pointer_leave), view);
  g_signal_connect(widget, "scroll-event", scrolled, view);
  g_signal_connect(widget, "button-press-event", G_CALLBACK(on_pointer_press), view);
  g_signal_connect(widget, "motion-notify-event", G_CALLBACK(on_pointer_motion), view);
}

void sb_section_take_pointers(SbSectionWidget *view) {
  take_pointer(view->area, G_CALLBACK(on_pointer_scroll), view);
  take_pointer(view->gl, G_CALLBACK(on_gl_scroll), view);
}
