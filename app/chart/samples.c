// Histogram and bars on a panel each. The histogram's bins are of one width between the least and
// the greatest value, as many as the square root of their number allows, and a limit is always in
// sight.
#include "app/chart/samples.h"

#include "app/base/format.h"
#include "app/base/unit.h"
#include "app/draw/axis.h"

#include <glib/gi18n.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { BINS_MIN = 8, BINS_MAX = 40 };

static void draw_title(SbCanvas *c, SbRect rect, const char *title, const char *note) {
  sb_canvas_panel(c, rect);
  const SbTextStyle bold = sb_canvas_style(c, 13, 700, SB_ROLE_INK);
  const SbTextStyle plain = sb_canvas_style(c, SB_TYPE_NOTE, 400, SB_ROLE_SECOND);
  const double width = rect.width - 28;
  sb_canvas_text_fit(c, title, &bold, rect.x + 14, rect.y + 22, width);
  if (note != NULL) {
    sb_canvas_text_fit(c, note, &plain, rect.x + 14, rect.y + 38, width);
  }
}

// ---- Histogram ----

typedef struct {
  size_t count, beyond;
  double lo, hi; // of the axis, in the unit that people read
  int bins;
  double share[BINS_MAX], most, width;
} Bins;

static double shown_of(const SbHistogram *of, double value) {
  return sb_quantity_to_shown(value, of->si, of->unit);
}

static void fill_samples(Bins *bins, const SbHistogram *of) {
  double least = INFINITY, greatest = -INFINITY;
  *bins = (Bins){0};
  for (size_t i = 0; i < of->count; i++) {
    const double value = of->value[i * of->stride];
    if (isfinite(value)) {
      least = fmin(least, value);
      greatest = fmax(greatest, value);
      bins->count++;
      bins->beyond += value < of->low || value > of->high;
    }
  }
  if (bins->count == 0) {
    return;
  }
  double lo = shown_of(of, least), hi = shown_of(of, greatest);
  sb_axis_repair(&lo, &hi);
  bins->bins = (int)fmin(fmax(sqrt((double)bins->count), BINS_MIN), BINS_MAX);
  bins->width = (hi - lo) / bins->bins;
  bins->lo = lo;
  bins->hi = hi;
  for (size_t i = 0; i < of->count; i++) {
    const double value = of->value[i * of->stride];
    if (isfinite(value)) {
      const int at = (int)((shown_of(of, value) - lo) / bins->width);
      bins->share[at < 0 ? 0 : at >= bins->bins ? bins->bins - 1 : at] += 1.0 / (double)bins->count;
    }
  }
  for (int k = 0; k < bins->bins; k++) {
    bins->most = fmax(bins->most, bins->share[k]);
  }
}

static void draw_limit(SbCanvas *c, SbRect plot, const SbScale *x, double at) {
  if (isfinite(at)) {
    const double px = sb_axis_at(x, at);
    sb_canvas_line(c, (SbStroke){SB_ROLE_ERROR, 1.6, &sb_dash_reference}, px, plot.y, px,
                   plot.y + plot.height);
  }
}

// Parts of a bar on either side of a limit have each their colour.
static void draw_bar(SbCanvas *c, SbRect plot, const SbScale *x, double from, double to,
                     double height, double low, double high) {
  const double edge[] = {from, fmin(fmax(low, from), to), fmax(fmin(high, to), from), to};
  for (int part = 0; part < 3; part++) {
    const double a = sb_axis_at(x, edge[part]), b = sb_axis_at(x, edge[part + 1]);
    if (b > a) {
      sb_canvas_fill(c, (SbRect){a + 0.4, plot.y + plot.height - height, b - a - 0.8, height},
                     part == 1 ? SB_ROLE_OUTER : SB_ROLE_ERROR, 0.85);
    }
  }
}

