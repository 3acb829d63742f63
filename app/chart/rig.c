// The rig's page of figures. Ours come from the run's summary, measured 0.51 and predicted 0.4 from
// thesis table 7.8. The words say what each of them is a coefficient of, with what this run shows
// of the differences; they leave no figure that the run did not compute. The plate is a schematic:
// only its displacement and the thread's stretch are to scale with each other.
#include "app/chart/rig.h"
#include "app/base/format.h"
#include "app/chart/signal.h"
#include "app/draw/axis.h"
#include "app/draw/frame.h"

#include <glib.h>
#include <glib/gi18n.h>
#include <math.h>
#include <string.h>

static const SbRigSummary *summary_of(const SbChartRun *run) {
  return run->summary && sb_model_is_rig(run->model) && run->summary->rig.found ? &run->summary->rig
                                                                                : NULL;
}

// ---------------------------------------------------------------------------------------------------
// Words

char *sb_rig_reasons_text(const SbChartRun *run) {
  const SbRigSummary *rig = summary_of(run);
  if (!rig) {
    return g_strdup(run->summary
                        ? _("The force has no first peak: there is no coefficient to compare.")
                        : _("Known when the run has ended."));
  }
  const SbRigCoefficients *of = &rig->of;
  const SbModel *m = run->model;
  char a[SB_FORMAT_MAX], b[SB_FORMAT_MAX], d[SB_FORMAT_MAX], e[SB_FORMAT_MAX];
  GString *out = g_string_new(NULL);
  double bias = of->dynamic_coefficient - of->mean_coefficient;
  if (of->stick_slip) {
    g_string_append_printf(
        out,
        _("Measured %s is a mean of stick-slip peaks, which exceed the mean force: here by %s, "
          "%s over %s.\n"),
        sb_format_digits(a, SB_RIG_MEASURED_DYNAMIC, 2), sb_format_digits(b, bias, 2),
        sb_format_digits(d, of->dynamic_coefficient, 3),
        sb_format_digits(e, of->mean_coefficient, 3));
  } else {
    g_string_append_printf(out,
                           _("Measured %s is a mean of stick-slip peaks; here the plate slides "
                             "without sticking, and the mean force gives %s.\n"),
                           sb_format_digits(a, SB_RIG_MEASURED_DYNAMIC, 2),
                           sb_format_digits(b, of->mean_coefficient, 3));
  }
  g_string_append_printf(
      out,
      _("Predicted %s is sliding friction alone, without stick and slip: it is set against %s, not "
        "against the peaks.\n"),
      sb_format_digits(a, SB_RIG_PREDICTED_DYNAMIC, 2),
      sb_format_digits(b, of->mean_coefficient, 3));
  char load[SB_FORMAT_MAX];
  sb_format_given(load, SB_QUANTITY_FORCE, sb_model_rig(m)->load);
  g_string_append_printf(
      out,
      _("It was also predicted for the valve's seal, pressed on by some 12 N. Real area grows more "
        "slowly than load: shear strength times real area is %s of the load under the %s of this "
        "plate"),
      sb_format_digits(a, rig->contact_coefficient, 2), load);
  if (isfinite(rig->contact_load)) {
    g_string_append_printf(
        out, _(", and falls to %s only at %s, %s a ring.\n"),
        sb_format_digits(a, sb_model_rig(m)->coefficient, 2),
        sb_format_text(b, SB_QUANTITY_FORCE, rig->contact_load, 0),
        sb_format_text(d, SB_QUANTITY_FORCE, rig->contact_load / SB_RIG_RINGS, 0));
  } else {
    g_string_append(out, ".\n");
  }
  g_string_append_printf(
      out,
      _("The thesis gives neither the load nor the speed of its rig; sliding %s, load and speed "
        "are "
        "inputs here. The first peak has had %.3g s of rest, those that follow a fraction of one."),
      sb_format_digits(a, sb_model_rig(m)->coefficient, 2), sb_model_rig(m)->rest);
  return g_string_free(out, FALSE);
}

static void draw_reasons(SbCanvas *c, SbRect in, const SbChartRun *run) {
  g_autofree char *text = sb_rig_reasons_text(run);
  g_auto(GStrv) lines = g_strsplit(text, "\n", -1);
  SbTextStyle style = sb_canvas_style(c, SB_TYPE_LABEL, 400, SB_ROLE_INK);
  double y = in.y;
  for (int i = 0; lines[i]; i++) {
    y += sb_canvas_paragraph(c, lines[i], &style, in.x, y, in.width) + 6;
  }
}

// ---------------------------------------------------------------------------------------------------
// Scale

