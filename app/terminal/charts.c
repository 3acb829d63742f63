// Charts in cells. See charts.h. Ranges are those of the drawn charts (app/chart), so that a loop
// stands between the same axes in every front end.
#include "app/terminal/charts.h"

#include "app/base/device.h"
#include "app/base/figure_text.h"
#include "app/base/unit.h"
#include "app/chart/hysteresis.h"

#include <glib.h>
#include <math.h>
#include <string.h>

void sb_cell_theme(SbCellTheme *out, bool own) {
  const SbTheme *theme = sb_theme(true);
  for (int i = 0; i < SB_ROLE_COUNT; i++) {
    out->role[i] = sb_cell_color(theme->role[i]);
  }
  out->ground = own ? SB_CELL_OWN : out->role[SB_ROLE_BACKGROUND];
  if (own) {
    out->role[SB_ROLE_INK] = SB_CELL_OWN;
    out->role[SB_ROLE_SECOND] = SB_CELL_OWN;
    out->role[SB_ROLE_THIRD] = 0x808890; // reads on light and dark
  }
}

static SbPen pen_of(const SbCellTheme *theme, SbRole role, uint8_t style) {
  return (SbPen){theme->role[role], SB_CELL_OWN, style};
}

// Removes the unit at the end of a formatted number ("1.61 mm" becomes "1.61"), in place.
static void drop_unit(char *text) {
  // Behind the last blank, a plain one or one that does not break (U+00A0, U+202F).
  static const char *const blanks[] = {" ", "\u00a0", "\u202f", "\u2009"};
  char *last = NULL;
  for (size_t i = 0; i < G_N_ELEMENTS(blanks); i++) {
    char *at = g_strrstr(text, blanks[i]);
    last = at != NULL && at > last && !g_ascii_isdigit(at[strlen(blanks[i])]) ? at : last;
  }
  if (last != NULL) {
    *last = '\0';
  }
}

// The loop --------------------------------------------------------------------------------------

// Points of a run's trace: displacement [mm] or time [s], and force [N]. Owned by the caller.
static size_t trace_points(double **x, double **y, const SbChartRun *run, bool over_time) {
  size_t count = 0;
  const SbTracePoint *point = run->trace != NULL ? sb_trace_points(run->trace, &count) : NULL;
  *x = g_new(double, count + 1);
  *y = g_new(double, count + 1);
  for (size_t i = 0; i < count; i++) {
    (*x)[i] = over_time ? point[i].time : 1e3 * point[i].displacement;
    (*y)[i] = point[i].force;
  }
  return count;
}

static void draw_run(SbPlot *plot, const SbChartRun *run, const SbPlotLine *line) {
  g_autofree double *x = NULL, *y = NULL;
  const size_t count = trace_points(&x, &y, run, false);
  sb_plot_curve(plot, x, y, count, line);
}

static void draw_predicted(SbPlot *plot, const SbChartCurve *curve, const SbPlotLine *line) {
  g_autofree double *x = g_new(double, curve->count + 1);
  for (size_t i = 0; i < curve->count; i++) {
    x[i] = 1e3 * curve->displacement[i];
  }
  sb_plot_curve(plot, x, curve->force, curve->count, line);
}

static void draw_measured(SbPlot *plot, const SbComparison *measured, uint32_t ink) {
  enum { DOTS = 400 };
  const size_t stride = MAX(measured->count / DOTS, 1);
  for (size_t i = 0; i < measured->count; i += stride) {
    const double x = 1e3 * measured->point[i].displacement, y = measured->point[i].force;
    sb_plot_curve(plot, &x, &y, 1, &(SbPlotLine){.ink = ink, .rank = 6});
  }
}

// Stages with their forces. F stands on the line that E has labelled, A is the origin.
static void draw_stages(SbPlot *plot, SbCellRect within, const SbCellTheme *theme,
                        const SbChartRun *run) {
  static const SbStage order[] = {SB_STAGE_B, SB_STAGE_C, SB_STAGE_D, SB_STAGE_E};
  const SbStageMark *mark = sb_trace_marks(run->trace);
  for (size_t i = 0; i < G_N_ELEMENTS(order); i++) {
    const SbStageMark *at = &mark[order[i]];
    int column, row;
    if (!at->reached || !sb_plot_cell(plot, 1e3 * at->displacement, at->force, &column, &row)) {
      continue;
    }
    char force[SB_FORMAT_MAX], text[2 * SB_FORMAT_MAX];
    sb_chart_stage_force(force, run, order[i], at->force);
    drop_unit(force);
    g_snprintf(text, sizeof text, "%s %s", sb_stage_name(order[i]), force);
    sb_plot_label(plot->cells, within, column, row, text, pen_of(theme, SB_ROLE_INK, SB_CELL_BOLD));
  }
}

