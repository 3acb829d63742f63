// A scene's pages. What nobody may miss is on the first: the verdict, serious warnings, the
// section; then the loop and the contact as the window draws them, all figures, and what they rest
// on.
#include "app/export/report.h"

#include "app/base/figure_text.h"
#include "app/base/translation.h"
#include "app/chart/hysteresis.h"
#include "app/chart/life.h"
#include "app/chart/page.h"
#include "app/chart/profiles.h"
#include "app/chart/rig.h"
#include "app/chart/shelf.h"
#include "app/chart/signal.h"
#include "app/chart/study.h"
#include "app/chart/timeline.h"
#include "app/export/pdf.h"
#include "app/export/render.h"
#include "app/section/painter.h"

#include <math.h>
#include <string.h>

#define DOT  "  \xc2\xb7  "
#define DASH "\xe2\x80\x93"

// What the pictures share.
typedef struct {
  const SbReportScene *of;
  const SbSummary *summary;
  const SbModel *model;
  SbChartData data;
  SbSectionPainter *painter;
  bool rig;
  char *files; // "piston.valve . thesis-cycle.scene"
} Scene;

unsigned sb_report_views(const SbModel *model) {
  return SB_VIEW_SECTION | SB_VIEW_HYSTERESIS | SB_VIEW_PROFILES |
         (unsigned)sb_model_number(model, SB_P_OUTPUT_VIEWS);
}

char *sb_report_files(const SbDocument *document) {
  const char *path = sb_document_path(document), *valve_path = sb_document_valve_path(document);
  g_autofree char *own = g_path_get_basename(path != NULL ? path : "not saved");
  g_autofree char *valve = valve_path != NULL ? g_path_get_basename(valve_path) : NULL;
  return valve != NULL ? g_strconcat(valve, DOT, own, NULL) : g_steal_pointer(&own);
}

char *sb_report_foot(const char *files, const char *hash) {
  g_autofree char *day = sb_pdf_date("%Y-%m-%d");
  return g_strdup_printf("Sealbench %s" DOT "engine %.12s" DOT "%s%s%s" DOT "values %.8s",
                         sb_version(), sb_engine_identity()->source, files, *day != '\0' ? DOT : "",
                         day, hash);
}

// ---- Texts of figures ----

char *sb_report_value(const SbSummary *summary, int index) {
  const double value = sb_figure_value(summary, index);
  return isnan(value) ? g_strdup(DASH)
                      : sb_figure_format(index, value, sb_figure_error(summary, index));
}

char *sb_report_error(const SbSummary *summary, int index) {
  const double error = sb_figure_error(summary, index);
  char digits[SB_FORMAT_MAX];
  if (isnan(sb_figure_value(summary, index)) || isnan(error)) {
    return g_strdup("");
  }
  return error < 1e-9 ? g_strdup("rounding")
                      : g_strdup_printf("%s\xc2\xa0%%", sb_format_digits(digits, 100 * error, 2));
}

char *sb_report_margin(int figure, double value, double error, double low, double high) {
  const double below = value - low, above = high - value;
  const double margin = fmin(below, above), limit = below < above ? low : high;
  if (!isfinite(margin) || sb_figure(figure)->digits == 0) {
    return g_strdup("");
  }
  // The limit is exact: the margin has the absolute error of the value.
  g_autofree char *size =
      sb_figure_format(figure, fabs(margin), margin != 0 ? fabs(error * value / margin) : 0);
  g_autofree char *share =
      limit != 0 ? g_strdup_printf(" (%.0f\xc2\xa0%%)", 100 * fabs(margin / limit)) : g_strdup("");
  return g_strdup_printf("%s%s%s", margin < 0 ? "\xe2\x88\x92" : "", size, share);
}

static char *capital(const char *text) {
  char *out = g_strdup(text);
  out[0] = g_ascii_toupper(out[0]);
  return out;
}

// ---- First page ----

