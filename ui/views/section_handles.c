// See section_handles.h. A handle lies on an edge that its size moves; the edge follows the hand. A
// drag is one undo step: every motion edits the value in the session, which predicts the loop and
// solves as for any edit. Where the values are inconsistent the size stays at the last good one:
// the limit is felt, and told.
#include "ui/views/section_handles.h"

#include "app/base/translation.h"
#include "app/base/unit.h"
#include "app/draw/canvas.h"
#include "ui/views/style.h"

#include <glib/gi18n.h>
#include <math.h>

#define REACH  9.0 // of a handle [px]
#define RADIUS 5.5 //
#define FINE   0.1 // of the hand's way, with Shift

typedef struct {
  SbParamId id;
  SbPoint at;    // [px]
  double dx, dy; // the way in which it grows
  double gain;   // metres for a pixel along it
} Handle;

enum {
  HANDLES_MAX = 8,
  NONE = -1,
  STEP_POWER = -2, // of ten, of a drag and a key [mm]
  FINE_POWER = -3
};

struct SbSectionHandles {
  SbSession *session;
  GtkWidget *layer;
  SbSectionChosen chosen;
  void *chosen_data;
  Handle handle[HANDLES_MAX];
  int count, over, held, picked; // under the pointer, dragged, chosen for keys; NONE
  gboolean inside;               // the pointer is over the picture
  // The drag.
  SbPoint press, last;
  double start, value, travel; // size at the press and now [m]; of the hand [m]
  double gain;                 // at the press: the picture may change its scale under the hand
  gboolean moved, limit;
  SbPoint old[SB_SEAL_COUNT][SB_RING_POINTS]; // rings as they were, in the housing's frame [m]
  size_t old_count[SB_SEAL_COUNT];
  // Of the picture.
  double scale, x0, y0; // px per m; of the housing frame's origin
  SbPoint centre[SB_SEAL_COUNT];
  double floor_y[SB_SEAL_COUNT];
};

static double value_of(const SbSectionHandles *handles, SbParamId id) {
  return sb_document_value(sb_session_document(handles->session), id);
}

// The seal's own size where the document gives one, else that of both.
static SbParamId of_seal(const SbSectionHandles *handles, SbParamId both, const char *own) {
  const SbParams params = sb_document_params(sb_session_document(handles->session));
  const int id = sb_param_find(own);
  return id >= 0 && params.given[id] ? (SbParamId)id : both;
}

static void add(SbSectionHandles *handles, SbParamId id, SbPoint at, double dx, double dy,
                double share) {
  if (handles->count < HANDLES_MAX && handles->scale > 0) {
    handles->handle[handles->count++] = (Handle){id, at, dx, dy, share / handles->scale};
  }
}

// Those of a gasket valve: its stem, chamber and gaskets, the shoulder and the port.
static void add_gasket(SbSectionHandles *handles, const SbValveOutline *valve, double s) {
  const struct {
    SbParamId id;
    double x, y;   // in the housing's frame
    double dx, dy; // the way that the size grows
    double share;
  } all[] = {
      {SB_P_STEM_PRESSURE_DIAMETER, 0.35 * valve->chamber, valve->bore, 0, -1, 2},
      {SB_P_BORE_DIAMETER, valve->chamber, valve->chamber_roof, 0, -1, 2},
      {SB_P_GASKET_OUTER_DIAMETER, valve->origin[SB_OUTER], valve->rim, 0, -1, 2},
      {SB_P_STEM_SEAL_SPACING, valve->groove_right[SB_OUTER], (valve->bore + valve->rim) / 2, 1, 0,
       1},
      {SB_P_BORE_LAND_EDGE, valve->shoulder - s, valve->bore, 1, 0, 1},
      {SB_P_STEM_PORT_TRAVEL, valve->port_left - s, 0.8 * valve->bore, 1, 0, 1},
  };
  for (size_t i = 0; i < G_N_ELEMENTS(all); i++) {
    const SbPoint at = {handles->x0 + all[i].x * handles->scale,
                        handles->y0 - all[i].y * handles->scale};
    add(handles, all[i].id, at, all[i].dx, all[i].dy, all[i].share);
  }
}

