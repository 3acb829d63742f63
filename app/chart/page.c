// Header and footer of a page. Every export says which models made it, what its error estimates are
// and what to be warned of; where a run gives no estimate the footer says so rather than nothing.
#include "app/chart/page.h"
#include "app/base/device.h"
#include "app/base/figure_text.h"

#include <glib.h>
#include <glib/gi18n.h>
#include <math.h>
#include <string.h>

#define DOT "  \xc2\xb7  "

// ---------------------------------------------------------------------------------------------------
// Texts

static void append_choice(GString *out, const char *label, const SbModel *model, SbParamId id) {
  char name[64];
  sb_model_choice_name(model, id, name, sizeof name);
  g_string_append_printf(out, "%s%s %s", out->len ? DOT : "", label, name);
}

void sb_page_models_text(char *out, size_t size, const SbChartRun *run) {
  g_autoptr(GString) text = g_string_new(NULL);
  const SbModel *m = run->model;
  if (m != NULL && sb_device(m)->stem) {
    append_choice(text, _("fit"), m, SB_P_MODELS_FIT);
    append_choice(text, _("film"), m, SB_P_MODELS_FILM);
    append_choice(text, _("surface"), m, SB_P_MODELS_SURFACE);
    if (sb_model_number(m, SB_P_MODELS_ASPERITIES) !=
        (int)sb_param(SB_P_MODELS_ASPERITIES)->fallback) {
      append_choice(text, _("asperities"), m, SB_P_MODELS_ASPERITIES);
    }
  }
  if (m != NULL) {
    append_choice(text, _("motion"), m, SB_P_MODELS_MOTION);
  }
  g_strlcpy(out, text->str, size);
}

void sb_page_conditions_text(char *out, size_t size, const SbChartRun *run) {
  const SbModel *m = run->model;
  if (!m) {
    g_strlcpy(out, "", size);
    return;
  }
  char pressure[SB_FORMAT_MAX], speed[SB_FORMAT_MAX], map[64];
  if (!sb_device(m)->stem) {
    const SbRig *rig = sb_model_rig(m);
    g_snprintf(out, size, _("load %s  \xc2\xb7  thread %s  \xc2\xb7  %.4g samples a second"),
               sb_format_given(pressure, SB_QUANTITY_FORCE, rig->load),
               sb_format_given(speed, SB_QUANTITY_SPEED, rig->speed), rig->rate);
    return;
  }
  double v = sb_model_value(m, SB_P_DRIVE_SPEED);
  sb_format_given(pressure, SB_QUANTITY_PRESSURE, sb_model_value(m, SB_P_CANISTER_PRESSURE));
  if (sb_model_number(m, SB_P_DRIVE_KIND) != SB_MODEL_DRIVE_MACHINE) {
    // A speed belongs to the machine only.
    char kind[32];
    sb_model_choice_name(m, SB_P_DRIVE_KIND, kind, sizeof kind);
    g_snprintf(speed, sizeof speed, _("drive %s"), kind);
  } else if (v < 1e-3) {
    // As test machines are set.
    char number[SB_FORMAT_MAX];
    sb_format_given(number, SB_QUANTITY_NUMBER, v * 60e3);
    g_snprintf(speed, sizeof speed, "%s\xc2\xa0mm/min", number);
  } else {
    sb_format_given(speed, SB_QUANTITY_SPEED, v);
  }
  sb_model_choice_name(m, sb_device(m)->pressure_map ? SB_P_CANISTER_PRESSURE_MAP : SB_P_VALVE_KIND,
                       map, sizeof map);
  g_snprintf(out, size, _("canister %s  \xc2\xb7  %s  \xc2\xb7  %s"), pressure, speed, map);
}

// Adds the error of a figure that is neither exact nor missing.
static void append_error(GString *out, const SbSummary *summary, int index) {
  const SbFigure *figure = sb_figure(index);
  const double value = sb_figure_value(summary, index);
  const double error = sb_figure_error_absolute(summary, index);
  if (!isfinite(value) || error == 0) {
    return;
  }
  g_autofree char *text = isfinite(error) ? sb_figure_error_format(index, value, error) : NULL;
  g_string_append_printf(out, "%s%s%s%s", out->len ? DOT : "", _(figure->label),
                         *figure->where ? ", " : "", *figure->where ? _(figure->where) : "");
  g_string_append_printf(out, text ? " \xc2\xb1 %s" : " %s", text ? text : _("error not known"));
}