static void draw_verdict(SbReportPages *pages, const Scene *scene) {
  static const SbReportColumn columns[] = {
      {"Verdict", 1.1, SB_REPORT_WORDS},    {"", 0.7, SB_REPORT_ANSWER},
      {"Decided by", 3.4, SB_REPORT_WORDS}, {"Value", 1.4, SB_REPORT_NUMBER},
      {"Limit", 1.4, SB_REPORT_NUMBER},     {"Margin", 1.8, SB_REPORT_NUMBER},
      {"Case", 1, SB_REPORT_WORDS}};
  SbReportTable table = {.column = columns, .columns = G_N_ELEMENTS(columns)};
  for (int kind = 0; kind < SB_VERDICT_COUNT; kind++) {
    const SbCaseVerdict *verdict = &scene->of->verdict[kind];
    const SbVerdict *of = &verdict->of;
    g_autofree char *name = capital(sb_verdict_name((SbVerdictKind)kind));
    const bool known = of->figure >= 0, limited = known && isfinite(of->limit);
    g_autofree char *label = known ? sb_figure_label(of->figure) : g_strdup("");
    const char *reason = of->reason;
    g_autofree char *why = !known && *reason == '\0'   ? g_strdup("no limit is set")
                           : !known || *reason == '\0' ? g_strdup(known ? label : reason)
                                                       : g_strdup_printf("%s: %s", label, reason);
    const double error = known ? sb_figure_error(scene->summary, of->figure) : NAN;
    g_autofree char *value = known ? sb_figure_format(of->figure, of->value, error) : g_strdup("");
    g_autofree char *limit = limited ? sb_figure_given(of->figure, of->limit) : g_strdup("");
    // On which side of the limit a value should be, the answer tells.
    const bool above = (of->value >= of->limit) == (of->ok != SB_ANSWER_NO);
    g_autofree char *margin =
        limited ? sb_report_margin(of->figure, of->value, error, above ? of->limit : -INFINITY,
                                   above ? INFINITY : of->limit)
                : g_strdup("");
    static const char *const answers[] = {DASH, "NO", "yes"};
    const char *const cell[] = {name, answers[of->ok], why, value, limit, margin, verdict->name};
    sb_report_row(pages, &table, cell, of->ok == SB_ANSWER_NO ? SB_REPORT_WRONG : SB_REPORT_PLAIN);
  }
}

// All limits, not the deciding ones alone; of the scene itself.
static void draw_limits(SbReportPages *pages, const Scene *scene) {
  const SbLimits *limits = sb_document_limits(scene->of->document);
  static const SbReportColumn columns[] = {{"Limits of the scene itself", 4, SB_REPORT_WORDS},
                                           {"Limit", 2, SB_REPORT_NUMBER},
                                           {"Value", 1.6, SB_REPORT_NUMBER},
                                           {"Margin", 2, SB_REPORT_NUMBER}};
  SbReportTable table = {.column = columns, .columns = G_N_ELEMENTS(columns)};
  for (size_t i = 0; i < limits->count; i++) {
    const SbLimit *limit = &limits->item[i];
    const double value = sb_figure_value(scene->summary, limit->figure);
    g_autofree char *label = sb_figure_label(limit->figure);
    g_autofree char *text = sb_limit_format(limit->figure, limit->low, limit->high);
    g_autofree char *shown = sb_report_value(scene->summary, limit->figure);
    g_autofree char *margin =
        sb_report_margin(limit->figure, value, sb_figure_error(scene->summary, limit->figure),
                         limit->low, limit->high);
    const bool beyond = value < limit->low || value > limit->high;
    const char *const cell[] = {label, text, shown, margin};
    sb_report_row(pages, &table, cell,
                  beyond         ? SB_REPORT_WRONG
                  : isnan(value) ? SB_REPORT_DOUBT
                                 : SB_REPORT_PLAIN);
  }
}