static void label_return(SbPlot *plot, SbCellRect within, const SbCellTheme *theme,
                         const SbChartRun *run) {
  const SbSummary *summary = run->summary;
  const int figure = sb_figure_find("cycle.force_return_min_N");
  if (summary == NULL || isnan(sb_figure_value(summary, figure))) {
    return;
  }
  const SbStageMark *e = &sb_trace_marks(run->trace)[SB_STAGE_E];
  char force[SB_FORMAT_MAX], text[2 * SB_FORMAT_MAX];
  sb_format_figure(force, summary, figure);
  g_snprintf(text, sizeof text, "return, sliding %s", force);
  int column, row;
  if (e->reached && sb_plot_cell(plot, 1e3 * 0.4 * e->displacement,
                                 sb_figure_value(summary, figure), &column, &row)) {
    sb_plot_label(plot->cells, within, column, row, text, pen_of(theme, SB_ROLE_INK, 0));
  }
}

static void draw_now(SbPlot *plot, SbCellRect within, const SbCellTheme *theme,
                     const SbChartData *data, bool over_time) {
  const SbFrame *frame = sb_chart_frame(data);
  int column, row;
  if (frame == NULL || !sb_plot_cell(plot, over_time ? frame->time : 1e3 * frame->displacement,
                                     frame->force, &column, &row)) {
    return;
  }
  char at[SB_FORMAT_MAX], force[SB_FORMAT_MAX], text[3 * SB_FORMAT_MAX];
  if (over_time) {
    sb_format_text(at, SB_QUANTITY_TIME, frame->time, 0);
  } else {
    sb_format_text(at, SB_QUANTITY_LENGTH, frame->displacement, 0);
  }
  sb_format_text(force, SB_QUANTITY_FORCE, frame->force, sb_chart_error_force(&data->run));
  g_snprintf(text, sizeof text, "%s, %s", at, force);
  const SbPen pen = pen_of(theme, SB_ROLE_NOW, SB_CELL_BOLD);
  sb_cells_put(plot->cells, column, row, 0x25cf, pen);
  sb_plot_label(plot->cells, within, column, row, text, pen);
}

// A rig's force over time.
static void chart_signal(SbCells *cells, SbCellRect rect, const SbCellTheme *theme,
                         const SbChartData *data, unsigned flags) {
  const SbTraceRange range = sb_trace_range(data->run.trace);
  SbPlot plot;
  g_autofree double *x = NULL, *y = NULL;
  const size_t count = trace_points(&x, &y, &data->run, true);
  sb_plot_axes(&plot, cells, rect, &(SbScale){.lo = 0, .hi = range.time_max},
               &(SbScale){.lo = fmin(range.force_min, 0), .hi = 1.1 * range.force_max},
               theme->role[SB_ROLE_SECOND]);
  sb_plot_curve(&plot, x, y, count, &(SbPlotLine){.ink = theme->role[SB_ROLE_INK], .rank = 5});
  sb_plot_finish(&plot);
  if ((flags & SB_CHART_WHOLE) == 0) {
    draw_now(&plot, rect, theme, data, true);
  }
}

// Writes the force of the pressure at `place` on its line.
static void label_pressure(SbPlot *plot, SbCellRect within, const SbCellTheme *theme, double place,
                           double pressure) {
  int column, row;
  if (sb_plot_cell(plot, place, pressure, &column, &row)) {
    char force[SB_FORMAT_MAX], text[2 * SB_FORMAT_MAX];
    sb_figure_text(force, sb_figure_find("cycle.pressure_force_N"), pressure, 0);
    g_snprintf(text, sizeof text, "pressure %s", force);
    sb_plot_label(plot->cells, within, column, row, text, pen_of(theme, SB_ROLE_FLUID, 0));
  }
}

