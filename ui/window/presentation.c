// See presentation.h. The pictures are those of `sealbench render`, their pages made for a smaller
// size so that the type is larger. A kept design is shown in the live one's place, and that as the
// one it is compared with; the document stays as it is.
#include "ui/window/presentation.h"

#include "app/base/device.h"
#include "app/chart/compare.h"
#include "app/chart/page.h"
#include "app/export/render.h"
#include "app/section/painter.h"
#include "ui/views/draw_cache.h"
#include "ui/views/style.h"

#include <glib/gi18n.h>
#include <math.h>
#include <string.h>

// What the digits choose. The page's share of the size that its view is made for.
static const struct {
  const char *view; // of sb_render_views(); NULL: the table of figures
  const char *label;
  double share;
} pictures[] = {{"section", N_("Section"), 0.9},
                {"cutaway", N_("Cutaway"), 0.9},
                {"hysteresis", N_("Force and displacement"), 0.75},
                {"profiles", N_("Contact and film"), 0.8},
                {"dashboard", N_("Dashboard"), 0.8},
                {NULL, N_("Figures"), 0}};

enum { INTERVAL = 33, BAND = 76, PAD = 24, TABLE_WIDTH = 640, TABLE_HEIGHT = 480 };

typedef struct {
  SbSession *session;
  GtkWidget *window, *area;
  SbDrawCache *cache;
  // By GL where rings have fields and for the cutaway, else by cairo, which is quicker.
  SbSectionPainter *painter[2];
  guint picture; // of the table
  size_t design; // 0: live, else of a kept one + 1
  guint tick;
  GdkRectangle screen;
  GdkWindow *below; // held, of the window that this one lies on
  gboolean covers;  // it cannot be seen and is not drawn
} Presentation;

// What is shown -----------------------------------------------------------------------------------

// The chosen design in the live one's place.
static SbChartData shown(Presentation *self) {
  SbChartData data = *sb_session_chart(self->session);
  SbChartPin pin;
  if (self->design > sb_session_pin_count(self->session)) {
    self->design = 0; // it was dropped
  }
  if (self->design == 0 || !sb_session_pin_chart(self->session, self->design - 1, &pin)) {
    return data;
  }
  const SbChartRun *live = &sb_session_chart(self->session)->run;
  const size_t playhead = data.playhead;
  data.run = *pin.run;
  data.playhead = pin.frame;
  data.title = pin.name;
  data.pin_count = live->count > 0 ? 1 : 0;
  data.pin[0] = (SbChartPin){.run = live, .name = "live", .look = pin.look, .frame = playhead};
  data.earlier = NULL;
  data.predicted = NULL;
  data.measured = NULL;
  data.hash = NULL;
  data.stale = NULL;
  data.failure = NULL;
  return data;
}

// The bookmark that the playhead stands on; NULL: none.
static const char *bookmark_here(Presentation *self) {
  const SbChartData *data = sb_session_chart(self->session);
  const SbFrame *frame = sb_chart_frame(data);
  // By its time: an event may have two frames of one.
  for (size_t i = 0; frame != NULL && i < data->marker_count; i++) {
    if (data->run.frames[sb_chart_nearest(&data->run, data->marker[i].time)].time == frame->time) {
      return data->marker[i].name;
    }
  }
  return NULL;
}

// The bookmark's name, "stage D" on an event, else "C-D: both seals slide". Owned by the caller.
static char *stop_text(Presentation *self) {
  const char *bookmark = bookmark_here(self);
  const SbChartData *data = sb_session_chart(self->session);
  const SbFrame *frame = sb_chart_frame(data);
  if (bookmark != NULL || frame == NULL) {
    return g_strdup(bookmark != NULL ? bookmark : _("Nothing has run yet"));
  }
  size_t events = 0;
  const SbTraceEvent *event = sb_trace_events(data->run.trace, &events);
  for (size_t i = 0; i < events; i++) {
    if (event[i].mark.frame == data->playhead) {
      return g_strdup_printf(_("stage %s"), sb_stage_name(event[i].stage));
    }
  }
  return g_strdup_printf("%s: %s", sb_chart_span(&data->run, frame->stage),
                         sb_chart_phase(&data->run, frame->stage));
}

static char *design_text(Presentation *self) {
  const size_t count = sb_session_pin_count(self->session);
  if (count == 0) {
    return g_strdup("");
  }
  return g_strdup_printf(_("Design %zu of %zu: %s"), self->design + 1, count + 1,
                         self->design == 0 ? _("live")
                                           : sb_session_pin_name(self->session, self->design - 1));
}