static void draw_section(cairo_t *cr, SbRect rect, const SbTheme *theme, const void *of) {
  const Scene *scene = of;
  SbCanvas canvas;
  sb_canvas_init(&canvas, cr, theme);
  sb_canvas_panel(&canvas, rect);
  sb_canvas_finish(&canvas);
  if (scene->rig) {
    sb_rig_plate_draw(cr, rect, theme, &scene->data, SB_CHART_PANEL);
    return;
  }
  cairo_rectangle(cr, rect.x, rect.y, rect.width, rect.height);
  cairo_clip(cr);
  // Drawn for a window's width: at that of a page its labels would lie over each other.
  const double scale = 0.72;
  cairo_translate(cr, rect.x, rect.y);
  cairo_scale(cr, scale, scale);
  sb_section_painter_draw(cr, (SbRect){0, 0, rect.width / scale, rect.height / scale}, theme,
                          &scene->data, scene->painter);
}

// Sentences of what the run found that nobody may miss, and of what it lacks.
static void draw_notices(SbReportPages *pages, const Scene *scene) {
  const SbSummary *summary = scene->summary;
  if (summary->status == SB_ERROR_CANCELLED) {
    sb_report_notice(pages, "The run was interrupted: pictures and figures are partial.", true);
  } else if (!summary->converged) {
    sb_report_notice(pages, "A solver did not converge: the results end at the last good state.",
                     true);
  }
  for (size_t i = 0; i < summary->warnings.count; i++) {
    const SbWarning *warning = &summary->warnings.item[i];
    if (sb_warning_is_serious(warning->code)) {
      g_autofree char *text = capital(warning->text);
      sb_report_notice(pages, text, false);
    }
  }
}

// The cycle's figures that somebody wants large or small.
static void draw_key_figures(SbReportPages *pages, const SbSummary *summary, bool rig) {
  static const SbReportColumn columns[] = {{"Key figures", 4, SB_REPORT_WORDS},
                                           {"Value", 2, SB_REPORT_NUMBER},
                                           {"Error estimate", 2, SB_REPORT_NUMBER}};
  SbReportTable table = {.column = columns, .columns = G_N_ELEMENTS(columns)};
  for (int i = 0; i < SB_FIGURE_COUNT; i++) {
    const SbFigure *figure = sb_figure(i);
    if (figure->brief && (rig || figure->better != SB_BETTER_NONE) &&
        !isnan(sb_figure_value(summary, i)) &&
        figure->group == (rig ? SB_GROUP_RIG : SB_GROUP_CYCLE) && figure->error != SB_BY_RESIDUAL) {
      g_autofree char *value = sb_report_value(summary, i), *error = sb_report_error(summary, i);
      const char *const cell[] = {figure->label, value, error};
      sb_report_row(pages, &table, cell, SB_REPORT_PLAIN);
    }
  }
}

static void draw_summary(SbReportPages *pages, const Scene *scene) {
  char conditions[160];
  sb_page_conditions_text(conditions, sizeof conditions, &scene->data.run);
  g_autofree char *line =
      g_strconcat(scene->files, conditions[0] != '\0' ? DOT : "", conditions, NULL);
  sb_report_title(pages, sb_document_title(scene->of->document), line);
  sb_report_skip(pages, 8);
  draw_notices(pages, scene);
  if (!scene->rig) {
    sb_report_skip(pages, 4);
    draw_verdict(pages, scene);
    sb_report_skip(pages, 14);
  }
  if (scene->data.run.count > 0) {
    sb_report_picture(pages, 372, draw_section, scene);
    const SbFrame *frame = sb_chart_frame(&scene->data);
    char time[SB_FORMAT_MAX], place[SB_FORMAT_MAX];
    if (frame != NULL) {
      sb_format_text(time, SB_QUANTITY_TIME, frame->time, NAN);
      sb_format_text(place, SB_QUANTITY_LENGTH, frame->displacement, NAN);
      g_autofree char *caption =
          scene->rig ? g_strdup_printf("The plate at %s, after a travel of %s.", time, place)
                     : g_strdup_printf("Section at %s, stem at %s, stage %s: the seals' figures "
                                       "are those of this state.",
                                       time, place, sb_chart_span(&scene->data.run, frame->stage));
      sb_report_text(pages, caption, SB_TYPE_NOTE, 400, SB_ROLE_SECOND);
    }
  }
  sb_report_skip(pages, 10);
  if (sb_document_limits(scene->of->document)->count > 0 && !scene->rig) {
    draw_limits(pages, scene);
    sb_report_skip(pages, 14);
  }
  draw_key_figures(pages, scene->summary, scene->rig);
}

