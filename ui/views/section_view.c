// The section of the valve at the playhead. The picture is the display list of app/section, drawn
// by GL (read back into the window's picture) where rings have fields, else by cairo. Zooming keeps
// the size of text and lines and enlarges the valve; drag moves it.
#include "ui/views/section_view.h"

#include "app/base/device.h"
#include "app/base/translation.h"
#include "app/chart/rig.h"
#include "app/section/draw_cairo.h"
#include "app/section/gl_renderer.h"
#include "app/section/section.h"
#include "app/session/section_source.h"
#include "ui/views/canvas_area.h"
#include "ui/views/draw_cache.h"
#include "ui/views/force_balance.h"
#include "ui/views/later.h"
#include "ui/views/section_gl.h"
#include "ui/views/section_handles.h"
#include "ui/views/signals.h"
#include "ui/views/style.h"
#include "ui/views/toolbar.h"

#include <glib/gi18n.h>
#include <math.h>
#include <string.h>

enum {
  INTERVAL = 33,     // between drawings while something moves [ms]
  EDGE = 4,          // of the picture beyond the section [px]
  MARGIN = 16,       // beside the picture [px]
  LOW = 480,         // below it a picture is too low for insets beside a section of
  LEAST_STRIP = 200, // this height [px]
  WIDE = 860         // from here the section has a column for legends and forces [px]
};

typedef struct {
  SbSession *session;
  GtkWidget *gl; // over the picture where the window's own GL draws it
  GtkWidget *box, *area, *field_combo, *inset_combo, *forces, *labels, *mesh, *empty, *toggles,
      *heading;
  GtkWidget *cutaway, *rest, *no_field, *bar, *zooms;
  int zooms_width; // of the zoom buttons, with their gap
  SbLater fit;     // fits the toolbar to a new width
  SbSectionSource *source;
  SbDrawList list;
  SbText *text;
  SbSectionLook look; // of the scene that the toolbar followed last
  double zoom, pan_x, pan_y;
  double press_x, press_y;
  gboolean pans; // the button holds the picture
  double press_azimuth, press_elevation;
  SbGlContext *context;   // NULL where no GL works
  SbGlRenderer *renderer; // likewise
  cairo_surface_t *read;  // GL's picture
  SbDrawCache *cache;
  SbSectionHandles *handles;
  SbLater describe; // renews the description
} View;

// By GL ------------------------------------------------------------------------------------------

// Fields inside rings are smooth by GL; cairo would draw facets. Where the window's own GL does not
// draw, a context without a window does: OSMesa or EGL, so that it works on every display.
static void on_gl_decided(void *data) {
  View *view = data;
  if (sb_section_gl_works(view->gl)) {
    g_printerr("sealbench: section by %s\n", sb_section_gl_reason(view->gl));
    return;
  }
  SbReport report = {0};
  gdk_gl_context_clear_current();
  if (sb_gl_context_create(&view->context, SB_GL_AUTO, &report) == SB_OK &&
      sb_gl_renderer_create(&view->renderer, view->context, &report) != SB_OK) {
    g_clear_pointer(&view->context, sb_gl_context_destroy);
  }
  if (view->context != NULL) {
    sb_gl_context_release(view->context);
  }
  g_printerr("sealbench: section by %s; %s\n",
             view->renderer != NULL ? sb_gl_context_reason(view->context) : report.text,
             sb_section_gl_reason(view->gl));
}

// Where the section's picture is in the area. A wide one has the forces in its own column; it is a
// little more than the section itself, so that no letter is cut.
static SbRect picture_rect(View *view, double area_width, double area_height) {
  const double top = 14;
  double width = area_width - 2 * MARGIN;
  gboolean balance = sb_session_run(view->session) != NULL && width < WIDE;
  double bottom = balance ? SB_FORCE_BALANCE_HEIGHT : 8;
  return (SbRect){MARGIN - EDGE, top - EDGE, fmax(width, 1) + 2 * EDGE,
                  fmax(area_height - top - bottom - 8, 1) + 2 * EDGE};
}

static gboolean is_cutaway(View *view) {
  return gtk_toggle_button_get_active(GTK_TOGGLE_BUTTON(view->cutaway));
}

// The window's GL draws the picture unless it is zoomed and moved; a cutaway is zoomed by its
// camera.
static gboolean by_window(View *view) {
  return (view->zoom <= 1 || is_cutaway(view)) && sb_section_gl_works(view->gl);
}

