// Labels of the hysteresis chart: *now*, the stages' letters with their forces, what the lines are.
// Figures are the frames' and, for loss and return force, the summary's, so they appear only after
// the run's end. Order is importance: the collision rule serves *now* first.
#include "app/base/figure_text.h"
#include "app/chart/hysteresis_private.h"
#include "app/draw/cursor.h"

#include <glib.h>
#include <glib/gi18n.h>
#include <math.h>
#include <string.h>

enum { LETTER_GAP = 12 }; // beside a stage's letter [px]

// A letter in bold and its value, as one label.
static void draw_mark(SbHysteresisView *v, int stage, const char *value, const SbPlace *place,
                      int count) {
  SbCanvas *c = &v->canvas;
  SbTextStyle bold = sb_canvas_style(c, SB_TYPE_LABEL, 700, SB_ROLE_INK);
  SbTextStyle plain = sb_canvas_style(c, SB_TYPE_LABEL, 400, SB_ROLE_INK);
  const char *letter = sb_stage_name((SbStage)stage);
  double letter_width = sb_canvas_text_width(c, letter, &bold);
  double gap = value[0] ? 6 : 0;
  double width = letter_width + gap + (value[0] ? sb_canvas_text_width(c, value, &plain) : 0);
  SbPlace chosen;
  v->labels->crossing_max = 10;
  bool room = sb_labels_place_box(v->labels, width, SB_TYPE_LABEL, place, count, &chosen);
  v->labels->crossing_max = INFINITY;
  if (!room) {
    // No room for the value: the letter alone.
    value = "";
    if (!sb_labels_place_box(v->labels, letter_width, SB_TYPE_LABEL, place, count, &chosen)) {
      return;
    }
    width = letter_width;
  }
  double x = chosen.x - (chosen.align == SB_LEFT     ? 0
                         : chosen.align == SB_MIDDLE ? 0.5 * width
                                                     : width);
  sb_labels_draw(v->labels, c, letter, &bold, &(SbPlace){x, chosen.y, SB_LEFT});
  if (value[0]) {
    sb_labels_draw(v->labels, c, value, &plain,
                   &(SbPlace){x + letter_width + gap, chosen.y, SB_LEFT});
  }
}

// Positions of a stage's letter and value from its dot, the best first.
static int mark_places(SbPlace *out, int stage, SbPoint p) {
  enum { PLACES = 6 };
  static const SbPlace above = {0, -13, SB_LEFT}, over = {0, -12, SB_MIDDLE};
  static const SbPlace higher = {0, -30, SB_LEFT}, corner = {-11, -8, SB_RIGHT};
  static const SbPlace right = {11, 4, SB_LEFT}, left = {-12, 4, SB_RIGHT};
  static const SbPlace up_right = {8, -12, SB_LEFT}, up_left = {-8, -9, SB_RIGHT};
  static const SbPlace below = {0, 20, SB_MIDDLE}, down_right = {8, 19, SB_LEFT};
  static const SbPlace down_left = {-8, 19, SB_RIGHT};
  static const SbPlace *const offers[SB_STAGE_COUNT][PLACES] = {
      [SB_STAGE_A] = {&corner, &left, &up_right, &above},
      [SB_STAGE_B] = {&above, &up_right, &higher, &right, &up_left, &down_right},
      [SB_STAGE_C] = {&up_right, &right, &over, &higher, &up_left, &down_right},
      [SB_STAGE_D] = {&right, &up_right, &down_right, &up_left, &down_left},
      [SB_STAGE_E] = {&right, &up_right, &down_right, &up_left, &down_left},
      [SB_STAGE_F] = {&over, &up_right, &up_left, &below, &down_left, &right}};
  int count = 0;
  for (; count < PLACES && offers[stage][count] != NULL; count++) {
    const SbPlace *offer = offers[stage][count];
    out[count] = (SbPlace){p.x + offer->x, p.y + offer->y, offer->align};
  }
  return count;
}

