// The map of the page Design in cells: its ground is the objective, from dark to bright; cells
// where a limit is violated are hatched.
#include "app/terminal/workbench_private.h"

#include "app/base/translation.h"
#include "app/base/unit.h"
#include "app/export/design_map.h"
#include "app/export/design_text.h"

#include <glib/gi18n.h>
#include <math.h>

enum { LEGEND_ROWS = 4, LEAST_ROWS_OF_MAP = 4 };

// Columns of the step of an effect, of the change, and of its part of the variance.
enum { STEP_ROOM = 11, CHANGE_ROOM = 11, SHARE_ROOM = 9 };

// Whether the point violates a limit; true also where a figure with a limit has no value.
static bool violates(const SbDesignAnswer *answer, double across, double up) {
  const SbLimits *limits = &answer->study->limits;
  for (size_t i = 0; i < limits->count; i++) {
    const int column = sb_design_answer_figure(answer, limits->item[i].figure);
    const double value =
        column >= 0 ? sb_design_map_at(&answer->map, (size_t)column, across, up) : NAN;
    if (!(value >= limits->item[i].low && value <= limits->item[i].high)) {
      return true;
    }
  }
  return false;
}

// The range of a figure over the points of the map that have it.
static void range_on_map(const SbDesignMap *map, size_t figure, double *low, double *high) {
  *low = INFINITY;
  *high = -INFINITY;
  for (size_t i = 0; i < map->n * map->n; i++) {
    const double value = map->value[i * map->figures + figure];
    if (map->status[i] == SB_OK && isfinite(value)) {
      *low = fmin(*low, value);
      *high = fmax(*high, value);
    }
  }
}

static void draw_ground(SbBench *bench, const SbDesignAnswer *answer, size_t goal,
                        SbCellRect rect) {
  const SbDesignMap *map = &answer->map;
  const SbTheme *theme = sb_theme(true);
  const SbColor dark = theme->role[SB_ROLE_PANEL], bright = theme->role[SB_ROLE_INNER];
  double low, high;
  range_on_map(map, goal, &low, &high);
  for (int row = 0; row < rect.height; row++) {
    for (int column = 0; column < rect.width; column++) {
      const double u = (column + 0.5) / rect.width, v = 1 - (row + 0.5) / rect.height;
      const double across = map->low[0] + u * (map->high[0] - map->low[0]);
      const double up = map->low[1] + v * (map->high[1] - map->low[1]);
      const double value = sb_design_map_at(map, goal, across, up);
      if (isnan(value)) {
        continue;
      }
      const double share = high > low ? (value - low) / (high - low) : 0;
      SbPen pen = sb_bench_pen(bench, SB_ROLE_ERROR, 0);
      if (sb_screen_colors(bench->screen) != SB_COLORS_NONE) {
        pen.ground = sb_cell_color(sb_color_mix(dark, bright, 0.1 + 0.6 * share));
      }
      sb_cells_put(&bench->cells, rect.x + column, rect.y + row,
                   violates(answer, across, up) ? 0x2591 : ' ', pen);
    }
  }
}

static void draw_place(SbBench *bench, const SbDesignAnswer *answer, int place, SbCellRect rect) {
  const SbDesignMap *map = &answer->map;
  if (!sb_design_on_map(answer, place)) {
    return;
  }
  const double *at = answer->place[place].axis;
  const double u = (at[0] - map->low[0]) / (map->high[0] - map->low[0]);
  const double v = (at[1] - map->low[1]) / (map->high[1] - map->low[1]);
  const int x = rect.x + CLAMP((int)(u * rect.width), 0, rect.width - 1);
  const int y = rect.y + CLAMP((int)((1 - v) * rect.height), 0, rect.height - 1);
  const bool best = place == SB_DESIGN_BEST;
  sb_cells_put(&bench->cells, x, y, best ? 0x25c6 : 0x25cb,
               sb_bench_pen(bench, best ? SB_ROLE_PASS : SB_ROLE_INK, SB_CELL_BOLD));
}

static char *axis_range(const SbDesignMap *map, int axis, const char *format) {
  const SbParam *param = sb_param(map->axis[axis]);
  g_autofree char *low = sb_quantity_round(map->low[axis], param->si, param->unit, 4);
  g_autofree char *high = sb_quantity_round(map->high[axis], param->si, param->unit, 4);
  return g_strdup_printf("%s %s: %s … %s", format, sb_translation(param->label), low, high);
}

