// A scene's pages. What nobody may miss is on the first: the verdict, serious warnings, the
// section; then the loop and the contact as the window draws them, all figures, and what they rest
// on.
#include "app/export/report.h"

#include "app/base/device.h"
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
#include "app/export/measured_results.h"
#include "app/export/pdf.h"
#include "app/export/render.h"
#include "app/export/run_tables.h"
#include "app/section/painter.h"

#include <math.h>
#include <string.h>

#define DOT "  \xc2\xb7  "

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

// ---- First page ----

static void draw_verdict(SbReportPages *pages, const Scene *scene) {
  g_autoptr(SbTable) table = sb_run_verdict(scene->summary, scene->of->verdict);
  sb_report_table(pages, table);
}

// All limits of the scene itself, not only those that decide.
static void draw_limits(SbReportPages *pages, const Scene *scene) {
  const SbLimits *limits = sb_document_limits(scene->of->document);
  static const SbTableColumn columns[] = {{.label = "Limits of the scene itself", .width = 4},
                                          {.label = "Limit", .width = 2},
                                          {.label = "Value", .width = 1.6},
                                          {.label = "Margin", .width = 2}};
  g_autoptr(SbTable) table = sb_table_new(columns, G_N_ELEMENTS(columns));
  for (size_t i = 0; i < limits->count; i++) {
    const SbLimit *limit = &limits->item[i];
    const int of = limit->figure;
    const double value = sb_figure_value(scene->summary, of);
    const double error = sb_figure_error(scene->summary, of);
    sb_table_add(table,
                 SB_CELLS(sb_cell_own(sb_figure_label(of)),
                          sb_cell_shown(sb_limit_format(of, limit->low, limit->high)),
                          sb_cell_shown(sb_run_value(scene->summary, of)),
                          sb_cell_shown(sb_run_margin(of, value, error, limit->low, limit->high))));
    sb_table_mark(table, value < limit->low || value > limit->high ? SB_TABLE_WRONG
                         : isnan(value)                            ? SB_TABLE_DOUBT
                                                                   : SB_TABLE_PLAIN);
  }
  sb_report_table(pages, table);
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
    if (warning->serious) {
      g_autofree char *text = sb_sentence_case(warning->text);
      sb_report_notice(pages, text, false);
    }
  }
}

// The cycle's figures that somebody wants large or small.
static void draw_key_figures(SbReportPages *pages, const SbSummary *summary, bool rig) {
  static const SbTableColumn columns[] = {{.label = "Key figures", .width = 4},
                                          {.label = "Value", .width = 2},
                                          {.label = "Error estimate", .width = 2}};
  g_autoptr(SbTable) table = sb_table_new(columns, G_N_ELEMENTS(columns));
  for (int i = 0; i < SB_FIGURE_COUNT; i++) {
    const SbFigure *figure = sb_figure(i);
    if (figure->brief && (rig || figure->better != SB_BETTER_NONE) &&
        !isnan(sb_figure_value(summary, i)) &&
        figure->group == (rig ? SB_GROUP_RIG : SB_GROUP_CYCLE) && figure->error != SB_BY_RESIDUAL) {
      sb_table_add(table,
                   SB_CELLS(sb_cell_text(figure->label), sb_cell_shown(sb_run_value(summary, i)),
                            sb_cell_shown(sb_run_error(summary, i))));
    }
  }
  sb_report_table(pages, table);
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

static void draw_report_life(cairo_t *cr, SbRect rect, const SbTheme *theme, const void *of) {
  sb_life_draw(cr, rect, theme, &((const Scene *)of)->data);
}

static void draw_report_shelf(cairo_t *cr, SbRect rect, const SbTheme *theme, const void *of) {
  const double scale = 0.75; // as a study's
  cairo_translate(cr, rect.x, rect.y);
  cairo_scale(cr, scale, scale);
  sb_shelf_draw(cr, (SbRect){0, 0, rect.width / scale, rect.height / scale}, theme,
                &((const Scene *)of)->data);
}

static void draw_measured(SbReportPages *pages, const SbComparison *comparison) {
  const SbMeasured *measured = comparison->measured;
  g_autofree char *heading = g_strdup_printf("Measured: %s", measured->name);
  sb_report_heading(pages, heading, 120);
  g_autoptr(SbTable) table = sb_measured_stages(comparison);
  sb_report_table(pages, table);
  g_autofree char *rms = sb_measured_difference(comparison->rms),
                  *most = sb_measured_difference(comparison->most);
  g_autofree char *mean = sb_measured_difference(comparison->mean);
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
    sb_report_picture(pages, 540, draw_report_life, scene);
  }
  if (scene->summary->shelf.points > 0) {
    sb_report_heading(pages, "Loss on the shelf", 620);
    sb_report_picture(pages, 600, draw_report_shelf, scene);
  }
}