void sb_hysteresis_marks(SbHysteresisView *v) {
  const SbChartRun *run = &v->data->run;
  SbCanvas *c = &v->canvas;
  const SbStageMark *mark = sb_trace_marks(run->trace);
  SbPoint at[SB_STAGE_COUNT];
  bool there[SB_STAGE_COUNT];
  // All dots first: labels keep off every one of them.
  for (int s = 0; s < SB_STAGE_COUNT; s++) {
    at[s] = sb_hysteresis_pixel(&v->at, mark[s].displacement, mark[s].force);
    there[s] = mark[s].reached && sb_axes_inside(&v->at, at[s].x, at[s].y, 0);
    if (there[s]) {
      sb_canvas_ringed_dot(c, at[s].x, at[s].y, sb_canvas_role(c, SB_ROLE_INK));
      sb_labels_block(v->labels, (SbRect){at[s].x - 5, at[s].y - 5, 10, 10});
    }
  }
  char shown[SB_FORMAT_MAX] = "";
  const int first = v->labels->box_count;
  for (int s = 0; s < SB_STAGE_COUNT; s++) {
    if (!there[s]) {
      continue;
    }
    SbPlace place[6];
    char value[SB_FORMAT_MAX] = "";
    sb_chart_stage_force(value, run, (SbStage)s, mark[s].force);
    // F is on the line that E has just labelled; A is the origin.
    const bool again = s == SB_STAGE_F && strcmp(value, shown) == 0;
    g_strlcpy(shown, value, sizeof shown);
    draw_mark(v, s, again || s == SB_STAGE_A ? "" : value, place, mark_places(place, s, at[s]));
  }
  // Labels of lines stay clear of the letters, or they would be read as one text.
  sb_labels_widen(v->labels, first, LETTER_GAP);
}

// *Now*: a dot, its figures, a dashed line down to the axis.
void sb_hysteresis_now(SbHysteresisView *v, bool line) {
  const SbFrame *frame = sb_chart_frame(v->data);
  SbCanvas *c = &v->canvas;
  SbPoint p = sb_hysteresis_pixel(&v->at, frame->displacement, frame->force);
  double bottom = v->at.plot.y + v->at.plot.height;
  if (line) {
    sb_cursor_drop(c, p, bottom);
    SbPoint drop[2] = {p, {p.x, bottom}};
    sb_labels_avoid(v->labels, drop, 2, 3);
    return;
  }
  sb_cursor_now(c, p);
}

void sb_hysteresis_label_now(SbHysteresisView *v) {
  const SbFrame *frame = sb_chart_frame(v->data);
  SbCanvas *c = &v->canvas;
  SbPoint p = sb_hysteresis_pixel(&v->at, frame->displacement, frame->force);
  sb_labels_block(v->labels, (SbRect){p.x - 8, p.y - 8, 16, 16});
  char place_text[SB_FORMAT_MAX], force_text[SB_FORMAT_MAX], text[2 * SB_FORMAT_MAX + 4];
  // A fixed number of decimals: digits that come and go distract.
  sb_format_fixed(place_text, frame->displacement * 1e3, 2);
  sb_format_text(force_text, SB_QUANTITY_FORCE, frame->force, sb_chart_error_force(&v->data->run));
  g_snprintf(text, sizeof text, "%s\xc2\xa0mm, %s", place_text, force_text);
  SbTextStyle style = sb_canvas_style(c, SB_TYPE_LABEL, 600, SB_ROLE_NOW);
  const SbPlace places[] = {
      {p.x, p.y - 14, SB_MIDDLE},     {p.x + 10, p.y - 14, SB_LEFT}, {p.x - 10, p.y - 14, SB_RIGHT},
      {p.x + 14, p.y + 4, SB_LEFT},   {p.x - 14, p.y + 4, SB_RIGHT}, {p.x + 10, p.y + 24, SB_LEFT},
      {p.x - 10, p.y + 24, SB_RIGHT}, {p.x, p.y + 24, SB_MIDDLE},    {p.x + 14, p.y - 30, SB_LEFT},
      {p.x - 14, p.y - 30, SB_RIGHT},
  };
  sb_labels_put(v->labels, c, text, &style, places, G_N_ELEMENTS(places));
}