// ---- Loop and contact ----

static void draw_loop(cairo_t *cr, SbRect rect, const SbTheme *theme, const void *of) {
  const Scene *scene = of;
  if (scene->rig) {
    sb_signal_draw(cr, rect, theme, &scene->data, SB_CHART_PANEL | SB_CHART_WHOLE);
  } else {
    sb_hysteresis_draw(cr, rect, theme, &scene->data, SB_CHART_PANEL | SB_CHART_WHOLE);
  }
}

static void draw_timeline(cairo_t *cr, SbRect rect, const SbTheme *theme, const void *of) {
  sb_timeline_draw(cr, rect, theme, &((const Scene *)of)->data, SB_CHART_PANEL);
}

static void draw_pressure(cairo_t *cr, SbRect rect, const SbTheme *theme, const void *of) {
  sb_profiles_pressure_draw(cr, rect, theme, &((const Scene *)of)->data, SB_CHART_PANEL);
}

static void draw_film(cairo_t *cr, SbRect rect, const SbTheme *theme, const void *of) {
  sb_profiles_film_draw(cr, rect, theme, &((const Scene *)of)->data, SB_CHART_PANEL);
}

static void draw_rig(cairo_t *cr, SbRect rect, const SbTheme *theme, const void *of) {
  sb_rig_figures_draw(cr, rect, theme, &((const Scene *)of)->data, SB_CHART_PANEL);
}

static void draw_life(cairo_t *cr, SbRect rect, const SbTheme *theme, const void *of) {
  sb_life_draw(cr, rect, theme, &((const Scene *)of)->data);
}

static void draw_shelf(cairo_t *cr, SbRect rect, const SbTheme *theme, const void *of) {
  const double scale = 0.75; // as a study's
  cairo_translate(cr, rect.x, rect.y);
  cairo_scale(cr, scale, scale);
  sb_shelf_draw(cr, (SbRect){0, 0, rect.width / scale, rect.height / scale}, theme,
                &((const Scene *)of)->data);
}

static char *newtons(double force) {
  char text[SB_FORMAT_MAX];
  return isfinite(force) ? g_strdup(sb_format_text(text, SB_QUANTITY_FORCE, force, NAN))
                         : g_strdup(DASH);
}

