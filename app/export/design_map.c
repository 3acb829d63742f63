// The map of a design question. See design_map.h.
#include "app/export/design_map.h"

#include "app/base/figure_text.h"
#include "app/base/translation.h"
#include "app/base/unit.h"
#include "app/draw/axis.h"
#include "app/draw/label.h"

#include <glib/gi18n.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

char *sb_design_value_text(int figure, double value) {
  char text[SB_FORMAT_MAX];
  return g_strdup(sb_figure_text(text, figure, value, NAN));
}

// Values between points ---------------------------------------------------------------------------

static double value_at(const SbDesignMap *map, size_t figure, size_t across, size_t up) {
  return map->value[(up * map->n + across) * map->figures + figure];
}

static bool is_there(const SbDesignMap *map, size_t across, size_t up) {
  return map->status[up * map->n + across] != SB_ANSWER_MISSING;
}

// Drawing -----------------------------------------------------------------------------------------

typedef struct {
  SbCanvas *c;
  const SbDesignAnswer *answer;
  const SbDesignMap *map;
  SbAxes at; // in display units
  SbLabels labels;
} View;

static double shown(SbParamId id, double value) {
  return sb_quantity_to_shown(value, sb_param(id)->si, sb_param(id)->unit);
}

static SbPoint place_of(const View *v, double across, double up) {
  return sb_axes_at(&v->at, shown(v->map->axis[0], across), shown(v->map->axis[1], up));
}

static SbPoint point_of(const View *v, size_t across, size_t up) {
  const double last = (double)(v->map->n - 1);
  return (SbPoint){v->at.plot.x + v->at.plot.width * (double)across / last,
                   v->at.plot.y + v->at.plot.height * (1 - (double)up / last)};
}

// A triangle of the map with a figure at its corners.
typedef struct {
  SbPoint at[3];
  double value[3];
} Triangle;

typedef void (*TriangleDo)(void *data, const Triangle *triangle);

static void do_cell(const View *v, size_t figure, size_t i, size_t k, size_t step, TriangleDo call,
                    void *data) {
  const size_t corner[4][2] = {{i, k}, {i + step, k}, {i + step, k + step}, {i, k + step}};
  static const int halves[2][3] = {{0, 1, 2}, {0, 2, 3}};
  for (int half = 0; half < 2; half++) {
    Triangle of;
    bool good = true;
    for (int m = 0; m < 3; m++) {
      const size_t *at = corner[halves[half][m]];
      of.at[m] = point_of(v, at[0], at[1]);
      of.value[m] = value_at(v->map, figure, at[0], at[1]);
      good = good && isfinite(of.value[m]);
    }
    if (good) {
      call(data, &of);
    }
  }
}

// The finest cells that have their corners: a map that fills in has coarse ones at first.
static void do_cells(const View *v, size_t figure, size_t i, size_t k, size_t step, TriangleDo call,
                     void *data) {
  const size_t half = step / 2;
  bool finer = half > 0;
  for (size_t a = 0; finer && a <= 2; a++) {
    for (size_t b = 0; finer && b <= 2; b++) {
      finer = is_there(v->map, i + a * half, k + b * half);
    }
  }
  if (finer) {
    for (size_t a = 0; a < 4; a++) {
      do_cells(v, figure, i + (a % 2) * half, k + (a / 2) * half, half, call, data);
    }
  } else if (is_there(v->map, i, k) && is_there(v->map, i + step, k) &&
             is_there(v->map, i, k + step) && is_there(v->map, i + step, k + step)) {
    do_cell(v, figure, i, k, step, call, data);
  }
}

static void do_triangles(const View *v, size_t figure, TriangleDo call, void *data) {
  const size_t coarse = MIN(v->map->n - 1, 8);
  for (size_t k = 0; k + 1 < v->map->n; k += coarse) {
    for (size_t i = 0; i + 1 < v->map->n; i += coarse) {
      do_cells(v, figure, i, k, coarse, call, data);
    }
  }
}

