// The table of views and the page that each is put on. A page is scaled as a whole from the size
// its view is made for, but not below 0.8: then the view gets less room and text stays readable. A
// still of the loop without a given time shows the whole run; the other views need an instant and
// take the middle of B-C.
#include "app/export/render.h"

#include "app/base/device.h"
#include "app/base/format.h"
#include "app/base/translation.h"
#include "app/chart/hysteresis.h"
#include "app/chart/life.h"
#include "app/chart/page.h"
#include "app/chart/profiles.h"
#include "app/chart/rig.h"
#include "app/chart/shelf.h"
#include "app/chart/signal.h"
#include "app/export/still.h"
#include "app/session/playhead.h"

#include <glib/gi18n.h>
#include <math.h>
#include <string.h>

static bool refuse(GError **error, const char *why) {
  g_set_error_literal(error, SB_APP_ERROR, SB_APP_ERROR_INPUT, why);
  return false;
}

static bool has_plate(const SbRun *run, GError **error) {
  return !sb_device(sb_run_model(run))->stem ||
         refuse(error, "the view \"rig\" is for the sliding plate (models.motion = rig)");
}

static bool has_valve(const SbRun *run, GError **error) {
  return sb_device(sb_run_model(run))->stem ||
         refuse(error, "the view \"cutaway\" is for a valve, not for the sliding plate");
}

static bool has_life(const SbRun *run, GError **error) {
  return sb_run_summary(run)->life.done > 0 ||
         refuse(error, "the view \"life\" needs more than one actuation (life.actuations)");
}

static bool has_shelf(const SbRun *run, GError **error) {
  const SbSummary *summary = sb_run_summary(run);
  if (summary->shelf.points == 0) {
    const char *why = sb_figure_reason(summary, sb_figure_find("shelf.loss_kg"));
    g_set_error(error, SB_APP_ERROR, SB_APP_ERROR_INPUT, "the view \"shelf\" has no history: %s",
                why != NULL ? why : "it was not computed");
    return false;
  }
  return true;
}

static void draw_life(cairo_t *cr, SbRect rect, const SbTheme *theme, const SbChartData *data,
                      unsigned flags) {
  sb_life_draw(cr, rect, theme, data);
}

static void draw_shelf(cairo_t *cr, SbRect rect, const SbTheme *theme, const SbChartData *data,
                       unsigned flags) {
  sb_shelf_draw(cr, rect, theme, data);
}

static const SbRenderView views[] = {
    {"section", N_("Axial section"), 1280, 720, .computes = SB_VIEW_SECTION, .section = true,
     .rig = sb_rig_plate_draw},
    {"cutaway", N_("Cutaway in three dimensions"), 1280, 720, .computes = SB_VIEW_SECTION,
     .section = true, .cutaway = true, .fits = has_valve},
    {"hysteresis", N_("Force and displacement"), 960, 720, .computes = SB_VIEW_HYSTERESIS,
     .compares = true, .whole = true, .valve = sb_hysteresis_draw, .rig = sb_signal_draw},
    {"profiles", N_("Contact pressure and film"), 1440, 520, .computes = SB_VIEW_PROFILES,
     .compares = true, .valve = sb_profiles_draw, .rig = sb_rig_figures_draw},
    {"dashboard", N_("Dashboard"), 1920, 1080, .computes = SB_VIEW_DASHBOARD, .section = true,
     .compares = true, .page = sb_dashboard_draw},
    {"rig", N_("Thread force and coefficients"), 1440, 720, .computes = SB_VIEW_RIG, .whole = true,
     .valve = sb_rig_page_draw, .rig = sb_rig_page_draw, .fits = has_plate},
    {"life", N_("Life over its actuations"), 1440, 620, .computes = SB_VIEW_LIFE, .whole = true,
     .valve = draw_life, .rig = draw_life, .fits = has_life},
    {"shelf", N_("Loss on the shelf"), 1440, 760, .computes = SB_VIEW_SHELF, .whole = true,
     .valve = draw_shelf, .rig = draw_shelf, .fits = has_shelf},
};

const SbRenderView *sb_render_views(size_t *count) {
  *count = G_N_ELEMENTS(views);
  return views;
}

static const SbRenderSize sizes[] = {
    {"720p", "720p, 1280 \xc3\x97 720", 1280, 720},
    {"1080p", "1080p, 1920 \xc3\x97 1080", 1920, 1080},
    {"4k", "4K, 3840 \xc3\x97 2160", 3840, 2160},
    {"report", N_("Report, 1600 \xc3\x97 1200"), 1600, 1200},
};

