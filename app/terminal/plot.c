// Curves in cells. See plot.h.
#include "app/terminal/plot.h"

#include "app/base/format.h"

#include <glib.h>
#include <math.h>
#include <string.h>

enum { ACROSS = 2, DOWN = 4 }; // dots of a cell

void sb_plot_init(SbPlot *plot, SbCells *cells, SbCellRect rect, const SbScale *x,
                  const SbScale *y) {
  rect.width = MAX(rect.width, 1);
  rect.height = MAX(rect.height, 1);
  *plot = (SbPlot){.cells = cells, .rect = rect, .x = *x, .y = *y};
  sb_axis_repair(&plot->x.lo, &plot->x.hi);
  sb_axis_repair(&plot->y.lo, &plot->y.hi);
  plot->x.p0 = 0;
  plot->x.p1 = ACROSS * rect.width - 1;
  plot->y.p0 = DOWN * rect.height - 1;
  plot->y.p1 = 0;
  const size_t count = (size_t)rect.width * (size_t)rect.height;
  plot->dots = g_new0(uint8_t, count);
  plot->ink = g_new0(uint32_t, count);
  plot->rank = g_new0(uint8_t, count);
  plot->boldness = g_new0(uint8_t, count);
}

static void tick_text(char *out, const SbScale *scale, const SbTicks *ticks, double value) {
  if (scale->logarithmic) {
    sb_format_power(out, (int)lround(log10(value)));
  } else {
    sb_format_fixed(out, value, ticks->decimals);
  }
}

void sb_plot_axes(SbPlot *plot, SbCells *cells, SbCellRect rect, const SbScale *x, const SbScale *y,
                  uint32_t ink) {
  const SbPen pen = {ink, SB_CELL_OWN, 0};
  SbScale sx = *x, sy = *y;
  sb_axis_repair(&sx.lo, &sx.hi);
  sb_axis_repair(&sy.lo, &sy.hi);
  SbTicks tx, ty;
  char text[SB_FORMAT_MAX];
  const int wanted = CLAMP(rect.height / 4, 2, 8);
  if (sy.logarithmic) {
    sb_axis_log_ticks(&ty, sy.lo, sy.hi);
  } else {
    sb_axis_ticks(&ty, sy.lo, sy.hi, wanted);
  }
  int margin = 1;
  for (int i = 0; i < ty.count; i++) {
    tick_text(text, &sy, &ty, ty.value[i]);
    margin = MAX(margin, sb_cells_width(cells, text));
  }
  margin = MIN(margin, rect.width / 3);
  const SbCellRect dots = {rect.x + margin + 1, rect.y, rect.width - margin - 1, rect.height - 1};
  sb_plot_init(plot, cells, dots, &sx, &sy);
  // Numbers of y at their rows, of x below, as many as do not touch.
  int free_row = INT_MAX;
  for (int i = 0; i < ty.count; i++) {
    const int row = dots.y + (int)(sb_axis_at(&plot->y, ty.value[i]) / DOWN);
    if (row < free_row && row >= dots.y && row < dots.y + dots.height) {
      tick_text(text, &sy, &ty, ty.value[i]);
      sb_cells_text_right(cells, rect.x, row, margin, text, pen);
      free_row = row;
    }
  }
  if (sx.logarithmic) {
    sb_axis_log_ticks(&tx, sx.lo, sx.hi);
  } else {
    sb_axis_ticks(&tx, sx.lo, sx.hi, CLAMP(dots.width / 6, 2, 8));
  }
  int free_column = rect.x;
  for (int i = 0; i < tx.count; i++) {
    tick_text(text, &sx, &tx, tx.value[i]);
    const int width = sb_cells_width(cells, text);
    const int column = dots.x + (int)(sb_axis_at(&plot->x, tx.value[i]) / ACROSS) - width / 2;
    if (column >= free_column && column + width <= rect.x + rect.width) {
      sb_cells_text(cells, column, rect.y + rect.height - 1, width, text, pen);
      free_column = column + width + 1;
    }
  }
}

// Dots ------------------------------------------------------------------------------------------

static void set_dot(SbPlot *plot, int x, int y, const SbPlotLine *line) {
  static const uint8_t bit[DOWN][ACROSS] = {{1, 8}, {2, 16}, {4, 32}, {64, 128}};
  if (x < 0 || y < 0 || x >= ACROSS * plot->rect.width || y >= DOWN * plot->rect.height) {
    return;
  }
  const size_t at = (size_t)(y / DOWN) * (size_t)plot->rect.width + (size_t)(x / ACROSS);
  if (plot->dots[at] == 0 || line->rank >= plot->rank[at]) {
    plot->ink[at] = line->ink;
    plot->rank[at] = line->rank;
    plot->boldness[at] = line->style;
  }
  plot->dots[at] |= bit[y % DOWN][x % ACROSS];
}

