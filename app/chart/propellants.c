// The swap page; propellants.h says what it shows. Between the temperatures of the study values lie
// on straight lines, as the curves are drawn.
#include "app/chart/propellants.h"

#include "app/base/format.h"
#include "app/base/label.h"
#include "app/chart/axis.h"
#include "engine/fluid/fluid.h"

#include <glib.h>
#include <math.h>
#include <string.h>

// A page smaller than this shows one chart.
#define SMALL_WIDTH  1180.0
#define SMALL_HEIGHT 620.0
#define ZERO         273.15
// Least return force that is more than weak where the scene sets no limit [N].
#define WEAK 2.0

enum { BREAKAWAY = 1, RETURN = SB_PROPELLANTS_RETURN, DOSE };

typedef enum { UNKNOWN, STUCK, WEAKLY, RETURNS } Answer;

static const struct {
  SbRole role;
  double width;
  const SbDash *dash;
  bool outlined;
} looks[SB_PROPELLANTS] = {{SB_ROLE_INK, SB_LINE_ACTIVE, NULL, false},
                           {SB_ROLE_VIOLET, 2.0, &sb_dash_pinned, false},
                           {SB_ROLE_OCHRE, 1.8, NULL, true},
                           {SB_ROLE_TEAL, SB_LINE_SEAL, &sb_dash_dimension, false}};

int sb_propellants_fluid(int propellant) {
  return propellant + 1; // they come first behind the fluid without figures
}

const char *sb_propellants_name(int propellant) {
  return sb_fluids[sb_propellants_fluid(propellant)].label;
}

SbPropellantsLook sb_propellants_look(const SbModel *model) {
  return (SbPropellantsLook){.temperature = sb_model_value(model, SB_P_CANISTER_TEMPERATURE),
                             .chart = SB_PROPELLANTS_RETURN};
}

static bool shown(const SbPropellantsLook *look, int propellant) {
  return (look->hidden >> propellant & 1u) == 0;
}

// ---------------------------------------------------------------------------------------------------
// Values

static const SbStudySeries *series_of(const SbStudy *study, int panel, int propellant) {
  for (size_t s = 0; panel < (int)study->panel_count && s < study->panel[panel].series_count; s++) {
    const SbStudySeries *series = &study->panel[panel].series[s];
    if (strcmp(series->name, sb_propellants_name(propellant)) == 0) {
      return series;
    }
  }
  return NULL;
}

static double value_at(const SbStudySeries *series, double T) {
  for (size_t i = 1; series != NULL && i < series->count; i++) {
    const double a = series->x[i - 1], b = series->x[i], slack = 1e-9 * b;
    if (T >= a - slack && T <= b + slack) {
      const double t = fmin(fmax((T - a) / (b - a), 0), 1);
      return (1 - t) * series->y[i - 1] + t * series->y[i];
    }
  }
  return NAN;
}

// Where a series rises through a level; NaN: nowhere.
static double rises_through(const SbStudySeries *series, double level) {
  for (size_t i = 1; series != NULL && i < series->count; i++) {
    const double a = series->y[i - 1] - level, b = series->y[i] - level;
    if (a <= 0 && b > 0) {
      return series->x[i - 1] + (series->x[i] - series->x[i - 1]) * a / (a - b);
    }
  }
  return NAN;
}

static double weak_below(const SbStudy *study) {
  const double limit = study->panel[RETURN].limit_low;
  return isfinite(limit) && limit > 0 ? limit : WEAK;
}

static Answer answer_of(const SbStudy *study, double force) {
  return isnan(force) ? UNKNOWN : force <= 0 ? STUCK : force < weak_below(study) ? WEAKLY : RETURNS;
}

static SbRole role_of(Answer answer) {
  static const SbRole roles[] = {SB_ROLE_THIRD, SB_ROLE_ERROR, SB_ROLE_WARN, SB_ROLE_PASS};
  return roles[answer];
}

// "-1.7 N", "-" where there is none.
static const char *force_text(char *out, double force) {
  return sb_format_text(out, SB_QUANTITY_FORCE, force, 0);
}

// Whole degrees, a tenth where they have one.
static const char *degrees(char *out, double T) {
  const double celsius = T - ZERO;
  return sb_format_fixed(out, celsius, fabs(celsius - round(celsius)) < 0.05 ? 0 : 1);
}

// ---------------------------------------------------------------------------------------------------
// Layout