void sb_section_handles_follow(SbSectionHandles *handles, const SbSection *section,
                               const SbModel *model, const SbFrame *frame, SbPoint corner) {
  static const char *const own[SB_SEAL_COUNT] = {
      [SB_OUTER] = "seal.outer.section_diameter", [SB_INNER] = "seal.inner.section_diameter"};
  gtk_widget_queue_draw(handles->layer);
  handles->count = 0;
  if (section == NULL) {
    return;
  }
  double x0, y0;
  const SbValveOutline *valve = sb_section_valve(section);
  sb_section_transform(section, &handles->scale, &x0, &y0);
  const double scale = handles->scale, s = frame->displacement;
  x0 += corner.x;
  y0 += corner.y;
  handles->x0 = x0;
  handles->y0 = y0;
  for (int i = 0; i < SB_SEAL_COUNT; i++) {
    // In the seal's frame, from the groove's floor.
    const SbRingShape *ring = sb_section_ring(section, i);
    const double origin = valve->origin[i] - (valve->gasket ? 0 : s);
    double left = INFINITY, mean = 0;
    for (size_t k = 0; k < ring->count; k++) {
      left = fmin(left, ring->x[k]);
      mean += ring->y[k] / (double)ring->count;
      if (handles->held == NONE) {
        handles->old[i][k] =
            (SbPoint){x0 + (origin + ring->x[k]) * scale, y0 - (valve->floor + ring->y[k]) * scale};
      }
    }
    if (handles->held == NONE) {
      handles->old_count[i] = ring->count;
    }
    const double height = y0 - (valve->floor + mean) * scale;
    handles->floor_y[i] = y0 - valve->floor * scale;
    handles->centre[i] = (SbPoint){x0 + origin * scale, height};
    if (ring->count > 0 && !valve->gasket) {
      // Its centre stays: an edge moves by half of what the size grows by.
      add(handles, of_seal(handles, SB_P_SEAL_SECTION_DIAMETER, own[i]),
          (SbPoint){x0 + (origin + left) * scale, height}, -1, 0, 2);
    }
  }
  if (valve->gasket) {
    add_gasket(handles, valve, s);
    handles->over = handles->over < handles->count ? handles->over : NONE;
    handles->picked = handles->picked < handles->count ? handles->picked : NONE;
    return;
  }
  const double middle = valve->origin[SB_OUTER] - s, wall = valve->groove_right[SB_OUTER] - s;
  add(handles, SB_P_GLAND_RADIAL_SPACE, (SbPoint){x0 + middle * scale, y0 - valve->floor * scale},
      0, 1, 1);
  add(handles, SB_P_GLAND_AXIAL_WIDTH,
      (SbPoint){x0 + wall * scale, y0 - 0.5 * (valve->floor + valve->land) * scale}, 1, 0, 2);
  add(handles, SB_P_BORE_DIAMETER,
      (SbPoint){x0 + (wall + 0.25 * sb_model_value(model, SB_P_BORE_DIAMETER)) * scale,
                y0 - valve->bore * scale},
      0, -1, 2);
  handles->over = handles->over < handles->count ? handles->over : NONE;
  handles->picked = handles->picked < handles->count ? handles->picked : NONE;
}

// Drawing ----------------------------------------------------------------------------------------

static SbColor accent(void) {
  return sb_color_hex(sb_style_is_dark() ? 0x7FB2E5 : 0x2A6DB0);
}

