// The map of a design question. See design_map.h.
#include "app/export/design_map.h"

#include "app/base/figure_text.h"
#include "app/base/translation.h"
#include "app/base/unit.h"
#include "app/export/design_map_private.h"

#include <glib/gi18n.h>
#include <math.h>
#include <string.h>

char *sb_design_value_text(int figure, double value, double error) {
  char text[SB_FORMAT_MAX];
  return g_strdup(sb_figure_text(text, figure, value, error));
}

// Drawing -----------------------------------------------------------------------------------------

static double shown(SbParamId id, double value) {
  return sb_quantity_to_shown(value, sb_param(id)->si, sb_param(id)->unit);
}

static SbPoint place_of(const SbDesignMapView *v, double across, double up) {
  return sb_axes_at(&v->at, shown(v->map->axis[0], across), shown(v->map->axis[1], up));
}

// ---- Designs ----

static char *axis_text(const SbDesignMapView *v, const double at[2]) {
  const SbParam *a = sb_param(v->map->axis[0]), *b = sb_param(v->map->axis[1]);
  char first[SB_NUMBER_SIZE], second[SB_NUMBER_SIZE];
  sb_number_round(first, shown(v->map->axis[0], at[0]), 4);
  sb_number_round(second, shown(v->map->axis[1], at[1]), 4);
  return strcmp(a->unit, b->unit) == 0
             ? g_strdup_printf("%s × %s %s", first, second, a->unit)
             : g_strdup_printf("%s %s × %s %s", first, a->unit, second, b->unit);
}

// Two lines beside a point, to its right or left, over whatever stands there.
static void write_beside(SbDesignMapView *v, SbPoint at, double off, const char *name,
                         const char *text, SbColor color) {
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

static double tolerance_of(const SbDesignMapView *v, int axis) {
  const int band = sb_param_tolerance(v->map->axis[axis]);
  return band >= 0 ? sb_model_value(v->answer->study->base, (SbParamId)band) : 0;
}

// The tolerances' box, and one, two and three deviations.
static void draw_tolerance(SbDesignMapView *v, const double at[2], SbColor color) {
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

static void draw_place(SbDesignMapView *v, int place) {
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
  g_autofree char *value = sb_design_value_text(goal, of->figure[0], of->error[0]);
  g_autofree char *text = in_plane ? g_strdup_printf("%s, %s", where, value)
                                   : g_strdup_printf(_("%s, %s; not in this plane"), where, value);
  write_beside(v, at, 14, best ? _("best found") : _("present"), text, color);
}

static void draw_pick(SbDesignMapView *v, const SbDesignLook *look) {
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
  g_autofree SbDesignMapView *v = g_new0(SbDesignMapView, 1); // too large for a stack
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
    cairo_new_path(cr);
    sb_design_map_computed(v);
    sb_canvas_color(v->c, sb_canvas_role(v->c, SB_ROLE_PANEL), 1);
    cairo_fill(cr);
  }
  sb_axes_draw(v->c, &v->at, NULL);
  sb_canvas_clip(v->c, v->at.plot);
  if (map->done > 0) {
    sb_design_map_limits(v, false);
    // The places first: lines' names keep off them.
    for (int place = 0; place < SB_DESIGN_PLACES; place++) {
      if (answer->place[place].known) {
        const SbPoint at = place_of(v, answer->place[place].axis[0], answer->place[place].axis[1]);
        sb_labels_block(&v->labels, (SbRect){at.x - 12, at.y - 22, 190, 44});
      }
    }
    sb_design_map_limits(v, true);
    for (size_t i = 0; i < map->figures; i++) {
      if ((look->lines >> i & 1u) != 0) {
        sb_design_map_levels(v, i);
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
