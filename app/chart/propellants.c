// The swap page; propellants.h says what it shows. Between the temperatures of the study values lie
// on straight lines, as the curves are drawn.
#include "app/base/figure_text.h"
#include "app/base/translation.h"
#include "app/chart/propellants_private.h"
#include "app/draw/axis.h"
#include "app/draw/frame.h"
#include "app/draw/label.h"
#include "engine/fluid/fluid.h"

#include <glib/gi18n.h>
#include <math.h>
#include <string.h>

// A page smaller than this shows one chart.
#define SMALL_WIDTH  1180.0
#define SMALL_HEIGHT 620.0
// Return margin that is more than weak where the scene sets no limit [N].
#define WEAK 2.0

enum { RETURN = SB_PROPELLANTS_RETURN };

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

const SbStudySeries *sb_propellants_series(const SbStudy *study, int panel, int propellant) {
  for (size_t s = 0; panel < (int)study->panel_count && s < study->panel[panel].series_count; s++) {
    const SbStudySeries *series = &study->panel[panel].series[s];
    if (strcmp(series->name, sb_propellants_name(propellant)) == 0) {
      return series;
    }
  }
  return NULL;
}

double sb_propellants_value(const SbStudySeries *series, double T) {
  for (size_t i = 1; series != NULL && i < series->count; i++) {
    const double a = series->x[i - 1], b = series->x[i], slack = 1e-9 * b;
    if (T >= a - slack && T <= b + slack) {
      const double t = fmin(fmax((T - a) / (b - a), 0), 1);
      return (1 - t) * series->y[i - 1] + t * series->y[i];
    }
  }
  return NAN;
}

double sb_propellants_rises(const SbStudySeries *series, double level) {
  for (size_t i = 1; series != NULL && i < series->count; i++) {
    const double a = series->y[i - 1] - level, b = series->y[i] - level;
    if (a <= 0 && b > 0) {
      return series->x[i - 1] + (series->x[i] - series->x[i - 1]) * a / (a - b);
    }
  }
  return NAN;
}

double sb_propellants_weak_below(const SbStudy *study) {
  const double limit = study->panel[RETURN].limit_low;
  return isfinite(limit) && limit > 0 ? limit : WEAK;
}

SbPropellantsAnswer sb_propellants_answer(const SbStudy *study, double force) {
  return isnan(force)                               ? SB_PROPELLANT_UNKNOWN
         : force <= 0                               ? SB_PROPELLANT_STUCK
         : force < sb_propellants_weak_below(study) ? SB_PROPELLANT_WEAKLY
                                                    : SB_PROPELLANT_RETURNS;
}

SbRole sb_propellants_role(SbPropellantsAnswer answer) {
  static const SbRole roles[] = {SB_ROLE_THIRD, SB_ROLE_ERROR, SB_ROLE_WARN, SB_ROLE_PASS};
  return roles[answer];
}

const char *sb_propellants_force(char *out, const SbStudy *study, int panel, double force) {
  static const char *const paths[SB_PROPELLANTS_CHARTS] = {
      "cycle.pressure_force_N", "cycle.force_breakaway_N", "cycle.force_return_margin_N"};
  return sb_figure_text(out, sb_figure_find(paths[panel]), force, study->error);
}

const char *sb_propellants_degrees(char *out, double T) {
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
  const SbStudySeries *series = sb_propellants_series(study, 0, 0);
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
  SbAxes at;
} Chart;

static void scales(Chart *chart) {
  const SbStudyPanel *panel = &chart->study->panel[chart->panel];
  double lo = 0, hi = -INFINITY, from = INFINITY, to = -INFINITY;
  for (int k = 0; k < SB_PROPELLANTS; k++) {
    const SbStudySeries *series = sb_propellants_series(chart->study, chart->panel, k);
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
    hi = fmax(hi, 1.5 * sb_propellants_weak_below(chart->study));
  }
  hi = hi > lo ? hi : lo + 1;
  lo = lo < 0 ? lo - 0.04 * (hi - lo) : lo;
  hi += 0.04 * (hi - lo);
  sb_axis_repair(&from, &to);
  const SbRect r = chart->at.plot;
  sb_axes_linear(&chart->at, r, from - ZERO, to - ZERO, lo, hi);
  sb_axes_ticks(&chart->at, (int)CLAMP(r.width / 55, 3, 8), (int)CLAMP(r.height / 60, 3, 8));
}

