#include "ui/params/param_sketch.h"

#include "app/draw/canvas.h"
#include "app/section/valve.h"
#include "ui/views/style.h"

#include <math.h>
#include <string.h>

enum { SKETCH_WIDTH = 400, HEIGHT = 170, MARGIN = 8 };

// A dimension: between two places along the axis at a radius, between two radii, or a diameter,
// whose line begins on the axis.
typedef enum { AXIAL, RADIAL, DIAMETER } Way;

typedef struct {
  Way way;
  double from, to, at; // x, x, y along the axis; y, y, x across it [m]
} Mark;

typedef struct {
  SbValveOutline valve;
  double diameter[SB_SEAL_COUNT]; // of the rings' sections, free
  bool round[SB_SEAL_COUNT];      // others are not drawn
  const char *symbol;
  Mark mark;
} Sketch;

// Returns the size that a parameter is, or whose tolerance it is. For a size of one seal: that of
// both seals.
static SbParamId size_of(SbParamId id) {
  const int toleranced = sb_param_toleranced(id);
  const SbParamId size = toleranced >= 0 ? (SbParamId)toleranced : id;
  return sb_param(size)->parent >= 0 ? (SbParamId)sb_param(size)->parent : size;
}

// The dimension line of a size.
typedef struct {
  SbParamId size;
  Mark mark;
} Dimension;

// Finds the dimension of a size among all[count]; FALSE: there is none, or it is 0.
static gboolean find(Mark *mark, SbParamId size, const Dimension *all, size_t count) {
  for (size_t i = 0; i < count; i++) {
    if (all[i].size == size && fabs(all[i].mark.to - all[i].mark.from) > 0) {
      *mark = all[i].mark;
      return TRUE;
    }
  }
  return FALSE;
}

// Finds the dimension of a size of a gasket valve; FALSE: there is none.
static gboolean find_gasket_mark(Mark *mark, const SbValveOutline *v, const SbModel *model,
                                 SbParamId size) {
  const double bore = 0.5 * sb_model_value(model, SB_P_GASKET_BORE_DIAMETER);
  const double outer = 0.5 * sb_model_value(model, SB_P_GASKET_OUTER_DIAMETER);
  const double left = v->groove_left[SB_OUTER], right = v->groove_right[SB_OUTER];
  const double middle = v->origin[SB_OUTER], stroke = sb_model_value(model, SB_P_DRIVE_STROKE);
  const double port = 0.5 * (v->port_left + v->port_right);
  const double neck = v->shoulder - sb_model_value(model, SB_P_STEM_CHAMBER_LENGTH);
  const Dimension all[] = {
      {SB_P_GASKET_BORE_DIAMETER, {DIAMETER, 0, bore, middle}},
      {SB_P_GASKET_OUTER_DIAMETER, {DIAMETER, 0, outer, middle}},
      {SB_P_GASKET_THICKNESS, {AXIAL, left, right, 0.5 * (v->bore + v->rim)}},
      {SB_P_GASKET_CRIMP, {AXIAL, left, right, 0.5 * (v->bore + v->rim)}},
      {SB_P_BORE_DIAMETER, {DIAMETER, 0, v->chamber_roof, v->chamber}},
      {SB_P_BORE_LAND_EDGE, {AXIAL, v->groove_right[SB_INNER], v->shoulder, v->bore}},
      {SB_P_STEM_PRESSURE_DIAMETER, {DIAMETER, 0, v->bore, v->chamber}},
      {SB_P_STEM_SEAL_SPACING, {AXIAL, v->origin[SB_INNER], middle, 0.5 * (v->bore + v->rim)}},
      {SB_P_STEM_CHAMBER_DEPTH,
       {RADIAL, v->bore - sb_model_value(model, SB_P_STEM_CHAMBER_DEPTH), v->bore,
        0.5 * (neck + v->shoulder)}},
      {SB_P_STEM_CHAMBER_LENGTH, {AXIAL, neck, v->shoulder, v->bore}},
      {SB_P_STEM_PORT_TRAVEL, {AXIAL, left, port, 0.8 * v->bore}},
      {SB_P_STEM_PORT_DIAMETER, {AXIAL, v->port_left, v->port_right, 0.8 * v->bore}},
      {SB_P_DRIVE_STROKE, {AXIAL, v->nose - stroke, v->nose, 0.4 * v->bore}},
  };
  return find(mark, size, all, G_N_ELEMENTS(all));
}