void sb_page_errors_text(char *out, size_t size, const SbSummary *summary) {
  if (!summary) {
    g_strlcpy(out, _("known when the run has ended"), size);
    return;
  }
  // A valve has none of the rig's figures, and the rig none of the valve's.
  g_autoptr(GString) text = g_string_new(NULL);
  append_error(text, summary, sb_figure_find("cycle.force_breakaway_N"));
  append_error(text, summary, sb_figure_find("cycle.force_return_margin_N"));
  for (int i = 0; i < SB_FIGURE_COUNT; i++) {
    if (sb_figure(i)->brief && sb_figure(i)->group == SB_GROUP_RIG) {
      append_error(text, summary, i);
    }
  }
  g_strlcpy(out, text->len ? text->str : _("rounding only"), size);
}

static const char *const scope = N_("  (discretisation, not the choice of model)");

char *sb_page_comment(const SbChartRun *run, const SbSummary *summary) {
  char models[512], errors[512];
  sb_page_models_text(models, sizeof models, run);
  sb_page_errors_text(errors, sizeof errors, summary);
  return g_strdup_printf("Models: %s\nError estimates: %s%s", models, errors, _(scope));
}

// ---------------------------------------------------------------------------------------------------
// Header

// One read-out: number large, unit smaller, label below; right-aligned. Returns its left edge.
static double readout(SbCanvas *c, double right, double y, const char *number, const char *unit,
                      const char *reserve, const char *label, SbRole role) {
  SbTextStyle large = sb_canvas_style(c, SB_TYPE_READOUT, 600, role);
  SbTextStyle small = sb_canvas_style(c, 0.6 * SB_TYPE_READOUT, 400, role);
  SbTextStyle below = sb_canvas_style(c, 13, 400, role == SB_ROLE_NOW ? role : SB_ROLE_SECOND);
  if (role == SB_ROLE_NOW) {
    below.weight = 600;
  }
  double unit_width = unit[0] ? sb_canvas_text_width(c, unit, &small) + 6 : 0;
  if (unit[0]) {
    sb_canvas_text(c, unit, &small, right, y, SB_RIGHT);
  }
  sb_canvas_text(c, number, &large, right - unit_width, y, SB_RIGHT);
  sb_canvas_text(c, label, &below, right, y + 20, SB_RIGHT);
  // Room for the widest number, so that nothing moves during a film.
  double width = sb_canvas_text_width(c, reserve, &large) + unit_width;
  return right - fmax(width, sb_canvas_text_width(c, label, &below));
}

// A coloured plate with the state's sentence; returns its width.
static double state_chip(SbCanvas *c, const char *text, SbRole ink, SbRole ground, double x,
                         double y, double width) {
  SbTextStyle style = sb_canvas_style(c, SB_TYPE_LABEL, 600, ink);
  double natural = fmin(sb_canvas_text_width(c, text, &style), width - 36);
  SbRect box = {x, y - 16, natural + 36, 22};
  sb_canvas_rounded(c, box, 4);
  sb_canvas_color(c, sb_canvas_role(c, ground), 1);
  cairo_fill(c->cr);
  // A triangle with its exclamation mark: state is never told by colour alone.
  sb_canvas_color(c, sb_canvas_role(c, ink), 1);
  cairo_move_to(c->cr, x + 15, y - 12);
  cairo_line_to(c->cr, x + 22, y + 1);
  cairo_line_to(c->cr, x + 8, y + 1);
  cairo_close_path(c->cr);
  cairo_fill(c->cr);
  SbTextStyle mark = sb_canvas_style(c, SB_TYPE_NOTE - 1, 700, ground);
  sb_canvas_text(c, "!", &mark, x + 15, y - 0.5, SB_MIDDLE);
  sb_canvas_text_fit(c, text, &style, x + 28, y, natural + 1);
  return box.width;
}

