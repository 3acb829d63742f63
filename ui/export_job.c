// One export on a thread of its own: the run is complete and immutable, the painter and the trace
// belong to this thread, so nothing is shared with the window but a counter and a flag. A film
// shows the whole cycle in the given time; each of its pictures is the run's nearest frame.
#include "ui/export_job.h"

#include "app/export/movie.h"
#include "app/export/render.h"
#include "app/section/painter.h"
#include "ui/playhead.h"

#include <cairo.h>
#include <string.h>

struct SbExportJob {
  SbRunHandle *handle; // owned reference
  SbExportRequest request;
  GThread *thread;
  void (*done)(void *data);
  void *data;
  GMutex lock;   // guards `source`
  guint source;  // posted by the thread as its last act
  int cancel;    // atomic
  int per_mille; // atomic: progress
  char *result;
  gboolean good;
};

void sb_export_request_clear(SbExportRequest *request) {
  char **texts[] = {&request->path,     &request->view, &request->at,   &request->title,
                    &request->subtitle, &request->hash, &request->scene};
  for (guint i = 0; i < G_N_ELEMENTS(texts); i++) {
    g_clear_pointer(texts[i], g_free);
  }
}

// Pictures ---------------------------------------------------------------------------------------

static void make_picture(SbExportJob *job, SbSectionPainter *painter) {
  const SbExportRequest *request = &job->request;
  SbRenderOptions options = {
      .view = request->view,
      .width = request->width,
      .height = request->height,
      .dark = request->dark,
      .at = request->at,
      .title = request->title,
      .subtitle = request->subtitle,
      .hash = request->hash,
      .scene = request->scene,
      .section = sb_section_painter_draw,
      .section_data = painter,
  };
  g_autoptr(GError) error = NULL;
  job->good = sb_render_still(sb_run_handle_run(job->handle), &options, request->path, &error);
  g_atomic_int_set(&job->per_mille, 1000);
  if (job->good) {
    g_autofree char *name = g_filename_display_basename(request->path);
    job->result = g_strdup_printf("%s is written.", name);
  } else {
    job->result = g_strdup_printf("Nothing was written: %s.", error->message);
  }
}

// Films ------------------------------------------------------------------------------------------

typedef struct {
  SbExportJob *job;
  SbSectionPainter *painter;
  SbChartData data;
  const SbRenderView *view;
  const SbTheme *theme;
  size_t total;
} Film;

static SbStatus draw_frame(void *user, size_t index, uint8_t *pixels, size_t stride,
                           SbReport *report) {
  Film *film = user;
  const SbExportRequest *request = &film->job->request;
  const SbChartRun *run = &film->data.run;
  double end = run->frames[run->count - 1].time;
  double time = film->total > 1 ? end * (double)index / (double)(film->total - 1) : 0;
  film->data.playhead = sb_playhead_nearest(run->frames, run->count, time);
  cairo_surface_t *surface = cairo_image_surface_create_for_data(
      pixels, CAIRO_FORMAT_ARGB32, (int)request->width, (int)request->height, (int)stride);
  cairo_t *cr = cairo_create(surface);
  sb_render_draw(cr, (SbRect){0, 0, request->width, request->height}, film->theme, &film->data, 0,
                 film->view, sb_section_painter_draw, film->painter);
  cairo_status_t status = cairo_status(cr);
  cairo_destroy(cr);
  cairo_surface_flush(surface);
  cairo_surface_destroy(surface);
  return status == CAIRO_STATUS_SUCCESS
             ? SB_OK
             : sb_fail(report, SB_ERROR_MEMORY, "%s", cairo_status_to_string(status));
}

static void on_film_progress(void *user, size_t done, size_t total) {
  Film *film = user;
  g_atomic_int_set(&film->job->per_mille, (int)(1000 * done / MAX(total, 1)));
}

static bool film_cancelled(void *user) {
  Film *film = user;
  return g_atomic_int_get(&film->job->cancel) != 0;
}