// Where the dimension lies; false: the parameter is no such size.
static gboolean find_mark(Mark *mark, const SbValveOutline *v, const SbModel *model,
                          double contact_left, SbParamId id) {
  const SbParamId size = size_of(id);
  const int seal = sb_param(id)->seal == SB_INNER ? SB_INNER : SB_OUTER;
  const double ring = sb_model_seal(model, seal)->section_diameter;
  const double left = v->groove_left[SB_OUTER], right = v->groove_right[SB_OUTER];
  const double vent = 0.5 * (v->vent_left + v->vent_right), high = v->bore + 0.25 * ring;
  const double stroke = sb_model_value(model, SB_P_DRIVE_STROKE);
  const double shoulder = sb_model_value(model, SB_P_STEM_SHOULDER_LENGTH);
  const double chamber_right = 2 * v->chamber - v->chamber_left;
  if (v->gasket) {
    return find_gasket_mark(mark, v, model, size);
  }
  const Dimension all[] = {
      {SB_P_SEAL_SECTION_DIAMETER, {RADIAL, v->floor, v->floor + ring, v->origin[seal]}},
      {SB_P_SEAL_INNER_DIAMETER,
       {DIAMETER, 0, 0.5 * sb_model_seal(model, seal)->inner_diameter, v->origin[seal]}},
      {SB_P_GLAND_RADIAL_SPACE, {RADIAL, v->floor, v->bore, left + 0.12 * (right - left)}},
      {SB_P_GLAND_AXIAL_WIDTH, {AXIAL, left, right, v->floor + 0.25 * (v->land - v->floor)}},
      {SB_P_BORE_DIAMETER, {DIAMETER, 0, v->bore, right + 0.35 * ring}},
      {SB_P_BORE_LAND_EDGE, {AXIAL, 0, v->origin[SB_INNER] + contact_left, high}},
      {SB_P_BORE_ENTRY_DIAMETER, {DIAMETER, 0, v->mouth, 0.5 * v->face}},
      {SB_P_BORE_ENTRY_LENGTH, {AXIAL, v->face, 0, v->mouth + 0.25 * ring}},
      {SB_P_BORE_LAND_LENGTH, {AXIAL, 0, v->end, high}},
      {SB_P_BORE_VENT_POSITION, {AXIAL, 0, vent, high}},
      {SB_P_BORE_VENT_DIAMETER, {AXIAL, v->vent_left, v->vent_right, high}},
      {SB_P_STEM_PRESSURE_DIAMETER, {DIAMETER, 0, v->land, left - 0.2 * ring}},
      {SB_P_STEM_SEAL_SPACING,
       {AXIAL, 0.5 * (v->groove_left[SB_INNER] + v->groove_right[SB_INNER]), 0.5 * (left + right),
        0.6 * v->floor}},
      {SB_P_STEM_NOSE_LENGTH, {AXIAL, v->nose, v->groove_left[SB_INNER], 0.6 * v->floor}},
      {SB_P_STEM_CHAMBER_DEPTH, {RADIAL, v->chamber_floor, v->land, v->chamber}},
      {SB_P_STEM_CHAMBER_LENGTH, {AXIAL, v->chamber_left, chamber_right, v->land}},
      {SB_P_STEM_SHOULDER_LENGTH, {AXIAL, right, right + shoulder, 0.6 * v->floor}},
      {SB_P_STEM_ROD_DIAMETER, {DIAMETER, 0, v->rod, v->end - 0.3 * ring}},
      {SB_P_DRIVE_STROKE, {AXIAL, v->nose - stroke, v->nose, 0.4 * v->land}},
  };
  return find(mark, size, all, G_N_ELEMENTS(all));
}

