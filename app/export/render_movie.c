// Draws picture after picture of a view for the movie writer. Picture k of n shows the frame
// nearest to the cycle's time T k/(n - 1), so that the first is A and the last the end.
#include "app/export/render_movie.h"

#include "app/chart/page.h"

#include <math.h>
#include <string.h>

typedef struct {
  const SbRenderView *view;
  const SbRenderOptions *options;
  const SbFrame *frames;
  size_t count;    // frames of the run
  size_t pictures; // of the film
  SbChartData data;
  int width, height;
} Film;

// Frame nearest to a time, going on from `from`: pictures come in order.
static size_t frame_at(const SbFrame *frames, size_t count, size_t from, double time) {
  size_t i = from;
  while (i + 1 < count && fabs(frames[i + 1].time - time) <= fabs(frames[i].time - time)) {
    i++;
  }
  return i;
}

static SbStatus draw(void *data, size_t picture, uint8_t *pixels, size_t stride, SbReport *report) {
  Film *film = data;
  double total = film->frames[film->count - 1].time;
  double time = film->pictures > 1 ? total * (double)picture / (double)(film->pictures - 1) : 0;
  film->data.playhead = frame_at(film->frames, film->count, film->data.playhead, time);
  cairo_surface_t *surface = cairo_image_surface_create_for_data(
      pixels, CAIRO_FORMAT_ARGB32, film->width, film->height, (int)stride);
  cairo_t *cr = cairo_create(surface);
  const SbRenderOptions *options = film->options;
  sb_render_draw(cr, (SbRect){0, 0, film->width, film->height}, sb_theme(options->dark),
                 &film->data, 0, film->view, options->section, options->section_data);
  cairo_status_t status = cairo_status(cr);
  cairo_destroy(cr);
  cairo_surface_flush(surface);
  cairo_surface_destroy(surface);
  return status == CAIRO_STATUS_SUCCESS
             ? SB_OK
             : sb_fail(report, SB_ERROR_MEMORY, "drawing: %s", cairo_status_to_string(status));
}

// fps as a fraction: whole, or in thousandths (29.97).
static void rate(SbMovieOptions *out, double fps) {
  bool whole = fps == floor(fps);
  out->fps_num = (int)lround(whole ? fps : fps * 1000);
  out->fps_den = whole ? 1 : 1000;
}

static bool fail(GError **error, SbAppError code, const char *text) {
  g_set_error_literal(error, SB_APP_ERROR, code, text);
  return false;
}

bool sb_render_movie(const SbRun *run, const SbRenderOptions *options, const SbRenderMovie *movie,
                     const char *path, SbMovieResult *result, GError **error) {
  double fps = movie->fps > 0 ? movie->fps : 30;
  double duration = movie->duration > 0 ? movie->duration : 10;
  const double fps_max = 1000;
  const double pictures_max = 1e6;
  Film film = {.view = sb_render_view(options->view), .options = options};
  film.frames = sb_run_frames(run, &film.count);
  if (film.view == NULL) {
    return fail(error, SB_APP_ERROR_INPUT, "there is no such view");
  }
  if (!sb_render_view_fits(film.view, run, error)) {
    return false;
  }
  if (film.view->section && options->section == NULL) {
    return fail(error, SB_APP_ERROR_INPUT, "the section cannot be drawn here");
  }
  if (film.count == 0) {
    return fail(error, SB_APP_ERROR_INPUT, "the run has no frame to show");
  }
  if (!(fps >= 0.1 && fps <= fps_max && duration * fps <= pictures_max)) {
    return fail(error, SB_APP_ERROR_INPUT,
                "impossible film (allowed 0.1 to 1000 pictures per second, a million in all)");
  }
  double width = options->width > 0 ? options->width : film.view->width;
  double height = options->height > 0 ? options->height : film.view->height;
  film.width = (int)fmin(width, 1e6);
  film.height = (int)fmin(height, 1e6);

  SbMovieOptions how = {.width = film.width, .height = film.height, .title = options->title};
  rate(&how, fps);
  how.frames = film.pictures = sb_movie_frames(duration, how.fps_num, how.fps_den);
  film.data =
      (SbChartData){.title = options->title, .subtitle = options->subtitle, .hash = options->hash};
  SbTrace *trace = sb_trace_create(sb_run_model(run));
  sb_trace_extend(trace, film.frames, film.count, 0);
  SbStatus ended = sb_run_summary(run)->status;
  sb_chart_run_init(&film.data.run, run, trace,
                    ended == SB_OK                ? SB_CHART_DONE
                    : ended == SB_ERROR_CANCELLED ? SB_CHART_PARTIAL
                                                  : SB_CHART_FAILED);
  char models[256];
  sb_page_models_text(models, sizeof models, &film.data.run);
  char *comment = g_strdup_printf("Models: %s. Parameters: %s", models,
                                  options->hash != NULL ? options->hash : "-");
  how.comment = comment;

  SbReport report = {0};
  SbMovieResult own = {0};
  SbStatus status = sb_movie_write(path, &how, draw, &film, &movie->hooks, &own, &report);
  if (result != NULL) {
    *result = own;
  }
  g_free(comment);
  sb_trace_destroy(trace);
  if (status == SB_OK) {
    return true;
  }
  SbAppError code = status == SB_ERROR_CANCELLED                           ? SB_APP_ERROR_CANCELLED
                    : status == SB_ERROR_RANGE || status == SB_ERROR_INPUT ? SB_APP_ERROR_INPUT
                                                                           : SB_APP_ERROR_IO;
  return fail(error, code, report.text[0] != '\0' ? report.text : sb_status_text(status));
}