void sb_histogram_draw(cairo_t *cr, SbRect rect, const SbTheme *theme, const SbHistogram *of) {
  SbCanvas canvas;
  SbCanvas *c = &canvas;
  sb_canvas_init(c, cr, theme);
  Bins bins;
  fill_samples(&bins, of);
  char note[120];
  if (bins.count == 0) {
    g_strlcpy(note, _("no sample has a value"), sizeof note);
  } else if (isfinite(of->low) || isfinite(of->high)) {
    g_snprintf(note, sizeof note, _("%zu of %zu beyond the limit"), bins.beyond, bins.count);
  } else {
    g_snprintf(note, sizeof note, _("%zu samples"), bins.count);
  }
  draw_title(c, rect, of->title, note);
  if (bins.count == 0) {
    sb_canvas_finish(c);
    return;
  }
  const SbRect plot = {rect.x + 46, rect.y + 60, rect.width - 64, rect.height - 60 - 42};
  const double low = isfinite(of->low) ? shown_of(of, of->low) : -INFINITY;
  const double high = isfinite(of->high) ? shown_of(of, of->high) : INFINITY;
  SbAxes at = {.x_name = of->unit};
  sb_axes_linear(&at, plot, isfinite(low) ? fmin(bins.lo, low - bins.width) : bins.lo,
                 isfinite(high) ? fmax(bins.hi, high + bins.width) : bins.hi, 0, 108 * bins.most);
  sb_axes_ticks(&at, 5, 3);
  sb_axes_draw(c, &at, NULL);
  for (int k = 0; k < bins.bins; k++) {
    draw_bar(c, plot, &at.x, bins.lo + k * bins.width, bins.lo + (k + 1) * bins.width,
             plot.y + plot.height - sb_axis_at(&at.y, 100 * bins.share[k]), low, high);
  }
  draw_limit(c, plot, &at.x, low);
  draw_limit(c, plot, &at.x, high);
  const SbTextStyle style = sb_canvas_style(c, SB_TYPE_NOTE, 400, SB_ROLE_SECOND);
  sb_canvas_text(c, "%", &style, plot.x - 8, plot.y - 6, SB_RIGHT);
  sb_canvas_finish(c);
}

// ---- Tornado ----

static int by_size(const void *a, const void *b, void *of) {
  const SbTornado *tornado = of;
  const double x = fabs(tornado->bar[*(const size_t *)a].value);
  const double y = fabs(tornado->bar[*(const size_t *)b].value);
  return x < y ? 1 : x > y ? -1 : 0;
}

void sb_tornado_draw(cairo_t *cr, SbRect rect, const SbTheme *theme, const SbTornado *of) {
  SbCanvas canvas;
  SbCanvas *c = &canvas;
  sb_canvas_init(c, cr, theme);
  draw_title(c, rect, of->title, of->note);
  size_t order[SB_TORNADO_MAX * 4], count = 0;
  double most = 0;
  bool negative = false;
  for (size_t i = 0; i < of->count; i++) {
    if (isfinite(of->bar[i].value)) {
      order[count++] = i;
      most = fmax(most, fmax(fabs(of->bar[i].value), isnan(of->bar[i].high) ? 0 : of->bar[i].high));
      negative |= of->bar[i].value < 0;
    }
  }
  g_qsort_with_data(order, (int)count, sizeof *order, by_size, (gpointer)of);
  const double top = rect.y + 54, names = fmin(190, 0.42 * rect.width);
  const size_t rows = (size_t)fmax(fmin((rect.height - 64) / 18, SB_TORNADO_MAX), 1);
  const SbRect plot = {rect.x + 14 + names, top, rect.width - names - 28 - 54, rect.height - 64};
  const SbScale x = {negative ? -most : 0, most > 0 ? most : 1, plot.x, plot.x + plot.width, false};
  const SbTextStyle name = sb_canvas_style(c, SB_TYPE_NOTE, 400, SB_ROLE_INK);
  const double zero = sb_axis_at(&x, 0);
  for (size_t k = 0; k < count && k < rows; k++) {
    const double y = top + 18 * (double)k, value = of->bar[order[k]].value;
    const double end = sb_axis_at(&x, value);
    char digits[SB_FORMAT_MAX];
    sb_canvas_text_fit_ends(c, of->bar[order[k]].name, &name, rect.x + 14, y + 10, names - 8);
    sb_canvas_fill(c, (SbRect){fmin(zero, end), y, fabs(end - zero), 13},
                   value < 0 ? SB_ROLE_INNER : SB_ROLE_OUTER, 0.85);
    if (isfinite(of->bar[order[k]].low) && isfinite(of->bar[order[k]].high)) {
      const double a = sb_axis_at(&x, fmax(of->bar[order[k]].low, x.lo));
      sb_canvas_line(c, (SbStroke){SB_ROLE_INK, 1.2, NULL}, a, y + 6.5,
                     sb_axis_at(&x, of->bar[order[k]].high), y + 6.5);
    }
    sb_format_digits(digits, value, 2);
    g_autofree char *text =
        g_strdup_printf("%s%s%s", digits, *of->unit != '\0' ? " " : "", of->unit);
    sb_canvas_text(c, text, &name, rect.x + rect.width - 12, y + 10, SB_RIGHT);
  }
  sb_canvas_hairline(c, zero, top - 4, zero, top + 18 * (double)(count < rows ? count : rows),
                     sb_canvas_role(c, SB_ROLE_AXIS));
  if (count == 0) {
    sb_canvas_text(c, _("no value depends on anything"), &name, rect.x + 14, top + 10, SB_LEFT);
  }
  sb_canvas_finish(c);
}
