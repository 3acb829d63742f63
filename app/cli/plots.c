// Charts below tables. See plots.h. By the same code as the workbench in a terminal.
#include "app/cli/plots.h"

#include "app/base/device.h"
#include "app/base/figure_text.h"
#include "app/cli/cli.h"
#include "app/terminal/charts.h"

#include <math.h>
#include <string.h>
#include <sys/ioctl.h>
#include <unistd.h>

enum { COLUMNS = 80, COLUMNS_MAX = 120, ROWS = SB_CLI_PLOT_ROWS };

bool sb_cli_plots(const SbCliPlots *plots) {
  return !plots->off && !sb_cli_quiet() && (plots->on || isatty(STDOUT_FILENO) != 0);
}

typedef struct {
  SbCells cells;
  SbCellTheme theme;
  SbCellRect rect;
} Sheet;

// As wide as the terminal. Off one there are no colours, and the signs are those of the locale.
static void begin(Sheet *sheet, int rows) {
  struct winsize size = {0};
  const bool known = ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0;
  const int columns = known ? MIN((int)size.ws_col, COLUMNS_MAX) : COLUMNS;
  sb_cells_init(&sheet->cells, columns, rows + 1, sb_cells_ascii_environment());
  sb_cell_theme(&sheet->theme, true);
  sheet->rect = (SbCellRect){2, 1, MAX(columns - 4, 1), rows};
}

static void end(Sheet *sheet) {
  const bool terminal = isatty(STDOUT_FILENO) != 0;
  sb_cells_print(&sheet->cells, terminal ? sb_colors_of_environment() : SB_COLORS_NONE, stdout);
  sb_cells_finish(&sheet->cells);
}

static void heading(Sheet *sheet, const char *text) {
  sb_cells_text(&sheet->cells, sheet->rect.x, sheet->rect.y, sheet->rect.width, text,
                (SbPen){sheet->theme.role[SB_ROLE_INK], SB_CELL_OWN, SB_CELL_BOLD});
  sheet->rect.y++;
  sheet->rect.height--;
}

static SbTrace *read_run(SbChartRun *chart, const SbRun *run) {
  size_t count = 0;
  const SbFrame *frames = sb_run_frames(run, &count);
  SbTrace *trace = sb_trace_create(sb_run_model(run));
  sb_trace_extend(trace, frames, count, 0);
  sb_chart_run_init(chart, run, trace, SB_CHART_DONE);
  return trace;
}

void sb_cli_plot_run(const SbRun *run, const SbComparison *measured, int rows) {
  SbChartData data = {.measured = measured};
  SbTrace *trace = read_run(&data.run, run);
  if (data.run.count > 0) {
    Sheet sheet;
    begin(&sheet, rows);
    heading(&sheet, sb_device(data.run.model)->stem ? "Force / N over displacement / mm"
                                                    : "Force / N over time / s");
    sb_chart_loop(&sheet.cells, sheet.rect, &sheet.theme, &data, SB_CHART_WHOLE);
    end(&sheet);
  }
  sb_trace_destroy(trace);
}

void sb_cli_plot_runs(SbRun *const *run, const char *const *name, size_t count,
                      const SbComparison *measured) {
  count = MIN(count, (size_t)SB_LOOPS_MAX);
  SbChartRun chart[SB_LOOPS_MAX];
  SbTrace *trace[SB_LOOPS_MAX];
  SbNamedRun named[SB_LOOPS_MAX];
  for (size_t i = 0; i < count; i++) {
    trace[i] = read_run(&chart[i], run[i]);
    named[i] = (SbNamedRun){name[i], &chart[i]};
  }
  Sheet sheet;
  begin(&sheet, ROWS);
  heading(&sheet, "Force / N over displacement / mm");
  sb_chart_loops(&sheet.cells, sheet.rect, &sheet.theme, named, count, measured);
  end(&sheet);
  for (size_t i = 0; i < count; i++) {
    sb_trace_destroy(trace[i]);
  }
}

void sb_cli_plot_profile(const double *x, const double *pressure, const double *film,
                         size_t count) {
  Sheet sheet;
  begin(&sheet, ROWS);
  g_autofree double *values = g_new(double, 3 * count + 1);
  double *place = values, *upper = values + count, *lower = values + 2 * count;
  for (size_t i = 0; i < count; i++) {
    place[i] = 1e3 * x[i];
    upper[i] = 1e-6 * pressure[i];
    lower[i] = film != NULL && film[i] > 0 ? 1e9 * film[i] : NAN;
  }
  const int width = film != NULL ? sheet.rect.width / 2 - 1 : sheet.rect.width;
  const SbCellCurve curve = {
      .name = "", .x = place, .y = upper, .count = count, .role = SB_ROLE_OUTER};
  sb_chart_curves(&sheet.cells, (SbCellRect){sheet.rect.x, 1, width, ROWS}, &sheet.theme,
                  "Contact pressure / MPa over mm", &curve, 1, false, false);
  if (film != NULL) {
    const SbCellCurve below = {
        .name = "", .x = place, .y = lower, .count = count, .role = SB_ROLE_FLUID};
    sb_chart_curves(&sheet.cells, (SbCellRect){sheet.rect.x + width + 2, 1, width, ROWS},
                    &sheet.theme, "Film / nm over mm", &below, 1, false, true);
  }
  end(&sheet);
}

void sb_cli_plot_histogram(int figure, const double *value, size_t count, size_t stride,
                           const SbLimits *limits) {
  const SbFigure *of = sb_figure(figure);
  g_autofree double *shown = g_new(double, count + 1);
  for (size_t i = 0; i < count; i++) {
    shown[i] = sb_quantity_to_shown(value[i * stride], of->si, of->shown);
  }
  double low = -INFINITY, high = INFINITY;
  for (size_t i = 0; i < limits->count; i++) {
    if (limits->item[i].figure == figure) {
      low = sb_quantity_to_shown(limits->item[i].low, of->si, of->shown);
      high = sb_quantity_to_shown(limits->item[i].high, of->si, of->shown);
    }
  }
  g_autofree char *label = sb_figure_label(figure);
  g_autofree char *head =
      of->shown[0] != '\0' ? g_strdup_printf("%s / %s", label, of->shown) : g_strdup(label);
  Sheet sheet;
  begin(&sheet, ROWS - 6);
  sb_chart_histogram(&sheet.cells, sheet.rect, &sheet.theme, head, shown, count, low, high);
  end(&sheet);
}