static SbPoint between(const Triangle *of, int a, int b, double level) {
  const double t = (level - of->value[a]) / (of->value[b] - of->value[a]);
  return (SbPoint){of->at[a].x + t * (of->at[b].x - of->at[a].x),
                   of->at[a].y + t * (of->at[b].y - of->at[a].y)};
}

// ---- What is beyond a limit ----

typedef struct {
  const View *view;
  double level;
  bool above; // what is above the level is beyond
} Beyond;

static void add_beyond(void *data, const Triangle *of) {
  Beyond *beyond = data;
  SbPoint corner[4];
  int count = 0;
  for (int a = 0; a < 3; a++) {
    const int b = (a + 1) % 3;
    const bool in_a = (of->value[a] > beyond->level) == beyond->above;
    const bool in_b = (of->value[b] > beyond->level) == beyond->above;
    if (in_a) {
      corner[count++] = of->at[a];
    }
    if (in_a != in_b) {
      corner[count++] = between(of, a, b, beyond->level);
    }
  }
  if (count < 3) {
    return;
  }
  cairo_t *cr = beyond->view->c->cr;
  cairo_move_to(cr, corner[0].x, corner[0].y);
  for (int m = 1; m < count; m++) {
    cairo_line_to(cr, corner[m].x, corner[m].y);
  }
  cairo_close_path(cr);
}

// Lines at an angle of its own for each limit, so that where two cross two limits are broken.
static void hatch(const View *v, size_t number) {
  static const double angles[] = {45, -45, 0, 90, 22, -22, 67, -67};
  const double angle = angles[number % G_N_ELEMENTS(angles)] * M_PI / 180;
  const double gap = 9, reach = v->at.plot.width + v->at.plot.height;
  const SbPoint middle = {v->at.plot.x + v->at.plot.width / 2,
                          v->at.plot.y + v->at.plot.height / 2};
  cairo_t *cr = v->c->cr;
  cairo_save(cr);
  cairo_clip(cr);
  cairo_translate(cr, middle.x, middle.y);
  cairo_rotate(cr, -angle);
  sb_canvas_pen(v->c, 0.6, NULL);
  sb_canvas_color(v->c, sb_canvas_role(v->c, SB_ROLE_THIRD), 0.55);
  for (double at = -gap * floor(reach / 2 / gap); at < reach / 2; at += gap) {
    cairo_move_to(cr, -reach / 2, at);
    cairo_line_to(cr, reach / 2, at);
  }
  cairo_stroke(cr);
  cairo_restore(cr);
}

// How many of a block's points are there, and how many of these are beyond.
static size_t count_beyond(const Beyond *of, size_t figure, size_t i, size_t k, size_t step,
                           size_t *there) {
  size_t beyond = 0;
  *there = 0;
  for (size_t up = k; up <= k + step; up++) {
    for (size_t across = i; across <= i + step; across++) {
      const double value = value_at(of->view->map, figure, across, up);
      const bool good = is_there(of->view->map, across, up) && isfinite(value);
      *there += good;
      beyond += good && (value > of->level) == of->above;
    }
  }
  return beyond;
}

// As do_cells(), a whole block at once where it can: paths of few parts are filled fast.
static void do_beyond(Beyond *of, size_t figure, size_t i, size_t k, size_t step) {
  size_t there = 0;
  const size_t beyond = count_beyond(of, figure, i, k, step, &there);
  if (there == (step + 1) * (step + 1) && (beyond == 0 || beyond == there)) {
    if (beyond > 0) {
      const SbPoint a = point_of(of->view, i, k), b = point_of(of->view, i + step, k + step);
      cairo_rectangle(of->view->c->cr, a.x, a.y, b.x - a.x, b.y - a.y);
    }
  } else if (step > 1) {
    for (size_t part = 0; part < 4; part++) {
      do_beyond(of, figure, i + part % 2 * step / 2, k + part / 2 * step / 2, step / 2);
    }
  } else {
    do_cells(of->view, figure, i, k, step, add_beyond, of);
  }
}

