// The calibration page; see the header. Loops share one scale; at most three of them and five
// parameters' pairs are drawn, the table has all. Densities are sums of Gaussians over the samples
// (Silverman's width); the ellipses are those that hold 50 and 95 % of a normal posterior.
#include "app/chart/calibration.h"

#include "app/base/format.h"
#include "app/chart/measured_loop.h"
#include "app/chart/page.h"
#include "app/draw/axis.h"
#include "app/draw/frame.h"

#include <glib.h>
#include <glib/gi18n.h>
#include <math.h>

enum { LOOPS_MAX = 3, PAIRS_MAX = 5, DOTS = 260 };

typedef struct {
  SbCanvas canvas;
  const SbCalibrationView *view;
} Draw;

// ---- Loops ----

static void loop_line(Draw *d, const SbAxes *at, const SbLoop *loop, bool after) {
  SbCanvas *c = &d->canvas;
  sb_canvas_stroke(c, after ? (SbStroke){SB_ROLE_INNER, SB_LINE_SEAL, NULL}
                            : (SbStroke){SB_ROLE_PINNED, SB_LINE_PINNED, &sb_dash_reference});
  for (int way = 0; way < 2; way++) {
    g_autofree SbPoint *p = g_new(SbPoint, loop->count[way] + 1);
    for (size_t i = 0; i < loop->count[way]; i++) {
      p[i] = sb_axes_at(at, 1e3 * loop->displacement[way][i], loop->force[way][i]);
    }
    sb_canvas_polyline(c, p, loop->count[way]);
  }
}

static void include(double *low, double *high, const SbMeasuredBand *of) {
  for (int i = 0; i < 2 * SB_MEASURED_BAND && of->end > 0; i++) {
    const double *pair = of->force[i / SB_MEASURED_BAND][i % SB_MEASURED_BAND];
    *low = fmin(pair[0], *low);
    *high = fmax(pair[1], *high);
  }
}

// Shared ranges of the loops: displacement [mm], force, residual.
typedef struct {
  double x, low, high, residual;
} Ranges;

static Ranges ranges_of(const SbCalibrationView *view) {
  Ranges r = {.x = 1, .low = 0, .high = 1, .residual = 1e-3};
  for (size_t k = 0; k < MIN(view->loops, LOOPS_MAX); k++) {
    const SbComparison *of = view->loop[k].comparison;
    include(&r.low, &r.high, view->loop[k].prior);
    for (size_t i = 0; of != NULL && i < of->count; i++) {
      r.x = fmax(r.x, 1e3 * of->point[i].displacement);
      r.low = fmin(r.low, of->point[i].force);
      r.high = fmax(r.high, of->point[i].force);
    }
    r.residual = of != NULL && isfinite(of->most) ? fmax(r.residual, of->most) : r.residual;
  }
  return r;
}

static void draw_loop(Draw *d, SbRect rect, size_t index, const Ranges *r) {
  SbCanvas *c = &d->canvas;
  const SbCalibrationLoop *of = &d->view->loop[index];
  const SbTextStyle name = sb_canvas_style(c, SB_TYPE_LABEL, 700, SB_ROLE_INK);
  const SbTextStyle label = sb_canvas_style(c, SB_TYPE_LABEL, 400, SB_ROLE_SECOND);
  const SbRect plot = {rect.x, rect.y + 22, rect.width, rect.height - 22 - 178};
  const SbRect strip = {rect.x, plot.y + plot.height + 44, rect.width, 90};
  double low = r->low, high = r->high;
  sb_axis_round_out(&low, &high, 8);
  SbAxes at = {.x_name = NULL};
  sb_axes_linear(&at, plot, 0, r->x * 1.02, low, high);
  sb_axes_ticks(&at, 0, 8);
  sb_canvas_text_fit(c, of->name, &name, rect.x, rect.y + 12, rect.width);
  sb_axes_draw(c, &at, NULL);
  sb_axis_ticks(&at.x_ticks, 0, r->x, 6);
  sb_canvas_clip(c, plot);
  sb_measured_loop_band(c, &at, of->prior, SB_ROLE_PINNED, 0.25);
  sb_measured_loop_band(c, &at, of->posterior, SB_ROLE_INNER, 0.30);
  loop_line(d, &at, of->before, false);
  loop_line(d, &at, of->after, true);
  cairo_restore(c->cr);
  const SbComparison *points = of->comparison;
  if (points != NULL) {
    sb_measured_loop_points(c, &at, points);
  }
  sb_measured_loop_residuals(c, strip, &at, true, points, r->residual, 4);
  char before[SB_FORMAT_MAX], after[SB_FORMAT_MAX];
  g_autofree char *rms = points != NULL && isfinite(of->before_rms)
                             ? g_strdup_printf(_("rms %s \xe2\x86\x92 %s"),
                                               sb_format_digits(before, of->before_rms, 3),
                                               sb_format_digits(after, points->rms, 3))
                             : g_strdup(_("does not slide"));
  sb_canvas_text(c, rms, &name, rect.x + rect.width, strip.y - 12, SB_RIGHT);
  if (index == 0) {
    sb_canvas_text_fit(c, _("measured \xe2\x88\x92 model / N"), &label, rect.x, strip.y - 12,
                       rect.width - 120);
  }
}

