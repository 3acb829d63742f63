// Tolerances and scatter of a design question. See design_map.h. Shares of the variance are those
// of independent normal parameters to first order, a tolerance's half-width being three deviations.
#include "app/export/design_map.h"

#include "app/base/format.h"
#include "app/base/translation.h"
#include "app/base/unit.h"
#include "app/draw/axis.h"
#include "app/draw/frame.h"
#include "app/export/design_text.h"

#include <glib/gi18n.h>
#include <math.h>
#include <string.h>

static int id_of(const SbDesignAnswer *answer, size_t figure) {
  return g_array_index(answer->study->figures, int, figure);
}

// The limit on a figure, open where there is none.
static SbLimit limit_on(const SbDesignAnswer *answer, int id) {
  for (size_t i = 0; i < answer->study->limits.count; i++) {
    if (answer->study->limits.item[i].figure == id) {
      return answer->study->limits.item[i];
    }
  }
  return (SbLimit){id, -INFINITY, INFINITY};
}

static int shown_place(const SbDesignAnswer *answer) {
  return answer->place[SB_DESIGN_BEST].known ? SB_DESIGN_BEST : SB_DESIGN_PRESENT;
}

// Tornado -----------------------------------------------------------------------------------------

// A tornado that is being drawn, in the figure's display unit.
typedef struct {
  SbCanvas *c;
  SbRect rect; // of the whole drawing
  SbAxes axes;
  const SbFigure *of;
  const SbDesignPlace *at;
  size_t column;          // of the figure
  double middle, side[2]; // its value, its limits
} Tornado;

static double change_of(const Tornado *t, size_t k) {
  return sb_quantity_to_shown(t->at->effect[t->column][k].change, t->of->si, t->of->shown);
}

// The range holds the largest effect, and a limit that is near.
static void set_axes(Tornado *t, size_t count) {
  const double names = fmin(150, 0.27 * t->rect.width), steps = 72, shares = 52;
  const SbRect plot = {t->rect.x + names + steps, t->rect.y + 40,
                       t->rect.width - names - steps - shares, fmax(t->rect.height - 40 - 26, 20)};
  double reach = 0;
  for (size_t k = 0; k < count; k++) {
    reach = fmax(reach, fabs(change_of(t, k)));
  }
  double ends[2] = {t->middle - 1.4 * reach, t->middle + 1.4 * reach};
  for (int side = 0; side < 2; side++) {
    if (isfinite(t->side[side]) && fabs(t->side[side] - t->middle) < 3 * reach) {
      ends[0] = fmin(ends[0], t->side[side] - 0.15 * reach);
      ends[1] = fmax(ends[1], t->side[side] + 0.15 * reach);
    }
  }
  t->axes = (SbAxes){.upright = true};
  sb_axes_linear(&t->axes, plot, ends[0], ends[1], 0, 1);
  sb_axes_ticks(&t->axes, 5, 0);
}

// The ground beyond the limits.
static void draw_sides(const Tornado *t) {
  const SbRect plot = t->axes.plot;
  for (int side = 0; side < 2; side++) {
    if (t->side[side] >= t->axes.x.lo && t->side[side] <= t->axes.x.hi) {
      const double px = sb_axis_at(&t->axes.x, t->side[side]);
      const double end = side == 0 ? plot.x : plot.x + plot.width;
      sb_canvas_fill(t->c, (SbRect){fmin(px, end), plot.y, fabs(px - end), plot.height},
                     SB_ROLE_ERROR_GROUND, 1);
      sb_canvas_line(t->c, (SbStroke){SB_ROLE_ERROR, 1.6, NULL}, px, plot.y, px,
                     plot.y + plot.height);
    }
  }
}