void sb_chart_loop(SbCells *cells, SbCellRect rect, const SbCellTheme *theme,
                   const SbChartData *data, unsigned flags) {
  if (!sb_device(data->run.model)->stem && data->run.trace != NULL) {
    chart_signal(cells, rect, theme, data, flags);
    return;
  }
  SbAxes layout;
  const SbRect ground = {0, 0, 8.0 * rect.width, 16.0 * rect.height};
  sb_hysteresis_layout(&layout, ground, data, SB_CHART_COMPACT);
  SbPlot plot;
  sb_plot_axes(&plot, cells, rect, &layout.x, &layout.y, theme->role[SB_ROLE_SECOND]);

  // Zero, the pressure force, what stands behind, and the live loop.
  const double ends[2] = {layout.x.lo, layout.x.hi}, zero[2] = {0, 0};
  sb_plot_curve(&plot, ends, zero, 2,
                &(SbPlotLine){.ink = theme->role[SB_ROLE_AXIS], .rank = 1, .on = 1, .off = 3});
  const double pressure = data->run.model != NULL ? sb_model_pressure_force(data->run.model) : NAN;
  if (isfinite(pressure) && pressure != 0) {
    const double level[2] = {pressure, pressure};
    sb_plot_curve(&plot, ends, level, 2,
                  &(SbPlotLine){.ink = theme->role[SB_ROLE_FLUID], .rank = 2, .on = 2, .off = 4});
  }
  const bool running = data->run.state == SB_CHART_RUNNING;
  if (running && data->earlier != NULL) {
    draw_run(&plot, data->earlier,
             &(SbPlotLine){.ink = theme->role[SB_ROLE_THIRD], .rank = 3, .on = 1, .off = 1});
  }
  for (size_t i = 0; i < data->pin_count; i++) {
    const SbChartPin *pin = &data->pin[i];
    const SbPlotLine line = {.ink = theme->role[sb_chart_pin_role(pin->look)],
                             .rank = 3,
                             .on = pin->look == 0 ? 5 : 1,
                             .off = pin->look == 0 ? 3 : 2};
    draw_run(&plot, pin->run, &line);
  }
  if (data->predicted != NULL) {
    draw_predicted(&plot, &data->predicted->loop,
                   &(SbPlotLine){.ink = theme->role[SB_ROLE_SECOND], .rank = 4, .on = 1, .off = 2});
  }
  draw_run(&plot, &data->run, &(SbPlotLine){theme->role[SB_ROLE_INK], 5, SB_CELL_BOLD, 0, 0});
  if (data->measured != NULL) {
    draw_measured(&plot, data->measured, theme->role[SB_ROLE_OCHRE]);
  }
  sb_plot_finish(&plot);
  const SbCellRect within = {plot.rect.x, rect.y, rect.x + rect.width - plot.rect.x,
                             plot.rect.height};
  if ((flags & SB_CHART_WHOLE) == 0) {
    draw_now(&plot, within, theme, data, false);
  }
  if (data->run.trace == NULL || data->run.count == 0) {
    return;
  }
  draw_stages(&plot, within, theme, &data->run);
  label_return(&plot, within, theme, &data->run);
  if (isfinite(pressure) && pressure != 0 && rect.height >= 10) {
    label_pressure(&plot, within, theme, layout.x.lo + 0.06 * (layout.x.hi - layout.x.lo),
                   pressure);
  }
}

// Several loops ---------------------------------------------------------------------------------

// The look of one of several curves: colours, and dashes that tell them apart without.
static SbPlotLine line_of(const SbCellTheme *theme, size_t index) {
  static const SbRole role[SB_LOOPS_MAX] = {SB_ROLE_INK,   SB_ROLE_VIOLET, SB_ROLE_TEAL,
                                            SB_ROLE_OCHRE, SB_ROLE_INNER,  SB_ROLE_NOW};
  static const int dash[SB_LOOPS_MAX][2] = {{0, 0}, {5, 3}, {1, 2}, {3, 1}, {7, 2}, {1, 4}};
  index %= SB_LOOPS_MAX;
  return (SbPlotLine){.ink = theme->role[role[index]],
                      .rank = (uint8_t)(9 - index),
                      .style = index == 0 ? SB_CELL_BOLD : 0,
                      .on = dash[index][0],
                      .off = dash[index][1]};
}

// Names with a piece of their line; returns the rows taken.
static int draw_legend(SbCells *cells, SbCellRect rect, const char *const *name,
                       const SbPlotLine *line, size_t count) {
  int x = rect.x, y = rect.y;
  for (size_t i = 0; i < count; i++) {
    const int width = MIN(sb_cells_width(cells, name[i]) + 5, rect.width);
    if (x > rect.x && x + width > rect.x + rect.width) {
      x = rect.x;
      y++;
    }
    if (y >= rect.y + rect.height) {
      break;
    }
    const SbScale unit = {.lo = 0, .hi = 1};
    SbPlot plot;
    sb_plot_init(&plot, cells, (SbCellRect){x, y, 4, 1}, &unit, &unit);
    const double px[2] = {0, 1}, py[2] = {0.5, 0.5};
    sb_plot_curve(&plot, px, py, 2, &line[i]);
    sb_plot_finish(&plot);
    sb_cells_text(cells, x + 5, y, width - 5, name[i], (SbPen){line[i].ink, SB_CELL_OWN, 0});
    x += width + 2;
  }
  return y - rect.y + 1;
}