static double height_of(const Chart *chart, double value) {
  return sb_axis_at(&chart->at.y, value);
}

static double place_of(const Chart *chart, double T) {
  return sb_axis_at(&chart->at.x, T - ZERO);
}

// The ground under the return margin: where the stem stays, and where it comes back weakly.
static void draw_regions(const Chart *chart) {
  SbCanvas *c = chart->c;
  const SbRect r = chart->at.plot;
  const double bottom = r.y + r.height, zero = CLAMP(height_of(chart, 0), r.y, bottom);
  const double weak = CLAMP(height_of(chart, sb_propellants_weak_below(chart->study)), r.y, zero);
  sb_canvas_fill(c, (SbRect){r.x, weak, r.width, zero - weak}, SB_ROLE_WARN_GROUND, 1);
  sb_canvas_fill(c, (SbRect){r.x, zero, r.width, bottom - zero}, SB_ROLE_ERROR_GROUND, 1);
  sb_canvas_hatch(c, (SbRect){r.x, zero, r.width, bottom - zero}, 14, false, SB_ROLE_ERROR, 0.35);
}

// A level across the plot, named at the left over it, or below it where its band is high enough.
static void draw_level(const Chart *chart, double value, const char *text, bool below) {
  SbCanvas *c = chart->c;
  const SbRect r = chart->at.plot;
  const double y = height_of(chart, value);
  const SbTextStyle style = sb_canvas_style(c, SB_TYPE_LABEL, 600, SB_ROLE_WARN);
  sb_canvas_line(c, (SbStroke){SB_ROLE_WARN, 1.2, &sb_dash_reference}, r.x, y, r.x + r.width, y);
  sb_canvas_text(c, text, &style, r.x + 10, below ? y + 17 : y - 6, SB_LEFT);
}

static void draw_propellants_curve(const Chart *chart, int k) {
  SbCanvas *c = chart->c;
  const SbStudySeries *series = sb_propellants_series(chart->study, chart->panel, k);
  SbPoint point[SB_STUDY_POINTS];
  for (size_t i = 0; i < series->count; i++) {
    point[i] = sb_axes_at(&chart->at, series->x[i] - ZERO, series->y[i]);
  }
  for (int pass = looks[k].outlined ? 0 : 1; pass < 2; pass++) {
    sb_canvas_curve(c,
                    (SbStroke){pass == 0 ? SB_ROLE_INK : looks[k].role,
                               pass == 0 ? looks[k].width + 1.6 : looks[k].width, looks[k].dash},
                    point, series->count);
  }
}