void sb_propellants_layout(SbPropellantsLayout *out, SbRect rect, const SbPropellantsLook *look) {
  *out = (SbPropellantsLayout){.small = rect.width < SMALL_WIDTH || rect.height < SMALL_HEIGHT};
  const double gap = 16, foot = 26, cards = out->small ? 88 : 184;
  const double charts = fmax(rect.height - cards - gap - foot, 120);
  const int columns = out->small ? 1 : SB_PROPELLANTS_CHARTS;
  const double width = (rect.width - gap * (columns - 1)) / columns;
  for (int i = 0; i < SB_PROPELLANTS_CHARTS; i++) {
    if (out->small && i != look->chart) {
      continue;
    }
    const double x = rect.x + (out->small ? 0 : (width + gap) * i);
    out->chart[i] = (SbRect){x, rect.y, width, charts};
    out->plot[i] = (SbRect){x + 48, rect.y + 62, width - 48 - 106, fmax(charts - 62 - 34, 40)};
  }
  int count = 0;
  for (int k = 0; k < SB_PROPELLANTS; k++) {
    count += shown(look, k);
  }
  const double each = (rect.width - gap * (SB_PROPELLANTS - 1)) / SB_PROPELLANTS;
  double x = rect.x;
  for (int k = 0; k < SB_PROPELLANTS && count > 0; k++) {
    if (shown(look, k)) {
      out->card[k] = (SbRect){x, rect.y + charts + gap, each, cards};
      out->button[k] = (SbRect){x + each - 84, rect.y + charts + gap + 9, 72, 28};
      x += each + gap;
    }
  }
  out->foot = (SbRect){rect.x, rect.y + rect.height - foot, rect.width, foot};
}

double sb_propellants_at(const SbPropellantsLayout *layout, const SbStudy *study, double x,
                         double y) {
  const SbStudySeries *series = series_of(study, 0, 0);
  for (int i = 0; i < SB_PROPELLANTS_CHARTS && series != NULL && series->count > 1; i++) {
    const SbRect r = layout->plot[i];
    if (r.width > 0 && x >= r.x - 12 && x <= r.x + r.width + 12 && y >= r.y - 24 &&
        y <= r.y + r.height + 30) {
      const double lo = series->x[0], hi = series->x[series->count - 1];
      return lo + (hi - lo) * fmin(fmax((x - r.x) / r.width, 0), 1);
    }
  }
  return NAN;
}

// ---------------------------------------------------------------------------------------------------
// A chart

typedef struct {
  SbCanvas *c;
  const SbStudy *study;
  const SbPropellantsLook *look;
  int panel;
  SbRect plot;
  SbScale x, y;
} Chart;

static void scales(Chart *chart) {
  const SbStudyPanel *panel = &chart->study->panel[chart->panel];
  double lo = 0, hi = -INFINITY, from = INFINITY, to = -INFINITY;
  for (int k = 0; k < SB_PROPELLANTS; k++) {
    const SbStudySeries *series = series_of(chart->study, chart->panel, k);
    for (size_t i = 0; series != NULL && i < series->count; i++) {
      from = fmin(from, series->x[i]);
      to = fmax(to, series->x[i]);
      if (isfinite(series->y[i]) && shown(chart->look, k)) {
        lo = fmin(lo, series->y[i]);
        hi = fmax(hi, series->y[i]);
      }
    }
  }
  if (isfinite(panel->limit_high)) {
    hi = fmax(hi, 1.05 * panel->limit_high);
  }
  if (chart->panel == RETURN) {
    hi = fmax(hi, 1.5 * weak_below(chart->study));
  }
  hi = hi > lo ? hi : lo + 1;
  lo = lo < 0 ? lo - 0.04 * (hi - lo) : lo;
  hi += 0.04 * (hi - lo);
  sb_axis_repair(&from, &to);
  const SbRect r = chart->plot;
  chart->x = (SbScale){from - ZERO, to - ZERO, r.x, r.x + r.width, false};
  chart->y = (SbScale){lo, hi, r.y + r.height, r.y, false};
}

static double height_of(const Chart *chart, double value) {
  return sb_axis_at(&chart->y, value);
}

static double place_of(const Chart *chart, double T) {
  return sb_axis_at(&chart->x, T - ZERO);
}