// What was noted: on the bookmark here, else on the design.
static const char *note_here(Presentation *self) {
  const SbDocument *document = sb_session_document(self->session);
  const char *name = bookmark_here(self);
  const char *note = name != NULL ? sb_document_remark(document, SB_REMARK_NOTE, name) : NULL;
  if (note == NULL && self->design > 0) {
    name = sb_document_pin_name(document, self->design - 1);
    note = name != NULL ? sb_document_remark(document, SB_REMARK_NOTE, name) : NULL;
  }
  return note;
}

// Drawing -----------------------------------------------------------------------------------------

static void draw_table(cairo_t *cr, SbRect rect, const SbTheme *theme, const SbChartData *data) {
  const SbPage page = sb_page_begin(cr, rect, TABLE_WIDTH, TABLE_HEIGHT, theme);
  sb_page_header_draw(cr, page.whole, theme, data, SB_CHART_WHOLE);
  sb_compare_draw(cr, page.body, theme, data, SB_CHART_PANEL);
  sb_page_footer_draw(cr, page.whole, theme, data, 0);
  cairo_restore(cr);
}

static void draw_picture(Presentation *self, cairo_t *cr, SbRect rect, const SbTheme *theme,
                         const SbChartData *data) {
  const char *name = pictures[self->picture].view;
  if (name == NULL) {
    draw_table(cr, rect, theme, data);
    return;
  }
  SbRenderView view = *sb_render_view(name);
  if (view.cutaway && !sb_device(data->run.model)->stem) { // the sliding plate has no cutaway
    view = *sb_render_view("section");
  }
  view.width *= pictures[self->picture].share;
  view.height *= pictures[self->picture].share;
  const SbRun *run = sb_session_run(self->session);
  SbSectionPainter *painter =
      self->painter[view.cutaway || (run != NULL && sb_run_plan(run)->section_fields)];
  if (data->run.model != NULL) {
    SbSectionStyle style = sb_section_style_of(data->run.model);
    style.cutaway = view.cutaway;
    sb_session_camera(self->session, &style.azimuth, &style.elevation);
    sb_section_painter_style(painter, &style);
  }
  // GDK may have a context of its own in mind.
  gdk_gl_context_clear_current();
  sb_render_draw(cr, rect, theme, data, 0, &view, sb_section_painter_draw, painter);
}

// Draws a text of some lines with its top at y; its height.
static double draw_note(cairo_t *cr, const char *text, double x, double y, double width,
                        double size, SbColor color, gboolean measure) {
  g_autoptr(PangoLayout) layout = pango_cairo_create_layout(cr);
  PangoFontDescription *font = pango_font_description_from_string("Inter, Cantarell, DejaVu Sans");
  pango_font_description_set_absolute_size(font, size * PANGO_SCALE);
  pango_layout_set_font_description(layout, font);
  pango_font_description_free(font);
  pango_layout_set_width(layout, (int)(width * PANGO_SCALE));
  pango_layout_set_height(layout, -4); // at most four lines a paragraph
  pango_layout_set_ellipsize(layout, PANGO_ELLIPSIZE_END);
  pango_layout_set_text(layout, text, -1);
  int height = 0;
  pango_layout_get_pixel_size(layout, NULL, &height);
  if (!measure) {
    cairo_set_source_rgb(cr, color.r, color.g, color.b);
    cairo_move_to(cr, x, y);
    pango_cairo_show_layout(cr, layout);
  }
  return height;
}

