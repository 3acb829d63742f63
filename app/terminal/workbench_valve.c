// The page of the valve: loop, figures next to it, section and timeline.
#include "app/terminal/workbench_private.h"

#include "app/base/device.h"
#include "app/base/figure_text.h"
#include "app/base/translation.h"

#include <glib/gi18n.h>
#include <math.h>

// Figures beside the loop ------------------------------------------------------------------------

static const struct {
  const char *label, *figure;
} compared[] = {
    {N_("B break-away"), "cycle.force_breakaway_N"},
    {"C", "cycle.stages.C.force_N"},
    {"D", "cycle.stages.D.force_N"},
    {"E", "cycle.stages.E.force_N"},
    {N_("return margin"), "cycle.force_return_margin_N"},
    {N_("loss"), "cycle.energy_loss_J"},
    {N_("leak"), "cycle.leakage_per_cycle_m3"},
};

// One row: the live figure, then those of the pins, all with the unit of the live one and the
// decimals that the error of the differences supports.
static void compare_row(SbBench *bench, int x, int y, const char *label, int figure,
                        const SbSummary *live, SbPen own) {
  enum { LABEL = 13, EACH = 8, LIVE = 7 };
  SbCells *cells = &bench->cells;
  const SbChartData *data = sb_session_chart(bench->session);
  SbFigureCompared design[1 + SB_CHART_PINS];
  const size_t count = 1 + data->pin_count;
  for (size_t i = 0; i < count; i++) {
    const SbChartRun *run = i == 0 ? &data->run : data->pin[i - 1].run;
    const SbSummary *summary = i == 0 ? live : run->summary;
    design[i] = (SbFigureCompared){summary != NULL ? sb_figure_value(summary, figure) : NAN,
                                   summary != NULL ? sb_figure_error(summary, figure) : NAN,
                                   run->model != NULL ? sb_model_methods(run->model) : 0};
  }
  const char *unit = sb_figure_compared_unit(figure, design, count);
  g_autofree char *head = sb_figure(figure)->quantity == SB_FIGURE_QUANTITY_FORCE
                              ? g_strdup(label)
                              : g_strdup_printf("%s / %s", label, unit);
  sb_cells_text(cells, x, y, LABEL, head, sb_bench_pen(bench, SB_ROLE_SECOND, 0));
  for (size_t i = 0; i < count; i++) {
    char number[SB_FORMAT_MAX], change[SB_FORMAT_MAX];
    (void)sb_figure_compared(number, change, figure, design, count, i);
    const int right = x + LABEL + LIVE + ((int)i - 1) * EACH;
    sb_cells_text_right(cells, i == 0 ? x + LABEL : right, y, i == 0 ? LIVE : EACH,
                        isnan(design[i].value) ? "–" : number,
                        i == 0 ? own
                               : sb_bench_pen(bench, sb_chart_pin_role(data->pin[i - 1].look), 0));
  }
}

static void draw_bar(SbBench *bench, SbCellRect rect, int y, const char *name, double value,
                     double scale, SbRole role) {
  char number[SB_FORMAT_MAX];
  sb_format_text(number, SB_QUANTITY_FORCE, value,
                 sb_chart_error_force(&sb_session_chart(bench->session)->run));
  const int at = rect.x + 15;
  sb_cells_text(&bench->cells, rect.x, y, 15, name, sb_bench_pen(bench, SB_ROLE_SECOND, 0));
  sb_cells_text_right(&bench->cells, at, y, 7, number, sb_bench_pen(bench, role, SB_CELL_BOLD));
  const int room = 8 * MAX(rect.width - 24, 0);
  sb_cells_bar(&bench->cells, at + 8, y, scale > 0 ? (int)lround(fabs(value) / scale * room) : 0,
               sb_bench_pen(bench, role, 0));
}