// The ground under the least return: where the stem stays, and where it comes back weakly.
static void draw_regions(const Chart *chart) {
  SbCanvas *c = chart->c;
  const SbRect r = chart->plot;
  const double bottom = r.y + r.height, zero = CLAMP(height_of(chart, 0), r.y, bottom);
  const double weak = CLAMP(height_of(chart, weak_below(chart->study)), r.y, zero);
  sb_canvas_color(c, sb_canvas_role(c, SB_ROLE_WARN_GROUND), 1);
  cairo_rectangle(c->cr, r.x, weak, r.width, zero - weak);
  cairo_fill(c->cr);
  sb_canvas_color(c, sb_canvas_role(c, SB_ROLE_ERROR_GROUND), 1);
  cairo_rectangle(c->cr, r.x, zero, r.width, bottom - zero);
  cairo_fill(c->cr);
  cairo_save(c->cr);
  cairo_rectangle(c->cr, r.x, zero, r.width, bottom - zero);
  cairo_clip(c->cr);
  sb_canvas_pen(c, 0.7, NULL);
  sb_canvas_color(c, sb_canvas_role(c, SB_ROLE_ERROR), 0.35);
  for (double x = r.x - (bottom - zero); x < r.x + r.width; x += 14) {
    cairo_move_to(c->cr, x, bottom);
    cairo_line_to(c->cr, x + bottom - zero, zero);
  }
  cairo_stroke(c->cr);
  cairo_restore(c->cr);
}

// A level across the plot, named at the left over it, or below it where its band is high enough.
static void draw_level(const Chart *chart, double value, const char *text, bool below) {
  SbCanvas *c = chart->c;
  const SbRect r = chart->plot;
  const double y = height_of(chart, value);
  const SbTextStyle style = sb_canvas_style(c, SB_TYPE_LABEL, 600, SB_ROLE_WARN);
  sb_canvas_pen(c, 1.2, &sb_dash_reference);
  sb_canvas_color(c, sb_canvas_role(c, SB_ROLE_WARN), 1);
  cairo_move_to(c->cr, r.x, y);
  cairo_line_to(c->cr, r.x + r.width, y);
  cairo_stroke(c->cr);
  sb_canvas_text(c, text, &style, r.x + 10, below ? y + 17 : y - 6, SB_LEFT);
}

static void draw_curve(const Chart *chart, int k) {
  SbCanvas *c = chart->c;
  const SbStudySeries *series = series_of(chart->study, chart->panel, k);
  SbPoint point[SB_STUDY_POINTS];
  for (size_t i = 0; i < series->count; i++) {
    point[i] = (SbPoint){place_of(chart, series->x[i]), height_of(chart, series->y[i])};
  }
  for (int pass = looks[k].outlined ? 0 : 1; pass < 2; pass++) {
    sb_canvas_pen(c, pass == 0 ? looks[k].width + 1.6 : looks[k].width, looks[k].dash);
    sb_canvas_color(c, sb_canvas_role(c, pass == 0 ? SB_ROLE_INK : looks[k].role), 1);
    sb_canvas_polyline(c, point, series->count);
  }
}

// Propellants that are shown with a value, by the value at T, the largest first.
static int sorted(int out[SB_PROPELLANTS], double value[SB_PROPELLANTS], const Chart *chart,
                  double T) {
  int count = 0;
  for (int k = 0; k < SB_PROPELLANTS; k++) {
    value[k] = value_at(series_of(chart->study, chart->panel, k), T);
    if (!shown(chart->look, k) || isnan(value[k])) {
      continue;
    }
    int at = count++;
    for (; at > 0 && value[out[at - 1]] < value[k]; at--) {
      out[at] = out[at - 1];
    }
    out[at] = k;
  }
  return count;
}

// Names at the curves' right ends, moved apart.
static void name_curves(const Chart *chart) {
  SbCanvas *c = chart->c;
  const double line = 16;
  int order[SB_PROPELLANTS];
  double value[SB_PROPELLANTS], y[SB_PROPELLANTS];
  const int count = sorted(order, value, chart, chart->x.hi + ZERO);
  for (int i = 0; i < count; i++) {
    y[i] = height_of(chart, value[order[i]]);
  }
  for (int round = 0; round < 40; round++) {
    for (int i = 1; i < count; i++) {
      const double lack = line - (y[i] - y[i - 1]);
      y[i] += lack > 0 ? lack / 2 : 0;
      y[i - 1] -= lack > 0 ? lack / 2 : 0;
    }
  }
  const SbTextStyle style = sb_canvas_style(c, SB_TYPE_LABEL, 400, SB_ROLE_INK);
  for (int i = 0; i < count; i++) {
    sb_canvas_text_fit(c, sb_propellants_name(order[i]), &style,
                       chart->plot.x + chart->plot.width + 8, y[i] + 4.3, 100);
  }
}

static void sample(SbCanvas *c, int k, double x, double y, double width) {
  for (int pass = looks[k].outlined ? 0 : 1; pass < 2; pass++) {
    sb_canvas_pen(c, pass == 0 ? looks[k].width + 1.6 : looks[k].width, looks[k].dash);
    sb_canvas_color(c, sb_canvas_role(c, pass == 0 ? SB_ROLE_INK : looks[k].role), 1);
    cairo_move_to(c->cr, x, y);
    cairo_line_to(c->cr, x + width, y);
    cairo_stroke(c->cr);
  }
}