static void make_film(SbExportJob *job, SbSectionPainter *painter) {
  const SbExportRequest *request = &job->request;
  const SbRun *run = sb_run_handle_run(job->handle);
  size_t count = 0;
  const SbFrame *frames = sb_run_frames(run, &count);
  if (count == 0) {
    job->result = g_strdup("Nothing was written: the run has no frames.");
    return;
  }
  SbTrace *trace = sb_trace_create(sb_run_model(run));
  sb_trace_extend(trace, frames, count, 0);
  Film film = {.job = job,
               .painter = painter,
               .view = sb_render_view(request->view),
               .theme = sb_theme(request->dark),
               .total = sb_movie_frames(request->duration, request->fps, 1)};
  bool whole = sb_run_handle_status(job->handle) == SB_OK;
  sb_chart_run_init(&film.data.run, run, trace, whole ? SB_CHART_DONE : SB_CHART_PARTIAL);
  film.data.run.summary = sb_run_summary(run);
  film.data.title = request->title;
  film.data.subtitle = request->subtitle;
  film.data.hash = request->hash;
  SbMovieOptions options = {.width = (int)request->width,
                            .height = (int)request->height,
                            .fps_num = request->fps,
                            .fps_den = 1,
                            .frames = film.total,
                            .title = request->title,
                            .comment = request->subtitle};
  SbMovieHooks hooks = {on_film_progress, film_cancelled, &film};
  SbMovieResult result = {0};
  SbReport report = {0};
  SbStatus status =
      sb_movie_write(request->path, &options, draw_frame, &film, &hooks, &result, &report);
  g_autofree char *name = g_filename_display_basename(request->path);
  if (status == SB_OK) {
    job->good = TRUE;
    job->result = g_strdup_printf("%s is written: %zu frames.", name, result.frames);
  } else if (status == SB_ERROR_CANCELLED && result.frames > 0) {
    job->result = g_strdup_printf("Cancelled: %s is partial, %zu of %zu frames.", name,
                                  result.frames, film.total);
  } else if (status == SB_ERROR_CANCELLED) {
    job->result = g_strdup("Cancelled: nothing was written.");
  } else {
    job->result = g_strdup_printf("Nothing was written: %s.", report.text);
  }
  sb_trace_destroy(trace);
}

// Thread -----------------------------------------------------------------------------------------

static gboolean post(gpointer data) {
  SbExportJob *job = data;
  g_mutex_lock(&job->lock);
  job->source = 0;
  g_mutex_unlock(&job->lock);
  job->done(job->data);
  return G_SOURCE_REMOVE;
}

static gpointer work(gpointer data) {
  SbExportJob *job = data;
  SbSectionPainter *painter = NULL;
  SbReport report = {0};
  if (sb_section_painter_create(&painter, true, SB_GL_AUTO, &report) != SB_OK) {
    job->result = g_strdup_printf("Nothing was written: %s.", report.text);
  } else if (g_str_has_suffix(job->request.path, ".mp4")) {
    make_film(job, painter);
  } else {
    make_picture(job, painter);
  }
  sb_section_painter_destroy(painter);
  g_mutex_lock(&job->lock);
  job->source = g_idle_add(post, job);
  g_mutex_unlock(&job->lock);
  return NULL;
}

SbExportJob *sb_export_job_start(SbRunHandle *handle, SbExportRequest *request,
                                 void (*done)(void *data), void *data) {
  SbExportJob *job = g_new0(SbExportJob, 1);
  job->handle = handle;
  job->request = *request;
  memset(request, 0, sizeof *request);
  job->done = done;
  job->data = data;
  g_mutex_init(&job->lock);
  job->thread = g_thread_new("export", work, job);
  return job;
}

double sb_export_job_progress(SbExportJob *job) {
  return g_atomic_int_get(&job->per_mille) / 1000.0;
}

void sb_export_job_cancel(SbExportJob *job) {
  g_atomic_int_set(&job->cancel, 1);
}

const char *sb_export_job_result(SbExportJob *job, gboolean *good) {
  *good = job->good;
  return job->result;
}

void sb_export_job_free(SbExportJob *job) {
  if (job == NULL) {
    return;
  }
  sb_export_job_cancel(job);
  g_thread_join(job->thread);
  if (job->source != 0) {
    g_source_remove(job->source);
  }
  g_mutex_clear(&job->lock);
  sb_run_handle_unref(job->handle);
  sb_export_request_clear(&job->request);
  g_free(job->result);
  g_free(job);
}