static void draw_loops(Draw *d, SbRect rect) {
  SbCanvas *c = &d->canvas;
  const SbTextStyle label = sb_canvas_style(c, SB_TYPE_LABEL, 400, SB_ROLE_SECOND);
  const size_t shown = MIN(d->view->loops, LOOPS_MAX);
  g_autofree char *note = g_strdup_printf(
      _("force on the stem / N; grey: before, blue: after, bands contain 95 %% of the model%s"),
      shown < d->view->loops ? _("; the first three") : "");
  sb_frame_title(c, rect, SB_TYPE_PANEL, _("Measured loops and model"), NULL);
  sb_canvas_text_fit(c, note, &label, rect.x, rect.y + 34, rect.width);
  const Ranges ranges = ranges_of(d->view);
  const double gap = 46, width = (rect.width - gap * (double)shown) / (double)MAX(shown, 1);
  for (size_t k = 0; k < shown; k++) {
    draw_loop(
        d, (SbRect){rect.x + gap + (double)k * (width + gap), rect.y + 56, width, rect.height - 56},
        k, &ranges);
  }
}

// ---- Parameters ----

#define CALIBRATION_ROW 30.0

static double table_height(const SbCalibrationView *view) {
  return 48 + CALIBRATION_ROW * (double)view->rows;
}

static void draw_table(Draw *d, SbRect rect) {
  SbCanvas *c = &d->canvas;
  const SbTextStyle head = sb_canvas_style(c, SB_TYPE_NOTE, 400, SB_ROLE_SECOND);
  const SbTextStyle text = sb_canvas_style(c, SB_TYPE_LABEL, 400, SB_ROLE_INK);
  const SbTextStyle strong = sb_canvas_style(c, SB_TYPE_LABEL, 700, SB_ROLE_INK);
  const double right = rect.x + rect.width;
  const double column[] = {rect.x + 0.43 * rect.width, rect.x + 0.535 * rect.width,
                           rect.x + 0.735 * rect.width};
  const double bar = rect.x + 0.76 * rect.width, bar_width = 0.09 * rect.width;
  sb_frame_title(c, rect, SB_TYPE_PANEL, _("Fitted parameters"), NULL);
  static const char *const heads[] = {N_("before"), N_("estimate"), N_("95 % interval")};
  for (int i = 0; i < 3; i++) {
    sb_canvas_text(c, _(heads[i]), &head, column[i], rect.y + 38, SB_RIGHT);
  }
  sb_canvas_text(c, _("narrowed to"), &head, bar, rect.y + 38, SB_LEFT);
  sb_canvas_text(c, _("identifiable"), &head, right, rect.y + 38, SB_RIGHT);
  for (size_t j = 0; j < d->view->rows; j++) {
    const SbCalibrationRow *row = &d->view->row[j];
    const double y = rect.y + 48 + CALIBRATION_ROW * (double)j, base = y + 20;
    sb_canvas_hairline(c, rect.x, y, right, y, sb_canvas_role(c, SB_ROLE_GRID));
    sb_canvas_text_fit(c, row->name, &text, rect.x, base, 0.32 * rect.width);
    for (int i = 0; i < 3; i++) {
      sb_canvas_text(c, row->texts[i], i == 1 ? &strong : &text, column[i], base, SB_RIGHT);
    }
    const double span = row->prior_high - row->prior_low;
    const double from = (row->low - row->prior_low) / span,
                 to = (row->high - row->prior_low) / span;
    sb_canvas_fill(c, (SbRect){bar, base - 7, bar_width, 5}, SB_ROLE_HAIRLINE, 1);
    sb_canvas_fill(c,
                   (SbRect){bar + bar_width * CLAMP(from, 0, 1), base - 7,
                            fmax(bar_width * (CLAMP(to, 0, 1) - CLAMP(from, 0, 1)), 2), 5},
                   SB_ROLE_INNER, 1);
    const double mark = bar + bar_width * CLAMP((row->before - row->prior_low) / span, 0, 1);
    sb_canvas_fill(c, (SbRect){mark - 0.7, base - 10, 1.4, 11}, SB_ROLE_SECOND, 1);
    const SbTextStyle told = sb_canvas_style(c, SB_TYPE_LABEL, 600, row->role);
    sb_canvas_text(c, row->identifiable, &told, right, base, SB_RIGHT);
  }
}