// The cursor with a dot on each curve, and what they are there, in a box on its side with room.
static void draw_cursor(const Chart *chart) {
  SbCanvas *c = chart->c;
  const SbRect r = chart->plot;
  const double T = chart->look->temperature;
  int order[SB_PROPELLANTS];
  double value[SB_PROPELLANTS];
  const int count = sorted(order, value, chart, T);
  if (!(T - ZERO >= chart->x.lo - 1e-6 && T - ZERO <= chart->x.hi + 1e-6)) {
    return;
  }
  char text[SB_FORMAT_MAX];
  const double x = floor(place_of(chart, T)) + 0.5;
  const SbTextStyle bold = sb_canvas_style(c, SB_TYPE_LABEL, 700, SB_ROLE_INK);
  const SbTextStyle plain = sb_canvas_style(c, SB_TYPE_LABEL, 400, SB_ROLE_INK);
  sb_canvas_hairline(c, x, r.y, x, r.y + r.height, sb_canvas_role(c, SB_ROLE_SECOND));
  g_autofree char *title = g_strdup_printf("%s \xc2\xb0"
                                           "C",
                                           degrees(text, T));
  sb_canvas_text(c, title, &bold, x, r.y - 8, SB_MIDDLE);
  for (int i = 0; i < count; i++) {
    const double y = height_of(chart, value[order[i]]);
    sb_canvas_dot(c, x, y, 4.6, sb_canvas_role(c, SB_ROLE_PANEL));
    sb_canvas_dot(c, x, y, 4.0, sb_canvas_role(c, SB_ROLE_INK));
    sb_canvas_dot(c, x, y, 3.0, sb_canvas_role(c, looks[order[i]].role));
  }
  if (count == 0) {
    return;
  }
  const double width = 188, line = 20, height = 12 + line * count;
  double left = x - 8 - width;
  left = left < r.x - 10 ? x + 8 : left;
  const SbRect box = {left, r.y + 8, width, height};
  sb_canvas_rounded(c, box, 4);
  sb_canvas_color(c, sb_canvas_role(c, SB_ROLE_PANEL), 0.94);
  cairo_fill(c->cr);
  sb_canvas_rounded(c, box, 4);
  sb_canvas_pen(c, 1, NULL);
  sb_canvas_color(c, sb_canvas_role(c, SB_ROLE_HAIRLINE), 1);
  cairo_stroke(c->cr);
  for (int i = 0; i < count; i++) {
    const double y = box.y + 6 + line * i + 14;
    sample(c, order[i], box.x + 8, y - 4, 20);
    sb_canvas_text(c, sb_propellants_name(order[i]), &plain, box.x + 34, y, SB_LEFT);
    SbTextStyle style = bold;
    const Answer answer = answer_of(chart->study, value[order[i]]);
    if (chart->panel == RETURN && answer != RETURNS) {
      style.color = sb_canvas_role(c, role_of(answer));
    }
    sb_canvas_text(c, force_text(text, value[order[i]]), &style, box.x + width - 8, y, SB_RIGHT);
  }
}

// Rings where the return begins; their temperatures in turn above and below the line.
static void draw_begins(const Chart *chart) {
  SbCanvas *c = chart->c;
  const SbTextStyle style = sb_canvas_style(c, SB_TYPE_LABEL, 700, SB_ROLE_ERROR);
  const double y = height_of(chart, 0);
  double at[SB_PROPELLANTS];
  int count = 0;
  for (int k = 0; k < SB_PROPELLANTS; k++) {
    const double T = rises_through(series_of(chart->study, RETURN, k), 0);
    if (shown(chart->look, k) && isfinite(T)) {
      int i = count++;
      for (; i > 0 && at[i - 1] > T; i--) {
        at[i] = at[i - 1];
      }
      at[i] = T;
    }
  }
  for (int i = 0; i < count; i++) {
    const double x = place_of(chart, at[i]);
    sb_canvas_dot(c, x, y, 4.6, sb_canvas_role(c, SB_ROLE_ERROR));
    sb_canvas_dot(c, x, y, 3.2, sb_canvas_role(c, SB_ROLE_PANEL));
    char text[SB_FORMAT_MAX];
    g_autofree char *label = g_strdup_printf("%s%s", sb_format_fixed(text, at[i] - ZERO, 0),
                                             i == count - 1 ? " \xc2\xb0"
                                                              "C"
                                                            : "");
    sb_canvas_text_halo(c, label, &style, x, i % 2 == 0 ? y - 9 : y + 19, SB_MIDDLE);
  }
}