// ---- Figures ----

static void draw_figures(SbReportPages *pages, const Scene *scene) {
  const SbSummary *summary = scene->summary;
  sb_report_page(pages, false);
  sb_report_heading(pages, "Figures", 100);
  g_autoptr(SbTable) table = sb_run_figures(scene->of->run);
  sb_report_table(pages, table);
  sb_report_skip(pages, 6);
  sb_report_text(pages,
                 "Error estimates are relative and cover discretisation and iteration, not the "
                 "choice of model. A figure without one has none of its own.",
                 SB_TYPE_NOTE, 400, SB_ROLE_SECOND);
  if (!scene->rig) {
    sb_report_heading(pages, "Stages", 160);
    g_autoptr(SbTable) stages = sb_run_stages(summary);
    sb_report_table(pages, stages);
    sb_report_heading(pages, "Seals", 160);
    g_autoptr(SbTable) seals = sb_run_seals(summary);
    sb_report_table(pages, seals);
  }
}

static void draw_warnings(SbReportPages *pages, const SbWarnings *warnings,
                          const SbDocument *document) {
  sb_report_heading(pages, "Warnings and limits of validity", 60);
  const GPtrArray *notes = sb_document_notes(document);
  if (warnings->count == 0 && notes->len == 0) {
    sb_report_text(pages, "None: every model was within its range.", SB_TYPE_LABEL, 400,
                   SB_ROLE_INK);
  }
  g_autoptr(SbTable) table = sb_run_warnings(warnings, notes);
  sb_report_table(pages, table);
  if (warnings->dropped > 0) {
    g_autofree char *text = g_strdup_printf("and %zu more", warnings->dropped);
    sb_report_text(pages, text, SB_TYPE_LABEL, 400, SB_ROLE_WARN);
  }
}

// What reviewers wrote.
static void draw_remarks(SbReportPages *pages, const SbDocument *document) {
  static const SbTableColumn columns[] = {{.label = "", .width = 2}, {.label = "", .width = 6}};
  static const char *const names[SB_REMARK_KINDS] = {"Bookmarks", "Notes"};
  g_autoptr(SbTable) table = sb_table_new(columns, G_N_ELEMENTS(columns));
  for (int kind = 0; kind < SB_REMARK_KINDS; kind++) {
    for (size_t i = 0; i < sb_document_remark_count(document, (SbRemarkKind)kind); i++) {
      if (i == 0) {
        sb_table_note(table, "%s", names[kind]);
      }
      sb_table_add(
          table, SB_CELLS(sb_cell_text(sb_document_remark_name(document, (SbRemarkKind)kind, i)),
                          sb_cell_text(sb_document_remark_text(document, (SbRemarkKind)kind, i))));
    }
  }
  if (sb_table_row(table, 0) != NULL) {
    sb_report_heading(pages, "From the review", 60);
    sb_report_table(pages, table);
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
  scene.rig = !sb_device(scene.model)->stem;
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
  g_autofree char *comment = sb_page_comment(&scene.data.run, scene.data.run.summary);
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