static void draw_effect(const Tornado *t, size_t k, double y, double high) {
  SbCanvas *c = t->c;
  const SbRect plot = t->axes.plot;
  const SbTextStyle name = sb_canvas_style(c, SB_TYPE_LABEL, 400, SB_ROLE_INK);
  const SbTextStyle small = sb_canvas_style(c, SB_TYPE_NOTE, 400, SB_ROLE_SECOND);
  const double change = change_of(t, k), base = y + high / 2 + 4;
  const double zero = sb_axis_at(&t->axes.x, t->middle);
  const double a = sb_axis_at(&t->axes.x, t->middle - fabs(change));
  const double b = sb_axis_at(&t->axes.x, t->middle + fabs(change));
  sb_canvas_color(c, sb_theme_diverging(c->theme, -0.6), 1);
  cairo_rectangle(c->cr, a, y + 3, zero - a, high - 6);
  cairo_fill(c->cr);
  sb_canvas_color(c, sb_theme_diverging(c->theme, 0.6), 1);
  cairo_rectangle(c->cr, zero, y + 3, b - zero, high - 6);
  cairo_fill(c->cr);
  // Which end the greater value makes.
  if (k < 2 && a - plot.x > 34 && plot.x + plot.width - b > 34) {
    sb_canvas_text(c, change > 0 ? _("less") : _("more"), &small, a - 4, base, SB_RIGHT);
    sb_canvas_text(c, change > 0 ? _("more") : _("less"), &small, b + 4, base, SB_LEFT);
  }
  const SbParamId id = t->at->effect[t->column][k].id;
  sb_canvas_text_fit(c, sb_translation(sb_param(id)->label), &name, t->rect.x, base,
                     fmin(150, 0.27 * t->rect.width) - 6);
  g_autofree char *step = sb_design_step_text(id, t->at->effect[t->column][k].step,
                                              t->at->effect[t->column][k].tolerance);
  sb_canvas_text(c, step, &small, plot.x - 10, base, SB_RIGHT);
  g_autofree char *share = sb_design_share_text(t->at, t->column, k);
  sb_canvas_text(c, share, &name, t->rect.x + t->rect.width, base, SB_RIGHT);
}

static void draw_effects(Tornado *t, size_t count) {
  const SbTextStyle small = sb_canvas_style(t->c, SB_TYPE_NOTE, 400, SB_ROLE_SECOND);
  set_axes(t, count);
  sb_axes_draw(t->c, &t->axes, NULL);
  draw_sides(t);
  const SbRect plot = t->axes.plot;
  const double high = fmax(fmin(21, plot.height / (double)count), 14);
  const double zero = sb_axis_at(&t->axes.x, t->middle);
  sb_canvas_text(t->c, _("of the variance"), &small, t->rect.x + t->rect.width, t->rect.y + 32,
                 SB_RIGHT);
  for (size_t k = 0; k < MIN(count, (size_t)fmax(plot.height / 14, 1)); k++) {
    draw_effect(t, k, plot.y + high * (double)k, high);
  }
  sb_canvas_line(t->c, (SbStroke){SB_ROLE_INK, 1.6, NULL}, zero, plot.y, zero,
                 plot.y + plot.height);
}

void sb_design_tornado_draw(cairo_t *cr, SbRect rect, const SbTheme *theme,
                            const SbDesignAnswer *answer, int figure) {
  SbCanvas canvas;
  sb_canvas_init(&canvas, cr, theme);
  const int which = shown_place(answer), column = sb_design_answer_figure(answer, figure);
  const SbDesignPlace *at = &answer->place[which];
  const SbFigure *of = sb_figure(figure);
  g_autofree char *label = sb_translation_inside(of->label);
  g_autofree char *note = g_strdup_printf(which == SB_DESIGN_BEST ? _("%s at the best found / %s")
                                                                  : _("%s at present / %s"),
                                          label, of->shown);
  sb_frame_title(&canvas, rect, 13, _("Which tolerance matters"), note);
  const size_t count = column >= 0 && at->known ? at->effects[column] : 0;
  if (count > 0) {
    const SbLimit limit = limit_on(answer, figure);
    Tornado tornado = {.c = &canvas,
                       .rect = rect,
                       .of = of,
                       .at = at,
                       .column = (size_t)column,
                       .middle = sb_quantity_to_shown(at->figure[column], of->si, of->shown),
                       .side = {sb_quantity_to_shown(limit.low, of->si, of->shown),
                                sb_quantity_to_shown(limit.high, of->si, of->shown)}};
    draw_effects(&tornado, count);
  } else {
    const SbTextStyle small = sb_canvas_style(&canvas, SB_TYPE_NOTE, 400, SB_ROLE_SECOND);
    sb_canvas_text(&canvas, at->known ? _("Nothing changes it.") : _("Not computed yet."), &small,
                   rect.x, rect.y + 44, SB_LEFT);
  }
  sb_canvas_finish(&canvas);
}

// Scatter -----------------------------------------------------------------------------------------

enum { BINS = 44 };

static size_t beyond_of(const SbDesignPlace *at, size_t figures, size_t column,
                        const SbLimit *limit, size_t *of) {
  size_t beyond = 0;
  *of = 0;
  for (size_t i = 0; i < at->samples; i++) {
    const double value = at->sample[i * figures + column];
    if (isfinite(value)) {
      beyond += value < limit->low || value > limit->high;
      (*of)++;
    }
  }
  return beyond;
}

static void spread(const SbDesignPlace *at, size_t figures, size_t column, double *lo, double *hi) {
  for (size_t i = 0; i < at->samples; i++) {
    const double value = at->sample[i * figures + column];
    if (isfinite(value)) {
      *lo = fmin(*lo, value);
      *hi = fmax(*hi, value);
    }
  }
}