// The size that is dragged, from what to what.
static void draw_bubble(const SbSectionHandles *handles, SbCanvas *c, const Handle *handle) {
  const SbTextStyle style = sb_canvas_style(c, SB_TYPE_LABEL, 600, SB_ROLE_PANEL);
  g_autofree char *from = sb_param_format(handle->id, handles->start);
  g_autofree char *to = sb_param_format(handle->id, value_of(handles, handle->id));
  g_autofree char *label = sb_translation_inside(sb_param(handle->id)->label);
  const SbEditLatency latency = sb_session_latency(handles->session);
  g_autoptr(GString) text = g_string_new(NULL);
  if (handles->held == NONE) {
    g_string_printf(text, "%s %s", label, to);
  } else {
    g_string_printf(text, "%s %s → %s", label, from, to);
    if (handles->limit) {
      g_string_append(text, _(", no further"));
    } else if (isfinite(latency.predicted) && isnan(latency.shown)) {
      g_string_append_printf(text, _(", %.1f ms predicted, solving…"), 1e3 * latency.predicted);
    }
  }
  const double width = sb_canvas_text_width(c, text->str, &style) + 20;
  const double room = gtk_widget_get_allocated_width(handles->layer);
  SbRect box = {fmin(fmax(handle->at.x - width / 2, 4), fmax(room - width - 4, 4)),
                handle->at.y - 44, width, 26};
  box.y = box.y < 4 ? handle->at.y + 18 : box.y;
  sb_canvas_rounded(c, box, 5);
  sb_canvas_color(c, handles->limit ? sb_canvas_role(c, SB_ROLE_ERROR) : accent(), 1);
  cairo_fill(c->cr);
  sb_canvas_text(c, text->str, &style, box.x + 10, box.y + 17, SB_LEFT);
}

// A ring before it is fitted, on the groove's floor.
static void draw_free_ring(const SbSectionHandles *handles, SbCanvas *c, int seal, double diameter,
                           double lower) {
  const double r = 0.5 * diameter * handles->scale;
  cairo_new_path(c->cr);
  cairo_arc(c->cr, handles->centre[seal].x, handles->floor_y[seal] + lower * handles->scale - r, r,
            0, 2 * G_PI);
  cairo_stroke(c->cr);
}

static double section_of(const SbModel *model, int seal) {
  return sb_model_seal(model, seal)->section_diameter;
}

// Free rings of the designs that are drawn to compare with.
static void draw_pins(const SbSectionHandles *handles, SbCanvas *c) {
  const SbChartData *data = sb_session_chart(handles->session);
  for (size_t i = 0; i < data->pin_count && data->run.model != NULL; i++) {
    const SbChartPin *pin = &data->pin[i];
    const SbModel *model = pin->run->model;
    const double lower = sb_model_value(model, SB_P_GLAND_RADIAL_SPACE) -
                         sb_model_value(data->run.model, SB_P_GLAND_RADIAL_SPACE);
    sb_canvas_stroke(c, sb_chart_pin_stroke(pin->look));
    for (int seal = 0; seal < SB_SEAL_COUNT; seal++) {
      draw_free_ring(handles, c, seal, section_of(model, seal), lower);
    }
  }
}

static gboolean draw_handles(GtkWidget *widget, cairo_t *cr, SbSectionHandles *handles) {
  if (handles->count == 0) {
    return GDK_EVENT_PROPAGATE;
  }
  SbCanvas canvas, *c = &canvas;
  sb_canvas_init(c, cr, sb_theme(sb_style_is_dark()));
  draw_pins(handles, c);
  const int shown = handles->held != NONE   ? handles->held
                    : handles->over != NONE ? handles->over
                                            : handles->picked;
  if (handles->held != NONE && handles->moved) {
    // What was, dashed; what it becomes, before it is solved.
    sb_canvas_pen(c, 1.2, &sb_dash_dimension);
    sb_canvas_color(c, sb_canvas_role(c, SB_ROLE_SECOND), 1);
    for (int i = 0; i < SB_SEAL_COUNT; i++) {
      SbPoint p[SB_RING_POINTS];
      for (size_t k = 0; k < handles->old_count[i]; k++) {
        p[k] = (SbPoint){handles->x0 + handles->old[i][k].x * handles->scale,
                         handles->y0 - handles->old[i][k].y * handles->scale};
      }
      sb_canvas_polyline(c, p, handles->old_count[i]);
    }
    const SbModel *model = sb_session_model(handles->session);
    const SbModel *drawn = sb_session_chart(handles->session)->run.model;
    if (model != NULL && drawn != NULL) {
      const double lower = sb_model_value(model, SB_P_GLAND_RADIAL_SPACE) -
                           sb_model_value(drawn, SB_P_GLAND_RADIAL_SPACE);
      sb_canvas_pen(c, 1.6, NULL);
      sb_canvas_color(c, accent(), 1);
      for (int i = 0; i < SB_SEAL_COUNT; i++) {
        draw_free_ring(handles, c, i, section_of(model, i), lower);
      }
    }
  }
  for (int i = 0; i < handles->count && (handles->inside || shown != NONE); i++) {
    // On whole pixels, so that each looks the same.
    const SbPoint at = {round(handles->handle[i].at.x), round(handles->handle[i].at.y)};
    sb_canvas_dot(c, at.x, at.y, RADIUS, accent());
    if (i != shown) {
      sb_canvas_dot(c, at.x, at.y, RADIUS - 1.6, sb_canvas_role(c, SB_ROLE_PANEL));
    }
  }
  if (shown != NONE) {
    draw_bubble(handles, c, &handles->handle[shown]);
  }
  sb_canvas_finish(c);
  return GDK_EVENT_PROPAGATE;
}