// One row: name, bar from zero, value.
static void draw_row(SbCanvas *c, SbRect in, double y, const SbScale *x, const char *name,
                     double value, SbColor color, bool ours, int digits) {
  SbTextStyle label = sb_canvas_style(c, SB_TYPE_LABEL, 400, SB_ROLE_SECOND);
  SbTextStyle bold = sb_canvas_style(c, SB_TYPE_LABEL, 600, SB_ROLE_INK);
  char number[SB_FORMAT_MAX];
  sb_canvas_text(c, name, &label, x->p0 - 10, y + 4.3, SB_RIGHT);
  double end = sb_axis_at(x, isfinite(value) ? value : 0);
  if (isfinite(value)) {
    SbRect bar = {x->p0, floor(y - 6), fmax(end - x->p0, 1), 12};
    sb_canvas_color(c, color, ours ? 0.85 : 0.20);
    cairo_rectangle(c->cr, bar.x, bar.y, bar.width, bar.height);
    cairo_fill(c->cr);
    if (!ours) {
      sb_canvas_pen(c, 1.2, NULL);
      sb_canvas_color(c, color, 1);
      cairo_rectangle(c->cr, bar.x + 0.5, bar.y + 0.5, bar.width - 1, bar.height - 1);
      cairo_stroke(c->cr);
    }
  }
  sb_canvas_text(c, sb_format_digits(number, value, digits), &bold, end + 8, y + 4.3, SB_LEFT);
}

static void draw_scale(SbCanvas *c, SbRect in, const SbChartRun *run) {
  const SbRigSummary *rig = summary_of(run);
  const SbRigCoefficients none = {
      .static_coefficient = NAN, .dynamic_coefficient = NAN, .mean_coefficient = NAN};
  const SbRigCoefficients *of = rig ? &rig->of : &none;
  double longest = 152;
  double hi = fmax(0.6, 1.05 * (rig ? fmax(of->static_coefficient, of->dynamic_coefficient) : 0));
  SbScale x = {0, hi, in.x + longest, in.x + in.width - 44, false};
  SbColor ink = sb_canvas_role(c, SB_ROLE_INK), outer = sb_canvas_role(c, SB_ROLE_OUTER);
  SbColor fluid = sb_canvas_role(c, SB_ROLE_FLUID);
  const struct {
    const char *name;
    double value;
    SbColor color;
    bool ours;
    int digits;
  } rows[] = {
      {_("static, first peak"), of->static_coefficient, ink, true, 3},
      {_("dynamic, mean of peaks"), of->dynamic_coefficient, outer, true, 3},
      {_("thesis, measured"), SB_RIG_MEASURED_DYNAMIC, outer, false, 2},
      {_("mean force"), of->mean_coefficient, fluid, true, 3},
      {_("thesis, predicted"), SB_RIG_PREDICTED_DYNAMIC, fluid, false, 2},
  };
  const int count = (int)G_N_ELEMENTS(rows);
  double step = fmin(28, in.height / count);
  for (int i = 0; i < count; i++) {
    draw_row(c, in, in.y + (i + 0.5) * step, &x, rows[i].name, rows[i].value, rows[i].color,
             rows[i].ours, rows[i].digits);
  }
  sb_canvas_hairline(c, x.p0, in.y, x.p0, in.y + count * step, sb_canvas_role(c, SB_ROLE_AXIS));
}

// ---------------------------------------------------------------------------------------------------
// Panels

static SbRect begin(SbCanvas *c, cairo_t *cr, SbRect rect, const SbTheme *theme, unsigned flags,
                    const char *title, const char *note) {
  const bool compact = flags & SB_CHART_COMPACT;
  sb_canvas_init(c, cr, theme);
  const SbRect in = sb_frame_begin(c, rect, flags & SB_CHART_PANEL);
  sb_frame_title(c, in, compact ? SB_TYPE_PANEL_WINDOW : SB_TYPE_PANEL, title, note);
  const double head = compact ? 26 : 34;
  return (SbRect){in.x, in.y + head, in.width, fmax(in.height - head, 10)};
}

static const char *const scale_note = N_("filled: this run, outlined: thesis table 7.8");

void sb_rig_scale_draw(cairo_t *cr, SbRect rect, const SbTheme *theme, const SbChartData *data,
                       unsigned flags) {
  SbCanvas canvas;
  SbRect in = begin(&canvas, cr, rect, theme, flags, _("Friction over load"), _(scale_note));
  draw_scale(&canvas, in, &data->run);
  sb_canvas_finish(&canvas);
}

void sb_rig_reasons_draw(cairo_t *cr, SbRect rect, const SbTheme *theme, const SbChartData *data,
                         unsigned flags) {
  SbCanvas canvas;
  SbRect in = begin(&canvas, cr, rect, theme, flags, _("Why they differ"), NULL);
  draw_reasons(&canvas, in, &data->run);
  sb_canvas_finish(&canvas);
}