void sb_chart_loops(SbCells *cells, SbCellRect rect, const SbCellTheme *theme,
                    const SbNamedRun *runs, size_t count, const SbComparison *measured) {
  count = MIN(count, SB_LOOPS_MAX);
  double x1 = 0, y0 = 0, y1 = 1;
  const char *name[SB_LOOPS_MAX];
  SbPlotLine line[SB_LOOPS_MAX];
  for (size_t i = 0; i < count; i++) {
    const SbTraceRange range = sb_trace_range(runs[i].run->trace);
    x1 = fmax(x1, 1e3 * range.displacement_max);
    y0 = fmin(y0, range.force_min);
    y1 = fmax(y1, range.force_max);
    name[i] = runs[i].name;
    line[i] = line_of(theme, i);
  }
  const int rows = draw_legend(cells, (SbCellRect){rect.x, rect.y + rect.height - 1, rect.width, 1},
                               name, line, count);
  SbPlot plot;
  sb_plot_axes(&plot, cells, (SbCellRect){rect.x, rect.y, rect.width, rect.height - rows},
               &(SbScale){.lo = 0, .hi = x1}, &(SbScale){.lo = y0, .hi = 1.05 * y1},
               theme->role[SB_ROLE_SECOND]);
  for (size_t i = 0; i < count; i++) {
    draw_run(&plot, runs[i].run, &line[i]);
  }
  if (measured != NULL) {
    draw_measured(&plot, measured, theme->role[SB_ROLE_OCHRE]);
  }
  sb_plot_finish(&plot);
}

// Curves ----------------------------------------------------------------------------------------

static void include(double *lo, double *hi, double value, bool logarithmic) {
  if (isfinite(value) && !(logarithmic && value <= 0)) {
    *lo = fmin(*lo, value);
    *hi = fmax(*hi, value);
  }
}

void sb_chart_curves(SbCells *cells, SbCellRect rect, const SbCellTheme *theme, const char *heading,
                     const SbCellCurve *curve, size_t count, bool log_x, bool log_y) {
  double x0 = INFINITY, x1 = -INFINITY, y0 = INFINITY, y1 = -INFINITY;
  for (size_t i = 0; i < count; i++) {
    for (size_t k = 0; k < curve[i].count; k++) {
      include(&x0, &x1, curve[i].x[k], log_x);
      include(&y0, &y1, curve[i].y[k], log_y);
    }
  }
  if (!log_y && y0 > 0 && y0 < 0.5 * y1) {
    y0 = 0; // a curve that is more than half as high as its axis starts at zero
  }
  sb_cells_text(cells, rect.x, rect.y, rect.width, heading,
                pen_of(theme, SB_ROLE_INK, SB_CELL_BOLD));
  rect.y++;
  rect.height--;
  if (!(x1 >= x0) || !(y1 >= y0)) {
    return;
  }
  SbPlot plot;
  sb_plot_axes(&plot, cells, rect, &(SbScale){.lo = x0, .hi = x1, .logarithmic = log_x},
               &(SbScale){.lo = y0, .hi = y1, .logarithmic = log_y}, theme->role[SB_ROLE_SECOND]);
  for (size_t i = 0; i < count; i++) {
    SbPlotLine line = line_of(theme, i);
    line.ink = theme->role[curve[i].role];
    for (size_t k = 0; curve[i].dots && k < curve[i].count; k++) {
      sb_plot_curve(&plot, &curve[i].x[k], &curve[i].y[k], 1, &line);
    }
    if (!curve[i].dots) {
      sb_plot_curve(&plot, curve[i].x, curve[i].y, curve[i].count, &line);
    }
  }
  sb_plot_finish(&plot);
  // Each name at the curve's last point, where there is more than one.
  for (size_t i = 0; count > 1 && i < count; i++) {
    size_t last = curve[i].count;
    int column, row;
    while (last > 0 && !isfinite(curve[i].y[last - 1])) {
      last--;
    }
    const size_t place = last * (i + 1) / (count + 1);
    if (last > 0 && curve[i].name[0] != '\0' &&
        sb_plot_cell(&plot, curve[i].x[place], curve[i].y[place], &column, &row)) {
      sb_plot_label(cells, plot.rect, column, row, curve[i].name, pen_of(theme, curve[i].role, 0));
    }
  }
}