// Editing ----------------------------------------------------------------------------------------

// `value` and `count` steps on, as the number that is typed for it would be read.
static double step_from(double value, gboolean fine, double count) {
  return sb_quantity_step(value, "m", "mm", fine ? FINE_POWER : STEP_POWER, count);
}

static gboolean goes(const SbModel *model, SbParamId id, double value) {
  SbModel *trial = NULL;
  const gboolean good = sb_model_derive(&trial, model, &(SbOverride){id, value}, 1, NULL) == SB_OK;
  sb_model_destroy(trial);
  return good;
}

// The step next to `wanted` at which the valve can still be; that of the value now where none is.
static double last_good(const SbModel *model, SbParamId id, double now, double wanted,
                        gboolean fine) {
  const double step = 1e-3 * pow(10, fine ? FINE_POWER : STEP_POWER);
  double good = 0, bad = round((wanted - now) / step);
  while (fabs(bad - good) > 1) {
    const double middle = trunc(0.5 * (good + bad));
    *(goes(model, id, step_from(now, fine, middle)) ? &good : &bad) = middle;
  }
  return good == 0 ? now : step_from(now, fine, good);
}

// Puts the size to `value`, or as far towards it as the valve can be: a fast hand leaves out steps.
static void put(SbSectionHandles *handles, SbParamId id, double value, gboolean fine) {
  SbSession *session = handles->session;
  const SbParam *param = sb_param(id);
  const SbModel *model = sb_session_model(session);
  double wanted = fmin(fmax(value, param->min), param->max);
  handles->limit = wanted != value;
  if (model != NULL && wanted != handles->value && !goes(model, id, wanted)) {
    wanted = last_good(model, id, handles->value, wanted, fine);
    handles->limit = TRUE;
  }
  if (wanted == handles->value) {
    return;
  }
  sb_session_edit_value(session, id, wanted);
  if (model != NULL && sb_session_model(session) == NULL) { // a part's shape forbids it
    sb_session_edit_value(session, id, handles->value);
    handles->limit = TRUE;
    return;
  }
  handles->value = wanted;
  handles->moved = TRUE;
}

gboolean sb_section_handles_press(SbSectionHandles *handles, double x, double y) {
  double best = REACH;
  int found = NONE;
  for (int i = 0; i < handles->count; i++) {
    const double far = hypot(x - handles->handle[i].at.x, y - handles->handle[i].at.y);
    if (far <= best) {
      best = far;
      found = i;
    }
  }
  handles->picked = handles->held = found;
  gtk_widget_queue_draw(handles->layer);
  if (found == NONE) {
    return FALSE;
  }
  const SbParamId id = handles->handle[found].id;
  handles->press = handles->last = (SbPoint){x, y};
  handles->start = handles->value = value_of(handles, id);
  handles->travel = 0;
  handles->gain = handles->handle[found].gain;
  handles->moved = handles->limit = FALSE;
  sb_session_end_merge(handles->session); // a drag is a step of its own
  sb_session_prepare(handles->session, id);
  return TRUE;
}