const SbRenderSize *sb_render_sizes(size_t *count) {
  *count = G_N_ELEMENTS(sizes);
  return sizes;
}

const SbRenderView *sb_render_view(const char *name) {
  for (size_t i = 0; i < G_N_ELEMENTS(views); i++) {
    if (strcmp(views[i].name, name) == 0) {
      return &views[i];
    }
  }
  return NULL;
}

bool sb_render_view_fits(const SbRenderView *view, const SbRun *run, GError **error) {
  return view->fits == NULL || view->fits(run, error);
}

void sb_render_draw(cairo_t *cr, SbRect rect, const SbTheme *theme, const SbChartData *data,
                    unsigned flags, const SbRenderView *view, SbSectionDraw section, void *user) {
  if (view->page != NULL) {
    view->page(cr, rect, theme, data, flags, section, user);
    return;
  }
  SbPage frame = sb_page_begin(cr, rect, view->width, view->height, theme);
  SbRect page = frame.whole, body = frame.body;
  // A narrow page has no room for read-outs next to its title; the view's own labels say the same.
  unsigned header = page.width < 1000 ? flags | SB_CHART_WHOLE : flags;
  sb_page_header_draw(cr, page, theme, data, header);
  flags |= SB_CHART_PANEL;
  SbViewDraw *draw = sb_device(data->run.model)->stem ? view->valve : view->rig;
  if (draw != NULL) {
    draw(cr, body, theme, data, flags);
  } else if (section) {
    SbCanvas canvas;
    sb_canvas_init(&canvas, cr, theme);
    sb_canvas_panel(&canvas, body);
    sb_canvas_finish(&canvas);
    cairo_save(cr);
    cairo_rectangle(cr, body.x, body.y, body.width, body.height);
    cairo_clip(cr);
    section(cr, body, theme, data, user);
    cairo_restore(cr);
  }
  sb_page_footer_draw(cr, page, theme, data, flags);
  cairo_restore(cr);
}

// ---------------------------------------------------------------------------------------------------
// Stills

bool sb_render_frame_at(size_t *frame, const SbRun *run, const char *at, GError **error) {
  size_t count;
  const SbFrame *frames = sb_run_frames(run, &count);
  const SbSummary *summary = sb_run_summary(run);
  if (count == 0) {
    g_set_error(error, SB_APP_ERROR, SB_APP_ERROR_INPUT, "the run has no frame to show");
    return false;
  }
  const SbChartRun shown = {.frames = frames, .count = count};
  if (!at || !at[0]) {
    const SbStageMark *b = &summary->stage[SB_STAGE_B], *c = &summary->stage[SB_STAGE_C];
    *frame =
        b->reached && c->reached ? sb_chart_nearest(&shown, 0.5 * (b->time + c->time)) : count - 1;
    return true;
  }
  for (int s = 0; s < SB_STAGE_COUNT; s++) {
    if (g_ascii_strcasecmp(at, sb_stage_name((SbStage)s)) == 0) {
      if (!summary->stage[s].reached) {
        g_set_error(error, SB_APP_ERROR, SB_APP_ERROR_INPUT, "stage %s was not reached",
                    sb_stage_name((SbStage)s));
        return false;
      }
      *frame = summary->stage[s].frame;
      return true;
    }
  }
  double time;
  GError *reason = NULL;
  if (!sb_quantity_parse(&time, at, "s", "s", &reason)) {
    g_propagate_prefixed_error(error, reason, "neither a stage (A to F) nor a time: ");
    return false;
  }
  double last = frames[count - 1].time;
  if (!(time >= 0 && time <= last * (1 + 1e-9))) {
    char most[SB_FORMAT_MAX];
    g_set_error(error, SB_APP_ERROR, SB_APP_ERROR_INPUT,
                "the run has no time %s (allowed 0 to %s s)", at, sb_format_digits(most, last, 4));
    return false;
  }
  *frame = sb_chart_nearest(&shown, time);
  return true;
}

size_t sb_render_markers(SbChartMarker **out, const SbDocument *document) {
  const size_t count = sb_document_remark_count(document, SB_REMARK_BOOKMARK);
  *out = g_new0(SbChartMarker, count + 1);
  for (size_t i = 0; i < count; i++) {
    (*out)[i] = (SbChartMarker){sb_document_bookmark(document, i),
                                sb_document_remark_name(document, SB_REMARK_BOOKMARK, i)};
  }
  return count;
}

