// Levels of the figures on the map of a design: lines, borders of limits, and what is beyond them,
// from the triangles of the computed points.
#include "app/export/design_map_private.h"

#include "app/base/format.h"
#include "app/base/translation.h"
#include "app/base/unit.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

// Values between points ---------------------------------------------------------------------------

static double value_at(const SbDesignMap *map, size_t figure, size_t across, size_t up) {
  return map->value[(up * map->n + across) * map->figures + figure];
}

static bool is_there(const SbDesignMap *map, size_t across, size_t up) {
  return map->status[up * map->n + across] != SB_ANSWER_MISSING;
}

static SbPoint point_of(const SbDesignMapView *v, size_t across, size_t up) {
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

static void do_cell(const SbDesignMapView *v, size_t figure, size_t i, size_t k, size_t step,
                    TriangleDo call, void *data) {
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
static void do_cells(const SbDesignMapView *v, size_t figure, size_t i, size_t k, size_t step,
                     TriangleDo call, void *data) {
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

static void do_triangles(const SbDesignMapView *v, size_t figure, TriangleDo call, void *data) {
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
  const SbDesignMapView *view;
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

void sb_design_map_computed(const SbDesignMapView *v) {
  Beyond all = {v, -INFINITY, true};
  do_triangles(v, 0, add_beyond, &all);
}

// Lines at an angle of its own for each limit, so that where two cross two limits are broken.
static void hatch(const SbDesignMapView *v, size_t number) {
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

// As do_cells(), a whole block in one call where it can: paths of few parts are filled fast.
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

static void draw_beyond(const SbDesignMapView *v, size_t number, size_t figure, double level,
                        bool above) {
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
static void write_along(SbDesignMapView *v, const GArray *chain, const char *text,
                        const LineLook *look) {
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

static void draw_line(SbDesignMapView *v, size_t figure, double level, const char *text,
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

static LineLook look_of(const SbDesignMapView *v, size_t figure, bool border) {
  static const SbDash dashes[SB_DESIGN_LINES] = {
      {0, {0}}, {2, {6, 4}}, {2, {1.5, 3}}, {4, {8, 3, 2, 3}}};
  static const SbRole roles[SB_DESIGN_LINES] = {SB_ROLE_SECOND, SB_ROLE_TEAL, SB_ROLE_VIOLET,
                                                SB_ROLE_OCHRE};
  const size_t number = figure % SB_DESIGN_LINES;
  const SbDash *dash = border || dashes[number].count == 0 ? NULL : &dashes[number];
  const SbRole role = border && number == 0 ? SB_ROLE_INK : roles[number];
  return border ? (LineLook){{role, 2.4, NULL}, 11.5, 700} : (LineLook){{role, 1, dash}, 11, 400};
}

void sb_design_map_levels(SbDesignMapView *v, size_t figure) {
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

void sb_design_map_limits(SbDesignMapView *v, bool borders) {
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