// Propellants that are shown with a value, by the value at T, the largest first.
static int sorted(int out[SB_PROPELLANTS], double value[SB_PROPELLANTS], const Chart *chart,
                  double T) {
  int count = 0;
  for (int k = 0; k < SB_PROPELLANTS; k++) {
    value[k] = sb_propellants_value(sb_propellants_series(chart->study, chart->panel, k), T);
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
  int order[SB_PROPELLANTS];
  double value[SB_PROPELLANTS], y[SB_PROPELLANTS];
  const int count = sorted(order, value, chart, chart->at.x.hi + ZERO);
  for (int i = 0; i < count; i++) {
    y[i] = height_of(chart, value[order[i]]);
  }
  sb_labels_spread(y, count, 16, -INFINITY, INFINITY);
  const SbTextStyle style = sb_canvas_style(c, SB_TYPE_LABEL, 400, SB_ROLE_INK);
  for (int i = 0; i < count; i++) {
    sb_canvas_text_fit(c, sb_propellants_name(order[i]), &style,
                       chart->at.plot.x + chart->at.plot.width + 8, y[i] + 4.3, 100);
  }
}

void sb_propellants_sample(SbCanvas *c, int k, double x, double y, double width) {
  for (int pass = looks[k].outlined ? 0 : 1; pass < 2; pass++) {
    sb_canvas_line(c,
                   (SbStroke){pass == 0 ? SB_ROLE_INK : looks[k].role,
                              pass == 0 ? looks[k].width + 1.6 : looks[k].width, looks[k].dash},
                   x, y, x + width, y);
  }
}

// The cursor with a dot on each curve, and what they are there, in a box on its side with room.
static void draw_cursor(const Chart *chart) {
  SbCanvas *c = chart->c;
  const SbRect r = chart->at.plot;
  const double T = chart->look->temperature;
  int order[SB_PROPELLANTS];
  double value[SB_PROPELLANTS];
  const int count = sorted(order, value, chart, T);
  if (!(T - ZERO >= chart->at.x.lo - 1e-6 && T - ZERO <= chart->at.x.hi + 1e-6)) {
    return;
  }
  char text[SB_FORMAT_MAX];
  const double x = floor(place_of(chart, T)) + 0.5;
  const SbTextStyle bold = sb_canvas_style(c, SB_TYPE_LABEL, 700, SB_ROLE_INK);
  const SbTextStyle plain = sb_canvas_style(c, SB_TYPE_LABEL, 400, SB_ROLE_INK);
  sb_canvas_hairline(c, x, r.y, x, r.y + r.height, sb_canvas_role(c, SB_ROLE_SECOND));
  g_autofree char *title = g_strdup_printf("%s °C", sb_propellants_degrees(text, T));
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
    sb_propellants_sample(c, order[i], box.x + 8, y - 4, 20);
    sb_canvas_text(c, sb_propellants_name(order[i]), &plain, box.x + 34, y, SB_LEFT);
    SbTextStyle style = bold;
    const SbPropellantsAnswer answer = sb_propellants_answer(chart->study, value[order[i]]);
    if (chart->panel == RETURN && answer != SB_PROPELLANT_RETURNS) {
      style.color = sb_canvas_role(c, sb_propellants_role(answer));
    }
    sb_canvas_text(c, sb_propellants_force(text, chart->study, chart->panel, value[order[i]]),
                   &style, box.x + width - 8, y, SB_RIGHT);
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
    const double T = sb_propellants_rises(sb_propellants_series(chart->study, RETURN, k), 0);
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
                                             i == count - 1 ? " °C" : "");
    sb_canvas_text_halo(c, label, &style, x, i % 2 == 0 ? y - 9 : y + 19, SB_MIDDLE);
  }
}

