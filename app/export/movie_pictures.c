// Which instants a movie shows and how each is drawn. Picture k of n shows the frame nearest to the
// time t0 + (t1 - t0) k/(n - 1), so that the first is the start of the range and the last its end;
// nothing is interpolated.
#include "app/export/movie_pictures.h"

#include "app/base/translation.h"
#include "app/chart/page.h"

#include <math.h>

struct SbMoviePictures {
  const SbRenderView *view;
  const SbRenderOptions *options;
  const SbFrame *frames;
  size_t count;      // frames of the run
  size_t pictures;   // of the film
  double begin, end; // times of the run [s]
  int width, height, fps_num, fps_den;
  SbTrace *trace;
  SbChartData data;
  SbRenderCompared compared;
  char *comment;
};

static bool fail(GError **error, const char *text) {
  g_set_error_literal(error, SB_APP_ERROR, SB_APP_ERROR_INPUT, text);
  return false;
}

static void take_rate(SbMoviePictures *film, double fps) {
  bool whole = fps == floor(fps);
  film->fps_num = (int)lround(whole ? fps : fps * 1000);
  film->fps_den = whole ? 1 : 1000;
}

// Times of the ends, from the frames they name.
static bool take_range(SbMoviePictures *film, const SbRun *run, const SbRenderMovie *movie,
                       GError **error) {
  size_t from = 0;
  size_t to = film->count - 1;
  GError *reason = NULL;
  if ((movie->from != NULL && !sb_render_frame_at(&from, run, movie->from, &reason)) ||
      (movie->to != NULL && !sb_render_frame_at(&to, run, movie->to, &reason))) {
    g_propagate_prefixed_error(error, reason, "range of the film: ");
    return false;
  }
  if (from > to || (from == to && film->count > 1)) {
    return fail(error, "range of the film: its end is not after its start");
  }
  film->begin = film->frames[from].time;
  film->end = film->frames[to].time;
  return true;
}

bool sb_movie_pictures_open(SbMoviePictures **out, const SbRun *run, const SbRenderOptions *options,
                            const SbRenderMovie *movie, GError **error) {
  const double fps_min = 0.1;
  const double fps_max = 1000;
  const double pictures_max = 1e6;
  *out = NULL;
  SbMoviePictures *film = g_new0(SbMoviePictures, 1);
  film->options = options;
  film->view = sb_render_view(options->view);
  film->frames = sb_run_frames(run, &film->count);
  bool good = true;
  if (film->view == NULL) {
    good = fail(error, "there is no such view");
  } else if (film->view->section && options->section == NULL) {
    good = fail(error, "the section cannot be drawn here");
  } else if (film->count == 0) {
    good = fail(error, "the run has no frame to show");
  } else {
    good = sb_render_view_fits(film->view, run, error) && take_range(film, run, movie, error);
  }
  double fps = movie->fps > 0 ? movie->fps : 30;
  double duration = movie->duration > 0 ? movie->duration : 10;
  duration = movie->speed > 0 ? (film->end - film->begin) / movie->speed : duration;
  if (good && !(fps >= fps_min && fps <= fps_max && duration * fps <= pictures_max)) {
    good =
        fail(error, "impossible movie (allowed 0.1 to 1000 pictures per second, a million in all)");
  }
  if (!good) {
    g_free(film);
    return false;
  }
  film->width = (int)fmin(options->width > 0 ? options->width : film->view->width, 1e6);
  film->height = (int)fmin(options->height > 0 ? options->height : film->view->height, 1e6);
  take_rate(film, fps);
  film->pictures = sb_movie_frames(duration, film->fps_num, film->fps_den);
  film->trace = sb_trace_create(sb_run_model(run));
  sb_trace_extend(film->trace, film->frames, film->count, 0);
  sb_render_compared_begin(&film->compared, &film->data, options);
  SbStatus ended = sb_run_summary(run)->status;
  sb_chart_run_init(&film->data.run, run, film->trace,
                    ended == SB_OK                ? SB_CHART_DONE
                    : ended == SB_ERROR_CANCELLED ? SB_CHART_PARTIAL
                                                  : SB_CHART_FAILED);
  char models[256];
  const locale_t paused = sb_translation_pause();
  sb_page_models_text(models, sizeof models, &film->data.run);
  sb_translation_resume(paused);
  film->comment = g_strdup_printf("Models: %s. Parameters: %s", models,
                                  options->hash != NULL ? options->hash : "-");
  *out = film;
  return true;
}

void sb_movie_pictures_close(SbMoviePictures *film) {
  if (film == NULL) {
    return;
  }
  sb_render_compared_end(&film->compared);
  sb_trace_destroy(film->trace);
  g_free(film->comment);
  g_free(film);
}

size_t sb_movie_pictures_count(const SbMoviePictures *film) {
  return film->pictures;
}

void sb_movie_pictures_size(const SbMoviePictures *film, int *width, int *height) {
  *width = film->width;
  *height = film->height;
}

void sb_movie_pictures_rate(const SbMoviePictures *film, int *numerator, int *denominator) {
  *numerator = film->fps_num;
  *denominator = film->fps_den;
}

const char *sb_movie_pictures_comment(const SbMoviePictures *film) {
  return film->comment;
}

// Pictures come in order mostly: the search goes on from the last one's frame.
static size_t nearest(const SbMoviePictures *film, double time) {
  const SbFrame *frames = film->frames;
  size_t i = film->data.playhead;
  if (frames[i].time > time) {
    i = 0;
  }
  while (i + 1 < film->count && fabs(frames[i + 1].time - time) <= fabs(frames[i].time - time)) {
    i++;
  }
  return i;
}

void sb_movie_pictures_draw(SbMoviePictures *film, size_t index, cairo_t *cr) {
  double share = film->pictures > 1 ? (double)index / (double)(film->pictures - 1) : 0;
  film->data.playhead = nearest(film, film->begin + share * (film->end - film->begin));
  sb_render_compared_place(&film->data);
  const SbRenderOptions *options = film->options;
  sb_render_draw(cr, (SbRect){0, 0, film->width, film->height}, sb_theme(options->dark),
                 &film->data, 0, film->view, options->section, options->section_data);
}
