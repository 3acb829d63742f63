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
  return run->summary && run->summary->rig.found ? &run->summary->rig : NULL;
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
static void draw_rig_row(SbCanvas *c, SbRect in, double y, const SbScale *x, const char *name,
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
    draw_rig_row(c, in, in.y + (i + 0.5) * step, &x, rows[i].name, rows[i].value, rows[i].color,
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

// Positions of the plate's parts in the picture.
typedef struct {
  SbRect plate, block, base;
  double ring;           // radius of a ring
  double thread, cell;   // height of the thread, place of the load cell on it
  double drum_x, drum_r; // centre and radius of the motor's drum
  double turn;           // of the drum [rad]
} Plate;

static Plate plate_at(SbRect in, const SbModel *m, const SbFrame *f) {
  const double travel = m ? fmax(sb_model_rig(m)->speed * sb_model_rig(m)->duration, 1e-6) : 1e-3;
  const double moved = f ? fmax(f->displacement, 0) / travel : 0;
  const double wound = f ? fmax(f->platen, 0) / travel : 0;
  const double w = in.width, h = fmin(in.height, 0.42 * w), top = in.y + 0.5 * (in.height - h);
  const double floor_y = top + 0.80 * h, ring = 0.055 * h, room = 0.16 * w;
  const double width = 0.40 * w, left = in.x + 0.08 * w + moved * room;
  const double y = floor_y - 2 * ring - 0.10 * h, block = 0.26 * h;
  const double drum_x = in.x + 0.90 * w, drum_r = 0.10 * h;
  return (Plate){.plate = {left, y, width, 0.10 * h + 0.12 * ring},
                 .block = {left + 0.2 * width, y - block, 0.6 * width, block},
                 .base = {in.x, floor_y, w, 0.12 * h},
                 .ring = ring,
                 .thread = y + 0.05 * h,
                 .cell = 0.5 * (left + width + drum_x - drum_r),
                 .drum_x = drum_x,
                 .drum_r = drum_r,
                 .turn = wound * room / drum_r};
}

// Base, rings glued under the plate, plate and block, from the ground up.
static void draw_plate(SbCanvas *c, const Plate *at) {
  static const double seat[] = {0.16, 0.84};
  cairo_t *cr = c->cr;
  hatched(c, at->base, SB_ROLE_HOUSING, SB_ROLE_HOUSING_HATCH, false);
  for (int i = 0; i < 2; i++) {
    for (int side = -1; side <= 1; side += 2) {
      // A ring in section: two discs, pressed flat a little.
      const double x = at->plate.x + seat[i] * at->plate.width + side * 2.2 * at->ring;
      cairo_save(cr);
      cairo_translate(cr, x, at->base.y - 0.94 * at->ring);
      cairo_scale(cr, 1.04 * at->ring, 0.94 * at->ring);
      cairo_arc(cr, 0, 0, 1, 0, 2 * G_PI);
      cairo_restore(cr);
      sb_canvas_color(c, sb_canvas_role(c, SB_ROLE_OUTER), 0.35);
      cairo_fill_preserve(cr);
      sb_canvas_stroke(c, (SbStroke){SB_ROLE_OUTER, 1.4, NULL});
      cairo_stroke(cr);
    }
  }
  hatched(c, at->plate, SB_ROLE_STEM, SB_ROLE_STEM_HATCH, true);
  hatched(c, at->block, SB_ROLE_STEM, SB_ROLE_STEM_HATCH, true);
}

// The thread with its load cell to the motor's drum, which has turned as far as it has wound up.
static void draw_thread(SbCanvas *c, const Plate *at) {
  const SbTextStyle label = sb_canvas_style(c, SB_TYPE_LABEL, 400, SB_ROLE_SECOND);
  const SbColor outline = sb_canvas_role(c, SB_ROLE_OUTLINE);
  const double centre = at->thread + at->drum_r, hand = 0.8 * at->drum_r;
  cairo_t *cr = c->cr;
  sb_canvas_line(c, (SbStroke){SB_ROLE_INK, 1.8, NULL}, at->plate.x + at->plate.width, at->thread,
                 at->drum_x, at->thread);
  sb_canvas_rounded(c, (SbRect){at->cell - 26, at->thread - 11, 52, 22}, 3);
  sb_canvas_color(c, sb_canvas_role(c, SB_ROLE_PANEL), 1);
  cairo_fill_preserve(cr);
  sb_canvas_color(c, outline, 1);
  cairo_stroke(cr);
  sb_canvas_text(c, _("cell"), &label, at->cell, at->thread + 4.3, SB_MIDDLE);
  cairo_arc(cr, at->drum_x, centre, at->drum_r, 0, 2 * G_PI);
  sb_canvas_color(c, sb_canvas_role(c, SB_ROLE_HOUSING), 1);
  cairo_fill_preserve(cr);
  sb_canvas_stroke(c, (SbStroke){SB_ROLE_OUTLINE, SB_LINE_OUTLINE, NULL});
  cairo_stroke(cr);
  sb_canvas_line(c, (SbStroke){SB_ROLE_OUTLINE, SB_LINE_OUTLINE, NULL}, at->drum_x, centre,
                 at->drum_x + hand * sin(at->turn), centre - hand * cos(at->turn));
  sb_canvas_text(c, _("motor"), &label, at->drum_x, at->thread - 10, SB_MIDDLE);
}

static void draw_load(SbCanvas *c, const Plate *at, double load) {
  const SbTextStyle strong = sb_canvas_style(c, SB_TYPE_LABEL, 600, SB_ROLE_INK);
  const double x = at->plate.x + 0.5 * at->plate.width, y = at->block.y - 40;
  char value[SB_FORMAT_MAX], text[96];
  g_snprintf(text, sizeof text, _("load %s"), sb_format_given(value, SB_QUANTITY_FORCE, load));
  sb_canvas_text(c, text, &strong, x, y - 6, SB_MIDDLE);
  sb_canvas_line(c, (SbStroke){SB_ROLE_INK, 2, NULL}, x, y, x, y + 28);
  sb_canvas_arrowhead(c, x, y + 36, 0, 1, 1);
}

// Figures at the playhead.
static void draw_rig_figures(SbCanvas *c, const Plate *at, const SbChartData *data,
                             const SbFrame *f) {
  const SbTextStyle style = sb_canvas_style(c, SB_TYPE_LABEL, 600, SB_ROLE_NOW);
  const SbModel *m = data->run.model;
  const double still = 1e-3 * (m ? sb_model_rig(m)->speed : 1);
  char value[SB_FORMAT_MAX], text[96];
  sb_format_text(value, SB_QUANTITY_FORCE, f->force, sb_chart_error_force(&data->run));
  g_snprintf(text, sizeof text, _("thread %s"), value);
  sb_canvas_text(c, text, &style, at->cell, at->thread - 20, SB_MIDDLE);
  g_snprintf(text, sizeof text, _("plate %s\xc2\xa0mm, %s"),
             sb_format_fixed(value, f->displacement * 1e3, 3),
             f->stage == SB_STAGE_A      ? _("not yet broken away")
             : fabs(f->velocity) < still ? _("stuck")
                                         : _("slipping"));
  sb_canvas_text(c, text, &style, at->plate.x, at->base.y + at->base.height + 18, SB_LEFT);
}

void sb_rig_plate_draw(cairo_t *cr, SbRect rect, const SbTheme *theme, const SbChartData *data,
                       unsigned flags) {
  SbCanvas canvas;
  const SbRect in = begin(&canvas, cr, rect, theme, flags, _("Sliding plate"),
                          _("schematic, from the side: two of the four rings"));
  const SbModel *m = data->run.model;
  const SbFrame *f = sb_chart_frame(data);
  const Plate at = plate_at(in, m, f);
  draw_plate(&canvas, &at);
  draw_thread(&canvas, &at);
  if (m) {
    draw_load(&canvas, &at, sb_model_rig(m)->load);
  }
  if (f) {
    draw_rig_figures(&canvas, &at, data, f);
  }
  sb_canvas_finish(&canvas);
}