static gboolean on_place(GtkOverlay *overlay, GtkWidget *child, GdkRectangle *place, View *view) {
  if (child != view->gl) {
    return FALSE;
  }
  SbRect rect = picture_rect(view, gtk_widget_get_allocated_width(GTK_WIDGET(overlay)),
                             gtk_widget_get_allocated_height(GTK_WIDGET(overlay)));
  // As large as the picture, but beyond the corner while something else draws it.
  *place = by_window(view) ? (GdkRectangle){(int)rect.x, (int)rect.y, (int)ceil(rect.width),
                                            (int)ceil(rect.height)}
                           : (GdkRectangle){-1, -1, 1, 1};
  return TRUE;
}

// Draws the list at the picture's place; false if GL cannot.
static gboolean draw_by_gl(View *view, cairo_t *cr, const SbRect *rect) {
  int scale = gtk_widget_get_scale_factor(view->area);
  int width = (int)ceil(rect->width) * scale;
  int height = (int)ceil(rect->height) * scale;
  // GDK may have a context of its own in mind, and has to make it current again after this.
  gdk_gl_context_clear_current();
  if (view->renderer == NULL || !sb_gl_context_make_current(view->context)) {
    return FALSE;
  }
  if (sb_gl_renderer_draw(view->renderer, &view->list, width, height, scale, NULL) != SB_OK) {
    sb_gl_context_release(view->context);
    return FALSE;
  }
  if (view->read == NULL || cairo_image_surface_get_width(view->read) != width ||
      cairo_image_surface_get_height(view->read) != height) {
    g_clear_pointer(&view->read, cairo_surface_destroy);
    view->read = cairo_image_surface_create(CAIRO_FORMAT_RGB24, width, height);
  }
  cairo_surface_flush(view->read);
  sb_gl_renderer_read(view->renderer, cairo_image_surface_get_data(view->read),
                      (size_t)cairo_image_surface_get_stride(view->read));
  sb_gl_context_release(view->context);
  cairo_surface_mark_dirty(view->read);
  cairo_surface_set_device_scale(view->read, scale, scale);
  cairo_set_source_surface(cr, view->read, rect->x, rect->y);
  cairo_pattern_set_filter(cairo_get_source(cr), CAIRO_FILTER_NEAREST);
  cairo_rectangle(cr, rect->x, rect->y, ceil(rect->width), ceil(rect->height));
  cairo_fill(cr);
  return TRUE;
}

// Drawing ----------------------------------------------------------------------------------------

static SbField chosen_field(View *view) {
  return (SbField)MAX(gtk_combo_box_get_active(GTK_COMBO_BOX(view->field_combo)), 0);
}

// The shown run has rings with fields, but not the chosen one.
static gboolean lacks_field(View *view) {
  const SbRun *run = sb_session_run(view->session);
  return run != NULL && chosen_field(view) == SB_FIELD_PERMEATION &&
         sb_run_plan(run)->section_fields && !sb_run_plan(run)->permeation;
}

// The values ask for it: the run to come will have it.
static gboolean asks_field(View *view) {
  const SbModel *model = sb_session_model(view->session);
  return model != NULL && sb_model_look(model)->field == SB_FIELD_PERMEATION;
}

// Returns how the section of a run is drawn in `picture`, by the toolbar and the run's scene.
static SbSectionView view_of(View *view, const SbRun *run, SbRect picture, gboolean ran) {
  const SbSectionLook *look = sb_model_look(sb_run_model(run));
  const int inset = gtk_combo_box_get_active(GTK_COMBO_BOX(view->inset_combo)); // as output.insets
  const double enlarged = is_cutaway(view) ? 1 : view->zoom;
  SbSectionView how = {
      .width = picture.width * enlarged,
      .height = picture.height * enlarged,
      .margin = EDGE,
      .dark = sb_style_is_dark(),
      .read_outs = ran,
      .hide_insets = !ran || inset == 2,
      .hide_forces = !gtk_toggle_button_get_active(GTK_TOGGLE_BUTTON(view->forces)),
      .hide_labels = !gtk_toggle_button_get_active(GTK_TOGGLE_BUTTON(view->labels)),
      .inset_seal = inset == 1 ? SB_INNER : SB_OUTER,
      .field = lacks_field(view) ? SB_FIELD_VON_MISES : chosen_field(view),
      .mesh = gtk_toggle_button_get_active(GTK_TOGGLE_BUTTON(view->mesh)),
      .full = look->section == SB_SECTION_FULL,
      .cutaway = is_cutaway(view),
      .magnify = view->zoom,
      .undeformed = look->undeformed,
      .field_max = look->field_max,
  };
  sb_session_camera(view->session, &how.azimuth, &how.elevation);
  return how;
}