static void draw_chart(SbCanvas *c, const SbPropellantsLayout *layout, const SbStudy *study,
                       const SbModel *model, const SbPropellantsLook *look, int panel) {
  static const char *const titles[] = {N_("Pressure force"), N_("Break-away"), N_("Return margin")};
  char number[SB_FORMAT_MAX];
  const SbRect card = layout->chart[panel];
  sb_canvas_panel(c, card);
  Chart chart = {
      .c = c, .study = study, .look = look, .panel = panel, .at.plot = layout->plot[panel]};
  scales(&chart);
  const SbRect r = chart.at.plot;
  const SbTextStyle label = sb_canvas_style(c, SB_TYPE_LABEL, 400, SB_ROLE_SECOND);
  g_autofree char *land = g_strdup_printf(
      _("gauge pressure on the stem's %s mm"),
      sb_format_fixed(number, 1e3 * sb_model_value(model, SB_P_STEM_PRESSURE_DIAMETER), 3));
  const char *const notes[] = {land, _("first slip, in-stroke"),
                               _("pressure force minus friction")};
  sb_frame_title(c, (SbRect){card.x + 20, card.y + 13, card.width - 40, 0}, SB_TYPE_PANEL_WINDOW,
                 _(titles[panel]), notes[panel]);
  sb_canvas_text(c, "N", &label, r.x - 8, r.y - 8, SB_RIGHT);
  if (panel == RETURN) {
    draw_regions(&chart);
  }
  sb_axes_draw(c, &chart.at, NULL);
  sb_canvas_text(c, "°C", &label, r.x + r.width + 12, r.y + r.height + 18, SB_LEFT);
  const double limit = study->panel[panel].limit_high;
  if (isfinite(limit)) {
    g_autofree char *text =
        g_strdup_printf(_("limit %s"), sb_format_given(number, SB_QUANTITY_FORCE, limit));
    draw_level(&chart, limit, text, false);
  }
  if (panel == RETURN) {
    const double weak = sb_propellants_weak_below(study), zero = height_of(&chart, 0);
    g_autofree char *text =
        g_strdup_printf(_("returns under %s"), sb_format_given(number, SB_QUANTITY_FORCE, weak));
    draw_level(&chart, weak, text, zero - height_of(&chart, weak) > 22);
    sb_canvas_line(c, (SbStroke){SB_ROLE_ERROR, 1.6, NULL}, r.x, zero, r.x + r.width, zero);
    if (r.y + r.height - zero > 40) {
      const SbTextStyle style = sb_canvas_style(c, SB_TYPE_LABEL, 700, SB_ROLE_ERROR);
      sb_canvas_text_plate(c, _("stem does not return"), &style, r.x + r.width - 12,
                           r.y + r.height - 14, SB_RIGHT, sb_canvas_role(c, SB_ROLE_ERROR_GROUND));
    }
  }
  for (int k = SB_PROPELLANTS - 1; k >= 0; k--) {
    if (shown(look, k) && sb_propellants_series(study, panel, k) != NULL) {
      draw_propellants_curve(&chart, k);
    }
  }
  name_curves(&chart);
  if (panel == RETURN) {
    draw_begins(&chart);
  }
  draw_cursor(&chart);
}

// ---------------------------------------------------------------------------------------------------
// The whole

char *sb_propellants_modulus(const SbModel *model, double T) {
  SbModulusChange modulus;
  char number[SB_FORMAT_MAX], degrees[SB_FORMAT_MAX];
  sb_model_modulus(&modulus, model, T);
  const double change = 100 * (modulus.factor - 1);
  return g_strdup_printf(_("%s%s %% at %s °C against 20 °C (%s)"), change > 0 ? "+" : "",
                         sb_format_fixed(number, change, 1), sb_propellants_degrees(degrees, T),
                         sb_translation(modulus.tag));
}

static void draw_foot(SbCanvas *c, SbRect r, const SbStudy *study, const SbModel *model, double T) {
  const SbTextStyle plain = sb_canvas_style(c, SB_TYPE_NOTE, 400, SB_ROLE_SECOND);
  const SbTextStyle bold = sb_canvas_style(c, SB_TYPE_NOTE, 700, SB_ROLE_SECOND);
  const SbTextStyle warn = sb_canvas_style(c, SB_TYPE_NOTE, 700, SB_ROLE_WARN);
  g_autofree char *modulus = sb_propellants_modulus(model, T);
  const char *const texts[][2] = {
      {_("Pressure"), _("saturated at the canister's temperature")},
      {_("Modulus"), modulus},
      {_("Friction"), study->models},
      {_("Left out"), _("swell by another propellant, cooling as it boils")}};
  const double y = r.y + 20;
  double x = r.x, end = r.x + r.width;
  if (study->warnings.count > 0) {
    g_autofree char *text = g_strdup_printf(
        ngettext("%zu warning", "%zu warnings", study->warnings.count), study->warnings.count);
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
      sb_propellants_card(&canvas, &layout, study, model, look, k);
    }
  }
  draw_foot(&canvas, layout.foot, study, model, look->temperature);
  sb_canvas_finish(&canvas);
}
