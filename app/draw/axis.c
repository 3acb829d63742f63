// Ticks at 1-2-5 times powers of ten. Between two neighbouring steps of that series the ratio is at
// most 2.5, so a range that shows nine marks at one step shows at least three at the next: three to
// eight can always be had.
#include "app/draw/axis.h"
#include "app/base/format.h"

#include <glib.h>
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

void sb_axis_text(char *out, const SbTicks *ticks, double value) {
  if (ticks->step > 0) {
    const double most = fmax(fabs(ticks->value[0]), fabs(ticks->value[ticks->count - 1]));
    const int exponent = most > 0 ? (int)floor(log10(most) + 1e-9) : 0;
    if (value == 0 || (exponent > -4 && exponent < 6)) {
      sb_format_fixed(out, value, ticks->decimals);
      return;
    }
    char number[SB_FORMAT_MAX], power[SB_FORMAT_MAX];
    sb_format_fixed(number, value / pow(10, exponent), MAX(ticks->decimals + exponent, 0));
    g_snprintf(out, SB_FORMAT_MAX, "%s\xc2\xb7%s", number, sb_format_power(power, exponent));
  } else if (value >= 0.999e-3 && value < 1.001e4) {
    sb_format_digits(out, value, 1);
  } else {
    const int exponent = (int)floor(log10(value) + 1e-9);
    const double mantissa = value / pow(10, exponent);
    char power[SB_FORMAT_MAX];
    sb_format_power(power, exponent);
    if (mantissa < 1.5) {
      g_strlcpy(out, power, SB_FORMAT_MAX);
    } else {
      g_snprintf(out, SB_FORMAT_MAX, "%.0f\xc2\xb7%s", mantissa, power);
    }
  }
}

void sb_axes_linear(SbAxes *axes, SbRect plot, double x0, double x1, double y0, double y1) {
  axes->plot = plot;
  axes->x = (SbScale){x0, x1, plot.x, plot.x + plot.width, false};
  axes->y = (SbScale){y0, y1, plot.y + plot.height, plot.y, false};
}

static void set_ticks(SbTicks *out, const SbScale *scale, int wanted) {
  if (wanted == 0) {
    out->count = 0;
  } else if (scale->logarithmic) {
    sb_axis_log_ticks(out, scale->lo, scale->hi);
  } else {
    sb_axis_ticks(out, scale->lo, scale->hi, wanted);
  }
}

void sb_axes_ticks(SbAxes *axes, int x, int y) {
  set_ticks(&axes->x_ticks, &axes->x, x);
  set_ticks(&axes->y_ticks, &axes->y, y);
}

SbPoint sb_axes_at(const SbAxes *axes, double x, double y) {
  return (SbPoint){sb_axis_at(&axes->x, x), sb_axis_at(&axes->y, y)};
}

bool sb_axes_inside(const SbAxes *axes, double x, double y, double margin) {
  const SbRect r = axes->plot;
  return x >= r.x - margin && x <= r.x + r.width + margin && y >= r.y - margin &&
         y <= r.y + r.height + margin;
}

// Lines across the plot with their numbers.
static void draw_y(SbCanvas *c, const SbAxes *axes, SbLabels *labels) {
  const SbTextStyle style = sb_canvas_style(c, SB_TYPE_LABEL, 400, SB_ROLE_SECOND);
  const SbRect r = axes->plot;
  const double right = r.x + r.width, bottom = r.y + r.height;
  for (int i = 0; i < axes->y_ticks.count; i++) {
    const double value = axes->y_ticks.value[i], y = sb_axis_at(&axes->y, value);
    if (y < r.y - 0.5 || y > bottom + 0.5) {
      continue;
    }
    sb_canvas_hairline(c, r.x, y, right, y, sb_canvas_role(c, SB_ROLE_GRID));
    if (labels != NULL) {
      sb_labels_avoid(labels, (SbPoint[]){{r.x, y}, {right, y}}, 2, 0.01);
    }
    if (!axes->bare) {
      char text[SB_FORMAT_MAX];
      (axes->y_text != NULL ? axes->y_text : sb_axis_text)(text, &axes->y_ticks, value);
      sb_canvas_text(c, text, &style, r.x - 8, y + 4.3, SB_RIGHT);
    }
  }
}

// Short lines below the plot, and up to the next step.
static void draw_marks(SbCanvas *c, const SbAxes *axes, double value) {
  const SbColor color = sb_canvas_role(c, axes->upright ? SB_ROLE_GRID : SB_ROLE_AXIS);
  const double x = sb_axis_at(&axes->x, value), bottom = axes->plot.y + axes->plot.height;
  sb_canvas_hairline(c, x, axes->upright ? axes->plot.y : bottom, x,
                     axes->upright ? bottom : bottom + 5, color);
  for (int k = 1; k < axes->minor; k++) {
    const double between = value + k * axes->x_ticks.step / axes->minor;
    const double at = sb_axis_at(&axes->x, between);
    if (between < axes->x.hi && at - x > 5.0 * k) {
      sb_canvas_hairline(c, at, bottom, at, bottom + 3, color);
    }
  }
}

static void draw_x(SbCanvas *c, const SbAxes *axes) {
  const SbTextStyle style = sb_canvas_style(c, SB_TYPE_LABEL, 400, SB_ROLE_SECOND);
  const SbRect r = axes->plot, card = axes->card;
  const double bottom = r.y + r.height;
  double free_from = -INFINITY;
  for (int i = 0; i < axes->x_ticks.count; i++) {
    const double value = axes->x_ticks.value[i];
    char text[SB_FORMAT_MAX];
    draw_marks(c, axes, value);
    (axes->x_text != NULL ? axes->x_text : sb_axis_text)(text, &axes->x_ticks, value);
    const double half = 0.5 * sb_canvas_text_width(c, text, &style);
    double x = floor(sb_axis_at(&axes->x, value)) + 0.5;
    if (card.width > 0) {
      x = fmax(fmin(x, card.x + card.width - half), card.x + half);
    }
    if (x - half >= free_from) {
      sb_canvas_text(c, text, &style, x, bottom + 18, SB_MIDDLE);
      free_from = x + half + 6;
    }
  }
  if (axes->x_name != NULL) {
    const double left = r.x + r.width - sb_canvas_text_width(c, axes->x_name, &style);
    const double first = card.width > 0 ? fmax(left, card.x + 12) : left;
    const double end = card.width > 0 ? card.x + card.width - 12 : r.x + r.width + 1;
    sb_canvas_text_fit(c, axes->x_name, &style, first, bottom + 36, end - first);
  }
}

void sb_axes_draw(SbCanvas *c, const SbAxes *axes, SbLabels *labels) {
  const SbColor color = sb_canvas_role(c, SB_ROLE_AXIS);
  const double left = axes->plot.x, right = left + axes->plot.width;
  const double bottom = axes->plot.y + axes->plot.height;
  draw_y(c, axes, labels);
  if (!axes->upright) {
    sb_canvas_hairline(c, left, bottom, right, bottom, color);
  }
  const double zero = axes->y_ticks.count > 0 ? sb_axis_at(&axes->y, 0) : bottom;
  if (zero > axes->plot.y + 1 && zero < bottom - 1) {
    sb_canvas_hairline(c, left, zero, right, zero, color);
  }
  draw_x(c, axes);
}