SbPage sb_page_begin(cairo_t *cr, SbRect rect, double width, double height, const SbTheme *theme) {
  double scale = fmin(rect.width / width, rect.height / height);
  if (scale < 0.8) {
    scale = fmin(0.8, fmin(rect.width / 560, rect.height / 420));
  }
  scale = fmax(scale, 0.02);
  SbRect whole = {0, 0, rect.width / scale, rect.height / scale};
  cairo_save(cr);
  cairo_translate(cr, rect.x, rect.y);
  cairo_scale(cr, scale, scale);
  SbColor ground = theme->role[SB_ROLE_BACKGROUND];
  cairo_set_source_rgb(cr, ground.r, ground.g, ground.b);
  cairo_rectangle(cr, 0, 0, whole.width, whole.height);
  cairo_fill(cr);
  double left = whole.height - SB_PAGE_HEADER - sb_page_footer_height(whole) - 8;
  return (SbPage){whole, {SB_GRID_MARGIN, SB_PAGE_HEADER, whole.width - 2 * SB_GRID_MARGIN, left}};
}

// The values of a frame, from the right; returns the left end of the first one.
static double draw_readouts(SbCanvas *c, const SbChartData *data, const SbFrame *frame,
                            double right, double y) {
  const SbChartRun *run = &data->run;
  char number[SB_FORMAT_MAX];
  SbFormatted f;
  sb_format(&f, SB_QUANTITY_FORCE, frame->force, sb_chart_error_force(run));
  double x =
      readout(c, right, y, f.number, f.unit, "00.0", _(sb_device(run->model)->force), SB_ROLE_INK);
  // Place and time get a fixed number of decimals: digits that come and go distract.
  sb_format_fixed(number, frame->displacement * 1e3, 2);
  x = readout(c, x - 42, y, number, "mm", "0.00", C_("stem", "displacement"), SB_ROLE_INK);
  const double duration = run->trace ? sb_trace_range(run->trace).time_max : 0;
  sb_format_fixed(number, frame->time, duration < 1 ? 4 : duration < 200 ? 2 : 1);
  x = readout(c, x - 42, y, number, "s", "00.00", _("time"), SB_ROLE_INK);
  return readout(c, x - 42, y, sb_chart_span(run, frame->stage), "", "B\u2013C",
                 sb_chart_phase(run, frame->stage), SB_ROLE_NOW);
}

// What is to be known of the state of a run; empty if it is complete. `error`: it is an error.
static void state_text(char *out, size_t size, const SbChartData *data, bool *error) {
  const bool failed = data->run.state == SB_CHART_FAILED && !data->stale;
  *error = data->failure || failed;
  g_strlcpy(out, "", size);
  if (data->failure || data->stale) {
    g_strlcpy(out, data->failure ? data->failure : data->stale, size);
  } else if (failed) {
    g_strlcpy(out, _("the solver did not converge: up to the last good state"), size);
  } else if (data->run.state == SB_CHART_PARTIAL) {
    g_strlcpy(out, _("partial: the run was cancelled"), size);
  } else if (data->run.state == SB_CHART_RUNNING) {
    g_snprintf(out, size, _("being computed, %.0f\xc2\xa0%%"), 100 * CLAMP(data->progress, 0, 1));
  }
}