void sb_render_compared_begin(SbRenderCompared *compared, SbChartData *data,
                              const SbRenderOptions *options) {
  *compared = (SbRenderCompared){0};
  data->title = options->title;
  data->subtitle = options->subtitle;
  data->hash = options->hash;
  data->stale = options->stale;
  data->measured = options->measured;
  data->marker = options->marker;
  data->marker_count = options->marker_count;
  data->pin_count = 0;
  for (size_t i = 0; i < options->pin_count; i++) {
    const SbRenderPin *pin = &options->pin[i];
    size_t count;
    const SbFrame *frames = sb_run_frames(pin->run, &count);
    if (count > 0) {
      compared->trace[i] = sb_trace_create(sb_run_model(pin->run));
      sb_trace_extend(compared->trace[i], frames, count, 0);
      sb_chart_run_init(&compared->run[i], pin->run, compared->trace[i],
                        sb_chart_state_of(sb_run_summary(pin->run)));
      data->pin[data->pin_count++] =
          (SbChartPin){.run = &compared->run[i], .name = pin->name, .look = pin->look};
    }
  }
}

void sb_render_compared_place(SbChartData *data) {
  for (size_t i = 0; i < data->pin_count; i++) {
    data->pin[i].frame = sb_playhead_same_place(&data->run, data->playhead, data->pin[i].run);
  }
}

void sb_render_compared_end(SbRenderCompared *compared) {
  for (int i = 0; i < SB_CHART_PINS; i++) {
    sb_trace_destroy(compared->trace[i]);
  }
}

typedef struct {
  const SbRenderView *view;
  const SbRenderOptions *options;
  const SbTheme *theme;
  const SbChartData *data;
  unsigned flags;
} RenderPage;

static void draw_render_page(cairo_t *cr, double width, double height, void *user) {
  const RenderPage *page = user;
  sb_render_draw(cr, (SbRect){0, 0, width, height}, page->theme, page->data, page->flags,
                 page->view, page->options->section, page->options->section_data);
}

// Returns models, errors and warnings for the file's own texts.
static GString *comment_of(const SbChartRun *run, const SbSummary *summary,
                           const SbRenderOptions *options) {
  const locale_t paused = sb_translation_pause();
  g_autofree char *page = sb_page_comment(run, summary);
  sb_translation_resume(paused);
  GString *comment = g_string_new(page);
  if (options->stale) {
    g_string_append_printf(comment, "\nStale: %s", options->stale);
  }
  for (size_t i = 0; i < summary->warnings.count; i++) {
    g_string_append_printf(comment, "\nWarning: %s", summary->warnings.item[i].text);
  }
  return comment;
}

bool sb_render_still(const SbRun *run, const SbRenderOptions *options, const char *path,
                     GError **error) {
  const SbRenderView *view = sb_render_view(options->view);
  if (!view) {
    g_set_error(error, SB_APP_ERROR, SB_APP_ERROR_INPUT, "there is no view \"%s\"", options->view);
    return false;
  }
  if (view->section && view->page == NULL && !options->section) {
    g_set_error(error, SB_APP_ERROR, SB_APP_ERROR_INPUT, "the section cannot be drawn here");
    return false;
  }
  size_t frame;
  if (!sb_render_view_fits(view, run, error) ||
      !sb_render_frame_at(&frame, run, options->at, error)) {
    return false;
  }

  const SbSummary *summary = sb_run_summary(run);
  size_t count;
  const SbFrame *frames = sb_run_frames(run, &count);
  SbTrace *trace = sb_trace_create(sb_run_model(run));
  sb_trace_extend(trace, frames, count, 0);
  SbChartData data = {.playhead = frame};
  SbRenderCompared compared;
  sb_render_compared_begin(&compared, &data, options);
  sb_chart_run_init(&data.run, run, trace, sb_chart_state_of(summary));
  sb_render_compared_place(&data);

  g_autoptr(GString) comment = comment_of(&data.run, summary, options);
  RenderPage page = {view, options, sb_theme(options->dark), &data,
                     view->whole && !options->at ? SB_CHART_WHOLE : 0};
  SbStill still = {.width = options->width > 0 ? options->width : view->width,
                   .height = options->height > 0 ? options->height : view->height,
                   .scale = options->scale,
                   .title = options->title,
                   .scene = options->scene,
                   .hash = options->hash,
                   .comment = comment->str,
                   .ending = options->ending,
                   .draw = draw_render_page,
                   .user = &page};
  bool good = sb_still_write(&still, path, error);
  sb_render_compared_end(&compared);
  sb_trace_destroy(trace);
  return good;
}