static void draw_measured(SbReportPages *pages, const SbComparison *comparison) {
  static const SbReportColumn columns[] = {{"Stage", 1, SB_REPORT_WORDS},
                                           {"Measured", 1.2, SB_REPORT_NUMBER},
                                           {"Model", 1.2, SB_REPORT_NUMBER},
                                           {"Difference", 1.2, SB_REPORT_NUMBER},
                                           {"", 3, SB_REPORT_WORDS}};
  const SbMeasured *measured = comparison->measured;
  SbReportTable table = {.column = columns, .columns = G_N_ELEMENTS(columns)};
  g_autofree char *heading = g_strdup_printf("Measured: %s", measured->name);
  sb_report_heading(pages, heading, 120);
  for (int s = SB_STAGE_B; s < SB_STAGE_COUNT; s++) {
    const SbMeasuredStage *stage = &measured->stage[s];
    const double force = stage->found ? stage->force : NAN, model = comparison->model_force[s];
    g_autofree char *first = newtons(force), *second = newtons(model);
    g_autofree char *third = newtons(force - model);
    const char *const cell[] = {sb_stage_name((SbStage)s), first, second, third,
                                stage->found ? NULL : stage->reason};
    sb_report_row(pages, &table, cell, SB_REPORT_PLAIN);
  }
  g_autofree char *rms = newtons(comparison->rms), *most = newtons(comparison->most);
  g_autofree char *mean = newtons(comparison->mean);
  g_autofree char *sum =
      g_strdup_printf("Differences at equal displacement, measured less model: root mean square "
                      "%s, mean %s, maximum %s, over %zu points.",
                      rms, mean, most, comparison->count - comparison->outside);
  sb_report_skip(pages, 6);
  sb_report_text(pages, sum, SB_TYPE_LABEL, 400, SB_ROLE_INK);
  g_autofree char *text = sb_measured_text(measured);
  sb_report_text(pages, g_strchomp(text), SB_TYPE_NOTE, 400, SB_ROLE_SECOND);
}

static void draw_cycle(SbReportPages *pages, const Scene *scene) {
  if (scene->data.run.count == 0) {
    return;
  }
  sb_report_page(pages, false);
  sb_report_heading(pages, scene->rig ? "Force in the thread" : "Force, contact and film", 700);
  sb_report_picture(pages, 400, draw_loop, scene);
  sb_report_picture(pages, 104, draw_timeline, scene);
  if (scene->rig) {
    sb_report_picture(pages, 400, draw_rig, scene);
  } else {
    sb_report_picture(pages, 208, draw_pressure, scene);
    sb_report_picture(pages, 208, draw_film, scene);
  }
  if (scene->of->measured != NULL) {
    draw_measured(pages, scene->of->measured);
  }
  if (scene->summary->life.done > 0) {
    sb_report_heading(pages, "Life over its actuations", 560);
    sb_report_picture(pages, 540, draw_life, scene);
  }
  if (scene->summary->shelf.points > 0) {
    sb_report_heading(pages, "Loss on the shelf", 620);
    sb_report_picture(pages, 600, draw_shelf, scene);
  }
}

// ---- Figures ----

// Those of the short table that belong to a group, behind a line that names them.
static void add_figures(SbReportPages *pages, SbReportTable *table, const SbSummary *summary,
                        SbFigureGroup group, const char *name, bool known) {
  bool named = false;
  for (int i = 0; i < SB_FIGURE_COUNT; i++) {
    const SbFigure *figure = sb_figure(i);
    const char *reason = sb_figure_reason(summary, i);
    if (!figure->brief || figure->group != group || (known && isnan(sb_figure_value(summary, i)))) {
      continue;
    }
    const char *const head[] = {name, NULL, NULL, NULL};
    if (!named) {
      sb_report_row(pages, table, head, SB_REPORT_GROUP);
      named = true;
    }
    g_autofree char *value = sb_report_value(summary, i), *error = sb_report_error(summary, i);
    g_autofree char *why =
        reason != NULL ? g_strdup_printf("not computed: %s", reason) : g_strdup(figure->help);
    const char *const cell[] = {figure->label, value, error, why};
    sb_report_row(pages, table, cell, SB_REPORT_PLAIN);
  }
}