static void draw_beyond(const View *v, size_t number, size_t figure, double level, bool above) {
  Beyond beyond = {v, level, above};
  cairo_new_path(v->c->cr);
  if (v->map->done == v->map->n * v->map->n) {
    const size_t block = MIN(v->map->n - 1, 8);
    for (size_t k = 0; k + 1 < v->map->n; k += block) {
      for (size_t i = 0; i + 1 < v->map->n; i += block) {
        do_beyond(&beyond, figure, i, k, block);
      }
    }
  } else {
    do_triangles(v, figure, add_beyond, &beyond);
  }
  sb_canvas_color(v->c, sb_canvas_role(v->c, SB_ROLE_INK), 0.045);
  cairo_fill_preserve(v->c->cr);
  hatch(v, number);
  cairo_new_path(v->c->cr);
}

// ---- Lines ----

typedef struct {
  SbPoint a, b;
} Segment;

typedef struct {
  double level;
  GArray *segments;
} Line;

static void add_segment(void *data, const Triangle *of) {
  Line *line = data;
  SbPoint end[3];
  int count = 0;
  for (int a = 0; a < 3; a++) {
    const int b = (a + 1) % 3;
    if ((of->value[a] > line->level) != (of->value[b] > line->level)) {
      end[count++] = between(of, a, b, line->level);
    }
  }
  if (count == 2) {
    const Segment segment = {end[0], end[1]};
    g_array_append_val(line->segments, segment);
  }
}

static bool meet(SbPoint a, SbPoint b) {
  return fabs(a.x - b.x) < 1e-6 && fabs(a.y - b.y) < 1e-6;
}

// Takes the segment that goes on from the last point of a chain.
static bool grow(GArray *chain, GArray *segments) {
  const SbPoint last = g_array_index(chain, SbPoint, chain->len - 1);
  for (guint i = 0; i < segments->len; i++) {
    const Segment *of = &g_array_index(segments, Segment, i);
    if (meet(of->a, last) || meet(of->b, last)) {
      const SbPoint next = meet(of->a, last) ? of->b : of->a;
      g_array_append_val(chain, next);
      g_array_remove_index_fast(segments, i);
      return true;
    }
  }
  return false;
}

static void reverse(GArray *chain) {
  for (guint i = 0; i < chain->len / 2; i++) {
    const SbPoint kept = g_array_index(chain, SbPoint, i);
    g_array_index(chain, SbPoint, i) = g_array_index(chain, SbPoint, chain->len - 1 - i);
    g_array_index(chain, SbPoint, chain->len - 1 - i) = kept;
  }
}

typedef struct {
  SbStroke stroke;
  double size; // of its text
  int weight;
} LineLook;

// A text along the line, where the line is straight and nothing else stands; its room is taken.
static void write_along(View *v, const GArray *chain, const char *text, const LineLook *look) {
  const SbTextStyle style = sb_canvas_style(v->c, look->size, look->weight, look->stroke.role);
  const double width = sb_canvas_text_width(v->c, text, &style) + 8;
  static const double shares[] = {0.5, 0.3, 0.7, 0.15, 0.85};
  double length = 0;
  for (guint i = 1; i < chain->len; i++) {
    const SbPoint a = g_array_index(chain, SbPoint, i - 1), b = g_array_index(chain, SbPoint, i);
    length += hypot(b.x - a.x, b.y - a.y);
  }
  for (guint s = 0; length > width + 20 && s < G_N_ELEMENTS(shares); s++) {
    double along = 0;
    SbPoint from = {0, 0}, to = {0, 0};
    const double start = shares[s] * (length - width);
    for (guint i = 1; i < chain->len; i++) {
      const SbPoint a = g_array_index(chain, SbPoint, i - 1), b = g_array_index(chain, SbPoint, i);
      const double part = hypot(b.x - a.x, b.y - a.y);
      for (int end = 0; end < 2; end++) {
        const double want = start + (end == 0 ? 0 : width);
        if (want >= along && want < along + part) {
          const double t = (want - along) / part;
          const SbPoint at = {a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)};
          from = end == 0 ? at : from;
          to = end == 1 ? at : to;
        }
      }
      along += part;
    }
    if (hypot(to.x - from.x, to.y - from.y) < 0.96 * width) {
      continue;
    }
    const SbPoint middle = {(from.x + to.x) / 2, (from.y + to.y) / 2};
    // Boxes along the text take its room.
    const int pieces = (int)ceil(width / 14);
    bool free = true;
    for (int m = 0; m < pieces; m++) {
      const double t = (m + 0.5) / pieces;
      const SbRect box = {from.x + t * (to.x - from.x) - 7, from.y + t * (to.y - from.y) - 7, 14,
                          14};
      free = free && !sb_labels_hits(&v->labels, box);
    }
    if (!free) {
      continue;
    }
    for (int m = 0; m < pieces; m++) {
      const double t = (m + 0.5) / pieces;
      sb_labels_block(&v->labels, (SbRect){from.x + t * (to.x - from.x) - 7,
                                           from.y + t * (to.y - from.y) - 7, 14, 14});
    }
    double angle = atan2(to.y - from.y, to.x - from.x);
    angle += angle > M_PI / 2 ? -M_PI : angle < -M_PI / 2 ? M_PI : 0;
    cairo_save(v->c->cr);
    cairo_translate(v->c->cr, middle.x, middle.y);
    cairo_rotate(v->c->cr, angle);
    sb_canvas_text_halo(v->c, text, &style, 0, look->size * 0.36, SB_MIDDLE);
    cairo_restore(v->c->cr);
    return;
  }
}