static void draw_chart(SbCanvas *c, const SbPropellantsLayout *layout, const SbStudy *study,
                       const SbModel *model, const SbPropellantsLook *look, int panel) {
  static const char *const titles[] = {"Pressure force", "Break-away", "Least return"};
  char number[SB_FORMAT_MAX];
  const SbRect card = layout->chart[panel];
  sb_canvas_panel(c, card);
  Chart chart = {.c = c, .study = study, .look = look, .panel = panel, .plot = layout->plot[panel]};
  scales(&chart);
  const SbRect r = chart.plot;
  const SbTextStyle title = sb_canvas_style(c, SB_TYPE_PANEL_WINDOW, 700, SB_ROLE_INK);
  const SbTextStyle note = sb_canvas_style(c, SB_TYPE_NOTE, 400, SB_ROLE_SECOND);
  const SbTextStyle label = sb_canvas_style(c, SB_TYPE_LABEL, 400, SB_ROLE_SECOND);
  g_autofree char *land = g_strdup_printf(
      "gauge pressure on the stem's %s mm",
      sb_format_fixed(number, 1e3 * sb_model_value(model, SB_P_STEM_PRESSURE_DIAMETER), 3));
  const char *const notes[] = {land, "first slip, in-stroke", "pressure force minus friction"};
  const double used = sb_canvas_text(c, titles[panel], &title, card.x + 20, card.y + 27, SB_LEFT);
  sb_canvas_text_fit(c, notes[panel], &note, card.x + 30 + used, card.y + 27,
                     card.width - 50 - used);
  sb_canvas_text(c, "N", &label, r.x - 8, r.y - 8, SB_RIGHT);
  if (panel == RETURN) {
    draw_regions(&chart);
  }
  SbTicks x, y;
  sb_axis_ticks(&x, chart.x.lo, chart.x.hi, (int)CLAMP(r.width / 55, 3, 8));
  sb_axis_ticks(&y, chart.y.lo, chart.y.hi, (int)CLAMP(r.height / 60, 3, 8));
  sb_axis_draw(c, r, &chart.x, &x, &chart.y, &y);
  sb_canvas_text(c,
                 "\xc2\xb0"
                 "C",
                 &label, r.x + r.width + 12, r.y + r.height + 18, SB_LEFT);
  const double limit = study->panel[panel].limit_high;
  if (isfinite(limit)) {
    g_autofree char *text =
        g_strdup_printf("limit %s", sb_format_given(number, SB_QUANTITY_FORCE, limit));
    draw_level(&chart, limit, text, false);
  }
  if (panel == RETURN) {
    const double weak = weak_below(study), zero = height_of(&chart, 0);
    g_autofree char *text =
        g_strdup_printf("returns under %s", sb_format_given(number, SB_QUANTITY_FORCE, weak));
    draw_level(&chart, weak, text, zero - height_of(&chart, weak) > 22);
    sb_canvas_pen(c, 1.6, NULL);
    sb_canvas_color(c, sb_canvas_role(c, SB_ROLE_ERROR), 1);
    cairo_move_to(c->cr, r.x, zero);
    cairo_line_to(c->cr, r.x + r.width, zero);
    cairo_stroke(c->cr);
    if (r.y + r.height - zero > 40) {
      const SbTextStyle style = sb_canvas_style(c, SB_TYPE_LABEL, 700, SB_ROLE_ERROR);
      sb_canvas_text_plate(c, "stem does not return", &style, r.x + r.width - 12,
                           r.y + r.height - 14, SB_RIGHT, sb_canvas_role(c, SB_ROLE_ERROR_GROUND));
    }
  }
  for (int k = SB_PROPELLANTS - 1; k >= 0; k--) {
    if (shown(look, k) && series_of(study, panel, k) != NULL) {
      draw_curve(&chart, k);
    }
  }
  name_curves(&chart);
  if (panel == RETURN) {
    draw_begins(&chart);
  }
  draw_cursor(&chart);
}

// ---------------------------------------------------------------------------------------------------
// Cards

