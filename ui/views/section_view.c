// The section of the valve at the playhead. The picture is the display list of app/section, drawn
// by GL (read back into the window's picture) where rings have fields, else by cairo. Zooming keeps
// the size of text and lines and enlarges the valve; drag moves it.
#include "ui/views/section_view.h"

#include "app/base/device.h"
#include "app/chart/rig.h"
#include "ui/views/canvas_area.h"
#include "ui/views/force_balance.h"
#include "ui/views/section_gl.h"
#include "ui/views/section_private.h"
#include "ui/views/signals.h"
#include "ui/views/style.h"

#include <glib/gi18n.h>
#include <math.h>

enum {
  INTERVAL = 33,     // between drawings while something moves [ms]
  EDGE = 4,          // of the picture beyond the section [px]
  MARGIN = 16,       // beside the picture [px]
  LOW = 480,         // below it a picture is too low for insets beside a section of
  LEAST_STRIP = 200, // this height [px]
  WIDE = 860         // from here the section has a column for legends and forces [px]
};

// By GL ------------------------------------------------------------------------------------------

// Fields inside rings are smooth by GL; cairo would draw facets. Where the window's own GL does not
// draw, a context without a window does: OSMesa or EGL, so that it works on every display.
static void on_gl_decided(void *data) {
  SbSectionWidget *view = data;
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
static SbRect picture_rect(SbSectionWidget *view, double area_width, double area_height) {
  const double top = 14;
  double width = area_width - 2 * MARGIN;
  gboolean balance = sb_session_run(view->session) != NULL && width < WIDE;
  double bottom = balance ? SB_FORCE_BALANCE_HEIGHT : 8;
  return (SbRect){MARGIN - EDGE, top - EDGE, fmax(width, 1) + 2 * EDGE,
                  fmax(area_height - top - bottom - 8, 1) + 2 * EDGE};
}

gboolean sb_section_is_cutaway(SbSectionWidget *view) {
  return gtk_toggle_button_get_active(GTK_TOGGLE_BUTTON(view->cutaway));
}

// The window's GL draws the picture unless it is zoomed and moved; a cutaway is zoomed by its
// camera.
static gboolean by_window(SbSectionWidget *view) {
  return (view->zoom <= 1 || sb_section_is_cutaway(view)) && sb_section_gl_works(view->gl);
}

static gboolean on_place(GtkOverlay *overlay, GtkWidget *child, GdkRectangle *place,
                         SbSectionWidget *view) {
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
static gboolean draw_by_gl(SbSectionWidget *view, cairo_t *cr, const SbRect *rect) {
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

static SbField chosen_field(SbSectionWidget *view) {
  return (SbField)MAX(gtk_combo_box_get_active(GTK_COMBO_BOX(view->field_combo)), 0);
}

gboolean sb_section_lacks_field(SbSectionWidget *view) {
  const SbRun *run = sb_session_run(view->session);
  return run != NULL && chosen_field(view) == SB_FIELD_PERMEATION &&
         sb_run_plan(run)->section_fields && !sb_run_plan(run)->permeation;
}

gboolean sb_section_asks_field(SbSectionWidget *view) {
  const SbModel *model = sb_session_model(view->session);
  return model != NULL && sb_model_look(model)->field == SB_FIELD_PERMEATION;
}

// Returns how the section of a run is drawn in `picture`, by the toolbar and the run's scene.
static SbSectionView view_of(SbSectionWidget *view, const SbRun *run, SbRect picture,
                             gboolean ran) {
  const SbSectionLook *look = sb_model_look(sb_run_model(run));
  const int inset = gtk_combo_box_get_active(GTK_COMBO_BOX(view->inset_combo)); // as output.insets
  const double enlarged = sb_section_is_cutaway(view) ? 1 : view->zoom;
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
      .field = sb_section_lacks_field(view) ? SB_FIELD_VON_MISES : chosen_field(view),
      .mesh = gtk_toggle_button_get_active(GTK_TOGGLE_BUTTON(view->mesh)),
      .full = look->section == SB_SECTION_FULL,
      .cutaway = sb_section_is_cutaway(view),
      .magnify = view->zoom,
      .undeformed = look->undeformed,
      .field_max = look->field_max,
  };
  sb_session_camera(view->session, &how.azimuth, &how.elevation);
  return how;
}

static void draw_section(cairo_t *cr, double area_width, double area_height, void *user) {
  SbSectionWidget *view = user;
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
  const gboolean cutaway = sb_section_is_cutaway(view), enlarges = !cutaway && view->zoom > 1;
  SbSectionView how = view_of(view, now.run, picture, ran);
  SbSectionInstant instant = {.frame = now.frame, .summary = ran ? data->run.summary : NULL};
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
  SbSectionWidget *view = data;
  g_autofree char *where = sb_session_where(view->session);
  double azimuth, elevation;
  sb_session_camera(view->session, &azimuth, &elevation);
  g_autofree char *cutaway =
      g_strdup_printf(_("Cutaway of the valve, azimuth %.0f°, elevation %.0f°"),
                      azimuth * 180 / G_PI, elevation * 180 / G_PI);
  const char *picture = sb_device(sb_session_chart(view->session)->run.model)->picture;
  const char *what = picture != NULL               ? _(picture)
                     : sb_section_is_cutaway(view) ? cutaway
                                                   : _("Axial section of the valve");
  g_autofree char *at = where[0] != '\0' ? g_strdup_printf("%s, %s", what, where)
                                         : g_strdup_printf(_("%s at rest, by closed forms"), what);
  g_autofree char *former = sb_session_former_text(view->session);
  g_autofree char *of = former != NULL ? g_strdup_printf(_(" Of the %s."), former) : NULL;
  g_autofree char *text = g_strconcat(at, ".", of, NULL);
  sb_style_name(view->area, _("Section"), text);
}

void sb_section_redraw(SbSectionWidget *view) {
  sb_draw_cache_change(view->cache, sb_session_wants_ticks(view->session) ? INTERVAL : 0);
}

static void describe_soon(SbSectionWidget *view) {
  sb_later_ensure(&view->describe, view->box, 200, describe, view);
}

void sb_section_on_change(SbSectionWidget *view) {
  sb_section_redraw(view);
  describe_soon(view);
}

// What the scene says about field and insets, when it says something new; after that the toolbar is
// free.
static void follow_look(SbSectionWidget *view) {
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

static void show_state(SbSectionWidget *view) {
  follow_look(view);
  gtk_widget_queue_resize(view->gl);
  gtk_widget_set_visible(view->no_field,
                         sb_section_lacks_field(view) && !sb_section_asks_field(view));
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
    sb_section_on_change(view);
  }
}

static void on_run_changed(SbSectionWidget *view) {
  sb_section_source_forget(view->source);
  show_state(view);
}

static void on_params_changed(SbSectionWidget *view) {
  if (sb_session_run(view->session) == NULL) {
    sb_section_source_forget(view->source);
  }
  show_state(view);
}

// Life -------------------------------------------------------------------------------------------

static void view_free(gpointer data) {
  SbSectionWidget *view = data;
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
  SbSectionWidget *view = g_object_get_data(G_OBJECT(widget), "view");
  sb_section_handles_listen(view->handles, chosen, data);
}

void sb_section_view_focus(GtkWidget *widget) {
  SbSectionWidget *view = g_object_get_data(G_OBJECT(widget), "view");
  gtk_widget_grab_focus(view->area);
}

gboolean sb_section_view_key(GtkWidget *widget, const GdkEventKey *event) {
  SbSectionWidget *view = g_object_get_data(G_OBJECT(widget), "view");
  return gtk_widget_has_focus(view->area) && sb_section_handles_key(view->handles, event);
}

void sb_section_view_add_start(GtkWidget *widget, GtkWidget *start) {
  SbSectionWidget *view = g_object_get_data(G_OBJECT(widget), "view");
  gtk_container_add(GTK_CONTAINER(view->empty), start);
}

GtkWidget *sb_section_view_new(SbSession *session) {
  SbSectionWidget *view = g_new0(SbSectionWidget, 1);
  view->session = session;
  view->source = sb_section_source_new(session);
  view->zoom = 1;
  view->text = sb_text_create();
  sb_draw_list_init(&view->list);
  view->box = gtk_box_new(GTK_ORIENTATION_VERTICAL, 0);
  g_object_set_data_full(G_OBJECT(view->box), "view", view, view_free);
  gtk_box_pack_start(GTK_BOX(view->box), sb_section_toolbar_new(view), FALSE, FALSE, 0);

  view->area = sb_canvas_area_new(380, 400, 240, 320);
  view->cache = sb_draw_cache_attach(view->area, draw_section, view);
  sb_style_class(view->area, "sb-canvas");
  gtk_widget_set_can_focus(view->area, TRUE);
  atk_object_set_role(gtk_widget_get_accessible(view->area), ATK_ROLE_IMAGE);
  GtkWidget *overlay = gtk_overlay_new();
  gtk_container_add(GTK_CONTAINER(overlay), view->area);
  view->gl = sb_section_gl_new(&view->list, on_gl_decided, view);
  sb_section_take_pointers(view);
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

  g_signal_connect_swapped(view->area, "size-allocate", G_CALLBACK(sb_section_clamp_pan), view);
  sb_signals_end_with(view->box, view->session, view);
  g_signal_connect_swapped(session, "params-changed", G_CALLBACK(on_params_changed), view);
  g_signal_connect_swapped(session, "run-changed", G_CALLBACK(on_run_changed), view);
  g_signal_connect_swapped(session, "frames-changed", G_CALLBACK(sb_section_on_change), view);
  g_signal_connect_swapped(session, "playhead-changed", G_CALLBACK(sb_section_on_change), view);
  describe(view);
  gtk_widget_show_all(view->box);
  on_run_changed(view);
  return view->box;
}
