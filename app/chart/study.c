// The panels of a study. Each curve is named at its end: the names stand in a gutter on the right,
// moved apart where they would collide, with a leader in the curve's own colour and dash; a curve
// that ends earlier (its model has no answer further on) is named where it ends. What was solved is
// solid, differing in lightness; laws and literature are dashed grey; single values are ringed
// dots. The range follows what was solved: a closed form that leaves it is clipped.
#include "app/chart/study.h"

#include "app/base/format.h"
#include "app/base/translation.h"
#include "app/base/unit.h"
#include "app/chart/study_private.h"

#include <glib.h>
#include <glib/gi18n.h>
#include <math.h>
#include <string.h>

#define NOTE_LINE 16.0
#define TITLE     46.0 // above a plot: its quantity and unit
#define FOOT      44.0 // below it: marks and the abscissa

enum { NAMES = SB_STUDY_PANELS * SB_STUDY_SERIES };

// ---------------------------------------------------------------------------------------------------
// Layout

// Panels in a row: as many as keep them between portrait and banner.
static int choose_columns(size_t count, double width, double height) {
  int best = 1;
  double best_miss = INFINITY;
  for (int columns = 1; columns <= (int)count; columns++) {
    int rows = ((int)count + columns - 1) / columns;
    double ratio = (width / columns) / (height / rows);
    // An empty place in the grid is worse than an odd shape.
    double miss = fabs(log(ratio / 1.45)) + 0.4 * (columns * rows - (int)count);
    if (miss < best_miss) {
      best_miss = miss;
      best = columns;
    }
  }
  return best;
}

void sb_study_layout(SbStudyLayout *out, SbRect rect, const SbStudy *study) {
  *out = (SbStudyLayout){0};
  size_t lines = study->note_count + (study->validity[0] ? 1 : 0);
  double notes = lines > 0 ? NOTE_LINE * (double)lines + 4 : 0;
  double table = sb_study_table_height(study);
  double gap = 16;
  // Without panels the table has it all; with them it leaves them half.
  double room = rect.height - notes - (notes > 0 ? 10 : 0);
  if (study->panel_count > 0) {
    table = fmin(table, 0.55 * room);
  }
  double charts = fmax(room - table - (table > 0 ? gap : 0), 40);
  double y = rect.y;
  if (study->panel_count > 0) {
    int columns = choose_columns(study->panel_count, rect.width, charts);
    int rows = ((int)study->panel_count + columns - 1) / columns;
    double width = floor((rect.width - gap * (columns - 1)) / columns);
    double height = floor((charts - gap * (rows - 1)) / rows);
    for (int i = 0; i < (int)study->panel_count; i++) {
      int row = i / columns, column = i % columns;
      out->panel[i] =
          (SbRect){rect.x + (width + gap) * column, y + (height + gap) * row, width, height};
    }
    y += charts + gap;
  }
  out->table = (SbRect){rect.x, y, rect.width, table};
  out->notes = (SbRect){rect.x, rect.y + rect.height - notes, rect.width, notes};
}

// ---------------------------------------------------------------------------------------------------
// Styles

// Index of a series among those of its style, counted over all panels by name.
static int style_index(const SbStudy *study, const SbStudySeries *series) {
  const char *seen[NAMES];
  int count = 0;
  for (size_t p = 0; p < study->panel_count; p++) {
    for (size_t s = 0; s < study->panel[p].series_count; s++) {
      const SbStudySeries *other = &study->panel[p].series[s];
      if (other->style != series->style) {
        continue;
      }
      int known = 0;
      while (known < count && strcmp(seen[known], other->name) != 0) {
        known++;
      }
      if (strcmp(other->name, series->name) == 0) {
        return known;
      }
      if (known == count) {
        seen[count++] = other->name;
      }
    }
  }
  return 0;
}