// The sentence in its box; its height.
static double draw_sentence(Draw *d, SbRect rect) {
  SbCanvas *c = &d->canvas;
  const bool all = d->view->all_identifiable;
  const SbTextStyle head =
      sb_canvas_style(c, SB_TYPE_LABEL, 700, all ? SB_ROLE_PASS : SB_ROLE_WARN);
  const SbTextStyle text = sb_canvas_style(c, SB_TYPE_LABEL, 400, SB_ROLE_INK);
  const double width = rect.width - 28;
  const double height = 42 + sb_canvas_paragraph_height(c, d->view->sentence, &text, width);
  sb_canvas_rounded(c, (SbRect){rect.x, rect.y, rect.width, height}, 5);
  sb_canvas_color(c, sb_canvas_role(c, all ? SB_ROLE_GRID : SB_ROLE_WARN_GROUND), 1);
  cairo_fill(c->cr);
  sb_canvas_paragraph(c, d->view->sentence, &text, rect.x + 14, rect.y + 30, width);
  sb_canvas_text(c, all ? _("What these data identify") : _("What these data do not identify"),
                 &head, rect.x + 14, rect.y + 20, SB_LEFT);
  return height;
}

// ---- Posterior ----

// Mean and deviation of a column of the samples.
static void moments(double *mean, double *deviation, const SbCalibrationView *view, size_t j) {
  double sum = 0, square = 0;
  for (size_t i = 0; i < view->samples; i++) {
    sum += view->sample[i * view->rows + j];
  }
  *mean = sum / (double)view->samples;
  for (size_t i = 0; i < view->samples; i++) {
    square += pow(view->sample[i * view->rows + j] - *mean, 2);
  }
  *deviation = sqrt(square / (double)view->samples);
}

static double prior_density(const SbDistribution *of, double x) {
  switch (of->kind) {
  case SB_DISTRIBUTION_UNIFORM:
    return x >= of->a && x <= of->b ? 1 / (of->b - of->a) : 0;
  case SB_DISTRIBUTION_LOGUNIFORM:
    return x >= of->a && x <= of->b ? 1 / (x * log(of->b / of->a)) : 0;
  default:
    return x >= of->low && x <= of->high
               ? exp(-0.5 * pow((x - of->a) / of->b, 2)) / (of->b * sqrt(2 * M_PI))
               : 0;
  }
}