// A tick, a triangle, a cross or a dash, 12 px high on the baseline.
static void draw_sign(SbCanvas *c, Answer answer, double x, double y) {
  cairo_t *cr = c->cr;
  sb_canvas_pen(c, 2, NULL);
  sb_canvas_color(c, sb_canvas_role(c, role_of(answer)), 1);
  if (answer == RETURNS) {
    cairo_move_to(cr, x, y - 5);
    cairo_line_to(cr, x + 4, y - 1);
    cairo_line_to(cr, x + 11, y - 9);
  } else if (answer == STUCK) {
    cairo_move_to(cr, x + 1, y - 9);
    cairo_line_to(cr, x + 10, y);
    cairo_move_to(cr, x + 10, y - 9);
    cairo_line_to(cr, x + 1, y);
  } else if (answer == WEAKLY) {
    cairo_move_to(cr, x + 5.5, y - 10);
    cairo_line_to(cr, x + 11, y);
    cairo_line_to(cr, x, y);
    cairo_close_path(cr);
    cairo_move_to(cr, x + 5.5, y - 6.5);
    cairo_line_to(cr, x + 5.5, y - 2.5);
  } else {
    cairo_move_to(cr, x, y - 4);
    cairo_line_to(cr, x + 11, y - 4);
  }
  cairo_stroke(cr);
}

static char *answer_text(const SbStudy *study, int k, double T, double gauge) {
  char force[SB_FORMAT_MAX], at[SB_FORMAT_MAX];
  const double value = value_at(series_of(study, RETURN, k), T);
  force_text(force, value);
  degrees(at, T);
  if (gauge <= 0) {
    return g_strdup_printf("delivers nothing at %s \xc2\xb0"
                           "C: below ambient",
                           at);
  }
  switch (answer_of(study, value)) {
  case STUCK:
    return g_strdup_printf("does not return, %s at %s \xc2\xb0"
                           "C",
                           force, at);
  case WEAKLY:
    return g_strdup_printf("returns weakly, %s at %s \xc2\xb0"
                           "C",
                           force, at);
  case RETURNS:
    return g_strdup_printf("returns with %s at %s \xc2\xb0"
                           "C",
                           force, at);
  default:
    return g_strdup_printf("no value at %s \xc2\xb0"
                           "C",
                           at);
  }
}

// "from 14 degC, 2 N from 19 degC".
static char *range_text(const SbStudy *study, int k) {
  const SbStudySeries *series = series_of(study, RETURN, k);
  char from[SB_FORMAT_MAX], limit[SB_FORMAT_MAX], full[SB_FORMAT_MAX];
  const double weak = weak_below(study);
  const double begins = rises_through(series, 0), enough = rises_through(series, weak);
  const bool always = series != NULL && series->count > 0 && series->y[0] > 0;
  if (isnan(begins) && !always) {
    return g_strdup("returns nowhere");
  }
  g_autofree char *first = always ? g_strdup("returns everywhere")
                                  : g_strdup_printf("from %s \xc2\xb0"
                                                    "C",
                                                    sb_format_fixed(from, begins - ZERO, 0));
  if (isnan(enough)) {
    return g_steal_pointer(&first);
  }
  return g_strdup_printf("%s, %s from %s \xc2\xb0"
                         "C",
                         first, sb_format_given(limit, SB_QUANTITY_FORCE, weak),
                         sb_format_fixed(full, enough - ZERO, 0));
}

// The scale of temperature: red, amber, green, the cursor, and its ends.
static void draw_strip(SbCanvas *c, SbRect r, const SbStudy *study, int k, double T) {
  static const double strength[] = {0.15, 0.28, 0.5, 0.5};
  const SbStudySeries *series = series_of(study, RETURN, k);
  const int steps = 280;
  if (series == NULL || series->count < 2) {
    return;
  }
  const double lo = series->x[0], hi = series->x[series->count - 1];
  for (int i = 0, from = 0; i < steps; i++) {
    const Answer now = answer_of(study, value_at(series, lo + (hi - lo) * (i + 0.5) / steps));
    const Answer then =
        i + 1 < steps ? answer_of(study, value_at(series, lo + (hi - lo) * (i + 1.5) / steps)) : 0;
    if (i + 1 == steps || then != now) {
      sb_canvas_color(c, sb_canvas_role(c, role_of(now)), strength[now]);
      cairo_rectangle(c->cr, r.x + r.width * from / steps, r.y, r.width * (i + 1 - from) / steps,
                      8);
      cairo_fill(c->cr);
      from = i + 1;
    }
  }
  char text[SB_FORMAT_MAX];
  const SbTextStyle note = sb_canvas_style(c, SB_TYPE_NOTE, 400, SB_ROLE_SECOND);
  const SbTextStyle bold = sb_canvas_style(c, SB_TYPE_NOTE, 600, SB_ROLE_INK);
  const double x = r.x + r.width * (T - lo) / (hi - lo);
  if (x >= r.x - 1 && x <= r.x + r.width + 1) {
    sb_canvas_color(c, sb_canvas_role(c, SB_ROLE_INK), 1);
    cairo_rectangle(c->cr, x - 1, r.y - 4, 2, 16);
    cairo_fill(c->cr);
  }
  const double base = r.y + 24;
  const double left = sb_canvas_text(c, degrees(text, lo), &note, r.x, base, SB_LEFT);
  g_autofree char *end = g_strdup_printf("%s \xc2\xb0"
                                         "C",
                                         degrees(text, hi));
  const double right = sb_canvas_text(c, end, &note, r.x + r.width, base, SB_RIGHT);
  g_autofree char *range = range_text(study, k);
  const double room = r.width - left - right - 16;
  const double width = fmin(sb_canvas_text_width(c, range, &bold), room);
  sb_canvas_text_fit(c, range, &bold, r.x + left + 8 + (room - width) / 2, base, width + 1);
}