void sb_bench_draw_design_map(SbBench *bench, const SbDesignAnswer *answer, SbCellRect rect) {
  const SbPen quiet = sb_bench_pen(bench, SB_ROLE_SECOND, 0);
  const int goal =
      answer != NULL ? sb_design_answer_figure(answer, answer->study->design.figure) : -1;
  if (goal < 0 || rect.height < LEGEND_ROWS + LEAST_ROWS_OF_MAP) {
    return;
  }
  SbCells *cells = &bench->cells;
  const SbFigure *of = sb_figure(answer->study->design.figure);
  double low, high;
  range_on_map(&answer->map, (size_t)goal, &low, &high);
  g_autofree char *name = sb_design_figure_name(answer->study->design.figure);
  g_autofree char *least = sb_quantity_round(low, of->si, of->shown, 3);
  g_autofree char *most = sb_quantity_round(high, of->si, of->shown, 3);
  g_autofree char *head = g_strdup_printf("%s: %s … %s", name, least, most);
  sb_cells_text(cells, rect.x, rect.y, rect.width, head,
                sb_bench_pen(bench, SB_ROLE_INK, SB_CELL_BOLD));
  const SbCellRect map = {rect.x, rect.y + 1, rect.width, rect.height - LEGEND_ROWS};
  draw_ground(bench, answer, (size_t)goal, map);
  draw_place(bench, answer, SB_DESIGN_PRESENT, map);
  draw_place(bench, answer, SB_DESIGN_BEST, map);
  g_autofree char *across = axis_range(&answer->map, 0, "→");
  g_autofree char *up = axis_range(&answer->map, 1, "↑");
  g_autofree char *legend =
      g_strdup_printf("○ %s  ◆ %s  ░ %s", _("present"), _("best found"), _("violated"));
  const char *const line[] = {across, up, legend};
  for (int i = 0; i < 3; i++) {
    sb_cells_text(cells, rect.x, map.y + map.height + i, rect.width, line[i], quiet);
  }
}

// Effects of tolerances --------------------------------------------------------------------------

// The design whose effects are shown; NULL: none is known.
static const SbDesignPlace *effects_at(const SbDesignAnswer *answer) {
  const SbDesignPlace *best = answer != NULL ? &answer->place[SB_DESIGN_BEST] : NULL;
  return best == NULL ? NULL : best->known ? best : &answer->place[SB_DESIGN_PRESENT];
}

static void draw_tolerance(SbBench *bench, const SbDesignPlace *at, int figure, int column,
                           size_t k, SbCellRect rect) {
  SbCells *cells = &bench->cells;
  const SbParamId id = at->effect[column][k].id;
  const SbPen pen = sb_bench_pen(bench, SB_ROLE_INK, 0);
  const int x = rect.x + rect.width - STEP_ROOM - CHANGE_ROOM - SHARE_ROOM;
  g_autofree char *step =
      sb_design_step_text(id, at->effect[column][k].step, at->effect[column][k].tolerance);
  g_autofree char *change = sb_design_value_text(figure, at->effect[column][k].change, NAN);
  g_autofree char *share = sb_design_share_text(at, (size_t)column, k);
  sb_cells_text(cells, rect.x, rect.y, x - rect.x - 1, sb_translation(sb_param(id)->label), pen);
  sb_cells_text_right(cells, x, rect.y, STEP_ROOM, step, pen);
  sb_cells_text_right(cells, x + STEP_ROOM, rect.y, CHANGE_ROOM, change, pen);
  sb_cells_text_right(cells, x + STEP_ROOM + CHANGE_ROOM, rect.y, SHARE_ROOM, share, pen);
}

// The largest effects in one line.
static void draw_tolerances_line(SbBench *bench, const SbDesignPlace *at, int figure, int column,
                                 SbCellRect rect) {
  g_autofree char *name = sb_design_figure_name(figure);
  GString *text = g_string_new(NULL);
  g_string_append_printf(text, _("Tolerances and %s (e: next)"), name);
  for (size_t k = 0; k < at->effects[column]; k++) {
    const SbParamId id = at->effect[column][k].id;
    g_autofree char *change = sb_design_value_text(figure, at->effect[column][k].change, NAN);
    g_string_append_printf(text, "%s %s %s", k > 0 ? "," : ":", sb_translation(sb_param(id)->label),
                           change);
  }
  sb_cells_text(&bench->cells, rect.x, rect.y, rect.width, text->str,
                sb_bench_pen(bench, SB_ROLE_SECOND, 0));
  g_string_free(text, TRUE);
}

void sb_bench_draw_design_effects(SbBench *bench, const SbDesignAnswer *answer, int figure,
                                  SbCellRect rect) {
  const int column = answer != NULL ? sb_design_answer_figure(answer, figure) : -1;
  const SbDesignPlace *at = column >= 0 ? effects_at(answer) : NULL;
  if (at == NULL || at->effects[column] == 0 || rect.height < 1) {
    return;
  }
  if (rect.height < 3) {
    draw_tolerances_line(bench, at, figure, column, rect);
    return;
  }
  g_autofree char *name = sb_design_figure_name(figure);
  g_autofree char *head = g_strdup_printf(_("Tolerances and %s (e: next)"), name);
  sb_cells_text(&bench->cells, rect.x, rect.y, rect.width - SHARE_ROOM, head,
                sb_bench_pen(bench, SB_ROLE_INK, SB_CELL_BOLD));
  sb_cells_text_right(&bench->cells, rect.x + rect.width - SHARE_ROOM, rect.y, SHARE_ROOM,
                      _("variance"), sb_bench_pen(bench, SB_ROLE_SECOND, 0));
  for (size_t k = 0; k < MIN(at->effects[column], (size_t)rect.height - 1); k++) {
    draw_tolerance(bench, at, figure, column, k,
                   (SbCellRect){rect.x, rect.y + 1 + (int)k, rect.width, 1});
  }
}