static void draw(cairo_t *cr, double area_width, double area_height, void *user) {
  View *view = user;
  const SbTheme *theme = sb_style_ground(cr, SB_ROLE_PANEL);
  const SbChartData *data = sb_session_chart(view->session);
  if (!sb_device(data->run.model)->stem) {
    // No valve to cut: the plate itself.
    SbRect rect = {MARGIN, 14, fmax(area_width - 2 * MARGIN, 1), fmax(area_height - 28, 1)};
    sb_rig_plate_draw(cr, rect, theme, data, SB_CHART_COMPACT);
    sb_section_handles_follow(view->handles, NULL, NULL, NULL, (SbPoint){0, 0});
    return;
  }
  SbSectionSourceNow now;
  if (!sb_section_source_now(view->source, &now)) {
    return;
  }
  double width = area_width - 2 * MARGIN;
  double height = area_height;
  gboolean ran = sb_session_run(view->session) != NULL;
  SbRect picture = picture_rect(view, area_width, area_height);
  const gboolean cutaway = is_cutaway(view), enlarges = !cutaway && view->zoom > 1;
  SbSectionView how = view_of(view, now.run, picture, ran);
  SbSectionInstant instant = {.frame = now.frame};
  for (int i = 0; i < SB_SEAL_COUNT; i++) {
    instant.profile[i] = sb_run_profile(now.run, now.frame->seal[i].profile);
    instant.ring[i] = sb_run_shape(now.run, now.frame->seal[i].shape);
  }
  // In a low picture the insets give way to the section, which then takes both its halves.
  if (!cutaway && picture.height < LOW &&
      sb_section_strip_height(now.section, &how, &instant) < LEAST_STRIP) {
    how.hide_insets = TRUE;
    how.full =
        how.full || 2 * sb_section_strip_height(now.section, &how, &instant) < picture.height - 140;
  }
  sb_section_draw(now.section, &view->list, &how, &instant);
  const SbPoint corner = {picture.x - (enlarges ? view->pan_x : 0),
                          picture.y - (enlarges ? view->pan_y : 0)};
  sb_section_handles_follow(view->handles, cutaway || !ran ? NULL : now.section,
                            sb_run_model(now.run), now.frame, corner);
  cairo_save(cr);
  cairo_rectangle(cr, 0, 0, area_width, picture.y + picture.height + 4);
  cairo_clip(cr);
  gboolean field = instant.ring[SB_OUTER] != NULL || instant.ring[SB_INNER] != NULL;
  if (by_window(view)) {
    gtk_gl_area_queue_render(GTK_GL_AREA(view->gl));
  } else if ((!field && !cutaway) || enlarges || !draw_by_gl(view, cr, &picture)) {
    cairo_translate(cr, picture.x - (cutaway ? 0 : view->pan_x),
                    picture.y - (cutaway ? 0 : view->pan_y));
    sb_draw_list_to_cairo(&view->list, view->text, cr);
  }
  cairo_restore(cr);
  if (ran && width < WIDE) {
    SbRect balance = {MARGIN, height - SB_FORCE_BALANCE_HEIGHT, width, SB_FORCE_BALANCE_HEIGHT};
    sb_force_balance_draw(cr, balance, theme, data);
  }
}

static void describe(gpointer data) {
  View *view = data;
  g_autofree char *where = sb_session_where(view->session);
  double azimuth, elevation;
  sb_session_camera(view->session, &azimuth, &elevation);
  g_autofree char *cutaway =
      g_strdup_printf(_("Cutaway of the valve, azimuth %.0f°, elevation %.0f°"),
                      azimuth * 180 / G_PI, elevation * 180 / G_PI);
  const char *picture = sb_device(sb_session_chart(view->session)->run.model)->picture;
  const char *what = picture != NULL    ? _(picture)
                     : is_cutaway(view) ? cutaway
                                        : _("Axial section of the valve");
  g_autofree char *at = where[0] != '\0' ? g_strdup_printf("%s, %s", what, where)
                                         : g_strdup_printf(_("%s at rest, by closed forms"), what);
  g_autofree char *former = sb_session_former_text(view->session);
  g_autofree char *of = former != NULL ? g_strdup_printf(_(" Of the %s."), former) : NULL;
  g_autofree char *text = g_strconcat(at, ".", of, NULL);
  sb_style_name(view->area, _("Section"), text);
}