static void draw_line(View *v, size_t figure, double level, const char *text,
                      const LineLook *look) {
  g_autoptr(GArray) segments = g_array_new(FALSE, FALSE, sizeof(Segment));
  Line line = {level, segments};
  do_triangles(v, figure, add_segment, &line);
  while (segments->len > 0) {
    g_autoptr(GArray) chain = g_array_new(FALSE, FALSE, sizeof(SbPoint));
    const Segment first = g_array_index(segments, Segment, segments->len - 1);
    g_array_set_size(segments, segments->len - 1);
    g_array_append_val(chain, first.a);
    g_array_append_val(chain, first.b);
    while (grow(chain, segments)) {
    }
    reverse(chain);
    while (grow(chain, segments)) {
    }
    sb_canvas_curve(v->c, look->stroke, (const SbPoint *)(const void *)chain->data, chain->len);
    if (text != NULL) {
      write_along(v, chain, text, look);
    }
  }
}

static LineLook look_of(const View *v, size_t figure, bool border) {
  static const SbDash dashes[SB_DESIGN_LINES] = {
      {0, {0}}, {2, {6, 4}}, {2, {1.5, 3}}, {4, {8, 3, 2, 3}}};
  static const SbRole roles[SB_DESIGN_LINES] = {SB_ROLE_SECOND, SB_ROLE_TEAL, SB_ROLE_VIOLET,
                                                SB_ROLE_OCHRE};
  const size_t number = figure % SB_DESIGN_LINES;
  const SbDash *dash = border || dashes[number].count == 0 ? NULL : &dashes[number];
  const SbRole role = border && number == 0 ? SB_ROLE_INK : roles[number];
  return border ? (LineLook){{role, 2.4, NULL}, 11.5, 700} : (LineLook){{role, 1, dash}, 11, 400};
}

static void draw_levels(View *v, size_t figure) {
  const int id = g_array_index(v->answer->study->figures, int, figure);
  const SbFigure *of = sb_figure(id);
  double least = INFINITY, greatest = -INFINITY;
  for (size_t i = 0; i < v->map->n * v->map->n; i++) {
    const double value = v->map->value[i * v->map->figures + figure];
    if (isfinite(value)) {
      least = fmin(least, value);
      greatest = fmax(greatest, value);
    }
  }
  if (!(least < greatest)) {
    return;
  }
  SbTicks ticks;
  sb_axis_ticks(&ticks, sb_quantity_to_shown(least, of->si, of->shown),
                sb_quantity_to_shown(greatest, of->si, of->shown), 8);
  const LineLook look = look_of(v, figure, false);
  for (int k = 0; k < ticks.count; k++) {
    char digits[SB_FORMAT_MAX];
    sb_format_fixed(digits, ticks.value[k], ticks.decimals);
    g_autofree char *text = g_strdup_printf("%s %s", digits, of->shown);
    draw_line(v, figure, sb_quantity_from_shown(ticks.value[k], of->si, of->shown), text, &look);
  }
}