static void draw_presentation(cairo_t *cr, double width, double height, void *user) {
  Presentation *self = user;
  const SbTheme *theme = sb_style_ground(cr, SB_ROLE_PANEL);
  const SbChartData data = shown(self);
  const double big = fmax(fmin(width / 1280, height / 720), 0.5);
  const double band = BAND * big, pad = PAD * big;
  const char *note = note_here(self);
  const SbColor ink = theme->role[SB_ROLE_INK];
  const double lines =
      note != NULL ? draw_note(cr, note, 0, 0, width - 2 * pad, 20 * big, ink, TRUE) + pad : 0;
  const double text = fmin(lines, 0.4 * height);
  draw_picture(self, cr, (SbRect){0, 0, width, fmax(height - band - text, 1)}, theme, &data);

  const double top = height - band - text;
  cairo_save(cr);
  cairo_rectangle(cr, 0, top, width, height - top);
  cairo_clip(cr);
  const SbColor ground = theme->role[SB_ROLE_PANEL];
  cairo_set_source_rgb(cr, ground.r, ground.g, ground.b);
  cairo_paint(cr);
  if (note != NULL) {
    draw_note(cr, note, pad, top + pad / 2, width - 2 * pad, 20 * big, ink, FALSE);
  }
  SbCanvas canvas, *c = &canvas;
  sb_canvas_init(c, cr, theme);
  const double y = height - band;
  sb_canvas_hairline(c, 0, top, width, top, sb_canvas_role(c, SB_ROLE_HAIRLINE));
  const SbTextStyle stop = sb_canvas_style(c, 26 * big, 700, SB_ROLE_NOW);
  const SbTextStyle design = sb_canvas_style(c, 22 * big, 600, SB_ROLE_INK);
  const SbTextStyle keys = sb_canvas_style(c, 13 * big, 400, SB_ROLE_SECOND);
  g_autofree char *here = stop_text(self), *of = design_text(self);
  const double right = sb_canvas_text_width(c, of, &design);
  sb_canvas_text_fit(c, here, &stop, pad, y + 36 * big, width - 3 * pad - fmin(right, width / 2));
  if (right <= width / 2) {
    sb_canvas_text(c, of, &design, width - pad, y + 36 * big, SB_RIGHT);
  } else {
    sb_canvas_text_fit_ends(c, of, &design, width / 2 - pad, y + 36 * big, width / 2);
  }
  sb_canvas_text(c,
                 _("← → stages and bookmarks   ↑ ↓ designs   1 – 6 pictures   Space plays   "
                   "Esc ends"),
                 &keys, pad, y + 62 * big, SB_LEFT);
  sb_canvas_text(c, _(pictures[self->picture].label), &keys, width - pad, y + 62 * big, SB_RIGHT);
  sb_canvas_finish(c);
  cairo_restore(cr);
}

static void redraw(Presentation *self) {
  sb_draw_cache_change(self->cache, sb_session_wants_ticks(self->session) ? INTERVAL : 0);
}

static gboolean on_tick(GtkWidget *widget, GdkFrameClock *clock, gpointer data) {
  Presentation *self = data;
  sb_session_tick(self->session, gdk_frame_clock_get_frame_time(clock));
  if (!sb_session_wants_ticks(self->session)) {
    self->tick = 0;
    return G_SOURCE_REMOVE;
  }
  return G_SOURCE_CONTINUE;
}

// The window below, which may not be drawn at all, need not have a clock that runs.
static void on_change(Presentation *self) {
  if (self->tick == 0 && sb_session_wants_ticks(self->session)) {
    self->tick = gtk_widget_add_tick_callback(self->area, on_tick, self, NULL);
  }
  g_autofree char *here = stop_text(self), *of = design_text(self);
  g_autofree char *text = g_strdup_printf("%s. %s. %s", here, of, _(pictures[self->picture].label));
  sb_style_name(self->area, _("Presented picture"), text);
  redraw(self);
}

// Keys --------------------------------------------------------------------------------------------

// The next design that has a run.
static void step_design(Presentation *self, int step) {
  const size_t count = sb_session_pin_count(self->session) + 1;
  SbChartPin pin;
  for (size_t tried = 0; tried < count; tried++) {
    self->design = (self->design + (step > 0 ? 1 : count - 1)) % count;
    if (self->design == 0 || sb_session_pin_chart(self->session, self->design - 1, &pin)) {
      break;
    }
  }
  on_change(self);
}

static gboolean on_presentation_key(GtkWidget *widget, GdkEventKey *event, Presentation *self) {
  if ((event->state & gtk_accelerator_get_default_mod_mask()) != 0) {
    return GDK_EVENT_PROPAGATE;
  }
  switch (event->keyval) {
  case GDK_KEY_Right:
  case GDK_KEY_Page_Down:
    sb_session_step_event(self->session, 1);
    break;
  case GDK_KEY_Left:
  case GDK_KEY_Page_Up:
    sb_session_step_event(self->session, -1);
    break;
  case GDK_KEY_Down:
    step_design(self, 1);
    break;
  case GDK_KEY_Up:
    step_design(self, -1);
    break;
  case GDK_KEY_Home:
    sb_session_set_playhead(self->session, 0);
    break;
  case GDK_KEY_End:
    sb_session_set_playhead(self->session, G_MAXSIZE);
    break;
  case GDK_KEY_space:
    sb_session_play(self->session, !sb_session_is_playing(self->session));
    break;
  case GDK_KEY_Escape:
  case GDK_KEY_F5:
    gtk_widget_destroy(self->window);
    break;
  default:
    if (event->keyval >= GDK_KEY_1 && event->keyval < GDK_KEY_1 + G_N_ELEMENTS(pictures)) {
      self->picture = event->keyval - GDK_KEY_1;
      on_change(self);
      break;
    }
    return GDK_EVENT_PROPAGATE;
  }
  return GDK_EVENT_STOP;
}

