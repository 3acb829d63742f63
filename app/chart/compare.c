// See compare.h. All values of a row have the unit of the live one and the decimals that the error
// of the differences supports (figure_text.h), so that a difference is that of the numbers shown.
// Which figures: the forces of the loop, then what decides on a valve, then the sizes it follows
// from.
#include "app/chart/compare.h"

#include "app/base/figure_text.h"
#include "app/base/unit.h"
#include "app/chart/hysteresis.h"
#include "app/draw/legend.h"

#include <glib.h>
#include <glib/gi18n.h>
#include <math.h>
#include <string.h>

#define COMPARE_ROW   20.0
#define HEAD          26.0
#define LABEL         118.0
#define VALUE         54.0
#define CHANGE        48.0
#define PERCENT       44.0
#define LEAST_PERCENT 0.5 // a live force below this has no percentage [N]
#define DASH          "\xe2\x80\x93"

enum { AT_PLAYHEAD = 2, COLUMNS = 1 + SB_CHART_PINS };

static const struct {
  const char *label, *path;
  int stage; // whose force was measured, too; -1: none
} figures[] = {{N_("B break-away"), "cycle.force_breakaway_N", SB_STAGE_B},
               {"C", "cycle.stages.C.force_N", SB_STAGE_C},
               {"D", "cycle.stages.D.force_N", SB_STAGE_D},
               {"E", "cycle.stages.E.force_N", SB_STAGE_E},
               {N_("return margin"), "cycle.force_return_margin_N", -1},
               {N_("loss per cycle"), "cycle.energy_loss_J", -1},
               {N_("leak per cycle"), "cycle.leakage_per_cycle_m3", -1},
               {N_("outer peak"), "seals.outer.pressure_peak_Pa", -1},
               {N_("outer film"), "seals.outer.film_central_m", -1},
               {N_("squeeze"), "seals.outer.squeeze", -1},
               {N_("gland fill"), "seals.outer.gland_fill", -1}};
enum { ROWS = AT_PLAYHEAD + G_N_ELEMENTS(figures) };

// A row in the unit that is shown; NAN: not known.
typedef struct {
  char label[40], unit[16];
  int decimals;
  bool force, stuck[COLUMNS];
  double value[COLUMNS], measured;
} Row;

static const SbChartRun *run_of(const SbChartData *data, size_t column) {
  return column == 0 ? &data->run : data->pin[column - 1].run;
}

static uint64_t methods_of(const SbChartRun *run) {
  return run->model != NULL ? sb_model_methods(run->model) : 0;
}

static void playhead_row(Row *row, const SbChartData *data, int way) {
  const SbFrame *frame = sb_chart_frame(data);
  const double at = frame != NULL ? frame->displacement : NAN;
  char number[SB_FORMAT_MAX];
  *row = (Row){.unit = "N", .force = true, .measured = NAN};
  g_snprintf(row->label, sizeof row->label, way == 0 ? _("at %s mm, in") : _("at %s mm, back"),
             sb_format_fixed(number, 1e3 * at, 2));
  SbFigureCompared design[COLUMNS];
  for (size_t i = 0; i <= data->pin_count; i++) {
    double force[2] = {NAN, NAN};
    const SbChartRun *run = run_of(data, i);
    sb_hysteresis_forces(force, run, at);
    row->value[i] = force[way];
    row->stuck[i] = way == 1 && isnan(force[1]) && run->summary != NULL &&
                    run->summary->outcome == SB_OUTCOME_STUCK;
    design[i] = (SbFigureCompared){force[way], sb_chart_error_force(run), methods_of(run)};
  }
  row->decimals = sb_figure_compared_decimals(sb_figure_find("cycle.stages.C.force_N"), design,
                                              1 + data->pin_count);
}

static void figure_row(Row *row, const SbChartData *data, size_t k) {
  const int index = sb_figure_find(figures[k].path);
  const SbFigure *figure = sb_figure(index);
  *row = (Row){.force = figure->quantity == SB_FIGURE_QUANTITY_FORCE, .measured = NAN};
  g_strlcpy(row->label, _(figures[k].label), sizeof row->label);
  SbFigureCompared design[COLUMNS];
  for (size_t i = 0; i <= data->pin_count; i++) {
    const SbChartRun *run = run_of(data, i);
    const SbSummary *summary = run->summary;
    design[i] = (SbFigureCompared){summary != NULL ? sb_figure_value(summary, index) : NAN,
                                   summary != NULL ? sb_figure_error(summary, index) : NAN,
                                   methods_of(run)};
  }
  g_strlcpy(row->unit, sb_figure_compared_unit(index, design, 1 + data->pin_count),
            sizeof row->unit);
  for (size_t i = 0; i <= data->pin_count; i++) {
    row->value[i] = sb_quantity_to_shown(design[i].value, figure->si, row->unit);
  }
  if (data->measured != NULL && figures[k].stage >= 0) {
    const SbMeasuredStage *stage = &data->measured->measured->stage[figures[k].stage];
    row->measured = stage->found ? stage->force : NAN;
  }
  row->decimals = sb_figure_compared_decimals(index, design, 1 + data->pin_count);
}