void sb_page_header_draw(cairo_t *cr, SbRect rect, const SbTheme *theme, const SbChartData *data,
                         unsigned flags) {
  SbCanvas canvas, *c = &canvas;
  sb_canvas_init(c, cr, theme);
  const double left = rect.x + SB_GRID_MARGIN, right = rect.x + rect.width - SB_GRID_MARGIN;
  const SbFrame *frame = flags & SB_CHART_WHOLE ? NULL : sb_chart_frame(data);
  const double end = frame ? draw_readouts(c, data, frame, right, rect.y + 48) : right;
  const SbTextStyle title = sb_canvas_style(c, SB_TYPE_TITLE, 700, SB_ROLE_INK);
  const SbTextStyle sub = sb_canvas_style(c, 14, 400, SB_ROLE_SECOND);
  const double width = end - left - 24;
  sb_canvas_text_fit(c, data->title ? data->title : "Sealbench", &title, left, rect.y + 44, width);

  // State first, then the subtitle in what is left of the line.
  char state[256], conditions[160];
  double x = left;
  bool error;
  state_text(state, sizeof state, data, &error);
  if (state[0]) {
    x += 12 + state_chip(c, state, error ? SB_ROLE_ERROR : SB_ROLE_WARN,
                         error ? SB_ROLE_ERROR_GROUND : SB_ROLE_WARN_GROUND, left, rect.y + 68,
                         width);
  }
  sb_page_conditions_text(conditions, sizeof conditions, &data->run);
  g_autofree char *line = g_strconcat(
      data->subtitle ? data->subtitle : "",
      data->subtitle && data->subtitle[0] && conditions[0] ? DOT : "", conditions, NULL);
  if (line[0] && left + width - x > 80) {
    sb_canvas_text_fit(c, line, &sub, x, rect.y + 68, left + width - x);
  }
  sb_canvas_finish(c);
}

// ---------------------------------------------------------------------------------------------------
// Footer

static bool is_narrow(SbRect rect) {
  return rect.width < 1300;
}

// No room for the version beside the models.
static bool is_very_narrow(SbRect rect) {
  return rect.width < 900;
}

double sb_page_footer_height(SbRect rect) {
  return SB_PAGE_FOOTER + (is_narrow(rect) ? 18 : 0) + (is_very_narrow(rect) ? 18 : 0);
}

// Baselines of a foot's lines [px].
typedef struct {
  bool narrow; // warnings have a line of their own
  double left, right, models, errors, version, warnings;
} FootLines;

static FootLines foot_lines(SbRect rect) {
  const double line = 18, last = rect.y + rect.height - 20;
  const bool narrow = is_narrow(rect), very_narrow = is_very_narrow(rect);
  FootLines at = {.narrow = narrow,
                  .left = rect.x + SB_GRID_MARGIN,
                  .right = rect.x + rect.width - SB_GRID_MARGIN,
                  .warnings = very_narrow ? last - line : last};
  at.errors = narrow ? at.warnings - line : last;
  at.models = at.errors - line;
  at.version = very_narrow ? last : narrow ? at.models : last;
  at.warnings = narrow ? at.warnings : at.models;
  return at;
}

// "  and 3 more", empty for none.
static void more_text(char *out, size_t size, size_t count) {
  out[0] = '\0';
  if (count > 0) {
    g_snprintf(out, size, _("  and %zu more"), count);
  }
}

// As many warnings as fit into `space`, at least one; their number. The serious ones come first, so
// that none of them is among the number of the others.
static size_t join_warnings(GString *line, SbCanvas *c, const SbTextStyle *style,
                            const SbWarnings *list, double space) {
  const size_t count = list->count + list->dropped;
  const char *texts[SB_WARNINGS_MAX];
  size_t shown = 0, ordered = 0;
  for (int pass = 1; pass >= 0; pass--) {
    for (size_t i = 0; i < list->count; i++) {
      if (list->item[i].serious == (pass == 1)) {
        texts[ordered++] = list->item[i].text;
      }
    }
  }
  for (; shown < list->count; shown++) {
    g_autofree char *tried = g_strdup_printf("%s%s%s", line->str, shown ? ";  " : "", texts[shown]);
    char rest[48];
    more_text(rest, sizeof rest, count - shown - 1);
    g_autofree char *whole = g_strconcat(tried, rest, NULL);
    if (shown > 0 && sb_canvas_text_width(c, whole, style) > space) {
      break;
    }
    g_string_assign(line, tried);
  }
  return shown;
}