// A limit's border, named, and what lies beyond it.
static void draw_limits(View *v, bool borders) {
  const SbLimits *limits = &v->answer->study->limits;
  size_t number = 0;
  for (size_t i = 0; i < limits->count; i++) {
    const int figure = sb_design_answer_figure(v->answer, limits->item[i].figure);
    for (int upper = 0; figure >= 0 && upper < 2; upper++) {
      const double level = upper ? limits->item[i].high : limits->item[i].low;
      if (!isfinite(level)) {
        continue;
      }
      if (borders) {
        const SbFigure *of = sb_figure(limits->item[i].figure);
        g_autofree char *value = sb_quantity_round(level, of->si, of->shown, 4);
        g_autofree char *name = sb_translation_inside(of->label);
        g_autofree char *text = g_strdup_printf("%s %s", name, value);
        const LineLook look = look_of(v, (size_t)figure, true);
        draw_line(v, (size_t)figure, level, text, &look);
      } else {
        draw_beyond(v, number, (size_t)figure, level, upper);
      }
      number++;
    }
  }
}

// ---- Designs ----

static char *axis_text(const View *v, const double at[2]) {
  const SbParam *a = sb_param(v->map->axis[0]), *b = sb_param(v->map->axis[1]);
  char first[SB_NUMBER_SIZE], second[SB_NUMBER_SIZE];
  sb_number_round(first, shown(v->map->axis[0], at[0]), 4);
  sb_number_round(second, shown(v->map->axis[1], at[1]), 4);
  return strcmp(a->unit, b->unit) == 0
             ? g_strdup_printf("%s × %s %s", first, second, a->unit)
             : g_strdup_printf("%s %s × %s %s", first, a->unit, second, b->unit);
}

// Two lines beside a point, to its right or left, over whatever stands there.
static void write_beside(View *v, SbPoint at, double off, const char *name, const char *text,
                         SbColor color) {
  const SbTextStyle bold = {12, 700, color, 1};
  const SbTextStyle plain = sb_canvas_style(v->c, SB_TYPE_LABEL, 400, SB_ROLE_INK);
  const double width =
      fmax(sb_canvas_text_width(v->c, name, &bold), sb_canvas_text_width(v->c, text, &plain));
  const bool right = at.x + off + width + 8 < v->at.plot.x + v->at.plot.width;
  const double x = right ? at.x + off : at.x - off;
  const double y = fmin(fmax(at.y, v->at.plot.y + 16), v->at.plot.y + v->at.plot.height - 20);
  const SbColor ground = sb_canvas_role(v->c, SB_ROLE_PANEL);
  const SbRect box = {right ? x - 4 : x - width - 4, y - 14, width + 8, 34};
  sb_canvas_color(v->c, ground, 0.88);
  cairo_rectangle(v->c->cr, box.x, box.y, box.width, box.height);
  cairo_fill(v->c->cr);
  sb_canvas_text(v->c, name, &bold, x, y, right ? SB_LEFT : SB_RIGHT);
  sb_canvas_text(v->c, text, &plain, x, y + 15, right ? SB_LEFT : SB_RIGHT);
}

static double tolerance_of(const View *v, int axis) {
  const int band = sb_param_tolerance(v->map->axis[axis]);
  return band >= 0 ? sb_model_value(v->answer->study->base, (SbParamId)band) : 0;
}

