// Ticks at 1-2-5 times powers of ten. Between two neighbouring steps of that series the ratio is at
// most 2.5, so a range that shows nine marks at one step shows at least three at the next: three to
// eight can always be had. Leaves out time axes and minor marks.
#include "app/draw/axis.h"
#include "app/base/format.h"

#include <math.h>
#include <stdlib.h>

void sb_axis_repair(double *lo, double *hi) {
  bool a = isfinite(*lo), b = isfinite(*hi);
  if (!a && !b) {
    *lo = 0;
    *hi = 1;
    return;
  }
  if (!a) {
    *lo = *hi;
  }
  if (!b) {
    *hi = *lo;
  }
  if (*lo > *hi) {
    double t = *lo;
    *lo = *hi;
    *hi = t;
  }
  // Keep sums of a few such numbers finite.
  *lo = fmax(*lo, -1e300);
  *hi = fmin(*hi, 1e300);
  if (*lo > *hi) {
    *lo = *hi = *lo > 0 ? 1e300 : -1e300;
  }
  double size = fmax(fabs(*lo), fabs(*hi));
  if (*hi - *lo <= 1e-10 * size || *hi - *lo < 1e-290) {
    double half = size > 1e-280 ? 0.5 * size : 0.5;
    double mid = 0.5 * *lo + 0.5 * *hi;
    *lo = mid - half;
    *hi = mid + half;
  }
}

double sb_axis_at(const SbScale *scale, double value) {
  double t;
  if (scale->logarithmic) {
    double lo = log10(scale->lo), hi = log10(scale->hi);
    t = value > 0 ? (log10(value) - lo) / (hi - lo) : -10;
    t = fmax(t, -10);
  } else {
    t = (value - scale->lo) / (scale->hi - scale->lo);
  }
  // A value far out stays far out, at a distance that drawing survives (dashes!).
  t = t > 1000 ? 1000 : t < -1000 ? -1000 : t;
  return scale->p0 + t * (scale->p1 - scale->p0);
}

double sb_axis_value(const SbScale *scale, double pixel) {
  double t = (pixel - scale->p0) / (scale->p1 - scale->p0);
  if (scale->logarithmic) {
    double lo = log10(scale->lo), hi = log10(scale->hi);
    return pow(10, lo + t * (hi - lo));
  }
  return scale->lo + t * (scale->hi - scale->lo);
}

// The n-th member of ..., 0.1, 0.2, 0.5, 1, 2, 5, 10, ...; n = 0 is 1.
static double series(int n) {
  static const double mantissa[3] = {1, 2, 5};
  int decade = n >= 0 ? n / 3 : -((2 - n) / 3);
  double power = pow(10, abs(decade) > 0 ? fabs((double)decade) : 0);
  double m = mantissa[n - 3 * decade];
  return decade >= 0 ? m * power : m / power;
}

static long count_marks(double lo, double hi, double step) {
  const double slack = 1e-9;
  double first = ceil(lo / step - slack), last = floor(hi / step + slack);
  double n = last - first + 1;
  return n < 0 ? 0 : n > 1000 ? 1000 : (long)n;
}

// Index in the series of the step to use.
static int choose_step(double lo, double hi, int wanted) {
  int start = 3 * (int)floor(log10((hi - lo) / 10)) - 1;
  int best = start;
  long best_miss = -1;
  for (int n = start; n <= start + 9; n++) {
    long marks = count_marks(lo, hi, series(n));
    if (marks < 3 || marks > 8) {
      continue;
    }
    long miss = labs(marks - wanted);
    if (best_miss < 0 || miss < best_miss) {
      best = n;
      best_miss = miss;
    }
  }
  return best;
}

static int decimals_of_step(int n) {
  int decade = n >= 0 ? n / 3 : -((2 - n) / 3);
  return decade >= 0 ? 0 : -decade;
}

void sb_axis_ticks(SbTicks *out, double lo, double hi, int wanted) {
  sb_axis_repair(&lo, &hi);
  int n = choose_step(lo, hi, wanted);
  double step = series(n);
  const double slack = 1e-9;
  double first = ceil(lo / step - slack);
  long marks = count_marks(lo, hi, step);
  out->step = step;
  out->decimals = decimals_of_step(n);
  out->count = (int)(marks > SB_TICKS_MAX ? SB_TICKS_MAX : marks);
  for (int i = 0; i < out->count; i++) {
    double multiple = first + i;
    out->value[i] = multiple == 0 ? 0 : multiple * step;
  }
}

void sb_axis_round_out(double *lo, double *hi, int wanted) {
  sb_axis_repair(lo, hi);
  double step = series(choose_step(*lo, *hi, wanted));
  const double slack = 1e-9;
  *lo = floor(*lo / step + slack) * step;
  *hi = ceil(*hi / step - slack) * step;
}

void sb_axis_log_ticks(SbTicks *out, double lo, double hi) {
  if (!(hi > 0) || !isfinite(hi)) {
    hi = isfinite(lo) && lo > 0 ? lo * 10 : 1;
  }
  if (!(lo > 0) || !isfinite(lo) || lo > hi) {
    lo = hi / 1000;
  }
  double a = log10(lo), b = log10(hi);
  if (b - a < 0.5) {
    // Too short for marks of a logarithmic kind: linear ones are honest here.
    sb_axis_ticks(out, lo, hi, 5);
    return;
  }
  const double slack = 1e-9;
  out->step = 0;
  out->count = 0;
  out->decimals = 0;
  int first = (int)ceil(a - slack), last = (int)floor(b + slack);
  if (last - first + 1 >= 3) {
    int stride = 1;
    while ((last - first) / stride + 1 > 8) {
      stride++;
    }
    for (int d = first; d <= last; d += stride) {
      out->value[out->count++] = pow(10, d);
    }
    return;
  }
  // One or two decades: 1-2-5, at most eight.
  for (int n = 3 * ((int)floor(a) - 1); out->count < 8 && n < 3 * ((int)ceil(b) + 1); n++) {
    double v = series(n);
    if (log10(v) >= a - slack && log10(v) <= b + slack) {
      out->value[out->count++] = v;
    }
  }
}

void sb_axis_draw(SbCanvas *c, SbRect plot, const SbScale *x, const SbTicks *x_ticks,
                  const SbScale *y, const SbTicks *y_ticks) {
  char text[SB_FORMAT_MAX];
  SbTextStyle label = sb_canvas_style(c, SB_TYPE_LABEL, 400, SB_ROLE_SECOND);
  double right = plot.x + plot.width, bottom = plot.y + plot.height;
  for (int i = 0; i < y_ticks->count; i++) {
    double at = sb_axis_at(y, y_ticks->value[i]);
    sb_canvas_hairline(c, plot.x, at, right, at, sb_canvas_role(c, SB_ROLE_GRID));
    sb_format_fixed(text, y_ticks->value[i], y_ticks->decimals);
    sb_canvas_text(c, text, &label, plot.x - 8, at + 4.3, SB_RIGHT);
  }
  for (int i = 0; i < x_ticks->count; i++) {
    double at = sb_axis_at(x, x_ticks->value[i]);
    sb_canvas_hairline(c, at, bottom, at, bottom + 5, sb_canvas_role(c, SB_ROLE_AXIS));
    sb_format_fixed(text, x_ticks->value[i], x_ticks->decimals);
    sb_canvas_text(c, text, &label, floor(at) + 0.5, bottom + 18, SB_MIDDLE);
  }
}