static void redraw(View *view) {
  sb_draw_cache_change(view->cache, sb_session_wants_ticks(view->session) ? INTERVAL : 0);
}

static void describe_soon(View *view) {
  sb_later_ensure(&view->describe, view->box, 200, describe, view);
}

static void on_change(View *view) {
  redraw(view);
  describe_soon(view);
}

// What the scene says about field and insets, when it says something new; after that the toolbar is
// free.
static void follow_look(View *view) {
  const SbModel *model = sb_session_model(view->session);
  if (model == NULL) {
    return;
  }
  const SbSectionLook *look = sb_model_look(model);
  SbSectionLook before = view->look;
  view->look = *look;
  if (look->field != before.field || look->insets != before.insets) {
    gtk_combo_box_set_active(GTK_COMBO_BOX(view->field_combo), look->field);
    gtk_combo_box_set_active(GTK_COMBO_BOX(view->inset_combo), look->insets);
  }
  if (look->azimuth != before.azimuth || look->elevation != before.elevation) {
    sb_session_set_camera(view->session, look->azimuth, look->elevation);
  }
  gboolean cutaway = look->section == SB_SECTION_CUTAWAY;
  if (cutaway != (before.section == SB_SECTION_CUTAWAY)) {
    gtk_toggle_button_set_active(GTK_TOGGLE_BUTTON(view->cutaway), cutaway);
  }
}

static void show_state(View *view) {
  follow_look(view);
  gtk_widget_queue_resize(view->gl);
  gtk_widget_set_visible(view->no_field, lacks_field(view) && !asks_field(view));
  gtk_widget_set_visible(view->empty, sb_session_state(view->session) == SB_SESSION_EMPTY);
  gtk_widget_set_visible(view->rest, sb_session_state(view->session) == SB_SESSION_RUNNING &&
                                         sb_session_run(view->session) == NULL);
  gboolean former = sb_session_shows_former(view->session);
  sb_style_former(view->area, former);
  sb_style_former(view->gl, former);
  // Only rings solved by finite elements have a field and a mesh to show.
  const SbRun *run = sb_session_run(view->session);
  gboolean solved = run != NULL && sb_run_plan(run)->section_fields;
  // The rig's picture has neither fields nor insets, and its forces and names always.
  const SbModel *model = sb_session_model(view->session);
  gboolean rig = !sb_device(model)->stem;
  gtk_label_set_text(GTK_LABEL(view->heading), rig ? _("Rig") : _("Section"));
  gtk_widget_set_visible(view->inset_combo, !rig);
  gtk_widget_set_visible(view->toggles, !rig);
  gtk_widget_set_visible(view->field_combo, solved && !rig);
  gtk_widget_set_visible(view->mesh, solved);
  // What those two need the heading gives, so that the toolbar is not cut.
  gtk_widget_set_visible(view->heading, rig || !solved);
  if (sb_session_awaits(view->session)) {
    sb_draw_cache_change_later(view->cache, SB_DRAW_LATER);
    describe_soon(view);
  } else {
    on_change(view);
  }
}

static void on_run_changed(View *view) {
  sb_section_source_forget(view->source);
  show_state(view);
}

static void on_params_changed(View *view) {
  if (sb_session_run(view->session) == NULL) {
    sb_section_source_forget(view->source);
  }
  show_state(view);
}

// Zoom and pan -----------------------------------------------------------------------------------

static void clamp_pan(View *view) {
  double width = gtk_widget_get_allocated_width(view->area);
  double height = gtk_widget_get_allocated_height(view->area);
  view->pan_x = fmin(fmax(view->pan_x, 0), width * (view->zoom - 1));
  view->pan_y = fmin(fmax(view->pan_y, 0), height * (view->zoom - 1));
}

// Zooms so that the point (x, y) of the widget stays where it is.
static void zoom_at(View *view, double factor, double x, double y) {
  double zoom = fmin(fmax(view->zoom * factor, 1), 6);
  view->pan_x = (view->pan_x + x) * zoom / view->zoom - x;
  view->pan_y = (view->pan_y + y) * zoom / view->zoom - y;
  view->zoom = zoom;
  gtk_widget_queue_resize(view->gl);
  clamp_pan(view);
  redraw(view);
}