static void draw_density(Draw *d, SbRect cell, size_t j, const SbScale *x) {
  enum { PLACES = 80 };
  SbCanvas *c = &d->canvas;
  const SbCalibrationView *view = d->view;
  double mean, deviation, value[PLACES] = {0}, most = 0;
  moments(&mean, &deviation, view, j);
  const double width = 1.06 * deviation * pow((double)view->samples, -0.2);
  const size_t step = view->samples / 2000 + 1;
  for (size_t i = 0; i < view->samples; i += step) {
    for (int k = 0; k < PLACES; k++) {
      const double at = x->lo + (x->hi - x->lo) * k / (PLACES - 1);
      value[k] += exp(-0.5 * pow((at - view->sample[i * view->rows + j]) / width, 2));
    }
  }
  const double scale = 1 / (width * sqrt(2 * M_PI) * ceil((double)view->samples / (double)step));
  SbPoint curve[PLACES + 2], before[PLACES];
  for (int k = 0; k < PLACES; k++) {
    value[k] *= scale;
    most = fmax(most, value[k]);
  }
  for (int k = 0; k < PLACES; k++) {
    const double at = x->lo + (x->hi - x->lo) * k / (PLACES - 1);
    const double px = sb_axis_at(x, at), foot = cell.y + cell.height;
    curve[k] = (SbPoint){px, foot - 0.92 * cell.height * value[k] / most};
    before[k] = (SbPoint){px, foot - 0.92 * cell.height *
                                         fmin(prior_density(view->row[j].prior, at) / most, 1.08)};
  }
  curve[PLACES] = (SbPoint){curve[PLACES - 1].x, cell.y + cell.height};
  curve[PLACES + 1] = (SbPoint){curve[0].x, cell.y + cell.height};
  sb_canvas_area(c, curve, PLACES + 2, SB_ROLE_INNER, c->theme->curve_fill);
  sb_canvas_curve(c, (SbStroke){SB_ROLE_INNER, SB_LINE_OUTLINE, NULL}, curve, PLACES);
  sb_canvas_curve(c, (SbStroke){SB_ROLE_PINNED, SB_LINE_PINNED, &sb_dash_reference}, before,
                  PLACES);
  sb_canvas_hairline(c, cell.x, cell.y + cell.height, cell.x + cell.width, cell.y + cell.height,
                     sb_canvas_role(c, SB_ROLE_AXIS));
}

static void draw_pair(Draw *d, const SbAxes *at, size_t j, size_t k) {
  SbCanvas *c = &d->canvas;
  const SbRect cell = at->plot;
  const SbCalibrationView *view = d->view;
  const double rho = view->correlation[j * view->rows + k];
  sb_canvas_clip(c, cell);
  const size_t step = view->samples / DOTS + 1;
  for (size_t i = 0; i < view->samples; i += step) {
    const double *sample = view->sample + i * view->rows;
    const SbPoint p = sb_axes_at(at, sample[k], sample[j]);
    cairo_arc(c->cr, p.x, p.y, 1.1, 0, 2 * M_PI);
    sb_canvas_color(c, sb_canvas_role(c, SB_ROLE_INNER), 0.35);
    cairo_fill(c->cr);
  }
  double mean[2], deviation[2];
  moments(&mean[0], &deviation[0], view, k);
  moments(&mean[1], &deviation[1], view, j);
  static const double radius[] = {1.17741, 2.44775}; // 50 and 95 % of two normal variates
  for (int r = 0; r < 2; r++) {
    SbPoint ring[73];
    for (int i = 0; i < 73; i++) {
      const double u = cos(i * M_PI / 36),
                   v = rho * u + sqrt(fmax(1 - rho * rho, 0)) * sin(i * M_PI / 36);
      ring[i] = sb_axes_at(at, mean[0] + radius[r] * deviation[0] * u,
                           mean[1] + radius[r] * deviation[1] * v);
    }
    sb_canvas_curve(c, (SbStroke){SB_ROLE_INNER, SB_LINE_FRAME, NULL}, ring, 73);
  }
  const SbPoint before = sb_axes_at(at, view->row[k].before, view->row[j].before);
  sb_canvas_curve(c, (SbStroke){SB_ROLE_SECOND, SB_LINE_FRAME, NULL},
                  (SbPoint[]){{before.x - 5, before.y}, {before.x + 5, before.y}}, 2);
  sb_canvas_polyline(c, (SbPoint[]){{before.x, before.y - 5}, {before.x, before.y + 5}}, 2);
  cairo_restore(c->cr);
  cairo_rectangle(c->cr, cell.x + 0.5, cell.y + 0.5, cell.width - 1, cell.height - 1);
  sb_canvas_pen(c, 1, NULL);
  sb_canvas_color(c, sb_canvas_role(c, SB_ROLE_HAIRLINE), 1);
  cairo_stroke(c->cr);
  const SbTextStyle style = sb_canvas_style(c, SB_TYPE_NOTE, fabs(rho) > 0.7 ? 700 : 400,
                                            fabs(rho) > 0.7 ? SB_ROLE_WARN : SB_ROLE_SECOND);
  g_autofree char *text =
      g_strdup_printf("\xcf\x81 %s%.2f", rho < 0 ? "\xe2\x88\x92" : "", fabs(rho));
  sb_canvas_text_halo(c, text, &style, cell.x + cell.width - 5, cell.y + 14, SB_RIGHT);
}