gboolean sb_section_handles_motion(SbSectionHandles *handles, double x, double y, guint state) {
  handles->inside = TRUE;
  gtk_widget_queue_draw(handles->layer);
  if (handles->held == NONE) {
    handles->over = NONE;
    for (int i = 0; i < handles->count; i++) {
      if (hypot(x - handles->handle[i].at.x, y - handles->handle[i].at.y) <= REACH) {
        handles->over = i;
      }
    }
    return FALSE;
  }
  const Handle *handle = &handles->handle[handles->held];
  const gboolean fine = (state & GDK_SHIFT_MASK) != 0;
  const double along = (x - handles->last.x) * handle->dx + (y - handles->last.y) * handle->dy;
  handles->travel += along * handles->gain * (fine ? FINE : 1);
  handles->last = (SbPoint){x, y};
  // A press that trembles is none.
  if (handles->moved || hypot(x - handles->press.x, y - handles->press.y) > 2) {
    put(handles, handle->id, step_from(handles->start + handles->travel, fine, 0), fine);
  }
  return TRUE;
}

gboolean sb_section_handles_release(SbSectionHandles *handles) {
  if (handles->held == NONE) {
    return FALSE;
  }
  const SbParamId id = handles->handle[handles->held].id;
  handles->held = NONE;
  handles->limit = FALSE;
  sb_session_end_merge(handles->session);
  if (handles->chosen != NULL) {
    handles->chosen(handles->chosen_data, id, NULL);
  }
  gtk_widget_queue_draw(handles->layer);
  return TRUE;
}

void sb_section_handles_enter(SbSectionHandles *handles) {
  handles->inside = TRUE;
  gtk_widget_queue_draw(handles->layer);
}

void sb_section_handles_leave(SbSectionHandles *handles) {
  handles->inside = FALSE;
  handles->over = NONE;
  gtk_widget_queue_draw(handles->layer);
}

gboolean sb_section_handles_key(SbSectionHandles *handles, const GdkEventKey *event) {
  if (handles->picked == NONE || handles->picked >= handles->count) {
    return FALSE;
  }
  const SbParamId id = handles->handle[handles->picked].id;
  const gboolean fine = (event->state & GDK_SHIFT_MASK) != 0;
  const guint32 letter = gdk_keyval_to_unicode(event->keyval);
  switch (event->keyval) {
  case GDK_KEY_Escape:
    if (handles->held != NONE && handles->moved) {
      sb_session_end_merge(handles->session);
      sb_session_undo(handles->session);
    }
    handles->held = handles->picked = NONE;
    gtk_widget_queue_draw(handles->layer);
    return TRUE;
  case GDK_KEY_Up:
  case GDK_KEY_Right:
  case GDK_KEY_Down:
  case GDK_KEY_Left: {
    const int sign = event->keyval == GDK_KEY_Up || event->keyval == GDK_KEY_Right ? 1 : -1;
    handles->value = value_of(handles, id);
    put(handles, id, step_from(handles->value, fine, sign), fine);
    gtk_widget_queue_draw(handles->layer);
    return TRUE;
  }
  default:
    if (handles->held == NONE && handles->chosen != NULL && g_unichar_isdigit(letter)) {
      char text[8] = "";
      g_unichar_to_utf8(letter, text);
      handles->picked = NONE;
      handles->chosen(handles->chosen_data, id, text);
      return TRUE;
    }
    return FALSE;
  }
}

SbSectionHandles *sb_section_handles_new(SbSession *session, GtkOverlay *overlay) {
  SbSectionHandles *handles = g_new0(SbSectionHandles, 1);
  handles->session = session;
  handles->over = handles->held = handles->picked = NONE;
  handles->layer = gtk_drawing_area_new();
  gtk_widget_set_has_window(handles->layer, FALSE); // the pointer is the picture's
  g_object_set_data_full(G_OBJECT(handles->layer), "handles", handles, g_free);
  g_signal_connect(handles->layer, "draw", G_CALLBACK(draw_handles), handles);
  gtk_overlay_add_overlay(overlay, handles->layer);
  gtk_overlay_set_overlay_pass_through(overlay, handles->layer, TRUE);
  return handles;
}

void sb_section_handles_listen(SbSectionHandles *handles, SbSectionChosen chosen, void *data) {
  handles->chosen = chosen;
  handles->chosen_data = data;
}