// The tolerances' box, and one, two and three deviations.
static void draw_tolerance(View *v, const double at[2], SbColor color) {
  const double dx = tolerance_of(v, 0), dy = tolerance_of(v, 1);
  if (!(dx > 0 && dy > 0)) {
    return;
  }
  const SbPoint middle = place_of(v, at[0], at[1]), corner = place_of(v, at[0] + dx, at[1] + dy);
  const double a = fabs(corner.x - middle.x), b = fabs(corner.y - middle.y);
  static const SbDash dash = {2, {4, 3}};
  sb_canvas_color(v->c, color, 1);
  sb_canvas_pen(v->c, 1.2, &dash);
  cairo_rectangle(v->c->cr, middle.x - a, middle.y - b, 2 * a, 2 * b);
  cairo_stroke(v->c->cr);
  for (int sigma = 1; sigma <= 3; sigma++) {
    cairo_save(v->c->cr);
    cairo_translate(v->c->cr, middle.x, middle.y);
    cairo_scale(v->c->cr, a * sigma / 3, b * sigma / 3);
    cairo_arc(v->c->cr, 0, 0, 1, 0, 2 * M_PI);
    cairo_restore(v->c->cr);
    if (sigma == 3) {
      sb_canvas_color(v->c, color, 0.06);
      cairo_fill_preserve(v->c->cr);
    }
    sb_canvas_color(v->c, color, sigma == 3 ? 1 : 0.5);
    sb_canvas_pen(v->c, sigma == 3 ? 1.4 : 0.8, NULL);
    cairo_stroke(v->c->cr);
  }
}

static void draw_place(View *v, int place) {
  const SbDesignPlace *of = &v->answer->place[place];
  if (!of->known || !(of->axis[0] >= v->map->low[0] && of->axis[0] <= v->map->high[0] &&
                      of->axis[1] >= v->map->low[1] && of->axis[1] <= v->map->high[1])) {
    return;
  }
  const bool best = place == SB_DESIGN_BEST;
  const SbColor color = sb_canvas_role(v->c, best ? SB_ROLE_PASS : SB_ROLE_INK);
  const SbPoint at = place_of(v, of->axis[0], of->axis[1]);
  const bool in_plane = sb_design_on_map(v->answer, place);
  if (in_plane) {
    draw_tolerance(v, of->axis, color);
  }
  if (best) {
    cairo_move_to(v->c->cr, at.x, at.y - 7);
    cairo_line_to(v->c->cr, at.x + 7, at.y);
    cairo_line_to(v->c->cr, at.x, at.y + 7);
    cairo_line_to(v->c->cr, at.x - 7, at.y);
    cairo_close_path(v->c->cr);
  } else {
    cairo_arc(v->c->cr, at.x, at.y, 5.5, 0, 2 * M_PI);
  }
  // One that lies in another plane is hollow.
  sb_canvas_color(v->c, best && in_plane ? color : sb_canvas_role(v->c, SB_ROLE_PANEL), 1);
  cairo_fill_preserve(v->c->cr);
  sb_canvas_color(v->c, color, 1);
  sb_canvas_pen(v->c, 2, NULL);
  cairo_stroke(v->c->cr);
  g_autofree char *where = axis_text(v, of->axis);
  const int goal = g_array_index(v->answer->study->figures, int, 0);
  g_autofree char *value = sb_design_value_text(goal, of->figure[0]);
  g_autofree char *text = in_plane ? g_strdup_printf("%s, %s", where, value)
                                   : g_strdup_printf(_("%s, %s; not in this plane"), where, value);
  write_beside(v, at, 14, best ? _("best found") : _("present"), text, color);
}

static void draw_pick(View *v, const SbDesignLook *look) {
  if (!look->picked) {
    return;
  }
  const SbPoint at = place_of(v, look->pick[0], look->pick[1]);
  const SbColor accent = sb_color_hex(0x2A6DB0);
  sb_canvas_color(v->c, accent, 1);
  sb_canvas_pen(v->c, 1, NULL);
  cairo_move_to(v->c->cr, v->at.plot.x, at.y);
  cairo_line_to(v->c->cr, v->at.plot.x + v->at.plot.width, at.y);
  cairo_move_to(v->c->cr, at.x, v->at.plot.y);
  cairo_line_to(v->c->cr, at.x, v->at.plot.y + v->at.plot.height);
  cairo_stroke(v->c->cr);
  cairo_arc(v->c->cr, at.x, at.y, 5.5, 0, 2 * M_PI);
  cairo_stroke(v->c->cr);
}

// ---- All ----

SbRect sb_design_map_plot(SbRect rect) {
  return (SbRect){rect.x + 58, rect.y + 34, fmax(rect.width - 82, 60), fmax(rect.height - 94, 60)};
}