static void draw_bins(SbCanvas *c, const SbAxes *axes, const SbFigure *of, const SbDesignPlace *at,
                      size_t figures, size_t column, const SbLimit *limit, SbRole role) {
  const SbRect plot = axes->plot;
  double lo = INFINITY, hi = -INFINITY, most = 0, bins[BINS] = {0};
  spread(at, figures, column, &lo, &hi);
  sb_axis_repair(&lo, &hi);
  const int count = (int)fmin(fmax(sqrt((double)at->samples), 8), BINS);
  for (size_t i = 0; i < at->samples; i++) {
    const double value = at->sample[i * figures + column];
    if (isfinite(value)) {
      const int bin = (int)((value - lo) / (hi - lo) * count);
      bins[bin < 0 ? 0 : bin >= count ? count - 1 : bin] += 1;
    }
  }
  for (int k = 0; k < count; k++) {
    most = fmax(most, bins[k]);
  }
  for (int k = 0; k < count && most > 0; k++) {
    const double from = lo + (hi - lo) * k / count, to = lo + (hi - lo) * (k + 1) / count;
    const double a = sb_axis_at(&axes->x, sb_quantity_to_shown(from, of->si, of->shown));
    const double b = sb_axis_at(&axes->x, sb_quantity_to_shown(to, of->si, of->shown));
    const double height = plot.height * bins[k] / most;
    const double middle = (from + to) / 2;
    const bool beyond = middle < limit->low || middle > limit->high;
    sb_canvas_color(c, sb_canvas_role(c, beyond ? SB_ROLE_ERROR : role),
                    role == SB_ROLE_PASS ? 0.6 : 0.45);
    const double gap = b - a > 3 ? 0.6 : 0; // narrow bars are a surface
    cairo_rectangle(c->cr, a + gap / 2, plot.y + plot.height - height, b - a - gap, height);
    cairo_fill(c->cr);
  }
}

static void draw_one(SbCanvas *c, SbRect rect, const SbDesignAnswer *answer, size_t limit_at) {
  const SbLimit limit = answer->study->limits.item[limit_at];
  const SbFigure *of = sb_figure(limit.figure);
  const size_t column = (size_t)sb_design_answer_figure(answer, limit.figure);
  const size_t figures = answer->map.figures;
  const SbTextStyle bold = sb_canvas_style(c, SB_TYPE_NOTE, 700, SB_ROLE_INK);
  const SbTextStyle small = sb_canvas_style(c, SB_TYPE_NOTE, 400, SB_ROLE_SECOND);
  double lo = INFINITY, hi = -INFINITY;
  g_autofree char *label = sb_translation_inside(of->label);
  g_autofree char *title =
      of->shown[0] != '\0' ? g_strdup_printf("%s / %s", label, of->shown) : g_strdup(label);
  sb_canvas_text_fit(c, title, &bold, rect.x, rect.y + 12, rect.width);
  for (int place = 0; place < SB_DESIGN_PLACES; place++) {
    spread(&answer->place[place], figures, column, &lo, &hi);
  }
  if (!(lo <= hi)) {
    sb_canvas_text(c, _("no valve has it"), &small, rect.x, rect.y + 40, SB_LEFT);
    return;
  }
  const double wide = hi - lo;
  // A limit far away stays out of sight: the fraction beyond it states its side.
  lo = isfinite(limit.low) && limit.low > lo - 2 * wide ? fmin(lo, limit.low) : lo;
  hi = isfinite(limit.high) && limit.high < hi + 2 * wide ? fmax(hi, limit.high) : hi;
  sb_axis_repair(&lo, &hi);
  const SbRect plot = {rect.x, rect.y + 52, rect.width, fmax(rect.height - 52 - 24, 10)};
  SbAxes axes = {.card = rect};
  sb_axes_linear(&axes, plot, sb_quantity_to_shown(lo - 0.03 * (hi - lo), of->si, of->shown),
                 sb_quantity_to_shown(hi + 0.03 * (hi - lo), of->si, of->shown), 0, 1);
  sb_axes_ticks(&axes, 4, 0);
  static const SbRole roles[] = {SB_ROLE_THIRD, SB_ROLE_PASS};
  static const SbRole words[] = {SB_ROLE_SECOND, SB_ROLE_PASS};
  double line = rect.y + 28;
  for (int place = 0; place < SB_DESIGN_PLACES; place++) {
    const SbDesignPlace *at = &answer->place[place];
    if (at->samples == 0) {
      continue;
    }
    draw_bins(c, &axes, of, at, figures, column, &limit, roles[place]);
    size_t valves = 0;
    const size_t beyond = beyond_of(at, figures, column, &limit, &valves);
    g_autofree char *value =
        sb_design_value_text(limit.figure, at->figure[column], at->error[column]);
    g_autofree char *text =
        g_strdup_printf(place == SB_DESIGN_BEST ? _("best %s, %zu of %zu beyond")
                                                : _("present %s, %zu of %zu beyond"),
                        value, beyond, valves);
    const SbTextStyle style =
        sb_canvas_style(c, SB_TYPE_NOTE, 600, beyond > 0 ? SB_ROLE_ERROR : words[place]);
    sb_canvas_text_fit(c, text, &style, rect.x, line, rect.width);
    line += 15;
  }
  sb_axes_draw(c, &axes, NULL);
  for (int side = 0; side < 2; side++) {
    const double at = sb_quantity_to_shown(side == 0 ? limit.low : limit.high, of->si, of->shown);
    if (isfinite(at) && at >= axes.x.lo && at <= axes.x.hi) {
      sb_canvas_line(c, (SbStroke){SB_ROLE_ERROR, 1.6, NULL}, sb_axis_at(&axes.x, at), plot.y,
                     sb_axis_at(&axes.x, at), plot.y + plot.height);
    }
  }
}