void sb_rig_figures_draw(cairo_t *cr, SbRect rect, const SbTheme *theme, const SbChartData *data,
                         unsigned flags) {
  SbCanvas canvas;
  SbCanvas *c = &canvas;
  SbRect in = begin(c, cr, rect, theme, flags, _("Friction over load"), _(scale_note));
  SbRect scale = in, words = in;
  if (in.width > 2.4 * in.height) {
    scale.width = floor(0.42 * in.width);
    words.x += scale.width + SB_GRID_GUTTER;
    words.width -= scale.width + SB_GRID_GUTTER;
    words.y = rect.y + (flags & SB_CHART_PANEL ? SB_GRID_PADDING : 0);
  } else {
    scale.height = fmin(140, 0.5 * in.height);
    words.y += scale.height + 18;
  }
  draw_scale(c, scale, &data->run);
  SbTextStyle bold = sb_canvas_style(c, SB_TYPE_LABEL, 700, SB_ROLE_INK);
  sb_canvas_text(c, _("Why they differ"), &bold, words.x, words.y + 10, SB_LEFT);
  words.y += 20;
  draw_reasons(c, words, &data->run);
  sb_canvas_finish(c);
}

void sb_rig_page_draw(cairo_t *cr, SbRect rect, const SbTheme *theme, const SbChartData *data,
                      unsigned flags) {
  SbRect left = rect, right = rect;
  if (rect.width > 1.3 * rect.height) {
    left.width = floor(0.62 * rect.width);
    right.x += left.width + SB_GRID_GUTTER;
    right.width -= left.width + SB_GRID_GUTTER;
  } else {
    left.height = floor(0.5 * rect.height);
    right.y += left.height + 16;
    right.height -= left.height + 16;
  }
  sb_signal_draw(cr, left, theme, data, flags);
  sb_rig_figures_draw(cr, right, theme, data, flags);
}

// ---------------------------------------------------------------------------------------------------
// Plate

static void hatched(SbCanvas *c, SbRect r, SbRole ground, SbRole hatch, bool left) {
  sb_canvas_fill(c, r, ground, 1);
  sb_canvas_hatch(c, r, 15.6, left, hatch, 1);
  sb_canvas_stroke(c, (SbStroke){SB_ROLE_OUTLINE, SB_LINE_OUTLINE, NULL});
  cairo_rectangle(c->cr, r.x, r.y, r.width, r.height);
  cairo_stroke(c->cr);
}