SbStroke sb_study_series_look(const SbStudy *study, const SbStudySeries *series) {
  static const SbRole solved[] = {SB_ROLE_INK, SB_ROLE_VIOLET, SB_ROLE_TEAL, SB_ROLE_FLUID};
  static const SbDash *const dashes[] = {&sb_dash_reference, &sb_dash_pinned, &sb_dash_dimension,
                                         &sb_dash_centre, &sb_dash_dose};
  // A seal has its own colour everywhere.
  if (series->seal > 0) {
    const bool outer = series->seal == 1 + SB_OUTER;
    return (SbStroke){outer ? SB_ROLE_OUTER : SB_ROLE_INNER, SB_LINE_SEAL, NULL};
  }
  int index = style_index(study, series);
  if (series->style == SB_STUDY_REFERENCE) {
    return (SbStroke){index % 2 == 0 ? SB_ROLE_SECOND : SB_ROLE_PINNED, 1.6,
                      dashes[index % (int)G_N_ELEMENTS(dashes)]};
  }
  if (series->style == SB_STUDY_DOTS) {
    return (SbStroke){solved[index % (int)G_N_ELEMENTS(solved)], 1.6, NULL};
  }
  return (SbStroke){solved[index % (int)G_N_ELEMENTS(solved)],
                    index == 0 ? SB_LINE_ACTIVE : SB_LINE_SEAL,
                    index < (int)G_N_ELEMENTS(solved) ? NULL : &sb_dash_pinned};
}

// ---------------------------------------------------------------------------------------------------
// One panel

enum { NARROW = 300 }; // below it curves are named in the plot, not beside it

static double unit_of(const SbStudyAxis *axis) {
  return sb_quantity_to_shown(1, axis->si, axis->unit) -
         sb_quantity_to_shown(0, axis->si, axis->unit);
}

// The abscissa alone may be a point of a scale (degC).
static double x_shown(const SbStudyPlot *plot, double x) {
  return x * plot->x_unit + plot->x_zero;
}

static bool usable(const SbStudyPlot *plot, double x, double y) {
  return isfinite(x) && isfinite(y) && (x > 0 || !plot->study->x.logarithmic) &&
         (y > 0 || !plot->panel->y.logarithmic);
}

typedef struct {
  double lo, hi;
} Span;

static void span_add(Span *span, double value) {
  span->lo = fmin(span->lo, value);
  span->hi = fmax(span->hi, value);
}

// Ranges in shown units. A reference may widen the range of the rest by a third and no more.
static void set_scales(SbStudyPlot *plot) {
  Span x = {INFINITY, -INFINITY}, y = x, all = x;
  for (size_t s = 0; s < plot->panel->series_count; s++) {
    const SbStudySeries *series = &plot->panel->series[s];
    for (size_t i = 0; i < series->count; i++) {
      if (isfinite(series->x[i])) {
        span_add(&x, x_shown(plot, series->x[i]));
      }
      if (usable(plot, series->x[i], series->y[i])) {
        span_add(&all, series->y[i] * plot->y_unit);
        if (series->style != SB_STUDY_REFERENCE) {
          span_add(&y, series->y[i] * plot->y_unit);
        }
      }
    }
  }
  bool log_y = plot->panel->y.logarithmic;
  if (!(y.hi >= y.lo)) {
    y = all;
  } else if (log_y) {
    y.hi = fmin(all.hi, y.hi * 10);
    y.lo = fmax(all.lo, y.lo / 10);
    // Twelve decades are enough for any eye.
    y.lo = fmax(y.lo, y.hi * 1e-12);
  } else {
    double more = 0.35 * fmax(y.hi - y.lo, fabs(y.hi) * 0.1);
    y.hi = fmin(all.hi, y.hi + more);
    y.lo = fmax(all.lo, y.lo - more);
  }
  plot->empty = !(y.hi >= y.lo);
  if (plot->empty) {
    y = log_y ? (Span){0.1, 10} : (Span){0, 1};
  }
  if (log_y) {
    double room = fmax(0.06 * log10(y.hi / y.lo), 0.08);
    y.lo /= pow(10, room);
    y.hi *= pow(10, room);
  } else {
    if (y.lo > 0 && y.lo < 0.55 * y.hi) {
      y.lo = 0;
    }
    if (!(y.hi > y.lo)) {
      double half = fmax(fabs(y.hi), 1e-12) * 0.5;
      y.hi += half;
      y.lo -= half;
    }
    y.hi += 0.04 * (y.hi - y.lo);
    sb_axis_round_out(&y.lo, &y.hi, 5);
  }
  if (!(x.hi > x.lo)) {
    x = (Span){0, 1};
  }
  const SbRect r = plot->at.plot;
  sb_axes_linear(&plot->at, r, x.lo, x.hi, y.lo, y.hi);
  plot->at.x.logarithmic = plot->study->x.logarithmic;
  plot->at.y.logarithmic = log_y;
  sb_axes_ticks(&plot->at, (int)CLAMP(r.width / 60, 3, 7),
                plot->empty ? 0 : (int)CLAMP(r.height * 1.4 / 60, 3, 7));
}