// Clips a line to the dots; false if nothing of it is there (Liang and Barsky 1984).
static bool clip(const SbPlot *plot, double *x0, double *y0, double *x1, double *y1) {
  const double dx = *x1 - *x0, dy = *y1 - *y0;
  const double p[] = {-dx, dx, -dy, dy};
  const double q[] = {*x0 + 1, ACROSS * plot->rect.width - *x0, *y0 + 1,
                      DOWN * plot->rect.height - *y0};
  double from = 0, to = 1;
  for (int i = 0; i < 4; i++) {
    if (p[i] == 0) {
      if (q[i] < 0) {
        return false;
      }
    } else if (p[i] < 0) {
      from = fmax(from, q[i] / p[i]);
    } else {
      to = fmin(to, q[i] / p[i]);
    }
  }
  *x1 = *x0 + to * dx;
  *y1 = *y0 + to * dy;
  *x0 += from * dx;
  *y0 += from * dy;
  return from <= to;
}

void sb_plot_curve(SbPlot *plot, const double *x, const double *y, size_t count,
                   const SbPlotLine *line) {
  int step = 0; // dots along the curve, for dashes
  bool open = false;
  double px = 0, py = 0;
  for (size_t i = 0; i < count; i++) {
    const bool good = isfinite(x[i]) && isfinite(y[i]) && !(plot->x.logarithmic && x[i] <= 0) &&
                      !(plot->y.logarithmic && y[i] <= 0);
    const double nx = good ? sb_axis_at(&plot->x, x[i]) : 0;
    const double ny = good ? sb_axis_at(&plot->y, y[i]) : 0;
    double x0 = open ? px : nx, y0 = open ? py : ny, x1 = nx, y1 = ny;
    if (good && clip(plot, &x0, &y0, &x1, &y1)) {
      const int steps = (int)ceil(fmax(fabs(x1 - x0), fabs(y1 - y0)));
      for (int k = open && steps > 0 ? 1 : 0; k <= steps; k++, step++) {
        const double share = steps > 0 ? (double)k / steps : 0;
        if (line->off == 0 || step % (line->on + line->off) < line->on) {
          set_dot(plot, (int)lround(x0 + share * (x1 - x0)), (int)lround(y0 + share * (y1 - y0)),
                  line);
        }
      }
    }
    open = good;
    px = nx;
    py = ny;
  }
}

bool sb_plot_cell(const SbPlot *plot, double x, double y, int *column, int *row) {
  if (!isfinite(x) || !isfinite(y)) {
    return false;
  }
  const double px = sb_axis_at(&plot->x, x), py = sb_axis_at(&plot->y, y);
  *column = plot->rect.x + (int)floor((px + 0.5) / ACROSS);
  *row = plot->rect.y + (int)floor((py + 0.5) / DOWN);
  return px >= -0.5 && py >= -0.5 && px < ACROSS * plot->rect.width &&
         py < DOWN * plot->rect.height;
}

void sb_plot_finish(SbPlot *plot) {
  for (int y = 0; y < plot->rect.height; y++) {
    for (int x = 0; x < plot->rect.width; x++) {
      const size_t at = (size_t)y * (size_t)plot->rect.width + (size_t)x;
      if (plot->dots[at] != 0) {
        sb_cells_put(plot->cells, plot->rect.x + x, plot->rect.y + y, 0x2800u + plot->dots[at],
                     (SbPen){plot->ink[at], SB_CELL_OWN, plot->boldness[at]});
      }
    }
  }
  g_clear_pointer(&plot->dots, g_free);
  g_clear_pointer(&plot->ink, g_free);
  g_clear_pointer(&plot->rank, g_free);
  g_clear_pointer(&plot->boldness, g_free);
}

// Labels ----------------------------------------------------------------------------------------

// How much a text hides from (column, row) on: text counts more than dots; -1: no room.
static int hidden(const SbCells *cells, SbCellRect within, int column, int row, int width) {
  if (column < within.x || row < within.y || column + width > within.x + within.width ||
      row >= within.y + within.height) {
    return -1;
  }
  int sum = 0;
  // A column of air on either side keeps it from running into other text.
  for (int i = -1; i <= width; i++) {
    const uint32_t glyph = sb_cells_at(cells, column + i, row);
    const bool dots = glyph > 0x2800 && glyph < 0x2900;
    const bool air = i < 0 || i == width;
    sum += glyph == 0 || glyph == ' ' ? 0 : dots || cells->ascii ? (air ? 1 : 4) : 40;
  }
  return sum;
}

void sb_plot_label(SbCells *cells, SbCellRect within, int column, int row, const char *text,
                   SbPen pen) {
  const int width = sb_cells_width(cells, text);
  const int place[][2] = {{1, -1},         {2, 0},       {-width / 2, -1}, {-width, -1},
                          {-width - 1, 0}, {1, 1},       {-width / 2, 1},  {-width, 1},
                          {1, -2},         {-width, -2}, {1, 2},           {-width, 2}};
  int best = -1, least = 30;
  for (int i = 0; i < (int)G_N_ELEMENTS(place); i++) {
    const int sum = hidden(cells, within, column + place[i][0], row + place[i][1], width);
    if (sum >= 0 && sum < least) {
      best = i;
      least = sum;
    }
  }
  if (best >= 0) {
    sb_cells_text(cells, column + place[best][0], row + place[best][1], width, text, pen);
  }
}