// Warnings to the right of x = `left`, or on their own line; the number of those that do not fit.
static void draw_warnings(SbCanvas *c, const SbWarnings *list, const FootLines *at, double left) {
  const SbTextStyle plain = sb_canvas_style(c, SB_TYPE_LABEL, 400, SB_ROLE_WARN);
  const SbTextStyle bold = sb_canvas_style(c, SB_TYPE_LABEL, 700, SB_ROLE_WARN);
  const size_t count = list->count + list->dropped;
  const char *head = count == 1 ? _("Warning") : _("Warnings");
  const double head_width = sb_canvas_text_width(c, head, &bold) + 8;
  const double space = at->right - left - head_width;
  g_autoptr(GString) line = g_string_new(NULL);
  const size_t shown = join_warnings(line, c, &plain, list, space);
  char rest[48];
  more_text(rest, sizeof rest, count - shown);
  const double rest_width = rest[0] ? sb_canvas_text_width(c, rest, &bold) : 0;
  const double width = fmin(sb_canvas_text_width(c, line->str, &plain), space - rest_width);
  const double x = at->narrow ? at->left : at->right - rest_width - width - head_width;
  sb_canvas_text(c, head, &bold, x, at->warnings, SB_LEFT);
  sb_canvas_text_fit(c, line->str, &plain, x + head_width, at->warnings, width + 0.5);
  if (rest[0]) {
    sb_canvas_text(c, rest, &bold, x + head_width + width, at->warnings, SB_LEFT);
  }
}

void sb_page_foot_draw(cairo_t *cr, SbRect rect, const SbTheme *theme, const SbPageFoot *foot) {
  SbCanvas canvas, *c = &canvas;
  sb_canvas_init(c, cr, theme);
  const SbTextStyle bold = sb_canvas_style(c, SB_TYPE_LABEL, 700, SB_ROLE_SECOND);
  const SbTextStyle plain = sb_canvas_style(c, SB_TYPE_LABEL, 400, SB_ROLE_SECOND);
  const SbTextStyle third = sb_canvas_style(c, SB_TYPE_LABEL, 400, SB_ROLE_THIRD);
  const FootLines at = foot_lines(rect);
  const bool warned = foot->warnings && foot->warnings->count + foot->warnings->dropped > 0;

  // Version and run first: they may not be cut.
  const double version =
      24 + sb_canvas_text(c, foot->version, &third, at.right, at.version, SB_RIGHT);
  double x = at.left + 8 + sb_canvas_text(c, _("Models"), &bold, at.left, at.models, SB_LEFT);
  double room = at.right - x - (at.version == at.models ? version : 0);
  if (warned && !at.narrow) {
    room = fmin(sb_canvas_text_width(c, foot->models, &plain), 0.62 * room);
  }
  const double end = x + sb_canvas_text_fit(c, foot->models, &plain, x, at.models, room);
  x = at.left + 8 + sb_canvas_text(c, _("Error estimates"), &bold, at.left, at.errors, SB_LEFT);
  sb_canvas_text_fit(c, foot->errors, &plain, x, at.errors,
                     at.right - x - (at.version == at.errors ? version : 0));
  if (warned) {
    draw_warnings(c, foot->warnings, &at, at.narrow ? at.left : end + 32);
  }
  sb_canvas_finish(c);
}

void sb_page_footer_draw(cairo_t *cr, SbRect rect, const SbTheme *theme, const SbChartData *data,
                         unsigned flags) {
  char models[512], errors[512], version[160];
  sb_page_models_text(models, sizeof models, &data->run);
  sb_page_errors_text(errors, sizeof errors, data->run.summary);
  g_strlcat(errors, _(scope), sizeof errors);
  g_snprintf(version, sizeof version, "Sealbench %s", sb_version());
  if (data->hash && data->hash[0]) {
    g_strlcat(version, _("  \xc2\xb7  run "), sizeof version);
    size_t used = strlen(version);
    g_strlcpy(version + used, data->hash, MIN(sizeof version - used, 9));
  }
  if (data->run.count > 0) {
    size_t used = strlen(version);
    if (flags & SB_CHART_WHOLE) {
      g_snprintf(version + used, sizeof version - used, _("  \xc2\xb7  %zu frames"),
                 data->run.count);
    } else {
      g_snprintf(version + used, sizeof version - used, _("  \xc2\xb7  frame %zu of %zu"),
                 MIN(data->playhead, data->run.count - 1) + 1, data->run.count);
    }
  }
  const SbSummary *summary = data->run.summary;
  SbPageFoot foot = {models, errors, version, summary ? &summary->warnings : NULL};
  sb_page_foot_draw(cr, rect, theme, &foot);
}