static void draw_posterior(Draw *d, SbRect rect) {
  SbCanvas *c = &d->canvas;
  const SbCalibrationView *view = d->view;
  const size_t shown = MIN(view->rows, PAIRS_MAX);
  const SbTextStyle name = sb_canvas_style(c, SB_TYPE_NOTE, 600, SB_ROLE_INK);
  sb_frame_title(c, rect, SB_TYPE_PANEL, _("Posterior"),
                 _("pairs; ellipses contain 50 and 95 %, grey: before"));
  if (view->samples < 10 || rect.height < 160) {
    return;
  }
  const double left = 150, gap = 6, foot = 20, top = 28;
  const double width = (rect.width - left) / (double)shown - gap;
  const double height = (rect.height - top - foot) / (double)shown - gap;
  SbScale scale[PAIRS_MAX];
  for (size_t j = 0; j < shown; j++) {
    double mean, deviation;
    moments(&mean, &deviation, view, j);
    scale[j] = (SbScale){mean - 4 * deviation, mean + 4 * deviation, 0, 1, false};
    sb_axis_repair(&scale[j].lo, &scale[j].hi);
  }
  for (size_t j = 0; j < shown; j++) {
    for (size_t k = 0; k <= j; k++) {
      const SbRect cell = {rect.x + left + (double)k * (width + gap),
                           rect.y + top + (double)j * (height + gap), width, height};
      SbAxes at;
      sb_axes_linear(&at, cell, scale[k].lo, scale[k].hi, scale[j].lo, scale[j].hi);
      if (j == k) {
        draw_density(d, cell, j, &at.x);
      } else {
        draw_pair(d, &at, j, k);
      }
    }
    sb_canvas_text_fit(c, view->row[j].name, &name, rect.x,
                       rect.y + top + (double)j * (height + gap) + 0.5 * height, left - 8);
    sb_canvas_text_fit(c, view->row[j].name, &name, rect.x + left + (double)j * (width + gap),
                       rect.y + rect.height - 4, width);
  }
}

void sb_calibration_draw(cairo_t *cr, SbRect rect, const SbTheme *theme,
                         const SbCalibrationView *view) {
  const SbPage page = sb_page_begin(cr, rect, SB_CALIBRATION_WIDTH, SB_CALIBRATION_HEIGHT, theme);
  Draw d = {.view = view};
  SbCanvas *c = &d.canvas;
  sb_canvas_init(c, cr, theme);
  const SbChartData header = {
      .title = view->title, .subtitle = view->subtitle, .run = {.state = SB_CHART_DONE}};
  sb_page_header_draw(cr, page.whole, theme, &header, SB_CHART_WHOLE);
  const SbRect body = page.body;
  const double left = 0.58 * (body.width - SB_GRID_GUTTER), pad = SB_GRID_PADDING;
  const SbRect loops = {body.x, body.y, left, body.height};
  const SbRect side = {body.x + left + SB_GRID_GUTTER, body.y, body.width - left - SB_GRID_GUTTER,
                       body.height};
  sb_canvas_panel(c, loops);
  sb_canvas_panel(c, side);
  draw_loops(&d,
             (SbRect){loops.x + pad, loops.y + pad, loops.width - 2 * pad, loops.height - 2 * pad});
  SbRect at = {side.x + pad, side.y + pad, side.width - 2 * pad, table_height(view)};
  draw_table(&d, at);
  at.y += at.height + 14;
  at.y += draw_sentence(&d, at) + 22;
  at.height = side.y + side.height - pad - at.y;
  draw_posterior(&d, at);
  const SbTextStyle foot = sb_canvas_style(c, SB_TYPE_LABEL, 400, SB_ROLE_SECOND);
  sb_canvas_text_fit(c, view->foot, &foot, page.whole.x + SB_GRID_MARGIN,
                     page.whole.y + page.whole.height - 24, page.whole.width - 2 * SB_GRID_MARGIN);
  sb_canvas_finish(c);
  cairo_restore(cr);
}