static void make(Row *row, const SbChartData *data, size_t index) {
  if (index < AT_PLAYHEAD) {
    playhead_row(row, data, (int)index);
  } else {
    figure_row(row, data, index - AT_PLAYHEAD);
  }
}

static const char *value_text(char *out, const Row *row, double value) {
  return isfinite(value) ? sb_format_fixed(out, value, row->decimals)
                         : (g_strlcpy(out, DASH, SB_FORMAT_MAX), out);
}

// "+1.0", of the numbers as they are shown.
static const char *change_text(char *out, const Row *row, double value) {
  const double step = pow(10, -row->decimals);
  const double change = step * (round(value / step) - round(row->value[0] / step));
  out[0] = '\0';
  if (isfinite(change)) {
    char number[SB_FORMAT_MAX];
    sb_format_fixed(number, change, row->decimals);
    g_snprintf(out, SB_FORMAT_MAX, "%s%s", change > 0 ? "+" : "", number);
  }
  return out;
}

static const char *percent_text(char *out, const Row *row, double value) {
  const double base = row->value[0], change = 100 * (value - base) / fabs(base);
  const bool means = isfinite(change) && !(row->force && fabs(base) < LEAST_PERCENT);
  out[0] = '\0';
  if (means) {
    char number[SB_FORMAT_MAX];
    sb_format_fixed(number, change, 0);
    g_snprintf(out, SB_FORMAT_MAX, "%s%s\xc2\xa0%%", change >= 0.5 ? "+" : "", number);
  }
  return out;
}

// Columns of the table: the live run's ends at `live`, each further one is `each` and a gap wider.
typedef struct {
  double live, each, gap;
  bool percent; // there is room for percentages
} Columns;

static Columns columns_of(SbRect rect, const SbChartData *data) {
  const double pins = (double)data->pin_count, measured = data->measured != NULL;
  const double least = LABEL + VALUE + pins * (VALUE + CHANGE) + measured * VALUE;
  Columns of = {.percent = rect.width >= least + pins * PERCENT};
  of.each = VALUE + CHANGE + (of.percent ? PERCENT : 0);
  // The remaining room is divided between the columns.
  of.gap = fmax(rect.width - least - (of.percent ? pins * PERCENT : 0), 0) / (1 + pins + measured);
  of.live = rect.x + LABEL + VALUE + of.gap;
  return of;
}

static void draw_head(SbCanvas *c, SbRect rect, const SbChartData *data, const Columns *of) {
  const double y = rect.y + 14;
  sb_legend_line(c, of->live, y, VALUE + of->gap, (SbStroke){SB_ROLE_INK, SB_LINE_ACTIVE, NULL},
                 _("live"));
  for (size_t i = 0; i < data->pin_count; i++) {
    const SbChartPin *pin = &data->pin[i];
    sb_legend_line(c, of->live + (double)(i + 1) * (of->each + of->gap), y, of->each + of->gap - 8,
                   sb_chart_pin_stroke(pin->look), pin->name);
  }
  if (data->measured != NULL) {
    const SbTextStyle dots = sb_canvas_style(c, SB_TYPE_LABEL, 400, SB_ROLE_WARN);
    sb_canvas_text(c, _("measured"), &dots, rect.x + rect.width, y, SB_RIGHT);
  }
}