static void label_curve(SbHysteresisView *v, const char *text, SbRole role, const SbPlace *place,
                        int count) {
  SbCanvas *c = &v->canvas;
  const SbTextStyle style = sb_canvas_style(c, SB_TYPE_LABEL, 400, role);
  sb_labels_put(v->labels, c, text, &style, place, count);
}

// Point of the curve at a share of the way in frames from a stage of a cycle to what follows it.
static bool between(const SbHysteresisView *v, int stage, int cycle, double share, SbPoint *out) {
  const SbChartRun *run = &v->data->run;
  const SbStageMark *mark = sb_trace_mark(run->trace, (SbStage)stage, cycle);
  if (mark == NULL) {
    return false;
  }
  size_t first = mark->frame;
  size_t last = sb_trace_stage_end(run->trace, (SbStage)stage, cycle, run->count);
  bool ends = stage == SB_STAGE_F && sb_chart_complete(v->data);
  if (last < first || (last + 1 >= run->count && !ends)) {
    return false; // stages out of order, or this one is not over yet
  }
  size_t i = first + (size_t)(share * (double)(last - first));
  *out = sb_hysteresis_pixel(&v->at, run->frames[i].displacement, run->frames[i].force);
  return true;
}

// A pin's name beside its own in-stroke, the second's further along.
static void label_pin(SbHysteresisView *v, const SbChartPin *pin, double right) {
  SbHysteresisView other = *v;
  SbChartData shown = *v->data;
  SbPoint p;
  shown.run = *pin->run;
  other.data = &shown;
  if (pin->run->trace == NULL || !between(&other, SB_STAGE_C, 0, 0.05 + 0.4 * pin->look, &p)) {
    return;
  }
  const double end = fmin(
      right, sb_axis_at(&v->at.x, 1e3 * sb_trace_range(v->data->run.trace).displacement_max) - 8);
  label_curve(v, pin->name, sb_chart_pin_role(pin->look),
              (SbPlace[]){{p.x, p.y + 18, SB_LEFT},
                          {p.x, p.y - 9, SB_LEFT},
                          {end, p.y + 18, SB_RIGHT},
                          {end, p.y - 9, SB_RIGHT},
                          {p.x, p.y + 34, SB_LEFT}},
              5);
}

// The end of the stroke.
static void note_stop(SbHysteresisView *v) {
  const SbStageMark *mark = sb_trace_marks(v->data->run.trace);
  if (mark[SB_STAGE_D].reached) {
    const SbPoint p = sb_hysteresis_pixel(&v->at, mark[SB_STAGE_D].displacement, v->at.y.hi);
    label_curve(v, C_("label", "stop"), SB_ROLE_SECOND,
                (SbPlace[]){{p.x - 8, p.y + 5, SB_RIGHT}, {p.x + 8, p.y + 5, SB_LEFT}}, 2);
  }
}

static void note_pressure_force(SbHysteresisView *v, double force) {
  const SbModel *model = v->data->run.model;
  char value[SB_FORMAT_MAX], text[128];
  const double y = sb_axis_at(&v->at.y, force), zero = sb_axis_at(&v->at.x, 0);
  const double stroke = sb_axis_at(&v->at.x, sb_model_value(model, SB_P_DRIVE_STROKE) * 1e3);
  sb_figure_text(value, sb_figure_find("cycle.pressure_force_N"), force, 0);
  g_snprintf(text, sizeof text, _("pressure force %s"), value);
  label_curve(v, text, SB_ROLE_FLUID,
              (SbPlace[]){{stroke - 8, y - 7, SB_RIGHT},
                          {zero + 10, y - 7, SB_LEFT},
                          {stroke - 8, y + 16, SB_RIGHT},
                          {0.5 * (zero + stroke), y - 7, SB_MIDDLE},
                          {zero + 10, y + 16, SB_LEFT}},
              5);
}