// A symbol with its index set lower: "D_p".
static void draw_symbol(SbCanvas *c, const char *symbol, double x, double y, SbAlign align) {
  const SbTextStyle style = sb_canvas_style(c, SB_TYPE_PANEL, 700, SB_ROLE_NOW);
  const SbTextStyle index_style = sb_canvas_style(c, SB_TYPE_LABEL, 700, SB_ROLE_NOW);
  g_auto(GStrv) part = g_strsplit(symbol, "_", 2);
  const double base = sb_canvas_text_width(c, part[0], &style);
  const double index = part[1] != NULL ? sb_canvas_text_width(c, part[1], &index_style) : 0;
  x -= align == SB_MIDDLE ? 0.5 * (base + index) : 0;
  sb_canvas_text_halo(c, part[0], &style, x, y, SB_LEFT);
  if (part[1] != NULL) {
    sb_canvas_text_halo(c, part[1], &index_style, x + base, y + 4, SB_LEFT);
  }
}

static void draw_mark(SbCanvas *c, const Mark *mark, const char *symbol, double x0, double y0,
                      double scale) {
  const gboolean axial = mark->way == AXIAL;
  const SbPoint a = axial ? (SbPoint){x0 + mark->from * scale, y0 - mark->at * scale}
                          : (SbPoint){x0 + mark->at * scale, y0 - mark->from * scale};
  const SbPoint b = axial ? (SbPoint){x0 + mark->to * scale, y0 - mark->at * scale}
                          : (SbPoint){x0 + mark->at * scale, y0 - mark->to * scale};
  const double length = hypot(b.x - a.x, b.y - a.y);
  const double dx = (b.x - a.x) / length, dy = (b.y - a.y) / length;
  sb_canvas_color(c, sb_canvas_role(c, SB_ROLE_NOW), 1);
  sb_canvas_pen(c, 1.6, NULL);
  // A short one has its arrows outside.
  const gboolean outside = length < 30;
  const double over = outside ? 12 : 0;
  cairo_move_to(c->cr, a.x - (mark->way != DIAMETER ? over * dx : 0),
                a.y - (mark->way != DIAMETER ? over * dy : 0));
  cairo_line_to(c->cr, b.x + over * dx, b.y + over * dy);
  cairo_stroke(c->cr);
  sb_canvas_pen(c, 1, NULL);
  for (int i = mark->way == DIAMETER; i < 2; i++) {
    const SbPoint end = i == 0 ? a : b;
    cairo_move_to(c->cr, end.x - 7 * dy, end.y + 7 * dx);
    cairo_line_to(c->cr, end.x + 7 * dy, end.y - 7 * dx);
    cairo_stroke(c->cr);
    const double sign = (i == 0) == outside ? 1 : -1;
    sb_canvas_arrowhead(c, end.x, end.y, sign * dx, sign * dy, 0.8);
  }
  const SbPoint middle = {0.5 * (a.x + b.x), 0.5 * (a.y + b.y)};
  if (axial) {
    draw_symbol(c, symbol, middle.x, middle.y - 9, SB_MIDDLE);
  } else {
    draw_symbol(c, symbol, middle.x + 8, middle.y + 5, SB_LEFT);
  }
}