static void draw_stages(SbReportPages *pages, const SbSummary *summary) {
  static const SbReportColumn columns[] = {{"Stage", 0.6, SB_REPORT_WORDS},
                                           {"Time", 1, SB_REPORT_NUMBER},
                                           {"Stem", 1, SB_REPORT_NUMBER},
                                           {"Force", 1, SB_REPORT_NUMBER},
                                           {"Event", 4, SB_REPORT_WORDS}};
  static const char *const events[SB_STAGE_COUNT] = {"start",
                                                     "first slip, the force at its peak",
                                                     "the land's edge reaches the inner contact",
                                                     "first contact with the stop",
                                                     "first slip on the return",
                                                     "the inner seal is in the bore again"};
  static const char *const paths[] = {"time_s", "displacement_m", "force_N"};
  SbReportTable table = {.column = columns, .columns = G_N_ELEMENTS(columns)};
  sb_report_heading(pages, "Stages", 160);
  for (int s = 0; s < SB_STAGE_COUNT; s++) {
    char *cell[5] = {g_strdup(sb_stage_name((SbStage)s))};
    for (int k = 0; k < 3; k++) {
      g_autofree char *path =
          g_strdup_printf("cycle.stages.%s.%s", sb_stage_name((SbStage)s), paths[k]);
      cell[1 + k] = sb_report_value(summary, sb_figure_find(path));
    }
    cell[4] = g_strdup(summary->stage[s].reached ? events[s] : "not reached");
    sb_report_row(pages, &table, (const char *const *)cell, SB_REPORT_PLAIN);
    for (int k = 0; k < 5; k++) {
      g_free(cell[k]);
    }
  }
}

static void draw_seals(SbReportPages *pages, const SbSummary *summary) {
  static const SbReportColumn columns[] = {{"Seals, in the middle of B\xe2\x80\x93"
                                            "C",
                                            3, SB_REPORT_WORDS},
                                           {"Outer", 1.3, SB_REPORT_NUMBER},
                                           {"Error", 1, SB_REPORT_NUMBER},
                                           {"Inner", 1.3, SB_REPORT_NUMBER},
                                           {"Error", 1, SB_REPORT_NUMBER},
                                           {"", 2.6, SB_REPORT_WORDS}};
  SbReportTable table = {.column = columns, .columns = G_N_ELEMENTS(columns)};
  sb_report_heading(pages, "Seals", 160);
  for (int i = 0; i < SB_FIGURE_COUNT; i++) {
    const SbFigure *figure = sb_figure(i);
    if (!figure->brief || figure->group != SB_GROUP_SEAL || figure->seal != SB_OUTER) {
      continue;
    }
    g_autofree char *path =
        g_strconcat("seals.inner.", figure->path + strlen("seals.outer."), NULL);
    const int inner = sb_figure_find(path);
    const char *why = sb_figure_reason(summary, i), *why_inner = sb_figure_reason(summary, inner);
    g_autofree char *note = why != NULL && g_strcmp0(why, why_inner) == 0 ? g_strdup(why)
                            : why != NULL       ? g_strdup_printf("outer: %s", why)
                            : why_inner != NULL ? g_strdup_printf("inner: %s", why_inner)
                                                : g_strdup("");
    g_autofree char *a = sb_report_value(summary, i), *b = sb_report_error(summary, i);
    g_autofree char *c = sb_report_value(summary, inner), *d = sb_report_error(summary, inner);
    const char *const cell[] = {figure->label, a, b, c, d, note};
    sb_report_row(pages, &table, cell, SB_REPORT_PLAIN);
  }
  const char *const leak[] = {"Leak path", sb_leak_state_name(summary->seal[SB_OUTER].leak_state),
                              NULL,        sb_leak_state_name(summary->seal[SB_INNER].leak_state),
                              NULL,        NULL};
  sb_report_row(pages, &table, leak, SB_REPORT_PLAIN);
}