// Makes room for the numbers of the upright axis, whose range does not depend on the plot's width.
static void fit_numbers(SbStudyPlot *plot) {
  SbTextStyle label = sb_canvas_style(plot->canvas, SB_TYPE_LABEL, 400, SB_ROLE_SECOND);
  char text[SB_FORMAT_MAX];
  const double left = plot->at.plot.x;
  double widest = 0;
  for (int i = 0; i < plot->at.y_ticks.count; i++) {
    sb_axis_text(text, &plot->at.y_ticks, plot->at.y_ticks.value[i]);
    widest = fmax(widest, sb_canvas_text_width(plot->canvas, text, &label));
  }
  plot->at.plot.x = fmax(left, plot->at.card.x + 4 + ceil(widest) + 8);
  plot->at.plot.width -= plot->at.plot.x - left;
  set_scales(plot);
}

static void draw_axes(SbStudyPlot *plot) {
  const SbStudyAxis *axis = &plot->study->x;
  g_autofree char *title = g_strdup_printf("%s%s%s", sb_translation(axis->quantity),
                                           axis->unit[0] ? " / " : "", sb_translation(axis->unit));
  plot->at.x_name = title;
  sb_axes_draw(plot->canvas, &plot->at, NULL);
  plot->at.x_name = NULL;
}

static void draw_marks(SbStudyPlot *plot) {
  SbCanvas *c = plot->canvas;
  SbRect r = plot->at.plot;
  SbTextStyle style = sb_canvas_style(c, SB_TYPE_NOTE, 400, SB_ROLE_SECOND);
  for (size_t i = 0; i < plot->study->mark_count; i++) {
    const SbStudyMark *mark = &plot->study->mark[i];
    double value = x_shown(plot, mark->x);
    double slack = 1e-9 * fabs(plot->at.x.hi);
    if (!(value >= plot->at.x.lo - slack && value <= plot->at.x.hi + slack)) {
      continue;
    }
    double x = floor(sb_axis_at(&plot->at.x, value)) + 0.5;
    sb_canvas_line(c, (SbStroke){SB_ROLE_AXIS, 1, &sb_dash_dimension}, x, r.y - 4, x,
                   r.y + r.height);
    SbPlace at;
    const SbPlace places[] = {{x + 5, r.y + 5, SB_LEFT},
                              {x - 5, r.y + 5, SB_RIGHT},
                              {x + 5, r.y + r.height - 7, SB_LEFT},
                              {x - 5, r.y + r.height - 7, SB_RIGHT}};
    g_autofree char *shown = sb_translation_of_case(mark->text);
    if (sb_labels_place(plot->labels, c, shown, &style, places, 4, &at)) {
      sb_canvas_text_halo(c, shown, &style, at.x, at.y, at.align);
    }
  }
}

// Pixels of a series, gaps kept as points that are not finite. Owned by the caller (g_free).
static SbPoint *series_points(const SbStudyPlot *plot, const SbStudySeries *series) {
  SbPoint *out = g_new(SbPoint, series->count + 1);
  for (size_t i = 0; i < series->count; i++) {
    bool good = usable(plot, series->x[i], series->y[i]);
    out[i] = good ? sb_axes_at(&plot->at, x_shown(plot, series->x[i]), series->y[i] * plot->y_unit)
                  : (SbPoint){NAN, NAN};
  }
  return out;
}