// Loss and minimum return force of a complete run: to the right of zero, or beyond the line of
// *now*.
static void note_figures(SbHysteresisView *v, double pressure_force) {
  const SbSummary *sum = v->data->run.summary;
  const SbModel *model = v->data->run.model;
  const SbFrame *frame = v->flags & SB_CHART_WHOLE ? NULL : sb_chart_frame(v->data);
  const double beyond =
      frame ? sb_hysteresis_pixel(&v->at, frame->displacement, frame->force).x + 12 : v->at.plot.x;
  const double left = sb_axis_at(&v->at.x, 0) + 12;
  char value[SB_FORMAT_MAX], text[128];
  if (isfinite(sum->energy.loop) && sum->energy.loop > 0) {
    const int cycles = model ? sb_model_number(model, SB_P_DRIVE_CYCLES) : 1;
    const double y = sb_axis_at(&v->at.y, pressure_force > 0 ? pressure_force : 0.5 * v->at.y.hi);
    sb_format_figure(value, sum, sb_figure_find("cycle.energy_loss_J"));
    if (cycles > 1) {
      g_snprintf(text, sizeof text,
                 ngettext("loss of %d cycle %s", "loss of %d cycles %s", (unsigned long)cycles),
                 cycles, value);
    } else {
      g_snprintf(text, sizeof text, _("loss per cycle %s"), value);
    }
    label_curve(v, text, SB_ROLE_SECOND,
                (SbPlace[]){{left, y + 18, SB_LEFT},
                            {left, y + 36, SB_LEFT},
                            {left, y - 10, SB_LEFT},
                            {left, y - 28, SB_LEFT},
                            {beyond, y + 18, SB_LEFT},
                            {beyond, y - 10, SB_LEFT}},
                6);
  }
  if (isfinite(sum->force_return_min)) {
    const double y = sb_axis_at(&v->at.y, fmax(sum->force_return_min, v->at.y.lo));
    sb_format_figure(value, sum, sb_figure_find("cycle.force_return_min_N"));
    g_snprintf(text, sizeof text, _("return, sliding %s"), value);
    label_curve(v, text, SB_ROLE_INK,
                (SbPlace[]){{left, y - 9, SB_LEFT},
                            {left, y - 26, SB_LEFT},
                            {beyond, y - 9, SB_LEFT},
                            {left, y + 18, SB_LEFT}},
                4);
  }
}

// Directions, the second of two loops next to its own in-stroke (more than two are too many to
// name), pinned runs.
static void note_curves(SbHysteresisView *v) {
  const SbChartRun *run = &v->data->run;
  char text[SB_FORMAT_MAX];
  SbPoint p;
  if (between(v, SB_STAGE_C, 0, 0.5, &p)) {
    label_curve(v, _("in-stroke"), SB_ROLE_INK,
                (SbPlace[]){{p.x, p.y - 10, SB_MIDDLE},
                            {p.x, p.y + 19, SB_MIDDLE},
                            {p.x + 50, p.y - 10, SB_MIDDLE},
                            {p.x - 50, p.y - 10, SB_MIDDLE}},
                4);
  }
  if (between(v, SB_STAGE_E, 0, 0.32, &p)) {
    label_curve(v, C_("label", "return"), SB_ROLE_INK,
                (SbPlace[]){{p.x, p.y + 17, SB_MIDDLE},
                            {p.x, p.y - 10, SB_MIDDLE},
                            {p.x - 40, p.y + 17, SB_MIDDLE}},
                3);
  }
  if (between(v, SB_STAGE_B, 1, 0.5, &p) && !sb_trace_mark(run->trace, SB_STAGE_B, 2)) {
    label_curve(v, sb_chart_cycle_name(text, run, 1), SB_ROLE_INK,
                (SbPlace[]){{p.x, p.y + 17, SB_MIDDLE},
                            {p.x, p.y - 8, SB_MIDDLE},
                            {p.x + 30, p.y + 17, SB_MIDDLE},
                            {p.x + 60, p.y + 17, SB_MIDDLE}},
                4);
  }
  for (size_t i = 0; i < v->data->pin_count; i++) {
    label_pin(v, &v->data->pin[i], v->at.plot.x + v->at.plot.width);
  }
}

void sb_hysteresis_notes(SbHysteresisView *v) {
  const SbChartRun *run = &v->data->run;
  const double force = run->model ? sb_model_pressure_force(run->model) : 0;
  note_stop(v);
  if (force > 0) {
    note_pressure_force(v, force);
  }
  if (run->summary && sb_chart_complete(v->data)) {
    note_figures(v, force);
  }
  note_curves(v);
}