// The window below
// ---------------------------------------------------------------------------------

static void set_covers(Presentation *self, gboolean covers) {
  if (covers != self->covers && !gdk_window_is_destroyed(self->below)) {
    (covers ? gdk_window_freeze_updates : gdk_window_thaw_updates)(self->below);
  }
  self->covers = covers;
}

static void on_presentation_size(Presentation *self, const GdkRectangle *size) {
  set_covers(self, size->width >= self->screen.width && size->height >= self->screen.height);
}

// Life --------------------------------------------------------------------------------------------

static void on_presentation_destroy(GtkWidget *widget, Presentation *self) {
  set_covers(self, FALSE);
  g_signal_handlers_disconnect_by_data(self->session, self);
  gdk_gl_context_clear_current();
  for (int gl = 0; gl < 2; gl++) {
    g_clear_pointer(&self->painter[gl], sb_section_painter_destroy);
  }
}

static void presentation_free(gpointer data) {
  Presentation *self = data;
  g_object_unref(self->session);
  g_object_unref(self->below);
  g_free(self);
}

void sb_presentation_open(GtkWindow *parent, SbSession *session) {
  Presentation *self = g_new0(Presentation, 1);
  SbReport report = {0};
  gdk_gl_context_clear_current();
  for (int gl = 0; gl < 2; gl++) {
    if (sb_section_painter_create(&self->painter[gl], gl, SB_GL_AUTO, &report) != SB_OK) {
      sb_section_painter_destroy(self->painter[0]);
      g_free(self);
      return;
    }
  }
  self->session = g_object_ref(session);
  self->window = gtk_window_new(GTK_WINDOW_TOPLEVEL);
  GtkWindow *window = GTK_WINDOW(self->window);
  g_object_set_data_full(G_OBJECT(window), "presentation", self, presentation_free);
  g_autofree char *title =
      g_strdup_printf(_("Presentation of %s"), sb_document_title(sb_session_document(session)));
  gtk_window_set_title(window, title);
  gtk_window_set_transient_for(window, parent);
  gtk_window_set_destroy_with_parent(window, TRUE);
  // As large as the screen also where no window manager makes it so.
  GdkWindow *place = gtk_widget_get_window(GTK_WIDGET(parent));
  GdkDisplay *display = gtk_widget_get_display(GTK_WIDGET(parent));
  self->below = g_object_ref(place);
  gdk_monitor_get_geometry(gdk_display_get_monitor_at_window(display, place), &self->screen);
  gtk_window_set_default_size(window, self->screen.width, self->screen.height);
  sb_style_window(self->window);
  self->area = gtk_drawing_area_new();
  atk_object_set_role(gtk_widget_get_accessible(self->area), ATK_ROLE_IMAGE);
  self->cache = sb_draw_cache_attach(self->area, draw_presentation, self);
  gtk_container_add(GTK_CONTAINER(window), self->area);
  g_signal_connect(window, "key-press-event", G_CALLBACK(on_presentation_key), self);
  g_signal_connect(window, "destroy", G_CALLBACK(on_presentation_destroy), self);
  g_signal_connect_swapped(window, "size-allocate", G_CALLBACK(on_presentation_size), self);
  g_signal_connect_swapped(session, "run-changed", G_CALLBACK(on_change), self);
  g_signal_connect_swapped(session, "params-changed", G_CALLBACK(on_change), self);
  g_signal_connect_swapped(session, "frames-changed", G_CALLBACK(on_change), self);
  g_signal_connect_swapped(session, "playhead-changed", G_CALLBACK(on_change), self);
  gtk_widget_show_all(self->window);
  gtk_window_fullscreen(window);
  on_change(self);
}