bool sb_study_inside(const SbStudyPlot *plot, SbPoint p) {
  return isfinite(p.x) && isfinite(p.y) && p.y >= plot->at.plot.y - 3 &&
         p.y <= plot->at.plot.y + plot->at.plot.height + 3;
}

static void draw_series(SbStudyPlot *plot, const SbStudySeries *series, const SbPoint *points) {
  SbCanvas *c = plot->canvas;
  SbStroke look = sb_study_series_look(plot->study, series);
  if (series->style == SB_STUDY_DOTS) {
    for (size_t i = 0; i < series->count; i++) {
      if (sb_study_inside(plot, points[i])) {
        sb_canvas_ringed_dot(c, points[i].x, points[i].y, sb_canvas_role(c, look.role));
      }
    }
    return;
  }
  SbRect r = plot->at.plot;
  sb_canvas_clip(c, (SbRect){r.x - 2, r.y - 2, r.width + 4, r.height + 4});
  sb_canvas_stroke(c, look);
  // A stroke of its own for each part between gaps.
  size_t from = 0;
  for (size_t i = 0; i <= series->count; i++) {
    if (i == series->count || !isfinite(points[i].x + points[i].y)) {
      if (i - from > 1) {
        sb_canvas_polyline(c, points + from, i - from);
        sb_labels_avoid(plot->labels, points + from, i - from, 1);
      } else if (i > from) {
        sb_canvas_dot(c, points[from].x, points[from].y, 2, sb_canvas_role(c, look.role));
        sb_canvas_stroke(c, look);
      }
      from = i + 1;
    }
  }
  cairo_restore(c->cr);
}

// "Force / N", smaller where it is too long.
static void panel_title(SbCanvas *c, SbRect rect, double pad, const SbStudyAxis *y) {
  SbTextStyle style = sb_canvas_style(c, SB_TYPE_PANEL_WINDOW, 700, SB_ROLE_INK);
  const char *quantity = sb_translation(y->quantity);
  const char *rest = *quantity != '\0' ? g_utf8_next_char(quantity) : quantity;
  g_autofree char *first = g_utf8_strup(quantity, rest - quantity);
  g_autofree char *text = g_strdup_printf("%s%s%s%s%s", first, rest, y->unit[0] ? " / " : "",
                                          y->unit, y->logarithmic ? _(", log scale") : "");
  if (sb_canvas_text_width(c, text, &style) > rect.width - 2 * pad) {
    style.size = SB_TYPE_LABEL;
  }
  sb_canvas_text_fit(c, text, &style, rect.x + pad, rect.y + 28, rect.width - 2 * pad);
}

// Room for the names of the curves on the right of the plot.
static double gutter_of(SbCanvas *c, const SbStudyPanel *panel, double width) {
  const SbTextStyle label = sb_canvas_style(c, SB_TYPE_LABEL, 400, SB_ROLE_INK);
  double gutter = width < NARROW ? 0 : 40;
  for (size_t s = 0; width >= NARROW && s < panel->series_count; s++) {
    g_autofree char *shown = sb_translation_of_case(panel->series[s].name);
    gutter = fmax(gutter, sb_canvas_text_width(c, shown, &label) + 24);
  }
  return fmin(gutter, 0.4 * width);
}