static void draw_valve_now(SbBench *bench, SbCellRect rect) {
  const SbChartData *data = sb_session_chart(bench->session);
  const SbChartPredicted *predicted = data->predicted;
  const SbFrame *frame = predicted != NULL ? predicted->run.frames : sb_chart_frame(data);
  if (frame == NULL || rect.height < 2) {
    return;
  }
  SbCells *cells = &bench->cells;
  const int bottom = rect.y + rect.height;
  int y = rect.y;
  g_autofree char *phase = g_strdup_printf("%s, %s", sb_chart_span(&data->run, frame->stage),
                                           sb_chart_phase(&data->run, frame->stage));
  const int word =
      sb_cells_text(cells, rect.x, y, rect.width, predicted != NULL ? _("Predicted") : _("Now"),
                    sb_bench_pen(bench, SB_ROLE_NOW, SB_CELL_BOLD));
  sb_cells_text(cells, rect.x + word + 2, y, rect.width - word - 2, phase,
                sb_bench_pen(bench, SB_ROLE_NOW, 0));
  y++;
  SbChartForce force[SB_CHART_FORCES_MAX];
  const size_t forces = sb_chart_forces(force, data->run.model, frame);
  double scale = 0;
  for (size_t i = 0; i < forces; i++) {
    scale = fmax(scale, fabs(force[i].force));
  }
  for (size_t i = 0; i < forces && y < bottom; i++) {
    draw_bar(bench, rect, y++, force[i].name, force[i].force, scale, force[i].role);
  }
  y++;
  static const char *const contacts[SB_SEAL_COUNT] = {N_("outer contact"), N_("inner contact")};
  static const char *const films[SB_SEAL_COUNT] = {N_("outer film"), N_("inner film")};
  for (int i = 0; i < SB_SEAL_COUNT && y < bottom; i++) {
    const SbSealFrame *seal = &frame->seal[i];
    const SbRole role = i == SB_OUTER ? SB_ROLE_OUTER : SB_ROLE_INNER;
    char peak[SB_FORMAT_MAX], width[SB_FORMAT_MAX], film[SB_FORMAT_MAX], text[3 * SB_FORMAT_MAX];
    sb_cells_text(cells, rect.x, y, 15, _(contacts[i]), sb_bench_pen(bench, SB_ROLE_SECOND, 0));
    const bool touches = seal->contact_right > seal->contact_left && seal->load > 0;
    sb_format_text(peak, SB_QUANTITY_PRESSURE, seal->pressure_peak, 0);
    sb_format_text(width, SB_QUANTITY_LENGTH, seal->contact_right - seal->contact_left, 0);
    g_snprintf(text, sizeof text, "%s, %s", peak, width);
    sb_cells_text_right(cells, rect.x + 14, y++, rect.width - 14, touches ? text : _("none"),
                        sb_bench_pen(bench, touches ? role : SB_ROLE_THIRD, 0));
    if (!touches || y >= bottom || !(seal->film_central > 0)) {
      continue;
    }
    // Thinner than the roughness or than some molecules it is a formal result.
    sb_format_text(film, SB_QUANTITY_FILM, seal->film_central, 0);
    const bool formal = seal->lambda < 1;
    char lambda[SB_FORMAT_MAX];
    sb_format_digits(lambda, seal->lambda, 2);
    g_snprintf(text, sizeof text, "%s%s λ %s", film, formal ? " ⚠" : "", lambda);
    sb_cells_text(cells, rect.x, y, 15, _(films[i]), sb_bench_pen(bench, SB_ROLE_SECOND, 0));
    sb_cells_text_right(cells, rect.x + 14, y++, rect.width - 14, text,
                        sb_bench_pen(bench, formal ? SB_ROLE_WARN : role, 0));
  }
}