// A figure under its name; its unit smaller.
static void draw_figure(SbCanvas *c, const char *name, const char *number, const char *unit,
                        double x, double y) {
  const SbTextStyle note = sb_canvas_style(c, SB_TYPE_NOTE, 400, SB_ROLE_SECOND);
  const SbTextStyle value = sb_canvas_style(c, SB_TYPE_PANEL, 600, SB_ROLE_INK);
  sb_canvas_text(c, name, &note, x, y, SB_LEFT);
  const double used = sb_canvas_text(c, number, &value, x, y + 20, SB_LEFT);
  sb_canvas_text(c, unit, &note, x + used + 4, y + 20, SB_LEFT);
}

static bool state_of(SbFluidState *out, const SbModel *model, int k, double T) {
  return sb_fluid_state(out, NULL, &sb_fluids[sb_propellants_fluid(k)], T,
                        sb_model_value(model, SB_P_FLUID_ETHANOL), NULL) == SB_OK;
}

static double gauge_of(const SbFluidState *state, const SbModel *model) {
  return state->figure[SB_FLUID_PRESSURE].value -
         sb_model_value(model, SB_P_CANISTER_AMBIENT_PRESSURE);
}

static void draw_card(SbCanvas *c, const SbPropellantsLayout *layout, const SbStudy *study,
                      const SbModel *model, const SbPropellantsLook *look, int k) {
  const SbRect card = layout->card[k];
  const double T = look->temperature, x = card.x + 16, width = card.width - 32;
  const bool own = sb_model_number(model, SB_P_FLUID_NAME) == sb_propellants_fluid(k);
  sb_canvas_panel(c, card);
  if (own) {
    sb_canvas_rounded(c, card, SB_GRID_RADIUS);
    sb_canvas_pen(c, 1.6, NULL);
    sb_canvas_color(c, sb_canvas_role(c, SB_ROLE_INK), 1);
    cairo_stroke(c->cr);
  }
  const SbTextStyle title = sb_canvas_style(c, SB_TYPE_PANEL_WINDOW, 700, SB_ROLE_INK);
  const SbTextStyle note = sb_canvas_style(c, SB_TYPE_NOTE, 400, SB_ROLE_SECOND);
  const double line = layout->small ? 18 : 34;
  sample(c, k, x, card.y + 24, line);
  sb_canvas_text_fit(c, sb_propellants_name(k), &title, x + line + 8, card.y + 29,
                     width - line - 8 - (layout->small && own ? 0 : 76));
  if (own && !layout->small) {
    sb_canvas_text(c, "in this design", &note, x + width, card.y + 28, SB_RIGHT);
  }
  if (layout->small) {
    draw_strip(c, (SbRect){x, card.y + 50, width, 8}, study, k, T);
    return;
  }
  char number[SB_FORMAT_MAX];
  SbFluidState state;
  const bool known = state_of(&state, model, k, T);
  const double gauge = known ? gauge_of(&state, model) : NAN;
  const struct {
    const char *name, *unit;
    double value, at;
    int decimals; // -1: three digits
  } figures[] = {
      {"gauge pressure", "MPa", 1e-6 * gauge, 0, 2},
      {"density", "kg/m\xc2\xb3", known ? state.figure[SB_FLUID_LIQUID].value : NAN, 0.26, 0},
      {"viscosity", "mPa s", known ? 1e3 * state.figure[SB_FLUID_VISCOSITY].value : NAN, 0.53, 3},
      {"GWP", "", known ? state.figure[SB_FLUID_GWP].value : NAN, 0.82, -1}};
  for (size_t i = 0; i < G_N_ELEMENTS(figures); i++) {
    const double value = figures[i].value;
    if (isnan(value)) {
      g_strlcpy(number, "\xe2\x80\x93", sizeof number);
    } else if (figures[i].decimals < 0) {
      sb_format_fixed(number, value, value < 10 ? 1 : 0);
    } else {
      sb_format_fixed(number, value, figures[i].decimals);
    }
    draw_figure(c, figures[i].name, number, figures[i].unit, x + figures[i].at * width,
                card.y + 54);
  }
  sb_canvas_hairline(c, x, card.y + 92, x + width, card.y + 92,
                     sb_canvas_role(c, SB_ROLE_HAIRLINE));
  const double force = value_at(series_of(study, RETURN, k), T);
  const Answer answer = gauge <= 0 ? STUCK : answer_of(study, force);
  SbTextStyle verdict = sb_canvas_style(c, SB_TYPE_LABEL, 600, role_of(answer));
  g_autofree char *text = answer_text(study, k, T, gauge);
  draw_sign(c, answer, x, card.y + 117);
  const double dose = value_at(series_of(study, DOSE, k), T);
  double used = 0;
  if (isfinite(dose)) {
    g_autofree char *mass = g_strdup_printf("dose %s mg", sb_format_digits(number, 1e6 * dose, 3));
    used = sb_canvas_text(c, mass, &note, x + width, card.y + 116, SB_RIGHT) + 8;
  }
  sb_canvas_text_fit(c, text, &verdict, x + 20, card.y + 117, width - 20 - used);
  draw_strip(c, (SbRect){x, card.y + 140, width, 8}, study, k, T);
}

