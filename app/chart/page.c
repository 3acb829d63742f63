// Header and footer of a page. Every export says which models made it, what its error estimates are
// and what to be warned of; where a run gives no estimate the footer says so rather than nothing.
#include "app/chart/page.h"
#include "app/base/format.h"

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
  if (sb_model_is_rig(m)) {
    append_choice(text, _("motion"), m, SB_P_MODELS_MOTION);
  } else if (m) {
    append_choice(text, _("fit"), m, SB_P_MODELS_FIT);
    append_choice(text, _("film"), m, SB_P_MODELS_FILM);
    append_choice(text, _("surface"), m, SB_P_MODELS_SURFACE);
    if (sb_model_number(m, SB_P_MODELS_ASPERITIES) == SB_MODEL_ASPERITIES_COUPLED) {
      append_choice(text, _("asperities"), m, SB_P_MODELS_ASPERITIES);
    }
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
  if (sb_model_is_rig(m)) {
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
  if (sb_model_number(m, SB_P_VALVE_KIND) == SB_VALVE_GASKET) {
    sb_model_choice_name(m, SB_P_VALVE_KIND, map, sizeof map); // its pressures follow the stem
  } else {
    sb_model_choice_name(m, SB_P_CANISTER_PRESSURE_MAP, map, sizeof map);
  }
  g_snprintf(out, size, _("canister %s  \xc2\xb7  %s  \xc2\xb7  %s"), pressure, speed, map);
}

// Below this an estimate is rounding of double numbers, not discretisation.
#define ROUNDING 1e-9

// Errors have two digits at most: they are estimates.
static void append_error(GString *out, const char *label, double error) {
  if (!isfinite(error) || error < ROUNDING) {
    return;
  }
  char number[SB_FORMAT_MAX];
  if (error < 5e-6) {
    g_strlcpy(number, "< 0.001", sizeof number);
  } else {
    sb_format_digits(number, 100 * error, 2);
    size_t end = strlen(number);
    while (strchr(number, '.') && number[end - 1] == '0') {
      number[--end] = 0;
    }
    if (number[end - 1] == '.') {
      number[--end] = 0;
    }
  }
  g_string_append_printf(out, "%s%s %s\xc2\xa0%%", out->len ? ", " : "", label, number);
}

static void append_rounding(GString *out, const char *label, double error) {
  if (isfinite(error) && error < ROUNDING) {
    g_string_append_printf(out, "%s%s", out->len ? ", " : "", label);
  }
}

void sb_page_errors_text(char *out, size_t size, const SbChartRun *run) {
  const SbSummary *s = run->summary;
  if (!s) {
    g_strlcpy(out, _("known when the run has ended"), size);
    return;
  }
  const struct {
    const char *label;
    double error;
  } parts[] = {{_("load"), s->error_load},
               {_("force"), s->error_force},
               {_("film"), s->error_film},
               {_("energy"), s->error_energy},
               {_("energy closure"), s->energy.closure}};
  g_autoptr(GString) text = g_string_new(NULL);
  g_autoptr(GString) rounding = g_string_new(NULL);
  for (size_t i = 0; i < G_N_ELEMENTS(parts); i++) {
    append_error(text, parts[i].label, parts[i].error);
    append_rounding(rounding, parts[i].label, parts[i].error);
  }
  if (rounding->len) {
    g_string_append_printf(text, _("%s%s: rounding only"), text->len ? "; " : "", rounding->str);
  }
  g_string_append(text, _("  (discretisation, not the choice of model)"));
  g_strlcpy(out, text->str, size);
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

void sb_page_header_draw(cairo_t *cr, SbRect rect, const SbTheme *theme, const SbChartData *data,
                         unsigned flags) {
  SbCanvas canvas;
  SbCanvas *c = &canvas;
  sb_canvas_init(c, cr, theme);
  double left = rect.x + SB_GRID_MARGIN, right = rect.x + rect.width - SB_GRID_MARGIN;
  const SbFrame *frame = flags & SB_CHART_WHOLE ? NULL : sb_chart_frame(data);
  double free_right = right;
  double y = rect.y + 48;
  if (frame) {
    SbFormatted f;
    sb_format(&f, SB_QUANTITY_FORCE, frame->force, sb_chart_error_force(&data->run));
    double x =
        readout(c, right, y, f.number, f.unit, "00.0",
                sb_chart_is_rig(&data->run) ? _("force in the thread") : _("force on the stem"),
                SB_ROLE_INK);
    // Place and time get a fixed number of decimals: digits that come and go distract.
    char number[SB_FORMAT_MAX];
    sb_format_fixed(number, frame->displacement * 1e3, 2);
    x = readout(c, x - 42, y, number, "mm", "0.00", C_("stem", "displacement"), SB_ROLE_INK);
    double duration = data->run.trace ? sb_trace_range(data->run.trace).time_max : 0;
    sb_format_fixed(number, frame->time, duration < 1 ? 4 : duration < 200 ? 2 : 1);
    x = readout(c, x - 42, y, number, "s", "00.00", _("time"), SB_ROLE_INK);
    double x_time = x - 42;
    free_right = readout(c, x_time, y, sb_chart_span(&data->run, frame->stage), "",
                         "B\xe2\x80\x93"
                         "C",
                         sb_chart_phase(&data->run, frame->stage), SB_ROLE_NOW);
  }

  SbTextStyle title = sb_canvas_style(c, SB_TYPE_TITLE, 700, SB_ROLE_INK);
  SbTextStyle sub = sb_canvas_style(c, 14, 400, SB_ROLE_SECOND);
  double width = free_right - left - 24;
  sb_canvas_text_fit(c, data->title ? data->title : "Sealbench", &title, left, rect.y + 44, width);

  // State first, then the subtitle in what is left of the line.
  char text[256] = "";
  double x = left;
  SbRole ink = SB_ROLE_WARN, ground = SB_ROLE_WARN_GROUND;
  if (data->failure) {
    g_strlcpy(text, data->failure, sizeof text);
    ink = SB_ROLE_ERROR;
    ground = SB_ROLE_ERROR_GROUND;
  } else if (data->stale) {
    g_strlcpy(text, data->stale, sizeof text);
  } else if (data->run.state == SB_CHART_PARTIAL) {
    g_strlcpy(text, _("partial: the run was cancelled"), sizeof text);
  } else if (data->run.state == SB_CHART_FAILED) {
    g_strlcpy(text, _("the solver did not converge: up to the last good state"), sizeof text);
    ink = SB_ROLE_ERROR;
    ground = SB_ROLE_ERROR_GROUND;
  } else if (data->run.state == SB_CHART_RUNNING) {
    g_snprintf(text, sizeof text, _("being computed, %.0f\xc2\xa0%%"),
               100 * CLAMP(data->progress, 0, 1));
  }
  if (text[0]) {
    x += state_chip(c, text, ink, ground, left, rect.y + 68, width) + 12;
  }
  char conditions[160];
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

void sb_page_foot_draw(cairo_t *cr, SbRect rect, const SbTheme *theme, const SbPageFoot *foot) {
  SbCanvas canvas;
  SbCanvas *c = &canvas;
  sb_canvas_init(c, cr, theme);
  double left = rect.x + SB_GRID_MARGIN, right = rect.x + rect.width - SB_GRID_MARGIN;
  bool narrow = is_narrow(rect);
  double y2 = rect.y + rect.height - 20, y = y2 - 18;
  bool very_narrow = is_very_narrow(rect);
  double y_version = narrow ? y : y2, y_warn = y;
  if (very_narrow) {
    y_version = y2;
    y2 -= 18;
    y -= 18;
  }
  if (narrow) {
    y_warn = y2;
    y2 -= 18;
    y -= 18;
    y_version = very_narrow ? y_version : y;
  }
  SbTextStyle bold = sb_canvas_style(c, SB_TYPE_LABEL, 700, SB_ROLE_SECOND);
  SbTextStyle plain = sb_canvas_style(c, SB_TYPE_LABEL, 400, SB_ROLE_SECOND);
  SbTextStyle third = sb_canvas_style(c, SB_TYPE_LABEL, 400, SB_ROLE_THIRD);
  SbTextStyle warn = sb_canvas_style(c, SB_TYPE_LABEL, 400, SB_ROLE_WARN);
  SbTextStyle warn_bold = sb_canvas_style(c, SB_TYPE_LABEL, 700, SB_ROLE_WARN);

  // Right: version and run; measured first because it may not be cut.
  const char *version = foot->version;
  double version_width = sb_canvas_text_width(c, version, &third);
  sb_canvas_text(c, version, &third, right, y_version, SB_RIGHT);

  // Left: models and errors.
  double width = sb_canvas_text(c, _("Models"), &bold, left, y, SB_LEFT);
  const char *text = foot->models;
  double models_width = sb_canvas_text_width(c, text, &plain);
  size_t warnings = foot->warnings ? foot->warnings->count + foot->warnings->dropped : 0;
  double room = right - left - width - 8 - (narrow && !very_narrow ? version_width + 24 : 0);
  double models_room = warnings && !narrow ? fmin(models_width, 0.62 * room) : room;
  models_room = sb_canvas_text_fit(c, text, &plain, left + width + 8, y, models_room);
  double warn_left = narrow ? left : left + width + 8 + models_room + 32;

  width = sb_canvas_text(c, _("Error estimates"), &bold, left, y2, SB_LEFT);
  sb_canvas_text_fit(c, foot->errors, &plain, left + width + 8, y2,
                     right - left - width - 8 - (narrow ? 0 : version_width + 24));

  // Right: as many warnings as fit, the number of the others.
  if (warnings) {
    const SbWarnings *list = foot->warnings;
    const char *head = warnings == 1 ? _("Warning") : _("Warnings");
    double head_width = sb_canvas_text_width(c, head, &warn_bold) + 8;
    double space = right - warn_left - head_width;
    g_autoptr(GString) line = g_string_new(NULL);
    // The serious first, so that none of them is among the number of the others.
    const char *texts[SB_WARNINGS_MAX];
    size_t shown = 0, ordered = 0;
    for (int pass = 1; pass >= 0; pass--) {
      for (size_t i = 0; i < list->count; i++) {
        if (sb_warning_is_serious(list->item[i].code) == (pass == 1)) {
          texts[ordered++] = list->item[i].text;
        }
      }
    }
    while (shown < list->count) {
      g_autofree char *tried =
          g_strdup_printf("%s%s%s", line->str, shown ? ";  " : "", texts[shown]);
      char rest[48] = "";
      if (warnings - shown - 1 > 0) {
        g_snprintf(rest, sizeof rest, _("  and %zu more"), warnings - shown - 1);
      }
      g_autofree char *whole = g_strconcat(tried, rest, NULL);
      if (shown > 0 && sb_canvas_text_width(c, whole, &warn) > space) {
        break;
      }
      g_string_assign(line, tried);
      shown++;
    }
    char rest[48] = "";
    if (warnings > shown) {
      g_snprintf(rest, sizeof rest, _("  and %zu more"), warnings - shown);
    }
    double rest_width = rest[0] ? sb_canvas_text_width(c, rest, &warn_bold) : 0;
    double line_width = fmin(sb_canvas_text_width(c, line->str, &warn), space - rest_width);
    double x = narrow ? left : right - rest_width - line_width - head_width;
    sb_canvas_text(c, head, &warn_bold, x, y_warn, SB_LEFT);
    sb_canvas_text_fit(c, line->str, &warn, x + head_width, y_warn, line_width + 0.5);
    if (rest[0]) {
      sb_canvas_text(c, rest, &warn_bold, x + head_width + line_width, y_warn, SB_LEFT);
    }
  }
  sb_canvas_finish(c);
}

void sb_page_footer_draw(cairo_t *cr, SbRect rect, const SbTheme *theme, const SbChartData *data,
                         unsigned flags) {
  char models[512], errors[512], version[160];
  sb_page_models_text(models, sizeof models, &data->run);
  sb_page_errors_text(errors, sizeof errors, &data->run);
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