static void draw_table(SbBench *bench, SbCellRect rect) {
  SbCells *cells = &bench->cells;
  const SbChartData *data = sb_session_chart(bench->session);
  const SbPen bold = sb_bench_pen(bench, SB_ROLE_INK, SB_CELL_BOLD);
  const int live = rect.x + 13, each = 8;
  sb_cells_text(cells, rect.x, rect.y, 12, _("Compare"), bold);
  const SbSummary *predicted = sb_session_predicted(bench->session);
  const SbSummary *summary = predicted != NULL ? predicted : data->run.summary;
  const SbPen own = predicted != NULL ? sb_bench_pen(bench, SB_ROLE_WARN, 0) : bold;
  sb_cells_text_right(cells, live - 2, rect.y, 9,
                      predicted != NULL ? C_("column", "predicted") : _("live"), own);
  for (size_t i = 0; i < data->pin_count; i++) {
    // The end of a name tells it from others: "1.63 mm".
    const char *name = data->pin[i].name;
    const int length = (int)g_utf8_strlen(name, -1);
    name = g_utf8_offset_to_pointer(name, MAX(length - each + 1, 0));
    sb_cells_text_right(cells, live + 7 + (int)i * each, rect.y, each, name,
                        sb_bench_pen(bench, sb_chart_pin_role(data->pin[i].look), 0));
  }
  int y = rect.y + 2;
  for (size_t i = 0; i < G_N_ELEMENTS(compared) && y < rect.y + rect.height; i++, y++) {
    compare_row(bench, rect.x, y, _(compared[i].label), sb_figure_find(compared[i].figure), summary,
                own);
  }
  draw_valve_now(bench, (SbCellRect){rect.x, y + 1, rect.width, rect.y + rect.height - y - 1});
}

// Section ----------------------------------------------------------------------------------------

// The list of the section at the playhead for as many cells; false where there is none.
static bool section_list(SbBench *bench, int columns, double rows) {
  enum { ACROSS = 8, DOWN = 16 }; // logical pixels of a cell: letters fill it
  SbSectionSourceNow now;
  // Its fonts and scales take as long as all the rest of the first screen, which does not wait for
  // them; nor is the valve at rest solved to be seen for the milliseconds of the first run.
  if (!bench->begun || (sb_session_run(bench->session) == NULL &&
                        sb_session_state(bench->session) == SB_SESSION_RUNNING)) {
    return false;
  }
  if (!sb_device(sb_session_chart(bench->session)->run.model)->stem ||
      !sb_section_source_now(bench->source, &now)) {
    return false;
  }
  const SbSectionLook *look = sb_model_look(sb_run_model(now.run));
  const SbSectionView view = {
      .width = ACROSS * columns,
      .height = DOWN * rows,
      .dark = true,
      .bare = true,
      .hide_insets = true,
      .zoom = bench->zoom,
      .field = bench->field,
      .field_max = look->field_max,
  };
  SbSectionInstant instant = {.frame = now.frame};
  for (int i = 0; i < SB_SEAL_COUNT; i++) {
    instant.profile[i] = sb_run_profile(now.run, now.frame->seal[i].profile);
    instant.ring[i] = sb_run_shape(now.run, now.frame->seal[i].shape);
  }
  sb_section_draw(now.section, &bench->drawing, &view, &instant);
  bench->solved = instant.ring[SB_OUTER] != NULL || instant.ring[SB_INNER] != NULL;
  return true;
}

// On the line over the section: the field and its colours.
static void draw_section_head(SbBench *bench, int x, int y, int width, bool drawn) {
  SbCells *cells = &bench->cells;
  const SbPen quiet = sb_bench_pen(bench, SB_ROLE_SECOND, 0);
  int at = x + 2;
  at += sb_cells_text(cells, at, y, width - 4, " ", quiet);
  at += sb_cells_text(cells, at, y, width - 5, _("Section"),
                      sb_bench_pen(bench, SB_ROLE_INK, SB_CELL_BOLD));
  at += sb_cells_text(cells, at, y, 2, "  ", quiet);
  // The ring's mesh has the map that holds for the whole run.
  const SbDrawItem *mesh = NULL;
  for (size_t i = 0; drawn && bench->solved && i < bench->drawing.item_count; i++) {
    const SbDrawItem *item = &bench->drawing.item[i];
    mesh = item->kind == SB_DRAW_MESH && (mesh == NULL || item->count > mesh->count) ? item : mesh;
  }
  const int room = x + width - 22;
  if (mesh != NULL) {
    enum { STEPS = 12 };
    char low[SB_FORMAT_MAX], high[SB_FORMAT_MAX];
    const double scale = sb_section_field_scale(bench->field);
    sb_format_digits(low, mesh->map_min * scale, 2);
    sb_format_digits(high, mesh->map_max * scale, 2);
    g_autofree char *text =
        g_strdup_printf("%s %s ", sb_translation(sb_section_field_name(bench->field)), low);
    g_autofree char *end = g_strdup_printf(" %s %s ", high, sb_section_field_unit(bench->field));
    at += sb_cells_text(cells, at, y, MAX(room - at, 0), text, quiet);
    for (int i = 0; i < STEPS && at < room; i++, at++) {
      const SbColor color = sb_theme_field(sb_theme(true), (i + 0.5) / STEPS);
      sb_cells_put(cells, at, y, 0x2588, (SbPen){sb_cell_color(color), SB_CELL_OWN, 0});
    }
    at += sb_cells_text(cells, at, y, MAX(room - at, 0), end, quiet);
  } else {
    const bool soon = !bench->begun || sb_session_state(bench->session) == SB_SESSION_RUNNING;
    at += sb_cells_text(cells, at, y, MAX(room - at, 0),
                        drawn  ? _("rings schematic ")
                        : soon ? ""
                               : _("nothing to draw "),
                        quiet);
  }
  if (width > 50) {
    g_autofree char *keys = g_strdup_printf(" f %s  i %s ", _("field"), _("inset"));
    sb_cells_text_right(cells, x, y, width - 2, keys, quiet);
  }
}