// ---------------------------------------------------------------------------------------------------
// The whole

static void draw_foot(SbCanvas *c, SbRect r, const SbStudy *study) {
  const SbTextStyle plain = sb_canvas_style(c, SB_TYPE_NOTE, 400, SB_ROLE_SECOND);
  const SbTextStyle bold = sb_canvas_style(c, SB_TYPE_NOTE, 700, SB_ROLE_SECOND);
  const SbTextStyle warn = sb_canvas_style(c, SB_TYPE_NOTE, 700, SB_ROLE_WARN);
  const char *const texts[][2] = {{"Pressure", "saturated at the canister's temperature"},
                                  {"Friction", study->models},
                                  {"Left out", "swell by another propellant, cooling as it boils"}};
  const double y = r.y + 20;
  double x = r.x, end = r.x + r.width;
  if (study->warnings.count > 0) {
    g_autofree char *text = g_strdup_printf("%zu warning%s", study->warnings.count,
                                            study->warnings.count == 1 ? "" : "s");
    end -= sb_canvas_text(c, text, &warn, end, y, SB_RIGHT) + 16;
  }
  for (size_t i = 0; i < G_N_ELEMENTS(texts) && x < end - 80; i++) {
    x += sb_canvas_text(c, texts[i][0], &bold, x, y, SB_LEFT) + 8;
    x += sb_canvas_text_fit(c, texts[i][1], &plain, x, y, fmax(end - x, 1)) + 24;
  }
}

void sb_propellants_draw(cairo_t *cr, SbRect rect, const SbTheme *theme, const SbStudy *study,
                         const SbModel *model, const SbPropellantsLook *look) {
  SbCanvas canvas;
  SbPropellantsLayout layout;
  sb_canvas_init(&canvas, cr, theme);
  sb_propellants_layout(&layout, rect, look);
  for (int i = 0; i < SB_PROPELLANTS_CHARTS; i++) {
    if (layout.chart[i].width > 0 && i < (int)study->panel_count) {
      draw_chart(&canvas, &layout, study, model, look, i);
    }
  }
  for (int k = 0; k < SB_PROPELLANTS; k++) {
    if (layout.card[k].width > 0) {
      draw_card(&canvas, &layout, study, model, look, k);
    }
  }
  draw_foot(&canvas, layout.foot, study);
  sb_canvas_finish(&canvas);
}

char *sb_propellants_text(const SbStudy *study, const SbModel *model,
                          const SbPropellantsLook *look) {
  GString *out = g_string_new(NULL);
  for (int k = 0; k < SB_PROPELLANTS; k++) {
    if (shown(look, k)) {
      SbFluidState state;
      const bool known = state_of(&state, model, k, look->temperature);
      g_autofree char *answer =
          answer_text(study, k, look->temperature, known ? gauge_of(&state, model) : NAN);
      g_autofree char *range = range_text(study, k);
      g_string_append_printf(out, "%s: %s; %s.\n", sb_propellants_name(k), answer, range);
    }
  }
  return g_string_free(out, FALSE);
}