void sb_chart_study(SbCells *cells, SbCellRect rect, const SbCellTheme *theme, const SbStudy *study,
                    size_t panel) {
  static const SbRole role[] = {SB_ROLE_OUTER, SB_ROLE_INNER, SB_ROLE_TEAL, SB_ROLE_VIOLET,
                                SB_ROLE_OCHRE, SB_ROLE_FLUID, SB_ROLE_PASS, SB_ROLE_NOW,
                                SB_ROLE_WARN,  SB_ROLE_INK};
  const SbStudyPanel *of = &study->panel[panel];
  SbCellCurve curve[SB_STUDY_SERIES];
  g_autofree double *memory = g_new(double, 2 * SB_STUDY_SERIES * SB_STUDY_POINTS);
  for (size_t i = 0; i < of->series_count; i++) {
    const SbStudySeries *series = &of->series[i];
    double *x = memory + 2 * i * SB_STUDY_POINTS, *y = x + SB_STUDY_POINTS;
    for (size_t k = 0; k < series->count; k++) {
      x[k] = sb_quantity_to_shown(series->x[k], study->x.si, study->x.unit);
      y[k] = sb_quantity_to_shown(series->y[k], of->y.si, of->y.unit);
    }
    curve[i] = (SbCellCurve){.name = series->name,
                             .x = x,
                             .y = y,
                             .count = series->count,
                             .role = role[i % G_N_ELEMENTS(role)],
                             .dots = series->style == SB_STUDY_DOTS};
  }
  g_autofree char *heading = g_strdup_printf(
      "%s%s%s over %s%s%s", of->y.quantity, of->y.unit[0] != '\0' ? " / " : "", of->y.unit,
      study->x.quantity, study->x.unit[0] != '\0' ? " / " : "", study->x.unit);
  sb_chart_curves(cells, rect, theme, heading, curve, of->series_count, study->x.logarithmic,
                  of->y.logarithmic);
}

void sb_chart_histogram(SbCells *cells, SbCellRect rect, const SbCellTheme *theme,
                        const char *heading, const double *value, size_t count, double low,
                        double high) {
  double lo = INFINITY, hi = -INFINITY;
  size_t known = 0;
  for (size_t i = 0; i < count; i++) {
    include(&lo, &hi, value[i], false);
    known += isfinite(value[i]);
  }
  g_autofree char *title = known == count ? g_strdup_printf("%s, %zu samples", heading, count)
                                          : g_strdup_printf("%s, %zu samples, %zu without a value",
                                                            heading, count, count - known);
  sb_cells_text(cells, rect.x, rect.y, rect.width, title, pen_of(theme, SB_ROLE_INK, SB_CELL_BOLD));
  if (known == 0) {
    return;
  }
  sb_axis_repair(&lo, &hi);
  // As many bins as the samples bear (the square root of their number), over whole columns.
  SbPlot plot;
  enum { BINS = 80 };
  const int bins = CLAMP((int)sqrt((double)known), 4, MIN(BINS, MAX(rect.width - 10, 4)));
  int in[BINS] = {0}, most = 0;
  for (size_t i = 0; i < count; i++) {
    if (isfinite(value[i])) {
      const int bin = CLAMP((int)((value[i] - lo) / (hi - lo) * bins), 0, bins - 1);
      in[bin]++;
      most = MAX(most, in[bin]);
    }
  }
  sb_plot_axes(&plot, cells, (SbCellRect){rect.x, rect.y + 1, rect.width, rect.height - 1},
               &(SbScale){.lo = lo, .hi = hi}, &(SbScale){.lo = 0, .hi = most},
               theme->role[SB_ROLE_SECOND]);
  const SbCellRect at = plot.rect;
  sb_plot_finish(&plot);
  for (int x = 0; x < at.width; x++) {
    const int bin = MIN(x * bins / at.width, bins - 1);
    const double from = lo + bin * (hi - lo) / bins, to = lo + (bin + 1) * (hi - lo) / bins;
    const bool beyond = from >= high || to <= low;
    int eighths = (int)lround(8.0 * at.height * in[bin] / most);
    for (int y = at.y + at.height - 1; eighths > 0 && y >= at.y; y--, eighths -= 8) {
      sb_cells_put(cells, at.x + x, y, 0x2580u + (uint32_t)MIN(eighths, 8),
                   pen_of(theme, beyond ? SB_ROLE_ERROR : SB_ROLE_FLUID, 0));
    }
  }
}