static void draw_section(SbBench *bench, SbCellRect rect) {
  const SbPictures pictures = sb_screen_pictures(bench->screen);
  int width, height;
  sb_screen_cell_size(bench->screen, &width, &height);
  const double rows = sb_pictures_are_pixels(pictures)
                          ? (double)sb_picture_height(pictures, rect.height, height) / height
                          : rect.height;
  const bool drawn = section_list(bench, rect.width, rows);
  draw_section_head(bench, rect.x - 1, rect.y - 1, rect.width + 1, drawn);
  // A line that is slow gets the picture when it stands still.
  const bool moves = sb_session_is_playing(bench->session);
  if (!drawn || pictures == SB_PICTURES_NONE || (moves && sb_screen_is_slow(bench->screen))) {
    return;
  }
  if (sb_pictures_are_pixels(pictures) && bench->popup == SB_POPUP_NONE) {
    bench->pixels = sb_picture_pixels(&bench->drawing, bench->text, pictures, rect.width,
                                      rect.height, width, height);
    bench->pixels_at = rect;
  } else if (pictures == SB_PICTURES_LINES) {
    sb_picture_lines(&bench->cells, rect, &bench->drawing);
  } else {
    sb_picture_blocks(&bench->cells, rect, &bench->drawing, bench->text);
  }
}

// Timeline ---------------------------------------------------------------------------------------

static void draw_timeline(SbBench *bench, SbCellRect rect) {
  const SbChartData *data = sb_session_chart(bench->session);
  SbCells *cells = &bench->cells;
  const SbFrame *frame = sb_chart_frame(data);
  bench->timeline_at = (SbCellRect){0, 0, 0, 0};
  if (frame == NULL || data->run.trace == NULL) {
    return;
  }
  const double end = fmax(data->run.frames[data->run.count - 1].time, 1e-9);
  const int last = rect.width - 1;
  const int now = (int)lround(frame->time / end * last);
  for (int x = 0; x < rect.width; x++) {
    sb_cells_put(cells, rect.x + x, rect.y, x <= now ? 0x2501 : 0x2500,
                 sb_bench_pen(bench, x <= now ? SB_ROLE_INK : SB_ROLE_THIRD, 0));
  }
  char time[SB_FORMAT_MAX];
  sb_format_text(time, SB_QUANTITY_TIME, frame->time, 0);
  g_autofree char *label =
      g_strdup_printf("%s%s", time, sb_session_is_playing(bench->session) ? " ▶" : "");
  const int width = sb_cells_width(cells, label);
  const SbPen pen = sb_bench_pen(bench, SB_ROLE_NOW, SB_CELL_BOLD);
  size_t events = 0;
  const SbTraceEvent *event = sb_trace_events(data->run.trace, &events);
  // On the side on which it hides fewer events.
  int hides[2] = {now < width + 1 ? 100 : 0, now + 2 + width > rect.width ? 100 : 0};
  for (size_t i = 0; i < events; i++) {
    const int x = (int)lround(event[i].mark.time / end * last);
    hides[0] += x >= now - width && x < now;
    hides[1] += x > now && x < now + 2 + width;
  }
  const int at = hides[0] <= hides[1] ? now - width : now + 1;
  sb_cells_text(cells, rect.x + at, rect.y, width, label, pen);
  for (size_t i = 0; i < events; i++) {
    const int x = (int)lround(event[i].mark.time / end * last);
    // Not inside of the time, which would read as another one.
    if (x >= 0 && x < rect.width && (x < at || x >= at + width)) {
      sb_cells_put(cells, rect.x + x, rect.y, (uint32_t)sb_stage_name(event[i].stage)[0],
                   sb_bench_pen(bench, SB_ROLE_INK, SB_CELL_BOLD));
    }
  }
  sb_cells_put(cells, rect.x + now, rect.y, 0x25bc, pen);
  bench->timeline_at = rect;
}