void sb_rig_plate_draw(cairo_t *cr, SbRect rect, const SbTheme *theme, const SbChartData *data,
                       unsigned flags) {
  SbCanvas canvas;
  SbCanvas *c = &canvas;
  SbRect in = begin(c, cr, rect, theme, flags, _("Sliding plate"),
                    _("schematic, from the side: two of the four rings"));
  const SbModel *m = data->run.model;
  const SbFrame *f = sb_chart_frame(data);
  double travel = m ? fmax(sb_model_rig(m)->speed * sb_model_rig(m)->duration, 1e-6) : 1e-3;
  double moved = f ? fmax(f->displacement, 0) / travel : 0;
  double wound = f ? fmax(f->platen, 0) / travel : 0;
  double w = in.width, h = fmin(in.height, 0.42 * w), top = in.y + 0.5 * (in.height - h);
  SbColor outline = sb_canvas_role(c, SB_ROLE_OUTLINE), ink = sb_canvas_role(c, SB_ROLE_INK);
  SbColor now = sb_canvas_role(c, SB_ROLE_NOW);

  // Base, rings glued under the plate, plate and block, from the ground up.
  double floor_y = top + 0.80 * h, ring = 0.055 * h, room = 0.16 * w;
  double plate_w = 0.40 * w, plate_x = in.x + 0.08 * w + moved * room;
  double plate_y = floor_y - 2 * ring - 0.10 * h;
  hatched(c, (SbRect){in.x, floor_y, w, 0.12 * h}, SB_ROLE_HOUSING, SB_ROLE_HOUSING_HATCH, false);
  const double seat[] = {0.16, 0.84};
  for (int i = 0; i < 2; i++) {
    for (int side = -1; side <= 1; side += 2) {
      // A ring in section: two discs, pressed flat a little.
      double x = plate_x + seat[i] * plate_w + side * 2.2 * ring;
      cairo_save(cr);
      cairo_translate(cr, x, floor_y - 0.94 * ring);
      cairo_scale(cr, 1.04 * ring, 0.94 * ring);
      cairo_arc(cr, 0, 0, 1, 0, 2 * G_PI);
      cairo_restore(cr);
      sb_canvas_color(c, sb_canvas_role(c, SB_ROLE_OUTER), 0.35);
      cairo_fill_preserve(cr);
      sb_canvas_pen(c, 1.4, NULL);
      sb_canvas_color(c, sb_canvas_role(c, SB_ROLE_OUTER), 1);
      cairo_stroke(cr);
    }
  }
  hatched(c, (SbRect){plate_x, plate_y, plate_w, 0.10 * h + 0.12 * ring}, SB_ROLE_STEM,
          SB_ROLE_STEM_HATCH, true);
  double block_h = 0.26 * h;
  hatched(c, (SbRect){plate_x + 0.2 * plate_w, plate_y - block_h, 0.6 * plate_w, block_h},
          SB_ROLE_STEM, SB_ROLE_STEM_HATCH, true);

  // Thread with its load cell to the motor's drum, which has turned as far as it has wound up.
  double thread_y = plate_y + 0.05 * h, drum_x = in.x + 0.90 * w, drum_r = 0.10 * h;
  double from = plate_x + plate_w, cell = 0.5 * (from + drum_x - drum_r);
  sb_canvas_pen(c, 1.8, NULL);
  sb_canvas_color(c, ink, 1);
  cairo_move_to(cr, from, thread_y);
  cairo_line_to(cr, drum_x, thread_y);
  cairo_stroke(cr);
  SbRect box = {cell - 26, thread_y - 11, 52, 22};
  sb_canvas_rounded(c, box, 3);
  sb_canvas_color(c, sb_canvas_role(c, SB_ROLE_PANEL), 1);
  cairo_fill_preserve(cr);
  sb_canvas_color(c, outline, 1);
  cairo_stroke(cr);
  SbTextStyle label = sb_canvas_style(c, SB_TYPE_LABEL, 400, SB_ROLE_SECOND);
  SbTextStyle strong = sb_canvas_style(c, SB_TYPE_LABEL, 600, SB_ROLE_INK);
  SbTextStyle at_now = sb_canvas_style(c, SB_TYPE_LABEL, 600, SB_ROLE_NOW);
  sb_canvas_text(c, _("cell"), &label, cell, thread_y + 4.3, SB_MIDDLE);
  double centre_y = thread_y + drum_r;
  cairo_arc(cr, drum_x, centre_y, drum_r, 0, 2 * G_PI);
  sb_canvas_color(c, sb_canvas_role(c, SB_ROLE_HOUSING), 1);
  cairo_fill_preserve(cr);
  sb_canvas_pen(c, SB_LINE_OUTLINE, NULL);
  sb_canvas_color(c, outline, 1);
  cairo_stroke(cr);
  double turn = wound * room / drum_r;
  cairo_move_to(cr, drum_x, centre_y);
  cairo_line_to(cr, drum_x + 0.8 * drum_r * sin(turn), centre_y - 0.8 * drum_r * cos(turn));
  cairo_stroke(cr);
  sb_canvas_text(c, _("motor"), &label, drum_x, thread_y - 10, SB_MIDDLE);

  // Figures at the playhead.
  char value[SB_FORMAT_MAX], text[96];
  if (m) {
    g_snprintf(text, sizeof text, _("load %s"),
               sb_format_given(value, SB_QUANTITY_FORCE, sb_model_rig(m)->load));
    double x = plate_x + 0.5 * plate_w, y = plate_y - block_h - 40;
    sb_canvas_text(c, text, &strong, x, y - 6, SB_MIDDLE);
    sb_canvas_pen(c, 2, NULL);
    sb_canvas_color(c, ink, 1);
    cairo_move_to(cr, x, y);
    cairo_line_to(cr, x, y + 28);
    cairo_stroke(cr);
    sb_canvas_arrowhead(c, x, y + 36, 0, 1, 1);
  }
  if (f) {
    g_snprintf(
        text, sizeof text, _("thread %s"),
        sb_format_text(value, SB_QUANTITY_FORCE, f->force, sb_chart_error_force(&data->run)));
    sb_canvas_text(c, text, &at_now, cell, thread_y - 20, SB_MIDDLE);
    char place[SB_FORMAT_MAX];
    sb_format_fixed(place, f->displacement * 1e3, 3);
    g_snprintf(text, sizeof text, _("plate %s\xc2\xa0mm, %s"), place,
               f->stage == SB_STAGE_A ? _("not yet broken away")
               : fabs(f->velocity) < 1e-3 * (m ? sb_model_rig(m)->speed : 1) ? _("stuck")
                                                                             : _("slipping"));
    sb_canvas_color(c, now, 1);
    sb_canvas_text(c, text, &at_now, plate_x, floor_y + 0.12 * h + 18, SB_LEFT);
  }
  sb_canvas_finish(c);
}