void sb_section_view_zoom(GtkWidget *widget, int direction) {
  View *view = g_object_get_data(G_OBJECT(widget), "view");
  double factor = direction > 0 ? 1.5 : direction < 0 ? 1 / 1.5 : 1e-9;
  zoom_at(view, factor, gtk_widget_get_allocated_width(view->area) / 2.0,
          gtk_widget_get_allocated_height(view->area) * 0.75);
}

// The camera moves by angles from where it was; it goes round the valve, but not over it.
static void turn(View *view, double azimuth, double elevation) {
  sb_session_set_camera(view->session, remainder(azimuth, 2 * G_PI),
                        fmin(fmax(elevation, -G_PI / 2), G_PI / 2));
  on_change(view);
}

void sb_section_view_toggle_cutaway(GtkWidget *widget) {
  View *view = g_object_get_data(G_OBJECT(widget), "view");
  gtk_toggle_button_set_active(GTK_TOGGLE_BUTTON(view->cutaway), !is_cutaway(view));
}

void sb_section_view_turn(GtkWidget *widget, int right, int up) {
  View *view = g_object_get_data(G_OBJECT(widget), "view");
  const double step = 5 * G_PI / 180;
  double azimuth, elevation;
  sb_session_camera(view->session, &azimuth, &elevation);
  if (is_cutaway(view)) {
    turn(view, azimuth + right * step, elevation + up * step);
  }
}

static gboolean on_scroll(GtkWidget *widget, GdkEventScroll *event, View *view) {
  double dx = 0;
  double dy = 0;
  if (event->direction == GDK_SCROLL_UP) {
    dy = -1;
  } else if (event->direction == GDK_SCROLL_DOWN) {
    dy = 1;
  } else {
    gdk_event_get_scroll_deltas((GdkEvent *)event, &dx, &dy);
  }
  zoom_at(view, pow(1.2, -dy), event->x, event->y);
  return GDK_EVENT_STOP;
}

// On the window's GL, which lies over the area.
static gboolean on_gl_scroll(GtkWidget *widget, GdkEventScroll *event, View *view) {
  int x = 0;
  int y = 0;
  gtk_widget_translate_coordinates(widget, view->area, 0, 0, &x, &y);
  event->x += x;
  event->y += y;
  return on_scroll(view->area, event, view);
}

// A point of a widget over the picture in the picture's own pixels.
static SbPoint in_area(GtkWidget *widget, double x, double y, View *view) {
  int dx = 0, dy = 0;
  gtk_widget_translate_coordinates(widget, view->area, 0, 0, &dx, &dy);
  return (SbPoint){x + dx, y + dy};
}