// The page ---------------------------------------------------------------------------------------

static void draw_loop(SbBench *bench, SbCellRect rect) {
  SbCells *cells = &bench->cells;
  SbChartData data = *sb_session_chart(bench->session);
  const SbDevice *device = sb_device(data.run.model);
  const int title = sb_cells_text(cells, rect.x, rect.y, rect.width, _(device->loop),
                                  sb_bench_pen(bench, SB_ROLE_INK, SB_CELL_BOLD));
  g_autofree char *former = sb_session_former_text(bench->session);
  g_autofree char *grade = sb_session_grade_text(bench->session);
  sb_cells_text(cells, rect.x + title + 2, rect.y, rect.width - title - 2,
                data.predicted != NULL ? _("dotted: predicted")
                : former != NULL       ? former
                : grade != NULL        ? grade
                                       : _(device->axes),
                sb_bench_pen(bench, former != NULL ? SB_ROLE_WARN : SB_ROLE_SECOND, 0));
  const SbCellRect at = {rect.x, rect.y + 1, rect.width, rect.height - 1};
  if (data.run.count == 0) {
    const char *text = sb_session_state(bench->session) == SB_SESSION_RUNNING
                           ? _("being computed…")
                           : _("nothing has run");
    sb_cells_text(cells, at.x + 2, at.y + at.height / 2, at.width - 2, text,
                  sb_bench_pen(bench, SB_ROLE_SECOND, 0));
    return;
  }
  sb_chart_loop(cells, at, &bench->theme, &data, 0);
}

void sb_bench_draw_valve(SbBench *bench, SbCellRect rect) {
  SbCells *cells = &bench->cells;
  const SbPen line = sb_bench_pen(bench, SB_ROLE_AXIS, 0);
  const int list = rect.width >= 100 ? 38 : 34;
  const int table = rect.width >= 110 ? 35 : 0;
  const int section = rect.height >= 24 ? rect.height * 11 / 31 : 0;
  const int above = rect.height - 1 - (section > 0 ? section + 1 : 0); // loop and table
  sb_bench_draw_list(bench, (SbCellRect){rect.x, rect.y, list, rect.height});
  for (int y = rect.y; y < rect.y + rect.height; y++) {
    sb_cells_put(cells, list, y, 0x2502, line);
  }
  sb_cells_put(cells, list, rect.y - 1, 0x252c, line);
  const int middle = rect.width - list - 1 - table;
  draw_loop(bench, (SbCellRect){list + 2, rect.y, middle - 3, above});
  if (table > 0) {
    const int x = rect.width - table;
    for (int y = rect.y; y < rect.y + above; y++) {
      sb_cells_put(cells, x, y, 0x2502, line);
    }
    sb_cells_put(cells, x, rect.y - 1, 0x252c, line);
    draw_table(bench, (SbCellRect){x + 2, rect.y, table - 3, above});
  }
  if (section > 0) {
    const int y = rect.y + above;
    for (int x = list + 1; x < rect.width; x++) {
      sb_cells_put(cells, x, y, 0x2500, line);
    }
    sb_cells_put(cells, list, y, 0x251c, line);
    if (table > 0) {
      sb_cells_put(cells, rect.width - table, y, 0x2534, line);
    }
    draw_section(bench, (SbCellRect){list + 2, y + 1, rect.width - list - 4, section});
  }
  draw_timeline(bench, (SbCellRect){list + 2, rect.y + rect.height - 1, rect.width - list - 4, 1});
}