static void draw_figures(SbReportPages *pages, const Scene *scene) {
  static const SbReportColumn columns[] = {{"Figure", 2.5, SB_REPORT_WORDS},
                                           {"Value", 1.4, SB_REPORT_NUMBER},
                                           {"Error estimate", 1.3, SB_REPORT_NUMBER},
                                           {"Meaning", 4.4, SB_REPORT_WORDS}};
  SbReportTable table = {.column = columns, .columns = G_N_ELEMENTS(columns)};
  const SbSummary *summary = scene->summary;
  sb_report_page(pages, false);
  sb_report_heading(pages, "Figures", 100);
  add_figures(pages, &table, summary, SB_GROUP_CYCLE, "Cycle", scene->rig);
  add_figures(pages, &table, summary, SB_GROUP_RIG, "Sliding plate", true);
  add_figures(pages, &table, summary, SB_GROUP_DOSE, "Dose", true);
  add_figures(pages, &table, summary, SB_GROUP_SHELF, "On the shelf", true);
  add_figures(pages, &table, summary, SB_GROUP_PEOPLE, "Who can press it", true);
  add_figures(pages, &table, summary, SB_GROUP_LIFE, "Life", true);
  sb_report_skip(pages, 6);
  sb_report_text(pages,
                 "Error estimates are relative and cover discretisation and iteration, not the "
                 "choice of model. A figure without one has none of its own.",
                 SB_TYPE_NOTE, 400, SB_ROLE_SECOND);
  if (!scene->rig) {
    draw_stages(pages, summary);
    draw_seals(pages, summary);
  }
}

static void draw_warnings(SbReportPages *pages, const SbWarnings *warnings,
                          const SbDocument *document) {
  static const SbReportColumn columns[] = {{"Finding", 6, SB_REPORT_WORDS},
                                           {"Code", 1.8, SB_REPORT_WORDS},
                                           {"Parameter", 2, SB_REPORT_WORDS}};
  SbReportTable table = {.column = columns, .columns = G_N_ELEMENTS(columns)};
  sb_report_heading(pages, "Warnings and limits of validity", 60);
  const GPtrArray *notes = sb_document_notes(document);
  if (warnings->count == 0 && notes->len == 0) {
    sb_report_text(pages, "None: every model was within its range.", SB_TYPE_LABEL, 400,
                   SB_ROLE_INK);
  }
  for (size_t i = 0; i < warnings->count; i++) {
    const SbWarning *warning = &warnings->item[i];
    const char *const cell[] = {warning->text, warning->code, sb_input_key(warning->input)};
    sb_report_row(pages, &table, cell,
                  sb_warning_is_serious(warning->code) ? SB_REPORT_DOUBT : SB_REPORT_PLAIN);
  }
  for (guint i = 0; i < notes->len; i++) {
    const char *const cell[] = {g_ptr_array_index(notes, i), "note", NULL};
    sb_report_row(pages, &table, cell, SB_REPORT_PLAIN);
  }
  if (warnings->dropped > 0) {
    g_autofree char *text = g_strdup_printf("and %zu more", warnings->dropped);
    sb_report_text(pages, text, SB_TYPE_LABEL, 400, SB_ROLE_WARN);
  }
}

// What reviewers wrote.
static void draw_remarks(SbReportPages *pages, const SbDocument *document) {
  static const SbReportColumn columns[] = {{"", 2, SB_REPORT_WORDS}, {"", 6, SB_REPORT_WORDS}};
  static const char *const names[SB_REMARK_KINDS] = {"Bookmarks", "Notes"};
  SbReportTable table = {.column = columns, .columns = G_N_ELEMENTS(columns)};
  bool headed = false;
  for (int kind = 0; kind < SB_REMARK_KINDS; kind++) {
    for (size_t i = 0; i < sb_document_remark_count(document, (SbRemarkKind)kind); i++) {
      if (!headed) {
        sb_report_heading(pages, "From the review", 60);
        headed = true;
      }
      const char *const head[] = {names[kind], NULL};
      if (i == 0) {
        sb_report_row(pages, &table, head, SB_REPORT_GROUP);
      }
      const char *const cell[] = {sb_document_remark_name(document, (SbRemarkKind)kind, i),
                                  sb_document_remark_text(document, (SbRemarkKind)kind, i)};
      sb_report_row(pages, &table, cell, SB_REPORT_PLAIN);
    }
  }
}

// ---- Studies ----