void sb_design_scatter_draw(cairo_t *cr, SbRect rect, const SbTheme *theme,
                            const SbDesignAnswer *answer) {
  SbCanvas canvas;
  SbCanvas *c = &canvas;
  sb_canvas_init(c, cr, theme);
  size_t drawn = 0;
  for (int place = 0; place < SB_DESIGN_PLACES; place++) {
    drawn = MAX(drawn, answer->place[place].samples);
  }
  g_autofree char *title =
      drawn > 0 ? g_strdup_printf(_("%zu valves"), drawn) : g_strdup(_("Valves within tolerances"));
  sb_frame_title(c, rect, 13, title,
                 drawn > 0 ? _("drawn from the tolerances; green: best found, grey: present")
                           : _("not drawn yet"));
  // Those nearest to their limits, from the left.
  const SbLimits *limits = &answer->study->limits;
  const int which = shown_place(answer);
  const size_t room = (size_t)fmin(fmax(rect.width / 200, 1), 4);
  bool taken[SB_LIMITS_MAX] = {false};
  const size_t count = MIN(room, limits->count);
  for (size_t k = 0; drawn > 0 && k < count; k++) {
    size_t next = limits->count;
    double nearest = INFINITY;
    for (size_t i = 0; i < limits->count; i++) {
      const double sigmas = sb_design_sigmas(answer, which, i);
      const double rank = isnan(sigmas) ? 1e9 : sigmas;
      if (!taken[i] && (next == limits->count || rank < nearest)) {
        next = i;
        nearest = rank;
      }
    }
    taken[next] = true;
    const double gap = 24, each = (rect.width - gap * (double)(count - 1)) / (double)count;
    draw_one(c, (SbRect){rect.x + (each + gap) * (double)k, rect.y + 26, each, rect.height - 26},
             answer, next);
  }
  sb_canvas_finish(c);
}

static double shown_of_param(SbParamId id, double value) {
  return sb_quantity_to_shown(value, sb_param(id)->si, sb_param(id)->unit);
}

// Words -------------------------------------------------------------------------------------------

char *sb_design_text(const SbDesignAnswer *answer) {
  GString *text = g_string_new(NULL);
  const SbDesignMap *map = &answer->map;
  g_string_append_printf(text, _("Map of %s and %s: %zu of %zu points."),
                         sb_translation(sb_param(map->axis[0])->label),
                         sb_translation(sb_param(map->axis[1])->label), map->done, map->n * map->n);
  for (int place = 0; place < SB_DESIGN_PLACES; place++) {
    const SbDesignPlace *at = &answer->place[place];
    if (!at->known) {
      continue;
    }
    g_string_append_printf(text, "\n%s", place == SB_DESIGN_BEST ? _("best found") : _("present"));
    for (guint k = 0; k < answer->study->vary->len; k++) {
      const SbParamId id = g_array_index(answer->study->vary, SbVary, k).id;
      char digits[SB_NUMBER_SIZE];
      sb_number_round(digits, shown_of_param(id, at->value[k]), 4);
      g_string_append_printf(text, ", %s %s %s", sb_translation(sb_param(id)->label), digits,
                             sb_param(id)->unit);
    }
    for (size_t i = 0; i < map->figures; i++) {
      g_autofree char *value = sb_design_value_text(id_of(answer, i), at->figure[i], at->error[i]);
      g_string_append_printf(text, ", %s %s", sb_translation(sb_figure(id_of(answer, i))->label),
                             value);
    }
  }
  return g_string_free(text, FALSE);
}