static gboolean on_press(GtkWidget *widget, GdkEventButton *event, View *view) {
  gtk_widget_grab_focus(view->area);
  const SbPoint at = in_area(widget, event->x, event->y, view);
  view->pans = FALSE;
  if (event->button != GDK_BUTTON_PRIMARY || sb_section_handles_press(view->handles, at.x, at.y)) {
    return GDK_EVENT_STOP;
  }
  view->pans = TRUE;
  if (is_cutaway(view)) {
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

static gboolean on_release(GtkWidget *widget, GdkEventButton *event, View *view) {
  view->pans = FALSE;
  sb_section_handles_release(view->handles);
  return GDK_EVENT_STOP;
}

// A new layout under a pointer at rest leaves one widget for another without any motion.
static gboolean on_enter(GtkWidget *widget, GdkEventCrossing *event, View *view) {
  sb_section_handles_enter(view->handles);
  return GDK_EVENT_PROPAGATE;
}

static gboolean on_leave(GtkWidget *widget, GdkEventCrossing *event, View *view) {
  sb_section_handles_leave(view->handles);
  return GDK_EVENT_PROPAGATE;
}

static gboolean on_motion(GtkWidget *widget, GdkEventMotion *event, View *view) {
  const SbPoint at = in_area(widget, event->x, event->y, view);
  if (sb_section_handles_motion(view->handles, at.x, at.y, event->state) || !view->pans) {
    return GDK_EVENT_STOP;
  }
  if (is_cutaway(view)) {
    // The valve follows the hand: half a turn over 500 pixels.
    const double rate = G_PI / 500;
    turn(view, view->press_azimuth - rate * (event->x - view->press_x),
         view->press_elevation + rate * (event->y - view->press_y));
    return GDK_EVENT_STOP;
  }
  view->pan_x = view->press_x - event->x;
  view->pan_y = view->press_y - event->y;
  clamp_pan(view);
  redraw(view);
  return GDK_EVENT_STOP;
}

// Life -------------------------------------------------------------------------------------------

static void view_free(gpointer data) {
  View *view = data;
  if (view->renderer != NULL) {
    gdk_gl_context_clear_current();
    sb_gl_context_make_current(view->context);
  }
  sb_gl_renderer_destroy(view->renderer);
  sb_gl_context_destroy(view->context);
  g_clear_pointer(&view->read, cairo_surface_destroy);
  sb_draw_list_finish(&view->list);
  sb_text_destroy(view->text);
  sb_section_source_free(view->source);
  g_free(view);
}

static GtkWidget *toggle_new(View *view, const char *label, const char *tip, gboolean active,
                             GtkBox *box) {
  GtkWidget *toggle = gtk_toggle_button_new_with_label(label);
  gtk_toggle_button_set_active(GTK_TOGGLE_BUTTON(toggle), active);
  gtk_widget_set_tooltip_text(toggle, tip);
  g_signal_connect_swapped(toggle, "toggled", G_CALLBACK(on_change), view);
  gtk_box_pack_start(box, toggle, FALSE, FALSE, 0);
  return toggle;
}

static void on_field(View *view) {
  gtk_widget_set_visible(view->no_field, lacks_field(view) && !asks_field(view));
  on_change(view);
}

// Insets belong to the section. The zoom starts anew: it means another thing.
static void on_cutaway(View *view) {
  gtk_widget_set_sensitive(view->inset_combo, !is_cutaway(view));
  view->zoom = 1;
  view->pan_x = view->pan_y = 0;
  gtk_widget_queue_resize(view->gl);
}

// The zoom buttons, which wheel and keys do as well, give way where the toolbar has no room.
static void on_fit(gpointer data) {
  View *view = data;
  const gboolean shown = gtk_widget_get_visible(view->zooms);
  const int room = gtk_widget_get_allocated_width(gtk_widget_get_parent(view->bar));
  int least = 0;
  gtk_widget_get_preferred_width(view->bar, &least, NULL);
  if (shown) {
    enum { GAP = 8 };
    view->zooms_width = gtk_widget_get_allocated_width(view->zooms) + GAP;
  }
  const gboolean fits = room >= least + (shown ? 0 : view->zooms_width);
  if (fits != shown) {
    gtk_widget_set_visible(view->zooms, fits);
  }
}

// Not inside an allocation, where nothing may come or go.
static void on_toolbar_allocate(View *view) {
  sb_later_ensure(&view->fit, view->box, 0, on_fit, view);
}

static GtkWidget *make_toolbar(View *view) {
  GtkWidget *bar = gtk_box_new(GTK_ORIENTATION_HORIZONTAL, 8);
  sb_style_class(bar, "sb-toolbar");
  GtkWidget *heading = gtk_label_new(_("Section"));
  sb_style_class(heading, "sb-heading");
  gtk_widget_set_margin_end(heading, 4);
  view->heading = heading;
  gtk_box_pack_start(GTK_BOX(bar), heading, FALSE, FALSE, 0);

  const char *fields[SB_FIELD_COUNT];
  for (int i = 0; i < SB_FIELD_COUNT; i++) {
    fields[i] = sb_section_field_name((SbField)i);
  }
  view->field_combo = sb_toolbar_combo(GTK_BOX(bar), fields, SB_FIELD_COUNT, _("Field"),
                                       _("Quantity that the colours of solved rings show"));
  gtk_widget_set_no_show_all(view->field_combo, TRUE);
  g_signal_connect_swapped(view->field_combo, "changed", G_CALLBACK(on_field), view);
  static const char *const insets[] = {N_("Insets: outer seal"), N_("Insets: inner seal"),
                                       N_("No insets")};
  view->inset_combo = sb_toolbar_combo(GTK_BOX(bar), insets, G_N_ELEMENTS(insets), _("Insets"),
                                       _("Which seal's contact the insets enlarge"));
  g_signal_connect_swapped(view->inset_combo, "changed", G_CALLBACK(on_change), view);

  GtkWidget *toggles = sb_toolbar_linked();
  view->forces = toggle_new(view, _("Forces"), _("Force arrows"), TRUE, GTK_BOX(toggles));
  view->labels =
      toggle_new(view, _("Labels"), _("Names and values of the parts"), TRUE, GTK_BOX(toggles));
  view->cutaway =
      toggle_new(view, _("Cutaway"),
                 _("The valve in three dimensions, a quarter cut away (Ctrl+D). Drag or "
                   "Alt+arrows turn it, a double click turns it back"),
                 FALSE, GTK_BOX(toggles));
  g_signal_connect_swapped(view->cutaway, "toggled", G_CALLBACK(on_cutaway), view);
  view->mesh = toggle_new(view, _("Mesh"), _("Elements of solved rings"), FALSE, GTK_BOX(toggles));
  gtk_widget_set_no_show_all(view->mesh, TRUE);
  gtk_box_pack_start(GTK_BOX(bar), toggles, FALSE, FALSE, 0);
  view->toggles = toggles;

  GtkWidget *zooms = sb_toolbar_linked();
  sb_toolbar_button(GTK_BOX(zooms), "zoom-out-symbolic", _("Zoom out"), _("Zoom out"),
                    "win.zoom-out");
  sb_toolbar_button(GTK_BOX(zooms), "zoom-fit-best-symbolic", _("Full valve"), _("Full valve"),
                    "win.zoom-fit");
  sb_toolbar_button(GTK_BOX(zooms), "zoom-in-symbolic", _("Zoom in"), _("Zoom in"), "win.zoom-in");
  gtk_box_pack_end(GTK_BOX(bar), zooms, FALSE, FALSE, 0);
  view->bar = bar;
  view->zooms = zooms;
  g_signal_connect_swapped(bar, "size-allocate", G_CALLBACK(on_toolbar_allocate), view);

  // In a narrow window the toolbar scrolls, so that it does not decide how narrow that can be.
  GtkWidget *scroller = gtk_scrolled_window_new(NULL, NULL);
  gtk_scrolled_window_set_policy(GTK_SCROLLED_WINDOW(scroller), GTK_POLICY_AUTOMATIC,
                                 GTK_POLICY_NEVER);
  gtk_container_add(GTK_CONTAINER(scroller), bar);
  return scroller;
}

// Places a widget at the top of the picture, in the middle.
static void place_top(GtkWidget *widget, int margin) {
  gtk_widget_set_halign(widget, GTK_ALIGN_CENTER);
  gtk_widget_set_valign(widget, GTK_ALIGN_START);
  gtk_widget_set_margin_top(widget, margin);
  gtk_widget_set_no_show_all(widget, TRUE);
}

// Over the picture while nothing has run: one sentence, one button.
static GtkWidget *make_empty(void) {
  GtkWidget *box = gtk_box_new(GTK_ORIENTATION_VERTICAL, 10);
  sb_style_class(box, "sb-empty");
  gtk_container_add(GTK_CONTAINER(box),
                    gtk_label_new(_("Run the cycle to see forces, contacts and film.")));
  GtkWidget *button = gtk_button_new_with_label(_("Run the cycle"));
  gtk_actionable_set_action_name(GTK_ACTIONABLE(button), "win.run-or-stop");
  gtk_widget_set_halign(button, GTK_ALIGN_CENTER);
  sb_style_class(button, "suggested-action");
  gtk_container_add(GTK_CONTAINER(box), button);
  gtk_widget_show_all(box);
  place_top(box, 60);
  return box;
}

void sb_section_view_listen(GtkWidget *widget,
                            void (*chosen)(void *data, SbParamId id, const char *typed),
                            void *data) {
  View *view = g_object_get_data(G_OBJECT(widget), "view");
  sb_section_handles_listen(view->handles, chosen, data);
}

void sb_section_view_focus(GtkWidget *widget) {
  View *view = g_object_get_data(G_OBJECT(widget), "view");
  gtk_widget_grab_focus(view->area);
}

gboolean sb_section_view_key(GtkWidget *widget, const GdkEventKey *event) {
  View *view = g_object_get_data(G_OBJECT(widget), "view");
  return gtk_widget_has_focus(view->area) && sb_section_handles_key(view->handles, event);
}

void sb_section_view_add_start(GtkWidget *widget, GtkWidget *start) {
  View *view = g_object_get_data(G_OBJECT(widget), "view");
  gtk_container_add(GTK_CONTAINER(view->empty), start);
}

static void take_pointer(GtkWidget *widget, GCallback scrolled, View *view) {
  gtk_widget_add_events(widget, GDK_BUTTON_PRESS_MASK | GDK_BUTTON_RELEASE_MASK |
                                    GDK_POINTER_MOTION_MASK | GDK_ENTER_NOTIFY_MASK |
                                    GDK_LEAVE_NOTIFY_MASK | GDK_SCROLL_MASK |
                                    GDK_SMOOTH_SCROLL_MASK);
  g_signal_connect(widget, "button-release-event", G_CALLBACK(on_release), view);
  g_signal_connect(widget, "enter-notify-event", G_CALLBACK(on_enter), view);
  g_signal_connect(widget, "leave-notify-event", G_CALLBACK(on_leave), view);
  g_signal_connect(widget, "scroll-event", scrolled, view);
  g_signal_connect(widget, "button-press-event", G_CALLBACK(on_press), view);
  g_signal_connect(widget, "motion-notify-event", G_CALLBACK(on_motion), view);
}

GtkWidget *sb_section_view_new(SbSession *session) {
  View *view = g_new0(View, 1);
  view->session = session;
  view->source = sb_section_source_new(session);
  view->zoom = 1;
  view->text = sb_text_create();
  sb_draw_list_init(&view->list);
  view->box = gtk_box_new(GTK_ORIENTATION_VERTICAL, 0);
  g_object_set_data_full(G_OBJECT(view->box), "view", view, view_free);
  gtk_box_pack_start(GTK_BOX(view->box), make_toolbar(view), FALSE, FALSE, 0);

  view->area = sb_canvas_area_new(380, 400, 240, 320);
  view->cache = sb_draw_cache_attach(view->area, draw, view);
  sb_style_class(view->area, "sb-canvas");
  gtk_widget_set_can_focus(view->area, TRUE);
  take_pointer(view->area, G_CALLBACK(on_scroll), view);
  atk_object_set_role(gtk_widget_get_accessible(view->area), ATK_ROLE_IMAGE);
  GtkWidget *overlay = gtk_overlay_new();
  gtk_container_add(GTK_CONTAINER(overlay), view->area);
  view->gl = sb_section_gl_new(&view->list, on_gl_decided, view);
  take_pointer(view->gl, G_CALLBACK(on_gl_scroll), view);
  sb_style_name(view->gl, _("Section picture"), NULL);
  gtk_overlay_add_overlay(GTK_OVERLAY(overlay), view->gl);
  g_signal_connect(overlay, "get-child-position", G_CALLBACK(on_place), view);
  view->handles = sb_section_handles_new(session, GTK_OVERLAY(overlay));
  view->empty = make_empty();
  gtk_overlay_add_overlay(GTK_OVERLAY(overlay), view->empty);
  // Whatever models are being run, the valve at rest is drawn by closed forms.
  view->rest =
      gtk_label_new(_("Being computed. Until its first frame: the valve at rest, by closed "
                      "forms."));
  sb_style_class(view->rest, "sb-empty");
  gtk_label_set_line_wrap(GTK_LABEL(view->rest), TRUE);
  place_top(view->rest, 70);
  gtk_overlay_add_overlay(GTK_OVERLAY(overlay), view->rest);
  view->no_field =
      gtk_label_new(_("This run has no permeation: set Field (output.field) to permeation to have "
                      "it computed. Shown: von Mises stress."));
  sb_style_class(view->no_field, "sb-plate");
  gtk_label_set_line_wrap(GTK_LABEL(view->no_field), TRUE);
  place_top(view->no_field, 70);
  gtk_overlay_add_overlay(GTK_OVERLAY(overlay), view->no_field);
  gtk_box_pack_start(GTK_BOX(view->box), overlay, TRUE, TRUE, 0);

  g_signal_connect_swapped(view->area, "size-allocate", G_CALLBACK(clamp_pan), view);
  sb_signals_end_with(view->box, view->session, view);
  g_signal_connect_swapped(session, "params-changed", G_CALLBACK(on_params_changed), view);
  g_signal_connect_swapped(session, "run-changed", G_CALLBACK(on_run_changed), view);
  g_signal_connect_swapped(session, "frames-changed", G_CALLBACK(on_change), view);
  g_signal_connect_swapped(session, "playhead-changed", G_CALLBACK(on_change), view);
  describe(view);
  gtk_widget_show_all(view->box);
  on_run_changed(view);
  return view->box;
}