static gboolean draw(GtkWidget *widget, cairo_t *cr, const Sketch *sketch) {
  const SbValveOutline *v = &sketch->valve;
  const Mark *mark = &sketch->mark;
  // The rod goes on beyond the housing, as far as the picture.
  double left = fmin(v->face, v->nose), right = v->end + 0.2 * v->bore;
  if (mark->way == AXIAL) {
    left = fmin(left, fmin(mark->from, mark->to));
    right = fmax(right, fmax(mark->from, mark->to));
  }
  const double top = 1.45 * v->bore;
  const double width = gtk_widget_get_allocated_width(widget) - 2 * MARGIN;
  const double height = gtk_widget_get_allocated_height(widget) - 2 * MARGIN;
  const double scale = fmin(width / (right - left), height / top);
  const double x0 = MARGIN + 0.5 * (width - scale * (right - left)) - left * scale;
  const double y0 = MARGIN + height;

  SbCanvas canvas, *c = &canvas;
  sb_canvas_init(c, cr, sb_theme(sb_style_is_dark()));
  cairo_rectangle(cr, x0 + left * scale - 2, 0, (right - left) * scale + 4, HEIGHT);
  cairo_clip(cr);
  for (size_t i = 0; i < v->solid_count; i++) {
    const SbValveSolid *solid = &v->solid[i];
    cairo_new_path(cr);
    for (size_t k = 0; k < solid->count; k++) {
      cairo_line_to(cr, x0 + solid->point[k].x * scale, y0 - solid->point[k].y * scale);
    }
    cairo_close_path(cr);
    sb_canvas_color(c, sb_canvas_role(c, solid->moves ? SB_ROLE_STEM : SB_ROLE_HOUSING), 1);
    cairo_fill_preserve(cr);
    sb_canvas_pen(c, 1, NULL);
    sb_canvas_color(c, sb_canvas_role(c, SB_ROLE_OUTLINE), 1);
    cairo_stroke(cr);
  }
  for (int i = 0; i < SB_SEAL_COUNT; i++) { // as they are before they are fitted
    const double r = 0.5 * sketch->diameter[i];
    if (!sketch->round[i]) {
      continue;
    }
    cairo_new_path(cr);
    cairo_arc(cr, x0 + v->origin[i] * scale, y0 - (v->floor + r) * scale, r * scale, 0, 2 * G_PI);
    const SbColor color = sb_canvas_role(c, i == SB_INNER ? SB_ROLE_INNER : SB_ROLE_OUTER);
    sb_canvas_color(c, color, 0.25);
    cairo_fill_preserve(cr);
    sb_canvas_color(c, color, 1);
    cairo_stroke(cr);
  }
  sb_canvas_curve(c, (SbStroke){SB_ROLE_SECOND, 1, &sb_dash_dimension},
                  (const SbPoint[]){{x0 + left * scale, y0 + 0.5}, {x0 + right * scale, y0 + 0.5}},
                  2);
  draw_mark(c, mark, sketch->symbol, x0, y0, scale);
  sb_canvas_finish(c);
  return GDK_EVENT_PROPAGATE;
}

GtkWidget *sb_param_sketch_new(const SbModel *model, SbParamId id) {
  Sketch *sketch = g_new0(Sketch, 1);
  for (int i = 0; i < SB_SEAL_COUNT; i++) {
    sketch->diameter[i] = sb_model_seal(model, i)->section_diameter;
    sketch->round[i] = sb_model_profile(model, i).kind == SB_SEAL_PROFILE_CIRCLE;
  }
  // A fitted ring's contact is about half as wide as its section.
  const double contact_left = -0.25 * sketch->diameter[SB_INNER];
  const double top = 0.65 * sb_model_value(model, SB_P_BORE_DIAMETER);
  sb_valve_outline_make(&sketch->valve, model, contact_left, top, TRUE);
  if (!find_mark(&sketch->mark, &sketch->valve, model, contact_left, id)) {
    g_free(sketch);
    return NULL;
  }
  sketch->symbol = sb_param(id)->symbol;
  GtkWidget *area = gtk_drawing_area_new();
  gtk_widget_set_size_request(area, SKETCH_WIDTH, HEIGHT);
  g_object_set_data_full(G_OBJECT(area), "sketch", sketch, g_free);
  g_signal_connect(area, "draw", G_CALLBACK(draw), sketch);
  return area;
}