static void draw_study(cairo_t *cr, SbRect rect, const SbTheme *theme, const void *of) {
  // Tables of many columns need a window's width.
  const double scale = 0.8;
  cairo_translate(cr, rect.x, rect.y);
  cairo_scale(cr, scale, scale);
  sb_study_draw(cr, (SbRect){0, 0, rect.width / scale, rect.height / scale}, theme, of);
}

static void draw_studies(SbReportPages *pages, const Scene *scene) {
  for (size_t i = 0; i < scene->of->study_count; i++) {
    const SbStudy *study = &scene->of->studies[i];
    sb_report_page(pages, true);
    sb_report_heading(pages, sb_study_title(study->kind), 400);
    if (!study->complete) {
      sb_report_notice(pages, "A solver did not converge at every point; such points are omitted.",
                       true);
    }
    sb_report_picture(pages, sb_report_left(pages) - 40, draw_study, study);
    g_autofree char *foot = g_strdup_printf("Models: %s. %s", study->models, study->validity);
    sb_report_text(pages, foot, SB_TYPE_NOTE, 400, SB_ROLE_SECOND);
  }
}

// ---- The whole ----

static void draw_scene(SbReportPages *pages, const void *of) {
  const Scene *scene = of;
  draw_summary(pages, scene);
  draw_cycle(pages, scene);
  draw_figures(pages, scene);
  draw_warnings(pages, &scene->summary->warnings, scene->of->document);
  draw_remarks(pages, scene->of->document);
  draw_studies(pages, scene);
  sb_report_page(pages, false);
  sb_report_inputs(pages, scene->of->document, scene->model);
}

bool sb_report_scene(FILE *stream, const SbReportScene *of, const SbReportHooks *hooks,
                     GError **error) {
  Scene scene = {.of = of, .summary = sb_run_summary(of->run), .model = sb_run_model(of->run)};
  SbReport report = {0};
  scene.rig = sb_model_is_rig(scene.model);
  if (sb_section_painter_create(&scene.painter, false, SB_GL_AUTO, &report) != SB_OK) {
    g_set_error(error, SB_APP_ERROR, SB_APP_ERROR_IO, "%s", report.text);
    return false;
  }
  const SbSectionStyle style = sb_section_style_of(scene.model);
  sb_section_painter_style(scene.painter, &style);
  // A report is a file, in English whatever the window speaks.
  const locale_t paused = sb_translation_pause();
  SbTrace *trace = sb_trace_create(scene.model);
  size_t count;
  const SbFrame *frames = sb_run_frames(of->run, &count);
  sb_trace_extend(trace, frames, count, 0);
  g_autofree SbChartMarker *marker = NULL;
  const size_t markers = sb_render_markers(&marker, of->document);
  scene.data = (SbChartData){.title = sb_document_title(of->document),
                             .measured = of->measured,
                             .marker = marker,
                             .marker_count = markers};
  sb_chart_run_init(&scene.data.run, of->run, trace, sb_chart_state_of(scene.summary));
  // A run without a frame has pages of figures all the same.
  (void)sb_render_frame_at(&scene.data.playhead, of->run, NULL, NULL);

  g_autofree char *hash = sb_document_sha256(of->document);
  scene.files = sb_report_files(of->document);
  g_autofree char *foot = sb_report_foot(scene.files, hash);
  char models[512], errors[512];
  sb_page_models_text(models, sizeof models, &scene.data.run);
  sb_page_errors_text(errors, sizeof errors, &scene.data.run);
  g_autofree char *comment = g_strdup_printf("Models: %s\nError estimates: %s", models, errors);
  const SbReportTexts texts = {.title = sb_document_title(of->document),
                               .foot = foot,
                               .comment = comment,
                               .hash = hash,
                               .bookmark = "Summary"};
  const bool good = sb_report_pages_write(stream, &texts, draw_scene, &scene, hooks, error);
  sb_translation_resume(paused);
  sb_section_painter_destroy(scene.painter);
  sb_trace_destroy(trace);
  g_free(scene.files);
  return good;
}