// The value of a column, and its difference from the live one's.
static void draw_value(SbCanvas *c, const Row *row, const Columns *of, size_t column, double base) {
  const SbTextStyle style = sb_canvas_style(c, SB_TYPE_LABEL, column == 0 ? 700 : 400, SB_ROLE_INK);
  const SbTextStyle second = sb_canvas_style(c, SB_TYPE_NOTE, 400, SB_ROLE_SECOND);
  const SbTextStyle stuck = sb_canvas_style(c, SB_TYPE_LABEL, 600, SB_ROLE_ERROR);
  const double right = of->live + (double)column * (of->each + of->gap), value = row->value[column];
  const double at = column == 0 ? right : right - of->each + VALUE;
  char text[SB_FORMAT_MAX];
  if (row->stuck[column]) {
    sb_canvas_text(c, _("does not return"), &stuck, right, base, SB_RIGHT);
    return;
  }
  sb_canvas_text(c, value_text(text, row, value), &style, at, base, SB_RIGHT);
  if (column > 0) {
    sb_canvas_text(c, change_text(text, row, value), &second, at + CHANGE, base, SB_RIGHT);
  }
  if (column > 0 && of->percent) {
    sb_canvas_text(c, percent_text(text, row, value), &second, right, base, SB_RIGHT);
  }
}

static void draw_row(SbCanvas *c, SbRect rect, const SbChartData *data, const Columns *of,
                     size_t index) {
  const SbTextStyle name = sb_canvas_style(c, SB_TYPE_LABEL, 400, SB_ROLE_INK);
  const SbTextStyle unit = sb_canvas_style(c, SB_TYPE_NOTE, 400, SB_ROLE_THIRD);
  const SbTextStyle dots = sb_canvas_style(c, SB_TYPE_LABEL, 400, SB_ROLE_WARN);
  const double base = rect.y + 14;
  char text[SB_FORMAT_MAX];
  Row row;
  make(&row, data, index);
  if (index < AT_PLAYHEAD) {
    sb_canvas_fill(c, (SbRect){rect.x - 4, rect.y, rect.width + 8, COMPARE_ROW}, SB_ROLE_GRID, 1);
  } else {
    sb_canvas_hairline(c, rect.x, rect.y, rect.x + rect.width, rect.y,
                       sb_canvas_role(c, SB_ROLE_GRID));
  }
  const double used = sb_canvas_text(c, row.label, &name, rect.x, base, SB_LEFT);
  sb_canvas_text(c, row.unit, &unit, rect.x + used + 5, base, SB_LEFT);
  for (size_t i = 0; i <= data->pin_count; i++) {
    draw_value(c, &row, of, i, base);
  }
  if (data->measured != NULL && isfinite(row.measured)) {
    sb_canvas_text(c, value_text(text, &row, row.measured), &dots, rect.x + rect.width, base,
                   SB_RIGHT);
  }
}

void sb_compare_draw(cairo_t *cr, SbRect rect, const SbTheme *theme, const SbChartData *data,
                     unsigned flags) {
  SbCanvas canvas, *c = &canvas;
  sb_canvas_init(c, cr, theme);
  if (flags & SB_CHART_PANEL) {
    sb_canvas_panel(c, rect);
    rect = (SbRect){rect.x + SB_GRID_PADDING, rect.y + 12, rect.width - 2 * SB_GRID_PADDING,
                    rect.height - 24};
  }
  const Columns of = columns_of(rect, data);
  draw_head(c, rect, data, &of);
  double y = rect.y + HEAD;
  for (size_t k = 0; k < ROWS && y + COMPARE_ROW <= rect.y + rect.height + 0.5;
       k++, y += COMPARE_ROW) {
    draw_row(c, (SbRect){rect.x, y, rect.width, COMPARE_ROW}, data, &of, k);
  }
  sb_canvas_finish(c);
}

char *sb_compare_text(const SbChartData *data) {
  GString *text = g_string_new(_("figure\tunit\tlive"));
  char number[SB_FORMAT_MAX];
  for (size_t i = 0; i < data->pin_count; i++) {
    g_string_append_printf(text, _("\t%s\tdifference"), data->pin[i].name);
  }
  g_string_append(text, data->measured != NULL ? _("\tmeasured\n") : "\n");
  for (size_t k = 0; k < ROWS; k++) {
    Row row;
    make(&row, data, k);
    g_string_append_printf(text, "%s\t%s", row.label, row.unit);
    for (size_t i = 0; i <= data->pin_count; i++) {
      g_string_append_printf(text, "\t%s",
                             row.stuck[i] ? _("does not return")
                                          : value_text(number, &row, row.value[i]));
      if (i > 0) {
        g_string_append_printf(text, "\t%s", change_text(number, &row, row.value[i]));
      }
    }
    if (data->measured != NULL) {
      g_string_append_printf(text, "\t%s", value_text(number, &row, row.measured));
    }
    g_string_append_c(text, '\n');
  }
  return g_string_free(text, FALSE);
}