static char *axis_name(SbParamId id) {
  const SbParam *param = sb_param(id);
  g_autofree char *label = sb_translation_inside(param->label);
  return *param->unit != '\0' ? g_strdup_printf("%s / %s", label, param->unit) : g_strdup(label);
}

// What computed the map, and how far it is.
static char *foot_of(const SbDesignAnswer *answer) {
  const SbDesignMap *map = &answer->map;
  const size_t points = map->n * map->n;
  GString *text = g_string_new(NULL);
  if (map->done < points) {
    g_string_append_printf(text, _("%zu of %zu points"), map->done, points);
  } else {
    g_string_append_printf(text, _("%zu points"), points);
  }
  g_string_append_printf(text, _(" in %.1f s"), map->seconds);
  if (map->refused > 0) {
    g_string_append_printf(text, _("; %zu are infeasible or did not converge"), map->refused);
  }
  return g_string_free(text, FALSE);
}

void sb_design_map_draw(cairo_t *cr, SbRect rect, const SbTheme *theme,
                        const SbDesignAnswer *answer, const SbDesignLook *look) {
  SbCanvas canvas;
  const SbDesignMap *map = &answer->map;
  g_autofree View *v = g_new0(View, 1); // too large for a stack
  v->c = &canvas;
  v->answer = answer;
  v->map = map;
  sb_canvas_init(v->c, cr, theme);
  g_autofree char *up = axis_name(map->axis[1]), *across = axis_name(map->axis[0]);
  sb_axes_linear(&v->at, sb_design_map_plot(rect), shown(map->axis[0], map->low[0]),
                 shown(map->axis[0], map->high[0]), shown(map->axis[1], map->low[1]),
                 shown(map->axis[1], map->high[1]));
  sb_axes_ticks(&v->at, 8, 7);
  v->at.x_name = across;
  sb_labels_init(&v->labels, v->at.plot);
  // Where nothing is computed the ground stays the window's.
  sb_canvas_fill(v->c, v->at.plot, SB_ROLE_BACKGROUND, 1);
  if (map->done > 0) {
    Beyond all = {v, -INFINITY, true};
    cairo_new_path(cr);
    do_triangles(v, 0, add_beyond, &all);
    sb_canvas_color(v->c, sb_canvas_role(v->c, SB_ROLE_PANEL), 1);
    cairo_fill(cr);
  }
  sb_axes_draw(v->c, &v->at, NULL);
  sb_canvas_clip(v->c, v->at.plot);
  if (map->done > 0) {
    draw_limits(v, false);
    // The places first: lines' names keep off them.
    for (int place = 0; place < SB_DESIGN_PLACES; place++) {
      if (answer->place[place].known) {
        const SbPoint at = place_of(v, answer->place[place].axis[0], answer->place[place].axis[1]);
        sb_labels_block(&v->labels, (SbRect){at.x - 12, at.y - 22, 190, 44});
      }
    }
    draw_limits(v, true);
    for (size_t i = 0; i < map->figures; i++) {
      if ((look->lines >> i & 1u) != 0) {
        draw_levels(v, i);
      }
    }
  }
  for (int place = 0; place < SB_DESIGN_PLACES; place++) {
    draw_place(v, place);
  }
  draw_pick(v, look);
  cairo_restore(cr);
  const SbTextStyle style = sb_canvas_style(v->c, SB_TYPE_LABEL, 400, SB_ROLE_SECOND);
  const SbTextStyle note = sb_canvas_style(v->c, SB_TYPE_NOTE, 400, SB_ROLE_SECOND);
  sb_canvas_text(v->c, up, &style, rect.x + 14, rect.y + 20, SB_LEFT);
  const double wide = sb_canvas_text_width(v->c, across, &style);
  g_autofree char *foot = foot_of(answer);
  sb_canvas_text_fit(v->c, foot, &note, v->at.plot.x, v->at.plot.y + v->at.plot.height + 36,
                     v->at.plot.width - wide - 16);
  sb_canvas_finish(v->c);
}