// The axes, curves and marks of a panel; without a curve the reason.
static void draw_plot(SbStudyPlot *plot, double pad, double gutter) {
  SbCanvas *c = plot->canvas;
  const SbStudyPanel *panel = plot->panel;
  const SbRect r = plot->at.plot, card = plot->at.card;
  draw_axes(plot);
  SbPoint *points[SB_STUDY_SERIES];
  for (size_t s = 0; s < panel->series_count; s++) {
    points[s] = series_points(plot, &panel->series[s]);
  }
  // What was solved lies over what it is compared with.
  static const SbStudyStyle order[] = {SB_STUDY_REFERENCE, SB_STUDY_CURVE, SB_STUDY_DOTS};
  for (size_t k = 0; k < G_N_ELEMENTS(order); k++) {
    for (size_t s = panel->series_count; s-- > 0;) {
      if (panel->series[s].style == order[k]) {
        draw_series(plot, &panel->series[s], points[s]);
      }
    }
  }
  draw_marks(plot);
  if (sb_study_name_series(plot, points, gutter) == 0) {
    const SbTextStyle note = sb_canvas_style(c, SB_TYPE_LABEL, 600, SB_ROLE_SECOND);
    const char *empty = sb_translation(panel->empty);
    double half = fmin(sb_canvas_text_width(c, empty, &note), card.width - 2 * pad) / 2;
    double x = CLAMP(r.x + r.width / 2, card.x + pad + half, card.x + card.width - pad - half);
    sb_canvas_text_fit(c, empty, &note, x - half, r.y + r.height / 2, 2 * half + 1);
  }
  for (size_t s = 0; s < panel->series_count; s++) {
    g_free(points[s]);
  }
}

static void draw_study_panel(SbCanvas *c, SbRect rect, const SbStudy *study, size_t index) {
  const SbStudyPanel *panel = &study->panel[index];
  const bool narrow = rect.width < NARROW;
  const double pad = narrow ? 12 : SB_GRID_PADDING, gutter = gutter_of(c, panel, rect.width);
  sb_canvas_panel(c, rect);
  panel_title(c, rect, pad, &panel->y);
  SbLabels *labels = g_new(SbLabels, 1);
  SbStudyPlot plot = {
      .canvas = c,
      .study = study,
      .panel = panel,
      .labels = labels,
      .at.card = rect,
      .at.plot = {rect.x + pad + 36, rect.y + TITLE,
                  rect.width - 2 * pad - (narrow ? 42 : 30) - gutter,
                  fmax(rect.height - TITLE - FOOT, 20)},
      .x_unit = unit_of(&study->x),
      .x_zero = sb_quantity_to_shown(0, study->x.si, study->x.unit),
      .y_unit = unit_of(&panel->y),
  };
  set_scales(&plot);
  fit_numbers(&plot);
  const SbRect r = plot.at.plot;
  const double right = fmin(r.x + r.width + 12, rect.x + rect.width - 4);
  sb_labels_init(labels, (SbRect){r.x - 2, r.y - 10, right - r.x + 2, r.height + 10});
  draw_plot(&plot, pad, gutter);
  g_free(labels);
}

// ---------------------------------------------------------------------------------------------------
// The whole

void sb_study_draw(cairo_t *cr, SbRect rect, const SbTheme *theme, const SbStudy *study) {
  SbCanvas canvas;
  SbCanvas *c = &canvas;
  sb_canvas_init(c, cr, theme);
  SbStudyLayout layout;
  sb_study_layout(&layout, rect, study);
  for (size_t i = 0; i < study->panel_count; i++) {
    draw_study_panel(c, layout.panel[i], study, i);
  }
  if (layout.table.height > 0) {
    sb_study_table_draw(c, layout.table, study);
  }
  SbTextStyle plain = sb_canvas_style(c, SB_TYPE_LABEL, 400, SB_ROLE_SECOND);
  SbTextStyle bold = sb_canvas_style(c, SB_TYPE_LABEL, 700, SB_ROLE_SECOND);
  double y = layout.notes.y + 12, x = rect.x;
  for (size_t i = 0; i < study->note_count; i++, y += NOTE_LINE) {
    sb_canvas_text_fit(c, sb_translation(study->note[i]), &plain, x, y, rect.width);
  }
  if (study->validity[0] != '\0') {
    double used = sb_canvas_text(c, _("Valid"), &bold, x, y, SB_LEFT) + 8;
    sb_canvas_text_fit(c, sb_translation(study->validity), &plain, x + used, y, rect.width - used);
  }
  sb_canvas_finish(c);
}
